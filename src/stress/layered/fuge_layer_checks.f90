!> A body of layers at the depths that the caller asks for.
module fuge_layer_checks
  use fuge_kinds, only: dp
  use fuge_layer_interior, only: find_cut, layer_cut
  use fuge_layer_stack, only: layer_stack
  use fuge_layered_body_type, only: copy_layers, fuge_layered_body
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_CALL_ORDER, FUGE_ERR_GRID, FUGE_ERR_SIZE
  implicit none
  private

  public :: cut_body, find_depths_in_top, number_in_top

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
    call copy_layers(body, stack, info)
    if (info%failed()) return
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
