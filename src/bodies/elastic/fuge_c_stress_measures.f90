!> C bindings, section "stress measures".
module fuge_c_stress_measures
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_int, c_ptr, c_size_t
  use fuge_c_arrays, only: find_array
  use fuge_c_types, only: report_to_c, require_count
  use fuge_status, only: fuge_info
  use fuge_stress_measures, only: fuge_mean_stress, fuge_principal_stresses, fuge_tresca, fuge_von_mises
  implicit none
  private

  abstract interface
    !> One number for each tensor (6, points).
    pure function scalar_measure(tensor) result(value)
      import :: c_double
      implicit none
      real(c_double), intent(in) :: tensor(:, :)
      real(c_double) :: value(size(tensor, 2))
    end function scalar_measure
  end interface

contains

  function c_measure_stresses(points, tensor, principal, von_mises, tresca, mean, message, length) &
    bind(c, name='fuge_measure_stresses') result(status)
    integer(c_int), intent(in), value :: points
    type(c_ptr), intent(in), value :: tensor, principal, von_mises, tresca, mean, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: tensors(:, :), three(:, :)
    type(fuge_info) :: info

    call require_count(points, 0, 'points', 'points', info)
    call find_array(6, points, tensor, 'tensor', tensors, info)
    if (.not. info%failed() .and. c_associated(principal)) then
      call c_f_pointer(principal, three, [3, int(points)])
      call fuge_principal_stresses(tensors, three, info)
    end if
    status = report_to_c(info, message, length)
    if (info%failed()) return
    call evaluate(fuge_von_mises, tensors, von_mises)
    call evaluate(fuge_tresca, tensors, tresca)
    call evaluate(fuge_mean_stress, tensors, mean)
  end function c_measure_stresses

  !> One number for each tensor, point by point, because no array for all of them is needed; nothing for NULL.
  subroutine evaluate(measure, tensors, destination)
    procedure(scalar_measure) :: measure
    real(c_double), intent(in) :: tensors(:, :)
    type(c_ptr), intent(in) :: destination
    real(c_double), pointer :: values(:)
    integer :: k

    if (.not. c_associated(destination)) return
    call c_f_pointer(destination, values, [size(tensors, 2)])
    do k = 1, size(values)
      values(k:k) = measure(tensors(:, k:k))
    end do
  end subroutine evaluate

end module fuge_c_stress_measures
