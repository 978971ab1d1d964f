!> Plans for transforms of the values of a line.
module fuge_line_plan
  use fuge_fft, only: fft_plan
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: is_folded

  !> Fewer values stay in cache, and take less time than it takes to wake a thread.
  integer, parameter :: FEWEST_FOLDED = 2**16

  !> Transforms of one length. Copy it by `copy_from`.
  type, public :: line_plan
    !> Number of values; 0 before `set`.
    integer :: length = 0
    type(fft_plan) :: whole
    !> Of half as many values, for circles that are folded.
    type(fft_plan) :: half
  contains
    procedure :: set
    procedure :: copy_from
    procedure :: move_from
  end type line_plan

contains

  !> Is a cyclic convolution of `length` values done on two circles of half the length (fuge_convolution)?
  pure function is_folded(length) result(folded)
    integer, intent(in) :: length
    logical :: folded

    folded = length >= FEWEST_FOLDED .and. mod(length, 4) == 0
  end function is_folded

  !> Plan transforms of `length` >= 1 values. `measured` (default .false.) as in fuge_fft. Errors, the plan unchanged:
  !> those of an fft_plan.
  subroutine set(self, length, info, measured)
    class(line_plan), intent(inout) :: self
    integer, intent(in) :: length
    type(fuge_info), intent(inout) :: info
    logical, intent(in), optional :: measured
    type(line_plan) :: new

    call new%whole%set(length, info, measured)
    if (.not. info%failed() .and. is_folded(length)) call new%half%set(length/2, info, measured)
    if (info%failed()) return
    new%length = length
    call self%move_from(new)
  end subroutine set

  !> Plan anew what `source` plans; without memory the copy plans nothing.
  subroutine copy_from(self, source)
    class(line_plan), intent(inout) :: self
    class(line_plan), intent(in) :: source

    self%whole = source%whole
    self%half = source%half
    self%length = 0
    if (self%whole%length == source%whole%length .and. self%half%length == source%half%length) &
      self%length = source%length
  end subroutine copy_from

  !> Move the plans from `source`, which has none afterwards.
  subroutine move_from(self, source)
    class(line_plan), intent(inout) :: self, source

    call self%whole%move_from(source%whole)
    call self%half%move_from(source%half)
    self%length = source%length
    source%length = 0
  end subroutine move_from

end module fuge_line_plan
