!> The gaps that give a wanted pressure.
!>
!> The forces say how far the points are displaced, and the gap equation which gaps they close: one product. So any
!> forces that the law of the points allows can be had.
module fuge_wanted_pressure
  use fuge_constants, only: LARGEST_EXPONENT
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_operator_type, only: fuge_operator
  use fuge_point_law, only: point_law
  use fuge_point_space, only: point_space
  use fuge_problem_type, only: check_problem, copy_problem, fuge_problem
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_CALL_ORDER, FUGE_ERR_GAP, &
    FUGE_ERR_NOT_FINITE, FUGE_ERR_OVERFLOW, FUGE_ERR_SIZE, FUGE_WARN_UNREACHABLE
  implicit none
  private

  public :: fuge_gap_for_pressure

  !> Initial gaps and loads, and the forces that they give.
  type, public :: fuge_wanted_contact
    !> Initial gaps, (n), length.
    real(dp), allocatable :: gap(:)
    !> Forces that these give, (n), force: those wanted, or the nearest that a point can have.
    real(dp), allocatable :: force(:)
    !> Resultants of the forces, (m): the loads that belong to them; where a motion is prescribed, its reaction.
    real(dp), allocatable :: resultant(:)
  end type fuge_wanted_contact

contains

  !> The initial gaps for which the contact of `problem` has the forces `force`, by one product.
  !>
  !> `operator` with n points. `problem` with the modes, prescribed motions and laws of the points; its gap and
  !> resultant are what is looked for, and need not be allocated. `force` (n) wanted, force: pressures times the areas
  !> of the points. `clearance` >= 0, length: the gap that is left under load where no force is wanted, at most the
  !> play; with zero these points just touch. On return `wanted`: its gaps and resultants in the place of those of
  !> `problem` give its forces, and the only ones where the problem has one solution: on a surface that is periodic in
  !> all directions a prescribed approach does not say how much an even pressure is in whole contact. A free translation
  !> takes up a constant; where it is the only motion the smallest gap is zero. Other free motions are zero.
  !> FUGE_WARN_UNREACHABLE if a point cannot have its force: none that pulls at a lower stop, none beyond a limit, none
  !> where excluded; the message has the number of such points, and the first. Errors, which leave `wanted` untouched:
  !> those of the problem's checks, FUGE_ERR_CALL_ORDER for an operator that is not set, FUGE_ERR_SIZE,
  !> FUGE_ERR_NOT_FINITE, FUGE_ERR_GAP for a negative clearance, FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY, those of the
  !> product.
  subroutine fuge_gap_for_pressure(operator, problem, force, clearance, wanted, info)
    use fuge_operator_products, only: multiply
    use fuge_problem_modes, only: resultants_of
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: force(:), clearance
    type(fuge_wanted_contact), intent(inout) :: wanted
    type(fuge_info), intent(out) :: info
    type(fuge_wanted_contact) :: new
    type(fuge_problem) :: laws
    type(point_space) :: space
    integer :: stat

    space = operator%ranks()
    call check_wishes(operator, force, clearance, space, info)
    if (.not. info%failed()) call set_laws(problem, operator%points(), laws, info)
    if (.not. info%failed()) call check_problem(laws, operator%points(), info)
    if (.not. info%failed()) then
      allocate (new%gap(size(force)), new%force(size(force)), new%resultant(laws%mode_count()), stat=stat)
      call require_memory(stat, 'the gaps of', size(force), 'points', info)
    end if
    call space%agree(info)
    if (info%failed()) return
    call limit_forces(laws, force, space, new%force, info)
    call multiply(operator, new%force, new%gap, info)
    if (info%failed()) return
    call find_gaps(operator, laws, clearance, space, new)
    new%resultant = resultants_of(laws, new%force, space)
    if (.not. space%everywhere(all(abs(new%gap) <= huge(1.0_dp)) .and. all(abs(new%resultant) <= huge(1.0_dp)))) then
      call report(info, FUGE_ERR_OVERFLOW, 'the gaps or the resultants are out of the range of double precision: ' &
                  //'choose other units')
      return
    end if
    call move_alloc(new%gap, wanted%gap)
    call move_alloc(new%force, wanted%force)
    call move_alloc(new%resultant, wanted%resultant)
  end subroutine fuge_gap_for_pressure

  subroutine check_wishes(operator, force, clearance, space, info)
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: force(:), clearance
    type(point_space), intent(in) :: space
    type(fuge_info), intent(inout) :: info

    ! A rank may have no points of those that it shares.
    if (space%total_count(operator%points()) < 1) then
      call report(info, FUGE_ERR_CALL_ORDER, 'the operator is not set: set it first')
    else if (size(force) /= operator%points()) then
      call report(info, FUGE_ERR_SIZE, 'force has '//text(size(force))//' value(s): it needs '//text(operator%points()))
    else if (.not. abs(clearance) <= huge(clearance)) then
      call report(info, FUGE_ERR_NOT_FINITE, 'clearance = '//text(clearance)//' is not a finite number')
    else if (clearance < 0.0_dp) then
      call report(info, FUGE_ERR_GAP, 'clearance = '//text(clearance)//' is negative: bodies cannot overlap')
    else
      call check_finite(force, 'force', info)
      if (info%failed() .or. size(force) < 1) return
      if (exponent(maxval(abs(force))) > LARGEST_EXPONENT) call report(info, FUGE_ERR_OVERFLOW, 'force reaches 2**' &
        //text(exponent(maxval(abs(force))))//': choose units in which it is smaller')
    end if
  end subroutine check_wishes

  !> The problem with gaps and resultants of its sizes, whose values are not used.
  subroutine set_laws(problem, n, laws, info)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: n
    type(fuge_problem), intent(inout) :: laws
    type(fuge_info), intent(inout) :: info
    integer :: stat

    call copy_problem(problem, laws, info)
    if (info%failed()) return
    if (allocated(laws%gap)) deallocate (laws%gap)
    if (allocated(laws%resultant)) deallocate (laws%resultant)
    allocate (laws%gap(n), laws%resultant(laws%mode_count()), stat=stat)
    call require_memory(stat, 'the gaps of', n, 'points', info)
    if (stat /= 0) return
    laws%gap = 0.0_dp
    laws%resultant = 1.0_dp
  end subroutine set_laws

  !> The forces that the points can have and that are nearest to `force`, (n). Warning: FUGE_WARN_UNREACHABLE.
  subroutine limit_forces(problem, force, space, reached, info)
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: force(:)
    type(point_space), intent(in) :: space
    real(dp), intent(out) :: reached(:)
    type(fuge_info), intent(inout) :: info
    type(point_law) :: law
    character(len=:), allocatable :: example
    integer :: first, k, number

    do k = 1, size(force)
      law = problem%law(k)
      reached(k) = min(max(force(k), law%least_force()), law%most_force())
    end do
    number = space%total_count(count(abs(reached - force) > 0.0_dp))
    if (number < 1) return
    example = ''
    first = first_difference(force, reached)
    if (space%is_alone()) example = ', as point '//index_text(first)//' with '//text(force(first))//' instead of ' &
                                    //text(reached(first))
    call report(info, FUGE_WARN_UNREACHABLE, text(number)//' point(s) cannot have the force wanted'//example &
                //': a point cannot pull at a lower stop, nor have more than its limit, nor anything where excluded')
  end subroutine limit_forces

  pure function first_difference(a, b) result(first)
    real(dp), intent(in) :: a(:), b(:)
    integer :: first

    do first = 1, size(a)
      if (abs(a(first) - b(first)) > 0.0_dp) return
    end do
  end function first_difference

  !> From displacements (A - datum) f, which wanted%gap has, to gaps g = c - (A + D) f + R q, with the prescribed
  !> motions q, and free ones zero.
  subroutine find_gaps(operator, problem, clearance, space, wanted)
    use fuge_problem_modes, only: add_rigid_displacement, free_translation
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: clearance
    type(point_space), intent(in) :: space
    type(fuge_wanted_contact), intent(inout) :: wanted
    real(dp) :: datum, translation(problem%mode_count())
    type(point_law) :: law
    integer :: k

    datum = operator%datum()*space%total(sum(wanted%force))
    translation = free_translation(problem, space)
    if (any(abs(translation) > 0.0_dp)) datum = 0.0_dp
    if (allocated(problem%compliance)) wanted%gap = wanted%gap + problem%compliance*wanted%force
    wanted%gap = -(wanted%gap + datum)
    call add_rigid_displacement(problem, problem%prescribed_motion(), wanted%gap)
    do k = 1, size(wanted%gap)
      law = problem%law(k)
      if (wanted%force(k) < 0.0_dp) then
        ! A tied point pulls where it is.
        wanted%gap(k) = wanted%gap(k) + law%play
      else if (.not. wanted%force(k) > 0.0_dp) then
        wanted%gap(k) = wanted%gap(k) + min(clearance, law%play)
      end if
    end do
    if (size(translation) == 1 .and. any(abs(translation) > 0.0_dp)) wanted%gap = wanted%gap &
      - space%least(minval(wanted%gap))
  end subroutine find_gaps

end module fuge_wanted_pressure
