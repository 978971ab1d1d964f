!> The products of fuge_slab_convolution in single precision: half the bytes, those of messages too, with errors of
!> about 1e-7 of the largest result.
module fuge_single_slab_convolution
  use, intrinsic :: iso_c_binding, only: c_loc
  use fuge_kinds, only: dp, wp => sp
  use fuge_single_grid_convolution, only: add_untwisted, convolve_line, opposite, twist_line, LARGEST_EXPONENT
  use fuge_single_grid_plan, only: stored_waves
  use fuge_single_slab_exchange, only: slab_exchange
  use fuge_single_slab_plan, only: slab_plan, COLUMNS, NUMBERS
  use fuge_slab_convolution, only: double_kernel => slab_kernel
  implicit none
  private

  public :: round_kernel

  include 'fuge_slab_convolution.inc'

  !> The kernel `double`, which is set, rounded, for the same ranks. All of them call it. `status`, the same on all, is
  !> not 0 where memory is short, or where the numbers are out of the range of single precision.
  subroutine round_kernel(double, plan, single, status)
    type(double_kernel), intent(in) :: double
    type(slab_plan), intent(in) :: plan
    type(slab_kernel), intent(inout) :: single
    integer, intent(out) :: status
    real(dp) :: factor, failed(1), largest(1)
    integer :: k

    largest = 0.0_dp
    if (size(double%spectrum) > 0) largest = maxval(abs(double%spectrum))
    call plan%group%raise(largest)
    status = merge(0, 1, abs(exponent(largest(1))) < LARGEST_EXPONENT .and. largest(1) > 0.0_dp)
    if (status /= 0) return
    call single%locate(plan, double%padded)
    single%unit = real(scale(1.0_dp, exponent(largest(1))), wp)
    factor = scale(1.0_dp, -exponent(largest(1)))
    if (allocated(single%spectrum)) deallocate (single%spectrum)
    allocate (single%spectrum(lbound(double%spectrum, 1):ubound(double%spectrum, 1), &
                              lbound(double%spectrum, 2):ubound(double%spectrum, 2)), stat=status)
    if (status == 0) call single%exchange%set(status)
    failed = merge(0.0_dp, 1.0_dp, status == 0)
    call plan%group%raise(failed)
    if (failed(1) > 0.0_dp) status = 1
    if (status /= 0) return
    do k = lbound(double%spectrum, 2), ubound(double%spectrum, 2)
      single%spectrum(:, k) = real(factor*double%spectrum(:, k), wp)
    end do
  end subroutine round_kernel

end module fuge_single_slab_convolution
