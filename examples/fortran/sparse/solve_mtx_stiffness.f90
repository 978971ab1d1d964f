!> The stiffness matrix of the example `solve_mtx` as compressed columns.
module solve_mtx_stiffness
  use fuge, only: dp => fuge_dp, fuge_info, fuge_read_sparse
  use fuge_sparse, only: fuge_sparse_stiffness
  use solve_mtx_files, only: refuse_size
  implicit none
  private

  type, public :: stored_stiffness
    type(fuge_sparse_stiffness) :: stiffness
  contains
    procedure :: read => read_stiffness
  end type stored_stiffness

contains

  subroutine read_stiffness(self, path, info)
    class(stored_stiffness), intent(inout) :: self
    character(len=*), intent(in) :: path
    type(fuge_info), intent(out) :: info
    integer, allocatable :: column(:), row(:)
    real(dp), allocatable :: value(:)
    integer :: rows

    call fuge_read_sparse(path, rows, column, row, value, info)
    if (info%failed()) return
    if (rows /= size(column) - 1 .or. rows == 0) then
      call refuse_size(path, [rows, size(column) - 1], 'a square one is needed', info)
    else
      call self%stiffness%set(column, row, value, info)
    end if
  end subroutine read_stiffness

end module solve_mtx_stiffness
