!> Status codes, their texts, and the report that every call fills.
!>
!> 0 is done, positive is done with a warning, negative is an error that leaves all outputs
!> untouched. This is the one table of codes and texts: include/fuge_core.h, doc/errors.md and the
!> man page repeat them, and a test compares them.
!>
!> Messages name points, rows, degrees of freedom and modes by their index, which counts from 1
!> in Fortran and from 0 in C. Both languages share the procedures that compose messages, most of
!> them with an `info` that is intent(out), and a message may be part of another one. So the
!> message itself knows which of its numbers are indices: `index_text` marks them, `report` keeps
!> the marked text beside the one that Fortran reads, and `message_counting_from` makes that of
!> another language from it.
module fuge_status
  use fuge_kinds, only: dp
  use fuge_number_text, only: text, INDEX_MARK
  implicit none
  private

  public :: composed_message, fuge_status_text, message_counting_from, report, require_memory

  !> Done, the residual is at most the tolerance.
  integer, parameter, public :: FUGE_DONE = 0
  !> Solved, but the residual is above the tolerance.
  integer, parameter, public :: FUGE_WARN_RESIDUAL = 1
  !> Solved, but the solution is one of many: the message says which part is not unique.
  integer, parameter, public :: FUGE_WARN_NOT_UNIQUE = 2
  !> Solved, but the problem is so badly conditioned that the forces may be far off although the equations hold.
  integer, parameter, public :: FUGE_WARN_ILL_CONDITIONED = 3
  !> Found, but a node is a contact point of two pairs of surfaces.
  integer, parameter, public :: FUGE_WARN_PAIRS = 4
  !> Solved, but no point of the bodies touches and all gaps open: loads pull, or surfaces look into their bodies.
  integer, parameter, public :: FUGE_WARN_NO_CONTACT = 5
  !> Solved, but some load cases have no solution, or a warning.
  integer, parameter, public :: FUGE_WARN_CASES = 6
  !> Nothing is proved of the solution, or not all: the message has the reason.
  integer, parameter, public :: FUGE_WARN_NOT_PROVED = 7
  !> Found, but points lie on the border between two states: the gradient is that of one side of a kink.
  integer, parameter, public :: FUGE_WARN_KINK = 8
  !> Found, but for other forces than those wanted, which the points cannot have.
  integer, parameter, public :: FUGE_WARN_UNREACHABLE = 9
  !> Solved, but the estimated error is above the wanted one: the message says what was reached, and why.
  integer, parameter, public :: FUGE_WARN_ACCURACY = 10
  !> A size or an index is invalid, or arrays differ in length.
  integer, parameter, public :: FUGE_ERR_SIZE = -1
  !> An array is not contiguous; in C a pointer is NULL.
  integer, parameter, public :: FUGE_ERR_POINTER = -2
  !> An input is NaN or infinite.
  integer, parameter, public :: FUGE_ERR_NOT_FINITE = -3
  !> A cell width or spacing is not positive, or a position is out of range.
  integer, parameter, public :: FUGE_ERR_WIDTH = -4
  !> An elastic modulus is not positive, or Poisson's ratio is out of range.
  integer, parameter, public :: FUGE_ERR_MODULUS = -5
  !> Unknown element.
  integer, parameter, public :: FUGE_ERR_ELEMENT = -6
  !> The grid is not uniform, and the element is symmetric on equal widths only or the call needs equal cells.
  integer, parameter, public :: FUGE_ERR_GRID = -7
  !> The influence or stiffness matrix is not symmetric.
  integer, parameter, public :: FUGE_ERR_NOT_SYMMETRIC = -8
  !> The influence or stiffness matrix is not positive definite where it has to be.
  integer, parameter, public :: FUGE_ERR_NOT_DEFINITE = -9
  !> No contact forces can be in equilibrium with these resultants.
  integer, parameter, public :: FUGE_ERR_NO_EQUILIBRIUM = -10
  !> The limit of pivots or contact sets was reached.
  integer, parameter, public :: FUGE_ERR_ITERATION_LIMIT = -11
  !> An allocation failed.
  integer, parameter, public :: FUGE_ERR_MEMORY = -12
  !> A call came before another one that it requires.
  integer, parameter, public :: FUGE_ERR_CALL_ORDER = -13
  !> An option has an invalid value.
  integer, parameter, public :: FUGE_ERR_OPTION = -14
  !> This engine or operator cannot solve this kind of problem.
  integer, parameter, public :: FUGE_ERR_UNSUPPORTED = -15
  !> Numbers are too large or too small for double precision.
  integer, parameter, public :: FUGE_ERR_OVERFLOW = -16
  !> A callback failed or returned NaN or infinity.
  integer, parameter, public :: FUGE_ERR_CALLBACK = -17
  !> The progress monitor cancelled the solve.
  integer, parameter, public :: FUGE_ERR_CANCELLED = -18
  !> A file cannot be read or written.
  integer, parameter, public :: FUGE_ERR_FILE = -19
  !> An upper stop lies below the lower one.
  integer, parameter, public :: FUGE_ERR_GAP = -20
  !> Rigid modes depend on each other, or one moves no point.
  integer, parameter, public :: FUGE_ERR_MODES = -21
  !> A degree of freedom is out of range or named twice.
  integer, parameter, public :: FUGE_ERR_DOF = -22
  !> A face of a mesh is folded over, has no area or looks the wrong way, or surfaces do not face each other.
  integer, parameter, public :: FUGE_ERR_MESH = -23
  !> A compliance, a limit of a force or a stiffness is negative.
  integer, parameter, public :: FUGE_ERR_LAW = -24

  !> The range of the codes.
  integer, parameter, public :: LOWEST_STATUS = FUGE_ERR_LAW
  integer, parameter, public :: HIGHEST_STATUS = FUGE_WARN_ACCURACY

  !> The text of each code, lowest first.
  character(len=64), parameter, public :: STATUS_MEANINGS(LOWEST_STATUS:HIGHEST_STATUS) = [character(len=64) :: &
    'a compliance, a limit of a force or a stiffness is negative', &
    'faces have no area, look the wrong way or not at each other', &
    'a degree of freedom is out of range or named twice', &
    'rigid modes depend on each other, or one moves no point', &
    'an upper stop lies below the lower one', &
    'a file cannot be read or written', &
    'the progress monitor cancelled the solve', &
    'a callback failed or returned NaN or infinity', &
    'numbers are too large or too small for double precision', &
    'this engine or operator cannot solve this kind of problem', &
    'an option has an invalid value', &
    'a call came before another one that it requires', &
    'out of memory', &
    'the iteration limit was reached', &
    'no contact forces can be in equilibrium with this load', &
    'the influence or stiffness matrix is not positive definite', &
    'the influence or stiffness matrix is not symmetric', &
    'the grid is not uniform, as this element or call requires', &
    'unknown element', &
    'an elastic modulus or Poisson''s ratio is out of range', &
    'a width or a position is out of range', &
    'an input is NaN or infinite', &
    'a required pointer is NULL, or an array is not contiguous', &
    'a size or an index is invalid, or arrays differ in length', &
    'done', &
    'done, but the residual is above the tolerance', &
    'done, but the solution is not unique', &
    'done, but the forces may be far off', &
    'done, but pairs share a node', &
    'done, but no point touches and all gaps open', &
    'done, but some load cases failed or have a warning', &
    'done, but the solution is not proved', &
    'done, but at a kink: the gradient is that of one side', &
    'done, but for other forces: those wanted are not possible', &
    'done, but less exactly than wanted']

  character(len=*), parameter :: UNKNOWN_STATUS = 'unknown status'

  !> Length of a message; longer ones are cut.
  integer, parameter, public :: FUGE_MESSAGE_LENGTH = 256

  !> Length of a message with the marks of up to 32 indices.
  integer, parameter :: COMPOSED_LENGTH = FUGE_MESSAGE_LENGTH + 32

  !> The report of a call.
  type, public :: fuge_info
    !> One of the codes above.
    integer :: status = FUGE_DONE
    !> What is wrong, where (index from 1, value) and how to mend it; blank when done.
    character(len=FUGE_MESSAGE_LENGTH) :: message = ''
    !> Pivots of the tableau, contact sets of the other engines.
    integer :: iterations = 0
    !> Points with a contact force.
    integer :: contacts = 0
    !> Products A f of the operator, including that of the certificate.
    integer :: products = 0
    !> Applications of a preconditioner.
    integer :: preconditionings = 0
    !> The certificate: the largest relative violation, see `fuge_residual`; no unit.
    real(dp) :: residual = 0.0_dp
    !> Estimate of the largest error of a force relative to the largest force, for the data as they are stored, up to 1:
    !> no digit is known, as where the forces are not unique. No unit; 0 without forces, and from calls that do not
    !> solve a contact problem.
    real(dp) :: force_error = 0.0_dp
    !> Elastic energy of the solution (paper, equation 8): half the sum of f (A + D) f and q S q; force times length.
    real(dp) :: energy = 0.0_dp
    !> The message with its indices marked; only `report` sets it, together with `message`.
    character(len=COMPOSED_LENGTH), private :: composed = ''
  contains
    procedure :: failed
  end type fuge_info

  !> Report FUGE_ERR_MEMORY unless `stat` of an allocation is 0. It is passed by value, so that the compiler knows that
  !> it stays what it is.
  interface require_memory
    module procedure require_memory_for
    module procedure require_memory_for_count
  end interface require_memory

contains

  !> Is it an error? Outputs were then left untouched.
  pure function failed(self)
    class(fuge_info), intent(in) :: self
    logical :: failed

    failed = self%status < 0
  end function failed

  !> Set status and message, and nothing else. `message` has its indices from `index_text`.
  pure subroutine report(info, status, message)
    type(fuge_info), intent(inout) :: info
    integer, intent(in) :: status
    character(len=*), intent(in) :: message

    info%status = status
    info%composed = message
    info%message = message_counting_from(1, info)
  end subroutine report

  !> `what` completes the message 'no memory for ..'.
  pure subroutine require_memory_for(stat, what, info)
    integer, value :: stat
    character(len=*), intent(in) :: what
    type(fuge_info), intent(inout) :: info

    if (stat /= 0) call report(info, FUGE_ERR_MEMORY, 'no memory for '//what)
  end subroutine require_memory_for

  !> The same for a count of things: 'no memory for the gaps of 12 points' has what = 'the gaps of', unit = 'points'.
  !> The text is composed only where it is needed.
  pure subroutine require_memory_for_count(stat, what, count, unit, info)
    integer, value :: stat
    integer, intent(in) :: count
    character(len=*), intent(in) :: what, unit
    type(fuge_info), intent(inout) :: info

    if (stat /= 0) call require_memory_for(stat, trim(what//' '//text(count))//' '//unit, info)
  end subroutine require_memory_for_count

  !> The message with its indices marked, to be part of another one that `report` is given.
  pure function composed_message(info) result(message)
    type(fuge_info), intent(in) :: info
    character(len=len_trim(info%composed)) :: message

    message = info%composed
  end function composed_message

  !> The message for a language whose indices start at `first`.
  pure function message_counting_from(first, info) result(message)
    integer, intent(in) :: first
    type(fuge_info), intent(in) :: info
    character(len=FUGE_MESSAGE_LENGTH) :: message
    integer :: begin, last, written

    message = ''
    written = 0
    begin = 1
    do while (begin <= len_trim(info%composed))
      last = end_of_part(info%composed, begin)
      if (info%composed(begin:begin) == INDEX_MARK) then
        call append(trim(renumbered(info%composed(begin + 1:last), first)), message, written)
      else
        call append(info%composed(begin:last), message, written)
      end if
      begin = last + 1
    end do
  end function message_counting_from

  !> The last character of the part that begins at `begin`: a mark with its number, or the text
  !> before the next mark.
  pure function end_of_part(composed, begin) result(last)
    character(len=*), intent(in) :: composed
    integer, intent(in) :: begin
    integer :: last

    if (composed(begin:begin) == INDEX_MARK) then
      last = begin + verify(composed(begin + 1:)//' ', '-0123456789') - 1
    else
      last = begin + index(composed(begin + 1:)//INDEX_MARK, INDEX_MARK) - 1
    end if
  end function end_of_part

  !> An index that counts from 1, as text, counted from `first`.
  pure function renumbered(number, first) result(string)
    character(len=*), intent(in) :: number
    integer, intent(in) :: first
    character(len=12) :: string
    integer :: k, value

    value = 0
    do k = 1, len(number)
      if (number(k:k) /= '-') value = 10*value - (iachar(number(k:k)) - iachar('0'))
    end do
    if (scan(number, '-') < 1) value = -value
    string = text(value + (first - 1))
  end function renumbered

  !> Append a part to the first `written` characters; what does not fit is cut.
  pure subroutine append(part, message, written)
    character(len=*), intent(in) :: part
    character(len=FUGE_MESSAGE_LENGTH), intent(inout) :: message
    integer, intent(inout) :: written

    if (written >= len(message)) return
    message(written + 1:) = part
    written = written + len(part)
  end subroutine append

  pure function meaning_length(status) result(length)
    integer, intent(in) :: status
    integer :: length

    length = len(UNKNOWN_STATUS)
    if (status >= LOWEST_STATUS .and. status <= HIGHEST_STATUS) length = len_trim(STATUS_MEANINGS(status))
  end function meaning_length

  !> The meaning of a status code, in English.
  pure function fuge_status_text(status) result(meaning)
    integer, intent(in) :: status
    character(len=meaning_length(status)) :: meaning

    if (status < LOWEST_STATUS .or. status > HIGHEST_STATUS) then
      meaning = UNKNOWN_STATUS
    else
      meaning = STATUS_MEANINGS(status)
    end if
  end function fuge_status_text

end module fuge_status
