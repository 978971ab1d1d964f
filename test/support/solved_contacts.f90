!> Contact problems set up and solved in one line of a test. A solve that does not end as it should fails the test by
!> itself, with the message of the solver, and leaves numbers that are no answer.
module solved_contacts
  use funit, only: assertFail
  use fuge_kinds, only: dp
  use fuge_matrix_operator, only: fuge_dense_operator
  use fuge_number_text, only: text
  use fuge_operator_type, only: fuge_operator
  use fuge_options_type, only: fuge_options, FUGE_ACTIVE_SET, FUGE_AUTO, FUGE_GREATEST_DECREASE, FUGE_ITERATIVE, &
    FUGE_MOST_NEGATIVE, FUGE_PAPER_RULE, FUGE_TABLEAU
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_solver_type, only: fuge_solver
  use fuge_status, only: fuge_info, FUGE_DONE
  use special_numbers, only: nan
  implicit none
  private

  public :: solved
  ! What one needs to call it.
  public :: fuge_dense_operator, fuge_operator, fuge_options, fuge_problem, fuge_solution, fuge_solver
  public :: FUGE_ACTIVE_SET, FUGE_AUTO, FUGE_GREATEST_DECREASE, FUGE_ITERATIVE, FUGE_MOST_NEGATIVE, FUGE_PAPER_RULE, &
    FUGE_TABLEAU

  !> The solution of a problem with a matrix or another operator, by default with the status FUGE_DONE. `what` stands
  !> before the message of a failure; `info` is that of the solve; a `solver` may have solved other problems before.
  interface solved
    module procedure solved_operator, solved_matrix, pressed_operator, pressed_matrix
  end interface solved

contains

  function solved_operator(operator, problem, options, status, what, info, solver) result(solution)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_options), intent(in), optional :: options
    integer, intent(in), optional :: status
    character(len=*), intent(in), optional :: what
    type(fuge_info), intent(out), optional :: info
    type(fuge_solver), intent(inout), optional :: solver
    type(fuge_solution) :: solution
    type(fuge_info) :: outcome
    type(fuge_solver) :: new

    if (present(solver)) then
      call solver%solve(operator, problem, solution, outcome, options)
    else
      call new%solve(operator, problem, solution, outcome, options)
    end if
    call require(outcome, status, what)
    if (.not. allocated(solution%force)) solution = no_answer(problem)
    if (present(info)) info = outcome
  end function solved_operator

  function solved_matrix(alpha, problem, options, status, what, info, solver) result(solution)
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    type(fuge_options), intent(in), optional :: options
    integer, intent(in), optional :: status
    character(len=*), intent(in), optional :: what
    type(fuge_info), intent(out), optional :: info
    type(fuge_solver), intent(inout), optional :: solver
    type(fuge_solution) :: solution
    type(fuge_dense_operator) :: operator
    type(fuge_info) :: outcome
    real(dp), allocatable, target :: matrix(:, :)

    ! The operator points to the matrix.
    allocate (matrix, source=alpha)
    call operator%set(matrix, outcome)
    if (outcome%failed()) then
      call require(outcome, status, what)
      solution = no_answer(problem)
      if (present(info)) info = outcome
    else
      solution = solved_operator(operator, problem, options, status, what, info, solver)
    end if
  end function solved_matrix

  !> One translation and one-sided points, as in the next function.
  function pressed_operator(operator, gap, load, options, status, what, info, solver) result(solution)
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: gap(:), load
    type(fuge_options), intent(in), optional :: options
    integer, intent(in), optional :: status
    character(len=*), intent(in), optional :: what
    type(fuge_info), intent(out), optional :: info
    type(fuge_solver), intent(inout), optional :: solver
    type(fuge_solution) :: solution
    type(fuge_problem) :: problem

    allocate (problem%gap, source=gap)
    problem%resultant = [load]
    solution = solved_operator(operator, problem, options, status, what, info, solver)
  end function pressed_operator

  function pressed_matrix(alpha, gap, load, options, status, what, info, solver) result(solution)
    real(dp), intent(in) :: alpha(:, :)
    real(dp), intent(in) :: gap(:), load
    type(fuge_options), intent(in), optional :: options
    integer, intent(in), optional :: status
    character(len=*), intent(in), optional :: what
    type(fuge_info), intent(out), optional :: info
    type(fuge_solver), intent(inout), optional :: solver
    type(fuge_solution) :: solution
    type(fuge_problem) :: problem

    allocate (problem%gap, source=gap)
    problem%resultant = [load]
    solution = solved_matrix(alpha, problem, options, status, what, info, solver)
  end function pressed_matrix

  subroutine require(info, status, what)
    type(fuge_info), intent(in) :: info
    integer, intent(in), optional :: status
    character(len=*), intent(in), optional :: what
    integer :: expected
    character(len=:), allocatable :: before

    expected = FUGE_DONE
    if (present(status)) expected = status
    if (info%status == expected) return
    before = ''
    if (present(what)) before = what//': '
    call assertFail(before//'status '//text(info%status)//' instead of '//text(expected)//': '//info%message)
  end subroutine require

  !> Of the right sizes, so that assertions about it fail too.
  pure function no_answer(problem) result(solution)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution) :: solution

    allocate (solution%force(problem%points()), source=nan())
    allocate (solution%gap(problem%points()), source=nan())
    allocate (solution%motion(problem%mode_count()), source=nan())
    allocate (solution%state(problem%points()), source=0)
  end function no_answer

end module solved_contacts
