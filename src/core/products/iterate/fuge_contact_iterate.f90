!> Forces on the points of a grid with their contact set, the displacements by them, and what a search knows of both.
module fuge_contact_iterate
  use fuge_conjugate_gradients, only: conjugate_gradients
  use fuge_contact_scene, only: contact_scene
  use fuge_contact_set, only: contact_set
  use fuge_iterate_lengths, only: iterate_lengths
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: start_iterate

  !> Under a load, forces and lengths are divided by the load; with a prescribed motion they are not scaled.
  type, extends(contact_set), public :: contact_iterate
    !> Displacements by the forces, (n); without the operator's datum unless the motion is
    !> prescribed, and less the rigid displacement `rigid_motion` where there are modes.
    real(dp), allocatable :: displacement(:)
    !> The rigid motion: the mean of gap plus displacement over the contact set; 0 if prescribed.
    real(dp) :: motion = 0.0_dp
    !> Motions in the modes of the scene, (m); allocated where it has any.
    real(dp), allocatable :: rigid_motion(:)
    type(iterate_lengths) :: lengths = iterate_lengths()
    type(conjugate_gradients) :: gradients = conjugate_gradients()
  end type contact_iterate

contains

  !> Allocate the arrays for the points of a scene and set the forces to start from: `start` (n), scaled as in
  !> contact_iterate, if there are any; else equal forces, or none if the motion is prescribed, or the least forces
  !> that have the resultants. Errors: FUGE_ERR_MEMORY.
  subroutine start_iterate(iterate, scene, start, info)
    type(contact_iterate), intent(inout) :: iterate
    type(contact_scene), intent(in) :: scene
    real(dp), intent(in), optional :: start(:)
    type(fuge_info), intent(inout) :: info
    integer :: n, stat

    n = size(scene%gap)
    allocate (iterate%force(n), iterate%displacement(n), iterate%contact(n), stat=stat)
    if (stat == 0 .and. allocated(scene%play)) allocate (iterate%at_upper(n), stat=stat)
    if (stat == 0 .and. scene%has_limits()) allocate (iterate%limited(n), stat=stat)
    if (stat == 0 .and. allocated(scene%modes)) allocate (iterate%rigid_motion(size(scene%load)), stat=stat)
    call require_memory(stat, 'the work space of', n, 'points', info)
    call scene%rows%agree(info)
    if (stat /= 0 .or. info%failed()) return
    ! To make forces of these scenes feasible takes the direction or `work`.
    if (allocated(scene%modes) .or. allocated(scene%play) .or. scene%has_limits()) then
      call iterate%gradients%prepare(n, scene%prescribed, scene%rows%point_space, info)
      if (info%failed()) return
    end if
    iterate%segments%space = scene%rows%point_space
    if (allocated(iterate%at_upper)) iterate%at_upper = .false.
    if (allocated(iterate%limited)) then
      iterate%limited = 0
      ! Where the start puts all points at their limits, their distances are needed before the first product.
      iterate%displacement = 0.0_dp
    end if
    if (present(start)) then
      iterate%force = start
    else if (allocated(scene%modes)) then
      call find_least_forces(scene, iterate%contact_set, info)
    else if (scene%prescribed) then
      iterate%force = 0.0_dp
    else
      iterate%force = 1.0_dp/real(scene%points(), dp)
    end if
  end subroutine start_iterate

  !> The least forces at the points that take part, of either sign, that have the resultants.
  subroutine find_least_forces(scene, set, info)
    type(contact_scene), intent(in) :: scene
    type(contact_set), intent(inout) :: set
    type(fuge_info), intent(inout) :: info
    logical :: possible

    set%contact = .true.
    if (allocated(scene%excluded)) set%contact = .not. scene%excluded
    set%force = 0.0_dp
    call set%segments%find(set%contact, info)
    if (.not. info%failed()) call set%projection%set(scene%modes, set%segments, info)
    if (.not. info%failed()) call set%projection%correct_resultants(scene%modes, scene%load, set%segments, &
                                                                        set%force, possible)
  end subroutine find_least_forces

end module fuge_contact_iterate
