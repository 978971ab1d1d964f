!> Shared by the external procedures for FORTRAN 77: a general problem from plain arrays, and
!> its solution.
module fuge_f77_problem
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_positive_inf, ieee_value
  use fuge_kinds, only: dp
  use fuge_matrix_operator, only: fuge_dense_operator
  use fuge_number_text, only: text
  use fuge_options_type, only: fuge_options
  use fuge_problem_type, only: fuge_problem, fuge_solution, set_problem
  use fuge_solver_type, only: fuge_solver
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_SIZE, FUGE_ERR_MEMORY, FUGE_ERR_MODES, &
    FUGE_ERR_OPTION
  implicit none
  private

  public :: check_dimensions, check_modes, check_room, prescribe_motions, set_general_problem, set_options, &
    set_translation, solve_matrix

  !> Values of NSTOP, the number of stops at a point.
  integer, parameter :: EXCLUDED = 0
  integer, parameter :: ONE_SIDED = 1
  integer, parameter :: TWO_SIDED = 2

contains

  !> Refuse a count `n` below one, and a leading dimension `lead` below that (FUGE_ERR_SIZE).
  pure subroutine check_dimensions(n, n_name, lead, lead_name, info)
    integer, intent(in) :: n, lead
    character(len=*), intent(in) :: n_name, lead_name
    type(fuge_info), intent(inout) :: info

    if (n < 1) then
      call report(info, FUGE_ERR_SIZE, n_name//' = '//text(n)//': it has to be 1 or more')
    else if (lead < n) then
      call report(info, FUGE_ERR_SIZE, lead_name//' = '//text(lead)//' is less than '//n_name//' = '//text(n))
    end if
  end subroutine check_dimensions

  !> Refuse impossible numbers of modes: FUGE_ERR_SIZE, and FUGE_ERR_MODES for more modes than
  !> points, which cannot be independent.
  pure subroutine check_modes(n, m, ldr, info)
    integer, intent(in) :: n, m, ldr
    type(fuge_info), intent(inout) :: info

    if (m < 0) then
      call report(info, FUGE_ERR_SIZE, 'M = '//text(m)//' is negative: it is the number of motions')
    else if (m > n) then
      call report(info, FUGE_ERR_MODES, text(m)//' motions of '//text(n)//' point(s) are linearly dependent: ' &
                  //'leave out '//text(m - n))
    else if (m > 0) then
      call check_dimensions(n, 'N', ldr, 'LDR', info)
    end if
  end subroutine check_modes

  !> Refuse a negative number of entries that fit into the caller's arrays (FUGE_ERR_SIZE), unless an error is known
  !> already.
  pure subroutine check_room(room, name, info)
    integer, intent(in) :: room
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info

    if (.not. info%failed() .and. room < 0) call report(info, FUGE_ERR_SIZE, name//' = '//text(room) &
      //' is negative: it is the number of entries that fit into the arrays')
  end subroutine check_room

  !> Set the options of a solve; `tolerance` <= 0 is the default. The solver refuses what is out of range, NaN included.
  pure subroutine set_options(method, tolerance, max_iterations, options)
    integer, intent(in) :: method, max_iterations
    real(dp), intent(in) :: tolerance
    type(fuge_options), intent(inout) :: options

    options%method = method
    options%max_iterations = max_iterations
    if (ieee_is_nan(tolerance)) then
      ! A comparison might trap.
      options%tolerance = tolerance
    else if (tolerance > 0.0_dp) then
      options%tolerance = tolerance
    end if
  end subroutine set_options

  !> Set the problem of one translation, which is `held` at `approach` or free under `load`. Error: FUGE_ERR_MEMORY.
  pure subroutine set_translation(gap, held, load, approach, problem, info)
    real(dp), intent(in) :: gap(:), load, approach
    logical, intent(in) :: held
    type(fuge_problem), intent(inout) :: problem
    type(fuge_info), intent(inout) :: info

    if (held) then
      call set_problem(gap, 0.0_dp, problem, info)
      if (.not. info%failed()) call prescribe_motions([1], [approach], problem, info)
    else
      call set_problem(gap, load, problem, info)
    end if
  end subroutine set_translation

  !> Set a problem with all motions free: `gap` (n), `stops` (n) as above, `play` (n), which is
  !> read only where there are two stops, `modes` (ldr, m), ldr >= n, `resultant` (m).
  !> Errors: FUGE_ERR_OPTION for other stops, FUGE_ERR_MEMORY.
  pure subroutine set_general_problem(gap, stops, play, modes, resultant, problem, info)
    real(dp), intent(in) :: gap(:), play(:), modes(:, :), resultant(:)
    integer, intent(in) :: stops(:)
    type(fuge_problem), intent(inout) :: problem
    type(fuge_info), intent(inout) :: info
    integer :: m, n, stat

    n = size(gap)
    m = size(resultant)
    call check_stops(stops, info)
    if (info%failed()) return
    allocate (problem%gap(n), problem%modes(n, m), problem%resultant(m), stat=stat)
    if (stat == 0 .and. any(stops == EXCLUDED)) allocate (problem%excluded(n), stat=stat)
    if (stat == 0 .and. any(stops == TWO_SIDED)) allocate (problem%gap_upper(n), stat=stat)
    call require_memory(stat, 'a copy of gaps, stops and modes', info)
    if (stat /= 0) return
    problem%gap = gap
    ! Without modes their array need not have n rows.
    if (m > 0) problem%modes = modes(:n, :)
    problem%resultant = resultant
    if (allocated(problem%excluded)) problem%excluded = stops == EXCLUDED
    if (.not. allocated(problem%gap_upper)) return
    problem%gap_upper = ieee_value(0.0_dp, ieee_positive_inf)
    where (stops == TWO_SIDED) problem%gap_upper = play
  end subroutine set_general_problem

  !> Prescribe `motion` (m) where `marks` (m) is not zero. Error: FUGE_ERR_MEMORY.
  pure subroutine prescribe_motions(marks, motion, problem, info)
    integer, intent(in) :: marks(:)
    real(dp), intent(in) :: motion(:)
    type(fuge_problem), intent(inout) :: problem
    type(fuge_info), intent(inout) :: info
    integer :: stat

    allocate (problem%prescribed(size(marks)), problem%motion(size(marks)), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the prescribed motions')
    else
      problem%prescribed = marks /= 0
      problem%motion = motion
    end if
  end subroutine prescribe_motions

  !> Solve for the matrix `alpha`, (n, n) or (lda, n), which is not copied. Errors as `set` of
  !> `fuge_dense_operator` and `solve` of `fuge_solver`.
  subroutine solve_matrix(alpha, problem, options, solution, info)
    real(dp), intent(in), target :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    type(fuge_options), intent(in) :: options
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(out) :: info
    type(fuge_dense_operator) :: operator
    type(fuge_solver) :: solver

    call operator%set(alpha, info)
    if (.not. info%failed()) call solver%solve(operator, problem, solution, info, options)
  end subroutine solve_matrix

  !> Refuse any other number of stops (FUGE_ERR_OPTION).
  pure subroutine check_stops(stops, info)
    integer, intent(in) :: stops(:)
    type(fuge_info), intent(inout) :: info
    integer :: k

    do k = 1, size(stops)
      if (any(stops(k) == [EXCLUDED, ONE_SIDED, TWO_SIDED])) cycle
      call report(info, FUGE_ERR_OPTION, 'NSTOP('//text(k)//') = '//text(stops(k))//': a point has 1 stop, 2 ' &
                  //'with play between them, or 0 if it is excluded')
      return
    end do
  end subroutine check_stops

end module fuge_f77_problem
