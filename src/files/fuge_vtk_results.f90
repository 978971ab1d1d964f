!> What the VTK files of results share: names and numbers in XML, the list of the results, and their values after it.
!>
!> The format: W. Schroeder, K. Martin, B. Lorensen, The Visualization Toolkit, and VTK file formats, docs.vtk.org.
module fuge_vtk_results
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_locks, only: lock, unlock, LOCK_UNITS
  use fuge_number_text, only: index_text, text
  use fuge_status, only: composed_message, fuge_info, report, FUGE_ERR_NOT_FINITE, FUGE_ERR_OPTION, FUGE_ERR_SIZE
  use fuge_text_writer, only: text_output
  implicit none
  private

  public :: begin_values, begin_vtk, check_results, check_name, check_values, end_vtk, number_pair, put_array, &
    put_result_list, put_results, put_length, put_vector, whole

  !> Length of a name; longer ones are refused.
  integer, parameter :: NAME_LENGTH = 200

contains

  !> Write the first lines of a file of this type.
  subroutine begin_vtk(file, type)
    type(text_output), intent(inout) :: file
    character(len=*), intent(in) :: type

    call file%put('<?xml version="1.0"?>')
    call file%put('<VTKFile type="'//type//'" version="1.0" byte_order="'//trim(byte_order()) &
                  //'" header_type="UInt64">')
  end subroutine begin_vtk

  !> Write the list of the results of `points` values each, of which the first begins `offset` bytes after the beginning
  !> of the values; `section` is CellData or PointData. `offset` moves beyond them.
  subroutine put_result_list(file, section, names, points, offset)
    type(text_output), intent(inout) :: file
    character(len=*), intent(in) :: section, names(:)
    integer(int64), intent(in) :: points
    integer(int64), intent(inout) :: offset
    integer :: k

    call file%put_bytes('<'//section//' Scalars="')
    call put_name(file, names(1))
    call file%put('">')
    do k = 1, size(names)
      call put_array(file, names(k), points, offset)
    end do
    call file%put('</'//section//'>')
  end subroutine put_result_list

  !> Write where an array is, which has `components` values (1 unless given) at each of `points` points; `offset` moves
  !> beyond them. `type`: of the numbers, Float64 unless given, Int64 or UInt8.
  subroutine put_array(file, name, points, offset, components, type)
    type(text_output), intent(inout) :: file
    character(len=*), intent(in) :: name
    integer(int64), intent(in) :: points
    integer(int64), intent(inout) :: offset
    integer, intent(in), optional :: components
    character(len=*), intent(in), optional :: type
    character(len=7) :: number
    integer :: each

    each = 1
    if (present(components)) each = components
    number = 'Float64'
    if (present(type)) number = type
    call file%put_bytes('<DataArray type="'//trim(number)//'" Name="')
    call put_name(file, name)
    if (each > 1) call file%put_bytes('" NumberOfComponents="'//text(each))
    call file%put('" format="appended" offset="'//trim(whole(offset))//'"/>')
    offset = offset + 8_int64 + merge(1_int64, 8_int64, number == 'UInt8')*each*points
  end subroutine put_array

  !> Write what stands between the XML and the numbers.
  subroutine begin_values(file)
    type(text_output), intent(inout) :: file

    call file%put('<AppendedData encoding="raw">')
    call file%put_bytes('_')
  end subroutine begin_values

  !> Write the number of bytes of the array that follows.
  subroutine put_length(file, bytes)
    type(text_output), intent(inout) :: file
    integer(int64), intent(in) :: bytes

    call file%put_bytes(transfer(bytes, repeat(' ', 8)))
  end subroutine put_length

  !> Write the three components of a vector.
  subroutine put_vector(file, vector)
    type(text_output), intent(inout) :: file
    real(dp), intent(in) :: vector(3)

    call file%put_bytes(transfer(vector, repeat(' ', 24)))
  end subroutine put_vector

  !> Write the values of results, (points, k), each after the number of its bytes.
  subroutine put_results(file, results)
    type(text_output), intent(inout) :: file
    real(dp), intent(in) :: results(:, :)
    integer :: k

    do k = 1, size(results, 2)
      call put_length(file, 8_int64*size(results, 1, kind=int64))
      call file%put_reals(results(:, k))
    end do
  end subroutine put_results

  !> Write the last lines of a file.
  subroutine end_vtk(file)
    type(text_output), intent(inout) :: file

    call file%put('')
    call file%put('</AppendedData>')
    call file%put('</VTKFile>')
  end subroutine end_vtk

  !> Write a name as XML spells it.
  subroutine put_name(file, name)
    type(text_output), intent(inout) :: file
    character(len=*), intent(in) :: name
    integer :: k

    do k = 1, len_trim(name)
      select case (name(k:k))
      case ('&')
        call file%put_bytes('&amp;')
      case ('<')
        call file%put_bytes('&lt;')
      case ('>')
        call file%put_bytes('&gt;')
      case ('"')
        call file%put_bytes('&quot;')
      case default
        call file%put_bytes(name(k:k))
      end select
    end do
  end subroutine put_name

  !> The order of bytes of this machine, as VTK names it.
  pure function byte_order() result(name)
    character(len=12) :: name

    name = 'LittleEndian'
    if (transfer(1_int64, '.') == achar(0)) name = 'BigEndian'
  end function byte_order

  !> Two numbers with all their digits.
  function number_pair(numbers) result(string)
    real(dp), intent(in) :: numbers(2)
    character(len=49) :: string

    ! gfortran's run-time library keeps internal units in the list through which `open` walks.
    call lock(LOCK_UNITS)
    write (string, '(es24.16e3,1x,es24.16e3)') numbers
    call unlock(LOCK_UNITS)
  end function number_pair

  !> A whole number, which may be beyond the default integers.
  function whole(number) result(string)
    integer(int64), intent(in) :: number
    character(len=20) :: string

    call lock(LOCK_UNITS)
    write (string, '(i0)') number
    call unlock(LOCK_UNITS)
  end function whole

  !> Refuse results of another number of values than `points`, `shape_text` in words (FUGE_ERR_SIZE), NaN and infinity
  !> (FUGE_ERR_NOT_FINITE), and names that are blank, repeated, too long or not printable (FUGE_ERR_OPTION).
  pure subroutine check_results(points, shape_text, names, results, info)
    integer(int64), intent(in) :: points
    character(len=*), intent(in) :: shape_text, names(:)
    real(dp), intent(in) :: results(:, :)
    type(fuge_info), intent(inout) :: info
    integer :: k

    if (size(results, 2) < 1 .or. size(names) /= size(results, 2) .or. size(results, 1, kind=int64) /= points) then
      call report(info, FUGE_ERR_SIZE, text(size(names))//' name(s) and '//text(size(results, 2))//' result(s) of ' &
                  //text(size(results, 1))//' values: each needs a name and '//shape_text//' values')
      return
    end if
    do k = 1, size(names)
      call check_name(names, k, info)
      if (.not. info%failed()) call check_values(results(:, k), trim(names(k)), info)
      if (info%failed()) return
    end do
  end subroutine check_results

  !> Refuse name k if it is blank, too long, not printable, or that of an earlier result (FUGE_ERR_OPTION).
  pure subroutine check_name(names, k, info)
    character(len=*), intent(in) :: names(:)
    integer, intent(in) :: k
    type(fuge_info), intent(inout) :: info
    integer :: j

    if (len_trim(names(k)) < 1 .or. len_trim(names(k)) > NAME_LENGTH) then
      call report(info, FUGE_ERR_OPTION, 'name '//index_text(k)//' must have 1 to '//text(NAME_LENGTH) &
                  //' characters')
    end if
    do j = 1, len_trim(names(k))
      if (iachar(names(k)(j:j)) < 32 .or. iachar(names(k)(j:j)) == 127) then
        call report(info, FUGE_ERR_OPTION, 'name '//index_text(k)//' has a control character')
      end if
    end do
    do j = 1, k - 1
      if (names(j) == names(k)) then
        call report(info, FUGE_ERR_OPTION, 'names '//index_text(j)//' and '//index_text(k)//' are the same')
      end if
    end do
  end subroutine check_name

  !> Refuse NaN and infinity (FUGE_ERR_NOT_FINITE).
  pure subroutine check_values(values, name, info)
    real(dp), intent(in) :: values(:)
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info
    type(fuge_info) :: found

    call check_finite(values, 'value', found)
    if (found%failed()) call report(info, FUGE_ERR_NOT_FINITE, 'result "'//name//'": '//composed_message(found))
  end subroutine check_values

end module fuge_vtk_results
