!> Lines of the tables in which other solvers report their answers: name, method, tolerance, time, residual, memory,
!> failure.
module bench_answers
  use fuge, only: dp => fuge_dp
  implicit none
  private

  public :: column, value

  !> The numbers of the columns.
  integer, parameter, public :: NAME = 1, METHOD = 2, TOLERANCE = 3, TIME = 4, RESIDUAL = 5, MEMORY = 6, FAILURE = 7

contains

  !> Column `number` of a line.
  pure function column(line, number) result(word)
    character(len=*), intent(in) :: line
    integer, intent(in) :: number
    character(len=:), allocatable :: word
    integer :: first, length, k

    first = 1
    do k = 1, number
      length = index(line(first:), ',') - 1
      if (length < 0) length = len_trim(line(first:))
      word = line(first:first + length - 1)
      first = min(first + length + 1, len(line))
    end do
  end function column

  !> Negative for an empty column.
  function value(word) result(found)
    character(len=*), intent(in) :: word
    real(dp) :: found
    integer :: stat

    found = -1.0_dp
    if (word == '') return
    read (word, *, iostat=stat) found
    if (stat /= 0) error stop 'a table of answers: not a number'
  end function value

end module bench_answers
