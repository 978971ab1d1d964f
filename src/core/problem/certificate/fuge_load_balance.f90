!> Equilibrium of the forces of a solution, equation (11), for its certificate.
module fuge_load_balance
  use fuge_data_scales, only: free_resultant, is_prescribed
  use fuge_kinds, only: dp
  use fuge_point_chunks, only: chunked_pass, CHUNK
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

  !> A pass over the forces and the modes. Found, (4 m): as from `survey_modes`.
  type, extends(chunked_pass) :: mode_pass
    real(dp), pointer, contiguous :: modes(:, :) => null(), force(:) => null()
  contains
    procedure :: do_chunk
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

    violation = 0.0_dp
    if (allocated(problem%prescribed)) violation = motion_error(problem, solution%motion, problem%motion)
    if (allocated(problem%modes)) then
      violation = max(violation, imbalance_in_modes( &
        problem, problem%modes, solution%force, solution%motion, forces(3), space))
    else if (.not. is_prescribed(problem, 1)) then
      violation = max(violation, imbalance_of_load(problem, solution%motion, forces))
    end if
  end function equilibrium_violation

  !> How far `motion` (m) is from what the problem has `prescribed` (m), where it has.
  pure function motion_error(problem, motion, prescribed) result(violation)
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: motion(:), prescribed(:)
    real(dp) :: violation
    integer :: j

    violation = 0.0_dp
    do j = 1, size(motion)
      if (is_prescribed(problem, j)) violation = max(violation, relative(abs(motion(j) - prescribed(j)), &
                                                                         abs(prescribed(j))))
    end do
  end function motion_error

  !> Equation (11) for one free translation, `motion` (1). `forces` as above.
  pure function imbalance_of_load(problem, motion, forces) result(violation)
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: motion(:), forces(3)
    real(dp) :: violation
    real(dp) :: load, spring

    load = free_resultant(problem, 1)
    spring = problem%spring_load(1, motion(1))
    violation = relative(abs((forces(1) - load) + spring), max(forces(2), abs(load), abs(spring)))
  end function imbalance_of_load

  !> Equation (11) in the free modes of a problem that has modes, relative to the terms of the sum; without a resultant
  !> at least to a fraction of the largest force of the body, since along an axis without a load forces at tied points
  !> may be the rounding of those along the other axes.
  !>
  !> `modes` (n, m), `force` (n) and `motion` (m) of the problem and the solution, whose own arrays may begin with
  !> another number than 1.
  function imbalance_in_modes(problem, modes, force, motion, largest_force, space) result(violation)
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in), contiguous, target :: modes(:, :), force(:)
    real(dp), intent(in) :: motion(:), largest_force
    type(point_space), intent(in) :: space
    real(dp) :: violation
    real(dp) :: found(4*size(motion)), of_bodies(2*size(motion))
    real(dp) :: own, largest, imbalance, spring_force
    integer :: j, m

    violation = 0.0_dp
    m = size(motion)
    call survey_all_modes(modes, force, found)
    call space%add(found(:2*m))
    call space%raise(found(2*m + 1:))
    spring_force = largest_spring_force(problem, motion, found(2*m + 1:3*m))
    call find_extremes_of_bodies(problem, modes, found(3*m + 1:), of_bodies(:m), of_bodies(m + 1:))
    call space%raise(of_bodies)
    do j = 1, m
      if (is_prescribed(problem, j)) cycle
      associate (resultant => free_resultant(problem, j), spring => problem%spring_load(j, motion(j)), &
                 arm => found(2*m + j))
        own = max(of_bodies(j), spring_force)
        largest = max(largest_force, spring_force)
        if (of_bodies(m + j) > 0.0_dp) largest = own
        largest = ROUNDINGS*epsilon(largest)*arm*largest
        imbalance = max(abs((found(j) - resultant) + spring) - largest, 0.0_dp)
        if (abs(resultant) > 0.0_dp) own = 0.0_dp
        violation = max(violation, relative(imbalance, max(found(m + j), abs(resultant), abs(spring), BESIDE*arm*own)))
      end associate
    end do
  end function imbalance_in_modes

  !> `survey_modes` of all points, in chunks: `found` (4 m).
  subroutine survey_all_modes(modes, force, found)
    real(dp), intent(in), contiguous, target :: modes(:, :), force(:)
    real(dp), intent(out), contiguous :: found(:)
    type(mode_pass) :: pass
    integer :: half

    if (size(force) <= CHUNK) then
      call survey_modes(modes, force, 1, size(force), found)
    else
      pass%modes => modes
      pass%force => force
      call pass%run(size(force), size(found))
      half = size(found)/2
      call pass%take(half + 1, found(:half), found(half + 1:))
    end if
  end subroutine survey_all_modes

  !> Chunk `k`, the points `first` .. `last`.
  subroutine do_chunk(self, k, first, last)
    class(mode_pass), intent(inout) :: self
    integer, intent(in) :: k, first, last

    call survey_modes(self%modes, self%force, first, last, self%found(:, k))
  end subroutine do_chunk

  !> `found` (4 m) of the points `first` .. `last`: for each of the `modes` (n, m) the sum of the terms of the resultant
  !> of the `force` (n), that of their magnitudes, the largest displacement of a point, and the largest force at a point
  !> that the mode moves; zero without points.
  pure subroutine survey_modes(modes, force, first, last, found)
    real(dp), intent(in), contiguous :: modes(:, :), force(:)
    integer, intent(in) :: first, last
    real(dp), intent(out), contiguous :: found(:)
    real(dp) :: arm, largest, term, total, total_magnitude
    integer :: i, j, m

    m = size(modes, 2)
    do j = 1, m
      total = 0.0_dp
      total_magnitude = 0.0_dp
      arm = 0.0_dp
      largest = 0.0_dp
      do i = first, last
        if (.not. abs(modes(i, j)) > 0.0_dp) cycle
        if (abs(modes(i, j)) > arm) arm = abs(modes(i, j))
        if (.not. abs(force(i)) > 0.0_dp) cycle
        if (abs(force(i)) > largest) largest = abs(force(i))
        term = modes(i, j)*force(i)
        total = total + term
        total_magnitude = total_magnitude + abs(term)
      end do
      found(j) = total
      found(m + j) = total_magnitude
      found(2*m + j) = arm
      found(3*m + j) = largest
    end do
  end subroutine survey_modes

  !> Of the points of this rank that a mode moves, the `largest` force (m) of their bodies, -huge if there are no such
  !> points, and 1 if a load acts on any of them, else 0: `loaded` (m). `modes` (n, m); `by_mode` (m) are the largest
  !> forces.
  subroutine find_extremes_of_bodies(problem, modes, by_mode, largest, loaded)
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in), contiguous :: modes(:, :)
    real(dp), intent(in) :: by_mode(:)
    real(dp), intent(out) :: largest(:), loaded(:)
    integer :: i, j

    largest = -huge(largest)
    loaded = 0.0_dp
    do j = 1, size(by_mode)
      do i = 1, size(by_mode)
        if (.not. move_a_point_together(modes(:, i), modes(:, j))) cycle
        largest(j) = max(largest(j), by_mode(i))
        if (abs(free_resultant(problem, i)) > 0.0_dp) loaded(j) = 1.0_dp
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
