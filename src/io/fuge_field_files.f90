!> Fields on a regular grid as a file for ParaView: VTK image data, VTI, with the numbers as they are.
!>
!> The format: W. Schroeder, K. Martin, B. Lorensen, The Visualization Toolkit, and VTK file formats, docs.vtk.org.
module fuge_field_files
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_locks, only: lock, unlock, LOCK_FILES
  use fuge_number_text, only: index_text, text
  use fuge_status, only: composed_message, fuge_info, report, FUGE_ERR_NOT_FINITE, FUGE_ERR_OPTION, FUGE_ERR_SIZE, &
    FUGE_ERR_WIDTH
  use fuge_text_writer, only: text_output
  implicit none
  private

  public :: fuge_write_fields

  !> Length of a name; longer ones are refused.
  integer, parameter :: NAME_LENGTH = 200

contains

  !> Write fields on a grid of rectangular cells to a VTI file, which ParaView reads; an existing file is replaced.
  !>
  !> `nx`, `ny`: numbers of cells; `spacing_x`, `spacing_y`: their sizes. `names` (k): of the fields, different, without
  !> trailing blanks. `fields` (nx*ny, k): their values, one for each cell, in the order i + nx*(j - 1); all finite.
  !> `origin` (2, default 0): the centre of cell (1, 1). Values are written as doubles, to the last bit.
  !> Errors: FUGE_ERR_SIZE, FUGE_ERR_WIDTH, FUGE_ERR_NOT_FINITE, FUGE_ERR_OPTION for a name, an existing file unchanged;
  !> FUGE_ERR_FILE if writing fails, the file is then empty.
  !> Nine arguments: the file, the grid, the fields, the report.
  subroutine fuge_write_fields(path, nx, ny, spacing_x, spacing_y, names, fields, info, origin)
    character(len=*), intent(in) :: path, names(:)
    integer, intent(in) :: nx, ny
    real(dp), intent(in) :: spacing_x, spacing_y, fields(:, :)
    type(fuge_info), intent(out) :: info
    real(dp), intent(in), optional :: origin(2)
    type(text_output) :: file
    real(dp) :: corner(2)
    integer :: k

    corner = 0.0_dp
    if (present(origin)) corner = origin
    call check_grid(nx, ny, [spacing_x, spacing_y], corner, info)
    if (.not. info%failed()) call check_fields(nx, ny, names, fields, info)
    if (.not. info%failed()) call file%create(path, info)
    if (info%failed()) return
    corner = corner - 0.5_dp*[spacing_x, spacing_y]
    call write_head(file, nx, ny, [spacing_x, spacing_y], corner, names)
    do k = 1, size(names)
      call file%put_bytes(transfer(8_int64*size(fields, 1, kind=int64), repeat(' ', 8)))
      call file%put_reals(fields(:, k))
    end do
    call file%put('')
    call file%put('</AppendedData>')
    call file%put('</VTKFile>')
    call file%finish(info)
  end subroutine fuge_write_fields

  !> Write all that stands before the numbers, in XML.
  subroutine write_head(file, nx, ny, spacing, corner, names)
    type(text_output), intent(inout) :: file
    integer, intent(in) :: nx, ny
    real(dp), intent(in) :: spacing(2), corner(2)
    character(len=*), intent(in) :: names(:)
    integer(int64) :: offset
    integer :: k

    call file%put('<?xml version="1.0"?>')
    call file%put('<VTKFile type="ImageData" version="1.0" byte_order="'//byte_order()//'" header_type="UInt64">')
    call file%put('<ImageData WholeExtent="0 '//text(nx)//' 0 '//text(ny)//' 0 0" Origin="'//pair(corner) &
                  //' 0" Spacing="'//pair(spacing)//' 1">')
    call file%put('<Piece Extent="0 '//text(nx)//' 0 '//text(ny)//' 0 0">')
    call file%put_bytes('<CellData Scalars="')
    call put_name(file, names(1))
    call file%put('">')
    offset = 0_int64
    do k = 1, size(names)
      call file%put_bytes('<DataArray type="Float64" Name="')
      call put_name(file, names(k))
      call file%put('" format="appended" offset="'//trim(whole(offset))//'"/>')
      offset = offset + 8_int64*(int(nx, int64)*int(ny, int64) + 1_int64)
    end do
    call file%put('</CellData>')
    call file%put('</Piece>')
    call file%put('</ImageData>')
    call file%put('<AppendedData encoding="raw">')
    call file%put_bytes('_')
  end subroutine write_head

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
  function pair(numbers) result(field)
    real(dp), intent(in) :: numbers(2)
    character(len=49) :: field

    ! gfortran's run-time library keeps internal units in the list through which `open` walks.
    call lock(LOCK_FILES)
    write (field, '(es24.16e3,1x,es24.16e3)') numbers
    call unlock(LOCK_FILES)
  end function pair

  !> A whole number, beyond the default integers perhaps.
  function whole(number) result(field)
    integer(int64), intent(in) :: number
    character(len=20) :: field

    call lock(LOCK_FILES)
    write (field, '(i0)') number
    call unlock(LOCK_FILES)
  end function whole

  !> Refuse numbers of cells, sizes of cells and an origin that cannot be.
  pure subroutine check_grid(nx, ny, spacing, origin, info)
    integer, intent(in) :: nx, ny
    real(dp), intent(in) :: spacing(2), origin(2)
    type(fuge_info), intent(inout) :: info

    if (nx < 1 .or. ny < 1) then
      call report(info, FUGE_ERR_SIZE, 'nx = '//text(nx)//', ny = '//text(ny)//': both must be 1 or more')
      return
    end if
    call check_finite(spacing(1), 'spacing_x', info)
    if (.not. info%failed()) call check_finite(spacing(2), 'spacing_y', info)
    if (.not. info%failed()) call check_finite(origin, 'origin', info)
    if (info%failed()) return
    if (.not. minval(spacing) > 0.0_dp) then
      call report(info, FUGE_ERR_WIDTH, 'spacing_x = '//text(spacing(1))//', spacing_y = '//text(spacing(2)) &
                  //': both must be > 0')
    end if
  end subroutine check_grid

  !> Refuse fields of another size (FUGE_ERR_SIZE), NaN and infinity (FUGE_ERR_NOT_FINITE), and names that are blank,
  !> repeated, too long or not printable (FUGE_ERR_OPTION).
  pure subroutine check_fields(nx, ny, names, fields, info)
    integer, intent(in) :: nx, ny
    character(len=*), intent(in) :: names(:)
    real(dp), intent(in) :: fields(:, :)
    type(fuge_info), intent(inout) :: info
    integer :: k

    if (size(fields, 2) < 1 .or. size(names) /= size(fields, 2) .or. &
        size(fields, 1, kind=int64) /= int(nx, int64)*int(ny, int64)) then
      call report(info, FUGE_ERR_SIZE, text(size(names))//' name(s) and '//text(size(fields, 2))//' field(s) of ' &
                  //text(size(fields, 1))//' values: each needs a name and '//text(nx)//' x '//text(ny)//' values')
      return
    end if
    do k = 1, size(names)
      call check_name(names, k, info)
      if (.not. info%failed()) call check_values(fields(:, k), trim(names(k)), info)
      if (info%failed()) return
    end do
  end subroutine check_fields

  !> Refuse name k if it is blank, too long, not printable, or that of an earlier field (FUGE_ERR_OPTION).
  pure subroutine check_name(names, k, info)
    character(len=*), intent(in) :: names(:)
    integer, intent(in) :: k
    type(fuge_info), intent(inout) :: info
    integer :: j

    if (len_trim(names(k)) < 1 .or. len_trim(names(k)) > NAME_LENGTH) then
      call report(info, FUGE_ERR_OPTION, 'the name of field '//index_text(k)//' must have 1 to '//text(NAME_LENGTH) &
                  //' characters')
    end if
    do j = 1, len_trim(names(k))
      if (iachar(names(k)(j:j)) < 32 .or. iachar(names(k)(j:j)) == 127) then
        call report(info, FUGE_ERR_OPTION, 'the name of field '//index_text(k)//' has a control character')
      end if
    end do
    do j = 1, k - 1
      if (names(j) == names(k)) then
        call report(info, FUGE_ERR_OPTION, 'fields '//index_text(j)//' and '//index_text(k)//' have the same name')
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
    if (found%failed()) call report(info, FUGE_ERR_NOT_FINITE, 'field "'//name//'": '//composed_message(found))
  end subroutine check_values

end module fuge_field_files
