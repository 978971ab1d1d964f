!> Random contact problems that several tests share.
module random_problems
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_kinds, only: dp
  use fuge_problem_type, only: fuge_problem
  use general_reference, only: draw
  use influence_matrices, only: exponential_bed
  implicit none
  private

  public :: draw_soft_surface

contains

  !> A rough parabola on points at uneven distances of a soft surface, with `motions` modes 1, x, x**2 ..; `alpha`
  !> (points, points). Nothing else of the problem is set.
  subroutine draw_soft_surface(seed, motions, alpha, problem)
    integer(int64), intent(inout) :: seed
    integer, intent(in) :: motions
    real(dp), intent(out) :: alpha(:, :)
    type(fuge_problem), intent(inout) :: problem
    real(dp) :: x(size(alpha, 2))
    integer :: j

    call draw(seed, x)
    x = [(real(j, dp) + 0.3_dp*x(j), j=1, size(x))]/real(size(x), dp)
    alpha = exponential_bed(x, 4.0_dp)
    allocate (problem%gap(size(x)), problem%modes(size(x), motions))
    call draw(seed, problem%gap)
    problem%gap = 0.3_dp*problem%gap + 2.0_dp*(x - 0.5_dp)**2 - 0.2_dp
    do j = 1, motions
      problem%modes(:, j) = x**(j - 1)
    end do
  end subroutine draw_soft_surface

end module random_problems
