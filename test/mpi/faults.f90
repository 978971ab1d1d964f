! Operators and monitors that fail on one rank.
module failing_ranks
  use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
  use fuge_kinds, only: dp, sp
  use fuge_monitor_type, only: fuge_monitor
  use fuge_mpi, only: fuge_mpi_halfspace_operator
  implicit none
  private

  ! From product number `last` on, rank 1 returns `failure`, or NaN in double precision if that is 0.
  type, extends(fuge_mpi_halfspace_operator), public :: failing_operator
    integer :: last = huge(1), failure = 0, rank = 0
    integer, pointer :: count => null()
  contains
    procedure :: apply => apply_failing
    procedure :: apply_single => apply_single_failing
  end type failing_operator

  ! Cancels the third iteration, or not.
  type, extends(fuge_monitor), public :: cancelling_monitor
    logical :: cancels = .false.
  contains
    procedure :: progress => cancel_third
  end type cancelling_monitor

contains

  subroutine apply_failing(self, force, displacement, status)
    class(failing_operator), intent(in) :: self
    real(dp), intent(in) :: force(:)
    real(dp), intent(out) :: displacement(:)
    integer, intent(out) :: status

    call self%fuge_mpi_halfspace_operator%apply(force, displacement, status)
    self%count = self%count + 1
    if (self%count < self%last .or. self%rank /= 1) return
    status = self%failure
    if (status == 0) displacement(1) = ieee_value(1.0_dp, ieee_quiet_nan)
  end subroutine apply_failing

  subroutine apply_single_failing(self, input, result, status)
    class(failing_operator), intent(in) :: self
    real(sp), intent(in) :: input(:)
    real(sp), intent(out) :: result(:)
    integer, intent(out) :: status

    call self%fuge_mpi_halfspace_operator%apply_single(input, result, status)
    self%count = self%count + 1
    if (self%count >= self%last .and. self%rank == 1 .and. self%failure /= 0) status = self%failure
  end subroutine apply_single_failing

  subroutine cancel_third(self, iteration, residual, contacts, cancel)
    class(cancelling_monitor), intent(inout) :: self
    integer, intent(in) :: iteration, contacts
    real(dp), intent(in) :: residual
    logical, intent(out) :: cancel

    cancel = iteration >= 3 .and. self%cancels .and. contacts >= 0 .and. residual >= 0.0_dp
  end subroutine cancel_third

end module failing_ranks

! What goes wrong on one rank ends the call on all ranks, with the same status and a message that names the rank.
program faults
  use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
  use failing_ranks, only: cancelling_monitor, failing_operator
  use fuge_halfspace_grid, only: FUGE_PERIODIC_X
  use fuge_kinds, only: dp
  use fuge_memory, only: physical_memory
  use fuge_mpi, only: fuge_mpi_halfplane_operator, fuge_mpi_halfspace_operator, fuge_mpi_read_rows, &
    fuge_mpi_write_rows
  use fuge_options_type, only: fuge_options
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_solver_type, only: fuge_solver
  use fuge_status, only: fuge_info, FUGE_DONE, FUGE_ERR_CALL_ORDER, FUGE_ERR_CALLBACK, FUGE_ERR_CANCELLED, &
    FUGE_ERR_FILE, FUGE_ERR_MEMORY, FUGE_ERR_MODULUS, FUGE_ERR_NOT_FINITE, FUGE_ERR_OPTION, FUGE_ERR_SIZE, &
    FUGE_ERR_UNSUPPORTED, FUGE_MESSAGE_LENGTH
  use mpi_f08
  implicit none

  integer, parameter :: NX = 200, NY = 190

  integer :: failures, rank, ranks

  failures = 0
  call before_mpi()
  call MPI_Init()
  call MPI_Comm_rank(MPI_COMM_WORLD, rank)
  call MPI_Comm_size(MPI_COMM_WORLD, ranks)
  call run()
  call MPI_Allreduce(MPI_IN_PLACE, failures, 1, MPI_INTEGER, MPI_SUM, MPI_COMM_WORLD)
  call MPI_Finalize()
  if (failures > 0) error stop 1

contains

  ! The library does not start MPI.
  subroutine before_mpi()
    type(fuge_mpi_halfspace_operator) :: operator
    type(fuge_info) :: info
    logical :: running

    call operator%set(8, 8, 1.0_dp, 1.0_dp, 1.0_dp, MPI_COMM_WORLD, info)
    call MPI_Initialized(running)
    if (info%status /= FUGE_ERR_CALL_ORDER .or. running) failures = failures + 1
  end subroutine before_mpi

  subroutine run()
    call refuse_grids()
    call refuse_problems()
    call fail_products()
    call refuse_files()
    call cancel()
    call fail_line()
    call solve_after_all()
  end subroutine run

  subroutine refuse_grids()
    type(fuge_mpi_halfspace_operator) :: operator
    type(fuge_info) :: info

    call operator%set(NX, NY + merge(2, 0, rank == 1), 1.0_dp, 1.0_dp, 1.0_dp, MPI_COMM_WORLD, info)
    call expect(info, FUGE_ERR_OPTION, 'the grid differs between the ranks')
    call operator%set(NX, merge(-1, NY, rank == 1), 1.0_dp, 1.0_dp, 1.0_dp, MPI_COMM_WORLD, info)
    call expect(info, FUGE_ERR_SIZE, 'rank 1: ny = -1')
    call operator%set(NX, NY, 1.0_dp, 1.0_dp, 1.0_dp, MPI_COMM_WORLD, info, boundary=FUGE_PERIODIC_X)
    call expect(info, FUGE_ERR_UNSUPPORTED, 'boundary = ')
    ! More than 50 GB, which a machine may have.
    if (physical_memory() > 5.0e10_dp) return
    call operator%set(46000, 46000, 1.0_dp, 1.0_dp, 1.0_dp, MPI_COMM_WORLD, info)
    call expect(info, FUGE_ERR_MEMORY, 'the part of the ranks on this machine')
  end subroutine refuse_grids

  subroutine refuse_problems()
    type(fuge_mpi_halfspace_operator) :: operator
    type(fuge_problem) :: problem
    type(fuge_solution) :: solution
    type(fuge_solver) :: solver
    type(fuge_info) :: info
    integer :: k

    call operator%set(NX, NY, 1.0_dp, 1.0_dp, 1.0_dp, MPI_COMM_WORLD, info)
    call expect(info, FUGE_DONE, '')
    call set_gaps(operator, problem)
    if (rank == 1) problem%gap(17) = ieee_value(1.0_dp, ieee_quiet_nan)
    call solver%solve(operator, problem, solution, info)
    call expect(info, FUGE_ERR_NOT_FINITE, 'rank 1: gap(17)')
    if (rank == 1) problem%gap = [problem%gap, 0.0_dp]
    call solver%solve(operator, problem, solution, info)
    call expect(info, FUGE_ERR_SIZE, 'rank 1: gap has')
    call set_gaps(operator, problem)
    problem%resultant = [1.0_dp + real(rank, dp)]
    call solver%solve(operator, problem, solution, info)
    call expect(info, FUGE_ERR_OPTION, 'a load, a prescribed motion or the stiffness of one differs')
    call set_gaps(operator, problem)
    call solver%solve(operator, problem, solution, info, fuge_options(tolerance=merge(2.0_dp, 1.0e-8_dp, rank == 1)))
    call expect(info, FUGE_ERR_OPTION, 'rank 1: tolerance = ')
    call solver%solve(operator, problem, solution, info, fuge_options(tolerance=merge(1.0e-6_dp, 1.0e-8_dp, rank == 1)))
    call expect(info, FUGE_ERR_OPTION, 'method, max_iterations, keep_history or tolerance of the options differs')
    call solver%solve(operator, problem, solution, info, fuge_options(keep_history=rank == 1))
    call expect(info, FUGE_ERR_OPTION, 'method, max_iterations, keep_history or tolerance of the options differs')
    ! On one rank only.
    if (rank == 1) allocate (problem%gap_upper(operator%points()), source=1.0_dp)
    call solver%solve(operator, problem, solution, info)
    call expect(info, FUGE_ERR_OPTION, 'modes, gap_upper, excluded, prescribed or the laws of points are not ' &
                //'allocated alike')
    call set_gaps(operator, problem)
    ! Modes of two bodies: the left and the right half.
    allocate (problem%modes(operator%points(), 2))
    problem%modes(:, 1) = [(merge(1.0_dp, 0.0_dp, modulo(k, NX) < NX/2), k=0, operator%points() - 1)]
    problem%modes(:, 2) = 1.0_dp - problem%modes(:, 1)
    problem%resultant = [1.0_dp, 2.0_dp]
    call solver%solve(operator, problem, solution, info)
    call expect(info, FUGE_ERR_UNSUPPORTED, 'mode 2 moves no point that mode 1 moves')
    call set_gaps(operator, problem)
    allocate (problem%excluded(operator%points()), source=.false.)
    if (rank == 1) problem%gap(3) = ieee_value(1.0_dp, ieee_quiet_nan)
    call solver%solve(operator, problem, solution, info)
    call expect(info, FUGE_ERR_NOT_FINITE, 'rank 1: gap(3)')
    call solver%derivative(operator, problem%gap, 1.0_dp, solution, info)
    call expect(info, FUGE_ERR_CALL_ORDER, 'there is no solution with a load')
    if (allocated(solution%force)) failures = failures + 1
  end subroutine refuse_problems

  ! A file that one rank cannot open.
  subroutine refuse_files()
    type(fuge_mpi_halfspace_operator) :: operator
    type(fuge_problem) :: problem
    real(dp), allocatable :: values(:)
    type(fuge_info) :: info
    character(len=*), parameter :: PATH = 'faults.npy'
    character(len=:), allocatable :: own_path

    own_path = PATH
    if (rank == 1) own_path = 'no_such_folder/'//PATH
    call operator%set(NX, NY, 1.0_dp, 1.0_dp, 1.0_dp, MPI_COMM_WORLD, info)
    call set_gaps(operator, problem)
    call fuge_mpi_write_rows(own_path, operator, problem%gap, info)
    call expect(info, FUGE_ERR_FILE, 'rank 1: no_such_folder/'//PATH//' cannot be opened for writing')
    call fuge_mpi_write_rows(PATH, operator, problem%gap, info)
    call expect(info, FUGE_DONE, '')
    call fuge_mpi_read_rows(own_path, operator, values, info)
    call expect(info, FUGE_ERR_FILE, 'rank 1: no_such_folder/'//PATH//' cannot be opened')
    if (allocated(values)) failures = failures + 1
  end subroutine refuse_files

  subroutine fail_products()
    type(failing_operator) :: operator
    type(fuge_problem) :: problem
    type(fuge_solution) :: solution
    type(fuge_solver) :: solver
    type(fuge_info) :: info
    integer, target :: count
    integer :: k

    call operator%set(NX, NY, 1.0_dp, 1.0_dp, 1.0_dp, MPI_COMM_WORLD, info)
    call set_gaps(operator, problem)
    operator%count => count
    operator%rank = rank
    do k = 1, 3
      operator%last = 2*k
      count = 0
      operator%failure = 7
      call solver%solve(operator, problem, solution, info)
      call expect(info, FUGE_ERR_CALLBACK, 'rank 1: ')
      count = 0
      operator%failure = FUGE_ERR_MEMORY
      call solver%solve(operator, problem, solution, info)
      call expect(info, FUGE_ERR_MEMORY, 'rank 1: ')
      count = 0
      operator%failure = 0
      call solver%solve(operator, problem, solution, info)
      call expect(info, FUGE_ERR_CALLBACK, 'rank 1: ')
    end do
    if (allocated(solution%force)) failures = failures + 1
  end subroutine fail_products

  subroutine cancel()
    type(fuge_mpi_halfspace_operator) :: operator
    type(cancelling_monitor) :: monitor
    type(fuge_problem) :: problem
    type(fuge_solution) :: solution
    type(fuge_solver) :: solver
    type(fuge_info) :: info

    call operator%set(NX, NY, 1.0_dp, 1.0_dp, 1.0_dp, MPI_COMM_WORLD, info)
    call set_gaps(operator, problem)
    monitor%cancels = rank == ranks - 1
    call solver%solve(operator, problem, solution, info, monitor=monitor)
    call expect(info, FUGE_ERR_CANCELLED, 'cancelled at iteration 3')
  end subroutine cancel

  ! The same of a half-plane.
  subroutine fail_line()
    integer, parameter :: N = 40000
    type(fuge_mpi_halfplane_operator) :: line
    type(cancelling_monitor) :: monitor
    type(fuge_problem) :: problem
    type(fuge_solution) :: solution
    type(fuge_solver) :: solver
    type(fuge_info) :: info
    integer :: k, cells(2)

    call line%set(N + merge(2, 0, rank == 1), 1.0_dp, 1.0_dp, MPI_COMM_WORLD, info)
    call expect(info, FUGE_ERR_OPTION, 'the grid differs between the ranks')
    call line%set(merge(-1, N, rank == 1), 1.0_dp, 1.0_dp, MPI_COMM_WORLD, info)
    call expect(info, FUGE_ERR_SIZE, 'rank 1: n = -1')
    call line%set(huge(N) - 9, 1.0_dp, 1.0_dp, MPI_COMM_WORLD, info)
    call expect(info, FUGE_ERR_MEMORY, 'n = 2147483638 needs a circle')
    call line%set(N, 1.0_dp, 1.0_dp, MPI_COMM_WORLD, info)
    call expect(info, FUGE_DONE, '')
    cells = line%own_rows()
    problem%gap = [(1.0e-6_dp*real(2*k - N, dp)**2, k=cells(1), cells(2))]
    problem%resultant = [1.0_dp]
    monitor%cancels = rank == ranks - 1
    call solver%solve(line, problem, solution, info, monitor=monitor)
    call expect(info, FUGE_ERR_CANCELLED, 'cancelled at iteration 3')
    if (rank == 1) problem%gap(7) = ieee_value(1.0_dp, ieee_quiet_nan)
    call solver%solve(line, problem, solution, info)
    call expect(info, FUGE_ERR_NOT_FINITE, 'rank 1: gap(7)')
    if (allocated(solution%force)) failures = failures + 1
  end subroutine fail_line

  subroutine solve_after_all()
    type(fuge_mpi_halfspace_operator) :: operator, other
    type(fuge_problem) :: problem
    type(fuge_solution) :: solution
    type(fuge_solver) :: solver
    type(fuge_info) :: info

    call operator%set(NX, NY, 1.0_dp, 1.0_dp, 1.0_dp, MPI_COMM_WORLD, info)
    call operator%set(NX, NY, 1.0_dp, 1.0_dp, -1.0_dp, MPI_COMM_WORLD, info)
    call expect(info, FUGE_ERR_MODULUS, '')
    other = operator
    call set_gaps(other, problem)
    call operator%free()
    call solver%solve(other, problem, solution, info)
    call expect(info, FUGE_DONE, '')
  end subroutine solve_after_all

  ! A sphere on cells of width 1.
  subroutine set_gaps(operator, problem)
    class(fuge_mpi_halfspace_operator), intent(in) :: operator
    type(fuge_problem), intent(out) :: problem
    integer :: i, j, rows(2)

    rows = operator%own_rows()
    allocate (problem%gap(operator%points()))
    do j = rows(1), rows(2)
      do i = 1, NX
        problem%gap(i + NX*(j - rows(1))) = 1.0e-4_dp*real((2*i - NX)**2 + (2*j - NY)**2, dp)
      end do
    end do
    problem%resultant = [1.0_dp]
  end subroutine set_gaps

  ! All ranks have this status, and the same message that begins like this.
  subroutine expect(info, status, message)
    type(fuge_info), intent(in) :: info
    integer, intent(in) :: status
    character(len=*), intent(in) :: message
    character(len=FUGE_MESSAGE_LENGTH) :: first

    first = info%message
    call MPI_Bcast(first, len(first), MPI_CHARACTER, 0, MPI_COMM_WORLD)
    if (info%status == status .and. index(info%message, message) == 1 .and. first == info%message) return
    failures = failures + 1
    write (*, '(a,i0,a,i0,4a)') 'rank ', rank, ': ', info%status, ' ', trim(info%message), ' instead of ', message
  end subroutine expect

end program faults
