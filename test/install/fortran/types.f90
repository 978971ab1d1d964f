!> Every public type of an installed fuge: made, passed on as class, extended, copied and freed.
module own_types
  use fuge, only: dp => fuge_dp, fuge_monitor, fuge_operator
  implicit none
  private

  !> An operator of one's own: a diagonal. What it does not override are the library's.
  type, extends(fuge_operator), public :: springs
    real(dp) :: flexibility = 0.0_dp
    integer :: count = 0
  contains
    procedure :: points
    procedure :: apply
  end type springs

  type, extends(fuge_monitor), public :: counter
    integer :: calls = 0
  contains
    procedure :: progress
  end type counter

contains

  pure function points(self) result(n)
    class(springs), intent(in) :: self
    integer :: n

    n = self%count
  end function points

  subroutine apply(self, force, displacement, status)
    class(springs), intent(in) :: self
    real(dp), intent(in) :: force(:)
    real(dp), intent(out) :: displacement(:)
    integer, intent(out) :: status

    displacement = self%flexibility*force
    status = 0
  end subroutine apply

  subroutine progress(self, iteration, residual, contacts, cancel)
    class(counter), intent(inout) :: self
    integer, intent(in) :: iteration, contacts
    real(dp), intent(in) :: residual
    logical, intent(out) :: cancel

    self%calls = self%calls + 1
    cancel = iteration < 0 .or. residual < 0.0_dp .or. contacts < 0
  end subroutine progress

end module own_types

program types
  use fuge, only: dp => fuge_dp, fuge_band_stiffness, fuge_body, fuge_condense, fuge_condensed, fuge_contact_edges, &
    fuge_dense_operator, fuge_dense_stiffness, fuge_follow_path, &
    fuge_halfplane_matrix, fuge_halfplane_operator, fuge_history, fuge_info, fuge_interval, fuge_load_path, &
    fuge_operator, fuge_options, fuge_path, fuge_problem, fuge_residual, fuge_solution, fuge_solver, &
    fuge_status_text, fuge_stiffness, fuge_violation, FUGE_DONE, FUGE_ERR_UNSUPPORTED, FUGE_MEAN, FUGE_TABLEAU
  use own_types, only: counter, springs
  implicit none

  integer, parameter :: N = 40
  real(dp), parameter :: LOAD = 1.0e-3_dp

  call run()

contains

  subroutine run()
    real(dp), target :: alpha(N, N)
    real(dp) :: x(N), width(N), gap(N)
    type(fuge_dense_operator) :: dense
    type(fuge_halfplane_operator) :: cells
    type(fuge_info) :: info
    integer :: k

    x = [(real(k, dp) - 0.5_dp*real(N + 1, dp), k=1, N)]
    width = 1.0_dp
    gap = 1.0e-4_dp*x**2
    call fuge_halfplane_matrix(x, width, 1.0_dp, FUGE_MEAN, alpha, info)
    call expect(info%status == FUGE_DONE, 'matrix: '//trim(info%message))
    call dense%set(alpha, info)
    call expect(info%status == FUGE_DONE, 'dense: '//trim(info%message))
    call cells%set(N, 1.0_dp, 1.0_dp, info)
    call expect(info%status == FUGE_DONE, 'halfplane: '//trim(info%message))
    call solve_with(dense, gap, 'dense')
    call solve_with(cells, gap, 'halfplane')
    call solve_with(springs(1.0_dp, N), gap, 'springs')
    call follow(dense, gap)
    call look_at_edges(dense, x, width, gap)
    call condense()
    call expect(fuge_status_text(FUGE_DONE) == 'done', 'status text')
    print '(a)', 'all types are there'
  end subroutine run

  subroutine solve_with(operator, gap, name)
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: gap(:)
    character(len=*), intent(in) :: name
    class(fuge_operator), allocatable :: coarse
    type(fuge_solver), allocatable :: solver
    type(fuge_problem) :: problem
    type(fuge_solution) :: solution, copy
    type(fuge_violation) :: violation
    type(fuge_info) :: info, check
    type(counter) :: monitor

    allocate (solver)
    problem%gap = gap
    problem%resultant = [LOAD]
    call solver%solve(operator, problem, solution, info, monitor=monitor)
    call expect(info%status == FUGE_DONE, name//': '//trim(info%message))
    call expect(monitor%calls > 0, name//': the monitor was not called')
    copy = solution
    call fuge_residual(operator, problem, copy, violation, check)
    call expect(violation%worst() < 1.0e-10_dp, name//': the residual is large')
    call operator%coarsen(1, coarse)
    if (allocated(coarse)) call expect(coarse%points() < operator%points(), name//': no coarser')
  end subroutine solve_with

  subroutine follow(dense, gap)
    type(fuge_dense_operator), intent(in) :: dense
    real(dp), intent(in) :: gap(:)
    type(fuge_options) :: options
    type(fuge_history) :: history
    type(fuge_path) :: path
    type(fuge_path) :: general
    type(fuge_problem) :: start
    type(fuge_solver) :: solver
    type(fuge_solution) :: solution
    type(fuge_info) :: info

    call fuge_load_path(dense, gap, LOAD, path, info)
    call expect(path%entries > 1, 'load path: '//trim(info%message))
    start%gap = gap
    start%resultant = [0.5_dp*LOAD]
    call fuge_follow_path(dense, start, [LOAD], general, info)
    call expect(general%entries > 0, 'general path: '//trim(info%message))
    options%method = FUGE_TABLEAU
    options%keep_history = .true.
    call solver%solve(dense, start, solution, info, options)
    history = solver%history
    call expect(history%recorded() > 1, 'history: '//trim(info%message))
    call expect(len(history%line(0)) > 0, 'history: a line')
    call fuge_load_path(springs(1.0_dp, N), gap, LOAD, path, info)
    call expect(info%status == FUGE_ERR_UNSUPPORTED, 'a load path without a matrix')
  end subroutine follow

  subroutine look_at_edges(dense, x, width, gap)
    type(fuge_dense_operator), intent(in) :: dense
    real(dp), intent(in) :: x(:), width(:), gap(:)
    type(fuge_interval), allocatable :: intervals(:)
    type(fuge_problem) :: problem
    type(fuge_solver) :: solver
    type(fuge_solution) :: solution
    type(fuge_info) :: info

    problem%gap = gap
    problem%resultant = [LOAD]
    call solver%solve(dense, problem, solution, info)
    call fuge_contact_edges(x, width, solution%force, FUGE_MEAN, intervals, info)
    call expect(size(intervals) == 1, 'edges: '//trim(info%message))
  end subroutine look_at_edges

  subroutine condense()
    real(dp), target :: matrix(3, 3), band(2, 3)
    type(fuge_dense_stiffness) :: full
    type(fuge_band_stiffness) :: narrow
    type(fuge_info) :: info

    band(1, :) = 2.0_dp
    band(2, :) = -1.0_dp
    matrix = 0.0_dp
    matrix(:2, 1) = [2.0_dp, -1.0_dp]
    matrix(:, 2) = [-1.0_dp, 2.0_dp, -1.0_dp]
    matrix(2:, 3) = [-1.0_dp, 2.0_dp]
    call full%set(matrix, info)
    call expect(info%status == FUGE_DONE, 'dense stiffness: '//trim(info%message))
    call narrow%set(band, .false., info)
    call expect(info%status == FUGE_DONE, 'band: '//trim(info%message))
    call condense_to_the_middle(full)
    call condense_to_the_middle(narrow)
  end subroutine condense

  subroutine condense_to_the_middle(stiffness)
    class(fuge_stiffness), intent(in) :: stiffness
    type(fuge_body) :: body
    type(fuge_condensed) :: condensed
    type(fuge_info) :: info

    allocate (body%dof(1, 1), body%normal(1, 1))
    body%dof = 2
    body%normal = 1.0_dp
    call fuge_condense(stiffness, body, condensed, info)
    call expect(info%status == FUGE_DONE, 'condensation: '//trim(info%message))
    call expect(abs(condensed%alpha(1, 1) - 1.0_dp) < 1.0e-12_dp, 'the middle of a chain')
  end subroutine condense_to_the_middle

  subroutine expect(condition, message)
    logical, intent(in) :: condition
    character(len=*), intent(in) :: message

    if (condition) return
    print '(a)', message
    error stop
  end subroutine expect

end program types
