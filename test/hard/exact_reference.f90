!> Contact problems solved in quadruple precision: what the data as stored demand, to 34 digits less those of the
!> condition number.
!>
!> From the contact set of an answer on, points of the wrong sign are exchanged one at a time, the worst first.
module exact_reference
  use, intrinsic :: iso_fortran_env, only: qp => real128
  use fuge_kinds, only: dp
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use general_reference, only: is_excluded, is_prescribed, modes_of, play_of
  implicit none
  private

  public :: force_error_of, solve_exactly

  !> A pivot below this fraction of the largest entry means that the system is singular.
  real(qp), parameter :: SINGULAR = 1.0e-28_qp
  !> Forces and gaps of the wrong sign count beyond this fraction of the largest one.
  real(qp), parameter :: ROUNDING = 1.0e-20_qp
  integer, parameter :: MOST_EXCHANGES = 60

contains

  !> The largest error of a force of `solution`, relative to the largest force; negative if there is no unique answer
  !> that can be found from its contact set.
  pure function force_error_of(alpha, problem, solution) result(error)
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    real(dp) :: error
    real(qp) :: force(size(solution%force))
    logical :: found

    call solve_exactly(alpha, problem, solution, force, found)
    error = -1.0_dp
    if (.not. found) return
    error = 0.0_dp
    if (maxval(abs(force)) > 0.0_qp) error = real(maxval(abs(solution%force - force))/maxval(abs(force)), dp)
  end function force_error_of

  !> The forces (n) of the problem, from the contact set of `start` on.
  pure subroutine solve_exactly(alpha, problem, start, force, found)
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: start
    real(qp), intent(out) :: force(:)
    logical, intent(out) :: found
    real(qp) :: gap(size(force)), wrong(size(force)), play
    integer :: state(size(force)), k, exchange, worst

    state = 0
    do k = 1, size(force)
      if (start%force(k) > 0.0_dp) state(k) = 1
      if (start%force(k) < 0.0_dp .and. play_of(problem, k) <= huge(1.0_dp)) state(k) = -1
      if (.not. (play_of(problem, k) > 0.0_dp .or. is_excluded(problem, k))) state(k) = 1
    end do
    force = 0.0_qp
    do exchange = 1, MOST_EXCHANGES
      call solve_states(alpha, problem, state, force, gap, found)
      if (.not. found) return
      wrong = 0.0_qp
      do k = 1, size(force)
        if (is_excluded(problem, k) .or. .not. play_of(problem, k) > 0.0_dp) cycle
        play = real(play_of(problem, k), qp)
        if (state(k) /= 0) then
          wrong(k) = -real(state(k), qp)*force(k)/max(maxval(abs(force)), tiny(play))
        else
          wrong(k) = max(-gap(k), gap(k) - play)/max(maxval(abs(gap)), maxval(abs(real(problem%gap, qp))), tiny(play))
        end if
      end do
      worst = maxloc(wrong, dim=1)
      if (wrong(worst) <= ROUNDING) return
      if (state(worst) /= 0) then
        state(worst) = 0
      else
        state(worst) = merge(1, -1, gap(worst) < 0.0_qp)
      end if
    end do
    found = .false.
  end subroutine solve_exactly

  !> Forces and gaps (n) if each point has this state; `regular` unless the equations are singular.
  pure subroutine solve_states(alpha, problem, state, force, gap, regular)
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: state(:)
    real(qp), intent(out) :: force(:), gap(:)
    logical, intent(out) :: regular
    real(qp) :: modes(size(state), problem%mode_count()), motion(problem%mode_count())
    real(qp), allocatable :: system(:, :), right(:)
    real(qp) :: stiffness
    integer, allocatable :: points(:)
    integer :: j, k, n, p, m

    n = size(state)
    m = problem%mode_count()
    modes = real(modes_of(problem), qp)
    points = pack([(k, k=1, n)], state /= 0)
    p = size(points)
    allocate (system(p + m, p + m), right(p + m))
    stiffness = max(maxval(abs(real(alpha(points, points), qp))), tiny(stiffness))
    system = 0.0_qp
    right = 0.0_qp
    do j = 1, m
      ! Powers of two, so that modes in odd units do not spoil the choice of pivots.
      modes(:, j) = scale(modes(:, j), -exponent(maxval(abs(modes(:, j)))))
    end do
    do k = 1, p
      system(k, :p) = real(alpha(points(k), points), qp)
      right(k) = -real(problem%gap(points(k)), qp)
      if (state(points(k)) < 0) right(k) = right(k) + real(problem%gap_upper(points(k)), qp)
      ! As large as alpha, or a small pivot would not mean that the system is singular.
      system(k, p + 1:) = -stiffness*modes(points(k), :)
      system(p + 1:, k) = stiffness*modes(points(k), :)
    end do
    do j = 1, m
      associate (power => exponent(maxval(abs(real(mode_of(problem, j), qp)))))
        if (is_prescribed(problem, j)) then
          system(p + j, :) = 0.0_qp
          system(p + j, p + j) = stiffness
          right(p + j) = scale(real(problem%motion(j), qp), power)
        else
          right(p + j) = stiffness*scale(real(problem%resultant(j), qp), -power)
        end if
      end associate
    end do
    call eliminate_exactly(system, right, regular)
    if (.not. regular) return
    force = 0.0_qp
    force(points) = right(:p)
    motion = stiffness*right(p + 1:)
    gap = real(problem%gap, qp)
    do j = 1, m
      gap = gap - modes(:, j)*motion(j)
    end do
    do k = 1, p
      gap = gap + real(alpha(:n, points(k)), qp)*force(points(k))
    end do
  end subroutine solve_states

  pure function mode_of(problem, j) result(mode)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: j
    real(dp) :: mode(problem%points())

    mode = 1.0_dp
    if (allocated(problem%modes)) mode = problem%modes(:, j)
  end function mode_of

  !> Gaussian elimination with row interchanges; `right` becomes the solution.
  pure subroutine eliminate_exactly(matrix, right, regular)
    real(qp), intent(inout) :: matrix(:, :), right(:)
    logical, intent(out) :: regular
    real(qp) :: row(size(right)), largest, swapped
    integer :: j, k, n, p

    n = size(right)
    regular = .true.
    if (n < 1) return
    largest = maxval(abs(matrix))
    do k = 1, n
      p = k - 1 + maxloc(abs(matrix(k:, k)), dim=1)
      regular = abs(matrix(p, k)) > SINGULAR*largest
      if (.not. regular) return
      if (p /= k) then
        row = matrix(p, :)
        matrix(p, :) = matrix(k, :)
        matrix(k, :) = row
        swapped = right(p)
        right(p) = right(k)
        right(k) = swapped
      end if
      matrix(k + 1:, k) = matrix(k + 1:, k)/matrix(k, k)
      do j = k + 1, n
        matrix(k + 1:, j) = matrix(k + 1:, j) - matrix(k + 1:, k)*matrix(k, j)
      end do
      right(k + 1:) = right(k + 1:) - matrix(k + 1:, k)*right(k)
    end do
    do k = n, 1, -1
      right(k) = right(k)/matrix(k, k)
      right(:k - 1) = right(:k - 1) - matrix(:k - 1, k)*right(k)
    end do
  end subroutine eliminate_exactly

end module exact_reference
