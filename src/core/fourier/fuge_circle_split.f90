!> Which circles are transformed as a grid of rows and columns (fuge_split_plan), and how many of each.
!>
!> Without measuring, FFTW finds transforms that need about the same time for each number, and the least, for lines of
!> 2^k complex numbers, and 5, 7 or 25 times as many. With other factors they take twice as long, and it is better to
!> leave the whole circle to FFTW.
module fuge_circle_split
  use fuge_fft, only: good_length
  implicit none
  private

  public :: fast_circle, split_circle

  !> Complex numbers from which on a transform in parts is not slower than one as a whole.
  integer, parameter :: FEWEST = 32768
  !> More values have numbers of waves beyond the largest integer.
  integer, parameter :: MOST_VALUES = 2**29
  !> Odd factors of lines that are transformed fast.
  integer, parameter :: ODD_FACTORS(4) = [1, 5, 7, 25]

contains

  !> Values >= `n` of a circle that is transformed fast, an even number; 0 if it exceeds the largest default integer.
  pure function fast_circle(n) result(length)
    integer, intent(in) :: n
    integer :: length
    integer :: j, k, longer

    length = good_length(n)
    if (n <= 2*FEWEST .or. n > MOST_VALUES/2) return
    length = MOST_VALUES
    do j = 1, size(ODD_FACTORS)
      do k = 1, j
        longer = 2*ODD_FACTORS(j)*ODD_FACTORS(k)
        do while (longer < n)
          longer = 2*longer
        end do
        length = min(length, longer)
      end do
    end do
  end function fast_circle

  !> `rows` <= `columns`, an even number: a grid of the length/2 complex numbers that `length` values are packed in, as
  !> square as lines are that are transformed fast. No rows if the circle is short, or has no such lines.
  pure subroutine split_circle(length, rows, columns)
    integer, intent(in) :: length
    integer, intent(out) :: rows, columns
    integer :: k, most, numbers

    rows = 0
    columns = 0
    numbers = length/2
    if (mod(length, 4) /= 0 .or. numbers < FEWEST .or. length > MOST_VALUES) return
    do k = 1, size(ODD_FACTORS)
      if (mod(numbers, ODD_FACTORS(k)) /= 0) cycle
      if (all(odd_factor(numbers)/ODD_FACTORS(k) /= ODD_FACTORS)) cycle
      most = ODD_FACTORS(k)
      do while (4*real(most)**2 <= real(numbers) .and. mod(numbers, 4*most) == 0)
        most = 2*most
      end do
      rows = max(rows, most)
    end do
    if (rows > 0) columns = numbers/rows
  end subroutine split_circle

  !> What remains of `n` >= 1 without its factors 2.
  pure function odd_factor(n) result(rest)
    integer, intent(in) :: n
    integer :: rest

    rest = n
    do while (mod(rest, 2) == 0)
      rest = rest/2
    end do
  end function odd_factor

end module fuge_circle_split
