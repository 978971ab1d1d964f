!> Places from which the search for the largest stress starts.
!>
!> The pressed cells are halved again and again. Below the middle of every part lies a candidate, at a depth of the
!> order of the part: a maximum lies below what presses, at a fraction of its breadth. A part is not halved any more
!> once nothing below it can come near the best candidate. What its cells could add to the stress is the pressure that
!> the candidate does not see, the largest one of the cells minus the stress -zz, which is the pressure smoothed over a
!> breadth of the order of the depth (J. Boussinesq; K. L. Johnson, Contact Mechanics, 1985, sections 2.2 and 3.2).
module fuge_peak_starts
  use fuge_heap_sort, only: heap_sort
  use fuge_kinds, only: dp
  use fuge_peak_values, only: evaluate_measure
  use fuge_pressed_cells, only: pressed_cells
  use fuge_status, only: fuge_info, require_memory
  use fuge_stress_field, only: stress_field
  use fuge_surface_scan, only: scan_surface, surface_place
  implicit none
  private

  public :: find_starts

  !> Candidates below this fraction of the best value are not followed: those beside the largest stress have more.
  real(dp), parameter, public :: START_SHARE = 0.7_dp
  !> A part is not halved if the sum of its best value and of what its cells could add is below HALVED_SHARE of the best
  !> value. Uniform pressure on a patch adds up to UNSEEN_SHARE of itself, at the surface with a negative Poisson's
  !> ratio more, and as much again beside a patch that is pulled.
  real(dp), parameter :: HALVED_SHARE = 0.8_dp, UNSEEN_SHARE = 0.85_dp
  !> After FIRST_SURFACE candidates at the surface, more are tried only if the best of them has at least SURFACE_SHARE
  !> of the best value.
  integer, parameter :: FIRST_SURFACE = 64
  real(dp), parameter :: SURFACE_SHARE = 0.5_dp
  !> Depth of a candidate over the size of its part; below a single cell it is halved twice.
  real(dp), parameter :: DEPTH_RATIO = 1.4_dp
  !> Candidates of a part: DEPTHS below its middle, one at the surface, and those below the edges of a cell, where the
  !> pressure jumps.
  integer, parameter :: DEPTHS = 3, AT_SURFACE = DEPTHS + 1, CANDIDATES = AT_SURFACE + 4
  !> The greatest size of a part, in its breadths.
  real(dp), parameter :: LONGEST = 3.0_dp
  !> Two starts climb to the same maximum if their distance is below this fraction of the lesser length of them.
  real(dp), parameter :: NEARNESS = 0.75_dp
  !> Parts in one portion, and the number of starts at most.
  integer, parameter :: PORTION = 2**13, MOST_STARTS = 2000
  !> Starts from which the list is thinned out.
  integer, parameter :: LONG_LIST = 4*MOST_STARTS + CANDIDATES*PORTION

  !> A place from which to climb.
  type, public :: peak_start
    real(dp) :: place(3) = 0.0_dp, value = -1.0_dp
    !> A length over which the stress varies there, and the least depth to which the search may go.
    real(dp) :: length = 0.0_dp, least_depth = 0.0_dp
    !> Of uniform pressure at the surface only the middle of a cell counts.
    logical :: fixed = .false.
  end type peak_start

  !> Cells order(first) .. order(last) of the list of a search.
  type :: part
    integer :: first = 0, last = 0
    !> The cell whose middle at the surface has been tried already.
    integer :: tried = 0
  end type part

  !> The best value so far, the best one at the surface, and the number of candidates there.
  type :: tally
    real(dp) :: best = -1.0_dp, surface_best = -1.0_dp
    integer :: surface_count = 0
  end type tally

  !> Extent and pressure of a part.
  type :: survey
    real(dp) :: middle(2) = 0.0_dp, length = 0.0_dp, split_at = 0.0_dp, pressure = 0.0_dp
    integer :: split_axis = 0, strongest = 0
  end type survey

contains

  !> The candidates of a `field` above `START_SHARE` of the best one, best first, without those next to a better one.
  !> `cells` at least one. Errors: those of the field, FUGE_ERR_MEMORY.
  subroutine find_starts(field, cells, measure, starts, info)
    class(stress_field), intent(inout) :: field
    type(pressed_cells), intent(in) :: cells
    integer, intent(in) :: measure
    type(peak_start), allocatable, intent(out) :: starts(:)
    type(fuge_info), intent(inout) :: info
    type(peak_start), allocatable :: list(:)
    type(part), allocatable :: parts(:), halves(:)
    integer, allocatable :: order(:)
    type(tally) :: so_far
    integer :: count, first, k, last, number, number_next, stat

    number = size(cells%pressure)
    allocate (list(LONG_LIST), parts(number), halves(number), order(number), stat=stat)
    call require_memory(stat, 'the search below', number, 'cells', info)
    if (stat /= 0) return
    order = [(k, k=1, number)]
    parts(1)%first = 1
    parts(1)%last = number
    count = 0
    number = 1
    do while (number > 0)
      number_next = 0
      do first = 1, number, PORTION
        last = min(first + PORTION - 1, number)
        call try_parts(field, cells, measure, parts(first:last), order, list, count, so_far, halves, &
                       number_next, info)
        if (info%failed()) return
      end do
      number = number_next
      parts(:number) = halves(:number)
    end do
    if (cells%spreads .and. so_far%surface_best >= SURFACE_SHARE*so_far%best) &
      call add_surface(field, cells, measure, list, count, info)
    if (info%failed()) return
    call thin_out(list, count, info)
    if (info%failed()) return
    allocate (starts(count), stat=stat)
    call require_memory(stat, '', count, 'starts of the search', info)
    if (stat == 0) starts = list(:count)
  end subroutine find_starts

  !> Evaluate the candidates of `parts`, add the good ones to the `list`, and halve the parts that may hide better ones.
  !> Eleven arguments: the field, its cells, the parts, the list, what comes next.
  subroutine try_parts(field, cells, measure, parts, order, list, count, so_far, halves, number, info)
    class(stress_field), intent(inout) :: field
    type(pressed_cells), intent(in) :: cells
    integer, intent(in) :: measure
    type(part), intent(inout) :: parts(:)
    integer, intent(inout) :: order(:), count, number
    type(peak_start), intent(inout) :: list(:)
    type(tally), intent(inout) :: so_far
    type(part), intent(inout) :: halves(:)
    type(fuge_info), intent(inout) :: info
    type(survey), allocatable :: surveys(:)
    type(peak_start), allocatable :: tried(:, :)
    real(dp), allocatable :: normal(:, :)
    real(dp) :: seen, hidden_share
    integer :: c, p, stat

    hidden_share = UNSEEN_SHARE*max(1.0_dp, cells%surface_factor)
    if (minval(cells%pressure) < 0.0_dp .and. maxval(cells%pressure) > 0.0_dp) hidden_share = 2.0_dp*hidden_share
    allocate (surveys(size(parts)), tried(CANDIDATES, size(parts)), normal(CANDIDATES, size(parts)), stat=stat)
    call require_memory(stat, '', size(parts), 'parts of the search', info)
    if (stat /= 0) return
    do p = 1, size(parts)
      surveys(p) = survey_of(cells, order(parts(p)%first:parts(p)%last))
      tried(:, p) = candidates_of(cells, surveys(p), parts(p)%tried)
      parts(p)%tried = surveys(p)%strongest
      if (surface_is_weak(so_far)) tried(AT_SURFACE, p)%length = 0.0_dp
      if (tried(AT_SURFACE, p)%length > 0.0_dp) so_far%surface_count = so_far%surface_count + 1
    end do
    call evaluate_candidates(field, measure, tried, normal, info)
    if (info%failed()) return

    so_far%best = max(so_far%best, maxval(tried%value))
    so_far%surface_best = max(so_far%surface_best, maxval(tried(AT_SURFACE, :)%value))
    do p = 1, size(parts)
      do c = 1, CANDIDATES
        if (tried(c, p)%value < max(0.0_dp, START_SHARE*so_far%best)) cycle
        count = count + 1
        list(count) = tried(c, p)
      end do
      if (surveys(p)%split_axis == 0) cycle
      seen = maxval(tried(:, p)%value) + hidden_share*max(0.0_dp, surveys(p)%pressure - abs(normal(1, p)))
      if (seen >= HALVED_SHARE*so_far%best) call halve(cells, surveys(p), parts(p), order, halves, number)
    end do
    if (count > size(list) - CANDIDATES*PORTION) call thin_out(list, count, info)
  end subroutine try_parts

  !> Add the best places of the whole surface: pressure beside a cell may stress it more than its own does.
  subroutine add_surface(field, cells, measure, list, count, info)
    class(stress_field), intent(inout) :: field
    type(pressed_cells), intent(in) :: cells
    integer, intent(in) :: measure
    type(peak_start), intent(inout) :: list(:)
    integer, intent(inout) :: count
    type(fuge_info), intent(inout) :: info
    type(surface_place), allocatable :: best(:)
    integer :: k

    call scan_surface(field, cells, measure, best, info)
    call thin_out(list, count, info)
    if (info%failed()) return
    do k = 1, size(best)
      if (.not. best(k)%value > 0.0_dp) cycle
      if (count == size(list)) call thin_out(list, count, info)
      if (info%failed()) return
      count = count + 1
      list(count) = peak_start(best(k)%place, best(k)%value, best(k)%length, 0.0_dp, .not. best(k)%continuous)
    end do
  end subroutine add_surface

  pure function surface_is_weak(so_far)
    type(tally), intent(in) :: so_far
    logical :: surface_is_weak

    surface_is_weak = so_far%surface_count >= FIRST_SURFACE .and. so_far%surface_best < SURFACE_SHARE*so_far%best
  end function surface_is_weak

  !> The values of the candidates that have a length, and the stress zz there.
  subroutine evaluate_candidates(field, measure, tried, normal, info)
    class(stress_field), intent(inout) :: field
    integer, intent(in) :: measure
    type(peak_start), intent(inout) :: tried(:, :)
    real(dp), intent(out) :: normal(:, :)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: place(:, :), value(:), zz(:)
    integer :: c, p, stat, total

    normal = 0.0_dp
    total = count(tried%length > 0.0_dp)
    allocate (place(3, total), value(total), zz(total), stat=stat)
    call require_memory(stat, '', total, 'places of the search', info)
    if (stat /= 0) return
    total = 0
    do p = 1, size(tried, 2)
      do c = 1, CANDIDATES
        if (.not. tried(c, p)%length > 0.0_dp) cycle
        total = total + 1
        place(:, total) = tried(c, p)%place
      end do
    end do
    call evaluate_measure(field, measure, place, value, zz, info)
    total = 0
    do p = 1, size(tried, 2)
      do c = 1, CANDIDATES
        if (.not. tried(c, p)%length > 0.0_dp) cycle
        total = total + 1
        tried(c, p)%value = value(total)
        normal(c, p) = zz(total)
      end do
    end do
  end subroutine evaluate_candidates

  !> Extent and pressure of the cells `which`.
  pure function survey_of(cells, which) result(found)
    type(pressed_cells), intent(in) :: cells
    integer, intent(in) :: which(:)
    type(survey) :: found
    real(dp) :: bounds(4), extent(2), widest
    integer :: axis, k

    widest = 0.0_dp
    extent = 0.0_dp
    do axis = 1, cells%axes
      bounds = bounds_of(cells, which, axis)
      extent(axis) = bounds(2) - bounds(1)
      found%middle(axis) = bounds(1) + 0.5_dp*extent(axis)
      if (bounds(4) - bounds(3) <= widest) cycle
      widest = bounds(4) - bounds(3)
      found%split_axis = axis
      found%split_at = bounds(3) + 0.5_dp*widest
    end do
    if (cells%axes == 1) extent(2) = extent(1)
    found%length = min(sqrt(extent(1))*sqrt(extent(2)), LONGEST*minval(extent))
    found%strongest = which(1)
    do k = 2, size(which)
      if (abs(cells%pressure(which(k))) > abs(cells%pressure(found%strongest))) found%strongest = which(k)
    end do
    found%pressure = abs(cells%pressure(found%strongest))
  end function survey_of

  !> Along an axis: the least and the greatest coordinate of the cells, and of their middles.
  pure function bounds_of(cells, which, axis) result(bounds)
    type(pressed_cells), intent(in) :: cells
    integer, intent(in) :: which(:), axis
    real(dp) :: bounds(4)
    real(dp) :: centre, half
    integer :: k

    bounds = huge(bounds)*[1, -1, 1, -1]
    do k = 1, size(which)
      centre = cells%centre(axis, which(k))
      half = 0.5_dp*cells%width(axis, which(k))
      bounds = [min(bounds(1), centre - half), max(bounds(2), centre + half), min(bounds(3), centre), &
                max(bounds(4), centre)]
    end do
  end function bounds_of

  !> The candidates of a part, those without a `length` being left out: below its middle, for a single cell at three
  !> depths and below its edges, and the middle of its `strongest` cell at the surface unless that was `tried`.
  pure function candidates_of(cells, found, tried) result(list)
    type(pressed_cells), intent(in) :: cells
    type(survey), intent(in) :: found
    integer, intent(in) :: tried
    type(peak_start) :: list(CANDIDATES)
    integer :: c

    list%least_depth = cells%least_depth(found%strongest)
    do c = 1, merge(DEPTHS, 1, found%split_axis == 0)
      list(c)%length = found%length*DEPTH_RATIO*0.5_dp**(c - 1)
      list(c)%place(:2) = found%middle
      list(c)%place(3) = max(list(c)%least_depth, list(c)%length)
    end do
    if (found%split_axis == 0 .and. .not. cells%continuous) &
      list(AT_SURFACE + 1:AT_SURFACE + 2*cells%axes) = edges_of(cells, found%strongest)
    if (found%strongest == tried) return
    list(AT_SURFACE)%length = cells%size_of(found%strongest)
    list(AT_SURFACE)%place(:cells%axes) = cells%centre(:, found%strongest)
    list(AT_SURFACE)%fixed = .not. cells%continuous
  end function candidates_of

  !> The candidates below the middles of the edges of cell `k`, at the least depth.
  pure function edges_of(cells, k) result(list)
    type(pressed_cells), intent(in) :: cells
    integer, intent(in) :: k
    type(peak_start) :: list(2*cells%axes)
    integer :: axis, c

    list%least_depth = cells%least_depth(k)
    list%length = cells%least_depth(k)
    do c = 1, size(list)
      axis = (c + 1)/2
      list(c)%place(:cells%axes) = cells%centre(:, k)
      list(c)%place(axis) = cells%centre(axis, k) + merge(-0.5_dp, 0.5_dp, mod(c, 2) == 1)*cells%width(axis, k)
      list(c)%place(3) = cells%least_depth(k)
    end do
  end function edges_of

  !> Put the cells beyond the middle of their extent last, and add both halves to the list, without the one that is the
  !> mirror image of cells elsewhere.
  pure subroutine halve(cells, found, whole, order, halves, number)
    type(pressed_cells), intent(in) :: cells
    type(survey), intent(in) :: found
    type(part), intent(in) :: whole
    integer, intent(inout) :: order(:)
    type(part), intent(inout) :: halves(:)
    integer, intent(inout) :: number
    integer :: k, moved, next

    next = whole%first
    do k = whole%first, whole%last
      if (cells%centre(found%split_axis, order(k)) > found%split_at) cycle
      moved = order(next)
      order(next) = order(k)
      order(k) = moved
      next = next + 1
    end do
    if (next == whole%first .or. next > whole%last) return
    number = number + 1
    halves(number) = part(next, whole%last, whole%tried)
    if (cells%symmetric(found%split_axis) &
        .and. all(cells%centre(found%split_axis, order(whole%first:next - 1)) < 0.0_dp)) return
    number = number + 1
    halves(number) = part(whole%first, next - 1, whole%tried)
  end subroutine halve

  !> Keep the best starts, best first, without those next to a better one, and only the best of those that stay where
  !> they are: at most MOST_STARTS. FUGE_ERR_MEMORY.
  pure subroutine thin_out(list, count, info)
    type(peak_start), intent(inout) :: list(:)
    integer, intent(inout) :: count
    type(fuge_info), intent(inout) :: info
    type(peak_start), allocatable :: kept(:)
    integer, allocatable :: order(:)
    real(dp) :: best
    logical :: any_fixed
    integer :: k, number, stat

    if (count == 0) return
    best = maxval(list(:count)%value)
    allocate (order(count), kept(MOST_STARTS), stat=stat)
    call require_memory(stat, 'the order of', count, 'candidates of the search', info)
    if (stat /= 0) return
    order = [(k, k=1, count)]
    call heap_sort(-list(:count)%value, order)
    number = 0
    any_fixed = .false.
    do k = 1, count
      if (number == MOST_STARTS) exit
      if (list(order(k))%value < START_SHARE*best) exit
      if (list(order(k))%fixed .and. any_fixed) cycle
      if (is_next_to_one(list(order(k)), kept(:number))) cycle
      any_fixed = any_fixed .or. list(order(k))%fixed
      number = number + 1
      kept(number) = list(order(k))
    end do
    list(:number) = kept(:number)
    count = number
  end subroutine thin_out

  pure function is_next_to_one(start, kept)
    type(peak_start), intent(in) :: start, kept(:)
    logical :: is_next_to_one
    integer :: k

    is_next_to_one = .true.
    do k = 1, size(kept)
      if (kept(k)%fixed .or. start%fixed) cycle
      if (maxval(abs(start%place - kept(k)%place)) < NEARNESS*min(start%length, kept(k)%length)) return
    end do
    is_next_to_one = .false.
  end function is_next_to_one

end module fuge_peak_starts
