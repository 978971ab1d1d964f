!> Stresses and displacements at points of a body of layers, under uniform pressures on rectangles.
!>
!> In the top layer they are those of a half-space of its material (fuge_halfspace_interior) and what the layers below
!> change; deeper all of it is a mixture of Gaussians (fuge_depth_panels), averaged over the rectangles
!> (fuge_point_gaussians).
module fuge_layered_halfspace_interior
  use fuge_halfspace_interior, only: check_points, fuge_halfspace_displacement, fuge_halfspace_stress, given_symmetry
  use fuge_kinds, only: dp
  use fuge_layer_checks, only: find_layers, require_finite, start_points
  use fuge_layered_body_type, only: fuge_layered_body
  use fuge_status, only: fuge_info, require_memory
  use fuge_stress_checks, only: check_displacement_range, check_result
  implicit none
  private

  public :: fuge_layered_halfspace_displacement, fuge_layered_halfspace_stress

contains

  !> Stresses at points of a body of layers under the forces of rectangles, each a uniform pressure.
  !>
  !> `body` is set; they are those in the body that it was set with, not in the other one. `below` (points, default
  !> .false.): a point at an interface is above it, or below; xx, yy and xy differ. All else as in
  !> `fuge_halfspace_stress`. Errors are about 1e-13 of the pressure, otherwise as for
  !> `fuge_layered_halfspace_stress_grid`. The time grows with the number of points times that of rectangles: on regular
  !> grids `fuge_layered_halfspace_stress_grid` is faster.
  !>
  !> Errors, `stress` untouched: as for `fuge_halfspace_stress`; FUGE_ERR_CALL_ORDER for a body that is not set;
  !> FUGE_ERR_SIZE for `below`; FUGE_ERR_GRID for a point in a rigid base. Source: doc/theory_layers.md. Fourteen
  !> arguments: the order is that of the C interface.
  subroutine fuge_layered_halfspace_stress(body, x, y, width_x, width_y, force, px, py, pz, stress, info, below, &
                                           symmetric_x, symmetric_y)
    use fuge_pressed_area, only: check_area
    type(fuge_layered_body), intent(in) :: body
    real(dp), intent(in) :: x(:), y(:), width_x(:), width_y(:), force(:), px(:), py(:), pz(:)
    real(dp), intent(inout) :: stress(:, :)
    type(fuge_info), intent(out) :: info
    logical, intent(in), optional :: below(:), symmetric_x, symmetric_y
    real(dp), allocatable :: found(:, :), plain(:, :)
    integer, allocatable :: layer(:), in_top(:)
    integer :: k

    call check_area(x, y, width_x, width_y, force, given_symmetry(symmetric_x, symmetric_y), info)
    call check_points(px, py, pz, info)
    call check_result(shape(stress), 'stress', 6, size(pz), info)
    call find_layers(body, pz, 'pz', layer, info, below)
    if (info%failed()) return
    call start_points(layer, 6, in_top, plain, found, info)
    if (.not. info%failed()) call fuge_halfspace_stress(x, y, width_x, width_y, force, body%poisson(), px(in_top), &
                                                        py(in_top), pz(in_top), plain, info, symmetric_x, symmetric_y)
    if (info%failed()) return
    call add_layers(body, x, y, width_x, width_y, force, given_symmetry(symmetric_x, symmetric_y), layer, px, py, pz, &
                    found, info)
    if (info%failed()) return
    do k = 1, size(in_top)
      found(:, in_top(k)) = found(:, in_top(k)) + plain(:, k)
      ! The pressure, without a rounding.
      if (.not. pz(in_top(k)) > 0.0_dp) found(3:5, in_top(k)) = plain(3:5, k)
    end do
    stress = found
  end subroutine fuge_layered_halfspace_stress

  !> Displacements at points of a body of layers under the forces of rectangles, each a uniform pressure.
  !>
  !> As `fuge_layered_halfspace_stress`; out: `displacement` (3, points) along x, y, z, that along z positive into the
  !> body, length. Displacements vanish far away. Where layers slide x and y differ above and below the interface. Those
  !> along z at the centres of the rectangles, z = 0, are `fuge_layered_halfspace_matrix` (FUGE_CENTRE) times `force`,
  !> with the other body rigid. Errors, `displacement` untouched: as there, and FUGE_ERR_OVERFLOW for displacements out
  !> of range. Source: as there. Fourteen arguments: as there.
  subroutine fuge_layered_halfspace_displacement(body, x, y, width_x, width_y, force, px, py, pz, displacement, info, &
                                                 below, symmetric_x, symmetric_y)
    use fuge_pressed_area, only: check_area
    type(fuge_layered_body), intent(in) :: body
    real(dp), intent(in) :: x(:), y(:), width_x(:), width_y(:), force(:), px(:), py(:), pz(:)
    real(dp), intent(inout) :: displacement(:, :)
    type(fuge_info), intent(out) :: info
    logical, intent(in), optional :: below(:), symmetric_x, symmetric_y
    real(dp), allocatable :: found(:, :), plain(:, :)
    integer, allocatable :: layer(:), in_top(:)
    integer :: k

    call check_area(x, y, width_x, width_y, force, given_symmetry(symmetric_x, symmetric_y), info)
    call check_points(px, py, pz, info)
    call check_result(shape(displacement), 'displacement', 3, size(pz), info)
    call find_layers(body, pz, 'pz', layer, info, below)
    if (.not. info%failed()) call check_displacement_range(force, min(minval(width_x), minval(width_y)), &
                                                           body%least_young(), info)
    if (info%failed()) return
    call start_points(layer, 3, in_top, plain, found, info)
    if (.not. info%failed()) call fuge_halfspace_displacement(x, y, width_x, width_y, force, body%young(), &
                                                              body%poisson(), px(in_top), py(in_top), pz(in_top), &
                                                              plain, info, symmetric_x, symmetric_y)
    if (info%failed()) return
    call add_layers(body, x, y, width_x, width_y, force, given_symmetry(symmetric_x, symmetric_y), layer, px, py, pz, &
                    found, info)
    if (info%failed()) return
    ! 1/(2 G) of the top layer.
    found = found*((1.0_dp + body%poisson())/body%young())
    do k = 1, size(in_top)
      found(:, in_top(k)) = found(:, in_top(k)) + plain(:, k)
    end do
    call require_finite(found, info)
    if (.not. info%failed()) displacement = found
  end subroutine fuge_layered_halfspace_displacement

  !> Add the stresses (6, points), or twice the shear modulus of the top layer times the displacements (3, points), of
  !> which those in the top layer lack what a half-space gives. FUGE_ERR_MEMORY.
  !>
  !> Twelve arguments: the rectangles, the points, the results.
  subroutine add_layers(body, x, y, width_x, width_y, force, symmetric, layer, px, py, pz, values, info)
    use fuge_depth_mixture, only: depth_mixture
    use fuge_depth_panels, only: depth_panels
    use fuge_point_gaussians, only: point_gaussians, point_loads
    use fuge_pressed_area, only: pressed_area
    type(fuge_layered_body), intent(in) :: body
    real(dp), intent(in) :: x(:), y(:), width_x(:), width_y(:), force(:), px(:), py(:), pz(:)
    logical, intent(in) :: symmetric(2)
    integer, intent(in) :: layer(:)
    real(dp), intent(inout) :: values(:, :)
    type(fuge_info), intent(inout) :: info
    type(pressed_area) :: area
    type(point_loads) :: loads
    type(point_gaussians) :: sums
    type(depth_panels) :: panels
    type(depth_mixture) :: mixture
    integer :: k, stat

    if (info%failed() .or. .not. body%has_layers()) return
    call area%set(x, y, width_x, width_y, force, symmetric, stat)
    if (stat == 0) call loads%take_area(area, stat)
    call require_memory(stat, 'the area of', size(x), 'rectangles', info)
    if (stat /= 0 .or. area%count < 1) return
    call panels%fit(body, layer, pz, info)
    call panels%make_room(mixture, info)
    do k = 1, size(pz)
      if (info%failed()) return
      call panels%mixture_at(layer(k), pz(k), mixture)
      call sums%add_up(loads, [px(k), py(k)], mixture%first, stat)
      call require_memory(stat, 'results at', size(pz), 'points', info)
      if (stat == 0) values(:, k) = values(:, k) + components_of(sums, mixture, size(values, 1))
    end do
  end subroutine add_layers

  !> The six stresses, or three displacements, in the caller's units.
  pure function components_of(sums, mixture, count) result(component)
    use fuge_depth_mixture, only: depth_mixture, OF_ALONG, OF_DIFFERENCE, OF_DOWN, OF_SLOPE, OF_TT, OF_ZZ
    use fuge_point_gaussians, only: point_gaussians, CURVE_X, CURVE_Y, PLAIN, SLOPE_X, SLOPE_Y, TWIST
    type(point_gaussians), intent(in) :: sums
    type(depth_mixture), intent(in) :: mixture
    integer, intent(in) :: count
    real(dp) :: component(count)
    real(dp) :: across

    if (count == 6) then
      across = sums%value(mixture, OF_TT, PLAIN)
      component = [across + sums%value(mixture, OF_DIFFERENCE, CURVE_X), &
                   across + sums%value(mixture, OF_DIFFERENCE, CURVE_Y), &
                   sums%value(mixture, OF_ZZ, PLAIN), sums%value(mixture, OF_SLOPE, SLOPE_Y), &
                   sums%value(mixture, OF_SLOPE, SLOPE_X), sums%value(mixture, OF_DIFFERENCE, TWIST)]
      component = scale(component, sums%force_unit - 2*sums%unit)
    else
      component = [sums%value(mixture, OF_ALONG, SLOPE_X), sums%value(mixture, OF_ALONG, SLOPE_Y), &
                   sums%value(mixture, OF_DOWN, PLAIN)]
      component = scale(component, sums%force_unit - sums%unit)
    end if
  end function components_of

end module fuge_layered_halfspace_interior
