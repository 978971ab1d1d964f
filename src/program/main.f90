!> Contact problems from files to tables, for codes that do not link the library. `fuge --help` and the man page
!> fuge(1) describe it.
program fuge_program
  use, intrinsic :: iso_c_binding, only: c_int
  use, intrinsic :: iso_fortran_env, only: error_unit
  use chosen_stiffness, only: STORAGE
  use chosen_transforms, only: TRANSFORMS
  use command_line, only: arguments
  use deck_problem, only: solve_deck
  use fuge_core, only: fuge_info, fuge_options, FUGE_VERSION
  use matrix_problem, only: solve_body, solve_influence
  use mesh_problem, only: solve_meshes
  use option_checks, only: check_options, WITH_ALPHA, WITH_DECK, WITH_MATRICES, WITH_MESHES, WITH_SURFACE
  use option_table, only: HELP
  use progress_log, only: progress
  use solver_options, only: take_solver_options
  use surface_problem, only: solve_surface
  use text_table, only: table
  implicit none

  interface
    !> exit of C: `stop` would add lines of its own to the message.
    subroutine c_exit(status) bind(c, name='exit')
      import :: c_int
      integer(c_int), intent(in), value :: status
    end subroutine c_exit
  end interface

  call run()

contains

  subroutine run()
    type(arguments) :: given
    type(fuge_info) :: info

    call given%read(info)
    if (info%failed()) then
      continue
    else if (given%has('help')) then
      call print_lines(HELP, info)
    else if (given%has('version')) then
      call print_lines([character(len=80) :: 'fuge '//FUGE_VERSION, TRANSFORMS, STORAGE], info)
    else
      call solve(given, info)
    end if
    if (info%failed()) call give_up(info)
  end subroutine run

  !> Error: FUGE_ERR_FILE if standard output does not take all.
  subroutine print_lines(lines, info)
    character(len=*), intent(in) :: lines(:)
    type(fuge_info), intent(inout) :: info
    type(table) :: output
    integer :: k

    call output%create('', info)
    if (info%failed()) return
    do k = 1, size(lines)
      call output%put(lines(k))
    end do
    call output%finish(info)
  end subroutine print_lines

  subroutine solve(given, info)
    type(arguments), intent(in) :: given
    type(fuge_info), intent(inout) :: info
    type(fuge_options) :: options
    type(progress) :: log
    integer :: kind

    call check_options(given, kind, info)
    call take_solver_options(given, options, info)
    if (info%failed()) return
    call log%start(given%has('verbose'))
    select case (kind)
    case (WITH_ALPHA)
      call solve_influence(given, options, log, info)
    case (WITH_MATRICES)
      call solve_body(given, options, log, info)
    case (WITH_MESHES)
      call solve_meshes(given, options, log, info)
    case (WITH_DECK)
      call solve_deck(given, options, log, info)
    case (WITH_SURFACE)
      call solve_surface(given, options, log, info)
    end select
    if (.not. info%failed()) call log%say('done')
  end subroutine solve

  subroutine give_up(info)
    type(fuge_info), intent(in) :: info

    write (error_unit, '(2a)') 'fuge: ', trim(info%message)
    flush (error_unit)
    call c_exit(1_c_int)
  end subroutine give_up

end program fuge_program
