!> What the options of the program say about every solve.
module solver_options
  use command_line, only: arguments, refuse
  use fuge_core, only: fuge_info, fuge_options
  use number_words, only: read_integer
  implicit none
  private

  public :: take_solver_options

  !> Threads of a solve without --threads: as many as the process may use cores.
  integer, parameter :: ALL_CORES = 0

contains

  !> --threads. Error: FUGE_ERR_OPTION.
  subroutine take_solver_options(given, options, info)
    type(arguments), intent(in) :: given
    type(fuge_options), intent(inout) :: options
    type(fuge_info), intent(inout) :: info
    integer :: at, threads
    logical :: valid

    options%threads = ALL_CORES
    at = given%position('threads')
    if (at == 0 .or. info%failed()) return
    call read_integer(given%settings(at)%value, threads, valid)
    if (.not. valid .or. threads < 0) then
      call refuse(given%settings(at)%source//': a number of threads is needed, or 0 for all cores', info)
    else
      options%threads = threads
    end if
  end subroutine take_solver_options

end module solver_options
