!> The envelope of load cases: the smallest and the largest value of each row, and the cases that have them.
module fuge_case_envelope
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_SIZE
  implicit none
  private

  public :: fuge_find_envelope

  !> The envelope of n rows. A row without any value is NaN, its cases are 0.
  type, public :: fuge_envelope
    !> The smallest and the largest value of each row, (n).
    real(dp), allocatable :: smallest(:), largest(:)
    !> The first case that has it, (n).
    integer, allocatable :: smallest_case(:), largest_case(:)
  end type fuge_envelope

contains

  !> The envelope of `values` (n, cases), such as the forces of fuge_case_solutions or the displacements of all degrees
  !> of freedom; NaN, as of cases without a solution, does not count. `envelope` is replaced on success. Errors:
  !> FUGE_ERR_SIZE without cases, FUGE_ERR_MEMORY.
  subroutine fuge_find_envelope(values, envelope, info)
    real(dp), intent(in) :: values(:, :)
    type(fuge_envelope), intent(inout) :: envelope
    type(fuge_info), intent(out) :: info
    type(fuge_envelope) :: found
    integer :: n, stat

    n = size(values, 1)
    if (size(values, 2) < 1) then
      call report(info, FUGE_ERR_SIZE, 'the values have no column: an envelope needs at least one load case')
      return
    end if
    allocate (found%smallest(n), found%largest(n), found%smallest_case(n), found%largest_case(n), stat=stat)
    call require_memory(stat, 'the envelope of', n, 'rows', info)
    if (stat /= 0) return
    call find_extremes(values, found)
    call move_alloc(found%smallest, envelope%smallest)
    call move_alloc(found%largest, envelope%largest)
    call move_alloc(found%smallest_case, envelope%smallest_case)
    call move_alloc(found%largest_case, envelope%largest_case)
  end subroutine fuge_find_envelope

  !> Smallest and largest values, case by case. NaN is not compared, which would be an invalid operation.
  pure subroutine find_extremes(values, found)
    real(dp), intent(in) :: values(:, :)
    type(fuge_envelope), intent(inout) :: found
    integer :: i, k

    found%smallest = values(:, 1)
    found%largest = values(:, 1)
    found%smallest_case = 0
    found%largest_case = 0
    do k = 1, size(values, 2)
      do i = 1, size(values, 1)
        if (ieee_is_nan(values(i, k))) cycle
        if (found%smallest_case(i) < 1) then
          call take(values(i, k), k, found%smallest(i), found%smallest_case(i))
          call take(values(i, k), k, found%largest(i), found%largest_case(i))
        else if (values(i, k) < found%smallest(i)) then
          call take(values(i, k), k, found%smallest(i), found%smallest_case(i))
        else if (values(i, k) > found%largest(i)) then
          call take(values(i, k), k, found%largest(i), found%largest_case(i))
        end if
      end do
    end do
  end subroutine find_extremes

  pure subroutine take(value, which, extreme, extreme_case)
    real(dp), intent(in) :: value
    integer, intent(in) :: which
    real(dp), intent(out) :: extreme
    integer, intent(out) :: extreme_case

    extreme = value
    extreme_case = which
  end subroutine take

end module fuge_case_envelope
