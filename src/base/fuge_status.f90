!> Status codes, their texts, and the report that every call fills.
!>
!> 0 is done, positive is done with a warning, negative is an error that
!> leaves all outputs untouched. This is the one table of codes and texts: include/fuge.h,
!> doc/errors.md and the man page repeat them, and a test compares them.
module fuge_status
  use fuge_kinds, only: dp
  implicit none
  private

  public :: fuge_status_text, report

  !> Done, the residual is at most the tolerance.
  integer, parameter, public :: FUGE_DONE = 0
  !> Solved, but the residual is above the tolerance.
  integer, parameter, public :: FUGE_WARN_RESIDUAL = 1
  !> Solved, but the solution is one of many: the message says which part is not unique.
  integer, parameter, public :: FUGE_WARN_NOT_UNIQUE = 2
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
  !> Magnitudes exceed the range of double precision.
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

  !> The range of the codes.
  integer, parameter, public :: LOWEST_STATUS = FUGE_ERR_DOF
  integer, parameter, public :: HIGHEST_STATUS = FUGE_WARN_NOT_UNIQUE

  !> The text of each code, lowest first.
  character(len=64), parameter, public :: STATUS_MEANINGS(LOWEST_STATUS:HIGHEST_STATUS) = [character(len=64) :: &
    'a degree of freedom is out of range or named twice', &
    'rigid modes depend on each other, or one moves no point', &
    'an upper stop lies below the lower one', &
    'a file cannot be read or written', &
    'the progress monitor cancelled the solve', &
    'a callback failed or returned NaN or infinity', &
    'magnitudes exceed the range of double precision', &
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
    'done, but the solution is not unique']

  character(len=*), parameter :: UNKNOWN_STATUS = 'unknown status'

  !> Length of a message; longer ones are cut.
  integer, parameter, public :: FUGE_MESSAGE_LENGTH = 256

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
  contains
    procedure :: failed
  end type fuge_info

contains

  !> Is it an error? Outputs were then left untouched.
  pure function failed(self)
    class(fuge_info), intent(in) :: self
    logical :: failed

    failed = self%status < 0
  end function failed

  !> Set status and message, and nothing else.
  pure subroutine report(info, status, message)
    type(fuge_info), intent(inout) :: info
    integer, intent(in) :: status
    character(len=*), intent(in) :: message

    info%status = status
    info%message = message
  end subroutine report

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
