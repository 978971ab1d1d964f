!> C bindings, section "condensation": from a stiffness matrix to an influence matrix.
module fuge_c_body
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t, c_loc, c_associated, c_f_pointer
  use fuge_body_type, only: fuge_body
  use fuge_c_arrays, only: find_array, give
  use fuge_c_stiffness_sources, only: band_source, columns_source, dense_source, stiffness_source
  use fuge_c_types, only: reporting_handle, from_zero, give_message, report_failure, report_to_c, report_to_handle, &
    require_columns, require_count, require_pointer, set_handle, take_handle
  use fuge_condensation, only: fuge_condense, fuge_condensed
  use fuge_input_checks, only: check_finite, is_finite_everywhere
  use fuge_nodal_modes, only: fuge_rigid_modes
  use fuge_number_text, only: index_text, text
  use fuge_problem_type, only: fuge_solution
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_CALL_ORDER, FUGE_ERR_MODES, FUGE_ERR_SIZE
  use fuge_stiffness_band, only: fuge_band_stiffness
  use fuge_stiffness_type, only: fuge_stiffness
  implicit none
  private

  public :: columns_body, find_body, find_condensed, report_data

  !> Behind struct fuge_body.
  type, extends(reporting_handle), public :: body_handle
    class(stiffness_source), allocatable :: source
    integer :: degrees = 0
    type(fuge_body) :: body
    type(fuge_condensed) :: condensed
    !> `condensed` belongs to the present data.
    logical :: done = .false.
    !> Of the load cases of the last call.
    type(fuge_info), allocatable :: case_reports(:)
  end type body_handle

contains

  function c_body_dense(degrees, k, ldk, destination, message, length) bind(c, name='fuge_body_dense') result(status)
    integer(c_int), intent(in), value :: degrees, ldk
    type(c_ptr), intent(in), value :: k, destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(dense_source), allocatable :: dense
    class(stiffness_source), allocatable :: source
    type(fuge_info) :: info

    call require_count(degrees, 1, 'degrees', 'degrees of freedom', info)
    if (.not. info%failed() .and. ldk < degrees) call report(info, FUGE_ERR_SIZE, 'ldk = '//text(int(ldk)) &
      //' is less than degrees = '//text(int(degrees))//': it is the distance between columns, in doubles')
    allocate (dense)
    call find_array(int(ldk), degrees, k, 'k', dense%matrix, info)
    call move_alloc(dense, source)
    call new_body(int(degrees), source, destination, info)
    status = report_to_c(info, message, length)
  end function c_body_dense

  function c_body_band(degrees, kd, ab, ldab, upper, destination, message, length) &
    bind(c, name='fuge_body_band') result(status)
    integer(c_int), intent(in), value :: degrees, kd, ldab, upper
    type(c_ptr), intent(in), value :: ab, destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(band_source), allocatable :: band
    class(stiffness_source), allocatable :: source
    type(fuge_info) :: info

    call require_count(degrees, 1, 'degrees', 'degrees of freedom', info)
    call require_count(kd, 0, 'kd', 'diagonals beside the main one', info)
    if (.not. info%failed() .and. ldab <= kd) call report(info, FUGE_ERR_SIZE, 'ldab = '//text(int(ldab)) &
      //' is not above kd = '//text(int(kd))//': it is the distance between columns, in doubles')
    allocate (band)
    call find_array(int(ldab), degrees, ab, 'ab', band%band, info)
    band%width = int(kd)
    band%upper = upper /= 0
    call move_alloc(band, source)
    call new_body(int(degrees), source, destination, info)
    status = report_to_c(info, message, length)
  end function c_body_band

  !> Put a body behind a handle at `destination`, unless an error is known already; FUGE_ERR_POINTER, FUGE_ERR_MEMORY.
  subroutine new_body(degrees, source, destination, info)
    integer, intent(in) :: degrees
    class(stiffness_source), allocatable, intent(inout) :: source
    type(c_ptr), intent(in) :: destination
    type(fuge_info), intent(inout) :: info
    type(body_handle), pointer :: handle
    integer :: stat

    call require_pointer(destination, 'body', info)
    if (info%failed()) return
    allocate (handle, stat=stat)
    call require_memory(stat, 'the body', info)
    if (stat /= 0) return
    call move_alloc(source, handle%source)
    handle%degrees = degrees
    call set_handle(c_loc(handle), destination)
  end subroutine new_body

  function c_body_columns(degrees, column, row, value, destination, message, length) &
    bind(c, name='fuge_body_columns') result(status)
    integer(c_int), intent(in), value :: degrees
    type(c_ptr), intent(in), value :: column, row, value, destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_band_stiffness) :: band

    status = columns_body(degrees, column, row, value, band, destination, message, length)
  end function c_body_columns

  !> A body by compressed columns, whose factor has the kind of storage of `storage`.
  function columns_body(degrees, column, row, value, storage, destination, message, length) result(status)
    integer(c_int), intent(in) :: degrees
    type(c_ptr), intent(in) :: column, row, value, destination, message
    class(fuge_stiffness), intent(in) :: storage
    integer(c_size_t), intent(in) :: length
    integer(c_int) :: status
    type(columns_source), allocatable :: columns
    class(stiffness_source), allocatable :: source
    type(fuge_info) :: info

    allocate (columns)
    call require_count(degrees, 1, 'degrees', 'degrees of freedom', info)
    call require_columns(degrees, 'degrees', info)
    if (.not. info%failed()) call find_array(degrees + 1_c_int, column, 'column', columns%column, info)
    call require_pointer(row, 'row', info)
    call require_pointer(value, 'value', info)
    if (.not. info%failed()) &
      call require_count(columns%column(degrees + 1), 1, 'column('//text(int(degrees))//')', 'entries', info)
    if (.not. info%failed()) then
      call c_f_pointer(row, columns%row, [columns%column(degrees + 1)])
      call c_f_pointer(value, columns%value, [columns%column(degrees + 1)])
      allocate (columns%storage, mold=storage)
    end if
    call move_alloc(columns, source)
    call new_body(int(degrees), source, destination, info)
    status = report_to_c(info, message, length)
  end function columns_body

  subroutine c_body_free(source) bind(c, name='fuge_body_free')
    type(c_ptr), intent(in), value :: source
    type(body_handle), pointer :: handle
    type(c_ptr) :: address

    address = take_handle(source)
    if (.not. c_associated(address)) return
    call c_f_pointer(address, handle)
    ! Apart, because flang 22 would leak what an extension has allocated.
    if (allocated(handle%source)) deallocate (handle%source)
    call handle%condensed%clear()
    deallocate (handle)
  end subroutine c_body_free

  function c_body_fix(body, count, dof, displacement) bind(c, name='fuge_body_fix') result(status)
    type(c_ptr), intent(in), value :: body, dof, displacement
    integer(c_int), intent(in), value :: count
    integer(c_int) :: status
    type(body_handle), pointer :: handle
    type(fuge_info) :: info

    call find_body(body, handle, info)
    if (.not. info%failed()) call copy_supports(count, dof, displacement, handle%body%fixed, &
                                                handle%body%displacement, info)
    status = report_data(info, handle)
  end function c_body_fix

  !> Replace the `fixed` degrees of freedom and their `lengths` of displacement, which are 0 if `displacement` is NULL;
  !> FUGE_ERR_SIZE, FUGE_ERR_POINTER.
  subroutine copy_supports(count, dof, displacement, fixed, lengths, info)
    integer(c_int), intent(in) :: count
    type(c_ptr), intent(in) :: dof, displacement
    integer, allocatable, intent(inout) :: fixed(:)
    real(c_double), allocatable, intent(inout) :: lengths(:)
    type(fuge_info), intent(inout) :: info
    integer(c_int), pointer :: numbers(:)
    real(c_double), pointer :: values(:)

    call require_count(count, 0, 'count', 'fixed degrees of freedom', info)
    if (count > 0) call require_pointer(dof, 'dof', info)
    if (info%failed()) return
    if (allocated(fixed)) deallocate (fixed)
    if (allocated(lengths)) deallocate (lengths)
    if (count == 0) return
    call c_f_pointer(dof, numbers, [count])
    fixed = from_zero(numbers)
    if (.not. c_associated(displacement)) return
    call c_f_pointer(displacement, values, [count])
    lengths = values
  end subroutine copy_supports

  !> After fuge_body_condense only the displacements by the load are found anew.
  function c_body_set_load(body, load) bind(c, name='fuge_body_set_load') result(status)
    type(c_ptr), intent(in), value :: body, load
    integer(c_int) :: status
    type(body_handle), pointer :: handle
    real(c_double), pointer :: forces(:)
    type(fuge_info) :: info

    call find_body(body, handle, info)
    if (.not. info%failed()) call find_array(handle%degrees, load, 'load', forces, info)
    if (.not. info%failed()) then
      if (handle%done) call handle%condensed%set_load(forces, info)
      if (.not. info%failed()) handle%body%load = forces
    end if
    status = report_to_handle(info, handle)
  end function c_body_set_load

  function c_body_set_rigid_modes(body, m, rigid_modes) bind(c, name='fuge_body_set_rigid_modes') result(status)
    type(c_ptr), intent(in), value :: body, rigid_modes
    integer(c_int), intent(in), value :: m
    integer(c_int) :: status
    type(body_handle), pointer :: handle
    real(c_double), pointer :: values(:, :)
    real(c_double), allocatable :: copy(:, :)
    type(fuge_info) :: info
    integer :: stat

    call find_body(body, handle, info)
    call require_count(m, 0, 'm', 'rigid modes', info)
    if (m > 0) call require_pointer(rigid_modes, 'rigid_modes', info)
    if (.not. info%failed()) then
      if (m > handle%degrees) call report(info, FUGE_ERR_MODES, text(int(m))//' rigid modes of '//text(handle%degrees) &
        //' degrees of freedom depend on each other: give as many as the supports allow')
    end if
    if (.not. info%failed() .and. m > 0) then
      call c_f_pointer(rigid_modes, values, [handle%degrees, int(m)])
      allocate (copy, source=values, stat=stat)
      call require_memory(stat, '', int(m), 'rigid modes', info)
    end if
    if (.not. info%failed()) then
      handle%body%floats = .false.
      call move_alloc(copy, handle%body%rigid_modes)
    end if
    status = report_data(info, handle)
  end function c_body_set_rigid_modes

  function c_body_find_rigid_modes(body) bind(c, name='fuge_body_find_rigid_modes') result(status)
    type(c_ptr), intent(in), value :: body
    integer(c_int) :: status
    type(body_handle), pointer :: handle
    type(fuge_info) :: info

    call find_body(body, handle, info)
    if (.not. info%failed()) then
      if (allocated(handle%body%rigid_modes)) deallocate (handle%body%rigid_modes)
      handle%body%floats = .true.
    end if
    status = report_data(info, handle)
  end function c_body_find_rigid_modes

  function c_rigid_modes(dimensions, nodes, position, rigid_modes, message, length) &
    bind(c, name='fuge_rigid_modes') result(status)
    integer(c_int), intent(in), value :: dimensions, nodes
    type(c_ptr), intent(in), value :: position, rigid_modes, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer, contiguous :: places(:, :)
    real(c_double), pointer :: values(:, :)
    type(fuge_info) :: info

    if (dimensions < 2 .or. dimensions > 3) call report(info, FUGE_ERR_SIZE, 'dimensions = '//text(int(dimensions)) &
                                                        //': nodes are in the plane, 2, or in space, 3')
    call require_count(nodes, 1, 'nodes', 'nodes', info)
    if (.not. info%failed() .and. nodes > huge(nodes)/max(dimensions, 1)) call report(info, FUGE_ERR_SIZE, 'nodes = ' &
      //text(int(nodes))//' have more than '//text(int(huge(nodes)))//' degrees of freedom: pass fewer nodes')
    call require_pointer(position, 'position', info)
    call require_pointer(rigid_modes, 'rigid_modes', info)
    if (.not. info%failed()) then
      call c_f_pointer(position, places, [dimensions, nodes])
      call check_positions(places, info)
    end if
    if (.not. info%failed()) then
      call c_f_pointer(rigid_modes, values, [int(dimensions)*int(nodes), 3*int(dimensions) - 3])
      values = fuge_rigid_modes(places)
    end if
    status = report_to_c(info, message, length)
  end function c_rigid_modes

  !> Refuse positions of nodes that are NaN or infinite (FUGE_ERR_NOT_FINITE).
  pure subroutine check_positions(position, info)
    real(c_double), intent(in), contiguous :: position(:, :)
    type(fuge_info), intent(inout) :: info
    integer :: axis, node

    do node = 1, size(position, 2)
      if (is_finite_everywhere(position(:, node))) cycle
      do axis = 1, size(position, 1)
        call check_finite(position(axis, node), 'position('//index_text(axis)//','//index_text(node)//')', info)
        if (info%failed()) return
      end do
    end do
  end subroutine check_positions

  function c_body_set_contact(body, n, width, dof, normal) bind(c, name='fuge_body_set_contact') result(status)
    type(c_ptr), intent(in), value :: body, dof, normal
    integer(c_int), intent(in), value :: n, width
    integer(c_int) :: status
    type(body_handle), pointer :: handle
    type(fuge_info) :: info

    call find_body(body, handle, info)
    call require_count(n, 1, 'n', 'contact points', info)
    call require_count(width, 1, 'width', 'degrees of freedom of each contact point', info)
    call require_pointer(dof, 'dof', info)
    call require_pointer(normal, 'normal', info)
    if (.not. info%failed()) call set_points(handle%body, int(n), int(width), dof, normal, info)
    status = report_data(info, handle)
  end function c_body_set_contact

  !> Replace the contact points.
  subroutine set_points(body, n, width, dof, normal, info)
    type(fuge_body), intent(inout) :: body
    integer, intent(in) :: n, width
    type(c_ptr), intent(in) :: dof, normal
    type(fuge_info), intent(inout) :: info
    integer(c_int), pointer :: numbers(:, :)
    real(c_double), pointer :: directions(:, :)
    integer, allocatable :: copy_of_dof(:, :)
    real(c_double), allocatable :: copy_of_normal(:, :)
    integer :: stat

    allocate (copy_of_dof(width, n), copy_of_normal(width, n), stat=stat)
    call require_memory(stat, '', n, 'contact points', info)
    if (stat /= 0) return
    call c_f_pointer(dof, numbers, [width, n])
    call c_f_pointer(normal, directions, [width, n])
    copy_of_dof = from_zero(numbers)
    copy_of_normal = directions
    call move_alloc(copy_of_dof, body%dof)
    call move_alloc(copy_of_normal, body%normal)
    body%held_points = .false.
  end subroutine set_points

  function c_body_condense(body) bind(c, name='fuge_body_condense') result(status)
    type(c_ptr), intent(in), value :: body
    integer(c_int) :: status
    type(body_handle), pointer :: handle
    class(fuge_stiffness), allocatable :: stiffness
    type(fuge_info) :: info

    call find_body(body, handle, info)
    if (.not. info%failed()) call handle%source%read(stiffness, info)
    if (.not. info%failed()) call fuge_condense(stiffness, handle%body, handle%condensed, info)
    if (.not. info%failed()) handle%done = .true.
    status = report_to_handle(info, handle)
  end function c_body_condense

  function c_body_get_influence(body, alpha, lda) bind(c, name='fuge_body_get_influence') result(status)
    type(c_ptr), intent(in), value :: body, alpha
    integer(c_int), intent(in), value :: lda
    integer(c_int) :: status
    type(body_handle), pointer :: handle
    real(c_double), pointer :: matrix(:, :)
    type(fuge_info) :: info
    integer :: n

    call find_condensed(body, handle, info)
    call require_pointer(alpha, 'alpha', info)
    n = 0
    if (.not. info%failed()) n = size(handle%condensed%alpha, 2)
    if (.not. info%failed() .and. lda < n) call report(info, FUGE_ERR_SIZE, 'lda = '//text(int(lda)) &
      //' is less than n = '//text(n)//' contact points: it is the distance between columns, in doubles')
    status = report_failure(info, handle)
    if (info%failed()) return
    call c_f_pointer(alpha, matrix, [int(lda), n])
    matrix(:n, :) = handle%condensed%alpha
  end function c_body_get_influence

  function c_body_get_displacement(body, displacement) bind(c, name='fuge_body_get_displacement') result(status)
    type(c_ptr), intent(in), value :: body, displacement
    integer(c_int) :: status
    type(body_handle), pointer :: handle
    type(fuge_info) :: info

    call find_condensed(body, handle, info)
    call require_pointer(displacement, 'displacement', info)
    if (.not. info%failed()) call give(handle%condensed%displacement, displacement)
    status = report_failure(info, handle)
  end function c_body_get_displacement

  function c_body_get_mode_count(body, m) bind(c, name='fuge_body_get_mode_count') result(status)
    type(c_ptr), intent(in), value :: body, m
    integer(c_int) :: status
    type(body_handle), pointer :: handle
    type(fuge_info) :: info

    call find_condensed(body, handle, info)
    call require_pointer(m, 'm', info)
    if (.not. info%failed()) call give(size(handle%condensed%resultant), m)
    status = report_failure(info, handle)
  end function c_body_get_mode_count

  !> Either array may be NULL.
  function c_body_get_modes(body, modes, resultant) bind(c, name='fuge_body_get_modes') result(status)
    type(c_ptr), intent(in), value :: body, modes, resultant
    integer(c_int) :: status
    type(body_handle), pointer :: handle
    type(fuge_info) :: info

    call find_condensed(body, handle, info)
    if (.not. info%failed()) then
      call give(handle%condensed%modes, modes)
      call give(handle%condensed%resultant, resultant)
    end if
    status = report_failure(info, handle)
  end function c_body_get_modes

  function c_body_recover(body, force, motion, displacement) bind(c, name='fuge_body_recover') result(status)
    type(c_ptr), intent(in), value :: body, force, motion, displacement
    integer(c_int) :: status
    type(body_handle), pointer :: handle
    real(c_double), pointer :: values(:), displacements(:)
    type(fuge_solution) :: solution
    type(fuge_info) :: info
    integer :: m

    m = 0
    call find_condensed(body, handle, info)
    if (.not. info%failed()) m = size(handle%condensed%resultant)
    call require_pointer(force, 'force', info)
    if (m > 0) call require_pointer(motion, 'motion', info)
    call require_pointer(displacement, 'displacement', info)
    if (.not. info%failed()) then
      call c_f_pointer(force, values, [size(handle%condensed%displacement)])
      solution%force = values
      allocate (solution%motion(m))
      if (m > 0) then
        call c_f_pointer(motion, values, [m])
        solution%motion = values
      end if
      call c_f_pointer(displacement, displacements, [handle%degrees])
      call handle%condensed%recover(solution, displacements, info)
    end if
    status = report_to_handle(info, handle)
  end function c_body_recover

  function c_body_message(body, buffer, length) bind(c, name='fuge_body_message') result(status)
    type(c_ptr), intent(in), value :: body, buffer
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(body_handle), pointer :: handle
    type(fuge_info) :: info

    call find_body(body, handle, info)
    status = give_message(info, handle, buffer, length)
  end function c_body_message

  !> The body behind a handle; FUGE_ERR_POINTER for NULL.
  subroutine find_body(body, handle, info)
    type(c_ptr), intent(in) :: body
    type(body_handle), pointer, intent(out) :: handle
    type(fuge_info), intent(inout) :: info

    nullify (handle)
    call require_pointer(body, 'body', info)
    if (.not. info%failed()) call c_f_pointer(body, handle)
  end subroutine find_body

  !> The condensed body behind a handle; FUGE_ERR_CALL_ORDER for one that is not condensed.
  subroutine find_condensed(body, handle, info)
    type(c_ptr), intent(in) :: body
    type(body_handle), pointer, intent(out) :: handle
    type(fuge_info), intent(inout) :: info

    call find_body(body, handle, info)
    if (info%failed()) return
    if (.not. handle%done) call report(info, FUGE_ERR_CALL_ORDER, 'the body has not been condensed since its data ' &
                                       //'were set: call fuge_body_condense first')
  end subroutine find_condensed

  !> `report_to_handle` after a call that sets data: if it succeeds, the body has to be condensed anew.
  function report_data(info, handle) result(status)
    type(fuge_info), intent(in) :: info
    type(body_handle), pointer, intent(in) :: handle
    integer(c_int) :: status

    status = report_to_handle(info, handle)
    if (.not. info%failed()) handle%done = .false.
  end function report_data

end module fuge_c_body
