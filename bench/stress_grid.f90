!> Times of stresses and displacements below grids of cells, and their errors against points.
!>
!>     stress_grid [SIDE]
!>
!> Half-planes of SIDE**2 cells and half-spaces of SIDE x SIDE (default: 316 at ten depths and 1024 at one), free and
!> periodic. The errors are the largest differences, at some cells, from the sum over all cells of the influence of one,
!> in more digits, relative to the largest value at that depth, and those of the stresses at points, with the time that
!> these take for the compared cells. Fields are set before.
program stress_grid
  use bench_watch, only: stopwatch
  use fuge, only: dp => fuge_dp, fuge_field, fuge_halfplane_field, fuge_halfspace_field, fuge_info, FUGE_CENTRE, &
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
    type(fuge_halfplane_field) :: field, cell
    type(fuge_info) :: info

    call field%set_grid(1.0_dp, force, element, boundary, YOUNG, NU, FUGE_PLANE_STRAIN, info)
    if (.not. info%failed()) call cell%set_grid(1.0_dp, [1.0_dp], element, FUGE_FREE, YOUNG, NU, FUGE_PLANE_STRAIN, &
                                                info)
    if (info%failed()) error stop 'no field'
    call time_field(name, field, cell, size(force), boundary == FUGE_FREE, force, depth)
  end subroutine time_halfplane

  subroutine time_halfspace(name, side, boundary, force, depth)
    character(len=*), intent(in) :: name
    integer, intent(in) :: side, boundary
    real(dp), intent(in) :: force(:), depth(:)
    type(fuge_halfspace_field) :: field, cell
    type(fuge_info) :: info

    call field%set_grid(side, side, 1.0_dp, 1.0_dp, force, boundary, YOUNG, NU, info)
    if (.not. info%failed()) call cell%set_grid(1, 1, 1.0_dp, 1.0_dp, [1.0_dp], FUGE_FREE, YOUNG, NU, info)
    if (info%failed()) error stop 'no field'
    call time_field(name, field, cell, side, boundary == FUGE_FREE, force, depth)
  end subroutine time_halfspace

  !> `cell`: the field below one cell under a unit force; `side`: cells in a row of the grid.
  subroutine time_field(name, field, cell, side, is_free, force, depth)
    character(len=*), intent(in) :: name
    class(fuge_field), intent(in) :: field, cell
    integer, intent(in) :: side
    logical, intent(in) :: is_free
    real(dp), intent(in) :: force(:), depth(:)
    type(fuge_info) :: info
    type(stopwatch) :: stresses, displacements
    real(dp), allocatable :: tensor(:, :, :), u(:, :, :)

    allocate (tensor(6, size(force), size(depth)), u(3, size(force), size(depth)))
    do while (.not. stresses%enough())
      call stresses%start()
      call field%grid_stress(depth, tensor, info)
      call stresses%stop()
      if (info%failed()) error stop 'stresses failed'
      call displacements%start()
      call field%grid_displacement(depth, u, info)
      call displacements%stop()
      if (info%failed()) error stop 'displacements failed'
    end do
    call print_line(name//', stresses', size(force), size(depth), stresses%best)
    if (is_free) call compare(field, cell, side, force, depth, tensor)
    call print_line(name//', displacements', size(force), size(depth), displacements%best)
  end subroutine time_field

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

  subroutine compare(field, cell, side, force, depth, tensor)
    class(fuge_field), intent(in) :: field, cell
    integer, intent(in) :: side
    real(dp), intent(in) :: force(:), depth(:), tensor(:, :, :)
    type(fuge_info) :: info
    type(stopwatch) :: watch
    real(dp), allocatable :: place(:, :), table(:, :)
    real(dp) :: exact(6), points(6, SAMPLES), of_grid, of_points, largest
    integer :: j, k, n

    n = size(force)
    allocate (place(3, n), table(6, n))
    place(1, :) = [(real(modulo(k - 1, side), dp), k=1, n)]
    place(2, :) = [(real((k - 1)/side, dp), k=1, n)]
    of_grid = 0.0_dp
    of_points = 0.0_dp
    do k = 1, size(depth)
      place(3, :) = depth(k)
      call cell%stress(place, table, info)
      call watch%start()
      call field%stress(place(:, sampled_cells(n)), points, info)
      call watch%stop()
      if (info%failed()) error stop 'points failed'
      largest = maxval(abs(tensor(:, :, k)))
      do j = 1, SAMPLES
        exact = sum_of_cells(side, table, force, sampled_cell(n, j))
        of_grid = max(of_grid, maxval(abs(tensor(:, sampled_cell(n, j), k) - exact))/largest)
        of_points = max(of_points, maxval(abs(points(:, j) - exact))/largest)
      end do
    end do
    call print_errors(of_grid, of_points, watch%spent)
  end subroutine compare

  pure function sum_of_cells(side, table, force, cell) result(tensor)
    integer, intent(in) :: side, cell
    real(dp), intent(in) :: table(:, :), force(:)
    real(dp) :: tensor(6)
    real(long) :: total(6)
    integer :: dx, dy, k

    total = 0.0_long
    do k = 1, size(force)
      dx = modulo(cell - 1, side) - modulo(k - 1, side)
      dy = (cell - 1)/side - (k - 1)/side
      total = total + real(force(k), long)*table(:, 1 + abs(dx) + side*abs(dy)) &
              *[1, 1, 1, sign(1, dy), sign(1, dx), sign(1, dx)*sign(1, dy)]
    end do
    tensor = real(total, dp)
  end function sum_of_cells

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
