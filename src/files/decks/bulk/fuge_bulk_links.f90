!> One-way elements of a Nastran deck: gaps, CGAP with PGAP, and springs with a table, CBUSH1D with PBUSH1D and TABLED1.
module fuge_bulk_links
  use fuge_bulk_cards, only: bulk_card
  use fuge_deck_type, only: fuge_deck_link, new_link
  use fuge_force_tables, only: find_one_way_law, one_way_law
  use fuge_kinds, only: dp
  use fuge_link_direction, only: direction_between, COINCIDENT
  use fuge_number_records, only: number_records
  use fuge_number_text, only: text
  implicit none
  private

  public :: find_table, make_gap, make_spring, needs_positions, read_gap, read_gap_property, read_spring, &
    read_spring_property, read_system, read_table

  !> Fraction of the stiffness of a closed gap that may remain in an open one: it stands for none.
  real(dp), parameter :: OPEN_STIFFNESS = 1.0e-6_dp
  !> CID of a card: blank, and FLIP.
  integer, parameter :: NO_SYSTEM = -1, FLIPPED = -2
  !> U0 = AUTO.
  integer, parameter :: DISTANCE_OF_NODES = 1
  !> Fields of a line.
  integer, parameter :: LINE_FIELDS = 8

contains

  !> CGAP: number, property, nodes a and b, coordinate system.
  pure subroutine read_gap(card, gaps, reason, status)
    type(bulk_card), intent(in) :: card
    type(number_records), intent(inout) :: gaps
    character(len=:), allocatable, intent(inout) :: reason
    integer, intent(inout) :: status
    integer :: numbers(5)
    logical :: is_new

    call card%whole(1, 'number of the element', 1, numbers(1), reason)
    call card%whole(2, 'PID', 1, numbers(2), reason, default=numbers(1))
    call card%whole(3, 'GA', 1, numbers(3), reason)
    call card%whole(4, 'GB', 1, numbers(4), reason)
    if (card%word(8) == 'FLIP') then
      numbers(5) = FLIPPED
    else
      call card%whole(8, 'CID', 0, numbers(5), reason, default=NO_SYSTEM)
    end if
    if (.not. allocated(reason) .and. numbers(3) == numbers(4)) reason = 'GA and GB are the same node'
    if (allocated(reason)) return
    call gaps%append_named(card%place, numbers, [real(dp) ::], is_new, status)
    if (.not. is_new .and. status == 0) reason = 'the element is defined a second time'
  end subroutine read_gap

  !> PGAP: number, gap, and stiffness of the closed gap (0: rigid). Friction, preload and the stiffness of an open gap
  !> are refused. What adjusts penalties, on the second line, has no meaning here.
  pure subroutine read_gap_property(card, properties, reason, status)
    type(bulk_card), intent(in) :: card
    type(number_records), intent(inout) :: properties
    character(len=:), allocatable, intent(inout) :: reason
    integer, intent(inout) :: status
    real(dp) :: closed, gap, open, preload
    integer :: automatic, number
    logical :: is_new

    call card%whole(1, 'number of the property', 1, number, reason)
    automatic = merge(DISTANCE_OF_NODES, 0, card%word(2) == 'AUTO')
    gap = 0.0_dp
    if (automatic == 0) call card%number(2, 'U0', gap, reason, default=0.0_dp)
    call card%number(3, 'F0', preload, reason, default=0.0_dp)
    closed = 0.0_dp
    if (all(card%word(4) /= ['AUTO', 'SOFT', 'HARD'])) call card%number(4, 'KA', closed, reason, default=0.0_dp)
    call card%number(5, 'KB', open, reason, default=0.0_dp)
    if (allocated(reason)) return
    if (abs(preload) > 0.0_dp) then
      reason = 'the preload F0 is not read: an initial interference, U0 = -F0/KA, has the same force'
    else if (closed < 0.0_dp) then
      reason = 'KA is negative: a stiffness is needed, or a blank field for a rigid gap'
    else if (abs(open) > OPEN_STIFFNESS*closed) then
      reason = 'KB, the stiffness of the open gap, is above '//text(OPEN_STIFFNESS)//' KA: make it a spring of its ' &
        //'own, so that it is in the stiffness matrix'
    else
      call refuse_friction(card, reason)
    end if
    if (allocated(reason)) return
    call properties%append_named(card%place, [number, automatic], [gap, closed], is_new, status)
    if (.not. is_new .and. status == 0) reason = 'the property is defined a second time'
  end subroutine read_gap_property

  !> Refuse KT, MU1 and MU2 of PGAP other than zero.
  pure subroutine refuse_friction(card, reason)
    type(bulk_card), intent(in) :: card
    character(len=:), allocatable, intent(inout) :: reason
    character(len=3), parameter :: NAMES(6:8) = ['KT ', 'MU1', 'MU2']
    real(dp) :: value
    integer :: k

    do k = 6, 8
      if (card%word(k) == 'AUTO' .or. card%word(k) == 'STICK' .or. card%word(k) == 'FREEZE') then
        value = 1.0_dp
      else
        call card%number(k, trim(NAMES(k)), value, reason, default=0.0_dp)
      end if
      if (allocated(reason)) return
      if (abs(value) > 0.0_dp) then
        reason = trim(NAMES(k))//' is not zero: fuge has no friction, a closed gap slides freely'
        return
      end if
    end do
  end subroutine refuse_friction

  !> CORD2R: number, reference system, and its points A, B, C.
  pure subroutine read_system(card, systems, reason, status)
    type(bulk_card), intent(in) :: card
    type(number_records), intent(inout) :: systems
    character(len=:), allocatable, intent(inout) :: reason
    integer, intent(inout) :: status
    real(dp) :: points(9)
    integer :: k, numbers(2)
    logical :: is_new

    call card%whole(1, 'number of the system', 1, numbers(1), reason)
    call card%whole(2, 'RID', 0, numbers(2), reason, default=0)
    do k = 1, size(points)
      call card%number(k + 2, 'coordinate', points(k), reason, default=0.0_dp)
    end do
    if (allocated(reason)) return
    call systems%append_named(card%place, numbers, points, is_new, status)
    if (.not. is_new .and. status == 0) reason = 'the coordinate system is defined a second time'
  end subroutine read_system

  !> CBUSH1D: number, property, nodes a and b (0: the ground), coordinate system.
  pure subroutine read_spring(card, springs, reason, status)
    type(bulk_card), intent(in) :: card
    type(number_records), intent(inout) :: springs
    character(len=:), allocatable, intent(inout) :: reason
    integer, intent(inout) :: status
    integer :: numbers(5)
    logical :: is_new

    call card%whole(1, 'number of the element', 1, numbers(1), reason)
    call card%whole(2, 'PID', 1, numbers(2), reason, default=numbers(1))
    call card%whole(3, 'GA', 1, numbers(3), reason)
    call card%whole(4, 'GB', 0, numbers(4), reason, default=0)
    call card%whole(5, 'CID', 0, numbers(5), reason, default=NO_SYSTEM)
    if (allocated(reason)) return
    call springs%append_named(card%place, numbers, [real(dp) ::], is_new, status)
    if (.not. is_new .and. status == 0) reason = 'the element is defined a second time'
  end subroutine read_spring

  !> PBUSH1D: number, and number of the table of its force (0: the spring is linear). Each continuation begins with the
  !> name of what it gives.
  pure subroutine read_spring_property(card, properties, reason, status)
    type(bulk_card), intent(in) :: card
    type(number_records), intent(inout) :: properties
    character(len=:), allocatable, intent(inout) :: reason
    integer, intent(inout) :: status
    integer :: k, number, table
    logical :: is_new

    call card%whole(1, 'number of the property', 1, number, reason)
    table = 0
    do k = LINE_FIELDS + 1, card%count, LINE_FIELDS
      if (card%word(k) == 'DAMPER' .or. card%word(k) == '') cycle
      if (card%word(k) /= 'SPRING' .or. card%word(k + 1) == 'EQUAT') then
        if (.not. allocated(reason)) reason = trim(card%word(k))//' '//trim(card%word(k + 1))//' is not read: the ' &
          //'force of a one-way spring is given by SPRING, TABLE and a TABLED1'
      else if (card%word(k + 1) == 'TABLE') then
        call card%whole(k + 2, 'number of the table', 1, table, reason)
      else
        call card%whole(k + 1, 'number of the table', 1, table, reason)
      end if
    end do
    if (allocated(reason)) return
    call properties%append_named(card%place, [number, table], [real(dp) ::], is_new, status)
    if (.not. is_new .and. status == 0) reason = 'the property is defined a second time'
  end subroutine read_spring_property

  !> TABLED1: a record of number, x and y for each point.
  pure subroutine read_table(card, tables, reason, status)
    type(bulk_card), intent(in) :: card
    type(number_records), intent(inout) :: tables
    character(len=:), allocatable, intent(inout) :: reason
    integer, intent(inout) :: status
    real(dp) :: x, y
    integer :: k, number

    call card%whole(1, 'number of the table', 1, number, reason)
    if (.not. allocated(reason) .and. (card%word(2) == 'LOG' .or. card%word(3) == 'LOG')) &
      reason = 'a logarithmic axis is not read'
    if (.not. allocated(reason) .and. card%has(4) .and. card%word(4) /= '0') &
      reason = 'field 4 is '//trim(card%word(4))//': tables go on as their last lines beyond their ends, with 0 there'
    do k = LINE_FIELDS + 1, card%count - 1, 2
      if (allocated(reason) .or. card%word(k) == 'ENDT' .or. card%word(k + 1) == 'ENDT') exit
      if (card%word(k) == 'SKIP' .or. card%word(k + 1) == 'SKIP' .or. .not. (card%has(k) .or. card%has(k + 1))) cycle
      call card%number(k, 'x', x, reason)
      call card%number(k + 1, 'y', y, reason)
      if (.not. allocated(reason)) call tables%append(card%place, [number], [x, y], status)
    end do
  end subroutine read_table

  !> The x axis of a coordinate system, of which the basic one is 0.
  pure subroutine find_axis(system, systems, axis, reason)
    integer, intent(in) :: system
    type(number_records), intent(in) :: systems
    real(dp), intent(out) :: axis(3)
    character(len=:), allocatable, intent(inout) :: reason
    real(dp) :: z(3)
    integer :: k

    axis = [1.0_dp, 0.0_dp, 0.0_dp]
    if (system == 0 .or. allocated(reason)) return
    k = systems%find(system)
    if (k == 0) then
      reason = 'CID = '//text(system)//' is no CORD2R of the deck: other coordinate systems are not read'
    else if (systems%whole(2, k) /= 0) then
      reason = 'the coordinate system CID = '//text(system)//' has another reference system than 0, which is not read'
    else
      call direction_between(systems%value(1:3, k), systems%value(4:6, k), z, reason)
      if (.not. allocated(reason)) call direction_between(systems%value(1:3, k), systems%value(7:9, k), axis, reason)
      axis = axis - dot_product(axis, z)*z
      if (.not. allocated(reason) .and. .not. norm2(axis) > COINCIDENT) reason = 'its three points are on one line'
      if (allocated(reason)) reason = 'the coordinate system CID = '//text(system)//': '//reason
      if (.not. allocated(reason)) axis = axis/norm2(axis)
    end if
  end subroutine find_axis

  !> The direction of an element from node a to b: the x axis of its coordinate system if it names one.
  pure subroutine find_direction(system, systems, position, direction, reason)
    integer, intent(in) :: system
    type(number_records), intent(in) :: systems
    real(dp), intent(in) :: position(3, 2)
    real(dp), intent(out) :: direction(3)
    character(len=:), allocatable, intent(inout) :: reason

    if (system >= 0) then
      call find_axis(system, systems, direction, reason)
    else
      call direction_between(position(:, 1), position(:, 2), direction, reason)
      if (allocated(reason)) reason = reason//': CID must name the coordinate system whose x axis it follows'
      if (system == FLIPPED) direction = -direction
    end if
  end subroutine find_direction

  !> Does the direction of gap `k`, or its gap, depend on the positions of its nodes?
  pure function needs_positions(k, gaps, properties)
    integer, intent(in) :: k
    type(number_records), intent(in) :: gaps, properties
    logical :: needs_positions
    integer :: p

    needs_positions = gaps%whole(5, k) < 0
    p = properties%find(gaps%whole(2, k))
    if (p > 0) needs_positions = needs_positions .or. properties%whole(2, p) == DISTANCE_OF_NODES
  end function needs_positions

  !> The link of gap `k`, whose nodes are at `position` (3, 2).
  pure subroutine make_gap(k, gaps, properties, systems, position, link, reason)
    integer, intent(in) :: k
    type(number_records), intent(in) :: gaps, properties, systems
    real(dp), intent(in) :: position(3, 2)
    type(fuge_deck_link), intent(out) :: link
    character(len=:), allocatable, intent(inout) :: reason
    real(dp) :: direction(3), gap
    integer :: p

    if (allocated(reason)) return
    p = properties%find(gaps%whole(2, k))
    if (p == 0) then
      reason = 'the deck has no PGAP '//text(gaps%whole(2, k))
      return
    end if
    call find_direction(gaps%whole(5, k), systems, position, direction, reason)
    gap = properties%value(1, p)
    if (properties%whole(2, p) == DISTANCE_OF_NODES) gap = abs(dot_product(direction, position(:, 2) - position(:, 1)))
    link = new_link('CGAP '//text(gaps%whole(1, k)), gaps%whole(3, k), gaps%whole(4, k), direction, gap)
    if (properties%value(2, p) > 0.0_dp) link%compliance = 1.0_dp/properties%value(2, p)
  end subroutine make_gap

  !> The table of spring `k`, 0 of a linear one, which is part of the stiffness matrix.
  pure subroutine find_table(k, springs, properties, table, reason)
    integer, intent(in) :: k
    type(number_records), intent(in) :: springs, properties
    integer, intent(out) :: table
    character(len=:), allocatable, intent(inout) :: reason
    integer :: p

    table = 0
    p = properties%find(springs%whole(2, k))
    if (p > 0) then
      table = properties%whole(2, p)
    else if (.not. allocated(reason)) then
      reason = 'the deck has no PBUSH1D '//text(springs%whole(2, k))
    end if
  end subroutine find_table

  !> The link of spring `k`, whose nodes are at `position` (3, 2), by its table.
  pure subroutine make_spring(k, table, springs, tables, systems, position, link, reason)
    integer, intent(in) :: k, table
    type(number_records), intent(in) :: springs, tables, systems
    real(dp), intent(in) :: position(3, 2)
    type(fuge_deck_link), intent(out) :: link
    character(len=:), allocatable, intent(inout) :: reason
    type(one_way_law) :: law
    real(dp) :: direction(3)
    integer :: first, points

    points = 0
    if (tables%count > 0) points = count(tables%whole(1, :tables%count) == table)
    if (points == 0) then
      reason = 'the deck has no TABLED1 '//text(table)
      return
    end if
    first = findloc(tables%whole(1, :tables%count), table, dim=1)
    call find_one_way_law(tables%value(1, first:first + points - 1), tables%value(2, first:first + points - 1), law, &
                          reason)
    if (allocated(reason)) then
      reason = 'TABLED1 '//text(table)//': '//reason
    else if (springs%whole(4, k) == 0 .and. springs%whole(5, k) == NO_SYSTEM) then
      reason = 'a spring to the ground needs CID, whose x axis it follows'
    end if
    if (allocated(reason)) return
    call find_direction(springs%whole(5, k), systems, position, direction, reason)
    if (law%tension) direction = -direction
    link = new_link('CBUSH1D '//text(springs%whole(1, k)), springs%whole(3, k), springs%whole(4, k), direction, law%gap)
    link%compliance = law%compliance
    link%limit = law%limit
  end subroutine make_spring

end module fuge_bulk_links
