!> All points of a problem, wherever they are: sums and maxima of values on them, and what is true anywhere or
!> everywhere.
!>
!> Processes may share the points. Each of them, a rank, holds some and runs the same solve as the others. Whatever
!> decides how the solve goes on is the same on all of them, because it comes from here. Alone, as without a group, a
!> process has all points, and every procedure leaves what it is given.
module fuge_point_space
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info
  implicit none
  private

  !> The ranks of a group and how they reach each other. All ranks call each procedure together, in the same order.
  type, abstract, public :: rank_group
  contains
    procedure(count_ranks), deferred :: members
    procedure(count_ranks), deferred :: number
    procedure(combine), deferred :: add
    procedure(combine), deferred :: raise
    procedure(exchange_values), deferred :: exchange
    procedure(agree_on_errors), deferred :: agree
  end type rank_group

  abstract interface
    !> How many ranks there are, or the number of this one, from 0.
    pure function count_ranks(self) result(number)
      import :: rank_group
      class(rank_group), intent(in) :: self
      integer :: number
    end function count_ranks

    !> Replace each of `values` by its sum, or by its maximum, over the ranks: the same numbers on all of them.
    subroutine combine(self, values)
      import :: rank_group, dp
      class(rank_group), intent(in) :: self
      real(dp), intent(inout), contiguous :: values(:)
    end subroutine combine

    !> Send `to(r)` values to rank r, and receive `from(r)` from it: those for and from rank 0 come first. `sent` and
    !> `received` are in use until the procedure returns.
    subroutine exchange_values(self, to, sent, from, received)
      import :: rank_group, dp
      class(rank_group), intent(in) :: self
      integer, intent(in) :: to(0:), from(0:)
      real(dp), intent(in), contiguous :: sent(:)
      real(dp), intent(inout), contiguous, asynchronous :: received(:)
    end subroutine exchange_values

    !> If `info` is an error on any rank, give all ranks that of the lowest of them; the message names it, unless all
    !> ranks have the same error.
    subroutine agree_on_errors(self, info)
      import :: rank_group, fuge_info
      class(rank_group), intent(in) :: self
      type(fuge_info), intent(inout) :: info
    end subroutine agree_on_errors
  end interface

  !> The points here and those of the other ranks of the group; without a group all points are here.
  type, public :: point_space
    class(rank_group), pointer :: group => null()
  contains
    procedure :: is_alone
    procedure :: members
    procedure :: number
    procedure :: add
    procedure :: raise
    procedure :: total
    procedure :: total_count
    procedure :: largest
    procedure :: least
    procedure :: anywhere
    procedure :: everywhere
    procedure :: take_from_least
    procedure :: keep_least
    procedure :: agree
  end type point_space

contains

  !> Does this process have all points?
  pure function is_alone(self)
    class(point_space), intent(in) :: self
    logical :: is_alone

    is_alone = .not. associated(self%group)
  end function is_alone

  !> Number of ranks.
  pure function members(self)
    class(point_space), intent(in) :: self
    integer :: members

    members = 1
    if (associated(self%group)) members = self%group%members()
  end function members

  !> Number of this rank, from 0.
  pure function number(self)
    class(point_space), intent(in) :: self
    integer :: number

    number = 0
    if (associated(self%group)) number = self%group%number()
  end function number

  !> Replace each of `values` by its sum over the ranks.
  subroutine add(self, values)
    class(point_space), intent(in) :: self
    real(dp), intent(inout), contiguous :: values(:)

    if (associated(self%group)) call self%group%add(values)
  end subroutine add

  !> Replace each of `values` by its maximum over the ranks.
  subroutine raise(self, values)
    class(point_space), intent(in) :: self
    real(dp), intent(inout), contiguous :: values(:)

    if (associated(self%group)) call self%group%raise(values)
  end subroutine raise

  !> The sum of `value` over the ranks.
  function total(self, value)
    class(point_space), intent(in) :: self
    real(dp), intent(in) :: value
    real(dp) :: total
    real(dp) :: values(1)

    total = value
    if (.not. associated(self%group)) return
    values = value
    call self%group%add(values)
    total = values(1)
  end function total

  !> The sum of the counts `value` over the ranks, at most the largest default integer.
  function total_count(self, value)
    class(point_space), intent(in) :: self
    integer, intent(in) :: value
    integer :: total_count

    total_count = value
    if (associated(self%group)) total_count = int(min(self%total(real(value, dp)), real(huge(value), dp)))
  end function total_count

  !> The maximum of `value` over the ranks.
  function largest(self, value)
    class(point_space), intent(in) :: self
    real(dp), intent(in) :: value
    real(dp) :: largest
    real(dp) :: values(1)

    largest = value
    if (.not. associated(self%group)) return
    values = value
    call self%group%raise(values)
    largest = values(1)
  end function largest

  !> The minimum of `value` over the ranks.
  function least(self, value)
    class(point_space), intent(in) :: self
    real(dp), intent(in) :: value
    real(dp) :: least

    least = value
    if (associated(self%group)) least = -self%largest(-value)
  end function least

  !> Is `flag` true on any rank?
  function anywhere(self, flag)
    class(point_space), intent(in) :: self
    logical, intent(in) :: flag
    logical :: anywhere

    anywhere = flag
    if (associated(self%group)) anywhere = self%largest(merge(1.0_dp, 0.0_dp, flag)) > 0.0_dp
  end function anywhere

  !> Is `flag` true on all ranks?
  function everywhere(self, flag)
    class(point_space), intent(in) :: self
    logical, intent(in) :: flag
    logical :: everywhere

    everywhere = flag
    if (associated(self%group)) everywhere = self%largest(merge(0.0_dp, 1.0_dp, flag)) <= 0.0_dp
  end function everywhere

  !> Replace `values` by those of the rank whose `key` is least, the lowest of several.
  subroutine take_from_least(self, key, values)
    class(point_space), intent(in) :: self
    real(dp), intent(in) :: key
    real(dp), intent(inout), contiguous :: values(:)
    real(dp) :: owner

    if (.not. associated(self%group)) return
    owner = real(self%number(), dp)
    owner = self%least(merge(owner, huge(owner), key <= self%least(key)))
    if (abs(owner - real(self%number(), dp)) > 0.0_dp) values = 0.0_dp
    call self%group%add(values)
  end subroutine take_from_least

  !> Of a `point` of each rank only that with the least `key` remains, the others become 0.
  subroutine keep_least(self, key, point)
    class(point_space), intent(in) :: self
    real(dp), intent(in) :: key
    integer, intent(inout) :: point
    real(dp) :: owner(1)

    owner = real(self%number(), dp)
    call self%take_from_least(key, owner)
    if (abs(owner(1) - real(self%number(), dp)) > 0.0_dp) point = 0
  end subroutine keep_least

  !> If `info` is an error on any rank, give it to all ranks; the message names the rank.
  subroutine agree(self, info)
    class(point_space), intent(in) :: self
    type(fuge_info), intent(inout) :: info

    if (associated(self%group)) call self%group%agree(info)
  end subroutine agree

end module fuge_point_space
