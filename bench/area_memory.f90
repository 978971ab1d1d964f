!> Memory of a solve on a large free surface beyond the caller's arrays, in a process that does nothing else.
!>
!>     area_memory DIRECTORY CONTACT N [BYTES]
!>
!> CONTACT is whole, a flat face in full contact, or tenth, a sphere that touches a tenth of the area; N x N cells, to
!> 1e-8. The caller's arrays are the gaps and the forces, gaps and states of the solution. Appends to
!> DIRECTORY/results.csv; n is N*N. Where the machine has less memory left than BYTES for each cell, by default 80, the
!> row says so in place of a solve.
program area_memory
  use bench_memory, only: available, forget_peak, peak_resident, resident
  use bench_records, only: bench_row, open_table, write_row
  use bench_surface_runs, only: new_area_row
  use bench_surfaces, only: bench_surface, make_sphere, set_operator
  use bench_watch, only: stopwatch
  use fuge, only: dp => fuge_dp, fuge_halfspace_operator, fuge_info, fuge_options, fuge_problem, fuge_solution, &
    fuge_solver, FUGE_CENTRE, FUGE_ITERATIVE
  implicit none

  !> Of a solution at a cell: force, gap and state.
  real(dp), parameter :: BYTES_OF_SOLUTION = 20.0_dp
  real(dp), parameter :: PI = acos(-1.0_dp), TOLERANCE = 1.0e-8_dp, BYTES_OF_CELL = 80.0_dp

  call run()

contains

  subroutine run()
    character(len=256) :: directory
    character(len=16) :: contact, word
    type(bench_surface) :: surface
    type(bench_row) :: row
    real(dp) :: bytes, left
    integer :: n, table, stat

    call get_command_argument(1, directory)
    call get_command_argument(2, contact)
    call get_command_argument(3, word)
    read (word, *, iostat=stat) n
    if (stat /= 0 .or. all(contact /= [character(len=16) :: 'whole', 'tenth'])) &
      error stop 'usage: area_memory DIRECTORY whole|tenth N [BYTES]'
    bytes = BYTES_OF_CELL
    call get_command_argument(4, word)
    if (word /= '') read (word, *) bytes
    row%failure = ''
    left = available()
    if (left > 0.0_dp .and. left < bytes*real(n, dp)**2) then
      row%n = n*n
      row%failure = 'more memory than this machine has'
    else
      call make_sphere(n, FUGE_CENTRE, surface, radius=sqrt(0.1_dp/PI))
      if (contact == 'whole') surface%gap = 0.0_dp
      call solve(surface, row)
    end if
    row%problem = 'area_memory'
    row%method = contact
    call open_table(directory, table)
    call write_row(table, row)
    close (table)
  end subroutine run

  !> Everything that is allocated here but the arrays of the caller counts.
  subroutine solve(surface, row)
    type(bench_surface), intent(inout) :: surface
    type(bench_row), intent(out) :: row
    type(fuge_halfspace_operator) :: operator
    type(fuge_problem) :: contact
    type(fuge_solution) :: solution
    type(fuge_solver) :: solver
    type(fuge_info) :: info
    type(stopwatch) :: watch
    real(dp) :: before
    logical :: forgotten

    row = new_area_row(surface)
    call move_alloc(surface%gap, contact%gap)
    contact%resultant = [surface%load]
    call forget_peak(forgotten)
    before = resident()
    call watch%start()
    call set_operator(surface, operator)
    call solver%solve(operator, contact, solution, info, fuge_options(FUGE_ITERATIVE, tolerance=TOLERANCE))
    call watch%stop()
    row%time = watch%best
    row%first = watch%best
    row%tolerance = TOLERANCE
    row%work = info%products
    row%preconditionings = info%preconditionings
    if (info%status /= 0) row%failure = info%message(:len(row%failure))
    if (info%failed()) return
    row%unknowns = info%contacts
    if (.not. forgotten .or. before <= 0.0_dp) return
    row%memory = peak_resident() - before - BYTES_OF_SOLUTION*size(solution%force)
  end subroutine solve

end program area_memory
