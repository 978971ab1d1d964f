!> The bandwidth of the memory to as many threads: a = b + s c on arrays that no cache holds, 24 bytes for each number.
module bench_bandwidth
  use bench_watch, only: stopwatch
  use fuge, only: dp => fuge_dp
  use fuge_threads, only: run_in_parts, share, thread_team, work_in_parts
  implicit none
  private

  public :: bandwidth

  integer, parameter :: NUMBERS = 2**23, RUNS = 10
  real(dp), parameter :: BYTES_OF_NUMBER = 24.0_dp

  type, extends(work_in_parts) :: triad
    real(dp), allocatable :: a(:), b(:), c(:)
  contains
    procedure :: do_part => add_part
  end type triad

contains

  !> Bytes/s of `threads` together.
  function bandwidth(threads) result(rate)
    integer, intent(in) :: threads
    real(dp) :: rate
    type(thread_team) :: team
    type(triad) :: arrays
    type(stopwatch) :: watch
    integer :: k

    allocate (arrays%a(NUMBERS), source=0.0_dp)
    allocate (arrays%b(NUMBERS), source=1.0_dp)
    allocate (arrays%c(NUMBERS), source=2.0_dp)
    watch%elapsed = .true.
    call team%begin(threads)
    do k = 1, RUNS
      call watch%start()
      call run_in_parts(threads, arrays)
      call watch%stop()
    end do
    call team%end()
    rate = BYTES_OF_NUMBER*real(NUMBERS, dp)/watch%best
  end function bandwidth

  subroutine add_part(self, part, parts)
    class(triad), intent(inout) :: self
    integer, intent(in) :: part, parts
    integer :: first, last

    call share(NUMBERS, part, parts, first, last)
    call add(self%a(first + 1:last + 1), self%b(first + 1:last + 1), self%c(first + 1:last + 1))
  end subroutine add_part

  pure subroutine add(a, b, c)
    real(dp), intent(inout) :: a(:)
    real(dp), intent(in) :: b(:), c(:)

    a = b + 0.5_dp*c
  end subroutine add

end module bench_bandwidth
