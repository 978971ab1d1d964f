!> The response of a periodic half-space to a wave of forces on a grid of rectangles, at a depth below their centres.
!>
!> A wave of pressure exp(i(q_x x + q_y y)) gives at the depth z, with s = |q|, stresses and displacements that are
!> powers of q_x and q_y times exp(-s z), exp(-s z)/s, exp(-s z)/s**2 and (1 + s z) exp(-s z). Waves that are the same
!> on the cells add up, each times sinc(q_x h_x/2) sinc(q_y h_y/2). That sum over two directions converges slowly near
!> the surface. As in fuge_halfspace_waves, integrals over t > 0 of exp(-t**2 s**2),
!>
!>     exp(-s z)/s**2 = integral of 2 t erfc(z/(2t)) exp(-t**2 s**2),
!>     exp(-s z)/s = integral of 2/sqrt(pi) g exp(-t**2 s**2), g = exp(-z**2/(4t**2)),
!>     exp(-s z) = integral of z/(sqrt(pi) t**2) g exp(-t**2 s**2),
!>     (1 + s z) exp(-s z) = integral of z**3/(2 sqrt(pi) t**4) g exp(-t**2 s**2),
!>
!> make products of two sums of it, each over one direction, which converge like Gaussians (fuge_cell_gaussians). The
!> trapezoidal rule in log t converges exponentially: some 80 values of t give the factors of all waves, as a product of
!> two matrices for each term. The sums are the same at all depths. Deep below the surface only the wave itself counts.
!>
!> On a surface that is periodic along one direction only the same products are taken at places instead of waves,
!> without the wave of equal forces along that direction, which is a half-plane's.
module fuge_halfspace_wave_factors
  use fuge_cell_gaussians, only: circle_work, fill_gaussian_circle, fill_gaussian_places, fill_gaussian_waves
  use fuge_constants, only: PI
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgemm
  implicit none
  private

  public :: bytes_of_waves

  !> q_x**power(1) q_y**power(2) times `over_square` exp(-s z)/s**2 + `over_wave` exp(-s z)/s + `plain` exp(-s z)
  !> + `rising` (1 + s z) exp(-s z); lengths in the unit of the waves.
  type, public :: wave_term
    integer :: power(2) = 0
    real(dp) :: over_square = 0.0_dp, over_wave = 0.0_dp, plain = 0.0_dp, rising = 0.0_dp
  end type wave_term

  !> The sums of both directions.
  type, public :: wave_sums
    !> The smaller spacing, unit of length.
    real(dp) :: unit = 0.0_dp
    !> Spacings in this unit.
    real(dp), private :: spacing(2) = 0.0_dp
    integer, private :: cells(2) = 0
    !> The sums are those at places, not of waves.
    logical, private :: places = .false.
    !> Values of t; (waves or places, t, order) along x and along y; room for one order along x with weights.
    real(dp), allocatable, private :: node(:), along_x(:, :, :), along_y(:, :, :), weighted(:, :)
    !> The sums of order 0 for a small t.
    real(dp), allocatable, private :: narrow_x(:), narrow_y(:)
  contains
    procedure :: prepare
    procedure :: prepare_places
    procedure :: add_term
  end type wave_sums

  !> Step of the trapezoidal rule in log t; its relative error is 3 exp(-pi**2/(2 STEP)).
  real(dp), parameter :: STEP = 0.12_dp
  !> Below this t a cell is met by its own Gaussian only.
  real(dp), parameter :: SHORT = 0.04_dp
  !> erfc(x) and exp(-x**2) are less than rounding.
  real(dp), parameter :: NEGLIGIBLE = 6.3_dp
  !> From this depth on, in units of the greater spacing, the waves that coincide with it on the cells are left out.
  real(dp), parameter :: DEEP = 12.0_dp
  !> Depths below this one are the surface.
  real(dp), parameter :: SHALLOW = 1.0e-30_dp

contains

  !> How many values of t are taken beyond SHORT for waves up to the length of a `period`, in units of the smaller
  !> spacing.
  pure function count_nodes(period) result(count)
    real(dp), intent(in) :: period
    integer :: count

    count = max(1, ceiling(log(NEGLIGIBLE*period/(2.0_dp*PI*SHORT))/STEP))
  end function count_nodes

  !> Memory for the sums and one table of factors of `cells` (2), for `extent` (2) waves or places.
  pure function bytes_of_waves(cells, spacing, extent) result(bytes)
    integer, intent(in) :: cells(2), extent(2)
    real(dp), intent(in) :: spacing(2)
    real(dp) :: bytes, nodes

    nodes = real(count_nodes(maxval(cells*(spacing/minval(spacing)))), dp)
    bytes = 8.0_dp*(real(extent(1), dp)*real(extent(2), dp) + nodes*(4.0_dp*real(extent(1), &
                                                                                 dp) + 3.0_dp*real(extent(2), dp)))
  end function bytes_of_waves

  !> Compute the sums for the waves of a grid of `cells` (2) with `spacing` (2), length. `stat` as in an allocate
  !> statement.
  pure subroutine prepare(self, cells, spacing, stat)
    class(wave_sums), intent(inout) :: self
    integer, intent(in) :: cells(2)
    real(dp), intent(in) :: spacing(2)
    integer, intent(out) :: stat
    integer :: k

    call allocate_sums(self, cells, spacing, maxval(cells*(spacing/minval(spacing))), cells/2 + 1, stat)
    if (stat /= 0) return
    self%places = .false.
    self%narrow_x = 1.0_dp
    self%narrow_y = 1.0_dp
    do k = 1, size(self%node)
      call fill_gaussian_waves(cells(1), self%node(k)/self%spacing(1), self%along_x(:, k, :))
      call fill_gaussian_waves(cells(2), self%node(k)/self%spacing(2), self%along_y(:, k, :))
    end do
  end subroutine prepare

  !> Compute the sums for the places on a grid that is periodic along `direction`, 1 for x or 2 for y, with the period
  !> of the grid: at distances up to half of it, and along the other direction up to all cells.
  !>
  !> Other arguments as for `prepare`.
  pure subroutine prepare_places(self, cells, spacing, direction, stat)
    class(wave_sums), intent(inout) :: self
    integer, intent(in) :: cells(2), direction
    real(dp), intent(in) :: spacing(2)
    integer, intent(out) :: stat
    integer :: extent(2)

    extent = cells
    extent(direction) = cells(direction)/2 + 1
    call allocate_sums(self, cells, spacing, cells(direction)*(spacing(direction)/minval(spacing)), extent, stat)
    if (stat /= 0) return
    self%places = .true.
    call fill_places(cells(1), direction == 1, self%node/self%spacing(1), self%along_x, self%narrow_x, stat)
    if (stat == 0) call fill_places(cells(2), direction == 2, self%node/self%spacing(2), self%along_y, self%narrow_y, &
                                    stat)
  end subroutine prepare_places

  !> The sums at the places along one direction of `n` cells, periodic or not, at the values `t` in units of a cell.
  pure subroutine fill_places(n, periodic, t, along, narrow, stat)
    integer, intent(in) :: n
    logical, intent(in) :: periodic
    real(dp), intent(in) :: t(:)
    real(dp), intent(inout) :: along(0:, :, 0:), narrow(0:)
    integer, intent(out) :: stat
    real(dp), allocatable :: work(:, :)
    integer :: k

    narrow = 0.0_dp
    narrow(0) = 1.0_dp
    stat = 0
    if (periodic) then
      allocate (work(0:circle_work(n), 0:2), stat=stat)
      if (stat /= 0) return
      narrow = narrow - 1.0_dp/real(n, dp)
    end if
    do k = 1, size(t)
      if (periodic) then
        call fill_gaussian_circle(n, t(k), work, along(:, k, :))
      else
        call fill_gaussian_places(t(k), along(:, k, :))
      end if
    end do
  end subroutine fill_places

  !> Allocate and fill what does not depend on the kind of the sums.
  pure subroutine allocate_sums(self, cells, spacing, period, extent, stat)
    type(wave_sums), intent(inout) :: self
    integer, intent(in) :: cells(2), extent(2)
    real(dp), intent(in) :: spacing(2), period
    integer, intent(out) :: stat
    integer :: k, nodes

    self%cells = cells
    self%unit = minval(spacing)
    self%spacing = spacing/self%unit
    nodes = count_nodes(period)
    allocate (self%node(nodes), self%along_x(0:extent(1) - 1, nodes, 0:2), self%along_y(0:extent(2) - 1, nodes, 0:2), &
              self%weighted(0:extent(1) - 1, nodes), self%narrow_x(0:extent(1) - 1), self%narrow_y(0:extent(2) - 1), &
              stat=stat)
    if (stat /= 0) return
    do k = 1, nodes
      self%node(k) = SHORT*exp(STEP*real(k, dp))
    end do
  end subroutine allocate_sums

  !> Add a `term` at a `depth` >= 0 to `factor` (0:nx/2, 0:ny/2): factor(j, k) belongs to the wave with j and k periods
  !> along x and y, and that of the wave (0, 0) has no meaning. After `prepare_places`: to the influence of unit
  !> pressure on a cell, `factor` (0:nx/2, 0:ny - 1) or (0:nx - 1, 0:ny/2), at these distances. Lengths in `unit`.
  subroutine add_term(self, term, depth, factor)
    class(wave_sums), intent(inout) :: self
    type(wave_term), intent(in) :: term
    real(dp), intent(in) :: depth
    real(dp), intent(inout), contiguous :: factor(0:, 0:)
    real(dp) :: scaling
    integer :: first, j, k

    if (depth >= DEEP*maxval(self%spacing) .and. .not. self%places) then
      call add_wave_itself(self, term, depth, factor)
      return
    end if
    if (all(term%power == 0)) then
      scaling = part_of_cell(term, depth)
      do j = 0, ubound(factor, 2)
        factor(:, j) = factor(:, j) + scaling*self%narrow_y(j)*self%narrow_x
      end do
    end if
    scaling = 1.0_dp/product(self%spacing**term%power)
    ! A slope stands for i q, the product of two slopes for -q_x q_y.
    if (self%places .and. all(term%power == 1)) scaling = -scaling
    first = first_node(self%node, depth)
    do k = first, size(self%node)
      self%weighted(:, k) = (scaling*weight_of(term, depth, self%node(k)))*self%along_x(:, k, term%power(1))
    end do
    call dgemm('N', 'T', size(factor, 1), size(factor, 2), size(self%node) - first + 1, 1.0_dp, &
               self%weighted(:, first:), size(factor, 1), self%along_y(:, first:, term%power(2)), size(factor, 2), &
               1.0_dp, factor, size(factor, 1))
  end subroutine add_term

  !> The first node whose weight at this depth is more than rounding.
  pure function first_node(node, depth) result(first)
    real(dp), intent(in) :: node(:), depth
    integer :: first

    first = 1
    do while (first < size(node))
      if (depth < 2.0_dp*NEGLIGIBLE*node(first)) exit
      first = first + 1
    end do
  end function first_node

  !> The sum of the rule over the values of t up to SHORT, for which the factors of all waves are 1.
  pure function part_of_cell(term, depth) result(total)
    type(wave_term), intent(in) :: term
    real(dp), intent(in) :: depth
    real(dp) :: total, t

    total = 0.0_dp
    if (depth < SHALLOW) total = term%plain + term%rising
    t = SHORT
    do while (t > 1.0e-18_dp*SHORT .or. depth >= SHALLOW)
      if (depth > 2.0_dp*NEGLIGIBLE*t) exit
      total = total + weight_of(term, depth, t)
      t = t*exp(-STEP)
    end do
  end function part_of_cell

  !> The factor of exp(-t**2 s**2) in the trapezoidal rule.
  pure function weight_of(term, depth, t) result(weight)
    type(wave_term), intent(in) :: term
    real(dp), intent(in) :: depth, t
    real(dp) :: weight, ratio

    ratio = depth/t
    weight = 2.0_dp*t*term%over_square*erfc(0.5_dp*ratio)
    weight = weight + (2.0_dp*term%over_wave + ratio/t*(term%plain + 0.5_dp*ratio**2*term%rising)) &
             *exp(-(0.5_dp*ratio)**2)/sqrt(PI)
    weight = STEP*t*weight
  end function weight_of

  !> As `add_term`, without the waves that coincide with these on the cells.
  pure subroutine add_wave_itself(self, term, depth, factor)
    class(wave_sums), intent(inout) :: self
    type(wave_term), intent(in) :: term
    real(dp), intent(in) :: depth
    real(dp), intent(inout) :: factor(0:, 0:)
    real(dp) :: along_y, q(2)
    integer :: first, i, j

    do i = 0, ubound(factor, 1)
      self%weighted(i, 1) = transfer_of(wave_number(self, 1, i), self%spacing(1), term%power(1))
    end do
    do j = 0, ubound(factor, 2)
      q(2) = wave_number(self, 2, j)
      along_y = transfer_of(q(2), self%spacing(2), term%power(2))
      first = merge(1, 0, j == 0)
      do i = first, ubound(factor, 1)
        q(1) = wave_number(self, 1, i)
        factor(i, j) = factor(i, j) + along_y*self%weighted(i, 1)*value_of(term, sqrt(q(1)**2 + q(2)**2), depth)
      end do
    end do
  end subroutine add_wave_itself

  !> q of the wave of `periods` periods along x (1) or y (2).
  pure function wave_number(self, direction, periods) result(q)
    class(wave_sums), intent(in) :: self
    integer, intent(in) :: direction, periods
    real(dp) :: q

    q = 2.0_dp*PI*(real(periods, dp)/real(self%cells(direction), dp))/self%spacing(direction)
  end function wave_number

  !> q**power sinc(q h/2).
  pure function transfer_of(q, h, power) result(transfer)
    real(dp), intent(in) :: q, h
    integer, intent(in) :: power
    real(dp) :: transfer

    transfer = q**power
    if (q > 0.0_dp) transfer = transfer*(sin(0.5_dp*q*h)/(0.5_dp*q*h))
  end function transfer_of

  pure function value_of(term, s, depth) result(value)
    type(wave_term), intent(in) :: term
    real(dp), intent(in) :: s, depth
    real(dp) :: value

    value = 0.0_dp
    if (s*depth < 700.0_dp) value = exp(-s*depth)*((term%over_square/s + term%over_wave)/s + term%plain &
                                                   + term%rising*(1.0_dp + s*depth))
  end function value_of

end module fuge_halfspace_wave_factors
