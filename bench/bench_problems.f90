!> The problems of the benchmark: two profiles on a half-plane with known answers, and
!> random positive definite matrices.
module bench_problems
  use, intrinsic :: iso_fortran_env, only: int64
  use bench_lapack, only: dsyrk
  use fuge, only: dp, fuge_dense_operator, fuge_halfplane_matrix, fuge_info, fuge_problem, fuge_solution, fuge_solver
  implicit none
  private

  public :: make_punch, make_cylinder, make_random

  type, public :: bench_problem
    character(len=16) :: name = ''
    real(dp), allocatable :: alpha(:, :), gap(:)
    real(dp) :: load = 0.0_dp
    !> On the half-plane: centres (n), width of the cells, exact forces of the cells
    !> (n) and exact half width of the contact. Elsewhere not allocated.
    real(dp), allocatable :: x(:), exact(:)
    real(dp) :: width = 0.0_dp, half_width = 0.0_dp
  end type bench_problem

  real(dp), parameter :: PI = acos(-1.0_dp)
  !> Half-plane, per unit depth: mm and N.
  real(dp), parameter :: E_STAR = 1.0e6_dp/(1.0_dp - 0.25_dp**2)
  real(dp), parameter :: REACH = 0.8_dp, LOAD = 30.0e3_dp
  real(dp), parameter :: QUARTIC = 0.05_dp, RADIUS = 7.0_dp
  !> Random problems: what is added to the diagonal, and the part of the points in contact.
  real(dp), parameter :: RIDGE = 1.0e-3_dp, ACTIVE = 0.40_dp, ACTIVE_TOLERANCE = 0.02_dp

contains

  !> P1: rigid punch y = 0.05 x**4, |x| <= 0.8, `n` equal cells.
  subroutine make_punch(n, element, problem)
    integer, intent(in) :: n, element
    type(bench_problem), intent(out) :: problem

    call make_halfplane(n, element, problem)
    problem%name = 'P1_'//whole(n)
    problem%gap = QUARTIC*problem%x**4
    problem%half_width = (LOAD/(0.75_dp*PI*E_STAR*QUARTIC))**0.25_dp
    problem%exact = LOAD*(quartic_share(problem%x + 0.5_dp*problem%width, problem%half_width) &
                          - quartic_share(problem%x - 0.5_dp*problem%width, problem%half_width))
  end subroutine make_punch

  !> P2: cylinder of radius 7 as the parabola x**2/14, `n` equal cells.
  subroutine make_cylinder(n, element, problem)
    integer, intent(in) :: n, element
    type(bench_problem), intent(out) :: problem

    call make_halfplane(n, element, problem)
    problem%name = 'P2_'//whole(n)
    problem%gap = problem%x**2/(2.0_dp*RADIUS)
    problem%half_width = sqrt(4.0_dp*LOAD*RADIUS/(PI*E_STAR))
    problem%exact = LOAD*(hertz_share(problem%x + 0.5_dp*problem%width, problem%half_width) &
                          - hertz_share(problem%x - 0.5_dp*problem%width, problem%half_width))
  end subroutine make_cylinder

  subroutine make_halfplane(n, element, problem)
    integer, intent(in) :: n, element
    type(bench_problem), intent(inout) :: problem
    type(fuge_info) :: info
    real(dp) :: widths(n)
    integer :: k

    problem%width = 2.0_dp*REACH/real(n, dp)
    problem%x = [(problem%width*(real(k, dp) - 0.5_dp*real(n + 1, dp)), k=1, n)]
    problem%load = LOAD
    widths = problem%width
    allocate (problem%alpha(n, n))
    call fuge_halfplane_matrix(problem%x, widths, E_STAR, element, problem%alpha, info)
    if (info%failed()) error stop 'no influence matrix of the half-plane'
  end subroutine make_halfplane

  !> The part of the load left of `x`: the integral of the exact pressure
  !> E* A (2 x**2 + a**2) sqrt(a**2 - x**2), over the load.
  elemental function quartic_share(x, a) result(share)
    real(dp), intent(in) :: x, a
    real(dp) :: share, t

    t = asin(min(max(x/a, -1.0_dp), 1.0_dp))
    share = 0.5_dp + (0.75_dp*t + 0.25_dp*sin(2.0_dp*t) - sin(4.0_dp*t)/16.0_dp)/(0.75_dp*PI)
  end function quartic_share

  !> The same for E*/(2 R) sqrt(a**2 - x**2).
  elemental function hertz_share(x, a) result(share)
    real(dp), intent(in) :: x, a
    real(dp) :: share, t

    t = asin(min(max(x/a, -1.0_dp), 1.0_dp))
    share = 0.5_dp + (0.5_dp*t + 0.25_dp*sin(2.0_dp*t))/(0.5_dp*PI)
  end function hertz_share

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
