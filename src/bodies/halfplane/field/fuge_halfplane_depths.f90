!> Stresses and displacements in a half-plane at depths below the centres of a grid of cells, by FFT.
!>
!> The forces are transformed once for all depths. On a free surface the influence of a cell at each distance comes from
!> the closed forms of `fuge_halfplane_stress`; of a periodic surface the factor of each wave is known
!> (fuge_halfplane_wave_factors).
module fuge_halfplane_depths
  use fuge_cell_elements, only: FUGE_PERIODIC, FUGE_HAT
  use fuge_constants, only: PI
  use fuge_grid_waves, only: grid_waves
  use fuge_halfplane_grid_checks, only: check_halfplane_grid
  use fuge_halfplane_interior, only: displacement_factors, fuge_halfplane_displacement, fuge_halfplane_stress
  use fuge_halfplane_wave_factors, only: fill_wave_factors, wave_response
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info, require_memory
  use fuge_stress_grid_checks, only: check_grid_strain
  implicit none
  private

  public :: fuge_halfplane_displacement_grid, fuge_halfplane_stress_grid

  !> Kinds of kernels.
  logical, parameter :: EVEN(2) = .false., ODD(2) = [.true., .false.]

  !> Data that all depths share.
  type :: grid_work
    type(grid_waves) :: waves
    !> Distances of the cells from the first one and depth of the points, in units of the spacing.
    real(dp), allocatable :: offset(:), level(:)
    !> Factors of the waves of a periodic surface.
    real(dp), allocatable :: factor(:, :)
  end type grid_work

contains

  !> Stresses in a half-plane below the centres of equal cells side by side, in O(n log n) operations for each depth.
  !>
  !> `spacing` width of the cells, length; `force` (n) of the cells, per unit depth, compression positive; `element`
  !> FUGE_CENTRE or FUGE_MEAN (strips of pressure force/spacing), FUGE_HAT; `boundary` FUGE_FREE or FUGE_PERIODIC with
  !> the period n*spacing; `depth` (m) >= 0 in any order, length; out: `stress` (3, n, m) xx, zz, xz below the centre of
  !> each cell at each depth, force per length squared, tension positive.
  !>
  !> Of a free surface they are those of `fuge_halfplane_stress`, with errors of about 1e-15 of the largest stress at
  !> that depth. A periodic surface has a mean pressure, which is compressive stress zz at all depths; what xx it has
  !> depends on how the body is held far away. Here it is 0: a body that is held so that it cannot expand along x has in
  !> addition xx = nu/(1 - nu) times the mean of zz in plane strain.
  !>
  !> Errors, stress untouched: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH, FUGE_ERR_ELEMENT, FUGE_ERR_OPTION
  !> (boundary), FUGE_ERR_GRID for a depth < 0, FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY, FUGE_ERR_UNSUPPORTED in a library
  !> without FFTW. Source: K. L. Johnson, Contact Mechanics, 1985, sections 2.5 and 13.2.
  subroutine fuge_halfplane_stress_grid(spacing, force, element, boundary, depth, stress, info)
    real(dp), intent(in) :: spacing, force(:), depth(:)
    integer, intent(in) :: element, boundary
    real(dp), intent(inout) :: stress(:, :, :)
    type(fuge_info), intent(out) :: info
    type(grid_work) :: work
    integer :: k

    call check_halfplane_grid(spacing, force, element, boundary, depth, shape(stress), 'stress', 3, info)
    if (.not. info%failed()) call start(force, boundary, work, info)
    do k = 1, size(depth)
      if (info%failed()) exit
      if (.not. depth(k) > 0.0_dp) then
        call surface_stress(spacing, force, boundary, stress(:, :, k))
      else if (boundary == FUGE_PERIODIC) then
        call periodic_stress(work, element == FUGE_HAT, depth(k)/spacing, sum(force), spacing, stress(:, :, k))
      else
        call free_stress(work, element, depth(k)/spacing, spacing, stress(:, :, k), info)
      end if
    end do
    call work%waves%free()
  end subroutine fuge_halfplane_stress_grid

  !> Displacements in a half-plane below the centres of equal cells side by side, in O(n log n) operations for each
  !> depth.
  !>
  !> `spacing`, `force`, `element`, `boundary` and `depth` as for `fuge_halfplane_stress_grid`; `young`, `poisson` and
  !> `plane_state` of the body as for `fuge_plane_modulus`; out: `displacement` (2, n, m) along x and z, length. Of a
  !> free surface they are those of `fuge_halfplane_displacement`, with its datum. Of a periodic surface they count, at
  !> each depth, from the mean at that depth: the compression of the body by the mean pressure is left out.
  !>
  !> Ten arguments: those of the cells and of the body. Errors, displacement untouched: as for
  !> `fuge_halfplane_stress_grid` and `fuge_plane_modulus`. Source: as there.
  subroutine fuge_halfplane_displacement_grid(spacing, force, element, boundary, young, poisson, plane_state, depth, &
                                              displacement, info)
    real(dp), intent(in) :: spacing, force(:), young, poisson, depth(:)
    integer, intent(in) :: element, boundary, plane_state
    real(dp), intent(inout) :: displacement(:, :, :)
    type(fuge_info), intent(out) :: info
    type(grid_work) :: work
    real(dp) :: factor(3), datum
    integer :: k

    call displacement_factors(young, poisson, plane_state, factor, info)
    if (.not. info%failed()) call check_halfplane_grid(spacing, force, element, boundary, depth, shape(displacement), &
                                                       'displacement', 2, info)
    call check_grid_strain(force, spacing, young, info)
    if (.not. info%failed()) call start(force, boundary, work, info)
    ! From the D of one cell to that of all.
    datum = 0.0_dp
    if (.not. info%failed()) datum = factor(2)*log(real(size(force), dp))
    do k = 1, size(depth)
      if (info%failed()) exit
      if (boundary == FUGE_PERIODIC) then
        call periodic_displacement(work, element == FUGE_HAT, depth(k)/spacing, PI*factor, displacement(:, :, k))
      else
        work%level = depth(k)/spacing
        call fuge_halfplane_displacement([0.0_dp], [1.0_dp], [1.0_dp], element, young, poisson, plane_state, &
                                         work%offset, work%level, displacement(:, :, k), info, .false.)
        if (.not. info%failed()) call free_displacement(work, sum(force), datum, displacement(:, :, k))
      end if
    end do
    call work%waves%free()
  end subroutine fuge_halfplane_displacement_grid

  !> Transform the forces and allocate what a depth needs. FUGE_ERR_MEMORY.
  subroutine start(force, boundary, work, info)
    real(dp), intent(in) :: force(:)
    integer, intent(in) :: boundary
    type(grid_work), intent(inout) :: work
    type(fuge_info), intent(inout) :: info
    logical :: periodic
    integer :: n, stat

    n = size(force)
    periodic = boundary == FUGE_PERIODIC
    if (periodic) then
      allocate (work%factor(0:n/2, 0:0), stat=stat)
    else
      allocate (work%offset(n), work%level(n), stat=stat)
      if (stat == 0) call fill_offsets(work%offset)
    end if
    call require_memory(stat, '', n, 'cells', info)
    if (.not. info%failed()) call work%waves%set([n, 1], [periodic, .true.], .not. periodic, info)
    if (.not. info%failed()) call work%waves%transform(force)
  end subroutine start

  pure subroutine fill_offsets(offset)
    real(dp), intent(out) :: offset(:)
    integer :: k

    do k = 1, size(offset)
      offset(k) = real(k - 1, dp)
    end do
  end subroutine fill_offsets

  !> At z = 0 the stresses along both axes are the pressure.
  pure subroutine surface_stress(spacing, force, boundary, stress)
    real(dp), intent(in) :: spacing, force(:)
    integer, intent(in) :: boundary
    real(dp), intent(inout) :: stress(:, :)
    real(dp) :: mean
    integer :: k

    mean = 0.0_dp
    if (boundary == FUGE_PERIODIC) mean = sum(force)/real(size(force), dp)
    do k = 1, size(force)
      stress(1, k) = (mean - force(k))/spacing
      stress(2, k) = -force(k)/spacing
      stress(3, k) = 0.0_dp
    end do
  end subroutine surface_stress

  !> `depth` in units of `spacing`. FUGE_ERR_MEMORY.
  subroutine free_stress(work, element, depth, spacing, stress, info)
    type(grid_work), intent(inout) :: work
    integer, intent(in) :: element
    real(dp), intent(in) :: depth, spacing
    real(dp), intent(inout) :: stress(:, :)
    type(fuge_info), intent(inout) :: info

    work%level = depth
    call fuge_halfplane_stress([0.0_dp], [1.0_dp], [1.0_dp], element, work%offset, work%level, stress, info, .false.)
    if (info%failed()) return
    call convolve_pair(work%waves, stress(1, :), stress(3, :))
    call work%waves%clear_kernels()
    call work%waves%add_kernel(EVEN, stress(2, :))
    call work%waves%transform_kernels()
    call work%waves%convolve(EVEN, stress(2, :))
    stress = stress/spacing
  end subroutine free_stress

  !> Replace an even and an odd kernel by the forces convolved with them.
  subroutine convolve_pair(waves, even_field, odd_field)
    type(grid_waves), intent(inout) :: waves
    real(dp), intent(inout) :: even_field(:), odd_field(:)

    call waves%clear_kernels()
    call waves%add_kernel(EVEN, even_field)
    call waves%add_kernel(ODD, odd_field)
    call waves%transform_kernels()
    call waves%convolve(EVEN, even_field)
    call waves%convolve(ODD, odd_field)
  end subroutine convolve_pair

  !> Replace the displacements by one cell by those by all; `load` is the sum of the forces, `datum` what is added to
  !> the displacement along z by each unit of it.
  subroutine free_displacement(work, load, datum, displacement)
    type(grid_work), intent(inout) :: work
    real(dp), intent(in) :: load, datum
    real(dp), intent(inout) :: displacement(:, :)
    real(dp) :: mean
    integer :: n

    ! Without the mean the wave of equal forces, and its rounding error, is not larger than the others.
    n = size(displacement, 2)
    mean = (2.0_dp*sum(displacement(2, :)) - displacement(2, 1))/real(2*n - 1, dp)
    displacement(2, :) = displacement(2, :) - mean
    call convolve_pair(work%waves, displacement(2, :), displacement(1, :))
    displacement(2, :) = displacement(2, :) + (mean + datum)*load
  end subroutine free_displacement

  !> `depth` in units of `spacing`; `load` is the sum of the forces.
  subroutine periodic_stress(work, hat, depth, load, spacing, stress)
    type(grid_work), intent(inout) :: work
    logical, intent(in) :: hat
    real(dp), intent(in) :: depth, load, spacing
    real(dp), intent(inout) :: stress(:, :)

    call multiply_waves(work, wave_response(-1.0_dp, 1.0_dp, 0, .false.), hat, depth, stress(1, :))
    call multiply_waves(work, wave_response(-1.0_dp, -1.0_dp, 0, .false.), hat, depth, stress(2, :))
    call multiply_waves(work, wave_response(0.0_dp, 1.0_dp, 0, .true.), hat, depth, stress(3, :))
    stress(2, :) = stress(2, :) - load/real(size(stress, 2), dp)
    stress = stress/spacing
  end subroutine periodic_stress

  !> `depth` in units of the spacing; `factor` (3): 1/(2 mu), 2/E* and (1 - 2 nu)/(2 mu).
  subroutine periodic_displacement(work, hat, depth, factor, displacement)
    type(grid_work), intent(inout) :: work
    logical, intent(in) :: hat
    real(dp), intent(in) :: depth, factor(3)
    real(dp), intent(inout) :: displacement(:, :)

    call multiply_waves(work, wave_response(factor(3), -factor(1), 1, .true.), hat, depth, displacement(1, :))
    call multiply_waves(work, wave_response(factor(2), factor(1), 1, .false.), hat, depth, displacement(2, :))
  end subroutine periodic_displacement

  !> `field`: the response to the forces without their mean.
  subroutine multiply_waves(work, response, hat, depth, field)
    type(grid_work), intent(inout) :: work
    type(wave_response), intent(in) :: response
    logical, intent(in) :: hat
    real(dp), intent(in) :: depth
    real(dp), intent(inout) :: field(:)

    call fill_wave_factors(response, size(field), hat, depth, work%factor(:, 0))
    if (response%odd) then
      call work%waves%multiply(ODD, work%factor, field)
    else
      call work%waves%multiply(EVEN, work%factor, field)
    end if
  end subroutine multiply_waves

end module fuge_halfplane_depths
