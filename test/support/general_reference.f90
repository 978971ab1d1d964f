!> What contact problems are tested against: the equations of every combination of states, solved one by one, and the
!> residuals of an answer. Of the library only the types are used, and the solver where a test needs its answer.
module general_reference
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_positive_inf
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_kinds, only: dp
  use fuge_matrix_operator, only: fuge_dense_operator
  use fuge_options_type, only: fuge_options
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_solver_type, only: fuge_solver
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: draw, integers, solve_general, solve_with, enumerate_states, solve_states, general_violation, eliminate, infinity
  public :: play_of, is_excluded, is_prescribed, modes_of

  !> A pivot below this fraction of the largest entry means that the system is singular.
  real(dp), parameter :: SINGULAR = 1.0e-10_dp

contains

  !> Random numbers, 0 < value < 1, of the minimal standard generator: the same with every compiler.
  pure subroutine draw(seed, values)
    integer(int64), intent(inout) :: seed
    real(dp), intent(out) :: values(:)
    integer :: k

    do k = 1, size(values)
      seed = mod(16807_int64*seed, 2147483647_int64)
      values(k) = real(seed, dp)/2147483647.0_dp
    end do
  end subroutine draw

  !> Random whole numbers from `low` to `high`.
  pure subroutine integers(seed, low, high, values)
    integer(int64), intent(inout) :: seed
    integer, intent(in) :: low, high
    real(dp), intent(out) :: values(:)

    call draw(seed, values)
    values = real(low, dp) + aint(values*real(high - low + 1, dp))
  end subroutine integers

  pure function infinity()
    real(dp) :: infinity

    infinity = ieee_value(infinity, ieee_positive_inf)
  end function infinity

  !> Solve with a new solver.
  subroutine solve_general(alpha, problem, solution, info, options)
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(out) :: solution
    type(fuge_info), intent(out) :: info
    type(fuge_options), intent(in), optional :: options
    type(fuge_solver) :: solver

    call solve_with(solver, alpha, problem, solution, info, options)
  end subroutine solve_general

  !> Solve with a solver that may have solved other problems before.
  subroutine solve_with(solver, alpha, problem, solution, info, options)
    type(fuge_solver), intent(inout) :: solver
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(out) :: solution
    type(fuge_info), intent(out) :: info
    type(fuge_options), intent(in), optional :: options
    type(fuge_dense_operator) :: operator
    real(dp), allocatable, target :: matrix(:, :)

    ! The operator points to the matrix.
    allocate (matrix, source=alpha)
    call operator%set(matrix, info)
    if (info%failed()) return
    call solver%solve(operator, problem, solution, info, options)
  end subroutine solve_with

  !> The distance between the two stops of a point, infinite where it is one-sided.
  pure function play_of(problem, point) result(play)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: point
    real(dp) :: play

    play = infinity()
    if (allocated(problem%gap_upper)) play = problem%gap_upper(point)
  end function play_of

  pure function is_excluded(problem, point) result(excluded)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: point
    logical :: excluded

    excluded = .false.
    if (allocated(problem%excluded)) excluded = problem%excluded(point)
  end function is_excluded

  pure function is_prescribed(problem, mode) result(prescribed)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: mode
    logical :: prescribed

    prescribed = .false.
    if (allocated(problem%prescribed)) prescribed = problem%prescribed(mode)
  end function is_prescribed

  !> The modes R, (n, m).
  pure function modes_of(problem) result(modes)
    type(fuge_problem), intent(in) :: problem
    real(dp) :: modes(problem%points(), problem%mode_count())

    modes = 1.0_dp
    if (allocated(problem%modes)) modes = problem%modes
  end function modes_of

  !> Try every combination of states: each point open, at its lower or at its upper stop. `answer` is that of the
  !> regular system whose largest relative violation is least, zero if there is none; `worst` is that violation;
  !> `all_regular`: no system was singular.
  pure subroutine enumerate_states(alpha, problem, answer, worst, all_regular)
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
    do code = 0, 3**size(state) - 1
      rest = code
      do k = 1, size(state)
        state(k) = mod(rest, 3) - 1
        rest = rest/3
      end do
      if (.not. possible(problem, state)) cycle
      call solve_states(alpha, problem, state, tried, regular)
      all_regular = all_regular .and. regular
      if (.not. regular) cycle
      violation = general_violation(alpha, problem, tried)
      if (violation >= worst) cycle
      worst = violation
      answer = tried
    end do
  end subroutine enumerate_states

  !> Does the problem allow these states: excluded points are open, tied points at the lower stop, one-sided points
  !> have no upper stop?
  pure function possible(problem, state)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: state(:)
    logical :: possible
    integer :: k

    possible = .true.
    do k = 1, size(state)
      if (is_excluded(problem, k)) then
        possible = possible .and. state(k) == 0
      else if (.not. play_of(problem, k) > 0.0_dp) then
        possible = possible .and. state(k) == 1
      else if (play_of(problem, k) > huge(1.0_dp)) then
        possible = possible .and. state(k) >= 0
      end if
    end do
  end function possible

  !> Forces, motions and gaps if each point has this state, unless the linear system is singular.
  pure subroutine solve_states(alpha, problem, state, tried, regular)
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: state(:)
    type(fuge_solution), intent(inout) :: tried
    logical, intent(out) :: regular
    real(dp) :: system(size(state) + problem%mode_count(), size(state) + problem%mode_count())
    real(dp) :: right(size(system, 1)), x(size(system, 1)), modes(size(state), problem%mode_count()), datum
    integer :: j, k, n, m

    n = size(state)
    m = problem%mode_count()
    modes = modes_of(problem)
    ! Under a load, gaps count from that of a contact point: a small load is not lost in large gaps.
    datum = 0.0_dp
    k = findloc(state > 0, .true., dim=1)
    if (k > 0 .and. .not. (allocated(problem%modes) .or. allocated(problem%prescribed))) datum = problem%gap(k)
    system = 0.0_dp
    right = 0.0_dp
    do k = 1, n
      if (state(k) == 0) then
        system(k, k) = 1.0_dp
      else
        system(k, :n) = alpha(k, :n)
        system(k, n + 1:) = -modes(k, :)
        right(k) = datum - problem%gap(k)
        if (state(k) < 0) right(k) = right(k) + problem%gap_upper(k)
      end if
    end do
    do j = 1, m
      if (is_prescribed(problem, j)) then
        system(n + j, n + j) = 1.0_dp
        right(n + j) = problem%motion(j)
      else
        system(n + j, :n) = modes(:, j)
        right(n + j) = problem%resultant(j)
      end if
    end do
    call eliminate(system, right, x, regular)
    tried%force = x(:n)
    tried%motion = x(n + 1:) + datum
    tried%gap = problem%gap + matmul(alpha(:n, :n), tried%force) - matmul(modes, tried%motion)
    where (state > 0) tried%gap = 0.0_dp
    if (any(state < 0)) then
      where (state < 0) tried%gap = problem%gap_upper
    end if
  end subroutine solve_states

  !> Solve by Gauss-Jordan elimination with row interchanges; x is zero if the matrix is not `regular`.
  pure subroutine eliminate(matrix, right, x, regular)
    real(dp), intent(in) :: matrix(:, :), right(:)
    real(dp), intent(out) :: x(:)
    logical, intent(out) :: regular
    real(dp) :: work(size(right), size(right) + 1), row(size(right) + 1), largest
    integer :: i, k, p, n

    n = size(right)
    work(:, :n) = matrix
    work(:, n + 1) = right
    largest = maxval(abs(matrix))
    x = 0.0_dp
    do k = 1, n
      p = k - 1 + maxloc(abs(work(k:, k)), dim=1)
      regular = abs(work(p, k)) > SINGULAR*largest
      if (.not. regular) return
      row = work(p, :)
      work(p, :) = work(k, :)
      work(k, :) = row/row(k)
      do i = 1, n
        if (i /= k) work(i, :) = work(i, :) - work(i, k)*work(k, :)
      end do
    end do
    x = work(:, n + 1)
    regular = .true.
  end subroutine eliminate

  !> Is any component of the resultant that acts not zero?
  pure function has_load(problem)
    type(fuge_problem), intent(in) :: problem
    logical :: has_load
    integer :: j

    has_load = .false.
    do j = 1, problem%mode_count()
      if (.not. is_prescribed(problem, j)) has_load = has_load .or. abs(problem%resultant(j)) > 0.0_dp
    end do
  end function has_load

  !> The largest residual of all equations and inequalities, relative to one length and one force for all points.
  pure function general_violation(alpha, problem, solution) result(worst)
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    real(dp) :: worst
    real(dp) :: modes(problem%points(), problem%mode_count()), error(problem%points()), length, largest, play
    integer :: j, k, n

    n = problem%points()
    modes = modes_of(problem)
    error = problem%gap + matmul(alpha(:n, :n), solution%force) - matmul(modes, solution%motion) - solution%gap
    length = maxval(abs(problem%gap) + matmul(abs(alpha(:n, :n)), abs(solution%force)) &
                    + matmul(abs(modes), abs(solution%motion)))
    length = max(length, tiny(length))
    largest = max(maxval(abs(solution%force)), tiny(largest))
    ! Without a load all forces may be rounding errors: compare with the force that displaces by 1e-4 of the lengths.
    if (.not. has_load(problem)) largest = max(largest, 1.0e-4_dp*length/maxval(abs(alpha)))
    worst = maxval(abs(error))/length
    do k = 1, n
      play = play_of(problem, k)
      associate (f => solution%force(k), c => solution%gap(k))
        if (is_excluded(problem, k)) then
          worst = max(worst, abs(f)/largest)
        else
          worst = max(worst, -c/length)
          if (play > huge(play)) then
            worst = max(worst, -f/largest, min(abs(f)/largest, abs(c)/length))
          else
            worst = max(worst, (c - play)/length)
            ! Compressive at the lower stop, tensile at the upper one.
            if (f > 0.0_dp) worst = max(worst, min(f/largest, abs(c)/length))
            if (f < 0.0_dp) worst = max(worst, min(-f/largest, abs(c - play)/length))
          end if
        end if
      end associate
    end do
    do j = 1, problem%mode_count()
      if (is_prescribed(problem, j)) then
        worst = max(worst, abs(solution%motion(j) - problem%motion(j)))
      else
        worst = max(worst, abs(sum(modes(:, j)*solution%force) - problem%resultant(j)) &
                    /max(sum(abs(modes(:, j)*solution%force)), largest*maxval(abs(modes(:, j))), &
                         abs(problem%resultant(j)), tiny(worst)))
      end if
    end do
  end function general_violation

end module general_reference
