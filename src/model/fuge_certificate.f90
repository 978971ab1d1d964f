!> The independent certificate: how far an answer is from the contact problem.
!> Shares no code with any engine, but for the one call of the operator, and sees only
!> the caller's data.
module fuge_certificate
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_kinds, only: dp
  use fuge_operator_type, only: fuge_operator
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_operator_products, only: multiply
  use fuge_status, only: fuge_info, report, FUGE_ERR_MEMORY, FUGE_ERR_SIZE
  use fuge_number_text, only: text
  implicit none
  private

  public :: fuge_residual, find_violation

  !> Units in the last place of the largest force that a small resultant may be off by.
  real(dp), parameter :: ROUNDINGS = 16.0_dp

  !> Violations, each relative to the data; no unit. Not yet known, they are huge.
  type, public :: fuge_violation
    !> c - (gap + A f - R q), equation (9).
    real(dp) :: gap_equation = huge(1.0_dp)
    !> Negative forces or gaps, gaps beyond the upper stop, equation (10).
    real(dp) :: sign = huge(1.0_dp)
    !> The smaller of force and distance from its stop where both are not zero,
    !> equation (10).
    real(dp) :: complementarity = huge(1.0_dp)
    !> R^T f - w, equation (11); motions that are not as prescribed.
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
  !> with the largest one. With several motions the whole error is compared with the
  !> length, beyond the rounding of R q as well. One product A f. `status` is 0, FUGE_ERR_SIZE if an array is
  !> missing or of the wrong length, FUGE_ERR_MEMORY, or that of a product that fails:
  !> FUGE_ERR_CALLBACK also for one that is not finite.
  subroutine fuge_residual(operator, problem, solution, violation, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(fuge_violation), intent(out) :: violation
    type(fuge_info), intent(out) :: info

    call find_violation(operator, problem, solution, violation, info)
  end subroutine fuge_residual

  !> The same with words for what goes wrong, and the product counted, in `info`.
  subroutine find_violation(operator, problem, solution, violation, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(fuge_violation), intent(out) :: violation
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: error(:), length(:), moved(:), terms(:)
    logical, allocatable :: counts(:)
    integer :: n, stat

    if (.not. fits(operator, problem, solution)) then
      call report(info, FUGE_ERR_SIZE, 'certificate: an array is missing or not as long as the operator has points')
      return
    end if
    ! NaN violates all that there is: nothing is gained by multiplying it.
    if (.not. all(ieee_is_finite(solution%force))) return
    n = operator%points()
    allocate (error(n), length(n), moved(n), terms(n), counts(n), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'certificate: no memory for '//text(n)//' points')
      return
    end if
    call multiply(operator, solution%force, error, info)
    if (info%failed()) return

    counts = .true.
    if (allocated(problem%excluded)) counts = .not. problem%excluded
    call rigid_displacement(problem, solution, operator%datum()*sum(solution%force), moved, terms)
    call operator%magnitude(solution%force, error, length)
    error = (problem%gap - moved) + error - solution%gap
    length = abs(problem%gap - moved) + length
    if (allocated(problem%modes)) then
      ! Motions are found together: each rounds like the largest length of its body.
      terms = terms + largest_of_bodies(problem%modes, merge(abs(problem%gap) + terms, 0.0_dp, counts))
    end if
    violation%gap_equation = gap_violation(error, length, solution%force, problem%gap, terms, counts, &
                                           .not. allocated(problem%modes))
    call contact_violations(problem, solution, length, counts, violation)
    violation%equilibrium = equilibrium_violation(problem, solution)
  end subroutine find_violation

  !> R q - datum (n), and what it is made of. `datum` what the operator left out.
  pure subroutine rigid_displacement(problem, solution, datum, moved, terms)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    real(dp), intent(in) :: datum
    real(dp), intent(out) :: moved(:), terms(:)
    integer :: j

    terms = abs(datum)
    if (allocated(problem%modes)) then
      moved = -datum
      do j = 1, size(solution%motion)
        moved = moved + problem%modes(:, j)*solution%motion(j)
        terms = terms + abs(problem%modes(:, j)*solution%motion(j))
      end do
    else
      moved = solution%motion(1) - datum
      terms = terms + abs(solution%motion(1))
    end if
  end subroutine rigid_displacement

  !> The error of equation (9), for one translation apart for what all points share and
  !> for the rest.
  pure function gap_violation(error, length, force, gap, terms, counts, translation) result(violation)
    real(dp), intent(in) :: error(:), length(:), force(:), gap(:), terms(:)
    logical, intent(in) :: counts(:), translation
    real(dp) :: violation
    real(dp) :: shared, rounding, excess
    integer :: k, reference

    violation = 0.0_dp
    if (.not. any(counts)) return
    reference = minloc(gap, dim=1, mask=counts)
    ! A force that may be rounding is no contact.
    if (any(abs(force) > 0.0_dp)) reference = minloc(length, dim=1, mask=counts .and. &
                                                     abs(force) > sqrt(epsilon(shared))*maxval(abs(force)))
    shared = 0.0_dp
    if (translation) shared = error(reference)
    do k = 1, size(error)
      ! A maximum may drop a NaN, which must not pass for small.
      if (.not. abs(error(k)) <= huge(violation)) violation = huge(violation)
      ! Half a unit in the last place of the gap and of the motions, and as much for their sum.
      rounding = abs(gap(k)) + abs(gap(reference)) + terms(k)
      excess = max(abs(error(k) - shared) - 2.0_dp*epsilon(shared)*rounding, 0.0_dp)
      violation = max(violation, relative(excess, length(k) + length(reference)))
    end do
    if (translation) violation = max(violation, relative(abs(shared), max(terms(reference), abs(gap(reference)), &
                                                                           length(reference))))
  end function gap_violation

  !> Signs and complementarity, equation (10) at both stops.
  pure subroutine contact_violations(problem, solution, length, counts, violation)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    real(dp), intent(in) :: length(:)
    logical, intent(in) :: counts(:)
    type(fuge_violation), intent(inout) :: violation
    real(dp), allocatable :: of_body(:)
    real(dp) :: largest, own, noise, upper, stop_distance
    integer :: k

    violation%sign = 0.0_dp
    violation%complementarity = 0.0_dp
    largest = maxval(abs(solution%force))
    noise = ROUNDINGS*epsilon(noise)*largest
    upper = huge(upper)
    own = largest
    if (allocated(problem%modes)) of_body = largest_of_bodies(problem%modes, abs(solution%force))
    do k = 1, size(length)
      if (allocated(of_body)) own = of_body(k)
      if (.not. own > 0.0_dp) own = largest
      associate (f => solution%force(k), c => solution%gap(k))
        if (.not. counts(k)) then
          violation%sign = max(violation%sign, relative(abs(f), largest))
          cycle
        end if
        if (allocated(problem%gap_upper)) upper = min(problem%gap_upper(k), huge(upper))
        violation%sign = max(violation%sign, relative(-c, length(k)))
        if (upper < huge(upper)) then
          violation%sign = max(violation%sign, relative(c - upper, length(k)))
        else
          violation%sign = max(violation%sign, relative(max(-f - merge(noise, 0.0_dp, own < largest), 0.0_dp), own))
        end if
        stop_distance = c
        if (f < 0.0_dp .and. upper < huge(upper)) stop_distance = c - upper
        violation%complementarity = max(violation%complementarity, &
                                        min(relative(max(abs(f) - merge(noise, 0.0_dp, own < largest), 0.0_dp), own), &
                                            relative(abs(stop_distance), length(k))))
      end associate
    end do
  end subroutine contact_violations

  !> For each point the largest of the values >= 0 among the points that a motion moves
  !> together with it; 0 for a point that none moves.
  pure function largest_of_bodies(modes, values) result(largest)
    real(dp), intent(in) :: modes(:, :), values(:)
    real(dp) :: largest(size(values))
    integer :: j

    largest = 0.0_dp
    do j = 1, size(modes, 2)
      where (abs(modes(:, j)) > 0.0_dp) largest = max(largest, maxval(values, mask=abs(modes(:, j)) > 0.0_dp))
    end do
  end function largest_of_bodies

  !> Equation (11) for the free motions; the others must be as prescribed. Forces count as
  !> parts of the largest one here too: a resultant of zero may rest on rounding alone.
  pure function equilibrium_violation(problem, solution) result(violation)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    real(dp) :: violation, largest, missing
    integer :: j

    violation = 0.0_dp
    largest = maxval(abs(solution%force))
    do j = 1, problem%mode_count()
      if (is_prescribed(problem, j)) then
        violation = max(violation, relative(abs(solution%motion(j) - problem%motion(j)), abs(problem%motion(j))))
      else if (allocated(problem%modes)) then
        missing = abs(sum(problem%modes(:, j)*solution%force) - problem%resultant(j))
        ! Forces of other bodies may be so much larger that this one's are their rounding.
        missing = max(missing - ROUNDINGS*epsilon(missing)*maxval(abs(problem%modes(:, j)))*largest, 0.0_dp)
        violation = max(violation, relative(missing, max(sum(abs(problem%modes(:, j)*solution%force)), &
                                                         abs(problem%resultant(j)))))
      else
        violation = max(violation, relative(abs(sum(solution%force) - problem%resultant(1)), &
                                            max(sum(abs(solution%force)), abs(problem%resultant(1)))))
      end if
    end do
  end function equilibrium_violation

  pure function is_prescribed(problem, motion) result(prescribed)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: motion
    logical :: prescribed

    prescribed = .false.
    if (allocated(problem%prescribed)) prescribed = problem%prescribed(motion)
  end function is_prescribed

  !> Is everything there, and as long as the operator has points?
  pure function fits(operator, problem, solution)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    logical :: fits
    integer :: m

    m = problem%mode_count()
    fits = operator%points() > 0 .and. length_of(problem%gap) == operator%points() &
      .and. length_of(solution%force) == operator%points() &
      .and. length_of(solution%gap) == operator%points() .and. length_of(solution%motion) == m
    if (allocated(problem%modes)) fits = fits .and. size(problem%modes, 1) == operator%points()
    if (allocated(problem%gap_upper)) fits = fits .and. size(problem%gap_upper) == operator%points()
    if (allocated(problem%excluded)) fits = fits .and. size(problem%excluded) == operator%points()
    if (allocated(problem%prescribed)) then
      fits = fits .and. size(problem%prescribed) == m .and. length_of(problem%motion) == m
      if (.not. all(problem%prescribed)) fits = fits .and. length_of(problem%resultant) == m
    else if (m > 0) then
      fits = fits .and. length_of(problem%resultant) == m
    end if
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
