!> Decks of Nastran and its kin: one-way elements, load sets, supports and subcases.
module fuge_bulk_deck
  use fuge_bulk_cards, only: bulk_card, card_reader, next_card
  use fuge_bulk_cases, only: bulk_conditions, make_cases, refusal
  use fuge_bulk_links, only: find_table, make_gap, make_spring, needs_positions, read_gap, read_gap_property, &
    read_spring, read_spring_property, read_system, read_table
  use fuge_bulk_loads, only: is_unread_load, read_force, read_load_sum, read_node, read_scalar_points, read_support, &
    read_support_list, read_support_sum, read_unread_load
  use fuge_case_control, only: read_case_control
  use fuge_deck_type, only: fuge_deck, fuge_deck_link, place_text
  use fuge_kinds, only: dp
  use fuge_number_records, only: number_records
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_ERR_FILE, FUGE_ERR_MEMORY
  implicit none
  private

  public :: read_bulk_deck

  !> Cards that mean contact, or springs that are not linear, in a way that is not read.
  character(len=8), parameter :: REFUSED(12) = [character(len=8) :: 'PBUSHT', 'PELAST', 'NLRGAP', 'CGAPG', 'CONTACT', &
    'BCONTACT', 'BCTABLE', 'BCTABL1', 'BCTSET', 'BCONP', 'BLSEG', 'BGSET']

  !> All that the cards say.
  type :: bulk_model
    type(bulk_conditions) :: conditions
    type(number_records) :: gaps, gap_properties, springs, spring_properties, tables, systems
  end type bulk_model

contains

  !> Read a deck. Errors, `deck` unfinished: FUGE_ERR_FILE, with file, line, card and reason; FUGE_ERR_MEMORY.
  subroutine read_bulk_deck(path, deck, info)
    character(len=*), intent(in) :: path
    type(fuge_deck), intent(inout) :: deck
    type(fuge_info), intent(inout) :: info
    type(card_reader) :: reader
    type(bulk_model) :: model
    type(refusal) :: refused
    character(len=:), allocatable :: place

    call reader%deck%open(path, info)
    if (.not. info%failed()) call read_case_control(reader%deck, model%conditions%subcases, info)
    if (.not. info%failed()) call read_cards(reader, model, info)
    if (info%failed()) return
    deck%paths = reader%deck%paths
    model%conditions%paths = deck%paths
    call make_links(model, deck, refused)
    if (.not. allocated(refused%reason) .and. refused%status == 0) call make_cases(model%conditions, deck, refused)
    if (refused%status /= 0) then
      call report(info, FUGE_ERR_MEMORY, reader%deck%file(1)%name//': no memory for the deck')
    else if (allocated(refused%reason)) then
      call place_text(deck%paths, refused%place(1), refused%place(2), place)
      if (place == '') place = reader%deck%file(1)%name
      call report(info, FUGE_ERR_FILE, place//': '//refused%reason)
    end if
  end subroutine read_bulk_deck

  !> Read all cards. SPC1 with THRU names nodes that may follow, so that these cards are read twice.
  subroutine read_cards(reader, model, info)
    type(card_reader), intent(inout) :: reader
    type(bulk_model), intent(inout) :: model
    type(fuge_info), intent(inout) :: info
    type(bulk_card) :: card
    type(bulk_card), allocatable :: ranges(:)
    character(len=:), allocatable :: place, reason
    integer :: k, n, status

    allocate (ranges(0))
    n = 0
    status = 0
    do
      call next_card(reader, card, info)
      if (info%failed() .or. card%name == '') exit
      if (card%name == 'SPC1' .and. card%word(4) == 'THRU') then
        call keep_card(card, n, ranges, status)
      else
        call read_card(card, model, reason, status)
      end if
      if (status /= 0) call report(info, FUGE_ERR_MEMORY, reader%deck%file(1)%name//': no memory for its cards')
      if (allocated(reason) .or. status /= 0) exit
    end do
    do k = 1, n
      if (info%failed() .or. allocated(reason)) exit
      call read_support_list(ranges(k), model%conditions%nodes, model%conditions%scalar_points, &
                             model%conditions%supports, reason, status)
      if (allocated(reason)) card = ranges(k)
    end do
    if (info%failed() .or. .not. allocated(reason)) return
    call place_text(reader%deck%paths, card%place(1), card%place(2), place)
    call report(info, FUGE_ERR_FILE, place//', '//trim(card%name)//' '//trim(card%word(1))//': '//reason)
  end subroutine read_cards

  !> Add a copy of a card to the first `count` of a list.
  pure subroutine keep_card(card, count, list, status)
    type(bulk_card), intent(in) :: card
    integer, intent(inout) :: count, status
    type(bulk_card), allocatable, intent(inout) :: list(:)
    type(bulk_card), allocatable :: longer(:)

    if (status /= 0) return
    if (count == size(list)) then
      allocate (longer(2*count + 8), stat=status)
      if (status /= 0) return
      longer(:count) = list
      call move_alloc(longer, list)
    end if
    count = count + 1
    list(count) = card
  end subroutine keep_card

  !> What a card says; others are ignored.
  pure subroutine read_card(card, model, reason, status)
    type(bulk_card), intent(in) :: card
    type(bulk_model), intent(inout) :: model
    character(len=:), allocatable, intent(inout) :: reason
    integer, intent(inout) :: status

    select case (card%name)
    case ('GRID')
      call read_node(card, model%conditions%nodes, reason, status)
    case ('SPOINT')
      call read_scalar_points(card, model%conditions%scalar_points, reason, status)
    case ('CGAP')
      call read_gap(card, model%gaps, reason, status)
    case ('PGAP')
      call read_gap_property(card, model%gap_properties, reason, status)
    case ('CORD2R')
      call read_system(card, model%systems, reason, status)
    case ('CBUSH1D')
      call read_spring(card, model%springs, reason, status)
    case ('PBUSH1D')
      call read_spring_property(card, model%spring_properties, reason, status)
    case ('TABLED1')
      call read_table(card, model%tables, reason, status)
    case ('FORCE', 'MOMENT')
      call read_force(card, model%conditions%forces, reason, status)
    case ('LOAD')
      call read_load_sum(card, model%conditions%load_sums, reason, status)
    case ('SPC')
      call read_support(card, model%conditions%supports, reason, status)
    case ('SPCD')
      call read_support(card, model%conditions%displacements, reason, status)
    case ('SPC1')
      call read_support_list(card, model%conditions%nodes, model%conditions%scalar_points, &
                             model%conditions%supports, reason, status)
    case ('SPCADD')
      call read_support_sum(card, model%conditions%support_sums, reason, status)
    case ('GRDSET')
      if (card%has(2) .or. card%has(6) .or. card%has(7)) reason = 'defaults of CP, CD and PS are not read: write ' &
        //'them on each GRID'
    case ('MATS1')
      if (card%word(3) == 'NLELAST') reason = 'materials that depend on the strain are not read: give cables and ' &
        //'struts as CBUSH1D with a table'
    case default
      if (any(card%name == REFUSED)) then
        reason = 'contact and springs of this kind are not read: CGAP, and CBUSH1D with a table, are'
      else if (is_unread_load(card%name)) then
        call read_unread_load(card, model%conditions%unread, reason, status)
      end if
    end select
  end subroutine read_card

  !> The links of all gaps and one-way springs, in the order of the file.
  pure subroutine make_links(model, deck, refused)
    type(bulk_model), intent(in) :: model
    type(fuge_deck), intent(inout) :: deck
    type(refusal), intent(inout) :: refused
    type(fuge_deck_link), allocatable :: links(:)
    real(dp) :: position(3, 2)
    integer :: k, n, table
    logical :: one_way

    allocate (links(model%gaps%count + model%springs%count), stat=refused%status)
    if (refused%status /= 0) return
    n = 0
    do k = 1, model%gaps%count
      call find_positions(model%conditions%nodes, model%gaps%whole(3:4, k), &
                          needs_positions(k, model%gaps, model%gap_properties), position, refused%reason)
      if (.not. allocated(refused%reason)) call make_gap(k, model%gaps, model%gap_properties, model%systems, position, &
                                                         links(n + 1), refused%reason)
      call finish_link('CGAP', model%gaps%whole(1, k), model%gaps%place(:, k), .true., n, links, refused)
      if (allocated(refused%reason)) return
    end do
    do k = 1, model%springs%count
      call find_table(k, model%springs, model%spring_properties, table, refused%reason)
      one_way = table > 0
      if (one_way) call find_positions(model%conditions%nodes, model%springs%whole(3:4, k), &
                                       model%springs%whole(5, k) < 0, position, refused%reason)
      if (one_way .and. .not. allocated(refused%reason)) &
        call make_spring(k, table, model%springs, model%tables, model%systems, position, links(n + 1), refused%reason)
      call finish_link('CBUSH1D', model%springs%whole(1, k), model%springs%place(:, k), one_way, n, links, refused)
      if (allocated(refused%reason)) return
    end do
    deck%links = links(:n)
  end subroutine make_links

  !> Give the last link its place and count it if it is one; or complete the refusal.
  pure subroutine finish_link(card, number, place, one_way, n, links, refused)
    character(len=*), intent(in) :: card
    integer, intent(in) :: number, place(2)
    logical, intent(in) :: one_way
    integer, intent(inout) :: n
    type(fuge_deck_link), intent(inout) :: links(:)
    type(refusal), intent(inout) :: refused

    if (allocated(refused%reason)) then
      refused%reason = card//' '//text(number)//': '//refused%reason
      refused%place = place
    else if (one_way) then
      n = n + 1
      links(n)%file = place(1)
      links(n)%line = place(2)
    end if
  end subroutine finish_link

  !> Positions of nodes a and b of an element, `numbers`; the ground is at the origin. Those in another system than the
  !> basic one are refused where they are `needed`, and so are displacements in another system.
  pure subroutine find_positions(nodes, numbers, needed, position, reason)
    type(number_records), intent(in) :: nodes
    integer, intent(in) :: numbers(2)
    logical, intent(in) :: needed
    real(dp), intent(out) :: position(3, 2)
    character(len=:), allocatable, intent(inout) :: reason
    integer :: i, k

    position = 0.0_dp
    do i = 1, 2
      if (allocated(reason)) return
      if (numbers(i) == 0) cycle
      k = nodes%find(numbers(i))
      if (k == 0) then
        reason = 'the deck has no GRID '//text(numbers(i))
      else if (nodes%whole(2, k) /= 0 .and. needed) then
        reason = 'GRID '//text(numbers(i))//' has the coordinate system CP = '//text(nodes%whole(2, k)) &
          //': positions are read in the basic system, 0'
      else if (nodes%whole(3, k) /= 0) then
        reason = 'GRID '//text(numbers(i))//' has the displacement system CD = '//text(nodes%whole(3, k)) &
          //': one-way elements are read at nodes of the basic system, 0'
      else
        position(:, i) = nodes%value(:, k)
      end if
    end do
  end subroutine find_positions

end module fuge_bulk_deck
