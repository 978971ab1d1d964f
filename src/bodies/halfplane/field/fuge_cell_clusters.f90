!> Clusters of cells in a binary tree, each of which acts from afar like a few point forces.
!>
!> The field of a cluster at a distance is that of forces at the Chebyshev nodes of its interval, whose sizes are the
!> integrals of the pressure times the Lagrange polynomials of these nodes: the kernels are interpolated (W. Fong, E.
!> Darve, J. Comput. Phys. 228, 2009, section 2). They hardly change over a cluster that is seen from far away, so that
!> zz is as accurate relative to the sum of its terms as the plain sum is, however close to the surface; xx and xz,
!> which change their sign or vanish straight below a force, are so relative to the largest stress. For displacements
!> the sum over the nodes is that of the Chebyshev series of the logarithm, with fewer operations.
module fuge_cell_clusters
  use fuge_constants, only: PI
  use fuge_gauss_legendre, only: gauss_rule
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  !> Nodes of a cluster, and the distance from its middle, in half lengths, from which on they suffice.
  integer, parameter :: ORDER = 28
  real(dp), parameter :: SEPARATION = 2.5_dp
  !> Nodes in each half of a cell for the integrals over its pressure, even: exact for the polynomials; and enough for
  !> cells that are NARROW times as long as their cluster, because a point far from it is still farther from them.
  integer, parameter :: FULL = ORDER/2 + 2, SHORT = 8
  real(dp), parameter :: NARROW = 0.25_dp
  !> Partial sums, so that compilers vectorise them.
  integer, parameter :: LANES = 4
  !> Cells in a leaf of the tree, at most.
  integer, parameter :: LEAF_CELLS = 16

  type, public :: cell_clusters
    !> 0 until `build`.
    integer :: number = 0
    !> First and last cell of each cluster; the first of its two children, which follow each other, 0 for a leaf.
    integer, allocatable :: first(:), last(:), child(:)
    !> Middle and half length of its interval; its forces at the nodes, and its moments with T_0, T_1, ..
    real(dp), allocatable :: middle(:), half_length(:), force(:, :), moment(:, :)
    !> The nodes on -1 .. 1, and T_0, T_1, .. at each of them. Their rounding has to be as small as that: the sum of the
    !> forces is exact only as far as those of the polynomials vanish.
    real(dp) :: node(ORDER) = 0.0_dp
    real(dp), allocatable :: polynomial(:, :)
  contains
    procedure :: build
    procedure :: fill
    procedure :: is_far
    procedure :: add_stress
    procedure :: add_displacement
  end type cell_clusters

contains

  !> Divide cells, ordered by their centres, into clusters, halving their number down to a few. FUGE_ERR_MEMORY.
  !>
  !> Each cell extends `reach` times its width to both sides of its `centre`.
  pure subroutine build(self, centre, width, reach, info)
    class(cell_clusters), intent(inout) :: self
    real(dp), intent(in) :: centre(:), width(:), reach
    type(fuge_info), intent(inout) :: info
    integer :: k, most, stat

    most = 2
    do while (most*(LEAF_CELLS/2) < size(centre))
      most = 2*most
    end do
    allocate (self%first(most), self%last(most), self%child(most), self%middle(most), self%half_length(most), &
              self%force(ORDER, most), self%moment(0:ORDER - 1, most), &
              self%polynomial(ORDER, 0:ORDER - 1), stat=stat)
    call require_memory(stat, 'clusters of', size(centre), 'cells', info)
    if (stat /= 0) return
    call set_nodes(self%node, self%polynomial)
    self%number = 1
    self%first(1) = 1
    self%last(1) = size(centre)
    k = 0
    do while (k < self%number)
      k = k + 1
      call divide(self, k)
    end do
    do k = self%number, 1, -1
      call enclose(self, k, centre, width, reach)
    end do
  end subroutine build

  !> The interval of a cluster: around its cells, or its children, which come later.
  pure subroutine enclose(self, k, centre, width, reach)
    type(cell_clusters), intent(inout) :: self
    integer, intent(in) :: k
    real(dp), intent(in) :: centre(:), width(:), reach
    real(dp) :: lower, upper

    if (self%child(k) == 0) then
      associate (from => self%first(k), to => self%last(k))
        lower = minval(centre(from:to) - reach*width(from:to))
        upper = maxval(centre(from:to) + reach*width(from:to))
      end associate
    else
      associate (from => self%child(k), to => self%child(k) + 1)
        lower = minval(self%middle(from:to) - self%half_length(from:to))
        upper = maxval(self%middle(from:to) + self%half_length(from:to))
      end associate
    end if
    self%half_length(k) = 0.5_dp*(upper - lower)
    self%middle(k) = lower + self%half_length(k)
  end subroutine enclose

  !> The nodes and the polynomials there.
  pure subroutine set_nodes(node, polynomial)
    real(dp), intent(out) :: node(:), polynomial(:, 0:)
    integer :: degree, j, turn

    do j = 1, ORDER
      do degree = 0, ORDER - 1
        ! The angle in units of pi/(2 ORDER), in -2 ORDER .. 2 ORDER.
        turn = modulo(degree*(2*ORDER + 1 - 2*j) + 2*ORDER, 4*ORDER) - 2*ORDER
        polynomial(j, degree) = sin(0.5_dp*PI*real(ORDER - abs(turn), dp)/real(ORDER, dp))
      end do
    end do
    node = polynomial(:, 1)
  end subroutine set_nodes

  !> Give a cluster of many cells two children.
  pure subroutine divide(self, k)
    type(cell_clusters), intent(inout) :: self
    integer, intent(in) :: k
    integer :: half

    self%child(k) = 0
    if (self%last(k) - self%first(k) < LEAF_CELLS) return
    half = (self%first(k) + self%last(k))/2
    self%child(k) = self%number + 1
    self%first(self%number + 1:self%number + 2) = [self%first(k), half + 1]
    self%last(self%number + 1:self%number + 2) = [half, self%last(k)]
    self%number = self%number + 2
  end subroutine divide

  !> Set the forces and moments, from the last leaf up to the whole, for cells with a force `pressure` `width` each:
  !> hats, which fall linearly from the centre to nothing over the `width` on both sides, or strips.
  pure subroutine fill(self, centre, width, pressure, hats)
    class(cell_clusters), intent(inout) :: self
    real(dp), intent(in) :: centre(:), width(:), pressure(:)
    logical, intent(in) :: hats
    real(dp) :: node(2*FULL, 2), weight(2*FULL, 2)
    real(dp) :: points(max(2*FULL*LEAF_CELLS, 2*ORDER)), shares(max(2*FULL*LEAF_CELLS, 2*ORDER)), scaled_width
    integer :: child, j, k, n, number, rule

    call cell_quadrature(hats, node(:2*SHORT, 1), weight(:2*SHORT, 1))
    call cell_quadrature(hats, node(:, 2), weight(:, 2))
    do k = self%number, 1, -1
      n = 0
      if (self%child(k) == 0) then
        do j = self%first(k), self%last(k)
          scaled_width = width(j)/self%half_length(k)
          rule = merge(1, 2, scaled_width < NARROW)
          number = merge(2*SHORT, 2*FULL, scaled_width < NARROW)
          points(n + 1:n + number) = (centre(j) - self%middle(k))/self%half_length(k) &
                                     + scaled_width*node(:number, rule)
          shares(n + 1:n + number) = pressure(j)*width(j)*weight(:number, rule)
          n = n + number
        end do
      else
        do child = self%child(k), self%child(k) + 1
          points(n + 1:n + ORDER) = (self%middle(child) - self%middle(k))/self%half_length(k) &
                                    + self%half_length(child)/self%half_length(k)*self%node
          shares(n + 1:n + ORDER) = self%force(:, child)
          n = n + ORDER
        end do
      end if
      call find_moments(n, points, shares, self%moment(:, k))
      call find_forces(self%polynomial, self%moment(:, k), self%force(:, k))
    end do
  end subroutine fill

  !> Nodes, in widths from the centre, and weights of a quadrature over the pressure of a cell with a unit force.
  pure subroutine cell_quadrature(hat, node, weight)
    logical, intent(in) :: hat
    real(dp), intent(out) :: node(:), weight(:)
    integer :: half

    half = size(node)/2
    call gauss_rule(node(half + 1:), weight(half + 1:))
    if (hat) then
      weight(half + 1:) = weight(half + 1:)*(1.0_dp - node(half + 1:))
    else
      weight(half + 1:) = 0.5_dp*weight(half + 1:)
      node(half + 1:) = 0.5_dp*node(half + 1:)
    end if
    node(:half) = -node(half + 1:)
    weight(:half) = weight(half + 1:)
  end subroutine cell_quadrature

  !> The sums of force T_k(point), k = 0, 1, ..; n is a multiple of LANES.
  pure subroutine find_moments(n, point, force, moment)
    integer, intent(in) :: n
    real(dp), intent(in) :: point(n), force(n)
    real(dp), intent(out) :: moment(0:ORDER - 1)
    real(dp) :: now(n), before(n), next, sums(LANES)
    integer :: j, k, lane

    before = point*force
    now = force
    do k = 0, ORDER - 1
      sums = 0.0_dp
      do j = 0, n - LANES, LANES
        do lane = 1, LANES
          sums(lane) = sums(lane) + now(j + lane)
          next = 2.0_dp*point(j + lane)*now(j + lane) - before(j + lane)
          before(j + lane) = now(j + lane)
          now(j + lane) = next
        end do
      end do
      moment(k) = sum(sums)
    end do
  end subroutine find_moments

  !> The forces at the nodes from the moments: a Lagrange polynomial is a sum of products of T_0, T_1, ..
  pure subroutine find_forces(polynomial, moment, force)
    real(dp), intent(in) :: polynomial(ORDER, 0:ORDER - 1), moment(0:ORDER - 1)
    real(dp), intent(out) :: force(ORDER)
    integer :: k

    force = moment(0)
    do k = 1, ORDER - 1
      force = force + 2.0_dp*moment(k)*polynomial(:, k)
    end do
    force = force/real(ORDER, dp)
  end subroutine find_forces

  !> May cluster k be replaced by its forces, seen from a point?
  pure function is_far(self, k, px, pz) result(far)
    class(cell_clusters), intent(in) :: self
    integer, intent(in) :: k
    real(dp), intent(in) :: px, pz
    logical :: far

    far = (px - self%middle(k))**2 + pz**2 >= (SEPARATION*self%half_length(k))**2
  end function is_far

  !> Add -pi times the stresses xx, zz and xz under the forces of cluster k.
  pure subroutine add_stress(self, k, px, pz, total)
    class(cell_clusters), intent(in) :: self
    integer, intent(in) :: k
    real(dp), intent(in) :: px, pz
    real(dp), intent(inout) :: total(3)

    call add_point_forces(self%force(:, k), self%node, self%half_length(k), px - self%middle(k), pz, total)
  end subroutine add_stress

  pure subroutine add_point_forces(force, node, half_length, distance, z, total)
    real(dp), intent(in) :: force(ORDER), node(ORDER), half_length, distance, z
    real(dp), intent(inout) :: total(3)
    real(dp), dimension(LANES) :: sum_xx, sum_zz, sum_xz
    real(dp) :: across, along, inverse
    integer :: j, lane

    sum_xx = 0.0_dp
    sum_zz = 0.0_dp
    sum_xz = 0.0_dp
    do j = 0, ORDER - LANES, LANES
      do lane = 1, LANES
        along = distance - half_length*node(j + lane)
        inverse = 1.0_dp/(along**2 + z**2)
        along = along*inverse
        across = z*inverse
        sum_xx(lane) = sum_xx(lane) + force(j + lane)*along**2
        sum_zz(lane) = sum_zz(lane) + force(j + lane)*across**2
        sum_xz(lane) = sum_xz(lane) + force(j + lane)*(along*across)
      end do
    end do
    total = total + 2.0_dp*z*[sum(sum_xx), sum(sum_zz), sum(sum_xz)]
  end subroutine add_point_forces

  !> Add the sums of ln(r), z**2/r**2, x z/r**2 and atan(x/z) over the forces of cluster k.
  !>
  !> On -1 .. 1 and with omega = tau - sqrt(tau**2 - 1), |omega| < 1, ln(tau - t) is -ln(2 omega) - 2 sum_k omega**k
  !> T_k(t)/k, and its derivative (1 + 2 sum_k omega**k T_k(t))/sqrt(tau**2 - 1).
  pure subroutine add_displacement(self, k, px, pz, total)
    class(cell_clusters), intent(in) :: self
    integer, intent(in) :: k
    real(dp), intent(in) :: px, pz
    real(dp), intent(inout) :: total(4)
    complex(dp) :: tau, root, omega, potential, slope
    real(dp) :: z
    integer :: j

    z = pz/self%half_length(k)
    tau = cmplx((px - self%middle(k))/self%half_length(k), z, dp)
    root = tau*sqrt(1.0_dp - (1.0_dp/tau)**2)
    omega = 1.0_dp/(tau + root)
    potential = 0.0_dp
    slope = 0.0_dp
    do j = ORDER - 1, 1, -1
      potential = omega*(potential + self%moment(j, k)/real(j, dp))
      slope = omega*(slope + self%moment(j, k))
    end do
    slope = (self%moment(0, k) + 2.0_dp*slope)/root
    potential = 2.0_dp*potential
    total(1) = total(1) + self%moment(0, k)*log(self%half_length(k)/(2.0_dp*abs(omega))) - real(potential, dp)
    total(2) = total(2) - z*aimag(slope)
    total(3) = total(3) + z*real(slope, dp)
    total(4) = total(4) + self%moment(0, k)*atan2(real(omega, dp), -aimag(omega)) + aimag(potential)
  end subroutine add_displacement

end module fuge_cell_clusters
