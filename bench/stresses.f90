!> Stresses in the body: error over time, of points and of grids by FFT.
!>
!>     stresses [cells ..]
!>
!> Prints Markdown tables to standard output: a cylinder on a half-plane and a sphere (nu = 0.3) on a half-space, from
!> contacts that the library solves itself on n (and n x n) cells, against Hertz's stresses. The error is the largest
!> one of any component over the largest pressure p0, in 0.2 a <= z <= 3 a; the time is that of a point, least of some
!> repetitions, the set-up included. CPU time, one thread.
program stresses
  use fuge, only: dp => fuge_dp, fuge_halfplane_operator, fuge_halfplane_stress, fuge_halfplane_stress_grid, &
    fuge_halfspace_operator, fuge_halfspace_stress, fuge_halfspace_stress_grid, fuge_info, fuge_operator, &
    fuge_polynomial_profile, fuge_problem, fuge_round_contact, fuge_round_stress, fuge_smooth_contact, &
    fuge_smooth_stress, fuge_solution, fuge_solve_round_punch, fuge_solve_smooth_punch, fuge_solver, FUGE_FREE, &
    FUGE_MEAN
  implicit none

  integer, parameter :: REPETITIONS = 3, POINTS = 10000, DEPTHS = 10
  !> Half-width of the grid and of the contact; the modulus is 1.
  real(dp), parameter :: SIDE = 1.5_dp, A = 1.0_dp, NU = 0.3_dp, PI = acos(-1.0_dp)
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
    type(fuge_info) :: info
    real(dp), allocatable :: x(:), width(:), force(:), px(:), pz(:), found(:, :), grid(:, :, :)
    real(dp) :: depth(DEPTHS), start, time(2), error(2), spacing
    integer :: k

    spacing = 2.0_dp*SIDE/real(n, dp)
    allocate (x(n), source=[((k - 0.5_dp)*spacing - SIDE, k=1, n)])
    allocate (width(n), source=spacing)
    call surface%set(n, spacing, 1.0_dp, info, element=FUGE_MEAN)
    call check(info)
    allocate (force(n))
    ! Of a cylinder of radius 1 with half-width a; mean gaps of the cells.
    call solve(surface, 0.5_dp*(x**2 + spacing**2/12.0_dp), PI*A**2/4.0_dp, force)
    allocate (found(3, POINTS), px(POINTS), pz(POINTS), grid(3, n, DEPTHS))
    call scatter(px, pz)
    depth = [(SHALLOW + (DEEP - SHALLOW)*real(k - 1, dp)/real(DEPTHS - 1, dp), k=1, DEPTHS)]
    time = huge(time)
    do k = 1, REPETITIONS
      start = seconds()
      call fuge_halfplane_stress(x, width, force, FUGE_MEAN, px, pz, found, info)
      time(1) = min(time(1), (seconds() - start)/real(POINTS, dp))
      call check(info)
      start = seconds()
      call fuge_halfplane_stress_grid(spacing, force, FUGE_MEAN, FUGE_FREE, depth, grid, info)
      time(2) = min(time(2), (seconds() - start)/real(n*DEPTHS, dp))
      call check(info)
    end do
    error(1) = line_error(px, pz, found)
    error(2) = 0.0_dp
    do k = 1, DEPTHS
      error(2) = max(error(2), line_error(x, spread(depth(k), 1, n), grid(:, :, k)))
    end do
    print '(a,i0,2(a,es8.1,a,f9.3),a)', '| ', n, (' | ', error(k), ' | ', 1.0e6_dp*time(k), k=1, 2), ' |'
  end subroutine measure_line

  subroutine measure_smooth()
    type(fuge_polynomial_profile) :: cylinder
    type(fuge_smooth_contact) :: contact
    type(fuge_info) :: info
    real(dp), allocatable :: px(:), pz(:), found(:, :)
    real(dp) :: start, time
    integer :: k

    allocate (px(POINTS), pz(POINTS), found(3, POINTS))
    cylinder%lower = -2.0_dp
    cylinder%upper = 2.0_dp
    cylinder%coefficients = [0.0_dp, 0.0_dp, 0.5_dp]
    call fuge_solve_smooth_punch(cylinder, 1.0_dp, PI*A**2/4.0_dp, contact, info)
    call check(info)
    call scatter(px, pz)
    time = huge(time)
    do k = 1, REPETITIONS
      start = seconds()
      call fuge_smooth_stress(contact, px, pz, found, info)
      time = min(time, (seconds() - start)/real(POINTS, dp))
    end do
    call check(info)
    print '(a,es8.1,a,f9.3,a)', '| smooth punch | ', line_error(px, pz, found), ' | ', &
      1.0e6_dp*time, ' | | |'
  end subroutine measure_smooth

  subroutine measure_area(n)
    integer, intent(in) :: n
    type(fuge_halfspace_operator) :: surface
    type(fuge_info) :: info
    real(dp), allocatable :: x(:), y(:), width(:), force(:), px(:), py(:), pz(:), found(:, :), grid(:, :, :)
    real(dp) :: depth(DEPTHS), start, time(2), error(2), spacing
    integer :: j, k

    spacing = 2.0_dp*SIDE/real(n, dp)
    allocate (x(n*n), source=[(((k - 0.5_dp)*spacing - SIDE, k=1, n), j=1, n)])
    allocate (y(n*n), source=[(((j - 0.5_dp)*spacing - SIDE, k=1, n), j=1, n)])
    allocate (width(n*n), source=spacing)
    call surface%set(n, n, spacing, spacing, 1.0_dp, info, element=FUGE_MEAN)
    call check(info)
    allocate (force(n*n))
    call solve(surface, 0.5_dp*(x**2 + y**2 + spacing**2/6.0_dp), 4.0_dp*A**3/3.0_dp, force)
    allocate (found(6, POINTS), px(POINTS), py(POINTS), pz(POINTS), grid(6, n*n, DEPTHS))
    call scatter(px, pz)
    py = px(POINTS:1:-1)
    depth = [(SHALLOW + (DEEP - SHALLOW)*real(k - 1, dp)/real(DEPTHS - 1, dp), k=1, DEPTHS)]
    time = huge(time)
    do k = 1, REPETITIONS
      start = seconds()
      call fuge_halfspace_stress(x, y, width, width, force, NU, px, py, pz, found, info)
      time(1) = min(time(1), (seconds() - start)/real(POINTS, dp))
      call check(info)
      start = seconds()
      call fuge_halfspace_stress_grid(n, n, spacing, spacing, force, FUGE_FREE, NU, depth, grid, info)
      time(2) = min(time(2), (seconds() - start)/real(n*n*DEPTHS, dp))
      call check(info)
    end do
    error(1) = area_error(px, py, pz, found)
    error(2) = 0.0_dp
    do k = 1, DEPTHS
      error(2) = max(error(2), area_error(x, y, spread(depth(k), 1, n*n), grid(:, :, k)))
    end do
    print '(a,i0,a,i0,2(a,es8.1,a,f9.3),a)', '| ', n, ' x ', n, (' | ', error(k), ' | ', 1.0e6_dp*time(k), k=1, 2), ' |'
  end subroutine measure_area

  subroutine measure_round()
    type(fuge_round_contact) :: contact
    type(fuge_info) :: info
    real(dp), allocatable :: pr(:), pz(:), found(:, :)
    real(dp) :: start, time, error
    integer :: k

    allocate (pr(POINTS), pz(POINTS), found(4, POINTS))
    call press_sphere(contact)
    call scatter(pr, pz)
    pr = abs(pr)
    time = huge(time)
    do k = 1, REPETITIONS
      start = seconds()
      call fuge_round_stress(contact, NU, pr, pz, found, info)
      time = min(time, (seconds() - start)/real(POINTS, dp))
    end do
    call check(info)
    error = 0.0_dp
    do k = 1, POINTS
      error = max(error, maxval(abs(found(:, k)/(2.0_dp*A/PI) - hertz_round(pr(k)/A, pz(k)/A))))
    end do
    print '(a,es8.1,a,f9.3,a)', '| round punch | ', error, ' | ', 1.0e6_dp*time, ' | | |'
  end subroutine measure_round

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
  pure subroutine scatter(px, pz)
    real(dp), intent(out) :: px(:), pz(:)
    integer :: k

    do k = 1, size(px)
      px(k) = SIDE*(2.0_dp*modulo(real(k, dp)*0.6180339887498949_dp, 1.0_dp) - 1.0_dp)
      pz(k) = SHALLOW + (DEEP - SHALLOW)*modulo(real(k, dp)*0.7548776662466927_dp, 1.0_dp)
    end do
  end subroutine scatter

  !> xx, zz, xz under a cylinder, p0 = a/2 (K. L. Johnson, Contact Mechanics, 1985, equation 4.49).
  pure subroutine hertz_line(px, pz, xx, zz, xz)
    real(dp), intent(in) :: px, pz
    real(dp), intent(out) :: xx, zz, xz
    real(dp) :: half, m, n, share

    half = 0.5_dp*(A**2 - px**2 + pz**2)
    m = sqrt(hypot(half, px*pz) + half)
    n = px*pz/m
    share = (pz**2 + n**2)/(m**2 + n**2)
    xx = -0.5_dp*(m*(1.0_dp + share) - 2.0_dp*pz)
    zz = -0.5_dp*m*(1.0_dp - share)
    xz = -0.5_dp*n*(m**2 - pz**2)/(m**2 + n**2)
  end subroutine hertz_line

  !> The largest error of `found` (3, points) over p0.
  pure function line_error(px, pz, found) result(error)
    real(dp), intent(in) :: px(:), pz(:), found(:, :)
    real(dp) :: error
    real(dp) :: exact(3)
    integer :: k

    error = 0.0_dp
    do k = 1, size(px)
      call hertz_line(px(k), pz(k), exact(1), exact(2), exact(3))
      error = max(error, maxval(abs(found(:, k) - exact))/(0.5_dp*A))
    end do
  end function line_error

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

  !> The largest error of `found` (6, points) over p0.
  pure function area_error(px, py, pz, found) result(error)
    real(dp), intent(in) :: px(:), py(:), pz(:), found(:, :)
    real(dp) :: error
    real(dp) :: axial(4), c, s, r
    integer :: k

    error = 0.0_dp
    do k = 1, size(px)
      r = hypot(px(k), py(k))
      c = px(k)/max(r, tiny(r))
      s = py(k)/max(r, tiny(r))
      axial = hertz_round(r/A, pz(k)/A)
      error = max(error, maxval(abs(found(:, k)/(2.0_dp*A/PI) - &
        [axial(1)*c**2 + axial(2)*s**2, axial(1)*s**2 + axial(2)*c**2, axial(3), axial(4)*s, axial(4)*c, &
         (axial(1) - axial(2))*s*c])))
    end do
  end function area_error

  subroutine check(info)
    type(fuge_info), intent(in) :: info

    if (info%failed()) error stop 'a step failed'
  end subroutine check

  function seconds() result(time)
    real(dp) :: time

    call cpu_time(time)
  end function seconds

end program stresses
