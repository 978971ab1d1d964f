!> Stresses and displacements in a body of layers at depths below the centres of a grid of rectangles, by FFT.
!>
!> In the top layer they are those of a half-space of its material (fuge_halfspace_depths) and what the layers below
!> change; deeper all of it is a mixture of Gaussians (fuge_depth_mixture), which make products of sums along both
!> directions, of places or of waves.
module fuge_layered_halfspace_depths
  use fuge_cell_elements, only: FUGE_FREE, FUGE_PERIODIC
  use fuge_depth_mixture, only: depth_mixture, OF_ALONG, OF_DIFFERENCE, &
    OF_DOWN, OF_NN, OF_SLOPE, OF_TT, OF_ZZ
  use fuge_depth_panels, only: depth_panels
  use fuge_grid_waves, only: grid_waves
  use fuge_halfspace_depths, only: check_stress_grid, convolve_tables, fuge_halfspace_displacement_grid, &
    fuge_halfspace_stress_grid, DISPLACEMENT_KINDS, STRESS_KINDS
  use fuge_halfspace_grid, only: halfspace_grid, periodic, FUGE_PERIODIC_X
  use fuge_kinds, only: dp
  use fuge_layered_body_type, only: fuge_layered_body
  use fuge_memory, only: check_memory
  use fuge_mixture_sums, only: bytes_of_sums, mixture_sums, CIRCLE_OF, PLACES_OF, WAVES_OF
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, require_memory
  use fuge_stress_grid_checks, only: check_grid_strain
  implicit none
  private

  public :: fuge_layered_halfspace_displacement_grid, fuge_layered_halfspace_stress_grid

  !> Those of the six components of the stress, and of the displacements along x, y and z.
  logical, parameter :: KINDS(2, 9) = reshape([STRESS_KINDS, DISPLACEMENT_KINDS], [2, 9])

  !> Data of all depths.
  type :: grid_work
    type(halfspace_grid) :: grid
    type(grid_waves) :: waves
    type(mixture_sums) :: sums
    type(depth_panels) :: panels
    type(depth_mixture) :: mixture
    !> The layer at each depth, and which depths are in the top layer.
    integer, allocatable :: layer(:), in_top(:)
    !> Factors of waves or influence at places; the mean along rows of a surface that is periodic along them, at the
    !> cells across, otherwise 0.
    real(dp), allocatable :: factor(:, :), mean(:)
    !> What a half-space gives in the top layer, (components, nx*ny, depths), and equal pressure on a
    !> periodic surface, (3, depths).
    real(dp), allocatable :: plain(:, :, :), uniform(:, :)
  end type grid_work

contains

  !> Stresses in a body of layers below the centres of a grid of equal rectangles, in O(n log n) operations for each
  !> depth.
  !>
  !> `body` is set; they are those in the body that it was set with, not in the other one. `nx`, `ny`, `spacing_x`,
  !> `spacing_y`, `force`, `boundary`, `depth` and `stress` as for `fuge_halfspace_stress_grid`. A depth at an interface
  !> is above it, or below where `below` (m, default .false.) says so: xx, yy and xy differ. Errors are about 1e-14 of
  !> the pressure, and of stiff films 1e-15 of their stress under the longest waves: 1e-9 of xx for films 1e6 times as
  !> stiff; up to 1e-7 where a soft incompressible layer lies between stiff ones, which slide on it as on a fluid. With
  !> FUGE_PERIODIC the mean pressure gives the half-space below the layers no stress along the surface, and the layers
  !> the same strain as it has. On a rigid base layers have no strain along the surface, and those that slide on it no
  !> resultant force along it: both are the limit of long waves in one direction.
  !>
  !> Eleven arguments, because the grid alone has four. Errors, stress untouched: as for `fuge_halfspace_stress_grid`,
  !> FUGE_ERR_CALL_ORDER for a body that is not set, FUGE_ERR_GRID for a depth in a rigid base. Source:
  !> doc/theory_layers.md.
  subroutine fuge_layered_halfspace_stress_grid(body, nx, ny, spacing_x, spacing_y, force, boundary, depth, stress, &
                                                info, below)
    use fuge_layer_checks, only: find_layers
    type(fuge_layered_body), intent(in) :: body
    integer, intent(in) :: nx, ny, boundary
    real(dp), intent(in) :: spacing_x, spacing_y, force(:), depth(:)
    real(dp), intent(inout) :: stress(:, :, :)
    type(fuge_info), intent(out) :: info
    logical, intent(in), optional :: below(:)
    type(grid_work) :: work
    integer :: k

    call describe(nx, ny, spacing_x, spacing_y, boundary, work)
    call check_stress_grid(work%grid, force, depth, shape(stress), 'stress', 6, info)
    call find_layers(body, depth, 'depth', work%layer, info, below)
    if (info%failed()) return
    if (.not. body%has_layers()) then
      call fuge_halfspace_stress_grid(nx, ny, spacing_x, spacing_y, force, boundary, body%poisson(), depth, stress, &
                                      info)
      return
    end if
    call start(work, body, force, depth, 6, info)
    if (.not. info%failed()) call fuge_halfspace_stress_grid(nx, ny, spacing_x, spacing_y, force, boundary, &
                                                             body%poisson(), depth(work%in_top), work%plain, info)
    do k = 1, size(depth)
      if (info%failed()) exit
      call work%panels%mixture_at(work%layer(k), depth(k), work%mixture)
      call find_field(work, work%mixture, 0, stress(:, :, k))
      stress(:, :, k) = stress(:, :, k)/(spacing_x*spacing_y)
      if (work%layer(k) == 1) then
        associate (plain => work%plain(:, :, count(work%layer(:k) == 1)))
          stress(:, :, k) = stress(:, :, k) + plain
          ! The pressure, without a rounding.
          if (.not. depth(k) > 0.0_dp) stress(3:5, :, k) = plain(3:5, :)
        end associate
      end if
      if (boundary == FUGE_PERIODIC) call add_mean(sum(force)/(spacing_x*spacing_y*size(force))*work%uniform(:2, k), &
                                                   stress(:, :, k))
    end do
    call work%waves%free()
  end subroutine fuge_layered_halfspace_stress_grid

  !> Displacements in a body of layers below the centres of a grid of equal rectangles, in O(n log n) operations for
  !> each depth.
  !>
  !> `body`, `depth` and `below` as for `fuge_layered_halfspace_stress_grid`; others as for
  !> `fuge_halfspace_displacement_grid`, without the moduli. Where layers slide x and y differ above and below the
  !> interface. With FUGE_PERIODIC displacements count from the mean at each depth, but on a rigid base from the base:
  !> the mean is that of the operator with this body. With one periodic direction the datum is that of
  !> `fuge_halfspace_operator` with this body.
  !>
  !> Eleven arguments: those of the grid and of the body. Errors, displacement untouched: as for
  !> `fuge_layered_halfspace_stress_grid`. Source: as there.
  subroutine fuge_layered_halfspace_displacement_grid(body, nx, ny, spacing_x, spacing_y, force, boundary, depth, &
                                                      displacement, info, below)
    use fuge_layer_checks, only: find_layers, require_finite
    type(fuge_layered_body), intent(in) :: body
    integer, intent(in) :: nx, ny, boundary
    real(dp), intent(in) :: spacing_x, spacing_y, force(:), depth(:)
    real(dp), intent(inout) :: displacement(:, :, :)
    type(fuge_info), intent(out) :: info
    logical, intent(in), optional :: below(:)
    type(grid_work) :: work
    real(dp) :: compliance
    integer :: k

    call describe(nx, ny, spacing_x, spacing_y, boundary, work)
    call check_stress_grid(work%grid, force, depth, shape(displacement), 'displacement', 3, info)
    call find_layers(body, depth, 'depth', work%layer, info, below)
    if (info%failed()) return
    call check_grid_strain(force, product(work%grid%spacing), body%least_young(), info)
    if (info%failed()) return
    if (.not. body%has_layers()) then
      call fuge_halfspace_displacement_grid(nx, ny, spacing_x, spacing_y, force, boundary, body%young(), &
                                            body%poisson(), depth, displacement, info)
      return
    end if
    call start(work, body, force, depth, 3, info)
    ! 1/(2 G) of the top layer.
    compliance = (1.0_dp + body%poisson())/body%young()
    if (.not. info%failed()) call fuge_halfspace_displacement_grid(nx, ny, spacing_x, spacing_y, force, boundary, &
                                                                   body%young(), body%poisson(), depth(work%in_top), &
                                                                   work%plain, info)
    if (boundary == FUGE_PERIODIC .and. .not. info%failed()) &
      call require_finite(sum(force)/(spacing_x*spacing_y*size(force))*compliance*work%uniform(3:, :), info)
    do k = 1, size(depth)
      if (info%failed()) exit
      call work%panels%mixture_at(work%layer(k), depth(k), work%mixture)
      call find_field(work, work%mixture, 6, displacement(:, :, k))
      displacement(:, :, k) = displacement(:, :, k)*(compliance/(spacing_x*spacing_y))
      if (work%layer(k) == 1) displacement(:, :, k) = displacement(:, :, k) &
                                                      + work%plain(:, :, count(work%layer(:k) == 1))
      if (boundary == FUGE_PERIODIC) displacement(3, :, k) = displacement(3, :, k) &
        + sum(force)/(spacing_x*spacing_y*size(force))*compliance*work%uniform(3, k)
    end do
    call work%waves%free()
  end subroutine fuge_layered_halfspace_displacement_grid

  pure subroutine describe(nx, ny, spacing_x, spacing_y, boundary, work)
    integer, intent(in) :: nx, ny, boundary
    real(dp), intent(in) :: spacing_x, spacing_y
    type(grid_work), intent(inout) :: work

    work%grid%cells = [nx, ny]
    work%grid%spacing = [spacing_x, spacing_y]
    work%grid%boundary = boundary
    work%grid%e_star = 1.0_dp
  end subroutine describe

  !> Fit the mixtures, compute the sums and transform the forces. FUGE_ERR_MEMORY, FUGE_ERR_UNSUPPORTED.
  subroutine start(work, body, force, depth, components, info)
    use fuge_layer_checks, only: find_uniform, points_in_top
    type(grid_work), intent(inout) :: work
    type(fuge_layered_body), intent(in) :: body
    real(dp), intent(in) :: force(:), depth(:)
    integer, intent(in) :: components
    type(fuge_info), intent(inout) :: info
    integer :: extent(2), first, kind(2), stat

    call points_in_top(work%layer, work%in_top, info)
    if (info%failed()) return
    call check_memory(8.0_dp*components*size(work%in_top)*real(size(force), dp), 'results at ' &
                      //text(size(work%in_top))//' depths', info)
    if (info%failed()) return
    allocate (work%plain(components, size(force), size(work%in_top)), stat=stat)
    call require_memory(stat, 'results at', size(force), 'cells', info)
    if (work%grid%boundary == FUGE_PERIODIC) call find_uniform(body, depth, work%layer, .false., work%uniform, info)
    if (size(depth) < 1) return
    call work%panels%fit(body, work%layer, depth, info)
    call work%panels%make_room(work%mixture, info)
    if (info%failed()) return
    kind = PLACES_OF
    where (periodic(work%grid)) kind = merge(WAVES_OF, CIRCLE_OF, work%grid%boundary == FUGE_PERIODIC)
    extent = merge(work%grid%cells - 1, work%grid%cells/2, kind == PLACES_OF)
    first = work%panels%first_length()
    call check_memory(bytes_of_sums(work%grid%cells, work%grid%spacing, kind, first) &
                      + 8.0_dp*product(real(extent, dp) + 1.0_dp), 'a grid of ' &
                      //text(work%grid%cells(1))//' by '//text(work%grid%cells(2))//' cells', info)
    if (info%failed()) return
    call work%sums%prepare(work%grid%cells, work%grid%spacing, kind, first, stat)
    if (stat == 0) allocate (work%factor(0:extent(1), 0:extent(2)), stat=stat)
    if (stat == 0) allocate (work%mean(maxval(work%grid%cells)), source=0.0_dp, stat=stat)
    call require_memory(stat, 'results at', size(force), 'cells', info)
    if (.not. info%failed()) call work%waves%set(work%grid%cells, periodic(work%grid), &
                                                 .not. all(periodic(work%grid)), info)
    if (.not. info%failed()) call work%waves%transform(force)
  end subroutine start

  !> `field`, (components, nx*ny), those from number `before` + 1 on of the mixture, times the area of a cell.
  subroutine find_field(work, mixture, before, field)
    type(grid_work), intent(inout) :: work
    type(depth_mixture), intent(in) :: mixture
    integer, intent(in) :: before
    real(dp), intent(inout) :: field(:, :)
    integer :: c

    do c = 1, size(field, 1)
      call fill_factor(work, mixture, before + c)
      if (work%grid%boundary == FUGE_PERIODIC) then
        work%factor(0, 0) = 0.0_dp
        call work%waves%multiply(KINDS(:, before + c), work%factor, field(c, :))
      else
        if (work%grid%boundary /= FUGE_FREE) call find_mean_of_rows(work, mixture, before + c)
        call copy_table(work, field(c, :))
      end if
    end do
    if (work%grid%boundary == FUGE_PERIODIC) return
    call convolve_tables(work%waves, KINDS(:, before + 1:before + size(field, 1)), field)
  end subroutine find_field

  !> Component `c` under unit pressure on a cell, or of a wave of it.
  subroutine fill_factor(work, mixture, c)
    type(grid_work), intent(inout) :: work
    type(depth_mixture), intent(in) :: mixture
    integer, intent(in) :: c

    work%factor = 0.0_dp
    select case (c)
    case (1, 2)
      call work%sums%add_product(mixture, OF_TT, [0, 0], work%factor)
      call work%sums%add_product(mixture, OF_DIFFERENCE, merge([2, 0], [0, 2], c == 1), work%factor)
    case (3)
      call work%sums%add_product(mixture, OF_ZZ, [0, 0], work%factor)
    case (4, 5)
      call work%sums%add_product(mixture, OF_SLOPE, merge([0, 1], [1, 0], c == 4), work%factor)
    case (6)
      call work%sums%add_product(mixture, OF_DIFFERENCE, [1, 1], work%factor)
    case (7, 8)
      call work%sums%add_product(mixture, OF_ALONG, merge([1, 0], [0, 1], c == 7), work%factor)
    case default
      call work%sums%add_product(mixture, OF_DOWN, [0, 0], work%factor)
    end select
  end subroutine fill_factor

  !> Of a surface that is periodic along one direction: the mean of component `c` along it, at the cells across.
  subroutine find_mean_of_rows(work, mixture, c)
    type(grid_work), intent(inout) :: work
    type(depth_mixture), intent(in) :: mixture
    integer, intent(in) :: c
    integer :: across, direction

    direction = merge(1, 2, work%grid%boundary == FUGE_PERIODIC_X)
    across = 3 - direction
    associate (mean => work%mean(:work%grid%cells(across)))
      if (c == across) then
        call work%sums%fill_plane(mixture, OF_NN, .false., across, mean)
      else if (c == direction) then
        call work%sums%fill_plane(mixture, OF_TT, .false., across, mean)
      else if (c == 3) then
        call work%sums%fill_plane(mixture, OF_ZZ, .false., across, mean)
      else if (c == 6 - across) then
        call work%sums%fill_plane(mixture, OF_SLOPE, .true., across, mean)
      else if (c == 6 + across) then
        call work%sums%fill_plane(mixture, OF_ALONG, .true., across, mean)
      else if (c == 9) then
        call work%sums%fill_plane(mixture, OF_DOWN, .false., across, mean)
        mean = mean + work%sums%line_datum(mixture, across, 2.0_dp*size(mean)*work%grid%spacing(across))
      else
        mean = 0.0_dp
      end if
      mean = mean/real(work%grid%cells(direction), dp)
    end associate
  end subroutine find_mean_of_rows

  !> The table of one component (nx*ny): its mean along the rows and the factor, as far as that goes: along the rows to
  !> half of a period, which is all that counts.
  pure subroutine copy_table(work, table)
    type(grid_work), intent(in) :: work
    real(dp), intent(inout) :: table(0:)
    integer :: i, j

    table = 0.0_dp
    do j = 0, ubound(work%factor, 2)
      do i = 0, ubound(work%factor, 1)
        table(i + work%grid%cells(1)*j) = work%factor(i, j) &
                                          + work%mean(1 + merge(j, i, work%grid%boundary == FUGE_PERIODIC_X))
      end do
    end do
  end subroutine copy_table

  !> Add the stresses `uniform` (2), xx = yy and zz, everywhere.
  pure subroutine add_mean(uniform, stress)
    real(dp), intent(in) :: uniform(2)
    real(dp), intent(inout) :: stress(:, :)

    stress(1, :) = stress(1, :) + uniform(1)
    stress(2, :) = stress(2, :) + uniform(1)
    stress(3, :) = stress(3, :) + uniform(2)
  end subroutine add_mean

end module fuge_layered_halfspace_depths
