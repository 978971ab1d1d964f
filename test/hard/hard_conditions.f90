!> Random contact problems of a given condition number.
!>
!> alpha = Q D Q^T with three random reflections in Q and eigenvalues from 1 to the inverse of the condition number:
!> evenly spread, one small one, or half of them small.
module hard_conditions
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_kinds, only: dp
  use fuge_problem_type, only: fuge_problem
  use general_reference, only: draw
  implicit none
  private

  public :: random_problem

  !> One load; a tilt too; a tilt and play; a tilt about a point 1000 widths away; a prescribed approach.
  integer, parameter, public :: KINDS = 5
  character(len=20), parameter, public :: KIND_NAMES(KINDS) = [character(len=20) :: 'one load', 'tilt', &
    'tilt and play', 'tilt, far-away point', 'prescribed approach']

contains

  !> A problem of n points of this kind, made from an answer in which a third of the points is open; condition
  !> 10**decimals.
  subroutine random_problem(seed, n, kind, decimals, alpha, problem)
    integer(int64), intent(inout) :: seed
    integer, intent(in) :: n, kind, decimals
    real(dp), intent(out) :: alpha(n, n)
    type(fuge_problem), intent(out) :: problem
    real(dp) :: force(n), opening(n), choice(n), modes(n, 2), x(n)
    integer :: k

    call draw(seed, force)
    call draw(seed, opening)
    call draw(seed, choice)
    choice(:min(3, n)) = 1.0_dp
    where (choice < 0.3_dp)
      force = 0.0_dp
    else where
      opening = 0.0_dp
    end where
    call random_matrix(seed, decimals, alpha)
    x = [(real(k, dp)/real(n, dp), k=1, n)]
    modes(:, 1) = 1.0_dp
    modes(:, 2) = x - merge(1000.0_dp, 0.5_dp, kind == 4)
    if (kind == 3) then
      allocate (problem%gap_upper, source=spread(2.0_dp, 1, n))
      where (choice > 0.7_dp)
        force = -force
        opening = 2.0_dp
      end where
    end if
    select case (kind)
    case (1)
      allocate (problem%gap, source=opening - matmul(alpha, force) + 0.7_dp)
      allocate (problem%resultant, source=[sum(force)])
    case (5)
      allocate (problem%gap, source=opening - matmul(alpha, force) + 0.7_dp)
      allocate (problem%prescribed, source=[.true.])
      allocate (problem%motion, source=[0.7_dp])
    case default
      allocate (problem%modes, source=modes)
      allocate (problem%gap, source=opening - matmul(alpha, force) + matmul(modes, [0.3_dp, 0.7_dp]))
      allocate (problem%resultant, source=matmul(force, modes))
    end select
  end subroutine random_problem

  subroutine random_matrix(seed, decimals, alpha)
    integer(int64), intent(inout) :: seed
    integer, intent(in) :: decimals
    real(dp), intent(out) :: alpha(:, :)
    real(dp) :: v(size(alpha, 1)), small
    integer :: k, n

    n = size(alpha, 1)
    small = 10.0_dp**(-decimals)
    alpha = 0.0_dp
    do k = 1, n
      select case (mod(seed, 3_int64))
      case (0)
        alpha(k, k) = 10.0_dp**(-real(decimals*(k - 1), dp)/real(max(n - 1, 1), dp))
      case (1)
        alpha(k, k) = merge(small, 1.0_dp, k == n)
      case default
        alpha(k, k) = merge(small, 1.0_dp, 2*k > n)
      end select
    end do
    do k = 1, 3
      call draw(seed, v)
      v = (v - 0.5_dp)/sqrt(sum((v - 0.5_dp)**2))
      alpha = alpha - 2.0_dp*spread(v, 2, n)*spread(matmul(v, alpha), 1, n)
      alpha = alpha - 2.0_dp*spread(matmul(alpha, v), 2, n)*spread(v, 1, n)
    end do
    alpha = 0.5_dp*(alpha + transpose(alpha))
  end subroutine random_matrix

end module hard_conditions
