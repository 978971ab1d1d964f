! Translates a .pf file into Fortran: each directive becomes a call, and the module gets a
! last procedure, the only public one, which runs its tests: what the module uses is then
! not written into its module file. Whatever it does not know it refuses.
module pf_translation
  use, intrinsic :: iso_fortran_env, only: iostat_end
  use pf_module_names, only: module_names, read_names
  implicit none
  private

  public :: translate

  integer, parameter :: name_len = 63
  integer, parameter :: line_len = 1024
  character(len=*), parameter :: letters = 'abcdefghijklmnopqrstuvwxyz'
  character(len=*), parameter :: name_characters = letters//'0123456789_'
  character(len=24), parameter :: assertions(*) = [character(len=24) :: &
                                                   'assertEqual', 'assertNotEqual', &
                                                   'assertRelativelyEqual', &
                                                   'assertTrue', 'assertFalse', 'assertFail', &
                                                   'assertIsNaN', 'assertIsFinite', &
                                                   'assertLessThan', 'assertLessThanOrEqual', &
                                                   'assertGreaterThan', 'assertGreaterThanOrEqual']

  type :: translation
    character(len=:), allocatable :: path, out_path, file_name, module_name
    character(len=:), allocatable :: error ! allocated once the file is refused
    character(len=name_len), allocatable :: tests(:)
    character(len=name_len) :: before = ' ', after = ' '
    character(len=6) :: pending = ' ' ! the directive whose subroutine must follow
    type(module_names) :: names
    character(len=:), allocatable :: statement ! as far as it has been read
    integer :: statement_line = 0 ! the line on which it begins
    logical :: is_private = .false. ! all names but that of the procedure that runs the tests
    logical :: has_ended = .false. ! the module
    integer :: in = -1, out = -1
    integer :: line = 0 ! number of lines read
    integer :: written = 0
  end type translation

contains

  ! The file of names lists those that pFUnit exports. error stays unallocated on success;
  ! a refused file leaves no output behind, which a build tool might take for a finished one.
  subroutine translate(path, out_path, names_path, error)
    character(len=*), intent(in) :: path, out_path, names_path
    character(len=:), allocatable, intent(out) :: error
    type(translation) :: this
    integer :: status

    call read_names(names_path, this%names%exported, error)
    if (allocated(error)) return
    this%path = path
    this%out_path = out_path
    this%file_name = path(scan(path, '/\', back=.true.) + 1:)
    allocate (this%tests(0))
    this%statement = ''
    open (newunit=this%in, file=path, status='old', action='read', iostat=status)
    if (status /= 0) then
      error = path//': cannot be read'
      return
    end if
    open (newunit=this%out, file=out_path, status='replace', action='write', iostat=status)
    if (status /= 0) then
      error = out_path//': cannot be written'
    else
      call translate_lines(this)
      if (.not. allocated(this%error)) call check_whole_file(this)
      call close_output(this)
      if (allocated(this%error)) error = this%error
    end if
    close (this%in)
  end subroutine translate

  subroutine close_output(this)
    type(translation), intent(in) :: this

    if (allocated(this%error)) then
      close (this%out, status='delete')
    else
      close (this%out)
    end if
  end subroutine close_output

  subroutine translate_lines(this)
    type(translation), intent(inout) :: this
    character(len=line_len) :: line
    integer :: status

    call put_position(this, 1, this%path)
    do while (.not. allocated(this%error))
      read (this%in, '(a)', iostat=status) line
      if (status == iostat_end) exit
      this%line = this%line + 1
      if (status /= 0) then
        call refuse(this, 'the line cannot be read')
      else if (len_trim(line) == line_len) then
        call refuse(this, 'the line is too long')
      else
        call translate_line(this, without_return(line))
      end if
    end do
  end subroutine translate_lines

  ! Lines of files with carriage returns end in one.
  pure function without_return(line) result(text)
    character(len=*), intent(in) :: line
    character(len=:), allocatable :: text

    text = trim(line)
    if (len(text) == 0) return
    if (text(len(text):) == achar(13)) text = trim(text(:len(text) - 1))
  end function without_return

  subroutine translate_line(this, line)
    type(translation), intent(inout) :: this
    character(len=*), intent(in) :: line
    character(len=len(line)) :: code
    integer :: first

    code = masked(line)
    first = verify(code, ' ')
    if (first == 0) then
      call put(this, line)
    else if (scan(code(first:first), '!#') == 1) then
      call put(this, line)
    else if (code(first:first) == '@') then
      call translate_directive(this, line, code)
    else if (index(code, '@') > 0) then
      call refuse(this, 'a directive must stand on a line of its own')
    else
      call note_statement(this, lower(code(first:)))
      call check_names(this, lower(code(first:)))
      call put_statement(this, line, lower(code(first:)))
    end if
  end subroutine translate_line

  ! Adds what runs the tests where the module begins, where its declarations begin, and where it ends.
  subroutine put_statement(this, line, statement)
    type(translation), intent(inout) :: this
    character(len=*), intent(in) :: line, statement
    character(len=:), allocatable :: bare

    bare = trim(statement(:index(statement//'!', '!') - 1))
    if (.not. allocated(this%module_name) .or. this%has_ended) then
      call put(this, line)
    else if (bare == 'module '//this%module_name) then
      call put(this, line)
      call put(this, '  use funit, only: fuge_compat_run_test')
      call put_position(this, this%line + 1, this%path)
    else if (bare == 'implicit none' .and. .not. this%is_private) then
      call put(this, line)
      call put(this, '  private')
      call put(this, '  public :: fuge_compat_run')
      call put_position(this, this%line + 1, this%path)
      this%is_private = .true.
    else if (index(bare, 'end module') == 1) then
      call put_runner(this)
      call put_position(this, this%line, this%path)
      call put(this, line)
      this%has_ended = .true.
    else
      call put(this, line)
    end if
  end subroutine put_statement

  ! The line with its string constants, comment text and tabs out of the way.
  pure function masked(line) result(code)
    character(len=*), intent(in) :: line
    character(len=len(line)) :: code
    character(len=1) :: quote
    integer :: i

    code = line
    quote = ' '
    do i = 1, len(line)
      if (quote /= ' ') then
        code(i:i) = 's'
        if (line(i:i) == quote) quote = ' '
      else if (scan(line(i:i), '"''') == 1) then
        code(i:i) = 's'
        quote = line(i:i)
      else if (line(i:i) == '!') then
        code(i + 1:) = ' '
        exit
      else if (line(i:i) == achar(9)) then
        code(i:i) = ' '
      end if
    end do
  end function masked

  subroutine translate_directive(this, line, code)
    type(translation), intent(inout) :: this
    character(len=*), intent(in) :: line, code
    character(len=len(code)) :: word
    integer :: first, after, i

    first = index(code, '@') + 1
    after = verify(lower(code(first:))//' ', name_characters) + first - 1
    word = lower(code(first:after - 1))
    i = findloc(known(assertions, word), .true., dim=1)
    if (this%pending /= ' ') then
      call refuse_pending(this)
    else if (word == 'test' .or. word == 'before' .or. word == 'after') then
      if (code(after:) /= ' ') call refuse(this, 'text after @'//trim(word))
      this%pending = word
      call put(this, '! @'//trim(word))
    else if (i > 0) then
      call translate_assertion(this, trim(assertions(i)), line, code, after)
    else
      call refuse(this, 'unknown directive @'//code(first:after - 1))
    end if
  end subroutine translate_directive

  elemental logical function known(assertion, word)
    character(len=*), intent(in) :: assertion, word

    known = lower(assertion) == word
  end function known

  ! The call starts on the line of its directive for the compiler's messages, unless it
  ! would grow wider than a line of Fortran may be.
  subroutine translate_assertion(this, name, line, code, start)
    type(translation), intent(inout) :: this
    character(len=*), intent(in) :: name, line, code
    integer, intent(in) :: start
    integer :: opening, closing

    opening = verify(code(start:)//'x', ' ') + start - 1
    closing = closing_parenthesis(code, opening)
    if (closing == 0) then
      if (continued(code)) then
        call refuse(this, '@'//name//' is continued with &')
      else
        call refuse(this, '@'//name//' has no balanced parentheses')
      end if
    else if (code(closing + 1:) /= ' ') then
      call refuse(this, 'text after @'//name)
    else if (code(opening + 1:closing - 1) == ' ') then
      call refuse(this, '@'//name//' has no arguments')
    else
      call put_call(this, 'call '//name//'(', trim(adjustl(line(opening + 1:closing - 1))))
    end if
  end subroutine translate_assertion

  subroutine put_call(this, start, arguments)
    type(translation), intent(inout) :: this
    character(len=*), intent(in) :: start, arguments
    character(len=*), parameter :: location = '& location=SourceLocation('
    integer, parameter :: width = 132

    if (len(start//arguments//', &') <= width) then
      call put(this, start//arguments//', &')
    else
      call put(this, start//' &')
      call put(this, '& '//arguments//', &')
    end if
    call put(this, location//"'"//this%file_name//"', "//decimal(this%line)//'))')
    call put(this, 'if (anyExceptions()) return')
    call put_position(this, this%line + 1, this%path)
  end subroutine put_call

  ! Zero unless code(opening:opening) is a parenthesis that is closed on this line.
  pure integer function closing_parenthesis(code, opening)
    character(len=*), intent(in) :: code
    integer, intent(in) :: opening
    integer :: depth, i

    closing_parenthesis = 0
    if (code(opening:min(opening, len(code))) /= '(') return
    depth = 0
    do i = opening, len(code)
      if (code(i:i) == '(') depth = depth + 1
      if (code(i:i) == ')') depth = depth - 1
      if (depth == 0) exit
    end do
    if (depth == 0) closing_parenthesis = i
  end function closing_parenthesis

  pure logical function continued(code)
    character(len=*), intent(in) :: code
    integer :: last

    last = index(code//'!', '!') - 1
    last = len_trim(code(:last))
    continued = .false.
    if (last > 0) continued = code(last:last) == '&'
  end function continued

  ! Takes the subroutine that a directive waits for, and the name of the module.
  subroutine note_statement(this, statement)
    type(translation), intent(inout) :: this
    character(len=*), intent(in) :: statement
    character(len=:), allocatable :: name

    if (this%pending /= ' ') then
      name = named(statement, 'subroutine', '()')
      if (len(name) == 0) then
        call refuse_pending(this)
      else
        call take_subroutine(this, name)
      end if
    else if (.not. allocated(this%module_name)) then
      name = named(statement, 'module', ' ')
      if (len(name) == 0) return
      this%module_name = name
      if (name//'.pf' /= lower(this%file_name)) then
        call refuse(this, 'module '//name//' is not named like its file '//this%file_name)
      end if
    end if
  end subroutine note_statement

  ! Refuses an entity of the module with a name that pFUnit uses itself.
  subroutine check_names(this, line)
    type(translation), intent(inout) :: this
    character(len=*), intent(in) :: line
    character(len=:), allocatable :: code, name
    integer :: last

    code = trim(line(:index(line//'!', '!') - 1))
    if (this%statement == '') this%statement_line = this%line
    if (code(1:1) == '&') code = code(2:)
    this%statement = this%statement//code
    last = len(this%statement)
    if (continued(code)) then
      this%statement(last:) = ' '
      return
    end if
    do while (this%statement /= '' .and. .not. allocated(this%error))
      last = index(this%statement//';', ';') - 1
      call this%names%next(trim(adjustl(this%statement(:last))), name)
      if (name /= '') call refuse(this, name//' is a name that pFUnit uses itself: choose another', this%statement_line)
      this%statement = this%statement(min(last + 2, len(this%statement) + 1):)
    end do
  end subroutine check_names

  ! The name in "keyword name", with or without the suffix, or an empty string.
  pure function named(statement, keyword, suffix) result(name)
    character(len=*), intent(in) :: statement, keyword, suffix
    character(len=:), allocatable :: name, rest
    integer :: last

    name = ''
    rest = statement(:index(statement//'!', '!') - 1)
    if (index(rest, keyword//' ') /= 1) return
    rest = trim(adjustl(rest(len(keyword) + 1:)))
    last = verify(rest//' ', name_characters) - 1
    name = rest(:last)
    rest = without_blanks(rest(last + 1:))
    if (rest /= '' .and. rest /= suffix) name = ''
  end function named

  pure function without_blanks(string) result(packed)
    character(len=*), intent(in) :: string
    character(len=:), allocatable :: packed
    integer :: i

    packed = ''
    do i = 1, len(string)
      if (string(i:i) /= ' ') packed = packed//string(i:i)
    end do
  end function without_blanks

  subroutine take_subroutine(this, name)
    type(translation), intent(inout) :: this
    character(len=*), intent(in) :: name

    select case (this%pending)
    case default
      this%tests = [character(len=name_len) :: this%tests, name]
    case ('before')
      if (this%before /= ' ') call refuse(this, 'a second @before')
      this%before = name
    case ('after')
      if (this%after /= ' ') call refuse(this, 'a second @after')
      this%after = name
    end select
    this%pending = ' '
  end subroutine take_subroutine

  subroutine check_whole_file(this)
    type(translation), intent(inout) :: this

    if (this%pending /= ' ') then
      call refuse_pending(this)
    else if (.not. allocated(this%module_name)) then
      call refuse(this, 'no module')
    else if (size(this%tests) == 0) then
      call refuse(this, 'no tests')
    else if (.not. this%is_private) then
      call refuse(this, 'no "implicit none", after which the tests are made private')
    else if (.not. this%has_ended) then
      call refuse(this, 'no "end module", before which the procedure that runs the tests has its place')
    end if
  end subroutine check_whole_file

  subroutine refuse_pending(this)
    type(translation), intent(inout) :: this

    call refuse(this, '@'//trim(this%pending)//' must be followed by "subroutine name()"')
  end subroutine refuse_pending

  ! For the line that was read last, unless another one is named.
  subroutine refuse(this, reason, line)
    type(translation), intent(inout) :: this
    character(len=*), intent(in) :: reason
    integer, intent(in), optional :: line
    integer :: number

    number = this%line
    if (present(line)) number = line
    this%error = this%path//':'//decimal(number)//': '//reason
  end subroutine refuse

  ! The driver calls this procedure, the last one of the module.
  subroutine put_runner(this)
    type(translation), intent(inout) :: this
    integer :: i

    call put_position(this, this%written + 2, this%out_path)
    call put(this, '  subroutine fuge_compat_run()')
    do i = 1, size(this%tests)
      call put_test(this, trim(this%tests(i)))
    end do
    call put(this, '  end subroutine fuge_compat_run')
  end subroutine put_runner

  subroutine put_test(this, name)
    type(translation), intent(inout) :: this
    character(len=*), intent(in) :: name

    call put(this, '    call fuge_compat_run_test( &')
    call put(this, "      & '"//this%module_name//".'// &")
    call put(this, "      & '"//name//"', &")
    if (this%before /= ' ') call put(this, '      & before='//trim(this%before)//', &')
    if (this%after /= ' ') call put(this, '      & after='//trim(this%after)//', &')
    call put(this, '      & test='//name//')')
  end subroutine put_test

  ! Makes compilers report what follows at this place.
  subroutine put_position(this, line, path)
    type(translation), intent(inout) :: this
    integer, intent(in) :: line
    character(len=*), intent(in) :: path

    call put(this, '# '//decimal(line)//' "'//path//'"')
  end subroutine put_position

  subroutine put(this, text)
    type(translation), intent(inout) :: this
    character(len=*), intent(in) :: text

    write (this%out, '(a)') text
    this%written = this%written + 1
  end subroutine put

  pure function decimal(number) result(text)
    integer, intent(in) :: number
    character(len=:), allocatable :: text
    character(len=12) :: buffer

    write (buffer, '(i0)') number
    text = trim(buffer)
  end function decimal

  pure function lower(string)
    character(len=*), intent(in) :: string
    character(len=len(string)) :: lower
    integer :: i

    lower = string
    do i = 1, len(string)
      if (lge(string(i:i), 'A') .and. lle(string(i:i), 'Z')) then
        lower(i:i) = achar(iachar(string(i:i)) + 32)
      end if
    end do
  end function lower

end module pf_translation
