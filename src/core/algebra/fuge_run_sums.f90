!> Sums and maxima over runs of consecutive points: the points `first`(i) .. `last`(i) of arrays of `n` numbers, for the
!> `runs` runs i. No two arrays are the same, so that the compiler can do several numbers at once.
module fuge_run_sums
  use fuge_kinds, only: dp
  implicit none
  private

  public :: add_scaled_on_runs, center_on_runs, dot_and_sum_on_runs, dot_on_runs, max_abs_on_runs, &
    subtract_and_dot_on_runs, sum_on_runs

  !> Number of partial sums: several are faster, and more exact, than one.
  integer, parameter :: LANES = 8

contains

  !> The sum of `x`.
  pure function sum_on_runs(runs, first, last, n, x) result(total)
    integer, intent(in) :: runs, first(runs), last(runs), n
    real(dp), intent(in) :: x(n)
    real(dp) :: total
    real(dp) :: partial(LANES)
    integer :: i, k

    total = 0.0_dp
    partial = 0.0_dp
    do i = 1, runs
      do k = first(i), last(i) - LANES + 1, LANES
        partial = partial + x(k:k + LANES - 1)
      end do
      do k = last(i) - modulo(last(i) - first(i) + 1, LANES) + 1, last(i)
        total = total + x(k)
      end do
    end do
    total = total + sum(partial)
  end function sum_on_runs

  !> The inner product of `x` and `y`, which may be the same.
  pure function dot_on_runs(runs, first, last, n, x, y) result(inner)
    integer, intent(in) :: runs, first(runs), last(runs), n
    real(dp), intent(in) :: x(n), y(n)
    real(dp) :: inner
    real(dp) :: partial(LANES)
    integer :: i, k

    inner = 0.0_dp
    partial = 0.0_dp
    do i = 1, runs
      do k = first(i), last(i) - LANES + 1, LANES
        partial = partial + x(k:k + LANES - 1)*y(k:k + LANES - 1)
      end do
      do k = last(i) - modulo(last(i) - first(i) + 1, LANES) + 1, last(i)
        inner = inner + x(k)*y(k)
      end do
    end do
    inner = inner + sum(partial)
  end function dot_on_runs

  !> `sums` = the inner product of `x` and `y`, and the sum of `y`.
  pure subroutine dot_and_sum_on_runs(runs, first, last, n, x, y, sums)
    integer, intent(in) :: runs, first(runs), last(runs), n
    real(dp), intent(in) :: x(n), y(n)
    real(dp), intent(out) :: sums(2)
    real(dp) :: inner, products(LANES), total, values(LANES)
    integer :: i, k

    inner = 0.0_dp
    total = 0.0_dp
    products = 0.0_dp
    values = 0.0_dp
    do i = 1, runs
      do k = first(i), last(i) - LANES + 1, LANES
        products = products + x(k:k + LANES - 1)*y(k:k + LANES - 1)
        values = values + y(k:k + LANES - 1)
      end do
      do k = last(i) - modulo(last(i) - first(i) + 1, LANES) + 1, last(i)
        inner = inner + x(k)*y(k)
        total = total + y(k)
      end do
    end do
    sums = [inner + sum(products), total + sum(values)]
  end subroutine dot_and_sum_on_runs

  !> Subtract `factor` times `x` from `y`; `inner` = the inner product of the new `y` and `z`. The arguments are nine,
  !> because one pass does both, and the runs are three of them.
  pure subroutine subtract_and_dot_on_runs(runs, first, last, n, factor, x, y, z, inner)
    integer, intent(in) :: runs, first(runs), last(runs), n
    real(dp), intent(in) :: factor, x(n), z(n)
    real(dp), intent(inout) :: y(n)
    real(dp), intent(out) :: inner
    real(dp) :: partial(LANES), values(LANES)
    integer :: i, k

    inner = 0.0_dp
    partial = 0.0_dp
    do i = 1, runs
      do k = first(i), last(i) - LANES + 1, LANES
        values = y(k:k + LANES - 1) - factor*x(k:k + LANES - 1)
        y(k:k + LANES - 1) = values
        partial = partial + values*z(k:k + LANES - 1)
      end do
      do k = last(i) - modulo(last(i) - first(i) + 1, LANES) + 1, last(i)
        y(k) = y(k) - factor*x(k)
        inner = inner + y(k)*z(k)
      end do
    end do
    inner = inner + sum(partial)
  end subroutine subtract_and_dot_on_runs

  !> Subtract `mean` from `x`; `largest` is the largest |x| then, 0 if there is none.
  pure subroutine center_on_runs(runs, first, last, n, mean, x, largest)
    integer, intent(in) :: runs, first(runs), last(runs), n
    real(dp), intent(in) :: mean
    real(dp), intent(inout) :: x(n)
    real(dp), intent(out) :: largest
    real(dp) :: partial(LANES), values(LANES)
    integer :: i, k

    largest = 0.0_dp
    partial = 0.0_dp
    do i = 1, runs
      do k = first(i), last(i) - LANES + 1, LANES
        values = x(k:k + LANES - 1) - mean
        x(k:k + LANES - 1) = values
        values = abs(values)
        partial = merge(values, partial, values > partial)
      end do
      do k = last(i) - modulo(last(i) - first(i) + 1, LANES) + 1, last(i)
        x(k) = x(k) - mean
        largest = max(largest, abs(x(k)))
      end do
    end do
    largest = max(largest, maxval(partial))
  end subroutine center_on_runs

  !> The largest |x|, 0 if there is none.
  pure function max_abs_on_runs(runs, first, last, n, x) result(largest)
    integer, intent(in) :: runs, first(runs), last(runs), n
    real(dp), intent(in) :: x(n)
    real(dp) :: largest
    integer :: i, k

    largest = 0.0_dp
    do i = 1, runs
      do k = first(i), last(i)
        largest = max(largest, abs(x(k)))
      end do
    end do
  end function max_abs_on_runs

  !> y = x + factor*y.
  pure subroutine add_scaled_on_runs(runs, first, last, n, factor, x, y)
    integer, intent(in) :: runs, first(runs), last(runs), n
    real(dp), intent(in) :: factor, x(n)
    real(dp), intent(inout) :: y(n)
    integer :: i, k

    do i = 1, runs
      do k = first(i), last(i)
        y(k) = x(k) + factor*y(k)
      end do
    end do
  end subroutine add_scaled_on_runs

end module fuge_run_sums
