!> Products with a circulant matrix of a circle of cells that ranks share, by Fourier transforms in four steps
!> (D. H. Bailey, FFTs in external or hierarchical memory, 1990).
!>
!> The N = n m cells of the circle are n rows of m, of which each rank has some. The ranks exchange them for columns and
!> transform these; multiply the number k of column j by exp(-2 pi i j k/N); exchange columns for waves, the numbers k
!> of all columns; and transform these lines, which gives the wave k + n l as the number l of line k. On the way back
!> real and imaginary parts are exchanged: then the same transforms and the same factors serve.
!>
!> `twisted`: what has gone once round the circle does not count, as on a circle of twice the length that holds N
!> zeros. The cells are multiplied by exp(-i pi j/(2 N)) and the results by the conjugate: once round is a factor -i,
!> and only the real part is kept.
module fuge_line_transform
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_loc, c_null_ptr, c_ptr
  use fuge_complex_lines, only: gather_lines, multiply_exchanging, multiply_line, scale_line, scatter_lines
  use fuge_fft, only: allocate_values, fft_plan, release_buffer
  use fuge_kinds, only: dp
  use fuge_line_cells, only: block_begins, rows_of_circle, rows_of_ranks
  use fuge_rank_communicator, only: rank_communicator
  use fuge_status, only: fuge_info, require_memory
  use fuge_unit_roots, only: quarter_root, root_of_one
  implicit none
  private

  !> Lines that are copied together: neighbours in memory of several columns, or waves.
  integer, parameter :: LINES = 8

  !> Transforms of one circle. It must not be copied.
  type, public :: line_transform
    !> n, m.
    integer :: rows = 0, columns = 0
    !> Columns and lines of waves of this rank, and the first ones, from 0.
    integer :: own_columns = 0, first_column = 0, own_waves = 0, first_wave = 0
    !> The ranks that have cells.
    type(rank_communicator), private :: group
    !> First row, column and wave of each rank, from 0, (0:ranks).
    integer, allocatable, private :: row(:), column(:), wave(:)
    type(fft_plan), private :: along_column, along_wave
    !> Real and imaginary parts of exp(-2 pi i j k/N), (2, n, own columns).
    real(dp), allocatable, private :: factors(:, :, :)
    !> Those of exp(-i pi j/(2 N)), as the product of a factor of each row and one of each column, (2, :).
    real(dp), allocatable, private :: row_twist(:, :), column_twist(:, :)
    !> In turn rows, columns and waves of this rank.
    real(c_double), pointer, contiguous, private :: one(:) => null(), other(:) => null()
    !> `LINES` lines before a transform, and as many after it.
    real(c_double), pointer, contiguous, private :: lines(:, :) => null()
    type(c_ptr), private :: memory(3) = c_null_ptr
  contains
    procedure :: set
    procedure :: columns_from_cells
    procedure :: set_columns
    procedure :: get_column
    procedure :: waves_from_columns
    procedure :: transform_waves
    procedure :: multiply_waves
    procedure :: columns_from_waves
    procedure :: cells_from_columns
    procedure :: free
  end type line_transform

contains

  !> Plan for a circle of `length` cells that ranks share as fuge_line_cells says, the first of which make up `group`.
  !> Errors, on any rank: FUGE_ERR_MEMORY.
  subroutine set(self, group, cells, length, ranks, measured, info)
    class(line_transform), intent(inout) :: self
    type(rank_communicator), intent(in) :: group
    integer, intent(in) :: cells, length, ranks
    logical, intent(in) :: measured
    type(fuge_info), intent(inout) :: info
    integer :: first(0:ranks), me, p, stat

    p = group%members()
    me = group%number()
    self%group = group
    self%rows = rows_of_circle(length)
    self%columns = length/self%rows
    first = rows_of_ranks(cells, length, ranks)
    allocate (self%row(0:p), self%column(0:p), self%wave(0:p), stat=stat)
    if (stat == 0) then
      self%row = first(0:p)
      self%column = block_begins(self%columns, (self%columns - 1)/p + 1, p)
      self%wave = block_begins(self%rows, (self%rows - 1)/p + 1, p)
      self%first_column = self%column(me)
      self%own_columns = self%column(me + 1) - self%column(me)
      self%first_wave = self%wave(me)
      self%own_waves = self%wave(me + 1) - self%wave(me)
      allocate (self%factors(2, 0:self%rows - 1, self%own_columns), self%row_twist(2, 0:self%rows - 1), &
                self%column_twist(2, self%own_columns), stat=stat)
    end if
    if (stat == 0) call allocate_buffers(self, stat)
    call require_memory(stat, 'transforms of', length, 'cells', info)
    if (stat /= 0) return
    call self%along_column%set(2*self%rows, info, measured=measured, separate=.true.)
    if (.not. info%failed()) call self%along_wave%set(2*self%columns, info, measured=measured, separate=.true.)
    call compute_factors(self)
  end subroutine set

  !> Allocate the buffers; `stat` is not 0 without memory.
  subroutine allocate_buffers(self, stat)
    class(line_transform), intent(inout) :: self
    integer, intent(out) :: stat
    integer :: own_rows

    own_rows = self%row(self%group%number() + 1) - self%row(self%group%number())
    call allocate_table(max(2*self%own_columns, 1), self%rows, max(own_rows, 1), self%columns, self%memory(1), &
                        self%one, stat)
    if (stat == 0) call allocate_table(max(2*self%own_waves, 1), self%columns, max(self%own_columns, 1), self%rows, &
                                       self%memory(2), self%other, stat)
    if (stat == 0) call allocate_values(2*max(self%rows, self%columns), 2*LINES, self%memory(3), self%lines, stat)
  end subroutine allocate_buffers

  !> Room for a table of `n` by `m` values and, at another time, one of `p` by `q`.
  subroutine allocate_table(n, m, p, q, memory, values, stat)
    integer, intent(in) :: n, m, p, q
    type(c_ptr), intent(out) :: memory
    real(c_double), pointer, contiguous, intent(out) :: values(:)
    integer, intent(out) :: stat
    real(c_double), pointer, contiguous :: table(:, :)
    real(dp) :: numbers

    nullify (values)
    stat = 1
    numbers = max(real(n, dp)*real(m, dp), real(p, dp)*real(q, dp))
    ! MPI counts them by default integers.
    if (numbers > real(huge(n), dp)) return
    call allocate_values(int(numbers), 1, memory, table, stat)
    if (stat == 0) call c_f_pointer(memory, values, [int(numbers)])
  end subroutine allocate_table

  !> The factors between the transforms, and those of a twisted product.
  pure subroutine compute_factors(self)
    class(line_transform), intent(inout) :: self
    integer :: j, k, length

    length = self%rows*self%columns
    do j = 1, self%own_columns
      do k = 0, self%rows - 1
        self%factors(:, k, j) = root_of_one(k*(self%first_column + j - 1), length)
      end do
      self%column_twist(:, j) = quarter_root(self%first_column + j - 1, length)
    end do
    do k = 0, self%rows - 1
      self%row_twist(:, k) = quarter_root(k, self%rows)
    end do
  end subroutine compute_factors

  !> The columns of this rank from the cells `x` of all ranks, each its own; cells that no rank has are zero. All ranks
  !> of the group call it, and the procedures below that exchange anything.
  subroutine columns_from_cells(self, x)
    class(line_transform), intent(in) :: self
    real(dp), intent(in) :: x(:)
    real(c_double), pointer, contiguous :: one(:), other(:)
    integer :: begin, done, j, m, n, own_rows, p, r

    one => self%one
    other => self%other
    p = self%group%members()
    own_rows = self%row(self%group%number() + 1) - self%row(self%group%number())
    done = 0
    do r = 0, p - 1
      m = self%column(r + 1) - self%column(r)
      do j = 0, own_rows - 1
        begin = j*self%columns + self%column(r)
        n = max(min(m, size(x) - begin), 0)
        one(done + 1:done + n) = x(begin + 1:begin + n)
        one(done + n + 1:done + m) = 0.0_dp
        done = done + m
      end do
    end do
    call self%group%exchange(own_rows*extents(self%column), one, self%own_columns*extents(self%row), other)
    other(self%own_columns*self%row(p) + 1:self%own_columns*self%rows) = 0.0_dp
  end subroutine columns_from_cells

  !> The number of things of each rank, of which `first` (0:ranks) are the first ones.
  pure function extents(first)
    integer, intent(in) :: first(:)
    integer :: extents(size(first) - 1)

    extents = first(2:) - first(:size(first) - 1)
  end function extents

  !> Set the column `j` of this rank, from 1, to `values` (n).
  subroutine set_columns(self, j, values)
    class(line_transform), intent(in) :: self
    integer, intent(in) :: j
    real(dp), intent(in) :: values(:)
    real(c_double), pointer, contiguous :: other(:)

    other => self%other
    other(j:j + self%own_columns*(self%rows - 1):self%own_columns) = values
  end subroutine set_columns

  !> The column `j` of this rank, from 1, (n).
  subroutine get_column(self, j, values)
    class(line_transform), intent(in) :: self
    integer, intent(in) :: j
    real(dp), intent(out) :: values(:)

    values = self%other(j:j + self%own_columns*(self%rows - 1):self%own_columns)
  end subroutine get_column

  !> Transform the columns and exchange them for waves.
  subroutine waves_from_columns(self, twisted)
    class(line_transform), intent(in) :: self
    logical, intent(in) :: twisted
    real(c_double), pointer, contiguous :: one(:), other(:), line(:, :)
    integer :: count, first, j, k

    one => self%one
    other => self%other
    line => self%lines
    do first = 1, self%own_columns, LINES
      count = min(LINES, self%own_columns - first + 1)
      do k = 0, self%rows - 1
        do j = 1, count
          line(2*k + 1, j) = other(k*self%own_columns + first + j - 1)
          line(2*k + 2, j) = 0.0_dp
        end do
      end do
      do j = 1, count
        if (twisted) call multiply_line(self%row_twist, line(:2*self%rows, j))
        call self%along_column%transform_to(c_loc(line(1, j)), c_loc(line(1, LINES + j)))
        call multiply_line(self%factors(:, :, first + j - 1), line(:2*self%rows, LINES + j))
        if (twisted) call scale_line(self%column_twist(:, first + j - 1), line(:2*self%rows, LINES + j))
        call to_waves(self, first + j - 1, line(:2*self%rows, LINES + j), one)
      end do
    end do
    call self%group%exchange(2*self%own_columns*extents(self%wave), one, 2*self%own_waves*extents(self%column), other)
  end subroutine waves_from_columns

  !> Put the transform of column `j` of this rank where the exchange takes it from.
  pure subroutine to_waves(self, j, z, sent)
    class(line_transform), intent(in) :: self
    integer, intent(in) :: j
    real(c_double), intent(in), contiguous :: z(:)
    real(c_double), intent(inout), contiguous :: sent(:)
    integer :: begin, r

    do r = 0, ubound(self%wave, 1) - 1
      begin = place_of_column(self, j, r)
      sent(begin + 1:begin + 2*(self%wave(r + 1) - self%wave(r))) = z(2*self%wave(r) + 1:2*self%wave(r + 1))
    end do
  end subroutine to_waves

  !> Behind which number of a buffer the waves of rank `r` of column `j` begin.
  pure function place_of_column(self, j, r) result(begin)
    class(line_transform), intent(in) :: self
    integer, intent(in) :: j, r
    integer :: begin

    begin = 2*(self%own_columns*self%wave(r) + (j - 1)*(self%wave(r + 1) - self%wave(r)))
  end function place_of_column

  !> `real_parts` (m, own waves): those of the transforms of the waves' lines.
  subroutine transform_waves(self, real_parts)
    class(line_transform), intent(in) :: self
    real(dp), intent(inout), contiguous :: real_parts(:, :)
    real(c_double), pointer, contiguous :: other(:), line(:, :)
    integer :: count, first, j

    other => self%other
    line => self%lines
    do first = 1, self%own_waves, LINES
      count = min(LINES, self%own_waves - first + 1)
      call gather_lines(self%own_waves, self%columns, first, count, other, line)
      do j = 1, count
        call self%along_wave%transform_to(c_loc(line(1, j)), c_loc(line(1, LINES + j)))
        real_parts(:, first + j - 1) = line(1:2*self%columns - 1:2, LINES + j)
      end do
    end do
  end subroutine transform_waves

  !> Transform the waves' lines, multiply by the `spectrum` s (m, own waves), or by s/(1 + softening s), and transform
  !> back, real and imaginary parts exchanged.
  subroutine multiply_waves(self, spectrum, softening)
    class(line_transform), intent(in) :: self
    real(dp), intent(in), contiguous :: spectrum(:, :)
    real(dp), intent(in) :: softening
    real(c_double), pointer, contiguous :: other(:), line(:, :)
    integer :: count, first, j

    other => self%other
    line => self%lines
    do first = 1, self%own_waves, LINES
      count = min(LINES, self%own_waves - first + 1)
      call gather_lines(self%own_waves, self%columns, first, count, other, line)
      do j = 1, count
        call self%along_wave%transform_to(c_loc(line(1, j)), c_loc(line(1, LINES + j)))
        if (softening > 0.0_dp) then
          call multiply_exchanging(spectrum(:, first + j - 1)/(1.0_dp + softening*spectrum(:, first + j - 1)), &
                                   line(:2*self%columns, LINES + j))
        else
          call multiply_exchanging(spectrum(:, first + j - 1), line(:2*self%columns, LINES + j))
        end if
        call self%along_wave%transform_to(c_loc(line(1, LINES + j)), c_loc(line(1, j)))
      end do
      call scatter_lines(self%own_waves, self%columns, first, count, line, other)
    end do
  end subroutine multiply_waves

  !> Exchange the waves for columns and transform these; their real parts stay.
  subroutine columns_from_waves(self, twisted)
    class(line_transform), intent(in) :: self
    logical, intent(in) :: twisted
    real(c_double), pointer, contiguous :: one(:), other(:), line(:, :)
    integer :: count, first, j, k

    one => self%one
    other => self%other
    line => self%lines
    call self%group%exchange(2*self%own_waves*extents(self%column), other, 2*self%own_columns*extents(self%wave), one)
    do first = 1, self%own_columns, LINES
      count = min(LINES, self%own_columns - first + 1)
      do j = 1, count
        call from_waves(self, first + j - 1, one, line(:2*self%rows, j))
        call multiply_line(self%factors(:, :, first + j - 1), line(:2*self%rows, j))
        if (twisted) call scale_line(self%column_twist(:, first + j - 1), line(:2*self%rows, j))
        call self%along_column%transform_to(c_loc(line(1, j)), c_loc(line(1, LINES + j)))
        if (twisted) call multiply_line(self%row_twist, line(:2*self%rows, LINES + j))
      end do
      do k = 0, self%rows - 1
        do j = 1, count
          other(k*self%own_columns + first + j - 1) = line(2*k + 2, LINES + j)
        end do
      end do
    end do
  end subroutine columns_from_waves

  !> The column `j` of this rank from what the exchange has brought, the reverse of `to_waves`.
  pure subroutine from_waves(self, j, received, z)
    class(line_transform), intent(in) :: self
    integer, intent(in) :: j
    real(c_double), intent(in), contiguous :: received(:)
    real(c_double), intent(inout), contiguous :: z(:)
    integer :: begin, r

    do r = 0, ubound(self%wave, 1) - 1
      begin = place_of_column(self, j, r)
      z(2*self%wave(r) + 1:2*self%wave(r + 1)) = received(begin + 1:begin + 2*(self%wave(r + 1) - self%wave(r)))
    end do
  end subroutine from_waves

  !> The cells `y` of this rank from the columns of all ranks.
  subroutine cells_from_columns(self, y)
    class(line_transform), intent(in) :: self
    real(dp), intent(inout) :: y(:)
    real(c_double), pointer, contiguous :: one(:), other(:)
    integer :: begin, done, j, m, n, own_rows, r

    one => self%one
    other => self%other
    own_rows = self%row(self%group%number() + 1) - self%row(self%group%number())
    call self%group%exchange(self%own_columns*extents(self%row), other, own_rows*extents(self%column), one)
    done = 0
    do r = 0, ubound(self%column, 1) - 1
      m = self%column(r + 1) - self%column(r)
      do j = 0, own_rows - 1
        begin = j*self%columns + self%column(r)
        n = max(min(m, size(y) - begin), 0)
        y(begin + 1:begin + n) = one(done + 1:done + n)
        done = done + m
      end do
    end do
  end subroutine cells_from_columns

  !> Free the buffers.
  subroutine free(self)
    class(line_transform), intent(inout) :: self
    integer :: k

    do k = 1, size(self%memory)
      if (c_associated(self%memory(k))) call release_buffer(self%memory(k))
      self%memory(k) = c_null_ptr
    end do
    nullify (self%one, self%other, self%lines)
  end subroutine free

end module fuge_line_transform
