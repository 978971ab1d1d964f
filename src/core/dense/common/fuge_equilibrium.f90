!> Whether contact forces can carry the resultant at all.
!>
!> Looks for f with R^T f = w and f >= 0 at one-sided points, that is, for w in the cone of the rows of R, by
!> non-negative least squares (C. L. Lawson, R. J. Hanson, Solving Least Squares Problems, 1974, chapter 23), at no more
!> points than there are modes. Where there is no such f, the remainder of w proves it (Farkas' lemma): it is a motion
!> along which no point closes, while the resultant does work.
module fuge_equilibrium
  use fuge_blocking_step, only: find_blocking
  use fuge_contact_states, only: FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, FUGE_OPEN
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgelsy
  implicit none
  private

  public :: find_equilibrium, find_newest, is_in_equilibrium, is_negligible, is_rounding, proves_no_equilibrium

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
  !> Points whose rows of the modes agree to this fraction count as one.
  real(dp), parameter :: DEPENDENT = 1.0e-13_dp
  !> Points whose work is computed together, so that no array of all points is needed.
  integer, parameter :: BLOCK_SIZE = 512

  !> The points that carry the resultant, in their order: some for each mode.
  type :: active_points
    integer, allocatable :: point(:), state(:)
    real(dp), allocatable :: force(:)
  contains
    procedure :: insert
    procedure :: drop_open
  end type active_points

contains

  !> Forces in equilibrium with the resultant, at few points.
  !>
  !> `modes` (n, m) with columns of about the same size, `resultant` (m), `pushes` (n) marks points whose force may be
  !> positive, `pulls` (n) negative. Out: `force` (n); `remainder` (m), zero if there are such forces, otherwise the
  !> motion that proves there are none. `rounding` (m) of the resultant, by default that of the largest.
  subroutine find_equilibrium(modes, resultant, pushes, pulls, force, remainder, rounding)
    real(dp), intent(in) :: modes(:, :), resultant(:)
    logical, intent(in) :: pushes(:), pulls(:)
    real(dp), intent(out) :: force(:), remainder(:)
    real(dp), intent(in), optional :: rounding(:)
    real(dp), dimension(size(resultant)) :: noise, rest, terms
    real(dp) :: work
    type(active_points) :: active
    integer :: iteration, j, newest

    noise = epsilon(noise)*maxval(abs(resultant))
    if (present(rounding)) noise = rounding
    force = 0.0_dp
    allocate (active%point(0), active%state(0), active%force(0))
    remainder = resultant
    do iteration = 1, 20*(size(modes, 2) + 1) + size(force)
      if (is_in_equilibrium(modes, resultant, noise, force, remainder)) exit
      ! The remainder is a difference, and so are these works.
      terms = [(sum(abs(force*modes(:, j))), j=1, size(terms))]
      rest = noise + epsilon(noise)*terms
      call find_newest(modes, remainder, rest, pushes, pulls, active%point, newest, work)
      if (newest == 0) then
        if (is_negligible(remainder, resultant, terms)) exit
        if (proves_no_equilibrium(modes, rest, pushes, pulls, remainder)) return
        exit
      end if
      call active%insert(newest, merge(FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, work > 0.0_dp))
      call solve_least_squares(modes(active%point, :), resultant, active)
      force(active%point) = active%force
      call active%drop_open()
      remainder = resultant - [(dot_product(force, modes(:, j)), j=1, size(resultant))]
    end do
    ! Equilibrium holds, or is not decided; the certificate of the solve then decides.
    remainder = 0.0_dp
  end subroutine find_equilibrium

  !> Point number `newest` becomes active, with the state `state` and without a force.
  pure subroutine insert(self, newest, state)
    class(active_points), intent(inout) :: self
    integer, intent(in) :: newest, state
    integer :: before

    before = count(self%point < newest)
    self%point = [self%point(:before), newest, self%point(before + 1:)]
    self%state = [self%state(:before), state, self%state(before + 1:)]
    self%force = [self%force(:before), 0.0_dp, self%force(before + 1:)]
  end subroutine insert

  !> Points whose state is open are not active any more.
  pure subroutine drop_open(self)
    class(active_points), intent(inout) :: self

    self%point = pack(self%point, self%state /= FUGE_OPEN)
    self%force = pack(self%force, self%state /= FUGE_OPEN)
    self%state = pack(self%state, self%state /= FUGE_OPEN)
  end subroutine drop_open

  !> The point that closes most along the remainder, `newest`, of those that are not `taken`, and its `work` with the
  !> sign that its force has; 0 if none closes. In blocks, so that no array of all points is needed.
  pure subroutine find_newest(modes, remainder, rest, pushes, pulls, taken, newest, work)
    real(dp), intent(in) :: modes(:, :), remainder(:), rest(:)
    logical, intent(in) :: pushes(:), pulls(:)
    integer, intent(in) :: taken(:)
    integer, intent(out) :: newest
    real(dp), intent(out) :: work
    real(dp) :: works(BLOCK_SIZE)
    integer :: before, k, points

    newest = 0
    work = 0.0_dp
    do before = 0, size(modes, 1) - 1, BLOCK_SIZE
      points = min(BLOCK_SIZE, size(modes, 1) - before)
      associate (a => before + 1, b => before + points)
        works(:points) = closing_work(modes(a:b, :), remainder, rest, pushes(a:b), pulls(a:b))
      end associate
      do k = 1, size(taken)
        if (taken(k) > before .and. taken(k) <= before + points) works(taken(k) - before) = 0.0_dp
      end do
      k = maxloc(abs(works(:points)), dim=1)
      if (.not. abs(works(k)) > abs(work)) cycle
      newest = before + k
      work = works(k)
    end do
  end subroutine find_newest

  !> How much each point closes along the motion that is the remainder of the resultants, (n), where its force may have
  !> that sign; 0 where that is rounding. `rest` (m) is the rounding of the remainder.
  pure function closing_work(modes, remainder, rest, pushes, pulls) result(work)
    real(dp), intent(in) :: modes(:, :), remainder(:), rest(:)
    logical, intent(in) :: pushes(:), pulls(:)
    real(dp) :: work(size(modes, 1))
    real(dp) :: least

    work = matmul(modes, remainder)
    least = rounding_share(NEGLIGIBLE, rest, remainder)
    where (abs(work) <= least*sum(abs(modes), dim=2)) work = 0.0_dp
    where (.not. pulls) work = max(work, 0.0_dp)
    where (.not. pushes) work = min(work, 0.0_dp)
  end function closing_work

  !> Work along the `motion` (m) below this multiple of the sizes in a row of the modes is rounding: of the motion by
  !> `noise` (m), or this `fraction` of the largest possible work.
  pure function rounding_share(fraction, noise, motion) result(share)
    real(dp), intent(in) :: fraction, noise(:), motion(:)
    real(dp) :: share
    real(dp) :: largest

    largest = maxval(abs(motion))
    share = max(fraction*largest, min(ROUNDINGS*maxval(noise), CLEAR*largest))
  end function rounding_share

  !> Is the remainder of each resultant no more than rounding of it and of its terms?
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

  !> Does no point close along the motion, which is the remainder of the resultants, while these do work?
  pure function proves_no_equilibrium(modes, noise, pushes, pulls, motion) result(proves)
    real(dp), intent(in) :: modes(:, :), noise(:), motion(:)
    logical, intent(in) :: pushes(:), pulls(:)
    logical :: proves
    real(dp) :: closing, smallest
    integer :: k

    ! The motion is a difference of resultants and carries their rounding.
    smallest = rounding_share(PROOF, noise, motion)
    ! The resultants do the work |motion|**2, of which a sum of terms as large as these would leave rounding.
    proves = any(abs(motion) > ROUNDINGS*noise)
    do k = 1, size(modes, 1)
      closing = dot_product(modes(k, :), motion)
      if (abs(closing) <= smallest*sum(abs(modes(k, :)))) cycle
      if (pushes(k) .and. closing > 0.0_dp) proves = .false.
      if (pulls(k) .and. closing < 0.0_dp) proves = .false.
    end do
  end function proves_no_equilibrium

  !> Inner loop of Lawson and Hanson: least-squares forces at the active points, whose rows of the modes are `rows`
  !> (:, m), of which those whose force would change its sign become open, the first blocking one first.
  subroutine solve_least_squares(rows, resultant, active)
    real(dp), intent(in) :: rows(:, :), resultant(:)
    type(active_points), intent(inout) :: active
    real(dp) :: target(size(active%force)), step_length
    integer :: blocking

    do
      call solve_on_active(rows, resultant, active%state, target)
      call find_blocking(active%force, target, active%state /= FUGE_OPEN .and. target*active%state <= 0.0_dp, &
                         step_length, blocking)
      if (blocking == 0) exit
      active%force = active%force + step_length*(target - active%force)
      ! One point is dropped in each pass, so the loop ends.
      active%state(blocking) = FUGE_OPEN
      active%force(blocking) = 0.0_dp
    end do
    active%force = target
  end subroutine solve_least_squares

  !> Least-squares forces at the active points, refined once.
  subroutine solve_on_active(rows, resultant, state, force)
    real(dp), intent(in) :: rows(:, :), resultant(:)
    integer, intent(in) :: state(:)
    real(dp), intent(out) :: force(:)
    real(dp) :: correction(size(force))

    call find_least_squares(rows, resultant, state, force)
    call find_least_squares(rows, resultant - matmul(force, rows), state, correction)
    force = force + correction
  end subroutine solve_on_active

  !> The forces at the active points that come nearest to a resultant, those of least squares.
  subroutine find_least_squares(rows, resultant, state, force)
    real(dp), intent(in) :: rows(:, :), resultant(:)
    integer, intent(in) :: state(:)
    real(dp), intent(out) :: force(:)
    real(dp) :: matrix(size(rows, 2), count(state /= FUGE_OPEN))
    real(dp) :: right(max(size(rows, 2), count(state /= FUGE_OPEN)))
    real(dp) :: work(64*(size(rows, 2) + count(state /= FUGE_OPEN)) + 64)
    integer :: points(count(state /= FUGE_OPEN)), order(count(state /= FUGE_OPEN)), k, p, m, rank, info

    m = size(rows, 2)
    points = pack([(k, k=1, size(state))], state /= FUGE_OPEN)
    p = size(points)
    matrix = transpose(rows(points, :))
    right = 0.0_dp
    right(:m) = resultant
    order = 0
    call dgelsy(m, p, 1, matrix, m, right, size(right), order, DEPENDENT, rank, work, size(work), info)
    force = 0.0_dp
    force(points) = right(:p)
  end subroutine find_least_squares

end module fuge_equilibrium
