!> The influence operator, abstract: displacements u = A f of the candidate points.
!>
!> Extend it to bring an operator of your own. A is symmetric and positive
!> definite on the forces with zero resultant; u is positive into the body.
module fuge_operator_type
  use fuge_kinds, only: dp
  implicit none
  private

  type, abstract, public :: fuge_operator
  contains
    !> Number of candidate points n; 0 while the operator is not set.
    procedure(count_points), deferred :: points
    !> u = (A - datum) f.
    procedure(multiply), deferred :: apply
    !> A constant taken out of all of A in `apply`, 0 unless overridden: only v_0
    !> sees it, and without it a large one costs the products their digits.
    procedure :: datum => no_datum
    !> Lengths by which to judge errors of the displacements, see below.
    procedure :: magnitude => largest_displacement
  end type fuge_operator

  abstract interface
    pure function count_points(self) result(n)
      import :: fuge_operator
      class(fuge_operator), intent(in) :: self
      integer :: n
    end function count_points

    !> `force` (n), force; `displacement` (n), length; `status` is 0, or a code
    !> of `fuge_status` that ends the solve.
    subroutine multiply(self, force, displacement, status)
      import :: fuge_operator, dp
      class(fuge_operator), intent(in) :: self
      real(dp), intent(in) :: force(:)
      real(dp), intent(out) :: displacement(:)
      integer, intent(out) :: status
    end subroutine multiply
  end interface

contains

  function no_datum(self) result(datum)
    class(fuge_operator), intent(in) :: self
    real(dp) :: datum

    datum = 0.0_dp*real(self%points(), dp)
  end function no_datum

  !> sum_j |A_ij - datum| |f_j| at each point, `length` (n): what the terms of a
  !> displacement add up to before they cancel. `displacement` (n) is what `apply` made
  !> of `force` (n); its largest value has to do where an operator does not override this.
  subroutine largest_displacement(self, force, displacement, length)
    class(fuge_operator), intent(in) :: self
    real(dp), intent(in) :: force(:), displacement(:)
    real(dp), intent(out) :: length(:)

    length = 0.0_dp
    if (self%points() == size(force)) length = maxval(abs(displacement))
  end subroutine largest_displacement

end module fuge_operator_type
