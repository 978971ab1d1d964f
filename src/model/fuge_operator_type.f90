!> The influence operator, abstract: displacements u = A f of the candidate points.
!>
!> Extend it to bring an operator of your own. A is symmetric and positive
!> definite on the forces with zero resultant; u is positive into the body.
module fuge_operator_type
  use fuge_kinds, only: dp
  use fuge_status, only: FUGE_DONE, FUGE_ERR_SIZE
  implicit none
  private

  !> Extend it: `points` and `apply` are needed, the others have defaults that do.
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
    !> Is there a preconditioner? Without one the conjugate gradients run plain.
    procedure :: has_preconditioner => without_preconditioner
    !> force = M length, M symmetric, positive definite and near the inverse of A.
    procedure :: precondition => copy_through
    !> Are the points cells side by side in the order of their numbers?
    procedure :: in_row => in_no_order
    !> The same body on wider cells, for a first guess; none by default.
    procedure :: coarsen => no_coarser
  end type fuge_operator

  abstract interface
    !> Number of candidate points n; 0 while the operator is not set.
    pure function count_points(self) result(n)
      import :: fuge_operator
      class(fuge_operator), intent(in) :: self
      integer :: n
    end function count_points

    !> u = (A - datum) f: `force` (n), force; `displacement` (n), length; `status` is 0, or ends the solve:
    !> an error of `fuge_status` with its meaning, any other as FUGE_ERR_CALLBACK with the
    !> number in the message. NaN and infinity need no status, they are found.
    subroutine multiply(self, force, displacement, status)
      import :: fuge_operator, dp
      class(fuge_operator), intent(in) :: self
      real(dp), intent(in) :: force(:)
      real(dp), intent(out) :: displacement(:)
      integer, intent(out) :: status
    end subroutine multiply
  end interface

contains

  !> False: there is no preconditioner unless an extension brings one.
  function without_preconditioner(self) result(preconditioned)
    class(fuge_operator), intent(in) :: self
    logical :: preconditioned

    preconditioned = self%points() < 0
  end function without_preconditioner

  !> `length` (n); `force` (n); `status` as for `apply`. Called only where `has_preconditioner`.
  subroutine copy_through(self, length, force, status)
    class(fuge_operator), intent(in) :: self
    real(dp), intent(in) :: length(:)
    real(dp), intent(out) :: force(:)
    integer, intent(out) :: status

    force = length
    status = merge(FUGE_DONE, FUGE_ERR_SIZE, self%points() == size(length))
  end subroutine copy_through

  !> False: nothing is known of the places of the points.
  function in_no_order(self) result(in_row)
    class(fuge_operator), intent(in) :: self
    logical :: in_row

    in_row = self%points() < 0
  end function in_no_order

  !> `coarse` has n/2**doublings points, rounded up, each in the place of 2**doublings
  !> consecutive ones of this operator (the last may stand for fewer), or stays
  !> unallocated where there is no such operator. Only for points in a row.
  subroutine no_coarser(self, doublings, coarse)
    class(fuge_operator), intent(in) :: self
    integer, intent(in) :: doublings
    class(fuge_operator), allocatable, intent(out) :: coarse

    if (self%points() < 0 .and. doublings < 0) allocate (coarse, source=self)
  end subroutine no_coarser

  !> 0: nothing is taken out.
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
