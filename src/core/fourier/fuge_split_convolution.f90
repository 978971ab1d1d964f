!> Convolutions on long circles, whose complex numbers are transformed as a grid (fuge_split_plan).
!>
!> The circle of N = 2 M values and the factors that multiply its transforms are those of fuge_convolution. Three times
!> all numbers go through the cache: columns are transformed, a few neighbours at a time; rows are transformed,
!> multiplied and transformed back; and columns again. Factors are in the order in which the waves p + R q arise, q = 0
!> .. C - 1 of row p, so that nothing is transposed. The numbers k and M - k of pairs of values, which are multiplied
!> together, are in the rows p and R - p.
!>
!> The values are the grid of 2 R rows of C values: those of a few neighbours of its columns make up whole columns of
!> complex numbers, both of pairs of neighbours and of values half a circle apart. Threads share columns and rows; each
!> line is computed as by one thread, so that the result is the same to the last bit.
module fuge_split_convolution
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_int, c_loc, c_ptr
  use fuge_fft, only: fft_plan
  use fuge_kept_rows, only: return_rows, taken_rows
  use fuge_kinds, only: dp
  use fuge_pair_factors, only: pair_factors, soften
  use fuge_split_plan, only: blocks_of_columns, get_columns, multiply_row, put_columns, split_plan, take_work, &
    COLUMN_BLOCK, LINES_OF_THREAD
  use fuge_status, only: FUGE_DONE
  use fuge_threads, only: run_in_threads, share
  use fuge_unit_roots, only: root_of_one
  implicit none
  private

  public :: convolve_split, order_factors, order_odd_factors

  !> Columns of values that are transformed together, and half of them.
  integer, parameter :: WIDTH = COLUMN_BLOCK, HALF = WIDTH/2
  !> Rows whose factors are put in order together: neighbours in memory of waves.
  integer, parameter :: ROWS_TOGETHER = 8

  !> One product, for the threads that share it.
  type :: product_job
    type(split_plan), pointer :: plan => null()
    !> Is the circle twice as long as N?
    logical :: padded = .false.
    !> Added to the inverse of the kernel, times its factor; 0 for none.
    real(dp) :: softening = 0.0_dp
    !> Factors of pairs, (3, C, R/2 + 1), and of single numbers, (C, R).
    real(dp), pointer, contiguous :: factors(:, :, :) => null(), odd_factors(:, :) => null()
    real(dp), pointer, contiguous :: x(:) => null(), y(:) => null()
    !> Rows of pairs of neighbours, then those of values half a circle apart, then LINES_OF_THREAD lines of each thread.
    real(c_double), pointer, contiguous :: work(:, :) => null()
  end type product_job

contains

  !> The factors of the pairs of `length` values as `convolve_split` takes them, `factors` (3, C (R/2 + 1)), for
  !> `spectrum` (0:length/2).
  pure subroutine order_factors(rows, columns, spectrum, factors)
    integer, intent(in) :: rows, columns
    real(dp), intent(in) :: spectrum(0:)
    real(dp), intent(out) :: factors(:, :)
    real(dp) :: column_root(2, 0:columns - 1), row_root(2, 0:rows/2), w(2)
    integer :: first, k, p, q

    do p = 0, rows/2
      row_root(:, p) = root_of_one(p, 2*rows*columns)
    end do
    do q = 0, columns - 1
      column_root(:, q) = root_of_one(q, 2*columns)
    end do
    do first = 0, rows/2, ROWS_TOGETHER
      do q = 0, columns - 1
        do p = first, min(first + ROWS_TOGETHER - 1, rows/2)
          associate (a => row_root(:, p), b => column_root(:, q))
            w = [a(1)*b(1) - a(2)*b(2), a(1)*b(2) + a(2)*b(1)]
          end associate
          k = p + rows*q
          factors(:, columns*p + q + 1) = pair_factors(spectrum(k), spectrum(rows*columns - k), w)
        end do
      end do
    end do
  end subroutine order_factors

  !> Factors of single complex numbers as `convolve_split` takes them, from `factors` (R C) in the order of the waves.
  pure subroutine order_odd_factors(rows, columns, factors, ordered)
    integer, intent(in) :: rows, columns
    real(dp), intent(in) :: factors(:)
    real(dp), intent(out) :: ordered(:)
    integer :: first, p, q

    do first = 0, rows - 1, ROWS_TOGETHER
      do q = 0, columns - 1
        do p = first, min(first + ROWS_TOGETHER - 1, rows - 1)
          ordered(columns*p + q + 1) = factors(p + rows*q + 1)
        end do
      end do
    end do
  end subroutine order_odd_factors

  !> y = the first values of the convolution of x, continued by zeros, with the kernel of the `factors` of pairs and,
  !> on a circle that is twice as long, the `odd_factors` of values half a circle apart.
  !>
  !> With `softening` > 0 each number s of the spectrum of pairs becomes s/(1 + softening s). Several threads may use
  !> the plan at once. `status`: 0, or with y unchanged FUGE_ERR_MEMORY. The arguments are nine, because x and y have an
  !> explicit shape: gfortran copies arrays to pass them as contiguous ones.
  subroutine convolve_split(plan, factors, odd_factors, softening, values, x, results, y, status)
    type(split_plan), intent(in), target :: plan
    real(dp), intent(in), contiguous, target :: factors(:, :)
    real(dp), intent(in), optional, contiguous, target :: odd_factors(:)
    real(dp), intent(in) :: softening
    integer, intent(in) :: values, results
    real(dp), intent(in), target :: x(values)
    real(dp), intent(inout), target :: y(results)
    integer, intent(out) :: status
    type(product_job), target :: job
    type(taken_rows) :: taken
    integer :: threads

    call take_work(plan, threads, taken, job%work, status)
    if (status /= FUGE_DONE) return
    job%padded = present(odd_factors)
    job%softening = softening
    ! By addresses, because no pointer may be associated with arguments that are read only.
    call c_f_pointer(c_loc(plan), job%plan)
    call c_f_pointer(c_loc(factors), job%factors, [3, plan%columns, plan%rows/2 + 1])
    if (present(odd_factors)) call c_f_pointer(c_loc(odd_factors), job%odd_factors, [plan%columns, plan%rows])
    call c_f_pointer(c_loc(x), job%x, shape(x))
    call c_f_pointer(c_loc(y), job%y, shape(y))
    call run_in_threads(threads, transform_columns, c_loc(job))
    call run_in_threads(threads, convolve_rows, c_loc(job))
    call run_in_threads(threads, transform_columns_back, c_loc(job))
    call return_rows(plan%kept, taken)
  end subroutine convolve_split

  !> The lines of a thread.
  subroutine find_lines(job, part, lines)
    type(product_job), intent(in) :: job
    integer, intent(in) :: part
    real(c_double), pointer, contiguous, intent(out) :: lines(:, :)
    integer :: first

    first = 2*job%plan%rows + LINES_OF_THREAD*part
    lines => job%work(:, first + 1:first + LINES_OF_THREAD)
  end subroutine find_lines

  !> Transform columns of x, those of both circles.
  subroutine transform_columns(part, parts, data) bind(c, name='')
    integer(c_int), intent(in), value :: part, parts
    type(c_ptr), intent(in), value :: data
    type(product_job), pointer :: job
    real(c_double), pointer, contiguous :: lines(:, :)
    integer :: block, done, first, from, to

    call c_f_pointer(data, job)
    call find_lines(job, int(part), lines)
    call share(blocks_of_columns(job%plan), int(part), int(parts), from, to)
    do block = from, to
      call find_columns(job%plan, block, first, done)
      call gather_values(job%plan, job%x, first, job%padded, lines(:, 2:))
      call transform_lines(job, lines)
      call put_lines(job, first, done, lines)
    end do
  end subroutine transform_columns

  !> The `first` column of a block, from 0. `done` columns, an even number, of the last block belong to the one before.
  pure subroutine find_columns(plan, block, first, done)
    type(split_plan), intent(in) :: plan
    integer, intent(in) :: block
    integer, intent(out) :: first, done

    first = min(WIDTH*block, plan%columns - WIDTH)
    done = WIDTH*block - first
  end subroutine find_columns

  !> Transform each line but the first to the one before it.
  subroutine transform_lines(job, lines)
    type(product_job), intent(in) :: job
    real(c_double), intent(inout), contiguous, target :: lines(:, :)
    integer :: k

    do k = 1, merge(2, 1, job%padded)*WIDTH
      call job%plan%along_column%transform_to(c_loc(lines(1, k + 1)), c_loc(lines(1, k)))
    end do
  end subroutine transform_lines

  !> Put the complex columns of both circles that the columns of values from `first` on make up into rows, but for
  !> those that are `done`.
  subroutine put_lines(job, first, done, lines)
    type(product_job), intent(inout) :: job
    integer, intent(in) :: first, done
    real(c_double), intent(in), contiguous :: lines(:, :)
    integer :: begin, pairs, rows

    rows = job%plan%rows
    begin = first + done
    pairs = HALF - done/2
    call put_columns(lines(:, done/2 + 1:), begin/2, pairs, job%work(:, :rows))
    call put_columns(lines(:, HALF + done/2 + 1:), (begin + job%plan%columns)/2, pairs, job%work(:, :rows))
    if (job%padded) call put_columns(lines(:, WIDTH + done + 1:), begin, WIDTH - done, job%work(:, rows + 1:2*rows))
  end subroutine put_lines

  !> The reverse of `put_lines`, for all columns from `first` on.
  subroutine get_lines(job, first, lines)
    type(product_job), intent(in) :: job
    integer, intent(in) :: first
    real(c_double), intent(inout), contiguous :: lines(:, :)
    integer :: rows

    rows = job%plan%rows
    call get_columns(job%work(:, :rows), first/2, HALF, lines)
    call get_columns(job%work(:, :rows), (first + job%plan%columns)/2, HALF, lines(:, HALF + 1:))
    if (job%padded) call get_columns(job%work(:, rows + 1:2*rows), first, WIDTH, lines(:, WIDTH + 1:))
  end subroutine get_lines

  !> Columns of complex numbers from the columns of values from `first` on: the pairs of even rows of values, those of
  !> odd rows, and, `padded`, twisted those of values half a circle apart.
  pure subroutine gather_values(plan, x, first, padded, lines)
    type(split_plan), intent(in) :: plan
    real(dp), intent(in), contiguous :: x(:)
    integer, intent(in) :: first
    logical, intent(in) :: padded
    real(c_double), intent(inout), contiguous :: lines(:, :)
    real(dp) :: one(WIDTH), other(WIDTH), w(2)
    integer :: c, r

    do r = 0, plan%rows - 1
      call get_values(x, plan%columns*r + first, one)
      call get_values(x, plan%columns*(r + plan%rows) + first, other)
      call put_pairs(one, r, lines)
      call put_pairs(other, r + plan%rows, lines)
      if (.not. padded) cycle
      w = plan%row_twist(:, r)
      do c = 1, WIDTH
        lines(2*r + 1, WIDTH + c) = w(1)*one(c) + w(2)*other(c)
        lines(2*r + 2, WIDTH + c) = w(2)*one(c) - w(1)*other(c)
      end do
    end do
  end subroutine gather_values

  !> The values of x, continued by zeros, behind number `begin`.
  pure subroutine get_values(x, begin, values)
    real(dp), intent(in), contiguous :: x(:)
    integer, intent(in) :: begin
    real(dp), intent(inout) :: values(WIDTH)
    integer :: c

    if (begin <= size(x) - WIDTH) then
      do c = 1, WIDTH
        values(c) = x(begin + c)
      end do
    else
      values = 0.0_dp
      do c = 1, min(WIDTH, size(x) - begin)
        values(c) = x(begin + c)
      end do
    end if
  end subroutine get_values

  !> Put pairs of the values of row `r`, from 0, into the complex columns that have them.
  pure subroutine put_pairs(values, r, lines)
    real(dp), intent(in) :: values(WIDTH)
    integer, intent(in) :: r
    real(c_double), intent(inout), contiguous :: lines(:, :)
    integer :: begin, c, k

    begin = mod(r, 2)*HALF
    k = 2*(r/2)
    do c = 1, HALF
      lines(k + 1, begin + c) = values(2*c - 1)
      lines(k + 2, begin + c) = values(2*c)
    end do
  end subroutine put_pairs

  !> Transform rows, multiply by the spectrum, and transform back, real and imaginary parts exchanged.
  subroutine convolve_rows(part, parts, data) bind(c, name='')
    integer(c_int), intent(in), value :: part, parts
    type(c_ptr), intent(in), value :: data
    type(product_job), pointer :: job
    real(c_double), pointer, contiguous :: lines(:, :)
    integer :: first, last, p

    call c_f_pointer(data, job)
    call find_lines(job, int(part), lines)
    call share(job%plan%rows/2 + 1, int(part), int(parts), first, last)
    do p = first, last
      call convolve_pair_of_rows(job, p, lines)
    end do
    if (.not. job%padded) return
    call share(job%plan%rows, int(part), int(parts), first, last)
    do p = first, last
      call convolve_row(job, p, lines)
    end do
  end subroutine convolve_rows

  !> Convolve rows `p` and R - p of pairs of neighbours.
  subroutine convolve_pair_of_rows(job, p, lines)
    type(product_job), intent(inout) :: job
    integer, intent(in) :: p
    real(c_double), intent(inout), contiguous, target :: lines(:, :)
    real(c_double), pointer, contiguous :: softer(:, :)
    integer :: n, other

    n = 2*job%plan%columns
    other = modulo(job%plan%rows - p, job%plan%rows)
    call transform_row(job%plan, p, .false., job%work(:, p + 1), lines(:, 1), lines(:, 2))
    if (other /= p) then
      call transform_row(job%plan, other, .false., job%work(:, other + 1), lines(:, 3), lines(:, 4))
    else
      ! The number 0 belongs to itself.
      lines(:n, 4) = cshift(lines(:n, 2), merge(2, 0, p == 0))
    end if
    if (job%softening > 0.0_dp) then
      call c_f_pointer(c_loc(lines(1, 5)), softer, [3, job%plan%columns])
      softer = job%factors(:, :, p + 1)
      call soften(job%softening, softer)
      call multiply_pairs(softer, lines(:n, 2), lines(:n, 4))
    else
      call multiply_pairs(job%factors(:, :, p + 1), lines(:n, 2), lines(:n, 4))
    end if
    call transform_row_back(job%plan, lines(:, 1), lines(:, 2), job%work(:, p + 1))
    if (other /= p) call transform_row_back(job%plan, lines(:, 3), lines(:, 4), job%work(:, other + 1))
  end subroutine convolve_pair_of_rows

  !> Convolve row `p` of values half a circle apart.
  subroutine convolve_row(job, p, lines)
    type(product_job), intent(inout) :: job
    integer, intent(in) :: p
    real(c_double), intent(inout), contiguous, target :: lines(:, :)
    integer :: row

    row = job%plan%rows + p + 1
    call transform_row(job%plan, p, .true., job%work(:, row), lines(:, 1), lines(:, 2))
    call multiply_exchanging(job%odd_factors(:, p + 1), lines(:, 2))
    call transform_row_back(job%plan, lines(:, 1), lines(:, 2), job%work(:, row))
  end subroutine convolve_row

  !> Multiply row `p` by its `factors` and transform it to `waves`.
  subroutine transform_row(plan, p, twisted, row, factors, waves)
    type(split_plan), intent(in) :: plan
    integer, intent(in) :: p
    logical, intent(in) :: twisted
    real(c_double), intent(inout), contiguous, target :: row(:), factors(:), waves(:)

    call plan%multiply_by_factors(p, twisted, row, factors)
    call plan%along_row%transform_to(c_loc(row), c_loc(waves))
  end subroutine transform_row

  !> Transform `waves` to the `row`, multiplied by its `factors`.
  subroutine transform_row_back(plan, factors, waves, row)
    type(split_plan), intent(in) :: plan
    real(c_double), intent(in), contiguous :: factors(:)
    real(c_double), intent(inout), contiguous, target :: waves(:), row(:)

    call plan%along_row%transform_to(c_loc(waves), c_loc(row))
    call multiply_row(2*plan%columns, factors, row)
  end subroutine transform_row_back

  !> Multiply the numbers k of `one` and M - k of `other`, which are the last ones first, by the spectrum, and exchange
  !> their real and imaginary parts.
  pure subroutine multiply_pairs(factors, one, other)
    real(dp), intent(in), contiguous :: factors(:, :)
    real(c_double), intent(inout), contiguous :: one(:), other(:)
    real(dp) :: a(2), b(2)
    integer :: i, j, k

    do k = 1, size(factors, 2)
      i = 2*k - 1
      j = size(other) - i
      a = one(i:i + 1)
      b = other(j:j + 1)
      one(i) = factors(1, k)*a(2) + factors(3, k)*b(1)
      one(i + 1) = factors(1, k)*a(1) + factors(3, k)*b(2)
      other(j) = factors(2, k)*b(2) + factors(3, k)*a(1)
      other(j + 1) = factors(2, k)*b(1) + factors(3, k)*a(2)
    end do
  end subroutine multiply_pairs

  !> Multiply complex numbers, `z` (real and imaginary parts), by real ones, and exchange their parts.
  pure subroutine multiply_exchanging(factors, z)
    real(dp), intent(in), contiguous :: factors(:)
    real(c_double), intent(inout), contiguous :: z(:)
    real(dp) :: real_part
    integer :: k

    do k = 1, size(factors)
      real_part = z(2*k - 1)
      z(2*k - 1) = factors(k)*z(2*k)
      z(2*k) = factors(k)*real_part
    end do
  end subroutine multiply_exchanging

  !> Transform columns of both circles back to y.
  subroutine transform_columns_back(part, parts, data) bind(c, name='')
    integer(c_int), intent(in), value :: part, parts
    type(c_ptr), intent(in), value :: data
    type(product_job), pointer :: job
    real(c_double), pointer, contiguous :: lines(:, :)
    integer :: block, done, first, from, to

    call c_f_pointer(data, job)
    call find_lines(job, int(part), lines)
    call share(blocks_of_columns(job%plan), int(part), int(parts), from, to)
    do block = from, to
      call find_columns(job%plan, block, first, done)
      call get_lines(job, first, lines(:, 2:))
      call transform_lines(job, lines)
      call scatter_values(job%plan, lines, first, done, job%padded, job%y)
    end do
  end subroutine transform_columns_back

  !> The reverse of `gather_values`, for numbers whose real and imaginary parts are exchanged, but for the columns that
  !> are `done`.
  pure subroutine scatter_values(plan, lines, first, done, padded, y)
    type(split_plan), intent(in) :: plan
    real(c_double), intent(in), contiguous :: lines(:, :)
    integer, intent(in) :: first, done
    logical, intent(in) :: padded
    real(dp), intent(inout), contiguous :: y(:)
    real(dp) :: one(WIDTH), other(WIDTH), w(2)
    integer :: c, r

    do r = 0, plan%rows - 1
      call take_pairs(lines, r, one)
      call take_pairs(lines, r + plan%rows, other)
      if (padded) then
        w = plan%row_twist(:, r)
        do c = 1, WIDTH
          one(c) = one(c) + (w(1)*lines(2*r + 2, WIDTH + c) + w(2)*lines(2*r + 1, WIDTH + c))
          other(c) = other(c) - (w(1)*lines(2*r + 1, WIDTH + c) - w(2)*lines(2*r + 2, WIDTH + c))
        end do
      end if
      call put_values(one, plan%columns*r + first, done, y)
      call put_values(other, plan%columns*(r + plan%rows) + first, done, y)
    end do
  end subroutine scatter_values

  !> The reverse of `put_pairs`, for numbers whose real and imaginary parts are exchanged.
  pure subroutine take_pairs(lines, r, values)
    real(c_double), intent(in), contiguous :: lines(:, :)
    integer, intent(in) :: r
    real(dp), intent(inout) :: values(WIDTH)
    integer :: begin, c, k

    begin = mod(r, 2)*HALF
    k = 2*(r/2)
    do c = 1, HALF
      values(2*c - 1) = lines(k + 2, begin + c)
      values(2*c) = lines(k + 1, begin + c)
    end do
  end subroutine take_pairs

  !> The reverse of `get_values`, but for the first values, which are `done`.
  pure subroutine put_values(values, begin, done, y)
    real(dp), intent(in) :: values(WIDTH)
    integer, intent(in) :: begin, done
    real(dp), intent(inout), contiguous :: y(:)
    integer :: c

    if (done == 0 .and. begin <= size(y) - WIDTH) then
      do c = 1, WIDTH
        y(begin + c) = values(c)
      end do
    else
      do c = done + 1, min(WIDTH, size(y) - begin)
        y(begin + c) = values(c)
      end do
    end if
  end subroutine put_values

end module fuge_split_convolution
