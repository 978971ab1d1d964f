!> Quadrature of means over two intervals: of a function of the distance between a point of one and a point of the other
!> one, which is smooth over a length near 0 and over its argument beyond.
module fuge_overlap_rule
  use fuge_gauss_legendre, only: gauss_rules
  use fuge_kinds, only: dp
  use fuge_smooth_panels, only: divide, nodes_needed, MOST_NODES, PANELS
  implicit none
  private

  !> Intervals that are shorter than this fraction of the length over which the function is smooth have three nodes.
  real(dp), parameter :: SHORT = 1.0_dp/60.0_dp

  !> Distances, and weights with the sum 1: the first `count` of them.
  type, public :: overlap_rule
    real(dp), allocatable :: node(:), weight(:)
    integer :: count = 0
    real(dp), private :: gauss_node(MOST_NODES, MOST_NODES), gauss_weight(MOST_NODES, MOST_NODES)
  contains
    procedure :: start
    procedure :: set
  end type overlap_rule

contains

  !> Compute the rules of Gauss and Legendre, and allocate room for all that `set` needs. `stat` as in an allocate
  !> statement.
  subroutine start(self, stat)
    class(overlap_rule), intent(inout) :: self
    integer, intent(out) :: stat

    call gauss_rules(self%gauss_node, self%gauss_weight)
    self%count = 0
    stat = 0
    if (.not. allocated(self%node)) then
      allocate (self%node(3*PANELS*MOST_NODES), self%weight(3*PANELS*MOST_NODES), stat=stat)
    end if
  end subroutine start

  !> Nodes d + s, and weights, for the mean over s = s_1 - s_2, of |s_1| <= `a`/2 and |s_2| <= `b`/2; `b` = 0: a point.
  !> The function is smooth over `smooth` and over its argument, whichever is longer.
  pure subroutine set(self, d, a, b, smooth)
    class(overlap_rule), intent(inout) :: self
    real(dp), intent(in) :: d, a, b, smooth
    real(dp) :: fourth, half, plateau, second

    self%count = 0
    half = 0.5_dp*(a + b)
    if (2.0_dp*half <= SHORT*max(smooth, abs(d) - half)) then
      ! Exact for polynomials of the fifth degree.
      second = (a**2 + b**2)/12.0_dp
      fourth = (a**4 + b**4)/80.0_dp + a**2*b**2/24.0_dp
      self%count = 3
      self%node(:3) = d + [-1.0_dp, 0.0_dp, 1.0_dp]*sqrt(fourth/second)
      self%weight(:3) = 0.5_dp*second**2/fourth
      self%weight(2) = 1.0_dp - second**2/fourth
      return
    end if
    plateau = 0.5_dp*abs(a - b)
    if (min(a, b) > 0.0_dp) then
      call add_piece(self, d, [-half, -plateau], -half, a*b, smooth)
      call add_piece(self, d, [plateau, half], half, a*b, smooth)
    end if
    ! Where the shorter interval is inside the longer one.
    if (plateau > 0.0_dp) call add_piece(self, d, [-plateau, plateau], 0.0_dp, max(a, b), smooth)
  end subroutine set

  !> Add the nodes for s in the interval `piece`, where the density of s is 1/`scale`, or with `zero` /= 0 |zero -
  !> s|/`scale`.
  pure subroutine add_piece(self, d, piece, zero, scale, smooth)
    class(overlap_rule), intent(inout) :: self
    real(dp), intent(in) :: d, piece(2), zero, scale, smooth
    real(dp) :: ends(2, PANELS), length, s
    integer :: count, j, k, nodes

    call divide(piece(1), piece(2), [-d], smooth, ends, count)
    do j = 1, count
      nodes = nodes_needed(ends(:, j), [-d], smooth)
      length = ends(2, j) - ends(1, j)
      do k = 1, nodes
        s = ends(1, j) + length*self%gauss_node(k, nodes)
        self%node(self%count + k) = d + s
        self%weight(self%count + k) = length*self%gauss_weight(k, nodes)/scale
        if (abs(zero) > 0.0_dp) self%weight(self%count + k) = self%weight(self%count + k)*abs(zero - s)
      end do
      self%count = self%count + nodes
    end do
  end subroutine add_piece

end module fuge_overlap_rule
