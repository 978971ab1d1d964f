!> The edges of `fuge_edge_refinement`.
submodule(fuge_edge_refinement) fuge_edge_search
  use fuge_contact_states, only: FUGE_LIMITED_LOWER
  use fuge_edge_estimates, only: bed_edge, limited_edge, BED_CELLS
  use fuge_edge_expansion, only: edge_expansion, effective_edge, pressure_expansion, shift_error, CELLS, JUDGED, &
    SMALLEST_L
  use fuge_halfplane_influence, only: check_halfplane
  use fuge_input_checks, only: check_finite
  use fuge_law_checks, only: check_stiffnesses
  use fuge_number_text, only: index_text, text
  use fuge_status, only: report, FUGE_ERR_SIZE, FUGE_ERR_GRID
  implicit none

  !> Equal cells side by side, checked.
  type :: loaded_cells
    !> Centres; width.
    real(dp), allocatable :: x(:)
    real(dp) :: h = 0.0_dp
    real(dp), allocatable :: force(:)
    !> Cells whose forces have reached the limit, and cells on a bed.
    logical, allocatable :: limited(:), on_bed(:)
    integer :: element = 0
    !> Half of a symmetric model?
    logical :: folded = .false.
  end type loaded_cells

  !> The cells of an interval, of a folded one those on both sides of the axis.
  type :: contact_run
    real(dp), allocatable :: force(:)
    !> Cells from the left and from the right edge inwards up to the first one whose force has reached its limit.
    integer :: unlimited(2) = 0
    !> Is the last cell at an edge on a bed?
    logical :: on_bed(2) = .false.
    integer :: element = 0
  end type contact_run

  !> The fewest cells of an interval: with only four, both edges would be computed from the same cells.
  integer, parameter :: FEWEST = CELLS + 1

  !> For a smooth gap the true edge lies within about half a cell of `TYPICAL`, counted outwards
  !> from the edge of the cell: otherwise the cell would pull or the next one overlap. A shift
  !> that differs by more than `REACH` belongs to no such edge; the largest difference in tests,
  !> on five cells, is 0.62.
  real(dp), parameter :: TYPICAL = -0.15_dp, REACH = 0.85_dp

  !> The neglected influence of other contacts, and of corners, shifts an edge by about BY_OTHERS over the number of
  !> cells in the contact, and one that faces another contact by BY_FACING over that of open cells between, in cells.
  !> From the tests.
  real(dp), parameter :: BY_OTHERS = 0.1_dp, BY_FACING = 0.3_dp

  !> A bed shifts an edge at which the pressure falls rather like a square root by less than this fraction of the
  !> difference between the two fits. From the tests.
  real(dp), parameter :: BY_BED = 0.1_dp

  !> Centres and widths of a uniform grid may be wrong by this much, in cells.
  real(dp), parameter :: POSITION_TOLERANCE = 1.0e-6_dp

contains

  module procedure fuge_contact_edges
    type(loaded_cells) :: cells
    integer :: k

    if (present(symmetric)) cells%folded = symmetric
    call check_edges(x, width, force, element, cells%folded, info)
    if (.not. info%failed()) call check_laws(size(x), state, compliance, info)
    if (info%failed()) return

    allocate (cells%x, source=x)
    allocate (cells%force, source=force)
    cells%h = width(1)
    cells%element = element
    allocate (cells%limited(size(x)), cells%on_bed(size(x)), source=.false.)
    if (present(state)) cells%limited = state == FUGE_LIMITED_LOWER
    if (present(compliance)) cells%on_bed = compliance > 0.0_dp
    intervals = contact_runs(force)
    do k = 1, size(intervals)
      call find_edges(cells, distances(intervals, k, x, width(1), cells%folded), intervals(k))
    end do
  end procedure fuge_contact_edges

  pure subroutine check_laws(n, state, compliance, info)
    integer, intent(in) :: n
    integer, intent(in), optional :: state(:)
    real(dp), intent(in), optional :: compliance(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: values(:)

    if (present(state)) then
      if (size(state) /= n) then
        call report(info, FUGE_ERR_SIZE, 'state has '//text(size(state))//' value(s), x has '//text(n))
        return
      end if
    end if
    if (present(compliance)) values = compliance
    call check_stiffnesses(values, n, 'compliance', info)
  end subroutine check_laws

  pure subroutine check_edges(x, width, force, element, folded, info)
    real(dp), intent(in) :: x(:), width(:), force(:)
    integer, intent(in) :: element
    logical, intent(in) :: folded
    type(fuge_info), intent(inout) :: info
    real(dp), parameter :: ANY_MODULUS = 1.0_dp

    call check_halfplane(x, width, ANY_MODULUS, element, folded, info)
    if (info%failed()) return
    if (size(force) /= size(x)) then
      call report(info, FUGE_ERR_SIZE, 'force has '//text(size(force))//' value(s), x has '//text(size(x)))
      return
    end if
    call check_finite(force, 'force', info)
    if (.not. info%failed()) call check_uniform(x, width, folded, info)
  end subroutine check_edges

  pure subroutine check_uniform(x, width, folded, info)
    real(dp), intent(in) :: x(:), width(:)
    logical, intent(in) :: folded
    type(fuge_info), intent(inout) :: info
    real(dp) :: h
    integer :: k

    h = width(1)
    do k = 2, size(x)
      if (abs(width(k) - h) <= POSITION_TOLERANCE*h .and. abs(x(k) - x(k - 1) - h) <= POSITION_TOLERANCE*h) cycle
      call report(info, FUGE_ERR_GRID, 'cell '//index_text(k)//' at x = '//text(x(k))//' of width '//text(width(k)) &
                  //' does not continue a uniform grid of width '//text(h))
      return
    end do
    if (.not. folded .or. is_on_axis(x(1), h) .or. x(1) >= h) return
    if (abs(x(1) - 0.5_dp*h) <= POSITION_TOLERANCE*h) return
    call report(info, FUGE_ERR_GRID, 'x('//index_text(1)//') = '//text(x(1)) &
                //': a symmetric uniform grid starts at 0, at width/2, or at a width or more')
  end subroutine check_uniform

  !> Is the cell its own mirror image?
  pure function is_on_axis(x, h)
    real(dp), intent(in) :: x, h
    logical :: is_on_axis

    is_on_axis = abs(x) <= POSITION_TOLERANCE*h
  end function is_on_axis

  !> The intervals of positive forces, with their cells `first` and `last`.
  pure function contact_runs(force) result(intervals)
    real(dp), intent(in) :: force(:)
    type(fuge_interval), allocatable :: intervals(:)
    logical :: touches(0:size(force))
    integer :: k, current

    touches(0) = .false.
    touches(1:) = force > 0.0_dp
    allocate (intervals(count(touches(1:) .and. .not. touches(:size(force) - 1))))
    current = 0
    do k = 1, size(force)
      if (.not. touches(k)) cycle
      if (.not. touches(k - 1)) then
        current = current + 1
        intervals(current)%first = k
      end if
      intervals(current)%last = k
    end do
  end function contact_runs

  !> Distances of interval k from the next ones on its left and on its right, the mirror image in a folded problem one
  !> of them, in cells of width `h`; huge if there are none.
  pure function distances(intervals, k, x, h, folded) result(distance)
    type(fuge_interval), intent(in) :: intervals(:)
    integer, intent(in) :: k
    real(dp), intent(in) :: x(:), h
    logical, intent(in) :: folded
    real(dp) :: distance(2)

    distance = huge(distance)
    if (k > 1) then
      distance(1) = real(intervals(k)%first - intervals(k - 1)%last - 1, dp)
    else if (folded .and. .not. touches_axis(intervals(k), x, h)) then
      distance(1) = 2.0_dp*(x(intervals(k)%first)/h) - 1.0_dp
    end if
    if (k < size(intervals)) distance(2) = real(intervals(k + 1)%first - intervals(k)%last - 1, dp)
    if (folded .and. touches_axis(intervals(k), x, h)) distance(1) = distance(2)
  end function distances

  !> In a folded problem: is the interval one with its mirror image?
  pure function touches_axis(interval, x, h)
    type(fuge_interval), intent(in) :: interval
    real(dp), intent(in) :: x(:), h
    logical :: touches_axis

    touches_axis = interval%first == 1 .and. x(1) < 0.75_dp*h
  end function touches_axis

  !> Complete an interval that has its `first` and `last` cell, with the `distance` of the next ones on either side.
  pure subroutine find_edges(cells, distance, interval)
    type(loaded_cells), intent(in) :: cells
    real(dp), intent(in) :: distance(2)
    type(fuge_interval), intent(inout) :: interval
    real(dp) :: error(2), outward(2)
    integer :: kind(2)
    logical :: whole

    whole = cells%folded .and. touches_axis(interval, cells%x, cells%h)
    interval%right = cells%x(interval%last) + 0.5_dp*cells%h
    interval%left = cells%x(interval%first) - 0.5_dp*cells%h
    kind = FUGE_EDGE_FEW_CELLS
    if (interval%first == 1) kind(1) = FUGE_EDGE_GRID_END
    if (interval%last == size(cells%x)) kind(2) = FUGE_EDGE_GRID_END
    if (whole) interval%left = -interval%right
    if (whole) kind(1) = kind(2)
    call refine_run(run_of(cells, interval, whole), distance, outward, error, kind)
    interval%left = interval%left - cells%h*outward(1)
    interval%right = interval%right + cells%h*outward(2)
    interval%left_error = cells%h*error(1)
    interval%right_error = cells%h*error(2)
    interval%left_kind = kind(1)
    interval%right_kind = kind(2)
  end subroutine find_edges

  !> The cells of an interval; of a folded problem both sides if it is one with its mirror image (`whole`).
  pure function run_of(cells, interval, whole) result(run)
    type(loaded_cells), intent(in) :: cells
    type(fuge_interval), intent(in) :: interval
    logical, intent(in) :: whole
    type(contact_run) :: run
    logical, allocatable :: limited(:)
    integer :: side

    run%element = cells%element
    if (whole) then
      allocate (run%force, source=unfolded_forces(cells%force(:interval%last), is_on_axis(cells%x(1), cells%h)))
    else
      allocate (run%force, source=cells%force(interval%first:interval%last))
    end if
    run%on_bed = cells%on_bed([interval%first, interval%last])
    allocate (limited, source=cells%limited(interval%first:interval%last))
    run%unlimited = [cells_before(limited), cells_before(limited(size(limited):1:-1))]
    if (.not. whole) return
    do side = 1, 2
      run%on_bed(side) = cells%on_bed(interval%last)
      run%unlimited(side) = run%unlimited(2)
      if (.not. any(limited)) run%unlimited(side) = size(run%force)
    end do
  end function run_of

  !> Cells before the first one that is marked.
  pure function cells_before(marked) result(n)
    logical, intent(in) :: marked(:)
    integer :: n

    do n = 0, size(marked) - 1
      if (marked(n + 1)) exit
    end do
  end function cells_before

  !> The forces on both sides of the axis, from the half model that has their sums.
  pure function unfolded_forces(half, own_image) result(whole)
    real(dp), intent(in) :: half(:)
    logical, intent(in) :: own_image
    real(dp), allocatable :: whole(:)
    integer :: n

    n = size(half)
    if (own_image) then
      allocate (whole(2*n - 1), source=[0.5_dp*half(n:2:-1), half(1), 0.5_dp*half(2:)])
    else
      allocate (whole(2*n), source=[0.5_dp*half(n:1:-1), 0.5_dp*half])
    end if
  end function unfolded_forces

  !> How far the left and the right edge lie outside of the cells of `run`, and the `error` of that, in cells. On
  !> entry `kind` is FUGE_EDGE_GRID_END for an edge that must not be refined; `distance` in cells.
  pure subroutine refine_run(run, distance, outward, error, kind)
    type(contact_run), intent(in) :: run
    real(dp), intent(in) :: distance(2)
    real(dp), intent(out) :: outward(2), error(2)
    integer, intent(inout) :: kind(2)
    real(dp) :: force(min(size(run%force), JUDGED), 2)
    integer :: m, n

    outward = 0.0_dp
    error = 1.0_dp
    n = size(run%force)
    ! Column k: the forces from edge k inwards.
    m = size(force, 1)
    force(:, 1) = run%force(:m)/maxval(run%force)
    force(:, 2) = run%force(n:n - m + 1:-1)/maxval(run%force)
    where (kind /= FUGE_EDGE_GRID_END .and. run%unlimited < min(n, FEWEST)) kind = FUGE_EDGE_LIMITED
    if (n >= FEWEST) then
      call refine_square_roots(run, force, distance, outward, error, kind)
      call refine_on_bed(run, force, outward, error, kind)
    end if
    call place_limited(run, force, outward, kind)
  end subroutine refine_run

  !> Edges that the limit of the forces has come close to, of kind FUGE_EDGE_LIMITED.
  pure subroutine place_limited(run, force, outward, kind)
    type(contact_run), intent(in) :: run
    real(dp), intent(in) :: force(:, :)
    real(dp), intent(inout) :: outward(2)
    integer, intent(in) :: kind(2)
    integer :: edge

    do edge = 1, 2
      if (kind(edge) /= FUGE_EDGE_LIMITED) cycle
      associate (n => run%unlimited(edge))
        outward(edge) = limited_edge(force(:n, edge)/force(n + 1, edge))
      end associate
    end do
  end subroutine place_limited

  !> Edges on a bed: refined anew where the pressure is rather smooth than like a square root.
  pure subroutine refine_on_bed(run, force, outward, error, kind)
    type(contact_run), intent(in) :: run
    real(dp), intent(in) :: force(:, :)
    real(dp), intent(inout) :: outward(2), error(2)
    integer, intent(inout) :: kind(2)
    real(dp) :: on_bed, error_on_bed
    integer :: edge

    do edge = 1, 2
      if (.not. run%on_bed(edge) .or. any(kind(edge) == [FUGE_EDGE_GRID_END, FUGE_EDGE_LIMITED])) cycle
      call bed_edge(force(:BED_CELLS, edge), TYPICAL - REACH, TYPICAL + REACH, on_bed, error_on_bed)
      if (error_on_bed >= error(edge)) then
        ! The square root's estimate does not see what even a stiff bed changes.
        error(edge) = max(error(edge), BY_BED*abs(on_bed - outward(edge)))
        cycle
      end if
      outward(edge) = on_bed
      error(edge) = error_on_bed
      kind(edge) = FUGE_EDGE_REFINED
    end do
  end subroutine refine_on_bed

  !> Edges at which the pressure falls like a square root.
  pure subroutine refine_square_roots(run, force, distance, outward, error, kind)
    type(contact_run), intent(in) :: run
    real(dp), intent(in) :: force(:, :), distance(2)
    real(dp), intent(inout) :: outward(2), error(2)
    integer, intent(inout) :: kind(2)
    type(edge_expansion) :: edges(2)
    real(dp) :: effective, length, shift(2)
    logical :: regular(2)
    integer :: n, edge

    n = size(run%force)
    effective = effective_edge(run%element)
    length = real(n, dp) + 2.0_dp*effective

    ! An edge that is not refined is the edge of the cell.
    shift = -effective
    do edge = 1, 2
      if (run%unlimited(edge) < FEWEST) cycle
      edges(edge) = pressure_expansion(force(:CELLS, edge), run%element)
      error(edge) = shift_error(force(:min(run%unlimited(edge), JUDGED), edge), run%element, edges(edge))
      if (kind(edge) /= FUGE_EDGE_GRID_END) call estimate_shift(edges(edge), effective, shift(edge), kind(edge))
    end do
    regular = kind == FUGE_EDGE_REFINED
    do edge = 1, 2
      if (.not. regular(edge)) cycle
      outward(edge) = effective + corrected_shift(edges(edge), edges(3 - edge), shift(3 - edge), length, &
                                                    regular(3 - edge))
      error(edge) = error(edge) + BY_FACING/distance(edge)
      if (.not. regular(3 - edge) .or. any(distance < huge(distance)) .or. any(run%unlimited < n)) &
        error(edge) = error(edge) + BY_OTHERS/real(min(n, run%unlimited(edge)), dp)
      if (within_reach(outward(edge))) cycle
      outward(edge) = 0.0_dp
      kind(edge) = FUGE_EDGE_SINGULAR
    end do
    where (kind /= FUGE_EDGE_REFINED) error = 1.0_dp
    error = min(error, 1.0_dp)
  end subroutine refine_square_roots

  !> Shift d of the true edge from the effective one to first order, in cells: p ~ L sqrt(s + d) =
  !> L s^(1/2) + (L d/2) s^(-1/2) + .. Unchanged where the edge is singular.
  pure subroutine estimate_shift(edge, effective, shift, kind)
    type(edge_expansion), intent(in) :: edge
    real(dp), intent(in) :: effective
    real(dp), intent(inout) :: shift
    integer, intent(out) :: kind

    kind = FUGE_EDGE_SINGULAR
    if (edge%l <= SMALLEST_L) return
    if (.not. within_reach(effective + 2.0_dp*edge%k/edge%l)) return
    kind = FUGE_EDGE_REFINED
    shift = 2.0_dp*edge%k/edge%l
  end subroutine estimate_shift

  !> Can the edge of a smooth gap lie so far outside of the last cell, in cells?
  elemental function within_reach(outward)
    real(dp), intent(in) :: outward
    logical :: within_reach

    within_reach = abs(outward - TYPICAL) <= REACH
  end function within_reach

  !> Shift of the true edge from the effective one to second order, in cells. The far edge is
  !> shifted by `far_shift`, which brings K there to zero if that edge is `regular`.
  !>
  !> The eigensolution of an interval of length l is s^(-3/2) (1 - s/l)^(-1/2) at its
  !> own edge, and (1/l) s'^(-1/2) at the far one.
  pure function corrected_shift(edge, far, far_shift, length, regular) result(shift)
    type(edge_expansion), intent(in) :: edge, far
    real(dp), intent(in) :: far_shift, length
    logical, intent(in) :: regular
    real(dp) :: shift, far_k, k

    far_k = far%k
    if (regular) far_k = 0.5_dp*far_k
    k = edge%k - (0.5_dp*edge%d + far%d)/length - 0.5_dp*far_k*far_shift/length
    shift = 2.0_dp*k/edge%l
    shift = shift + shift**2*(0.75_dp*edge%m/edge%l - 0.125_dp/length)
  end function corrected_shift

end submodule fuge_edge_search
