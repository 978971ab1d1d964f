!> Solve many load cases of one contact problem, each from the contact set of the case most like it.
module fuge_cases_solution
  use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
  use fuge_engine_choice, only: takes_products
  use fuge_kinds, only: dp
  use fuge_load_cases_type, only: allocate_case_solutions, check_cases, fuge_case_solutions, fuge_load_cases, &
    move_case_solutions, take_case
  use fuge_monitor_type, only: fuge_monitor
  use fuge_number_text, only: index_text, text
  use fuge_operator_type, only: fuge_operator
  use fuge_options_type, only: fuge_options
  use fuge_point_space, only: point_space
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_solver_type, only: fuge_solver
  use fuge_status, only: composed_message, fuge_info, report, FUGE_DONE, FUGE_ERR_CANCELLED, FUGE_ERR_SIZE, &
    FUGE_ERR_UNSUPPORTED, FUGE_WARN_CASES
  implicit none
  private

  public :: fuge_solve_cases

contains

  !> Solve load cases that differ in gaps and loads only.
  !>
  !> `operator`, `problem` and `options` as for `solve` of fuge_solver; `cases` says what changes. By a matrix each case
  !> starts from the contact set of the one most like it among those before, with one factor for all that are near each
  !> other; the iteration starts from the last cases. Each case is certified like any other solve, and one that fails
  !> harms no other: solutions%report(k) has what `solve` would have reported. `monitor` hears of each case, once: its
  !> number, its residual and its contacts.
  !> On return info%status is FUGE_DONE if all cases are, else FUGE_WARN_CASES with their number and the message of the
  !> first one that failed, or that has a warning if none did. Counts are sums over the cases; contacts, residual,
  !> force_error and energy are the largest of any. Errors, `solutions` untouched: FUGE_ERR_SIZE for cases that do not
  !> fit the problem, FUGE_ERR_UNSUPPORTED where ranks share the points, FUGE_ERR_MEMORY, FUGE_ERR_CANCELLED.
  subroutine fuge_solve_cases(solver, operator, problem, cases, solutions, info, options, monitor)
    use fuge_nearest_case, only: case_directions
    type(fuge_solver), intent(inout) :: solver
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_load_cases), intent(in) :: cases
    type(fuge_case_solutions), intent(inout) :: solutions
    type(fuge_info), intent(out) :: info
    type(fuge_options), intent(in), optional :: options
    class(fuge_monitor), intent(inout), optional :: monitor
    type(fuge_case_solutions) :: found
    type(case_directions) :: directions
    type(fuge_options) :: chosen
    type(fuge_problem) :: present_problem
    type(point_space) :: space
    logical :: cancelled
    integer :: k

    if (present(options)) chosen = options
    space = operator%ranks()
    if (.not. space%is_alone()) then
      call report(info, FUGE_ERR_UNSUPPORTED, 'ranks solve one load case after the other: call solve for each')
    else if (operator%points() < 1) then
      call report(info, FUGE_ERR_SIZE, 'the operator has no points: set it before the solve')
    else
      call check_cases(cases, problem, info)
    end if
    if (info%failed()) return
    call allocate_case_solutions(operator%points(), problem%mode_count(), cases%number(), &
                                 ieee_value(1.0_dp, ieee_quiet_nan), found, info)
    if (.not. (info%failed() .or. takes_products(operator, chosen))) call directions%set(cases, problem, info)
    if (info%failed()) return
    present_problem = problem
    do k = 1, cases%number()
      if (allocated(cases%refused)) found%report(k) = cases%refused(k)
      if (.not. found%report(k)%failed()) then
        call take_case(cases, k, present_problem)
        call solve_case(solver, operator, present_problem, chosen, directions%most_like(k), k, found)
      end if
      if (found%report(k)%failed()) call directions%leave_out(k)
      if (.not. present(monitor)) cycle
      call monitor%progress(k, found%report(k)%residual, found%report(k)%contacts, cancelled)
      if (.not. cancelled) cycle
      call report(info, FUGE_ERR_CANCELLED, 'cancelled after load case '//index_text(k)//' of ' &
                  //text(cases%number())//' by the progress monitor')
      return
    end do
    call sum_up(found%report, info)
    call move_case_solutions(found, solutions)
  end subroutine fuge_solve_cases

  !> Solve case `k` from the contact set of case `like`, which is 0 if there is none.
  subroutine solve_case(solver, operator, problem, options, like, k, found)
    type(fuge_solver), intent(inout) :: solver
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_options), intent(in) :: options
    integer, intent(in) :: like, k
    type(fuge_case_solutions), intent(inout) :: found
    type(fuge_solution) :: solution

    if (like > 0) call solver%start_from(found%state(:, like))
    call solver%solve(operator, problem, solution, found%report(k), options)
    if (found%report(k)%failed()) return
    found%force(:, k) = solution%force
    found%gap(:, k) = solution%gap
    found%motion(:, k) = solution%motion
    if (allocated(solution%state)) found%state(:, k) = solution%state
  end subroutine solve_case

  !> One report of all cases.
  pure subroutine sum_up(reports, info)
    type(fuge_info), intent(in) :: reports(:)
    type(fuge_info), intent(inout) :: info
    integer :: failed, first, warned

    info%iterations = sum(reports%iterations)
    info%products = sum(reports%products)
    info%preconditionings = sum(reports%preconditionings)
    info%contacts = maxval(reports%contacts)
    info%residual = maxval(reports%residual)
    info%force_error = maxval(reports%force_error)
    info%energy = maxval(reports%energy)
    failed = count(reports%status < FUGE_DONE)
    warned = count(reports%status > FUGE_DONE)
    if (failed + warned < 1) return
    if (failed > 0) then
      first = findloc(reports%status < FUGE_DONE, .true., dim=1)
    else
      first = findloc(reports%status > FUGE_DONE, .true., dim=1)
    end if
    call report(info, FUGE_WARN_CASES, text(failed)//' of '//text(size(reports))//' load cases failed, '//text(warned) &
                //' have a warning; load case '//index_text(first)//': '//composed_message(reports(first)))
  end subroutine sum_up

end module fuge_cases_solution
