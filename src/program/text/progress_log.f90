!> What the program has done so far, with times, on standard error.
module progress_log
  use, intrinsic :: iso_fortran_env, only: error_unit, int64
  implicit none
  private

  type, public :: progress
    logical :: wanted = .false.
    integer(int64), private :: begin = 0_int64
  contains
    procedure :: start
    procedure :: say
  end type progress

contains

  subroutine start(self, wanted)
    class(progress), intent(inout) :: self
    logical, intent(in) :: wanted

    self%wanted = wanted
    call system_clock(self%begin)
  end subroutine start

  !> A step that is done, after the seconds since the start.
  subroutine say(self, step)
    class(progress), intent(in) :: self
    character(len=*), intent(in) :: step
    integer(int64) :: now, rate

    if (.not. self%wanted) return
    call system_clock(now, rate)
    write (error_unit, '(a,f9.2,2a)') 'fuge:', real(now - self%begin)/real(rate), ' s  ', step
  end subroutine say

end module progress_log
