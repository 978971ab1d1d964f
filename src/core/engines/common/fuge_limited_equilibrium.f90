!> Whether contact forces within limits can carry the resultant.
!>
!> Looks for f with R^T f = w and least <= f <= most by least squares with bounds (P. B. Stark, R. L. Parker,
!> Computational Statistics 10, 1995), one point at a time from an even share on, which leaves few points to it. Where
!> there is no such f, the remainder of w proves it: it is a motion along
!> which all forces, each at the limit that does most work, do less work than the resultant.
module fuge_limited_equilibrium
  use fuge_equilibrium, only: is_in_equilibrium, is_negligible
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgelsy
  use fuge_load_sharing, only: share_load
  implicit none
  private

  public :: find_limited_equilibrium

  !> A point whose work is below this fraction of the largest possible one does not carry more of the remainder.
  real(dp), parameter :: NEGLIGIBLE = 1.0e-11_dp
  !> Rows of the modes that agree to this fraction count as one.
  real(dp), parameter :: DEPENDENT = 1.0e-13_dp
  !> A resultant beyond the limits by this many units in its last place is carried by all of them.
  real(dp), parameter :: ROUNDINGS = 64.0_dp

  !> What forces can still gain is less than this fraction of what the resultant does: at the least remainder it is
  !> nothing, for a resultant that can just be carried all.
  real(dp), parameter :: PROOF = 0.5_dp
  !> Steps by points that do next to no work, after which equilibrium is left undecided.
  integer, parameter :: MOST_UNPROVEN = 50

contains

  !> Forces within their limits in equilibrium with the resultant.
  !>
  !> `modes` (n, m) with columns of about the same size, `resultant` (m) with its rounding `noise` (m); `least` <= 0 and
  !> `most` >= 0 (n), huge without a limit. Out: `force` (n); `remainder` (m), zero if there are such forces, otherwise
  !> the motion that proves there are none.
  subroutine find_limited_equilibrium(modes, resultant, least, most, noise, force, remainder)
    real(dp), intent(in) :: modes(:, :), resultant(:), least(:), most(:), noise(:)
    real(dp), intent(out) :: force(:), remainder(:)
    real(dp) :: terms(size(resultant))
    logical :: basic(size(force))
    logical :: undecided
    integer :: iteration, j, newest, unproven

    force = 0.0_dp
    remainder = resultant
    if (size(resultant) == 1) then
      call share_evenly(modes(:, 1), resultant(1), least, most, force)
    else if (size(resultant) > 1) then
      call share_load(modes, resultant, least, most, force)
    end if
    basic = .false.
    unproven = 0
    do iteration = 1, 20*(size(resultant) + 1) + 4*size(force)
      remainder = resultant - [(dot_product(force, modes(:, j)), j=1, size(resultant))]
      if (is_in_equilibrium(modes, resultant, noise, force, remainder)) exit
      terms = [(sum(abs(force*modes(:, j))), j=1, size(terms))]
      ! The load may be the sum of all limits but for the rounding of such a sum.
      if (size(terms) == 1 .and. iteration == 1) then
        if (abs(remainder(1)) <= real(size(force), dp)*epsilon(noise(1))*terms(1)) exit
      end if
      newest = point_with_most_work(modes, remainder, ROUNDINGS*(noise + epsilon(noise)*terms), force, least, most, &
                                    basic)
      if (newest == 0) then
        undecided = .not. proves_no_equilibrium(modes, remainder, force, least, most)
        if (undecided) unproven = unproven + 1
        if (unproven > MOST_UNPROVEN) exit
        ! Many points that do little work each can carry what is left.
        if (undecided) newest = point_with_most_work(modes, remainder, 0.0_dp*terms, force, least, most, basic)
      end if
      if (newest == 0) then
        if (is_negligible(remainder, resultant, terms)) exit
        return
      end if
      basic(newest) = .true.
      call solve_least_squares(modes, remainder, least, most, force, basic)
    end do
    ! Equilibrium holds, or is not decided; the certificate of the solve then decides.
    remainder = 0.0_dp
  end subroutine find_limited_equilibrium

  !> Forces of one mode: at a point without a limit if there is one, else all at the same fraction of their limits, at
  !> most the whole.
  pure subroutine share_evenly(mode, resultant, least, most, force)
    real(dp), intent(in) :: mode(:), resultant, least(:), most(:)
    real(dp), intent(inout) :: force(:)
    real(dp) :: bound(size(force)), total
    integer :: k

    if (.not. abs(resultant) > 0.0_dp) return
    bound = merge(most, least, mode*sign(1.0_dp, resultant) > 0.0_dp)
    k = maxloc(abs(mode), dim=1, mask=abs(bound) >= huge(total))
    if (k > 0) then
      if (abs(mode(k)) > 0.0_dp) then
        force(k) = resultant/mode(k)
        return
      end if
      where (abs(bound) >= huge(total)) bound = 0.0_dp
    end if
    total = abs(sum(mode*bound))
    if (.not. total > 0.0_dp) return
    force = min(abs(resultant)/total, 1.0_dp)*bound
  end subroutine share_evenly

  !> The point, not `basic`, whose force can change so as to do most work along the remainder; 0 if none does more than
  !> its rounding, `rest` (m).
  pure function point_with_most_work(modes, remainder, rest, force, least, most, basic) result(point)
    real(dp), intent(in) :: modes(:, :), remainder(:), rest(:), force(:), least(:), most(:)
    logical, intent(in) :: basic(:)
    integer :: point
    real(dp) :: largest, work
    integer :: k

    point = 0
    largest = 0.0_dp
    do k = 1, size(force)
      if (basic(k)) cycle
      work = dot_product(modes(k, :), remainder)
      if (abs(work) <= max(NEGLIGIBLE*maxval(abs(remainder)), maxval(rest))*sum(abs(modes(k, :)))) cycle
      if (abs(work) <= largest) cycle
      if (work > 0.0_dp .and. .not. force(k) < most(k)) cycle
      if (work < 0.0_dp .and. .not. force(k) > least(k)) cycle
      largest = abs(work)
      point = k
    end do
  end function point_with_most_work

  !> Do forces, each at the limit that does most work along the remainder, do clearly less than the resultant? Points
  !> without a limit do none then, but for rounding.
  pure function proves_no_equilibrium(modes, remainder, force, least, most) result(proves)
    real(dp), intent(in) :: modes(:, :), remainder(:), force(:), least(:), most(:)
    logical :: proves
    real(dp) :: gain, work
    integer :: k

    gain = 0.0_dp
    do k = 1, size(force)
      work = dot_product(modes(k, :), remainder)
      if (work > 0.0_dp .and. most(k) < huge(work)) gain = gain + work*(most(k) - force(k))
      if (work < 0.0_dp .and. least(k) > -huge(work)) gain = gain + work*(least(k) - force(k))
    end do
    proves = gain < PROOF*sum(remainder**2)
  end function proves_no_equilibrium

  !> Change the forces of the basic points so that the remainder becomes least; those that meet a limit stay there and
  !> are basic no more, the first one first.
  subroutine solve_least_squares(modes, remainder, least, most, force, basic)
    real(dp), intent(in) :: modes(:, :), least(:), most(:)
    real(dp), intent(inout) :: remainder(:), force(:)
    logical, intent(inout) :: basic(:)
    real(dp), allocatable :: change(:)
    integer, allocatable :: points(:)
    real(dp) :: fraction, step_length
    integer :: blocking, k

    do while (any(basic))
      points = pack([(k, k=1, size(force))], basic)
      allocate (change(size(points)))
      call find_least_change(modes(points, :), remainder, change)
      step_length = 1.0_dp
      blocking = 0
      do k = 1, size(points)
        fraction = room(force(points(k)), change(k), least(points(k)), most(points(k)))
        if (fraction >= step_length) cycle
        step_length = fraction
        blocking = k
      end do
      force(points) = force(points) + step_length*change
      remainder = remainder - step_length*matmul(change, modes(points, :))
      if (blocking == 0) return
      ! One point leaves in each pass, so the loop ends.
      associate (point => points(blocking))
        force(point) = merge(most(point), least(point), change(blocking) > 0.0_dp)
        basic(point) = .false.
      end associate
      deallocate (change)
    end do
  end subroutine solve_least_squares

  !> The fraction of a `change` that a force has room for.
  elemental function room(force, change, least, most) result(fraction)
    real(dp), intent(in) :: force, change, least, most
    real(dp) :: fraction

    fraction = 1.0_dp
    if (change > 0.0_dp .and. most < huge(most)) then
      if (force + change > most) fraction = max(most - force, 0.0_dp)/change
    else if (change < 0.0_dp .and. least > -huge(least)) then
      if (force + change < least) fraction = max(force - least, 0.0_dp)/(-change)
    end if
  end function room

  !> The least change of forces, with the `rows` (p, m) of the modes, that comes nearest to the remainder.
  subroutine find_least_change(rows, remainder, change)
    real(dp), intent(in) :: rows(:, :), remainder(:)
    real(dp), intent(out) :: change(:)
    real(dp) :: matrix(size(rows, 2), size(rows, 1)), right(max(size(rows, 1), size(rows, 2)))
    real(dp) :: work(64*(size(rows, 1) + size(rows, 2)) + 64)
    integer :: order(size(rows, 1)), info, m, p, rank

    p = size(rows, 1)
    m = size(rows, 2)
    matrix = transpose(rows)
    right = 0.0_dp
    right(:m) = remainder
    order = 0
    call dgelsy(m, p, 1, matrix, m, right, size(right), order, DEPENDENT, rank, work, size(work), info)
    change = right(:p)
  end subroutine find_least_change

end module fuge_limited_equilibrium
