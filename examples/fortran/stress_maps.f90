!> Pictures of stresses for the example `stress`: points in rows, and tables of them.
module stress_maps
  use example_output, only: create_file
  use fuge, only: dp => fuge_dp, fuge_info
  implicit none
  private

  public :: in_plane_shear, require, write_map

  !> The program's argument that names the folder for the tables.
  integer, parameter, public :: FOLDER_ARGUMENT = 2

  !> A rectangle of the plane of x and z, from x = left to right and from the surface to z = bottom, as columns x rows
  !> of equal pixels; points are their centres, along x first.
  type, public :: picture
    real(dp) :: left = 0.0_dp, right = 0.0_dp, bottom = 0.0_dp
    integer :: columns = 0, rows = 0
  contains
    procedure :: x
    procedure :: z
  end type picture

contains

  pure function x(self)
    class(picture), intent(in) :: self
    real(dp) :: x(self%columns*self%rows)
    integer :: i, j

    x = [((self%left + (self%right - self%left)*(i - 0.5_dp)/self%columns, i=1, self%columns), j=1, self%rows)]
  end function x

  pure function z(self)
    class(picture), intent(in) :: self
    real(dp) :: z(self%columns*self%rows)
    integer :: i, j

    z = [((self%bottom*(j - 0.5_dp)/self%rows, i=1, self%columns), j=1, self%rows)]
  end function z

  !> A row of numbers for each row of pixels, from the surface down.
  subroutine write_map(name, values, columns)
    character(len=*), intent(in) :: name
    real(dp), intent(in) :: values(:)
    integer, intent(in) :: columns
    integer :: file, j

    call create_file(name, FOLDER_ARGUMENT, file)
    do j = 0, size(values)/columns - 1
      write (file, '(*(es11.4,1x))') values(j*columns + 1:(j + 1)*columns)
    end do
    close (file)
  end subroutine write_map

  !> Half the difference of the principal stresses in the plane of x and z, from xx, zz, xz.
  elemental function in_plane_shear(xx, zz, xz) result(shear)
    real(dp), intent(in) :: xx, zz, xz
    real(dp) :: shear

    shear = hypot(0.5_dp*(xx - zz), xz)
  end function in_plane_shear

  subroutine require(info)
    type(fuge_info), intent(in) :: info

    if (info%status == 0) return
    print '(a)', trim(info%message)
    error stop 'a step of the example failed'
  end subroutine require

end module stress_maps
