!> Judges whether two engines agree on a scene.
!>
!> Agreement is that of two answers which both are certified: forces by the errors that their gap equations leave, over
!> the stiffness of the bodies on the points that carry; gaps and motions by the displacements of the difference.
module engine_judge
  use engine_scene_type, only: engine_scene
  use engine_stiffness, only: find_stiffness, leverage_of
  use fuge_kinds, only: dp
  use fuge_matrix_operator, only: fuge_dense_operator
  use fuge_number_text, only: text
  use fuge_options_type, only: fuge_options, FUGE_ACTIVE_SET, FUGE_ITERATIVE
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_solver_type, only: fuge_solver
  use fuge_status, only: fuge_info, FUGE_DONE, FUGE_ERR_NO_EQUILIBRIUM, FUGE_ERR_NOT_DEFINITE, &
    FUGE_WARN_ILL_CONDITIONED, FUGE_WARN_NOT_UNIQUE, FUGE_WARN_RESIDUAL
  use general_reference, only: is_excluded, modes_of, play_of
  use law_reference, only: law_violation
  implicit none
  private

  public :: judge_scene, judge_steps, solve_scene_by

  !> The residual that an answer without a warning may have, and the one by the tests' own equations.
  real(dp), parameter :: MOST_RESIDUAL = 1.0e-10_dp
  !> Factor of safety of all bounds that are compared.
  real(dp), parameter :: SAFETY = 8.0_dp
  !> Eigenvalues below this fraction of the largest one are rounding: forces are not unique.
  real(dp), parameter :: SINGULAR = 1.0e-13_dp
  !> Motions that the contact resists by no more than one over this are not compared.
  real(dp), parameter :: MOST_LEVERAGE = 1.0e6_dp
  !> Terms of displacements of this size beside the gaps show forces that regularisation alone limits.
  real(dp), parameter :: DWARFED = 1.0e4_dp
  !> Products for each point above which the iteration is suspect.
  integer, parameter :: MOST_PRODUCTS = 30

  !> What the two engines did.
  type, public :: engine_verdict
    !> Blank if they agree.
    character(len=24) :: fault = ''
    character(len=160) :: details = ''
    integer :: points = 0, status(2) = 0, products = 0, iterations = 0
    real(dp) :: residual(2) = 0.0_dp
    !> Largest difference of forces relative to the largest force; the condition of the body where forces act, 0 if not
    !> known.
    real(dp) :: difference = 0.0_dp, condition = 0.0_dp
  end type engine_verdict

contains

  !> Solve by a dense engine and by another one, `methods`, and compare.
  subroutine judge_scene(scene, methods, verdict, info)
    type(engine_scene), intent(in) :: scene
    integer, intent(in) :: methods(2)
    type(engine_verdict), intent(out) :: verdict
    type(fuge_info), intent(out) :: info(2)
    type(fuge_solution) :: solution(2)
    integer :: k

    do k = 1, 2
      call solve_scene_by(scene, methods(k), solution(k), info(k))
    end do
    call compare_answers(scene, solution, info, verdict)
  end subroutine judge_scene

  !> As `judge_scene`, for a sequence of loads that one solver of the iteration follows from step to step: the scene,
  !> up by 5 %, without the load of the first mode, and the scene again. `info` is that of the last step compared.
  subroutine judge_steps(scene, verdict, info)
    type(engine_scene), intent(inout) :: scene
    type(engine_verdict), intent(out) :: verdict
    type(fuge_info), intent(out) :: info(2)
    type(fuge_solver) :: solver
    type(fuge_solution) :: solution(2)
    type(fuge_problem) :: problem
    integer :: step

    problem = scene%problem
    do step = 1, 4
      scene%problem = problem
      if (step == 2) call raise_loads(scene%problem)
      if (step == 3 .and. size(problem%resultant) > 0) scene%problem%resultant(1) = 0.0_dp
      call solve_scene_by(scene, FUGE_ACTIVE_SET, solution(1), info(1))
      call solve_scene_with(solver, scene, FUGE_ITERATIVE, solution(2), info(2))
      call compare_answers(scene, solution, info, verdict)
      if (verdict%fault == '') cycle
      verdict%details = 'step '//text(step)//': '//verdict%details
      return
    end do
  end subroutine judge_steps

  !> Loads and prescribed motions of 1.05 times their size.
  pure subroutine raise_loads(problem)
    type(fuge_problem), intent(inout) :: problem

    problem%resultant = 1.05_dp*problem%resultant
    if (allocated(problem%motion)) problem%motion = 1.05_dp*problem%motion
  end subroutine raise_loads

  !> Solve by one engine; the iteration gets the operator if there is one.
  subroutine solve_scene_by(scene, method, solution, info)
    type(engine_scene), intent(in) :: scene
    integer, intent(in) :: method
    type(fuge_solution), intent(out) :: solution
    type(fuge_info), intent(out) :: info
    type(fuge_solver) :: solver

    call solve_scene_with(solver, scene, method, solution, info)
  end subroutine solve_scene_by

  !> Solve by a solver that may have solved other scenes.
  subroutine solve_scene_with(solver, scene, method, solution, info)
    type(fuge_solver), intent(inout) :: solver
    type(engine_scene), intent(in) :: scene
    integer, intent(in) :: method
    type(fuge_solution), intent(out) :: solution
    type(fuge_info), intent(out) :: info
    type(fuge_dense_operator) :: operator
    real(dp), allocatable, target :: matrix(:, :)

    if (method == FUGE_ITERATIVE .and. allocated(scene%operator)) then
      call solver%solve(scene%operator, scene%problem, solution, info, fuge_options(method))
      return
    end if
    allocate (matrix, source=scene%alpha)
    call operator%set(matrix, info)
    if (info%failed()) return
    call solver%solve(operator, scene%problem, solution, info, fuge_options(method))
  end subroutine solve_scene_with

  !> Compare status, message, residuals, forces, gaps and cost, and name the first fault. The second answer is that of
  !> the iteration.
  subroutine compare_answers(scene, solution, info, verdict)
    type(engine_scene), intent(in) :: scene
    type(fuge_solution), intent(in) :: solution(2)
    type(fuge_info), intent(in) :: info(2)
    type(engine_verdict), intent(out) :: verdict

    verdict%points = size(scene%alpha, 2)
    verdict%status = info%status
    verdict%products = info(2)%products
    verdict%iterations = info(2)%iterations
    verdict%residual = info%residual
    call compare_reports(scene, solution, info, verdict)
    if (verdict%fault /= '' .or. any(info%status < FUGE_DONE)) return
    if (any(info%status == FUGE_WARN_RESIDUAL)) return
    call check_residuals(scene, solution, info, verdict)
    if (verdict%fault == '') call compare_solutions(scene, solution, info, verdict)
    if (verdict%fault == '' .and. verdict%products > MOST_PRODUCTS*(verdict%points + 2)) then
      call fail(verdict, 'cost', text(verdict%products)//' products')
    end if
  end subroutine compare_answers

  pure subroutine fail(verdict, fault, details)
    type(engine_verdict), intent(inout) :: verdict
    character(len=*), intent(in) :: fault, details

    verdict%fault = fault
    verdict%details = details
  end subroutine fail

  !> Equal statuses; with an error equal messages, no answer, and no products where equilibrium decides.
  subroutine compare_reports(scene, solution, info, verdict)
    type(engine_scene), intent(in) :: scene
    type(fuge_solution), intent(in) :: solution(2)
    type(fuge_info), intent(in) :: info(2)
    type(engine_verdict), intent(inout) :: verdict
    integer :: k

    do k = 1, 2
      if (info(k)%failed() .eqv. allocated(solution(k)%force)) call fail(verdict, 'outputs', 'of engine '//text(k))
    end do
    if (verdict%fault /= '') return
    if (info(1)%status /= info(2)%status) then
      if (may_differ(scene, solution, info)) return
      call fail(verdict, 'status', text(info(1)%status)//' / '//text(info(2)%status)//': '//info(2)%message)
    else if (refused_late(info)) then
      call fail(verdict, 'products before refusal', text(info(2)%products))
    else if (.not. same_message(scene%singular, info)) then
      call fail(verdict, 'message', info(2)%message)
    end if
  end subroutine compare_reports

  !> Statuses that may differ, each for a reason:
  !>
  !> - Products tell that forces are not unique only where two points are the same, and the engines estimate the error
  !>   of forces by different means: on a singular body the statuses that concern the forces alone count as one.
  !> - On a singular body the active set regularises. Where that ends with a large residual, or with forces that dwarf
  !>   the data, the iteration may have an answer, or know that there is none.
  !> - An operator of products alone does not know the terms that its displacements are the sum of, so that its residual
  !>   is compared with the sum, which may be no more than the rounding of the terms.
  function may_differ(scene, solution, info) result(may)
    type(engine_scene), intent(in) :: scene
    type(fuge_solution), intent(in) :: solution(2)
    type(fuge_info), intent(in) :: info(2)
    logical :: may

    may = .false.
    ! Forces of the iteration that may be none resist a motion all the same.
    if (info(1)%status == FUGE_WARN_NOT_UNIQUE .and. info(2)%status == FUGE_DONE) then
      associate (force => abs(solution(2)%force))
        may = any(force > 0.0_dp .and. force <= info(2)%force_error*maxval(force))
      end associate
    end if
    if (scene%singular) then
      may = may .or. concerns_forces(info(1)) .and. concerns_forces(info(2))
      if (.not. info(1)%failed()) may = may .or. (info(1)%status == FUGE_WARN_RESIDUAL &
        .and. (.not. info(2)%failed() .or. info(2)%status == FUGE_ERR_NOT_DEFINITE))
      if (info(1)%status == FUGE_WARN_NOT_UNIQUE .and. info(2)%status == FUGE_ERR_NOT_DEFINITE) then
        may = may .or. maxval(abs(scene%alpha))*maxval(abs(solution(1)%force)) > DWARFED*length_of(scene)
      end if
    end if
    if (concerns_forces(info(1)) .and. info(2)%status == FUGE_WARN_RESIDUAL .and. allocated(scene%operator)) then
      may = may .or. info(2)%residual <= rounding_of(scene, solution(2))
    end if
  end function may_differ

  !> Done, or a warning that concerns the forces alone?
  pure function concerns_forces(info) result(concerns)
    type(fuge_info), intent(in) :: info
    logical :: concerns

    concerns = info%status == FUGE_DONE .or. info%status == FUGE_WARN_ILL_CONDITIONED
    if (info%status == FUGE_WARN_NOT_UNIQUE) concerns = index(info%message, 'resist') < 1
  end function concerns_forces

  !> The largest of gaps and plays.
  pure function length_of(scene) result(length)
    type(engine_scene), intent(in) :: scene
    real(dp) :: length

    length = maxval(abs(scene%problem%gap))
    if (.not. allocated(scene%problem%gap_upper)) return
    length = max(length, maxval(scene%problem%gap_upper, mask=scene%problem%gap_upper < huge(length)))
  end function length_of

  !> The rounding of the largest terms of displacements and motions, relative to the largest displacement.
  function rounding_of(scene, solution) result(rounding)
    type(engine_scene), intent(in) :: scene
    type(fuge_solution), intent(in) :: solution
    real(dp) :: rounding
    real(dp) :: modes(size(scene%alpha, 2), scene%problem%mode_count()), largest

    modes = modes_of(scene%problem)
    largest = maxval(abs(matmul(scene%alpha, solution%force)))
    rounding = SAFETY*epsilon(rounding)*(largest_terms(scene%alpha, solution%force) &
                                         + largest_terms(modes, solution%motion))/max(largest, tiny(largest))
  end function rounding_of

  !> The largest of the sums of |matrix| |x|.
  pure function largest_terms(matrix, x) result(largest)
    real(dp), intent(in) :: matrix(:, :), x(:)
    real(dp) :: largest
    real(dp) :: terms(size(matrix, 1))
    integer :: j

    terms = 0.0_dp
    do j = 1, size(x)
      terms = terms + abs(matrix(:, j)*x(j))
    end do
    largest = maxval(terms)
  end function largest_terms

  !> Were products formed although the resultants have no equilibrium? For a periodic surface it takes one to tell.
  pure function refused_late(info) result(late)
    type(fuge_info), intent(in) :: info(2)
    logical :: late

    late = info(2)%status == FUGE_ERR_NO_EQUILIBRIUM .and. info(2)%products > 0 &
           .and. index(info(2)%message, 'equal forces') /= 1
  end function refused_late

  !> The same words. Of several motions that are not resisted either may be named, and of a singular matrix or a large
  !> residual the engines may know different things.
  pure function same_message(singular, info) result(same)
    logical, intent(in) :: singular
    type(fuge_info), intent(in) :: info(2)
    logical :: same

    select case (info(1)%status)
    case (FUGE_DONE, FUGE_WARN_RESIDUAL, FUGE_WARN_ILL_CONDITIONED, FUGE_ERR_NOT_DEFINITE)
      same = .true.
    case (FUGE_WARN_NOT_UNIQUE)
      same = singular .or. ((index(info(1)%message, 'resist') > 0) .eqv. (index(info(2)%message, 'resist') > 0))
    case default
      same = info(1)%message == info(2)%message
      ! With one translation the iteration names the approach itself.
      if (index(info(1)%message, 'equal forces') == 1) same = index(info(2)%message, 'equal forces') == 1
    end select
  end function same_message

  !> Answers without a warning keep to the tolerance, by the certificate and by the tests' own equations.
  subroutine check_residuals(scene, solution, info, verdict)
    type(engine_scene), intent(in) :: scene
    type(fuge_solution), intent(in) :: solution(2)
    type(fuge_info), intent(in) :: info(2)
    type(engine_verdict), intent(inout) :: verdict
    real(dp) :: violation
    integer :: k

    do k = 1, 2
      if (info(k)%residual > MOST_RESIDUAL) call fail(verdict, 'residual', text(info(k)%residual))
      ! Nothing to be compared with, and nothing to compare.
      if (.not. (max(maxval(abs(scene%problem%gap)), maxval(abs(solution(k)%force))) > 0.0_dp &
                 .and. maxval(abs(scene%alpha)) > 0.0_dp)) cycle
      violation = law_violation(scene%alpha, without_prescribed(scene%problem, solution(k)), solution(k))
      if (violation > SAFETY*MOST_RESIDUAL) call fail(verdict, 'own residual', text(violation)//' engine '//text(k))
    end do
  end subroutine check_residuals

  !> The prescribed motions are compared by the certificate, relative to each; here they are those of the answer.
  function without_prescribed(problem, solution) result(other)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(fuge_problem) :: other

    other = problem
    if (allocated(other%motion)) other%motion = solution%motion
  end function without_prescribed

  !> Compare forces, gaps and motions.
  subroutine compare_solutions(scene, solution, info, verdict)
    type(engine_scene), intent(in) :: scene
    type(fuge_solution), intent(in) :: solution(2)
    type(fuge_info), intent(in) :: info(2)
    type(engine_verdict), intent(inout) :: verdict
    real(dp), dimension(size(scene%alpha, 2)) :: phi, error
    real(dp) :: largest, bound, stiffness(2), leverage, displacement
    logical :: carries(size(phi)), no_energy

    phi = solution(2)%force - solution(1)%force
    largest = max(maxval(abs(solution(1)%force)), maxval(abs(solution(2)%force)))
    if (.not. largest > 0.0_dp) largest = 1.0_dp
    verdict%difference = maxval(abs(phi))/largest
    carries = abs(solution(1)%force) > 0.0_dp .or. abs(solution(2)%force) > 0.0_dp
    error = left_error(scene, solution(1)) + left_error(scene, solution(2))
    call find_stiffness(scene, carries, phi, stiffness)
    no_energy = stiffness(1) <= SINGULAR*stiffness(2)
    if (.not. no_energy) then
      verdict%condition = stiffness(2)/stiffness(1)
      bound = SAFETY*norm2_of(error)/stiffness(1)
      if (norm2_of(phi) > bound) call fail(verdict, 'forces', 'differ by '//text(verdict%difference)//', condition ' &
                                           //text(verdict%condition))
    end if
    leverage = leverage_of(scene%problem, carries)
    if (verdict%fault /= '' .or. leverage > MOST_LEVERAGE) return
    displacement = maxval(abs(matmul(scene%alpha, phi)))
    ! Forces without energy displace nothing, whether they are unique or not.
    if (no_energy) bound = SAFETY*(1.0_dp + leverage)*(sqrt(stiffness(2)*sum(abs(phi)*error)) + maxval(error))
    if (no_energy .and. displacement > bound) then
      call fail(verdict, 'displacements', text(displacement)//' of '//text(bound))
    end if
    if (any(info%status == FUGE_WARN_NOT_UNIQUE .and. index(info%message, 'resist') > 0)) return
    bound = SAFETY*(1.0_dp + leverage)*(displacement + maxval(error))
    if (maxval(abs(solution(2)%gap - solution(1)%gap)) > bound) then
      call fail(verdict, 'gaps', 'differ by '//text(maxval(abs(solution(2)%gap - solution(1)%gap))) &
                //', forces by '//text(verdict%difference))
    end if
  end subroutine compare_solutions

  !> The Euclidean norm, without overflow.
  pure function norm2_of(values) result(norm)
    real(dp), intent(in) :: values(:)
    real(dp) :: norm, largest

    norm = 0.0_dp
    largest = maxval(abs(values))
    if (largest > 0.0_dp) norm = largest*norm2(values/largest)
  end function norm2_of

  !> The length that an answer leaves open at each point, (n), its rounding included: errors of the gap equation,
  !> forces beside their stops, penetrations.
  function left_error(scene, solution) result(error)
    type(engine_scene), intent(in) :: scene
    type(fuge_solution), intent(in) :: solution
    real(dp) :: error(size(scene%alpha, 2)), magnitude(size(scene%alpha, 2)), play
    real(dp), allocatable :: modes(:, :)
    integer :: k

    allocate (modes, source=modes_of(scene%problem))
    error = abs(scene%problem%gap + matmul(scene%alpha, solution%force) - matmul(modes, solution%motion) - solution%gap)
    magnitude = abs(scene%problem%gap) + matmul(abs(scene%alpha), abs(solution%force)) &
                + matmul(abs(modes), abs(solution%motion))
    error = error + 4.0_dp*epsilon(error)*(magnitude + maxval(magnitude))
    do k = 1, size(error)
      if (is_excluded(scene%problem, k)) cycle
      play = min(play_of(scene%problem, k), huge(play))
      error(k) = error(k) + max(-solution%gap(k), 0.0_dp) + max(solution%gap(k) - play, 0.0_dp)
      if (solution%force(k) > 0.0_dp) error(k) = error(k) + abs(solution%gap(k))
      if (solution%force(k) < 0.0_dp .and. play < huge(play)) error(k) = error(k) + abs(solution%gap(k) - play)
    end do
  end function left_error

end module engine_judge
