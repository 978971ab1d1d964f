!> Repeated timing: the fastest of as many runs as a part of a second allows. What others do
!> on the machine only ever adds time; a long run counts by its processor time for that reason.
module bench_watch
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge, only: dp => fuge_dp
  implicit none
  private

  !> Runs, and the time in seconds of one that is not repeated.
  integer, parameter :: LEAST = 3, MOST = 1000
  real(dp), parameter :: SLOW = 2.0_dp
  !> Seconds from which on the processor's clock is fine enough.
  real(dp), parameter :: LONG = 1.0e-3_dp

  type, public :: stopwatch
    integer :: runs = 0
    !> The time in seconds that is enough once there are three runs.
    real(dp) :: budget = 0.1_dp
    !> Of the fastest run, and of all, in seconds.
    real(dp) :: best = huge(1.0_dp), spent = 0.0_dp
    integer(int64), private :: began = 0
    real(dp), private :: began_processor = 0.0_dp
  contains
    procedure :: start
    procedure :: stop => stop_run
    procedure :: enough
  end type stopwatch

contains

  subroutine start(self)
    class(stopwatch), intent(inout) :: self

    call cpu_time(self%began_processor)
    call system_clock(self%began)
  end subroutine start

  subroutine stop_run(self)
    class(stopwatch), intent(inout) :: self
    integer(int64) :: now, rate
    real(dp) :: time, processor

    call system_clock(now, rate)
    call cpu_time(processor)
    time = real(now - self%began, dp)/real(rate, dp)
    if (time > LONG) time = min(time, processor - self%began_processor)
    self%runs = self%runs + 1
    self%best = min(self%best, time)
    self%spent = self%spent + time
  end subroutine stop_run

  pure function enough(self)
    class(stopwatch), intent(in) :: self
    logical :: enough

    enough = self%runs >= MOST .or. (self%runs >= LEAST .and. self%spent >= self%budget) .or. self%spent >= SLOW
  end function enough

end module bench_watch
