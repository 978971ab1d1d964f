!> Stretches of consecutive points in contact, and sums over them. Loops over stretches
!> touch no open point and have no branch inside.
module fuge_contact_segments
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info, report, FUGE_ERR_MEMORY
  implicit none
  private

  public :: total, inner, largest

  !> Partial sums kept at once: faster, and more exact, than one.
  integer, parameter :: LANES = 8

  type, public :: stretches
    !> First and last point of each, ascending.
    integer, allocatable :: first(:), last(:)
    !> Points in all of them.
    integer :: points = 0
  contains
    procedure :: find
  end type stretches

contains

  !> The stretches of a contact set. Error: FUGE_ERR_MEMORY.
  pure subroutine find(self, contact, info)
    class(stretches), intent(inout) :: self
    logical, intent(in) :: contact(:)
    type(fuge_info), intent(inout) :: info
    integer :: k, n, number, stat
    logical :: inside

    n = size(contact)
    number = count(contact(2:n) .and. .not. contact(1:n - 1))
    if (contact(1)) number = number + 1
    if (allocated(self%first)) deallocate (self%first, self%last)
    allocate (self%first(number), self%last(number), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the stretches of the contact set')
      return
    end if
    number = 0
    inside = .false.
    do k = 1, n
      if (contact(k) .and. .not. inside) then
        number = number + 1
        self%first(number) = k
      else if (inside .and. .not. contact(k)) then
        self%last(number) = k - 1
      end if
      inside = contact(k)
    end do
    if (inside) self%last(number) = n
    self%points = sum(self%last - self%first + 1)
  end subroutine find

  !> Sum of `x` over the stretches.
  pure function total(over, x) result(sum_of_x)
    type(stretches), intent(in) :: over
    real(dp), intent(in), contiguous :: x(:)
    real(dp) :: sum_of_x
    real(dp) :: part(LANES)
    integer :: i, k

    sum_of_x = 0.0_dp
    part = 0.0_dp
    do i = 1, size(over%first)
      do k = over%first(i), over%last(i) - LANES + 1, LANES
        part = part + x(k:k + LANES - 1)
      end do
      do k = over%last(i) - modulo(over%last(i) - over%first(i) + 1, LANES) + 1, over%last(i)
        sum_of_x = sum_of_x + x(k)
      end do
    end do
    sum_of_x = sum_of_x + sum(part)
  end function total

  !> Sum of x*y over the stretches.
  pure function inner(over, x, y) result(sum_of_products)
    type(stretches), intent(in) :: over
    real(dp), intent(in), contiguous :: x(:), y(:)
    real(dp) :: sum_of_products
    real(dp) :: part(LANES)
    integer :: i, k

    sum_of_products = 0.0_dp
    part = 0.0_dp
    do i = 1, size(over%first)
      do k = over%first(i), over%last(i) - LANES + 1, LANES
        part = part + x(k:k + LANES - 1)*y(k:k + LANES - 1)
      end do
      do k = over%last(i) - modulo(over%last(i) - over%first(i) + 1, LANES) + 1, over%last(i)
        sum_of_products = sum_of_products + x(k)*y(k)
      end do
    end do
    sum_of_products = sum_of_products + sum(part)
  end function inner

  !> Largest |x| over the stretches.
  pure function largest(over, x) result(magnitude)
    type(stretches), intent(in) :: over
    real(dp), intent(in), contiguous :: x(:)
    real(dp) :: magnitude
    integer :: i, k

    magnitude = 0.0_dp
    do i = 1, size(over%first)
      do k = over%first(i), over%last(i)
        magnitude = max(magnitude, abs(x(k)))
      end do
    end do
  end function largest

end module fuge_contact_segments
