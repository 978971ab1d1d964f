!> Products with convolution matrices of two-dimensional grids, by Fourier transforms of their lines.
!>
!> The kernel is even in both directions, so that its spectrum is real and a quarter of it holds the rest. Value
!> (i, j) of a grid of nx x ny has the number i + nx*(j - 1). A row and the next one are transformed together, as
!> the real and imaginary parts of complex numbers z; if z' is the number that belongs to the opposite wave, the
!> transforms of the two rows are (z + conj z')/2 and (z - conj z')/2i.
!>
!> In a direction that is not periodic ("padded") the circle has 2N >= 2n cells, of which only n hold values and
!> only n results are wanted. As in fuge_convolution it is split in two circles of N: waves of even number, and
!> waves of odd number, for which the values are multiplied by exp(-i pi j/N) before the transform and after it by
!> the conjugate. So neither zeros nor unwanted results are ever transformed, rows of zeros are skipped, and one
!> plan of N serves padded and cyclic convolutions.
!>
!> Columns are copied to a buffer a few at a time, so that each is transformed, multiplied and transformed back in
!> cache.
module fuge_grid_convolution
  use, intrinsic :: iso_c_binding, only: c_double, c_loc, c_ptr
  use fuge_constants, only: PI
  use fuge_fft, only: allocate_values, fft_plan, release_buffer
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info, FUGE_DONE, FUGE_ERR_CALL_ORDER, FUGE_ERR_MEMORY, FUGE_ERR_SIZE
  implicit none
  private

  !> Columns in the buffer.
  integer, parameter :: COLUMNS = 4
  !> Rows whose distance in memory is a multiple of so many bytes fall on the same places of the cache.
  integer, parameter :: PAGE = 4096

  !> Transforms of the lines of a grid.
  type, public :: grid_plan
    !> nx and ny; 0 before `set`.
    integer :: cells(2) = 0
    !> N of each direction.
    integer :: length(2) = 0
    type(fft_plan), private :: rows, columns
    !> cos and sin of pi j/N, j = 0 .. N - 1, (2, N).
    real(dp), allocatable, private :: row_twist(:, :), column_twist(:, :)
  contains
    procedure :: set => set_plan
    procedure :: transform_even
    procedure :: copy_from => copy_plan
    procedure :: move_from => move_plan
    final :: release_plan
  end type grid_plan

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

contains

  !> Plan transforms of `cells` (2) values on circles of `length` (2) >= `cells`, or twice that.
  !>
  !> `measured` as in fuge_fft. Errors, the plan unchanged: FUGE_ERR_SIZE, FUGE_ERR_OPTION, FUGE_ERR_MEMORY.
  subroutine set_plan(self, cells, length, info, measured)
    class(grid_plan), intent(inout) :: self
    integer, intent(in) :: cells(2), length(2)
    type(fuge_info), intent(inout) :: info
    logical, intent(in) :: measured
    type(grid_plan) :: new
    integer :: stat

    call new%rows%set(2*length(1), info, measured=measured, separate=.true.)
    if (.not. info%failed()) call new%columns%set(2*length(2), info, measured=measured, separate=.true.)
    if (info%failed()) return
    allocate (new%row_twist(2, length(1)), new%column_twist(2, length(2)), stat=stat)
    if (stat /= 0) then
      info%status = FUGE_ERR_MEMORY
      return
    end if
    call compute_twist(new%row_twist)
    call compute_twist(new%column_twist)
    new%cells = cells
    new%length = length
    call self%move_from(new)
  end subroutine set_plan

  pure subroutine compute_twist(twist)
    real(dp), intent(out) :: twist(:, :)
    real(dp) :: angle
    integer :: j

    do j = 1, size(twist, 2)
      angle = PI*(real(j - 1, dp)/real(size(twist, 2), dp))
      twist(:, j) = [cos(angle), sin(angle)]
    end do
  end subroutine compute_twist

  !> Replace even sequences by their spectra.
  !>
  !> Each column of `lines` (0:m, :) holds the values at the distances 0 .. m on a circle, m = N of 2N `padded`
  !> cells, or m = N/2 of N; N the length of the plan in `direction` 1 or 2. On return it holds the waves in the
  !> order of a kernel's spectrum. `status`: 0, FUGE_ERR_SIZE or FUGE_ERR_MEMORY.
  subroutine transform_even(self, direction, padded, lines, status)
    class(grid_plan), intent(in) :: self
    integer, intent(in) :: direction
    logical, intent(in) :: padded
    real(dp), intent(inout), contiguous :: lines(0:, :)
    integer, intent(out) :: status

    status = FUGE_ERR_SIZE
    if (size(lines, 1) /= stored_waves(self%length(direction), padded)) return
    if (direction == 1) then
      call transform_even_lines(self%rows, self%row_twist, padded, lines, status)
    else
      call transform_even_lines(self%columns, self%column_twist, padded, lines, status)
    end if
  end subroutine transform_even

  !> Two lines at a time: their spectra are real.
  subroutine transform_even_lines(plan, twist, padded, lines, status)
    type(fft_plan), intent(in) :: plan
    real(dp), intent(in), contiguous :: twist(:, :)
    logical, intent(in) :: padded
    real(dp), intent(inout), contiguous :: lines(0:, :)
    integer, intent(out) :: status
    real(c_double), pointer, contiguous :: z(:, :)
    type(c_ptr) :: buffer
    real(dp) :: one, other
    integer :: half, j, k, n, next

    n = size(twist, 2)
    half = n/2
    call allocate_values(2*n, 4, buffer, z, status)
    if (status /= FUGE_DONE) return
    do k = 1, size(lines, 2), 2
      next = min(k + 1, size(lines, 2))
      do j = 0, n - 1
        if (padded) then
          z(2*j + 1:2*j + 2, 1) = [lines(j, k) + lines(n - j, k), lines(j, next) + lines(n - j, next)]
          one = lines(j, k) - lines(n - j, k)
          other = lines(j, next) - lines(n - j, next)
          z(2*j + 1, 2) = twist(1, j + 1)*one + twist(2, j + 1)*other
          z(2*j + 2, 2) = twist(1, j + 1)*other - twist(2, j + 1)*one
        else
          z(2*j + 1:2*j + 2, 1) = [lines(min(j, n - j), k), lines(min(j, n - j), next)]
        end if
      end do
      call plan%transform_to(c_loc(z(1, 1)), c_loc(z(1, 3)))
      lines(0:half, k) = z(1:2*half + 1:2, 3)
      lines(0:half, next) = z(merge(1, 2, next == k):2*half + 2:2, 3)
      if (.not. padded) cycle
      call plan%transform_to(c_loc(z(1, 2)), c_loc(z(1, 4)))
      lines(half + 1:n, k) = z(1:2*(n - half) - 1:2, 4)
      lines(half + 1:n, next) = z(merge(1, 2, next == k):2*(n - half):2, 4)
    end do
    call release_buffer(buffer)
  end subroutine transform_even_lines

  !> How many waves of a direction a spectrum holds.
  pure function stored_waves(length, padded) result(count)
    integer, intent(in) :: length
    logical, intent(in) :: padded
    integer :: count

    count = merge(length, length/2, padded) + 1
  end function stored_waves

  subroutine move_plan(self, source)
    class(grid_plan), intent(inout) :: self, source

    call clear_plan(self)
    self%cells = source%cells
    self%length = source%length
    call self%rows%move_from(source%rows)
    call self%columns%move_from(source%columns)
    if (allocated(source%row_twist)) call move_alloc(source%row_twist, self%row_twist)
    if (allocated(source%column_twist)) call move_alloc(source%column_twist, self%column_twist)
    source%cells = 0
    source%length = 0
  end subroutine move_plan

  !> Plan anew what `source` plans; without memory, or if it plans nothing, the copy plans nothing.
  subroutine copy_plan(self, source)
    class(grid_plan), intent(inout) :: self
    class(grid_plan), intent(in) :: source
    type(grid_plan) :: new
    type(fuge_info) :: info

    if (source%cells(1) > 0) call new%set(source%cells, source%length, info, source%rows%measured)
    call self%move_from(new)
  end subroutine copy_plan

  subroutine clear_plan(self)
    class(grid_plan), intent(inout) :: self

    if (allocated(self%row_twist)) deallocate (self%row_twist)
    if (allocated(self%column_twist)) deallocate (self%column_twist)
    self%cells = 0
    self%length = 0
  end subroutine clear_plan

  impure elemental subroutine release_plan(self)
    type(grid_plan), intent(inout) :: self

    call clear_plan(self)
  end subroutine release_plan

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
    real(dp) :: circle
    integer :: k

    status = FUGE_ERR_SIZE
    if (.not. allocated(spectrum)) return
    if (size(spectrum, 2) /= stored_waves(plan%length(1), padded(1))) return
    if (size(spectrum, 1) /= stored_waves(plan%length(2), padded(2))) return
    status = FUGE_DONE
    self%padded = padded
    if (allocated(self%spectrum)) deallocate (self%spectrum)
    call move_alloc(spectrum, self%spectrum)
    ! Half of each pair of rows.
    circle = 2.0_dp*product(real(plan%length, dp)*merge(2.0_dp, 1.0_dp, padded))
    do k = lbound(self%spectrum, 2), ubound(self%spectrum, 2)
      self%spectrum(:, k) = self%spectrum(:, k)/circle
    end do
  end subroutine set_kernel

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
  !> `plan` of the kernel's lengths; `x` and `y` of its cells, x continued by zeros. Several threads may use kernel and
  !> plan at once. `status`: 0, or with y unchanged FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE, FUGE_ERR_MEMORY.
  subroutine convolve(self, plan, x, y, status)
    class(grid_kernel), intent(in) :: self
    type(grid_plan), intent(in) :: plan
    real(dp), intent(in), contiguous :: x(:)
    real(dp), intent(inout), contiguous :: y(:)
    integer, intent(out) :: status
    real(c_double), pointer, contiguous :: work(:, :), lines(:, :)
    type(c_ptr) :: work_buffer, line_buffer
    logical, allocatable :: zero(:)
    integer :: nx, pairs, stat

    status = FUGE_ERR_CALL_ORDER
    if (.not. allocated(self%spectrum) .or. plan%cells(1) < 1) return
    status = FUGE_ERR_SIZE
    if (size(x) /= product(plan%cells) .or. size(y) /= size(x)) return
    nx = plan%cells(1)
    pairs = (plan%cells(2) + 1)/2
    allocate (zero(pairs), stat=stat)
    status = FUGE_ERR_MEMORY
    if (stat /= 0) return
    call allocate_values(row_stride(plan%length(1), self%padded(1)), pairs, work_buffer, work, status)
    if (status /= FUGE_DONE) return
    call allocate_values(2*maxval(plan%length) + 2, COLUMNS + 2, line_buffer, lines, status)
    if (status == FUGE_DONE) then
      call transform_rows(self, plan, x, work, zero, lines)
      call convolve_columns(self, plan, zero, work, lines)
      call transform_rows_back(self, plan, work, y, lines)
      call release_buffer(line_buffer)
    end if
    call release_buffer(work_buffer)
  end subroutine convolve

  !> Real numbers from one pair of rows to the next.
  pure function row_stride(length, padded) result(stride)
    integer, intent(in) :: length
    logical, intent(in) :: padded
    integer :: stride

    stride = 2*length*merge(2, 1, padded)
    if (mod(8*stride, PAGE) == 0) stride = stride + 8
  end function row_stride

  !> Transform pairs of rows of x; `zero` where there is nothing to transform.
  subroutine transform_rows(self, plan, x, work, zero, lines)
    type(grid_kernel), intent(in) :: self
    type(grid_plan), intent(in) :: plan
    real(dp), intent(in), contiguous :: x(:)
    real(c_double), intent(inout), contiguous, target :: work(:, :), lines(:, :)
    logical, intent(out) :: zero(:)
    integer :: first, j, nx, p

    nx = plan%cells(1)
    do p = 1, size(zero)
      first = 2*(p - 1)*nx
      if (2*p <= plan%cells(2)) then
        zero(p) = all(abs(x(first + 1:first + 2*nx)) <= 0.0_dp)
        if (zero(p)) cycle
        do j = 1, nx
          lines(2*j - 1, 1) = x(first + j)
          lines(2*j, 1) = x(first + nx + j)
        end do
      else
        zero(p) = all(abs(x(first + 1:first + nx)) <= 0.0_dp)
        if (zero(p)) cycle
        do j = 1, nx
          lines(2*j - 1, 1) = x(first + j)
          lines(2*j, 1) = 0.0_dp
        end do
      end if
      lines(2*nx + 1:2*plan%length(1), 1) = 0.0_dp
      call plan%rows%transform_to(c_loc(lines), c_loc(work(1, p)))
      if (.not. self%padded(1)) cycle
      call twist_line(plan%row_twist, nx, lines(:, 1), lines(:, 2))
      call plan%rows%transform_to(c_loc(lines(1, 2)), c_loc(work(2*plan%length(1) + 1, p)))
    end do
  end subroutine transform_rows

  !> Transform pairs of rows back to y.
  subroutine transform_rows_back(self, plan, work, y, lines)
    type(grid_kernel), intent(in) :: self
    type(grid_plan), intent(in) :: plan
    real(c_double), intent(inout), contiguous, target :: work(:, :), lines(:, :)
    real(dp), intent(inout), contiguous :: y(:)
    integer :: first, j, nx, p

    nx = plan%cells(1)
    do p = 1, size(work, 2)
      call plan%rows%transform_to(c_loc(work(1, p)), c_loc(lines))
      if (self%padded(1)) then
        call plan%rows%transform_to(c_loc(work(2*plan%length(1) + 1, p)), c_loc(lines(1, 2)))
        call add_untwisted(plan%row_twist, nx, lines(:, 2), lines(:, 1))
      end if
      first = 2*(p - 1)*nx
      do j = 1, nx
        y(first + j) = lines(2*j, 1)
      end do
      if (2*p > plan%cells(2)) cycle
      do j = 1, nx
        y(first + nx + j) = lines(2*j - 1, 1)
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
  subroutine convolve_columns(self, plan, zero, work, lines)
    type(grid_kernel), intent(in) :: self
    type(grid_plan), intent(in) :: plan
    logical, intent(in) :: zero(:)
    real(c_double), intent(inout), contiguous, target :: work(:, :), lines(:, :)
    integer :: circle, first, k, last, most, n

    n = plan%length(1)
    do circle = 0, merge(1, 0, self%padded(1))
      ! Waves above are the opposites of those below.
      most = merge(n/2, (n - 1)/2, circle == 0)
      do first = 0, most, COLUMNS
        last = min(first + COLUMNS - 1, most)
        call gather(n, circle, first, last, plan%cells(2), plan%length(2), zero, work, lines)
        do k = first, last
          call convolve_column(plan, self%padded(2), self%spectrum(:, k + circle*(n/2 + 1)), &
                               lines(:, k - first + 1), lines(:, COLUMNS + 1), lines(:, COLUMNS + 2))
        end do
        call scatter(n, circle, first, last, plan%cells(2), lines, work)
      end do
    end do
  end subroutine convolve_columns

  !> The place in a pair of rows, from 0, of the wave opposite to wave k.
  pure function opposite(n, circle, k) result(other)
    integer, intent(in) :: n, circle, k
    integer :: other

    if (circle == 0) then
      other = modulo(n - k, n)
    else
      other = n - 1 - k
    end if
  end function opposite

  !> Twice the transforms of single rows, of the waves `first` .. `last`: column 1, 2, .. of `lines`, `length` complex
  !> numbers of which `rows` belong to rows.
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

  !> Convolve one column `f` with the kernel whose spectrum along y is `spectrum`; the result has real and imaginary
  !> parts exchanged. `t` and `u` are for work.
  subroutine convolve_column(plan, padded, spectrum, f, t, u)
    type(grid_plan), intent(in) :: plan
    logical, intent(in) :: padded
    real(dp), intent(in), contiguous :: spectrum(0:)
    real(c_double), intent(inout), contiguous, target :: f(:), t(:), u(:)
    integer :: n, rows

    n = plan%length(2)
    rows = plan%cells(2)
    call plan%columns%transform_to(c_loc(f), c_loc(t))
    call multiply_even(n, spectrum(:n/2), t)
    if (.not. padded) then
      call plan%columns%transform_to(c_loc(t), c_loc(f))
      return
    end if
    call plan%columns%transform_to(c_loc(t), c_loc(u))
    call twist_line(plan%column_twist, rows, f, t)
    call plan%columns%transform_to(c_loc(t), c_loc(f))
    call multiply_odd(n, spectrum(n/2 + 1:), f)
    call plan%columns%transform_to(c_loc(f), c_loc(t))
    f(:2*rows) = u(:2*rows)
    call add_untwisted(plan%column_twist, rows, t, f)
  end subroutine convolve_column

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
