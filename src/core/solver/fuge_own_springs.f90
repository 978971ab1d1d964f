!> Forces of points on springs of their own, beside which the bodies hardly give way.
!>
!> The motions of such points tell their forces, to the last digit also where these are nearly zero. An engine solves
!> for all forces together, and leaves them the rounding of the largest one.
module fuge_own_springs
  use fuge_constants, only: LARGEST_EXPONENT
  use fuge_contact_states, only: FUGE_AT_LOWER_STOP
  use fuge_kinds, only: dp
  use fuge_matrix_operator, only: fuge_dense_operator
  use fuge_matrix_survey, only: matrix_survey
  use fuge_operator_type, only: fuge_operator
  use fuge_point_law, only: point_law
  use fuge_problem_type, only: fuge_problem, fuge_solution
  implicit none
  private

  public :: settle_own_springs

  !> The bodies hardly give way if all forces together displace less than this fraction of what the largest one does on
  !> the spring of a point.
  real(dp), parameter :: HARDLY = 2.0_dp**(-10)
  !> A gap that is open by more than this fraction of its rigid terms is open by more than their rounding.
  real(dp), parameter :: ROUNDED = 4.0_dp*epsilon(1.0_dp)
  !> Forces that would change a resultant by more than this fraction of its terms come from motions that are not exact.
  real(dp), parameter :: IN_BALANCE = 256.0_dp*epsilon(1.0_dp)

contains

  !> Set the forces of the `solution` that close gaps which rounding of larger forces has left open. Only with a matrix,
  !> and where points have compliances far above its coefficients.
  pure subroutine settle_own_springs(operator, problem, solution)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(inout) :: solution
    type(matrix_survey) :: survey
    real(dp) :: largest, moved
    logical :: yields(size(solution%force))

    if (.not. allocated(problem%compliance)) return
    select type (operator)
    class is (fuge_dense_operator)
      survey = operator%known()
      largest = maxval(abs(solution%force))
      moved = survey%largest()*sum(abs(solution%force))
      ! Also where a product overflows or is no number.
      yields = moved <= HARDLY*problem%compliance*largest .and. problem%compliance*largest <= huge(moved) &
               .and. problem%compliance > 0.0_dp
      if (any(yields)) call close_gaps(operator%alpha, moved > 0.0_dp, yields, problem, solution)
    end select
  end subroutine settle_own_springs

  !> Set the forces that leave gaps open at the points that yield, (n). `gives_way`: alpha is not zero.
  pure subroutine close_gaps(alpha, gives_way, yields, problem, solution)
    real(dp), intent(in), contiguous :: alpha(:, :)
    logical, intent(in) :: gives_way, yields(:)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(inout) :: solution
    real(dp), dimension(size(solution%force)) :: elastic, force, open, terms
    integer :: j, k, n

    n = size(elastic)
    elastic = 0.0_dp
    if (gives_way) then
      do j = 1, n
        if (abs(solution%force(j)) > 0.0_dp) elastic = elastic + alpha(:n, j)*solution%force(j)
      end do
    end if
    open = solution%gap - problem%gap
    terms = abs(solution%gap) + abs(problem%gap) + abs(elastic)
    do j = 1, size(solution%motion)
      if (allocated(problem%modes)) then
        open = open + problem%modes(:, j)*solution%motion(j)
        terms = terms + abs(problem%modes(:, j)*solution%motion(j))
      else
        open = open + solution%motion(j)
        terms = terms + abs(solution%motion(j))
      end if
    end do
    open = open - elastic
    force = solution%force
    do k = 1, n
      associate (compliance => problem%compliance(k))
        if (abs(solution%state(k)) /= FUGE_AT_LOWER_STOP .or. .not. yields(k)) cycle
        if (abs(open(k) - compliance*force(k)) <= ROUNDED*terms(k)) cycle
        if (exponent(open(k)) - exponent(compliance) > LARGEST_EXPONENT) cycle
        ! Another sign, or a force beyond a limit, would be another state.
        if (sign(1.0_dp, open(k))*force(k) > 0.0_dp .and. carries(problem%law(k), open(k)/compliance)) &
          force(k) = open(k)/compliance
      end associate
    end do
    if (keeps_balance(problem, solution%force, force)) solution%force = force
  end subroutine close_gaps

  !> Has `force` (n) the resultants of the forces `before` (n), but for rounding?
  pure function keeps_balance(problem, before, force) result(keeps)
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: before(:), force(:)
    logical :: keeps
    integer :: j

    keeps = .true.
    if (.not. allocated(problem%modes)) then
      keeps = problem%mode_count() < 1 .or. abs(sum(force - before)) <= IN_BALANCE*sum(abs(before))
      return
    end if
    do j = 1, problem%mode_count()
      ! A prescribed motion has any resultant.
      if (allocated(problem%prescribed)) then
        if (problem%prescribed(j)) cycle
      end if
      associate (mode => problem%modes(:, j))
        keeps = keeps .and. abs(sum(mode*(force - before))) <= IN_BALANCE*sum(abs(mode*before))
      end associate
    end do
  end function keeps_balance

  !> Is this a force that a point of such a law can have?
  pure function carries(law, force)
    type(point_law), intent(in) :: law
    real(dp), intent(in) :: force
    logical :: carries

    carries = force >= law%least_force() .and. force <= law%most_force()
  end function carries

end module fuge_own_springs
