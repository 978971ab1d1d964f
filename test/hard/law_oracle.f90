!> Problems with laws of points solved in quadruple precision, as quadratic programs in a box, by a primal-dual interior
!> point method (S. Mehrotra, SIAM Journal on Optimization 2, 1992). Of the library only the types are used.
!>
!> Where a point has play, its force is the difference of two variables, those of its stops, and where it is tied, one
!> variable of either sign. Whether there is an answer is decided before, from the extreme motions of what the limits
!> carry. The states that the interior point tells are solved for once more, so that the answer is exact but for the
!> rounding of quadruple precision.
module law_oracle
  use, intrinsic :: iso_fortran_env, only: qp => real128
  use fuge, only: dp => fuge_dp, fuge_problem
  use general_reference, only: is_excluded, is_prescribed, modes_of, play_of
  implicit none
  private

  public :: carried_margin, find_bounds, has_independent_modes, solve_law

  !> Stands for infinity in limits and plays.
  real(qp), parameter :: NONE = 1.0e4000_qp
  !> Of an interior point: products of variables and their multipliers at the end, what is left of the equations, and
  !> most steps.
  real(qp), parameter :: LEAST_PRODUCT = 1.0e-33_qp, LEAST_REST = 1.0e-28_qp
  integer, parameter :: MOST_STEPS = 400
  !> Violations below this fraction of the largest force are rounding.
  real(qp), parameter :: ROUNDING = 1.0e-24_qp
  !> Forces of this size displace no more than rounding.
  real(qp), parameter :: NEGLIGIBLE = 1.0e-12_qp
  !> Fraction of the way to the nearest bound.
  real(qp), parameter :: OF_THE_WAY = 0.995_qp
  !> Pivots below this fraction of the largest entry are rounding.
  real(qp), parameter :: SINGULAR = 1.0e-24_qp
  !> Products of a row of modes and a direction count as zero below this fraction of their terms.
  real(qp), parameter :: ORTHOGONAL = 1.0e-28_qp

  !> A problem in its variables: minimise v.Hv/2 + cost.v with low <= v <= high and B v + S q = w. Forces are
  !> sign*v at their points, in units in which the diagonal of A + D is 1.
  type :: box_program
    integer, allocatable :: point(:)
    real(qp), allocatable :: sign(:), low(:), high(:), cost(:), hessian(:, :), rows(:, :), stiffness(:), resultant(:)
    !> Units: force at a point, motion in a mode, and all of them together.
    real(qp), allocatable :: force_unit(:), motion_unit(:)
    real(qp) :: size = 1.0_qp
    !> The same of gaps and prescribed motions by themselves.
    real(qp) :: size_of_data = 1.0_qp
    integer, allocatable :: free(:)
  contains
    procedure :: variables
    procedure :: motions
  end type box_program

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

  pure integer function variables(self)
    class(box_program), intent(in) :: self

    variables = size(self%point)
  end function variables

  pure integer function motions(self)
    class(box_program), intent(in) :: self

    motions = size(self%free)
  end function motions

  !> Limits of the force of a point, at the lower stop and at the upper one; infinity is NONE.
  pure function limits_of(problem, point) result(limits)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: point
    real(qp) :: limits(2)

    limits = NONE
    if (allocated(problem%limit)) then
      if (problem%limit(point) <= huge(1.0_dp)) limits(1) = real(problem%limit(point), qp)
    end if
    if (allocated(problem%limit_upper)) then
      if (problem%limit_upper(point) <= huge(1.0_dp)) limits(2) = real(problem%limit_upper(point), qp)
    end if
    if (play_of(problem, point) > huge(1.0_dp)) limits(2) = 0.0_qp
    if (is_excluded(problem, point)) limits = 0.0_qp
  end function limits_of

  !> The free modes, and the stiffness of their springs.
  pure subroutine list_motions(problem, free, stiffness)
    type(fuge_problem), intent(in) :: problem
    integer, allocatable, intent(out) :: free(:)
    real(qp), allocatable, intent(out) :: stiffness(:)
    integer :: j

    free = pack([(j, j=1, problem%mode_count())], [(.not. is_prescribed(problem, j), j=1, problem%mode_count())])
    allocate (stiffness(size(free)))
    stiffness = 0.0_qp
    if (allocated(problem%motion_stiffness)) stiffness = real(problem%motion_stiffness(free), qp)
  end subroutine list_motions

  !> How far the resultants are within what the limits carry, relative to its size: of all motions without springs the
  !> least work of the limits less that of the resultants, over both. Negative: no forces carry them; 0: only those at
  !> their limits. The motions that decide are orthogonal to all but one of the rows of modes or of the unit vectors.
  pure function carried_margin(problem) result(margin)
    type(fuge_problem), intent(in) :: problem
    real(qp) :: margin
    real(qp), allocatable :: direction(:, :), modes(:, :), stiffness(:)
    real(qp) :: motion(3)
    integer, allocatable :: free(:)
    integer :: i, j, m, n

    margin = 1.0_qp
    call list_motions(problem, free, stiffness)
    free = pack(free, .not. stiffness > 0.0_qp)
    m = size(free)
    if (m < 1) return
    n = problem%points()
    allocate (modes(n, m), direction(n + m, m))
    modes = real(modes_of_free(problem, free), qp)
    direction = 0.0_qp
    do j = 1, m
      if (maxval(abs(modes(:, j))) > 0.0_qp) modes(:, j) = modes(:, j)/unit_of(modes(:, j))
      direction(:n, j) = modes(:, j)
      direction(n + j, j) = 1.0_qp
    end do
    do i = 1, n + m
      do j = 1, n + m
        motion = 0.0_qp
        select case (m)
        case (1)
          motion(1) = 1.0_qp
        case (2)
          motion(:2) = [-direction(i, 2), direction(i, 1)]
        case default
          motion = cross(direction(i, :), direction(j, :))
        end select
        margin = min(margin, work_margin(problem, free, modes, motion(:m)), &
                     work_margin(problem, free, modes, -motion(:m)))
        if (m < 3) exit
      end do
    end do
  end function carried_margin

  pure function modes_of_free(problem, free) result(modes)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: free(:)
    real(dp) :: modes(problem%points(), size(free)), all_modes(problem%points(), problem%mode_count())

    all_modes = modes_of(problem)
    modes = all_modes(:, free)
  end function modes_of_free

  !> The power of two at the largest of these values.
  pure function unit_of(values) result(unit)
    real(qp), intent(in) :: values(:)
    real(qp) :: unit

    unit = scale(1.0_qp, exponent(maxval(abs(values))))
  end function unit_of

  pure function cross(a, b) result(product)
    real(qp), intent(in) :: a(:), b(:)
    real(qp) :: product(3)

    product = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
  end function cross

  !> Work of the forces at their limits less that of the resultants, over both; 1 where a force without a limit works,
  !> or nothing does. `modes` are in units of their own.
  pure function work_margin(problem, free, modes, motion) result(margin)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: free(:)
    real(qp), intent(in) :: modes(:, :), motion(:)
    real(qp) :: margin
    real(qp) :: column(problem%points(), size(free)), limits(2), closing, terms, work, of_resultants
    integer :: j, k

    margin = 1.0_qp
    if (.not. maxval(abs(motion)) > 0.0_qp) return
    work = 0.0_qp
    terms = 0.0_qp
    do k = 1, size(modes, 1)
      closing = sum(modes(k, :)*motion)
      if (abs(closing) <= ORTHOGONAL*sum(abs(modes(k, :)*motion))) cycle
      limits = limits_of(problem, k)
      limits(1) = merge(limits(1), limits(2), closing > 0.0_qp)
      if (limits(1) >= NONE) return
      work = work + limits(1)*abs(closing)
    end do
    column = real(modes_of_free(problem, free), qp)
    of_resultants = 0.0_qp
    do j = 1, size(free)
      if (.not. maxval(abs(column(:, j))) > 0.0_qp) column(1, j) = 1.0_qp
      associate (part => motion(j)*real(problem%resultant(free(j)), qp)/unit_of(column(:, j)))
        of_resultants = of_resultants + part
        terms = terms + abs(part)
      end associate
    end do
    terms = terms + work
    if (terms > 0.0_qp) margin = (work - of_resultants)/terms
  end function work_margin

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

  !> The variables of a problem, and the units of its points and modes.
  pure subroutine set_program(alpha, problem, program)
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    type(box_program), intent(out) :: program
    real(qp), allocatable :: compliance(:, :), gap(:), modes(:, :)
    real(qp) :: limits(2), play, moved(problem%points())
    integer :: k, n

    n = problem%points()
    call list_motions(problem, program%free, program%stiffness)
    allocate (compliance(n, n), gap(n), modes(n, program%motions()))
    compliance = compliance_of(alpha, problem)
    gap = gap_of(problem)
    modes = real(modes_of_free(problem, program%free), qp)
    call choose_units(compliance, modes, program)
    allocate (program%resultant(program%motions()), program%point(0), program%sign(0), program%low(0), &
              program%high(0), program%cost(0))
    program%resultant = 0.0_qp
    if (program%motions() > 0) program%resultant = real(problem%resultant(program%free), qp)*program%motion_unit
    program%stiffness = program%stiffness*program%motion_unit**2
    gap = gap*program%force_unit
    do k = 1, n
      modes(k, :) = modes(k, :)*program%force_unit(k)*program%motion_unit
      compliance(k, :) = compliance(k, :)*program%force_unit(k)*program%force_unit
    end do
    program%size = max(maxval(abs(gap)), maxval([0.0_qp, abs(program%resultant)]))
    if (.not. program%size > 0.0_qp) program%size = 1.0_qp
    moved = 0.0_qp
    if (allocated(problem%prescribed)) moved = matmul(abs(real(modes_of(problem), qp)), &
                                                      abs(real(problem%prescribed_motion(), qp)))
    program%size_of_data = max(program%size, maxval((abs(real(problem%gap, qp)) + moved)*program%force_unit))
    program%resultant = program%resultant/program%size
    do k = 1, n
      limits = limits_of(problem, k)
      where (limits < NONE) limits = limits/(program%force_unit(k)*program%size)
      play = NONE
      if (play_of(problem, k) <= huge(1.0_dp)) play = real(play_of(problem, k), qp)*program%force_unit(k)
      if (.not. play > 0.0_qp) then
        call add_variable(k, 1.0_qp, -limits(2), limits(1), gap(k)/program%size, program)
      else
        call add_variable(k, 1.0_qp, 0.0_qp, limits(1), gap(k)/program%size, program)
        if (play < NONE) call add_variable(k, -1.0_qp, 0.0_qp, limits(2), (play - gap(k))/program%size, program)
      end if
    end do
    program%hessian = compliance(program%point, program%point)
    program%rows = transpose(modes(program%point, :))
    do k = 1, program%variables()
      program%hessian(:, k) = program%sign*program%hessian(:, k)*program%sign(k)
      program%rows(:, k) = program%rows(:, k)*program%sign(k)
    end do
  end subroutine set_program

  !> A variable more, unless its bounds are one.
  pure subroutine add_variable(point, sign, low, high, cost, program)
    integer, intent(in) :: point
    real(qp), intent(in) :: sign, low, high, cost
    type(box_program), intent(inout) :: program

    if (.not. high > low) return
    program%point = [program%point, point]
    program%sign = [program%sign, sign]
    program%low = [program%low, low]
    program%high = [program%high, high]
    program%cost = [program%cost, cost]
  end subroutine add_variable

  !> A + D.
  pure function compliance_of(alpha, problem) result(compliance)
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    real(qp) :: compliance(problem%points(), problem%points())
    integer :: k

    compliance = real(alpha, qp)
    if (.not. allocated(problem%compliance)) return
    do k = 1, size(compliance, 1)
      compliance(k, k) = compliance(k, k) + real(problem%compliance(k), qp)
    end do
  end function compliance_of

  !> Initial gaps less the prescribed motions.
  pure function gap_of(problem) result(gap)
    type(fuge_problem), intent(in) :: problem
    real(qp) :: gap(problem%points())
    real(dp) :: modes(problem%points(), problem%mode_count())
    integer :: j

    modes = modes_of(problem)
    gap = real(problem%gap, qp)
    do j = 1, problem%mode_count()
      if (is_prescribed(problem, j)) gap = gap - real(modes(:, j), qp)*real(problem%motion(j), qp)
    end do
  end function gap_of

  !> Units in which the diagonal of A + D is 1, and the largest coefficient of each mode.
  pure subroutine choose_units(compliance, modes, program)
    real(qp), intent(in) :: compliance(:, :), modes(:, :)
    type(box_program), intent(inout) :: program
    real(qp) :: largest
    integer :: j, k

    allocate (program%force_unit(size(compliance, 1)), program%motion_unit(size(modes, 2)))
    largest = maxval([(compliance(k, k), k=1, size(compliance, 1))])
    if (.not. largest > 0.0_qp) largest = 1.0_qp
    do k = 1, size(compliance, 1)
      program%force_unit(k) = 1.0_qp/sqrt(merge(compliance(k, k), largest, compliance(k, k) > 0.0_qp))
    end do
    do j = 1, size(modes, 2)
      largest = maxval(abs(modes(:, j)*program%force_unit))
      if (.not. largest > 0.0_qp) largest = 1.0_qp
      program%motion_unit(j) = 1.0_qp/largest
    end do
  end subroutine choose_units

  !> Have the forces of all points that can have one a unique answer?
  pure function is_definite(alpha, problem, program) result(definite)
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    type(box_program), intent(in) :: program
    logical :: definite
    real(qp) :: matrix(problem%points(), problem%points())
    integer :: j, k, n
    logical :: carries(problem%points())

    n = problem%points()
    matrix = compliance_of(alpha, problem)
    carries = [(any(program%point == k), k=1, n)]
    do k = 1, n
      matrix(k, :) = matrix(k, :)*program%force_unit(k)*program%force_unit
    end do
    definite = .true.
    do k = 1, n
      if (.not. carries(k)) cycle
      definite = definite .and. matrix(k, k) > SINGULAR
      if (.not. definite) return
      do j = k + 1, n
        if (carries(j)) matrix(k + 1:, j) = matrix(k + 1:, j) - matrix(k + 1:, k)*(matrix(k, j)/matrix(k, k))
      end do
    end do
  end function is_definite

  !> Derivative of the energy in each variable.
  pure function gradient_of(program, v, q) result(gradient)
    type(box_program), intent(in) :: program
    real(qp), intent(in) :: v(:), q(:)
    real(qp) :: gradient(size(v))

    gradient = matmul(program%hessian, v) + program%cost - matmul(q, program%rows)
  end function gradient_of

  !> The distance of an answer from the projection of its step along the gradient, and the resultant left.
  pure function violation_of(program, v, q) result(violation)
    type(box_program), intent(in) :: program
    real(qp), intent(in) :: v(:), q(:)
    real(qp) :: violation
    real(qp) :: gradient(size(v)), left(size(q))

    gradient = gradient_of(program, v, q)
    left = program%resultant - program%stiffness*q - matmul(program%rows, v)
    gradient = v - min(max(v - gradient, program%low), program%high)
    violation = maxval([0.0_qp, abs(gradient)]) + maxval([0.0_qp, abs(left)])
  end function violation_of

  !> `v` between the bounds, the motions, and the bound at which each variable is, -1 or 1, or 0.
  pure subroutine find_interior(program, v, q, at)
    type(box_program), intent(in) :: program
    real(qp), allocatable, intent(out) :: v(:), q(:)
    integer, allocatable, intent(out) :: at(:)
    real(qp), dimension(program%variables()) :: below, above, low, high, step, low_step, high_step, rest
    real(qp) :: matrix(program%variables() + program%motions(), program%variables() + program%motions())
    real(qp) :: left(program%motions()), motion_step(program%motions()), product, target, way
    integer :: bounds, k, nv, order(size(matrix, 1))

    nv = program%variables()
    v = min(max(program%low + 1.0_qp, -1.0_qp), program%high)
    where (program%low > -NONE .and. program%high < NONE) &
      v = program%low + min(1.0_qp, 0.5_qp*(program%high - program%low))
    where (.not. program%low > -NONE .and. program%high < NONE) v = program%high - 1.0_qp
    where (.not. program%low > -NONE .and. .not. program%high < NONE) v = 0.0_qp
    low = merge(1.0_qp, 0.0_qp, program%low > -NONE)
    high = merge(1.0_qp, 0.0_qp, program%high < NONE)
    bounds = count(low > 0.0_qp) + count(high > 0.0_qp)
    allocate (q(program%motions()))
    q = 0.0_qp
    below = merge(v - program%low, 1.0_qp, program%low > -NONE)
    above = merge(program%high - v, 1.0_qp, program%high < NONE)
    do k = 1, MOST_STEPS
      rest = -(gradient_of(program, v, q) - low + high)
      left = program%resultant - program%stiffness*q - matmul(program%rows, v)
      product = (sum(low*below) + sum(high*above))/max(bounds, 1)
      if (product <= LEAST_PRODUCT .and. maxval([0.0_qp, abs(rest), abs(left)]) <= LEAST_REST) exit
      ! Smaller ones would spoil the matrix.
      if (product <= LEAST_PRODUCT**1.5_qp .and. bounds > 0) exit
      call set_matrix(program, low/below + high/above, matrix)
      call factor(matrix, order)
      ! The step towards products of zero, then one towards smaller ones, with the second order of the first one.
      call solve_step(matrix, order, rest - low + high, left, step, motion_step)
      low_step = -low - low/below*step
      high_step = -high + high/above*step
      way = longest_way(below, above, low, high, step, low_step, high_step)
      target = sum((low + way*low_step)*(below + way*step)) + sum((high + way*high_step)*(above - way*step))
      target = product*(target/max(bounds, 1)/max(product, tiny(product)))**3
      where (low > 0.0_qp) low_step = (target - step*low_step)/below
      where (high > 0.0_qp) high_step = (target + step*high_step)/above
      where (.not. low > 0.0_qp) low_step = 0.0_qp
      where (.not. high > 0.0_qp) high_step = 0.0_qp
      call solve_step(matrix, order, rest - low + high + low_step - high_step, left, step, motion_step)
      low_step = low_step - low - low/below*step
      high_step = high_step - high + high/above*step
      way = OF_THE_WAY*longest_way(below, above, low, high, step, low_step, high_step)
      v = v + way*step
      ! Not by a difference, which rounding could make zero.
      where (program%low > -NONE) below = below + way*step
      where (program%high < NONE) above = above - way*step
      low = low + way*low_step
      high = high + way*high_step
      q = q + way*motion_step
    end do
    ! Rounding may have brought a variable to its bound.
    v = min(max(v, program%low), program%high)
    allocate (at(nv))
    at = 0
    where (program%high < NONE .and. high > above) at = 1
    where (program%low > -NONE .and. low > below) at = -1
    ! Not both stops of a point.
    do k = 2, nv
      if (program%point(k) /= program%point(k - 1) .or. at(k) /= 0 .or. at(k - 1) /= 0) cycle
      at(merge(k, k - 1, v(k) < v(k - 1))) = -1
    end do
  end subroutine find_interior

  !> The matrix of a step, with these additions to the diagonal.
  pure subroutine set_matrix(program, diagonal, matrix)
    type(box_program), intent(in) :: program
    real(qp), intent(in) :: diagonal(:)
    real(qp), intent(out) :: matrix(:, :)
    ! Motions that nothing resists.
    real(qp), parameter :: SOFT = 1.0e-28_qp
    integer :: k, nv

    nv = size(diagonal)
    matrix = 0.0_qp
    matrix(:nv, :nv) = program%hessian
    matrix(:nv, nv + 1:) = -transpose(program%rows)
    matrix(nv + 1:, :nv) = program%rows
    do k = 1, nv
      matrix(k, k) = matrix(k, k) + diagonal(k)
    end do
    do k = 1, program%motions()
      matrix(nv + k, nv + k) = program%stiffness(k) + SOFT
    end do
  end subroutine set_matrix

  !> How much of a step keeps variables and multipliers positive, at most 1.
  pure function longest_way(below, above, low, high, step, low_step, high_step) result(way)
    real(qp), dimension(:), intent(in) :: below, above, low, high, step, low_step, high_step
    real(qp) :: way
    integer :: k

    way = 1.0_qp
    do k = 1, size(step)
      if (low(k) > 0.0_qp) then
        if (step(k) < 0.0_qp) way = min(way, -below(k)/step(k))
        if (low_step(k) < 0.0_qp) way = min(way, -low(k)/low_step(k))
      end if
      if (high(k) > 0.0_qp) then
        if (step(k) > 0.0_qp) way = min(way, above(k)/step(k))
        if (high_step(k) < 0.0_qp) way = min(way, -high(k)/high_step(k))
      end if
    end do
  end function longest_way

  !> Triangular factors, with row interchanges.
  pure subroutine factor(matrix, order)
    real(qp), intent(inout) :: matrix(:, :)
    integer, intent(out) :: order(:)
    real(qp) :: row(size(order))
    integer :: j, k, n

    n = size(order)
    do k = 1, n
      order(k) = k - 1 + maxloc(abs(matrix(k:, k)), dim=1)
      row = matrix(order(k), :)
      matrix(order(k), :) = matrix(k, :)
      matrix(k, :) = row
      if (.not. abs(matrix(k, k)) > 0.0_qp) matrix(k, k) = tiny(1.0_qp)**0.25_qp
      matrix(k + 1:, k) = matrix(k + 1:, k)/matrix(k, k)
      do j = k + 1, n
        if (abs(matrix(k, j)) > 0.0_qp) matrix(k + 1:, j) = matrix(k + 1:, j) - matrix(k + 1:, k)*matrix(k, j)
      end do
    end do
  end subroutine factor

  pure subroutine solve_step(matrix, order, rest, left, step, motion_step)
    real(qp), intent(in) :: matrix(:, :), rest(:), left(:)
    integer, intent(in) :: order(:)
    real(qp), intent(out) :: step(:), motion_step(:)
    real(qp) :: x(size(order)), swapped
    integer :: k

    x = [rest, left]
    do k = 1, size(x)
      swapped = x(order(k))
      x(order(k)) = x(k)
      x(k) = swapped
    end do
    do k = 1, size(x)
      x(k + 1:) = x(k + 1:) - matrix(k + 1:, k)*x(k)
    end do
    do k = size(x), 1, -1
      x(k) = x(k)/matrix(k, k)
      x(:k - 1) = x(:k - 1) - matrix(:k - 1, k)*x(k)
    end do
    step = x(:size(step))
    motion_step = x(size(step) + 1:)
  end subroutine solve_step

  !> The largest size of these values, unless it is negligible.
  pure function largest_of(values) result(largest)
    real(qp), intent(in) :: values(:)
    real(qp) :: largest

    largest = maxval([NEGLIGIBLE, abs(values)])
  end function largest_of

  !> Exchange the variables whose state `at` is wrong, the worst first, and keep the best answer.
  pure subroutine exchange(program, at, v, q)
    type(box_program), intent(in) :: program
    integer, intent(inout) :: at(:)
    real(qp), intent(inout) :: v(:), q(:)
    real(qp) :: tried(size(v)), motion(size(q)), wrong(size(v)), gradient(size(v)), least, violation
    integer :: best(size(at)), worst, k

    best = at
    tried = v
    motion = q
    least = violation_of(program, v, q)
    do k = 1, 4*size(v) + 1
      call polish(program, at, tried, motion)
      violation = violation_of(program, tried, motion)
      if (violation <= least) then
        least = violation
        best = at
        v = tried
        q = motion
      end if
      if (.not. violation > ROUNDING*largest_of(tried) .or. size(v) < 1) exit
      gradient = gradient_of(program, tried, motion)
      wrong = max(program%low - tried, tried - program%high)
      where (at /= 0) wrong = real(at, qp)*gradient
      worst = maxloc(wrong, dim=1)
      if (at(worst) /= 0) then
        where (program%point == program%point(worst) .and. at == 0) at = -1
        at(worst) = 0
      else
        at(worst) = merge(1, -1, tried(worst) > program%high(worst))
      end if
    end do
    at = best
  end subroutine exchange

  !> Bring variables to the bounds at which they are, and solve the equations of the others and of the motions. What
  !> these leave open stays as it is.
  pure subroutine polish(program, at, v, q)
    type(box_program), intent(in) :: program
    integer, intent(in) :: at(:)
    real(qp), intent(inout) :: v(:), q(:)
    real(qp), allocatable :: matrix(:, :), right(:)
    integer, allocatable :: between(:)
    integer :: k, nb

    where (at < 0) v = program%low
    where (at > 0) v = program%high
    between = pack([(k, k=1, size(v))], at == 0)
    nb = size(between)
    call set_equations(program, between, matrix)
    allocate (right(size(matrix, 1)))
    ! The change, so that what is left open stays.
    associate (gradient => gradient_of(program, v, q))
      right(:nb) = -gradient(between)
    end associate
    right(nb + 1:) = program%resultant - program%stiffness*q - matmul(program%rows, v)
    call solve_consistent(matrix, right)
    v(between) = v(between) + right(:nb)
    q = q + right(nb + 1:)
  end subroutine polish

  !> The equations of the variables that are between their bounds, and of the motions.
  pure subroutine set_equations(program, between, matrix)
    type(box_program), intent(in) :: program
    integer, intent(in) :: between(:)
    real(qp), allocatable, intent(out) :: matrix(:, :)
    integer :: k, nb

    nb = size(between)
    allocate (matrix(nb + program%motions(), nb + program%motions()))
    matrix = 0.0_qp
    matrix(:nb, :nb) = program%hessian(between, between)
    matrix(:nb, nb + 1:) = -transpose(program%rows(:, between))
    matrix(nb + 1:, :nb) = program%rows(:, between)
    do k = 1, program%motions()
      matrix(nb + k, nb + k) = program%stiffness(k)
    end do
  end subroutine set_equations

  !> Gauss-Jordan elimination with complete pivoting; unknowns without a pivot are zero.
  pure subroutine solve_consistent(matrix, right)
    real(qp), intent(inout) :: matrix(:, :), right(:)
    real(qp) :: largest, solution(size(right))
    logical :: row_used(size(right)), column_used(size(right))
    integer :: place(2), row_of(size(right)), i, k

    solution = 0.0_qp
    row_used = .false.
    column_used = .false.
    row_of = 0
    largest = maxval([0.0_qp, abs(reshape(matrix, [size(matrix)]))])
    do k = 1, size(right)
      place = maxloc(abs(matrix), mask=spread(.not. row_used, 2, size(right)) &
                     .and. spread(.not. column_used, 1, size(right)))
      if (.not. abs(matrix(place(1), place(2))) > SINGULAR*largest) exit
      row_used(place(1)) = .true.
      column_used(place(2)) = .true.
      row_of(place(2)) = place(1)
      right(place(1)) = right(place(1))/matrix(place(1), place(2))
      matrix(place(1), :) = matrix(place(1), :)/matrix(place(1), place(2))
      do i = 1, size(right)
        if (i == place(1) .or. .not. abs(matrix(i, place(2))) > 0.0_qp) cycle
        right(i) = right(i) - matrix(i, place(2))*right(place(1))
        matrix(i, :) = matrix(i, :) - matrix(i, place(2))*matrix(place(1), :)
      end do
    end do
    do k = 1, size(right)
      if (row_of(k) > 0) solution(k) = right(row_of(k))
    end do
    right = solution
  end subroutine solve_consistent

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

  !> Are the modes of the points that can have a force independent of each other, springs included?
  pure function has_independent_modes(alpha, problem) result(independent)
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    logical :: independent
    type(box_program) :: program

    call set_program(alpha, problem, program)
    independent = rank_of(program, spread(.true., 1, program%variables())) == program%motions()
  end function has_independent_modes

  !> The rank of the modes at these variables, springs included.
  pure integer function rank_of(program, among)
    type(box_program), intent(in) :: program
    logical, intent(in) :: among(:)
    real(qp), parameter :: NO_RANK = 1.0e-9_qp
    real(qp) :: work(size(among) + program%motions(), program%motions())
    integer :: j, k, place(2)

    work = 0.0_qp
    do k = 1, size(among)
      if (among(k)) work(k, :) = program%rows(:, k)
    end do
    do j = 1, program%motions()
      if (program%stiffness(j) > 0.0_qp) work(size(among) + j, j) = 1.0_qp
    end do
    rank_of = 0
    do j = 1, program%motions()
      place = maxloc(abs(work))
      if (.not. abs(work(place(1), place(2))) > NO_RANK) return
      rank_of = rank_of + 1
      work(:, place(2)) = work(:, place(2))/work(place(1), place(2))
      do k = 1, program%motions()
        if (k /= place(2)) work(:, k) = work(:, k) - work(:, place(2))*work(place(1), k)
      end do
      work(:, place(2)) = 0.0_qp
      work(place(1), :) = 0.0_qp
    end do
  end function rank_of

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
