!> Random problems of one to twelve points with every mixture of laws. The number of a problem says all of it.
module random_laws
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_kinds, only: dp
  use fuge_problem_type, only: fuge_problem
  use general_reference, only: draw, integers, is_excluded, play_of
  use special_numbers, only: infinity
  use random_draws, only: chance, decimal, one_of, seed_of, uniform
  implicit none
  private

  public :: draw_laws

  !> A matrix and a problem; what they are, in words.
  type, public :: law_scene
    integer :: number = 0
    character(len=16) :: body = '', load = ''
    real(dp), allocatable :: alpha(:, :)
    type(fuge_problem) :: problem
  end type law_scene

  integer, parameter :: MOST_POINTS = 12, MOST_MOTIONS = 3

contains

  !> Problem `number` >= 1.
  subroutine draw_laws(number, scene)
    integer, intent(in) :: number
    type(law_scene), intent(out) :: scene
    integer(int64) :: seed
    integer :: points, motions
    logical :: whole

    scene%number = number
    seed = seed_of(number)
    points = 1 + int(real(MOST_POINTS, dp)*uniform(seed, 0.0_dp, 1.0_dp)**1.5_dp)
    motions = one_of(seed, MOST_MOTIONS + 1) - 1
    if (chance(seed, 0.4_dp)) motions = min(motions, 1)
    motions = min(motions, points)
    whole = chance(seed, 0.4_dp)
    allocate (scene%alpha(points, points))
    call draw_matrix(seed, whole, scene)
    call draw_modes(seed, whole, motions, scene%problem)
    call draw_laws_of_points(seed, whole, scene)
    call draw_springs(seed, whole, scene%problem)
    call draw_controls(seed, whole, scene)
    call join_points(seed, scene)
    call change_units(seed, scene)
  end subroutine draw_laws

  !> A positive definite matrix, or none of rigid bodies; whole numbers cause ties.
  subroutine draw_matrix(seed, whole, scene)
    integer(int64), intent(inout) :: seed
    logical, intent(in) :: whole
    type(law_scene), intent(inout) :: scene
    real(dp) :: base(size(scene%alpha, 1), size(scene%alpha, 1)), share
    integer :: j, k, kind

    kind = one_of(seed, 10)
    do k = 1, size(base, 1)
      if (whole) call integers(seed, -1, 1, base(:, k))
      if (.not. whole) call values_between(seed, .false., -0.5_dp, 0.5_dp, base(:, k))
    end do
    scene%body = 'random'
    select case (kind)
    case (1)
      base = 0.0_dp
      share = 0.0_dp
      scene%body = 'rigid'
    case (2)
      base = 0.0_dp
      share = 1.0_dp
      scene%body = 'springs'
    case (3)
      share = decimal(seed, -8.0_dp, -1.0_dp)
      scene%body = 'ill-conditioned'
    case (4)
      share = 0.05_dp
      do k = 1, size(base, 1)
        base(k, :) = base(k, :)*decimal(seed, -3.0_dp, 3.0_dp)
      end do
      scene%body = 'badly scaled'
    case default
      share = 0.05_dp
    end select
    scene%alpha = matmul(base, transpose(base))
    if (kind == 5) then
      do k = 1, size(base, 1)
        scene%alpha(:, k) = [(exp(-abs(real(j - k, dp))/4.0_dp), j=1, size(base, 1))]
      end do
      scene%body = 'smooth'
    end if
    if (kind == 1) return
    if (whole .and. kind /= 3 .and. kind /= 4) share = 1.0_dp
    do k = 1, size(base, 1)
      scene%alpha(k, k) = scene%alpha(k, k) + share*merge(1.0_dp, scene%alpha(k, k), kind /= 4)
      if (.not. scene%alpha(k, k) > 0.0_dp) scene%alpha(k, k) = 1.0_dp
    end do
  end subroutine draw_matrix

  !> Values between two bounds; whole ones if so.
  subroutine values_between(seed, whole, low, high, values)
    integer(int64), intent(inout) :: seed
    logical, intent(in) :: whole
    real(dp), intent(in) :: low, high
    real(dp), intent(out) :: values(:)

    if (whole) then
      call integers(seed, nint(low), nint(high), values)
    else
      call draw(seed, values)
      values = low + (high - low)*values
    end if
  end subroutine values_between

  !> A translation, a tilt, and any modes.
  subroutine draw_modes(seed, whole, motions, problem)
    integer(int64), intent(inout) :: seed
    logical, intent(in) :: whole
    integer, intent(in) :: motions
    type(fuge_problem), intent(inout) :: problem
    integer :: j, k, n

    n = MOST_POINTS
    allocate (problem%modes(n, motions))
    do j = 1, motions
      call values_between(seed, whole, -2.0_dp, 2.0_dp, problem%modes(:, j))
    end do
    if (chance(seed, 0.2_dp)) return
    if (motions > 0) problem%modes(:, 1) = 1.0_dp
    if (motions < 2) return
    if (chance(seed, 0.7_dp)) problem%modes(:, 2) = [(real(k - n/2, dp), k=1, n)]
  end subroutine draw_modes

  !> Plays, limits, exclusions and compliances.
  subroutine draw_laws_of_points(seed, whole, scene)
    integer(int64), intent(inout) :: seed
    logical, intent(in) :: whole
    type(law_scene), intent(inout) :: scene
    real(dp), allocatable :: choice(:)
    real(dp) :: share, size_of
    logical :: has_springs
    integer :: n

    n = size(scene%alpha, 1)
    scene%problem%modes = scene%problem%modes(:n, :)
    allocate (choice(n))
    associate (problem => scene%problem)
      if (chance(seed, 0.5_dp)) then
        call draw_values(seed, whole, n, infinity(), problem%gap_upper)
      end if
      if (chance(seed, 0.6_dp)) call draw_values(seed, whole, n, infinity(), problem%limit)
      if (allocated(problem%limit)) then
        if (chance(seed, 0.3_dp)) problem%limit = problem%limit(1)
      end if
      if (chance(seed, 0.4_dp)) call draw_values(seed, whole, n, infinity(), problem%limit_upper)
      if (chance(seed, 0.2_dp)) then
        call draw(seed, choice)
        share = uniform(seed, 0.0_dp, 0.6_dp)
        problem%excluded = choice < share
      end if
      has_springs = chance(seed, 0.5_dp)
      if (has_springs .or. scene%body == 'rigid') then
        call draw_values(seed, whole, n, 0.0_dp, problem%compliance)
        size_of = 1.0_dp
        if (chance(seed, 0.5_dp)) size_of = decimal(seed, -12.0_dp, 12.0_dp)
        problem%compliance = size_of*problem%compliance
        if (scene%body == 'rigid') where (.not. problem%compliance > 0.0_dp) problem%compliance = size_of
      end if
    end associate
  end subroutine draw_laws_of_points

  !> Values of 0 to 3, or of very different sizes, or `other`, or 0.
  subroutine draw_values(seed, whole, number, other, values)
    integer(int64), intent(inout) :: seed
    logical, intent(in) :: whole
    integer, intent(in) :: number
    real(dp), intent(in) :: other
    real(dp), allocatable, intent(out) :: values(:)
    real(dp) :: choice(number), share, none
    integer :: k

    allocate (values(number))
    call values_between(seed, whole, 0.0_dp, 3.0_dp, values)
    if (chance(seed, 0.2_dp)) then
      do k = 1, number
        values(k) = values(k)*decimal(seed, -6.0_dp, 3.0_dp)
      end do
    end if
    share = uniform(seed, 0.0_dp, 0.8_dp)
    none = uniform(seed, 0.0_dp, 0.3_dp)
    if (chance(seed, 0.1_dp)) none = 1.0_dp
    call draw(seed, choice)
    where (choice < share) values = other
    call draw(seed, choice)
    where (choice < none) values = 0.0_dp
  end subroutine draw_values

  !> Springs on motions, from very soft to very stiff.
  subroutine draw_springs(seed, whole, problem)
    integer(int64), intent(inout) :: seed
    logical, intent(in) :: whole
    type(fuge_problem), intent(inout) :: problem
    integer :: j

    if (size(problem%modes, 2) < 1) return
    if (chance(seed, 0.5_dp)) return
    call draw_values(seed, whole, size(problem%modes, 2), 0.0_dp, problem%motion_stiffness)
    if (chance(seed, 0.5_dp)) return
    do j = 1, size(problem%motion_stiffness)
      problem%motion_stiffness(j) = problem%motion_stiffness(j)*decimal(seed, -12.0_dp, 12.0_dp)
    end do
  end subroutine draw_springs

  !> Gaps, resultants and prescribed motions: of an answer that is drawn first, or any.
  subroutine draw_controls(seed, whole, scene)
    integer(int64), intent(inout) :: seed
    logical, intent(in) :: whole
    type(law_scene), intent(inout) :: scene
    real(dp) :: motion(size(scene%problem%modes, 2)), force(size(scene%alpha, 1))
    integer :: kind, m, n

    m = size(motion)
    n = size(force)
    allocate (scene%problem%gap(n), scene%problem%resultant(m))
    call values_between(seed, whole, -2.0_dp, 2.0_dp, scene%problem%gap)
    call values_between(seed, whole, -1.0_dp, 2.0_dp, motion)
    call values_between(seed, whole, -1.0_dp, 4.0_dp, scene%problem%resultant)
    scene%load = 'any'
    kind = one_of(seed, 10)
    if (m > 0) then
      if (chance(seed, 0.25_dp)) call prescribe(seed, motion, scene%problem)
    end if
    select case (kind)
    case (1:4)
      call from_answer(seed, whole, motion, scene)
      scene%load = 'of an answer'
    case (5)
      scene%problem%resultant = 0.0_dp
      scene%load = 'none'
    case (6)
      call draw_states(seed, whole, scene%problem, force)
      scene%problem%resultant = matmul(force, scene%problem%modes)
      scene%load = 'of forces'
    case (7)
      call load_at_the_limits(seed, scene)
    end select
  end subroutine draw_controls

  subroutine prescribe(seed, motion, problem)
    integer(int64), intent(inout) :: seed
    real(dp), intent(in) :: motion(:)
    type(fuge_problem), intent(inout) :: problem
    real(dp) :: share
    integer :: j

    share = merge(1.0_dp, 0.5_dp, chance(seed, 0.4_dp))
    allocate (problem%prescribed(size(motion)))
    problem%motion = motion
    do j = 1, size(motion)
      problem%prescribed(j) = chance(seed, share)
    end do
  end subroutine prescribe

  !> Gaps and resultants that have an answer in which many points are at a corner of their law.
  subroutine from_answer(seed, whole, motion, scene)
    integer(int64), intent(inout) :: seed
    logical, intent(in) :: whole
    real(dp), intent(in) :: motion(:)
    type(law_scene), intent(inout) :: scene
    real(dp) :: force(size(scene%alpha, 1)), gap(size(scene%alpha, 1)), loads(size(motion))

    call draw_states(seed, whole, scene%problem, force, gap)
    loads = scene%problem%spring_loads(motion)
    associate (problem => scene%problem)
      problem%gap = gap - matmul(scene%alpha, force) + matmul(problem%modes, motion)
      if (allocated(problem%compliance)) problem%gap = problem%gap - problem%compliance*force
      problem%resultant = matmul(force, problem%modes) + loads
    end associate
  end subroutine from_answer

  !> Forces of random states, and the gaps that go with them.
  subroutine draw_states(seed, whole, problem, force, gap)
    integer(int64), intent(inout) :: seed
    logical, intent(in) :: whole
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(out) :: force(:)
    real(dp), intent(out), optional :: gap(:)
    real(dp) :: drawn(size(force)), beyond(size(force)), limits(2), play, found
    integer :: k, state

    call values_between(seed, whole, 0.0_dp, 2.0_dp, drawn)
    call values_between(seed, whole, 0.0_dp, 2.0_dp, beyond)
    do k = 1, size(force)
      limits = infinity()
      if (allocated(problem%limit)) limits(1) = problem%limit(k)
      if (allocated(problem%limit_upper)) limits(2) = problem%limit_upper(k)
      if (is_excluded(problem, k)) limits = 0.0_dp
      play = play_of(problem, k)
      state = one_of(seed, 5) - 3
      if (state < 0 .and. play > huge(play)) state = -state
      if (state == 2 .and. limits(1) > huge(play)) state = 1
      if (state == -2 .and. limits(2) > huge(play)) state = -1
      found = 0.0_dp
      select case (state)
      case (2)
        force(k) = limits(1)
        found = -beyond(k)
      case (1)
        force(k) = min(drawn(k), limits(1))
      case (-1)
        force(k) = -min(drawn(k), limits(2))
        found = play
      case (-2)
        force(k) = -limits(2)
        found = play + beyond(k)
      case default
        force(k) = 0.0_dp
        found = min(beyond(k), play)
      end select
      if (present(gap)) gap(k) = found
    end do
  end subroutine draw_states

  !> All that the limits carry, or a little less or more.
  subroutine load_at_the_limits(seed, scene)
    integer(int64), intent(inout) :: seed
    type(law_scene), intent(inout) :: scene
    integer :: j, k

    associate (problem => scene%problem)
      if (.not. allocated(problem%limit)) allocate (problem%limit, source=spread(1.0_dp, 1, size(problem%gap)))
      where (problem%limit > huge(1.0_dp)) problem%limit = 1.0_dp
      problem%resultant = 0.0_dp
      do k = 1, size(problem%limit)
        if (is_excluded(problem, k)) cycle
        problem%resultant = problem%resultant + problem%limit(k)*problem%modes(k, :)
      end do
      scene%load = 'at the limits'
      if (chance(seed, 0.5_dp)) return
      do j = 1, size(problem%resultant)
        problem%resultant(j) = problem%resultant(j)*(1.0_dp + uniform(seed, -1.0_dp, 1.0_dp)*1.0e-6_dp)
      end do
      scene%load = 'near the limits'
    end associate
  end subroutine load_at_the_limits

  !> Make a point the same as another one, on springs so that its force is its own.
  subroutine join_points(seed, scene)
    integer(int64), intent(inout) :: seed
    type(law_scene), intent(inout) :: scene
    integer :: from, to, n

    n = size(scene%alpha, 1)
    if (n < 2) return
    if (.not. chance(seed, 0.1_dp)) return
    from = one_of(seed, n)
    to = 1 + modulo(from, n)
    associate (problem => scene%problem)
      scene%alpha(:, to) = scene%alpha(:, from)
      scene%alpha(to, :) = scene%alpha(from, :)
      scene%alpha(to, to) = scene%alpha(from, from)
      problem%gap(to) = problem%gap(from)
      problem%modes(to, :) = problem%modes(from, :)
      if (.not. allocated(problem%compliance)) allocate (problem%compliance, source=spread(0.0_dp, 1, n))
      problem%compliance([from, to]) = max(problem%compliance(from), 0.125_dp)
      if (allocated(problem%limit)) problem%limit(to) = problem%limit(from)
      if (allocated(problem%limit_upper)) problem%limit_upper(to) = problem%limit_upper(from)
      if (allocated(problem%gap_upper)) problem%gap_upper(to) = problem%gap_upper(from)
      if (allocated(problem%excluded)) problem%excluded(to) = problem%excluded(from)
    end associate
    scene%body = trim(scene%body)//', twins'
  end subroutine join_points

  !> Other units of force and of length, powers of two.
  subroutine change_units(seed, scene)
    integer(int64), intent(inout) :: seed
    type(law_scene), intent(inout) :: scene
    integer :: of_force, of_length

    if (chance(seed, 0.5_dp)) return
    of_force = one_of(seed, 80) - 40
    of_length = one_of(seed, 80) - 40
    scene%alpha = scale(scene%alpha, of_length - of_force)
    associate (problem => scene%problem)
      problem%gap = scale(problem%gap, of_length)
      problem%resultant = scale(problem%resultant, of_force)
      if (allocated(problem%motion)) problem%motion = scale(problem%motion, of_length)
      if (allocated(problem%compliance)) problem%compliance = scale(problem%compliance, of_length - of_force)
      if (allocated(problem%motion_stiffness)) &
        problem%motion_stiffness = scale(problem%motion_stiffness, of_force - of_length)
      call scale_finite(of_length, problem%gap_upper)
      call scale_finite(of_force, problem%limit)
      call scale_finite(of_force, problem%limit_upper)
    end associate
  end subroutine change_units

  subroutine scale_finite(power, values)
    integer, intent(in) :: power
    real(dp), allocatable, intent(inout) :: values(:)

    if (.not. allocated(values)) return
    where (values <= huge(1.0_dp)) values = scale(values, power)
  end subroutine scale_finite

end module random_laws
