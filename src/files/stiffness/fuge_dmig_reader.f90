!> A matrix of Nastran's bulk data, DMIG, as a punch file holds it.
!>
!> A header, DMIG NAME 0 IFO TIN .., says what the matrix is: IFO = 6 symmetric, 1 square; TIN = 1 or 2 real. A column
!> is DMIG NAME GJ CJ and then, four fields each, Gi Ci Ai Bi: node and direction of the row, the value, and its
!> imaginary part. Four fields never part at the end of a line.
module fuge_dmig_reader
  use fuge_bulk_fields, only: bulk_fields, split_bulk_line
  use fuge_entry_numbers, only: read_label, read_value
  use fuge_kinds, only: dp
  use fuge_row_table, only: LARGEST_DIRECTION
  use fuge_status, only: fuge_info, report, FUGE_ERR_FILE
  use fuge_stiffness_entries, only: no_memory, stiffness_entries
  use fuge_text_numbers, only: lower_case, quoted
  use fuge_text_reader, only: text_file
  implicit none
  private

  public :: read_dmig

  !> Forms and types of a header.
  integer, parameter :: SQUARE = 1, SYMMETRIC = 6, DOUBLE_PRECISION = 2

  !> Where in the file the reader is.
  type :: dmig_state
    !> Name of the matrix that is read; blank before the first one if the caller names none.
    character(len=8) :: wanted = ''
    !> The caller names the matrix.
    logical :: chosen = .false.
    !> The lines belong to a column of it: the number of the column.
    logical :: inside = .false.
    integer :: column = 0
    !> Another matrix of the file, for a message.
    character(len=8) :: other = ''
    integer :: status = 0
  end type dmig_state

contains

  !> Read all entries of the matrix called `name`, or of the only one if it is blank.
  !> Errors: FUGE_ERR_FILE with file, line and reason; FUGE_ERR_MEMORY.
  pure subroutine read_dmig(file, name, entries, info)
    type(text_file), intent(inout) :: file
    character(len=*), intent(in) :: name
    type(stiffness_entries), intent(inout) :: entries
    type(fuge_info), intent(inout) :: info
    type(dmig_state) :: state
    character(len=:), allocatable :: reason
    logical :: exists

    state%wanted = name
    state%chosen = len_trim(name) > 0
    do
      call file%advance(exists)
      if (.not. exists) exit
      call read_line(file%content(file%first:file%last), file%line, state, entries, reason)
      if (state%status /= 0) call no_memory(file, info)
      if (allocated(reason)) call file%refuse(reason, info)
      if (info%failed()) return
    end do
    if (entries%count > 0) return
    if (state%chosen .and. state%other /= '') then
      call report(info, FUGE_ERR_FILE, file%name//' has no matrix '//quoted(name)//', but '//quoted(trim(state%other)))
    else
      call report(info, FUGE_ERR_FILE, file%name//' has no entry of a DMIG matrix')
    end if
  end subroutine read_dmig

  pure subroutine read_line(line, number, state, entries, reason)
    character(len=*), intent(in) :: line
    integer, intent(in) :: number
    type(dmig_state), intent(inout) :: state
    type(stiffness_entries), intent(inout) :: entries
    character(len=:), allocatable, intent(out) :: reason
    type(bulk_fields) :: fields
    integer :: k

    call split_bulk_line(line, fields)
    if (fields%skipped) return
    if (.not. fields%continues) then
      state%inside = .false.
      if (fields%keyword == 'dmig') call begin_column(line, fields, state, entries, reason)
    end if
    if (.not. state%inside .or. allocated(reason)) return
    do k = merge(1, 5, fields%continues), fields%count, 4
      call read_row(line, fields%first(k:k + 3), fields%last(k:k + 3), number, state, entries, reason)
      if (allocated(reason) .or. state%status /= 0) return
    end do
  end subroutine read_line

  !> The first four fields of a column, or a header.
  pure subroutine begin_column(line, fields, state, entries, reason)
    character(len=*), intent(in) :: line
    type(bulk_fields), intent(in) :: fields
    type(dmig_state), intent(inout) :: state
    type(stiffness_entries), intent(inout) :: entries
    character(len=:), allocatable, intent(out) :: reason
    character(len=8) :: name
    integer :: direction, node

    name = line(fields%first(1):fields%last(1))
    if (name == '') then
      reason = 'the name of the matrix is missing: DMIG and the name are needed'
      return
    end if
    if (state%wanted == '') state%wanted = name
    if (lower_case(name) /= lower_case(state%wanted)) then
      state%other = name
      if (.not. state%chosen) reason = 'the file holds the matrices '//quoted(trim(state%wanted))//' and ' &
        //quoted(trim(name))//': pass the name of the one to read'
      return
    end if
    call read_label(line(fields%first(2):fields%last(2)), 'node', 0, huge(1), node, reason)
    if (allocated(reason)) return
    if (node == 0) then
      call check_header(line, fields, entries, reason)
      return
    end if
    call read_component(line(fields%first(3):fields%last(3)), direction, reason)
    if (allocated(reason)) return
    call entries%names%number_of(node, direction, state%column, state%status)
    state%inside = .true.
  end subroutine begin_column

  !> Refuse a header of a matrix that is complex or rectangular.
  pure subroutine check_header(line, fields, entries, reason)
    character(len=*), intent(in) :: line
    type(bulk_fields), intent(in) :: fields
    type(stiffness_entries), intent(inout) :: entries
    character(len=:), allocatable, intent(inout) :: reason
    integer :: form, number_type

    call read_label(line(fields%first(3):fields%last(3)), 'form IFO', 0, huge(1), form, reason)
    call read_label(line(fields%first(4):fields%last(4)), 'type TIN', 0, huge(1), number_type, reason)
    if (allocated(reason)) return
    if (form /= SQUARE .and. form /= SYMMETRIC) then
      reason = 'IFO = '//line(fields%first(3):fields%last(3))//' is no stiffness matrix: it has the form ' &
        //'6 (symmetric) or 1 (square)'
    else if (number_type < 1 .or. number_type > DOUBLE_PRECISION) then
      reason = 'TIN = '//line(fields%first(4):fields%last(4))//' is not read: a stiffness matrix is real, ' &
        //'of type 1 or 2'
    end if
    entries%whole = form == SQUARE
  end subroutine check_header

  !> Read a component, blank or 0 for a scalar point.
  pure subroutine read_component(field, direction, reason)
    character(len=*), intent(in) :: field
    integer, intent(out) :: direction
    character(len=:), allocatable, intent(inout) :: reason

    direction = 0
    if (len(field) > 0) call read_label(field, 'component', 0, LARGEST_DIRECTION, direction, reason)
  end subroutine read_component

  !> One row of the column: node, component, value, imaginary part; all four may be blank.
  pure subroutine read_row(line, first, last, number, state, entries, reason)
    character(len=*), intent(in) :: line
    integer, intent(in) :: first(4), last(4), number
    type(dmig_state), intent(inout) :: state
    type(stiffness_entries), intent(inout) :: entries
    character(len=:), allocatable, intent(inout) :: reason
    integer :: direction, node, row
    real(dp) :: imaginary, value

    if (all(last < first)) return
    call read_label(line(first(1):last(1)), 'node', 1, huge(1), node, reason)
    call read_component(line(first(2):last(2)), direction, reason)
    call read_value(line(first(3):last(3)), value, reason)
    if (last(4) >= first(4)) then
      call read_value(line(first(4):last(4)), imaginary, reason)
      if (.not. allocated(reason) .and. abs(imaginary) > 0.0_dp) &
        reason = 'the value has an imaginary part: a stiffness matrix is real'
    end if
    if (allocated(reason)) return
    call entries%names%number_of(node, direction, row, state%status)
    if (state%status == 0) call entries%append(row, state%column, value, number, state%status)
  end subroutine read_row

end module fuge_dmig_reader
