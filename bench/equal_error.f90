!> Time over the error of the pressure against the solution of the same grid: fuge, and references for other codes.
!>
!>     equal_error DIRECTORY N [write]
!>
!> appends a row for each tolerance to DIRECTORY/results.csv; error_solver is the fraction of the load in the wrong
!> place. N x N cells. `write` writes the surfaces for other codes, with NAME_N.reference, the forces to which theirs
!> are compared, 8 bytes each: on a periodic surface those of waves, as the others count them.
program equal_error
  use bench_problems, only: whole
  use bench_records, only: bench_row, open_table, write_row
  use bench_surface_runs, only: new_area_row, run_area
  use bench_surfaces, only: bench_surface, make_surface, write_surface
  use bench_wave_operator, only: wave_operator
  use fuge, only: dp => fuge_dp, fuge_info, fuge_options, fuge_solution, fuge_solver, FUGE_ITERATIVE, FUGE_PERIODIC
  implicit none

  character(len=10), parameter :: NAMES(3) = [character(len=10) :: 'sphere', 'light_area', 'heavy_area']
  !> Tolerances from 0.3 to 1e-8, two in a decade; then that of the reference.
  integer, parameter :: TOLERANCES = 16
  real(dp), parameter :: OF_REFERENCE = 1.0e-12_dp

  call run()

contains

  subroutine run()
    character(len=256) :: directory
    character(len=8) :: word
    type(bench_surface) :: surface
    logical :: writes
    integer :: k, n, stat, table

    call get_command_argument(1, directory)
    call get_command_argument(2, word)
    read (word, *, iostat=stat) n
    if (stat /= 0) error stop 'usage: equal_error DIRECTORY N [write]'
    call get_command_argument(3, word)
    writes = word == 'write'
    call open_table(directory, table)
    do k = 1, size(NAMES)
      call make_surface(trim(NAMES(k)), n, surface)
      call solve_to_tolerances(surface, table, trim(directory), writes)
    end do
    close (table)
  end subroutine run

  subroutine solve_to_tolerances(surface, table, directory, writes)
    type(bench_surface), intent(in) :: surface
    integer, intent(in) :: table
    character(len=*), intent(in) :: directory
    logical, intent(in) :: writes
    type(bench_row) :: row
    real(dp), allocatable :: force(:), reference(:)
    integer :: k

    row = new_area_row(surface)
    call run_area(surface, OF_REFERENCE, row, reference)
    if (.not. allocated(reference)) error stop 'no reference'
    do k = 0, TOLERANCES - 1
      row = new_area_row(surface)
      call run_area(surface, 10.0_dp**(-k/2)*merge(0.3_dp, 0.1_dp, mod(k, 2) == 0), row, force)
      if (allocated(force)) row%error_solver = sum(abs(force - reference))/surface%load
      call write_row(table, row)
    end do
    if (.not. writes) return
    call write_surface(directory, surface)
    if (surface%boundary == FUGE_PERIODIC) call solve_by_waves(surface, reference)
    call write_forces(directory//'/'//trim(surface%name)//'_'//whole(surface%n)//'.reference', reference)
  end subroutine solve_to_tolerances

  !> The solution for codes that count waves.
  subroutine solve_by_waves(surface, force)
    type(bench_surface), intent(in) :: surface
    real(dp), intent(inout) :: force(:)
    type(wave_operator) :: waves
    type(fuge_solver) :: solver
    type(fuge_solution) :: solution
    type(fuge_info) :: info

    call waves%prepare(surface)
    call solver%solve(waves, surface%contact(), solution, info, fuge_options(FUGE_ITERATIVE, tolerance=OF_REFERENCE))
    if (info%failed()) error stop 'no reference by waves'
    force = solution%force
    call waves%free()
  end subroutine solve_by_waves

  subroutine write_forces(path, force)
    character(len=*), intent(in) :: path
    real(dp), intent(in) :: force(:)
    integer :: unit

    open (newunit=unit, file=path, access='stream', form='unformatted', status='replace', action='write')
    write (unit) force
    close (unit)
  end subroutine write_forces

end program equal_error
