!> Plans for the lines of two-dimensional grids, on circles that may be twice as long.
!>
!> A circle of 2N cells, of which at most N hold values and N results are wanted, is split in two of N: waves of even
!> number, and waves of odd number, for which the values are multiplied by exp(-i pi j/N) before the transform and after
!> it by the conjugate. So one plan of N serves both.
module fuge_grid_plan
  use, intrinsic :: iso_c_binding, only: c_loc, c_ptr
  use fuge_constants, only: PI
  use fuge_fft, only: allocate_values, fft_plan, release_buffer
  use fuge_kept_rows, only: free_rows, kept_rows, return_rows, take_rows, taken_rows
  use fuge_kinds, only: dp, sp, wp => dp
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_MEMORY, FUGE_ERR_SIZE
  implicit none
  private

  include 'fuge_grid_plan.inc'

end module fuge_grid_plan
