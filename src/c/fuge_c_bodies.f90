!> C bindings, section "two bodies": their elasticity.
module fuge_c_bodies
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t, c_associated, c_f_pointer
  use fuge_elastic_moduli, only: fuge_plane_modulus, fuge_combined_modulus, fuge_displacement_shares
  use fuge_c_types, only: copy_string
  use fuge_status, only: fuge_info, report, FUGE_ERR_POINTER
  implicit none
  private

contains

  function c_plane_modulus(young, poisson, state, modulus, message, length) &
    bind(c, name='fuge_plane_modulus') result(status)
    real(c_double), intent(in), value :: young, poisson
    integer(c_int), intent(in), value :: state
    type(c_ptr), intent(in), value :: modulus, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: value
    type(fuge_info) :: info

    if (c_associated(modulus)) then
      call c_f_pointer(modulus, value)
      call fuge_plane_modulus(young, poisson, int(state), value, info)
    else
      call report(info, FUGE_ERR_POINTER, 'modulus is NULL')
    end if
    call copy_string(info%message, message, length)
    status = int(info%status, c_int)
  end function c_plane_modulus

  function c_combined_modulus(e1, e2, e_star, message, length) &
    bind(c, name='fuge_combined_modulus') result(status)
    real(c_double), intent(in), value :: e1, e2
    type(c_ptr), intent(in), value :: e_star, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: value
    type(fuge_info) :: info

    if (c_associated(e_star)) then
      call c_f_pointer(e_star, value)
      call fuge_combined_modulus(e1, e2, value, info)
    else
      call report(info, FUGE_ERR_POINTER, 'e_star is NULL')
    end if
    call copy_string(info%message, message, length)
    status = int(info%status, c_int)
  end function c_combined_modulus

  function c_displacement_shares(e1, e2, share1, share2, message, length) &
    bind(c, name='fuge_displacement_shares') result(status)
    real(c_double), intent(in), value :: e1, e2
    type(c_ptr), intent(in), value :: share1, share2, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: first, second
    type(fuge_info) :: info

    if (c_associated(share1) .and. c_associated(share2)) then
      call c_f_pointer(share1, first)
      call c_f_pointer(share2, second)
      call fuge_displacement_shares(e1, e2, first, second, info)
    else
      call report(info, FUGE_ERR_POINTER, 'share1 or share2 is NULL')
    end if
    call copy_string(info%message, message, length)
    status = int(info%status, c_int)
  end function c_displacement_shares

end module fuge_c_bodies
