!> A shaft of 40.005 mm pressed into a hub of 40.000 mm, by meshes that do not match, against Lame's solution.
!>
!>     shaft_hub [folder for its tables]
!>
!> The fit of issue 98 of CalculiX: the shaft has a bore of 20 mm, the hub is 60 mm wide, and the pressure in the joint
!> is 5.74 N/mm2. Young's modulus is not given there; 196 000 N/mm2, for both, makes Lame's pressure 5.742 N/mm2. It
!> does not depend on Poisson's ratio, since both have the same.
!>
!> The interference is an eight-thousandth of the radius: the chord of a circle in 64 parts is 0.024 mm high, ten times
!> as much. So polygons taken as they are leave gaps, or penetrate by far too much, wherever their corners do not meet.
!> The smooth surfaces that they stand for (options%smooth, the default) leave neither: all nodes have the same
!> pressure. The difference from Lame's pressure is the error of the elements, as meshes that match show.
!>
!> First in plane stress: whole rings, which float and turn freely, and quarters with supports at the planes of
!> symmetry. Then the section of both tubes, as bodies of revolution.
!> Tables: shaft_hub_pressure.csv, index | angle | pressure of some of the meshes, for a picture.
program shaft_hub
  use elastic_elements, only: mesh_stiffness, AXISYMMETRIC, PLANE_STRESS
  use example_output, only: create_file
  use example_verdict, only: verdict
  use fuge, only: dp => fuge_dp, fuge_bodies_contact, fuge_dense_stiffness, fuge_elastic_body, fuge_info, &
    fuge_solve_bodies, fuge_surface_pair, FUGE_MORTAR, FUGE_NODE_TO_FACE
  use shaft_hub_mesh, only: make_ring, make_section, mesh_kind, plane_body
  implicit none

  real(dp), parameter :: PI = acos(-1.0_dp)
  !> N, mm.
  real(dp), parameter :: YOUNG = 196.0e3_dp, POISSON = 0.3_dp, RADIUS = 20.0_dp, BORE = 10.0_dp, RIM = 30.0_dp
  real(dp), parameter :: INTERFERENCE = 0.0025_dp, LENGTH = 20.0_dp
  !> Lame: both tubes have the same modulus.
  real(dp), parameter :: PRESSURE = INTERFERENCE*YOUNG/RADIUS/((RADIUS**2 + BORE**2)/(RADIUS**2 - BORE**2) &
    + (RIM**2 + RADIUS**2)/(RIM**2 - RADIUS**2))
  !> The error allowed at each node.
  real(dp), parameter :: ALLOWED = 0.005_dp

  !> A pair of meshes, and how their surfaces are paired.
  type :: choice
    character(len=44) :: name = ''
    type(mesh_kind) :: kind
    !> Elements around the shaft and around the hub; of a quarter a fourth of them. Across each of them.
    integer :: shaft = 64, hub = 96, across = 5
    logical :: quarter = .false.
    !> Nodes of the hub, not of the shaft, are the contact points.
    logical :: from_hub = .false.
    !> Corners of the shaft face corners of the hub.
    logical :: match = .false.
    logical :: smooth = .true.
    integer :: method = FUGE_MORTAR
    !> In the picture.
    integer :: curve = 0
  end type choice

  !> Plain elements and others.
  type(mesh_kind), parameter :: LINEAR = mesh_kind(1), QUADRATIC = mesh_kind(2)
  integer, parameter :: GOOD = 17
  type(choice), parameter :: MESHES(GOOD) = [ &
    choice('linear, 24 and 36', LINEAR, 24, 36), &
    choice('linear, 36 and 24', LINEAR, 36, 24), &
    choice('linear, 64 and 64, nodes opposite', LINEAR, 64, 64, match=.true.), &
    choice('linear, 64 and 64, half a step apart', LINEAR, 64, 64), &
    choice('linear, 64 and 96', LINEAR, 64, 96, curve=1), &
    choice('linear, 96 and 64', LINEAR, 96, 64), &
    choice('linear, 64 and 96, nodes of the hub', LINEAR, 64, 96, from_hub=.true.), &
    choice('linear, 40 and 100', LINEAR, 40, 100), &
    choice('linear, 100 and 40', LINEAR, 100, 40), &
    choice('linear, 64 and 96, sizes 1:3', mesh_kind(1, grading=0.5_dp), 64, 96), &
    choice('linear triangles, 64 and 96', mesh_kind(1, .true.), 64, 96), &
    choice('linear, 64 and 96, a quarter', LINEAR, 64, 96, quarter=.true.), &
    choice('quadratic, 24 and 36', QUADRATIC, 24, 36, 3, curve=2), &
    choice('quadratic, 36 and 24', QUADRATIC, 36, 24, 3), &
    choice('quadratic, 24 and 36, sizes 1:3', mesh_kind(2, grading=0.5_dp), 24, 36, 3), &
    choice('quadratic triangles, 24 and 36', mesh_kind(2, .true.), 24, 36, 3), &
    choice('quadratic, 24 and 36, a quarter', QUADRATIC, 24, 36, 3, quarter=.true.)]
  !> The errors without smooth surfaces or the mortar method.
  type(choice), parameter :: OTHERS(7) = [ &
    choice('linear, 64 and 96, faces as they are', LINEAR, 64, 96, smooth=.false., curve=3), &
    choice('linear, 96 and 64, faces as they are', LINEAR, 96, 64, smooth=.false., curve=4), &
    choice('quadratic, 24 and 36, faces as they are', QUADRATIC, 24, 36, 3, smooth=.false., curve=5), &
    choice('linear, 64 and 96, nodes against faces', LINEAR, 64, 96, method=FUGE_NODE_TO_FACE, curve=6), &
    choice('quadratic, 24 and 36, nodes against faces', QUADRATIC, 24, 36, 3, method=FUGE_NODE_TO_FACE, curve=7), &
    choice('linear, 12 and 16: elements too coarse', LINEAR, 12, 16), &
    choice('linear, 12 and 12, nodes opposite: so too', LINEAR, 12, 12, match=.true.)]
  !> Along the axis, with elements along the length.
  type(choice), parameter :: TUBES(4) = [ &
    choice('linear, 16 and 24', LINEAR, 16, 24, 16), &
    choice('linear, 24 and 16', LINEAR, 24, 16, 16), &
    choice('linear, 24 and 24, nodes opposite', LINEAR, 24, 24, 16), &
    choice('quadratic, 5 and 7', QUADRATIC, 5, 7, 2)]

  call run()

contains

  subroutine run()
    type(verdict) :: lame
    real(dp) :: error(2)
    integer :: file, k

    print '(a,f6.4,a)', 'Shaft of 40.005 mm in a hub of 40.000 mm, pressure by Lame ', PRESSURE, ' N/mm2'
    call create_file('shaft_hub_pressure.csv', 1, file)
    print '(/,a,a10,a13,a12,a11)', 'Plane stress'//repeat(' ', 32), 'points', 'mean off by', 'worst node', 'spread'
    do k = 1, size(MESHES)
      call solve(MESHES(k), .false., file, error)
      call lame%compare(error, ALLOWED, 'a pressure')
    end do
    print '(/,a)', 'Bodies of revolution, elements along the length'
    do k = 1, size(TUBES)
      call solve(TUBES(k), .true., file, error)
      call lame%compare(error, ALLOWED, 'a pressure')
    end do
    print '(/,a)', 'What misses Lame''s pressure: faces not smoothed, nodes against faces, coarse meshes'
    do k = 1, size(OTHERS)
      call solve(OTHERS(k), .false., file, error)
      if (abs(error(2)) < ALLOWED) error stop 'this was expected to fail'
    end do
    close (file)
    call lame%give('pressures against Lame')
  end subroutine run

  !> Press the fit, print a line of the table. `error`: of the mean pressure and of the worst node, relative.
  subroutine solve(mesh, revolution, file, error)
    type(choice), intent(in) :: mesh
    logical, intent(in) :: revolution
    integer, intent(in) :: file
    real(dp), intent(out) :: error(2)
    type(fuge_elastic_body) :: bodies(2)
    type(fuge_surface_pair) :: pair(1)
    type(fuge_dense_stiffness) :: stiffness
    type(fuge_bodies_contact) :: contact
    type(fuge_info) :: info
    real(dp), allocatable :: found(:)

    call make_bodies(mesh, revolution, bodies, pair(1))
    pair(1)%options%smooth = mesh%smooth
    ! Twelve elements around are still a circle.
    pair(1)%options%crease = 40.0_dp
    pair(1)%options%method = mesh%method
    pair(1)%options%revolution = revolution
    call fuge_solve_bodies(stiffness, bodies, pair, contact, info)
    if (info%failed()) error stop 'the contact was not solved'
    found = contact%pressure/PRESSURE - 1.0_dp
    error(1) = sum(contact%force)/sum(contact%pairs%area)/PRESSURE - 1.0_dp
    error(2) = found(maxloc(abs(found), 1))
    print '(a,i10,f11.3,a,f10.3,a,es11.1)', mesh%name, size(found), 100.0_dp*error(1), ' %', 100.0_dp*error(2), ' %', &
      maxval(found) - minval(found)
    if (mesh%curve > 0) call write_pressures(pair(1), contact, mesh%curve, file)
  end subroutine solve

  !> Meshes, stiffness and supports of both bodies; whole rings float, a quarter slides along the planes of symmetry.
  subroutine make_bodies(mesh, revolution, bodies, pair)
    type(choice), intent(in) :: mesh
    logical, intent(in) :: revolution
    type(fuge_elastic_body), intent(out) :: bodies(2)
    type(fuge_surface_pair), intent(out) :: pair
    type(plane_body) :: body(2)
    real(dp) :: apart, bounds(2, 2)
    integer :: around(2), i, k

    bounds = reshape([BORE, RADIUS + INTERFERENCE, RADIUS, RIM], [2, 2])
    around = [mesh%shaft, mesh%hub]
    do k = 1, 2
      apart = merge(0.0_dp, real(k - 1, dp)*PI/real(mesh%hub, dp), mesh%match .or. mesh%quarter)
      if (revolution) then
        call make_section(bounds(:, k), LENGTH, mesh%across, around(k), mesh%kind, body(k))
      else
        call make_ring(bounds(:, k), mesh%across, merge(around(k)/4, around(k), mesh%quarter), mesh%kind, &
                       mesh%quarter, apart, body(k))
      end if
      associate (b => bodies(k), x => body(k)%node)
        call mesh_stiffness(x, body(k)%element, merge(AXISYMMETRIC, PLANE_STRESS, revolution), YOUNG, POISSON, &
                            b%column, b%row, b%value)
        if (mesh%quarter) b%fixed = [pack([(2*i - 1, i=1, size(x, 2))], abs(x(1, :)) < 1.0e-9_dp*RIM), &
                                     pack([(2*i, i=1, size(x, 2))], abs(x(2, :)) < 1.0e-9_dp*RIM)]
      end associate
    end do
    pair%contact = body(1)%outside
    pair%opposite = body(2)%inside
    if (.not. mesh%from_hub) return
    pair%contact_body = 2
    pair%opposite_body = 1
    pair%contact = body(2)%inside
    pair%opposite = body(1)%outside
  end subroutine make_bodies

  !> The pressures of the first quarter, by angle.
  subroutine write_pressures(pair, contact, curve, file)
    type(fuge_surface_pair), intent(in) :: pair
    type(fuge_bodies_contact), intent(in) :: contact
    integer, intent(in) :: curve, file
    real(dp) :: angle(size(contact%force))
    integer :: i, k, last

    associate (node => contact%pairs%node)
      angle = [(180.0_dp/PI*atan2(pair%contact%node(2, node(i)), pair%contact%node(1, node(i))), i=1, size(node))]
    end associate
    last = 0
    do k = 1, size(angle)
      i = minloc(angle, 1, angle >= -1.0e-9_dp .and. angle <= 90.0_dp + 1.0e-9_dp)
      if (i == 0) exit
      write (file, '(i0,2('','',es14.6))') curve, angle(i), contact%pressure(i)
      angle(i) = huge(1.0_dp)
      last = i
    end do
    if (last == 0) error stop 'there is no contact point in the first quarter'
  end subroutine write_pressures

end program shaft_hub
