!> Motions that springs far softer than the points hold, to the last digit.
!>
!> Equilibrium tells such a motion as (w - r.f)/s, so that the rounding of the forces f moves it by that of w/s, which
!> may be far more than any point gives way. The gaps of the points in contact are closed, and tell what is missing.
module fuge_settled_motions
  use fuge_compensated_sums, only: compensated_dot
  use fuge_contact_states, only: is_at_stop, FUGE_AT_UPPER_STOP
  use fuge_kinds, only: dp
  use fuge_operator_products, only: multiply
  use fuge_operator_type, only: fuge_operator
  use fuge_point_space, only: point_space
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: settle_motions, softly_held

  !> Rounding below this fraction of the depth to which points are pressed is left as it is.
  real(dp), parameter :: NEGLIGIBLE = 1.0e-13_dp
  !> Motions change by at most this many units in the last place of w/s, and gaps below as many of
  !> their terms are rounding.
  real(dp), parameter :: ROUNDINGS = 16.0_dp
  !> A spring is too soft for gaps beside its motion below this fraction of the stiffness of the contact.
  real(dp), parameter :: SOFT = 1.0e-12_dp

contains

  !> Change the motions on springs in `solution`, within the rounding of equilibrium, so that the gaps of the points
  !> that carry are closed in the mean. One product, where that rounding counts. Errors: FUGE_ERR_MEMORY, those of the
  !> product.
  subroutine settle_motions(operator, problem, solution, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info
    real(dp), dimension(problem%mode_count()) :: arm, change, rounding
    real(dp), allocatable :: noise(:), opening(:), still_open(:)
    type(point_space) :: space
    integer :: k, n, stat

    if (problem%spring_count() < 1) return
    space = operator%ranks()
    n = size(solution%force)
    allocate (noise(n), opening(n), still_open(n), stat=stat)
    call require_memory(stat, 'the gaps of', n, 'points', info)
    call space%agree(info)
    if (stat /= 0 .or. info%failed()) return
    rounding = rounding_on_springs(problem)
    arm = problem%arms()
    call space%raise(arm)
    if (.not. maxval(arm*rounding) > NEGLIGIBLE*depth_of_contact(problem, solution, space)) return
    call multiply(operator, solution%force, opening, info)
    if (info%failed()) return
    opening = opening + operator%datum()*space%total(sum(solution%force))
    if (allocated(problem%compliance)) opening = opening + problem%compliance*solution%force
    do k = 1, n
      noise(k) = ROUNDINGS*epsilon(noise)*(abs(problem%gap(k)) + abs(opening(k)))
      opening(k) = open_gap(problem, solution, k, opening(k))
    end do
    change = closing_change(problem, solution%force, opening, noise, rounding, space)
    do k = 1, n
      still_open(k) = merge(compensated_dot(opening(k), mode_row(problem, k), change), 0.0_dp, abs(opening(k)) > 0.0_dp)
    end do
    ! Several bodies may need different changes.
    if (space%largest(maxval(abs(still_open))) < space%largest(maxval(abs(opening)))) &
      solution%motion = solution%motion + change
  end subroutine settle_motions

  !> What the rounding of resultants makes of the motions on springs, (m); 0 for others.
  pure function rounding_on_springs(problem) result(rounding)
    type(fuge_problem), intent(in) :: problem
    real(dp) :: rounding(problem%mode_count())
    real(dp) :: stiffness(problem%mode_count())

    rounding = 0.0_dp
    stiffness = merge(problem%stiffnesses(), 0.0_dp, problem%motions_on_springs())
    ! The quotient must not overflow.
    where (stiffness > 0.0_dp) rounding = min(epsilon(rounding)*abs(problem%resultants()), &
                                              sqrt(huge(rounding))*min(stiffness, 1.0_dp))/stiffness
  end function rounding_on_springs

  !> The number of the motion on the softest spring, if that is softer than the points in contact by more digits than
  !> their gaps can tell beside it; else 0.
  function softly_held(problem, solution, space) result(motion)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(point_space), intent(in) :: space
    integer :: motion
    real(dp) :: arm(problem%mode_count()), softness(problem%mode_count())

    motion = 0
    if (problem%spring_count() < 1) return
    arm = problem%arms()
    call space%raise(arm)
    softness = huge(softness)
    where (problem%motions_on_springs() .and. arm > 0.0_dp) softness = problem%stiffnesses()/arm/arm
    motion = minloc(softness, dim=1)
    if (.not. softness(motion)*depth_of_contact(problem, solution, space) &
        < SOFT*space%largest(maxval(abs(solution%force)))) motion = 0
  end function softly_held

  !> The largest distance of a point that carries from its stop before it gives way, length.
  function depth_of_contact(problem, solution, space) result(depth)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(point_space), intent(in) :: space
    real(dp) :: depth
    integer :: k

    depth = 0.0_dp
    do k = 1, size(solution%force)
      depth = max(depth, abs(open_gap(problem, solution, k, 0.0_dp)))
    end do
    depth = space%largest(depth)
  end function depth_of_contact

  !> How far point `k`, displaced by the forces as given, is from its stop, length; 0 if it does not carry there.
  pure function open_gap(problem, solution, k, displacement) result(open)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    integer, intent(in) :: k
    real(dp), intent(in) :: displacement
    real(dp) :: open

    open = 0.0_dp
    if (.not. (is_at_stop(solution%state(k)) .and. abs(solution%force(k)) > 0.0_dp)) return
    open = problem%gap(k) + displacement
    if (solution%state(k) == FUGE_AT_UPPER_STOP) open = open - problem%gap_upper(k)
    open = compensated_dot(open, mode_row(problem, k), solution%motion)
  end function open_gap

  !> How far each motion displaces point `k`, (m).
  pure function mode_row(problem, k) result(row)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: k
    real(dp) :: row(problem%mode_count())

    row = 1.0_dp
    if (allocated(problem%modes)) row = problem%modes(k, :)
  end function mode_row

  !> The changes of motions, (m), in the ratio of their `rounding` (m), that close the `open` gaps (n) in the mean, each
  !> with the weight of its force; 0 where that takes more than rounding, or where these gaps are no more than their
  !> own, `noise` (n).
  function closing_change(problem, force, open, noise, rounding, space) result(change)
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: force(:), open(:), noise(:), rounding(:)
    type(point_space), intent(in) :: space
    real(dp) :: change(size(rounding))
    real(dp) :: sums(size(rounding) + 3), share(size(rounding)), largest, weight
    integer :: k

    change = 0.0_dp
    largest = space%largest(maxval(abs(force)))
    if (.not. largest > 0.0_dp) return
    sums = 0.0_dp
    do k = 1, size(open)
      if (.not. abs(open(k)) > 0.0_dp) cycle
      weight = abs(force(k))/largest
      sums = sums + weight*[1.0_dp, open(k), noise(k), mode_row(problem, k)]
    end do
    call space%add(sums)
    if (.not. (sums(1) > 0.0_dp .and. abs(sums(2)) > sums(3))) return
    share = sums(4:)/sums(1)*rounding
    if (.not. abs(sums(2)) < ROUNDINGS*sums(1)*sum(abs(share))) return
    largest = maxval(abs(share))
    share = share/largest
    change = rounding/largest*share*(sums(2)/sums(1)/sum(share*share))
  end function closing_change

end module fuge_settled_motions
