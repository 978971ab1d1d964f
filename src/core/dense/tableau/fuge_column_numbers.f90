!> The paper's column numbers, in one place.
!>
!>     1 .. n              forces F_k
!>     n+1 .. 2n           gaps c_k
!>     2n+1 .. 2n+m        motions in the free rigid modes (the paper: m = 1, the approach v_0)
!>     2n+m+1 .. 3n+2m     artificial variables, one for each row
!>
!> A play needs no columns of its own: it is an upper bound of c_k, and F_k is negative there. Nor does a limit, which
!> is an upper bound of F_k.
!>
!> Source: Fischer, Hoyer, Melosh, section 3, Bild 3 and Tabelle 1.
module fuge_column_numbers
  implicit none
  private

  public :: force_column, gap_column, rigid_column, artificial_column
  public :: partner_column, point_of, is_force, is_gap, is_artificial, stored_columns

contains

  !> Column of the force at point k.
  elemental function force_column(k) result(column)
    integer, intent(in) :: k
    integer :: column

    column = k
  end function force_column

  !> Column of the gap at point k of n.
  elemental function gap_column(n, k) result(column)
    integer, intent(in) :: n, k
    integer :: column

    column = n + k
  end function gap_column

  !> Column of the motion in a free mode; the first is v_0 in the paper's problem.
  elemental function rigid_column(n, motion) result(column)
    integer, intent(in) :: n, motion
    integer :: column

    column = 2*n + motion
  end function rigid_column

  !> Column of the artificial variable of a row (n gap rows, then m equilibrium rows).
  elemental function artificial_column(n, m, row) result(column)
    integer, intent(in) :: n, m, row
    integer :: column

    column = stored_columns(n, m) + row
  end function artificial_column

  !> The complementary column: c_k for F_k and F_k for c_k; 0 where there is none.
  elemental function partner_column(n, column) result(partner)
    integer, intent(in) :: n, column
    integer :: partner

    if (column <= n) then
      partner = column + n
    else if (column <= 2*n) then
      partner = column - n
    else
      partner = 0
    end if
  end function partner_column

  elemental function is_force(n, column)
    integer, intent(in) :: n, column
    logical :: is_force

    is_force = column <= n
  end function is_force

  elemental function is_gap(n, column)
    integer, intent(in) :: n, column
    logical :: is_gap

    is_gap = column > n .and. column <= 2*n
  end function is_gap

  !> The point of a force or a gap; 0 for other columns.
  elemental function point_of(n, column) result(point)
    integer, intent(in) :: n, column
    integer :: point

    point = 0
    if (column <= 2*n) point = modulo(column - 1, n) + 1
  end function point_of

  elemental function is_artificial(n, m, column)
    integer, intent(in) :: n, m, column
    logical :: is_artificial

    is_artificial = column > stored_columns(n, m)
  end function is_artificial

  !> Columns that the tableau stores, the right-hand side not counted.
  elemental function stored_columns(n, m) result(columns)
    integer, intent(in) :: n, m
    integer :: columns

    columns = 2*n + m
  end function stored_columns

end module fuge_column_numbers
