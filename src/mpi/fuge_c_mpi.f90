!> C bindings of the component for MPI; fuge_mpi_comm.c passes communicators on.
module fuge_c_mpi
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_int, c_ptr, c_size_t
  use fuge_c_arrays, only: give
  use fuge_c_layers, only: find_layers
  use fuge_c_operator, only: find_operator, new_operator, operator_handle
  use fuge_c_types, only: from_c_string, report_to_c, require_path, require_pointer
  use fuge_kinds, only: dp
  use fuge_layered_body_type, only: fuge_layered_body
  use fuge_line_halfplane, only: fuge_mpi_halfplane_operator
  use fuge_operator_type, only: fuge_operator
  use fuge_rank_communicator, only: check_mpi, free_communicator, new_communicator, rank_communicator
  use fuge_shared_operator, only: shared_operator
  use fuge_slab_files, only: fuge_mpi_read_rows, fuge_mpi_write_rows
  use fuge_slab_halfspace, only: fuge_mpi_halfspace_operator
  use fuge_status, only: fuge_info, report, FUGE_ERR_UNSUPPORTED
  use mpi_f08, only: MPI_Comm
  implicit none
  private

contains

  !> As fuge_operator_halfspace_mpi, with the handle that Fortran has of the communicator. The arguments are eleven,
  !> as in the header: the grid, the communicator, the operator, the message.
  function c_operator_halfspace_mpi(nx, ny, spacing_x, spacing_y, e_star, element, boundary, comm, destination, &
                                    message, length) bind(c, name='fuge_operator_halfspace_comm') result(status)
    integer(c_int), intent(in), value :: nx, ny, element, boundary, comm
    real(c_double), intent(in), value :: spacing_x, spacing_y, e_star
    type(c_ptr), intent(in), value :: destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_mpi_halfspace_operator), allocatable :: surface
    class(fuge_operator), allocatable :: operator
    type(MPI_Comm) :: communicator
    type(fuge_info) :: info

    allocate (surface)
    communicator%MPI_VAL = comm
    call require_pointer(destination, 'op', info)
    if (.not. info%failed()) call surface%set(int(nx), int(ny), spacing_x, spacing_y, e_star, communicator, info, &
                                              int(element), int(boundary))
    call move_alloc(surface, operator)
    call new_operator(operator, destination, info)
    status = report_to_c(info, message, length)
  end function c_operator_halfspace_mpi

  !> As fuge_operator_halfplane_mpi, with the handle that Fortran has of the communicator. The arguments are nine, as
  !> in the header: the cells, the communicator, the operator, the message.
  function c_operator_halfplane_mpi(n, spacing, e_star, element, boundary, comm, destination, message, length) &
    bind(c, name='fuge_operator_halfplane_comm') result(status)
    integer(c_int), intent(in), value :: n, element, boundary, comm
    real(c_double), intent(in), value :: spacing, e_star
    type(c_ptr), intent(in), value :: destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_mpi_halfplane_operator), allocatable :: line
    class(fuge_operator), allocatable :: operator
    type(MPI_Comm) :: communicator
    type(fuge_info) :: info

    allocate (line)
    communicator%MPI_VAL = comm
    call require_pointer(destination, 'op', info)
    if (.not. info%failed()) call line%set(int(n), spacing, e_star, communicator, info, int(element), int(boundary))
    call move_alloc(line, operator)
    call new_operator(operator, destination, info)
    status = report_to_c(info, message, length)
  end function c_operator_halfplane_mpi

  !> As fuge_operator_layered_halfspace_mpi, with the handle that Fortran has of the communicator. The arguments are
  !> sixteen, as in the header: the grid, the layers, the other body, the communicator, the operator, the message.
  function c_operator_layered_halfspace_mpi(nx, ny, spacing_x, spacing_y, layers, thickness, young, poisson, bonded, &
                                            e_star_other, element, boundary, comm, destination, message, length) &
    bind(c, name='fuge_operator_layered_halfspace_comm') result(status)
    integer(c_int), intent(in), value :: nx, ny, layers, bonded, element, boundary, comm
    real(c_double), intent(in), value :: spacing_x, spacing_y, e_star_other
    type(c_ptr), intent(in), value :: thickness, young, poisson, destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_mpi_halfspace_operator), allocatable :: surface
    class(fuge_operator), allocatable :: operator
    type(fuge_layered_body) :: body
    type(MPI_Comm) :: communicator
    type(fuge_info) :: info

    allocate (surface)
    communicator%MPI_VAL = comm
    call require_pointer(destination, 'op', info)
    call find_layers(layers, thickness, young, poisson, bonded, e_star_other, body, info)
    call agree(communicator, info)
    if (.not. info%failed()) call surface%set(int(nx), int(ny), spacing_x, spacing_y, body%e_star(), communicator, &
                                              info, int(element), int(boundary), body=body%surface())
    call move_alloc(surface, operator)
    call new_operator(operator, destination, info)
    status = report_to_c(info, message, length)
  end function c_operator_layered_halfspace_mpi

  !> As fuge_operator_layered_halfplane_mpi, with the handle that Fortran has of the communicator. The arguments are
  !> fourteen, as in the header: the cells, the layers, the other body, the communicator, the operator, the message.
  function c_operator_layered_halfplane_mpi(n, spacing, layers, thickness, young, poisson, bonded, e_star_other, &
                                            element, boundary, comm, destination, message, length) &
    bind(c, name='fuge_operator_layered_halfplane_comm') result(status)
    integer(c_int), intent(in), value :: n, layers, bonded, element, boundary, comm
    real(c_double), intent(in), value :: spacing, e_star_other
    type(c_ptr), intent(in), value :: thickness, young, poisson, destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_mpi_halfplane_operator), allocatable :: line
    class(fuge_operator), allocatable :: operator
    type(fuge_layered_body) :: body
    type(MPI_Comm) :: communicator
    type(fuge_info) :: info

    allocate (line)
    communicator%MPI_VAL = comm
    call require_pointer(destination, 'op', info)
    call find_layers(layers, thickness, young, poisson, bonded, e_star_other, body, info)
    call agree(communicator, info)
    if (.not. info%failed()) call line%set(int(n), spacing, body%e_star(), communicator, info, int(element), &
                                           int(boundary), body=body%surface())
    call move_alloc(line, operator)
    call new_operator(operator, destination, info)
    status = report_to_c(info, message, length)
  end function c_operator_layered_halfplane_mpi

  !> Let the ranks of `comm` agree on `info`: one that has refused its arguments must not let the others wait. Error:
  !> FUGE_ERR_CALL_ORDER if MPI is not running.
  subroutine agree(comm, info)
    type(MPI_Comm), intent(in) :: comm
    type(fuge_info), intent(inout) :: info
    type(rank_communicator) :: group
    type(fuge_info) :: mpi_info

    call check_mpi(mpi_info)
    if (mpi_info%failed()) then
      info = mpi_info
    else
      call new_communicator(comm, group)
      call group%agree(info)
      call free_communicator(group)
    end if
  end subroutine agree

  function c_operator_rows(operator, first, rows, message, length) bind(c, name='fuge_operator_rows') result(status)
    type(c_ptr), intent(in), value :: operator, first, rows, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    class(shared_operator), pointer :: surface
    type(fuge_info) :: info
    integer :: range(2)

    call find_surface(operator, surface, info)
    call require_pointer(first, 'first', info)
    call require_pointer(rows, 'rows', info)
    if (.not. info%failed()) then
      range = surface%own_rows()
      call give(range(1) - 1, first)
      call give(range(2) - range(1) + 1, rows)
    end if
    status = report_to_c(info, message, length)
  end function c_operator_rows

  function c_read_rows(path, operator, values, message, length) bind(c, name='fuge_mpi_read_rows') result(status)
    type(c_ptr), intent(in), value :: path, operator, values, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    class(shared_operator), pointer :: surface
    real(dp), allocatable :: rows(:)
    type(fuge_info) :: info

    call find_surface(operator, surface, info)
    call require_path(path, info)
    call require_pointer(values, 'values', info)
    if (.not. info%failed()) call fuge_mpi_read_rows(from_c_string(path), surface, rows, info)
    if (.not. info%failed()) call give(rows, values)
    status = report_to_c(info, message, length)
  end function c_read_rows

  function c_write_rows(path, operator, values, message, length) bind(c, name='fuge_mpi_write_rows') result(status)
    type(c_ptr), intent(in), value :: path, operator, values, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    class(shared_operator), pointer :: surface
    real(c_double), pointer, contiguous :: rows(:)
    type(fuge_info) :: info

    call find_surface(operator, surface, info)
    call require_path(path, info)
    call require_pointer(values, 'values', info)
    if (.not. info%failed()) then
      call c_f_pointer(values, rows, [surface%points()])
      call fuge_mpi_write_rows(from_c_string(path), surface, rows, info)
    end if
    status = report_to_c(info, message, length)
  end function c_write_rows

  !> The surface behind a handle; FUGE_ERR_POINTER, FUGE_ERR_UNSUPPORTED for another operator.
  subroutine find_surface(operator, surface, info)
    type(c_ptr), intent(in) :: operator
    class(shared_operator), pointer, intent(out) :: surface
    type(fuge_info), intent(inout) :: info
    type(operator_handle), pointer :: handle

    nullify (surface)
    call find_operator(operator, 'op', handle, info)
    if (info%failed()) return
    select type (found => handle%operator)
    class is (shared_operator)
      surface => found
    class default
      call report(info, FUGE_ERR_UNSUPPORTED, 'only an operator of fuge_mpi.h has rows of a rank')
    end select
  end subroutine find_surface

end module fuge_c_mpi
