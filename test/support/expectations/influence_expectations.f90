!> What tests expect of a matrix of influence coefficients; as in `expectations`, '' tells that it is so.
module influence_expectations
  use fuge_kinds, only: dp
  use fuge_lapack, only: dpotrf
  use fuge_number_text, only: text
  use expectations, only: add_words, REPORT_LENGTH
  implicit none
  private

  public :: unlike_influence

contains

  !> Influence coefficients: symmetric to the last bit, positive, positive definite.
  function unlike_influence(alpha) result(report)
    real(dp), intent(in) :: alpha(:, :)
    character(len=REPORT_LENGTH) :: report
    real(dp) :: factor(size(alpha, 1), size(alpha, 2))
    integer :: status

    report = ''
    if (.not. all(alpha <= transpose(alpha))) call add_words('not symmetric', report)
    if (.not. minval(alpha) > 0.0_dp) call add_words('least coefficient '//text(minval(alpha)), report)
    factor = alpha
    call dpotrf('L', size(alpha, 1), factor, size(alpha, 1), status)
    if (status /= 0) call add_words('not positive definite at row '//text(status), report)
  end function unlike_influence

end module influence_expectations
