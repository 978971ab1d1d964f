!> The loops of fuge_single_passes over consecutive points: arrays of `n` numbers of which no two are the same, so that
!> the compiler can do several numbers at once.
module fuge_single_kernels
  use fuge_kinds, only: dp, sp
  implicit none
  private

  public :: add_and_sum, add_components, find_excess, find_force_excess, inner_and_sum, move_distances, &
    project_and_turn, step_forces, subtract_column

  !> Several partial sums and maxima are faster than one.
  integer, parameter :: LANES = 8

contains

  !> `found` gains the inner products of `x` and the columns of `basis` over the points `first` .. `last`.
  pure subroutine add_components(first, last, n, columns, x, basis, found)
    integer, intent(in) :: first, last, n, columns
    real(sp), intent(in) :: x(n), basis(n, columns)
    real(dp), intent(inout) :: found(columns)
    real(dp) :: partial(LANES)
    integer :: i, j

    do j = 1, columns
      partial = 0.0_dp
      do i = first, last - LANES + 1, LANES
        partial = partial + real(x(i:i + LANES - 1), dp)*real(basis(i:i + LANES - 1, j), dp)
      end do
      do i = last - modulo(last - first + 1, LANES) + 1, last
        partial(1) = partial(1) + real(x(i), dp)*real(basis(i, j), dp)
      end do
      found(j) = found(j) + sum(partial)
    end do
  end subroutine add_components

  !> `found` gains the inner product of `x` and `y`, the sum of `y`, and rises to the largest magnitude of `y`.
  pure subroutine inner_and_sum(n, x, y, found)
    integer, intent(in) :: n
    real(sp), intent(in) :: x(n), y(n)
    real(dp), intent(inout) :: found(3)
    real(dp) :: inner(LANES), total(LANES), values(LANES)
    real(sp) :: largest(LANES), sizes(LANES)
    integer :: i

    inner = 0.0_dp
    total = 0.0_dp
    largest = 0.0_sp
    do i = 1, n - LANES + 1, LANES
      values = real(y(i:i + LANES - 1), dp)
      inner = inner + real(x(i:i + LANES - 1), dp)*values
      total = total + values
      sizes = abs(y(i:i + LANES - 1))
      largest = merge(sizes, largest, sizes > largest)
    end do
    do i = n - modulo(n, LANES) + 1, n
      inner(1) = inner(1) + real(x(i), dp)*real(y(i), dp)
      total(1) = total(1) + real(y(i), dp)
      largest(1) = max(largest(1), abs(y(i)))
    end do
    found(1) = found(1) + sum(inner)
    found(2) = found(2) + sum(total)
    found(3) = max(found(3), real(maxval(largest), dp))
  end subroutine inner_and_sum

  !> y = y + x; `largest` magnitude of x.
  pure subroutine add_and_sum(n, x, y, largest)
    integer, intent(in) :: n
    real(sp), intent(in) :: x(n)
    real(sp), intent(inout) :: y(n)
    real(dp), intent(out) :: largest

    y = y + x
    largest = real(max(maxval(x), -minval(x)), dp)
    if (n < 1) largest = 0.0_dp
  end subroutine add_and_sum

  !> direction = (work - factor*uniform) + ratio*direction; `largest` rises to the magnitude of the first term.
  pure subroutine project_and_turn(n, factor, ratio, work, uniform, direction, largest)
    integer, intent(in) :: n
    real(sp), intent(in) :: factor, ratio, work(n), uniform(n)
    real(sp), intent(inout) :: direction(n), largest
    real(sp) :: sizes(LANES), values(LANES)
    integer :: i

    sizes = 0.0_sp
    do i = 1, n - LANES + 1, LANES
      values = work(i:i + LANES - 1) - factor*uniform(i:i + LANES - 1)
      direction(i:i + LANES - 1) = values + ratio*direction(i:i + LANES - 1)
      values = abs(values)
      sizes = merge(values, sizes, values > sizes)
    end do
    do i = n - modulo(n, LANES) + 1, n
      sizes(1) = max(sizes(1), abs(work(i) - factor*uniform(i)))
      direction(i) = (work(i) - factor*uniform(i)) + ratio*direction(i)
    end do
    largest = max(largest, maxval(sizes))
  end subroutine project_and_turn

  !> The step of the distances of open points; `deepest` rises to their penetrations.
  pure subroutine move_distances(n, factor, shift, work, distance, deepest)
    integer, intent(in) :: n
    real(sp), intent(in) :: factor, shift, work(n)
    real(sp), intent(inout) :: distance(n), deepest
    real(sp) :: least(LANES), values(LANES)
    integer :: i

    least = -deepest
    do i = 1, n - LANES + 1, LANES
      values = distance(i:i + LANES - 1) - (factor*work(i:i + LANES - 1) - shift)
      distance(i:i + LANES - 1) = values
      least = merge(values, least, values < least)
    end do
    do i = n - modulo(n, LANES) + 1, n
      distance(i) = distance(i) - (factor*work(i) - shift)
      least(1) = min(least(1), distance(i))
    end do
    deepest = -minval(least)
  end subroutine move_distances

  !> The step of forces, distances and residuals in the contact; `step_length` is `factor` in double precision. `total`
  !> gains the new residuals, `largest` and `tension` rise to their magnitudes and to the tensions. The arguments are
  !> twelve, because one loop updates all that follows from the forces.
  pure subroutine step_forces(n, step_length, factor, shift, direction, work, force, distance, residual, total, &
                              largest, tension)
    integer, intent(in) :: n
    real(dp), intent(in) :: step_length
    real(sp), intent(in) :: factor, shift, direction(n), work(n)
    real(dp), intent(inout) :: force(n), total, tension
    real(sp), intent(inout) :: distance(n), residual(n), largest
    real(dp) :: forces(LANES), least(LANES), totals(LANES)
    real(sp) :: sizes(LANES), values(LANES)
    integer :: i

    totals = 0.0_dp
    least = -tension
    sizes = 0.0_sp
    do i = 1, n - LANES + 1, LANES
      forces = force(i:i + LANES - 1) - step_length*real(direction(i:i + LANES - 1), dp)
      force(i:i + LANES - 1) = forces
      least = merge(forces, least, forces < least)
      values = distance(i:i + LANES - 1) - (factor*work(i:i + LANES - 1) - shift)
      distance(i:i + LANES - 1) = values
      residual(i:i + LANES - 1) = values
      totals = totals + real(values, dp)
      values = abs(values)
      sizes = merge(values, sizes, values > sizes)
    end do
    do i = n - modulo(n, LANES) + 1, n
      force(i) = force(i) - step_length*real(direction(i), dp)
      least(1) = min(least(1), force(i))
      distance(i) = distance(i) - (factor*work(i) - shift)
      residual(i) = distance(i)
      totals(1) = totals(1) + real(distance(i), dp)
      sizes(1) = max(sizes(1), abs(distance(i)))
    end do
    total = total + sum(totals)
    largest = max(largest, maxval(sizes))
    tension = -minval(least)
  end subroutine step_forces

  !> y = y - factor*x.
  pure subroutine subtract_column(n, factor, x, y)
    integer, intent(in) :: n
    real(sp), intent(in) :: factor, x(n)
    real(sp), intent(inout) :: y(n)

    y = y - factor*x
  end subroutine subtract_column

  !> `excess` rises to how far the distances `x` are out of their ranges.
  pure subroutine find_excess(n, x, least, most, excess)
    integer, intent(in) :: n
    real(sp), intent(in) :: x(n), least(n), most(n)
    real(sp), intent(inout) :: excess
    real(sp) :: sizes(LANES), values(LANES)
    integer :: i

    sizes = excess
    do i = 1, n - LANES + 1, LANES
      values = least(i:i + LANES - 1) - x(i:i + LANES - 1)
      sizes = merge(values, sizes, values > sizes)
      values = x(i:i + LANES - 1) - most(i:i + LANES - 1)
      sizes = merge(values, sizes, values > sizes)
    end do
    do i = n - modulo(n, LANES) + 1, n
      sizes(1) = max(sizes(1), least(i) - x(i), x(i) - most(i))
    end do
    excess = maxval(sizes)
  end subroutine find_excess

  !> As `find_excess`, of forces.
  pure subroutine find_force_excess(n, x, least, most, excess)
    integer, intent(in) :: n
    real(dp), intent(in) :: x(n)
    real(sp), intent(in) :: least(n), most(n)
    real(dp), intent(inout) :: excess
    real(dp) :: sizes(LANES), values(LANES)
    integer :: i

    sizes = excess
    do i = 1, n - LANES + 1, LANES
      values = real(least(i:i + LANES - 1), dp) - x(i:i + LANES - 1)
      sizes = merge(values, sizes, values > sizes)
      values = x(i:i + LANES - 1) - real(most(i:i + LANES - 1), dp)
      sizes = merge(values, sizes, values > sizes)
    end do
    do i = n - modulo(n, LANES) + 1, n
      sizes(1) = max(sizes(1), real(least(i), dp) - x(i), x(i) - real(most(i), dp))
    end do
    excess = maxval(sizes)
  end subroutine find_force_excess

end module fuge_single_kernels
