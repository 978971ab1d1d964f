!> Spectra of even kernels of two-dimensional grids. Threads share rows, then columns; no result depends on how many
!> there are.
module fuge_even_spectrum
  use fuge_grid_plan, only: grid_plan
  use fuge_kinds, only: dp
  use fuge_status, only: FUGE_DONE, FUGE_ERR_MEMORY
  use fuge_threads, only: run_in_parts, share, threads_here, work_in_parts
  implicit none
  private

  public :: transform_columns, transform_rows

  !> Rows, or columns, that are transformed together: an even number, because transforms take two at a time.
  integer, parameter :: LINES = 32

  !> A kernel that is even in both directions, by its values.
  type, abstract, public :: kernel_values
  contains
    procedure(fill_rows), deferred :: fill
  end type kernel_values

  abstract interface
    !> `table` (nx, rows): the values at the distances of 0, 1, .. cells along x, and of `begin`, begin + 1, .. cells
    !> along y, of a grid of `count` rows. `stat` as in an allocate statement.
    subroutine fill_rows(self, begin, count, table, stat)
      import :: dp, kernel_values
      class(kernel_values), intent(in) :: self
      integer, intent(in) :: begin, count
      real(dp), intent(inout), contiguous :: table(:, :)
      integer, intent(out) :: stat
    end subroutine fill_rows
  end interface

  !> All rows, with a kernel or without one, or all columns.
  type, extends(work_in_parts) :: transform_job
    type(grid_plan), pointer :: plan => null()
    logical :: along_x = .true., padded = .false.
    class(kernel_values), pointer :: kernel => null()
    real(dp), pointer, contiguous :: spectrum(:, :) => null()
    !> FUGE_DONE, or what went wrong in each part.
    integer, allocatable :: status(:)
  contains
    procedure :: do_part
  end type transform_job

contains

  !> Replace the values along x by waves.
  !>
  !> `spectrum` (along y, along x): numbers of the `kernel`, or without one those that it holds. The extent along x is
  !> that of `transform_even` of `plan`, `padded` or not. `status`: 0, or with `spectrum` undefined FUGE_ERR_SIZE or
  !> FUGE_ERR_MEMORY.
  subroutine transform_rows(plan, padded, spectrum, status, kernel)
    type(grid_plan), intent(in), target :: plan
    logical, intent(in) :: padded
    real(dp), intent(inout), contiguous, target :: spectrum(:, :)
    integer, intent(out) :: status
    class(kernel_values), intent(in), optional, target :: kernel
    type(transform_job) :: job

    job%plan => plan
    job%padded = padded
    job%spectrum => spectrum
    if (present(kernel)) job%kernel => kernel
    call run(job, status)
  end subroutine transform_rows

  !> As transform_rows, the numbers of `spectrum` along y.
  subroutine transform_columns(plan, padded, spectrum, status)
    type(grid_plan), intent(in), target :: plan
    logical, intent(in) :: padded
    real(dp), intent(inout), contiguous, target :: spectrum(:, :)
    integer, intent(out) :: status
    type(transform_job) :: job

    job%plan => plan
    job%along_x = .false.
    job%padded = padded
    job%spectrum => spectrum
    call run(job, status)
  end subroutine transform_columns

  subroutine run(job, status)
    type(transform_job), intent(inout) :: job
    integer, intent(out) :: status

    allocate (job%status(0:threads_here() - 1), stat=status)
    if (status /= 0) status = FUGE_ERR_MEMORY
    if (status /= 0) return
    call run_in_parts(size(job%status), job)
    status = maxval(job%status)
  end subroutine run

  subroutine do_part(self, part, parts)
    class(transform_job), intent(inout) :: self
    integer, intent(in) :: part, parts

    if (self%along_x) then
      call do_rows(self, part, parts, self%status(part))
    else
      call do_columns(self, part, parts, self%status(part))
    end if
  end subroutine do_part

  subroutine do_rows(job, part, parts, status)
    type(transform_job), intent(inout) :: job
    integer, intent(in) :: part, parts
    integer, intent(out) :: status
    real(dp), allocatable :: table(:, :)
    integer :: begin, block, ends, from, i, rows, stat, to

    status = FUGE_DONE
    rows = size(job%spectrum, 1)
    call share((rows - 1)/LINES + 1, part, parts, from, to)
    if (to < from) return
    allocate (table(size(job%spectrum, 2), LINES), stat=stat)
    do block = from, to
      begin = LINES*block
      ends = min(begin + LINES, rows)
      if (stat == 0) call fill_table(job, begin, rows, table(:, :ends - begin), stat)
      if (stat /= 0) status = FUGE_ERR_MEMORY
      if (status == FUGE_DONE) call job%plan%transform_even(1, job%padded, table(:, :ends - begin), status)
      if (status /= FUGE_DONE) return
      do i = 1, size(table, 1)
        job%spectrum(begin + 1:ends, i) = table(i, :ends - begin)
      end do
    end do
  end subroutine do_rows

  !> The values of the rows from number `begin` on.
  subroutine fill_table(job, begin, rows, table, stat)
    type(transform_job), intent(in) :: job
    integer, intent(in) :: begin, rows
    real(dp), intent(inout), contiguous :: table(:, :)
    integer, intent(out) :: stat
    integer :: i

    stat = 0
    if (associated(job%kernel)) then
      call job%kernel%fill(begin, rows, table, stat)
    else
      do i = 1, size(table, 1)
        table(i, :) = job%spectrum(begin + 1:begin + size(table, 2), i)
      end do
    end if
  end subroutine fill_table

  subroutine do_columns(job, part, parts, status)
    type(transform_job), intent(inout) :: job
    integer, intent(in) :: part, parts
    integer, intent(out) :: status
    integer :: from, to

    status = FUGE_DONE
    call share((size(job%spectrum, 2) - 1)/LINES + 1, part, parts, from, to)
    if (to < from) return
    to = min(LINES*(to + 1), size(job%spectrum, 2))
    call job%plan%transform_even(2, job%padded, job%spectrum(:, LINES*from + 1:to), status)
  end subroutine do_columns

end module fuge_even_spectrum
