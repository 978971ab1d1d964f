!> What a solve to a wanted error finds.
module fuge_resolved_contact_type
  use fuge_kinds, only: dp
  use fuge_smooth_contact_type, only: fuge_smooth_contact
  implicit none
  private

  !> `method` of a result: a series on one smooth contact (fuge_solve_smooth_punch).
  integer, parameter, public :: FUGE_BY_SERIES = 1
  !> `method`: cells that are narrow at the ends of the contact (fuge_graded_cells).
  integer, parameter, public :: FUGE_BY_GRADED_CELLS = 2
  !> `method`: equal cells by FFT.
  integer, parameter, public :: FUGE_BY_EQUAL_CELLS = 3

  !> One solve on the way to the answer.
  type, public :: fuge_level
    !> Cells of the grid; of a series its coefficients.
    integer :: cells = 0
    !> One of FUGE_BY_SERIES ..
    integer :: method = 0
    !> Estimated errors: of the pressure as the share of the load in the wrong place, 1 if nothing is known yet; of the
    !> approach, length, huge if nothing is known.
    real(dp) :: pressure_error = 1.0_dp, approach_error = huge(1.0_dp)
    !> Time since the call when this level was done; seconds.
    real(dp) :: seconds = 0.0_dp
  end type fuge_level

  !> A contact to a wanted error, on cells.
  type, public :: fuge_resolved_contact
    !> Centres and widths of the cells along x, (nx), and along y, (ny), length; on a line ny = 1, and y is 0 and its
    !> width 1.
    real(dp), allocatable :: x(:), width_x(:), y(:), width_y(:)
    !> Contact forces and gaps under load of the cells, (nx*ny), x running first; force, on a line per unit depth, and
    !> length.
    real(dp), allocatable :: force(:), gap(:)
    !> Load, approach, and on a line with a moment the tilt: the bodies move by approach + tilt x.
    real(dp) :: load = 0.0_dp, approach = 0.0_dp, tilt = 0.0_dp
    !> Largest pressure, force per length squared.
    real(dp) :: largest = 0.0_dp
    !> On a line the ends of each interval of contact, (2, k), length.
    real(dp), allocatable :: edges(:, :)
    !> Size of the contact: the length, on an area the area, in contact.
    real(dp) :: size = 0.0_dp
    !> Estimated errors: of the pressure, as the share of the load in the wrong place; of the others in their units.
    !> They are those of the discretisation, not of the model.
    real(dp) :: pressure_error = 1.0_dp, approach_error = huge(1.0_dp), largest_error = huge(1.0_dp), &
      edge_error = huge(1.0_dp), size_error = huge(1.0_dp)
    !> Does the contact reach an end of the interval, or a side of the rectangle: left, right, low y, high y? There the
    !> bodies are taken to end. On a periodic surface never.
    logical :: at_rim(4) = .false.
    !> One of FUGE_BY_SERIES ..
    integer :: method = 0
    !> A sentence that explains the method; C shows its first 255 characters.
    character(len=:), allocatable :: choice
    !> All solves, in their order.
    type(fuge_level), allocatable :: levels(:)
    !> The series, if `method` is FUGE_BY_SERIES: exact at any place.
    type(fuge_smooth_contact), allocatable :: series
  end type fuge_resolved_contact

end module fuge_resolved_contact_type
