!> C bindings, section "two bodies": their elasticity.
module fuge_c_moduli
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t
  use fuge_c_arrays, only: find_array
  use fuge_c_types, only: report_to_c
  use fuge_elastic_moduli, only: fuge_plane_modulus, fuge_combined_modulus, fuge_displacement_shares
  use fuge_status, only: fuge_info
  implicit none
  private

contains

  function c_plane_modulus(young, poisson, plane_state, modulus, message, length) &
    bind(c, name='fuge_plane_modulus') result(status)
    real(c_double), intent(in), value :: young, poisson
    integer(c_int), intent(in), value :: plane_state
    type(c_ptr), intent(in), value :: modulus, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: value
    type(fuge_info) :: info

    call find_array(modulus, 'modulus', value, info)
    if (.not. info%failed()) call fuge_plane_modulus(young, poisson, int(plane_state), value, info)
    status = report_to_c(info, message, length)
  end function c_plane_modulus

  function c_combined_modulus(e1, e2, e_star, message, length) &
    bind(c, name='fuge_combined_modulus') result(status)
    real(c_double), intent(in), value :: e1, e2
    type(c_ptr), intent(in), value :: e_star, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: value
    type(fuge_info) :: info

    call find_array(e_star, 'e_star', value, info)
    if (.not. info%failed()) call fuge_combined_modulus(e1, e2, value, info)
    status = report_to_c(info, message, length)
  end function c_combined_modulus

  function c_displacement_shares(e1, e2, share1, share2, message, length) &
    bind(c, name='fuge_displacement_shares') result(status)
    real(c_double), intent(in), value :: e1, e2
    type(c_ptr), intent(in), value :: share1, share2, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: first, second
    type(fuge_info) :: info

    call find_array(share1, 'share1', first, info)
    call find_array(share2, 'share2', second, info)
    if (.not. info%failed()) call fuge_displacement_shares(e1, e2, first, second, info)
    status = report_to_c(info, message, length)
  end function c_displacement_shares

end module fuge_c_moduli
