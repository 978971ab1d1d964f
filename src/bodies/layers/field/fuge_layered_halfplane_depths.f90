!> Stresses and displacements in a body of layers, in plane strain, at depths below the centres of a grid of cells, by
!> FFT; as fuge_layered_halfspace_depths.
module fuge_layered_halfplane_depths
  use fuge_cell_elements, only: FUGE_PERIODIC
  use fuge_depth_mixture, only: depth_mixture, OF_ALONG, OF_DOWN, OF_NN, &
    OF_SLOPE, OF_ZZ
  use fuge_depth_panels, only: depth_panels
  use fuge_elastic_moduli, only: FUGE_PLANE_STRAIN
  use fuge_grid_waves, only: grid_waves
  use fuge_halfplane_depths, only: fuge_halfplane_displacement_grid, fuge_halfplane_stress_grid
  use fuge_halfplane_grid_checks, only: check_halfplane_grid
  use fuge_halfspace_depths, only: convolve_tables
  use fuge_kinds, only: dp
  use fuge_layered_body_type, only: fuge_layered_body
  use fuge_memory, only: check_memory
  use fuge_mixture_sums, only: bytes_of_sums, mixture_sums, PLACES_OF, WAVES_OF
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, require_memory
  use fuge_stress_grid_checks, only: check_grid_strain
  implicit none
  private

  public :: fuge_layered_halfplane_displacement_grid, fuge_layered_halfplane_stress_grid

  !> Functions of the components: xx, zz, xz, and the displacements along x and z. Which of them are odd?
  integer, parameter :: FUNCTION_OF(5) = [OF_NN, OF_ZZ, OF_SLOPE, OF_ALONG, OF_DOWN]
  logical, parameter :: IS_ODD(5) = [.false., .false., .true., .true., .false.]

  !> Data of all depths.
  type :: grid_work
    logical :: periodic = .false.
    type(grid_waves) :: waves
    type(mixture_sums) :: sums
    type(depth_panels) :: panels
    type(depth_mixture) :: mixture
    !> The layer at each depth, and which depths are in the top layer.
    integer, allocatable :: layer(:), in_top(:)
    !> Factors of waves, or influence at places.
    real(dp), allocatable :: factor(:, :)
    !> What a half-plane gives in the top layer, (components, n, depths), and equal pressure on a
    !> periodic surface, (3, depths).
    real(dp), allocatable :: plain(:, :, :), uniform(:, :)
  end type grid_work

contains

  !> Stresses in a body of layers in plane strain, below the centres of equal cells side by side, in O(n log n)
  !> operations for each depth.
  !>
  !> `body` is set; they are those in the body that it was set with, not in the other one. `spacing`, `force`,
  !> `boundary`, `depth` and `stress` as for `fuge_halfplane_stress_grid`; `element` FUGE_CENTRE or FUGE_MEAN: strips of
  !> pressure. A depth at an interface is above it, or below where `below` (m, default .false.) says so: xx differs.
  !> Errors and the mean pressure of FUGE_PERIODIC as for `fuge_layered_halfspace_stress_grid`.
  !>
  !> Nine arguments: those of the cells and of the body. Errors, stress untouched: as for `fuge_halfplane_stress_grid`,
  !> FUGE_ERR_ELEMENT also for FUGE_HAT, FUGE_ERR_CALL_ORDER for a body that is not set, FUGE_ERR_GRID for a depth in a
  !> rigid base. Source: doc/theory_layers.md.
  subroutine fuge_layered_halfplane_stress_grid(body, spacing, force, element, boundary, depth, stress, info, below)
    use fuge_layer_checks, only: find_layers, refuse_hats
    type(fuge_layered_body), intent(in) :: body
    real(dp), intent(in) :: spacing, force(:), depth(:)
    integer, intent(in) :: element, boundary
    real(dp), intent(inout) :: stress(:, :, :)
    type(fuge_info), intent(out) :: info
    logical, intent(in), optional :: below(:)
    type(grid_work) :: work
    integer :: k

    call check_halfplane_grid(spacing, force, element, boundary, depth, shape(stress), 'stress', 3, info)
    call refuse_hats(element, info)
    call find_layers(body, depth, 'depth', work%layer, info, below)
    if (info%failed()) return
    if (.not. body%has_layers()) then
      call fuge_halfplane_stress_grid(spacing, force, element, boundary, depth, stress, info)
      return
    end if
    call start(work, body, spacing, force, boundary, depth, 3, info)
    if (.not. info%failed()) call fuge_halfplane_stress_grid(spacing, force, element, boundary, &
                                                             depth(work%in_top), work%plain, info)
    do k = 1, size(depth)
      if (info%failed()) exit
      call work%panels%mixture_at(work%layer(k), depth(k), work%mixture)
      call find_field(work, work%mixture, [1, 2, 3], stress(:, :, k))
      stress(:, :, k) = stress(:, :, k)/spacing
      if (work%layer(k) == 1) then
        associate (plain => work%plain(:, :, count(work%layer(:k) == 1)))
          stress(:, :, k) = stress(:, :, k) + plain
          ! The pressure, without a rounding.
          if (.not. depth(k) > 0.0_dp) stress(2:3, :, k) = plain(2:3, :)
        end associate
      end if
      if (work%periodic) call add_mean(sum(force)/(spacing*size(force))*work%uniform(:2, k), stress(:, :, k))
    end do
    call work%waves%free()
  end subroutine fuge_layered_halfplane_stress_grid

  !> Displacements in a body of layers in plane strain, below the centres of equal cells side by side, in O(n log n)
  !> operations for each depth.
  !>
  !> `body`, `element`, `depth` and `below` as for `fuge_layered_halfplane_stress_grid`; others as for
  !> `fuge_halfplane_displacement_grid`, without the moduli. Where layers slide x differs above and below the interface.
  !> On a free surface the datum is that of `fuge_halfplane_operator` with this body. With FUGE_PERIODIC displacements
  !> count from the mean at each depth, but on a rigid base from the base, as those of the operator.
  !>
  !> Nine arguments: those of the cells and of the body. Errors, displacement untouched: as for
  !> `fuge_layered_halfplane_stress_grid`. Source: as there.
  subroutine fuge_layered_halfplane_displacement_grid(body, spacing, force, element, boundary, depth, displacement, &
                                                      info, below)
    use fuge_layer_checks, only: find_layers, refuse_hats, require_finite
    type(fuge_layered_body), intent(in) :: body
    real(dp), intent(in) :: spacing, force(:), depth(:)
    integer, intent(in) :: element, boundary
    real(dp), intent(inout) :: displacement(:, :, :)
    type(fuge_info), intent(out) :: info
    logical, intent(in), optional :: below(:)
    type(grid_work) :: work
    real(dp) :: compliance
    integer :: k

    call check_halfplane_grid(spacing, force, element, boundary, depth, shape(displacement), 'displacement', 2, info)
    call refuse_hats(element, info)
    call find_layers(body, depth, 'depth', work%layer, info, below)
    if (info%failed()) return
    call check_grid_strain(force, spacing, body%least_young(), info)
    if (info%failed()) return
    if (.not. body%has_layers()) then
      call fuge_halfplane_displacement_grid(spacing, force, element, boundary, body%young(), body%poisson(), &
                                            FUGE_PLANE_STRAIN, depth, displacement, info)
      return
    end if
    call start(work, body, spacing, force, boundary, depth, 2, info)
    ! 1/(2 G) of the top layer.
    compliance = (1.0_dp + body%poisson())/body%young()
    if (.not. info%failed()) call fuge_halfplane_displacement_grid(spacing, force, element, boundary, body%young(), &
                                                                   body%poisson(), FUGE_PLANE_STRAIN, &
                                                                   depth(work%in_top), work%plain, info)
    if (work%periodic .and. .not. info%failed()) &
      call require_finite(sum(force)/(spacing*size(force))*compliance*work%uniform(3:, :), info)
    do k = 1, size(depth)
      if (info%failed()) exit
      call work%panels%mixture_at(work%layer(k), depth(k), work%mixture)
      call find_field(work, work%mixture, [5, 4], displacement(2:1:-1, :, k))
      displacement(:, :, k) = displacement(:, :, k)*(compliance/spacing)
      if (work%layer(k) == 1) displacement(:, :, k) = displacement(:, :, k) &
                                                      + work%plain(:, :, count(work%layer(:k) == 1))
      if (work%periodic) displacement(2, :, k) = displacement(2, :, k) &
        + sum(force)/(spacing*size(force))*compliance*work%uniform(3, k)
    end do
    call work%waves%free()
  end subroutine fuge_layered_halfplane_displacement_grid

  !> Fit the mixtures, compute the sums and transform the forces. FUGE_ERR_MEMORY, FUGE_ERR_UNSUPPORTED.
  subroutine start(work, body, spacing, force, boundary, depth, components, info)
    use fuge_layer_checks, only: find_uniform, points_in_top
    type(grid_work), intent(inout) :: work
    type(fuge_layered_body), intent(in) :: body
    real(dp), intent(in) :: spacing, force(:), depth(:)
    integer, intent(in) :: boundary, components
    type(fuge_info), intent(inout) :: info
    integer :: first, kind(2), n, stat

    call points_in_top(work%layer, work%in_top, info)
    if (info%failed()) return
    work%periodic = boundary == FUGE_PERIODIC
    n = size(force)
    call check_memory(8.0_dp*components*size(work%in_top)*real(n, dp), 'results at '//text(size(work%in_top)) &
                      //' depths', info)
    if (info%failed()) return
    allocate (work%plain(components, n, size(work%in_top)), &
              work%factor(0:merge(n/2, n - 1, work%periodic), 0:0), stat=stat)
    call require_memory(stat, 'results at', n, 'cells', info)
    if (work%periodic) call find_uniform(body, depth, work%layer, .true., work%uniform, info)
    if (size(depth) < 1) return
    call work%panels%fit(body, work%layer, depth, info)
    call work%panels%make_room(work%mixture, info)
    if (info%failed()) return
    kind = [merge(WAVES_OF, PLACES_OF, work%periodic), WAVES_OF]
    first = work%panels%first_length()
    call check_memory(bytes_of_sums([n, 1], [spacing, spacing], kind, first), 'a line of '//text(n)//' cells', info)
    if (info%failed()) return
    call work%sums%prepare([n, 1], [spacing, spacing], kind, first, stat)
    call require_memory(stat, 'results at', n, 'cells', info)
    if (.not. info%failed()) call work%waves%set([n, 1], [work%periodic, .true.], .not. work%periodic, info)
    if (.not. info%failed()) call work%waves%transform(force)
  end subroutine start

  !> `field` (components, n): those of the mixture with the numbers `component`, an odd one last, times the width of a
  !> cell.
  subroutine find_field(work, mixture, component, field)
    type(grid_work), intent(inout) :: work
    type(depth_mixture), intent(in) :: mixture
    integer, intent(in) :: component(:)
    real(dp), intent(inout) :: field(:, :)
    logical :: odd
    integer :: c

    do c = 1, size(component)
      odd = IS_ODD(component(c))
      call work%sums%fill_plane(mixture, FUNCTION_OF(component(c)), odd, 1, work%factor(:, 0))
      if (work%periodic) then
        work%factor(0, 0) = 0.0_dp
        call work%waves%multiply([odd, .false.], work%factor, field(c, :))
      else
        field(c, :) = work%factor(:, 0)
        if (FUNCTION_OF(component(c)) == OF_DOWN) field(c, :) = field(c, :) &
          + work%sums%line_datum(mixture, 1, 2.0_dp*size(field, 2)*work%sums%spacing(1))
      end if
    end do
    if (.not. work%periodic) call convolve_tables(work%waves, reshape([(IS_ODD(component(c)), .false., &
                                                                        c=1, size(component))], &
                                                                      [2, size(component)]), field)
  end subroutine find_field

  !> Add the stresses `uniform` (2), xx and zz, everywhere.
  pure subroutine add_mean(uniform, stress)
    real(dp), intent(in) :: uniform(2)
    real(dp), intent(inout) :: stress(:, :)

    stress(1, :) = stress(1, :) + uniform(1)
    stress(2, :) = stress(2, :) + uniform(2)
  end subroutine add_mean

end module fuge_layered_halfplane_depths
