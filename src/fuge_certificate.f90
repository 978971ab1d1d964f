!> The independent certificate: how far an answer is from the contact problem.
!> Shares no code with any engine and sees only the caller's data.
module fuge_certificate
  use fuge_kinds, only: dp
  use fuge_operator_type, only: fuge_operator
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_status, only: FUGE_DONE, FUGE_ERR_MEMORY, FUGE_ERR_SIZE
  implicit none
  private

  public :: fuge_residual

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
  !> Lengths at point k are compared with (gap_k - min gap) plus the deflection
  !> that the forces cause: neither depends on the datum of the gaps or of A. The
  !> mean of equation (9) over the contact, which only tells how exact v_0 is, is
  !> compared with v_0 and the terms that make it. Forces are compared with the
  !> largest one. One product A f. `status` is 0, FUGE_ERR_SIZE if an array is missing
  !> or of the wrong length, FUGE_ERR_MEMORY, or what the operator returned.
  subroutine fuge_residual(operator, problem, solution, violation, status)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(fuge_violation), intent(out) :: violation
    integer, intent(out) :: status
    real(dp), allocatable :: error(:), length(:)
    real(dp) :: lowest, middle, mean, rigid, datum, largest
    integer :: n, stat

    status = FUGE_ERR_SIZE
    if (.not. fits(operator, problem, solution)) return
    n = operator%points()
    allocate (error(n), length(n), stat=stat)
    status = merge(FUGE_DONE, FUGE_ERR_MEMORY, stat == 0)
    if (stat /= 0) return
    call operator%apply(solution%force, error, status)
    if (status /= FUGE_DONE) return

    lowest = minval(problem%gap)
    middle = mean_at_contact(error, solution%force, problem%gap)
    rigid = operator%datum()*sum(solution%force)
    datum = max(maxval(abs(problem%gap)), maxval(abs(error)), abs(rigid), abs(solution%rigid(1)))
    length = (problem%gap - lowest) + operator%deflection(solution%force, error)
    largest = maxval(abs(solution%force))
    ! gap + A f - c without its constants: v_0 less the same constants at every point.
    error = (problem%gap - lowest) + (error - middle) - solution%gap
    mean = mean_at_contact(error, solution%force, problem%gap)
    violation%gap_equation = max(maxval(relative(abs(error - mean), length)), &
                                 relative(abs(((lowest + middle) + mean + rigid) - solution%rigid(1)), datum))
    violation%sign = max(maxval(relative(-solution%force, largest)), maxval(relative(-solution%gap, length)), 0.0_dp)
    violation%complementarity = maxval(min(relative(abs(solution%force), largest), &
                                           relative(abs(solution%gap), length)))
    violation%equilibrium = relative(abs(sum(solution%force) - problem%resultant(1)), &
                                     max(sum(abs(solution%force)), problem%resultant(1)))
  end subroutine fuge_residual

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

  !> Mean over the points in contact, the heavily loaded ones first: rounding of
  !> large gaps far away stays out of it. Without forces, the value at the lowest gap.
  pure function mean_at_contact(values, force, gap) result(mean)
    real(dp), intent(in) :: values(:), force(:), gap(:)
    real(dp) :: mean
    real(dp) :: largest

    largest = maxval(abs(force))
    if (largest > 0.0_dp) then
      mean = sum(values*(abs(force)/largest))/sum(abs(force)/largest)
    else
      mean = values(minloc(gap, dim=1))
    end if
  end function mean_at_contact

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
