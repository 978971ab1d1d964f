!> Options of a solve. Every default is written here and nowhere else.
module fuge_options_type
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_ERR_OPTION
  implicit none
  private

  public :: check_options, iteration_limit

  !> Iterations allowed for each row of the problem if max_iterations is 0.
  integer, parameter, public :: ITERATIONS_PER_ROW = 50

  !> `method`: for a matrix the active set, or the tableau if the history is kept; for any
  !> other operator the iterative engine.
  integer, parameter, public :: FUGE_AUTO = 0
  !> `method`: the paper's tableau, Phase I of the simplex method.
  integer, parameter, public :: FUGE_TABLEAU = 1
  !> `method`: active sets by block principal pivoting, the fast method for a matrix.
  integer, parameter, public :: FUGE_ACTIVE_SET = 2
  !> `method`: projected conjugate gradients, from products only; the fast method for many points.
  integer, parameter, public :: FUGE_ITERATIVE = 3

  !> `pivot_rule` of the tableau: columns that drive an artificial out first, then the lowest number.
  integer, parameter, public :: FUGE_PAPER_RULE = 0
  !> `pivot_rule` of the tableau: most negative entry of the last row.
  integer, parameter, public :: FUGE_MOST_NEGATIVE = 1
  !> `pivot_rule` of the tableau: greatest decrease of the sum of artificials.
  integer, parameter, public :: FUGE_GREATEST_DECREASE = 2

  !> How to solve. A new variable holds the defaults.
  type, public :: fuge_options
    !> Engine: FUGE_AUTO, FUGE_TABLEAU, FUGE_ACTIVE_SET or FUGE_ITERATIVE.
    integer :: method = FUGE_AUTO
    !> Pricing of the tableau: FUGE_PAPER_RULE, FUGE_MOST_NEGATIVE or FUGE_GREATEST_DECREASE.
    integer :: pivot_rule = FUGE_PAPER_RULE
    !> Most pivots or contact sets; 0 allows 50 for each row of the problem.
    integer :: max_iterations = 0
    !> Keep the basis and the objective z of every pivot; tableau only.
    logical :: keep_history = .false.
    !> Largest residual without a warning; relative, no unit.
    real(dp) :: tolerance = 1.0e-10_dp
    !> Threads that share the work of a solve, which changes no result; 0 for all cores that the process may use.
    integer :: threads = 1
  end type fuge_options

contains

  !> Refuse impossible options (FUGE_ERR_OPTION).
  pure subroutine check_options(options, info)
    type(fuge_options), intent(in) :: options
    type(fuge_info), intent(inout) :: info

    if (all(options%method /= [FUGE_AUTO, FUGE_TABLEAU, FUGE_ACTIVE_SET, FUGE_ITERATIVE])) then
      call report(info, FUGE_ERR_OPTION, 'method = '//text(options%method) &
        //' is not an engine: use FUGE_AUTO (0), FUGE_TABLEAU (1), FUGE_ACTIVE_SET (2) or FUGE_ITERATIVE (3)')
    else if (all(options%pivot_rule /= [FUGE_PAPER_RULE, FUGE_MOST_NEGATIVE, FUGE_GREATEST_DECREASE])) then
      call report(info, FUGE_ERR_OPTION, 'pivot_rule = '//text(options%pivot_rule) &
        //' is unknown: use FUGE_PAPER_RULE, FUGE_MOST_NEGATIVE or FUGE_GREATEST_DECREASE')
    else if (options%max_iterations < 0) then
      call report(info, FUGE_ERR_OPTION, 'max_iterations = '//text(options%max_iterations) &
        //' is negative: use 0 for the engine''s own limit')
    else if (.not. is_between_0_and_1(options%tolerance)) then
      call report(info, FUGE_ERR_OPTION, 'tolerance = '//text(options%tolerance) &
        //' is not between 0 and 1: it is relative, 1e-10 is the default')
    else if (options%threads < 0) then
      call report(info, FUGE_ERR_OPTION, 'threads = '//text(options%threads) &
        //' is negative: use 0 for all cores, 1 for one thread, or more')
    end if
  end subroutine check_options

  !> Most iterations for a problem of `rows` rows: max_iterations, or in proportion to the rows if that is 0.
  pure function iteration_limit(options, rows) result(limit)
    type(fuge_options), intent(in) :: options
    integer, intent(in) :: rows
    integer :: limit

    limit = options%max_iterations
    if (limit == 0) limit = int(min(real(ITERATIONS_PER_ROW, dp)*real(rows, dp), 1.0e9_dp))
  end function iteration_limit

  !> Finiteness comes first, because a comparison with NaN may trap.
  pure function is_between_0_and_1(value) result(between)
    real(dp), intent(in) :: value
    logical :: between

    between = ieee_is_finite(value)
    if (between) between = value > 0.0_dp .and. value < 1.0_dp
  end function is_between_0_and_1

end module fuge_options_type
