!> Two rigid flat punches side by side on one elastic half-plane, each with its own force.
!>
!>     two_bodies [folder for its table]
!>
!> Both sink without tilting: two rigid motions, each of which moves the cells of one punch
!> only, with its force as resultant. Either punch sinks into the hollow of the other one.
!> First equal forces over the distance, then one force is kept and the other one raised from
!> a twentieth of it. All is per unit depth and compared with the exact answer. For full contact on
!> b < |x| < c, with the sum S = F_1 + F_2, the difference T = F_1 - F_2 and k = b/c, it is
!>
!>     p = [S |x| +- pi T c/(2 K(k'))]/(pi sqrt((x**2 - b**2) (c**2 - x**2)))
!>     v = [S ln(4 D**2/(c**2 - b**2)) +- pi T K(k)/K(k')]/(pi E*)
!>
!> + for the first punch, - for the second one; K the complete elliptic integral of the first
!> kind, D the distance at which a line load displaces nothing.
!> At last some of these scenes by FFT: a grid of cells from the first punch to the second one, 2**18 of them under the
!> faces and those between the punches excluded.
!> The table two_bodies.csv has the approaches over the distance and over the force.
program two_bodies
  use example_output, only: create_file
  use example_verdict, only: verdict
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge, only: dp => fuge_dp, fuge_contact_edges, fuge_dense_operator, fuge_graded_cells, fuge_halfplane_matrix, &
    fuge_halfplane_operator, fuge_info, fuge_interval, fuge_problem, fuge_solution, fuge_solver, FUGE_END_CORNER, &
    FUGE_MEAN
  implicit none

  !> N, mm; cells of each punch.
  integer, parameter :: CELLS = 60, FINE_CELLS = 2**17
  real(dp), parameter :: HALF_FACE = 10.0_dp, E_STAR = 1.0e5_dp, FORCE = 5.0e3_dp
  real(dp), parameter :: DATUM = 1.0e3_dp
  real(dp), parameter :: PI = acos(-1.0_dp)
  !> Largest relative error of an approach.
  real(dp), parameter :: TOLERANCE = 2.0e-5_dp, FINE_TOLERANCE = 2.0e-6_dp

  !> The answer for a pair of forces.
  type :: answer
    !> Approaches, length, and how much of each face touches.
    real(dp) :: approach(2) = 0.0_dp, touching(2) = 0.0_dp
  end type answer

  !> The cost of a solve.
  type :: effort
    integer :: products = 0
    real(dp) :: seconds = 0.0_dp
  end type effort

  call run()

contains

  subroutine run()
    type(verdict) :: known
    integer :: file

    call create_file('two_bodies.csv', 1, file)
    write (file, '(a)') 'distance [mm],F_1 [N],F_2 [N],v_1 [mm],v_2 [mm],touching 1,touching 2'
    call move_apart(file, known)
    call raise_second(2.5_dp*HALF_FACE, file, known)
    close (file)
    call repeat_by_fft(known)
    call known%give('against the exact approaches')
  end subroutine run

  !> A line force in place of the other punch is accurate far away; for equal forces it is exact
  !> at any distance, because c**2 - b**2 is 2 a times the distance.
  subroutine move_apart(file, known)
    integer, intent(in) :: file
    type(verdict), intent(inout) :: known
    real(dp), parameter :: RATIO(8) = [1.1_dp, 1.2_dp, 1.5_dp, 2.0_dp, 3.0_dp, 6.0_dp, 11.0_dp, 31.0_dp]
    type(answer) :: found
    real(dp) :: distance, exact(2)
    integer :: k

    print '(a,f6.3,a)', 'Equal forces of 5 kN/mm; alone each punch sinks by ', alone(FORCE), ' mm'
    print '(a)', 'Approaches [mm]; the estimate has a line force in place of the other punch'
    print '(a11,2x,4a11)', 'distance/2a', 'punch 1', 'punch 2', 'exact', 'estimate'
    do k = 1, size(RATIO)
      distance = 2.0_dp*HALF_FACE*RATIO(k)
      found = press(distance, [FORCE, FORCE])
      exact = full_contact(distance, [FORCE, FORCE])
      print '(f11.1,2x,4f11.6)', RATIO(k), found%approach, exact(1), far_apart(distance, FORCE, FORCE)
      write (file, '(6(es14.7,'',''),es14.7)') distance, FORCE, FORCE, found
      call known%compare(found%approach/exact - 1.0_dp, TOLERANCE, 'an approach')
      if (any(found%touching < 1.0_dp)) error stop 'a punch has lifted off'
    end do
  end subroutine move_apart

  !> Under a small force the second punch rests on its outer corner, because the hollow of the
  !> first one slopes away from it; full contact begins where p is 0 at its inner corner.
  !> Without any force its approach would be indeterminate up to the first touch.
  subroutine raise_second(distance, file, known)
    real(dp), intent(in) :: distance
    integer, intent(in) :: file
    type(verdict), intent(inout) :: known
    type(answer) :: found
    real(dp) :: second, least
    logical :: full
    integer :: k

    least = full_from(distance)*FORCE
    print '(/,a,f5.2,a,f7.1,a)', 'First force 5 kN/mm, distance/2a =', distance/(2.0_dp*HALF_FACE), &
      ': full contact of the second punch from F_2 =', least, ' N/mm'
    print '(a)', 'Approaches [mm]; exact is known for full contact'
    print '(a10,a12,2(a12,a10,a10))', 'F_2 [N/mm]', 'touching', 'punch 1', 'estimate', 'exact', 'punch 2', 'estimate', &
      'exact'
    do k = 1, 20
      second = 0.05_dp*FORCE*real(k, dp)
      found = press(distance, [FORCE, second])
      write (file, '(6(es14.7,'',''),es14.7)') distance, FORCE, second, found
      full = .not. found%touching(2) < 1.0_dp
      if (full .neqv. second > least) error stop 'full contact does not begin where it should'
      if (full) then
        call show(distance, second, found, full_contact(distance, [FORCE, second]))
        call known%compare(found%approach/full_contact(distance, [FORCE, second]) - 1.0_dp, TOLERANCE, 'an approach')
      else
        call show(distance, second, found)
      end if
    end do
  end subroutine raise_second

  !> Some of the same scenes, by the matrix and by FFT.
  subroutine repeat_by_fft(known)
    type(verdict), intent(inout) :: known
    real(dp), parameter :: DISTANCE = 2.5_dp*HALF_FACE, SECOND(3) = [0.1_dp, 0.5_dp, 0.8_dp]
    type(answer) :: graded, fine
    type(effort) :: spent
    real(dp) :: load(2)
    logical :: is_full
    integer :: k

    print '(/,a,i0,a,i0,a)', 'The same with ', 2*CELLS, ' graded cells and a matrix, and with ', 2*FINE_CELLS, &
      ' equal cells by FFT'
    print '(a10,a9,2a14,a20,a14,a10)', 'F_2 [N/mm]', 'cells', 'punch 1 [mm]', 'punch 2 [mm]', 'touching 1, 2 [%]', &
      'products', 'time [s]'
    do k = 1, size(SECOND)
      load = FORCE*[1.0_dp, SECOND(k)]
      is_full = SECOND(k) > full_from(DISTANCE)
      if (is_full) print '(f10.0,a9,2f14.8,2f10.4)', load(2), 'exact', full_contact(DISTANCE, load), 100.0_dp, 100.0_dp
      graded = press(DISTANCE, load, spent)
      call show_effort(load(2), 2*CELLS, graded, spent)
      fine = press_by_fft(DISTANCE, load, spent)
      call show_effort(load(2), 2*FINE_CELLS, fine, spent)
      if (any(abs(fine%approach - graded%approach) > TOLERANCE*graded%approach)) error stop 'by FFT another approach'
      if (is_full) call known%compare(fine%approach/full_contact(DISTANCE, load) - 1.0_dp, FINE_TOLERANCE, &
                                      'an approach by FFT')
      if ((fine%touching(2) < 1.0_dp) .eqv. is_full) error stop 'by FFT full contact does not begin where it should'
      ! No closed form: the cell in which the graded contact ends, of a width below 0.04 of the face.
      if (any(abs(fine%touching - graded%touching) > 0.04_dp)) error stop 'by FFT another length touches'
    end do
  end subroutine repeat_by_fft

  subroutine show_effort(second, cells, found, spent)
    real(dp), intent(in) :: second
    integer, intent(in) :: cells
    type(answer), intent(in) :: found
    type(effort), intent(in) :: spent

    print '(f10.0,i9,2f14.8,2f10.4,i14,f10.3)', second, cells, found%approach, 100.0_dp*found%touching, &
      spent%products, spent%seconds
  end subroutine show_effort

  !> The same problem on a grid that covers both faces and what is between them; `distance` 2.5 half faces.
  function press_by_fft(distance, load, spent) result(found)
    real(dp), intent(in) :: distance, load(2)
    type(effort), intent(out) :: spent
    type(answer) :: found
    type(fuge_halfplane_operator) :: operator
    type(fuge_problem) :: problem
    type(fuge_solution) :: solution
    type(fuge_solver) :: solver
    type(fuge_info) :: info
    real(dp) :: width
    integer :: between, n
    integer(int64) :: start, finish, rate

    width = 2.0_dp*HALF_FACE/real(FINE_CELLS, dp)
    between = nint((distance - 2.0_dp*HALF_FACE)/width)
    n = 2*FINE_CELLS + between
    call operator%set(n, width, E_STAR, info, element=FUGE_MEAN)
    if (info%failed()) error stop 'no operator'
    call set_punches(FINE_CELLS, between, load, problem)
    call system_clock(start, rate)
    call solver%solve(operator, problem, solution, info)
    call system_clock(finish)
    if (info%status /= 0) error stop 'the punches were not solved by FFT'
    spent = effort(info%products, real(finish - start, dp)/real(rate, dp))
    found%touching = touching_of(width, solution%force, between)
    found%approach = solution%motion + sinking(sum(load), 2.0_dp*(distance + 2.0_dp*HALF_FACE))
  end function press_by_fft

  !> The share of each face that touches, from the edges of the contact.
  function touching_of(width, force, between) result(share)
    real(dp), intent(in) :: width, force(:)
    integer, intent(in) :: between
    real(dp) :: share(2)
    real(dp), allocatable :: x(:), widths(:)
    type(fuge_interval), allocatable :: intervals(:)
    type(fuge_info) :: info
    integer :: k

    allocate (x(size(force)), widths(size(force)))
    widths = width
    x = [(width*(real(k, dp) - 0.5_dp), k=1, size(force))]
    call fuge_contact_edges(x, widths, force, FUGE_MEAN, intervals, info)
    if (info%status /= 0) error stop 'the edges were not found'
    share = 0.0_dp
    do k = 1, size(intervals)
      associate (punch => merge(1, 2, intervals(k)%right < width*real(FINE_CELLS + between/2, dp)))
        share(punch) = share(punch) + (intervals(k)%right - intervals(k)%left)/(2.0_dp*HALF_FACE)
      end associate
    end do
    if (all(force(:FINE_CELLS) > 0.0_dp)) share(1) = 1.0_dp
    if (all(force(FINE_CELLS + between + 1:) > 0.0_dp)) share(2) = 1.0_dp
  end function touching_of

  !> A line of the table, with the exact approaches where they are known.
  subroutine show(distance, second, found, exact)
    real(dp), intent(in) :: distance, second
    type(answer), intent(in) :: found
    real(dp), intent(in), optional :: exact(2)
    character(len=10) :: known(2)

    known = ''
    if (present(exact)) then
      write (known, '(f10.6)') exact
    end if
    print '(f10.0,f10.1,a,2(f12.6,f10.6,a))', second, 100.0_dp*found%touching(2), ' %', &
      found%approach(1), far_apart(distance, FORCE, second), known(1), &
      found%approach(2), far_apart(distance, second, FORCE), known(2)
  end subroutine show

  !> Cells that become narrower towards the corners, where the pressure is singular.
  function press(distance, load, spent) result(found)
    real(dp), intent(in) :: distance, load(2)
    type(effort), intent(out), optional :: spent
    type(answer) :: found
    real(dp), allocatable, target :: alpha(:, :)
    real(dp) :: x(2*CELLS), width(2*CELLS)
    type(fuge_dense_operator) :: operator
    type(fuge_problem) :: problem
    type(fuge_solution) :: solution
    type(fuge_solver) :: solver
    type(fuge_info) :: info
    integer(int64) :: start, finish, rate

    x = 0.0_dp
    width = 0.0_dp
    call fuge_graded_cells(-HALF_FACE, HALF_FACE, [FUGE_END_CORNER, FUGE_END_CORNER], [0, 0], x(:CELLS), &
                           width(:CELLS), info)
    if (info%failed()) error stop 'no cells'
    x = [x(:CELLS) - 0.5_dp*distance, x(:CELLS) + 0.5_dp*distance]
    width(CELLS + 1:) = width(:CELLS)
    allocate (alpha(2*CELLS, 2*CELLS))
    call fuge_halfplane_matrix(x, width, E_STAR, FUGE_MEAN, alpha, info)
    if (.not. info%failed()) call operator%set(alpha, info)
    if (info%failed()) error stop 'no influence matrix'

    call set_punches(CELLS, 0, load, problem)
    call system_clock(start, rate)
    call solver%solve(operator, problem, solution, info)
    call system_clock(finish)
    if (info%status /= 0) error stop 'the punches were not solved'
    if (present(spent)) spent = effort(info%products, real(finish - start, dp)/real(rate, dp))
    found%touching(1) = sum(width(:CELLS), mask=solution%force(:CELLS) > 0.0_dp)/(2.0_dp*HALF_FACE)
    found%touching(2) = sum(width(CELLS + 1:), mask=solution%force(CELLS + 1:) > 0.0_dp)/(2.0_dp*HALF_FACE)
    if (all(solution%force > 0.0_dp)) found%touching = 1.0_dp
    ! The datum of the matrix is at twice the length from the first cell to the last one, which
    ! changes with the distance of the punches.
    found%approach = solution%motion + sinking(sum(load), 2.0_dp*(distance + 2.0_dp*HALF_FACE))
  end function press

  !> Two punches of `cells` cells each, with `between` cells between them that take no part.
  pure subroutine set_punches(cells, between, load, problem)
    integer, intent(in) :: cells, between
    real(dp), intent(in) :: load(2)
    type(fuge_problem), intent(out) :: problem
    integer :: n

    n = 2*cells + between
    allocate (problem%gap(n), problem%modes(n, 2), problem%resultant(2))
    problem%gap = 0.0_dp
    problem%modes = 0.0_dp
    problem%modes(:cells, 1) = 1.0_dp
    problem%modes(cells + between + 1:, 2) = 1.0_dp
    problem%resultant = load
    if (between < 1) return
    allocate (problem%excluded(n))
    problem%excluded = .false.
    problem%excluded(cells + 1:cells + between) = .true.
  end subroutine set_punches

  !> Displacement of the surface at a distance from a line load.
  elemental function sinking(load, distance)
    real(dp), intent(in) :: load, distance
    real(dp) :: sinking

    sinking = 2.0_dp*load/(PI*E_STAR)*log(DATUM/distance)
  end function sinking

  elemental function alone(load) result(approach)
    real(dp), intent(in) :: load
    real(dp) :: approach

    approach = sinking(load, 0.5_dp*HALF_FACE)
  end function alone

  !> Approach of the punch under its own load and a line load at a distance.
  elemental function far_apart(distance, own, other) result(approach)
    real(dp), intent(in) :: distance, own, other
    real(dp) :: approach

    approach = alone(own) + sinking(other, distance)
  end function far_apart

  pure function full_contact(distance, load) result(approach)
    real(dp), intent(in) :: distance, load(2)
    real(dp) :: approach(2)
    real(dp) :: k, quotient

    k = modulus(distance)
    ! K(k)/K(k'), with K(k) = pi/(2 agm(1, k')).
    quotient = mean_with_1(k)/mean_with_1(sqrt((1.0_dp - k)*(1.0_dp + k)))
    approach = sinking(sum(load), sqrt(0.5_dp*HALF_FACE*distance)) &
               + [1.0_dp, -1.0_dp]*(load(1) - load(2))*quotient/E_STAR
  end function full_contact

  !> Least F_2/F_1 for full contact.
  pure function full_from(distance) result(ratio)
    real(dp), intent(in) :: distance
    real(dp) :: ratio
    real(dp) :: difference

    ! T/S = 2 k K(k')/pi.
    difference = modulus(distance)/mean_with_1(modulus(distance))
    ratio = (1.0_dp - difference)/(1.0_dp + difference)
  end function full_from

  !> k = b/c.
  pure function modulus(distance) result(k)
    real(dp), intent(in) :: distance
    real(dp) :: k

    k = (distance - 2.0_dp*HALF_FACE)/(distance + 2.0_dp*HALF_FACE)
  end function modulus

  !> Arithmetic-geometric mean of 1 and x > 0.
  pure function mean_with_1(x) result(mean)
    real(dp), intent(in) :: x
    real(dp) :: mean
    real(dp) :: geometric, last

    mean = 1.0_dp
    geometric = x
    do while (abs(mean - geometric) > 4.0_dp*epsilon(mean)*mean)
      last = mean
      mean = 0.5_dp*(last + geometric)
      geometric = sqrt(last*geometric)
    end do
  end function mean_with_1

end program two_bodies
