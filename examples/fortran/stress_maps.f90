!> Pictures of stresses for the example `stress`: points in rows, and tables of them.
module stress_maps
  use example_output, only: create_file
  use fuge, only: dp => fuge_dp, fuge_field, fuge_info
  implicit none
  private

  public :: in_plane_shear, require, write_halves, write_map

  !> The program's argument that names the folder for the tables.
  integer, parameter, public :: FOLDER_ARGUMENT = 2
  !> The components xx, zz and xz of a tensor.
  integer, parameter, public :: IN_PLANE(3) = [1, 3, 5]

  !> A rectangle of the plane of x and z, from x = left to right and from the surface to z = bottom, as columns x rows
  !> of equal pixels; points are their centres, along x first.
  type, public :: picture
    real(dp) :: left = 0.0_dp, right = 0.0_dp, bottom = 0.0_dp
    integer :: columns = 0, rows = 0
  contains
    procedure :: places
  end type picture

contains

  pure function places(self)
    class(picture), intent(in) :: self
    real(dp) :: places(3, self%columns*self%rows)
    integer :: i, j

    places(1, :) = [((self%left + (self%right - self%left)*(i - 0.5_dp)/self%columns, i=1, self%columns), &
                     j=1, self%rows)]
    places(2, :) = 0.0_dp
    places(3, :) = [((self%bottom*(j - 0.5_dp)/self%rows, i=1, self%columns), j=1, self%rows)]
  end function places

  !> The shear stress in the plane: for x > 0 in the field `right`, for x < 0 the mirror image of that in `left`.
  subroutine write_halves(name, left, right, half)
    character(len=*), intent(in) :: name
    class(fuge_field), intent(in) :: left, right
    type(picture), intent(in) :: half
    real(dp), allocatable :: tensor(:, :), shear(:, :)
    type(fuge_info) :: info

    allocate (tensor(6, half%columns*half%rows), shear(2*half%columns, half%rows))
    call left%stress(half%places(), tensor, info)
    call require(info)
    shear(half%columns:1:-1, :) = reshape(in_plane_shear(tensor(IN_PLANE, :)), [half%columns, half%rows])
    call right%stress(half%places(), tensor, info)
    call require(info)
    shear(half%columns + 1:, :) = reshape(in_plane_shear(tensor(IN_PLANE, :)), [half%columns, half%rows])
    call write_map(name, reshape(shear, [size(shear)]), size(shear, 1))
  end subroutine write_halves

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

  !> Half the difference of the principal stresses in the plane of x and z, from xx, zz, xz of each point.
  pure function in_plane_shear(stress) result(shear)
    real(dp), intent(in) :: stress(:, :)
    real(dp) :: shear(size(stress, 2))

    shear = hypot(0.5_dp*(stress(1, :) - stress(2, :)), stress(3, :))
  end function in_plane_shear

  subroutine require(info)
    type(fuge_info), intent(in) :: info

    if (info%status == 0) return
    print '(a)', trim(info%message)
    error stop 'a step of the example failed'
  end subroutine require

end module stress_maps
