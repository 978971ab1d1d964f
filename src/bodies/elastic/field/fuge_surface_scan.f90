!> The largest stress at the surface of a half-space, at all places that its cells resolve.
!>
!> At the surface of a half-space sxx + syy = -(1 + 2 nu) p and szz = -p depend on the pressure p there, the rest of the
!> tensor on the pressure all around. All of von Mises and Tresca stress has the factor 1 - 2 nu, and beyond the cells
!> they are the modulus of an analytic function, so that they are largest beside the cells (A. E. H. Love, The stress
!> produced in a semi-infinite solid by pressure on part of the boundary, 1929).
module fuge_surface_scan
  use fuge_heap_sort, only: heap_sort
  use fuge_kinds, only: dp
  use fuge_peak_values, only: evaluate_measure
  use fuge_pressed_cells, only: pressed_cells
  use fuge_status, only: fuge_info, require_memory
  use fuge_stress_field, only: stress_field
  implicit none
  private

  public :: scan_surface

  !> Cells in one portion.
  integer, parameter :: PORTION = 2**12
  !> Places beside a cell, at most.
  integer, parameter :: NEIGHBOURS = 8
  !> A place lies beside a cell if its distance from it exceeds this fraction of the lesser width of the cell.
  real(dp), parameter :: BESIDE = 0.499_dp

  !> A place of the surface, its value, -1 for none, and the length of the cell there. A search may go on from it if the
  !> pressure is `continuous` there.
  type, public :: surface_place
    real(dp) :: place(3) = 0.0_dp, value = -1.0_dp, length = 0.0_dp
    logical :: continuous = .false.
  end type surface_place

contains

  !> The best of the middles of all cells, and the best place that lies as far from the edge of a cell beside it as its
  !> middle does. Under a continuous pressure all middles, from which a search may go on, and the best of the rim.
  !> Errors: those of the field, FUGE_ERR_MEMORY.
  subroutine scan_surface(field, cells, measure, found, info)
    class(stress_field), intent(inout) :: field
    type(pressed_cells), intent(in) :: cells
    integer, intent(in) :: measure
    type(surface_place), allocatable, intent(out) :: found(:)
    type(fuge_info), intent(inout) :: info
    type(surface_place), allocatable :: places(:)
    integer, allocatable :: order(:)
    integer :: first, k, last, number, stat

    number = size(cells%pressure)
    allocate (order(number), places(NEIGHBOURS*PORTION), found(merge(number, 1, cells%continuous) + 1), stat=stat)
    call require_memory(stat, 'places at the surface of', number, 'cells', info)
    if (stat /= 0) return
    order = [(k, k=1, number)]
    call heap_sort(cells%centre(1, :), order)
    do first = 1, size(order), PORTION
      last = min(first + PORTION - 1, size(order))
      call list_middles(cells, order(first:last), places, number)
      call evaluate(field, measure, places(:number), info)
      if (cells%continuous) then
        found(first:first + number - 1) = places(:number)
      else
        call take_best(places(:number), found(1))
        call list_neighbours(cells, order, first, last, places, number)
        call evaluate(field, measure, places(:number), info)
        call take_best(places(:number), found(2))
      end if
    end do
    if (.not. allocated(cells%rim)) return
    call list_rim(cells, places, number)
    call evaluate(field, measure, places(:number), info)
    call take_best(places(:number), found(size(found)))
  end subroutine scan_surface

  !> The middles of the cells `which`; of symmetric cells those on one side.
  pure subroutine list_middles(cells, which, places, number)
    type(pressed_cells), intent(in) :: cells
    integer, intent(in) :: which(:)
    type(surface_place), intent(inout) :: places(:)
    integer, intent(out) :: number
    integer :: k

    number = 0
    do k = 1, size(which)
      if (is_image(cells, cells%centre(:, which(k)))) cycle
      number = number + 1
      places(number) = surface_place(continuous=cells%continuous, length=cells%size_of(which(k)))
      places(number)%place(:cells%axes) = cells%centre(:, which(k))
    end do
  end subroutine list_middles

  !> The middles of equal cells around cells order(first) .. order(last) that no cell presses; `order` by the first
  !> axis.
  pure subroutine list_neighbours(cells, order, first, last, places, number)
    type(pressed_cells), intent(in) :: cells
    integer, intent(in) :: order(:), first, last
    type(surface_place), intent(inout) :: places(:)
    integer, intent(out) :: number
    real(dp) :: beside(cells%axes), reach, shift(2)
    integer :: k, low, high, n

    reach = maxval(cells%width(1, :))
    low = 1
    high = 0
    number = 0
    do k = first, last
      associate (centre => cells%centre(:, order(k)), width => cells%width(:, order(k)))
        call move_window(cells, order, centre(1) - width(1) - reach, centre(1) + width(1) + reach, low, high)
        do n = 0, 3**cells%axes - 1
          shift = real([modulo(n, 3), n/3] - 1, dp)
          beside = centre + width*shift(:cells%axes)
          if (is_image(cells, beside) .or. is_pressed(cells, order(low:high), beside)) cycle
          number = number + 1
          places(number) = surface_place(length=cells%size_of(order(k)))
          places(number)%place(:cells%axes) = beside
        end do
      end associate
    end do
  end subroutine list_neighbours

  !> The places of the rim.
  pure subroutine list_rim(cells, places, number)
    type(pressed_cells), intent(in) :: cells
    type(surface_place), intent(inout) :: places(:)
    integer, intent(out) :: number
    integer :: k

    number = size(cells%rim, 2)
    do k = 1, number
      places(k) = surface_place()
      places(k)%place(:cells%axes) = cells%rim(:, k)
    end do
  end subroutine list_rim

  !> Is the place on the side of a symmetric model that is searched by its mirror image?
  pure function is_image(cells, place)
    type(pressed_cells), intent(in) :: cells
    real(dp), intent(in) :: place(:)
    logical :: is_image

    is_image = any(cells%symmetric(:size(place)) .and. place < 0.0_dp)
  end function is_image

  !> Does a place lie in a cell, or too close to it?
  pure function is_pressed(cells, near, place) result(pressed)
    type(pressed_cells), intent(in) :: cells
    integer, intent(in) :: near(:)
    real(dp), intent(in) :: place(:)
    logical :: pressed
    integer :: k

    pressed = .true.
    do k = 1, size(near)
      associate (width => cells%width(:, near(k)))
        if (all(abs(place - cells%centre(:, near(k))) < 0.5_dp*width + BESIDE*minval(width))) return
      end associate
    end do
    pressed = .false.
  end function is_pressed

  !> The cells order(low:high) with their middles between two coordinates, which grow from call to call or nearly so.
  pure subroutine move_window(cells, order, from, to, low, high)
    type(pressed_cells), intent(in) :: cells
    integer, intent(in) :: order(:)
    real(dp), intent(in) :: from, to
    integer, intent(inout) :: low, high

    do while (low > 1)
      if (cells%centre(1, order(low - 1)) < from) exit
      low = low - 1
    end do
    do while (low < size(order))
      if (cells%centre(1, order(low)) >= from) exit
      low = low + 1
    end do
    high = max(high, low - 1)
    do while (high < size(order))
      if (cells%centre(1, order(high + 1)) > to) exit
      high = high + 1
    end do
    do while (high > low)
      if (cells%centre(1, order(high)) <= to) exit
      high = high - 1
    end do
  end subroutine move_window

  !> The values of some places.
  subroutine evaluate(field, measure, places, info)
    class(stress_field), intent(inout) :: field
    integer, intent(in) :: measure
    type(surface_place), intent(inout) :: places(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: place(:, :), value(:), normal(:)
    integer :: k, stat

    if (info%failed()) return
    allocate (place(3, size(places)), value(size(places)), normal(size(places)), stat=stat)
    call require_memory(stat, 'stresses at', size(places), 'places of the surface', info)
    if (stat /= 0) return
    do k = 1, size(places)
      place(:, k) = places(k)%place
    end do
    call evaluate_measure(field, measure, place, value, normal, info)
    if (.not. info%failed()) places%value = value
  end subroutine evaluate

  !> Replace `best` by the best of some places if that is better.
  pure subroutine take_best(places, best)
    type(surface_place), intent(in) :: places(:)
    type(surface_place), intent(inout) :: best
    integer :: k

    if (size(places) == 0) return
    k = maxloc(places%value, dim=1)
    if (places(k)%value > best%value) best = places(k)
  end subroutine take_best

end module fuge_surface_scan
