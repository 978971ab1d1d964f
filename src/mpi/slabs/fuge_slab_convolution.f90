!> Products with convolution matrices of grids whose rows ranks share.
!>
!> As in fuge_grid_convolution, a pair of rows is transformed as one line of complex numbers, and zeros of a circle that
!> is twice as long are never transformed; a few columns at a time are copied to lines and transformed there. Between
!> the two an exchange (fuge_slab_exchange) carries all waves of a pair to the ranks that have them; an element is one
!> wave of a pair of rows, two complex numbers. Each line is computed as by one process, so that products do not depend
!> on the number of ranks.
module fuge_slab_convolution
  use, intrinsic :: iso_c_binding, only: c_loc
  use fuge_grid_convolution, only: add_untwisted, convolve_line, opposite, twist_line
  use fuge_grid_plan, only: stored_waves
  use fuge_kinds, only: wp => dp
  use fuge_slab_exchange, only: slab_exchange
  use fuge_slab_plan, only: slab_plan, COLUMNS, NUMBERS
  implicit none
  private

  include 'fuge_slab_convolution.inc'

end module fuge_slab_convolution
