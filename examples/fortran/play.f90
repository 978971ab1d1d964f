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
!> At last the bush has a soft liner and holds the shaft everywhere, on 100 and 400 cells with a matrix and on 2**18
!> without one: the operator `lined_shaft` of play_shaft.f90 multiplies in a few operations for each cell.
!> The table play.csv has forces and gaps over the load.
program play
  use example_output, only: create_file
  use example_verdict, only: verdict
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge, only: dp => fuge_dp, fuge_dense_operator, fuge_info, fuge_operator, fuge_problem, fuge_solution, fuge_solver
  use play_shaft, only: deflection, lined_shaft, LINER_STIFFNESS
  implicit none

  !> N, mm.
  integer, parameter :: SUPPORTS = 9, STEPS = 600
  integer, parameter :: CELLS(3) = [100, 400, 2**18]
  real(dp), parameter :: FIRST_AT = 200.0_dp, LAST_AT = 400.0_dp, WEIGHT_AT = 600.0_dp
  real(dp), parameter :: CLEARANCE = 0.1_dp, STEP = 2.0_dp

  !> What a user wants to know of the shaft in its liner.
  type :: outcome
    !> Sinking and rotation at x = 0, if the shaft is free.
    real(dp) :: motion(2) = 0.0_dp
    !> Forces of the lower and of the upper side, the largest per length, and where the contact ends.
    real(dp) :: sides(2) = 0.0_dp, peaks(2) = 0.0_dp, edges(2) = 0.0_dp
    integer :: products = 0
    real(dp) :: seconds = 0.0_dp
  end type outcome

  call run()

contains

  subroutine run()
    real(dp), target :: alpha(SUPPORTS, SUPPORTS)
    real(dp) :: x(SUPPORTS)
    type(fuge_dense_operator) :: operator
    type(fuge_info) :: info
    type(verdict) :: statics
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
    call raise_load(operator, x, clamped_shaft(SUPPORTS), 'clamped', file, statics)
    print '(/,a)', 'The shaft held by the bush only'
    call raise_load(operator, x, free_shaft(x), 'free', file, statics)
    close (file)
    call line_bush(.false.)
    call line_bush(.true.)
    call statics%give('against statics')
  end subroutine run

  !> No rigid motion: the clamp carries what the bush does not.
  pure function clamped_shaft(n) result(problem)
    integer, intent(in) :: n
    type(fuge_problem) :: problem

    allocate (problem%gap(n), problem%gap_upper(n), problem%modes(n, 0), problem%resultant(0))
    problem%gap_upper = CLEARANCE
  end function clamped_shaft

  !> It may sink and tilt, R = [1, x]. The influence coefficients still contain the clamp, but forces
  !> in equilibrium do not load it, and its release is a rigid motion.
  pure function free_shaft(x) result(problem)
    real(dp), intent(in) :: x(:)
    type(fuge_problem) :: problem

    allocate (problem%gap(size(x)), problem%gap_upper(size(x)), problem%modes(size(x), 2), problem%resultant(2))
    problem%gap_upper = CLEARANCE
    problem%modes(:, 1) = 1.0_dp
    problem%modes(:, 2) = x
  end function free_shaft

  !> The weight bends the shaft, which changes the gaps. Prints a line for every load at which the set of
  !> supports that carry changes.
  subroutine raise_load(operator, x, scene, name, file, statics)
    type(fuge_dense_operator), intent(in) :: operator
    real(dp), intent(in) :: x(:)
    type(fuge_problem), intent(in) :: scene
    character(len=*), intent(in) :: name
    integer, intent(in) :: file
    type(verdict), intent(inout) :: statics
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
        call check_free(x, load, solution, statics)
      else
        call check_clamped(x, load, solution, statics)
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
  subroutine check_clamped(x, load, solution, statics)
    real(dp), intent(in) :: x(:), load
    type(fuge_solution), intent(in) :: solution
    type(verdict), intent(inout) :: statics
    real(dp) :: expected(SUPPORTS), prop

    prop = (load*deflection(x(SUPPORTS), WEIGHT_AT) - 0.5_dp*CLEARANCE)/deflection(x(SUPPORTS), x(SUPPORTS))
    expected = 0.0_dp
    expected(SUPPORTS) = max(0.0_dp, prop)
    if (load < load_of_upper_side(x)) then
      call statics%compare(maxval(abs(solution%force - expected))/load, 1.0e-9_dp, 'the force of the prop')
    else
      call statics%hold(any(solution%force < 0.0_dp), 'the upper side carries')
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
  subroutine check_free(x, load, solution, statics)
    real(dp), intent(in) :: x(:), load
    type(fuge_solution), intent(in) :: solution
    type(verdict), intent(inout) :: statics
    real(dp) :: expected(SUPPORTS)

    call statics%compare(sum(solution%force)/load - 1.0_dp, 1.0e-9_dp, 'the equilibrium of forces')
    call statics%compare(sum(solution%force*x)/(load*WEIGHT_AT) - 1.0_dp, 1.0e-9_dp, 'the equilibrium of moments')
    if (load > STEP) return
    expected = 0.0_dp
    expected(1) = -load*(WEIGHT_AT - LAST_AT)/(LAST_AT - FIRST_AT)
    expected(SUPPORTS) = load*(WEIGHT_AT - FIRST_AT)/(LAST_AT - FIRST_AT)
    call statics%compare(maxval(abs(solution%force - expected))/load, 1.0e-9_dp, 'the lever')
  end subroutine check_free

  !> The greatest load on the shaft in its liner, with more and more cells.
  subroutine line_bush(free)
    logical, intent(in) :: free
    type(outcome) :: found(size(CELLS))
    integer :: k

    if (free) then
      print '(/,a)', 'The shaft in a soft liner, held by the bush only, under 1200 N'
    else
      print '(/,a)', 'The shaft in a soft liner, clamped at x = 0, under 1200 N'
    end if
    print '(a8,a22,a22,a24,a24,a9,a9)', 'cells', 'lower, upper side [N]', 'their peaks [N/mm]', &
      'contact up to, from [mm]', 'at x = 0 [mm, mrad]', 'products', 'time [s]'
    do k = 1, size(CELLS)
      found(k) = press_in_liner(lined_shaft(CELLS(k), FIRST_AT, LAST_AT), free, k < size(CELLS))
      print '(i8,2f11.4,2f11.4,2f12.5,2f12.6,i9,f9.3)', CELLS(k), found(k)%sides, found(k)%peaks, found(k)%edges, &
        found(k)%motion*[1.0_dp, 1.0e3_dp], found(k)%products, found(k)%seconds
    end do
    ! Errors are of second order in the width of the cells: a sixteenth for a quarter.
    if (.not. converge(found%sides(1))) error stop 'the force of the lower side does not converge'
    if (.not. converge(found%peaks(1))) error stop 'the peak does not converge'
    if (free .and. .not. converge(found%motion(2))) error stop 'the rotation does not converge'
    if (free .and. any(abs(found%sides(1) + found%sides(2) - STEP*real(STEPS, dp)) > 1.0e-9_dp*STEP*real(STEPS, dp))) &
      error stop 'no equilibrium in the liner'
  end subroutine line_bush

  function press_in_liner(shaft, free, with_matrix) result(found)
    type(lined_shaft), intent(in) :: shaft
    logical, intent(in) :: free, with_matrix
    type(outcome) :: found
    real(dp), allocatable, target :: alpha(:, :)
    real(dp), allocatable :: x(:)
    type(fuge_dense_operator) :: dense
    type(fuge_problem) :: problem
    type(fuge_solution) :: solution
    type(fuge_info) :: info
    real(dp), parameter :: LOAD = STEP*real(STEPS, dp)
    integer :: k, n

    n = shaft%points()
    allocate (x(n))
    x = shaft%centres()
    if (free) then
      problem = free_shaft(x)
      problem%resultant = LOAD*[1.0_dp, WEIGHT_AT]
    else
      problem = clamped_shaft(n)
    end if
    problem%gap = 0.5_dp*CLEARANCE - LOAD*deflection(x, WEIGHT_AT)
    if (with_matrix) then
      allocate (alpha(n, n))
      do k = 1, n
        alpha(:, k) = deflection(x, x(k))
        alpha(k, k) = alpha(k, k) + 1.0_dp/(LINER_STIFFNESS*shaft%width())
      end do
      call dense%set(alpha, info)
      if (info%failed()) error stop 'no influence matrix of the liner'
      call time_solve(dense, problem, solution, found)
    else
      call time_solve(shaft, problem, solution, found)
    end if
    if (free) found%motion = solution%motion
    call summarise(x, shaft%width(), solution%force, found)
  end function press_in_liner

  subroutine time_solve(operator, problem, solution, found)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(inout) :: solution
    type(outcome), intent(inout) :: found
    type(fuge_solver) :: solver
    type(fuge_info) :: info
    integer(int64) :: start, finish, rate

    call system_clock(start, rate)
    call solver%solve(operator, problem, solution, info)
    call system_clock(finish)
    if (info%status /= 0) error stop 'the shaft in its liner was not solved'
    found%products = info%products
    found%seconds = real(finish - start, dp)/real(rate, dp)
  end subroutine time_solve

  !> The upper side carries at the inner end of the bush, the lower one at the outer end. Pressure vanishes at the edges
  !> of the contact like a straight line through the last two cells.
  pure subroutine summarise(x, width, force, found)
    real(dp), intent(in) :: x(:), width, force(:)
    type(outcome), intent(inout) :: found
    integer :: last_upper, first_lower

    found%sides = [sum(force, mask=force > 0.0_dp), sum(force, mask=force < 0.0_dp)]
    ! The lower side carries most at the rim of the bush, half a cell beyond the last centre.
    found%peaks = [1.5_dp*force(size(x)) - 0.5_dp*force(size(x) - 1), minval(force)]/width
    last_upper = findloc_last(force < 0.0_dp)
    first_lower = size(x) + 1 - findloc_last(force(size(x):1:-1) > 0.0_dp)
    found%edges(1) = x(last_upper) + width*force(last_upper)/(force(last_upper - 1) - force(last_upper))
    found%edges(2) = x(first_lower) - width*force(first_lower)/(force(first_lower + 1) - force(first_lower))
  end subroutine summarise

  !> Number of the last element that is true; 0 if none is.
  pure function findloc_last(mask) result(last)
    logical, intent(in) :: mask(:)
    integer :: last

    do last = size(mask), 1, -1
      if (mask(last)) return
    end do
  end function findloc_last

  !> Do the values on CELLS cells converge?
  pure function converge(values)
    real(dp), intent(in) :: values(:)
    logical :: converge

    converge = abs(values(2) - values(3)) <= 0.2_dp*abs(values(1) - values(3))
  end function converge

end program play
