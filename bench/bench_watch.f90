!> Repeated timing: the fastest of as many runs as fit into a fraction of a second. Other programs on the
!> machine can only add time; for that reason a long run is measured in processor time, if one thread does it.
module bench_watch
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge, only: dp => fuge_dp
  implicit none
  private

  !> Number of runs, and the time in seconds above which a run is not repeated.
  integer, parameter :: LEAST = 3, MOST = 1000
  real(dp), parameter :: SLOW = 2.0_dp
  !> From this time in seconds on the processor's clock is fine enough.
  real(dp), parameter :: LONG = 1.0e-3_dp

  type, public :: stopwatch
    integer :: runs = 0
    !> After three runs no more are made beyond this total time in seconds.
    real(dp) :: budget = 0.1_dp
    !> Time of the fastest run, and of all runs, in seconds.
    real(dp) :: best = huge(1.0_dp), spent = 0.0_dp
    !> Several threads work: elapsed time counts.
    logical :: elapsed = .false.
    !> Processor time of the fastest run, of all threads together.
    real(dp) :: processor = 0.0_dp
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
    processor = processor - self%began_processor
    if (time > LONG .and. .not. self%elapsed) time = min(time, processor)
    self%runs = self%runs + 1
    if (time < self%best) then
      self%best = time
      self%processor = processor
    end if
    self%spent = self%spent + time
  end subroutine stop_run

  pure function enough(self)
    class(stopwatch), intent(in) :: self
    logical :: enough

    enough = self%runs >= MOST .or. (self%runs >= LEAST .and. self%spent >= self%budget) .or. self%spent >= SLOW
  end function enough

end module bench_watch
