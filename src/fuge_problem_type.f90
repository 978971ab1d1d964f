!> The contact problem without its operator, and the check of its data.
!>
!>     c = gap + A f - R q     c >= 0, f >= 0, f.c = 0     R^T f = resultant
!>
!> (paper, equations 9 to 11; R is the column of ones, q is the approach v_0).
module fuge_problem_type
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_check, only: check_finite, LARGEST_EXPONENT
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info, report, FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_NO_EQUILIBRIUM, &
    FUGE_ERR_MEMORY, FUGE_ERR_OVERFLOW
  use fuge_text, only: text
  implicit none
  private

  public :: set_problem, check_problem, check_load

  !> The data beside the operator, in the operator's units. Components may be added:
  !> set them by name.
  type, public :: fuge_problem
    !> Initial gap a + b with the external load included, (n), length; any datum.
    real(dp), allocatable :: gap(:)
    !> Resultant of the contact forces in each rigid motion, (m), force; m = 1: the load F_0.
    real(dp), allocatable :: resultant(:)
  end type fuge_problem

  !> The answer, in the same units.
  type, public :: fuge_solution
    !> Contact forces F, (n), force, none negative.
    real(dp), allocatable :: force(:)
    !> Gaps c, (n), length, none negative.
    real(dp), allocatable :: gap(:)
    !> Rigid motions q, (m), length; m = 1: the approach v_0.
    real(dp), allocatable :: rigid(:)
  end type fuge_solution

contains

  !> A problem with one load. Error: FUGE_ERR_MEMORY.
  pure subroutine set_problem(gap, load, problem, info)
    real(dp), intent(in) :: gap(:), load
    type(fuge_problem), intent(out) :: problem
    type(fuge_info), intent(inout) :: info
    integer :: stat

    allocate (problem%gap(size(gap)), problem%resultant(1), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for a copy of the gaps')
    else
      problem%gap = gap
      problem%resultant = load
    end if
  end subroutine set_problem

  !> Refuse data that no engine can use: wrong sizes (FUGE_ERR_SIZE), NaN or
  !> infinity (FUGE_ERR_NOT_FINITE), gaps near overflow (FUGE_ERR_OVERFLOW), a pulling
  !> load (FUGE_ERR_NO_EQUILIBRIUM).
  pure subroutine check_problem(problem, n, info)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: n
    type(fuge_info), intent(inout) :: info
    integer :: length

    call check_length(problem%gap, n, 'gap', info)
    if (info%failed()) return
    call check_length(problem%resultant, 1, 'resultant', info)
    if (info%failed()) return
    call check_finite(problem%gap, 'gap', info)
    if (info%failed()) return
    length = exponent(maxval(abs(problem%gap)))
    if (length > LARGEST_EXPONENT) then
      call report(info, FUGE_ERR_OVERFLOW, 'gaps reach 2**'//text(length)//': choose units in which they are smaller')
      return
    end if
    call check_load(problem%resultant(1), info)
  end subroutine check_problem

  !> Refuse a load that is not finite (FUGE_ERR_NOT_FINITE) or pulls
  !> (FUGE_ERR_NO_EQUILIBRIUM).
  pure subroutine check_load(load, info)
    real(dp), intent(in) :: load
    type(fuge_info), intent(inout) :: info

    if (.not. ieee_is_finite(load)) then
      call report(info, FUGE_ERR_NOT_FINITE, 'load F_0 = '//text(load)//' is not a finite number')
    else if (load < 0.0_dp) then
      call report(info, FUGE_ERR_NO_EQUILIBRIUM, 'load F_0 = '//text(load) &
                  //' is negative: contact forces can only push, so F_0 must be >= 0')
    end if
  end subroutine check_load

  pure subroutine check_length(values, expected, name, info)
    real(dp), intent(in), allocatable :: values(:)
    integer, intent(in) :: expected
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info

    if (.not. allocated(values)) then
      call report(info, FUGE_ERR_SIZE, name//' is not allocated: it needs '//text(expected)//' value(s)')
    else if (size(values) /= expected) then
      call report(info, FUGE_ERR_SIZE, name//' has '//text(size(values))//' value(s): it needs ' &
        //text(expected))
    end if
  end subroutine check_length

end module fuge_problem_type
