!> Two blocks of finite elements, in a plane or in space, as a finite element program would have them.
module block_models
  use elastic_elements, only: mesh_stiffness, PLANE_STRESS, SOLID
  use fuge_elastic_body_type, only: fuge_elastic_body
  use fuge_kinds, only: dp
  use fuge_surface_mesh_type, only: fuge_surface_mesh
  implicit none
  private

  public :: make_block

  !> On top of the upper block.
  real(dp), parameter, public :: TOP_PRESSURE = 2.0_dp
  !> Force on a corner, and the clearance with it.
  real(dp), parameter, public :: CORNER_FORCE = 3.0_dp, CLEARANCE = 0.25_dp
  !> Elements of the blocks along each axis; their sides are as long as each other in a block.
  integer, parameter :: LOWER_ELEMENTS(3) = [3, 3, 1], UPPER_ELEMENTS(3) = [4, 4, 2]
  real(dp), parameter, public :: WIDTH = 6.0_dp

  type, public :: block
    integer :: dimensions = 0
    !> Number of each node, which have no order, and its position.
    integer, allocatable :: number(:), element(:, :)
    real(dp), allocatable :: position(:, :)
    !> Stiffness matrix.
    real(dp), allocatable :: k(:, :)
    !> Nodes at the sides; left and front are x and y least, a plane has no front.
    integer, allocatable :: bottom(:), top(:), left(:), front(:)
    !> Elements with a face at the bottom and at the top.
    integer, allocatable :: below(:), above(:)
    !> How many elements there are along each axis.
    integer :: divisions(3) = 0
    logical :: is_upper = .false.
  contains
    procedure :: body
    procedure :: surface
    procedure :: pressure_load
    procedure :: corner_load
    procedure :: face
  end type block

contains

  subroutine make_block(name, dimensions, made)
    character(len=*), intent(in) :: name
    integer, intent(in) :: dimensions
    type(block), intent(out) :: made
    real(dp) :: origin(3), place(3), side
    integer :: e, i, j, l, n(3), node

    made%dimensions = dimensions
    made%is_upper = name == 'upper'
    made%divisions = merge(UPPER_ELEMENTS, LOWER_ELEMENTS, made%is_upper)
    if (dimensions == 2) made%divisions = [made%divisions(1), made%divisions(3), 0]
    side = WIDTH/made%divisions(1)
    origin = 0.0_dp
    if (made%is_upper) origin(dimensions) = WIDTH/LOWER_ELEMENTS(1)*LOWER_ELEMENTS(3)
    n = made%divisions + 1
    allocate (made%position(dimensions, product(n)), made%number(product(n)))
    allocate (made%element(2**dimensions, product(max(made%divisions, 1))))
    node = 0
    e = 0
    do l = 0, n(3) - 1
      do j = 0, n(2) - 1
        do i = 0, n(1) - 1
          node = node + 1
          place = side*real([i, j, l], dp)
          made%position(:, node) = origin(:dimensions) + place(:dimensions)
          made%number(node) = merge(10 + modulo(37*node, 101), 1000 - 3*node, made%is_upper)
          if (i == 0 .or. j == 0 .or. (l == 0 .and. dimensions == 3)) cycle
          e = e + 1
          if (dimensions == 2) then
            made%element(:, e) = node + [-n(1) - 1, -n(1), 0, -1]
          else
            made%element(:4, e) = node - n(1)*n(2) + [-n(1) - 1, -n(1), 0, -1]
            made%element(5:, e) = node + [-n(1) - 1, -n(1), 0, -1]
          end if
        end do
      end do
    end do
    call find_sides(origin(dimensions), side, made)
    call set_stiffness(made)
  end subroutine make_block

  pure subroutine find_sides(low, side, made)
    real(dp), intent(in) :: low, side
    type(block), intent(inout) :: made
    real(dp) :: high
    integer :: k

    high = low + side*made%divisions(made%dimensions)
    associate (x => made%position, d => made%dimensions)
      made%bottom = pack([(k, k=1, size(x, 2))], abs(x(d, :) - low) < 0.1_dp*side)
      made%top = pack([(k, k=1, size(x, 2))], abs(x(d, :) - high) < 0.1_dp*side)
      made%left = pack([(k, k=1, size(x, 2))], abs(x(1, :)) < 0.1_dp*side)
      allocate (made%front(0))
      if (d == 3) made%front = pack([(k, k=1, size(x, 2))], abs(x(2, :)) < 0.1_dp*side)
      made%below = pack([(k, k=1, size(made%element, 2))], abs(x(d, made%element(1, :)) - low) < 0.1_dp*side)
      made%above = pack([(k, k=1, size(made%element, 2))], &
                        abs(x(d, made%element(2**d, :)) - high) < 0.1_dp*side)
    end associate
  end subroutine find_sides

  !> In the plane E = 24 and Poisson's ratio 0, for which all entries are whole numbers and no format loses digits.
  subroutine set_stiffness(made)
    type(block), intent(inout) :: made
    integer, allocatable :: column(:), row(:)
    real(dp), allocatable :: value(:)
    integer :: j, p

    if (made%dimensions == 2) then
      call mesh_stiffness(made%position, made%element, PLANE_STRESS, 24.0_dp, 0.0_dp, column, row, value)
    else
      call mesh_stiffness(made%position, made%element, SOLID, merge(50.0_dp, 20.0_dp, made%is_upper), 0.3_dp, column, &
                          row, value)
    end if
    allocate (made%k(size(made%position), size(made%position)), source=0.0_dp)
    do j = 1, size(made%k, 2)
      do p = column(j), column(j + 1) - 1
        made%k(row(p), j) = made%k(row(p), j) + value(p)
      end do
    end do
    if (made%dimensions == 2) made%k = anint(made%k)
    made%k = 0.5_dp*(made%k + transpose(made%k))
  end subroutine set_stiffness

  !> For the library: `held` along the last axis up to `upright`, then, as many as at the left, along x, then along y.
  subroutine body(self, held, upright, elastic)
    class(block), intent(in) :: self
    integer, intent(in) :: held(:), upright
    type(fuge_elastic_body), intent(inout) :: elastic
    integer :: axis, i, n, part

    n = size(self%k, 1)
    elastic%column = [(1 + n*(i - 1), i=1, n + 1)]
    elastic%row = [((i, i=1, n), part=1, n)]
    elastic%value = reshape(self%k, [n*n])
    allocate (elastic%fixed(size(held)))
    do i = 1, size(held)
      axis = 1
      if (i <= upright) axis = self%dimensions
      if (i > upright + size(self%left)) axis = 2
      elastic%fixed(i) = self%dimensions*(held(i) - 1) + axis
    end do
  end subroutine body

  subroutine surface(self, elements, mesh)
    class(block), intent(in) :: self
    integer, intent(in) :: elements(:)
    type(fuge_surface_mesh), intent(inout) :: mesh
    integer :: k

    allocate (mesh%node, source=self%position)
    allocate (mesh%dof, source=reshape([(k, k=1, size(self%position))], shape(self%position)))
    allocate (mesh%face(2**(self%dimensions - 1), size(elements)))
    do k = 1, size(elements)
      mesh%face(:, k) = self%element(self%face(elements(k)), elements(k))
    end do
  end subroutine surface

  !> Which nodes of an element are its face at the bottom or at the top, as Abaqus orders them seen from outside.
  pure function face(self, element) result(nodes)
    class(block), intent(in) :: self
    integer, intent(in) :: element
    integer :: nodes(2**(self%dimensions - 1))
    logical :: is_above

    is_above = any(self%above == element) .and. .not. self%is_upper
    if (self%dimensions == 2) then
      nodes = merge([3, 4], [1, 2], is_above)
    else
      nodes = merge([5, 6, 7, 8], [4, 3, 2, 1], is_above)
    end if
  end function face

  !> Consistent forces of the pressure on top.
  pure function pressure_load(self) result(load)
    class(block), intent(in) :: self
    real(dp) :: load(size(self%position))
    integer :: i, k
    real(dp) :: share

    load = 0.0_dp
    do k = 1, size(self%top)
      share = TOP_PRESSURE*(WIDTH/self%divisions(1))**(self%dimensions - 1)
      do i = 1, self%dimensions - 1
        associate (x => self%position(i, self%top(k)))
          if (x < 0.1_dp .or. x > WIDTH - 0.1_dp) share = 0.5_dp*share
        end associate
      end do
      load(self%dimensions*self%top(k)) = -share
    end do
  end function pressure_load

  !> A force on the last node.
  pure function corner_load(self) result(load)
    class(block), intent(in) :: self
    real(dp) :: load(size(self%position))

    load = 0.0_dp
    load(size(load)) = -CORNER_FORCE
  end function corner_load

end module block_models
