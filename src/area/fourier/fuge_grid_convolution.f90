!> Products with convolution matrices of two-dimensional grids, by Fourier transforms of their lines.
!>
!> The kernel is even in both directions, so that its spectrum is real and a quarter of it holds the rest. Value
!> (i, j) of a grid of nx x ny has the number i + nx*(j - 1). A row and the next one are transformed together, as
!> the real and imaginary parts of complex numbers z; if z' is the number that belongs to the opposite wave, the
!> transforms of the two rows are (z + conj z')/2 and (z - conj z')/2i.
!>
!> In a direction that is not periodic ("padded") the circle has 2N >= 2n cells, of which only n hold values and
!> only n results are wanted. It is split in two circles of N (fuge_grid_plan), so that neither zeros nor unwanted
!> results are ever transformed. Rows of zeros are skipped.
!>
!> Columns are copied to a buffer a few at a time, so that each is transformed, multiplied and transformed back in
!> cache. Threads share rows, then columns, then rows; each line is computed as by one thread, so that the result is the
!> same to the last bit.
module fuge_grid_convolution
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_int, c_loc, c_ptr
  use fuge_fft, only: allocate_values, fft_plan, release_buffer
  use fuge_grid_plan, only: grid_plan, return_rows, stored_waves, take_rows, taken_rows
  use fuge_kinds, only: dp
  use fuge_status, only: FUGE_DONE, FUGE_ERR_CALL_ORDER, FUGE_ERR_MEMORY, FUGE_ERR_SIZE
  use fuge_threads, only: run_in_threads, share, threads_here
  implicit none
  private

  public :: add_untwisted, convolve_line, opposite, twist_line

  !> Columns in the buffer.
  integer, parameter :: COLUMNS = 16
  !> Rows whose distance in memory is a multiple of PAGE bytes displace each other from the cache.
  integer, parameter :: PAGE = 4096

  !> Fewer cells are multiplied by one thread: waking others would take as long.
  integer, parameter :: FEWEST_FOR_THREADS = 4096

  !> The spectrum of an even kernel.
  type, public :: grid_kernel
    !> Is the circle twice as long as N?
    logical :: padded(2) = .false.
    !> (0:my, 0:mx): for each direction the numbers 0, 1, .. N/2 of the waves of a circle of N, or if it is padded the
    !> even ones 0, 2, .. of a circle of 2N up to N and then the odd ones 1, 3, .. up to N. Includes the factor of the
    !> transforms.
    real(dp), allocatable, private :: spectrum(:, :)
  contains
    procedure :: set => set_kernel
    procedure :: is_set
    procedure :: copy_from => copy_kernel
    procedure :: move_from => move_kernel
    procedure :: convolve
    final :: release_kernel
  end type grid_kernel

  !> One product, for the threads that share it.
  type :: product_job
    integer :: cells(2) = 0, length(2) = 0
    logical :: padded(2) = .false.
    !> Added to the inverse of the kernel, times its factor; 0 for none.
    real(dp) :: softening = 0.0_dp
    type(fft_plan), pointer :: rows => null(), columns => null()
    real(dp), pointer, contiguous :: row_twist(:, :) => null(), column_twist(:, :) => null(), spectrum(:, :) => null()
    real(dp), pointer, contiguous :: x(:) => null(), y(:) => null()
    !> Transforms of pairs of rows, and those of which there is nothing to transform.
    real(c_double), pointer, contiguous :: work(:, :) => null()
    logical, pointer, contiguous :: zero(:) => null()
    !> Buffers of a thread: COLUMNS + 2 lines each.
    real(c_double), pointer, contiguous :: lines(:, :) => null()
  end type product_job

contains

  !> Set the spectrum of a convolution on the circles of `plan`, `padded` (2) or not.
  !>
  !> `spectrum` (0:my, 0:mx) as described at the type, moved and divided by the cells of both circles. `status`: 0 or
  !> FUGE_ERR_SIZE.
  pure subroutine set_kernel(self, plan, padded, spectrum, status)
    class(grid_kernel), intent(inout) :: self
    type(grid_plan), intent(in) :: plan
    logical, intent(in) :: padded(2)
    real(dp), allocatable, intent(inout) :: spectrum(:, :)
    integer, intent(out) :: status
    integer :: k

    status = FUGE_ERR_SIZE
    if (.not. allocated(spectrum)) return
    if (size(spectrum, 2) /= stored_waves(plan%length(1), padded(1))) return
    if (size(spectrum, 1) /= stored_waves(plan%length(2), padded(2))) return
    status = FUGE_DONE
    self%padded = padded
    if (allocated(self%spectrum)) deallocate (self%spectrum)
    call move_alloc(spectrum, self%spectrum)
    do k = lbound(self%spectrum, 2), ubound(self%spectrum, 2)
      self%spectrum(:, k) = self%spectrum(:, k)/circle_factor(plan, padded)
    end do
  end subroutine set_kernel

  !> What the transforms multiply by, twice, because half of each pair of rows is wanted.
  pure function circle_factor(plan, padded) result(factor)
    type(grid_plan), intent(in) :: plan
    logical, intent(in) :: padded(2)
    real(dp) :: factor

    factor = 2.0_dp*product(real(plan%length, dp)*merge(2.0_dp, 1.0_dp, padded))
  end function circle_factor

  pure function is_set(self)
    class(grid_kernel), intent(in) :: self
    logical :: is_set

    is_set = allocated(self%spectrum)
  end function is_set

  !> Copy a kernel; an array of the right size is kept. `status` is not 0 without memory, and the copy is not set then.
  pure subroutine copy_kernel(self, source, status)
    class(grid_kernel), intent(inout) :: self
    class(grid_kernel), intent(in) :: source
    integer, intent(out) :: status
    logical :: same

    status = 0
    self%padded = source%padded
    same = allocated(self%spectrum) .and. allocated(source%spectrum)
    if (same) same = all(shape(self%spectrum) == shape(source%spectrum))
    if (.not. same .and. allocated(self%spectrum)) deallocate (self%spectrum)
    if (.not. allocated(source%spectrum)) return
    if (.not. same) then
      allocate (self%spectrum(lbound(source%spectrum, 1):ubound(source%spectrum, 1), &
                              lbound(source%spectrum, 2):ubound(source%spectrum, 2)), stat=status)
    end if
    if (status == 0) self%spectrum(:, :) = source%spectrum
  end subroutine copy_kernel

  pure subroutine move_kernel(self, source)
    class(grid_kernel), intent(inout) :: self, source

    if (allocated(self%spectrum)) deallocate (self%spectrum)
    self%padded = source%padded
    if (allocated(source%spectrum)) call move_alloc(source%spectrum, self%spectrum)
  end subroutine move_kernel

  !> gfortran 12 does not free this array where a user's type holds an operator that holds the kernel.
  elemental subroutine release_kernel(self)
    type(grid_kernel), intent(inout) :: self

    if (allocated(self%spectrum)) deallocate (self%spectrum)
  end subroutine release_kernel

  !> y = the convolution of x with the kernel.
  !>
  !> `plan` of the kernel's lengths; `x` and `y` of its `n` cells, x continued by zeros. With
  !> `softening` >= 0 each number s of the spectrum becomes s/(1 + softening s): to the inverse of the kernel is added
  !> `softening`. Several threads may use kernel and plan at once. `status`: 0, or with y unchanged FUGE_ERR_CALL_ORDER,
  !> FUGE_ERR_SIZE, FUGE_ERR_MEMORY. The arrays have an explicit shape, because gfortran copies arrays to pass them as
  !> contiguous ones.
  subroutine convolve(self, plan, n, x, y, status, softening)
    class(grid_kernel), intent(in), target :: self
    type(grid_plan), intent(in), target :: plan
    integer, intent(in) :: n
    real(dp), intent(in), target :: x(n)
    real(dp), intent(inout), target :: y(n)
    integer, intent(out) :: status
    real(dp), intent(in), optional :: softening
    type(product_job), target :: job
    logical, allocatable, target :: zero(:)
    type(taken_rows) :: rows
    type(c_ptr) :: lines
    integer :: stat, threads

    status = FUGE_ERR_CALL_ORDER
    if (.not. allocated(self%spectrum) .or. plan%cells(1) < 1 .or. .not. plan%rows%owns_plans()) return
    status = FUGE_ERR_SIZE
    if (n /= product(plan%cells)) return
    allocate (zero((plan%cells(2) + 1)/2), stat=stat)
    status = FUGE_ERR_MEMORY
    if (stat /= 0) return
    call describe_job(self, plan, x, y, job)
    if (present(softening)) job%softening = softening*circle_factor(plan, self%padded)
    job%zero => zero
    call take_rows(plan%kept, row_stride(job%length(1), job%padded(1)), size(zero), rows, job%work, status)
    if (status /= FUGE_DONE) return
    threads = 1
    if (n >= FEWEST_FOR_THREADS) threads = threads_here()
    call allocate_values(2*maxval(plan%length) + 2, (COLUMNS + 2)*threads, lines, job%lines, status)
    if (status == FUGE_DONE) then
      call run_in_threads(threads, transform_rows, c_loc(job))
      call run_in_threads(threads, convolve_columns, c_loc(job))
      call run_in_threads(threads, transform_rows_back, c_loc(job))
      call release_buffer(lines)
    end if
    call return_rows(plan%kept, rows)
  end subroutine convolve

  !> The product as the threads see it. By addresses, because no pointer may be associated with arguments that are read
  !> only.
  subroutine describe_job(kernel, plan, x, y, job)
    class(grid_kernel), intent(in), target :: kernel
    type(grid_plan), intent(in), target :: plan
    real(dp), intent(in), contiguous, target :: x(:)
    real(dp), intent(inout), contiguous, target :: y(:)
    type(product_job), intent(inout) :: job

    job%cells = plan%cells
    job%length = plan%length
    job%padded = kernel%padded
    call c_f_pointer(c_loc(plan%rows), job%rows)
    call c_f_pointer(c_loc(plan%columns), job%columns)
    call c_f_pointer(c_loc(plan%row_twist), job%row_twist, shape(plan%row_twist))
    call c_f_pointer(c_loc(plan%column_twist), job%column_twist, shape(plan%column_twist))
    call c_f_pointer(c_loc(kernel%spectrum), job%spectrum, shape(kernel%spectrum))
    call c_f_pointer(c_loc(x), job%x, shape(x))
    call c_f_pointer(c_loc(y), job%y, shape(y))
  end subroutine describe_job

  !> Real numbers from one pair of rows to the next.
  pure function row_stride(length, padded) result(stride)
    integer, intent(in) :: length
    logical, intent(in) :: padded
    integer :: stride

    stride = 2*length*merge(2, 1, padded)
    if (mod(8*stride, PAGE) == 0) stride = stride + 8
  end function row_stride

  !> Buffers of a thread.
  subroutine find_lines(job, part, lines)
    type(product_job), intent(in) :: job
    integer, intent(in) :: part
    real(c_double), pointer, contiguous, intent(out) :: lines(:, :)

    lines => job%lines(:, (COLUMNS + 2)*part + 1:(COLUMNS + 2)*(part + 1))
  end subroutine find_lines

  !> Transform pairs of rows of x.
  subroutine transform_rows(part, parts, data) bind(c, name='')
    integer(c_int), intent(in), value :: part, parts
    type(c_ptr), intent(in), value :: data
    type(product_job), pointer :: job
    real(c_double), pointer, contiguous :: lines(:, :)
    integer :: first, last, n, p

    call c_f_pointer(data, job)
    call find_lines(job, int(part), lines)
    call share(size(job%zero), int(part), int(parts), first, last)
    n = job%length(1)
    do p = first + 1, last + 1
      call pack_rows(job, p, lines(:, 1))
      if (job%zero(p)) cycle
      call job%rows%transform_to(c_loc(lines), c_loc(job%work(1, p)))
      if (.not. job%padded(1)) cycle
      call twist_line(job%row_twist, job%cells(1), lines(:, 1), lines(:, 2))
      call job%rows%transform_to(c_loc(lines(1, 2)), c_loc(job%work(2*n + 1, p)))
    end do
  end subroutine transform_rows

  !> Row 2 p - 1 and row 2 p of x as real and imaginary parts, unless both are zero.
  subroutine pack_rows(job, p, line)
    type(product_job), intent(inout) :: job
    integer, intent(in) :: p
    real(c_double), intent(inout), contiguous :: line(:)
    integer :: first, j, nx

    nx = job%cells(1)
    first = 2*(p - 1)*nx
    job%zero(p) = all(abs(job%x(first + 1:first + merge(2, 1, 2*p <= job%cells(2))*nx)) <= 0.0_dp)
    if (job%zero(p)) return
    do j = 1, nx
      line(2*j - 1) = job%x(first + j)
      line(2*j) = 0.0_dp
    end do
    if (2*p <= job%cells(2)) then
      do j = 1, nx
        line(2*j) = job%x(first + nx + j)
      end do
    end if
    line(2*nx + 1:2*job%length(1)) = 0.0_dp
  end subroutine pack_rows

  !> Transform pairs of rows back to y.
  subroutine transform_rows_back(part, parts, data) bind(c, name='')
    integer(c_int), intent(in), value :: part, parts
    type(c_ptr), intent(in), value :: data
    type(product_job), pointer :: job
    real(c_double), pointer, contiguous :: lines(:, :)
    integer :: begin, first, j, last, nx, p

    call c_f_pointer(data, job)
    call find_lines(job, int(part), lines)
    call share(size(job%zero), int(part), int(parts), first, last)
    nx = job%cells(1)
    do p = first + 1, last + 1
      call job%rows%transform_to(c_loc(job%work(1, p)), c_loc(lines))
      if (job%padded(1)) then
        call job%rows%transform_to(c_loc(job%work(2*job%length(1) + 1, p)), c_loc(lines(1, 2)))
        call add_untwisted(job%row_twist, nx, lines(:, 2), lines(:, 1))
      end if
      begin = 2*(p - 1)*nx
      do j = 1, nx
        job%y(begin + j) = lines(2*j, 1)
      end do
      if (2*p > job%cells(2)) cycle
      do j = 1, nx
        job%y(begin + nx + j) = lines(2*j - 1, 1)
      end do
    end do
  end subroutine transform_rows_back

  !> `to` = `from` times exp(-i pi j/N), the first `count` complex numbers; zeros follow.
  pure subroutine twist_line(twist, count, from, to)
    real(dp), intent(in), contiguous :: twist(:, :), from(:)
    integer, intent(in) :: count
    real(dp), intent(inout), contiguous :: to(:)
    integer :: j

    do j = 1, count
      to(2*j - 1) = twist(1, j)*from(2*j - 1) + twist(2, j)*from(2*j)
      to(2*j) = twist(1, j)*from(2*j) - twist(2, j)*from(2*j - 1)
    end do
    to(2*count + 1:2*size(twist, 2)) = 0.0_dp
  end subroutine twist_line

  !> `to` = `to` + `from` times exp(i pi j/N), the first `count` complex numbers, all with real and imaginary parts
  !> exchanged.
  pure subroutine add_untwisted(twist, count, from, to)
    real(dp), intent(in), contiguous :: twist(:, :), from(:)
    integer, intent(in) :: count
    real(dp), intent(inout), contiguous :: to(:)
    integer :: j

    do j = 1, count
      to(2*j - 1) = to(2*j - 1) + (twist(1, j)*from(2*j - 1) + twist(2, j)*from(2*j))
      to(2*j) = to(2*j) + (twist(1, j)*from(2*j) - twist(2, j)*from(2*j - 1))
    end do
  end subroutine add_untwisted

  !> Convolve the columns of all waves along x; the results have real and imaginary parts exchanged.
  subroutine convolve_columns(part, parts, data) bind(c, name='')
    integer(c_int), intent(in), value :: part, parts
    type(c_ptr), intent(in), value :: data
    type(product_job), pointer :: job
    real(c_double), pointer, contiguous :: lines(:, :)
    integer :: block, circle, first, from, k, last, most, n, to

    call c_f_pointer(data, job)
    call find_lines(job, int(part), lines)
    n = job%length(1)
    do circle = 0, merge(1, 0, job%padded(1))
      ! Waves above are the opposites of those below.
      most = merge(n/2, (n - 1)/2, circle == 0)
      call share(most/COLUMNS + 1, int(part), int(parts), from, to)
      do block = from, to
        first = COLUMNS*block
        last = min(first + COLUMNS - 1, most)
        call gather(n, circle, first, last, job%cells(2), job%length(2), job%zero, job%work, lines)
        do k = first, last
          call convolve_column(job, k + circle*(n/2 + 1), lines(:, k - first + 1), lines(:, COLUMNS + 1), &
                               lines(:, COLUMNS + 2))
        end do
        call scatter(n, circle, first, last, job%cells(2), lines, job%work)
      end do
    end do
  end subroutine convolve_columns

  !> The place in a pair of rows, from 0, of the wave opposite to wave k.
  pure function opposite(n, circle, k) result(other)
    integer, intent(in) :: n, circle, k
    integer :: other

    if (circle == 0) then
      other = merge(0, n - k, k == 0)
    else
      other = n - 1 - k
    end if
  end function opposite

  !> Twice the transforms of single rows, of the waves `first` .. `last`: column 1, 2, .. of `lines`, `length` complex
  !> numbers of which `rows` belong to rows. The arguments are nine, because lines of a transform are plain arrays
  !> with their sizes.
  pure subroutine gather(n, circle, first, last, rows, length, zero, work, lines)
    integer, intent(in) :: n, circle, first, last, rows, length
    logical, intent(in) :: zero(:)
    real(c_double), intent(in), contiguous :: work(:, :)
    real(c_double), intent(inout), contiguous :: lines(:, :)
    integer :: c, i, k, p

    do p = 1, size(zero)
      if (zero(p)) then
        lines(4*p - 3:4*p, 1:last - first + 1) = 0.0_dp
        cycle
      end if
      do k = first, last
        c = k - first + 1
        i = 2*(n*circle + k)
        associate (z => work(i + 1:i + 2, p), o => 2*(n*circle + opposite(n, circle, k)))
          lines(4*p - 3, c) = z(1) + work(o + 1, p)
          lines(4*p - 2, c) = z(2) - work(o + 2, p)
          lines(4*p - 1, c) = z(2) + work(o + 2, p)
          lines(4*p, c) = work(o + 1, p) - z(1)
        end associate
      end do
    end do
    lines(2*rows + 1:2*length, 1:last - first + 1) = 0.0_dp
  end subroutine gather

  !> Convolve the column `f` of wave `k` of the kernel's spectrum; the result has real and imaginary parts exchanged.
  !> `t` and `u` are for work.
  subroutine convolve_column(job, k, f, t, u)
    type(product_job), intent(in) :: job
    integer, intent(in) :: k
    real(c_double), intent(inout), contiguous, target :: f(:), t(:), u(:)

    if (job%softening > 0.0_dp) then
      call convolve_line(job%columns, job%column_twist, job%cells(2), job%padded(2), &
                         job%spectrum(:, k + 1)/(1.0_dp + job%softening*job%spectrum(:, k + 1)), f, t, u)
    else
      call convolve_line(job%columns, job%column_twist, job%cells(2), job%padded(2), job%spectrum(:, k + 1), f, t, u)
    end if
  end subroutine convolve_column

  !> Convolve the complex numbers `f`, of which the first `count` are given and wanted, with the kernel that has the
  !> `spectrum`; the result has real and imaginary parts exchanged.
  !>
  !> `plan` and `twist` (2, N) of a circle of N, or of 2N if it is `padded`; `f`, `t` and `u` N complex numbers each,
  !> the last two for work.
  subroutine convolve_line(plan, twist, count, padded, spectrum, f, t, u)
    type(fft_plan), intent(in) :: plan
    real(dp), intent(in), contiguous :: twist(:, :), spectrum(:)
    integer, intent(in) :: count
    logical, intent(in) :: padded
    real(c_double), intent(inout), contiguous, target :: f(:), t(:), u(:)
    integer :: n

    n = size(twist, 2)
    call plan%transform_to(c_loc(f), c_loc(t))
    call multiply_even(n, spectrum(:n/2 + 1), t)
    if (.not. padded) then
      call plan%transform_to(c_loc(t), c_loc(f))
      return
    end if
    call plan%transform_to(c_loc(t), c_loc(u))
    call twist_line(twist, count, f, t)
    call plan%transform_to(c_loc(t), c_loc(f))
    call multiply_odd(n, spectrum(n/2 + 2:), f)
    call plan%transform_to(c_loc(f), c_loc(t))
    f(:2*count) = u(:2*count)
    call add_untwisted(twist, count, t, f)
  end subroutine convolve_line

  !> Multiply `n` complex numbers by the spectrum, of which the numbers 0 .. n/2 are given, and exchange their parts.
  pure subroutine multiply_even(n, spectrum, z)
    integer, intent(in) :: n
    real(dp), intent(in), contiguous :: spectrum(0:)
    real(c_double), intent(inout), contiguous :: z(:)

    call multiply_exchanging(spectrum, z(:2*(n/2) + 2))
    call multiply_exchanging(spectrum((n - 1)/2:1:-1), z(2*(n/2) + 3:2*n))
  end subroutine multiply_even

  !> The same, if the numbers 0 .. (n-1)/2 are given and number k is that of n - 1 - k.
  pure subroutine multiply_odd(n, spectrum, z)
    integer, intent(in) :: n
    real(dp), intent(in), contiguous :: spectrum(0:)
    real(c_double), intent(inout), contiguous :: z(:)

    call multiply_exchanging(spectrum, z(:2*((n + 1)/2)))
    call multiply_exchanging(spectrum(n/2 - 1:0:-1), z(2*((n + 1)/2) + 1:2*n))
  end subroutine multiply_odd

  pure subroutine multiply_exchanging(factors, z)
    real(dp), intent(in) :: factors(:)
    real(c_double), intent(inout), contiguous :: z(:)
    real(dp) :: real_part
    integer :: k

    do k = 1, size(factors)
      real_part = z(2*k - 1)
      z(2*k - 1) = factors(k)*z(2*k)
      z(2*k) = factors(k)*real_part
    end do
  end subroutine multiply_exchanging

  !> Pairs of rows from the columns that `gather` gave, all with real and imaginary parts exchanged.
  pure subroutine scatter(n, circle, first, last, rows, lines, work)
    integer, intent(in) :: n, circle, first, last, rows
    real(c_double), intent(inout), contiguous :: lines(:, :), work(:, :)
    integer :: c, i, k, o, p

    ! The second row of a last pair without one.
    if (mod(rows, 2) == 1) lines(2*rows + 1:2*rows + 2, 1:last - first + 1) = 0.0_dp
    do p = 1, (rows + 1)/2
      do k = first, last
        c = k - first + 1
        i = 2*(n*circle + k)
        o = 2*(n*circle + opposite(n, circle, k))
        associate (a => lines(4*p - 3:4*p - 2, c), b => lines(4*p - 1:4*p, c))
          work(o + 1, p) = b(2) - a(1)
          work(o + 2, p) = a(2) + b(1)
          work(i + 1, p) = a(1) + b(2)
          work(i + 2, p) = a(2) - b(1)
        end associate
      end do
    end do
  end subroutine scatter

end module fuge_grid_convolution
