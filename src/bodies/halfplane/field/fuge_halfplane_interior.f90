!> Stresses and displacements inside an elastic half-plane under the forces of its cells.
module fuge_halfplane_interior
  use fuge_cell_elements, only: datum_length
  use fuge_constants, only: LARGEST_EXPONENT_OF_4, PI
  use fuge_elastic_moduli, only: fuge_plane_modulus, FUGE_PLANE_STRAIN
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_pressed_line, only: check_line, pressed_line
  use fuge_status, only: fuge_info, report, FUGE_ERR_OVERFLOW
  use fuge_stress_checks, only: check_coordinate, check_depth, check_result
  implicit none
  private

  public :: check_points, fuge_halfplane_stress, fuge_halfplane_displacement, displacement_factors

  !> Many cells are put into clusters for this number of points or more: for fewer it takes longer than the plain sum.
  integer, parameter :: MANY_POINTS = 32

contains

  !> Stresses in a half-plane under forces on its cells, to rounding at any depth and distance: zz relative to the sum
  !> of its terms, xx and xz relative to the largest of the three.
  !>
  !> `x`, `width`, `element` and `symmetric` as for `fuge_halfplane_matrix`, length; `force` (n) of the cells, per
  !> unit depth, compression positive, of any sign: those that a solver returns; `px`, `pz` (points) along the surface
  !> and into the body, pz >= 0, length; out: `stress` (3, points) xx, zz, xz, force per length squared, tension
  !> positive. FUGE_CENTRE and FUGE_MEAN are strips of pressure force/width, FUGE_HAT hats with the peak force/width.
  !> In plane strain yy is nu (xx + zz). Cells without force cost nothing.
  !>
  !> At z = 0 xx = zz = -pressure and xz = 0; at an end of a strip they are the mean of those on both sides, although xz
  !> straight below it tends to -pressure/pi at the right end and to pressure/pi at the left one.
  !>
  !> Errors, stress untouched: those of `fuge_halfplane_matrix`; FUGE_ERR_SIZE; FUGE_ERR_NOT_FINITE; FUGE_ERR_GRID for
  !> pz < 0; FUGE_ERR_OVERFLOW also for a length beyond 1e75 times the narrowest width. Many points under many cells
  !> cost O((n + points) log(n)). Source: `fuge_strip_field`, `fuge_hat_field`, `fuge_cell_clusters`. The arguments
  !> are nine, because cells, points and result are plain arrays, as a solver and its caller have them.
  pure subroutine fuge_halfplane_stress(x, width, force, element, px, pz, stress, info, symmetric)
    real(dp), intent(in) :: x(:), width(:), force(:), px(:), pz(:)
    integer, intent(in) :: element
    real(dp), intent(inout) :: stress(:, :)
    type(fuge_info), intent(out) :: info
    logical, intent(in), optional :: symmetric
    type(pressed_line) :: line
    logical :: folded
    integer :: k

    folded = .false.
    if (present(symmetric)) folded = symmetric
    call check_line(x, width, force, element, folded, info)
    call check_points(px, pz, info)
    call check_result(shape(stress), 'stress', 3, size(pz), info)
    call line%set(x, width, force, element, folded, info)
    call line%check_distances(px, pz, info)
    if (size(pz) >= MANY_POINTS) call line%gather(info)
    if (info%failed()) return
    do k = 1, size(pz)
      call line%find_stress(px(k), pz(k), stress(:, k))
    end do
  end subroutine fuge_halfplane_stress

  !> Displacements in a half-plane under forces on its cells.
  !>
  !> `x`, `width`, `force`, `element`, `px`, `pz` and `symmetric` as for `fuge_halfplane_stress`; `young`, `poisson` and
  !> `plane_state` of the body as for `fuge_plane_modulus`; out: `displacement` (2, points) along x and z, length.
  !> Along z the datum is that of `fuge_halfplane_matrix`, so that at the surface the displacement of a point is that
  !> matrix (with FUGE_CENTRE or FUGE_HAT) times the forces, for the modulus of this body. A line load moves points
  !> straight below it along z only, and x along it grows from there. A rigid body (`young` infinite) has no
  !> displacements.
  !>
  !> Errors, displacement untouched: as for `fuge_halfplane_stress` and `fuge_plane_modulus`. Source: A.-A. Flamant,
  !> 1892; K. L. Johnson, Contact Mechanics, 1985, section 2.2, integrated over the pressure. The arguments are
  !> twelve, because the moduli of one body come to those of `fuge_halfplane_stress`.
  pure subroutine fuge_halfplane_displacement(x, width, force, element, young, poisson, plane_state, px, pz, &
                                              displacement, info, symmetric)
    real(dp), intent(in) :: x(:), width(:), force(:), young, poisson, px(:), pz(:)
    integer, intent(in) :: element, plane_state
    real(dp), intent(inout) :: displacement(:, :)
    type(fuge_info), intent(out) :: info
    logical, intent(in), optional :: symmetric
    type(pressed_line) :: line
    logical :: folded
    real(dp) :: integral(4), factor(3), datum
    integer :: k

    folded = .false.
    if (present(symmetric)) folded = symmetric
    call displacement_factors(young, poisson, plane_state, factor, info)
    if (.not. info%failed()) call check_line(x, width, force, element, folded, info)
    call check_points(px, pz, info)
    call check_result(shape(displacement), 'displacement', 2, size(pz), info)
    call line%set(x, width, force, element, folded, info)
    call line%check_distances(px, pz, info)
    if (size(pz) >= MANY_POINTS) call line%gather(info)
    if (info%failed()) return
    datum = log(scale(datum_length(x, width, folded), line%power))*sum(force)
    do k = 1, size(pz)
      call line%find_integrals(px(k), pz(k), integral)
      displacement(1, k) = factor(1)*integral(3) - factor(3)*integral(4)
      displacement(2, k) = factor(1)*integral(2) - factor(2)*(integral(1) - datum)
    end do
  end subroutine fuge_halfplane_displacement

  !> The factors of the displacements: 1/(2 pi mu), 2/(pi E*) and (1 - 2 nu)/(2 pi mu), the last one for plane strain,
  !> mu being the shear modulus. Errors as for `fuge_plane_modulus`, and FUGE_ERR_OVERFLOW.
  pure subroutine displacement_factors(young, poisson, plane_state, factor, info)
    real(dp), intent(in) :: young, poisson
    integer, intent(in) :: plane_state
    real(dp), intent(out) :: factor(3)
    type(fuge_info), intent(out) :: info
    real(dp) :: e_star

    factor = 0.0_dp
    e_star = 1.0_dp
    call fuge_plane_modulus(young, poisson, plane_state, e_star, info)
    if (info%failed() .or. young > huge(young)) return
    if (abs(exponent(young)) > LARGEST_EXPONENT_OF_4) then
      call report(info, FUGE_ERR_OVERFLOW, 'young = '//text(young)//' is out of range: choose other units')
      return
    end if
    factor = (1.0_dp + poisson)*[1.0_dp, 2.0_dp*(1.0_dp - poisson), 1.0_dp - 2.0_dp*poisson]
    if (plane_state /= FUGE_PLANE_STRAIN) factor(2:) = [2.0_dp, 1.0_dp - poisson]
    factor = factor/young/PI
  end subroutine displacement_factors

  !> Refuse points that are not in the body: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_GRID.
  pure subroutine check_points(px, pz, info)
    real(dp), intent(in) :: px(:), pz(:)
    type(fuge_info), intent(inout) :: info

    call check_depth(pz, 'pz', info)
    call check_coordinate(px, 'px', pz, info)
  end subroutine check_points

end module fuge_halfplane_interior
