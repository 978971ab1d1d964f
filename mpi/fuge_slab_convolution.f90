!> Products with convolution matrices of grids whose rows ranks share.
!>
!> As in fuge_grid_convolution, a pair of rows is transformed as one line of complex numbers, and zeros of a circle that
!> is twice as long are never transformed. Instead of a copy of a few columns at a time, FFTW transposes the transforms
!> of all ranks: an element is one wave of a pair of rows, two complex numbers. Each line is computed as by one process,
!> so that products do not depend on the number of ranks.
module fuge_slab_convolution
  use, intrinsic :: iso_c_binding, only: c_double, c_loc
  use fuge_grid_convolution, only: add_untwisted, convolve_line, opposite, twist_line
  use fuge_grid_plan, only: stored_waves
  use fuge_kinds, only: dp
  use fuge_slab_plan, only: slab_plan
  use fuge_slab_rows, only: block_of_waves
  use fuge_slab_transpose, only: slab_transpose
  implicit none
  private

  !> Real numbers of an element: one wave of both rows of a pair.
  integer, parameter :: NUMBERS = 4

  !> The spectrum of an even kernel, of the waves along x that this rank has. It must not be copied.
  type, public :: slab_kernel
    !> Is the circle twice as long as that of the plan?
    logical :: padded(2) = .false.
    !> Waves along x of all ranks, the first one of this rank from 0, and how many it has.
    integer :: all_waves = 0, first = 0, waves = 0
    !> (0:my, 0:waves - 1): as that of a `grid_kernel`, which includes the factor of the transforms.
    real(dp), allocatable :: spectrum(:, :)
    type(slab_transpose), private :: transpose
  contains
    procedure :: place
    procedure :: set
    procedure :: convolve
    procedure :: free
  end type slab_kernel

contains

  !> Find the waves of this rank, on circles that are `padded` (2) or not.
  subroutine place(self, plan, padded)
    class(slab_kernel), intent(inout) :: self
    type(slab_plan), intent(in) :: plan
    logical, intent(in) :: padded(2)
    integer :: block

    self%padded = padded
    self%all_waves = stored_waves(plan%plan%length(1), padded(1))
    block = block_of_waves(self%all_waves, plan%group%members())
    self%first = min(plan%group%number()*block, self%all_waves)
    self%waves = min(block, self%all_waves - self%first)
  end subroutine place

  !> Take the `spectrum` (0:my, 0:waves - 1) of this rank's waves and plan transpositions; after `place`. All ranks of
  !> the plan's group call it. `planned` is false without memory.
  subroutine set(self, plan, measured, spectrum, planned)
    class(slab_kernel), intent(inout) :: self
    type(slab_plan), intent(inout) :: plan
    logical, intent(in) :: measured
    real(dp), allocatable, intent(inout) :: spectrum(:, :)
    logical, intent(out) :: planned
    real(dp) :: circle
    integer :: k

    call move_alloc(spectrum, self%spectrum)
    ! Half of each pair of rows.
    circle = 2.0_dp*product(real(plan%plan%length, dp)*merge(2.0_dp, 1.0_dp, self%padded))
    do k = lbound(self%spectrum, 2), ubound(self%spectrum, 2)
      self%spectrum(:, k) = self%spectrum(:, k)/circle
    end do
    call self%transpose%set(plan%group, plan%all_pairs, self%all_waves, NUMBERS, &
                            [plan%block, block_of_waves(self%all_waves, plan%group%members())], measured, &
                            plan%by_rows, plan%by_columns, planned)
  end subroutine set

  !> y = the convolution of x with the kernel; both (nx*rows), the rows of this rank. All ranks of the group call it.
  subroutine convolve(self, plan, x, y)
    class(slab_kernel), intent(in) :: self
    type(slab_plan), intent(in) :: plan
    real(dp), intent(in) :: x(:)
    real(dp), intent(inout) :: y(:)
    real(c_double), pointer, contiguous :: by_rows(:), by_columns(:), lines(:, :)
    integer :: begin, k, width

    by_rows => plan%by_rows
    by_columns => plan%by_columns
    lines => plan%lines
    width = NUMBERS*self%all_waves
    do k = 1, plan%pairs
      begin = width*(k - 1)
      call transform_pair(self, plan, k, x, lines, by_rows(begin + 1:begin + width))
    end do
    call self%transpose%forth(by_rows, by_columns)
    width = NUMBERS*plan%all_pairs
    do k = 1, self%waves
      begin = width*(k - 1)
      call convolve_wave(self, plan, k, lines, by_columns(begin + 1:begin + width))
    end do
    call self%transpose%back_again(by_columns, by_rows)
    width = NUMBERS*self%all_waves
    do k = 1, plan%pairs
      begin = width*(k - 1)
      call transform_back(self, plan, k, by_rows(begin + 1:begin + width), lines, y)
    end do
  end subroutine convolve

  !> Twice the transforms of the rows 2 p - 1 and 2 p of x: `waves` (4, all waves).
  subroutine transform_pair(kernel, plan, p, x, lines, waves)
    type(slab_kernel), intent(in) :: kernel
    type(slab_plan), intent(in) :: plan
    integer, intent(in) :: p
    real(dp), intent(in) :: x(:)
    real(c_double), intent(inout), contiguous, target :: lines(:, :)
    real(c_double), intent(inout), contiguous :: waves(:)
    logical :: zero
    integer :: n

    n = plan%plan%length(1)
    call pack_rows(plan%plan%cells(1), n, 2*p <= plan%rows, p, x, lines(:, 1), zero)
    if (zero) then
      waves = 0.0_dp
      return
    end if
    call plan%plan%rows%transform_to(c_loc(lines(1, 1)), c_loc(lines(1, 2)))
    call separate(n, 0, n/2, lines(:, 2), waves)
    if (.not. kernel%padded(1)) return
    call twist_line(plan%plan%row_twist, plan%plan%cells(1), lines(:, 1), lines(:, 2))
    call plan%plan%rows%transform_to(c_loc(lines(1, 2)), c_loc(lines(1, 1)))
    call separate(n, 1, (n - 1)/2, lines(:, 1), waves(NUMBERS*(n/2 + 1) + 1:))
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

  !> Twice the transforms of both rows of a pair from that of the pair: of the waves 0 .. `most` of a circle.
  pure subroutine separate(n, circle, most, line, waves)
    integer, intent(in) :: n, circle, most
    real(c_double), intent(in), contiguous :: line(:)
    real(c_double), intent(inout), contiguous :: waves(:)
    integer :: k, o

    do k = 0, most
      o = 2*opposite(n, circle, k)
      waves(4*k + 1) = line(2*k + 1) + line(o + 1)
      waves(4*k + 2) = line(2*k + 2) - line(o + 2)
      waves(4*k + 3) = line(2*k + 2) + line(o + 2)
      waves(4*k + 4) = line(o + 1) - line(2*k + 1)
    end do
  end subroutine separate

  !> Convolve `column`, number `k` of this rank; the result has real and imaginary parts exchanged.
  subroutine convolve_wave(kernel, plan, k, lines, column)
    type(slab_kernel), intent(in) :: kernel
    type(slab_plan), intent(in) :: plan
    integer, intent(in) :: k
    real(c_double), intent(inout), contiguous, target :: lines(:, :)
    real(c_double), intent(inout), contiguous :: column(:)
    integer :: rows

    rows = plan%plan%cells(2)
    lines(:2*rows, 1) = column(:2*rows)
    lines(2*rows + 1:2*plan%plan%length(2), 1) = 0.0_dp
    call convolve_line(plan%plan%columns, plan%plan%column_twist, rows, kernel%padded(2), kernel%spectrum(:, k - 1), &
                       lines(:, 1), lines(:, 2), lines(:, 3))
    column(:2*rows) = lines(:2*rows, 1)
    ! The second row of a last pair without one.
    column(2*rows + 1:) = 0.0_dp
  end subroutine convolve_wave

  !> The rows 2 p - 1 and 2 p of y from their `waves`, real and imaginary parts exchanged.
  subroutine transform_back(kernel, plan, p, waves, lines, y)
    type(slab_kernel), intent(in) :: kernel
    type(slab_plan), intent(in) :: plan
    integer, intent(in) :: p
    real(c_double), intent(in), contiguous :: waves(:)
    real(c_double), intent(inout), contiguous, target :: lines(:, :)
    real(dp), intent(inout) :: y(:)
    integer :: first, j, n, nx

    n = plan%plan%length(1)
    nx = plan%plan%cells(1)
    call combine(n, 0, n/2, waves, lines(:, 2))
    call plan%plan%rows%transform_to(c_loc(lines(1, 2)), c_loc(lines(1, 1)))
    if (kernel%padded(1)) then
      call combine(n, 1, (n - 1)/2, waves(NUMBERS*(n/2 + 1) + 1:), lines(:, 3))
      call plan%plan%rows%transform_to(c_loc(lines(1, 3)), c_loc(lines(1, 2)))
      call add_untwisted(plan%plan%row_twist, nx, lines(:, 2), lines(:, 1))
    end if
    first = 2*(p - 1)*nx
    do j = 1, nx
      y(first + j) = lines(2*j, 1)
    end do
    if (2*p > plan%rows) return
    do j = 1, nx
      y(first + nx + j) = lines(2*j - 1, 1)
    end do
  end subroutine transform_back

  !> The transform of a pair from those of its rows, as `separate` gives them, all with parts exchanged.
  pure subroutine combine(n, circle, most, waves, line)
    integer, intent(in) :: n, circle, most
    real(c_double), intent(in), contiguous :: waves(:)
    real(c_double), intent(inout), contiguous :: line(:)
    integer :: k, o

    do k = 0, most
      o = 2*opposite(n, circle, k)
      line(o + 1) = waves(4*k + 4) - waves(4*k + 1)
      line(o + 2) = waves(4*k + 2) + waves(4*k + 3)
      line(2*k + 1) = waves(4*k + 1) + waves(4*k + 4)
      line(2*k + 2) = waves(4*k + 2) - waves(4*k + 3)
    end do
  end subroutine combine

  !> Destroy the plans.
  subroutine free(self)
    class(slab_kernel), intent(inout) :: self

    call self%transpose%free()
    if (allocated(self%spectrum)) deallocate (self%spectrum)
  end subroutine free

end module fuge_slab_convolution
