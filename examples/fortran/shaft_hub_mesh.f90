!> Meshes of the example `shaft_hub`: rings in the plane, and sections of tubes.
module shaft_hub_mesh
  use fuge, only: dp => fuge_dp, fuge_surface_mesh
  implicit none
  private

  public :: make_ring, make_section

  real(dp), parameter :: PI = acos(-1.0_dp)

  !> A grid of elements of order 1 or 2, quadrangles or triangles.
  type, public :: mesh_kind
    integer :: order = 1
    logical :: triangles = .false.
    !> How unequal the elements around are: sizes from 1 - grading to 1 + grading of the mean.
    real(dp) :: grading = 0.0_dp
  end type mesh_kind

  !> A body: `node` (2, nodes), `element` (nodes of an element, elements), and its surfaces.
  type, public :: plane_body
    real(dp), allocatable :: node(:, :)
    integer, allocatable :: element(:, :)
    type(fuge_surface_mesh) :: inside, outside
  end type plane_body

contains

  !> A ring between two radii, or a quarter of it, `across` elements wide and with `around` elements, which begin at an
  !> angle of `start`.
  subroutine make_ring(radius, across, around, kind, quarter, start, body)
    real(dp), intent(in) :: radius(2), start
    integer, intent(in) :: across, around
    type(mesh_kind), intent(in) :: kind
    logical, intent(in) :: quarter
    type(plane_body), intent(out) :: body
    integer, allocatable :: place(:, :)
    real(dp) :: angle, r
    integer :: i, j

    call make_grid(across, around, kind, .not. quarter, place, body)
    do j = 0, ubound(place, 2)
      angle = start + merge(0.5_dp, 2.0_dp, quarter)*PI*along(j, around, kind)
      do i = 0, ubound(place, 1)
        r = radius(1) + (radius(2) - radius(1))*real(i, dp)/real(ubound(place, 1), dp)
        if (place(i, j) > 0) body%node(:, place(i, j)) = r*[cos(angle), sin(angle)]
      end do
    end do
    call copy_nodes(body)
  end subroutine make_ring

  !> The section of a tube between two radii, from z = 0 to `length`, with `around` elements along it.
  subroutine make_section(radius, length, across, around, kind, body)
    real(dp), intent(in) :: radius(2), length
    integer, intent(in) :: across, around
    type(mesh_kind), intent(in) :: kind
    type(plane_body), intent(out) :: body
    integer, allocatable :: place(:, :)
    integer :: i, j

    call make_grid(across, around, kind, .false., place, body)
    do j = 0, ubound(place, 2)
      do i = 0, ubound(place, 1)
        if (place(i, j) > 0) body%node(:, place(i, j)) = [radius(1) + (radius(2) - radius(1))*real(i, dp) &
          /real(ubound(place, 1), dp), length*along(j, around, kind)]
      end do
    end do
    call copy_nodes(body)
  end subroutine make_section

  !> The place, from 0 to 1, of line `j` of nodes. Lines of middle nodes are in the middle.
  pure function along(j, around, kind) result(place)
    integer, intent(in) :: j, around
    type(mesh_kind), intent(in) :: kind
    real(dp) :: place
    integer :: before

    before = j/kind%order
    place = graded(real(before, dp)/real(around, dp), kind%grading)
    if (modulo(j, kind%order) > 0) place = 0.5_dp*(place + graded(real(before + 1, dp)/real(around, dp), kind%grading))
  end function along

  pure function graded(s, grading)
    real(dp), intent(in) :: s, grading
    real(dp) :: graded

    graded = s + grading*sin(2.0_dp*PI*s)/(2.0_dp*PI)
  end function graded

  !> Number the nodes, and list elements and faces; `place(i, j)` is the node in line j, 0 for none.
  subroutine make_grid(across, around, kind, closed, place, body)
    integer, intent(in) :: across, around
    type(mesh_kind), intent(in) :: kind
    logical, intent(in) :: closed
    integer, allocatable, intent(out) :: place(:, :)
    type(plane_body), intent(inout) :: body
    integer :: i, j, line(3), nodes

    associate (order => kind%order)
      allocate (place(0:order*across, 0:order*around), source=0)
      nodes = 0
      do j = 0, order*around - merge(1, 0, closed)
        do i = 0, order*across
          ! Quadrangles of 8 nodes have none in the middle.
          if (order == 2 .and. .not. kind%triangles .and. modulo(i, 2) + modulo(j, 2) == 2) cycle
          nodes = nodes + 1
          place(i, j) = nodes
        end do
      end do
      if (closed) place(:, order*around) = place(:, 0)
      allocate (body%node(2, nodes), body%inside%face(order + 1, around), body%outside%face(order + 1, around), &
                body%element(merge(3, 4, kind%triangles)*order, merge(2, 1, kind%triangles)*across*around))
      do j = 0, around - 1
        ! The body is to the left of the way along an edge; the middle node comes last.
        line = [order*j, order*(j + 1), order*j + 1]
        body%outside%face(:, j + 1) = place(order*across, line(:order + 1))
        line = [order*(j + 1), order*j, order*j + 1]
        body%inside%face(:, j + 1) = place(0, line(:order + 1))
        do i = 0, across - 1
          call add_cell(place(order*i:order*(i + 1), order*j:order*(j + 1)), kind, i + across*j, body%element)
        end do
      end do
    end associate
  end subroutine make_grid

  !> One or two elements for a cell of the grid, that after `before` others.
  pure subroutine add_cell(place, kind, before, element)
    integer, intent(in) :: place(0:, 0:), before
    type(mesh_kind), intent(in) :: kind
    integer, intent(inout) :: element(:, :)
    integer :: corner(4), side(4), middle, last

    last = ubound(place, 1)
    corner = [place(0, 0), place(last, 0), place(last, last), place(0, last)]
    side = [place(last/2, 0), place(last, last/2), place(last/2, last), place(0, last/2)]
    middle = place(last/2, last/2)
    if (kind%triangles .and. kind%order == 1) then
      element(:, 2*before + 1) = corner([1, 2, 3])
      element(:, 2*before + 2) = corner([1, 3, 4])
    else if (kind%triangles) then
      element(:, 2*before + 1) = [corner([1, 2, 3]), side(1:2), middle]
      element(:, 2*before + 2) = [corner([1, 3, 4]), middle, side(3:4)]
    else if (kind%order == 1) then
      element(:, before + 1) = corner
    else
      element(:, before + 1) = [corner, side]
    end if
  end subroutine add_cell

  !> The surfaces have all nodes of the body. Degree of freedom of node i along axis d: 2 (i - 1) + d.
  pure subroutine copy_nodes(body)
    type(plane_body), intent(inout) :: body
    integer :: k

    body%inside%node = body%node
    body%outside%node = body%node
    allocate (body%inside%dof(2, size(body%node, 2)))
    body%inside%dof = reshape([(k, k=1, size(body%node))], shape(body%node))
    body%outside%dof = body%inside%dof
  end subroutine copy_nodes

end module shaft_hub_mesh
