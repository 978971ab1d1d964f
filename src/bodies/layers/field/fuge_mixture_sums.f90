!> Gaussians of many lengths on a grid of rectangles: the factors of its waves, or their values at its cells, along
!> both directions, and the sums of their products with the weights of a mixture.
module fuge_mixture_sums
  use fuge_cell_gaussians, only: circle_work, fill_gaussian_circle, fill_gaussian_places, fill_gaussian_waves
  use fuge_constants, only: PI
  use fuge_depth_mixture, only: depth_mixture, NEGLIGIBLE, OF_DOWN, POWERS, STEP
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgemm
  implicit none
  private

  public :: bytes_of_sums

  !> Gaussians longer than this many times all distances are the first term of their series in 1/t to rounding.
  real(dp), parameter :: FAR = 1.0e6_dp

  !> What a direction needs: the factors of waves, values at cells of a circle without their mean, or at cells.
  integer, parameter, public :: WAVES_OF = 1, CIRCLE_OF = 2, PLACES_OF = 3

  type, public :: mixture_sums
    !> Cells and spacing of both directions, length, and what each of them needs.
    integer :: cells(2) = 0, kind(2) = PLACES_OF
    real(dp) :: spacing(2) = 0.0_dp
    !> The first length is exp(STEP*first).
    integer :: first = 0
    !> (0:m, lengths, order): m half of the cells of a circle, otherwise all but one.
    real(dp), allocatable :: along_x(:, :, :), along_y(:, :, :)
    real(dp), allocatable, private :: weighted(:, :)
  contains
    procedure :: prepare
    procedure :: add_product
    procedure :: fill_plane
    procedure :: line_datum
  end type mixture_sums

contains

  !> Memory of the sums that `prepare` would compute with these arguments.
  pure function bytes_of_sums(cells, spacing, kind, first) result(bytes)
    integer, intent(in) :: cells(2), kind(2), first
    real(dp), intent(in) :: spacing(2)
    real(dp) :: bytes
    real(dp) :: values(2)
    integer :: k

    values = real(merge(cells - 1, cells/2, kind == PLACES_OF), dp) + 1.0_dp
    bytes = real(count_lengths(cells, spacing, kind, first), dp)*(4.0_dp*values(1) + 3.0_dp*values(2))
    do k = 1, 2
      if (kind(k) == CIRCLE_OF) bytes = bytes + 3.0_dp*(real(circle_work(cells(k)), dp) + 1.0_dp)
    end do
    bytes = 8.0_dp*bytes
  end function bytes_of_sums

  !> Lengths from exp(STEP*first) to the last one that counts.
  pure function count_lengths(cells, spacing, kind, first) result(lengths)
    integer, intent(in) :: cells(2), kind(2), first
    real(dp), intent(in) :: spacing(2)
    integer :: lengths

    lengths = max(1, ceiling(log(longest_length(cells*spacing, kind))/STEP) - first + 1)
  end function count_lengths

  !> Compute the sums for a grid of `cells` (2) with `spacing` (2), length, for lengths from exp(STEP*first) on. `stat`
  !> as in an allocate statement.
  subroutine prepare(self, cells, spacing, kind, first, stat)
    class(mixture_sums), intent(inout) :: self
    integer, intent(in) :: cells(2), kind(2), first
    real(dp), intent(in) :: spacing(2)
    integer, intent(out) :: stat
    integer :: extent(2), lengths

    self%cells = cells
    self%spacing = spacing
    self%kind = kind
    self%first = first
    lengths = count_lengths(cells, spacing, kind, first)
    extent = merge(cells - 1, cells/2, kind == PLACES_OF)
    allocate (self%along_x(0:extent(1), lengths, 0:2), self%along_y(0:extent(2), lengths, 0:2), &
              self%weighted(0:extent(1), lengths), stat=stat)
    if (stat == 0) call fill(kind(1), cells(1), spacing(1), first, self%along_x, stat)
    if (stat == 0) call fill(kind(2), cells(2), spacing(2), first, self%along_y, stat)
  end subroutine prepare

  !> The last length that counts on a grid of this `extent` (2).
  pure function longest_length(extent, kind) result(length)
    real(dp), intent(in) :: extent(2)
    integer, intent(in) :: kind(2)
    real(dp) :: length

    if (all(kind == WAVES_OF)) then
      length = NEGLIGIBLE*maxval(extent)/(2.0_dp*PI)
    else
      length = FAR*maxval(extent)
    end if
  end function longest_length

  subroutine fill(kind, n, spacing, first, along, stat)
    integer, intent(in) :: kind, n, first
    real(dp), intent(in) :: spacing
    real(dp), intent(out) :: along(0:, :, 0:)
    integer, intent(out) :: stat
    real(dp), allocatable :: work(:, :)
    real(dp) :: t
    integer :: k

    stat = 0
    if (kind == CIRCLE_OF) allocate (work(0:circle_work(n), 0:2), stat=stat)
    if (stat /= 0) return
    do k = 1, size(along, 2)
      t = exp(STEP*real(first + k - 1, dp))/spacing
      select case (kind)
      case (WAVES_OF)
        call fill_gaussian_waves(n, t, along(:, k, :))
      case (CIRCLE_OF)
        call fill_gaussian_circle(n, t, work, along(:, k, :))
      case default
        call fill_gaussian_places(t, along(:, k, :))
      end select
    end do
  end subroutine fill

  !> Add to `factor` (0:, 0:) what unit pressure on a cell, or a wave of it, gives of a `function` of the mixture
  !> times q_x**power(1) q_y**power(2).
  subroutine add_product(self, mixture, function, power, factor)
    class(mixture_sums), intent(inout) :: self
    type(depth_mixture), intent(in) :: mixture
    integer, intent(in) :: function, power(2)
    real(dp), intent(inout), contiguous :: factor(:, :)
    real(dp) :: scaling
    integer :: k, nodes

    nodes = size(self%along_x, 2)
    scaling = 1.0_dp/product(self%spacing**power)
    ! A slope stands for i q, the product of two slopes for -q_x q_y.
    if (any(self%kind /= WAVES_OF) .and. all(power == 1)) scaling = -scaling
    do k = 1, nodes
      self%weighted(:, k) = (scaling*weight_at(self, mixture, function, k))*self%along_x(:, k, power(1))
    end do
    call dgemm('N', 'T', size(factor, 1), size(factor, 2), nodes, 1.0_dp, self%weighted, size(factor, 1), &
               self%along_y(:, :, power(2)), size(factor, 2), 1.0_dp, factor, size(factor, 1))
    if (all(self%kind == PLACES_OF)) call add_longer(self, mixture, function, power, factor)
  end subroutine add_product

  !> What all longer lengths add on a free surface: t**-2/(4 pi) of a cell's area and, for each slope, -x/(2 t**2) times
  !> that, for each second one 1/(2 t**2).
  subroutine add_longer(sums, mixture, function, power, factor)
    type(mixture_sums), intent(in) :: sums
    type(depth_mixture), intent(in) :: mixture
    integer, intent(in) :: function, power(2)
    real(dp), intent(inout) :: factor(0:, 0:)
    real(dp) :: rest
    integer :: i, j

    if (all(power == 1)) return
    rest = product(sums%spacing)/(4.0_dp*PI)*sum_beyond(sums, mixture, function, POWERS(function) &
                                                         - merge(2, 4, sum(power) == 0), 0.0_dp)
    if (sum(power) > 0) rest = 0.5_dp*rest
    do j = 0, ubound(factor, 2)
      if (power(1) == 1) then
        do i = 1, ubound(factor, 1)
          factor(i, j) = factor(i, j) - rest*(i*sums%spacing(1))
        end do
      else if (power(2) == 1) then
        factor(:, j) = factor(:, j) - rest*(j*sums%spacing(2))
      else
        factor(:, j) = factor(:, j) + rest
      end if
    end do
  end subroutine add_longer

  !> `values` (0:m), m as of the sums along `direction`: what unit pressure on whole rows of cells, which lie across it,
  !> gives at the cells across them, or waves of it. Of a `function` of the mixture, and if `slope` the slope of it. The
  !> displacement along z lacks its datum (`line_datum`).
  pure subroutine fill_plane(self, mixture, function, slope, direction, values)
    class(mixture_sums), intent(in) :: self
    type(depth_mixture), intent(in) :: mixture
    integer, intent(in) :: function, direction
    logical, intent(in) :: slope
    real(dp), intent(out) :: values(0:)
    real(dp) :: weight
    integer :: k, order

    order = merge(1, 0, slope)
    values = 0.0_dp
    do k = 1, size(self%along_x, 2)
      weight = weight_at(self, mixture, function, k)/self%spacing(direction)**order
      if (direction == 1) then
        values = values + weight*self%along_x(:, k, order)
      else
        values = values + weight*self%along_y(:, k, order)
      end if
    end do
    if (self%kind(direction) /= PLACES_OF) return
    ! Longer lengths: 1/(2 sqrt(pi) t) of a cell's width, and the slope of that.
    weight = self%spacing(direction)/(2.0_dp*sqrt(PI))
    if (slope) then
      weight = 0.5_dp*weight*sum_beyond(self, mixture, function, POWERS(function) - 3, 0.0_dp)
      do k = 1, ubound(values, 1)
        values(k) = values(k) - weight*(k*self%spacing(direction))
      end do
    else if (function /= OF_DOWN) then
      values = values + weight*sum_beyond(self, mixture, function, POWERS(function) - 1, 0.0_dp)
    end if
  end subroutine fill_plane

  !> What all longer lengths add to the displacement along z in plane strain, under unit pressure on a cell along
  !> `direction`: so that far away it would be zero at the distance `reach`.
  pure function line_datum(self, mixture, direction, reach) result(displacement)
    class(mixture_sums), intent(in) :: self
    type(depth_mixture), intent(in) :: mixture
    integer, intent(in) :: direction
    real(dp), intent(in) :: reach
    real(dp) :: displacement

    displacement = sum_beyond(self, mixture, OF_DOWN, 0, mixture%beyond(1, OF_DOWN)) &
                   + mixture%datum_beyond(self%first + size(self%along_x, 2) - 1, reach)
    displacement = displacement*self%spacing(direction)/(2.0_dp*sqrt(PI))
  end function line_datum

  !> The sum over all longer lengths of the weights less `limit` times t**power, power <= 0.
  pure function sum_beyond(sums, mixture, function, power, limit) result(total)
    type(mixture_sums), intent(in) :: sums
    type(depth_mixture), intent(in) :: mixture
    integer, intent(in) :: function, power
    real(dp), intent(in) :: limit
    real(dp) :: total

    total = mixture%sum_from(function, sums%first + size(sums%along_x, 2), power, limit, 0.0_dp)
  end function sum_beyond

  !> The weight of length number `k` of the sums, times t**m.
  pure function weight_at(sums, mixture, function, k) result(weight)
    type(mixture_sums), intent(in) :: sums
    type(depth_mixture), intent(in) :: mixture
    integer, intent(in) :: function, k
    real(dp) :: weight
    integer :: number

    number = sums%first + k - 1
    weight = mixture%weight_of(function, number)*exp(STEP*real(POWERS(function)*number, dp))
  end function weight_at

end module fuge_mixture_sums
