!> Stresses and displacements in a half-space at depths below the centres of a grid of rectangles, by FFT.
!>
!> The forces are transformed once for all depths. On a free surface the influence of a rectangle at each distance comes
!> from the closed forms of fuge_rectangle_field; of a periodic surface the factor of each wave is known
!> (fuge_halfspace_wave_factors): with s = |q|, by K. L. Johnson, Contact Mechanics, 1985, section 3.2 (Boussinesq),
!>
!>     zz = -(1 + s z) exp(-s z) p,   xz = i q_x z exp(-s z) p,
!>     xx = -(q_x**2 (1 - s z) + 2 nu q_y**2) exp(-s z)/s**2 p,   xy = -q_x q_y (1 - 2 nu - s z) exp(-s z)/s**2 p,
!>     2 mu u_z = (2 (1 - nu) + s z) exp(-s z)/s p,   2 mu u_x = i q_x (1 - 2 nu - s z) exp(-s z)/s**2 p.
module fuge_halfspace_depths
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_constants, only: LARGEST_EXPONENT_OF_2
  use fuge_elastic_moduli, only: check_poisson, fuge_plane_modulus, FUGE_PLANE_STRAIN
  use fuge_grid_waves, only: grid_waves
  use fuge_halfplane_fft, only: FUGE_FREE, FUGE_PERIODIC
  use fuge_halfspace_grid, only: check_grid, halfspace_grid
  use fuge_halfspace_wave_factors, only: bytes_of_waves, wave_sums, wave_term
  use fuge_kinds, only: dp
  use fuge_memory, only: check_memory
  use fuge_number_text, only: text
  use fuge_rectangle_field, only: new_rectangle_rules, rectangle_displacement, rectangle_rules, rectangle_stress
  use fuge_status, only: fuge_info, report, FUGE_ERR_MEMORY, FUGE_ERR_OVERFLOW, FUGE_ERR_SIZE, FUGE_ERR_UNSUPPORTED
  use fuge_stress_grid_checks, only: check_grid_depth, check_grid_force, check_grid_result
  implicit none
  private

  public :: fuge_halfspace_displacement_grid, fuge_halfspace_stress_grid

  !> Kinds of kernels.
  logical, parameter :: EVEN(2) = [.false., .false.], ODD_X(2) = [.true., .false.], ODD_Y(2) = [.false., .true.], &
    ODD(2) = [.true., .true.]

  !> What all depths share.
  type :: grid_work
    type(halfspace_grid) :: grid
    real(dp) :: poisson = 0.0_dp
    type(grid_waves) :: waves
    type(rectangle_rules) :: rules
    !> Factors of the waves of a periodic surface, and the sums that they consist of.
    type(wave_sums) :: sums
    real(dp), allocatable :: factor(:, :)
  end type grid_work

contains

  !> Stresses in a half-space below the centres of a grid of equal rectangles, in O(n log n) operations for each depth.
  !>
  !> `nx`, `ny` cells along x and y of `spacing_x` by `spacing_y`, length; `force` (nx*ny) of the cells, compression
  !> positive, cell (i, j) at i + nx*(j - 1); `boundary` FUGE_FREE or FUGE_PERIODIC, with the periods nx*spacing_x and
  !> ny*spacing_y; `poisson` in (-1, 0.5]; `depth` (m) >= 0 in any order, length; out: `stress` (6, nx*ny, m) xx, yy, zz,
  !> yz, xz, xy below the centre of each cell at each depth, force per length squared, tension positive.
  !>
  !> Of a free surface they are those of `fuge_halfspace_stress`, with errors of about 1e-15 of the largest stress at that
  !> depth. A periodic surface has a mean pressure, which is compressive stress zz at all depths; what xx and yy it has
  !> depends on how the body is held far away. Here they are 0: a body that is held so that it cannot expand along x and
  !> y has in addition xx = yy = nu/(1 - nu) times the mean of zz.
  !>
  !> Nine arguments and two for results: the grid has four. Errors, stress untouched: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE,
  !> FUGE_ERR_WIDTH, FUGE_ERR_MODULUS (poisson), FUGE_ERR_OPTION (boundary), FUGE_ERR_UNSUPPORTED for a surface that is
  !> periodic along one direction only, FUGE_ERR_GRID for a depth < 0, FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY. Source: A. E. H.
  !> Love, Phil. Trans. R. Soc. A 228, 1929; K. L. Johnson, Contact Mechanics, 1985, section 3.2.
  subroutine fuge_halfspace_stress_grid(nx, ny, spacing_x, spacing_y, force, boundary, poisson, depth, stress, info)
    integer, intent(in) :: nx, ny, boundary
    real(dp), intent(in) :: spacing_x, spacing_y, force(:), poisson, depth(:)
    real(dp), intent(inout) :: stress(:, :, :)
    type(fuge_info), intent(out) :: info
    type(grid_work) :: work
    integer :: k

    call describe(nx, ny, spacing_x, spacing_y, boundary, poisson, work)
    call check_arguments(work, force, depth, shape(stress), 'stress', 6, info)
    if (.not. info%failed()) call start(work, force, info)
    if (.not. info%failed()) then
      do k = 1, size(depth)
        if (boundary == FUGE_PERIODIC) then
          call periodic_stress(work, sum(force), depth(k), stress(:, :, k))
        else
          call free_stress(work, depth(k), stress(:, :, k))
        end if
        stress(:, :, k) = stress(:, :, k)/(spacing_x*spacing_y)
        if (.not. depth(k) > 0.0_dp) call correct_surface(force, spacing_x*spacing_y, stress(:, :, k))
      end do
    end if
    call work%waves%free()
  end subroutine fuge_halfspace_stress_grid

  !> Displacements in a half-space below the centres of a grid of equal rectangles, in O(n log n) operations for each
  !> depth.
  !>
  !> `nx`, `ny`, `spacing_x`, `spacing_y`, `force`, `boundary` and `depth` as for `fuge_halfspace_stress_grid`; `young` > 0
  !> and `poisson` of the body, force per length squared and in (-1, 0.5]; out: `displacement` (3, nx*ny, m) along x, y, z,
  !> length. Of a free surface they are those of `fuge_halfspace_displacement`. Of a periodic surface they count, at each
  !> depth, from the mean at that depth: the compression of the body by the mean pressure is left out. A rigid body
  !> (`young` infinite) has none.
  !>
  !> Errors, displacement untouched: as for `fuge_halfspace_stress_grid`, FUGE_ERR_MODULUS also for young. Source: as there.
  subroutine fuge_halfspace_displacement_grid(nx, ny, spacing_x, spacing_y, force, boundary, young, poisson, depth, &
                                              displacement, info)
    integer, intent(in) :: nx, ny, boundary
    real(dp), intent(in) :: spacing_x, spacing_y, force(:), young, poisson, depth(:)
    real(dp), intent(inout) :: displacement(:, :, :)
    type(fuge_info), intent(out) :: info
    type(grid_work) :: work
    real(dp) :: compliance
    integer :: k

    compliance = 0.0_dp
    call check_body(young, poisson, info)
    call describe(nx, ny, spacing_x, spacing_y, boundary, poisson, work)
    call check_arguments(work, force, depth, shape(displacement), 'displacement', 3, info)
    if (.not. info%failed()) call start(work, force, info)
    if (.not. info%failed()) then
      if (ieee_is_finite(young)) compliance = 1.0_dp/young
      do k = 1, size(depth)
        if (boundary == FUGE_PERIODIC) then
          call periodic_displacement(work, depth(k), displacement(:, :, k))
        else
          call free_displacement(work, depth(k), displacement(:, :, k))
        end if
        displacement(:, :, k) = displacement(:, :, k)/spacing_x/spacing_y*compliance
      end do
    end if
    call work%waves%free()
  end subroutine fuge_halfspace_displacement_grid

  !> Refuse moduli that make no body: FUGE_ERR_NOT_FINITE, FUGE_ERR_MODULUS, FUGE_ERR_OVERFLOW.
  subroutine check_body(young, poisson, info)
    real(dp), intent(in) :: young, poisson
    type(fuge_info), intent(out) :: info
    real(dp) :: modulus

    modulus = 0.0_dp
    call fuge_plane_modulus(young, poisson, FUGE_PLANE_STRAIN, modulus, info)
    if (info%failed() .or. .not. ieee_is_finite(young)) return
    if (abs(exponent(young)) > LARGEST_EXPONENT_OF_2) call report(info, FUGE_ERR_OVERFLOW, 'young = '//text(young) &
      //' is out of range: choose other units')
  end subroutine check_body

  pure subroutine describe(nx, ny, spacing_x, spacing_y, boundary, poisson, work)
    integer, intent(in) :: nx, ny, boundary
    real(dp), intent(in) :: spacing_x, spacing_y, poisson
    type(grid_work), intent(inout) :: work

    work%grid%cells = [nx, ny]
    work%grid%spacing = [spacing_x, spacing_y]
    work%grid%boundary = boundary
    work%grid%e_star = 1.0_dp
    work%poisson = poisson
  end subroutine describe

  !> Errors as described at the public procedures, unless there is one already.
  subroutine check_arguments(work, force, depth, given, name, components, info)
    type(grid_work), intent(in) :: work
    real(dp), intent(in) :: force(:), depth(:)
    integer, intent(in) :: given(3), components
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info

    if (.not. info%failed()) call check_grid(work%grid, info)
    if (.not. info%failed()) call check_poisson(work%poisson, info)
    if (info%failed()) return
    if (size(force) /= product(work%grid%cells)) then
      call report(info, FUGE_ERR_SIZE, 'force has '//text(size(force))//' values for '//text(work%grid%cells(1))//' by ' &
                  //text(work%grid%cells(2))//' cells')
    else if (all(work%grid%boundary /= [FUGE_FREE, FUGE_PERIODIC])) then
      call report(info, FUGE_ERR_UNSUPPORTED, 'boundary = '//text(work%grid%boundary)//': there are no stresses below ' &
                  //'surfaces that are periodic along one direction only: use FUGE_FREE or FUGE_PERIODIC')
    end if
    if (.not. info%failed()) call check_grid_force(force, product(work%grid%spacing), info)
    call check_grid_depth(depth, minval(work%grid%spacing), info)
    call check_grid_result(given, name, [components, size(force), size(depth)], info)
  end subroutine check_arguments

  !> Transform the forces and prepare what all depths share. FUGE_ERR_MEMORY.
  subroutine start(work, force, info)
    type(grid_work), intent(inout) :: work
    real(dp), intent(in) :: force(:)
    type(fuge_info), intent(inout) :: info
    logical :: periodic
    integer :: stat

    periodic = work%grid%boundary == FUGE_PERIODIC
    stat = 0
    if (periodic) then
      call check_memory(bytes_of_waves(work%grid%cells, work%grid%spacing), 'a periodic grid of ' &
                        //text(work%grid%cells(1))//' by '//text(work%grid%cells(2))//' cells', info)
      if (info%failed()) return
      allocate (work%factor(0:work%grid%cells(1)/2, 0:work%grid%cells(2)/2), stat=stat)
      if (stat == 0) call work%sums%prepare(work%grid%cells, work%grid%spacing, stat)
    else
      call new_rectangle_rules(work%rules)
    end if
    if (stat /= 0) call report(info, FUGE_ERR_MEMORY, 'no memory for '//text(work%grid%cells(1))//' by ' &
                               //text(work%grid%cells(2))//' cells: use a coarser grid')
    if (.not. info%failed()) call work%waves%set(work%grid%cells, [periodic, periodic], .not. periodic, info)
    if (.not. info%failed()) call work%waves%transform(force)
  end subroutine start

  !> At z = 0 zz is the pressure, and there is no shear stress along the surface.
  pure subroutine correct_surface(force, area, stress)
    real(dp), intent(in) :: force(:), area
    real(dp), intent(inout) :: stress(:, :)
    integer :: k

    do k = 1, size(force)
      stress(3, k) = -force(k)/area
      stress(4:5, k) = 0.0_dp
    end do
  end subroutine correct_surface

  !> `stress` (6, nx*ny), times the area of a cell.
  subroutine free_stress(work, depth, stress)
    type(grid_work), intent(inout) :: work
    real(dp), intent(in) :: depth
    real(dp), intent(inout) :: stress(:, :)
    real(dp) :: half(2)
    integer :: i, j, nx

    nx = work%grid%cells(1)
    half = 0.5_dp*work%grid%spacing
    do j = 0, work%grid%cells(2) - 1
      do i = 0, nx - 1
        stress(:, 1 + i + nx*j) = rectangle_stress(work%rules, real(i, dp)*work%grid%spacing(1), &
                                                   real(j, dp)*work%grid%spacing(2), depth, half(1), half(2), work%poisson)
      end do
    end do
    call work%waves%clear_kernels()
    call work%waves%add_kernel(EVEN, stress(1, :))
    call work%waves%add_kernel(ODD_Y, stress(4, :))
    call work%waves%add_kernel(ODD_X, stress(5, :))
    call work%waves%add_kernel(ODD, stress(6, :))
    call work%waves%transform_kernels()
    call work%waves%convolve(EVEN, stress(1, :))
    call work%waves%convolve(ODD_Y, stress(4, :))
    call work%waves%convolve(ODD_X, stress(5, :))
    call work%waves%convolve(ODD, stress(6, :))
    call convolve_even(work%waves, stress(2, :))
    call convolve_even(work%waves, stress(3, :))
  end subroutine free_stress

  !> Replace an even kernel by the forces convolved with it.
  subroutine convolve_even(waves, field)
    type(grid_waves), intent(inout) :: waves
    real(dp), intent(inout) :: field(:)

    call waves%clear_kernels()
    call waves%add_kernel(EVEN, field)
    call waves%transform_kernels()
    call waves%convolve(EVEN, field)
  end subroutine convolve_even

  !> `displacement` (3, nx*ny), times Young's modulus and the area of a cell.
  subroutine free_displacement(work, depth, displacement)
    type(grid_work), intent(inout) :: work
    real(dp), intent(in) :: depth
    real(dp), intent(inout) :: displacement(:, :)
    real(dp) :: half(2)
    integer :: i, j, nx

    nx = work%grid%cells(1)
    half = 0.5_dp*work%grid%spacing
    do j = 0, work%grid%cells(2) - 1
      do i = 0, nx - 1
        displacement(:, 1 + i + nx*j) = rectangle_displacement(work%rules, real(i, dp)*work%grid%spacing(1), &
                                                               real(j, dp)*work%grid%spacing(2), depth, half(1), half(2), &
                                                               work%poisson)
      end do
    end do
    call work%waves%clear_kernels()
    call work%waves%add_kernel(ODD_X, displacement(1, :))
    call work%waves%add_kernel(ODD_Y, displacement(2, :))
    call work%waves%add_kernel(EVEN, displacement(3, :))
    call work%waves%transform_kernels()
    call work%waves%convolve(ODD_X, displacement(1, :))
    call work%waves%convolve(ODD_Y, displacement(2, :))
    call work%waves%convolve(EVEN, displacement(3, :))
  end subroutine free_displacement

  !> `stress` (6, nx*ny), times the area of a cell; `load` is the sum of the forces.
  subroutine periodic_stress(work, load, depth, stress)
    type(grid_work), intent(inout) :: work
    real(dp), intent(in) :: load, depth
    real(dp), intent(inout) :: stress(:, :)
    real(dp) :: nu, z

    nu = work%poisson
    z = depth/work%sums%unit
    call multiply_waves(work, EVEN, z, [wave_term([2, 0], over_square=-1.0_dp, over_wave=z), &
                                        wave_term([0, 2], over_square=-2.0_dp*nu)], stress(1, :))
    call multiply_waves(work, EVEN, z, [wave_term([0, 2], over_square=-1.0_dp, over_wave=z), &
                                        wave_term([2, 0], over_square=-2.0_dp*nu)], stress(2, :))
    call multiply_waves(work, EVEN, z, [wave_term([0, 0], rising=-1.0_dp)], stress(3, :))
    call multiply_waves(work, ODD_Y, z, [wave_term([0, 1], plain=z)], stress(4, :))
    call multiply_waves(work, ODD_X, z, [wave_term([1, 0], plain=z)], stress(5, :))
    call multiply_waves(work, ODD, z, [wave_term([1, 1], over_square=-(1.0_dp - 2.0_dp*nu), over_wave=z)], stress(6, :))
    stress(3, :) = stress(3, :) - load/real(size(stress, 2), dp)
  end subroutine periodic_stress

  !> `displacement` (3, nx*ny), times Young's modulus and the area of a cell.
  subroutine periodic_displacement(work, depth, displacement)
    type(grid_work), intent(inout) :: work
    real(dp), intent(in) :: depth
    real(dp), intent(inout) :: displacement(:, :)
    real(dp) :: factor, nu, z

    nu = work%poisson
    z = depth/work%sums%unit
    ! Young's modulus over twice the shear modulus.
    factor = (1.0_dp + nu)*work%sums%unit
    call multiply_waves(work, ODD_X, z, [wave_term([1, 0], over_square=factor*(1.0_dp - 2.0_dp*nu), &
                                                   over_wave=-factor*z)], displacement(1, :))
    call multiply_waves(work, ODD_Y, z, [wave_term([0, 1], over_square=factor*(1.0_dp - 2.0_dp*nu), &
                                                   over_wave=-factor*z)], displacement(2, :))
    call multiply_waves(work, EVEN, z, [wave_term([0, 0], over_wave=2.0_dp*factor*(1.0_dp - nu), plain=factor*z)], &
                        displacement(3, :))
  end subroutine periodic_displacement

  !> `field`: the response to the forces without their mean; `depth` in the unit of the waves.
  subroutine multiply_waves(work, kind, depth, terms, field)
    type(grid_work), intent(inout) :: work
    logical, intent(in) :: kind(2)
    real(dp), intent(in) :: depth
    type(wave_term), intent(in) :: terms(:)
    real(dp), intent(inout) :: field(:)
    integer :: k

    work%factor = 0.0_dp
    do k = 1, size(terms)
      call work%sums%add_term(terms(k), depth, work%factor)
    end do
    work%factor(0, 0) = 0.0_dp
    call work%waves%multiply(kind, work%factor, field)
  end subroutine multiply_waves

end module fuge_halfspace_depths
