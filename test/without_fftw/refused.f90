!> A library without FFTW: what needs transforms refuses and says why, from Fortran and FORTRAN 77.
program refused
  use fuge, only: dp => fuge_dp, fuge_halfplane_operator, fuge_halfplane_stress_grid, fuge_halfspace_operator, &
    fuge_info, FUGE_ERR_UNSUPPORTED, FUGE_FREE, FUGE_MEAN
  implicit none

  interface
    subroutine fugeft(n, h, estar, nelem, nbound, nthr, gap, f0, f, c, v0, info)
      import :: dp
      integer, intent(in) :: n, nelem, nbound, nthr
      real(dp), intent(in) :: h, estar, gap(n), f0
      real(dp), intent(inout) :: f(n), c(n), v0
      integer, intent(out) :: info
    end subroutine fugeft
  end interface

  call check_operators()
  call check_stress_grid()
  call check_legacy()
  print '(a)', 'refused with the reason'

contains

  subroutine check_operators()
    type(fuge_halfplane_operator) :: line, copy
    type(fuge_halfspace_operator) :: area
    type(fuge_info) :: info
    real(dp) :: product(4)
    integer :: status

    call line%set(4, 1.0_dp, 1.0_dp, info)
    call expect_reason(info)
    print '(a)', trim(info%message)
    call area%set(4, 4, 1.0_dp, 1.0_dp, 1.0_dp, info)
    call expect_reason(info)
    ! As any operator that has not been set.
    copy = line
    call copy%apply([1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp], product, status)
    if (status >= 0) error stop 'an operator that has not been set was applied'
  end subroutine check_operators

  subroutine check_stress_grid()
    type(fuge_info) :: info
    real(dp) :: stress(3, 4, 1)

    stress = 7.0_dp
    call fuge_halfplane_stress_grid(1.0_dp, [1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp], FUGE_MEAN, FUGE_FREE, [0.5_dp], stress, &
                                    info)
    call expect_reason(info)
    if (any(abs(stress - 7.0_dp) > 0.0_dp)) error stop 'a refusing call has changed its output'
  end subroutine check_stress_grid

  subroutine check_legacy()
    real(dp) :: force(4), gap(4), approach
    integer :: status

    force = 7.0_dp
    gap = 7.0_dp
    approach = 7.0_dp
    call fugeft(4, 1.0_dp, 1.0_dp, FUGE_MEAN, FUGE_FREE, 1, [0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp], 1.0_dp, force, gap, &
                approach, status)
    if (status /= FUGE_ERR_UNSUPPORTED) error stop 'FUGEFT has another status'
    if (any(abs([force, gap, approach] - 7.0_dp) > 0.0_dp)) error stop 'FUGEFT has changed its output'
  end subroutine check_legacy

  subroutine expect_reason(info)
    type(fuge_info), intent(in) :: info

    if (info%status /= FUGE_ERR_UNSUPPORTED) error stop 'another status'
    if (index(info%message, 'this library was built without FFTW (FUGE_WITH_FFTW=OFF)') == 0) error stop 'no reason'
    if (index(info%message, 'build it with FFTW, or use a matrix') == 0) error stop 'no remedy'
  end subroutine expect_reason

end program refused
