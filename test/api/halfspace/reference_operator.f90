!> The built-in operators of grids as C functions, so that a callback operator can do the very same products.
module reference_operator
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_null_ptr, c_loc, c_f_pointer
  use fuge_halfplane_fft, only: fuge_halfplane_operator
  use fuge_halfspace_fft, only: fuge_halfspace_operator
  use fuge_operator_type, only: fuge_operator
  use fuge_status, only: fuge_info
  implicit none
  private

  type :: reference
    class(fuge_operator), allocatable :: operator
  end type reference

contains

  !> A half-plane of nx cells for ny = 0, else a half-space of nx x ny; E* = 1. NULL for what is refused.
  function reference_new(nx, ny, spacing_x, spacing_y, element, boundary) bind(c) result(address)
    integer(c_int), intent(in), value :: nx, ny, element, boundary
    real(c_double), intent(in), value :: spacing_x, spacing_y
    type(c_ptr) :: address
    type(reference), pointer :: made
    type(fuge_halfplane_operator), allocatable :: row
    type(fuge_halfspace_operator), allocatable :: area
    type(fuge_info) :: info

    address = c_null_ptr
    allocate (made)
    if (ny == 0) then
      allocate (row)
      call row%set(int(nx), spacing_x, 1.0_c_double, info, int(element), int(boundary))
      call move_alloc(row, made%operator)
    else
      allocate (area)
      call area%set(int(nx), int(ny), spacing_x, spacing_y, 1.0_c_double, info, int(element), int(boundary))
      call move_alloc(area, made%operator)
    end if
    if (info%failed()) then
      call release(made)
    else
      address = c_loc(made)
    end if
  end function reference_new

  !> A fuge_apply of fuge_core.h: the product without the datum.
  function reference_apply(n, force, displacement, user) bind(c) result(status)
    integer(c_int), intent(in), value :: n
    real(c_double), intent(in) :: force(n)
    real(c_double), intent(inout) :: displacement(n)
    type(c_ptr), intent(in), value :: user
    integer(c_int) :: status
    type(reference), pointer :: known
    integer :: failure

    call c_f_pointer(user, known)
    call known%operator%apply(force, displacement, failure)
    status = int(failure, c_int)
  end function reference_apply

  !> A fuge_apply of fuge_core.h: the preconditioner.
  function reference_precondition(n, displacement, force, user) bind(c) result(status)
    integer(c_int), intent(in), value :: n
    real(c_double), intent(in) :: displacement(n)
    real(c_double), intent(inout) :: force(n)
    type(c_ptr), intent(in), value :: user
    integer(c_int) :: status
    type(reference), pointer :: known
    integer :: failure

    call c_f_pointer(user, known)
    call known%operator%precondition(displacement, force, failure)
    status = int(failure, c_int)
  end function reference_precondition

  function reference_datum(address) bind(c) result(datum)
    type(c_ptr), intent(in), value :: address
    real(c_double) :: datum
    type(reference), pointer :: known

    call c_f_pointer(address, known)
    datum = known%operator%datum()
  end function reference_datum

  subroutine reference_free(address) bind(c)
    type(c_ptr), intent(in), value :: address
    type(reference), pointer :: known

    call c_f_pointer(address, known)
    call release(known)
  end subroutine reference_free

  !> Apart, because flang 22 would leak what an extension of fuge_operator has allocated.
  subroutine release(known)
    type(reference), pointer, intent(inout) :: known

    deallocate (known%operator)
    deallocate (known)
  end subroutine release

end module reference_operator
