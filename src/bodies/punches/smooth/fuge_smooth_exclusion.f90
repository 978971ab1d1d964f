!> Parts of an interval in which the pressure that keeps the whole interval closed is compressive.
module fuge_smooth_exclusion
  use fuge_chebyshev, only: chebyshev_points, chebyshev_values
  use fuge_kinds, only: dp
  use fuge_series_minimum, only: cells_for, positive_cells
  use fuge_smooth_newton, only: load_case
  use fuge_smooth_slope_series, only: slope_series
  implicit none
  private

  public :: compressive_parts

  !> A pressure is tensile unless it exceeds this fraction of the largest.
  real(dp), parameter :: RESOLUTION = 1.0e-10_dp

contains

  !> The compressive parts of the interval with these `ends`, (2, number of parts), length: left and
  !> right end of each, from left to right. Each part is a run of cells in which the pressure is compressive
  !> anywhere, which is decided and not sampled; a part may be compressive between two samples only.
  pure function compressive_parts(series, load, ends) result(parts)
    type(slope_series), intent(in) :: series
    type(load_case), intent(in) :: load
    real(dp), intent(in) :: ends(2)
    real(dp), allocatable :: parts(:, :)
    real(dp), allocatable :: x(:)
    logical, allocatable :: compressive(:)
    real(dp) :: pressure(0:size(series%coefficients))
    integer :: n, k, current

    pressure = closing_pressure(series, load)
    n = cells_for(size(pressure))
    allocate (x(0:n), compressive(0:n + 1))
    x = series%interval%anchor + (series%interval%offset + series%interval%half_width*chebyshev_points(n))
    x(0) = ends(2)
    x(n) = ends(1)
    compressive = .false.
    compressive(1:n) = positive_cells(pressure, RESOLUTION*maxval(abs(chebyshev_values(pressure, n))))
    allocate (parts(2, count(compressive(1:n) .and. .not. compressive(:n - 1))))
    current = size(parts, 2) + 1
    do k = 1, n
      if (.not. compressive(k)) cycle
      ! Cell k lies between x(k) and x(k - 1), which is greater.
      if (.not. compressive(k - 1)) then
        current = current - 1
        parts(2, current) = x(k - 1)
      end if
      if (.not. compressive(k + 1)) parts(1, current) = x(k)
    end do
  end function compressive_parts

  !> Coefficients b_k in T_k of p/E* times sqrt(1 - t**2), for the pressure p that closes the interval
  !> under the force without tilt: b_0 carries the force, and -4 b_(k+1) = a_k - a_(k+2) with the
  !> coefficients of the slope, a_0 doubled.
  pure function closing_pressure(series, load) result(b)
    type(slope_series), intent(in) :: series
    type(load_case), intent(in) :: load
    real(dp) :: b(0:size(series%coefficients))
    real(dp) :: a(0:size(series%coefficients) + 1)

    a = 0.0_dp
    a(:size(series%coefficients) - 1) = series%coefficients
    a(0) = 2.0_dp*a(0)
    b(0) = 0.25_dp*load%reduced_force/series%interval%half_width
    b(1:) = -0.25_dp*(a(:size(series%coefficients) - 1) - a(2:))
  end function closing_pressure

end module fuge_smooth_exclusion
