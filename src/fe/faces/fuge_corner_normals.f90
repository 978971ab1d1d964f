!> Normals of curved bodies at the corners of one face, from the positions of its nodes alone.
module fuge_corner_normals
  use fuge_face_geometry, only: cross, face_nodes
  use fuge_face_shapes, only: corner_count, EDGE_3
  use fuge_kinds, only: dp
  implicit none
  private

  public :: corner_normal, half_edge_normal, middle_edge_normal, reflected, side_tangent

contains

  !> The normal at corner `k`, outwards. Its length is the weight that it has in the mean of the faces around the
  !> corner: the sine of the angle there over the lengths of the two sides, in the plane one over the length of the
  !> edge.
  !>
  !> With these weights the mean is exact if all corners lie on a sphere, in the plane on a circle, however unequal the
  !> faces are (N. Max: Weights for computing vertex normals from facet normals, Journal of Graphics Tools 4, 1999). If
  !> there are middle nodes, the normal of each face is exact by itself.
  pure function corner_normal(face, k) result(normal)
    type(face_nodes), intent(in) :: face
    integer, intent(in) :: k
    real(dp) :: normal(3), tangent(3)
    integer :: corners

    corners = corner_count(face%kind)
    if (face%kind <= EDGE_3) then
      tangent = side_tangent(face, k, 3 - k)
      if (k == 2) tangent = -tangent
      normal = [tangent(2), -tangent(1), 0.0_dp]
    else
      normal = cross(side_tangent(face, k, modulo(k, corners) + 1), side_tangent(face, k, modulo(k - 2, corners) + 1))
    end if
  end function corner_normal

  !> The normal of the half of a quadratic edge at corner `k`, over its length.
  pure function half_edge_normal(face, k) result(normal)
    type(face_nodes), intent(in) :: face
    integer, intent(in) :: k
    real(dp) :: normal(3), tangent(3)

    tangent = inverted(face%x(:, 3) - face%x(:, k))
    if (k == 2) tangent = -tangent
    normal = [tangent(2), -tangent(1), 0.0_dp]
  end function half_edge_normal

  !> The normal at the middle node of a quadratic edge, of the circle through its three nodes.
  pure function middle_edge_normal(face) result(normal)
    type(face_nodes), intent(in) :: face
    real(dp) :: normal(3), tangent(3)

    tangent = inverted(face%x(:, 2) - face%x(:, 3)) - inverted(face%x(:, 1) - face%x(:, 3))
    normal = [tangent(2), -tangent(1), 0.0_dp]
  end function middle_edge_normal

  !> The tangent at corner `from` of the side towards corner `to`, divided by about the length of the side. A side with
  !> a middle node is an arc of the circle through its three nodes, found by inversion about `from`.
  pure function side_tangent(face, from, to) result(tangent)
    type(face_nodes), intent(in) :: face
    integer, intent(in) :: from, to
    real(dp) :: tangent(3)
    integer :: corners

    corners = corner_count(face%kind)
    tangent = inverted(face%x(:, to) - face%x(:, from))
    if (face%count == corners) return
    if (face%kind == EDGE_3) then
      tangent = inverted(face%x(:, 3) - face%x(:, from)) - tangent
    else if (to == modulo(from, corners) + 1) then
      tangent = inverted(face%x(:, corners + from) - face%x(:, from)) - tangent
    else
      tangent = inverted(face%x(:, corners + to) - face%x(:, from)) - tangent
    end if
  end function side_tangent

  !> A vector divided by the square of its length.
  pure function inverted(vector)
    real(dp), intent(in) :: vector(3)
    real(dp) :: inverted(3), length

    inverted = 0.0_dp
    length = norm2(vector)
    if (length > 0.0_dp) inverted = (vector/length)/length
  end function inverted

  !> The unit normal at the other end of an arc of a circle, if `normal` is that at one end and `way` leads from one to
  !> the other.
  pure function reflected(normal, way) result(other)
    real(dp), intent(in) :: normal(3), way(3)
    real(dp) :: other(3), length

    other = normal
    length = norm2(way)
    if (length > 0.0_dp) other = normal - 2.0_dp*dot_product(normal, way/length)*(way/length)
  end function reflected

end module fuge_corner_normals
