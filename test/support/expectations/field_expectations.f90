!> What a field says, in one array: six stresses and three displacements; and what its largest stress is to be.
module field_expectations
  use expectations, only: add_difference, add_words, REPORT_LENGTH
  use fuge_field_type, only: fuge_field
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info
  use fuge_stress_peak_type, only: fuge_stress_peak
  implicit none
  private

  public :: below_cells, peak_of, unexpected_peak, values_at

  !> In the place of values that were refused.
  real(dp), parameter :: NONE = huge(1.0_dp)

contains

  !> (9, points) at `place`.
  function values_at(field, place, below) result(values)
    class(fuge_field), intent(in) :: field
    real(dp), intent(in) :: place(:, :)
    logical, intent(in), optional :: below(:)
    real(dp) :: values(9, size(place, 2))
    type(fuge_info) :: info

    values = NONE
    call field%stress(place, values(:6, :), info, below)
    if (.not. info%failed()) call field%displacement(place, values(7:, :), info, below)
    if (info%failed()) values = NONE
  end function values_at

  !> (9, cells) at one depth below the cells of a grid.
  function below_cells(field, depth, below) result(values)
    class(fuge_field), intent(in) :: field
    real(dp), intent(in) :: depth
    logical, intent(in), optional :: below
    real(dp) :: values(9, field%cells)
    real(dp) :: tensor(6, field%cells, 1), u(3, field%cells, 1)
    logical :: lower(1)
    type(fuge_info) :: info

    lower = .false.
    if (present(below)) lower = below
    call field%grid_stress([depth], tensor, info, lower)
    if (.not. info%failed()) call field%grid_displacement([depth], u, info, lower)
    values = NONE
    if (info%failed()) return
    values(:6, :) = tensor(:, :, 1)
    values(7:, :) = u(:, :, 1)
  end function below_cells

  !> The largest stress; a huge one if it was refused.
  function peak_of(field, measure) result(peak)
    class(fuge_field), intent(in) :: field
    integer, intent(in) :: measure
    type(fuge_stress_peak) :: peak
    type(fuge_info) :: info

    peak%value = NONE
    call field%largest(measure, peak, info)
  end function peak_of

  !> '' for the same largest stress.
  pure function unexpected_peak(found, expected) result(report)
    type(fuge_stress_peak), intent(in) :: found, expected
    character(len=REPORT_LENGTH) :: report

    report = ''
    call add_difference('value', [found%value], [expected%value], 0.0_dp, report)
    call add_difference('place', found%place, expected%place, 0.0_dp, report)
    call add_difference('tensor', found%tensor, expected%tensor, 0.0_dp, report)
    if (found%location /= expected%location) call add_words('another location', report)
    if (found%layer /= expected%layer) call add_words('another layer', report)
    if (found%cell /= expected%cell) call add_words('another cell', report)
  end function unexpected_peak

end module field_expectations
