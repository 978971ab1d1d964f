!> A measured surface from its file: in the user's unit of length, and levelled.
module surface_file
  use fuge_core, only: dp => fuge_dp, fuge_info, FUGE_ERR_OPTION, FUGE_ERR_OVERFLOW
  use fuge_files, only: fuge_level_surface, fuge_read_surface, fuge_surface
  use number_words, only: short_text
  use surface_options, only: surface_settings, LEVEL_NONE
  implicit none
  private

  public :: read_heights, rms_height, rms_slope

  !> Squares of heights over spacings do not overflow: neither is above this length, and no spacing below its inverse.
  real(dp), parameter :: LARGEST_LENGTH = 1.0e70_dp

contains

  !> Errors: those of `fuge_read_surface`; FUGE_ERR_OPTION for spacings that nobody gives, or both the file and the
  !> options; FUGE_ERR_OVERFLOW.
  subroutine read_heights(path, settings, surface, info)
    character(len=*), intent(in) :: path
    type(surface_settings), intent(in) :: settings
    type(fuge_surface), intent(inout) :: surface
    type(fuge_info), intent(inout) :: info

    call fuge_read_surface(path, surface, info, fill=settings%fill)
    if (info%failed() .and. index(info%message, 'let such points be filled') > 0) &
      info%message = trim(info%message)//' by --fill'
    if (.not. info%failed()) call take_spacing(path, settings, surface, info)
    if (info%failed()) return
    surface%origin_x = settings%scale*surface%origin_x
    surface%origin_y = settings%scale*surface%origin_y
    if (maxval(abs(surface%height)) > LARGEST_LENGTH/max(settings%height_scale, 1.0_dp) &
        .or. max(surface%spacing_x, surface%spacing_y) > LARGEST_LENGTH &
        .or. min(surface%spacing_x, surface%spacing_y) < 1.0_dp/LARGEST_LENGTH) then
      info%status = FUGE_ERR_OVERFLOW
      info%message = '"'//path//'": its heights or spacings are out of range after --height-scale or --scale'
      return
    end if
    surface%height = settings%height_scale*surface%height
    if (settings%level /= LEVEL_NONE) call fuge_level_surface(surface%height, settings%level, info)
  end subroutine read_heights

  !> The spacings of the file, scaled, or those of the options.
  subroutine take_spacing(path, settings, surface, info)
    character(len=*), intent(in) :: path
    type(surface_settings), intent(in) :: settings
    type(fuge_surface), intent(inout) :: surface
    type(fuge_info), intent(inout) :: info
    logical :: is_known

    is_known = surface%spacing_x > 0.0_dp .and. surface%spacing_y > 0.0_dp
    if (is_known .and. allocated(settings%spacing)) then
      info%status = FUGE_ERR_OPTION
      info%message = '--spacing: "'//path//'" has spacings of its own, '//short_text(surface%spacing_x)//' and ' &
        //short_text(surface%spacing_y)//'; leave the option out, --scale changes their unit'
    else if (is_known) then
      surface%spacing_x = settings%scale*surface%spacing_x
      surface%spacing_y = settings%scale*surface%spacing_y
    else if (allocated(settings%spacing)) then
      surface%spacing_x = settings%spacing(1)
      surface%spacing_y = settings%spacing(2)
    else
      info%status = FUGE_ERR_OPTION
      info%message = '"'//path//'" does not say how far apart its points are: give --spacing, one or two lengths, or ' &
        //'comments # spacing_x = .. and # spacing_y = .. before its heights'
    end if
  end subroutine take_spacing

  !> Root mean square of the heights about their mean.
  pure function rms_height(surface) result(rms)
    type(fuge_surface), intent(in) :: surface
    real(dp) :: rms
    real(dp) :: mean

    mean = sum(surface%height)/real(size(surface%height), dp)
    rms = sqrt(sum((surface%height - mean)**2)/real(size(surface%height), dp))
  end function rms_height

  !> Root mean square of the slope between neighbours along x, and along y, both together; 0 for one point.
  pure function rms_slope(surface) result(rms)
    type(fuge_surface), intent(in) :: surface
    real(dp) :: rms
    real(dp) :: along(2)
    integer :: nx, ny

    nx = size(surface%height, 1)
    ny = size(surface%height, 2)
    along = 0.0_dp
    associate (h => surface%height)
      if (nx > 1) along(1) = sum(((h(2:, :) - h(:nx - 1, :))/surface%spacing_x)**2)/(real(nx - 1, dp)*real(ny, dp))
      if (ny > 1) along(2) = sum(((h(:, 2:) - h(:, :ny - 1))/surface%spacing_y)**2)/(real(nx, dp)*real(ny - 1, dp))
    end associate
    rms = sqrt(sum(along))
  end function rms_slope

end module surface_file
