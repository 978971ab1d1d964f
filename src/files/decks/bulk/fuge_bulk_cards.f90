!> The cards of a Nastran deck, one after the other: a name and fields, with those of the lines that continue it.
module fuge_bulk_cards
  use fuge_bulk_fields, only: bulk_fields, split_bulk_line
  use fuge_entry_numbers, only: read_label, read_value
  use fuge_input_deck, only: input_deck, upper_case
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info, report, FUGE_ERR_MEMORY
  use fuge_text_columns, only: after_blanks
  use fuge_text_numbers, only: quoted
  implicit none
  private

  public :: next_bulk_line, next_card

  !> Longest field: free fields may be longer than sixteen columns.
  integer, parameter, public :: FIELD_LENGTH = 32
  !> Fields of a line, and room for those of the first card.
  integer, parameter :: LINE_FIELDS = 8, FIRST_FIELDS = 32

  !> A card: its name in upper case and its data fields, of which each line has eight.
  type, public :: bulk_card
    character(len=8) :: name = ''
    integer :: count = 0
    character(len=FIELD_LENGTH), allocatable :: field(:)
    !> File, as its number among the paths of the deck, and line where it begins.
    integer :: place(2) = 0
  contains
    procedure :: has
    procedure :: word
    procedure :: whole
    procedure :: number
  end type bulk_card

  !> The lines of a deck, and the card that has begun with the last one.
  type, public :: card_reader
    type(input_deck) :: deck
    type(bulk_card) :: begun
    integer, private :: status = 0
    !> What stands behind the fields of the last line, the marker of its continuation.
    character(len=8), private :: marker = ''
    !> After ENDDATA.
    logical, private :: ended = .false.
  end type card_reader

contains

  !> Is there something in field k?
  pure function has(self, k)
    class(bulk_card), intent(in) :: self
    integer, intent(in) :: k
    logical :: has

    has = k <= self%count
    if (has) has = self%field(k) /= ''
  end function has

  !> Field k in upper case; blank if the card has fewer.
  pure function word(self, k)
    class(bulk_card), intent(in) :: self
    integer, intent(in) :: k
    character(len=FIELD_LENGTH) :: word

    word = ''
    if (k <= self%count) word = upper_case(self%field(k))
  end function word

  !> The whole number in field k, called `name`; `default` if the field is blank. Unless `reason` is allocated already,
  !> it says why there is none from `least` on.
  pure subroutine whole(self, k, name, least, value, reason, default)
    class(bulk_card), intent(in) :: self
    integer, intent(in) :: k, least
    character(len=*), intent(in) :: name
    integer, intent(out) :: value
    character(len=:), allocatable, intent(inout) :: reason
    integer, intent(in), optional :: default

    value = 0
    if (present(default)) value = default
    if (present(default) .and. .not. self%has(k)) return
    call read_label(trim(self%word(k)), name, least, huge(1), value, reason)
  end subroutine whole

  !> The number in field k; `default` if the field is blank. Unless `reason` is allocated already, it says why there is
  !> none.
  pure subroutine number(self, k, name, value, reason, default)
    class(bulk_card), intent(in) :: self
    integer, intent(in) :: k
    character(len=*), intent(in) :: name
    real(dp), intent(out) :: value
    character(len=:), allocatable, intent(inout) :: reason
    real(dp), intent(in), optional :: default

    value = 0.0_dp
    if (present(default)) value = default
    if (allocated(reason) .or. (present(default) .and. .not. self%has(k))) return
    call read_value(trim(self%word(k)), value, reason)
    if (allocated(reason)) reason = name//': '//reason
  end subroutine number

  !> Advance to the next card; its name is blank after the last one. Errors: FUGE_ERR_FILE, FUGE_ERR_MEMORY.
  subroutine next_card(reader, card, info)
    type(card_reader), intent(inout) :: reader
    type(bulk_card), intent(inout) :: card
    type(fuge_info), intent(inout) :: info
    type(bulk_fields) :: fields
    integer :: length
    logical :: exists

    call move_card(reader%begun, card)
    do while (.not. reader%ended)
      call next_bulk_line(reader%deck, exists, length, info)
      if (info%failed() .or. .not. exists) exit
      associate (file => reader%deck%file(reader%deck%depth))
        call split_bulk_line(file%content(file%first:file%first + length - 1), fields)
        if (fields%skipped) cycle
        call check_fields(file%content(file%first:file%first + length - 1), fields, reader%deck, info)
        if (fields%continues) call check_continuation(fields, reader, info)
        if (info%failed()) return
        reader%marker = fields%marker
        if (fields%continues) then
          call append_fields(file%content(file%first:file%first + length - 1), fields, card, reader%status)
        else if (card%name == '') then
          call begin_card(file%content(file%first:file%first + length - 1), fields, reader, card)
        else
          call begin_card(file%content(file%first:file%first + length - 1), fields, reader, reader%begun)
        end if
      end associate
      if (reader%status /= 0) call report(info, FUGE_ERR_MEMORY, reader%deck%file(1)%name//': no memory for a card')
      if (info%failed()) return
      if (card%name == 'ENDDATA') then
        reader%ended = .true.
        card%name = ''
      else if (reader%begun%name == 'ENDDATA') then
        reader%ended = .true.
        reader%begun%name = ''
      end if
      if (reader%begun%name /= '') return
    end do
    reader%ended = .true.
  end subroutine next_card

  !> Refuse a line whose fields would be lost (FUGE_ERR_FILE).
  pure subroutine check_fields(line, fields, deck, info)
    character(len=*), intent(in) :: line
    type(bulk_fields), intent(in) :: fields
    type(input_deck), intent(in) :: deck
    type(fuge_info), intent(inout) :: info

    if (index(trim(line), achar(9)) > 0 .and. index(line(:min(len(line), 9)), ',') == 0) then
      call deck%refuse('tabs between fixed fields are not read: write blanks, or commas', info)
    else if (fields%excess) then
      call deck%refuse('there are more than 8 fields: go on in the next line', info)
    else if (index(fields%begin, '=') == 1 .or. index(fields%begin, '*(') == 1) then
      call deck%refuse('replication by = and *( is not read: write each card', info)
    else if (index(trim(fields%keyword), ' ') > 0 .and. .not. fields%continues .and. fields%keyword(:5) /= 'begin') then
      call deck%refuse('the name '//quoted(trim(fields%begin))//' has a blank in it: a field has 8 columns', info)
    end if
  end subroutine check_fields

  !> Refuse a continuation with a marker that the line above does not have in its field 10 (FUGE_ERR_FILE): programs
  !> look for its card elsewhere. What the markers begin with has no meaning, + or *.
  pure subroutine check_continuation(fields, reader, info)
    type(bulk_fields), intent(in) :: fields
    type(card_reader), intent(in) :: reader
    type(fuge_info), intent(inout) :: info
    character(len=8) :: here

    if (info%failed()) return
    here = bare_marker(fields%begin)
    if (here == '' .or. here == bare_marker(reader%marker) .or. here == upper_case(adjustl(reader%marker(2:)))) return
    call reader%deck%refuse('the continuation '//trim(fields%begin)//' does not follow its card: put it directly ' &
                            //'below, with its marker in field 10, or begin it with + alone', info)
  end subroutine check_continuation

  !> A marker in upper case and without the + or * before it.
  pure function bare_marker(marker) result(bare)
    character(len=8), intent(in) :: marker
    character(len=8) :: bare

    bare = upper_case(marker)
    if (scan(bare(1:1), '+*') > 0) bare = adjustl(bare(2:))
  end function bare_marker

  pure subroutine move_card(from, to)
    type(bulk_card), intent(inout) :: from, to

    to%name = from%name
    to%count = from%count
    to%place = from%place
    if (allocated(from%field)) call move_alloc(from%field, to%field)
    from%name = ''
    from%count = 0
  end subroutine move_card

  !> The next line of the deck and of the files that it includes, and its length without the comment after $ and
  !> without the carriage return at its end.
  !> Errors: FUGE_ERR_FILE, FUGE_ERR_MEMORY.
  subroutine next_bulk_line(deck, exists, length, info)
    type(input_deck), intent(inout) :: deck
    logical, intent(out) :: exists
    integer, intent(out) :: length
    type(fuge_info), intent(inout) :: info
    character(len=:), allocatable :: path

    length = 0
    do
      call deck%file(deck%depth)%advance(exists)
      if (.not. exists) then
        if (deck%depth == 1) return
        deck%file(deck%depth)%content = ''
        deck%depth = deck%depth - 1
        cycle
      end if
      associate (file => deck%file(deck%depth))
        length = index(file%content(file%first:file%last)//'$', '$') - 1
        do while (length > 0)
          if (file%content(file%first + length - 1:file%first + length - 1) /= achar(13)) exit
          length = length - 1
        end do
        call path_of_include(file%content(file%first:file%first + length - 1), path)
      end associate
      if (.not. allocated(path)) return
      if (index(path, achar(0)) > 0) then
        call deck%refuse('INCLUDE needs a path in quotes, which ends on its line', info)
      else
        call deck%include(path, info)
      end if
      if (info%failed()) return
    end do
  end subroutine next_bulk_line

  !> The path of a line INCLUDE 'path'; achar(0) if there is none, not allocated on another line.
  pure subroutine path_of_include(line, path)
    character(len=*), intent(in) :: line
    character(len=:), allocatable, intent(out) :: path
    character(len=*), parameter :: QUOTES = '''"'
    integer :: first, last

    first = after_blanks(line, 1)
    if (len(line) < first + 7) return
    if (upper_case(line(first:first + 6)) /= 'INCLUDE' .or. scan(line(first + 7:first + 7), ' ='//QUOTES) == 0) return
    path = trim(adjustl(line(first + 7:)))
    if (index(path, '=') == 1) path = trim(adjustl(path(2:)))
    last = len(path)
    if (last == 0) path = achar(0)
    if (last == 0) return
    if (scan(path(1:1), QUOTES) == 0) return
    if (last < 3 .or. path(last:last) /= path(1:1)) then
      path = achar(0)
    else
      path = path(2:last - 1)
    end if
  end subroutine path_of_include

  pure subroutine begin_card(line, fields, reader, card)
    character(len=*), intent(in) :: line
    type(bulk_fields), intent(in) :: fields
    type(card_reader), intent(inout) :: reader
    type(bulk_card), intent(inout) :: card

    card%name = upper_case(fields%keyword)
    card%count = 0
    card%place = reader%deck%place()
    call append_fields(line, fields, card, reader%status)
  end subroutine begin_card

  !> Add the fields of a line. A line of eight fields begins a new row of eight, whatever was before. A field that is
  !> too long for a number becomes a text that is none.
  pure subroutine append_fields(line, fields, card, status)
    character(len=*), intent(in) :: line
    type(bulk_fields), intent(in) :: fields
    type(bulk_card), intent(inout) :: card
    integer, intent(inout) :: status
    integer :: k

    if (card%name == '') return
    if (fields%count == LINE_FIELDS) then
      do while (mod(card%count, LINE_FIELDS) /= 0)
        call append_field('', card, status)
        if (status /= 0) return
      end do
    end if
    do k = 1, fields%count
      if (fields%last(k) - fields%first(k) >= FIELD_LENGTH) then
        call append_field('?'//line(fields%first(k):fields%first(k) + FIELD_LENGTH - 2), card, status)
      else
        call append_field(line(fields%first(k):fields%last(k)), card, status)
      end if
      if (status /= 0) return
    end do
  end subroutine append_fields

  pure subroutine append_field(word, card, status)
    character(len=*), intent(in) :: word
    type(bulk_card), intent(inout) :: card
    integer, intent(inout) :: status
    character(len=FIELD_LENGTH), allocatable :: longer(:)

    if (.not. allocated(card%field)) allocate (card%field(FIRST_FIELDS), stat=status)
    if (status /= 0) return
    if (card%count == size(card%field)) then
      allocate (longer(2*size(card%field)), stat=status)
      if (status /= 0) return
      longer(:card%count) = card%field
      call move_alloc(longer, card%field)
    end if
    card%count = card%count + 1
    card%field(card%count) = word
  end subroutine append_field

end module fuge_bulk_cards
