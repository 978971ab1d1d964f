!> Room for the transforms of a product, kept from one product to the next: memory that the system has cleared anew
!> would take as long as the transforms.
module fuge_kept_rows
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_float, c_null_ptr, c_ptr, &
    c_size_t
  use fuge_fft, only: allocate_values, release_buffer
  use fuge_locks, only: lock, unlock, LOCK_BUFFERS
  use fuge_status, only: FUGE_DONE
  implicit none
  private

  public :: drop_rows, free_rows, return_rows, take_rows

  !> The room that an operator keeps. One product at a time uses it.
  type, public :: kept_rows
    private
    type(c_ptr) :: buffer = c_null_ptr
    integer(c_size_t) :: bytes = 0
    !> A product in another thread uses it.
    logical :: busy = .false.
  end type kept_rows

  !> Room that a product has taken until it returns it.
  type, public :: taken_rows
    private
    type(c_ptr) :: buffer = c_null_ptr
    !> It is the kept room, not one of the product's own. The address cannot tell: another thread may be changing that
    !> of the kept room.
    logical :: is_kept = .false.
  end type taken_rows

  interface take_rows
    module procedure :: take_double, take_single
  end interface take_rows

contains

  !> `rows` lines of `stride` real numbers: the kept ones, or new ones if another thread uses those. `status`: 0 or
  !> FUGE_ERR_MEMORY.
  subroutine take_double(kept, stride, rows, taken, work, status)
    type(kept_rows), pointer, intent(in) :: kept
    integer, intent(in) :: stride, rows
    type(taken_rows), intent(out) :: taken
    real(c_double), pointer, contiguous, intent(out) :: work(:, :)
    integer, intent(out) :: status

    nullify (work)
    call take_bytes(kept, 2*stride, rows, taken, status)
    if (status == FUGE_DONE) call c_f_pointer(taken%buffer, work, [stride, rows])
  end subroutine take_double

  !> The same in single precision.
  subroutine take_single(kept, stride, rows, taken, work, status)
    type(kept_rows), pointer, intent(in) :: kept
    integer, intent(in) :: stride, rows
    type(taken_rows), intent(out) :: taken
    real(c_float), pointer, contiguous, intent(out) :: work(:, :)
    integer, intent(out) :: status

    nullify (work)
    call take_bytes(kept, stride, rows, taken, status)
    if (status == FUGE_DONE) call c_f_pointer(taken%buffer, work, [stride, rows])
  end subroutine take_single

  !> Room for `rows` lines of `stride` numbers of four bytes. `status` as in `take_rows`.
  subroutine take_bytes(kept, stride, rows, taken, status)
    type(kept_rows), pointer, intent(in) :: kept
    integer, intent(in) :: stride, rows
    type(taken_rows), intent(out) :: taken
    integer, intent(out) :: status
    real(c_float), pointer, contiguous :: work(:, :)

    call lock(LOCK_BUFFERS)
    taken%is_kept = .not. kept%busy
    if (taken%is_kept) kept%busy = .true.
    call unlock(LOCK_BUFFERS)
    if (.not. taken%is_kept) then
      call allocate_values(stride, rows, taken%buffer, work, status)
      return
    end if
    call widen(kept, stride, rows, status)
    if (status == FUGE_DONE) then
      taken%buffer = kept%buffer
    else
      call return_rows(kept, taken)
    end if
  end subroutine take_bytes

  !> Let there be room for `rows` lines of `stride` numbers of four bytes. `status` as in `take_rows`.
  subroutine widen(kept, stride, rows, status)
    type(kept_rows), intent(inout) :: kept
    integer, intent(in) :: stride, rows
    integer, intent(out) :: status
    real(c_float), pointer, contiguous :: work(:, :)
    integer(c_size_t) :: bytes

    status = FUGE_DONE
    bytes = 4_c_size_t*int(stride, c_size_t)*int(rows, c_size_t)
    if (kept%bytes >= bytes) return
    call free_rows(kept)
    call allocate_values(stride, rows, kept%buffer, work, status)
    if (status == FUGE_DONE) kept%bytes = bytes
  end subroutine widen

  !> After `take_rows`.
  subroutine return_rows(kept, taken)
    type(kept_rows), pointer, intent(in) :: kept
    type(taken_rows), intent(inout) :: taken

    if (taken%is_kept) then
      call lock(LOCK_BUFFERS)
      kept%busy = .false.
      call unlock(LOCK_BUFFERS)
    else
      call release_buffer(taken%buffer)
    end if
    taken = taken_rows()
  end subroutine return_rows

  !> Free the room unless a product uses it: the next one takes as long again as the system needs to clear memory.
  subroutine drop_rows(kept)
    type(kept_rows), pointer, intent(in) :: kept

    call lock(LOCK_BUFFERS)
    if (.not. kept%busy) call free_rows(kept)
    call unlock(LOCK_BUFFERS)
  end subroutine drop_rows

  !> Free the room; without effect if there is none.
  subroutine free_rows(kept)
    type(kept_rows), intent(inout) :: kept

    if (c_associated(kept%buffer)) call release_buffer(kept%buffer)
    kept%buffer = c_null_ptr
    kept%bytes = 0
  end subroutine free_rows

end module fuge_kept_rows
