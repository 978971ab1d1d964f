!> Answers to problems with laws of points in quadruple precision, and how far other answers may be from them.
module law_oracle
  use, intrinsic :: iso_fortran_env, only: qp => real128
  use fuge_kinds, only: dp
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use general_reference, only: is_prescribed, modes_of
  use interior_points, only: exchange, find_interior, largest_of, solve_consistent, NEGLIGIBLE
  use law_programs, only: box_program, compliance_of, gradient_of, is_definite, rank_of, set_equations, set_program, &
    violation_of, NONE
  implicit none
  private

  public :: find_bounds, force_error_of, refine_law, solve_law

  !> The answer to a problem.
  type, public :: law_answer
    !> Forces and gaps (n), motions (m).
    real(qp), allocatable :: force(:), gap(:), motion(:)
    !> How far it is from an answer, relative to the largest force.
    real(qp) :: violation = NONE
    !> Are A + D definite, and so the forces unique? Do points between their limits resist all motions; do those at the
    !> corner of their law, together with them?
    logical :: definite = .false., resists = .false., may_resist = .false.
    !> Do all forces together displace no more than rounding? `natural` (n) are then forces that displace by the data,
    !> otherwise 0.
    logical :: negligible = .false.
    real(dp), allocatable :: natural(:)
    type(box_program), private :: program
    !> At its lower bound -1, at the upper one 1, between 0.
    integer, allocatable, private :: at(:)
    !> Is it clearly between its bounds, is its law there or at a corner?
    logical, allocatable, private :: inside(:), touching(:)
  end type law_answer

  !> Bounds of the errors of forces and gaps (n) and of motions (m).
  type, public :: law_bounds
    real(dp), allocatable :: force(:), gap(:), motion(:)
  end type law_bounds

contains

  !> The answer to a problem whose resultants can be carried.
  pure subroutine solve_law(alpha, problem, answer)
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    type(law_answer), intent(out) :: answer
    real(qp), allocatable :: v(:), q(:)

    call set_program(alpha, problem, answer%program)
    answer%definite = is_definite(alpha, problem, answer%program)
    associate (program => answer%program)
      call find_interior(program, v, q, answer%at)
      call exchange(program, answer%at, v, q)
      answer%violation = violation_of(program, v, q)/largest_of(v)
      answer%negligible = .not. largest_of(v)*program%size > NEGLIGIBLE*program%size_of_data
      allocate (answer%natural(size(program%force_unit)))
      answer%natural = merge(real(program%size_of_data*program%force_unit, dp), 0.0_dp, answer%negligible)
      call count_resisting(program, v, q, answer)
    end associate
    call restore(alpha, problem, v, q, answer)
  end subroutine solve_law

  !> Forces (n) from the states of an answer on, of which the worst are exchanged one at a time. `found` unless the
  !> equations of the last states are singular, or their answer does not fulfil the law.
  pure subroutine refine_law(alpha, problem, start, force, found)
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: start
    real(qp), intent(out) :: force(:)
    logical, intent(out) :: found
    !> Forces and gaps of the wrong sign count beyond this fraction of the largest force.
    real(qp), parameter :: EXACT = 1.0e-20_qp
    type(law_answer) :: answer
    real(qp), allocatable :: v(:), q(:), matrix(:, :), right(:)
    integer :: k, rank

    call set_program(alpha, problem, answer%program)
    associate (program => answer%program)
      v = program%sign*real(start%force(program%point), qp)/(program%force_unit(program%point)*program%size)
      v = min(max(v, program%low), program%high)
      answer%at = merge(-1, merge(1, 0, v >= program%high), v <= program%low)
      q = spread(0.0_qp, 1, program%motions())
      call exchange(program, answer%at, v, q)
      call set_equations(program, pack([(k, k=1, size(v))], answer%at == 0), matrix)
      right = spread(0.0_qp, 1, size(matrix, 1))
      call solve_consistent(matrix, right, rank)
      found = rank == size(right) .and. violation_of(program, v, q) <= EXACT*largest_of(v)
    end associate
    call restore(alpha, problem, v, q, answer)
    force = answer%force
  end subroutine refine_law

  !> The largest error of a force of `solution`, relative to the largest force; negative if there is no unique answer
  !> that can be found from its states.
  pure function force_error_of(alpha, problem, solution) result(error)
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    real(dp) :: error
    real(qp) :: force(size(solution%force))
    logical :: found

    call refine_law(alpha, problem, solution, force, found)
    error = -1.0_dp
    if (.not. found) return
    error = 0.0_dp
    if (maxval(abs(force)) > 0.0_qp) error = real(maxval(abs(solution%force - force))/maxval(abs(force)), dp)
  end function force_error_of

  !> Do points between their limits resist all motions without springs, and together with those at a corner of their
  !> law?
  pure subroutine count_resisting(program, v, q, answer)
    type(box_program), intent(in) :: program
    real(qp), intent(in) :: v(:), q(:)
    type(law_answer), intent(inout) :: answer
    !> Forces and gaps below this fraction of the data count as none.
    real(qp), parameter :: NEARLY = 1.0e-9_qp
    answer%inside = min(v - program%low, program%high - v) > NEARLY
    answer%touching = answer%inside .or. abs(gradient_of(program, v, q)) <= NEARLY
    answer%resists = rank_of(program, answer%inside) == program%motions()
    answer%may_resist = rank_of(program, answer%touching) == program%motions()
  end subroutine count_resisting

  !> Forces, gaps and motions in the units of the problem.
  pure subroutine restore(alpha, problem, v, q, answer)
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    real(qp), intent(in) :: v(:), q(:)
    type(law_answer), intent(inout) :: answer
    real(qp) :: modes(problem%points(), problem%mode_count())
    integer :: j, k

    associate (program => answer%program)
      allocate (answer%force(problem%points()), answer%motion(problem%mode_count()))
      answer%force = 0.0_qp
      do k = 1, size(v)
        answer%force(program%point(k)) = answer%force(program%point(k)) &
                                         + program%sign(k)*v(k)*program%size*program%force_unit(program%point(k))
      end do
      do j = 1, size(answer%motion)
        if (is_prescribed(problem, j)) answer%motion(j) = real(problem%motion(j), qp)
      end do
      answer%motion(program%free) = q*program%size*program%motion_unit
    end associate
    modes = real(modes_of(problem), qp)
    answer%gap = real(problem%gap, qp) + matmul(compliance_of(alpha, problem), answer%force) &
                 - matmul(modes, answer%motion)
  end subroutine restore

  !> How far forces and gaps (n) and motions (m) may be off if each equation is off by this fraction of its terms: in
  !> the states of the answer, in these `states`, which another answer found, and where laws at a corner have any state.
  pure subroutine find_bounds(alpha, problem, answer, fraction, states, bounds)
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    type(law_answer), intent(in) :: answer
    real(dp), intent(in) :: fraction
    integer, intent(in) :: states(:)
    type(law_bounds), intent(out) :: bounds
    logical :: between(answer%program%variables())
    integer :: k

    call bound_between(alpha, problem, answer, answer%at == 0, fraction, bounds)
    between = [(is_between(answer%program, k, states), k=1, size(between))]
    call bound_between(alpha, problem, answer, between, fraction, bounds)
    call bound_between(alpha, problem, answer, answer%inside, fraction, bounds)
    call bound_between(alpha, problem, answer, answer%touching, fraction, bounds)
  end subroutine find_bounds

  !> Is variable `k` between its bounds if the points have these states?
  pure function is_between(program, k, states) result(between)
    type(box_program), intent(in) :: program
    integer, intent(in) :: k, states(:)
    logical :: between

    associate (state => states(program%point(k)))
      between = abs(state) == 1
      if (.not. program%low(k) < 0.0_qp) between = between .and. state == nint(program%sign(k))
    end associate
  end function is_between

  !> Raise the bounds to those if the variables `are_between` are between their bounds.
  pure subroutine bound_between(alpha, problem, answer, are_between, fraction, bounds)
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    type(law_answer), intent(in) :: answer
    logical, intent(in) :: are_between(:)
    real(dp), intent(in) :: fraction
    type(law_bounds), intent(inout) :: bounds
    ! Below this fraction of the data even quadruple precision knows nothing.
    real(qp), parameter :: FINEST = 1.0e-20_qp
    real(qp) :: error(count(are_between) + answer%program%motions()), off(size(error))
    real(qp) :: column(size(off)), modes(problem%points(), problem%mode_count()), moved(problem%mode_count())
    real(qp) :: compliance(problem%points(), problem%points()), terms(problem%points()), carried(problem%points())
    real(qp), allocatable :: matrix(:, :)
    integer :: between(count(are_between)), j, k, nb

    nb = size(between)
    between = pack([(k, k=1, size(are_between))], are_between)
    modes = abs(real(modes_of(problem), qp))
    compliance = abs(compliance_of(alpha, problem))
    carried = abs(answer%force)
    moved = abs(answer%motion)
    terms = abs(real(problem%gap, qp)) + matmul(compliance, carried) + matmul(modes, moved)
    associate (program => answer%program)
      error(:nb) = [(terms(program%point(between(k)))*program%force_unit(program%point(between(k))), k=1, nb)]
      do j = 1, program%motions()
        error(nb + j) = (abs(real(problem%resultant(program%free(j)), qp)) + sum(modes(:, program%free(j))*carried)) &
                        *program%motion_unit(j) + program%stiffness(j)*moved(program%free(j))/program%motion_unit(j)
      end do
      off = 0.0_qp
      do j = 1, size(off)
        column = 0.0_qp
        column(j) = error(j)
        call set_equations(program, between, matrix)
        call solve_consistent(matrix, column)
        off = off + abs(column)
      end do
      off = fraction*off
      carried = fraction*carried + FINEST*program%size_of_data*program%force_unit
      do k = 1, nb
        associate (point => program%point(between(k)))
          carried(point) = carried(point) + off(k)*program%force_unit(point)
        end associate
      end do
      moved = fraction*moved
      moved(program%free) = (off(nb + 1:) + FINEST*program%size_of_data)*program%motion_unit
    end associate
    terms = fraction*terms + matmul(compliance, carried) + matmul(modes, moved)
    if (.not. allocated(bounds%force)) then
      allocate (bounds%force(size(carried)), bounds%gap(size(carried)), bounds%motion(size(moved)))
      bounds%force = 0.0_dp
      bounds%gap = 0.0_dp
      bounds%motion = 0.0_dp
    end if
    bounds%force = max(bounds%force, real(carried, dp))
    bounds%gap = max(bounds%gap, real(terms, dp))
    bounds%motion = max(bounds%motion, real(moved, dp))
  end subroutine bound_between

end module law_oracle
