!> The contact problem without its operator, its solution, and the check of its data.
!>
!>     c = gap + A f - R q      R^T f = w
!>     one-sided:  c >= 0, f >= 0, f c = 0
!>     with play d:  0 <= c <= d;  f >= 0 where c = 0, f <= 0 where c = d, f = 0 between
!>
!> With compliances, limits of the forces and springs on the motions, (A + D) f and w - S q take the places of A f and
!> w; `fuge_point_law` has the law of a point then.
!>
!> These are Signorini's conditions: a linear complementarity problem, and for a symmetric
!> positive definite A the KKT conditions of a convex quadratic program, whose multipliers are
!> the gaps and the motions. In the paper's equations 9 to 11 R is the column of ones, q the
!> approach v_0 and w the load F_0. A play of zero ties a point: its gap stays zero, its force
!> has either sign.
module fuge_problem_type
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
  use fuge_constants, only: LARGEST_EXPONENT
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_law_checks, only: check_limits, check_stiffnesses
  use fuge_number_text, only: index_text, text
  use fuge_point_law, only: point_law
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, &
    FUGE_ERR_NO_EQUILIBRIUM, FUGE_ERR_OVERFLOW, FUGE_ERR_GAP
  implicit none
  private

  public :: copy_problem, set_problem, check_problem, check_load, check_play, move_solution

  !> The data of a contact problem except the operator, in the units of the operator. Set the
  !> components by name: later versions may have more. A component that is not allocated has the default
  !> that its comment gives.
  type, public :: fuge_problem
    !> Initial gap g at each point, (n), length: the sum of both bodies' distances from a common
    !> reference, displacements by external loads included. Its datum is free.
    real(dp), allocatable :: gap(:)
    !> Play d >= 0 between the lower and the upper stop, (n), length. Infinity: one-sided; 0: tied.
    !> Not allocated: one-sided everywhere.
    real(dp), allocatable :: gap_upper(:)
    !> Points excluded from contact, (n): no force, any gap. Not allocated: none.
    logical, allocatable :: excluded(:)
    !> Rigid modes R, (n, m), length per unit of the motion: how far each point closes (+) or
    !> opens (-) with each mode. Not allocated: one translation, a column of ones.
    real(dp), allocatable :: modes(:, :)
    !> Resultants w of the contact forces in the modes, (m), force times length per unit of the
    !> motion: the load F_0 for a translation, a moment for a rotation. Not read where prescribed.
    real(dp), allocatable :: resultant(:)
    !> Modes whose motion is prescribed instead of the resultant, (m). Not allocated: none.
    logical, allocatable :: prescribed(:)
    !> Prescribed motions q, (m), length for a translation; read where prescribed.
    real(dp), allocatable :: motion(:)
    !> Compliance of a spring between the bodies at each point (a gasket, a bed, a member), (n), length per force, >= 0:
    !> D = diag(compliance). Not allocated: none.
    real(dp), allocatable :: compliance(:)
    !> Limit of the force at the lower stop, (n), force, >= 0: hardness times area, the yield force of a support, the
    !> force at which a clamp slips. Infinity: none; 0: the point does not push. Not allocated: none.
    real(dp), allocatable :: limit(:)
    !> Limit of the size of the force at the upper stop, (n), force, >= 0; for a tied point, of a pulling force.
    real(dp), allocatable :: limit_upper(:)
    !> Stiffness of a spring on each motion, (m), >= 0, resultant per unit of the motion: S = diag(motion_stiffness).
    !> Not read where prescribed. Not allocated: none.
    real(dp), allocatable :: motion_stiffness(:)
  contains
    procedure :: points
    procedure :: has_limits
    procedure :: has_springs
    procedure :: has_law
    procedure :: law
    procedure :: spring_load
    procedure :: spring_loads
    procedure :: spring_count
    procedure :: stiffnesses
    procedure :: motions_on_springs
    procedure :: arms
    procedure :: mode_count
    procedure :: is_plain
    procedure :: has_one_load
    procedure :: prescribed_motion
    procedure :: resultants
  end type fuge_problem

  !> The solution of a contact problem, in the same units.
  type, public :: fuge_solution
    !> Contact forces f, (n), force; negative only at the upper stop and at tied points.
    real(dp), allocatable :: force(:)
    !> Gaps c under load, (n), length; negative only where excluded, and where the force has reached its limit.
    real(dp), allocatable :: gap(:)
    !> Motions q in the rigid modes, (m), prescribed ones included; for one translation the
    !> approach v_0, length.
    real(dp), allocatable :: motion(:)
    !> State of each point, (n): FUGE_AT_LOWER_STOP, FUGE_OPEN, FUGE_AT_UPPER_STOP, or where its force has reached the
    !> limit FUGE_LIMITED_LOWER, FUGE_LIMITED_UPPER. Only a solve sets it, not a derivative.
    integer, allocatable :: state(:)
  end type fuge_solution

contains

  !> Number of points n; 0 without gaps.
  pure function points(self) result(n)
    class(fuge_problem), intent(in) :: self
    integer :: n

    n = 0
    if (allocated(self%gap)) n = size(self%gap)
  end function points

  !> Number m of rigid modes, those with a prescribed motion included.
  pure function mode_count(self) result(m)
    class(fuge_problem), intent(in) :: self
    integer :: m

    m = 1
    if (allocated(self%modes)) m = size(self%modes, 2)
  end function mode_count

  !> Is it the paper's problem? One free translation, one-sided contact at all points.
  pure function is_plain(self) result(plain)
    class(fuge_problem), intent(in) :: self
    logical :: plain

    plain = self%has_one_load() .and. .not. self%has_springs()
  end function is_plain

  !> Is there one free translation, not on a spring, and one-sided contact at all points? Then the load cannot be
  !> negative, and without one nothing is displaced, whatever the compliances.
  pure function has_one_load(self)
    class(fuge_problem), intent(in) :: self
    logical :: has_one_load

    has_one_load = .not. (allocated(self%modes) .or. allocated(self%gap_upper) .or. allocated(self%excluded) &
                          .or. self%has_limits())
    if (has_one_load .and. allocated(self%prescribed)) has_one_load = .not. any(self%prescribed)
    if (has_one_load .and. allocated(self%motion_stiffness)) has_one_load = self%spring_count() < 1
  end function has_one_load

  !> Do forces have limits?
  pure function has_limits(self)
    class(fuge_problem), intent(in) :: self
    logical :: has_limits

    has_limits = allocated(self%limit) .or. allocated(self%limit_upper)
  end function has_limits

  !> Are there compliances at points, or springs on motions?
  pure function has_springs(self)
    class(fuge_problem), intent(in) :: self
    logical :: has_springs

    has_springs = allocated(self%compliance) .or. allocated(self%motion_stiffness)
  end function has_springs

  !> Is there more than hard contact: compliances, limits of forces, springs on motions?
  pure function has_law(self)
    class(fuge_problem), intent(in) :: self
    logical :: has_law

    has_law = self%has_limits() .or. self%has_springs()
  end function has_law

  !> The law of point `k`, huge where infinite. An excluded point has no force.
  pure function law(self, k)
    class(fuge_problem), intent(in) :: self
    integer, intent(in) :: k
    type(point_law) :: law

    ! The caller's arrays may begin with another number than 1.
    if (allocated(self%gap_upper)) law%play = min(self%gap_upper(lbound(self%gap_upper, 1) + k - 1), huge(law%play))
    if (allocated(self%limit)) law%limit = min(self%limit(lbound(self%limit, 1) + k - 1), huge(law%limit))
    if (allocated(self%limit_upper)) law%limit_upper = min(self%limit_upper(lbound(self%limit_upper, 1) + k - 1), &
                                                           huge(law%limit_upper))
    if (.not. allocated(self%excluded)) return
    if (self%excluded(lbound(self%excluded, 1) + k - 1)) law = point_law(limit=0.0_dp, limit_upper=0.0_dp)
  end function law

  !> What the spring on motion `j` takes of its resultant under `motion`, S q; zero without a spring, or where
  !> prescribed.
  pure function spring_load(self, j, motion) result(load)
    class(fuge_problem), intent(in) :: self
    integer, intent(in) :: j
    real(dp), intent(in) :: motion
    real(dp) :: load

    load = 0.0_dp
    if (.not. allocated(self%motion_stiffness)) return
    ! The caller's arrays may begin with another number than 1.
    load = self%motion_stiffness(lbound(self%motion_stiffness, 1) + j - 1)*motion
    if (.not. allocated(self%prescribed)) return
    if (self%prescribed(lbound(self%prescribed, 1) + j - 1)) load = 0.0_dp
  end function spring_load

  !> What the springs on the motions `motion` (m) take of the resultants, S q, (m); zero where prescribed.
  pure function spring_loads(self, motion) result(loads)
    class(fuge_problem), intent(in) :: self
    real(dp), intent(in) :: motion(:)
    real(dp) :: loads(size(motion))
    integer :: j

    do j = 1, size(motion)
      loads(j) = self%spring_load(j, motion(j))
    end do
  end function spring_loads

  !> The number of free motions that are on a spring.
  pure function spring_count(self)
    class(fuge_problem), intent(in) :: self
    integer :: spring_count

    spring_count = 0
    if (allocated(self%motion_stiffness)) spring_count = count(self%motions_on_springs())
  end function spring_count

  !> The stiffness of the spring on each motion, (m); zero where there is none, or the motion is prescribed.
  pure function stiffnesses(self)
    class(fuge_problem), intent(in) :: self
    real(dp) :: stiffnesses(self%mode_count())

    stiffnesses = 0.0_dp
    if (allocated(self%motion_stiffness)) stiffnesses = self%motion_stiffness
    if (allocated(self%prescribed)) where (self%prescribed) stiffnesses = 0.0_dp
  end function stiffnesses

  !> Which motions are free and on a spring, (m)?
  pure function motions_on_springs(self) result(on_spring)
    class(fuge_problem), intent(in) :: self
    logical :: on_spring(self%mode_count())
    real(dp) :: stiffness(self%mode_count())

    stiffness = self%stiffnesses()
    on_spring = stiffness > 0.0_dp
  end function motions_on_springs

  !> The largest displacement of a point by each mode, (m), length per unit of the motion; 0 where it moves none.
  pure function arms(self)
    class(fuge_problem), intent(in) :: self
    real(dp) :: arms(self%mode_count())
    integer :: j

    arms = 1.0_dp
    if (.not. allocated(self%modes)) return
    do j = 1, size(arms)
      arms(j) = max(maxval(abs(self%modes(:, lbound(self%modes, 2) + j - 1))), 0.0_dp)
    end do
  end function arms

  !> The prescribed motions, zero where free, (m).
  pure function prescribed_motion(self) result(values)
    class(fuge_problem), intent(in) :: self
    real(dp) :: values(self%mode_count())

    values = 0.0_dp
    if (allocated(self%prescribed)) where (self%prescribed) values = self%motion
  end function prescribed_motion

  !> The resultants, zero where the motion is prescribed, (m).
  pure function resultants(self) result(values)
    class(fuge_problem), intent(in) :: self
    real(dp) :: values(self%mode_count())

    values = 0.0_dp
    if (allocated(self%resultant)) values = self%resultant
    if (allocated(self%prescribed)) where (self%prescribed) values = 0.0_dp
  end function resultants

  !> Copy `problem`, to arrays that begin with 1. Error: FUGE_ERR_MEMORY.
  pure subroutine copy_problem(problem, copy, info)
    type(fuge_problem), intent(in) :: problem
    type(fuge_problem), intent(out) :: copy
    type(fuge_info), intent(inout) :: info
    integer :: stat

    stat = 0
    call copy_values(problem%gap, copy%gap, stat)
    call copy_values(problem%gap_upper, copy%gap_upper, stat)
    call copy_marks(problem%excluded, copy%excluded, stat)
    if (allocated(problem%modes) .and. stat == 0) then
      allocate (copy%modes(size(problem%modes, 1), size(problem%modes, 2)), source=problem%modes, stat=stat)
    end if
    call copy_values(problem%resultant, copy%resultant, stat)
    call copy_marks(problem%prescribed, copy%prescribed, stat)
    call copy_values(problem%motion, copy%motion, stat)
    call copy_values(problem%compliance, copy%compliance, stat)
    call copy_values(problem%limit, copy%limit, stat)
    call copy_values(problem%limit_upper, copy%limit_upper, stat)
    call copy_values(problem%motion_stiffness, copy%motion_stiffness, stat)
    call require_memory(stat, 'a copy of the problem of', problem%points(), 'points', info)
  end subroutine copy_problem

  !> Copy values that there are, unless memory was short before, `stat`.
  pure subroutine copy_values(values, copy, stat)
    real(dp), intent(in), allocatable :: values(:)
    real(dp), intent(inout), allocatable :: copy(:)
    integer, intent(inout) :: stat

    if (allocated(values) .and. stat == 0) allocate (copy(size(values)), source=values, stat=stat)
  end subroutine copy_values

  pure subroutine copy_marks(marks, copy, stat)
    logical, intent(in), allocatable :: marks(:)
    logical, intent(inout), allocatable :: copy(:)
    integer, intent(inout) :: stat

    if (allocated(marks) .and. stat == 0) allocate (copy(size(marks)), source=marks, stat=stat)
  end subroutine copy_marks

  !> The plain problem: `gap` (n), length, and one `load`, force. Error: FUGE_ERR_MEMORY.
  pure subroutine set_problem(gap, load, problem, info)
    real(dp), intent(in) :: gap(:), load
    type(fuge_problem), intent(out) :: problem
    type(fuge_info), intent(inout) :: info
    integer :: stat

    allocate (problem%gap(size(gap)), problem%resultant(1), stat=stat)
    call require_memory(stat, 'a copy of the gaps', info)
    if (stat /= 0) return
    problem%gap = gap
    problem%resultant = load
  end subroutine set_problem

  !> Refuse data that no engine can use, for an operator of `n` points: wrong sizes
  !> (FUGE_ERR_SIZE), NaN or infinity (FUGE_ERR_NOT_FINITE), numbers near overflow
  !> (FUGE_ERR_OVERFLOW), a negative play (FUGE_ERR_GAP), a negative load of a plain problem
  !> (FUGE_ERR_NO_EQUILIBRIUM) or one below the smallest normal number (FUGE_ERR_OVERFLOW), a negative compliance, limit
  !> or stiffness (FUGE_ERR_LAW).
  pure subroutine check_problem(problem, n, info)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: n
    type(fuge_info), intent(inout) :: info

    call check_length(problem%gap, n, 'gap', info)
    if (.not. info%failed()) call check_values(problem%gap, 'gap', info)
    if (.not. info%failed()) call check_stops(problem, n, info)
    ! Before the modes, whose load has another sign where a motion is on a spring.
    if (problem%has_law() .and. .not. info%failed()) call check_law(problem, n, info)
    if (.not. info%failed()) call check_modes(problem, n, info)
  end subroutine check_problem

  !> Check compliances, limits of forces and springs on motions.
  pure subroutine check_law(problem, n, info)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: n
    type(fuge_info), intent(inout) :: info

    call check_stiffnesses(problem%compliance, n, 'compliance', info)
    if (.not. info%failed()) call check_limits(problem%limit, n, 'limit', info)
    if (.not. info%failed()) call check_limits(problem%limit_upper, n, 'limit_upper', info)
    if (.not. info%failed()) call check_stiffnesses(problem%motion_stiffness, problem%mode_count(), &
                                                    'motion_stiffness', info)
  end subroutine check_law

  !> Check play and exclusions.
  pure subroutine check_stops(problem, n, info)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: n
    type(fuge_info), intent(inout) :: info

    if (allocated(problem%gap_upper)) then
      call check_length(problem%gap_upper, n, 'gap_upper', info)
      if (.not. info%failed()) call check_play(problem%gap_upper, info)
      if (info%failed()) return
    end if
    if (allocated(problem%excluded)) then
      if (size(problem%excluded) /= n) call report(info, FUGE_ERR_SIZE, 'excluded has '//text(size(problem%excluded)) &
                                                   //' value(s): it needs '//text(n))
    end if
  end subroutine check_stops

  !> Refuse a play that is NaN (FUGE_ERR_NOT_FINITE) or negative (FUGE_ERR_GAP).
  pure subroutine check_play(gap_upper, info)
    real(dp), intent(in) :: gap_upper(:)
    type(fuge_info), intent(inout) :: info
    integer :: k

    do k = 1, size(gap_upper)
      if (ieee_is_nan(gap_upper(k))) then
        call report(info, FUGE_ERR_NOT_FINITE, 'gap_upper('//index_text(k) &
                    //') is NaN: use infinity for one-sided contact')
      else if (gap_upper(k) < 0.0_dp) then
        call report(info, FUGE_ERR_GAP, 'gap_upper('//index_text(k)//') = '//text(gap_upper(k)) &
                    //' is negative: the upper stop would lie below the lower one; 0 ties the point')
      end if
      if (info%failed()) return
    end do
  end subroutine check_play

  !> Check modes, resultants and prescribed motions.
  pure subroutine check_modes(problem, n, info)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: n
    type(fuge_info), intent(inout) :: info
    integer :: j, m

    m = problem%mode_count()
    if (allocated(problem%modes)) then
      if (size(problem%modes, 1) /= n) then
        call report(info, FUGE_ERR_SIZE, 'modes has '//text(size(problem%modes, 1))//' rows: it needs one for ' &
                    //'each of '//text(n)//' points')
        return
      end if
      do j = 1, m
        call check_values(problem%modes(:, lbound(problem%modes, 2) + j - 1), 'mode '//index_text(j)//' at point ', &
                          info)
        if (info%failed()) return
      end do
    end if
    if (allocated(problem%prescribed)) then
      if (size(problem%prescribed) /= m) then
        call report(info, FUGE_ERR_SIZE, 'prescribed has '//text(size(problem%prescribed))//' value(s): it needs ' &
                    //text(m))
        return
      end if
      call check_length(problem%motion, m, 'motion', info)
      if (info%failed()) return
      call check_values(merge(problem%motion, 0.0_dp, problem%prescribed), 'prescribed motion', info)
      if (info%failed()) return
    end if
    call check_resultants(problem, m, info)
  end subroutine check_modes

  !> Check the resultants in the free ones of `m` modes.
  pure subroutine check_resultants(problem, m, info)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: m
    type(fuge_info), intent(inout) :: info

    if (m < 1) return
    if (allocated(problem%prescribed)) then
      if (all(problem%prescribed)) return
    end if
    if (.not. allocated(problem%resultant)) then
      call report(info, FUGE_ERR_SIZE, 'resultant is not allocated: it needs '//text(m)//' value(s), the load in ' &
                  //'each motion; where bodies are held instead, set prescribed to true and motion to 0')
      return
    end if
    call check_length(problem%resultant, m, 'resultant', info)
    if (info%failed()) return
    if (problem%has_one_load()) then
      call check_load(problem%resultant(lbound(problem%resultant, 1)), info)
    else if (allocated(problem%prescribed)) then
      call check_values(merge(0.0_dp, problem%resultant, problem%prescribed), 'resultant', info)
    else
      call check_values(problem%resultant, 'resultant', info)
    end if
  end subroutine check_resultants

  !> Refuse a load that is not finite (FUGE_ERR_NOT_FINITE), negative (FUGE_ERR_NO_EQUILIBRIUM), or so small that
  !> forces below it lose digits (FUGE_ERR_OVERFLOW).
  pure subroutine check_load(load, info)
    real(dp), intent(in) :: load
    type(fuge_info), intent(inout) :: info

    if (.not. ieee_is_finite(load)) then
      call report(info, FUGE_ERR_NOT_FINITE, 'load F_0 = '//text(load)//' is not a finite number')
    else if (load < 0.0_dp) then
      call report(info, FUGE_ERR_NO_EQUILIBRIUM, 'load F_0 = '//text(load) &
                  //' is negative: contact forces can only push, so F_0 must be >= 0')
    else if (load > 0.0_dp .and. load < tiny(load)) then
      call report(info, FUGE_ERR_OVERFLOW, 'load F_0 = '//text(load)//' is below '//text(tiny(load)) &
                  //', where double precision loses its digits: choose a smaller unit of force')
    end if
  end subroutine check_load

  !> Refuse values that are not finite, or too close to overflow to be summed.
  pure subroutine check_values(values, name, info)
    real(dp), intent(in) :: values(:)
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info
    integer :: power

    if (size(values) < 1) return
    call check_finite(values, name, info)
    if (info%failed()) return
    power = exponent(maxval(abs(values)))
    if (power > LARGEST_EXPONENT) call report(info, FUGE_ERR_OVERFLOW, name//' reaches 2**'//text(power) &
                                              //': choose units in which it is smaller')
  end subroutine check_values

  pure subroutine check_length(values, expected, name, info)
    real(dp), intent(in), allocatable :: values(:)
    integer, intent(in) :: expected
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info

    if (.not. allocated(values)) then
      call report(info, FUGE_ERR_SIZE, name//' is not allocated: it needs '//text(expected)//' value(s)')
    else if (size(values) /= expected) then
      call report(info, FUGE_ERR_SIZE, name//' has '//text(size(values))//' value(s): it needs ' &
        //text(expected))
    end if
  end subroutine check_length

  !> Move the arrays of `source` to `solution`.
  pure subroutine move_solution(source, solution)
    type(fuge_solution), intent(inout) :: source, solution

    call move_alloc(source%force, solution%force)
    call move_alloc(source%gap, solution%gap)
    call move_alloc(source%motion, solution%motion)
    call move_alloc(source%state, solution%state)
  end subroutine move_solution

end module fuge_problem_type
