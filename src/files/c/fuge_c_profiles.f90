!> C bindings, section "profiles".
module fuge_c_profiles
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t
  use fuge_c_arrays, only: find_array, give
  use fuge_c_types, only: from_c_string, report_to_c, require_count, require_path, require_pointer
  use fuge_profile_files, only: fuge_read_profile
  use fuge_profile_sampling, only: fuge_level_profile, fuge_sample_profile
  use fuge_status, only: fuge_info
  implicit none
  private

contains

  function c_read_profile(path, capacity, x, z, count, message, length) &
    bind(c, name='fuge_read_profile') result(status)
    type(c_ptr), intent(in), value :: path, x, z, count, message
    integer(c_int), intent(in), value :: capacity
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), allocatable :: all_x(:), all_z(:)
    type(fuge_info) :: info
    integer :: written

    call require_path(path, info)
    call require_pointer(count, 'count', info)
    call require_count(capacity, 0, 'capacity', 'elements of x and z', info)
    if (.not. info%failed()) call fuge_read_profile(from_c_string(path), all_x, all_z, info)
    status = report_to_c(info, message, length)
    if (info%failed()) return
    written = min(size(all_x), int(capacity))
    call give(all_x(:written), x)
    call give(all_z(:written), z)
    call give(size(all_x), count)
  end function c_read_profile

  function c_sample_profile(n, x, z, points, centre, height, message, length) &
    bind(c, name='fuge_sample_profile') result(status)
    integer(c_int), intent(in), value :: n, points
    type(c_ptr), intent(in), value :: x, z, centre, height, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: places(:), heights(:), centres(:), sampled(:)
    type(fuge_info) :: info

    call find_array(n, x, 'x', places, info)
    call find_array(n, z, 'z', heights, info)
    call find_array(points, centre, 'centre', centres, info)
    call find_array(points, height, 'height', sampled, info)
    call require_count(n, 2, 'n', 'points of the profile', info)
    call require_count(points, 0, 'points', 'elements of centre and height', info)
    if (.not. info%failed()) call fuge_sample_profile(places, heights, centres, sampled, info)
    status = report_to_c(info, message, length)
  end function c_sample_profile

  function c_level_profile(n, x, z, form, message, length) bind(c, name='fuge_level_profile') result(status)
    integer(c_int), intent(in), value :: n, form
    type(c_ptr), intent(in), value :: x, z, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: places(:), heights(:)
    type(fuge_info) :: info

    call find_array(n, x, 'x', places, info)
    call find_array(n, z, 'z', heights, info)
    call require_count(n, 2, 'n', 'points of the profile', info)
    if (.not. info%failed()) call fuge_level_profile(places, heights, int(form), info)
    status = report_to_c(info, message, length)
  end function c_level_profile

end module fuge_c_profiles
