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
    !> u = A f.
    procedure(multiply), deferred :: apply
    !> Size of the deflection that forces cause, free of the rigid datum.
    procedure(measure), deferred :: deflection
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

    !> sum_j |f_j| (max_i A_ij - min_i A_ij), or a bound near it: a length by which
    !> an error of the gaps can be judged, whatever the datum of A.
    pure function measure(self, force) result(length)
      import :: fuge_operator, dp
      class(fuge_operator), intent(in) :: self
      real(dp), intent(in) :: force(:)
      real(dp) :: length
    end function measure
  end interface

end module fuge_operator_type
