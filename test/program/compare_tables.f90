!> Two tables have to hold the same numbers, to rounding, and the same states: compare_tables found expected.
!>
!> CSV; lines that begin with # are left out, the line of words has to be the same. A number
!> may differ by 1e-12 of the largest one in its column.
program compare_tables
  use fuge, only: dp => fuge_dp
  implicit none

  real(dp), parameter :: TOLERANCE = 1.0e-12_dp
  integer, parameter :: MOST_ROWS = 1000, MOST_COLUMNS = 8

  type :: table
    character(len=200) :: words = ''
    integer :: rows = 0
    integer :: columns = 0
    real(dp) :: value(MOST_ROWS, MOST_COLUMNS) = 0.0_dp
    !> The last column, where that is named state.
    character(len=8) :: state(MOST_ROWS) = ''
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
    if (any(found%state /= expected%state)) error stop 'not the same states'
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
    integer :: file, k, status
    logical :: has_states

    call get_command_argument(argument, line)
    has_states = .false.
    open (newunit=file, file=line, status='old', action='read')
    do
      read (file, '(a)', iostat=status) line
      if (status /= 0) exit
      if (line(1:1) == '#') cycle
      if (content%words == '') then
        content%words = line(:len(content%words))
        has_states = index(line, ',state') > 0
        content%columns = count([(line(k:k) == ',', k=1, len(line))])
        if (.not. has_states) content%columns = content%columns + 1
        cycle
      end if
      content%rows = content%rows + 1
      if (has_states) content%state(content%rows) = line(index(line, ',', back=.true.) + 1:)
      read (line, *) content%value(content%rows, :content%columns)
    end do
    close (file)
  end subroutine read_table

end program compare_tables
