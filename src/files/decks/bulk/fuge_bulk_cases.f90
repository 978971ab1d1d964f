!> The load cases of a Nastran deck: the forces and supports that each subcase selects.
module fuge_bulk_cases
  use fuge_bulk_loads, only: UNREAD_LOADS
  use fuge_condition_table, only: condition_table
  use fuge_deck_type, only: fuge_deck, fuge_deck_case
  use fuge_kinds, only: dp
  use fuge_number_records, only: number_records
  use fuge_number_text, only: text
  implicit none
  private

  public :: make_cases

  !> All that loads and supports are made of.
  type, public :: bulk_conditions
    type(number_records) :: nodes, scalar_points, forces, load_sums, supports, support_sums, displacements, unread, &
      subcases
    !> Those of the deck.
    character(len=:), allocatable :: paths
  end type bulk_conditions

  !> Why a case cannot be made, and the place of the card that is wrong; the line is 0 if it is none.
  type, public :: refusal
    character(len=:), allocatable :: reason
    integer :: place(2) = 0
    integer :: status = 0
  end type refusal

contains

  !> All cases of a deck, and the supports of the model.
  pure subroutine make_cases(model, deck, refused)
    type(bulk_conditions), intent(in) :: model
    type(fuge_deck), intent(inout) :: deck
    type(refusal), intent(inout) :: refused
    type(condition_table) :: held
    integer :: k, n, selected(3)

    selected = 0
    n = model%subcases%count - 1
    if (n < 0) then
      call choose_sets(model, selected, refused)
      if (allocated(refused%reason)) return
      ! Supports alone are no case: a table may have the loads.
      n = merge(1, 0, selected(2) > 0)
    else
      selected = model%subcases%whole(:, n + 1)
      if (n == 0 .and. any(selected > 0)) n = 1
    end if
    call hold_supports(model, selected(3), held, refused)
    if (.not. allocated(refused%reason)) call held%copy_to(deck%supports, refused%status)
    if (refused%status == 0) allocate (deck%cases(n), stat=refused%status)
    do k = 1, n
      if (refused%status /= 0 .or. allocated(refused%reason)) return
      if (n < model%subcases%count) selected = model%subcases%whole(:, k)
      if (selected(1) == 0) selected(1) = 1
      call make_case(model, selected, deck%cases(k), refused)
    end do
  end subroutine make_cases

  !> Of bulk data alone: the only load set, or sum of them, and the only set of supports.
  pure subroutine choose_sets(model, selected, refused)
    type(bulk_conditions), intent(in) :: model
    integer, intent(inout) :: selected(3)
    type(refusal), intent(inout) :: refused

    call only_set(model%load_sums, model%load_sums, 'LOAD', selected(2), refused)
    call only_set(model%forces, model%load_sums, 'LOAD', selected(2), refused)
    call only_set(model%displacements, model%load_sums, 'LOAD', selected(2), refused)
    call only_set(model%unread, model%load_sums, 'LOAD', selected(2), refused)
    call only_set(model%support_sums, model%support_sums, 'SPC', selected(3), refused)
    call only_set(model%supports, model%support_sums, 'SPC', selected(3), refused)
  end subroutine choose_sets

  !> Refuse a record that belongs neither to the set, which is that of the first record if it is 0, nor to one that the
  !> set adds up.
  pure subroutine only_set(records, sums, command, set, refused)
    type(number_records), intent(in) :: records, sums
    character(len=*), intent(in) :: command
    integer, intent(inout) :: set
    type(refusal), intent(inout) :: refused
    integer :: k

    if (records%count == 0 .or. allocated(refused%reason)) return
    if (set == 0) set = records%whole(1, 1)
    do k = 1, records%count
      if (records%whole(1, k) == set) cycle
      if (sums%count > 0) then
        if (any(sums%whole(1, :sums%count) == set .and. sums%whole(2, :sums%count) == records%whole(1, k))) cycle
      end if
      refused%reason = 'the set '//text(records%whole(1, k))//' is another one than '//text(set)//': write the case ' &
        //'control that selects them, with SUBCASE, '//command//' = and BEGIN BULK'
      refused%place = records%place(:, k)
      return
    end do
  end subroutine only_set

  !> The case of a subcase: its number, load set and set of supports.
  pure subroutine make_case(model, selected, made, refused)
    type(bulk_conditions), intent(in) :: model
    integer, intent(in) :: selected(3)
    type(fuge_deck_case), intent(inout) :: made
    type(refusal), intent(inout) :: refused
    type(condition_table) :: forces, held
    logical :: is_sum, known
    integer :: k

    made%name = 'SUBCASE '//text(selected(1))
    call hold_supports(model, selected(3), held, refused)
    if (allocated(refused%reason) .or. refused%status /= 0) return
    is_sum = .false.
    known = selected(2) == 0
    do k = 1, model%load_sums%count
      if (model%load_sums%whole(1, k) /= selected(2)) cycle
      if (has_set(model, selected(2))) &
        refused%reason = 'the set '//text(selected(2))//' has loads of its own and is a sum'
      if (.not. allocated(refused%reason)) &
        call add_set(model, model%load_sums%whole(2, k), model%load_sums%value(1, k), forces, held, known, refused)
      if (.not. (known .or. allocated(refused%reason))) refused%reason = 'the deck has no loads of the set ' &
        //text(model%load_sums%whole(2, k))
      if (allocated(refused%reason) .and. refused%place(2) == 0) refused%place = model%load_sums%place(:, k)
      if (allocated(refused%reason)) return
      is_sum = .true.
    end do
    if (.not. is_sum .and. selected(2) > 0) call add_set(model, selected(2), 1.0_dp, forces, held, known, refused)
    if (allocated(refused%reason)) return
    if (.not. known) refused%reason = trim(made%name)//' selects the load set '//text(selected(2)) &
      //', which the deck does not have'
    call forces%copy_to(made%loads, refused%status)
    call held%copy_to(made%supports, refused%status)
  end subroutine make_case

  !> Has the load set forces or displacements?
  pure function has_set(model, set)
    type(bulk_conditions), intent(in) :: model
    integer, intent(in) :: set
    logical :: has_set

    has_set = is_in(model%forces, set) .or. is_in(model%displacements, set) .or. is_in(model%unread, set)
  end function has_set

  pure function is_in(records, set)
    type(number_records), intent(in) :: records
    integer, intent(in) :: set
    logical :: is_in

    is_in = .false.
    if (records%count > 0) is_in = any(records%whole(1, :records%count) == set)
  end function is_in

  !> Add `factor` times the loads of a set; `known` tells whether there are any.
  pure subroutine add_set(model, set, factor, forces, held, known, refused)
    type(bulk_conditions), intent(in) :: model
    integer, intent(in) :: set
    real(dp), intent(in) :: factor
    type(condition_table), intent(inout) :: forces, held
    logical, intent(out) :: known
    type(refusal), intent(inout) :: refused
    integer :: i, k, node

    known = has_set(model, set)
    do k = 1, model%unread%count
      if (model%unread%whole(1, k) /= set) cycle
      refused%reason = trim(UNREAD_LOADS(model%unread%whole(2, k)))//' of the load set '//text(set)//' is not read: ' &
        //'give its forces at nodes by FORCE and MOMENT'
      refused%place = model%unread%place(:, k)
      return
    end do
    do k = 1, model%forces%count
      if (model%forces%whole(1, k) /= set) cycle
      node = model%nodes%find(model%forces%whole(2, k))
      if (node == 0) then
        refused%reason = 'the deck has no GRID '//text(model%forces%whole(2, k))
      else if (model%nodes%whole(3, node) /= 0) then
        refused%reason = 'GRID '//text(model%forces%whole(2, k))//' has the displacement system CD = ' &
          //text(model%nodes%whole(3, node))//': loads are read at nodes of the basic system, 0'
      end if
      if (allocated(refused%reason)) refused%place = model%forces%place(:, k)
      if (allocated(refused%reason)) return
      do i = 1, 3
        if (abs(model%forces%value(i, k)) > 0.0_dp) call forces%add( &
          model%forces%whole(2, k), model%forces%whole(3, k) + i - 1, factor*model%forces%value(i, k), &
          [model%forces%place(:, k), 1], refused%status)
      end do
    end do
    call displace_supports(model, set, factor, held, refused)
  end subroutine add_set

  !> The displacements of SPCD, which take the place of those of SPC.
  pure subroutine displace_supports(model, set, factor, held, refused)
    type(bulk_conditions), intent(in) :: model
    integer, intent(in) :: set
    real(dp), intent(in) :: factor
    type(condition_table), intent(inout) :: held
    type(refusal), intent(inout) :: refused
    integer :: digits, k
    logical :: found

    do k = 1, model%displacements%count
      if (model%displacements%whole(1, k) /= set) cycle
      digits = model%displacements%whole(3, k)
      do
        call held%displace(model%displacements%whole(2, k), mod(digits, 10), factor*model%displacements%value(1, k), &
                           found)
        if (.not. found) then
          refused%reason = 'node '//text(model%displacements%whole(2, k))//' is not held in direction ' &
            //text(mod(digits, 10))//' by the SPC of the subcase'
          refused%place = model%displacements%place(:, k)
          return
        end if
        digits = digits/10
        if (digits == 0) exit
      end do
    end do
  end subroutine displace_supports

  !> The supports of a set (0: none), of those that it adds, and the permanent ones of nodes.
  pure subroutine hold_supports(model, set, held, refused)
    type(bulk_conditions), intent(in) :: model
    integer, intent(in) :: set
    type(condition_table), intent(inout) :: held
    type(refusal), intent(inout) :: refused
    integer :: k
    logical :: is_sum, known

    do k = 1, model%nodes%count
      if (model%nodes%whole(4, k) > 0) call hold_node(model%nodes%whole(1, k), model%nodes%whole(4, k), 0.0_dp, &
                                                      model%nodes%place(:, k), model%paths, held, refused)
    end do
    if (set == 0) return
    is_sum = .false.
    do k = 1, model%support_sums%count
      if (model%support_sums%whole(1, k) /= set .or. allocated(refused%reason)) cycle
      is_sum = .true.
      call hold_set(model, model%support_sums%whole(2, k), held, known, refused)
      if (known .or. allocated(refused%reason)) cycle
      refused%reason = 'the deck has no supports of the set '//text(model%support_sums%whole(2, k))
      refused%place = model%support_sums%place(:, k)
    end do
    if (is_sum .or. allocated(refused%reason)) return
    call hold_set(model, set, held, known, refused)
    if (.not. (known .or. allocated(refused%reason))) refused%reason = 'SPC = '//text(set)//' selects supports which ' &
      //'the deck does not have'
  end subroutine hold_supports

  pure subroutine hold_set(model, set, held, known, refused)
    type(bulk_conditions), intent(in) :: model
    integer, intent(in) :: set
    type(condition_table), intent(inout) :: held
    logical, intent(out) :: known
    type(refusal), intent(inout) :: refused
    integer :: k

    known = .false.
    do k = 1, model%supports%count
      if (model%supports%whole(1, k) /= set) cycle
      known = .true.
      if (model%supports%whole(3, k) > 0 .and. model%nodes%find(model%supports%whole(2, k)) == 0) then
        refused%reason = 'the deck has no GRID '//text(model%supports%whole(2, k))
        refused%place = model%supports%place(:, k)
      else
        call hold_node(model%supports%whole(2, k), model%supports%whole(3, k), model%supports%value(1, k), &
                       model%supports%place(:, k), model%paths, held, refused)
      end if
      if (allocated(refused%reason)) return
    end do
  end subroutine hold_set

  !> Hold a node in directions such as 123.
  pure subroutine hold_node(node, directions, displacement, place, paths, held, refused)
    integer, intent(in) :: node, directions, place(2)
    real(dp), intent(in) :: displacement
    character(len=*), intent(in) :: paths
    type(condition_table), intent(inout) :: held
    type(refusal), intent(inout) :: refused
    integer :: digits

    if (allocated(refused%reason)) return
    digits = directions
    do
      call held%hold(node, mod(digits, 10), displacement, [place, 1], paths, refused%reason, refused%status)
      digits = digits/10
      if (digits == 0 .or. allocated(refused%reason)) exit
    end do
    if (allocated(refused%reason)) refused%place = place
  end subroutine hold_node

end module fuge_bulk_cases
