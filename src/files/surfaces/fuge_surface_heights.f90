!> Heights of a surface: those in the columns of a file, measured or not, and those of a caller.
module fuge_surface_heights
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
  use fuge_constants, only: LARGEST_EXPONENT
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_status, only: fuge_info, report, FUGE_ERR_FILE, FUGE_ERR_MEMORY, FUGE_ERR_NOT_FINITE, FUGE_ERR_OVERFLOW, &
    FUGE_ERR_SIZE
  use fuge_text_numbers, only: describe_text, lower_case, quoted, read_number, KIND_NOT_FINITE, KIND_NUMBER, &
    KIND_WORD
  implicit none
  private

  public :: allocate_heights, check_heights, is_in_range, read_height

  !> Stands for the height of a point that was not measured; no height that is in range is as large.
  real(dp), parameter, public :: NOT_MEASURED = huge(1.0_dp)
  real(dp), parameter :: LARGEST_HEIGHT = scale(1.0_dp, LARGEST_EXPONENT)

contains

  !> Allocate the heights of a surface in a file whose name messages quote as `name`.
  !>
  !> Errors: FUGE_ERR_FILE for more points than an integer counts, FUGE_ERR_MEMORY.
  pure subroutine allocate_heights(name, nx, ny, height, info)
    character(len=*), intent(in) :: name
    integer, intent(in) :: nx, ny
    real(dp), allocatable, intent(inout) :: height(:, :)
    type(fuge_info), intent(inout) :: info
    integer :: status

    if (nx > huge(nx)/ny) then
      call report(info, FUGE_ERR_FILE, name//': '//text(nx)//' x '//text(ny) &
                  //' heights are more than an integer counts')
      return
    end if
    allocate (height(nx, ny), stat=status)
    if (status /= 0) call report(info, FUGE_ERR_MEMORY, name//': no memory for '//text(nx)//' x '//text(ny)//' heights')
  end subroutine allocate_heights

  !> Convert a column to a height, or to NOT_MEASURED if it is empty, NaN, or BAD, in letters of either case.
  !>
  !> `reason` is allocated if the column is neither, or out of range.
  pure subroutine read_height(string, value, reason)
    character(len=*), intent(in) :: string
    real(dp), intent(out) :: value
    character(len=:), allocatable, intent(inout) :: reason
    integer :: kind

    call read_number(string, kind, value)
    if (kind == KIND_NUMBER .and. is_in_range(value)) return
    if (kind == KIND_NUMBER) then
      reason = quoted(string)//' is out of range: choose another unit of length'
    else if (is_not_measured(string, kind)) then
      value = NOT_MEASURED
    else
      reason = describe_text(string, kind)
    end if
  end subroutine read_height

  !> Can heights of this size be added and subtracted without overflow?
  elemental function is_in_range(value) result(in_range)
    real(dp), intent(in) :: value
    logical :: in_range

    in_range = abs(value) <= LARGEST_HEIGHT
  end function is_in_range

  !> Does a column that is no number say that a point was not measured? `kind` as `read_number` returns it.
  pure function is_not_measured(string, kind) result(unmeasured)
    character(len=*), intent(in) :: string
    integer, intent(in) :: kind
    logical :: unmeasured
    character(len=4) :: word

    word = string
    word = lower_case(word)
    unmeasured = len(string) == 0 .or. (kind == KIND_WORD .and. word == 'bad' .and. len(string) == 3)
    if (kind == KIND_NOT_FINITE) unmeasured = index(word, 'nan') > 0
  end function is_not_measured

  !> Refuse a surface without points (FUGE_ERR_SIZE), NaN and infinity (FUGE_ERR_NOT_FINITE), and heights out of range
  !> (FUGE_ERR_OVERFLOW). NaN is let through if `holes` is true.
  pure subroutine check_heights(height, info, holes)
    real(dp), intent(in) :: height(:, :)
    type(fuge_info), intent(inout) :: info
    logical, intent(in), optional :: holes
    character(len=:), allocatable :: hint
    logical :: may_have_holes
    integer :: i, j

    may_have_holes = .false.
    if (present(holes)) may_have_holes = holes
    if (size(height) == 0) call report(info, FUGE_ERR_SIZE, 'the surface has no heights')
    do j = 1, size(height, 2)
      do i = 1, size(height, 1)
        if (ieee_is_finite(height(i, j))) then
          if (is_in_range(height(i, j))) cycle
          call report(info, FUGE_ERR_OVERFLOW, 'height('//index_text(i)//', '//index_text(j)//') = ' &
                      //text(height(i, j))//' is out of range: choose another unit of length')
        else
          hint = ''
          if (ieee_is_nan(height(i, j))) then
            if (may_have_holes) cycle
            hint = ': if the point was not measured, fill it by fuge_fill_surface'
          end if
          call report(info, FUGE_ERR_NOT_FINITE, 'height('//index_text(i)//', '//index_text(j)//') = ' &
                      //text(height(i, j))//' is not a finite number'//hint)
        end if
        return
      end do
    end do
  end subroutine check_heights

end module fuge_surface_heights
