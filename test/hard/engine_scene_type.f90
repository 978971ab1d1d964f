!> A contact problem that two engines solve: its matrix, and for the iteration perhaps an operator of the same body.
module engine_scene_type
  use fuge, only: dp => fuge_dp, fuge_operator, fuge_problem
  implicit none
  private

  public :: tabulate

  !> Products alone, as with a callback: no preconditioner, no grid, no magnitude.
  type, extends(fuge_operator), public :: products_only
    real(dp), allocatable :: matrix(:, :)
    real(dp) :: constant = 0.0_dp
  contains
    procedure :: points
    procedure :: apply
    procedure :: datum
  end type products_only

  type, public :: engine_scene
    integer :: number = 0
    !> The body, the modes, the stops and the load in words.
    character(len=28) :: body = '', motions = '', stops = '', load = ''
    real(dp), allocatable :: alpha(:, :)
    !> May some forces store no energy?
    logical :: singular = .false.
    !> The operator of the iteration; unallocated: the matrix.
    class(fuge_operator), allocatable :: operator
    !> Positions of the points, (n), of size about 1.
    real(dp), allocatable :: x(:), y(:)
    !> 1 or 2, the body of each point, (n).
    integer, allocatable :: part(:)
    type(fuge_problem) :: problem
  end type engine_scene

contains

  pure function points(self) result(n)
    class(products_only), intent(in) :: self
    integer :: n

    n = 0
    if (allocated(self%matrix)) n = size(self%matrix, 2)
  end function points

  subroutine apply(self, force, displacement, status)
    class(products_only), intent(in) :: self
    real(dp), intent(in) :: force(:)
    real(dp), intent(out) :: displacement(:)
    integer, intent(out) :: status

    displacement = matmul(self%matrix, force)
    status = 0
  end subroutine apply

  function datum(self)
    class(products_only), intent(in) :: self
    real(dp) :: datum

    datum = self%constant
  end function datum

  !> The matrix of an operator, column by column.
  subroutine tabulate(operator, alpha)
    class(fuge_operator), intent(in) :: operator
    real(dp), allocatable, intent(out) :: alpha(:, :)
    real(dp) :: force(operator%points())
    integer :: k, n, status

    n = operator%points()
    allocate (alpha(n, n))
    do k = 1, n
      force = 0.0_dp
      force(k) = 1.0_dp
      call operator%apply(force, alpha(:, k), status)
      if (status /= 0) alpha(:, k) = huge(1.0_dp)
    end do
    alpha = 0.5_dp*(alpha + transpose(alpha)) + operator%datum()
  end subroutine tabulate

end module engine_scene_type
