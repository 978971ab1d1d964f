!> Paths of several files in one text, each ended by achar(0).
module fuge_path_list
  implicit none
  private

  public :: count_paths, get_path

contains

  !> Number of paths in a list.
  pure function count_paths(paths) result(n)
    character(len=*), intent(in) :: paths
    integer :: n
    integer :: k

    n = 0
    do k = 1, len(paths)
      if (paths(k:k) == achar(0)) n = n + 1
    end do
  end function count_paths

  !> Path number k of a list; empty if there are fewer.
  pure subroutine get_path(paths, k, path)
    character(len=*), intent(in) :: paths
    integer, intent(in) :: k
    character(len=:), allocatable, intent(out) :: path
    integer :: begin, i

    begin = 1
    do i = 2, k
      begin = begin + index(paths(begin:), achar(0))
    end do
    path = paths(begin:begin + index(paths(begin:), achar(0)) - 2)
  end subroutine get_path

end module fuge_path_list
