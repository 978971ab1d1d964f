!> A shaft of 40.005 mm in a hub of 40.000 mm, their meshes not matching: the model of fit.inp, its contact by fuge and
!> by CalculiX, and the pressure by Lame's formulas.
module calculix_fit
  use calculix_bodies, only: contact_request, contact_result, solve_by_fuge
  use calculix_own, only: contact_law, own_answer, solve_by_calculix, write_law
  use calculix_slab, only: make_slab, slab
  use example_verdict, only: verdict
  use fuge, only: dp => fuge_dp
  implicit none
  private

  public :: compare_fits

  !> N/mm2; radii of bore, fit and rim, interference of the radii, and thickness of the slabs; mm.
  real(dp), parameter :: YOUNG = 1.96e5_dp, BORE = 10.0_dp, FIT = 20.0_dp, RIM = 30.0_dp, INTERFERENCE = 2.5e-3_dp
  real(dp), parameter :: THICKNESS = 1.0_dp
  real(dp), parameter :: PI = acos(-1.0_dp)
  !> Elements of shaft and hub along the quarter, and the order of the elements.
  integer, parameter :: MESHES(3, 6) = reshape([12, 12, 1, 12, 8, 1, 16, 24, 1, 6, 4, 2, 12, 8, 2, 8, 12, 2], [3, 6])
  type(contact_law), parameter :: LAWS(4) = [ &
    contact_law('SURFACE TO SURFACE', 0.0_dp), contact_law('SURFACE TO SURFACE', 0.0_dp, -INTERFERENCE), &
    contact_law('NODE TO SURFACE', 0.0_dp), contact_law('MORTAR', -1.0_dp)]
  !> Largest relative error of the mean pressure.
  real(dp), parameter :: TOLERANCE = 5.0e-3_dp

contains

  !> A line for each pair of meshes. A job of CalculiX may take `most` seconds.
  subroutine compare_fits(command, most, known)
    character(len=*), intent(in) :: command
    integer, intent(in) :: most
    type(verdict), intent(inout) :: known
    type(contact_result) :: ours
    type(own_answer) :: theirs
    character(len=12) :: theirs_text(size(LAWS))
    real(dp) :: pressure
    integer :: k, law

    print '(/,a,f7.4,a)', 'Press fit, 40.005 mm in 40.000 mm: Lame''s pressure is', lame(), ' N/mm2'
    print '(a)', '  elements            fuge              at nodes      CalculiX, mean pressure [N/mm2]'
    print '(a)', '  shaft  hub        [N/mm2]  error    from     to     surface to  the same,     node to      mortar'
    print '(a)', '                                                      surface  *CLEARANCE     surface'
    do k = 1, size(MESHES, 2)
      call write_rings(MESHES(:2, k), MESHES(3, k))
      call fit_by_fuge(command, ours)
      do law = 1, size(LAWS)
        call write_law('fit_law.inp', LAWS(law), 'SSHAFT', 'SHUB')
        call solve_by_calculix(command, 'fit_contact', 'HUBFIRST', most, theirs)
        theirs_text(law) = '   no result'
        if (theirs%solved) write (theirs_text(law), '(f12.4)') abs(theirs%total(1))/(FIT*THICKNESS)
      end do
      pressure = mean_pressure(ours)
      print '(i7,i5,a,f8.4,f6.2,a,2f7.3,4a)', MESHES(:2, k), merge('  C3D8 ', '  C3D20', MESHES(3, k) == 1), pressure, &
        100.0_dp*(pressure/lame() - 1.0_dp), ' %', minval(ours%contact%pressure), maxval(ours%contact%pressure), &
        theirs_text
      call known%compare(pressure/lame() - 1.0_dp, TOLERANCE, 'the pressure of the fit by Lame')
    end do
  end subroutine compare_fits

  !> Two hollow cylinders of one material in plane stress.
  pure function lame() result(pressure)
    real(dp) :: pressure

    pressure = YOUNG*INTERFERENCE/FIT/((FIT**2 + BORE**2)/(FIT**2 - BORE**2) + (RIM**2 + FIT**2)/(RIM**2 - FIT**2))
  end function lame

  !> Write the mesh: the shaft, whose surface is inside the hub by the interference, and the hub.
  subroutine write_rings(count, order)
    integer, intent(in) :: count(2), order
    type(slab) :: body(2)
    integer :: file, k

    body(1) = make_slab('SHAFT', order, ring(count(1), order, FIT + INTERFERENCE, BORE), THICKNESS, .false.)
    body(2) = make_slab('HUB', order, ring(count(2), order, FIT, RIM), THICKNESS, .true., before=body(1))
    open (newunit=file, file='fit_mesh.inp', status='replace', action='write')
    do k = 1, 2
      call body(k)%write_to(file, count(k), 1.0_dp)
    end do
    close (file)
  end subroutine write_rings

  !> A quarter of a ring from the radius of the contact surface to that of its other face, four elements across.
  pure function ring(count, order, contact, other) result(place)
    integer, intent(in) :: count, order
    real(dp), intent(in) :: contact, other
    real(dp), allocatable :: place(:, :, :)
    real(dp) :: angle, radius
    integer :: i, j

    allocate (place(2, order*count + 1, 4*order + 1))
    do j = 1, size(place, 3)
      radius = contact + (other - contact)*real(j - 1, dp)/real(4*order, dp)
      do i = 1, size(place, 2)
        angle = 0.5_dp*PI*real(i - 1, dp)/real(order*count, dp)
        place(:, i, j) = radius*[sin(angle), cos(angle)]
      end do
    end do
  end function ring

  !> Linear elements make a polygon of the circle, and chords of different lengths are farther apart than the
  !> interference. So gaps are those of the round bodies, which is the default.
  subroutine fit_by_fuge(command, result)
    character(len=*), intent(in) :: command
    type(contact_result), intent(out) :: result
    type(contact_request) :: request

    request%model = 'fit'
    request%contact = 'SSHAFT'
    request%opposite = 'SHUB'
    call solve_by_fuge(command, request, result)
  end subroutine fit_by_fuge

  !> The force that opens the hub along x, over the area that it acts on: as CalculiX's forces of supports give it.
  pure function mean_pressure(result) result(pressure)
    type(contact_result), intent(in) :: result
    real(dp) :: pressure

    pressure = sum(result%contact%force*result%contact%pairs%direction(1, :))/(FIT*THICKNESS)
  end function mean_pressure

end module calculix_fit
