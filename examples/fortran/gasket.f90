!> A flange ring bolted on its gasket, under internal pressure.
!>
!>     gasket [folder for its tables]
!>
!> The gasket is a bed that presses only, a compliance for each station around the ring; a bolt is a spring that pulls
!> only, a tied point (a play of 0) whose limit of the pushing force is 0. The ring is a body of beam elements that is
!> condensed to its stations, with gasket and bolts on the same circle. For tightening, the bolts' force is limited to
!> the preload, and what they give way at this limit is taken off their stretch. Then the pressure inside lifts the
!> ring: the bolts take little of the thrust until the gasket opens. In the end they yield.
!>
!> Known: with a rigid ring the joint diagram of machine elements, load factor c_b/(c_b + c_g). With an elastic one,
!> as long as all of the gasket is pressed, the Fourier series of a ring on an elastic foundation; and straightened to
!> a beam, M. Hetenyi's closed form (Beams on Elastic Foundation, 1946). Forces in N, lengths in mm.
!> For the picture it writes gasket_pressure.csv and gasket_load.csv.
program gasket
  use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_value
  use example_output, only: create_file
  use example_verdict, only: verdict
  use fuge, only: dp => fuge_dp, fuge_condensed, fuge_dense_operator, fuge_info, fuge_options, fuge_problem, &
    fuge_solution, fuge_solver, FUGE_ERR_NO_EQUILIBRIUM, FUGE_LIMITED_UPPER
  use gasket_ring, only: condense_ring, flange_ring
  use gasket_theory, only: beam_pressure, linear_joint
  implicit none

  real(dp), parameter :: PI = acos(-1.0_dp)
  integer, parameter :: STATIONS = 96
  !> A steel ring of 65 mm x 24 mm, torsion of the rectangle after Saint-Venant.
  real(dp), parameter :: RADIUS = 150.0_dp, BENDING = 2.1e5_dp*65.0_dp*24.0_dp**3/12.0_dp, &
    TORSION = 8.1e4_dp*0.256_dp*65.0_dp*24.0_dp**3
  !> Of the gasket: modulus 600 N/mm2, 50 mm wide, 2 mm thick. Force per length and deflection.
  real(dp), parameter :: WIDTH = 50.0_dp, FOUNDATION = 600.0_dp*WIDTH/2.0_dp
  !> All bolts together, whatever their number: 1960 mm2, as 8 bolts M20 have, 60 mm long, tightened to 480 kN.
  real(dp), parameter :: BOLT_STIFFNESS = 2.1e5_dp*1960.0_dp/60.0_dp, PRELOAD = 4.8e5_dp
  !> All bolts yield at this force.
  real(dp), parameter :: YIELD = 6.0e5_dp
  integer, parameter :: COUNTS(3) = [4, 8, 16]
  !> Thrusts of the internal pressure, N, and the one whose pressures are shown.
  integer, parameter :: STEPS = 50
  real(dp), parameter :: STEP = 2.0e4_dp, SHOWN = 2.4e5_dp
  !> The bed is lumped at the stations, and elements are straight.
  real(dp), parameter :: ALLOWED = 3.0e-4_dp, ROUNDING = 1.0e-10_dp
  !> Elements are far stiffer than the ring, which costs digits of its influence matrix.
  real(dp), parameter :: ROUNDING_OF_RING = 1.0e-7_dp
  type(fuge_options), parameter :: OPTIONS = fuge_options(tolerance=1.0e-8_dp)

  !> Stations, then bolts.
  type :: joint
    integer :: bolts = 0
    real(dp), allocatable :: alpha(:, :), modes(:, :), compliance(:)
    !> Displacement and resultant by the thrust 1.
    real(dp), allocatable :: displacement(:), resultant(:)
    !> How far gasket and bolts are pressed or stretched before the solve, negative and positive.
    real(dp), allocatable :: gap(:)
  end type joint

  call run()

contains

  subroutine run()
    type(verdict) :: known
    type(joint), target :: model
    integer :: file, pressures, j

    call create_file('gasket_load.csv', 1, file)
    write (file, '(a)') 'bolts,yield,thrust,force of all bolts,least pressure,exact'
    call create_file('gasket_pressure.csv', 1, pressures)
    write (pressures, '(a)') 'bolts,thrust,angle,pressure,exact'
    call rigid_ring(known)
    do j = 1, size(COUNTS)
      call compare_beam(COUNTS(j), known)
      call elastic_ring(COUNTS(j), file, pressures, model, known)
      if (COUNTS(j) /= 8) cycle
      call let_bolts_yield(model, file, known)
      call loosen_bolt(model, known)
    end do
    close (file)
    close (pressures)
    call known%give('joint diagram, ring and beam on a foundation')
  end subroutine run

  !> The joint diagram, up to the separation and beyond; bolts that yield, and what remains of their preload.
  subroutine rigid_ring(known)
    type(verdict), intent(inout) :: known
    integer, parameter :: BOLTS = 8
    type(joint), target :: model
    type(linear_joint) :: theory
    type(fuge_solution) :: solution
    type(fuge_info) :: info
    real(dp) :: exact, factor, separation, thrust
    integer :: k

    model = rigid_joint(BOLTS)
    factor = BOLT_STIFFNESS/(BOLT_STIFFNESS + 2.0_dp*PI*RADIUS*FOUNDATION)
    separation = PRELOAD/(1.0_dp - factor)
    theory = linear_joint(rigid=.true., bolts=BOLTS, foundation=FOUNDATION, preload=PRELOAD/BOLTS, &
                          bolt_compliance=BOLTS/BOLT_STIFFNESS, ring=flange_ring(radius=RADIUS))
    call tighten(model, known)
    print '(a,f6.3,a,f7.1,a)', 'Rigid ring: load factor', factor, ', separation at', 1.0e-3_dp*separation, ' kN'
    call known%compare(theory%opening_thrust()/separation - 1.0_dp, ROUNDING, 'separation of a rigid ring')
    do k = 0, STEPS
      thrust = STEP*real(k, dp)
      exact = max(PRELOAD + factor*thrust, thrust)
      call press(model, thrust, huge(1.0_dp), solution, info)
      if (info%status /= 0) call give_up(info)
      call known%compare(-sum(solution%force(STATIONS + 1:))/exact - 1.0_dp, ROUNDING, 'bolts of a rigid ring')
      call known%compare((sum(solution%force(:STATIONS)) - exact + thrust)/PRELOAD, ROUNDING, 'gasket of a rigid ring')
    end do
    ! Once they have yielded, the bolts give up the thrust's share of their yield force when it is gone.
    thrust = 5.0e5_dp
    call press(model, thrust, YIELD, solution, info)
    if (info%status /= 0) call give_up(info)
    call known%compare(-sum(solution%force(STATIONS + 1:))/YIELD - 1.0_dp, ROUNDING, 'bolts of a rigid ring that yield')
    call stretch_bolts(model, solution)
    call press(model, 0.0_dp, YIELD, solution, info)
    if (info%status /= 0) call give_up(info)
    exact = YIELD - factor*thrust
    call known%compare(-sum(solution%force(STATIONS + 1:))/exact - 1.0_dp, ROUNDING, 'preload after yielding')
    print '(2(a,f6.1))', 'Bolts that have yielded at 500 kN: preload after it [kN]', &
      -1.0e-3_dp*sum(solution%force(STATIONS + 1:)), ', by hand', 1.0e-3_dp*exact
  end subroutine rigid_ring

  !> The ring straightened to a beam, tightened: pressures at all stations by Hetenyi.
  subroutine compare_beam(bolts, known)
    integer, intent(in) :: bolts
    type(verdict), intent(inout) :: known
    type(joint), target :: model
    type(fuge_solution) :: solution
    type(fuge_info) :: info
    real(dp) :: force, pitch, exact(STATIONS)
    integer :: k

    pitch = 2.0_dp*PI*RADIUS/real(bolts, dp)
    force = PRELOAD/real(bolts, dp)
    exact = [(beam_pressure(force, pitch, BENDING, FOUNDATION, modulo(pitch*real((k - 1)*bolts, dp)/STATIONS, pitch)), &
              k=1, STATIONS)]
    ! Beams between few bolts lift off; then the closed form does not hold.
    if (any(exact < 0.0_dp)) return
    model = elastic_joint(flange_ring(RADIUS, BENDING, TORSION, straight=.true.), bolts)
    call tighten(model, known)
    call press(model, 0.0_dp, huge(1.0_dp), solution, info)
    if (info%status /= 0) call give_up(info)
    call known%compare((line_pressure(solution) - exact)/maxval(exact), ALLOWED, 'a beam by Hetenyi')
    print '(i0,a,es8.1)', bolts, ' bolts on a straight beam: largest error of the pressure', &
      maxval(abs(line_pressure(solution) - exact))/maxval(exact)
  end subroutine compare_beam

  subroutine elastic_ring(bolts, file, pressures, model, known)
    integer, intent(in) :: bolts, file, pressures
    type(joint), intent(out), target :: model
    type(verdict), intent(inout) :: known
    type(linear_joint) :: theory
    type(fuge_solution) :: solution
    type(fuge_info) :: info
    real(dp) :: thrust
    integer :: k

    theory = linear_joint(flange_ring(RADIUS, BENDING, TORSION), bolts=bolts, foundation=FOUNDATION, &
                          preload=PRELOAD/bolts, bolt_compliance=bolts/BOLT_STIFFNESS)
    model = elastic_joint(theory%ring, bolts)
    call tighten(model, known)
    call compare_opening(model, theory, known)
    print '(/,i0,a)', bolts, ' bolts'
    print '(a)', 'thrust [kN]  bolts [kN]  exact  pressure at a bolt  exact   midway  exact [N/mm2]   open'
    do k = 0, STEPS
      thrust = STEP*real(k, dp)
      call press(model, thrust, huge(1.0_dp), solution, info)
      if (info%status /= 0) call give_up(info)
      call write_load(file, theory, 0.0_dp, thrust, solution)
      if (mod(k, 6) == 0) call print_load(theory, thrust, solution)
      if (nint(thrust) == 0 .or. nint(thrust) == nint(SHOWN)) call write_pressures(pressures, theory, thrust, solution)
      call compare_ring(theory, thrust, solution, known)
    end do
  end subroutine elastic_ring

  !> Forces as long as the gasket is pressed everywhere, and once it is open everywhere.
  subroutine compare_ring(theory, thrust, solution, known)
    type(linear_joint), intent(in) :: theory
    real(dp), intent(in) :: thrust
    type(fuge_solution), intent(in) :: solution
    type(verdict), intent(inout) :: known
    real(dp) :: exact(STATIONS), pressure(STATIONS)
    integer :: k

    call known%compare((sum(solution%force) + thrust)/PRELOAD, ROUNDING, 'equilibrium')
    pressure = line_pressure(solution)
    if (.not. any(pressure > 0.0_dp)) then
      call known%compare(maxval(abs(-solution%force(STATIONS + 1:)*theory%bolts/thrust - 1.0_dp)), ROUNDING_OF_RING, &
                         'open everywhere')
    else if (thrust < 0.99_dp*theory%opening_thrust()) then
      exact = [(theory%pressure(thrust, 2.0_dp*PI*real(k - 1, dp)/STATIONS), k=1, STATIONS)]
      call known%compare(maxval(abs(pressure - exact))*2.0_dp*PI*RADIUS/PRELOAD, ALLOWED, 'pressure of the gasket')
      call known%compare(maxval(abs(-solution%force(STATIONS + 1:)/theory%bolt_force(thrust) - 1.0_dp)), ALLOWED, &
                         'force of a bolt')
    end if
  end subroutine compare_ring

  !> The nuts after tightening, and the thrust at which the gasket opens midway between the bolts.
  subroutine compare_opening(model, theory, known)
    type(joint), intent(in), target :: model
    type(linear_joint), intent(in) :: theory
    type(verdict), intent(inout) :: known
    type(fuge_solution) :: solution
    type(fuge_info) :: info

    ! Few bolts open it while they are tightened.
    if (theory%opening_thrust() < 0.0_dp) then
      call press(model, 0.0_dp, huge(1.0_dp), solution, info)
      if (info%status /= 0) call give_up(info)
      call known%hold(any(.not. solution%force(:STATIONS) > 0.0_dp), 'tightened bolts open the gasket between them')
      return
    end if
    call known%compare(maxval(abs(model%gap(STATIONS + 1:)/theory%stretch() - 1.0_dp)), ALLOWED, 'turn of the nuts')
    call press(model, (1.0_dp - ALLOWED)*theory%opening_thrust(), huge(1.0_dp), solution, info)
    if (info%status /= 0) call give_up(info)
    call known%hold(all(solution%force(:STATIONS) > 0.0_dp), 'closed before the thrust that opens it')
    call press(model, (1.0_dp + ALLOWED)*theory%opening_thrust(), huge(1.0_dp), solution, info)
    if (info%status /= 0) call give_up(info)
    call known%hold(any(.not. solution%force(:STATIONS) > 0.0_dp), 'open beyond the thrust that opens it')
  end subroutine compare_opening

  !> Bolts that yield keep their force; the thrust that all of them carry is the greatest.
  subroutine let_bolts_yield(model, file, known)
    type(joint), intent(in), target :: model
    integer, intent(in) :: file
    type(verdict), intent(inout) :: known
    type(linear_joint) :: theory
    type(fuge_solution) :: solution
    type(fuge_info) :: info
    real(dp) :: thrust
    integer :: k

    theory = linear_joint(flange_ring(RADIUS, BENDING, TORSION), bolts=model%bolts, foundation=FOUNDATION, &
                          preload=PRELOAD/model%bolts, bolt_compliance=model%bolts/BOLT_STIFFNESS)
    do k = 0, STEPS
      thrust = STEP*real(k, dp)
      if (thrust > 0.999_dp*YIELD) exit
      call press(model, thrust, YIELD, solution, info)
      if (info%status /= 0) call give_up(info)
      call write_load(file, theory, YIELD, thrust, solution)
      if (all(solution%state(STATIONS + 1:) == FUGE_LIMITED_UPPER)) call known%compare( &
        (sum(solution%force(:STATIONS)) - (YIELD - thrust))/YIELD, ROUNDING, 'gasket below bolts that yield')
    end do
    call press(model, 1.001_dp*YIELD, YIELD, solution, info)
    call known%hold(info%status == FUGE_ERR_NO_EQUILIBRIUM, 'a thrust beyond the yield force is refused')
    print '(/,a)', trim(info%message)
  end subroutine let_bolts_yield

  !> A nut that stands off the ring carries nothing until the ring has lifted so far.
  subroutine loosen_bolt(model, known)
    type(joint), intent(in), target :: model
    type(verdict), intent(inout) :: known
    integer, parameter :: LOOSE = STATIONS + 1
    real(dp), parameter :: SLACK = 0.05_dp
    type(joint), target :: loosened
    type(fuge_solution) :: solution
    type(fuge_info) :: info
    real(dp) :: exact
    integer :: k

    loosened = model
    loosened%gap(LOOSE) = -SLACK
    do k = 0, STEPS, STEPS/2
      call press(loosened, STEP*real(k, dp), huge(1.0_dp), solution, info)
      if (info%status /= 0) call give_up(info)
      print '(a,f6.0,2(a,f7.1))', 'One bolt loose, thrust [kN]', 1.0e-3_dp*STEP*real(k, dp), ': its force', &
        1.0e-3_dp*abs(solution%force(LOOSE)), ', of the next one', 1.0e-3_dp*abs(solution%force(LOOSE + 1))
      ! The gasket at this bolt tells how far the ring is up: less than nothing where it is pressed.
      exact = max(0.0_dp, solution%gap(1) - solution%force(1)*model%compliance(1) - SLACK)/model%compliance(LOOSE)
      call known%compare((solution%force(LOOSE) + exact)*model%bolts/PRELOAD, ROUNDING, 'a loose bolt')
    end do
  end subroutine loosen_bolt

  !> A ring of no compliance, that moves up and down only.
  function rigid_joint(bolts) result(model)
    integer, intent(in) :: bolts
    type(joint), target :: model
    integer :: n

    n = STATIONS + bolts
    allocate (model%alpha(n, n), source=0.0_dp)
    allocate (model%modes(n, 1), source=1.0_dp)
    model%displacement = spread(0.0_dp, 1, n)
    ! The contact forces press the ring upwards, as the thrust does.
    model%resultant = [-1.0_dp]
    call add_springs(bolts, model)
  end function rigid_joint

  function elastic_joint(ring, bolts) result(model)
    type(flange_ring), intent(in) :: ring
    integer, intent(in) :: bolts
    type(joint), target :: model
    type(fuge_condensed) :: condensed
    type(fuge_info) :: info
    integer :: k

    call condense_ring(ring, STATIONS, condensed, info)
    if (info%status /= 0) call give_up(info)
    ! A bolt moves with the station at which it stands.
    associate (at => [(k, k=1, STATIONS), (1 + (k - 1)*(STATIONS/bolts), k=1, bolts)])
      model%alpha = condensed%alpha(at, at)
      model%modes = condensed%modes(at, :)
      model%displacement = condensed%displacement(at)
    end associate
    model%resultant = condensed%resultant
    call add_springs(bolts, model)
  end function elastic_joint

  subroutine add_springs(bolts, model)
    integer, intent(in) :: bolts
    type(joint), intent(inout), target :: model

    model%bolts = bolts
    model%compliance = [spread(real(STATIONS, dp)/(2.0_dp*PI*RADIUS*FOUNDATION), 1, STATIONS), &
                        spread(real(bolts, dp)/BOLT_STIFFNESS, 1, bolts)]
    model%gap = spread(0.0_dp, 1, STATIONS + bolts)
  end subroutine add_springs

  !> Turn the nuts until each bolt has its preload: from bolts stretched by far more, limited to this force.
  subroutine tighten(model, known)
    type(joint), intent(inout), target :: model
    type(verdict), intent(inout) :: known
    type(fuge_solution) :: solution
    type(fuge_info) :: info

    model%gap(STATIONS + 1:) = 100.0_dp*PRELOAD/BOLT_STIFFNESS
    call press(model, 0.0_dp, PRELOAD, solution, info)
    if (info%status /= 0) call give_up(info)
    call stretch_bolts(model, solution)
    call press(model, 0.0_dp, huge(1.0_dp), solution, info)
    if (info%status /= 0) call give_up(info)
    call known%compare(maxval(abs(-solution%force(STATIONS + 1:)*model%bolts/PRELOAD - 1.0_dp)), ROUNDING_OF_RING, &
                       'preload')
  end subroutine tighten

  !> What bolts at their limits have given way stays.
  subroutine stretch_bolts(model, solution)
    type(joint), intent(inout), target :: model
    type(fuge_solution), intent(in) :: solution

    model%gap(STATIONS + 1:) = model%gap(STATIONS + 1:) - max(0.0_dp, solution%gap(STATIONS + 1:))
  end subroutine stretch_bolts

  !> The joint under a thrust; `limit` is that of all bolts together, none if it is huge.
  subroutine press(model, thrust, limit, solution, info)
    type(joint), intent(in), target :: model
    real(dp), intent(in) :: thrust, limit
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(out) :: info
    type(fuge_dense_operator) :: operator
    type(fuge_problem) :: problem
    type(fuge_solver) :: solver
    real(dp) :: infinite, most

    infinite = ieee_value(infinite, ieee_positive_inf)
    most = infinite
    if (limit < huge(limit)) most = limit/real(model%bolts, dp)
    call operator%set(model%alpha, info)
    if (info%failed()) return
    problem%gap = model%gap + thrust*model%displacement
    problem%compliance = model%compliance
    problem%modes = model%modes
    problem%resultant = thrust*model%resultant
    ! The gasket presses without a limit and has no second stop; bolts pull, and do not press.
    problem%gap_upper = [spread(infinite, 1, STATIONS), spread(0.0_dp, 1, model%bolts)]
    problem%limit = [spread(infinite, 1, STATIONS), spread(0.0_dp, 1, model%bolts)]
    problem%limit_upper = [spread(infinite, 1, STATIONS), spread(most, 1, model%bolts)]
    call solver%solve(operator, problem, solution, info, OPTIONS)
  end subroutine press

  !> Force per length of the gasket at each station.
  pure function line_pressure(solution) result(pressure)
    type(fuge_solution), intent(in) :: solution
    real(dp) :: pressure(STATIONS)

    pressure = solution%force(:STATIONS)*real(STATIONS, dp)/(2.0_dp*PI*RADIUS)
  end function line_pressure

  !> In kN and N/mm2; `limit` is zero where bolts do not yield.
  subroutine write_load(file, theory, limit, thrust, solution)
    integer, intent(in) :: file
    type(linear_joint), intent(in) :: theory
    real(dp), intent(in) :: limit, thrust
    type(fuge_solution), intent(in) :: solution

    write (file, '(i0,5('','',es14.6))') theory%bolts, 1.0e-3_dp*limit, 1.0e-3_dp*thrust, &
      -1.0e-3_dp*sum(solution%force(STATIONS + 1:)), minval(line_pressure(solution))/WIDTH, &
      theory%pressure(thrust, PI/theory%bolts)/WIDTH
  end subroutine write_load

  subroutine print_load(theory, thrust, solution)
    type(linear_joint), intent(in) :: theory
    real(dp), intent(in) :: thrust
    type(fuge_solution), intent(in) :: solution
    character(len=7) :: exact(3)
    real(dp) :: pressure(STATIONS)

    exact = '-'
    if (thrust < theory%opening_thrust()) then
      write (exact(1), '(f7.1)') 1.0e-3_dp*theory%bolts*theory%bolt_force(thrust)
      write (exact(2), '(f7.3)') theory%pressure(thrust, 0.0_dp)/WIDTH
      write (exact(3), '(f7.3)') theory%pressure(thrust, PI/theory%bolts)/WIDTH
    end if
    pressure = line_pressure(solution)/WIDTH
    print '(f11.0,f12.1,a7,f20.3,a7,f9.3,a7,f15.3)', 1.0e-3_dp*thrust, -1.0e-3_dp*sum(solution%force(STATIONS + 1:)), &
      adjustr(exact(1)), pressure(1), adjustr(exact(2)), pressure(1 + STATIONS/(2*theory%bolts)), adjustr(exact(3)), &
      open_share(solution)
  end subroutine print_load

  !> The share of the stations that are open.
  pure function open_share(solution) result(share)
    type(fuge_solution), intent(in) :: solution
    real(dp) :: share

    share = real(count(.not. solution%force(:STATIONS) > 0.0_dp), dp)/real(STATIONS, dp)
  end function open_share

  !> Along a quarter of the ring, in degrees and N/mm2.
  subroutine write_pressures(file, theory, thrust, solution)
    integer, intent(in) :: file
    type(linear_joint), intent(in) :: theory
    real(dp), intent(in) :: thrust
    type(fuge_solution), intent(in) :: solution
    character(len=14) :: exact
    real(dp) :: angle, pressure(STATIONS)
    integer :: k

    pressure = line_pressure(solution)
    do k = 1, STATIONS/4 + 1
      angle = 2.0_dp*PI*real(k - 1, dp)/real(STATIONS, dp)
      exact = ''
      if (thrust < theory%opening_thrust()) write (exact, '(es14.6)') theory%pressure(thrust, angle)/WIDTH
      write (file, '(i0,3('','',es14.6),'','',a)') theory%bolts, 1.0e-3_dp*thrust, angle*180.0_dp/PI, &
        pressure(k)/WIDTH, exact
    end do
  end subroutine write_pressures

  subroutine give_up(info)
    type(fuge_info), intent(in) :: info

    print '(a)', trim(info%message)
    error stop 'the joint was not solved'
  end subroutine give_up

end program gasket
