!> Resident memory of this process, and memory that the machine has left, as Linux reports them; unknown on other
!> systems.
module bench_memory
  use fuge, only: dp => fuge_dp
  implicit none
  private

  public :: available, forget_peak, resident, peak_resident

contains

  !> Reset the peak to the memory that is resident now. `done`: the reset has worked.
  subroutine forget_peak(done)
    logical, intent(out) :: done
    integer :: unit, stat

    open (newunit=unit, file='/proc/self/clear_refs', action='write', status='old', iostat=stat)
    done = stat == 0
    if (.not. done) return
    write (unit, '(a)', iostat=stat) '5'
    done = stat == 0
    close (unit, iostat=stat)
    done = done .and. stat == 0
  end subroutine forget_peak

  function resident() result(bytes)
    real(dp) :: bytes

    bytes = value_in('/proc/self/status', 'VmRSS:')
  end function resident

  function peak_resident() result(bytes)
    real(dp) :: bytes

    bytes = value_in('/proc/self/status', 'VmHWM:')
  end function peak_resident

  !> What a process may still use without swapping; negative where that is not known.
  function available() result(bytes)
    real(dp) :: bytes

    bytes = value_in('/proc/meminfo', 'MemAvailable:')
  end function available

  !> The value of a line like "VmHWM:      1760 kB" of a file; negative if there is none.
  function value_in(path, word) result(bytes)
    character(len=*), intent(in) :: path, word
    real(dp) :: bytes
    character(len=80) :: line
    integer :: unit, stat

    bytes = -1.0_dp
    open (newunit=unit, file=path, action='read', status='old', iostat=stat)
    if (stat /= 0) return
    do
      read (unit, '(a)', iostat=stat) line
      if (stat /= 0) exit
      if (index(line, word) /= 1) cycle
      line = line(len(word) + 1:index(line, 'kB') - 1)
      if (iachar(line(1:1)) == 9) line(1:1) = ' '
      read (line, *, iostat=stat) bytes
      if (stat == 0) bytes = 1024.0_dp*bytes
      exit
    end do
    close (unit)
  end function value_in

end module bench_memory
