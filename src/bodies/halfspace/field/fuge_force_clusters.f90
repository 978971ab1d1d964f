!> Forces on rectangles in clusters, each of which is equivalent to forces on a grid of Chebyshev points for all points
!> that are far enough.
!>
!> Interpolating the influence of a point force on the Chebyshev points of the rectangle around a cluster gives these
!> forces: p x q of them conserve all moments of degrees below p in x and below q in y. They follow from the moments of
!> Chebyshev polynomials, which a cluster inherits from its halves without a loss. Source: L. Wang, R. Krasny and
!> S. Tlupova, A kernel-independent treecode based on barycentric Lagrange interpolation, Commun. Comput. Phys. 28,
!> 2020.
module fuge_force_clusters
  use fuge_constants, only: PI
  use fuge_gauss_legendre, only: gauss_rule
  use fuge_heap_sort, only: heap_sort
  use fuge_kinds, only: dp
  use fuge_pressed_area, only: pressed_area
  implicit none
  private

  public :: cluster_classes, new_force_clusters, place_cluster_forces, prepare_cluster, &
    set_single_cluster

  !> Classes of Chebyshev points along a side, from fine to coarse: their numbers, and the half sides from which on they
  !> are enough for errors below 3e-13 in the worst place.
  integer, parameter, public :: CLASSES = 8, FINEST = 24
  integer, parameter, public :: CLASS_POINTS(CLASSES) = [FINEST, 22, 20, 17, 14, 12, 10, 8]
  real(dp), parameter :: CLASS_DISTANCE(CLASSES) = &
    [2.77_dp, 3.13_dp, 3.64_dp, 4.9_dp, 7.46_dp, 11.1_dp, 19.3_dp, 43.7_dp]
  !> A cluster of at most LEAST loads is not divided.
  integer, parameter :: LEAST = 32
  !> Nodes of the Gauss rule that is exact for the polynomials of the finest grid.
  integer, parameter :: NODES = FINEST/2

  !> The forces on one grid of one cluster.
  type :: grid_forces
    real(dp), allocatable :: force(:, :)
  end type grid_forces

  !> All grids of a cluster, (class along x, along y), made when they are first needed.
  type :: cluster_grids
    type(grid_forces), allocatable :: of(:, :)
  end type cluster_grids

  !> Clusters in a binary tree: number k has the halves 2 k and 2 k + 1.
  type, public :: force_clusters
    !> Halvings, each of which halves all clusters, and clusters in all; without halvings there are no moments.
    integer :: levels = 0, count = 0
    !> The rectangle around cluster k: centre x, y, and half widths, (4, count).
    real(dp), allocatable :: box(:, :)
    !> Moments of T_i(x) T_j(y), (FINEST, FINEST, count).
    real(dp), allocatable :: moment(:, :, :)
    !> Grids, (count).
    type(cluster_grids), allocatable :: grids(:)
    !> Chebyshev points of each class, and the influence of T_k on the force at point i: (k, i, class).
    real(dp) :: point(FINEST, CLASSES) = 0.0_dp
    real(dp), allocatable :: share(:, :, :)
  end type force_clusters

contains

  !> Sort the loads into clusters and form their moments. `stat` as in an allocate statement.
  pure subroutine new_force_clusters(loads, clusters, stat)
    type(pressed_area), intent(inout) :: loads
    type(force_clusters), intent(out) :: clusters
    integer, intent(out) :: stat
    integer, allocatable :: order(:)
    real(dp), allocatable :: places(:, :)
    integer :: k, most

    most = loads%count
    do while (most > LEAST)
      most = (most + 1)/2
      clusters%levels = clusters%levels + 1
    end do
    clusters%count = 2**(clusters%levels + 1) - 1
    ! A few loads are never taken together.
    if (clusters%levels < 1) then
      call set_single_cluster(loads, clusters, stat)
      return
    end if
    allocate (order(loads%count), places(loads%count, 2), clusters%box(4, clusters%count), &
              clusters%moment(FINEST, FINEST, clusters%count), clusters%grids(clusters%count), &
              clusters%share(FINEST, FINEST, CLASSES), stat=stat)
    if (stat /= 0) return
    order = [(k, k=1, loads%count)]
    places(:, 1) = loads%x
    places(:, 2) = loads%y
    call sort_by_halves(places, clusters%levels, order)
    call loads%reorder(order, stat)
    if (stat /= 0) return
    call set_tables(clusters)
    call form_cluster(loads, clusters, 1, 1, loads%count)
  end subroutine new_force_clusters

  !> Reorder the indices `order` of `places` (n, 2) by halves, and these again, each time along the direction of the
  !> greatest extent.
  pure recursive subroutine sort_by_halves(places, levels, order)
    real(dp), intent(in) :: places(:, :)
    integer, intent(in) :: levels
    integer, intent(inout) :: order(:)
    real(dp) :: extent(2)
    integer :: k, middle

    if (levels < 1) return
    extent = [(maxval(places(order, k)) - minval(places(order, k)), k=1, 2)]
    call heap_sort(places(:, maxloc(extent, dim=1)), order)
    middle = (size(order) + 1)/2
    call sort_by_halves(places, levels - 1, order(:middle))
    call sort_by_halves(places, levels - 1, order(middle + 1:))
  end subroutine sort_by_halves

  !> One cluster of all loads, whose sums take these one by one. `stat` as in an allocate statement.
  pure subroutine set_single_cluster(loads, clusters, stat)
    type(pressed_area), intent(in) :: loads
    type(force_clusters), intent(out) :: clusters
    integer, intent(out) :: stat

    allocate (clusters%box(4, 1), stat=stat)
    if (stat /= 0) return
    clusters%count = 1
    clusters%box(:, 1) = loads%box_around(1, loads%count)
  end subroutine set_single_cluster

  !> Chebyshev points of the first kind, and the weights by which values of polynomials there become coefficients.
  pure subroutine set_tables(clusters)
    type(force_clusters), intent(inout) :: clusters
    real(dp) :: angle
    integer :: class, i, k, q

    clusters%share = 0.0_dp
    do class = 1, CLASSES
      q = CLASS_POINTS(class)
      do i = 1, q
        angle = PI*(real(i, dp) - 0.5_dp)/real(q, dp)
        clusters%point(i, class) = cos(angle)
        do k = 1, q
          clusters%share(k, i, class) = merge(1.0_dp, 2.0_dp, k == 1)*cos(real(k - 1, dp)*angle)/real(q, dp)
        end do
      end do
    end do
  end subroutine set_tables

  !> The rectangle and the moments of cluster `k`, loads `first` to `last`, and of its parts.
  pure recursive subroutine form_cluster(loads, clusters, k, first, last)
    type(pressed_area), intent(in) :: loads
    type(force_clusters), intent(inout) :: clusters
    integer, intent(in) :: k, first, last
    real(dp) :: low(2), high(2)
    integer :: middle, part

    if (2*k > clusters%count) then
      clusters%box(:, k) = loads%box_around(first, last)
      call add_load_moments(loads, first, last, clusters%box(:, k), clusters%moment(:, :, k))
      return
    end if
    middle = (first + last)/2
    call form_cluster(loads, clusters, 2*k, first, middle)
    call form_cluster(loads, clusters, 2*k + 1, middle + 1, last)
    associate (one => clusters%box(:, 2*k), other => clusters%box(:, 2*k + 1))
      low = min(one(:2) - one(3:), other(:2) - other(3:))
      high = max(one(:2) + one(3:), other(:2) + other(3:))
    end associate
    clusters%box(:, k) = [0.5_dp*(low + high), 0.5_dp*(high - low)]
    clusters%moment(:, :, k) = 0.0_dp
    do part = 2*k, 2*k + 1
      call add_part_moments(clusters, part, k)
    end do
  end subroutine form_cluster

  !> The moments of loads in a rectangle `box`.
  pure subroutine add_load_moments(loads, first, last, box, moment)
    type(pressed_area), intent(in) :: loads
    integer, intent(in) :: first, last
    real(dp), intent(in) :: box(4)
    real(dp), intent(out) :: moment(FINEST, FINEST)
    real(dp) :: node(NODES), weight(NODES), of_x(FINEST), of_y(FINEST), values(FINEST, NODES)
    integer :: j, k

    call gauss_rule(node, weight)
    node = 2.0_dp*node - 1.0_dp
    moment = 0.0_dp
    do k = first, last
      call find_polynomials((loads%x(k) - box(1) + loads%half_x(k)*node)/box(3), values)
      of_x = matmul(values, weight)
      call find_polynomials((loads%y(k) - box(2) + loads%half_y(k)*node)/box(4), values)
      of_y = matmul(values, weight)
      do j = 1, FINEST
        moment(:, j) = moment(:, j) + (loads%force(k)*of_y(j))*of_x
      end do
    end do
  end subroutine add_load_moments

  !> Add the moments of `part`, expressed in the polynomials of cluster `whole`.
  pure subroutine add_part_moments(clusters, part, whole)
    type(force_clusters), intent(inout) :: clusters
    integer, intent(in) :: part, whole
    real(dp) :: along_x(FINEST, FINEST), along_y(FINEST, FINEST)

    along_x = transfer_matrix(clusters, part, whole, 1)
    along_y = transfer_matrix(clusters, part, whole, 2)
    clusters%moment(:, :, whole) = clusters%moment(:, :, whole) &
                                   + matmul(along_x, matmul(clusters%moment(:, :, part), transpose(along_y)))
  end subroutine add_part_moments

  !> Coefficients of the whole's polynomials in those of the part, (whole, part), along `axis`.
  pure function transfer_matrix(clusters, part, whole, axis) result(matrix)
    type(force_clusters), intent(in) :: clusters
    integer, intent(in) :: part, whole, axis
    real(dp) :: matrix(FINEST, FINEST), values(FINEST, FINEST), centre, factor

    centre = (clusters%box(axis, part) - clusters%box(axis, whole))/clusters%box(axis + 2, whole)
    factor = clusters%box(axis + 2, part)/clusters%box(axis + 2, whole)
    call find_polynomials(centre + factor*clusters%point(:, 1), values)
    matrix = matmul(values, transpose(clusters%share(:, :, 1)))
  end function transfer_matrix

  !> Chebyshev polynomials of degree 0 .. FINEST - 1: (degree + 1, place).
  pure subroutine find_polynomials(t, values)
    real(dp), intent(in) :: t(:)
    real(dp), intent(out) :: values(:, :)
    integer :: i, k

    do i = 1, size(t)
      values(1, i) = 1.0_dp
      values(2, i) = t(i)
      do k = 3, FINEST
        values(k, i) = 2.0_dp*t(i)*values(k - 1, i) - values(k - 2, i)
      end do
    end do
  end subroutine find_polynomials

  !> The classes, along x and y, of the coarsest grid that stands for cluster `k` at a place; one is 0 if it is too near
  !> for all.
  pure function cluster_classes(clusters, k, place) result(size_class)
    type(force_clusters), intent(in) :: clusters
    integer, intent(in) :: k
    real(dp), intent(in) :: place(3)
    integer :: size_class(2)
    real(dp) :: middle(2), beside(2)

    size_class = 0
    if (clusters%levels < 1) return
    associate (half => clusters%box(3:, k))
      middle = abs(place(:2) - clusters%box(:2, k))
      beside = max(middle - half, 0.0_dp)
      size_class(1) = side_class(middle(1)**2 + beside(2)**2 + place(3)**2, half(1))
      size_class(2) = side_class(middle(2)**2 + beside(1)**2 + place(3)**2, half(2))
    end associate
  end function cluster_classes

  !> The class for a side of length 2 `half` at the distance whose square is `square`.
  pure function side_class(square, half) result(class)
    real(dp), intent(in) :: square, half
    integer :: class

    do class = CLASSES, 1, -1
      if (square >= (CLASS_DISTANCE(class)*half)**2) exit
    end do
  end function side_class

  !> Make the forces on a grid of cluster `k` if they are not there yet. `stat` as in an allocate statement.
  pure subroutine prepare_cluster(clusters, k, class, stat)
    type(force_clusters), intent(inout) :: clusters
    integer, intent(in) :: k, class(2)
    integer, intent(out) :: stat
    integer :: p, q

    stat = 0
    if (.not. allocated(clusters%grids(k)%of)) allocate (clusters%grids(k)%of(CLASSES, CLASSES), stat=stat)
    if (stat /= 0) return
    associate (grid => clusters%grids(k)%of(class(1), class(2)))
      if (allocated(grid%force)) return
      p = CLASS_POINTS(class(1))
      q = CLASS_POINTS(class(2))
      allocate (grid%force(p, q), stat=stat)
      if (stat /= 0) return
      grid%force = matmul(transpose(clusters%share(:p, :p, class(1))), &
                          matmul(clusters%moment(:p, :q, k), clusters%share(:q, :q, class(2))))
    end associate
  end subroutine prepare_cluster

  !> The forces on a grid of cluster `k` that `prepare_cluster` has made, and their places, counted from `origin`: close
  !> to the points that see them, so that clusters far from 0 lose no digits.
  pure subroutine place_cluster_forces(clusters, k, class, origin, x, y, force)
    type(force_clusters), intent(in) :: clusters
    integer, intent(in) :: k, class(2)
    real(dp), intent(in) :: origin(2)
    real(dp), intent(out) :: x(:), y(:), force(:)
    integer :: first, j, p

    p = CLASS_POINTS(class(1))
    do j = 1, CLASS_POINTS(class(2))
      first = p*(j - 1)
      x(first + 1:first + p) = (clusters%box(1, k) - origin(1)) + clusters%box(3, k)*clusters%point(:p, class(1))
      y(first + 1:first + p) = (clusters%box(2, k) - origin(2)) + clusters%box(4, k)*clusters%point(j, class(2))
      force(first + 1:first + p) = clusters%grids(k)%of(class(1), class(2))%force(:, j)
    end do
  end subroutine place_cluster_forces

end module fuge_force_clusters
