!> C bindings, section "effective modulus".
module fuge_c_effective_modulus
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t
  use fuge_c_arrays, only: find_array, give
  use fuge_c_layers, only: find_layers
  use fuge_c_types, only: report_to_c, require_count
  use fuge_coating_thickness, only: fuge_find_coating_limits
  use fuge_effective_modulus, only: fuge_find_effective_modulus
  use fuge_layered_body_type, only: fuge_layered_body
  use fuge_status, only: fuge_info
  implicit none
  private

contains

  !> Eleven arguments, as in the header: the layers, the other body, the radii, the message.
  function c_layered_modulus(layers, thickness, young, poisson, bonded, e_star_other, radii, radius, modulus, message, &
                             length) bind(c, name='fuge_layered_modulus') result(status)
    integer(c_int), intent(in), value :: layers, bonded, radii
    real(c_double), intent(in), value :: e_star_other
    type(c_ptr), intent(in), value :: thickness, young, poisson, radius, modulus, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: contact_radii(:), results(:)
    type(fuge_layered_body) :: body
    type(fuge_info) :: info

    call require_count(radii, 0, 'radii', 'radii', info)
    call find_array(radii, radius, 'radius', contact_radii, info)
    call find_array(radii, modulus, 'modulus', results, info)
    call find_layers(layers, thickness, young, poisson, bonded, e_star_other, body, info)
    if (.not. info%failed()) call fuge_find_effective_modulus(body, contact_radii, results, info)
    status = report_to_c(info, message, length)
  end function c_layered_modulus

  function c_coating_limits(young, poisson, radius, share, thin, thick, message, length) &
    bind(c, name='fuge_coating_limits') result(status)
    type(c_ptr), intent(in), value :: young, poisson, thin, thick, message
    real(c_double), intent(in), value :: radius, share
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: moduli(:), ratios(:)
    real(c_double) :: limits(2)
    type(fuge_info) :: info

    limits = 0.0_c_double
    call find_array(2, young, 'young', moduli, info)
    call find_array(2, poisson, 'poisson', ratios, info)
    if (.not. info%failed()) call fuge_find_coating_limits(moduli, ratios, radius, share, limits(1), limits(2), info)
    if (.not. info%failed()) then
      call give(limits(1), thin)
      call give(limits(2), thick)
    end if
    status = report_to_c(info, message, length)
  end function c_coating_limits

end module fuge_c_effective_modulus
