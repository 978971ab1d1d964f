! Modes, play, excluded points, prescribed motions and derivatives: the ranks find what one process finds.
program general
  use fuge_adjoint_solution, only: fuge_solve_adjoint
  use fuge_gradients_type, only: fuge_gradients
  use fuge_halfplane_fft, only: fuge_halfplane_operator
  use fuge_halfspace_fft, only: fuge_halfspace_operator
  use fuge_kinds, only: dp
  use fuge_mpi, only: fuge_mpi_halfplane_operator, fuge_mpi_halfspace_operator
  use fuge_operator_type, only: fuge_operator
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_solver_type, only: fuge_solver
  use fuge_status, only: fuge_info, FUGE_DONE, FUGE_ERR_MODES, FUGE_ERR_NO_EQUILIBRIUM, FUGE_ERR_OPTION
  use fuge_wanted_pressure, only: fuge_gap_for_pressure, fuge_wanted_contact
  use mpi_f08
  use rank_checks, only: begin_checks, check_solution, end_checks, expect, gather, my_rank
  implicit none

  ! What a problem has.
  integer, parameter :: TILTS = 1, PLAY = 2, EXCLUSIONS = 4, HELD = 8, FAR = 16

  call begin_checks()
  call run()
  call end_checks()

contains

  subroutine run()
    call surfaces('excluded points', EXCLUSIONS)
    call surfaces('play', PLAY)
    call surfaces('tilts', TILTS)
    call surfaces('tilts about a far point', TILTS + FAR)
    call surfaces('a tilt held', TILTS + HELD)
    call surfaces('all of them', TILTS + PLAY + EXCLUSIONS)
    call surfaces('an approach held', HELD + EXCLUSIONS)
    call line_with('line: a tilt, excluded points', TILTS + EXCLUSIONS)
    call line_with('line: play', PLAY)
    call refuse()
  end subroutine run

  ! Points first .. of a surface of nx columns: the gap of a wavy paraboloid, and what `parts` says.
  pure subroutine fill(nx, ny, first, count, parts, problem)
    integer, intent(in) :: nx, ny, first, count, parts
    type(fuge_problem), intent(out) :: problem
    real(dp) :: x, y
    integer :: k

    allocate (problem%gap(count))
    if (iand(parts, PLAY) > 0) allocate (problem%gap_upper(count))
    if (iand(parts, EXCLUSIONS) > 0) allocate (problem%excluded(count))
    if (iand(parts, TILTS) > 0) allocate (problem%modes(count, merge(2, 3, ny == 1)))
    do k = 1, count
      x = (real(modulo(first + k - 2, nx), dp) + 0.5_dp)/nx - 0.5_dp
      y = (real((first + k - 2)/nx, dp) + 0.5_dp)/max(ny, 2) - 0.5_dp
      problem%gap(k) = 0.5_dp*(x**2 + y**2) + 0.002_dp*sin(24.0_dp*x + 0.4_dp)*cos(17.0_dp*y)
      if (allocated(problem%gap_upper)) then
        problem%gap_upper(k) = 0.004_dp + 0.001_dp*cos(9.0_dp*x)
        if (x > 0.3_dp) problem%gap_upper(k) = huge(x)
        ! The upper stop is in reach, too.
        problem%gap(k) = merge(0.2_dp, 0.01_dp, ny == 1)*problem%gap(k)
      end if
      if (allocated(problem%excluded)) problem%excluded(k) = (x - 0.05_dp)**2 + y**2 < 0.005_dp
      if (.not. allocated(problem%modes)) cycle
      problem%modes(k, :2) = [1.0_dp, x]
      if (ny > 1) problem%modes(k, 3) = y
      if (iand(parts, FAR) > 0) problem%modes(k, 2:) = problem%modes(k, 2:) + 10.0_dp
    end do
    problem%resultant = [0.003_dp]
    if (.not. allocated(problem%modes)) then
      problem%prescribed = [iand(parts, HELD) > 0]
      problem%motion = [0.004_dp]
      return
    end if
    problem%resultant = merge(0.02_dp, 0.003_dp, iand(parts, HELD) > 0)*[1.0_dp, 0.03_dp, -0.02_dp]
    if (iand(parts, FAR) > 0) problem%resultant = problem%resultant + [0.0_dp, 0.03_dp, 0.03_dp]
    problem%prescribed = [.false., .false., iand(parts, HELD) > 0]
    problem%motion = [0.0_dp, 0.0_dp, 0.0017_dp]
    if (ny > 1) return
    problem%resultant = problem%resultant(:2)
    problem%prescribed = problem%prescribed(:2)
    problem%motion = problem%motion(:2)
  end subroutine fill

  subroutine surfaces(name, parts)
    character(len=*), intent(in) :: name
    integer, intent(in) :: parts
    integer, parameter :: NX = 205, NY = 190
    type(fuge_mpi_halfspace_operator) :: shared
    type(fuge_halfspace_operator) :: whole
    type(fuge_problem) :: problem, whole_problem
    type(fuge_info) :: info
    integer :: rows(2)

    call shared%set(NX, NY, 1.0_dp/NX, 1.0_dp/NX, 1.0_dp, MPI_COMM_WORLD, info)
    call expect(info%status == FUGE_DONE, name//': '//trim(info%message))
    rows = shared%own_rows()
    call fill(NX, NY, NX*(rows(1) - 1) + 1, shared%points(), parts, problem)
    if (my_rank() == 0) then
      call whole%set(NX, NY, 1.0_dp/NX, 1.0_dp/NX, 1.0_dp, info)
      call fill(NX, NY, 1, NX*NY, parts, whole_problem)
    end if
    ! Ranks add up otherwise what products in single precision then round.
    call compare(name, 1.0e-9_dp, shared, whole, problem, whole_problem)
  end subroutine surfaces

  subroutine line_with(name, parts)
    character(len=*), intent(in) :: name
    integer, intent(in) :: parts
    integer, parameter :: N = 40000
    type(fuge_mpi_halfplane_operator) :: shared
    type(fuge_halfplane_operator) :: whole
    type(fuge_problem) :: problem, whole_problem
    type(fuge_info) :: info
    integer :: rows(2)

    call shared%set(N, 1.0_dp/N, 1.0_dp, MPI_COMM_WORLD, info)
    call expect(info%status == FUGE_DONE, name//': '//trim(info%message))
    rows = shared%own_rows()
    call fill(N, 1, rows(1), shared%points(), parts, problem)
    if (my_rank() == 0) then
      call whole%set(N, 1.0_dp/N, 1.0_dp, info)
      call fill(N, 1, 1, N, parts, whole_problem)
    end if
    call compare(name, 1.0e-15_dp*N, shared, whole, problem, whole_problem)
  end subroutine line_with

  ! A solution, that under another load from there, and a derivative.
  subroutine compare(name, accuracy, shared, whole, problem, whole_problem)
    character(len=*), intent(in) :: name
    real(dp), intent(in) :: accuracy
    class(fuge_operator), intent(in) :: shared, whole
    type(fuge_problem), intent(inout) :: problem, whole_problem
    type(fuge_solution) :: solution, expected, change, expected_change
    type(fuge_solver) :: solver, whole_solver
    type(fuge_info) :: info, whole_info
    real(dp), allocatable :: load_change(:)
    integer :: k

    do k = 1, 2
      call solver%solve(shared, problem, solution, info)
      call expect(info%status >= 0, name//': '//trim(info%message))
      if (info%failed()) return
      if (my_rank() == 0) call whole_solver%solve(whole, whole_problem, expected, whole_info)
      call check_solution(name, accuracy, 0, info, solution, whole_info, expected)
      problem%resultant = 1.1_dp*problem%resultant
      if (my_rank() == 0) whole_problem%resultant = problem%resultant
    end do
    load_change = 0.0_dp*solution%motion
    load_change(1) = 0.001_dp
    if (size(load_change) > 1) load_change(2:) = problem%resultant(2:)
    call solver%derivative(shared, problem%gap, load_change, change, info)
    call expect(info%status == FUGE_DONE, name//', derivative: '//trim(info%message))
    if (info%failed()) return
    if (my_rank() == 0) call whole_solver%derivative(whole, whole_problem%gap, load_change, expected_change, whole_info)
    call compare_changes(name//', derivative', info, change, whole_info, expected_change)
    call compare_gradients(name//', gradient', solver, shared, problem, solution, whole_solver, whole, whole_problem, &
                           expected)
    call compare_wanted(name//', wanted', shared, problem, solution, whole, whole_problem, expected)
  end subroutine compare

  ! The gradient of an objective with weights on everything.
  subroutine compare_gradients(name, solver, shared, problem, solution, whole_solver, whole, whole_problem, expected)
    character(len=*), intent(in) :: name
    type(fuge_solver), intent(in) :: solver, whole_solver
    class(fuge_operator), intent(in) :: shared, whole
    type(fuge_problem), intent(in) :: problem, whole_problem
    type(fuge_solution), intent(in) :: solution, expected
    type(fuge_solution) :: weight
    type(fuge_gradients) :: gradients, whole_gradients
    type(fuge_info) :: info, whole_info
    real(dp), allocatable :: gap(:)

    ! The loads of the last solve are these no more.
    call set_weights(problem, weight)
    call fuge_solve_adjoint(solver, shared, problem, solution, weight, gradients, info)
    call expect(info%status == FUGE_DONE, name//': '//trim(info%message))
    if (info%failed()) return
    if (my_rank() == 0) then
      call set_weights(whole_problem, weight)
      call fuge_solve_adjoint(whole_solver, whole, whole_problem, expected, weight, whole_gradients, whole_info)
    end if
    call gather(gradients%gap, gap)
    if (my_rank() > 0) return
    call expect(abs(info%products - whole_info%products) <= 1, name//': products')
    call expect(maxval(abs(gap - whole_gradients%gap)) <= 1.0e-8_dp*maxval(abs(gap)), name//': gaps')
    call expect(all(abs(gradients%load - whole_gradients%load) <= 1.0e-8_dp*maxval(abs(gradients%load))), &
                name//': loads')
    call expect(abs(gradients%log_modulus - whole_gradients%log_modulus) <= 1.0e-8_dp*maxval(abs(gap)), &
                name//': modulus')
    write (*, '(a,t36,2i6,es10.2)') name, info%products, whole_info%products, &
      maxval(abs(gap - whole_gradients%gap))/maxval(abs(gap))
  end subroutine compare_gradients

  ! Partial derivatives of an objective, from data that each rank has.
  pure subroutine set_weights(problem, weight)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(out) :: weight
    integer :: j

    allocate (weight%force(problem%points()), weight%gap(problem%points()), weight%motion(problem%mode_count()))
    weight%force = problem%gap
    weight%gap = cos(300.0_dp*problem%gap)
    weight%motion = [(0.1_dp*j, j=1, problem%mode_count())]
  end subroutine set_weights

  ! The gaps for the forces of a solution.
  subroutine compare_wanted(name, shared, problem, solution, whole, whole_problem, expected)
    character(len=*), intent(in) :: name
    class(fuge_operator), intent(in) :: shared, whole
    type(fuge_problem), intent(in) :: problem, whole_problem
    type(fuge_solution), intent(in) :: solution, expected
    type(fuge_wanted_contact) :: wanted, whole_wanted
    type(fuge_info) :: info, whole_info
    real(dp), allocatable :: gap(:)

    call fuge_gap_for_pressure(shared, problem, solution%force, 0.001_dp, wanted, info)
    call expect(info%status == FUGE_DONE, name//': '//trim(info%message))
    if (info%failed()) return
    if (my_rank() == 0) call fuge_gap_for_pressure(whole, whole_problem, expected%force, 0.001_dp, whole_wanted, &
                                                   whole_info)
    call gather(wanted%gap, gap)
    if (my_rank() > 0) return
    call expect(maxval(abs(gap - whole_wanted%gap)) <= 1.0e-8_dp*maxval(abs(gap)), name//': gaps')
    call expect(all(abs(wanted%resultant - whole_wanted%resultant) <= 1.0e-8_dp*maxval(abs(wanted%resultant))), &
                name//': resultants')
  end subroutine compare_wanted

  ! Derivatives are solved to the tolerance of the solution only.
  subroutine compare_changes(name, info, change, whole_info, expected)
    character(len=*), intent(in) :: name
    type(fuge_info), intent(in) :: info, whole_info
    type(fuge_solution), intent(in) :: change, expected
    real(dp), allocatable :: force(:), gap(:)

    call gather(change%force, force)
    call gather(change%gap, gap)
    if (my_rank() > 0) return
    ! On a line the rounding of its forces may decide on one product.
    call expect(abs(info%products - whole_info%products) <= 1, name//': products')
    call expect(maxval(abs(force - expected%force)) <= 1.0e-9_dp*maxval(abs(expected%force)), name//': forces')
    call expect(maxval(abs(gap - expected%gap)) <= 1.0e-9_dp*maxval(abs(expected%gap)), name//': gaps')
    call expect(all(abs(change%motion - expected%motion) <= 1.0e-9_dp*maxval(abs(expected%motion))), name//': motions')
    write (*, '(a,t36,2i6,es10.2)') name, info%products, whole_info%products, &
      maxval(abs(force - expected%force))/maxval(abs(expected%force))
  end subroutine compare_changes

  ! Every rank gets the same error.
  subroutine refuse()
    integer, parameter :: NX = 200, NY = 190
    type(fuge_mpi_halfspace_operator) :: shared
    type(fuge_problem) :: problem, base
    type(fuge_solution) :: solution
    type(fuge_solver) :: solver
    type(fuge_info) :: info
    integer :: ranks, rows(2)

    call shared%set(NX, NY, 1.0_dp/NX, 1.0_dp/NX, 1.0_dp, MPI_COMM_WORLD, info)
    rows = shared%own_rows()
    call fill(NX, NY, NX*(rows(1) - 1) + 1, shared%points(), TILTS, base)
    problem = base
    problem%resultant(2) = 0.6_dp*problem%resultant(1)
    call solver%solve(shared, problem, solution, info)
    call expect(info%status == FUGE_ERR_NO_EQUILIBRIUM, 'a load beside the points: '//trim(info%message))
    problem = base
    problem%modes(:, 3) = problem%modes(:, 1) - 2.0_dp*problem%modes(:, 2)
    call solver%solve(shared, problem, solution, info)
    call expect(info%status == FUGE_ERR_MODES, 'dependent modes: '//trim(info%message))
    problem = base
    problem%modes(:, 3) = 0.0_dp
    call solver%solve(shared, problem, solution, info)
    call expect(info%status == FUGE_ERR_MODES, 'an idle mode: '//trim(info%message))
    problem = base
    if (my_rank() == 0) problem%resultant(2) = 0.0_dp
    call solver%solve(shared, problem, solution, info)
    call MPI_Comm_size(MPI_COMM_WORLD, ranks)
    if (ranks > 1) call expect(info%status == FUGE_ERR_OPTION, 'another load: '//trim(info%message))
    call fill(NX, NY, 1, shared%points(), EXCLUSIONS, problem)
    problem%excluded = .true.
    call solver%solve(shared, problem, solution, info)
    call expect(info%status == FUGE_ERR_NO_EQUILIBRIUM, 'all points excluded: '//trim(info%message))
  end subroutine refuse

end program general
