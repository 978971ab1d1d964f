!> The forces of a contact on the surface of a half-plane, as a field keeps them.
module fuge_halfplane_loads
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  !> Cells, or the cells of a grid, of which the first one lies at x = 0.
  type, public :: halfplane_loads
    real(dp), allocatable :: x(:), width(:), force(:)
    integer :: element = 0, boundary = 0
    logical :: symmetric = .false., is_grid = .false.
  contains
    procedure :: set_cells
    procedure :: set_grid
    procedure :: cell_width
    procedure :: has_places
    procedure :: cells
    procedure :: find_pressed
  end type halfplane_loads

contains

  !> Keep cells; FUGE_ERR_MEMORY.
  subroutine set_cells(self, x, width, force, element, info, symmetric)
    class(halfplane_loads), intent(out) :: self
    real(dp), intent(in) :: x(:), width(:), force(:)
    integer, intent(in) :: element
    type(fuge_info), intent(inout) :: info
    logical, intent(in), optional :: symmetric
    integer :: stat

    if (info%failed()) return
    allocate (self%x(size(x)), self%width(size(width)), self%force(size(force)), stat=stat)
    call require_memory(stat, 'the field of', size(force), 'cells', info)
    if (stat /= 0) return
    self%x = x
    self%width = width
    self%force = force
    self%element = element
    if (present(symmetric)) self%symmetric = symmetric
  end subroutine set_cells

  !> Keep equal cells side by side; FUGE_ERR_MEMORY.
  subroutine set_grid(self, spacing, force, element, boundary, info)
    class(halfplane_loads), intent(out) :: self
    real(dp), intent(in) :: spacing, force(:)
    integer, intent(in) :: element, boundary
    type(fuge_info), intent(inout) :: info
    integer :: k

    call self%set_cells(force, force, force, element, info)
    if (info%failed()) return
    do k = 1, size(force)
      self%x(k) = spacing*real(k - 1, dp)
    end do
    self%width = spacing
    self%boundary = boundary
    self%is_grid = .true.
  end subroutine set_grid

  !> Width of a cell of a grid.
  pure function cell_width(self)
    class(halfplane_loads), intent(in) :: self
    real(dp) :: cell_width

    cell_width = 0.0_dp
    if (allocated(self%width)) cell_width = self%width(1)
  end function cell_width

  !> Number of cells of a grid; 0 if it is none.
  pure function cells(self)
    class(halfplane_loads), intent(in) :: self
    integer :: cells

    cells = 0
    if (self%is_grid) cells = size(self%force)
  end function cells

  !> Is the field known at any place, and not only below the cells of a grid?
  pure function has_places(self)
    use fuge_cell_elements, only: FUGE_FREE
    class(halfplane_loads), intent(in) :: self
    logical :: has_places

    has_places = self%boundary == FUGE_FREE
  end function has_places

  !> The cells with a force, of a symmetric line those on both sides. FUGE_ERR_MEMORY.
  pure subroutine find_pressed(self, pressed, info)
    use fuge_cell_elements, only: FUGE_HAT
    use fuge_pressed_cells, only: allocate_cells, is_own_image, pressed_cells
    class(halfplane_loads), intent(in) :: self
    type(pressed_cells), intent(inout) :: pressed
    type(fuge_info), intent(inout) :: info
    logical :: mirrored(size(self%force))
    integer :: k, number

    mirrored = self%symmetric .and. .not. is_own_image(self%x, self%width)
    number = count(abs(self%force) > 0.0_dp) + count(abs(self%force) > 0.0_dp .and. mirrored)
    call allocate_cells(1, number, pressed, info)
    if (info%failed()) return
    pressed%continuous = self%element == FUGE_HAT
    pressed%symmetric(1) = self%symmetric
    number = 0
    do k = 1, size(self%force)
      if (.not. abs(self%force(k)) > 0.0_dp) cycle
      number = number + 1
      pressed%centre(1, number) = self%x(k)
      pressed%width(1, number) = self%width(k)
      pressed%pressure(number) = self%force(k)/self%width(k)
      if (.not. mirrored(k)) cycle
      pressed%pressure(number) = 0.5_dp*pressed%pressure(number)
      number = number + 1
      pressed%centre(1, number) = -self%x(k)
      pressed%width(1, number) = self%width(k)
      pressed%pressure(number) = pressed%pressure(number - 1)
    end do
  end subroutine find_pressed

end module fuge_halfplane_loads
