!> Numbers and arrays of C as C bindings see them: `find_array` for those of which none may be NULL, `give` to copy
!> results to them.
module fuge_c_arrays
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_associated, c_f_pointer
  use fuge_c_types, only: require_pointer
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: find_array, give

  !> The array behind an `address`, or the number there: NULL is refused (FUGE_ERR_POINTER), unless an error is known
  !> already; after an error the pointer is null. Sizes are checked before the array is used, here or by the caller.
  interface find_array
    module procedure find_real
    module procedure find_reals
    module procedure find_real_columns
    module procedure find_integers
    module procedure find_integer_columns
  end interface find_array

  !> Copy a number or an array to C, a matrix column by column; NULL is left alone.
  interface give
    module procedure give_real
    module procedure give_reals
    module procedure give_real_columns
    module procedure give_integer
    module procedure give_integers
    module procedure give_integer_columns
  end interface give

contains

  subroutine find_real(address, name, number, info)
    type(c_ptr), intent(in) :: address
    character(len=*), intent(in) :: name
    real(c_double), pointer, intent(out) :: number
    type(fuge_info), intent(inout) :: info

    nullify (number)
    call require_pointer(address, name, info)
    if (.not. info%failed()) call c_f_pointer(address, number)
  end subroutine find_real

  !> `n` values.
  subroutine find_reals(n, address, name, values, info)
    integer(c_int), intent(in) :: n
    type(c_ptr), intent(in) :: address
    character(len=*), intent(in) :: name
    real(c_double), pointer, intent(out) :: values(:)
    type(fuge_info), intent(inout) :: info

    nullify (values)
    call require_pointer(address, name, info)
    if (.not. info%failed()) call c_f_pointer(address, values, [n])
  end subroutine find_reals

  !> `n` columns of `rows` values each.
  subroutine find_real_columns(rows, n, address, name, values, info)
    integer, intent(in) :: rows
    integer(c_int), intent(in) :: n
    type(c_ptr), intent(in) :: address
    character(len=*), intent(in) :: name
    real(c_double), pointer, intent(out) :: values(:, :)
    type(fuge_info), intent(inout) :: info

    nullify (values)
    call require_pointer(address, name, info)
    if (.not. info%failed()) call c_f_pointer(address, values, [rows, int(n)])
  end subroutine find_real_columns

  !> `n` values.
  subroutine find_integers(n, address, name, values, info)
    integer(c_int), intent(in) :: n
    type(c_ptr), intent(in) :: address
    character(len=*), intent(in) :: name
    integer(c_int), pointer, intent(out) :: values(:)
    type(fuge_info), intent(inout) :: info

    nullify (values)
    call require_pointer(address, name, info)
    if (.not. info%failed()) call c_f_pointer(address, values, [n])
  end subroutine find_integers

  !> `n` columns of `rows` values each.
  subroutine find_integer_columns(rows, n, address, name, values, info)
    integer, intent(in) :: rows
    integer(c_int), intent(in) :: n
    type(c_ptr), intent(in) :: address
    character(len=*), intent(in) :: name
    integer(c_int), pointer, intent(out) :: values(:, :)
    type(fuge_info), intent(inout) :: info

    nullify (values)
    call require_pointer(address, name, info)
    if (.not. info%failed()) call c_f_pointer(address, values, [rows, int(n)])
  end subroutine find_integer_columns

  subroutine give_real(number, destination)
    real(c_double), intent(in) :: number
    type(c_ptr), intent(in) :: destination

    call give_reals([number], destination)
  end subroutine give_real

  subroutine give_reals(values, destination)
    real(c_double), intent(in) :: values(:)
    type(c_ptr), intent(in) :: destination
    real(c_double), pointer :: array(:)

    if (.not. c_associated(destination)) return
    call c_f_pointer(destination, array, [size(values)])
    array = values
  end subroutine give_reals

  subroutine give_real_columns(values, destination)
    real(c_double), intent(in) :: values(:, :)
    type(c_ptr), intent(in) :: destination
    real(c_double), pointer :: array(:, :)

    if (.not. c_associated(destination)) return
    call c_f_pointer(destination, array, shape(values))
    array = values
  end subroutine give_real_columns

  subroutine give_integer(number, destination)
    integer, intent(in) :: number
    type(c_ptr), intent(in) :: destination

    call give_integers([number], destination)
  end subroutine give_integer

  subroutine give_integers(values, destination)
    integer, intent(in) :: values(:)
    type(c_ptr), intent(in) :: destination
    integer(c_int), pointer :: array(:)

    if (.not. c_associated(destination)) return
    call c_f_pointer(destination, array, [size(values)])
    array = int(values, c_int)
  end subroutine give_integers

  subroutine give_integer_columns(values, destination)
    integer, intent(in) :: values(:, :)
    type(c_ptr), intent(in) :: destination
    integer(c_int), pointer :: array(:, :)

    if (.not. c_associated(destination)) return
    call c_f_pointer(destination, array, shape(values))
    array = int(values, c_int)
  end subroutine give_integer_columns

end module fuge_c_arrays
