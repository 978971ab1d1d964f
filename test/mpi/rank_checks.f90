! What programs for several ranks expect: the solution of one process, on rank 0.
module rank_checks
  use fuge_kinds, only: dp
  use fuge_operator_type, only: fuge_operator
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_solver_type, only: fuge_solver
  use fuge_status, only: fuge_info, FUGE_DONE
  use mpi_f08
  implicit none
  private

  public :: begin_checks, check_solution, check_solves, end_checks, expect, gather, my_rank

  type :: counters
    integer :: failures = 0, rank = 0
  end type counters

  type(counters) :: now

contains

  subroutine begin_checks()
    call MPI_Init()
    call MPI_Comm_rank(MPI_COMM_WORLD, now%rank)
  end subroutine begin_checks

  ! Fails on all ranks if something was not as expected on any.
  subroutine end_checks()
    call MPI_Allreduce(MPI_IN_PLACE, now%failures, 1, MPI_INTEGER, MPI_SUM, MPI_COMM_WORLD)
    call MPI_Finalize()
    if (now%failures > 0) error stop 1
  end subroutine end_checks

  function my_rank() result(rank)
    integer :: rank

    rank = now%rank
  end function my_rank

  subroutine expect(true, what)
    logical, intent(in) :: true
    character(len=*), intent(in) :: what

    if (true) return
    now%failures = now%failures + 1
    write (*, '(a,i0,2a)') 'rank ', now%rank, ', not as expected: ', what
  end subroutine expect

  ! Compare on rank 0 what the ranks have found with what one process has: counts, which may differ by `counts`, and
  ! contact set; forces, gaps and motions to `accuracy`.
  subroutine check_solution(name, accuracy, counts, info, solution, whole_info, expected)
    character(len=*), intent(in) :: name
    real(dp), intent(in) :: accuracy
    integer, intent(in) :: counts
    type(fuge_info), intent(in) :: info, whole_info
    type(fuge_solution), intent(in) :: solution, expected
    real(dp), allocatable :: force(:), gap(:)
    real(dp) :: largest

    call gather(solution%force, force)
    call gather(solution%gap, gap)
    if (now%rank > 0) return
    call expect(size(force) == size(expected%force), name//': number of points')
    call expect(info%status == whole_info%status, name//': status')
    call expect(abs(info%products - whole_info%products) <= counts, name//': products')
    call expect(abs(info%preconditionings - whole_info%preconditionings) <= counts, name//': preconditionings')
    call expect(abs(info%iterations - whole_info%iterations) <= counts, name//': contact sets')
    call expect(info%contacts == whole_info%contacts, name//': number of contacts')
    call expect(info%message == whole_info%message, name//': '//trim(info%message)//' / '//trim(whole_info%message))
    call expect(all((force > 0.0_dp) .eqv. (expected%force > 0.0_dp)), name//': contact set')
    call expect(all((force < 0.0_dp) .eqv. (expected%force < 0.0_dp)), name//': contact set at upper stops')
    largest = maxval(abs(expected%force))
    call expect(maxval(abs(force - expected%force)) <= accuracy*largest, name//': forces')
    largest = maxval(abs(expected%gap))
    call expect(maxval(abs(gap - expected%gap)) <= accuracy*largest, name//': gaps')
    call expect(all(abs(solution%motion - expected%motion) <= accuracy*maxval(abs(expected%motion))), &
                name//': motions')
    write (*, '(a,t36,4i6,es10.2,2x,a)') name, info%iterations, info%products, info%preconditionings, info%contacts, &
      maxval(abs(force - expected%force))/max(maxval(abs(expected%force)), tiny(1.0_dp)), trim(info%message)
  end subroutine check_solution

  ! The load of `problem`, more of it from the first solution, and a prescribed approach: the first `solves` of them.
  ! `whole` and `whole_problem`, those of one process, matter on rank 0; accuracy and counts as in `check_solution`.
  subroutine check_solves(name, accuracy, counts, solves, shared, whole, problem, whole_problem)
    character(len=*), intent(in) :: name
    real(dp), intent(in) :: accuracy
    integer, intent(in) :: counts, solves
    class(fuge_operator), intent(in) :: shared, whole
    type(fuge_problem), intent(inout) :: problem, whole_problem
    type(fuge_solution) :: solution, expected
    type(fuge_solver) :: solver, whole_solver
    type(fuge_info) :: info, whole_info
    real(dp) :: load
    integer :: k

    load = problem%resultant(1)
    do k = 1, solves
      call solver%solve(shared, problem, solution, info)
      call expect(info%status == FUGE_DONE, name//': '//trim(info%message))
      if (info%failed()) return
      if (now%rank == 0) call whole_solver%solve(whole, whole_problem, expected, whole_info)
      call check_solution(name, accuracy, counts, info, solution, whole_info, expected)
      problem%resultant = [1.1_dp*load]
      whole_problem%resultant = problem%resultant
      if (k == 2) then
        problem%prescribed = [.true.]
        problem%motion = 0.7_dp*solution%motion
        whole_problem%prescribed = problem%prescribed
        whole_problem%motion = problem%motion
      end if
    end do
  end subroutine check_solves

  ! `all_values` on rank 0: those of all ranks.
  subroutine gather(values, all_values)
    real(dp), intent(in) :: values(:)
    real(dp), allocatable, intent(out) :: all_values(:)
    integer, allocatable :: counts(:), begins(:)
    integer :: r, ranks

    call MPI_Comm_size(MPI_COMM_WORLD, ranks)
    allocate (counts(0:ranks - 1), begins(0:ranks - 1))
    call MPI_Gather(size(values), 1, MPI_INTEGER, counts, 1, MPI_INTEGER, 0, MPI_COMM_WORLD)
    if (now%rank > 0) counts = 0
    begins(0) = 0
    do r = 1, ranks - 1
      begins(r) = begins(r - 1) + counts(r - 1)
    end do
    allocate (all_values(sum(counts)))
    call MPI_Gatherv(values, size(values), MPI_DOUBLE_PRECISION, all_values, counts, begins, MPI_DOUBLE_PRECISION, 0, &
                     MPI_COMM_WORLD)
  end subroutine gather

end module rank_checks
