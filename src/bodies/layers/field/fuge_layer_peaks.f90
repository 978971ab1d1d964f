!> The largest stresses in a body of layers below the cells of a grid: in the whole body, and at each interface.
!>
!> At each depth all cells are seen at once, so the search for the largest one is a search along the depth. Stresses
!> vary there over lengths of the order of the depth, because all that gives rise to them lies at the surface or beyond
!> the next interface: depths at equal ratios miss no maximum. Each that may be the largest one is then found by
!> parabolas.
module fuge_layer_peaks
  use fuge_field_type, only: fuge_field
  use fuge_kinds, only: dp
  use fuge_layer_interior, only: is_upper_half
  use fuge_layer_stack, only: layer_stack
  use fuge_peak_values, only: measured
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_OVERFLOW
  use fuge_stress_measures, only: fuge_principal_stresses
  use fuge_stress_peak_type, only: fuge_interface_stress, fuge_stress_peak, FUGE_PEAK_SURFACE
  implicit none
  private

  public :: find_interface_peaks, find_layer_peak

  !> The ratio of depths; the first one below the surface, in the lesser width of a cell, as in the half-space; the last
  !> one in the substrate, in the extent of the cells with a force.
  real(dp), parameter :: RATIO = 1.3_dp, FIRST_DEPTH = 0.25_dp, LAST_DEPTH = 2.0_dp
  !> The largest value between two depths is larger than at both by less than this fraction of it.
  real(dp), parameter :: HIDDEN = 0.05_dp
  !> A maximum is found if its parabola exceeds it by less than EXCESS of it, and the depths beside it are less by at
  !> most FALL.
  real(dp), parameter :: EXCESS = 1.0e-7_dp, FALL = 1.0e-3_dp
  !> The next depth is at least this fraction of the way to one of the depths around the best one.
  real(dp), parameter :: LEAST_STEP = 0.1_dp
  integer, parameter :: MOST_STEPS = 40
  !> Depths that are found at a time.
  integer, parameter :: PORTION = 4

contains

  !> The largest value of a `measure` below the centres of the cells of a grid: in all layers of the `stack`, on both
  !> sides of each interface, at the surface, and at all depths from a quarter of the `width` of a cell on, to a
  !> relative error of 1e-6. Of the place only the depth is set.
  !>
  !> `extent` of the cells with a force, length, 0 if there are none: then the stress is 0. Errors, `peak` untouched:
  !> those of `grid_stress`, FUGE_ERR_OVERFLOW if no stress is finite.
  subroutine find_layer_peak(field, stack, width, extent, measure, peak, info)
    class(fuge_field), intent(in) :: field
    type(layer_stack), intent(in) :: stack
    real(dp), intent(in) :: width, extent
    integer, intent(in) :: measure
    type(fuge_stress_peak), intent(inout) :: peak
    type(fuge_info), intent(out) :: info
    type(fuge_stress_peak), allocatable :: at(:)
    type(fuge_stress_peak) :: best
    integer :: k

    best = fuge_stress_peak(layer=1, cell=1)
    if (extent > 0.0_dp) then
      at = depths_of(stack, FIRST_DEPTH*width, LAST_DEPTH*extent)
      call evaluate(field, stack, measure, at, info)
      if (info%failed()) return
      best = at(maxloc(at%value, dim=1))
      do k = 1, size(at)
        if (at(k)%value >= (1.0_dp - HIDDEN)*best%value) call refine(field, stack, measure, at, k, best, info)
        if (info%failed()) return
      end do
      if (best%value < 0.0_dp) then
        call report(info, FUGE_ERR_OVERFLOW, 'no stress is in range: choose another unit of force')
        return
      end if
    end if
    peak = best
    if (.not. peak%place(3) > 0.0_dp) peak%location = FUGE_PEAK_SURFACE
  end subroutine find_layer_peak

  !> The depths of all layers, both sides of each interface included, from the surface down: at equal ratios from the
  !> `first` one on, but three at least in each layer, and as deep in the substrate as `last`.
  pure function depths_of(stack, first, last) result(at)
    type(layer_stack), intent(in) :: stack
    real(dp), intent(in) :: first, last
    type(fuge_stress_peak), allocatable :: at(:)
    real(dp) :: bottom, part, start, top
    integer :: count, j, k, layers

    layers = size(stack%shear)
    if (stack%is_rigid()) layers = layers - 1
    allocate (at(0))
    do k = 1, layers
      top = sum(stack%thickness(:k - 1))
      bottom = sum(stack%thickness(:min(k, size(stack%thickness))))
      if (k > size(stack%thickness)) bottom = top + last
      ! A layer above the first depth has one in its middle.
      start = max(top, merge(first, 0.5_dp*bottom, first < bottom))
      count = max(2, int(log(bottom/start)/log(RATIO)) + 1)
      at = [at, fuge_stress_peak(layer=k, place=[0.0_dp, 0.0_dp, top])]
      if (start > top) at = [at, fuge_stress_peak(layer=k, place=[0.0_dp, 0.0_dp, start])]
      do j = 1, count
        part = real(j, dp)/real(count, dp)
        at = [at, fuge_stress_peak(layer=k, place=[0.0_dp, 0.0_dp, start*(bottom/start)**part])]
      end do
      at(size(at))%place(3) = bottom
    end do
  end function depths_of

  !> Find the largest values at the depths, in their layers; -1 where none is finite.
  subroutine evaluate(field, stack, measure, at, info)
    class(fuge_field), intent(in) :: field
    type(layer_stack), intent(in) :: stack
    integer, intent(in) :: measure
    type(fuge_stress_peak), intent(inout) :: at(:)
    type(fuge_info), intent(out) :: info
    real(dp), allocatable :: tensor(:, :, :), value(:)
    logical :: below(size(at))
    integer :: first, k, last, stat

    allocate (tensor(6, field%cells, min(PORTION, size(at))), value(field%cells), stat=stat)
    call require_memory(stat, 'stresses at', field%cells, 'cells', info)
    if (stat /= 0) return
    do k = 1, size(at)
      below(k) = is_upper_half(stack, at(k)%layer, at(k)%place(3))
    end do
    do first = 1, size(at), PORTION
      last = min(first + PORTION - 1, size(at))
      call field%find_grid_stress(at(first:last)%place(3), below(first:last), tensor(:, :, :last - first + 1), info)
      if (info%failed()) return
      do k = first, last
        value = measured(measure, tensor(:, :, k - first + 1))
        at(k)%cell = maxloc(value, dim=1)
        at(k)%value = value(at(k)%cell)
        at(k)%tensor = tensor(:, at(k)%cell, k - first + 1)
      end do
    end do
  end subroutine evaluate

  !> Search around depth `k` unless one beside it, in its layer, has more.
  subroutine refine(field, stack, measure, at, k, best, info)
    class(fuge_field), intent(in) :: field
    type(layer_stack), intent(in) :: stack
    integer, intent(in) :: measure, k
    type(fuge_stress_peak), intent(in) :: at(:)
    type(fuge_stress_peak), intent(inout) :: best
    type(fuge_info), intent(inout) :: info
    type(fuge_stress_peak) :: around(3)
    integer :: first, last

    ! Between the surface and the next depth the cells resolve nothing.
    if (.not. at(k)%place(3) > 0.0_dp) return
    first = k
    last = k
    if (k > 1) first = merge(k - 1, k, at(max(1, k - 1))%layer == at(k)%layer .and. at(max(1, k - 1))%place(3) > 0.0_dp)
    if (k < size(at)) last = merge(k + 1, k, at(min(size(at), k + 1))%layer == at(k)%layer)
    if (first == last .or. any(at(first:last)%value > at(k)%value)) return
    around = [at(first), at(k), at(last)]
    if (last - first == 1) then
      call leave_side(field, stack, measure, merge(1, 3, first == k), around, info)
      if (info%failed() .or. around(2)%value <= at(k)%value) return
    end if
    call maximise(field, stack, measure, around, info)
    if (around(2)%value > best%value) best = around(2)
  end subroutine refine

  !> At a side of the layer, the depth `side` of the three, the maximum may lie before the next depth: halve the way to
  !> that until the middle one has more, or a parabola no longer rises from the side.
  subroutine leave_side(field, stack, measure, side, around, info)
    class(fuge_field), intent(in) :: field
    type(layer_stack), intent(in) :: stack
    integer, intent(in) :: measure, side
    type(fuge_stress_peak), intent(inout) :: around(3)
    type(fuge_info), intent(inout) :: info
    real(dp) :: rise
    integer :: k

    do k = 1, MOST_STEPS
      around(2)%place(3) = 0.5_dp*(around(1)%place(3) + around(3)%place(3))
      call evaluate(field, stack, measure, around(2:2), info)
      if (info%failed() .or. around(2)%value > around(side)%value) return
      rise = 4.0_dp*around(2)%value - 3.0_dp*around(side)%value - around(4 - side)%value
      if (rise <= EXCESS*around(side)%value) return
      around(4 - side) = around(2)
    end do
  end subroutine leave_side

  !> Move the middle one of three depths, which has the largest value, to the maximum.
  subroutine maximise(field, stack, measure, around, info)
    class(fuge_field), intent(in) :: field
    type(layer_stack), intent(in) :: stack
    integer, intent(in) :: measure
    type(fuge_stress_peak), intent(inout) :: around(3)
    type(fuge_info), intent(inout) :: info
    type(fuge_stress_peak) :: tried(1)
    real(dp) :: lower(2), gap(2), least, step
    integer :: k

    do k = 1, MOST_STEPS
      gap = around(2)%place(3) - around([1, 3])%place(3)
      lower = around(2)%value - around([1, 3])%value
      if (.not. sum(abs(lower)) > 0.0_dp) exit
      ! From the middle to the vertex, and its height.
      step = -0.5_dp*(gap(1)**2*lower(2) - gap(2)**2*lower(1))/(gap(1)*lower(2) - gap(2)*lower(1))
      if (maxval(lower) <= FALL*around(2)%value .and. &
          abs(step)*maxval(lower/abs(gap)) <= EXCESS*around(2)%value) exit
      least = LEAST_STEP*maxval(abs(gap))
      if (abs(step) < least) step = merge(least, -least, abs(gap(2)) > abs(gap(1)))
      tried = around(2:2)
      tried%place(3) = around(2)%place(3) + step
      call evaluate(field, stack, measure, tried, info)
      if (info%failed()) return
      if (tried(1)%value > around(2)%value) then
        around(merge(1, 3, step > 0.0_dp)) = around(2)
        around(2) = tried(1)
      else
        around(merge(3, 1, step > 0.0_dp)) = tried(1)
      end if
    end do
  end subroutine maximise

  !> The largest stresses at the surface and at each interface from above, `peaks`, below the centres of cells: at the
  !> surface the stresses of the last cells in contact jump from one cell to the next, and their error is of the order
  !> of a cell. Errors: those of `grid_stress`, FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY.
  subroutine find_interface_peaks(field, stack, peaks, info)
    class(fuge_field), intent(in) :: field
    type(layer_stack), intent(in) :: stack
    type(fuge_interface_stress), intent(inout) :: peaks(:)
    type(fuge_info), intent(out) :: info
    real(dp), allocatable :: principal(:, :), tensor(:, :, :)
    integer :: k, side, sides, stat

    allocate (principal(3, field%cells), tensor(6, field%cells, 2), stat=stat)
    call require_memory(stat, 'stresses at', field%cells, 'cells', info)
    if (stat /= 0) return
    do k = 1, size(peaks)
      ! The surface and a rigid base have one elastic side.
      sides = 1
      if (k > 1) sides = merge(1, 2, stack%shear(k) > huge(1.0_dp))
      peaks(k)%depth = sum(stack%thickness(:k - 1))
      call field%find_grid_stress(spread(peaks(k)%depth, 1, sides), [(side == 2, side=1, sides)], &
                                  tensor(:, :, :sides), info)
      do side = 1, sides
        if (.not. info%failed()) call take_side(tensor(:, :, side), side, principal, peaks(k), info)
      end do
      if (info%failed()) return
      if (sides == 2) cycle
      peaks(k)%tension_below = peaks(k)%tension_above
      peaks(k)%cell_below = peaks(k)%cell_above
    end do
  end subroutine find_interface_peaks

  !> Take the largest values of `tensor` (6, cells), on `side` 1 or 2. `principal` (3, cells) is work space.
  !> FUGE_ERR_OVERFLOW.
  subroutine take_side(tensor, side, principal, peak, info)
    real(dp), intent(in) :: tensor(:, :)
    integer, intent(in) :: side
    real(dp), intent(inout) :: principal(:, :)
    type(fuge_interface_stress), intent(inout) :: peak
    type(fuge_info), intent(inout) :: info

    call fuge_principal_stresses(tensor, principal, info)
    if (.not. (info%failed() .or. all(abs(principal) <= huge(1.0_dp)))) &
      call report(info, FUGE_ERR_OVERFLOW, 'stresses are out of range: choose another unit of force')
    if (info%failed()) return
    if (side == 1) then
      peak%cell_above = maxloc(principal(1, :), dim=1)
      peak%tension_above = principal(1, peak%cell_above)
      peak%cell_of_opening = maxloc(tensor(3, :), dim=1)
      peak%opening = tensor(3, peak%cell_of_opening)
      call take_shear(tensor, peak)
    else
      peak%cell_below = maxloc(principal(1, :), dim=1)
      peak%tension_below = principal(1, peak%cell_below)
    end if
  end subroutine take_side

  !> Take the largest shear stress of `tensor` (6, cells).
  pure subroutine take_shear(tensor, peak)
    real(dp), intent(in) :: tensor(:, :)
    type(fuge_interface_stress), intent(inout) :: peak
    real(dp) :: shear
    integer :: cell

    do cell = 1, size(tensor, 2)
      shear = hypot(tensor(4, cell), tensor(5, cell))
      if (cell > 1 .and. .not. shear > peak%shear) cycle
      peak%cell_of_shear = cell
      peak%shear = shear
    end do
  end subroutine take_shear

end module fuge_layer_peaks
