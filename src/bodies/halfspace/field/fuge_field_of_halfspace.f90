!> The field in a half-space under rectangles of pressure.
module fuge_field_of_halfspace
  use fuge_field_type, only: fuge_field, require_places
  use fuge_halfspace_loads, only: halfspace_loads
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info
  use fuge_stress_peak_type, only: fuge_stress_peak
  implicit none
  private

  !> Made by `set_rectangles` or `set_grid`.
  type, extends(fuge_field), public :: fuge_halfspace_field
    private
    type(halfspace_loads) :: loads
    real(dp) :: young = 0.0_dp, poisson = 0.0_dp
  contains
    procedure :: set_rectangles
    procedure :: set_grid
    procedure :: find_stress
    procedure :: find_displacement
    procedure :: find_grid_stress
    procedure :: find_grid_displacement
    procedure :: find_largest
  end type fuge_halfspace_field

contains

  !> Rectangles on a half-space.
  !>
  !> `x`, `y`, `width_x`, `width_y` and `symmetric_x`, `symmetric_y` (default .false.) as for `fuge_halfspace_matrix`;
  !> `force` (rectangles) of a solution; `young`, force per length squared, which may be infinite, and `poisson` of the
  !> body. Errors, the field unchanged: those of `fuge_halfspace_matrix`, FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE,
  !> FUGE_ERR_MODULUS, FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY. Eleven arguments: the rectangles and the body.
  subroutine set_rectangles(self, x, y, width_x, width_y, force, young, poisson, info, symmetric_x, symmetric_y)
    use fuge_halfspace_interior, only: fuge_halfspace_displacement
    class(fuge_halfspace_field), intent(inout) :: self
    real(dp), intent(in) :: x(:), y(:), width_x(:), width_y(:), force(:), young, poisson
    type(fuge_info), intent(out) :: info
    logical, intent(in), optional :: symmetric_x, symmetric_y
    type(halfspace_loads) :: loads
    real(dp) :: nowhere(3, 0)

    ! The checks of a field at no point.
    call fuge_halfspace_displacement(x, y, width_x, width_y, force, young, poisson, nowhere(1, :), nowhere(2, :), &
                                     nowhere(3, :), nowhere, info, symmetric_x, symmetric_y)
    if (.not. info%failed()) call loads%set_rectangles(x, y, width_x, width_y, force, info, symmetric_x, symmetric_y)
    if (.not. info%failed()) call take(self, loads, young, poisson)
  end subroutine set_rectangles

  !> `nx` x `ny` equal cells side by side, the first one at x = y = 0.
  !>
  !> `spacing_x`, `spacing_y` > 0, length; `force` (nx*ny) of a solution; `boundary` as of `fuge_halfspace_operator`;
  !> the body as of `set_rectangles`. Errors as there, FUGE_ERR_OPTION for `boundary`, FUGE_ERR_UNSUPPORTED in a library
  !> without FFTW. Ten arguments: the grid and the body.
  subroutine set_grid(self, nx, ny, spacing_x, spacing_y, force, boundary, young, poisson, info)
    use fuge_halfspace_depths, only: fuge_halfspace_displacement_grid
    class(fuge_halfspace_field), intent(inout) :: self
    integer, intent(in) :: nx, ny, boundary
    real(dp), intent(in) :: spacing_x, spacing_y, force(:), young, poisson
    type(fuge_info), intent(out) :: info
    type(halfspace_loads) :: loads
    real(dp) :: nothing(3, size(force), 0)

    call fuge_halfspace_displacement_grid(nx, ny, spacing_x, spacing_y, force, boundary, young, poisson, &
                                          nothing(1, 1, :), nothing, info)
    if (.not. info%failed()) call loads%set_grid([nx, ny], [spacing_x, spacing_y], force, boundary, info)
    if (.not. info%failed()) call take(self, loads, young, poisson)
  end subroutine set_grid

  subroutine take(field, loads, young, poisson)
    class(fuge_halfspace_field), intent(inout) :: field
    type(halfspace_loads), intent(in) :: loads
    real(dp), intent(in) :: young, poisson

    field%loads = loads
    field%young = young
    field%poisson = poisson
    field%is_set = .true.
    field%has_places = loads%has_places()
    field%cells = loads%cells()
  end subroutine take

  subroutine find_stress(self, place, below, values, info)
    use fuge_halfspace_interior, only: fuge_halfspace_stress
    class(fuge_halfspace_field), intent(in) :: self
    real(dp), intent(in) :: place(:, :)
    logical, intent(in) :: below(:)
    real(dp), intent(inout) :: values(:, :)
    type(fuge_info), intent(out) :: info

    call fuge_halfspace_stress(self%loads%x, self%loads%y, self%loads%width_x, self%loads%width_y, self%loads%force, &
                               self%poisson, place(1, :), place(2, :), place(3, :), values, info, &
                               self%loads%symmetric(1), self%loads%symmetric(2))
    if (size(below) < 0) continue
  end subroutine find_stress

  subroutine find_displacement(self, place, below, values, info)
    use fuge_halfspace_interior, only: fuge_halfspace_displacement
    class(fuge_halfspace_field), intent(in) :: self
    real(dp), intent(in) :: place(:, :)
    logical, intent(in) :: below(:)
    real(dp), intent(inout) :: values(:, :)
    type(fuge_info), intent(out) :: info

    call fuge_halfspace_displacement(self%loads%x, self%loads%y, self%loads%width_x, self%loads%width_y, &
                                     self%loads%force, self%young, self%poisson, place(1, :), place(2, :), &
                                     place(3, :), values, info, self%loads%symmetric(1), self%loads%symmetric(2))
    if (size(below) < 0) continue
  end subroutine find_displacement

  subroutine find_grid_stress(self, depth, below, values, info)
    use fuge_halfspace_depths, only: fuge_halfspace_stress_grid
    class(fuge_halfspace_field), intent(in) :: self
    real(dp), intent(in) :: depth(:)
    logical, intent(in) :: below(:)
    real(dp), intent(inout) :: values(:, :, :)
    type(fuge_info), intent(out) :: info
    real(dp) :: spacing(2)

    spacing = self%loads%cell_widths()
    call fuge_halfspace_stress_grid(self%loads%sides(1), self%loads%sides(2), spacing(1), spacing(2), &
                                    self%loads%force, self%loads%boundary, self%poisson, depth, values, info)
    if (size(below) < 0) continue
  end subroutine find_grid_stress

  subroutine find_grid_displacement(self, depth, below, values, info)
    use fuge_halfspace_depths, only: fuge_halfspace_displacement_grid
    class(fuge_halfspace_field), intent(in) :: self
    real(dp), intent(in) :: depth(:)
    logical, intent(in) :: below(:)
    real(dp), intent(inout) :: values(:, :, :)
    type(fuge_info), intent(out) :: info
    real(dp) :: spacing(2)

    spacing = self%loads%cell_widths()
    call fuge_halfspace_displacement_grid(self%loads%sides(1), self%loads%sides(2), spacing(1), spacing(2), &
                                          self%loads%force, self%loads%boundary, self%young, self%poisson, depth, &
                                          values, info)
    if (size(below) < 0) continue
  end subroutine find_grid_displacement

  subroutine find_largest(self, measure, peak, info)
    use fuge_peak_search, only: find_peak
    use fuge_pressed_cells, only: pressed_cells
    class(fuge_halfspace_field), intent(in) :: self
    integer, intent(in) :: measure
    type(fuge_stress_peak), intent(inout) :: peak
    type(fuge_info), intent(out) :: info
    type(pressed_cells) :: cells

    call require_places(self, info)
    if (.not. info%failed()) call self%loads%find_pressed(cells, info)
    cells%surface_factor = 1.0_dp - 2.0_dp*self%poisson
    if (cells%surface_counts()) call cells%find_surface(info)
    call find_peak(self, cells, measure, peak, info)
  end subroutine find_largest

end module fuge_field_of_halfspace
