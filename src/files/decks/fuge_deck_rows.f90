!> Decks and stiffness matrices, put together: links become rows of a contact problem, forces and supports belong to
!> degrees of freedom.
module fuge_deck_rows
  use fuge_deck_type, only: fuge_deck, fuge_deck_link, fuge_deck_value, place_text, NAME_LENGTH
  use fuge_kinds, only: dp
  use fuge_links_type, only: fuge_link_law, fuge_links
  use fuge_number_text, only: text
  use fuge_row_table, only: row_table
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_DOF, FUGE_ERR_SIZE
  implicit none
  private

  public :: fuge_deck_links, fuge_deck_loads, fuge_deck_supports

  !> A component of the unit vector of a link is rounding up to this size, so that it needs no row.
  real(dp), parameter :: NO_COMPONENT = 16.0_dp*epsilon(1.0_dp)

contains

  !> The links of a deck as those of a structure: link k is deck%links(k), with its name.
  !>
  !> `node` and `direction` (rows of the stiffness matrix): the names of the rows, as fuge_read_stiffness returns them.
  !> Programs leave out the rows of degrees of freedom that are held: a row that the matrix does not have must be held
  !> in every load case, or, if there is none, by the supports of the model.
  !> Errors, `links` unchanged: FUGE_ERR_SIZE without links, or if node and direction differ in length; FUGE_ERR_DOF for
  !> a row that is named twice, for a link that no row moves, and for one at a degree of freedom that has no row
  !> although it is not held; FUGE_ERR_MEMORY.
  subroutine fuge_deck_links(deck, node, direction, links, info)
    type(fuge_deck), intent(in) :: deck
    integer, intent(in) :: node(:), direction(:)
    type(fuge_links), intent(inout) :: links
    type(fuge_info), intent(out) :: info
    type(fuge_links) :: found
    type(row_table) :: rows
    integer :: dof(3, 2), k

    if (deck%link_count() < 1) then
      call report(info, FUGE_ERR_SIZE, 'the deck has no one-way link')
      return
    end if
    call name_rows(node, direction, rows, info)
    do k = 1, deck%link_count()
      if (info%failed()) return
      associate (link => deck%links(k))
        call find_rows(deck, link, link%node_a, rows, dof(:, 1), info)
        if (.not. info%failed()) call find_rows(deck, link, link%node_b, rows, dof(:, 2), info)
        if (info%failed()) return
        if (.not. any(dof > 0)) then
          call report(info, FUGE_ERR_DOF, trim(link_text(deck, link))//': no row of the matrix moves it')
        else
          call found%add_gap(dof(:, 1), dof(:, 2), link%direction, info, &
                             fuge_link_law(link%gap, link%play, link%compliance, link%limit, link%limit), link%name)
        end if
      end associate
    end do
    if (.not. info%failed()) links = found
  end subroutine fuge_deck_links

  !> A table of the rows. Errors: FUGE_ERR_SIZE, FUGE_ERR_DOF, FUGE_ERR_MEMORY.
  pure subroutine name_rows(node, direction, rows, info)
    integer, intent(in) :: node(:), direction(:)
    type(row_table), intent(out) :: rows
    type(fuge_info), intent(inout) :: info
    integer :: k, number, stat

    if (size(node) /= size(direction)) then
      call report(info, FUGE_ERR_SIZE, 'node has '//text(size(node))//' value(s), direction '//text(size(direction)) &
                  //': both name each row')
      return
    end if
    do k = 1, size(node)
      call rows%number_of(node(k), direction(k), number, stat)
      call require_memory(stat, 'the names of the rows', info)
      if (info%failed()) return
      if (number == k) cycle
      if (node(k) == 0) then
        call report(info, FUGE_ERR_DOF, 'the rows of the matrix have no names: the node and the direction of each ' &
                    //'are needed')
      else
        call report(info, FUGE_ERR_DOF, 'node '//text(node(k))//', direction '//text(direction(k))//' is the name of ' &
                    //'two rows')
      end if
      return
    end do
  end subroutine name_rows

  !> Rows of a node (0: the ground) along the axes in which the link has a component; 0 where the matrix has none
  !> because the node is held. Error: FUGE_ERR_DOF.
  pure subroutine find_rows(deck, link, node, rows, dof, info)
    type(fuge_deck), intent(in) :: deck
    type(fuge_deck_link), intent(in) :: link
    integer, intent(in) :: node
    type(row_table), intent(in) :: rows
    integer, intent(out) :: dof(3)
    type(fuge_info), intent(inout) :: info
    integer :: axis

    dof = 0
    if (node == 0) return
    do axis = 1, 3
      if (.not. abs(link%direction(axis)) > 0.0_dp) cycle
      dof(axis) = rows%find(node, axis)
      if (dof(axis) == 0 .and. abs(link%direction(axis)) > NO_COMPONENT) call check_held(deck, link, node, axis, info)
      if (info%failed()) return
    end do
  end subroutine find_rows

  !> Refuse a degree of freedom without a row unless every load case holds it: the matrix is that of all of them.
  pure subroutine check_held(deck, link, node, axis, info)
    type(fuge_deck), intent(in) :: deck
    type(fuge_deck_link), intent(in) :: link
    integer, intent(in) :: node, axis
    type(fuge_info), intent(inout) :: info
    character(len=NAME_LENGTH + 14) :: holder
    integer :: k

    holder = ''
    if (deck%case_count() == 0 .and. .not. is_held(deck%supports, node, axis)) holder = 'no support is'
    do k = deck%case_count(), 1, -1
      if (.not. is_held(deck%cases(k)%supports, node, axis)) holder = trim(deck%cases(k)%name)//' has no support'
    end do
    if (holder /= '') call report(info, FUGE_ERR_DOF, trim(link_text(deck, link))//': the matrix has no row of node ' &
      //text(node)//', direction '//text(axis)//', but '//trim(holder)//' there')
  end subroutine check_held

  !> The name of a link and its place.
  pure function link_text(deck, link) result(words)
    type(fuge_deck), intent(in) :: deck
    type(fuge_deck_link), intent(in) :: link
    character(len=200) :: words
    character(len=:), allocatable :: place

    words = link%name
    if (.not. allocated(deck%paths)) return
    call place_text(deck%paths, link%file, link%line, place)
    if (len(place) > 0) words = place//', '//link%name
  end function link_text

  !> The forces of all load cases, a column for each: `loads` (rows, cases), force.
  !>
  !> `node` and `direction` as of `fuge_deck_links`. Forces at degrees of freedom that a case holds go into the
  !> support, and have no effect.
  !> Errors, `loads` unchanged: FUGE_ERR_SIZE if node and direction differ in length; FUGE_ERR_DOF for a row that is
  !> named twice, and for a force at a degree of freedom that has no row and is not held; FUGE_ERR_MEMORY.
  subroutine fuge_deck_loads(deck, node, direction, loads, info)
    type(fuge_deck), intent(in) :: deck
    integer, intent(in) :: node(:), direction(:)
    real(dp), allocatable, intent(inout) :: loads(:, :)
    type(fuge_info), intent(out) :: info
    type(row_table) :: rows
    real(dp), allocatable :: columns(:, :)
    integer :: i, k, row, stat

    call name_rows(node, direction, rows, info)
    if (info%failed()) return
    allocate (columns(size(node), deck%case_count()), source=0.0_dp, stat=stat)
    call require_memory(stat, 'the loads of', deck%case_count(), 'cases', info)
    if (info%failed()) return
    do k = 1, deck%case_count()
      if (.not. allocated(deck%cases(k)%loads)) cycle
      do i = 1, size(deck%cases(k)%loads)
        associate (load => deck%cases(k)%loads(i))
          row = rows%find(load%node, load%direction)
          if (row > 0) then
            columns(row, k) = load%value
          else if (abs(load%value) > 0.0_dp .and. .not. is_held(deck%cases(k)%supports, load%node, load%direction)) then
            call refuse_row(deck, k, load, 'a force, but no support and', info)
            return
          end if
        end associate
      end do
    end do
    call move_alloc(columns, loads)
  end subroutine fuge_deck_loads

  !> Do the supports, if there are any, hold a degree of freedom?
  pure function is_held(supports, node, direction)
    type(fuge_deck_value), allocatable, intent(in) :: supports(:)
    integer, intent(in) :: node, direction
    logical :: is_held

    is_held = .false.
    if (allocated(supports)) is_held = any(supports%node == node .and. supports%direction == direction)
  end function is_held

  !> Report FUGE_ERR_DOF: a load or support has no row.
  pure subroutine refuse_row(deck, k, value, has, info)
    type(fuge_deck), intent(in) :: deck
    integer, intent(in) :: k
    type(fuge_deck_value), intent(in) :: value
    character(len=*), intent(in) :: has
    type(fuge_info), intent(inout) :: info
    character(len=:), allocatable :: place

    place = ''
    if (allocated(deck%paths)) call place_text(deck%paths, value%file, value%line, place)
    if (len(place) > 0) place = place//', '
    call report(info, FUGE_ERR_DOF, place//trim(deck%cases(k)%name)//': node '//text(value%node)//', direction ' &
                //text(value%direction)//' has '//has//' no row in the matrix')
  end subroutine refuse_row

  !> The rows that load case number `k` holds, and their displacements, as fuge_body takes them.
  !>
  !> `node` and `direction` as of `fuge_deck_links`. Supports without a row are held in the matrix already.
  !> Errors, nothing changed: FUGE_ERR_SIZE if node and direction differ in length or there is no such case;
  !> FUGE_ERR_DOF for a row that is named twice, and for a displacement other than zero without a row; FUGE_ERR_MEMORY.
  subroutine fuge_deck_supports(deck, k, node, direction, fixed, displacement, info)
    type(fuge_deck), intent(in) :: deck
    integer, intent(in) :: k, node(:), direction(:)
    integer, allocatable, intent(inout) :: fixed(:)
    real(dp), allocatable, intent(inout) :: displacement(:)
    type(fuge_info), intent(out) :: info
    type(row_table) :: rows
    integer, allocatable :: held(:)
    real(dp), allocatable :: values(:)
    integer :: i, j, n, stat

    if (k < 1 .or. k > deck%case_count()) then
      call report(info, FUGE_ERR_SIZE, 'load case '//text(k)//' is outside 1 .. '//text(deck%case_count()))
      return
    end if
    call name_rows(node, direction, rows, info)
    n = 0
    if (allocated(deck%cases(k)%supports)) n = size(deck%cases(k)%supports)
    if (info%failed()) return
    do i = n, 1, -1
      associate (support => deck%cases(k)%supports(i))
        if (rows%find(support%node, support%direction) > 0) cycle
        n = n - 1
        if (abs(support%value) > 0.0_dp) call refuse_row(deck, k, support, 'a displacement, but', info)
      end associate
    end do
    if (info%failed()) return
    allocate (held(n), values(n), stat=stat)
    call require_memory(stat, 'the supports', info)
    if (info%failed()) return
    i = 0
    do j = 1, n
      do
        i = i + 1
        held(j) = rows%find(deck%cases(k)%supports(i)%node, deck%cases(k)%supports(i)%direction)
        if (held(j) > 0) exit
      end do
      values(j) = deck%cases(k)%supports(i)%value
    end do
    call move_alloc(held, fixed)
    call move_alloc(values, displacement)
  end subroutine fuge_deck_supports

end module fuge_deck_rows
