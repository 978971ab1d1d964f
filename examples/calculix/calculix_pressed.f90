!> A block with a cylindrical face on another block, both elastic, their meshes not matching: the model of
!> pressed.inp in any units, and its contact by fuge and by CalculiX.
module calculix_pressed
  use calculix_bodies, only: contact_request, contact_result, solve_by_fuge
  use calculix_own, only: contact_law, own_answer, solve_by_calculix, write_law
  use calculix_slab, only: graded_lines, make_slab, refined, slab
  use fuge, only: dp => fuge_dp
  implicit none
  private

  public :: press_by_calculix, press_by_fuge, pressed_blocks, write_material, E_STAR, MILLIMETRE, RADIUS, THICKNESS, &
    YOUNG

  !> A system of units: what 1 mm and 1 N are in it.
  type, public :: unit_system
    character(len=8) :: name = 'mm, N'
    real(dp) :: length = 1.0_dp, force = 1.0_dp
  end type unit_system
  type(unit_system), parameter :: MILLIMETRE = unit_system()

  !> Aluminium on steel; N/mm2.
  real(dp), parameter :: YOUNG(2) = [7.0e4_dp, 2.1e5_dp], POISSON(2) = [0.33_dp, 0.3_dp]
  character(len=9), parameter :: MATERIAL(2) = ['ALUMINIUM', 'STEEL    ']
  real(dp), parameter :: E_STAR = 1.0_dp/sum((1.0_dp - POISSON**2)/YOUNG)
  !> Radius of the upper face, thickness of the slabs, their width (of the half) and height; mm.
  real(dp), parameter :: RADIUS = 100.0_dp, THICKNESS = 0.1_dp, SIDE = 10.0_dp
  !> How far the upper end is pressed down after the bodies have touched, and the share of it by which they overlap in
  !> the mesh, because CalculiX's mortar contact does not start from bodies that only touch; mm.
  real(dp), parameter :: DEPTH_PRESSED = 4.0e-3_dp, OVERLAP = 1.0e-5_dp, MOTION = DEPTH_PRESSED - OVERLAP
  !> Elements where the bodies may touch, up to REACH from the middle; growth of those farther out.
  real(dp), parameter :: SPACING(2) = [0.05_dp, 0.07_dp], REACH = 0.9_dp, GROWTH = 1.25_dp

contains

  !> Write the mesh, each element divided into finer x finer, and what depends on the units. The upper body comes first.
  function pressed_blocks(finer, units) result(body)
    integer, intent(in) :: finer
    type(unit_system), intent(in) :: units
    type(slab) :: body(2)
    integer :: faces(2), file, k

    faces = finer*nint(REACH/SPACING)
    body(1) = make_slab('UPPER', 1, places(finer, 1), THICKNESS, .true.)
    body(2) = make_slab('LOWER', 1, places(finer, 2), THICKNESS, .false., before=body(1))
    open (newunit=file, file='pressed_mesh.inp', status='replace', action='write')
    do k = 1, 2
      call body(k)%write_to(file, faces(k), units%length)
    end do
    close (file)
    call write_material(units, [1, 2])
    open (newunit=file, file='pressed_motion.inp', status='replace', action='write')
    write (file, '(a,/,a,es20.13)') '*BOUNDARY', 'UPPEREND, 3, 3, ', -MOTION*units%length
    close (file)
  end function pressed_blocks

  !> The materials, in an order that matters to CalculiX's default penalty alone.
  subroutine write_material(units, order)
    type(unit_system), intent(in) :: units
    integer, intent(in) :: order(2)
    integer :: file, k

    open (newunit=file, file='pressed_material.inp', status='replace', action='write')
    do k = 1, 2
      write (file, '(2a)') '*MATERIAL, NAME=', trim(MATERIAL(order(k))), '*ELASTIC'
      write (file, '(es20.13,", ",f5.2)') YOUNG(order(k))*units%force/units%length**2, POISSON(order(k))
      write (file, '(a)') '*DENSITY', '1.'
    end do
    close (file)
  end subroutine write_material

  !> x and z of the nodes of a body. The crown of the upper one fades towards its end.
  pure function places(finer, k) result(place)
    integer, intent(in) :: finer, k
    real(dp), allocatable :: place(:, :, :)
    real(dp), allocatable :: x(:), depth(:)
    real(dp) :: height
    integer :: i

    allocate (x, source=refined(graded_lines(SIDE, SPACING(k), GROWTH, nint(REACH/SPACING(k)) + 1), finer))
    allocate (depth, source=refined(graded_lines(SIDE, SPACING(k), GROWTH, 2), finer))
    height = depth(size(depth))
    allocate (place(2, size(x), size(depth)))
    do i = 1, size(x)
      place(1, i, :) = x(i)
      if (k == 1) place(2, i, :) = depth + x(i)**2/(2.0_dp*RADIUS)*(1.0_dp - depth/height) - OVERLAP
      if (k == 2) place(2, i, :) = -depth
    end do
  end function places

  !> `smooth`: with the gaps of the cylinder that the linear elements stand for, or with those of their faces.
  !> `converted`: the files are in mm and N, and are converted when they have been read.
  subroutine press_by_fuge(command, units, smooth, result, converted)
    character(len=*), intent(in) :: command
    type(unit_system), intent(in) :: units
    logical, intent(in) :: smooth
    type(contact_result), intent(out) :: result
    logical, intent(in), optional :: converted
    type(contact_request) :: request

    request%model = 'pressed'
    request%contact = 'SUPPER'
    request%opposite = 'SLOWER'
    request%moved = 'UPPEREND'
    request%displacement = -MOTION*units%length
    request%options%smooth = smooth
    if (present(converted)) then
      if (converted) request%length = units%length
      if (converted) request%force = units%force
    end if
    call solve_by_fuge(command, request, result)
  end subroutine press_by_fuge

  subroutine press_by_calculix(command, law, most, answer)
    character(len=*), intent(in) :: command
    type(contact_law), intent(in) :: law
    integer, intent(in) :: most
    type(own_answer), intent(out) :: answer

    call write_law('pressed_law.inp', law, 'SUPPER', 'SLOWER')
    call solve_by_calculix(command, 'pressed_contact', 'UPPEREND', most, answer)
  end subroutine press_by_calculix

end module calculix_pressed
