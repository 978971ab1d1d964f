!> Forces and motion of a given contact set, to the last digits, and what is wrong with
!> them.
!>
!> Displacements are those of alpha less `datum`, the coefficient of all of alpha nearest
!> to zero: a constant that only the motion sees, and that costs no digits.
module fuge_kkt_solution
  use fuge_kkt_factor, only: contact_factor
  use fuge_kinds, only: dp, xp
  implicit none
  private

  public :: solve_set, displaced, refine, add_deflection, violations, terms_of, largest_term, motion_at_shallowest

  !> A correction above this part of the forces calls for another one.
  real(dp), parameter :: EXACT_ENOUGH = 1.0e-13_dp
  !> Spread of the pivots below which double precision is enough for a residual.
  real(dp), parameter :: WELL_CONDITIONED = 1.0e4_dp
  integer, parameter :: REFINEMENTS = 10

contains

  !> Forces (n) and motions (m) with shape + (alpha - datum) F - R q = 0 on the contact
  !> set of `factor` and R^T F = load, not refined. `reduced_gap` (n), length; `load` (m);
  !> `datum` is zero unless the first motion is a translation.
  subroutine solve_set(factor, datum, reduced_gap, load, force, motion)
    type(contact_factor), intent(in) :: factor
    real(dp), intent(in) :: datum, reduced_gap(:), load(:)
    real(dp), intent(out) :: force(:), motion(:)

    call factor%solve(reduced_gap, load, force, motion)
    call change_datum(factor%datum - datum, load, motion)
  end subroutine solve_set

  !> Another constant taken out of alpha moves the translation.
  pure subroutine change_datum(difference, load, motion)
    real(dp), intent(in) :: difference, load(:)
    real(dp), intent(inout) :: motion(:)

    if (abs(difference) > 0.0_dp) motion(1) = motion(1) + difference*load(1)
  end subroutine change_datum

  !> R q at each point, (n).
  pure function displaced(modes, motion) result(length)
    real(dp), intent(in), contiguous :: modes(:, :)
    real(dp), intent(in) :: motion(:)
    real(dp) :: length(size(modes, 1))
    integer :: j

    length = 0.0_dp
    do j = 1, size(motion)
      length = length + modes(:, j)*motion(j)
    end do
  end function displaced

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

  !> Forces of the wrong sign on the contact set as parts of the largest force, gaps
  !> beyond a stop off it as parts of a length.
  !>
  !> `distance` (n) is the gap less the motion: what the displacement has to make up
  !> for at a point in contact. `terms` (n) is what the displacement is made of. `state`
  !> (n) is 1 at the lower stop, -1 at the upper one, 0 between; `upper` (n) the play;
  !> tied points (play 0) and `excluded` ones cannot be wrong. A force up to `zero_force` is
  !> rounding.
  pure function violations(distance, terms, state, upper, excluded, zero_force, force, gap_out) result(violation)
    real(dp), intent(in) :: distance(:), terms(:), upper(:), zero_force, force(:), gap_out(:)
    integer, intent(in) :: state(:)
    logical, intent(in) :: excluded(:)
    real(dp) :: violation(size(state))
    real(dp) :: largest, beyond
    integer :: j

    largest = maxval(abs(force))
    violation = 0.0_dp
    do j = 1, size(state)
      if (excluded(j) .or. .not. upper(j) > 0.0_dp) cycle
      if (state(j) /= 0) then
        if (force(j)*state(j) < -zero_force) violation(j) = abs(force(j))/largest
      else
        beyond = max(-gap_out(j), gap_out(j) - upper(j))
        if (beyond > 0.0_dp) violation(j) = beyond/max(abs(distance(j)) + terms(j), beyond)
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
  !> For one translation, one-sided.
  pure function motion_at_shallowest(alpha, datum, reduced_gap, contact, force, motion) result(anew)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum, reduced_gap(:), force(:), motion
    logical, intent(in) :: contact(:)
    real(dp) :: anew
    real(dp) :: length(size(reduced_gap))
    integer :: j, k, n

    n = size(reduced_gap)
    length = abs(reduced_gap - motion) + terms_of(alpha, datum, contact, force)
    ! A force that may be rounding is no contact.
    k = minloc(length, dim=1, mask=contact .and. force > sqrt(epsilon(motion))*maxval(force))
    anew = reduced_gap(k)
    do j = 1, n
      if (contact(j)) anew = anew + (alpha(k, j) - datum)*force(j)
    end do
  end function motion_at_shallowest

  !> Iterative refinement on the contact set. For a well-conditioned alpha one residual
  !> in double precision does; otherwise residuals are in extended precision, which
  !> sees errors of the forces that double precision cannot. With the ridge of the
  !> factor the system solved is that of alpha and the ridge, with 0 that of alpha.
  subroutine refine(alpha, datum, modes, reduced_gap, load, factor, ridge, contact, force, motion)
    real(dp), intent(in), contiguous :: alpha(:, :), modes(:, :)
    real(dp), intent(in) :: datum, reduced_gap(:), load(:), ridge
    type(contact_factor), intent(in) :: factor
    logical, intent(in) :: contact(:)
    real(dp), intent(inout) :: force(:), motion(:)
    real(dp) :: residual(size(reduced_gap)), correction(size(reduced_gap)), missing(size(load)), shift(size(load)), &
      change, last
    integer :: step

    if (factor%spread < WELL_CONDITIONED .and. .not. factor%ridge > 0.0_dp) then
      residual = reduced_gap - displaced(modes, motion)
      call add_deflection(alpha, datum, contact, force, residual)
      missing = load - matmul(force, modes)
    else
      call extended_residual(alpha, modes, reduced_gap, load, datum, ridge, contact, force, motion, residual, missing)
    end if
    last = huge(last)
    do step = 1, REFINEMENTS
      call factor%solve(residual, missing, correction, shift)
      change = maxval(abs(correction))
      if (.not. change < 0.5_dp*last) exit
      force = force + correction
      call change_datum(factor%datum - datum, missing, shift)
      motion = motion + shift
      if (change <= EXACT_ENOUGH*maxval(abs(force))) exit
      last = change
      call extended_residual(alpha, modes, reduced_gap, load, datum, ridge, contact, force, motion, residual, missing)
    end do
  end subroutine refine

  !> The residual of gaps and equilibrium on the contact set.
  pure subroutine extended_residual(alpha, modes, reduced_gap, load, datum, ridge, contact, force, motion, residual, &
                                    missing)
    real(dp), intent(in), contiguous :: alpha(:, :), modes(:, :)
    real(dp), intent(in) :: reduced_gap(:), load(:), datum, ridge, force(:), motion(:)
    logical, intent(in) :: contact(:)
    real(dp), intent(out) :: residual(:), missing(:)
    real(xp) :: sums(size(reduced_gap))
    integer :: j, n

    n = size(reduced_gap)
    sums = real(reduced_gap, xp) + real(ridge, xp)*real(force, xp)
    do j = 1, n
      if (contact(j)) sums = sums + (real(alpha(:n, j), xp) - real(datum, xp))*real(force(j), xp)
    end do
    do j = 1, size(load)
      sums = sums - real(modes(:, j), xp)*real(motion(j), xp)
      missing(j) = real(real(load(j), xp) - sum(real(modes(:, j), xp)*real(force, xp)), dp)
    end do
    residual = real(sums, dp)
  end subroutine extended_residual

end module fuge_kkt_solution
