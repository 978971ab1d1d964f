!> The general scenes of general_scenes on ranks that share the surface, beside one process.
!>
!>     mpirun -n RANKS general_scenes_mpi [n]     n x n cells; 1024 by default
!>
!> Prints a table: products + preconditionings of one process and of the ranks, the times of both in milliseconds and
!> their ratio. Rank 0 alone and all ranks solve in turn, and the least time of each counts.
program general_scenes_mpi
  use bench_general_scenes, only: problem_of, SCENES, SURFACES
  use bench_problems, only: whole
  use bench_ranks, only: part_of, wait_for_rank_0
  use bench_surfaces, only: bench_surface, make_surface, set_operator
  use fuge, only: dp => fuge_dp, fuge_halfspace_operator, fuge_info, fuge_operator, fuge_options, fuge_problem, &
    fuge_solution, fuge_solver, FUGE_ITERATIVE
  use fuge_mpi, only: fuge_mpi_halfspace_operator
  use mpi_f08
  implicit none

  real(dp), parameter :: TOLERANCE = 1.0e-8_dp
  !> Solves of each scene, of which the fastest counts.
  integer, parameter :: ROUNDS = 3

  integer :: n, rank, ranks, surface
  character(len=16) :: argument

  call MPI_Init()
  call MPI_Comm_rank(MPI_COMM_WORLD, rank)
  call MPI_Comm_size(MPI_COMM_WORLD, ranks)
  n = 1024
  call get_command_argument(1, argument)
  if (argument /= '') read (argument, *) n
  if (rank == 0) then
    print '(a)', '| '//whole(n)//' x '//whole(n)//' cells | one process | '//whole(ranks)//' ranks | ' &
      //'one process, ms | '//whole(ranks)//' ranks, ms | ratio |', '| --- | ---: | ---: | ---: | ---: | ---: |'
  end if
  do surface = 1, size(SURFACES)
    call measure_surface(trim(SURFACES(surface)))
  end do
  call MPI_Finalize()

contains

  !> The rows of a surface.
  subroutine measure_surface(name)
    character(len=*), intent(in) :: name
    type(bench_surface) :: surface
    type(fuge_halfspace_operator) :: whole_operator
    type(fuge_mpi_halfspace_operator) :: shared
    type(fuge_problem) :: problem
    type(fuge_info) :: alone, together
    real(dp) :: times(2)
    integer :: k, round, rows(2)

    call make_surface(name, n, surface)
    if (rank == 0) call set_operator(surface, whole_operator)
    call shared%set(n, n, surface%cell(), surface%cell(), 1.0_dp, MPI_COMM_WORLD, together, element=surface%element, &
                    boundary=surface%boundary)
    if (together%failed()) error stop 'the ranks have no operator'
    rows = shared%own_rows()
    do k = 1, size(SCENES)
      problem = problem_of(surface, k)
      times = huge(times)
      do round = 1, ROUNDS
        if (rank == 0) call time_solve(whole_operator, problem, times(1), alone)
        call wait_for_rank_0()
        call MPI_Barrier(MPI_COMM_WORLD)
        call time_solve(shared, part_of(problem, n*(rows(1) - 1) + 1, n*rows(2)), times(2), together)
      end do
      if (rank == 0) print '(a,2(1x,i0,a,i0,a),2(1x,i0,a),f5.2,a)', '| '//name//', '//trim(SCENES(k))//' |', &
        alone%products, ' + ', alone%preconditionings, ' |', together%products, ' + ', together%preconditionings, &
        ' |', nint(1.0e3_dp*times(1)), ' |', nint(1.0e3_dp*times(2)), ' |', times(1)/times(2), ' |'
    end do
  end subroutine measure_surface

  !> `best`: the lesser of it and the time of a solve from scratch.
  subroutine time_solve(operator, problem, best, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(inout) :: best
    type(fuge_info), intent(out) :: info
    type(fuge_solution) :: solution
    type(fuge_solver) :: solver
    real(dp) :: start

    start = MPI_Wtime()
    call solver%solve(operator, problem, solution, info, fuge_options(FUGE_ITERATIVE, tolerance=TOLERANCE))
    best = min(best, MPI_Wtime() - start)
    if (info%status /= 0) error stop 'a scene is not solved'
  end subroutine time_solve

end program general_scenes_mpi
