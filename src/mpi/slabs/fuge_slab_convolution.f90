!> Products with convolution matrices of grids whose rows ranks share.
!>
!> As in fuge_grid_convolution, a pair of rows is transformed as one line of complex numbers, and zeros of a circle that
!> is twice as long are never transformed; a few columns at a time are copied to lines and transformed there. Between
!> the two an exchange (fuge_slab_exchange) carries all waves of a pair to the ranks that have them; an element is one
!> wave of a pair of rows, two complex numbers. Each line is computed as by one process, so that products do not depend
!> on the number of ranks.
module fuge_slab_convolution
  use, intrinsic :: iso_c_binding, only: c_double, c_loc
  use fuge_grid_convolution, only: add_untwisted, convolve_line, opposite, twist_line
  use fuge_grid_plan, only: stored_waves
  use fuge_kinds, only: dp
  use fuge_slab_exchange, only: slab_exchange
  use fuge_slab_plan, only: slab_plan, COLUMNS, NUMBERS
  implicit none
  private

  !> The spectrum of an even kernel, of the waves along x that this rank has. It must not be copied.
  type, public :: slab_kernel
    !> Is the circle twice as long as that of the plan?
    logical :: padded(2) = .false.
    !> Waves along x of all ranks, the first one of this rank from 0, and how many it has.
    integer :: all_waves = 0, first = 0, waves = 0
    !> (0:my, 0:waves - 1): as that of a `grid_kernel`, which includes the factor of the transforms.
    real(dp), allocatable :: spectrum(:, :)
    type(slab_exchange), private :: exchange
  contains
    procedure :: locate
    procedure :: set
    procedure :: convolve
    procedure :: free
  end type slab_kernel

contains

  !> Find the waves of this rank, on circles that are `padded` (2) or not.
  subroutine locate(self, plan, padded)
    class(slab_kernel), intent(inout) :: self
    type(slab_plan), intent(in) :: plan
    logical, intent(in) :: padded(2)
    integer :: range(2)

    call plan%describe_exchange(padded(1), self%exchange)
    range = self%exchange%column_range(plan%group%number())
    self%padded = padded
    self%all_waves = stored_waves(plan%plan%length(1), padded(1))
    self%first = range(1)
    self%waves = range(2)
  end subroutine locate

  !> Take the `spectrum` (0:my, 0:waves - 1) of this rank's waves; after `locate`. `status` is not 0 without memory.
  subroutine set(self, plan, spectrum, status)
    class(slab_kernel), intent(inout) :: self
    type(slab_plan), intent(in) :: plan
    real(dp), allocatable, intent(inout) :: spectrum(:, :)
    integer, intent(out) :: status
    integer :: k

    call move_alloc(spectrum, self%spectrum)
    do k = lbound(self%spectrum, 2), ubound(self%spectrum, 2)
      self%spectrum(:, k) = self%spectrum(:, k)/circle_factor(plan, self%padded)
    end do
    call self%exchange%set(status)
  end subroutine set

  !> What the transforms multiply by, twice, because half of each pair of rows is wanted.
  pure function circle_factor(plan, padded) result(factor)
    type(slab_plan), intent(in) :: plan
    logical, intent(in) :: padded(2)
    real(dp) :: factor

    factor = 2.0_dp*product(real(plan%plan%length, dp)*merge(2.0_dp, 1.0_dp, padded))
  end function circle_factor

  !> y = the convolution of x with the kernel; both (nx*rows), the rows of this rank. With `softening` >= 0 each number
  !> s of the spectrum becomes s/(1 + softening s), as for a `grid_kernel`. All ranks of the group call it.
  subroutine convolve(self, plan, x, y, softening)
    class(slab_kernel), intent(inout) :: self
    type(slab_plan), intent(in) :: plan
    real(dp), intent(in) :: x(:)
    real(dp), intent(inout) :: y(:)
    real(dp), intent(in), optional :: softening
    real(dp) :: scaled
    integer :: first, p

    scaled = 0.0_dp
    if (present(softening)) scaled = softening*circle_factor(plan, self%padded)

    call self%exchange%begin_rows(plan%by_columns)
    do p = 1, plan%pairs
      call transform_pair(self, plan, p, x, plan%lines)
      call self%exchange%send_row(p - 1, plan%by_rows)
    end do
    call self%exchange%finish()
    do first = 0, self%waves - 1, COLUMNS
      call convolve_waves(self, plan, first, min(first + COLUMNS, self%waves) - 1, scaled, plan%lines)
    end do
    call self%exchange%return_rows(plan%by_rows, plan%by_columns)
    do p = 1, plan%pairs
      call self%exchange%wait_for_row(p - 1)
      call transform_back(self, plan, p, plan%lines, y)
    end do
    call self%exchange%finish()
  end subroutine convolve

  !> The transforms of the rows 2 p - 1 and 2 p of x, twice, to where their waves belong.
  subroutine transform_pair(kernel, plan, p, x, lines)
    type(slab_kernel), intent(in) :: kernel
    type(slab_plan), intent(in) :: plan
    integer, intent(in) :: p
    real(dp), intent(in) :: x(:)
    real(c_double), intent(inout), contiguous, target :: lines(:, :)
    logical :: zero

    call pack_rows(plan%plan%cells(1), plan%plan%length(1), 2*p <= plan%owned_rows, p, x, lines(:, 1), zero)
    if (zero) then
      call clear_pair(kernel, plan, p)
      return
    end if
    call plan%plan%rows%transform_to(c_loc(lines(1, 1)), c_loc(lines(1, 2)))
    call separate_pair(kernel, plan, p, 0, lines(:, 2))
    if (.not. kernel%padded(1)) return
    call twist_line(plan%plan%row_twist, plan%plan%cells(1), lines(:, 1), lines(:, 2))
    call plan%plan%rows%transform_to(c_loc(lines(1, 2)), c_loc(lines(1, 1)))
    call separate_pair(kernel, plan, p, 1, lines(:, 1))
  end subroutine transform_pair

  !> Row 2 p - 1 and row 2 p of x, if it is there, as real and imaginary parts, unless both are zero.
  pure subroutine pack_rows(nx, length, two, p, x, line, zero)
    integer, intent(in) :: nx, length, p
    logical, intent(in) :: two
    real(dp), intent(in) :: x(:)
    real(c_double), intent(inout), contiguous :: line(:)
    logical, intent(out) :: zero
    integer :: first, j

    first = 2*(p - 1)*nx
    zero = all(abs(x(first + 1:first + merge(2, 1, two)*nx)) <= 0.0_dp)
    if (zero) return
    do j = 1, nx
      line(2*j - 1) = x(first + j)
      line(2*j) = 0.0_dp
    end do
    if (two) then
      do j = 1, nx
        line(2*j) = x(first + nx + j)
      end do
    end if
    line(2*nx + 1:2*length) = 0.0_dp
  end subroutine pack_rows

  !> A pair of rows of zeros.
  subroutine clear_pair(kernel, plan, p)
    type(slab_kernel), intent(in) :: kernel
    type(slab_plan), intent(in) :: plan
    integer, intent(in) :: p
    real(c_double), pointer, contiguous :: piece(:)
    integer :: rank

    do rank = 0, plan%group%members() - 1
      call kernel%exchange%find_piece(p - 1, rank, plan%by_rows, plan%by_columns, piece)
      piece = 0.0_dp
    end do
  end subroutine clear_pair

  !> The waves of a circle from the transform `line` of pair `p`, to the pieces of all ranks.
  subroutine separate_pair(kernel, plan, p, circle, line)
    type(slab_kernel), intent(in) :: kernel
    type(slab_plan), intent(in) :: plan
    integer, intent(in) :: p, circle
    real(c_double), intent(in), contiguous :: line(:)
    real(c_double), pointer, contiguous :: piece(:)
    integer :: begin, first, last, rank

    do rank = 0, plan%group%members() - 1
      call find_waves(kernel, plan%plan%length(1), circle, rank, first, last, begin)
      if (last < first) cycle
      call kernel%exchange%find_piece(p - 1, rank, plan%by_rows, plan%by_columns, piece)
      call separate(plan%plan%length(1), circle, first, last, line, piece(NUMBERS*begin + 1:))
    end do
  end subroutine separate_pair

  !> The waves `first` .. `last` of a circle of `n` cells that a rank has; `begin` of its waves are those of the circle
  !> before it.
  pure subroutine find_waves(kernel, n, circle, rank, first, last, begin)
    type(slab_kernel), intent(in) :: kernel
    integer, intent(in) :: n, circle, rank
    integer, intent(out) :: first, last, begin
    integer :: before, range(2)

    range = kernel%exchange%column_range(rank)
    before = merge(0, n/2 + 1, circle == 0)
    first = max(range(1) - before, 0)
    ! Waves above are the opposites of those below.
    last = min(range(1) + range(2) - 1 - before, merge(n/2, (n - 1)/2, circle == 0))
    begin = first + before - range(1)
  end subroutine find_waves

  !> Twice the transforms of both rows of a pair from that of the pair: of the waves `first` .. `last` of a circle.
  pure subroutine separate(n, circle, first, last, line, waves)
    integer, intent(in) :: n, circle, first, last
    real(c_double), intent(in), contiguous :: line(:)
    real(c_double), intent(inout), contiguous :: waves(:)
    integer :: i, k, o

    do k = first, last
      i = NUMBERS*(k - first)
      o = 2*opposite(n, circle, k)
      waves(i + 1) = line(2*k + 1) + line(o + 1)
      waves(i + 2) = line(2*k + 2) - line(o + 2)
      waves(i + 3) = line(2*k + 2) + line(o + 2)
      waves(i + 4) = line(o + 1) - line(2*k + 1)
    end do
  end subroutine separate

  !> Convolve the columns of the waves `first` .. `last` of this rank, from 0; the results have real and imaginary parts
  !> exchanged. `softening` is that of the spectrum as it is stored.
  subroutine convolve_waves(kernel, plan, first, last, softening, lines)
    type(slab_kernel), intent(in) :: kernel
    type(slab_plan), intent(in) :: plan
    integer, intent(in) :: first, last
    real(dp), intent(in) :: softening
    real(c_double), intent(inout), contiguous, target :: lines(:, :)
    real(c_double), pointer, contiguous :: table(:, :)
    integer :: k, rows, width

    rows = plan%plan%cells(2)
    width = last - first + 1
    table(1:NUMBERS*kernel%waves, 1:plan%all_pairs) => plan%by_columns
    call gather(NUMBERS*first, width, table, lines)
    lines(2*rows + 1:2*plan%plan%length(2), :width) = 0.0_dp
    do k = 1, width
      call convolve_wave(kernel, plan, first + k - 1, softening, lines(:, k), lines(:, COLUMNS + 1), &
                         lines(:, COLUMNS + 2))
    end do
    ! The second row of a last pair without one.
    lines(2*rows + 1:NUMBERS*plan%all_pairs, :width) = 0.0_dp
    call scatter(NUMBERS*first, width, lines, table)
  end subroutine convolve_waves

  !> Convolve the column `f` of wave `k` of this rank; `t` and `u` for work.
  subroutine convolve_wave(kernel, plan, k, softening, f, t, u)
    type(slab_kernel), intent(in) :: kernel
    type(slab_plan), intent(in) :: plan
    integer, intent(in) :: k
    real(dp), intent(in) :: softening
    real(c_double), intent(inout), contiguous, target :: f(:), t(:), u(:)

    if (softening > 0.0_dp) then
      call convolve_line(plan%plan%columns, plan%plan%column_twist, plan%plan%cells(2), kernel%padded(2), &
                         kernel%spectrum(:, k)/(1.0_dp + softening*kernel%spectrum(:, k)), f, t, u)
    else
      call convolve_line(plan%plan%columns, plan%plan%column_twist, plan%plan%cells(2), kernel%padded(2), &
                         kernel%spectrum(:, k), f, t, u)
    end if
  end subroutine convolve_wave

  !> The first `width` lines: the columns of as many waves, behind `begin` numbers in each row of `table`.
  pure subroutine gather(begin, width, table, lines)
    integer, intent(in) :: begin, width
    real(c_double), intent(in), contiguous :: table(:, :)
    real(c_double), intent(inout), contiguous :: lines(:, :)
    integer :: k, p

    do p = 1, size(table, 2)
      do k = 1, width
        lines(NUMBERS*p - 3:NUMBERS*p, k) = table(begin + NUMBERS*k - 3:begin + NUMBERS*k, p)
      end do
    end do
  end subroutine gather

  !> The reverse of `gather`.
  pure subroutine scatter(begin, width, lines, table)
    integer, intent(in) :: begin, width
    real(c_double), intent(in), contiguous :: lines(:, :)
    real(c_double), intent(inout), contiguous :: table(:, :)
    integer :: k, p

    do p = 1, size(table, 2)
      do k = 1, width
        table(begin + NUMBERS*k - 3:begin + NUMBERS*k, p) = lines(NUMBERS*p - 3:NUMBERS*p, k)
      end do
    end do
  end subroutine scatter

  !> The rows 2 p - 1 and 2 p of y from their waves, real and imaginary parts exchanged.
  subroutine transform_back(kernel, plan, p, lines, y)
    type(slab_kernel), intent(in) :: kernel
    type(slab_plan), intent(in) :: plan
    integer, intent(in) :: p
    real(c_double), intent(inout), contiguous, target :: lines(:, :)
    real(dp), intent(inout) :: y(:)
    integer :: first, j, nx

    nx = plan%plan%cells(1)
    call combine_pair(kernel, plan, p, 0, lines(:, 2))
    call plan%plan%rows%transform_to(c_loc(lines(1, 2)), c_loc(lines(1, 1)))
    if (kernel%padded(1)) then
      call combine_pair(kernel, plan, p, 1, lines(:, 3))
      call plan%plan%rows%transform_to(c_loc(lines(1, 3)), c_loc(lines(1, 2)))
      call add_untwisted(plan%plan%row_twist, nx, lines(:, 2), lines(:, 1))
    end if
    first = 2*(p - 1)*nx
    do j = 1, nx
      y(first + j) = lines(2*j, 1)
    end do
    if (2*p > plan%owned_rows) return
    do j = 1, nx
      y(first + nx + j) = lines(2*j - 1, 1)
    end do
  end subroutine transform_back

  !> The transform `line` of pair `p` on a circle, from the pieces of all ranks.
  subroutine combine_pair(kernel, plan, p, circle, line)
    type(slab_kernel), intent(in) :: kernel
    type(slab_plan), intent(in) :: plan
    integer, intent(in) :: p, circle
    real(c_double), intent(inout), contiguous :: line(:)
    real(c_double), pointer, contiguous :: piece(:)
    integer :: begin, first, last, rank

    do rank = 0, plan%group%members() - 1
      call find_waves(kernel, plan%plan%length(1), circle, rank, first, last, begin)
      if (last < first) cycle
      call kernel%exchange%find_piece(p - 1, rank, plan%by_rows, plan%by_columns, piece)
      call combine(plan%plan%length(1), circle, first, last, piece(NUMBERS*begin + 1:), line)
    end do
  end subroutine combine_pair

  !> The transform of a pair from those of its rows, as `separate` gives them, all with parts exchanged.
  pure subroutine combine(n, circle, first, last, waves, line)
    integer, intent(in) :: n, circle, first, last
    real(c_double), intent(in), contiguous :: waves(:)
    real(c_double), intent(inout), contiguous :: line(:)
    integer :: i, k, o

    do k = first, last
      i = NUMBERS*(k - first)
      o = 2*opposite(n, circle, k)
      line(o + 1) = waves(i + 4) - waves(i + 1)
      line(o + 2) = waves(i + 2) + waves(i + 3)
      line(2*k + 1) = waves(i + 1) + waves(i + 4)
      line(2*k + 2) = waves(i + 2) - waves(i + 3)
    end do
  end subroutine combine

  !> Free the spectrum and what exchanges need.
  subroutine free(self)
    class(slab_kernel), intent(inout) :: self

    call self%exchange%free()
    if (allocated(self%spectrum)) deallocate (self%spectrum)
  end subroutine free

end module fuge_slab_convolution
