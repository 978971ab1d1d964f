!> What tests of proofs by products share.
module proof_expectations
  use fuge_kinds, only: dp
  use fuge_matrix_operator, only: fuge_dense_operator
  use fuge_number_text, only: text
  use fuge_operator_type, only: fuge_operator
  use fuge_options_type, only: fuge_options
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_proof_type, only: fuge_proof
  use fuge_solution_proof, only: fuge_prove
  use fuge_solver_type, only: fuge_solver
  use fuge_status, only: fuge_info, FUGE_DONE
  use general_reference, only: solve_general
  implicit none
  private

  public :: bumpy_bowl, unproved

  integer, parameter :: REPORT_LENGTH = 400

contains

  !> The gaps of a wave that touches in places, over a bowl.
  pure function bumpy_bowl(n) result(gap)
    integer, intent(in) :: n
    real(dp) :: gap(n)
    integer :: k

    gap = [(0.3_dp*(real(2*k - n - 1, dp)/real(n, dp))**2 + 0.02_dp*cos(1.3_dp*real(k, dp)), k=1, n)]
  end function bumpy_bowl

  !> Solve by products, prove the solution, and compare it with the proved solution with the matrix `alpha`: what is not
  !> as expected, else blank. No bound may be too low, nor further from the numbers than 1e-4 of the largest force.
  function unproved(operator, alpha, problem) result(fault)
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    character(len=REPORT_LENGTH) :: fault
    type(fuge_dense_operator) :: matrix
    type(fuge_solver) :: solver
    type(fuge_solution) :: exact, solution
    type(fuge_proof) :: of_matrix, proof
    type(fuge_info) :: info
    real(dp), allocatable, target :: copy(:, :)
    real(dp) :: forces, lengths

    call solver%solve(operator, problem, solution, info, fuge_options(tolerance=1.0e-8_dp))
    fault = 'products: '//trim(info%message)
    if (info%failed()) return
    call fuge_prove(operator, problem, solution, proof, info)
    fault = text(info%products)//' products of the proof: '//trim(info%message)
    if (info%status /= FUGE_DONE .or. info%products /= 2 .or. .not. proof%is_bounded()) return
    allocate (copy, source=alpha)
    call solve_general(copy, problem, exact, info)
    fault = 'matrix: '//trim(info%message)
    if (info%failed()) return
    call matrix%set(copy, info)
    call fuge_prove(matrix, problem, exact, of_matrix, info)
    fault = 'proof with the matrix: '//trim(info%message)
    if (info%status /= FUGE_DONE) return
    fault = ''
    ! The matrix is rounded, which changes the solution by less than these.
    forces = 1.0e-12_dp*maxval(abs(exact%force))
    lengths = 1.0e-12_dp*maxval(abs(exact%gap))
    if (.not. all(abs(solution%force - exact%force) <= proof%force_bound + of_matrix%force_bound + forces)) &
      fault = trim(fault)//' a force;'
    if (.not. all(abs(solution%gap - exact%gap) <= proof%gap_bound + of_matrix%gap_bound + lengths)) &
      fault = trim(fault)//' a gap;'
    if (.not. all(abs(solution%motion - exact%motion) <= proof%motion_bound + of_matrix%motion_bound + lengths)) &
      fault = trim(fault)//' the motion;'
    if (.not. maxval(proof%force_bound) < 1.0e8_dp*forces) fault = trim(fault)//' a bound of ' &
                                                                   //text(maxval(proof%force_bound))
    ! States that are proved are those of the exact solution.
    if (any(solution%state /= exact%state .and. proof%state_proved)) fault = trim(fault)//' a state;'
    if (count(proof%state_proved) <= size(exact%state)/2) fault = trim(fault)//' only ' &
                                                                  //text(count(proof%state_proved)) &
                                                                  //' states;'
  end function unproved

end module proof_expectations
