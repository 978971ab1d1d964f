!> The paper's rigid punch y = 0.05 x**4 (mm) on an elastic half-plane: Bild 7 and 8.
!>
!>     punch [folder for its tables]
!>
!> Half model of 33 cells, 0.025 mm wide, side by side from x = 0; F in N per mm of
!> thickness. The contact ends at the outer edge of the last cell with a force; the decrease of
!> the pressure gives its edge to third order in the width.
!> For the pictures it writes punch_pressure.dat, punch_edge.dat and, from the exact load path,
!> punch_halfwidth.dat.
program punch
  use example_output, only: create_file
  use example_verdict, only: verdict
  use fuge, only: dp => fuge_dp, fuge_contact_edges, fuge_dense_operator, fuge_halfplane_matrix, fuge_info, &
    fuge_interval, fuge_load_path, fuge_path, fuge_problem, fuge_solution, fuge_solve_dense, fuge_solver, FUGE_CENTRE, &
    FUGE_EDGE_REFINED
  implicit none

  integer, parameter :: POINTS = 33
  real(dp), parameter :: SPACING = 0.025_dp, PROFILE = 0.05_dp
  real(dp), parameter :: E_STAR = 1.0e6_dp/(1.0_dp - 0.25_dp**2)
  real(dp), parameter :: PI = acos(-1.0_dp)

  call run()

contains

  subroutine run()
    real(dp), target :: alpha(POINTS, POINTS)
    real(dp) :: x(POINTS), width(POINTS)
    type(fuge_dense_operator) :: operator
    type(fuge_problem) :: problem
    type(fuge_info) :: info
    type(verdict) :: known
    integer :: file, k, kilonewtons

    x = [(SPACING*(real(k, dp) - 0.5_dp), k=1, POINTS)]
    width = SPACING
    call fuge_halfplane_matrix(x, width, E_STAR, FUGE_CENTRE, alpha, info, symmetric=.true.)
    if (.not. info%failed()) call operator%set(alpha, info)
    if (info%failed()) error stop 'no influence matrix'
    problem%gap = PROFILE*x**4
    allocate (problem%resultant(1))

    print '(a8,a29,a11,a25,a9,a9)', 'F', 'half contact length [mm]', 'error', 'largest pressure [N/mm2]', 'error', &
      'residual'
    print '(a8,a9,2a10,a11,a12,a13)', '[kN/mm]', 'cells', 'edge', 'exact', 'of edge', 'fuge', 'exact'
    call create_file('punch_edge.dat', 1, file)
    do kilonewtons = 5, 50, 5
      call one_load(operator, problem, x, real(kilonewtons, dp), known, file)
    end do
    close (file)
    call all_loads(operator, problem%gap, x)
    call all_spacings()
    call known%give('against the exact edges and pressures')
  end subroutine run

  !> Convergence of the half contact length.
  subroutine all_spacings()
    real(dp) :: error(2), coarser(2)
    integer :: cells, k

    print '(/,a)', 'Largest error of the half contact length over 101 loads from 25 to 50 kN/mm'
    print '(a12,2(a15,a8))', 'spacing [mm]', 'last cell [mm]', 'order', 'edge [mm]', 'order'
    coarser = 0.0_dp
    cells = 12
    do while (cells <= 192)
      error = largest_error(cells)
      if (cells == 12) then
        print '(f12.6,2(es15.2,8x))', 0.9_dp/real(cells, dp), error
      else
        print '(f12.6,2(es15.2,f8.1))', 0.9_dp/real(cells, dp), &
          (error(k), log(coarser(k)/error(k))/log(2.0_dp), k=1, 2)
      end if
      coarser = error
      cells = 2*cells
    end do
    if (coarser(2) > 1.0e-6_dp) error stop 'the edge of the contact has not converged'
  end subroutine all_spacings

  !> Largest error of the outer edge of the last cell and of the refined edge, for cells up to 0.9 mm.
  function largest_error(cells) result(error)
    integer, intent(in) :: cells
    real(dp) :: error(2)
    real(dp), target :: alpha(cells, cells)
    real(dp) :: x(cells), width(cells), force(cells), gap(cells), load, approach, reached(2)
    type(fuge_info) :: info
    integer :: k

    width = 0.9_dp/real(cells, dp)
    x = [(width(1)*(real(k, dp) - 0.5_dp), k=1, cells)]
    call fuge_halfplane_matrix(x, width, E_STAR, FUGE_CENTRE, alpha, info, symmetric=.true.)
    if (info%failed()) error stop 'no influence matrix'
    error = 0.0_dp
    do k = 1, 101
      load = 250.0_dp*real(99 + k, dp)
      call fuge_solve_dense(alpha, PROFILE*x**4, load, force, gap, approach, info)
      if (info%status /= 0) error stop 'the punch was not solved'
      reached(1) = maxval(x + 0.5_dp*width, mask=force > 0.0_dp)
      reached(2) = edge(x, width, force)
      error = max(error, abs(reached - half_width(load)))
    end do
  end function largest_error

  !> The half contact length, more accurate than the grid.
  function edge(x, width, force)
    real(dp), intent(in) :: x(:), width(:), force(:)
    real(dp) :: edge
    type(fuge_interval), allocatable :: intervals(:)
    type(fuge_info) :: info

    call fuge_contact_edges(x, width, force, FUGE_CENTRE, intervals, info, symmetric=.true.)
    if (info%status /= 0) error stop 'the edges were not found'
    if (size(intervals) /= 1) error stop 'more than one contact under the punch'
    if (intervals(1)%right_kind /= FUGE_EDGE_REFINED) error stop 'the edge could not be refined'
    edge = intervals(1)%right
  end function edge

  !> Bild 8 without load steps: every load up to 50 kN at which a cell joins.
  subroutine all_loads(operator, gap, x)
    type(fuge_dense_operator), intent(in) :: operator
    real(dp), intent(in) :: gap(:), x(:)
    type(fuge_path) :: path
    type(fuge_info) :: info
    integer :: k, file

    call fuge_load_path(operator, gap, 50.0e3_dp, path, info)
    if (info%status /= 0) error stop 'the load path was not found'
    call create_file('punch_halfwidth.dat', 1, file)
    do k = 2, path%entries
      write (file, '(4es16.7)') path%parameter(k)/1.0e3_dp, x(path%point(k)) + 0.5_dp*SPACING, path%motion(1, k), &
        1.0_dp/path%rate(1, k)/1.0e3_dp
    end do
    close (file)
    print '(/,a,i0,a)', 'From 0 to 50 kN/mm the contact changes ', path%entries - 1, ' times (punch_halfwidth.dat);'
    print '(a,f8.4,a)', 'the last time at ', path%parameter(path%entries)/1.0e3_dp, ' kN/mm'
  end subroutine all_loads

  subroutine one_load(operator, problem, x, kilonewtons, known, file)
    type(fuge_dense_operator), intent(in) :: operator
    type(fuge_problem), intent(inout) :: problem
    real(dp), intent(in) :: x(:), kilonewtons
    type(verdict), intent(inout) :: known
    integer, intent(in) :: file
    type(fuge_solver) :: solver
    type(fuge_solution) :: solution
    type(fuge_info) :: info
    integer :: k
    real(dp) :: pressure(POINTS), reached, refined, exact, peak

    problem%resultant(1) = 1.0e3_dp*kilonewtons
    call solver%solve(operator, problem, solution, info)
    if (info%status /= 0) error stop 'the punch was not solved'
    ! A force is that of a cell and its mirror image.
    pressure = solution%force/(2.0_dp*SPACING)

    reached = maxval(x + 0.5_dp*SPACING, mask=solution%force > 0.0_dp)
    refined = edge(x, [(SPACING, k=1, POINTS)], solution%force)
    write (file, '(f8.3,f12.7)') kilonewtons, refined
    exact = half_width(problem%resultant(1))
    peak = maxval(exact_pressure(x, exact))
    print '(f8.0,f9.3,2f10.6,f9.4,a,f12.1,f13.1,f7.2,a,es9.1)', kilonewtons, reached, refined, exact, &
      percent(refined, exact), ' %', maxval(pressure), peak, percent(maxval(pressure), peak), ' %', info%residual
    call known%compare(refined/exact - 1.0_dp, 1.0e-3_dp*SPACING/exact, 'the edge of the contact')
    call known%compare(maxval(pressure)/peak - 1.0_dp, 2.0e-3_dp, 'the largest pressure')
    if (nint(kilonewtons) == 30) then
      call write_pressure(x, pressure, exact)
      ! The number that the paper reports.
      if (abs(reached - 0.700_dp) > 1.0e-9_dp) error stop 'half contact length at 30 kN is not 0.700 mm'
    end if
  end subroutine one_load

  subroutine write_pressure(x, pressure, a)
    real(dp), intent(in) :: x(:), pressure(:), a
    integer :: file, k

    call create_file('punch_pressure.dat', 1, file)
    do k = 1, size(x)
      write (file, '(f8.4,2f14.3)') x(k), pressure(k), exact_pressure(x(k), a)
    end do
    close (file)
  end subroutine write_pressure

  !> F = (3 pi/4) E* A a**4 for a profile A x**4, A the factor `PROFILE`.
  pure function half_width(load) result(a)
    real(dp), intent(in) :: load
    real(dp) :: a

    a = (load/(0.75_dp*PI*E_STAR*PROFILE))**0.25_dp
  end function half_width

  elemental function exact_pressure(x, a) result(pressure)
    real(dp), intent(in) :: x, a
    real(dp) :: pressure

    pressure = E_STAR*PROFILE*(2.0_dp*x**2 + a**2)*sqrt(max(a**2 - x**2, 0.0_dp))
  end function exact_pressure

  pure function percent(value, reference)
    real(dp), intent(in) :: value, reference
    real(dp) :: percent

    percent = 100.0_dp*(value - reference)/reference
  end function percent

end program punch
