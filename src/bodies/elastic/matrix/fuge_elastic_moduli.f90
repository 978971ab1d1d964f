!> Elasticity of two bodies: their combined modulus, and the share of each in the displacement.
!>
!> Two half-planes in frictionless contact deform like one of the combined modulus E*,
!> 1/E* = 1/E1* + 1/E2*, against a rigid body (K. L. Johnson, Contact Mechanics, 1985,
!> section 4.2). The modulus of a rigid body is +infinity: ieee_value(1.0_dp,
!> ieee_positive_inf) in Fortran, INFINITY in C.
module fuge_elastic_moduli
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_ERR_MODULUS, FUGE_ERR_NOT_FINITE, FUGE_ERR_OPTION, &
    FUGE_ERR_OVERFLOW
  implicit none
  private

  public :: fuge_plane_modulus, fuge_combined_modulus, fuge_displacement_shares, check_e_star, check_poisson

  !> Plane strain: bodies long across the plane, no strain out of the plane.
  integer, parameter, public :: FUGE_PLANE_STRAIN = 0
  !> Plane stress: thin bodies, no stress out of the plane.
  integer, parameter, public :: FUGE_PLANE_STRESS = 1

contains

  !> The contact modulus of one body, `modulus`: E/(1 - nu^2) in plane strain, E in plane
  !> stress (Johnson, section 2.1).
  !>
  !> `young` > 0 and `modulus` force per length squared, `young` +infinity for a rigid body;
  !> `poisson` in (-1, 0.5], also in plane stress; `plane_state` FUGE_PLANE_STRAIN or
  !> FUGE_PLANE_STRESS. Errors, `modulus` untouched: FUGE_ERR_NOT_FINITE; FUGE_ERR_OPTION for
  !> `plane_state`; FUGE_ERR_MODULUS for `young` and for `poisson`, because outside its range the
  !> shear or the bulk modulus is not positive; FUGE_ERR_OVERFLOW.
  pure subroutine fuge_plane_modulus(young, poisson, plane_state, modulus, info)
    real(dp), intent(in) :: young, poisson
    integer, intent(in) :: plane_state
    real(dp), intent(inout) :: modulus
    type(fuge_info), intent(out) :: info

    call check_modulus(young, 'young', info)
    if (.not. info%failed()) call check_poisson(poisson, info)
    if (info%failed()) return
    select case (plane_state)
    case (FUGE_PLANE_STRAIN)
      call divide_by_strain_factor(young, poisson, modulus, info)
    case (FUGE_PLANE_STRESS)
      modulus = young
    case default
      call report(info, FUGE_ERR_OPTION, 'plane_state = '//text(plane_state) &
                  //' is unknown: use FUGE_PLANE_STRAIN or FUGE_PLANE_STRESS')
    end select
  end subroutine fuge_plane_modulus

  !> The combined modulus of two bodies, 1/`e_star` = 1/`e1` + 1/`e2`.
  !>
  !> `e1`, `e2` of `fuge_plane_modulus`, force per length squared; one may be +infinity.
  !> Errors, `e_star` untouched: FUGE_ERR_NOT_FINITE, FUGE_ERR_MODULUS (not positive, or
  !> both bodies rigid).
  pure subroutine fuge_combined_modulus(e1, e2, e_star, info)
    real(dp), intent(in) :: e1, e2
    real(dp), intent(inout) :: e_star
    type(fuge_info), intent(out) :: info
    real(dp) :: soft, stiff

    call check_moduli(e1, e2, info)
    if (info%failed()) return
    soft = min(e1, e2)
    stiff = max(e1, e2)
    ! soft/stiff is at most 1, and 0 for a rigid body: no overflow.
    e_star = soft/(1.0_dp + soft/stiff)
  end subroutine fuge_combined_modulus

  !> Shares of bodies 1 and 2 in the displacement: u1 = `share1` u, u2 = `share2` u.
  !>
  !> `share1` = E*/E1* and `share2` = E*/E2*, no unit, add up to 1; u = alpha f is the
  !> displacement with alpha for the combined modulus. Arguments and errors as for
  !> `fuge_combined_modulus`; the share of a rigid body is 0.
  pure subroutine fuge_displacement_shares(e1, e2, share1, share2, info)
    real(dp), intent(in) :: e1, e2
    real(dp), intent(inout) :: share1, share2
    type(fuge_info), intent(out) :: info
    real(dp) :: of_soft, of_stiff, ratio

    call check_moduli(e1, e2, info)
    if (info%failed()) return
    ratio = min(e1, e2)/max(e1, e2)
    of_soft = 1.0_dp/(1.0_dp + ratio)
    of_stiff = ratio/(1.0_dp + ratio)
    share1 = merge(of_soft, of_stiff, e1 <= e2)
    share2 = merge(of_stiff, of_soft, e1 <= e2)
  end subroutine fuge_displacement_shares

  pure subroutine divide_by_strain_factor(young, poisson, modulus, info)
    real(dp), intent(in) :: young, poisson
    real(dp), intent(inout) :: modulus
    type(fuge_info), intent(inout) :: info
    real(dp) :: factor

    ! As a product, because 1 - nu^2 loses digits near nu = -1.
    factor = (1.0_dp - poisson)*(1.0_dp + poisson)
    if (ieee_is_finite(young) .and. young > huge(young)*min(factor, 1.0_dp)) then
      call report(info, FUGE_ERR_OVERFLOW, 'young = '//text(young)//' over 1 - nu^2 = '//text(factor) &
                  //' is out of range: choose other units')
    else
      modulus = young/factor
    end if
  end subroutine divide_by_strain_factor

  !> Refuse a combined modulus that is not finite (FUGE_ERR_NOT_FINITE) or not positive
  !> (FUGE_ERR_MODULUS).
  pure subroutine check_e_star(e_star, info)
    real(dp), intent(in) :: e_star
    type(fuge_info), intent(inout) :: info

    if (.not. ieee_is_finite(e_star)) then
      call report(info, FUGE_ERR_NOT_FINITE, 'e_star = '//text(e_star)//' is not a finite number')
    else if (.not. e_star > 0.0_dp) then
      call report(info, FUGE_ERR_MODULUS, 'e_star = '//text(e_star) &
                  //' is not positive: it is E/(1 - nu^2) in plane strain')
    end if
  end subroutine check_e_star

  pure subroutine check_moduli(e1, e2, info)
    real(dp), intent(in) :: e1, e2
    type(fuge_info), intent(inout) :: info

    call check_modulus(e1, 'e1', info)
    if (.not. info%failed()) call check_modulus(e2, 'e2', info)
    if (info%failed()) return
    if (min(e1, e2) > huge(e1)) call report(info, FUGE_ERR_MODULUS, &
      'e1 and e2 are both infinite: one body at least must be elastic')
  end subroutine check_moduli

  !> Refuse a modulus that is not positive. NaN comes first, because a comparison with it may trap.
  pure subroutine check_modulus(value, name, info)
    real(dp), intent(in) :: value
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info

    if (ieee_is_nan(value)) then
      call report(info, FUGE_ERR_NOT_FINITE, name//' is not a number')
    else if (.not. value > 0.0_dp) then
      call report(info, FUGE_ERR_MODULUS, name//' = '//text(value) &
                  //' is not positive: an elastic modulus is, +infinity means a rigid body')
    end if
  end subroutine check_modulus

  pure subroutine check_poisson(poisson, info)
    real(dp), intent(in) :: poisson
    type(fuge_info), intent(inout) :: info

    if (.not. ieee_is_finite(poisson)) then
      call report(info, FUGE_ERR_NOT_FINITE, 'poisson = '//text(poisson)//' is not a finite number')
    else if (.not. poisson > -1.0_dp) then
      call report(info, FUGE_ERR_MODULUS, 'poisson = '//text(poisson) &
                  //', Poisson''s ratio, is not above -1: the shear modulus would not be positive')
    else if (poisson > 0.5_dp) then
      call report(info, FUGE_ERR_MODULUS, 'poisson = '//text(poisson)//', Poisson''s ratio, is above 0.5, that of an ' &
                  //'incompressible body: the bulk modulus would be negative')
    end if
  end subroutine check_poisson

end module fuge_elastic_moduli
