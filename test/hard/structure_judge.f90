!> Judges what an engine makes of a random structure with one-way rows, by its forces in quadruple precision.
module structure_judge
  use, intrinsic :: iso_fortran_env, only: qp => real128
  use fuge_condensation, only: fuge_condensed
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_options_type, only: fuge_options
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_status, only: fuge_info, FUGE_ERR_NO_EQUILIBRIUM, FUGE_WARN_ILL_CONDITIONED
  use general_reference, only: solve_general
  use one_way_structures, only: condense_structure, one_way_structure
  use structure_oracle, only: known_structure
  implicit none
  private

  public :: judge_structure

  !> An error of a force above this fraction of the largest one is wrong, unless a warning tells of it.
  real(dp), parameter :: WRONG = 1.0e-6_dp

  !> Below this fraction of the largest load the forces of the rows are rounding of those in the members.
  real(dp), parameter :: NO_FORCE = 1.0e-4_dp

  type, public :: structure_verdict
    !> Blank if the engine is right.
    character(len=24) :: fault = ''
    character(len=160) :: details = ''
    integer :: status = 0
    !> Largest error of a force, relative to the largest force.
    real(dp) :: error = 0.0_dp
  end type structure_verdict

contains

  !> Condense, solve by an engine, and compare.
  subroutine judge_structure(structure, known, method, verdict)
    type(one_way_structure), intent(in) :: structure
    type(known_structure), intent(in) :: known
    integer, intent(in) :: method
    type(structure_verdict), intent(out) :: verdict
    type(fuge_condensed) :: condensed
    type(fuge_problem) :: problem
    type(fuge_solution) :: solution
    type(fuge_info) :: info

    call condense_structure(structure, condensed, problem, info)
    if (.not. info%failed()) call solve_general(condensed%alpha, problem, solution, info, fuge_options(method))
    verdict%status = info%status
    if (info%failed()) then
      if (known%carried .or. info%status /= FUGE_ERR_NO_EQUILIBRIUM) call fail('refused', info%message)
    else if (.not. known%carried) then
      call fail('cannot be carried', info%message)
    else
      verdict%error = real(maxval(abs(solution%force - known%force)), dp) &
                      /max(real(maxval(abs(known%force)), dp), NO_FORCE*maxval(abs(structure%load)), tiny(1.0_dp))
      if (verdict%error > WRONG .and. info%status /= FUGE_WARN_ILL_CONDITIONED) call fail('wrong', &
        'off by '//text(verdict%error)//' of the largest force, status '//text(info%status)//', estimate ' &
        //text(info%force_error))
    end if

  contains

    subroutine fail(fault, details)
      character(len=*), intent(in) :: fault, details

      verdict%fault = fault
      verdict%details = details
    end subroutine fail

  end subroutine judge_structure

end module structure_judge
