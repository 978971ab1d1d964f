!> Where the pressure that keeps an interval closed pushes.
module fuge_smooth_exclusion
  use fuge_chebyshev, only: chebyshev_points, chebyshev_values
  use fuge_kinds, only: dp
  use fuge_smooth_newton, only: pressing
  use fuge_smooth_slope_series, only: slope_series
  implicit none
  private

  public :: pushing_parts

  !> Points for each coefficient.
  integer, parameter :: DENSITY = 4

contains

  !> The stretches in which the pressure that keeps the whole interval, with these
  !> `ends`, pushes, wider by a point of the sampling.
  pure function pushing_parts(series, task, ends) result(stretches)
    type(slope_series), intent(in) :: series
    type(pressing), intent(in) :: task
    real(dp), intent(in) :: ends(2)
    real(dp), allocatable :: stretches(:, :)
    real(dp), allocatable :: x(:), push(:)
    logical, allocatable :: pushes(:)
    integer :: n, k, found

    n = 64
    do while (n < DENSITY*size(series%a))
      n = 2*n
    end do
    allocate (x(0:n), push(0:n), pushes(-1:n + 1))
    x = series%interval%anchor + (series%interval%offset + series%interval%half*chebyshev_points(n))
    x(0) = ends(2)
    x(n) = ends(1)
    push = chebyshev_values(closed_pressure(series, task), n)
    pushes = .false.
    pushes(0:n) = push > 0.0_dp
    allocate (stretches(2, count(pushes(0:n) .and. .not. pushes(-1:n - 1))))
    found = size(stretches, 2) + 1
    do k = 0, n
      if (.not. pushes(k)) cycle
      ! x falls from point to point.
      if (.not. pushes(k - 1)) then
        found = found - 1
        stretches(2, found) = x(max(0, k - 1))
      end if
      if (.not. pushes(k + 1)) stretches(1, found) = x(min(n, k + 1))
    end do
  end function pushing_parts

  !> p/E* times sqrt(1 - t**2), in T_k, for the force and no tilt: b_0 carries the force, and
  !> -4 b_(k+1) = a_k - a_(k+2), twice a_0 for k = 0.
  pure function closed_pressure(series, task) result(b)
    type(slope_series), intent(in) :: series
    type(pressing), intent(in) :: task
    real(dp) :: b(0:size(series%a))
    real(dp) :: a(0:size(series%a) + 1)

    a = 0.0_dp
    a(:size(series%a) - 1) = series%a
    a(0) = 2.0_dp*a(0)
    b(0) = 0.25_dp*task%load/series%interval%half
    b(1:) = -0.25_dp*(a(:size(series%a) - 1) - a(2:))
  end function closed_pressure

end module fuge_smooth_exclusion
