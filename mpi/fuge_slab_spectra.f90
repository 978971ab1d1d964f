!> The spectra of the influence operator of a grid whose rows ranks share, and of its preconditioner: as by
!> fuge_halfspace_spectra, but a rank computes only a part of the table, and keeps only its waves.
module fuge_slab_spectra
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_intptr_t, c_null_ptr, c_ptr
  use fuge_fft, only: allocate_values, release_buffer
  use fuge_halfplane_fft, only: FUGE_FREE
  use fuge_halfspace_grid, only: cyclic, halfspace_grid
  use fuge_halfspace_spectra, only: invert
  use fuge_halfspace_table, only: fill_halfspace_rows
  use fuge_halfspace_waves, only: fill_periodic_columns
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_slab_convolution, only: slab_kernel
  use fuge_slab_plan, only: slab_plan
  use fuge_slab_rows, only: block_of_waves
  use fuge_slab_transpose, only: local_numbers, slab_transpose
  use fuge_status, only: fuge_info, report, FUGE_ERR_MEMORY
  implicit none
  private

  public :: compute_slab_spectra

contains

  !> `influence`, of A, and `inverse`, of the preconditioner, on the circles of `plan`, `padded` (2) those of A. The
  !> surface is free or periodic in both directions. Error, on all ranks of the plan: FUGE_ERR_MEMORY.
  subroutine compute_slab_spectra(grid, plan, padded, measured, influence, inverse, info)
    type(halfspace_grid), intent(in) :: grid
    type(slab_plan), intent(inout) :: plan
    logical, intent(in) :: padded(2), measured
    type(slab_kernel), intent(inout) :: influence, inverse
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: spectrum(:, :)
    logical :: planned

    call inverse%place(plan, [.false., .false.])
    call fill_columns(plan%plan%length, grid, plan, inverse, spectrum, info)
    if (info%failed()) return
    call invert_columns(inverse%first, grid%e_star*sqrt(product(grid%spacing)), spectrum)
    call inverse%set(plan, measured, spectrum, planned)
    if (.not. planned) call report_no_memory(plan, info)
    call plan%group%agree(info)
    if (info%failed()) return
    call influence%place(plan, padded)
    if (all(cyclic(grid))) then
      call fill_columns(grid%period, grid, plan, influence, spectrum, info)
    else
      call transform_table(grid, plan, padded, influence, spectrum, info)
    end if
    if (info%failed()) return
    call influence%set(plan, measured, spectrum, planned)
    if (.not. planned) call report_no_memory(plan, info)
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
    if (stat == 0 .and. kernel%waves > 0) call fill_periodic_columns(cells, [.true., .true.], grid%spacing, &
                                                                     grid%e_star, grid%element, kernel%first, &
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
  !> transposed, the columns are transformed along y.
  subroutine transform_table(grid, plan, padded, kernel, spectrum, info)
    type(halfspace_grid), intent(in) :: grid
    type(slab_plan), intent(in) :: plan
    logical, intent(in) :: padded(2)
    type(slab_kernel), intent(in) :: kernel
    real(dp), allocatable, intent(out) :: spectrum(:, :)
    type(fuge_info), intent(inout) :: info
    type(slab_transpose) :: transpose
    real(c_double), pointer, contiguous :: by_rows(:), by_columns(:), table(:, :)
    type(c_ptr) :: memory(2)
    integer :: blocks(2), extent(2), first, rows, status
    logical :: closed(2), planned

    closed = cyclic(grid)
    extent = merge(plan%plan%length, plan%plan%length/2, padded)
    blocks = [block_of_waves(extent(2) + 1, plan%group%members()), &
              block_of_waves(kernel%all_waves, plan%group%members())]
    first = min(plan%group%number()*blocks(1), extent(2) + 1)
    rows = min(blocks(1), extent(2) + 1 - first)
    call allocate_buffers(plan, extent(2) + 1, kernel%all_waves, blocks, memory, by_rows, by_columns, info)
    if (info%failed()) return
    allocate (spectrum(0:extent(2), 0:kernel%waves - 1), stat=status)
    if (status /= 0) call report_no_memory(plan, info)
    call plan%group%agree(info)
    ! Planned first, because that may use the buffers.
    planned = .true.
    if (.not. info%failed()) call transpose%set(plan%group, extent(2) + 1, kernel%all_waves, 1, blocks, .false., &
                                                by_rows, by_columns, planned)
    if (rows > 0 .and. planned .and. .not. info%failed()) then
      table(0:extent(1), first:first + rows - 1) => by_rows(:(extent(1) + 1)*rows)
      call fill_rows(grid, closed, extent(2) + 1, first, table, status)
      if (status == 0 .and. .not. closed(1)) call plan%plan%transform_even(1, padded(1), table, status)
    end if
    if (status /= 0 .or. .not. planned) call report_no_memory(plan, info)
    call plan%group%agree(info)
    if (.not. info%failed()) then
      call transpose%forth(by_rows, by_columns)
      spectrum = reshape(by_columns(:size(spectrum)), shape(spectrum))
      if (kernel%waves > 0 .and. .not. closed(2)) call plan%plan%transform_even(2, padded(2), spectrum, status)
      if (status /= 0) call report_no_memory(plan, info)
      call plan%group%agree(info)
    end if
    call transpose%free()
    call release_buffer(memory(1))
    call release_buffer(memory(2))
  end subroutine transform_table

  !> Buffers for a transposition, on all ranks or on none.
  subroutine allocate_buffers(plan, rows, columns, blocks, memory, by_rows, by_columns, info)
    type(slab_plan), intent(in) :: plan
    integer, intent(in) :: rows, columns, blocks(2)
    type(c_ptr), intent(out) :: memory(2)
    real(c_double), pointer, contiguous, intent(out) :: by_rows(:), by_columns(:)
    type(fuge_info), intent(inout) :: info
    integer, parameter :: STRIDE = 1024
    real(c_double), pointer, contiguous :: values(:, :)
    integer :: k, lines, status(2)
    integer(c_intptr_t) :: numbers

    numbers = local_numbers(plan%group, rows, columns, 1, blocks)
    lines = int((numbers - 1)/STRIDE) + 1
    do k = 1, 2
      call allocate_values(STRIDE, lines, memory(k), values, status(k))
    end do
    nullify (by_rows, by_columns)
    if (any(status /= 0)) call report_no_memory(plan, info)
    call plan%group%agree(info)
    if (info%failed()) then
      do k = 1, 2
        if (status(k) == 0) call release_buffer(memory(k))
      end do
      memory = c_null_ptr
    else
      call c_f_pointer(memory(1), by_rows, [int(STRIDE, c_intptr_t)*lines])
      call c_f_pointer(memory(2), by_columns, [int(STRIDE, c_intptr_t)*lines])
    end if
  end subroutine allocate_buffers

  !> Coefficients, or waves in a direction that is `closed`: the rows from number `first` on of a table of `rows`.
  subroutine fill_rows(grid, closed, rows, first, table, status)
    type(halfspace_grid), intent(in) :: grid
    logical, intent(in) :: closed(2)
    integer, intent(in) :: rows, first
    real(c_double), intent(inout), contiguous :: table(:, :)
    integer, intent(out) :: status

    if (grid%boundary == FUGE_FREE) then
      call fill_halfspace_rows(grid%spacing, grid%e_star, grid%element, first, rows, table, status)
    else
      ! The columns of the kernel with x and y exchanged.
      call fill_periodic_columns(grid%period(2:1:-1), closed(2:1:-1), grid%spacing(2:1:-1), grid%e_star, grid%element, &
                                 first, table, status)
    end if
  end subroutine fill_rows

  subroutine report_no_memory(plan, info)
    type(slab_plan), intent(in) :: plan
    type(fuge_info), intent(inout) :: info

    call report(info, FUGE_ERR_MEMORY, 'no memory for nx = '//text(plan%plan%cells(1))//', ny = ' &
                //text(plan%plan%cells(2))//' on '//text(plan%group%members())//' ranks: use more ranks')
  end subroutine report_no_memory

end module fuge_slab_spectra
