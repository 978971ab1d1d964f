!> Forces of a uniform pressure on one face of an element, at its nodes.
module face_pressures
  use fuge_core, only: dp => fuge_dp
  implicit none
  private

  public :: add_face_forces

  !> Gauss's rule of three points on [-1, 1].
  real(dp), parameter :: POINTS(3) = sqrt(0.6_dp)*[-1.0_dp, 0.0_dp, 1.0_dp]
  real(dp), parameter :: WEIGHTS(3) = [5.0_dp, 8.0_dp, 5.0_dp]/9.0_dp

  !> Shape functions of a face at one point.
  type :: face_shapes
    real(dp) :: value(8) = 0.0_dp
    !> Derivatives along xi and eta.
    real(dp) :: slope(8, 2) = 0.0_dp
  end type face_shapes

contains

  !> Add the forces of a pressure of 1, into the body, at the nodes of one face.
  !>
  !> `x` (dimensions, nodes): positions, in the plane of 2 or 3 nodes, in space of 3, 4, 6 or 8, corners first,
  !> counter-clockwise seen from outside. `on_ring`: the plane is the section of a body of revolution about x = 0.
  pure subroutine add_face_forces(x, on_ring, force)
    real(dp), intent(in) :: x(:, :)
    logical, intent(in) :: on_ring
    real(dp), intent(inout) :: force(:, :)
    real(dp), parameter :: PI = acos(-1.0_dp)
    type(face_shapes) :: at
    real(dp) :: normal(3), point(2), weight
    integer :: k, n, p, q

    n = size(x, 2)
    do q = 1, merge(1, 3, size(x, 1) == 2)
      do p = 1, 3
        call find_point(size(x, 1), n, p, q, point, weight)
        call find_shapes(size(x, 1), n, point, at)
        normal = area_vector(x, at)
        if (on_ring) weight = weight*2.0_dp*PI*dot_product(x(1, :), at%value(:n))
        do k = 1, n
          force(:, k) = force(:, k) - weight*at%value(k)*normal(:size(x, 1))
        end do
      end do
    end do
  end subroutine add_face_forces

  !> The vector of area per unit of xi and eta, outwards; the body of an edge lies to its left.
  pure function area_vector(x, at) result(normal)
    real(dp), intent(in) :: x(:, :)
    type(face_shapes), intent(in) :: at
    real(dp) :: normal(3)
    real(dp) :: a(3), b(3)

    a = 0.0_dp
    b = [0.0_dp, 0.0_dp, 1.0_dp]
    a(:size(x, 1)) = matmul(x, at%slope(:size(x, 2), 1))
    if (size(x, 1) == 3) b = matmul(x, at%slope(:size(x, 2), 2))
    normal = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
  end function area_vector

  !> One point of the rule: on a triangle the square with one side drawn together to a corner.
  pure subroutine find_point(dimensions, nodes, p, q, point, weight)
    integer, intent(in) :: dimensions, nodes, p, q
    real(dp), intent(out) :: point(2), weight
    real(dp) :: u, v

    point = [POINTS(p), 0.0_dp]
    weight = WEIGHTS(p)
    if (dimensions == 2) return
    point(2) = POINTS(q)
    weight = WEIGHTS(p)*WEIGHTS(q)
    if (modulo(nodes, 3) /= 0) return
    u = 0.5_dp*(1.0_dp + POINTS(p))
    v = 0.5_dp*(1.0_dp + POINTS(q))
    point = [u*(1.0_dp - v), v]
    weight = 0.25_dp*weight*(1.0_dp - v)
  end subroutine find_point

  pure subroutine find_shapes(dimensions, nodes, point, at)
    integer, intent(in) :: dimensions, nodes
    real(dp), intent(in) :: point(2)
    type(face_shapes), intent(out) :: at

    if (dimensions == 2) then
      call find_edge(nodes, point(1), at)
    else if (modulo(nodes, 3) == 0) then
      call find_triangle(nodes, point, at)
    else
      call find_quadrangle(nodes, point, at)
    end if
  end subroutine find_shapes

  !> An edge of two or three nodes, the third one in the middle.
  pure subroutine find_edge(nodes, xi, at)
    integer, intent(in) :: nodes
    real(dp), intent(in) :: xi
    type(face_shapes), intent(inout) :: at

    at%value(:2) = 0.5_dp*[1.0_dp - xi, 1.0_dp + xi]
    at%slope(:2, 1) = [-0.5_dp, 0.5_dp]
    if (nodes < 3) return
    at%value(:3) = [0.5_dp*xi*(xi - 1.0_dp), 0.5_dp*xi*(xi + 1.0_dp), (1.0_dp - xi)*(1.0_dp + xi)]
    at%slope(:3, 1) = [xi - 0.5_dp, xi + 0.5_dp, -2.0_dp*xi]
  end subroutine find_edge

  !> A triangle of three or six nodes, by its barycentric coordinates l.
  pure subroutine find_triangle(nodes, point, at)
    integer, intent(in) :: nodes
    real(dp), intent(in) :: point(2)
    type(face_shapes), intent(inout) :: at
    real(dp), parameter :: SLOPES(3, 2) = reshape([-1.0_dp, 1.0_dp, 0.0_dp, -1.0_dp, 0.0_dp, 1.0_dp], [3, 2])
    real(dp) :: l(3)
    integer :: i, j

    l = [1.0_dp - point(1) - point(2), point(1), point(2)]
    at%value(:3) = l
    at%slope(:3, :) = SLOPES
    if (nodes < 6) return
    do i = 1, 3
      j = modulo(i, 3) + 1
      at%value(i) = l(i)*(2.0_dp*l(i) - 1.0_dp)
      at%slope(i, :) = (4.0_dp*l(i) - 1.0_dp)*SLOPES(i, :)
      at%value(3 + i) = 4.0_dp*l(i)*l(j)
      at%slope(3 + i, :) = 4.0_dp*(l(i)*SLOPES(j, :) + l(j)*SLOPES(i, :))
    end do
  end subroutine find_triangle

  !> A quadrangle of four nodes, or of eight, the serendipity family.
  pure subroutine find_quadrangle(nodes, point, at)
    integer, intent(in) :: nodes
    real(dp), intent(in) :: point(2)
    type(face_shapes), intent(inout) :: at
    real(dp), parameter :: X(8) = [-1.0_dp, 1.0_dp, 1.0_dp, -1.0_dp, 0.0_dp, 1.0_dp, 0.0_dp, -1.0_dp]
    real(dp), parameter :: Y(8) = [-1.0_dp, -1.0_dp, 1.0_dp, 1.0_dp, -1.0_dp, 0.0_dp, 1.0_dp, 0.0_dp]
    integer :: k

    associate (xi => point(1), eta => point(2))
      do k = 1, 4
        at%value(k) = 0.25_dp*(1.0_dp + X(k)*xi)*(1.0_dp + Y(k)*eta)
        at%slope(k, :) = 0.25_dp*[X(k)*(1.0_dp + Y(k)*eta), Y(k)*(1.0_dp + X(k)*xi)]
        if (nodes < 8) cycle
        at%slope(k, :) = at%slope(k, :)*(X(k)*xi + Y(k)*eta - 1.0_dp) + at%value(k)*[X(k), Y(k)]
        at%value(k) = at%value(k)*(X(k)*xi + Y(k)*eta - 1.0_dp)
      end do
      if (nodes < 8) return
      do k = 5, 7, 2
        at%value(k) = 0.5_dp*(1.0_dp - xi)*(1.0_dp + xi)*(1.0_dp + Y(k)*eta)
        at%slope(k, :) = [-xi*(1.0_dp + Y(k)*eta), 0.5_dp*(1.0_dp - xi)*(1.0_dp + xi)*Y(k)]
        at%value(k + 1) = 0.5_dp*(1.0_dp - eta)*(1.0_dp + eta)*(1.0_dp + X(k + 1)*xi)
        at%slope(k + 1, :) = [0.5_dp*(1.0_dp - eta)*(1.0_dp + eta)*X(k + 1), -eta*(1.0_dp + X(k + 1)*xi)]
      end do
    end associate
  end subroutine find_quadrangle

end module face_pressures
