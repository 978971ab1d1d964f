!> Projected, preconditioned conjugate gradients on a given contact set.
!>
!> Only the forces of the set change. Under a load their sum is kept and the gaps of the set become
!> equal, their common value being the rigid motion; with a prescribed motion the gaps become zero. With other rigid
!> modes the resultants are kept, and the gaps become a rigid motion, which displacements then include.
module fuge_projected_gradients
  use fuge_conjugate_gradients, only: conjugate_gradients, DECISIVE, NEARLY
  use fuge_contact_displacement, only: compute_displacement
  use fuge_contact_iterate, only: contact_iterate
  use fuge_contact_preconditioner, only: contact_preconditioner
  use fuge_contact_scene, only: contact_scene
  use fuge_contact_segments, only: add_scaled_over, center_over, contact_segments, dot_and_sum_over, dot_over, &
    max_abs_over
  use fuge_contact_set, only: contact_set
  use fuge_contact_step, only: step_over
  use fuge_deformed_gaps, only: find_penetration
  use fuge_iterate_evaluation, only: evaluate_iterate, project_residual, remove_rigid_part
  use fuge_iterate_pass, only: iterate_pass
  use fuge_kinds, only: dp
  use fuge_least_magnitude, only: find_least_magnitude
  use fuge_null_direction, only: find_softness, largest_energy, leave_null_direction, stores_no_energy
  use fuge_number_text, only: text
  use fuge_operator_type, only: fuge_operator
  use fuge_status, only: fuge_info, report, FUGE_ERR_NOT_DEFINITE
  use fuge_wrong_points, only: greatest_tension, tension_is_decided
  implicit none
  private

  public :: precondition_residual, run_projected_gradients

  !> Exact conjugate gradients need as many iterations as there are points; rounded ones
  !> several times as many where alpha is badly conditioned.
  integer, parameter :: ITERATIONS_PER_POINT = 10
  integer, parameter :: EXTRA_ITERATIONS = 20
  !> Upper limit in any case: an operator that needs more needs a preconditioner.
  integer, parameter :: MAX_ITERATIONS = 20000
  !> With modes the residual is projected anew whenever it has fallen to this fraction.
  real(dp), parameter :: SMALL = 1.0e-3_dp
  !> A negative energy below this fraction of the magnitude of its terms is rounding.
  real(dp), parameter :: ROUNDING = 1.0e-10_dp

contains

  !> Iterate towards the forces for which the gaps of the contact set are equal, or zero if the
  !> motion is prescribed.
  !>
  !> `iterate` in: forces, displacements and contact set; out: new forces and displacements (the latter by recurrence).
  !> Ends when the residual norm is at most `tolerance` times the least magnitude (then iterate%gradients%converged);
  !> unless `to_tolerance`, already when the residual is small enough to tell which points are
  !> in tension and which penetrate; or when only rounding is left, or at the limit of
  !> iterations. Errors: those of the operator, FUGE_ERR_NOT_DEFINITE, FUGE_ERR_MEMORY.
  subroutine run_projected_gradients(operator, preconditioner, scene, tolerance, to_tolerance, iterate, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_preconditioner), intent(inout) :: preconditioner
    type(contact_scene), intent(in) :: scene
    real(dp), intent(in) :: tolerance
    logical, intent(in) :: to_tolerance
    type(contact_iterate), intent(inout) :: iterate
    type(fuge_info), intent(inout) :: info
    real(dp) :: energy, previous, step_length
    integer :: iteration, limit
    logical :: preconditioned

    associate (segments => iterate%segments, gradients => iterate%gradients, lengths => iterate%lengths)
      gradients%converged = .false.
      call gradients%lanczos%restart()
      gradients%unbounded = .false.
      preconditioned = operator%has_preconditioner()
      call evaluate_iterate(operator, scene, iterate, info)
      if (info%failed()) return
      if (allocated(gradients%start)) gradients%start = iterate%force
      limit = min(ITERATIONS_PER_POINT*min(segments%points, MAX_ITERATIONS) + EXTRA_ITERATIONS, MAX_ITERATIONS)
      call clear_direction(gradients)
      previous = 1.0_dp
      do iteration = 0, limit
        gradients%converged = lengths%is_accurate(tolerance)
        if (.not. gradients%converged .and. measured_again(scene, iteration, limit)) then
          ! The forces at the start may have been others, even none.
          call find_least_magnitude(operator, scene, iterate, info)
          if (info%failed()) return
          gradients%converged = lengths%is_accurate(tolerance)
        end if
        if (gradients%converged .or. iteration == limit) return
        if (iteration > 0 .and. .not. to_tolerance) then
          if (lengths%residual_norm <= DECISIVE*lengths%penetration) return
        end if
        call precondition_residual(operator, scene, preconditioner, iterate%contact_set, gradients, energy, info)
        if (info%failed()) return
        if (iteration == 0 .or. lengths%is_accurate(NEARLY*tolerance)) then
          gradients%amplification = max_abs_over(segments, gradients%work)/lengths%residual_norm
        end if
        if (iteration > 0 .and. preconditioned .and. .not. to_tolerance) then
          if (tension_is_decided(scene, iterate%contact_set, gradients, DECISIVE)) return
        end if
        if (.not. energy > 0.0_dp) then
          call check_preconditioner_energy(segments, gradients, energy, info)
          return
        end if
        call add_scaled_over(segments, energy/previous, gradients%work, gradients%direction)
        call advance_along_direction(operator, scene, tolerance, energy, iterate, step_length, info)
        if (.not. step_length > 0.0_dp) return
        call gradients%lanczos%add(step_length, energy/previous)
        previous = energy
        if (.not. (to_tolerance .or. preconditioned)) then
          ! Without a preconditioner the last step stands for the error of the forces.
          if (step_length*max_abs_over(segments, gradients%direction) &
              <= DECISIVE*greatest_tension(scene, iterate%contact_set)) return
        end if
      end do
    end associate
  end subroutine run_projected_gradients

  !> No search direction at any point.
  subroutine clear_direction(gradients)
    type(conjugate_gradients), intent(inout), target :: gradients
    type(iterate_pass) :: pass
    real(dp) :: none(0)

    pass%gradients => gradients
    call pass%go(clear_in_chunk, size(gradients%direction), 0, none)
  end subroutine clear_direction

  subroutine clear_in_chunk(pass, k, first, last, found)
    class(iterate_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp), intent(inout) :: found(:)

    if (k < 1) found = 0.0_dp
    pass%gradients%direction(first:last) = 0.0_dp
  end subroutine clear_in_chunk

  !> Is the length that residuals are compared with to be measured anew before this iteration? At the end, and seldom
  !> before; with one translation the load gives it its size from the start.
  pure function measured_again(scene, iteration, limit)
    type(contact_scene), intent(in) :: scene
    integer, intent(in) :: iteration, limit
    logical :: measured_again

    measured_again = iteration == limit
    if (.not. scene%is_simple()) measured_again = measured_again .or. (iteration > 1 &
                                                                       .and. iand(iteration, iteration - 1) == 0)
  end function measured_again

  !> The preconditioned residual, gradients%work, projected to forces without resultants, and its `energy`. Errors:
  !> those of the preconditioner.
  subroutine precondition_residual(operator, scene, preconditioner, set, gradients, energy, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in) :: scene
    type(contact_preconditioner), intent(inout) :: preconditioner
    type(contact_set), intent(in) :: set
    type(conjugate_gradients), intent(inout) :: gradients
    real(dp), intent(out) :: energy
    type(fuge_info), intent(inout) :: info

    if (allocated(scene%modes)) then
      call preconditioner%apply_with_modes(operator, set%segments, set%projection, gradients%residual, gradients%work, &
                                           energy, info)
    else
      call preconditioner%apply(operator, set%segments, .not. scene%prescribed, gradients%residual, gradients%work, &
                                energy, info)
    end if
  end subroutine precondition_residual

  !> Go to the minimum of the energy along the search direction.
  !>
  !> `energy` is the inner product of the residual and the preconditioned residual, `tolerance` as for
  !> `run_projected_gradients`; `step_length` is 0 where the curvature is not positive, or after an error. Errors: those
  !> of the operator, FUGE_ERR_NOT_DEFINITE.
  subroutine advance_along_direction(operator, scene, tolerance, energy, iterate, step_length, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in) :: scene
    real(dp), intent(in) :: tolerance, energy
    type(contact_iterate), intent(inout) :: iterate
    real(dp), intent(out) :: step_length
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: rigid_motion(:)
    real(dp) :: curvature, total
    logical :: none, suspect

    step_length = 0.0_dp
    associate (segments => iterate%segments, gradients => iterate%gradients)
      call compute_displacement(operator, scene%counts_datum(), gradients%direction, gradients%work, info)
      if (info%failed()) return
      if (scene%prescribed) call find_softness(operator, scene, segments, iterate%force, iterate%displacement, &
                                               gradients, info)
      if (allocated(scene%modes) .and. .not. info%failed()) then
        call remove_rigid_motion(scene, iterate%contact_set, gradients%work, rigid_motion)
      end if
      call dot_and_sum_over(segments, gradients%direction, gradients%work, curvature, total)
      ! Under a load alone, forces do not grow on the way to a direction without energy.
      suspect = gradients%lanczos%is_suspect(curvature/energy)
      if (suspect .and. .not. scene%prescribed) then
        call find_softness(operator, scene, segments, iterate%force, iterate%displacement, gradients, info)
      end if
      if (info%failed()) return
      none = scene%prescribed .or. suspect
      if (none) none = stores_no_energy(segments, gradients, curvature)
      if (none) then
        call leave_null_direction(scene, tolerance, energy, iterate%lengths, iterate%contact_set, gradients)
      else if (curvature > 0.0_dp) then
        step_length = energy/curvature
        if (scene%prescribed) total = 0.0_dp
        call take_step(scene, step_length, total/real(segments%points, dp), iterate)
        if (allocated(scene%modes)) iterate%rigid_motion = iterate%rigid_motion - step_length*rigid_motion
      else
        call check_curvature(operator, scene, iterate, info)
      end if
    end associate
  end subroutine advance_along_direction

  !> Subtract from the displacements `work` (n), at all points, the `rigid_motion` (m) nearest to them on the set.
  subroutine remove_rigid_motion(scene, set, work, rigid_motion)
    type(contact_scene), intent(in) :: scene
    type(contact_set), intent(in) :: set
    real(dp), intent(inout), contiguous :: work(:)
    real(dp), allocatable, intent(out) :: rigid_motion(:)
    real(dp), allocatable :: factors(:)

    allocate (factors(size(scene%load)), rigid_motion(size(scene%load)))
    call set%projection%components(set%segments, work, factors)
    call set%projection%subtract(factors, work)
    rigid_motion = set%projection%motion(factors)
  end subroutine remove_rigid_motion

  !> Subtract `step_length` times the search direction from the forces, and update what follows from them. `mean` is
  !> that of the displacements by the direction over the contact set; 0 if the motion is prescribed.
  !>
  !> The residual gains rigid motions by the rounding of lengths that were larger before. They are removed with each
  !> step of one translation, and with modes as soon as the residual has become small.
  subroutine take_step(scene, step_length, mean, iterate)
    type(contact_scene), intent(in) :: scene
    real(dp), intent(in) :: step_length, mean
    type(contact_iterate), intent(inout) :: iterate
    real(dp) :: rest, total

    associate (segments => iterate%segments, gradients => iterate%gradients, lengths => iterate%lengths)
      iterate%motion = iterate%motion - step_length*mean
      call step_over(segments, step_length, step_length*mean, scene%gap, iterate%motion, gradients%direction, &
                     gradients%work, iterate%force, iterate%displacement, gradients%residual, total, &
                     lengths%residual_norm, lengths%penetration)
      if (allocated(scene%play)) lengths%penetration = find_penetration(scene, iterate)
      if (allocated(scene%modes)) then
        gradients%unprojected = max(gradients%unprojected, lengths%residual_norm)
        if (lengths%residual_norm < SMALL*gradients%unprojected) call project_residual(scene, iterate)
      end if
      if (scene%prescribed) return
      ! A mean left by rounding would grow, and without a preconditioner change the sum of the forces.
      rest = total/real(segments%points, dp)
      call center_over(segments, rest, gradients%residual, lengths%residual_norm)
      iterate%motion = iterate%motion + rest
    end associate
  end subroutine take_step

  !> The preconditioned residual has no positive energy: either the residual is nothing but
  !> rounding, or the preconditioner is not positive definite (FUGE_ERR_NOT_DEFINITE).
  subroutine check_preconditioner_energy(segments, gradients, energy, info)
    type(contact_segments), intent(in) :: segments
    type(conjugate_gradients), intent(in) :: gradients
    real(dp), intent(in) :: energy
    type(fuge_info), intent(inout) :: info

    if (energy >= -ROUNDING*max_abs_over(segments, gradients%residual)*max_abs_over(segments, gradients%work)) return
    call report(info, FUGE_ERR_NOT_DEFINITE, &
                'preconditioner '//text(info%preconditionings)//': lengths with the negative energy ' &
                //text(energy)//': the preconditioner of the operator is not positive definite')
  end subroutine check_preconditioner_energy

  !> The search direction has no positive curvature: either it or its displacements are nothing but rounding, or the
  !> operator is not positive definite (FUGE_ERR_NOT_DEFINITE).
  !>
  !> On forces with a resultant the operator may well be negative, and late directions may have such forces by rounding:
  !> the direction loses its resultants, and its energy is judged anew.
  subroutine check_curvature(operator, scene, iterate, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(inout) :: iterate
    type(fuge_info), intent(inout) :: info
    real(dp) :: curvature

    associate (gradients => iterate%gradients)
      call remove_rigid_part(scene, iterate%contact_set, gradients%direction)
      call compute_displacement(operator, scene%counts_datum(), gradients%direction, gradients%work, info)
      if (.not. info%failed()) call find_softness(operator, scene, iterate%segments, iterate%force, &
                                                  iterate%displacement, gradients, info)
      if (info%failed()) return
      curvature = dot_over(iterate%segments, gradients%direction, gradients%work)
      if (curvature >= -ROUNDING*largest_energy(iterate%segments, gradients)) return
      call report(info, FUGE_ERR_NOT_DEFINITE, 'product '//text(info%products)//': forces on the contact store the ' &
                  //'negative energy '//text(0.5_dp*curvature)//': the operator is not positive definite')
    end associate
  end subroutine check_curvature

end module fuge_projected_gradients
