!> The stresses that crack or detach coatings: the largest tension at the surface and on both sides of each interface,
!> and the largest interfacial shear, below the cells of a grid.
module fuge_interface_peaks
  use fuge_kinds, only: dp
  use fuge_layer_stack, only: layer_stack
  use fuge_layered_body_type, only: fuge_layered_body
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_CALL_ORDER, FUGE_ERR_OVERFLOW, FUGE_ERR_SIZE
  use fuge_stress_measures, only: fuge_principal_stresses
  use fuge_stress_peak_type, only: fuge_interface_stress
  implicit none
  private

  public :: fuge_layered_halfplane_interfaces, fuge_layered_halfspace_interfaces

  !> The two sides of an interface.
  logical, parameter :: BELOW(2) = [.false., .true.]

contains

  !> The largest stresses at the surface and at each interface below a grid of rectangles.
  !>
  !> `body`, `nx`, `ny`, `spacing_x`, `spacing_y`, `force` and `boundary` as for `fuge_layered_halfspace_stress_grid`;
  !> out: `peaks`, (body%interfaces() + 1), of the surface and of the interfaces from above. They are those below the
  !> centres of cells: at the surface the stresses of the last cells in contact jump from one cell to the next, and
  !> their error is of the order of a cell.
  !>
  !> Nine arguments: the grid alone has four. Errors, peaks untouched: as for `fuge_layered_halfspace_stress_grid`.
  subroutine fuge_layered_halfspace_interfaces(body, nx, ny, spacing_x, spacing_y, force, boundary, peaks, info)
    use fuge_layered_grid, only: layered_grid
    type(fuge_layered_body), intent(in) :: body
    integer, intent(in) :: nx, ny, boundary
    real(dp), intent(in) :: spacing_x, spacing_y, force(:)
    type(fuge_interface_stress), intent(inout) :: peaks(:)
    type(fuge_info), intent(out) :: info
    type(layered_grid) :: grid

    grid%cells = [nx, ny]
    grid%spacing = [spacing_x, spacing_y]
    grid%boundary = boundary
    call find_interfaces(grid, body, force, peaks, info)
  end subroutine fuge_layered_halfspace_interfaces

  !> The largest stresses at the surface and at each interface below a line of cells, in plane strain.
  !>
  !> `body`, `spacing`, `force`, `element` and `boundary` as for `fuge_layered_halfplane_stress_grid`; `peaks` as for
  !> `fuge_layered_halfspace_interfaces`; a principal stress may be that along the line. Errors, peaks untouched: as for
  !> `fuge_layered_halfplane_stress_grid`.
  subroutine fuge_layered_halfplane_interfaces(body, spacing, force, element, boundary, peaks, info)
    use fuge_layered_grid, only: layered_grid
    type(fuge_layered_body), intent(in) :: body
    real(dp), intent(in) :: spacing, force(:)
    integer, intent(in) :: element, boundary
    type(fuge_interface_stress), intent(inout) :: peaks(:)
    type(fuge_info), intent(out) :: info
    type(layered_grid) :: grid

    grid%is_line = .true.
    grid%cells = [size(force), 1]
    grid%spacing = spacing
    grid%element = element
    grid%boundary = boundary
    call find_interfaces(grid, body, force, peaks, info)
  end subroutine fuge_layered_halfplane_interfaces

  subroutine find_interfaces(grid, body, force, peaks, info)
    use fuge_layered_grid, only: layered_grid
    type(layered_grid), intent(inout) :: grid
    type(fuge_layered_body), intent(in) :: body
    real(dp), intent(in) :: force(:)
    type(fuge_interface_stress), intent(inout) :: peaks(:)
    type(fuge_info), intent(inout) :: info
    type(fuge_interface_stress), allocatable :: found(:)
    real(dp), allocatable :: principal(:, :), tensor(:, :, :)
    integer :: k, side, sides, stat

    call check_peaks(body, size(peaks), info)
    if (info%failed()) return
    call grid%press(body, force, info)
    if (info%failed()) return
    allocate (found(size(peaks)), principal(3, size(force)), tensor(6, size(force), 2), &
              stat=stat)
    call require_memory(stat, 'stresses at', size(force), 'cells', info)
    if (stat /= 0) return
    do k = 1, size(peaks)
      sides = sides_of(grid%stack, k - 1)
      found(k)%depth = sum(grid%stack%thickness(:k - 1))
      call grid%tensors(body, spread(found(k)%depth, 1, sides), BELOW(:sides), tensor(:, :, :sides), info)
      do side = 1, sides
        if (.not. info%failed()) call take_side(tensor(:, :, side), side, principal, found(k), info)
      end do
      if (info%failed()) return
      if (sides == 1) call copy_side(found(k))
    end do
    peaks = found
  end subroutine find_interfaces

  !> Errors: FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE.
  subroutine check_peaks(body, given, info)
    type(fuge_layered_body), intent(in) :: body
    integer, intent(in) :: given
    type(fuge_info), intent(inout) :: info

    if (.not. body%is_set()) then
      call report(info, FUGE_ERR_CALL_ORDER, 'body: no layers are set')
    else if (given /= body%interfaces() + 1) then
      call report(info, FUGE_ERR_SIZE, 'peaks has '//text(given)//' values for the surface and ' &
                  //text(body%interfaces())//' interfaces')
    end if
  end subroutine check_peaks

  !> How many sides of `interface` 0, 1, .. (0 is the surface) are elastic: 1 at the surface and at a rigid base,
  !> otherwise 2.
  pure function sides_of(stack, interface) result(sides)
    type(layer_stack), intent(in) :: stack
    integer, intent(in) :: interface
    integer :: sides

    sides = 1
    if (interface > 0) sides = merge(1, 2, stack%shear(interface + 1) > huge(1.0_dp))
  end function sides_of

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

  !> Where there is nothing below the stresses are those above.
  pure subroutine copy_side(peak)
    type(fuge_interface_stress), intent(inout) :: peak

    peak%tension_below = peak%tension_above
    peak%cell_below = peak%cell_above
  end subroutine copy_side

end module fuge_interface_peaks
