!> Whether contact forces within limits can carry the resultant.
!>
!> Looks for f with R^T f = w and least <= f <= most by least squares with bounds (P. B. Stark, R. L. Parker,
!> Computational Statistics 10, 1995), one point at a time from an even share on, which leaves few points to it. Where
!> there is no such f, the remainder of w proves it: it is a motion along
!> which all forces, each at the limit that does most work, do less work than the resultant.
module fuge_limited_equilibrium
  use fuge_equilibrium, only: is_negligible, is_rounding
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgelsy
  use fuge_load_sharing, only: share_load
  use fuge_point_space, only: point_space
  implicit none
  private

  public :: find_limited_equilibrium

  !> A point whose work is below this fraction of the largest possible one does not carry more of the remainder.
  real(dp), parameter :: NEGLIGIBLE = 1.0e-11_dp
  !> Rows of the modes that agree to this fraction count as one.
  real(dp), parameter :: DEPENDENT = 1.0e-13_dp
  !> A resultant beyond the limits by this many units in its last place is carried by all of them.
  real(dp), parameter :: ROUNDINGS = 64.0_dp

  !> The resultant cannot be carried if the work that forces within limits can still do is below this fraction of the
  !> remainder's: at the least remainder they can do none, for a resultant that can just be carried all of it.
  real(dp), parameter :: PROOF = 0.5_dp
  !> Steps by points that do next to no work, after which equilibrium is left undecided.
  integer, parameter :: MOST_UNPROVEN = 50

  !> The points that least squares are left to, of all ranks: rows of the modes (m, :), forces and their limits, and the
  !> number of the point where it is this rank's, else 0.
  type :: basic_points
    real(dp), allocatable :: rows(:, :), force(:), least(:), most(:)
    integer, allocatable :: own(:)
  contains
    procedure :: drop
    procedure :: write_forces
  end type basic_points

contains

  !> Forces within their limits in equilibrium with the resultant.
  !>
  !> `modes` (n, m) with columns of about the same size, `resultant` (m) with its rounding `noise` (m); `least` <= 0 and
  !> `most` >= 0 (n), huge without a limit. Out: `force` (n); `remainder` (m), zero if there are such forces, otherwise
  !> the motion that proves there are none. Where ranks, `sharing`, share the points, the arguments are those of this
  !> rank, and all ranks call it.
  subroutine find_limited_equilibrium(modes, resultant, least, most, noise, force, remainder, sharing)
    real(dp), intent(in) :: modes(:, :), resultant(:), least(:), most(:), noise(:)
    real(dp), intent(out) :: force(:), remainder(:)
    type(point_space), intent(in), optional :: sharing
    type(point_space) :: space
    type(basic_points) :: basic
    real(dp) :: terms(size(resultant))
    logical :: found, undecided
    integer :: iteration, points, unproven

    if (present(sharing)) space = sharing
    points = space%total_count(size(force))
    force = 0.0_dp
    remainder = resultant
    if (size(resultant) == 1) then
      call share_evenly(modes(:, 1), resultant(1), least, most, space, force)
    else if (size(resultant) > 1) then
      call share_load(modes, resultant, least, most, space, force)
    end if
    allocate (basic%rows(size(resultant), 0), basic%force(0), basic%least(0), basic%most(0), basic%own(0))
    unproven = 0
    do iteration = 1, 20*(size(resultant) + 1) + 4*points
      call find_remainder(modes, resultant, force, space, remainder, terms)
      if (is_rounding(remainder, resultant, noise, terms)) exit
      ! The load may be the sum of all limits but for the rounding of such a sum.
      if (size(terms) == 1 .and. iteration == 1) then
        if (abs(remainder(1)) <= real(points, dp)*epsilon(noise(1))*terms(1)) exit
      end if
      call add_point(modes, remainder, ROUNDINGS*(noise + epsilon(noise)*terms), force, least, most, space, basic, &
                     found)
      if (.not. found) then
        undecided = .not. proves_no_equilibrium(modes, remainder, force, least, most, space)
        if (undecided) unproven = unproven + 1
        if (unproven > MOST_UNPROVEN) exit
        ! Many points that do little work each can carry what is left.
        if (undecided) call add_point(modes, remainder, 0.0_dp*terms, force, least, most, space, basic, found)
      end if
      if (.not. found) then
        if (is_negligible(remainder, resultant, terms)) exit
        return
      end if
      call solve_least_squares(remainder, basic, force)
    end do
    ! Equilibrium holds, or is not decided; the certificate of the solve then decides.
    remainder = 0.0_dp
  end subroutine find_limited_equilibrium

  !> The `remainder` of the resultant (m), and the `terms` (m) that it is a difference of.
  subroutine find_remainder(modes, resultant, force, space, remainder, terms)
    real(dp), intent(in) :: modes(:, :), resultant(:), force(:)
    type(point_space), intent(in) :: space
    real(dp), intent(out) :: remainder(:), terms(:)
    real(dp) :: sums(2*size(resultant))
    integer :: j

    associate (m => size(resultant))
      sums = [(dot_product(force, modes(:, j)), j=1, m), (sum(abs(force*modes(:, j))), j=1, m)]
      call space%add(sums)
      remainder = resultant - sums(:m)
      terms = sums(m + 1:)
    end associate
  end subroutine find_remainder

  !> Forces of one mode: at a point without a limit if there is one, else all at the same fraction of their limits, at
  !> most the whole.
  subroutine share_evenly(mode, resultant, least, most, space, force)
    real(dp), intent(in) :: mode(:), resultant, least(:), most(:)
    type(point_space), intent(in) :: space
    real(dp), intent(inout) :: force(:)
    real(dp) :: bound(size(force)), owner(1), strongest, total, unit
    integer :: k

    if (.not. abs(resultant) > 0.0_dp) return
    bound = merge(most, least, mode*sign(1.0_dp, resultant) > 0.0_dp)
    k = maxloc(abs(mode), dim=1, mask=abs(bound) >= huge(total))
    strongest = 0.0_dp
    if (k > 0) strongest = abs(mode(k))
    if (space%anywhere(strongest > 0.0_dp)) then
      owner = real(space%number(), dp)
      call space%take_from_least(-strongest, owner)
      if (abs(owner(1) - real(space%number(), dp)) <= 0.0_dp) force(k) = resultant/mode(k)
      return
    end if
    where (abs(bound) >= huge(total)) bound = 0.0_dp
    ! The sum of limits that are meant as none could overflow.
    unit = scale(1.0_dp, exponent(max(space%largest(maxval(abs(bound))), tiny(unit))) - 1)
    total = abs(space%total(sum(mode*(bound/unit))))
    if (.not. total > 0.0_dp) return
    if (abs(resultant)/unit < total) then
      force = abs(resultant)/unit/total*bound
    else
      force = bound
    end if
  end subroutine share_evenly

  !> Add the point, not yet basic, whose force can change so as to do most work along the remainder; not `found` if none
  !> does more than its rounding, `rest` (m). The arguments are nine: the problem, the forces so far and the answer.
  subroutine add_point(modes, remainder, rest, force, least, most, space, basic, found)
    real(dp), intent(in) :: modes(:, :), remainder(:), rest(:), force(:), least(:), most(:)
    type(point_space), intent(in) :: space
    type(basic_points), intent(inout) :: basic
    logical, intent(out) :: found
    real(dp) :: chosen(size(remainder) + 4), work
    integer :: k

    call find_most_work(modes, remainder, rest, force, least, most, basic%own, k, work)
    chosen = 0.0_dp
    if (k > 0) chosen = [modes(k, :), force(k), least(k), most(k), real(space%number(), dp)]
    found = space%anywhere(k > 0)
    if (.not. found) return
    call space%take_from_least(-work, chosen)
    if (abs(chosen(size(chosen)) - real(space%number(), dp)) > 0.0_dp) k = 0
    associate (m => size(remainder))
      basic%rows = reshape([basic%rows, chosen(:m)], [m, size(basic%own) + 1])
      basic%force = [basic%force, chosen(m + 1)]
      basic%least = [basic%least, chosen(m + 2)]
      basic%most = [basic%most, chosen(m + 3)]
      basic%own = [basic%own, k]
    end associate
  end subroutine add_point

  !> The `point` of this rank, not among those `taken`, whose force can change so as to do most `work` along the
  !> remainder; 0 if none does more than its rounding, `rest` (m). The arguments are nine, as of `add_point`.
  pure subroutine find_most_work(modes, remainder, rest, force, least, most, taken, point, work)
    real(dp), intent(in) :: modes(:, :), remainder(:), rest(:), force(:), least(:), most(:)
    integer, intent(in) :: taken(:)
    integer, intent(out) :: point
    real(dp), intent(out) :: work
    real(dp) :: signed_work
    integer :: k

    point = 0
    work = 0.0_dp
    do k = 1, size(force)
      signed_work = dot_product(modes(k, :), remainder)
      if (abs(signed_work) <= max(NEGLIGIBLE*maxval(abs(remainder)), maxval(rest))*sum(abs(modes(k, :)))) cycle
      if (abs(signed_work) <= work) cycle
      if (signed_work > 0.0_dp .and. .not. force(k) < most(k)) cycle
      if (signed_work < 0.0_dp .and. .not. force(k) > least(k)) cycle
      if (any(taken == k)) cycle
      work = abs(signed_work)
      point = k
    end do
  end subroutine find_most_work

  !> Do forces, each at the limit that does most work along the remainder, do clearly less than the resultant? Points
  !> without a limit do none then, but for rounding.
  function proves_no_equilibrium(modes, remainder, force, least, most, space) result(proves)
    real(dp), intent(in) :: modes(:, :), remainder(:), force(:), least(:), most(:)
    type(point_space), intent(in) :: space
    logical :: proves
    real(dp) :: gain, work
    integer :: k

    gain = 0.0_dp
    do k = 1, size(force)
      work = dot_product(modes(k, :), remainder)
      if (work > 0.0_dp .and. most(k) < huge(work)) gain = gain + work*(most(k) - force(k))
      if (work < 0.0_dp .and. least(k) > -huge(work)) gain = gain + work*(least(k) - force(k))
    end do
    proves = space%total(gain) < PROOF*sum(remainder**2)
  end function proves_no_equilibrium

  !> Change the forces of the basic points so that the remainder becomes least; those that meet a limit stay there and
  !> are basic no more, the first one first. `force` (n) gets those of this rank.
  subroutine solve_least_squares(remainder, basic, force)
    real(dp), intent(inout) :: remainder(:), force(:)
    type(basic_points), intent(inout) :: basic
    real(dp), allocatable :: change(:)
    real(dp) :: fraction, step_length
    integer :: blocking, k

    do while (size(basic%own) > 0)
      allocate (change(size(basic%own)))
      call find_least_change(basic%rows, remainder, change)
      step_length = 1.0_dp
      blocking = 0
      do k = 1, size(change)
        fraction = room(basic%force(k), change(k), basic%least(k), basic%most(k))
        if (fraction >= step_length) cycle
        step_length = fraction
        blocking = k
      end do
      basic%force = basic%force + step_length*change
      remainder = remainder - step_length*matmul(basic%rows, change)
      if (blocking > 0) basic%force(blocking) = merge(basic%most(blocking), basic%least(blocking), &
                                                      change(blocking) > 0.0_dp)
      call basic%write_forces(force)
      if (blocking == 0) return
      ! One point leaves in each pass, so the loop ends.
      call basic%drop(blocking)
      deallocate (change)
    end do
  end subroutine solve_least_squares

  !> The forces of this rank's basic points, to `force` (n).
  pure subroutine write_forces(self, force)
    class(basic_points), intent(in) :: self
    real(dp), intent(inout) :: force(:)
    integer :: k

    do k = 1, size(self%own)
      if (self%own(k) > 0) force(self%own(k)) = self%force(k)
    end do
  end subroutine write_forces

  !> Drop the point in the place number `k`.
  pure subroutine drop(self, k)
    class(basic_points), intent(inout) :: self
    integer, intent(in) :: k
    integer :: stay(size(self%own) - 1), j

    stay = [(j, j=1, k - 1), (j, j=k + 1, size(self%own))]
    self%rows = self%rows(:, stay)
    self%force = self%force(stay)
    self%least = self%least(stay)
    self%most = self%most(stay)
    self%own = self%own(stay)
  end subroutine drop

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

  !> The least change of forces, with the `rows` (m, p) of the modes, that comes nearest to the remainder.
  subroutine find_least_change(rows, remainder, change)
    real(dp), intent(in) :: rows(:, :), remainder(:)
    real(dp), intent(out) :: change(:)
    real(dp) :: matrix(size(rows, 1), size(rows, 2)), right(max(size(rows, 1), size(rows, 2)))
    real(dp) :: work(64*(size(rows, 1) + size(rows, 2)) + 64)
    integer :: order(size(rows, 2)), info, m, p, rank

    m = size(rows, 1)
    p = size(rows, 2)
    matrix = rows
    right = 0.0_dp
    right(:m) = remainder
    order = 0
    call dgelsy(m, p, 1, matrix, m, right, size(right), order, DEPENDENT, rank, work, size(work), info)
    change = right(:p)
  end subroutine find_least_change

end module fuge_limited_equilibrium
