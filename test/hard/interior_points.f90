!> Quadratic programs in a box by a primal-dual interior point method (S. Mehrotra, SIAM Journal on Optimization 2,
!> 1992), in quadruple precision. The states that the interior point tells are solved for once more, so that the answer
!> is exact but for rounding.
module interior_points
  use, intrinsic :: iso_fortran_env, only: qp => real128
  use law_programs, only: box_program, gradient_of, set_equations, violation_of, NONE, SINGULAR
  implicit none
  private

  public :: exchange, find_interior, largest_of, solve_consistent

  !> Products of variables and their multipliers at the end, what is left of the equations, and most steps.
  real(qp), parameter :: LEAST_PRODUCT = 1.0e-33_qp, LEAST_REST = 1.0e-28_qp
  integer, parameter :: MOST_STEPS = 400
  !> Violations below this fraction of the largest force are rounding.
  real(qp), parameter :: ROUNDING = 1.0e-24_qp
  !> Forces of this size displace no more than rounding.
  real(qp), parameter, public :: NEGLIGIBLE = 1.0e-12_qp
  !> Fraction of the way to the nearest bound.
  real(qp), parameter :: OF_THE_WAY = 0.995_qp

contains

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

  !> Gauss-Jordan elimination with complete pivoting; unknowns without a pivot are zero. `rank`: how many have one.
  pure subroutine solve_consistent(matrix, right, rank)
    real(qp), intent(inout) :: matrix(:, :), right(:)
    integer, intent(out), optional :: rank
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
    if (present(rank)) rank = count(column_used)
  end subroutine solve_consistent

end module interior_points
