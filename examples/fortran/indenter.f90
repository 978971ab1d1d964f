!> A conical indenter with a blunt tip pressed into a half-space: how far is it from a cone, and from a sphere?
!>
!> Units nm and GPa = nN/nm**2: a cone of 70.3 degrees half angle, which has the area of a Berkovich pyramid over its
!> depth, with a tip of 100 nm radius, on fused quartz. For a series of depths: load and radius of the contact, and the
!> fractions of that load that a sharp cone and a sphere of the tip's radius would carry, by `fuge_solve_round_punch`;
!> then the same contact on rings, by a matrix and the dense engine, and the relative difference of its approach.
program indenter
  use example_verdict, only: verdict
  use fuge, only: dp => fuge_dp, fuge_info, fuge_power_profile, &
    fuge_ring_matrix, fuge_round_contact, fuge_solve_dense, fuge_solve_round_punch, FUGE_DONE, FUGE_MEAN
  use indenter_tip, only: blunt_cone
  implicit none

  real(dp), parameter :: PI = acos(-1.0_dp)
  real(dp), parameter :: E_STAR = 69.6_dp, TIP_RADIUS = 100.0_dp, SLOPE = tan(PI/180.0_dp*(90.0_dp - 70.3_dp))
  integer, parameter :: RINGS = 200

  call run()

contains

  subroutine run()
    type(blunt_cone) :: tip
    type(fuge_round_contact) :: contact
    type(fuge_info) :: info
    type(verdict) :: rings_too
    real(dp) :: depth, difference
    integer :: k

    tip = blunt_cone(upper=1.0e4_dp, slope=SLOPE, tip_radius=TIP_RADIUS)
    print '(a)', 'Loads of a cone and of a sphere at this depth over that of the blunt cone; difference by 200 rings'
    print '(a10,a14,a12,2a10,a16,a16)', 'depth [nm]', 'load [nN]', 'radius [nm]', 'cone', 'sphere', 'by rings', &
      'coefficients'
    do k = 0, 9
      depth = 2.0_dp**k
      call fuge_solve_round_punch(tip, E_STAR, contact, info, approach=depth)
      if (info%status /= FUGE_DONE) error stop 'the indenter was not solved'
      difference = difference_on_rings(tip, contact)
      print '(f10.1,es14.6,f12.5,2f10.3,es16.1,i16)', depth, contact%load, contact%radius, &
        cone_load(depth)/contact%load, sphere_load(depth)/contact%load, difference, &
        size(contact%coefficients())
      call rings_too%compare(difference, 1.0e-4_dp, 'the approach on rings')
    end do
    call rings_too%give('on rings as without a grid')
  end subroutine run

  !> The load of the sharp cone at this depth.
  function cone_load(depth) result(load)
    real(dp), intent(in) :: depth
    real(dp) :: load
    type(fuge_power_profile) :: cone
    type(fuge_round_contact) :: contact
    type(fuge_info) :: info

    cone%upper = 1.0e5_dp
    cone%coefficients = [SLOPE]
    cone%powers = [1.0_dp]
    call fuge_solve_round_punch(cone, E_STAR, contact, info, approach=depth)
    if (info%status /= FUGE_DONE) error stop 'the cone was not solved'
    load = contact%load
  end function cone_load

  !> Hertz: load (4/3) E* sqrt(R) depth**1.5.
  pure function sphere_load(depth) result(load)
    real(dp), intent(in) :: depth
    real(dp) :: load

    load = 4.0_dp/3.0_dp*E_STAR*sqrt(TIP_RADIUS)*depth**1.5_dp
  end function sphere_load

  !> The relative difference of the approach on rings under the same load; their gaps are means over the rings, by
  !> Simpson's rule.
  function difference_on_rings(tip, contact) result(difference)
    type(blunt_cone), intent(in) :: tip
    type(fuge_round_contact), intent(in) :: contact
    real(dp) :: difference
    real(dp) :: radius(0:RINGS), gap(RINGS), force(RINGS), opening(RINGS), approach
    real(dp), dimension(0:2*RINGS) :: r, height, slopes
    real(dp), allocatable, target :: alpha(:, :)
    type(fuge_info) :: info
    integer :: k, status

    r = 1.25_dp*contact%radius*[(real(k, dp)/real(2*RINGS, dp), k=0, 2*RINGS)]
    radius = r(::2)
    call tip%evaluate(r, height, slopes, status)
    do k = 1, RINGS
      gap(k) = (r(2*k - 2)*height(2*k - 2) + 4.0_dp*r(2*k - 1)*height(2*k - 1) + r(2*k)*height(2*k)) &
               /(3.0_dp*(radius(k - 1) + radius(k)))
    end do
    allocate (alpha(RINGS, RINGS))
    call fuge_ring_matrix(radius, E_STAR, FUGE_MEAN, alpha, info)
    if (info%failed()) error stop 'no matrix of rings'
    call fuge_solve_dense(alpha, gap, contact%load, force, opening, approach, info)
    if (info%status /= FUGE_DONE) error stop 'the rings were not solved'
    difference = approach/contact%approach - 1.0_dp
  end function difference_on_rings

end program indenter
