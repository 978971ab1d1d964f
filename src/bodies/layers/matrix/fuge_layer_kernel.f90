!> What layers add to the displacement of a half-space of their short waves at a distance from a force on a point, or on
!> a line, tabulated. There the half-space is singular; what is added is smooth, the smoother the farther away.
module fuge_layer_kernel
  use fuge_chebyshev, only: chebyshev_coefficients, chebyshev_points
  use fuge_constants, only: PI
  use fuge_kinds, only: dp
  use fuge_wave_mixture, only: wave_mixture
  implicit none
  private

  !> Degree of the series on each interval. The first interval ends at this multiple of the shortest t, below the depth
  !> of the nearest image; each other one has twice the length of that before it.
  integer, parameter :: DEGREE = 32
  real(dp), parameter :: FIRST = 4.0_dp

  type, public :: layer_kernel
    !> What is added is smooth over this length.
    real(dp) :: scale = 0.0_dp
    !> (0:DEGREE, 0:count)
    real(dp), allocatable, private :: coefficient(:, :)
  contains
    procedure :: set
    procedure :: value_at
  end type layer_kernel

contains

  !> Tabulate the displacement, times e_star, by a force of 1 on a point (`directions` = 2), or on a line by a force of
  !> 1 per length (1), at distances up to `longest`. On lines displacements are zero at the distance `datum` on the
  !> half-space below the layers. `stat` as in an allocate statement.
  subroutine set(self, body, directions, longest, datum, stat)
    class(layer_kernel), intent(inout) :: self
    type(wave_mixture), intent(in) :: body
    integer, intent(in) :: directions
    real(dp), intent(in) :: longest, datum
    integer, intent(out) :: stat
    type(wave_mixture) :: plain
    real(dp), allocatable :: node(:), weight(:), weight_of_plain(:)
    real(dp) :: begin, constant, points(0:DEGREE)
    integer :: count, k

    self%scale = FIRST*body%unit
    count = 0
    do while (self%scale*2.0_dp**count < longest)
      count = count + 1
    end do
    if (allocated(self%coefficient)) deallocate (self%coefficient)
    allocate (self%coefficient(0:DEGREE, 0:count), stat=stat)
    if (stat /= 0) return
    ! The half-space as a mixture has the same nodes.
    plain = body
    plain%weight = 1.0_dp
    plain%limit = 1.0_dp
    plain%tail = 0.0_dp
    call body%make_rule(body%unit, self%scale*2.0_dp**count, directions, node, weight, stat)
    if (stat == 0) call plain%make_rule(body%unit, self%scale*2.0_dp**count, directions, node, weight_of_plain, stat)
    if (stat /= 0) return
    constant = 0.0_dp
    if (directions == 1) then
      constant = body%line_constant(body%unit, node, weight) - plain%line_constant(body%unit, node, weight_of_plain) &
                 + (body%limit - 1.0_dp)*log(datum/body%unit)
      weight = 2.0_dp/PI*(weight - weight_of_plain)/node
      constant = 2.0_dp/PI*constant
    else
      weight = (weight - weight_of_plain)/(node**2*PI*sqrt(PI)*body%unit)
    end if
    do k = 0, count
      begin = merge(0.0_dp, self%scale*2.0_dp**(k - 1), k == 0)
      points = (begin + 0.5_dp*(self%scale*2.0_dp**k - begin)*(1.0_dp + chebyshev_points(DEGREE)))/body%unit
      self%coefficient(:, k) = chebyshev_coefficients(values(points))
    end do

  contains

    !> At the distances `x` in units of the shortest t.
    pure function values(x)
      real(dp), intent(in) :: x(:)
      real(dp) :: values(size(x))
      integer :: i

      do i = 1, size(x)
        values(i) = constant + sum(weight*exp(-(0.5_dp*x(i)/node)**2))
      end do
    end function values

  end subroutine set

  !> The value at the distance `x` >= 0, length.
  elemental function value_at(self, x) result(value)
    class(layer_kernel), intent(in) :: self
    real(dp), intent(in) :: x
    real(dp) :: value
    real(dp) :: after, next, now, t
    integer :: j, k

    t = x/self%scale
    k = 0
    if (t > 1.0_dp) k = min(exponent(t), ubound(self%coefficient, 2))
    ! From -1 to 1 on the interval.
    if (k > 0) then
      t = 4.0_dp*scale(t, -k) - 3.0_dp
    else
      t = 2.0_dp*t - 1.0_dp
    end if
    next = 0.0_dp
    after = 0.0_dp
    do j = DEGREE, 1, -1
      now = self%coefficient(j, k) + 2.0_dp*t*next - after
      after = next
      next = now
    end do
    value = self%coefficient(0, k) + t*next - after
  end function value_at

end module fuge_layer_kernel
