!> The accuracy of an answer without a grid, and its warnings: for punches on a half-plane and round ones alike.
module fuge_smooth_accuracy
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_options_type, only: fuge_options
  use fuge_status, only: fuge_info, report, FUGE_WARN_RESIDUAL
  implicit none
  private

  public :: report_accuracy

  type(fuge_options), parameter :: DEFAULTS = fuge_options()
  !> An error of up to ROUNDINGS times the rounding of the ends may come from it.
  real(dp), parameter :: ROUNDINGS = 64.0_dp

contains

  !> Complete info%residual, on entry the certificate's, and warn if it or `error` is above the default tolerance.
  !>
  !> `error` the largest estimated error of the answer, `wrong_sign` the largest tension or penetration that the bounds
  !> of the series found, `undecided` the penetration that they cannot exclude, `rounding` that of the ends; all
  !> relative, the last one to half the width of the contact.
  pure subroutine report_accuracy(error, wrong_sign, undecided, rounding, info)
    real(dp), intent(in) :: error, wrong_sign, undecided, rounding
    type(fuge_info), intent(inout) :: info

    info%residual = max(info%residual, wrong_sign)
    if (max(info%residual, error) > DEFAULTS%tolerance .and. ROUNDINGS*rounding > max(info%residual, error)) then
      call report(info, FUGE_WARN_RESIDUAL, 'the estimated error is '//text(error) &
                  //': the contact is so narrow that the rounding of its positions matters; put x = 0 into the contact')
    else if (info%residual <= DEFAULTS%tolerance .and. undecided > DEFAULTS%tolerance) then
      info%residual = undecided
      call report(info, FUGE_WARN_RESIDUAL, 'penetration beside the contact is excluded down to ' &
                  //text(undecided)//' only: the profile is not smooth there')
    else if (info%residual > DEFAULTS%tolerance) then
      call report(info, FUGE_WARN_RESIDUAL, 'the residual is '//text(info%residual)//', the estimated error ' &
                  //text(error)//': the profile is not smooth in the contact, or its slope is not that of its gap')
    else if (error > DEFAULTS%tolerance) then
      call report(info, FUGE_WARN_RESIDUAL, 'the estimated error is '//text(error) &
                  //': the profile is not smooth in the contact')
    end if
  end subroutine report_accuracy

end module fuge_smooth_accuracy
