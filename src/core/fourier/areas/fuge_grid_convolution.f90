!> Products with convolution matrices of two-dimensional grids, by Fourier transforms of their lines.
!>
!> The kernel is even in both directions, so that its spectrum is real and a quarter of it holds the rest. Value
!> (i, j) of a grid of nx x ny has the number i + nx*(j - 1). A row and the next one are transformed together, as
!> the real and imaginary parts of complex numbers z; if z' is the number that belongs to the opposite wave, the
!> transforms of the two rows are (z + conj z')/2 and (z - conj z')/2i.
!>
!> In a direction that is not periodic ("padded") the circle has 2N >= 2n cells, of which only n hold values and
!> only n results are wanted. It is split in two circles of N (fuge_grid_plan), so that neither zeros nor unwanted
!> results are ever transformed. Rows of zeros are skipped.
!>
!> Columns are copied to a buffer a few at a time, so that each is transformed, multiplied and transformed back in
!> cache. Threads share rows, then columns, then rows; each line is computed as by one thread, so that the result is the
!> same to the last bit.
module fuge_grid_convolution
  use, intrinsic :: iso_c_binding, only: c_f_pointer, c_int, c_loc, c_ptr
  use fuge_fft, only: allocate_values, fft_plan, release_buffer
  use fuge_grid_plan, only: grid_plan, return_rows, stored_waves, take_rows, taken_rows
  use fuge_kinds, only: wp => dp
  use fuge_spectrum_bounds, only: spectrum_bounds
  use fuge_status, only: FUGE_DONE, FUGE_ERR_CALL_ORDER, FUGE_ERR_MEMORY, FUGE_ERR_SIZE
  use fuge_threads, only: run_in_threads, share, threads_here
  implicit none
  private

  public :: find_bounds

  include 'fuge_grid_convolution.inc'

  !> Bounds of the spectrum of a kernel that is set, on the circles of `plan`.
  pure subroutine find_bounds(kernel, plan, bounds)
    type(grid_kernel), intent(in) :: kernel
    type(grid_plan), intent(in) :: plan
    type(spectrum_bounds), intent(out) :: bounds
    integer :: first, k

    first = lbound(kernel%spectrum, 1)
    do k = lbound(kernel%spectrum, 2), ubound(kernel%spectrum, 2)
      if (k == lbound(kernel%spectrum, 2)) then
        call bounds%add_waves(kernel%spectrum(first + 1:, k), 4)
      else
        call bounds%add_waves(kernel%spectrum(:, k), 4)
      end if
    end do
    bounds%constant = kernel%spectrum(first, lbound(kernel%spectrum, 2))
    bounds%together = hypot(bounds%together, bounds%constant)
    call bounds%scale_by(kernel%unit*circle_factor(plan, kernel%padded))
  end subroutine find_bounds

end module fuge_grid_convolution
