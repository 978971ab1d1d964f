!> C bindings, section "graded bodies".
module fuge_c_graded_layers
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t
  use fuge_c_arrays, only: find_array, give
  use fuge_c_types, only: report_to_c, require_count, require_pointer
  use fuge_graded_layers_type, only: fuge_graded_layers
  use fuge_status, only: fuge_info
  implicit none
  private

contains

  !> Thirteen arguments, as in the header: the profile, the tolerance, the layers, the error, the message.
  function c_graded_layers(points, depth, young, poisson, tolerance, max_layers, layers, thickness, layer_young, &
                           layer_poisson, error, message, length) bind(c, name='fuge_graded_layers') result(status)
    integer(c_int), intent(in), value :: points, max_layers
    real(c_double), intent(in), value :: tolerance
    type(c_ptr), intent(in), value :: depth, young, poisson, layers, thickness, layer_young, layer_poisson, error
    type(c_ptr), intent(in), value :: message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: depths(:), moduli(:), ratios(:)
    type(fuge_graded_layers) :: found
    type(fuge_info) :: info

    call require_count(points, 1, 'points', 'points', info)
    call require_count(max_layers, 0, 'max_layers', 'layers', info)
    call find_array(points, depth, 'depth', depths, info)
    call find_array(points, young, 'young', moduli, info)
    call find_array(points, poisson, 'poisson', ratios, info)
    call require_pointer(layers, 'layers', info)
    if (max_layers > 0) call require_pointer(thickness, 'thickness', info)
    call require_pointer(layer_young, 'layer_young', info)
    call require_pointer(layer_poisson, 'layer_poisson', info)
    if (.not. info%failed()) call found%divide(depths, moduli, ratios, info, tolerance, int(max_layers))
    if (.not. info%failed()) then
      call give(size(found%thickness), layers)
      call give(found%thickness, thickness)
      call give(found%young, layer_young)
      call give(found%poisson, layer_poisson)
      call give(found%error, error)
    end if
    status = report_to_c(info, message, length)
  end function c_graded_layers

end module fuge_c_graded_layers
