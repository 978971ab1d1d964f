!> What problems of one translation and one-sided points are tested against. Of the library only the kind of its
!> numbers is used. Other than in general_reference, lengths and residuals do not depend on the datum
!> of gaps and matrix, and forces are exact for loads far below the natural one.
module one_sided_reference
  use fuge, only: dp => fuge_dp
  use general_reference, only: eliminate
  implicit none
  private

  public :: enumerate, violation, length_of, datum_of, deflection, is_definite

contains

  !> The solution, found by trying every contact set; `worst` is its most negative force, relative to the load, or gap,
  !> relative to the lengths.
  pure subroutine enumerate(alpha, gap, load, force, opening, approach, worst)
    real(dp), intent(in) :: alpha(:, :), gap(:), load
    real(dp), intent(out) :: force(:), opening(:), approach, worst
    real(dp) :: tried_force(size(gap)), tried_opening(size(gap)), tried_approach, tried
    logical :: set(size(gap)), regular
    integer :: code, k

    worst = huge(worst)
    do code = 1, 2**size(gap) - 1
      set = [(btest(code, k - 1), k=1, size(gap))]
      call try_set(alpha, gap, load, set, tried_force, tried_opening, tried_approach, regular)
      if (.not. regular) cycle
      tried = max(0.0_dp, -minval(tried_force)/load, &
                  -minval(tried_opening)/length_of(alpha, gap, load))
      if (tried >= worst) cycle
      worst = tried
      force = tried_force
      opening = tried_opening
      approach = tried_approach
    end do
  end subroutine enumerate

  !> Forces, gaps and approach if exactly the points of `set` touch, unless the linear system is singular.
  pure subroutine try_set(alpha, gap, load, set, force, opening, approach, regular)
    real(dp), intent(in) :: alpha(:, :), gap(:), load
    logical, intent(in) :: set(:)
    real(dp), intent(out) :: force(:), opening(:), approach
    logical, intent(out) :: regular
    real(dp) :: system(count(set) + 1, count(set) + 1), x(count(set) + 1)
    integer :: points(count(set)), k, m

    m = count(set)
    points = pack([(k, k=1, size(set))], set)
    system(:m, :m) = alpha(points, points)
    system(:m, m + 1) = -1.0_dp
    system(m + 1, :m) = 1.0_dp
    system(m + 1, m + 1) = 0.0_dp
    ! Gaps relative to that of one point in the set: a small load is not lost in large gaps.
    call eliminate(system, [gap(points(1)) - gap(points), load], x, regular)
    force = 0.0_dp
    force(points) = x(:m)
    approach = x(m + 1) + gap(points(1))
    opening = merge(0.0_dp, gap + matmul(alpha, force) - approach, set)
  end subroutine try_set

  !> Is alpha positive definite for forces of zero sum? For matrices of small whole numbers, for which elimination is
  !> exact enough.
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

  !> The largest residual of equations (9) to (11), relative to one length and one force for all points; what rounding
  !> of the data and of the approach explains is not counted.
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

  !> The length that gaps are compared with: their range or, if larger, the displacement by the load at one point;
  !> independent of the datum of gaps and of alpha.
  pure function length_of(alpha, gap, load) result(length)
    real(dp), intent(in) :: alpha(:, :), gap(:), load
    real(dp) :: length

    length = max(maxval(gap) - minval(gap), maxval(abs(alpha - datum_of(alpha)))*load)
    if (.not. length > 0.0_dp) length = max(abs(gap(1)), maxval(abs(alpha))*load, tiny(length))
  end function length_of

  !> (alpha - datum) F, the datum subtracted from each coefficient.
  pure function deflection(alpha, datum, force) result(u)
    real(dp), intent(in) :: alpha(:, :), datum, force(:)
    real(dp) :: u(size(force))
    integer :: j

    u = 0.0_dp
    do j = 1, size(force)
      u = u + (alpha(:, j) - datum)*force(j)
    end do
  end function deflection

  !> The coefficient nearest to zero, or 0 if there are both signs.
  pure function datum_of(alpha) result(datum)
    real(dp), intent(in) :: alpha(:, :)
    real(dp) :: datum

    datum = max(minval(alpha), 0.0_dp) + min(maxval(alpha), 0.0_dp)
  end function datum_of

end module one_sided_reference
