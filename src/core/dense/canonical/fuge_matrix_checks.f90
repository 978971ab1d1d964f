!> Checks of the coefficients of alpha that need no factorisation.
module fuge_matrix_checks
  use fuge_constants, only: LARGEST_EXPONENT
  use fuge_kinds, only: dp
  use fuge_matrix_survey, only: PAIR_TOLERANCE
  use fuge_number_text, only: index_text, text
  use fuge_status, only: fuge_info, report, FUGE_ERR_NOT_DEFINITE, FUGE_ERR_OVERFLOW
  implicit none
  private

  public :: check_largest, check_pairs

contains

  !> Refuse an alpha for which a pair of opposite forces gains energy (FUGE_ERR_NOT_DEFINITE): the cheap part of
  !> definiteness. Whether the block of a contact set is definite shows when it is factored.
  pure subroutine check_pairs(alpha, info)
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_info), intent(inout) :: info
    real(dp) :: own(size(alpha, 2)), energy
    integer :: i, j

    own = [(alpha(j, j), j=1, size(own))]
    do j = 1, size(own)
      do i = j + 1, size(own)
        energy = (own(i) - alpha(i, j)) + (own(j) - alpha(i, j))
        if (energy >= -PAIR_TOLERANCE*(abs(own(i)) + abs(own(j)))) cycle
        call report(info, FUGE_ERR_NOT_DEFINITE, 'alpha is not positive definite: opposite forces at points ' &
                    //index_text(j)//' and '//index_text(i)//' store the negative energy '//text(0.5_dp*energy) &
                    //' per force squared; look for a wrong sign')
        return
      end do
    end do
  end subroutine check_pairs

  !> Refuse an alpha whose products with the load leave the range of double precision, at either end
  !> (FUGE_ERR_OVERFLOW). `largest` is its largest coefficient in magnitude.
  pure subroutine check_largest(largest, load, info)
    real(dp), intent(in) :: largest, load
    type(fuge_info), intent(inout) :: info
    integer :: deflection

    deflection = exponent(largest) + exponent(load)
    if (max(abs(exponent(largest)), deflection) > LARGEST_EXPONENT) then
      call report(info, FUGE_ERR_OVERFLOW, 'alpha reaches '//text(largest)//' and alpha times load 2**' &
                  //text(deflection)//': choose units in which they are nearer to 1')
    else if (deflection < -LARGEST_EXPONENT) then
      call report(info, FUGE_ERR_OVERFLOW, 'the load '//text(load)//' displaces 2**'//text(deflection) &
                  //' at most (alpha reaches '//text(largest)//'), too small for double precision: choose a smaller ' &
                  //'unit of length')
    end if
  end subroutine check_largest

end module fuge_matrix_checks
