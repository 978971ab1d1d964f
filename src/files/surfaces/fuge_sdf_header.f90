!> The header of a surface data file, SDF (ISO 25178-71).
module fuge_sdf_header
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_kinds, only: dp
  use fuge_little_endian, only: real_at, unsigned_at
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info
  use fuge_surface_heights, only: is_in_range
  use fuge_text_columns, only: find_column
  use fuge_text_numbers, only: describe_text, lower_case, quoted, read_number, read_whole, KIND_NUMBER
  use fuge_text_reader, only: text_file
  implicit none
  private

  public :: check_version, is_sdf, read_binary_header, read_text_header

  !> Length of the version, which a binary header begins with, and of the whole header.
  integer, parameter :: VERSION_LENGTH = 8
  integer(int64), parameter, public :: BINARY_HEADER_LENGTH = 81_int64
  !> First characters of a name, enough to tell it from others.
  integer, parameter :: NAME_LENGTH = 12
  !> Types of the heights.
  integer, parameter, public :: SDF_INT16 = 5, SDF_INT32 = 6, SDF_DOUBLE = 7

  !> What the header says about the heights.
  type, public :: sdf_header
    !> Points of a profile, and profiles.
    integer(int64) :: nx = 0_int64, ny = 0_int64
    !> Spacings, and the unit of the heights; metres.
    real(dp) :: scale_x = 0.0_dp, scale_y = 0.0_dp, scale_z = 0.0_dp
    integer(int64) :: compression = 0_int64, data_type = 0_int64, check_type = 0_int64
  end type sdf_header

contains

  !> Does the file begin with a version of SDF: of the standard, or of one of the formats that came before it?
  pure function is_sdf(file) result(sdf)
    type(text_file), intent(in) :: file
    logical :: sdf
    character(len=*), parameter :: NAMES(5) = ['BC- ', 'BCR-', 'ISO-', 'NIST', 'NPL-']
    character(len=VERSION_LENGTH) :: version
    integer :: k

    version = version_of(file)
    sdf = .false.
    do k = 1, size(NAMES)
      sdf = sdf .or. index(version(2:), trim(NAMES(k))) == 1
    end do
    sdf = sdf .and. scan(version(1:1), 'abAB') > 0
  end function is_sdf

  !> The first characters of a file whose lines have not been read yet.
  pure function version_of(file) result(version)
    type(text_file), intent(in) :: file
    character(len=VERSION_LENGTH) :: version
    integer(int64) :: first

    first = file%last + 2_int64
    version = file%content(first:min(first + VERSION_LENGTH - 1_int64, len(file%content, kind=int64)))
  end function version_of

  !> Refuse a version that is not read (FUGE_ERR_FILE); otherwise, is the file binary?
  pure subroutine check_version(file, binary, info)
    type(text_file), intent(in) :: file
    logical, intent(out) :: binary
    type(fuge_info), intent(inout) :: info
    character(len=VERSION_LENGTH) :: version

    version = version_of(file)
    binary = version == 'bISO-1.0'
    if (.not. is_sdf(file)) then
      call file%refuse('an SDF file begins with its version, as aISO-1.0', info)
    else if (.not. (binary .or. version == 'aISO-1.0' .or. version == 'aISO-2.0')) then
      call file%refuse('the version '//quoted(version)//' is not read: save the surface as aISO-1.0 or bISO-1.0', info)
    end if
  end subroutine check_version

  !> Read the header of a text file; on return the present line is the asterisk after it.
  !>
  !> Error: FUGE_ERR_FILE.
  pure subroutine read_text_header(file, header, info)
    type(text_file), intent(inout) :: file
    type(sdf_header), intent(out) :: header
    type(fuge_info), intent(inout) :: info
    logical :: exists
    integer :: first, last

    ! The version.
    call file%advance(exists)
    do
      call file%advance(exists)
      if (.not. exists .or. file%last - file%first >= huge(1) - 2) then
        call file%refuse('the header must end with a line with *', info)
        return
      end if
      call find_column(file%content(file%first:file%last), 1, first, last)
      if (last < first) cycle
      if (file%content(file%first + first - 1:file%first + first - 1) == '*') exit
      call read_entry(file, header, info)
      if (info%failed()) return
    end do
    call check_header(file, header, info)
  end subroutine read_text_header

  !> Take the entry of the present line, `name = value`; others than those needed are passed over.
  pure subroutine read_entry(file, header, info)
    type(text_file), intent(in) :: file
    type(sdf_header), intent(inout) :: header
    type(fuge_info), intent(inout) :: info
    character(len=NAME_LENGTH) :: name
    integer :: first, last

    call split_entry(file%content(file%first:file%last), name, first, last)
    ! Not by cases: gfortran keeps the table of the names as a variable, which threads would share.
    if (name == 'numpoints') call take_whole(file, first, last, header%nx, info)
    if (name == 'numprofiles') call take_whole(file, first, last, header%ny, info)
    if (name == 'compression') call take_whole(file, first, last, header%compression, info)
    if (name == 'checktype') call take_whole(file, first, last, header%check_type, info)
    if (name == 'xscale') call take_real(file, first, last, header%scale_x, info)
    if (name == 'yscale') call take_real(file, first, last, header%scale_y, info)
    if (name == 'zscale') call take_real(file, first, last, header%scale_z, info)
  end subroutine read_entry

  !> The name of an entry, in lower case, and the position of its value, line(first:last).
  pure subroutine split_entry(line, name, first, last)
    character(len=*), intent(in) :: line
    character(len=NAME_LENGTH), intent(out) :: name
    integer, intent(out) :: first, last
    integer :: equals

    equals = scan(line, '=')
    name = ''
    call find_column(line, 1, first, last)
    if (equals > 0) name = line(first:min(last, equals - 1))
    name = lower_case(name)
    call find_column(line, equals + 1, first, last)
  end subroutine split_entry

  pure subroutine take_whole(file, first, last, value, info)
    type(text_file), intent(in) :: file
    integer, intent(in) :: first, last
    integer(int64), intent(out) :: value
    type(fuge_info), intent(inout) :: info
    integer :: kind

    value = 0_int64
    associate (begin => file%first - 1_int64)
      call read_whole(file%content(begin + first:begin + last), kind, value)
      if (kind /= KIND_NUMBER) call file%refuse(quoted(file%content(begin + first:begin + last)) &
                                                 //' is not a whole number', info)
    end associate
  end subroutine take_whole

  pure subroutine take_real(file, first, last, value, info)
    type(text_file), intent(in) :: file
    integer, intent(in) :: first, last
    real(dp), intent(out) :: value
    type(fuge_info), intent(inout) :: info
    integer :: kind

    associate (begin => file%first - 1_int64)
      call read_number(file%content(begin + first:begin + last), kind, value)
      if (kind /= KIND_NUMBER) call file%refuse(describe_text(file%content(begin + first:begin + last), kind), info)
    end associate
  end subroutine take_real

  !> Read the header of a binary file.
  !>
  !> Error: FUGE_ERR_FILE.
  pure subroutine read_binary_header(file, header, info)
    type(text_file), intent(in) :: file
    type(sdf_header), intent(out) :: header
    type(fuge_info), intent(inout) :: info

    if (len(file%content, kind=int64) < BINARY_HEADER_LENGTH) then
      call file%refuse('the file ends within its header', info)
      return
    end if
    ! After the version, the maker (10 characters), the dates of creation and change (12 each).
    header%nx = unsigned_at(file%content, 43_int64, 2)
    header%ny = unsigned_at(file%content, 45_int64, 2)
    header%scale_x = real_at(file%content, 47_int64)
    header%scale_y = real_at(file%content, 55_int64)
    header%scale_z = real_at(file%content, 63_int64)
    ! At 71 the resolution of the heights.
    header%compression = unsigned_at(file%content, 79_int64, 1)
    header%data_type = unsigned_at(file%content, 80_int64, 1)
    header%check_type = unsigned_at(file%content, 81_int64, 1)
    ! Zero, or the digit 0.
    if (header%compression == iachar('0')) header%compression = 0_int64
    if (header%check_type == iachar('0')) header%check_type = 0_int64
    if (header%data_type < SDF_INT16 .or. header%data_type > SDF_DOUBLE) then
      call file%refuse('DataType = '//text(int(header%data_type))//' is unknown: 5, 6 and 7 are read', info)
      return
    end if
    call check_header(file, header, info)
  end subroutine read_binary_header

  !> Refuse impossible numbers of points and scales, and compressed heights (FUGE_ERR_FILE).
  pure subroutine check_header(file, header, info)
    type(text_file), intent(in) :: file
    type(sdf_header), intent(in) :: header
    type(fuge_info), intent(inout) :: info

    if (header%compression /= 0_int64 .or. header%check_type /= 0_int64) then
      call file%refuse('compressed heights and check sums are not read: Compression and CheckType must be 0', info)
    else if (header%nx < 1_int64 .or. header%ny < 1_int64 .or. max(header%nx, header%ny) > huge(1)) then
      call file%refuse('NumPoints and NumProfiles must be from 1 to '//text(huge(1)), info)
    else if (header%nx*header%ny > min(int(huge(1), int64), len(file%content, kind=int64))) then
      call file%refuse(text(int(header%nx))//' x '//text(int(header%ny))//' heights are more than the file has', info)
    else
      call check_scale(file, 'Xscale', header%scale_x, header%nx > 1_int64, info)
      call check_scale(file, 'Yscale', header%scale_y, header%ny > 1_int64, info)
      call check_scale(file, 'Zscale', header%scale_z, .true., info)
    end if
  end subroutine check_header

  !> Refuse a scale that is not positive or out of range, or below 0 if it is not `needed` (FUGE_ERR_FILE).
  pure subroutine check_scale(file, name, scale, needed, info)
    type(text_file), intent(in) :: file
    character(len=*), intent(in) :: name
    real(dp), intent(in) :: scale
    logical, intent(in) :: needed
    type(fuge_info), intent(inout) :: info
    logical :: valid

    if (info%failed()) return
    valid = ieee_is_finite(scale)
    if (valid) valid = is_in_range(scale) .and. scale >= 0.0_dp .and. (scale > 0.0_dp .or. .not. needed)
    if (.not. valid) call file%refuse(name//' = '//text(scale)//' must be a length > 0', info)
  end subroutine check_scale

end module fuge_sdf_header
