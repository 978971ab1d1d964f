!> The independent certificate: how far an answer is from the contact problem.
!> Shares no code with any engine, but for the one call of the operator, and sees only
!> the caller's data.
module fuge_certificate
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_kinds, only: dp
  use fuge_operator_type, only: fuge_operator
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_products, only: multiply
  use fuge_status, only: fuge_info, report, FUGE_ERR_MEMORY, FUGE_ERR_SIZE
  use fuge_text, only: text
  implicit none
  private

  public :: fuge_residual, find_violation

  !> Violations, each relative to the data; no unit. Not yet known, they are huge.
  type, public :: fuge_violation
    !> c - (gap + A f - v_0), equation (9).
    real(dp) :: gap_equation = huge(1.0_dp)
    !> Negative forces or gaps, equation (10).
    real(dp) :: sign = huge(1.0_dp)
    !> The smaller of force and gap where both are not zero, equation (10).
    real(dp) :: complementarity = huge(1.0_dp)
    !> sum f - F_0, equation (11).
    real(dp) :: equilibrium = huge(1.0_dp)
  contains
    procedure :: worst
  end type fuge_violation

contains

  !> The largest of the violations: the residual of a solve.
  pure function worst(self)
    class(fuge_violation), intent(in) :: self
    real(dp) :: worst

    associate (parts => [self%gap_equation, self%sign, self%complementarity, self%equilibrium])
      worst = maxval(parts)
      ! A maximum may drop a NaN, which must not pass for small.
      if (.not. all(parts <= huge(worst))) worst = huge(worst)
    end associate
  end function worst

  !> Violation of equations (9), (10), (11) by an answer.
  !>
  !> With d the datum of the operator and w = v_0 - d sum f, the length at point k is
  !> |gap_k - w| + sum_j |A_kj - d| |f_j|: the depth to which k is pressed, or its
  !> distance, and the terms of its displacement. It does not depend on the datum of
  !> the gaps or of A, nor on other points. The error of equation (9) at the point in
  !> contact with the least length tells how exact v_0 is and is compared with v_0
  !> and the terms that make it; elsewhere the error less that one is compared with
  !> the length, beyond the rounding of the caller's own numbers. Forces are compared
  !> with the largest one. One product A f. `status` is 0, FUGE_ERR_SIZE if an array is
  !> missing or of the wrong length, FUGE_ERR_MEMORY, or that of a product that fails:
  !> FUGE_ERR_CALLBACK also for one that is not finite.
  subroutine fuge_residual(operator, problem, solution, violation, status)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(fuge_violation), intent(out) :: violation
    integer, intent(out) :: status
    type(fuge_info) :: info

    call find_violation(operator, problem, solution, violation, info)
    status = info%status
  end subroutine fuge_residual

  !> The same with words for what goes wrong, and the product counted, in `info`.
  subroutine find_violation(operator, problem, solution, violation, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(fuge_violation), intent(out) :: violation
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: error(:), length(:)
    real(dp) :: rigid, largest
    integer :: n, stat

    if (.not. fits(operator, problem, solution)) then
      call report(info, FUGE_ERR_SIZE, 'certificate: an array is missing or not as long as the operator has points')
      return
    end if
    ! NaN violates all that there is: nothing is gained by multiplying it.
    if (.not. all(ieee_is_finite(solution%force))) return
    n = operator%points()
    allocate (error(n), length(n), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'certificate: no memory for '//text(n)//' points')
      return
    end if
    call multiply(operator, solution%force, error, info)
    if (info%failed()) return

    rigid = operator%datum()*sum(solution%force)
    call operator%magnitude(solution%force, error, length)
    error = (problem%gap - (solution%rigid(1) - rigid)) + error - solution%gap
    length = abs(problem%gap - (solution%rigid(1) - rigid)) + length
    largest = maxval(abs(solution%force))
    violation%gap_equation = gap_violation(error, length, solution%force, problem%gap, &
                                           abs(rigid) + abs(solution%rigid(1)))
    violation%sign = max(maxval(relative(-solution%force, largest)), maxval(relative(-solution%gap, length)), 0.0_dp)
    violation%complementarity = maxval(min(relative(abs(solution%force), largest), &
                                           relative(abs(solution%gap), length)))
    violation%equilibrium = relative(abs(sum(solution%force) - problem%resultant(1)), &
                                     max(sum(abs(solution%force)), problem%resultant(1)))
  end subroutine find_violation

  !> The error of equation (9), apart for what all points share and for the rest.
  pure function gap_violation(error, length, force, gap, datum) result(violation)
    real(dp), intent(in) :: error(:), length(:), force(:), gap(:), datum
    real(dp) :: violation
    real(dp) :: rounding(size(error)), shared
    integer :: reference

    if (any(abs(force) > 0.0_dp)) then
      ! A force that may be rounding is no contact.
      reference = minloc(length, dim=1, mask=abs(force) > sqrt(epsilon(datum))*maxval(abs(force)))
    else
      reference = minloc(gap, dim=1)
    end if
    shared = error(reference)
    ! Half a unit in the last place of the gap and of v_0, and as much for their sum.
    rounding = 2.0_dp*epsilon(datum)*(abs(gap) + abs(gap(reference)) + datum)
    violation = max(maxval(relative(max(abs(error - shared) - rounding, 0.0_dp), length + length(reference))), &
                    relative(abs(shared), max(datum, abs(gap(reference)), length(reference))))
    ! A maximum may drop a NaN, which must not pass for small.
    if (.not. all(abs(error) <= huge(violation))) violation = huge(violation)
  end function gap_violation

  !> Is everything there, and as long as the operator has points?
  pure function fits(operator, problem, solution)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    logical :: fits

    fits = operator%points() > 0 .and. length_of(problem%gap) == operator%points() &
      .and. length_of(problem%resultant) == 1 .and. length_of(solution%force) == operator%points() &
      .and. length_of(solution%gap) == operator%points() .and. length_of(solution%rigid) == 1
  end function fits

  pure function length_of(values) result(length)
    real(dp), intent(in), allocatable :: values(:)
    integer :: length

    length = -1
    if (allocated(values)) length = size(values)
  end function length_of

  !> value/measure, where nothing compared with nothing is no violation.
  elemental function relative(value, measure)
    real(dp), intent(in) :: value, measure
    real(dp) :: relative

    if (.not. abs(value) <= huge(value)) then
      ! NaN or infinite: a number, because maxval may drop a NaN.
      relative = huge(value)
    else if (abs(value) <= 0.0_dp) then
      relative = 0.0_dp
    else if (measure >= 1.0_dp) then
      relative = value/measure
    else if (abs(value) < measure*huge(value)) then
      relative = value/measure
    else
      ! Too large to divide, or compared with NaN.
      relative = sign(huge(value), value)
    end if
  end function relative

end module fuge_certificate
