!> Products with an operator and with its preconditioner, counted and checked. All that need
!> nothing but products make them here, so that a failure always ends in the same words.
module fuge_operator_products
  use fuge_input_checks, only: check_finite, is_finite_everywhere
  use fuge_kinds, only: dp
  use fuge_operator_type, only: fuge_operator
  use fuge_status, only: fuge_info, fuge_status_text, report, FUGE_DONE, FUGE_ERR_CALLBACK, FUGE_ERR_OVERFLOW, &
    LOWEST_STATUS
  use fuge_number_text, only: text
  implicit none
  private

  public :: multiply, precondition

contains

  !> displacement = (A - datum) force, one more in info%products.
  !>
  !> `force` (n), force; `displacement` (n), length. Errors, with the number of the product:
  !> FUGE_ERR_CALLBACK where the operator fails or gives NaN or infinity, with the point;
  !> FUGE_ERR_OVERFLOW where `force` itself is not finite; what the operator returned,
  !> if it is an error of `fuge_status`.
  subroutine multiply(operator, force, displacement, info)
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: force(:)
    real(dp), intent(out), contiguous :: displacement(:)
    type(fuge_info), intent(inout) :: info
    integer :: status

    call operator%apply(force, displacement, status)
    info%products = info%products + 1
    if (status /= FUGE_DONE) then
      call report_status(status, 'product', info%products, info)
    else if (.not. is_finite_everywhere(displacement)) then
      call report_not_finite(force, 'force', displacement, 'displacement', 'product', info%products, info)
    end if
  end subroutine multiply

  !> force = M length by the preconditioner of the operator, which must have one; one more in
  !> info%preconditionings.
  !>
  !> `length` (n), length; `force` (n), force. Errors as for `multiply`.
  subroutine precondition(operator, length, force, info)
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: length(:)
    real(dp), intent(out), contiguous :: force(:)
    type(fuge_info), intent(inout) :: info
    integer :: status

    call operator%precondition(length, force, status)
    info%preconditionings = info%preconditionings + 1
    if (status /= FUGE_DONE) then
      call report_status(status, 'preconditioner', info%preconditionings, info)
    else if (.not. is_finite_everywhere(force)) then
      call report_not_finite(length, 'length', force, 'force', 'preconditioner', info%preconditionings, info)
    end if
  end subroutine precondition

  !> An error of the library keeps its meaning; anything else is the operator's own.
  pure subroutine report_status(status, what, number, info)
    integer, intent(in) :: status, number
    character(len=*), intent(in) :: what
    type(fuge_info), intent(inout) :: info

    if (status < 0 .and. status >= LOWEST_STATUS) then
      call report(info, status, what//' '//text(number)//': '//fuge_status_text(status))
    else
      call report(info, FUGE_ERR_CALLBACK, what//' '//text(number)//': the operator returned status '//text(status))
    end if
  end subroutine report_status

  !> The first value that is not finite, put down to what was given if that is not finite.
  pure subroutine report_not_finite(given, given_name, made, made_name, what, number, info)
    real(dp), intent(in) :: given(:), made(:)
    character(len=*), intent(in) :: given_name, made_name, what
    integer, intent(in) :: number
    type(fuge_info), intent(inout) :: info
    type(fuge_info) :: found

    call check_finite(given, given_name, found)
    if (found%failed()) then
      call report(info, FUGE_ERR_OVERFLOW, 'before '//what//' '//text(number)//' '//trim(found%message) &
                  //': choose units in which forces and lengths are nearer to 1')
    else
      call check_finite(made, made_name, found)
      call report(info, FUGE_ERR_CALLBACK, what//' '//text(number)//': '//trim(found%message) &
                  //': mend the operator''s callback')
    end if
  end subroutine report_not_finite

end module fuge_operator_products
