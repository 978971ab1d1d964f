!> A measured surface under a rigid plane: from the file to the tables.
module surface_problem
  use, intrinsic :: iso_fortran_env, only: error_unit
  use command_line, only: arguments, refuse
  use fuge_area, only: fuge_halfspace_operator
  use fuge_core, only: dp => fuge_dp, fuge_info, fuge_options, fuge_problem, fuge_proof, fuge_prove, fuge_solution, &
    fuge_solver, FUGE_ERR_MEMORY
  use fuge_files, only: fuge_surface
  use number_words, only: number_text, short_text
  use problem_solution, only: take_warning
  use progress_log, only: progress
  use surface_fields, only: check_name, write_fields
  use surface_file, only: read_heights, rms_slope
  use surface_options, only: surface_settings, take_settings
  use surface_table, only: load_results, write_loads
  implicit none
  private

  public :: solve_surface

contains

  !> --surface.
  subroutine solve_surface(given, options, log, info)
    type(arguments), intent(in) :: given
    type(fuge_options), intent(in) :: options
    type(progress), intent(in) :: log
    type(fuge_info), intent(inout) :: info
    type(surface_settings) :: settings
    type(fuge_surface) :: surface
    type(fuge_problem) :: problem
    type(fuge_solution) :: solution
    type(load_results), allocatable :: results(:)
    character(len=:), allocatable :: note

    settings%options = options
    call take_settings(given, settings, info)
    if (given%has('field') .and. .not. info%failed()) call check_name(given%file('field'), info)
    if (.not. info%failed()) call read_heights(given%file('surface'), settings, surface, info)
    if (info%failed()) return
    call log%say(number_text(size(surface%height, 1))//' x '//number_text(size(surface%height, 2)) &
                 //' heights are read, '//number_text(surface%filled)//' of them filled')
    note = ''
    if (rms_slope(surface) > 1.0_dp) &
      call add_note('the mean slope of the surface is '//short_text(rms_slope(surface))//', too steep for a ' &
                    //'half-space: if its heights have another unit than its spacings, give --height-scale', note)
    call set_gap(surface, problem, info)
    if (.not. info%failed()) call solve_loads(settings, surface, problem, solution, results, note, log, info)
    if (info%failed()) return
    if (given%has('field')) call write_fields(given%file('field'), surface, solution, info)
    if (.not. info%failed()) call write_loads(given%file('output'), given%file('surface'), settings, surface, results, &
                                              note, info)
  end subroutine solve_surface

  !> Gaps to a plane at the highest point. Error: FUGE_ERR_MEMORY.
  subroutine set_gap(surface, problem, info)
    type(fuge_surface), intent(in) :: surface
    type(fuge_problem), intent(inout) :: problem
    type(fuge_info), intent(inout) :: info
    real(dp) :: highest
    integer :: j, nx, status

    nx = size(surface%height, 1)
    allocate (problem%gap(size(surface%height)), problem%resultant(1), stat=status)
    if (status /= 0) then
      info%status = FUGE_ERR_MEMORY
      info%message = 'no memory for the gaps of '//number_text(size(surface%height))//' points'
      return
    end if
    highest = maxval(surface%height)
    do j = 1, size(surface%height, 2)
      problem%gap(nx*(j - 1) + 1:nx*j) = highest - surface%height(:, j)
    end do
  end subroutine set_gap

  !> All loads, one after the other; `solution` is that of the last one. `info` has the first warning and the largest
  !> residual, `note` gets what the library remarks without a warning.
  subroutine solve_loads(settings, surface, problem, solution, results, note, log, info)
    type(surface_settings), intent(in) :: settings
    type(fuge_surface), intent(in) :: surface
    type(fuge_problem), intent(inout) :: problem
    type(fuge_solution), intent(inout) :: solution
    type(load_results), allocatable, intent(inout) :: results(:)
    character(len=:), allocatable, intent(inout) :: note
    type(progress), intent(in) :: log
    type(fuge_info), intent(inout) :: info
    type(fuge_halfspace_operator) :: operator
    type(fuge_solver) :: solver
    type(fuge_proof) :: proof
    type(fuge_info) :: of_load
    real(dp) :: area
    integer :: k

    call operator%set(size(surface%height, 1), size(surface%height, 2), surface%spacing_x, surface%spacing_y, &
                      settings%e_star, info, element=settings%element, boundary=settings%boundary)
    if (info%failed()) return
    area = real(size(surface%height), dp)*surface%spacing_x*surface%spacing_y
    allocate (results(size(settings%load)))
    do k = 1, size(settings%load)
      problem%resultant = settings%load(k)
      if (settings%of_pressure) problem%resultant = settings%load(k)*area
      call solver%solve(operator, problem, solution, of_load, settings%options)
      if (of_load%failed()) then
        info = of_load
        info%message = 'load '//number_text(k)//': '//of_load%message
        return
      end if
      if (of_load%status == 0 .and. len_trim(of_load%message) > 0) call add_note(trim(of_load%message), note)
      call take_warning(of_load, info)
      info%residual = max(info%residual, of_load%residual)
      if (settings%prove) call prove_load(operator, problem, solution, proof, note, of_load, info)
      if (info%failed()) return
      call results(k)%take(surface, problem, solution, proof, of_load)
      if (settings%of_pressure) results(k)%pressure = settings%load(k)
      call log%say('load '//number_text(k)//' of '//number_text(size(settings%load))//': ' &
                   //number_text(of_load%contacts)//' cells touch, '//number_text(of_load%products)//' products')
    end do
  end subroutine solve_loads

  !> Bound the error of the solution under one load. A warning is one of all loads, and of this one unless it has one
  !> already.
  subroutine prove_load(operator, problem, solution, proof, note, of_load, info)
    type(fuge_halfspace_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(fuge_proof), intent(inout) :: proof
    character(len=:), allocatable, intent(inout) :: note
    type(fuge_info), intent(inout) :: of_load, info
    type(fuge_info) :: of_proof

    call fuge_prove(operator, problem, solution, proof, of_proof)
    if (of_proof%failed()) then
      info = of_proof
      return
    end if
    if (of_proof%status == 0 .and. len_trim(of_proof%message) > 0) call add_note(trim(of_proof%message), note)
    call take_warning(of_proof, info)
    if (of_load%status == 0) of_load%status = of_proof%status
  end subroutine prove_load

  !> Say a remark on standard error, once, and keep it for the table.
  subroutine add_note(remark, note)
    character(len=*), intent(in) :: remark
    character(len=:), allocatable, intent(inout) :: note

    if (index(note, remark) > 0) return
    write (error_unit, '(2a)') 'fuge: note: ', remark
    if (len(note) > 0) note = note//'; '
    note = note//remark
  end subroutine add_note

end module surface_problem
