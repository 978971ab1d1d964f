!> Stiffness of linear elastic finite elements: what a finite element program would supply.
!>
!> Isoparametric elements with full Gauss rules, nodes in the order of Abaqus and CalculiX: in the plane triangles of 3
!> and 6 nodes and quadrangles of 4 and 8; in space tetrahedra of 4 and 10 nodes and hexahedra of 8 and 20.
module elastic_elements
  use fuge, only: dp => fuge_dp
  implicit none
  private

  public :: mesh_stiffness

  !> What the plane is a section of. PLANE_STRAIN and PLANE_STRESS have unit thickness; AXISYMMETRIC has x as its
  !> radius and y as its axis, and its forces are those of the whole ring.
  integer, parameter, public :: PLANE_STRAIN = 1, PLANE_STRESS = 2, AXISYMMETRIC = 3, SOLID = 4

  real(dp), parameter :: PI = acos(-1.0_dp)
  !> Corners of the square (the first four) and the cube, and the corners at the ends of their sides.
  real(dp), parameter :: CORNER(3, 8) = reshape(real([-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1, &
                                                      -1, -1, 1, 1, -1, 1, 1, 1, 1, -1, 1, 1], dp), [3, 8])
  integer, parameter :: SIDE(2, 12) = reshape([1, 2, 2, 3, 3, 4, 4, 1, 5, 6, 6, 7, 7, 8, 8, 5, 1, 5, 2, 6, 3, 7, &
                                               4, 8], [2, 12])
  integer, parameter :: SIMPLEX_SIDE(2, 6) = reshape([1, 2, 2, 3, 3, 1, 1, 4, 2, 4, 3, 4], [2, 6])

  !> Shape functions and their derivatives at one point of an element.
  type :: shapes
    real(dp) :: value(20) = 0.0_dp
    real(dp) :: gradient(3, 20) = 0.0_dp
  end type shapes

contains

  !> Stiffness of a mesh, as compressed columns: column j holds `row(p)` and `value(p)` for `column(j)` <= p <
  !> `column(j + 1)`, both triangles, an entry for each element that adds to it.
  !>
  !> `node` (dimensions, nodes), length; `element` (most nodes of an element, elements), 0 beyond the nodes of an
  !> element; `scene` PLANE_STRAIN, PLANE_STRESS, AXISYMMETRIC or SOLID. Degree of freedom of node i along axis d:
  !> dimensions*(i - 1) + d.
  subroutine mesh_stiffness(node, element, scene, young, poisson, column, row, value)
    real(dp), intent(in) :: node(:, :)
    integer, intent(in) :: element(:, :), scene
    real(dp), intent(in) :: young, poisson
    integer, allocatable, intent(out) :: column(:), row(:)
    real(dp), allocatable, intent(out) :: value(:)
    real(dp) :: k(60, 60)
    integer :: dof(60), degrees, e, i, j, next(size(node)), nodes

    allocate (column(size(node) + 1))
    call count_entries(size(node, 1), element, column)
    allocate (row(column(size(column)) - 1), value(column(size(column)) - 1))
    next = column(:size(node))
    do e = 1, size(element, 2)
      nodes = count(element(:, e) > 0)
      degrees = size(node, 1)*nodes
      dof(:degrees) = degrees_of(size(node, 1), element(:nodes, e))
      call element_stiffness(node(:, element(:nodes, e)), scene, young, poisson, k(:degrees, :degrees))
      do j = 1, degrees
        do i = 1, degrees
          row(next(dof(j))) = dof(i)
          value(next(dof(j))) = k(i, j)
          next(dof(j)) = next(dof(j)) + 1
        end do
      end do
    end do
  end subroutine mesh_stiffness

  !> Where each column begins.
  pure subroutine count_entries(dimensions, element, column)
    integer, intent(in) :: dimensions, element(:, :)
    integer, intent(out) :: column(:)
    integer :: dof(60), degrees, e, j, nodes

    column = 0
    column(1) = 1
    do e = 1, size(element, 2)
      nodes = count(element(:, e) > 0)
      degrees = dimensions*nodes
      dof(:degrees) = degrees_of(dimensions, element(:nodes, e))
      do j = 1, degrees
        column(dof(j) + 1) = column(dof(j) + 1) + degrees
      end do
    end do
    do j = 2, size(column)
      column(j) = column(j) + column(j - 1)
    end do
  end subroutine count_entries

  !> Degrees of freedom of nodes, node by node.
  pure function degrees_of(dimensions, nodes) result(dof)
    integer, intent(in) :: dimensions, nodes(:)
    integer :: dof(dimensions*size(nodes))
    integer :: d, i

    do i = 1, size(nodes)
      do d = 1, dimensions
        dof(dimensions*(i - 1) + d) = dimensions*(nodes(i) - 1) + d
      end do
    end do
  end function degrees_of

  !> Stiffness of one element with nodes at `x`.
  pure subroutine element_stiffness(x, scene, young, poisson, k)
    real(dp), intent(in) :: x(:, :)
    integer, intent(in) :: scene
    real(dp), intent(in) :: young, poisson
    real(dp), intent(out) :: k(:, :)
    type(shapes) :: at
    real(dp) :: lambda, mu, place(3), volume, weight
    integer :: d, order, points, q

    d = size(x, 1)
    mu = young/(2.0_dp*(1.0_dp + poisson))
    lambda = 2.0_dp*mu*poisson/(1.0_dp - 2.0_dp*poisson)
    if (scene == PLANE_STRESS) lambda = 2.0_dp*mu*poisson/(1.0_dp - poisson)
    order = 2
    if (is_quadratic(d, size(x, 2))) order = 3
    points = order**d
    k = 0.0_dp
    do q = 0, points - 1
      call gauss_point(d, order, q, is_simplex(d, size(x, 2)), place, weight)
      call find_shapes(d, size(x, 2), place, at)
      call to_lengths(x, at, volume)
      if (scene == AXISYMMETRIC) then
        call add_ring(x, at, lambda, mu, weight*volume, k)
      else
        call add_point(d, size(x, 2), at, lambda, mu, weight*volume, k)
      end if
    end do
  end subroutine element_stiffness

  pure function is_simplex(d, nodes)
    integer, intent(in) :: d, nodes
    logical :: is_simplex

    is_simplex = any(nodes == [d + 1, (d + 1)*(d + 2)/2])
  end function is_simplex

  pure function is_quadratic(d, nodes)
    integer, intent(in) :: d, nodes
    logical :: is_quadratic

    is_quadratic = nodes /= d + 1 .and. nodes /= 2**d
  end function is_quadratic

  !> Point `q` of Gauss's rule with `order` points along each axis; for triangles and tetrahedra that of the square or
  !> cube, whose one side is shrunk to a corner.
  pure subroutine gauss_point(d, order, q, simplex, place, weight)
    integer, intent(in) :: d, order, q
    logical, intent(in) :: simplex
    real(dp), intent(out) :: place(3), weight
    real(dp) :: at(3), share(3)
    integer :: a, which

    if (order == 2) then
      at = [-1.0_dp, 1.0_dp, 0.0_dp]/sqrt(3.0_dp)
      share = [1.0_dp, 1.0_dp, 0.0_dp]
    else
      at = [-1.0_dp, 0.0_dp, 1.0_dp]*sqrt(0.6_dp)
      share = [5.0_dp, 8.0_dp, 5.0_dp]/9.0_dp
    end if
    place = 0.0_dp
    weight = 1.0_dp
    do a = 1, d
      which = modulo(q/order**(a - 1), order) + 1
      place(a) = at(which)
      weight = weight*share(which)
    end do
    if (.not. simplex) return
    place(:d) = 0.5_dp*(1.0_dp + place(:d))
    weight = weight*0.5_dp**d
    do a = 1, d - 1
      weight = weight*(1.0_dp - place(a))**(d - a)
    end do
    if (d == 3) place(3) = place(3)*(1.0_dp - place(1))*(1.0_dp - place(2))
    place(2) = place(2)*(1.0_dp - place(1))
  end subroutine gauss_point

  !> Shape functions with derivatives along the axes of the element.
  pure subroutine find_shapes(d, nodes, place, at)
    integer, intent(in) :: d, nodes
    real(dp), intent(in) :: place(3)
    type(shapes), intent(out) :: at

    if (is_simplex(d, nodes)) then
      call find_simplex_shapes(d, nodes, place, at)
    else
      call find_box_shapes(d, nodes, place, at)
    end if
  end subroutine find_shapes

  !> Triangles and tetrahedra, by barycentric coordinates.
  pure subroutine find_simplex_shapes(d, nodes, place, at)
    integer, intent(in) :: d, nodes
    real(dp), intent(in) :: place(3)
    type(shapes), intent(out) :: at
    real(dp) :: l(4), slope(3, 4)
    integer :: a, i, j, s

    l(1) = 1.0_dp - sum(place(:d))
    slope(:, 1) = -1.0_dp
    do a = 1, d
      l(a + 1) = place(a)
      slope(:, a + 1) = 0.0_dp
      slope(a, a + 1) = 1.0_dp
    end do
    do i = 1, d + 1
      at%value(i) = l(i)
      at%gradient(:, i) = slope(:, i)
      if (nodes == d + 1) cycle
      at%value(i) = l(i)*(2.0_dp*l(i) - 1.0_dp)
      at%gradient(:, i) = (4.0_dp*l(i) - 1.0_dp)*slope(:, i)
    end do
    do s = 1, nodes - (d + 1)
      i = SIMPLEX_SIDE(1, s)
      j = SIMPLEX_SIDE(2, s)
      at%value(d + 1 + s) = 4.0_dp*l(i)*l(j)
      at%gradient(:, d + 1 + s) = 4.0_dp*(l(i)*slope(:, j) + l(j)*slope(:, i))
    end do
  end subroutine find_simplex_shapes

  !> Quadrangles and hexahedra: products of linear functions; with nodes on the sides those of the serendipity family.
  pure subroutine find_box_shapes(d, nodes, place, at)
    integer, intent(in) :: d, nodes
    real(dp), intent(in) :: place(3)
    type(shapes), intent(out) :: at
    real(dp) :: factor(3), slope(3), product_of(3), total, x(3)
    integer :: a, b, i

    do i = 1, nodes
      x = 0.0_dp
      if (i <= 2**d) then
        x(:d) = CORNER(:d, i)
      else
        x(:d) = 0.5_dp*(CORNER(:d, SIDE(1, i - 2**d)) + CORNER(:d, SIDE(2, i - 2**d)))
      end if
      do a = 1, d
        if (abs(x(a)) > 0.0_dp) then
          factor(a) = 0.5_dp*(1.0_dp + x(a)*place(a))
          slope(a) = 0.5_dp*x(a)
        else
          factor(a) = 1.0_dp - place(a)**2
          slope(a) = -2.0_dp*place(a)
        end if
      end do
      do a = 1, d
        product_of(a) = slope(a)
        do b = 1, d
          if (b /= a) product_of(a) = product_of(a)*factor(b)
        end do
      end do
      at%value(i) = product(factor(:d))
      at%gradient(:d, i) = product_of(:d)
      if (nodes == 2**d .or. i > 2**d) cycle
      total = dot_product(x(:d), place(:d)) - real(d - 1, dp)
      at%gradient(:d, i) = product_of(:d)*total + at%value(i)*x(:d)
      at%value(i) = at%value(i)*total
    end do
  end subroutine find_box_shapes

  !> Derivatives along the axes of space instead of those of the element; `volume` is the ratio of both volumes.
  pure subroutine to_lengths(x, at, volume)
    real(dp), intent(in) :: x(:, :)
    type(shapes), intent(inout) :: at
    real(dp), intent(out) :: volume
    real(dp) :: cofactor(3, 3), jacobian(3, 3)
    integer :: d, nodes

    d = size(x, 1)
    nodes = size(x, 2)
    jacobian = 0.0_dp
    jacobian(3, 3) = 1.0_dp
    jacobian(:d, :d) = matmul(x, transpose(at%gradient(:d, :nodes)))
    cofactor(:, 1) = cross(jacobian(:, 2), jacobian(:, 3))
    cofactor(:, 2) = cross(jacobian(:, 3), jacobian(:, 1))
    cofactor(:, 3) = cross(jacobian(:, 1), jacobian(:, 2))
    volume = dot_product(jacobian(:, 1), cofactor(:, 1))
    at%gradient(:d, :nodes) = matmul(cofactor(:d, :d), at%gradient(:d, :nodes))/volume
  end subroutine to_lengths

  pure function cross(a, b)
    real(dp), intent(in) :: a(3), b(3)
    real(dp) :: cross(3)

    cross = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
  end function cross

  !> Add what one point contributes: lambda div u div v + 2 mu e(u):e(v).
  pure subroutine add_point(d, nodes, at, lambda, mu, weight, k)
    integer, intent(in) :: d, nodes
    type(shapes), intent(in) :: at
    real(dp), intent(in) :: lambda, mu, weight
    real(dp), intent(inout) :: k(:, :)
    real(dp) :: along
    integer :: a, b, i, j, p, q

    do j = 1, nodes
      do i = 1, nodes
        along = dot_product(at%gradient(:d, i), at%gradient(:d, j))
        do b = 1, d
          q = d*(j - 1) + b
          do a = 1, d
            p = d*(i - 1) + a
            k(p, q) = k(p, q) + weight*(lambda*at%gradient(a, i)*at%gradient(b, j) &
                                        + mu*at%gradient(b, i)*at%gradient(a, j))
          end do
          p = d*(i - 1) + b
          k(p, q) = k(p, q) + weight*mu*along
        end do
      end do
    end do
  end subroutine add_point

  !> As `add_point` for a ring with the radius along x, whose circumference is strained by u_x/x.
  pure subroutine add_ring(x, at, lambda, mu, weight, k)
    real(dp), intent(in) :: x(:, :)
    type(shapes), intent(in) :: at
    real(dp), intent(in) :: lambda, mu, weight
    real(dp), intent(inout) :: k(:, :)
    real(dp) :: hoop(20), radius, ring
    integer :: a, i, j, nodes

    nodes = size(x, 2)
    radius = dot_product(x(1, :), at%value(:nodes))
    ring = 2.0_dp*PI*radius*weight
    hoop(:nodes) = at%value(:nodes)/radius
    call add_point(2, nodes, at, lambda, mu, ring, k)
    do j = 1, nodes
      do i = 1, nodes
        do a = 1, 2
          k(2*i - 1, 2*(j - 1) + a) = k(2*i - 1, 2*(j - 1) + a) + ring*lambda*hoop(i)*at%gradient(a, j)
          k(2*(i - 1) + a, 2*j - 1) = k(2*(i - 1) + a, 2*j - 1) + ring*lambda*at%gradient(a, i)*hoop(j)
        end do
        k(2*i - 1, 2*j - 1) = k(2*i - 1, 2*j - 1) + ring*(lambda + 2.0_dp*mu)*hoop(i)*hoop(j)
      end do
    end do
  end subroutine add_ring

end module elastic_elements
