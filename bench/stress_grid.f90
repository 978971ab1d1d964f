!> Times of stresses and displacements below grids of cells, and their errors against points.
!>
!>     stress_grid [SIDE]
!>
!> Half-planes of SIDE**2 cells and half-spaces of SIDE x SIDE (default: 316 at ten depths and 1024 at one), free and
!> periodic. The error is the largest difference from the procedures for points at some cells, relative to the largest
!> value at their depth; the points sum all cells, so that it is theirs, too.
program stress_grid
  use bench_watch, only: stopwatch
  use fuge, only: dp => fuge_dp, fuge_halfplane_displacement_grid, fuge_halfplane_stress, fuge_halfplane_stress_grid, &
    fuge_halfspace_displacement_grid, fuge_halfspace_stress, fuge_halfspace_stress_grid, fuge_info, FUGE_CENTRE, &
    FUGE_FREE, FUGE_HAT, FUGE_PERIODIC, FUGE_PLANE_STRAIN
  implicit none

  real(dp), parameter :: NU = 0.3_dp, YOUNG = 1.0_dp
  !> Cells at which points are compared.
  integer, parameter :: SAMPLES = 16

  call run()

contains

  subroutine run()
    character(len=32) :: word
    integer :: side, stat

    print '(a)', '                            cells  depths   seconds   error'
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
    if (boundary == FUGE_FREE) then
      call print_line(name//', stresses', size(force), size(depth), stresses%best, &
                      halfplane_error(element, force, depth, stress))
    else
      call print_line(name//', stresses', size(force), size(depth), stresses%best)
    end if
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
      call fuge_halfspace_displacement_grid(side, side, 1.0_dp, 1.0_dp, force, boundary, YOUNG, NU, depth, displacement, &
                                            info)
      call displacements%stop()
      if (info%failed()) error stop 'displacements failed'
    end do
    if (boundary == FUGE_FREE) then
      call print_line(name//', stresses', size(force), size(depth), stresses%best, &
                      halfspace_error(side, force, depth, stress))
    else
      call print_line(name//', stresses', size(force), size(depth), stresses%best)
    end if
    call print_line(name//', displacements', size(force), size(depth), displacements%best)
  end subroutine time_halfspace

  subroutine print_line(name, cells, depths, seconds, error)
    character(len=*), intent(in) :: name
    integer, intent(in) :: cells, depths
    real(dp), intent(in) :: seconds
    real(dp), intent(in), optional :: error
    character(len=44) :: label

    label = name
    if (present(error)) then
      print '(a44, i8, i4, f9.3, es9.1)', label, cells, depths, seconds, error
    else
      print '(a44, i8, i4, f9.3)', label, cells, depths, seconds
    end if
  end subroutine print_line

  function halfplane_error(element, force, depth, stress) result(error)
    integer, intent(in) :: element
    real(dp), intent(in) :: force(:), depth(:), stress(:, :, :)
    real(dp) :: error
    type(fuge_info) :: info
    real(dp) :: expected(3, SAMPLES)
    real(dp), allocatable :: x(:), width(:)
    integer :: cell(SAMPLES), k

    allocate (x(size(force)), width(size(force)))
    x = [(real(k, dp), k=1, size(force))]
    width = 1.0_dp
    cell = sampled_cells(size(force))
    error = 0.0_dp
    do k = 1, size(depth)
      call fuge_halfplane_stress(x, width, force, element, x(cell), spread(depth(k), 1, SAMPLES), expected, info, .false.)
      if (info%failed()) error stop 'points failed'
      error = max(error, maxval(abs(stress(:, cell, k) - expected))/maxval(abs(stress(:, :, k))))
    end do
  end function halfplane_error

  function halfspace_error(side, force, depth, stress) result(error)
    integer, intent(in) :: side
    real(dp), intent(in) :: force(:), depth(:), stress(:, :, :)
    real(dp) :: error
    type(fuge_info) :: info
    real(dp) :: expected(6, SAMPLES)
    real(dp), allocatable :: x(:), y(:), width(:)
    integer :: cell(SAMPLES), k

    allocate (x(size(force)), y(size(force)), width(size(force)))
    x = [(real(modulo(k - 1, side), dp), k=1, size(force))]
    y = [(real((k - 1)/side, dp), k=1, size(force))]
    width = 1.0_dp
    cell = sampled_cells(size(force))
    error = 0.0_dp
    do k = 1, size(depth)
      call fuge_halfspace_stress(x, y, width, width, force, NU, x(cell), y(cell), spread(depth(k), 1, SAMPLES), expected, &
                                 info, .false., .false.)
      if (info%failed()) error stop 'points failed'
      error = max(error, maxval(abs(stress(:, cell, k) - expected))/maxval(abs(stress(:, :, k))))
    end do
  end function halfspace_error

  function sampled_cells(n) result(cell)
    integer, intent(in) :: n
    integer :: cell(SAMPLES), k

    cell = [(1 + int(real(n - 1, dp)*real(k - 1, dp)/real(SAMPLES - 1, dp)), k=1, SAMPLES)]
  end function sampled_cells

end program stress_grid
