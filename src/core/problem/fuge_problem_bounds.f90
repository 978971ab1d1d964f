!> Where the arrays of a problem begin: a caller who counts points from 0 may have given them such bounds.
module fuge_problem_bounds
  use fuge_kinds, only: dp
  use fuge_problem_type, only: fuge_problem
  implicit none
  private

  public :: begins_with_one

contains

  !> Do all arrays of `problem` begin with 1? An assignment to a component that is not allocated gives it the bounds of
  !> the array on the other side.
  pure function begins_with_one(problem) result(usual)
    type(fuge_problem), intent(in) :: problem
    logical :: usual

    usual = values_begin_with_one(problem%gap) .and. values_begin_with_one(problem%gap_upper) &
            .and. values_begin_with_one(problem%resultant) .and. values_begin_with_one(problem%motion) &
            .and. values_begin_with_one(problem%compliance) .and. values_begin_with_one(problem%limit) &
            .and. values_begin_with_one(problem%limit_upper) .and. values_begin_with_one(problem%motion_stiffness)
    if (allocated(problem%excluded)) usual = usual .and. lbound(problem%excluded, 1) == 1
    if (allocated(problem%prescribed)) usual = usual .and. lbound(problem%prescribed, 1) == 1
    if (allocated(problem%modes)) usual = usual .and. all(lbound(problem%modes) == 1)
  end function begins_with_one

  pure function values_begin_with_one(values) result(usual)
    real(dp), intent(in), allocatable :: values(:)
    logical :: usual

    usual = .true.
    if (allocated(values)) usual = lbound(values, 1) == 1
  end function values_begin_with_one

end module fuge_problem_bounds
