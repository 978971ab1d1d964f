!> Finer and finer cells on a line, until the estimated error of the pressure is the wanted one.
module fuge_line_refinement
  use fuge_cell_elements, only: FUGE_FREE
  use fuge_gap_features, only: find_features, gap_feature
  use fuge_gap_function_type, only: fuge_gap_function
  use fuge_kinds, only: dp
  use fuge_level_history, only: line_difference, level_history, next_growth, ORDER_AT_JUMPS
  use fuge_line_level, only: is_resolved, line_level, missed_contacts, solve_equal_cells, solve_graded_cells
  use fuge_line_mesh, only: borders, contact_intervals, equal_cells, extend_over_kinks, graded_mesh, joined_intervals, &
    line_mesh
  use fuge_marked_runs, only: next_run
  use fuge_number_text, only: text
  use fuge_pressing_type, only: fuge_pressing
  use fuge_resolved_contact_type, only: fuge_resolved_contact, FUGE_BY_GRADED_CELLS
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_MEMORY
  implicit none
  private

  public :: begin_search, give_level, is_smooth, refine_equal_cells, refine_graded_cells

  !> Where the search for the answer is.
  type, public :: line_search
    real(dp), private :: left = 0.0_dp, right = 0.0_dp
    !> Kinks and jumps of the gap, unless it is rough: then it has too many; is there no load?
    type(gap_feature), allocatable, private :: features(:)
    logical, private :: is_rough = .false., is_unloaded = .false.
    type(level_history) :: history
    !> The last level; is a contact known to be missed on it, or not resolved; and have the ends of the contact settled?
    type(line_level), private :: level
    logical :: misses = .false.
    logical, private :: is_settled = .false.
    !> Intervals of contact, (2, k), those expected where one was missed included; and how far the ends of those of the
    !> last level are from the ones before, huge if their numbers differ.
    real(dp), allocatable, private :: contacts(:, :)
    real(dp), private :: edge_change = huge(1.0_dp)
    !> What ended the search before the error was reached.
    character(len=:), allocatable :: obstacle
  end type line_search

  !> Cells of the first grids, graded ones and equal ones.
  integer, parameter :: FIRST_CELLS = 64, FIRST_GRADED = 48, FIRST_EQUAL = 128
  !> More graded cells take longer by their matrix than equal ones by FFT, on a smooth gap without corners earlier; and
  !> more intervals of contact leave too few cells to each.
  integer, parameter :: MOST_GRADED = 1900, MOST_ON_SMOOTH = 400, MOST_CONTACTS = 8
  !> How many times more graded cells the next grid has.
  real(dp), parameter :: GRADED_GROWTH = 1.5_dp
  !> Most solves on as many graded cells, until the ends of a contact move by no more than this part of its length,
  !> or of the distance from a kink.
  integer, parameter :: MOST_REPEATS = 6
  real(dp), parameter :: SETTLED = 0.02_dp
  !> Factors of the errors of graded cells, of equal ones, and of equal ones where the gap has kinks or jumps
  !> or a body ends.
  real(dp), parameter :: SAFETY_GRADED = 4.0_dp, SAFETY_EQUAL = 3.0_dp, SAFETY_JUMPS = 4.4_dp
  !> The error of equal cells comes from the ends of the contact, and is about this part of the load in the last three
  !> cells of each; two grids may agree by chance, where ends lie alike on cells of both.
  real(dp), parameter :: PART_OF_ENDS = 0.07_dp
  !> Finer equal cells see for themselves what coarser ones miss.
  integer, parameter :: MOST_LOOKED_BETWEEN = 4096
  integer, parameter :: DEFAULT_MOST_CELLS = 2**20
  !> How much longer a solve takes with more equal cells, in their numbers, and with GRADED_GROWTH times as many graded
  !> ones.
  real(dp), parameter :: LONGER_EQUAL = 1.2_dp, LONGER_GRADED = 2.5_dp

contains

  !> Look for kinks and jumps of the gap. Errors: those of the gap function.
  subroutine begin_search(gap, left, right, pressing, search, info)
    class(fuge_gap_function), intent(in) :: gap
    real(dp), intent(in) :: left, right
    type(fuge_pressing), intent(in) :: pressing
    type(line_search), intent(inout) :: search
    type(fuge_info), intent(inout) :: info

    search%left = left
    search%right = right
    search%is_unloaded = pressing%is_unloaded()
    allocate (search%contacts(2, 0))
    call find_features(gap, left, right, search%features, search%is_rough, info)
  end subroutine begin_search

  !> Has the gap neither kinks nor jumps?
  pure function is_smooth(search)
    type(line_search), intent(in) :: search
    logical :: is_smooth

    is_smooth = size(search%features) == 0 .and. .not. search%is_rough
  end function is_smooth

  !> Solve on cells that are graded towards the ends of the contact and the features, more and more, until the wanted
  !> error is reached or something ends the search. It is not `done` if there are too many contacts or features, or
  !> equal cells are the shorter way.
  subroutine refine_graded_cells(gap, pressing, search, done, info)
    class(fuge_gap_function), intent(in) :: gap
    type(fuge_pressing), intent(in) :: pressing
    type(line_search), intent(inout) :: search
    logical, intent(out) :: done
    type(fuge_info), intent(inout) :: info
    type(line_level) :: before
    real(dp) :: cells
    logical :: possible

    done = .false.
    if (pressing%boundary /= FUGE_FREE .or. allocated(pressing%layers) .or. search%is_rough) return
    call search%history%change_method(SAFETY_GRADED)
    search%level%mesh = equal_cells(search%left, search%right, FIRST_CELLS)
    call solve_graded_cells(gap, pressing, search%level, info)
    if (.not. info%failed()) call see_contacts(gap, search, info)
    if (info%failed()) return
    cells = real(FIRST_GRADED, dp)
    do while (cells <= real(min(most_graded_cells(search), pressing%cells_allowed(DEFAULT_MOST_CELLS)), dp))
      before = search%level
      call settle_on_graded_cells(gap, pressing, nint(cells), search, possible, info)
      if (.not. possible) search%level = before
      if (info%failed() .or. .not. possible) return
      call add_level(search, before, GRADED_GROWTH, cells > real(FIRST_GRADED, dp))
      if (.not. search%misses) done = search%history%pressure_error() <= pressing%accuracy
      if (done .or. graded_is_longer(search, pressing%accuracy, cells)) return
      call watch_clock(pressing, LONGER_GRADED, search)
      done = allocated(search%obstacle)
      if (done) return
      cells = GRADED_GROWTH*cells
    end do
  end subroutine refine_graded_cells

  !> Most graded cells of a grid: many are for what equal cells resolve badly.
  pure function most_graded_cells(search) result(most)
    type(line_search), intent(in) :: search
    integer :: most

    most = MOST_GRADED
    associate (force => search%level%solution%force)
      if (size(search%features) == 0 .and. .not. max(force(1), force(size(force))) > 0.0_dp) most = MOST_ON_SMOOTH
    end associate
  end function most_graded_cells

  !> Would the wanted error need more graded cells than are sensible? It falls with their square.
  pure function graded_is_longer(search, accuracy, cells) result(longer)
    type(line_search), intent(in) :: search
    real(dp), intent(in) :: accuracy, cells
    logical :: longer

    longer = .false.
    if (search%history%pressure_error() < 1.0_dp) &
      longer = cells*sqrt(search%history%pressure_error()/accuracy) > 2.0_dp*real(most_graded_cells(search), dp)
  end function graded_is_longer

  !> Solve on about `cells` graded cells, again until the ends of the contact have settled. `possible` unless there are
  !> too many contacts, or a part is too short for its cells.
  subroutine settle_on_graded_cells(gap, pressing, cells, search, possible, info)
    class(fuge_gap_function), intent(in) :: gap
    type(fuge_pressing), intent(in) :: pressing
    integer, intent(in) :: cells
    type(line_search), intent(inout) :: search
    logical, intent(out) :: possible
    type(fuge_info), intent(inout) :: info
    type(line_mesh) :: mesh
    type(fuge_info) :: trial
    integer :: repeat

    do repeat = 1, MOST_REPEATS
      possible = size(search%contacts, 2) <= MOST_CONTACTS
      if (.not. possible) return
      call graded_mesh(search%left, search%right, search%features, search%contacts, cells, mesh, trial)
      possible = .not. trial%failed()
      if (.not. possible) return
      search%level%mesh = mesh
      call solve_graded_cells(gap, pressing, search%level, info)
      if (.not. info%failed()) call see_contacts(gap, search, info)
      if (info%failed() .or. search%is_settled) return
    end do
  end subroutine settle_on_graded_cells

  !> Find the contacts of the last level, and those that it missed; it is settled if there are none of these, and the
  !> others are where they were expected.
  subroutine see_contacts(gap, search, info)
    class(fuge_gap_function), intent(in) :: gap
    type(line_search), intent(inout) :: search
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: now(:, :), missed(:, :)

    allocate (now, source=contact_intervals(search%level%mesh, search%level%solution%force))
    call look_between(gap, search, missed, info)
    if (info%failed()) return
    search%misses = size(missed, 2) > 0 .or. .not. is_resolved(search%level)
    search%is_settled = .not. search%misses .and. size(now, 2) == size(search%contacts, 2)
    search%edge_change = huge(1.0_dp)
    if (search%is_settled) then
      search%edge_change = maxval([0.0_dp, abs(now - search%contacts)])
      search%is_settled = all(abs(now - search%contacts) <= SETTLED*lengths_at_ends(search%features, now))
    end if
    call extend_over_kinks(search%level%mesh, search%features, now)
    search%contacts = joined_intervals(now, missed)
  end subroutine see_contacts

  !> The share of the load in the last three cells at the ends of all contacts; 0 without a load.
  pure function load_at_ends(force) result(share)
    real(dp), intent(in) :: force(:)
    real(dp) :: share
    logical :: touches(size(force))
    integer :: first, last

    share = 0.0_dp
    touches = force > 0.0_dp
    call next_run(touches, 1, first, last)
    do while (first <= size(force))
      share = share + sum(force(first:min(first + 2, last))) + sum(force(max(last - 2, first):last))
      call next_run(touches, last + 1, first, last)
    end do
    if (share > 0.0_dp) share = share/sum(force)
  end function load_at_ends

  !> The places where contact is missed, (2, k); none without a load, where the bodies touch at one place. Errors: those
  !> of the gap function.
  subroutine look_between(gap, search, missed, info)
    class(fuge_gap_function), intent(in) :: gap
    type(line_search), intent(in) :: search
    real(dp), allocatable, intent(out) :: missed(:, :)
    type(fuge_info), intent(inout) :: info

    if (search%is_unloaded) then
      allocate (missed(2, 0))
    else
      call missed_contacts(gap, search%level, missed, info)
    end if
  end subroutine look_between

  !> The length over which the pressure varies at each end of the contacts `intervals`, (2, k), (2, k): that of the
  !> contact, or the distance from a kink if that is less.
  pure function lengths_at_ends(features, intervals) result(lengths)
    type(gap_feature), intent(in) :: features(:)
    real(dp), intent(in) :: intervals(:, :)
    real(dp) :: lengths(2, size(intervals, 2))
    integer :: j, k

    do k = 1, size(intervals, 2)
      do j = 1, 2
        lengths(j, k) = min(intervals(2, k) - intervals(1, k), &
                            minval(abs(features%place - intervals(j, k)), mask=.not. features%jumps))
      end do
    end do
  end function lengths_at_ends

  !> Solve on equal cells by FFT, until the wanted error is reached, or something ends the search.
  subroutine refine_equal_cells(gap, pressing, search, info)
    class(fuge_gap_function), intent(in) :: gap
    type(fuge_pressing), intent(in) :: pressing
    type(line_search), intent(inout) :: search
    type(fuge_info), intent(inout) :: info
    type(line_level) :: before, next
    type(fuge_info) :: trial
    real(dp) :: growth
    integer :: cells

    call search%history%change_method(SAFETY_EQUAL)
    growth = 2.0_dp
    cells = min(FIRST_EQUAL, pressing%cells_allowed(DEFAULT_MOST_CELLS))
    do
      next%mesh = equal_cells(search%left, search%right, cells)
      call solve_equal_cells(gap, pressing, next, trial)
      if (trial%status == FUGE_ERR_MEMORY .and. size(search%history%approach) > 0) then
        search%obstacle = 'there is no memory for '//text(cells)//' cells'
        return
      end if
      info = trial
      if (info%failed()) return
      before = search%level
      search%level = next
      call judge_equal_cells(pressing, search)
      call add_level(search, before, growth, size(search%history%approach) > 0)
      if (search%history%pressure_error() <= pressing%accuracy) then
        call look_at_last(gap, search, info)
        if (info%failed() .or. .not. search%misses) return
      end if
      growth = next_growth(search%history, pressing%accuracy, &
                           real(pressing%cells_allowed(DEFAULT_MOST_CELLS), dp)/real(cells, dp))
      call watch_clock(pressing, LONGER_EQUAL*growth, search)
      if (allocated(search%obstacle)) return
      if (growth <= 1.0_dp) then
        search%obstacle = 'more than '//text(pressing%cells_allowed(DEFAULT_MOST_CELLS)) &
                          //' cells are not allowed (most_cells)'
        return
      end if
      cells = nint(growth*real(cells, dp))
    end do
  end subroutine refine_equal_cells

  !> Where are the contacts of the last level of equal cells, and how regular are the errors?
  subroutine judge_equal_cells(pressing, search)
    type(fuge_pressing), intent(in) :: pressing
    type(line_search), intent(inout) :: search
    real(dp), allocatable :: now(:, :)

    allocate (now, source=contact_intervals(search%level%mesh, search%level%solution%force))
    search%edge_change = huge(1.0_dp)
    if (size(now, 2) == size(search%contacts, 2)) search%edge_change = maxval([0.0_dp, abs(now - search%contacts)])
    search%contacts = now
    search%misses = .not. is_resolved(search%level)
    search%history%least_error = PART_OF_ENDS*load_at_ends(search%level%solution%force)
    associate (force => search%level%solution%force, n => size(search%level%mesh%x))
      if (size(search%features) > 0 .or. (pressing%boundary == FUGE_FREE .and. max(force(1), force(n)) > 0.0_dp)) &
        call search%history%expect(SAFETY_JUMPS, ORDER_AT_JUMPS)
    end associate
  end subroutine judge_equal_cells

  !> Does a level of equal cells that is to be the last one miss a contact? Errors: those of the gap function.
  subroutine look_at_last(gap, search, info)
    class(fuge_gap_function), intent(in) :: gap
    type(line_search), intent(inout) :: search
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: missed(:, :)

    if (search%misses .or. size(search%level%mesh%x) > MOST_LOOKED_BETWEEN) return
    call look_between(gap, search, missed, info)
    if (.not. info%failed()) search%misses = size(missed, 2) > 0
  end subroutine look_at_last

  !> Note the last level; if it `follows` one of the same method, the level `before`, with the difference from that.
  subroutine add_level(search, before, growth, follows)
    type(line_search), intent(inout) :: search
    type(line_level), intent(in) :: before
    real(dp), intent(in) :: growth
    logical, intent(in) :: follows
    real(dp) :: load, length, difference

    associate (level => search%level, contacts => search%contacts)
      load = sum(level%solution%force)
      length = sum(contacts(2, :) - contacts(1, :))
      if (follows) then
        difference = 0.0_dp
        if (load > 0.0_dp) difference = line_difference(borders(before%mesh), before%solution%force, &
                                                        borders(level%mesh), level%solution%force)/load
        call search%history%add(size(level%mesh%x), level%method, level%solution%motion(1), &
                                maxval(level%solution%force/level%mesh%width), length, difference, growth)
      else
        call search%history%add(size(level%mesh%x), level%method, level%solution%motion(1), &
                                maxval(level%solution%force/level%mesh%width), length)
      end if
    end associate
  end subroutine add_level

  !> A level that takes `longer` times the last one may end too late.
  subroutine watch_clock(pressing, longer, search)
    type(fuge_pressing), intent(in) :: pressing
    real(dp), intent(in) :: longer
    type(line_search), intent(inout) :: search

    if (search%history%seconds() + longer*search%history%last_duration() > pressing%most_seconds) &
      search%obstacle = 'a finer grid would take longer than '//text(pressing%most_seconds)//' s (most_seconds)'
  end subroutine watch_clock

  !> Give the last level as the answer.
  subroutine give_level(pressing, search, contact)
    type(fuge_pressing), intent(in) :: pressing
    type(line_search), intent(in) :: search
    type(fuge_resolved_contact), intent(inout) :: contact

    associate (level => search%level, solution => search%level%solution)
      contact%x = level%mesh%x
      contact%width_x = level%mesh%width
      contact%force = solution%force
      contact%gap = solution%gap
      contact%load = sum(solution%force)
      if (allocated(pressing%load)) contact%load = pressing%load
      contact%approach = solution%motion(1)
      if (size(solution%motion) > 1) contact%tilt = solution%motion(2)
      contact%edges = contact_intervals(level%mesh, solution%force)
      contact%size = sum(contact%edges(2, :) - contact%edges(1, :))
      contact%largest = maxval(solution%force/level%mesh%width)
      if (pressing%boundary == FUGE_FREE) contact%at_rim(:2) = solution%force([1, size(level%mesh%x)]) > 0.0_dp
      contact%method = level%method
      call explain(search, size(contact%edges, 2), contact%choice)
    end associate
    call search%history%give_errors(contact)
    if (search%misses) contact%pressure_error = 1.0_dp
    contact%edge_error = search%edge_change
    if (search%edge_change < huge(1.0_dp)) contact%edge_error = max(2.0_dp*search%edge_change, end_width(search%level))
    contact%size_error = max(contact%size_error, contact%edge_error)
  end subroutine give_level

  !> The largest width of a cell at an end of a contact; length.
  pure function end_width(level) result(width)
    type(line_level), intent(in) :: level
    real(dp) :: width
    integer :: k

    width = 0.0_dp
    associate (force => level%solution%force)
      do k = 2, size(force)
        if (force(k) > 0.0_dp .eqv. force(k - 1) > 0.0_dp) cycle
        width = max(width, level%mesh%width(k), level%mesh%width(k - 1))
      end do
    end associate
  end function end_width

  !> Say why this way was taken; `contacts` is the number of intervals of contact.
  subroutine explain(search, contacts, choice)
    type(line_search), intent(in) :: search
    integer, intent(in) :: contacts
    character(len=:), allocatable, intent(out) :: choice

    if (search%level%method == FUGE_BY_GRADED_CELLS) then
      choice = text(size(search%level%mesh%x))//' cells, narrow at the ends of '//text(contacts)//' contact(s)'
      if (size(search%features) > 0) choice = choice//' and at '//text(size(search%features)) &
                                              //' kink(s) or jump(s) of the gap'
    else
      choice = text(size(search%level%mesh%x))//' equal cells by FFT: '//text(contacts)//' contact(s)'
      if (search%is_rough) choice = choice//' on a rough surface'
    end if
  end subroutine explain

end module fuge_line_refinement
