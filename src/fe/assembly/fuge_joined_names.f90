!> Messages about all bodies together, in the numbers of the body that is meant.
module fuge_joined_names
  use fuge_number_text, only: index_text, INDEX_MARK
  use fuge_status, only: composed_message, fuge_info, report, FUGE_ERR_NO_EQUILIBRIUM
  implicit none
  private

  public :: name_bodies, name_motions, names_motion

  !> Stands before the index of a degree of freedom.
  character(len=*), parameter :: DEGREE = 'degree of freedom '//INDEX_MARK
  !> The same for a rigid motion.
  character(len=*), parameter :: MOTION = 'motion '//INDEX_MARK

contains

  !> Replace degrees of freedom of all bodies by those of a body: "degree of freedom 812" becomes "degree of freedom 12
  !> of body 2". `first` (bodies + 1): degrees of freedom before those of each body.
  pure subroutine name_bodies(first, info)
    integer, intent(in) :: first(:)
    type(fuge_info), intent(inout) :: info
    integer :: begin, body, next, number
    character(len=:), allocatable :: message, rest

    rest = composed_message(info)
    message = ''
    do
      begin = index(rest, DEGREE)
      if (begin == 0) exit
      begin = begin + len(DEGREE)
      next = begin - 1 + verify(rest(begin:)//' ', '0123456789')
      number = value_of(rest(begin:next - 1))
      body = count(first < number)
      message = message//rest(:begin - 2)//index_text(number - first(max(body, 1)))//' of body '//index_text(body)
      rest = rest(next:)
    end do
    call report(info, info%status, message//rest)
  end subroutine name_bodies

  !> Does a message name a rigid motion?
  pure function names_motion(info) result(named)
    type(fuge_info), intent(in) :: info
    logical :: named

    named = index(composed_message(info), MOTION) > 0
  end function names_motion

  !> Say of which body the rigid motion in a message is, and how to mend it. `owner`: the body of each motion.
  pure subroutine name_motions(owner, info)
    integer, intent(in) :: owner(:)
    type(fuge_info), intent(inout) :: info
    integer :: begin, next, number
    character(len=:), allocatable :: message

    message = composed_message(info)
    begin = index(message, MOTION) + len(MOTION)
    if (begin == len(MOTION)) return
    next = begin - 1 + verify(message(begin:)//' ', '0123456789')
    number = value_of(message(begin:next - 1))
    if (number < 1 .or. number > size(owner)) return
    message = message(:next - 1)//' (body '//index_text(owner(number))//')'//message(next:)
    if (info%status == FUGE_ERR_NO_EQUILIBRIUM) message = message//'; hold the body, or balance its load'
    call report(info, info%status, message)
  end subroutine name_motions

  !> The number that digits make. Not by an internal read, which would take a lock of the run-time library.
  pure function value_of(digits) result(number)
    character(len=*), intent(in) :: digits
    integer :: number
    integer :: k

    number = 0
    do k = 1, len(digits)
      number = 10*number + iachar(digits(k:k)) - iachar('0')
    end do
  end function value_of

end module fuge_joined_names
