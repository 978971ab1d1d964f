!> Repeated timing: the median of as many runs as a second allows.
module bench_watch
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge, only: dp
  implicit none
  private

  !> Runs, and the time in seconds of one that is not repeated.
  integer, parameter :: LEAST = 3, MOST = 1001
  real(dp), parameter :: SLOW = 5.0_dp

  type, public :: stopwatch
    integer :: runs = 0
    !> The time in seconds that is enough once there are three runs.
    real(dp) :: budget = 1.0_dp
    real(dp), private :: samples(MOST) = 0.0_dp
    integer(int64), private :: began = 0
  contains
    procedure :: start
    procedure :: stop => stop_run
    procedure :: enough
    procedure :: median
  end type stopwatch

contains

  subroutine start(self)
    class(stopwatch), intent(inout) :: self

    call system_clock(self%began)
  end subroutine start

  subroutine stop_run(self)
    class(stopwatch), intent(inout) :: self
    integer(int64) :: now, rate

    call system_clock(now, rate)
    self%runs = self%runs + 1
    self%samples(self%runs) = real(now - self%began, dp)/real(rate, dp)
  end subroutine stop_run

  pure function enough(self)
    class(stopwatch), intent(in) :: self
    logical :: enough

    associate (spent => sum(self%samples(:self%runs)))
      enough = self%runs >= MOST .or. (self%runs >= LEAST .and. spent >= self%budget) .or. spent >= LEAST*SLOW &
        .or. (self%runs == 1 .and. spent >= SLOW)
    end associate
  end function enough

  !> Of all runs, in seconds.
  pure function median(self)
    class(stopwatch), intent(in) :: self
    real(dp) :: median
    real(dp) :: sorted(self%runs), value
    integer :: i, j

    sorted = self%samples(:self%runs)
    do j = 2, size(sorted)
      value = sorted(j)
      do i = j - 1, 1, -1
        if (sorted(i) <= value) exit
        sorted(i + 1) = sorted(i)
      end do
      sorted(i + 1) = value
    end do
    median = 0.5_dp*(sorted((size(sorted) + 1)/2) + sorted(size(sorted)/2 + 1))
  end function median

end module bench_watch
