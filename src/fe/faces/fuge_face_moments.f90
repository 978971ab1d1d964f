!> Integrals over the common part of two faces, by which a mortar method weighs.
module fuge_face_moments
  use fuge_curved_faces, only: curved_gap, curved_point, curved_weights, find_opposite
  use fuge_face_geometry, only: across, circumference, face_nodes, face_normal, face_position, is_affine, unit
  use fuge_face_segments, only: convex_polygon
  use fuge_face_shapes, only: corner_count, middle_share, shape_values, side_ends, EDGE_2, EDGE_3, MOST_NODES, &
    QUADRANGLE_4, QUADRANGLE_8, TRIANGLE_3, TRIANGLE_6
  use fuge_gauss_legendre, only: gauss_rule
  use fuge_kinds, only: dp
  implicit none
  private

  public :: add_moments, mixed_values, nowhere_negative, unmixed

  !> Integrals over a part of a face of the contact surface. Its shape functions N' are those with positive
  !> integrals (`middle_share`); those of the opposite face are N. Of bodies of revolution the integrals
  !> are those over rings.
  type, public :: face_moments
    !> Integrals of N'_A, (A).
    real(dp) :: area(MOST_NODES) = 0.0_dp
    !> Of N'_A N'_B, (A, B).
    real(dp) :: mass(MOST_NODES, MOST_NODES) = 0.0_dp
    !> Of N'_A N_C, (A, C).
    real(dp) :: cross(MOST_NODES, MOST_NODES) = 0.0_dp
    !> Of N'_A times the way from the contact surface to the opposite one, (3, A).
    real(dp) :: way(3, MOST_NODES) = 0.0_dp
    !> For curved surfaces, of N'_A times the gap between them, (A), and times the weights of the displacements of both
    !> along its direction (`curved_weights`), (3, B, A) and (3, C, A).
    real(dp) :: gap(MOST_NODES) = 0.0_dp
    real(dp) :: own_axes(3, MOST_NODES, MOST_NODES) = 0.0_dp, axes(3, MOST_NODES, MOST_NODES) = 0.0_dp
    !> Of N'_A times the unit normal of the opposite face, (3, A).
    real(dp) :: normal(3, MOST_NODES) = 0.0_dp
    !> Of N'_A times the place in the opposite face, (2, A).
    real(dp) :: place(2, MOST_NODES) = 0.0_dp
  end type face_moments

  !> Points along a line for integrals that are no polynomials, as on quadrangles that are no parallelograms.
  integer, parameter :: MOST_POINTS = 10
  !> Points along a line at least for gaps between curved surfaces, in the plane and in space.
  integer, parameter :: CURVED_POINTS(2) = [5, 3]

contains

  !> The shape functions N' of the contact surface, from its shape functions.
  pure function mixed_values(kind, values) result(mixed)
    integer, intent(in) :: kind
    real(dp), intent(in) :: values(MOST_NODES)
    real(dp) :: mixed(MOST_NODES)
    integer :: ends(2), k

    mixed = values
    if (.not. middle_share(kind) > 0.0_dp) return
    do k = corner_count(kind) + 1, MOST_NODES
      ends = side_ends(kind, k)
      mixed(ends) = mixed(ends) + middle_share(kind)*values(k)
      mixed(k) = (1.0_dp - 2.0_dp*middle_share(kind))*values(k)
    end do
  end function mixed_values

  !> Factors of the N'_B in functions with the sum 1 that are nowhere negative, for parts of a face: the N'_A themselves
  !> except on a quadrangle of 8 nodes, where the share of the middle nodes becomes 3/8, the least for which this holds.
  pure function nowhere_negative(kind, count) result(factor)
    integer, intent(in) :: kind, count
    real(dp) :: factor(MOST_NODES, MOST_NODES)
    integer :: k

    factor = 0.0_dp
    do k = 1, count
      factor(k, k) = 1.0_dp
      if (kind /= QUADRANGLE_8 .or. k <= corner_count(kind)) cycle
      factor(side_ends(kind, k), k) = 0.25_dp
      factor(k, k) = 0.5_dp
    end do
  end function nowhere_negative

  !> The matrix that turns the displacements of the nodes into the coefficients of the N'_A of the same field.
  pure function unmixed(kind, count) result(factor)
    integer, intent(in) :: kind, count
    real(dp) :: factor(MOST_NODES, MOST_NODES)
    integer :: ends(2), k

    factor = 0.0_dp
    do k = 1, count
      factor(k, k) = 1.0_dp
      if (k <= corner_count(kind)) cycle
      ends = side_ends(kind, k)
      factor(k, k) = 1.0_dp/(1.0_dp - 2.0_dp*middle_share(kind))
      factor(k, ends) = -middle_share(kind)/(1.0_dp - 2.0_dp*middle_share(kind))
    end do
  end function unmixed

  !> Add the integrals over `part`, in the plane that `frame` spans across the unit `direction`; of the `curved`
  !> surfaces that the faces stand for.
  pure subroutine add_moments(face, opposite, direction, frame, curved, part, moments)
    type(face_nodes), intent(in) :: face, opposite
    logical, intent(in) :: curved
    real(dp), intent(in) :: direction(3), frame(3, 2)
    type(convex_polygon), intent(in) :: part
    type(face_moments), intent(inout) :: moments

    if (part%count == 2) then
      call add_interval(face, opposite, frame, curved, part, moments)
    else
      call add_polygon(face, opposite, direction, frame, curved, part, moments)
    end if
  end subroutine add_moments

  !> Integrate over an interval, in the places of the face.
  pure subroutine add_interval(face, opposite, frame, curved, part, moments)
    type(face_nodes), intent(in) :: face, opposite
    logical, intent(in) :: curved
    real(dp), intent(in) :: frame(3, 2)
    type(convex_polygon), intent(in) :: part
    type(face_moments), intent(inout) :: moments
    real(dp) :: node(MOST_POINTS), weight(MOST_POINTS), from(2), to(2), place(2), facing(2)
    logical :: found(3)
    integer :: k, points

    points = point_count(face, opposite, curved)
    call gauss_rule(node(:points), weight(:points))
    call across(face, frame, part%corner(:, 1), from, found(1))
    call across(face, frame, part%corner(:, 2), to, found(2))
    if (.not. all(found(:2))) return
    do k = 1, points
      place = [from(1) + node(k)*(to(1) - from(1)), 0.0_dp]
      call across(opposite, frame, matmul(face_position(face, place), frame), facing, found(3))
      if (found(3)) call add_point(face, opposite, curved, place, facing, &
                                   weight(k)*(to(1) - from(1))*norm2(face_normal(face, place)), moments)
    end do
  end subroutine add_interval

  !> Integrate over a polygon, in triangles about its first corner; the rule is a product of Gauss' that shrinks
  !> towards that corner.
  pure subroutine add_polygon(face, opposite, direction, frame, curved, part, moments)
    type(face_nodes), intent(in) :: face, opposite
    logical, intent(in) :: curved
    real(dp), intent(in) :: direction(3), frame(3, 2)
    type(convex_polygon), intent(in) :: part
    type(face_moments), intent(inout) :: moments
    real(dp) :: node(MOST_POINTS), weight(MOST_POINTS), first(2), second(2), double_area, tilt, place(2), facing(2), &
      target(2)
    logical :: found(2)
    integer :: i, j, k, points

    points = point_count(face, opposite, curved)
    call gauss_rule(node(:points), weight(:points))
    do k = 2, part%count - 1
      first = part%corner(:, k) - part%corner(:, 1)
      second = part%corner(:, k + 1) - part%corner(:, k)
      double_area = first(1)*second(2) - first(2)*second(1)
      if (.not. double_area > 0.0_dp) cycle
      do j = 1, points
        do i = 1, points
          target = part%corner(:, 1) + node(i)*(first + node(j)*second)
          call across(face, frame, target, place, found(1))
          call across(opposite, frame, target, facing, found(2))
          if (.not. all(found)) cycle
          tilt = dot_product(unit(face_normal(face, place)), direction)
          if (.not. tilt > 0.1_dp) cycle
          call add_point(face, opposite, curved, place, facing, weight(i)*weight(j)*node(i)*double_area/tilt, moments)
        end do
      end do
    end do
  end subroutine add_polygon

  !> Points along a line: enough for the products of shape functions of affine faces to be integrated exactly.
  pure function point_count(face, opposite, curved) result(points)
    type(face_nodes), intent(in) :: face, opposite
    logical, intent(in) :: curved
    integer :: points, degree

    degree = shape_degree(face%kind) + max(shape_degree(face%kind), shape_degree(opposite%kind))
    if (face%revolution) degree = degree + 1
    ! A triangle's corner adds one degree; n points are exact up to 2 n - 1.
    points = degree/2 + 1
    if (curved) points = max(points, CURVED_POINTS(merge(1, 2, face%kind <= EDGE_3)))
    if (.not. (is_affine(face) .and. is_affine(opposite))) points = MOST_POINTS
  end function point_count

  pure function shape_degree(kind) result(degree)
    integer, intent(in) :: kind
    integer :: degree

    select case (kind)
    case (EDGE_2, TRIANGLE_3)
      degree = 1
    case (EDGE_3, TRIANGLE_6, QUADRANGLE_4)
      degree = 2
    case default
      degree = 3
    end select
  end function shape_degree

  !> Add one point of the quadrature; `area` is that of the face as it is, of a ring the length across.
  pure subroutine add_point(face, opposite, curved, place, facing, area, moments)
    type(face_nodes), intent(in) :: face, opposite
    logical, intent(in) :: curved
    real(dp), intent(in) :: place(2), facing(2), area
    type(face_moments), intent(inout) :: moments
    real(dp) :: mixed(MOST_NODES), values(MOST_NODES), across_values(MOST_NODES), way(3), normal(3), weight
    integer :: k

    mixed = mixed_values(face%kind, shape_values(face%kind, place))
    if (curved) then
      call add_curved_point(face, opposite, place, facing, area, mixed, moments, normal, weight)
    else
      weight = area*circumference(face, face_position(face, place))
      way = face_position(opposite, facing) - face_position(face, place)
      normal = unit(face_normal(opposite, facing))
      do k = 1, face%count
        moments%way(:, k) = moments%way(:, k) + weight*mixed(k)*way
      end do
    end if
    values = weight*mixed
    across_values = shape_values(opposite%kind, facing)
    moments%area = moments%area + values
    do k = 1, opposite%count
      moments%cross(:, k) = moments%cross(:, k) + values*across_values(k)
    end do
    do k = 1, face%count
      ! No division by the weight: it may be zero in a sliver.
      moments%mass(:, k) = moments%mass(:, k) + values*mixed(k)
      moments%normal(:, k) = moments%normal(:, k) + values(k)*normal
      moments%place(:, k) = moments%place(:, k) + values(k)*facing
    end do
  end subroutine add_point

  !> Add what is special to curved surfaces, with the `values` of N'. Returns the unit normal of the opposite one, and
  !> `weight`, the area of the curved surface. The arguments are nine, because a point of integration has a place on
  !> either face.
  pure subroutine add_curved_point(face, opposite, place, facing, area, values, moments, normal, weight)
    type(face_nodes), intent(in) :: face, opposite
    real(dp), intent(in) :: place(2), facing(2), area, values(MOST_NODES)
    type(face_moments), intent(inout) :: moments
    real(dp), intent(out) :: normal(3), weight
    real(dp) :: here(3), own(3), there(3), across(2), own_weights(3, MOST_NODES), weights(3, MOST_NODES)
    integer :: k

    call curved_point(face, place, here, own)
    weight = area*(norm2(own)/norm2(face_normal(face, place)))*circumference(face, here)
    own = unit(own)
    across = facing
    call find_opposite(opposite, here, own, across)
    call curved_point(opposite, across, there, normal)
    normal = unit(normal)
    moments%gap = moments%gap + weight*curved_gap(there - here, own, normal)*values
    own_weights = curved_weights(face, place, own)
    weights = curved_weights(opposite, across, own)
    do k = 1, face%count
      moments%own_axes(:, :, k) = moments%own_axes(:, :, k) + (weight*values(k))*own_weights
      moments%axes(:, :, k) = moments%axes(:, :, k) + (weight*values(k))*weights
    end do
  end subroutine add_curved_point

end module fuge_face_moments
