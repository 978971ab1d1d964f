!> Chebyshev series on -1 <= t <= 1: coefficients from values and back, derivative, evaluation.
!>
!> A series of degree n is sum_k a_k T_k(t), k = 0 .. n. Its values are at the points
!> t_j = cos(pi j/n), j = 0 .. n, from 1 down to -1, which are among the points of degree 2 n. All
!> procedures are pure; scaling the values by a power of two scales the results exactly.
!> Source: L. N. Trefethen, Approximation Theory and Approximation Practice, 2013,
!> chapters 2 to 4; C. W. Clenshaw, Math. Comp. 9, 1955.
module fuge_chebyshev
  use fuge_constants, only: PI
  use fuge_kinds, only: dp
  implicit none
  private

  public :: chebyshev_points, chebyshev_coefficients, chebyshev_values, chebyshev_derivative, chebyshev_sum, &
    second_kind_sum, second_to_first

contains

  !> sin(pi j/(2 n)), j = 0 .. n, n > 0. From a table for small powers of two: most transforms are short, and sines
  !> would take most of their time.
  pure function quarter_sine(j, n) result(s)
    integer, intent(in) :: j, n
    real(dp) :: s
    integer, parameter :: TABLE = 256
    integer :: k
    real(dp), parameter :: SINES(0:TABLE) = [(sin(0.5_dp*PI*real(k, dp)/real(TABLE, dp)), k=0, TABLE)]

    if (modulo(TABLE, n) == 0) then
      s = SINES(j*(TABLE/n))
    else
      s = sin(0.5_dp*PI*real(j, dp)/real(n, dp))
    end if
  end function quarter_sine

  !> The points cos(pi j/n), j = 0 .. n, exactly symmetric about 0.
  pure function chebyshev_points(n) result(t)
    integer, intent(in) :: n
    real(dp) :: t(0:n)
    integer :: j

    t = 0.0_dp
    t(0) = 1.0_dp
    do j = 1, (n - 1)/2
      t(j) = quarter_sine(n - 2*j, n)
    end do
    do j = 0, (n - 1)/2
      t(n - j) = -t(j)
    end do
  end function chebyshev_points

  !> Coefficients a_0 .. a_n from the values at the n + 1 points, n a power of two.
  pure function chebyshev_coefficients(values) result(a)
    real(dp), intent(in) :: values(0:)
    real(dp) :: a(0:size(values) - 1)
    integer :: n

    n = size(values) - 1
    a = even_transform(values)/real(n, dp)
    a(0) = 0.5_dp*a(0)
    a(n) = 0.5_dp*a(n)
  end function chebyshev_coefficients

  !> Values of a series of degree n or less at the n + 1 points, n a power of two.
  pure function chebyshev_values(a, n) result(values)
    real(dp), intent(in) :: a(0:)
    integer, intent(in) :: n
    real(dp) :: values(0:n)
    real(dp) :: halved(0:n)

    halved = 0.0_dp
    halved(:size(a) - 1) = 0.5_dp*a
    halved(0) = 2.0_dp*halved(0)
    halved(n) = 2.0_dp*halved(n)
    values = even_transform(halved)
  end function chebyshev_values

  !> sum_j v_j cos(pi j k/n) over j = 0 .. 2 n - 1, with v_(2 n - j) = v_j.
  pure function even_transform(v) result(s)
    real(dp), intent(in) :: v(0:)
    real(dp) :: s(0:size(v) - 1)
    complex(dp) :: z(0:2*size(v) - 3)
    integer :: n

    n = size(v) - 1
    z(:n) = cmplx(v, 0.0_dp, dp)
    z(n + 1:) = cmplx(v(n - 1:1:-1), 0.0_dp, dp)
    call transform(z)
    s = real(z(:n), dp)
  end function even_transform

  !> Discrete Fourier transform in place by the algorithm of Cooley and Tukey, the length a power
  !> of two. For few values; `fuge_fft` is for many.
  pure subroutine transform(z)
    complex(dp), intent(inout) :: z(0:)
    complex(dp) :: twiddle(0:size(z)/2 - 1), odd
    integer :: n, span, stride, first, k

    n = size(z)
    do k = 0, n/4
      ! cos and sin of 2 pi k/n, and of pi - 2 pi k/n.
      odd = cmplx(quarter_sine(n - 4*k, n), -quarter_sine(4*k, n), dp)
      twiddle(k) = odd
      if (k > 0) twiddle(n/2 - k) = cmplx(-real(odd, dp), aimag(odd), dp)
    end do
    call reverse_bits(z)
    span = 1
    do while (span < n)
      stride = n/(2*span)
      do first = 0, n - 1, 2*span
        do k = 0, span - 1
          odd = twiddle(k*stride)*z(first + span + k)
          z(first + span + k) = z(first + k) - odd
          z(first + k) = z(first + k) + odd
        end do
      end do
      span = 2*span
    end do
  end subroutine transform

  !> Move each value to the position whose number has the same bits in reverse order.
  pure subroutine reverse_bits(z)
    complex(dp), intent(inout) :: z(0:)
    complex(dp) :: moved
    integer :: k, reversed, bit

    reversed = 0
    do k = 0, size(z) - 1
      if (k < reversed) then
        moved = z(k)
        z(k) = z(reversed)
        z(reversed) = moved
      end if
      ! Add one to the number with reversed bits.
      bit = size(z)/2
      do while (bit > 0 .and. iand(reversed, bit) /= 0)
        reversed = reversed - bit
        bit = bit/2
      end do
      reversed = reversed + bit
    end do
  end subroutine reverse_bits

  !> Coefficients of the derivative, a series of one degree less.
  pure function chebyshev_derivative(a) result(d)
    real(dp), intent(in) :: a(0:)
    real(dp) :: d(0:max(0, size(a) - 2))
    real(dp) :: next, after
    integer :: k

    d = 0.0_dp
    next = 0.0_dp
    after = 0.0_dp
    do k = size(a) - 1, 1, -1
      ! d_(k-1) = d_(k+1) + 2 k a_k
      d(k - 1) = after + 2.0_dp*real(k, dp)*a(k)
      after = next
      next = d(k - 1)
    end do
    d(0) = 0.5_dp*d(0)
  end function chebyshev_derivative

  !> sum_k a_k T_k(t) at each of the points t, by Clenshaw's recurrence.
  pure function chebyshev_sum(a, t) result(values)
    real(dp), intent(in) :: a(0:), t(:)
    real(dp) :: values(size(t))
    real(dp) :: next(size(t)), after(size(t))

    call clenshaw(a, t, next, after)
    values = a(0) + t*next - after
  end function chebyshev_sum

  !> sum_k c_k U_k(t) at each of the points t, with Chebyshev polynomials of the second kind.
  pure function second_kind_sum(c, t) result(values)
    real(dp), intent(in) :: c(0:), t(:)
    real(dp) :: values(size(t))
    real(dp) :: next(size(t)), after(size(t))

    call clenshaw(c, t, next, after)
    values = c(0) + 2.0_dp*t*next - after
  end function second_kind_sum

  !> Clenshaw's recurrence from the last coefficient down: its values for k = 1, `next`, and k = 2,
  !> `after`.
  pure subroutine clenshaw(a, t, next, after)
    real(dp), intent(in) :: a(0:), t(:)
    real(dp), intent(out) :: next(:), after(:)
    real(dp) :: now
    integer :: j, k

    next = 0.0_dp
    after = 0.0_dp
    do k = size(a) - 1, 1, -1
      do j = 1, size(t)
        now = a(k) + 2.0_dp*t(j)*next(j) - after(j)
        after(j) = next(j)
        next(j) = now
      end do
    end do
  end subroutine clenshaw

  !> Coefficients in T_k of the polynomial with the coefficients c in U_k, because
  !> U_k = 2 (T_k + T_(k-2) + ..), where T_0 counts once.
  pure function second_to_first(c) result(a)
    real(dp), intent(in) :: c(0:)
    real(dp) :: a(0:size(c) - 1)
    integer :: k

    a = c
    do k = size(c) - 3, 0, -1
      a(k) = a(k) + a(k + 2)
    end do
    a(1:) = 2.0_dp*a(1:)
  end function second_to_first

end module fuge_chebyshev
