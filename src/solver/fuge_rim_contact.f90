!> Contact at the rim of a grid beyond which the surface goes on: a remark, because the bodies may end there.
module fuge_rim_contact
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_operator_type, only: fuge_operator
  use fuge_status, only: fuge_info, report
  implicit none
  private

  public :: remark_contact_at_rim

contains

  !> Add a message to `info`, whose status stays as it is, if a point at a free rim of the grid carries force;
  !> `force` (n).
  subroutine remark_contact_at_rim(operator, force, info)
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: force(:)
    type(fuge_info), intent(inout) :: info
    integer :: cells(2), count, first

    cells = operator%grid()
    if (.not. any(operator%free_rim()) .or. size(force) /= product(cells)) return
    call count_rim_points(cells, operator%free_rim(), force, count, first)
    if (count == 0) return
    call report(info, info%status, 'the contact reaches the rim of the grid at '//text(count) &
                //' point(s), the first is '//index_text(first)//': if the bodies do not end there, the grid is too small')
  end subroutine remark_contact_at_rim

  !> How many points at the rims of the directions `free` carry force, and the first one.
  pure subroutine count_rim_points(cells, free, force, count, first)
    integer, intent(in) :: cells(2)
    logical, intent(in) :: free(2)
    real(dp), intent(in) :: force(cells(1), cells(2))
    integer, intent(out) :: count, first
    integer :: i, j

    count = 0
    first = 0
    do j = 1, cells(2)
      do i = 1, cells(1)
        if (.not. ((free(1) .and. (i == 1 .or. i == cells(1))) .or. (free(2) .and. (j == 1 .or. j == cells(2))))) cycle
        if (.not. abs(force(i, j)) > 0.0_dp) cycle
        count = count + 1
        if (first == 0) first = i + cells(1)*(j - 1)
      end do
    end do
  end subroutine count_rim_points

end module fuge_rim_contact
