!> The field in a half-plane under cells of pressure.
module fuge_field_of_halfplane
  use fuge_field_type, only: fuge_field, require_places
  use fuge_halfplane_loads, only: halfplane_loads
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info, require_memory
  use fuge_stress_peak_type, only: fuge_stress_peak
  implicit none
  private

  !> Made by `set_cells` or `set_grid`.
  type, extends(fuge_field), public :: fuge_halfplane_field
    private
    type(halfplane_loads) :: loads
    real(dp) :: young = 0.0_dp, poisson = 0.0_dp
    integer :: plane_state = 0
  contains
    procedure :: set_cells
    procedure :: set_grid
    procedure :: find_stress
    procedure :: find_displacement
    procedure :: find_grid_stress
    procedure :: find_grid_displacement
    procedure :: find_largest
  end type fuge_halfplane_field

contains

  !> Cells on a half-plane.
  !>
  !> `x`, `width`, `element` and `symmetric` (default .false.) as for `fuge_halfplane_matrix`; `force` (cells), force
  !> per unit depth, of a solution; `young`, `poisson`, `plane_state` of the body as for `fuge_plane_modulus`. Errors,
  !> the field unchanged: those of these two; FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY.
  !> Ten arguments: the cells and the body.
  subroutine set_cells(self, x, width, force, element, young, poisson, plane_state, info, symmetric)
    use fuge_halfplane_interior, only: fuge_halfplane_displacement
    class(fuge_halfplane_field), intent(inout) :: self
    real(dp), intent(in) :: x(:), width(:), force(:), young, poisson
    integer, intent(in) :: element, plane_state
    type(fuge_info), intent(out) :: info
    logical, intent(in), optional :: symmetric
    type(halfplane_loads) :: loads
    real(dp) :: nowhere(2, 0)

    ! The checks of a field at no point.
    call fuge_halfplane_displacement(x, width, force, element, young, poisson, plane_state, nowhere(1, :), &
                                     nowhere(2, :), nowhere, info, symmetric)
    if (.not. info%failed()) call loads%set_cells(x, width, force, element, info, symmetric)
    if (.not. info%failed()) call take(self, loads, young, poisson, plane_state)
  end subroutine set_cells

  !> Equal cells side by side, the first one at x = 0.
  !>
  !> `spacing` > 0, length; `force` (cells), force per unit depth; `element` and `boundary` as of
  !> `fuge_halfplane_operator`; the body as of `set_cells`. Errors as there, FUGE_ERR_OPTION for `boundary`,
  !> FUGE_ERR_UNSUPPORTED in a library without FFTW. Nine arguments: the grid and the body.
  subroutine set_grid(self, spacing, force, element, boundary, young, poisson, plane_state, info)
    use fuge_halfplane_depths, only: fuge_halfplane_displacement_grid
    class(fuge_halfplane_field), intent(inout) :: self
    real(dp), intent(in) :: spacing, force(:), young, poisson
    integer, intent(in) :: element, boundary, plane_state
    type(fuge_info), intent(out) :: info
    type(halfplane_loads) :: loads
    real(dp) :: nothing(2, size(force), 0)

    call fuge_halfplane_displacement_grid(spacing, force, element, boundary, young, poisson, plane_state, &
                                          nothing(1, 1, :), nothing, info)
    if (.not. info%failed()) call loads%set_grid(spacing, force, element, boundary, info)
    if (.not. info%failed()) call take(self, loads, young, poisson, plane_state)
  end subroutine set_grid

  subroutine take(field, loads, young, poisson, plane_state)
    class(fuge_halfplane_field), intent(inout) :: field
    type(halfplane_loads), intent(in) :: loads
    real(dp), intent(in) :: young, poisson
    integer, intent(in) :: plane_state

    field%loads = loads
    field%young = young
    field%poisson = poisson
    field%plane_state = plane_state
    field%is_set = .true.
    field%has_places = loads%has_places()
    field%cells = loads%cells()
  end subroutine take

  subroutine find_stress(self, place, below, values, info)
    use fuge_halfplane_interior, only: fuge_halfplane_stress
    use fuge_stress_measures, only: fuge_halfplane_tensor
    class(fuge_halfplane_field), intent(in) :: self
    real(dp), intent(in) :: place(:, :)
    logical, intent(in) :: below(:)
    real(dp), intent(inout) :: values(:, :)
    type(fuge_info), intent(out) :: info
    real(dp), allocatable :: component(:, :)
    integer :: stat

    allocate (component(3, size(below)), stat=stat)
    call require_memory(stat, 'stresses at', size(below), 'points', info)
    if (stat /= 0) return
    call fuge_halfplane_stress(self%loads%x, self%loads%width, self%loads%force, self%loads%element, place(1, :), &
                               place(3, :), component, info, self%loads%symmetric)
    if (.not. info%failed()) call fuge_halfplane_tensor(component, self%plane_state, self%poisson, values, info)
  end subroutine find_stress

  subroutine find_displacement(self, place, below, values, info)
    use fuge_halfplane_interior, only: fuge_halfplane_displacement
    class(fuge_halfplane_field), intent(in) :: self
    real(dp), intent(in) :: place(:, :)
    logical, intent(in) :: below(:)
    real(dp), intent(inout) :: values(:, :)
    type(fuge_info), intent(out) :: info
    real(dp), allocatable :: component(:, :)
    integer :: stat

    allocate (component(2, size(below)), stat=stat)
    call require_memory(stat, 'displacements at', size(below), 'points', info)
    if (stat /= 0) return
    call fuge_halfplane_displacement(self%loads%x, self%loads%width, self%loads%force, self%loads%element, self%young, &
                                     self%poisson, self%plane_state, place(1, :), place(3, :), component, info, &
                                     self%loads%symmetric)
    if (info%failed()) return
    values(1:3:2, :) = component
    values(2, :) = 0.0_dp
  end subroutine find_displacement

  subroutine find_grid_stress(self, depth, below, values, info)
    use fuge_halfplane_depths, only: fuge_halfplane_stress_grid
    use fuge_stress_measures, only: fuge_halfplane_tensor
    class(fuge_halfplane_field), intent(in) :: self
    real(dp), intent(in) :: depth(:)
    logical, intent(in) :: below(:)
    real(dp), intent(inout) :: values(:, :, :)
    type(fuge_info), intent(out) :: info
    real(dp), allocatable :: component(:, :, :)
    integer :: k, stat

    allocate (component(3, self%cells, size(below)), stat=stat)
    call require_memory(stat, 'stresses at', size(below), 'depths', info)
    if (stat /= 0) return
    call fuge_halfplane_stress_grid(self%loads%cell_width(), self%loads%force, self%loads%element, &
                                    self%loads%boundary, depth, component, info)
    do k = 1, size(depth)
      if (.not. info%failed()) call fuge_halfplane_tensor(component(:, :, k), self%plane_state, self%poisson, &
                                                          values(:, :, k), info)
    end do
  end subroutine find_grid_stress

  subroutine find_grid_displacement(self, depth, below, values, info)
    use fuge_halfplane_depths, only: fuge_halfplane_displacement_grid
    class(fuge_halfplane_field), intent(in) :: self
    real(dp), intent(in) :: depth(:)
    logical, intent(in) :: below(:)
    real(dp), intent(inout) :: values(:, :, :)
    type(fuge_info), intent(out) :: info
    real(dp), allocatable :: component(:, :, :)
    integer :: stat

    allocate (component(2, self%cells, size(below)), stat=stat)
    call require_memory(stat, 'displacements at', size(below), 'depths', info)
    if (stat /= 0) return
    call fuge_halfplane_displacement_grid(self%loads%cell_width(), self%loads%force, self%loads%element, &
                                          self%loads%boundary, self%young, self%poisson, self%plane_state, depth, &
                                          component, info)
    if (info%failed()) return
    values(1:3:2, :, :) = component
    values(2, :, :) = 0.0_dp
  end subroutine find_grid_displacement

  subroutine find_largest(self, measure, peak, info)
    use fuge_elastic_moduli, only: FUGE_PLANE_STRAIN
    use fuge_peak_search, only: find_peak
    use fuge_pressed_cells, only: pressed_cells
    class(fuge_halfplane_field), intent(in) :: self
    integer, intent(in) :: measure
    type(fuge_stress_peak), intent(inout) :: peak
    type(fuge_info), intent(out) :: info
    type(pressed_cells) :: cells

    call require_places(self, info)
    if (.not. info%failed()) call self%loads%find_pressed(cells, info)
    if (self%plane_state == FUGE_PLANE_STRAIN) cells%surface_factor = 1.0_dp - 2.0_dp*self%poisson
    call find_peak(self, cells, measure, peak, info)
  end subroutine find_largest

end module fuge_field_of_halfplane
