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
  implicit none
  private

  public :: find_starts

  !> Candidates below this fraction of the best value are not followed: those beside the largest stress have more.
  real(dp), parameter :: START_SHARE = 0.7_dp
  !> A part is not halved if the sum of its best value and of what its cells could add is below HALVED_SHARE of the best
  !> value. Uniform pressure on a patch adds up to UNSEEN_SHARE of itself, at the surface with a negative Poisson's
  !> ratio more, and as much again beside a patch that is pulled.
  real(dp), parameter :: HALVED_SHARE = 0.8_dp, UNSEEN_SHARE = 0.85_dp
  !> Depth of a candidate over the size of its part; below a single cell it is halved twice.
  real(dp), parameter :: DEPTH_RATIO = 1.4_dp
  integer, parameter :: DEPTHS = 3
  !> The greatest size of a part, in its breadths.
  real(dp), parameter :: LONGEST = 3.0_dp
  !> Two starts climb to the same maximum if their distance is below this fraction of the lesser length of them.
  real(dp), parameter :: NEARNESS = 0.75_dp
  !> The number of starts at most.
  integer, parameter :: MOST_STARTS = 1000

  !> A place from which to climb.
  type, public :: peak_start
    real(dp) :: place(3) = 0.0_dp, value = -1.0_dp
    !> A length over which the stress varies there, and the least depth to which the search may go.
    real(dp) :: length = 0.0_dp, least_depth = 0.0_dp
    !> Of uniform pressure at the surface only the middle of a cell counts.
    logical :: fixed = .false.
  end type peak_start

  !> Cells order(first) .. order(last) of the list of a search: the middle of them, a length, where to halve them along
  !> which axis (0: a single cell), and the cell with the largest pressure.
  type :: part
    integer :: first = 0, last = 0
    real(dp) :: middle(2) = 0.0_dp, length = 0.0_dp, split_at = 0.0_dp
    integer :: split_axis = 0, strongest = 0
    !> The number of its candidates, their best value and the stress zz at the first one.
    integer :: candidates = 0
    real(dp) :: best = -1.0_dp, normal = 0.0_dp
  end type part

contains

  !> The candidates of a `field` above `START_SHARE` of the best one, best first, without those next to a better one.
  !> `cells` at least one. Errors: those of the field, FUGE_ERR_MEMORY.
  subroutine find_starts(field, cells, measure, starts, info)
    class(stress_field), intent(in) :: field
    type(pressed_cells), intent(in) :: cells
    integer, intent(in) :: measure
    type(peak_start), allocatable, intent(out) :: starts(:)
    type(fuge_info), intent(inout) :: info
    type(part), allocatable :: parts(:)
    type(peak_start), allocatable :: tried(:)
    integer, allocatable :: order(:)
    integer :: k, stat

    allocate (starts(0), parts(1), order(size(cells%pressure)), stat=stat)
    call require_memory(stat, 'the search below', size(cells%pressure), 'cells', info)
    if (stat /= 0) return
    order = [(k, k=1, size(order))]
    parts(1)%first = 1
    parts(1)%last = size(order)
    call list_surface(cells, tried, info)
    call add_candidates(field, cells, measure, tried, starts, info)
    ! Without a climb the best one is enough.
    if (.not. cells%continuous .and. size(starts) > 1) starts = [starts(maxloc(starts%value, dim=1))]
    do while (size(parts) > 0)
      call list_candidates(cells, order, parts, tried, info)
      call add_candidates(field, cells, measure, tried, starts, info, parts)
      if (info%failed()) return
      call halve_parts(cells, maxval(starts%value), order, parts, info)
    end do
    call thin_out(starts, info)
  end subroutine find_starts

  !> At the surface: the middle of the cell with the largest pressure, and what the cells name. FUGE_ERR_MEMORY.
  pure subroutine list_surface(cells, tried, info)
    type(pressed_cells), intent(in) :: cells
    type(peak_start), allocatable, intent(out) :: tried(:)
    type(fuge_info), intent(inout) :: info
    integer :: k, number, stat

    number = 0
    if (allocated(cells%surface)) number = size(cells%surface, 2)
    allocate (tried(number + 1), stat=stat)
    call require_memory(stat, '', number, 'places of the surface', info)
    if (stat /= 0) return
    k = maxloc(abs(cells%pressure), dim=1)
    tried%length = cells%size_of(k)
    tried%fixed = .not. cells%continuous
    tried(number + 1)%place(:cells%axes) = cells%centre(:, k)
    do k = 1, number
      tried(k)%place(:cells%axes) = cells%surface(:, k)
    end do
  end subroutine list_surface

  !> The candidates of the parts, one part after another. FUGE_ERR_MEMORY.
  pure subroutine list_candidates(cells, order, parts, tried, info)
    type(pressed_cells), intent(in) :: cells
    integer, intent(in) :: order(:)
    type(part), intent(inout) :: parts(:)
    type(peak_start), allocatable, intent(out) :: tried(:)
    type(fuge_info), intent(inout) :: info
    integer :: number, p, stat

    do p = 1, size(parts)
      call survey(cells, order(parts(p)%first:parts(p)%last), parts(p))
    end do
    allocate (tried(sum(parts%candidates)), stat=stat)
    call require_memory(stat, '', size(parts), 'parts of the search', info)
    if (stat /= 0) return
    number = 0
    do p = 1, size(parts)
      call place_candidates(cells, parts(p), tried(number + 1:number + parts(p)%candidates))
      number = number + parts(p)%candidates
    end do
  end subroutine list_candidates

  !> Extent and pressure of the cells `which`.
  pure subroutine survey(cells, which, found)
    type(pressed_cells), intent(in) :: cells
    integer, intent(in) :: which(:)
    type(part), intent(inout) :: found
    real(dp) :: low, high, extent(2), widest
    integer :: axis

    widest = 0.0_dp
    extent = 0.0_dp
    found%split_axis = 0
    do axis = 1, cells%axes
      associate (centre => cells%centre(axis, which), width => cells%width(axis, which))
        low = minval(centre - 0.5_dp*width)
        extent(axis) = maxval(centre + 0.5_dp*width) - low
        found%middle(axis) = low + 0.5_dp*extent(axis)
        low = minval(centre)
        high = maxval(centre)
      end associate
      if (high - low <= widest) cycle
      widest = high - low
      found%split_axis = axis
      found%split_at = low + 0.5_dp*widest
    end do
    if (cells%axes == 1) extent(2) = extent(1)
    found%length = min(sqrt(extent(1))*sqrt(extent(2)), LONGEST*minval(extent))
    found%strongest = which(maxloc(abs(cells%pressure(which)), dim=1))
    found%candidates = 1
    if (found%split_axis == 0) found%candidates = DEPTHS + merge(0, 2*cells%axes, cells%continuous)
  end subroutine survey

  !> Below the middle of a part; of a single cell at several depths, and where the pressure jumps below the middles of
  !> its edges, at the least depth.
  pure subroutine place_candidates(cells, found, list)
    type(pressed_cells), intent(in) :: cells
    type(part), intent(in) :: found
    type(peak_start), intent(inout) :: list(:)
    integer :: axis, c

    list%least_depth = cells%least_depth(found%strongest)
    do c = 1, size(list)
      list(c)%place(:2) = found%middle
      if (c <= DEPTHS) then
        list(c)%length = found%length*DEPTH_RATIO*0.5_dp**(c - 1)
        list(c)%place(3) = max(list(c)%least_depth, list(c)%length)
      else
        axis = (c - DEPTHS + 1)/2
        list(c)%length = list(c)%least_depth
        list(c)%place(axis) = found%middle(axis) + merge(-0.5_dp, 0.5_dp, mod(c, 2) == 0) &
                              *cells%width(axis, found%strongest)
        list(c)%place(3) = list(c)%least_depth
      end if
    end do
  end subroutine place_candidates

  !> Find the values of candidates, those of `parts` if they are given, and add the good ones to the starts.
  subroutine add_candidates(field, cells, measure, tried, starts, info, parts)
    class(stress_field), intent(in) :: field
    type(pressed_cells), intent(in) :: cells
    integer, intent(in) :: measure
    type(peak_start), intent(inout) :: tried(:)
    type(peak_start), allocatable, intent(inout) :: starts(:)
    type(fuge_info), intent(inout) :: info
    type(part), intent(inout), optional :: parts(:)
    real(dp), allocatable :: place(:, :), value(:), normal(:)
    real(dp) :: best
    integer :: k, number, stat

    if (info%failed()) return
    allocate (place(3, size(tried)), value(size(tried)), normal(size(tried)), stat=stat)
    call require_memory(stat, '', size(tried), 'places of the search', info)
    if (stat /= 0) return
    do k = 1, size(tried)
      place(:, k) = tried(k)%place
    end do
    call evaluate_measure(field, cells, measure, place, value, normal, info)
    if (info%failed()) return
    tried%value = value
    if (present(parts)) then
      number = 0
      do k = 1, size(parts)
        parts(k)%normal = normal(number + 1)
        parts(k)%best = maxval(value(number + 1:number + parts(k)%candidates))
        number = number + parts(k)%candidates
      end do
    end if
    best = max(maxval(value), maxval(starts%value))
    starts = [pack(starts, starts%value >= START_SHARE*best), pack(tried, value >= START_SHARE*best)]
  end subroutine add_candidates

  !> The halves of the parts below which there may be more than the `best` value. FUGE_ERR_MEMORY.
  pure subroutine halve_parts(cells, best, order, parts, info)
    type(pressed_cells), intent(in) :: cells
    real(dp), intent(in) :: best
    integer, intent(inout) :: order(:)
    type(part), allocatable, intent(inout) :: parts(:)
    type(fuge_info), intent(inout) :: info
    type(part), allocatable :: halves(:)
    real(dp) :: hidden_share
    integer :: middle, number, p, stat

    allocate (halves(2*size(parts)), stat=stat)
    call require_memory(stat, '', size(parts), 'parts of the search', info)
    if (stat /= 0) return
    hidden_share = UNSEEN_SHARE*max(1.0_dp, cells%surface_factor)
    if (minval(cells%pressure) < 0.0_dp .and. maxval(cells%pressure) > 0.0_dp) hidden_share = 2.0_dp*hidden_share
    number = 0
    do p = 1, size(parts)
      if (parts(p)%split_axis == 0) cycle
      if (parts(p)%best + hidden_share*max(0.0_dp, abs(cells%pressure(parts(p)%strongest)) - abs(parts(p)%normal)) &
          < HALVED_SHARE*best) cycle
      call divide(cells, parts(p), order(parts(p)%first:parts(p)%last), middle)
      middle = parts(p)%first + middle - 1
      if (middle < parts(p)%first .or. middle >= parts(p)%last) cycle
      number = number + 1
      halves(number) = part(first=middle + 1, last=parts(p)%last)
      ! The other one may be the mirror image of cells elsewhere.
      if (cells%symmetric(parts(p)%split_axis) &
          .and. all(cells%centre(parts(p)%split_axis, order(parts(p)%first:middle)) < 0.0_dp)) cycle
      number = number + 1
      halves(number) = part(first=parts(p)%first, last=middle)
    end do
    parts = halves(:number)
  end subroutine halve_parts

  !> Put the cells beyond the middle of their extent last in the list `order`, after `middle` others.
  pure subroutine divide(cells, whole, order, middle)
    type(pressed_cells), intent(in) :: cells
    type(part), intent(in) :: whole
    integer, intent(inout) :: order(:)
    integer, intent(out) :: middle
    integer :: k, moved

    middle = 0
    do k = 1, size(order)
      if (cells%centre(whole%split_axis, order(k)) > whole%split_at) cycle
      middle = middle + 1
      moved = order(middle)
      order(middle) = order(k)
      order(k) = moved
    end do
  end subroutine divide

  !> Keep the best starts, best first, without those next to a better one: at most MOST_STARTS. FUGE_ERR_MEMORY.
  pure subroutine thin_out(starts, info)
    type(peak_start), allocatable, intent(inout) :: starts(:)
    type(fuge_info), intent(inout) :: info
    type(peak_start), allocatable :: kept(:)
    integer, allocatable :: order(:)
    integer :: k, number, stat

    allocate (order(size(starts)), kept(min(size(starts), MOST_STARTS)), stat=stat)
    call require_memory(stat, 'the order of', size(starts), 'candidates of the search', info)
    if (stat /= 0) return
    order = [(k, k=1, size(starts))]
    call heap_sort(-starts%value, order)
    number = 0
    do k = 1, size(starts)
      if (number == size(kept) .or. starts(order(k))%value < 0.0_dp) exit
      if (is_next_to_one(starts(order(k)), kept(:number))) cycle
      number = number + 1
      kept(number) = starts(order(k))
    end do
    starts = kept(:number)
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
