!> The independent certificate: how far a solution is from the conditions of the contact problem.
!>
!> It sees only the caller's data, and shares no arithmetic with any engine: only the call of the operator, the loop
!> over chunks of points, and what the model offers to all, its point laws and lengths of data.
module fuge_certificate
  use fuge_kinds, only: dp
  use fuge_operator_type, only: fuge_operator
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: fuge_residual, find_violation

  !> Violations, each relative to the data; no unit. Huge until they are known.
  type, public :: fuge_violation
    !> Gap equation (9): c - (gap + A f - R q).
    real(dp) :: gap_equation = huge(1.0_dp)
    !> Signs, equation (10): negative forces, negative gaps, gaps beyond the upper stop; forces beyond their limits.
    real(dp) :: sign = huge(1.0_dp)
    !> Complementary slackness, equation (10): the smaller one of a force and the distance from
    !> its stop. Where forces have limits, the distance from the law of the point.
    real(dp) :: complementarity = huge(1.0_dp)
    !> Equilibrium, equation (11): R^T f - w + S q; prescribed motions that q does not have.
    real(dp) :: equilibrium = huge(1.0_dp)
    !> Forces that dwarf the data: lengths that they leave open, or that are their rounding, relative to gaps, plays and
    !> the displacement by the load, of the points where these forces are. 0 where that is no more than a thousandth.
    real(dp) :: unresolved = huge(1.0_dp)
  contains
    procedure :: worst
  end type fuge_violation

  interface
    !> How far a solution violates equations (9), (10) and (11).
    !>
    !> `operator` with n points; `problem` and `solution` in the same units; out: `violation`, huge
    !> where a force is not finite. One product A f, and another one where lengths may be rounding.
    !>
    !> With d the datum of the operator, lengths at point k are compared with the magnitude |gap_k - (R q)_k + d sum f|
    !> + sum_j |A_kj - d| |f_j|: the depth to which the point is pressed, or its rigid gap, and the terms of its
    !> displacement. The magnitude depends neither on the datum of the gaps or of A nor on other points. For one
    !> translation, the error of equation (9) at the contact point of the least magnitude shows how exact v_0 is, and is
    !> compared with v_0 and its terms; elsewhere the error less that one is compared with the magnitude. For several
    !> modes the whole error is. The rounding of the caller's own numbers, and that of R q, is not counted. Forces are
    !> compared with the largest force of their body. Because the magnitudes grow with the forces, `unresolved` compares
    !> the same errors with the data alone. A + D takes the place of A where there are compliances. info%energy is the
    !> elastic energy of the forces.
    !>
    !> Errors: FUGE_ERR_SIZE if an array is missing or of the wrong length; FUGE_ERR_MEMORY; those of
    !> the product, FUGE_ERR_CALLBACK also for one that is not finite.
    module subroutine fuge_residual(operator, problem, solution, violation, info)
      class(fuge_operator), intent(in) :: operator
      type(fuge_problem), intent(in) :: problem
      type(fuge_solution), intent(in) :: solution
      type(fuge_violation), intent(out) :: violation
      type(fuge_info), intent(out) :: info
    end subroutine fuge_residual

    !> As `fuge_residual`, within a solve: `info` goes on counting products, and its status and
    !> message change on an error only. Errors of the gaps up to `enough` stay as they are, although a further product
    !> might show that some of them is rounding.
    module subroutine find_violation(operator, problem, solution, violation, info, enough)
      class(fuge_operator), intent(in) :: operator
      type(fuge_problem), intent(in) :: problem
      type(fuge_solution), intent(in) :: solution
      type(fuge_violation), intent(out) :: violation
      type(fuge_info), intent(inout) :: info
      real(dp), intent(in), optional :: enough
    end subroutine find_violation
  end interface

contains

  !> The largest of the violations: the residual of a solve; no unit.
  pure function worst(self)
    class(fuge_violation), intent(in) :: self
    real(dp) :: worst

    associate (violations => [self%gap_equation, self%sign, self%complementarity, self%equilibrium, self%unresolved])
      worst = maxval(violations)
      ! maxval may ignore a NaN, which must not pass for small.
      if (.not. all(violations <= huge(worst))) worst = huge(worst)
    end associate
  end function worst

end module fuge_certificate
