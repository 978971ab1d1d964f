!> C bindings, sections "condensation" and "elastic bodies", of the sparse component.
module fuge_c_sparse
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t, c_f_pointer
  use fuge_c_arrays, only: find_array
  use fuge_c_bodies_contact, only: solve_bodies
  use fuge_c_body, only: new_body, stiffness_source
  use fuge_c_types, only: from_zero, report_to_c, require_columns, require_count, require_pointer
  use fuge_number_text, only: text
  use fuge_sparse, only: fuge_sparse_stiffness
  use fuge_status, only: fuge_info
  use fuge_stiffness_type, only: fuge_stiffness
  implicit none
  private

  type, extends(stiffness_source) :: sparse_source
    integer(c_int), pointer :: column(:) => null(), row(:) => null()
    real(c_double), pointer :: value(:) => null()
  contains
    procedure :: read => read_sparse
  end type sparse_source

contains

  function c_body_sparse(degrees, column, row, value, destination, message, length) &
    bind(c, name='fuge_body_sparse') result(status)
    integer(c_int), intent(in), value :: degrees
    type(c_ptr), intent(in), value :: column, row, value, destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(sparse_source), allocatable :: sparse
    class(stiffness_source), allocatable :: source
    type(fuge_info) :: info

    allocate (sparse)
    call require_count(degrees, 1, 'degrees', 'degrees of freedom', info)
    call require_columns(degrees, 'degrees', info)
    if (.not. info%failed()) call find_array(degrees + 1_c_int, column, 'column', sparse%column, info)
    call require_pointer(row, 'row', info)
    call require_pointer(value, 'value', info)
    if (.not. info%failed()) &
      call require_count(sparse%column(degrees + 1), 1, 'column('//text(int(degrees))//')', 'entries', info)
    if (.not. info%failed()) then
      call c_f_pointer(row, sparse%row, [sparse%column(degrees + 1)])
      call c_f_pointer(value, sparse%value, [sparse%column(degrees + 1)])
    end if
    call move_alloc(sparse, source)
    call new_body(int(degrees), source, destination, info)
    status = report_to_c(info, message, length)
  end function c_body_sparse

  subroutine read_sparse(self, stiffness, info)
    class(sparse_source), intent(in) :: self
    class(fuge_stiffness), allocatable, intent(out) :: stiffness
    type(fuge_info), intent(out) :: info
    type(fuge_sparse_stiffness), allocatable :: sparse

    allocate (sparse)
    call sparse%set(from_zero(self%column), from_zero(self%row), self%value, info)
    call move_alloc(sparse, stiffness)
  end subroutine read_sparse

  function c_bodies_solve_sparse(bodies, options) bind(c, name='fuge_bodies_solve_sparse') result(status)
    type(c_ptr), intent(in), value :: bodies, options
    integer(c_int) :: status
    type(fuge_sparse_stiffness) :: sparse

    status = solve_bodies(bodies, options, sparse)
  end function c_bodies_solve_sparse

end module fuge_c_sparse
