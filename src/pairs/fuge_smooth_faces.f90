!> The smooth surface that a face stands for, and gaps between two of them.
!>
!> With shape functions N_i, nodes x_i and unit normals n_i of the smooth surface there, x = sum N_i x_i the place on
!> the face and n = sum N_i n_i, the surface is
!>
!>     x + h n/|n|,   h = (sum N_i (x_i - x).n_i)/(1 + |n|)
!>
!> On a circle, a sphere or a cylinder of radius R about c the nodes are x_i = c + R n_i along these, so that x = c + R
!> n and sum N_i (x_i - x).n_i = R (1 - |n|**2): the surface is c + R n/|n|, that of the body to rounding, for all kinds
!> of faces. On a flat face h is zero. A side belongs to its nodes alone, so faces join. Linear faces that are no part
!> of a sphere have a cubic term in addition, so that along each side the surface has the slopes that the normals demand
!> (Hermite's interpolation); n/|n| stands across it in the nodes only, and so the normal is that of its tangents.
module fuge_smooth_faces
  use fuge_face_geometry, only: cross, face_nodes
  use fuge_face_shapes, only: corner_count, shape_slopes, shape_values, EDGE_3, MOST_NODES
  use fuge_kinds, only: dp
  implicit none
  private

  public :: smooth_gap, smooth_point

contains

  !> The position of a place on the smooth surface, and its normal there, outwards; the length of this is the area, or
  !> length, per area of the places.
  pure subroutine smooth_point(face, place, position, normal)
    type(face_nodes), intent(in) :: face
    real(dp), intent(in) :: place(2)
    real(dp), intent(out) :: position(3), normal(3)
    real(dp) :: mean(3), mean_slope(3), size, size_slope, slopes(MOST_NODES, 2), sum_height, tangent(3, 2), &
      values(MOST_NODES), way(3), slope, height
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
    if (face%kind <= EDGE_3) then
      normal = [tangent(2, 1), -tangent(1, 1), 0.0_dp]
    else
      normal = cross(tangent(:, 1), tangent(:, 2))
    end if
  end subroutine smooth_point

  !> The cubic part of the height of a linear face: where the normals at both ends of a side lean to the same side.
  pure function turn(face, values)
    type(face_nodes), intent(in) :: face
    real(dp), intent(in) :: values(MOST_NODES)
    real(dp) :: turn
    integer :: i, j, k

    turn = 0.0_dp
    if (face%count > corner_count(face%kind)) return
    do k = 1, merge(1, face%count, face%kind <= EDGE_3)
      i = k
      j = modulo(k, face%count) + 1
      turn = turn - 0.5_dp*values(i)*values(j)*(values(i) - values(j))*lean(face, i, j)
    end do
  end function turn

  !> Its derivative, if `slopes` are those of the shape functions.
  pure function turn_slope(face, values, slopes) result(slope)
    type(face_nodes), intent(in) :: face
    real(dp), intent(in) :: values(MOST_NODES), slopes(MOST_NODES)
    real(dp) :: slope
    integer :: i, j, k

    slope = 0.0_dp
    if (face%count > corner_count(face%kind)) return
    do k = 1, merge(1, face%count, face%kind <= EDGE_3)
      i = k
      j = modulo(k, face%count) + 1
      associate (u => values(i), v => values(j))
        slope = slope - 0.5_dp*((2.0_dp*u - v)*v*slopes(i) + (u - 2.0_dp*v)*u*slopes(j))*lean(face, i, j)
      end associate
    end do
  end function turn_slope

  !> How far the normals at the ends of a side lean along it to the same end, times its length; zero on an arc of a
  !> circle.
  pure function lean(face, i, j)
    type(face_nodes), intent(in) :: face
    integer, intent(in) :: i, j
    real(dp) :: lean

    lean = dot_product(face%x(:, j) - face%x(:, i), face%normal(:, i) + face%normal(:, j))
  end function lean

  !> The gap between two smooth surfaces from a point on each, `way` apart, and the unit normals there: the mean of the
  !> ways to the tangents along the bisector of the normals.
  !>
  !> Between two circles, cylinders or spheres about one centre it is the difference of the radii, although the points
  !> are not quite across from each other.
  pure function smooth_gap(way, normal, opposite) result(gap)
    real(dp), intent(in) :: way(3), normal(3), opposite(3)
    real(dp) :: gap, cosine

    cosine = dot_product(normal, opposite)
    if (cosine < -0.1_dp) then
      gap = dot_product(way, normal - opposite)/(1.0_dp - cosine)
    else
      gap = dot_product(way, normal)
    end if
  end function smooth_gap

end module fuge_smooth_faces
