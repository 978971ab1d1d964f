!> An area of contact to a wanted error.
module fuge_area_accuracy
  use fuge_area_level, only: area_level, jumps_at_rim, load_at_rim, misses_contact, solve_area_level
  use fuge_cell_elements, only: FUGE_FREE
  use fuge_gap_function_type, only: fuge_gap_function
  use fuge_kinds, only: dp
  use fuge_level_history, only: area_difference, error_law, level_history, next_growth, quick_number
  use fuge_number_text, only: text
  use fuge_pressing_type, only: check_extent, check_pressing, fuge_pressing, warn_of_accuracy
  use fuge_resolved_contact_type, only: fuge_resolved_contact, FUGE_BY_EQUAL_CELLS
  use fuge_round_contact_type, only: fuge_round_contact
  use fuge_round_series, only: give_round_series, solve_by_round_series
  use fuge_status, only: fuge_info, report, FUGE_ERR_MEMORY, FUGE_ERR_UNSUPPORTED
  implicit none
  private

  public :: fuge_solve_area

  !> Where the search for the answer is.
  type :: area_search
    type(level_history) :: history
    type(area_level) :: level
    !> Is a contact known to be missed on the last level, or not resolved?
    logical :: misses = .false.
    !> Does the gap jump at the rim of the contact?
    logical :: jumps = .false.
    !> What ended the search before the error was reached.
    character(len=:), allocatable :: obstacle
  end type area_search

  !> Cells of the first grid along the longer side, and the fewest along the other one.
  integer, parameter :: FIRST_CELLS = 32, FEWEST_CELLS = 8
  !> Cells of a contact that is resolved.
  integer, parameter :: FEWEST_IN_CONTACT = 16
  !> Errors where the contact ends smoothly, at the end of a body, and at jumps of the gap.
  type(error_law), parameter :: &
    SMOOTH = error_law(order=1.25_dp, safety=1.25_dp, likeness=0.5_dp, step=1.2_dp, leap=8.0_dp), &
    AT_RIM = error_law(order=0.75_dp, safety=1.1_dp, leap=2.5_dp), &
    AT_JUMPS = error_law(order=0.5_dp, safety=1.25_dp, fewest=3)
  !> The error comes from the rim of the contact, and is about this part of the load in the cells there; at jumps that.
  real(dp), parameter :: PART_OF_RIM = 0.17_dp, PART_AT_JUMPS = 0.45_dp
  !> Finer cells see for themselves what coarser ones miss.
  integer, parameter :: MOST_LOOKED_BETWEEN = 2**14
  integer, parameter :: DEFAULT_MOST_CELLS = 2**22
  !> How many times finer a grid is at least, and than one that missed something; and how much longer a solve takes with
  !> more cells, in their numbers.
  real(dp), parameter :: LEAST_GROWTH = 1.1_dp, LEAST_AFTER_MISS = 2.0_dp, LONGER = 1.25_dp

contains

  !> Press bodies together on the rectangle from `lower` (2) to `upper` (2), to an estimated error of the pressure of
  !> `pressing%accuracy`.
  !>
  !> The rectangle is the body: where the contact reaches a side, `contact%at_rim` tells so, and the body is taken to
  !> end there. `gap` is the initial gap; `lower` < `upper`, length; `pressing` as described there. Out: `contact`.
  !> Round and smooth bodies in one disc of contact are solved by a series; else grids of equal cells by FFT become
  !> finer until the estimated error is reached. A feature of the gap that none of the samples meets can be missed
  !> (doc/tutorial_accuracy.md has how often the estimates held).
  !>
  !> `info` is that of the last solve, or FUGE_WARN_ACCURACY with what was reached, if most_cells, most_seconds or the
  !> memory ended the search. Errors, `contact` untouched: FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH unless lower < upper,
  !> FUGE_ERR_MODULUS, FUGE_ERR_CALL_ORDER for layers that are not set, FUGE_ERR_OPTION unless one of load and approach
  !> is given and the others are in range, FUGE_ERR_UNSUPPORTED for a moment, FUGE_ERR_CALLBACK for a gap function that
  !> fails, and those of the solver.
  subroutine fuge_solve_area(gap, lower, upper, pressing, contact, info)
    class(fuge_gap_function), intent(in) :: gap
    real(dp), intent(in) :: lower(2), upper(2)
    type(fuge_pressing), intent(in) :: pressing
    type(fuge_resolved_contact), intent(inout) :: contact
    type(fuge_info), intent(out) :: info
    type(area_search) :: search
    logical :: reached

    call search%history%begin()
    call check_pressing(pressing, info)
    if (.not. info%failed()) call check_extent(lower(1), upper(1), ['lower(x)', 'upper(x)'], info)
    if (.not. info%failed()) call check_extent(lower(2), upper(2), ['lower(y)', 'upper(y)'], info)
    if (.not. info%failed() .and. allocated(pressing%moment)) &
      call report(info, FUGE_ERR_UNSUPPORTED, 'a moment is for lines: an area only approaches')
    if (info%failed()) return
    call take_series(gap, lower, upper, pressing, search, contact, reached, info)
    if (info%failed() .or. reached) return
    search%level%lower = lower
    search%level%upper = upper
    search%level%cells = first_grid(upper - lower, pressing%cells_allowed(DEFAULT_MOST_CELLS))
    call refine(gap, pressing, search, info)
    if (info%failed()) return
    contact = fuge_resolved_contact()
    call give_level(pressing, search, contact)
    call warn_of_accuracy(contact%pressure_error, pressing%accuracy, search%obstacle, info)
  end subroutine fuge_solve_area

  !> Solve by a series, if the bodies are round; `reached` then.
  subroutine take_series(gap, lower, upper, pressing, search, contact, reached, info)
    class(fuge_gap_function), intent(in) :: gap
    real(dp), intent(in) :: lower(2), upper(2)
    type(fuge_pressing), intent(in) :: pressing
    type(area_search), intent(inout) :: search
    type(fuge_resolved_contact), intent(inout) :: contact
    logical, intent(out) :: reached
    type(fuge_info), intent(inout) :: info
    type(fuge_resolved_contact) :: round
    type(fuge_round_contact) :: series
    real(dp) :: axis(2)

    call solve_by_round_series(gap, lower, upper, pressing, axis, series, reached, info)
    if (info%failed() .or. .not. reached) return
    call give_round_series(gap, lower, upper, axis, series, round, info)
    if (info%failed()) return
    reached = round%pressure_error <= pressing%accuracy
    if (.not. reached) return
    call search%history%give_only_level(size(series%coefficients()), round)
    contact = round
  end subroutine take_series

  !> Cells of the first grid, nearly square ones, on a rectangle with these `sides`.
  pure function first_grid(sides, most) result(cells)
    real(dp), intent(in) :: sides(2)
    integer, intent(in) :: most
    integer :: cells(2)

    cells = 4*nint(0.25_dp*real(FIRST_CELLS, dp)*sides/maxval(sides))
    cells = max(FEWEST_CELLS, cells)
    if (product(cells) > most) cells = max(1, int(sqrt(real(most, dp))))
  end function first_grid

  !> Solve on finer and finer grids, until the wanted error is reached, or something ends the search.
  subroutine refine(gap, pressing, search, info)
    class(fuge_gap_function), intent(in) :: gap
    type(fuge_pressing), intent(in) :: pressing
    type(area_search), intent(inout) :: search
    type(fuge_info), intent(inout) :: info
    type(area_level) :: before
    type(fuge_info) :: trial
    real(dp) :: growth

    call search%history%change_method(SMOOTH)
    do
      call solve_area_level(gap, pressing, search%level, trial)
      if (trial%status == FUGE_ERR_MEMORY .and. allocated(before%gap)) then
        search%obstacle = 'there is no memory for '//text(search%level%cells(1))//' x ' &
                          //text(search%level%cells(2))//' cells'
        search%level = before
        return
      end if
      info = trial
      if (info%failed()) return
      call judge_level(pressing, search)
      call add_level(search, before)
      if (search%history%pressure_error() <= pressing%accuracy) then
        call look_at_last(gap, pressing, search, info)
        if (info%failed() .or. .not. search%misses) return
      end if
      growth = next_growth(search%history, pressing%accuracy, search%history%law%leap)
      if (search%misses) growth = max(growth, LEAST_AFTER_MISS)
      growth = min(growth, sqrt(real(pressing%cells_allowed(DEFAULT_MOST_CELLS), dp) &
                                /product(real(search%level%cells, dp))))
      call see_obstacles(pressing, growth, search)
      if (allocated(search%obstacle)) return
      before = search%level
      search%level%cells = finer(search%level%cells, growth, pressing%cells_allowed(DEFAULT_MOST_CELLS))
    end do
  end subroutine refine

  !> How regular are the errors of the last level?
  subroutine judge_level(pressing, search)
    type(fuge_pressing), intent(in) :: pressing
    type(area_search), intent(inout) :: search

    search%misses = .false.
    search%history%law = SMOOTH
    search%history%least_error = PART_OF_RIM*load_at_rim(search%level, pressing%boundary == FUGE_FREE)
    if (any(rim_contact(pressing, search%level))) search%history%law = AT_RIM
    search%jumps = jumps_at_rim(search%level)
    if (.not. search%jumps) return
    search%history%law = AT_JUMPS
    search%history%least_error = search%history%least_error*(PART_AT_JUMPS/PART_OF_RIM)
  end subroutine judge_level

  !> Does a level that is to be the last one miss a contact, or not resolve it? Errors: those of the gap function.
  subroutine look_at_last(gap, pressing, search, info)
    class(fuge_gap_function), intent(in) :: gap
    type(fuge_pressing), intent(in) :: pressing
    type(area_search), intent(inout) :: search
    type(fuge_info), intent(inout) :: info

    associate (touching => count(search%level%solution%force > 0.0_dp))
      ! In a few cells forces are those of the cells, and no finer grid would differ from them.
      search%misses = touching > 0 .and. touching < FEWEST_IN_CONTACT
    end associate
    if (search%misses .or. pressing%is_unloaded() .or. product(search%level%cells) > MOST_LOOKED_BETWEEN) return
    call misses_contact(gap, search%level, search%misses, info)
  end subroutine look_at_last

  !> Note the last level, with the difference from the one `before`, if there is one.
  subroutine add_level(search, before)
    type(area_search), intent(inout) :: search
    type(area_level), intent(in) :: before
    real(dp) :: load, difference, growth

    difference = 0.0_dp
    growth = 1.0_dp
    associate (level => search%level, force => search%level%solution%force, cell => product(search%level%widths()))
      load = sum(force)
      if (allocated(before%gap)) growth = sqrt(real(size(force), dp)/real(size(before%gap), dp))
      if (allocated(before%gap) .and. load > 0.0_dp) &
        difference = area_difference(reshape(before%solution%force, before%cells), reshape(force, level%cells))/load
      call search%history%add(size(force), FUGE_BY_EQUAL_CELLS, growth, difference, level%solution%motion(1), &
                              maxval(force)/cell, cell*real(count(force > 0.0_dp), dp))
    end associate
  end subroutine add_level

  !> See whether a grid that is `growth` times finer is not allowed, or would end too late.
  subroutine see_obstacles(pressing, growth, search)
    type(fuge_pressing), intent(in) :: pressing
    real(dp), intent(in) :: growth
    type(area_search), intent(inout) :: search

    if (growth < LEAST_GROWTH .or. all(int(growth*real(search%level%cells, dp)) <= search%level%cells)) then
      search%obstacle = 'more than '//text(pressing%cells_allowed(DEFAULT_MOST_CELLS)) &
                        //' cells are not allowed (most_cells)'
    else if (search%history%seconds() + LONGER*growth**2*search%history%last_duration() > pressing%most_seconds) then
      search%obstacle = 'a finer grid would take longer than '//text(pressing%most_seconds)//' s (most_seconds)'
    end if
  end subroutine see_obstacles

  !> Numbers of cells that are `growth` times finer, or a little more where `most` allows it.
  pure function finer(cells, growth, most)
    integer, intent(in) :: cells(2), most
    real(dp), intent(in) :: growth
    integer :: finer(2)

    finer = max(cells, int(growth*real(cells, dp)))
    associate (quick => [quick_number(finer(1)), quick_number(finer(2))])
      if (product(real(quick, dp)) <= real(most, dp)) finer = quick
    end associate
  end function finer

  !> At which sides of a free rectangle, (4), left, right, low y, high y, is there contact?
  pure function rim_contact(pressing, level) result(touches)
    type(fuge_pressing), intent(in) :: pressing
    type(area_level), intent(in) :: level
    logical :: touches(4)

    touches = .false.
    if (pressing%boundary /= FUGE_FREE) return
    associate (force => level%solution%force, nx => level%cells(1), n => product(level%cells))
      touches = [any(force(1:n:nx) > 0.0_dp), any(force(nx:n:nx) > 0.0_dp), any(force(:nx) > 0.0_dp), &
                 any(force(n - nx + 1:) > 0.0_dp)]
    end associate
  end function rim_contact

  !> Give the last level, whose forces and gaps move, as the answer.
  subroutine give_level(pressing, search, contact)
    type(fuge_pressing), intent(in) :: pressing
    type(area_search), intent(inout) :: search
    type(fuge_resolved_contact), intent(inout) :: contact
    real(dp) :: width(2), modulus

    associate (level => search%level, solution => search%level%solution)
      width = level%widths()
      allocate (contact%x, source=level%centres(1))
      allocate (contact%y, source=level%centres(2))
      allocate (contact%width_x(level%cells(1)), source=width(1))
      allocate (contact%width_y(level%cells(2)), source=width(2))
      allocate (contact%edges(2, 0))
      contact%load = sum(solution%force)
      if (allocated(pressing%load)) contact%load = pressing%load
      contact%approach = solution%motion(1)
      contact%largest = maxval(solution%force)/product(width)
      contact%size = product(width)*real(count(solution%force > 0.0_dp), dp)
      contact%at_rim = rim_contact(pressing, level)
      contact%method = FUGE_BY_EQUAL_CELLS
      contact%choice = text(level%cells(1))//' x '//text(level%cells(2))//' equal cells by FFT'
      if (search%jumps) contact%choice = contact%choice//'; the gap jumps at the rim of the contact'
    end associate
    ! Moved, because there may be no memory for a copy.
    call move_alloc(search%level%solution%force, contact%force)
    call move_alloc(search%level%solution%gap, contact%gap)
    call search%history%give_errors(contact)
    if (allocated(pressing%load) .and. contact%size > 0.0_dp) then
      modulus = pressing%e_star
      if (allocated(pressing%layers)) modulus = pressing%layers%e_star()
      ! The approach is stationary about the exact pressure, but two grids may agree by chance.
      contact%approach_error = max(contact%approach_error, contact%pressure_error**2*contact%load &
                                                           /(modulus*sqrt(contact%size)))
      contact%levels(size(contact%levels))%approach_error = contact%approach_error
    end if
    if (search%misses) contact%pressure_error = 1.0_dp
  end subroutine give_level

end module fuge_area_accuracy
