!> The interface of an engine for the solver: one solve after the other, each from what is kept of the last one, and
!> derivatives of the last solution.
module fuge_contact_engine
  use fuge_history_type, only: fuge_history
  use fuge_kinds, only: dp
  use fuge_monitor_type, only: fuge_monitor
  use fuge_operator_type, only: fuge_operator
  use fuge_options_type, only: fuge_options
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_status, only: fuge_info
  implicit none
  private

  type, abstract, public :: contact_engine
  contains
    procedure(solve_problem), deferred :: solve
    procedure :: keep => keep_nothing
    procedure(is_doubtful), deferred :: was_misled
    procedure(forget), deferred :: distrust_start
    procedure(forget), deferred :: forget_start
    procedure(count_of_last), deferred :: last_points
    procedure(count_of_last), deferred :: last_modes
    procedure(differentiate), deferred :: derivative
    procedure(compare_states), deferred :: has_found
  end type contact_engine

  !> An engine that needs the coefficients of a matrix, and starts from states of the points.
  type, abstract, extends(contact_engine), public :: matrix_engine
  contains
    procedure(take_states), deferred :: start_from
    procedure(take_solution), deferred :: take_arrays
  end type matrix_engine

  abstract interface
    !> Solve `problem`, checked, which has a load if it is plain, and estimate the error of the forces,
    !> info%force_error. `history` is filled if the options ask for it. After an error `solution` is undefined.
    subroutine solve_problem(self, operator, problem, options, monitor, history, solution, info)
      import :: contact_engine, fuge_operator, fuge_problem, fuge_options, fuge_monitor, fuge_history, fuge_solution, &
        fuge_info
      class(contact_engine), intent(inout) :: self
      class(fuge_operator), intent(in) :: operator
      type(fuge_problem), intent(in) :: problem
      type(fuge_options), intent(in) :: options
      class(fuge_monitor), intent(inout) :: monitor
      type(fuge_history), intent(inout) :: history
      type(fuge_solution), intent(inout) :: solution
      type(fuge_info), intent(inout) :: info
    end subroutine solve_problem

    !> Has what was kept of an earlier solve perhaps misled this one, which ended with `status`?
    pure function is_doubtful(self, status)
      import :: contact_engine
      class(contact_engine), intent(in) :: self
      integer, intent(in) :: status
      logical :: is_doubtful
    end function is_doubtful

    !> `distrust_start`: what is kept has misled a solve. `forget_start`: the next solve starts from scratch.
    subroutine forget(self)
      import :: contact_engine
      class(contact_engine), intent(inout) :: self
    end subroutine forget

    !> Points of this rank, or motions, of the last solution.
    pure function count_of_last(self) result(number)
      import :: contact_engine
      class(contact_engine), intent(in) :: self
      integer :: number
    end function count_of_last

    !> Are `state` (n) the states of the last solution?
    pure function compare_states(self, state) result(same)
      import :: contact_engine
      class(contact_engine), intent(in) :: self
      integer, intent(in) :: state(:)
      logical :: same
    end function compare_states

    !> The derivative of the last solution: see `fuge_solver`. `gap_change` and `load_change` are of the right sizes.
    !> Changes of open gaps are needed where `wanted` (n) only, or everywhere, and are zero elsewhere.
    subroutine differentiate(self, operator, gap_change, load_change, change, info, wanted)
      import :: contact_engine, dp, fuge_operator, fuge_solution, fuge_info
      class(contact_engine), intent(in) :: self
      class(fuge_operator), intent(in) :: operator
      real(dp), intent(in) :: gap_change(:), load_change(:)
      type(fuge_solution), intent(inout) :: change
      type(fuge_info), intent(inout) :: info
      logical, intent(in), optional :: wanted(:)
    end subroutine differentiate

    !> Let the next solve start from these states, (n), if there were n points in the last one.
    pure subroutine take_states(self, state)
      import :: matrix_engine
      class(matrix_engine), intent(inout) :: self
      integer, intent(in) :: state(:)
    end subroutine take_states

    !> Keep the arrays of a `solution` that the caller has had for the next solve.
    subroutine take_solution(self, solution)
      import :: matrix_engine, fuge_solution
      class(matrix_engine), intent(inout) :: self
      type(fuge_solution), intent(inout) :: solution
    end subroutine take_solution
  end interface

contains

  !> Keep a certified solution for the next solve; nothing by default.
  subroutine keep_nothing(self, operator, problem, solution)
    class(contact_engine), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution

    if (operator%points() < 0 .and. size(solution%force) < size(problem%gap)) call self%forget_start()
  end subroutine keep_nothing

end module fuge_contact_engine
