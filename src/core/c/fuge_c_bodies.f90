!> C bindings, section "two bodies": their elasticity.
module fuge_c_bodies
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t, c_f_pointer
  use fuge_c_types, only: report_to_c, require_pointer
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

    call require_pointer(modulus, 'modulus', info)
    if (.not. info%failed()) then
      call c_f_pointer(modulus, value)
      call fuge_plane_modulus(young, poisson, int(plane_state), value, info)
    end if
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

    call require_pointer(e_star, 'e_star', info)
    if (.not. info%failed()) then
      call c_f_pointer(e_star, value)
      call fuge_combined_modulus(e1, e2, value, info)
    end if
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

    call require_pointer(share1, 'share1', info)
    call require_pointer(share2, 'share2', info)
    if (.not. info%failed()) then
      call c_f_pointer(share1, first)
      call c_f_pointer(share2, second)
      call fuge_displacement_shares(e1, e2, first, second, info)
    end if
    status = report_to_c(info, message, length)
  end function c_displacement_shares

end module fuge_c_bodies
