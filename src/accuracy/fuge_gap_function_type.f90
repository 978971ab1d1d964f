!> The initial gap of a contact as a function of position, for solves that choose their own grids.
module fuge_gap_function_type
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, require_memory, FUGE_DONE, FUGE_ERR_CALLBACK, FUGE_ERR_MEMORY
  implicit none
  private

  public :: sample_gap, sample_grid

  !> Extend it for a gap of your own. It may have edges, kinks and jumps, and is never evaluated outside of the
  !> interval or the rectangle of the solve.
  type, abstract, public :: fuge_gap_function
  contains
    !> Gaps at given positions.
    procedure(evaluate_at), deferred :: evaluate
  end type fuge_gap_function

  abstract interface
    !> The initial `gap` (size(x)), length, at positions `x` and `y` (size(x)), length; on a line y is 0. A `status`
    !> other than 0 ends the solve with FUGE_ERR_CALLBACK, but FUGE_ERR_MEMORY with that, and so does a gap that is not
    !> finite.
    subroutine evaluate_at(self, x, y, gap, status)
      import :: fuge_gap_function, dp
      class(fuge_gap_function), intent(in) :: self
      real(dp), intent(in) :: x(:), y(:)
      real(dp), intent(out) :: gap(:)
      integer, intent(out) :: status
    end subroutine evaluate_at
  end interface

contains

  !> Evaluate a gap function and check what it returns. Error: FUGE_ERR_CALLBACK; the message has the position.
  subroutine sample_gap(function, x, y, gap, info)
    class(fuge_gap_function), intent(in) :: function
    real(dp), intent(in) :: x(:), y(:)
    real(dp), intent(out) :: gap(:)
    type(fuge_info), intent(inout) :: info
    integer :: status, k

    call function%evaluate(x, y, gap, status)
    if (status == FUGE_ERR_MEMORY) then
      call report(info, status, 'no memory for '//text(size(x))//' places of the gap function')
      return
    else if (status /= FUGE_DONE) then
      call report(info, FUGE_ERR_CALLBACK, 'the gap function returned the status '//text(status)//' at ' &
                  //text(size(x))//' point(s) from x = '//text(x(1))//', y = '//text(y(1)))
      return
    end if
    do k = 1, size(x)
      if (ieee_is_finite(gap(k))) cycle
      call report(info, FUGE_ERR_CALLBACK, 'the gap function returned '//text(gap(k))//' at x = '//text(x(k)) &
                  //', y = '//text(y(k))//': where the bodies do not end, the gap has to be finite; ' &
                  //'a large one keeps a place out of contact')
      return
    end do
  end subroutine sample_gap

  !> Evaluate it on the grid of `x` (nx) and `y` (ny); `gap` (nx*ny), x running first. Errors: FUGE_ERR_CALLBACK,
  !> FUGE_ERR_MEMORY.
  subroutine sample_grid(function, x, y, gap, info)
    class(fuge_gap_function), intent(in) :: function
    real(dp), intent(in) :: x(:), y(:)
    real(dp), intent(out) :: gap(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: place(:, :)
    integer :: j, stat

    allocate (place(size(gap), 2), stat=stat)
    call require_memory(stat, 'the places of', size(gap), 'cells', info)
    if (stat /= 0) return
    do j = 1, size(y)
      place(size(x)*(j - 1) + 1:size(x)*j, 1) = x
      place(size(x)*(j - 1) + 1:size(x)*j, 2) = y(j)
    end do
    call sample_gap(function, place(:, 1), place(:, 2), gap, info)
  end subroutine sample_grid

end module fuge_gap_function_type
