!> Convolutions of one grid of values with many kernels, each of which is even or odd in each direction.
!>
!> Value (i, j) of a grid of nx by ny has the number i + nx*(j - 1). The values are transformed once, as a whole. A
!> direction that is not cyclic is continued by zeros to at least 2 n cells, so that no cell is reached the other way
!> round.
!>
!> The spectrum of a kernel is real if the kernel is even in both directions or odd in both, and imaginary if it is odd
!> in one of them; along y it is even or odd as the kernel is. So one transform serves the sum of four kernels, one of
!> each kind, and their spectra are found in it again.
module fuge_grid_waves
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_null_ptr, c_ptr
  use fuge_fft, only: fft_plan, good_length, release_buffer
  use fuge_kinds, only: dp
  use fuge_memory, only: check_memory
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_MEMORY
  implicit none
  private

  !> The numbers of one grid: values, or the waves that replace them.
  type :: wave_buffer
    type(c_ptr) :: address = c_null_ptr
    real(c_double), pointer, contiguous :: numbers(:) => null()
  end type wave_buffer

  !> Values and their waves: `set`, `transform`, then products; `free` at the end. Not to be copied, because it owns
  !> memory of FFTW.
  type, public :: grid_waves
    private
    !> nx and ny; 0 before `set`.
    integer :: cells(2) = 0
    !> Cells of the circle in each direction.
    integer :: length(2) = 0
    type(fft_plan) :: plan
    type(wave_buffer) :: values, kernels, product
  contains
    procedure :: set
    procedure :: free
    procedure :: transform
    procedure :: clear_kernels
    procedure :: add_kernel
    procedure :: transform_kernels
    procedure :: convolve
    procedure :: multiply
  end type grid_waves

contains

  !> Plan transforms of `cells` (2), all >= 1, and allocate all that the products need.
  !>
  !> `cyclic` (2): the values repeat in this direction. `tables`: kernels are given by tables, not by spectra.
  !> Error, without effect: FUGE_ERR_MEMORY.
  subroutine set(self, cells, cyclic, tables, info)
    class(grid_waves), intent(inout) :: self
    integer, intent(in) :: cells(2)
    logical, intent(in) :: cyclic(2), tables
    type(fuge_info), intent(inout) :: info
    integer :: k, length(2), status

    call self%free()
    length = cells
    do k = 1, 2
      if (cyclic(k) .or. cells(k) == 1) cycle
      length(k) = 0
      if (cells(k) <= (huge(length) - 1)/2) length(k) = good_length(2*cells(k))
    end do
    if (any(length < 1)) then
      call report(info, FUGE_ERR_MEMORY, 'a grid of '//text(cells(1))//' by '//text(cells(2)) &
                  //' cells has too many in one direction: use a coarser grid')
      return
    end if
    call check_memory(merge(24.0_dp, 16.0_dp, tables)*(real(length(1), dp) + 2.0_dp)*real(length(2), dp), &
                      'a grid of '//text(cells(1))//' by '//text(cells(2))//' cells', info)
    if (.not. info%failed()) call self%plan%set(length(1), info, lines=length(2))
    if (info%failed()) return
    call take(self%plan, self%values, status)
    if (status == FUGE_DONE) call take(self%plan, self%product, status)
    if (status == FUGE_DONE .and. tables) call take(self%plan, self%kernels, status)
    if (status /= FUGE_DONE) then
      call self%free()
      call report(info, FUGE_ERR_MEMORY, 'no memory for the transforms of '//text(cells(1))//' by '//text(cells(2)) &
                  //' cells: use a coarser grid')
      return
    end if
    self%cells = cells
    self%length = length
  end subroutine set

  !> Release everything; without effect before `set`.
  subroutine free(self)
    class(grid_waves), intent(inout) :: self

    call give_back(self%values)
    call give_back(self%kernels)
    call give_back(self%product)
    call self%plan%free()
    self%cells = 0
    self%length = 0
  end subroutine free

  subroutine take(plan, buffer, status)
    type(fft_plan), intent(in) :: plan
    type(wave_buffer), intent(inout) :: buffer
    integer, intent(out) :: status

    call plan%allocate_buffer(buffer%address, buffer%numbers, status)
  end subroutine take

  subroutine give_back(buffer)
    type(wave_buffer), intent(inout) :: buffer

    if (c_associated(buffer%address)) call release_buffer(buffer%address)
    buffer%address = c_null_ptr
    nullify (buffer%numbers)
  end subroutine give_back

  !> The values of a grid, lines of `length`(1) numbers with room behind them.
  subroutine see_values(self, buffer, values)
    type(grid_waves), intent(in) :: self
    type(wave_buffer), intent(in) :: buffer
    real(c_double), pointer, contiguous, intent(out) :: values(:, :)

    values(0:2*(self%length(1)/2) + 1, 0:self%length(2) - 1) => buffer%numbers
  end subroutine see_values

  !> The waves of a grid: real and imaginary part, waves 0 .. along x, waves along y.
  subroutine see_waves(self, buffer, waves)
    type(grid_waves), intent(in) :: self
    type(wave_buffer), intent(in) :: buffer
    real(c_double), pointer, contiguous, intent(out) :: waves(:, :, :)

    waves(1:2, 0:self%length(1)/2, 0:self%length(2) - 1) => buffer%numbers
  end subroutine see_waves

  !> Take `x` (nx*ny) as the values of all later products.
  subroutine transform(self, x)
    class(grid_waves), intent(inout) :: self
    real(dp), intent(in) :: x(:)
    real(c_double), pointer, contiguous :: values(:, :)
    integer :: i, j, nx

    call see_values(self, self%values, values)
    nx = self%cells(1)
    do j = 0, self%length(2) - 1
      values(:, j) = 0.0_dp
      if (j >= self%cells(2)) cycle
      do i = 0, nx - 1
        values(i, j) = x(i + 1 + nx*j)
      end do
    end do
    call self%plan%transform(self%values%address)
  end subroutine transform

  !> Before the first `add_kernel` of a sum.
  subroutine clear_kernels(self)
    class(grid_waves), intent(inout) :: self

    self%kernels%numbers = 0.0_dp
  end subroutine clear_kernels

  !> Add a kernel to the sum, which may hold one of each kind.
  !>
  !> `odd` (2): its kind. `table` (nx*ny): its values at the distances of i and j cells along x and y, at
  !> 1 + i + nx*j; in a cyclic direction those up to half of the cells count. An odd kernel is 0 at the distance 0.
  subroutine add_kernel(self, odd, table)
    class(grid_waves), intent(inout) :: self
    logical, intent(in) :: odd(2)
    real(dp), intent(in) :: table(:)
    real(c_double), pointer, contiguous :: values(:, :)
    real(dp) :: sign_x, sign_y, value
    integer :: i, j, most(2), opposite(2)

    call see_values(self, self%kernels, values)
    sign_x = merge(-1.0_dp, 1.0_dp, odd(1))
    sign_y = merge(-1.0_dp, 1.0_dp, odd(2))
    most = min(self%cells - 1, self%length/2)
    do j = 0, most(2)
      opposite(2) = modulo(-j, self%length(2))
      do i = 0, most(1)
        opposite(1) = modulo(-i, self%length(1))
        value = table(1 + i + self%cells(1)*j)
        values(i, j) = values(i, j) + value
        if (opposite(1) /= i) values(opposite(1), j) = values(opposite(1), j) + sign_x*value
        if (opposite(2) == j) cycle
        values(i, opposite(2)) = values(i, opposite(2)) + sign_y*value
        if (opposite(1) /= i) values(opposite(1), opposite(2)) = values(opposite(1), opposite(2)) + sign_x*sign_y*value
      end do
    end do
  end subroutine add_kernel

  !> After the last `add_kernel` of a sum.
  subroutine transform_kernels(self)
    class(grid_waves), intent(inout) :: self

    call self%plan%transform(self%kernels%address)
  end subroutine transform_kernels

  !> `y` (nx*ny): the values convolved with the kernel of the kind `odd` (2) in the sum.
  subroutine convolve(self, odd, y)
    class(grid_waves), intent(inout) :: self
    logical, intent(in) :: odd(2)
    real(dp), intent(inout) :: y(:)
    real(c_double), pointer, contiguous :: kernels(:, :, :), values(:, :, :), product(:, :, :)
    real(dp) :: factor, sign_y
    integer :: j, k, component, opposite

    call see_waves(self, self%kernels, kernels)
    call see_waves(self, self%values, values)
    call see_waves(self, self%product, product)
    component = merge(2, 1, odd(1) .neqv. odd(2))
    sign_y = merge(-0.5_dp, 0.5_dp, odd(2))
    do k = 0, self%length(2) - 1
      opposite = modulo(-k, self%length(2))
      if (component == 1) then
        do j = 0, self%length(1)/2
          factor = 0.5_dp*kernels(1, j, k) + sign_y*kernels(1, j, opposite)
          product(1, j, k) = factor*values(1, j, k)
          product(2, j, k) = factor*values(2, j, k)
        end do
      else
        do j = 0, self%length(1)/2
          factor = 0.5_dp*kernels(2, j, k) + sign_y*kernels(2, j, opposite)
          product(1, j, k) = -factor*values(2, j, k)
          product(2, j, k) = factor*values(1, j, k)
        end do
      end if
    end do
    call transform_back(self, y)
  end subroutine convolve

  !> `y` (nx*ny): the values convolved with a kernel of the kind `odd` (2) whose spectrum is given, cyclic in both
  !> directions.
  !>
  !> `spectrum` (0:nx/2, 0:ny/2): (j, k) is the factor of the wave of j and k periods along x and y, but for the
  !> imaginary unit of a kernel that is odd in one direction.
  subroutine multiply(self, odd, spectrum, y)
    class(grid_waves), intent(inout) :: self
    logical, intent(in) :: odd(2)
    real(dp), intent(in), contiguous :: spectrum(0:, 0:)
    real(dp), intent(inout) :: y(:)
    real(c_double), pointer, contiguous :: values(:, :, :), product(:, :, :)
    real(dp) :: factor, sign_y
    integer :: j, k, row

    call see_waves(self, self%values, values)
    call see_waves(self, self%product, product)
    do k = 0, self%length(2) - 1
      row = min(k, self%length(2) - k)
      sign_y = merge(-1.0_dp, 1.0_dp, odd(2) .and. row < k)
      do j = 0, self%length(1)/2
        factor = sign_y*spectrum(j, row)
        if (odd(1) .neqv. odd(2)) then
          product(1, j, k) = -factor*values(2, j, k)
          product(2, j, k) = factor*values(1, j, k)
        else
          product(1, j, k) = factor*values(1, j, k)
          product(2, j, k) = factor*values(2, j, k)
        end if
      end do
    end do
    call transform_back(self, y)
  end subroutine multiply

  !> Transform the product back to the cells of the grid.
  subroutine transform_back(self, y)
    type(grid_waves), intent(inout) :: self
    real(dp), intent(inout) :: y(:)
    real(c_double), pointer, contiguous :: values(:, :)
    real(dp) :: factor
    integer :: i, j, nx

    call self%plan%transform_back(self%product%address)
    call see_values(self, self%product, values)
    nx = self%cells(1)
    factor = 1.0_dp/(real(self%length(1), dp)*real(self%length(2), dp))
    do j = 0, self%cells(2) - 1
      do i = 0, nx - 1
        y(1 + i + nx*j) = factor*values(i, j)
      end do
    end do
  end subroutine transform_back

end module fuge_grid_waves
