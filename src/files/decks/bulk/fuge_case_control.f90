!> The case control section of a Nastran deck, the lines before BEGIN BULK: which loads and supports each subcase
!> selects.
module fuge_case_control
  use fuge_bulk_cards, only: next_bulk_line
  use fuge_entry_numbers, only: read_label
  use fuge_input_deck, only: input_deck, upper_case
  use fuge_kinds, only: dp
  use fuge_number_records, only: number_records
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_ERR_MEMORY
  use fuge_text_columns, only: after_blanks
  implicit none
  private

  public :: read_case_control

  !> Commands without which the answer would be another one, and which are not read.
  character(len=12), parameter :: REFUSED(14) = [character(len=12) :: 'SUBCOM', 'SUBSEQ', 'SYM', 'SYMCOM', 'SYMSEQ', &
    'REPCASE', 'STEP', 'TEMPERATURE', 'TEMP', 'DEFORM', 'LOADSET', 'BOLTLD', 'PRETENSION', 'P2G']
  !> Longest word of a command, and number, that are looked at.
  integer, parameter :: WORD_LENGTH = 32

  !> What is selected: subcase, load set, set of supports, set of equations.
  type :: selection
    !> Above the first subcase, for all of them.
    integer :: common(3) = 0
    integer :: subcase(4) = 0
    !> Equations of the first subcase, which are those of the stiffness matrix; negative before it.
    integer :: equations = -1
    integer :: place(2) = [1, 0]
    logical :: inside = .false.
    integer :: status = 0
  end type selection

contains

  !> Read the subcases: their numbers, load sets and sets of supports (0: none) are `whole` of each record; that of
  !> subcase 0 is what all of them select. A deck without BEGIN BULK is bulk data alone, and none of it is read.
  !> Subcases with different sets of equations, MPC, are refused: one stiffness matrix serves all of them.
  !> Errors: FUGE_ERR_FILE, FUGE_ERR_MEMORY.
  subroutine read_case_control(deck, subcases, info)
    type(input_deck), intent(inout) :: deck
    type(number_records), intent(inout) :: subcases
    type(fuge_info), intent(inout) :: info
    type(selection) :: state
    character(len=:), allocatable :: reason
    integer :: length
    logical :: bulk, exists

    call find_bulk(deck, exists, info)
    if (info%failed() .or. .not. exists) return
    do
      call next_bulk_line(deck, exists, length, info)
      if (info%failed() .or. .not. exists) exit
      associate (file => deck%file(deck%depth))
        call read_command(file%content(file%first:file%first + length - 1), deck%place(), state, subcases, bulk, reason)
      end associate
      if (allocated(reason)) call deck%refuse(reason, info)
      if (info%failed() .or. bulk) exit
    end do
    if (info%failed()) return
    if (state%inside) call keep_subcase(state, subcases, reason)
    state%subcase = [0, state%common(:2), max(state%equations, 0)]
    call keep_subcase(state, subcases, reason)
    if (allocated(reason)) call deck%refuse(reason, info)
    if (state%status /= 0) call report(info, FUGE_ERR_MEMORY, deck%file(1)%name//': no memory for the subcases')
  end subroutine read_case_control

  !> Does the deck, or a file that it includes, have a line BEGIN BULK? The deck is at its beginning again.
  subroutine find_bulk(deck, exists, info)
    type(input_deck), intent(inout) :: deck
    logical, intent(out) :: exists
    type(fuge_info), intent(inout) :: info
    integer :: length

    do
      call next_bulk_line(deck, exists, length, info)
      if (info%failed()) return
      if (.not. exists) exit
      associate (file => deck%file(deck%depth))
        if (begins_bulk(file%content(file%first:file%first + length - 1))) exit
      end associate
    end do
    call deck%rewind()
  end subroutine find_bulk

  pure function begins_bulk(line)
    character(len=*), intent(in) :: line
    logical :: begins_bulk
    character(len=WORD_LENGTH) :: start

    start = upper_case(line(after_blanks(line, 1):min(len(line), after_blanks(line, 1) + WORD_LENGTH - 1)))
    begins_bulk = start(:6) == 'BEGIN ' .and. index(adjustl(start(6:)), 'BULK') == 1
  end function begins_bulk

  !> One line; `bulk` is true of BEGIN BULK.
  pure subroutine read_command(line, place, state, subcases, bulk, reason)
    character(len=*), intent(in) :: line
    integer, intent(in) :: place(2)
    type(selection), intent(inout) :: state
    type(number_records), intent(inout) :: subcases
    logical, intent(out) :: bulk
    character(len=:), allocatable, intent(out) :: reason
    character(len=WORD_LENGTH) :: command, value

    bulk = begins_bulk(line)
    if (bulk) return
    call split_command(line, command, value)
    command = full_command(command)
    select case (command)
    case ('SUBCASE')
      if (state%inside) call keep_subcase(state, subcases, reason)
      state%inside = .true.
      state%place = place
      state%subcase(2:) = state%common
      call read_label(trim(value), 'subcase', 1, huge(1), state%subcase(1), reason)
    case ('LOAD')
      call read_label(trim(value), 'load set', 1, huge(1), state%subcase(2), reason)
      if (.not. state%inside) state%common(1) = state%subcase(2)
    case ('SPC')
      call read_label(trim(value), 'set of supports', 1, huge(1), state%subcase(3), reason)
      if (.not. state%inside) state%common(2) = state%subcase(3)
    case ('MPC')
      call read_label(trim(value), 'set of equations', 1, huge(1), state%subcase(4), reason)
      if (.not. state%inside) state%common(3) = state%subcase(4)
    case default
      if (any(command == REFUSED) .and. index(value, 'INIT') + index(value, 'MATE') == 0) &
        reason = trim(command)//' is not read: give each load case as a SUBCASE with LOAD = and SPC ='
    end select
  end subroutine read_command

  !> The command of which this is an abbreviation, of four letters or more; else the command itself.
  pure function full_command(command) result(full)
    character(len=WORD_LENGTH), intent(in) :: command
    character(len=WORD_LENGTH) :: full
    integer :: k

    full = command
    if (len_trim(command) < 4 .or. command == 'LOAD' .or. any(command == REFUSED)) return
    if (index('SUBCASE', trim(command)) == 1) full = 'SUBCASE'
    do k = 1, size(REFUSED)
      if (full == command .and. index(REFUSED(k), trim(command)) == 1) full = REFUSED(k)
    end do
  end function full_command

  !> The command of a line in upper case, and what stands behind it and behind =.
  pure subroutine split_command(line, command, value)
    character(len=*), intent(in) :: line
    character(len=*), intent(out) :: command, value
    integer :: finish, first, k

    command = ''
    value = ''
    finish = len(line)
    do while (finish > 0)
      if (after_blanks(line(finish:finish), 1) == 1) exit
      finish = finish - 1
    end do
    first = after_blanks(line(:finish), 1)
    if (first > finish) return
    k = scan(line(first:finish)//' ', ' =('//achar(9)) + first - 1
    command = upper_case(line(first:k - 1))
    if (k > finish) return
    value = upper_case(line(k:min(finish, k + WORD_LENGTH - 1)))
    if (index(value, '=') > 0 .and. value(1:1) /= '(') value = value(index(value, '=') + 1:)
    value = adjustl(value)
  end subroutine split_command

  pure subroutine keep_subcase(state, subcases, reason)
    type(selection), intent(inout) :: state
    type(number_records), intent(inout) :: subcases
    character(len=:), allocatable, intent(inout) :: reason
    logical :: is_new

    if (allocated(reason)) return
    if (state%equations < 0) state%equations = state%subcase(4)
    if (state%subcase(4) /= state%equations) then
      reason = 'subcase '//text(state%subcase(1))//' above has other equations, MPC, than the first one: a stiffness ' &
        //'matrix serves those of one set, so read them as decks of their own'
      return
    end if
    call subcases%append_named(state%place, state%subcase(:3), [real(dp) ::], is_new, state%status)
    if (.not. is_new .and. state%status == 0) reason = 'subcase '//text(state%subcase(1))//' above is defined twice'
  end subroutine keep_subcase

end module fuge_case_control
