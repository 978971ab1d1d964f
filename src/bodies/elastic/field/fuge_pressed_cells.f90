!> The cells of a surface that carry force, as the search for the largest stress needs them.
module fuge_pressed_cells
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: allocate_cells, is_own_image

  !> Cells on a line (`axes` 1) or on an area (`axes` 2); all carry force.
  type, public :: pressed_cells
    integer :: axes = 1
    !> Is the pressure continuous? Otherwise it jumps from cell to cell, and the stresses near the surface follow the
    !> cells rather than the contact.
    logical :: continuous = .false.
    !> Of cells that are symmetric about x = 0, or y = 0, the search takes those on one side.
    logical :: symmetric(2) = .false.
    !> (axes, cells), length.
    real(dp), allocatable :: centre(:, :), width(:, :)
    !> Mean, or peak of a hat, (cells), force per length squared; compressive positive.
    real(dp), allocatable :: pressure(:)
    !> The stress at the surface of a body under uniform pressure grows with this factor, 1 - 2 poisson.
    real(dp) :: surface_factor = 1.0_dp
    !> Places of the surface, (axes, places), that are tried beside the middle of the cell with the largest pressure.
    real(dp), allocatable :: surface(:, :)
  contains
    procedure :: size_of
    procedure :: least_depth
    procedure :: surface_counts
    procedure :: find_surface
  end type pressed_cells

  !> The least depth of the search below a cell of uniform pressure, in widths of the cell.
  real(dp), parameter :: RESOLVED_DEPTH = 0.25_dp
  !> The surface of a half-space may be stressed more than the body from this `surface_factor` on.
  real(dp), parameter :: SURFACE_COUNTS_FROM = 0.6_dp
  !> A place lies beside a cell if its distance from it exceeds this fraction of the lesser width of the cell.
  real(dp), parameter :: BESIDE = 0.499_dp

contains

  !> Room for a number of cells (FUGE_ERR_MEMORY).
  pure subroutine allocate_cells(axes, number, cells, info)
    integer, intent(in) :: axes, number
    type(pressed_cells), intent(inout) :: cells
    type(fuge_info), intent(inout) :: info
    integer :: stat

    if (info%failed()) return
    cells%axes = axes
    allocate (cells%centre(axes, number), cells%width(axes, number), cells%pressure(number), stat=stat)
    call require_memory(stat, 'the', number, 'cells with a force', info)
  end subroutine allocate_cells

  !> Is a cell of a symmetric model its own mirror image? The checks of such models refuse cells that overlap their
  !> images otherwise: none lies between the axis, but for rounding, and half of its width.
  elemental function is_own_image(place, width) result(own)
    real(dp), intent(in) :: place, width
    logical :: own

    own = abs(place) < 0.25_dp*width
  end function is_own_image

  !> A length for a cell: its width, or the side of a square of its area.
  pure function size_of(self, k) result(length)
    class(pressed_cells), intent(in) :: self
    integer, intent(in) :: k
    real(dp) :: length

    length = sqrt(self%width(1, k))*sqrt(self%width(self%axes, k))
  end function size_of

  !> Above this depth the stresses below cell k are those of its edges.
  pure function least_depth(self, k) result(depth)
    class(pressed_cells), intent(in) :: self
    integer, intent(in) :: k
    real(dp) :: depth

    depth = 0.0_dp
    if (.not. self%continuous) depth = RESOLVED_DEPTH*minval(self%width(:, k))
  end function least_depth

  !> May the surface of a half-space have the largest stress, beside the cells too?
  !>
  !> There sxx + syy = -(1 + 2 nu) p and szz = -p depend on the pressure p at the place, the rest of the tensor on that
  !> all around. All of the measures has the factor 1 - 2 nu, and beyond the cells they are the modulus of an analytic
  !> function, so that they are largest beside the cells (A. E. H. Love, The stress produced in a semi-infinite solid by
  !> pressure on part of the boundary, 1929).
  pure function surface_counts(self)
    class(pressed_cells), intent(in) :: self
    logical :: surface_counts

    surface_counts = self%surface_factor > SURFACE_COUNTS_FROM
  end function surface_counts

  !> Take the middles of all cells, and of equal ones beside them that no cell presses, as places of the surface.
  !> FUGE_ERR_MEMORY.
  pure subroutine find_surface(self, info)
    class(pressed_cells), intent(inout) :: self
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: list(:, :)
    real(dp) :: place(2)
    integer :: k, n, number, stat

    if (info%failed()) return
    allocate (list(self%axes, 3**self%axes*size(self%pressure)), stat=stat)
    call require_memory(stat, 'places at the surface of', size(self%pressure), 'cells', info)
    if (stat /= 0) return
    number = 0
    do k = 1, size(self%pressure)
      do n = 0, 3**self%axes - 1
        place = real([modulo(n, 3), n/3] - 1, dp)
        if (self%axes == 1) place(2) = 0.0_dp
        place(:self%axes) = self%centre(:, k) + self%width(:, k)*place(:self%axes)
        if (any(self%symmetric .and. place < 0.0_dp)) cycle
        ! The middle one of them is that of the cell itself.
        if (n /= (3**self%axes - 1)/2) then
          if (is_pressed(self, k, place(:self%axes))) cycle
        end if
        number = number + 1
        list(:, number) = place(:self%axes)
      end do
    end do
    self%surface = list(:, :number)
  end subroutine find_surface

  !> Does a place beside cell `k` lie in another one, or too close to it? Those that follow it in the list, or go
  !> before, are mostly its neighbours.
  pure function is_pressed(cells, k, place) result(pressed)
    class(pressed_cells), intent(in) :: cells
    integer, intent(in) :: k
    real(dp), intent(in) :: place(:)
    logical :: pressed
    integer :: i, j, side

    pressed = .true.
    do i = 1, size(cells%pressure) - 1
      do side = -1, 1, 2
        j = k + side*i
        if (j < 1 .or. j > size(cells%pressure)) cycle
        associate (width => cells%width(:, j))
          if (all(abs(place - cells%centre(:, j)) < 0.5_dp*width + BESIDE*minval(width))) return
        end associate
      end do
    end do
    pressed = .false.
  end function is_pressed

end module fuge_pressed_cells
