!> The operator of points and motions on springs in units that make all of them similar, for an iteration that needs no
!> springs of its own.
!>
!> A spring on a motion is a tied point more, which that motion alone moves (fuge_spring_matrix): its arm is how far.
!> The square of the arm over the stiffness is the compliance of this point. A soft point has a unit of force of its
!> own, and for the sake of symmetry one of length as many times larger as that is smaller. With the right arms and
!> units all compliances are as large as those of the bodies. Then forces, lengths and energies of springs, be they soft
!> or stiff, compare with those of other points, and rounding at springs is rounding elsewhere: a soft point that is
!> squeezed far does not hide the gaps of the others in the last digits of its own. All units are powers of two, so that
!> nothing is rounded.
module fuge_scaled_springs
  use fuge_constants, only: LARGEST_EXPONENT
  use fuge_contact_states, only: FUGE_AT_LOWER_STOP
  use fuge_kinds, only: dp
  use fuge_operator_products, only: multiply
  use fuge_operator_type, only: fuge_operator
  use fuge_problem_type, only: copy_problem, fuge_problem, fuge_solution
  use fuge_status, only: fuge_info, require_memory, FUGE_DONE
  implicit none
  private

  !> The unit of a spring is no smaller than this: a motion that it holds alone would not count as held. Where it should
  !> be smaller than `SOFTEST`, the spring would be far stiffer than other points.
  real(dp), parameter :: SHORTEST = 1.0e-6_dp, SOFTEST = 1.0e-15_dp

  !> Points are soft, and have a unit of their own, from this multiple of the compliance of the bodies on.
  real(dp), parameter :: SOFT = 1.0e3_dp
  !> Forces up to this many units in the last place of the largest force are rounding.
  real(dp), parameter :: ROUNDINGS = 4.0_dp
  !> Without a load, forces that displace less than this fraction of the lengths are rounding.
  real(dp), parameter :: NO_LENGTH = 1.0e-14_dp

  !> Call `set`, then `attach` it to an operator. Copies are allowed of one that is detached.
  type, extends(fuge_operator), public :: scaled_springs
    private
    !> The operator of the contact points, with their compliances.
    class(fuge_operator), pointer :: attached => null()
    !> Number of contact points.
    integer :: contact_points = 0
    !> The force of each point in the scaled problem times this is the force, (n + s); lengths are divided by it.
    real(dp), allocatable :: unit(:)
    !> The compliances of the points of springs in the scaled problem, (s), and of the bodies, length per force; of hard
    !> bodies on springs that of the stiffest spring.
    real(dp), allocatable :: compliance(:)
    real(dp) :: usual = 0.0_dp
  contains
    procedure :: set
    procedure :: attach
    procedure :: detach
    procedure :: spring_points
    procedure :: scale_problem
    procedure :: scale_changes
    procedure :: scale_forces
    procedure :: drop_rounding
    procedure :: restore
    procedure :: points
    procedure :: apply
    procedure :: magnitude => find_magnitude
    procedure :: least_pair_compliance
    procedure :: has_preconditioner
    procedure :: precondition
  end type scaled_springs

contains

  !> Choose the units for `problem`, on `operator`, which is without springs; `extended` is the problem with a point
  !> more for each spring on a motion. `possible` unless a spring is so soft that its motion is all but free. Errors:
  !> FUGE_ERR_MEMORY, those of the operator.
  subroutine set(self, operator, problem, extended, possible, info)
    class(scaled_springs), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem, extended
    logical, intent(out) :: possible
    type(fuge_info), intent(inout) :: info
    logical :: on_spring(problem%mode_count())
    integer :: j, k, n, stat

    possible = .true.
    n = problem%points()
    on_spring = problem%motions_on_springs()
    self%contact_points = n
    if (allocated(self%unit)) deallocate (self%unit, self%compliance)
    allocate (self%unit(extended%points()), self%compliance(extended%points() - n), stat=stat)
    call require_memory(stat, 'the units of', n, 'points', info)
    if (stat == 0) call find_usual_compliance(operator, problem, self%usual, info)
    if (info%failed()) return
    self%unit = 1.0_dp
    if (allocated(problem%compliance)) then
      where (problem%compliance > SOFT*self%usual) self%unit(:n) = similar_unit(SOFT*self%usual, problem%compliance)
    end if
    if (.not. self%usual > 0.0_dp .and. any(on_spring)) self%usual = stiffest_spring(problem, on_spring)
    k = 0
    do j = 1, size(on_spring)
      if (.not. on_spring(j)) cycle
      k = k + 1
      associate (arm => extended%modes(n + k, j), unit => self%unit(n + k), stiffness => problem%motion_stiffness(j))
        if (self%usual > 0.0_dp) unit = sqrt(self%usual)*(sqrt(stiffness)/arm)
        possible = possible .and. unit >= SOFTEST .and. 2*exponent(arm) - exponent(stiffness) <= LARGEST_EXPONENT
        if (.not. possible) return
        unit = max(unit, SHORTEST)
        unit = set_exponent(1.0_dp, exponent(unit))
        self%compliance(k) = (arm*unit)*(arm*unit/stiffness)
      end associate
    end do
  end subroutine set

  !> The compliance of the stiffest one of the springs that are marked, (m), length per force; 0 if all are too soft.
  pure function stiffest_spring(problem, on_spring) result(compliance)
    type(fuge_problem), intent(in) :: problem
    logical, intent(in) :: on_spring(:)
    real(dp) :: compliance
    real(dp) :: arm(size(on_spring)), each
    integer :: j

    compliance = huge(compliance)
    arm = problem%arms()
    do j = 1, size(on_spring)
      if (.not. on_spring(j)) cycle
      if (.not. arm(j) > 0.0_dp) arm(j) = 1.0_dp
      if (2*exponent(arm(j)) - exponent(problem%motion_stiffness(j)) > LARGEST_EXPONENT) cycle
      each = arm(j)*(arm(j)/problem%motion_stiffness(j))
      compliance = min(compliance, each)
    end do
    if (.not. compliance < huge(compliance)) compliance = 0.0_dp
  end function stiffest_spring

  !> The unit in which `compliance` is about the `usual` one.
  elemental function similar_unit(usual, compliance) result(unit)
    real(dp), intent(in) :: usual, compliance
    real(dp) :: unit

    unit = sqrt(usual)/sqrt(compliance)
    unit = set_exponent(1.0_dp, exponent(unit))
  end function similar_unit

  !> About the compliance of the bodies, the geometric mean of the displacements by forces of alternating signs; of
  !> rigid bodies the largest one of their points, 0 if all are hard. Errors: FUGE_ERR_MEMORY, those of the operator.
  subroutine find_usual_compliance(operator, problem, usual, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(out) :: usual
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: displacement(:), wave(:)
    integer :: k, n, stat

    usual = 0.0_dp
    n = problem%points()
    allocate (displacement(n), wave(n), stat=stat)
    call require_memory(stat, 'a product of', n, 'points', info)
    if (stat /= 0) return
    wave = [(real(1 - 2*modulo(k, 2), dp), k=1, n)]
    ! A constant displacement is one too.
    wave(1) = 2.0_dp*wave(1)
    call multiply(operator, wave, displacement, info)
    if (info%failed()) return
    displacement = abs(displacement + operator%datum()*sum(wave))
    if (any(displacement > 0.0_dp)) usual = exp(sum(log(displacement), mask=displacement > 0.0_dp) &
                                                /real(count(displacement > 0.0_dp), dp))
    if (.not. usual > 0.0_dp .and. allocated(problem%compliance)) usual = maxval(problem%compliance)
    usual = max(usual, 0.0_dp)
  end subroutine find_usual_compliance

  !> Use `operator`, which has the compliances of the contact points; it must be a target for as long as this one is
  !> used.
  subroutine attach(self, operator)
    class(scaled_springs), intent(inout) :: self
    class(fuge_operator), intent(in), target :: operator

    self%attached => operator
  end subroutine attach

  !> Forget the operator.
  subroutine detach(self)
    class(scaled_springs), intent(inout) :: self

    self%attached => null()
  end subroutine detach

  !> Number of the points that stand for springs on motions.
  pure function spring_points(self) result(number)
    class(scaled_springs), intent(in) :: self
    integer :: number

    number = size(self%compliance)
  end function spring_points

  !> The problem `extended` in the units of this operator. Error: FUGE_ERR_MEMORY.
  subroutine scale_problem(self, extended, scaled, info)
    class(scaled_springs), intent(in) :: self
    type(fuge_problem), intent(in) :: extended
    type(fuge_problem), intent(out) :: scaled
    type(fuge_info), intent(inout) :: info
    integer :: j, stat

    call copy_problem(extended, scaled, info)
    if (info%failed() .or. .not. any(abs(self%unit - 1.0_dp) > 0.0_dp)) return
    if (.not. allocated(scaled%modes)) then
      allocate (scaled%modes(size(self%unit), extended%mode_count()), stat=stat)
      call require_memory(stat, 'the modes of', size(self%unit), 'points', info)
      if (stat /= 0) return
      scaled%modes = 1.0_dp
    end if
    do j = 1, size(scaled%modes, 2)
      scaled%modes(:, j) = self%unit*scaled%modes(:, j)
    end do
    scaled%gap = self%unit*scaled%gap
    if (allocated(scaled%gap_upper)) scaled%gap_upper = self%unit*scaled%gap_upper
    if (allocated(scaled%limit)) scaled%limit = scaled%limit/self%unit
    if (allocated(scaled%limit_upper)) scaled%limit_upper = scaled%limit_upper/self%unit
  end subroutine scale_problem

  !> Changes of the gaps of contact points, (n), in the units of this operator, (n + s).
  pure function scale_changes(self, gap_change) result(scaled)
    class(scaled_springs), intent(in) :: self
    real(dp), intent(in) :: gap_change(:)
    real(dp) :: scaled(size(self%unit))

    scaled = 0.0_dp
    scaled(:self%contact_points) = self%unit(:self%contact_points)*gap_change
  end function scale_changes

  !> Forces (n + s) in the units of this operator.
  pure function scale_forces(self, force) result(scaled)
    class(scaled_springs), intent(in) :: self
    real(dp), intent(in) :: force(:)
    real(dp) :: scaled(size(self%unit))

    scaled = force/self%unit
  end function scale_forces

  !> Set forces of the `solution` of the `scaled` problem to zero that are rounding of the largest one, and without a
  !> load all of them if they displace nothing beside the gaps; `largest` is that of the forces in contact that are
  !> left.
  subroutine drop_rounding(self, scaled, solution, largest)
    class(scaled_springs), intent(in) :: self
    type(fuge_problem), intent(in) :: scaled
    type(fuge_solution), intent(inout) :: solution
    real(dp), intent(out) :: largest
    real(dp) :: length

    largest = maxval(abs(solution%force))
    length = 0.0_dp
    if (.not. any(abs(scaled%resultants()) > 0.0_dp)) then
      length = maxval(abs(scaled%gap))
      if (allocated(scaled%gap_upper)) then
        length = max(length, maxval(scaled%gap_upper, mask=scaled%gap_upper < huge(length)))
      end if
    end if
    if (self%usual*largest < NO_LENGTH*length) solution%force = 0.0_dp
    where (abs(solution%force) <= ROUNDINGS*epsilon(length)*largest) solution%force = 0.0_dp
    largest = maxval(abs(solution%force), mask=abs(solution%state) == FUGE_AT_LOWER_STOP)
    largest = max(largest, 0.0_dp)
  end subroutine drop_rounding

  !> Forces and gaps (n + s) from those in the units of this operator.
  pure subroutine restore(self, solution)
    class(scaled_springs), intent(in) :: self
    type(fuge_solution), intent(inout) :: solution

    solution%force = self%unit*solution%force
    solution%gap = solution%gap/self%unit
  end subroutine restore

  !> Number of points, n + s.
  pure function points(self) result(n)
    class(scaled_springs), intent(in) :: self
    integer :: n

    n = 0
    if (associated(self%attached)) n = size(self%unit)
  end function points

  !> As for `fuge_operator`. The datum is added, because springs have none.
  subroutine apply(self, force, displacement, status)
    class(scaled_springs), intent(in) :: self
    real(dp), intent(in) :: force(:)
    real(dp), intent(out) :: displacement(:)
    integer, intent(out) :: status
    real(dp) :: by_datum
    integer :: n

    n = self%contact_points
    call self%attached%apply(self%unit(:n)*force(:n), displacement(:n), status)
    displacement(n + 1:) = self%compliance*force(n + 1:)
    if (status /= FUGE_DONE) return
    by_datum = self%attached%datum()*dot_product(self%unit(:n), force(:n))
    displacement(:n) = self%unit(:n)*(displacement(:n) + by_datum)
  end subroutine apply

  !> As for `fuge_operator`.
  subroutine find_magnitude(self, force, displacement, magnitude)
    class(scaled_springs), intent(in) :: self
    real(dp), intent(in) :: force(:), displacement(:)
    real(dp), intent(out) :: magnitude(:)
    real(dp) :: by_datum
    integer :: n

    n = self%contact_points
    by_datum = self%attached%datum()*dot_product(self%unit(:n), force(:n))
    call self%attached%magnitude(self%unit(:n)*force(:n), displacement(:n)/self%unit(:n) - by_datum, magnitude(:n))
    magnitude(:n) = self%unit(:n)*(magnitude(:n) + abs(by_datum))
    magnitude(n + 1:) = self%compliance*abs(force(n + 1:))
  end subroutine find_magnitude

  !> That of the contact points, where these have the same unit, since a motion moves the point of its spring alone;
  !> else unknown.
  function least_pair_compliance(self, contact, modes) result(compliance)
    class(scaled_springs), intent(in) :: self
    logical, intent(in) :: contact(:)
    real(dp), intent(in) :: modes(:, :)
    real(dp) :: compliance
    integer :: n

    n = self%contact_points
    compliance = huge(compliance)
    if (any(self%unit(:n) < 1.0_dp)) return
    compliance = self%attached%least_pair_compliance(contact(:n), modes(:n, :))
  end function least_pair_compliance

  function has_preconditioner(self) result(preconditioned)
    class(scaled_springs), intent(in) :: self
    logical :: preconditioned

    preconditioned = self%attached%has_preconditioner()
  end function has_preconditioner

  !> As for `fuge_operator`, exact for the springs on motions.
  subroutine precondition(self, displacement, force, status)
    class(scaled_springs), intent(in) :: self
    real(dp), intent(in) :: displacement(:)
    real(dp), intent(out) :: force(:)
    integer, intent(out) :: status
    integer :: n

    n = self%contact_points
    call self%attached%precondition(displacement(:n)/self%unit(:n), force(:n), status)
    force(:n) = force(:n)/self%unit(:n)
    force(n + 1:) = displacement(n + 1:)/self%compliance
  end subroutine precondition

end module fuge_scaled_springs
