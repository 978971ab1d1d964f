!> The equations of a piece of a path, for its values and for its rates: gaps that follow from forces and motions, and
!> iterative refinement of these.
module fuge_path_equations
  use fuge_canonical_problem, only: canonical_problem
  use fuge_contact_states, only: is_at_stop, FUGE_OPEN
  use fuge_displacements, only: rigid_displacement
  use fuge_kinds, only: dp, xp
  use fuge_path_factor, only: path_factor
  use fuge_row_displacements, only: add_displacement, extended_gaps
  use fuge_unresisted_motions, only: without_unresisted
  implicit none
  private

  public :: correct, open_gaps

  !> A correction above this fraction of the largest force calls for another one.
  real(dp), parameter :: EXACT_ENOUGH = 1.0e-13_dp
  !> Values are corrected at most this many times.
  integer, parameter :: REFINEMENTS = 10

contains

  !> Gaps of the points that are not at a stop, `open_gap` (n), from `gap` without displacements, or rates of these;
  !> `flexibility` is that of the line.
  subroutine open_gaps(canonical, flexibility, factor, state, gap, force, motion, open_gap)
    type(canonical_problem), intent(in) :: canonical
    type(path_factor), intent(in) :: factor
    integer, intent(in) :: state(:)
    real(dp), intent(in) :: flexibility, gap(:), force(:), motion(:)
    real(dp), intent(inout) :: open_gap(:)

    if (factor%is_well_conditioned()) then
      open_gap = gap - rigid_displacement(canonical%modes, motion)
      call add_displacement(canonical, flexibility, .not. is_at_stop(state), state /= FUGE_OPEN, force, open_gap)
    else
      open_gap = extended_gaps(canonical, state, gap, force, motion)
    end if
  end subroutine open_gaps

  !> Iterative refinement, with residuals in extended precision unless the factor is well conditioned: c = gap + A f -
  !> R q = 0 on the contact set, R^T f = load. Forces of points that are not at a stop stay, and so do motions along the
  !> columns of `unresisted`. Nine arguments, because values and rates have the same equations.
  subroutine correct(canonical, flexibility, factor, gap, load, state, unresisted, force, motion)
    type(canonical_problem), intent(in) :: canonical
    type(path_factor), intent(in) :: factor
    real(dp), intent(in) :: flexibility, gap(:), load(:), unresisted(:, :)
    integer, intent(in) :: state(:)
    real(dp), intent(inout) :: force(:), motion(:)
    real(dp) :: residual(size(gap)), correction(size(gap)), missing(size(motion)), shift(size(motion)), change, last
    integer :: points(count(is_at_stop(state))), k, step

    points = pack([(k, k=1, size(state))], is_at_stop(state))
    residual = 0.0_dp
    last = huge(last)
    do step = 1, REFINEMENTS
      if (factor%is_well_conditioned()) then
        residual = gap - rigid_displacement(canonical%modes, motion)
        call add_displacement(canonical, flexibility, is_at_stop(state), state /= FUGE_OPEN, force, residual)
        missing = load - matmul(force, canonical%modes)
      else
        call extended_residual(canonical, gap, load, state, points, force, motion, residual, missing)
      end if
      call factor%solve(canonical, residual, missing, correction, shift)
      change = maxval(abs(correction))
      if (.not. change < 0.5_dp*last) exit
      force = force + correction
      motion = motion + without_unresisted(shift, unresisted)
      if (factor%is_well_conditioned() .or. change <= EXACT_ENOUGH*maxval(abs(force))) exit
      last = change
    end do
  end subroutine correct

  !> Residuals of the gaps (n), at the `points` at stops, and of equilibrium (m), in extended precision. Nine arguments,
  !> as for `correct`.
  pure subroutine extended_residual(canonical, gap, load, state, points, force, motion, residual, missing)
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: gap(:), load(:), force(:), motion(:)
    integer, intent(in) :: state(:), points(:)
    real(dp), intent(inout) :: residual(:)
    real(dp), intent(out) :: missing(:)
    real(xp) :: sums(size(points))
    integer :: j

    sums = real(gap(points), xp)
    do j = 1, size(motion)
      sums = sums - real(canonical%modes(points, j), xp)*real(motion(j), xp)
      missing(j) = real(real(load(j), xp) - sum(real(canonical%modes(:, j), xp)*real(force, xp), &
                                                mask=state /= FUGE_OPEN), dp)
    end do
    do j = 1, size(state)
      if (state(j) == FUGE_OPEN) cycle
      sums = sums + (real(canonical%alpha(points, j), xp) - real(canonical%datum, xp))*real(force(j), xp)
    end do
    residual(points) = real(sums, dp)
  end subroutine extended_residual

end module fuge_path_equations
