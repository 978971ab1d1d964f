!> Blocks of linear elastic finite elements, in the plane (plane strain) and in space: stiffness, surfaces, stresses.
!> Shape functions are found by inverting the matrix of monomials at the nodes, so that nothing is shared with fuge.
module mesh_blocks
  use fuge_kinds, only: dp
  use fuge_surface_mesh_type, only: fuge_surface_mesh
  implicit none
  private

  public :: block_stiffness, block_stress, face_nodes_of, make_block, stress_forces

  !> Elements with edges of 2 and 3 nodes, and faces of 4, 8, 3 and 6.
  integer, parameter, public :: QUAD_4 = 1, QUAD_8 = 2, HEXA_8 = 3, HEXA_20 = 4, TETRA_4 = 5, TETRA_10 = 6

  type, public :: elastic_block
    integer :: kind = 0
    real(dp) :: young = 1.0_dp, poisson = 0.3_dp
    !> Positions (dimensions, nodes), nodes of the elements.
    real(dp), allocatable :: x(:, :)
    integer, allocatable :: element(:, :)
    !> The surfaces at the ends of the last axis; all nodes have degrees of freedom.
    type(fuge_surface_mesh) :: top, bottom
  end type elastic_block

  integer, parameter :: CUBE(3, 8) = reshape([0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, &
                                                0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1], [3, 8])
  integer, parameter :: CUBE_SIDES(2, 12) = reshape([1, 2, 2, 3, 3, 4, 4, 1, 5, 6, 6, 7, &
                                                      7, 8, 8, 5, 1, 5, 2, 6, 3, 7, 4, 8], [2, 12])
  integer, parameter :: TETRA_SIDES(2, 6) = reshape([1, 2, 2, 3, 3, 1, 1, 4, 2, 4, 3, 4], [2, 6])
  integer, parameter :: ORDERS(3, 6) = reshape([1, 2, 3, 1, 3, 2, 2, 1, 3, 2, 3, 1, 3, 1, 2, 3, 2, 1], [3, 6])
  !> Points of Gauss' rule on (0, 1), exact for degree 7.
  real(dp), parameter :: GAUSS(4) = 0.5_dp + 0.5_dp*[-0.861136311594052575224_dp, -0.339981043584856264803_dp, &
                                                     0.339981043584856264803_dp, 0.861136311594052575224_dp]
  real(dp), parameter :: WEIGHT(4) = 0.5_dp*[0.347854845137453857373_dp, 0.652145154862546142627_dp, &
                                             0.652145154862546142627_dp, 0.347854845137453857373_dp]

contains

  !> A block of `count` elements (or cells of six tetrahedra) between `low` and `high`. Inner corners are moved by
  !> `skew` of an element, all nodes then turned by `turn`. Degrees of freedom follow `before`.
  subroutine make_block(kind, count, low, high, skew, turn, before, block)
    integer, intent(in) :: kind, count(:), before
    real(dp), intent(in) :: low(:), high(:), skew, turn(:, :)
    type(elastic_block), intent(out) :: block
    integer, allocatable :: number(:), corners(:, :), nodes(:)
    real(dp), allocatable :: x(:, :)
    integer :: cell, e, elements, k, part, total

    allocate (number(product(2*count + 1)), x(size(count), product(2*count + 1)))
    number = 0
    elements = product(count)*parts(kind)
    block%kind = kind
    e = 0
    total = 0
    do cell = 0, product(count) - 1
      do part = 1, parts(kind)
        call element_corners(kind, cell_place(cell, count), part, corners)
        call place_nodes(corners, sides_of(kind), count, low, high, skew, x, nodes)
        if (.not. allocated(block%element)) allocate (block%element(size(nodes), elements))
        e = e + 1
        do k = 1, size(nodes)
          if (number(nodes(k)) == 0) then
            total = total + 1
            number(nodes(k)) = total
          end if
          block%element(k, e) = number(nodes(k))
        end do
      end do
    end do
    allocate (block%x(size(count), total))
    do k = 1, size(number)
      if (number(k) > 0) block%x(:, number(k)) = matmul(turn, x(:, k))
    end do
    call make_surface(kind, count, number, .true., before, block%x, block%top)
    call make_surface(kind, count, number, .false., before, block%x, block%bottom)
  end subroutine make_block

  pure function parts(kind)
    integer, intent(in) :: kind
    integer :: parts

    parts = merge(6, 1, kind >= TETRA_4)
  end function parts

  !> Sides with middle nodes, by their corners.
  pure function sides_of(kind) result(sides)
    integer, intent(in) :: kind
    integer, allocatable :: sides(:, :)

    allocate (sides(2, 0))
    if (kind == QUAD_8) sides = CUBE_SIDES(:, :4)
    if (kind == HEXA_20) sides = CUBE_SIDES
    if (kind == TETRA_10) sides = TETRA_SIDES
  end function sides_of

  pure function cell_place(cell, count) result(place)
    integer, intent(in) :: cell, count(:)
    integer :: place(size(count)), k, rest

    rest = cell
    do k = 1, size(count)
      place(k) = modulo(rest, count(k))
      rest = rest/count(k)
    end do
  end function cell_place

  !> Corners of an element in whole steps of the grid. Tetrahedra follow the three axes in one of six orders.
  subroutine element_corners(kind, cell, part, corners)
    integer, intent(in) :: kind, cell(:), part
    integer, allocatable, intent(out) :: corners(:, :)
    integer :: k

    if (kind < TETRA_4) then
      allocate (corners(size(cell), 2**size(cell)))
      do k = 1, size(corners, 2)
        corners(:, k) = cell + CUBE(:size(cell), k)
      end do
    else
      allocate (corners(3, 4))
      corners(:, 1) = cell
      do k = 1, 3
        corners(:, k + 1) = corners(:, k)
        corners(ORDERS(k, part), k + 1) = corners(ORDERS(k, part), k + 1) + 1
      end do
    end if
  end subroutine element_corners

  !> Numbers, in the grid of half steps, and positions of corners and middles of sides.
  subroutine place_nodes(corners, sides, count, low, high, skew, x, nodes)
    integer, intent(in) :: corners(:, :), sides(:, :), count(:)
    real(dp), intent(in) :: low(:), high(:), skew
    real(dp), intent(inout) :: x(:, :)
    integer, allocatable, intent(out) :: nodes(:)
    integer :: k, n

    n = size(corners, 2)
    allocate (nodes(n + size(sides, 2)))
    do k = 1, n
      nodes(k) = grid_number(2*corners(:, k), count)
      x(:, nodes(k)) = corner_position(corners(:, k), count, low, high, skew)
    end do
    do k = 1, size(sides, 2)
      nodes(n + k) = grid_number(corners(:, sides(1, k)) + corners(:, sides(2, k)), count)
      x(:, nodes(n + k)) = 0.5_dp*(x(:, nodes(sides(1, k))) + x(:, nodes(sides(2, k))))
    end do
  end subroutine place_nodes

  pure function grid_number(half_steps, count) result(number)
    integer, intent(in) :: half_steps(:), count(:)
    integer :: number, k

    number = 0
    do k = size(count), 1, -1
      number = number*(2*count(k) + 1) + half_steps(k)
    end do
    number = number + 1
  end function grid_number

  !> Only the axes along the surface are skewed, and inner corners only.
  pure function corner_position(steps, count, low, high, skew) result(x)
    integer, intent(in) :: steps(:), count(:)
    real(dp), intent(in) :: low(:), high(:), skew
    real(dp) :: x(size(count)), wave
    integer :: d, k

    d = size(count)
    x = low + (high - low)*real(steps, dp)/real(count, dp)
    wave = 1.0_dp
    do k = 1, d - 1
      if (steps(k) == 0 .or. steps(k) == count(k)) wave = 0.0_dp
    end do
    do k = 1, d - 1
      x(k) = x(k) + skew*wave*(high(k) - low(k))/count(k)*sin(2.3_dp*k + 1.7_dp*sum(steps(:d - 1)) + 0.9_dp*steps(1))
    end do
  end function corner_position

  !> Faces at the upper or lower end of the last axis.
  subroutine make_surface(kind, count, number, upper, before, x, surface)
    integer, intent(in) :: kind, count(:), number(:), before
    logical, intent(in) :: upper
    real(dp), intent(in) :: x(:, :)
    type(fuge_surface_mesh), intent(out) :: surface
    integer :: cell, corners, d, f, k, last, part
    integer, allocatable :: at(:, :), nodes(:), paths(:, :)

    d = size(count)
    surface%node = x
    allocate (surface%dof(d, size(x, 2)))
    surface%dof = before + reshape([(k, k=1, size(x))], shape(x))
    if (d == 2) then
      paths = reshape([1, 2], [2, 1])
    else if (kind < TETRA_4) then
      paths = reshape([1, 2, 3, 4], [4, 1])
    else
      paths = reshape([1, 2, 3, 1, 3, 4], [3, 2])
    end if
    corners = size(paths, 1)
    last = merge(count(d), 0, upper)
    allocate (surface%face(merge(2, 1, size(sides_of(kind)) > 0)*corners - merge(1, 0, d == 2 .and. kind == QUAD_8), &
                           product(count(:d - 1))*size(paths, 2)))
    f = 0
    do cell = 0, product(count(:d - 1)) - 1
      do part = 1, size(paths, 2)
        nodes = paths(:, part)
        ! Counter-clockwise from outside; in the plane with the body to the left.
        if (upper .eqv. d == 2) nodes = nodes(corners:1:-1)
        allocate (at(d, corners))
        do k = 1, corners
          at(:d - 1, k) = cell_place(cell, count(:d - 1)) + CUBE(:d - 1, nodes(k))
          at(d, k) = last
        end do
        f = f + 1
        do k = 1, corners
          surface%face(k, f) = number(grid_number(2*at(:, k), count))
        end do
        do k = 1, size(surface%face, 1) - corners
          surface%face(corners + k, f) = number(grid_number(at(:, k) + at(:, modulo(k, corners) + 1), count))
        end do
        deallocate (at)
      end do
    end do
  end subroutine make_surface

  !> The nodes that faces of a surface name.
  function face_nodes_of(surface) result(nodes)
    type(fuge_surface_mesh), intent(in) :: surface
    integer, allocatable :: nodes(:)
    integer :: i

    nodes = pack([(i, i=1, size(surface%node, 2))], [(any(surface%face == i), i=1, size(surface%node, 2))])
  end function face_nodes_of

  !> Add the stiffness of a block whose degrees of freedom follow `before`.
  subroutine block_stiffness(block, before, stiffness)
    type(elastic_block), intent(in) :: block
    integer, intent(in) :: before
    real(dp), intent(inout) :: stiffness(:, :)
    real(dp), allocatable :: strain(:, :), points(:, :), weights(:)
    integer, allocatable :: dof(:)
    real(dp) :: volume
    integer :: e, p

    call quadrature(block%kind, points, weights)
    do e = 1, size(block%element, 2)
      dof = before + element_dof(block, e)
      do p = 1, size(weights)
        call strain_matrix(block, e, points(:, p), strain, volume)
        stiffness(dof, dof) = stiffness(dof, dof) &
                              + weights(p)*volume*matmul(transpose(strain), matmul(law(block), strain))
      end do
    end do
  end subroutine block_stiffness

  !> Nodal forces that balance a uniform stress (xx, yy, xy; xx, yy, zz, yz, xz, xy), for the degrees of freedom of the
  !> block.
  subroutine stress_forces(block, stress, force)
    type(elastic_block), intent(in) :: block
    real(dp), intent(in) :: stress(:)
    real(dp), allocatable, intent(out) :: force(:)
    real(dp), allocatable :: strain(:, :), points(:, :), weights(:)
    real(dp) :: volume
    integer :: e, p

    allocate (force(size(block%x)))
    force = 0.0_dp
    call quadrature(block%kind, points, weights)
    do e = 1, size(block%element, 2)
      do p = 1, size(weights)
        call strain_matrix(block, e, points(:, p), strain, volume)
        force(element_dof(block, e)) = force(element_dof(block, e)) + weights(p)*volume*matmul(stress, strain)
      end do
    end do
  end subroutine stress_forces

  !> Stresses at all points of the quadrature.
  subroutine block_stress(block, u, stress)
    type(elastic_block), intent(in) :: block
    real(dp), intent(in) :: u(:)
    real(dp), allocatable, intent(out) :: stress(:, :)
    real(dp), allocatable :: strain(:, :), points(:, :), weights(:)
    real(dp) :: volume
    integer :: e, p

    call quadrature(block%kind, points, weights)
    allocate (stress(merge(3, 6, size(block%x, 1) == 2), size(weights)*size(block%element, 2)))
    do e = 1, size(block%element, 2)
      do p = 1, size(weights)
        call strain_matrix(block, e, points(:, p), strain, volume)
        stress(:, size(weights)*(e - 1) + p) = matmul(law(block), matmul(strain, u(element_dof(block, e))))
      end do
    end do
  end subroutine block_stress

  pure function element_dof(block, e) result(dof)
    type(elastic_block), intent(in) :: block
    integer, intent(in) :: e
    integer :: dof(size(block%x, 1)*size(block%element, 1)), d, i, k

    d = size(block%x, 1)
    do k = 1, size(block%element, 1)
      dof(d*(k - 1) + 1:d*k) = d*(block%element(k, e) - 1) + [(i, i=1, d)]
    end do
  end function element_dof

  !> Hooke's law: 2 mu strain + lambda trace, with engineering shear strains.
  pure function law(block) result(matrix)
    type(elastic_block), intent(in) :: block
    real(dp), allocatable :: matrix(:, :)
    real(dp) :: lame, shear
    integer :: d, k

    d = size(block%x, 1)
    shear = block%young/(2*(1 + block%poisson))
    lame = block%young*block%poisson/((1 + block%poisson)*(1 - 2*block%poisson))
    allocate (matrix(merge(3, 6, d == 2), merge(3, 6, d == 2)))
    matrix = 0.0_dp
    matrix(:d, :d) = lame
    do k = 1, size(matrix, 1)
      matrix(k, k) = matrix(k, k) + merge(2*shear, shear, k <= d)
    end do
  end function law

  !> Points in the reference element, the unit cube or simplex.
  subroutine quadrature(kind, points, weights)
    integer, intent(in) :: kind
    real(dp), allocatable, intent(out) :: points(:, :), weights(:)
    integer :: d, i, j, k, n

    d = merge(2, 3, kind <= QUAD_8)
    allocate (points(d, 4**d), weights(4**d))
    n = 0
    do k = 1, merge(1, 4, d == 2)
      do j = 1, 4
        do i = 1, 4
          n = n + 1
          associate (a => GAUSS(i), b => GAUSS(j), c => GAUSS(k))
            if (d == 2) then
              points(:, n) = [a, b]
              weights(n) = WEIGHT(i)*WEIGHT(j)
            else if (kind < TETRA_4) then
              points(:, n) = [a, b, c]
              weights(n) = WEIGHT(i)*WEIGHT(j)*WEIGHT(k)
            else
              points(:, n) = [a*(1 - b), a*b*(1 - c), a*b*c]
              weights(n) = WEIGHT(i)*WEIGHT(j)*WEIGHT(k)*a**2*b
            end if
          end associate
        end do
      end do
    end do
  end subroutine quadrature

  !> B of an element at a reference place, and the volume per volume of the reference element.
  subroutine strain_matrix(block, e, place, strain, volume)
    type(elastic_block), intent(in) :: block
    integer, intent(in) :: e
    real(dp), intent(in) :: place(:)
    real(dp), allocatable, intent(out) :: strain(:, :)
    real(dp), intent(out) :: volume
    real(dp), allocatable :: slopes(:, :)
    real(dp) :: jacobian(size(place), size(place))
    integer :: d, k

    d = size(place)
    call find_gradients(block%kind, place, slopes)
    jacobian = matmul(block%x(:, block%element(:, e)), slopes)
    volume = abs(determinant(jacobian))
    slopes = matmul(slopes, inverse(jacobian))
    allocate (strain(merge(3, 6, d == 2), d*size(slopes, 1)))
    strain = 0.0_dp
    do k = 1, size(slopes, 1)
      associate (c => d*(k - 1))
        strain(1, c + 1) = slopes(k, 1)
        strain(2, c + 2) = slopes(k, 2)
        if (d == 2) then
          strain(3, c + 1:c + 2) = slopes(k, [2, 1])
        else
          strain(3, c + 3) = slopes(k, 3)
          strain(4, c + 2:c + 3) = slopes(k, [3, 2])
          strain(5, [c + 1, c + 3]) = slopes(k, [3, 1])
          strain(6, c + 1:c + 2) = slopes(k, [2, 1])
        end if
      end associate
    end do
  end subroutine strain_matrix

  !> Gradients of the shape functions: those of the monomials times the inverse of the monomials at the nodes.
  subroutine find_gradients(kind, place, slopes)
    integer, intent(in) :: kind
    real(dp), intent(in) :: place(:)
    real(dp), allocatable, intent(out) :: slopes(:, :)
    real(dp), allocatable :: values(:, :)
    integer, allocatable :: power(:, :)
    real(dp), allocatable :: nodes(:, :)
    integer :: axis, i, j, n

    call reference_nodes(kind, nodes)
    call powers_of(kind, power)
    n = size(nodes, 2)
    allocate (values(n, n), slopes(n, size(place)))
    do j = 1, n
      do i = 1, n
        values(i, j) = product(nodes(:, j)**power(:, i))
      end do
      do axis = 1, size(place)
        slopes(j, axis) = 0.0_dp
        if (power(axis, j) > 0) slopes(j, axis) = power(axis, j)*place(axis)**(power(axis, j) - 1) &
          *product(place**power(:, j), mask=[(i /= axis, i=1, size(place))])
      end do
    end do
    slopes = matmul(inverse(values), slopes)
  end subroutine find_gradients

  subroutine reference_nodes(kind, nodes)
    integer, intent(in) :: kind
    real(dp), allocatable, intent(out) :: nodes(:, :)
    integer, allocatable :: corners(:, :), sides(:, :)
    integer :: d, k, n

    d = merge(2, 3, kind <= QUAD_8)
    allocate (sides, source=sides_of(kind))
    if (kind < TETRA_4) then
      allocate (corners, source=CUBE(:d, :2**d))
    else
      allocate (corners, source=CUBE(:, [1, 2, 4, 5]))
    end if
    n = size(corners, 2)
    allocate (nodes(d, n + size(sides, 2)))
    nodes(:, :n) = real(corners, dp)
    do k = 1, size(sides, 2)
      nodes(:, n + k) = 0.5_dp*(nodes(:, sides(1, k)) + nodes(:, sides(2, k)))
    end do
  end subroutine reference_nodes

  !> Exponents of the monomials: for cubes those of serendipity elements.
  subroutine powers_of(kind, power)
    integer, intent(in) :: kind
    integer, allocatable, intent(out) :: power(:, :)
    integer :: d, here(3), k, most

    d = merge(2, 3, kind <= QUAD_8)
    most = merge(1, 2, any(kind == [QUAD_4, HEXA_8, TETRA_4]))
    allocate (power(d, 0))
    do k = 0, 3**d - 1
      here = [modulo(k, 3), modulo(k/3, 3), k/9]
      if (maxval(here) > most) cycle
      if (kind >= TETRA_4 .and. sum(here) > most) cycle
      if (count(here == 2) > 1) cycle
      power = reshape([power, here(:d)], [d, size(power, 2) + 1])
    end do
  end subroutine powers_of

  pure function determinant(a) result(value)
    real(dp), intent(in) :: a(:, :)
    real(dp) :: value

    if (size(a, 1) == 2) then
      value = a(1, 1)*a(2, 2) - a(1, 2)*a(2, 1)
    else
      value = a(1, 1)*(a(2, 2)*a(3, 3) - a(2, 3)*a(3, 2)) - a(1, 2)*(a(2, 1)*a(3, 3) - a(2, 3)*a(3, 1)) &
              + a(1, 3)*(a(2, 1)*a(3, 2) - a(2, 2)*a(3, 1))
    end if
  end function determinant

  !> By Gauss and Jordan, with row exchanges.
  pure function inverse(a) result(b)
    real(dp), intent(in) :: a(:, :)
    real(dp) :: b(size(a, 1), size(a, 1)), work(size(a, 1), 2*size(a, 1)), row(2*size(a, 1))
    integer :: k, n, p

    n = size(a, 1)
    work = 0.0_dp
    work(:, :n) = a
    do k = 1, n
      work(k, n + k) = 1.0_dp
    end do
    do k = 1, n
      p = k - 1 + maxloc(abs(work(k:, k)), 1)
      row = work(p, :)
      work(p, :) = work(k, :)
      work(k, :) = row/row(k)
      do p = 1, n
        if (p /= k) work(p, :) = work(p, :) - work(p, k)*work(k, :)
      end do
    end do
    b = work(:, n + 1:)
  end function inverse

end module mesh_blocks
