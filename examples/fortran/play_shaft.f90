!> The shaft of the example `play` in a bush with a soft liner, as an operator that needs no matrix.
module play_shaft
  use fuge, only: dp => fuge_dp, fuge_operator, FUGE_DONE
  implicit none
  private

  public :: deflection

  !> N, mm: a steel shaft of 20 mm diameter.
  real(dp), parameter :: PI = acos(-1.0_dp)
  real(dp), parameter, public :: BENDING_STIFFNESS = 2.1e5_dp*PI*20.0_dp**4/64.0_dp
  !> A liner of 1 mm, 3000 N/mm2, that touches the shaft on a width of 10 mm: force per length and compression.
  real(dp), parameter, public :: LINER_STIFFNESS = 3.0e4_dp

  !> Displacements of the shaft, clamped at x = 0, by forces on n equal cells from `first` to `last`, and of the liner
  !> by the force on the cell itself: A = B + 1/(k h). Its products take a few operations for each cell.
  type, extends(fuge_operator), public :: lined_shaft
    integer :: n = 0
    real(dp) :: first = 0.0_dp, last = 0.0_dp
  contains
    procedure :: width
    procedure :: centres
    procedure :: points
    procedure :: apply
    procedure :: has_preconditioner
    procedure :: precondition
    procedure :: grid
    procedure :: coarsen
  end type lined_shaft

contains

  !> Deflection at x by a unit force at s of a beam clamped at 0.
  elemental function deflection(x, s)
    real(dp), intent(in) :: x, s
    real(dp) :: deflection

    deflection = min(x, s)**2*(3.0_dp*max(x, s) - min(x, s))/(6.0_dp*BENDING_STIFFNESS)
  end function deflection

  pure function width(self)
    class(lined_shaft), intent(in) :: self
    real(dp) :: width

    width = (self%last - self%first)/real(self%n, dp)
  end function width

  pure function centres(self) result(x)
    class(lined_shaft), intent(in) :: self
    real(dp) :: x(self%n)
    integer :: k

    x = [(self%first + self%width()*(real(k, dp) - 0.5_dp), k=1, self%n)]
  end function centres

  pure function points(self) result(n)
    class(lined_shaft), intent(in) :: self
    integer :: n

    n = self%n
  end function points

  !> The deflection is s**2 (3 x - s) by forces at s <= x and x**2 (3 s - x) by those at s > x, over 6 E I: sums of
  !> forces times powers of s, from either end, give it at all cells.
  subroutine apply(self, force, displacement, status)
    class(lined_shaft), intent(in) :: self
    real(dp), intent(in) :: force(:)
    real(dp), intent(out) :: displacement(:)
    integer, intent(out) :: status
    real(dp) :: x, squares, cubes, forces, moments, liner
    integer :: k

    liner = 1.0_dp/(LINER_STIFFNESS*self%width())
    squares = 0.0_dp
    cubes = 0.0_dp
    do k = 1, self%n
      x = place(self, k)
      squares = squares + force(k)*x**2
      cubes = cubes + force(k)*x**3
      displacement(k) = 3.0_dp*x*squares - cubes
    end do
    forces = 0.0_dp
    moments = 0.0_dp
    do k = self%n, 1, -1
      x = place(self, k)
      displacement(k) = (displacement(k) + x**2*(3.0_dp*moments - x*forces))/(6.0_dp*BENDING_STIFFNESS) + liner*force(k)
      forces = forces + force(k)
      moments = moments + force(k)*x
    end do
    status = FUGE_DONE
  end subroutine apply

  pure function place(self, k) result(x)
    type(lined_shaft), intent(in) :: self
    integer, intent(in) :: k
    real(dp) :: x

    x = self%first + self%width()*(real(k, dp) - 0.5_dp)
  end function place

  function has_preconditioner(self) result(preconditioned)
    class(lined_shaft), intent(in) :: self
    logical :: preconditioned

    preconditioned = self%n > 0
  end function has_preconditioner

  !> The inverse of the liner alone: to the short waves of the forces the shaft is rigid, and there are few long ones.
  subroutine precondition(self, displacement, force, status)
    class(lined_shaft), intent(in) :: self
    real(dp), intent(in) :: displacement(:)
    real(dp), intent(out) :: force(:)
    integer, intent(out) :: status

    force = LINER_STIFFNESS*self%width()*displacement
    status = FUGE_DONE
  end subroutine precondition

  function grid(self) result(cells)
    class(lined_shaft), intent(in) :: self
    integer :: cells(2)

    cells = [self%n, 1]
  end function grid

  !> The same shaft with wider cells; none where these do not fit.
  subroutine coarsen(self, levels, coarse)
    class(lined_shaft), intent(in) :: self
    integer, intent(in) :: levels
    class(fuge_operator), allocatable, intent(out) :: coarse

    if (modulo(self%n, 2**levels) /= 0 .or. self%n/2**levels < 32) return
    allocate (coarse, source=lined_shaft(self%n/2**levels, self%first, self%last))
  end subroutine coarsen

end module play_shaft
