!> Forces and motion of a given contact set, to the last digits, and what is wrong with
!> them.
!>
!> Displacements are those of alpha less `datum`, the coefficient of all of alpha nearest
!> to zero: a constant that only the motion sees, and that costs no digits.
module fuge_set_answer
  use fuge_contact_factor, only: contact_factor
  use fuge_kinds, only: dp, xp
  implicit none
  private

  public :: solve_set, refine, add_deflection, violations, terms_of, largest_term, motion_at_shallowest

  !> A correction above this part of the forces calls for another one.
  real(dp), parameter :: EXACT_ENOUGH = 1.0e-13_dp
  !> Spread of the pivots below which double precision is enough for a residual.
  real(dp), parameter :: WELL_CONDITIONED = 1.0e4_dp
  integer, parameter :: REFINEMENTS = 10

contains

  !> Forces (n) and motion with shape + (alpha - datum) F - motion = 0 on the contact set
  !> of `factor` and sum F = load, not refined. `shape` (n), length.
  subroutine solve_set(factor, datum, shape, load, force, motion)
    type(contact_factor), intent(in) :: factor
    real(dp), intent(in) :: datum, shape(:), load
    real(dp), intent(out) :: force(:), motion

    call factor%solve(shape, load, force, motion)
    motion = motion + (factor%datum - datum)*load
  end subroutine solve_set

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
  !> for at a point in contact. `terms` (n) is what the displacement is made of.
  pure function violations(distance, terms, contact, force, gap_out) result(violation)
    real(dp), intent(in) :: distance(:), terms(:), force(:), gap_out(:)
    logical, intent(in) :: contact(:)
    real(dp) :: violation(size(contact))
    real(dp) :: largest
    integer :: j

    largest = maxval(abs(force))
    violation = 0.0_dp
    do j = 1, size(contact)
      if (contact(j)) then
        if (force(j) < 0.0_dp) violation(j) = -force(j)/largest
      else if (gap_out(j) < 0.0_dp) then
        violation(j) = -gap_out(j)/max(abs(distance(j)) + terms(j), -gap_out(j))
      end if
    end do
  end function violations

  !> sum_j |alpha_kj - datum| |F_j|, (n): lengths that cancel in a displacement.
  pure function terms_of(alpha, datum, contact, force) result(terms)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum, force(:)
    logical, intent(in) :: contact(:)
    real(dp) :: terms(size(contact))
    integer :: j

    terms = 0.0_dp
    do j = 1, size(contact)
      if (contact(j)) terms = terms + abs((alpha(:size(contact), j) - datum)*force(j))
    end do
  end function terms_of

  !> The largest of these terms alone: less, but for the cost of one column.
  pure function largest_term(alpha, datum, force) result(term)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum, force(:)
    real(dp) :: term(size(force))
    integer :: k

    k = maxloc(abs(force), dim=1)
    term = abs((alpha(:size(force), k) - datum)*force(k))
  end function largest_term

  !> The motion anew from the contact point where the least lengths make it, so that one
  !> that is exactly zero comes out as zero.
  pure function motion_at_shallowest(alpha, datum, shape, contact, force, motion) result(anew)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum, shape(:), force(:), motion
    logical, intent(in) :: contact(:)
    real(dp) :: anew
    real(dp) :: length(size(shape))
    integer :: j, k, n

    n = size(shape)
    length = abs(shape - motion) + terms_of(alpha, datum, contact, force)
    ! A force that may be rounding is no contact.
    k = minloc(length, dim=1, mask=contact .and. force > sqrt(epsilon(motion))*maxval(force))
    anew = shape(k)
    do j = 1, n
      if (contact(j)) anew = anew + (alpha(k, j) - datum)*force(j)
    end do
  end function motion_at_shallowest

  !> Iterative refinement on the contact set. For a well-conditioned alpha one residual
  !> in double precision does; otherwise residuals are in extended precision, which
  !> sees errors of the forces that double precision cannot. With the ridge of the
  !> factor the system solved is that of alpha and the ridge, with 0 that of alpha.
  subroutine refine(alpha, datum, shape, load, factor, ridge, contact, force, motion)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum, shape(:), load, ridge
    type(contact_factor), intent(in) :: factor
    logical, intent(in) :: contact(:)
    real(dp), intent(inout) :: force(:), motion
    real(dp) :: residual(size(shape)), correction(size(shape)), missing, shift, change, last
    integer :: step

    if (factor%spread < WELL_CONDITIONED .and. .not. factor%ridge > 0.0_dp) then
      residual = shape - motion
      call add_deflection(alpha, datum, contact, force, residual)
      missing = load - sum(force)
    else
      call extended_residual(alpha, shape, load, datum, ridge, contact, force, motion, residual, missing)
    end if
    last = huge(last)
    do step = 1, REFINEMENTS
      call factor%solve(residual, missing, correction, shift)
      change = maxval(abs(correction))
      if (.not. change < 0.5_dp*last) exit
      force = force + correction
      motion = motion + (shift + (factor%datum - datum)*missing)
      if (change <= EXACT_ENOUGH*maxval(abs(force))) exit
      last = change
      call extended_residual(alpha, shape, load, datum, ridge, contact, force, motion, residual, missing)
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

end module fuge_set_answer
