!> A body of layers at the depths that the caller asks for.
module fuge_layer_checks
  use fuge_cell_elements, only: FUGE_HAT
  use fuge_depth_mixture, only: uniform_stress, mean_displacement
  use fuge_kinds, only: dp
  use fuge_layer_interior, only: find_cut, is_upper_half, layer_at, layer_cut
  use fuge_layer_stack, only: layer_stack
  use fuge_layered_body_type, only: copy_layers, fuge_layered_body
  use fuge_number_text, only: index_text, text
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_CALL_ORDER, FUGE_ERR_ELEMENT, &
    FUGE_ERR_GRID, FUGE_ERR_OVERFLOW, FUGE_ERR_SIZE
  implicit none
  private

  public :: find_layers, find_uniform, points_in_top, refuse_hats, require_finite, start_points

contains

  !> `layer` (m): that at each `depth` (m) >= 0, length, an argument of the `name`: at an interface the one above it
  !> unless `below` (m) says otherwise. Errors, unless there is one already: FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE,
  !> FUGE_ERR_GRID, FUGE_ERR_MEMORY.
  subroutine find_layers(body, depth, name, layer, info, below)
    type(fuge_layered_body), intent(in) :: body
    real(dp), intent(in) :: depth(:)
    character(len=*), intent(in) :: name
    integer, allocatable, intent(out) :: layer(:)
    type(fuge_info), intent(inout) :: info
    logical, intent(in), optional :: below(:)
    type(layer_stack) :: stack
    logical :: lower
    integer :: k, stat

    if (info%failed()) return
    if (.not. body%is_set()) call report(info, FUGE_ERR_CALL_ORDER, 'body: no layers are set')
    if (present(below) .and. .not. info%failed()) then
      if (size(below) /= size(depth)) call report(info, FUGE_ERR_SIZE, 'below has '//text(size(below)) &
                                                  //' values for the '//text(size(depth))//' of '//name)
    end if
    if (info%failed()) return
    call copy_layers(body, stack, info)
    if (info%failed()) return
    allocate (layer(size(depth)), stat=stat)
    call require_memory(stat, 'the layers at', size(depth), 'depths', info)
    do k = 1, size(depth)
      if (info%failed()) return
      lower = .false.
      if (present(below)) lower = below(k)
      layer(k) = layer_at(stack, depth(k), lower)
      if (.not. stack%shear(layer(k)) > huge(1.0_dp)) cycle
      call report(info, FUGE_ERR_GRID, name//'('//index_text(k)//') = '//text(depth(k)) &
                  //' is in the rigid base: the layers are '//text(sum(stack%thickness))//' thick')
    end do
  end subroutine find_layers

  !> `in_top`: the numbers of the points, or depths, in the top layer. FUGE_ERR_MEMORY.
  subroutine points_in_top(layer, in_top, info)
    integer, intent(in) :: layer(:)
    integer, allocatable, intent(out) :: in_top(:)
    type(fuge_info), intent(inout) :: info
    integer :: k, number, stat

    if (info%failed()) return
    allocate (in_top(count(layer == 1)), stat=stat)
    call require_memory(stat, 'results at', size(layer), 'depths', info)
    if (stat /= 0) return
    number = 0
    do k = 1, size(layer)
      if (layer(k) /= 1) cycle
      number = number + 1
      in_top(number) = k
    end do
  end subroutine points_in_top

  !> Refuse FUGE_HAT (FUGE_ERR_ELEMENT), unless there is an error already.
  pure subroutine refuse_hats(element, info)
    integer, intent(in) :: element
    type(fuge_info), intent(inout) :: info

    if (info%failed() .or. element /= FUGE_HAT) return
    call report(info, FUGE_ERR_ELEMENT, 'element FUGE_HAT: in layers the pressure is constant on each cell: use ' &
                //'FUGE_MEAN, whose influence is the same')
  end subroutine refuse_hats

  !> The numbers `in_top` of the points in the top layer, and arrays for what a half-space gives there, `plain`
  !> (components, points in the top layer), and for all results, `found` (components, points), which are 0.
  !> FUGE_ERR_MEMORY.
  subroutine start_points(layer, components, in_top, plain, found, info)
    integer, intent(in) :: layer(:), components
    integer, allocatable, intent(out) :: in_top(:)
    real(dp), allocatable, intent(out) :: plain(:, :), found(:, :)
    type(fuge_info), intent(inout) :: info
    integer :: stat

    call points_in_top(layer, in_top, info)
    if (info%failed()) return
    allocate (plain(components, size(in_top)), found(components, size(layer)), stat=stat)
    call require_memory(stat, 'results at', size(layer), 'points', info)
    if (stat == 0) found = 0.0_dp
  end subroutine start_points

  !> Refuse displacements that are not finite (FUGE_ERR_OVERFLOW).
  pure subroutine require_finite(displacement, info)
    real(dp), intent(in) :: displacement(:, :)
    type(fuge_info), intent(inout) :: info

    if (info%failed() .or. all(abs(displacement) <= huge(1.0_dp))) return
    call report(info, FUGE_ERR_OVERFLOW, 'displacements are out of range: choose other units')
  end subroutine require_finite

  !> The state under equal pressure p everywhere at each `depth` (m), length, of `layer` (m). `uniform` (3, m): xx/p;
  !> zz/p, 0 in the top layer, where the half-space already has it; and 2 G/p times the displacement along z, G the
  !> shear modulus of the top layer (`uniform_stress`, `mean_displacement`). FUGE_ERR_MEMORY.
  subroutine find_uniform(body, depth, layer, plane_strain, uniform, info)
    type(fuge_layered_body), intent(in) :: body
    real(dp), intent(in) :: depth(:)
    integer, intent(in) :: layer(:)
    logical, intent(in) :: plane_strain
    real(dp), allocatable, intent(out) :: uniform(:, :)
    type(fuge_info), intent(inout) :: info
    type(layer_stack) :: stack
    type(layer_cut) :: cut
    integer :: k, stat

    if (info%failed()) return
    call copy_layers(body, stack, info)
    if (info%failed()) return
    allocate (uniform(3, size(depth)), stat=stat)
    call require_memory(stat, 'results at', size(depth), 'depths', info)
    do k = 1, size(depth)
      if (info%failed()) return
      call find_cut(stack, depth(k), is_upper_half(stack, layer(k), depth(k)), cut, stat)
      call require_memory(stat, 'the layers at', size(depth), 'depths', info)
      if (stat /= 0) return
      uniform(:2, k) = uniform_stress(cut, plane_strain)
      if (layer(k) == 1) uniform(2, k) = 0.0_dp
      uniform(3, k) = mean_displacement(cut)
    end do
  end subroutine find_uniform

end module fuge_layer_checks
