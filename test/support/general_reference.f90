!> What references of contact problems share: random numbers, elimination, the data of a problem with their defaults,
!> and short calls of the solver.
module general_reference
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_kinds, only: dp
  use fuge_matrix_operator, only: fuge_dense_operator
  use fuge_options_type, only: fuge_options
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_solver_type, only: fuge_solver
  use fuge_status, only: fuge_info
  use special_numbers, only: infinity
  implicit none
  private

  public :: draw, integers, solve_general, solve_with, eliminate
  public :: play_of, is_excluded, is_prescribed, modes_of

  !> A pivot below this fraction of the largest entry means that the system is singular.
  real(dp), parameter :: SINGULAR = 1.0e-10_dp

contains

  !> Random numbers, 0 < value < 1, of the minimal standard generator: the same with every compiler.
  pure subroutine draw(seed, values)
    integer(int64), intent(inout) :: seed
    real(dp), intent(out) :: values(:)
    integer :: k

    do k = 1, size(values)
      seed = mod(16807_int64*seed, 2147483647_int64)
      values(k) = real(seed, dp)/2147483647.0_dp
    end do
  end subroutine draw

  !> Random whole numbers from `low` to `high`.
  pure subroutine integers(seed, low, high, values)
    integer(int64), intent(inout) :: seed
    integer, intent(in) :: low, high
    real(dp), intent(out) :: values(:)

    call draw(seed, values)
    values = real(low, dp) + aint(values*real(high - low + 1, dp))
  end subroutine integers

  !> Solve with a new solver.
  subroutine solve_general(alpha, problem, solution, info, options)
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(out) :: solution
    type(fuge_info), intent(out) :: info
    type(fuge_options), intent(in), optional :: options
    type(fuge_solver) :: solver

    call solve_with(solver, alpha, problem, solution, info, options)
  end subroutine solve_general

  !> Solve with a solver that may have solved other problems before.
  subroutine solve_with(solver, alpha, problem, solution, info, options)
    type(fuge_solver), intent(inout) :: solver
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(out) :: solution
    type(fuge_info), intent(out) :: info
    type(fuge_options), intent(in), optional :: options
    type(fuge_dense_operator) :: operator
    real(dp), allocatable, target :: matrix(:, :)

    ! The operator points to the matrix.
    allocate (matrix, source=alpha)
    call operator%set(matrix, info)
    if (info%failed()) return
    call solver%solve(operator, problem, solution, info, options)
  end subroutine solve_with

  !> The distance between the two stops of a point, infinite where it is one-sided.
  pure function play_of(problem, point) result(play)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: point
    real(dp) :: play

    play = infinity()
    if (allocated(problem%gap_upper)) play = problem%gap_upper(point)
  end function play_of

  pure function is_excluded(problem, point) result(excluded)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: point
    logical :: excluded

    excluded = .false.
    if (allocated(problem%excluded)) excluded = problem%excluded(point)
  end function is_excluded

  pure function is_prescribed(problem, mode) result(prescribed)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: mode
    logical :: prescribed

    prescribed = .false.
    if (allocated(problem%prescribed)) prescribed = problem%prescribed(mode)
  end function is_prescribed

  !> The modes R, (n, m).
  pure function modes_of(problem) result(modes)
    type(fuge_problem), intent(in) :: problem
    real(dp) :: modes(problem%points(), problem%mode_count())

    modes = 1.0_dp
    if (allocated(problem%modes)) modes = problem%modes
  end function modes_of

  !> Solve by Gauss-Jordan elimination with row interchanges; x is zero if the matrix is not `regular`.
  pure subroutine eliminate(matrix, right, x, regular)
    real(dp), intent(in) :: matrix(:, :), right(:)
    real(dp), intent(out) :: x(:)
    logical, intent(out) :: regular
    real(dp) :: work(size(right), size(right) + 1), row(size(right) + 1), largest
    integer :: i, k, p, n

    n = size(right)
    work(:, :n) = matrix
    work(:, n + 1) = right
    largest = maxval(abs(matrix))
    x = 0.0_dp
    do k = 1, n
      p = k - 1 + maxloc(abs(work(k:, k)), dim=1)
      regular = abs(work(p, k)) > SINGULAR*largest
      if (.not. regular) return
      row = work(p, :)
      work(p, :) = work(k, :)
      work(k, :) = row/row(k)
      do i = 1, n
        if (i /= k) work(i, :) = work(i, :) - work(i, k)*work(k, :)
      end do
    end do
    x = work(:, n + 1)
    regular = .true.
  end subroutine eliminate

end module general_reference
