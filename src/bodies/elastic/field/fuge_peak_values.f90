!> The von Mises or Tresca stress of a field at many places.
module fuge_peak_values
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_kinds, only: dp
  use fuge_pressed_cells, only: pressed_cells
  use fuge_status, only: fuge_info, require_memory
  use fuge_stress_field, only: stress_field
  use fuge_stress_measures, only: fuge_tresca, fuge_von_mises
  use fuge_stress_peak_type, only: FUGE_MEASURE_TRESCA
  implicit none
  private

  public :: evaluate_measure, measured

contains

  !> `place` (3, places), or its mirror image if the `cells` are symmetric; out: `value` (places) of the `measure`, -1
  !> where it is not finite, and the stress zz in `normal` (places). Errors: those of the field, FUGE_ERR_MEMORY.
  subroutine evaluate_measure(field, cells, measure, place, value, normal, info)
    class(stress_field), intent(in) :: field
    type(pressed_cells), intent(in) :: cells
    integer, intent(in) :: measure
    real(dp), intent(in) :: place(:, :)
    real(dp), intent(out) :: value(:), normal(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: stress(:, :), mirrored(:, :)
    logical, allocatable :: below(:)
    integer :: axis, stat

    value = -1.0_dp
    normal = 0.0_dp
    if (info%failed() .or. size(value) == 0) return
    allocate (stress(6, size(value)), mirrored(3, size(value)), below(size(value)), stat=stat)
    call require_memory(stat, 'the stresses at', size(value), 'places of the search', info)
    if (stat /= 0) return
    below = .false.
    mirrored = place
    do axis = 1, 2
      if (cells%symmetric(axis)) mirrored(axis, :) = abs(place(axis, :))
    end do
    call field%find_stress(mirrored, below, stress, info)
    if (info%failed()) return
    value = measured(measure, stress)
    where (value >= 0.0_dp) normal = stress(3, :)
  end subroutine evaluate_measure

  !> The values of the measure of `stress` (6, places), -1 where it is not finite.
  pure function measured(measure, stress) result(value)
    integer, intent(in) :: measure
    real(dp), intent(in) :: stress(:, :)
    real(dp) :: value(size(stress, 2))

    if (measure == FUGE_MEASURE_TRESCA) then
      value = fuge_tresca(stress)
    else
      value = fuge_von_mises(stress)
    end if
    where (.not. ieee_is_finite(value)) value = -1.0_dp
  end function measured

end module fuge_peak_values
