!> Roots of one, by which transforms multiply, to rounding.
module fuge_unit_roots
  use fuge_constants, only: PI
  use fuge_kinds, only: dp
  implicit none
  private

  public :: fill_roots, quarter_root, root_of_one

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

  !> Real and imaginary parts of exp(-2 pi i k/n), k = 0, 1, .. < n, (2, :): many, each the product of two.
  pure subroutine fill_roots(n, roots)
    integer, intent(in) :: n
    real(dp), intent(inout), contiguous :: roots(:, 0:)
    integer, parameter :: BLOCK = 64
    real(dp) :: far(2), near(2, 0:BLOCK - 1)
    integer :: first, k

    do k = 0, min(BLOCK, n) - 1
      near(:, k) = root_of_one(k, n)
    end do
    do first = 0, ubound(roots, 2), BLOCK
      far = root_of_one(first, n)
      do k = 0, min(BLOCK - 1, ubound(roots, 2) - first)
        roots(1, first + k) = far(1)*near(1, k) - far(2)*near(2, k)
        roots(2, first + k) = far(1)*near(2, k) + far(2)*near(1, k)
      end do
    end do
  end subroutine fill_roots

end module fuge_unit_roots
