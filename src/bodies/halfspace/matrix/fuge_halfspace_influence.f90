!> Influence matrices of rectangles on the surface of an elastic half-space.
!>
!> A force f on a point displaces the surface at distance r by f/(pi E* r) (J. Boussinesq 1885; K. L. Johnson,
!> Contact Mechanics, 1985, section 3.2), so uniform pressure on a rectangle displaces it by f/(pi E*) times the
!> mean of 1/r over the rectangle (A. E. H. Love 1929; Johnson, section 3.4). The displacement vanishes far away:
!> there is no datum, and the approach is absolute.
module fuge_halfspace_influence
  use fuge_cell_elements, only: FUGE_CENTRE
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_rectangle_checks, only: check_area_element, check_area_modulus, check_rectangles
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_SIZE
  implicit none
  private

  public :: copy_from_table, find_grid, fuge_halfspace_matrix

  !> Rectangles, and the data on which their coefficients depend.
  type :: rectangles
    real(dp), allocatable :: x(:), y(:), width_x(:), width_y(:)
    !> One side and the other one of x = 0 and of y = 0: 1 or 2 images.
    integer :: images(2) = 1
    integer :: element = FUGE_CENTRE
  end type rectangles

contains

  !> The influence matrix of rectangles on the surface of a half-space.
  !>
  !> `x`, `y` (n) centres and `width_x`, `width_y` (n) widths of the rectangles along x and y, length; `e_star` force
  !> per length squared; `element` FUGE_CENTRE or FUGE_MEAN: uniform pressure f/(width_x width_y), displacement at the
  !> centre, for equal rectangles, or the mean over a rectangle, for any; out: `alpha` (n, n), displacement into
  !> the body per force of a rectangle. `symmetric_x` (default .false.) folds a problem symmetric about x = 0: pass only
  !> the rectangles with x >= 0; each force is then the sum over a rectangle and its mirror image (a rectangle at 0
  !> is its own image). `symmetric_y` likewise; with both, a force is the sum over four.
  !> Each coefficient is the one of the given numbers to within 4e-16. Only where the rectangles are cells of one
  !> grid, up to rounding of the positions, it is that of the grid. Rectangles that overlap by more than a
  !> millionth of a width are refused, and widths with a ratio of more than 1e5.
  !> Errors, alpha untouched: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH (also for overlaps),
  !> FUGE_ERR_MODULUS, FUGE_ERR_ELEMENT, FUGE_ERR_GRID, FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY.
  !> Ten arguments: the order is that of the C interface.
  pure subroutine fuge_halfspace_matrix(x, y, width_x, width_y, e_star, element, alpha, info, symmetric_x, symmetric_y)
    real(dp), intent(in) :: x(:), y(:), width_x(:), width_y(:), e_star
    integer, intent(in) :: element
    real(dp), intent(inout) :: alpha(:, :)
    type(fuge_info), intent(out) :: info
    logical, intent(in), optional :: symmetric_x, symmetric_y
    logical :: symmetric(2), done
    type(rectangles) :: cells
    integer :: stat

    symmetric = .false.
    if (present(symmetric_x)) symmetric(1) = symmetric_x
    if (present(symmetric_y)) symmetric(2) = symmetric_y
    call check_area_element(element, info)
    if (.not. info%failed()) call check_area_modulus(e_star, info)
    if (.not. info%failed()) call check_rectangles(x, y, width_x, width_y, element, symmetric, info)
    if (info%failed()) return
    if (size(alpha, 1) < size(x) .or. size(alpha, 2) /= size(x)) then
      call report(info, FUGE_ERR_SIZE, 'alpha is '//text(size(alpha, 1))//' by '//text(size(alpha, 2)) &
                  //': it needs '//text(size(x))//' columns and at least as many rows')
      return
    end if

    allocate (cells%x, source=x, stat=stat)
    if (stat == 0) allocate (cells%y, source=y, stat=stat)
    if (stat == 0) allocate (cells%width_x, source=width_x, stat=stat)
    if (stat == 0) allocate (cells%width_y, source=width_y, stat=stat)
    done = .false.
    if (stat == 0) then
      cells%images = merge(2, 1, symmetric)
      cells%element = element
      call fill_from_grid(cells, e_star, alpha, done)
      if (.not. done) call fill_from_pairs(cells, e_star, alpha, stat)
    end if
    call require_memory(stat, 'the rectangles: n =', size(x), '', info)
  end subroutine fuge_halfspace_matrix

  !> Cells of one grid have few different coefficients: fill the matrix from a table of them. `done` is false, and
  !> alpha untouched, if the rectangles are no such cells, or too far apart for a table.
  pure subroutine fill_from_grid(cells, e_star, alpha, done)
    use fuge_halfspace_table, only: fill_halfspace_table
    type(rectangles), intent(in) :: cells
    real(dp), intent(in) :: e_star
    real(dp), intent(inout) :: alpha(:, :)
    logical, intent(out) :: done
    integer, allocatable :: column(:), row(:)
    real(dp), allocatable :: table(:, :)
    integer :: mirror(2), extent(2), n, stat

    n = size(cells%x)
    done = .false.
    allocate (column(n), row(n), stat=stat)
    if (stat /= 0) return
    call find_grid(cells%x, cells%y, cells%width_x, cells%width_y, cells%images, column, row, mirror, extent)
    if (any(extent < 0)) return
    allocate (table(0:extent(1), 0:extent(2)), stat=stat)
    if (stat /= 0) return
    call fill_halfspace_table([cells%width_x(1), cells%width_y(1)], e_star, cells%element, table, stat)
    if (stat /= 0) return
    call copy_from_table(table, column, row, cells%images, mirror, alpha)
    done = .true.
  end subroutine fill_from_grid

  !> The `column` and `row` 0, 1, .. of each rectangle, if they are cells of one grid, up to rounding.
  !>
  !> `x` to `width_y` (n) as in fuge_halfspace_matrix; `images` (2), one or two in each direction; `mirror` (2) as in
  !> `find_places`. `extent` (2): the largest distances in columns and rows, negative if the rectangles are no such
  !> cells, or if there are many more distances than rectangles. Nine arguments: the rectangles, and their places.
  pure subroutine find_grid(x, y, width_x, width_y, images, column, row, mirror, extent)
    real(dp), intent(in) :: x(:), y(:), width_x(:), width_y(:)
    integer, intent(in) :: images(2)
    integer, intent(out) :: column(:), row(:), mirror(2), extent(2)

    extent = -1
    call find_places(x, width_x, images(1), column, mirror(1))
    call find_places(y, width_y, images(2), row, mirror(2))
    if (any(mirror < 0)) return
    extent = [maxval(column), maxval(row)]
    extent = merge(2*extent + mirror, extent, images == 2)
    if (real(extent(1) + 1, dp)*real(extent(2) + 1, dp) > 8.0_dp*size(x)) extent = -1
  end subroutine find_grid

  !> The place 0, 1, .. of each cell in its line, if they are cells of one width side by side, up to rounding.
  !>
  !> `mirror`: with two images, the distance of a cell in place 0 from its mirror image, in places; 0 with one image; -1
  !> if they are no such cells.
  pure subroutine find_places(x, width, images, place, mirror)
    real(dp), intent(in) :: x(:), width(:)
    integer, intent(in) :: images
    integer, intent(out) :: place(:), mirror
    real(dp) :: first, rounding

    mirror = -1
    place = 0
    rounding = 4.0_dp*epsilon(rounding)
    first = minval(x)
    if (any(abs(width - width(1)) > rounding*width(1))) return
    if (maxval(x) - first > 8.0_dp*size(x)*width(1)) return
    place = nint((x - first)/width(1))
    rounding = rounding*maxval(abs(x))
    if (any(abs((x - first) - place*width(1)) > rounding)) return
    if (images == 1) then
      mirror = 0
    else if (2.0_dp*first <= 8.0_dp*size(x)*width(1)) then
      mirror = nint(2.0_dp*first/width(1))
      if (abs(2.0_dp*first - mirror*width(1)) > rounding) mirror = -1
    end if
  end subroutine find_places

  !> alpha of cells in the places `column` and `row`: the mean over the `images` (2); `mirror` (2) as in `find_places`.
  !> With `added` this is added to what alpha has.
  pure subroutine copy_from_table(table, column, row, images, mirror, alpha, added)
    real(dp), intent(in) :: table(0:, 0:)
    integer, intent(in) :: column(:), row(:), images(2), mirror(2)
    real(dp), intent(inout) :: alpha(:, :)
    logical, intent(in), optional :: added
    real(dp) :: total
    integer :: i, j, along_x(2), along_y(2), u, v

    do j = 1, size(column)
      do i = j, size(column)
        along_x = [abs(column(i) - column(j)), column(i) + column(j) + mirror(1)]
        along_y = [abs(row(i) - row(j)), row(i) + row(j) + mirror(2)]
        total = 0.0_dp
        do v = 1, images(2)
          do u = 1, images(1)
            total = total + table(along_x(u), along_y(v))
          end do
        end do
        total = total/real(product(images), dp)
        if (present(added)) total = alpha(i, j) + total
        alpha(i, j) = total
        alpha(j, i) = total
      end do
    end do
  end subroutine copy_from_table

  !> alpha pair by pair. `stat` as in an allocate statement; alpha is untouched unless it is 0.
  pure subroutine fill_from_pairs(cells, e_star, alpha, stat)
    use fuge_double_double, only: double_double, operator(/)
    use fuge_rectangle_influence, only: new_rectangle_kernel, rectangle_kernel, HALFSPACE_FACTOR, PAIRS
    type(rectangles), intent(in) :: cells
    real(dp), intent(in) :: e_star
    real(dp), intent(inout) :: alpha(:, :)
    integer, intent(out) :: stat
    type(rectangle_kernel) :: kernel
    logical :: equal
    integer :: first, last, j, n

    call new_rectangle_kernel(HALFSPACE_FACTOR/double_double(e_star, 0.0_dp), kernel, stat)
    if (stat /= 0) return
    n = size(cells%x)
    equal = cells%element == FUGE_CENTRE .or. (all(abs(cells%width_x - cells%width_x(1)) <= 0.0_dp) &
                                               .and. all(abs(cells%width_y - cells%width_y(1)) <= 0.0_dp))
    do j = 1, n
      do first = j, n, PAIRS
        last = min(n, first + PAIRS - 1)
        call fill_part(cells, kernel, equal, first, j, alpha(first:last, j))
        alpha(j, first:last) = alpha(first:last, j)
      end do
    end do
  end subroutine fill_from_pairs

  !> The coefficients of column `j` from row `first` on: the mean over the images. `equal`: all rectangles are.
  pure subroutine fill_part(cells, kernel, equal, first, j, part)
    use fuge_rectangle_influence, only: rectangle_kernel, set_widths
    type(rectangles), intent(in) :: cells
    type(rectangle_kernel), intent(inout) :: kernel
    logical, intent(in) :: equal
    integer, intent(in) :: first, j
    real(dp), intent(out), contiguous :: part(:)
    real(dp) :: total(size(part)), observed(2)
    integer :: along_x, along_y

    observed = [cells%width_x(first), cells%width_y(first)]
    if (cells%element == FUGE_CENTRE) observed = 0.0_dp
    call set_widths(kernel, observed, [cells%width_x(j), cells%width_y(j)])
    total = 0.0_dp
    do along_y = 1, cells%images(2)
      do along_x = 1, cells%images(1)
        call add_image(cells, kernel, equal, first, j, [along_x, along_y] == 2, total)
      end do
    end do
    part = total/real(product(cells%images), dp)
  end subroutine fill_part

  !> Add the coefficients of the rectangles from `first` on under rectangle `j`, or under its image `mirrored` (2)
  !> in x = 0 and in y = 0.
  pure subroutine add_image(cells, kernel, equal, first, j, mirrored, total)
    use fuge_double_double, only: double_double
    use fuge_rectangle_influence, only: mixed_coefficients, pair_coefficients, rectangle_kernel
    type(rectangles), intent(in) :: cells
    type(rectangle_kernel), intent(inout) :: kernel
    logical, intent(in) :: equal, mirrored(2)
    integer, intent(in) :: first, j
    real(dp), intent(inout) :: total(:)
    type(double_double) :: offset
    real(dp), dimension(size(total)) :: x_high, x_low, y_high, y_low, coefficient
    real(dp) :: observed(2, size(total))
    integer :: k

    do k = 1, size(total)
      offset = between(cells%x(first + k - 1), cells%x(j), mirrored(1))
      x_high(k) = offset%high
      x_low(k) = offset%low
      offset = between(cells%y(first + k - 1), cells%y(j), mirrored(2))
      y_high(k) = offset%high
      y_low(k) = offset%low
      observed(:, k) = [cells%width_x(first + k - 1), cells%width_y(first + k - 1)]
    end do
    if (equal) then
      call pair_coefficients(kernel, x_high, x_low, y_high, y_low, coefficient)
    else
      call mixed_coefficients(kernel, x_high, x_low, y_high, y_low, observed, coefficient)
    end if
    total = total + coefficient
  end subroutine add_image

  !> The distance from `b`, or its mirror image, to `a`.
  pure function between(a, b, mirrored) result(distance)
    use fuge_double_double, only: double_double, exact_difference, exact_sum
    real(dp), intent(in) :: a, b
    logical, intent(in) :: mirrored
    type(double_double) :: distance

    if (mirrored) then
      distance = exact_sum(a, b)
    else
      distance = exact_difference(a, b)
    end if
  end function between

end module fuge_halfspace_influence
