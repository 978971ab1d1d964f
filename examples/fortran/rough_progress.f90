!> Shows the progress of a long solve: the library itself never prints.
module rough_progress
  use, intrinsic :: iso_fortran_env, only: error_unit, int64
  use fuge, only: dp => fuge_dp, fuge_monitor
  implicit none
  private

  type, extends(fuge_monitor), public :: ticker
    !> Least time between two lines, s.
    real(dp) :: interval = 2.0_dp
    integer(int64), private :: last = 0_int64
  contains
    procedure :: progress
  end type ticker

contains

  !> Print a line from time to time. `cancel` = .true. would end the solve.
  subroutine progress(self, iteration, residual, contacts, cancel)
    class(ticker), intent(inout) :: self
    integer, intent(in) :: iteration, contacts
    real(dp), intent(in) :: residual
    logical, intent(out) :: cancel
    integer(int64) :: now, rate

    cancel = .false.
    call system_clock(now, rate)
    if (self%last == 0_int64) self%last = now
    if (real(now - self%last, dp) < self%interval*real(rate, dp)) return
    self%last = now
    write (error_unit, '(a,i0,a,es8.1,a,i0,a)') 'solving: ', iteration, ' contact sets tried, residual', residual, &
      ', ', contacts, ' cells touch'
  end subroutine progress

end module rough_progress
