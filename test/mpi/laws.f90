! Compliances, limits of forces and motions on springs: the ranks find what one process finds.
program laws
  use fuge_contact_states, only: FUGE_LIMITED_LOWER
  use fuge_halfplane_fft, only: fuge_halfplane_operator
  use fuge_kinds, only: dp
  use fuge_mpi, only: fuge_mpi_halfplane_operator, fuge_mpi_halfspace_operator
  use fuge_operator_type, only: fuge_operator
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_solver_type, only: fuge_solver
  use fuge_status, only: fuge_info, FUGE_DONE, FUGE_ERR_LAW, FUGE_ERR_NO_EQUILIBRIUM, FUGE_ERR_OPTION, &
    FUGE_MESSAGE_LENGTH, FUGE_WARN_NOT_UNIQUE
  use lone_rank, only: lone_surface
  use mpi_f08
  use rank_checks, only: begin_checks, check_solution, end_checks, expect, gather, my_rank
  implicit none

  ! What a problem has.
  integer, parameter :: BED = 1, SPOTS = 2, LIMITS = 4, SPRING = 8, TILTS = 16, PLAY = 32, HELD = 64

  call begin_checks()
  call run()
  call end_checks()

contains

  subroutine run()
    call surface('compliance', BED, 0.003_dp)
    call surface('compliances', SPOTS, 0.003_dp)
    call surface('limits', LIMITS, 0.02_dp)
    call surface('limits, held', LIMITS + HELD, 0.02_dp)
    call surface('limits of tilts', LIMITS + TILTS, 0.02_dp)
    call surface('a spring', SPRING, 0.003_dp)
    call surface('springs on tilts', SPRING + TILTS, 0.005_dp)
    call surface('compliances, limits, springs', SPOTS + LIMITS + SPRING + TILTS, 0.02_dp)
    call surface('all of them', SPOTS + LIMITS + SPRING + TILTS + PLAY, 0.02_dp)
    call line_with('line: compliances', SPOTS, 0.003_dp)
    call line_with('line: compliance, limits, a spring', BED + LIMITS + SPRING, 0.05_dp)
    call carry_the_most()
    call refuse()
  end subroutine run

  ! Points first .. of a surface of nx columns: the gap of a wavy paraboloid, and what `parts` says.
  pure subroutine fill(nx, ny, first, count, parts, load, problem)
    integer, intent(in) :: nx, ny, first, count, parts
    real(dp), intent(in) :: load
    type(fuge_problem), intent(out) :: problem
    real(dp) :: x, y
    integer :: k

    allocate (problem%gap(count))
    if (iand(parts, BED + SPOTS) > 0) allocate (problem%compliance(count))
    if (iand(parts, LIMITS) > 0) allocate (problem%limit(count))
    if (iand(parts, PLAY) > 0) allocate (problem%gap_upper(count), problem%limit_upper(count))
    if (iand(parts, TILTS) > 0) allocate (problem%modes(count, merge(2, 3, ny == 1)))
    do k = 1, count
      x = (real(modulo(first + k - 2, nx), dp) + 0.5_dp)/nx - 0.5_dp
      y = (real((first + k - 2)/nx, dp) + 0.5_dp)/max(ny, 2) - 0.5_dp
      problem%gap(k) = 0.5_dp*(x**2 + y**2) + 0.002_dp*sin(24.0_dp*x + 0.4_dp)*cos(17.0_dp*y)
      if (iand(parts, BED) > 0) problem%compliance(k) = 0.3_dp*real(nx, dp)
      if (iand(parts, SPOTS) > 0) problem%compliance(k) = real(nx, dp)*10.0_dp**(-2.0_dp + 4.0_dp*sin(7.0_dp*x)**2)
      ! The mean pressure of all cells at their limits is 0.1.
      if (allocated(problem%limit)) problem%limit(k) = 0.1_dp*(1.0_dp + 0.5_dp*x)/real(nx*merge(nx, 1, ny > 1), dp)
      if (allocated(problem%gap_upper)) then
        problem%gap_upper(k) = 0.004_dp + 0.001_dp*cos(9.0_dp*x)
        if (x > 0.3_dp) problem%gap_upper(k) = huge(x)
        problem%limit_upper(k) = problem%gap_upper(k)/real(nx*nx, dp)
        problem%gap(k) = 0.2_dp*problem%gap(k)
      end if
      if (.not. allocated(problem%modes)) cycle
      problem%modes(k, :2) = [1.0_dp, x]
      if (ny > 1) problem%modes(k, 3) = y
    end do
    problem%resultant = [load]
    if (allocated(problem%modes)) problem%resultant = load*[1.0_dp, 0.03_dp, -0.02_dp]
    if (allocated(problem%modes) .and. ny == 1) problem%resultant = problem%resultant(:2)
    if (iand(parts, SPRING) > 0) then
      problem%motion_stiffness = 0.0_dp*problem%resultant
      problem%motion_stiffness(size(problem%resultant)) = 0.2_dp
    end if
    if (iand(parts, HELD) > 0) then
      problem%prescribed = [.true.]
      problem%motion = [load]
    end if
  end subroutine fill

  subroutine surface(name, parts, load)
    character(len=*), intent(in) :: name
    integer, intent(in) :: parts
    real(dp), intent(in) :: load
    integer, parameter :: NX = 205, NY = 190
    type(fuge_mpi_halfspace_operator) :: shared
    type(lone_surface) :: whole
    type(fuge_problem) :: problem, whole_problem
    type(fuge_info) :: info
    integer :: rows(2)

    call shared%set(NX, NY, 1.0_dp/NX, 1.0_dp/NX, 1.0_dp, MPI_COMM_WORLD, info)
    call expect(info%status == FUGE_DONE, name//': '//trim(info%message))
    rows = shared%own_rows()
    call fill(NX, NY, NX*(rows(1) - 1) + 1, shared%points(), parts, load, problem)
    if (my_rank() == 0) then
      call whole%surface%set(NX, NY, 1.0_dp/NX, 1.0_dp/NX, 1.0_dp, info)
      call fill(NX, NY, 1, NX*NY, parts, load, whole_problem)
    end if
    call compare(name, shared, whole, problem, whole_problem)
  end subroutine surface

  subroutine line_with(name, parts, load)
    character(len=*), intent(in) :: name
    integer, intent(in) :: parts
    real(dp), intent(in) :: load
    integer, parameter :: N = 40000
    type(fuge_mpi_halfplane_operator) :: shared
    type(fuge_halfplane_operator) :: whole
    type(fuge_problem) :: problem, whole_problem
    type(fuge_info) :: info
    integer :: cells(2)

    call shared%set(N, 1.0_dp/N, 1.0_dp, MPI_COMM_WORLD, info)
    call expect(info%status == FUGE_DONE, name//': '//trim(info%message))
    cells = shared%own_rows()
    call fill(N, 1, cells(1), shared%points(), parts, load, problem)
    if (my_rank() == 0) then
      call whole%set(N, 1.0_dp/N, 1.0_dp, info)
      call fill(N, 1, 1, N, parts, load, whole_problem)
    end if
    call compare(name, shared, whole, problem, whole_problem)
  end subroutine line_with

  ! A solution, that under another load from there, and a derivative. Where points come to their limits, rounding may
  ! decide on some steps of the conjugate gradients, and forces agree to the tolerance of the solve.
  subroutine compare(name, shared, whole, problem, whole_problem)
    character(len=*), intent(in) :: name
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
      call check_solution(name, merge(1.0e-8_dp, 1.0e-9_dp, allocated(problem%limit)), &
                          merge(5, 0, allocated(problem%limit)), info, solution, whole_info, expected)
      call compare_states(name, info, solution, whole_info, expected)
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
    call compare_changes(name//', derivative', change, expected_change)
  end subroutine compare

  subroutine compare_states(name, info, solution, whole_info, expected)
    character(len=*), intent(in) :: name
    type(fuge_info), intent(in) :: info, whole_info
    type(fuge_solution), intent(in) :: solution, expected
    real(dp), allocatable :: state(:)

    call gather(real(solution%state, dp), state)
    if (my_rank() > 0) return
    call expect(all(nint(state) == expected%state), name//': states')
    call expect(abs(info%energy - whole_info%energy) <= 1.0e-9_dp*abs(whole_info%energy), name//': energy')
    call expect(info%residual <= 1.0e-8_dp, name//': residual')
    call expect(info%force_error <= 2.0_dp*whole_info%force_error, name//': estimated error')
    write (*, '(t36,2(a,i0))') 'at their limits ', count(abs(nint(state)) == FUGE_LIMITED_LOWER), ' of ', size(state)
  end subroutine compare_states

  ! Derivatives are solved to the tolerance of the solution only.
  subroutine compare_changes(name, change, expected)
    character(len=*), intent(in) :: name
    type(fuge_solution), intent(in) :: change, expected
    real(dp), allocatable :: force(:), gap(:)

    call gather(change%force, force)
    call gather(change%gap, gap)
    if (my_rank() > 0) return
    call expect(maxval(abs(force - expected%force)) <= 1.0e-7_dp*maxval(abs(expected%force)), name//': forces')
    call expect(maxval(abs(gap - expected%gap)) <= 1.0e-7_dp*maxval(abs(expected%gap)), name//': gaps')
    call expect(all(abs(change%motion - expected%motion) <= 1.0e-7_dp*maxval(abs(expected%motion))), name//': motions')
    write (*, '(a,t48,es10.2)') name, maxval(abs(force - expected%force))/maxval(abs(expected%force))
  end subroutine compare_changes

  ! A load that is the sum of all limits, and one beyond it.
  subroutine carry_the_most()
    integer, parameter :: NX = 200, NY = 190
    type(fuge_mpi_halfspace_operator) :: shared
    type(fuge_problem) :: problem
    type(fuge_solution) :: solution
    type(fuge_solver) :: solver
    type(fuge_info) :: info
    real(dp) :: most
    integer :: rows(2)

    call shared%set(NX, NY, 1.0_dp/NX, 1.0_dp/NX, 1.0_dp, MPI_COMM_WORLD, info)
    rows = shared%own_rows()
    call fill(NX, NY, NX*(rows(1) - 1) + 1, shared%points(), LIMITS, 1.0_dp, problem)
    most = sum(problem%limit)
    call MPI_Allreduce(MPI_IN_PLACE, most, 1, MPI_DOUBLE_PRECISION, MPI_SUM, MPI_COMM_WORLD)
    problem%resultant = [most]
    call solver%solve(shared, problem, solution, info)
    call expect_alike(info, FUGE_WARN_NOT_UNIQUE, 'the contact does not resist')
    call expect(all(abs(solution%force - problem%limit) <= 1.0e-11_dp*most), 'the sum of limits: forces')
    call told('the sum of limits', info)
    problem%resultant = [1.000001_dp*most]
    call solver%solve(shared, problem, solution, info)
    call expect_alike(info, FUGE_ERR_NO_EQUILIBRIUM, 'no forces within their limits give the resultant')
    problem%resultant = [0.99_dp*most]
    call solver%solve(shared, problem, solution, info)
    call expect_alike(info, FUGE_DONE, '')
    call told('nearly the sum of limits', info)
    call fill(NX, NY, NX*(rows(1) - 1) + 1, shared%points(), LIMITS + TILTS, 0.9_dp*most, problem)
    problem%resultant(2) = 0.4_dp*most
    call solver%solve(shared, problem, solution, info)
    call expect_alike(info, FUGE_ERR_NO_EQUILIBRIUM, 'no forces within their limits give the resultant')
  end subroutine carry_the_most

  ! What is wrong on one rank is wrong on all.
  subroutine refuse()
    integer, parameter :: NX = 200, NY = 190
    type(fuge_mpi_halfspace_operator) :: shared
    type(fuge_problem) :: problem, base
    type(fuge_solution) :: solution
    type(fuge_solver) :: solver
    type(fuge_info) :: info
    integer :: ranks, rows(2)

    call MPI_Comm_size(MPI_COMM_WORLD, ranks)
    if (ranks < 2) return
    call shared%set(NX, NY, 1.0_dp/NX, 1.0_dp/NX, 1.0_dp, MPI_COMM_WORLD, info)
    rows = shared%own_rows()
    call fill(NX, NY, NX*(rows(1) - 1) + 1, shared%points(), BED + LIMITS + SPRING, 0.01_dp, base)
    problem = base
    if (my_rank() == 1) problem%compliance(7) = -1.0_dp
    call solver%solve(shared, problem, solution, info)
    call expect_alike(info, FUGE_ERR_LAW, 'rank 1: compliance(7)')
    problem = base
    if (my_rank() == 1) problem%limit(3) = -1.0_dp
    call solver%solve(shared, problem, solution, info)
    call expect_alike(info, FUGE_ERR_LAW, 'rank 1: limit(3)')
    problem = base
    if (my_rank() == 1) deallocate (problem%limit)
    call solver%solve(shared, problem, solution, info)
    call expect_alike(info, FUGE_ERR_OPTION, 'modes, gap_upper')
    problem = base
    if (my_rank() == 1) problem%motion_stiffness = 3.0_dp
    call solver%solve(shared, problem, solution, info)
    call expect_alike(info, FUGE_ERR_OPTION, 'a load, a prescribed motion or the stiffness')
    call solver%solve(shared, base, solution, info)
    call expect_alike(info, FUGE_DONE, '')
  end subroutine refuse

  subroutine told(name, info)
    character(len=*), intent(in) :: name
    type(fuge_info), intent(in) :: info

    if (my_rank() == 0) write (*, '(a,t36,4i6)') name, info%iterations, info%products, info%preconditionings, &
      info%contacts
  end subroutine told

  ! All ranks have this status, and the same message that begins like this.
  subroutine expect_alike(info, status, message)
    type(fuge_info), intent(in) :: info
    integer, intent(in) :: status
    character(len=*), intent(in) :: message
    character(len=FUGE_MESSAGE_LENGTH) :: first

    first = info%message
    call MPI_Bcast(first, len(first), MPI_CHARACTER, 0, MPI_COMM_WORLD)
    call expect(info%status == status, message//': status, '//trim(info%message))
    call expect(index(info%message, message) == 1, message//': '//trim(info%message))
    call expect(first == info%message, message//': the ranks differ')
  end subroutine expect_alike

end program laws
