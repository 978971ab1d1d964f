!> A tree of bounding boxes of faces: which faces does a thick line meet?
!>
!> Built by halving the faces at the median of their middles along the longest side of their box, O(n log n), two
!> boxes to a node and at most LEAF faces to a leaf. A query takes O(log n) and the faces that it finds.
module fuge_face_tree
  use fuge_growing_arrays, only: make_room
  use fuge_kinds, only: dp
  implicit none
  private

  public :: build_tree

  integer, parameter :: LEAF = 4
  !> More levels than 2**31 faces need.
  integer, parameter :: DEEPEST = 64

  type, public :: face_tree
    !> Faces in the order of the leaves, (n).
    integer, allocatable, private :: order(:)
    !> Boxes of the faces, lower and upper corner, (6, n).
    real(dp), allocatable, private :: box(:, :)
    !> Boxes of the nodes of the tree, (6, nodes).
    real(dp), allocatable, private :: bound(:, :)
    !> First and last place in `order`, and first child of each node (the other one follows); no child: 0.
    integer, allocatable, private :: first(:), last(:), child(:)
  contains
    procedure :: find
  end type face_tree

contains

  !> Build the tree of faces with these boxes, (6, n): lower corner, upper corner. `stat` is not zero without memory.
  pure subroutine build_tree(box, tree, stat)
    real(dp), intent(in) :: box(:, :)
    type(face_tree), intent(out) :: tree
    integer, intent(out) :: stat
    real(dp), allocatable :: middle(:, :)
    integer :: half, k, n, node, nodes

    n = size(box, 2)
    ! Halves of more than LEAF faces have more than LEAF/2, so that there are at most 2n/(LEAF/2) nodes.
    nodes = max(1, n)
    allocate (tree%order(n), tree%box(6, n), tree%bound(6, nodes), tree%first(nodes), tree%last(nodes), &
              tree%child(nodes), middle(3, n), stat=stat)
    if (stat /= 0) return
    tree%box = box
    do k = 1, n
      tree%order(k) = k
      middle(:, k) = 0.5_dp*box(:3, k) + 0.5_dp*box(4:, k)
    end do
    tree%first(1) = 1
    tree%last(1) = n
    nodes = 1
    node = 1
    do while (node <= nodes)
      associate (first => tree%first(node), last => tree%last(node))
        tree%bound(:, node) = box_around(tree%box, tree%order(first:last))
        tree%child(node) = 0
        if (last - first + 1 > LEAF) then
          half = (first + last)/2
          call part_at_median(middle(longest_side(tree%bound(:, node)), :), half - first + 1, tree%order(first:last))
          tree%child(node) = nodes + 1
          tree%first(nodes + 1) = first
          tree%last(nodes + 1) = half
          tree%first(nodes + 2) = half + 1
          tree%last(nodes + 2) = last
          nodes = nodes + 2
        end if
      end associate
      node = node + 1
    end do
  end subroutine build_tree

  !> The faces whose boxes come nearer than `radius` to the line from `start` to `start` + `path`, along each axis.
  !>
  !> `found(:count)` in no particular order; it grows if needed. `stat` is not zero without memory.
  pure subroutine find(self, start, path, radius, found, count, stat)
    class(face_tree), intent(in) :: self
    real(dp), intent(in) :: start(3), path(3), radius
    integer, allocatable, intent(inout) :: found(:)
    integer, intent(out) :: count, stat
    integer :: depth, k, node, waiting(DEEPEST)

    count = 0
    stat = 0
    if (size(self%order) < 1) return
    waiting(1) = 1
    depth = 1
    do while (depth > 0)
      node = waiting(depth)
      depth = depth - 1
      if (.not. meets(self%bound(:, node), start, path, radius)) cycle
      if (self%child(node) > 0) then
        waiting(depth + 1) = self%child(node) + 1
        waiting(depth + 2) = self%child(node)
        depth = depth + 2
        cycle
      end if
      do k = self%first(node), self%last(node)
        if (.not. meets(self%box(:, self%order(k)), start, path, radius)) cycle
        call make_room(found, count, stat)
        if (stat /= 0) return
        count = count + 1
        found(count) = self%order(k)
      end do
    end do
  end subroutine find

  !> Does a line meet a box that is `radius` larger on each side? (The part of the line between each pair of planes.)
  pure function meets(box, start, path, radius) result(hit)
    real(dp), intent(in) :: box(6), start(3), path(3), radius
    logical :: hit
    real(dp) :: from, to, enter, leave
    integer :: axis

    from = 0.0_dp
    to = 1.0_dp
    hit = .false.
    do axis = 1, 3
      enter = box(axis) - radius - start(axis)
      leave = box(axis + 3) + radius - start(axis)
      ! A path this short does not leave the slab, and a quotient might overflow.
      if (abs(path(axis)) <= 1.0e-14_dp*max(abs(enter), abs(leave))) then
        if (enter > 0.0_dp .or. leave < 0.0_dp) return
      else if (path(axis) > 0.0_dp) then
        from = max(from, enter/path(axis))
        to = min(to, leave/path(axis))
      else
        from = max(from, leave/path(axis))
        to = min(to, enter/path(axis))
      end if
      if (from > to) return
    end do
    hit = .true.
  end function meets

  pure function box_around(box, faces) result(bound)
    real(dp), intent(in) :: box(:, :)
    integer, intent(in) :: faces(:)
    real(dp) :: bound(6)
    integer :: k

    bound(:3) = huge(1.0_dp)
    bound(4:) = -huge(1.0_dp)
    do k = 1, size(faces)
      bound(:3) = min(bound(:3), box(:3, faces(k)))
      bound(4:) = max(bound(4:), box(4:, faces(k)))
    end do
  end function box_around

  pure function longest_side(box) result(axis)
    real(dp), intent(in) :: box(6)
    integer :: axis

    axis = maxloc(box(4:) - box(:3), 1)
  end function longest_side

  !> Order indices so that the first `count` of them have the smallest keys (C. A. R. Hoare: Algorithm 65, find,
  !> Communications of the ACM 4, 1961, with the middle element as pivot).
  pure subroutine part_at_median(keys, count, order)
    real(dp), intent(in) :: keys(:)
    integer, intent(in) :: count
    integer, intent(inout) :: order(:)
    real(dp) :: pivot
    integer :: i, j, left, moved, right

    left = 1
    right = size(order)
    do while (left < right)
      pivot = keys(order((left + right)/2))
      i = left
      j = right
      do
        do while (keys(order(i)) < pivot)
          i = i + 1
        end do
        do while (keys(order(j)) > pivot)
          j = j - 1
        end do
        if (i <= j) then
          moved = order(i)
          order(i) = order(j)
          order(j) = moved
          i = i + 1
          j = j - 1
        end if
        if (i > j) exit
      end do
      if (count <= j) then
        right = j
      else if (count >= i) then
        left = i
      else
        return
      end if
    end do
  end subroutine part_at_median

end module fuge_face_tree
