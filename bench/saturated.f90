!> Rough surfaces whose pressure has a limit, their hardness: products and times from a few points at the limit to all
!> of them.
!>
!>     saturated DIRECTORY [quick] [write]
!>
!> appends to DIRECTORY/results.csv; `quick` omits fine grids and the last load, `write` writes the problems for Tamaas,
!> whose answers `judge_surfaces` judges. The surfaces are those of heavy_area: mean pressure 0.05 E*, tolerance 1e-8.
program saturated
  use bench_problems, only: whole
  use bench_records, only: bench_row, open_table, write_row
  use bench_surface_judge, only: surface_judge
  use bench_surface_runs, only: new_area_row, run_area
  use bench_surfaces, only: bench_surface, make_surface, write_surface
  use fuge, only: dp => fuge_dp
  implicit none

  !> Cells along a side; those on which other solvers are measured too.
  integer, parameter :: CELLS(3) = [256, 512, 1024], COMPARED = 256
  !> Mean pressures in per cent of the hardness, the last one on the coarsest grid only; those of other solvers.
  integer, parameter :: SHARES(7) = [30, 40, 50, 70, 90, 97, 100], SHARES_COMPARED(3) = [30, 50, 90]
  real(dp), parameter :: TOLERANCE = 1.0e-8_dp

  call run()

contains

  subroutine run()
    character(len=256) :: directory
    character(len=16) :: word
    logical :: quick, writes
    integer :: j, k, table

    call get_command_argument(1, directory)
    if (directory == '') error stop 'usage: saturated DIRECTORY [quick] [write]'
    quick = .false.
    writes = .false.
    do k = 2, command_argument_count()
      call get_command_argument(k, word)
      if (word == 'quick') quick = .true.
      if (word == 'write') writes = .true.
    end do
    call open_table(directory, table)
    do j = 1, size(CELLS)
      if (quick .and. CELLS(j) > COMPARED) exit
      do k = 1, merge(size(SHARES), size(SHARES) - 1, j == 1 .and. .not. quick)
        call solve_surface(directory, SHARES(k), CELLS(j), writes .and. CELLS(j) == COMPARED &
                           .and. any(SHARES_COMPARED == SHARES(k)), table)
      end do
    end do
    close (table)
  end subroutine run

  subroutine solve_surface(directory, share, n, writes, table)
    character(len=*), intent(in) :: directory
    integer, intent(in) :: share, n, table
    logical, intent(in) :: writes
    type(bench_surface) :: surface
    type(surface_judge) :: judge
    type(bench_row) :: row
    real(dp), allocatable :: force(:)

    call make_surface('saturated_'//whole(share), n, surface)
    if (writes) call write_surface(directory, surface)
    row = new_area_row(surface)
    call run_area(surface, TOLERANCE, row, force)
    if (allocated(force)) then
      call judge%prepare(surface, by_waves=.false.)
      call judge%judge(surface, force, row)
      call judge%free()
    end if
    call write_row(table, row)
  end subroutine solve_surface

end program saturated
