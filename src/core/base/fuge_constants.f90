!> Constants that several folders need.
module fuge_constants
  use fuge_kinds, only: dp
  implicit none
  private

  real(dp), parameter, public :: PI = acos(-1.0_dp)

  !> Numbers with exponents up to this one can be added 2**32 times without overflow.
  integer, parameter, public :: LARGEST_EXPONENT = maxexponent(1.0_dp) - 32
  !> The product of two such numbers, or their quotient, stays in range.
  integer, parameter, public :: LARGEST_EXPONENT_OF_2 = maxexponent(1.0_dp)/2
  !> The product of four such numbers stays in range.
  integer, parameter, public :: LARGEST_EXPONENT_OF_4 = maxexponent(1.0_dp)/4

  !> Longest name of a set of nodes or elements, of a link, and of a load case.
  integer, parameter, public :: NAME_LENGTH = 80

end module fuge_constants
