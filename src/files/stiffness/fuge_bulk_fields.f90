!> The fields of a line of Nastran's bulk data: eight of eight columns, four of sixteen (a * in the first field), or
!> free between commas.
module fuge_bulk_fields
  use fuge_text_numbers, only: lower_case
  implicit none
  private

  public :: split_bulk_line

  !> A line: its first field, and where its data fields 2 to 9, or 2 to 5, are: line(first(k):last(k)), without blanks
  !> at their ends; last(k) < first(k) if the field is blank.
  type, public :: bulk_fields
    !> The first field in lower case, without *.
    character(len=8) :: keyword = ''
    !> The first field as it is, and what stands behind the data fields: markers of continuations.
    character(len=8) :: begin = '', marker = ''
    !> The line continues the one before.
    logical :: continues = .false.
    !> The line is blank or a comment.
    logical :: skipped = .false.
    !> A line of free fields has more than its card can hold.
    logical :: excess = .false.
    integer :: count = 0
    integer :: first(8) = 1
    integer :: last(8) = 0
  end type bulk_fields

contains

  !> Find the fields of a line.
  pure subroutine split_bulk_line(line, fields)
    character(len=*), intent(in) :: line
    type(bulk_fields), intent(out) :: fields
    integer :: comma

    fields%skipped = len_trim(line) == 0
    if (.not. fields%skipped) fields%skipped = line(1:1) == '$' .or. verify(line, ' '//achar(9)//achar(13)) == 0
    if (fields%skipped) return
    ! Only names and markers, which hold no comma, stand in the first eight columns of a line of fixed fields.
    comma = index(line(:min(len(line), 9)), ',')
    if (comma > 0) then
      call name_line(line(:comma - 1), fields)
      call split_free(line, comma, fields)
    else
      call name_line(line(:min(len(line), 8)), fields)
      call split_fixed(line, fields)
    end if
  end subroutine split_bulk_line

  !> From the first field: the keyword, whether the line continues the one before, and the number of its data fields.
  pure subroutine name_line(first_field, fields)
    character(len=*), intent(in) :: first_field
    type(bulk_fields), intent(inout) :: fields
    integer :: star

    fields%count = merge(4, 8, index(first_field, '*') > 0)
    fields%begin = adjustl(first_field)
    fields%keyword = lower_case(fields%begin)
    fields%continues = fields%keyword == '' .or. scan(fields%keyword(1:1), '+*') > 0
    star = index(fields%keyword, '*')
    if (star > 0) fields%keyword(star:) = ''
  end subroutine name_line

  pure subroutine split_fixed(line, fields)
    character(len=*), intent(in) :: line
    type(bulk_fields), intent(inout) :: fields
    integer :: k, width

    width = 64/fields%count
    do k = 1, fields%count
      call trim_field(line, 9 + width*(k - 1), min(8 + width*k, len(line)), fields%first(k), fields%last(k))
    end do
    if (len(line) > 72) fields%marker = adjustl(line(73:min(80, len(line))))
  end subroutine split_fixed

  pure subroutine split_free(line, comma, fields)
    character(len=*), intent(in) :: line
    integer, intent(in) :: comma
    type(bulk_fields), intent(inout) :: fields
    integer :: begin, finish, k, separator

    begin = comma + 1
    do k = 1, fields%count
      if (begin > len(line)) exit
      finish = index(line(begin:), ',') + begin - 2
      if (finish < begin - 1) finish = len(line)
      call trim_field(line, begin, finish, fields%first(k), fields%last(k))
      begin = finish + 2
    end do
    if (begin > len(line)) return
    fields%excess = is_beyond_marker(line(begin:))
    separator = index(line(begin:)//',', ',')
    fields%marker = adjustl(line(begin:begin + separator - 2))
  end subroutine split_free

  !> Is there more behind the last data field than the marker of a continuation, which does not begin like a number?
  pure function is_beyond_marker(rest) result(beyond)
    character(len=*), intent(in) :: rest
    logical :: beyond
    integer :: comma, first

    comma = index(rest//',', ',')
    beyond = verify(rest(comma:), ', '//achar(9)//achar(13)) > 0
    first = verify(rest(:comma - 1), ' '//achar(9))
    if (first > 0 .and. .not. beyond) beyond = scan(rest(first:first), '0123456789-.') > 0
  end function is_beyond_marker

  !> line(begin:finish) without blanks at its ends.
  pure subroutine trim_field(line, begin, finish, first, last)
    character(len=*), intent(in) :: line
    integer, intent(in) :: begin, finish
    integer, intent(out) :: first, last

    first = begin
    last = finish
    do while (first <= last)
      if (.not. is_blank(line(first:first))) exit
      first = first + 1
    end do
    do while (last >= first)
      if (.not. is_blank(line(last:last))) exit
      last = last - 1
    end do
    if (first <= last) return
    first = 1
    last = 0
  end subroutine trim_field

  pure function is_blank(letter)
    character, intent(in) :: letter
    logical :: is_blank

    is_blank = iachar(letter) == 32 .or. iachar(letter) == 13 .or. iachar(letter) == 9
  end function is_blank

end module fuge_bulk_fields
