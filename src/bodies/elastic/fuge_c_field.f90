!> C bindings, section "fields": what is known in a body, by the handle of a field.
module fuge_c_field
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_int, c_loc, c_ptr, c_size_t
  use fuge_c_arrays, only: find_array
  use fuge_c_types, only: report_to_c, require_count, require_pointer, set_handle, take_handle
  use fuge_field_type, only: fuge_field
  use fuge_status, only: fuge_info, require_memory
  use fuge_stress_peak_type, only: fuge_interface_stress, fuge_stress_peak
  implicit none
  private

  public :: give_field

  type :: field_handle
    class(fuge_field), allocatable :: field
  end type field_handle

  !> struct fuge_stress_peak.
  type, bind(c) :: c_peak
    integer(c_int) :: location, layer, cell, reserved_int(5)
    real(c_double) :: value, place(3), tensor(6), reserved(6)
  end type c_peak

  !> struct fuge_interface_stress.
  type, bind(c) :: c_interface_stress
    real(c_double) :: depth, tension_above, tension_below, shear, opening
    integer(c_int) :: cell_above, cell_below, cell_of_shear, cell_of_opening
    real(c_double) :: reserved(5)
  end type c_interface_stress

contains

  !> Give a field to the caller as a handle, unless an error is known already; FUGE_ERR_MEMORY.
  subroutine give_field(field, destination, info)
    class(fuge_field), allocatable, intent(inout) :: field
    type(c_ptr), intent(in) :: destination
    type(fuge_info), intent(inout) :: info
    type(field_handle), pointer :: handle
    integer :: stat

    if (info%failed()) return
    allocate (handle, stat=stat)
    call require_memory(stat, 'a field', info)
    if (stat /= 0) return
    call move_alloc(field, handle%field)
    call set_handle(c_loc(handle), destination)
  end subroutine give_field

  subroutine c_field_free(source) bind(c, name='fuge_field_free')
    type(c_ptr), intent(in), value :: source
    type(field_handle), pointer :: handle
    type(c_ptr) :: address

    address = take_handle(source)
    if (.not. c_associated(address)) return
    call c_f_pointer(address, handle)
    deallocate (handle)
  end subroutine c_field_free

  !> The field behind a handle; NULL is an error, unless one is known already.
  subroutine find_field(source, handle, info)
    type(c_ptr), intent(in) :: source
    type(field_handle), pointer, intent(out) :: handle
    type(fuge_info), intent(inout) :: info

    nullify (handle)
    call require_pointer(source, 'field', info)
    if (.not. info%failed()) call c_f_pointer(source, handle)
  end subroutine find_field

  function c_field_stress(source, points, place, below, tensor, message, length) bind(c, name='fuge_field_stress') &
    result(status)
    type(c_ptr), intent(in), value :: source, place, below, tensor, message
    integer(c_int), intent(in), value :: points
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(field_handle), pointer :: handle
    real(c_double), pointer :: places(:, :), values(:, :)
    logical, allocatable :: lower(:)
    type(fuge_info) :: info

    call find_places(source, points, place, below, handle, places, lower, info)
    call find_array(6, points, tensor, 'tensor', values, info)
    if (.not. info%failed()) call handle%field%stress(places, values, info, lower)
    status = report_to_c(info, message, length)
  end function c_field_stress

  function c_field_displacement(source, points, place, below, displacement, message, length) &
    bind(c, name='fuge_field_displacement') result(status)
    type(c_ptr), intent(in), value :: source, place, below, displacement, message
    integer(c_int), intent(in), value :: points
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(field_handle), pointer :: handle
    real(c_double), pointer :: places(:, :), values(:, :)
    logical, allocatable :: lower(:)
    type(fuge_info) :: info

    call find_places(source, points, place, below, handle, places, lower, info)
    call find_array(3, points, displacement, 'displacement', values, info)
    if (.not. info%failed()) call handle%field%displacement(places, values, info, lower)
    status = report_to_c(info, message, length)
  end function c_field_displacement

  !> The field, the places and their sides.
  subroutine find_places(source, points, place, below, handle, places, lower, info)
    type(c_ptr), intent(in) :: source, place, below
    integer(c_int), intent(in) :: points
    type(field_handle), pointer, intent(out) :: handle
    real(c_double), pointer, intent(out) :: places(:, :)
    logical, allocatable, intent(out) :: lower(:)
    type(fuge_info), intent(inout) :: info

    call find_field(source, handle, info)
    call require_count(points, 0, 'points', 'points', info)
    call find_array(3, points, place, 'place', places, info)
    call find_sides(points, below, lower, info)
  end subroutine find_places

  function c_field_grid_stress(source, depths, depth, below, tensor, message, length) &
    bind(c, name='fuge_field_grid_stress') result(status)
    type(c_ptr), intent(in), value :: source, depth, below, tensor, message
    integer(c_int), intent(in), value :: depths
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(field_handle), pointer :: handle
    real(c_double), pointer :: levels(:), values(:, :, :)
    logical, allocatable :: lower(:)
    type(fuge_info) :: info

    call find_depths(source, depths, depth, below, handle, levels, lower, info)
    call find_values(handle, 6, depths, tensor, 'tensor', values, info)
    if (.not. info%failed()) call handle%field%grid_stress(levels, values, info, lower)
    status = report_to_c(info, message, length)
  end function c_field_grid_stress

  function c_field_grid_displacement(source, depths, depth, below, displacement, message, length) &
    bind(c, name='fuge_field_grid_displacement') result(status)
    type(c_ptr), intent(in), value :: source, depth, below, displacement, message
    integer(c_int), intent(in), value :: depths
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(field_handle), pointer :: handle
    real(c_double), pointer :: levels(:), values(:, :, :)
    logical, allocatable :: lower(:)
    type(fuge_info) :: info

    call find_depths(source, depths, depth, below, handle, levels, lower, info)
    call find_values(handle, 3, depths, displacement, 'displacement', values, info)
    if (.not. info%failed()) call handle%field%grid_displacement(levels, values, info, lower)
    status = report_to_c(info, message, length)
  end function c_field_grid_displacement

  !> The field, the depths and their sides.
  subroutine find_depths(source, depths, depth, below, handle, levels, lower, info)
    type(c_ptr), intent(in) :: source, depth, below
    integer(c_int), intent(in) :: depths
    type(field_handle), pointer, intent(out) :: handle
    real(c_double), pointer, intent(out) :: levels(:)
    logical, allocatable, intent(out) :: lower(:)
    type(fuge_info), intent(inout) :: info

    call find_field(source, handle, info)
    call require_count(depths, 0, 'depths', 'depths', info)
    call find_array(depths, depth, 'depth', levels, info)
    call find_sides(depths, below, lower, info)
  end subroutine find_depths

  !> The array of results below the cells of a grid.
  subroutine find_values(handle, components, depths, address, name, values, info)
    type(field_handle), pointer, intent(in) :: handle
    integer, intent(in) :: components
    integer(c_int), intent(in) :: depths
    type(c_ptr), intent(in) :: address
    character(len=*), intent(in) :: name
    real(c_double), pointer, intent(out) :: values(:, :, :)
    type(fuge_info), intent(inout) :: info

    nullify (values)
    call require_pointer(address, name, info)
    if (.not. info%failed()) call c_f_pointer(address, values, [components, handle%field%cells, int(depths)])
  end subroutine find_values

  !> On which side of an interface points are: `below` is an array of `count`, or NULL for all above.
  subroutine find_sides(count, below, lower, info)
    integer(c_int), intent(in) :: count
    type(c_ptr), intent(in) :: below
    logical, allocatable, intent(out) :: lower(:)
    type(fuge_info), intent(inout) :: info
    integer(c_int), pointer :: sides(:)
    integer :: stat

    if (info%failed()) return
    allocate (lower(count), stat=stat)
    call require_memory(stat, '', int(count), 'points', info)
    if (stat /= 0) return
    lower = .false.
    if (.not. c_associated(below)) return
    call c_f_pointer(below, sides, [count])
    lower = sides /= 0_c_int
  end subroutine find_sides

  function c_field_largest(source, measure, destination, message, length) bind(c, name='fuge_field_largest') &
    result(status)
    type(c_ptr), intent(in), value :: source, destination, message
    integer(c_int), intent(in), value :: measure
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(field_handle), pointer :: handle
    type(fuge_stress_peak) :: peak
    type(c_peak), pointer :: found
    type(fuge_info) :: info

    call find_field(source, handle, info)
    call require_pointer(destination, 'peak', info)
    if (.not. info%failed()) call handle%field%largest(int(measure), peak, info)
    if (.not. info%failed()) then
      call c_f_pointer(destination, found)
      ! Layers and cells count from 0 in C; -1 where there are none.
      found = c_peak(int(peak%location, c_int), int(peak%layer - 1, c_int), int(peak%cell - 1, c_int), 0_c_int, &
                     peak%value, peak%place, peak%tensor, 0.0_c_double)
    end if
    status = report_to_c(info, message, length)
  end function c_field_largest

  function c_field_interfaces(source, capacity, interfaces, destination, message, length) &
    bind(c, name='fuge_field_interfaces') result(status)
    type(c_ptr), intent(in), value :: source, interfaces, destination, message
    integer(c_int), intent(in), value :: capacity
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(field_handle), pointer :: handle
    type(fuge_interface_stress), allocatable :: found(:)
    type(c_interface_stress), pointer :: peaks(:)
    integer(c_int), pointer :: count
    type(fuge_info) :: info
    integer :: k

    call find_field(source, handle, info)
    call require_count(capacity, 0, 'capacity', 'interfaces with the surface', info)
    call require_pointer(interfaces, 'interfaces', info)
    if (capacity > 0_c_int) call require_pointer(destination, 'peaks', info)
    if (.not. info%failed()) call handle%field%interfaces(found, info)
    if (.not. info%failed()) then
      call c_f_pointer(interfaces, count)
      count = int(size(found) - 1, c_int)
      if (capacity > 0_c_int) call c_f_pointer(destination, peaks, [capacity])
      do k = 1, min(int(capacity), size(found))
        associate (f => found(k))
          peaks(k) = c_interface_stress(f%depth, f%tension_above, f%tension_below, f%shear, f%opening, &
                                        from_one(f%cell_above), from_one(f%cell_below), from_one(f%cell_of_shear), &
                                        from_one(f%cell_of_opening), 0.0_c_double)
        end associate
      end do
    end if
    status = report_to_c(info, message, length)
  end function c_field_interfaces

  !> A number of Fortran as C counts.
  pure function from_one(number) result(index)
    integer, intent(in) :: number
    integer(c_int) :: index

    index = int(number - 1, c_int)
  end function from_one

end module fuge_c_field
