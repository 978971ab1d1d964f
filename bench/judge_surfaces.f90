!> Residuals and errors of the answers of other codes on areas.
!>
!>     judge_surfaces DIRECTORY
!>
!> reads DIRECTORY/area_answers.csv, a line for each answer, whose forces are in a file of its own; appends to
!> DIRECTORY/results.csv. Where there is a file NAME_N.reference of forces, the error of the answers is that against it.
program judge_surfaces
  use bench_answers, only: column, value, FAILURE, MEMORY, METHOD, NAME, TIME, TOLERANCE
  use bench_records, only: bench_row, open_table, write_row
  use bench_surface_judge, only: surface_judge
  use bench_surface_runs, only: new_area_row
  use bench_surfaces, only: bench_surface, make_surface
  use fuge, only: dp => fuge_dp
  implicit none

  call run()

contains

  subroutine run()
    character(len=256) :: directory
    character(len=400) :: line, last
    type(bench_surface) :: surface
    type(surface_judge) :: judge
    integer :: answers, table, stat

    call get_command_argument(1, directory)
    if (directory == '') error stop 'usage: judge_surfaces DIRECTORY'
    open (newunit=answers, file=trim(directory)//'/area_answers.csv', status='old', action='read')
    call open_table(directory, table)
    last = ''
    do
      read (answers, '(a)', iostat=stat) line
      if (stat /= 0) exit
      if (column(line, NAME) /= last) then
        call make_named(column(line, NAME), surface)
        ! All of them count the waves of a periodic surface, not its cells.
        call judge%prepare(surface, by_waves=.true.)
      end if
      last = column(line, NAME)
      call judge_one(surface, judge, trim(directory)//'/'//trim(last), line, table)
    end do
    call judge%free()
    close (answers)
    close (table)
  end subroutine run

  !> The surface NAME_N.
  subroutine make_named(words, surface)
    character(len=*), intent(in) :: words
    type(bench_surface), intent(out) :: surface
    integer :: n, bar

    bar = index(words, '_', back=.true.)
    read (words(bar + 1:), *) n
    call make_surface(words(:bar - 1), n, surface)
  end subroutine make_named

  subroutine judge_one(surface, judge, stem, line, table)
    type(bench_surface), intent(in) :: surface
    type(surface_judge), intent(inout) :: judge
    character(len=*), intent(in) :: stem, line
    integer, intent(in) :: table
    type(bench_row) :: row
    real(dp), allocatable :: force(:), reference(:)

    row = new_area_row(surface)
    row%method = column(line, METHOD)
    row%tolerance = value(column(line, TOLERANCE))
    row%time = value(column(line, TIME))
    row%first = row%time
    row%memory = value(column(line, MEMORY))
    row%failure = column(line, FAILURE)
    if (row%failure == '') then
      call read_forces(stem//'.'//trim(column(line, METHOD))//column(line, TOLERANCE), size(surface%gap), force)
      call judge%judge(surface, force, row)
      call read_forces(stem//'.reference', size(surface%gap), reference)
      if (allocated(reference)) row%error_solver = sum(abs(force - reference))/surface%load
    end if
    call write_row(table, row)
  end subroutine judge_one

  !> `force` (n); not allocated without the file.
  subroutine read_forces(path, n, force)
    character(len=*), intent(in) :: path
    integer, intent(in) :: n
    real(dp), allocatable, intent(out) :: force(:)
    integer :: stat, unit

    open (newunit=unit, file=path, access='stream', form='unformatted', status='old', action='read', iostat=stat)
    if (stat /= 0) return
    allocate (force(n))
    read (unit) force
    close (unit)
  end subroutine read_forces

end program judge_surfaces
