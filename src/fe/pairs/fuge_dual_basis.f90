!> Dual shape functions of a face: psi_A = sum over B of coefficient(A, B) N_B with
!>
!>     integral of psi_A N_B = integral of N_A if A = B, else 0
!>
!> over the part of the face that has an opposite (B. Wohlmuth: A mortar finite element method using dual spaces for the
!> Lagrange multiplier, SIAM Journal on Numerical Analysis 38, 2000; over the part: M. Cichosz, M. Bischoff, Computer
!> Methods in Applied Mechanics and Engineering 200, 2011). Their sum is 1, as that of the N_B.
module fuge_dual_basis
  use fuge_kinds, only: dp
  implicit none
  private

  public :: dual_coefficients

  !> Below this pivot the mass matrix, scaled to a diagonal of ones, is singular to rounding.
  real(dp), parameter :: SMALLEST_PIVOT = 1.0e-10_dp

contains

  !> The coefficients, (n, n), from the integrals of N_A N_B, `mass` (n, n), and of N_A, `area` (n).
  !>
  !> `dual` is false, and the coefficients are those of N_A itself, where the part of the face is so small or slender
  !> that one of them would be above `largest`: dual functions extrapolate to nodes beyond the part, and grow without
  !> limit.
  pure subroutine dual_coefficients(mass, area, largest, coefficient, dual)
    real(dp), intent(in) :: mass(:, :), area(:), largest
    real(dp), intent(out) :: coefficient(:, :)
    logical, intent(out) :: dual
    real(dp) :: factor(size(area), size(area)), scale(size(area))
    integer :: k

    coefficient = 0.0_dp
    do k = 1, size(area)
      coefficient(k, k) = 1.0_dp
      scale(k) = sqrt(max(mass(k, k), 0.0_dp))
    end do
    call factorise(mass, scale, factor, dual)
    dual = dual .and. minval(area) > 0.0_dp
    if (.not. dual) return
    do k = 1, size(area)
      coefficient(k, :) = 0.0_dp
      coefficient(k, k) = area(k)/scale(k)
      call solve(factor, coefficient(k, :))
      coefficient(k, :) = coefficient(k, :)/scale
    end do
    dual = maxval(abs(coefficient)) <= largest
    if (dual) return
    coefficient = 0.0_dp
    do k = 1, size(area)
      coefficient(k, k) = 1.0_dp
    end do
  end subroutine dual_coefficients

  !> Cholesky's factor of the scaled mass matrix.
  pure subroutine factorise(mass, scale, factor, regular)
    real(dp), intent(in) :: mass(:, :), scale(:)
    real(dp), intent(out) :: factor(:, :)
    logical, intent(out) :: regular
    integer :: i, j

    factor = 0.0_dp
    regular = minval(scale) > 0.0_dp
    do j = 1, size(scale)
      if (.not. regular) return
      factor(j, j) = 1.0_dp - sum(factor(j, :j - 1)**2)
      regular = factor(j, j) > SMALLEST_PIVOT
      if (.not. regular) return
      factor(j, j) = sqrt(factor(j, j))
      do i = j + 1, size(scale)
        factor(i, j) = (mass(i, j)/scale(i)/scale(j) - dot_product(factor(i, :j - 1), factor(j, :j - 1)))/factor(j, j)
      end do
    end do
  end subroutine factorise

  pure subroutine solve(factor, x)
    real(dp), intent(in) :: factor(:, :)
    real(dp), intent(inout) :: x(:)
    integer :: k

    do k = 1, size(x)
      x(k) = (x(k) - dot_product(factor(k, :k - 1), x(:k - 1)))/factor(k, k)
    end do
    do k = size(x), 1, -1
      x(k) = (x(k) - dot_product(factor(k + 1:, k), x(k + 1:)))/factor(k, k)
    end do
  end subroutine solve

end module fuge_dual_basis
