!> The fast engine for a dense matrix: block principal pivoting.
!>
!> Solve the equations of a guessed contact set, let every point that violates a sign
!> change sides, repeat (J. J. Judice, F. M. Pires, Computers & Operations Research
!> 21, 1994). When the number of violations has not fallen for a while, only the
!> violating point of least index changes sides until it has: the least-index
!> criss-cross method, finite for every positive definite alpha (D. den Hertog,
!> C. Roos, T. Terlaky, Linear Algebra and its Applications 187, 1993).
module fuge_active_set
  use fuge_contact_factor, only: contact_factor
  use fuge_kinds, only: dp, xp
  use fuge_status, only: FUGE_DONE, FUGE_ERR_ITERATION_LIMIT
  implicit none
  private

  public :: run_active_set, add_deflection, keep_first

  !> Violations below this part of the largest force, or of a length, are rounding.
  real(dp), parameter :: SIGN_TOLERANCE = 1.0e-14_dp
  !> Block changes without progress before single ones.
  integer, parameter, public :: PATIENCE = 3
  !> Violations below this part that keep coming back are rounding too; a large spread
  !> of the pivots raises it.
  real(dp), parameter :: NOISE = 1.0e-11_dp
  real(dp), parameter :: NOISE_GROWTH = 1.0e-8_dp
  !> Spread of the pivots above which signs are judged after refinement only.
  real(dp), parameter :: ILL_CONDITIONED = 1.0e8_dp
  !> A correction above this part of the forces calls for another one.
  real(dp), parameter :: EXACT_ENOUGH = 1.0e-13_dp
  !> Spread of the pivots below which double precision is enough for a residual.
  real(dp), parameter :: WELL_CONDITIONED = 1.0e4_dp
  integer, parameter :: REFINEMENTS = 10

contains

  !> From a guess to the contact set, its forces and gaps.
  !>
  !> `alpha` (at least n rows, n columns), `gap` (n), `load` > 0; `contact` (n) the
  !> guess, then the set, never empty; `factor` is that of the set on return; out:
  !> `force` (n), `gap_out` (n), `approach`. `iterations` counts the sets tried.
  !> Errors: FUGE_ERR_MEMORY, FUGE_ERR_NOT_DEFINITE, FUGE_ERR_ITERATION_LIMIT.
  subroutine run_active_set(alpha, gap, load, limit, factor, contact, force, gap_out, approach, iterations, status)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: gap(:), load
    integer, intent(in) :: limit
    type(contact_factor), intent(inout) :: factor
    logical, intent(inout) :: contact(:)
    real(dp), intent(out) :: force(:), gap_out(:), approach
    integer, intent(out) :: iterations, status
    real(dp) :: shape(size(gap)), violation(size(gap)), motion, base
    logical :: wrong(size(gap)), careful, fresh
    integer :: fewest, patience_left

    base = minval(gap)
    shape = gap - base
    fewest = huge(fewest)
    patience_left = PATIENCE
    iterations = 0
    careful = .false.
    fresh = .true.
    do
      call factor%set(alpha, contact, status)
      if (status /= FUGE_DONE) return
      call factor%solve(shape, load, force, motion)
      if (fresh) iterations = iterations + 1
      fresh = .false.
      careful = careful .or. factor%spread > ILL_CONDITIONED .or. factor%ridge > 0.0_dp
      if (careful) then
        ! Gaps are counted from where the bodies meet: one point far below the others
        ! would cost them digits.
        base = gap(minloc(abs(shape - motion), dim=1))
        shape = gap - base
        call factor%solve(shape, load, force, motion)
        call refine(alpha, shape, load, factor, factor%ridge, contact, force, motion)
      end if
      gap_out = shape - motion
      call add_deflection(alpha, factor%datum, contact, force, gap_out)
      violation = violations(alpha, factor%datum, shape - motion, contact, force, gap_out)
      wrong = violation > SIGN_TOLERANCE
      if (.not. any(wrong)) then
        if (careful) exit
        ! Once more with care, before the set is believed.
        careful = .true.
        cycle
      end if
      ! What neither goes away nor shows is rounding; the certificate has the last word.
      if (patience_left < 0 .and. maxval(violation) < NOISE*max(1.0_dp, NOISE_GROWTH*factor%spread)) exit
      if (iterations >= limit) then
        status = FUGE_ERR_ITERATION_LIMIT
        return
      end if
      if (count(wrong) < fewest) then
        fewest = count(wrong)
        patience_left = PATIENCE
      else
        patience_left = patience_left - 1
      end if
      careful = patience_left < PATIENCE
      if (patience_left < 0) call keep_first(wrong)
      contact = contact .neqv. wrong
      fresh = .true.
    end do
    if (factor%ridge > 0.0_dp) call refine(alpha, shape, load, factor, 0.0_dp, contact, force, motion)
    force = max(force, 0.0_dp)
    gap_out = shape - motion
    call add_deflection(alpha, factor%datum, contact, force, gap_out)
    gap_out = max(gap_out, 0.0_dp)
    where (contact) gap_out = 0.0_dp
    approach = (motion + factor%datum*load) + base
  end subroutine run_active_set

  !> u := u + (alpha - datum) F, with the columns of the contact only.
  !>
  !> Not by BLAS: taking the datum out of each product is what keeps its digits.
  pure subroutine add_deflection(alpha, datum, contact, force, u)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum, force(:)
    logical, intent(in) :: contact(:)
    real(dp), intent(inout) :: u(:)
    integer :: j, n

    n = size(u)
    do j = 1, n
      if (contact(j)) u = u + (alpha(:n, j) - datum)*force(j)
    end do
  end subroutine add_deflection

  !> Pulling forces on the contact set as parts of the largest force, negative gaps off
  !> it as parts of a length.
  !>
  !> `distance` (n) is the gap less the motion: what the displacement has to make up
  !> for at a point in contact.
  pure function violations(alpha, datum, distance, contact, force, gap_out) result(violation)
    real(dp), intent(in) :: alpha(:, :), datum, distance(:), force(:), gap_out(:)
    logical, intent(in) :: contact(:)
    real(dp) :: violation(size(contact))
    real(dp) :: largest, length
    integer :: j, k

    ! The point with the largest force stands for all in the length of a displacement.
    k = maxloc(abs(force), dim=1)
    largest = abs(force(k))
    violation = 0.0_dp
    do j = 1, size(contact)
      if (contact(j)) then
        if (force(j) < 0.0_dp) violation(j) = -force(j)/largest
      else if (gap_out(j) < 0.0_dp) then
        length = abs(distance(j)) + abs(alpha(j, k) - datum)*largest
        violation(j) = min(-gap_out(j)/max(length, -gap_out(j)), 1.0_dp)
      end if
    end do
  end function violations

  !> Only the true element of least index stays true.
  pure subroutine keep_first(mask)
    logical, intent(inout) :: mask(:)
    integer :: k

    do k = 1, size(mask)
      if (.not. mask(k)) cycle
      mask(k + 1:) = .false.
      return
    end do
  end subroutine keep_first

  !> Iterative refinement on the contact set. For a well-conditioned alpha one residual
  !> in double precision does; otherwise residuals are in extended precision, which
  !> sees errors of the forces that double precision cannot. With the ridge of the
  !> factor the system solved is that of alpha and the ridge, with 0 that of alpha.
  subroutine refine(alpha, shape, load, factor, ridge, contact, force, motion)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: shape(:), load, ridge
    type(contact_factor), intent(in) :: factor
    logical, intent(in) :: contact(:)
    real(dp), intent(inout) :: force(:), motion
    real(dp) :: residual(size(shape)), correction(size(shape)), missing, shift, change, last
    integer :: step

    if (factor%spread < WELL_CONDITIONED .and. .not. factor%ridge > 0.0_dp) then
      residual = shape - motion
      call add_deflection(alpha, factor%datum, contact, force, residual)
      missing = load - sum(force)
    else
      call extended_residual(alpha, shape, load, factor%datum, ridge, contact, force, motion, residual, missing)
    end if
    last = huge(last)
    do step = 1, REFINEMENTS
      call factor%solve(residual, missing, correction, shift)
      change = maxval(abs(correction))
      if (.not. change < 0.5_dp*last) exit
      force = force + correction
      motion = motion + shift
      if (change <= EXACT_ENOUGH*maxval(abs(force))) exit
      last = change
      call extended_residual(alpha, shape, load, factor%datum, ridge, contact, force, motion, residual, missing)
    end do
  end subroutine refine

  !> The residual of gaps and equilibrium on the contact set.
  pure subroutine extended_residual(alpha, shape, load, datum, ridge, contact, force, motion, residual, missing)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: shape(:), load, datum, ridge, force(:), motion
    logical, intent(in) :: contact(:)
    real(dp), intent(out) :: residual(:), missing
    real(xp) :: sums(size(shape)), total
    integer :: j, n

    n = size(shape)
    sums = real(shape, xp) - real(motion, xp) + real(ridge, xp)*real(force, xp)
    total = real(load, xp)
    do j = 1, n
      if (.not. contact(j)) cycle
      sums = sums + (real(alpha(:n, j), xp) - real(datum, xp))*real(force(j), xp)
      total = total - real(force(j), xp)
    end do
    residual = real(sums, dp)
    missing = real(total, dp)
  end subroutine extended_residual

end module fuge_active_set
