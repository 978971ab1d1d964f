!> How near to singular a factored stiffness is: its smallest eigenvalue after scaling to a unit
!> diagonal, by inverse iteration. The least pivot does not measure that: rounding errors
!> accumulate up to the last pivot, and a body eliminated from its free end has no small pivot.
module fuge_smallest_eigenvalue
  use fuge_kinds, only: dp
  use fuge_status, only: FUGE_DONE
  use fuge_stiffness_type, only: fuge_stiffness, stiffness_factor
  implicit none
  private

  public :: find_smallest_eigenvalue, unscale

  !> Steps of the inverse iteration.
  integer, parameter :: STEPS = 3

contains

  !> `quotient`: Rayleigh quotient y^T K y of the softest mode y relative to the magnitude of its
  !> terms, |y|^T |K| |y|; `place`: the degree of freedom that y moves most.
  !>
  !> `scale` (degrees): square root of the diagonal of K, zero where constrained. `status` is not
  !> zero without memory.
  subroutine find_smallest_eigenvalue(stiffness, factor, scale, quotient, place, status)
    class(fuge_stiffness), intent(in) :: stiffness
    class(stiffness_factor), intent(in) :: factor
    real(dp), intent(in) :: scale(:)
    real(dp), intent(out) :: quotient
    integer, intent(out) :: place, status
    real(dp), allocatable :: y(:, :), product(:), magnitude(:)
    integer :: j, step

    quotient = 1.0_dp
    place = 0
    allocate (y(size(scale), 1), product(size(scale)), magnitude(size(scale)), stat=status)
    if (status /= FUGE_DONE .or. .not. any(scale > 0.0_dp)) return
    ! Any start that is not orthogonal to the softest mode.
    do j = 1, size(scale)
      y(j, 1) = modulo(real(j, dp)*sqrt(2.0_dp), 1.0_dp) - 0.3_dp
    end do
    do step = 1, STEPS
      y(:, 1) = y(:, 1)*scale
      y = y/maxval(abs(y))
      call factor%solve(y, status)
      if (status /= FUGE_DONE) return
      y(:, 1) = y(:, 1)*scale
    end do
    y = y/maxval(abs(y))
    place = maxloc(abs(y(:, 1)), 1)
    call unscale(y(:, 1), scale)
    call stiffness%multiply(y(:, 1), product, magnitude)
    ! Both are sums over all degrees of freedom, but the constrained ones do not move.
    quotient = dot_product(y(:, 1), product)/dot_product(abs(y(:, 1)), magnitude)
  end subroutine find_smallest_eigenvalue

  !> Divide y (degrees) by the scale; y becomes zero where the scale is zero.
  pure subroutine unscale(y, scale)
    real(dp), intent(inout) :: y(:)
    real(dp), intent(in) :: scale(:)

    where (scale > 0.0_dp)
      y = y/scale
    else where
      y = 0.0_dp
    end where
  end subroutine unscale

end module fuge_smallest_eigenvalue
