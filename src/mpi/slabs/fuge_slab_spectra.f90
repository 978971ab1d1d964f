!> The spectra of the influence operator of a grid whose rows ranks share, and of its preconditioner: as by
!> fuge_halfspace_spectra, but a rank computes only some rows of the table, and keeps only its waves.
module fuge_slab_spectra
  use, intrinsic :: iso_c_binding, only: c_double, c_intptr_t
  use fuge_cell_elements, only: FUGE_FREE
  use fuge_halfspace_grid, only: cyclic, halfspace_grid
  use fuge_halfspace_spectra, only: fill_rows, invert
  use fuge_halfspace_waves, only: fill_periodic_columns
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_slab_convolution, only: slab_kernel
  use fuge_slab_exchange, only: slab_exchange
  use fuge_slab_plan, only: slab_plan
  use fuge_slab_rows, only: block_of_waves
  use fuge_status, only: fuge_info, report, FUGE_ERR_MEMORY
  implicit none
  private

  public :: compute_slab_spectra

contains

  !> `influence`, of A, and `inverse`, of the preconditioner, on the circles of `plan`, `padded` (2) those of A. The
  !> surface is free or periodic in both directions. Error, on all ranks of the plan: FUGE_ERR_MEMORY.
  subroutine compute_slab_spectra(grid, plan, padded, influence, inverse, info)
    type(halfspace_grid), intent(in) :: grid
    type(slab_plan), intent(inout) :: plan
    logical, intent(in) :: padded(2)
    type(slab_kernel), intent(inout) :: influence, inverse
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: spectrum(:, :)
    integer :: status

    call inverse%locate(plan, [.false., .false.])
    call fill_columns(plan%plan%length, grid, plan, inverse, spectrum, info)
    if (info%failed()) return
    call invert_columns(inverse%first, grid%e_star*sqrt(product(grid%spacing)), spectrum)
    call inverse%set(plan, spectrum, status)
    if (status /= 0) call report_no_memory(plan, info)
    call plan%group%agree(info)
    if (info%failed()) return
    call influence%locate(plan, padded)
    if (all(cyclic(grid))) then
      call fill_columns(grid%period, grid, plan, influence, spectrum, info)
    else
      call transform_table(grid, plan, padded, influence, spectrum, info)
    end if
    if (info%failed()) return
    call influence%set(plan, spectrum, status)
    if (status /= 0) call report_no_memory(plan, info)
    call plan%group%agree(info)
  end subroutine compute_slab_spectra

  !> The eigenvalues of a periodic surface of `cells`, for the waves of `kernel`.
  subroutine fill_columns(cells, grid, plan, kernel, spectrum, info)
    integer, intent(in) :: cells(2)
    type(halfspace_grid), intent(in) :: grid
    type(slab_plan), intent(in) :: plan
    type(slab_kernel), intent(in) :: kernel
    real(dp), allocatable, intent(out) :: spectrum(:, :)
    type(fuge_info), intent(inout) :: info
    integer :: stat

    allocate (spectrum(0:cells(2)/2, 0:kernel%waves - 1), stat=stat)
    if (stat == 0 .and. kernel%waves > 0) call fill_periodic_columns(grid, cells, [.true., .true.], kernel%first, &
                                                                     spectrum, stat)
    if (stat /= 0) call report_no_memory(plan, info)
    call plan%group%agree(info)
  end subroutine fill_columns

  !> `invert` for the waves from number `first` on.
  pure subroutine invert_columns(first, alone, eigenvalue)
    integer, intent(in) :: first
    real(dp), intent(in) :: alone
    real(dp), allocatable, intent(inout) :: eigenvalue(:, :)

    if (size(eigenvalue) < 1) return
    if (first == 0) then
      call invert(eigenvalue, alone)
    else
      eigenvalue = 1.0_dp/eigenvalue
    end if
  end subroutine invert_columns

  !> The eigenvalues of A from its coefficients: each rank fills some rows of their table and transforms them along x;
  !> after an exchange the columns are transformed along y.
  subroutine transform_table(grid, plan, padded, kernel, spectrum, info)
    type(halfspace_grid), intent(in) :: grid
    type(slab_plan), intent(in) :: plan
    logical, intent(in) :: padded(2)
    type(slab_kernel), intent(in) :: kernel
    real(dp), allocatable, intent(out) :: spectrum(:, :)
    type(fuge_info), intent(inout) :: info
    type(slab_exchange) :: exchange
    real(c_double), allocatable :: table(:, :)
    logical :: closed(2)
    integer :: extent(2), rows(2), status

    closed = cyclic(grid)
    extent = merge(plan%plan%length, plan%plan%length/2, padded)
    call exchange%describe(plan%group, extent(2) + 1, kernel%all_waves, 1, &
                           [block_of_waves(extent(2) + 1, plan%group%members()), &
                            block_of_waves(kernel%all_waves, plan%group%members())])
    rows = exchange%row_range(plan%group%number())
    allocate (spectrum(0:extent(2), 0:kernel%waves - 1), table(0:extent(1), rows(2)), stat=status)
    if (status == 0 .and. rows(2) > 0) then
      call fill_any_rows(grid, closed, extent(2) + 1, rows(1), table, status)
      if (status == 0 .and. .not. closed(1)) call plan%plan%transform_even(1, padded(1), table, status)
    end if
    if (status == 0) call exchange%set(status)
    if (status /= 0) call report_no_memory(plan, info)
    call plan%group%agree(info)
    if (.not. info%failed()) call exchange_table(exchange, plan, table, spectrum, info)
    call exchange%free()
    if (info%failed()) return
    if (kernel%waves > 0 .and. .not. closed(2)) call plan%plan%transform_even(2, padded(2), spectrum, status)
    if (status /= 0) call report_no_memory(plan, info)
    call plan%group%agree(info)
  end subroutine transform_table

  !> `spectrum`: the columns of this rank from the rows `table` of each rank. Error, on all ranks: FUGE_ERR_MEMORY.
  subroutine exchange_table(exchange, plan, table, spectrum, info)
    type(slab_exchange), intent(inout) :: exchange
    type(slab_plan), intent(in) :: plan
    real(dp), intent(in), contiguous :: table(:, :)
    real(dp), intent(inout), contiguous :: spectrum(0:, 0:)
    type(fuge_info), intent(inout) :: info
    real(c_double), pointer, contiguous :: by_rows(:), by_columns(:)
    integer :: status(2)

    allocate (by_rows(exchange%numbers_by_rows()), stat=status(1))
    allocate (by_columns(exchange%numbers_by_columns()), stat=status(2))
    if (any(status /= 0)) call report_no_memory(plan, info)
    call plan%group%agree(info)
    if (.not. info%failed()) then
      call exchange%begin_rows(by_columns)
      call send_table(exchange, plan%group%members(), table, by_rows, by_columns)
      call exchange%finish()
      call transpose_columns(by_columns, spectrum)
    end if
    if (status(1) == 0) deallocate (by_rows)
    if (status(2) == 0) deallocate (by_columns)
  end subroutine exchange_table

  !> Send the rows of `table`.
  subroutine send_table(exchange, ranks, table, by_rows, by_columns)
    type(slab_exchange), intent(inout) :: exchange
    integer, intent(in) :: ranks
    real(dp), intent(in), contiguous :: table(:, :)
    real(c_double), pointer, contiguous, intent(in) :: by_rows(:), by_columns(:)
    real(c_double), pointer, contiguous :: piece(:)
    integer :: k, range(2), rank

    do k = 1, size(table, 2)
      do rank = 0, ranks - 1
        range = exchange%column_range(rank)
        call exchange%find_piece(k - 1, rank, by_rows, by_columns, piece)
        piece = table(range(1) + 1:range(1) + range(2), k)
      end do
      call exchange%send_row(k - 1, by_rows)
    end do
  end subroutine send_table

  !> Columns that lie side by side, one after the other.
  pure subroutine transpose_columns(by_columns, spectrum)
    real(c_double), intent(in), contiguous :: by_columns(:)
    real(dp), intent(inout), contiguous :: spectrum(0:, 0:)
    integer, parameter :: BLOCK = 8
    integer(c_intptr_t) :: begin
    integer :: first, j, last

    do first = 0, size(spectrum, 2) - 1, BLOCK
      last = min(first + BLOCK, size(spectrum, 2)) - 1
      do j = 0, size(spectrum, 1) - 1
        begin = int(j, c_intptr_t)*size(spectrum, 2)
        spectrum(j, first:last) = by_columns(begin + first + 1:begin + last + 1)
      end do
    end do
  end subroutine transpose_columns

  !> Coefficients, or waves in a direction that is `closed`: the rows from number `first` on of a table of `rows`.
  subroutine fill_any_rows(grid, closed, rows, first, table, status)
    type(halfspace_grid), intent(in) :: grid
    logical, intent(in) :: closed(2)
    integer, intent(in) :: rows, first
    real(dp), intent(inout), contiguous :: table(:, :)
    integer, intent(out) :: status
    type(halfspace_grid) :: exchanged

    if (grid%boundary == FUGE_FREE) then
      call fill_rows(grid, first, rows, table, status)
    else
      ! The columns of the kernel with x and y exchanged.
      exchanged = grid
      exchanged%spacing = grid%spacing(2:1:-1)
      call fill_periodic_columns(exchanged, grid%period(2:1:-1), closed(2:1:-1), first, table, status)
    end if
  end subroutine fill_any_rows

  subroutine report_no_memory(plan, info)
    type(slab_plan), intent(in) :: plan
    type(fuge_info), intent(inout) :: info

    call report(info, FUGE_ERR_MEMORY, 'no memory for nx = '//text(plan%plan%cells(1))//', ny = ' &
                //text(plan%plan%cells(2))//' on '//text(plan%group%members())//' ranks: use more ranks')
  end subroutine report_no_memory

end module fuge_slab_spectra
