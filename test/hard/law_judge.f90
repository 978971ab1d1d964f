!> Judges what an engine makes of a random problem with laws, by the answer in quadruple precision.
!>
!> Errors are compared with those that the residual of the answer, or rounding, leaves open in the states of the exact
!> one.
module law_judge
  use, intrinsic :: iso_fortran_env, only: qp => real128
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_options_type, only: fuge_options, FUGE_ITERATIVE
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_status, only: fuge_info, FUGE_DONE, FUGE_ERR_MODES, FUGE_ERR_NO_EQUILIBRIUM, FUGE_ERR_NOT_DEFINITE, &
    FUGE_ERR_UNSUPPORTED, FUGE_WARN_ILL_CONDITIONED, FUGE_WARN_NOT_UNIQUE, FUGE_WARN_RESIDUAL
  use general_reference, only: solve_general
  use law_margins, only: carried_margin
  use law_oracle, only: find_bounds, law_answer, law_bounds, solve_law
  use law_programs, only: has_independent_modes
  use random_laws, only: law_scene
  implicit none
  private

  public :: judge_law, know_law

  !> Resultants this close to what the limits carry, as a fraction of it, may be refused or not.
  real(qp), parameter :: BORDER = 1.0e-9_qp
  !> Factor of safety of the bounds, and what counts as rounding; the tolerance of the
  !> library.
  real(dp), parameter :: SAFETY = 64.0_dp, ROUNDING = 8.0_dp*epsilon(1.0_dp), TOLERANCE = 1.0e-10_dp
  !> An error of a force above the first has a warning; the estimate is good to the second, or below the
  !> third.
  real(dp), parameter :: SILENT = 1.0e-3_dp, OF_ESTIMATE = 1.0e2_dp, LEAST_ESTIMATE = 1.0e-12_dp

  !> What is known of a problem.
  type, public :: known_law
    real(qp) :: margin = 1.0_qp
    logical :: independent = .true.
    !> Set where the resultants can be carried.
    type(law_answer) :: answer
  end type known_law

  type, public :: law_verdict
    !> Blank if the engine is right.
    character(len=24) :: fault = ''
    character(len=120) :: details = ''
    integer :: status = 0
    !> Largest error of a force, relative to the largest force.
    real(dp) :: error = 0.0_dp
  end type law_verdict

contains

  !> The answer to a problem, or that there is none.
  pure subroutine know_law(scene, known)
    type(law_scene), intent(in) :: scene
    type(known_law), intent(out) :: known

    known%margin = carried_margin(scene%problem)
    known%independent = has_independent_modes(scene%alpha, scene%problem)
    if (known%margin >= -BORDER) call solve_law(scene%alpha, scene%problem, known%answer)
  end subroutine know_law

  !> Solve by an engine, and compare.
  subroutine judge_law(scene, known, method, verdict)
    type(law_scene), intent(in) :: scene
    type(known_law), intent(in) :: known
    integer, intent(in) :: method
    type(law_verdict), intent(out) :: verdict
    type(fuge_solution) :: solution
    type(fuge_info) :: info

    call solve_general(scene%alpha, scene%problem, solution, info, fuge_options(method))
    verdict%status = info%status
    if (info%failed()) then
      if (.not. may_refuse(scene, known, method, info%status)) call fail(verdict, 'refused', info%message)
    else if (known%margin < -BORDER) then
      call fail(verdict, 'insoluble', info%message)
    else if (known%margin >= 0.0_qp) then
      call judge_warning(known, info, verdict)
      if (verdict%fault /= '' .or. info%status == FUGE_WARN_RESIDUAL) return
      ! The iteration goes on to its tolerance, the others to rounding.
      call compare(scene, known%answer, merge(TOLERANCE, ROUNDING, method == FUGE_ITERATIVE), solution, info, verdict)
    end if
  end subroutine judge_law

  pure subroutine fail(verdict, fault, details)
    type(law_verdict), intent(inout) :: verdict
    character(len=*), intent(in) :: fault, details

    verdict%fault = fault
    verdict%details = details
  end subroutine fail

  !> Errors that have their reason. Of resultants that only forces at their limits carry, rounding does not decide.
  pure function may_refuse(scene, known, method, status) result(may)
    type(law_scene), intent(in) :: scene
    type(known_law), intent(in) :: known
    integer, intent(in) :: method, status
    logical :: may

    select case (status)
    case (FUGE_ERR_UNSUPPORTED)
      may = method == FUGE_ITERATIVE .and. scene%problem%has_springs()
    case (FUGE_ERR_NO_EQUILIBRIUM)
      may = known%margin < 0.0_qp
    case (FUGE_ERR_MODES)
      may = .not. known%independent
    case (FUGE_ERR_NOT_DEFINITE)
      may = known%margin < 0.0_qp .or. .not. known%answer%definite
    case default
      may = .false.
    end select
  end function may_refuse

  !> Is an answer without a warning unique, and one with a warning not?
  pure subroutine judge_warning(known, info, verdict)
    type(known_law), intent(in) :: known
    type(fuge_info), intent(in) :: info
    type(law_verdict), intent(inout) :: verdict

    if (info%status == FUGE_DONE .and. .not. (known%answer%may_resist .and. known%answer%definite)) then
      call fail(verdict, 'not unique', 'and not told')
    else if (info%status == FUGE_WARN_NOT_UNIQUE .and. known%answer%resists .and. known%answer%definite) then
      call fail(verdict, 'unique', info%message)
    end if
  end subroutine judge_warning

  !> Compare forces, and gaps and motions where they are unique; residuals below `least` count as that.
  subroutine compare(scene, answer, least, solution, info, verdict)
    type(law_scene), intent(in) :: scene
    type(law_answer), intent(in) :: answer
    real(dp), intent(in) :: least
    type(fuge_solution), intent(in) :: solution
    type(fuge_info), intent(in) :: info
    type(law_verdict), intent(inout) :: verdict
    type(law_bounds) :: bounds
    real(dp) :: largest

    if (.not. answer%definite) return
    call find_bounds(scene%alpha, scene%problem, answer, SAFETY*max(info%residual, least), solution%state, bounds)
    largest = real(maxval(abs(answer%force)), dp)
    if (largest > 0.0_dp) verdict%error = real(maxval(abs(solution%force - answer%force)), dp)/largest
    if (info%status == FUGE_WARN_ILL_CONDITIONED) return
    if (verdict%error > SILENT .and. .not. answer%negligible) then
      call fail(verdict, 'silent', text(verdict%error)//', estimated as '//text(info%force_error))
    end if
    call compare_values('forces', solution%force, answer%force, bounds%force + ROUNDING*(largest + answer%natural), &
                        info, verdict)
    if (verdict%error > OF_ESTIMATE*info%force_error + LEAST_ESTIMATE .and. verdict%fault == '' &
        .and. .not. answer%negligible) then
      call fail(verdict, 'estimate', text(verdict%error)//', estimated as '//text(info%force_error))
    end if
    if (info%status == FUGE_WARN_NOT_UNIQUE .or. .not. answer%resists) return
    call compare_values('gaps', solution%gap, answer%gap, &
                        bounds%gap + ROUNDING*real(maxval(abs(answer%gap)), dp), info, verdict)
    call compare_values('motions', solution%motion, answer%motion, bounds%motion, info, verdict)
  end subroutine compare

  pure subroutine compare_values(what, found, exact, bound, info, verdict)
    character(len=*), intent(in) :: what
    real(dp), intent(in) :: found(:), bound(:)
    real(qp), intent(in) :: exact(:)
    type(fuge_info), intent(in) :: info
    type(law_verdict), intent(inout) :: verdict
    integer :: k

    if (verdict%fault /= '') return
    do k = 1, size(found)
      if (abs(found(k) - exact(k)) <= bound(k)) cycle
      call fail(verdict, what, text(k)//': '//text(found(k))//' for '//text(real(exact(k), dp))//', off by ' &
                //text(real(abs(found(k) - exact(k)), dp))//' of '//text(bound(k))//', residual '//text(info%residual))
      return
    end do
  end subroutine compare_values

end module law_judge
