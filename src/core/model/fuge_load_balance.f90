!> Equilibrium of the forces of a solution, equation (11), for its certificate.
module fuge_load_balance
  use fuge_data_scales, only: is_prescribed, largest_by_mode
  use fuge_kinds, only: dp
  use fuge_point_space, only: point_space
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_relative_size, only: relative
  implicit none
  private

  public :: equilibrium_violation

  !> A resultant may differ by this many units in the last place of the largest force, which are its rounding.
  real(dp), parameter, public :: ROUNDINGS = 16.0_dp
  !> Forces below this fraction of the largest one of their body are judged beside that one where no load acts.
  real(dp), parameter, public :: BESIDE = 1.0e-2_dp

contains

  !> Equation (11) in the free modes; in the others q must be as prescribed. A resultant of zero may consist of rounding
  !> alone: of the forces of its body, or of all forces if no load acts on the body.
  function equilibrium_violation(problem, solution, space) result(violation)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(point_space), intent(in) :: space
    real(dp) :: violation
    real(dp) :: spring, sums(2)
    integer :: j

    violation = 0.0_dp
    do j = 1, problem%mode_count()
      if (is_prescribed(problem, j)) violation = max(violation, &
        relative(abs(solution%motion(j) - problem%motion(j)), abs(problem%motion(j))))
    end do
    if (allocated(problem%modes)) then
      violation = max(violation, imbalance_in_modes(problem, solution, space))
    else if (.not. is_prescribed(problem, 1)) then
      sums = [sum(solution%force), sum(abs(solution%force))]
      call space%add(sums)
      spring = problem%spring_load(1, solution%motion(1))
      violation = max(violation, relative(abs((sums(1) - problem%resultant(1)) + spring), &
                                          max(sums(2), abs(problem%resultant(1)), abs(spring))))
    end if
  end function equilibrium_violation

  !> Equation (11) in the free modes of a problem that has modes, relative to the terms of the sum; without a resultant
  !> at least to a fraction of the largest force of the body, since along an axis without a load forces at tied points
  !> may be the rounding of those along the other axes.
  function imbalance_in_modes(problem, solution, space) result(violation)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(point_space), intent(in) :: space
    real(dp) :: violation
    real(dp) :: of_bodies(2, size(problem%modes, 2)), extremes(4), sums(2)
    real(dp) :: own, largest, imbalance, spring, spring_force
    integer :: j

    violation = 0.0_dp
    spring_force = largest_spring_force(problem, solution%motion, space)
    call find_extremes_of_bodies(problem, solution%force, space, of_bodies)
    do j = 1, size(problem%modes, 2)
      if (is_prescribed(problem, j)) cycle
      associate (mode => problem%modes(:, j), resultant => problem%resultant(j), force => solution%force)
        extremes = [of_bodies(1, j), maxval(abs(force)), maxval(abs(mode)), of_bodies(2, j)]
        call space%raise(extremes)
        sums = [sum(mode*force), sum(abs(mode*force))]
        call space%add(sums)
        own = max(extremes(1), spring_force)
        largest = max(extremes(2), spring_force)
        if (extremes(4) > 0.0_dp) largest = own
        largest = ROUNDINGS*epsilon(largest)*extremes(3)*largest
        spring = problem%spring_load(j, solution%motion(j))
        imbalance = max(abs((sums(1) - resultant) + spring) - largest, 0.0_dp)
        if (abs(resultant) > 0.0_dp) own = 0.0_dp
        violation = max(violation, relative(imbalance, max(sums(2), abs(resultant), abs(spring), &
                                                           BESIDE*extremes(3)*own)))
      end associate
    end do
  end function imbalance_in_modes

  !> Of the points of this rank that a mode moves, the largest `force` of their bodies, -huge if there are no such
  !> points, and 1 if a load acts on any of them, else 0: `extremes` (2, m).
  subroutine find_extremes_of_bodies(problem, force, space, extremes)
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: force(:)
    type(point_space), intent(in) :: space
    real(dp), intent(out) :: extremes(:, :)
    real(dp) :: by_mode(size(extremes, 2))
    integer :: i, j

    by_mode = largest_by_mode(problem%modes, force, space)
    extremes(1, :) = -huge(extremes)
    extremes(2, :) = 0.0_dp
    do j = 1, size(extremes, 2)
      do i = 1, size(extremes, 2)
        if (.not. move_a_point_together(problem%modes(:, i), problem%modes(:, j))) cycle
        extremes(1, j) = max(extremes(1, j), by_mode(i))
        if (is_prescribed(problem, i)) cycle
        if (abs(problem%resultant(i)) > 0.0_dp) extremes(2, j) = 1.0_dp
      end do
    end do
  end subroutine find_extremes_of_bodies

  !> Is there a point that both modes (n) move? For modes of one body the first point often is.
  pure function move_a_point_together(one, other) result(together)
    real(dp), intent(in) :: one(:), other(:)
    logical :: together
    integer :: k

    together = .false.
    do k = 1, size(one)
      together = abs(one(k)) > 0.0_dp .and. abs(other(k)) > 0.0_dp
      if (together) return
    end do
  end function move_a_point_together

  !> The largest force that a spring on a motion stands for, in which motions round together: the part of the resultant
  !> that it carries under `motion` (m), over the largest displacement of its mode.
  function largest_spring_force(problem, motion, space) result(largest)
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: motion(:)
    type(point_space), intent(in) :: space
    real(dp) :: largest
    real(dp) :: arm, load
    integer :: j

    largest = 0.0_dp
    do j = 1, size(motion)
      load = abs(problem%spring_load(j, motion(j)))
      if (.not. load > 0.0_dp) cycle
      arm = space%largest(maxval(abs(problem%modes(:, j))))
      if (arm > 0.0_dp) largest = max(largest, load/arm)
    end do
  end function largest_spring_force

end module fuge_load_balance
