!> A matrix on the cells of a grid, with products in single precision, that counts what it is asked for and may fail.
module single_matrix
  use fuge_kinds, only: dp, sp
  use fuge_operator_type, only: fuge_operator
  use fuge_status, only: FUGE_DONE
  implicit none
  private

  type, extends(fuge_operator), public :: single_matrix_operator
    !> Influence and preconditioner, both (n, n) and symmetric.
    real(dp), allocatable :: alpha(:, :), inverse(:, :)
    integer :: cells(2) = 0
    !> The least magnitude of displacements by forces of the sum 1.
    real(dp) :: least_magnitude = 0.0_dp
    !> Products in single precision are there.
    logical :: single = .true.
    !> What the product, or the preconditioning, of this number in single precision gives is lost: `status` or, if that
    !> is 0, NaN.
    integer :: lost_product = 0, lost_preconditioning = 0, status = 0
    !> In single and in double precision; associated with what counts them.
    integer, pointer :: products => null(), preconditionings => null(), exact_products => null()
  contains
    procedure :: points
    procedure :: apply
    procedure :: has_preconditioner
    procedure :: precondition
    procedure :: has_single
    procedure :: apply_single
    procedure :: precondition_single
    procedure :: common_magnitude
    procedure :: grid
    procedure :: count_in
    procedure :: set_bed
  end type single_matrix_operator

contains

  !> Count products and preconditionings in single precision, and products in double precision, in `counts` (3).
  subroutine count_in(self, counts)
    class(single_matrix_operator), intent(inout) :: self
    integer, intent(inout), target :: counts(3)

    counts = 0
    self%products => counts(1)
    self%preconditionings => counts(2)
    self%exact_products => counts(3)
  end subroutine count_in

  !> Compliances 1/(1 + distance) on `cells` (2) of the side 1, which are positive definite; the preconditioner is 1.
  subroutine set_bed(self, cells)
    class(single_matrix_operator), intent(inout) :: self
    integer, intent(in) :: cells(2)
    integer :: i, k, n

    self%cells = cells
    n = product(cells)
    if (allocated(self%alpha)) deallocate (self%alpha, self%inverse)
    allocate (self%alpha(n, n), self%inverse(n, n))
    self%inverse = 0.0_dp
    do k = 1, n
      do i = 1, n
        self%alpha(i, k) = 1.0_dp/(1.0_dp + hypot(real(modulo(i - 1, cells(1)) - modulo(k - 1, cells(1)), dp), &
                                                  real((i - 1)/cells(1) - (k - 1)/cells(1), dp)))
      end do
      self%inverse(k, k) = 1.0_dp
    end do
  end subroutine set_bed

  pure function points(self) result(n)
    class(single_matrix_operator), intent(in) :: self
    integer :: n

    n = product(self%cells)
  end function points

  function grid(self) result(cells)
    class(single_matrix_operator), intent(in) :: self
    integer :: cells(2)

    cells = self%cells
  end function grid

  subroutine apply(self, force, displacement, status)
    class(single_matrix_operator), intent(in) :: self
    real(dp), intent(in) :: force(:)
    real(dp), intent(out) :: displacement(:)
    integer, intent(out) :: status

    displacement = matmul(self%alpha, force)
    if (associated(self%exact_products)) self%exact_products = self%exact_products + 1
    status = FUGE_DONE
  end subroutine apply

  function has_preconditioner(self) result(preconditioned)
    class(single_matrix_operator), intent(in) :: self
    logical :: preconditioned

    preconditioned = allocated(self%inverse)
  end function has_preconditioner

  subroutine precondition(self, displacement, force, status)
    class(single_matrix_operator), intent(in) :: self
    real(dp), intent(in) :: displacement(:)
    real(dp), intent(out) :: force(:)
    integer, intent(out) :: status

    force = matmul(self%inverse, displacement)
    status = FUGE_DONE
  end subroutine precondition

  function has_single(self) result(single)
    class(single_matrix_operator), intent(in) :: self
    logical :: single

    single = self%single
  end function has_single

  subroutine apply_single(self, input, result, status)
    class(single_matrix_operator), intent(in) :: self
    real(sp), intent(in) :: input(:)
    real(sp), intent(out) :: result(:)
    integer, intent(out) :: status

    call multiply(self%alpha, input, result)
    status = FUGE_DONE
    if (.not. associated(self%products)) return
    self%products = self%products + 1
    if (self%products == self%lost_product) call lose(self%status, result, status)
  end subroutine apply_single

  subroutine precondition_single(self, input, result, status)
    class(single_matrix_operator), intent(in) :: self
    real(sp), intent(in) :: input(:)
    real(sp), intent(out) :: result(:)
    integer, intent(out) :: status

    call multiply(self%inverse, input, result)
    status = FUGE_DONE
    if (.not. associated(self%preconditionings)) return
    self%preconditionings = self%preconditionings + 1
    if (self%preconditionings == self%lost_preconditioning) call lose(self%status, result, status)
  end subroutine precondition_single

  subroutine multiply(matrix, input, result)
    real(dp), intent(in) :: matrix(:, :)
    real(sp), intent(in) :: input(:)
    real(sp), intent(out) :: result(:)
    real(dp) :: total
    integer :: i, k

    do i = 1, size(result)
      total = 0.0_dp
      do k = 1, size(input)
        total = total + matrix(k, i)*real(input(k), dp)
      end do
      result(i) = real(total, sp)
    end do
  end subroutine multiply

  ! What was lost: the status, or the values.
  subroutine lose(lost, values, status)
    integer, intent(in) :: lost
    real(sp), intent(inout) :: values(:)
    integer, intent(out) :: status

    status = lost
    if (lost == FUGE_DONE) values = transfer(2143289344, values(1))
  end subroutine lose

  function common_magnitude(self, largest, total) result(magnitude)
    class(single_matrix_operator), intent(in) :: self
    real(dp), intent(in) :: largest, total
    real(dp) :: magnitude

    magnitude = max(largest, self%least_magnitude*total)
  end function common_magnitude

end module single_matrix
