!> An elastic body whose surface is no half-space, as a mixture of Gaussians.
!>
!> A wave q of pressure displaces its surface by 2 T(q)/(e_star q) times itself. With the weights w of the lengths t
!>
!>     T(q)/q = 2/sqrt(pi) times the integral of w(t) exp(-t**2 q**2) over t > 0,
!>
!> and w = 1 for the half-space. All kernels of grids follow from such an integral, a sum of products of Gaussians along
!> the two directions, whatever w is. The trapezoidal rule in log t takes w at unit*exp(STEP*k), k = 0, 1, ..; for
!> shorter t it is 1, as short waves do not feel what is below the surface.
module fuge_wave_mixture
  use fuge_constants, only: PI
  use fuge_gaussian_cells, only: NEGLIGIBLE
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgesv
  implicit none
  private

  !> Step of the rule in log t.
  real(dp), parameter, public :: STEP = 0.09_dp
  !> Below this t/h a Gaussian spreads no farther than to the next cell, and its shares are linear in t.
  real(dp), parameter, public :: SHORT = 0.04_dp
  !> Nodes that stand for all shorter t, and for all longer ones.
  integer, parameter :: SHORTER = 3, LONGER = 6
  !> All t above this many times the longest distance are far.
  real(dp), parameter :: FAR = 4.0_dp
  !> Euler's constant.
  real(dp), parameter :: EULER = 0.57721566490153286_dp

  type, public :: wave_mixture
    !> The t of the first weight, length; 0: the body is a half-space.
    real(dp) :: unit = 0.0_dp
    real(dp), allocatable :: weight(:)
    !> T of the longest waves: longer t have the weights `limit` + `tail` (t_last/t)**2.
    real(dp) :: limit = 1.0_dp, tail = 0.0_dp
  contains
    procedure :: is_set
    procedure :: weight_of
    procedure :: wave_factor
    procedure :: make_rule
    procedure :: line_constant
    procedure :: has_rigid_base
  end type wave_mixture

contains

  !> Is the body another one than a half-space?
  elemental function is_set(self)
    class(wave_mixture), intent(in) :: self
    logical :: is_set

    is_set = self%unit > 0.0_dp
  end function is_set

  !> Do long waves displace the surface less and less?
  elemental function has_rigid_base(self) result(rigid)
    class(wave_mixture), intent(in) :: self
    logical :: rigid

    rigid = .not. self%limit > 0.0_dp
  end function has_rigid_base

  !> The weight number `k` of t = unit*exp(STEP*k), of any sign.
  elemental function weight_of(self, k) result(weight)
    class(wave_mixture), intent(in) :: self
    integer, intent(in) :: k
    real(dp) :: weight

    if (k < 0) then
      weight = 1.0_dp
    else if (k < size(self%weight)) then
      weight = self%weight(k + 1)
    else
      weight = self%limit + self%tail*exp(-2.0_dp*STEP*real(k - size(self%weight) + 1, dp))
    end if
  end function weight_of

  !> T of the wave `q` > 0, 1/length.
  elemental function wave_factor(self, q) result(factor)
    class(wave_mixture), intent(in) :: self
    real(dp), intent(in) :: q
    real(dp) :: factor
    real(dp) :: x
    integer :: first, k, last

    ! Where t q is less than rounding, the next terms are as well.
    first = min(0, floor(log(epsilon(q)/(q*self%unit))/STEP))
    last = floor(log(NEGLIGIBLE/(q*self%unit))/STEP)
    factor = 0.0_dp
    do k = first, last
      x = q*self%unit*exp(STEP*real(k, dp))
      factor = factor + self%weight_of(k)*x*exp(-x**2)
    end do
    factor = 2.0_dp/sqrt(PI)*STEP*factor
  end function wave_factor

  !> Nodes t in units of `cell`, and weights of the integral over t, for cells as narrow as `cell` and up to waves or
  !> distances as long as `longest`, lengths.
  !>
  !> `free`: the number of directions, 0 .. 2, in which distances count. With 0 nodes end where Gaussians of the longest
  !> wave are negligible. Otherwise LONGER nodes stand for the t that are far above all distances, where the shares are
  !> t**(-free) times a polynomial in t**(-2): in one direction without its constant term, the sum of which is infinite
  !> and belongs to the datum (`line_constant`). `stat` as in an allocate statement.
  subroutine make_rule(self, cell, longest, free, node, weight, stat)
    class(wave_mixture), intent(in) :: self
    real(dp), intent(in) :: cell, longest
    integer, intent(in) :: free
    real(dp), allocatable, intent(out) :: node(:), weight(:)
    integer, intent(out) :: stat
    integer :: count, first, k, last

    first = ceiling(log(SHORT*cell/self%unit)/STEP)
    last = last_node(self, longest, free, first)
    count = SHORTER + last - first + 1
    allocate (node(count + merge(LONGER, 0, free > 0)), weight(count + merge(LONGER, 0, free > 0)), stat=stat)
    if (stat /= 0) return
    do k = first, last
      node(SHORTER + k - first + 1) = self%unit/cell*exp(STEP*real(k, dp))
      weight(SHORTER + k - first + 1) = STEP*node(SHORTER + k - first + 1)*self%weight_of(k)
    end do
    call stand_for_shorter(self, first, node(SHORTER + 1), node(:SHORTER), weight(:SHORTER), stat)
    if (free > 0 .and. stat == 0) call stand_for_longer(self, last, free, node(count), node(count + 1:), &
                                                        weight(count + 1:), stat)
  end subroutine make_rule

  !> The number of the longest t that is a node of its own.
  pure function last_node(self, longest, free, first) result(last)
    class(wave_mixture), intent(in) :: self
    real(dp), intent(in) :: longest
    integer, intent(in) :: free, first
    integer :: last

    if (free > 0) then
      last = max(first, ceiling(log(FAR*longest/self%unit)/STEP))
    else
      last = max(first, ceiling(log(NEGLIGIBLE*longest/(2.0_dp*PI*self%unit))/STEP))
      ! The constant wave has a sum that ends with the weights.
      if (self%has_rigid_base()) last = max(last, size(self%weight) - 1)
    end if
  end function last_node

  !> Weights of a few nodes for all t below `t`, that of number `first`: exact for polynomials of the degree SHORTER -
  !> 1.
  subroutine stand_for_shorter(self, first, t, node, weight, stat)
    class(wave_mixture), intent(in) :: self
    integer, intent(in) :: first
    real(dp), intent(in) :: t
    real(dp), intent(out) :: node(SHORTER), weight(SHORTER)
    integer, intent(out) :: stat
    real(dp) :: matrix(SHORTER, SHORTER), moment(SHORTER), ratio
    integer :: j, k

    node = [(t*real(k, dp)/real(SHORTER + 1, dp), k=1, SHORTER)]
    do j = 1, SHORTER
      matrix(j, :) = (node/t)**(j - 1)
      ! All that have the weight 1 are a geometric series.
      ratio = exp(-STEP*real(j, dp))
      moment(j) = exp(STEP*real(j*(min(first, 0) - first), dp))*ratio/(1.0_dp - ratio)
      do k = 0, first - 1
        moment(j) = moment(j) + self%weight_of(k)*exp(STEP*real(j*(k - first), dp))
      end do
    end do
    call solve(matrix, STEP*t*moment, weight, stat)
  end subroutine stand_for_shorter

  !> Weights of a few nodes for all t above `t`, that of number `last`.
  subroutine stand_for_longer(self, last, free, t, node, weight, stat)
    class(wave_mixture), intent(in) :: self
    integer, intent(in) :: last, free
    real(dp), intent(in) :: t
    real(dp), intent(out) :: node(LONGER), weight(LONGER)
    integer, intent(out) :: stat
    real(dp) :: inverse_square(LONGER), matrix(LONGER, LONGER), moment(LONGER), power
    integer :: end_of_sum, j, k

    inverse_square = [(0.5_dp + 0.5_dp*cos((real(k, dp) - 0.5_dp)*PI/real(LONGER, dp)), k=1, LONGER)]
    node = t/sqrt(inverse_square)
    end_of_sum = max(last, size(self%weight) - 1)
    do j = 1, LONGER
      power = 0.5_dp*real(free, dp) + real(j - merge(0, 1, free == 1), dp)
      matrix(j, :) = inverse_square**power
      power = STEP*(1.0_dp - 2.0_dp*power)
      moment(j) = rest_of_series(self, last, end_of_sum, power)
      do k = last + 1, end_of_sum
        moment(j) = moment(j) + self%weight_of(k)*exp(power*real(k - last, dp))
      end do
    end do
    call solve(matrix, STEP*t*moment, weight, stat)
  end subroutine stand_for_longer

  !> The sum over all k > `after` >= size(self%weight) - 1 of weight_of(k)*exp(`power`*(k - `last`)), `power` < 0.
  pure function rest_of_series(self, last, after, power) result(total)
    class(wave_mixture), intent(in) :: self
    integer, intent(in) :: last, after
    real(dp), intent(in) :: power
    real(dp) :: total
    real(dp) :: begin, tail

    begin = exp(power*real(after - last, dp))
    tail = self%tail*exp(-2.0_dp*STEP*real(after - size(self%weight) + 1, dp))
    total = begin*(self%limit/(exp(-power) - 1.0_dp) + tail/(exp(2.0_dp*STEP - power) - 1.0_dp))
  end function rest_of_series

  !> What the longest t add at all distances in one direction, with the nodes of a rule for `free` = 1, so that for
  !> large distances x the sum of weight/node*exp(-(x/(2 node))**2) and this is limit*log(1/x): x and nodes in units of
  !> `cell`.
  pure function line_constant(self, cell, node, weight) result(constant)
    class(wave_mixture), intent(in) :: self
    real(dp), intent(in) :: cell, node(:), weight(:)
    real(dp) :: constant
    integer :: count, k, last

    count = size(node) - LONGER
    last = nint(log(node(count)*cell/self%unit)/STEP)
    constant = -self%limit*(log(2.0_dp*node(count)) + 0.5_dp*STEP - 0.5_dp*EULER) &
               - sum(weight(count + 1:)/node(count + 1:))
    ! Weights that still differ from the limit.
    do k = last + 1, size(self%weight) - 1
      constant = constant + STEP*(self%weight_of(k) - self%limit)
    end do
    k = max(last, size(self%weight) - 1)
    constant = constant + STEP*self%tail*exp(-2.0_dp*STEP*real(k - size(self%weight) + 1, dp)) &
               /(exp(2.0_dp*STEP) - 1.0_dp)
  end function line_constant

  !> The solution of a small system of equations.
  subroutine solve(matrix, right, solution, stat)
    real(dp), intent(in) :: matrix(:, :), right(:)
    real(dp), intent(out) :: solution(:)
    integer, intent(out) :: stat
    real(dp) :: factor(size(right), size(right))
    integer :: pivot(size(right))

    factor = matrix
    solution = right
    call dgesv(size(right), 1, factor, size(right), pivot, solution, size(right), stat)
  end subroutine solve

end module fuge_wave_mixture
