!> Gap functions for tests: sums of terms, closed forms of the half-plane, and functions that fail.
module gap_functions
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
  use closed_forms, only: closed_form
  use fuge_gap_function_type, only: fuge_gap_function
  use fuge_kinds, only: dp
  implicit none
  private

  public :: misplaced_share, term

  !> Kinds of terms, d being the distance from the place: factor |d|**size; factor cos(2 pi d/size);
  !> factor max(0, |d| - size)**2; factor where |d| > size; factor max(0, 1 - |d|/size).
  integer, parameter, public :: POWER = 1, COSINE = 2, BEYOND = 3, STEP = 4, TENT = 5
  !> Along what d counts: x, y, or the radius about the place.
  integer, parameter, public :: ALONG_X = 1, ALONG_Y = 2, RADIAL = 3

  type, public :: gap_term
    integer :: kind = POWER, direction = ALONG_X
    real(dp) :: factor = 0.0_dp, size = 0.0_dp, place(2) = 0.0_dp
  end type gap_term

  !> A sum of terms.
  type, extends(fuge_gap_function), public :: gap_sum
    type(gap_term), allocatable :: terms(:)
    !> Amplitudes and phases of waves along x whose lengths are 2, 2/2, 2/3 ..
    complex(dp), allocatable :: waves(:)
    !> Values at places that lie side by side, joined by straight lines.
    real(dp), allocatable :: nodes(:), values(:)
    !> Added to all.
    real(dp) :: datum = 0.0_dp
    !> Outside of these the status is 9.
    real(dp) :: lower(2) = -huge(1.0_dp), upper(2) = huge(1.0_dp)
    !> What the function returns from `fails_from` on along x, unless the status is another than 0.
    real(dp) :: fails_from = huge(1.0_dp), failure = 0.0_dp
    integer :: status = 0
  contains
    procedure :: evaluate => evaluate_sum
  end type gap_sum

  !> The initial gap of a closed form whose middle is at `place`.
  type, extends(fuge_gap_function), public :: form_gap
    class(closed_form), allocatable :: form
    real(dp) :: place = 0.0_dp
  contains
    procedure :: evaluate => evaluate_form
  end type form_gap

contains

  pure function term(kind, factor, size, place, place_y, direction)
    integer, intent(in) :: kind
    real(dp), intent(in) :: factor, size
    real(dp), intent(in), optional :: place, place_y
    integer, intent(in), optional :: direction
    type(gap_term) :: term

    term%kind = kind
    term%factor = factor
    term%size = size
    if (present(place)) term%place(1) = place
    if (present(place_y)) term%place(2) = place_y
    if (present(direction)) term%direction = direction
  end function term

  subroutine evaluate_sum(self, x, y, gap, status)
    class(gap_sum), intent(in) :: self
    real(dp), intent(in) :: x(:), y(:)
    real(dp), intent(out) :: gap(:)
    integer, intent(out) :: status
    integer :: k

    status = 0
    gap = self%datum
    if (any(x < self%lower(1) .or. x > self%upper(1) .or. y < self%lower(2) .or. y > self%upper(2))) status = 9
    if (allocated(self%terms)) then
      do k = 1, size(self%terms)
        gap = gap + value_of(self%terms(k), x, y)
      end do
    end if
    if (allocated(self%waves)) gap = gap + sum_of_waves(self%waves, x)
    if (allocated(self%nodes)) gap = gap + joined_by_lines(self%nodes, self%values, x)
    if (.not. any(x >= self%fails_from)) return
    if (self%status /= 0) status = self%status
    where (x >= self%fails_from) gap = self%failure
  end subroutine evaluate_sum

  elemental function value_of(term, x, y) result(value)
    type(gap_term), intent(in) :: term
    real(dp), intent(in) :: x, y
    real(dp) :: value
    real(dp) :: d

    select case (term%direction)
    case (ALONG_X)
      d = abs(x - term%place(1))
    case (ALONG_Y)
      d = abs(y - term%place(2))
    case default
      d = sqrt((x - term%place(1))**2 + (y - term%place(2))**2)
    end select
    select case (term%kind)
    case (POWER)
      value = term%factor*d**term%size
    case (COSINE)
      value = term%factor*cos(2.0_dp*acos(-1.0_dp)*d/term%size)
    case (BEYOND)
      value = term%factor*max(0.0_dp, d - term%size)**2
    case (STEP)
      value = merge(term%factor, 0.0_dp, d > term%size)
    case default
      value = term%factor*max(0.0_dp, 1.0_dp - d/term%size)
    end select
  end function value_of

  !> The real part of sum_k waves(k) exp(i pi k x), by Horner's rule.
  pure function sum_of_waves(waves, x) result(value)
    complex(dp), intent(in) :: waves(:)
    real(dp), intent(in) :: x(:)
    real(dp) :: value(size(x))
    complex(dp) :: turn, total
    integer :: j, k

    do j = 1, size(x)
      turn = exp(cmplx(0.0_dp, acos(-1.0_dp)*x(j), dp))
      total = 0.0_dp
      do k = size(waves), 1, -1
        total = (total + waves(k))*turn
      end do
      value(j) = real(total, dp)
    end do
  end function sum_of_waves

  pure function joined_by_lines(nodes, values, x) result(value)
    real(dp), intent(in) :: nodes(:), values(:), x(:)
    real(dp) :: value(size(x))
    integer :: j, k

    do j = 1, size(x)
      k = max(1, min(count(nodes <= x(j)), size(nodes) - 1))
      value(j) = values(k) + (values(k + 1) - values(k))*((x(j) - nodes(k))/(nodes(k + 1) - nodes(k)))
    end do
  end function joined_by_lines

  subroutine evaluate_form(self, x, y, gap, status)
    class(form_gap), intent(in) :: self
    real(dp), intent(in) :: x(:), y(:)
    real(dp), intent(out) :: gap(:)
    integer, intent(out) :: status

    status = merge(9, 0, any(ieee_is_nan(y)))
    gap = self%form%initial_gap(x - self%place)
  end subroutine evaluate_form

  !> The share of the load that forces on cells, centres `x` and widths `width`, have elsewhere than they should,
  !> counted on these cells. `fine_upto` is the exact force left of the places `fine`, ascending, joined by straight
  !> lines.
  pure function misplaced_share(x, width, force, fine, fine_upto) result(share)
    real(dp), intent(in) :: x(:), width(:), force(:), fine(:), fine_upto(:)
    real(dp) :: share
    real(dp) :: upto(size(x) + 1), borders(size(x) + 1), place
    integer :: j, k

    borders(1) = x(1) - 0.5_dp*width(1)
    borders(2:) = x + 0.5_dp*width
    j = 1
    do k = 1, size(borders)
      place = borders(k)
      do while (j < size(fine) - 1)
        if (fine(j + 1) > place) exit
        j = j + 1
      end do
      upto(k) = fine_upto(j) + (fine_upto(j + 1) - fine_upto(j)) &
                *max(0.0_dp, min(1.0_dp, (place - fine(j))/(fine(j + 1) - fine(j))))
    end do
    share = 0.5_dp*sum(abs(upto(2:) - upto(:size(x)) - force))/fine_upto(size(fine))
  end function misplaced_share

end module gap_functions
