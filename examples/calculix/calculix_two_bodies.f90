!> Two elastic bodies of a CalculiX model whose meshes do not match: their contact by fuge, and by CalculiX with its own
!> methods.
!>
!>     calculix_two_bodies [ccx]
!>
!> has to run in a folder with pressed.inp, pressed_stiffness.inp, pressed_contact.inp and the same three of fit, to
!> which it and CalculiX write all their files; `ccx` is the command that starts CalculiX. CalculiX assembles the
!> stiffness of both bodies; fuge finds the contact points of the two surfaces and solves the contact.
!> First a block of aluminium with a cylindrical face (R = 100 mm) is pressed 4 um down on a block of steel, in plane
!> strain: CalculiX's penalties and mortar methods beside fuge, and the same model in other units. Then a shaft is
!> pressed into a hub. See doc/calculix.md. The tables calculix_two_bodies.csv and hertz.csv are for the picture.
program calculix_two_bodies
  use calculix_bodies, only: contact_result
  use calculix_fit, only: compare_fits
  use calculix_own, only: contact_law, find, own_answer
  use calculix_pressed, only: press_by_calculix, press_by_fuge, pressed_blocks, unit_system, write_material, E_STAR, &
    MILLIMETRE, RADIUS, THICKNESS, YOUNG
  use calculix_slab, only: slab
  use example_verdict, only: verdict
  use fuge, only: dp => fuge_dp
  implicit none

  !> Penalties over Young's modulus of the upper body, 1/mm; 50 is CalculiX's default. Below 0: hard.
  real(dp), parameter :: RATIO(10) = [5.0_dp, 50.0_dp, 500.0_dp, 5.0e3_dp, 5.0_dp, 50.0_dp, 500.0_dp, 5.0e3_dp, &
                                      -1.0_dp, -1.0_dp]
  character(len=18), parameter :: METHOD(10) = [character(len=18) :: 'SURFACE TO SURFACE', 'SURFACE TO SURFACE', &
    'SURFACE TO SURFACE', 'SURFACE TO SURFACE', 'NODE TO SURFACE', 'NODE TO SURFACE', 'NODE TO SURFACE', &
    'NODE TO SURFACE', 'MORTAR', 'PGLINMORTAR']
  !> Systems of units; the files in the last one remain.
  type(unit_system), parameter :: UNITS(3) = [unit_system('m, N', 1.0e-3_dp, 1.0_dp), &
                                              unit_system('inch,lbf', 1.0_dp/25.4_dp, 1.0_dp/4.4482216152605_dp), &
                                              unit_system('mm, N', 1.0_dp, 1.0_dp)]
  !> Most seconds of the processor for a job of CalculiX; for mortar contact in other units, which may not end, the most
  !> as a multiple of its time in mm and N.
  integer, parameter :: MOST = 12
  real(dp), parameter :: LONGER = 1.5_dp
  !> How many times smaller the elements of the reference are.
  integer, parameter :: FINER = 3
  real(dp), parameter :: PI = acos(-1.0_dp)

  !> The front nodes of the contact surface beside the middle with their pressures; x in mm.
  type :: profile
    integer, allocatable :: node(:)
    real(dp), allocatable :: x(:), pressure(:)
    !> Of the half model, N.
    real(dp) :: force = 0.0_dp
  end type profile

  call run()

contains

  subroutine run()
    character(len=:), allocatable :: command
    type(contact_result) :: fine, ours, smooth
    type(profile) :: reference, own
    type(slab) :: body(2)
    type(verdict) :: known
    real(dp) :: mortar

    command = argument()
    body = pressed_blocks(FINER, MILLIMETRE)
    call press_by_fuge(command, MILLIMETRE, .true., fine)
    reference = profile_of(body(1), fine)
    body = pressed_blocks(1, MILLIMETRE)
    call press_by_fuge(command, MILLIMETRE, .true., smooth)
    call press_by_fuge(command, MILLIMETRE, .false., ours)
    own = profile_of(body(1), ours)
    print '(a)', 'Two elastic bodies, meshes that do not match: stiffness by CalculiX, contact by fuge'
    print '(a)', '                            contact  nodes in     ccx    fuge    force of the  largest pressure'
    print '(a)', '                  unknowns   points   contact     [s]     [s]        half [N]           [N/mm2]'
    call show_line('faces as meshed', ours, own)
    call show_line('smooth         ', smooth, profile_of(body(1), smooth))
    call show_line('smooth, fine   ', fine, reference)
    call compare_hertz(own, reference, known)
    call compare_methods(command, ours, own, reference, mortar, known)
    call compare_units(command, ours, ceiling(LONGER*mortar))
    call compare_fits(command, MOST, known)
    call known%give('against Hertz, Lame and mortar contact of CalculiX')
  end subroutine run

  !> The command given as argument, or ccx.
  function argument() result(command)
    character(len=:), allocatable :: command
    character(len=1024) :: given

    command = 'ccx'
    if (command_argument_count() < 1) return
    call get_command_argument(1, given)
    command = trim(given)
  end function argument

  pure function profile_of(body, result) result(found)
    type(slab), intent(in) :: body
    type(contact_result), intent(in) :: result
    type(profile) :: found
    integer :: front(size(body%number, 1))

    front = body%number(:, 1, 1)
    ! CalculiX's mortar methods print no pressure at x = 0, where supports hold the node along x and y.
    front(1) = 0
    allocate (found%node, source=pack(front, in(front, result%node)))
    found%x = body%position(1, found%node - body%first_node + 1)
    found%pressure = find(found%node, result%node, result%contact%pressure)
    found%force = sum(result%contact%force)
  end function profile_of

  pure function in(wanted, list)
    integer, intent(in) :: wanted(:), list(:)
    logical :: in(size(wanted))
    integer :: k

    in = [(any(list == wanted(k)), k=1, size(wanted))]
  end function in

  subroutine show_line(name, result, its)
    character(len=*), intent(in) :: name
    type(contact_result), intent(in) :: result
    type(profile), intent(in) :: its

    print '(2a,i9,2i9,f10.2,f8.3,f16.5,f18.2)', '  ', name, result%degrees, size(result%node), &
      count(result%contact%touching), result%assembling, result%solving, its%force, maxval(its%pressure)
  end subroutine show_line

  !> The half-plane under the force of the finer mesh, also as a table for the picture.
  subroutine compare_hertz(own, reference, known)
    type(profile), intent(in) :: own, reference
    type(verdict), intent(inout) :: known
    integer, parameter :: POINTS = 400
    real(dp) :: load, pressure, width, x
    integer :: file, k

    load = 2.0_dp*reference%force/THICKNESS
    width = sqrt(4.0_dp*load*RADIUS/(PI*E_STAR))
    pressure = 2.0_dp*load/(PI*width)
    print '(a,f7.2,a,f7.4,a)', 'Hertz for the force of the fine mesh: p_0 =', pressure, ' N/mm2, half-width', width, &
      ' mm'
    call known%compare(maxval(reference%pressure)/pressure - 1.0_dp, 1.0e-2_dp, 'the pressure of Hertz')
    if (abs(own%force/reference%force - 1.0_dp) > 1.0e-2_dp) error stop 'the force depends on the mesh'
    open (newunit=file, file='hertz.csv', status='replace', action='write')
    do k = 0, POINTS
      x = width*sin(0.5_dp*PI*real(k, dp)/real(POINTS, dp))
      write (file, '(es14.6,",",es14.6)') x, pressure*sqrt(max(1.0_dp - (x/width)**2, 0.0_dp))
    end do
    close (file)
  end subroutine compare_hertz

  !> CalculiX's methods one after the other; `mortar`: seconds of its mortar contact.
  subroutine compare_methods(command, ours, own, reference, mortar, known)
    character(len=*), intent(in) :: command
    type(contact_result), intent(in) :: ours
    type(profile), intent(in) :: own, reference
    real(dp), intent(out) :: mortar
    type(verdict), intent(inout) :: known
    type(own_answer) :: theirs(size(METHOD))
    integer :: k

    print '(/,a)', 'The same contact by CalculiX; processor times; differences of pressures over the largest one'
    print '(2a)', '  method                 K/E    time incre- itera- nodes in penetration     force    error', &
      '  pressures', '                      [1/mm]     [s]  ments  tions  contact        [mm]       [N]         ', &
      '  fuge   fine'
    print '(a,f18.2,i23,f22.5,f23.3)', '  fuge              ', ours%assembling + ours%solving, &
      count(own%pressure > 0.0_dp), own%force, difference(own%pressure, own, reference)
    do k = 1, size(METHOD)
      call press_by_calculix(command, contact_law(METHOD(k), RATIO(k)*YOUNG(1)), MOST, theirs(k))
      call show_method(METHOD(k), RATIO(k), theirs(k), own, reference)
    end do
    call check_methods(theirs, own, known)
    call write_profiles(own, theirs)
    mortar = maxval(theirs%seconds, METHOD == 'MORTAR')
  end subroutine compare_methods

  subroutine show_method(name, ratio, theirs, own, reference)
    character(len=*), intent(in) :: name
    real(dp), intent(in) :: ratio
    type(own_answer), intent(in) :: theirs
    type(profile), intent(in) :: own, reference
    real(dp), dimension(size(own%node)) :: pressure, gap
    real(dp) :: error
    character(len=10) :: penalty

    write (penalty, '(f10.0)') ratio
    if (ratio < 0.0_dp) penalty = '      hard'
    if (.not. theirs%solved) then
      print '(2x,2a,f8.2,2i7,a)', name, penalty, theirs%seconds, theirs%increments, theirs%iterations, '   no result'
      return
    end if
    pressure = find(own%node, theirs%node, theirs%pressure)
    gap = find(own%node, theirs%node, theirs%gap)
    ! Rounded here, because zero may be printed as -0.00.
    error = 0.01_dp*real(floor(0.5_dp + 1.0e4_dp*(-theirs%total(3)/own%force - 1.0_dp)), dp)
    print '(2x,2a,f8.2,2i7,i9,es12.1,f10.5,f7.2,a,2f7.3)', name, penalty, theirs%seconds, theirs%increments, &
      theirs%iterations, count(pressure > 0.0_dp), maxval(-gap, pressure > 0.0_dp), -theirs%total(3), error, ' %', &
      maxval(abs(pressure - own%pressure))/maxval(own%pressure), difference(pressure, own, reference)
  end subroutine show_method

  !> Largest difference of pressures at the nodes of `own` from those of the finer mesh.
  pure function difference(pressure, own, reference)
    real(dp), intent(in) :: pressure(:)
    type(profile), intent(in) :: own, reference
    real(dp) :: difference
    real(dp) :: share
    integer :: i, k

    difference = 0.0_dp
    do i = 1, size(pressure)
      k = min(max(count(reference%x <= own%x(i)), 1), size(reference%x) - 1)
      share = (own%x(i) - reference%x(k))/(reference%x(k + 1) - reference%x(k))
      difference = max(difference, abs(pressure(i) - (1.0_dp - share)*reference%pressure(k) &
                                       - share*reference%pressure(k + 1)))
    end do
    difference = difference/maxval(reference%pressure)
  end function difference

  !> CalculiX's mortar contact, without penalty, is the same discrete problem; its penalties tend to a force near by.
  subroutine check_methods(theirs, own, known)
    type(own_answer), intent(in) :: theirs(:)
    type(profile), intent(in) :: own
    type(verdict), intent(inout) :: known
    real(dp) :: pressure(size(own%node))
    integer :: k

    do k = 1, size(theirs)
      if (.not. theirs(k)%solved) cycle
      if (RATIO(k) > 1.0e3_dp .and. abs(-theirs(k)%total(3)/own%force - 1.0_dp) > 1.0e-3_dp) &
        error stop 'CalculiX''s penalties do not tend to the force of fuge'
      if (METHOD(k) /= 'MORTAR') cycle
      pressure = find(own%node, theirs(k)%node, theirs(k)%pressure)
      call known%compare(-theirs(k)%total(3)/own%force - 1.0_dp, 1.0e-5_dp, 'the force by mortar contact')
      call known%compare(maxval(abs(pressure - own%pressure))/maxval(own%pressure), 2.0e-3_dp, &
                         'the pressures by mortar contact')
    end do
  end subroutine check_methods

  !> For the picture: x in mm, pressures in N/mm2.
  subroutine write_profiles(own, theirs)
    type(profile), intent(in) :: own
    type(own_answer), intent(in) :: theirs(:)
    real(dp) :: pressure(size(own%node), size(theirs))
    integer :: file, i, k

    pressure = 0.0_dp
    do k = 1, size(theirs)
      if (theirs(k)%solved) pressure(:, k) = find(own%node, theirs(k)%node, theirs(k)%pressure)
    end do
    open (newunit=file, file='calculix_two_bodies.csv', status='replace', action='write')
    write (file, '(a,*(:,",",a))') 'x,fuge', METHOD
    do i = 1, size(own%node)
      write (file, '(*(es14.6,:,","))') own%x(i), own%pressure(i), pressure(i, :)
    end do
    close (file)
  end subroutine write_profiles

  !> The same model in other units, by CalculiX with its default penalty, with the other material first in the file,
  !> with the number that the default is in mm and N, and by its hard mortar contact, which may take `most_mortar`
  !> seconds.
  subroutine compare_units(command, ours, most_mortar)
    character(len=*), intent(in) :: command
    type(contact_result), intent(in) :: ours
    integer, intent(in) :: most_mortar
    type(contact_result) :: again
    type(own_answer) :: theirs(4)
    type(slab) :: body(2)
    real(dp) :: difference
    integer :: j, k

    print '(/,a)', 'The same model in other units: force of the half [N]'
    print '(a)', '  units      surface to    the same,  K of mm, N       mortar         fuge   differences'
    print '(a)', '                surface  steel first                                           of forces'
    do k = 1, size(UNITS)
      body = pressed_blocks(1, UNITS(k))
      call press_by_calculix(command, contact_law('SURFACE TO SURFACE'), MOST, theirs(1))
      call press_by_calculix(command, contact_law('SURFACE TO SURFACE', 50.0_dp*YOUNG(1)), MOST, theirs(3))
      call press_by_calculix(command, contact_law('MORTAR', -1.0_dp), most_mortar, theirs(4))
      call press_by_fuge(command, UNITS(k), .false., again)
      call write_material(UNITS(k), [2, 1])
      call press_by_calculix(command, contact_law('SURFACE TO SURFACE'), MOST, theirs(2))
      difference = force_difference(again, UNITS(k), ours)
      print '(2x,5a,f13.5,es14.1)', UNITS(k)%name, (force_text(theirs(j), UNITS(k)), j=1, 4), &
        sum(again%contact%force)/UNITS(k)%force, difference
      if (difference > 1.0e-10_dp) error stop 'the answer depends on the units'
    end do
    do k = 1, size(UNITS) - 1
      call press_by_fuge(command, UNITS(k), .false., again, converted=.true.)
      difference = force_difference(again, UNITS(k), ours)
      print '(3a,es8.1)', '  fuge, from files in mm and N converted to ', trim(UNITS(k)%name), &
        ': forces differ by', difference
      if (difference > 1.0e-12_dp) error stop 'fuge depends on the units'
    end do
  end subroutine compare_units

  !> Largest difference over the largest force; the same nodes touch.
  function force_difference(result, units, ours) result(difference)
    type(contact_result), intent(in) :: result, ours
    type(unit_system), intent(in) :: units
    real(dp) :: difference

    if (any(result%contact%touching .neqv. ours%contact%touching)) error stop 'other nodes touch in other units'
    difference = maxval(abs(result%contact%force/units%force - ours%contact%force))/maxval(ours%contact%force)
  end function force_difference

  pure function force_text(answer, units) result(text)
    type(own_answer), intent(in) :: answer
    type(unit_system), intent(in) :: units
    character(len=13) :: text

    text = '    no result'
    if (answer%solved) write (text, '(f13.5)') -answer%total(3)/units%force
  end function force_text

end program calculix_two_bodies
