!> Kinds of the library, one place.
module fuge_kinds
  use, intrinsic :: iso_fortran_env, only: real64
  implicit none
  private

  !> All real data: C's double.
  integer, parameter, public :: dp = real64

end module fuge_kinds
