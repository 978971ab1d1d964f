!> Rims of a contact where the pressure is infinite: under the edge of a flat punch, under a corner.
!>
!> Near such a rim the pressure is K s**(-1/2) + L s**(1/2), s being the distance from it, and a fit to the second cell
!> and the next ones foretells the first one; under a smooth body K is 0, or, because the contact ends within a cell,
!> small (K. L. Johnson, Contact Mechanics, 1985, sections 2.8 and 5.1).
module fuge_pressure_rims
  use fuge_heap_sort, only: heap_sort
  use fuge_kinds, only: dp
  use fuge_pressed_cells, only: pressed_cells
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: find_singular_rim

  !> Cells of a fit at most; at least for a contact in one piece on a line, for an area, for a contact in pieces. From
  !> each side of a run of cells they reach to its middle.
  integer, parameter :: MOST_FITTED = 7, FITTED_WHOLE = 4, FITTED_AREA = 5, FITTED_PIECE = 7
  !> A shorter run of cells side by side has too few for any fit.
  integer, parameter :: SHORTEST_RUN = 2*(FITTED_WHOLE - 1)
  !> On an area at least this number of neighbouring rows has such a rim.
  integer, parameter :: ROWS = 3
  !> The least ratio of the pressure of the first cell to that of any other one: 2.4 for K alone and the second cell.
  !> With 1.5 a square root with the same K and L would end three cells beyond the rim.
  real(dp), parameter :: LEAST_DROP = 1.5_dp
  !> The fit is good if its errors are below FIT_ERROR of the largest pressure in it, and if the first cell, where the
  !> discrete forces differ from the means of the pressure by up to 16 %, is in this range of the value foretold.
  real(dp), parameter :: FIT_ERROR = 0.09_dp, FIRST_RANGE(2) = [0.65_dp, 1.4_dp]
  !> Relative tolerance for cells side by side.
  real(dp), parameter :: PLACE_TOLERANCE = 1.0e-3_dp

  !> A singular rim of one row of cells; `side` -1 or 1. `chain` counts the neighbouring rows with one.
  type :: rim
    integer :: row = 0, side = 0, chain = 1
    real(dp) :: edge = 0.0_dp, across = 0.0_dp, width(2) = 0.0_dp, strength = 0.0_dp
  end type rim

contains

  !> The rim with the strongest singularity: `found`, and its `place` on the surface, x and y. Error: FUGE_ERR_MEMORY.
  pure subroutine find_singular_rim(cells, found, place, info)
    type(pressed_cells), intent(in) :: cells
    logical, intent(out) :: found
    real(dp), intent(out) :: place(2)
    type(fuge_info), intent(inout) :: info
    integer, allocatable :: order(:)
    type(rim), allocatable :: rims(:)
    real(dp) :: strength
    integer :: along, k, stat

    found = .false.
    place = 0.0_dp
    if (info%failed()) return
    ! A run of cells side by side has two rims at most.
    allocate (order(size(cells%pressure)), rims(2*size(cells%pressure)/SHORTEST_RUN), stat=stat)
    call require_memory(stat, 'the order of', size(cells%pressure), 'cells', info)
    if (stat /= 0) return
    order = [(k, k=1, size(order))]
    strength = 0.0_dp
    do along = 1, cells%axes
      call search_rows(cells, along, order, rims, strength, place)
    end do
    found = strength > 0.0_dp
  end subroutine find_singular_rim

  !> Search the rows of cells along one axis for a stronger rim than `strength`.
  pure subroutine search_rows(cells, along, order, rims, strength, place)
    type(pressed_cells), intent(in) :: cells
    integer, intent(in) :: along
    integer, intent(inout) :: order(:)
    type(rim), intent(inout) :: rims(:)
    real(dp), intent(inout) :: strength, place(2)
    integer :: across, first, last, row, number, needed, k

    across = cells%axes + 1 - along
    if (cells%axes == 2) call heap_sort(cells%centre(across, :), order)
    number = 0
    row = 0
    first = 1
    do while (first <= size(order))
      last = first
      if (cells%axes == 1) last = size(order)
      do while (last < size(order))
        if (.not. same_row(cells, across, order(first), order(last + 1))) exit
        last = last + 1
      end do
      row = row + 1
      call heap_sort(cells%centre(along, :), order(first:last))
      call search_row(cells, along, order(first:last), row, rims, number)
      first = last + 1
    end do
    needed = 1
    if (cells%axes == 2) needed = min(ROWS, row)
    do k = 1, number
      if (rims(k)%chain < needed .or. rims(k)%strength <= strength) cycle
      strength = rims(k)%strength
      place(along) = rims(k)%edge
      if (cells%axes == 2) place(across) = rims(k)%across
    end do
  end subroutine search_rows

  pure function same_row(cells, across, i, j) result(same)
    type(pressed_cells), intent(in) :: cells
    integer, intent(in) :: across, i, j
    logical :: same

    same = abs(cells%centre(across, i) - cells%centre(across, j)) <= PLACE_TOLERANCE*cells%width(across, i)
  end function same_row

  !> Add the singular rims of a sorted `row` to the list.
  pure subroutine search_row(cells, along, order, row, rims, number)
    type(pressed_cells), intent(in) :: cells
    integer, intent(in) :: along, order(:), row
    type(rim), intent(inout) :: rims(:)
    integer, intent(inout) :: number
    integer :: first, last

    first = 1
    do while (first <= size(order))
      last = first
      do while (last < size(order))
        if (.not. side_by_side(cells, along, order(last), order(last + 1))) exit
        last = last + 1
      end do
      call try_rim(cells, along, order(first:last), size(order), -1, row, rims, number)
      call try_rim(cells, along, order(last:first:-1), size(order), 1, row, rims, number)
      first = last + 1
    end do
  end subroutine search_row

  pure function side_by_side(cells, along, i, j) result(adjacent)
    type(pressed_cells), intent(in) :: cells
    integer, intent(in) :: along, i, j
    logical :: adjacent
    real(dp) :: between

    between = (cells%centre(along, j) - cells%centre(along, i)) &
              - 0.5_dp*(cells%width(along, i) + cells%width(along, j))
    adjacent = abs(between) <= PLACE_TOLERANCE*min(cells%width(along, i), cells%width(along, j))
  end function side_by_side

  !> Add the rim at the first one of the cells `run`, inwards, if it is singular. `in_row` cells are in the row.
  pure subroutine try_rim(cells, along, run, in_row, side, row, rims, number)
    type(pressed_cells), intent(in) :: cells
    integer, intent(in) :: along, run(:), in_row, side, row
    type(rim), intent(inout) :: rims(:)
    integer, intent(inout) :: number
    type(rim) :: new
    integer :: fitted, needed

    needed = FITTED_PIECE
    if (cells%axes == 2) needed = FITTED_AREA
    if (cells%axes == 1 .and. size(run) == in_row) needed = FITTED_WHOLE
    fitted = min(MOST_FITTED, size(run)/2 + 1)
    if (fitted < needed) return
    new%strength = singularity(cells%width(along, run(:fitted)), cells%pressure(run(:fitted)))
    if (.not. new%strength > 0.0_dp) return
    new%row = row
    new%side = side
    new%width = cells%width(along, run(1))
    if (cells%axes == 2) then
      new%across = cells%centre(3 - along, run(1))
      new%width(2) = cells%width(3 - along, run(1))
    end if
    new%edge = cells%centre(along, run(1)) + 0.5_dp*real(side, dp)*cells%width(along, run(1))
    new%chain = chain_to(new, rims(:number))
    number = number + 1
    rims(number) = new
  end subroutine try_rim

  !> One more than the chain of the rim of the row before it with which this one is continued.
  pure function chain_to(new, rims) result(chain)
    type(rim), intent(in) :: new, rims(:)
    integer :: chain
    integer :: k

    chain = 1
    do k = size(rims), 1, -1
      if (rims(k)%row < new%row - 1) return
      if (rims(k)%row == new%row .or. rims(k)%side /= new%side) cycle
      if (abs(new%across - rims(k)%across) > (0.5_dp + PLACE_TOLERANCE)*(new%width(2) + rims(k)%width(2))) cycle
      if (abs(new%edge - rims(k)%edge) > (1.0_dp + PLACE_TOLERANCE)*max(new%width(1), rims(k)%width(1))) cycle
      chain = max(chain, rims(k)%chain + 1)
    end do
  end function chain_to

  !> |K| if the pressure of the cells, from the rim inwards, is that of a singular rim, otherwise 0.
  pure function singularity(width, pressure) result(strength)
    real(dp), intent(in) :: width(:), pressure(:)
    real(dp) :: strength
    real(dp) :: normal(2, 2), right(2), coefficient(2), error, foretold, determinant
    real(dp) :: mean(2, size(width)), p(size(width)), edge
    integer :: k, n

    strength = 0.0_dp
    n = size(width)
    if (abs(pressure(1)) < LEAST_DROP*maxval(abs(pressure(2:)))) return
    p = pressure/pressure(1)
    edge = 0.0_dp
    do k = 1, n
      mean(:, k) = cell_means(edge/width(1), (edge + width(k))/width(1))
      edge = edge + width(k)
    end do
    normal = matmul(mean(:, 2:), transpose(mean(:, 2:)))
    right = matmul(mean(:, 2:), p(2:))
    determinant = normal(1, 1)*normal(2, 2) - normal(1, 2)**2
    coefficient = [right(1)*normal(2, 2) - right(2)*normal(1, 2), &
                   right(2)*normal(1, 1) - right(1)*normal(1, 2)]/determinant
    foretold = dot_product(coefficient, mean(:, 1))
    error = maxval(abs(p(2:) - matmul(coefficient, mean(:, 2:))))
    if (.not. coefficient(1) > 0.0_dp .or. error > FIT_ERROR*maxval(p(2:))) return
    if (foretold < FIRST_RANGE(1) .or. foretold > FIRST_RANGE(2)) return
    strength = abs(pressure(1))*coefficient(1)*sqrt(width(1))
  end function singularity

  !> Means of s**(-1/2) and s**(1/2) between two distances from the rim.
  pure function cell_means(near, far) result(mean)
    real(dp), intent(in) :: near, far
    real(dp) :: mean(2)

    mean = [2.0_dp/(sqrt(near) + sqrt(far)), 2.0_dp/3.0_dp*(near + sqrt(near)*sqrt(far) + far)/(sqrt(near) + sqrt(far))]
  end function cell_means

end module fuge_pressure_rims
