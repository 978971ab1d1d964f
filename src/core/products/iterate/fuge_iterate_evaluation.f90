!> Motion and errors of an iterate, from its forces and their displacements.
module fuge_iterate_evaluation
  use fuge_contact_iterate, only: contact_iterate
  use fuge_contact_scene, only: contact_scene
  use fuge_contact_segments, only: center_over, max_abs_over, sum_over
  use fuge_contact_set, only: contact_set
  use fuge_deformed_gaps, only: find_penetration
  use fuge_iterate_pass, only: iterate_pass
  use fuge_kinds, only: dp
  use fuge_least_magnitude, only: find_least_magnitude
  use fuge_operator_type, only: fuge_operator
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: evaluate_iterate, project_residual, remove_rigid_part

contains

  !> Evaluate motion, residual, penetration and least magnitude from the forces, displacements and
  !> contact set of `iterate`, whose forces are feasible. Error: FUGE_ERR_MEMORY.
  subroutine evaluate_iterate(operator, scene, iterate, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(inout) :: iterate
    type(fuge_info), intent(inout) :: info

    call iterate%gradients%prepare(size(scene%gap), scene%prescribed, scene%rows%point_space, info)
    if (.not. info%failed()) call iterate%segments%find(iterate%contact, info)
    if (info%failed()) return
    call set_residual(scene, iterate)
    iterate%motion = 0.0_dp
    ! The projection of large numbers is rounded: the second one removes what is left.
    call project_residual(scene, iterate)
    call project_residual(scene, iterate)
    iterate%lengths%penetration = find_penetration(scene, iterate)
    call find_least_magnitude(operator, scene, iterate, info)
    if (info%failed()) return
    call iterate%lengths%note_start()
  end subroutine evaluate_iterate

  !> Gap plus displacement less the stop, before rigid motions are subtracted.
  subroutine set_residual(scene, iterate)
    type(contact_scene), intent(in), target :: scene
    type(contact_iterate), intent(inout), target :: iterate
    type(iterate_pass) :: pass
    real(dp) :: none(0)

    pass%scene => scene
    pass%iterate => iterate
    call pass%go(set_residuals, size(scene%gap), 0, none)
  end subroutine set_residual

  !> The residuals of a chunk. Finds nothing.
  subroutine set_residuals(pass, k, first, last, found)
    class(iterate_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp), intent(inout) :: found(:)
    integer :: end_before, i, j

    found = 0.0_dp
    associate (scene => pass%scene, iterate => pass%iterate, segments => pass%iterate%segments, &
               gradients => pass%iterate%gradients)
      end_before = first - 1
      do i = segments%before(k) + 1, segments%before(k + 1)
        gradients%residual(end_before + 1:segments%first(i) - 1) = 0.0_dp
        end_before = segments%last(i)
        ! A loop, because array assignments between components of pointers go through a copy.
        do j = segments%first(i), end_before
          gradients%residual(j) = scene%gap(j) + iterate%displacement(j)
        end do
      end do
      gradients%residual(end_before + 1:last) = 0.0_dp
      if (.not. allocated(scene%play)) return
      do i = first, last
        if (.not. iterate%contact(i)) cycle
        if (iterate%at_upper(i)) gradients%residual(i) = gradients%residual(i) - scene%play(i)
      end do
    end associate
  end subroutine set_residuals

  !> Move the rigid part of the residual into the motion, unless that is prescribed: left in the
  !> residual, its rounding error would grow and swamp the rest.
  subroutine project_residual(scene, iterate)
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(inout) :: iterate
    real(dp), allocatable :: factors(:)
    real(dp) :: mean

    associate (segments => iterate%segments, gradients => iterate%gradients, lengths => iterate%lengths)
      if (allocated(scene%modes)) then
        allocate (factors(size(scene%load)))
        call iterate%projection%components(segments, gradients%residual, factors)
        call iterate%projection%subtract_on(segments, factors, gradients%residual)
        call iterate%projection%subtract(factors, iterate%displacement)
        iterate%rigid_motion = iterate%rigid_motion + iterate%projection%motion(factors)
        lengths%residual_norm = max_abs_over(segments, gradients%residual)
        gradients%unprojected = lengths%residual_norm
        return
      end if
      mean = 0.0_dp
      if (.not. scene%prescribed) mean = sum_over(segments, gradients%residual)/real(segments%points, dp)
      call center_over(segments, mean, gradients%residual, lengths%residual_norm)
    end associate
    iterate%motion = iterate%motion + mean
  end subroutine project_residual

  !> Subtract from `values` (n), on the contact set, their components in the free rigid motions: with modes in those of
  !> the set, else in the translation unless it is prescribed.
  subroutine remove_rigid_part(scene, set, values)
    type(contact_scene), intent(in) :: scene
    type(contact_set), intent(in) :: set
    real(dp), intent(inout), contiguous :: values(:)
    real(dp), allocatable :: factors(:)
    real(dp) :: mean, largest_ignored

    if (allocated(scene%modes)) then
      allocate (factors(size(scene%load)))
      call set%projection%components(set%segments, values, factors)
      call set%projection%subtract_on(set%segments, factors, values)
    else if (.not. scene%prescribed) then
      mean = sum_over(set%segments, values)/real(set%segments%points, dp)
      call center_over(set%segments, mean, values, largest_ignored)
    end if
  end subroutine remove_rigid_part

end module fuge_iterate_evaluation
