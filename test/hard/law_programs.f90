!> Problems with laws of points as quadratic programs in a box, in quadruple precision. Of the library only the types
!> are used.
!>
!> Where a point has play, its force is the difference of two variables, those of its stops, and where it is tied, one
!> variable of either sign.
module law_programs
  use, intrinsic :: iso_fortran_env, only: qp => real128
  use fuge_kinds, only: dp
  use fuge_problem_type, only: fuge_problem
  use general_reference, only: is_excluded, is_prescribed, modes_of, play_of
  implicit none
  private

  public :: compliance_of, gradient_of, has_independent_modes, is_definite, limits_of, list_motions, modes_of_free, &
    rank_of, set_equations, set_program, violation_of

  !> Stands for infinity in limits and plays.
  real(qp), parameter, public :: NONE = 1.0e4000_qp
  !> Pivots below this fraction of the largest entry are rounding.
  real(qp), parameter, public :: SINGULAR = 1.0e-24_qp

  !> A problem in its variables: minimise v.Hv/2 + cost.v with low <= v <= high and B v + S q = w. Forces are
  !> sign*v at their points, in units in which the diagonal of A + D is 1.
  type, public :: box_program
    integer, allocatable :: point(:)
    real(qp), allocatable :: sign(:), low(:), high(:), cost(:), hessian(:, :), rows(:, :), stiffness(:), resultant(:)
    !> Units: force at a point, motion in a mode, and all of them together.
    real(qp), allocatable :: force_unit(:), motion_unit(:)
    real(qp) :: size = 1.0_qp
    !> The same of gaps and prescribed motions by themselves.
    real(qp) :: size_of_data = 1.0_qp
    integer, allocatable :: free(:)
  contains
    procedure :: variables
    procedure :: motions
  end type box_program

contains

  pure integer function variables(self)
    class(box_program), intent(in) :: self

    variables = size(self%point)
  end function variables

  pure integer function motions(self)
    class(box_program), intent(in) :: self

    motions = size(self%free)
  end function motions

  !> Limits of the force of a point, at the lower stop and at the upper one; infinity is NONE.
  pure function limits_of(problem, point) result(limits)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: point
    real(qp) :: limits(2)

    limits = NONE
    if (allocated(problem%limit)) then
      if (problem%limit(point) <= huge(1.0_dp)) limits(1) = real(problem%limit(point), qp)
    end if
    if (allocated(problem%limit_upper)) then
      if (problem%limit_upper(point) <= huge(1.0_dp)) limits(2) = real(problem%limit_upper(point), qp)
    end if
    if (play_of(problem, point) > huge(1.0_dp)) limits(2) = 0.0_qp
    if (is_excluded(problem, point)) limits = 0.0_qp
  end function limits_of

  !> The free modes, and the stiffness of their springs.
  pure subroutine list_motions(problem, free, stiffness)
    type(fuge_problem), intent(in) :: problem
    integer, allocatable, intent(out) :: free(:)
    real(qp), allocatable, intent(out) :: stiffness(:)
    integer :: j

    free = pack([(j, j=1, problem%mode_count())], [(.not. is_prescribed(problem, j), j=1, problem%mode_count())])
    allocate (stiffness(size(free)))
    stiffness = 0.0_qp
    if (allocated(problem%motion_stiffness)) stiffness = real(problem%motion_stiffness(free), qp)
  end subroutine list_motions

  pure function modes_of_free(problem, free) result(modes)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: free(:)
    real(dp) :: modes(problem%points(), size(free)), all_modes(problem%points(), problem%mode_count())

    all_modes = modes_of(problem)
    modes = all_modes(:, free)
  end function modes_of_free

  !> The variables of a problem, and the units of its points and modes.
  pure subroutine set_program(alpha, problem, program)
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    type(box_program), intent(out) :: program
    real(qp), allocatable :: compliance(:, :), gap(:), modes(:, :)
    real(qp) :: limits(2), play, moved(problem%points())
    integer :: k, n

    n = problem%points()
    call list_motions(problem, program%free, program%stiffness)
    allocate (compliance(n, n), gap(n), modes(n, program%motions()))
    compliance = compliance_of(alpha, problem)
    gap = gap_of(problem)
    modes = real(modes_of_free(problem, program%free), qp)
    call choose_units(compliance, modes, program)
    allocate (program%resultant(program%motions()), program%point(0), program%sign(0), program%low(0), &
              program%high(0), program%cost(0))
    program%resultant = 0.0_qp
    if (program%motions() > 0) program%resultant = real(problem%resultant(program%free), qp)*program%motion_unit
    program%stiffness = program%stiffness*program%motion_unit**2
    gap = gap*program%force_unit
    do k = 1, n
      modes(k, :) = modes(k, :)*program%force_unit(k)*program%motion_unit
      compliance(k, :) = compliance(k, :)*program%force_unit(k)*program%force_unit
    end do
    program%size = max(maxval(abs(gap)), maxval([0.0_qp, abs(program%resultant)]))
    if (.not. program%size > 0.0_qp) program%size = 1.0_qp
    moved = 0.0_qp
    if (allocated(problem%prescribed)) moved = matmul(abs(real(modes_of(problem), qp)), &
                                                      abs(real(problem%prescribed_motion(), qp)))
    program%size_of_data = max(program%size, maxval((abs(real(problem%gap, qp)) + moved)*program%force_unit))
    program%resultant = program%resultant/program%size
    do k = 1, n
      limits = limits_of(problem, k)
      where (limits < NONE) limits = limits/(program%force_unit(k)*program%size)
      play = NONE
      if (play_of(problem, k) <= huge(1.0_dp)) play = real(play_of(problem, k), qp)*program%force_unit(k)
      if (.not. play > 0.0_qp) then
        call add_variable(k, 1.0_qp, -limits(2), limits(1), gap(k)/program%size, program)
      else
        call add_variable(k, 1.0_qp, 0.0_qp, limits(1), gap(k)/program%size, program)
        if (play < NONE) call add_variable(k, -1.0_qp, 0.0_qp, limits(2), (play - gap(k))/program%size, program)
      end if
    end do
    program%hessian = compliance(program%point, program%point)
    program%rows = transpose(modes(program%point, :))
    do k = 1, program%variables()
      program%hessian(:, k) = program%sign*program%hessian(:, k)*program%sign(k)
      program%rows(:, k) = program%rows(:, k)*program%sign(k)
    end do
  end subroutine set_program

  !> A variable more, unless its bounds are one.
  pure subroutine add_variable(point, sign, low, high, cost, program)
    integer, intent(in) :: point
    real(qp), intent(in) :: sign, low, high, cost
    type(box_program), intent(inout) :: program

    if (.not. high > low) return
    program%point = [program%point, point]
    program%sign = [program%sign, sign]
    program%low = [program%low, low]
    program%high = [program%high, high]
    program%cost = [program%cost, cost]
  end subroutine add_variable

  !> A + D.
  pure function compliance_of(alpha, problem) result(compliance)
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    real(qp) :: compliance(problem%points(), problem%points())
    integer :: k

    compliance = real(alpha, qp)
    if (.not. allocated(problem%compliance)) return
    do k = 1, size(compliance, 1)
      compliance(k, k) = compliance(k, k) + real(problem%compliance(k), qp)
    end do
  end function compliance_of

  !> Initial gaps less the prescribed motions.
  pure function gap_of(problem) result(gap)
    type(fuge_problem), intent(in) :: problem
    real(qp) :: gap(problem%points())
    real(dp) :: modes(problem%points(), problem%mode_count())
    integer :: j

    modes = modes_of(problem)
    gap = real(problem%gap, qp)
    do j = 1, problem%mode_count()
      if (is_prescribed(problem, j)) gap = gap - real(modes(:, j), qp)*real(problem%motion(j), qp)
    end do
  end function gap_of

  !> Units in which the diagonal of A + D is 1, and the largest coefficient of each mode.
  pure subroutine choose_units(compliance, modes, program)
    real(qp), intent(in) :: compliance(:, :), modes(:, :)
    type(box_program), intent(inout) :: program
    real(qp) :: largest
    integer :: j, k

    allocate (program%force_unit(size(compliance, 1)), program%motion_unit(size(modes, 2)))
    largest = maxval([(compliance(k, k), k=1, size(compliance, 1))])
    if (.not. largest > 0.0_qp) largest = 1.0_qp
    do k = 1, size(compliance, 1)
      program%force_unit(k) = 1.0_qp/sqrt(merge(compliance(k, k), largest, compliance(k, k) > 0.0_qp))
    end do
    do j = 1, size(modes, 2)
      largest = maxval(abs(modes(:, j)*program%force_unit))
      if (.not. largest > 0.0_qp) largest = 1.0_qp
      program%motion_unit(j) = 1.0_qp/largest
    end do
  end subroutine choose_units

  !> Have the forces of all points that can have one a unique answer?
  pure function is_definite(alpha, problem, program) result(definite)
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    type(box_program), intent(in) :: program
    logical :: definite
    real(qp) :: matrix(problem%points(), problem%points())
    integer :: j, k, n
    logical :: carries(problem%points())

    n = problem%points()
    matrix = compliance_of(alpha, problem)
    carries = [(any(program%point == k), k=1, n)]
    do k = 1, n
      matrix(k, :) = matrix(k, :)*program%force_unit(k)*program%force_unit
    end do
    definite = .true.
    do k = 1, n
      if (.not. carries(k)) cycle
      definite = definite .and. matrix(k, k) > SINGULAR
      if (.not. definite) return
      do j = k + 1, n
        if (carries(j)) matrix(k + 1:, j) = matrix(k + 1:, j) - matrix(k + 1:, k)*(matrix(k, j)/matrix(k, k))
      end do
    end do
  end function is_definite

  !> Derivative of the energy in each variable.
  pure function gradient_of(program, v, q) result(gradient)
    type(box_program), intent(in) :: program
    real(qp), intent(in) :: v(:), q(:)
    real(qp) :: gradient(size(v))

    gradient = matmul(program%hessian, v) + program%cost - matmul(q, program%rows)
  end function gradient_of

  !> The distance of an answer from the projection of its step along the gradient, and the resultant left.
  pure function violation_of(program, v, q) result(violation)
    type(box_program), intent(in) :: program
    real(qp), intent(in) :: v(:), q(:)
    real(qp) :: violation
    real(qp) :: gradient(size(v)), left(size(q))

    gradient = gradient_of(program, v, q)
    left = program%resultant - program%stiffness*q - matmul(program%rows, v)
    gradient = v - min(max(v - gradient, program%low), program%high)
    violation = maxval([0.0_qp, abs(gradient)]) + maxval([0.0_qp, abs(left)])
  end function violation_of

  !> The equations of the variables that are between their bounds, and of the motions.
  pure subroutine set_equations(program, between, matrix)
    type(box_program), intent(in) :: program
    integer, intent(in) :: between(:)
    real(qp), allocatable, intent(out) :: matrix(:, :)
    integer :: k, nb

    nb = size(between)
    allocate (matrix(nb + program%motions(), nb + program%motions()))
    matrix = 0.0_qp
    matrix(:nb, :nb) = program%hessian(between, between)
    matrix(:nb, nb + 1:) = -transpose(program%rows(:, between))
    matrix(nb + 1:, :nb) = program%rows(:, between)
    do k = 1, program%motions()
      matrix(nb + k, nb + k) = program%stiffness(k)
    end do
  end subroutine set_equations

  !> Are the modes of the points that can have a force independent of each other, springs included?
  pure function has_independent_modes(alpha, problem) result(independent)
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    logical :: independent
    type(box_program) :: program

    call set_program(alpha, problem, program)
    independent = rank_of(program, spread(.true., 1, program%variables())) == program%motions()
  end function has_independent_modes

  !> The rank of the modes at these variables, springs included.
  pure integer function rank_of(program, among)
    type(box_program), intent(in) :: program
    logical, intent(in) :: among(:)
    real(qp), parameter :: NO_RANK = 1.0e-9_qp
    real(qp) :: work(size(among) + program%motions(), program%motions())
    integer :: j, k, place(2)

    work = 0.0_qp
    do k = 1, size(among)
      if (among(k)) work(k, :) = program%rows(:, k)
    end do
    do j = 1, program%motions()
      if (program%stiffness(j) > 0.0_qp) work(size(among) + j, j) = 1.0_qp
    end do
    rank_of = 0
    do j = 1, program%motions()
      place = maxloc(abs(work))
      if (.not. abs(work(place(1), place(2))) > NO_RANK) return
      rank_of = rank_of + 1
      work(:, place(2)) = work(:, place(2))/work(place(1), place(2))
      do k = 1, program%motions()
        if (k /= place(2)) work(:, k) = work(:, k) - work(:, place(2))*work(place(1), k)
      end do
      work(:, place(2)) = 0.0_qp
      work(place(1), :) = 0.0_qp
    end do
  end function rank_of

end module law_programs
