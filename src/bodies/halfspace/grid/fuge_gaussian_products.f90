!> Tables that are sums of products of Gaussians along two directions. Threads share them; no result depends on how many
!> there are.
module fuge_gaussian_products
  use fuge_gaussian_cells, only: fill_gaussian_sums, fill_shares
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgemm
  use fuge_threads, only: run_in_parts, share, threads_here, work_in_parts
  implicit none
  private

  public :: fill_distances, fill_waves, multiply

  !> Columns of a table that are multiplied together.
  integer, parameter :: COLUMNS = 64

  !> The columns of `sums`, one for each of the lengths `t`: of the waves `mu`, or without waves of distances.
  type, extends(work_in_parts) :: sums_job
    real(dp), pointer, contiguous :: t(:) => null(), mu(:) => null(), sums(:, :) => null()
    integer :: power = 1
  contains
    procedure :: do_part => fill_columns
  end type sums_job

  type, extends(work_in_parts) :: product_job
    real(dp), pointer, contiguous :: along_y(:, :) => null(), along_x(:, :) => null(), table(:, :) => null()
  contains
    procedure :: do_part => multiply_columns
  end type product_job

contains

  !> `sums` (size of mu, size of t): `fill_gaussian_sums` for each `t`.
  subroutine fill_waves(mu, t, power, sums)
    real(dp), intent(in), contiguous, target :: mu(:), t(:)
    integer, intent(in) :: power
    real(dp), intent(inout), contiguous, target :: sums(:, :)
    type(sums_job) :: job

    job%mu => mu
    job%t => t
    job%power = power
    job%sums => sums
    call run_in_parts(threads_here(), job)
  end subroutine fill_waves

  !> `shares` (0:m, size of t): `fill_shares` for each `t`.
  subroutine fill_distances(t, power, shares)
    real(dp), intent(in), contiguous, target :: t(:)
    integer, intent(in) :: power
    real(dp), intent(inout), contiguous, target :: shares(:, :)
    type(sums_job) :: job

    job%t => t
    job%power = power
    job%sums => shares
    call run_in_parts(threads_here(), job)
  end subroutine fill_distances

  subroutine fill_columns(self, part, parts)
    class(sums_job), intent(inout) :: self
    integer, intent(in) :: part, parts
    integer :: k

    ! Neighbours take about the same time.
    do k = part + 1, size(self%t), parts
      if (associated(self%mu)) then
        call fill_gaussian_sums(self%mu, self%t(k), self%power, self%sums(:, k))
      else
        call fill_shares(self%t(k), self%power, self%sums(:, k))
      end if
    end do
  end subroutine fill_columns

  !> `table` (rows of along_y, rows of along_x) = `along_y` diag(`weight`) transpose(`along_x`); `along_y` is undefined
  !> on return.
  subroutine multiply(along_y, weight, along_x, table)
    real(dp), intent(inout), contiguous, target :: along_y(:, :)
    real(dp), intent(in), contiguous :: weight(:)
    real(dp), intent(in), contiguous, target :: along_x(:, :)
    real(dp), intent(inout), contiguous, target :: table(:, :)
    type(product_job) :: job
    integer :: k

    if (size(table) < 1) return
    do k = 1, size(weight)
      along_y(:, k) = weight(k)*along_y(:, k)
    end do
    job%along_y => along_y
    job%along_x => along_x
    job%table => table
    call run_in_parts(threads_here(), job)
  end subroutine multiply

  subroutine multiply_columns(self, part, parts)
    class(product_job), intent(inout) :: self
    integer, intent(in) :: part, parts
    integer :: block, first, from, to

    call share((size(self%table, 2) - 1)/COLUMNS + 1, part, parts, from, to)
    do block = from, to
      first = COLUMNS*block + 1
      call multiply_block(size(self%table, 1), size(self%table, 2), size(self%along_y, 2), first, self%along_y, &
                          self%along_x, self%table)
    end do
  end subroutine multiply_columns

  !> The columns of the table from number `first` on, at most COLUMNS of their `number`.
  subroutine multiply_block(rows, number, lengths, first, along_y, along_x, table)
    integer, intent(in) :: rows, number, lengths, first
    real(dp), intent(in) :: along_y(rows, lengths), along_x(number, lengths)
    real(dp), intent(inout) :: table(rows, number)

    call dgemm('N', 'T', rows, min(COLUMNS, number - first + 1), lengths, 1.0_dp, along_y, rows, along_x(first, 1), &
               number, 0.0_dp, table(1, first), rows)
  end subroutine multiply_block

end module fuge_gaussian_products
