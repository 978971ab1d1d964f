!> Contact points that two pairs of surfaces have in common.
!>
!> Where a surface is divided, a node on the dividing line belongs to two pairs. If all that lies across from it moves
!> alike, as where nodes of both meshes coincide or the opposite surface is rigid, both have the same row of degrees of
!> freedom, and their forces could be divided in any way: they are one contact point.
module fuge_common_points
  use fuge_contact_pairs_type, only: append_pairs, fuge_contact_pairs
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text
  use fuge_status, only: fuge_info, report, FUGE_WARN_PAIRS
  implicit none
  private

  public :: add_found

  !> Rounding error of gaps as a fraction of the reach.
  real(dp), parameter :: GAP_ROUNDING = 1.0e-12_dp
  !> Rows whose factors, without unit, differ by less than this are the same.
  real(dp), parameter :: SAME = 1.0e-10_dp
  !> Rows are looked up by their smallest degree of freedom with a factor of at least this fraction of the largest one.
  !> The fraction is near 1, so that not all points across from one large face are listed under the same node, and it is
  !> no ratio that occurs in meshes, so that rounding does not change the list.
  real(dp), parameter :: LARGE = 0.917_dp

contains

  !> Add the contact points of one pair; warn of nodes that are those of a pair before too. `stat` is not zero, and
  !> `pairs` as before, without memory.
  subroutine add_found(found, reach, pairs, stat, info)
    type(fuge_contact_pairs), intent(inout) :: found, pairs
    real(dp), intent(in) :: reach
    integer, intent(out) :: stat
    type(fuge_info), intent(inout) :: info
    integer, allocatable :: before(:), common(:)
    type(fuge_contact_pairs) :: all
    integer :: degrees

    degrees = max(found%largest_dof(), pairs%largest_dof())
    call find_common(pairs, found, degrees, GAP_ROUNDING*reach, common, stat)
    if (stat == 0) allocate (before(degrees), stat=stat)
    if (stat /= 0) return
    if (any(common > 0)) then
      all = found
      call found%keep(common == 0, stat)
      if (stat == 0) call append_pairs(pairs, found, stat)
      if (stat /= 0) return
      call merge_common(pairs, all, common)
      call warn_common(pairs, all, common, info)
    else
      call append_pairs(pairs, found, stat)
      if (stat == 0) call warn_repeated(pairs, before, info)
    end if
  end subroutine add_found

  !> The point of `pairs` that is each point of `more` too, 0 if none.
  !>
  !> All zeros if there is one for each of them: then the same surfaces have been paired twice. `rounding`: error of
  !> the gaps; points whose stops contradict each other by more are not the same. `degrees`: the largest degree of
  !> freedom. `stat` as in an allocate statement.
  pure subroutine find_common(pairs, more, degrees, rounding, common, stat)
    type(fuge_contact_pairs), intent(in) :: pairs, more
    integer, intent(in) :: degrees
    real(dp), intent(in) :: rounding
    integer, allocatable, intent(out) :: common(:)
    integer, intent(out) :: stat
    integer, allocatable :: last(:), before(:)
    integer :: i, j, k

    allocate (common(more%points()), before(pairs%points()), last(0:degrees), stat=stat)
    if (stat /= 0) return
    common = 0
    if (pairs%points() < 1) return
    last = 0
    do j = 1, pairs%points()
      k = first_dof(pairs, j)
      before(j) = last(k)
      last(k) = j
    end do
    do i = 1, more%points()
      k = first_dof(more, i)
      if (k == 0) cycle
      j = last(k)
      do while (j > 0)
        if (moves_alike(pairs, j, more, i)) then
          if (merged_play(pairs, j, more, i) >= -rounding) common(i) = j
          exit
        end if
        j = before(j)
      end do
    end do
    if (all(common > 0)) common = 0
  end subroutine find_common

  !> Let the points of `pairs` stand for those of `more` too: the stops are the nearer ones, and the area of a node is
  !> that of all its faces. Then the latter can be left out.
  pure subroutine merge_common(pairs, more, common)
    type(fuge_contact_pairs), intent(inout) :: pairs
    type(fuge_contact_pairs), intent(in) :: more
    integer, intent(in) :: common(:)
    real(dp) :: play
    integer :: i, j

    do i = 1, size(common)
      j = common(i)
      if (j == 0) cycle
      play = max(merged_play(pairs, j, more, i), 0.0_dp)
      pairs%gap(j) = min(pairs%gap(j), more%gap(i))
      pairs%gap_upper(j) = play
      if (pairs%same_node(j, more, i)) pairs%area(j) = pairs%area(j) + more%area(i)
    end do
  end subroutine merge_common

  !> The smallest degree of freedom among those that move a point most; 0 if none does.
  pure function first_dof(pairs, i) result(dof)
    type(fuge_contact_pairs), intent(in) :: pairs
    integer, intent(in) :: i
    integer :: dof

    dof = 0
    associate (mine => pairs%dof(:, i), factor => abs(pairs%normal(:, i)))
      if (any(mine > 0)) dof = minval(mine, mask=mine > 0 .and. factor >= LARGE*maxval(factor))
    end associate
  end function first_dof

  !> Have two points the same row?
  pure function moves_alike(pairs, j, more, i) result(alike)
    type(fuge_contact_pairs), intent(in) :: pairs, more
    integer, intent(in) :: j, i
    logical :: alike

    alike = is_within(pairs%dof(:, j), pairs%normal(:, j), more%dof(:, i), more%normal(:, i))
    if (alike) alike = is_within(more%dof(:, i), more%normal(:, i), pairs%dof(:, j), pairs%normal(:, j))
  end function moves_alike

  !> Are the factors of a row the same in the other one?
  pure function is_within(dof, normal, other_dof, other_normal) result(within)
    integer, intent(in) :: dof(:), other_dof(:)
    real(dp), intent(in) :: normal(:), other_normal(:)
    logical :: within
    integer :: k

    within = .true.
    do k = 1, size(dof)
      if (dof(k) == 0) cycle
      within = abs(normal(k) - sum(other_normal, mask=other_dof == dof(k))) <= SAME
      if (.not. within) return
    end do
  end function is_within

  !> The play between the nearer stops of both points.
  pure function merged_play(pairs, j, more, i) result(play)
    type(fuge_contact_pairs), intent(in) :: pairs, more
    integer, intent(in) :: j, i
    real(dp) :: play

    play = min(pairs%gap_upper(j) - pairs%gap(j), more%gap_upper(i) - more%gap(i)) + min(pairs%gap(j), more%gap(i))
  end function merged_play

  !> Warn of a node that is a contact point of two pairs. `before` is work space, one element for each degree of
  !> freedom.
  pure subroutine warn_repeated(pairs, before, info)
    type(fuge_contact_pairs), intent(in) :: pairs
    integer, intent(inout) :: before(:)
    type(fuge_info), intent(inout) :: info
    integer :: both(2)

    if (pairs%pairs < 2) return
    call pairs%first_repeated(before, both)
    if (both(1) == 0) return
    call report(info, FUGE_WARN_PAIRS, 'node '//index_text(pairs%node(both(2)))//' of the contact surface of pair ' &
                //index_text(pairs%pair(both(2)))//' is a contact point of pair '//index_text(pairs%pair(both(1))) &
                //' too, as node '//index_text(pairs%node(both(1)))//': leave its faces out of one of them, unless ' &
                //'both bodies press on it')
  end subroutine warn_repeated

  !> Warn of a node that is one contact point with that of a pair before.
  pure subroutine warn_common(pairs, more, common, info)
    type(fuge_contact_pairs), intent(in) :: pairs, more
    integer, intent(in) :: common(:)
    type(fuge_info), intent(inout) :: info
    integer :: i

    i = findloc(common > 0, .true., 1)
    call report(info, FUGE_WARN_PAIRS, 'node '//index_text(more%node(i))//' of the contact surface of pair ' &
                //index_text(more%pair(i))//' is a contact point of pair '//index_text(pairs%pair(common(i))) &
                //' too, as node '//index_text(pairs%node(common(i)))//', and moves alike in both: it is listed ' &
                //'once, in the latter, with the area of both')
  end subroutine warn_common

end module fuge_common_points
