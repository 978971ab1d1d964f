!> Products with convolution matrices of large two-dimensional grids in little memory: the waves along x are done in
!> slices, and the kernel is computed anew for each product.
!>
!> The product along x is one on a circle of L = 2 S M >= 2 nx cells round which values change their sign, so that its
!> waves are those of the angles 2 pi (q + 1/2)/L. Slice s = 0 .. S - 1 has the waves q = s + 2 S m, m = 0 .. M - 1:
!> values times exp(-i pi (2 s + 1) j/L), folded to M cells, and a transform of M (a decimation in frequency). The other
!> waves are the conjugates of these. Along y the circle is that of a grid plan, twice as long as the grid.
!>
!> Besides its argument and its result a product needs 16/S bytes for each cell, and for the kernel 8 bytes times the
!> part of the slices whose kernels are computed together. Threads share rows, then columns, then rows; no result
!> depends on how many there are.
module fuge_sliced_convolution
  use, intrinsic :: iso_c_binding, only: c_f_pointer, c_loc, c_null_ptr, c_ptr
  use fuge_constants, only: PI
  use fuge_even_spectrum, only: kernel_values
  use fuge_fft, only: allocate_values, fft_plan, good_length, release_buffer
  use fuge_grid_convolution, only: convolve_line
  use fuge_grid_plan, only: grid_plan
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info, FUGE_DONE, FUGE_ERR_CALL_ORDER, FUGE_ERR_MEMORY, FUGE_ERR_SIZE
  use fuge_threads, only: run_in_parts, share, threads_here, work_in_parts
  implicit none
  private

  public :: convolve_in_slices

  !> Columns of a buffer: 256 bytes of each row. And rows of the kernel that are computed together.
  integer, parameter :: COLUMNS = 16, ROWS = 32

  !> One product, for the threads that share it.
  type, extends(work_in_parts) :: sliced_product
    integer :: cells(2) = 0
    !> Numbers of slices, S, and of the waves in each, M.
    integer :: slices = 0, waves = 0
    !> The slices whose kernels are computed, and the one that is multiplied.
    integer :: first = 0, last = -1, slice = 0
    type(grid_plan), pointer :: plan => null()
    class(kernel_values), pointer :: kernel => null()
    type(fft_plan) :: line
    !> The spectra, (along y, M, slices of one computation), and the rows of one slice, (2 M and some more, ny).
    real(dp), allocatable :: spectra(:, :, :)
    real(dp), pointer, contiguous :: work(:, :) => null()
    real(dp), pointer, contiguous :: x(:, :) => null(), y(:, :) => null()
    !> Rows of x that are zero.
    logical, allocatable :: zero(:)
    !> FUGE_DONE, or what went wrong in each part.
    integer, allocatable :: status(:)
    procedure(do_stage), pointer, nopass :: stage => null()
  contains
    procedure :: do_part
  end type sliced_product

  abstract interface
    subroutine do_stage(job, part, parts, status)
      import :: sliced_product
      type(sliced_product), intent(inout) :: job
      integer, intent(in) :: part, parts
      integer, intent(out) :: status
    end subroutine do_stage
  end interface

contains

  !> y = the convolution of x with the kernel.
  !>
  !> `plan` of the `n` cells, of which there are several in each direction; `slices` and `together` >= 1: how many there
  !> are, and of how many the kernels are computed together. `status`: 0, FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE,
  !> FUGE_ERR_MEMORY; then y is undefined. The arrays have an explicit shape, as for `convolve` of grid_kernel.
  subroutine convolve_in_slices(plan, kernel, slices, together, n, x, y, status)
    type(grid_plan), intent(in), target :: plan
    class(kernel_values), intent(in), target :: kernel
    integer, intent(in) :: slices, together, n
    real(dp), intent(in), target :: x(n)
    real(dp), intent(inout), target :: y(n)
    integer, intent(out) :: status
    type(sliced_product) :: job
    type(c_ptr) :: work
    integer :: s

    status = FUGE_ERR_CALL_ORDER
    if (plan%cells(1) < 1) return
    status = FUGE_ERR_SIZE
    if (any(plan%cells < 2) .or. n /= product(plan%cells) .or. min(slices, together) < 1) return
    job%cells = plan%cells
    job%slices = slices
    job%plan => plan
    job%kernel => kernel
    call c_f_pointer(c_loc(x), job%x, plan%cells)
    job%y(1:plan%cells(1), 1:plan%cells(2)) => y
    call prepare(job, min(together, slices), work, status)
    if (status /= FUGE_DONE) return
    do s = 0, slices - 1
      job%slice = s
      if (s > job%last) then
        job%first = s
        job%last = min(s + together, slices) - 1
        call run(job, transform_kernel, status)
        if (status == FUGE_DONE) call run(job, transform_kernel_columns, status)
      end if
      if (status == FUGE_DONE) call run(job, fold_rows, status)
      if (status == FUGE_DONE) call run(job, multiply_columns, status)
      if (status == FUGE_DONE) call run(job, unfold_rows, status)
      if (status /= FUGE_DONE) exit
    end do
    call release_buffer(work)
  end subroutine convolve_in_slices

  !> Plan the transforms along x, and allocate what all slices use. `status`: 0 or FUGE_ERR_MEMORY.
  subroutine prepare(job, together, work, status)
    type(sliced_product), intent(inout) :: job
    integer, intent(in) :: together
    type(c_ptr), intent(out) :: work
    integer, intent(out) :: status
    type(fuge_info) :: info
    integer :: j, stat

    work = c_null_ptr
    status = FUGE_ERR_MEMORY
    job%waves = good_length((job%cells(1) - 1)/job%slices + 1)
    call job%line%set(2*job%waves, info, separate=.true.)
    if (info%failed()) return
    allocate (job%spectra(job%plan%length(2) + 1, job%waves, together), job%zero(job%cells(2)), &
              job%status(0:threads_here() - 1), stat=stat)
    if (stat /= 0) return
    do j = 1, job%cells(2)
      job%zero(j) = .not. any(abs(job%x(:, j)) > 0.0_dp)
    end do
    call allocate_values(line_stride(job%waves), job%cells(2), work, job%work, status)
  end subroutine prepare

  !> Real numbers from one line of complex numbers to the next; lines lie in different parts of the cache.
  pure function line_stride(length) result(stride)
    integer, intent(in) :: length
    integer :: stride

    stride = 2*length + modulo(-2*length, 8) + 8
  end function line_stride

  !> Do a `stage` in all threads. `status`: 0 or FUGE_ERR_MEMORY.
  subroutine run(job, stage, status)
    type(sliced_product), intent(inout) :: job
    procedure(do_stage) :: stage
    integer, intent(out) :: status

    job%stage => stage
    call run_in_parts(size(job%status), job)
    status = FUGE_DONE
    if (any(job%status /= FUGE_DONE)) status = FUGE_ERR_MEMORY
  end subroutine run

  subroutine do_part(self, part, parts)
    class(sliced_product), intent(inout) :: self
    integer, intent(in) :: part, parts

    call self%stage(self, part, parts, self%status(part))
  end subroutine do_part

  !> cos and sin of the angle of cell j of `slice`, (2, 0:M-1), and of cell M r, (2, 0:S-1).
  pure subroutine compute_twists(job, slice, near, far)
    type(sliced_product), intent(in) :: job
    integer, intent(in) :: slice
    real(dp), intent(out) :: near(2, 0:job%waves - 1), far(2, 0:job%slices - 1)
    real(dp) :: angle
    integer :: j

    do j = 0, job%waves - 1
      angle = PI*(real(2*slice + 1, dp)*real(j, dp)/(2.0_dp*real(job%slices, dp)*real(job%waves, dp)))
      near(:, j) = [cos(angle), sin(angle)]
    end do
    do j = 0, job%slices - 1
      angle = PI*(real(modulo((2*slice + 1)*j, 4*job%slices), dp)/(2.0_dp*real(job%slices, dp)))
      far(:, j) = [cos(angle), sin(angle)]
    end do
  end subroutine compute_twists

  !> The `values` (nx) times the conjugate twists, folded to M complex numbers, `line`.
  pure subroutine fold(near, far, values, line)
    real(dp), intent(in), contiguous :: near(:, :), far(:, :), values(:)
    real(dp), intent(inout), contiguous :: line(:)
    real(dp) :: real_part
    integer :: begin, j, m, r

    m = size(near, 2)
    line(:2*m) = 0.0_dp
    do r = 1, size(far, 2)
      begin = m*(r - 1)
      do j = 1, min(m, size(values) - begin)
        line(2*j - 1) = line(2*j - 1) + far(1, r)*values(begin + j)
        line(2*j) = line(2*j) - far(2, r)*values(begin + j)
      end do
    end do
    do j = 1, m
      real_part = line(2*j - 1)
      line(2*j - 1) = near(1, j)*real_part + near(2, j)*line(2*j)
      line(2*j) = near(1, j)*line(2*j) - near(2, j)*real_part
    end do
  end subroutine fold

  !> Add to the `values` (nx) the real parts of the M complex numbers `line`, which have real and imaginary parts
  !> exchanged, times the twists.
  pure subroutine unfold(near, far, line, values)
    real(dp), intent(in), contiguous :: near(:, :), far(:, :)
    real(dp), intent(inout), contiguous :: line(:), values(:)
    real(dp) :: real_part
    integer :: begin, j, m, r

    m = size(near, 2)
    do j = 1, m
      real_part = near(1, j)*line(2*j) - near(2, j)*line(2*j - 1)
      line(2*j) = near(1, j)*line(2*j - 1) + near(2, j)*line(2*j)
      line(2*j - 1) = real_part
    end do
    do r = 1, size(far, 2)
      begin = m*(r - 1)
      do j = 1, min(m, size(values) - begin)
        values(begin + j) = values(begin + j) + (far(1, r)*line(2*j - 1) - far(2, r)*line(2*j))
      end do
    end do
  end subroutine unfold

  !> The kernels of the slices first .. last, transformed along x, with the factor of all transforms.
  subroutine transform_kernel(job, part, parts, status)
    type(sliced_product), intent(inout) :: job
    integer, intent(in) :: part, parts
    integer, intent(out) :: status
    real(dp), allocatable :: far(:, :, :), near(:, :, :), table(:, :)
    real(dp), pointer, contiguous :: lines(:, :)
    type(c_ptr) :: buffer
    real(dp) :: factor
    integer :: begin, block, ends, from, j, m, s, stat, to

    status = FUGE_ERR_MEMORY
    allocate (table(job%cells(1), ROWS), near(2, job%waves, job%first:job%last), &
              far(2, job%slices, job%first:job%last), stat=stat)
    if (stat /= 0) return
    call allocate_values(line_stride(job%waves), ROWS + 1, buffer, lines, status)
    if (status /= FUGE_DONE) return
    do s = job%first, job%last
      call compute_twists(job, s, near(:, :, s), far(:, :, s))
    end do
    ! Twice the real parts count, of the kernel and of the product.
    factor = 4.0_dp/(2.0_dp*real(job%slices, dp)*real(job%waves, dp)*2.0_dp*real(job%plan%length(2), dp))
    call share((job%cells(2) - 1)/ROWS + 1, part, parts, from, to)
    do block = from, to
      begin = ROWS*block
      ends = min(begin + ROWS, job%cells(2)) - 1
      call job%kernel%fill(begin, job%cells(2), table(:, :ends - begin + 1), stat)
      if (stat /= 0) status = FUGE_ERR_MEMORY
      if (stat /= 0) exit
      table(1, :) = 0.5_dp*table(1, :)
      do s = job%first, job%last
        do j = 1, ends - begin + 1
          call fold(near(:, :, s), far(:, :, s), table(:, j), lines(:, ROWS + 1))
          call job%line%transform_to(c_loc(lines(1, ROWS + 1)), c_loc(lines(1, j)))
        end do
        do m = 1, job%waves
          do j = 1, ends - begin + 1
            job%spectra(begin + j, m, s - job%first + 1) = factor*lines(2*m - 1, j)
          end do
        end do
      end do
    end do
    call release_buffer(buffer)
  end subroutine transform_kernel

  !> The kernels of these slices, transformed along y: distances of more rows than there are do not count.
  subroutine transform_kernel_columns(job, part, parts, status)
    type(sliced_product), intent(inout) :: job
    integer, intent(in) :: part, parts
    integer, intent(out) :: status
    integer :: from, s, to

    status = FUGE_DONE
    ! Two columns are transformed together, the same ones by any number of threads.
    call share(job%waves/2, part, parts, from, to)
    if (to < from) return
    do s = 1, job%last - job%first + 1
      job%spectra(job%cells(2) + 1:, 2*from + 1:2*to + 2, s) = 0.0_dp
      call job%plan%transform_even(2, .true., job%spectra(:, 2*from + 1:2*to + 2, s), status)
      if (status /= FUGE_DONE) return
    end do
  end subroutine transform_kernel_columns

  !> Transform the rows of x that are not zero.
  subroutine fold_rows(job, part, parts, status)
    type(sliced_product), intent(inout) :: job
    integer, intent(in) :: part, parts
    integer, intent(out) :: status
    real(dp), pointer, contiguous :: line(:, :)
    real(dp) :: near(2, job%waves), far(2, job%slices)
    type(c_ptr) :: buffer
    integer :: from, j, to

    call allocate_values(line_stride(job%waves), 1, buffer, line, status)
    if (status /= FUGE_DONE) return
    call compute_twists(job, job%slice, near, far)
    call share(job%cells(2), part, parts, from, to)
    do j = from + 1, to + 1
      if (job%zero(j)) cycle
      call fold(near, far, job%x(:, j), line(:, 1))
      call job%line%transform_to(c_loc(line), c_loc(job%work(1, j)))
    end do
    call release_buffer(buffer)
  end subroutine fold_rows

  !> Convolve the columns of the slice; the results have real and imaginary parts exchanged.
  subroutine multiply_columns(job, part, parts, status)
    type(sliced_product), intent(inout) :: job
    integer, intent(in) :: part, parts
    integer, intent(out) :: status
    real(dp), pointer, contiguous :: lines(:, :)
    type(c_ptr) :: buffer
    integer :: block, c, first, from, j, last, to

    call allocate_values(line_stride(job%plan%length(2)), COLUMNS + 2, buffer, lines, status)
    if (status /= FUGE_DONE) return
    call share((job%waves - 1)/COLUMNS + 1, part, parts, from, to)
    do block = from, to
      first = COLUMNS*block + 1
      last = min(first + COLUMNS - 1, job%waves)
      do j = 1, job%cells(2)
        do c = 1, last - first + 1
          if (job%zero(j)) then
            lines(2*j - 1:2*j, c) = 0.0_dp
          else
            lines(2*j - 1:2*j, c) = job%work(2*(first + c) - 3:2*(first + c) - 2, j)
          end if
        end do
      end do
      lines(2*job%cells(2) + 1:2*job%plan%length(2), :COLUMNS) = 0.0_dp
      do c = 1, last - first + 1
        call convolve_line(job%plan%columns, job%plan%column_twist, job%cells(2), .true., &
                           job%spectra(:, first + c - 1, job%slice - job%first + 1), lines(:, c), &
                           lines(:, COLUMNS + 1), lines(:, COLUMNS + 2))
      end do
      do j = 1, job%cells(2)
        do c = 1, last - first + 1
          job%work(2*(first + c) - 3:2*(first + c) - 2, j) = lines(2*j - 1:2*j, c)
        end do
      end do
    end do
    call release_buffer(buffer)
  end subroutine multiply_columns

  !> Add the rows of the slice, transformed back, to those of y.
  subroutine unfold_rows(job, part, parts, status)
    type(sliced_product), intent(inout) :: job
    integer, intent(in) :: part, parts
    integer, intent(out) :: status
    real(dp), pointer, contiguous :: line(:, :)
    real(dp) :: near(2, job%waves), far(2, job%slices)
    type(c_ptr) :: buffer
    integer :: from, j, to

    call allocate_values(line_stride(job%waves), 1, buffer, line, status)
    if (status /= FUGE_DONE) return
    call compute_twists(job, job%slice, near, far)
    call share(job%cells(2), part, parts, from, to)
    do j = from + 1, to + 1
      if (job%slice == 0) job%y(:, j) = 0.0_dp
      call job%line%transform_to(c_loc(job%work(1, j)), c_loc(line))
      call unfold(near, far, line(:, 1), job%y(:, j))
    end do
    call release_buffer(buffer)
  end subroutine unfold_rows

end module fuge_sliced_convolution
