!> What coatings fail by: the largest tension and shear at the surface and at each interface of a body of layers, below
!> the cells of a grid.
module fuge_interface_peaks
  use fuge_elastic_moduli, only: FUGE_PLANE_STRAIN
  use fuge_kinds, only: dp
  use fuge_layer_interior, only: cut_at, layer_cut
  use fuge_layer_stack, only: layer_stack
  use fuge_layered_body_type, only: fuge_layered_body
  use fuge_layered_halfplane_depths, only: fuge_layered_halfplane_stress_grid
  use fuge_layered_halfspace_depths, only: fuge_layered_halfspace_stress_grid
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE
  use fuge_stress_measures, only: fuge_halfplane_tensor, fuge_principal_stresses
  implicit none
  private

  public :: fuge_layered_halfplane_interfaces, fuge_layered_halfspace_interfaces

  !> The largest stresses of the surface or of an interface, force per length squared, and the numbers of the cells
  !> above them.
  type, public :: fuge_interface_stress
    !> Length.
    real(dp) :: depth = 0.0_dp
    !> The largest principal stress, tension positive, above the interface and below it; at the surface, and at a rigid
    !> base, both are those in the layers.
    real(dp) :: tension_above = 0.0_dp, tension_below = 0.0_dp
    !> Below which cells they are.
    integer :: cell_above = 0, cell_below = 0
    !> The largest shear stress between both sides, and the largest stress that opens the interface, zz.
    real(dp) :: shear = 0.0_dp, opening = 0.0_dp
    !> Below which cells they are.
    integer :: cell_of_shear = 0, cell_of_opening = 0
  end type fuge_interface_stress

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
    type(fuge_layered_body), intent(in) :: body
    integer, intent(in) :: nx, ny, boundary
    real(dp), intent(in) :: spacing_x, spacing_y, force(:)
    type(fuge_interface_stress), intent(inout) :: peaks(:)
    type(fuge_info), intent(out) :: info
    type(fuge_interface_stress) :: found(size(peaks))
    real(dp), allocatable :: stress(:, :, :)
    real(dp) :: depth
    logical :: below
    integer :: k, side, stat

    call check_peaks(body, size(peaks), info)
    if (info%failed()) return
    allocate (stress(6, size(force), 1), stat=stat)
    call require_memory(stat, 'stresses at', size(force), 'cells', info)
    do k = 1, size(peaks)
      do side = 1, 2
        if (info%failed()) return
        call find_side(body, k - 1, side, depth, below)
        call fuge_layered_halfspace_stress_grid(body, nx, ny, spacing_x, spacing_y, force, boundary, [depth], stress, &
                                                info, [below])
        if (.not. info%failed()) call take_side(stress(:, :, 1), depth, side, found(k), info)
      end do
    end do
    if (.not. info%failed()) peaks = found
  end subroutine fuge_layered_halfspace_interfaces

  !> The largest stresses at the surface and at each interface below a line of cells, in plane strain.
  !>
  !> `body`, `spacing`, `force`, `element` and `boundary` as for `fuge_layered_halfplane_stress_grid`; `peaks` as for
  !> `fuge_layered_halfspace_interfaces`; a principal stress may be that along the line. Errors, peaks untouched: as for
  !> `fuge_layered_halfplane_stress_grid`.
  subroutine fuge_layered_halfplane_interfaces(body, spacing, force, element, boundary, peaks, info)
    type(fuge_layered_body), intent(in) :: body
    real(dp), intent(in) :: spacing, force(:)
    integer, intent(in) :: element, boundary
    type(fuge_interface_stress), intent(inout) :: peaks(:)
    type(fuge_info), intent(out) :: info
    type(fuge_interface_stress) :: found(size(peaks))
    type(layer_cut) :: cut
    real(dp), allocatable :: stress(:, :, :), tensor(:, :)
    real(dp) :: depth
    logical :: below
    integer :: k, side, stat

    call check_peaks(body, size(peaks), info)
    if (info%failed()) return
    allocate (stress(3, size(force), 1), tensor(6, size(force)), stat=stat)
    call require_memory(stat, 'stresses at', size(force), 'cells', info)
    do k = 1, size(peaks)
      do side = 1, 2
        if (info%failed()) return
        call find_side(body, k - 1, side, depth, below)
        call fuge_layered_halfplane_stress_grid(body, spacing, force, element, boundary, [depth], stress, info, [below])
        cut = cut_at(body%layers(), depth, below)
        if (.not. info%failed()) call fuge_halfplane_tensor(stress(:, :, 1), FUGE_PLANE_STRAIN, cut%poisson, tensor, &
                                                            info)
        if (.not. info%failed()) call take_side(tensor, depth, side, found(k), info)
      end do
    end do
    if (.not. info%failed()) peaks = found
  end subroutine fuge_layered_halfplane_interfaces

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

  !> The depth of `interface` 0, 1, .. from the surface down, and on which side of it `side` is, 1 or 2: below a rigid
  !> base there is nothing.
  subroutine find_side(body, interface, side, depth, below)
    type(fuge_layered_body), intent(in) :: body
    integer, intent(in) :: interface, side
    real(dp), intent(out) :: depth
    logical, intent(out) :: below
    type(layer_stack) :: stack

    depth = 0.0_dp
    below = .false.
    if (interface < 1) return
    stack = body%layers()
    depth = sum(stack%thickness(:interface))
    below = side == 2 .and. .not. stack%shear(interface + 1) > huge(1.0_dp)
  end subroutine find_side

  !> Take the largest values of `tensor` (6, cells), on `side` 1 or 2. FUGE_ERR_MEMORY.
  subroutine take_side(tensor, depth, side, peak, info)
    real(dp), intent(in) :: tensor(:, :), depth
    integer, intent(in) :: side
    type(fuge_interface_stress), intent(inout) :: peak
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: principal(:, :)
    integer :: stat

    allocate (principal(3, size(tensor, 2)), stat=stat)
    call require_memory(stat, 'principal stresses at', size(tensor, 2), 'cells', info)
    if (stat == 0) call fuge_principal_stresses(tensor, principal, info)
    if (info%failed()) return
    if (side == 1) then
      peak%depth = depth
      peak%cell_above = maxloc(principal(1, :), dim=1)
      peak%tension_above = principal(1, peak%cell_above)
      peak%cell_of_shear = maxloc(hypot(tensor(4, :), tensor(5, :)), dim=1)
      peak%shear = hypot(tensor(4, peak%cell_of_shear), tensor(5, peak%cell_of_shear))
      peak%cell_of_opening = maxloc(tensor(3, :), dim=1)
      peak%opening = tensor(3, peak%cell_of_opening)
    else
      peak%cell_below = maxloc(principal(1, :), dim=1)
      peak%tension_below = principal(1, peak%cell_below)
    end if
  end subroutine take_side

end module fuge_interface_peaks
