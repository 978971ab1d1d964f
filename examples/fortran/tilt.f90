!> A flat and a rounded punch on an elastic half-plane under an eccentric force.
!>
!>     tilt [folder for its tables]
!>
!> The force F acts at the distance e from the middle of the face |x| <= a, so that its moment
!> is M = F e. The face may sink and tilt: two rigid motions, R = [1, x], whose resultants are
!> F and M. The flat punch stays in full contact up to e = a/2 and then lifts off; the rounded
!> one, y = x**2/(2 R), rolls until its contact reaches the corner. Beyond e = a both would
!> tip over. Everything is per unit depth and compared with the exact answer.
!> First 400 cells with a matrix, for every eccentricity; then some of these scenes again by FFT, with up to 262144
!> cells: the problem is the same, only the operator is another.
!> For the picture it writes tilt_length.csv, tilt_pressure.csv and tilt_error.csv.
program tilt
  use example_output, only: create_file
  use example_verdict, only: verdict
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge, only: dp => fuge_dp, fuge_contact_edges, fuge_dense_operator, fuge_halfplane_matrix, &
    fuge_halfplane_operator, fuge_info, fuge_interval, fuge_operator, fuge_problem, fuge_solution, fuge_solver, &
    fuge_status_text, FUGE_ERR_NO_EQUILIBRIUM, FUGE_MEAN
  implicit none

  !> N, mm.
  integer, parameter :: CELLS = 400, FINE_CELLS = 2**18
  !> Number of grids by FFT: FINE_CELLS cells, and 4, 16, .. times fewer.
  integer, parameter :: SIZES = 7
  real(dp), parameter :: HALF_FACE = 10.0_dp, E_STAR = 1.0e5_dp, LOAD = 5.0e3_dp
  real(dp), parameter :: PI = acos(-1.0_dp)
  !> As long as it does not reach a corner, the contact of the rounded punch covers 0.4 of the face.
  real(dp), parameter :: RADIUS = PI*E_STAR*(0.4_dp*HALF_FACE)**2/(4.0_dp*LOAD)

  !> Contact from middle - half to middle + half, and the motions of the punch.
  type :: contact
    real(dp) :: middle = 0.0_dp, half = 0.0_dp
    real(dp) :: approach = 0.0_dp, rotation = 0.0_dp
    !> Pressure in the middle of the contact.
    real(dp) :: pressure = 0.0_dp
  end type contact

  call run()

contains

  subroutine run()
    real(dp), allocatable, target :: alpha(:, :)
    real(dp) :: x(CELLS)
    type(fuge_dense_operator) :: operator
    type(fuge_info) :: info
    type(verdict) :: known
    integer :: file

    x = centres(CELLS)
    allocate (alpha(CELLS, CELLS))
    call fuge_halfplane_matrix(x, spread(width_of(x), 1, CELLS), E_STAR, FUGE_MEAN, alpha, info)
    if (.not. info%failed()) call operator%set(alpha, info)
    if (info%failed()) error stop 'no influence matrix'

    call create_file('tilt_length.csv', 1, file)
    write (file, '(a)') 'punch,eccentricity/a,length/2a,exact,rotation,exact,approach [mm],exact'
    call all_eccentricities(operator, x, 'flat', 0.0_dp, file, known)
    call all_eccentricities(operator, x, 'rounded', 1.0_dp/RADIUS, file, known)
    close (file)
    call write_pressures(operator, x)
    call repeat_by_fft(operator, known)
    call tip_over(operator, x)
    call known%give('against the exact contact and motions')
  end subroutine run

  !> Centres of n cells of one width that cover the face.
  pure function centres(n) result(x)
    integer, intent(in) :: n
    real(dp) :: x(n)
    integer :: k

    x = [(HALF_FACE*(2.0_dp*real(k, dp) - real(n + 1, dp))/real(n, dp), k=1, n)]
  end function centres

  pure function width_of(x) result(width)
    real(dp), intent(in) :: x(:)
    real(dp) :: width

    width = 2.0_dp*HALF_FACE/real(size(x), dp)
  end function width_of

  !> From the middle to almost the corner; one solver, because each contact is a good start
  !> for the next one.
  subroutine all_eccentricities(operator, x, name, curvature, file, known)
    type(fuge_dense_operator), intent(in) :: operator
    real(dp), intent(in) :: x(:), curvature
    character(len=*), intent(in) :: name
    integer, intent(in) :: file
    type(verdict), intent(inout) :: known
    type(fuge_problem) :: problem
    type(fuge_solver) :: solver
    type(fuge_solution) :: solution
    type(contact) :: found, exact
    real(dp) :: eccentricity
    integer :: percent

    problem = punch(x, curvature)
    print '(/,3a)', 'The ', name, ' punch'
    print '(a5,a24,a13,a9,a19,a9,a17,a9)', 'e/a', 'contact from .. to [mm]', 'length/2a', 'exact', 'rotation [mrad]', &
      'exact', 'approach [mm]', 'exact'
    do percent = 0, 96, 2
      eccentricity = 0.01_dp*real(percent, dp)*HALF_FACE
      call press(operator, problem, eccentricity, solver, solution)
      found = contact_of(solution, x)
      exact = exact_contact(eccentricity, curvature)
      write (file, '(a,7('','',es14.7))') name, eccentricity/HALF_FACE, found%half/HALF_FACE, exact%half/HALF_FACE, &
        found%rotation, exact%rotation, found%approach, exact%approach
      if (mod(percent, 8) == 0) print '(f5.2,2f12.4,f13.5,f9.5,f19.4,f9.4,f17.5,f9.5)', eccentricity/HALF_FACE, &
        found%middle - found%half, found%middle + found%half, found%half/HALF_FACE, exact%half/HALF_FACE, &
        1.0e3_dp*found%rotation, 1.0e3_dp*exact%rotation, found%approach, exact%approach
      call compare(found, exact, width_of(x), known)
    end do
  end subroutine all_eccentricities

  !> Scenes of both punches by the matrix and by FFT, with up to FINE_CELLS cells, each from scratch.
  subroutine repeat_by_fft(operator, known)
    type(fuge_dense_operator), intent(in) :: operator
    type(verdict), intent(inout) :: known
    type(fuge_halfplane_operator) :: grids(SIZES)
    type(fuge_info) :: info
    real(dp), parameter :: ECCENTRICITIES(3) = [0.25_dp, 0.5_dp, 0.72_dp]
    integer :: file, j, n

    do j = 1, SIZES
      n = FINE_CELLS/4**(SIZES - j)
      call grids(j)%set(n, 2.0_dp*HALF_FACE/real(n, dp), E_STAR, info, element=FUGE_MEAN)
      if (info%failed()) error stop 'no operator'
    end do
    call create_file('tilt_error.csv', 1, file)
    write (file, '(a)') 'punch,eccentricity/a,cells,error of the rotation,of the approach,of the pressure'
    print '(/,2(a,i0),a)', 'The same with ', CELLS, ' cells and a matrix, and with ', FINE_CELLS, ' cells by FFT'
    print '(a14,a11,a25,a16,a16,a16,a10,a10)', 'e/a', 'cells', 'contact from .. to [mm]', 'rotation [mrad]', &
      'approach [mm]', 'middle [N/mm2]', 'products', 'time [s]'
    do j = 1, size(ECCENTRICITIES)
      call repeat_scene('flat', ECCENTRICITIES(j)*HALF_FACE, 0.0_dp, operator, grids, file, known)
    end do
    do j = 1, size(ECCENTRICITIES)
      call repeat_scene('rounded', ECCENTRICITIES(j)*HALF_FACE, 1.0_dp/RADIUS, operator, grids, file, known)
    end do
    close (file)
  end subroutine repeat_by_fft

  !> One scene by the matrix and on all grids, of which the last one is printed; the errors of all go to the file.
  subroutine repeat_scene(name, eccentricity, curvature, operator, grids, file, known)
    character(len=*), intent(in) :: name
    real(dp), intent(in) :: eccentricity, curvature
    type(fuge_dense_operator), intent(in) :: operator
    type(fuge_halfplane_operator), intent(in) :: grids(:)
    integer, intent(in) :: file
    type(verdict), intent(inout) :: known
    type(contact) :: exact, found
    integer :: k

    exact = exact_contact(eccentricity, curvature)
    print '(a8,f6.2,a11,1x,2f12.6,2f16.7,f16.4)', name, eccentricity/HALF_FACE, 'exact', exact%middle - exact%half, &
      exact%middle + exact%half, 1.0e3_dp*exact%rotation, exact%approach, exact%pressure
    call press_once(operator, eccentricity, curvature, .true., found)
    do k = 1, size(grids)
      call press_once(grids(k), eccentricity, curvature, k == size(grids), found)
      write (file, '(a,'','',f6.3,'','',i0,3('','',es12.4))') name, eccentricity/HALF_FACE, grids(k)%points(), &
        abs(found%rotation/exact%rotation - 1.0_dp), abs(found%approach/exact%approach - 1.0_dp), &
        abs(found%pressure/exact%pressure - 1.0_dp)
      if (grids(k)%points() >= CELLS) &
        call compare(found, exact, width_of(centres(grids(k)%points())), known)
    end do
  end subroutine repeat_scene

  !> Solve one scene from scratch; a line of the table if `is_shown`.
  subroutine press_once(operator, eccentricity, curvature, is_shown, found)
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: eccentricity, curvature
    logical, intent(in) :: is_shown
    type(contact), intent(out) :: found
    real(dp), allocatable :: x(:)
    type(fuge_problem) :: problem
    type(fuge_solver) :: solver
    type(fuge_solution) :: solution
    integer :: products
    integer(int64) :: start, finish, rate

    allocate (x(operator%points()))
    x = centres(size(x))
    problem = punch(x, curvature)
    call system_clock(start, rate)
    call press(operator, problem, eccentricity, solver, solution, products)
    call system_clock(finish)
    found = contact_of(solution, x)
    if (is_shown) print '(i25,1x,2f12.6,2f16.7,f16.4,i10,f10.3)', size(x), found%middle - found%half, &
      found%middle + found%half, 1.0e3_dp*found%rotation, found%approach, found%pressure, products, &
      real(finish - start, dp)/real(rate, dp)
  end subroutine press_once

  !> Initial gap x**2 curvature/2; the load is set later.
  function punch(x, curvature) result(problem)
    real(dp), intent(in) :: x(:), curvature
    type(fuge_problem) :: problem

    allocate (problem%gap(size(x)), problem%modes(size(x), 2))
    problem%gap = 0.5_dp*curvature*x**2
    problem%modes(:, 1) = 1.0_dp
    problem%modes(:, 2) = x
  end function punch

  subroutine press(operator, problem, eccentricity, solver, solution, products)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(inout) :: problem
    real(dp), intent(in) :: eccentricity
    type(fuge_solver), intent(inout) :: solver
    type(fuge_solution), intent(inout) :: solution
    integer, intent(out), optional :: products
    type(fuge_info) :: info

    problem%resultant = [LOAD, LOAD*eccentricity]
    call solver%solve(operator, problem, solution, info)
    if (info%status /= 0) error stop 'the punch was not solved'
    if (present(products)) products = info%products
  end subroutine press

  function contact_of(solution, x) result(found)
    type(fuge_solution), intent(in) :: solution
    real(dp), intent(in) :: x(:)
    type(contact) :: found
    type(fuge_interval), allocatable :: intervals(:)
    type(fuge_info) :: info
    real(dp), allocatable :: width(:)
    real(dp) :: place
    integer :: k

    allocate (width(size(x)))
    width = width_of(x)
    call fuge_contact_edges(x, width, solution%force, FUGE_MEAN, intervals, info)
    if (info%status /= 0) error stop 'the edges were not found'
    if (size(intervals) /= 1) error stop 'more than one contact under the punch'
    found%middle = 0.5_dp*(intervals(1)%left + intervals(1)%right)
    found%half = 0.5_dp*(intervals(1)%right - intervals(1)%left)
    found%approach = solution%motion(1)
    found%rotation = solution%motion(2)
    ! Between the centres of two cells.
    place = (found%middle - x(1))/width_of(x)
    k = 1 + int(place)
    place = place - aint(place)
    found%pressure = ((1.0_dp - place)*solution%force(k) + place*solution%force(k + 1))/width_of(x)
  end function contact_of

  !> With t = (x - middle)/half the pressure on a parabola or a plane is
  !>
  !>     p = [F + c_1 t - c_2 (2 t**2 - 1)]/(pi half sqrt(1 - t**2))
  !>     c_1 = 2 (M - F middle)/half,   c_2 = F half**2/hertz**2
  !>
  !> and each Chebyshev polynomial under the root moves the surface by a multiple of itself.
  !> At a free edge p is 0. `eccentricity` in 0 .. a.
  pure function exact_contact(eccentricity, curvature) result(exact)
    real(dp), intent(in) :: eccentricity, curvature
    type(contact) :: exact
    real(dp) :: flattening, unit

    exact%half = half_length(eccentricity, curvature)
    ! Under the force, or as close to it as the corner lets it.
    exact%middle = min(eccentricity, HALF_FACE - exact%half)
    flattening = exact%half**2*inverse_hertz(curvature)
    unit = 2.0_dp*LOAD/(PI*E_STAR)
    exact%rotation = curvature*exact%middle + 2.0_dp*unit*(eccentricity - exact%middle)/exact%half**2
    ! The displacement by a line load is zero at twice the length of the face.
    exact%approach = unit*(log(8.0_dp*HALF_FACE/exact%half) + 0.5_dp*flattening) &
                     - exact%rotation*exact%middle + 0.5_dp*curvature*exact%middle**2
    exact%pressure = LOAD*(1.0_dp + flattening)/(PI*exact%half)
  end function exact_contact

  !> The whole face, Hertz's contact, or one that ends at the corner and at a free edge:
  !> eccentricity = a - half/2 - half**3/(2 hertz**2). The least of the three is right.
  pure function half_length(eccentricity, curvature) result(half)
    real(dp), intent(in) :: eccentricity, curvature
    real(dp) :: half
    real(dp) :: arm, low, high
    integer :: k

    arm = HALF_FACE - eccentricity
    low = 0.0_dp
    high = HALF_FACE
    if (curvature > 0.0_dp) high = min(high, 1.0_dp/sqrt(inverse_hertz(curvature)))
    half = high
    if (0.5_dp*half*(1.0_dp + half**2*inverse_hertz(curvature)) <= arm) return
    do k = 1, digits(half)
      half = 0.5_dp*(low + high)
      if (0.5_dp*half*(1.0_dp + half**2*inverse_hertz(curvature)) > arm) then
        high = half
      else
        low = half
      end if
    end do
  end function half_length

  !> 1/hertz**2, hertz the half width of the contact that meets no corner.
  pure function inverse_hertz(curvature) result(inverse)
    real(dp), intent(in) :: curvature
    real(dp) :: inverse

    inverse = PI*E_STAR*curvature/(4.0_dp*LOAD)
  end function inverse_hertz

  !> The cells press up to a tenth of a width inside of a corner, an error of first order
  !> that a free edge at the other end doubles twice. Two free edges are far better.
  subroutine compare(found, exact, width, known)
    type(contact), intent(in) :: found, exact
    real(dp), intent(in) :: width
    type(verdict), intent(inout) :: known
    real(dp) :: shift, turn

    shift = 0.25_dp*width
    if (exact%middle + exact%half < HALF_FACE - width) shift = 1.0e-3_dp*width
    turn = 2.0_dp*LOAD/(PI*E_STAR)*shift/exact%half**2
    call known%hold(abs(found%half - exact%half) <= shift, 'the length of contact')
    call known%hold(abs(found%middle - exact%middle) <= shift, 'the place of contact')
    call known%hold(abs(found%rotation - exact%rotation) <= turn, 'the rotation')
    call known%hold(abs(found%approach - exact%approach) <= turn*HALF_FACE, 'the approach')
    call known%hold(abs(found%pressure - exact%pressure) <= 2.0_dp*shift/exact%half*exact%pressure, &
                    'the pressure in the middle')
  end subroutine compare

  !> Under the flat punch, for the right half of the picture.
  subroutine write_pressures(operator, x)
    type(fuge_dense_operator), intent(in) :: operator
    real(dp), intent(in) :: x(:)
    type(fuge_problem) :: problem
    type(fuge_solver) :: solver
    type(fuge_solution) :: solution(4)
    real(dp), parameter :: QUARTERS(4) = [0.0_dp, 0.25_dp, 0.5_dp, 0.75_dp]
    integer :: file, j, k

    problem = punch(x, 0.0_dp)
    do j = 1, size(solution)
      call press(operator, problem, QUARTERS(j)*HALF_FACE, solver, solution(j))
    end do
    call create_file('tilt_pressure.csv', 1, file)
    write (file, '(a)') 'x [mm],p(e=0) [N/mm2],p(e=a/4),p(e=a/2),p(e=3a/4)'
    do k = 1, size(x), 5
      write (file, '(f9.4,4('','',f12.4))') x(k), (solution(j)%force(k)/width_of(x), j=1, size(solution))
    end do
    close (file)
  end subroutine write_pressures

  !> Beyond the corner no pressure can carry the force: an error that says why.
  subroutine tip_over(operator, x)
    type(fuge_dense_operator), intent(in) :: operator
    real(dp), intent(in) :: x(:)
    type(fuge_problem) :: problem
    type(fuge_solver) :: solver
    type(fuge_solution) :: solution
    type(fuge_info) :: info

    problem = punch(x, 0.0_dp)
    problem%resultant = [LOAD, 1.1_dp*LOAD*HALF_FACE]
    call solver%solve(operator, problem, solution, info)
    print '(/,a,i0,2a)', 'With e = 1.1 a the status is ', info%status, ': ', fuge_status_text(info%status)
    print '(a)', trim(info%message)
    if (info%status /= FUGE_ERR_NO_EQUILIBRIUM) error stop 'a punch that tips over was accepted'
  end subroutine tip_over

end program tilt
