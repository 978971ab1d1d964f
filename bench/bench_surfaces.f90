!> The areas of contact of the benchmark: spheres, whose answer Hertz gives, and periodic rough surfaces.
module bench_surfaces
  use, intrinsic :: iso_fortran_env, only: int64
  use bench_problems, only: next_uniform, whole
  use bench_transforms, only: grid_transform
  use fuge, only: dp => fuge_dp, fuge_halfspace_operator, fuge_info, fuge_problem, FUGE_CENTRE, FUGE_FREE, FUGE_MEAN, &
    FUGE_PERIODIC
  implicit none
  private

  public :: make_sphere, make_rough_surface, make_surface, set_operator, write_surface

  !> A square of n x n cells; E* = 1.
  type, public :: bench_surface
    character(len=16) :: name = ''
    !> Cells along each side; point i + n*(j - 1) is the cell in column i and row j.
    integer :: n = 0
    real(dp) :: side = 1.0_dp, load = 0.0_dp
    !> The largest pressure; 0: no limit.
    real(dp) :: hardness = 0.0_dp
    integer :: element = FUGE_CENTRE, boundary = FUGE_FREE
    real(dp), allocatable :: gap(:)
    !> Of a sphere: radius of the contact and approach; 0: there is no known answer.
    real(dp) :: contact_radius = 0.0_dp, approach = 0.0_dp
  contains
    procedure :: cell
    procedure :: largest_force
    procedure :: contact
    procedure :: exact_forces
  end type bench_surface

  real(dp), parameter :: PI = acos(-1.0_dp)
  !> The sphere: its radius and that of the contact over the side.
  real(dp), parameter :: SPHERE = 2.0_dp, PART = 0.3_dp
  !> The rough surface. Mean pressures over E*.
  integer, parameter :: LONGEST_WAVE = 4, CELLS_OF_SHORTEST = 8
  real(dp), parameter :: HURST = 0.8_dp, SLOPE_RMS = 0.1_dp, LIGHT = 0.005_dp, HEAVY = 0.05_dp
  character(len=*), parameter :: SATURATED = 'saturated_'

contains

  pure function cell(self)
    class(bench_surface), intent(in) :: self
    real(dp) :: cell

    cell = self%side/real(self%n, dp)
  end function cell

  !> The hardness times the area of a cell.
  pure function largest_force(self)
    class(bench_surface), intent(in) :: self
    real(dp) :: largest_force

    largest_force = self%hardness*self%cell()**2
  end function largest_force

  !> The problem as a solver takes it.
  pure function contact(self) result(problem)
    class(bench_surface), intent(in) :: self
    type(fuge_problem) :: problem

    allocate (problem%gap, source=self%gap)
    allocate (problem%resultant, source=[self%load])
    if (self%hardness > 0.0_dp) allocate (problem%limit, source=spread(self%largest_force(), 1, size(self%gap)))
  end function contact

  !> The surface `name`: sphere, light or heavy, or saturated_P, the heavy one with a mean pressure of P % of the
  !> hardness.
  subroutine make_surface(name, n, surface)
    character(len=*), intent(in) :: name
    integer, intent(in) :: n
    type(bench_surface), intent(out) :: surface
    integer :: share

    if (index(name, SATURATED) == 1) then
      call make_rough_surface(n, HEAVY, surface)
      read (name(len(SATURATED) + 1:), *) share
      surface%hardness = 100.0_dp*HEAVY/real(share, dp)
      surface%name = name
      return
    end if
    select case (name)
    case ('sphere')
      call make_sphere(n, FUGE_CENTRE, surface)
    case ('light_area')
      call make_rough_surface(n, LIGHT, surface)
    case ('heavy_area')
      call make_rough_surface(n, HEAVY, surface)
    case default
      error stop 'a surface is sphere, light_area, heavy_area or saturated_P'
    end select
    surface%name = name
  end subroutine make_surface

  !> A sphere of radius 2 on a free half-space, in the middle of a square. `side` (default 1) of the square, `radius`
  !> (default 0.3) of the contact.
  subroutine make_sphere(n, element, surface, side, radius)
    integer, intent(in) :: n, element
    type(bench_surface), intent(out) :: surface
    real(dp), intent(in), optional :: side, radius
    real(dp) :: x(n), mean
    integer :: j

    surface%name = 'sphere'
    surface%n = n
    surface%element = element
    if (present(side)) surface%side = side
    surface%contact_radius = PART
    if (present(radius)) surface%contact_radius = radius
    surface%load = 4.0_dp*surface%contact_radius**3/(3.0_dp*SPHERE)
    surface%approach = surface%contact_radius**2/SPHERE
    x = middles(surface)
    ! The mean of x**2 + y**2 over a cell is larger than its value at the centre.
    mean = merge(surface%cell()**2/6.0_dp, 0.0_dp, element == FUGE_MEAN)
    allocate (surface%gap(n*n))
    do j = 1, n
      surface%gap(n*(j - 1) + 1:n*j) = (x**2 + x(j)**2 + mean)/(2.0_dp*SPHERE)
    end do
  end subroutine make_sphere

  !> The centres of the cells of a side, from its middle.
  pure function middles(surface) result(x)
    class(bench_surface), intent(in) :: surface
    real(dp) :: x(surface%n)
    integer :: k

    x = [(0.5_dp*real(2*k - surface%n - 1, dp)*surface%cell(), k=1, surface%n)]
  end function middles

  !> Hertz's pressure integrated over each cell, (n*n), point i + n*(j - 1): along x in closed form, along y by Gauss.
  pure function exact_forces(self) result(force)
    class(bench_surface), intent(in) :: self
    real(dp) :: force(self%n**2)
    real(dp), parameter :: NODE(2) = [0.8611363115940526_dp, 0.3399810435848563_dp], &
      WEIGHT(2) = [0.3478548451374538_dp, 0.6521451548625461_dp]
    real(dp) :: x(self%n), half, peak
    integer :: i, j, k

    x = middles(self)
    half = 0.5_dp*self%cell()
    peak = 1.5_dp*self%load/(PI*self%contact_radius**3)
    do j = 1, self%n
      do i = 1, self%n
        force(i + self%n*(j - 1)) = 0.0_dp
        do k = 1, 2
          force(i + self%n*(j - 1)) = force(i + self%n*(j - 1)) + half*peak*WEIGHT(k)* &
            (strip(self%contact_radius, x(i), half, x(j) - half*NODE(k)) &
             + strip(self%contact_radius, x(i), half, x(j) + half*NODE(k)))
        end do
      end do
    end do
  end function exact_forces

  !> The integral of sqrt(radius**2 - x**2 - y**2), where that is real, over x - half .. x + half.
  pure function strip(radius, x, half, y) result(area)
    real(dp), intent(in) :: radius, x, half, y
    real(dp) :: area
    real(dp) :: chord

    area = 0.0_dp
    if (abs(y) >= radius) return
    chord = sqrt((radius - y)*(radius + y))
    if (abs(x) - half >= chord) return
    area = segment(min(x + half, chord), chord) - segment(max(x - half, -chord), chord)
  end function strip

  !> The integral of sqrt(chord**2 - x**2) from 0 to x.
  pure function segment(x, chord) result(area)
    real(dp), intent(in) :: x, chord
    real(dp) :: area

    area = 0.5_dp*(x*sqrt(max((chord - x)*(chord + x), 0.0_dp)) + chord**2*asin(x/chord))
  end function segment

  !> Periodic self-affine surface of side 1: waves of 4 .. n/8 periods in all directions with amplitudes k**(-1 - H) and
  !> random phases, slope 0.1 (root mean square). `n` >= 64 a power of two. Another n has the same long waves; with
  !> equal `periods` of the shortest wave (default n/8) another n is another grid of the same surface, and gaps count
  !> from its mean plane.
  subroutine make_rough_surface(n, pressure, surface, periods)
    integer, intent(in) :: n
    real(dp), intent(in) :: pressure
    type(bench_surface), intent(out) :: surface
    integer, intent(in), optional :: periods
    type(grid_transform) :: transform
    real(dp) :: slope
    integer(int64) :: state
    integer :: ring, k, j, most

    surface%name = 'rough'
    surface%n = n
    surface%load = pressure
    surface%boundary = FUGE_PERIODIC
    most = n/CELLS_OF_SHORTEST
    if (present(periods)) most = periods
    call transform%create(n, n)
    slope = 0.0_dp
    state = 5
    ! Ring after ring, so that a wave has the same phase for every n.
    do ring = 1, most
      do k = -ring, ring
        call add_wave(transform, [ring, k], most, state, slope)
        if (abs(k) < ring) call add_wave(transform, [k, ring], most, state, slope)
      end do
    end do
    call transform%backward()
    allocate (surface%gap(n*n))
    do j = 1, n
      surface%gap(n*(j - 1) + 1:n*j) = SLOPE_RMS/sqrt(slope)*transform%values(:n, j)
    end do
    call transform%free()
    if (present(periods)) then
      surface%gap = -surface%gap
    else
      surface%gap = maxval(surface%gap) - surface%gap
    end if
  end subroutine make_rough_surface

  !> Add the wave a cos(2 pi (k(1) x + k(2) y) + phase), and half of (2 pi |k| a)**2 to `slope`, unless it has more than
  !> `most` periods.
  subroutine add_wave(transform, k, most, state, slope)
    type(grid_transform), intent(inout) :: transform
    integer, intent(in) :: k(2), most
    integer(int64), intent(inout) :: state
    real(dp), intent(inout) :: slope
    real(dp) :: phase, length, amplitude
    complex(dp) :: wave
    integer :: n, row

    call next_uniform(state, phase)
    n = size(transform%waves, 2)
    length = hypot(real(k(1), dp), real(k(2), dp))
    if (length < LONGEST_WAVE .or. length > most) return
    amplitude = length**(-1.0_dp - HURST)
    slope = slope + 0.5_dp*(2.0_dp*PI*length*amplitude)**2
    wave = 0.5_dp*amplitude*cmplx(cos(2.0_dp*PI*phase), sin(2.0_dp*PI*phase), dp)
    row = 1 + modulo(k(2), n)
    ! The transform has the waves with k(1) >= 0; the others are their conjugates.
    if (k(1) >= 0) then
      transform%waves(1 + k(1), row) = wave
    else
      transform%waves(1 - k(1), 1 + modulo(-k(2), n)) = conjg(wave)
    end if
    if (k(1) == 0) transform%waves(1, 1 + modulo(-k(2), n)) = conjg(wave)
  end subroutine add_wave

  subroutine set_operator(surface, operator)
    type(bench_surface), intent(in) :: surface
    type(fuge_halfspace_operator), intent(inout) :: operator
    type(fuge_info) :: info

    call operator%set(surface%n, surface%n, surface%cell(), surface%cell(), 1.0_dp, info, surface%element, &
                      surface%boundary)
    if (info%failed()) error stop 'no operator of the half-space'
  end subroutine set_operator

  !> DIRECTORY/NAME_N.gaps: the gaps, 8 bytes each. DIRECTORY/NAME_N.area: what they are.
  subroutine write_surface(directory, surface)
    character(len=*), intent(in) :: directory
    type(bench_surface), intent(in) :: surface
    character(len=:), allocatable :: path
    integer :: unit

    path = trim(directory)//'/'//trim(surface%name)//'_'//whole(surface%n)
    open (newunit=unit, file=path//'.gaps', access='stream', form='unformatted', status='replace', action='write')
    write (unit) surface%gap
    close (unit)
    open (newunit=unit, file=path//'.area', status='replace', action='write')
    write (unit, '(2a)') 'problem ', trim(surface%name)
    write (unit, '(a, i0)') 'n ', surface%n, 'periodic ', surface%boundary
    write (unit, '(a, es24.16)') 'side ', surface%side, 'pressure ', surface%load/surface%side**2
    if (surface%hardness > 0.0_dp) write (unit, '(a, es24.16)') 'hardness ', surface%hardness
    close (unit)
  end subroutine write_surface

end module bench_surfaces
