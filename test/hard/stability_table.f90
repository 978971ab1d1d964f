!> The tables of doc/stability.md: every hard scene solved by all engines, and those of general problems by the active
!> set.
!>
!> stability_table [file] writes them to a file or to the terminal. It ends with an error if an answer without a
!> warning has a large residual.
program stability_table
  use, intrinsic :: iso_fortran_env, only: output_unit, error_unit
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_options_type, only: FUGE_ACTIVE_SET, FUGE_ITERATIVE, FUGE_TABLEAU
  use fuge_problem_type, only: fuge_solution
  use fuge_status, only: fuge_info, FUGE_DONE
  use hard_general, only: general_scene, numbered_general, solve_general_scene, general_force_error, &
    general_gap_error, GENERAL_SCENES
  use hard_run, only: solve_scene, force_error, gap_error, own_violation
  use hard_scenes, only: hard_scene, numbered_scene, SCENES
  use law_reference, only: law_violation
  implicit none

  !> An answer with a larger residual must have a warning.
  real(dp), parameter :: MOST = 1.0e-10_dp

  call run()

contains

  subroutine run()
    character(len=512) :: file
    integer :: number, misses, unit

    unit = output_unit
    call get_command_argument(1, file)
    if (len_trim(file) > 0) open (newunit=unit, file=trim(file), action='write')
    write (unit, '(a)') '| scene | n | what is hard | tableau | pivots | residual | error ' &
      //'| active set | sets | residual | error | iterative | sets | residual | error |'
    write (unit, '(a)') '| --- | ---: | --- | --- | ---: | ---: | ---: | --- | ---: | ---: | ---: ' &
      //'| --- | ---: | ---: | ---: |'
    misses = 0
    do number = 1, SCENES
      call write_row(unit, numbered_scene(number), misses)
    end do
    write (unit, '(a)') ''
    write (unit, '(a)') '| general scene | n | m | what is hard | active set | sets | residual | error |'
    write (unit, '(a)') '| --- | ---: | ---: | --- | --- | ---: | ---: | ---: |'
    do number = 1, GENERAL_SCENES
      call write_general_row(unit, numbered_general(number), misses)
    end do
    if (unit /= output_unit) close (unit)
    if (misses > 0) then
      write (error_unit, '(i0,a)') misses, ' scene(s) missed'
      error stop 1
    end if
  end subroutine run

  subroutine write_row(unit, scene, misses)
    integer, intent(in) :: unit
    type(hard_scene), intent(in) :: scene
    integer, intent(inout) :: misses
    type(fuge_solution) :: slow, fast, iterated
    type(fuge_info) :: slow_info, fast_info, iterated_info
    character(len=:), allocatable :: row

    call solve_scene(scene, FUGE_ACTIVE_SET, fast, fast_info)
    row = '| '//trim(scene%name)//' | '//text(size(scene%gap))//' | '//trim(scene%why)
    if (scene%large) then
      row = row//' | | | | '
    else
      call solve_scene(scene, FUGE_TABLEAU, slow, slow_info)
      row = row//cells(scene, slow_info, slow, fast)
      call check(scene, slow_info, slow, misses)
    end if
    row = row//cells(scene, fast_info, fast, slow)
    call check(scene, fast_info, fast, misses)
    call solve_scene(scene, FUGE_ITERATIVE, iterated, iterated_info)
    row = row//cells(scene, iterated_info, iterated, fast)//' |'
    call check(scene, iterated_info, iterated, misses)
    write (unit, '(a)') row
  end subroutine write_row

  subroutine write_general_row(unit, scene, misses)
    integer, intent(in) :: unit
    type(general_scene), intent(in) :: scene
    integer, intent(inout) :: misses
    type(fuge_solution) :: solution
    type(fuge_info) :: info
    character(len=:), allocatable :: row
    real(dp) :: violation

    call solve_general_scene(scene, solution, info)
    row = '| '//trim(scene%name)//' | '//text(scene%problem%points())//' | '//text(scene%problem%mode_count()) &
      //' | '//trim(scene%why)//' | '//text(info%status)//' | '//text(info%iterations)//' | '
    if (info%failed()) then
      write (unit, '(a)') row//' | |'
      return
    end if
    row = row//short(info%residual)//' | '
    if (allocated(scene%opening)) then
      row = row//short(max(general_force_error(scene, solution), general_gap_error(scene, solution)))
    else if (allocated(scene%force)) then
      row = row//short(general_force_error(scene, solution))//' (forces)'
    end if
    write (unit, '(a)') row//' |'
    violation = law_violation(scene%alpha, scene%problem, solution)
    if (info%status /= FUGE_DONE .or. (info%residual <= MOST .and. violation <= MOST)) return
    misses = misses + 1
    write (error_unit, '(a,2es12.3)') trim(scene%name), info%residual, violation
  end subroutine write_general_row

  !> Status, iterations, residual, error against the known answer or the other engine.
  function cells(scene, info, solution, other) result(row)
    type(hard_scene), intent(in) :: scene
    type(fuge_info), intent(in) :: info
    type(fuge_solution), intent(in) :: solution, other
    character(len=:), allocatable :: row

    row = ' | '//text(info%status)//' | '//text(info%iterations)//' | '
    if (info%failed()) then
      row = row//' | '
      return
    end if
    row = row//short(info%residual)//' | '
    if (allocated(scene%force)) then
      row = row//short(max(force_error(scene, scene%force, solution%force), gap_error(scene, solution)))
    else if (allocated(scene%opening)) then
      row = row//short(gap_error(scene, solution))//' (gaps)'
    else if (allocated(other%force)) then
      row = row//short(force_error(scene, other%force, solution%force))//' (other)'
    end if
  end function cells

  !> Count an answer without a warning whose residual, by the library or by one_sided_reference, is large.
  subroutine check(scene, info, solution, misses)
    type(hard_scene), intent(in) :: scene
    type(fuge_info), intent(in) :: info
    type(fuge_solution), intent(in) :: solution
    integer, intent(inout) :: misses
    logical :: fine

    fine = info%status /= FUGE_DONE
    if (.not. fine) fine = info%residual <= MOST .and. own_violation(scene, solution) <= MOST
    if (fine) return
    misses = misses + 1
    write (error_unit, '(a)') trim(scene%name)//': '//trim(info%message)
    if (.not. info%failed()) write (error_unit, '(2es12.3)') info%residual, own_violation(scene, solution)
  end subroutine check

  !> One digit and a power of ten.
  function short(value) result(string)
    real(dp), intent(in) :: value
    character(len=:), allocatable :: string
    integer :: power, digit

    string = '0'
    if (.not. value > 0.0_dp) return
    power = floor(log10(value))
    digit = nint(value/10.0_dp**power)
    if (digit == 10) then
      digit = 1
      power = power + 1
    end if
    string = text(digit)//'e'//text(power)
  end function short

end program stability_table
