!> A library without FFTW: what needs transforms refuses and says why, from Fortran and FORTRAN 77.
program refused
  use fuge_cell_elements, only: FUGE_MEAN, FUGE_FREE
  use fuge_halfplane_depths, only: fuge_halfplane_stress_grid
  use fuge_halfplane_fft, only: fuge_halfplane_operator
  use fuge_halfspace_fft, only: fuge_halfspace_operator
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info, FUGE_ERR_UNSUPPORTED
  implicit none

  interface
    subroutine fugefx(n, h, estar, nelem, nbound, nthr, gap, nheld, f0, v0, tol, maxit, f, c, ncon, niter, resid, msg, &
                      info)
      import :: dp
      integer, intent(in) :: n, nelem, nbound, nthr, nheld, maxit
      real(dp), intent(in) :: h, estar, gap(n), tol
      real(dp), intent(inout) :: f0, v0, f(n), c(n), resid
      integer, intent(inout) :: ncon, niter
      character(len=*), intent(inout) :: msg
      integer, intent(out) :: info
    end subroutine fugefx
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
    real(dp) :: force(4), gap(4), load, approach, residual
    integer :: contacts, iterations
    type(fuge_info) :: info

    force = 7.0_dp
    gap = 7.0_dp
    load = 1.0_dp
    approach = 7.0_dp
    residual = 7.0_dp
    contacts = 7
    iterations = 7
    call fugefx(4, 1.0_dp, 1.0_dp, FUGE_MEAN, FUGE_FREE, 1, [0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp], 0, load, approach, &
                0.0_dp, 0, force, gap, contacts, iterations, residual, info%message, info%status)
    call expect_reason(info)
    if (any(abs([force, gap, approach, residual] - 7.0_dp) > 0.0_dp)) error stop 'FUGEFX has changed its output'
    if (contacts /= 7 .or. iterations /= 7) error stop 'FUGEFX has changed its counts'
  end subroutine check_legacy

  subroutine expect_reason(info)
    type(fuge_info), intent(in) :: info

    if (info%status /= FUGE_ERR_UNSUPPORTED) error stop 'another status'
    if (index(info%message, 'this library was built without FFTW (FUGE_WITH_FFTW=OFF)') == 0) error stop 'no reason'
    if (index(info%message, 'build it with FFTW, or use a matrix') == 0) error stop 'no remedy'
  end subroutine expect_reason

end program refused
