!> The plans of fuge_grid_plan in single precision.
module fuge_single_grid_plan
  use, intrinsic :: iso_c_binding, only: c_loc, c_ptr
  use fuge_constants, only: PI
  use fuge_fft, only: allocate_values, fft_plan, release_buffer
  use fuge_kept_rows, only: free_rows, kept_rows, return_rows, take_rows, taken_rows
  use fuge_kinds, only: dp, sp, wp => sp
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_MEMORY, FUGE_ERR_SIZE
  implicit none
  private

  include 'fuge_grid_plan.inc'

end module fuge_single_grid_plan
