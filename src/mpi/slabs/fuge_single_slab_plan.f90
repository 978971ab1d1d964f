!> The plans of fuge_slab_plan in single precision.
module fuge_single_slab_plan
  use, intrinsic :: iso_c_binding, only: c_associated, c_f_pointer, c_intptr_t, c_null_ptr, c_ptr
  use fuge_fft, only: allocate_values, release_buffer
  use fuge_single_grid_plan, only: grid_plan, stored_waves
  use fuge_kinds, only: wp => sp
  use fuge_number_text, only: text
  use fuge_rank_communicator, only: rank_communicator
  use fuge_single_slab_exchange, only: slab_exchange
  use fuge_slab_rows, only: block_of_pairs, block_of_waves
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  include 'fuge_slab_plan.inc'

end module fuge_single_slab_plan
