!> The largest stress in a body of layers below the cells of a grid.
!>
!> At each depth all cells are seen at once, so the search is one along the depth. Stresses vary there over lengths of
!> the order of the depth, because all that gives rise to them lies at the surface or beyond the next interface: depths
!> at equal ratios miss no maximum. Each that may be the largest one is then found by parabolas and the golden section.
module fuge_layered_peak_search
  use fuge_kinds, only: dp
  use fuge_layer_interior, only: is_upper_half
  use fuge_layered_body_type, only: fuge_layered_body
  use fuge_peak_values, only: measure_all
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_CALL_ORDER, FUGE_ERR_OVERFLOW
  use fuge_stress_peak_type, only: check_measure
  implicit none
  private

  public :: fuge_layered_halfplane_peak, fuge_layered_halfspace_peak

  !> The ratio of depths; the first one below the surface, in the lesser width of a cell, as in the half-space; the last
  !> one in the substrate, in the extent of the cells with a force.
  real(dp), parameter :: RATIO = 1.3_dp, FIRST_DEPTH = 0.25_dp, LAST_DEPTH = 2.0_dp
  !> A maximum among fewer than three depths may hide one that is larger by so much.
  real(dp), parameter :: HIDDEN = 0.05_dp
  !> A relative gain below this counts as none.
  real(dp), parameter :: SAME = 1.0e-10_dp
  !> Depths that are found at a time, and steps of the search for a maximum between two of them.
  integer, parameter :: PORTION = 4, STEPS = 40
  !> A maximum lies within this fraction of its depth: the value is known to the square of it.
  real(dp), parameter :: DEPTH_TOLERANCE = 1.0e-5_dp
  real(dp), parameter :: GOLDEN = 0.3819660112501051_dp

  !> A largest stress. Without forces value, depth and tensor are 0.
  type, public :: fuge_layer_peak
    !> The von Mises or Tresca stress; force per length squared.
    real(dp) :: value = 0.0_dp
    !> Where it lies, length.
    real(dp) :: depth = 0.0_dp
    !> 1 is the top layer, the last number the substrate; layers that are bonded to the same material are one with it.
    integer :: layer = 1
    !> The cell above it.
    integer :: cell = 1
    !> The stresses there, xx, yy, zz, yz, xz, xy.
    real(dp) :: tensor(6) = 0.0_dp
  end type fuge_layer_peak

contains

  !> The largest von Mises or Tresca stress in a body of layers below the centres of a grid of rectangles.
  !>
  !> `body`, `nx`, `ny`, `spacing_x`, `spacing_y`, `force` and `boundary` as for `fuge_layered_halfspace_stress_grid`;
  !> `measure` FUGE_MEASURE_VON_MISES or FUGE_MEASURE_TRESCA. Out: `peak`, the largest value below the centres of the
  !> cells: in all layers, on both sides of each interface, at the surface, and at all depths from a quarter of the
  !> smaller cell width on. Its relative error is at most 1e-9, or 1e-4 where the cell of the largest value changes at
  !> that depth. The stress between the centres of cells may be larger by an error of the order of a cell. At the edge
  !> of a flat punch, where the exact stress is infinite, the value depends on the grid.
  !>
  !> Ten arguments: the grid alone has four. Errors, `peak` untouched: those of `fuge_layered_halfspace_stress_grid`;
  !> FUGE_ERR_OPTION for `measure`; FUGE_ERR_OVERFLOW if no stress is finite.
  subroutine fuge_layered_halfspace_peak(body, nx, ny, spacing_x, spacing_y, force, boundary, measure, peak, info)
    use fuge_layered_grid, only: layered_grid
    type(fuge_layered_body), intent(in) :: body
    integer, intent(in) :: nx, ny, boundary, measure
    real(dp), intent(in) :: spacing_x, spacing_y, force(:)
    type(fuge_layer_peak), intent(inout) :: peak
    type(fuge_info), intent(out) :: info
    type(layered_grid) :: grid

    grid%cells = [nx, ny]
    grid%spacing = [spacing_x, spacing_y]
    grid%boundary = boundary
    call search(grid, body, force, measure, peak, info)
  end subroutine fuge_layered_halfspace_peak

  !> The largest von Mises or Tresca stress in a body of layers in plane strain, below the centres of equal cells.
  !>
  !> `body`, `spacing`, `force`, `element` and `boundary` as for `fuge_layered_halfplane_stress_grid`; `measure`, `peak`
  !> and errors as for `fuge_layered_halfspace_peak`.
  subroutine fuge_layered_halfplane_peak(body, spacing, force, element, boundary, measure, peak, info)
    use fuge_layered_grid, only: layered_grid
    type(fuge_layered_body), intent(in) :: body
    real(dp), intent(in) :: spacing, force(:)
    integer, intent(in) :: element, boundary, measure
    type(fuge_layer_peak), intent(inout) :: peak
    type(fuge_info), intent(out) :: info
    type(layered_grid) :: grid

    grid%is_line = .true.
    grid%cells = [size(force), 1]
    grid%spacing = spacing
    grid%element = element
    grid%boundary = boundary
    call search(grid, body, force, measure, peak, info)
  end subroutine fuge_layered_halfplane_peak

  subroutine search(grid, body, force, measure, peak, info)
    use fuge_layered_grid, only: layered_grid
    type(layered_grid), intent(inout) :: grid
    type(fuge_layered_body), intent(in) :: body
    real(dp), intent(in) :: force(:)
    integer, intent(in) :: measure
    type(fuge_layer_peak), intent(inout) :: peak
    type(fuge_info), intent(inout) :: info
    type(fuge_layer_peak), allocatable :: at(:)
    type(fuge_layer_peak) :: best
    real(dp), allocatable :: tensor(:, :, :)
    integer :: k, number, stat

    call check_measure(measure, info)
    if (info%failed()) return
    if (.not. body%is_set()) then
      call report(info, FUGE_ERR_CALL_ORDER, 'body: no layers are set')
      return
    end if
    call grid%press(body, force, info)
    if (info%failed()) return
    allocate (tensor(6, size(force), 1), at(0), stat=stat)
    call require_memory(stat, 'stresses at', size(force), 'cells', info)
    if (stat /= 0) return
    ! What is no grid is refused.
    call grid%tensors(body, [0.0_dp], [.false.], tensor, info)
    if (info%failed()) return
    best = fuge_layer_peak()
    if (any(abs(force) > 0.0_dp)) then
      call list_depths(grid, at, number)
      deallocate (at)
      allocate (at(number), stat=stat)
      call require_memory(stat, 'the search at', number, 'depths', info)
      if (stat /= 0) return
      call list_depths(grid, at, number)
      call evaluate(grid, body, measure, at, info)
      if (info%failed()) return
      best = at(maxloc(at%value, dim=1))
      do k = 1, size(at)
        call refine(grid, body, measure, at, k, best, info)
      end do
      if (.not. info%failed() .and. best%value < 0.0_dp) call report(info, FUGE_ERR_OVERFLOW, &
                                           'no stress is in range: choose another unit of force')
    end if
    if (.not. info%failed()) peak = best
  end subroutine search

  !> The depths of all layers, both sides of each interface included, from the surface down; `number` of them, as many
  !> as there is room for in `at`.
  pure subroutine list_depths(grid, at, number)
    use fuge_layered_grid, only: layered_grid
    type(layered_grid), intent(in) :: grid
    type(fuge_layer_peak), intent(inout) :: at(:)
    integer, intent(out) :: number
    real(dp) :: bottom, top
    integer :: count, k, layers

    layers = size(grid%stack%shear)
    if (grid%stack%is_rigid()) layers = layers - 1
    number = 0
    do k = 1, layers
      top = sum(grid%stack%thickness(:k - 1))
      bottom = sum(grid%stack%thickness(:min(k, size(grid%stack%thickness))))
      if (k > size(grid%stack%thickness)) bottom = top + LAST_DEPTH*extent_of(grid)
      count = number_of_depths(grid, top, bottom)
      if (number + count <= size(at)) then
        call place_depths(grid, top, bottom, at(number + 1:number + count))
        at(number + 1:number + count)%layer = k
      end if
      number = number + count
    end do
  end subroutine list_depths

  !> The greatest extent of the cells with a force.
  pure function extent_of(grid) result(extent)
    use fuge_layered_grid, only: layered_grid
    type(layered_grid), intent(in) :: grid
    real(dp) :: extent
    integer :: high(2), k, low(2), place(2)

    low = huge(low)
    high = 0
    do k = 1, size(grid%force)
      if (.not. abs(grid%force(k)) > 0.0_dp) cycle
      place = [modulo(k - 1, grid%cells(1)), (k - 1)/grid%cells(1)]
      low = min(low, place)
      high = max(high, place)
    end do
    extent = maxval((high - low + 1)*grid%spacing)
  end function extent_of

  !> How many depths are tried between the sides of a layer, these included: at least three, but none between the
  !> surface and the first depth.
  pure function number_of_depths(grid, top, bottom) result(count)
    use fuge_layered_grid, only: layered_grid
    type(layered_grid), intent(in) :: grid
    real(dp), intent(in) :: top, bottom
    integer :: count
    real(dp) :: first

    first = shallowest(grid)
    count = 3
    if (top >= first) then
      count = max(3, 2 + int(log(bottom/top)/log(RATIO)))
    else if (bottom > first) then
      count = 3 + int(log(bottom/first)/log(RATIO))
    else if (.not. top > 0.0_dp) then
      count = 2
    end if
  end function number_of_depths

  !> Place them: at equal ratios from the first depth on.
  pure subroutine place_depths(grid, top, bottom, at)
    use fuge_layered_grid, only: layered_grid
    type(layered_grid), intent(in) :: grid
    real(dp), intent(in) :: top, bottom
    type(fuge_layer_peak), intent(inout) :: at(:)
    real(dp) :: first
    integer :: k, start

    first = max(top, shallowest(grid))
    start = merge(1, 2, top >= first)
    ! A layer above the first depth has one in its middle.
    if (bottom <= first) first = 0.5_dp*(top + bottom)
    at(1)%depth = top
    do k = 2, size(at) - 1
      at(k)%depth = first*(bottom/first)**(real(k - start, dp)/real(size(at) - start, dp))
    end do
    at(size(at))%depth = bottom
  end subroutine place_depths

  !> The first depth below the surface.
  pure function shallowest(grid) result(depth)
    use fuge_layered_grid, only: layered_grid
    type(layered_grid), intent(in) :: grid
    real(dp) :: depth

    depth = FIRST_DEPTH*minval(grid%spacing)
  end function shallowest

  !> Find the largest values at the depths, in their layers; -1 where none is finite.
  subroutine evaluate(grid, body, measure, at, info)
    use fuge_layered_grid, only: layered_grid
    type(layered_grid), intent(in) :: grid
    type(fuge_layered_body), intent(in) :: body
    integer, intent(in) :: measure
    type(fuge_layer_peak), intent(inout) :: at(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: normal(:), tensor(:, :, :), value(:)
    logical, allocatable :: below(:)
    integer :: first, k, last, stat

    allocate (tensor(6, size(grid%force), min(PORTION, size(at))), value(size(grid%force)), normal(size(grid%force)), &
              below(size(at)), stat=stat)
    call require_memory(stat, 'stresses at', size(grid%force), 'cells', info)
    if (info%failed()) return
    do k = 1, size(at)
      below(k) = is_upper_half(grid%stack, at(k)%layer, at(k)%depth)
    end do
    do first = 1, size(at), PORTION
      last = min(first + PORTION - 1, size(at))
      call grid%tensors(body, at(first:last)%depth, below(first:last), tensor(:, :, :last - first + 1), info)
      if (info%failed()) return
      do k = first, last
        call measure_all(measure, tensor(:, :, k - first + 1), value, normal)
        at(k)%cell = maxloc(value, dim=1)
        at(k)%value = value(at(k)%cell)
        at(k)%tensor = tensor(:, at(k)%cell, k - first + 1)
      end do
    end do
  end subroutine evaluate

  !> Search between the neighbours of depth `k` if it is a maximum that may be larger than the `best`.
  subroutine refine(grid, body, measure, at, k, best, info)
    use fuge_layered_grid, only: layered_grid
    type(layered_grid), intent(in) :: grid
    type(fuge_layered_body), intent(in) :: body
    integer, intent(in) :: measure, k
    type(fuge_layer_peak), intent(in) :: at(:)
    type(fuge_layer_peak), intent(inout) :: best
    type(fuge_info), intent(inout) :: info
    integer :: first, last, window(2)

    ! Between the surface and the next depth the cells resolve nothing.
    if (info%failed() .or. .not. at(k)%depth > 0.0_dp) return
    window = depths_around(at, k)
    first = max(window(1), k - 1)
    last = min(window(2), k + 1)
    if (any(at(first:last)%value > at(k)%value)) return
    if (upper_estimate(at(window(1):window(2)), at(k)%value) > (1.0_dp + SAME)*best%value) &
      call maximise(grid, body, measure, at(first)%depth, at(last)%depth, at(k), best, info)
  end subroutine refine

  !> The first and the last of three depths of the layer of depth `k`, that one in the middle if it is not at a side of
  !> the layer; of fewer if it has no more.
  pure function depths_around(at, k) result(window)
    type(fuge_layer_peak), intent(in) :: at(:)
    integer, intent(in) :: k
    integer :: window(2)

    window = k
    if (is_beside(k - 1)) window(1) = k - 1
    if (is_beside(k + 1)) window(2) = k + 1
    if (window(2) - window(1) == 2) return
    if (is_beside(window(1) - 1)) then
      window(1) = window(1) - 1
    else if (is_beside(window(2) + 1)) then
      window(2) = window(2) + 1
    end if

  contains

    pure function is_beside(j)
      integer, intent(in) :: j
      logical :: is_beside

      is_beside = j >= 1 .and. j <= size(at)
      if (is_beside) is_beside = at(j)%layer == at(k)%layer .and. at(j)%depth > 0.0_dp
    end function is_beside

  end function depths_around

  !> Upper estimate of the maximum between these depths, whose largest known value is `value`: the vertex of the
  !> parabola through three of them, with its excess over `value` doubled.
  pure function upper_estimate(at, value)
    type(fuge_layer_peak), intent(in) :: at(:)
    real(dp), intent(in) :: value
    real(dp) :: upper_estimate
    real(dp) :: half_curvature, slope(2), x(3)

    upper_estimate = (1.0_dp + HIDDEN)*value
    if (size(at) < 3) return
    x = at%depth
    slope = (at(2:)%value - at(:2)%value)/(x(2:) - x(:2))
    half_curvature = (slope(2) - slope(1))/(x(3) - x(1))
    upper_estimate = value
    if (.not. half_curvature < 0.0_dp) return
    ! The slope at the first depth, at the last one, and the height of the vertex above the second one.
    if (slope(1) - half_curvature*(x(2) - x(1)) <= 0.0_dp .or. slope(2) + half_curvature*(x(3) - x(2)) >= 0.0_dp) return
    upper_estimate = value + 2.0_dp*max(0.0_dp, at(2)%value - value &
                                         - 0.25_dp*(slope(1) + half_curvature*(x(2) - x(1)))**2/half_curvature)
  end function upper_estimate

  !> The maximum between the depths `upper` and `lower` by R. P. Brent's method (Algorithms for Minimization without
  !> Derivatives, 1973, chapter 5), from `start` between them.
  subroutine maximise(grid, body, measure, upper, lower, start, best, info)
    use fuge_layered_grid, only: layered_grid
    type(layered_grid), intent(in) :: grid
    type(fuge_layered_body), intent(in) :: body
    integer, intent(in) :: measure
    real(dp), intent(in) :: upper, lower
    type(fuge_layer_peak), intent(in) :: start
    type(fuge_layer_peak), intent(inout) :: best
    type(fuge_info), intent(inout) :: info
    type(fuge_layer_peak) :: point(3), tried(1)
    real(dp) :: before, high, low, middle, step, tolerance
    integer :: k

    low = upper
    high = lower
    ! The best point, the second one, and that before.
    point = start
    step = 0.0_dp
    before = 0.0_dp
    do k = 1, STEPS
      middle = 0.5_dp*(low + high)
      tolerance = DEPTH_TOLERANCE*point(1)%depth
      if (abs(point(1)%depth - middle) <= 2.0_dp*tolerance - 0.5_dp*(high - low)) exit
      call choose_step(point%depth, point%value, low, high, tolerance, step, before)
      tried(1) = point(1)
      tried(1)%depth = point(1)%depth + sign(max(abs(step), tolerance), step)
      call evaluate(grid, body, measure, tried, info)
      if (info%failed()) return
      if (tried(1)%value >= point(1)%value) then
        if (tried(1)%depth >= point(1)%depth) low = point(1)%depth
        if (tried(1)%depth < point(1)%depth) high = point(1)%depth
        point = [tried(1), point(1), point(2)]
      else
        if (tried(1)%depth < point(1)%depth) low = tried(1)%depth
        if (tried(1)%depth >= point(1)%depth) high = tried(1)%depth
        if (tried(1)%value >= point(2)%value .or. is_same(point(2)%depth, point(1)%depth)) then
          point(2:) = [tried(1), point(2)]
        else if (tried(1)%value >= point(3)%value .or. is_same(point(3)%depth, point(1)%depth) &
                 .or. is_same(point(3)%depth, point(2)%depth)) then
          point(3) = tried(1)
        end if
      end if
    end do
    if (point(1)%value > best%value) best = point(1)
  end subroutine maximise

  pure function is_same(a, b)
    real(dp), intent(in) :: a, b
    logical :: is_same

    is_same = .not. abs(a - b) > 0.0_dp
  end function is_same

  !> The next `step` from x(1): to the vertex of the parabola through three points, if that is within the bounds and
  !> less than half of the step `before`, otherwise into the greater part by the golden section.
  pure subroutine choose_step(x, value, low, high, tolerance, step, before)
    real(dp), intent(in) :: x(3), value(3), low, high, tolerance
    real(dp), intent(inout) :: step, before
    real(dp) :: numerator, denominator, r, q, last

    last = before
    before = step
    r = (x(1) - x(2))*(value(1) - value(3))
    q = (x(1) - x(3))*(value(1) - value(2))
    numerator = (x(1) - x(3))*q - (x(1) - x(2))*r
    denominator = 2.0_dp*(r - q)
    if (abs(last) > tolerance .and. abs(denominator) > 0.0_dp) then
      step = numerator/denominator
      if (abs(step) < 0.5_dp*abs(last) .and. x(1) + step > low + tolerance .and. x(1) + step < high - tolerance) return
    end if
    before = merge(low, high, x(1) >= 0.5_dp*(low + high)) - x(1)
    step = GOLDEN*before
  end subroutine choose_step

end module fuge_layered_peak_search
