!> The dense engines on the paper's problem, called from a matrix, gaps and a load.
module plain_runs
  use, intrinsic :: iso_c_binding, only: c_f_pointer, c_loc
  use fuge_block_pivoting, only: run_block_pivoting
  use fuge_kkt_factor, only: kkt_factor
  use fuge_definiteness, only: check_definite
  use fuge_history_type, only: fuge_history
  use fuge_kinds, only: dp
  use fuge_monitor_type, only: fuge_monitor
  use fuge_problem_type, only: fuge_problem, set_problem
  use fuge_canonical_problem, only: canonical_problem, make_canonical
  use fuge_contact_solution, only: allocate_solution, contact_solution
  use fuge_options_type, only: fuge_options
  use fuge_status, only: fuge_info
  use fuge_paper_tableau, only: run_phase_one
  implicit none
  private

  public :: make_plain, pose_canonical, run_plain, plain_phase, plain_definite

contains

  !> As `run_block_pivoting`, with the contact set as a mask and one motion.
  subroutine run_plain(alpha, datum, gap, load, limit, monitor, factor, contact, force, gap_out, approach, iterations, &
                       status)
    real(dp), intent(in), contiguous, target :: alpha(:, :)
    real(dp), intent(in) :: datum, gap(:), load
    integer, intent(in) :: limit
    class(fuge_monitor), intent(inout) :: monitor
    type(kkt_factor), intent(inout) :: factor
    logical, intent(inout) :: contact(:)
    real(dp), intent(out) :: force(:), gap_out(:), approach
    integer, intent(out) :: iterations, status
    type(canonical_problem) :: canonical
    type(contact_solution) :: solution
    type(fuge_info) :: info

    call make_plain(alpha, datum, gap, load, canonical)
    call allocate_solution(size(gap), 1, solution, info)
    solution%state = merge(1, 0, contact)
    call run_block_pivoting(canonical, limit, monitor, factor, solution, iterations, status)
    contact = solution%state /= 0
    force = solution%force
    gap_out = solution%gap
    approach = solution%motion(1)
  end subroutine run_plain

  !> The plain problem as the engines take it.
  subroutine make_plain(alpha, datum, gap, load, canonical)
    real(dp), intent(in), contiguous, target :: alpha(:, :)
    real(dp), intent(in) :: datum, gap(:), load
    type(canonical_problem), intent(out) :: canonical
    type(fuge_problem) :: problem
    type(fuge_info) :: info

    call set_problem(gap, load, problem, info)
    call pose_canonical(alpha, datum, problem, canonical, info)
  end subroutine make_plain

  !> Any problem as the engines take it; they use alpha less `datum`.
  subroutine pose_canonical(alpha, datum, problem, canonical, info)
    real(dp), intent(in), contiguous, target :: alpha(:, :)
    real(dp), intent(in) :: datum
    type(fuge_problem), intent(in) :: problem
    type(canonical_problem), intent(out) :: canonical
    type(fuge_info), intent(out) :: info
    real(dp), pointer, contiguous :: matrix(:, :)

    call make_canonical(problem, canonical, info)
    if (info%failed()) return
    ! Through an address: nothing writes to alpha.
    call c_f_pointer(c_loc(alpha(1, 1)), matrix, shape(alpha))
    call canonical%set_matrix(matrix, datum)
  end subroutine pose_canonical

  !> As `run_phase_one`, with the contact set as a mask.
  subroutine plain_phase(alpha, gap, load, rule, max_pivots, keep_history, monitor, history, contact, pivots, status)
    real(dp), intent(in), contiguous, target :: alpha(:, :)
    real(dp), intent(in) :: gap(:), load
    integer, intent(in) :: rule, max_pivots
    logical, intent(in) :: keep_history
    class(fuge_monitor), intent(inout) :: monitor
    type(fuge_history), intent(inout) :: history
    logical, intent(out) :: contact(:)
    integer, intent(out) :: pivots, status
    type(canonical_problem) :: canonical
    integer :: state(size(gap))

    call make_plain(alpha, 0.0_dp, gap, load, canonical)
    call run_phase_one(canonical, fuge_options(pivot_rule=rule, keep_history=keep_history), max_pivots, monitor, &
                       history, &
                       state, pivots, status)
    contact = state /= 0
  end subroutine plain_phase

  !> As `check_definite`, on forces with zero sum.
  subroutine plain_definite(alpha, deficient, status)
    real(dp), intent(in) :: alpha(:, :)
    integer, intent(out) :: deficient, status
    real(dp) :: ones(size(alpha, 2), 1)

    ones = 1.0_dp
    call check_definite(alpha, 0.0_dp, ones, spread(.false., 1, size(alpha, 2)), deficient, status)
  end subroutine plain_definite

end module plain_runs
