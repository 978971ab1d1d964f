!> Roots of one, by which transforms multiply, to rounding.
module fuge_unit_roots
  use fuge_constants, only: PI
  use fuge_kinds, only: dp
  implicit none
  private

  public :: quarter_root, root_of_one

contains

  !> Real and imaginary parts of exp(-2 pi i k/n), 0 <= k < n, from the angle to the nearest axis: a large angle is
  !> rounded by more.
  pure function root_of_one(k, n) result(root)
    integer, intent(in) :: k, n
    real(dp) :: root(2)
    real(dp) :: angle, quarters
    integer :: axis

    quarters = 4.0_dp*(real(k, dp)/real(n, dp))
    axis = int(quarters + 0.5_dp)
    angle = 0.5_dp*PI*((4.0_dp*real(k, dp) - real(axis, dp)*real(n, dp))/real(n, dp))
    select case (modulo(axis, 4))
    case (0)
      root = [cos(angle), -sin(angle)]
    case (1)
      root = [-sin(angle), -cos(angle)]
    case (2)
      root = [-cos(angle), sin(angle)]
    case default
      root = [sin(angle), cos(angle)]
    end select
  end function root_of_one

  !> Real and imaginary parts of exp(-i pi k/(2 n)), 0 <= k <= n.
  pure function quarter_root(k, n) result(root)
    integer, intent(in) :: k, n
    real(dp) :: root(2)
    real(dp) :: angle

    angle = 0.5_dp*PI*(real(min(k, n - k), dp)/real(n, dp))
    root = [cos(angle), -sin(angle)]
    if (k > n - k) root = [sin(angle), -cos(angle)]
  end function quarter_root

end module fuge_unit_roots
