!> Equilibrium of the forces of a solution, equation (11), for its certificate.
module fuge_load_balance
  use fuge_data_scales, only: is_prescribed
  use fuge_kinds, only: dp
  use fuge_point_chunks, only: chunked_pass
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

  !> A pass over the forces and the modes. Found, (4 m): for each mode the sum of the terms of the resultant, that of
  !> their magnitudes, the largest displacement of a point, and the largest force at a point that the mode moves.
  type, extends(chunked_pass) :: mode_pass
    real(dp), pointer, contiguous :: modes(:, :) => null(), force(:) => null()
  contains
    procedure :: do_chunk => survey_modes
  end type mode_pass

contains

  !> Equation (11) in the free modes; in the others q must be as prescribed. A resultant of zero may consist of rounding
  !> alone: of the forces of its body, or of all forces if no load acts on the body.
  !>
  !> `forces`: the sum of the forces at all points, that of their magnitudes, and the largest magnitude.
  function equilibrium_violation(problem, solution, forces, space) result(violation)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    real(dp), intent(in) :: forces(3)
    type(point_space), intent(in) :: space
    real(dp) :: violation
    real(dp) :: spring
    integer :: j

    violation = 0.0_dp
    do j = 1, problem%mode_count()
      if (is_prescribed(problem, j)) violation = max(violation, &
        relative(abs(solution%motion(j) - problem%motion(j)), abs(problem%motion(j))))
    end do
    if (allocated(problem%modes)) then
      violation = max(violation, imbalance_in_modes(problem, solution, forces(3), space))
    else if (.not. is_prescribed(problem, 1)) then
      spring = problem%spring_load(1, solution%motion(1))
      violation = max(violation, relative(abs((forces(1) - problem%resultant(1)) + spring), &
                                          max(forces(2), abs(problem%resultant(1)), abs(spring))))
    end if
  end function equilibrium_violation

  !> Equation (11) in the free modes of a problem that has modes, relative to the terms of the sum; without a resultant
  !> at least to a fraction of the largest force of the body, since along an axis without a load forces at tied points
  !> may be the rounding of those along the other axes.
  function imbalance_in_modes(problem, solution, largest_force, space) result(violation)
    type(fuge_problem), intent(in), target :: problem
    type(fuge_solution), intent(in), target :: solution
    real(dp), intent(in) :: largest_force
    type(point_space), intent(in) :: space
    real(dp) :: violation
    type(mode_pass) :: pass
    real(dp) :: sums(2*size(problem%modes, 2)), most(2*size(problem%modes, 2)), of_bodies(2*size(problem%modes, 2))
    real(dp) :: own, largest, imbalance, spring, spring_force
    integer :: j, m

    violation = 0.0_dp
    m = size(problem%modes, 2)
    pass%modes => problem%modes
    pass%force => solution%force
    call pass%run(size(solution%force), 4*m)
    call pass%take(2*m + 1, sums, most)
    call space%add(sums)
    call space%raise(most)
    spring_force = largest_spring_force(problem, solution%motion, most(:m))
    call find_extremes_of_bodies(problem, most(m + 1:), of_bodies(:m), of_bodies(m + 1:))
    call space%raise(of_bodies)
    do j = 1, m
      if (is_prescribed(problem, j)) cycle
      associate (resultant => problem%resultant(j), arm => most(j))
        own = max(of_bodies(j), spring_force)
        largest = max(largest_force, spring_force)
        if (of_bodies(m + j) > 0.0_dp) largest = own
        largest = ROUNDINGS*epsilon(largest)*arm*largest
        spring = problem%spring_load(j, solution%motion(j))
        imbalance = max(abs((sums(j) - resultant) + spring) - largest, 0.0_dp)
        if (abs(resultant) > 0.0_dp) own = 0.0_dp
        violation = max(violation, relative(imbalance, max(sums(m + j), abs(resultant), abs(spring), BESIDE*arm*own)))
      end associate
    end do
  end function imbalance_in_modes

  !> Chunk `k`, the points `first` .. `last`.
  subroutine survey_modes(self, k, first, last)
    class(mode_pass), intent(inout) :: self
    integer, intent(in) :: k, first, last
    real(dp) :: arm, force, sums(2), term
    integer :: i, j, m

    m = size(self%modes, 2)
    do j = 1, m
      sums = 0.0_dp
      arm = 0.0_dp
      force = 0.0_dp
      do i = first, last
        if (.not. abs(self%modes(i, j)) > 0.0_dp) cycle
        if (abs(self%modes(i, j)) > arm) arm = abs(self%modes(i, j))
        if (.not. abs(self%force(i)) > 0.0_dp) cycle
        if (abs(self%force(i)) > force) force = abs(self%force(i))
        term = self%modes(i, j)*self%force(i)
        sums = sums + [term, abs(term)]
      end do
      self%found([j, m + j, 2*m + j, 3*m + j], k) = [sums, arm, force]
    end do
  end subroutine survey_modes

  !> Of the points of this rank that a mode moves, the `largest` force (m) of their bodies, -huge if there are no such
  !> points, and 1 if a load acts on any of them, else 0: `loaded` (m). `by_mode` (m) are the largest forces.
  subroutine find_extremes_of_bodies(problem, by_mode, largest, loaded)
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: by_mode(:)
    real(dp), intent(out) :: largest(:), loaded(:)
    integer :: i, j

    largest = -huge(largest)
    loaded = 0.0_dp
    do j = 1, size(by_mode)
      do i = 1, size(by_mode)
        if (.not. move_a_point_together(problem%modes(:, i), problem%modes(:, j))) cycle
        largest(j) = max(largest(j), by_mode(i))
        if (is_prescribed(problem, i)) cycle
        if (abs(problem%resultant(i)) > 0.0_dp) loaded(j) = 1.0_dp
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
  !> that it carries under `motion` (m), over the largest displacement of its mode, `arms` (m).
  pure function largest_spring_force(problem, motion, arms) result(largest)
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: motion(:), arms(:)
    real(dp) :: largest
    real(dp) :: load
    integer :: j

    largest = 0.0_dp
    do j = 1, size(motion)
      load = abs(problem%spring_load(j, motion(j)))
      if (load > 0.0_dp .and. arms(j) > 0.0_dp) largest = max(largest, load/arms(j))
    end do
  end function largest_spring_force

end module fuge_load_balance
