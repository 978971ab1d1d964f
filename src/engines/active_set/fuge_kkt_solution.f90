!> Forces and motion of a given contact set, solved with its factor and refined to the last digits.
module fuge_kkt_solution
  use fuge_canonical_problem, only: canonical_problem
  use fuge_displacements, only: add_elastic_displacement, displacement_magnitude, rigid_displacement
  use fuge_kinds, only: dp, xp
  use fuge_kkt_factor, only: kkt_factor
  implicit none
  private

  public :: refine_solution, solve_set, translation_at_shallowest

  !> A correction above this fraction of the largest force calls for another one.
  real(dp), parameter :: EXACT_ENOUGH = 1.0e-13_dp
  !> Ratio of the pivots below which double precision is enough for a residual.
  real(dp), parameter :: WELL_CONDITIONED = 1.0e4_dp
  integer, parameter :: REFINEMENTS = 10

contains

  !> Forces (n) and motions (m) with reduced_gap + (alpha - datum) f - R q = 0 on the contact set of `factor` and
  !> R^T f = load, not refined. `reduced_gap` (n), length; `load` (m); `datum` is zero unless the first mode is a
  !> translation.
  subroutine solve_set(factor, datum, reduced_gap, load, force, motion)
    type(kkt_factor), intent(in) :: factor
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

  !> The translation recomputed from the contact point with the smallest terms, so that a translation of exactly zero is
  !> returned as zero. For the plain problem.
  pure function translation_at_shallowest(alpha, datum, reduced_gap, contact, force, motion) result(translation)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum, reduced_gap(:), force(:), motion
    logical, intent(in) :: contact(:)
    real(dp) :: translation
    real(dp) :: magnitude(size(reduced_gap))
    integer :: j, k, n

    n = size(reduced_gap)
    magnitude = abs(reduced_gap - motion) + displacement_magnitude(alpha, datum, contact, force)
    ! A point whose force may be rounding does not count as in contact.
    k = minloc(magnitude, dim=1, mask=contact .and. force > sqrt(epsilon(motion))*maxval(force))
    translation = reduced_gap(k)
    do j = 1, n
      if (contact(j)) translation = translation + (alpha(k, j) - datum)*force(j)
    end do
  end function translation_at_shallowest

  !> Iterative refinement of forces and motion on the contact set.
  !>
  !> For a well-conditioned alpha one residual in double precision is enough; otherwise residuals are in extended
  !> precision, which sees errors of the forces that double precision cannot. With the `regularisation` of the factor
  !> the system solved is that of the regularised alpha, with 0 that of alpha. `gap` (n) as in `solve_set`.
  subroutine refine_solution(canonical, gap, factor, regularisation, contact, force, motion)
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: gap(:), regularisation
    type(kkt_factor), intent(in) :: factor
    logical, intent(in) :: contact(:)
    real(dp), intent(inout) :: force(:), motion(:)
    real(dp) :: residual(size(gap)), correction(size(gap)), missing(size(motion)), shift(size(motion)), change, last
    integer :: step

    if (factor%pivot_ratio < WELL_CONDITIONED .and. .not. factor%regularisation > 0.0_dp) then
      residual = gap - rigid_displacement(canonical%modes, motion)
      call add_elastic_displacement(canonical%alpha, canonical%datum, contact, force, residual)
      missing = canonical%load - matmul(force, canonical%modes)
    else
      call extended_residual(canonical, gap, regularisation, contact, force, motion, residual, missing)
    end if
    last = huge(last)
    do step = 1, REFINEMENTS
      call factor%solve(residual, missing, correction, shift)
      change = maxval(abs(correction))
      if (.not. change < 0.5_dp*last) exit
      force = force + correction
      call change_datum(factor%datum - canonical%datum, missing, shift)
      motion = motion + shift
      if (change <= EXACT_ENOUGH*maxval(abs(force))) exit
      last = change
      call extended_residual(canonical, gap, regularisation, contact, force, motion, residual, missing)
    end do
  end subroutine refine_solution

  !> Residuals of the gaps (n), meant on the contact set, and of equilibrium (m).
  pure subroutine extended_residual(canonical, gap, regularisation, contact, force, motion, residual, missing)
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: gap(:), regularisation, force(:), motion(:)
    logical, intent(in) :: contact(:)
    real(dp), intent(out) :: residual(:), missing(:)
    real(xp) :: sums(size(gap))
    integer :: j, n

    n = size(gap)
    sums = real(gap, xp) + real(regularisation, xp)*real(force, xp)
    do j = 1, n
      if (contact(j)) sums = sums + (real(canonical%alpha(:n, j), xp) - real(canonical%datum, xp))*real(force(j), xp)
    end do
    do j = 1, size(motion)
      sums = sums - real(canonical%modes(:, j), xp)*real(motion(j), xp)
      missing(j) = real(real(canonical%load(j), xp) - sum(real(canonical%modes(:, j), xp)*real(force, xp)), dp)
    end do
    residual = real(sums, dp)
  end subroutine extended_residual

end module fuge_kkt_solution
