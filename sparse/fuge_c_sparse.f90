!> C bindings, section "condensation", of the sparse component.
module fuge_c_sparse
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_associated, c_f_pointer
  use fuge_c_body, only: stiffness_source, hand_over_body
  use fuge_c_types, only: from_zero
  use fuge_sparse, only: fuge_sparse_stiffness
  use fuge_status, only: fuge_info, FUGE_ERR_POINTER, FUGE_ERR_SIZE
  use fuge_stiffness_type, only: fuge_stiffness
  implicit none
  private

  type, extends(stiffness_source) :: sparse_source
    integer(c_int), pointer :: column(:) => null(), row(:) => null()
    real(c_double), pointer :: value(:) => null()
  contains
    procedure :: take
  end type sparse_source

contains

  function c_body_sparse(degrees, column, row, value, destination) bind(c, name='fuge_body_sparse') result(status)
    integer(c_int), intent(in), value :: degrees
    type(c_ptr), intent(in), value :: column, row, value, destination
    integer(c_int) :: status
    type(sparse_source), allocatable :: sparse
    class(stiffness_source), allocatable :: source

    status = FUGE_ERR_SIZE
    if (degrees < 1) return
    status = FUGE_ERR_POINTER
    if (.not. (c_associated(column) .and. c_associated(row) .and. c_associated(value))) return
    allocate (sparse)
    call c_f_pointer(column, sparse%column, [degrees + 1])
    status = FUGE_ERR_SIZE
    if (sparse%column(degrees + 1) < 1) return
    call c_f_pointer(row, sparse%row, [sparse%column(degrees + 1)])
    call c_f_pointer(value, sparse%value, [sparse%column(degrees + 1)])
    call move_alloc(sparse, source)
    status = hand_over_body(int(degrees), source, destination)
  end function c_body_sparse

  subroutine take(self, stiffness, info)
    class(sparse_source), intent(in) :: self
    class(fuge_stiffness), allocatable, intent(out) :: stiffness
    type(fuge_info), intent(out) :: info
    type(fuge_sparse_stiffness), allocatable :: sparse

    allocate (sparse)
    call sparse%set(from_zero(self%column), from_zero(self%row), self%value, info)
    call move_alloc(sparse, stiffness)
  end subroutine take

end module fuge_c_sparse
