!> Runs CalculiX and reads its tables.
module calculix_files
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge, only: dp => fuge_dp
  implicit none
  private

  public :: wall_clock, processor_time, run_job, try_job, read_table, read_total, read_contact, count_iterations

contains

  !> Wall time, s.
  function wall_clock() result(seconds)
    real(dp) :: seconds
    integer(int64) :: ticks, rate

    call system_clock(ticks, rate)
    seconds = real(ticks, dp)/real(rate, dp)
  end function wall_clock

  !> Run `command -i job` and return the time it took, s. Its output goes to job.log. It has succeeded
  !> if the file `result` exists, because it may fail and return 0.
  subroutine run_job(command, job, result, seconds)
    character(len=*), intent(in) :: command, job, result
    real(dp), intent(out) :: seconds
    logical :: exists, ended

    seconds = wall_clock()
    call run_command('rm -f '//result, '"'//command//'"', job, ended)
    seconds = wall_clock() - seconds
    inquire (file=result, exist=exists)
    if (ended .and. exists) return
    print '(a)', command//' -i '//job//' has failed: see '//job//'.log'
    error stop 'no result from CalculiX'
  end subroutine run_job

  !> Run `command -i job` for at most `most` seconds of the processor, where the shell can limit them. `solved`: it has
  !> ended by itself, and without an error.
  subroutine try_job(command, job, most, solved)
    character(len=*), intent(in) :: command, job
    integer, intent(in) :: most
    logical, intent(out) :: solved
    character(len=24) :: limit

    write (limit, '(a,i0)') 'ulimit -t ', most
    call run_command('rm -f '//job//'.dat '//job//'.frd; '//trim(limit)//' 2>/dev/null', '"'//command//'"', job, solved)
  end subroutine try_job

  !> Run `prepare`, then `command -i job`, whose processor time goes to job.times.
  subroutine run_command(prepare, command, job, ended)
    character(len=*), intent(in) :: prepare, command, job
    logical, intent(out) :: ended
    integer :: failed, status

    failed = 0
    status = 0
    call execute_command_line(prepare//'; '//command//' -i '//job//' >'//job//'.log 2>&1; status=$?; times >'//job &
                              //'.times; exit $status', exitstat=status, cmdstat=failed)
    ended = failed == 0 .and. status == 0
  end subroutine run_command

  !> Processor time of the last run of a job, s. On a busy machine it tells more than wall time. The second line of
  !> job.times has that of the shell's children, as in 0m1.25s 0m0.05s: of the program, and of the system for it.
  function processor_time(job) result(seconds)
    character(len=*), intent(in) :: job
    real(dp) :: seconds
    character(len=80) :: line
    real(dp) :: parts(4)
    integer :: file, k, status

    open (newunit=file, file=job//'.times', status='old', action='read')
    read (file, '(/,a)', iostat=status) line
    close (file)
    do k = 1, len(line)
      if (index('ms', line(k:k)) > 0) line(k:k) = ' '
    end do
    if (status == 0) read (line, *, iostat=status) parts
    seconds = 0.0_dp
    if (status == 0) seconds = 60.0_dp*(parts(1) + parts(3)) + parts(2) + parts(4)
  end function processor_time

  pure function filled(text)
    character(len=*), intent(in) :: text
    logical :: filled

    filled = len_trim(text) > 0
  end function filled

  !> A table of job.dat: node and three values on each line. Of those whose heading begins
  !> with `heading`, the one with number `table`, or the last one.
  subroutine read_table(job, heading, node, value, table)
    character(len=*), intent(in) :: job, heading
    integer, allocatable, intent(out) :: node(:)
    real(dp), allocatable, intent(out) :: value(:, :)
    integer, intent(in), optional :: table
    character(len=256) :: line
    real(dp), allocatable :: values(:)
    real(dp) :: three(3)
    integer :: file, number, status

    open (newunit=file, file=job//'.dat', status='old', action='read')
    if (present(table)) then
      call skip_headings(file, heading, table)
    else
      call skip_headings(file, heading, headings(file, heading))
    end if
    allocate (node(0), values(0))
    read (file, '(a)') line
    do
      read (file, '(a)', iostat=status) line
      if (status /= 0 .or. .not. filled(line)) exit
      read (line, *) number, three
      node = [node, number]
      values = [values, three]
    end do
    close (file)
    value = reshape(values, [3, size(node)])
  end subroutine read_table

  !> Number of tables with this heading; the file is then positioned at its beginning.
  function headings(file, heading)
    integer, intent(in) :: file
    character(len=*), intent(in) :: heading
    integer :: headings
    character(len=256) :: line
    integer :: status

    headings = 0
    do
      read (file, '(a)', iostat=status) line
      if (status /= 0) exit
      if (index(line, ' '//heading) == 1) headings = headings + 1
    end do
    rewind (file)
    if (headings == 0) error stop 'a table is missing in the .dat file'
  end function headings

  subroutine skip_headings(file, heading, count)
    integer, intent(in) :: file, count
    character(len=*), intent(in) :: heading
    character(len=256) :: line
    integer :: found

    found = 0
    do while (found < count)
      read (file, '(a)') line
      if (index(line, ' '//heading) == 1) found = found + 1
    end do
  end subroutine skip_headings

  !> The sum of the forces on the set of nodes `name` in job.dat, the last one.
  subroutine read_total(job, name, force)
    character(len=*), intent(in) :: job, name
    real(dp), intent(out) :: force(3)
    character(len=256) :: line
    integer :: file, status

    force = 0.0_dp
    open (newunit=file, file=job//'.dat', status='old', action='read')
    do
      read (file, '(a)', iostat=status) line
      if (status /= 0) exit
      if (index(line, ' total force (fx,fy,fz) for set '//name//' ') == 1) read (file, *) force
    end do
    close (file)
  end subroutine read_total

  !> The last contact table of job.frd: nodes of the contact surface, and for each its gap, two components of slip, the
  !> pressure, and two shear stresses.
  subroutine read_contact(job, node, value)
    character(len=*), intent(in) :: job
    integer, allocatable, intent(out) :: node(:)
    real(dp), allocatable, intent(out) :: value(:, :)
    character(len=256) :: line
    real(dp), allocatable :: values(:)
    real(dp) :: six(6)
    integer :: file, number, status
    logical :: inside

    allocate (node(0), values(0))
    inside = .false.
    open (newunit=file, file=job//'.frd', status='old', action='read')
    do
      read (file, '(a)', iostat=status) line
      if (status /= 0) exit
      if (line(:13) == ' -4  CONTACT ') then
        inside = .true.
        node = [integer ::]
        values = [real(dp) ::]
      end if
      if (line(:3) == ' -3') inside = .false.
      if (.not. inside .or. line(:3) /= ' -1') cycle
      read (line, '(3x,i10,6e12.5)') number, six
      node = [node, number]
      values = [values, six]
    end do
    close (file)
    value = reshape(values, [6, size(node)])
  end subroutine read_contact

  !> Increments and all iterations of a job, those of failed attempts included: job.sta.
  subroutine count_iterations(job, increments, iterations)
    character(len=*), intent(in) :: job
    integer, intent(out) :: increments, iterations
    character(len=256) :: line
    character(len=16) :: attempt
    integer :: file, status, step, increment, times

    increments = 0
    iterations = 0
    open (newunit=file, file=job//'.sta', status='old', action='read', iostat=status)
    if (status /= 0) return
    read (file, '(/,a)', iostat=status) line
    do
      read (file, *, iostat=status) step, increment, attempt, times
      if (status /= 0) exit
      increments = max(increments, increment)
      iterations = iterations + times
    end do
    close (file)
  end subroutine count_iterations

end module calculix_files
