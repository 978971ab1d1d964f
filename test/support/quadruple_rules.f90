!> Gauss-Legendre quadrature in quadruple precision.
module quadruple_rules
  use, intrinsic :: iso_fortran_env, only: qp => real128
  implicit none
  private

  public :: gauss_quadruple

contains

  !> Nodes on (-1, 1) and weights, whose sum is 2; both have the same size.
  pure subroutine gauss_quadruple(node, weight)
    real(qp), intent(out) :: node(:), weight(:)
    real(qp) :: x, p(0:size(node)), slope
    integer :: i, k, n, sweep

    n = size(node)
    do i = 1, n
      x = cos(acos(-1.0_qp)*(real(i, qp) - 0.25_qp)/(real(n, qp) + 0.5_qp))
      do sweep = 1, 12
        p(0) = 1.0_qp
        p(1) = x
        do k = 2, n
          p(k) = (real(2*k - 1, qp)*x*p(k - 1) - real(k - 1, qp)*p(k - 2))/real(k, qp)
        end do
        slope = real(n, qp)*(x*p(n) - p(n - 1))/(x**2 - 1.0_qp)
        x = x - p(n)/slope
      end do
      node(i) = x
      weight(i) = 2.0_qp/((1.0_qp - x**2)*slope**2)
    end do
  end subroutine gauss_quadruple

end module quadruple_rules
