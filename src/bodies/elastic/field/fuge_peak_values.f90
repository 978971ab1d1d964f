!> The measure of a field of stress at many places, in portions.
module fuge_peak_values
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info, require_memory
  use fuge_stress_field, only: stress_field
  use fuge_stress_measures, only: fuge_tresca, fuge_von_mises
  use fuge_stress_peak_type, only: FUGE_MEASURE_TRESCA
  implicit none
  private

  public :: evaluate_measure, measure_all

  !> Places in one call of the field, which may build a tree of the cells in each.
  integer, parameter :: PORTION = 2**15

contains

  !> `place` (3, places); out: `value` (places) of the `measure`, -1 where it is not finite, and the stress zz in
  !> `normal` (places). Errors: those of the field, FUGE_ERR_MEMORY.
  subroutine evaluate_measure(field, measure, place, value, normal, info)
    class(stress_field), intent(inout) :: field
    integer, intent(in) :: measure
    real(dp), intent(in) :: place(:, :)
    real(dp), intent(out) :: value(:), normal(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: stress(:, :)
    integer :: first, last, stat

    value = -1.0_dp
    normal = 0.0_dp
    if (info%failed() .or. size(value) == 0) return
    allocate (stress(6, min(PORTION, size(value))), stat=stat)
    call require_memory(stat, 'the stresses at the places of the search', info)
    if (stat /= 0) return
    do first = 1, size(value), PORTION
      last = min(first + PORTION - 1, size(value))
      call field%stresses(place(:, first:last), stress(:, :last - first + 1), info)
      if (info%failed()) return
      call measure_all(measure, stress(:, :last - first + 1), value(first:last), normal(first:last))
    end do
  end subroutine evaluate_measure

  !> The values and the stresses zz of `stress` (6, places), -1 and 0 where the value is not finite.
  pure subroutine measure_all(measure, stress, value, normal)
    integer, intent(in) :: measure
    real(dp), intent(in) :: stress(:, :)
    real(dp), intent(out) :: value(:), normal(:)

    if (measure == FUGE_MEASURE_TRESCA) then
      value = fuge_tresca(stress)
    else
      value = fuge_von_mises(stress)
    end if
    normal = stress(3, :)
    where (.not. ieee_is_finite(value))
      value = -1.0_dp
      normal = 0.0_dp
    end where
  end subroutine measure_all

end module fuge_peak_values
