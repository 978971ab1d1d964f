!> The command line of the program `fuge`, and job files: options in their order.
module command_line
  use fuge_core, only: dp => fuge_dp, fuge_info, FUGE_ERR_OPTION
  use number_words, only: read_real
  use option_table, only: may_repeat, option_number, takes_value, INPUTS, OPTION_NAMES
  use similar_words, only: similar_word
  use text_lines, only: line_reader
  implicit none
  private

  public :: refuse

  !> An option as it is given.
  type, public :: setting
    !> Its name.
    character(len=len(OPTION_NAMES)) :: name = ''
    character(len=:), allocatable :: value
    !> What messages call it: the option with its value, or the line of a job file.
    character(len=:), allocatable :: source
    !> Where paths begin: the folder of the job file with its slash, or empty.
    character(len=:), allocatable :: folder
  end type setting

  !> The options, those of a job file where it is named.
  type, public :: arguments
    type(setting), allocatable :: settings(:)
    !> How many there are.
    integer :: count = 0
    !> The job file; not allocated without one.
    character(len=:), allocatable :: job
  contains
    procedure :: read => read_arguments
    procedure :: has
    procedure :: position
    procedure :: file
    procedure :: path
    procedure :: number
    procedure :: numbers
    procedure, private :: add
    procedure, private :: read_job
  end type arguments

contains

  !> Errors: FUGE_ERR_OPTION; FUGE_ERR_FILE for a job file.
  subroutine read_arguments(self, info)
    class(arguments), intent(inout) :: self
    type(fuge_info), intent(inout) :: info
    character(len=:), allocatable :: value, word
    integer :: k

    allocate (self%settings(16))
    k = 0
    do while (k < command_argument_count() .and. .not. info%failed())
      k = k + 1
      word = argument(k)
      if (index(word, '-') /= 1) then
        call self%read_job(word, info)
        cycle
      end if
      value = ''
      if (needs_value(word)) then
        k = k + 1
        if (k > command_argument_count()) call refuse(word//' needs a value', info)
        if (.not. info%failed()) value = argument(k)
      end if
      if (.not. info%failed()) call self%add(word, value, '', '', info)
    end do
    if (self%count == 0 .and. .not. info%failed()) call refuse('no options are given', info)
  end subroutine read_arguments

  function argument(k) result(word)
    integer, intent(in) :: k
    character(len=:), allocatable :: word
    integer :: length

    call get_command_argument(k, length=length)
    allocate (character(len=length) :: word)
    call get_command_argument(k, word(:))
  end function argument

  !> Is `word` an option with a value?
  pure function needs_value(word) result(needs)
    character(len=*), intent(in) :: word
    logical :: needs
    integer :: which

    which = number_of(word)
    needs = which > 0
    if (needs) needs = takes_value(which)
  end function needs_value

  !> Number of the option --name; 0 for another word.
  pure function number_of(word) result(which)
    character(len=*), intent(in) :: word
    integer :: which

    which = 0
    if (len(word) > 2) then
      if (word(:2) == '--') which = option_number(word(3:))
    end if
  end function number_of

  !> A job file: an option on each line, its hyphens may be left out; comments from # on.
  subroutine read_job(self, path, info)
    class(arguments), intent(inout) :: self
    character(len=*), intent(in) :: path
    type(fuge_info), intent(inout) :: info
    type(line_reader) :: file
    character(len=:), allocatable :: name, value
    integer :: before, split
    logical :: exists

    before = self%count
    if (allocated(self%job)) call refuse('"'//self%job//'" and "'//path//'" are two job files', info)
    if (info%failed()) return
    self%job = path
    call file%open(path, info)
    do while (.not. info%failed())
      call file%next(exists, info)
      if (.not. exists) exit
      split = scan(file%line//' ', ' =')
      name = file%line(:split - 1)
      value = trim(adjustl(file%line(min(split + 1, len(file%line) + 1):)))
      if (index(name, '--') /= 1) name = '--'//name
      call check_line(name, value, path(:index(path, '/', back=.true.)), file%source(), info)
      if (.not. info%failed()) call self%add(name, value, file%source(), path(:index(path, '/', back=.true.)), info)
    end do
    call file%close()
    if (self%count == before .and. .not. info%failed()) &
      call refuse('"'//path//'" has no options: one on each line is needed', info)
  end subroutine read_job

  !> Refuse an option with no value, or with one too many, on a line of a job file, and a second option. Paths begin at
  !> `folder`.
  subroutine check_line(name, value, folder, source, info)
    character(len=*), intent(in) :: name, value, folder, source
    type(fuge_info), intent(inout) :: info
    character(len=:), allocatable :: second

    if (number_of(name) == 0) return
    if (takes_value(number_of(name)) .and. len(value) == 0) then
      call refuse(source//': '//name//' needs a value', info)
    else if (.not. takes_value(number_of(name)) .and. len(value) > 0) then
      call refuse(source//': '//name//' has no value', info)
    else
      second = inner_option(number_of(name), value, folder)
      if (len(second) > 0) &
        call refuse(source//': "'//second//'" begins a second option, but there is one on each line', info)
    end if
  end subroutine check_line

  !> The word behind a blank in the value of option `which` that begins a second option; empty if there is none. Without
  !> hyphens it may be a word of a name, unless an input is to be read that does not exist.
  function inner_option(which, value, folder) result(word)
    integer, intent(in) :: which
    character(len=*), intent(in) :: value, folder
    character(len=:), allocatable :: word, rest
    logical :: is_input

    word = ''
    is_input = any(INPUTS == OPTION_NAMES(which))
    if (is_input) then
      ! The inputs of a body are behind its name.
      if (is_file(value, folder)) return
      if (is_file(value(index(value, '=') + 1:), folder)) return
    end if
    rest = value
    do
      rest = adjustl(rest(scan(rest//' ', ' '):))
      word = rest(:scan(rest//' ', ' =') - 1)
      if (len_trim(rest) == 0 .or. number_of(word) > 0) return
      if (is_input .and. option_number(word) > 0) return
    end do
  end function inner_option

  !> Is there a file at this path, which begins at `folder` unless it is absolute?
  function is_file(path, folder)
    character(len=*), intent(in) :: path, folder
    logical :: is_file

    is_file = len(path) > 0
    if (.not. is_file) return
    if (path(1:1) == '/') then
      inquire (file=path, exist=is_file)
    else
      inquire (file=folder//path, exist=is_file)
    end if
  end function is_file

  !> Add an option. `source` is empty on the command line.
  subroutine add(self, word, value, source, folder, info)
    class(arguments), intent(inout) :: self
    character(len=*), intent(in) :: word, value, source, folder
    type(fuge_info), intent(inout) :: info
    type(setting), allocatable :: more(:)
    integer :: k, which

    which = number_of(word)
    if (which == 0) then
      call refuse(prefix(source)//'unknown option "'//word//'"'//suggestion(word), info)
      return
    else if (self%has(trim(OPTION_NAMES(which))) .and. .not. may_repeat(which)) then
      call refuse(prefix(source)//word//' is given twice', info)
      return
    end if
    if (self%count == size(self%settings)) then
      allocate (more(2*self%count))
      do k = 1, self%count
        call copy_setting(self%settings(k), more(k))
      end do
      call move_alloc(more, self%settings)
    end if
    self%count = self%count + 1
    associate (new => self%settings(self%count))
      new%name = OPTION_NAMES(which)
      new%value = value
      new%folder = folder
      new%source = word
      if (len(value) > 0) new%source = word//' '//value
      if (len(source) > 0) new%source = source//': '//new%source
    end associate
  end subroutine add

  !> What may be meant by an unknown option, in words; empty for one that is like no other.
  pure function suggestion(word) result(text)
    character(len=*), intent(in) :: word
    character(len=:), allocatable :: text
    integer :: which

    text = ''
    which = similar_word(word(max(verify(word, '-'), 1):), OPTION_NAMES)
    if (which > 0) text = ' (did you mean --'//trim(OPTION_NAMES(which))//'?)'
  end function suggestion

  !> Component by component, which all compilers do rightly.
  pure subroutine copy_setting(from, to)
    type(setting), intent(in) :: from
    type(setting), intent(inout) :: to

    to%name = from%name
    to%value = from%value
    to%source = from%source
    to%folder = from%folder
  end subroutine copy_setting

  pure function prefix(source)
    character(len=*), intent(in) :: source
    character(len=len(source) + merge(2, 0, len(source) > 0)) :: prefix

    prefix = source
    if (len(source) > 0) prefix(len(source) + 1:) = ': '
  end function prefix

  pure subroutine refuse(reason, info)
    character(len=*), intent(in) :: reason
    type(fuge_info), intent(inout) :: info

    info%status = FUGE_ERR_OPTION
    info%message = reason//': see fuge --help'
  end subroutine refuse

  pure function has(self, name)
    class(arguments), intent(in) :: self
    character(len=*), intent(in) :: name
    logical :: has

    has = self%position(name) > 0
  end function has

  !> The number of the first option of this name after option `after`; 0 if there is none.
  pure function position(self, name, after) result(k)
    class(arguments), intent(in) :: self
    character(len=*), intent(in) :: name
    integer, intent(in), optional :: after
    integer :: k

    k = 1
    if (present(after)) k = after + 1
    do k = k, self%count
      if (self%settings(k)%name == name) return
    end do
    k = 0
  end function position

  !> The path that an option names; empty if it is not given.
  pure function file(self, name)
    class(arguments), intent(in) :: self
    character(len=*), intent(in) :: name
    character(len=:), allocatable :: file

    file = ''
    if (self%has(name)) file = self%path(self%position(name))
  end function file

  !> The path that option k names, after the first `skipped` characters of its value (default 0): a relative one in a
  !> job file begins at its folder.
  pure function path(self, k, skipped)
    class(arguments), intent(in) :: self
    integer, intent(in) :: k
    integer, intent(in), optional :: skipped
    character(len=:), allocatable :: path

    path = self%settings(k)%value
    if (present(skipped)) path = path(skipped + 1:)
    if (index(path, '/') /= 1) path = self%settings(k)%folder//path
  end function path

  !> The number that option k has for a value.
  subroutine number(self, k, value, info)
    class(arguments), intent(in) :: self
    integer, intent(in) :: k
    real(dp), intent(out) :: value
    type(fuge_info), intent(inout) :: info
    logical :: valid

    call read_real(self%settings(k)%value, value, valid)
    if (.not. valid) call refuse(self%settings(k)%source//': a number is needed, not "'//self%settings(k)%value//'"', &
                                 info)
  end subroutine number

  !> The numbers, separated by commas, that option k has for a value.
  subroutine numbers(self, k, values, info)
    class(arguments), intent(in) :: self
    integer, intent(in) :: k
    real(dp), allocatable, intent(inout) :: values(:)
    type(fuge_info), intent(inout) :: info
    integer :: begin, commas, i, length
    logical :: valid

    associate (list => self%settings(k)%value)
      commas = count([(list(i:i) == ',', i=1, len(list))])
      if (allocated(values)) deallocate (values)
      allocate (values(commas + 1), source=0.0_dp)
      begin = 1
      do i = 1, size(values)
        length = index(list(begin:)//',', ',') - 1
        call read_real(trim(adjustl(list(begin:begin + length - 1))), values(i), valid)
        if (.not. valid) call refuse(self%settings(k)%source//': numbers with commas between them are needed, not "' &
                                     //list//'"', info)
        if (info%failed()) return
        begin = begin + length + 1
      end do
    end associate
  end subroutine numbers

end module command_line
