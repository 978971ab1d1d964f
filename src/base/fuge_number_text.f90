!> Numbers as text, for messages.
!>
!> An index goes into a message as `index_text(k)`, any other number (a size, a count, a value, a
!> line of a file) as `text(k)`.
!>
!> The length of each result is known before the call, because gfortran keeps the length of
!> a deferred-length result (`len=:`) in a variable that all threads share.
module fuge_number_text
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_kinds, only: dp
  implicit none
  private

  public :: index_text, text

  !> Stands before an index in the text that `report` is given. No file name or other text of a
  !> caller can hold it: in C it ends a string.
  character, parameter, public :: INDEX_MARK = achar(0)

  !> An integer, or a real number to about six digits, without blanks.
  interface text
    module procedure text_integer
    module procedure text_real
  end interface text

contains

  !> Digit by digit: internal write statements of several threads take the same locks as files.
  pure function integer_field(value) result(field)
    integer, intent(in) :: value
    character(len=12) :: field
    integer :: first, rest

    field = ''
    first = len(field)
    ! The negative number always exists.
    rest = merge(value, -value, value < 0)
    do
      field(first:first) = achar(iachar('0') - mod(rest, 10))
      rest = rest/10
      if (rest == 0) exit
      first = first - 1
    end do
    if (value < 0) then
      first = first - 1
      field(first:first) = '-'
    end if
    field = field(first:)
  end function integer_field

  pure function text_integer(value) result(string)
    integer, intent(in) :: value
    character(len=len_trim(integer_field(value))) :: string

    string = integer_field(value)
  end function text_integer

  !> An index for a message: the number of a point, row, degree of freedom or mode, which counts
  !> from 1 here and from 0 in C. `fuge_status` turns the marked number into the caller's.
  pure function index_text(value) result(string)
    integer, intent(in) :: value
    character(len=len_trim(integer_field(value)) + 1) :: string

    string = INDEX_MARK//integer_field(value)
  end function index_text

  pure function real_field(value) result(field)
    real(dp), intent(in) :: value
    character(len=24) :: field

    if (.not. ieee_is_finite(value)) then
      ! On its own branch, because a comparison with NaN may trap.
      write (field, '(es13.5e3)') value
    else if (abs(value) >= 1.0e-3_dp .and. abs(value) < 1.0e5_dp) then
      write (field, '(f14.6)') value
    else
      write (field, '(es13.5e3)') value
    end if
    field = adjustl(field)
  end function real_field

  pure function text_real(value) result(string)
    real(dp), intent(in) :: value
    character(len=len_trim(real_field(value))) :: string

    string = real_field(value)
  end function text_real

end module fuge_number_text
