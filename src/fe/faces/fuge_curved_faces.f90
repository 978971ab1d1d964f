!> The curved surface that a face stands for, and gaps between two of them.
!>
!> With shape functions N_i, nodes x_i and unit normals n_i of the curved surface there, x = sum N_i x_i the place on
!> the face and n = sum N_i n_i, the surface is
!>
!>     x + h n/|n|,   h = (sum N_i (x_i - x).n_i)/(1 + |n|)
!>
!> On a circle, a sphere or a cylinder of radius R about c the nodes are x_i = c + R n_i along these, so that x = c + R
!> n and sum N_i (x_i - x).n_i = R (1 - |n|**2): the surface is c + R n/|n|, that of the body to rounding, for all kinds
!> of faces. On a flat face h is zero. A side belongs to its nodes alone, so faces join. Linear faces, and edges,
!> that are no part of a sphere have a cubic term in addition, so that along each side the surface has the slopes that
!> the normals demand (Hermite's interpolation); n/|n| stands across it in the nodes only, and so the normal is that of
!> its tangents.
module fuge_curved_faces
  use fuge_face_geometry, only: cross, face_nodes, frame_across, solve_step
  use fuge_face_shapes, only: corner_count, shape_slopes, shape_values, EDGE_3, MOST_NODES
  use fuge_kinds, only: dp
  implicit none
  private

  public :: curved_gap, curved_point, curved_weights, find_opposite

  !> Steps of Newton's iteration for a point across, from the one across on the face itself.
  integer, parameter :: STEPS = 4
  !> Largest change of a place by Newton's iteration: faces are closer to their curved surfaces than that.
  real(dp), parameter :: FAR = 0.25_dp

contains

  !> The position of a place on the curved surface, and its normal there, outwards; the length of this is the area, or
  !> length, per area of the places.
  pure subroutine curved_point(face, place, position, normal)
    type(face_nodes), intent(in) :: face
    real(dp), intent(in) :: place(2)
    real(dp), intent(out) :: position(3), normal(3)
    real(dp) :: tangent(3, 2)

    call span_point(face, place, position, tangent)
    if (face%kind <= EDGE_3) then
      normal = [tangent(2, 1), -tangent(1, 1), 0.0_dp]
    else
      normal = cross(tangent(:, 1), tangent(:, 2))
    end if
  end subroutine curved_point

  !> The position of a place on the curved surface, and its derivatives with respect to the place.
  pure subroutine span_point(face, place, position, tangent)
    type(face_nodes), intent(in) :: face
    real(dp), intent(in) :: place(2)
    real(dp), intent(out) :: position(3), tangent(3, 2)
    real(dp) :: mean(3), mean_slope(3), size, size_slope, slopes(MOST_NODES, 2), sum_height, values(MOST_NODES), &
      way(3), slope, height
    integer :: axis, i

    values = shape_values(face%kind, place)
    slopes = shape_slopes(face%kind, place)
    position = matmul(face%x(:, :face%count), values(:face%count))
    mean = matmul(face%normal(:, :face%count), values(:face%count))
    size = norm2(mean)
    sum_height = 0.0_dp
    do i = 1, face%count
      sum_height = sum_height + values(i)*dot_product(face%x(:, i) - position, face%normal(:, i))
    end do
    height = sum_height/(1.0_dp + size) + turn(face, values)
    tangent = 0.0_dp
    do axis = 1, merge(1, 2, face%kind <= EDGE_3)
      way = matmul(face%x(:, :face%count), slopes(:face%count, axis))
      mean_slope = matmul(face%normal(:, :face%count), slopes(:face%count, axis))
      size_slope = dot_product(mean, mean_slope)/size
      slope = -dot_product(way, mean)
      do i = 1, face%count
        slope = slope + slopes(i, axis)*dot_product(face%x(:, i) - position, face%normal(:, i))
      end do
      slope = (slope - sum_height*size_slope/(1.0_dp + size))/(1.0_dp + size) &
              + turn_slope(face, values, slopes(:, axis))
      tangent(:, axis) = way + (slope*mean + height*(mean_slope - mean*(size_slope/size)))/size
    end do
    position = position + height*(mean/size)
  end subroutine span_point

  !> Move `place`, where the line through `point` along a unit `direction` hits the face itself, to where it hits the
  !> curved surface; left alone where Newton's iteration leads further off than faces are from their curved surfaces.
  !>
  !> With contact points that are exactly across from each other, forces have no moment about the centre of a shaft.
  pure subroutine find_opposite(face, point, direction, place)
    type(face_nodes), intent(in) :: face
    real(dp), intent(in) :: point(3), direction(3)
    real(dp), intent(inout) :: place(2)
    real(dp) :: frame(3, 2), miss(2), next(2), position(3), slope(2, 2), step(2), tangent(3, 2)
    integer :: k
    logical :: regular

    frame = frame_across(direction)
    next = place
    do k = 1, STEPS
      call span_point(face, next, position, tangent)
      miss = matmul(point - position, frame)
      slope = matmul(transpose(frame), tangent)
      call solve_step(face%kind <= EDGE_3, slope, miss, step, regular)
      if (.not. regular) return
      next = next + step
      if (maxval(abs(next - place)) > FAR) return
      ! The next step would be as small as its square.
      if (maxval(abs(step)) <= 1.0e-8_dp) exit
    end do
    place = next
  end subroutine find_opposite

  !> How a place on the curved surface moves along `direction` as the nodes move: a vector of weights for each, (3,
  !> nodes).
  !>
  !> The position above with displacements for positions, and normals that stay: a translation moves it along; an even
  !> expansion of a circle, a sphere or a cylinder moves all places outwards evenly, as interpolated displacements do
  !> not; a rotation about its centre moves none across.
  pure function curved_weights(face, place, direction) result(weights)
    type(face_nodes), intent(in) :: face
    real(dp), intent(in) :: place(2), direction(3)
    real(dp) :: weights(3, MOST_NODES), mean(3), size, values(MOST_NODES)
    integer :: i

    values = shape_values(face%kind, place)
    mean = matmul(face%normal(:, :face%count), values(:face%count))
    size = norm2(mean)
    weights = 0.0_dp
    do i = 1, face%count
      weights(:, i) = values(i)*(direction + (face%normal(:, i) - mean)*(dot_product(mean, direction)/size &
                                                                          /(1.0_dp + size)))
    end do
  end function curved_weights

  !> The cubic part of the height of a linear face, or of an edge: where the normals at both ends of a side lean to the
  !> same side.
  pure function turn(face, values)
    type(face_nodes), intent(in) :: face
    real(dp), intent(in) :: values(MOST_NODES)
    real(dp) :: turn
    integer :: j, k

    turn = 0.0_dp
    if (face%kind == EDGE_3) turn = -0.25_dp*values(3)*(values(2) - values(1))*face%lean(1)
    if (face%count > corner_count(face%kind)) return
    do k = 1, merge(1, face%count, face%kind <= EDGE_3)
      j = modulo(k, face%count) + 1
      turn = turn - 0.5_dp*values(k)*values(j)*(values(k) - values(j))*face%lean(k)
    end do
  end function turn

  !> Its derivative, if `slopes` are those of the shape functions.
  pure function turn_slope(face, values, slopes) result(slope)
    type(face_nodes), intent(in) :: face
    real(dp), intent(in) :: values(MOST_NODES), slopes(MOST_NODES)
    real(dp) :: slope
    integer :: j, k

    slope = 0.0_dp
    if (face%kind == EDGE_3) slope = -0.25_dp*face%lean(1)*(slopes(3)*(values(2) - values(1)) &
                                                            + values(3)*(slopes(2) - slopes(1)))
    if (face%count > corner_count(face%kind)) return
    do k = 1, merge(1, face%count, face%kind <= EDGE_3)
      j = modulo(k, face%count) + 1
      associate (u => values(k), v => values(j))
        slope = slope - 0.5_dp*((2.0_dp*u - v)*v*slopes(k) + (u - 2.0_dp*v)*u*slopes(j))*face%lean(k)
      end associate
    end do
  end function turn_slope

  !> The gap between two curved surfaces from a point on each, `way` apart, and the unit normals there: the mean of the
  !> ways to the tangents along the bisector of the normals.
  !>
  !> Between two circles, cylinders or spheres about one centre it is the difference of the radii, although the points
  !> are not quite across from each other.
  pure function curved_gap(way, normal, opposite) result(gap)
    real(dp), intent(in) :: way(3), normal(3), opposite(3)
    real(dp) :: gap, cosine

    cosine = dot_product(normal, opposite)
    if (cosine < -0.1_dp) then
      gap = dot_product(way, normal - opposite)/(1.0_dp - cosine)
    else
      gap = dot_product(way, normal)
    end if
  end function curved_gap

end module fuge_curved_faces
