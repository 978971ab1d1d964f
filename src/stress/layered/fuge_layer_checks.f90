!> A body of layers at the depths that the caller asks for.
module fuge_layer_checks
  use fuge_kinds, only: dp
  use fuge_layer_interior, only: find_cut, layer_at, layer_cut
  use fuge_layer_stack, only: layer_stack
  use fuge_layered_body_type, only: fuge_layered_body
  use fuge_number_text, only: index_text, text
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_CALL_ORDER, FUGE_ERR_GRID, FUGE_ERR_SIZE
  implicit none
  private

  public :: cut_body, find_depths_in_top, find_layers, number_in_top, points_in_top

contains

  !> `cut` (m): the body at each `depth` (m) >= 0, length, at an interface above it unless `below` (m) says otherwise.
  !> Errors, unless there is one already: FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE, FUGE_ERR_GRID, FUGE_ERR_MEMORY.
  subroutine cut_body(body, depth, cut, info, below)
    type(fuge_layered_body), intent(in) :: body
    real(dp), intent(in) :: depth(:)
    type(layer_cut), allocatable, intent(out) :: cut(:)
    type(fuge_info), intent(inout) :: info
    logical, intent(in), optional :: below(:)
    type(layer_stack) :: stack
    logical :: lower
    integer :: k, stat

    if (info%failed()) return
    if (.not. body%is_set()) call report(info, FUGE_ERR_CALL_ORDER, 'body: no layers are set')
    if (present(below) .and. .not. info%failed()) then
      if (size(below) /= size(depth)) call report(info, FUGE_ERR_SIZE, 'below has '//text(size(below)) &
                                                  //' values for '//text(size(depth))//' depths')
    end if
    if (info%failed()) return
    stack = body%layers()
    allocate (cut(size(depth)), stat=stat)
    call require_memory(stat, '', size(depth), 'depths', info)
    do k = 1, size(depth)
      if (info%failed()) return
      lower = .false.
      if (present(below)) lower = below(k)
      call find_cut(stack, depth(k), lower, cut(k), stat)
      call require_memory(stat, 'layers at', size(depth), 'depths', info)
      if (stat /= 0) return
      if (.not. cut(k)%shear > huge(1.0_dp)) cycle
      call report(info, FUGE_ERR_GRID, 'depth '//text(k)//' = '//text(depth(k)) &
                  //' is in the rigid base: the layers are '//text(sum(stack%thickness))//' thick')
    end do
  end subroutine cut_body

  !> `layer` (m): that of each point at `depth` (m) >= 0, length, at an interface the one above it unless `below` (m) says
  !> otherwise. Errors, unless there is one already: FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE, FUGE_ERR_GRID, FUGE_ERR_MEMORY.
  subroutine find_layers(body, depth, layer, info, below)
    type(fuge_layered_body), intent(in) :: body
    real(dp), intent(in) :: depth(:)
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
                                                  //' values for the '//text(size(depth))//' points of pz')
    end if
    if (info%failed()) return
    stack = body%layers()
    allocate (layer(size(depth)), stat=stat)
    call require_memory(stat, 'the layers of', size(depth), 'points', info)
    do k = 1, size(depth)
      if (info%failed()) return
      lower = .false.
      if (present(below)) lower = below(k)
      layer(k) = layer_at(stack, depth(k), lower)
      if (.not. stack%shear(layer(k)) > huge(1.0_dp)) cycle
      call report(info, FUGE_ERR_GRID, 'pz('//index_text(k)//') = '//text(depth(k)) &
                  //' is in the rigid base: the layers are '//text(sum(stack%thickness))//' thick')
    end do
  end subroutine find_layers

  !> The points in the top layer, `which`, and room for their part and for all results (components, points).
  !> FUGE_ERR_MEMORY.
  subroutine points_in_top(layer, components, which, plain, found, info)
    integer, intent(in) :: layer(:), components
    integer, allocatable, intent(out) :: which(:)
    real(dp), allocatable, intent(out) :: plain(:, :), found(:, :)
    type(fuge_info), intent(inout) :: info
    integer :: k, number, stat

    if (info%failed()) return
    number = count(layer == 1)
    allocate (which(number), plain(components, number), found(components, size(layer)), stat=stat)
    call require_memory(stat, 'results at', size(layer), 'points', info)
    if (stat /= 0) return
    found = 0.0_dp
    number = 0
    do k = 1, size(layer)
      if (layer(k) /= 1) cycle
      number = number + 1
      which(number) = k
    end do
  end subroutine points_in_top

  !> `in_top`: those of the depths that are in the top layer. FUGE_ERR_MEMORY.
  pure subroutine find_depths_in_top(cut, depth, in_top, info)
    type(layer_cut), intent(in) :: cut(:)
    real(dp), intent(in) :: depth(:)
    real(dp), allocatable, intent(out) :: in_top(:)
    type(fuge_info), intent(inout) :: info
    integer :: k, stat

    if (info%failed()) return
    allocate (in_top(count(cut%layer == 1)), stat=stat)
    call require_memory(stat, '', size(depth), 'depths', info)
    if (stat /= 0) return
    do k = 1, size(depth)
      if (cut(k)%layer == 1) in_top(number_in_top(cut, k)) = depth(k)
    end do
  end subroutine find_depths_in_top

  !> The number of depth `k` among them.
  pure function number_in_top(cut, k) result(number)
    type(layer_cut), intent(in) :: cut(:)
    integer, intent(in) :: k
    integer :: number

    number = count(cut(:k)%layer == 1)
  end function number_in_top

end module fuge_layer_checks
