!> Products with an operator and with its preconditioner, counted and checked. The iterative
!> engine and the certificate form theirs here, so that a failure has one message everywhere.
module fuge_operator_products
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp, sp
  use fuge_number_text, only: text
  use fuge_operator_type, only: fuge_operator
  use fuge_point_chunks, only: is_finite_in_chunks
  use fuge_point_space, only: point_space
  use fuge_status, only: composed_message, fuge_info, fuge_status_text, report, FUGE_DONE, FUGE_ERR_CALLBACK, &
    FUGE_ERR_OVERFLOW, LOWEST_STATUS
  implicit none
  private

  public :: multiply, multiply_single, multiply_with_magnitude, precondition, precondition_single

contains

  !> u = (A - datum) f; adds 1 to info%products.
  !>
  !> `force` (n), force; `displacement` (n), length. The message has the number of the product.
  !> Errors: FUGE_ERR_CALLBACK if the operator fails or returns NaN or infinity;
  !> FUGE_ERR_OVERFLOW if `force` itself is not finite; the status that the operator returned
  !> if that is an error of `fuge_status`.
  subroutine multiply(operator, force, displacement, info)
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: force(:)
    real(dp), intent(out), contiguous :: displacement(:)
    type(fuge_info), intent(inout) :: info
    type(point_space) :: space
    integer :: status

    call operator%apply(force, displacement, status)
    call judge_product(force, displacement, status, info)
    space = operator%ranks()
    call space%agree(info)
  end subroutine multiply

  !> As `multiply`, in single precision, but a result that is not finite is the caller's to find.
  subroutine multiply_single(operator, force, displacement, info)
    class(fuge_operator), intent(in) :: operator
    real(sp), intent(in) :: force(:)
    real(sp), intent(out), contiguous :: displacement(:)
    type(fuge_info), intent(inout) :: info
    type(point_space) :: space
    integer :: status

    call operator%apply_single(force, displacement, status)
    info%products = info%products + 1
    if (status /= FUGE_DONE) call report_status(status, 'product', info%products, info)
    space = operator%ranks()
    call space%agree(info)
  end subroutine multiply_single

  !> As `multiply`, with the size of the terms of each displacement, `magnitude` (n), length.
  subroutine multiply_with_magnitude(operator, force, displacement, magnitude, info)
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: force(:)
    real(dp), intent(out), contiguous :: displacement(:), magnitude(:)
    type(fuge_info), intent(inout) :: info
    type(point_space) :: space
    integer :: status

    call operator%apply_with_magnitude(force, displacement, magnitude, status)
    call judge_product(force, displacement, status, info)
    space = operator%ranks()
    call space%agree(info)
  end subroutine multiply_with_magnitude

  !> Count a product and report what is wrong with it.
  subroutine judge_product(force, displacement, status, info)
    real(dp), intent(in) :: force(:)
    real(dp), intent(in), contiguous :: displacement(:)
    integer, intent(in) :: status
    type(fuge_info), intent(inout) :: info

    info%products = info%products + 1
    if (status /= FUGE_DONE) then
      call report_status(status, 'product', info%products, info)
    else if (.not. is_finite_in_chunks(displacement)) then
      call report_not_finite(force, 'force', displacement, 'displacement', 'product', info%products, info)
    end if
  end subroutine judge_product

  !> f = M u by the preconditioner of the operator, which must have one; adds 1 to
  !> info%preconditionings.
  !>
  !> `displacement` (n), length; `force` (n), force. Errors as for `multiply`.
  subroutine precondition(operator, displacement, force, info)
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: displacement(:)
    real(dp), intent(out), contiguous :: force(:)
    type(fuge_info), intent(inout) :: info
    type(point_space) :: space
    integer :: status

    call operator%precondition(displacement, force, status)
    info%preconditionings = info%preconditionings + 1
    if (status /= FUGE_DONE) then
      call report_status(status, 'preconditioner', info%preconditionings, info)
    else if (.not. is_finite_in_chunks(force)) then
      call report_not_finite(displacement, 'displacement', force, 'force', 'preconditioner', info%preconditionings, &
                             info)
    end if
    space = operator%ranks()
    call space%agree(info)
  end subroutine precondition

  !> As `precondition`, in single precision, but a result that is not finite is the caller's to find.
  subroutine precondition_single(operator, displacement, force, info)
    class(fuge_operator), intent(in) :: operator
    real(sp), intent(in) :: displacement(:)
    real(sp), intent(out), contiguous :: force(:)
    type(fuge_info), intent(inout) :: info
    type(point_space) :: space
    integer :: status

    call operator%precondition_single(displacement, force, status)
    info%preconditionings = info%preconditionings + 1
    if (status /= FUGE_DONE) call report_status(status, 'preconditioner', info%preconditionings, info)
    space = operator%ranks()
    call space%agree(info)
  end subroutine precondition_single

  !> An error of the library keeps its meaning; any other status is the operator's own.
  pure subroutine report_status(status, what, number, info)
    integer, intent(in) :: status, number
    character(len=*), intent(in) :: what
    type(fuge_info), intent(inout) :: info

    if (status == FUGE_ERR_OVERFLOW) then
      call report(info, status, what//' '//text(number)//': the displacements are too large: choose units in which ' &
                  //'forces and lengths are nearer to 1')
    else if (status < 0 .and. status >= LOWEST_STATUS) then
      call report(info, status, what//' '//text(number)//': '//fuge_status_text(status))
    else
      call report(info, FUGE_ERR_CALLBACK, what//' '//text(number)//': the operator returned status '//text(status))
    end if
  end subroutine report_status

  !> Name the first value that is not finite; the operator is to blame only if its input is finite.
  pure subroutine report_not_finite(input, input_name, result, result_name, what, number, info)
    real(dp), intent(in) :: input(:), result(:)
    character(len=*), intent(in) :: input_name, result_name, what
    integer, intent(in) :: number
    type(fuge_info), intent(inout) :: info
    type(fuge_info) :: check

    call check_finite(input, input_name, check)
    if (check%failed()) then
      call report(info, FUGE_ERR_OVERFLOW, 'before '//what//' '//text(number)//', '//composed_message(check) &
                  //': choose units in which forces and lengths are nearer to 1')
    else
      call check_finite(result, result_name, check)
      call report(info, FUGE_ERR_CALLBACK, what//' '//text(number)//': '//composed_message(check) &
                  //': mend the operator''s callback')
    end if
  end subroutine report_not_finite

end module fuge_operator_products
