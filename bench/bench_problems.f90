!> The problems of the benchmark: contacts of a half-plane with known answers, rough
!> profiles, and random positive definite matrices.
module bench_problems
  use, intrinsic :: iso_fortran_env, only: int64
  use bench_lapack, only: dsyrk
  use bench_waves, only: sum_of_waves
  use closed_forms, only: closed_form, flat_punch, press_beside, press_cylinder, press_flat, press_quartic, press_wave
  use fuge, only: dp => fuge_dp, fuge_dense_operator, fuge_halfplane_matrix, fuge_halfplane_operator, fuge_info, &
    fuge_problem, &
    fuge_solution, fuge_solver, FUGE_CENTRE, FUGE_FREE, FUGE_HAT, FUGE_MEAN, FUGE_PERIODIC
  implicit none
  private

  public :: make_known, make_known_on, make_random, make_rough, add_matrix, contact_problem, uniform_edges, &
    next_uniform, whole

  !> Contacts with known answers.
  character(len=8), parameter, public :: KNOWN(6) = &
    [character(len=8) :: 'quartic', 'cylinder', 'flat', 'wave', 'tilted', 'lifted']

  type, public :: bench_problem
    character(len=16) :: name = ''
    real(dp), allocatable :: alpha(:, :), gap(:)
    real(dp) :: load = 0.0_dp
    !> Translation and, under a moment, tilt x; not allocated: translation only.
    real(dp), allocatable :: modes(:, :), resultant(:)
    !> On the half-plane: modulus; centres and widths of the cells, (n); not allocated for other problems.
    real(dp) :: e_star = 0.0_dp
    real(dp), allocatable :: x(:), width(:)
    integer :: element = FUGE_MEAN, boundary = FUGE_FREE
    !> All cells have the same width.
    logical :: uniform = .true.
    !> The known answer and where the middle of its contact is.
    class(closed_form), allocatable :: form
    real(dp) :: middle = 0.0_dp
  contains
    procedure :: points
    procedure :: exact_forces
    procedure :: singular
  end type bench_problem

  real(dp), parameter :: PI = acos(-1.0_dp)
  !> Half-plane, per unit depth: mm and N.
  real(dp), parameter :: E_STAR = 1.0e6_dp/(1.0_dp - 0.25_dp**2)
  real(dp), parameter, public :: REACH = 0.8_dp
  real(dp), parameter :: LOAD = 30.0e3_dp
  real(dp), parameter :: QUARTIC = 0.05_dp, RADIUS = 7.0_dp
  !> Fraction of the load that closes the wave; distance of the force from the middle of the face, in
  !> half faces, within the kern and beyond it.
  real(dp), parameter :: OPEN_PART = 0.4_dp, ARM_INSIDE = 0.25_dp, ARM_BESIDE = 0.72_dp
  !> Rough profiles.
  integer, parameter :: LONGEST_WAVE = 4
  real(dp), parameter :: HURST = 0.8_dp, SLOPE_RMS = 0.1_dp
  !> Random problems: what is added to the diagonal, and the fraction of the points in contact.
  real(dp), parameter :: RIDGE = 1.0e-3_dp, ACTIVE = 0.40_dp, ACTIVE_TOLERANCE = 0.02_dp

contains

  pure function points(self) result(n)
    class(bench_problem), intent(in) :: self
    integer :: n

    n = size(self%gap)
  end function points

  !> True if the contact ends at a corner, so that its edge is known.
  pure function singular(self)
    class(bench_problem), intent(in) :: self
    logical :: singular

    singular = any(self%name == [character(len=8) :: 'flat', 'tilted'])
  end function singular

  !> Exact forces of the element, (n): forces of the cells, or the pressure at the peak of a hat.
  pure function exact_forces(self) result(force)
    class(bench_problem), intent(in) :: self
    real(dp) :: force(size(self%gap))

    if (self%element == FUGE_HAT) then
      force = self%form%pressure(self%x - self%middle)*self%width
    else
      force = self%form%cell_force(self%x - self%middle, self%width)
    end if
  end function exact_forces

  !> A contact of `KNOWN` on cells between `edges` (n + 1), ascending; no matrix yet.
  subroutine make_known(name, element, edges, problem)
    character(len=*), intent(in) :: name
    integer, intent(in) :: element
    real(dp), intent(in) :: edges(:)
    type(bench_problem), intent(out) :: problem
    integer :: n

    n = size(edges) - 1
    call make_known_on(name, element, 0.5_dp*(edges(2:) + edges(:n)), edges(2:) - edges(:n), problem)
  end subroutine make_known

  !> The same on cells with centres `x` and widths `width`, (n).
  subroutine make_known_on(name, element, x, width, problem)
    character(len=*), intent(in) :: name
    integer, intent(in) :: element
    real(dp), intent(in) :: x(:), width(:)
    type(bench_problem), intent(out) :: problem

    problem%name = name
    problem%element = element
    problem%e_star = E_STAR
    problem%load = LOAD
    problem%width = width
    problem%x = x
    call set_form(problem)
    allocate (problem%gap(size(x)))
    ! An eccentric force tilts the face, which is flat: its gaps are zero.
    problem%gap = 0.0_dp
    if (allocated(problem%modes)) return
    if (element == FUGE_MEAN) then
      problem%gap = mean_gap(problem%form, problem%x, problem%width)
    else
      problem%gap = problem%form%initial_gap(problem%x)
    end if
  end subroutine make_known_on

  subroutine set_form(problem)
    type(bench_problem), intent(inout) :: problem
    type(flat_punch) :: face
    real(dp) :: arm

    select case (problem%name)
    case ('quartic')
      allocate (problem%form, source=press_quartic(E_STAR, LOAD, QUARTIC))
    case ('cylinder')
      allocate (problem%form, source=press_cylinder(E_STAR, LOAD, RADIUS))
    case ('flat')
      allocate (problem%form, source=press_flat(E_STAR, LOAD, REACH))
    case ('wave')
      problem%boundary = FUGE_PERIODIC
      allocate (problem%form, source=press_wave(E_STAR, 0.5_dp*LOAD/REACH, 2.0_dp*REACH, LOAD/(OPEN_PART*PI*E_STAR)))
    case ('tilted', 'lifted')
      if (problem%name == 'tilted') then
        arm = ARM_INSIDE*REACH
        face = press_flat(E_STAR, LOAD, REACH, LOAD*arm)
      else
        arm = ARM_BESIDE*REACH
        face = press_beside(E_STAR, LOAD, REACH, arm)
      end if
      problem%middle = face%middle
      allocate (problem%form, source=face)
      allocate (problem%modes(size(problem%x), 2))
      problem%modes(:, 1) = 1.0_dp
      problem%modes(:, 2) = problem%x
      problem%resultant = LOAD*[1.0_dp, arm]
    case default
      error stop 'no such contact'
    end select
  end subroutine set_form

  !> Mean of the initial gap over cells, by three Gauss points: exact except for the wave.
  elemental function mean_gap(form, x, width) result(mean)
    class(closed_form), intent(in) :: form
    real(dp), intent(in) :: x, width
    real(dp) :: mean, outer

    outer = 0.5_dp*sqrt(0.6_dp)*width
    mean = (5.0_dp*(form%initial_gap(x - outer) + form%initial_gap(x + outer)) + 8.0_dp*form%initial_gap(x))/18.0_dp
  end function mean_gap

  !> n equal cells, |x| <= REACH.
  pure function uniform_edges(n) result(edges)
    integer, intent(in) :: n
    real(dp) :: edges(n + 1)
    integer :: k

    edges = [(REACH*real(2*k - n, dp)/real(n, dp), k=0, n)]
  end function uniform_edges

  !> The influence matrix of a problem on the half-plane.
  subroutine add_matrix(problem)
    type(bench_problem), intent(inout) :: problem
    type(fuge_info) :: info

    if (problem%boundary == FUGE_PERIODIC) then
      call add_circulant(problem)
      return
    end if
    if (.not. allocated(problem%alpha)) allocate (problem%alpha(problem%points(), problem%points()))
    call fuge_halfplane_matrix(problem%x, problem%width, problem%e_star, problem%element, problem%alpha, info)
    if (info%failed()) error stop 'no influence matrix of the half-plane'
  end subroutine add_matrix

  !> The influence matrix of a periodic surface, with a datum that makes it definite.
  subroutine add_circulant(problem)
    type(bench_problem), intent(inout) :: problem
    type(fuge_halfplane_operator) :: operator
    type(fuge_info) :: info
    real(dp), allocatable :: unit(:), column(:)
    integer :: j, n, status

    n = problem%points()
    call operator%set(n, problem%width(1), problem%e_star, info, problem%element, FUGE_PERIODIC)
    if (info%failed()) error stop 'no operator of the periodic half-plane'
    allocate (unit(n), source=0.0_dp)
    allocate (column(n), source=0.0_dp)
    unit(1) = 1.0_dp
    call operator%apply(unit, column, status)
    if (status /= 0) error stop 'no product'
    column = column + column(1)
    if (.not. allocated(problem%alpha)) allocate (problem%alpha(n, n))
    do j = 1, n
      problem%alpha(:, j) = cshift(column, 1 - j)
      ! Symmetric to the last digit.
      problem%alpha(j, :j) = problem%alpha(:j, j)
    end do
  end subroutine add_circulant

  !> The problem as a solver takes it.
  pure function contact_problem(given) result(problem)
    type(bench_problem), intent(in) :: given
    type(fuge_problem) :: problem

    allocate (problem%gap, source=given%gap)
    if (allocated(given%modes)) then
      allocate (problem%modes, source=given%modes)
      allocate (problem%resultant, source=given%resultant)
    else
      allocate (problem%resultant, source=[given%load])
    end if
  end function contact_problem

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
    problem%name = 'rough'
    problem%load = pressure
    problem%e_star = 1.0_dp
    problem%element = FUGE_CENTRE
    problem%boundary = FUGE_PERIODIC
    problem%x = [((real(k, dp) - 0.5_dp)/real(n, dp), k=1, n)]
    allocate (problem%width(n))
    problem%width = 1.0_dp/real(n, dp)
  end subroutine make_rough

  !> alpha = G G^T/n + 1e-3 I with normal G, gaps uniform in (0, 1), and the load
  !> at which about 40 % of the points touch.
  subroutine make_random(n, problem)
    integer, intent(in) :: n
    type(bench_problem), intent(out), target :: problem
    real(dp), allocatable :: normal(:, :)
    integer(int64) :: state
    integer :: i, j

    problem%name = 'random'
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
