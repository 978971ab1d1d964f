!> Derivatives of a solution with respect to gaps, loads and prescribed motions.
module fuge_sensitivity
  use fuge_canonical_problem, only: canonical_problem
  use fuge_contact_states, only: is_at_stop
  use fuge_displacements, only: add_displacement_at, add_elastic_displacement, rigid_displacement
  use fuge_kinds, only: dp
  use fuge_kkt_factor, only: kkt_factor
  use fuge_kkt_solution, only: solve_set
  use fuge_matrix_operator, only: fuge_dense_operator
  use fuge_problem_type, only: fuge_solution
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_CALL_ORDER
  use fuge_unresisted_motions, only: find_unresisted_basis, refuse_unresisted, without_unresisted
  implicit none
  private

  public :: find_derivative

  !> Changes of the gaps that differ from a rigid motion by at most this fraction of their terms count as one.
  real(dp), parameter :: RIGID_TOLERANCE = 1.0e-13_dp
  !> Gaps on the contact that stay open by more than this fraction of their terms show a factor of another matrix, not
  !> rounding.
  real(dp), parameter :: CLOSED_TOLERANCE = 1.0e-8_dp
  !> A large datum may be rounded by this many units in its last place.
  real(dp), parameter :: ROUNDINGS = 64.0_dp
  !> Corrections where the gaps do not close, as those of a regularised factor; else one is enough.
  integer, parameter :: MOST_CORRECTIONS = 6

contains

  !> Changes of forces, gaps and motions at a fixed contact set, by solves with its factor.
  !>
  !> `operator` that of the solve; `factor` of the set in `state` (n); `gap_change` (n) length, `load_change` (m) of the
  !> resultants, of prescribed motions the change of the motion; `change` in the order of `fuge_solution`. The arguments
  !> are nine, because changes of open gaps may be left out: `wanted` (n) says where they are needed, which is
  !> everywhere without it. Errors, `change` untouched: FUGE_ERR_NO_EQUILIBRIUM if the contact set does not resist a
  !> mode that the changes load, FUGE_ERR_CALL_ORDER if the factor does not belong to the matrix, which has changed in
  !> place, FUGE_ERR_MEMORY.
  subroutine find_derivative(canonical, operator, factor, state, gap_change, load_change, change, info, wanted)
    type(canonical_problem), intent(in) :: canonical
    class(fuge_dense_operator), intent(in) :: operator
    type(kkt_factor), intent(in) :: factor
    integer, intent(in) :: state(:)
    real(dp), intent(in) :: gap_change(:), load_change(:)
    type(fuge_solution), intent(inout) :: change
    type(fuge_info), intent(inout) :: info
    logical, intent(in), optional :: wanted(:)
    real(dp), allocatable :: force(:), gap(:), motion(:), reduced_gap(:), load(:), unresisted(:, :)
    real(dp) :: datum, free_motion(size(canonical%load))
    logical, target :: contact(size(state)), passed_over(size(state))
    logical :: fits
    integer :: stat

    allocate (force(size(state)), gap(size(state)), motion(size(load_change)), stat=stat)
    call require_memory(stat, 'the derivatives of', size(state), 'points', info)
    if (stat /= 0) return
    contact = is_at_stop(state)
    datum = merge(operator%datum(), 0.0_dp, canonical%has_translation)
    call canonical%transform_change(gap_change, load_change, reduced_gap, load, info)
    if (info%failed()) return
    call find_unresisted_basis(canonical%modes, contact, unresisted)
    call refuse_unresisted(load, unresisted, info)
    if (info%failed()) return
    call solve_refined(canonical, operator%alpha, [datum, factor%datum], factor, contact, reduced_gap, load, &
                       force, free_motion, fits)
    free_motion = without_unresisted(free_motion, unresisted)
    if (is_rigid(canonical%modes, reduced_gap, load, free_motion, contact)) force = 0.0_dp
    gap = reduced_gap - rigid_displacement(canonical%modes, free_motion)
    if (present(wanted)) then
      passed_over = .not. (wanted .or. (contact .and. .not. fits))
      call add_displacement_at(operator%alpha, datum, contact, passed_over, force, gap)
    else
      call add_elastic_displacement(operator%alpha, datum, contact, force, gap)
    end if
    ! A regularised factor leaves gaps open where the changes do not fit to a singular alpha.
    if (.not. (fits .or. factor%regularisation > 0.0_dp)) fits = is_closed(canonical%modes, operator%alpha, &
      [datum, factor%datum], contact, reduced_gap, force, free_motion, gap)
    if (.not. (fits .or. factor%regularisation > 0.0_dp)) then
      call report(info, FUGE_ERR_CALL_ORDER, 'the factor of the last solve does not fit alpha: set a new operator ' &
                  //'after a change of alpha, and solve again; or alpha is too badly conditioned')
      return
    end if
    where (contact) gap = 0.0_dp
    if (canonical%has_translation) free_motion(1) = free_motion(1) + datum*load(1)
    call canonical%to_given_modes(load_change, free_motion, motion)
    if (present(wanted)) then
      if (any(wanted .and. canonical%excluded)) call canonical%set_excluded_gaps(operator%alpha, gap_change, force, &
                                                                                   motion, gap)
      where (.not. wanted) gap = 0.0_dp
    else
      call canonical%set_excluded_gaps(operator%alpha, gap_change, force, motion, gap)
    end if
    call move_alloc(force, change%force)
    call move_alloc(gap, change%gap)
    call move_alloc(motion, change%motion)
  end subroutine find_derivative

  !> Forces (n) and free motions (m) of the set in `contact` (n), whose factor has lost digits where alpha is badly
  !> conditioned or there are several modes: corrected by the residuals, once where the gaps were closed before that
  !> already, but for rounding, `fits`. The arguments are ten, because the datum is taken out of alpha for the
  !> residuals: `datums` that of the operator, and that of the factor.
  subroutine solve_refined(canonical, alpha, datums, factor, contact, reduced_gap, load, force, motion, fits)
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datums(2), reduced_gap(:), load(:)
    type(kkt_factor), intent(in) :: factor
    logical, intent(in) :: contact(:)
    real(dp), intent(out) :: force(:), motion(:)
    logical, intent(out) :: fits
    real(dp) :: residual(size(force)), correction(size(force)), missing(size(motion)), shift(size(motion))
    integer :: step

    call solve_set(factor, datums(1), reduced_gap, load, force, motion)
    do step = 1, MOST_CORRECTIONS
      residual = reduced_gap - rigid_displacement(canonical%modes, motion)
      call add_displacement_at(alpha, datums(1), contact, .not. contact, force, residual)
      fits = is_closed(canonical%modes, alpha, datums, contact, reduced_gap, force, motion, residual)
      missing = load - matmul(force, canonical%modes)
      call solve_set(factor, datums(1), residual, missing, correction, shift)
      force = force + correction
      motion = motion + shift
      if (fits) exit
    end do
  end subroutine solve_refined

  !> Are the changes of the `gap` (n) on the contact zero, but for rounding? `datums`: that of the operator, taken out
  !> here, and that of the factor, whose rounding is not seen in the terms.
  pure function is_closed(modes, alpha, datums, contact, reduced_gap, force, motion, gap) result(closed)
    real(dp), intent(in) :: modes(:, :), alpha(:, :), datums(2), reduced_gap(:), force(:), motion(:), gap(:)
    logical, intent(in) :: contact(:)
    logical :: closed
    real(dp) :: open, rounding, terms
    integer :: j, k

    open = 0.0_dp
    terms = 0.0_dp
    rounding = 0.0_dp
    do k = 1, size(contact)
      if (.not. contact(k)) cycle
      open = max(open, abs(gap(k)))
      rounding = rounding + ROUNDINGS*epsilon(rounding)*(abs(alpha(k, k)) + sum(abs(datums)))*abs(force(k))
      terms = max(terms, abs(reduced_gap(k)), abs((alpha(k, k) - datums(1))*force(k)))
      do j = 1, size(motion)
        terms = max(terms, abs(modes(k, j)*motion(j)))
      end do
    end do
    closed = .not. open > CLOSED_TOLERANCE*terms + rounding
  end function is_closed

  !> Is a change of the gaps without one of the load the rigid displacement R q at all points in contact, but for
  !> rounding? Forces then stay as they are, and those computed are rounding.
  pure function is_rigid(modes, gap_change, load_change, motion, contact) result(rigid)
    real(dp), intent(in) :: modes(:, :), gap_change(:), load_change(:), motion(:)
    logical, intent(in) :: contact(:)
    logical :: rigid
    integer :: k

    rigid = .not. any(abs(load_change) > 0.0_dp)
    do k = 1, size(contact)
      if (.not. rigid) return
      if (.not. contact(k)) cycle
      rigid = abs(gap_change(k) - dot_product(modes(k, :), motion)) &
              <= RIGID_TOLERANCE*(abs(gap_change(k)) + sum(abs(modes(k, :)*motion)))
    end do
  end function is_rigid

end module fuge_sensitivity
