!> Whether contact forces within their limits can carry the resultant.
!>
!> Looks for f with R^T f = w and least <= f <= most by least squares with bounds (C. L. Lawson, R. J. Hanson, Solving
!> Least Squares Problems, 1974, chapter 23; P. B. Stark, R. L. Parker, Computational Statistics 10, 1995), one point at
!> a time, which leaves few points to it. Forces with limits start from an even share, those without any from zero: they
!> stay at no more points than there are modes. Where there is no such f, the remainder of w proves it (Farkas' lemma):
!> it is a motion along which no point without a limit closes, and along which all forces, each at the limit that does
!> most work, do less work than the resultant.
module fuge_equilibrium
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgelsy
  use fuge_load_sharing, only: share_load
  use fuge_point_space, only: point_space
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: find_equilibrium, is_in_equilibrium, move_to_edge

  !> A point whose work is below this fraction of the largest possible one does not close along the remainder. A
  !> remainder below this fraction of a resultant, or of its terms, may be the rounding of the data that the resultant
  !> was made of.
  real(dp), parameter :: NEGLIGIBLE = 1.0e-11_dp
  !> A remainder up to this many units in the last place of a resultant, or of its terms, is rounding.
  real(dp), parameter :: ROUNDINGS = 64.0_dp
  !> A closing displacement below this fraction of its terms counts as zero.
  real(dp), parameter :: PROOF = 1.0e-10_dp
  !> A closing displacement above this fraction of its terms does not count as rounding, since a remainder is well above
  !> its own.
  real(dp), parameter :: CLEAR = 0.1_dp
  !> The resultant cannot be carried if the work that forces within limits can still do is below this fraction of the
  !> remainder's.
  real(dp), parameter :: LEFT_TO_GAIN = 0.5_dp
  !> Rows of the modes that agree to this fraction count as one.
  real(dp), parameter :: DEPENDENT = 1.0e-13_dp
  !> Points whose work is computed together.
  integer, parameter :: BLOCK_SIZE = 512
  !> Steps by points that do next to no work, after which equilibrium is left undecided.
  integer, parameter :: MOST_UNPROVEN = 50
  !> A load may miss the edge of what the contact can carry by this many units in its last place.
  real(dp), parameter :: ROUNDINGS_AT_EDGE = 16.0_dp
  !> A force below this fraction of the largest may be due to such rounding.
  real(dp), parameter :: NO_FORCE = 1.0e-10_dp

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

  !> Forces within their limits in equilibrium with the resultant; at few points where they have no limits.
  !>
  !> `modes` (n, m) with columns of about the same size, `resultant` (m); `least` <= 0 and `most` >= 0 (n), huge without
  !> a limit. Out: `force` (n); `remainder` (m), zero if there are such forces, otherwise the motion that proves there
  !> are none. `rounding` (m) of the resultant, by default that of the largest. Where ranks, `sharing`, share the
  !> points, the arguments are those of this rank, and all ranks call it.
  subroutine find_equilibrium(modes, resultant, least, most, force, remainder, rounding, sharing)
    real(dp), intent(in) :: modes(:, :), resultant(:), least(:), most(:)
    real(dp), intent(out) :: force(:), remainder(:)
    real(dp), intent(in), optional :: rounding(:)
    type(point_space), intent(in), optional :: sharing
    type(point_space) :: space
    type(basic_points) :: basic
    real(dp), dimension(size(resultant)) :: noise, rest, terms
    logical :: found, has_limits
    integer :: iteration, points, unproven

    if (present(sharing)) space = sharing
    noise = epsilon(noise)*maxval(abs(resultant))
    if (present(rounding)) noise = rounding
    points = space%total_count(size(force))
    call start_forces(modes, resultant, least, most, space, force, has_limits)
    allocate (basic%rows(size(resultant), 0), basic%force(0), basic%least(0), basic%most(0), basic%own(0))
    unproven = 0
    do iteration = 1, 20*(size(resultant) + 1) + 4*points
      if (has_limits) then
        call find_remainder(modes, resultant, force, space, remainder, terms)
      else
        ! No other points have forces.
        remainder = resultant - matmul(basic%rows, basic%force)
        terms = matmul(abs(basic%rows), abs(basic%force))
      end if
      if (is_rounding(remainder, resultant, noise, terms)) exit
      ! The load may be the sum of all limits but for the rounding of such a sum.
      if (size(terms) == 1 .and. iteration == 1) then
        if (abs(remainder(1)) <= real(points, dp)*epsilon(noise)*terms(1)) exit
      end if
      ! The remainder is a difference, and so are the works along it.
      rest = noise + epsilon(noise)*terms
      call add_point(modes, remainder, rounding_share(NEGLIGIBLE, rest, remainder), force, least, most, space, basic, &
                     found)
      if (.not. found) then
        if (is_negligible(remainder, resultant, terms)) exit
        if (proves_no_equilibrium(modes, remainder, rest, force, least, most, basic%own, space)) return
        ! Many points that do little work each can carry what is left.
        unproven = unproven + 1
        if (unproven > MOST_UNPROVEN) exit
        call add_point(modes, remainder, NEGLIGIBLE*maxval(abs(remainder)), force, least, most, space, basic, found)
        if (.not. found) exit
      end if
      call solve_least_squares(remainder, basic, force)
    end do
    ! Equilibrium holds, or is not decided; the certificate of the solve then decides.
    remainder = 0.0_dp
  end subroutine find_equilibrium

  !> The forces to start from: zero without limits, else an even share of the resultant. `has_limits`: are there any?
  subroutine start_forces(modes, resultant, least, most, space, force, has_limits)
    real(dp), intent(in) :: modes(:, :), resultant(:), least(:), most(:)
    type(point_space), intent(in) :: space
    real(dp), intent(out) :: force(:)
    logical, intent(out) :: has_limits

    force = 0.0_dp
    has_limits = any((least < 0.0_dp .and. least > -huge(least)) .or. (most > 0.0_dp .and. most < huge(most)))
    has_limits = space%anywhere(has_limits)
    if (.not. has_limits) return
    if (size(resultant) == 1) then
      call share_evenly(modes(:, 1), resultant(1), least, most, space, force)
    else
      call share_load(modes, resultant, least, most, space, force)
    end if
  end subroutine start_forces

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
  !> does more than the `fraction` of its terms. The arguments are nine: the problem, the forces so far and
  !> the answer.
  subroutine add_point(modes, remainder, fraction, force, least, most, space, basic, found)
    real(dp), intent(in) :: modes(:, :), remainder(:), fraction, force(:), least(:), most(:)
    type(point_space), intent(in) :: space
    type(basic_points), intent(inout) :: basic
    logical, intent(out) :: found
    real(dp) :: chosen(size(remainder) + 4), work
    integer :: k

    call find_most_work(modes, remainder, fraction, force, least, most, basic%own, k, work)
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
  !> remainder; 0 if none does more than the `fraction` of its terms. In blocks, so that no array of all points is
  !> needed. The arguments are nine, as of `add_point`.
  pure subroutine find_most_work(modes, remainder, fraction, force, least, most, taken, point, work)
    real(dp), intent(in), contiguous :: modes(:, :)
    real(dp), intent(in) :: remainder(:), fraction, force(:), least(:), most(:)
    integer, intent(in) :: taken(:)
    integer, intent(out) :: point
    real(dp), intent(out) :: work
    real(dp) :: works(BLOCK_SIZE)
    integer :: before, k, points

    point = 0
    work = 0.0_dp
    do before = 0, size(force) - 1, BLOCK_SIZE
      points = min(BLOCK_SIZE, size(force) - before)
      associate (rows => modes(before + 1:before + points, :))
        works(:points) = matmul(rows, remainder)
        where (abs(works(:points)) <= fraction*sum(abs(rows), dim=2)) works(:points) = 0.0_dp
      end associate
      do k = before + 1, before + points
        if (abs(works(k - before)) <= work) cycle
        if (works(k - before) > 0.0_dp .and. .not. force(k) < most(k)) cycle
        if (works(k - before) < 0.0_dp .and. .not. force(k) > least(k)) cycle
        if (any(taken == k)) cycle
        work = abs(works(k - before))
        point = k
      end do
    end do
  end subroutine find_most_work

  !> Work along the `motion` (m) below this multiple of the sizes in a row of the modes is rounding: of the motion by
  !> `noise` (m), or this `fraction` of the largest possible work.
  pure function rounding_share(fraction, noise, motion) result(share)
    real(dp), intent(in) :: fraction, noise(:), motion(:)
    real(dp) :: share
    real(dp) :: largest

    largest = maxval(abs(motion))
    share = max(fraction*largest, min(ROUNDINGS*maxval(noise), CLEAR*largest))
  end function rounding_share

  !> Are these forces (n) in equilibrium, each `remainder` of a resultant no more than rounding of it and of its terms?
  pure function is_in_equilibrium(modes, resultant, noise, force, remainder) result(balanced)
    real(dp), intent(in) :: modes(:, :), resultant(:), noise(:), force(:), remainder(:)
    logical :: balanced
    integer :: j

    balanced = is_rounding(remainder, resultant, noise, [(sum(abs(modes(:, j)*force)), j=1, size(resultant))])
  end function is_in_equilibrium

  !> The same of `terms` (m), the sums of the sizes of what the forces contribute to each resultant.
  pure function is_rounding(remainder, resultant, noise, terms)
    real(dp), intent(in) :: remainder(:), resultant(:), noise(:), terms(:)
    logical :: is_rounding
    integer :: j

    is_rounding = .true.
    do j = 1, size(resultant)
      ! Where one resultant is rounded by more, least squares spread that over all.
      is_rounding = is_rounding .and. abs(remainder(j)) <= ROUNDINGS*max(maxval(noise), epsilon(noise) &
                                                                         *max(abs(resultant(j)), terms(j)))
    end do
  end function is_rounding

  !> Is what no point can carry of each resultant a fraction of it, or of its `terms` (m), that proves nothing?
  pure function is_negligible(remainder, resultant, terms) result(proves_nothing)
    real(dp), intent(in) :: remainder(:), resultant(:), terms(:)
    logical :: proves_nothing

    proves_nothing = all(abs(remainder) <= NEGLIGIBLE*max(abs(resultant), terms))
  end function is_negligible

  !> Does no point without a limit close along the motion, which is the remainder of the resultants, and do the others,
  !> each at the limit that does most work, do clearly less than it? The `noise` (m) is that of the motion; forces at
  !> the points that are `basic` do no work along it, but for rounding.
  function proves_no_equilibrium(modes, motion, noise, force, least, most, basic, space) result(proves)
    real(dp), intent(in) :: modes(:, :), motion(:), noise(:), force(:), least(:), most(:)
    integer, intent(in) :: basic(:)
    type(point_space), intent(in) :: space
    logical :: proves
    real(dp) :: closing, gain, smallest, unit
    integer :: k

    smallest = rounding_share(PROOF, noise, motion)
    ! Squares of the motion could underflow.
    unit = maxval(abs(motion))
    ! The resultants do the work |motion|**2, of which a sum of terms as large as these would leave rounding.
    proves = any(abs(motion) > ROUNDINGS*noise)
    gain = 0.0_dp
    do k = 1, size(force)
      closing = dot_product(modes(k, :), motion)
      associate (bound => merge(most(k), least(k), closing > 0.0_dp))
        if (abs(bound) >= huge(bound)) then
          proves = proves .and. abs(closing) <= smallest*sum(abs(modes(k, :)))
        else if (.not. any(basic == k)) then
          gain = gain + (closing/unit)*(bound - force(k))
        end if
      end associate
    end do
    gain = space%total(gain)
    proves = space%everywhere(proves .and. gain < LEFT_TO_GAIN*sum((motion/unit)*motion))
  end function proves_no_equilibrium

  !> Change the forces of the basic points so that the remainder becomes least, and refine them once; those that meet a
  !> limit stay there and are basic no more, the first one first. `force` (n) gets those of this rank.
  subroutine solve_least_squares(remainder, basic, force)
    real(dp), intent(inout) :: remainder(:), force(:)
    type(basic_points), intent(inout) :: basic
    real(dp), allocatable :: change(:)
    real(dp) :: fraction, step_length
    integer :: blocking, k, whole_steps

    whole_steps = 0
    do while (size(basic%own) > 0 .and. whole_steps < 2)
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
      ! One point leaves in each pass but for two, so the loop ends.
      if (blocking > 0) call basic%drop(blocking)
      if (blocking == 0) whole_steps = whole_steps + 1
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

  !> Fewer points than modes carry a load at the edge of what the contact can carry. Rounding may take it beyond the
  !> edge, where motions without resistance would grow: the load is then moved to the edge.
  !>
  !> `modes` (n, p) those in `columns` (p) with the `noise` (p) of their loads; `force` (n) carries them. Error:
  !> FUGE_ERR_MEMORY.
  subroutine move_to_edge(space, modes, noise, load, columns, force, info)
    type(point_space), intent(in) :: space
    real(dp), intent(in) :: modes(:, :), noise(:)
    integer, intent(in) :: columns(:)
    real(dp), intent(inout) :: load(:), force(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: nearest(:), weighted(:, :)
    real(dp), dimension(size(noise)) :: carried, weight, unused
    real(dp) :: least
    integer :: j, stat

    least = NO_FORCE*space%largest(maxval(abs(force)))
    if (space%total_count(count(abs(force) > least)) >= size(columns) .or. .not. all(noise > 0.0_dp)) return
    allocate (nearest(size(force)), weighted(size(force), size(noise)), stat=stat)
    call require_memory(stat, 'the load of', size(force), 'points', info)
    call space%agree(info)
    if (stat /= 0 .or. info%failed()) return
    ! Loads with little rounding are met best.
    weight = minval(noise)/noise
    do j = 1, size(noise)
      weighted(:, j) = modes(:, j)*weight(j)
    end do
    call find_equilibrium(weighted, load(columns)*weight, merge(-huge(least), 0.0_dp, force < -least), &
                          merge(huge(least), 0.0_dp, force > least), nearest, unused, noise*weight, space)
    carried = matmul(nearest, modes)
    call space%add(carried)
    if (.not. all(abs(load(columns) - carried) <= ROUNDINGS_AT_EDGE*noise)) return
    load(columns) = carried
    force = nearest
  end subroutine move_to_edge

end module fuge_equilibrium
