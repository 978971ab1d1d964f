!> What a field says, in one array: six stresses and three displacements.
module field_expectations
  use fuge_field_type, only: fuge_field
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: below_cells, of_axis, of_plane, values_at

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

    call field%stress(place, values(:6, :), info, below)
    if (.not. info%failed()) call field%displacement(place, values(7:, :), info, below)
    if (info%failed()) values = NONE
  end function values_at

  !> (9, cells) at one depth below the cells of a grid, in layers below an interface.
  function below_cells(field, depth) result(values)
    class(fuge_field), intent(in) :: field
    real(dp), intent(in) :: depth
    real(dp) :: values(9, field%cells)
    real(dp) :: both(9, field%cells, 1)
    type(fuge_info) :: info

    call field%grid_stress([depth], both(:6, :, :), info, [.true.])
    if (.not. info%failed()) call field%grid_displacement([depth], both(7:, :, :), info, [.true.])
    values = merge(NONE, both(:, :, 1), info%failed())
  end function below_cells

  !> Stresses xx, zz, xz and displacements along x and z as a field has them; yy is `nu` times the sum of the others.
  pure function of_plane(stress, u, nu) result(values)
    real(dp), intent(in) :: stress(:, :), u(:, :), nu(:)
    real(dp) :: values(9, size(nu))

    values = 0.0_dp
    values([1, 3, 5], :) = stress
    values(2, :) = nu*(stress(1, :) + stress(2, :))
    values([7, 9], :) = u
  end function of_plane

  !> Stresses rr, tt, zz, rz and displacements along r and z as a field has them.
  pure function of_axis(stress, u) result(values)
    real(dp), intent(in) :: stress(:, :), u(:, :)
    real(dp) :: values(9, size(u, 2))

    values = 0.0_dp
    values([1, 2, 3, 5], :) = stress
    values([7, 9], :) = u
  end function of_axis

end module field_expectations
