!> A surface: heights on a regular grid.
module fuge_surface_type
  use fuge_kinds, only: dp
  implicit none
  private

  !> Format of a file of heights: recognised by its content.
  integer, parameter, public :: FUGE_FILE_ANY = 0
  !> A plain grid of numbers, a line for each row of points.
  integer, parameter, public :: FUGE_FILE_GRID = 1
  !> Three columns, x, y and height of a point on each line.
  integer, parameter, public :: FUGE_FILE_POINTS = 2
  !> SDF, the surface data file of ISO 25178-71, as text or binary.
  integer, parameter, public :: FUGE_FILE_SDF = 3

  !> Heights on a regular grid.
  type, public :: fuge_surface
    !> (nx, ny), positive upwards; point (i, j) has the number i + nx*(j - 1) in a contact problem.
    real(dp), allocatable :: height(:, :)
    !> From point to point along x and along y; 0 if the file does not say.
    real(dp) :: spacing_x = 0.0_dp, spacing_y = 0.0_dp
    !> Position of point (1, 1).
    real(dp) :: origin_x = 0.0_dp, origin_y = 0.0_dp
    !> Number of points that were not measured, and have been filled.
    integer :: filled = 0
  end type fuge_surface

end module fuge_surface_type
