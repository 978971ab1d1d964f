!> What tests expect of a stiffness matrix, whatever its storage; as in `expectations`, '' tells that it is so.
module stiffness_expectations
  use expectations, only: add_difference, add_words, REPORT_LENGTH, unexpected
  use fuge_body_type, only: fuge_body
  use fuge_condensation, only: fuge_condense, fuge_condensed
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, FUGE_DONE, FUGE_ERR_DOF, FUGE_ERR_NOT_FINITE, FUGE_ERR_NOT_SYMMETRIC, &
    FUGE_ERR_OVERFLOW, FUGE_ERR_SIZE
  use fuge_stiffness_type, only: fuge_stiffness
  use special_numbers, only: infinity
  use small_bodies, only: to_columns
  implicit none
  private

  public :: break_columns, unexpected_copy, unexpected_stiffness

contains

  !> The products of `stiffness` with a vector, up to rounding, and its diagonal up to `tolerance`.
  function unexpected_stiffness(k, stiffness, tolerance) result(report)
    class(fuge_stiffness), intent(in) :: k
    real(dp), intent(in) :: stiffness(:, :), tolerance
    character(len=REPORT_LENGTH) :: report
    real(dp), dimension(size(stiffness, 1)) :: u, product, magnitude, terms
    integer :: i, n

    report = ''
    n = size(stiffness, 1)
    if (k%degrees() /= n) then
      call add_words(text(k%degrees())//' instead of '//text(n)//' degrees of freedom', report)
      return
    end if
    u = [(real(modulo(5*i, 7) - 3, dp), i=1, n)]
    call k%multiply(u, product, magnitude)
    call add_difference('product', product, matmul(stiffness, u), 1.0e-14_dp, report)
    call add_difference('magnitude', magnitude, matmul(abs(stiffness), abs(u)), 1.0e-14_dp, report)
    call k%diagonal(terms)
    call add_difference('diagonal', terms, [(stiffness(i, i), i=1, n)], tolerance, report)
  end function unexpected_stiffness

  !> Replace the `matrix` to which `k` refers, that of a block of 3 by 2 elements, by a copy from columns: `stiffness`
  !> as before, and the same condensation of four degrees of freedom. `matrix` is set to zero.
  function unexpected_copy(k, stiffness, matrix) result(report)
    class(fuge_stiffness), intent(inout) :: k
    real(dp), intent(in) :: stiffness(:, :)
    real(dp), intent(inout), target :: matrix(:, :)
    character(len=REPORT_LENGTH) :: report
    type(fuge_body) :: body
    type(fuge_condensed) :: before, after
    type(fuge_info) :: info
    integer, allocatable :: column(:), row(:)
    real(dp), allocatable :: value(:)
    integer :: i

    body%dof = reshape([(i, i=2, 8, 2)], [1, 4])
    body%normal = reshape([(1.0_dp, i=1, 4)], [1, 4])
    body%fixed = [20, 24]
    body%floats = .true.
    call fuge_condense(k, body, before, info)
    report = unexpected(info, FUGE_DONE)
    if (report /= '') return
    call to_columns(stiffness, 'L', column, row, value)
    call k%set_columns(column, row, value, info)
    report = unexpected(info, FUGE_DONE)
    if (report /= '') return
    ! Nothing refers to these arrays any more.
    matrix = 0.0_dp
    value = 0.0_dp
    report = unexpected_stiffness(k, stiffness, 1.0e-15_dp)
    call fuge_condense(k, body, after, info)
    if (report == '') report = unexpected(info, FUGE_DONE)
    if (report /= '') return
    call add_difference('alpha', reshape(after%alpha, [size(after%alpha)]), &
                        reshape(before%alpha, [size(before%alpha)]), 1.0e-11_dp, report)
    if (size(after%resultant) /= size(before%resultant)) call add_words('another number of resultants', report)
  end function unexpected_copy

  !> Break the columns of a chain of four masses, rows and halves of entries as from `to_columns`, in one of seven ways:
  !> the status of the refusal, and words of its message.
  subroutine break_columns(kind, column, row, value, status, words)
    integer, intent(in) :: kind
    integer, intent(inout) :: column(:), row(:)
    real(dp), intent(inout) :: value(:)
    integer, intent(out) :: status
    character(len=:), allocatable, intent(out) :: words

    select case (kind)
    case (1)
      row(3) = 5
      status = FUGE_ERR_DOF
      words = 'row(3) = 5 in column 1'
    case (2)
      value(7) = infinity()
      status = FUGE_ERR_NOT_FINITE
      words = 'stiffness('//text(row(7))//',2)'
    case (3)
      value(1:2) = 1.01_dp*value(1:2)
      status = FUGE_ERR_NOT_SYMMETRIC
      words = 'stiffness(1,2)'
    case (4)
      column(2) = column(3) + 1
      status = FUGE_ERR_SIZE
      words = 'column(3)'
    case (5)
      column(5) = column(5) + 1
      status = FUGE_ERR_SIZE
      words = 'needs 21 of each'
    case (6)
      value(7) = 0.9_dp*huge(1.0_dp)
      status = FUGE_ERR_OVERFLOW
      words = 'stiffness('//text(row(7))//',2)'
    case default
      column = column - 1
      status = FUGE_ERR_SIZE
      words = 'column(1) = 0: the first column starts at 1'
    end select
  end subroutine break_columns

end module stiffness_expectations
