!> A contact problem from files to a table, for a code that cannot link the library.
!>
!> With an influence matrix:
!>
!>     solve_mtx --alpha FILE --gap FILE MOTION [--play FILE] [--output FILE]
!>
!> With the stiffness matrix of a body, which is condensed to the influence matrix:
!>
!>     solve_mtx --stiffness FILE --contact FILE --gap FILE [--fixed FILE] [--floats]
!>               [--external FILE] [MOTION] [--play FILE] [--output FILE] [--field FILE]
!>
!> MOTION is that of the rigid counter-body: one of
!>
!>     --load F0                           it is pressed on with this force
!>     --approach V0                       it is moved by this length
!>     --modes FILE --resultant FILE       rigid motions in general (only with --alpha)
!>
!> With a stiffness matrix it may be omitted: the counter-body then stands still. All files are in Matrix Market
!> format, array or coordinate, real or integer; n points, nd degrees of freedom from 1:
!>
!>     --alpha      n x n, displacement per force
!>     --gap        n, initial gaps
!>     --play       n, distance of the second stop; -1 where there is none, 0 ties the point
!>     --modes      n x m, how far each point closes per unit of each rigid motion
!>     --resultant  m, of the contact forces in each motion
!>     --stiffness  nd x nd, force per displacement
!>     --contact    n x nd: row i holds the direction in which the force of point i acts on
!>                  the body, into the body, in the columns of its degrees of freedom
!>     --fixed      k x 1, degrees of freedom that are held; or k x 2, with displacements
!>     --external   nd, external forces
!>     --floats     the supports leave rigid motions, which the contact has to resist
!>     --output     table of point, force and gap; without it on standard output
!>     --field      table of all displacements of the body
!>
!> Units are the user's. Tables are CSV with comments after #: status, residual, rigid motions and
!> their resultants. Exit status 0: done (a warning goes to standard error and to the
!> table); 1: an error, the message is on standard error and the table of forces is not written.
program solve_mtx
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_positive_inf
  use, intrinsic :: iso_c_binding, only: c_int
  use, intrinsic :: iso_fortran_env, only: error_unit
  use fuge, only: dp => fuge_dp, fuge_dense_operator, fuge_info, fuge_problem, fuge_solution, fuge_solver
  use solve_mtx_arguments, only: arguments, print_help
  use solve_mtx_body, only: elastic_body
  use solve_mtx_files, only: read_square, read_vector, read_modes
  use solve_mtx_tables, only: write_contact, write_field
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
    if (info%failed()) call give_up(info)
    if (given%has('help')) then
      call print_help()
    else if (given%has('alpha')) then
      call solve_influence(given)
    else
      call solve_body(given)
    end if
  end subroutine run

  subroutine solve_influence(given)
    type(arguments), intent(in) :: given
    real(dp), allocatable, target :: alpha(:, :)
    type(fuge_problem) :: problem
    type(fuge_solution) :: solution
    type(fuge_info) :: info

    call read_square(given%file('alpha'), alpha, info)
    if (.not. info%failed()) call read_vector(given%file('gap'), size(alpha, 1), problem%gap, info)
    if (.not. info%failed()) call take_play(given, problem, info)
    if (.not. info%failed()) call take_motion(given, problem, info)
    if (info%failed()) call give_up(info)
    call solve(alpha, problem, solution, info)
    call write_contact(given%file('output'), problem, solution, info)
    if (info%failed()) call give_up(info)
  end subroutine solve_influence

  subroutine solve_body(given)
    type(arguments), intent(in) :: given
    type(elastic_body), target :: body
    type(fuge_problem) :: problem
    type(fuge_solution) :: solution
    type(fuge_info) :: info, of_body, of_field
    real(dp), allocatable :: field(:)

    call body%read(given, of_body)
    if (of_body%failed()) call give_up(of_body)
    call read_vector(given%file('gap'), body%points(), problem%gap, info)
    if (.not. info%failed()) call take_play(given, problem, info)
    if (.not. info%failed()) call take_motion(given, problem, info)
    if (.not. info%failed()) call body%pose(problem, info)
    if (info%failed()) call give_up(info)
    call solve(body%condensed%alpha, problem, solution, info)
    call take_warning(of_body, info)
    if (given%has('field')) then
      call body%recover(solution, field, of_field)
      if (.not. of_field%failed()) call write_field(given%file('field'), field, of_field)
      if (of_field%failed()) call give_up(of_field)
      call take_warning(of_field, info)
    end if
    call write_contact(given%file('output'), problem, solution, info)
    if (info%failed()) call give_up(info)
  end subroutine solve_body

  !> A warning of one step is a warning of the solve.
  subroutine take_warning(part, info)
    type(fuge_info), intent(in) :: part
    type(fuge_info), intent(inout) :: info

    call warn(part)
    if (info%status /= 0 .or. part%status == 0) return
    info%status = part%status
    info%message = part%message
  end subroutine take_warning

  !> Second stops; -1 is none.
  subroutine take_play(given, problem, info)
    type(arguments), intent(in) :: given
    type(fuge_problem), intent(inout) :: problem
    type(fuge_info), intent(inout) :: info

    if (.not. given%has('play')) return
    call read_vector(given%file('play'), size(problem%gap), problem%gap_upper, info)
    if (info%failed()) return
    where (abs(problem%gap_upper + 1.0_dp) <= 0.0_dp) problem%gap_upper = ieee_value(1.0_dp, ieee_positive_inf)
  end subroutine take_play

  !> Rigid motions of the counter-body.
  subroutine take_motion(given, problem, info)
    type(arguments), intent(in) :: given
    type(fuge_problem), intent(inout) :: problem
    type(fuge_info), intent(inout) :: info

    if (given%has('modes')) then
      call read_modes(given%file('modes'), given%file('resultant'), size(problem%gap), problem, info)
    else if (given%has('load')) then
      problem%resultant = [given%number('load')]
    else if (given%has('approach')) then
      problem%resultant = [0.0_dp]
      problem%prescribed = [.true.]
      problem%motion = [given%number('approach')]
    else
      allocate (problem%modes(size(problem%gap), 0), problem%resultant(0))
    end if
  end subroutine take_motion

  subroutine solve(alpha, problem, solution, info)
    real(dp), intent(in), target, contiguous :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(out) :: info
    type(fuge_dense_operator) :: operator
    type(fuge_solver) :: solver

    call operator%set(alpha, info)
    if (.not. info%failed()) call solver%solve(operator, problem, solution, info)
    if (info%failed()) call give_up(info)
    call warn(info)
  end subroutine solve

  subroutine warn(info)
    type(fuge_info), intent(in) :: info

    if (info%status > 0) write (error_unit, '(2a)') 'solve_mtx: warning: ', trim(info%message)
  end subroutine warn

  subroutine give_up(info)
    type(fuge_info), intent(in) :: info

    write (error_unit, '(2a)') 'solve_mtx: ', trim(info%message)
    flush (error_unit)
    call c_exit(1_c_int)
  end subroutine give_up

end program solve_mtx
