!> The public interface of the component core: contact problems, their operators and solvers.
module fuge_core
  use fuge_adjoint_solution, only: fuge_solve_adjoint
  use fuge_case_envelope, only: fuge_envelope, fuge_find_envelope
  use fuge_cases_solution, only: fuge_solve_cases
  use fuge_certificate, only: fuge_residual, fuge_violation
  use fuge_contact_path, only: fuge_follow_path, fuge_load_path
  use fuge_contact_states, only: FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, FUGE_LIMITED_LOWER, FUGE_LIMITED_UPPER, &
    FUGE_OPEN
  use fuge_gradients_type, only: fuge_gradients
  use fuge_history_type, only: fuge_history
  use fuge_kinds, only: fuge_dp
  use fuge_load_cases_type, only: fuge_case_solutions, fuge_load_cases
  use fuge_matrix_operator, only: fuge_dense_operator
  use fuge_monitor_type, only: fuge_monitor
  use fuge_operator_type, only: fuge_operator
  use fuge_options_type, only: fuge_options, FUGE_AUTO, FUGE_TABLEAU, FUGE_ACTIVE_SET, FUGE_ITERATIVE, &
    FUGE_PAPER_RULE, FUGE_MOST_NEGATIVE, FUGE_GREATEST_DECREASE
  use fuge_path_type, only: fuge_path
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_proof_type, only: fuge_proof
  use fuge_solution_proof, only: fuge_prove
  use fuge_solver_type, only: fuge_solver, fuge_solve_dense
  use fuge_status, only: fuge_info, fuge_status_text, FUGE_MESSAGE_LENGTH, FUGE_DONE, FUGE_WARN_RESIDUAL, &
    FUGE_WARN_NOT_UNIQUE, FUGE_WARN_ILL_CONDITIONED, FUGE_WARN_PAIRS, FUGE_WARN_NO_CONTACT, FUGE_WARN_CASES, &
    FUGE_WARN_NOT_PROVED, FUGE_WARN_KINK, FUGE_WARN_UNREACHABLE, FUGE_WARN_ACCURACY, &
    FUGE_ERR_SIZE, FUGE_ERR_POINTER, FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH, FUGE_ERR_MODULUS, FUGE_ERR_ELEMENT, &
    FUGE_ERR_GRID, FUGE_ERR_NOT_SYMMETRIC, FUGE_ERR_NOT_DEFINITE, FUGE_ERR_NO_EQUILIBRIUM, FUGE_ERR_ITERATION_LIMIT, &
    FUGE_ERR_MEMORY, FUGE_ERR_CALL_ORDER, FUGE_ERR_OPTION, FUGE_ERR_UNSUPPORTED, FUGE_ERR_OVERFLOW, FUGE_ERR_CALLBACK, &
    FUGE_ERR_CANCELLED, FUGE_ERR_FILE, FUGE_ERR_GAP, FUGE_ERR_MODES, FUGE_ERR_DOF, FUGE_ERR_MESH, &
    FUGE_ERR_LAW
  use fuge_version_number, only: FUGE_VERSION
  use fuge_wanted_pressure, only: fuge_gap_for_pressure, fuge_wanted_contact
  implicit none
  public

end module fuge_core
