!> Stresses and displacements at points of a body of layers in plane strain, under strips of pressure; as
!> fuge_layered_halfspace_interior.
module fuge_layered_halfplane_interior
  use fuge_cell_elements, only: datum_length
  use fuge_elastic_moduli, only: FUGE_PLANE_STRAIN
  use fuge_halfplane_interior, only: check_points, displacement_factors, fuge_halfplane_displacement, &
    fuge_halfplane_stress
  use fuge_kinds, only: dp
  use fuge_layer_checks, only: find_layers, refuse_hats, require_finite, start_points
  use fuge_layered_body_type, only: fuge_layered_body
  use fuge_status, only: fuge_info, require_memory
  use fuge_stress_checks, only: check_result
  implicit none
  private

  public :: fuge_layered_halfplane_displacement, fuge_layered_halfplane_stress

contains

  !> Stresses at points of a body of layers in plane strain, under the forces of cells.
  !>
  !> `body` is set; they are those in the body that it was set with, not in the other one. `element` FUGE_CENTRE or
  !> FUGE_MEAN: strips of pressure. `below` (points, default .false.): a point at an interface is above it, or below; xx
  !> differs. All else as in `fuge_halfplane_stress`; errors and time as in `fuge_layered_halfspace_stress`.
  !>
  !> Eleven arguments, because cells, points and result are plain arrays. Errors, stress untouched: as for
  !> `fuge_halfplane_stress`, FUGE_ERR_ELEMENT also for FUGE_HAT, FUGE_ERR_CALL_ORDER for a body that is not set,
  !> FUGE_ERR_SIZE for `below`, FUGE_ERR_GRID for a point in a rigid base. Source: doc/theory_layers.md.
  subroutine fuge_layered_halfplane_stress(body, x, width, force, element, px, pz, stress, info, below, symmetric)
    type(fuge_layered_body), intent(in) :: body
    real(dp), intent(in) :: x(:), width(:), force(:), px(:), pz(:)
    integer, intent(in) :: element
    real(dp), intent(inout) :: stress(:, :)
    type(fuge_info), intent(out) :: info
    logical, intent(in), optional :: below(:), symmetric
    real(dp), allocatable :: found(:, :), plain(:, :)
    integer, allocatable :: layer(:), in_top(:)
    integer :: k

    call check(body, x, width, force, element, px, pz, layer, info, below, symmetric)
    call check_result(shape(stress), 'stress', 3, size(pz), info)
    if (info%failed()) return
    call start_points(layer, 3, in_top, plain, found, info)
    if (.not. info%failed()) call fuge_halfplane_stress(x, width, force, element, px(in_top), pz(in_top), plain, info, &
                                                        symmetric)
    if (info%failed()) return
    call add_layers(body, x, width, force, layer, px, pz, found, info, symmetric)
    if (info%failed()) return
    do k = 1, size(in_top)
      found(:, in_top(k)) = found(:, in_top(k)) + plain(:, k)
      ! The pressure, without a rounding.
      if (.not. pz(in_top(k)) > 0.0_dp) found(2:3, in_top(k)) = plain(2:3, k)
    end do
    stress = found
  end subroutine fuge_layered_halfplane_stress

  !> Displacements at points of a body of layers in plane strain, under the forces of cells.
  !>
  !> As `fuge_layered_halfplane_stress`; out: `displacement` (2, points) along x and z, length. Along z the datum is
  !> that of `fuge_layered_halfplane_matrix`, so that at the surface the displacement of a point is that matrix (with
  !> FUGE_CENTRE and the other body rigid) times the forces. Where layers slide x differs above and below the interface.
  !> Errors, displacement untouched: as there, and FUGE_ERR_OVERFLOW for moduli out of range. Source: as there. Eleven
  !> arguments: as there.
  subroutine fuge_layered_halfplane_displacement(body, x, width, force, element, px, pz, displacement, info, below, &
                                                 symmetric)
    type(fuge_layered_body), intent(in) :: body
    real(dp), intent(in) :: x(:), width(:), force(:), px(:), pz(:)
    integer, intent(in) :: element
    real(dp), intent(inout) :: displacement(:, :)
    type(fuge_info), intent(out) :: info
    logical, intent(in), optional :: below(:), symmetric
    real(dp), allocatable :: found(:, :), plain(:, :)
    real(dp) :: factor(3)
    integer, allocatable :: layer(:), in_top(:)
    integer :: k

    call check(body, x, width, force, element, px, pz, layer, info, below, symmetric)
    call check_result(shape(displacement), 'displacement', 2, size(pz), info)
    if (.not. info%failed()) call displacement_factors(body%young(), body%poisson(), FUGE_PLANE_STRAIN, factor, info)
    if (info%failed()) return
    call start_points(layer, 2, in_top, plain, found, info)
    if (.not. info%failed()) call fuge_halfplane_displacement(x, width, force, element, body%young(), body%poisson(), &
                                                              FUGE_PLANE_STRAIN, px(in_top), pz(in_top), plain, info, &
                                                              symmetric)
    if (info%failed()) return
    call add_layers(body, x, width, force, layer, px, pz, found, info, symmetric)
    if (info%failed()) return
    ! 1/(2 G) of the top layer.
    found = found*((1.0_dp + body%poisson())/body%young())
    do k = 1, size(in_top)
      found(:, in_top(k)) = found(:, in_top(k)) + plain(:, k)
    end do
    call require_finite(found, info)
    if (.not. info%failed()) displacement = found
  end subroutine fuge_layered_halfplane_displacement

  !> Refuse what is no load, no point or no body, and find the `layer` (points) of each point. Errors: those of
  !> `fuge_layered_halfplane_stress`.
  !>
  !> Eleven arguments: those of the public procedures.
  subroutine check(body, x, width, force, element, px, pz, layer, info, below, symmetric)
    use fuge_pressed_line, only: check_line, pressed_line
    type(fuge_layered_body), intent(in) :: body
    real(dp), intent(in) :: x(:), width(:), force(:), px(:), pz(:)
    integer, intent(in) :: element
    integer, allocatable, intent(out) :: layer(:)
    type(fuge_info), intent(inout) :: info
    logical, intent(in), optional :: below(:), symmetric
    type(pressed_line) :: line
    logical :: folded

    folded = .false.
    if (present(symmetric)) folded = symmetric
    call check_line(x, width, force, element, folded, info)
    call refuse_hats(element, info)
    call check_points(px, pz, info)
    call line%set(x, width, force, element, folded, info)
    call line%check_distances(px, pz, info)
    call find_layers(body, pz, 'pz', layer, info, below)
  end subroutine check

  !> Add the stresses (3, points), or twice the shear modulus of the top layer times the displacements (2, points), of
  !> which those in the top layer lack what a half-plane gives. FUGE_ERR_MEMORY.
  !>
  !> Ten arguments: the cells, the points, the results.
  subroutine add_layers(body, x, width, force, layer, px, pz, values, info, symmetric)
    use fuge_depth_mixture, only: depth_mixture
    use fuge_depth_panels, only: depth_panels
    use fuge_point_gaussians, only: point_gaussians, point_loads
    type(fuge_layered_body), intent(in) :: body
    real(dp), intent(in) :: x(:), width(:), force(:), px(:), pz(:)
    integer, intent(in) :: layer(:)
    real(dp), intent(inout) :: values(:, :)
    type(fuge_info), intent(inout) :: info
    logical, intent(in), optional :: symmetric
    type(point_loads) :: loads
    type(point_gaussians) :: sums
    type(depth_panels) :: panels
    type(depth_mixture) :: mixture
    real(dp) :: reach
    logical :: folded
    integer :: k, stat

    if (info%failed() .or. .not. body%has_layers()) return
    folded = .false.
    if (present(symmetric)) folded = symmetric
    call loads%take_line(x, width, force, folded, stat)
    call require_memory(stat, 'the line of', size(x), 'cells', info)
    if (stat /= 0) return
    if (size(loads%force) < 1) return
    call panels%fit(body, layer, pz, info)
    call panels%make_room(mixture, info)
    reach = datum_length(x, width, folded)
    do k = 1, size(pz)
      if (info%failed()) return
      call panels%mixture_at(layer(k), pz(k), mixture)
      call sums%add_up(loads, px(k:k), mixture%first, stat)
      call require_memory(stat, 'results at', size(pz), 'points', info)
      if (stat == 0) values(:, k) = values(:, k) + components_of(sums, mixture, reach, size(values, 1))
    end do
  end subroutine add_layers

  !> The three stresses, or two displacements, in the caller's units.
  pure function components_of(sums, mixture, reach, count) result(component)
    use fuge_depth_mixture, only: depth_mixture, OF_ALONG, OF_DOWN, OF_NN, OF_SLOPE, OF_ZZ
    use fuge_point_gaussians, only: point_gaussians, PLAIN, SLOPE_X
    type(point_gaussians), intent(in) :: sums
    type(depth_mixture), intent(in) :: mixture
    real(dp), intent(in) :: reach
    integer, intent(in) :: count
    real(dp) :: component(count)

    if (count == 3) then
      component = [sums%value(mixture, OF_NN, PLAIN), sums%value(mixture, OF_ZZ, PLAIN), &
                   sums%value(mixture, OF_SLOPE, SLOPE_X)]
      component = scale(component, sums%force_unit - sums%unit)
    else
      component = [sums%value(mixture, OF_ALONG, SLOPE_X), &
                   sums%value(mixture, OF_DOWN, PLAIN) + sums%line_datum(mixture, reach)]
      component = scale(component, sums%force_unit)
    end if
  end function components_of

end module fuge_layered_halfplane_interior
