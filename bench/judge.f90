!> Residuals and errors of the answers of other solvers.
!>
!>     judge DIRECTORY
!>
!> reads DIRECTORY/answers.csv: a line with problem file, method, tolerance, time, residual,
!> memory and failure for each answer, whose forces are in a file of its own; appends to DIRECTORY/results.csv.
program judge_answers
  use bench_answers, only: column, value, FAILURE, METHOD, NAME, RESIDUAL, TIME, TOLERANCE
  use bench_judge, only: judge
  use bench_problems, only: bench_problem, make_known, uniform_edges, KNOWN
  use bench_records, only: bench_row, open_table, write_row
  use bench_runs, only: new_row
  use fuge, only: dp => fuge_dp, fuge_dense_operator, fuge_halfplane_operator, fuge_info, FUGE_MEAN
  implicit none

  !> A problem as read, and the measurements of it.
  type :: asked
    type(bench_problem) :: problem
    character(len=16) :: name = ''
    real(dp) :: setup = -1.0_dp, limit = -1.0_dp
    real(dp), allocatable :: force(:)
  end type asked

  call run()

contains

  subroutine run()
    character(len=256) :: directory
    character(len=400) :: line, stem, last
    type(asked), target :: question
    integer :: answers, table, stat

    call get_command_argument(1, directory)
    if (directory == '') error stop 'usage: judge DIRECTORY'
    open (newunit=answers, file=trim(directory)//'/answers.csv', status='old', action='read')
    call open_table(directory, table)
    last = ''
    do
      read (answers, '(a)', iostat=stat) line
      if (stat /= 0) exit
      stem = trim(directory)//'/'//column(line, NAME)
      if (stem /= last) call read_problem(trim(stem), question)
      last = stem
      call judge_one(question, trim(stem), line, table)
    end do
    close (answers)
    close (table)
  end subroutine run

  subroutine read_problem(stem, question)
    character(len=*), intent(in) :: stem
    type(asked), intent(out) :: question
    character(len=16) :: key
    character(len=40) :: word
    integer :: unit, stat, n
    logical :: tilts, matrix

    n = 0
    tilts = .false.
    matrix = .false.
    open (newunit=unit, file=stem//'.txt', status='old', action='read')
    do
      read (unit, *, iostat=stat) key, word
      if (stat /= 0) exit
      select case (key)
      case ('problem')
        question%name = word(:16)
      case ('n')
        read (word, *) n
      case ('tilts')
        tilts = word == '1'
      case ('matrix')
        matrix = word == '1'
      case ('load')
        read (word, *) question%problem%load
      case ('setup')
        read (word, *) question%setup
      case ('limit')
        read (word, *) question%limit
      case default
        ! The remaining columns are for other solvers.
        cycle
      end select
    end do
    close (unit)
    call read_data(stem, n, tilts, matrix, question)
  end subroutine read_problem

  subroutine read_data(stem, n, tilts, matrix, question)
    character(len=*), intent(in) :: stem
    integer, intent(in) :: n
    logical, intent(in) :: tilts, matrix
    type(asked), intent(inout) :: question
    type(bench_problem) :: known_problem
    real(dp) :: tilt(n), moment
    integer :: unit

    if (any(KNOWN == question%name)) then
      call make_known(trim(question%name), FUGE_MEAN, uniform_edges(n), known_problem)
      question%problem = known_problem
    else
      allocate (question%problem%gap(n))
    end if
    allocate (question%force(n))
    open (newunit=unit, file=stem//'.bin', access='stream', form='unformatted', status='old', action='read')
    read (unit) question%problem%gap, question%force
    if (tilts) read (unit) tilt, moment
    if (matrix) then
      allocate (question%problem%alpha(n, n))
      read (unit) question%problem%alpha
    end if
    close (unit)
  end subroutine read_data

  subroutine judge_one(question, stem, line, table)
    type(asked), intent(in), target :: question
    character(len=*), intent(in) :: stem, line
    integer, intent(in) :: table
    type(bench_row) :: row
    type(fuge_dense_operator) :: operator
    type(fuge_info) :: info
    real(dp) :: force(size(question%force))
    integer :: unit

    row = new_row(question%problem, trim(question%name))
    row%method = column(line, METHOD)
    row%tolerance = value(column(line, TOLERANCE))
    row%time = value(column(line, TIME))
    row%setup = question%setup
    row%limit = question%limit
    row%failure = column(line, FAILURE)
    if (row%failure == '') then
      open (newunit=unit, file=stem//'.'//trim(column(line, METHOD))//column(line, TOLERANCE), access='stream', &
            form='unformatted', status='old', action='read')
      read (unit) force
      close (unit)
      if (allocated(question%problem%alpha)) then
        call operator%set(question%problem%alpha, info)
        call judge(question%problem, operator, force, question%force, row)
      else
        call judge_profile(question, force, value(column(line, RESIDUAL)), row)
      end if
    end if
    call write_row(table, row)
  end subroutine judge_one

  !> Without a matrix the other solver has its own operator, and reports its own residual.
  subroutine judge_profile(question, force, residual, row)
    type(asked), intent(in) :: question
    real(dp), intent(in) :: force(:), residual
    type(bench_row), intent(inout) :: row
    type(fuge_halfplane_operator) :: operator
    type(fuge_info) :: info

    associate (problem => question%problem)
      row%unknowns = count(force > 1.0e-9_dp*maxval(force))
      if (allocated(problem%form)) then
        call operator%set(problem%points(), problem%width(1), problem%e_star, info, problem%element, problem%boundary)
        call judge(problem, operator, force, [real(dp) ::], row)
        row%error_approach = -1.0_dp
      end if
      row%residual = residual
    end associate
  end subroutine judge_profile

end program judge_answers
