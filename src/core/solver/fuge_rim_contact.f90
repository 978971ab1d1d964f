!> Contact at the rim of a grid beyond which the surface goes on: a remark, because the bodies may end there.
module fuge_rim_contact
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_operator_type, only: fuge_operator
  use fuge_point_space, only: point_space
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
    type(point_space) :: space
    integer, allocatable :: rows(:)
    integer :: cells(2), count, first

    cells = operator%grid()
    if (.not. any(operator%free_rim())) return
    space = operator%ranks()
    call operator%first_rows(0, rows)
    if (space%anywhere(.not. allocated(rows))) return
    associate (me => space%number() + lbound(rows, 1))
      if (space%anywhere(size(force) /= cells(1)*(rows(me + 1) - rows(me)))) return
      call count_rim_points(cells, operator%free_rim(), rows(me), rows(me + 1) - 1, force, count, first)
    end associate
    count = space%total_count(count)
    if (count == 0) return
    if (first == 0) first = huge(first)
    first = int(space%least(real(first, dp)))
    call report(info, info%status, 'the contact reaches the rim of the grid at '//text(count) &
                //' point(s), the first is '//index_text(first) &
                //': if the bodies do not end there, the grid is too small')
  end subroutine remark_contact_at_rim

  !> How many points at the rims of the directions `free` carry force, and the first one; `force` those of the rows
  !> `begin` .. `finish`.
  pure subroutine count_rim_points(cells, free, begin, finish, force, count, first)
    integer, intent(in) :: cells(2), begin, finish
    logical, intent(in) :: free(2)
    real(dp), intent(in) :: force(cells(1), begin:finish)
    integer, intent(out) :: count, first
    integer :: i, j

    count = 0
    first = 0
    do j = begin, finish
      do i = 1, cells(1)
        if (.not. ((free(1) .and. (i == 1 .or. i == cells(1))) .or. (free(2) .and. (j == 1 .or. j == cells(2))))) cycle
        if (.not. abs(force(i, j)) > 0.0_dp) cycle
        count = count + 1
        if (first == 0) first = i + cells(1)*(j - 1)
      end do
    end do
  end subroutine count_rim_points

end module fuge_rim_contact
