!> The field in a half-space under rings of pressure about one axis.
module fuge_field_of_rings
  use fuge_field_type, only: fuge_field
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info, require_memory
  use fuge_stress_peak_type, only: fuge_stress_peak
  implicit none
  private

  !> Made by `set`.
  type, extends(fuge_field), public :: fuge_rings_field
    private
    real(dp), allocatable :: radius(:), force(:)
    real(dp) :: young = 0.0_dp, poisson = 0.0_dp
  contains
    procedure :: set
    procedure :: find_stress
    procedure :: find_displacement
    procedure :: find_largest
  end type fuge_rings_field

contains

  !> Rings on a half-space: `radius` (rings + 1) as for `fuge_ring_matrix`, `force` (rings) of a solution; `young`,
  !> force per length squared, which may be infinite, and `poisson` of the body.
  !>
  !> Errors, the field unchanged: those of `fuge_ring_matrix`, FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_MODULUS,
  !> FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY.
  subroutine set(self, radius, force, young, poisson, info)
    use fuge_ring_interior, only: fuge_ring_interior_displacement
    class(fuge_rings_field), intent(inout) :: self
    real(dp), intent(in) :: radius(:), force(:), young, poisson
    type(fuge_info), intent(out) :: info
    real(dp), allocatable :: kept(:), kept_force(:)
    real(dp) :: nowhere(2, 0)
    integer :: stat

    ! The checks of a field at no point.
    call fuge_ring_interior_displacement(radius, force, young, poisson, nowhere(1, :), nowhere(2, :), nowhere, info)
    if (info%failed()) return
    allocate (kept(size(radius)), kept_force(size(force)), stat=stat)
    call require_memory(stat, 'the field of', size(force), 'rings', info)
    if (stat /= 0) return
    kept = radius
    kept_force = force
    call move_alloc(kept, self%radius)
    call move_alloc(kept_force, self%force)
    self%young = young
    self%poisson = poisson
    self%is_set = .true.
  end subroutine set

  subroutine find_stress(self, place, below, values, info)
    use fuge_ring_interior, only: fuge_ring_stress
    use fuge_stress_measures, only: fuge_round_tensor
    class(fuge_rings_field), intent(in) :: self
    real(dp), intent(in) :: place(:, :)
    logical, intent(in) :: below(:)
    real(dp), intent(inout) :: values(:, :)
    type(fuge_info), intent(out) :: info
    real(dp), allocatable :: component(:, :)
    integer :: stat

    allocate (component(4, size(below)), stat=stat)
    call require_memory(stat, 'stresses at', size(below), 'points', info)
    if (stat /= 0) return
    call fuge_ring_stress(self%radius, self%force, self%poisson, place(1, :), place(3, :), component, info)
    if (.not. info%failed()) call fuge_round_tensor(component, values, info)
  end subroutine find_stress

  subroutine find_displacement(self, place, below, values, info)
    use fuge_ring_interior, only: fuge_ring_interior_displacement
    class(fuge_rings_field), intent(in) :: self
    real(dp), intent(in) :: place(:, :)
    logical, intent(in) :: below(:)
    real(dp), intent(inout) :: values(:, :)
    type(fuge_info), intent(out) :: info
    real(dp), allocatable :: component(:, :)
    integer :: stat

    allocate (component(2, size(below)), stat=stat)
    call require_memory(stat, 'displacements at', size(below), 'points', info)
    if (stat /= 0) return
    call fuge_ring_interior_displacement(self%radius, self%force, self%young, self%poisson, place(1, :), place(3, :), &
                                         component, info)
    if (info%failed()) return
    values(1:3:2, :) = component
    values(2, :) = 0.0_dp
  end subroutine find_displacement

  subroutine find_largest(self, measure, peak, info)
    use fuge_peak_search, only: find_peak
    use fuge_pressed_cells, only: pressed_cells
    class(fuge_rings_field), intent(in) :: self
    integer, intent(in) :: measure
    type(fuge_stress_peak), intent(inout) :: peak
    type(fuge_info), intent(out) :: info
    type(pressed_cells) :: cells

    call collect_rings(self, cells, info)
    if (cells%surface_counts()) call cells%find_surface(info)
    call find_peak(self, cells, measure, peak, info)
  end subroutine find_largest

  !> The rings with a force, on both sides of the axis. FUGE_ERR_MEMORY.
  pure subroutine collect_rings(field, cells, info)
    use fuge_constants, only: PI
    use fuge_pressed_cells, only: allocate_cells, pressed_cells
    type(fuge_rings_field), intent(in) :: field
    type(pressed_cells), intent(out) :: cells
    type(fuge_info), intent(out) :: info
    real(dp) :: width
    integer :: k, number

    number = 2*count(abs(field%force) > 0.0_dp)
    call allocate_cells(1, number, cells, info)
    if (info%failed()) return
    cells%symmetric(1) = .true.
    cells%surface_factor = 1.0_dp - 2.0_dp*field%poisson
    number = 0
    do k = 1, size(field%force)
      if (.not. abs(field%force(k)) > 0.0_dp) cycle
      width = field%radius(k + 1) - field%radius(k)
      number = number + 2
      cells%centre(1, number - 1:number) = (field%radius(k) + 0.5_dp*width)*[1.0_dp, -1.0_dp]
      cells%width(1, number - 1:number) = width
      cells%pressure(number - 1:number) = field%force(k)/width/(PI*(field%radius(k) + field%radius(k + 1)))
    end do
  end subroutine collect_rings

end module fuge_field_of_rings
