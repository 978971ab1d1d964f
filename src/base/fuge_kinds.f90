!> Kinds of the library, one place.
module fuge_kinds
  use, intrinsic :: iso_fortran_env, only: real64
  implicit none
  private

  !> Kind of all real data: C's double.
  integer, parameter, public :: fuge_dp = real64
  !> Its name inside the library.
  integer, parameter, public :: dp = fuge_dp

  !> Residuals of refinement: extended precision where the machine has it.
  integer, parameter :: wider = selected_real_kind(p=18)
  integer, parameter, public :: xp = merge(wider, dp, wider > 0)

end module fuge_kinds
