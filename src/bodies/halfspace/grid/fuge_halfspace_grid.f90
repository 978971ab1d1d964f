!> A uniform grid of rectangles on an elastic half-space: its numbers, what they may be, and coarser grids.
module fuge_halfspace_grid
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_cell_elements, only: FUGE_FREE, FUGE_PERIODIC, FUGE_MEAN
  use fuge_constants, only: PI, LARGEST_EXPONENT_OF_4
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_ERR_MEMORY, FUGE_ERR_NOT_FINITE, FUGE_ERR_OPTION, &
    FUGE_ERR_OVERFLOW, FUGE_ERR_SIZE, FUGE_ERR_WIDTH
  use fuge_wave_mixture, only: wave_mixture
  implicit none
  private

  public :: check_grid, circle_of, coarsened, complete, computes_later, count_coarser, cyclic, is_large, &
    least_magnitude, periodic, slope_of_waves

  !> `boundary`: the cells repeat periodically along x, and beyond them along y the surface is free.
  integer, parameter, public :: FUGE_PERIODIC_X = 2
  !> `boundary`: the cells repeat periodically along y, and beyond them along x the surface is free.
  integer, parameter, public :: FUGE_PERIODIC_Y = 3

  !> On a periodic surface the terms of a displacement by the forces f are about this times the sum of |f|/(e_star L),
  !> L being the `term_length`.
  real(dp), parameter :: MEAN_TERM = 0.4_dp
  !> Cells of one direction, at most: a row of the circle has a default integer of numbers.
  integer, parameter :: MOST_CELLS = 2**28

  !> A grid of fewer cells is not made by `coarsen`.
  integer, parameter :: FEWEST_CELLS = 32
  !> More cells than this are a large grid.
  integer, parameter :: MANY = 2**24
  !> The longer spacing over the shorter one, at most.
  real(dp), parameter :: LARGEST_RATIO = 1.0e5_dp

  type, public :: halfspace_grid
    !> nx and ny; 0 before they are set.
    integer :: cells(2) = 0
    !> Cells in a period of each direction, 0 if it is not periodic. A window has fewer cells.
    integer :: period(2) = 0
    integer :: element = FUGE_MEAN
    integer :: boundary = FUGE_FREE
    real(dp) :: spacing(2) = 0.0_dp
    real(dp) :: e_star = 0.0_dp
    !> Where a force displaces nothing if the surface is periodic in one direction only: a distance along the other one.
    real(dp) :: reach = 0.0_dp
    !> The body, if it is no half-space.
    type(wave_mixture) :: body
  end type halfspace_grid

contains

  !> Refuse what makes no grid: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH, FUGE_ERR_OVERFLOW,
  !> FUGE_ERR_MODULUS, FUGE_ERR_ELEMENT, FUGE_ERR_OPTION.
  pure subroutine check_grid(grid, info)
    type(halfspace_grid), intent(in) :: grid
    type(fuge_info), intent(inout) :: info

    call check_cells(grid, info)
    if (.not. info%failed()) call check_options(grid, info)
  end subroutine check_grid

  !> Refuse numbers and sizes of cells that make no grid.
  pure subroutine check_cells(grid, info)
    type(halfspace_grid), intent(in) :: grid
    type(fuge_info), intent(inout) :: info
    character, parameter :: AXIS(2) = ['x', 'y']
    real(dp) :: points
    integer :: k

    do k = 1, 2
      if (info%failed()) return
      if (grid%cells(k) < 1) then
        call report(info, FUGE_ERR_SIZE, 'n'//AXIS(k)//' = '//text(grid%cells(k))//': at least one cell is needed')
      else if (.not. ieee_is_finite(grid%spacing(k))) then
        call report(info, FUGE_ERR_NOT_FINITE, 'spacing_'//AXIS(k)//' = '//text(grid%spacing(k)) &
                    //' is not a finite number')
      else if (.not. grid%spacing(k) > 0.0_dp) then
        call report(info, FUGE_ERR_WIDTH, 'spacing_'//AXIS(k)//' = '//text(grid%spacing(k)) &
                    //' is not positive: it is the width of a cell along '//AXIS(k))
      else if (abs(exponent(grid%spacing(k))) > LARGEST_EXPONENT_OF_4) then
        call report(info, FUGE_ERR_OVERFLOW, 'spacing_'//AXIS(k)//' = '//text(grid%spacing(k)) &
                    //' is out of range: choose another unit of length')
      end if
    end do
    if (info%failed()) return
    points = real(grid%cells(1), dp)*real(grid%cells(2), dp)
    if (points > real(huge(1), dp)) then
      call report(info, FUGE_ERR_SIZE, 'nx = '//text(grid%cells(1))//' times ny = '//text(grid%cells(2)) &
                  //' is '//text(points)//' points, more than the largest integer, '//text(huge(1)) &
                  //': use a coarser grid')
    else if (maxval(grid%spacing) > LARGEST_RATIO*minval(grid%spacing)) then
      call report(info, FUGE_ERR_WIDTH, 'spacing_x = '//text(grid%spacing(1))//' and spacing_y = ' &
                  //text(grid%spacing(2))//': the ratio of the two is at most '//text(LARGEST_RATIO))
    end if
  end subroutine check_cells

  pure subroutine check_options(grid, info)
    use fuge_rectangle_checks, only: check_area_element, check_area_modulus
    type(halfspace_grid), intent(in) :: grid
    type(fuge_info), intent(inout) :: info

    call check_area_modulus(grid%e_star, info)
    if (.not. info%failed()) call check_area_element(grid%element, info)
    if (info%failed()) return
    if (all(grid%boundary /= [FUGE_FREE, FUGE_PERIODIC, FUGE_PERIODIC_X, FUGE_PERIODIC_Y])) then
      call report(info, FUGE_ERR_OPTION, 'boundary = '//text(grid%boundary) &
                  //' is unknown: use FUGE_FREE, FUGE_PERIODIC, FUGE_PERIODIC_X or FUGE_PERIODIC_Y')
    end if
  end subroutine check_options

  !> The periods, and where a force displaces nothing, of a grid that is no window.
  pure subroutine complete(grid)
    type(halfspace_grid), intent(inout) :: grid

    grid%period = merge(grid%cells, 0, periodic(grid))
    if (.not. all(periodic(grid))) grid%reach = 2.0_dp*maxval(grid%cells*grid%spacing, mask=.not. periodic(grid))
  end subroutine complete

  !> Is the surface periodic in each direction?
  pure function periodic(grid)
    type(halfspace_grid), intent(in) :: grid
    logical :: periodic(2)

    periodic = grid%boundary == FUGE_PERIODIC .or. grid%boundary == [FUGE_PERIODIC_X, FUGE_PERIODIC_Y]
  end function periodic

  !> Are the cells a whole period in each direction? In the others the circle of a product is longer than the grid.
  pure function cyclic(grid)
    type(halfspace_grid), intent(in) :: grid
    logical :: cyclic(2)

    cyclic = grid%cells == grid%period
  end function cyclic

  !> Is it an area of so many free cells that kernels of its size should not be kept without need?
  pure function is_large(grid) result(large)
    type(halfspace_grid), intent(in) :: grid
    logical :: large

    large = grid%boundary == FUGE_FREE .and. all(grid%cells > 1) .and. product(grid%cells) > MANY
  end function is_large

  !> Are its kernels computed when a solve first needs them? Not where they come with a datum.
  pure function computes_later(grid) result(later)
    type(halfspace_grid), intent(in) :: grid
    logical :: later

    later = grid%boundary == FUGE_FREE .or. all(periodic(grid))
  end function computes_later

  !> The length L for which the terms of the displacement by the forces f on a surface with a period are about the sum
  !> of |f|/(e_star L): the extent across the direction whose longest wave has the largest terms. One cell has no waves.
  pure function term_length(grid) result(length)
    type(halfspace_grid), intent(in) :: grid
    real(dp) :: length
    real(dp) :: extent(2)
    integer :: count(2), k

    count = merge(grid%period, grid%cells, periodic(grid))
    extent = count*grid%spacing
    length = maxval(extent)
    do k = 1, 2
      if (count(k) < 2) cycle
      if (all(periodic(grid)) .or. .not. grid%period(k) > 0) length = min(length, extent(3 - k))
    end do
  end function term_length

  !> Cells 2**`levels` times as wide. In a periodic direction the period is the same, which may make them a little
  !> narrower. A direction of one cell keeps it.
  pure function coarsened(grid, levels) result(wider)
    type(halfspace_grid), intent(in) :: grid
    integer, intent(in) :: levels
    type(halfspace_grid) :: wider
    integer :: k

    wider = grid
    do k = 1, levels
      where (wider%cells > 1) wider%spacing = 2.0_dp*wider%spacing
      wider%cells = (wider%cells - 1)/2 + 1
      wider%period = (wider%period + 1)/2
    end do
    where (periodic(grid)) wider%spacing = grid%spacing*(real(grid%period, dp)/real(max(wider%period, 1), dp))
  end function coarsened

  !> How many times the grid can be coarsened.
  pure function count_coarser(grid) result(count)
    type(halfspace_grid), intent(in) :: grid
    integer :: count, cells(2)

    count = -1
    cells = grid%cells
    do while (real(cells(1), dp)*real(cells(2), dp) >= FEWEST_CELLS)
      cells = (cells - 1)/2 + 1
      count = count + 1
    end do
    count = max(count, 0)
  end function count_coarser

  !> The least size of the terms of a displacement by forces the sum of whose magnitudes is `total`: on a periodic
  !> surface equal forces displace nothing, but their terms do.
  pure function least_magnitude(grid, total) result(magnitude)
    type(halfspace_grid), intent(in) :: grid
    real(dp), intent(in) :: total
    real(dp) :: magnitude

    magnitude = 0.0_dp
    if (grid%boundary /= FUGE_FREE) magnitude = MEAN_TERM*total/(grid%e_star*term_length(grid))
  end function least_magnitude

  !> s, where displacements by waves q fall like q**(-s), at waves of eight of the cells that are 2**`levels` times as
  !> wide; 1 on a half-space.
  pure function slope_of_waves(grid, levels) result(slope)
    type(halfspace_grid), intent(in) :: grid
    integer, intent(in) :: levels
    real(dp) :: slope
    real(dp), parameter :: RATIO = 1.1_dp
    real(dp) :: q

    slope = 1.0_dp
    if (.not. grid%body%is_set()) return
    q = 0.25_dp*PI/(sqrt(product(grid%spacing))*2.0_dp**levels)
    slope = 1.0_dp - log(grid%body%wave_factor(q)/grid%body%wave_factor(RATIO*q))/log(1.0_dp/RATIO)
  end function slope_of_waves

  !> `length`: the cells of the circles that transforms of rows and columns have; where they are not cyclic twice as
  !> many hold the products. Error: FUGE_ERR_MEMORY if they are too many.
  pure subroutine circle_of(grid, length, info)
    use fuge_fft, only: fast_length
    type(halfspace_grid), intent(in) :: grid
    integer, intent(out) :: length(2)
    type(fuge_info), intent(inout) :: info

    length = grid%cells
    where (.not. cyclic(grid) .and. length > 1) length = [fast_length(length(1)), fast_length(length(2))]
    if (any(length < 1) .or. any(length > MOST_CELLS)) then
      call report(info, FUGE_ERR_MEMORY, 'nx = '//text(grid%cells(1))//', ny = '//text(grid%cells(2)) &
                  //': a direction has at most '//text(MOST_CELLS)//' cells')
    end if
  end subroutine circle_of

end module fuge_halfspace_grid
