!> The largest von Mises or Tresca stress of a field, by search.
module fuge_peak_search
  use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_quiet_nan, ieee_value
  use fuge_kinds, only: dp
  use fuge_peak_climb, only: climb
  use fuge_peak_starts, only: find_starts, peak_start
  use fuge_pressed_cells, only: pressed_cells
  use fuge_ridge_walk, only: walk_ridge
  use fuge_status, only: fuge_info, report, FUGE_ERR_OVERFLOW
  use fuge_stress_field, only: stress_field
  use fuge_stress_peak_type, only: fuge_stress_peak, FUGE_PEAK_INSIDE, FUGE_PEAK_SINGULAR, FUGE_PEAK_SURFACE
  implicit none
  private

  public :: find_peak, singular_peak

  !> A maximum that is flatter along one direction than this is one of a ridge.
  real(dp), parameter :: RIDGE = 1.0e-2_dp

contains

  !> The largest stress of a `field` below `cells` of pressure, which may be none.
  !>
  !> Its relative error is of the order of 1e-12, if the field has as many digits, unless the maximum keeps less than
  !> `START_SHARE` of its value at all candidates nearby. Errors, `peak` untouched: those of the field, FUGE_ERR_MEMORY,
  !> FUGE_ERR_OVERFLOW if no stress is finite.
  subroutine find_peak(field, cells, measure, peak, info)
    class(stress_field), intent(inout) :: field
    type(pressed_cells), intent(in) :: cells
    integer, intent(in) :: measure
    type(fuge_stress_peak), intent(inout) :: peak
    type(fuge_info), intent(inout) :: info
    type(peak_start), allocatable :: starts(:)
    type(peak_start) :: best
    real(dp) :: flatness, tensor(6, 1)

    if (info%failed()) return
    if (size(cells%pressure) == 0) then
      peak = fuge_stress_peak()
      return
    end if
    call find_starts(field, cells, measure, starts, info)
    if (info%failed()) return
    if (size(starts) == 0) then
      call report(info, FUGE_ERR_OVERFLOW, 'no stress is in range: choose another unit of force')
      return
    end if
    call climb(field, cells%axes, measure, starts, best, flatness, info)
    if (flatness < RIDGE .and. .not. (info%failed() .or. best%fixed)) then
      call walk_ridge(field, cells%axes + 1, measure, best, info)
      ! At the least depth the highest place of a ridge is no maximum across.
      starts = [best]
      call climb(field, cells%axes, measure, starts, best, flatness, info)
    end if
    if (.not. info%failed()) call field%stresses(reshape(best%place, [3, 1]), tensor, info)
    if (info%failed()) return
    peak%value = best%value
    peak%place = best%place
    peak%tensor = tensor(:, 1)
    peak%location = FUGE_PEAK_INSIDE
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
