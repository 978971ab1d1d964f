!> The products of fuge_grid_convolution in single precision: half the bytes, with errors of about 1e-7 of the largest
!> result.
module fuge_single_grid_convolution
  use, intrinsic :: iso_c_binding, only: c_f_pointer, c_int, c_loc, c_ptr
  use fuge_fft, only: allocate_values, fft_plan, release_buffer
  use fuge_grid_convolution, only: double_kernel => grid_kernel
  use fuge_kinds, only: dp, wp => sp
  use fuge_single_grid_plan, only: grid_plan, return_rows, stored_waves, take_rows, taken_rows
  use fuge_status, only: FUGE_DONE, FUGE_ERR_CALL_ORDER, FUGE_ERR_MEMORY, FUGE_ERR_SIZE
  use fuge_threads, only: run_in_threads, share, threads_here
  implicit none
  private

  public :: round_kernel, LARGEST_EXPONENT

  !> The range of single precision has room for squares of numbers within 2 to this power.
  integer, parameter :: LARGEST_EXPONENT = 60

  include 'fuge_grid_convolution.inc'

  !> The kernel `double`, which is set, rounded. `status` is not 0 where memory is short, or where its numbers are out
  !> of the range of single precision.
  subroutine round_kernel(double, single, status)
    type(double_kernel), intent(in) :: double
    type(grid_kernel), intent(inout) :: single
    integer, intent(out) :: status
    real(dp) :: factor, largest
    integer :: k

    largest = maxval(abs(double%spectrum))
    status = merge(0, 1, abs(exponent(largest)) < LARGEST_EXPONENT .and. largest > 0.0_dp)
    if (status /= 0) return
    single%padded = double%padded
    single%unit = real(scale(1.0_dp, exponent(largest)), wp)
    factor = scale(1.0_dp, -exponent(largest))
    if (allocated(single%spectrum)) deallocate (single%spectrum)
    allocate (single%spectrum(lbound(double%spectrum, 1):ubound(double%spectrum, 1), &
                              lbound(double%spectrum, 2):ubound(double%spectrum, 2)), stat=status)
    if (status /= 0) return
    do k = lbound(double%spectrum, 2), ubound(double%spectrum, 2)
      single%spectrum(:, k) = real(factor*double%spectrum(:, k), wp)
    end do
  end subroutine round_kernel

end module fuge_single_grid_convolution
