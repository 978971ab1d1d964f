!> C bindings, section "operators".
module fuge_c_operator
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t, c_loc, c_associated, c_f_pointer
  use fuge_c_arrays, only: find_array
  use fuge_c_types, only: report_to_c, require_count, require_pointer, set_handle, take_handle
  use fuge_constants, only: LARGEST_EXPONENT
  use fuge_grid_operator_type, only: grid_operator
  use fuge_input_checks, only: check_finite, is_finite_everywhere
  use fuge_matrix_operator, only: fuge_dense_operator
  use fuge_number_text, only: text
  use fuge_operator_products, only: multiply
  use fuge_operator_type, only: fuge_operator
  use fuge_point_space, only: point_space
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_CALLBACK, FUGE_ERR_OVERFLOW, FUGE_ERR_SIZE
  implicit none
  private

  public :: find_matrix, find_operator, new_operator

  !> Behind struct fuge_operator.
  type, public :: operator_handle
    class(fuge_operator), allocatable :: operator
  end type operator_handle

contains

  function c_operator_dense(n, alpha, lda, destination, message, length) &
    bind(c, name='fuge_operator_dense') result(status)
    integer(c_int), intent(in), value :: n, lda
    type(c_ptr), intent(in), value :: alpha, destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_dense_operator), allocatable :: dense
    class(fuge_operator), allocatable :: operator
    real(c_double), pointer :: matrix(:, :)
    type(fuge_info) :: info

    allocate (dense)
    call find_matrix(n, alpha, lda, matrix, info)
    call require_pointer(destination, 'op', info)
    if (.not. info%failed()) call dense%set(matrix, info)
    call move_alloc(dense, operator)
    call new_operator(operator, destination, info)
    status = report_to_c(info, message, length)
  end function c_operator_dense

  function c_operator_apply(operator, n, force, displacement, message, length) &
    bind(c, name='fuge_operator_apply') result(status)
    type(c_ptr), intent(in), value :: operator, force, displacement, message
    integer(c_int), intent(in), value :: n
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(operator_handle), pointer :: handle
    real(c_double), pointer :: forces(:), displacements(:)
    real(c_double), allocatable :: product(:)
    type(point_space) :: space
    type(fuge_info) :: info

    call find_operator(operator, 'op', handle, info)
    if (.not. info%failed()) then
      if (n /= handle%operator%points()) call report(info, FUGE_ERR_SIZE, 'n = '//text(int(n))//', but op has ' &
                                                     //text(handle%operator%points())//' points')
    end if
    call find_array(n, force, 'f', forces, info)
    call find_array(n, displacement, 'u', displacements, info)
    if (.not. info%failed()) call check_forces(forces, info)
    if (associated(handle)) then
      space = handle%operator%ranks()
      call space%agree(info)
    end if
    if (.not. info%failed()) call find_product(handle%operator, forces, product, info)
    if (.not. info%failed()) displacements = product
    status = report_to_c(info, message, length)
  end function c_operator_apply

  !> Refuse forces that are not finite, or too large to be summed.
  pure subroutine check_forces(force, info)
    real(c_double), intent(in) :: force(:)
    type(fuge_info), intent(inout) :: info

    call check_finite(force, 'f', info)
    if (info%failed() .or. size(force) < 1) return
    if (exponent(maxval(abs(force))) > LARGEST_EXPONENT) &
      call report(info, FUGE_ERR_OVERFLOW, 'f has a force of '//text(maxval(abs(force))) &
                  //': choose a larger unit of force')
  end subroutine check_forces

  !> u = A f with the datum, in an array of its own, because the caller's stays as it is after an error. Ranks that
  !> share the points end with the same status.
  subroutine find_product(operator, force, displacement, info)
    class(fuge_operator), intent(in) :: operator
    real(c_double), intent(in) :: force(:)
    real(c_double), allocatable, intent(out) :: displacement(:)
    type(fuge_info), intent(inout) :: info
    type(point_space) :: space
    integer :: stat

    space = operator%ranks()
    allocate (displacement(size(force)), stat=stat)
    call require_memory(stat, '', size(force), 'displacements', info)
    call space%agree(info)
    if (info%failed()) return
    call multiply(operator, force, displacement, info)
    ! No function of the caller is to blame for a product of the library: it is out of range, which is judged below.
    if (info%status == FUGE_ERR_CALLBACK .and. is_of_library(operator)) info = fuge_info()
    if (info%failed()) return
    displacement = displacement + operator%datum()*space%total(sum(force))
    if (.not. is_finite_everywhere(displacement)) &
      call report(info, FUGE_ERR_OVERFLOW, 'the displacements are too large: choose units in which forces and ' &
                  //'compliances are nearer to 1')
    call space%agree(info)
  end subroutine find_product

  !> Does the library itself form the products of the operator?
  pure function is_of_library(operator) result(own)
    class(fuge_operator), intent(in) :: operator
    logical :: own

    own = .false.
    select type (operator)
    type is (fuge_dense_operator)
      own = .true.
    class is (grid_operator)
      own = .true.
    end select
  end function is_of_library

  !> Put `operator` behind a handle at `destination`, unless an error is known already; FUGE_ERR_MEMORY.
  subroutine new_operator(operator, destination, info)
    class(fuge_operator), allocatable, intent(inout) :: operator
    type(c_ptr), intent(in) :: destination
    type(fuge_info), intent(inout) :: info
    type(operator_handle), pointer :: handle
    integer :: stat

    if (info%failed()) return
    allocate (handle, stat=stat)
    call require_memory(stat, 'the operator', info)
    if (stat /= 0) return
    ! Moved, not copied: an operator may own what must not be shared.
    call move_alloc(operator, handle%operator)
    call set_handle(c_loc(handle), destination)
  end subroutine new_operator

  !> The operator behind a handle, the argument `name`; unless an error is known already, NULL is one.
  subroutine find_operator(address, name, handle, info)
    type(c_ptr), intent(in) :: address
    character(len=*), intent(in) :: name
    type(operator_handle), pointer, intent(out) :: handle
    type(fuge_info), intent(inout) :: info

    nullify (handle)
    call require_pointer(address, name, info)
    if (.not. info%failed()) call c_f_pointer(address, handle)
  end subroutine find_operator

  !> The matrix at `alpha`, all lda rows of its n columns; FUGE_ERR_SIZE, FUGE_ERR_POINTER.
  subroutine find_matrix(n, alpha, lda, matrix, info)
    integer(c_int), intent(in) :: n, lda
    type(c_ptr), intent(in) :: alpha
    real(c_double), pointer, intent(out) :: matrix(:, :)
    type(fuge_info), intent(inout) :: info

    call require_count(n, 1, 'n', 'contact points', info)
    if (.not. info%failed() .and. lda < n) call report(info, FUGE_ERR_SIZE, 'lda = '//text(int(lda)) &
      //' is less than n = '//text(int(n))//': it is the distance between columns, in doubles')
    call find_array(int(lda), n, alpha, 'alpha', matrix, info)
  end subroutine find_matrix

  subroutine c_operator_free(source) bind(c, name='fuge_operator_free')
    type(c_ptr), intent(in), value :: source
    type(operator_handle), pointer :: handle
    type(c_ptr) :: address

    address = take_handle(source)
    if (.not. c_associated(address)) return
    call c_f_pointer(address, handle)
    ! Apart, because flang 22 would leak what an extension of fuge_operator has allocated.
    deallocate (handle%operator)
    deallocate (handle)
  end subroutine c_operator_free

end module fuge_c_operator
