!> Times of stresses and displacements below grids of cells, and their errors against points.
!>
!>     stress_grid [SIDE]
!>
!> Half-planes of SIDE**2 cells and half-spaces of SIDE x SIDE (default: 316 at ten depths and 1024 at one), free and
!> periodic. The errors are the largest differences, at some cells, from the sum over all cells of the influence of one,
!> in more digits, relative to the largest value at that depth, and those of the procedures for points, with the time
!> they take for the compared cells.
program stress_grid
  use bench_watch, only: stopwatch
  use fuge, only: dp => fuge_dp, fuge_halfplane_displacement_grid, fuge_halfplane_stress, fuge_halfplane_stress_grid, &
    fuge_halfspace_displacement_grid, fuge_halfspace_stress, fuge_halfspace_stress_grid, fuge_info, FUGE_CENTRE, &
    FUGE_FREE, FUGE_HAT, FUGE_PERIODIC, FUGE_PERIODIC_X, FUGE_PLANE_STRAIN
  implicit none

  !> More digits, where the compiler has them.
  integer, parameter :: long = max(dp, selected_real_kind(18))
  real(dp), parameter :: NU = 0.3_dp, YOUNG = 1.0_dp
  !> Cells at which points are compared.
  integer, parameter :: SAMPLES = 16

  call run()

contains

  subroutine run()
    character(len=32) :: word
    integer :: side, stat

    print '(42x, a)', '   cells depths  seconds'
    call get_command_argument(1, word, status=stat)
    if (stat == 0) then
      read (word, *, iostat=stat) side
      if (stat /= 0) error stop 'usage: stress_grid [SIDE]'
      call time_all(side, 1)
    else
      call time_all(316, 10)
      call time_all(1024, 1)
    end if
  end subroutine run

  subroutine time_all(side, depths)
    integer, intent(in) :: side, depths
    real(dp), allocatable :: force(:)
    real(dp) :: depth(depths)
    integer :: k

    allocate (force(side**2))
    call random_number(force)
    where (force < 0.5_dp) force = 0.0_dp
    depth = [(0.5_dp*2.0_dp**(k - 1), k=1, depths)]
    call time_halfplane('half-plane strips, free', FUGE_CENTRE, FUGE_FREE, force, depth)
    call time_halfplane('half-plane hats, free', FUGE_HAT, FUGE_FREE, force, depth)
    call time_halfplane('half-plane strips, periodic', FUGE_CENTRE, FUGE_PERIODIC, force, depth)
    call time_halfplane('half-plane hats, periodic', FUGE_HAT, FUGE_PERIODIC, force, depth)
    call time_halfspace('half-space, free', side, FUGE_FREE, force, depth)
    call time_halfspace('half-space, periodic', side, FUGE_PERIODIC, force, depth)
    call time_halfspace('half-space, periodic along x', side, FUGE_PERIODIC_X, force, depth)
  end subroutine time_all

  subroutine time_halfplane(name, element, boundary, force, depth)
    character(len=*), intent(in) :: name
    integer, intent(in) :: element, boundary
    real(dp), intent(in) :: force(:), depth(:)
    type(fuge_info) :: info
    type(stopwatch) :: stresses, displacements
    real(dp), allocatable :: stress(:, :, :), displacement(:, :, :)

    allocate (stress(3, size(force), size(depth)), displacement(2, size(force), size(depth)))
    do while (.not. stresses%enough())
      call stresses%start()
      call fuge_halfplane_stress_grid(1.0_dp, force, element, boundary, depth, stress, info)
      call stresses%stop()
      if (info%failed()) error stop 'stresses failed'
      call displacements%start()
      call fuge_halfplane_displacement_grid(1.0_dp, force, element, boundary, YOUNG, NU, FUGE_PLANE_STRAIN, depth, &
                                            displacement, info)
      call displacements%stop()
      if (info%failed()) error stop 'displacements failed'
    end do
    call print_line(name//', stresses', size(force), size(depth), stresses%best)
    if (boundary == FUGE_FREE) call compare_halfplane(element, force, depth, stress)
    call print_line(name//', displacements', size(force), size(depth), displacements%best)
  end subroutine time_halfplane

  subroutine time_halfspace(name, side, boundary, force, depth)
    character(len=*), intent(in) :: name
    integer, intent(in) :: side, boundary
    real(dp), intent(in) :: force(:), depth(:)
    type(fuge_info) :: info
    type(stopwatch) :: stresses, displacements
    real(dp), allocatable :: stress(:, :, :), displacement(:, :, :)

    allocate (stress(6, size(force), size(depth)), displacement(3, size(force), size(depth)))
    do while (.not. stresses%enough())
      call stresses%start()
      call fuge_halfspace_stress_grid(side, side, 1.0_dp, 1.0_dp, force, boundary, NU, depth, stress, info)
      call stresses%stop()
      if (info%failed()) error stop 'stresses failed'
      call displacements%start()
      call fuge_halfspace_displacement_grid(side, side, 1.0_dp, 1.0_dp, force, boundary, YOUNG, NU, depth, &
                                            displacement, info)
      call displacements%stop()
      if (info%failed()) error stop 'displacements failed'
    end do
    call print_line(name//', stresses', size(force), size(depth), stresses%best)
    if (boundary == FUGE_FREE) call compare_halfspace(side, force, depth, stress)
    call print_line(name//', displacements', size(force), size(depth), displacements%best)
  end subroutine time_halfspace

  subroutine print_line(name, cells, depths, seconds)
    character(len=*), intent(in) :: name
    integer, intent(in) :: cells, depths
    real(dp), intent(in) :: seconds
    character(len=42) :: label

    label = name
    print '(a42, i9, i4, f9.3)', label, cells, depths, seconds
  end subroutine print_line

  subroutine print_errors(of_grid, of_points, seconds)
    real(dp), intent(in) :: of_grid, of_points, seconds
    character(len=42) :: label

    label = '  errors: grid, points; time of the points'
    print '(a42, 2es9.1, f9.3)', label, of_grid, of_points, seconds
  end subroutine print_errors

  subroutine compare_halfplane(element, force, depth, stress)
    integer, intent(in) :: element
    real(dp), intent(in) :: force(:), depth(:), stress(:, :, :)
    type(fuge_info) :: info
    type(stopwatch) :: watch
    real(dp), allocatable :: x(:), width(:), table(:, :), level(:), points(:, :)
    real(dp) :: exact(3), of_grid, of_points, largest
    integer :: cell, j, k, n

    n = size(force)
    allocate (x(n), width(n), table(3, n), level(n), points(3, SAMPLES))
    x = [(real(k - 1, dp), k=1, n)]
    width = 1.0_dp
    of_grid = 0.0_dp
    of_points = 0.0_dp
    do k = 1, size(depth)
      level = depth(k)
      call fuge_halfplane_stress([0.0_dp], [1.0_dp], [1.0_dp], element, x, level, table, info, .false.)
      call watch%start()
      call fuge_halfplane_stress(x, width, force, element, x(sampled_cells(n)), level(:SAMPLES), points, info, .false.)
      call watch%stop()
      if (info%failed()) error stop 'points failed'
      largest = maxval(abs(stress(:, :, k)))
      do j = 1, SAMPLES
        cell = sampled_cell(n, j)
        exact = halfplane_sum(table, force, cell)
        of_grid = max(of_grid, maxval(abs(stress(:, cell, k) - exact))/largest)
        of_points = max(of_points, maxval(abs(points(:, j) - exact))/largest)
      end do
    end do
    call print_errors(of_grid, of_points, watch%spent)
  end subroutine compare_halfplane

  pure function halfplane_sum(table, force, cell) result(stress)
    real(dp), intent(in) :: table(:, :), force(:)
    integer, intent(in) :: cell
    real(dp) :: stress(3)
    real(long) :: total(3)
    integer :: k

    total = 0.0_long
    do k = 1, size(force)
      total = total + real(force(k), long)*table(:, abs(cell - k) + 1)*[1, 1, sign(1, cell - k)]
    end do
    stress = real(total, dp)
  end function halfplane_sum

  subroutine compare_halfspace(side, force, depth, stress)
    integer, intent(in) :: side
    real(dp), intent(in) :: force(:), depth(:), stress(:, :, :)
    type(fuge_info) :: info
    type(stopwatch) :: watch
    real(dp), allocatable :: x(:), y(:), width(:), table(:, :), level(:), points(:, :)
    real(dp) :: exact(6), of_grid, of_points, largest
    integer :: cell, j, k, n

    n = size(force)
    allocate (x(n), y(n), width(n), table(6, n), level(n), points(6, SAMPLES))
    x = [(real(modulo(k - 1, side), dp), k=1, n)]
    y = [(real((k - 1)/side, dp), k=1, n)]
    width = 1.0_dp
    of_grid = 0.0_dp
    of_points = 0.0_dp
    do k = 1, size(depth)
      level = depth(k)
      call fuge_halfspace_stress([0.0_dp], [0.0_dp], [1.0_dp], [1.0_dp], [1.0_dp], NU, x, y, level, table, info, &
                                 .false., .false.)
      call watch%start()
      call fuge_halfspace_stress(x, y, width, width, force, NU, x(sampled_cells(n)), y(sampled_cells(n)), &
                                 level(:SAMPLES), points, info, .false., .false.)
      call watch%stop()
      if (info%failed()) error stop 'points failed'
      largest = maxval(abs(stress(:, :, k)))
      do j = 1, SAMPLES
        cell = sampled_cell(n, j)
        exact = halfspace_sum(side, table, force, cell)
        of_grid = max(of_grid, maxval(abs(stress(:, cell, k) - exact))/largest)
        of_points = max(of_points, maxval(abs(points(:, j) - exact))/largest)
      end do
    end do
    call print_errors(of_grid, of_points, watch%spent)
  end subroutine compare_halfspace

  pure function halfspace_sum(side, table, force, cell) result(stress)
    integer, intent(in) :: side, cell
    real(dp), intent(in) :: table(:, :), force(:)
    real(dp) :: stress(6)
    real(long) :: total(6)
    integer :: dx, dy, k

    total = 0.0_long
    do k = 1, size(force)
      dx = modulo(cell - 1, side) - modulo(k - 1, side)
      dy = (cell - 1)/side - (k - 1)/side
      total = total + real(force(k), long)*table(:, 1 + abs(dx) + side*abs(dy)) &
              *[1, 1, 1, sign(1, dy), sign(1, dx), sign(1, dx)*sign(1, dy)]
    end do
    stress = real(total, dp)
  end function halfspace_sum

  pure function sampled_cell(n, sample) result(cell)
    integer, intent(in) :: n, sample
    integer :: cell

    cell = 1 + int(real(n - 1, dp)*real(sample - 1, dp)/real(SAMPLES - 1, dp))
  end function sampled_cell

  pure function sampled_cells(n) result(cells)
    integer, intent(in) :: n
    integer :: cells(SAMPLES), k

    cells = [(sampled_cell(n, k), k=1, SAMPLES)]
  end function sampled_cells

end program stress_grid
