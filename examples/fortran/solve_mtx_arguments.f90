!> Command line of the example `solve_mtx`.
module solve_mtx_arguments
  use fuge, only: dp => fuge_dp, fuge_info, FUGE_ERR_OPTION
  implicit none
  private

  public :: print_help

  !> Options with a value; the others have none.
  integer, parameter :: WITH_VALUE = 13
  character(len=9), parameter :: NAMES(WITH_VALUE + 2) = [character(len=9) :: 'alpha', 'gap', 'load', 'approach', &
    'modes', 'resultant', 'play', 'output', 'stiffness', 'contact', 'fixed', 'external', 'field', 'floats', 'help']

  type :: setting
    logical :: given = .false.
    character(len=:), allocatable :: value
  end type setting

  !> The options of the command line.
  type, public :: arguments
    private
    type(setting) :: settings(size(NAMES))
  contains
    procedure, public :: read => read_arguments
    procedure, public :: has
    procedure, public :: file
    procedure, public :: number
  end type arguments

contains

  !> Error: FUGE_ERR_OPTION.
  subroutine read_arguments(self, info)
    class(arguments), intent(inout) :: self
    type(fuge_info), intent(out) :: info
    character(len=:), allocatable :: word
    integer :: k, which

    k = 0
    do while (k < command_argument_count())
      k = k + 1
      word = argument(k)
      which = place(word)
      if (which == 0) then
        call refuse('unknown option "'//word//'"', info)
      else if (self%settings(which)%given) then
        call refuse(word//' is given twice', info)
      else if (which <= WITH_VALUE .and. k == command_argument_count()) then
        call refuse(word//' needs a value', info)
      end if
      if (info%failed()) return
      self%settings(which)%given = .true.
      if (which > WITH_VALUE) cycle
      k = k + 1
      self%settings(which)%value = argument(k)
    end do
    if (.not. self%has('help')) call check(self, info)
  end subroutine read_arguments

  function argument(k) result(word)
    integer, intent(in) :: k
    character(len=:), allocatable :: word
    integer :: length

    call get_command_argument(k, length=length)
    allocate (character(len=length) :: word)
    call get_command_argument(k, word(:))
  end function argument

  !> Number of the option --name; 0 for another word.
  pure function place(word) result(which)
    character(len=*), intent(in) :: word
    integer :: which

    do which = size(NAMES), 1, -1
      if (word == '--'//NAMES(which)) return
    end do
    which = 0
  end function place

  !> Check which options go together.
  subroutine check(self, info)
    class(arguments), intent(in) :: self
    type(fuge_info), intent(inout) :: info
    integer :: motions

    motions = count([self%has('load'), self%has('approach'), self%has('modes')])
    if (self%has('alpha') .eqv. self%has('stiffness')) then
      call refuse('one of --alpha and --stiffness is needed', info)
    else if (.not. self%has('gap')) then
      call refuse('--gap is needed', info)
    else if (self%has('modes') .neqv. self%has('resultant')) then
      call refuse('--modes and --resultant go together', info)
    else if (self%has('alpha') .and. motions /= 1) then
      call refuse('one of --load, --approach and --modes is needed', info)
    else if (self%has('stiffness') .and. (motions > 1 .or. self%has('modes'))) then
      call refuse('with --stiffness no more than one of --load and --approach is possible', info)
    else if (self%has('stiffness') .and. .not. self%has('contact')) then
      call refuse('--contact is needed with --stiffness', info)
    end if
    call check_number(self, 'load', info)
    call check_number(self, 'approach', info)
    if (self%has('stiffness')) return
    call check_absent(self, 'contact', info)
    call check_absent(self, 'fixed', info)
    call check_absent(self, 'external', info)
    call check_absent(self, 'floats', info)
    call check_absent(self, 'field', info)
  end subroutine check

  pure subroutine check_number(self, name, info)
    class(arguments), intent(in) :: self
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info
    real(dp) :: value
    integer :: status

    if (info%failed() .or. .not. self%has(name)) return
    associate (word => self%settings(place('--'//name))%value)
      status = verify(word, '0123456789+-.eEdD')
      if (status == 0) read (word, *, iostat=status) value
      if (status /= 0 .or. len(word) == 0) call refuse('--'//name//' needs a number, not "'//word//'"', info)
    end associate
  end subroutine check_number

  pure subroutine check_absent(self, name, info)
    class(arguments), intent(in) :: self
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info

    if (self%has(name) .and. .not. info%failed()) call refuse('--'//name//' needs --stiffness', info)
  end subroutine check_absent

  pure subroutine refuse(reason, info)
    character(len=*), intent(in) :: reason
    type(fuge_info), intent(inout) :: info

    info%status = FUGE_ERR_OPTION
    info%message = reason//': see solve_mtx --help'
  end subroutine refuse

  pure function has(self, name)
    class(arguments), intent(in) :: self
    character(len=*), intent(in) :: name
    logical :: has

    has = self%settings(place('--'//name))%given
  end function has

  !> The name of a file; empty if it is not given.
  pure function file(self, name)
    class(arguments), intent(in) :: self
    character(len=*), intent(in) :: name
    character(len=:), allocatable :: file

    file = ''
    if (self%has(name)) file = self%settings(place('--'//name))%value
  end function file

  pure function number(self, name)
    class(arguments), intent(in) :: self
    character(len=*), intent(in) :: name
    real(dp) :: number

    read (self%settings(place('--'//name))%value, *) number
  end function number

  subroutine print_help()
    character(len=*), parameter :: LINES(33) = [character(len=96) :: &
      'solve_mtx: a contact problem from Matrix Market files to a table', &
      '', &
      '  solve_mtx --alpha FILE --gap FILE MOTION [--play FILE] [--output FILE]', &
      '  solve_mtx --stiffness FILE --contact FILE --gap FILE [--fixed FILE] [--floats]', &
      '            [--external FILE] [MOTION] [--play FILE] [--output FILE] [--field FILE]', &
      '', &
      'MOTION of the rigid counter-body, one of (none with --stiffness: it stands still)', &
      '  --load F0                       pressed on with this force', &
      '  --approach V0                   moved by this length', &
      '  --modes FILE --resultant FILE   rigid motions in general, only with --alpha', &
      '', &
      'Files, n points, nd degrees of freedom counted from 1', &
      '  --alpha      n x n    influence matrix, displacement per force', &
      '  --gap        n        initial gaps', &
      '  --play       n        distance of the second stop; -1: none, 0: tied', &
      '  --modes      n x m    how far each point closes per unit of each rigid motion', &
      '  --resultant  m        of the contact forces in each motion', &
      '  --stiffness  nd x nd  stiffness matrix, force per displacement', &
      '  --contact    n x nd   row i: direction in which the force of point i acts on the body,', &
      '                        into the body, in the columns of its degrees of freedom', &
      '  --fixed      k x 1    degrees of freedom that are held; k x 2: and their displacements', &
      '  --external   nd       external forces on the body', &
      '  --floats              the supports leave rigid motions, which the contact has to resist', &
      '', &
      'Tables, CSV with comments after #', &
      '  --output     point, force and gap; without it on standard output', &
      '  --field      displacements of all degrees of freedom', &
      '', &
      'Matrix Market files: real or integer, array or coordinate, general or symmetric. Units', &
      'are yours, as long as they agree.', &
      '', &
      'Exit status 0: done; a warning is on standard error and in the table. 1: an error, the', &
      'message is on standard error.']

    integer :: k

    print '(a)', (trim(LINES(k)), k=1, size(LINES))
  end subroutine print_help

end module solve_mtx_arguments
