!> Meshes of bodies that are one element thick (C3D8 or C3D20), written as CalculiX input files.
!>
!> The nodes lie in lines: i along the contact surface, j from there into the body, k through the thickness. The
!> positions of all lines are the caller's, so that a slab can be bent to a ring.
module calculix_slab
  use fuge, only: dp => fuge_dp
  implicit none
  private

  public :: graded_lines, make_slab, refined

  type, public :: slab
    !> Prefix of the names of its sets.
    character(len=8) :: name = ''
    !> 1: linear elements, C3D8; 2: quadratic ones, C3D20.
    integer :: order = 1
    !> Does the body lie above its contact surface?
    logical :: above = .false.
    !> Number of the node on lines i, j, k; 0: there is none.
    integer, allocatable :: number(:, :, :)
    !> (3, nodes), of nodes `first_node` and on.
    real(dp), allocatable :: position(:, :)
    integer :: first_node = 1, first_element = 1
  contains
    procedure :: elements
    procedure :: write_to
  end type slab

  !> Corners of an element on its lines, and the corners at the ends of its edges, in CalculiX's order: the face away
  !> from the contact surface first, so that face S2 touches.
  integer, parameter :: CORNER(3, 8) = reshape([0, 1, 0, 1, 1, 0, 1, 1, 1, 0, 1, 1, 0, 0, 0, 1, 0, 0, 1, 0, 1, &
                                                0, 0, 1], [3, 8])
  integer, parameter :: EDGE(2, 12) = reshape([1, 2, 2, 3, 3, 4, 4, 1, 5, 6, 6, 7, 7, 8, 8, 5, 1, 5, 2, 6, 3, 7, &
                                               4, 8], [2, 12])
  !> The corners of an element above its contact surface, which would be inside out in the order of one below.
  integer, parameter :: TURNED(8) = [1, 4, 3, 2, 5, 8, 7, 6]

contains

  !> From 0 to `last` or beyond: `equal` lines at equal distances, then at distances that grow by `growth`.
  pure function graded_lines(last, spacing, growth, equal) result(lines)
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
  end function graded_lines

  !> The same lines with each space between them divided into `parts`.
  pure function refined(lines, parts) result(all)
    real(dp), intent(in) :: lines(:)
    integer, intent(in) :: parts
    real(dp) :: all(parts*(size(lines) - 1) + 1)
    real(dp) :: share
    integer :: k, n

    n = size(lines)
    do k = 0, parts - 1
      share = real(k, dp)/real(parts, dp)
      all(k + 1:size(all) - 1:parts) = (1.0_dp - share)*lines(:n - 1) + share*lines(2:)
    end do
    all(size(all)) = lines(n)
  end function refined

  !> `place` (2, lines i, lines j): x and z. Nodes and elements are numbered behind those of `before`.
  pure function make_slab(name, order, place, thickness, above, before) result(body)
    character(len=*), intent(in) :: name
    integer, intent(in) :: order
    real(dp), intent(in) :: place(:, :, :), thickness
    logical, intent(in) :: above
    type(slab), intent(in), optional :: before
    type(slab) :: body
    integer :: i, j, k, count

    body%name = name
    body%order = order
    body%above = above
    if (present(before)) then
      body%first_node = before%first_node + size(before%position, 2)
      body%first_element = before%first_element + before%elements()
    end if
    allocate (body%number(size(place, 2), size(place, 3), order + 1))
    body%number = 0
    allocate (body%position(3, size(body%number)))
    count = 0
    do i = 1, size(place, 2)
      do j = 1, size(place, 3)
        do k = 1, order + 1
          ! Quadratic elements have nodes on their edges, not in the middle of their faces.
          if (order == 2 .and. mod(i - 1, 2) + mod(j - 1, 2) + mod(k - 1, 2) > 1) cycle
          count = count + 1
          body%number(i, j, k) = body%first_node + count - 1
          body%position(:, count) = [place(1, i, j), thickness*real(k - 1, dp)/real(order, dp), place(2, i, j)]
        end do
      end do
    end do
    body%position = body%position(:, :count)
  end function make_slab

  pure function elements(self)
    class(slab), intent(in) :: self
    integer :: elements

    elements = (size(self%number, 1) - 1)/self%order*((size(self%number, 2) - 1)/self%order)
  end function elements

  !> Nodes and elements; the sets END (away from the contact), FIRST and LAST (lines i), FRONT (k); the surface of the
  !> first `faces` elements along i; lengths times `unit`.
  subroutine write_to(self, file, faces, unit)
    class(slab), intent(in) :: self
    integer, intent(in) :: file, faces
    real(dp), intent(in) :: unit
    integer :: i, k, down

    write (file, '(2a)') '*NODE, NSET=', trim(self%name)
    write (file, '(i0,", ",es20.13,", ",es20.13,", ",es20.13)') (self%first_node + k - 1, unit*self%position(:, k), &
                                                              k=1, size(self%position, 2))
    write (file, '(a,i0,2a)') '*ELEMENT, TYPE=C3D', merge(8, 20, self%order == 1), ', ELSET=', trim(self%name)
    call write_elements(self, file)
    call write_set(trim(self%name)//'END', pack(self%number(:, size(self%number, 2), :), .true.), file)
    call write_set(trim(self%name)//'FIRST', pack(self%number(1, :, :), .true.), file)
    call write_set(trim(self%name)//'LAST', pack(self%number(size(self%number, 1), :, :), .true.), file)
    call write_set(trim(self%name)//'FRONT', pack(self%number(:, :, 1), .true.), file)
    down = (size(self%number, 2) - 1)/self%order
    write (file, '(2a)') '*SURFACE, NAME=S', trim(self%name)
    write (file, '(i0,", S2")') (self%first_element + (i - 1)*down, i=1, faces)
  end subroutine write_to

  !> CalculiX takes up to 16 numbers from a line.
  subroutine write_elements(self, file)
    type(slab), intent(in) :: self
    integer, intent(in) :: file
    integer :: i, j, number

    number = self%first_element - 1
    do i = 1, size(self%number, 1) - 1, self%order
      do j = 1, size(self%number, 2) - 1, self%order
        number = number + 1
        write (file, '(i0,8(", ",i0),:,",",/,i0,11(", ",i0))') number, element_nodes(self, [i, j, 1])
      end do
    end do
  end subroutine write_elements

  !> The nodes of the element that begins at the given lines.
  pure function element_nodes(self, lines) result(node)
    type(slab), intent(in) :: self
    integer, intent(in) :: lines(3)
    integer, allocatable :: node(:)
    integer :: at(3, 20), k

    at(:, :8) = self%order*CORNER
    if (self%above) at(:, :8) = at(:, TURNED)
    do k = 1, size(EDGE, 2)
      at(:, 8 + k) = (at(:, EDGE(1, k)) + at(:, EDGE(2, k)))/2
    end do
    allocate (node(merge(8, 20, self%order == 1)))
    do k = 1, size(node)
      node(k) = self%number(lines(1) + at(1, k), lines(2) + at(2, k), lines(3) + at(3, k))
    end do
  end function element_nodes

  subroutine write_set(name, node, file)
    character(len=*), intent(in) :: name
    integer, intent(in) :: node(:), file

    write (file, '(a)') '*NSET, NSET='//name
    write (file, '(i0,",")') pack(node, node > 0)
  end subroutine write_set

end module calculix_slab
