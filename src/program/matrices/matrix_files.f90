!> Matrix Market files: matrices and vectors of the right size.
module matrix_files
  use fuge_core, only: dp => fuge_dp, fuge_info, fuge_problem, FUGE_ERR_SIZE
  use fuge_files, only: fuge_read_matrix
  implicit none
  private

  public :: read_square, read_vector, read_modes, refuse_size

contains

  !> A matrix n x n, n > 0.
  subroutine read_square(path, matrix, info)
    character(len=*), intent(in) :: path
    real(dp), allocatable, intent(inout) :: matrix(:, :)
    type(fuge_info), intent(out) :: info

    call fuge_read_matrix(path, matrix, info)
    if (info%failed()) return
    if (size(matrix, 1) /= size(matrix, 2) .or. size(matrix) == 0) then
      call refuse_size(path, shape(matrix), 'a square one is needed', info)
    end if
  end subroutine read_square

  !> A matrix of n rows and one column, or of one row and n columns.
  subroutine read_vector(path, n, vector, info)
    character(len=*), intent(in) :: path
    integer, intent(in) :: n
    real(dp), allocatable, intent(inout) :: vector(:)
    type(fuge_info), intent(out) :: info
    real(dp), allocatable :: matrix(:, :)
    character(len=24) :: wanted

    call fuge_read_matrix(path, matrix, info)
    if (info%failed()) return
    write (wanted, '(i0,a)') n, ' x 1'
    if (any(shape(matrix) /= [n, 1]) .and. any(shape(matrix) /= [1, n])) then
      call refuse_size(path, shape(matrix), trim(wanted)//' is needed', info)
    else
      vector = reshape(matrix, [n])
    end if
  end subroutine read_vector

  !> Rigid motions and their resultants.
  subroutine read_modes(path, resultant, n, problem, info)
    character(len=*), intent(in) :: path, resultant
    integer, intent(in) :: n
    type(fuge_problem), intent(inout) :: problem
    type(fuge_info), intent(out) :: info
    character(len=24) :: wanted

    call fuge_read_matrix(path, problem%modes, info)
    if (info%failed()) return
    write (wanted, '(i0,a)') n, ' rows'
    if (size(problem%modes, 1) /= n) then
      call refuse_size(path, shape(problem%modes), trim(wanted)//' are needed', info)
    else
      call read_vector(resultant, size(problem%modes, 2), problem%resultant, info)
    end if
  end subroutine read_modes

  pure subroutine refuse_size(path, found, wanted, info)
    character(len=*), intent(in) :: path, wanted
    integer, intent(in) :: found(2)
    type(fuge_info), intent(inout) :: info
    character(len=32) :: there

    write (there, '(i0,a,i0)') found(1), ' x ', found(2)
    info%status = FUGE_ERR_SIZE
    info%message = '"'//path//'": a matrix of '//trim(there)//', '//wanted
  end subroutine refuse_size

end module matrix_files
