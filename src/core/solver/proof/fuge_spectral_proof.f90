!> Bounds of the error of a solution by products alone, from the least eigenvalue of the operator.
!>
!> Forces f that keep to the law and balance the load belong to the problem whose gaps are changed by zeta, by which the
!> gaps of f break the law. The law is monotone, so that with the solution f* and the least eigenvalue lambda on forces
!> without a sum |f - f*| <= |zeta|/lambda, in 2-norms, and |f - f*|_A <= |zeta|/sqrt(lambda) in that of the energy. A
!> displacement is a product with a row of A, so that it changes by at most the latter times the root of the diagonal
!> element. One translation, free or prescribed, or none; the points may have
!> compliances, limits and upper stops.
module fuge_spectral_proof
  use fuge_claimed_states, only: claim_point, point_claim, state_by_law, state_of
  use fuge_compensated_sums, only: compensated_sum
  use fuge_kinds, only: dp
  use fuge_operator_products, only: multiply
  use fuge_operator_type, only: fuge_operator, operator_bounds
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_proof_type, only: fuge_proof
  use fuge_rounding_bounds, only: gamma_bound, norm_bound, raised, UNIT_ROUNDOFF
  use fuge_status, only: fuge_info, report, require_memory, FUGE_DONE, FUGE_WARN_NOT_PROVED
  implicit none
  private

  public :: prove_with_products

  !> Forces that are this fraction of the largest from their limits can take what is missing of the load.
  real(dp), parameter :: INNER = 2.0_dp**(-20)

  !> A solution that keeps to the law but for its gaps. It is never below what the comments say.
  type :: balanced_solution
    type(point_claim), allocatable :: claims(:)
    !> What is given: initial gaps, compliances, and the forces and gaps of the solution, (n). Copies, because the
    !> caller's arrays may begin with another number than 1.
    real(dp), allocatable :: initial(:), compliance(:), claimed_force(:), claimed_gap(:)
    !> Forces within the law, (n), and gaps by one product, up to a constant of all points, with their rounding, (n).
    real(dp), allocatable :: force(:), gap(:), rounding(:)
    !> How far the gaps break the law at most, (n).
    real(dp), allocatable :: violation(:)
    !> What is added to forces that are `inner`, to balance the load.
    logical, allocatable :: inner(:)
    real(dp) :: missing = 0.0_dp
    !> The 2-norm of the errors of the gaps that are not in `rounding`, and of the error of the forces.
    real(dp) :: product_error = 0.0_dp, force_error = huge(1.0_dp)
    !> The same in the norm of the energy, and by how much displacements change with that.
    real(dp) :: energy_error = huge(1.0_dp), displacement_error = huge(1.0_dp)
    !> How far a point displaces itself under a unit force, A_kk, less the datum where the sum of the forces is given.
    real(dp) :: own_displacement = huge(1.0_dp)
    !> The error of the motion.
    real(dp) :: motion_error = 0.0_dp
  end type balanced_solution

contains

  !> Bound what `proof` holds, whose bounds are infinite on entry. FUGE_WARN_NOT_PROVED with the reason where they stay
  !> infinite. Errors: FUGE_ERR_MEMORY, those of the product.
  subroutine prove_with_products(operator, problem, solution, proof, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(fuge_proof), intent(inout) :: proof
    type(fuge_info), intent(inout) :: info
    type(operator_bounds) :: bounds
    type(balanced_solution) :: balanced
    character(len=:), allocatable :: reason
    integer :: n, stat, status

    call explain_problem(problem, reason)
    if (reason == '') then
      call operator%bounds(bounds, status)
      if (status /= FUGE_DONE) call report(info, status, 'the bounds of the operator could not be computed')
      if (info%failed()) return
      if (.not. least_of(problem, bounds) > 0.0_dp) reason = &
        'bounds of the eigenvalues of this operator are not known, or do not show that it is positive definite'
    end if
    if (reason == '') then
      n = operator%points()
      allocate (balanced%claims(n), balanced%initial(n), balanced%compliance(n), balanced%claimed_force(n), &
                balanced%claimed_gap(n), balanced%force(n), balanced%gap(n), balanced%rounding(n), &
                balanced%violation(n), balanced%inner(n), stat=stat)
      call require_memory(stat, 'the proof of', n, 'points', info)
      if (stat /= 0) return
      balanced%initial = problem%gap
      balanced%compliance = 0.0_dp
      if (allocated(problem%compliance)) balanced%compliance = problem%compliance
      balanced%claimed_force = solution%force
      balanced%claimed_gap = solution%gap
      call balance(problem, solution, balanced)
      if (.not. balanced%missing < huge(1.0_dp)) reason = &
        'no point in contact is far enough from its limits to take what the forces lack of the load'
    end if
    if (reason == '') then
      call find_gaps(operator, problem, solution, bounds, balanced, info)
      if (.not. info%failed()) call find_own_displacement(operator, problem, bounds, balanced, info)
      if (info%failed()) return
      call bound_errors(problem, bounds, balanced, reason)
    end if
    if (reason == '') then
      call fill_proof(problem, solution, balanced, proof)
    else
      call report(info, FUGE_WARN_NOT_PROVED, reason)
    end if
  end subroutine prove_with_products

  !> Why the problem cannot be proved by products; blank if it can.
  pure subroutine explain_problem(problem, reason)
    type(fuge_problem), intent(in) :: problem
    character(len=:), allocatable, intent(out) :: reason

    reason = ''
    if (problem%mode_count() > 1) then
      reason = 'several motions are proved with an influence matrix only'
    else if (problem%spring_count() > 0) then
      reason = 'a motion on a spring is proved with an influence matrix only'
    else if (allocated(problem%modes)) then
      if (problem%mode_count() == 1 .and. any(abs(problem%modes - 1.0_dp) > 0.0_dp)) reason = &
        'motions other than one translation are proved with an influence matrix only'
    end if
  end subroutine explain_problem

  !> Is the sum of the forces given?
  pure function is_balanced(problem)
    type(fuge_problem), intent(in) :: problem
    logical :: is_balanced

    is_balanced = problem%mode_count() == 1
    if (is_balanced .and. allocated(problem%prescribed)) is_balanced = .not. any(problem%prescribed)
  end function is_balanced

  !> The least eigenvalue that counts.
  pure function least_of(problem, bounds) result(least)
    type(fuge_problem), intent(in) :: problem
    type(operator_bounds), intent(in) :: bounds
    real(dp) :: least

    least = merge(bounds%least_balanced, bounds%least, is_balanced(problem))
  end function least_of

  !> Forces within the law, and what they lack of the load.
  subroutine balance(problem, solution, balanced)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(balanced_solution), intent(inout) :: balanced
    real(dp) :: lack, load(1), margin
    integer :: k

    margin = INNER*maxval(abs(balanced%claimed_force))
    do k = 1, size(balanced%force)
      balanced%claims(k) = claim_point(problem%law(k), state_by_law(problem%law(k), state_of(problem, solution, k)))
      associate (claim => balanced%claims(k), force => balanced%force(k))
        if (claim%at_stop) then
          force = min(max(balanced%claimed_force(k), claim%least), claim%most)
          balanced%inner(k) = force - claim%least > margin .and. claim%most - force > margin
        else
          force = claim%known
          balanced%inner(k) = .false.
        end if
      end associate
    end do
    if (.not. is_balanced(problem)) return
    load = problem%resultants()
    lack = raised(abs(load(1) - compensated_sum(balanced%force)) + sum_error(balanced%force) &
                  + 2.0_dp*UNIT_ROUNDOFF*abs(load(1)), 4)
    if (lack > 0.0_dp) lack = lack + tiny(lack)
    balanced%missing = raised(lack/real(max(count(balanced%inner), 1), dp), 3)
    if (balanced%missing > margin) balanced%missing = huge(1.0_dp)
    if (lack > 0.0_dp .and. .not. any(balanced%inner)) balanced%missing = huge(1.0_dp)
  end subroutine balance

  !> How far the compensated sum of values is off at most.
  pure function sum_error(values)
    real(dp), intent(in) :: values(:)
    real(dp) :: sum_error

    associate (n => size(values))
      sum_error = raised((UNIT_ROUNDOFF + 4.0_dp*gamma_bound(n)**2)*sum(abs(values)), n + 8)
    end associate
  end function sum_error

  !> The gaps by one product. A constant that is the same for all points changes nothing where the sum of the forces is
  !> given: there the rounding of the motion and of what the datum adds does not count.
  subroutine find_gaps(operator, problem, solution, bounds, balanced, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(operator_bounds), intent(in) :: bounds
    type(balanced_solution), intent(inout) :: balanced
    type(fuge_info), intent(inout) :: info
    real(dp) :: constant, force_norm, from_datum, motion, terms
    integer :: k, power

    ! In a unit in which the largest force is about 1 nothing underflows that counts.
    power = exponent(maxval(abs(balanced%force)))
    call multiply(operator, scale(balanced%force, -power), balanced%gap, info)
    if (info%failed()) return
    balanced%gap = scale(balanced%gap, power)
    ! There is at most one.
    motion = sum(solution%motion)
    if (problem%mode_count() == 1 .and. .not. is_balanced(problem)) motion = sum(problem%motion)
    from_datum = operator%datum()*compensated_sum(balanced%force)
    constant = from_datum - motion
    terms = 8.0_dp*UNIT_ROUNDOFF*(abs(from_datum) + abs(motion)) + abs(operator%datum()) &
            *(2.0_dp*sum_error(balanced%force) + real(count(balanced%inner), dp)*balanced%missing) &
            + bounds%datum_rounding*sum(abs(balanced%force))
    balanced%motion_error = raised(terms, size(balanced%force) + 8) + tiny(terms)
    do k = 1, size(balanced%gap)
      associate (gap => balanced%gap(k), rounding => balanced%rounding(k))
        rounding = 4.0_dp*UNIT_ROUNDOFF*(abs(balanced%initial(k)) + abs(gap) + abs(constant))
        gap = (balanced%initial(k) + gap) + constant
        if (.not. is_balanced(problem)) rounding = rounding + balanced%motion_error
        if (balanced%compliance(k) > 0.0_dp) then
          gap = gap + balanced%compliance(k)*balanced%force(k)
          rounding = rounding + 4.0_dp*UNIT_ROUNDOFF*(abs(gap) + balanced%compliance(k)*abs(balanced%force(k)))
          if (balanced%inner(k)) rounding = rounding + balanced%compliance(k)*balanced%missing
        end if
        rounding = raised(rounding, 8) + tiny(1.0_dp)
      end associate
    end do
    force_norm = norm_bound(balanced%force)
    balanced%product_error = raised(bounds%rounding*force_norm + bounds%most*balanced%missing &
                                    *sqrt(real(count(balanced%inner), dp)), 6) + tiny(1.0_dp)
  end subroutine find_gaps

  !> One product with a unit force gives the displacement of a point by itself.
  subroutine find_own_displacement(operator, problem, bounds, balanced, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(operator_bounds), intent(in) :: bounds
    type(balanced_solution), intent(inout) :: balanced
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: displacement(:), force(:)
    integer :: stat

    allocate (force(size(balanced%force)), displacement(size(balanced%force)), stat=stat)
    call require_memory(stat, 'displacements of', size(balanced%force), 'points', info)
    if (stat /= 0) return
    force = 0.0_dp
    force(1) = 1.0_dp
    call multiply(operator, force, displacement, info)
    if (info%failed()) return
    balanced%own_displacement = raised(max(displacement(1), 0.0_dp) + bounds%rounding, 2)
    if (.not. is_balanced(problem)) balanced%own_displacement = raised(balanced%own_displacement &
                                                                       + max(operator%datum(), 0.0_dp) &
                                                                       + bounds%datum_rounding, 3)
  end subroutine find_own_displacement

  !> The error of the forces and of the motion.
  subroutine bound_errors(problem, bounds, balanced, reason)
    type(fuge_problem), intent(in) :: problem
    type(operator_bounds), intent(in) :: bounds
    type(balanced_solution), intent(inout) :: balanced
    character(len=:), allocatable, intent(inout) :: reason
    real(dp) :: apart, from_mean, moved, norm
    integer :: certain, k

    do k = 1, size(balanced%gap)
      balanced%violation(k) = raised(violation(balanced, k) + balanced%rounding(k), 2)
    end do
    norm = norm_bound(balanced%violation)
    norm = norm + balanced%product_error
    ! Quotients and products of small numbers may underflow.
    balanced%force_error = raised(norm/least_of(problem, bounds), 4) + tiny(norm)
    balanced%energy_error = raised(norm/sqrt(least_of(problem, bounds)), 5) + tiny(norm)
    balanced%displacement_error = raised(min(balanced%energy_error*sqrt(balanced%own_displacement), &
                                             bounds%most*balanced%force_error), 4) + tiny(norm)
    if (.not. balanced%force_error <= sqrt(huge(1.0_dp))) then
      reason = 'the bounds are out of the range of double precision: choose other units'
      return
    end if
    if (.not. is_balanced(problem)) return
    ! The mean of the gaps of points that are certainly at stops gives the motion.
    certain = 0
    from_mean = 0.0_dp
    do k = 1, size(balanced%gap)
      if (.not. force_is_certain(balanced, k)) cycle
      certain = certain + 1
      apart = abs(balanced%gap(k) - balanced%claims(k)%known) + balanced%rounding(k)
      from_mean = from_mean + apart + balanced%compliance(k)*balanced%force_error
    end do
    if (certain == 0) then
      reason = 'no point is certainly in contact, so that the motion is not bounded: solve to a smaller tolerance'
      return
    end if
    from_mean = raised(from_mean/real(certain, dp), size(balanced%gap) + 8)
    moved = min(balanced%displacement_error, bounds%most*balanced%force_error/sqrt(real(certain, dp)), &
                balanced%energy_error*sqrt(bounds%most/real(certain, dp)))
    balanced%motion_error = raised(balanced%motion_error + from_mean + moved &
                                   + balanced%product_error/sqrt(real(certain, dp)), 8) + tiny(norm)
  end subroutine bound_errors

  !> How far the gap of point `k` breaks the law at most, but for its rounding.
  pure function violation(balanced, k)
    type(balanced_solution), intent(in) :: balanced
    integer, intent(in) :: k
    real(dp) :: violation

    associate (claim => balanced%claims(k), gap => balanced%gap(k))
      if (claim%at_stop) then
        violation = raised(abs(gap - claim%known), 2)
      else
        violation = raised(max(claim%least - gap, gap - claim%most, 0.0_dp), 2)
      end if
    end associate
  end function violation

  !> Is the force of point `k` certainly within the range of its stop?
  pure function force_is_certain(balanced, k) result(certain)
    type(balanced_solution), intent(in) :: balanced
    integer, intent(in) :: k
    logical :: certain
    real(dp) :: error

    error = 2.0_dp*raised(balanced%force_error + balanced%missing, 4)
    associate (claim => balanced%claims(k), force => balanced%force(k))
      certain = claim%at_stop .and. force - claim%least > error .and. claim%most - force > error
    end associate
  end function force_is_certain

  subroutine fill_proof(problem, solution, balanced, proof)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(balanced_solution), intent(in) :: balanced
    type(fuge_proof), intent(inout) :: proof
    real(dp) :: error, moved
    integer :: k, state

    moved = raised(balanced%displacement_error + balanced%product_error, 3)
    if (is_balanced(problem)) moved = raised(moved + balanced%motion_error, 2)
    do k = 1, size(balanced%gap)
      error = abs(balanced%claimed_force(k) - balanced%force(k)) + balanced%force_error
      if (balanced%inner(k)) error = error + balanced%missing
      proof%force_bound(k) = raised(error, 4)
      error = raised(moved + balanced%rounding(k) + balanced%compliance(k)*balanced%force_error, 5)
      associate (claim => balanced%claims(k), gap => balanced%gap(k))
        proof%gap_bound(k) = raised(abs(balanced%claimed_gap(k) - gap) + error, 3)
        if (force_is_certain(balanced, k)) proof%gap_bound(k) = raised(abs(balanced%claimed_gap(k) - claim%known), 2)
        proof%state_proved(k) = force_is_certain(balanced, k) &
                                .or. (.not. claim%at_stop .and. gap - 2.0_dp*error > claim%least &
                                      .and. gap + 2.0_dp*error < claim%most)
        if (proof%state_proved(k)) then
          state = state_of(problem, solution, k)
          proof%state_proved(k) = state == state_by_law(problem%law(k), state)
        end if
      end associate
    end do
    if (is_balanced(problem)) then
      proof%motion_bound = balanced%motion_error
    else if (problem%mode_count() == 1) then
      proof%motion_bound = raised(abs(solution%motion - problem%motion), 2)
    end if
  end subroutine fill_proof

end module fuge_spectral_proof
