!> Loads and supports of a Nastran deck: FORCE, MOMENT, LOAD, SPC, SPC1, SPCADD, SPCD.
module fuge_bulk_loads
  use fuge_bulk_cards, only: bulk_card
  use fuge_kinds, only: dp
  use fuge_number_records, only: number_records
  use fuge_number_text, only: text
  use fuge_text_numbers, only: quoted
  implicit none
  private

  public :: is_unread_load, read_force, read_load_sum, read_node, read_scalar_points, read_support, read_support_list, &
    read_support_sum, read_unread_load

  !> Loads that are not read; a subcase may not select them.
  character(len=8), parameter, public :: UNREAD_LOADS(23) = [character(len=8) :: 'PLOAD', 'PLOAD1', 'PLOAD2', &
    'PLOAD4', 'PLOADB3', 'PLOADX1', 'GRAV', 'ACCEL', 'ACCEL1', 'RFORCE', 'RFORCE1', 'FORCE1', 'FORCE2', 'MOMENT1', &
    'MOMENT2', 'SLOAD', 'DEFORM', 'TEMP', 'TEMPD', 'TEMPRB', 'TEMPP1', 'BOLTLD', 'PRETENS']

contains

  !> GRID: number, systems of position and displacement, and permanent supports; position.
  pure subroutine read_node(card, nodes, reason, status)
    type(bulk_card), intent(in) :: card
    type(number_records), intent(inout) :: nodes
    character(len=:), allocatable, intent(inout) :: reason
    integer, intent(inout) :: status
    real(dp) :: position(3)
    integer :: k, numbers(4)
    logical :: is_new

    call card%whole(1, 'number of the node', 1, numbers(1), reason)
    call card%whole(2, 'CP', 0, numbers(2), reason, default=0)
    do k = 1, 3
      call card%number(k + 2, 'X'//text(k), position(k), reason, default=0.0_dp)
    end do
    call card%whole(6, 'CD', -1, numbers(3), reason, default=0)
    call card%whole(7, 'PS', 0, numbers(4), reason, default=0)
    if (allocated(reason)) return
    call nodes%append_named(card%place, numbers, position, is_new, status)
    if (.not. is_new .and. status == 0) reason = 'the node is defined a second time'
  end subroutine read_node

  !> SPOINT: a record of the first and the last number of each range of scalar points.
  pure subroutine read_scalar_points(card, points, reason, status)
    type(bulk_card), intent(in) :: card
    type(number_records), intent(inout) :: points
    character(len=:), allocatable, intent(inout) :: reason
    integer, intent(inout) :: status
    integer :: k, range(2)

    if (card%word(2) == 'THRU') then
      call card%whole(1, 'ID1', 1, range(1), reason)
      call card%whole(3, 'ID2', 1, range(2), reason)
      call check_range_end(card, 3, reason)
      if (.not. allocated(reason)) call points%append(card%place, range, [real(dp) ::], status)
      return
    end if
    do k = 1, card%count
      if (.not. card%has(k)) cycle
      call card%whole(k, 'scalar point', 1, range(1), reason)
      if (.not. allocated(reason)) call points%append(card%place, [range(1), range(1)], [real(dp) ::], status)
    end do
  end subroutine read_scalar_points

  !> Refuse fields behind the end of a range with THRU, which is field k.
  pure subroutine check_range_end(card, k, reason)
    type(bulk_card), intent(in) :: card
    integer, intent(in) :: k
    character(len=:), allocatable, intent(inout) :: reason
    integer :: i

    do i = k + 1, card%count
      if (card%has(i) .and. .not. allocated(reason)) reason = quoted(trim(card%word(i)))//' stands behind the end of ' &
        //'THRU: write another card'
    end do
  end subroutine check_range_end

  !> FORCE and MOMENT: set, node and first direction, 1 or 4; the components.
  pure subroutine read_force(card, forces, reason, status)
    type(bulk_card), intent(in) :: card
    type(number_records), intent(inout) :: forces
    character(len=:), allocatable, intent(inout) :: reason
    integer, intent(inout) :: status
    real(dp) :: components(3), factor
    integer :: k, node, set, system

    call card%whole(1, 'number of the load set', 1, set, reason)
    call card%whole(2, 'G', 1, node, reason)
    call card%whole(3, 'CID', 0, system, reason, default=0)
    call card%number(4, 'F', factor, reason, default=0.0_dp)
    do k = 1, 3
      call card%number(k + 4, 'N'//text(k), components(k), reason, default=0.0_dp)
    end do
    if (.not. allocated(reason)) then
      if (system /= 0) then
        reason = 'CID = '//text(system)//': only loads in the basic coordinate system, 0, are read'
      else if (abs(factor) > 0.0_dp .and. .not. any(abs(components) > 0.0_dp)) then
        reason = 'the direction N1, N2, N3 has the length zero'
      end if
    end if
    if (.not. allocated(reason)) call forces%append(card%place, [set, node, merge(4, 1, card%name == 'MOMENT')], &
                                                    factor*components, status)
  end subroutine read_force

  !> LOAD: a record of its set and another one for each term; the factor.
  pure subroutine read_load_sum(card, sums, reason, status)
    type(bulk_card), intent(in) :: card
    type(number_records), intent(inout) :: sums
    character(len=:), allocatable, intent(inout) :: reason
    integer, intent(inout) :: status
    real(dp) :: factor, scale
    integer :: k, other, set

    call card%whole(1, 'number of the load set', 1, set, reason)
    call card%number(2, 'S', scale, reason, default=1.0_dp)
    if (.not. allocated(reason) .and. sums%count > 0) then
      if (any(sums%whole(1, :sums%count) == set)) reason = 'the sum is defined a second time'
    end if
    do k = 3, card%count - 1, 2
      if (allocated(reason)) return
      if (.not. (card%has(k) .or. card%has(k + 1))) cycle
      call card%number(k, 'factor of a load set', factor, reason)
      call card%whole(k + 1, 'number of a load set', 1, other, reason)
      if (.not. allocated(reason)) call sums%append(card%place, [set, other], [scale*factor], status)
    end do
  end subroutine read_load_sum

  !> SPC and SPCD: for each of its nodes set, node and directions; the displacement.
  pure subroutine read_support(card, supports, reason, status)
    type(bulk_card), intent(in) :: card
    type(number_records), intent(inout) :: supports
    character(len=:), allocatable, intent(inout) :: reason
    integer, intent(inout) :: status
    real(dp) :: displacement
    integer :: directions, k, node, set

    call card%whole(1, 'number of the set', 1, set, reason)
    do k = 2, 5, 3
      if (k > 2 .and. .not. card%has(k)) exit
      call card%whole(k, 'G', 1, node, reason)
      call read_directions(card%word(k + 1), directions, reason)
      call card%number(k + 2, 'D', displacement, reason, default=0.0_dp)
      if (.not. allocated(reason)) call supports%append(card%place, [set, node, directions], [displacement], status)
    end do
  end subroutine read_support

  !> Directions, such as 123; a blank field is 0, a scalar point.
  pure subroutine read_directions(word, directions, reason)
    character(len=*), intent(in) :: word
    integer, intent(out) :: directions
    character(len=:), allocatable, intent(inout) :: reason
    integer :: k

    directions = 0
    if (allocated(reason) .or. word == '' .or. word == '0') return
    if (verify(trim(word), '123456') > 0 .or. len_trim(word) > 6) then
      reason = quoted(trim(word))//' is no list of directions 1 to 6, such as 123'
      return
    end if
    do k = 1, len_trim(word)
      directions = 10*directions + iachar(word(k:k)) - iachar('0')
    end do
  end subroutine read_directions

  !> SPC1: the same for a list of nodes. Of a range with THRU those that exist count, so that `nodes` have to be known,
  !> or the ranges of scalar `points`, which have no directions.
  pure subroutine read_support_list(card, nodes, points, supports, reason, status)
    type(bulk_card), intent(in) :: card
    type(number_records), intent(in) :: nodes, points
    type(number_records), intent(inout) :: supports
    character(len=:), allocatable, intent(inout) :: reason
    integer, intent(inout) :: status
    integer :: directions, first, k, last, point, set

    call card%whole(1, 'number of the set', 1, set, reason)
    call read_directions(card%word(2), directions, reason)
    if (card%word(4) == 'THRU') then
      call card%whole(3, 'G1', 1, first, reason)
      call card%whole(5, 'G2', 1, last, reason)
      call check_range_end(card, 5, reason)
      if (allocated(reason)) return
      do k = 1, merge(points%count, 0, directions == 0)
        do point = max(first, points%whole(1, k)), min(last, points%whole(2, k))
          call supports%append(card%place, [set, point, directions], [0.0_dp], status)
        end do
      end do
      do k = 1, merge(nodes%count, 0, directions > 0)
        if (nodes%whole(1, k) >= first .and. nodes%whole(1, k) <= last) &
          call supports%append(card%place, [set, nodes%whole(1, k), directions], [0.0_dp], status)
      end do
      return
    end if
    do k = 3, card%count
      if (.not. card%has(k)) cycle
      call card%whole(k, 'node', 1, first, reason)
      if (.not. allocated(reason)) call supports%append(card%place, [set, first, directions], [0.0_dp], status)
    end do
  end subroutine read_support_list

  !> SPCADD: a record of its set and another one for each term.
  pure subroutine read_support_sum(card, sums, reason, status)
    type(bulk_card), intent(in) :: card
    type(number_records), intent(inout) :: sums
    character(len=:), allocatable, intent(inout) :: reason
    integer, intent(inout) :: status
    integer :: k, other, set

    call card%whole(1, 'number of the set', 1, set, reason)
    do k = 2, card%count
      if (.not. card%has(k)) cycle
      call card%whole(k, 'number of a set', 1, other, reason)
      if (.not. allocated(reason)) call sums%append(card%place, [set, other], [real(dp) ::], status)
    end do
  end subroutine read_support_sum

  pure function is_unread_load(name)
    character(len=*), intent(in) :: name
    logical :: is_unread_load

    is_unread_load = any(name == UNREAD_LOADS)
  end function is_unread_load

  !> A load that is not read: its set, and its place in UNREAD_LOADS.
  pure subroutine read_unread_load(card, loads, reason, status)
    type(bulk_card), intent(in) :: card
    type(number_records), intent(inout) :: loads
    character(len=:), allocatable, intent(inout) :: reason
    integer, intent(inout) :: status
    integer :: set

    call card%whole(1, 'number of the load set', 1, set, reason)
    if (.not. allocated(reason)) &
      call loads%append(card%place, [set, findloc(UNREAD_LOADS, card%name, dim=1)], [real(dp) ::], status)
  end subroutine read_unread_load

end module fuge_bulk_loads
