!> Kinds of the library, one place.
module fuge_kinds
  use, intrinsic :: iso_fortran_env, only: real64
  implicit none
  private

  !> All real data: C's double.
  integer, parameter, public :: dp = real64

  !> Residuals of refinement: extended precision where the machine has it.
  integer, parameter :: wider = selected_real_kind(p=18)
  integer, parameter, public :: xp = merge(wider, dp, wider > 0)

end module fuge_kinds
