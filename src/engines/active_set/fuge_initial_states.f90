!> A first guess of the sides for general problems: the projected conjugate gradients of
!> fuge_initial_set, with any number of motions and two stops.
module fuge_initial_states
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgemv, dgesv
  use fuge_canonical_problem, only: canonical_problem
  implicit none
  private

  public :: guess_sides

  !> Most iterations, each two products with alpha.
  integer, parameter :: MOST_ITERATIONS = 12
  !> Good enough when fewer than one point in this many changes sides, this many times running.
  integer, parameter :: SETTLED = 64, QUIET = 2
  !> Times that forces are brought back into equilibrium after those that pull have gone.
  integer, parameter :: ROUNDS = 2
  !> Slopes below this part of the lengths that make them are rounding.
  real(dp), parameter :: ROUNDING = 1.0e-13_dp
  !> Motions that the contact holds by less than this part are left alone.
  real(dp), parameter :: HARDLY_HELD = 1.0e-12_dp
  !> Play beyond this many lengths of the scene is none.
  real(dp), parameter :: FAR = 1.0e8_dp

  !> Forces as parts of a force of the scene, lengths as parts of a length of it, so that
  !> units do not matter.
  type :: scaled_scene
    real(dp), allocatable :: gap(:), play(:), load(:)
    !> Length that a force of 1 makes per unit of alpha.
    real(dp) :: factor = 0.0_dp
    logical, allocatable :: tied(:)
  end type scaled_scene

contains

  !> Where the points probably are, `state` (n): 1 at the lower stop, -1 at the upper one, 0
  !> between. On entry a guess, which stays if there is no load to compare forces with.
  !>
  !> `alpha` (at least n rows, n columns); `products` is raised by the products with alpha.
  subroutine guess_sides(alpha, canonical, state, products)
    real(dp), intent(in), contiguous :: alpha(:, :)
    type(canonical_problem), intent(in) :: canonical
    integer, intent(inout) :: state(:), products
    type(scaled_scene) :: scaled
    real(dp), dimension(size(state)) :: force, opening, slope, direction, change
    real(dp) :: previous, squares, step, curvature, noise
    integer :: given(size(state)), before(size(state)), iteration, quiet_for
    logical :: restarted

    call make_scaled(alpha, canonical, scaled)
    if (.not. scaled%factor > 0.0_dp) return
    given = state
    state = merge(0, 1, canonical%excluded .or. (scaled%play < huge(1.0_dp) .and. .not. scaled%tied))
    force = 0.0_dp
    call balance(canonical%modes, scaled, state, force)
    direction = 0.0_dp
    previous = 1.0_dp
    restarted = .true.
    quiet_for = 0
    do iteration = 1, MOST_ITERATIONS
      call multiply(alpha, force, scaled%factor, opening)
      opening = opening + scaled%gap
      noise = ROUNDING*maxval(abs(opening))
      slope = opening
      where (state < 0) slope = opening - scaled%play
      call take_motions(canonical%modes, state /= 0, slope, opening)
      if (maxval(abs(slope), mask=state /= 0) <= noise) exit
      squares = sum(slope**2, mask=state /= 0)
      if (.not. squares > 0.0_dp) exit
      if (restarted) direction = 0.0_dp
      direction = merge(slope + (squares/previous)*direction, 0.0_dp, state /= 0)
      previous = squares
      call multiply(alpha, direction, scaled%factor, change)
      products = products + 2
      call take_motions(canonical%modes, state /= 0, change)
      curvature = sum(change*direction, mask=state /= 0)
      if (.not. curvature > 0.0_dp) exit
      step = sum(slope*direction, mask=state /= 0)/curvature
      before = state
      force = force - step*direction
      call join(scaled, canonical%excluded, opening, step, state, force, restarted)
      call balance(canonical%modes, scaled, state, force)
      quiet_for = merge(quiet_for + 1, 0, count(state /= before)*SETTLED < count(state /= 0))
      if (quiet_for >= QUIET) exit
    end do
    ! Nothing touches, or numbers overflowed.
    if (.not. (any(state /= 0) .and. all(abs(force) <= huge(force)))) state = given
  end subroutine guess_sides

  !> The scene without units; its factor is zero if there is nothing to guess from.
  pure subroutine make_scaled(alpha, canonical, scaled)
    real(dp), intent(in) :: alpha(:, :)
    type(canonical_problem), intent(in) :: canonical
    type(scaled_scene), intent(out) :: scaled
    real(dp) :: base, largest, length
    integer :: k

    scaled%load = canonical%load
    if (.not. any(abs(canonical%load) > 0.0_dp)) return
    largest = maxval(abs(canonical%load))
    base = 0.0_dp
    if (canonical%has_translation) base = minval(canonical%gap, mask=.not. canonical%excluded)
    scaled%gap = merge(0.0_dp, canonical%gap - base, canonical%excluded)
    length = max(maxval(abs(scaled%gap)), largest*maxval([(abs(alpha(k, k)), k=1, size(scaled%gap))]))
    if (.not. length > 0.0_dp) return
    scaled%gap = scaled%gap/length
    scaled%load = canonical%load/largest
    scaled%factor = largest/length
    allocate (scaled%play(size(scaled%gap)))
    scaled%play = huge(1.0_dp)
    where (canonical%upper/FAR < length) scaled%play = canonical%upper/length
    scaled%tied = canonical%upper <= 0.0_dp .and. .not. canonical%excluded
  end subroutine make_scaled

  subroutine multiply(alpha, force, factor, length)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: force(:), factor
    real(dp), intent(out) :: length(:)

    call dgemv('N', size(force), size(force), factor, alpha, size(alpha, 1), force, 1, 0.0_dp, length, 1)
  end subroutine multiply

  !> Points that move away from their stop are open; open ones beyond a stop come to it.
  pure subroutine join(scaled, excluded, opening, step, state, force, joined)
    type(scaled_scene), intent(in) :: scaled
    logical, intent(in) :: excluded(:)
    real(dp), intent(in) :: opening(:), step
    integer, intent(inout) :: state(:)
    real(dp), intent(inout) :: force(:)
    logical, intent(out) :: joined
    integer :: k

    joined = .false.
    do k = 1, size(state)
      if (excluded(k) .or. scaled%tied(k)) cycle
      if (state(k)*force(k) > 0.0_dp) cycle
      force(k) = 0.0_dp
      state(k) = 0
      if (opening(k) < 0.0_dp) then
        state(k) = 1
        force(k) = -step*opening(k)
      else if (opening(k) > scaled%play(k)) then
        state(k) = -1
        force(k) = -step*(opening(k) - scaled%play(k))
      end if
      joined = joined .or. state(k) /= 0
    end do
  end subroutine join

  !> Take the motions out of lengths, so that those at the contact have none left.
  subroutine take_motions(modes, contact, length, other)
    real(dp), intent(in) :: modes(:, :)
    logical, intent(in) :: contact(:)
    real(dp), intent(inout) :: length(:)
    real(dp), intent(inout), optional :: other(:)
    real(dp) :: motion(size(modes, 2))

    if (size(motion) < 1) return
    call solve_held(modes, contact, matmul(merge(length, 0.0_dp, contact), modes), motion)
    length = length - matmul(modes, motion)
    if (present(other)) other = other - matmul(modes, motion)
  end subroutine take_motions

  !> Back into equilibrium, by the least forces at the contact; those that then pull leave.
  subroutine balance(modes, scaled, state, force)
    real(dp), intent(in) :: modes(:, :)
    type(scaled_scene), intent(in) :: scaled
    integer, intent(inout) :: state(:)
    real(dp), intent(inout) :: force(:)
    real(dp) :: motion(size(scaled%load))
    integer :: round

    do round = 1, ROUNDS
      if (size(motion) > 0) then
        call solve_held(modes, state /= 0, scaled%load - matmul(force, modes), motion)
        force = merge(force + matmul(modes, motion), 0.0_dp, state /= 0)
      end if
      where (state*force <= 0.0_dp .and. .not. scaled%tied) force = 0.0_dp
    end do
    where (.not. (abs(force) > 0.0_dp .or. scaled%tied)) state = 0
  end subroutine balance

  !> Solve with R^T R of the contact.
  subroutine solve_held(modes, contact, right, solution)
    real(dp), intent(in) :: modes(:, :), right(:)
    logical, intent(in) :: contact(:)
    real(dp), intent(out) :: solution(:)
    real(dp) :: held(size(modes, 1), size(modes, 2)), square(size(right), size(right))
    integer :: pivots(size(right)), info, j

    held = merge(modes, 0.0_dp, spread(contact, 2, size(modes, 2)))
    square = matmul(transpose(held), held)
    do j = 1, size(right)
      square(j, j) = square(j, j) + HARDLY_HELD*real(size(modes, 1), dp)
    end do
    solution = right
    call dgesv(size(right), 1, square, size(right), pivots, solution, size(right), info)
    if (info /= 0) solution = 0.0_dp
  end subroutine solve_held

end module fuge_initial_states
