!> Checks of the entries of a stiffness matrix, the same for each kind of storage.
module fuge_stiffness_check
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_constants, only: LARGEST_EXPONENT
  use fuge_input_checks, only: is_finite_everywhere
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_status, only: fuge_info, report, FUGE_ERR_NOT_FINITE, FUGE_ERR_NOT_SYMMETRIC, FUGE_ERR_OVERFLOW
  implicit none
  private

  public :: check_entries, check_entry, check_pair

  !> Largest asymmetry that counts as rounding, relative to the square roots of the two diagonal
  !> terms.
  real(dp), parameter, public :: SYMMETRY_TOLERANCE = 1.0e-10_dp

contains

  pure function entry_name_length(i, j) result(length)
    integer, intent(in) :: i, j
    integer :: length

    length = len('stiffness(,)') + len(index_text(i)) + len(index_text(j))
  end function entry_name_length

  !> Entry (i, j) as messages name it.
  pure function entry_name(i, j) result(name)
    integer, intent(in) :: i, j
    character(len=entry_name_length(i, j)) :: name

    name = 'stiffness('//index_text(i)//','//index_text(j)//')'
  end function entry_name

  !> Refuse NaN and infinity (FUGE_ERR_NOT_FINITE) and numbers near overflow
  !> (FUGE_ERR_OVERFLOW) in `entries`, the rows of column j from `first` on.
  pure subroutine check_entries(entries, first, j, info)
    real(dp), intent(in), contiguous :: entries(:)
    integer, intent(in) :: first, j
    type(fuge_info), intent(inout) :: info
    integer :: k

    if (size(entries) < 1) return
    if (is_finite_everywhere(entries)) then
      if (exponent(maxval(abs(entries))) <= LARGEST_EXPONENT) return
    end if
    do k = 1, size(entries)
      call check_entry(entries(k), first + k - 1, j, info)
      if (info%failed()) return
    end do
  end subroutine check_entries

  !> Refuse entry (i, j) if it is NaN or infinity (FUGE_ERR_NOT_FINITE) or near overflow
  !> (FUGE_ERR_OVERFLOW).
  pure subroutine check_entry(entry, i, j, info)
    real(dp), intent(in) :: entry
    integer, intent(in) :: i, j
    type(fuge_info), intent(inout) :: info

    if (.not. ieee_is_finite(entry)) then
      call report(info, FUGE_ERR_NOT_FINITE, entry_name(i, j)//' = '//text(entry)//' is not a finite number')
    else if (exponent(entry) > LARGEST_EXPONENT) then
      call report(info, FUGE_ERR_OVERFLOW, entry_name(i, j)//' = '//text(entry) &
                  //' is near overflow: choose units in which it is smaller')
    end if
  end subroutine check_entry

  !> Refuse entries (i, j), `above`, and (j, i), `below`, that differ by more than rounding,
  !> relative to the diagonal terms of i and j (FUGE_ERR_NOT_SYMMETRIC).
  pure subroutine check_pair(i, j, above, below, diagonal_i, diagonal_j, info)
    integer, intent(in) :: i, j
    real(dp), intent(in) :: above, below, diagonal_i, diagonal_j
    type(fuge_info), intent(inout) :: info

    if (.not. abs(above - below) > 0.0_dp) return
    if (abs(above - below) <= SYMMETRY_TOLERANCE*sqrt(abs(diagonal_i))*sqrt(abs(diagonal_j))) return
    call report(info, FUGE_ERR_NOT_SYMMETRIC, entry_name(i, j)//' = '//text(above)//' and '//entry_name(j, i) &
                //' differ by '//text(abs(above - below))//': a stiffness matrix is symmetric; if that is rounding, ' &
                //'pass (K + K^T)/2')
  end subroutine check_pair

end module fuge_stiffness_check
