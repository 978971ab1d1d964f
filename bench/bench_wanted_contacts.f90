!> Contacts with known answers, or with one on a fine grid, whose gap is a function: for solves to a wanted error.
module bench_wanted_contacts
  use, intrinsic :: iso_fortran_env, only: int64
  use bench_problems, only: next_uniform
  use closed_forms, only: closed_form, press_cylinder, press_flat, press_quartic, press_wave
  use fuge, only: dp => fuge_dp, fuge_gap_function, fuge_halfplane_operator, fuge_halfspace_operator, fuge_info, &
    fuge_options, fuge_problem, fuge_solution, fuge_solver, FUGE_FREE, FUGE_MEAN, FUGE_PERIODIC
  implicit none
  private

  public :: AREAS, LINES, make_contact, make_random_line, solve_equal_cells

  character(len=12), parameter :: LINES(9) = [character(len=12) :: 'cylinder', 'quartic', 'face', 'jumps', 'wedge', &
                                              'wave', 'rough_light', 'rough_heavy', 'rough_barrel']
  character(len=12), parameter :: AREAS(5) = [character(len=12) :: 'sphere', 'ellipse', 'cone', 'disc', 'rough_area']

  real(dp), parameter :: PI = acos(-1.0_dp)
  !> The modulus of all.
  real(dp), parameter, public :: E_STAR = 1.0_dp

  !> A contact. Its extent has odd places, so that no edge falls on the border of a cell by design.
  type, extends(fuge_gap_function), public :: wanted_contact
    character(len=:), allocatable :: name
    logical :: is_area = .false.
    integer :: boundary = FUGE_FREE
    real(dp) :: lower(2) = 0.0_dp, upper(2) = 0.0_dp, load = 0.0_dp
    !> Half width or radius of the contact, or half axis along x, and that along y.
    real(dp) :: a = 0.0_dp, b = 0.0_dp
    !> Curvatures along x and y.
    real(dp), private :: curvature(2) = 0.0_dp
    class(closed_form), allocatable, private :: form
    !> Waves of a rough surface: numbers along x and y, amplitudes, phases.
    real(dp), allocatable, private :: waves(:, :), amplitude(:), phase(:)
    !> Forces on fine equal cells, where no closed form is known; of a line those left of the borders.
    real(dp), allocatable, private :: fine(:, :)
  contains
    procedure :: evaluate
    procedure :: is_rough
    procedure :: wrong_share
  end type wanted_contact

  !> Cells of the fine grids, on a side of an area.
  integer, parameter :: FINE_LINE = 2**18, FINE_AREA = 2048

contains

  !> Make a contact, and solve it on fine cells if it has no closed form; `coarser` times coarser ones, to try it.
  subroutine make_contact(name, coarser, contact)
    character(len=*), intent(in) :: name
    integer, intent(in) :: coarser
    type(wanted_contact), intent(out) :: contact

    contact%name = trim(name)
    contact%is_area = any(AREAS == name)
    contact%lower = [-1.3_dp, -1.2_dp]
    contact%upper = [1.1_dp, 1.2_dp]
    contact%load = 0.3_dp
    contact%a = 0.7_dp
    select case (name)
    case ('cylinder')
      allocate (contact%form, source=press_cylinder(E_STAR, contact%load, 1.0_dp))
    case ('quartic')
      allocate (contact%form, source=press_quartic(E_STAR, contact%load, 1.0_dp))
    case ('face')
      contact%lower(1) = -contact%a
      contact%upper(1) = contact%a
      allocate (contact%form, source=press_flat(E_STAR, contact%load, contact%a))
    case ('jumps')
      allocate (contact%form, source=press_flat(E_STAR, contact%load, contact%a))
    case ('wedge')
      contact%load = E_STAR*contact%a
    case ('wave')
      contact%boundary = FUGE_PERIODIC
      contact%lower(1) = -0.5_dp
      contact%upper(1) = 0.5_dp
      allocate (contact%form, source=press_wave(E_STAR, contact%load, 1.0_dp, 0.2_dp))
    case ('rough_light')
      call make_rough(11, [2, 32], 0.02_dp, contact)
    case ('rough_heavy')
      call make_rough(12, [2, 32], 0.2_dp, contact)
    case ('rough_barrel')
      call make_rough(13, [2, 32], 0.2_dp, contact)
      contact%boundary = FUGE_FREE
      contact%curvature(1) = 2.0_dp
    case ('sphere')
      contact%curvature = 1.0_dp
      contact%load = 4.0_dp/3.0_dp*E_STAR*contact%a**3
      contact%b = contact%a
    case ('ellipse')
      contact%b = 0.4_dp
      call press_ellipse(contact)
    case ('cone')
      contact%load = 0.25_dp*PI*E_STAR*contact%a**2
    case ('rough_area')
      call make_rough(14, [1, 8], 0.05_dp, contact)
    end select
    if (allocated(contact%form)) contact%a = contact%form%a
    if (contact%is_rough()) call solve_finely(coarser, contact)
  end subroutine make_contact

  !> A random rough line: periodic, or on a cylinder with its contact inside; waves up to 4 to 32 periods, light to
  !> heavy loads; solved finely.
  subroutine make_random_line(seed, contact)
    integer, intent(in) :: seed
    type(wanted_contact), intent(out) :: contact
    integer(int64) :: state
    real(dp) :: u(3)
    integer :: k

    state = 1000_int64 + int(seed, int64)
    do k = 1, 20
      call next_uniform(state, u(1 + modulo(k, 3)))
    end do
    contact%name = 'random'
    contact%lower = 0.0_dp
    call make_rough(seed, [2, 4 + int(29.0_dp*u(1))], 10.0_dp**(-2.0_dp + 1.7_dp*u(2)), contact)
    if (u(3) < 0.5_dp) then
      ! The contact stays inside: equal cells are no reference for a corner at the rim.
      contact%boundary = FUGE_FREE
      contact%curvature(1) = 10.0_dp + 20.0_dp*u(3)
    end if
    call solve_finely(2, contact)
  end subroutine make_random_line

  pure function is_rough(self)
    class(wanted_contact), intent(in) :: self
    logical :: is_rough

    is_rough = allocated(self%waves)
  end function is_rough

  !> A self-affine surface of Hurst exponent 0.8 with waves of `numbers(1)` to `numbers(2)` periods along a side of 1,
  !> root mean square slope 1, under the `share` of E* as mean pressure.
  subroutine make_rough(seed, numbers, share, contact)
    integer, intent(in) :: seed, numbers(2)
    real(dp), intent(in) :: share
    type(wanted_contact), intent(inout) :: contact
    integer, parameter :: MOST_WAVES = 40
    integer(int64) :: state
    integer :: k, n
    real(dp) :: u, number(2), length

    state = int(seed, int64)
    do k = 1, 10
      call next_uniform(state, u)
    end do
    contact%boundary = FUGE_PERIODIC
    contact%lower = 0.0_dp
    contact%upper = 1.0_dp
    contact%load = share*E_STAR
    n = merge(MOST_WAVES, numbers(2) - numbers(1) + 1, contact%is_area)
    allocate (contact%waves(2, n), contact%amplitude(n), contact%phase(n))
    do k = 1, n
      number = [real(numbers(1) + k - 1, dp), 0.0_dp]
      do while (contact%is_area)
        call next_uniform(state, u)
        number(1) = anint(u*numbers(2))
        call next_uniform(state, u)
        number(2) = anint((2.0_dp*u - 1.0_dp)*numbers(2))
        if (norm2(number) >= numbers(1) .and. norm2(number) <= numbers(2)) exit
      end do
      call next_uniform(state, u)
      length = norm2(number)
      contact%waves(:, k) = 2.0_dp*PI*number
      contact%amplitude(k) = length**merge(-0.8_dp, -1.3_dp, contact%is_area)
      contact%phase(k) = 2.0_dp*PI*u
    end do
    contact%amplitude = contact%amplitude/sqrt(0.5_dp*sum((contact%amplitude*norm2(contact%waves, 1))**2))
  end subroutine make_rough

  !> Curvatures and load of an elliptic contact of given half axes, with the largest pressure E*/2: integrals of
  !> Johnson, Contact Mechanics, 1985, section 3.3, whose integrands are periodic.
  subroutine press_ellipse(contact)
    type(wanted_contact), intent(inout) :: contact
    integer, parameter :: N = 200
    real(dp), parameter :: LARGEST = 0.5_dp*E_STAR
    real(dp) :: squares, t, along_x, along_y
    integer :: k

    along_x = 0.0_dp
    along_y = 0.0_dp
    associate (a => contact%a, b => contact%b)
      do k = 1, N
        t = PI*(real(k, dp) - 0.5_dp)/real(N, dp)
        squares = (a*cos(t))**2 + (b*sin(t))**2
        along_x = along_x + cos(t)**2/(squares*sqrt(squares))*PI/real(N, dp)
        along_y = along_y + cos(t)**2/(b**2*sqrt(squares))*PI/real(N, dp)
      end do
      contact%curvature = LARGEST*a*b/E_STAR*[along_x, along_y]
      contact%load = 2.0_dp/3.0_dp*PI*a*b*LARGEST
    end associate
  end subroutine press_ellipse

  !> The initial gap.
  subroutine evaluate(self, x, y, gap, status)
    class(wanted_contact), intent(in) :: self
    real(dp), intent(in) :: x(:), y(:)
    real(dp), intent(out) :: gap(:)
    integer, intent(out) :: status
    integer :: k

    status = 0
    select case (self%name)
    case ('face')
      gap = 0.0_dp
    case ('jumps')
      gap = merge(0.0_dp, 1.0_dp, abs(x) <= self%a)
    case ('wedge')
      gap = abs(x)
    case ('disc')
      gap = merge(0.0_dp, 1.0_dp, x**2 + y**2 <= self%a**2)
    case ('cone')
      gap = 0.5_dp*sqrt(x**2 + y**2)
    case ('sphere', 'ellipse')
      gap = 0.5_dp*(self%curvature(1)*x**2 + self%curvature(2)*y**2)
    case default
      if (allocated(self%form)) then
        gap = self%form%initial_gap(x)
      else
        gap = 0.5_dp*self%curvature(1)*(x - 0.5_dp)**2
        do k = 1, size(self%phase)
          gap = gap - self%amplitude(k)*cos(self%waves(1, k)*x + (self%waves(2, k)*y + self%phase(k)))
        end do
      end if
    end select
  end subroutine evaluate

  !> The share of the load that `force` (nx*ny) has in the wrong place, on cells with these centres and widths.
  function wrong_share(self, x, width_x, y, width_y, force) result(share)
    class(wanted_contact), intent(in) :: self
    real(dp), intent(in) :: x(:), width_x(:), y(:), width_y(:), force(:)
    real(dp) :: share
    real(dp) :: exact(size(x))
    integer :: j

    share = 0.0_dp
    do j = 1, size(y)
      if (self%is_area) then
        exact = row_forces(self, x, width_x(1), y(j), width_y(j))
      else
        exact = line_forces(self, x, width_x)
      end if
      share = share + 0.5_dp*sum(abs(force(size(x)*(j - 1) + 1:size(x)*j) - exact))/self%load
    end do
  end function wrong_share

  function line_forces(contact, x, width) result(force)
    class(wanted_contact), intent(in) :: contact
    real(dp), intent(in) :: x(:), width(:)
    real(dp) :: force(size(x))

    if (allocated(contact%form)) then
      force = contact%form%cell_force(x, width)
    else if (contact%is_rough()) then
      force = fine_upto(contact, x + 0.5_dp*width) - fine_upto(contact, x - 0.5_dp*width)
    else
      force = wedge_to(x + 0.5_dp*width, contact%a) - wedge_to(x - 0.5_dp*width, contact%a)
    end if
  end function line_forces

  !> Of a wedge of slope 1, whose pressure is E*/pi arccosh(a/|x|), the force between its tip and `x`.
  elemental function wedge_to(x, a) result(force)
    real(dp), intent(in) :: x, a
    real(dp) :: force, t

    t = min(abs(x)/a, 1.0_dp)
    force = 0.0_dp
    if (t > 0.0_dp) force = sign(E_STAR*a/PI*(t*acosh(1.0_dp/t) + asin(t)), x)
  end function wedge_to

  !> The force left of `x` on the fine cells.
  elemental function fine_upto(contact, x) result(force)
    class(wanted_contact), intent(in) :: contact
    real(dp), intent(in) :: x
    real(dp) :: force, place
    integer :: k, n

    n = size(contact%fine, 1) - 1
    place = (x - contact%lower(1))/(contact%upper(1) - contact%lower(1))*real(n, dp)
    k = max(0, min(n - 1, int(place)))
    force = contact%fine(k + 1, 1) + (contact%fine(k + 2, 1) - contact%fine(k + 1, 1))*(place - real(k, dp))
  end function fine_upto

  !> Forces on the equal cells of a row at `y`.
  function row_forces(contact, x, width_x, y, width_y) result(force)
    class(wanted_contact), intent(in) :: contact
    real(dp), intent(in) :: x(:), width_x, y, width_y
    real(dp) :: force(size(x))
    integer, parameter :: STRIPS = 24
    real(dp) :: height, borders(size(x) + 1)
    integer :: k

    if (contact%is_rough()) then
      force = fine_row(contact, size(x), y, width_y)
      return
    end if
    borders = [x - 0.5_dp*width_x, x(size(x)) + 0.5_dp*width_x]
    force = 0.0_dp
    do k = 1, STRIPS
      height = y + width_y*((real(k, dp) - 0.5_dp)/real(STRIPS, dp) - 0.5_dp)
      force = force + width_y/real(STRIPS, dp)*strip_forces(contact, borders, height)
    end do
  end function row_forces

  !> Forces per width of a narrow strip at `y`, between the `borders` of cells.
  function strip_forces(contact, borders, y) result(force)
    class(wanted_contact), intent(in) :: contact
    real(dp), intent(in) :: borders(:), y
    real(dp) :: force(size(borders) - 1)
    integer, parameter :: PARTS = 16
    real(dp) :: half, upto(size(borders)), t(size(borders)), place
    integer :: j, k

    force = 0.0_dp
    if (contact%name == 'cone') then
      ! p = E* slope/2 arccosh(a/r).
      do k = 1, size(force)
        do j = 1, PARTS
          place = borders(k) + (borders(k + 1) - borders(k))*(real(j, dp) - 0.5_dp)/real(PARTS, dp)
          place = sqrt(place**2 + y**2)
          if (place < contact%a) force(k) = force(k) + 0.25_dp*E_STAR*acosh(contact%a/place) &
                                                       *(borders(k + 1) - borders(k))/real(PARTS, dp)
        end do
      end do
      return
    end if
    half = 1.0_dp - (y/merge(contact%b, contact%a, contact%b > 0.0_dp))**2
    if (half <= 0.0_dp) return
    half = contact%a*sqrt(half)
    t = max(-1.0_dp, min(1.0_dp, borders/half))
    if (contact%name == 'disc') then
      ! p = F/(2 pi a sqrt(a^2 - r^2)).
      upto = contact%load/(2.0_dp*PI*contact%a)*asin(t)
    else
      ! p = 3 F/(2 pi a b) sqrt(1 - (x/a)^2 - (y/b)^2).
      upto = 1.5_dp*contact%load/(PI*contact%a*contact%b)*(half**2/contact%a) &
             *0.5_dp*(t*sqrt(1.0_dp - t**2) + asin(t))
    end if
    force = upto(2:) - upto(:size(force))
  end function strip_forces

  !> Forces of the fine cells on `n` equal cells of a row.
  function fine_row(contact, n, y, width_y) result(force)
    class(wanted_contact), intent(in) :: contact
    integer, intent(in) :: n
    real(dp), intent(in) :: y, width_y
    real(dp) :: force(n)
    real(dp) :: sums(size(contact%fine, 1)), weight, low, high
    integer :: j, m

    m = size(contact%fine, 2)
    low = (y - 0.5_dp*width_y)*real(m, dp)
    high = (y + 0.5_dp*width_y)*real(m, dp)
    sums = 0.0_dp
    do j = max(1, floor(low) + 1), min(m, ceiling(high))
      weight = max(0.0_dp, min(high, real(j, dp)) - max(low, real(j - 1, dp)))
      sums = sums + weight*contact%fine(:, j)
    end do
    m = size(sums)
    do j = 1, n
      low = real(j - 1, dp)*real(m, dp)/real(n, dp)
      high = real(j, dp)*real(m, dp)/real(n, dp)
      force(j) = between(sums, low, high)
    end do
  end function fine_row

  !> The sum of `values` from `low` to `high`, counted in values.
  pure function between(values, low, high) result(total)
    real(dp), intent(in) :: values(:), low, high
    real(dp) :: total
    integer :: k

    total = 0.0_dp
    do k = max(1, floor(low) + 1), min(size(values), ceiling(high))
      total = total + values(k)*max(0.0_dp, min(high, real(k, dp)) - max(low, real(k - 1, dp)))
    end do
  end function between

  subroutine solve_finely(coarser, contact)
    integer, intent(in) :: coarser
    type(wanted_contact), intent(inout) :: contact
    real(dp), allocatable :: force(:)
    integer :: k, n(2)
    logical :: solved

    n = [FINE_LINE, 1]
    if (contact%is_area) n = FINE_AREA
    n = max(1, n/coarser)
    call solve_equal_cells(contact, n, 1.0e-9_dp, force, solved)
    if (.not. solved) error stop 'no fine solution'
    if (contact%is_area) then
      contact%fine = reshape(force, n)
    else
      allocate (contact%fine(n(1) + 1, 1), source=0.0_dp)
      do k = 1, n(1)
        contact%fine(k + 1, 1) = contact%fine(k, 1) + force(k)
      end do
    end if
  end subroutine solve_finely

  !> Solve on n(1) x n(2) equal cells by FFT, on a line n(2) = 1, from the gap function to the forces.
  subroutine solve_equal_cells(contact, n, tolerance, force, solved)
    class(wanted_contact), intent(in) :: contact
    integer, intent(in) :: n(2)
    real(dp), intent(in) :: tolerance
    real(dp), allocatable, intent(out) :: force(:)
    logical, intent(out) :: solved
    type(fuge_halfplane_operator) :: line
    type(fuge_halfspace_operator) :: area
    type(fuge_problem) :: problem
    type(fuge_solution) :: solution
    type(fuge_solver) :: solver
    type(fuge_options) :: options
    type(fuge_info) :: info
    real(dp) :: width(2)

    width = (contact%upper - contact%lower)/real(n, dp)
    if (.not. contact%is_area) width(2) = 0.0_dp
    allocate (problem%gap, source=mean_gaps(contact, n, width))
    allocate (problem%resultant(1), source=contact%load)
    options%tolerance = tolerance
    if (contact%is_area) then
      call area%set(n(1), n(2), width(1), width(2), E_STAR, info, FUGE_MEAN, contact%boundary)
      if (.not. info%failed()) call solver%solve(area, problem, solution, info, options)
    else
      call line%set(n(1), width(1), E_STAR, info, FUGE_MEAN, contact%boundary)
      if (.not. info%failed()) call solver%solve(line, problem, solution, info, options)
    end if
    solved = .not. info%failed()
    if (solved) allocate (force, source=solution%force)
  end subroutine solve_equal_cells

  !> Mean gaps of equal cells, by the rule of Gauss with two places in each direction.
  function mean_gaps(contact, n, width) result(gap)
    class(wanted_contact), intent(in) :: contact
    integer, intent(in) :: n(2)
    real(dp), intent(in) :: width(2)
    real(dp) :: gap(n(1)*n(2))
    real(dp), parameter :: PLACES(2) = [-0.5_dp, 0.5_dp]/sqrt(3.0_dp)
    real(dp), allocatable :: x(:), y(:), height(:)
    integer :: i, j, status

    allocate (x(size(gap)), y(size(gap)), height(size(gap)))
    gap = 0.0_dp
    do i = 1, 2
      do j = 1, merge(2, 1, contact%is_area)
        call set_places(contact%lower, n, width, [PLACES(i), PLACES(j)], x, y)
        if (.not. contact%is_area) y = 0.0_dp
        call contact%evaluate(x, y, height, status)
        gap = gap + height*merge(0.25_dp, 0.5_dp, contact%is_area)
      end do
    end do
  end function mean_gaps

  pure subroutine set_places(lower, n, width, place, x, y)
    real(dp), intent(in) :: lower(2), width(2), place(2)
    integer, intent(in) :: n(2)
    real(dp), intent(out) :: x(:), y(:)
    integer :: j, k

    do j = 1, n(2)
      do k = 1, n(1)
        x(n(1)*(j - 1) + k) = lower(1) + width(1)*(real(k, dp) - 0.5_dp + place(1))
        y(n(1)*(j - 1) + k) = lower(2) + width(2)*(real(j, dp) - 0.5_dp + place(2))
      end do
    end do
  end subroutine set_places

end module bench_wanted_contacts
