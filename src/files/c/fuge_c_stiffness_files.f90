!> C bindings, section "stiffness files".
module fuge_c_stiffness_files
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_int, c_ptr, c_size_t
  use fuge_c_arrays, only: give
  use fuge_c_types, only: from_c_string, report_to_c, require_count, require_path, require_pointer
  use fuge_status, only: fuge_info
  use fuge_stiffness_files, only: fuge_read_stiffness
  implicit none
  private

  !> What fuge_read_stiffness returns.
  type :: named_matrix
    integer, allocatable :: column(:), row(:), node(:), direction(:)
    real(c_double), allocatable :: value(:)
  end type named_matrix

contains

  !> Fifteen arguments, as in the header: the file and its options, five arrays with their sizes, the message.
  function c_read_stiffness(path, format, names_path, name, row_capacity, entry_capacity, column, row, value, node, &
    direction, rows, entries, message, length) bind(c, name='fuge_read_stiffness') result(status)
    type(c_ptr), intent(in), value :: path, names_path, name, column, row, value, node, direction, rows, entries
    type(c_ptr), intent(in), value :: message
    integer(c_int), intent(in), value :: format, row_capacity, entry_capacity
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(named_matrix) :: matrix
    type(fuge_info) :: info
    integer :: shown

    call require_path(path, info)
    if (c_associated(names_path)) call require_path(names_path, info)
    call require_pointer(rows, 'rows', info)
    call require_pointer(entries, 'entries', info)
    call require_count(row_capacity, 0, 'row_capacity', 'rows that fit into node, direction and column', info)
    call require_count(entry_capacity, 0, 'entry_capacity', 'entries that fit into row and value', info)
    if (.not. info%failed()) call read_file(path, int(format), names_path, name, matrix, info)
    status = report_to_c(info, message, length)
    if (info%failed()) return
    shown = min(size(matrix%node), int(row_capacity))
    call give(matrix%column(:shown + 1) - 1, column)
    call give(matrix%node(:shown), node)
    call give(matrix%direction(:shown), direction)
    shown = min(size(matrix%row), int(entry_capacity))
    call give(matrix%row(:shown) - 1, row)
    call give(matrix%value(:shown), value)
    call give(size(matrix%node), rows)
    call give(size(matrix%row), entries)
  end function c_read_stiffness

  !> Read the file; names that are NULL are blank.
  subroutine read_file(path, format, names_path, name, matrix, info)
    type(c_ptr), intent(in) :: path, names_path, name
    integer, intent(in) :: format
    type(named_matrix), intent(inout) :: matrix
    type(fuge_info), intent(inout) :: info
    character(len=:), allocatable :: names_file, wanted

    names_file = ''
    wanted = ''
    if (c_associated(names_path)) names_file = from_c_string(names_path)
    if (c_associated(name)) wanted = from_c_string(name)
    call fuge_read_stiffness(from_c_string(path), matrix%column, matrix%row, matrix%value, matrix%node, &
                             matrix%direction, info, format, names_file, wanted)
  end subroutine read_file

end module fuge_c_stiffness_files
