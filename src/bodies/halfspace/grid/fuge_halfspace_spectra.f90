!> The spectra of the influence operator of a grid on the half-space and of its preconditioner.
module fuge_halfspace_spectra
  use fuge_cell_elements, only: FUGE_FREE
  use fuge_even_spectrum, only: kernel_values, transform_columns, transform_rows
  use fuge_grid_convolution, only: grid_kernel
  use fuge_grid_plan, only: grid_plan
  use fuge_halfspace_grid, only: cyclic, halfspace_grid, periodic, FUGE_PERIODIC_X, FUGE_PERIODIC_Y
  use fuge_halfspace_table, only: fill_halfspace_rows
  use fuge_halfspace_waves, only: fill_free_columns, fill_free_rows, fill_periodic_eigenvalues, fill_periodic_kernel, &
    fill_strip_kernel
  use fuge_kinds, only: dp
  use fuge_status, only: FUGE_DONE
  implicit none
  private

  public :: bytes_needed, compute_spectra, fill_rows, invert

  !> The coefficients of a free surface.
  type, extends(kernel_values), public :: grid_values
    type(halfspace_grid) :: grid
  contains
    procedure :: fill
  end type grid_values

contains

  subroutine fill(self, begin, count, table, stat)
    class(grid_values), intent(in) :: self
    integer, intent(in) :: begin, count
    real(dp), intent(inout), contiguous :: table(:, :)
    integer, intent(out) :: stat

    stat = FUGE_DONE
    call fill_rows(self%grid, begin, count, table, stat)
  end subroutine fill

  !> `influence`, of A, and `inverse`, of the preconditioner, on the circles of `plan`; `datum` is what is subtracted
  !> from all coefficients. `status`: 0, else memory is short.
  subroutine compute_spectra(grid, plan, influence, inverse, datum, status)
    type(halfspace_grid), intent(in) :: grid
    type(grid_plan), intent(in) :: plan
    type(grid_kernel), intent(inout) :: influence, inverse
    real(dp), intent(inout) :: datum
    integer, intent(out) :: status
    real(dp), allocatable :: eigenvalue(:, :), same(:, :)
    integer :: length(2)

    length = plan%length
    allocate (eigenvalue(0:length(2)/2, 0:length(1)/2), stat=status)
    if (status == 0) call fill_periodic_eigenvalues(grid, length, eigenvalue, status)
    if (status == 0 .and. all(cyclic(grid))) allocate (same, source=eigenvalue, stat=status)
    if (status == 0) then
      call invert(eigenvalue, grid%e_star*sqrt(product(grid%spacing)))
      call inverse%set(plan, [.false., .false.], eigenvalue, status)
    end if
    if (status == 0 .and. all(cyclic(grid))) then
      call influence%set(plan, [.false., .false.], same, status)
    else if (status == 0) then
      call compute_influence(grid, plan, influence, datum, status)
    end if
  end subroutine compute_spectra

  !> The inverse of all eigenvalues. Where that of the constant is 0 any positive number is valid for it; that of the
  !> longest wave has the right size. If there is no other wave, it is `alone`.
  pure subroutine invert(eigenvalue, alone)
    real(dp), intent(inout) :: eigenvalue(0:, 0:)
    real(dp), intent(in) :: alone
    real(dp) :: longest
    integer :: k

    longest = eigenvalue(0, 0)
    if (.not. longest > 0.0_dp) longest = maxval(eigenvalue(0:min(1, ubound(eigenvalue, 1)), &
                                                            0:min(1, ubound(eigenvalue, 2))))
    do k = 0, ubound(eigenvalue, 2)
      eigenvalue(merge(1, 0, k == 0):, k) = 1.0_dp/eigenvalue(merge(1, 0, k == 0):, k)
    end do
    eigenvalue(0, 0) = alone
    if (longest > 0.0_dp) eigenvalue(0, 0) = 1.0_dp/longest
  end subroutine invert

  !> The eigenvalues of A on circles so long that the distance of no two cells is shorter the other way round, unless
  !> the surface repeats.
  subroutine compute_influence(grid, plan, influence, datum, status)
    type(halfspace_grid), intent(in) :: grid
    type(grid_plan), intent(in) :: plan
    type(grid_kernel), intent(inout) :: influence
    real(dp), intent(inout) :: datum
    integer, intent(out) :: status
    real(dp), allocatable :: spectrum(:, :)
    logical :: closed(2), padded(2)
    integer :: extent(2)

    closed = cyclic(grid)
    padded = .not. closed .and. grid%cells > 1
    extent = merge(plan%length, plan%length/2, padded)
    allocate (spectrum(0:extent(2), 0:extent(1)), stat=status)
    if (status == 0) call fill_spectrum(grid, closed, spectrum, datum, status)
    if (status == 0 .and. grid%boundary == FUGE_FREE .and. .not. grid%body%is_set()) then
      call transform_rows(plan, padded(1), spectrum, status, grid_values(grid))
    else if (status == 0 .and. .not. closed(1)) then
      call transform_rows(plan, padded(1), spectrum, status)
    end if
    if (status == 0 .and. .not. closed(2)) call transform_columns(plan, padded(2), spectrum, status)
    if (status /= 0) return
    ! The datum of a strip is the mean over the circle.
    if (any(closed) .and. .not. all(periodic(grid))) spectrum(0, 0) = 0.0_dp
    call influence%set(plan, padded, spectrum, status)
  end subroutine compute_influence

  !> Coefficients, and waves in directions that are `closed`; not those of a free half-space, which can be computed in
  !> parts.
  subroutine fill_spectrum(grid, closed, spectrum, datum, status)
    type(halfspace_grid), intent(in) :: grid
    logical, intent(in) :: closed(2)
    real(dp), intent(inout), contiguous :: spectrum(:, :)
    real(dp), intent(inout) :: datum
    integer, intent(out) :: status
    real(dp), allocatable :: turned(:, :)

    status = FUGE_DONE
    if (all(periodic(grid))) then
      call fill_periodic_kernel(grid, grid%period, closed, spectrum, status)
    else if (grid%boundary == FUGE_PERIODIC_X) then
      call fill_strip_kernel(grid, 1, grid%period(1), closed(1), spectrum, datum, status)
    else if (grid%boundary == FUGE_PERIODIC_Y) then
      allocate (turned(size(spectrum, 2), size(spectrum, 1)), stat=status)
      if (status == 0) call fill_strip_kernel(grid, 2, grid%period(2), closed(2), turned, datum, status)
      if (status == 0) call transpose_blocks(turned, spectrum)
    else if (grid%body%is_set()) then
      call fill_free_columns(grid, 0, size(spectrum, 2), spectrum, status)
    end if
  end subroutine fill_spectrum

  !> Influence coefficients of a free surface: `table` (0:, begin:), the rows from number `begin` on of a table of
  !> `rows`. `status` as in an allocate statement.
  subroutine fill_rows(grid, begin, rows, table, status)
    type(halfspace_grid), intent(in) :: grid
    integer, intent(in) :: begin, rows
    real(dp), intent(inout), contiguous :: table(:, :)
    integer, intent(out) :: status

    if (grid%body%is_set()) then
      call fill_free_rows(grid, begin, rows, table, status)
    else
      call fill_halfspace_rows(grid%spacing, grid%e_star, grid%element, begin, rows, table, status)
    end if
  end subroutine fill_rows

  !> transpose() of a block after the other, each of which stays in cache.
  pure subroutine transpose_blocks(a, b)
    real(dp), intent(in), contiguous :: a(:, :)
    real(dp), intent(inout), contiguous :: b(:, :)
    integer, parameter :: BLOCK = 16
    integer :: i, j, k

    do j = 1, size(a, 2), BLOCK
      do i = 1, size(a, 1), BLOCK
        do k = i, min(i + BLOCK - 1, size(a, 1))
          b(j:min(j + BLOCK - 1, size(a, 2)), k) = a(k, j:min(j + BLOCK - 1, size(a, 2)))
        end do
      end do
    end do
  end subroutine transpose_blocks

  !> The two spectra and the rows of a product.
  pure function bytes_needed(grid, length) result(bytes)
    type(halfspace_grid), intent(in) :: grid
    integer, intent(in) :: length(2)
    real(dp) :: bytes
    real(dp) :: circle(2), rows

    circle = merge(0.5_dp, 1.0_dp, cyclic(grid))*length + 1.0_dp
    rows = 2.0_dp*circle(1)*(grid%cells(2) + 1)
    bytes = 8.0_dp*(product(circle) + product(0.5_dp*length + 1.0_dp) + rows)
  end function bytes_needed

end module fuge_halfspace_spectra
