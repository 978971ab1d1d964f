!> Derivatives of a solution by products: conjugate gradients on its contact set.
module fuge_set_derivative
  use fuge_canonical_problem, only: canonical_problem
  use fuge_contact_displacement, only: compute_displacement
  use fuge_contact_iterate, only: contact_iterate, start_iterate
  use fuge_contact_preconditioner, only: contact_preconditioner
  use fuge_contact_scene, only: contact_scene
  use fuge_contact_segments, only: max_abs_over
  use fuge_contact_states, only: is_at_stop
  use fuge_iterate_evaluation, only: evaluate_iterate
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_operator_type, only: fuge_operator
  use fuge_problem_type, only: fuge_solution
  use fuge_projected_gradients, only: run_projected_gradients
  use fuge_shared_rows, only: rows_of
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_ITERATION_LIMIT
  use fuge_unresisted_motions, only: find_unresisted_basis, refuse_unresisted
  implicit none
  private

  public :: find_derivative_by_products

  !> At most this many restarts with fresh products make up for the rounding that the run before has gathered.
  integer, parameter :: RESTARTS = 4

contains

  !> Changes of forces, gaps and motions at a fixed contact set.
  !>
  !> `canonical` the problem without its matrix; `state` (n) the contact set; `tolerance` > 0, of the gap equations,
  !> relative to their terms; `gap_change` (n) length, `load_change` (m) of the resultants, of prescribed motions the
  !> change of the motion; `change` in the order of `fuge_solution`. Errors, `change` untouched: FUGE_ERR_NO_EQUILIBRIUM
  !> if the contact set does not resist a mode that the changes load, FUGE_ERR_ITERATION_LIMIT if the tolerance is not
  !> reached, FUGE_ERR_MEMORY, those of the operator, FUGE_ERR_NOT_DEFINITE.
  subroutine find_derivative_by_products(operator, canonical, state, tolerance, gap_change, load_change, change, info)
    class(fuge_operator), intent(in) :: operator
    type(canonical_problem), intent(in) :: canonical
    integer, intent(in) :: state(:)
    real(dp), intent(in) :: tolerance, gap_change(:), load_change(:)
    type(fuge_solution), intent(inout) :: change
    type(fuge_info), intent(inout) :: info
    type(contact_scene) :: scene
    type(contact_iterate) :: iterate
    real(dp), allocatable :: gap(:), motion(:), unresisted(:, :)
    integer :: n, stat

    n = size(state)
    call set_scene(operator, canonical, gap_change, load_change, scene, info)
    if (info%failed()) return
    if (allocated(scene%modes)) then
      call find_unresisted_basis(canonical%modes, is_at_stop(state), unresisted, canonical%space)
      call refuse_unresisted(scene%load, unresisted, info)
      if (info%failed()) return
    end if
    allocate (gap(n), motion(size(load_change)), stat=stat)
    call require_memory(stat, 'the derivatives of', n, 'points', info)
    call canonical%space%agree(info)
    if (stat /= 0 .or. info%failed()) return
    call start_iterate(iterate, scene, info=info)
    if (info%failed()) return
    iterate%contact = is_at_stop(state)
    call solve_on_set(operator, scene, tolerance, iterate, info)
    if (info%failed()) return
    call find_gaps_and_motions(operator, canonical, scene, gap_change, load_change, iterate, gap, motion)
    where (iterate%contact .and. .not. canonical%excluded) gap = 0.0_dp
    call move_alloc(iterate%force, change%force)
    call move_alloc(gap, change%gap)
    call move_alloc(motion, change%motion)
  end subroutine find_derivative_by_products

  !> The linear problem: gaps that the displacements must close on the set, and changes of the resultants.
  subroutine set_scene(operator, canonical, gap_change, load_change, scene, info)
    class(fuge_operator), intent(in) :: operator
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: gap_change(:), load_change(:)
    type(contact_scene), intent(inout) :: scene
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: load(:)
    integer :: m, n, stat

    call rows_of(operator, 0, scene%rows, info)
    if (info%failed()) return
    n = size(gap_change)
    call canonical%transform_change(gap_change, load_change, scene%gap, load, info)
    if (info%failed()) return
    m = size(load)
    scene%prescribed = .true.
    scene%absorbs_datum = canonical%has_translation
    if (m < 1) return
    allocate (scene%modes(n, m), scene%balance(n), stat=stat)
    call require_memory(stat, 'the modes of', n, 'points', info)
    call canonical%space%agree(info)
    if (stat /= 0 .or. info%failed()) return
    scene%modes = canonical%modes
    scene%balance = 0.0_dp
    call move_alloc(load, scene%load)
  end subroutine set_scene

  !> Forces on the set that close its gaps, of either sign, to the tolerance.
  subroutine solve_on_set(operator, scene, tolerance, iterate, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in) :: scene
    real(dp), intent(in) :: tolerance
    type(contact_iterate), intent(inout) :: iterate
    type(fuge_info), intent(inout) :: info
    type(contact_preconditioner) :: preconditioner
    real(dp) :: largest, previous
    integer :: restart

    previous = huge(previous)
    iterate%force = 0.0_dp
    do restart = 0, RESTARTS
      call correct_forces(operator, scene, iterate, info)
      if (.not. info%failed()) call evaluate_iterate(operator, scene, iterate, info)
      if (info%failed()) return
      if (iterate%lengths%is_accurate(tolerance)) return
      ! Rounding is left: as exact as the products are.
      if (.not. iterate%lengths%residual_norm < 0.5_dp*previous) exit
      previous = iterate%lengths%residual_norm
      call preconditioner%set(operator, iterate%contact, .false., maxval(abs(iterate%displacement)), info)
      if (allocated(scene%modes) .and. .not. info%failed()) then
        call preconditioner%set_modes(operator, iterate%projection, iterate%segments, iterate%contact, info)
      end if
      if (.not. info%failed()) call run_projected_gradients(operator, preconditioner, scene, 0.5_dp*tolerance, .true., &
                                                            iterate, info)
      if (info%failed()) return
    end do
    ! Displacements that cancel the changes of the gaps have no smaller rounding than these.
    largest = max(iterate%lengths%least_magnitude, max_abs_over(iterate%segments, scene%gap))
    if (iterate%lengths%residual_norm > sqrt(tolerance)*largest) then
      call report(info, FUGE_ERR_ITERATION_LIMIT, 'derivatives: conjugate gradients leave ' &
                  //text(iterate%lengths%residual_norm/largest)//' of the gaps open; the operator may be too badly ' &
                  //'conditioned on the contact')
    end if
  end subroutine solve_on_set

  !> Forces on the set with the resultants of the scene, and their displacements.
  subroutine correct_forces(operator, scene, iterate, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(inout) :: iterate
    type(fuge_info), intent(inout) :: info
    logical :: possible

    call iterate%segments%find(iterate%contact, info)
    if (allocated(scene%modes) .and. .not. info%failed()) then
      iterate%rigid_motion = 0.0_dp
      call iterate%projection%set(scene%modes, iterate%segments, info)
      if (.not. info%failed()) call iterate%projection%correct_resultants(scene%modes, scene%load, iterate%segments, &
                                                                          iterate%force, possible)
    end if
    if (.not. info%failed()) call compute_displacement(operator, scene%counts_datum(), iterate%force, &
                                                       iterate%displacement, info)
  end subroutine correct_forces

  !> Gaps at all points and motions in the given modes.
  subroutine find_gaps_and_motions(operator, canonical, scene, gap_change, load_change, iterate, gap, motion)
    class(fuge_operator), intent(in) :: operator
    type(canonical_problem), intent(in) :: canonical
    type(contact_scene), intent(in) :: scene
    real(dp), intent(in) :: gap_change(:), load_change(:)
    type(contact_iterate), intent(inout) :: iterate
    real(dp), intent(out) :: gap(:), motion(:)
    real(dp) :: free_motion(size(canonical%load))

    gap = scene%gap + iterate%displacement
    if (allocated(scene%modes)) then
      free_motion = iterate%rigid_motion
      iterate%displacement = iterate%displacement + matmul(scene%modes, iterate%rigid_motion)
    end if
    if (canonical%has_translation) then
      associate (by_datum => operator%datum()*canonical%space%total(sum(iterate%force)))
        free_motion(1) = free_motion(1) + by_datum
        iterate%displacement = iterate%displacement + by_datum
      end associate
    end if
    call canonical%to_given_modes(load_change, free_motion, motion)
    call canonical%set_excluded_gaps_from(iterate%displacement, gap_change, motion, gap)
  end subroutine find_gaps_and_motions

end module fuge_set_derivative
