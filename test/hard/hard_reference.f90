!> What the hard cases are measured against. Nothing here comes from the library but
!> the kind of its numbers.
module hard_reference
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge, only: dp => fuge_dp
  implicit none
  private

  public :: draw, integers, gauss, enumerate, violation, length_of, datum_of, deflection, is_definite

contains

  !> Minimal standard generator: the same numbers, 0 < value < 1, with every compiler.
  pure subroutine draw(seed, values)
    integer(int64), intent(inout) :: seed
    real(dp), intent(out) :: values(:)
    integer :: k

    do k = 1, size(values)
      seed = mod(16807_int64*seed, 2147483647_int64)
      values(k) = real(seed, dp)/2147483647.0_dp
    end do
  end subroutine draw

  !> Whole numbers from `low` to `high`.
  pure subroutine integers(seed, low, high, values)
    integer(int64), intent(inout) :: seed
    integer, intent(in) :: low, high
    real(dp), intent(out) :: values(:)

    call draw(seed, values)
    values = real(low, dp) + aint(values*real(high - low + 1, dp))
  end subroutine integers

  !> Gauss-Jordan elimination with row interchanges; the matrix must be regular.
  pure function gauss(matrix, rhs) result(x)
    real(dp), intent(in) :: matrix(:, :), rhs(:)
    real(dp) :: x(size(rhs)), work(size(rhs), size(rhs) + 1), row(size(rhs) + 1)
    integer :: i, k, p, n

    n = size(rhs)
    work(:, :n) = matrix
    work(:, n + 1) = rhs
    do k = 1, n
      p = k - 1 + maxloc(abs(work(k:, k)), dim=1)
      row = work(p, :)
      work(p, :) = work(k, :)
      work(k, :) = row/row(k)
      do i = 1, n
        if (i /= k) work(i, :) = work(i, :) - work(i, k)*work(k, :)
      end do
    end do
    x = work(:, n + 1)
  end function gauss

  !> The answer by trying every contact set; `worst` is its most negative force, as a
  !> part of the load, or gap, as a part of the lengths.
  pure subroutine enumerate(alpha, gap, load, force, opening, approach, worst)
    real(dp), intent(in) :: alpha(:, :), gap(:), load
    real(dp), intent(out) :: force(:), opening(:), approach, worst
    real(dp) :: tried_force(size(gap)), tried_opening(size(gap)), tried_approach, tried
    logical :: set(size(gap))
    integer :: code, k

    worst = huge(worst)
    do code = 1, 2**size(gap) - 1
      set = [(btest(code, k - 1), k=1, size(gap))]
      call try_set(alpha, gap, load, set, tried_force, tried_opening, tried_approach)
      tried = max(0.0_dp, -minval(tried_force)/load, &
                  -minval(tried_opening)/length_of(alpha, gap, load))
      if (tried >= worst) cycle
      worst = tried
      force = tried_force
      opening = tried_opening
      approach = tried_approach
    end do
  end subroutine enumerate

  !> Forces, gaps and approach if exactly the points of `set` touch.
  pure subroutine try_set(alpha, gap, load, set, force, opening, approach)
    real(dp), intent(in) :: alpha(:, :), gap(:), load
    logical, intent(in) :: set(:)
    real(dp), intent(out) :: force(:), opening(:), approach
    real(dp) :: system(count(set) + 1, count(set) + 1), x(count(set) + 1)
    integer :: points(count(set)), k, m

    m = count(set)
    points = pack([(k, k=1, size(set))], set)
    system(:m, :m) = alpha(points, points)
    system(:m, m + 1) = -1.0_dp
    system(m + 1, :m) = 1.0_dp
    system(m + 1, m + 1) = 0.0_dp
    ! Gaps from one of the set: a small load is not lost beside large gaps.
    x = gauss(system, [gap(points(1)) - gap(points), load])
    force = 0.0_dp
    force(points) = x(:m)
    approach = x(m + 1) + gap(points(1))
    opening = merge(0.0_dp, gap + matmul(alpha, force) - approach, set)
  end subroutine try_set

  !> Is alpha positive definite on forces with zero sum? Meant for whole numbers, with
  !> which the elimination is exact enough.
  pure function is_definite(alpha) result(definite)
    real(dp), intent(in) :: alpha(:, :)
    logical :: definite
    real(dp) :: form(size(alpha, 1) - 1, size(alpha, 1) - 1)
    integer :: i, j, n

    n = size(alpha, 1)
    do j = 1, n - 1
      form(:, j) = alpha(:n - 1, j) - alpha(n, j) - alpha(:n - 1, n) + alpha(n, n)
    end do
    definite = .true.
    do j = 1, n - 1
      definite = form(j, j) > 1.0e-9_dp
      if (.not. definite) return
      do i = j + 1, n - 1
        form(i, :) = form(i, :) - (form(i, j)/form(j, j))*form(j, :)
      end do
    end do
  end function is_definite

  !> The worst of equations (9) to (11), measured by one length and one force for all
  !> points; what the rounding of the data and of v_0 does is left out.
  pure function violation(alpha, gap, load, force, opening, approach) result(worst)
    real(dp), intent(in) :: alpha(:, :), gap(:), load, force(:), opening(:), approach
    real(dp) :: worst, error(size(gap)), datum, length, rounding

    datum = datum_of(alpha)
    length = length_of(alpha, gap, load)
    rounding = 4.0_dp*epsilon(load)*(abs(approach) + maxval(abs(gap)) + abs(datum)*load)
    error = (gap - (approach - datum*sum(force))) + deflection(alpha, datum, force) - opening
    worst = max((maxval(abs(error)) - rounding)/length, -minval(force)/load, -minval(opening)/length, &
                maxval(min(abs(force)/load, abs(opening)/length)), abs(sum(force) - load)/load)
  end function violation

  !> A length to measure gaps by: their range, or the displacements that the load makes at
  !> one point, whatever the datum of gaps and of alpha.
  pure function length_of(alpha, gap, load) result(length)
    real(dp), intent(in) :: alpha(:, :), gap(:), load
    real(dp) :: length

    length = max(maxval(gap) - minval(gap), maxval(abs(alpha - datum_of(alpha)))*load)
    if (.not. length > 0.0_dp) length = max(abs(gap(1)), maxval(abs(alpha))*load, tiny(length))
  end function length_of

  !> (alpha - datum) F, the datum taken out of each coefficient.
  pure function deflection(alpha, datum, force) result(u)
    real(dp), intent(in) :: alpha(:, :), datum, force(:)
    real(dp) :: u(size(force))
    integer :: j

    u = 0.0_dp
    do j = 1, size(force)
      u = u + (alpha(:, j) - datum)*force(j)
    end do
  end function deflection

  !> The coefficient nearest to zero, 0 if there are both signs.
  pure function datum_of(alpha) result(datum)
    real(dp), intent(in) :: alpha(:, :)
    real(dp) :: datum

    datum = max(minval(alpha), 0.0_dp) + min(maxval(alpha), 0.0_dp)
  end function datum_of

end module hard_reference
