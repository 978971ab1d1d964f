!> The numbers in a line with one entry of a matrix: labels and values, and why a column is neither.
module fuge_entry_numbers
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_text_columns, only: begin_columns
  use fuge_text_numbers, only: describe_text, quoted, read_number, read_whole, KIND_NUMBER
  implicit none
  private

  public :: is_comment, read_label, read_value

contains

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
  pure subroutine read_label(string, name, least, most, label, reason)
    character(len=*), intent(in) :: string, name
    integer, intent(in) :: least, most
    integer, intent(out) :: label
    character(len=:), allocatable, intent(inout) :: reason
    integer(int64) :: number
    integer :: kind

    label = 0
    if (allocated(reason)) return
    call read_whole(string, kind, number)
    if (len(string) == 0) then
      reason = 'the '//name//' is missing'
    else if (kind /= KIND_NUMBER) then
      reason = name//' '//quoted(string)//' is not a whole number'
    else if (number < int(least, int64) .or. number > int(most, int64)) then
      reason = name//' '//quoted(string)//' is outside '//text(least)//' .. '//text(most)
    else
      label = int(number)
    end if
  end subroutine read_label

  !> Convert a value; the exponent may follow a sign without a letter, as in 3.+5. Unless `reason` is allocated already,
  !> it says why it is no finite number.
  pure subroutine read_value(string, value, reason)
    character(len=*), intent(in) :: string
    real(dp), intent(out) :: value
    character(len=:), allocatable, intent(inout) :: reason
    character(len=40) :: spelt
    integer :: kind, sign_at

    value = 0.0_dp
    if (allocated(reason)) return
    if (len(string) == 0) then
      reason = 'the value is missing'
      return
    end if
    call read_number(string, kind, value)
    if (kind == KIND_NUMBER) return
    sign_at = scan(string, '+-', back=.true.)
    if (sign_at > 1 .and. len(string) < len(spelt)) then
      if (scan(string(sign_at - 1:sign_at - 1), '.0123456789') > 0) then
        spelt = string(:sign_at - 1)//'e'//string(sign_at:)
        call read_number(trim(spelt), kind, value)
      end if
    end if
    if (kind /= KIND_NUMBER) reason = describe_text(string, kind)
  end subroutine read_value

end module fuge_entry_numbers
