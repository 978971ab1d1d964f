!> The influence matrix of points and motions on springs, so that engines for a matrix need no springs of their own.
!>
!> Compliances stand on the diagonal. A spring on a motion is a tied point more, which that motion alone moves, as far
!> as the point that it moves most, its arm: the force there times the arm is the part of the resultant that the spring
!> carries, so that it is compared with other forces. A spring far stiffer than the points that it holds would lose
!> their lengths in the rounding of other motions: its motion is held, prescribed as its load alone would move it, and
!> what the contact forces take back is a part of the matrix. The matrix is a copy, because that of the caller must stay
!> as it is.
module fuge_spring_matrix
  use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_value
  use, intrinsic :: iso_c_binding, only: c_long_long
  use fuge_compensated_sums, only: compensated_dot
  use fuge_constants, only: LARGEST_EXPONENT
  use fuge_kinds, only: dp
  use fuge_locks, only: new_stamp
  use fuge_matrix_operator, only: fuge_dense_operator
  use fuge_matrix_survey, only: matrix_survey, survey_matrix
  use fuge_number_text, only: index_text, text
  use fuge_problem_type, only: copy_problem, fuge_problem, fuge_solution
  use fuge_status, only: composed_message, fuge_info, report, require_memory, FUGE_ERR_OVERFLOW, FUGE_MESSAGE_LENGTH
  implicit none
  private

  !> A spring is stiff if its resultant moves it by less than this fraction of how far the points get.
  real(dp), parameter :: BELOW = 0.1_dp

  !> Motions are held by springs that give way by less than this fraction of what the points do.
  real(dp), parameter :: HELD = 2.0_dp**(-10)

  type, public :: spring_matrix
    private
    !> The matrix, (n + springs, n + springs); length per force.
    real(dp), allocatable :: alpha(:, :)
    !> What was made into it: the matrix of the caller, and the springs.
    integer(c_long_long) :: source = 0
    real(dp), allocatable :: compliance(:), motion_compliance(:)
    !> The numbers of the motions that are held, their stiffnesses, (h), and their modes, (n, h).
    integer, allocatable :: held(:)
    real(dp), allocatable :: held_stiffness(:), held_modes(:, :)
    type(matrix_survey) :: survey
    integer(c_long_long) :: stamp = 0
  contains
    procedure :: set
    procedure :: as_operator
    procedure :: held_changes
    procedure :: find_held_motions
    procedure :: clear
  end type spring_matrix

  public :: balance_springs, extend_problem, find_spring_motions, hold_stiff_motions, name_springs, needs_springs, &
    scale_force_error, shift_spring_forces, strip_solution

contains

  !> Add the springs of `problem` to the matrix of `operator`, unless that was done before. Motions on springs that
  !> `holding`, as from `hold_stiff_motions`, prescribes have no point. Errors: FUGE_ERR_MEMORY, FUGE_ERR_OVERFLOW for a
  !> stiffness so small that its compliance overflows.
  subroutine set(self, operator, problem, info, holding)
    class(spring_matrix), intent(inout) :: self
    class(fuge_dense_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_info), intent(inout) :: info
    type(fuge_problem), intent(in), optional :: holding
    type(spring_matrix) :: wanted
    real(dp), dimension(problem%spring_count()) :: stiffness, arm
    logical :: on_spring(problem%mode_count()), is_held(problem%mode_count())
    integer :: j, k, n, stat

    n = operator%points()
    on_spring = problem%motions_on_springs()
    is_held = .false.
    if (present(holding)) is_held = on_spring .and. .not. holding%motions_on_springs()
    wanted%held = pack([(j, j=1, size(is_held))], is_held)
    allocate (wanted%compliance(n), wanted%held_modes(n, size(wanted%held)), stat=stat)
    call require_memory(stat, 'the springs of', n, 'points', info)
    if (stat /= 0) return
    wanted%compliance = 0.0_dp
    if (allocated(problem%compliance)) wanted%compliance = problem%compliance
    stiffness = spring_stiffnesses(problem)
    arm = spring_arms(problem)
    do k = 1, size(stiffness)
      if (2*exponent(arm(k)) - exponent(stiffness(k)) <= LARGEST_EXPONENT) cycle
      call report(info, FUGE_ERR_OVERFLOW, 'motion_stiffness reaches down to '//text(stiffness(k)) &
                  //': choose units in which it is larger, or 0 for no spring')
      return
    end do
    wanted%motion_compliance = pack(arm*(arm/stiffness), .not. pack(is_held, on_spring))
    wanted%held_stiffness = pack(stiffness, pack(is_held, on_spring))
    do k = 1, size(wanted%held)
      wanted%held_modes(:, k) = mode_of(problem, wanted%held(k))
    end do
    if (is_same(self, operator, wanted)) return
    call self%clear()
    call fill(self, operator, wanted, info)
  end subroutine set

  !> Make the matrix of `operator` and the springs that are `wanted`. Error: FUGE_ERR_MEMORY.
  subroutine fill(self, operator, wanted, info)
    class(spring_matrix), intent(inout) :: self
    class(fuge_dense_operator), intent(in) :: operator
    type(spring_matrix), intent(inout) :: wanted
    type(fuge_info), intent(inout) :: info
    real(dp) :: arm(size(wanted%held))
    integer :: h, k, n, points, stat

    n = operator%points()
    ! Products of modes alone may leave the range of numbers.
    arm = maxval(abs(wanted%held_modes), dim=1)
    where (.not. arm > 0.0_dp) arm = 1.0_dp
    points = n + size(wanted%motion_compliance)
    allocate (self%alpha(points, points), stat=stat)
    call require_memory(stat, 'the influence matrix with springs of', n, 'points', info)
    if (stat /= 0) return
    do k = 1, n
      self%alpha(:n, k) = operator%alpha(:n, k)
      self%alpha(n + 1:, k) = 0.0_dp
      self%alpha(k, k) = self%alpha(k, k) + wanted%compliance(k)
      do h = 1, size(wanted%held)
        self%alpha(:n, k) = self%alpha(:n, k) + (wanted%held_modes(:, h)/arm(h))*(wanted%held_modes(k, h)/arm(h)) &
                            *(arm(h)*(arm(h)/wanted%held_stiffness(h)))
      end do
    end do
    do k = 1, points - n
      self%alpha(:, n + k) = 0.0_dp
      self%alpha(n + k, n + k) = wanted%motion_compliance(k)
    end do
    call survey_matrix(self%alpha, self%survey)
    call move_alloc(wanted%compliance, self%compliance)
    call move_alloc(wanted%motion_compliance, self%motion_compliance)
    call move_alloc(wanted%held, self%held)
    call move_alloc(wanted%held_stiffness, self%held_stiffness)
    call move_alloc(wanted%held_modes, self%held_modes)
    self%source = operator%stamp()
    self%stamp = new_stamp()
  end subroutine fill

  !> Was the matrix made of the same one, and the springs that are `wanted`?
  pure function is_same(self, operator, wanted) result(same)
    type(spring_matrix), intent(in) :: self, wanted
    type(fuge_dense_operator), intent(in) :: operator
    logical :: same

    same = allocated(self%alpha) .and. self%source > 0 .and. self%source == operator%stamp()
    if (same) same = size(self%motion_compliance) == size(wanted%motion_compliance) &
                     .and. size(self%compliance) == size(wanted%compliance) &
                     .and. size(self%held) == size(wanted%held)
    if (same) same = .not. (any(abs(self%motion_compliance - wanted%motion_compliance) > 0.0_dp) &
                            .or. any(abs(self%compliance - wanted%compliance) > 0.0_dp) &
                            .or. any(self%held /= wanted%held) &
                            .or. any(abs(self%held_stiffness - wanted%held_stiffness) > 0.0_dp) &
                            .or. any(abs(self%held_modes - wanted%held_modes) > 0.0_dp))
  end function is_same

  !> The displacement of each point by a unit of a motion, (n).
  pure function mode_of(problem, motion) result(mode)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: motion
    real(dp) :: mode(problem%points())

    mode = 1.0_dp
    if (allocated(problem%modes)) mode = problem%modes(:, motion)
  end function mode_of

  !> The same problem, `holding` the motions whose springs are far stiffer than the points or other springs: they are
  !> prescribed as their loads alone would move them. The rounding of the coefficients must not hide softer points, so
  !> each point gives way by much more than the spring, or not at all. Error: FUGE_ERR_MEMORY.
  subroutine hold_stiff_motions(operator, problem, holding, info)
    class(fuge_dense_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_problem), intent(out) :: holding
    type(fuge_info), intent(inout) :: info
    real(dp) :: own(problem%points()), added(problem%points()), given(problem%mode_count()), most
    real(dp), dimension(problem%spring_count()) :: arm, compliance
    logical :: left(problem%spring_count())
    integer :: j, k, motion(problem%spring_count())

    call copy_problem(problem, holding, info)
    if (info%failed() .or. problem%spring_count() < 1) return
    motion = pack([(j, j=1, problem%mode_count())], problem%motions_on_springs())
    arm = spring_arms(problem)
    compliance = arm*(arm/spring_stiffnesses(problem))
    own = [(abs(operator%alpha(k, k)), k=1, size(own))]
    if (allocated(problem%compliance)) own = own + problem%compliance
    if (allocated(problem%excluded)) where (problem%excluded) own = 0.0_dp
    most = max(maxval(own), maxval(compliance))
    ! `set` refuses a spring that soft.
    if (.not. most <= huge(most)) return
    given = 0.0_dp
    if (allocated(problem%prescribed)) given = problem%prescribed_motion()
    left = .true.
    do k = 1, size(motion)
      j = minloc(compliance, dim=1, mask=left)
      left(j) = .false.
      if (.not. compliance(j) <= HELD*most) exit
      added = mode_of(problem, motion(j))/arm(j)
      added = added*added*compliance(j)
      if (any(own > 0.0_dp .and. added > HELD*own)) cycle
      own = own + added
      if (.not. allocated(holding%prescribed)) holding%prescribed = spread(.false., 1, size(given))
      holding%prescribed(motion(j)) = .true.
      given(motion(j)) = problem%resultant(motion(j))/problem%motion_stiffness(motion(j))
    end do
    if (allocated(holding%prescribed)) holding%motion = given
  end subroutine hold_stiff_motions

  !> Changes of resultants, (m), with those of the held motions instead where these are prescribed.
  pure function held_changes(self, load_change) result(changes)
    class(spring_matrix), intent(in) :: self
    real(dp), intent(in) :: load_change(:)
    real(dp) :: changes(size(load_change))

    changes = load_change
    changes(self%held) = load_change(self%held)/self%held_stiffness
  end function held_changes

  !> The held ones of the motions (m), from their loads (m) and what the forces of the points, (at least n), take of
  !> them.
  pure subroutine find_held_motions(self, load, force, motion)
    class(spring_matrix), intent(in) :: self
    real(dp), intent(in) :: load(:), force(:)
    real(dp), intent(inout) :: motion(:)
    integer :: h

    do h = 1, size(self%held)
      associate (j => self%held(h), of_points => force(:size(self%compliance)))
        motion(j) = compensated_dot(load(j), self%held_modes(:, h), of_points)/self%held_stiffness(h)
      end associate
    end do
  end subroutine find_held_motions

  !> Forget the matrix and release its memory.
  pure subroutine clear(self)
    class(spring_matrix), intent(inout) :: self

    if (allocated(self%alpha)) deallocate (self%alpha)
    if (allocated(self%compliance)) deallocate (self%compliance)
    if (allocated(self%motion_compliance)) deallocate (self%motion_compliance)
    if (allocated(self%held)) deallocate (self%held, self%held_stiffness, self%held_modes)
    self%source = 0
  end subroutine clear

  !> The matrix as an operator, which points to it: `self` must be a target for as long as it is used.
  subroutine as_operator(self, operator)
    class(spring_matrix), intent(in), target :: self
    type(fuge_dense_operator), intent(out) :: operator

    call operator%set_surveyed(self%alpha, self%survey, self%stamp)
  end subroutine as_operator

  !> Is there any spring? Compliances of zero are none, nor are stiffnesses of zero or of prescribed motions.
  pure function needs_springs(problem)
    type(fuge_problem), intent(in) :: problem
    logical :: needs_springs

    needs_springs = problem%spring_count() > 0
    if (allocated(problem%compliance)) needs_springs = needs_springs .or. any(problem%compliance > 0.0_dp)
  end function needs_springs

  pure function spring_stiffnesses(problem) result(stiffness)
    type(fuge_problem), intent(in) :: problem
    real(dp) :: stiffness(problem%spring_count())

    if (allocated(problem%motion_stiffness)) stiffness = pack(problem%motion_stiffness, problem%motions_on_springs())
  end function spring_stiffnesses

  !> The largest displacement of a point by each motion on a spring, length per unit of the motion; 1 where it moves
  !> none.
  pure function spring_arms(problem) result(arm)
    type(fuge_problem), intent(in) :: problem
    real(dp) :: arm(problem%spring_count())
    real(dp) :: largest(problem%mode_count())

    largest = problem%arms()
    where (.not. largest > 0.0_dp) largest = 1.0_dp
    arm = pack(largest, problem%motions_on_springs())
  end function spring_arms

  !> The same problem without springs, for the matrix that has them: motions on springs have a tied point more. Error:
  !> FUGE_ERR_MEMORY.
  subroutine extend_problem(problem, extended, info)
    type(fuge_problem), intent(in) :: problem
    type(fuge_problem), intent(out) :: extended
    type(fuge_info), intent(inout) :: info
    real(dp) :: infinity
    logical :: on_spring(problem%mode_count())
    real(dp) :: arm(problem%spring_count())
    integer :: j, m, n, springs, stat

    n = problem%points()
    m = problem%mode_count()
    on_spring = problem%motions_on_springs()
    arm = spring_arms(problem)
    springs = problem%spring_count()
    infinity = ieee_value(1.0_dp, ieee_positive_inf)
    call copy_problem(problem, extended, info)
    if (info%failed()) return
    if (allocated(extended%compliance)) deallocate (extended%compliance)
    if (allocated(extended%motion_stiffness)) deallocate (extended%motion_stiffness)
    call append(problem%gap, n, springs, 0.0_dp, 0.0_dp, extended%gap, stat)
    if (springs > 0) then
      if (stat == 0) call append(problem%gap_upper, n, springs, infinity, 0.0_dp, extended%gap_upper, stat)
      if (stat == 0 .and. allocated(problem%limit)) then
        call append(problem%limit, n, springs, infinity, infinity, extended%limit, stat)
      end if
      if (stat == 0 .and. allocated(problem%limit_upper)) then
        call append(problem%limit_upper, n, springs, infinity, infinity, extended%limit_upper, stat)
      end if
      if (stat == 0 .and. allocated(problem%excluded)) then
        deallocate (extended%excluded)
        allocate (extended%excluded(n + springs), stat=stat)
        if (stat == 0) extended%excluded(:n) = problem%excluded
        if (stat == 0) extended%excluded(n + 1:) = .false.
      end if
      if (allocated(extended%modes)) deallocate (extended%modes)
      if (stat == 0) allocate (extended%modes(n + springs, m), stat=stat)
    end if
    call require_memory(stat, 'the springs of', n, 'points', info)
    if (stat /= 0 .or. springs == 0) return
    extended%modes(:n, :) = 1.0_dp
    if (allocated(problem%modes)) extended%modes(:n, :) = problem%modes
    extended%modes(n + 1:, :) = 0.0_dp
    springs = 0
    do j = 1, m
      if (.not. on_spring(j)) cycle
      springs = springs + 1
      extended%modes(n + springs, j) = arm(springs)
    end do
  end subroutine extend_problem

  !> `values` (n), or `default` where not allocated, followed by `more` times `value`.
  pure subroutine append(values, n, more, default, value, longer, stat)
    real(dp), intent(in), allocatable :: values(:)
    integer, intent(in) :: n, more
    real(dp), intent(in) :: default, value
    real(dp), intent(inout), allocatable :: longer(:)
    integer, intent(out) :: stat

    if (allocated(longer)) deallocate (longer)
    allocate (longer(n + more), stat=stat)
    if (stat /= 0) return
    longer(:n) = default
    if (allocated(values)) longer(:n) = values
    longer(n + 1:) = value
  end subroutine append

  !> The problem `extended` for the forces that the springs have beyond `carried` (springs): what is carried already
  !> displaces the points of the springs, and is no load. The load that is left has digits of its own, also where it is
  !> the small difference of two large ones.
  pure subroutine shift_spring_forces(alpha, problem, extended, carried, shifted)
    real(dp), intent(in) :: alpha(:, :), carried(:)
    type(fuge_problem), intent(in) :: problem, extended
    type(fuge_problem), intent(out) :: shifted
    logical :: on_spring(problem%mode_count())
    integer :: j, point

    shifted = extended
    on_spring = problem%motions_on_springs()
    point = problem%points()
    do j = 1, size(on_spring)
      if (.not. on_spring(j)) cycle
      point = point + 1
      shifted%gap(point) = alpha(point, point)*carried(point - problem%points())
      shifted%resultant(j) = compensated_dot(extended%resultant(j), extended%modes(point:point, j), &
                                             carried(point - problem%points():point - problem%points()))
    end do
  end subroutine shift_spring_forces

  !> The motions on springs from the forces of these, where that has less rounding: of the largest force, instead of the
  !> largest displacement by any motion. `force` (n + springs) and `motion` (m) are those of the problem `extended`.
  pure subroutine find_spring_motions(problem, extended, force, motion)
    type(fuge_problem), intent(in) :: problem, extended
    real(dp), intent(in) :: force(:)
    real(dp), intent(inout) :: motion(:)
    logical :: on_spring(problem%mode_count())
    real(dp) :: displacement(extended%points()), arm(problem%spring_count()), flexibility
    integer :: j, spring

    if (problem%spring_count() < 1) return
    on_spring = problem%motions_on_springs()
    arm = spring_arms(problem)
    displacement = 0.0_dp
    do j = 1, size(on_spring)
      displacement = max(displacement, abs(extended%modes(:, j)*motion(j)))
    end do
    spring = 0
    do j = 1, size(on_spring)
      if (.not. on_spring(j)) cycle
      spring = spring + 1
      flexibility = arm(spring)/problem%motion_stiffness(j)
      if (maxval(displacement) > arm(spring)*flexibility*maxval(abs(force))) then
        motion(j) = force(problem%points() + spring)*flexibility
      end if
    end do
  end subroutine find_spring_motions

  !> Motions on springs from equilibrium with the forces of the points, for an iteration, which finds lengths to its
  !> tolerance only. Not those of softer springs: the points, which feel the other motions too, tell more of these.
  !> `force` (n + springs) and `motion` (m) are those of the problem `extended`.
  pure subroutine balance_springs(problem, extended, force, motion)
    type(fuge_problem), intent(in) :: problem, extended
    real(dp), intent(inout) :: force(:), motion(:)
    logical :: on_spring(problem%mode_count())
    real(dp) :: carried, length, terms
    integer :: j, n, spring

    n = problem%points()
    on_spring = problem%motions_on_springs()
    if (.not. any(on_spring)) return
    length = BELOW*maxval(abs(matmul(extended%modes(:n, :), motion)))
    spring = n
    do j = 1, size(on_spring)
      if (.not. on_spring(j)) cycle
      spring = spring + 1
      associate (stiffness => problem%motion_stiffness(j), load => problem%resultant(j), &
                 arm => extended%modes(spring, j))
        carried = compensated_dot(load, extended%modes(:n, j), force(:n))
        terms = abs(load) + sum(abs(extended%modes(:n, j)*force(:n)))
        if (arm*(terms/stiffness) > length) cycle
        force(spring) = carried/arm
        motion(j) = carried/stiffness
      end associate
    end do
  end subroutine balance_springs

  !> Make an error relative to the force `all_largest` relative to the largest one of those `of_points`.
  pure subroutine scale_force_error(all_largest, of_points, force_error)
    real(dp), intent(in) :: all_largest, of_points(:)
    real(dp), intent(inout) :: force_error
    real(dp) :: largest

    largest = maxval(abs(of_points))
    if (.not. all_largest > largest) return
    if (.not. largest > 0.0_dp) then
      force_error = 0.0_dp
    else if (force_error*all_largest < largest) then
      force_error = force_error*all_largest/largest
    else
      force_error = 1.0_dp
    end if
  end subroutine scale_force_error

  !> Where the message names the point of a spring, which the caller does not know, name the spring instead.
  pure subroutine name_springs(problem, info)
    type(fuge_problem), intent(in) :: problem
    type(fuge_info), intent(inout) :: info
    character(len=2*FUGE_MESSAGE_LENGTH) :: message
    logical :: on_spring(problem%mode_count())
    integer :: first, j, last, spring

    if (len_trim(info%message) == 0) return
    message = composed_message(info)
    on_spring = problem%motions_on_springs()
    spring = 0
    do j = 1, size(on_spring)
      if (.not. on_spring(j)) cycle
      spring = spring + 1
      associate (point => 'point '//index_text(problem%points() + spring))
        last = 1
        do
          first = last - 1 + index(message(last:), point)
          if (first < last) exit
          last = first + len(point)
          ! A larger number may begin with the same digits.
          if (scan(message(last:last), '0123456789') > 0) cycle
          message = message(:first - 1)//'the spring of motion '//index_text(j)//message(last:)
        end do
      end associate
    end do
    call report(info, info%status, trim(message))
  end subroutine name_springs

  !> Leave out the points of springs: a solution of `n` points. Error: FUGE_ERR_MEMORY.
  pure subroutine strip_solution(n, solution, info)
    integer, intent(in) :: n
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info
    integer, allocatable :: state(:)
    integer :: stat

    if (size(solution%force) == n) return
    call strip_values(n, solution%force, info)
    call strip_values(n, solution%gap, info)
    if (info%failed() .or. .not. allocated(solution%state)) return
    allocate (state, source=solution%state(:n), stat=stat)
    call require_memory(stat, 'the states of', n, 'points', info)
    if (stat == 0) call move_alloc(state, solution%state)
  end subroutine strip_solution

  !> The first `n` of `values`.
  pure subroutine strip_values(n, values, info)
    integer, intent(in) :: n
    real(dp), intent(inout), allocatable :: values(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: first(:)
    integer :: stat

    allocate (first, source=values(:n), stat=stat)
    call require_memory(stat, 'the solution of', n, 'points', info)
    if (stat == 0) call move_alloc(first, values)
  end subroutine strip_values

end module fuge_spring_matrix
