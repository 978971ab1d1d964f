!> The proof of a solution: bounds of the error of every force, gap and motion.
module fuge_solution_proof
  use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_value
  use fuge_input_checks, only: is_finite_everywhere
  use fuge_kinds, only: dp
  use fuge_matrix_operator, only: fuge_dense_operator
  use fuge_number_text, only: text
  use fuge_operator_type, only: fuge_operator
  use fuge_problem_type, only: check_problem, fuge_problem, fuge_solution
  use fuge_proof_type, only: fuge_proof
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_CALL_ORDER, FUGE_ERR_NOT_FINITE, FUGE_ERR_SIZE, &
    FUGE_ERR_UNSUPPORTED, FUGE_WARN_NOT_PROVED
  implicit none
  private

  public :: fuge_prove

contains

  !> Bound the error of a `solution` of `problem` with `operator`, by theorems: rounding is included, and no bound is
  !> too low. doc/proof.md says what is proved, and how.
  !>
  !> `operator` with n points. A fuge_dense_operator: any problem, for the matrix whose lower triangle is the caller's;
  !> it takes a Cholesky factorisation of all points, which is a few solves from cold, and memory for three copies of
  !> the matrix. A half-plane or half-space on a grid: two products; one translation, free or prescribed, for the exact
  !> coefficients of the elements. `solution`: from a solve or from elsewhere, its force and gap (n), its motion (m). On
  !> return `proof` has a bound for each number. FUGE_WARN_NOT_PROVED: the message says why bounds are infinite. Status
  !> 0 with a message: all is bounded, but the states of some points are not proved. Errors, which leave `proof` as it
  !> was: those of the problem's checks; FUGE_ERR_CALL_ORDER for an operator that is not set; FUGE_ERR_SIZE;
  !> FUGE_ERR_NOT_FINITE; FUGE_ERR_UNSUPPORTED where ranks share the points; FUGE_ERR_MEMORY; those of the product.
  subroutine fuge_prove(operator, problem, solution, proof, info)
    use fuge_matrix_proof, only: prove_with_matrix
    use fuge_spectral_proof, only: prove_with_products
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(fuge_proof), intent(inout) :: proof
    type(fuge_info), intent(out) :: info
    type(fuge_proof) :: new
    integer :: m, n, stat

    call check(operator, problem, solution, info)
    if (info%failed()) return
    n = operator%points()
    m = problem%mode_count()
    allocate (new%force_bound(n), new%gap_bound(n), new%motion_bound(m), new%state_proved(n), stat=stat)
    call require_memory(stat, 'bounds of', n, 'points', info)
    if (stat /= 0) return
    new%force_bound = ieee_value(1.0_dp, ieee_positive_inf)
    new%gap_bound = new%force_bound
    new%motion_bound = ieee_value(1.0_dp, ieee_positive_inf)
    new%state_proved = .false.
    select type (operator)
    class is (fuge_dense_operator)
      call prove_with_matrix(operator%alpha, problem, solution, new, info)
    class default
      call prove_with_products(operator, problem, solution, new, info)
    end select
    if (info%failed()) return
    call keep_what_is_finite(new, info)
    call move_alloc(new%force_bound, proof%force_bound)
    call move_alloc(new%gap_bound, proof%gap_bound)
    call move_alloc(new%motion_bound, proof%motion_bound)
    call move_alloc(new%state_proved, proof%state_proved)
  end subroutine fuge_prove

  !> What is no number, or out of the range of numbers, is not bounded.
  subroutine keep_what_is_finite(proof, info)
    type(fuge_proof), intent(inout) :: proof
    type(fuge_info), intent(inout) :: info
    real(dp) :: infinity

    if (proof%is_bounded() .or. info%status == FUGE_WARN_NOT_PROVED) return
    infinity = ieee_value(1.0_dp, ieee_positive_inf)
    where (.not. proof%force_bound <= huge(1.0_dp)) proof%force_bound = infinity
    where (.not. proof%gap_bound <= huge(1.0_dp)) proof%gap_bound = infinity
    where (.not. proof%motion_bound <= huge(1.0_dp)) proof%motion_bound = infinity
    call report(info, FUGE_WARN_NOT_PROVED, 'some bounds are out of the range of double precision: choose other units')
  end subroutine keep_what_is_finite

  subroutine check(operator, problem, solution, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(fuge_info), intent(inout) :: info

    if (operator%points() < 1) then
      call report(info, FUGE_ERR_CALL_ORDER, 'the operator is not set: set it first')
      return
    end if
    associate (space => operator%ranks())
      if (associated(space%group)) call report(info, FUGE_ERR_UNSUPPORTED, 'ranks share the points of this operator: ' &
                                               //'a proof needs them in one process')
    end associate
    if (.not. info%failed()) call check_problem(problem, operator%points(), info)
    if (.not. info%failed()) call check_length(solution%force, operator%points(), 'force', info)
    if (.not. info%failed()) call check_length(solution%gap, operator%points(), 'gap', info)
    if (.not. info%failed()) call check_length(solution%motion, problem%mode_count(), 'motion', info)
  end subroutine check

  !> Refuse an array of the solution that is missing, or not of the length `expected`, or not finite.
  subroutine check_length(values, expected, name, info)
    real(dp), intent(in), allocatable :: values(:)
    integer, intent(in) :: expected
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info

    if (.not. allocated(values)) then
      call report(info, FUGE_ERR_SIZE, 'the '//name//' of the solution is not allocated: solve first')
    else if (size(values) /= expected) then
      call report(info, FUGE_ERR_SIZE, 'the '//name//' of the solution has '//text(size(values)) &
                  //' value(s): it needs '//text(expected))
    else if (.not. is_finite_everywhere(values)) then
      call report(info, FUGE_ERR_NOT_FINITE, 'the '//name//' of the solution is not finite: solve again')
    end if
  end subroutine check_length

end module fuge_solution_proof
