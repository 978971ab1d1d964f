!> The mixture of Gaussians of a body whose waves are known, by least squares.
module fuge_mixture_fit
  use fuge_constants, only: PI
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgelsy
  use fuge_status, only: fuge_info, require_memory
  use fuge_wave_mixture, only: wave_mixture, STEP
  implicit none
  private

  public :: fit_mixture

  !> Width of the narrowest Gaussian over the shortest length: its transform is 1 for all waves whose T differs from 1
  !> by more than rounding.
  real(dp), parameter :: FIRST = 1.0_dp/7.0_dp
  !> From this q times the shortest length on, T is 1 to rounding.
  real(dp), parameter :: SHORTEST_WAVE = 25.0_dp
  !> The longest wave has this q times the longest t.
  real(dp), parameter :: LONGEST_WAVE = 0.03_dp
  !> Waves for each weight.
  integer, parameter :: WAVES = 3
  !> Errors count relative to T, or to this if T is smaller.
  real(dp), parameter :: FLOOR_OF_T = 1.0e-4_dp
  !> Singular values below this fraction of the largest one are rounding.
  real(dp), parameter :: RANK_TOLERANCE = 1.0e-15_dp
  !> exp(-x**2) is less than rounding.
  real(dp), parameter :: NEGLIGIBLE = 6.3_dp

  !> A body of which T is known.
  type, abstract, public :: wave_symbol
  contains
    procedure(factor_of_wave), deferred :: wave_factor
  end type wave_symbol

  abstract interface
    !> T of a wave `q` > 0, 1/length.
    pure function factor_of_wave(self, q) result(factor)
      import :: wave_symbol, dp
      class(wave_symbol), intent(in) :: self
      real(dp), intent(in) :: q
      real(dp) :: factor
    end function factor_of_wave
  end interface

contains

  !> Fit `mixture` to the waves of `body`.
  !>
  !> T is 1 for waves shorter than `shortest`, and `limit` for those far longer than `longest`, lengths. `error`, if it
  !> is wanted: the largest one of T at waves between those of the fit, relative to T. Error: FUGE_ERR_MEMORY.
  subroutine fit_mixture(body, shortest, longest, limit, mixture, info, error)
    class(wave_symbol), intent(in) :: body
    real(dp), intent(in) :: shortest, longest, limit
    type(wave_mixture), intent(out) :: mixture
    type(fuge_info), intent(inout) :: info
    real(dp), intent(out), optional :: error
    real(dp), allocatable :: matrix(:, :), right(:)
    real(dp) :: from, ratio
    integer :: count, middle, rows, stat

    if (present(error)) error = 0.0_dp
    count = max(2, ceiling(log(longest/(FIRST*shortest))/STEP))
    middle = count/2
    rows = WAVES*count
    allocate (mixture%weight(count), matrix(rows, count + 1), right(rows), stat=stat)
    call require_memory(stat, 'the waves of layers, with', count, 'weights', info)
    if (stat /= 0) return
    mixture%unit = FIRST*shortest
    mixture%limit = limit
    mixture%weight(:middle) = 1.0_dp
    mixture%weight(middle + 1:) = limit
    from = LONGEST_WAVE/(mixture%unit*exp(STEP*real(count - 1, dp)))
    ratio = (SHORTEST_WAVE/shortest/from)**(1.0_dp/real(rows - 1, dp))
    call set_equations(body, mixture, from, ratio, matrix, right)
    call solve_least_squares(matrix, right, stat)
    call require_memory(stat, 'the waves of layers, with', count, 'weights', info)
    if (info%failed()) return
    mixture%weight = mixture%weight + right(:count)
    if (limit > 0.0_dp) mixture%tail = right(count + 1)
    if (present(error)) error = largest_error(body, mixture, from*sqrt(ratio), ratio, rows - 1)
  end subroutine fit_mixture

  !> One equation for each wave: what the weights have to add to the T of `mixture`, over T.
  subroutine set_equations(body, mixture, from, ratio, matrix, right)
    class(wave_symbol), intent(in) :: body
    type(wave_mixture), intent(in) :: mixture
    real(dp), intent(in) :: from, ratio
    real(dp), intent(out) :: matrix(:, :), right(:)
    real(dp) :: factor, q, x
    integer :: count, k, row

    count = size(mixture%weight)
    q = from
    do row = 1, size(right)
      factor = body%wave_factor(q)
      do k = 1, count
        matrix(row, k) = term(q*mixture%unit*exp(STEP*real(k - 1, dp)))
      end do
      ! Longer t, whose weights fall off like 1/t**2, on a rigid base faster.
      matrix(row, count + 1) = 0.0_dp
      k = 1
      x = q*mixture%unit*exp(STEP*real(count, dp))
      do while (x < NEGLIGIBLE .and. mixture%limit > 0.0_dp)
        matrix(row, count + 1) = matrix(row, count + 1) + term(x)*exp(-2.0_dp*STEP*real(k, dp))
        k = k + 1
        x = x*exp(STEP)
      end do
      right(row) = factor - mixture%wave_factor(q)
      factor = 1.0_dp/max(abs(factor), FLOOR_OF_T)
      matrix(row, :) = factor*matrix(row, :)
      right(row) = factor*right(row)
      q = q*ratio
    end do
  end subroutine set_equations

  !> The term of t q = `x` in the sum that gives T.
  elemental function term(x)
    real(dp), intent(in) :: x
    real(dp) :: term

    term = 0.0_dp
    if (x < NEGLIGIBLE) term = 2.0_dp/sqrt(PI)*STEP*x*exp(-x**2)
  end function term

  !> The weights of least squares, the least ones where rounding leaves them open, in the first elements of `right`.
  subroutine solve_least_squares(matrix, right, stat)
    real(dp), intent(inout) :: matrix(:, :), right(:)
    integer, intent(out) :: stat
    real(dp), allocatable :: work(:)
    real(dp) :: size_of_work(1)
    integer, allocatable :: pivot(:)
    integer :: rank

    allocate (pivot(size(matrix, 2)), source=0, stat=stat)
    if (stat /= 0) return
    call dgelsy(size(matrix, 1), size(matrix, 2), 1, matrix, size(matrix, 1), right, size(right), pivot, &
                RANK_TOLERANCE, rank, size_of_work, -1, stat)
    allocate (work(max(1, int(size_of_work(1)))), stat=stat)
    if (stat /= 0) return
    call dgelsy(size(matrix, 1), size(matrix, 2), 1, matrix, size(matrix, 1), right, size(right), pivot, &
                RANK_TOLERANCE, rank, work, size(work), stat)
  end subroutine solve_least_squares

  !> The largest relative error of T at `waves` waves.
  pure function largest_error(body, mixture, from, ratio, waves) result(error)
    class(wave_symbol), intent(in) :: body
    type(wave_mixture), intent(in) :: mixture
    real(dp), intent(in) :: from, ratio
    integer, intent(in) :: waves
    real(dp) :: error
    real(dp) :: factor, q
    integer :: k

    error = 0.0_dp
    q = from
    do k = 1, waves
      factor = body%wave_factor(q)
      error = max(error, abs(mixture%wave_factor(q) - factor)/max(abs(factor), FLOOR_OF_T))
      q = q*ratio
    end do
  end function largest_error

end module fuge_mixture_fit
