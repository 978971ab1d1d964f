!> A first guess of the contact set by a few projected conjugate gradients (I. A. Polonsky, L. M. Keer, Wear 231,
!> 1999), each one product with alpha; with any number of rigid modes and two stops.
!>
!> The displacements go along with the forces: after a step, only what was added to it at points that changed has to be
!> multiplied.
module fuge_initial_set
  use fuge_canonical_problem, only: canonical_problem
  use fuge_contact_states, only: FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, FUGE_OPEN
  use fuge_displacements, only: add_rough_product
  use fuge_kinds, only: dp
  use fuge_lapack, only: ddot, dgesv
  use fuge_threads, only: run_in_parts, share, threads_here, work_in_parts
  implicit none
  private

  public :: guess_initial_set

  !> At most this many iterations are made; one costs about as much as a few percent of a factorisation.
  integer, parameter :: MOST_ITERATIONS = 16
  !> Lengths beyond this, the largest data being about 1, are no guess any more, and their squares would overflow.
  real(dp), parameter :: DIVERGED = 1.0e100_dp
  !> The set has converged when fewer than 1/SETTLED of the contact points change, and no more than FEW_CHANGES, QUIET
  !> times in a row: once is not enough on graded grids. Another set costs some products.
  integer, parameter :: SETTLED = 64, FEW_CHANGES = 3, QUIET = 2
  !> For the plain problem the set has not converged while more than 1/FEW_OPEN of the open points change: these may be
  !> few and far apart.
  integer, parameter :: FEW_OPEN = 8
  !> Equilibrium is restored, and the points that then pull are opened, this many times.
  integer, parameter :: ROUNDS = 2
  !> Slopes below this fraction of the gaps that they are differences of are rounding.
  real(dp), parameter :: ROUNDING = 1.0e-13_dp
  !> Resistance to a mode below this fraction of that of all points together is not used.
  real(dp), parameter :: HARDLY_RESISTED = 1.0e-12_dp
  !> For this many points or more, with less than this fraction of them in contact, of which fewer than 1/CALM change,
  !> their block of alpha is worth its copy; so are those of the points that have joined since, NARROW_ROUNDS in all.
  integer, parameter :: WORTH_A_BLOCK = 128, CALM = 5, NARROW_ROUNDS = 3
  !> Threads share the copy of the block of as many points as this.
  integer, parameter :: MANY_POINTS = 384
  real(dp), parameter :: NARROW = 0.6_dp
  !> A play beyond this many times the length of the problem counts as unlimited.
  real(dp), parameter :: FAR = 1.0e8_dp

  !> Forces as fractions of a force of the problem, lengths as fractions of a length of it, so that units do not
  !> matter.
  type :: scaled_problem
    real(dp), allocatable :: gap(:), upper(:), load(:)
    !> Scaled length per scaled force and unit of alpha; zero if there is no load to compare forces with.
    real(dp) :: factor = 0.0_dp
    logical, allocatable :: tied(:)
  end type scaled_problem

  !> Where the descent stands; all (n), scaled.
  type :: descent
    !> Forces and the displacements by them.
    real(dp), allocatable :: force(:), displacement(:)
    !> Gaps less their rigid part, and their distances from the stops; zero at open points.
    real(dp), allocatable :: gap(:), slope(:)
    !> The direction of the step, the displacements by it, and these less their rigid part.
    real(dp), allocatable :: direction(:), change(:), elastic_change(:)
    !> Forces after the step, and what was added to them.
    real(dp), allocatable :: stepped(:), added(:)
    !> 1 at points at a stop, else 0, and their number.
    real(dp), allocatable :: weight(:)
    integer :: contacts = 0
    !> Sum of the squares of the slopes one step before; zero for a new start.
    real(dp) :: previous = 0.0_dp
    !> Length of the last step.
    real(dp) :: step = 0.0_dp
  end type descent

  !> A block of alpha that is copied, of which each part has some columns.
  type, extends(work_in_parts) :: block_copy
    real(dp), pointer, contiguous :: alpha(:, :) => null(), block(:, :) => null()
    integer, pointer, contiguous :: points(:) => null()
  contains
    procedure :: do_part => copy_part
  end type block_copy

contains

  !> The states (n) that the points probably have.
  !>
  !> `canonical` with its matrix. On entry `state` is a fallback, kept if there is no load or if nothing touches;
  !> `products` grows by the products with alpha.
  subroutine guess_initial_set(canonical, state, products)
    type(canonical_problem), intent(in) :: canonical
    integer, intent(inout) :: state(:), products
    type(scaled_problem) :: scaled
    type(descent) :: now
    integer :: fallback(size(state))

    call make_scaled(canonical, scaled)
    if (.not. scaled%factor > 0.0_dp) return
    fallback = state
    call start_descent(canonical, scaled, state, now, products)
    call descend(canonical, scaled, size(state) >= WORTH_A_BLOCK, state, now, products)
    ! Nothing touched from the start, or numbers have overflowed.
    if (.not. (any(state /= FUGE_OPEN) .and. all(abs(now%force) <= huge(1.0_dp)))) state = fallback
  end subroutine guess_initial_set

  !> Descend until the set has converged. With `may_narrow` most of that is done with the block of alpha of the points
  !> in contact, once few of them change.
  recursive subroutine descend(canonical, scaled, may_narrow, state, now, products)
    type(canonical_problem), intent(in) :: canonical
    type(scaled_problem), intent(in) :: scaled
    logical, intent(in) :: may_narrow
    integer, intent(inout) :: state(:), products
    type(descent), intent(inout) :: now
    integer :: before(size(state)), contacts, iteration, quiet_for, round
    logical :: gains

    quiet_for = 0
    do iteration = 1, MOST_ITERATIONS
      call find_slope(canonical, scaled, state, now)
      call find_step(canonical, scaled, now, gains, products)
      if (.not. gains) exit
      before = state
      call take_descent_step(canonical, scaled, state, now)
      if (.not. any(state /= FUGE_OPEN)) then
        state = before
        exit
      end if
      quiet_for = merge(quiet_for + 1, 0, is_settled(canonical, before, state))
      if (quiet_for >= QUIET) exit
      if (.not. may_narrow) cycle
      contacts = count(state /= FUGE_OPEN)
      if (contacts > NARROW*size(state) .or. count(state /= before)*CALM > contacts) cycle
      do round = 1, NARROW_ROUNDS
        call descend_on_contact(canonical, scaled, state, now, products)
        before = state
        call find_slope(canonical, scaled, state, now)
        call take_descent_step(canonical, scaled, state, now)
        if (is_settled(canonical, before, state)) exit
      end do
      exit
    end do
  end subroutine descend

  !> Descend with the points in contact only, which may open, and find the displacements of all points by what has been
  !> added to the forces. The direction is zero on return.
  recursive subroutine descend_on_contact(canonical, scaled, state, now, products)
    type(canonical_problem), intent(in) :: canonical
    type(scaled_problem), intent(in) :: scaled
    integer, intent(inout) :: state(:), products
    type(descent), intent(inout) :: now
    type(canonical_problem) :: part
    type(scaled_problem) :: scaled_part
    type(descent) :: there
    real(dp), allocatable, target :: block(:, :)
    integer :: points(count(state /= FUGE_OPEN)), states(size(points)), j, m, stat

    m = size(points)
    allocate (block(m, m), stat=stat)
    if (stat /= 0) then
      now%direction = 0.0_dp
      now%change = 0.0_dp
      return
    end if
    points = pack([(j, j=1, size(state))], state /= FUGE_OPEN)
    call gather_block(canonical%alpha, points, block)
    part%alpha => block
    part%plain = canonical%plain
    part%modes = canonical%modes(points, :)
    part%load = canonical%load
    part%excluded = canonical%excluded(points)
    scaled_part%gap = scaled%gap(points)
    scaled_part%upper = scaled%upper(points)
    scaled_part%tied = scaled%tied(points)
    scaled_part%load = scaled%load
    scaled_part%factor = scaled%factor
    states = state(points)
    call allocate_descent(m, there)
    there%force = now%force(points)
    there%displacement = now%displacement(points)
    there%direction = now%direction(points)
    there%previous = now%previous
    now%direction = 0.0_dp
    now%change = 0.0_dp
    now%previous = 0.0_dp
    there%step = now%step
    call descend(part, scaled_part, .false., states, there, products)
    now%added = 0.0_dp
    now%added(points) = there%force - now%force(points)
    now%force(points) = there%force
    now%step = there%step
    state(points) = states
    call add_rough_product(canonical%alpha, scaled%factor, now%added, now%displacement)
    products = products + 1
  end subroutine descend_on_contact

  !> The block of alpha of some points; threads share the columns if there are many.
  subroutine gather_block(alpha, points, block)
    real(dp), intent(in), target, contiguous :: alpha(:, :)
    integer, intent(in), target, contiguous :: points(:)
    real(dp), intent(inout), target, contiguous :: block(:, :)
    type(block_copy) :: work

    work%alpha => alpha
    work%points => points
    work%block => block
    call run_in_parts(merge(threads_here(), 1, size(points) >= MANY_POINTS), work)
  end subroutine gather_block

  subroutine copy_part(self, part, parts)
    class(block_copy), intent(inout) :: self
    integer, intent(in) :: part, parts
    integer :: first, j, last

    call share(size(self%points), part, parts, first, last)
    do j = first + 1, last + 1
      call copy_column(self%alpha(:, self%points(j)), self%points, self%block(:, j))
    end do
  end subroutine copy_part

  pure subroutine copy_column(column, points, copy)
    real(dp), intent(in), contiguous :: column(:)
    integer, intent(in), contiguous :: points(:)
    real(dp), intent(inout), contiguous :: copy(:)
    integer :: i

    do i = 1, size(points)
      copy(i) = column(points(i))
    end do
  end subroutine copy_column

  !> The problem without units.
  pure subroutine make_scaled(canonical, scaled)
    type(canonical_problem), intent(in) :: canonical
    type(scaled_problem), intent(out) :: scaled
    real(dp) :: lowest, largest, length
    integer :: k, n

    n = size(canonical%gap)
    scaled%load = canonical%load
    if (.not. any(abs(canonical%load) > 0.0_dp)) return
    largest = maxval(abs(canonical%load))
    lowest = 0.0_dp
    if (canonical%has_translation) lowest = minval(canonical%gap, mask=.not. canonical%excluded)
    scaled%gap = merge(0.0_dp, canonical%gap - lowest, canonical%excluded)
    if (canonical%plain) then
      ! A constant in all of alpha does not displace points against each other.
      length = max(maxval(scaled%gap), largest*maxval(abs(canonical%alpha(1:n, 1) - canonical%alpha(1, 1))))
      if (.not. length > 0.0_dp) length = 1.0_dp
    else
      length = max(maxval(abs(scaled%gap)), largest*maxval([(abs(canonical%alpha(k, k)), k=1, n)]))
      if (.not. length > 0.0_dp) return
    end if
    scaled%gap = scaled%gap/length
    scaled%load = canonical%load/largest
    scaled%factor = largest/length
    allocate (scaled%upper(n))
    scaled%upper = huge(1.0_dp)
    where (canonical%upper/FAR < length) scaled%upper = canonical%upper/length
    scaled%tied = canonical%is_tied()
  end subroutine make_scaled

  !> Start with even forces at all points that have one stop only or are tied.
  subroutine start_descent(canonical, scaled, state, now, products)
    type(canonical_problem), intent(in) :: canonical
    type(scaled_problem), intent(in) :: scaled
    integer, intent(inout) :: state(:), products
    type(descent), intent(out) :: now
    integer :: n

    n = size(state)
    call allocate_descent(n, now)
    if (canonical%plain) then
      state = FUGE_AT_LOWER_STOP
      now%force = 1.0_dp/real(n, dp)
    else
      state = merge(FUGE_OPEN, FUGE_AT_LOWER_STOP, &
                    canonical%excluded .or. (scaled%upper < huge(1.0_dp) .and. .not. scaled%tied))
      now%force = 0.0_dp
      call restore_equilibrium(canonical, scaled, state, now%force)
    end if
    now%direction = 0.0_dp
    now%displacement = 0.0_dp
    call add_rough_product(canonical%alpha, scaled%factor, now%force, now%displacement)
    products = products + 1
  end subroutine start_descent

  pure subroutine allocate_descent(n, now)
    integer, intent(in) :: n
    type(descent), intent(out) :: now

    allocate (now%force(n), now%displacement(n), now%gap(n), now%slope(n), now%direction(n), now%change(n), &
              now%elastic_change(n), now%stepped(n), now%added(n), now%weight(n))
  end subroutine allocate_descent

  !> Gaps less their rigid part, and their distances from the stops.
  subroutine find_slope(canonical, scaled, state, now)
    type(canonical_problem), intent(in) :: canonical
    type(scaled_problem), intent(in) :: scaled
    integer, intent(in) :: state(:)
    type(descent), intent(inout) :: now

    now%contacts = count(state /= FUGE_OPEN)
    now%weight = real(abs(state), dp)
    now%gap = scaled%gap + now%displacement
    if (canonical%plain) then
      call subtract_rigid_motion(canonical, now%weight, now%contacts, now%gap)
      now%slope = now%weight*now%gap
    else
      now%slope = now%gap
      where (state < FUGE_OPEN) now%slope = now%gap - scaled%upper
      call subtract_rigid_motion(canonical, now%weight, now%contacts, now%slope, now%gap)
      where (state == FUGE_OPEN) now%slope = 0.0_dp
    end if
  end subroutine find_slope

  !> The conjugate direction, the displacements by it, and the step along it to the least energy, if it `gains` any.
  subroutine find_step(canonical, scaled, now, gains, products)
    type(canonical_problem), intent(in) :: canonical
    type(scaled_problem), intent(in) :: scaled
    type(descent), intent(inout) :: now
    logical, intent(out) :: gains
    integer, intent(inout) :: products
    real(dp) :: curvature, conjugacy, largest, squares, step
    integer :: n

    n = size(now%slope)
    gains = .false.
    largest = largest_of(now%slope)
    if (largest <= ROUNDING*largest_of(now%gap) .or. largest > DIVERGED) return
    squares = ddot(n, now%slope, 1, now%slope, 1)
    if (.not. squares > 0.0_dp) return
    conjugacy = 0.0_dp
    if (now%previous > 0.0_dp) conjugacy = squares/now%previous
    now%direction = now%weight*(now%slope + conjugacy*now%direction)
    now%previous = squares
    now%change = 0.0_dp
    call add_rough_product(canonical%alpha, scaled%factor, now%direction, now%change)
    products = products + 1
    now%elastic_change = now%change
    call subtract_rigid_motion(canonical, now%weight, now%contacts, now%elastic_change)
    curvature = ddot(n, now%elastic_change, 1, now%direction, 1)
    if (.not. curvature > 0.0_dp) return
    step = ddot(n, now%slope, 1, now%direction, 1)/curvature
    gains = step > 0.0_dp
    if (gains) now%step = step
  end subroutine find_step

  !> The largest magnitude.
  pure function largest_of(values) result(most)
    real(dp), intent(in), contiguous :: values(:)
    real(dp) :: most
    real(dp) :: most_of(4)
    integer :: k, whole

    most_of = 0.0_dp
    whole = size(values) - modulo(size(values), 4)
    do k = 1, whole, 4
      most_of = max(most_of, abs(values(k:k + 3)))
    end do
    do k = whole + 1, size(values)
      most_of(1) = max(most_of(1), abs(values(k)))
    end do
    most = maxval(most_of)
  end function largest_of

  !> Take the step, exchange points and restore equilibrium; the displacements follow.
  subroutine take_descent_step(canonical, scaled, state, now)
    type(canonical_problem), intent(in) :: canonical
    type(scaled_problem), intent(in) :: scaled
    integer, intent(inout) :: state(:)
    type(descent), intent(inout) :: now
    real(dp) :: stretch
    logical :: exchanged, joined

    now%stepped = now%force - now%step*now%direction
    stretch = 1.0_dp
    exchanged = .true.
    if (canonical%plain) then
      call exchange_plain_points(now%stepped, now%gap, now%step, state, now%force, now%added, exchanged, joined)
      call stretch_forces(state, now%force, stretch)
    else
      now%force = now%stepped
      call exchange_points(scaled, canonical%excluded, now%gap, now%step, state, now%force, joined)
      call restore_equilibrium(canonical, scaled, state, now%force)
      now%added = now%force - now%stepped
    end if
    if (joined) now%previous = 0.0_dp
    now%displacement = now%displacement - now%step*now%change
    if (exchanged) call add_rough_product(canonical%alpha, scaled%factor, now%added, now%displacement)
    now%displacement = stretch*now%displacement
  end subroutine take_descent_step

  !> As `exchange_points` for the plain problem, from the forces after the step to `force`; `added` is their difference,
  !> which is not zero at a few points only, those `exchanged`, if any were.
  pure subroutine exchange_plain_points(stepped, gap, step, state, force, added, exchanged, joined)
    real(dp), intent(in), contiguous :: stepped(:), gap(:)
    real(dp), intent(in) :: step
    integer, intent(inout), contiguous :: state(:)
    real(dp), intent(inout), contiguous :: force(:), added(:)
    logical, intent(out) :: exchanged, joined
    integer :: k

    exchanged = .false.
    joined = .false.
    do k = 1, size(state)
      force(k) = stepped(k)
      added(k) = 0.0_dp
      if (state(k) /= FUGE_OPEN .and. stepped(k) > 0.0_dp) cycle
      state(k) = FUGE_OPEN
      force(k) = 0.0_dp
      if (gap(k) < 0.0_dp) then
        state(k) = FUGE_AT_LOWER_STOP
        force(k) = -step*gap(k)
        joined = .true.
      end if
      added(k) = force(k) - stepped(k)
      exchanged = exchanged .or. abs(added(k)) > 0.0_dp
    end do
  end subroutine exchange_plain_points

  !> Points whose force no longer pushes at their stop open; open ones beyond a stop join it. `joined` if any did.
  pure subroutine exchange_points(scaled, excluded, gap, step, state, force, joined)
    type(scaled_problem), intent(in) :: scaled
    logical, intent(in) :: excluded(:)
    real(dp), intent(in) :: gap(:), step
    integer, intent(inout) :: state(:)
    real(dp), intent(inout) :: force(:)
    logical, intent(out) :: joined
    integer :: k

    joined = .false.
    do k = 1, size(state)
      if (excluded(k) .or. scaled%tied(k)) cycle
      if (state(k)*force(k) > 0.0_dp) cycle
      force(k) = 0.0_dp
      state(k) = FUGE_OPEN
      if (gap(k) < 0.0_dp) then
        state(k) = FUGE_AT_LOWER_STOP
        force(k) = -step*gap(k)
      else if (gap(k) > scaled%upper(k)) then
        state(k) = FUGE_AT_UPPER_STOP
        force(k) = -step*(gap(k) - scaled%upper(k))
      end if
      joined = joined .or. state(k) /= FUGE_OPEN
    end do
  end subroutine exchange_points

  !> Have few enough points changed?
  pure function is_settled(canonical, before, state)
    type(canonical_problem), intent(in) :: canonical
    integer, intent(in) :: before(:), state(:)
    logical :: is_settled
    integer :: changes

    changes = count(state /= before)
    is_settled = changes*SETTLED < count(state /= FUGE_OPEN) .and. changes <= FEW_CHANGES
    if (canonical%plain) is_settled = is_settled .and. changes*FEW_OPEN <= count(state == FUGE_OPEN)
  end function is_settled

  !> Subtract from displacements their least-squares rigid motion over the contact, from `other` (n) the same motion.
  !> `weight` (n) is 1 at the `contacts` points of the contact.
  subroutine subtract_rigid_motion(canonical, weight, contacts, length, other)
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in), contiguous :: weight(:)
    integer, intent(in) :: contacts
    real(dp), intent(inout), contiguous :: length(:)
    real(dp), intent(inout), optional :: other(:)

    if (canonical%plain) then
      length = length - ddot(size(length), weight, 1, length, 1)/real(max(contacts, 1), dp)
    else if (size(canonical%load) > 0) then
      call subtract_rigid_modes(canonical%modes, weight > 0.0_dp, length, other)
    end if
  end subroutine subtract_rigid_motion

  !> As `subtract_rigid_motion`, for any modes.
  subroutine subtract_rigid_modes(modes, contact, length, other)
    real(dp), intent(in) :: modes(:, :)
    logical, intent(in) :: contact(:)
    real(dp), intent(inout) :: length(:)
    real(dp), intent(inout), optional :: other(:)
    real(dp) :: motion(size(modes, 2)), in_contact(size(length))

    in_contact = merge(length, 0.0_dp, contact)
    call solve_on_contact(modes, contact, matmul(in_contact, modes), motion)
    length = length - matmul(modes, motion)
    if (present(other)) other = other - matmul(modes, motion)
  end subroutine subtract_rigid_modes

  !> Bring the forces of the plain problem back into equilibrium: a factor, `stretch`, keeps all of them pushing.
  pure subroutine stretch_forces(state, force, stretch)
    integer, intent(inout) :: state(:)
    real(dp), intent(inout) :: force(:)
    real(dp), intent(out) :: stretch
    real(dp) :: total

    total = sum(force)
    stretch = 1.0_dp
    ! After a step along rounding no force may be left.
    if (total > 0.0_dp) stretch = 1.0_dp/total
    force = stretch*force
    where (.not. force > 0.0_dp) state = FUGE_OPEN
  end subroutine stretch_forces

  !> Bring the forces back into equilibrium by the least forces that do, and open the points that then pull.
  subroutine restore_equilibrium(canonical, scaled, state, force)
    type(canonical_problem), intent(in) :: canonical
    type(scaled_problem), intent(in) :: scaled
    integer, intent(inout) :: state(:)
    real(dp), intent(inout) :: force(:)
    real(dp) :: motion(size(scaled%load))
    integer :: round

    do round = 1, ROUNDS
      if (size(motion) > 0) then
        call solve_on_contact(canonical%modes, state /= FUGE_OPEN, scaled%load - matmul(force, canonical%modes), motion)
        force = merge(force + matmul(canonical%modes, motion), 0.0_dp, state /= FUGE_OPEN)
      end if
      where (state*force <= 0.0_dp .and. .not. scaled%tied) force = 0.0_dp
    end do
    where (.not. (abs(force) > 0.0_dp .or. scaled%tied)) state = FUGE_OPEN
  end subroutine restore_equilibrium

  !> Solve with R^T R of the contact.
  subroutine solve_on_contact(modes, contact, right, solution)
    real(dp), intent(in) :: modes(:, :), right(:)
    logical, intent(in) :: contact(:)
    real(dp), intent(out) :: solution(:)
    real(dp) :: rows(size(modes, 1), size(modes, 2)), square(size(right), size(right))
    integer :: pivots(size(right)), info, j

    rows = merge(modes, 0.0_dp, spread(contact, 2, size(modes, 2)))
    square = matmul(transpose(rows), rows)
    do j = 1, size(right)
      square(j, j) = square(j, j) + HARDLY_RESISTED*real(size(modes, 1), dp)
    end do
    solution = right
    call dgesv(size(right), 1, square, size(right), pivots, solution, size(right), info)
    if (info /= 0) solution = 0.0_dp
  end subroutine solve_on_contact

end module fuge_initial_set
