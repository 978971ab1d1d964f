!> Which circles are transformed as a grid of rows and columns (fuge_split_plan), and how many of each.
module fuge_circle_split
  implicit none
  private

  public :: split_circle

  !> Complex numbers from which on a transform in parts is not slower than one as a whole.
  integer, parameter :: FEWEST = 16384
  !> More values have numbers of waves beyond the largest integer.
  integer, parameter :: MOST_VALUES = 2**29

contains

  !> `rows` <= `columns`, an even number: a grid of the length/2 complex numbers that `length` values are packed in.
  !> No rows if the circle is short, or has other factors than 2, 3, 5 and 7.
  pure subroutine split_circle(length, rows, columns)
    integer, intent(in) :: length
    integer, intent(out) :: rows, columns
    integer :: numbers, twos

    rows = 0
    columns = 0
    numbers = length/2
    if (mod(length, 4) /= 0 .or. numbers < FEWEST .or. length > MOST_VALUES) return
    if (.not. has_small_factors(numbers)) return
    ! Lines with some factors 2 are transformed faster.
    twos = 1
    do while (twos < 8 .and. mod(numbers, 4*twos**2) == 0)
      twos = 2*twos
    end do
    rows = int(sqrt(real(numbers)))
    rows = rows - mod(rows, twos)
    do while (mod(numbers, rows*max(twos, 2)) /= 0)
      rows = rows - twos
    end do
    columns = numbers/rows
  end subroutine split_circle

  !> Has `n` >= 1 no factors but 2, 3, 5 and 7?
  pure function has_small_factors(n) result(small)
    integer, intent(in) :: n
    logical :: small
    integer, parameter :: PRIMES(4) = [2, 3, 5, 7]
    integer :: k, rest

    rest = n
    do k = 1, size(PRIMES)
      do while (mod(rest, PRIMES(k)) == 0)
        rest = rest/PRIMES(k)
      end do
    end do
    small = rest == 1
  end function has_small_factors

end module fuge_circle_split
