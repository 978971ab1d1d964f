!> Messages about the stiffness of all bodies, in the numbers of the body that is meant.
module fuge_joined_names
  use fuge_number_text, only: index_text, INDEX_MARK
  use fuge_status, only: composed_message, fuge_info, report
  implicit none
  private

  public :: name_bodies

  !> Stands before the index of a degree of freedom.
  character(len=*), parameter :: DEGREE = 'degree of freedom '//INDEX_MARK

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
