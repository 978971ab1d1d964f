!> The largest von Mises or Tresca stress of a field: the best places of a grid that is finer where it has to be, then a
!> climb from each.
module fuge_peak_search
  use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_quiet_nan, ieee_value
  use fuge_kinds, only: dp
  use fuge_peak_climb, only: climb
  use fuge_peak_starts, only: find_starts, peak_start
  use fuge_pressed_cells, only: pressed_cells
  use fuge_pressure_rims, only: find_singular_rim
  use fuge_status, only: fuge_info, report, FUGE_ERR_OVERFLOW
  use fuge_stress_field, only: stress_field
  use fuge_stress_peak_type, only: fuge_stress_peak, FUGE_PEAK_SINGULAR, FUGE_PEAK_SURFACE
  implicit none
  private

  public :: find_peak, singular_peak

contains

  !> The largest stress of a `field` below `cells` of pressure, which may be none.
  !>
  !> Its relative error is below 1e-6 where the stress is smooth around its maximum, and below 1e-3 where it has a cusp
  !> there, as at the surface beside the rim of a ball, unless at all places of the grid nearby less than 0.7 of the
  !> maximum is left. Where the pressure of the cells grows towards a rim as under a flat punch it is singular. Of
  !> symmetric cells the place is that with x >= 0, y >= 0. Errors, `peak` untouched: those of the field,
  !> FUGE_ERR_MEMORY, FUGE_ERR_OVERFLOW if no stress is finite.
  subroutine find_peak(field, cells, measure, peak, info)
    class(stress_field), intent(in) :: field
    type(pressed_cells), intent(in) :: cells
    integer, intent(in) :: measure
    type(fuge_stress_peak), intent(inout) :: peak
    type(fuge_info), intent(inout) :: info
    type(peak_start), allocatable :: starts(:)
    type(peak_start) :: best
    real(dp) :: edge(2), tensor(6, 1)
    logical :: singular

    if (info%failed()) return
    if (size(cells%pressure) == 0) then
      peak = fuge_stress_peak()
      return
    end if
    call find_singular_rim(cells, singular, edge, info)
    if (info%failed()) return
    if (singular) then
      peak = singular_peak([merge(abs(edge), edge, cells%symmetric), 0.0_dp])
      return
    end if
    call find_starts(field, cells, measure, starts, info)
    if (info%failed()) return
    if (size(starts) == 0) then
      call report(info, FUGE_ERR_OVERFLOW, 'no stress is in range: choose another unit of force')
      return
    end if
    call climb(field, cells, measure, starts, best, info)
    where (cells%symmetric) best%place(:2) = abs(best%place(:2))
    if (.not. info%failed()) call field%find_stress(reshape(best%place, [3, 1]), [.false.], tensor, info)
    if (info%failed()) return
    peak = fuge_stress_peak(value=best%value, place=best%place, tensor=tensor(:, 1))
    if (.not. peak%place(3) > 0.0_dp) peak%location = FUGE_PEAK_SURFACE
  end subroutine find_peak

  !> An infinite stress at a `place` of the surface.
  pure function singular_peak(place) result(peak)
    real(dp), intent(in) :: place(3)
    type(fuge_stress_peak) :: peak

    peak%value = ieee_value(1.0_dp, ieee_positive_inf)
    peak%place = place
    peak%location = FUGE_PEAK_SINGULAR
    peak%tensor = ieee_value(1.0_dp, ieee_quiet_nan)
  end function singular_peak

end module fuge_peak_search
