! assertEqual of the stand-in: the expected value first, then the one found.
module funit_equal
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
  use funit_report, only: dp, list, report, SourceLocation, text
  implicit none
  private

  public :: assertEqual

  ! The digits are the ranks of expected and found. In numeric comparisons the
  ! location comes before the message, so that both must be given by keyword.
  interface assertEqual
    module procedure equal_integer_00, equal_integer_01, equal_integer_02
    module procedure equal_integer_11, equal_integer_22
    module procedure equal_logical_00, equal_logical_01, equal_logical_02
    module procedure equal_logical_11, equal_logical_22
    module procedure equal_double_00, equal_double_01, equal_double_02
    module procedure equal_double_11, equal_double_22
    module procedure equal_string
  end interface assertEqual

contains

  logical function same_shape(expected, found, location, message)
    integer, intent(in) :: expected(:), found(:)
    type(SourceLocation), intent(in), optional :: location
    character(len=*), intent(in), optional :: message

    same_shape = all(expected == found)
    if (same_shape) return
    call report('assertEqual', location, message, 'shape '//list(expected), 'shape '//list(found))
  end function same_shape

  ! Array indices of the k-th element in storage order; none for a scalar.
  pure function indices(k, extents) result(at)
    integer, intent(in) :: k, extents(:)
    integer :: at(size(extents))

    if (size(at) == 1) at = k
    if (size(at) == 2) at = [modulo(k - 1, extents(1)) + 1, (k - 1)/extents(1) + 1]
  end function indices

  ! NaN is tested first because ordering it would trip floating point traps; equal
  ! values are accepted before subtracting because the difference of infinities is NaN.
  elemental logical function close_enough(expected, found, tolerance)
    real(dp), intent(in) :: expected, found, tolerance

    if (ieee_is_nan(expected) .or. ieee_is_nan(found)) then
      close_enough = .false.
    else if (expected < found .or. expected > found) then
      close_enough = abs(found - expected) <= tolerance
    else
      close_enough = .true.
    end if
  end function close_enough

  ! The three check_ procedures compare flattened arrays of equal size.
  subroutine check_integer(expected, found, extents, location, message)
    integer, intent(in) :: expected(:), found(:), extents(:)
    type(SourceLocation), intent(in), optional :: location
    character(len=*), intent(in), optional :: message
    integer :: k

    k = findloc(expected == found, .false., dim=1)
    if (k == 0) return
    call report('assertEqual', location, message, text(expected(k)), text(found(k)), &
                indices(k, extents))
  end subroutine check_integer

  subroutine check_logical(expected, found, extents, location, message)
    logical, intent(in) :: expected(:), found(:)
    integer, intent(in) :: extents(:)
    type(SourceLocation), intent(in), optional :: location
    character(len=*), intent(in), optional :: message
    integer :: k

    k = findloc(expected .eqv. found, .false., dim=1)
    if (k == 0) return
    call report('assertEqual', location, message, text(expected(k)), text(found(k)), &
                indices(k, extents))
  end subroutine check_logical

  subroutine check_double(expected, found, extents, tolerance, location, message)
    real(dp), intent(in) :: expected(:), found(:)
    integer, intent(in) :: extents(:)
    real(dp), intent(in), optional :: tolerance
    type(SourceLocation), intent(in), optional :: location
    character(len=*), intent(in), optional :: message
    real(dp) :: allowed
    integer :: k

    allowed = 0.0_dp
    if (present(tolerance)) allowed = tolerance
    k = findloc(close_enough(expected, found, allowed), .false., dim=1)
    if (k == 0) return
    call report('assertEqual', location, message, text(expected(k)), &
                text(found(k))//' (tolerance '//text(allowed)//')', indices(k, extents))
  end subroutine check_double

  subroutine equal_integer_00(expected, found, location, message)
    integer, intent(in) :: expected, found
    type(SourceLocation), intent(in), optional :: location
    character(len=*), intent(in), optional :: message

    call check_integer([expected], [found], [integer ::], location, message)
  end subroutine equal_integer_00

  subroutine equal_integer_01(expected, found, location, message)
    integer, intent(in) :: expected, found(:)
    type(SourceLocation), intent(in), optional :: location
    character(len=*), intent(in), optional :: message

    call check_integer(spread(expected, 1, size(found)), found, shape(found), location, message)
  end subroutine equal_integer_01

  subroutine equal_integer_02(expected, found, location, message)
    integer, intent(in) :: expected, found(:, :)
    type(SourceLocation), intent(in), optional :: location
    character(len=*), intent(in), optional :: message

    call check_integer(spread(expected, 1, size(found)), [found], shape(found), location, message)
  end subroutine equal_integer_02

  subroutine equal_integer_11(expected, found, location, message)
    integer, intent(in) :: expected(:), found(:)
    type(SourceLocation), intent(in), optional :: location
    character(len=*), intent(in), optional :: message

    if (.not. same_shape(shape(expected), shape(found), location, message)) return
    call check_integer(expected, found, shape(found), location, message)
  end subroutine equal_integer_11

  subroutine equal_integer_22(expected, found, location, message)
    integer, intent(in) :: expected(:, :), found(:, :)
    type(SourceLocation), intent(in), optional :: location
    character(len=*), intent(in), optional :: message

    if (.not. same_shape(shape(expected), shape(found), location, message)) return
    call check_integer([expected], [found], shape(found), location, message)
  end subroutine equal_integer_22

  subroutine equal_logical_00(expected, found, location, message)
    logical, intent(in) :: expected, found
    type(SourceLocation), intent(in), optional :: location
    character(len=*), intent(in), optional :: message

    call check_logical([expected], [found], [integer ::], location, message)
  end subroutine equal_logical_00

  subroutine equal_logical_01(expected, found, location, message)
    logical, intent(in) :: expected, found(:)
    type(SourceLocation), intent(in), optional :: location
    character(len=*), intent(in), optional :: message

    call check_logical(spread(expected, 1, size(found)), found, shape(found), location, message)
  end subroutine equal_logical_01

  subroutine equal_logical_02(expected, found, location, message)
    logical, intent(in) :: expected, found(:, :)
    type(SourceLocation), intent(in), optional :: location
    character(len=*), intent(in), optional :: message

    call check_logical(spread(expected, 1, size(found)), [found], shape(found), location, message)
  end subroutine equal_logical_02

  subroutine equal_logical_11(expected, found, location, message)
    logical, intent(in) :: expected(:), found(:)
    type(SourceLocation), intent(in), optional :: location
    character(len=*), intent(in), optional :: message

    if (.not. same_shape(shape(expected), shape(found), location, message)) return
    call check_logical(expected, found, shape(found), location, message)
  end subroutine equal_logical_11

  subroutine equal_logical_22(expected, found, location, message)
    logical, intent(in) :: expected(:, :), found(:, :)
    type(SourceLocation), intent(in), optional :: location
    character(len=*), intent(in), optional :: message

    if (.not. same_shape(shape(expected), shape(found), location, message)) return
    call check_logical([expected], [found], shape(found), location, message)
  end subroutine equal_logical_22

  subroutine equal_double_00(expected, found, tolerance, location, message)
    real(dp), intent(in) :: expected, found
    real(dp), intent(in), optional :: tolerance
    type(SourceLocation), intent(in), optional :: location
    character(len=*), intent(in), optional :: message

    call check_double([expected], [found], [integer ::], tolerance, location, message)
  end subroutine equal_double_00

  subroutine equal_double_01(expected, found, tolerance, location, message)
    real(dp), intent(in) :: expected, found(:)
    real(dp), intent(in), optional :: tolerance
    type(SourceLocation), intent(in), optional :: location
    character(len=*), intent(in), optional :: message

    call check_double(spread(expected, 1, size(found)), found, shape(found), tolerance, &
                      location, message)
  end subroutine equal_double_01

  subroutine equal_double_02(expected, found, tolerance, location, message)
    real(dp), intent(in) :: expected, found(:, :)
    real(dp), intent(in), optional :: tolerance
    type(SourceLocation), intent(in), optional :: location
    character(len=*), intent(in), optional :: message

    call check_double(spread(expected, 1, size(found)), [found], shape(found), tolerance, &
                      location, message)
  end subroutine equal_double_02

  subroutine equal_double_11(expected, found, tolerance, location, message)
    real(dp), intent(in) :: expected(:), found(:)
    real(dp), intent(in), optional :: tolerance
    type(SourceLocation), intent(in), optional :: location
    character(len=*), intent(in), optional :: message

    if (.not. same_shape(shape(expected), shape(found), location, message)) return
    call check_double(expected, found, shape(found), tolerance, location, message)
  end subroutine equal_double_11

  subroutine equal_double_22(expected, found, tolerance, location, message)
    real(dp), intent(in) :: expected(:, :), found(:, :)
    real(dp), intent(in), optional :: tolerance
    type(SourceLocation), intent(in), optional :: location
    character(len=*), intent(in), optional :: message

    if (.not. same_shape(shape(expected), shape(found), location, message)) return
    call check_double([expected], [found], shape(found), tolerance, location, message)
  end subroutine equal_double_22

  ! Blanks and tabs at either end do not count.
  subroutine equal_string(expected, found, message, location)
    character(len=*), intent(in) :: expected, found
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    if (stripped(expected) == stripped(found)) return
    call report('assertEqual', location, message, '"'//stripped(expected)//'"', &
                '"'//stripped(found)//'"')
  end subroutine equal_string

  pure function stripped(string)
    character(len=*), intent(in) :: string
    character(len=:), allocatable :: stripped
    character(len=*), parameter :: white = ' '//achar(9)

    stripped = string(max(1, verify(string, white)):verify(string, white, back=.true.))
  end function stripped

end module funit_equal
