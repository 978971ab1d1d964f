!> C bindings, section "problem": the data of a solve beside the operator.
!>
!> Each setter checks what it gets, so that the call with the error says so and changes nothing.
!> `solve` checks everything again, because a Fortran caller fills the problem without setters; compared with a
!> solve that costs nothing.
module fuge_c_problem
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_associated, c_f_pointer
  use fuge_c_arrays, only: give
  use fuge_c_solver, only: find_solver, solver_handle
  use fuge_c_types, only: report_failure, report_to_handle, require_count, require_pointer
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_law_checks, only: check_limits, check_stiffnesses
  use fuge_number_text, only: index_text, text
  use fuge_problem_type, only: check_load, check_play
  use fuge_point_space, only: point_space
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_MODES, FUGE_ERR_SIZE
  implicit none
  private

contains

  function c_set_gap(solver, gap, gap_upper) bind(c, name='fuge_set_gap') result(status)
    type(c_ptr), intent(in), value :: solver, gap, gap_upper
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    real(dp), allocatable :: lower(:), play(:)
    type(fuge_info) :: info

    call find_solver(solver, handle, info)
    if (.not. info%failed()) call copy_array(gap, points_of(handle), 'gap', lower, info)
    if (.not. info%failed()) call check_finite(lower, 'gap', info)
    if (.not. info%failed() .and. c_associated(gap_upper)) then
      call copy_array(gap_upper, points_of(handle), 'gap_upper', play, info)
      if (.not. info%failed()) call check_play(play, info)
    end if
    if (.not. info%failed()) then
      call move_alloc(lower, handle%problem%gap)
      call move_alloc(play, handle%problem%gap_upper)
      handle%solved = .false.
    end if
    status = report_to_handle(info, handle)
  end function c_set_gap

  function c_set_excluded(solver, excluded) bind(c, name='fuge_set_excluded') result(status)
    type(c_ptr), intent(in), value :: solver, excluded
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    integer(c_int), pointer :: flags(:)
    logical, allocatable :: copy(:)
    type(fuge_info) :: info
    integer :: stat

    call find_solver(solver, handle, info)
    if (.not. info%failed() .and. c_associated(excluded)) then
      call c_f_pointer(excluded, flags, [points_of(handle)])
      allocate (copy(size(flags)), stat=stat)
      call require_memory(stat, 'a copy of excluded', info)
      if (stat == 0) copy = flags /= 0
    end if
    if (.not. info%failed()) then
      call move_alloc(copy, handle%problem%excluded)
      handle%solved = .false.
    end if
    status = report_to_handle(info, handle)
  end function c_set_excluded

  function c_set_compliance(solver, compliance) bind(c, name='fuge_set_compliance') result(status)
    type(c_ptr), intent(in), value :: solver, compliance
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    real(dp), allocatable :: copy(:)
    type(fuge_info) :: info

    call find_solver(solver, handle, info)
    if (.not. info%failed() .and. c_associated(compliance)) then
      call copy_array(compliance, points_of(handle), 'compliance', copy, info)
      if (.not. info%failed()) call check_stiffnesses(copy, points_of(handle), 'compliance', info)
    end if
    if (.not. info%failed()) then
      call move_alloc(copy, handle%problem%compliance)
      handle%solved = .false.
    end if
    status = report_to_handle(info, handle)
  end function c_set_compliance

  function c_set_limits(solver, limit, limit_upper) bind(c, name='fuge_set_limits') result(status)
    type(c_ptr), intent(in), value :: solver, limit, limit_upper
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    real(dp), allocatable :: lower(:), upper(:)
    type(fuge_info) :: info

    call find_solver(solver, handle, info)
    if (.not. info%failed()) call copy_limits(limit, points_of(handle), 'limit', lower, info)
    if (.not. info%failed()) call copy_limits(limit_upper, points_of(handle), 'limit_upper', upper, info)
    if (.not. info%failed()) then
      call move_alloc(lower, handle%problem%limit)
      call move_alloc(upper, handle%problem%limit_upper)
      handle%solved = .false.
    end if
    status = report_to_handle(info, handle)
  end function c_set_limits

  !> A copy of limits of C; none for NULL.
  subroutine copy_limits(source, n, name, copy, info)
    type(c_ptr), intent(in) :: source
    integer, intent(in) :: n
    character(len=*), intent(in) :: name
    real(dp), allocatable, intent(out) :: copy(:)
    type(fuge_info), intent(inout) :: info

    if (.not. c_associated(source)) return
    call copy_array(source, n, name, copy, info)
    if (.not. info%failed()) call check_limits(copy, n, name, info)
  end subroutine copy_limits

  !> One free translation.
  function c_set_load(solver, load) bind(c, name='fuge_set_load') result(status)
    type(c_ptr), intent(in), value :: solver
    real(c_double), intent(in), value :: load
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    real(dp), allocatable :: resultant(:)
    type(fuge_info) :: info

    call find_solver(solver, handle, info)
    if (.not. info%failed()) call check_load(load, info)
    if (.not. info%failed()) call array_of_one(load, resultant, info)
    if (.not. info%failed()) then
      call reset_motions(handle)
      call move_alloc(resultant, handle%problem%resultant)
    end if
    status = report_to_handle(info, handle)
  end function c_set_load

  function c_set_approach(solver, approach) bind(c, name='fuge_set_approach') result(status)
    type(c_ptr), intent(in), value :: solver
    real(c_double), intent(in), value :: approach
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    real(dp), allocatable :: motion(:)
    logical, allocatable :: prescribed(:)
    type(fuge_info) :: info
    integer :: stat

    call find_solver(solver, handle, info)
    if (.not. info%failed()) call check_finite(approach, 'approach', info)
    if (.not. info%failed()) call array_of_one(approach, motion, info)
    if (.not. info%failed()) then
      allocate (prescribed(1), stat=stat)
      call require_memory(stat, 'the approach', info)
    end if
    if (.not. info%failed()) then
      prescribed = .true.
      call reset_motions(handle)
      call move_alloc(motion, handle%problem%motion)
      call move_alloc(prescribed, handle%problem%prescribed)
    end if
    status = report_to_handle(info, handle)
  end function c_set_approach

  function c_set_modes(solver, m, modes, resultant) bind(c, name='fuge_set_modes') result(status)
    type(c_ptr), intent(in), value :: solver, modes, resultant
    integer(c_int), intent(in), value :: m
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    real(dp), allocatable :: r(:, :), w(:)
    type(fuge_info) :: info

    call find_solver(solver, handle, info)
    if (.not. info%failed()) call check_mode_count(m, points_of_all_ranks(handle), info)
    if (.not. info%failed()) call copy_matrix(modes, points_of(handle), int(m), r, info)
    if (.not. info%failed()) call copy_array(resultant, int(m), 'resultant', w, info)
    if (.not. info%failed()) call check_finite(w, 'resultant', info)
    if (.not. info%failed()) then
      call reset_motions(handle)
      call move_alloc(r, handle%problem%modes)
      call move_alloc(w, handle%problem%resultant)
    end if
    status = report_to_handle(info, handle)
  end function c_set_modes

  !> Prescribe one motion.
  function c_set_motion(solver, mode, motion) bind(c, name='fuge_set_motion') result(status)
    type(c_ptr), intent(in), value :: solver
    integer(c_int), intent(in), value :: mode
    real(c_double), intent(in), value :: motion
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    type(fuge_info) :: info

    call find_solver(solver, handle, info)
    if (.not. info%failed()) call check_mode(handle, int(mode), motion, 'motion', info)
    if (.not. info%failed()) call allow_prescribed(handle, info)
    if (.not. info%failed()) then
      handle%problem%prescribed(mode + 1) = .true.
      handle%problem%motion(mode + 1) = motion
      handle%solved = .false.
    end if
    status = report_to_handle(info, handle)
  end function c_set_motion

  !> Let one motion be free, under its resultant.
  function c_set_resultant(solver, mode, resultant) bind(c, name='fuge_set_resultant') result(status)
    type(c_ptr), intent(in), value :: solver
    integer(c_int), intent(in), value :: mode
    real(c_double), intent(in), value :: resultant
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    type(fuge_info) :: info
    integer :: stat

    call find_solver(solver, handle, info)
    if (.not. info%failed()) call check_mode(handle, int(mode), resultant, 'resultant', info)
    if (.not. info%failed()) then
      stat = 0
      ! Only a single translation can be without a resultant.
      if (.not. allocated(handle%problem%resultant)) allocate (handle%problem%resultant(1), stat=stat)
      call require_memory(stat, 'the resultant', info)
    end if
    if (.not. info%failed()) then
      handle%problem%resultant(mode + 1) = resultant
      call free_mode(handle, mode + 1)
      handle%solved = .false.
    end if
    status = report_to_handle(info, handle)
  end function c_set_resultant

  !> Put one motion on a spring, or take its spring away; with no spring left, the problem is as if there had been none.
  function c_set_motion_stiffness(solver, mode, stiffness) bind(c, name='fuge_set_motion_stiffness') result(status)
    type(c_ptr), intent(in), value :: solver
    integer(c_int), intent(in), value :: mode
    real(c_double), intent(in), value :: stiffness
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    real(dp), allocatable :: springs(:)
    type(fuge_info) :: info
    integer :: m, stat

    call find_solver(solver, handle, info)
    if (.not. info%failed()) call check_mode(handle, int(mode), stiffness, 'stiffness', info)
    if (.not. info%failed()) then
      m = handle%problem%mode_count()
      allocate (springs(m), stat=stat)
      call require_memory(stat, 'the stiffnesses of the motions', info)
    end if
    if (.not. info%failed()) then
      springs = 0.0_dp
      if (allocated(handle%problem%motion_stiffness)) springs = handle%problem%motion_stiffness
      springs(mode + 1) = stiffness
      call check_stiffnesses(springs, m, 'motion_stiffness', info)
    end if
    if (.not. info%failed()) then
      if (.not. any(springs > 0.0_dp)) deallocate (springs)
      call move_alloc(springs, handle%problem%motion_stiffness)
      handle%solved = .false.
    end if
    status = report_to_handle(info, handle)
  end function c_set_motion_stiffness

  function c_get_mode_count(solver, destination) bind(c, name='fuge_get_mode_count') result(status)
    type(c_ptr), intent(in), value :: solver, destination
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    type(fuge_info) :: info

    call find_solver(solver, handle, info)
    call require_pointer(destination, 'm', info)
    if (.not. info%failed()) call give(handle%problem%mode_count(), destination)
    status = report_failure(info, handle)
  end function c_get_mode_count

  pure function points_of(handle) result(n)
    type(solver_handle), intent(in) :: handle
    integer :: n

    n = handle%operator%operator%points()
  end function points_of

  !> As points_of, and where ranks share a grid all its cells: one rank may have fewer than there are modes.
  function points_of_all_ranks(handle) result(n)
    type(solver_handle), intent(in) :: handle
    integer :: n
    type(point_space) :: space

    n = points_of(handle)
    space = handle%operator%operator%ranks()
    if (.not. space%is_alone()) n = product(handle%operator%operator%grid())
  end function points_of_all_ranks

  !> Back to one free translation, without a load yet.
  pure subroutine reset_motions(handle)
    type(solver_handle), intent(inout) :: handle

    associate (problem => handle%problem)
      if (allocated(problem%modes)) deallocate (problem%modes)
      if (allocated(problem%resultant)) deallocate (problem%resultant)
      if (allocated(problem%prescribed)) deallocate (problem%prescribed)
      if (allocated(problem%motion)) deallocate (problem%motion)
      if (allocated(problem%motion_stiffness)) deallocate (problem%motion_stiffness)
    end associate
    handle%solved = .false.
  end subroutine reset_motions

  !> More modes than points cannot be independent, and their array need not exist.
  pure subroutine check_mode_count(m, n, info)
    integer(c_int), intent(in) :: m
    integer, intent(in) :: n
    type(fuge_info), intent(inout) :: info

    call require_count(m, 0, 'm', 'modes', info)
    if (m > n) call report(info, FUGE_ERR_MODES, text(int(m))//' modes of '//text(n)//' point(s) are linearly ' &
                           //'dependent: leave out '//text(int(m) - n))
  end subroutine check_mode_count

  pure subroutine check_mode(handle, mode, value, name, info)
    type(solver_handle), intent(in) :: handle
    integer, intent(in) :: mode
    real(dp), intent(in) :: value
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info

    associate (m => handle%problem%mode_count())
      if (m < 1) then
        call report(info, FUGE_ERR_SIZE, 'the problem has no modes: fuge_set_modes was called with m = 0')
      else if (mode < 0 .or. mode >= m) then
        call report(info, FUGE_ERR_SIZE, 'mode = '//text(mode)//' is not one of the '//text(m)//' modes, 0 .. ' &
                    //text(m - 1))
      else
        call check_finite(value, name, info)
      end if
    end associate
  end subroutine check_mode

  !> Allocate the prescribed motions, if there are none yet; at first all motions are free.
  pure subroutine allow_prescribed(handle, info)
    type(solver_handle), intent(inout) :: handle
    type(fuge_info), intent(inout) :: info
    logical, allocatable :: prescribed(:)
    real(dp), allocatable :: motion(:)
    integer :: m, stat

    if (allocated(handle%problem%prescribed)) return
    m = handle%problem%mode_count()
    allocate (prescribed(m), motion(m), stat=stat)
    call require_memory(stat, 'the prescribed motions', info)
    if (stat /= 0) return
    prescribed = .false.
    motion = 0.0_dp
    call move_alloc(prescribed, handle%problem%prescribed)
    call move_alloc(motion, handle%problem%motion)
  end subroutine allow_prescribed

  !> Mark one motion as free; with no prescribed motion left, the problem is as if there had been none.
  pure subroutine free_mode(handle, mode)
    type(solver_handle), intent(inout) :: handle
    integer, intent(in) :: mode

    associate (problem => handle%problem)
      if (.not. allocated(problem%prescribed)) return
      problem%prescribed(mode) = .false.
      if (any(problem%prescribed)) return
      deallocate (problem%prescribed, problem%motion)
    end associate
  end subroutine free_mode

  pure subroutine array_of_one(value, array, info)
    real(dp), intent(in) :: value
    real(dp), allocatable, intent(out) :: array(:)
    type(fuge_info), intent(inout) :: info
    integer :: stat

    allocate (array(1), stat=stat)
    call require_memory(stat, 'one number', info)
    if (stat == 0) array = value
  end subroutine array_of_one

  !> A copy of an array of C; NULL is refused unless it has no elements.
  subroutine copy_array(source, length, name, copy, info)
    type(c_ptr), intent(in) :: source
    integer, intent(in) :: length
    character(len=*), intent(in) :: name
    real(dp), allocatable, intent(out) :: copy(:)
    type(fuge_info), intent(inout) :: info
    real(c_double), pointer :: values(:)
    integer :: stat

    if (length > 0) call require_pointer(source, name, info)
    if (info%failed()) return
    allocate (copy(length), stat=stat)
    call require_memory(stat, 'a copy of '//name, info)
    if (stat /= 0 .or. length < 1) return
    call c_f_pointer(source, values, [length])
    copy = values
  end subroutine copy_array

  !> A copy of the modes of C, whose values have to be finite.
  subroutine copy_matrix(source, rows, columns, copy, info)
    type(c_ptr), intent(in) :: source
    integer, intent(in) :: rows, columns
    real(dp), allocatable, intent(out) :: copy(:, :)
    type(fuge_info), intent(inout) :: info
    real(c_double), pointer :: values(:, :)
    integer :: j, stat

    if (columns > 0) call require_pointer(source, 'modes', info)
    if (info%failed()) return
    allocate (copy(rows, columns), stat=stat)
    call require_memory(stat, 'a copy of the modes', info)
    if (stat /= 0 .or. columns < 1) return
    call c_f_pointer(source, values, [rows, columns])
    copy = values
    do j = 1, columns
      call check_finite(copy(:, j), 'mode '//index_text(j)//' at point ', info)
      if (info%failed()) return
    end do
  end subroutine copy_matrix

end module fuge_c_problem
