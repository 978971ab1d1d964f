!> Decks and stiffness matrices, put together: links become rows of a contact problem, forces and supports belong to
!> degrees of freedom.
module fuge_deck_rows
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_body_type, only: fuge_body
  use fuge_deck_type, only: fuge_deck, fuge_deck_case, fuge_deck_link, fuge_deck_value, place_text
  use fuge_kinds, only: dp
  use fuge_links_type, only: fuge_hard_law, fuge_link_law, fuge_links
  use fuge_number_text, only: text
  use fuge_problem_type, only: fuge_problem
  use fuge_row_table, only: row_table
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_DOF, FUGE_ERR_SIZE
  implicit none
  private

  public :: fuge_deck_contact, fuge_deck_links, fuge_deck_loads, fuge_deck_supports

contains

  !> The contact points of all links: point k of `body` and `problem` is deck%links(k).
  !>
  !> `node` and `direction` (rows of the stiffness matrix): the names of the rows, as fuge_read_stiffness returns them.
  !> Of `body` dof and normal (6, links) are set; of `problem` the gap, and gap_upper, compliance, limit and
  !> limit_upper, the same at both stops, where some link has them. Rows that the matrix does not have belong to degrees
  !> of freedom that are held: programs leave them out.
  !> Errors, nothing changed: FUGE_ERR_SIZE without links, or if node and direction differ in length; FUGE_ERR_DOF for a
  !> row that is named twice, and for a link that no row moves, or one at a node that has no row although no load case
  !> holds it; FUGE_ERR_MEMORY.
  subroutine fuge_deck_contact(deck, node, direction, body, problem, info)
    type(fuge_deck), intent(in) :: deck
    integer, intent(in) :: node(:), direction(:)
    type(fuge_body), intent(inout) :: body
    type(fuge_problem), intent(inout) :: problem
    type(fuge_info), intent(out) :: info
    type(row_table) :: rows
    integer, allocatable :: dof(:, :)
    real(dp), allocatable :: normal(:, :)
    integer :: k, n, stat

    n = deck%link_count()
    if (n < 1) then
      call report(info, FUGE_ERR_SIZE, 'the deck has no one-way link')
      return
    end if
    call name_rows(node, direction, rows, info)
    if (info%failed()) return
    allocate (dof(6, n), normal(6, n), stat=stat)
    call require_memory(stat, 'the rows of', n, 'links', info)
    do k = 1, n
      if (info%failed()) return
      call place_link(deck, k, rows, dof(:, k), normal(:, k), info)
    end do
    if (info%failed()) return
    call move_alloc(dof, body%dof)
    call move_alloc(normal, body%normal)
    problem%gap = deck%links%gap
    call set_law(deck%links%play, any(ieee_is_finite(deck%links%play)), problem%gap_upper)
    call set_law(deck%links%compliance, any(deck%links%compliance > 0.0_dp), problem%compliance)
    call set_law(deck%links%limit, any(ieee_is_finite(deck%links%limit)), problem%limit)
    call set_law(deck%links%limit, allocated(problem%limit) .and. allocated(problem%gap_upper), problem%limit_upper)
  end subroutine fuge_deck_contact

  !> A component of a problem that has an effect; otherwise it is not allocated.
  pure subroutine set_law(values, has_effect, component)
    real(dp), intent(in) :: values(:)
    logical, intent(in) :: has_effect
    real(dp), allocatable, intent(inout) :: component(:)

    if (allocated(component)) deallocate (component)
    if (has_effect) component = values
  end subroutine set_law

  !> The links of a deck as those of a structure: link k is deck%links(k), with its name.
  !>
  !> `node` and `direction` as of `fuge_deck_contact`, whose errors these are; `links` is replaced.
  subroutine fuge_deck_links(deck, node, direction, links, info)
    type(fuge_deck), intent(in) :: deck
    integer, intent(in) :: node(:), direction(:)
    type(fuge_links), intent(inout) :: links
    type(fuge_info), intent(out) :: info
    type(fuge_body) :: body
    type(fuge_problem) :: problem
    type(fuge_links) :: found
    type(fuge_link_law) :: law
    integer :: k

    call fuge_deck_contact(deck, node, direction, body, problem, info)
    do k = 1, deck%link_count()
      if (info%failed()) return
      law = fuge_hard_law()
      law%gap = deck%links(k)%gap
      law%play = deck%links(k)%play
      law%compliance = deck%links(k)%compliance
      law%limit = deck%links(k)%limit
      law%limit_upper = deck%links(k)%limit
      call found%add_gap(body%dof(4:, k), body%dof(:3, k), deck%links(k)%direction, info, law, deck%links(k)%name)
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

  !> Degrees of freedom and normal (6) of link `k`. Errors: FUGE_ERR_DOF.
  pure subroutine place_link(deck, k, rows, dof, normal, info)
    type(fuge_deck), intent(in) :: deck
    integer, intent(in) :: k
    type(row_table), intent(in) :: rows
    integer, intent(out) :: dof(6)
    real(dp), intent(out) :: normal(6)
    type(fuge_info), intent(inout) :: info
    integer :: axis, first, side

    dof = 0
    normal = 0.0_dp
    associate (link => deck%links(k))
      do side = 1, 2
        first = merge(0, 3, side == 1)
        associate (node => merge(link%node_b, link%node_a, side == 1))
          if (node == 0) cycle
          do axis = 1, 3
            if (.not. abs(link%direction(axis)) > 0.0_dp) cycle
            dof(first + axis) = rows%find(node, axis)
            if (dof(first + axis) > 0) normal(first + axis) = merge(1, -1, side == 1)*link%direction(axis)
          end do
          if (all(dof(first + 1:first + 3) == 0)) call check_held(deck, link, node, rows, info)
          if (info%failed()) return
        end associate
      end do
      if (any(dof > 0)) return
      call report(info, FUGE_ERR_DOF, trim(link_text(deck, link))//': no row of the matrix moves it')
    end associate
  end subroutine place_link

  !> Refuse a node without a row along the link unless the matrix knows it in another direction, or a load case holds
  !> it.
  pure subroutine check_held(deck, link, node, rows, info)
    type(fuge_deck), intent(in) :: deck
    type(fuge_deck_link), intent(in) :: link
    integer, intent(in) :: node
    type(row_table), intent(in) :: rows
    type(fuge_info), intent(inout) :: info
    integer :: k

    do k = 1, 6
      if (rows%find(node, k) > 0) return
    end do
    if (allocated(deck%supports)) then
      if (any(deck%supports%node == node)) return
    end if
    do k = 1, deck%case_count()
      if (.not. allocated(deck%cases(k)%supports)) cycle
      if (any(deck%cases(k)%supports%node == node)) return
    end do
    call report(info, FUGE_ERR_DOF, trim(link_text(deck, link))//': the matrix has no row of node '//text(node) &
                //', and no support holds it')
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
  !> `node` and `direction` as of `fuge_deck_contact`. Forces at degrees of freedom that a case holds go into the
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
          else if (abs(load%value) > 0.0_dp .and. .not. is_held(deck%cases(k), load)) then
            call refuse_row(deck, k, load, 'a force, but no support and', info)
            return
          end if
        end associate
      end do
    end do
    call move_alloc(columns, loads)
  end subroutine fuge_deck_loads

  !> Does the load case hold the degree of freedom of a load?
  pure function is_held(of_case, load)
    type(fuge_deck_case), intent(in) :: of_case
    type(fuge_deck_value), intent(in) :: load
    logical :: is_held

    is_held = .false.
    if (allocated(of_case%supports)) &
      is_held = any(of_case%supports%node == load%node .and. of_case%supports%direction == load%direction)
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
  !> `node` and `direction` as of `fuge_deck_contact`. Supports without a row are held in the matrix already.
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
    integer :: i, n, row, stat

    if (k < 1 .or. k > deck%case_count()) then
      call report(info, FUGE_ERR_SIZE, 'load case '//text(k)//' is outside 1 .. '//text(deck%case_count()))
      return
    end if
    call name_rows(node, direction, rows, info)
    n = 0
    if (allocated(deck%cases(k)%supports)) n = size(deck%cases(k)%supports)
    if (info%failed()) return
    allocate (held(n), values(n), stat=stat)
    call require_memory(stat, 'the supports', info)
    if (info%failed()) return
    n = 0
    do i = 1, size(held)
      associate (support => deck%cases(k)%supports(i))
        row = rows%find(support%node, support%direction)
        if (row > 0) then
          n = n + 1
          held(n) = row
          values(n) = support%value
        else if (abs(support%value) > 0.0_dp) then
          call refuse_row(deck, k, support, 'a displacement, but', info)
          return
        end if
      end associate
    end do
    fixed = held(:n)
    displacement = values(:n)
  end subroutine fuge_deck_supports

end module fuge_deck_rows
