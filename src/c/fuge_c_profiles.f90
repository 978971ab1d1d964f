!> C bindings, section "profiles".
module fuge_c_profiles
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t, c_associated, c_f_pointer
  use fuge_c_types, only: copy_string, copy_reals, from_c_string
  use fuge_profile_files, only: fuge_read_profile
  use fuge_profile_sampling, only: fuge_level_profile, fuge_sample_profile
  use fuge_status, only: fuge_info, report, FUGE_ERR_POINTER, FUGE_ERR_SIZE
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
    integer(c_int), pointer :: points
    type(fuge_info) :: info
    integer :: written

    if (.not. (c_associated(path) .and. c_associated(count))) then
      call report(info, FUGE_ERR_POINTER, 'path or count is NULL')
    else if (capacity < 0) then
      call report(info, FUGE_ERR_SIZE, 'capacity is negative: it is the length of x and z')
    else
      call fuge_read_profile(from_c_string(path), all_x, all_z, info)
    end if
    call copy_string(info%message, message, length)
    status = int(info%status, c_int)
    if (info%failed()) return
    written = min(size(all_x), int(capacity))
    call copy_reals(all_x(:written), x)
    call copy_reals(all_z(:written), z)
    call c_f_pointer(count, points)
    points = int(size(all_x), c_int)
  end function c_read_profile

  function c_sample_profile(n, x, z, points, centre, height, message, length) &
    bind(c, name='fuge_sample_profile') result(status)
    integer(c_int), intent(in), value :: n, points
    type(c_ptr), intent(in), value :: x, z, centre, height, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: place(:), level(:), wanted(:), found(:)
    type(fuge_info) :: info

    if (.not. (c_associated(x) .and. c_associated(z) .and. c_associated(centre) .and. c_associated(height))) then
      call report(info, FUGE_ERR_POINTER, 'x, z, centre or height is NULL')
    else if (points < 0) then
      call report(info, FUGE_ERR_SIZE, 'points is negative: it is the length of centre and height')
    else
      call c_f_pointer(x, place, [max(n, 0)])
      call c_f_pointer(z, level, [max(n, 0)])
      call c_f_pointer(centre, wanted, [points])
      call c_f_pointer(height, found, [points])
      call fuge_sample_profile(place, level, wanted, found, info)
    end if
    call copy_string(info%message, message, length)
    status = int(info%status, c_int)
  end function c_sample_profile

  function c_level_profile(n, x, z, form, message, length) bind(c, name='fuge_level_profile') result(status)
    integer(c_int), intent(in), value :: n, form
    type(c_ptr), intent(in), value :: x, z, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: place(:), level(:)
    type(fuge_info) :: info

    if (.not. (c_associated(x) .and. c_associated(z))) then
      call report(info, FUGE_ERR_POINTER, 'x or z is NULL')
    else
      call c_f_pointer(x, place, [max(n, 0)])
      call c_f_pointer(z, level, [max(n, 0)])
      call fuge_level_profile(place, level, int(form), info)
    end if
    call copy_string(info%message, message, length)
    status = int(info%status, c_int)
  end function c_level_profile

end module fuge_c_profiles
