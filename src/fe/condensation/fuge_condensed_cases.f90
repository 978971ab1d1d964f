!> Load cases of a condensed body: from their loads to gaps and resultants, and from contact forces to displacements.
module fuge_condensed_cases
  use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
  use fuge_body_type, only: check_load_field
  use fuge_contact_modes, only: check_unresisted, load_resultant
  use fuge_contact_normals, only: add_contact_forces, point_displacement
  use fuge_held_body, only: add_motions, add_supports, find_residual, find_support_forces, held_body
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_load_cases_type, only: fuge_case_solutions, fuge_load_cases
  use fuge_number_text, only: index_text, text
  use fuge_status, only: composed_message, fuge_info, report, require_memory, FUGE_DONE, FUGE_ERR_CALL_ORDER, &
    FUGE_ERR_SIZE
  implicit none
  private

  public :: check_case_solutions, check_loads, condense_loads, find_case_displacements

  !> Load cases that are solved together.
  integer, parameter :: COLUMNS = 64

contains

  !> Displacements b of the contact points and resultants w of all load cases, as cases%gap and cases%load.
  subroutine condense_loads(held, loads, moved, cases, info)
    type(held_body), intent(in) :: held
    real(dp), intent(in) :: loads(:, :)
    real(dp), intent(in), allocatable :: moved(:, :)
    type(fuge_load_cases), intent(inout) :: cases
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: block(:, :)
    integer :: first, i, k, stat

    allocate (block(size(loads, 1), min(COLUMNS, size(loads, 2))), stat=stat)
    call require_memory(stat, 'the displacements due to the loads', info)
    cases%gap = 0.0_dp
    cases%load = 0.0_dp
    do first = 1, size(loads, 2), COLUMNS
      if (info%failed()) return
      associate (last => min(first + COLUMNS - 1, size(loads, 2)))
        do k = first, last
          call check_case(held, loads(:, k), cases%refused(k))
          block(:, k - first + 1) = 0.0_dp
          if (.not. cases%refused(k)%failed()) block(:, k - first + 1) = loads(:, k)
        end do
        call solve_loads(held, first, block(:, :last - first + 1), moved, stat)
        call require_memory(stat, 'the displacements due to the loads', info)
        if (stat /= 0) return
        do k = first, last
          if (cases%refused(k)%failed()) cycle
          do i = 1, size(cases%gap, 1)
            cases%gap(i, k) = point_displacement(held%body%dof(:, i), held%body%normal(:, i), block(:, k - first + 1))
          end do
          if (size(held%rigid_modes, 2) < 1) cycle
          cases%load(:, k) = load_resultant(held%rigid_modes, loads(:, k), held%scale, held%mode_error)
        end do
      end associate
    end do
  end subroutine condense_loads

  !> The report of one load case: can it be applied, and does it drive no rigid mode that no contact resists?
  subroutine check_case(held, load, info)
    type(held_body), intent(in) :: held
    real(dp), intent(in) :: load(:)
    type(fuge_info), intent(out) :: info

    call check_load_field(load, size(held%constrained), info)
    if (info%failed()) return
    call check_unresisted(held%unresisted_modes, load, held%scale, held%mode_error, info)
  end subroutine check_case

  !> Replace the external loads of the cases from number `first` on, (degrees, columns), by their displacements, those
  !> of the supports included.
  subroutine solve_loads(held, first, block, moved, stat)
    type(held_body), intent(in) :: held
    integer, intent(in) :: first
    real(dp), intent(inout), contiguous :: block(:, :)
    integer, intent(out) :: stat
    real(dp), intent(in), allocatable :: moved(:, :)
    real(dp), allocatable :: support_forces(:)
    integer :: k

    allocate (support_forces(size(block, 1)), stat=stat)
    if (stat == 0 .and. .not. allocated(moved)) &
      call find_support_forces(held, support_forces, stat, held%body%displacement)
    do k = 1, size(block, 2)
      if (stat == 0 .and. allocated(moved)) &
        call find_support_forces(held, support_forces, stat, moved(:, first + k - 1))
      if (stat /= 0) return
      block(:, k) = merge(0.0_dp, block(:, k) - support_forces, held%constrained)
    end do
    call held%factor%solve(block, stat)
    do k = 1, size(block, 2)
      if (allocated(moved)) then
        call add_supports(held, block(:, k), moved(:, first + k - 1))
      else
        call add_supports(held, block(:, k), held%body%displacement)
      end if
    end do
  end subroutine solve_loads

  !> Displacements `u` (degrees, cases) for the solutions of all load cases, as `recover_cases` of fuge_condensed.
  subroutine find_case_displacements(held, loads, moved, solutions, u, info)
    type(held_body), intent(in) :: held
    real(dp), intent(in) :: loads(:, :)
    real(dp), intent(in), allocatable :: moved(:, :)
    type(fuge_case_solutions), intent(inout) :: solutions
    real(dp), intent(inout) :: u(:, :)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: block(:, :)
    integer :: first, k, stat

    do k = 1, size(loads, 2)
      if (info%failed()) return
      if (.not. solutions%report(k)%failed()) call check_recovered_case(held, loads(:, k), solutions, k, info)
    end do
    if (info%failed()) return
    allocate (block(size(loads, 1), min(COLUMNS, size(loads, 2))), stat=stat)
    call require_memory(stat, 'the displacements of load cases', info)
    do first = 1, size(loads, 2), COLUMNS
      if (info%failed()) return
      associate (last => min(first + COLUMNS - 1, size(loads, 2)))
        do k = first, last
          block(:, k - first + 1) = 0.0_dp
          if (solutions%report(k)%failed()) cycle
          block(:, k - first + 1) = loads(:, k)
          call add_contact_forces(held%body, solutions%force(:, k), block(:, k - first + 1))
        end do
        call solve_loads(held, first, block(:, :last - first + 1), moved, stat)
        call require_memory(stat, 'the displacements of load cases', info)
        do k = first, last
          if (info%failed()) return
          u(:, k) = ieee_value(1.0_dp, ieee_quiet_nan)
          if (solutions%report(k)%failed()) cycle
          u(:, k) = block(:, k - first + 1)
          call complete_case(held, loads(:, k), solutions, k, u(:, k), info)
        end do
      end associate
    end do
  end subroutine find_case_displacements

  !> Refuse a load, forces or motions of case `k` that are not finite or out of range.
  pure subroutine check_recovered_case(held, load, solutions, k, info)
    type(held_body), intent(in) :: held
    real(dp), intent(in) :: load(:)
    type(fuge_case_solutions), intent(in) :: solutions
    integer, intent(in) :: k
    type(fuge_info), intent(inout) :: info

    call check_load_field(load, size(load), info)
    if (.not. info%failed()) call check_finite(solutions%force(:, k), 'force', info)
    if (.not. info%failed()) call check_finite(solutions%motion(:size(held%rigid_modes, 2), k), 'motion', info)
  end subroutine check_recovered_case

  !> Add the motions of case `k` to its displacements `u` (degrees), and find its residual: `info` has the largest one
  !> of all cases. Error: FUGE_ERR_MEMORY.
  subroutine complete_case(held, load, solutions, k, u, info)
    type(held_body), intent(in) :: held
    real(dp), intent(in) :: load(:)
    type(fuge_case_solutions), intent(inout) :: solutions
    integer, intent(in) :: k
    real(dp), intent(inout) :: u(:)
    type(fuge_info), intent(inout) :: info
    type(fuge_info) :: balance

    call add_motions(held, solutions%motion(:, k), u, balance)
    if (.not. balance%failed()) call find_residual(held, load, solutions%force(:, k), u, balance)
    if (balance%failed()) info = balance
    if (info%failed()) return
    if (balance%status /= FUGE_DONE .and. solutions%report(k)%status == FUGE_DONE) &
      call report(solutions%report(k), balance%status, composed_message(balance))
    if (balance%residual <= info%residual) return
    info%residual = balance%residual
    if (balance%status /= FUGE_DONE) call report(info, balance%status, 'load case '//index_text(k)//': ' &
                                                 //composed_message(balance))
  end subroutine complete_case

  !> Refuse solutions, or displacements, that do not fit the loads and this body.
  pure subroutine check_case_solutions(held, solutions, loads, displacements, info)
    type(held_body), intent(in) :: held
    type(fuge_case_solutions), intent(in) :: solutions
    integer, intent(in) :: loads(2), displacements(2)
    type(fuge_info), intent(inout) :: info

    if (.not. (allocated(solutions%force) .and. allocated(solutions%motion) .and. allocated(solutions%report))) then
      call report(info, FUGE_ERR_CALL_ORDER, 'the load cases have no forces: solve them first')
    else if (any(shape(solutions%force) /= [size(held%body%dof, 2), loads(2)]) &
             .or. size(solutions%motion, 1) < size(held%rigid_modes, 2) .or. size(solutions%motion, 2) /= loads(2) &
             .or. size(solutions%report) /= loads(2)) then
      call report(info, FUGE_ERR_SIZE, 'the solutions have '//text(size(solutions%force, 1))//' forces and ' &
                  //text(size(solutions%motion, 1))//' motions of '//text(size(solutions%force, 2)) &
                  //' load cases: there are '//text(size(held%body%dof, 2))//' contact points, ' &
                  //text(size(held%rigid_modes, 2))//' motions and '//text(loads(2))//' load cases')
    else if (any(displacements /= loads)) then
      call report(info, FUGE_ERR_SIZE, 'u has '//text(displacements(1))//' rows and '//text(displacements(2)) &
                  //' columns: it needs those of the loads, '//text(loads(1))//' and '//text(loads(2)))
    end if
  end subroutine check_case_solutions

  !> Refuse loads, or displacements of supports, that do not fit this body (FUGE_ERR_SIZE), or before there is one
  !> (FUGE_ERR_CALL_ORDER), and displacements that are not finite (FUGE_ERR_NOT_FINITE).
  pure subroutine check_loads(held, loads, moved, info)
    type(held_body), intent(in) :: held
    real(dp), intent(in) :: loads(:, :)
    type(fuge_info), intent(inout) :: info
    real(dp), intent(in), allocatable :: moved(:, :)
    integer :: fixed, k

    if (.not. allocated(held%factor)) then
      call report(info, FUGE_ERR_CALL_ORDER, 'no body has been condensed: call fuge_condense first')
    else if (size(loads, 1) /= size(held%constrained) .or. size(loads, 2) < 1) then
      call report(info, FUGE_ERR_SIZE, 'loads has '//text(size(loads, 1))//' rows and '//text(size(loads, 2)) &
                  //' columns: it needs a row for each of '//text(size(held%constrained))//' degrees of freedom and ' &
                  //'a column for each load case')
    end if
    if (info%failed() .or. .not. allocated(moved)) return
    fixed = 0
    if (allocated(held%body%fixed)) fixed = size(held%body%fixed)
    if (any(shape(moved) /= [fixed, size(loads, 2)])) &
      call report(info, FUGE_ERR_SIZE, 'displacement has '//text(size(moved, 1))//' rows and ' &
                  //text(size(moved, 2))//' columns: it needs a row for each of '//text(fixed) &
                  //' fixed degrees of freedom and a column for each of '//text(size(loads, 2))//' load cases')
    do k = 1, size(moved, 2)
      if (.not. info%failed()) call check_finite(moved(:, k), 'displacement', info)
    end do
  end subroutine check_loads

end module fuge_condensed_cases
