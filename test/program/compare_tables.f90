!> Two tables have to hold the same numbers, to rounding, and the same words: compare_tables found expected.
!>
!> CSV; lines that begin with # are left out, the first line has to be the same. A number may differ by 1e-12 of the
!> largest one in its column.
program compare_tables
  use fuge_kinds, only: dp
  implicit none

  real(dp), parameter :: TOLERANCE = 1.0e-12_dp
  integer, parameter :: MOST_ROWS = 1000, MOST_COLUMNS = 24

  type :: table
    character(len=200) :: words = ''
    integer :: rows = 0
    integer :: columns = 0
    real(dp) :: value(MOST_ROWS, MOST_COLUMNS) = 0.0_dp
    !> What is no number.
    character(len=16) :: word(MOST_ROWS, MOST_COLUMNS) = ''
  end type table

  call run()

contains

  subroutine run()
    type(table), allocatable :: found, expected
    real(dp) :: off
    integer :: j

    allocate (found, expected)
    call read_table(1, found)
    call read_table(2, expected)
    if (found%words /= expected%words) error stop 'the columns have other names'
    if (found%rows /= expected%rows .or. expected%rows == 0) error stop 'not as many rows'
    if (any(found%word /= expected%word)) error stop 'not the same words'
    do j = 1, expected%columns
      off = maxval(abs(found%value(:, j) - expected%value(:, j)))
      if (off <= TOLERANCE*maxval(abs(expected%value(:, j)))) cycle
      print '(a,i0,a,es10.2)', 'column ', j, ' differs by ', off
      error stop 'not the same numbers'
    end do
  end subroutine run

  subroutine read_table(argument, content)
    integer, intent(in) :: argument
    type(table), intent(inout) :: content
    character(len=1024) :: line
    integer :: file, status

    call get_command_argument(argument, line)
    open (newunit=file, file=line, status='old', action='read')
    do
      read (file, '(a)', iostat=status) line
      if (status /= 0) exit
      if (line(1:1) == '#') cycle
      if (content%words == '') then
        content%words = line(:len(content%words))
      else
        content%rows = content%rows + 1
        call read_row(trim(line), content)
      end if
    end do
    close (file)
  end subroutine read_table

  !> The columns of the last row.
  subroutine read_row(line, content)
    character(len=*), intent(in) :: line
    type(table), intent(inout) :: content
    integer :: begin, finish, j, status

    begin = 1
    do j = 1, MOST_COLUMNS
      if (begin > len(line) + 1) exit
      finish = begin + index(line(begin:)//',', ',') - 2
      status = 1
      if (verify(line(begin:finish), ' 0123456789+-.E') == 0 .and. len_trim(line(begin:finish)) > 0) &
        read (line(begin:finish), *, iostat=status) content%value(content%rows, j)
      if (status /= 0) content%word(content%rows, j) = line(begin:finish)
      begin = finish + 2
    end do
    content%columns = max(content%columns, j - 1)
  end subroutine read_row

end program compare_tables
