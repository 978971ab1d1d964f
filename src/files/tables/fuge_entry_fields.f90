!> The columns of a line with one entry of a matrix: whole numbers and values between blanks or commas.
module fuge_entry_fields
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_text_columns, only: begin_columns, next_column
  use fuge_text_fields, only: describe_field, quoted, read_number, read_whole, FIELD_NUMBER
  implicit none
  private

  public :: is_comment, read_label, read_value, split_line

  !> Columns of a line that are looked at.
  integer, parameter :: MOST_FIELDS = 6

  !> Where the columns are: column k is line(first(k):last(k)). `count` is MOST_FIELDS if there are as many or more.
  type, public :: line_fields
    integer :: count = 0
    integer :: first(MOST_FIELDS) = 1
    integer :: last(MOST_FIELDS) = 0
  end type line_fields

contains

  !> Find the columns of a line.
  pure subroutine split_line(line, fields)
    character(len=*), intent(in) :: line
    type(line_fields), intent(out) :: fields
    integer :: k, separator

    k = begin_columns(line)
    do while (k <= len(line) .and. fields%count < MOST_FIELDS)
      fields%count = fields%count + 1
      call next_column(line, k, fields%first(fields%count), fields%last(fields%count), separator)
    end do
  end subroutine split_line

  !> Is the line blank, or a comment of one of the programs: from **, %, #, ! or $ on?
  pure function is_comment(line) result(skipped)
    character(len=*), intent(in) :: line
    logical :: skipped
    integer :: k

    k = begin_columns(line)
    skipped = k > len(line)
    if (skipped) return
    skipped = line(k:k) == '%' .or. line(k:k) == '$'
    if (.not. skipped .and. k < len(line)) skipped = line(k:k + 1) == '**'
  end function is_comment

  !> Convert a whole number from `least` to `most`, called `name`; unless `reason` is allocated already, it says why it
  !> is none.
  pure subroutine read_label(field, name, least, most, label, reason)
    character(len=*), intent(in) :: field, name
    integer, intent(in) :: least, most
    integer, intent(out) :: label
    character(len=:), allocatable, intent(inout) :: reason
    integer(int64) :: number
    integer :: kind

    label = 0
    if (allocated(reason)) return
    call read_whole(field, kind, number)
    if (len(field) == 0) then
      reason = 'the '//name//' is missing'
    else if (kind /= FIELD_NUMBER) then
      reason = name//' '//quoted(field)//' is not a whole number'
    else if (number < int(least, int64) .or. number > int(most, int64)) then
      reason = name//' '//quoted(field)//' is outside '//text(least)//' .. '//text(most)
    else
      label = int(number)
    end if
  end subroutine read_label

  !> Convert a value; the exponent may follow a sign without a letter, as in 3.+5. Unless `reason` is allocated already,
  !> it says why it is no finite number.
  pure subroutine read_value(field, value, reason)
    character(len=*), intent(in) :: field
    real(dp), intent(out) :: value
    character(len=:), allocatable, intent(inout) :: reason
    character(len=40) :: spelt
    integer :: kind, sign_at

    value = 0.0_dp
    if (allocated(reason)) return
    if (len(field) == 0) then
      reason = 'the value is missing'
      return
    end if
    call read_number(field, kind, value)
    if (kind == FIELD_NUMBER) return
    sign_at = scan(field, '+-', back=.true.)
    if (sign_at > 1 .and. len(field) < len(spelt)) then
      if (scan(field(sign_at - 1:sign_at - 1), '.0123456789') > 0) then
        spelt = field(:sign_at - 1)//'e'//field(sign_at:)
        call read_number(trim(spelt), kind, value)
      end if
    end if
    if (kind /= FIELD_NUMBER) reason = describe_field(field, kind)
  end subroutine read_value

end module fuge_entry_fields
