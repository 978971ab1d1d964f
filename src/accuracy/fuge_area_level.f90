!> One grid on the way to an area of contact of a wanted error.
module fuge_area_level
  use fuge_cell_elements, only: FUGE_MEAN
  use fuge_gap_function_type, only: fuge_gap_function, sample_grid
  use fuge_halfspace_fft, only: fuge_halfspace_operator
  use fuge_kinds, only: dp
  use fuge_options_type, only: fuge_options
  use fuge_pressing_type, only: fuge_pressing, pose_problem
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_solver_type, only: fuge_solver
  use fuge_status, only: fuge_info, report, require_memory, FUGE_DONE
  implicit none
  private

  public :: area_level, jumps_at_rim, load_at_rim, misses_contact, solve_area_level

  !> Equal cells on a rectangle, and the contact on them.
  type :: area_level
    !> Ends of the rectangle, length, and numbers of cells along x and y.
    real(dp) :: lower(2) = 0.0_dp, upper(2) = 0.0_dp
    integer :: cells(2) = 0
    !> Mean initial gaps of the cells, (cells(1)*cells(2)), length.
    real(dp), allocatable :: gap(:)
    type(fuge_solution) :: solution
  contains
    procedure :: widths
    procedure :: centres
  end type area_level

  !> Samples of an open cell, in each direction, that look for contacts which its mean gap hides.
  integer, parameter :: LOOKS = 4
  !> A gap is negative, and jumps, if it is so by this part of how far the bodies overlap without deformation; and if it
  !> is so many times as steep as beside the place.
  real(dp), parameter :: NEGATIVE = 1.0e-2_dp, LEAST_JUMP = 0.1_dp, STEEPER = 8.0_dp

contains

  !> Widths of the cells, length.
  pure function widths(self)
    class(area_level), intent(in) :: self
    real(dp) :: widths(2)

    widths = (self%upper - self%lower)/real(self%cells, dp)
  end function widths

  !> Centres of the cells along x, `direction` 1, or y, 2; length.
  pure function centres(self, direction)
    class(area_level), intent(in) :: self
    integer, intent(in) :: direction
    real(dp) :: centres(self%cells(direction))
    integer :: k

    associate (low => self%lower(direction), high => self%upper(direction), n => self%cells(direction))
      centres = [(low + (high - low)*((real(k, dp) - 0.5_dp)/real(n, dp)), k=1, n)]
    end associate
  end function centres

  !> Solve on the cells of `level`, by FFT. Errors: those of the gap function, of the operator and of the solver,
  !> FUGE_ERR_MEMORY.
  subroutine solve_area_level(gap, pressing, level, info)
    class(fuge_gap_function), intent(in) :: gap
    type(fuge_pressing), intent(in) :: pressing
    type(area_level), intent(inout) :: level
    type(fuge_info), intent(inout) :: info
    type(fuge_halfspace_operator) :: operator
    type(fuge_problem) :: problem
    type(fuge_options) :: options
    type(fuge_solver) :: solver
    real(dp) :: width(2)

    call average_gaps(gap, level, info)
    if (info%failed()) return
    width = level%widths()
    if (allocated(pressing%layers)) then
      call operator%set(level%cells(1), level%cells(2), width(1), width(2), pressing%layers%e_star(), info, FUGE_MEAN, &
                        pressing%boundary, body=pressing%layers%surface())
    else
      call operator%set(level%cells(1), level%cells(2), width(1), width(2), pressing%e_star, info, FUGE_MEAN, &
                        pressing%boundary)
    end if
    if (info%failed()) return
    call pose_problem(pressing, level%gap, problem, options)
    call solver%solve(operator, problem, level%solution, info, options)
    ! What the solver remarks on the rim is part of the result.
    if (info%status == FUGE_DONE) call report(info, FUGE_DONE, '')
  end subroutine solve_area_level

  !> The mean gaps of the cells, by the rule of Gauss with two places in each direction.
  subroutine average_gaps(gap, level, info)
    class(fuge_gap_function), intent(in) :: gap
    type(area_level), intent(inout) :: level
    type(fuge_info), intent(inout) :: info
    real(dp), parameter :: PLACES(2) = [-0.5_dp, 0.5_dp]/sqrt(3.0_dp)
    real(dp), allocatable :: height(:)
    integer :: i, j, n, stat

    n = product(level%cells)
    if (allocated(level%gap)) deallocate (level%gap)
    allocate (level%gap(n), height(n), stat=stat)
    call require_memory(stat, 'the gaps of', n, 'cells', info)
    if (stat /= 0) return
    level%gap = 0.0_dp
    do j = 1, 2
      do i = 1, 2
        call sample_cells(gap, level, [PLACES(i), PLACES(j)], height, info)
        if (info%failed()) return
        level%gap = level%gap + 0.25_dp*height
      end do
    end do
  end subroutine average_gaps

  !> The gap of every cell at the same `place` (2) from its centre, in widths of a cell.
  subroutine sample_cells(gap, level, place, height, info)
    class(fuge_gap_function), intent(in) :: gap
    type(area_level), intent(in) :: level
    real(dp), intent(in) :: place(2)
    real(dp), intent(out) :: height(:)
    type(fuge_info), intent(inout) :: info
    real(dp) :: width(2)

    width = level%widths()
    call sample_grid(gap, level%centres(1) + place(1)*width(1), level%centres(2) + place(2)*width(2), height, info)
  end subroutine sample_cells

  !> Is the gap under load negative somewhere in an open cell, between the samples that the solve knows? The
  !> displacements are taken from the centres of the cells, which does not do beside a contact. Errors: those of the gap
  !> function, FUGE_ERR_MEMORY.
  subroutine misses_contact(gap, level, misses, info)
    class(fuge_gap_function), intent(in) :: gap
    type(area_level), intent(in) :: level
    logical, intent(out) :: misses
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: moved(:), slope_x(:), slope_y(:), height(:)
    logical, allocatable :: is_apart(:)
    real(dp) :: place(2), least
    integer :: i, j

    misses = .false.
    allocate (is_apart, source=count_around(level%cells, level%solution%force > 0.0_dp, .false.) == 0)
    allocate (moved, source=level%solution%gap - level%gap)
    allocate (slope_x(size(moved)), slope_y(size(moved)), height(size(moved)))
    least = -NEGATIVE*max(0.0_dp, maxval(-moved) - minval(level%gap))
    call find_slopes(level%cells, moved, slope_x, slope_y)
    do j = 1, LOOKS
      do i = 1, LOOKS
        place = (real([i, j], dp) - 0.5_dp)/real(LOOKS, dp) - 0.5_dp
        call sample_cells(gap, level, place, height, info)
        if (info%failed()) return
        height = height + moved + place(1)*slope_x + place(2)*slope_y
        misses = any(height < least .and. is_apart)
        if (misses) return
      end do
    end do
  end subroutine misses_contact

  !> The share of the load in cells that have an open one beside them, along a side or at a corner; 0 without a load.
  !> `ends`: the rim of the rectangle is one of the body, with nothing beside it.
  pure function load_at_rim(level, ends) result(share)
    type(area_level), intent(in) :: level
    logical, intent(in) :: ends
    real(dp) :: share

    share = 0.0_dp
    associate (force => level%solution%force)
      if (.not. any(force > 0.0_dp)) return
      share = sum(force, mask=count_around(level%cells, .not. force > 0.0_dp, ends) > 0)/sum(force)
    end associate
  end function load_at_rim

  !> How many of a cell and those around it are marked, (n); `beyond`: those beyond the rim are so.
  pure function count_around(cells, marked, beyond) result(number)
    integer, intent(in) :: cells(2)
    logical, intent(in) :: marked(:), beyond
    integer :: number(size(marked))
    integer :: along(0:cells(1) + 1, 0:cells(2) + 1)

    along = merge(1, 0, beyond)
    associate (nx => cells(1), ny => cells(2))
      along(1:nx, 1:ny) = reshape(merge(1, 0, marked), cells)
      along(1:nx, :) = along(0:nx - 1, :) + along(1:nx, :) + along(2:, :)
      number = reshape(along(1:nx, 0:ny - 1) + along(1:nx, 1:ny) + along(1:nx, 2:), [size(marked)])
    end associate
  end function count_around

  !> Differences of `values` over one cell along x and y, central ones, at the rim half of them.
  pure subroutine find_slopes(cells, values, slope_x, slope_y)
    integer, intent(in) :: cells(2)
    real(dp), intent(in) :: values(:)
    real(dp), intent(out) :: slope_x(:), slope_y(:)
    real(dp) :: grid(cells(1), cells(2))
    integer :: j

    grid = reshape(values, cells)
    associate (nx => cells(1), ny => cells(2))
      slope_x = reshape(0.5_dp*(grid([(j, j=2, nx), nx], :) - grid([1, (j, j=1, nx - 1)], :)), [nx*ny])
      slope_y = reshape(0.5_dp*(grid(:, [(j, j=2, ny), ny]) - grid(:, [1, (j, j=1, ny - 1)])), [nx*ny])
    end associate
  end subroutine find_slopes

  !> Does the initial gap jump at the rim of the contact? There the step from a cell in contact to an open one beside it
  !> is many times those behind and before it. A cell that the jump crosses is left out, as its mean gap is between.
  pure function jumps_at_rim(level) result(jumps)
    type(area_level), intent(in) :: level
    logical :: jumps
    real(dp) :: least
    integer :: k, nx, n

    jumps = .false.
    nx = level%cells(1)
    n = product(level%cells)
    associate (force => level%solution%force, gap => level%gap)
      if (.not. any(force > 0.0_dp)) return
      least = LEAST_JUMP*max(0.0_dp, maxval(gap - level%solution%gap) - minval(gap))
      do k = 1, n, nx
        if (.not. jumps) jumps = jumps_along(force(k:k + nx - 1) > 0.0_dp, gap(k:k + nx - 1), least)
      end do
      do k = 1, nx
        if (.not. jumps) jumps = jumps_along(force(k:n:nx) > 0.0_dp, gap(k:n:nx), least)
      end do
    end associate
  end function jumps_at_rim

  !> The same along one row of cells, by at least `least`.
  pure function jumps_along(touches, gap, least) result(jumps)
    logical, intent(in) :: touches(:)
    real(dp), intent(in) :: gap(:), least
    logical :: jumps
    !> Steps from each cell to the next one, none beyond the rim.
    real(dp) :: step(-1:size(gap) + 1), others
    integer :: k, n

    jumps = .false.
    n = size(gap)
    step = 0.0_dp
    step(1:n - 1) = abs(gap(2:) - gap(:n - 1))
    do k = 2, n
      if (touches(k) .eqv. touches(k - 1)) cycle
      others = merge(max(step(k), step(k - 3)), max(step(k - 2), step(k + 1)), touches(k))
      jumps = step(k - 1) > max(least, STEEPER*others)
      if (jumps) return
    end do
  end function jumps_along

end module fuge_area_level
