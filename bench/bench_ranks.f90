!> What measurements of ranks beside one process share.
module bench_ranks
  use fuge, only: fuge_problem
  use mpi_f08
  implicit none
  private

  public :: part_of, wait_for_rank_0

contains

  !> The points `first` to `last` of a contact problem of bench_general_scenes: compliances and loads of points, which
  !> these do not have, would stay whole.
  pure function part_of(problem, first, last) result(part)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: first, last
    type(fuge_problem) :: part

    part = problem
    part%gap = problem%gap(first:last)
    if (allocated(problem%modes)) part%modes = problem%modes(first:last, :)
    if (allocated(problem%limit)) part%limit = problem%limit(first:last)
    if (allocated(problem%excluded)) part%excluded = problem%excluded(first:last)
    if (allocated(problem%gap_upper)) part%gap_upper = problem%gap_upper(first:last)
  end function part_of

  !> The other ranks sleep, so that they take no time from rank 0.
  subroutine wait_for_rank_0()
    type(MPI_Request) :: request
    logical :: done

    call MPI_Ibarrier(MPI_COMM_WORLD, request)
    done = .false.
    do while (.not. done)
      call execute_command_line('sleep 0.01')
      call MPI_Test(request, done, MPI_STATUS_IGNORE)
    end do
  end subroutine wait_for_rank_0

end module bench_ranks
