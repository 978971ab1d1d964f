!> What problems with laws of points are tested against: the equations of every combination of the five states, solved
!> one by one, and the distance of an answer from its law. Of the library only the types are used.
module law_reference
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_kinds, only: dp
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use general_reference, only: draw, eliminate, integers, is_excluded, is_prescribed, modes_of, play_of
  use special_numbers, only: infinity
  implicit none
  private

  public :: energy_of, enumerate_laws, law_violation, random_law_problem, try_states

contains

  !> A random problem with `motions` modes and a positive definite `alpha` (points, points). `whole` numbers cause ties.
  !> Each kind of law occurs; without `laws` only play, ties, excluded points and prescribed motions do.
  subroutine random_law_problem(seed, points, motions, whole, alpha, problem, laws)
    integer(int64), intent(inout) :: seed
    integer, intent(in) :: points, motions
    logical, intent(in) :: whole
    real(dp), intent(out) :: alpha(:, :)
    type(fuge_problem), intent(out) :: problem
    logical, intent(in), optional :: laws
    real(dp) :: base(points, points), choice(points), kind_of(6)
    integer :: k

    do k = 1, points
      if (whole) call integers(seed, -1, 1, base(:, k))
      if (.not. whole) call draw(seed, base(:, k))
    end do
    if (.not. whole) base = base - 0.5_dp
    alpha = matmul(base, transpose(base))
    do k = 1, points
      alpha(k, k) = alpha(k, k) + merge(1.0_dp, 0.05_dp, whole)
    end do
    allocate (problem%gap(points), problem%modes(points, motions), problem%resultant(motions))
    call values_between(seed, whole, -2, 2, problem%gap)
    call values_between(seed, whole, -1, 3, problem%resultant)
    do k = 1, motions
      call values_between(seed, whole, -1, 1, problem%modes(:, k))
    end do
    if (motions > 0) problem%modes(:, 1) = 1.0_dp
    call draw(seed, kind_of)
    if (present(laws)) then
      ! Those of the six kinds that are drawn below this.
      if (.not. laws) kind_of = [0.0_dp, 1.0_dp, 1.0_dp, 1.0_dp, 1.0_dp, 0.5_dp*kind_of(6)]
      call draw(seed, choice)
      choice(1) = 1.0_dp
      if (.not. laws) problem%excluded = choice < 0.1_dp
    end if
    if (kind_of(1) < 0.5_dp) call some_values(seed, whole, 0, 2, 0.5_dp, infinity(), points, problem%gap_upper)
    if (kind_of(2) < 0.7_dp) call some_values(seed, whole, 0, 2, 0.3_dp, infinity(), points, problem%limit)
    if (kind_of(3) < 0.5_dp) call some_values(seed, whole, 0, 2, 0.3_dp, infinity(), points, problem%limit_upper)
    if (kind_of(4) < 0.5_dp) call some_values(seed, whole, 0, 3, 0.3_dp, 0.0_dp, points, problem%compliance)
    if (kind_of(5) < 0.5_dp) call some_values(seed, whole, 0, 3, 0.3_dp, 0.0_dp, motions, problem%motion_stiffness)
    if (kind_of(6) < 0.3_dp .and. motions > 0) then
      problem%prescribed = [(k == 1 + mod(int(seed), motions), k=1, motions)]
      allocate (problem%motion(motions))
      call values_between(seed, whole, -1, 1, problem%motion)
    end if
  end subroutine random_law_problem

  !> Values between two bounds, or whole numbers.
  subroutine values_between(seed, whole, low, high, values)
    integer(int64), intent(inout) :: seed
    logical, intent(in) :: whole
    integer, intent(in) :: low, high
    real(dp), intent(out) :: values(:)

    if (whole) then
      call integers(seed, low, high, values)
    else
      call draw(seed, values)
      values = real(low, dp) + real(high - low, dp)*values
    end if
  end subroutine values_between

  !> As values_between, but `other` with the probability `share`.
  subroutine some_values(seed, whole, low, high, share, other, number, values)
    integer(int64), intent(inout) :: seed
    logical, intent(in) :: whole
    integer, intent(in) :: low, high, number
    real(dp), intent(in) :: share, other
    real(dp), allocatable, intent(out) :: values(:)
    real(dp) :: choice(number)

    allocate (values(number))
    call values_between(seed, whole, low, high, values)
    call draw(seed, choice)
    where (choice < share) values = other
    where (choice > 0.95_dp) values = 0.0_dp
  end subroutine some_values

  !> Limits of the force of a point: of the lower stop, and of the upper one.
  pure function limits_of(problem, point) result(limits)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: point
    real(dp) :: limits(2)

    limits = infinity()
    if (allocated(problem%limit)) limits(1) = problem%limit(point)
    if (allocated(problem%limit_upper)) limits(2) = problem%limit_upper(point)
    if (is_excluded(problem, point)) limits = 0.0_dp
  end function limits_of

  !> alpha with the compliances on its diagonal.
  pure function with_compliance(alpha, problem) result(sum)
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    real(dp) :: sum(problem%points(), problem%points())
    integer :: k

    sum = alpha(:problem%points(), :)
    if (.not. allocated(problem%compliance)) return
    do k = 1, size(sum, 1)
      sum(k, k) = sum(k, k) + problem%compliance(k)
    end do
  end function with_compliance

  !> Stiffness of the springs on the motions, (m); 0 where prescribed.
  pure function stiffness_of(problem) result(stiffness)
    type(fuge_problem), intent(in) :: problem
    real(dp) :: stiffness(problem%mode_count())
    integer :: j

    stiffness = 0.0_dp
    if (allocated(problem%motion_stiffness)) stiffness = problem%motion_stiffness
    do j = 1, size(stiffness)
      if (is_prescribed(problem, j)) stiffness(j) = 0.0_dp
    end do
  end function stiffness_of

  !> Elastic energy of a solution.
  pure function energy_of(alpha, problem, solution) result(energy)
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    real(dp) :: energy
    real(dp) :: compliance(problem%points(), problem%points()), stiffness(problem%mode_count())

    compliance = with_compliance(alpha, problem)
    stiffness = stiffness_of(problem)
    energy = 0.5_dp*(dot_product(solution%force, matmul(compliance, solution%force)) &
                     + sum(stiffness*solution%motion**2))
  end function energy_of

  !> Try every combination of the five states. `answer` is that of the regular system whose violation is least, zero if
  !> there is none; `worst` is that violation; `all_regular`: no system was singular.
  pure subroutine enumerate_laws(alpha, problem, answer, worst, all_regular)
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(out) :: answer
    real(dp), intent(out) :: worst
    logical, intent(out) :: all_regular
    type(fuge_solution) :: tried
    integer :: state(problem%points()), code, rest, k
    real(dp) :: violation
    logical :: regular

    worst = huge(worst)
    answer%force = spread(0.0_dp, 1, problem%points())
    answer%gap = answer%force
    answer%motion = spread(0.0_dp, 1, problem%mode_count())
    all_regular = .true.
    do code = 0, 5**size(state) - 1
      rest = code
      do k = 1, size(state)
        state(k) = mod(rest, 5) - 2
        rest = rest/5
      end do
      if (.not. possible(problem, state)) cycle
      call try_states(alpha, problem, state, tried, regular)
      all_regular = all_regular .and. regular
      if (.not. regular) cycle
      violation = law_violation(alpha, problem, tried)
      if (violation >= worst) cycle
      worst = violation
      answer = tried
    end do
  end subroutine enumerate_laws

  !> Does the problem have these states? Excluded points are open, tied ones at a stop, where both are the same. Without
  !> an upper stop no point is there, without a limit none is limited.
  pure function possible(problem, state)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: state(:)
    logical :: possible
    real(dp) :: limits(2)
    integer :: k

    possible = .true.
    do k = 1, size(state)
      limits = limits_of(problem, k)
      select case (state(k))
      case (0)
        possible = possible .and. (is_excluded(problem, k) .or. play_of(problem, k) > 0.0_dp)
      case (1)
        possible = possible .and. .not. is_excluded(problem, k)
      case (2)
        possible = possible .and. limits(1) <= huge(1.0_dp) .and. .not. is_excluded(problem, k)
      case (-1)
        possible = possible .and. play_of(problem, k) <= huge(1.0_dp) .and. play_of(problem, k) > 0.0_dp &
                   .and. .not. is_excluded(problem, k)
      case (-2)
        possible = possible .and. play_of(problem, k) <= huge(1.0_dp) .and. limits(2) <= huge(1.0_dp) &
                   .and. .not. is_excluded(problem, k)
      end select
      if (.not. possible) return
    end do
  end function possible

  !> Forces, motions and gaps if each point has this state, unless the linear system is singular.
  pure subroutine try_states(alpha, problem, state, tried, regular)
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: state(:)
    type(fuge_solution), intent(inout) :: tried
    logical, intent(out) :: regular
    real(dp) :: system(size(state) + problem%mode_count(), size(state) + problem%mode_count())
    real(dp) :: right(size(system, 1)), x(size(system, 1)), modes(size(state), problem%mode_count())
    real(dp) :: compliance(size(state), size(state)), stiffness(problem%mode_count()), limits(2), datum
    integer :: j, k, n

    n = size(state)
    modes = modes_of(problem)
    compliance = with_compliance(alpha, problem)
    stiffness = stiffness_of(problem)
    ! Under a load, gaps count from that of a contact point: a small load is not lost in large gaps.
    datum = 0.0_dp
    k = findloc(state == 1, .true., dim=1)
    if (k > 0 .and. problem%is_plain()) datum = problem%gap(k)
    system = 0.0_dp
    right = 0.0_dp
    do k = 1, n
      limits = limits_of(problem, k)
      if (abs(state(k)) == 1) then
        system(k, :n) = compliance(k, :)
        system(k, n + 1:) = -modes(k, :)
        right(k) = datum - problem%gap(k)
        if (state(k) < 0) right(k) = right(k) + problem%gap_upper(k)
      else
        system(k, k) = 1.0_dp
        if (state(k) > 0) right(k) = limits(1)
        if (state(k) < 0) right(k) = -limits(2)
      end if
    end do
    do j = 1, size(stiffness)
      if (is_prescribed(problem, j)) then
        system(n + j, n + j) = 1.0_dp
        right(n + j) = problem%motion(j)
      else
        system(n + j, :n) = modes(:, j)
        system(n + j, n + j) = stiffness(j)
        right(n + j) = problem%resultant(j)
      end if
    end do
    call eliminate(system, right, x, regular)
    tried%force = x(:n)
    tried%motion = x(n + 1:) + datum
    tried%gap = problem%gap + matmul(compliance, tried%force) - matmul(modes, tried%motion)
    where (state == 1) tried%gap = 0.0_dp
    if (any(state == -1)) then
      where (state == -1) tried%gap = problem%gap_upper
    end if
  end subroutine try_states

  !> The largest residual of all equations and the largest distance from the law of a point, relative to one length and
  !> one force for all points.
  pure function law_violation(alpha, problem, solution) result(worst)
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    real(dp) :: worst
    real(dp) :: modes(problem%points(), problem%mode_count()), compliance(problem%points(), problem%points())
    real(dp) :: error(problem%points()), stiffness(problem%mode_count()), force, length
    integer :: j, k

    modes = modes_of(problem)
    compliance = with_compliance(alpha, problem)
    stiffness = stiffness_of(problem)
    error = problem%gap + matmul(compliance, solution%force) - matmul(modes, solution%motion) - solution%gap
    length = max(maxval(abs(problem%gap) + matmul(abs(compliance), abs(solution%force)) &
                        + matmul(abs(modes), abs(solution%motion))), tiny(length))
    force = max(maxval(abs(solution%force)), tiny(force))
    ! Without a load all forces may be rounding errors: compare with the force that displaces by 1e-4 of the lengths.
    if (maxval(abs(compliance)) > 0.0_dp .and. .not. has_load(problem)) then
      force = max(force, 1.0e-4_dp*length/maxval(abs(compliance)))
    end if
    worst = maxval(abs(error))/length
    do k = 1, size(error)
      worst = max(worst, distance_from_law(ratio(play_of(problem, k), length), ratio(limits_of(problem, k), force), &
                                           solution%force(k)/force, solution%gap(k)/length))
    end do
    do j = 1, size(stiffness)
      if (is_prescribed(problem, j)) then
        worst = max(worst, abs(solution%motion(j) - problem%motion(j)))
      else
        worst = max(worst, abs(sum(modes(:, j)*solution%force) + stiffness(j)*solution%motion(j) &
                               - problem%resultant(j)) &
                    /max(sum(abs(modes(:, j)*solution%force)), force*maxval(abs(modes(:, j))), &
                         abs(problem%resultant(j)), abs(stiffness(j)*solution%motion(j)), tiny(worst)))
      end if
    end do
  end function law_violation

  !> Is any component of the resultant not zero that points alone carry?
  pure function has_load(problem)
    type(fuge_problem), intent(in) :: problem
    logical :: has_load
    real(dp) :: stiffness(problem%mode_count())
    integer :: j

    has_load = .false.
    stiffness = stiffness_of(problem)
    do j = 1, size(stiffness)
      if (is_prescribed(problem, j) .or. stiffness(j) > 0.0_dp) cycle
      has_load = has_load .or. abs(problem%resultant(j)) > 0.0_dp
    end do
  end function has_load

  !> a/b, or huge where it would overflow.
  elemental function ratio(a, b)
    real(dp), intent(in) :: a, b
    real(dp) :: ratio

    ratio = huge(ratio)
    if (a < min(b, 1.0_dp)*huge(ratio)) ratio = a/b
  end function ratio

  !> The distance of a force and a gap, both scaled, from the five steps of their law.
  pure function distance_from_law(play, limits, force, gap) result(distance)
    real(dp), intent(in) :: play, limits(2), force, gap
    real(dp) :: distance

    distance = min(max(abs(gap), -force, force - limits(1)), max(abs(force), -gap, gap - play))
    if (limits(1) <= huge(1.0_dp)) distance = min(distance, max(abs(force - limits(1)), gap))
    if (play > huge(1.0_dp)) return
    distance = min(distance, max(abs(gap - play), force, -limits(2) - force))
    if (limits(2) <= huge(1.0_dp)) distance = min(distance, max(abs(force + limits(2)), play - gap))
  end function distance_from_law

end module law_reference
