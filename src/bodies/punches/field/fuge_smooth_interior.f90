!> Stresses and displacements inside a half-plane under a smooth punch.
module fuge_smooth_interior
  use fuge_compensated_sums, only: difference_rounding
  use fuge_halfplane_interior, only: displacement_factors
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_smooth_contact_type, only: fuge_smooth_contact
  use fuge_smooth_field, only: confocal_point, locate, smooth_displacement_integrals, smooth_stresses
  use fuge_status, only: fuge_info, report, FUGE_ERR_CALL_ORDER, FUGE_ERR_OVERFLOW
  use fuge_stress_checks, only: check_coordinate, check_depth, check_result
  implicit none
  private

  public :: fuge_smooth_displacement, fuge_smooth_stress

  !> A distance is at most 2**FARTHEST half widths, 1.8e75.
  integer, parameter :: FARTHEST = 250

contains

  !> Stresses in a half-plane under a smooth punch, in closed form, to the rounding of the pressure at any depth and
  !> distance.
  !>
  !> `contact` of `fuge_solve_smooth_punch`; `px`, `pz` (points) along the surface and into the body, pz >= 0, length;
  !> out: `stress` (3, points) xx, zz, xz, force per length squared, tension positive. At z = 0 they are -pressure,
  !> -pressure and 0. In plane strain yy is nu (xx + zz). A contact without force has no stresses.
  !> Errors, stress untouched: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_GRID for pz < 0, FUGE_ERR_OVERFLOW for a
  !> point farther away than 1e75 half widths. Source: `fuge_smooth_field`.
  pure subroutine fuge_smooth_stress(contact, px, pz, stress, info)
    type(fuge_smooth_contact), intent(in) :: contact
    real(dp), intent(in) :: px(:), pz(:)
    real(dp), intent(inout) :: stress(:, :)
    type(fuge_info), intent(out) :: info
    integer :: k

    call check_points(contact, px, pz, info)
    call check_result(shape(stress), 'stress', 3, size(pz), info)
    if (info%failed()) return
    if (.not. is_loaded(contact)) then
      stress = 0.0_dp
      return
    end if
    do k = 1, size(pz)
      ! Nothing is 0, not -0.
      stress(:, k) = 0.0_dp + smooth_stresses(contact%coefficients, place(contact, px(k), pz(k)))
    end do
  end subroutine fuge_smooth_stress

  !> Displacements in a half-plane under a smooth punch, in closed form.
  !>
  !> `contact`, `px`, `pz` as for `fuge_smooth_stress`; `young`, `poisson` and `plane_state` of the body as for
  !> `fuge_plane_modulus`; out: `displacement` (2, points) along x and z, length. Along z the datum is that of
  !> `contact%approach`; a line load moves points straight below it along z only, and x along it grows from there.
  !> Errors, displacement untouched: as for `fuge_smooth_stress` and `fuge_plane_modulus`; FUGE_ERR_CALL_ORDER for a
  !> contact with forces but without a datum, which is not one of `fuge_solve_smooth_punch`.
  pure subroutine fuge_smooth_displacement(contact, young, poisson, plane_state, px, pz, displacement, info)
    type(fuge_smooth_contact), intent(in) :: contact
    real(dp), intent(in) :: young, poisson, px(:), pz(:)
    integer, intent(in) :: plane_state
    real(dp), intent(inout) :: displacement(:, :)
    type(fuge_info), intent(out) :: info
    real(dp) :: factor(3), integral(4), log_datum
    integer :: k

    call displacement_factors(young, poisson, plane_state, factor, info)
    call check_points(contact, px, pz, info)
    call check_result(shape(displacement), 'displacement', 2, size(pz), info)
    if (info%failed()) return
    if (.not. is_loaded(contact)) then
      displacement = 0.0_dp
      return
    end if
    if (.not. contact%datum > 0.0_dp) then
      call report(info, FUGE_ERR_CALL_ORDER, 'the contact has no datum of displacements: solve it first')
      return
    end if
    log_datum = log(contact%datum/contact%half_width)
    do k = 1, size(pz)
      integral = contact%half_width*smooth_displacement_integrals(contact%coefficients, place(contact, px(k), pz(k)), &
                                                                  pz(k)/contact%half_width, log_datum)
      displacement(1, k) = factor(1)*integral(3) - factor(3)*integral(4)
      displacement(2, k) = factor(1)*integral(2) - factor(2)*integral(1)
    end do
  end subroutine fuge_smooth_displacement

  pure function is_loaded(contact) result(loaded)
    type(fuge_smooth_contact), intent(in) :: contact
    logical :: loaded

    loaded = .false.
    if (allocated(contact%coefficients)) loaded = size(contact%coefficients) > 0 .and. contact%half_width > 0.0_dp
  end function is_loaded

  !> Where a point lies, its distances from the ends rounded once or nearly so.
  pure function place(contact, x, z) result(point)
    type(fuge_smooth_contact), intent(in) :: contact
    real(dp), intent(in) :: x, z
    type(confocal_point) :: point
    real(dp) :: from_anchor, from_middle, rounding

    associate (half => contact%half_width)
      from_anchor = x - contact%anchor
      from_middle = from_anchor - contact%offset
      rounding = difference_rounding(x, contact%anchor, from_anchor) &
                 + difference_rounding(from_anchor, contact%offset, from_middle)
      point = locate(((from_middle + half) + rounding)/half, ((from_middle - half) + rounding)/half, z/half)
    end associate
  end function place

  !> Refuse depths and places, and those too far away (FUGE_ERR_OVERFLOW).
  pure subroutine check_points(contact, px, pz, info)
    type(fuge_smooth_contact), intent(in) :: contact
    real(dp), intent(in) :: px(:), pz(:)
    type(fuge_info), intent(inout) :: info
    real(dp) :: distance
    integer :: k

    call check_depth(pz, 'pz', info)
    call check_coordinate(px, 'px', pz, info)
    if (info%failed() .or. .not. is_loaded(contact)) return
    do k = 1, size(pz)
      distance = max(contact%half_width, pz(k), abs(0.5_dp*px(k) - 0.5_dp*(contact%anchor + contact%offset)))
      if (exponent(distance) <= FARTHEST + exponent(contact%half_width)) cycle
      call report(info, FUGE_ERR_OVERFLOW, 'point '//index_text(k)//' at x = '//text(px(k))//', z = '//text(pz(k)) &
                  //' is farther away than 1e75 half widths of the contact: leave it out')
      return
    end do
  end subroutine check_points

end module fuge_smooth_interior
