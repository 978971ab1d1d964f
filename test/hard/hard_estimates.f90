!> Estimated errors of forces beside the true ones, over random problems.
module hard_estimates
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_kinds, only: dp
  use fuge_options_type, only: fuge_options, FUGE_ACTIVE_SET
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_status, only: fuge_info, FUGE_WARN_NOT_UNIQUE, FUGE_WARN_RESIDUAL
  use general_reference, only: solve_general
  use hard_conditions, only: random_problem
  use law_oracle, only: force_error_of
  implicit none
  private

  public :: judge_estimate, judge_problems

  !> Rounding of the forces themselves: smaller errors are not told apart.
  real(dp), parameter :: ROUNDING = 1.0e-16_dp
  !> The estimate above which a solve warns, and the error below which it had better not.
  real(dp), parameter :: WARNED = 1.0e-3_dp, RIGHT = 1.0e-4_dp

  !> How many estimates lie where, as multiples of the true error.
  type, public :: estimate_counts
    !> Answers without a warning of another kind, whose true error is known.
    integer :: answers = 0
    !> Below a thirtieth; below a third; up to three; up to a hundred; above.
    integer :: far_below = 0, below = 0, near = 0, above = 0, far_above = 0
    !> No warning although the error is above the limit; a warning although it is below a tenth of it.
    integer :: silent = 0, false_warnings = 0
    real(dp) :: largest_error = 0.0_dp
  end type estimate_counts

contains

  !> Count one answer of the engine `method`, by default the active set.
  subroutine judge_estimate(alpha, problem, counts, method)
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    type(estimate_counts), intent(inout) :: counts
    integer, intent(in), optional :: method
    type(fuge_solution) :: solution
    type(fuge_info) :: info
    real(dp) :: error, ratio
    integer :: engine

    engine = FUGE_ACTIVE_SET
    if (present(method)) engine = method
    call solve_general(alpha, problem, solution, info, fuge_options(engine))
    if (info%failed() .or. any(info%status == [FUGE_WARN_NOT_UNIQUE, FUGE_WARN_RESIDUAL])) return
    if (.not. any(abs(solution%force) > 0.0_dp)) return
    error = force_error_of(alpha, problem, solution)
    if (error < 0.0_dp) return
    counts%answers = counts%answers + 1
    counts%largest_error = max(counts%largest_error, error)
    ! Beyond 1 no digit is right, whatever the error.
    ratio = info%force_error/min(max(error, ROUNDING), 1.0_dp)
    if (ratio < 1.0_dp/30.0_dp) then
      counts%far_below = counts%far_below + 1
    else if (ratio < 1.0_dp/3.0_dp) then
      counts%below = counts%below + 1
    else if (ratio <= 3.0_dp) then
      counts%near = counts%near + 1
    else if (ratio <= 100.0_dp) then
      counts%above = counts%above + 1
    else
      counts%far_above = counts%far_above + 1
    end if
    if (info%force_error <= WARNED .and. error > WARNED) counts%silent = counts%silent + 1
    if (info%force_error > WARNED .and. error <= RIGHT) counts%false_warnings = counts%false_warnings + 1
  end subroutine judge_estimate

  !> Count the answers of the engine `method`, by default the active set, to `trials` random problems of 3 to 30 points.
  subroutine judge_problems(kind, decimals, trials, counts, method)
    integer, intent(in) :: kind, decimals, trials
    type(estimate_counts), intent(out) :: counts
    integer, intent(in), optional :: method
    type(fuge_problem) :: problem
    real(dp), allocatable :: alpha(:, :)
    integer(int64) :: seed
    integer :: n, trial

    seed = 1000_int64*kind + decimals
    do trial = 1, trials
      n = 3 + mod(7*trial, 28)
      allocate (alpha(n, n))
      call random_problem(seed, n, kind, decimals, alpha, problem)
      call judge_estimate(alpha, problem, counts, method)
      deallocate (alpha)
    end do
  end subroutine judge_problems

end module hard_estimates
