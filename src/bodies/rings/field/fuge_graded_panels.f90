!> Gauss-Legendre quadrature on panels that shrink towards a point where the integrand is singular, or nearly so.
!>
!> The integrands are analytic but for a point at the distance `height` beside the line of integration. An n-point rule
!> on a panel has an error like rho**(-2 n), where rho + 1/rho is the sum of the distances of the singularity from the
!> ends of the panel over half of its length (Bernstein's ellipse; L. N. Trefethen, Approximation Theory and
!> Approximation Practice, 2013, chapter 19). So the panels grow in proportion to this distance, and the number of nodes
!> is only as large as it needs to be.
module fuge_graded_panels
  use fuge_gauss_legendre, only: gauss_rules
  use fuge_kinds, only: dp
  implicit none
  private

  public :: new_panel_rules, next_panel

  !> Nodes for a singularity, at most; for a smooth factor of the integrand, at most; and together.
  integer, parameter :: SINGULAR_NODES = 19
  integer, parameter, public :: SMOOTH_NODES = 12, MOST_NODES = SINGULAR_NODES + SMOOTH_NODES
  !> The relative error of the quadrature, but for a factor that is large for strong singularities.
  real(dp), parameter :: ERROR = 1.0e-20_dp

  !> Rules of 1 to MOST_NODES nodes on (0, 1); allocated, because the stack of a thread may be small.
  type, public :: panel_rules
    real(dp), allocatable :: node(:, :), weight(:, :)
    !> For a rule of n nodes: the least sum of the distances of the singularity from the ends, over the length.
    real(dp) :: reach(SINGULAR_NODES) = 0.0_dp
  end type panel_rules

contains

  pure function new_panel_rules() result(rules)
    type(panel_rules) :: rules
    integer :: n

    allocate (rules%node(MOST_NODES, MOST_NODES), rules%weight(MOST_NODES, MOST_NODES), source=0.0_dp)
    call gauss_rules(rules%node, rules%weight)
    do n = 1, SINGULAR_NODES
      rules%reach(n) = cosh(-log(ERROR)/real(2*n, dp))
    end do
  end function new_panel_rules

  !> The panel from `left` >= 0 outwards, on a line of integration from 0 to `length` > `left`.
  !>
  !> The singularity lies beside the point -`distance` <= 0 of this line, at `height` >= 0 from it; not both are 0.
  !> Out: the end of the panel, `right`, and how many `nodes` it needs.
  pure subroutine next_panel(rules, left, length, distance, height, right, nodes)
    type(panel_rules), intent(in) :: rules
    real(dp), intent(in) :: left, length, distance, height
    real(dp), intent(out) :: right
    integer, intent(out) :: nodes
    real(dp) :: near, far, least

    near = hypot(distance + left, height)
    far = hypot(distance + length, height)
    right = length
    least = rules%reach(SINGULAR_NODES)
    if (near + far < least*(length - left)) then
      ! The longest panel for which SINGULAR_NODES nodes suffice.
      right = left + 2.0_dp*((distance + left) + least*near)/((least - 1.0_dp)*(least + 1.0_dp))
      ! No sliver is left, whose nodes might fall on the end.
      if (length - right < 0.5_dp*(right - left)) right = 0.5_dp*(left + length)
      nodes = SINGULAR_NODES
      return
    end if
    do nodes = 1, SINGULAR_NODES - 1
      if (near + far >= rules%reach(nodes)*(length - left)) return
    end do
  end subroutine next_panel

end module fuge_graded_panels
