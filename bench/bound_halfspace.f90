!> Time of one influence coefficient of the half-space, against the least that any method needs: one square root and
!> one division, 1/sqrt(x**2 + y**2), for each.
!>
!> Prints rows | problem | bound | fuge | ratio | wanted | to standard output, times in nanoseconds. Both sides
!> alternate and the least time of each counts, because other programs may run.
program bound_halfspace
  use fuge, only: dp => fuge_dp, fuge_halfspace_matrix, fuge_info, FUGE_CENTRE, FUGE_MEAN
  use fuge_halfspace_table, only: fill_halfspace_table
  implicit none

  integer, parameter :: REPETITIONS = 7

  call measure_table('grid 1024 x 1024, centre', 1024, 1024, [1.0_dp, 1.0_dp], FUGE_CENTRE)
  call measure_table('grid 1024 x 1024, mean', 1024, 1024, [1.0_dp, 1.0_dp], FUGE_MEAN)
  call measure_table('grid 16384 x 64, cells 1 : 100, mean', 16384, 64, [0.01_dp, 1.0_dp], FUGE_MEAN)
  call measure_matrix('matrix, 40 x 40 cells of one grid', 40, 0.0_dp, 0.0_dp)
  call measure_matrix('matrix, 40 x 40 equal rectangles in no grid', 40, 0.1_dp, 0.0_dp)
  call measure_matrix('matrix, 40 x 40 different rectangles', 40, 0.1_dp, 0.2_dp)

contains

  subroutine measure_table(name, columns, rows, spacing, element)
    character(len=*), intent(in) :: name
    integer, intent(in) :: columns, rows, element
    real(dp), intent(in) :: spacing(2)
    real(dp), allocatable :: table(:, :), other(:, :)
    real(dp) :: start, bound, time
    integer :: k, stat

    allocate (table(0:columns - 1, 0:rows - 1), other(0:columns - 1, 0:rows - 1))
    bound = huge(bound)
    time = huge(time)
    do k = 1, REPETITIONS
      start = seconds()
      call inverse_distances(spacing, other)
      bound = min(bound, seconds() - start)
      start = seconds()
      call fill_halfspace_table(spacing, 1.0_dp, element, table, stat)
      time = min(time, seconds() - start)
    end do
    call write_row(name, bound, time, real(size(table), dp), stat + merge(0, 1, all(table < 2.0_dp*other + 10.0_dp)))
  end subroutine measure_table

  !> n x n cells, moved by up to `scatter` and narrower by up to `variation` of their widths.
  subroutine measure_matrix(name, n, scatter, variation)
    character(len=*), intent(in) :: name
    integer, intent(in) :: n
    real(dp), intent(in) :: scatter, variation
    real(dp), allocatable :: x(:), y(:), width(:), alpha(:, :), other(:, :)
    real(dp) :: start, bound, time
    type(fuge_info) :: info
    integer :: i, j, k

    allocate (alpha(n*n, n*n), other(n*n, n*n))
    x = [((real(i, dp) + scatter*sin(real(i + n*j, dp)), i=1, n), j=1, n)]
    y = [((real(j, dp) + scatter*cos(real(3*i + j, dp)), i=1, n), j=1, n)]
    width = [(1.0_dp - 2.0_dp*scatter - variation*real(mod(7*k, n), dp)/n, k=1, n*n)]
    bound = huge(bound)
    time = huge(time)
    do k = 1, REPETITIONS
      start = seconds()
      do j = 1, n*n
        other(j, j) = 1.0_dp
        other(j + 1:, j) = 1.0_dp/sqrt((x(j + 1:) - x(j))**2 + (y(j + 1:) - y(j))**2)
      end do
      bound = min(bound, seconds() - start)
      start = seconds()
      call fuge_halfspace_matrix(x, y, width, width, 1.0_dp, FUGE_MEAN, alpha, info)
      time = min(time, seconds() - start)
    end do
    call write_row(name, bound, time, 0.5_dp*real(n, dp)**4, info%status + merge(0, 1, other(n, 1) < 1.0_dp))
  end subroutine measure_matrix

  subroutine inverse_distances(spacing, table)
    real(dp), intent(in) :: spacing(2)
    real(dp), intent(out) :: table(0:, 0:)
    integer :: i, j

    do j = 0, ubound(table, 2)
      do i = 0, ubound(table, 1)
        table(i, j) = 1.0_dp/sqrt((i*spacing(1))**2 + (j*spacing(2))**2 + 1.0e-30_dp)
      end do
    end do
  end subroutine inverse_distances

  !> CPU time.
  function seconds() result(time)
    real(dp) :: time

    call cpu_time(time)
  end function seconds

  subroutine write_row(name, bound, time, coefficients, status)
    character(len=*), intent(in) :: name
    real(dp), intent(in) :: bound, time, coefficients
    integer, intent(in) :: status

    if (status /= 0) error stop 'no coefficients'
    print '(3a,f7.1,a,f8.1,a,f6.1,a)', '| ', name, ' |', 1.0e9_dp*bound/coefficients, ' ns |', &
      1.0e9_dp*time/coefficients, ' ns |', time/bound, ' | - |'
  end subroutine write_row

end program bound_halfspace
