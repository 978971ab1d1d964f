!> Solves random problems with laws of points by each engine, and prints where it is not right, and
!> without a fault, but with its status, where a warning says that the answer may be wrong.
!>
!> compare_laws [last] [first]: problems `first` to `last`, by default 1 to 10000. With first = last it prints the
!> problem and all answers. It ends with an error if an engine is wrong.
program compare_laws
  use, intrinsic :: iso_fortran_env, only: output_unit
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_options_type, only: fuge_options, FUGE_ACTIVE_SET, FUGE_ITERATIVE, FUGE_TABLEAU
  use fuge_problem_type, only: fuge_solution
  use fuge_status, only: fuge_info, FUGE_WARN_ILL_CONDITIONED, FUGE_WARN_RESIDUAL
  use general_reference, only: solve_general
  use law_judge, only: judge_law, know_law, known_law, law_verdict
  use random_laws, only: draw_laws, law_scene
  implicit none

  integer, parameter :: METHODS(3) = [FUGE_TABLEAU, FUGE_ACTIVE_SET, FUGE_ITERATIVE]
  integer, parameter :: DOUBTFUL(2) = [FUGE_WARN_RESIDUAL, FUGE_WARN_ILL_CONDITIONED]
  character(len=10), parameter :: NAMES(3) = ['tableau   ', 'active set', 'iteration ']
  !> Statuses are counted from the lowest to the highest.
  integer, parameter :: LOWEST = -30, HIGHEST = 5

  call run()

contains

  subroutine run()
    integer :: first, last, k, number, faults(3), statuses(LOWEST:HIGHEST, 3), wrong
    real(dp) :: worst_violation
    type(law_scene) :: scene
    type(known_law) :: known
    type(law_verdict) :: verdict

    last = argument(1, 10000)
    first = argument(2, 1)
    faults = 0
    statuses = 0
    wrong = 0
    worst_violation = 0.0_dp
    do number = first, last
      call draw_laws(number, scene)
      call know_law(scene, known)
      if (known%margin >= 0.0) worst_violation = max(worst_violation, real(known%answer%violation, dp))
      if (known%margin >= 0.0 .and. .not. known%answer%violation <= 1.0e-13) then
        wrong = wrong + 1
        write (output_unit, '(i6,a,es9.1)') number, ' reference', real(known%answer%violation, dp)
      end if
      do k = 1, size(METHODS)
        call judge_law(scene, known, METHODS(k), verdict)
        statuses(verdict%status, k) = statuses(verdict%status, k) + 1
        if (verdict%fault == '' .and. all(verdict%status /= DOUBTFUL)) cycle
        if (verdict%fault /= '') faults(k) = faults(k) + 1
        if (verdict%fault == '') verdict%details = 'status '//text(verdict%status)
        write (output_unit, '(i6,2(a,i0),8(1x,a))') number, ' n', size(scene%alpha, 1), ' m', &
          size(scene%problem%modes, 2), scene%body, scene%load, NAMES(k), verdict%fault, trim(verdict%details)
      end do
    end do
    if (first == last) call print_answers(scene, known)
    write (output_unit, '(/,i0,a,3(1x,i0),a,i0,a,es8.1)') last - first + 1, ' problems, faults:', faults, &
      ', references that fail: ', wrong, ', worst ', worst_violation
    write (output_unit, '(a)') 'status, problems by the tableau, the active set, the iteration:'
    do k = LOWEST, HIGHEST
      if (any(statuses(k, :) > 0)) write (output_unit, '(i6,3i7)') k, statuses(k, :)
    end do
    if (any(faults > 0) .or. wrong > 0) error stop 'an engine is wrong'
  end subroutine run

  !> A whole number from the command line.
  integer function argument(position, default)
    integer, intent(in) :: position, default
    character(len=16) :: word
    integer :: stat

    argument = default
    call get_command_argument(position, word)
    if (len_trim(word) < 1) return
    read (word, *, iostat=stat) argument
    if (stat /= 0) error stop 'compare_laws [last] [first]'
  end function argument

  subroutine print_answers(scene, known)
    type(law_scene), intent(in) :: scene
    type(known_law), intent(in) :: known
    type(fuge_solution) :: solution
    type(fuge_info) :: info
    character(len=*), parameter :: FORM = '(a,12es25.16)'
    integer :: k

    write (output_unit, '(a,es10.2,4l2,es10.2)') 'margin, independent, definite, resists, may resist, violation', &
      real(known%margin, dp), known%independent, known%answer%definite, known%answer%resists, known%answer%may_resist, &
      real(known%answer%violation, dp)
    associate (problem => scene%problem)
      do k = 1, size(scene%alpha, 1)
        write (output_unit, FORM) 'alpha       ', scene%alpha(:, k)
      end do
      write (output_unit, FORM) 'gap         ', problem%gap
      do k = 1, size(problem%modes, 2)
        write (output_unit, FORM) 'mode        ', problem%modes(:, k)
      end do
      write (output_unit, FORM) 'resultant   ', problem%resultant
      if (allocated(problem%gap_upper)) write (output_unit, FORM) 'gap_upper   ', problem%gap_upper
      if (allocated(problem%limit)) write (output_unit, FORM) 'limit       ', problem%limit
      if (allocated(problem%limit_upper)) write (output_unit, FORM) 'limit_upper ', problem%limit_upper
      if (allocated(problem%compliance)) write (output_unit, FORM) 'compliance  ', problem%compliance
      if (allocated(problem%motion_stiffness)) write (output_unit, FORM) 'stiffness   ', problem%motion_stiffness
      if (allocated(problem%motion)) write (output_unit, FORM) 'motion      ', problem%motion
      if (allocated(problem%prescribed)) write (output_unit, '(a,3l2)') 'prescribed ', problem%prescribed
      if (allocated(problem%excluded)) write (output_unit, '(a,12l2)') 'excluded   ', problem%excluded
    end associate
    if (allocated(known%answer%force)) then
      write (output_unit, FORM) 'force  exact', real(known%answer%force, dp)
      write (output_unit, FORM) 'gap    exact', real(known%answer%gap, dp)
      write (output_unit, FORM) 'motion exact', real(known%answer%motion, dp)
    end if
    do k = 1, size(METHODS)
      call solve_general(scene%alpha, scene%problem, solution, info, fuge_options(METHODS(k)))
      write (output_unit, '(a,i4,2es9.1,1x,a)') NAMES(k), info%status, info%residual, info%force_error, &
        trim(info%message)
      if (info%failed()) cycle
      write (output_unit, FORM) 'force       ', solution%force
      write (output_unit, FORM) 'gap         ', solution%gap
      write (output_unit, FORM) 'motion      ', solution%motion
      write (output_unit, '(a,12i3)') 'state       ', solution%state
    end do
  end subroutine print_answers

end program compare_laws
