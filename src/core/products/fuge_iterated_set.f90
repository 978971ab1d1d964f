!> The contact set of an iterative solve, kept for derivatives and for the next solve.
module fuge_iterated_set
  use, intrinsic :: iso_fortran_env, only: int8
  use fuge_kinds, only: dp
  implicit none
  private

  !> The contact set of the last solve.
  type, public :: iterated_set
    !> The state of each point, a constant of fuge_contact_states, (n).
    integer(int8), allocatable :: state(:)
    !> The least compliance that conjugate gradients found on it, length per force; 0 before any step.
    real(dp) :: least_compliance = 0.0_dp
    !> The tolerance of the solve, which derivatives share.
    real(dp) :: tolerance = 0.0_dp
  end type iterated_set

end module fuge_iterated_set
