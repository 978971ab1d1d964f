!> C bindings, section "grids".
module fuge_c_result_files
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_int, c_ptr, c_size_t
  use fuge_c_arrays, only: find_array
  use fuge_c_types, only: from_c_string, report_to_c, require_count, require_path, require_pointer
  use fuge_result_files, only: fuge_write_results, fuge_write_volume
  use fuge_number_text, only: index_text, text
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_SIZE
  implicit none
  private

  !> Longest name of a result that is passed on: one character more than is allowed.
  integer, parameter :: NAME_LENGTH = 201

contains

  !> Refuse numbers of points below 1, or whose product an integer does not hold (FUGE_ERR_SIZE).
  subroutine require_sizes(nx, ny, info)
    integer(c_int), intent(in) :: nx, ny
    type(fuge_info), intent(inout) :: info

    call require_count(nx, 1, 'nx', 'points along x', info)
    call require_count(ny, 1, 'ny', 'points along y', info)
    if (info%failed()) return
    if (nx > huge(nx)/ny) call report(info, FUGE_ERR_SIZE, text(int(nx))//' x '//text(int(ny)) &
                                      //' points are more than an integer counts')
  end subroutine require_sizes

  !> Ten arguments, as in the header: the file, the grid, the results, the message.
  function c_write_results(path, nx, ny, spacing, origin, count, names, results, message, length) &
    bind(c, name='fuge_write_results') result(status)
    type(c_ptr), intent(in), value :: path, spacing, origin, names, results, message
    integer(c_int), intent(in), value :: nx, ny, count
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    character(len=NAME_LENGTH), allocatable :: all_names(:)
    real(c_double), allocatable :: all_results(:, :)
    real(c_double), pointer :: spacings(:)
    type(fuge_info) :: info
    integer :: points

    call require_path(path, info)
    call find_array(2_c_int, spacing, 'spacing', spacings, info)
    call require_sizes(nx, ny, info)
    call require_count(count, 1, 'count', 'results', info)
    points = 0
    if (.not. info%failed()) points = int(nx)*int(ny)
    call copy_results(points, int(count), names, results, all_names, all_results, info)
    if (.not. info%failed()) call fuge_write_results(from_c_string(path), int(nx), int(ny), spacings(1), spacings(2), &
                                                     all_names, all_results, info, first_centre(origin))
    status = report_to_c(info, message, length)
  end function c_write_results

  !> Twelve arguments, as in the header: the file, the points, the results, the message.
  function c_write_volume(path, nx, ny, spacing, origin, depths, depth, count, names, results, message, length) &
    bind(c, name='fuge_write_volume') result(status)
    type(c_ptr), intent(in), value :: path, spacing, origin, depth, names, results, message
    integer(c_int), intent(in), value :: nx, ny, depths, count
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    character(len=NAME_LENGTH), allocatable :: all_names(:)
    real(c_double), allocatable :: all_results(:, :)
    real(c_double), pointer :: spacings(:), levels(:)
    type(fuge_info) :: info
    integer :: points

    call require_path(path, info)
    call find_array(2_c_int, spacing, 'spacing', spacings, info)
    call find_array(depths, depth, 'depth', levels, info)
    call require_sizes(nx, ny, info)
    call require_count(depths, 1, 'depths', 'elements of depth', info)
    call require_count(count, 1, 'count', 'results', info)
    points = 0
    if (.not. info%failed()) call find_points([nx, ny, depths], points, info)
    call copy_results(points, int(count), names, results, all_names, all_results, info)
    if (.not. info%failed()) call fuge_write_volume(from_c_string(path), int(nx), int(ny), spacings(1), spacings(2), &
                                                    levels, all_names, all_results, info, first_centre(origin))
    status = report_to_c(info, message, length)
  end function c_write_volume

  !> The number of points of a volume, `points`; FUGE_ERR_SIZE if it is beyond the default integers.
  subroutine find_points(sizes, points, info)
    integer(c_int), intent(in) :: sizes(3)
    integer, intent(out) :: points
    type(fuge_info), intent(inout) :: info

    points = 0
    if (product(real(sizes, c_double)) > real(huge(points), c_double)) then
      call report(info, FUGE_ERR_SIZE, 'nx*ny*depths has '//text(int(sizes(1)))//' x '//text(int(sizes(2)))//' x ' &
                  //text(int(sizes(3)))//' points: more than an int can count')
    else
      points = product(int(sizes))
    end if
  end subroutine find_points

  !> The centre of the first cell: 0, 0 unless C gives it.
  function first_centre(origin) result(centre)
    type(c_ptr), intent(in) :: origin
    real(c_double) :: centre(2)
    real(c_double), pointer :: place(:)

    centre = 0.0_c_double
    if (.not. c_associated(origin)) return
    call c_f_pointer(origin, place, [2])
    centre = place
  end function first_centre

  !> Copy the names of `count` results of n values and the results, unless an error is known already.
  subroutine copy_results(n, count, names, results, all_names, all_results, info)
    integer, intent(in) :: n, count
    type(c_ptr), intent(in) :: names, results
    character(len=NAME_LENGTH), allocatable, intent(out) :: all_names(:)
    real(c_double), allocatable, intent(out) :: all_results(:, :)
    type(fuge_info), intent(inout) :: info
    type(c_ptr), pointer :: name(:), address(:)
    real(c_double), pointer :: values(:)
    integer :: k, status

    call require_pointer(names, 'names', info)
    call require_pointer(results, 'results', info)
    if (info%failed()) return
    allocate (all_names(count), all_results(n, count), stat=status)
    call require_memory(status, 'a copy of '//text(count)//' results of', n, 'values', info)
    if (status /= 0) return
    call c_f_pointer(names, name, [count])
    call c_f_pointer(results, address, [count])
    do k = 1, count
      call require_pointer(name(k), 'names['//index_text(k)//']', info)
      call require_pointer(address(k), 'results['//index_text(k)//']', info)
      if (info%failed()) return
      all_names(k) = from_c_string(name(k))
      call c_f_pointer(address(k), values, [n])
      all_results(:, k) = values
    end do
  end subroutine copy_results

end module fuge_c_result_files
