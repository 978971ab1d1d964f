!> Stresses below a rough surface, for the example `stress`.
module stress_rough
  use example_output, only: create_file
  use example_verdict, only: verdict
  use fuge, only: dp => fuge_dp, fuge_halfspace_field, fuge_halfspace_operator, fuge_info, fuge_options, &
    fuge_problem, fuge_solution, fuge_solver, fuge_von_mises, fuge_write_results, fuge_write_volume, &
    FUGE_MEAN, FUGE_PERIODIC
  use stress_maps, only: require, write_map, FOLDER_ARGUMENT
  use surface_heights, only: rms_gradient, self_affine_surface
  implicit none
  private

  public :: press_rough_surface

  real(dp), parameter :: POISSON = 0.3_dp, YOUNG = 1.0_dp - POISSON**2
  !> p/(E* g) with the root mean square gradient g.
  real(dp), parameter :: PRESSURE = 0.1_dp
  type(fuge_options), parameter :: OPTIONS = fuge_options(tolerance=1.0e-8_dp)
  !> Cells of the shortest wave: enough that spots of contact have many.
  integer, parameter :: SHORTEST = 16
  !> Stresses go down this many cells, a depth for each.
  integer, parameter :: DEPTHS = 64

contains

  !> The surface of the example `surface`, `cells` x `cells`, periodic; the period and E* are 1.
  subroutine press_rough_surface(cells, known)
    integer, intent(in) :: cells
    type(verdict), intent(inout) :: known
    type(fuge_halfspace_operator) :: operator
    type(fuge_problem) :: problem
    type(fuge_solver) :: solver
    type(fuge_solution) :: solution
    type(fuge_info) :: info
    real(dp), allocatable :: height(:, :)
    real(dp) :: spacing, load

    allocate (height(cells, cells))
    call self_affine_surface(cells, height, SHORTEST)
    spacing = 1.0_dp/real(cells, dp)
    call operator%set(cells, cells, spacing, spacing, 1.0_dp, info, element=FUGE_MEAN, boundary=FUGE_PERIODIC)
    call require(info)
    load = PRESSURE*rms_gradient(height, spacing)
    problem%gap = reshape(maxval(height) - height, [size(height)])
    problem%resultant = [load]
    call solver%solve(operator, problem, solution, info, OPTIONS)
    call require(info)
    print '(/,2(a,i0),a)', 'A rough surface, ', cells, ' x ', cells, ' cells, periodic; stresses over the mean pressure'
    ! The mean pressure is the load, because the period is 1.
    call go_down(cells, spacing, solution%force/load, known)
  end subroutine press_rough_surface

  !> Depth by depth, because the stresses at one depth are six numbers for each cell; forces over the mean pressure.
  subroutine go_down(cells, spacing, force, known)
    integer, intent(in) :: cells
    real(dp), intent(in) :: spacing, force(:)
    type(verdict), intent(inout) :: known
    real(dp), allocatable :: stress(:, :, :), mises(:), largest(:), volume(:, :)
    real(dp) :: depth(DEPTHS), depth_of_largest
    integer :: centre(2), j
    type(fuge_halfspace_field) :: field
    type(fuge_info) :: info

    call field%set_grid(cells, cells, spacing, spacing, force, FUGE_PERIODIC, YOUNG, POISSON, info)
    call require(info)
    allocate (stress(6, cells**2, 1), mises(cells**2), largest(cells**2), volume((cells/2)**2, DEPTHS))
    depth = [(spacing*(j - 0.5_dp), j=1, DEPTHS)]
    centre = maxloc(reshape(force, [cells, cells]))
    largest = 0.0_dp
    depth_of_largest = 0.0_dp
    print '(a19,a18,a12,a17,a12)', 'depth/shortest wave', 'mean of zz', 'lowest zz', 'mean von Mises', 'largest'
    do j = 1, DEPTHS
      call field%grid_stress(depth(j:j), stress, info)
      call require(info)
      mises = fuge_von_mises(stress(:, :, 1))
      volume(:, j) = window(mises, cells, centre)
      if (popcnt(j) == 1) call print_depth(depth(j)/(spacing*SHORTEST), stress(3, :, 1), mises, known)
      if (maxval(mises) <= maxval(largest)) cycle
      depth_of_largest = depth(j)
      largest = mises
    end do
    print '(3(a,f7.3))', 'highest pressure ', maxval(force)/spacing**2, ', largest von Mises stress ', &
      maxval(largest), ' at the depth ', depth_of_largest/(spacing*SHORTEST)
    call write_maps(window(force/spacing**2, cells, centre), window(largest, cells, centre), volume, &
                    depth_of_largest/spacing)
    call write_for_paraview(cells, spacing, force/spacing**2, depth, volume, centre)
  end subroutine go_down

  !> A line of the table; whatever the depth, the mean of zz is the mean pressure.
  subroutine print_depth(depth, zz, mises, known)
    real(dp), intent(in) :: depth, zz(:), mises(:)
    type(verdict), intent(inout) :: known
    real(dp) :: mean

    mean = sum(zz)/size(zz)
    print '(f19.4,f18.12,f12.3,f17.3,f12.3)', depth, mean, minval(zz), sum(mises)/size(mises), maxval(mises)
    call known%hold(abs(mean + 1.0_dp) <= 1.0e-9_dp, 'the equilibrium of stresses and load')
  end subroutine print_depth

  !> The values of a square about a cell, half as wide as the surface; the cell is the first one beyond the middle.
  pure function window(values, cells, centre)
    real(dp), intent(in) :: values(:)
    integer, intent(in) :: cells, centre(2)
    real(dp), allocatable :: window(:)
    integer :: across(cells/2), along(cells/2), k

    across = 1 + modulo([(centre(1) - cells/4 - 2 + k, k=1, cells/2)], cells)
    along = 1 + modulo([(centre(2) - cells/4 - 2 + k, k=1, cells/2)], cells)
    allocate (window(size(across)*size(along)))
    do k = 1, size(along)
      window((k - 1)*size(across) + 1:k*size(across)) = values(across + cells*(along(k) - 1))
    end do
  end function window

  !> For the picture: pressure and von Mises stress from above, and the von Mises stress on the cut through the middle.
  subroutine write_maps(pressure, largest, volume, depth)
    real(dp), intent(in) :: pressure(:), largest(:), volume(:, :), depth
    integer :: file, n

    n = nint(sqrt(real(size(pressure), dp)))
    call write_map('stress_rough_pressure.dat', pressure, n)
    call write_map('stress_rough_depth.dat', largest, n)
    call write_map('stress_rough_cut.dat', reshape(volume(n*n/2 + 1:n*n/2 + n, :), [n*size(volume, 2)]), n)
    call create_file('stress_rough_place.dat', FOLDER_ARGUMENT, file)
    write (file, '(i0,f9.3)') SHORTEST, depth
    close (file)
  end subroutine write_maps

  !> The pressure on the whole surface, and the von Mises stress in the body below the square, where it belongs.
  subroutine write_for_paraview(cells, spacing, pressure, depth, volume, centre)
    integer, intent(in) :: cells, centre(2)
    real(dp), intent(in) :: spacing, pressure(:), depth(:), volume(:, :)
    character(len=1024) :: folder
    type(fuge_info) :: info

    call get_command_argument(FOLDER_ARGUMENT, folder)
    if (folder == '') folder = '.'
    call fuge_write_results(trim(folder)//'/stress_surface.vti', cells, cells, spacing, spacing, ['pressure'], &
                            reshape(pressure, [size(pressure), 1]), info)
    call require(info)
    call fuge_write_volume(trim(folder)//'/stress_body.vtr', cells/2, cells/2, spacing, spacing, depth, ['von_mises'], &
                           reshape(volume, [size(volume), 1]), info, origin=spacing*(centre - 1 - cells/4))
    call require(info)
  end subroutine write_for_paraview

end module stress_rough
