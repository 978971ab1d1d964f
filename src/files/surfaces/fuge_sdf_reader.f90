!> A surface from a surface data file, SDF (ISO 25178-71), as text or binary.
module fuge_sdf_reader
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_constants, only: LARGEST_EXPONENT
  use fuge_kinds, only: dp
  use fuge_little_endian, only: real_at, signed_at, unsigned_at
  use fuge_number_text, only: index_text, text
  use fuge_sdf_header, only: check_version, read_binary_header, read_text_header, sdf_header, &
    BINARY_HEADER_LENGTH, SDF_INT16
  use fuge_status, only: fuge_info
  use fuge_surface_heights, only: allocate_heights, read_height, NOT_MEASURED
  use fuge_surface_type, only: fuge_surface
  use fuge_text_columns, only: find_column
  use fuge_text_numbers, only: quoted
  use fuge_text_reader, only: text_file
  implicit none
  private

  public :: read_sdf

contains

  !> Read a surface data file: profile j has the heights of points (1, j), (2, j) and so on, in metres.
  !>
  !> With `fill` the heights that were not measured are NOT_MEASURED.
  !> Errors: FUGE_ERR_FILE, FUGE_ERR_MEMORY.
  subroutine read_sdf(file, fill, surface, info)
    type(text_file), intent(inout) :: file
    logical, intent(in) :: fill
    type(fuge_surface), intent(inout) :: surface
    type(fuge_info), intent(inout) :: info
    type(sdf_header) :: header
    logical :: binary

    call file%rewind()
    call check_version(file, binary, info)
    if (info%failed()) return
    if (binary) then
      call read_binary_header(file, header, info)
    else
      call read_text_header(file, header, info)
    end if
    if (info%failed()) return
    call allocate_heights(file%name, int(header%nx), int(header%ny), surface%height, info)
    if (info%failed()) return
    if (binary) then
      call read_binary_heights(file, int(header%data_type), size(surface%height), surface%height, info)
    else
      call read_text_heights(file, fill, size(surface%height), surface%height, info)
    end if
    if (.not. info%failed()) call scale_heights(file, header%scale_z, fill, surface%height, info)
    if (header%nx > 1_int64) surface%spacing_x = header%scale_x
    if (header%ny > 1_int64) surface%spacing_y = header%scale_y
  end subroutine read_sdf

  !> Read `n` heights after the header, up to the asterisk; line breaks have no meaning.
  pure subroutine read_text_heights(file, fill, n, height, info)
    type(text_file), intent(inout) :: file
    logical, intent(in) :: fill
    integer, intent(in) :: n
    real(dp), intent(inout) :: height(n)
    type(fuge_info), intent(inout) :: info
    character(len=:), allocatable :: reason
    integer :: heights
    logical :: exists, ended

    heights = 0
    ended = .false.
    do while (.not. ended)
      call file%advance(exists)
      if (.not. exists .or. file%last - file%first >= huge(1) - 2) then
        reason = 'the file ends after '//text(heights)//' of '//text(n)//' heights, without the * that ends them'
      else
        call read_text_line(file%content(file%first:file%last), fill, height, heights, ended, reason)
      end if
      if (ended .and. heights < n .and. .not. allocated(reason)) reason = 'the heights end after '//text(heights) &
          //' of '//text(n)
      if (allocated(reason)) then
        call file%refuse(reason, info)
        return
      end if
    end do
  end subroutine read_text_heights

  !> Read the heights on a line, of which `heights` were read before; `ended` at an asterisk.
  pure subroutine read_text_line(line, fill, height, heights, ended, reason)
    character(len=*), intent(in) :: line
    logical, intent(in) :: fill
    real(dp), intent(inout) :: height(:)
    integer, intent(inout) :: heights
    logical, intent(inout) :: ended
    character(len=:), allocatable, intent(inout) :: reason
    integer :: first, last

    last = 0
    do
      call find_column(line, last + 1, first, last)
      if (last < first) return
      ended = line(first:first) == '*'
      if (ended) return
      if (heights == size(height)) then
        reason = 'more than '//text(heights)//' heights, the product of NumPoints and NumProfiles'
        return
      end if
      heights = heights + 1
      call read_height(line(first:last), height(heights), reason)
      if (allocated(reason)) return
      if (.not. fill .and. .not. height(heights) < NOT_MEASURED) then
        reason = quoted(line(first:last))//': the point was not measured: let such points be filled'
        return
      end if
    end do
  end subroutine read_text_line

  !> Read `n` heights of the given type after a binary header.
  pure subroutine read_binary_heights(file, data_type, n, height, info)
    type(text_file), intent(in) :: file
    integer, intent(in) :: data_type, n
    real(dp), intent(inout) :: height(n)
    type(fuge_info), intent(inout) :: info
    integer(int64) :: first, length
    integer :: k

    length = ishft(2_int64, data_type - SDF_INT16)
    first = BINARY_HEADER_LENGTH + 1_int64
    if (len(file%content, kind=int64) - BINARY_HEADER_LENGTH < length*n) then
      call file%refuse('the file ends before the last of '//text(n)//' heights', info)
      return
    end if
    ! Some instruments have a longer header, by the numbers 5 and 1 of four bytes each.
    if (len(file%content, kind=int64) - BINARY_HEADER_LENGTH == length*n + 8_int64) then
      if (unsigned_at(file%content, first, 4) == 5_int64) then
        if (unsigned_at(file%content, first + 4_int64, 4) == 1_int64) first = first + 8_int64
      end if
    end if
    do k = 1, n
      height(k) = binary_height(file%content(first:first + length - 1_int64))
      first = first + length
    end do
  end subroutine read_binary_heights

  !> A height of 2, 4 or 8 bytes, NOT_MEASURED if it is the least number of its type or NaN.
  !>
  !> Infinity becomes -NOT_MEASURED, which is out of range.
  pure function binary_height(bytes) result(value)
    character(len=*), intent(in) :: bytes
    real(dp) :: value
    integer(int64) :: whole

    if (len(bytes) == 8) then
      value = real_at(bytes, 1_int64)
      if (.not. (ieee_is_nan(value) .or. ieee_is_finite(value))) then
        value = -NOT_MEASURED
      else if (ieee_is_nan(value)) then
        value = NOT_MEASURED
      else if (.not. value > -huge(value)) then
        value = NOT_MEASURED
      end if
    else
      whole = signed_at(bytes, 1_int64, len(bytes))
      value = real(whole, dp)
      if (whole == -ishft(1_int64, 8*len(bytes) - 1)) value = NOT_MEASURED
    end if
  end function binary_height

  !> Multiply the heights by their unit; refuse those out of range and, without `fill`, not measured (FUGE_ERR_FILE).
  pure subroutine scale_heights(file, unit, fill, height, info)
    type(text_file), intent(in) :: file
    real(dp), intent(in) :: unit
    logical, intent(in) :: fill
    real(dp), intent(inout) :: height(:, :)
    type(fuge_info), intent(inout) :: info
    integer :: i, j

    do j = 1, size(height, 2)
      do i = 1, size(height, 1)
        if (height(i, j) < NOT_MEASURED) then
          if (exponent(height(i, j)) + exponent(unit) > LARGEST_EXPONENT) then
            call file%refuse('the height of point ('//index_text(i)//', '//index_text(j)//') is out of range', info)
            return
          end if
          height(i, j) = height(i, j)*unit
        else if (.not. fill) then
          call file%refuse('point ('//index_text(i)//', '//index_text(j) &
                           //') was not measured: let such points be filled', info)
          return
        end if
      end do
    end do
  end subroutine scale_heights

end module fuge_sdf_reader
