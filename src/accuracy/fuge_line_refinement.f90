!> Finer and finer cells on a line, until the estimated error of the pressure is the wanted one.
module fuge_line_refinement
  use fuge_cell_elements, only: FUGE_FREE
  use fuge_gap_features, only: find_features, gap_feature, FIRST_SAMPLES
  use fuge_gap_function_type, only: fuge_gap_function
  use fuge_kinds, only: dp
  use fuge_level_history, only: error_law, line_difference, level_history, next_growth, quick_number
  use fuge_line_level, only: error_of_ends, is_resolved, line_level, means_of_samples, missed_contacts, &
    solve_equal_cells, solve_graded_cells
  use fuge_line_mesh, only: borders, contact_intervals, equal_cells, extend_over_kinks, graded_mesh, joined_intervals, &
    line_mesh
  use fuge_number_text, only: text
  use fuge_pressing_type, only: fuge_pressing
  use fuge_resolved_contact_type, only: fuge_resolved_contact, FUGE_BY_GRADED_CELLS
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_MEMORY
  implicit none
  private

  public :: begin_search, give_level, is_smooth_valley, refine_equal_cells, refine_graded_cells

  !> Where the search for the answer is.
  type, public :: line_search
    real(dp), private :: left = 0.0_dp, right = 0.0_dp
    !> Kinks and jumps of the gap, unless it is rough: then it has too many; is there no load?
    type(gap_feature), allocatable, private :: features(:)
    logical, private :: is_rough = .false., is_unloaded = .false.
    !> The gap at equal distances, as found first, (FIRST_SAMPLES).
    real(dp), allocatable, private :: samples(:)
    type(level_history) :: history
    !> The first level of equal cells, and the last level; is a contact known to be missed on it, or not resolved; and
    !> have the ends of the contact settled?
    type(line_level), private :: first, level
    logical :: misses = .false.
    logical, private :: is_settled = .false.
    !> Intervals of contact, (2, k), those expected where one was missed included; how far their ends moved with the
    !> last solve on graded cells, (2, k), and which ones have turned back; and how far the ends of those of the last
    !> level are from the ones before, huge if their numbers differ.
    real(dp), allocatable, private :: contacts(:, :), shift(:, :)
    logical, allocatable, private :: turned(:, :)
    real(dp), private :: edge_change = huge(1.0_dp)
    !> What ended the search before the error was reached.
    character(len=:), allocatable :: obstacle
  end type line_search

  !> Cells of the first grids, equal ones and graded ones.
  integer, parameter :: FIRST_EQUAL = 128, FIRST_GRADED = 32
  !> More graded cells take longer by their matrix than equal ones by FFT; where there are neither corners nor kinks
  !> that is so unless very many of these are needed; and more intervals of contact leave too few cells to each.
  integer, parameter :: MOST_GRADED = 1900, MANY_EQUAL = 16384, MOST_CONTACTS = 8
  !> Most solves on as many graded cells, until the ends of a contact move by no more than this part of its length,
  !> or of the distance from a kink; with more cells than those in inverse proportion to their number.
  integer, parameter :: MOST_REPEATS = 6
  real(dp), parameter :: SETTLED = 0.02_dp, SETTLED_CELLS = 64.0_dp
  !> Further factor of the error where they have not settled.
  real(dp), parameter :: NOT_SETTLED = 2.0_dp
  !> Errors of graded cells, also where the only corners are those at the ends of the interval, and the gap may be
  !> rough; and of equal cells, where the contact ends smoothly, at the end of a body, and where it has kinks or jumps
  !> of the gap.
  type(error_law), parameter :: GRADED = error_law(order=2.0_dp, safety=2.0_dp, doubt=2.0_dp, leap=2.25_dp), &
    GRADED_AT_RIM = error_law(order=2.0_dp, safety=2.5_dp, doubt=2.0_dp, leap=1.5_dp), &
    SMOOTH = error_law(order=1.5_dp, safety=1.75_dp, likeness=0.5_dp, step=1.2_dp, leap=16.0_dp), &
    AT_RIM = error_law(order=1.0_dp, safety=1.5_dp, likeness=0.5_dp, leap=4.0_dp), &
    AT_FEATURES = error_law(order=0.5_dp, fewest=3)
  !> Factor of the error that comes from the ends of the contact on equal cells.
  real(dp), parameter :: SAFETY_OF_ENDS = 1.9_dp
  !> A feature is one of the contact if it is in it, or nearer to it than this part of the interval.
  real(dp), parameter :: BESIDE_CONTACT = 0.03_dp
  !> Finer equal cells see for themselves what coarser ones miss.
  integer, parameter :: MOST_LOOKED_BETWEEN = 4096
  integer, parameter :: DEFAULT_MOST_CELLS = 2**20
  !> How many times finer a grid is at least, and than one that missed something.
  real(dp), parameter :: LEAST_GROWTH = 1.1_dp, LEAST_AFTER_MISS = 2.0_dp
  !> With so many times more equal cells a solve takes so much longer yet; and with so many times more graded ones as
  !> many times as long as this power of it.
  real(dp), parameter :: LONGER_EQUAL = 1.2_dp, LONGER_GRADED = 2.3_dp

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
    allocate (search%samples(FIRST_SAMPLES))
    call find_features(gap, left, right, search%features, search%is_rough, search%samples, info)
  end subroutine begin_search

  !> Has the gap neither kinks nor jumps, and does it fall to one lowest place and rise again? Otherwise there may be
  !> several contacts, and finding that out by series takes longer than cells do.
  pure function is_smooth_valley(search) result(is_one)
    type(line_search), intent(in) :: search
    logical :: is_one

    is_one = size(search%features) == 0 .and. .not. search%is_rough
    associate (height => search%samples, lowest => minloc(search%samples, dim=1))
      is_one = is_one .and. all(height(2:lowest) <= height(:lowest - 1)) &
               .and. all(height(lowest + 1:) >= height(lowest:FIRST_SAMPLES - 1))
    end associate
  end function is_smooth_valley

  !> Solve on the first equal cells, whose gaps are means of the first samples, and see where the contacts are. Errors:
  !> those of the gap function, of the operator and of the solver.
  subroutine look_first(gap, pressing, search, info)
    class(fuge_gap_function), intent(in) :: gap
    type(fuge_pressing), intent(in) :: pressing
    type(line_search), intent(inout) :: search
    type(fuge_info), intent(inout) :: info
    integer :: cells

    cells = min(FIRST_EQUAL, pressing%cells_allowed(DEFAULT_MOST_CELLS))
    search%first%mesh = equal_cells(search%left, search%right, cells)
    if (cells == FIRST_EQUAL) search%first%gap = means_of_samples(search%samples, cells)
    call solve_equal_cells(gap, pressing, search%first, info)
    if (info%failed()) return
    search%level = search%first
    search%contacts = contact_intervals(search%level%mesh, search%level%solution%force)
    call forget_shifts(search, 0)
  end subroutine look_first

  !> Do graded cells suit better than equal ones? They do at kinks and corners, and where the contact is small beside
  !> the interval, for two half-planes without too many contacts.
  pure function graded_cells_suit(pressing, search) result(suit)
    type(fuge_pressing), intent(in) :: pressing
    type(line_search), intent(in) :: search
    logical :: suit
    real(dp) :: needed

    suit = pressing%boundary == FUGE_FREE .and. .not. allocated(pressing%layers) .and. .not. search%is_rough &
           .and. size(search%contacts, 2) <= MOST_CONTACTS
    if (.not. suit .or. has_features_in_contact(search)) return
    associate (force => search%level%solution%force)
      if (max(force(1), force(size(force))) > 0.0_dp) return
      needed = real(size(force), dp)*(SAFETY_OF_ENDS*error_of_ends(force, .false.)/pressing%accuracy)**(2.0_dp/3.0_dp)
    end associate
    suit = needed > real(MANY_EQUAL, dp) .or. .not. is_resolved(search%level)
  end function graded_cells_suit

  !> Has the gap a kink or a jump in a contact, or beside it?
  pure function has_features_in_contact(search) result(has)
    type(line_search), intent(in) :: search
    logical :: has
    real(dp) :: beside
    integer :: k

    has = .false.
    beside = BESIDE_CONTACT*(search%right - search%left)
    do k = 1, size(search%features)
      associate (place => search%features(k)%place)
        has = has .or. any(search%contacts(1, :) - beside < place .and. place < search%contacts(2, :) + beside)
      end associate
    end do
  end function has_features_in_contact

  !> Solve on cells that are graded towards the ends of the contact and the features, more and more, until the wanted
  !> error is reached or something ends the search. It is not `done` if equal cells are the better or the shorter way.
  subroutine refine_graded_cells(gap, pressing, search, done, info)
    class(fuge_gap_function), intent(in) :: gap
    type(fuge_pressing), intent(in) :: pressing
    type(line_search), intent(inout) :: search
    logical, intent(out) :: done
    type(fuge_info), intent(inout) :: info
    type(line_level) :: before
    type(error_law) :: law
    real(dp) :: cells, most, growth
    logical :: possible, follows

    done = .false.
    call look_first(gap, pressing, search, info)
    ! Beside a kink or a jump these cells may miss a contact.
    if (size(search%features) > 0 .and. .not. info%failed()) call see_contacts(gap, search, info)
    if (info%failed()) return
    if (.not. graded_cells_suit(pressing, search)) return
    law = merge(GRADED, GRADED_AT_RIM, size(search%features) > 0)
    call search%history%change_method(law)
    most = real(min(MOST_GRADED, pressing%cells_allowed(DEFAULT_MOST_CELLS)), dp)
    cells = real(FIRST_GRADED, dp)
    follows = .false.
    do while (cells <= most)
      before = search%level
      call settle_on_graded_cells(gap, pressing, nint(cells), search, possible, info)
      if (.not. possible) search%level = before
      if (info%failed() .or. .not. possible) return
      search%history%law%safety = law%safety*merge(1.0_dp, NOT_SETTLED, search%is_settled)
      call add_level(search, before, follows)
      if (.not. search%misses) done = search%history%pressure_error() <= pressing%accuracy
      if (done) return
      growth = next_growth(search%history, pressing%accuracy, huge(1.0_dp))
      call watch_clock(pressing, growth**LONGER_GRADED, search)
      done = allocated(search%obstacle)
      if (done) return
      ! Where many parts have their fewest cells, there are more than those asked for.
      cells = max(cells, real(size(search%level%mesh%x), dp))
      cells = merge(most, growth*cells, growth*cells > most .and. most > law%step*cells)
      follows = .true.
    end do
  end subroutine refine_graded_cells

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
    real(dp), allocatable :: now(:, :), missed(:, :), shift(:, :)

    allocate (now, source=contact_intervals(search%level%mesh, search%level%solution%force))
    allocate (missed(2, 0))
    ! Without a load the bodies touch at one place.
    if (.not. search%is_unloaded) call missed_contacts(gap, search%level, .true., missed, info)
    if (info%failed()) return
    search%misses = size(missed, 2) > 0 .or. .not. is_resolved(search%level)
    search%is_settled = .not. search%misses .and. size(now, 2) == size(search%contacts, 2)
    search%edge_change = huge(1.0_dp)
    if (search%is_settled) then
      allocate (shift, source=now - search%contacts)
      search%edge_change = maxval([0.0_dp, abs(shift)])
      search%is_settled = all(abs(shift) <= SETTLED*min(1.0_dp, SETTLED_CELLS/real(size(search%level%mesh%x), dp)) &
                              *lengths_at_ends(search%features, now))
      if (size(shift, 2) /= size(search%shift, 2)) call forget_shifts(search, size(shift, 2))
      ! An end that goes back to where it came from is about in the middle, and so it is from then on.
      search%turned = search%turned .or. shift*search%shift < 0.0_dp
      where (search%turned) now = 0.5_dp*(now + search%contacts)
      search%shift = shift
    else
      call forget_shifts(search, 0)
    end if
    call extend_over_kinks(search%level%mesh, search%features, now)
    search%contacts = joined_intervals(now, missed)
  end subroutine see_contacts

  !> No end of a contact, of `contacts`, has moved yet.
  subroutine forget_shifts(search, contacts)
    type(line_search), intent(inout) :: search
    integer, intent(in) :: contacts

    search%shift = spread(spread(0.0_dp, 1, 2), 2, contacts)
    search%turned = spread(spread(.false., 1, 2), 2, contacts)
  end subroutine forget_shifts

  !> The length over which the pressure varies at each end of the contacts `intervals`, (2, k), (2, k): that of the
  !> contact, or the distance from a kink if that is less.
  pure function lengths_at_ends(features, intervals) result(lengths)
    type(gap_feature), intent(in) :: features(:)
    real(dp), intent(in) :: intervals(:, :)
    real(dp) :: lengths(2, size(intervals, 2))
    integer :: k

    lengths = spread(intervals(2, :) - intervals(1, :), 1, 2)
    do k = 1, size(features)
      if (.not. features(k)%jumps) lengths = min(lengths, abs(intervals - features(k)%place))
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
    integer :: cells, most

    call search%history%change_method(SMOOTH)
    most = pressing%cells_allowed(DEFAULT_MOST_CELLS)
    next = search%first
    do
      before = search%level
      search%level = next
      call judge_equal_cells(pressing, before%mesh%width(1), search)
      call add_level(search, before, size(search%history%approach) > 0)
      if (search%history%pressure_error() <= pressing%accuracy) then
        call look_at_last(gap, search, info)
        if (info%failed() .or. .not. search%misses) return
      end if
      cells = size(search%level%mesh%x)
      growth = next_growth(search%history, pressing%accuracy, real(most, dp)/real(cells, dp))
      if (search%misses) growth = min(max(growth, LEAST_AFTER_MISS), real(most, dp)/real(cells, dp))
      call watch_clock(pressing, LONGER_EQUAL*growth, search)
      if (allocated(search%obstacle)) return
      if (growth < LEAST_GROWTH) then
        search%obstacle = 'more than '//text(most)//' cells are not allowed (most_cells)'
        return
      end if
      cells = min(most, quick_number(nint(growth*real(cells, dp))))
      next%mesh = equal_cells(search%left, search%right, cells)
      deallocate (next%gap)
      call solve_equal_cells(gap, pressing, next, trial)
      if (trial%status == FUGE_ERR_MEMORY) then
        search%obstacle = 'there is no memory for '//text(cells)//' cells'
        return
      end if
      info = trial
      if (info%failed()) return
    end do
  end subroutine refine_equal_cells

  !> Where are the contacts of the last level of equal cells, and how regular are the errors? `width_before` is that of
  !> the cells of the level before.
  subroutine judge_equal_cells(pressing, width_before, search)
    type(fuge_pressing), intent(in) :: pressing
    real(dp), intent(in) :: width_before
    type(line_search), intent(inout) :: search
    real(dp), allocatable :: now(:, :)

    allocate (now, source=contact_intervals(search%level%mesh, search%level%solution%force))
    search%edge_change = huge(1.0_dp)
    ! Ends are known to a part of a cell: what they moved tells more of the grid before.
    if (size(search%history%approach) > 0 .and. size(now, 2) == size(search%contacts, 2)) &
      search%edge_change = maxval([0.0_dp, abs(now - search%contacts)])*(search%level%mesh%width(1)/width_before)
    search%contacts = now
    search%misses = .not. is_resolved(search%level)
    search%history%law = SMOOTH
    associate (force => search%level%solution%force, is_free => pressing%boundary == FUGE_FREE)
      search%history%least_error = SAFETY_OF_ENDS*error_of_ends(force, .not. is_free)
      if (is_free .and. max(force(1), force(size(force))) > 0.0_dp) search%history%law = AT_RIM
    end associate
    if (has_features_in_contact(search)) search%history%law = AT_FEATURES
  end subroutine judge_equal_cells

  !> Does a level of equal cells that is to be the last one miss a contact? Errors: those of the gap function.
  subroutine look_at_last(gap, search, info)
    class(fuge_gap_function), intent(in) :: gap
    type(line_search), intent(inout) :: search
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: missed(:, :)

    if (search%misses .or. search%is_unloaded .or. size(search%level%mesh%x) > MOST_LOOKED_BETWEEN) return
    call missed_contacts(gap, search%level, .false., missed, info)
    if (.not. info%failed()) search%misses = size(missed, 2) > 0
  end subroutine look_at_last

  !> Note the last level; if it `follows` one of the same method, the level `before`, with the difference from that.
  subroutine add_level(search, before, follows)
    type(line_search), intent(inout) :: search
    type(line_level), intent(in) :: before
    logical, intent(in) :: follows
    real(dp) :: load, difference, growth

    difference = 0.0_dp
    growth = 1.0_dp
    associate (level => search%level, contacts => search%contacts)
      load = sum(level%solution%force)
      if (follows) growth = max(LEAST_GROWTH, real(size(level%mesh%x), dp)/real(size(before%mesh%x), dp))
      if (follows .and. load > 0.0_dp) difference = line_difference(borders(before%mesh), before%solution%force, &
                                                                    borders(level%mesh), level%solution%force)/load
      call search%history%add(size(level%mesh%x), level%method, growth, difference, level%solution%motion(1), &
                              maxval(level%solution%force/level%mesh%width), sum(contacts(2, :) - contacts(1, :)))
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
    logical :: is_end(size(level%gap) - 1)

    associate (touches => level%solution%force > 0.0_dp, n => size(level%gap))
      is_end = touches(2:) .neqv. touches(:n - 1)
      width = max(0.0_dp, maxval(level%mesh%width(2:), mask=is_end), maxval(level%mesh%width(:n - 1), mask=is_end))
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
