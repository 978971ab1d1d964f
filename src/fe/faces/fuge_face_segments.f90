!> The common part of two faces of opposite surfaces, seen along the normal of one of them.
!>
!> In the plane it is an interval, in space a convex polygon, found by clipping (I. Sutherland, G. Hodgman: Reentrant
!> polygon clipping, Communications of the ACM 17, 1974; for mortar methods M. Puso, T. Laursen, Computer Methods in
!> Applied Mechanics and Engineering 193, 2004). Faces whose sides are curved are cut into triangles first.
module fuge_face_segments
  use fuge_face_geometry, only: face_nodes, is_straight
  use fuge_face_shapes, only: corner_count, EDGE_3, TRIANGLE_6
  use fuge_kinds, only: dp
  implicit none
  private

  public :: clip_convex, face_pieces, polygon_area

  !> Most corners of the common part of two quadrangles.
  integer, parameter :: MOST_CORNERS = 8
  !> Most pieces of a face.
  integer, parameter, public :: MOST_PIECES = 6

  !> A convex polygon, corners counter-clockwise; an interval has two, of which the first coordinate counts.
  type, public :: convex_polygon
    integer :: count = 0
    real(dp) :: corner(2, MOST_CORNERS) = 0.0_dp
  end type convex_polygon

  !> Pieces of a triangle and of a quadrangle with middle nodes.
  integer, parameter :: TRIANGLE_PIECES(3, 4) = reshape([1, 4, 6, 2, 5, 4, 3, 6, 5, 4, 5, 6], [3, 4])
  integer, parameter :: QUADRANGLE_PIECES(3, 6) = reshape([1, 5, 8, 2, 6, 5, 3, 7, 6, 4, 8, 7, 5, 6, 7, 5, 7, 8], &
      [3, 6])

contains

  !> Convex pieces of a face, projected on a plane by the two vectors of `frame`; `pieces(:count)`.
  pure subroutine face_pieces(face, frame, pieces, count)
    type(face_nodes), intent(in) :: face
    real(dp), intent(in) :: frame(3, 2)
    type(convex_polygon), intent(out) :: pieces(MOST_PIECES)
    integer, intent(out) :: count
    integer :: k

    count = 1
    if (face%kind <= EDGE_3) then
      pieces(1) = interval(dot_product(frame(:, 1), face%x(:, 1)), dot_product(frame(:, 1), face%x(:, 2)))
    else if (is_straight(face)) then
      pieces(1) = polygon(face, frame, [(k, k=1, corner_count(face%kind))])
    else if (face%kind == TRIANGLE_6) then
      count = size(TRIANGLE_PIECES, 2)
      do k = 1, count
        pieces(k) = polygon(face, frame, TRIANGLE_PIECES(:, k))
      end do
    else
      count = size(QUADRANGLE_PIECES, 2)
      do k = 1, count
        pieces(k) = polygon(face, frame, QUADRANGLE_PIECES(:, k))
      end do
    end if
  end subroutine face_pieces

  pure function interval(a, b) result(piece)
    real(dp), intent(in) :: a, b
    type(convex_polygon) :: piece

    piece%count = 2
    piece%corner(1, :2) = [min(a, b), max(a, b)]
  end function interval

  !> The polygon of some nodes of a face, turned so that it runs counter-clockwise.
  pure function polygon(face, frame, nodes) result(piece)
    type(face_nodes), intent(in) :: face
    real(dp), intent(in) :: frame(3, 2)
    integer, intent(in) :: nodes(:)
    type(convex_polygon) :: piece
    integer :: k

    piece%count = size(nodes)
    do k = 1, piece%count
      piece%corner(:, k) = matmul(face%x(:, nodes(k)), frame)
    end do
    if (polygon_area(piece) < 0.0_dp) piece%corner(:, :piece%count) = piece%corner(:, piece%count:1:-1)
  end function polygon

  !> Area of a polygon, length of an interval; negative if the corners run clockwise.
  pure function polygon_area(piece) result(area)
    type(convex_polygon), intent(in) :: piece
    real(dp) :: area
    integer :: k

    area = 0.0_dp
    if (piece%count == 2) then
      area = piece%corner(1, 2) - piece%corner(1, 1)
      return
    end if
    do k = 2, piece%count - 1
      area = area + 0.5_dp*turn(piece%corner(:, 1), piece%corner(:, k), piece%corner(:, k + 1))
    end do
  end function polygon_area

  !> Twice the area of a triangle.
  pure function turn(a, b, c) result(area)
    real(dp), intent(in) :: a(2), b(2), c(2)
    real(dp) :: area

    area = (b(1) - a(1))*(c(2) - a(2)) - (b(2) - a(2))*(c(1) - a(1))
  end function turn

  !> The common part of two convex pieces; without corners if there is none.
  pure function clip_convex(piece, window) result(part)
    type(convex_polygon), intent(in) :: piece, window
    type(convex_polygon) :: part
    integer :: k

    part = piece
    if (piece%count == 2) then
      part%corner(1, :2) = [max(piece%corner(1, 1), window%corner(1, 1)), min(piece%corner(1, 2), window%corner(1, 2))]
      if (.not. part%corner(1, 1) < part%corner(1, 2)) part%count = 0
      return
    end if
    do k = 1, window%count
      if (part%count < 3) exit
      part = cut(part, window%corner(:, k), window%corner(:, modulo(k, window%count) + 1))
    end do
    if (part%count < 3) part%count = 0
  end function clip_convex

  !> What lies to the left of the line from `a` to `b`.
  pure function cut(piece, a, b) result(part)
    type(convex_polygon), intent(in) :: piece
    real(dp), intent(in) :: a(2), b(2)
    type(convex_polygon) :: part
    real(dp) :: here, there
    integer :: k, next

    do k = 1, piece%count
      next = modulo(k, piece%count) + 1
      here = turn(a, b, piece%corner(:, k))
      there = turn(a, b, piece%corner(:, next))
      if (here >= 0.0_dp) call add_corner(part, piece%corner(:, k))
      if ((here > 0.0_dp .and. there < 0.0_dp) .or. (here < 0.0_dp .and. there > 0.0_dp)) &
        call add_corner(part, piece%corner(:, k) + here/(here - there)*(piece%corner(:, next) - piece%corner(:, k)))
    end do
  end function cut

  !> Add a corner to a convex polygon, which has room for all. Rounding could give one more, which adds no area and is
  !> left out.
  pure subroutine add_corner(piece, corner)
    type(convex_polygon), intent(inout) :: piece
    real(dp), intent(in) :: corner(2)

    if (piece%count >= MOST_CORNERS) return
    piece%count = piece%count + 1
    piece%corner(:, piece%count) = corner
  end subroutine add_corner

end module fuge_face_segments
