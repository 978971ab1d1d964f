!> Arrays of C as C bindings see them: none of them may be NULL.
module fuge_c_arrays
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_f_pointer
  use fuge_c_types, only: require_pointer
  use fuge_status, only: fuge_info
  implicit none
  private

  !> The array behind an `address`: NULL is refused (FUGE_ERR_POINTER), unless an error is known already; after an error
  !> the array is null. Its size has been checked.
  interface find_array
    module procedure find_values
    module procedure find_columns
  end interface find_array

  public :: find_array

contains

  !> `n` values.
  subroutine find_values(n, address, name, values, info)
    integer(c_int), intent(in) :: n
    type(c_ptr), intent(in) :: address
    character(len=*), intent(in) :: name
    real(c_double), pointer, intent(out) :: values(:)
    type(fuge_info), intent(inout) :: info

    nullify (values)
    call require_pointer(address, name, info)
    if (.not. info%failed()) call c_f_pointer(address, values, [n])
  end subroutine find_values

  !> `n` columns of so many `rows`.
  subroutine find_columns(rows, n, address, name, values, info)
    integer, intent(in) :: rows
    integer(c_int), intent(in) :: n
    type(c_ptr), intent(in) :: address
    character(len=*), intent(in) :: name
    real(c_double), pointer, intent(out) :: values(:, :)
    type(fuge_info), intent(inout) :: info

    nullify (values)
    call require_pointer(address, name, info)
    if (.not. info%failed()) call c_f_pointer(address, values, [rows, int(n)])
  end subroutine find_columns

end module fuge_c_arrays
