!> Load cases of one contact problem, a column for each, and their solutions.
module fuge_load_cases_type
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_problem_type, only: fuge_problem
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_SIZE
  implicit none
  private

  public :: allocate_case_solutions, check_cases, move_case_solutions, move_cases, take_case

  !> What changes from case to case; all else is that of the problem. At least one of both is set.
  type, public :: fuge_load_cases
    !> Initial gaps of each case, displacements by its external loads included, (n, cases), length. Not allocated: those
    !> of the problem.
    real(dp), allocatable :: gap(:, :)
    !> Resultant of each motion in each case, (m, cases); where a motion is prescribed, the motion. Not allocated: those
    !> of the problem.
    real(dp), allocatable :: load(:, :)
    !> Why cases have no gaps or loads, (cases): one with an error here is not solved, and keeps this report. Not
    !> allocated: all have.
    type(fuge_info), allocatable :: refused(:)
  contains
    procedure :: number
  end type fuge_load_cases

  !> A column for each case. Without a solution it is NaN, and its states are those of open points: see `report`.
  type, public :: fuge_case_solutions
    !> Contact forces, (n, cases), force, and gaps under load, (n, cases), length, as in `fuge_solution`.
    real(dp), allocatable :: force(:, :), gap(:, :)
    !> Motions, (m, cases).
    real(dp), allocatable :: motion(:, :)
    !> States of the points, (n, cases).
    integer, allocatable :: state(:, :)
    !> What `solve` of `fuge_solver` has reported of each case, (cases).
    type(fuge_info), allocatable :: report(:)
  end type fuge_case_solutions

contains

  !> Number of cases; 0 without data.
  pure function number(self)
    class(fuge_load_cases), intent(in) :: self
    integer :: number

    number = 0
    if (allocated(self%gap)) then
      number = size(self%gap, 2)
    else if (allocated(self%load)) then
      number = size(self%load, 2)
    end if
  end function number

  !> Refuse cases that do not fit `problem` (FUGE_ERR_SIZE).
  pure subroutine check_cases(cases, problem, info)
    type(fuge_load_cases), intent(in) :: cases
    type(fuge_problem), intent(in) :: problem
    type(fuge_info), intent(inout) :: info

    if (cases%number() < 1) call report(info, FUGE_ERR_SIZE, 'there are no load cases: set gap or load, a column for ' &
                                        //'each case')
    if (allocated(cases%gap) .and. allocated(problem%gap)) then
      if (size(cases%gap, 1) /= size(problem%gap)) call report(info, FUGE_ERR_SIZE, 'the gaps of the load cases have ' &
        //text(size(cases%gap, 1))//' row(s): the problem has '//text(size(problem%gap))//' points')
    end if
    if (allocated(cases%refused) .and. .not. info%failed()) then
      if (size(cases%refused) /= cases%number()) call report(info, FUGE_ERR_SIZE, 'refused has ' &
        //text(size(cases%refused))//' report(s): it needs one for each of '//text(cases%number())//' load cases')
    end if
    if (.not. allocated(cases%load) .or. info%failed()) return
    if (size(cases%load, 1) /= problem%mode_count()) then
      call report(info, FUGE_ERR_SIZE, 'the loads of the load cases have '//text(size(cases%load, 1))//' row(s): the ' &
                  //'problem has '//text(problem%mode_count())//' motions')
    else if (size(cases%load, 2) /= cases%number()) then
      call report(info, FUGE_ERR_SIZE, 'there are gaps of '//text(cases%number())//' and loads of ' &
                  //text(size(cases%load, 2))//' load cases: their numbers have to agree')
    end if
  end subroutine check_cases

  !> Put the data of case `k`, which fit, into `problem`.
  pure subroutine take_case(cases, k, problem)
    type(fuge_load_cases), intent(in) :: cases
    integer, intent(in) :: k
    type(fuge_problem), intent(inout) :: problem

    if (allocated(cases%gap)) problem%gap = cases%gap(:, k)
    if (.not. allocated(cases%load)) return
    if (allocated(problem%prescribed)) then
      if (any(problem%prescribed)) problem%motion = merge(cases%load(:, k), 0.0_dp, problem%prescribed)
      if (all(problem%prescribed)) return
    end if
    problem%resultant = cases%load(:, k)
  end subroutine take_case

  !> Solutions of `cases` cases with `n` points and `m` motions, all without a value: NaN. Error: FUGE_ERR_MEMORY.
  pure subroutine allocate_case_solutions(n, m, cases, no_value, solutions, info)
    integer, intent(in) :: n, m, cases
    real(dp), intent(in) :: no_value
    type(fuge_case_solutions), intent(out) :: solutions
    type(fuge_info), intent(inout) :: info
    integer :: stat

    allocate (solutions%force(n, cases), solutions%gap(n, cases), solutions%motion(m, cases), &
              solutions%state(n, cases), solutions%report(cases), stat=stat)
    call require_memory(stat, 'the solutions of', cases, 'load cases', info)
    if (stat /= 0) return
    solutions%force = no_value
    solutions%gap = no_value
    solutions%motion = no_value
    solutions%state = 0
  end subroutine allocate_case_solutions

  !> Move load cases; nothing is copied.
  pure subroutine move_cases(from, to)
    type(fuge_load_cases), intent(inout) :: from, to

    call move_alloc(from%gap, to%gap)
    call move_alloc(from%load, to%load)
    call move_alloc(from%refused, to%refused)
  end subroutine move_cases

  !> Move solutions; nothing is copied.
  pure subroutine move_case_solutions(from, to)
    type(fuge_case_solutions), intent(inout) :: from, to

    call move_alloc(from%force, to%force)
    call move_alloc(from%gap, to%gap)
    call move_alloc(from%motion, to%motion)
    call move_alloc(from%state, to%state)
    call move_alloc(from%report, to%report)
  end subroutine move_case_solutions

end module fuge_load_cases_type
