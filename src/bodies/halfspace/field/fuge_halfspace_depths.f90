!> Stresses and displacements in a half-space at depths below the centres of a grid of rectangles, by FFT.
!>
!> The forces are transformed once for all depths. On a free surface the influence of a rectangle at each distance comes
!> from the closed forms of fuge_rectangle_field; of a periodic surface the factor of each wave is known
!> (fuge_halfspace_wave_terms), and from it the influence on one that is periodic along one direction.
module fuge_halfspace_depths
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_cell_elements, only: FUGE_FREE, FUGE_PERIODIC
  use fuge_constants, only: LARGEST_EXPONENT_OF_2
  use fuge_elastic_moduli, only: check_poisson, fuge_plane_modulus, FUGE_PLANE_STRAIN
  use fuge_grid_waves, only: grid_waves
  use fuge_halfspace_grid, only: check_grid, halfspace_grid, periodic, FUGE_PERIODIC_X
  use fuge_halfspace_wave_factors, only: bytes_of_waves, wave_sums, wave_term
  use fuge_halfspace_wave_terms, only: displacement_terms, stress_terms
  use fuge_kinds, only: dp
  use fuge_memory, only: check_memory
  use fuge_number_text, only: text
  use fuge_rectangle_field, only: new_rectangle_rules, rectangle_displacement, rectangle_rules, rectangle_stress
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_MEMORY, FUGE_ERR_OVERFLOW, FUGE_ERR_SIZE
  use fuge_stress_grid_checks, only: check_grid_depth, check_grid_force, check_grid_result, check_grid_strain
  implicit none
  private

  public :: check_stress_grid, convolve_tables, fuge_halfspace_displacement_grid, fuge_halfspace_stress_grid

  !> Kinds of kernels.
  logical, parameter :: EVEN(2) = [.false., .false.], ODD_X(2) = [.true., .false.], ODD_Y(2) = [.false., .true.], &
    ODD(2) = [.true., .true.]

  !> Those of the components.
  logical, parameter, public :: STRESS_KINDS(2, 6) = reshape([EVEN, EVEN, EVEN, ODD_Y, ODD_X, ODD], [2, 6]), &
    DISPLACEMENT_KINDS(2, 3) = reshape([ODD_X, ODD_Y, EVEN], [2, 3])

  !> Data that all depths share.
  type :: grid_work
    type(halfspace_grid) :: grid
    real(dp) :: poisson = 0.0_dp
    type(grid_waves) :: waves
    type(rectangle_rules) :: rules
    !> Factors of the waves of a periodic surface, or influence at places, and the sums that they consist of.
    type(wave_sums) :: sums
    real(dp), allocatable :: factor(:, :)
    !> Of a surface that is periodic along one direction: the mean along the rows, (components, cells across, depths).
    real(dp), allocatable :: mean(:, :, :)
  end type grid_work

contains

  !> Stresses in a half-space below the centres of a grid of equal rectangles, in O(n log n) operations for each depth.
  !>
  !> `nx`, `ny` cells along x and y of `spacing_x` by `spacing_y`, length; `force` (nx*ny) of the cells, compression
  !> positive, cell (i, j) at i + nx*(j - 1); `boundary` FUGE_FREE, or FUGE_PERIODIC with the periods nx*spacing_x and
  !> ny*spacing_y, or FUGE_PERIODIC_X, FUGE_PERIODIC_Y along one direction; `poisson` in (-1, 0.5]; `depth` (m) >= 0 in
  !> any order, length; out: `stress` (6, nx*ny, m) xx, yy, zz, yz, xz, xy below the centre of each cell at each depth,
  !> force per length squared, tension positive.
  !>
  !> Of a free surface they are those of `fuge_halfspace_stress`, with errors of about 1e-15 of the largest stress at
  !> that depth. With FUGE_PERIODIC there is a mean pressure, which is compressive stress zz at all depths; what xx and
  !> yy it has depends on how the body is held far away. Here they are 0: a body that is held so that it cannot expand
  !> along x and y has in addition xx = yy = nu/(1 - nu) times the mean of zz. With one periodic direction the mean
  !> along it is in plane strain.
  !>
  !> Ten arguments, because the grid alone has four. Errors, stress untouched: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE,
  !> FUGE_ERR_WIDTH, FUGE_ERR_MODULUS (poisson), FUGE_ERR_OPTION (boundary), FUGE_ERR_GRID for a depth < 0,
  !> FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY, FUGE_ERR_UNSUPPORTED in a library without FFTW. Source: A. E. H. Love, Phil.
  !> Trans. R. Soc. A 228, 1929; K. L. Johnson, Contact Mechanics, 1985, section 3.2.
  subroutine fuge_halfspace_stress_grid(nx, ny, spacing_x, spacing_y, force, boundary, poisson, depth, stress, info)
    integer, intent(in) :: nx, ny, boundary
    real(dp), intent(in) :: spacing_x, spacing_y, force(:), poisson, depth(:)
    real(dp), intent(inout) :: stress(:, :, :)
    type(fuge_info), intent(out) :: info
    type(grid_work) :: work
    integer :: k

    call describe(nx, ny, spacing_x, spacing_y, boundary, poisson, work)
    if (.not. info%failed()) call check_poisson(poisson, info)
    call check_stress_grid(work%grid, force, depth, shape(stress), 'stress', 6, info)
    if (.not. info%failed()) call start(work, force, info)
    call find_means(work, 6, depth, info)
    do k = 1, size(depth)
      if (info%failed()) exit
      if (boundary == FUGE_PERIODIC) then
        call periodic_stress(work, sum(force), depth(k), stress(:, :, k))
      else if (boundary == FUGE_FREE) then
        call free_stress(work, depth(k), stress(:, :, k))
      else
        call row_stress(work, work%mean(:, :, k), depth(k), stress(:, :, k))
      end if
      stress(:, :, k) = stress(:, :, k)/(spacing_x*spacing_y)
      if (.not. depth(k) > 0.0_dp) call correct_surface(force, spacing_x*spacing_y, stress(:, :, k))
    end do
    call work%waves%free()
  end subroutine fuge_halfspace_stress_grid

  !> Displacements in a half-space below the centres of a grid of equal rectangles, in O(n log n) operations for each
  !> depth.
  !>
  !> `nx`, `ny`, `spacing_x`, `spacing_y`, `force`, `boundary` and `depth` as for `fuge_halfspace_stress_grid`; `young`
  !> > 0 and `poisson` of the body, force per length squared and in (-1, 0.5]; out: `displacement` (3, nx*ny, m) along
  !> x, y, z, length. Of a free surface they are those of `fuge_halfspace_displacement`. With FUGE_PERIODIC they count,
  !> at each depth, from the mean at that depth: the compression of the body by the mean pressure is left out. With one
  !> periodic direction the datum is that of `fuge_halfspace_operator`. A rigid body (`young` infinite) has none.
  !>
  !> Eleven arguments: also Young's modulus. Errors, displacement untouched: as for `fuge_halfspace_stress_grid`,
  !> FUGE_ERR_MODULUS also for young. Source: as there.
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
    call check_stress_grid(work%grid, force, depth, shape(displacement), 'displacement', 3, info)
    call check_grid_strain(force, product(work%grid%spacing), young, info)
    if (.not. info%failed()) call start(work, force, info)
    call find_means(work, 3, depth, info)
    if (.not. info%failed() .and. ieee_is_finite(young)) compliance = 1.0_dp/young
    do k = 1, size(depth)
      if (info%failed()) exit
      if (boundary == FUGE_PERIODIC) then
        call periodic_displacement(work, depth(k), displacement(:, :, k))
      else if (boundary == FUGE_FREE) then
        call free_displacement(work, depth(k), displacement(:, :, k))
      else
        call row_displacement(work, work%mean(:, :, k), sum(force), depth(k), displacement(:, :, k))
      end if
      displacement(:, :, k) = displacement(:, :, k)/spacing_x/spacing_y*compliance
    end do
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
  subroutine check_stress_grid(grid, force, depth, given, name, components, info)
    type(halfspace_grid), intent(in) :: grid
    real(dp), intent(in) :: force(:), depth(:)
    integer, intent(in) :: given(3), components
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info

    if (.not. info%failed()) call check_grid(grid, info)
    if (info%failed()) return
    if (size(force) /= product(grid%cells)) then
      call report(info, FUGE_ERR_SIZE, 'force has '//text(size(force))//' values for '//text(grid%cells(1))//' by ' &
                  //text(grid%cells(2))//' cells')
    end if
    if (.not. info%failed()) call check_grid_force(force, product(grid%spacing), info)
    call check_grid_depth(depth, minval(grid%spacing), info)
    call check_grid_result(given, name, [components, size(force), size(depth)], info)
  end subroutine check_stress_grid

  !> Transform the forces and prepare what all depths share. FUGE_ERR_MEMORY.
  subroutine start(work, force, info)
    type(grid_work), intent(inout) :: work
    real(dp), intent(in) :: force(:)
    type(fuge_info), intent(inout) :: info

    if (work%grid%boundary == FUGE_FREE) then
      call new_rectangle_rules(work%rules)
    else
      call start_periodic(work, info)
    end if
    if (.not. info%failed()) call work%waves%set(work%grid%cells, periodic(work%grid), &
                                                 .not. all(periodic(work%grid)), info)
    if (.not. info%failed()) call work%waves%transform(force)
  end subroutine start

  !> Allocate and compute the sums for a surface that is periodic. FUGE_ERR_MEMORY.
  subroutine start_periodic(work, info)
    type(grid_work), intent(inout) :: work
    type(fuge_info), intent(inout) :: info
    integer :: extent(2), stat

    extent = merge(work%grid%cells/2 + 1, work%grid%cells, periodic(work%grid))
    call check_memory(bytes_of_waves(work%grid%cells, work%grid%spacing, extent), 'a periodic grid of ' &
                      //text(work%grid%cells(1))//' by '//text(work%grid%cells(2))//' cells', info)
    if (info%failed()) return
    allocate (work%factor(0:extent(1) - 1, 0:extent(2) - 1), stat=stat)
    if (stat == 0) then
      if (work%grid%boundary == FUGE_PERIODIC) then
        call work%sums%prepare(work%grid%cells, work%grid%spacing, stat)
      else
        call work%sums%prepare_places(work%grid%cells, work%grid%spacing, direction_of_rows(work), stat)
      end if
    end if
    if (stat /= 0) call report(info, FUGE_ERR_MEMORY, 'no memory for '//text(work%grid%cells(1))//' by ' &
                               //text(work%grid%cells(2))//' cells: use a coarser grid')
  end subroutine start_periodic

  !> 1 if the surface is periodic along x, otherwise 2.
  pure function direction_of_rows(work) result(direction)
    type(grid_work), intent(in) :: work
    integer :: direction

    direction = merge(1, 2, work%grid%boundary == FUGE_PERIODIC_X)
  end function direction_of_rows

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
                                                   real(j, dp)*work%grid%spacing(2), depth, half(1), half(2), &
                                                   work%poisson)
      end do
    end do
    call convolve_tables(work%waves, STRESS_KINDS, stress)
  end subroutine free_stress

  !> Replace kernels of the `kinds` (2, components) by the forces convolved with them: `field` (components, nx*ny). As
  !> many as possible are transformed together.
  subroutine convolve_tables(waves, kinds, field)
    type(grid_waves), intent(inout) :: waves
    logical, intent(in) :: kinds(:, :)
    real(dp), intent(inout) :: field(:, :)
    logical :: done(size(kinds, 2)), together(size(kinds, 2))
    integer :: c

    done = .false.
    do while (.not. all(done))
      together = .false.
      call waves%clear_kernels()
      do c = 1, size(kinds, 2)
        if (done(c) .or. any(together .and. (kinds(1, :) .eqv. kinds(1, c)) .and. (kinds(2, :) .eqv. kinds(2, c)))) &
          cycle
        call waves%add_kernel(kinds(:, c), field(c, :))
        together(c) = .true.
      end do
      call waves%transform_kernels()
      do c = 1, size(kinds, 2)
        if (together(c)) call waves%convolve(kinds(:, c), field(c, :))
      end do
      done = done .or. together
    end do
  end subroutine convolve_tables

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
                                                               real(j, dp)*work%grid%spacing(2), depth, half(1), &
                                                               half(2), work%poisson)
      end do
    end do
    call convolve_tables(work%waves, DISPLACEMENT_KINDS, displacement)
  end subroutine free_displacement

  !> `stress` (6, nx*ny), times the area of a cell; `load` is the sum of the forces.
  subroutine periodic_stress(work, load, depth, stress)
    type(grid_work), intent(inout) :: work
    real(dp), intent(in) :: load, depth
    real(dp), intent(inout) :: stress(:, :)
    integer :: c

    do c = 1, 6
      call fill_factor(work, depth, stress_terms(c, work%poisson, depth/work%sums%unit))
      work%factor(0, 0) = 0.0_dp
      call work%waves%multiply(STRESS_KINDS(:, c), work%factor, stress(c, :))
    end do
    stress(3, :) = stress(3, :) - load/real(size(stress, 2), dp)
  end subroutine periodic_stress

  !> `displacement` (3, nx*ny), times Young's modulus and the area of a cell.
  subroutine periodic_displacement(work, depth, displacement)
    type(grid_work), intent(inout) :: work
    real(dp), intent(in) :: depth
    real(dp), intent(inout) :: displacement(:, :)
    integer :: c

    do c = 1, 3
      call fill_factor(work, depth, displacement_terms(c, work%poisson, depth/work%sums%unit))
      work%factor(0, 0) = 0.0_dp
      call work%waves%multiply(DISPLACEMENT_KINDS(:, c), work%factor, displacement(c, :))
    end do
    displacement = displacement*work%sums%unit
  end subroutine periodic_displacement

  !> The means along the rows at all depths, before a result is written, because they may fail: FUGE_ERR_MEMORY. 6
  !> `components` are stresses, 3 displacements.
  subroutine find_means(work, components, depth, info)
    use fuge_halfspace_mean_rows, only: mean_displacements, mean_stresses
    type(grid_work), intent(inout) :: work
    integer, intent(in) :: components
    real(dp), intent(in) :: depth(:)
    type(fuge_info), intent(inout) :: info
    integer :: k, stat

    if (info%failed() .or. work%grid%boundary == FUGE_FREE .or. work%grid%boundary == FUGE_PERIODIC) return
    allocate (work%mean(components, cells_across(work), size(depth)), stat=stat)
    call require_memory(stat, 'the mean along the rows at', size(depth), 'depths: ask for fewer at once', info)
    do k = 1, size(depth)
      if (info%failed()) return
      if (components == 6) then
        call mean_stresses(direction_of_rows(work), cells_in_row(work), work%poisson, depth(k)/width_of_row(work), &
                           work%mean(:, :, k), info)
      else
        call mean_displacements(direction_of_rows(work), cells_in_row(work), work%poisson, &
                                depth(k)/width_of_row(work), work%mean(:, :, k), info)
      end if
    end do
  end subroutine find_means

  !> As `periodic_stress`, of a surface that is periodic along one direction, with the `mean` along the rows.
  subroutine row_stress(work, mean, depth, stress)
    type(grid_work), intent(inout) :: work
    real(dp), intent(in) :: mean(:, :), depth
    real(dp), intent(inout) :: stress(:, :)
    integer :: c

    do c = 1, 6
      call fill_factor(work, depth, stress_terms(c, work%poisson, depth/work%sums%unit))
      call copy_table(work, mean(c, :), 1.0_dp, stress(c, :))
    end do
    call convolve_tables(work%waves, STRESS_KINDS, stress)
  end subroutine row_stress

  !> As `periodic_displacement`, of a surface that is periodic along one direction, with the `mean` along the rows;
  !> `load` is the sum of the forces.
  subroutine row_displacement(work, mean, load, depth, displacement)
    type(grid_work), intent(inout) :: work
    real(dp), intent(in) :: mean(:, :), load, depth
    real(dp), intent(inout) :: displacement(:, :)
    real(dp) :: constant, width
    integer :: c, n

    width = width_of_row(work)
    ! Without the constant the wave of equal forces, and its rounding error, is not larger than the others.
    n = size(mean, 2)
    constant = (2.0_dp*sum(mean(3, :)) - mean(3, 1))/real(2*n - 1, dp)
    do c = 1, 3
      call fill_factor(work, depth, displacement_terms(c, work%poisson, depth/work%sums%unit))
      call copy_table(work, (mean(c, :) - merge(constant, 0.0_dp, c == 3))*width, work%sums%unit, displacement(c, :))
    end do
    call convolve_tables(work%waves, DISPLACEMENT_KINDS, displacement)
    displacement(3, :) = displacement(3, :) + constant*width*load
  end subroutine row_displacement

  pure function cells_in_row(work) result(cells)
    type(grid_work), intent(in) :: work
    integer :: cells

    cells = work%grid%cells(direction_of_rows(work))
  end function cells_in_row

  pure function cells_across(work) result(cells)
    type(grid_work), intent(in) :: work
    integer :: cells

    cells = work%grid%cells(3 - direction_of_rows(work))
  end function cells_across

  pure function width_of_row(work) result(width)
    type(grid_work), intent(in) :: work
    real(dp) :: width

    width = work%grid%spacing(3 - direction_of_rows(work))
  end function width_of_row

  !> The table of one component (nx*ny): its mean along the rows and `unit` times `factor`, as far as that goes: along
  !> the rows to half of a period, which is all that counts.
  pure subroutine copy_table(work, mean, unit, table)
    type(grid_work), intent(in) :: work
    real(dp), intent(in) :: mean(0:), unit
    real(dp), intent(inout) :: table(0:)
    integer :: i, j

    table = 0.0_dp
    do j = 0, ubound(work%factor, 2)
      do i = 0, ubound(work%factor, 1)
        table(i + work%grid%cells(1)*j) = unit*work%factor(i, j) + mean(merge(j, i, direction_of_rows(work) == 1))
      end do
    end do
  end subroutine copy_table

  !> Factors of the waves, or influence at places, of what the `terms` describe.
  subroutine fill_factor(work, depth, terms)
    type(grid_work), intent(inout) :: work
    real(dp), intent(in) :: depth
    type(wave_term), intent(in) :: terms(:)
    integer :: k

    work%factor = 0.0_dp
    do k = 1, size(terms)
      call work%sums%add_term(terms(k), depth/work%sums%unit, work%factor)
    end do
  end subroutine fill_factor

end module fuge_halfspace_depths
