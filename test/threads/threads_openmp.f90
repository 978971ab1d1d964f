!> Solvers in a parallel loop of OpenMP, one for each problem, with shared operators.
!> All answers must be those of the same loop run by one thread, bit for bit.
program threads_openmp
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_cell_elements, only: FUGE_MEAN
  use fuge_contact_path, only: fuge_follow_path, fuge_load_path
  use fuge_halfplane_fft, only: fuge_halfplane_operator
  use fuge_halfplane_influence, only: fuge_halfplane_matrix
  use fuge_kinds, only: dp
  use fuge_matrix_operator, only: fuge_dense_operator
  use fuge_operator_type, only: fuge_operator
  use fuge_options_type, only: fuge_options, FUGE_ACTIVE_SET, FUGE_ITERATIVE, FUGE_TABLEAU
  use fuge_path_type, only: fuge_path
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_solver_type, only: fuge_solver
  use fuge_status, only: fuge_info, FUGE_ERR_OPTION
  use omp_lib, only: omp_get_num_threads
  implicit none

  integer, parameter :: N = 40
  integer, parameter :: PROBLEMS = 48
  !> Of one problem: force, gap, approach, residual by three engines, ends of paths, letters of a message.
  integer, parameter :: VALUES = 3*(2*N + 2) + 4
  real(dp), parameter :: LOAD = 1.0e-3_dp

  call run()

contains

  subroutine run()
    real(dp), target :: alpha(N, N)
    real(dp) :: x(N), width(N), together(VALUES, PROBLEMS), alone(VALUES, PROBLEMS)
    type(fuge_dense_operator) :: dense
    type(fuge_halfplane_operator) :: cells
    type(fuge_info) :: info
    integer :: k, team

    x = [(real(k, dp), k=1, N)]
    width = 1.0_dp
    call fuge_halfplane_matrix(x, width, 1.0_dp, FUGE_MEAN, alpha, info)
    if (.not. info%failed()) call dense%set(alpha, info)
    if (.not. info%failed()) call cells%set(N, 1.0_dp, 1.0_dp, info)
    if (info%failed()) call stop_with(info%message)

    team = 1
    !$omp parallel do schedule(dynamic) default(none) shared(dense, cells, together, team)
    do k = 1, PROBLEMS
      if (k == 1) team = omp_get_num_threads()
      call solve_all(dense, cells, k, together(:, k))
    end do
    !$omp end parallel do
    if (team < 2) call stop_with('this needs two threads or more')
    do k = 1, PROBLEMS
      call solve_all(dense, cells, k, alone(:, k))
    end do
    do k = 1, PROBLEMS
      if (.not. same(together(:, k), alone(:, k))) call stop_with('an answer of several threads is not that of one')
    end do
    if (same(alone(:, 1), alone(:, 2))) call stop_with('all problems have the same answer')
    print '(i0,a,i0,a)', PROBLEMS, ' problems by ', team, ' threads, the same answers'
  end subroutine run

  !> Bit for bit.
  pure function same(a, b)
    real(dp), intent(in) :: a(:), b(:)
    logical :: same

    same = all(transfer(a, 0_int64, size(a)) == transfer(b, 0_int64, size(b)))
  end function same

  !> Problem `number` by every engine. The matrix and the cells are shared, and there are cells of its own.
  subroutine solve_all(dense, cells, number, value)
    type(fuge_dense_operator), intent(in) :: dense
    type(fuge_halfplane_operator), intent(in) :: cells
    integer, intent(in) :: number
    real(dp), intent(out) :: value(:)
    type(fuge_halfplane_operator) :: own
    type(fuge_problem) :: problem
    type(fuge_path) :: path
    type(fuge_path) :: general
    type(fuge_info) :: info
    integer :: k, part

    allocate (problem%gap(N), problem%resultant(1))
    problem%gap = [(1.0e-4_dp*(1.0_dp + 0.01_dp*real(number, dp))*(real(k, dp) - 0.5_dp*real(N + 1, dp))**2, k=1, N)]
    problem%resultant = LOAD
    value = 0.0_dp
    part = 2*N + 2
    call own%set(N, 1.0_dp, 1.0_dp + real(number, dp), info)
    if (info%failed()) call stop_with(info%message)
    call solve_with(dense, problem, FUGE_TABLEAU, value(:part))
    if (modulo(number, 2) == 0) then
      call solve_with(cells, problem, FUGE_ITERATIVE, value(part + 1:2*part))
    else
      call solve_with(own, problem, FUGE_ITERATIVE, value(part + 1:2*part))
    end if
    call solve_with(dense, problem, FUGE_ACTIVE_SET, value(2*part + 1:3*part))
    call fuge_load_path(dense, problem%gap, LOAD, path, info)
    if (info%failed()) call stop_with(info%message)
    value(3*part + 1) = path%motion(1, path%entries)
    call fuge_follow_path(dense, problem, [2.0_dp*LOAD], general, info)
    if (info%failed()) call stop_with(info%message)
    value(3*part + 2) = general%parameter(general%entries)
    call read_message(dense, problem, number, value(3*part + 3:))
  end subroutine solve_all

  subroutine solve_with(operator, problem, method, value)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: method
    real(dp), intent(out) :: value(:)
    type(fuge_solver) :: solver
    type(fuge_solution) :: solution
    type(fuge_options) :: options
    type(fuge_info) :: info

    options%method = method
    call solver%solve(operator, problem, solution, info, options)
    if (info%status /= 0) call stop_with(info%message)
    value = [solution%force, solution%gap, solution%motion, info%residual]
  end subroutine solve_with

  !> A refusal with a number in its message: its length and the sum of its letters.
  subroutine read_message(dense, problem, number, value)
    type(fuge_dense_operator), intent(in) :: dense
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: number
    real(dp), intent(out) :: value(:)
    type(fuge_solver) :: solver
    type(fuge_solution) :: solution
    type(fuge_options) :: options
    type(fuge_info) :: info
    integer :: k

    options%max_iterations = -10**modulo(number, 8)
    call solver%solve(dense, problem, solution, info, options)
    if (info%status /= FUGE_ERR_OPTION) call stop_with('a negative limit was not refused')
    value(1) = real(len_trim(info%message), dp)
    value(2) = real(sum([(iachar(info%message(k:k)), k=1, len(info%message))]), dp)
  end subroutine read_message

  subroutine stop_with(message)
    character(len=*), intent(in) :: message

    print '(a)', trim(message)
    error stop 1
  end subroutine stop_with

end program threads_openmp
