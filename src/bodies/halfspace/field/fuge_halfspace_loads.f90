!> The forces of a contact on the surface of a half-space, as a field keeps them.
module fuge_halfspace_loads
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_SIZE
  implicit none
  private

  !> Rectangles, or the cells of a grid, of which the first one lies at x = y = 0.
  type, public :: halfspace_loads
    real(dp), allocatable :: x(:), y(:), width_x(:), width_y(:), force(:)
    integer :: sides(2) = 0, boundary = 0
    logical :: symmetric(2) = .false., is_grid = .false.
  contains
    procedure :: set_rectangles
    procedure :: set_grid
    procedure :: cell_widths
    procedure :: has_places
    procedure :: cells
    procedure :: find_pressed
  end type halfspace_loads

  !> Rectangles longer than LONGEST widths are cut for the search, into at most MOST_PIECES pieces.
  real(dp), parameter :: LONGEST = 4.0_dp
  integer, parameter :: MOST_PIECES = 32

contains

  !> Keep rectangles; FUGE_ERR_MEMORY. Nine arguments: the rectangles.
  subroutine set_rectangles(self, x, y, width_x, width_y, force, info, symmetric_x, symmetric_y)
    class(halfspace_loads), intent(out) :: self
    real(dp), intent(in) :: x(:), y(:), width_x(:), width_y(:), force(:)
    type(fuge_info), intent(inout) :: info
    logical, intent(in), optional :: symmetric_x, symmetric_y
    integer :: stat

    if (info%failed()) return
    allocate (self%x(size(x)), self%y(size(y)), self%width_x(size(width_x)), self%width_y(size(width_y)), &
              self%force(size(force)), stat=stat)
    call require_memory(stat, 'the field of', size(force), 'rectangles', info)
    if (stat /= 0) return
    self%x = x
    self%y = y
    self%width_x = width_x
    self%width_y = width_y
    self%force = force
    if (present(symmetric_x)) self%symmetric(1) = symmetric_x
    if (present(symmetric_y)) self%symmetric(2) = symmetric_y
  end subroutine set_rectangles

  !> Keep nx x ny equal cells side by side; FUGE_ERR_SIZE, FUGE_ERR_MEMORY.
  subroutine set_grid(self, sides, spacing, force, boundary, info)
    class(halfspace_loads), intent(out) :: self
    integer, intent(in) :: sides(2), boundary
    real(dp), intent(in) :: spacing(2), force(:)
    type(fuge_info), intent(inout) :: info
    integer :: k

    if (minval(sides) < 1 .or. abs(real(size(force), dp) - product(real(sides, dp))) > 0.0_dp) &
      call report(info, FUGE_ERR_SIZE, 'force needs a value for each of the nx*ny cells, nx and ny at least 1')
    call self%set_rectangles(force, force, force, force, force, info)
    if (info%failed()) return
    do k = 1, size(force)
      self%x(k) = spacing(1)*real(modulo(k - 1, sides(1)), dp)
      self%y(k) = spacing(2)*real((k - 1)/sides(1), dp)
    end do
    self%width_x = spacing(1)
    self%width_y = spacing(2)
    self%sides = sides
    self%boundary = boundary
    self%is_grid = .true.
  end subroutine set_grid

  !> Widths of a cell of a grid.
  pure function cell_widths(self)
    class(halfspace_loads), intent(in) :: self
    real(dp) :: cell_widths(2)

    cell_widths = 0.0_dp
    if (allocated(self%width_x)) cell_widths = [self%width_x(1), self%width_y(1)]
  end function cell_widths

  !> Number of cells of a grid; 0 if it is none.
  pure function cells(self)
    class(halfspace_loads), intent(in) :: self
    integer :: cells

    cells = 0
    if (self%is_grid) cells = size(self%force)
  end function cells

  !> Is the field known at any place, and not only below the cells of a grid?
  pure function has_places(self)
    use fuge_cell_elements, only: FUGE_FREE
    class(halfspace_loads), intent(in) :: self
    logical :: has_places

    has_places = self%boundary == FUGE_FREE
  end function has_places

  !> The rectangles with a force, of a symmetric area those on all sides. Long ones are cut, because the largest stress
  !> may lie below any part of them. FUGE_ERR_MEMORY.
  pure subroutine find_pressed(self, pressed, info)
    use fuge_pressed_cells, only: allocate_cells, pressed_cells
    class(halfspace_loads), intent(in) :: self
    type(pressed_cells), intent(inout) :: pressed
    type(fuge_info), intent(inout) :: info
    integer :: i, images(2), j, k, number

    number = 0
    do k = 1, size(self%force)
      if (abs(self%force(k)) > 0.0_dp) number = number + product(images_of(self, k))*pieces_of(self, k)
    end do
    call allocate_cells(2, number, pressed, info)
    if (info%failed()) return
    pressed%symmetric = self%symmetric
    number = 0
    do k = 1, size(self%force)
      if (.not. abs(self%force(k)) > 0.0_dp) cycle
      images = images_of(self, k)
      do j = 1, images(2)
        do i = 1, images(1)
          call cut([self%x(k), self%y(k)]*[3 - 2*i, 3 - 2*j], [self%width_x(k), self%width_y(k)], pieces_of(self, k), &
                   number, pressed)
        end do
      end do
      i = product(images)*pieces_of(self, k)
      pressed%pressure(number - i + 1:number) = self%force(k)/self%width_x(k)/self%width_y(k)/real(product(images), dp)
    end do
  end subroutine find_pressed

  !> The number of images of rectangle `k` along x and y, itself included.
  pure function images_of(self, k) result(images)
    use fuge_pressed_cells, only: is_own_image
    class(halfspace_loads), intent(in) :: self
    integer, intent(in) :: k
    integer :: images(2)

    images = merge(2, 1, self%symmetric .and. .not. is_own_image([self%x(k), self%y(k)], &
                                                                  [self%width_x(k), self%width_y(k)]))
  end function images_of

  !> Into how many pieces rectangle `k` is cut.
  pure function pieces_of(self, k) result(pieces)
    class(halfspace_loads), intent(in) :: self
    integer, intent(in) :: k
    integer :: pieces
    real(dp) :: width(2)

    width = [self%width_x(k), self%width_y(k)]
    pieces = ceiling(min(real(MOST_PIECES, dp), maxval(width)/LONGEST/minval(width)))
    ! Odd, because one of the middles is that of the whole.
    if (modulo(pieces, 2) == 0) pieces = pieces + 1
  end function pieces_of

  !> Add the pieces of a rectangle.
  pure subroutine cut(centre, width, pieces, number, pressed)
    use fuge_pressed_cells, only: pressed_cells
    real(dp), intent(in) :: centre(2), width(2)
    integer, intent(in) :: pieces
    integer, intent(inout) :: number
    type(pressed_cells), intent(inout) :: pressed
    integer :: along, i

    along = maxloc(width, dim=1)
    do i = 1, pieces
      number = number + 1
      pressed%centre(:, number) = centre
      pressed%width(:, number) = width
      pressed%width(along, number) = width(along)/real(pieces, dp)
      pressed%centre(along, number) = centre(along) + 0.5_dp*real(2*i - 1 - pieces, dp)*pressed%width(along, number)
    end do
  end subroutine cut

end module fuge_halfspace_loads
