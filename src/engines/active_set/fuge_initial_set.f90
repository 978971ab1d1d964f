!> A first guess of the contact set by a few projected conjugate gradients
!> (I. A. Polonsky, L. M. Keer, Wear 231, 1999), each two products with alpha.
module fuge_initial_set
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgemv
  implicit none
  private

  public :: guess_contact_set

  !> Most iterations; one costs about as much as a few percent of a factorisation.
  integer, parameter :: MOST_ITERATIONS = 12
  !> Good enough when fewer than one point in this many changes sides, this many times running:
  !> beside wide cells nothing may happen for once.
  integer, parameter :: SETTLED = 64, QUIET = 2
  !> Nor if more than one open point in this many has changed: those may be few and wide.
  integer, parameter :: FEW_OPEN = 8
  !> Slopes below this part of the lengths that make them are rounding.
  real(dp), parameter :: ROUNDING = 1.0e-13_dp

contains

  !> The points that probably touch, (n), at least one.
  !>
  !> `alpha` (at least n rows, n columns), `gap` (n), `load` > 0; `products` is raised
  !> by the products with alpha. Forces are kept as parts of the load and lengths as
  !> parts of a length of the scene, so that units do not matter.
  subroutine guess_contact_set(alpha, gap, load, contact, products)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: gap(:), load
    logical, intent(out) :: contact(:)
    integer, intent(inout) :: products
    real(dp), dimension(size(gap)) :: part, slope, direction, change, reduced_gap
    real(dp) :: unit, previous, squares, step, curvature, lowest, total, noise
    logical :: before(size(gap)), restarted
    integer :: iteration, quiet_for, changes, n

    n = size(gap)
    lowest = minval(gap)
    unit = max(maxval(gap) - lowest, load*maxval(abs(alpha(1:n, 1) - alpha(1, 1))))
    if (.not. unit > 0.0_dp) unit = 1.0_dp
    reduced_gap = (gap - lowest)/unit
    part = 1.0_dp/real(n, dp)
    contact = .true.
    direction = 0.0_dp
    previous = 1.0_dp
    restarted = .true.
    quiet_for = 0
    do iteration = 1, MOST_ITERATIONS
      call multiply(alpha, part, load/unit, slope)
      slope = slope + reduced_gap
      noise = ROUNDING*maxval(abs(slope))
      slope = slope - mean_of(slope, contact)
      if (maxval(abs(slope), mask=contact) <= noise) exit
      squares = sum(slope**2, mask=contact)
      if (.not. squares > 0.0_dp) exit
      if (restarted) direction = 0.0_dp
      direction = merge(slope + (squares/previous)*direction, 0.0_dp, contact)
      previous = squares
      call multiply(alpha, direction, load/unit, change)
      products = products + 2
      change = change - mean_of(change, contact)
      curvature = sum(change*direction, mask=contact)
      if (.not. curvature > 0.0_dp) exit
      step = sum(slope*direction, mask=contact)/curvature
      before = contact
      part = max(part - step*direction, 0.0_dp)
      restarted = any(part <= 0.0_dp .and. slope < 0.0_dp)
      where (part <= 0.0_dp .and. slope < 0.0_dp) part = -step*slope
      total = sum(part)
      ! Nothing is left of the forces after a step along rounding.
      if (.not. total > 0.0_dp) exit
      part = part/total
      contact = part > 0.0_dp
      changes = count(contact .neqv. before)
      quiet_for = merge(quiet_for + 1, 0, &
                        changes*SETTLED < count(contact) .and. changes*FEW_OPEN <= count(.not. contact))
      if (quiet_for >= QUIET) exit
    end do
  end subroutine guess_contact_set

  subroutine multiply(alpha, part, factor, length)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: part(:), factor
    real(dp), intent(out) :: length(:)
    integer :: n

    n = size(part)
    call dgemv('N', n, n, factor, alpha, size(alpha, 1), part, 1, 0.0_dp, length, 1)
  end subroutine multiply

  pure function mean_of(values, mask) result(mean)
    real(dp), intent(in) :: values(:)
    logical, intent(in) :: mask(:)
    real(dp) :: mean

    mean = sum(values, mask=mask)/real(max(count(mask), 1), dp)
  end function mean_of

end module fuge_initial_set
