!> The problems of the benchmark: two profiles on a half-plane with known answers, rough
!> periodic ones, and random positive definite matrices.
module bench_problems
  use, intrinsic :: iso_fortran_env, only: int64
  use bench_lapack, only: dsyrk
  use bench_waves, only: sum_of_waves
  use closed_forms, only: cylinder, press_cylinder, press_quartic, quartic_punch
  use fuge, only: dp, fuge_dense_operator, fuge_halfplane_matrix, fuge_info, fuge_problem, fuge_solution, &
    fuge_solver, FUGE_CENTRE
  implicit none
  private

  public :: make_punch, make_cylinder, make_random, make_rough, add_matrix

  type, public :: bench_problem
    character(len=16) :: name = ''
    real(dp), allocatable :: alpha(:, :), gap(:)
    real(dp) :: load = 0.0_dp
    !> On the half-plane: modulus and element; centres (n), width of the cells; does the
    !> surface repeat?
    real(dp) :: e_star = 0.0_dp, width = 0.0_dp
    integer :: element = FUGE_CENTRE
    logical :: periodic = .false.
    real(dp), allocatable :: x(:)
    !> Exact forces of the cells (n) and exact half width; not allocated where not known.
    real(dp), allocatable :: exact(:)
    real(dp) :: half_width = 0.0_dp
  end type bench_problem

  real(dp), parameter :: PI = acos(-1.0_dp)
  !> Half-plane, per unit depth: mm and N.
  real(dp), parameter :: E_STAR = 1.0e6_dp/(1.0_dp - 0.25_dp**2)
  real(dp), parameter :: REACH = 0.8_dp, LOAD = 30.0e3_dp
  real(dp), parameter :: QUARTIC = 0.05_dp, RADIUS = 7.0_dp
  !> Rough profiles.
  integer, parameter :: LONGEST_WAVE = 4
  real(dp), parameter :: HURST = 0.8_dp, SLOPE_RMS = 0.1_dp
  !> Random problems: what is added to the diagonal, and the part of the points in contact.
  real(dp), parameter :: RIDGE = 1.0e-3_dp, ACTIVE = 0.40_dp, ACTIVE_TOLERANCE = 0.02_dp

contains

  !> P1: rigid punch y = 0.05 x**4, |x| <= 0.8, `n` equal cells; no matrix yet.
  subroutine make_punch(n, element, problem)
    integer, intent(in) :: n, element
    type(bench_problem), intent(out) :: problem
    type(quartic_punch) :: form

    call place_cells(n, element, problem)
    problem%name = 'P1_'//whole(n)
    problem%gap = QUARTIC*problem%x**4
    ! What sees the mean displacement of a cell sees the mean gap.
    if (element /= FUGE_CENTRE) problem%gap = problem%gap + QUARTIC*problem%width**2*(0.5_dp*problem%x**2 &
                                                                                     + problem%width**2/80.0_dp)
    form = press_quartic(E_STAR, LOAD, QUARTIC)
    problem%half_width = form%a
    problem%exact = form%cell_force(problem%x, problem%width)
  end subroutine make_punch

  !> P2: cylinder of radius 7 as the parabola x**2/14, `n` equal cells; no matrix yet.
  subroutine make_cylinder(n, element, problem)
    integer, intent(in) :: n, element
    type(bench_problem), intent(out) :: problem
    type(cylinder) :: form

    call place_cells(n, element, problem)
    problem%name = 'P2_'//whole(n)
    problem%gap = problem%x**2/(2.0_dp*RADIUS)
    if (element /= FUGE_CENTRE) problem%gap = problem%gap + problem%width**2/(24.0_dp*RADIUS)
    form = press_cylinder(E_STAR, LOAD, RADIUS)
    problem%half_width = form%a
    problem%exact = form%cell_force(problem%x, problem%width)
  end subroutine make_cylinder

  subroutine place_cells(n, element, problem)
    integer, intent(in) :: n, element
    type(bench_problem), intent(inout) :: problem
    integer :: k

    problem%e_star = E_STAR
    problem%element = element
    problem%load = LOAD
    problem%width = 2.0_dp*REACH/real(n, dp)
    allocate (problem%x(n))
    do k = 1, n
      problem%x(k) = problem%width*(real(k, dp) - 0.5_dp*real(n + 1, dp))
    end do
  end subroutine place_cells

  !> The influence matrix of a problem on the half-plane.
  subroutine add_matrix(problem)
    type(bench_problem), intent(inout) :: problem
    type(fuge_info) :: info
    real(dp) :: widths(size(problem%x))

    widths = problem%width
    allocate (problem%alpha(size(widths), size(widths)))
    call fuge_halfplane_matrix(problem%x, widths, problem%e_star, problem%element, problem%alpha, info)
    if (info%failed()) error stop 'no influence matrix of the half-plane'
  end subroutine add_matrix

  !> Periodic self-affine profile of length 1, E* = 1: wave numbers 4 .. n/16 with amplitudes
  !> k**(-1/2 - H), random phases, slope 0.1 (root mean square). `n` >= 128 a power of two;
  !> `pressure` the mean pressure. Another n has the same long waves.
  subroutine make_rough(n, pressure, problem)
    integer, intent(in) :: n
    real(dp), intent(in) :: pressure
    type(bench_problem), intent(out) :: problem
    real(dp) :: amplitude(n/16), phase(n/16), slope
    integer(int64) :: state
    integer :: k

    amplitude = 0.0_dp
    state = 5
    do k = 1, size(phase)
      call next_uniform(state, phase(k))
      if (k >= LONGEST_WAVE) amplitude(k) = real(k, dp)**(-0.5_dp - HURST)
    end do
    slope = sqrt(0.5_dp*sum([((2.0_dp*PI*real(k, dp)*amplitude(k))**2, k=1, size(phase))]))
    allocate (problem%gap(n))
    call sum_of_waves(SLOPE_RMS/slope*amplitude, 2.0_dp*PI*phase, problem%gap)
    problem%gap = maxval(problem%gap) - problem%gap
    problem%load = pressure
    problem%e_star = 1.0_dp
    problem%width = 1.0_dp/real(n, dp)
    problem%periodic = .true.
  end subroutine make_rough

  !> P3: alpha = G G^T/n + 1e-3 I with normal G, gaps uniform in (0, 1), and the load
  !> at which about 40 % of the points touch.
  subroutine make_random(n, problem)
    integer, intent(in) :: n
    type(bench_problem), intent(out) :: problem
    real(dp), allocatable :: normal(:, :)
    integer(int64) :: state
    integer :: i, j

    problem%name = 'P3_'//whole(n)
    allocate (normal(n, n), problem%alpha(n, n), problem%gap(n))
    state = 1000 + n
    do j = 1, n
      do i = 1, n
        call next_normal(state, normal(i, j))
      end do
    end do
    do i = 1, n
      call next_uniform(state, problem%gap(i))
    end do
    problem%alpha = 0.0_dp
    do i = 1, n
      problem%alpha(i, i) = RIDGE
    end do
    call dsyrk('L', 'N', n, n, 1.0_dp/real(n, dp), normal, n, 1.0_dp, problem%alpha, n)
    do j = 2, n
      problem%alpha(:j - 1, j) = problem%alpha(j, :j - 1)
    end do
    call choose_load(problem)
  end subroutine make_random

  subroutine choose_load(problem)
    type(bench_problem), intent(inout), target :: problem
    type(fuge_dense_operator) :: operator
    type(fuge_problem) :: contact
    type(fuge_solution) :: solution
    type(fuge_solver) :: solver
    type(fuge_info) :: info
    real(dp) :: low, high, active_part
    integer :: step

    call operator%set(problem%alpha, info)
    contact%gap = problem%gap
    allocate (contact%resultant(1))
    low = 1.0e-2_dp
    high = 1.0e5_dp
    do step = 1, 40
      problem%load = sqrt(low*high)
      contact%resultant = problem%load
      call solver%solve(operator, contact, solution, info)
      if (info%failed()) error stop 'a random problem was not solved'
      active_part = real(info%contacts, dp)/real(size(problem%gap), dp)
      if (abs(active_part - ACTIVE) < ACTIVE_TOLERANCE) return
      if (active_part < ACTIVE) then
        low = problem%load
      else
        high = problem%load
      end if
    end do
    error stop 'no load for a random problem'
  end subroutine choose_load

  !> Uniform in (0, 1): Park and Miller, Communications of the ACM 31, 1988, with the
  !> multiplier of 36, 1993.
  pure subroutine next_uniform(state, value)
    integer(int64), intent(inout) :: state
    real(dp), intent(out) :: value
    integer(int64), parameter :: MODULUS = 2147483647_int64, MULTIPLIER = 48271_int64

    state = modulo(MULTIPLIER*state, MODULUS)
    value = real(state, dp)/real(MODULUS, dp)
  end subroutine next_uniform

  !> Standard normal (Box and Muller).
  pure subroutine next_normal(state, value)
    integer(int64), intent(inout) :: state
    real(dp), intent(out) :: value
    real(dp) :: radius, angle

    call next_uniform(state, radius)
    call next_uniform(state, angle)
    value = sqrt(-2.0_dp*log(radius))*cos(2.0_dp*PI*angle)
  end subroutine next_normal

  pure function whole(n)
    integer, intent(in) :: n
    character(len=:), allocatable :: whole
    character(len=12) :: buffer

    write (buffer, '(i0)') n
    whole = trim(buffer)
  end function whole

end module bench_problems
