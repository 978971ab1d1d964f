!> The independent certificate: how far a solution is from the conditions of the contact problem.
!>
!> It shares no code with any engine but the call of the operator, and sees only the caller's data.
module fuge_certificate
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_operator_products, only: multiply
  use fuge_operator_type, only: fuge_operator
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_status, only: fuge_info, report, FUGE_ERR_MEMORY, FUGE_ERR_SIZE
  implicit none
  private

  public :: fuge_residual, find_violation

  !> A resultant may differ by the rounding of the largest force: so many units in its last place.
  real(dp), parameter :: ROUNDINGS = 16.0_dp

  !> Violations, each relative to the data; no unit. Huge until they are known.
  type, public :: fuge_violation
    !> Gap equation (9): c - (gap + A f - R q).
    real(dp) :: gap_equation = huge(1.0_dp)
    !> Signs, equation (10): negative forces, negative gaps, gaps beyond the upper stop.
    real(dp) :: sign = huge(1.0_dp)
    !> Complementary slackness, equation (10): the smaller one of a force and the distance from
    !> its stop.
    real(dp) :: complementarity = huge(1.0_dp)
    !> Equilibrium, equation (11): R^T f - w; prescribed motions that q does not have.
    real(dp) :: equilibrium = huge(1.0_dp)
  contains
    procedure :: worst
  end type fuge_violation

contains

  !> The largest of the violations: the residual of a solve; no unit.
  pure function worst(self)
    class(fuge_violation), intent(in) :: self
    real(dp) :: worst

    associate (parts => [self%gap_equation, self%sign, self%complementarity, self%equilibrium])
      worst = maxval(parts)
      ! maxval may ignore a NaN, which must not pass for small.
      if (.not. all(parts <= huge(worst))) worst = huge(worst)
    end associate
  end function worst

  !> How far a solution violates equations (9), (10) and (11).
  !>
  !> `operator` with n points; `problem` and `solution` in the same units; out: `violation`, huge
  !> where a force is not finite. One product A f.
  !>
  !> With d the datum of the operator, lengths at point k are compared with the magnitude
  !> |gap_k - (R q)_k + d sum f| + sum_j |A_kj - d| |f_j|: the depth to which the point is pressed,
  !> or its rigid gap, and the terms of its displacement. The magnitude depends neither on the
  !> datum of the gaps or of A nor on other points. For one translation, the error of equation (9)
  !> at the contact point of the least magnitude shows how exact v_0 is, and is compared with v_0
  !> and its terms; elsewhere the error less that one is compared with the magnitude. For several
  !> modes the whole error is. The rounding of the caller's own numbers, and that of R q, is not
  !> counted. Forces are compared with the largest force of their body.
  !>
  !> Errors: FUGE_ERR_SIZE if an array is missing or of the wrong length; FUGE_ERR_MEMORY; those of
  !> the product, FUGE_ERR_CALLBACK also for one that is not finite.
  subroutine fuge_residual(operator, problem, solution, violation, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(fuge_violation), intent(out) :: violation
    type(fuge_info), intent(out) :: info

    call find_violation(operator, problem, solution, violation, info)
  end subroutine fuge_residual

  !> As `fuge_residual`, within a solve: `info` goes on counting products, and its status and
  !> message change on an error only.
  subroutine find_violation(operator, problem, solution, violation, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(fuge_violation), intent(out) :: violation
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: error(:), magnitude(:), rigid_displacement(:), rigid_magnitude(:)
    logical, allocatable :: included(:)
    integer :: n, stat

    if (.not. sizes_agree(operator, problem, solution)) then
      call report(info, FUGE_ERR_SIZE, 'certificate: an array is missing or not as long as the operator has points')
      return
    end if
    ! Violations stay huge: a product with NaN would show nothing.
    if (.not. all(ieee_is_finite(solution%force))) return
    n = operator%points()
    allocate (error(n), magnitude(n), rigid_displacement(n), rigid_magnitude(n), included(n), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'certificate: no memory for '//text(n)//' points')
      return
    end if
    call multiply(operator, solution%force, error, info)
    if (info%failed()) return

    included = .true.
    if (allocated(problem%excluded)) included = .not. problem%excluded
    call find_rigid_displacement(problem, solution, operator%datum()*sum(solution%force), rigid_displacement, &
                                 rigid_magnitude)
    call operator%magnitude(solution%force, error, magnitude)
    error = (problem%gap - rigid_displacement) + error - solution%gap
    magnitude = abs(problem%gap - rigid_displacement) + magnitude
    if (allocated(problem%modes)) then
      ! Motions are solved for together: each is rounded like the largest magnitude of its body.
      rigid_magnitude = rigid_magnitude &
                        + largest_of_bodies(problem%modes, merge(abs(problem%gap) + rigid_magnitude, 0.0_dp, included))
    end if
    violation%gap_equation = gap_violation(error, magnitude, solution%force, problem%gap, rigid_magnitude, included, &
                                           .not. allocated(problem%modes))
    call contact_violations(problem, solution, magnitude, included, violation)
    violation%equilibrium = equilibrium_violation(problem, solution)
  end subroutine find_violation

  !> R q - shift (n), and the magnitude of its terms. `shift` is the displacement by the datum.
  pure subroutine find_rigid_displacement(problem, solution, shift, rigid_displacement, rigid_magnitude)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    real(dp), intent(in) :: shift
    real(dp), intent(out) :: rigid_displacement(:), rigid_magnitude(:)
    integer :: j

    rigid_magnitude = abs(shift)
    if (allocated(problem%modes)) then
      rigid_displacement = -shift
      do j = 1, size(solution%motion)
        rigid_displacement = rigid_displacement + problem%modes(:, j)*solution%motion(j)
        rigid_magnitude = rigid_magnitude + abs(problem%modes(:, j)*solution%motion(j))
      end do
    else
      rigid_displacement = solution%motion(1) - shift
      rigid_magnitude = rigid_magnitude + abs(solution%motion(1))
    end if
  end subroutine find_rigid_displacement

  !> The error of equation (9); for one translation, the error that all points share (that of v_0)
  !> and the rest are judged separately.
  pure function gap_violation(error, magnitude, force, gap, rigid_magnitude, included, translation) result(violation)
    real(dp), intent(in) :: error(:), magnitude(:), force(:), gap(:), rigid_magnitude(:)
    logical, intent(in) :: included(:), translation
    real(dp) :: violation
    real(dp) :: shared, rounding, excess
    integer :: k, reference

    violation = 0.0_dp
    if (.not. any(included)) return
    reference = minloc(gap, dim=1, mask=included)
    ! A force of rounding size is no contact.
    if (any(abs(force) > 0.0_dp)) reference = &
      minloc(magnitude, dim=1, mask=included .and. abs(force) > sqrt(epsilon(shared))*maxval(abs(force)))
    shared = 0.0_dp
    if (translation) shared = error(reference)
    do k = 1, size(error)
      ! max may ignore a NaN, which must not pass for small.
      if (.not. abs(error(k)) <= huge(violation)) violation = huge(violation)
      ! Half a unit in the last place each, of the gaps and of the motions, and as much for their sum.
      rounding = abs(gap(k)) + abs(gap(reference)) + rigid_magnitude(k)
      excess = max(abs(error(k) - shared) - 2.0_dp*epsilon(shared)*rounding, 0.0_dp)
      violation = max(violation, relative(excess, magnitude(k) + magnitude(reference)))
    end do
    if (translation) violation = max(violation, &
      relative(abs(shared), max(rigid_magnitude(reference), abs(gap(reference)), magnitude(reference))))
  end function gap_violation

  !> Signs and complementarity, equation (10) at both stops.
  pure subroutine contact_violations(problem, solution, magnitude, included, violation)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    real(dp), intent(in) :: magnitude(:)
    logical, intent(in) :: included(:)
    type(fuge_violation), intent(inout) :: violation
    real(dp), allocatable :: body_forces(:)
    real(dp) :: largest, body_force, rounding, upper, stop_distance
    integer :: k

    violation%sign = 0.0_dp
    violation%complementarity = 0.0_dp
    largest = maxval(abs(solution%force))
    upper = huge(upper)
    body_force = largest
    ! Not by assignment, for which gfortran compares bounds that are not there yet.
    if (allocated(problem%modes)) then
      allocate (body_forces, source=largest_of_bodies(problem%modes, abs(solution%force)))
    end if
    do k = 1, size(magnitude)
      if (allocated(body_forces)) body_force = body_forces(k)
      if (.not. body_force > 0.0_dp) body_force = largest
      ! Beside the largest force, smaller ones of other bodies may be rounding.
      rounding = merge(ROUNDINGS*epsilon(rounding)*largest, 0.0_dp, body_force < largest)
      associate (f => solution%force(k), c => solution%gap(k))
        if (.not. included(k)) then
          violation%sign = max(violation%sign, relative(abs(f), largest))
          cycle
        end if
        if (allocated(problem%gap_upper)) upper = min(problem%gap_upper(k), huge(upper))
        violation%sign = max(violation%sign, relative(-c, magnitude(k)))
        if (upper < huge(upper)) then
          violation%sign = max(violation%sign, relative(c - upper, magnitude(k)))
        else
          violation%sign = max(violation%sign, relative(max(-f - rounding, 0.0_dp), body_force))
        end if
        stop_distance = c
        if (f < 0.0_dp .and. upper < huge(upper)) stop_distance = c - upper
        violation%complementarity = max(violation%complementarity, &
                                        min(relative(max(abs(f) - rounding, 0.0_dp), body_force), &
                                            relative(abs(stop_distance), magnitude(k))))
      end associate
    end do
  end subroutine contact_violations

  !> At each point, the largest of `values` (>= 0) among the points that some mode moves together
  !> with it; 0 for a point that no mode moves.
  pure function largest_of_bodies(modes, values) result(largest)
    real(dp), intent(in) :: modes(:, :), values(:)
    real(dp) :: largest(size(values))
    integer :: j

    largest = 0.0_dp
    do j = 1, size(modes, 2)
      where (abs(modes(:, j)) > 0.0_dp) largest = max(largest, maxval(values, mask=abs(modes(:, j)) > 0.0_dp))
    end do
  end function largest_of_bodies

  !> Equation (11) in the free modes; in the others q must be as prescribed. Forces are judged by
  !> the largest one here too, because a resultant of zero may consist of rounding alone.
  pure function equilibrium_violation(problem, solution) result(violation)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    real(dp) :: violation, largest, imbalance
    integer :: j

    violation = 0.0_dp
    largest = maxval(abs(solution%force))
    do j = 1, problem%mode_count()
      if (is_prescribed(problem, j)) then
        violation = max(violation, relative(abs(solution%motion(j) - problem%motion(j)), abs(problem%motion(j))))
      else if (allocated(problem%modes)) then
        imbalance = abs(sum(problem%modes(:, j)*solution%force) - problem%resultant(j))
        ! The forces of other bodies may be so much larger that those of this one are their rounding.
        imbalance = max(imbalance - ROUNDINGS*epsilon(imbalance)*maxval(abs(problem%modes(:, j)))*largest, 0.0_dp)
        violation = max(violation, relative(imbalance, max(sum(abs(problem%modes(:, j)*solution%force)), &
                                                         abs(problem%resultant(j)))))
      else
        violation = max(violation, relative(abs(sum(solution%force) - problem%resultant(1)), &
                                            max(sum(abs(solution%force)), abs(problem%resultant(1)))))
      end if
    end do
  end function equilibrium_violation

  pure function is_prescribed(problem, mode) result(prescribed)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: mode
    logical :: prescribed

    prescribed = .false.
    if (allocated(problem%prescribed)) prescribed = problem%prescribed(mode)
  end function is_prescribed

  !> Is every array allocated, and as long as the operator has points?
  pure function sizes_agree(operator, problem, solution)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    logical :: sizes_agree
    integer :: m

    m = problem%mode_count()
    sizes_agree = operator%points() > 0 .and. size_of(problem%gap) == operator%points() &
      .and. size_of(solution%force) == operator%points() &
      .and. size_of(solution%gap) == operator%points() .and. size_of(solution%motion) == m
    if (allocated(problem%modes)) sizes_agree = sizes_agree .and. size(problem%modes, 1) == operator%points()
    if (allocated(problem%gap_upper)) sizes_agree = sizes_agree .and. size(problem%gap_upper) == operator%points()
    if (allocated(problem%excluded)) sizes_agree = sizes_agree .and. size(problem%excluded) == operator%points()
    if (allocated(problem%prescribed)) then
      sizes_agree = sizes_agree .and. size(problem%prescribed) == m .and. size_of(problem%motion) == m
      if (.not. all(problem%prescribed)) sizes_agree = sizes_agree .and. size_of(problem%resultant) == m
    else if (m > 0) then
      sizes_agree = sizes_agree .and. size_of(problem%resultant) == m
    end if
  end function sizes_agree

  !> Number of values; -1 if not allocated.
  pure function size_of(values) result(n)
    real(dp), intent(in), allocatable :: values(:)
    integer :: n

    n = -1
    if (allocated(values)) n = size(values)
  end function size_of

  !> value/measure; a value of zero is no violation, even with a measure of zero.
  elemental function relative(value, measure)
    real(dp), intent(in) :: value, measure
    real(dp) :: relative

    if (.not. abs(value) <= huge(value)) then
      ! NaN or infinite: return a number, because maxval may ignore a NaN.
      relative = huge(value)
    else if (abs(value) <= 0.0_dp) then
      relative = 0.0_dp
    else if (measure >= 1.0_dp) then
      relative = value/measure
    else if (abs(value) < measure*huge(value)) then
      relative = value/measure
    else
      ! The quotient would overflow, or the measure is NaN.
      relative = sign(huge(value), value)
    end if
  end function relative

end module fuge_certificate
