!> How long a search may go on without progress, before a slower method that ends takes its place.
!>
!> Each step spends a stall, and progress renews them all. In an exchange of points progress is a new minimum of wrong
!> points.
module fuge_stall_counter
  implicit none
  private

  !> The stalls of one search.
  type, public :: stall_counter
    !> Steps in a row that may bring no progress.
    integer :: limit = 0
    !> Stalls that are left; negative once the search has stalled.
    integer :: left = 0
    !> Fewest wrong points so far.
    integer :: fewest_wrong = huge(1)
  contains
    procedure :: start
    procedure :: spend
    procedure :: renew
    procedure :: renew_if_fewer
    procedure :: give_up
    procedure :: has_stalled
  end type stall_counter

contains

  !> Begin a search that may stall `limit` times in a row.
  elemental subroutine start(self, limit)
    class(stall_counter), intent(inout) :: self
    integer, intent(in) :: limit

    self%limit = limit
    self%left = limit
    self%fewest_wrong = huge(limit)
  end subroutine start

  !> Count a step, which is a stall unless the stalls are renewed.
  elemental subroutine spend(self)
    class(stall_counter), intent(inout) :: self

    self%left = self%left - 1
  end subroutine spend

  !> There has been progress.
  elemental subroutine renew(self)
    class(stall_counter), intent(inout) :: self

    self%left = self%limit
  end subroutine renew

  !> Renew the stalls if fewer points are `wrong` than ever before.
  elemental subroutine renew_if_fewer(self, wrong)
    class(stall_counter), intent(inout) :: self
    integer, intent(in) :: wrong

    if (wrong < self%fewest_wrong) call self%renew()
    self%fewest_wrong = min(self%fewest_wrong, wrong)
  end subroutine renew_if_fewer

  !> Let the search count as stalled, whatever is left.
  elemental subroutine give_up(self)
    class(stall_counter), intent(inout) :: self

    self%left = -1
  end subroutine give_up

  !> Have more steps in a row brought no progress than may?
  elemental function has_stalled(self)
    class(stall_counter), intent(in) :: self
    logical :: has_stalled

    has_stalled = self%left < 0
  end function has_stalled

end module fuge_stall_counter
