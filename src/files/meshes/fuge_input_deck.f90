!> The lines of an input file of Abaqus or CalculiX and of the files that it includes: keyword lines and data lines.
module fuge_input_deck
  use fuge_mesh_type, only: NAME_LENGTH
  use fuge_number_text, only: text
  use fuge_path_list, only: count_paths
  use fuge_status, only: fuge_info, require_memory
  use fuge_text_columns, only: after_blanks
  use fuge_text_numbers, only: quoted
  use fuge_text_reader, only: text_file
  implicit none
  private

  public :: upper_case

  !> Most files that include each other in turn, and most inclusions in all: files that include others twice double
  !> them.
  integer, parameter :: MOST_FILES = 16, MOST_INCLUDED = 10000
  !> Most parameters of a keyword line that are looked at.
  integer, parameter :: MOST_PARAMETERS = 24
  !> Longest value of a parameter: a path.
  integer, parameter, public :: VALUE_LENGTH = 1024

  !> Kinds of lines.
  integer, parameter, public :: LINE_END = 0, LINE_KEYWORD = 1, LINE_DATA = 2

  !> An input file that is read line by line.
  type, public :: input_deck
    type(text_file), allocatable :: file(:)
    integer :: depth = 0
    integer, private :: included = 0
    !> Numbers of the open files among the paths.
    integer, private :: number(MOST_FILES) = 0
    !> Paths of all files, each once and ended by achar(0).
    character(len=:), allocatable :: paths
    !> Folder of the first file, with / at its end, for paths of included files.
    character(len=:), allocatable :: folder
    !> The keyword of the last keyword line, in upper case, without *.
    character(len=NAME_LENGTH) :: keyword = ''
    integer :: parameters = 0
    character(len=NAME_LENGTH), allocatable :: name(:)
    character(len=VALUE_LENGTH), allocatable :: value(:)
    !> The last line ended with a comma.
    logical, private :: continued = .false.
  contains
    procedure :: open
    procedure :: next
    procedure :: include
    procedure :: parameter
    procedure :: has
    procedure :: refuse
    procedure :: place
    procedure :: rewind
  end type input_deck

contains

  !> The text with its letters in upper case.
  pure function upper_case(string) result(upper)
    character(len=*), intent(in) :: string
    character(len=len(string)) :: upper
    integer :: k

    upper = string
    do k = 1, len(string)
      if (string(k:k) >= 'a' .and. string(k:k) <= 'z') upper(k:k) = achar(iachar(string(k:k)) - 32)
    end do
  end function upper_case

  !> Load the first file. Errors: FUGE_ERR_FILE, FUGE_ERR_MEMORY.
  subroutine open(self, path, info)
    class(input_deck), intent(inout) :: self
    character(len=*), intent(in) :: path
    type(fuge_info), intent(inout) :: info
    integer :: stat

    allocate (self%file(MOST_FILES), self%name(MOST_PARAMETERS), self%value(MOST_PARAMETERS), stat=stat)
    call require_memory(stat, 'the parameters of a deck', info)
    if (stat /= 0) return
    self%folder = path(:scan(path, '/\', back=.true.))
    self%depth = 1
    self%number(1) = 1
    self%paths = trim(path)//achar(0)
    call self%file(1)%load(path, info)
  end subroutine open

  !> Go on with an included file, up to its end. A path that does not begin at the root begins at the folder of the
  !> first file. Errors: FUGE_ERR_FILE, FUGE_ERR_MEMORY.
  subroutine include(self, path, info)
    class(input_deck), intent(inout) :: self
    character(len=*), intent(in) :: path
    type(fuge_info), intent(inout) :: info

    if (len_trim(path) == 0) then
      call self%refuse('*INCLUDE needs INPUT = and a path', info)
    else if (self%depth == MOST_FILES) then
      call self%refuse('more than '//text(MOST_FILES)//' files include each other: does one include itself?', info)
    else if (self%included == MOST_INCLUDED) then
      call self%refuse('more than '//text(MOST_INCLUDED)//' files are included: do they include others twice?', info)
    else if (scan(path(1:1), '/\') > 0 .or. index(path, ':') == 2) then
      call enter(self, trim(path), info)
    else
      call enter(self, self%folder//trim(path), info)
    end if
  end subroutine include

  !> Load an included file. Errors: FUGE_ERR_FILE, FUGE_ERR_MEMORY.
  subroutine enter(deck, path, info)
    class(input_deck), intent(inout) :: deck
    character(len=*), intent(in) :: path
    type(fuge_info), intent(inout) :: info
    integer :: begin

    deck%depth = deck%depth + 1
    deck%included = deck%included + 1
    begin = index(achar(0)//deck%paths, achar(0)//path//achar(0))
    if (begin == 0) begin = len(deck%paths) + 1
    if (begin > len(deck%paths)) deck%paths = deck%paths//path//achar(0)
    deck%number(deck%depth) = count_paths(deck%paths(:begin - 1)) + 1
    call deck%file(deck%depth)%load(path, info)
  end subroutine enter

  !> Go back before the first line of the first file.
  pure subroutine rewind(self)
    class(input_deck), intent(inout) :: self

    self%depth = 1
    self%included = 0
    call self%file(1)%rewind()
  end subroutine rewind

  !> The number of the present file among the paths, and the number of the present line.
  pure function place(self)
    class(input_deck), intent(in) :: self
    integer :: place(2)

    place = [self%number(self%depth), self%file(self%depth)%line]
  end function place

  !> Report that the present line cannot be used (FUGE_ERR_FILE).
  pure subroutine refuse(self, reason, info)
    class(input_deck), intent(in) :: self
    character(len=*), intent(in) :: reason
    type(fuge_info), intent(inout) :: info

    call self%file(self%depth)%refuse(reason, info)
  end subroutine refuse

  !> Advance to the next line that is neither blank nor a comment (**), in the included file or behind it. A keyword
  !> line is parsed, with the lines on which it goes on. The data line is that of `file(depth)`.
  subroutine next(self, line_kind, info)
    class(input_deck), intent(inout) :: self
    integer, intent(out) :: line_kind
    type(fuge_info), intent(inout) :: info
    integer :: first
    logical :: exists

    line_kind = LINE_END
    do
      call self%file(self%depth)%advance(exists)
      if (.not. exists) then
        if (self%depth == 1) return
        self%file(self%depth)%content = ''
        self%depth = self%depth - 1
        cycle
      end if
      call classify(self%file(self%depth)%content(self%file(self%depth)%first:self%file(self%depth)%last), first, &
                    line_kind)
      if (line_kind == LINE_DATA) return
      if (line_kind /= LINE_KEYWORD) cycle
      call read_keyword(self, info)
      return
    end do
  end subroutine next

  !> What a line is; LINE_END if it is blank or a comment.
  pure subroutine classify(line, first, line_kind)
    character(len=*), intent(in) :: line
    integer, intent(out) :: first, line_kind

    line_kind = LINE_END
    first = after_blanks(line, 1)
    if (first > len(line)) return
    line_kind = LINE_DATA
    if (line(first:first) /= '*') return
    line_kind = LINE_KEYWORD
    if (first < len(line)) then
      if (line(first + 1:first + 1) == '*') line_kind = LINE_END
    end if
  end subroutine classify

  !> Parse a keyword line, and the lines after it as long as a line ends with a comma.
  subroutine read_keyword(deck, info)
    type(input_deck), intent(inout) :: deck
    type(fuge_info), intent(inout) :: info
    integer :: first, line_kind
    logical :: exists

    deck%keyword = ''
    deck%parameters = 0
    associate (file => deck%file(deck%depth))
      call add_items(deck, file%content(file%first:file%last), info)
      do while (deck%continued .and. .not. info%failed())
        call file%advance(exists)
        if (.not. exists) exit
        call classify(file%content(file%first:file%last), first, line_kind)
        if (line_kind == LINE_END) cycle
        if (line_kind == LINE_KEYWORD) then
          call deck%refuse('the keyword line above ends with a comma, and goes on with another keyword', info)
        else
          call add_items(deck, file%content(file%first:file%last), info)
        end if
      end do
    end associate
  end subroutine read_keyword

  !> Add the keyword and the parameters on a line.
  pure subroutine add_items(deck, line, info)
    class(input_deck), intent(inout) :: deck
    character(len=*), intent(in) :: line
    type(fuge_info), intent(inout) :: info
    integer :: begin, finish
    character :: quote

    begin = 1
    deck%continued = .false.
    do while (begin <= len(line))
      ! A comma in quotes is part of a name.
      quote = ' '
      do finish = begin, len(line)
        if (line(finish:finish) == '"') quote = merge(' ', '"', quote == '"')
        if (line(finish:finish) == ',' .and. quote == ' ') exit
      end do
      call add_item(deck, line(begin:finish - 1), info)
      deck%continued = finish <= len(line)
      begin = finish + 1
      if (after_blanks(line, begin) > len(line)) exit
      deck%continued = .false.
    end do
  end subroutine add_items

  !> Add the keyword, or a parameter NAME or NAME = VALUE.
  pure subroutine add_item(deck, item, info)
    class(input_deck), intent(inout) :: deck
    character(len=*), intent(in) :: item
    type(fuge_info), intent(inout) :: info
    integer :: equals

    if (after_blanks(item, 1) > len(item)) return
    if (deck%keyword == '') then
      deck%keyword = squeezed(item)
      deck%keyword = deck%keyword(2:)
      return
    end if
    if (deck%parameters == MOST_PARAMETERS) then
      call deck%refuse('more than '//text(MOST_PARAMETERS)//' parameters', info)
      return
    end if
    equals = index(item, '=')
    if (equals == 0) equals = len(item) + 1
    deck%parameters = deck%parameters + 1
    deck%name(deck%parameters) = squeezed(item(:equals - 1))
    deck%value(deck%parameters) = unquoted(item(equals + 1:))
    if (len_trim(unquoted(item(equals + 1:))) > VALUE_LENGTH) &
      call deck%refuse('the value '//quoted(trim(unquoted(item(equals + 1:))))//' is too long', info)
  end subroutine add_item

  !> The text in upper case and without blanks, as the programs compare keywords.
  pure function squeezed(item) result(word)
    character(len=*), intent(in) :: item
    character(len=len(item)) :: word
    integer :: k, used

    word = ''
    used = 0
    do k = 1, len(item)
      if (after_blanks(item(k:k), 1) > 1) cycle
      used = used + 1
      word(used:used) = item(k:k)
    end do
    word = upper_case(word)
  end function squeezed

  !> The text without blanks at its ends and without quotes.
  pure function unquoted(item) result(value)
    character(len=*), intent(in) :: item
    character(len=len(item)) :: value
    integer :: first, last

    value = ''
    first = after_blanks(item, 1)
    last = len(item)
    do while (last > first)
      if (after_blanks(item(last:last), 1) == 1) exit
      last = last - 1
    end do
    if (first > last) return
    if (last > first .and. item(first:first) == '"' .and. item(last:last) == '"') then
      first = first + 1
      last = last - 1
    end if
    value = item(first:last)
  end function unquoted

  !> Value of a parameter of the last keyword line, blank if it has none.
  pure function parameter(self, name) result(value)
    class(input_deck), intent(in) :: self
    character(len=*), intent(in) :: name
    character(len=VALUE_LENGTH) :: value
    integer :: k

    value = ''
    do k = 1, self%parameters
      if (self%name(k) == name) value = self%value(k)
    end do
  end function parameter

  !> Does the last keyword line have the parameter?
  pure function has(self, name)
    class(input_deck), intent(in) :: self
    character(len=*), intent(in) :: name
    logical :: has
    integer :: k

    has = .false.
    do k = 1, self%parameters
      if (self%name(k) == name) has = .true.
    end do
  end function has

end module fuge_input_deck
