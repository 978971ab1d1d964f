!> C bindings, section "condensation": from a stiffness matrix to an influence matrix.
module fuge_c_body
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t, c_null_ptr, c_loc, c_associated, c_f_pointer
  use fuge_body_type, only: fuge_body
  use fuge_c_types, only: copy_string, copy_reals, copy_integers, from_zero
  use fuge_condensation, only: fuge_condense, fuge_condensed
  use fuge_nodal_modes, only: fuge_rigid_modes
  use fuge_problem_type, only: fuge_solution
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_POINTER, FUGE_ERR_SIZE, FUGE_ERR_MEMORY, &
    FUGE_ERR_CALL_ORDER, FUGE_MESSAGE_LENGTH
  use fuge_stiffness_band, only: fuge_band_stiffness
  use fuge_stiffness_dense, only: fuge_dense_stiffness
  use fuge_stiffness_type, only: fuge_stiffness
  use fuge_number_text, only: text
  implicit none
  private

  public :: hand_over_body

  !> Where a stiffness matrix of C lies; looked at by fuge_condense, which has a place for
  !> messages.
  type, abstract, public :: stiffness_source
  contains
    procedure(take_matrix), deferred :: take
  end type stiffness_source

  abstract interface
    subroutine take_matrix(self, stiffness, info)
      import :: stiffness_source, fuge_stiffness, fuge_info
      class(stiffness_source), intent(in) :: self
      class(fuge_stiffness), allocatable, intent(out) :: stiffness
      type(fuge_info), intent(out) :: info
    end subroutine take_matrix
  end interface

  type, extends(stiffness_source) :: dense_source
    real(c_double), pointer :: matrix(:, :) => null()
  contains
    procedure :: take => take_dense
  end type dense_source

  type, extends(stiffness_source) :: band_source
    real(c_double), pointer :: band(:, :) => null()
    integer :: width = 0
    logical :: upper = .true.
  contains
    procedure :: take => take_band
  end type band_source

  !> Behind struct fuge_body.
  type :: body_handle
    class(stiffness_source), allocatable :: source
    integer :: degrees = 0
    type(fuge_body) :: body
    type(fuge_condensed) :: condensed
    !> What has been condensed belongs to the present data.
    logical :: done = .false.
    character(len=FUGE_MESSAGE_LENGTH) :: message = ''
  end type body_handle

contains

  function c_body_dense(degrees, k, ldk, destination) bind(c, name='fuge_body_dense') result(status)
    integer(c_int), intent(in), value :: degrees, ldk
    type(c_ptr), intent(in), value :: k, destination
    integer(c_int) :: status
    type(dense_source), allocatable :: dense
    class(stiffness_source), allocatable :: source

    status = FUGE_ERR_SIZE
    if (degrees < 1 .or. ldk < degrees) return
    status = FUGE_ERR_POINTER
    if (.not. c_associated(k)) return
    allocate (dense)
    call c_f_pointer(k, dense%matrix, [ldk, degrees])
    call move_alloc(dense, source)
    status = hand_over_body(int(degrees), source, destination)
  end function c_body_dense

  function c_body_band(degrees, kd, ab, ldab, upper, destination) bind(c, name='fuge_body_band') result(status)
    integer(c_int), intent(in), value :: degrees, kd, ldab, upper
    type(c_ptr), intent(in), value :: ab, destination
    integer(c_int) :: status
    type(band_source), allocatable :: band
    class(stiffness_source), allocatable :: source

    status = FUGE_ERR_SIZE
    if (degrees < 1 .or. kd < 0 .or. ldab <= kd) return
    status = FUGE_ERR_POINTER
    if (.not. c_associated(ab)) return
    allocate (band)
    call c_f_pointer(ab, band%band, [ldab, degrees])
    band%width = int(kd)
    band%upper = upper /= 0
    call move_alloc(band, source)
    status = hand_over_body(int(degrees), source, destination)
  end function c_body_band

  subroutine take_dense(self, stiffness, info)
    class(dense_source), intent(in) :: self
    class(fuge_stiffness), allocatable, intent(out) :: stiffness
    type(fuge_info), intent(out) :: info
    type(fuge_dense_stiffness), allocatable :: dense

    allocate (dense)
    call dense%set(self%matrix, info)
    call move_alloc(dense, stiffness)
  end subroutine take_dense

  subroutine take_band(self, stiffness, info)
    class(band_source), intent(in) :: self
    class(fuge_stiffness), allocatable, intent(out) :: stiffness
    type(fuge_info), intent(out) :: info
    type(fuge_band_stiffness), allocatable :: band

    allocate (band)
    call band%set(self%band, self%upper, info, self%width)
    call move_alloc(band, stiffness)
  end subroutine take_band

  !> Put a body behind a handle at `destination`; FUGE_ERR_POINTER, FUGE_ERR_MEMORY.
  function hand_over_body(degrees, source, destination) result(status)
    integer, intent(in) :: degrees
    class(stiffness_source), allocatable, intent(inout) :: source
    type(c_ptr), intent(in) :: destination
    integer(c_int) :: status
    type(body_handle), pointer :: handle
    type(c_ptr), pointer :: slot
    integer :: stat

    status = FUGE_ERR_POINTER
    if (.not. c_associated(destination)) return
    status = FUGE_ERR_MEMORY
    allocate (handle, stat=stat)
    if (stat /= 0) return
    call move_alloc(source, handle%source)
    handle%degrees = degrees
    call c_f_pointer(destination, slot)
    slot = c_loc(handle)
    status = FUGE_DONE
  end function hand_over_body

  subroutine c_body_free(source) bind(c, name='fuge_body_free')
    type(c_ptr), intent(in), value :: source
    type(body_handle), pointer :: handle
    type(c_ptr), pointer :: slot

    if (.not. c_associated(source)) return
    call c_f_pointer(source, slot)
    if (.not. c_associated(slot)) return
    call c_f_pointer(slot, handle)
    ! Apart, because flang 22 would leak what an extension has allocated.
    if (allocated(handle%source)) deallocate (handle%source)
    call handle%condensed%clear()
    deallocate (handle)
    slot = c_null_ptr
  end subroutine c_body_free

  function c_body_fix(body, count, dof, displacement) bind(c, name='fuge_body_fix') result(status)
    type(c_ptr), intent(in), value :: body, dof, displacement
    integer(c_int), intent(in), value :: count
    integer(c_int) :: status
    type(body_handle), pointer :: handle
    integer(c_int), pointer :: numbers(:)
    real(c_double), pointer :: lengths(:)
    type(fuge_info) :: info

    if (.not. c_associated(body)) then
      status = FUGE_ERR_POINTER
      return
    end if
    call c_f_pointer(body, handle)
    if (count < 0) then
      call report(info, FUGE_ERR_SIZE, 'count = '//text(int(count))//' fixed degrees of freedom: it cannot be negative')
    else if (count > 0 .and. .not. c_associated(dof)) then
      call report(info, FUGE_ERR_POINTER, 'dof is NULL')
    else if (count == 0) then
      if (allocated(handle%body%fixed)) deallocate (handle%body%fixed)
      if (allocated(handle%body%displacement)) deallocate (handle%body%displacement)
    else
      call c_f_pointer(dof, numbers, [count])
      handle%body%fixed = from_zero(numbers)
      if (allocated(handle%body%displacement)) deallocate (handle%body%displacement)
      if (c_associated(displacement)) then
        call c_f_pointer(displacement, lengths, [count])
        handle%body%displacement = lengths
      end if
    end if
    status = settle(handle, info)
  end function c_body_fix

  !> Once condensed, only the displacements by the load are found anew.
  function c_body_set_load(body, load) bind(c, name='fuge_body_set_load') result(status)
    type(c_ptr), intent(in), value :: body, load
    integer(c_int) :: status
    type(body_handle), pointer :: handle
    real(c_double), pointer :: forces(:)
    type(fuge_info) :: info

    status = FUGE_ERR_POINTER
    if (.not. c_associated(body)) return
    call c_f_pointer(body, handle)
    if (.not. c_associated(load)) then
      call report(info, FUGE_ERR_POINTER, 'load is NULL')
    else
      call c_f_pointer(load, forces, [handle%degrees])
      if (handle%done) then
        call handle%condensed%set_load(forces, info)
      else
        handle%body%load = forces
      end if
    end if
    handle%message = info%message
    status = int(info%status, c_int)
    if (handle%done .and. .not. info%failed()) handle%body%load = forces
  end function c_body_set_load

  function c_body_set_modes(body, m, modes) bind(c, name='fuge_body_set_rigid_modes') result(status)
    type(c_ptr), intent(in), value :: body, modes
    integer(c_int), intent(in), value :: m
    integer(c_int) :: status
    type(body_handle), pointer :: handle
    real(c_double), pointer :: motions(:, :)
    type(fuge_info) :: info
    integer :: stat

    status = FUGE_ERR_POINTER
    if (.not. c_associated(body)) return
    call c_f_pointer(body, handle)
    if (m < 0) then
      call report(info, FUGE_ERR_SIZE, 'm = '//text(int(m))//' motions: it cannot be negative')
    else if (m > 0 .and. .not. c_associated(modes)) then
      call report(info, FUGE_ERR_POINTER, 'modes is NULL')
    else
      handle%body%floats = .false.
      if (allocated(handle%body%rigid_modes)) deallocate (handle%body%rigid_modes)
      if (m > 0) then
        call c_f_pointer(modes, motions, [handle%degrees, int(m)])
        allocate (handle%body%rigid_modes(handle%degrees, m), stat=stat)
        if (stat == 0) handle%body%rigid_modes = motions
        if (stat /= 0) call report(info, FUGE_ERR_MEMORY, 'no memory for '//text(int(m))//' motions')
      end if
    end if
    status = settle(handle, info)
  end function c_body_set_modes

  function c_body_find_modes(body) bind(c, name='fuge_body_find_rigid_modes') result(status)
    type(c_ptr), intent(in), value :: body
    integer(c_int) :: status
    type(body_handle), pointer :: handle
    type(fuge_info) :: info

    status = FUGE_ERR_POINTER
    if (.not. c_associated(body)) return
    call c_f_pointer(body, handle)
    if (allocated(handle%body%rigid_modes)) deallocate (handle%body%rigid_modes)
    handle%body%floats = .true.
    status = settle(handle, info)
  end function c_body_find_modes

  function c_rigid_modes(dimensions, nodes, position, modes) bind(c, name='fuge_rigid_modes') result(status)
    integer(c_int), intent(in), value :: dimensions, nodes
    type(c_ptr), intent(in), value :: position, modes
    integer(c_int) :: status
    real(c_double), pointer :: places(:, :), motions(:, :)

    status = FUGE_ERR_SIZE
    if (dimensions < 2 .or. dimensions > 3 .or. nodes < 1) return
    status = FUGE_ERR_POINTER
    if (.not. (c_associated(position) .and. c_associated(modes))) return
    call c_f_pointer(position, places, [dimensions, nodes])
    call c_f_pointer(modes, motions, [int(dimensions)*int(nodes), 3*int(dimensions) - 3])
    motions = fuge_rigid_modes(places)
    status = FUGE_DONE
  end function c_rigid_modes

  function c_body_set_contact(body, n, width, dof, normal) bind(c, name='fuge_body_set_contact') result(status)
    type(c_ptr), intent(in), value :: body, dof, normal
    integer(c_int), intent(in), value :: n, width
    integer(c_int) :: status
    type(body_handle), pointer :: handle
    integer(c_int), pointer :: numbers(:, :)
    real(c_double), pointer :: directions(:, :)
    type(fuge_info) :: info
    integer :: stat

    status = FUGE_ERR_POINTER
    if (.not. c_associated(body)) return
    call c_f_pointer(body, handle)
    if (n < 1 .or. width < 1) then
      call report(info, FUGE_ERR_SIZE, 'n = '//text(int(n))//' contact points with '//text(int(width)) &
                  //' degrees of freedom each: at least one of one is needed')
    else if (.not. (c_associated(dof) .and. c_associated(normal))) then
      call report(info, FUGE_ERR_POINTER, 'dof or normal is NULL')
    else
      call c_f_pointer(dof, numbers, [width, n])
      call c_f_pointer(normal, directions, [width, n])
      if (allocated(handle%body%dof)) deallocate (handle%body%dof, handle%body%normal)
      allocate (handle%body%dof(width, n), handle%body%normal(width, n), stat=stat)
      if (stat /= 0) then
        call report(info, FUGE_ERR_MEMORY, 'no memory for '//text(int(n))//' contact points')
      else
        handle%body%dof = from_zero(numbers)
        handle%body%normal = directions
      end if
    end if
    status = settle(handle, info)
  end function c_body_set_contact

  function c_condense(body) bind(c, name='fuge_body_condense') result(status)
    type(c_ptr), intent(in), value :: body
    integer(c_int) :: status
    type(body_handle), pointer :: handle
    class(fuge_stiffness), allocatable :: stiffness
    type(fuge_info) :: info

    status = FUGE_ERR_POINTER
    if (.not. c_associated(body)) return
    call c_f_pointer(body, handle)
    call handle%source%take(stiffness, info)
    if (.not. info%failed()) call fuge_condense(stiffness, handle%body, handle%condensed, info)
    if (.not. info%failed()) handle%done = .true.
    handle%message = info%message
    status = int(info%status, c_int)
  end function c_condense

  function c_body_get_influence(body, alpha, lda) bind(c, name='fuge_body_get_influence') result(status)
    type(c_ptr), intent(in), value :: body, alpha
    integer(c_int), intent(in), value :: lda
    integer(c_int) :: status
    type(body_handle), pointer :: handle
    real(c_double), pointer :: matrix(:, :)
    integer :: n

    call find_condensed(body, handle, status)
    if (status /= FUGE_DONE) return
    n = size(handle%condensed%alpha, 2)
    status = FUGE_ERR_SIZE
    handle%message = 'lda = '//text(int(lda))//' is less than n = '//text(n)//' contact points'
    if (lda < n) return
    status = FUGE_ERR_POINTER
    handle%message = 'alpha is NULL'
    if (.not. c_associated(alpha)) return
    handle%message = ''
    call c_f_pointer(alpha, matrix, [int(lda), n])
    matrix(:n, :) = handle%condensed%alpha
    status = FUGE_DONE
  end function c_body_get_influence

  function c_body_get_displacement(body, displacement) bind(c, name='fuge_body_get_displacement') result(status)
    type(c_ptr), intent(in), value :: body, displacement
    integer(c_int) :: status
    type(body_handle), pointer :: handle

    call find_condensed(body, handle, status)
    if (status /= FUGE_DONE) return
    call copy_reals(handle%condensed%displacement, displacement)
    if (.not. c_associated(displacement)) status = missing(handle, 'displacement')
  end function c_body_get_displacement

  function c_body_get_motions(body, m) bind(c, name='fuge_body_get_mode_count') result(status)
    type(c_ptr), intent(in), value :: body, m
    integer(c_int) :: status
    type(body_handle), pointer :: handle

    call find_condensed(body, handle, status)
    if (status /= FUGE_DONE) return
    call copy_integers([size(handle%condensed%resultant)], m)
    if (.not. c_associated(m)) status = missing(handle, 'm')
  end function c_body_get_motions

  !> Either may be NULL.
  function c_body_get_modes(body, modes, resultant) bind(c, name='fuge_body_get_modes') result(status)
    type(c_ptr), intent(in), value :: body, modes, resultant
    integer(c_int) :: status
    type(body_handle), pointer :: handle
    integer :: j

    call find_condensed(body, handle, status)
    if (status /= FUGE_DONE) return
    associate (r => handle%condensed%modes)
      call copy_reals([(r(:, j), j=1, size(r, 2))], modes)
    end associate
    call copy_reals(handle%condensed%resultant, resultant)
  end function c_body_get_modes

  function c_body_recover(body, force, motion, displacement) bind(c, name='fuge_body_recover') result(status)
    type(c_ptr), intent(in), value :: body, force, motion, displacement
    integer(c_int) :: status
    type(body_handle), pointer :: handle
    real(c_double), pointer :: values(:), field(:)
    type(fuge_solution) :: solution
    type(fuge_info) :: info
    integer :: m

    call find_condensed(body, handle, status)
    if (status /= FUGE_DONE) return
    m = size(handle%condensed%resultant)
    status = missing(handle, 'force, displacement or motion')
    if (.not. (c_associated(force) .and. c_associated(displacement))) return
    if (m > 0 .and. .not. c_associated(motion)) return
    call c_f_pointer(force, values, [size(handle%condensed%displacement)])
    solution%force = values
    allocate (solution%motion(m))
    if (m > 0) then
      call c_f_pointer(motion, values, [m])
      solution%motion = values
    end if
    call c_f_pointer(displacement, field, [handle%degrees])
    call handle%condensed%recover(solution, field, info)
    handle%message = info%message
    status = int(info%status, c_int)
  end function c_body_recover

  function c_body_message(body, buffer, length) bind(c, name='fuge_body_message') result(status)
    type(c_ptr), intent(in), value :: body, buffer
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(body_handle), pointer :: handle

    status = FUGE_ERR_POINTER
    if (.not. (c_associated(body) .and. c_associated(buffer))) return
    call c_f_pointer(body, handle)
    call copy_string(handle%message, buffer, length)
    status = FUGE_DONE
  end function c_body_message

  !> The handle of a body that has been condensed, or why not.
  subroutine find_condensed(body, handle, status)
    type(c_ptr), intent(in) :: body
    type(body_handle), pointer, intent(out) :: handle
    integer(c_int), intent(out) :: status

    handle => null()
    status = FUGE_ERR_POINTER
    if (.not. c_associated(body)) return
    call c_f_pointer(body, handle)
    status = FUGE_ERR_CALL_ORDER
    handle%message = ''
    if (handle%done) status = FUGE_DONE
    if (.not. handle%done) handle%message = 'nothing has been condensed since the data were set: call ' &
      //'fuge_condense first'
  end subroutine find_condensed

  !> Note which pointer is NULL.
  function missing(handle, name) result(status)
    type(body_handle), intent(inout) :: handle
    character(len=*), intent(in) :: name
    integer(c_int) :: status

    handle%message = name//' is NULL'
    status = FUGE_ERR_POINTER
  end function missing

  !> Keep the message; what has been condensed no longer fits once data were taken.
  function settle(handle, info) result(status)
    type(body_handle), intent(inout) :: handle
    type(fuge_info), intent(in) :: info
    integer(c_int) :: status

    handle%message = info%message
    if (.not. info%failed()) handle%done = .false.
    status = int(info%status, c_int)
  end function settle

end module fuge_c_body
