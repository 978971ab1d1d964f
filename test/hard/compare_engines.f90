!> Solves random scenes by the active set and by the iteration, and prints where they disagree.
!>
!> compare_engines [last] [first] [tableau|steps]: scenes `first` to `last`, by default 1 to 10000; `tableau` compares
!> the tableau with the active set instead of the iteration; with `steps` one solver of the iteration follows a sequence
!> of loads. With first = last it prints the scene and both answers. It ends with an error if there is a disagreement.
program compare_engines
  use, intrinsic :: iso_fortran_env, only: output_unit
  use engine_judge, only: engine_verdict, judge_scene, judge_steps, solve_scene_by
  use engine_scene_type, only: engine_scene
  use fuge_kinds, only: dp
  use fuge_options_type, only: FUGE_ACTIVE_SET, FUGE_ITERATIVE, FUGE_TABLEAU
  use fuge_problem_type, only: fuge_solution
  use fuge_status, only: fuge_info
  use random_scenes, only: draw_scene
  implicit none

  !> Statuses are counted from the lowest to the highest.
  integer, parameter :: LOWEST = -30, HIGHEST = 5
  !> The dearest scenes that are listed.
  integer, parameter :: LISTED = 10

  call run()

contains

  subroutine run()
    integer :: dear, first, last, method, number, faults, statuses(LOWEST:HIGHEST)
    real(dp) :: dearest(3, LISTED), spread_of(3)
    character(len=8) :: word
    type(engine_verdict) :: verdict
    type(engine_scene) :: scene
    type(fuge_info) :: info(2)

    last = argument(1, 10000)
    first = argument(2, 1)
    call get_command_argument(3, word)
    method = merge(FUGE_TABLEAU, FUGE_ITERATIVE, word == 'tableau')
    dear = 0
    faults = 0
    statuses = 0
    dearest = 0.0_dp
    spread_of = 0.0_dp
    write (output_unit, '(a)') 'scene    n body                     motions            stops              load' &
      //'                     fault'
    do number = first, last
      call draw_scene(number, scene)
      if (word == 'steps') then
        call judge_steps(scene, verdict, info)
      else
        call judge_scene(scene, [FUGE_ACTIVE_SET, method], verdict, info)
      end if
      statuses(verdict%status(1)) = statuses(verdict%status(1)) + 1
      if (verdict%fault == 'cost') then
        dear = dear + 1
      else if (verdict%fault /= '') then
        faults = faults + 1
      end if
      if (verdict%fault /= '') write (output_unit, '(i6,i5,6(1x,a))') number, verdict%points, scene%body, &
        scene%motions(:18), scene%stops(:18), scene%load(:24), verdict%fault, trim(verdict%details)
      call keep_dearest(verdict, number, dearest)
      call widen(verdict, spread_of)
    end do
    if (first == last) call print_answers(scene, method)
    call print_summary(last - first + 1, [faults, dear], statuses, dearest, spread_of)
    if (faults > 0) error stop 'the engines disagree'
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
    if (stat /= 0) error stop 'compare_engines [last] [first] [tableau|steps]'
  end function argument

  !> Keep the scenes with the most products for each point.
  subroutine keep_dearest(verdict, number, dearest)
    type(engine_verdict), intent(in) :: verdict
    integer, intent(in) :: number
    real(dp), intent(inout) :: dearest(:, :)
    real(dp) :: cost
    integer :: least

    cost = real(verdict%products, dp)/real(verdict%points, dp)
    least = minloc(dearest(1, :), dim=1)
    if (cost > dearest(1, least)) dearest(:, least) = [cost, real(number, dp), real(verdict%points, dp)]
  end subroutine keep_dearest

  !> The largest difference of forces, for conditions up to 1e4, up to 1e8, and beyond.
  subroutine widen(verdict, spread_of)
    type(engine_verdict), intent(in) :: verdict
    real(dp), intent(inout) :: spread_of(3)
    integer :: class

    if (.not. verdict%condition > 0.0_dp) return
    class = 1
    if (verdict%condition > 1.0e4_dp) class = 2
    if (verdict%condition > 1.0e8_dp) class = 3
    spread_of(class) = max(spread_of(class), verdict%difference)
  end subroutine widen

  subroutine print_summary(scenes, faults, statuses, dearest, spread_of)
    integer, intent(in) :: scenes, faults(2), statuses(LOWEST:)
    real(dp), intent(in) :: dearest(:, :), spread_of(:)
    integer :: k

    write (output_unit, '(/,3(i0,a))') scenes, ' scenes, ', faults(1), ' disagreement(s), ', faults(2), &
      ' of many products'
    write (output_unit, '(a)') 'status of the active set, scenes:'
    do k = lbound(statuses, 1), ubound(statuses, 1)
      if (statuses(k) > 0) write (output_unit, '(i6,i7)') k, statuses(k)
    end do
    write (output_unit, '(a,3(1x,es8.1))') 'largest difference of forces for conditions up to 1e4, 1e8, beyond:', &
      spread_of
    write (output_unit, '(a)') 'products for each point, scene, points:'
    do k = 1, size(dearest, 2)
      write (output_unit, '(f9.1,i9,i5)') dearest(1, k), nint(dearest(2, k)), nint(dearest(3, k))
    end do
  end subroutine print_summary

  subroutine print_answers(scene, method)
    type(engine_scene), intent(in) :: scene
    integer, intent(in) :: method
    type(fuge_solution) :: solution(2)
    type(fuge_info) :: info(2)
    integer :: k

    call solve_scene_by(scene, FUGE_ACTIVE_SET, solution(1), info(1))
    call solve_scene_by(scene, method, solution(2), info(2))
    write (output_unit, '(/,4(a,1x))') scene%body, scene%motions, scene%stops, scene%load
    do k = 1, 2
      write (output_unit, '(a,i0,a,i0,a,i0,a,es8.1,2a)') 'status ', info(k)%status, ', products ', info(k)%products, &
        ', iterations ', info(k)%iterations, ', residual ', info(k)%residual, ' ', trim(info(k)%message)
    end do
    if (allocated(scene%problem%resultant)) write (output_unit, '(a,4es24.16)') 'resultant ', scene%problem%resultant
    if (allocated(scene%problem%prescribed)) write (output_unit, '(a,4l2,4es24.16)') 'prescribed', &
      scene%problem%prescribed, scene%problem%motion
    do k = 1, 2
      if (allocated(solution(k)%motion)) write (output_unit, '(a,4es24.16)') 'motion    ', solution(k)%motion
    end do
    do k = 1, size(scene%alpha, 2)
      write (output_unit, '(i4,a)', advance='no') k, ' gap'
      write (output_unit, '(es12.4)', advance='no') scene%problem%gap(k)
      if (allocated(scene%problem%gap_upper)) write (output_unit, '(a,es11.3)', advance='no') ' play', &
        scene%problem%gap_upper(k)
      if (allocated(scene%problem%excluded)) write (output_unit, '(l2)', advance='no') scene%problem%excluded(k)
      if (allocated(scene%problem%modes)) write (output_unit, '(a,4es11.3)', advance='no') ' R', &
        scene%problem%modes(k, :)
      write (output_unit, '(a)', advance='no') ' f, c'
      if (allocated(solution(1)%force)) write (output_unit, '(2es14.6)', advance='no') solution(1)%force(k), &
        solution(1)%gap(k)
      if (allocated(solution(2)%force)) write (output_unit, '(2es14.6)', advance='no') solution(2)%force(k), &
        solution(2)%gap(k)
      write (output_unit, '(a)') ''
    end do
    if (size(scene%alpha, 2) > 6) return
    do k = 1, size(scene%alpha, 2)
      write (output_unit, '(a,6es24.16)') 'alpha', scene%alpha(k, :)
    end do
  end subroutine print_answers

end program compare_engines
