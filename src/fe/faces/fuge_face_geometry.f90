!> One face in space: positions and normals on it, and the place in it that lies across from a point.
!>
!> A face in the plane has a third coordinate that is zero.
module fuge_face_geometry
  use fuge_face_shapes, only: corner_count, middle_place, node_place, shape_slopes, shape_values, side_ends, &
    EDGE_2, EDGE_3, MOST_NODES, QUADRANGLE_4, QUADRANGLE_8, TRIANGLE_3
  use fuge_kinds, only: dp
  implicit none
  private

  public :: across, bend, circumference, cross, face_normal, face_position, find_across, frame_across, is_affine, &
      is_straight, solve_step, unit

  !> The nodes of a face.
  type, public :: face_nodes
    integer :: kind = 0
    integer :: count = 0
    !> Positions of the nodes, (3, count).
    real(dp) :: x(3, MOST_NODES) = 0.0_dp
    !> Unit normals of the curved surface that the face stands for, at its nodes, where known, (3, count); else 0.
    real(dp) :: normal(3, MOST_NODES) = 0.0_dp
    !> How far the normals at the ends of each side lean along it to the same end, times its length; zero on an arc of a
    !> circle. Of an edge of three nodes the sum of both halves.
    real(dp) :: lean(4) = 0.0_dp
    !> Does that surface differ from the face itself?
    logical :: bent = .false.
    !> Is it the section of a ring, with the radius along the first axis?
    logical :: revolution = .false.
  end type face_nodes

  !> Steps of Newton's iteration; on a face that is not folded five are enough.
  integer, parameter :: MOST_STEPS = 25
  !> Relative deviation of a middle node, or of a fourth corner, that is taken for rounding.
  real(dp), parameter :: ROUNDING = 1.0e-10_dp
  !> Sides that lean by less than this from the plane across a normal are flat.
  real(dp), parameter :: FLAT = 1.0e-12_dp

contains

  !> The circumference of the ring through a position on the face, by which a length becomes an area; 1 if it is no
  !> ring. Not negative where rounding, or a curved side, crosses the axis.
  pure function circumference(face, position) result(around)
    type(face_nodes), intent(in) :: face
    real(dp), intent(in) :: position(3)
    real(dp) :: around
    real(dp), parameter :: PI = acos(-1.0_dp)

    around = 1.0_dp
    if (face%revolution) around = 2.0_dp*PI*max(position(1), 0.0_dp)
  end function circumference

  !> The position of a place.
  pure function face_position(face, place) result(x)
    type(face_nodes), intent(in) :: face
    real(dp), intent(in) :: place(2)
    real(dp) :: x(3), values(MOST_NODES)

    values = shape_values(face%kind, place)
    x = matmul(face%x(:, :face%count), values(:face%count))
  end function face_position

  !> Give a face the unit normals of a curved surface at its nodes, (3, count). The face stays flat if all of them are
  !> perpendicular to it, or one is nearly parallel to it. A normal that leans by more than 60 degrees from that of the
  !> face at the node is replaced by the latter.
  pure subroutine bend(face, normal)
    type(face_nodes), intent(inout) :: face
    real(dp), intent(in) :: normal(:, :)
    real(dp) :: own(3)
    integer :: i, k

    face%normal(:, :face%count) = normal(:, :face%count)
    do k = 1, face%count
      own = unit(face_normal(face, node_place(face%kind, k)))
      if (dot_product(own, normal(:, k)) < 0.5_dp) face%normal(:, k) = own
    end do
    face%bent = .false.
    own = unit(face_normal(face, middle_place(face%kind)))
    if (minval(matmul(own, face%normal(:, :face%count))) < 0.1_dp) return
    do k = 1, face%count
      do i = 1, face%count
        own = face%x(:, i) - face%x(:, k)
        face%bent = face%bent .or. abs(dot_product(own, face%normal(:, k))) > FLAT*norm2(own)
      end do
    end do
    if (face%kind == EDGE_3) then
      face%lean(1) = lean_along(face, 1, 3) + lean_along(face, 3, 2)
    else if (face%count == corner_count(face%kind)) then
      do k = 1, merge(1, face%count, face%kind == EDGE_2)
        face%lean(k) = lean_along(face, k, modulo(k, face%count) + 1)
      end do
    end if
  end subroutine bend

  !> How far the normals at two nodes lean to the same end of the way from one to the other, times its length.
  pure function lean_along(face, i, j) result(lean)
    type(face_nodes), intent(in) :: face
    integer, intent(in) :: i, j
    real(dp) :: lean

    lean = dot_product(face%x(:, j) - face%x(:, i), face%normal(:, i) + face%normal(:, j))
  end function lean_along

  !> The normal at a place, outwards; its length is the area, or length, per area of the places.
  pure function face_normal(face, place) result(normal)
    type(face_nodes), intent(in) :: face
    real(dp), intent(in) :: place(2)
    real(dp) :: normal(3), slopes(MOST_NODES, 2), tangent(3, 2)

    slopes = shape_slopes(face%kind, place)
    tangent = matmul(face%x(:, :face%count), slopes(:face%count, :))
    if (face%kind <= EDGE_3) then
      normal = [tangent(2, 1), -tangent(1, 1), 0.0_dp]
    else
      normal = cross(tangent(:, 1), tangent(:, 2))
    end if
  end function face_normal

  !> Are all middle nodes in the middle of their sides?
  pure function is_straight(face) result(straight)
    type(face_nodes), intent(in) :: face
    logical :: straight
    integer :: ends(2), k, sides

    straight = .true.
    sides = corner_count(face%kind)
    do k = sides + 1, face%count
      ends = side_ends(face%kind, k)
      straight = straight .and. norm2(2.0_dp*face%x(:, k) - face%x(:, ends(1)) - face%x(:, ends(2))) &
                 <= ROUNDING*norm2(face%x(:, ends(2)) - face%x(:, ends(1)))
    end do
  end function is_straight

  !> Is the position a linear function of the place?
  pure function is_affine(face) result(affine)
    type(face_nodes), intent(in) :: face
    logical :: affine

    affine = is_straight(face)
    if (face%kind == QUADRANGLE_4 .or. face%kind == QUADRANGLE_8) affine = affine .and. &
      norm2(face%x(:, 1) - face%x(:, 2) + face%x(:, 3) - face%x(:, 4)) <= ROUNDING*norm2(face%x(:, 3) - face%x(:, 1))
  end function is_affine

  !> Two unit vectors across a unit `direction`, right-handed with it. In the plane the first one lies in the plane.
  pure function frame_across(direction) result(frame)
    real(dp), intent(in) :: direction(3)
    real(dp) :: frame(3, 2)

    if (abs(direction(3)) < 0.5_dp) then
      frame(:, 1) = unit([-direction(2), direction(1), 0.0_dp])
    else
      frame(:, 1) = unit([0.0_dp, -direction(3), direction(2)])
    end if
    frame(:, 2) = cross(direction, frame(:, 1))
  end function frame_across

  !> The place in a face that a line through `point` along a unit `direction` hits. `found` is false where Newton's
  !> iteration does not converge; the place may lie outside the face.
  pure subroutine find_across(face, point, direction, place, distance, found)
    type(face_nodes), intent(in) :: face
    real(dp), intent(in) :: point(3), direction(3)
    real(dp), intent(out) :: place(2), distance
    logical, intent(out) :: found
    real(dp) :: frame(3, 2)

    frame = frame_across(direction)
    call across(face, frame, matmul(point, frame), place, found)
    distance = dot_product(direction, face_position(face, place) - point)
  end subroutine find_across

  !> The place in a face whose position has the coordinates `target` along the two vectors of `frame`.
  pure subroutine across(face, frame, target, place, found)
    type(face_nodes), intent(in) :: face
    real(dp), intent(in) :: frame(3, 2), target(2)
    real(dp), intent(out) :: place(2)
    logical, intent(out) :: found
    real(dp) :: flat(2, MOST_NODES), values(MOST_NODES), slopes(MOST_NODES, 2), miss(2), slope(2, 2), step(2), &
        size, last
    logical :: one_step
    integer :: k

    flat(:, :face%count) = matmul(transpose(frame), face%x(:, :face%count))
    place = middle_place(face%kind)
    last = huge(last)
    one_step = is_linear(face%kind, flat)
    do k = 1, MOST_STEPS
      values = shape_values(face%kind, place)
      slopes = shape_slopes(face%kind, place)
      miss = target - matmul(flat(:, :face%count), values(:face%count))
      slope = matmul(flat(:, :face%count), slopes(:face%count, :))
      call solve_step(face%kind <= EDGE_3, slope, miss, step, found)
      if (.not. found) return
      size = maxval(abs(step))
      ! At the rounding error steps no longer shrink.
      found = size <= 1.0e-8_dp .and. size >= 0.25_dp*last
      if (found) return
      place = place + step
      found = maxval(abs(place)) <= 1.0e3_dp .and. (one_step .or. size <= 4.0_dp*epsilon(1.0_dp))
      if (found .or. maxval(abs(place)) > 1.0e3_dp) return
      last = size
    end do
    found = size <= 1.0e-8_dp
  end subroutine across

  !> Is a face seen as `flat` linear in the place, to the last digits, so that one step is enough?
  pure function is_linear(kind, flat) result(linear)
    integer, intent(in) :: kind
    real(dp), intent(in) :: flat(2, MOST_NODES)
    logical :: linear

    linear = kind == EDGE_2 .or. kind == TRIANGLE_3
    if (kind == QUADRANGLE_4) linear = maxval(abs((flat(:, 1) - flat(:, 2)) + (flat(:, 3) - flat(:, 4)))) &
      <= 4.0_dp*epsilon(1.0_dp)*maxval(abs(flat(:, 3) - flat(:, 1)))
  end function is_linear

  !> A step of Newton's iteration; `regular` is false where the face is seen edge-on.
  pure subroutine solve_step(edge, slope, miss, step, regular)
    logical, intent(in) :: edge
    real(dp), intent(in) :: slope(2, 2), miss(2)
    real(dp), intent(out) :: step(2)
    logical, intent(out) :: regular
    real(dp) :: determinant

    step = 0.0_dp
    if (edge) then
      determinant = slope(1, 1)
      regular = abs(determinant) > 0.0_dp
      if (regular) step(1) = miss(1)/determinant
      return
    end if
    determinant = slope(1, 1)*slope(2, 2) - slope(1, 2)*slope(2, 1)
    regular = abs(determinant) > 16.0_dp*epsilon(1.0_dp)*(abs(slope(1, 1)*slope(2, 2)) + abs(slope(1, 2)*slope(2, 1)))
    if (regular) step = [slope(2, 2)*miss(1) - slope(1, 2)*miss(2), slope(1, 1)*miss(2) - slope(2, &
        1)*miss(1)]/determinant
  end subroutine solve_step

  pure function cross(a, b) result(product)
    real(dp), intent(in) :: a(3), b(3)
    real(dp) :: product(3)

    product = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
  end function cross

  !> A vector divided by its length; zero stays zero.
  pure function unit(vector) result(direction)
    real(dp), intent(in) :: vector(3)
    real(dp) :: direction(3), length

    length = norm2(vector)
    direction = vector
    if (length > 0.0_dp) direction = vector/length
  end function unit

end module fuge_face_geometry
