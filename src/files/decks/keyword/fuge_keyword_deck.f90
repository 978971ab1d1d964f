!> Decks of Abaqus and CalculiX: gap elements, supports, and steps as load cases.
module fuge_keyword_deck
  use fuge_condition_table, only: condition_table
  use fuge_deck_type, only: fuge_deck, fuge_deck_case, place_text
  use fuge_input_deck, only: input_deck, upper_case, LINE_DATA, LINE_END, LINE_KEYWORD
  use fuge_keyword_conditions, only: read_boundary_line, read_load_line
  use fuge_keyword_gaps, only: gap_line, is_gap, make_gap_link, read_gap_line
  use fuge_mesh_files, only: fuge_read_mesh
  use fuge_mesh_sets, only: fuge_mesh_element_set
  use fuge_mesh_type, only: fuge_mesh
  use fuge_number_text, only: text
  use fuge_row_table, only: row_table
  use fuge_status, only: fuge_info, report, FUGE_ERR_FILE, FUGE_ERR_MEMORY
  use fuge_text_numbers, only: quoted
  use fuge_text_reader, only: quoted_path
  implicit none
  private

  public :: read_keyword_deck

  !> What the data lines under a keyword are.
  integer, parameter :: DATA_SKIPPED = 0, DATA_GAP = 1, DATA_BOUNDARY = 2, DATA_LOADS = 3
  !> Keywords for contact, one-way materials, turned directions and cases within a step, without which the answer would
  !> be another one.
  character(len=16), parameter :: REFUSED(13) = [character(len=16) :: 'TRANSFORM', 'CONTACTPAIR', 'CONTACT', &
    'CONTACTINCLUSION', 'LOADCASE', 'NOCOMPRESSION', 'NOTENSION', 'CONNECTORSTOP', 'CONNECTORLOCK', 'SLIDELINE', &
    'RIGIDSURFACE', 'ANALYTICALSURFAC', 'MODELCHANGE']
  !> Loads of a step that are no forces at nodes.
  character(len=16), parameter :: UNREAD_LOADS(10) = [character(len=16) :: 'DLOAD', 'DSLOAD', 'TEMPERATURE', &
    'FIELD', 'BASEMOTION', 'CONNECTORLOAD', 'CONNECTORMOTION', 'INERTIARELIEF', 'CFLUX', 'DFLUX']
  !> Parameters of supports and loads that are not read.
  character(len=12), parameter :: UNREAD_PARAMETERS(12) = [character(len=12) :: 'AMPLITUDE', 'USER', 'FIXED', 'TYPE', &
    'SUBMODEL', 'FILE', 'SECTOR', 'FOLLOWER', 'LOADCASE', 'TIMEDELAY', 'OMEGA0', 'REGION']
  !> Parameters of a keyword line are cut to this length.
  integer, parameter :: WORD_LENGTH = 16

  !> Where the reader is, and what it has.
  type :: deck_state
    integer :: content = DATA_SKIPPED
    !> Number of the step, 0 in the model; its data may be those of a static step.
    integer :: step = 0
    logical :: in_step = .false., static = .false., other_procedure = .false.
    !> OP of the first *BOUNDARY and of the first *CLOAD of this step; blank before them.
    character(len=3) :: boundary_op = '', load_op = ''
    !> What this step, or an earlier one that is no load case, has that is not read: an error of the next load case.
    type(fuge_info) :: unread
    !> All three as they were before the step; after one of perturbations, by PERTURBATION or by its procedure, they
    !> are so again.
    logical :: perturbation = .false.
    type(condition_table) :: held_before, forces_before
    type(fuge_info) :: unread_before
    type(condition_table) :: held, forces
    !> Elements of the *GAP, indices in the mesh, and which elements have one.
    integer, allocatable :: elements(:)
    !> Place of the last *GAP.
    integer :: gap_place(2) = 0
    logical, allocatable :: has_gap(:)
    type(row_table) :: numbers
    integer :: links = 0, cases = 0, status = 0
    !> Was the last keyword *GAP?
    logical :: after_gap = .false.
  end type deck_state

contains

  !> Read a deck. Errors, `deck` unfinished: FUGE_ERR_FILE, with file, line and reason; FUGE_ERR_MEMORY.
  subroutine read_keyword_deck(path, deck, info)
    character(len=*), intent(in) :: path
    type(fuge_deck), intent(inout) :: deck
    type(fuge_info), intent(inout) :: info
    type(input_deck) :: input
    type(fuge_mesh) :: mesh
    type(deck_state) :: state
    integer :: k, number

    call fuge_read_mesh(path, mesh, info)
    if (info%failed()) return
    allocate (state%has_gap(size(mesh%element)), source=.false., stat=state%status)
    do k = 1, size(mesh%node)
      if (state%status == 0) call state%numbers%number_of(mesh%node(k), 0, number, state%status)
    end do
    if (state%status == 0) allocate (deck%links(count_gaps(mesh)), deck%cases(8), stat=state%status)
    call input%open(path, info)
    if (state%status == 0 .and. .not. info%failed()) call read_lines(input, mesh, deck, state, info)
    if (.not. info%failed()) call check_gaps(mesh, state%has_gap, input%file(1)%name, info)
    if (state%status /= 0 .and. .not. info%failed()) &
      call report(info, FUGE_ERR_MEMORY, quoted_path(path)//': no memory for the deck')
    if (info%failed()) return
    deck%links = deck%links(:state%links)
    deck%cases = deck%cases(:state%cases)
    deck%paths = input%paths
  end subroutine read_keyword_deck

  !> Number of gap elements.
  pure function count_gaps(mesh) result(n)
    type(fuge_mesh), intent(in) :: mesh
    integer :: n
    integer :: k

    n = 0
    do k = 1, size(mesh%element)
      if (is_gap(mesh%element_type(k))) n = n + 1
    end do
  end function count_gaps

  !> Refuse gap elements of other types, and those without *GAP.
  pure subroutine check_gaps(mesh, has_gap, name, info)
    type(fuge_mesh), intent(in) :: mesh
    logical, intent(in) :: has_gap(:)
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info
    integer :: k

    do k = 1, size(mesh%element)
      if (is_gap(mesh%element_type(k)) .and. .not. has_gap(k)) then
        call report(info, FUGE_ERR_FILE, name//': '//trim(mesh%element_type(k))//' '//text(mesh%element(k)) &
                    //' has no *GAP with its element set')
      else if (index(mesh%element_type(k), 'GAP') == 1 .and. .not. is_gap(mesh%element_type(k))) then
        call report(info, FUGE_ERR_FILE, name//': element '//text(mesh%element(k))//' is a gap of type ' &
                    //trim(mesh%element_type(k))//': GAPUNI, GAPCYL and GAPSPHER are read')
      end if
      if (info%failed()) return
    end do
  end subroutine check_gaps

  !> Read all lines.
  subroutine read_lines(input, mesh, deck, state, info)
    type(input_deck), intent(inout) :: input
    type(fuge_mesh), intent(in) :: mesh
    type(fuge_deck), intent(inout) :: deck
    type(deck_state), intent(inout) :: state
    type(fuge_info), intent(inout) :: info
    integer :: line_kind

    do
      call input%next(line_kind, info)
      if (info%failed()) return
      if (line_kind == LINE_DATA) then
        if (state%content /= DATA_SKIPPED) call read_data(input, mesh, deck, state, info)
      else if (line_kind == LINE_KEYWORD) then
        call begin_block(input, mesh, deck, state, info)
      end if
      if (info%failed() .or. state%status /= 0) return
      if (line_kind == LINE_END) exit
    end do
    call check_gap_data(input, state, info)
    call end_step(deck, state, info)
    ! Without a step the supports are still to be kept.
    if (state%step == 0) call state%held%copy_to(deck%supports, state%status)
  end subroutine read_lines

  subroutine read_data(input, mesh, deck, state, info)
    type(input_deck), intent(inout) :: input
    type(fuge_mesh), intent(in) :: mesh
    type(fuge_deck), intent(inout) :: deck
    type(deck_state), intent(inout) :: state
    type(fuge_info), intent(inout) :: info
    character(len=:), allocatable :: reason
    integer :: origin(3)

    associate (file => input%file(input%depth))
      origin = [input%place(), state%step]
      select case (state%content)
      case (DATA_GAP)
        call make_links(file%content(file%first:file%last), mesh, origin, deck, state, reason)
        state%content = DATA_SKIPPED
      case (DATA_BOUNDARY)
        call read_boundary_line(file%content(file%first:file%last), mesh, state%numbers, origin, input%paths, &
                                state%held, reason, state%status)
      case (DATA_LOADS)
        call read_load_line(file%content(file%first:file%last), mesh, state%numbers, origin, state%forces, reason, &
                            state%status)
      end select
    end associate
    if (allocated(reason)) call input%refuse('*'//trim(input%keyword)//': '//reason, info)
  end subroutine read_data

  !> The links of the elements of a *GAP.
  pure subroutine make_links(line, mesh, origin, deck, state, reason)
    character(len=*), intent(in) :: line
    type(fuge_mesh), intent(in) :: mesh
    integer, intent(in) :: origin(3)
    type(fuge_deck), intent(inout) :: deck
    type(deck_state), intent(inout) :: state
    character(len=:), allocatable, intent(out) :: reason
    type(gap_line) :: data
    integer :: i, k, node(2)

    call read_gap_line(line, data, reason)
    do i = 1, size(state%elements)
      if (allocated(reason)) return
      k = state%elements(i)
      if (.not. is_gap(mesh%element_type(k))) then
        reason = 'element '//text(mesh%element(k))//' is no gap, but of type '//mesh%element_type(k)
      else if (state%has_gap(k)) then
        reason = 'element '//text(mesh%element(k))//' has a *GAP already'
      else if (mesh%first(k + 1) - mesh%first(k) /= 2) then
        reason = 'element '//text(mesh%element(k))//' has '//text(mesh%first(k + 1) - mesh%first(k)) &
          //' nodes: a gap has two'
      end if
      if (allocated(reason)) return
      state%has_gap(k) = .true.
      node = mesh%connection(mesh%first(k):mesh%first(k) + 1)
      state%links = state%links + 1
      call make_gap_link(trim(mesh%element_type(k)), mesh%element(k), mesh%node(node), mesh%position(:, node), data, &
                         deck%links(state%links), reason)
      if (allocated(reason)) reason = trim(mesh%element_type(k))//' '//text(mesh%element(k))//': '//reason
      deck%links(state%links)%file = origin(1)
      deck%links(state%links)%line = origin(2)
    end do
  end subroutine make_links

  !> Act on a keyword line, and set what its data lines are.
  subroutine begin_block(input, mesh, deck, state, info)
    type(input_deck), intent(inout) :: input
    type(fuge_mesh), intent(in) :: mesh
    type(fuge_deck), intent(inout) :: deck
    type(deck_state), intent(inout) :: state
    type(fuge_info), intent(inout) :: info
    character(len=WORD_LENGTH) :: word
    logical :: after_gap

    call check_gap_data(input, state, info)
    if (info%failed()) return
    after_gap = state%after_gap
    state%after_gap = input%keyword == 'GAP'
    state%content = DATA_SKIPPED
    word = input%keyword(:WORD_LENGTH)
    select case (input%keyword)
    case ('INCLUDE')
      call input%include(trim(input%parameter('INPUT')), info)
    case ('STEP')
      call begin_step(input, deck, state, info)
    case ('ENDSTEP')
      call end_step(deck, state, info)
    case ('STATIC')
      state%static = .true.
    case ('FREQUENCY', 'BUCKLE', 'MODALDYNAMIC', 'STEADYSTATEDYNAMICS', 'COMPLEXFREQUENCY', 'RANDOMRESPONSE', &
          'RESPONSESPECTRUM', 'SUBSTRUCTUREGENERATE', 'MATRIXGENERATE', 'GREEN')
      state%other_procedure = .true.
      state%perturbation = .true.
    case ('DYNAMIC', 'DYNAMICTEMPERATURE-DISPLACEMENT', 'HEATTRANSFER', 'MASSDIFFUSION', 'STEADYSTATETRANSPORT', &
          'DIRECTCYCLIC', 'ANNEAL', 'COUPLEDTHERMAL-ELECTRICAL', 'ELECTROMAGNETIC', 'ELECTROMAGNETICS', 'CFD', &
          'NOANALYSIS', 'SENSITIVITY', 'FEASIBLEDIRECTION', 'ROBUSTDESIGN', 'CRACKPROPAGATION')
      state%other_procedure = .true.
    case ('GAP')
      call fuge_mesh_element_set(mesh, trim(input%parameter('ELSET')), state%elements, info)
      if (info%failed()) call refuse_set(input, info)
      state%content = DATA_GAP
      state%gap_place = input%place()
    case ('BOUNDARY')
      call begin_conditions(input, state%boundary_op, state%held, state%unread, info)
      ! Supports of the model are those of all load cases.
      if (state%unread%failed() .and. .not. (state%in_step .or. info%failed())) info = state%unread
      state%content = DATA_BOUNDARY
    case ('CLOAD')
      if (.not. state%in_step) call input%refuse('*CLOAD is needed in a *STEP', info)
      call begin_conditions(input, state%load_op, state%forces, state%unread, info)
      state%content = DATA_LOADS
    case ('INITIALCONDITIONS')
      if (upper_case(input%parameter('TYPE')) == 'STRESS') &
        call input%refuse('initial stresses are not read: give their forces at nodes by *CLOAD', info)
    case ('SPRING')
      if (input%has('NONLINEAR')) call input%refuse('nonlinear springs are not read: give one-way springs as GAPUNI ' &
        //'with a stiffness, or in a table of links', info)
    case ('FRICTION')
      if (after_gap) call input%refuse('gaps with friction are not read: fuge has no friction', info)
    case ('MATERIAL')
      if (index(upper_case(input%parameter('NAME')), 'COMPRESSION_ONLY') == 1 &
          .or. index(upper_case(input%parameter('NAME')), 'TENSION_ONLY') == 1) &
        call input%refuse('materials for one sign only are not read: give struts and cables as GAPUNI with a ' &
                          //'stiffness, or in a table of links', info)
    case default
      if (any(word == REFUSED)) then
        call input%refuse('*'//trim(input%keyword)//' is not read here: of contact the gap elements are, and each ' &
                          //'*STEP is a load case', info)
      else if (state%in_step .and. any(word == UNREAD_LOADS)) then
        call keep_refusal(input, '*'//trim(input%keyword)//' is not read: give its forces at nodes by *CLOAD', &
                          state%unread)
      end if
    end select
  end subroutine begin_block

  !> Refuse a *GAP whose data line has not come (FUGE_ERR_FILE).
  pure subroutine check_gap_data(input, state, info)
    type(input_deck), intent(in) :: input
    type(deck_state), intent(in) :: state
    type(fuge_info), intent(inout) :: info
    character(len=:), allocatable :: place

    if (state%content /= DATA_GAP .or. info%failed()) return
    call place_text(input%paths, state%gap_place(1), state%gap_place(2), place)
    call report(info, FUGE_ERR_FILE, place//': *GAP: its data line is missing')
  end subroutine check_gap_data

  !> Replace the message for a set that the mesh does not have.
  pure subroutine refuse_set(input, info)
    type(input_deck), intent(in) :: input
    type(fuge_info), intent(inout) :: info
    type(fuge_info) :: refused

    if (input%parameter('ELSET') == '') then
      call input%refuse('*GAP needs ELSET = and a name', refused)
    else
      call input%refuse('*GAP: the element set '//quoted(trim(input%parameter('ELSET')))//' is not defined', refused)
    end if
    info = refused
  end subroutine refuse_set

  !> A step begins. What the model holds is held in tables of further load cases too.
  subroutine begin_step(input, deck, state, info)
    type(input_deck), intent(inout) :: input
    type(fuge_deck), intent(inout) :: deck
    type(deck_state), intent(inout) :: state
    type(fuge_info), intent(inout) :: info

    call end_step(deck, state, info)
    if (state%step == 0) call state%held%copy_to(deck%supports, state%status)
    state%perturbation = input%has('PERTURBATION')
    state%held_before = state%held
    state%forces_before = state%forces
    state%unread_before = state%unread
    if (state%perturbation) &
      call keep_refusal(input, 'a *STEP with PERTURBATION is not read: contact depends on the whole load', state%unread)
    state%step = state%step + 1
    state%in_step = .true.
    state%static = .false.
    state%other_procedure = .false.
    state%boundary_op = ''
    state%load_op = ''
  end subroutine begin_step

  !> Keep the first reason why the step cannot be a load case, with its line: its procedure may follow.
  pure subroutine keep_refusal(input, reason, unread)
    type(input_deck), intent(in) :: input
    character(len=*), intent(in) :: reason
    type(fuge_info), intent(inout) :: unread

    if (.not. unread%failed()) call input%refuse(reason, unread)
  end subroutine keep_refusal

  !> Supports or loads of a keyword: with OP=NEW those of earlier steps end, if it is that of the first one in the step;
  !> Abaqus wants it on all of them.
  pure subroutine begin_conditions(input, first_op, conditions, unread, info)
    type(input_deck), intent(in) :: input
    character(len=3), intent(inout) :: first_op
    type(condition_table), intent(inout) :: conditions
    type(fuge_info), intent(inout) :: unread, info
    type(condition_table) :: none
    character(len=WORD_LENGTH) :: op
    integer :: k

    op = upper_case(input%parameter('OP'))
    do k = 1, size(UNREAD_PARAMETERS)
      if (.not. input%has(trim(UNREAD_PARAMETERS(k)))) cycle
      if (UNREAD_PARAMETERS(k) == 'TYPE' .and. upper_case(input%parameter('TYPE')) == 'DISPLACEMENT') cycle
      call keep_refusal(input, '*'//trim(input%keyword)//': '//trim(UNREAD_PARAMETERS(k))//' is not read: write the ' &
                        //'values at the end of the step', unread)
    end do
    if (op == 'NEW' .and. first_op == 'MOD') then
      call input%refuse('*'//trim(input%keyword)//': OP=NEW belongs to the first *'//trim(input%keyword) &
                        //' of the step', info)
    else if (op == 'NEW' .and. first_op == '') then
      conditions = none
    else if (all(op /= [character(len=3) :: '', 'NEW', 'MOD'])) then
      call input%refuse('*'//trim(input%keyword)//': OP='//trim(op)//' is not read, only NEW and MOD', info)
    end if
    if (first_op == '') first_op = merge('NEW', 'MOD', op == 'NEW')
  end subroutine begin_conditions

  !> Keep a static step as a load case, or report what it has that is not read; other procedures are none.
  pure subroutine end_step(deck, state, info)
    type(fuge_deck), intent(inout) :: deck
    type(deck_state), intent(inout) :: state
    type(fuge_info), intent(inout) :: info
    type(fuge_deck_case), allocatable :: longer(:)

    if (info%failed() .or. .not. state%in_step) return
    state%in_step = .false.
    if (state%other_procedure .and. .not. state%static) then
      if (.not. state%perturbation) return
      state%held = state%held_before
      state%forces = state%forces_before
      state%unread = state%unread_before
      return
    end if
    if (state%unread%failed()) info = state%unread
    if (info%failed()) return
    if (state%cases == size(deck%cases) .and. state%status == 0) then
      allocate (longer(2*state%cases), stat=state%status)
      if (state%status /= 0) return
      longer(:state%cases) = deck%cases
      call move_alloc(longer, deck%cases)
    end if
    if (state%status /= 0) return
    state%cases = state%cases + 1
    deck%cases(state%cases)%name = 'STEP '//text(state%step)
    call state%forces%copy_to(deck%cases(state%cases)%loads, state%status)
    call state%held%copy_to(deck%cases(state%cases)%supports, state%status)
  end subroutine end_step

end module fuge_keyword_deck
