!> Influence matrices of cells on layered bodies: those of a half-space of the short waves, and the means of what the
!> layers add.
module fuge_layered_matrices
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_cell_elements, only: datum_length, FUGE_CENTRE, FUGE_MEAN
  use fuge_halfplane_influence, only: fuge_halfplane_matrix
  use fuge_halfspace_influence, only: copy_from_table, find_grid, fuge_halfspace_matrix
  use fuge_kinds, only: dp
  use fuge_layered_body_type, only: fuge_layered_body
  use fuge_ring_influence, only: fuge_ring_matrix
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_CALL_ORDER
  use fuge_wave_mixture, only: wave_mixture
  implicit none
  private

  public :: fuge_layered_halfplane_matrix, fuge_layered_halfspace_matrix, fuge_layered_ring_matrix

contains

  !> The influence matrix of cells on the surface of a layered half-plane.
  !>
  !> `body` after its `set`; the other arguments are those of fuge_halfplane_matrix without e_star. Far away
  !> displacements are those of the half-space below the layers, zero at the same distance as there; on a rigid base
  !> they fall off. Errors, alpha untouched: as there, and FUGE_ERR_CALL_ORDER for a body that is not set.
  subroutine fuge_layered_halfplane_matrix(body, x, width, element, alpha, info, symmetric)
    use fuge_layer_kernel, only: layer_kernel
    use fuge_overlap_rule, only: overlap_rule
    type(fuge_layered_body), intent(in) :: body
    real(dp), intent(in) :: x(:), width(:)
    integer, intent(in) :: element
    real(dp), intent(inout) :: alpha(:, :)
    type(fuge_info), intent(out) :: info
    logical, intent(in), optional :: symmetric
    type(wave_mixture) :: surface
    type(layer_kernel) :: kernel
    type(overlap_rule) :: rule
    real(dp) :: added, datum, observed
    logical :: folded
    integer :: i, j, stat

    call require_set(body, info)
    if (info%failed()) return
    surface = body%surface()
    folded = .false.
    if (present(symmetric)) folded = symmetric
    stat = 0
    datum = 1.0_dp
    if (surface%is_set() .and. size(x) > 0 .and. size(width) == size(x)) then
      datum = datum_length(x, width, folded)
      if (datum > 0.0_dp .and. ieee_is_finite(datum)) call kernel%set(surface, 1, datum, datum, stat)
      if (stat == 0) call rule%start(stat)
    end if
    call require_memory(stat, 'the layers under', size(x), 'cells', info)
    if (.not. info%failed()) call fuge_halfplane_matrix(x, width, body%e_star(), element, alpha, info, symmetric)
    if (info%failed() .or. .not. surface%is_set()) return
    do j = 1, size(x)
      do i = j, size(x)
        observed = merge(0.0_dp, width(i), element == FUGE_CENTRE)
        call rule%set(x(i) - x(j), width(j), observed, kernel%scale)
        added = mean_of_line(kernel, rule)
        if (folded) then
          call rule%set(x(i) + x(j), width(j), observed, kernel%scale)
          added = 0.5_dp*(added + mean_of_line(kernel, rule))
        end if
        alpha(i, j) = alpha(i, j) + added/body%e_star()
        alpha(j, i) = alpha(i, j)
      end do
    end do
  end subroutine fuge_layered_halfplane_matrix

  !> The influence matrix of rectangles on the surface of a layered half-space.
  !>
  !> `body` after its `set`; the other arguments are those of fuge_halfspace_matrix without e_star; ten arguments,
  !> because the last two are optional. Errors, alpha untouched: as there, and FUGE_ERR_CALL_ORDER for a body that is
  !> not set.
  subroutine fuge_layered_halfspace_matrix(body, x, y, width_x, width_y, element, alpha, info, symmetric_x, symmetric_y)
    use fuge_layer_kernel, only: layer_kernel
    use fuge_overlap_rule, only: overlap_rule
    type(fuge_layered_body), intent(in) :: body
    real(dp), intent(in) :: x(:), y(:), width_x(:), width_y(:)
    integer, intent(in) :: element
    real(dp), intent(inout) :: alpha(:, :)
    type(fuge_info), intent(out) :: info
    logical, intent(in), optional :: symmetric_x, symmetric_y
    type(wave_mixture) :: surface
    type(layer_kernel) :: kernel
    type(overlap_rule) :: rule(2)
    real(dp), allocatable :: table(:, :)
    real(dp) :: added, longest, observed(2), offset(2), total
    integer, allocatable :: column(:), row(:)
    integer :: extent(2), i, images(2), j, mirror(2), stat, u, v

    call require_set(body, info)
    if (info%failed()) return
    surface = body%surface()
    images = 1
    if (present(symmetric_x)) images(1) = merge(2, 1, symmetric_x)
    if (present(symmetric_y)) images(2) = merge(2, 1, symmetric_y)
    longest = farthest(x, y, width_x, width_y)
    stat = 0
    if (surface%is_set() .and. ieee_is_finite(longest)) call kernel%set(surface, 2, longest, 1.0_dp, stat)
    if (stat == 0) call rule(1)%start(stat)
    if (stat == 0) call rule(2)%start(stat)
    call require_memory(stat, 'the layers under', size(x), 'rectangles', info)
    if (.not. info%failed()) call fuge_halfspace_matrix(x, y, width_x, width_y, body%e_star(), element, alpha, info, &
                                                        symmetric_x, symmetric_y)
    if (info%failed() .or. .not. surface%is_set()) return
    ! Cells of a grid have few different distances.
    observed = merge(0.0_dp, [width_x(1), width_y(1)], element == FUGE_CENTRE)
    allocate (column(size(x)), row(size(x)), stat=stat)
    if (stat == 0) then
      call find_grid(x, y, width_x, width_y, images, column, row, mirror, extent)
      stat = minval(extent)
      if (stat >= 0) allocate (table(0:extent(1), 0:extent(2)), stat=stat)
    end if
    if (stat == 0) then
      do j = 0, extent(2)
        do i = 0, extent(1)
          offset = [i*width_x(1), j*width_y(1)]
          call mean_of_area(kernel, rule, offset, [width_x(1), width_y(1)], observed, table(i, j))
        end do
      end do
      table = table/body%e_star()
      call copy_from_table(table, column, row, images, mirror, alpha, added=.true.)
      return
    end if
    do j = 1, size(x)
      do i = j, size(x)
        if (element /= FUGE_CENTRE) observed = [width_x(i), width_y(i)]
        total = 0.0_dp
        do v = 1, images(2)
          do u = 1, images(1)
            offset = [merge(x(i) - x(j), x(i) + x(j), u == 1), merge(y(i) - y(j), y(i) + y(j), v == 1)]
            call mean_of_area(kernel, rule, offset, [width_x(j), width_y(j)], observed, added)
            total = total + added
          end do
        end do
        alpha(i, j) = alpha(i, j) + total/(real(product(images), dp)*body%e_star())
        alpha(j, i) = alpha(i, j)
      end do
    end do
  end subroutine fuge_layered_halfspace_matrix

  !> The influence matrix of rings on the surface of a layered half-space.
  !>
  !> `body` after its `set`; `radius` and `alpha` as those of fuge_ring_matrix, with the element FUGE_MEAN. Errors,
  !> alpha untouched: as there, and FUGE_ERR_CALL_ORDER for a body that is not set.
  subroutine fuge_layered_ring_matrix(body, radius, alpha, info)
    use fuge_layer_kernel, only: layer_kernel
    use fuge_ring_overlap, only: ring_overlap
    type(fuge_layered_body), intent(in) :: body
    real(dp), intent(in) :: radius(:)
    real(dp), intent(inout) :: alpha(:, :)
    type(fuge_info), intent(out) :: info
    type(wave_mixture) :: surface
    type(layer_kernel) :: kernel
    type(ring_overlap) :: overlap
    real(dp) :: longest
    integer :: i, j, stat

    call require_set(body, info)
    if (info%failed()) return
    surface = body%surface()
    longest = 2.0_dp*maxval(abs(radius))
    stat = 0
    if (surface%is_set() .and. size(radius) > 0 .and. ieee_is_finite(longest)) call kernel%set(surface, 2, longest, &
                                                                                               1.0_dp, stat)
    call require_memory(stat, 'the layers under', size(radius) - 1, 'rings', info)
    if (.not. info%failed()) call fuge_ring_matrix(radius, body%e_star(), FUGE_MEAN, alpha, info)
    if (info%failed() .or. .not. surface%is_set()) return
    call overlap%start()
    do j = 1, size(radius) - 1
      do i = j, size(radius) - 1
        alpha(i, j) = alpha(i, j) + overlap%mean_of(kernel, radius(j:j + 1), radius(i:i + 1))/body%e_star()
        alpha(j, i) = alpha(i, j)
      end do
    end do
  end subroutine fuge_layered_ring_matrix

  subroutine require_set(body, info)
    type(fuge_layered_body), intent(in) :: body
    type(fuge_info), intent(inout) :: info

    if (.not. body%is_set()) call report(info, FUGE_ERR_CALL_ORDER, 'body: no layers are set')
  end subroutine require_set

  !> A distance that none of two points of the rectangles, or of their images, exceeds; whatever it is for rectangles
  !> that are refused.
  pure function farthest(x, y, width_x, width_y) result(distance)
    real(dp), intent(in) :: x(:), y(:), width_x(:), width_y(:)
    real(dp) :: distance

    distance = 2.0_dp*(maxval(abs(x)) + maxval(abs(y)) + maxval(abs(width_x)) + maxval(abs(width_y)))
  end function farthest

  pure function mean_of_line(kernel, rule) result(mean)
    use fuge_layer_kernel, only: layer_kernel
    use fuge_overlap_rule, only: overlap_rule
    type(layer_kernel), intent(in) :: kernel
    type(overlap_rule), intent(in) :: rule
    real(dp) :: mean
    integer :: k

    mean = 0.0_dp
    do k = 1, rule%count
      mean = mean + rule%weight(k)*kernel%value_at(abs(rule%node(k)))
    end do
  end function mean_of_line

  !> The `mean` over two rectangles of these widths, `offset` from each other. `rule`: work space.
  pure subroutine mean_of_area(kernel, rule, offset, loaded, observed, mean)
    use fuge_layer_kernel, only: layer_kernel
    use fuge_overlap_rule, only: overlap_rule
    type(layer_kernel), intent(in) :: kernel
    type(overlap_rule), intent(inout) :: rule(2)
    real(dp), intent(in) :: offset(2), loaded(2), observed(2)
    real(dp), intent(out) :: mean
    real(dp) :: row, smooth(2)
    integer :: i, j

    ! Along one direction what is added is as smooth as the distance along the other one is long.
    smooth = max(kernel%scale, abs(offset) - 0.5_dp*(observed + loaded))
    call rule(1)%set(offset(1), loaded(1), observed(1), smooth(2))
    call rule(2)%set(offset(2), loaded(2), observed(2), smooth(1))
    mean = 0.0_dp
    do j = 1, rule(2)%count
      row = 0.0_dp
      do i = 1, rule(1)%count
        row = row + rule(1)%weight(i)*kernel%value_at(hypot(rule(1)%node(i), rule(2)%node(j)))
      end do
      mean = mean + rule(2)%weight(j)*row
    end do
  end subroutine mean_of_area

end module fuge_layered_matrices
