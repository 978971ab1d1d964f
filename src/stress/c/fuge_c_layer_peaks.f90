!> C bindings, section "stresses in layers": the largest ones.
module fuge_c_layer_peaks
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_int, c_ptr, c_size_t
  use fuge_c_arrays, only: find_array
  use fuge_c_layer_stress, only: find_body
  use fuge_c_stress_grid, only: cells_of, require_grid
  use fuge_c_types, only: report_to_c, require_count, require_pointer
  use fuge_interface_peaks, only: fuge_interface_stress, fuge_layered_halfplane_interfaces, &
    fuge_layered_halfspace_interfaces
  use fuge_layered_body_type, only: fuge_layered_body
  use fuge_layered_peak_search, only: fuge_layer_peak, fuge_layered_halfplane_peak, fuge_layered_halfspace_peak
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  !> struct fuge_interface_stress.
  type, bind(c) :: c_interface_stress
    real(c_double) :: depth, tension_above, tension_below, shear, opening
    integer(c_int) :: cell_above, cell_below, cell_of_shear, cell_of_opening
  end type c_interface_stress

  !> struct fuge_layer_peak.
  type, bind(c) :: c_layer_peak
    real(c_double) :: value, depth, tensor(6)
    integer(c_int) :: layer, cell
  end type c_layer_peak

contains

  !> Fourteen arguments, as in the header: the layers, the cells, the results, the message.
  function c_layered_halfplane_interfaces(layers, thickness, young, poisson, bonded, n, spacing, force, element, &
                                          boundary, interfaces, peaks, message, length) &
    bind(c, name='fuge_layered_halfplane_interfaces') result(status)
    integer(c_int), intent(in), value :: layers, bonded, n, element, boundary
    real(c_double), intent(in), value :: spacing
    type(c_ptr), intent(in), value :: thickness, young, poisson, force, interfaces, peaks, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: forces(:)
    type(fuge_interface_stress), allocatable :: found(:)
    type(fuge_layered_body) :: body
    type(fuge_info) :: info

    call require_count(n, 1, 'n', 'cells', info)
    call find_array(n, force, 'force', forces, info)
    call find_results(interfaces, peaks, info)
    call find_body(layers, thickness, young, poisson, bonded, body, info)
    call make_room(body, found, info)
    if (.not. info%failed()) call fuge_layered_halfplane_interfaces(body, spacing, forces, int(element), &
                                                                    int(boundary), found, info)
    if (.not. info%failed()) call give_peaks(found, interfaces, peaks)
    status = report_to_c(info, message, length)
  end function c_layered_halfplane_interfaces

  !> Fifteen arguments, as in the header: the layers, the grid, the results, the message.
  function c_layered_halfspace_interfaces(layers, thickness, young, poisson, bonded, nx, ny, spacing_x, spacing_y, &
                                          force, boundary, interfaces, peaks, message, length) &
    bind(c, name='fuge_layered_halfspace_interfaces') result(status)
    integer(c_int), intent(in), value :: layers, bonded, nx, ny, boundary
    real(c_double), intent(in), value :: spacing_x, spacing_y
    type(c_ptr), intent(in), value :: thickness, young, poisson, force, interfaces, peaks, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: forces(:)
    type(fuge_interface_stress), allocatable :: found(:)
    type(fuge_layered_body) :: body
    type(fuge_info) :: info

    call require_grid(nx, ny, info)
    call find_array(int(cells_of(nx, ny, info), c_int), force, 'force', forces, info)
    call find_results(interfaces, peaks, info)
    call find_body(layers, thickness, young, poisson, bonded, body, info)
    call make_room(body, found, info)
    if (.not. info%failed()) call fuge_layered_halfspace_interfaces(body, int(nx), int(ny), spacing_x, spacing_y, &
                                                                    forces, int(boundary), found, info)
    if (.not. info%failed()) call give_peaks(found, interfaces, peaks)
    status = report_to_c(info, message, length)
  end function c_layered_halfspace_interfaces

  !> Fourteen arguments, as in the header: the layers, the cells, the measure, the result, the message.
  function c_layered_halfplane_peak(layers, thickness, young, poisson, bonded, n, spacing, force, element, boundary, &
                                    measure, peak, message, length) &
    bind(c, name='fuge_layered_halfplane_peak') result(status)
    integer(c_int), intent(in), value :: layers, bonded, n, element, boundary, measure
    real(c_double), intent(in), value :: spacing
    type(c_ptr), intent(in), value :: thickness, young, poisson, force, peak, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: forces(:)
    type(fuge_layer_peak) :: found
    type(fuge_layered_body) :: body
    type(fuge_info) :: info

    call require_count(n, 1, 'n', 'cells', info)
    call find_array(n, force, 'force', forces, info)
    call require_pointer(peak, 'peak', info)
    call find_body(layers, thickness, young, poisson, bonded, body, info)
    if (.not. info%failed()) call fuge_layered_halfplane_peak(body, spacing, forces, int(element), int(boundary), &
                                                              int(measure), found, info)
    if (.not. info%failed()) call give_peak(found, peak)
    status = report_to_c(info, message, length)
  end function c_layered_halfplane_peak

  !> Fifteen arguments, as in the header: the layers, the grid, the measure, the result, the message.
  function c_layered_halfspace_peak(layers, thickness, young, poisson, bonded, nx, ny, spacing_x, spacing_y, force, &
                                    boundary, measure, peak, message, length) &
    bind(c, name='fuge_layered_halfspace_peak') result(status)
    integer(c_int), intent(in), value :: layers, bonded, nx, ny, boundary, measure
    real(c_double), intent(in), value :: spacing_x, spacing_y
    type(c_ptr), intent(in), value :: thickness, young, poisson, force, peak, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: forces(:)
    type(fuge_layer_peak) :: found
    type(fuge_layered_body) :: body
    type(fuge_info) :: info

    call require_grid(nx, ny, info)
    call find_array(int(cells_of(nx, ny, info), c_int), force, 'force', forces, info)
    call require_pointer(peak, 'peak', info)
    call find_body(layers, thickness, young, poisson, bonded, body, info)
    if (.not. info%failed()) call fuge_layered_halfspace_peak(body, int(nx), int(ny), spacing_x, spacing_y, forces, &
                                                              int(boundary), int(measure), found, info)
    if (.not. info%failed()) call give_peak(found, peak)
    status = report_to_c(info, message, length)
  end function c_layered_halfspace_peak

  !> Room for the stresses of all interfaces. FUGE_ERR_MEMORY.
  subroutine make_room(body, found, info)
    type(fuge_layered_body), intent(in) :: body
    type(fuge_interface_stress), allocatable, intent(out) :: found(:)
    type(fuge_info), intent(inout) :: info
    integer :: stat

    if (info%failed()) return
    allocate (found(body%interfaces() + 1), stat=stat)
    call require_memory(stat, 'the stresses of', body%interfaces(), 'interfaces', info)
  end subroutine make_room

  subroutine find_results(interfaces, peaks, info)
    type(c_ptr), intent(in) :: interfaces, peaks
    type(fuge_info), intent(inout) :: info

    call require_pointer(interfaces, 'interfaces', info)
    call require_pointer(peaks, 'peaks', info)
  end subroutine find_results

  subroutine give_peaks(found, interfaces, destination)
    type(fuge_interface_stress), intent(in) :: found(:)
    type(c_ptr), intent(in) :: interfaces, destination
    integer(c_int), pointer :: count
    type(c_interface_stress), pointer :: peaks(:)

    call c_f_pointer(interfaces, count)
    call c_f_pointer(destination, peaks, [size(found)])
    count = int(size(found) - 1, c_int)
    peaks%depth = found%depth
    peaks%tension_above = found%tension_above
    peaks%tension_below = found%tension_below
    peaks%shear = found%shear
    peaks%opening = found%opening
    ! Cells count from 0 in C.
    peaks%cell_above = int(found%cell_above - 1, c_int)
    peaks%cell_below = int(found%cell_below - 1, c_int)
    peaks%cell_of_shear = int(found%cell_of_shear - 1, c_int)
    peaks%cell_of_opening = int(found%cell_of_opening - 1, c_int)
  end subroutine give_peaks

  subroutine give_peak(found, destination)
    type(fuge_layer_peak), intent(in) :: found
    type(c_ptr), intent(in) :: destination
    type(c_layer_peak), pointer :: peak

    call c_f_pointer(destination, peak)
    peak%value = found%value
    peak%depth = found%depth
    peak%tensor = found%tensor
    ! Both count from 0 in C.
    peak%layer = int(found%layer - 1, c_int)
    peak%cell = int(found%cell - 1, c_int)
  end subroutine give_peak

end module fuge_c_layer_peaks
