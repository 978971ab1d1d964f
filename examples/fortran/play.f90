!> A shaft in a bush with clearance: supports on both sides, 0 <= c <= d.
!>
!>     play [folder for its table]
!>
!> The bush holds the shaft at nine places, with half of the clearance d above and half below;
!> a weight P hangs at the overhanging end. A force of the lower side pushes the shaft up and
!> counts positive, one of the upper side pushes it down and is negative.
!> First the shaft is clamped at x = 0: under a small load nothing touches, then it lies on the
!> lower side at the outer end of the bush, bends upwards behind it and meets the upper side,
!> which moves outwards as the load grows. Then it is free to sink and to tilt, and only the
!> bush holds it.
!> The table play.csv has forces and gaps over the load.
program play
  use example_output, only: create_file
  use fuge, only: dp => fuge_dp, fuge_dense_operator, fuge_info, fuge_problem, fuge_solution, fuge_solver
  implicit none

  !> N, mm: a steel shaft of 20 mm diameter.
  integer, parameter :: SUPPORTS = 9, STEPS = 600
  real(dp), parameter :: PI = acos(-1.0_dp)
  real(dp), parameter :: STIFFNESS = 2.1e5_dp*PI*20.0_dp**4/64.0_dp
  real(dp), parameter :: FIRST_AT = 200.0_dp, LAST_AT = 400.0_dp, WEIGHT_AT = 600.0_dp
  real(dp), parameter :: CLEARANCE = 0.1_dp, STEP = 2.0_dp

  call run()

contains

  subroutine run()
    real(dp), target :: alpha(SUPPORTS, SUPPORTS)
    real(dp) :: x(SUPPORTS)
    type(fuge_dense_operator) :: operator
    type(fuge_info) :: info
    integer :: file, k

    x = [(FIRST_AT + (LAST_AT - FIRST_AT)*real(k - 1, dp)/real(SUPPORTS - 1, dp), k=1, SUPPORTS)]
    do k = 1, SUPPORTS
      alpha(:, k) = deflection(x, x(k))
    end do
    call operator%set(alpha, info)
    if (info%failed()) error stop 'no influence matrix'

    call create_file('play.csv', 1, file)
    write (file, '(a,18(a,i0))') 'shaft,P [N]', (',f', k, k=1, SUPPORTS), (',c', k, k=1, SUPPORTS)
    print '(a)', 'The shaft clamped at x = 0'
    call raise_load(operator, x, clamped_shaft(), 'clamped', file)
    print '(/,a)', 'The shaft held by the bush only'
    call raise_load(operator, x, free_shaft(x), 'free', file)
    close (file)
  end subroutine run

  !> Deflection at x by a unit force at s of a beam clamped at 0.
  elemental function deflection(x, s)
    real(dp), intent(in) :: x, s
    real(dp) :: deflection

    deflection = min(x, s)**2*(3.0_dp*max(x, s) - min(x, s))/(6.0_dp*STIFFNESS)
  end function deflection

  !> No rigid motion: the clamp carries what the bush does not.
  pure function clamped_shaft() result(problem)
    type(fuge_problem) :: problem

    allocate (problem%gap(SUPPORTS), problem%gap_upper(SUPPORTS), problem%modes(SUPPORTS, 0), problem%resultant(0))
    problem%gap_upper = CLEARANCE
  end function clamped_shaft

  !> It may sink and tilt, R = [1, x]. The influence coefficients still contain the clamp, but forces
  !> in equilibrium do not load it, and its release is a rigid motion.
  pure function free_shaft(x) result(problem)
    real(dp), intent(in) :: x(:)
    type(fuge_problem) :: problem

    allocate (problem%gap(SUPPORTS), problem%gap_upper(SUPPORTS), problem%modes(SUPPORTS, 2), problem%resultant(2))
    problem%gap_upper = CLEARANCE
    problem%modes(:, 1) = 1.0_dp
    problem%modes(:, 2) = x
  end function free_shaft

  !> The weight bends the shaft, which changes the gaps. Prints a line for every load at which the set of
  !> supports that carry changes.
  subroutine raise_load(operator, x, scene, name, file)
    type(fuge_dense_operator), intent(in) :: operator
    real(dp), intent(in) :: x(:)
    type(fuge_problem), intent(in) :: scene
    character(len=*), intent(in) :: name
    integer, intent(in) :: file
    type(fuge_problem) :: problem
    type(fuge_solution) :: solution, again
    type(fuge_solver) :: warm, cold
    character(len=SUPPORTS) :: carries, before
    real(dp) :: load
    logical :: free
    integer :: k, sets(2)

    print '(a,/,a)', '  lower side: +, upper side: -, none: .', '   P [N]   supports  forces [N]'
    problem = scene
    free = size(scene%resultant) > 0
    before = ''
    sets = 0
    do k = 1, STEPS
      load = STEP*real(k, dp)
      problem%gap = 0.5_dp*CLEARANCE - load*deflection(x, WEIGHT_AT)
      if (free) problem%resultant = load*[1.0_dp, WEIGHT_AT]
      call press(warm, operator, problem, solution, sets(1))
      call cold%reset()
      call press(cold, operator, problem, again, sets(2))
      if (any(abs(again%force - solution%force) > 1.0e-6_dp*load)) error stop 'the start changes the answer'
      if (free) then
        call check_free(x, load, solution)
      else
        call check_clamped(x, load, solution)
      end if
      write (file, '(a,'','',f8.1,18('','',es12.4))') name, load, solution%force, solution%gap
      carries = signs(solution%force)
      if (carries /= before) print '(f8.0,2x,a,9f9.1)', load, carries, solution%force
      before = carries
    end do
    print '(a,i0,a,9f9.3)', '  gaps at ', nint(load), ' N [mm]', solution%gap
    print '(3(a,i0))', '  contact sets tried for ', STEPS, ' loads: ', sets(1), ', each from scratch ', sets(2)
  end subroutine raise_load

  subroutine press(solver, operator, problem, solution, sets)
    type(fuge_solver), intent(inout) :: solver
    type(fuge_dense_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(inout) :: solution
    integer, intent(inout) :: sets
    type(fuge_info) :: info

    call solver%solve(operator, problem, solution, info)
    if (info%status /= 0) error stop 'the shaft was not solved'
    sets = sets + info%iterations
  end subroutine press

  pure function signs(force)
    real(dp), intent(in) :: force(:)
    character(len=SUPPORTS) :: signs
    integer :: k

    signs = repeat('.', SUPPORTS)
    do k = 1, SUPPORTS
      if (force(k) > 0.0_dp) signs(k:k) = '+'
      if (force(k) < 0.0_dp) signs(k:k) = '-'
    end do
  end function signs

  !> Until the upper side touches, statics of the cantilever with one prop.
  subroutine check_clamped(x, load, solution)
    real(dp), intent(in) :: x(:), load
    type(fuge_solution), intent(in) :: solution
    real(dp) :: expected(SUPPORTS), prop

    prop = (load*deflection(x(SUPPORTS), WEIGHT_AT) - 0.5_dp*CLEARANCE)/deflection(x(SUPPORTS), x(SUPPORTS))
    expected = 0.0_dp
    expected(SUPPORTS) = max(0.0_dp, prop)
    if (load < load_of_upper_side(x)) then
      if (any(abs(solution%force - expected) > 1.0e-9_dp*load)) error stop 'the prop does not carry what it should'
    else
      if (.not. any(solution%force < 0.0_dp)) error stop 'the upper side does not carry'
    end if
  end subroutine check_clamped

  !> On the prop the shaft rises elsewhere by its share of the prop's force less the weight's.
  pure function load_of_upper_side(x) result(load)
    real(dp), intent(in) :: x(:)
    real(dp) :: load
    real(dp) :: share, rise
    integer :: k

    load = huge(load)
    do k = 1, SUPPORTS - 1
      share = deflection(x(k), x(SUPPORTS))/deflection(x(SUPPORTS), x(SUPPORTS))
      rise = share*deflection(x(SUPPORTS), WEIGHT_AT) - deflection(x(k), WEIGHT_AT)
      if (rise > 0.0_dp) load = min(load, 0.5_dp*CLEARANCE*(1.0_dp + share)/rise)
    end do
  end function load_of_upper_side

  !> Equilibrium, and levers while the shaft is all but straight: it touches at both ends.
  subroutine check_free(x, load, solution)
    real(dp), intent(in) :: x(:), load
    type(fuge_solution), intent(in) :: solution
    real(dp) :: expected(SUPPORTS)

    if (abs(sum(solution%force) - load) > 1.0e-9_dp*load) error stop 'no equilibrium of forces'
    if (abs(sum(solution%force*x) - load*WEIGHT_AT) > 1.0e-9_dp*load*WEIGHT_AT) error stop 'no equilibrium of moments'
    if (load > STEP) return
    expected = 0.0_dp
    expected(1) = -load*(WEIGHT_AT - LAST_AT)/(LAST_AT - FIRST_AT)
    expected(SUPPORTS) = load*(WEIGHT_AT - FIRST_AT)/(LAST_AT - FIRST_AT)
    if (any(abs(solution%force - expected) > 1.0e-9_dp*load)) error stop 'the lever does not hold'
  end subroutine check_free

end program play
