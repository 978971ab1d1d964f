!> The mesh of the example, written as a CalculiX input file: half of a block whose top is a
!> segment of a cylinder, one element (C3D8) thick.
!>
!> The top is z = -x**2/(2 R). Elements are square under the contact and grow from there
!> outwards and downwards. Nodes are numbered through the thickness, then downwards, then
!> along x, so that the band of the stiffness is narrow.
module calculix_mesh
  use fuge, only: dp => fuge_dp
  implicit none
  private

  public :: make_block, node_areas, write_mesh

  type, public :: block_mesh
    !> Lines of nodes, x from the axis outwards, depth from the top down; mm.
    real(dp), allocatable :: x(:), depth(:)
    !> Lines of nodes that may touch, from the axis outwards.
    integer :: lines = 0
  contains
    procedure :: node
    procedure :: nodes
    procedure :: contact_nodes
    procedure :: place
    procedure :: top
    procedure :: areas
  end type block_mesh

  !> Radius of the top, thickness of the slab, and how far from the axis nodes may touch; mm.
  real(dp), parameter, public :: RADIUS = 250.0_dp, THICKNESS = 0.1_dp
  real(dp), parameter :: REACH = 0.55_dp

contains

  !> A block of at least `side` in width (of its half) and height, mm, with elements of
  !> `spacing` under the contact, which grow by the factor `growth` from one to the next.
  pure function make_block(side, spacing, growth) result(mesh)
    real(dp), intent(in) :: side, spacing, growth
    type(block_mesh) :: mesh

    mesh%lines = nint(REACH/spacing) + 1
    allocate (mesh%x, source=graded(side, spacing, growth, mesh%lines))
    allocate (mesh%depth, source=graded(side, spacing, growth, 2))
  end function make_block

  !> From 0 to `last` or beyond: `equal` lines at equal distances, then at growing ones.
  pure function graded(last, spacing, growth, equal) result(lines)
    real(dp), intent(in) :: last, spacing, growth
    integer, intent(in) :: equal
    real(dp), allocatable :: lines(:)
    real(dp) :: step
    integer :: k

    lines = [(spacing*real(k, dp), k=0, equal - 1)]
    step = spacing
    do while (lines(size(lines)) < last)
      step = growth*step
      lines = [lines, lines(size(lines)) + step]
    end do
  end function graded

  !> Number of the node on line i along x, j downwards, in front (side 1) or behind (2).
  elemental function node(self, i, j, side)
    class(block_mesh), intent(in) :: self
    integer, intent(in) :: i, j, side
    integer :: node

    node = 2*((i - 1)*size(self%depth) + j - 1) + side
  end function node

  pure function nodes(self)
    class(block_mesh), intent(in) :: self
    integer :: nodes

    nodes = 2*size(self%x)*size(self%depth)
  end function nodes

  !> The nodes of the top that may touch, in pairs of front and back.
  pure function contact_nodes(self) result(list)
    class(block_mesh), intent(in) :: self
    integer, allocatable :: list(:)
    integer :: i, side

    list = [((self%node(i, 1, side), side=1, 2), i=1, self%lines)]
  end function contact_nodes

  !> x and z of the contact nodes.
  pure function place(self)
    class(block_mesh), intent(in) :: self
    real(dp) :: place(2, 2*self%lines)
    integer :: k

    place(1, :) = self%x([((k + 1)/2, k=1, 2*self%lines)])
    place(2, :) = -place(1, :)**2/(2.0_dp*RADIUS)
  end function place

  !> Height of the contact nodes; minus the gap to a plate at z = 0.
  pure function top(self) result(z)
    class(block_mesh), intent(in) :: self
    real(dp) :: z(2*self%lines)
    real(dp) :: xz(2, 2*self%lines)

    xz = self%place()
    z = xz(2, :)
  end function top

  !> Areas of the contact nodes: a quarter of each face around.
  pure function areas(self) result(area)
    class(block_mesh), intent(in) :: self
    real(dp) :: area(2*self%lines)

    area = node_areas(self%place())
  end function areas

  !> Nodes, elements, the sets BOTTOM, AXIS and CONTACT, and the surface TOP.
  subroutine write_mesh(mesh, path)
    type(block_mesh), intent(in) :: mesh
    character(len=*), intent(in) :: path
    integer :: file, i, j, side

    open (newunit=file, file=path, status='replace', action='write')
    write (file, '(a)') '*NODE, NSET=BLOCK'
    call write_nodes(mesh, file)
    write (file, '(a)') '*ELEMENT, TYPE=C3D8, ELSET=BLOCK'
    call write_elements(mesh, file)
    associate (last => size(mesh%depth))
      call write_set('BOTTOM', [((mesh%node(i, last, side), side=1, 2), i=1, size(mesh%x))], file)
      call write_set('AXIS', [((mesh%node(1, j, side), side=1, 2), j=1, last)], file)
      call write_set('CONTACT', mesh%contact_nodes(), file)
      write (file, '(a)') '*SURFACE, NAME=TOP'
      write (file, '(i0,", S2")') (1 + (i - 1)*(last - 1), i=1, mesh%lines - 1)
    end associate
    close (file)
  end subroutine write_mesh

  !> The crown fades towards the bottom, which is flat. CalculiX reads twenty characters of a number.
  subroutine write_nodes(mesh, file)
    type(block_mesh), intent(in) :: mesh
    integer, intent(in) :: file
    real(dp) :: crown, height
    integer :: i, j, side

    height = mesh%depth(size(mesh%depth))
    do i = 1, size(mesh%x)
      do j = 1, size(mesh%depth)
        crown = mesh%x(i)**2/(2.0_dp*RADIUS)*(1.0_dp - mesh%depth(j)/height)
        write (file, '(i0,", ",es20.13,", ",es20.13,", ",es20.13)') (mesh%node(i, j, side), mesh%x(i), &
                                              real(side - 1, dp)*THICKNESS, -mesh%depth(j) - crown, side=1, 2)
      end do
    end do
  end subroutine write_nodes

  !> Lower face first, so that face S2 is the upper one.
  subroutine write_elements(mesh, file)
    type(block_mesh), intent(in) :: mesh
    integer, intent(in) :: file
    integer :: i, j, k, number

    number = 0
    do i = 1, size(mesh%x) - 1
      do j = 1, size(mesh%depth) - 1
        number = number + 1
        write (file, '(i0,8(", ",i0))') number, &
          (mesh%node([i, i + 1, i + 1, i], j + k, [1, 1, 2, 2]), k=1, 0, -1)
      end do
    end do
  end subroutine write_elements

  subroutine write_set(name, list, file)
    character(len=*), intent(in) :: name
    integer, intent(in) :: list(:), file

    write (file, '(a)') '*NSET, NSET='//name
    write (file, '(i0,",")') list
  end subroutine write_set

  !> A quarter of each face around, of nodes at x and z in pairs of front and back.
  pure function node_areas(place) result(area)
    real(dp), intent(in) :: place(:, :)
    real(dp) :: area(size(place, 2))
    real(dp) :: quarter
    integer :: k

    area = 0.0_dp
    do k = 1, size(area) - 2
      quarter = 0.25_dp*THICKNESS*norm2(place(:, k + 2) - place(:, k))
      area([k, k + 2]) = area([k, k + 2]) + quarter
    end do
  end function node_areas

end module calculix_mesh
