!> Supports and loads at nodes: from the command line, from tables, and from input files.
module mesh_conditions
  use command_line, only: arguments, refuse, setting
  use fuge_core, only: dp => fuge_dp, fuge_info
  use mesh_body, only: model_body, DIRECTIONS
  use mesh_names, only: find_nodes, upper_case
  use mesh_pressures, only: take_pressure
  use number_words, only: number_text, read_real
  use text_lines, only: line_reader
  implicit none
  private

  public :: take_conditions

  character(len=*), parameter :: AXES = 'xyzXYZ123456'
  character(len=*), parameter :: AXIS_NAMES(DIRECTIONS) = [character(len=7) :: 'x', 'y', 'z', 'about x', 'about y', &
    'about z']

  !> Longest column of a table.
  integer, parameter :: COLUMN_LENGTH = 120

  !> Supports of the degrees of freedom of a body, while they are collected.
  type :: support_list
    logical, allocatable :: held(:)
    real(dp), allocatable :: displacement(:)
  end type support_list

  !> One line: nodes, axes and a value.
  type :: condition
    character(len=:), allocatable :: nodes, source
    logical :: axes(DIRECTIONS) = .false.
    logical :: is_load = .false.
    logical :: has_value = .false.
    real(dp) :: value = 0.0_dp
  end type condition

contains

  !> Put all supports and loads into the matrices of the bodies.
  subroutine take_conditions(given, bodies, info)
    type(arguments), intent(in) :: given
    type(model_body), intent(inout) :: bodies(:)
    type(fuge_info), intent(inout) :: info
    type(support_list), allocatable :: supports(:)
    integer :: k

    allocate (supports(size(bodies)))
    do k = 1, size(bodies)
      allocate (supports(k)%held(bodies(k)%degrees()), source=.false.)
      allocate (supports(k)%displacement(bodies(k)%degrees()), source=0.0_dp)
      allocate (bodies(k)%matrix%load(bodies(k)%degrees()), source=0.0_dp)
    end do
    do k = 1, given%count
      select case (given%settings(k)%name)
      case ('support', 'load')
        call take_word(given%settings(k), bodies, supports, info)
      case ('pressure')
        call take_pressure(given%settings(k), bodies, info)
      case ('supports', 'loads')
        call take_file(given, k, bodies, supports, info)
      end select
      if (info%failed()) return
    end do
    do k = 1, size(bodies)
      bodies(k)%matrix%fixed = held_rows(supports(k)%held)
      bodies(k)%matrix%displacement = pack(supports(k)%displacement, supports(k)%held)
    end do
  end subroutine take_conditions

  pure function held_rows(held) result(rows)
    logical, intent(in) :: held(:)
    integer :: rows(count(held))
    integer :: k, n

    n = 0
    do k = 1, size(held)
      if (.not. held(k)) cycle
      n = n + 1
      rows(n) = k
    end do
  end function held_rows

  !> NODES:AXES or NODES:AXES=VALUE.
  subroutine take_word(option, bodies, supports, info)
    type(setting), intent(in) :: option
    type(model_body), intent(inout) :: bodies(:)
    type(support_list), intent(inout) :: supports(:)
    type(fuge_info), intent(inout) :: info
    type(condition) :: one
    integer :: colon, equals

    one%is_load = option%name == 'load'
    one%source = option%source
    associate (word => option%value)
      colon = index(word, ':', back=.true.)
      equals = max(colon, 0) + index(word(colon + 1:)//'=', '=')
      if (colon < 2) then
        call refuse(one%source//': nodes and an axis are needed, like '//example(one%is_load), info)
        return
      end if
      one%nodes = word(:colon - 1)
      call read_axes(word(colon + 1:equals - 1), one, info)
      if (equals <= len(word) .and. .not. info%failed()) call read_value(word(equals + 1:), one, info)
      if (one%is_load .and. .not. one%has_value .and. .not. info%failed()) &
        call refuse(one%source//': a force is needed, like '//example(one%is_load), info)
    end associate
    if (.not. info%failed()) call apply(one, bodies, supports, info)
  end subroutine take_word

  pure function example(is_load) result(text)
    logical, intent(in) :: is_load
    character(len=:), allocatable :: text

    text = 'hub.BOTTOM:xyz or hub.17:z=0.1'
    if (is_load) text = 'hub.TOP:z=-100'
  end function example

  !> Axes: letters or numbers, one or several.
  pure subroutine read_axes(word, one, info)
    character(len=*), intent(in) :: word
    type(condition), intent(inout) :: one
    type(fuge_info), intent(inout) :: info
    integer :: axis, k

    if (len(word) == 0 .or. verify(word, AXES) > 0) then
      call refuse(one%source//': "'//word//'" is no axis: x, y, z, or 1 to 6', info)
      return
    end if
    do k = 1, len(word)
      axis = index(AXES, word(k:k))
      if (axis > 6) then
        axis = axis - 6
      else if (axis > 3) then
        axis = axis - 3
      end if
      one%axes(axis) = .true.
    end do
  end subroutine read_axes

  pure subroutine read_value(word, one, info)
    character(len=*), intent(in) :: word
    type(condition), intent(inout) :: one
    type(fuge_info), intent(inout) :: info

    call read_real(word, one%value, one%has_value)
    if (.not. one%has_value) call refuse(one%source//': a number is needed, not "'//word//'"', info)
  end subroutine read_value

  !> Lines of a table, NODES, AXES and VALUE, or those under *BOUNDARY or *CLOAD of an input file.
  !> Option k is FILE, or BODY=FILE, whose nodes are all of that body.
  subroutine take_file(given, k, bodies, supports, info)
    type(arguments), intent(in) :: given
    integer, intent(in) :: k
    type(model_body), intent(inout) :: bodies(:)
    type(support_list), intent(inout) :: supports(:)
    type(fuge_info), intent(inout) :: info
    type(line_reader) :: file
    character(len=:), allocatable :: body, keyword, path
    integer :: taken
    logical :: exists, is_load

    keyword = ''
    taken = 0
    is_load = given%settings(k)%name == 'loads'
    call split_path(given%settings(k), bodies, body, path)
    call file%open(path, info)
    do while (.not. info%failed())
      call file%next(exists, info)
      if (.not. exists) exit
      if (index(file%line, '*') == 1) then
        keyword = upper_case(file%line(2:scan(file%line//',', ', ') - 1))
        if (file%line(2:) == '') keyword = '*'
        cycle
      else if (keyword /= '' .and. keyword /= trim(merge('CLOAD   ', 'BOUNDARY', is_load))) then
        cycle
      end if
      call take_line(file%line, file%source(), body, is_load, keyword /= '', taken == 0, bodies, supports, info)
      taken = taken + 1
    end do
    call file%close()
    if (taken == 0 .and. .not. info%failed()) call refuse('"'//path//'" has no line like '//trim(merge( &
      '17,z,-100: a load', '17,z: a support  ', is_load)), info)
  end subroutine take_file

  !> The body, with a point, and the path of BODY=FILE; no body of FILE.
  subroutine split_path(option, bodies, body, path)
    type(setting), intent(in) :: option
    type(model_body), intent(in) :: bodies(:)
    character(len=:), allocatable, intent(out) :: body, path
    integer :: equals, k

    body = ''
    path = option%value
    equals = index(path, '=')
    do k = 1, size(bodies)
      if (equals == 0) exit
      if (upper_case(bodies(k)%name) /= upper_case(path(:equals - 1))) cycle
      body = bodies(k)%name//'.'
      path = path(equals + 1:)
      exit
    end do
    if (index(path, '/') /= 1) path = option%folder//path
  end subroutine split_path

  !> One line of a table: nodes, axes and a value. Nodes are of `body`, if it is not empty. `of_deck`: from an input
  !> file, where supports have a first and a last direction. The first line of a table may be a heading. The arguments
  !> are nine, because tables of options and of input files share it.
  subroutine take_line(line, source, body, is_load, of_deck, is_first, bodies, supports, info)
    character(len=*), intent(in) :: line, source, body
    logical, intent(in) :: is_load, of_deck, is_first
    type(model_body), intent(inout) :: bodies(:)
    type(support_list), intent(inout) :: supports(:)
    type(fuge_info), intent(inout) :: info
    type(condition) :: one
    character(len=COLUMN_LENGTH) :: columns(4)
    integer :: n

    one%source = source
    one%is_load = is_load
    call split_line(line, columns, n)
    if (n < 2 .or. n > merge(4, 3, of_deck .and. .not. is_load) &
        .or. (is_load .and. n < 3)) then
      if (is_load) then
        call refuse(source//': nodes, an axis and a force are needed, like 17,z,-100', info)
      else
        call refuse(source//': nodes, an axis and perhaps a displacement are needed, like 17,z,0.1', info)
      end if
      return
    end if
    if (is_first .and. .not. of_deck .and. index(upper_case(columns(1)), 'NODE') == 1) return
    one%nodes = body//trim(columns(1))
    call read_axes(trim(columns(2)), one, info)
    if (of_deck .and. .not. is_load) then
      if (n > 2 .and. .not. info%failed()) then
        if (columns(3) /= '') call read_last_axis(trim(columns(3)), one, info)
      end if
      if (n > 3 .and. .not. info%failed()) call read_value(trim(columns(4)), one, info)
    else if (n > 2 .and. .not. info%failed()) then
      call read_value(trim(columns(3)), one, info)
    end if
    if (.not. info%failed()) call apply(one, bodies, supports, info)
  end subroutine take_line

  !> All directions from the first one to this.
  pure subroutine read_last_axis(word, one, info)
    character(len=*), intent(in) :: word
    type(condition), intent(inout) :: one
    type(fuge_info), intent(inout) :: info
    type(condition) :: last
    integer :: first_axis, last_axis

    last%source = one%source
    call read_axes(word, last, info)
    if (info%failed()) return
    first_axis = findloc(one%axes, .true., dim=1)
    last_axis = findloc(last%axes, .true., dim=1)
    if (last_axis < first_axis) call refuse(one%source//': the last direction is less than the first one', info)
    one%axes(first_axis:last_axis) = .true.
  end subroutine read_last_axis

  !> The columns of a line, separated by commas or semicolons, or else by blanks, and their number; an empty last one
  !> does not count.
  pure subroutine split_line(line, columns, count)
    character(len=*), intent(in) :: line
    character(len=*), intent(out) :: columns(:)
    integer, intent(out) :: count
    character(len=len(line)) :: rest
    character :: separator
    integer :: length

    separator = ' '
    if (index(line, ';') > 0) separator = ';'
    if (index(line, ',') > 0) separator = ','
    columns = ''
    count = 0
    rest = adjustl(line)
    do while (len_trim(rest) > 0)
      length = index(rest//separator, separator) - 1
      count = count + 1
      if (count <= size(columns)) columns(count) = adjustl(rest(:length))
      rest = adjustl(rest(min(length + 2, len(rest) + 1):))
    end do
  end subroutine split_line

  !> Add a support or a load to the body it names.
  subroutine apply(one, bodies, supports, info)
    type(condition), intent(in) :: one
    type(model_body), intent(inout) :: bodies(:)
    type(support_list), intent(inout) :: supports(:)
    type(fuge_info), intent(inout) :: info
    integer, allocatable :: nodes(:)
    integer :: axis, body, found, k, row

    call find_nodes(one%nodes, one%source, bodies, body, nodes, info)
    if (info%failed()) return
    if (bodies(body)%elastic == 0) then
      call refuse(one%source//': body '//bodies(body)%name//' has no --stiffness: it is rigid and stands still', info)
      return
    end if
    do axis = 1, DIRECTIONS
      if (.not. one%axes(axis)) cycle
      found = 0
      do k = 1, size(nodes)
        row = bodies(body)%row(axis, nodes(k))
        if (row > 0) then
          found = found + 1
          if (one%is_load) then
            bodies(body)%matrix%load(row) = bodies(body)%matrix%load(row) + one%value
          else
            call hold(one, row, degree_name(bodies(body), nodes(k), axis), supports(body), info)
          end if
        else if (one%is_load .or. abs(one%value) > 0.0_dp) then
          call refuse(one%source//': '//degree_name(bodies(body), nodes(k), axis)//' has no row in the stiffness: ' &
                      //'its program has held it, or it does not move that way', info)
        end if
        if (info%failed()) return
      end do
      if (found > 0) cycle
      call refuse(one%source//': no node there has a row along '//trim(AXIS_NAMES(axis))//' in the stiffness: its ' &
                  //'program has held them, or the axis is wrong', info)
      return
    end do
  end subroutine apply

  !> Hold one degree of freedom, `name`.
  subroutine hold(one, row, name, supports, info)
    type(condition), intent(in) :: one
    integer, intent(in) :: row
    character(len=*), intent(in) :: name
    type(support_list), intent(inout) :: supports
    type(fuge_info), intent(inout) :: info

    if (supports%held(row) .and. abs(supports%displacement(row) - one%value) > 0.0_dp) then
      call refuse(one%source//': '//name//' is displaced by another value already', info)
      return
    end if
    supports%held(row) = .true.
    supports%displacement(row) = one%value
  end subroutine hold

  !> A node and an axis, for messages.
  pure function degree_name(body, node, axis) result(name)
    type(model_body), intent(in) :: body
    integer, intent(in) :: node, axis
    character(len=:), allocatable :: name

    name = 'node '//body%name//'.'//number_text(body%mesh%node(node))//' along '//trim(AXIS_NAMES(axis))
  end function degree_name

end module mesh_conditions
