!> A roller covered with rubber on a rigid plate: half width of the nip and pressure over the thickness of the rubber.
!>
!>     coated_roller [cells [folder for its tables]]
!>
!> Plane strain; the roller is rigid and its cover bonded to it. Lengths count in the half width a_H, and pressures in
!> the largest pressure p_H, of Hertz's contact with a roller of solid rubber. So the answer depends on two numbers:
!> the thickness over a_H and Poisson's ratio. Three limits are known. Thick covers have Hertz's contact. Thin
!> compressible ones are springs side by side, each of the modulus M of rubber that cannot give way to the sides (K. L.
!> Johnson, *Contact Mechanics*, 1985, section 5.8):
!>
!>     a**3 = 3 F R h/(2 M),    p = M (a**2 - x**2)/(2 R h),    M = E (1 - nu)/((1 + nu)(1 - 2 nu)).
!>
!> Thin incompressible ones flow to the sides as a viscous film does, and there
!>
!>     a**5 = 45 F R h**3/(2 E),    p = E (a**2 - x**2)**2/(24 R h**3).
!>
!> The errors of both fall with h/a: a cubic through those of four thin covers is 0 at h/a = 0. `cells`, 1024 unless
!> given, cover twice the nip or more. For the picture it writes coated_roller.csv and coated_roller_pressure.csv.
program coated_roller
  use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_value
  use example_output, only: create_file
  use example_verdict, only: verdict
  use fuge, only: dp => fuge_dp, fuge_contact_edges, fuge_halfplane_operator, fuge_info, fuge_interval, &
    fuge_layered_body, fuge_problem, fuge_solution, fuge_solver, FUGE_HAT
  implicit none

  real(dp), parameter :: PI = acos(-1.0_dp)
  !> N, mm.
  real(dp), parameter :: RUBBER = 5.0_dp, RADIUS = 50.0_dp, LOAD = 10.0_dp
  real(dp), parameter :: POISSON(3) = [0.3_dp, 0.45_dp, 0.5_dp]
  !> Thicknesses over a_H: this many, from the thinnest to the thickest in equal ratios.
  integer, parameter :: COVERS = 33
  real(dp), parameter :: THINNEST = 0.001_dp, THICKEST = 10.0_dp
  !> Covers whose pressures are drawn, and their Poisson's ratio.
  integer, parameter :: DRAWN(4) = [13, 21, 25, 33], DRAWN_RATIO = 3

  !> What a solve finds.
  type :: nip
    real(dp) :: half_width = 0.0_dp, peak = 0.0_dp, approach = 0.0_dp
    real(dp), allocatable :: x(:), pressure(:)
  end type nip

  call run()

contains

  subroutine run()
    type(nip) :: found(COVERS, size(POISSON))
    type(verdict) :: known
    real(dp) :: thickness(COVERS)
    integer :: cells, i, j

    call read_cells(cells)
    thickness = [(THINNEST*(THICKEST/THINNEST)**(real(i - 1, dp)/(COVERS - 1)), i=1, COVERS)]
    do j = 1, size(POISSON)
      print '(/,a,f5.2)', 'Poisson''s ratio', POISSON(j)
      print '(a)', '  h/a_H     a/a_H  thin law     p/p_H  thin law     v_0/h'
      do i = 1, COVERS
        call press(thickness(i), POISSON(j), cells, found(i, j))
        if (modulo(i, 4) == 1) print '(f7.3,5f10.4)', thickness(i), found(i, j)%half_width, &
          thin_half_width(thickness(i), POISSON(j)), found(i, j)%peak, thin_peak(thickness(i), POISSON(j)), &
          found(i, j)%approach/thickness(i)
      end do
    end do
    call compare(thickness, found, cells, known)
    call write_tables(thickness, found)
    call known%give('against Hertz and the thin limits')
  end subroutine run

  subroutine read_cells(cells)
    integer, intent(out) :: cells
    character(len=32) :: argument
    integer :: status

    cells = 1024
    if (command_argument_count() < 1) return
    call get_command_argument(1, argument)
    read (argument, *, iostat=status) cells
    if (status /= 0) error stop 'usage: coated_roller [cells [folder]]'
    if (cells < 128) error stop 'cells: at least 128'
  end subroutine read_cells

  !> E/(1 - nu**2).
  pure function plane_modulus(nu) result(modulus)
    real(dp), intent(in) :: nu
    real(dp) :: modulus

    modulus = RUBBER/(1.0_dp - nu**2)
  end function plane_modulus

  !> a_H.
  pure function solid_half_width(nu) result(half_width)
    real(dp), intent(in) :: nu
    real(dp) :: half_width

    half_width = sqrt(4.0_dp*LOAD*RADIUS/(PI*plane_modulus(nu)))
  end function solid_half_width

  !> p_H.
  pure function solid_peak(nu) result(peak)
    real(dp), intent(in) :: nu
    real(dp) :: peak

    peak = 2.0_dp*LOAD/(PI*solid_half_width(nu))
  end function solid_peak

  !> The half width of a thin cover over a_H; `thickness` over a_H too.
  pure function thin_half_width(thickness, nu) result(half_width)
    real(dp), intent(in) :: thickness, nu
    real(dp) :: half_width
    real(dp) :: h

    h = thickness*solid_half_width(nu)
    if (nu < 0.5_dp) then
      half_width = (1.5_dp*LOAD*RADIUS*h*(1.0_dp + nu)*(1.0_dp - 2.0_dp*nu)/(RUBBER*(1.0_dp - nu)))**(1.0_dp/3.0_dp)
    else
      half_width = (22.5_dp*LOAD*RADIUS*h**3/RUBBER)**0.2_dp
    end if
    half_width = half_width/solid_half_width(nu)
  end function thin_half_width

  !> The largest pressure of a thin cover over p_H.
  pure function thin_peak(thickness, nu) result(peak)
    real(dp), intent(in) :: thickness, nu
    real(dp) :: peak

    peak = merge(0.75_dp, 0.9375_dp, nu < 0.5_dp)*0.5_dp*PI/thin_half_width(thickness, nu)
  end function thin_peak

  !> Press a cover; lengths over a_H, pressures over p_H. `base`: Young's modulus of the roller, rigid unless given.
  subroutine press(thickness, nu, cells, found, base)
    real(dp), intent(in) :: thickness, nu
    integer, intent(in) :: cells
    type(nip), intent(out) :: found
    real(dp), intent(in), optional :: base
    type(fuge_layered_body) :: body
    type(fuge_halfplane_operator) :: operator
    type(fuge_problem) :: problem
    type(fuge_solver) :: solver
    type(fuge_solution) :: solution
    type(fuge_interval), allocatable :: contact(:)
    type(fuge_info) :: info
    real(dp) :: modulus, unit, width(cells), x(cells)
    integer :: i

    modulus = ieee_value(modulus, ieee_positive_inf)
    if (present(base)) modulus = base
    unit = solid_half_width(nu)
    call body%set([thickness*unit], [RUBBER, modulus], [nu, nu], info)
    call require(info, 'layers')
    ! Contacts of all thicknesses lie between the thin law and Hertz's.
    width = 4.0_dp*unit*min(1.0_dp, thin_half_width(thickness, nu))/cells
    x = [(width(1)*(i - 0.5_dp*(cells + 1)), i=1, cells)]
    call operator%set(cells, width(1), body%e_star(), info, body=body%surface())
    call require(info, 'grid')
    problem%gap = x**2/(2.0_dp*RADIUS)
    problem%resultant = [LOAD]
    call solver%solve(operator, problem, solution, info)
    call require(info, 'contact')
    call fuge_contact_edges(x, width, solution%force, FUGE_HAT, contact, info)
    call require(info, 'edges')
    found%half_width = contact(1)%right/unit
    found%peak = maxval(solution%force)/width(1)/solid_peak(nu)
    found%approach = solution%motion(1)/unit
    found%x = x/unit
    found%pressure = solution%force/width/solid_peak(nu)
  end subroutine press

  !> Limits of thick and thin covers, and a roller all of rubber.
  subroutine compare(thickness, found, cells, known)
    real(dp), intent(in) :: thickness(:)
    type(nip), intent(in) :: found(:, :)
    integer, intent(in) :: cells
    type(verdict), intent(inout) :: known
    type(nip) :: solid
    integer :: j

    do j = 1, size(POISSON)
      call press(1.0_dp, POISSON(j), cells, solid, base=RUBBER)
      call known%compare([solid%half_width, solid%peak] - 1.0_dp, 1.0e-5_dp, 'a roller of rubber')
      call known%compare([found(COVERS, j)%half_width, found(COVERS, j)%peak] - 1.0_dp, 0.6_dp/THICKEST**2, &
                         'a thick cover')
      call known%compare(limit_of(thickness, found(:, j), POISSON(j)) - 1.0_dp, 2.0e-3_dp, 'the limit of thin covers')
    end do
  end subroutine compare

  !> Half width and pressure over those of the thin law, continued to h/a = 0 by a cubic through four covers.
  pure function limit_of(thickness, found, nu) result(limit)
    real(dp), intent(in) :: thickness(:), nu
    type(nip), intent(in) :: found(:)
    real(dp) :: limit(2)
    integer, parameter :: USED(4) = [1, 4, 7, 10]
    real(dp) :: s(4), weight
    integer :: i, j

    s = thickness(USED)/found(USED)%half_width
    limit = 0.0_dp
    do i = 1, 4
      weight = 1.0_dp
      do j = 1, 4
        if (j /= i) weight = weight*s(j)/(s(j) - s(i))
      end do
      limit = limit + weight*[found(USED(i))%half_width/thin_half_width(thickness(USED(i)), nu), &
                              found(USED(i))%peak/thin_peak(thickness(USED(i)), nu)]
    end do
  end function limit_of

  !> Half widths over the thickness, and some distributions of the pressure.
  subroutine write_tables(thickness, found)
    real(dp), intent(in) :: thickness(:)
    type(nip), intent(in) :: found(:, :)
    integer :: file, i, j

    call create_file('coated_roller.csv', 2, file)
    write (file, '(a)') 'thickness,half_width_1,thin_1,half_width_2,thin_2,half_width_3,thin_3'
    do i = 1, size(thickness)
      write (file, '(*(es14.6,:,","))') thickness(i), &
        (found(i, j)%half_width, thin_half_width(thickness(i), POISSON(j)), j=1, size(POISSON))
    end do
    close (file)
    call create_file('coated_roller_pressure.csv', 2, file)
    write (file, '(a)') 'x_1,pressure_1,x_2,pressure_2,x_3,pressure_3,x_4,pressure_4'
    do i = 1, size(found(1, 1)%x)
      write (file, '(*(es14.6,:,","))') (found(DRAWN(j), DRAWN_RATIO)%x(i), &
                                         found(DRAWN(j), DRAWN_RATIO)%pressure(i), j=1, size(DRAWN))
    end do
    close (file)
  end subroutine write_tables

  subroutine require(info, what)
    type(fuge_info), intent(in) :: info
    character(len=*), intent(in) :: what

    if (info%status == 0) return
    print '(3a)', what, ': ', trim(info%message)
    error stop 'a step of the example failed'
  end subroutine require

end program coated_roller
