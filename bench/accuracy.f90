!> How exact the answers of the active set are, judged in quadruple precision.
!>
!>     accuracy
!>
!> prints a Markdown table: the error of the forces against the solution, in quadruple precision, of the
!> contact equations on the contact set that the engine has found, and how far that solution is from the
!> conditions of contact, which shows whether the set is the right one.
program accuracy
  use bench_lapack, only: dpotrf, dpotrs
  use bench_problems, only: bench_problem, add_matrix, contact_problem, make_known, make_random, uniform_edges
  use fuge, only: dp => fuge_dp, fuge_dense_operator, fuge_info, fuge_options, fuge_solution, fuge_solver, &
    FUGE_ACTIVE_SET, FUGE_MEAN
  implicit none

  integer, parameter :: qp = selected_real_kind(30)
  integer, parameter :: QUARTIC_SIZES(3) = [64, 256, 1024], RANDOM_SIZES(3) = [50, 200, 800]
  !> Refinements; one gains at least the digits that the condition number leaves of sixteen.
  integer, parameter :: MOST_REFINEMENTS = 40
  !> A refinement that changes forces by less than this fraction has converged.
  real(qp), parameter :: CONVERGED = 1.0e-24_qp

  call run()

contains

  subroutine run()
    type(bench_problem), target :: problem
    integer :: k

    print '(a)', '| problem | in contact | largest error of a force | largest error of a gap or of v_0 | residual |'
    print '(a)', '| --- | ---: | ---: | ---: | ---: |'
    do k = 1, size(QUARTIC_SIZES)
      call make_known('quartic', FUGE_MEAN, uniform_edges(QUARTIC_SIZES(k)), problem)
      call add_matrix(problem)
      call judge_cold_and_warm('quartic', problem)
    end do
    do k = 1, size(RANDOM_SIZES)
      call make_random(RANDOM_SIZES(k), problem)
      call judge_cold_and_warm('random', problem)
    end do
  end subroutine run

  !> A solve from scratch, and one after a solve at a load that is 1 % smaller.
  subroutine judge_cold_and_warm(name, problem)
    character(len=*), intent(in) :: name
    type(bench_problem), intent(inout), target :: problem
    type(fuge_dense_operator) :: operator
    type(fuge_solution) :: solution
    type(fuge_solver) :: cold, warm
    type(fuge_info) :: info

    call operator%set(problem%alpha, info)
    if (info%failed()) error stop 'the matrix was refused'
    call cold%solve(operator, contact_problem(problem), solution, info, fuge_options(FUGE_ACTIVE_SET))
    call write_row(name, '', problem, solution, info)
    problem%load = problem%load/1.01_dp
    call warm%solve(operator, contact_problem(problem), solution, info, fuge_options(FUGE_ACTIVE_SET))
    problem%load = problem%load*1.01_dp
    call warm%solve(operator, contact_problem(problem), solution, info, fuge_options(FUGE_ACTIVE_SET))
    call write_row(name, ', warm', problem, solution, info)
  end subroutine judge_cold_and_warm

  !> Errors of forces as fractions of the largest force; of lengths, of the largest elastic displacement.
  subroutine write_row(name, start, problem, solution, info)
    character(len=*), intent(in) :: name, start
    type(bench_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(fuge_info), intent(in) :: info
    real(qp) :: force(problem%points()), gap(problem%points()), displacement(problem%points()), approach, length
    real(qp) :: force_error, gap_error
    logical :: contact(problem%points())

    if (info%failed()) error stop 'not solved'
    contact = solution%force > 0.0_dp
    call solve_exactly(problem, contact, force, approach)
    displacement = product_with(problem%alpha, force)
    gap = real(problem%gap, qp) + displacement - approach
    length = maxval(abs(displacement))
    if (minval(force, mask=contact) < 0.0_qp .or. minval(gap) < -1.0e-20_qp*length) error stop 'the set is wrong'
    force_error = maxval(abs(force - real(solution%force, qp)))/maxval(force)
    gap_error = max(maxval(abs(gap - real(solution%gap, qp)), mask=.not. contact), &
                    abs(approach - real(solution%motion(1), qp)))/length
    print '(a,i0,a,i0,3(a,es7.1),a)', '| '//name//' ', problem%points(), start//' | ', count(contact), ' | ', &
      real(force_error, dp), ' | ', real(gap_error, dp), ' | ', info%residual, ' |'
  end subroutine write_row

  !> Forces (n) and approach on the contact set, by Cholesky with refinement in quadruple precision.
  subroutine solve_exactly(problem, contact, force, approach)
    type(bench_problem), intent(in) :: problem
    logical, intent(in) :: contact(:)
    real(qp), intent(out) :: force(:), approach
    real(dp), allocatable :: factor(:, :), unit_forces(:, :)
    real(qp), allocatable :: residual(:), step(:), ones(:)
    real(qp) :: missing, motion
    integer, allocatable :: set(:)
    integer :: k, n, info, refinement

    set = pack([(k, k=1, size(contact))], contact)
    n = size(set)
    allocate (factor(n, n), unit_forces(n, 1))
    do k = 1, n
      factor(:, k) = problem%alpha(set, set(k))
    end do
    call dpotrf('L', n, factor, n, info)
    if (info /= 0) error stop 'the contact block is not positive definite'
    unit_forces = 1.0_dp
    call dpotrs('L', n, 1, factor, n, unit_forces, n, info)
    ones = real(unit_forces(:, 1), qp)
    allocate (residual(size(contact)))
    force = 0.0_qp
    approach = 0.0_qp
    do refinement = 1, MOST_REFINEMENTS
      residual = approach - real(problem%gap, qp) - product_with(problem%alpha, force)
      missing = real(problem%load, qp) - sum(force)
      step = solve_with(factor, residual(set))
      motion = (missing - sum(step))/sum(ones)
      step = step + motion*ones
      force(set) = force(set) + step
      approach = approach + motion
      if (maxval(abs(step)) <= CONVERGED*maxval(abs(force))) return
    end do
    error stop 'the refinement does not converge'
  end subroutine solve_exactly

  function solve_with(factor, right) result(solution)
    real(dp), intent(in) :: factor(:, :)
    real(qp), intent(in) :: right(:)
    real(qp) :: solution(size(right)), scale
    real(dp) :: work(size(right), 1)
    integer :: info

    solution = 0.0_qp
    scale = maxval(abs(right))
    if (.not. scale > 0.0_qp) return
    work(:, 1) = real(right/scale, dp)
    call dpotrs('L', size(right), 1, factor, size(right), work, size(right), info)
    solution = scale*real(work(:, 1), qp)
  end function solve_with

  pure function product_with(alpha, force) result(displacement)
    real(dp), intent(in) :: alpha(:, :)
    real(qp), intent(in) :: force(:)
    real(qp) :: displacement(size(force))
    integer :: j

    displacement = 0.0_qp
    do j = 1, size(force)
      if (abs(force(j)) > 0.0_qp) displacement = displacement + real(alpha(:, j), qp)*force(j)
    end do
  end function product_with

end program accuracy
