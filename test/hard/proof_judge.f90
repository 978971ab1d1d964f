!> Bounds of proofs beside true errors, over random problems with exact answers and over answers in quadruple precision.
module proof_judge
  use, intrinsic :: iso_fortran_env, only: int64, qp => real128
  use fuge_heap_sort, only: heap_sort
  use fuge_kinds, only: dp
  use fuge_matrix_operator, only: fuge_dense_operator
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_proof_type, only: fuge_proof
  use fuge_solution_proof, only: fuge_prove
  use fuge_status, only: fuge_info
  use general_reference, only: solve_general
  use hard_conditions, only: random_problem
  use law_oracle, only: refine_law
  use whole_number_problems, only: draw_whole_problem, whole_problem
  implicit none
  private

  public :: judge_random_proofs, judge_whole_proofs, median_of, prove_answer

  !> Problems are counted by the decimal exponent of their condition number, 17 for all from there on.
  integer, parameter, public :: MOST_DECIMALS = 17
  !> A true error counts as at least this fraction of the largest force: a half unit in the last place.
  real(dp), parameter :: ROUNDING = 2.0_dp**(-54)

  type, public :: proof_counts
    !> Answers; those of which all is bounded, and all states are proved.
    integer :: answers = 0, bounded = 0, proved = 0
    !> Answers with a bound below the true error.
    integer :: too_low = 0
    !> The largest bound of a force, over its true error, of each bounded answer with forces, and how many they are.
    real(dp), allocatable :: ratio(:)
    integer :: ratios = 0
  end type proof_counts

contains

  !> Prove a solution with the matrix `alpha`. `excess`: is the exact `answer` beyond a bound?
  subroutine prove_answer(alpha, problem, solution, answer, proof, excess)
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution, answer
    type(fuge_proof), intent(inout) :: proof
    logical, intent(out) :: excess
    type(fuge_dense_operator) :: operator
    type(fuge_info) :: info
    real(dp), allocatable, target :: copy(:, :)

    allocate (copy, source=alpha)
    call operator%set(copy, info)
    call fuge_prove(operator, problem, solution, proof, info)
    ! A difference is rounded to a number that is not above the bound unless it is itself.
    excess = info%failed()
    if (excess) return
    excess = any(abs(solution%force - answer%force) > proof%force_bound) &
             .or. any(abs(solution%gap - answer%gap) > proof%gap_bound) &
             .or. any(abs(solution%motion - answer%motion) > proof%motion_bound)
  end subroutine prove_answer

  !> Judge the problems `first` to `last`, with ties or without. Only those whose answer is the only one are in
  !> `counts`; the others must not have finite bounds that are wrong.
  subroutine judge_whole_proofs(first, last, ties, counts)
    integer, intent(in) :: first, last
    logical, intent(in) :: ties
    type(proof_counts), intent(inout) :: counts(0:)
    type(whole_problem) :: whole
    type(fuge_solution) :: solution
    type(fuge_proof) :: proof
    type(fuge_info) :: info
    logical :: excess
    integer :: number

    do number = first, last
      call draw_whole_problem(number, ties, whole)
      call solve_general(whole%alpha, whole%problem, solution, info)
      if (info%failed()) cycle
      call prove_answer(whole%alpha, whole%problem, solution, whole%answer, proof, excess)
      associate (count => counts(min(int(log10(whole%condition)), MOST_DECIMALS)))
        if (excess) count%too_low = count%too_low + 1
        if (whole%is_held) call count_proof(solution, maxval(abs(solution%force - whole%answer%force)), proof, count)
      end associate
    end do
  end subroutine judge_whole_proofs

  !> Count a proof of forces that are off by `error`.
  subroutine count_proof(solution, error, proof, counts)
    type(fuge_solution), intent(in) :: solution
    real(dp), intent(in) :: error
    type(fuge_proof), intent(in) :: proof
    type(proof_counts), intent(inout) :: counts
    real(dp) :: least

    counts%answers = counts%answers + 1
    if (.not. proof%is_bounded()) return
    counts%bounded = counts%bounded + 1
    if (all(proof%state_proved)) counts%proved = counts%proved + 1
    least = ROUNDING*maxval(abs(solution%force))
    if (.not. least > 0.0_dp) return
    if (.not. allocated(counts%ratio)) allocate (counts%ratio(64))
    if (counts%ratios == size(counts%ratio)) counts%ratio = [counts%ratio, counts%ratio]
    counts%ratios = counts%ratios + 1
    counts%ratio(counts%ratios) = maxval(proof%force_bound)/max(error, least)
  end subroutine count_proof

  !> Judge `trials` problems of 3 to 30 points of a kind and a condition, 10**decimals, in quadruple precision.
  subroutine judge_random_proofs(kind, decimals, trials, counts)
    integer, intent(in) :: kind, decimals, trials
    type(proof_counts), intent(inout) :: counts
    type(fuge_problem) :: problem
    type(fuge_solution) :: solution
    type(fuge_proof) :: proof
    type(fuge_info) :: info
    real(dp), allocatable :: alpha(:, :)
    real(qp), allocatable :: exact(:)
    integer(int64) :: seed
    logical :: excess, found
    integer :: n, trial

    seed = 1000_int64*kind + decimals
    do trial = 1, trials
      n = 3 + mod(7*trial, 28)
      allocate (alpha(n, n), exact(n))
      call random_problem(seed, n, kind, decimals, alpha, problem)
      call solve_general(alpha, problem, solution, info)
      found = .not. info%failed()
      if (found) call refine_law(alpha, problem, solution, exact, found)
      if (found) then
        call prove_answer(alpha, problem, solution, solution, proof, excess)
        if (any(abs(solution%force - exact) > proof%force_bound)) counts%too_low = counts%too_low + 1
        call count_proof(solution, real(maxval(abs(solution%force - exact)), dp), proof, counts)
      end if
      deallocate (alpha, exact)
    end do
  end subroutine judge_random_proofs

  !> The median of the ratios, 0 without any; and the one that is above `fraction` of all, if it is given.
  function median_of(counts, fraction) result(ratio)
    type(proof_counts), intent(in) :: counts
    real(dp), intent(in), optional :: fraction
    real(dp) :: ratio
    real(dp) :: part
    integer, allocatable :: order(:)
    integer :: k

    ratio = 0.0_dp
    if (counts%ratios < 1) return
    part = 0.5_dp
    if (present(fraction)) part = fraction
    order = [(k, k=1, counts%ratios)]
    call heap_sort(counts%ratio(:counts%ratios), order)
    ratio = counts%ratio(order(max(1, ceiling(part*real(counts%ratios, dp)))))
  end function median_of

end module proof_judge
