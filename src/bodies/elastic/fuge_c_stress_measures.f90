!> C bindings, section "stress measures".
module fuge_c_stress_measures
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t
  use fuge_c_arrays, only: find_array
  use fuge_c_types, only: report_to_c, require_count
  use fuge_status, only: fuge_info
  use fuge_stress_measures, only: fuge_mean_stress, fuge_principal_stresses, &
    fuge_tresca, fuge_von_mises
  implicit none
  private

  !> Scalars of a tensor.
  integer, parameter :: VON_MISES = 1, TRESCA = 2, MEAN_STRESS = 3

contains

  function c_principal_stresses(points, tensor, principal, message, length) &
    bind(c, name='fuge_principal_stresses') result(status)
    integer(c_int), intent(in), value :: points
    type(c_ptr), intent(in), value :: tensor, principal, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: tensors(:, :), three(:, :)
    type(fuge_info) :: info

    call find_components(6, points, tensor, 'tensor', tensors, info)
    call find_components(3, points, principal, 'principal', three, info)
    if (.not. info%failed()) call fuge_principal_stresses(tensors, three, info)
    status = report_to_c(info, message, length)
  end function c_principal_stresses

  function c_von_mises(points, tensor, value, message, length) bind(c, name='fuge_von_mises') result(status)
    integer(c_int), intent(in), value :: points
    type(c_ptr), intent(in), value :: tensor, value, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_info) :: info

    call evaluate(VON_MISES, points, tensor, value, info)
    status = report_to_c(info, message, length)
  end function c_von_mises

  function c_tresca(points, tensor, value, message, length) bind(c, name='fuge_tresca') result(status)
    integer(c_int), intent(in), value :: points
    type(c_ptr), intent(in), value :: tensor, value, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_info) :: info

    call evaluate(TRESCA, points, tensor, value, info)
    status = report_to_c(info, message, length)
  end function c_tresca

  function c_mean_stress(points, tensor, value, message, length) bind(c, name='fuge_mean_stress') result(status)
    integer(c_int), intent(in), value :: points
    type(c_ptr), intent(in), value :: tensor, value, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_info) :: info

    call evaluate(MEAN_STRESS, points, tensor, value, info)
    status = report_to_c(info, message, length)
  end function c_mean_stress

  !> One `scalar` for each point, point by point: no array for all of them is needed.
  subroutine evaluate(scalar, points, tensor, value, info)
    integer, intent(in) :: scalar
    integer(c_int), intent(in) :: points
    type(c_ptr), intent(in) :: tensor, value
    type(fuge_info), intent(inout) :: info
    real(c_double), pointer :: tensors(:, :), values(:, :)
    integer :: k

    call find_components(6, points, tensor, 'tensor', tensors, info)
    call find_components(1, points, value, 'value', values, info)
    if (info%failed()) return
    do k = 1, int(points)
      select case (scalar)
      case (VON_MISES)
        values(:, k) = fuge_von_mises(tensors(:, k:k))
      case (TRESCA)
        values(:, k) = fuge_tresca(tensors(:, k:k))
      case default
        values(:, k) = fuge_mean_stress(tensors(:, k:k))
      end select
    end do
  end subroutine evaluate

  !> The tensors or stresses of the points, `components` of each.
  subroutine find_components(components, points, address, name, array, info)
    integer, intent(in) :: components
    integer(c_int), intent(in) :: points
    type(c_ptr), intent(in) :: address
    character(len=*), intent(in) :: name
    real(c_double), pointer, intent(out) :: array(:, :)
    type(fuge_info), intent(inout) :: info

    call require_count(points, 0, 'points', 'points', info)
    call find_array(components, points, address, name, array, info)
  end subroutine find_components

end module fuge_c_stress_measures
