!> Cells of a half-plane that become narrower towards the ends of a contact.
!>
!> Equal cells resolve the square root with which the pressure falls to zero at an edge of the contact, and its
!> singularity at a corner, only slowly. Cells between the values of a smooth function of equal steps t, whose
!> derivative vanishes at such an end, restore the order of the element: a change of variable as for logarithmic kernels
!> on open arcs (K. E. Atkinson and I. H. Sloan, Mathematics of Computation 56, 1991, 119-139). Here the function is the
!> incomplete beta function I_t(a, b) with whole a and b: distances grow as t**a from the left end and as (1 - t)**b
!> from the right one.
module fuge_cell_grading
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_ERR_OPTION, FUGE_ERR_OVERFLOW, FUGE_ERR_SIZE, FUGE_ERR_WIDTH
  implicit none
  private

  public :: fuge_graded_cells

  !> Kind of an end (`ends`): cells do not become narrower, as at an axis of symmetry.
  integer, parameter, public :: FUGE_END_PLAIN = 0
  !> Kind of an end: the pressure falls to zero like a square root; distances from the end grow quadratically.
  integer, parameter, public :: FUGE_END_EDGE = 1
  !> Kind of an end: a corner, at which the pressure has no limit; distances from the end grow with the fourth power.
  integer, parameter, public :: FUGE_END_CORNER = 2

  !> The exponents that belong to the kinds. At a corner the fourth power makes the pressure one of second order; the
  !> second power would leave it at the first.
  integer, parameter :: EXPONENT(0:2) = [1, 2, 4]

  !> A width has to be this many roundings of the largest coordinate, so that cells lie side by side to a thousandth.
  real(dp), parameter :: FEWEST_ROUNDINGS = 1.0e3_dp
  !> With an interval between numbers of at most this size, no cell beyond it overflows.
  real(dp), parameter :: LARGEST = 0.125_dp*huge(1.0_dp)

contains

  !> Cells side by side, ascending, that are narrow at the ends of an interval and wide in its middle.
  !>
  !> `left` < `right`: the interval, length; an expected contact, as `fuge_contact_edges` finds it on a coarse grid, or
  !> the face of a punch. `ends` (2): kinds of its left and right end, FUGE_END_PLAIN, FUGE_END_EDGE or FUGE_END_CORNER.
  !> `beyond` (2), >= 0: cells beyond the left and the right end, mirror images of those inside, so that the contact
  !> may turn out to be wider; three are enough for an end from `fuge_contact_edges`, a corner needs none. Out: `x` (N)
  !> centres and `width` (N), length; N - sum(`beyond`) >= 1 cells cover the interval, and `beyond` may be no more than
  !> these.
  !>
  !> The cells are meant for FUGE_MEAN, whose matrix is symmetric on any widths and whose gap is the mean over a cell.
  !> Several contacts: one call for each, with sections of the arrays. A symmetric model: the cells with x > 0 of an
  !> interval about 0, or those between 0, FUGE_END_PLAIN, and its right end.
  !>
  !> Errors, `x` and `width` untouched: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_OPTION for a kind of end;
  !> FUGE_ERR_WIDTH unless left < right, or if a cell would be no wider than a thousand roundings of x;
  !> FUGE_ERR_OVERFLOW.
  pure subroutine fuge_graded_cells(left, right, ends, beyond, x, width, info)
    real(dp), intent(in) :: left, right
    integer, intent(in) :: ends(2), beyond(2)
    real(dp), intent(inout) :: x(:), width(:)
    type(fuge_info), intent(out) :: info
    real(dp) :: length
    integer :: k, n

    call check_cells(ends, beyond, size(x), size(width), info)
    if (.not. info%failed()) call check_interval(left, right, info)
    if (info%failed()) return
    n = size(x) - sum(beyond)
    length = right - left
    call check_widths(left, right, ends, beyond, n, info)
    if (info%failed()) return

    do k = 1, beyond(1)
      associate (cell => beyond(1) + 1 - k, near => share(k - 1, n, ends), far => share(k, n, ends))
        x(cell) = left - 0.5_dp*length*(near + far)
        width(cell) = length*(far - near)
      end associate
    end do
    do k = 1, n
      call set_inner_cell(left, right, ends, k, n, x(beyond(1) + k), width(beyond(1) + k))
    end do
    do k = 1, beyond(2)
      associate (cell => beyond(1) + n + k, near => share(k - 1, n, ends(2:1:-1)), far => share(k, n, ends(2:1:-1)))
        x(cell) = right + 0.5_dp*length*(near + far)
        width(cell) = length*(far - near)
      end associate
    end do
  end subroutine fuge_graded_cells

  pure subroutine check_cells(ends, beyond, cells, widths, info)
    integer, intent(in) :: ends(2), beyond(2), cells, widths
    type(fuge_info), intent(inout) :: info
    character(len=*), parameter :: SIDES(2) = ['left ', 'right']
    integer :: inside, side

    if (cells /= widths) then
      call report(info, FUGE_ERR_SIZE, 'x has '//text(cells)//' value(s), width has '//text(widths))
      return
    end if
    inside = cells
    do side = 1, 2
      if (ends(side) < lbound(EXPONENT, 1) .or. ends(side) > ubound(EXPONENT, 1)) then
        call report(info, FUGE_ERR_OPTION, 'the '//trim(SIDES(side))//' end is of kind '//text(ends(side)) &
                    //': FUGE_END_PLAIN, FUGE_END_EDGE and FUGE_END_CORNER are known')
      else if (beyond(side) < 0) then
        call report(info, FUGE_ERR_SIZE, text(beyond(side))//' cells beyond the '//trim(SIDES(side))//' end')
      end if
      if (info%failed()) return
      inside = inside - min(beyond(side), inside)
    end do
    if (inside >= max(1, maxval(beyond))) return
    call report(info, FUGE_ERR_SIZE, text(beyond(1))//' and '//text(beyond(2))//' of '//text(cells) &
                //' cell(s) beyond the ends: the interval needs at least one cell, and as many as lie beyond an end')
  end subroutine check_cells

  pure subroutine check_interval(left, right, info)
    real(dp), intent(in) :: left, right
    type(fuge_info), intent(inout) :: info

    call check_finite(left, 'left', info)
    if (.not. info%failed()) call check_finite(right, 'right', info)
    if (info%failed()) return
    if (.not. left < right) then
      call report(info, FUGE_ERR_WIDTH, 'the interval from '//text(left)//' to '//text(right) &
                  //' has no length: left has to be less than right')
    else if (max(abs(left), abs(right)) > LARGEST) then
      call report(info, FUGE_ERR_OVERFLOW, 'the interval from '//text(left)//' to '//text(right) &
                  //' is so far out that the cells would overflow: measure lengths in other units')
    end if
  end subroutine check_interval

  !> Refuse cells whose ends are hardly more than rounding apart.
  pure subroutine check_widths(left, right, ends, beyond, n, info)
    real(dp), intent(in) :: left, right
    integer, intent(in) :: ends(2), beyond(2), n
    type(fuge_info), intent(inout) :: info
    real(dp) :: first, last, narrowest

    first = left - (right - left)*share(beyond(1), n, ends)
    last = right + (right - left)*share(beyond(2), n, ends(2:1:-1))
    narrowest = (right - left)*min(share(1, n, ends), share(1, n, ends(2:1:-1)))
    if (narrowest > FEWEST_ROUNDINGS*spacing(max(abs(first), abs(last)))) return
    call report(info, FUGE_ERR_WIDTH, 'a cell of width '//text(narrowest)//' between '//text(left)//' and '// &
                text(right)//' is lost in the rounding of x: take fewer cells, or measure x from the contact')
  end subroutine check_widths

  !> Cell k of n in the interval. Its sides are measured from the end which is nearer, so that widths keep their digits.
  pure subroutine set_inner_cell(left, right, ends, k, n, x, width)
    real(dp), intent(in) :: left, right
    integer, intent(in) :: ends(2), k, n
    real(dp), intent(out) :: x, width
    real(dp) :: near, far

    if (2*(k - 1) < n .and. 2*k > n) then
      near = share(k - 1, n, ends)
      far = share(n - k, n, ends(2:1:-1))
      x = 0.5_dp*((left + (right - left)*near) + (right - (right - left)*far))
      width = (right - left)*(1.0_dp - (near + far))
    else if (2*k <= n) then
      near = share(k - 1, n, ends)
      far = share(k, n, ends)
      x = left + 0.5_dp*(right - left)*(near + far)
      width = (right - left)*(far - near)
    else
      near = share(n - k, n, ends(2:1:-1))
      far = share(n - k + 1, n, ends(2:1:-1))
      x = right - 0.5_dp*(right - left)*(near + far)
      width = (right - left)*(far - near)
    end if
  end subroutine set_inner_cell

  !> The share of the interval that k of n cells cover from one end on; `ends`: the kinds of this end and of the other.
  !>
  !> I_t(a, b), t = k/n, is the probability of at least a successes in a + b - 1 trials (NIST Digital Library of
  !> Mathematical Functions, equation 8.17.5); a sum of positive terms, exact to rounding for any t.
  pure function share(k, n, ends)
    integer, intent(in) :: k, n, ends(2)
    real(dp) :: share
    real(dp) :: binomial, t
    integer :: j, trials

    t = real(k, dp)/real(n, dp)
    trials = EXPONENT(ends(1)) + EXPONENT(ends(2)) - 1
    binomial = 1.0_dp
    share = 0.0_dp
    do j = trials, EXPONENT(ends(1)), -1
      share = share + binomial*t**j*(real(n - k, dp)/real(n, dp))**(trials - j)
      binomial = binomial*real(j, dp)/real(trials - j + 1, dp)
    end do
  end function share

end module fuge_cell_grading
