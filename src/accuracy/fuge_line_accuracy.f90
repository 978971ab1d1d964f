!> Line contact to a wanted error.
module fuge_line_accuracy
  use fuge_gap_function_type, only: fuge_gap_function
  use fuge_kinds, only: dp
  use fuge_line_refinement, only: begin_search, give_level, is_smooth_valley, line_search, refine_equal_cells, &
    refine_graded_cells
  use fuge_line_series, only: give_series, series_suits, solve_by_series
  use fuge_pressing_type, only: check_extent, check_pressing, fuge_pressing, warn_of_accuracy
  use fuge_resolved_contact_type, only: fuge_resolved_contact
  use fuge_smooth_contact_type, only: fuge_smooth_contact
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: fuge_solve_line

contains

  !> Press bodies together along the interval from `left` to `right`, to an estimated error of the pressure of
  !> `pressing%accuracy`.
  !>
  !> The interval is the body: where the contact reaches an end, `contact%at_rim` tells so, and the body is taken to end
  !> there. `gap` is the initial gap; `left` < `right`, length; `pressing` as described there. Out: `contact`. A smooth
  !> profile in one contact is solved by a series; up to eight intervals of contact with kinks or corners, or very small
  !> ones, on cells that are narrow there and at their ends; all else on equal cells by FFT. Grids become finer until
  !> the estimated error is reached. A feature of the gap that none of the samples meets, which lie closer than a 512th
  !> of the interval, can be missed (doc/tutorial_accuracy.md has how often the estimates held).
  !>
  !> `info` is that of the last solve, or FUGE_WARN_ACCURACY with what was reached, if most_cells, most_seconds or the
  !> memory ended the search. Errors, `contact` untouched: FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH unless left < right,
  !> FUGE_ERR_MODULUS, FUGE_ERR_CALL_ORDER for layers that are not set, FUGE_ERR_OPTION unless one of load and approach
  !> is given and the others are in range, FUGE_ERR_UNSUPPORTED for a moment with an approach or on a periodic surface,
  !> FUGE_ERR_CALLBACK for a gap function that fails, and those of the solver.
  subroutine fuge_solve_line(gap, left, right, pressing, contact, info)
    class(fuge_gap_function), intent(in) :: gap
    real(dp), intent(in) :: left, right
    type(fuge_pressing), intent(in) :: pressing
    type(fuge_resolved_contact), intent(inout) :: contact
    type(fuge_info), intent(out) :: info
    type(fuge_resolved_contact) :: found
    type(line_search) :: search
    type(fuge_smooth_contact) :: series
    logical :: reached

    call search%history%begin()
    call check_pressing(pressing, info)
    if (.not. info%failed()) call check_extent(left, right, ['left ', 'right'], info)
    if (info%failed()) return
    call begin_search(gap, left, right, pressing, search, info)
    if (info%failed()) return
    reached = .false.
    if (series_suits(pressing) .and. is_smooth_valley(search)) &
      call solve_by_series(gap, left, right, pressing, series, reached, info)
    if (reached .and. .not. info%failed()) call give_series(gap, left, right, series, found, info)
    if (info%failed()) return
    if (reached) then
      call search%history%give_only_level(size(series%coefficients), found)
    else
      call refine_cells(gap, pressing, search, info)
      if (info%failed()) return
      call give_level(pressing, search, found)
      call warn_of_accuracy(found%pressure_error, pressing%accuracy, search%obstacle, info)
    end if
    contact = found
    contact%y = [0.0_dp]
    contact%width_y = [1.0_dp]
  end subroutine fuge_solve_line

  !> Solve on graded cells, and if these do not do on equal ones; of two answers the better one.
  subroutine refine_cells(gap, pressing, search, info)
    class(fuge_gap_function), intent(in) :: gap
    type(fuge_pressing), intent(in) :: pressing
    type(line_search), intent(inout) :: search
    type(fuge_info), intent(inout) :: info
    type(line_search) :: graded
    logical :: done

    call refine_graded_cells(gap, pressing, search, done, info)
    if (info%failed() .or. done) return
    graded = search
    call refine_equal_cells(gap, pressing, search, info)
    if (info%failed() .or. .not. allocated(search%obstacle)) return
    if (graded%misses .or. .not. graded%history%pressure_error() < search%history%pressure_error()) return
    graded%obstacle = search%obstacle
    graded%history%levels = search%history%levels
    search = graded
  end subroutine refine_cells

end module fuge_line_accuracy
