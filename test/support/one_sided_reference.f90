!> What problems of one translation and one-sided points are tested against. Other than in law_reference, lengths
!> and residuals do not depend on the datum of gaps and matrix.
module one_sided_reference
  use fuge_kinds, only: dp
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use law_reference, only: enumerate_laws
  implicit none
  private

  public :: enumerate, violation, length_of, datum_of, deflection, is_definite

contains

  !> The solution, found by trying every contact set; `worst` is its largest relative violation.
  pure subroutine enumerate(alpha, gap, load, force, opening, approach, worst)
    real(dp), intent(in) :: alpha(:, :), gap(:), load
    real(dp), intent(out) :: force(:), opening(:), approach, worst
    type(fuge_problem) :: problem
    type(fuge_solution) :: answer
    logical :: all_regular

    allocate (problem%gap, source=gap)
    allocate (problem%resultant, source=[load])
    call enumerate_laws(alpha, problem, answer, worst, all_regular)
    force = answer%force
    opening = answer%gap
    approach = answer%motion(1)
  end subroutine enumerate

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
