!> Stiffness of straight members in a stiffness matrix of compressed columns, to be taken out where a one-way link has
!> its place.
module fuge_member_stiffness
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_status, only: fuge_info, report, FUGE_ERR_DOF, FUGE_ERR_LAW, FUGE_ERR_NOT_DEFINITE, FUGE_ERR_NOT_FINITE, &
    FUGE_ERR_SIZE
  implicit none
  private

  public :: fuge_remove_member

  !> A diagonal entry may fall below zero by this fraction of what it was: rounding, which makes it zero.
  real(dp), parameter :: ROUNDING = 64.0_dp*epsilon(1.0_dp)

contains

  !> Take the stiffness k h h^T of a member out of a stiffness matrix, so that it does not count twice beside its link.
  !>
  !> `column` (degrees + 1), `row`, `value`: compressed columns from 1, one triangle or both; `dof` degrees of freedom
  !> of the ends, 0 for those that do not move, and `normal`, as many, how far the member gets longer by each: the
  !> direction from the first end to the second at the second, its negative at the first; `stiffness` E A/L > 0, force
  !> per length. Of several members at a node take out the softest first: rounding of a stiffer one hides what is left
  !> of a softer one. Errors, `value` unchanged: FUGE_ERR_SIZE, FUGE_ERR_DOF, FUGE_ERR_NOT_FINITE, FUGE_ERR_LAW for a
  !> stiffness that is not positive; FUGE_ERR_NOT_DEFINITE where the matrix lacks the entries of the member or less than
  !> its stiffness is on the diagonal, so that it cannot be part of it.
  subroutine fuge_remove_member(column, row, value, dof, normal, stiffness, info)
    integer, intent(in) :: column(:), row(:)
    real(dp), intent(inout) :: value(:)
    integer, intent(in) :: dof(:)
    real(dp), intent(in) :: normal(:), stiffness
    type(fuge_info), intent(out) :: info
    integer :: i, j

    if (size(column) < 1 .or. size(row) /= size(value)) then
      call report(info, FUGE_ERR_SIZE, 'row has '//text(size(row))//' and value '//text(size(value)) &
                  //' entries, column '//text(size(column))//' value(s)')
    else if (column(1) /= 1 .or. column(size(column)) - 1 > size(row) &
             .or. any(column(2:) < column(:size(column) - 1))) then
      call report(info, FUGE_ERR_SIZE, 'column has to ascend from 1 to at most the number of entries and one more')
    else if (size(dof) /= size(normal)) then
      call report(info, FUGE_ERR_SIZE, 'dof has '//text(size(dof))//' and normal '//text(size(normal))//' value(s)')
    else if (any(dof < 0) .or. any(dof > size(column) - 1)) then
      call report(info, FUGE_ERR_DOF, 'dof reaches from '//text(minval(dof))//' to '//text(maxval(dof)) &
                  //': the matrix has '//text(size(column) - 1)//' degrees of freedom')
    else if (.not. (ieee_is_finite(stiffness) .and. all(ieee_is_finite(normal)))) then
      call report(info, FUGE_ERR_NOT_FINITE, 'the stiffness of the member or its normal is not finite')
    else if (.not. stiffness > 0.0_dp) then
      call report(info, FUGE_ERR_LAW, 'the stiffness of the member is '//text(stiffness)//': it has to be positive')
    end if
    if (info%failed()) return
    do j = 1, size(dof)
      do i = 1, size(dof)
        if (counts(i, j)) call check_entry(dof(i), dof(j), stiffness*normal(i)*normal(j), info)
        if (info%failed()) return
      end do
    end do
    do j = 1, size(dof)
      do i = 1, size(dof)
        if (counts(i, j)) call take_out(dof(i), dof(j), stiffness*normal(i)*normal(j))
      end do
    end do

  contains

    !> Has the member an entry here?
    pure function counts(a, b)
      integer, intent(in) :: a, b
      logical :: counts

      counts = dof(a) > 0 .and. dof(b) > 0
      if (counts) counts = abs(normal(a)*normal(b)) > 0.0_dp
    end function counts

    !> Refuse an entry that cannot contain `part`. Off the diagonal one of both triangles may be without entries.
    subroutine check_entry(a, b, part, info)
      integer, intent(in) :: a, b
      real(dp), intent(in) :: part
      type(fuge_info), intent(inout) :: info
      real(dp) :: entry

      if (place_of(a, b) < 1 .and. place_of(b, a) < 1) then
        call report(info, FUGE_ERR_NOT_DEFINITE, 'the matrix has no entry at degrees of freedom '//index_text(a) &
                    //' and '//index_text(b)//': it does not contain the member')
      else if (a == b) then
        entry = sum(value(column(b):column(b + 1) - 1), mask=row(column(b):column(b + 1) - 1) == a)
        if (entry - part < -ROUNDING*entry) call report(info, FUGE_ERR_NOT_DEFINITE, 'the stiffness of degree of ' &
          //'freedom '//index_text(a)//' is '//text(entry)//', less than the '//text(part)//' of the member: the ' &
          //'matrix does not contain it')
      end if
    end subroutine check_entry

    !> Subtract `part` from an entry, if this triangle has it. Repeated entries become one, because what remains is
    !> rounding only in comparison with their sum.
    subroutine take_out(a, b, part)
      integer, intent(in) :: a, b
      real(dp), intent(in) :: part
      real(dp) :: before, rest
      integer :: k

      k = place_of(a, b)
      if (k < 1) return
      associate (rows => row(column(b):column(b + 1) - 1), values => value(column(b):column(b + 1) - 1))
        before = sum(values, mask=rows == a)
        where (rows == a) values = 0.0_dp
      end associate
      rest = before - part
      if (abs(rest) <= ROUNDING*abs(before)) rest = 0.0_dp
      value(k) = rest
    end subroutine take_out

    !> Where the first entry of row `a` and column `b` is; 0 if there is none.
    pure function place_of(a, b) result(k)
      integer, intent(in) :: a, b
      integer :: k

      do k = column(b), column(b + 1) - 1
        if (row(k) == a) return
      end do
      k = 0
    end function place_of

  end subroutine fuge_remove_member

end module fuge_member_stiffness
