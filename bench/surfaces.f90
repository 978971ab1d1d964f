!> Areas of contact: spheres against Hertz and rough periodic surfaces.
!>
!>     surfaces DIRECTORY [quick] [write]
!>
!> appends to DIRECTORY/results.csv; `quick` omits fine grids, `write` writes the problems for other solvers, which
!> `judge_surfaces` judges. Large ones are also solved by two threads, in elapsed time.
program surfaces
  use bench_surface_judge, only: surface_judge
  use bench_surfaces, only: bench_surface, make_sphere, make_surface, write_surface
  use bench_surface_runs, only: new_area_row, run_area
  use bench_records, only: bench_row, open_table, write_row
  use fuge, only: dp => fuge_dp, FUGE_CENTRE, FUGE_MEAN
  implicit none

  !> Cells along a side.
  integer, parameter :: COARSEST = 64, FINEST = 2048, FINEST_QUICK = 256
  integer, parameter :: PICTURE = 512, LARGE(2) = [1024, 2048], PICTURE_QUICK = 256
  !> From how many cells along a side two threads solve too.
  integer, parameter :: THREADED = 256
  !> Number of grids for the orders: the edge is anywhere in a cell.
  integer, parameter :: GRIDS = 24, GRIDS_QUICK = 8
  real(dp), parameter :: FEWEST = 24.0_dp, MOST = 600.0_dp, MOST_QUICK = 200.0_dp
  !> Tolerances of the sphere, of large rough surfaces, of the picture, and of the orders, where the errors of the
  !> solve have to be far below those of the grid.
  real(dp), parameter :: OF_SPHERE = 1.0e-10_dp, OF_ROUGH = 1.0e-8_dp, OF_ORDERS = 1.0e-12_dp
  real(dp), parameter :: TOLERANCES(5) = [1.0e-4_dp, 1.0e-6_dp, 1.0e-8_dp, 1.0e-10_dp, 1.0e-12_dp]
  character(len=10), parameter :: ROUGH(2) = ['light_area', 'heavy_area']

  !> The options of the command line, and the unit of the table.
  type :: settings
    character(len=256) :: directory = ''
    integer :: table = 0
    logical :: quick = .false., writes = .false.
  end type settings

  call run()

contains

  subroutine run()
    type(settings) :: chosen
    character(len=16) :: word
    integer :: k

    call get_command_argument(1, chosen%directory)
    if (chosen%directory == '') error stop 'usage: surfaces DIRECTORY [quick] [write]'
    do k = 2, command_argument_count()
      call get_command_argument(k, word)
      if (word == 'quick') chosen%quick = .true.
      if (word == 'write') chosen%writes = .true.
    end do
    call open_table(chosen%directory, chosen%table)
    call run_spheres(chosen)
    do k = 1, size(ROUGH)
      call run_rough(ROUGH(k), chosen)
    end do
    call run_orders(FUGE_CENTRE, chosen)
    call run_orders(FUGE_MEAN, chosen)
    close (chosen%table)
  end subroutine run

  subroutine run_spheres(chosen)
    type(settings), intent(in) :: chosen
    integer :: n

    n = COARSEST
    do while (n <= merge(FINEST_QUICK, FINEST, chosen%quick))
      call solve_surface('sphere', n, [OF_SPHERE], chosen)
      n = 2*n
    end do
  end subroutine run_spheres

  subroutine run_rough(name, chosen)
    character(len=*), intent(in) :: name
    type(settings), intent(in) :: chosen
    integer :: k

    call solve_surface(name, merge(PICTURE_QUICK, PICTURE, chosen%quick), TOLERANCES, chosen)
    if (chosen%quick) return
    do k = 1, size(LARGE)
      call solve_surface(name, LARGE(k), [OF_ROUGH], chosen)
    end do
  end subroutine run_rough

  subroutine solve_surface(name, n, tolerances, chosen)
    character(len=*), intent(in) :: name
    integer, intent(in) :: n
    real(dp), intent(in) :: tolerances(:)
    type(settings), intent(in) :: chosen
    type(bench_surface) :: surface
    type(surface_judge) :: judge
    integer :: k

    call make_surface(name, n, surface)
    if (chosen%writes) call write_surface(chosen%directory, surface)
    call judge%prepare(surface, by_waves=.false.)
    do k = 1, size(tolerances)
      call solve_and_judge(surface, tolerances(k), judge, 'iterative_fft', chosen%table)
    end do
    if (n >= THREADED) call solve_and_judge(surface, merge(OF_SPHERE, OF_ROUGH, name == 'sphere'), judge, &
                                            'iterative_fft_2', chosen%table, threads=2)
    call judge%free()
  end subroutine solve_surface

  subroutine solve_and_judge(surface, tolerance, judge, method, table, threads)
    type(bench_surface), intent(in) :: surface
    real(dp), intent(in) :: tolerance
    type(surface_judge), intent(inout) :: judge
    character(len=*), intent(in) :: method
    integer, intent(in) :: table
    integer, intent(in), optional :: threads
    type(bench_row) :: row
    real(dp), allocatable :: force(:)

    row = new_area_row(surface)
    row%method = method
    call run_area(surface, tolerance, row, force, threads)
    if (allocated(force)) call judge%judge(surface, force, row)
    call write_row(table, row)
  end subroutine solve_and_judge

  subroutine run_orders(element, chosen)
    integer, intent(in) :: element
    type(settings), intent(in) :: chosen
    type(bench_surface) :: surface
    type(surface_judge) :: judge
    real(dp) :: last
    integer :: k, grids_used

    last = merge(MOST_QUICK, MOST, chosen%quick)
    grids_used = merge(GRIDS_QUICK, GRIDS, chosen%quick)
    do k = 0, grids_used - 1
      call make_sphere(nint(FEWEST*(last/FEWEST)**(real(k, dp)/real(grids_used - 1, dp))), element, surface)
      call judge%prepare(surface, by_waves=.false.)
      call solve_and_judge(surface, OF_ORDERS, judge, 'order', chosen%table)
    end do
    call judge%free()
  end subroutine run_orders

end program surfaces
