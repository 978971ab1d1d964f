!> Stresses in the body: error over time, of points and of grids by FFT.
!>
!>     stresses [cells ..]
!>
!> Prints Markdown tables to standard output: a cylinder on a half-plane and a sphere (nu = 0.3) on a half-space, from
!> contacts that the library solves itself on n (and n x n) cells, against Hertz's stresses. The error is the largest
!> one of any component over the largest pressure p0, in 0.2 a <= z <= 3 a; the time is that of a point, least of some
!> repetitions, of a field that is set. CPU time, one thread.
program stresses
  use fuge, only: dp => fuge_dp, fuge_field, fuge_halfplane_field, fuge_halfplane_operator, fuge_halfspace_field, &
    fuge_halfspace_operator, fuge_info, fuge_operator, fuge_polynomial_profile, fuge_problem, fuge_round_contact, &
    fuge_round_punch_field, fuge_smooth_contact, fuge_smooth_punch_field, fuge_solution, fuge_solve_round_punch, &
    fuge_solve_smooth_punch, fuge_solver, FUGE_FREE, FUGE_MEAN, FUGE_PLANE_STRAIN
  implicit none

  integer, parameter :: REPETITIONS = 3, POINTS = 10000, DEPTHS = 10
  !> Half-width of the grid and of the contact; the modulus is 1.
  real(dp), parameter :: SIDE = 1.5_dp, A = 1.0_dp, NU = 0.3_dp, YOUNG = 1.0_dp - NU**2, PI = acos(-1.0_dp)
  !> Depths of the points, over a.
  real(dp), parameter :: SHALLOW = 0.2_dp, DEEP = 3.0_dp

  print '(a,/,a)', '| cylinder, cells | points: error/p0 | µs a point | grid: error/p0 | µs a point |', &
    '| --- | --- | --- | --- | --- |'
  call measure_line(32)
  call measure_line(256)
  call measure_line(2048)
  call measure_line(16384)
  call measure_smooth()
  print '(/,a,/,a)', '| sphere, cells | points: error/p0 | µs a point | grid: error/p0 | µs a point |', &
    '| --- | --- | --- | --- | --- |'
  call measure_area(16)
  call measure_area(32)
  call measure_area(64)
  call measure_area(128)
  call measure_area(256)
  call measure_round()

contains

  subroutine measure_line(n)
    integer, intent(in) :: n
    type(fuge_halfplane_operator) :: surface
    type(fuge_halfplane_field) :: field
    type(fuge_info) :: info
    real(dp) :: x(n), force(n), spacing
    character(len=24) :: name
    integer :: k

    spacing = 2.0_dp*SIDE/real(n, dp)
    x = [((k - 0.5_dp)*spacing - SIDE, k=1, n)]
    call surface%set(n, spacing, 1.0_dp, info, element=FUGE_MEAN)
    call check(info)
    ! Of a cylinder of radius 1 with half-width a; mean gaps of the cells.
    call solve(surface, 0.5_dp*(x**2 + spacing**2/12.0_dp), PI*A**2/4.0_dp, force)
    call field%set_grid(spacing, force, FUGE_MEAN, FUGE_FREE, YOUNG, NU, FUGE_PLANE_STRAIN, info)
    call check(info)
    write (name, '(i0)') n
    call measure(name, field, scattered(), .false., x, 0.0_dp*x)
  end subroutine measure_line

  subroutine measure_smooth()
    type(fuge_polynomial_profile) :: cylinder
    type(fuge_smooth_contact) :: contact
    type(fuge_smooth_punch_field) :: field
    type(fuge_info) :: info

    cylinder%lower = -2.0_dp
    cylinder%upper = 2.0_dp
    cylinder%coefficients = [0.0_dp, 0.0_dp, 0.5_dp]
    call fuge_solve_smooth_punch(cylinder, 1.0_dp, PI*A**2/4.0_dp, contact, info)
    call check(info)
    call field%set(contact, YOUNG, NU, FUGE_PLANE_STRAIN, info)
    call check(info)
    call measure('smooth punch', field, scattered(), .false.)
  end subroutine measure_smooth

  subroutine measure_area(n)
    integer, intent(in) :: n
    type(fuge_halfspace_operator) :: surface
    type(fuge_halfspace_field) :: field
    type(fuge_info) :: info
    real(dp) :: x(n*n), y(n*n), force(n*n), spacing
    real(dp), allocatable :: place(:, :)
    character(len=24) :: name
    integer :: j, k

    spacing = 2.0_dp*SIDE/real(n, dp)
    x = [(((k - 0.5_dp)*spacing - SIDE, k=1, n), j=1, n)]
    y = [(((j - 0.5_dp)*spacing - SIDE, k=1, n), j=1, n)]
    call surface%set(n, n, spacing, spacing, 1.0_dp, info, element=FUGE_MEAN)
    call check(info)
    call solve(surface, 0.5_dp*(x**2 + y**2 + spacing**2/6.0_dp), 4.0_dp*A**3/3.0_dp, force)
    call field%set_grid(n, n, spacing, spacing, force, FUGE_FREE, YOUNG, NU, info)
    call check(info)
    allocate (place, source=scattered())
    place(2, :) = place(1, POINTS:1:-1)
    write (name, '(i0,a,i0)') n, ' x ', n
    call measure(name, field, place, .true., x, y)
  end subroutine measure_area

  subroutine measure_round()
    type(fuge_round_contact) :: contact
    type(fuge_round_punch_field) :: field
    type(fuge_info) :: info

    call press_sphere(contact)
    call field%set(contact, YOUNG, NU, info)
    call check(info)
    call measure('round punch', field, abs(scattered()), .true.)
  end subroutine measure_round

  !> A row of a table. Places and the cells of the grid, `x` and `y`, count from the middle of the contact.
  subroutine measure(name, field, place, is_round, x, y)
    character(len=*), intent(in) :: name
    class(fuge_field), intent(in) :: field
    real(dp), intent(in) :: place(:, :)
    logical, intent(in) :: is_round
    real(dp), intent(in), optional :: x(:), y(:)
    real(dp) :: asked(3, size(place, 2)), found(6, size(place, 2)), depth(DEPTHS), start, time(2), error(2)
    real(dp), allocatable :: grid(:, :, :), below(:, :)
    type(fuge_info) :: info
    integer :: k

    asked = place
    if (present(x)) then
      allocate (grid(6, size(x), DEPTHS), below(3, size(x)))
      ! The first cell of a grid is where its field counts from.
      asked(1, :) = place(1, :) - x(1)
      asked(2, :) = place(2, :) - y(1)
    end if
    depth = [(SHALLOW + (DEEP - SHALLOW)*real(k - 1, dp)/real(DEPTHS - 1, dp), k=1, DEPTHS)]
    time = huge(time)
    do k = 1, REPETITIONS
      start = seconds()
      call field%stress(asked, found, info)
      time(1) = min(time(1), (seconds() - start)/real(size(place, 2), dp))
      call check(info)
      if (.not. present(x)) cycle
      start = seconds()
      call field%grid_stress(depth, grid, info)
      time(2) = min(time(2), (seconds() - start)/real(size(x)*DEPTHS, dp))
      call check(info)
    end do
    error = [largest_error(place, found, is_round), 0.0_dp]
    if (.not. present(x)) then
      print '(3a,es8.1,a,f9.3,a)', '| ', trim(name), ' | ', error(1), ' | ', 1.0e6_dp*time(1), ' | | |'
      return
    end if
    below(1, :) = x
    below(2, :) = y
    do k = 1, DEPTHS
      below(3, :) = depth(k)
      error(2) = max(error(2), largest_error(below, grid(:, :, k), is_round))
    end do
    print '(2a,2(a,es8.1,a,f9.3),a)', '| ', trim(name), (' | ', error(k), ' | ', 1.0e6_dp*time(k), k=1, 2), ' |'
  end subroutine measure

  subroutine press_sphere(contact)
    type(fuge_round_contact), intent(out) :: contact
    type(fuge_polynomial_profile) :: sphere
    type(fuge_info) :: info

    sphere%upper = 2.0_dp
    sphere%coefficients = [0.0_dp, 0.0_dp, 0.5_dp]
    call fuge_solve_round_punch(sphere, 1.0_dp, contact, info, load=4.0_dp*A**3/3.0_dp)
    call check(info)
  end subroutine press_sphere

  subroutine solve(surface, gap, load, force)
    class(fuge_operator), intent(in) :: surface
    real(dp), intent(in) :: gap(:), load
    real(dp), intent(out) :: force(:)
    type(fuge_problem) :: problem
    type(fuge_solution) :: solution
    type(fuge_solver) :: solver
    type(fuge_info) :: info

    allocate (problem%gap, source=gap)
    allocate (problem%modes(size(gap), 1), source=1.0_dp)
    allocate (problem%resultant(1), source=load)
    call solver%solve(surface, problem, solution, info)
    call check(info)
    force = solution%force
  end subroutine solve

  !> Points in |x| <= SIDE and SHALLOW <= z <= DEEP, the same in each run.
  pure function scattered() result(place)
    real(dp) :: place(3, POINTS)
    integer :: k

    do k = 1, POINTS
      place(1, k) = SIDE*(2.0_dp*modulo(real(k, dp)*0.6180339887498949_dp, 1.0_dp) - 1.0_dp)
      place(2, k) = 0.0_dp
      place(3, k) = SHALLOW + (DEEP - SHALLOW)*modulo(real(k, dp)*0.7548776662466927_dp, 1.0_dp)
    end do
  end function scattered

  !> The largest error of `found` (6, points) over p0.
  pure function largest_error(place, found, is_round) result(error)
    real(dp), intent(in) :: place(:, :), found(:, :)
    logical, intent(in) :: is_round
    real(dp) :: error
    integer :: k

    error = 0.0_dp
    do k = 1, size(place, 2)
      if (is_round) then
        error = max(error, maxval(abs(found(:, k)/(2.0_dp*A/PI) - sphere_stress(place(:, k)))))
      else
        error = max(error, maxval(abs(found(:, k)/(0.5_dp*A) - cylinder_stress(place(:, k)))))
      end if
    end do
  end function largest_error

  !> Under a cylinder, over p0 = a/2 (K. L. Johnson, Contact Mechanics, 1985, equation 4.49).
  pure function cylinder_stress(place) result(tensor)
    real(dp), intent(in) :: place(3)
    real(dp) :: tensor(6)
    real(dp) :: px, pz, half, m, n, share

    px = place(1)
    pz = place(3)
    half = 0.5_dp*(A**2 - px**2 + pz**2)
    m = sqrt(hypot(half, px*pz) + half)
    n = px*pz/m
    share = (pz**2 + n**2)/(m**2 + n**2)
    tensor = 0.0_dp
    tensor(1) = -(m*(1.0_dp + share) - 2.0_dp*pz)/A
    tensor(3) = -m*(1.0_dp - share)/A
    tensor(2) = NU*(tensor(1) + tensor(3))
    tensor(5) = -n*(m**2 - pz**2)/(m**2 + n**2)/A
  end function cylinder_stress

  !> Under a sphere, over p0 = 2 a/pi.
  pure function sphere_stress(place) result(tensor)
    real(dp), intent(in) :: place(3)
    real(dp) :: tensor(6)
    real(dp) :: axial(4), c, s, r

    r = hypot(place(1), place(2))
    c = place(1)/max(r, tiny(r))
    s = place(2)/max(r, tiny(r))
    axial = hertz_round(r/A, place(3)/A)
    tensor = [axial(1)*c**2 + axial(2)*s**2, axial(1)*s**2 + axial(2)*c**2, axial(3), axial(4)*s, axial(4)*c, &
              (axial(1) - axial(2))*s*c]
  end function sphere_stress

  !> rr, tt, zz, rz under a sphere, over p0 = 2 a/pi (M. T. Huber, Ann. Phys. 14, 1904).
  !>
  !> u is the root of u**2 - u (r**2 + z**2 - 1) = z**2, lengths in a, and 1 - z**2/u = r**2/(1 + u).
  pure function hertz_round(r, z) result(stress)
    real(dp), intent(in) :: r, z
    real(dp) :: stress(4)
    real(dp) :: u, q, bend, angle

    u = 0.5_dp*(r**2 + z**2 - 1.0_dp) + hypot(0.5_dp*(r**2 + z**2 - 1.0_dp), z)
    q = z/sqrt(u)
    angle = (1.0_dp + NU)*sqrt(u)*atan(1.0_dp/sqrt(u))
    bend = (1.0_dp - 2.0_dp*NU)/3.0_dp*(1.0_dp + q + q**2)/((1.0_dp + q)*(1.0_dp + u))
    stress(3) = -q**3*u/(u**2 + z**2)
    stress(1) = bend - stress(3) + q*(u*(1.0_dp - NU)/(1.0_dp + u) + angle - 2.0_dp)
    stress(2) = -(bend + q*(2.0_dp*NU + u*(1.0_dp - NU)/(1.0_dp + u) - angle))
    stress(4) = -r*z**2/(u**2 + z**2)*sqrt(u)/(1.0_dp + u)
  end function hertz_round

  subroutine check(info)
    type(fuge_info), intent(in) :: info

    if (info%failed()) error stop 'a step failed'
  end subroutine check

  function seconds() result(time)
    real(dp) :: time

    call cpu_time(time)
  end function seconds

end program stresses
