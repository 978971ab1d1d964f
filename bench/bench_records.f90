!> Output of the benchmark: rows of one table, and problems as raw files for other solvers.
module bench_records
  use bench_problems, only: bench_problem, whole
  use fuge, only: dp => fuge_dp, FUGE_CENTRE, FUGE_HAT
  implicit none
  private

  public :: open_table, write_row, write_problem, element_name, number

  !> One measurement; doc/performance.md explains the columns. Negative: not known, written as
  !> an empty column.
  type, public :: bench_row
    character(len=20) :: problem = '', method = '', element = ''
    integer :: n = 0, unknowns = -1, work = -1, preconditionings = -1
    real(dp) :: time = -1.0_dp, residual = -1.0_dp
    real(dp) :: error_half_width = -1.0_dp, error_pressure = -1.0_dp, error_force = -1.0_dp
    real(dp) :: memory = -1.0_dp
    real(dp) :: error_approach = -1.0_dp, error_solver = -1.0_dp
    real(dp) :: tolerance = -1.0_dp, setup = -1.0_dp, limit = -1.0_dp
    !> Areas only: operator and first solve; error of the largest pressure.
    real(dp) :: first = -1.0_dp, error_peak = -1.0_dp
    !> Points at the limit of their force.
    integer :: limited = -1
    character(len=60) :: failure = ''
  end type bench_row

contains

  !> DIRECTORY/results.csv, to append to; with a header if it is new.
  subroutine open_table(directory, unit)
    character(len=*), intent(in) :: directory
    integer, intent(out) :: unit
    logical :: exists

    inquire (file=trim(directory)//'/results.csv', exist=exists)
    open (newunit=unit, file=trim(directory)//'/results.csv', position='append', action='write')
    if (.not. exists) write (unit, '(a)') 'problem,method,element,n,unknowns,products_or_pivots,time_s,' &
      //'time_over_limit,residual,error_halfwidth,error_pressure,error_force_max,memory_bytes,error_approach,' &
      //'error_solver,tolerance,setup_s,limit_s,preconditionings,first_s,error_peak,limited,failure'
  end subroutine open_table

  subroutine write_row(unit, row)
    integer, intent(in) :: unit
    type(bench_row), intent(in) :: row
    real(dp) :: ratio

    ratio = -1.0_dp
    if (row%limit > 0.0_dp) ratio = row%time/row%limit
    write (unit, '(*(a))') trim(row%problem), ',', trim(row%method), ',', trim(row%element), ',', whole(row%n), &
      ',', count_or_blank(row%unknowns), ',', count_or_blank(row%work), ',', number(row%time), ',', number(ratio), &
      ',', number(row%residual), ',', number(row%error_half_width), ',', number(row%error_pressure), &
      ',', number(row%error_force), ',', number(row%memory), ',', number(row%error_approach), &
      ',', number(row%error_solver), ',', number(row%tolerance), ',', number(row%setup), ',', number(row%limit), &
      ',', count_or_blank(row%preconditionings), ',', number(row%first), ',', number(row%error_peak), &
      ',', count_or_blank(row%limited), ',', trim(without_commas(row%failure))
    flush (unit)
  end subroutine write_row

  pure function without_commas(words) result(field)
    character(len=*), intent(in) :: words
    character(len=len(words)) :: field
    integer :: k

    field = words
    do k = 1, len(words)
      if (field(k:k) == ',') field(k:k) = ';'
    end do
  end function without_commas

  pure function count_or_blank(value) result(field)
    integer, intent(in) :: value
    character(len=:), allocatable :: field

    field = ''
    if (value >= 0) field = whole(value)
  end function count_or_blank

  pure function number(value) result(field)
    real(dp), intent(in) :: value
    character(len=:), allocatable :: field
    character(len=16) :: buffer

    field = ''
    if (value < 0.0_dp) return
    write (buffer, '(es10.3)') value
    field = trim(adjustl(buffer))
  end function number

  pure function element_name(element) result(name)
    integer, intent(in) :: element
    character(len=:), allocatable :: name

    name = 'mean'
    if (element == FUGE_CENTRE) name = 'centre'
    if (element == FUGE_HAT) name = 'hat'
  end function element_name

  !> NAME.bin: gaps, the forces that fuge found, tilt and its resultant (if there is one), alpha by
  !> columns (if there is one), 8 bytes each. NAME.txt: what they are.
  subroutine write_problem(directory, problem, row, force)
    character(len=*), intent(in) :: directory
    type(bench_problem), intent(in) :: problem
    type(bench_row), intent(in) :: row
    real(dp), intent(in) :: force(:)
    character(len=:), allocatable :: path
    integer :: unit

    path = trim(directory)//'/'//trim(row%problem)//'_'//whole(problem%points())
    open (newunit=unit, file=path//'.bin', access='stream', form='unformatted', status='replace', action='write')
    write (unit) problem%gap, force
    if (allocated(problem%modes)) write (unit) problem%modes(:, 2), problem%resultant(2)
    if (allocated(problem%alpha)) write (unit) problem%alpha
    close (unit)
    open (newunit=unit, file=path//'.txt', status='replace', action='write')
    write (unit, '(2a)') 'problem ', trim(row%problem)
    if (row%element /= '') write (unit, '(2a)') 'element ', trim(row%element)
    write (unit, '(a,i0)') 'n ', problem%points()
    write (unit, '(a,i0)') 'tilts ', merge(1, 0, allocated(problem%modes))
    write (unit, '(a,i0)') 'matrix ', merge(1, 0, allocated(problem%alpha))
    write (unit, '(a,i0)') 'periodic ', problem%boundary
    write (unit, '(a,es24.16)') 'load ', problem%load
    write (unit, '(a,es24.16)') 'e_star ', problem%e_star
    write (unit, '(a,es24.16)') 'setup ', row%setup
    write (unit, '(a,es24.16)') 'limit ', row%limit
    if (allocated(problem%width)) write (unit, '(a,es24.16)') 'width ', problem%width(1)
    close (unit)
  end subroutine write_problem

end module bench_records
