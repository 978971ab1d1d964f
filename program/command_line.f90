!> The command line of the program `fuge`, and job files: options in their order.
module command_line
  use fuge, only: dp => fuge_dp, fuge_info, FUGE_ERR_FILE, FUGE_ERR_OPTION
  use number_words, only: read_real
  use option_table, only: may_repeat, option_number, takes_value, OPTION_NAMES
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
    character(len=:), allocatable :: place
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
    integer :: split
    logical :: exists

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
      call check_line(name, value, file%place(), info)
      if (.not. info%failed()) call self%add(name, value, file%place(), path(:index(path, '/', back=.true.)), info)
    end do
    call file%close()
  end subroutine read_job

  !> Refuse an option with no value, or with one too many, on a line of a job file.
  subroutine check_line(name, value, place, info)
    character(len=*), intent(in) :: name, value, place
    type(fuge_info), intent(inout) :: info

    if (number_of(name) == 0) return
    if (takes_value(number_of(name)) .and. len(value) == 0) then
      call refuse(place//': '//name//' needs a value', info)
    else if (.not. takes_value(number_of(name)) .and. len(value) > 0) then
      call refuse(place//': '//name//' has no value', info)
    end if
  end subroutine check_line

  !> Add an option. `place` is empty on the command line.
  subroutine add(self, word, value, place, folder, info)
    class(arguments), intent(inout) :: self
    character(len=*), intent(in) :: word, value, place, folder
    type(fuge_info), intent(inout) :: info
    type(setting), allocatable :: more(:)
    integer :: k, which

    which = number_of(word)
    if (which == 0) then
      call refuse(prefix(place)//'unknown option "'//word//'"', info)
      return
    else if (self%has(trim(OPTION_NAMES(which))) .and. .not. may_repeat(which)) then
      call refuse(prefix(place)//word//' is given twice', info)
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
      new%place = word
      if (len(value) > 0) new%place = word//' '//value
      if (len(place) > 0) new%place = place//': '//new%place
    end associate
  end subroutine add

  !> Component by component, which all compilers do rightly.
  pure subroutine copy_setting(from, to)
    type(setting), intent(in) :: from
    type(setting), intent(inout) :: to

    to%name = from%name
    to%value = from%value
    to%place = from%place
    to%folder = from%folder
  end subroutine copy_setting

  pure function prefix(place)
    character(len=*), intent(in) :: place
    character(len=len(place) + merge(2, 0, len(place) > 0)) :: prefix

    prefix = place
    if (len(place) > 0) prefix(len(place) + 1:) = ': '
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

  !> The place of the first option of this name after `after`; 0 if there is none.
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
    if (.not. valid) call refuse(self%settings(k)%place//': a number is needed, not "'//self%settings(k)%value//'"', &
                                 info)
  end subroutine number

end module command_line
