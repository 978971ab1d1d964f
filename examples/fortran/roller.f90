!> A roller of finite length on a plane: the pressure at its ends, and the profile that removes it.
!>
!>     roller [cells [folder for its tables]]
!>
!> Steel on steel, radius 10 mm, length 20 mm, 10 kN. The contact is long and narrow, so the grid has `cells` cells
!> along the axis, a multiple of 64 and 1024 unless given, and 96 much narrower ones across. Profiles along the axis y,
!> |y| <= a = L/2: straight; a circular crown; and the logarithm
!>
!>     z = w/(pi E*) ln(1/(1 - (1 - 0.3033 b/a) (y/a)**2)),    w = F/L,
!>
!> for which the pressure of a long roller, half width b, is nearly the same all along the roller (G. Lundberg 1939);
!> the term with b makes the drop at the very ends finite (K. L. Johnson, R. Gohar 1981): there half of the roller is
!> missing, and 0.3033 = exp(-1/2)/2 comes from the mean of ln|x| over the elliptic pressure. The formula looks at
!> displacements on the axis only. Near the ends, where the contact is narrower, the pressure is still an eighth too
!> high under the load F for which the profile is made; made for 1.2 F, it carries F without any such place.
!> Under a straight roller the pressure at the ends is singular: on half as wide cells it is 1.4 times as high.
!> For the picture it writes roller_axis.csv and roller_map_1.dat to roller_map_4.dat.
program roller
  use example_output, only: create_file
  use example_verdict, only: verdict
  use fuge, only: dp => fuge_dp, fuge_halfspace_operator, fuge_info, fuge_problem, fuge_solution, fuge_solver, &
    FUGE_FREE, FUGE_MEAN
  implicit none

  real(dp), parameter :: PI = acos(-1.0_dp)
  !> N, mm.
  real(dp), parameter :: E_STAR = 1.15e5_dp, RADIUS = 10.0_dp, LENGTH = 20.0_dp, LOAD = 1.0e4_dp
  real(dp), parameter :: LINE_LOAD = LOAD/LENGTH
  !> Half width and largest pressure of a roller without ends.
  real(dp), parameter :: HALF_WIDTH = sqrt(4.0_dp*LINE_LOAD*RADIUS/(PI*E_STAR))
  real(dp), parameter :: LINE_PRESSURE = 2.0_dp*LINE_LOAD/(PI*HALF_WIDTH)
  !> The grid: cells across, its half width over that of the contact; of 64 cells along, the ends have one each.
  integer, parameter :: ACROSS = 96, BLOCKS = 64
  real(dp), parameter :: COVERED = 1.6_dp
  !> The height of the crown at the ends, mm, and a gap where there is no roller.
  real(dp), parameter :: CROWN = 0.015_dp, NO_BODY = 1.0_dp
  integer, parameter :: STRAIGHT = 1, CROWNED = 2, LOGARITHMIC = 3, RESERVED = 4, PROFILES = 4
  character(len=*), parameter :: NAMES(PROFILES) = &
    ['straight          ', 'crowned           ', 'logarithmic, F    ', 'logarithmic, 1.2 F']
  real(dp), parameter :: MADE_FOR(PROFILES) = [0.0_dp, 0.0_dp, 1.0_dp, 1.2_dp]

  call run()

contains

  subroutine run()
    real(dp), allocatable :: x(:), y(:), pressure(:, :, :)
    integer :: along

    call read_cells(along)
    allocate (x(ACROSS), y(along), pressure(ACROSS, along, PROFILES))
    print '(2(a,i0),2(a,f8.5),a)', 'Roller, ', ACROSS, ' x ', along, ' cells of', spacing_x(), ' mm x', &
      spacing_y(along), ' mm'
    print '(a,f7.4,a,f7.1,a)', 'Without ends: half width', HALF_WIDTH, ' mm, pressure', LINE_PRESSURE, ' N/mm2'
    print '(a)', 'profile              approach [mm]   pressure [N/mm2]: middle   largest   at y [mm]   products' &
      //'   residual'
    call solve_all(x, y, pressure)
    call write_tables(x, y, pressure)
    call check(y, pressure)
  end subroutine run

  subroutine read_cells(along)
    integer, intent(out) :: along
    character(len=32) :: argument
    integer :: status

    along = 1024
    if (command_argument_count() < 1) return
    call get_command_argument(1, argument)
    read (argument, *, iostat=status) along
    if (status /= 0) error stop 'usage: roller [cells [folder]]'
    if (along < 128 .or. modulo(along, BLOCKS) /= 0) error stop 'cells has to be a multiple of 64, 128 or more'
  end subroutine read_cells

  !> Widths of the cells; the roller ends at the edge of a cell.
  pure function spacing_x() result(h)
    real(dp) :: h

    h = 2.0_dp*COVERED*HALF_WIDTH/ACROSS
  end function spacing_x

  pure function spacing_y(along) result(h)
    integer, intent(in) :: along
    real(dp) :: h

    h = LENGTH/real(along - 2*along/BLOCKS, dp)
  end function spacing_y

  !> All profiles on one operator.
  subroutine solve_all(x, y, pressure)
    real(dp), intent(out) :: x(:), y(:), pressure(:, :, :)
    type(fuge_halfspace_operator) :: operator
    type(fuge_problem) :: problem
    type(fuge_solver) :: solver
    type(fuge_solution) :: solution
    type(fuge_info) :: info
    real(dp) :: h_x, h_y
    integer :: i, j, k, top(2)

    h_x = spacing_x()
    h_y = spacing_y(size(y))
    x = [((i - 0.5_dp*(size(x) + 1))*h_x, i=1, size(x))]
    y = [((j - 0.5_dp*(size(y) + 1))*h_y, j=1, size(y))]
    call operator%set(size(x), size(y), h_x, h_y, E_STAR, info, element=FUGE_MEAN, boundary=FUGE_FREE)
    call require(info, 'grid')
    problem%resultant = [LOAD]
    do k = 1, PROFILES
      problem%gap = [((x(i)**2/(2.0_dp*RADIUS) + profile(k, y(j)), i=1, size(x)), j=1, size(y))]
      call solver%solve(operator, problem, solution, info)
      call require(info, NAMES(k))
      pressure(:, :, k) = reshape(solution%force, shape(pressure(:, :, k)))/(h_x*h_y)
      top = maxloc(pressure(:, :, k))
      print '(a,f14.6,f26.1,f11.1,f12.3,i11,es12.1)', NAMES(k), solution%motion(1), &
        maxval(pressure(:, size(y)/2, k)), maxval(pressure(:, :, k)), abs(y(top(2))), info%products, info%residual
    end do
  end subroutine solve_all

  !> The distance of profile k from the straight one at the place y of the axis.
  pure function profile(k, y) result(z)
    integer, intent(in) :: k
    real(dp), intent(in) :: y
    real(dp) :: z
    real(dp), parameter :: HALF = 0.5_dp*LENGTH

    if (abs(y) > HALF) then
      z = NO_BODY
    else if (k == STRAIGHT) then
      z = 0.0_dp
    else if (k == CROWNED) then
      z = CROWN*(y/HALF)**2
    else
      z = -MADE_FOR(k)*LINE_LOAD/(PI*E_STAR)*log(1.0_dp - (1.0_dp - 0.5_dp*exp(-0.5_dp)*HALF_WIDTH/HALF)*(y/HALF)**2)
    end if
  end function profile

  !> Pressure along the axis, and maps of one end of each roller.
  subroutine write_tables(x, y, pressure)
    real(dp), intent(in) :: x(:), y(:), pressure(:, :, :)
    integer :: file, i, j, k

    call create_file('roller_axis.csv', 2, file)
    write (file, '(a)') 'y,straight,crowned,logarithmic,reserved'
    do j = 1, size(y)
      write (file, '(4(es14.6,","),es14.6)') y(j), (maxval(pressure(:, j, k)), k=1, PROFILES)
    end do
    close (file)
    do k = 1, PROFILES
      call create_file('roller_map_'//achar(iachar('0') + k)//'.dat', 2, file)
      do j = size(y) - size(y)/8 + 1, size(y)
        do i = 1, size(x)
          write (file, '(2es14.6,es12.4)') x(i), y(j), pressure(i, j, k)
        end do
      end do
      close (file)
    end do
  end subroutine write_tables

  !> The middle is that of a roller without ends, a little less where the ends carry more; the logarithm for more than
  !> the load keeps this pressure up to the ends.
  subroutine check(y, pressure)
    real(dp), intent(in) :: y(:), pressure(:, :, :)
    real(dp), dimension(PROFILES) :: middle, largest
    type(verdict) :: endless
    integer :: k

    middle = [(maxval(pressure(:, size(y)/2, k)), k=1, PROFILES)]/LINE_PRESSURE
    largest = [(maxval(pressure(:, :, k)), k=1, PROFILES)]/LINE_PRESSURE
    if (largest(STRAIGHT) < 2.0_dp) error stop 'the straight roller shows no edge pressure'
    if (largest(LOGARITHMIC) > 1.2_dp) error stop 'the logarithmic profile does not lower the edge pressure'
    if (middle(CROWNED) < 1.1_dp) error stop 'the crown does not concentrate the load'
    call endless%compare(middle([STRAIGHT, LOGARITHMIC, RESERVED]) - 1.0_dp, 0.08_dp, 'the pressure in the middle')
    call endless%compare(largest(RESERVED) - 1.0_dp, 0.05_dp, &
                         'the largest pressure with the profile for a larger load')
    call endless%give('against a roller without ends')
  end subroutine check

  subroutine require(info, what)
    type(fuge_info), intent(in) :: info
    character(len=*), intent(in) :: what

    if (info%status == 0) return
    print '(3a)', what, ': ', trim(info%message)
    error stop 'a step of the example failed'
  end subroutine require

end program roller
