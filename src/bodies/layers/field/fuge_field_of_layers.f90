!> The fields in bodies of layers: below a line of cells, in plane strain, and below an area of rectangles.
module fuge_field_of_layers
  use fuge_elastic_moduli, only: FUGE_PLANE_STRAIN
  use fuge_field_type, only: fuge_field
  use fuge_halfplane_loads, only: halfplane_loads
  use fuge_halfspace_loads, only: halfspace_loads
  use fuge_kinds, only: dp
  use fuge_layered_body_type, only: copy_layers, fuge_layered_body
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_UNSUPPORTED
  use fuge_stress_peak_type, only: fuge_interface_stress, fuge_stress_peak
  implicit none
  private

  !> In plane strain below a line of cells; made by `set_cells` or `set_grid`.
  type, extends(fuge_field), public :: fuge_layered_line_field
    private
    type(fuge_layered_body) :: body
    type(halfplane_loads) :: loads
  contains
    procedure :: set_cells
    procedure :: set_grid => set_line
    procedure :: find_stress => line_stress
    procedure :: find_displacement => line_displacement
    procedure :: find_grid_stress => line_grid_stress
    procedure :: find_grid_displacement => line_grid_displacement
    procedure :: find_largest => line_largest
    procedure :: find_interfaces => line_interfaces
  end type fuge_layered_line_field

  !> Below an area of rectangles; made by `set_rectangles` or `set_grid`.
  type, extends(fuge_field), public :: fuge_layered_area_field
    private
    type(fuge_layered_body) :: body
    type(halfspace_loads) :: loads
  contains
    procedure :: set_rectangles
    procedure :: set_grid => set_area
    procedure :: find_stress => area_stress
    procedure :: find_displacement => area_displacement
    procedure :: find_grid_stress => area_grid_stress
    procedure :: find_grid_displacement => area_grid_displacement
    procedure :: find_largest => area_largest
    procedure :: find_interfaces => area_interfaces
  end type fuge_layered_area_field

contains

  !> Cells on a body of layers: stresses and displacements in that `body`, not in the other one.
  !>
  !> `x`, `width`, `force`, `symmetric` as of `fuge_halfplane_field`; `element` FUGE_CENTRE or FUGE_MEAN. Errors, the
  !> field unchanged: those of `fuge_layered_halfplane_matrix`, FUGE_ERR_CALL_ORDER for a body that is not set,
  !> FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_MEMORY.
  subroutine set_cells(self, body, x, width, force, element, info, symmetric)
    use fuge_layered_halfplane_interior, only: fuge_layered_halfplane_displacement
    class(fuge_layered_line_field), intent(inout) :: self
    type(fuge_layered_body), intent(in) :: body
    real(dp), intent(in) :: x(:), width(:), force(:)
    integer, intent(in) :: element
    type(fuge_info), intent(out) :: info
    logical, intent(in), optional :: symmetric
    type(halfplane_loads) :: loads
    real(dp) :: nowhere(2, 0)

    ! The checks of a field at no point.
    call fuge_layered_halfplane_displacement(body, x, width, force, element, nowhere(1, :), nowhere(2, :), nowhere, &
                                             info, symmetric=symmetric)
    if (.not. info%failed()) call loads%set_cells(x, width, force, element, info, symmetric)
    if (.not. info%failed()) call take_line(self, body, loads)
  end subroutine set_cells

  !> Equal cells side by side, the first one at x = 0, on a body of layers.
  !>
  !> `spacing`, `force`, `boundary` as of `fuge_halfplane_field`; all else as of `set_cells`. Errors as there,
  !> FUGE_ERR_OPTION for `boundary`, FUGE_ERR_UNSUPPORTED in a library without FFTW.
  subroutine set_line(self, body, spacing, force, element, boundary, info)
    use fuge_layered_halfplane_depths, only: fuge_layered_halfplane_displacement_grid
    class(fuge_layered_line_field), intent(inout) :: self
    type(fuge_layered_body), intent(in) :: body
    real(dp), intent(in) :: spacing, force(:)
    integer, intent(in) :: element, boundary
    type(fuge_info), intent(out) :: info
    type(halfplane_loads) :: loads
    real(dp) :: nothing(2, size(force), 0)

    call fuge_layered_halfplane_displacement_grid(body, spacing, force, element, boundary, nothing(1, 1, :), nothing, &
                                                  info)
    if (.not. info%failed()) call loads%set_grid(spacing, force, element, boundary, info)
    if (.not. info%failed()) call take_line(self, body, loads)
  end subroutine set_line

  subroutine take_line(field, body, loads)
    class(fuge_layered_line_field), intent(inout) :: field
    type(fuge_layered_body), intent(in) :: body
    type(halfplane_loads), intent(in) :: loads

    field%body = body
    field%loads = loads
    field%is_set = .true.
    field%has_places = loads%has_places()
    field%cells = loads%cells()
  end subroutine take_line

  !> Poisson's ratio of the layer at each depth.
  subroutine find_ratios(body, depth, below, ratio, info)
    use fuge_layer_checks, only: find_layers
    use fuge_layer_stack, only: layer_stack
    type(fuge_layered_body), intent(in) :: body
    real(dp), intent(in) :: depth(:)
    logical, intent(in) :: below(:)
    real(dp), intent(out) :: ratio(:)
    type(fuge_info), intent(inout) :: info
    type(layer_stack) :: stack
    integer, allocatable :: layer(:)

    ratio = 0.0_dp
    call find_layers(body, depth, 'place', layer, info, below)
    if (.not. info%failed()) call copy_layers(body, stack, info)
    if (.not. info%failed()) ratio = stack%poisson(layer)
  end subroutine find_ratios

  subroutine line_stress(self, place, below, values, info)
    use fuge_layered_halfplane_interior, only: fuge_layered_halfplane_stress
    use fuge_stress_measures, only: fuge_halfplane_tensor
    class(fuge_layered_line_field), intent(in) :: self
    real(dp), intent(in) :: place(:, :)
    logical, intent(in) :: below(:)
    real(dp), intent(inout) :: values(:, :)
    type(fuge_info), intent(out) :: info
    real(dp), allocatable :: component(:, :), ratio(:)
    integer :: k, stat

    allocate (component(3, size(below)), ratio(size(below)), stat=stat)
    call require_memory(stat, 'stresses at', size(below), 'points', info)
    if (stat /= 0) return
    call fuge_layered_halfplane_stress(self%body, self%loads%x, self%loads%width, self%loads%force, &
                                       self%loads%element, place(1, :), place(3, :), component, info, below, &
                                       self%loads%symmetric)
    if (.not. info%failed()) call find_ratios(self%body, place(3, :), below, ratio, info)
    do k = 1, size(below)
      if (.not. info%failed()) call fuge_halfplane_tensor(component(:, k:k), FUGE_PLANE_STRAIN, ratio(k), &
                                                          values(:, k:k), info)
    end do
  end subroutine line_stress

  subroutine line_displacement(self, place, below, values, info)
    use fuge_layered_halfplane_interior, only: fuge_layered_halfplane_displacement
    class(fuge_layered_line_field), intent(in) :: self
    real(dp), intent(in) :: place(:, :)
    logical, intent(in) :: below(:)
    real(dp), intent(inout) :: values(:, :)
    type(fuge_info), intent(out) :: info
    real(dp), allocatable :: component(:, :)
    integer :: stat

    allocate (component(2, size(below)), stat=stat)
    call require_memory(stat, 'displacements at', size(below), 'points', info)
    if (stat /= 0) return
    call fuge_layered_halfplane_displacement(self%body, self%loads%x, self%loads%width, self%loads%force, &
                                             self%loads%element, place(1, :), place(3, :), component, info, below, &
                                             self%loads%symmetric)
    if (info%failed()) return
    values(1:3:2, :) = component
    values(2, :) = 0.0_dp
  end subroutine line_displacement

  subroutine line_grid_stress(self, depth, below, values, info)
    use fuge_layered_halfplane_depths, only: fuge_layered_halfplane_stress_grid
    use fuge_stress_measures, only: fuge_halfplane_tensor
    class(fuge_layered_line_field), intent(in) :: self
    real(dp), intent(in) :: depth(:)
    logical, intent(in) :: below(:)
    real(dp), intent(inout) :: values(:, :, :)
    type(fuge_info), intent(out) :: info
    real(dp), allocatable :: component(:, :, :), ratio(:)
    integer :: k, stat

    allocate (component(3, self%cells, size(below)), ratio(size(below)), stat=stat)
    call require_memory(stat, 'stresses at', size(below), 'depths', info)
    if (stat /= 0) return
    call fuge_layered_halfplane_stress_grid(self%body, self%loads%cell_width(), self%loads%force, self%loads%element, &
                                            self%loads%boundary, depth, component, info, below)
    if (.not. info%failed()) call find_ratios(self%body, depth, below, ratio, info)
    do k = 1, size(below)
      if (.not. info%failed()) call fuge_halfplane_tensor(component(:, :, k), FUGE_PLANE_STRAIN, ratio(k), &
                                                          values(:, :, k), info)
    end do
  end subroutine line_grid_stress

  subroutine line_grid_displacement(self, depth, below, values, info)
    use fuge_layered_halfplane_depths, only: fuge_layered_halfplane_displacement_grid
    class(fuge_layered_line_field), intent(in) :: self
    real(dp), intent(in) :: depth(:)
    logical, intent(in) :: below(:)
    real(dp), intent(inout) :: values(:, :, :)
    type(fuge_info), intent(out) :: info
    real(dp), allocatable :: component(:, :, :)
    integer :: stat

    allocate (component(2, self%cells, size(below)), stat=stat)
    call require_memory(stat, 'displacements at', size(below), 'depths', info)
    if (stat /= 0) return
    call fuge_layered_halfplane_displacement_grid(self%body, self%loads%cell_width(), self%loads%force, &
                                                  self%loads%element, self%loads%boundary, depth, component, info, &
                                                  below)
    if (info%failed()) return
    values(1:3:2, :, :) = component
    values(2, :, :) = 0.0_dp
  end subroutine line_grid_displacement

  subroutine line_largest(self, measure, peak, info)
    class(fuge_layered_line_field), intent(in) :: self
    integer, intent(in) :: measure
    type(fuge_stress_peak), intent(inout) :: peak
    type(fuge_info), intent(out) :: info

    call find_largest(self, self%body, [self%loads%cell_width(), 0.0_dp], [self%cells, 1], self%loads%force, measure, &
                      peak, info)
    if (.not. info%failed()) peak%place(1) = self%loads%x(peak%cell)
  end subroutine line_largest

  subroutine line_interfaces(self, peaks, info)
    class(fuge_layered_line_field), intent(in) :: self
    type(fuge_interface_stress), allocatable, intent(inout) :: peaks(:)
    type(fuge_info), intent(out) :: info

    call find_interfaces(self, self%body, peaks, info)
  end subroutine line_interfaces

  !> Rectangles on a body of layers; all else as of `fuge_layered_line_field` and `fuge_halfspace_field`. Ten arguments:
  !> the layers and the rectangles.
  subroutine set_rectangles(self, body, x, y, width_x, width_y, force, info, symmetric_x, symmetric_y)
    use fuge_layered_halfspace_interior, only: fuge_layered_halfspace_displacement
    class(fuge_layered_area_field), intent(inout) :: self
    type(fuge_layered_body), intent(in) :: body
    real(dp), intent(in) :: x(:), y(:), width_x(:), width_y(:), force(:)
    type(fuge_info), intent(out) :: info
    logical, intent(in), optional :: symmetric_x, symmetric_y
    type(halfspace_loads) :: loads
    real(dp) :: nowhere(3, 0)

    call fuge_layered_halfspace_displacement(body, x, y, width_x, width_y, force, nowhere(1, :), nowhere(2, :), &
                                             nowhere(3, :), nowhere, info, symmetric_x=symmetric_x, &
                                             symmetric_y=symmetric_y)
    if (.not. info%failed()) call loads%set_rectangles(x, y, width_x, width_y, force, info, symmetric_x, symmetric_y)
    if (.not. info%failed()) call take_area(self, body, loads)
  end subroutine set_rectangles

  !> `nx` x `ny` equal cells side by side, the first one at x = y = 0, on a body of layers. Nine arguments: the layers
  !> and the grid. All else as of `fuge_layered_line_field` and `fuge_halfspace_field`.
  subroutine set_area(self, body, nx, ny, spacing_x, spacing_y, force, boundary, info)
    use fuge_layered_halfspace_depths, only: fuge_layered_halfspace_displacement_grid
    class(fuge_layered_area_field), intent(inout) :: self
    type(fuge_layered_body), intent(in) :: body
    integer, intent(in) :: nx, ny, boundary
    real(dp), intent(in) :: spacing_x, spacing_y, force(:)
    type(fuge_info), intent(out) :: info
    type(halfspace_loads) :: loads
    real(dp) :: nothing(3, size(force), 0)

    call fuge_layered_halfspace_displacement_grid(body, nx, ny, spacing_x, spacing_y, force, boundary, &
                                                  nothing(1, 1, :), nothing, info)
    if (.not. info%failed()) call loads%set_grid([nx, ny], [spacing_x, spacing_y], force, boundary, info)
    if (.not. info%failed()) call take_area(self, body, loads)
  end subroutine set_area

  subroutine take_area(field, body, loads)
    class(fuge_layered_area_field), intent(inout) :: field
    type(fuge_layered_body), intent(in) :: body
    type(halfspace_loads), intent(in) :: loads

    field%body = body
    field%loads = loads
    field%is_set = .true.
    field%has_places = loads%has_places()
    field%cells = loads%cells()
  end subroutine take_area

  subroutine area_stress(self, place, below, values, info)
    use fuge_layered_halfspace_interior, only: fuge_layered_halfspace_stress
    class(fuge_layered_area_field), intent(in) :: self
    real(dp), intent(in) :: place(:, :)
    logical, intent(in) :: below(:)
    real(dp), intent(inout) :: values(:, :)
    type(fuge_info), intent(out) :: info

    call fuge_layered_halfspace_stress(self%body, self%loads%x, self%loads%y, self%loads%width_x, self%loads%width_y, &
                                       self%loads%force, place(1, :), place(2, :), place(3, :), values, info, below, &
                                       self%loads%symmetric(1), self%loads%symmetric(2))
  end subroutine area_stress

  subroutine area_displacement(self, place, below, values, info)
    use fuge_layered_halfspace_interior, only: fuge_layered_halfspace_displacement
    class(fuge_layered_area_field), intent(in) :: self
    real(dp), intent(in) :: place(:, :)
    logical, intent(in) :: below(:)
    real(dp), intent(inout) :: values(:, :)
    type(fuge_info), intent(out) :: info

    call fuge_layered_halfspace_displacement(self%body, self%loads%x, self%loads%y, self%loads%width_x, &
                                             self%loads%width_y, self%loads%force, place(1, :), place(2, :), &
                                             place(3, :), values, info, below, self%loads%symmetric(1), &
                                             self%loads%symmetric(2))
  end subroutine area_displacement

  subroutine area_grid_stress(self, depth, below, values, info)
    use fuge_layered_halfspace_depths, only: fuge_layered_halfspace_stress_grid
    class(fuge_layered_area_field), intent(in) :: self
    real(dp), intent(in) :: depth(:)
    logical, intent(in) :: below(:)
    real(dp), intent(inout) :: values(:, :, :)
    type(fuge_info), intent(out) :: info
    real(dp) :: spacing(2)

    spacing = self%loads%cell_widths()
    call fuge_layered_halfspace_stress_grid(self%body, self%loads%sides(1), self%loads%sides(2), spacing(1), &
                                            spacing(2), self%loads%force, self%loads%boundary, depth, values, info, &
                                            below)
  end subroutine area_grid_stress

  subroutine area_grid_displacement(self, depth, below, values, info)
    use fuge_layered_halfspace_depths, only: fuge_layered_halfspace_displacement_grid
    class(fuge_layered_area_field), intent(in) :: self
    real(dp), intent(in) :: depth(:)
    logical, intent(in) :: below(:)
    real(dp), intent(inout) :: values(:, :, :)
    type(fuge_info), intent(out) :: info
    real(dp) :: spacing(2)

    spacing = self%loads%cell_widths()
    call fuge_layered_halfspace_displacement_grid(self%body, self%loads%sides(1), self%loads%sides(2), spacing(1), &
                                                  spacing(2), self%loads%force, self%loads%boundary, depth, values, &
                                                  info, below)
  end subroutine area_grid_displacement

  subroutine area_largest(self, measure, peak, info)
    class(fuge_layered_area_field), intent(in) :: self
    integer, intent(in) :: measure
    type(fuge_stress_peak), intent(inout) :: peak
    type(fuge_info), intent(out) :: info

    call find_largest(self, self%body, self%loads%cell_widths(), self%loads%sides, self%loads%force, measure, peak, &
                      info)
    if (.not. info%failed()) peak%place(:2) = [self%loads%x(peak%cell), self%loads%y(peak%cell)]
  end subroutine area_largest

  subroutine area_interfaces(self, peaks, info)
    class(fuge_layered_area_field), intent(in) :: self
    type(fuge_interface_stress), allocatable, intent(inout) :: peaks(:)
    type(fuge_info), intent(out) :: info

    call find_interfaces(self, self%body, peaks, info)
  end subroutine area_interfaces

  !> The largest stress below a grid of `sides` cells of the widths `spacing`; on a line the second one is 0.
  subroutine find_largest(field, body, spacing, sides, force, measure, peak, info)
    use fuge_layer_peaks, only: find_layer_peak
    use fuge_layer_stack, only: layer_stack
    class(fuge_field), intent(in) :: field
    type(fuge_layered_body), intent(in) :: body
    real(dp), intent(in) :: spacing(2), force(:)
    integer, intent(in) :: sides(2), measure
    type(fuge_stress_peak), intent(inout) :: peak
    type(fuge_info), intent(out) :: info
    type(layer_stack) :: stack
    integer :: high(2), k, low(2)

    call require_grid(field, info)
    if (.not. info%failed()) call copy_layers(body, stack, info)
    if (info%failed()) return
    low = sides
    high = -1
    do k = 0, size(force) - 1
      if (.not. abs(force(k + 1)) > 0.0_dp) cycle
      low = min(low, [modulo(k, sides(1)), k/sides(1)])
      high = max(high, [modulo(k, sides(1)), k/sides(1)])
    end do
    call find_layer_peak(field, stack, minval(spacing, spacing > 0.0_dp), &
                         max(0.0_dp, maxval(real(high - low + 1, dp)*spacing)), measure, peak, info)
  end subroutine find_largest

  !> The largest stresses of the surface and of all interfaces.
  subroutine find_interfaces(field, body, peaks, info)
    use fuge_layer_peaks, only: find_interface_peaks
    use fuge_layer_stack, only: layer_stack
    class(fuge_field), intent(in) :: field
    type(fuge_layered_body), intent(in) :: body
    type(fuge_interface_stress), allocatable, intent(inout) :: peaks(:)
    type(fuge_info), intent(out) :: info
    type(fuge_interface_stress), allocatable :: found(:)
    type(layer_stack) :: stack
    integer :: stat

    call require_grid(field, info)
    if (.not. info%failed()) call copy_layers(body, stack, info)
    if (info%failed()) return
    allocate (found(body%interfaces() + 1), stat=stat)
    call require_memory(stat, 'the stresses of', body%interfaces(), 'interfaces', info)
    if (.not. info%failed()) call find_interface_peaks(field, stack, found, info)
    if (.not. info%failed()) call move_alloc(found, peaks)
  end subroutine find_interfaces

  !> Refuse a field that is not that of a grid.
  subroutine require_grid(field, info)
    class(fuge_field), intent(in) :: field
    type(fuge_info), intent(out) :: info

    if (field%cells == 0) call report(info, FUGE_ERR_UNSUPPORTED, 'in layers the largest stresses are those ' &
                                      //'below the cells of a grid: set the field by a grid')
  end subroutine require_grid

end module fuge_field_of_layers
