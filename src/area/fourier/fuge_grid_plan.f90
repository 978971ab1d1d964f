!> Plans for the lines of two-dimensional grids, on circles that may be twice as long.
!>
!> A circle of 2N cells, of which at most N hold values and N results are wanted, is split in two of N: waves of even
!> number, and waves of odd number, for which the values are multiplied by exp(-i pi j/N) before the transform and after
!> it by the conjugate. So one plan of N serves both.
module fuge_grid_plan
  use, intrinsic :: iso_c_binding, only: c_double, c_loc, c_ptr
  use fuge_constants, only: PI
  use fuge_fft, only: allocate_values, fft_plan, release_buffer
  use fuge_kept_rows, only: free_rows, kept_rows, return_rows, take_rows, taken_rows
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_MEMORY, FUGE_ERR_SIZE
  implicit none
  private

  public :: fast_length, return_rows, stored_waves, take_rows, taken_rows

  !> Transforms of the lines of a grid.
  type, public :: grid_plan
    !> nx and ny; 0 before `set`.
    integer :: cells(2) = 0
    !> N of each direction.
    integer :: length(2) = 0
    type(fft_plan) :: rows, columns
    !> cos and sin of pi j/N, j = 0 .. N - 1, (2, N).
    real(dp), allocatable :: row_twist(:, :), column_twist(:, :)
    !> Belongs to the variable that owns the plans.
    type(kept_rows), pointer :: kept => null()
  contains
    procedure :: set => set_plan
    procedure :: transform_even
    procedure :: copy_from => copy_plan
    procedure :: move_from => move_plan
    final :: release_plan
  end type grid_plan

contains

  !> A length >= n that FFTW transforms in the least time without measuring; 0 if it exceeds the largest default
  !> integer.
  !>
  !> Its estimate costs, for each prime factor 3, 5 or 7 about 1.5, 1.1 and 1.4 times as much as powers of two of the
  !> same length.
  pure function fast_length(n) result(length)
    integer, intent(in) :: n
    integer :: length
    integer, parameter :: FACTORS(7) = [1, 3, 5, 7, 9, 15, 25]
    real(dp), parameter :: WEIGHTS(7) = [1.0_dp, 1.5_dp, 1.1_dp, 1.4_dp, 2.3_dp, 1.5_dp, 1.4_dp]
    real(dp) :: candidate, best
    integer :: k

    length = 0
    best = huge(best)
    do k = 1, size(FACTORS)
      candidate = real(FACTORS(k), dp)
      do while (candidate < real(n, dp))
        candidate = 2.0_dp*candidate
      end do
      if (candidate > real(huge(n), dp) .or. candidate*WEIGHTS(k) >= best) cycle
      best = candidate*WEIGHTS(k)
      length = int(candidate)
    end do
  end function fast_length

  !> Plan transforms of `cells` (2) values on circles of `length` (2) >= `cells`, or twice that.
  !>
  !> `measured` as in fuge_fft. Errors, the plan unchanged: FUGE_ERR_SIZE, FUGE_ERR_MEMORY.
  subroutine set_plan(self, cells, length, info, measured)
    class(grid_plan), intent(inout) :: self
    integer, intent(in) :: cells(2), length(2)
    type(fuge_info), intent(inout) :: info
    logical, intent(in) :: measured
    type(grid_plan) :: new

    call prepare_plan(new, cells, length, info, measured)
    if (.not. info%failed()) call self%move_from(new)
  end subroutine set_plan

  !> Set a plan that has nothing yet, but perhaps the factors of the right lengths. Errors as in `set`.
  subroutine prepare_plan(plan, cells, length, info, measured)
    type(grid_plan), intent(inout) :: plan
    integer, intent(in) :: cells(2), length(2)
    type(fuge_info), intent(inout) :: info
    logical, intent(in) :: measured
    integer :: stat

    call plan%rows%set(2*length(1), info, measured=measured, separate=.true.)
    if (.not. info%failed()) call plan%columns%set(2*length(2), info, measured=measured, separate=.true.)
    if (info%failed()) return
    stat = 0
    if (.not. allocated(plan%row_twist)) allocate (plan%row_twist(2, length(1)), stat=stat)
    if (stat == 0 .and. .not. allocated(plan%column_twist)) allocate (plan%column_twist(2, length(2)), stat=stat)
    if (stat == 0) allocate (plan%kept, stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for transforms of '//text(length(1))//' by '//text(length(2)) &
                  //' values')
      return
    end if
    call compute_twist(plan%row_twist)
    call compute_twist(plan%column_twist)
    plan%cells = cells
    plan%length = length
  end subroutine prepare_plan

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
    if (source%rows%owns_plans()) self%kept => source%kept
    nullify (source%kept)
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

    if (source%cells(1) > 0) then
      ! Kept, because the source may be a bitwise copy of self that shares them.
      if (all(self%length == source%length)) then
        if (allocated(self%row_twist)) call move_alloc(self%row_twist, new%row_twist)
        if (allocated(self%column_twist)) call move_alloc(self%column_twist, new%column_twist)
      end if
      call prepare_plan(new, source%cells, source%length, info, source%rows%measured)
    end if
    call self%move_from(new)
  end subroutine copy_plan

  subroutine clear_plan(self)
    class(grid_plan), intent(inout) :: self

    if (allocated(self%row_twist)) deallocate (self%row_twist)
    if (allocated(self%column_twist)) deallocate (self%column_twist)
    if (self%rows%owns_plans() .and. associated(self%kept)) then
      call free_rows(self%kept)
      deallocate (self%kept)
    end if
    nullify (self%kept)
    self%cells = 0
    self%length = 0
  end subroutine clear_plan

  impure elemental subroutine release_plan(self)
    type(grid_plan), intent(inout) :: self

    call clear_plan(self)
  end subroutine release_plan

end module fuge_grid_plan
