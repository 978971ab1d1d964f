!> How stiffness matrices are stored where the library has no sparse component.
module chosen_stiffness
  use fuge, only: dp => fuge_dp, fuge_dense_stiffness, fuge_info, FUGE_ERR_MEMORY
  implicit none
  private

  !> What `fuge --version` says.
  character(len=*), parameter, public :: STORAGE = 'stiffness matrices: dense, built without CHOLMOD'

  type, public :: stored_stiffness
    type(fuge_dense_stiffness) :: stiffness
    real(dp), allocatable, private :: matrix(:, :)
  contains
    procedure :: set
  end type stored_stiffness

contains

  !> From compressed columns with both triangles.
  subroutine set(self, column, row, value, info)
    class(stored_stiffness), intent(inout), target :: self
    integer, intent(in) :: column(:), row(:)
    real(dp), intent(in) :: value(:)
    type(fuge_info), intent(out) :: info
    character(len=12) :: degrees
    integer :: j, k, status

    allocate (self%matrix(size(column) - 1, size(column) - 1), stat=status)
    if (status /= 0) then
      write (degrees, '(i0)') size(column) - 1
      info%status = FUGE_ERR_MEMORY
      info%message = 'no memory for a dense stiffness matrix of '//trim(degrees)//' degrees of freedom: build fuge ' &
        //'with CHOLMOD'
      return
    end if
    self%matrix = 0.0_dp
    do j = 1, size(column) - 1
      do k = column(j), column(j + 1) - 1
        self%matrix(row(k), j) = self%matrix(row(k), j) + value(k)
      end do
    end do
    call self%stiffness%set(self%matrix, info)
  end subroutine set

end module chosen_stiffness
