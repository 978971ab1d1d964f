!> Options of a solve. Every default stands here and nowhere else.
module fuge_options_type
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info, report, FUGE_ERR_OPTION
  use fuge_text, only: text
  implicit none
  private

  public :: check_options

  !> Engines (`method`).
  integer, parameter, public :: FUGE_AUTO = 0
  integer, parameter, public :: FUGE_TABLEAU = 1

  !> Pricing of the tableau's entering column (`pivot_rule`).
  integer, parameter, public :: FUGE_PAPER_RULE = 0
  integer, parameter, public :: FUGE_MOST_NEGATIVE = 1
  integer, parameter, public :: FUGE_GREATEST_DECREASE = 2

  type, public :: fuge_options
    !> Engine: FUGE_AUTO or FUGE_TABLEAU.
    integer :: method = FUGE_AUTO
    !> Pricing of the tableau.
    integer :: pivot_rule = FUGE_PAPER_RULE
    !> Most pivots allowed; 0 lets the engine choose (50 for each row).
    integer :: max_iterations = 0
    !> Keep basis and z of every pivot.
    logical :: keep_history = .false.
    !> Largest residual that counts as done; relative, no unit.
    real(dp) :: tolerance = 1.0e-10_dp
  end type fuge_options

contains

  !> Refuse impossible options (FUGE_ERR_OPTION).
  pure subroutine check_options(options, info)
    type(fuge_options), intent(in) :: options
    type(fuge_info), intent(inout) :: info

    if (all(options%method /= [FUGE_AUTO, FUGE_TABLEAU])) then
      call report(info, FUGE_ERR_OPTION, 'method = '//text(options%method) &
        //' is not an engine: use FUGE_AUTO or FUGE_TABLEAU')
    else if (all(options%pivot_rule /= [FUGE_PAPER_RULE, FUGE_MOST_NEGATIVE, FUGE_GREATEST_DECREASE])) then
      call report(info, FUGE_ERR_OPTION, 'pivot_rule = '//text(options%pivot_rule) &
        //' is unknown: use FUGE_PAPER_RULE, FUGE_MOST_NEGATIVE or FUGE_GREATEST_DECREASE')
    else if (options%max_iterations < 0) then
      call report(info, FUGE_ERR_OPTION, 'max_iterations = '//text(options%max_iterations) &
        //' is negative: use 0 for the engine''s own limit')
    else if (.not. (options%tolerance > 0.0_dp .and. options%tolerance < 1.0_dp)) then
      call report(info, FUGE_ERR_OPTION, 'tolerance = '//text(options%tolerance) &
        //' is not between 0 and 1: it is relative, 1e-10 is the default')
    end if
  end subroutine check_options

end module fuge_options_type
