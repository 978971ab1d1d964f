!> Tables of links, of supports and of load cases, for decks that no program has written: lines with columns between
!> commas, semicolons or blanks, comments from # on.
module fuge_deck_tables
  use fuge_condition_table, only: condition_table
  use fuge_deck_type, only: fuge_deck, fuge_deck_case, fuge_deck_link, fuge_deck_value, new_link, place_text, &
    NAME_LENGTH
  use fuge_entry_numbers, only: read_label, read_value
  use fuge_kinds, only: dp
  use fuge_number_records, only: number_records
  use fuge_number_text, only: text
  use fuge_row_table, only: row_table, LARGEST_DIRECTION
  use fuge_status, only: fuge_info, report, FUGE_ERR_FILE, FUGE_ERR_MEMORY
  use fuge_text_columns, only: begin_columns, next_column, next_name
  use fuge_text_numbers, only: quoted
  use fuge_text_reader, only: text_file
  implicit none
  private

  public :: fuge_read_cases, fuge_read_links, fuge_read_supports

  !> Columns of a link, of which the first five are needed.
  integer, parameter :: LINK_COLUMNS = 9, NEEDED_COLUMNS = 5
  character(len=*), parameter :: COLUMN_NAMES(LINK_COLUMNS) = [character(len=9) :: 'node_a', 'node_b', 'x', 'y', 'z', &
    'gap', 'play', 'stiffness', 'limit']
  !> Axes by letters.
  character(len=*), parameter :: AXES = 'xyzXYZ'

contains

  !> Add the links of a table to a deck.
  !>
  !> Lines node_a, node_b, x, y, z, gap, play, stiffness, limit, then perhaps a name; node 0 is the ground, and x, y, z
  !> is a direction of any length, along which the link opens (`fuge_deck_link`). From gap on columns may be blank or
  !> missing: no gap, one-sided, rigid, no limit; so do play and limit of -1 and a stiffness of 0 say. A first line of
  !> words is a heading.
  !> Errors, `deck` unchanged: FUGE_ERR_FILE with file, line and reason; FUGE_ERR_MEMORY.
  subroutine fuge_read_links(path, deck, info)
    character(len=*), intent(in) :: path
    type(fuge_deck), intent(inout) :: deck
    type(fuge_info), intent(out) :: info
    type(text_file) :: file
    type(fuge_deck_link), allocatable :: links(:)
    character(len=:), allocatable :: reason
    integer :: n, old, stat
    logical :: begun, exists

    call file%load(path, info)
    if (info%failed()) return
    begun = .false.
    old = deck%link_count()
    allocate (links(old + file%count_lines()), stat=stat)
    if (stat /= 0) call report(info, FUGE_ERR_MEMORY, file%name//': no memory for its links')
    if (stat /= 0) return
    if (old > 0) links(:old) = deck%links
    n = old
    do
      call next_row(file, begun, exists)
      if (.not. exists) exit
      n = n + 1
      call read_link(file%content(file%first:file%last), n - old, links(n), reason)
      links(n)%file = deck%file_count() + 1
      links(n)%line = file%line
      if (allocated(reason)) call file%refuse(reason, info)
      if (info%failed()) return
    end do
    if (n == old) call report(info, FUGE_ERR_FILE, file%name//' has no link: lines node_a, node_b, x, y, z, .. are ' &
                              //'needed')
    if (info%failed()) return
    deck%links = links(:n)
    call add_path(deck, path, deck%paths)
  end subroutine fuge_read_links

  !> The paths of a deck, and another one.
  pure subroutine add_path(deck, path, paths)
    type(fuge_deck), intent(in) :: deck
    character(len=*), intent(in) :: path
    character(len=:), allocatable, intent(inout) :: paths

    if (allocated(deck%paths)) then
      paths = deck%paths//trim(path)//achar(0)
    else
      paths = trim(path)//achar(0)
    end if
  end subroutine add_path

  !> Advance to the next line with columns, but for a heading before all others; `begun` tells whether there was a line.
  pure subroutine next_row(file, begun, exists)
    type(text_file), intent(inout) :: file
    logical, intent(inout) :: begun
    logical, intent(out) :: exists
    logical :: skipped

    do
      call file%advance(exists)
      if (.not. exists) return
      associate (line => file%content(file%first:file%last))
        if (begin_columns(line) > len(line)) cycle
        skipped = .not. begun .and. is_heading(line)
      end associate
      begun = .true.
      if (.not. skipped) return
    end do
  end subroutine next_row

  !> Does the line begin with a letter?
  pure function is_heading(line)
    character(len=*), intent(in) :: line
    logical :: is_heading
    integer :: k

    k = begin_columns(line)
    is_heading = k <= len(line)
    if (is_heading) is_heading = scan(line(k:k), '0123456789+-.') == 0
  end function is_heading

  !> Link number `number` of the table.
  pure subroutine read_link(line, number, link, reason)
    character(len=*), intent(in) :: line
    integer, intent(in) :: number
    type(fuge_deck_link), intent(out) :: link
    character(len=:), allocatable, intent(inout) :: reason
    real(dp) :: value(LINK_COLUMNS)
    integer :: first, i, k, last, node(2), separator

    call check_separators(line, reason)
    if (allocated(reason)) return
    k = begin_columns(line)
    value = 0.0_dp
    value([7, 9]) = -1.0_dp
    do i = 1, 2
      call next_column(line, k, first, last, separator)
      call read_label(line(first:last), trim(COLUMN_NAMES(i)), 0, huge(1), node(i), reason)
      if (allocated(reason)) return
    end do
    do i = 3, LINK_COLUMNS
      call next_column(line, k, first, last, separator)
      if (last >= first .or. i <= NEEDED_COLUMNS) then
        call read_value(line(first:last), value(i), reason)
        if (allocated(reason)) reason = trim(COLUMN_NAMES(i))//': '//reason
      end if
      if (allocated(reason)) return
    end do
    call next_name(line, k, first, last, separator)
    if (maxval(abs(value(3:5))) > 0.0_dp) value(3:5) = value(3:5)/maxval(abs(value(3:5)))
    if (k <= len(line)) then
      reason = 'more columns than '//text(LINK_COLUMNS)//' and a name'
    else if (node(1) == node(2)) then
      reason = 'node_a and node_b are the same'
    else if (.not. norm2(value(3:5)) > 0.0_dp) then
      reason = 'the direction x, y, z has the length zero'
    else if (value(8) < 0.0_dp) then
      reason = 'the stiffness is negative'
    else if (any(value([7, 9]) < 0.0_dp .and. abs(value([7, 9]) + 1.0_dp) > 0.0_dp)) then
      reason = 'play and limit must not be negative, but for -1, which is none'
    end if
    if (allocated(reason)) return
    link = new_link('link '//text(number), node(1), node(2), value(3:5)/norm2(value(3:5)), value(6))
    if (last >= first) link%name = line(first:last)
    if (value(7) >= 0.0_dp) link%play = value(7)
    if (value(8) > 0.0_dp) link%compliance = 1.0_dp/value(8)
    if (value(9) >= 0.0_dp) link%limit = value(9)
  end subroutine read_link

  !> Refuse commas beside semicolons: those commas may be decimal ones.
  pure subroutine check_separators(line, reason)
    character(len=*), intent(in) :: line
    character(len=:), allocatable, intent(inout) :: reason
    integer :: last

    last = index(line//'#', '#') - 1
    if (index(line(:last), ';') > 0 .and. index(line(:last), ',') > 0) then
      reason = 'commas and semicolons on one line: separate columns by one of them, and write decimal points'
    end if
  end subroutine check_separators

  !> Add the load cases of a table to a deck.
  !>
  !> Lines node.direction, such as 17.3, and a force for each case. The first line may name the cases, after a word for
  !> the first column. Each case has the supports of the model, deck%supports.
  !> Errors, `deck` unchanged: FUGE_ERR_FILE with file, line and reason; FUGE_ERR_MEMORY.
  subroutine fuge_read_cases(path, deck, info)
    character(len=*), intent(in) :: path
    type(fuge_deck), intent(inout) :: deck
    type(fuge_info), intent(out) :: info
    type(text_file) :: file
    type(number_records) :: rows
    character(len=NAME_LENGTH), allocatable :: names(:)
    character(len=:), allocatable :: reason
    integer :: stat
    logical :: begun, exists

    call file%load(path, info)
    if (info%failed()) return
    stat = 0
    begun = .false.
    allocate (names(0))
    do
      call file%advance(exists)
      if (.not. exists) exit
      associate (line => file%content(file%first:file%last))
        if (begin_columns(line) > len(line)) cycle
        if (.not. begun) then
          begun = .true.
          call read_names(line, deck%case_count(), names)
          if (is_heading(line)) cycle
        end if
        call read_row(line, [deck%file_count() + 1, file%line], size(names), rows, reason, stat)
      end associate
      if (allocated(reason)) call file%refuse(reason, info)
      if (stat /= 0) call report(info, FUGE_ERR_MEMORY, file%name//': no memory for its forces')
      if (info%failed()) return
    end do
    if (rows%count == 0) call report(info, FUGE_ERR_FILE, file%name//' has no forces: lines like 17.3,-100 are needed')
    if (info%failed()) return
    call add_cases(file%name, names, rows, deck, info)
    if (.not. info%failed()) call add_path(deck, path, deck%paths)
  end subroutine fuge_read_cases

  !> The names of the cases, as many as there are columns after the first one; without a heading they are numbered,
  !> after the `before` cases that are there.
  pure subroutine read_names(line, before, names)
    character(len=*), intent(in) :: line
    integer, intent(in) :: before
    character(len=NAME_LENGTH), allocatable, intent(out) :: names(:)
    integer :: first, i, k, last, n, separator

    n = -1
    k = begin_columns(line)
    do while (k <= len(line))
      call next_name(line, k, first, last, separator)
      n = n + 1
    end do
    allocate (names(n))
    k = begin_columns(line)
    call next_name(line, k, first, last, separator)
    do i = 1, n
      call next_name(line, k, first, last, separator)
      names(i) = line(first:last)
      if (.not. is_heading(line) .or. last < first) names(i) = 'case '//text(before + i)
    end do
  end subroutine read_names

  !> A line of forces: whole numbers node and direction, and the forces.
  pure subroutine read_row(line, place, cases, rows, reason, status)
    character(len=*), intent(in) :: line
    integer, intent(in) :: place(2), cases
    type(number_records), intent(inout) :: rows
    character(len=:), allocatable, intent(inout) :: reason
    integer, intent(inout) :: status
    real(dp) :: force(cases)
    integer :: direction, dot, first, i, k, last, node, separator

    call check_separators(line, reason)
    if (cases < 1 .and. .not. allocated(reason)) reason = 'a force for each load case is needed after node and ' &
      //'direction'
    if (allocated(reason)) return
    k = begin_columns(line)
    call next_column(line, k, first, last, separator)
    dot = index(line(first:last), '.') + first - 1
    if (dot < first .or. dot == last) then
      reason = 'a node and a direction are needed first, like 17.3, not '//quoted(line(first:last))
      return
    end if
    call read_label(line(first:dot - 1), 'node', 1, huge(1), node, reason)
    call read_label(line(dot + 1:last), 'direction', 0, LARGEST_DIRECTION, direction, reason)
    do i = 1, cases
      if (k > len(line) .and. .not. allocated(reason)) reason = text(i - 1)//' force(s), but '//text(cases) &
        //' load case(s)'
      if (allocated(reason)) return
      call next_column(line, k, first, last, separator)
      call read_value(line(first:last), force(i), reason)
    end do
    if (k <= len(line)) reason = 'more forces than the '//text(cases)//' load case(s)'
    if (.not. allocated(reason)) call rows%append(place, [node, direction], force, status)
  end subroutine read_row

  !> Add the load cases of the file `path`, as messages quote it. Errors: FUGE_ERR_FILE for a degree of freedom with two
  !> lines; FUGE_ERR_MEMORY.
  pure subroutine add_cases(path, names, rows, deck, info)
    character(len=*), intent(in) :: path
    character(len=NAME_LENGTH), intent(in) :: names(:)
    type(number_records), intent(in) :: rows
    type(fuge_deck), intent(inout) :: deck
    type(fuge_info), intent(inout) :: info
    type(fuge_deck_case), allocatable :: cases(:)
    type(row_table) :: known
    integer :: i, k, number, old, stat

    old = deck%case_count()
    allocate (cases(old + size(names)), stat=stat)
    if (stat == 0 .and. old > 0) cases(:old) = deck%cases
    do k = 1, rows%count
      if (stat == 0) call known%number_of(rows%whole(1, k), rows%whole(2, k), number, stat)
      if (stat /= 0) exit
      if (number == k) cycle
      call report(info, FUGE_ERR_FILE, path//', line '//text(rows%place(2, k))//': a second line for node ' &
                  //text(rows%whole(1, k))//', direction '//text(rows%whole(2, k)))
      return
    end do
    do i = 1, size(names)
      if (stat == 0) allocate (cases(old + i)%loads(rows%count), stat=stat)
      if (stat /= 0) exit
      cases(old + i)%name = names(i)
      do k = 1, rows%count
        cases(old + i)%loads(k) = fuge_deck_value(rows%whole(1, k), rows%whole(2, k), rows%value(i, k), &
                                                  rows%place(2, k), rows%place(1, k))
      end do
      if (allocated(deck%supports)) cases(old + i)%supports = deck%supports
      if (.not. allocated(deck%supports)) allocate (cases(old + i)%supports(0))
    end do
    if (stat /= 0) call report(info, FUGE_ERR_MEMORY, path//': no memory for its load cases')
    if (stat == 0) call move_alloc(cases, deck%cases)
  end subroutine add_cases

  !> Add the supports of a table to the model, and to all load cases that a deck has.
  !>
  !> Lines node, directions, displacement; directions are letters or numbers, such as xyz or 123, and the displacement
  !> may be left out: 0. A first line of words is a heading.
  !> Errors, `deck` unchanged: FUGE_ERR_FILE with file, line and reason; FUGE_ERR_MEMORY.
  subroutine fuge_read_supports(path, deck, info)
    character(len=*), intent(in) :: path
    type(fuge_deck), intent(inout) :: deck
    type(fuge_info), intent(out) :: info
    type(text_file) :: file
    type(condition_table) :: held
    type(fuge_deck_case), allocatable :: cases(:)
    type(fuge_deck_value), allocatable :: found(:), supports(:)
    character(len=:), allocatable :: paths, reason
    integer :: k, stat
    logical :: begun, exists

    call file%load(path, info)
    call add_path(deck, path, paths)
    begun = .false.
    stat = 0
    do while (.not. info%failed())
      call next_row(file, begun, exists)
      if (.not. exists) exit
      call read_support(file%content(file%first:file%last), [deck%file_count() + 1, file%line, 1], paths, held, &
                        reason, stat)
      if (allocated(reason)) call file%refuse(reason, info)
    end do
    call held%copy_to(found, stat)
    if (stat == 0 .and. .not. info%failed()) then
      if (size(found) == 0) call report(info, FUGE_ERR_FILE, file%name//' has no support: lines like 17,xyz are needed')
    end if
    if (info%failed()) return
    if (stat == 0) allocate (cases(deck%case_count()), stat=stat)
    do k = 1, deck%case_count()
      if (stat /= 0) exit
      cases(k) = deck%cases(k)
      call join(found, paths, cases(k)%supports, reason, stat)
    end do
    if (allocated(deck%supports)) supports = deck%supports
    call join(found, paths, supports, reason, stat)
    if (stat /= 0) call report(info, FUGE_ERR_MEMORY, file%name//': no memory for its supports')
    if (allocated(reason)) call report(info, FUGE_ERR_FILE, reason)
    if (info%failed()) return
    call move_alloc(cases, deck%cases)
    call move_alloc(supports, deck%supports)
    deck%paths = paths
  end subroutine fuge_read_supports

  !> Add the supports that are `found` to those of a list; `reason`, with its place, if one contradicts the list.
  pure subroutine join(found, paths, supports, reason, status)
    type(fuge_deck_value), intent(in) :: found(:)
    character(len=*), intent(in) :: paths
    type(fuge_deck_value), allocatable, intent(inout) :: supports(:)
    character(len=:), allocatable, intent(inout) :: reason
    integer, intent(inout) :: status
    type(condition_table) :: held
    character(len=:), allocatable :: place
    integer :: k

    if (allocated(reason) .or. status /= 0) return
    if (allocated(supports)) then
      do k = 1, size(supports)
        call held%hold(supports(k)%node, supports(k)%direction, supports(k)%value, &
                       [supports(k)%file, supports(k)%line, 1], paths, reason, status)
      end do
    end if
    do k = 1, size(found)
      call held%hold(found(k)%node, found(k)%direction, found(k)%value, [found(k)%file, found(k)%line, 1], paths, &
                     reason, status)
      if (.not. allocated(reason)) cycle
      call place_text(paths, found(k)%file, found(k)%line, place)
      reason = place//': '//reason
      return
    end do
    call held%copy_to(supports, status)
  end subroutine join

  !> A line of supports.
  pure subroutine read_support(line, origin, paths, held, reason, status)
    character(len=*), intent(in) :: line, paths
    integer, intent(in) :: origin(3)
    type(condition_table), intent(inout) :: held
    character(len=:), allocatable, intent(inout) :: reason
    integer, intent(inout) :: status
    real(dp) :: value
    integer :: direction, first, i, k, last, node, separator, value_first, value_last

    call check_separators(line, reason)
    if (allocated(reason)) return
    k = begin_columns(line)
    call next_column(line, k, first, last, separator)
    call read_label(line(first:last), 'node', 1, huge(1), node, reason)
    call next_column(line, k, first, last, separator)
    if (.not. allocated(reason) .and. (last < first .or. verify(line(first:last), AXES//'123456') > 0)) &
      reason = quoted(line(first:last))//' is no list of directions, such as xyz or 123'
    value = 0.0_dp
    call next_column(line, k, value_first, value_last, separator)
    if (value_last >= value_first) call read_value(line(value_first:value_last), value, reason)
    if (k <= len(line) .and. .not. allocated(reason)) reason = 'more columns than node, directions and displacement'
    if (allocated(reason)) return
    do i = first, last
      direction = index(AXES, line(i:i))
      if (direction > 3) direction = direction - 3
      if (direction == 0) direction = iachar(line(i:i)) - iachar('0')
      call held%hold(node, direction, value, origin, paths, reason, status)
    end do
  end subroutine read_support

end module fuge_deck_tables
