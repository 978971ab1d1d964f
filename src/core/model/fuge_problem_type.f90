!> The contact problem without its operator, its solution, and the check of its data.
!>
!>     c = gap + A f - R q      R^T f = w
!>     one-sided:  c >= 0, f >= 0, f c = 0
!>     with play d:  0 <= c <= d;  f >= 0 where c = 0, f <= 0 where c = d, f = 0 between
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
  use fuge_number_text, only: index_text, text
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, &
    FUGE_ERR_NO_EQUILIBRIUM, FUGE_ERR_OVERFLOW, FUGE_ERR_GAP
  implicit none
  private

  public :: set_problem, check_problem, check_load, check_play, move_solution

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
  contains
    procedure :: points
    procedure :: mode_count
    procedure :: is_plain
    procedure :: prescribed_motion
  end type fuge_problem

  !> The solution of a contact problem, in the same units.
  type, public :: fuge_solution
    !> Contact forces f, (n), force; negative only at the upper stop and at tied points.
    real(dp), allocatable :: force(:)
    !> Gaps c under load, (n), length; negative only where excluded.
    real(dp), allocatable :: gap(:)
    !> Motions q in the rigid modes, (m), prescribed ones included; for one translation the
    !> approach v_0, length.
    real(dp), allocatable :: motion(:)
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

    plain = .not. (allocated(self%modes) .or. allocated(self%gap_upper) .or. allocated(self%excluded))
    if (plain .and. allocated(self%prescribed)) plain = .not. any(self%prescribed)
  end function is_plain

  !> The prescribed motions, zero where free, (m).
  pure function prescribed_motion(self) result(values)
    class(fuge_problem), intent(in) :: self
    real(dp) :: values(self%mode_count())

    values = 0.0_dp
    if (allocated(self%prescribed)) where (self%prescribed) values = self%motion
  end function prescribed_motion

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
  !> (FUGE_ERR_NO_EQUILIBRIUM) or one below the smallest normal number (FUGE_ERR_OVERFLOW).
  pure subroutine check_problem(problem, n, info)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: n
    type(fuge_info), intent(inout) :: info

    call check_length(problem%gap, n, 'gap', info)
    if (.not. info%failed()) call check_values(problem%gap, 'gap', info)
    if (.not. info%failed()) call check_stops(problem, n, info)
    if (.not. info%failed()) call check_modes(problem, n, info)
  end subroutine check_problem

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
    logical :: free(problem%mode_count())
    integer :: j, m

    m = problem%mode_count()
    free = .true.
    if (allocated(problem%modes)) then
      if (size(problem%modes, 1) /= n) then
        call report(info, FUGE_ERR_SIZE, 'modes has '//text(size(problem%modes, 1))//' rows: it needs one for ' &
                    //'each of '//text(n)//' points')
        return
      end if
      do j = 1, m
        call check_values(problem%modes(:, j), 'mode '//index_text(j)//' at point ', info)
        if (info%failed()) return
      end do
    end if
    if (allocated(problem%prescribed)) then
      if (size(problem%prescribed) /= m) then
        call report(info, FUGE_ERR_SIZE, 'prescribed has '//text(size(problem%prescribed))//' value(s): it needs ' &
                    //text(m))
        return
      end if
      free = .not. problem%prescribed
      call check_length(problem%motion, m, 'motion', info)
      if (info%failed()) return
      call check_values(merge(problem%motion, 0.0_dp, problem%prescribed), 'prescribed motion', info)
      if (info%failed()) return
    end if
    if (.not. any(free)) return
    call check_length(problem%resultant, m, 'resultant', info)
    if (info%failed()) return
    if (problem%is_plain()) then
      call check_load(problem%resultant(1), info)
    else
      call check_values(merge(problem%resultant, 0.0_dp, free), 'resultant', info)
    end if
  end subroutine check_modes

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
  end subroutine move_solution

end module fuge_problem_type
