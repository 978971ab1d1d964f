!> Edges of contact on a half-plane, to third order in the cell width.
!>
!> The contact set gives an edge to half a cell; the forces give it more exactly. Let the
!> cells from an edge inwards be j = 0, 1, .. For a smooth gap their forces f_j satisfy, apart
!> from the influence of the far edge, a Toeplitz system on the half-line. Its symbol has a
!> Wiener-Hopf factorisation (M. G. Krein, Amer. Math. Soc. Transl. 22, 1962), and the
!> convolution of f with the coefficients of one factor is a polynomial in j. Four cells give
!> the coefficients of the polynomial, and these the pressure at a distance s from the
!> *effective edge*, where s = (j + `ORIGIN`) h:
!>
!>     p = D s^(-3/2) + K s^(-1/2) + L s^(1/2) + M s^(3/2) + ..
!>
!> The forces end at the effective edge; if that were the true edge, K would vanish. D is
!> the discretisation error of L. Moving an edge outwards changes the pressure at the rate
!> -K/2 times the eigensolution with s^(-3/2), which is known for one interval; from this
!> follows the shift for which K = 0. See doc/theory.md, "Edges of the contact".
module fuge_edge_refinement
  use fuge_constants, only: PI
  use fuge_halfplane_influence, only: check_halfplane, FUGE_CENTRE, FUGE_HAT
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_status, only: fuge_info, report, FUGE_ERR_SIZE, FUGE_ERR_GRID
  implicit none
  private

  public :: fuge_contact_edges

  !> Kind of an edge (`left_kind`, `right_kind`): refined, third order in the cell width. An edge
  !> of another kind is the outer edge of the last cell in contact.
  integer, parameter, public :: FUGE_EDGE_REFINED = 0
  !> Kind of an edge: not refined, because fewer than five cells are in contact.
  integer, parameter, public :: FUGE_EDGE_FEW_CELLS = 1
  !> Kind of an edge: not refined, because the pressure does not fall like a square root, as under a corner.
  integer, parameter, public :: FUGE_EDGE_SINGULAR = 2
  !> Kind of an edge: not refined, because contact reaches the last cell of the grid.
  integer, parameter, public :: FUGE_EDGE_GRID_END = 3

  !> One interval of contact: consecutive cells with a positive force.
  type, public :: fuge_interval
    !> Positions of the edges; length.
    real(dp) :: left = 0.0_dp, right = 0.0_dp
    !> Kinds of the edges: FUGE_EDGE_REFINED or why an edge is not refined.
    integer :: left_kind = FUGE_EDGE_FEW_CELLS, right_kind = FUGE_EDGE_FEW_CELLS
    !> Numbers of the first and the last cell, from 1.
    integer :: first = 0, last = 0
  end type fuge_interval

  !> Cells from which an edge is computed, and the fewest of an interval: with only four, both
  !> edges would be computed from the same cells.
  integer, parameter :: CELLS = 4
  integer, parameter :: FEWEST = CELLS + 1

  !> First coefficients of the Wiener-Hopf factor, for FUGE_CENTRE and for the other two
  !> elements, which have the same matrix; and the distance of the centre of cell 0 from the
  !> effective edge, in cells. Computed from the symbols by quadrature, which
  !> test_edge_refinement repeats; public for that test.
  real(dp), parameter, public :: FACTOR(CELLS, 2) = reshape([ &
    1.0_dp, 0.5740070068596145_dp, 0.4143161456561956_dp, 0.3418239079354555_dp, &
    1.0_dp, 0.6514640003861043_dp, 0.4519323409169976_dp, 0.3701790118360726_dp], [CELLS, 2])
  real(dp), parameter, public :: ORIGIN(2) = [0.32534677144_dp, 0.38494788139_dp]

  !> For a smooth gap the true edge lies within about half a cell of `TYPICAL`, counted outwards
  !> from the edge of the cell: otherwise the cell would pull or the next one overlap. A shift
  !> that differs by more than `REACH` belongs to no such edge; the largest difference in tests,
  !> on five cells, is 0.62.
  real(dp), parameter :: TYPICAL = -0.15_dp, REACH = 0.85_dp

  !> Largest error of centres and widths, in cells.
  real(dp), parameter :: PLACE_TOLERANCE = 1.0e-6_dp

  !> Coefficients D, K, L and M of the pressure near an effective edge, with h = 1.
  type :: expansion
    real(dp) :: d, k, l, m
  end type expansion

contains

  !> The intervals of contact and their edges, from forces on a uniform grid.
  !>
  !> `x` (n) centres and `width` (n) widths of the cells, all equal and side by side,
  !> ascending, length; `force` (n), in contact where positive; `element` as for
  !> `fuge_halfplane_matrix`; out: `intervals`, from left to right. `symmetric` (default
  !> .false.): a folded problem, x(1) = 0 or width/2 if it starts on the axis; an interval
  !> that touches the axis is returned whole, left = -right, of others the right image.
  !>
  !> For a smooth gap the error is of third order in the width; of second order with a
  !> small factor if there are other contacts or the far edge is a corner. For FUGE_MEAN the
  !> gap has to be the mean over the cell too; if it is the gap at the centre, pass
  !> FUGE_HAT, whose forces are the same. An edge that cannot be refined is the outer
  !> edge of the last cell with a force, and its kind says why:
  !>
  !> - FUGE_EDGE_FEW_CELLS: fewer than five cells in contact;
  !> - FUGE_EDGE_SINGULAR: the pressure does not fall like a square root there, as under
  !>   a corner;
  !> - FUGE_EDGE_GRID_END: contact reaches the last cell of the grid.
  !>
  !> The grid is not taken as periodic. Without forces there are no intervals.
  !> Errors, `intervals` untouched: those of `fuge_halfplane_matrix` for the cells;
  !> FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE for `force`; FUGE_ERR_GRID unless the grid is uniform.
  pure subroutine fuge_contact_edges(x, width, force, element, intervals, info, symmetric)
    real(dp), intent(in) :: x(:), width(:), force(:)
    integer, intent(in) :: element
    type(fuge_interval), allocatable, intent(inout) :: intervals(:)
    type(fuge_info), intent(out) :: info
    logical, intent(in), optional :: symmetric
    logical :: folded
    integer :: k

    folded = .false.
    if (present(symmetric)) folded = symmetric
    call check_edges(x, width, force, element, folded, info)
    if (info%failed()) return

    intervals = contact_runs(force)
    do k = 1, size(intervals)
      call find_edges(x, width(1), force, element, folded, intervals(k))
    end do
  end subroutine fuge_contact_edges

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
      if (abs(width(k) - h) <= PLACE_TOLERANCE*h .and. abs(x(k) - x(k - 1) - h) <= PLACE_TOLERANCE*h) cycle
      call report(info, FUGE_ERR_GRID, 'cell '//index_text(k)//' at x = '//text(x(k))//' of width '//text(width(k)) &
                  //' does not continue a uniform grid of width '//text(h))
      return
    end do
    if (.not. folded .or. is_on_axis(x(1), h) .or. x(1) >= h) return
    if (abs(x(1) - 0.5_dp*h) <= PLACE_TOLERANCE*h) return
    call report(info, FUGE_ERR_GRID, 'x('//index_text(1)//') = '//text(x(1)) &
                //': a symmetric uniform grid starts at 0, at width/2, or at a width or more')
  end subroutine check_uniform

  !> Is the cell its own mirror image?
  pure function is_on_axis(x, h)
    real(dp), intent(in) :: x, h
    logical :: is_on_axis

    is_on_axis = abs(x) <= PLACE_TOLERANCE*h
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

  !> Complete an interval that has its `first` and `last` cell.
  pure subroutine find_edges(x, h, force, element, folded, interval)
    real(dp), intent(in) :: x(:), h, force(:)
    integer, intent(in) :: element
    logical, intent(in) :: folded
    type(fuge_interval), intent(inout) :: interval
    real(dp) :: outward(2)
    integer :: kind(2)

    interval%right = x(interval%last) + 0.5_dp*h
    kind = FUGE_EDGE_FEW_CELLS
    if (interval%last == size(x)) kind(2) = FUGE_EDGE_GRID_END
    if (folded .and. interval%first == 1 .and. x(1) < 0.75_dp*h) then
      interval%left = -interval%right
      kind(1) = kind(2)
      call refine_run(unfolded_forces(force(:interval%last), is_on_axis(x(1), h)), element, outward, kind)
    else
      interval%left = x(interval%first) - 0.5_dp*h
      if (interval%first == 1) kind(1) = FUGE_EDGE_GRID_END
      call refine_run(force(interval%first:interval%last), element, outward, kind)
    end if
    interval%left = interval%left - h*outward(1)
    interval%right = interval%right + h*outward(2)
    interval%left_kind = kind(1)
    interval%right_kind = kind(2)
  end subroutine find_edges

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

  !> How far the left and the right edge lie outside of the cells of `force`, in cells. On entry
  !> `kind` is FUGE_EDGE_GRID_END for an edge that must not be refined.
  pure subroutine refine_run(force, element, outward, kind)
    real(dp), intent(in) :: force(:)
    integer, intent(in) :: element
    real(dp), intent(out) :: outward(2)
    integer, intent(inout) :: kind(2)
    type(expansion) :: edges(2)
    real(dp) :: effective, length, shift(2)
    logical :: regular(2)
    integer :: n, edge

    outward = 0.0_dp
    n = size(force)
    if (n < FEWEST) return
    edges(1) = pressure_expansion(force(:CELLS)/maxval(force), element)
    edges(2) = pressure_expansion(force(n:n - CELLS + 1:-1)/maxval(force), element)
    ! From the edge of the cell outwards to the effective edge.
    effective = ORIGIN(element_column(element)) - 0.5_dp
    length = real(n, dp) + 2.0_dp*effective

    ! An edge that is not refined is the edge of the cell.
    shift = -effective
    do edge = 1, 2
      if (kind(edge) /= FUGE_EDGE_GRID_END) call estimate_shift(edges(edge), effective, shift(edge), kind(edge))
    end do
    regular = kind == FUGE_EDGE_REFINED
    do edge = 1, 2
      if (.not. regular(edge)) cycle
      outward(edge) = effective + corrected_shift(edges(edge), edges(3 - edge), shift(3 - edge), length, &
                                                    regular(3 - edge))
      if (within_reach(outward(edge))) cycle
      outward(edge) = 0.0_dp
      kind(edge) = FUGE_EDGE_SINGULAR
    end do
  end subroutine refine_run

  !> Shift d of the true edge from the effective one to first order, in cells: p ~ L sqrt(s + d) =
  !> L s^(1/2) + (L d/2) s^(-1/2) + .. Unchanged where the edge is singular.
  pure subroutine estimate_shift(edge, effective, shift, kind)
    type(expansion), intent(in) :: edge
    real(dp), intent(in) :: effective
    real(dp), intent(inout) :: shift
    integer, intent(out) :: kind

    kind = FUGE_EDGE_SINGULAR
    ! The largest force is 1: a smaller L is rounding.
    if (edge%l <= sqrt(epsilon(edge%l))) return
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
    type(expansion), intent(in) :: edge, far
    real(dp), intent(in) :: far_shift, length
    logical, intent(in) :: regular
    real(dp) :: shift, far_k, k

    far_k = far%k
    if (regular) far_k = 0.5_dp*far_k
    k = edge%k - (0.5_dp*edge%d + far%d)/length - 0.5_dp*far_k*far_shift/length
    shift = 2.0_dp*k/edge%l
    shift = shift + shift**2*(0.75_dp*edge%m/edge%l - 0.125_dp/length)
  end function corrected_shift

  !> The column of `FACTOR` for an element.
  pure function element_column(element)
    integer, intent(in) :: element
    integer :: element_column

    element_column = 2
    if (element == FUGE_CENTRE) element_column = 1
  end function element_column

  !> The pressure near an edge, from the forces of the first cells there.
  !>
  !> With z = exp(-zeta) the factor behaves like zeta^(-1/2) (1 + factor_bend zeta^2/2), and a_k is the
  !> coefficient of zeta^-k in the generating function of the polynomial, sum_k b_k (1 - z)^-k;
  !> `ORIGIN` accounts for exp(zeta/2). zeta^(1/2 - k) stands for s^(k - 3/2)/Gamma(k - 1/2). The
  !> force of a cell is p - curvature p''.
  pure function pressure_expansion(force, element) result(edge)
    real(dp), intent(in) :: force(CELLS)
    integer, intent(in) :: element
    type(expansion) :: edge
    real(dp) :: b(CELLS), a(0:3), factor_bend, curvature

    b = newton_coefficients(series_product(force, FACTOR(:, element_column(element))))
    a(0) = (b(2) + b(3))/24.0_dp
    a(1) = b(1) + b(2)/2.0_dp + 3.0_dp*b(3)/8.0_dp + 5.0_dp*b(4)/16.0_dp
    a(2) = b(2) + b(3) + 23.0_dp*b(4)/24.0_dp
    a(3) = b(3) + 1.5_dp*b(4)

    factor_bend = 1.0_dp/12.0_dp
    if (element == FUGE_CENTRE) factor_bend = 1.0_dp/24.0_dp
    curvature = 1.0_dp/24.0_dp
    if (element == FUGE_HAT) curvature = 1.0_dp/12.0_dp
    a(0:1) = a(0:1) + (curvature - 0.5_dp*factor_bend)*a(2:3)

    edge%d = -a(0)/(2.0_dp*sqrt(PI))
    edge%k = a(1)/sqrt(PI)
    edge%l = 2.0_dp*a(2)/sqrt(PI)
    edge%m = 4.0_dp*a(3)/(3.0_dp*sqrt(PI))
  end function pressure_expansion

  !> Product of two power series, to the order of `f`.
  pure function series_product(f, g) result(product)
    real(dp), intent(in) :: f(:), g(:)
    real(dp) :: product(size(f))
    integer :: j

    do j = 1, size(f)
      product(j) = dot_product(f(:j), g(j:1:-1))
    end do
  end function series_product

  !> Coefficients b_k of q(j) = sum_k b_k binomial(j + k - 1, k - 1), from q(0), q(1), ..:
  !> Newton's backward differences of the polynomial at j = -1.
  pure function newton_coefficients(q) result(b)
    real(dp), intent(in) :: q(:)
    real(dp) :: b(size(q))
    integer :: j, k

    b = q
    ! Forward differences at 0 first.
    do k = 2, size(q)
      do j = size(q), k, -1
        b(j) = b(j) - b(j - 1)
      end do
    end do
    ! E^-1 once for the value at -1, and once more for each order of backward difference.
    do k = 1, size(q)
      do j = size(q) - 1, k, -1
        b(j) = b(j) - b(j + 1)
      end do
    end do
  end function newton_coefficients

end module fuge_edge_refinement
