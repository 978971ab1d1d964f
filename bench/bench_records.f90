!> What the benchmark writes: rows of a table, and problems as raw files for other solvers.
module bench_records
  use bench_problems, only: bench_problem
  use fuge, only: dp
  implicit none
  private

  public :: write_header, write_row, write_problem
  public :: write_iterative_header, write_iterative_row, write_profile

  !> One measurement. Negative: not known, an empty field.
  type, public :: bench_row
    character(len=16) :: problem = '', method = '', element = ''
    integer :: n = 0, unknowns = 0, work = -1
    real(dp) :: time = -1.0_dp, limit = -1.0_dp, residual = -1.0_dp
    real(dp) :: error_half_width = -1.0_dp, error_pressure = -1.0_dp, error_force = -1.0_dp
    real(dp) :: memory = -1.0_dp
  end type bench_row

  !> One measurement of the iterative engine, or of a part of it. Negative: not known.
  type, public :: iterative_row
    character(len=16) :: problem = '', method = '', element = ''
    integer :: n = 0, unknowns = -1, products = -1, filters = -1, iterations = -1
    real(dp) :: time = -1.0_dp, product_time = -1.0_dp, residual = -1.0_dp, tolerance = -1.0_dp
    !> Largest resident memory, less what there was before the operator.
    real(dp) :: memory = -1.0_dp
    real(dp) :: error_half_width = -1.0_dp, error_pressure = -1.0_dp
    character(len=60) :: failure = ''
  end type iterative_row

contains

  subroutine write_header(unit)
    integer, intent(in) :: unit

    write (unit, '(a)') 'problem,method,element,n,unknowns,products_or_pivots,time_s,time_over_limit,residual,' &
      //'error_halfwidth,error_pressure,error_force_max,memory_bytes'
  end subroutine write_header

  subroutine write_row(unit, row)
    integer, intent(in) :: unit
    type(bench_row), intent(in) :: row
    real(dp) :: ratio

    ratio = -1.0_dp
    if (row%limit > 0.0_dp) ratio = row%time/row%limit
    write (unit, '(*(a))') trim(row%problem), ',', trim(row%method), ',', trim(row%element), ',', whole(row%n), &
      ',', whole(row%unknowns), ',', whole(row%work), ',', number(row%time), ',', number(ratio), &
      ',', number(row%residual), ',', number(row%error_half_width), ',', number(row%error_pressure), &
      ',', number(row%error_force), ',', number(row%memory)
    flush (unit)
  end subroutine write_row

  subroutine write_iterative_header(unit)
    integer, intent(in) :: unit

    write (unit, '(a)') 'problem,method,element,n,unknowns,products,filters,iterations,time_s,time_over_product,' &
      //'residual,tolerance,memory_bytes,error_halfwidth,error_pressure,failure'
  end subroutine write_iterative_header

  subroutine write_iterative_row(unit, row)
    integer, intent(in) :: unit
    type(iterative_row), intent(in) :: row
    real(dp) :: ratio

    ratio = -1.0_dp
    if (row%product_time > 0.0_dp .and. row%time >= 0.0_dp) ratio = row%time/row%product_time
    write (unit, '(*(a))') trim(row%problem), ',', trim(row%method), ',', trim(row%element), ',', whole(row%n), &
      ',', whole(row%unknowns), ',', whole(row%products), ',', whole(row%filters), ',', whole(row%iterations), &
      ',', number(row%time), ',', number(ratio), ',', number(row%residual), ',', number(row%tolerance), &
      ',', number(row%memory), ',', number(row%error_half_width), ',', number(row%error_pressure), &
      ',', trim(without_commas(row%failure))
    flush (unit)
  end subroutine write_iterative_row

  pure function without_commas(words) result(field)
    character(len=*), intent(in) :: words
    character(len=len(words)) :: field
    integer :: k

    field = words
    do k = 1, len(words)
      if (field(k:k) == ',') field(k:k) = ';'
    end do
  end function without_commas

  pure function whole(value) result(field)
    integer, intent(in) :: value
    character(len=:), allocatable :: field
    character(len=12) :: buffer

    field = ''
    if (value < 0) return
    write (buffer, '(i0)') value
    field = trim(buffer)
  end function whole

  pure function number(value) result(field)
    real(dp), intent(in) :: value
    character(len=:), allocatable :: field
    character(len=16) :: buffer

    field = ''
    if (value < 0.0_dp) return
    write (buffer, '(es10.3)') value
    field = trim(adjustl(buffer))
  end function number

  !> NAME.bin: alpha by columns, gaps, the forces that fuge found, 8 bytes each.
  !> NAME.txt: number of points and load.
  subroutine write_problem(directory, problem, force)
    character(len=*), intent(in) :: directory
    type(bench_problem), intent(in) :: problem
    real(dp), intent(in) :: force(:)
    integer :: unit

    open (newunit=unit, file=directory//'/'//trim(problem%name)//'.bin', access='stream', form='unformatted', &
          status='replace', action='write')
    write (unit) problem%alpha, problem%gap, force
    close (unit)
    open (newunit=unit, file=directory//'/'//trim(problem%name)//'.txt', status='replace', action='write')
    write (unit, '(a,i0)') 'n ', size(problem%gap)
    write (unit, '(a,es24.16)') 'load ', problem%load
    close (unit)
  end subroutine write_problem

  !> NAME.bin: gaps, the forces that fuge found, 8 bytes each. NAME.txt: number of points,
  !> load, modulus and width of the cells.
  subroutine write_profile(directory, problem, force)
    character(len=*), intent(in) :: directory
    type(bench_problem), intent(in) :: problem
    real(dp), intent(in) :: force(:)
    integer :: unit

    open (newunit=unit, file=directory//'/'//trim(problem%name)//'.bin', access='stream', form='unformatted', &
          status='replace', action='write')
    write (unit) problem%gap, force
    close (unit)
    open (newunit=unit, file=directory//'/'//trim(problem%name)//'.txt', status='replace', action='write')
    write (unit, '(a,i0)') 'n ', size(problem%gap)
    write (unit, '(a,es24.16)') 'load ', problem%load
    write (unit, '(a,es24.16)') 'e_star ', problem%e_star
    write (unit, '(a,es24.16)') 'width ', problem%width
    close (unit)
  end subroutine write_profile

end module bench_records
