!> The mean of 1/r over rings about one axis, at every distance.
!>
!> The mean of 1/r over a circle of radius s from a point at the distance t from its axis is one over the
!> arithmetic-geometric mean of s + t and |s - t| (C. F. Gauss). Rings well apart integrate it by Gauss-Legendre
!> quadrature: all terms are positive, and the distance of two points is a sum of positive terms too, so that no digit
!> is lost however thin or far the rings are. Rings close to each other have a closed form, `fuge_ring_potential`.
module fuge_ring_kernel
  use fuge_gauss_legendre, only: gauss_rules
  use fuge_kinds, only: dp
  use fuge_ring_potential, only: near_ring_mean, near_ring_value
  implicit none
  private

  public :: new_ring_kernel, ring_mean, ring_value

  !> Nodes along the radius at most, and the relative error of the quadrature.
  integer, parameter :: MOST_NODES = 12
  real(dp), parameter :: ERROR = 3.0e-17_dp
  !> Two numbers with a smaller relative difference have the same means up to rounding.
  real(dp), parameter :: CLOSE = 1.0e-8_dp

  !> Quadrature rules of 1 to MOST_NODES nodes.
  type, public :: ring_kernel
    private
    real(dp) :: node(MOST_NODES, MOST_NODES) = 0.0_dp, weight(MOST_NODES, MOST_NODES) = 0.0_dp
    !> Closest reach for which a rule of n nodes suffices, see `nodes_for`.
    real(dp) :: reach(MOST_NODES) = 0.0_dp
  end type ring_kernel

contains

  pure function new_ring_kernel() result(kernel)
    type(ring_kernel) :: kernel
    integer :: n

    call gauss_rules(kernel%node, kernel%weight)
    do n = 1, MOST_NODES
      ! The error falls like (x + sqrt(x**2 - 1))**(-2 n), x the distance of the singularity from the middle of the
      ! ring in half widths.
      kernel%reach(n) = cosh(-log(ERROR)/real(2*n, dp))
    end do
  end function new_ring_kernel

  !> Nodes for a ring of this `width` whose rim is `distance` > 0 away from the closest pressure, length; 0 if the
  !> closed form is needed.
  pure function nodes_for(kernel, width, distance) result(nodes)
    type(ring_kernel), intent(in) :: kernel
    real(dp), intent(in) :: width, distance
    integer :: nodes
    integer :: n

    nodes = 0
    do n = MOST_NODES, 1, -1
      if (width + 2.0_dp*distance < kernel%reach(n)*width) return
      nodes = n
    end do
  end function nodes_for

  !> The mean of 1/r over two rings; 1 over length.
  !>
  !> `first`, `second` (2): inner and outer radius, length. The rings do not overlap, or are the same.
  pure function ring_mean(kernel, first, second) result(mean)
    type(ring_kernel), intent(in) :: kernel
    real(dp), intent(in) :: first(2), second(2)
    real(dp) :: mean
    real(dp) :: inner(2), outer(2), distance
    integer :: n, m

    inner = merge(first, second, first(2) <= second(2))
    outer = merge(second, first, first(2) <= second(2))
    distance = outer(1) - inner(2)
    n = 0
    m = 0
    if (distance > 0.0_dp) then
      n = nodes_for(kernel, inner(2) - inner(1), distance)
      m = nodes_for(kernel, outer(2) - outer(1), distance)
    end if
    if (n > 0 .and. m > 0) then
      mean = far_mean(inner, outer, kernel%node(:n, n), kernel%weight(:n, n), kernel%node(:m, m), kernel%weight(:m, m))
    else
      mean = near_ring_mean(inner, outer)
    end if
  end function ring_mean

  !> The mean by quadrature; `inner` (2) lies within `outer` (2), with a distance between them.
  pure function far_mean(inner, outer, inner_node, inner_weight, outer_node, outer_weight) result(mean)
    real(dp), intent(in) :: inner(2), outer(2), inner_node(:), inner_weight(:), outer_node(:), outer_weight(:)
    real(dp) :: mean
    ! Of fixed size, because arrays whose size varies are allocated.
    real(dp), dimension(MOST_NODES**2) :: large, geometric, weight
    real(dp), dimension(MOST_NODES) :: depth, r, share
    real(dp) :: height, s, distance
    integer :: k, first, n, all_nodes

    n = size(inner_node)
    all_nodes = n*size(outer_node)
    distance = outer(1) - inner(2)
    depth(:n) = (inner(2) - inner(1))*inner_node
    r(:n) = inner(2) - depth(:n)
    share(:n) = r(:n)*inner_weight
    do k = 1, size(outer_node)
      first = (k - 1)*n
      height = (outer(2) - outer(1))*outer_node(k)
      s = outer(1) + height
      large(first + 1:first + n) = s
      geometric(first + 1:first + n) = sqrt((s + r(:n))*(height + distance + depth(:n)))
      weight(first + 1:first + n) = (s*outer_weight(k))*share(:n)
    end do
    call reduce_means(large(:all_nodes), geometric(:all_nodes))
    mean = sum(weight(:all_nodes)/large(:all_nodes))/(0.25_dp*(inner(1) + inner(2))*(outer(1) + outer(2)))
  end function far_mean

  !> The arithmetic-geometric means of `arithmetic` and `geometric` > 0, in place of the first.
  pure subroutine reduce_means(arithmetic, geometric)
    real(dp), intent(inout), contiguous :: arithmetic(:), geometric(:)
    real(dp) :: middle
    integer :: k
    logical :: last

    do
      last = all(abs(arithmetic - geometric) <= CLOSE*arithmetic)
      do k = 1, size(arithmetic)
        middle = 0.5_dp*(arithmetic(k) + geometric(k))
        geometric(k) = sqrt(arithmetic(k)*geometric(k))
        arithmetic(k) = middle
      end do
      if (last) exit
    end do
  end subroutine reduce_means

  !> The mean of 1/r over the ring `loaded` (2) from a point at `place` >= 0 from its axis; 1 over length.
  pure function ring_value(kernel, place, loaded) result(mean)
    type(ring_kernel), intent(in) :: kernel
    real(dp), intent(in) :: place, loaded(2)
    real(dp) :: mean
    real(dp), dimension(MOST_NODES) :: large, geometric, weight, depth, r
    real(dp) :: distance
    integer :: n

    distance = max(place - loaded(2), loaded(1) - place)
    n = 0
    if (distance > 0.0_dp) n = nodes_for(kernel, loaded(2) - loaded(1), distance)
    if (n == 0) then
      mean = near_ring_value(place, loaded)
      return
    end if
    depth(:n) = (loaded(2) - loaded(1))*kernel%node(:n, n)
    if (place > loaded(2)) then
      r(:n) = loaded(2) - depth(:n)
    else
      r(:n) = loaded(1) + depth(:n)
    end if
    weight(:n) = r(:n)*kernel%weight(:n, n)
    large(:n) = max(r(:n), place)
    geometric(:n) = sqrt((r(:n) + place)*(distance + depth(:n)))
    call reduce_means(large(:n), geometric(:n))
    mean = sum(weight(:n)/large(:n))/(0.5_dp*(loaded(1) + loaded(2)))
  end function ring_value

end module fuge_ring_kernel
