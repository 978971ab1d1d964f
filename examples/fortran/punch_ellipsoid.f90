!> The punch of the example `punch_from_area`: an ellipsoid near its lowest point.
module punch_ellipsoid
  use fuge, only: dp => fuge_dp
  use profile_fit, only: shaped_gap
  implicit none
  private

  public :: cell_centres, parameters_of, punch_of

  !> What is looked for: the radii, mm, with the larger one first; the angle from the x axis to its plane, radians; and
  !> the lowest point, mm.
  type, public :: punch_values
    real(dp) :: radius(2) = 0.0_dp, angle = 0.0_dp, apex(2) = 0.0_dp
  end type punch_values

  !> The parameters are the factors of x**2/2, y**2/2 and x y over `curvature`, on which gaps depend linearly, and the
  !> lowest point over `length`. An angle is not among them: a ball, from which the search starts, has none.
  type, extends(shaped_gap), public :: ellipsoid
    !> 1/mm and mm: about those of the punch and of its contact, so that all parameters have similar effects.
    real(dp) :: curvature = 1.0_dp, length = 1.0_dp
    !> Centres of the cells, (n), mm.
    real(dp), allocatable :: x(:), y(:)
  contains
    procedure :: set_gap => set_ellipsoid_gap
  end type ellipsoid

contains

  !> Centres of the `cells` x `cells` cells of a square whose middle is the origin.
  pure subroutine cell_centres(cells, width, x, y)
    integer, intent(in) :: cells
    real(dp), intent(in) :: width
    real(dp), allocatable, intent(out) :: x(:), y(:)
    integer :: i, j

    x = [((width*(real(i, dp) - 0.5_dp*real(cells + 1, dp)), i=1, cells), j=1, cells)]
    y = [((width*(real(j, dp) - 0.5_dp*real(cells + 1, dp)), i=1, cells), j=1, cells)]
  end subroutine cell_centres

  subroutine set_ellipsoid_gap(self, parameter, gap, by_parameter)
    class(ellipsoid), intent(in) :: self
    real(dp), intent(in) :: parameter(:)
    real(dp), intent(out) :: gap(:), by_parameter(:, :)
    real(dp), dimension(size(gap)) :: x, y

    x = self%x - self%length*parameter(4)
    y = self%y - self%length*parameter(5)
    by_parameter(:, 1) = 0.5_dp*self%curvature*x**2
    by_parameter(:, 2) = 0.5_dp*self%curvature*y**2
    by_parameter(:, 3) = self%curvature*x*y
    gap = matmul(by_parameter(:, :3), parameter(:3))
    by_parameter(:, 4) = -self%length*self%curvature*(parameter(1)*x + parameter(3)*y)
    by_parameter(:, 5) = -self%length*self%curvature*(parameter(2)*y + parameter(3)*x)
  end subroutine set_ellipsoid_gap

  pure function parameters_of(shape, punch) result(parameter)
    type(ellipsoid), intent(in) :: shape
    type(punch_values), intent(in) :: punch
    real(dp) :: parameter(5)
    real(dp) :: mean, part

    mean = 0.5_dp*sum(1.0_dp/punch%radius)
    part = 0.5_dp*(1.0_dp/punch%radius(1) - 1.0_dp/punch%radius(2))
    parameter(:3) = [mean + part*cos(2.0_dp*punch%angle), mean - part*cos(2.0_dp*punch%angle), &
                     part*sin(2.0_dp*punch%angle)]/shape%curvature
    parameter(4:) = punch%apex/shape%length
  end function parameters_of

  !> The principal curvatures and their directions.
  pure function punch_of(shape, parameter) result(punch)
    type(ellipsoid), intent(in) :: shape
    real(dp), intent(in) :: parameter(:)
    type(punch_values) :: punch
    real(dp) :: mean, part

    mean = 0.5_dp*(parameter(1) + parameter(2))
    part = norm2([0.5_dp*(parameter(1) - parameter(2)), parameter(3)])
    punch%radius = 1.0_dp/(shape%curvature*[mean - part, mean + part])
    punch%angle = 0.5_dp*atan2(-parameter(3), 0.5_dp*(parameter(2) - parameter(1)))
    punch%apex = shape%length*parameter(4:)
  end function punch_of

end module punch_ellipsoid
