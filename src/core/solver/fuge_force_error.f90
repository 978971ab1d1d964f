!> The error of the forces by rounding that no refinement sees: that of rigid modes and prescribed motions, and that of
!> the gaps which decide whether a point is in contact.
!>
!> The dense engines solve with modes that they made orthogonal, and with gaps less the prescribed motions. Where modes
!> nearly agree, the point of reference is far away, or motions are far larger than displacements, the rounding of these
!> is the largest error of the forces. And a point that is open by no more than rounding may as well be in contact:
!> where alpha is badly conditioned, even so small a gap takes a large force to close.
module fuge_force_error
  use fuge_canonical_problem, only: canonical_problem
  use fuge_contact_solution, only: contact_solution
  use fuge_contact_states, only: is_at_stop, FUGE_AT_LOWER_STOP
  use fuge_displacements, only: add_elastic_displacement, displacement_magnitude, displacement_magnitude_at
  use fuge_kinds, only: dp
  use fuge_kkt_factor, only: kkt_factor
  use fuge_kkt_solution, only: solve_set
  use fuge_motion_rounding, only: exact_modes, gap_rounding_at, load_rounding, mode_rounding_at
  use fuge_problem_type, only: fuge_problem
  use fuge_refinement_error, only: make_random_errors, LARGEST, RANDOM_SIGNS
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: estimate_force_error

  !> A gap may be rounded by this many units in the last place of the terms of its displacement.
  real(dp), parameter :: ROUNDINGS = 4.0_dp
  !> Points whose contact is not certain are looked at up to this number.
  integer, parameter :: MOST_POINTS = 4
  !> The error before refinement is about this many roundings of the terms of each equation, as in test/hard.
  real(dp), parameter :: UNREFINED = 32.0_dp
  !> A bound below this fraction of the largest force is good enough with more points in contact than MANY_POINTS, where
  !> it saves a solve that takes some time.
  real(dp), parameter :: SMALL = 1.0e-12_dp
  integer, parameter :: MANY_POINTS = 128

  !> Arrays of an estimate, (n).
  type :: estimate_arrays
    !> The contact set.
    logical, allocatable :: contact(:)
    !> The rounding of each gap by modes and prescribed motions, length; not allocated if there is none.
    real(dp), allocatable :: length(:)
    !> That by coefficients; not allocated if there is none.
    real(dp), allocatable :: rounding(:)
    !> A column of alpha; forces that answer to one at a point, and changes of forces; gaps that are left open.
    real(dp), allocatable :: column(:), force(:), force_change(:), open(:)
  end type estimate_arrays

contains

  !> The largest error of a force relative to the largest force, an estimate: what refinement has left, and what
  !> rounding means that it does not see. At most 1, where no digit is known; 0 without forces.
  !>
  !> `canonical`, `alpha` and `factor` those of the `solution` of `problem`, in which a refinement has left its error;
  !> `motion` (m) in the given modes; `rounds`: the coefficients are sums that were rounded. The arguments are nine,
  !> because only few problems have such. Error: FUGE_ERR_MEMORY.
  subroutine estimate_force_error(canonical, alpha, factor, problem, motion, rounds, solution, force_error, info)
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in), contiguous :: alpha(:, :)
    type(kkt_factor), intent(in) :: factor
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: motion(:)
    logical, intent(in) :: rounds
    type(contact_solution), intent(in) :: solution
    real(dp), intent(out) :: force_error
    type(fuge_info), intent(inout) :: info
    type(estimate_arrays) :: arrays
    real(dp) :: by_modes, by_set, largest, worst
    integer :: stat

    force_error = 0.0_dp
    largest = maxval(abs(solution%force))
    if (.not. largest > 0.0_dp) return
    force_error = 1.0_dp
    if (factor%regularisation > 0.0_dp) return
    by_modes = 0.0_dp
    by_set = 0.0_dp
    if (rounds) then
      call make_room(arrays, solution, info)
      allocate (arrays%rounding(size(solution%force)), stat=stat)
      call require_memory(stat, 'the estimated error of', size(solution%force), 'forces', info)
      if (info%failed()) return
      arrays%rounding = epsilon(worst)*displacement_magnitude(alpha, canonical%datum, arrays%contact, solution%force)
    end if
    if (.not. canonical%plain) call error_by_modes(canonical, factor, problem, motion, solution, arrays, by_modes, info)
    if (.not. info%failed()) call error_by_contact_set(canonical, alpha, factor, solution, arrays, by_set, info)
    if (info%failed()) return
    worst = max(solution%force_error, by_modes, by_set)
    ! The quotient of others could overflow.
    if (worst < largest) force_error = worst/largest
  end subroutine estimate_force_error

  !> Allocate the arrays, unless they are already, for the set of the `solution`. Error: FUGE_ERR_MEMORY.
  subroutine make_room(arrays, solution, info)
    type(estimate_arrays), intent(inout) :: arrays
    type(contact_solution), intent(in) :: solution
    type(fuge_info), intent(inout) :: info
    integer :: n, stat

    if (allocated(arrays%contact)) return
    n = size(solution%force)
    allocate (arrays%contact(n), arrays%column(n), arrays%force(n), arrays%force_change(n), arrays%open(n), stat=stat)
    call require_memory(stat, 'the estimated error of', n, 'forces', info)
    if (stat == 0) arrays%contact = is_at_stop(solution%state)
  end subroutine make_room

  !> The largest change of a force by the rounding of modes and of prescribed motions, an estimate: one solve with the
  !> factor of the contact set, unless that set is large and a bound small.
  !>
  !> Sets arrays%length. Modes whose entries are 0 or one other value are exact. Error: FUGE_ERR_MEMORY.
  subroutine error_by_modes(canonical, factor, problem, motion, solution, arrays, error, info)
    type(canonical_problem), intent(in) :: canonical
    type(kkt_factor), intent(in) :: factor
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: motion(:)
    type(contact_solution), intent(in) :: solution
    type(estimate_arrays), intent(inout) :: arrays
    real(dp), intent(out) :: error
    type(fuge_info), intent(inout) :: info
    real(dp) :: load(size(motion)), free_motion(size(canonical%load))
    real(dp), allocatable :: gap_change(:), load_change(:)
    logical :: exact(size(motion))
    integer :: first, k, stat

    error = 0.0_dp
    exact = exact_modes(problem)
    call make_room(arrays, solution, info)
    if (info%failed()) return
    allocate (arrays%length(size(solution%force)), stat=stat)
    call require_memory(stat, 'the estimated error of', size(solution%force), 'forces', info)
    if (stat /= 0) return
    ! A motion in orthogonal modes may be far larger at a point than in the given ones. That of a translation is exact.
    first = merge(2, 1, canonical%has_translation)
    if (all(exact)) first = size(free_motion) + 1
    do k = 1, size(arrays%length)
      arrays%length(k) = max(mode_rounding_at(problem, exact, motion, k), &
                             epsilon(error)*sum(abs(canonical%modes(k, first:)*solution%motion(first:))))
      arrays%open(k) = gap_rounding_at(problem, k)
    end do
    if (allocated(arrays%rounding)) arrays%length = arrays%length + arrays%rounding
    load = load_rounding(problem, exact, solution%force)
    if (.not. (any(arrays%length > 0.0_dp) .or. any(load > 0.0_dp) .or. any(abs(arrays%open) > 0.0_dp))) then
      deallocate (arrays%length)
      return
    end if
    arrays%column = RANDOM_SIGNS*arrays%length
    call make_random_errors(arrays%column)
    arrays%column = arrays%open + arrays%column
    load = RANDOM_SIGNS*load
    call make_random_errors(load)
    call canonical%transform_change(arrays%column, load, gap_change, load_change, info)
    if (info%failed()) return
    arrays%length = arrays%length + abs(arrays%open)
    if (count(arrays%contact) > MANY_POINTS) then
      error = bound_by_refinement(canonical, problem, motion, solution, maxval(arrays%length), load_change)
      if (error <= SMALL*maxval(abs(solution%force))) return
    end if
    call solve_set(factor, canonical%datum, gap_change, load_change, arrays%force_change, free_motion)
    error = maxval(abs(arrays%force_change))
    ! Also where it is NaN.
    if (.not. error <= LARGEST) error = LARGEST
  end subroutine error_by_modes

  !> A bound of the change of a force by changes of the gaps up to `length` and of the canonical loads by `load_change`:
  !> before refinement the forces had the error that rounding makes of all terms of the equations, and these changes are
  !> compared with those terms. LARGEST where there is nothing to compare with, as of bodies with loads of their own, or
  !> where no digit was right.
  pure function bound_by_refinement(canonical, problem, motion, solution, length, load_change) result(bound)
    type(canonical_problem), intent(in) :: canonical
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: motion(:), length, load_change(:)
    type(contact_solution), intent(in) :: solution
    real(dp) :: bound
    real(dp) :: depth, roundings, deepest, terms
    integer :: j, k

    bound = LARGEST
    if (canonical%has_bodies()) return
    if (.not. solution%unrefined_error <= maxval(abs(solution%force))) return
    deepest = 0.0_dp
    do k = 1, size(solution%state)
      if (.not. is_at_stop(solution%state(k))) cycle
      depth = problem%gap(k)
      do j = 1, size(motion)
        if (allocated(problem%modes)) then
          depth = depth - problem%modes(k, j)*motion(j)
        else
          depth = depth - motion(j)
        end if
      end do
      deepest = max(deepest, abs(depth))
    end do
    if (.not. deepest > 0.0_dp) return
    roundings = length/deepest
    do j = 1, size(load_change)
      terms = sum(abs(canonical%modes(:, j)*solution%force))
      if (.not. terms > 0.0_dp) return
      roundings = roundings + abs(load_change(j))/terms
    end do
    bound = roundings*max(solution%unrefined_error/(UNREFINED*epsilon(bound)), maxval(abs(solution%force)))
    if (.not. bound <= LARGEST) bound = LARGEST
  end function bound_by_refinement

  !> The largest change of a force if an open point whose gap is within rounding were in contact after all, an estimate:
  !> for few such points two solves each.
  !>
  !> `alpha` as in `canonical`; `solution` of the contact set of `factor`; `arrays` as `error_by_modes` leaves them.
  !> Error: FUGE_ERR_MEMORY.
  subroutine error_by_contact_set(canonical, alpha, factor, solution, arrays, error, info)
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in), contiguous :: alpha(:, :)
    type(kkt_factor), intent(in) :: factor
    type(contact_solution), intent(in) :: solution
    type(estimate_arrays), intent(inout) :: arrays
    real(dp), intent(out) :: error
    type(fuge_info), intent(inout) :: info
    real(dp) :: change, relative, most, open, slack
    integer :: k, points

    error = 0.0_dp
    relative = ROUNDINGS*epsilon(relative) + solution%violation
    most = relative*max(canonical%survey%most - canonical%datum, canonical%datum - canonical%survey%least) &
           *sum(abs(solution%force)) + solution%violation*maxval(solution%gap)
    if (allocated(arrays%length)) most = most + maxval(arrays%length)
    points = 0
    do k = 1, size(solution%state)
      if (abs(solution%state(k)) == FUGE_AT_LOWER_STOP .or. canonical%excluded(k)) cycle
      slack = canonical%slack(k, solution%state(k), solution%gap(k))
      if (slack > most) cycle
      call make_room(arrays, solution, info)
      if (info%failed()) return
      open = relative*displacement_magnitude_at(alpha, canonical%datum, arrays%contact, solution%force, k)
      ! Signs were compared with the gap too, that of the upper stop.
      open = open + solution%violation*solution%gap(k)
      if (allocated(arrays%length)) open = open + arrays%length(k)
      if (slack > open) cycle
      call find_change_by_contact(canonical, alpha, factor, k, open, maxval(abs(solution%force)), arrays, change)
      error = max(error, change)
      points = points + 1
      if (points == MOST_POINTS) return
    end do
  end subroutine error_by_contact_set

  !> The largest `change` of a force, up to `most`, if contact at `point` has to close a gap of `length` there: from the
  !> forces that answer to one at that point, and the compliance that is left.
  !>
  !> That compliance is a difference of large terms. The forces are corrected once, and their residual is taken into
  !> account, so that what is wrong with them counts by its square.
  subroutine find_change_by_contact(canonical, alpha, factor, point, length, most, arrays, change)
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in), contiguous :: alpha(:, :)
    type(kkt_factor), intent(in) :: factor
    integer, intent(in) :: point
    real(dp), intent(in) :: length, most
    type(estimate_arrays), intent(inout) :: arrays
    real(dp), intent(out) :: change
    real(dp), dimension(size(canonical%load)) :: row, motion, motion_change, missing
    real(dp) :: compliance, terms
    integer :: j, step

    associate (contact => arrays%contact, column => arrays%column, force => arrays%force, open => arrays%open)
      column = alpha(:size(contact), point) - canonical%datum
      row = canonical%modes(point, :)
      force = 0.0_dp
      motion = 0.0_dp
      open = column
      missing = -row
      do step = 1, 2
        call solve_set(factor, canonical%datum, open, missing, arrays%force_change, motion_change)
        force = force + arrays%force_change
        motion = motion + motion_change
        open = 0.0_dp
        do j = 1, size(motion)
          open = open + canonical%modes(:, j)*motion(j)
        end do
        open = column - open
        call add_elastic_displacement(alpha, canonical%datum, contact, force, open)
        missing = -row - matmul(force, canonical%modes)
      end do
      compliance = column(point) + sum((column + open)*force, mask=contact) + sum((missing - row)*motion)
      terms = abs(column(point)) + sum(abs(column*force), mask=contact) + sum(abs(row*motion))
      ! A smaller compliance is rounding.
      compliance = max(compliance, epsilon(terms)*terms)
      change = length*max(1.0_dp, maxval(abs(force)))
    end associate
    if (change < compliance*most) then
      change = change/compliance
    else if (change > 0.0_dp) then
      change = most
    end if
  end subroutine find_change_by_contact

end module fuge_force_error
