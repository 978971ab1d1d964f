! Finds names that a test module gives to its own entities and that pFUnit uses itself: with pFUnit such a module
! does not compile. Statements come in one by one, without strings, comments and continuations.
module pf_module_names
  use, intrinsic :: iso_fortran_env, only: iostat_end
  implicit none
  private

  public :: read_names

  integer, parameter :: name_len = 63
  character(len=*), parameter :: name_characters = 'abcdefghijklmnopqrstuvwxyz0123456789_'
  ! What may stand before `subroutine` or `function`; the words of types also begin declarations.
  character(len=9), parameter :: prefixes(*) = [character(len=9) :: 'pure', 'impure', 'elemental', 'recursive', &
                                                'module']
  character(len=9), parameter :: types(*) = [character(len=9) :: 'integer', 'real', 'double', 'precision', 'complex', &
                                             'logical', 'character', 'type', 'class']

  ! Local names of the procedure that pFUnit generates for each test module: public entities must not have them.
  character(len=name_len), parameter :: generated(*) = [character(len=name_len) :: 't', 'suite']

  type, public :: module_names
    character(len=name_len), allocatable :: exported(:)
    integer :: procedures = 0 ! procedures around the next statement
    logical :: in_type = .false.
  contains
    procedure :: next => next_statement
  end type module_names

contains

  ! The names of a file, one a line, without the lines that begin with #; error stays
  ! unallocated on success.
  subroutine read_names(path, names, error)
    character(len=*), intent(in) :: path
    character(len=name_len), allocatable, intent(out) :: names(:)
    character(len=:), allocatable, intent(out) :: error
    character(len=name_len) :: line
    integer :: unit, status

    allocate (names(0))
    open (newunit=unit, file=path, status='old', action='read', iostat=status)
    if (status == 0) then
      do
        read (unit, '(a)', iostat=status) line
        if (status /= 0) exit
        if (line /= ' ' .and. line(1:1) /= '#') names = [character(len=name_len) :: names, line]
      end do
      close (unit)
    end if
    if (status /= iostat_end .or. size(names) == 0) error = path//': no names can be read'
  end subroutine read_names

  ! A name of pFUnit that this statement gives to an entity of the module, or an empty string.
  subroutine next_statement(this, statement, clash)
    class(module_names), intent(inout) :: this
    character(len=*), intent(in) :: statement
    character(len=:), allocatable, intent(out) :: clash
    character(len=:), allocatable :: name

    clash = ''
    if (this%in_type) then
      this%in_type = .not. ends(statement, 'type')
    else if (ends(statement, 'subroutine') .or. ends(statement, 'function') .or. statement == 'end') then
      this%procedures = max(0, this%procedures - 1)
    else
      name = procedure_name(statement)
      if (this%procedures == 0) then
        if (len(name) == 0) name = defined_name(statement)
        this%in_type = is_type_definition(statement)
        name = name//','//declared_names(statement)//','//imported_names(statement)
        clash = first_found(this%exported, name)
        if (clash == '' .and. index(statement, 'private') == 0) clash = first_found(generated, name)
      end if
      if (len(procedure_name(statement)) > 0) this%procedures = this%procedures + 1
    end if
  end subroutine next_statement

  ! "end keyword" or "endkeyword", with or without a name.
  pure logical function ends(statement, keyword)
    character(len=*), intent(in) :: statement, keyword

    ends = .false.
    if (first_word(statement) == 'end') then
      ends = first_word(after_word(statement)) == keyword
    else
      ends = first_word(statement) == 'end'//keyword
    end if
    if (ends) ends = scan(statement, '=(%') == 0
  end function ends

  ! The name in the first statement of a procedure, or an empty string.
  pure function procedure_name(statement) result(name)
    character(len=*), intent(in) :: statement
    character(len=:), allocatable :: name, rest

    name = ''
    rest = statement
    do
      if (len(first_word(rest)) == 0) return
      if (first_word(rest) == 'subroutine' .or. first_word(rest) == 'function') exit
      if (.not. any(prefixes == first_word(rest)) .and. .not. any(types == first_word(rest))) return
      rest = after_parentheses(after_word(rest))
    end do
    name = first_word(after_word(rest))
  end function procedure_name

  ! The name in "module name", "interface name" and the first statement of a type, or an empty string.
  pure function defined_name(statement) result(name)
    character(len=*), intent(in) :: statement
    character(len=:), allocatable :: name

    name = ''
    if (is_type_definition(statement)) then
      name = first_word(after_colons(after_word(statement)))
    else if (first_word(statement) == 'module' .or. first_word(statement) == 'interface') then
      name = first_word(after_word(statement))
      if (name == 'operator' .or. name == 'assignment' .or. name == 'procedure') name = ''
    end if
  end function defined_name

  pure logical function is_type_definition(statement)
    character(len=*), intent(in) :: statement

    is_type_definition = first_word(statement) == 'type' .and. scan(after_word(statement)//' ', '(=%') /= 1
  end function is_type_definition

  ! What a declaration declares, separated by commas, or an empty string.
  pure function declared_names(statement) result(names)
    character(len=*), intent(in) :: statement
    character(len=:), allocatable :: names, word, rest

    names = ''
    word = first_word(statement)
    rest = after_parentheses(after_word(statement))
    if (any(types == word) .and. .not. is_type_definition(statement)) then
      if (word == 'double') rest = after_word(rest)
      names = heads(after_colons(rest))
    else if (word == 'procedure' .or. word == 'enumerator') then
      names = heads(after_colons(rest))
    end if
  end function declared_names

  ! The names by which "use a, only: x, y => z" and "use a, y => z" know what they take, but not where pFUnit exports
  ! the same entities, those of intrinsic modules.
  pure function imported_names(statement) result(names)
    character(len=*), intent(in) :: statement
    character(len=:), allocatable :: names, rest
    integer :: comma

    names = ''
    if (first_word(statement) /= 'use') return
    rest = after_word(statement)
    if (index(rest, ',') == 1 .and. first_word(rest(2:)) == 'intrinsic') return
    rest = after_colons(rest)
    comma = index(rest, ',')
    if (comma == 0 .or. first_word(rest) == 'funit' .or. first_word(rest) == 'iso_fortran_env') return
    rest = adjustl(rest(comma + 1:))
    if (first_word(rest) == 'only') rest = rest(index(rest, ':') + 1:)
    names = heads(rest)
  end function imported_names

  ! The first word of each part between commas outside of parentheses.
  pure function heads(list) result(names)
    character(len=*), intent(in) :: list
    character(len=:), allocatable :: names
    integer :: depth, first, i

    names = ''
    depth = 0
    first = 1
    do i = 1, len(list) + 1
      if (i <= len(list)) then
        if (scan(list(i:i), '([') == 1) depth = depth + 1
        if (scan(list(i:i), ')]') == 1) depth = depth - 1
        if (list(i:i) /= ',' .or. depth > 0) cycle
      end if
      names = names//','//first_word(list(first:i - 1))
      first = i + 1
    end do
  end function heads

  ! The first name of a list with commas that is one of the given names, or an empty string.
  pure function first_found(names, list) result(name)
    character(len=*), intent(in) :: names(:), list
    character(len=:), allocatable :: name
    integer :: first, last

    first = 1
    do while (first <= len(list))
      last = first - 1 + index(list(first:)//',', ',')
      name = list(first:last - 1)
      if (any(names == name)) return
      first = last + 1
    end do
    name = ''
  end function first_found

  pure function first_word(text) result(word)
    character(len=*), intent(in) :: text
    character(len=:), allocatable :: word

    word = adjustl(text)
    word = word(:verify(word//' ', name_characters) - 1)
  end function first_word

  pure function after_word(text) result(rest)
    character(len=*), intent(in) :: text
    character(len=:), allocatable :: rest

    rest = adjustl(text)
    rest = trim(adjustl(rest(verify(rest//' ', name_characters):)))
  end function after_word

  ! Without the "(..)" or "*8" at the beginning.
  pure function after_parentheses(text) result(rest)
    character(len=*), intent(in) :: text
    character(len=:), allocatable :: rest
    integer :: depth, i

    rest = adjustl(text)
    if (index(rest, '*') == 1) rest = after_word(rest(2:))
    if (index(rest, '(') /= 1) return
    depth = 0
    do i = 1, len(rest)
      if (rest(i:i) == '(') depth = depth + 1
      if (rest(i:i) == ')') depth = depth - 1
      if (depth == 0) exit
    end do
    rest = adjustl(rest(i + 1:))
  end function after_parentheses

  ! What follows the first "::", or all where there is none.
  pure function after_colons(text) result(rest)
    character(len=*), intent(in) :: text
    character(len=:), allocatable :: rest
    integer :: colons

    rest = text
    colons = index(text, '::')
    if (colons > 0) rest = text(colons + 2:)
  end function after_colons

end module pf_module_names
