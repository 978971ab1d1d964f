!> Numbers of about 32 digits: unevaluated sums of two doubles.
!>
!> Sums and products follow T. J. Dekker, A floating-point technique for extending the available
!> precision, Numerische Mathematik 18 (1971), but a double is split by its bits, not by a
!> multiplication: processors with a fused multiply-add would spoil the halves.
!> Square roots of arrays are here and not where they are used, because compilers
!> vectorise only what they can inline.
module fuge_double_double
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_kinds, only: dp
  implicit none
  private

  public :: exact_difference, exact_product, exact_sum, inverse_roots, squared_distances
  public :: operator(+), operator(-), operator(*), operator(/), log, sqrt

  !> The number high + low, with low at most half a rounding unit of high.
  type, public :: double_double
    real(dp) :: high = 0.0_dp
    real(dp) :: low = 0.0_dp
  end type double_double

  interface operator(+)
    module procedure plus
  end interface operator(+)

  interface operator(-)
    module procedure minus
  end interface operator(-)

  interface operator(*)
    module procedure times
    module procedure times_double
  end interface operator(*)

  interface operator(/)
    module procedure over
  end interface operator(/)

  !> The natural logarithm of a number >= 1 and below 2**1023.
  interface log
    module procedure logarithm
  end interface log

  !> The square root of a number >= 0.
  interface sqrt
    module procedure root
  end interface sqrt

  !> Keeps the upper 26 of the 53 bits of a double.
  integer(int64), parameter :: UPPER_BITS = not(2_int64**27 - 1_int64)

  !> ln(k/32), k = 32 .. 64, rounded from 40 digits.
  real(dp), parameter :: LOG_HIGH(32:64) = [ &
    0.0_dp, 0.030771658666753687_dp, 0.06062462181643484_dp, 0.08961215868968714_dp, &
    0.11778303565638346_dp, 0.1451820098444979_dp, 0.17185025692665923_dp, 0.19782574332991987_dp, &
    0.22314355131420976_dp, 0.24783616390458127_dp, 0.27193371548364176_dp, 0.2954642128938359_dp, &
    0.3184537311185346_dp, 0.3409265869705932_dp, 0.3629054936893685_dp, 0.38441169891033206_dp, &
    0.4054651081081644_dp, 0.4260843953109001_dp, 0.44628710262841953_dp, 0.46608972992459924_dp, &
    0.4855078157817008_dp, 0.5045560107523953_dp, 0.5232481437645479_dp, 0.5415972824327444_dp, &
    0.5596157879354227_dp, 0.5773153650348236_dp, 0.5947071077466928_dp, 0.6118015411059929_dp, &
    0.6286086594223741_dp, 0.6451379613735847_dp, 0.661398482245365_dp, 0.6773988235918061_dp, &
    0.6931471805599453_dp]
  real(dp), parameter :: LOG_LOW(32:64) = [ &
    0.0_dp, 1.0431732029005968e-18_dp, 2.6424025938726934e-18_dp, -5.4268129336647135e-18_dp, &
    -1.1971685747593677e-18_dp, 8.242418783022475e-18_dp, -6.0224538210113705e-18_dp, 1.2821194372980142e-17_dp, &
    -9.091270597324799e-18_dp, -1.2432209578702523e-17_dp, 7.83319637697442e-19_dp, -2.16461086040599e-17_dp, &
    2.7114779367326236e-17_dp, 1.7467136443544747e-17_dp, -2.1492361455310972e-17_dp, -1.612149700764673e-17_dp, &
    -2.8811380259626426e-18_dp, -2.499176776547466e-17_dp, -1.8182541194649598e-17_dp, -1.4116523239904406e-17_dp, &
    -1.6618350693852048e-17_dp, -2.4888518873597905e-17_dp, -3.1833882216350925e-17_dp, -3.748764246125639e-17_dp, &
    2.685492580212308e-17_dp, -8.903591846974013e-18_dp, 1.3751689964323675e-17_dp, -3.7397759448726e-17_dp, &
    4.3538742607970387e-17_dp, 9.346960920120906e-19_dp, -7.603333785634003e-18_dp, -2.0978183882652005e-18_dp, &
    2.3190468138462996e-17_dp]

contains

  !> a + b without rounding.
  elemental function two_sum(a, b) result(total)
    real(dp), intent(in) :: a, b
    type(double_double) :: total
    real(dp) :: part

    total%high = a + b
    part = total%high - a
    total%low = (a - (total%high - part)) + (b - part)
  end function two_sum

  !> a b without rounding, except for the last bit of the 106; the lower part may be a unit of the upper one.
  !>
  !> Only products of halves are formed, which have no rounding error, except the last one. So it makes no difference
  !> whether a compiler contracts a product and a sum to one operation.
  elemental function two_product(a, b) result(value)
    real(dp), intent(in) :: a, b
    type(double_double) :: value, cross
    real(dp) :: a_low, a_high, b_low, b_high

    a_high = upper_half(a)
    a_low = a - a_high
    b_high = upper_half(b)
    b_low = b - b_high
    cross = two_sum(a_high*b_low, a_low*b_high)
    value = normalised(a_high*b_high, cross%high)
    value%low = value%low + (cross%low + a_low*b_low)
  end function two_product

  !> a**2, likewise.
  elemental function two_square(a) result(square)
    real(dp), intent(in) :: a
    type(double_double) :: square
    real(dp) :: low, high

    high = upper_half(a)
    low = a - high
    square = normalised(high*high, 2.0_dp*(high*low))
    square%low = square%low + low*low
  end function two_square

  elemental function upper_half(a) result(upper)
    real(dp), intent(in) :: a
    real(dp) :: upper

    upper = transfer(iand(transfer(a, 0_int64), UPPER_BITS), upper)
  end function upper_half

  !> a + b, where |a| >= |b| or a is zero.
  elemental function normalised(a, b) result(total)
    real(dp), intent(in) :: a, b
    type(double_double) :: total

    total%high = a + b
    total%low = b - (total%high - a)
  end function normalised

  !> a + b, with an error of a few 2**-106 of |a| + |b|.
  elemental function add(a, b) result(total)
    type(double_double), intent(in) :: a, b
    type(double_double) :: total

    total = two_sum(a%high, b%high)
    total = normalised(total%high, total%low + (a%low + b%low))
  end function add

  elemental function subtract(a, b) result(difference)
    type(double_double), intent(in) :: a, b
    type(double_double) :: difference

    difference = add(a, double_double(-b%high, -b%low))
  end function subtract

  elemental function multiply(a, b) result(value)
    type(double_double), intent(in) :: a, b
    type(double_double) :: value

    value = two_product(a%high, b%high)
    value = normalised(value%high, value%low + (a%high*b%low + a%low*b%high))
  end function multiply

  elemental function multiply_by_double(a, b) result(value)
    type(double_double), intent(in) :: a
    real(dp), intent(in) :: b
    type(double_double) :: value

    value = two_product(a%high, b)
    value = normalised(value%high, value%low + a%low*b)
  end function multiply_by_double

  elemental function divide(a, b) result(quotient)
    type(double_double), intent(in) :: a, b
    type(double_double) :: quotient, rest

    quotient%high = a%high/b%high
    rest = subtract(a, multiply_by_double(b, quotient%high))
    quotient = normalised(quotient%high, rest%high/b%high)
  end function divide

  elemental function root(a) result(r)
    type(double_double), intent(in) :: a
    type(double_double) :: r, rest
    real(dp) :: first

    r = double_double(0.0_dp, 0.0_dp)
    if (.not. a%high > 0.0_dp) return
    first = sqrt(a%high)
    rest = subtract(a, two_square(first))
    r = normalised(first, 0.5_dp*rest%high/first)
  end function root

  !> By the table, ln(m) = ln(c) + 2 artanh((m - c)/(m + c)) with the mantissa m in [1, 2) and c
  !> its nearest multiple of 1/32.
  elemental function logarithm(a) result(value)
    type(double_double), intent(in) :: a
    type(double_double) :: value, mantissa, u
    real(dp) :: c, unit
    integer :: power, k

    ! By the bits of the exponent, because the intrinsics may be calls.
    power = int(ishft(transfer(a%high, 0_int64), -52)) - 1023
    unit = transfer(ishft(int(1023 - power, int64), 52), unit)
    mantissa = double_double(a%high*unit, a%low*unit)
    k = int(32.0_dp*mantissa%high + 0.5_dp)
    c = real(k, dp)/32.0_dp
    u = divide(add(mantissa, double_double(-c, 0.0_dp)), add(mantissa, double_double(c, 0.0_dp)))
    value = add(double_double(LOG_HIGH(k), LOG_LOW(k)), twice_artanh(u))
    if (power /= 0) value = add(value, multiply_by_double(double_double(LOG_HIGH(64), LOG_LOW(64)), real(power, dp)))
  end function logarithm

  !> 2 artanh(u), |u| <= 1/128, by its series in u squared, whose first terms need both doubles.
  elemental function twice_artanh(u) result(value)
    type(double_double), intent(in) :: u
    type(double_double) :: value, square
    real(dp) :: q

    square = multiply(u, u)
    q = square%high
    q = q*(1.0_dp/7.0_dp + q*(1.0_dp/9.0_dp + q*(1.0_dp/11.0_dp + q*(1.0_dp/13.0_dp + q/15.0_dp))))
    value = add(double_double(0.2_dp, -1.1102230246251566e-17_dp), double_double(q, 0.0_dp))
    value = add(double_double(0.3333333333333333_dp, 1.850371707708594e-17_dp), multiply(square, value))
    value = add(double_double(2.0_dp, 0.0_dp), multiply_by_double(multiply(square, value), 2.0_dp))
    value = multiply(u, value)
  end function twice_artanh

  ! The procedures above are private, and these call them, because a compiler may not inline a public
  ! procedure of a shared library.

  !> a + b without rounding.
  elemental function exact_sum(a, b) result(total)
    real(dp), intent(in) :: a
    real(dp), intent(in) :: b
    type(double_double) :: total

    total = two_sum(a, b)
  end function exact_sum

  !> a - b without rounding.
  elemental function exact_difference(a, b) result(difference)
    real(dp), intent(in) :: a
    real(dp), intent(in) :: b
    type(double_double) :: difference

    difference = two_sum(a, -b)
  end function exact_difference

  !> a b without rounding, except for the last bit of the 106.
  elemental function exact_product(a, b) result(value)
    real(dp), intent(in) :: a
    real(dp), intent(in) :: b
    type(double_double) :: value

    value = two_product(a, b)
    value = normalised(value%high, value%low)
  end function exact_product

  elemental function plus(a, b) result(total)
    type(double_double), intent(in) :: a
    type(double_double), intent(in) :: b
    type(double_double) :: total

    total = add(a, b)
  end function plus

  elemental function minus(a, b) result(difference)
    type(double_double), intent(in) :: a
    type(double_double), intent(in) :: b
    type(double_double) :: difference

    difference = subtract(a, b)
  end function minus

  elemental function times(a, b) result(value)
    type(double_double), intent(in) :: a
    type(double_double), intent(in) :: b
    type(double_double) :: value

    value = multiply(a, b)
  end function times

  elemental function times_double(a, b) result(value)
    type(double_double), intent(in) :: a
    real(dp), intent(in) :: b
    type(double_double) :: value

    value = multiply_by_double(a, b)
  end function times_double

  elemental function over(a, b) result(quotient)
    type(double_double), intent(in) :: a
    type(double_double), intent(in) :: b
    type(double_double) :: quotient

    quotient = divide(a, b)
  end function over

  !> x**2 + y**2 of offsets x = `x_high` + `x_low`, and y likewise, as `high` + `low`. All arrays have one length.
  pure subroutine squared_distances(x_high, x_low, y_high, y_low, high, low)
    real(dp), intent(in), contiguous :: x_high(:), x_low(:), y_high(:), y_low(:)
    real(dp), intent(out), contiguous :: high(:), low(:)
    type(double_double) :: x_square, y_square, total
    integer :: k

    do k = 1, size(high)
      x_square = two_square(x_high(k))
      y_square = two_square(y_high(k))
      total = two_sum(x_square%high, y_square%high)
      high(k) = total%high
      low(k) = total%low + ((x_square%low + y_square%low) + 2.0_dp*(x_high(k)*x_low(k) + y_high(k)*y_low(k)))
    end do
  end subroutine squared_distances

  !> factor/sqrt(a) of a = `high` + `low` > 0, as `root_high` + `root_low`, to about 30 digits. All arrays have one
  !> length.
  pure subroutine inverse_roots(factor, high, low, root_high, root_low)
    type(double_double), intent(in) :: factor
    real(dp), intent(in), contiguous :: high(:), low(:)
    real(dp), intent(out), contiguous :: root_high(:), root_low(:)
    type(double_double) :: square, one, scaled
    real(dp) :: guess, defect
    integer :: k

    do k = 1, size(high)
      guess = 1.0_dp/sqrt(high(k))
      ! One step of Newton's method, with the defect 1 - guess**2 a from exact products.
      square = two_square(guess)
      one = two_product(square%high, high(k))
      defect = (((1.0_dp - one%high) - one%low) - square%low*high(k)) - square%high*low(k)
      scaled = two_product(factor%high, guess)
      root_high(k) = scaled%high
      root_low(k) = scaled%low + (scaled%high*(0.5_dp*defect) + factor%low*guess)
    end do
  end subroutine inverse_roots

end module fuge_double_double
