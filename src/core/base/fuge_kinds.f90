!> The kinds of real numbers.
module fuge_kinds
  use, intrinsic :: iso_fortran_env, only: real32, real64
  implicit none
  private

  !> Kind of all real data of the interface: C's double.
  integer, parameter, public :: fuge_dp = real64
  !> fuge_dp, by its name inside the library.
  integer, parameter, public :: dp = fuge_dp

  !> Kind of what the search alone needs: half the bytes.
  integer, parameter, public :: sp = real32

  integer, parameter :: wider = selected_real_kind(p=18)
  !> Kind of residuals in iterative refinement: extended precision where the machine has it.
  integer, parameter, public :: xp = merge(wider, dp, wider > 0)

end module fuge_kinds
