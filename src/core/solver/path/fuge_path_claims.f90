!> What the entries of a path say about forces and gaps by the states of the points, for the certificate of the path.
module fuge_path_claims
  use fuge_contact_states, only: FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, FUGE_LIMITED_LOWER, FUGE_LIMITED_UPPER, &
    FUGE_OPEN
  use fuge_kinds, only: dp
  use fuge_problem_type, only: fuge_problem, fuge_solution
  implicit none
  private

  public :: find_gaps, force_beside_state, rounded_sum, set_loads

  !> Loads and motions at a place of the path are as exact as the terms that they are made of, times this.
  real(dp), parameter :: ROUNDING = 16.0_dp*epsilon(1.0_dp)

contains

  !> The sum of two terms; zero if no more than their rounding is left.
  elemental function rounded_sum(value, change) result(total)
    real(dp), intent(in) :: value, change
    real(dp) :: total

    total = value + change
    if (abs(total) <= ROUNDING*(abs(value) + abs(change))) total = 0.0_dp
  end function rounded_sum

  !> Set resultants and prescribed motions to `first` + `parameter` `rate` (m). The parameter is as exact as parameter +
  !> `origin`: within that rounding resultants are those of the forces, and motions as prescribed.
  pure subroutine set_loads(first, rate, parameter, origin, problem, solution)
    real(dp), intent(in) :: first(:), rate(:), parameter, origin
    type(fuge_problem), intent(inout) :: problem
    type(fuge_solution), intent(inout) :: solution
    real(dp) :: carried, load, noise
    integer :: j

    do j = 1, size(first)
      load = first(j) + parameter*rate(j)
      noise = ROUNDING*(abs(first(j)) + (parameter + origin)*abs(rate(j)))
      if (abs(load) <= noise) load = 0.0_dp
      if (is_prescribed(problem, j)) then
        problem%motion(j) = load
        if (abs(solution%motion(j) - load) <= noise) solution%motion(j) = load
      else
        carried = sum(solution%force)
        if (allocated(problem%modes)) carried = sum(problem%modes(:, j)*solution%force)
        carried = carried + problem%spring_load(j, solution%motion(j))
        problem%resultant(j) = merge(carried, load, abs(carried - load) <= noise)
      end if
    end do
  end subroutine set_loads

  pure function is_prescribed(problem, j)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: j
    logical :: is_prescribed

    is_prescribed = .false.
    if (allocated(problem%prescribed)) is_prescribed = problem%prescribed(j)
  end function is_prescribed

  !> The largest difference from the force that a point has by its `state` (n), zero where open and the limit where it
  !> gives way, as a fraction of the largest of the forces `force` (n).
  pure function force_beside_state(problem, state, force) result(fraction)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: state(:)
    real(dp), intent(in) :: force(:)
    real(dp) :: fraction, largest
    integer :: k

    fraction = 0.0_dp
    largest = maxval(abs(force))
    if (.not. largest > 0.0_dp) return
    do k = 1, size(force)
      select case (state(k))
      case (FUGE_OPEN)
        fraction = max(fraction, abs(force(k))/largest)
      case (FUGE_LIMITED_LOWER, FUGE_LIMITED_UPPER)
        fraction = max(fraction, min(abs(force(k) - limit_of(problem, k, state(k)))/largest, huge(fraction)))
      end select
    end do
  end function force_beside_state

  !> Gaps are zero at the lower stop and the play at the upper one, and follow from forces and motions elsewhere. One on
  !> the wrong side of a stop counts as an error of the gap equation, for which the rounding of the data is allowed.
  !>
  !> `displacement` (n) of the matrix without its `datum`, `state` (n); gaps of `solution` from its forces and motions.
  pure subroutine find_gaps(problem, datum, state, displacement, solution)
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: datum, displacement(:)
    integer, intent(in) :: state(:)
    type(fuge_solution), intent(inout) :: solution
    real(dp) :: rigid(size(state))
    integer :: j, k

    rigid = -datum*sum(solution%force)
    do j = 1, size(solution%motion)
      if (allocated(problem%modes)) then
        rigid = rigid + problem%modes(:, j)*solution%motion(j)
      else
        rigid = rigid + solution%motion(j)
      end if
    end do
    solution%gap = (problem%gap - rigid) + displacement
    if (allocated(problem%compliance)) solution%gap = solution%gap + problem%compliance*solution%force
    do k = 1, size(state)
      if (allocated(problem%excluded)) then
        if (problem%excluded(k)) cycle
      end if
      solution%gap(k) = gap_in_state(problem, k, state(k), solution%gap(k))
    end do
  end subroutine find_gaps

  !> The force of point `k` in a limited state.
  pure function limit_of(problem, k, state) result(force)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: k, state
    real(dp) :: force

    associate (law => problem%law(k))
      force = merge(law%limit, -law%limit_upper, state > 0)
    end associate
  end function limit_of

  !> The gap nearest to `gap` that point `k` may have in its state.
  pure function gap_in_state(problem, k, state, gap) result(nearest)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: k, state
    real(dp), intent(in) :: gap
    real(dp) :: nearest
    real(dp) :: play
    logical :: pushes, pulls

    play = huge(play)
    if (allocated(problem%gap_upper)) play = min(problem%gap_upper(k), play)
    nearest = gap
    select case (state)
    case (FUGE_AT_LOWER_STOP)
      nearest = 0.0_dp
    case (FUGE_AT_UPPER_STOP)
      nearest = play
    case (FUGE_LIMITED_LOWER)
      nearest = min(gap, 0.0_dp)
    case (FUGE_LIMITED_UPPER)
      nearest = max(gap, play)
    case default
      ! A stop without force is none.
      pushes = .true.
      pulls = .true.
      if (allocated(problem%limit)) pushes = problem%limit(k) > 0.0_dp
      if (allocated(problem%limit_upper)) pulls = problem%limit_upper(k) > 0.0_dp
      if (pushes) nearest = max(nearest, 0.0_dp)
      if (pulls) nearest = min(nearest, play)
    end select
  end function gap_in_state

end module fuge_path_claims
