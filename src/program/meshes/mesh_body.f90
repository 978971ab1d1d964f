!> The bodies of a problem with meshes: what their files have.
module mesh_body
  use command_line, only: arguments, refuse
  use fuge_core, only: fuge_info, FUGE_ERR_FILE, FUGE_ERR_MEMORY
  use fuge_fe, only: fuge_elastic_body
  use fuge_files, only: fuge_mesh, fuge_read_mesh, fuge_read_stiffness
  use number_index, only: index_of_numbers
  use number_words, only: number_text
  use option_checks, only: check_input
  use progress_log, only: progress
  implicit none
  private

  public :: read_bodies, refuse_memory

  !> Directions of a row: displacements and rotations.
  integer, parameter, public :: DIRECTIONS = 6
  !> Greater numbers of nodes would make arrays too long that have nodes at their numbers.
  integer, parameter :: LARGEST_NUMBER = 10000000

  type, public :: model_body
    character(len=:), allocatable :: name
    type(fuge_mesh) :: mesh
    !> Where nodes are, by their numbers.
    type(index_of_numbers) :: nodes
    !> Its number among the elastic bodies; 0: rigid.
    integer :: elastic = 0
    type(fuge_elastic_body) :: matrix
    !> Names of the rows, as in the file.
    integer, allocatable :: node_of_row(:), direction_of_row(:)
    !> Row of each direction of each node, (DIRECTIONS, nodes of the mesh); 0: none.
    integer, allocatable :: row(:, :)
    !> Nodes are at their numbers in the arrays of a surface.
    logical :: keeps_numbers = .false.
    !> Where --mesh, --stiffness, --rows and --matrix are among the options; 0: nowhere.
    integer, private :: mesh_option = 0, stiffness_option = 0, rows_option = 0, matrix_option = 0
  contains
    procedure :: degrees
  end type model_body

contains

  !> Number of degrees of freedom.
  pure function degrees(self)
    class(model_body), intent(in) :: self
    integer :: degrees

    degrees = 0
    if (allocated(self%node_of_row)) degrees = size(self%node_of_row)
  end function degrees

  !> Read the files of all bodies.
  subroutine read_bodies(given, bodies, log, info)
    type(arguments), intent(in) :: given
    type(model_body), allocatable, intent(out) :: bodies(:)
    type(progress), intent(in) :: log
    type(fuge_info), intent(inout) :: info
    integer :: elastic, k

    allocate (bodies(given%count))
    call split_options(given, bodies, k, info)
    if (.not. info%failed()) call keep_bodies(k, bodies)
    if (.not. info%failed()) call check_bodies(given, bodies, info)
    elastic = 0
    do k = 1, size(bodies)
      if (info%failed()) return
      if (bodies(k)%stiffness_option > 0) then
        elastic = elastic + 1
        bodies(k)%elastic = elastic
      end if
      call read_body(given, bodies(k), log, info)
    end do
  end subroutine read_bodies

  !> Which options belong to which body; `count` bodies.
  subroutine split_options(given, bodies, count, info)
    type(arguments), intent(in) :: given
    type(model_body), intent(inout) :: bodies(:)
    integer, intent(out) :: count
    type(fuge_info), intent(inout) :: info
    integer :: k

    count = 0
    do k = 1, given%count
      associate (name => given%settings(k)%name)
        if (all(name /= [character(len=12) :: 'body', 'mesh', 'stiffness', 'rows', 'matrix'])) cycle
        if (count == 0 .or. name == 'body') then
          count = count + 1
        else if ((name == 'mesh' .and. bodies(count)%mesh_option > 0) &
                 .or. (name == 'stiffness' .and. bodies(count)%stiffness_option > 0)) then
          count = count + 1
        end if
        call take_option(given%settings(k)%source, name, k, bodies(count), info)
        if (name == 'body') bodies(count)%name = given%settings(k)%value
      end associate
      if (info%failed()) return
    end do
  end subroutine split_options

  !> Note where an option of a body is.
  subroutine take_option(source, name, k, body, info)
    character(len=*), intent(in) :: source, name
    integer, intent(in) :: k
    type(model_body), intent(inout) :: body
    type(fuge_info), intent(inout) :: info
    integer :: before

    before = 0
    select case (name)
    case ('mesh')
      body%mesh_option = k
    case ('stiffness')
      body%stiffness_option = k
    case ('rows')
      before = body%rows_option
      body%rows_option = k
    case ('matrix')
      before = body%matrix_option
      body%matrix_option = k
    end select
    if (before > 0) call refuse(source//': its body has one already', info)
  end subroutine take_option

  subroutine keep_bodies(count, bodies)
    integer, intent(in) :: count
    type(model_body), allocatable, intent(inout) :: bodies(:)
    type(model_body), allocatable :: kept(:)
    integer :: k

    allocate (kept(count))
    do k = 1, count
      if (allocated(bodies(k)%name)) kept(k)%name = bodies(k)%name
      kept(k)%mesh_option = bodies(k)%mesh_option
      kept(k)%stiffness_option = bodies(k)%stiffness_option
      kept(k)%rows_option = bodies(k)%rows_option
      kept(k)%matrix_option = bodies(k)%matrix_option
    end do
    call move_alloc(kept, bodies)
  end subroutine keep_bodies

  !> Refuse bodies without a mesh, and names that are given twice.
  subroutine check_bodies(given, bodies, info)
    type(arguments), intent(in) :: given
    type(model_body), intent(inout) :: bodies(:)
    type(fuge_info), intent(inout) :: info
    integer :: j, k

    do k = 1, size(bodies)
      if (bodies(k)%mesh_option == 0) then
        if (allocated(bodies(k)%name)) then
          call refuse('body "'//bodies(k)%name//'" has no --mesh', info)
        else
          call refuse(given%settings(bodies(k)%stiffness_option)%source//': its body has no --mesh', info)
        end if
        return
      end if
      if (.not. allocated(bodies(k)%name)) bodies(k)%name = base_name(given%path(bodies(k)%mesh_option))
      if (scan(bodies(k)%name, '.:, ') > 0 .or. len(bodies(k)%name) == 0) then
        call refuse('the name of body "'//bodies(k)%name//'" has a point, colon, comma or blank, or no letter: give ' &
                    //'another one by --body', info)
        return
      end if
      do j = 1, k - 1
        if (bodies(j)%name /= bodies(k)%name) cycle
        call refuse('two bodies have the name "'//bodies(k)%name//'": give others by --body', info)
        return
      end do
    end do
  end subroutine check_bodies

  !> The name of a file without folder and endings.
  pure function base_name(path) result(name)
    character(len=*), intent(in) :: path
    character(len=:), allocatable :: name
    integer :: point

    name = path(index(path, '/', back=.true.) + 1:)
    point = index(name, '.')
    if (point > 1) name = name(:point - 1)
  end function base_name

  subroutine read_body(given, body, log, info)
    type(arguments), intent(in) :: given
    type(model_body), intent(inout) :: body
    type(progress), intent(in) :: log
    type(fuge_info), intent(inout) :: info
    integer :: status

    call fuge_read_mesh(given%path(body%mesh_option), body%mesh, info)
    if (.not. info%failed()) call check_included(given, body%mesh, info)
    if (info%failed()) return
    call log%say('mesh of '//body%name//': '//number_text(size(body%mesh%node))//' nodes, ' &
                 //number_text(size(body%mesh%element))//' elements')
    call body%nodes%set(body%mesh%node)
    body%keeps_numbers = minval(body%mesh%node) > 0 .and. maxval(body%mesh%node) <= LARGEST_NUMBER
    allocate (body%row(DIRECTIONS, size(body%mesh%node)), source=0, stat=status)
    if (status /= 0) then
      call refuse_memory('the nodes of '//body%name, info)
    else if (body%elastic > 0) then
      call read_matrix(given, body, log, info)
    end if
  end subroutine read_body

  pure subroutine refuse_memory(what, info)
    character(len=*), intent(in) :: what
    type(fuge_info), intent(inout) :: info

    info%status = FUGE_ERR_MEMORY
    info%message = 'no memory for '//what
  end subroutine refuse_memory

  !> Refuse results that would overwrite a file that the mesh includes.
  subroutine check_included(given, mesh, info)
    type(arguments), intent(in) :: given
    type(fuge_mesh), intent(in) :: mesh
    type(fuge_info), intent(inout) :: info
    integer :: begin, length

    begin = 1
    do while (begin <= len(mesh%paths))
      length = index(mesh%paths(begin:), achar(0)) - 1
      call check_input(given, mesh%paths(begin:begin + length - 1), &
                       'the same file as of --mesh or of an *INCLUDE in it', info)
      begin = begin + length + 1
    end do
  end subroutine check_included

  subroutine read_matrix(given, body, log, info)
    type(arguments), intent(in) :: given
    type(model_body), intent(inout) :: body
    type(progress), intent(in) :: log
    type(fuge_info), intent(inout) :: info
    character(len=:), allocatable :: name, path, rows_path
    integer :: found, k, node

    path = given%path(body%stiffness_option)
    name = ''
    rows_path = ''
    if (body%matrix_option > 0) name = given%settings(body%matrix_option)%value
    if (body%rows_option > 0) rows_path = given%path(body%rows_option)
    call fuge_read_stiffness(path, body%matrix%column, body%matrix%row, body%matrix%value, body%node_of_row, &
                             body%direction_of_row, info, names_path=rows_path, name=name)
    if (info%failed()) return
    call log%say('stiffness of '//body%name//': '//number_text(body%degrees())//' rows, ' &
                 //number_text(size(body%matrix%row))//' entries')
    found = 0
    do k = 1, body%degrees()
      node = 0
      if (body%direction_of_row(k) >= 1 .and. body%direction_of_row(k) <= DIRECTIONS) &
        node = body%nodes%find(body%node_of_row(k))
      if (node == 0) cycle
      body%row(body%direction_of_row(k), node) = k
      found = found + 1
    end do
    if (found > 0) return
    info%status = FUGE_ERR_FILE
    if (all(body%node_of_row == 0)) then
      info%message = '"'//path//'" has rows without names: give the node and the direction of each by --rows'
    else
      info%message = '"'//path//'" has no row of a node of "'//given%path(body%mesh_option)//'": they are not of the ' &
        //'same body'
    end if
  end subroutine read_matrix

end module mesh_body
