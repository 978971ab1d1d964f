!> A surface from a plain grid of numbers, and back.
module fuge_surface_grid
  use fuge_kinds, only: dp
  use fuge_locks, only: lock, unlock, LOCK_FILES
  use fuge_status, only: fuge_info
  use fuge_surface_heights, only: allocate_heights
  use fuge_surface_rows, only: advance_to_row, count_rows, find_first_row, read_row, refuse_unmeasured, row_form
  use fuge_surface_type, only: fuge_surface
  use fuge_text_columns, only: find_column
  use fuge_text_numbers, only: read_number, KIND_NUMBER
  use fuge_text_reader, only: text_file
  use fuge_text_writer, only: text_output
  implicit none
  private

  public :: read_grid, write_grid

  !> The comments that hold the spacings.
  character(len=*), parameter :: NAME_X = '# spacing_x =', NAME_Y = '# spacing_y ='
  !> Numbers that one write statement converts, because each statement costs time.
  integer, parameter :: BLOCK = 64
  integer, parameter :: NUMBER_LENGTH = 25

contains

  !> Read a grid: row j of the file has the heights of points (1, j), (2, j) and so on.
  !>
  !> With `fill` the heights that were not measured are NOT_MEASURED.
  !> Errors: FUGE_ERR_FILE, FUGE_ERR_MEMORY.
  subroutine read_grid(file, fill, surface, info)
    type(text_file), intent(inout) :: file
    logical, intent(in) :: fill
    type(fuge_surface), intent(inout) :: surface
    type(fuge_info), intent(inout) :: info
    type(row_form) :: form
    integer :: rows

    call count_rows(file, rows, info)
    if (.not. info%failed()) call find_first_row(file, form, info)
    if (.not. info%failed()) call allocate_heights(file%name, form%columns, rows, surface%height, info)
    if (.not. info%failed()) call read_rows(file, form, fill, surface%height, info)
    if (.not. info%failed()) call read_spacings(file, surface)
  end subroutine read_grid

  !> Read all rows; the file stands at the first one.
  pure subroutine read_rows(file, form, fill, height, info)
    type(text_file), intent(inout) :: file
    type(row_form), intent(in) :: form
    logical, intent(in) :: fill
    real(dp), intent(inout) :: height(:, :)
    type(fuge_info), intent(inout) :: info
    character(len=:), allocatable :: reason
    integer :: j, unmeasured
    logical :: exists

    do j = 1, size(height, 2)
      call read_row(file%content(file%first:file%last), form, height(:, j), unmeasured, reason)
      if (allocated(reason)) then
        call file%refuse(reason, info)
      else if (unmeasured > 0 .and. .not. fill) then
        call refuse_unmeasured(file, unmeasured, info)
      end if
      if (info%failed()) return
      call advance_to_row(file, exists, info)
    end do
  end subroutine read_rows

  !> Take the spacings from comments before the first row, as `write_grid` leaves them.
  pure subroutine read_spacings(file, surface)
    type(text_file), intent(inout) :: file
    type(fuge_surface), intent(inout) :: surface
    logical :: exists

    call file%rewind()
    do
      call file%advance(exists)
      if (.not. exists .or. file%last < file%first) exit
      if (file%content(file%first:file%first) /= '#') exit
      call read_spacing(file%content(file%first:file%last), NAME_X, surface%spacing_x)
      call read_spacing(file%content(file%first:file%last), NAME_Y, surface%spacing_y)
    end do
  end subroutine read_spacings

  !> Take a spacing from a comment that consists of the name and a positive number.
  pure subroutine read_spacing(line, name, spacing)
    character(len=*), intent(in) :: line, name
    real(dp), intent(inout) :: spacing
    real(dp) :: value
    integer :: first, last, next, after, kind

    if (index(line, name) /= 1) return
    call find_column(line, len(name) + 1, first, last)
    call read_number(line(first:last), kind, value)
    call find_column(line, last + 1, next, after)
    if (kind == KIND_NUMBER .and. after < next .and. value > 0.0_dp) spacing = value
  end subroutine read_spacing

  !> Write a grid with 17 digits, so that it is read back to the last bit, and its spacings where they are known.
  !>
  !> Error: FUGE_ERR_FILE.
  subroutine write_grid(path, surface, info)
    character(len=*), intent(in) :: path
    type(fuge_surface), intent(in) :: surface
    type(fuge_info), intent(inout) :: info
    type(text_output) :: file
    character(len=NUMBER_LENGTH) :: spacings(2)
    integer :: j

    call file%create(path, info)
    if (info%failed()) return
    call convert([surface%spacing_x, surface%spacing_y], spacings)
    if (surface%spacing_x > 0.0_dp) call file%put(NAME_X//spacings(1))
    if (surface%spacing_y > 0.0_dp) call file%put(NAME_Y//spacings(2))
    do j = 1, size(surface%height, 2)
      call write_row(file, surface%height(:, j))
    end do
    call file%finish(info)
  end subroutine write_grid

  subroutine write_row(file, height)
    type(text_output), intent(inout) :: file
    real(dp), intent(in) :: height(:)
    character(len=NUMBER_LENGTH) :: strings(BLOCK)
    integer :: i, k, last

    do i = 1, size(height), BLOCK
      last = min(i + BLOCK - 1, size(height))
      call convert(height(i:last), strings)
      do k = 1, last - i + 1
        call file%put_bytes(strings(k)(merge(2, 1, i + k == 2):))
      end do
    end do
    call file%put('')
  end subroutine write_row

  !> Numbers as text.
  subroutine convert(numbers, strings)
    real(dp), intent(in) :: numbers(:)
    character(len=NUMBER_LENGTH), intent(inout) :: strings(:)

    ! gfortran's run-time library keeps internal units in the list through which `open` walks.
    call lock(LOCK_FILES)
    write (strings(:size(numbers)), '(es25.16e3)') numbers
    call unlock(LOCK_FILES)
  end subroutine convert

end module fuge_surface_grid
