!> Stresses below line contacts, for the example `stress`.
module stress_lines
  use example_output, only: create_file
  use example_verdict, only: verdict
  use fuge, only: dp => fuge_dp, fuge_dense_operator, fuge_halfplane_field, fuge_halfplane_matrix, fuge_info, &
    fuge_polynomial_profile, fuge_problem, fuge_smooth_contact, fuge_smooth_punch_field, fuge_solution, &
    fuge_solve_dense, fuge_solve_smooth_punch, fuge_solver, fuge_stress_peak, FUGE_CENTRE, FUGE_HAT, FUGE_MEAN, &
    FUGE_PEAK_SINGULAR, FUGE_PLANE_STRAIN, FUGE_MEASURE_TRESCA
  use stress_known, only: flat_punch_stress, line_axis_shear
  use stress_maps, only: in_plane_shear, picture, require, write_halves, write_map, FOLDER_ARGUMENT, IN_PLANE
  implicit none
  private

  public :: press_cylinder, press_flat_punch, press_paper_punch

  real(dp), parameter :: PI = acos(-1.0_dp)
  !> The paper's punch: y = 0.05 x**4 in mm, N/mm2.
  real(dp), parameter :: POISSON = 0.25_dp, PAPER_YOUNG = 1.0e6_dp, PAPER_E_STAR = PAPER_YOUNG/(1.0_dp - POISSON**2), &
    PAPER_PROFILE = 0.05_dp
  !> The cylinder's Poisson's ratio.
  real(dp), parameter :: NU = 0.3_dp
  !> The known largest shear stress below a cylinder over p_0, at 0.786151377757423286 half widths.
  real(dp), parameter :: CYLINDER_SHEAR = 0.300283106000777608_dp

contains

  !> The paper's punch with its 33 cells, and without a grid, under two loads.
  subroutine press_paper_punch(known)
    type(verdict), intent(inout) :: known
    integer, parameter :: CELLS = 33
    real(dp), parameter :: SPACING = 0.025_dp
    real(dp), target :: alpha(CELLS, CELLS)
    real(dp) :: x(CELLS), width(CELLS), force(CELLS), gap(CELLS), load, approach
    type(fuge_polynomial_profile) :: profile
    type(fuge_smooth_contact) :: contact
    type(fuge_halfplane_field) :: below_cells
    type(fuge_smooth_punch_field) :: below_punch
    type(fuge_stress_peak) :: peaks(2)
    type(picture), parameter :: HALF = picture(0.0_dp, 1.2_dp, 1.2_dp, 240, 240)
    type(fuge_info) :: info
    integer :: k

    x = [(SPACING*(k - 0.5_dp), k=1, CELLS)]
    width = SPACING
    call fuge_halfplane_matrix(x, width, PAPER_E_STAR, FUGE_CENTRE, alpha, info, symmetric=.true.)
    call require(info)
    profile%lower = -1.0_dp
    profile%upper = 1.0_dp
    profile%coefficients = [0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, PAPER_PROFILE]
    print '(a)', 'Largest shear stress below the punch y = 0.05 x**4 mm, plane strain'
    print '(a9,a17,2a33,a24)', 'F [kN/mm]', 'half width [mm]', '33 cells [N/mm2], at x, z [mm]', &
      'no grid [N/mm2], at x, z [mm]', 'over largest pressure'
    do k = 1, 2
      load = merge(10.0e3_dp, 30.0e3_dp, k == 1)
      call fuge_solve_dense(alpha, PAPER_PROFILE*x**4, load, force, gap, approach, info)
      call require(info)
      call fuge_solve_smooth_punch(profile, PAPER_E_STAR, load, contact, info)
      call require(info)
      call below_cells%set_cells(x, width, force, FUGE_CENTRE, PAPER_YOUNG, POISSON, FUGE_PLANE_STRAIN, info, &
                                 symmetric=.true.)
      call require(info)
      call below_punch%set(contact, PAPER_YOUNG, POISSON, FUGE_PLANE_STRAIN, info)
      call require(info)
      call below_cells%largest(FUGE_MEASURE_TRESCA, peaks(1), info)
      call require(info)
      call below_punch%largest(FUGE_MEASURE_TRESCA, peaks(2), info)
      call require(info)
      print '(f9.0,f17.6,2(f15.1,2f9.4),f24.6)', load/1.0e3_dp, contact%half_width, 0.5_dp*peaks(1)%value, &
        abs(peaks(1)%place(1)), peaks(1)%place(3), 0.5_dp*peaks(2)%value, abs(peaks(2)%place(1)), peaks(2)%place(3), &
        0.5_dp*peaks(2)%value/contact%pressure(contact%half_width/sqrt(2.0_dp))
      call known%hold(abs(peaks(1)%value/peaks(2)%value - 1.0_dp) <= 0.02_dp, 'the largest stress below 33 cells')
      call write_halves(merge('stress_punch_10.dat', 'stress_punch_30.dat', k == 1), below_cells, below_punch, HALF)
    end do
  end subroutine press_paper_punch

  !> A flat punch on |x| <= 1 under a unit force at x = 1/4: it tilts and touches with its whole face.
  subroutine press_flat_punch(known)
    type(verdict), intent(inout) :: known
    integer, parameter :: CELLS = 400
    real(dp), parameter :: ECCENTRICITY = 0.25_dp
    real(dp), allocatable, target :: alpha(:, :)
    real(dp) :: x(CELLS), width(CELLS)
    type(fuge_dense_operator) :: operator
    type(fuge_problem) :: problem
    type(fuge_solver) :: solver
    type(fuge_solution) :: solution
    type(fuge_halfplane_field) :: field
    type(fuge_info) :: info
    integer :: k

    width = 2.0_dp/CELLS
    x = [(width(1)*(k - 0.5_dp*(CELLS + 1)), k=1, CELLS)]
    allocate (alpha(CELLS, CELLS))
    call fuge_halfplane_matrix(x, width, 1.0_dp, FUGE_MEAN, alpha, info)
    call require(info)
    call operator%set(alpha, info)
    call require(info)
    problem%gap = 0.0_dp*x
    problem%modes = reshape([spread(1.0_dp, 1, CELLS), x], [CELLS, 2])
    problem%resultant = [1.0_dp, ECCENTRICITY]
    call solver%solve(operator, problem, solution, info)
    call require(info)
    call field%set_cells(x, width, solution%force, FUGE_MEAN, 1.0_dp - POISSON**2, POISSON, FUGE_PLANE_STRAIN, info)
    call require(info)
    call compare_flat_punch(field, CELLS, ECCENTRICITY, known)
  end subroutine press_flat_punch

  subroutine compare_flat_punch(field, cells, eccentricity, known)
    type(fuge_halfplane_field), intent(in) :: field
    integer, intent(in) :: cells
    real(dp), intent(in) :: eccentricity
    type(verdict), intent(inout) :: known
    type(picture), parameter :: WHOLE = picture(-2.0_dp, 2.0_dp, 2.0_dp, 480, 240)
    real(dp), allocatable :: place(:, :), tensor(:, :), exact(:, :)
    type(fuge_stress_peak) :: peak
    type(fuge_info) :: info
    !> The rows of the picture that the table shows.
    integer, parameter :: ROWS(4) = [3, 12, 60, 180]
    integer :: k

    allocate (place, source=WHOLE%places())
    allocate (tensor(6, size(place, 2)), exact(3, size(place, 2)))
    call field%stress(place, tensor, info)
    call require(info)
    do k = 1, size(place, 2)
      exact(:, k) = flat_punch_stress(eccentricity, place(1, k), place(3, k))
    end do
    print '(/,a,i0,a)', 'A flat punch, tilted by a force at x = a/4, ', cells, ' cells: stresses in F/a'
    print '(a9,2a14,a32)', 'depth/a', 'largest shear', 'exact', 'largest error of xx, zz, xz'
    do k = 1, size(ROWS)
      associate (last => ROWS(k)*WHOLE%columns)
        call compare_row(place(3, last), 2.0_dp/cells, tensor(IN_PLANE, last - WHOLE%columns + 1:last), &
                         exact(:, last - WHOLE%columns + 1:last), known)
      end associate
    end do
    call field%largest(FUGE_MEASURE_TRESCA, peak, info)
    call require(info)
    call known%hold(peak%location == FUGE_PEAK_SINGULAR, 'the corner of the punch, no smooth edge')
    print '(a,f7.4,a)', 'The largest stress has no value: singular at x/a =', peak%place(1), ', a corner of the punch'
    call write_map('stress_tilt.dat', in_plane_shear(tensor(IN_PLANE, :)), WHOLE%columns)
  end subroutine compare_flat_punch

  !> A line of the table, for points at one depth. The corners make an error of first order in the width of the cells.
  subroutine compare_row(depth, width, stress, exact, known)
    real(dp), intent(in) :: depth, width, stress(:, :), exact(:, :)
    type(verdict), intent(inout) :: known
    real(dp) :: error

    error = maxval(abs(stress - exact))
    print '(f9.4,2f14.6,es32.1)', depth, maxval(in_plane_shear(stress)), maxval(in_plane_shear(exact)), error
    call known%hold(error <= 0.2_dp*width/depth*maxval(abs(exact)), 'the stresses below the flat punch')
  end subroutine compare_row

  !> A cylinder: the largest shear stress on finer and finer grids, and without one. Units are the half width of the
  !> contact and p_0; E* is 1, so that the radius is 1/2 and the load pi/2. The contact ends in the middle of a cell.
  subroutine press_cylinder(known)
    type(verdict), intent(inout) :: known
    type(fuge_polynomial_profile) :: profile
    type(fuge_smooth_contact) :: contact
    type(fuge_smooth_punch_field) :: field
    type(fuge_stress_peak) :: peak
    type(fuge_info) :: info
    real(dp) :: error(3)
    integer :: cells, file

    print '(/,a)', 'Largest shear stress below a cylinder, over p_0: known 0.3002831 at z = 0.7861514 a'
    print '(a8,3(a13,a10),a14)', 'cells', 'centre', 'error', 'mean', 'error', 'hat', 'error', 'z/a (hat)'
    call create_file('stress_cylinder.csv', FOLDER_ARGUMENT, file)
    write (file, '(a)') 'cells,centre,mean,hat'
    cells = 16
    do while (cells <= 512)
      call press_cylinder_cells(cells, error, known)
      write (file, '(i0,3('','',es11.4))') cells, abs(error)
      cells = 2*cells
    end do
    close (file)
    profile%lower = -2.0_dp
    profile%upper = 2.0_dp
    profile%coefficients = [0.0_dp, 0.0_dp, 1.0_dp]
    call fuge_solve_smooth_punch(profile, 1.0_dp, 0.5_dp*PI, contact, info)
    call require(info)
    call field%set(contact, 1.0_dp - NU**2, NU, FUGE_PLANE_STRAIN, info)
    call require(info)
    call field%largest(FUGE_MEASURE_TRESCA, peak, info)
    call require(info)
    print '(a8,f13.10,es10.1,a,f10.7)', 'no grid', 0.5_dp*peak%value, 0.5_dp*peak%value - CYLINDER_SHEAR, &
      '   at z/a =', peak%place(3)
    call known%compare(0.5_dp*peak%value/CYLINDER_SHEAR - 1.0_dp, 1.0e-9_dp, &
                       'the largest shear stress below a cylinder')
  end subroutine press_cylinder

  !> The largest shear stress in the plane on the axis, on 64 cells and known.
  subroutine write_axis(field, known)
    type(fuge_halfplane_field), intent(in) :: field
    type(verdict), intent(inout) :: known
    integer, parameter :: POINTS = 31
    real(dp) :: place(3, POINTS), tensor(6, POINTS), shear(POINTS)
    type(fuge_info) :: info
    integer :: file, k

    place = 0.0_dp
    place(3, :) = [(0.1_dp*(k - 1), k=1, POINTS)]
    call field%stress(place, tensor, info)
    call require(info)
    shear = in_plane_shear(tensor(IN_PLANE, :))
    call create_file('stress_axis_line.csv', FOLDER_ARGUMENT, file)
    write (file, '(a)') 'z/a,shear,known'
    do k = 1, POINTS
      write (file, '(f6.3,2('','',f12.8))') place(3, k), shear(k), line_axis_shear(place(3, k))
    end do
    close (file)
    call known%hold(all(abs(shear - line_axis_shear(place(3, :))) <= 1.0e-3_dp), &
                    'the shear stress on the axis of a cylinder')
  end subroutine write_axis

  !> A line of the table: a half model with `cells`/2 cells in contact, with each element.
  subroutine press_cylinder_cells(cells, error, known)
    integer, intent(in) :: cells
    real(dp), intent(out) :: error(3)
    type(verdict), intent(inout) :: known
    integer, parameter :: ELEMENTS(3) = [FUGE_CENTRE, FUGE_MEAN, FUGE_HAT]
    real(dp), target :: alpha(cells/2 + 2, cells/2 + 2)
    real(dp), dimension(cells/2 + 2) :: x, width, force, gap
    real(dp) :: approach, value(3)
    type(fuge_halfplane_field) :: field
    type(fuge_stress_peak) :: peak
    type(fuge_info) :: info
    integer :: k

    width = 2.0_dp/(cells + 1)
    x = [(width(1)*(k - 0.5_dp), k=1, size(x))]
    do k = 1, 3
      call fuge_halfplane_matrix(x, width, 1.0_dp, ELEMENTS(k), alpha, info, symmetric=.true.)
      call require(info)
      call fuge_solve_dense(alpha, x**2, 0.5_dp*PI, force, gap, approach, info)
      call require(info)
      call field%set_cells(x, width, force, ELEMENTS(k), 1.0_dp - NU**2, NU, FUGE_PLANE_STRAIN, info, symmetric=.true.)
      call require(info)
      call field%largest(FUGE_MEASURE_TRESCA, peak, info)
      call require(info)
      value(k) = 0.5_dp*peak%value
    end do
    if (cells == 64) call write_axis(field, known)
    error = value - CYLINDER_SHEAR
    print '(i8,3(f13.8,es10.1),f14.7)', cells, (value(k), error(k), k=1, 3), peak%place(3)
    call known%hold(all(abs(error) <= 0.1_dp/cells**2), 'the largest shear stress below cells, of second order')
  end subroutine press_cylinder_cells

end module stress_lines
