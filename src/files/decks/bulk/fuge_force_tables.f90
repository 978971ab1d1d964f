!> Tables of force over elongation that are one-way: no force on one side, a line from there, and perhaps a limit.
module fuge_force_tables
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  implicit none
  private

  public :: find_one_way_law

  !> Points are on a line if they leave it by no more than this fraction: a deck has few digits.
  real(dp), parameter :: ROUNDING = 1.0e-5_dp

  !> The force of a cable or a strut: from the gap on, with a compliance, up to a limit.
  type, public :: one_way_law
    !> It pulls; otherwise it pushes.
    logical :: tension = .false.
    !> Elongation, or shortening, at which the force begins.
    real(dp) :: gap = 0.0_dp
    real(dp) :: compliance = 0.0_dp
    !> huge(1.0_dp): none.
    real(dp) :: limit = huge(1.0_dp)
  end type one_way_law

contains

  !> The law of a table of elongations `x`, ascending, and tensile forces `y`; both go on as their last lines beyond the
  !> ends. `reason` if it is no such law.
  pure subroutine find_one_way_law(x, y, law, reason)
    real(dp), intent(in) :: x(:), y(:)
    type(one_way_law), intent(out) :: law
    character(len=:), allocatable, intent(inout) :: reason
    real(dp), dimension(size(x)) :: opening, force
    integer :: k, n

    n = size(x)
    if (allocated(reason)) return
    if (n < 3) then
      reason = 'three points or more are needed: two without force, and one with'
      return
    end if
    if (any(x(2:) <= x(:n - 1))) then
      k = findloc(x(2:) <= x(:n - 1), .true., dim=1)
      reason = 'x = '//text(x(k + 1))//' follows x = '//text(x(k))//', but x must ascend'
      return
    end if
    ! A strut in the mirror is a cable.
    law%tension = maxval(y) > -minval(y)
    opening = merge(x, -x(n:1:-1), law%tension)
    force = merge(y, -y(n:1:-1), law%tension)
    call find_cable(opening, force, law, reason)
  end subroutine find_one_way_law

  !> The law of a cable: forces are zero up to some point, then on a line, then perhaps constant.
  pure subroutine find_cable(x, force, law, reason)
    real(dp), intent(in) :: x(:), force(:)
    type(one_way_law), intent(inout) :: law
    character(len=:), allocatable, intent(inout) :: reason
    real(dp) :: largest, slope
    integer :: first, last, n

    n = size(x)
    largest = maxval(force)
    first = findloc(force > 0.0_dp, .true., dim=1)
    if (first < 3 .or. any(force < 0.0_dp)) then
      reason = 'a one-way spring has no force at two points or more on one side, and no change of sign'
      return
    end if
    last = n
    if (force(n) <= force(n - 1)) then
      law%limit = largest
      last = findloc(force >= largest, .true., dim=1)
    end if
    slope = force(last)/(x(last) - x(first - 1))
    ! The first point on the line may lie beyond its begin.
    law%gap = x(first - 1)
    if (last > first) then
      slope = (force(last) - force(first))/(x(last) - x(first))
      if (slope > 0.0_dp) law%gap = x(first) - force(first)/slope
    end if
    if (.not. slope > 0.0_dp .or. any(abs(force(first:last) - slope*(x(first:last) - law%gap)) > ROUNDING*largest) &
        .or. abs(law%gap - x(first - 1)) > ROUNDING*(x(last) - x(first - 1)) &
        .or. any(abs(force(last:) - merge(largest, slope*(x(last:) - law%gap), last < n)) > ROUNDING*largest)) then
      reason = 'the force must rise on one line from where it begins, and may then be constant'
      return
    end if
    law%compliance = 1.0_dp/slope
    law%gap = x(first - 1)
  end subroutine find_cable

end module fuge_force_tables
