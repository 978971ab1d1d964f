!> Stresses and displacements in a half-plane under the pressure sqrt(1 - t**2) sum_k c_k U_k(t) of a smooth punch, in
!> closed form.
!>
!> Source: the Cauchy transform of the pressure, f = pi sum_k c_k omega**(k+1) with omega = tau - sqrt(tau**2 - 1),
!> |omega| <= 1 (F. G. Tricomi, Integral Equations, 1957, section 4.3), in the potentials of K. L. Johnson, Contact
!> Mechanics, 1985, section 2.4: zz, xx = (Im f -+ z Re f')/pi, xz = -(z/pi) Im f'. With tau = cosh(m + i h), confocal
!> ellipses m and hyperbolas h about the ends, omega**n has the parts exp(-n m) T_n(cos h) and -exp(-n m) sin(h)
!> U_(n-1)(cos h), and the powers of sin(h) by which zz and xz vanish at the surface beside the contact come out as
!> factors.
module fuge_smooth_field
  use fuge_constants, only: PI
  use fuge_kinds, only: dp
  implicit none
  private

  public :: locate, smooth_displacement_integrals, smooth_stresses

  !> A point in confocal coordinates; sin(h) and sinh(m) accurate relative to themselves.
  type, public :: confocal_point
    real(dp) :: sin_h = 0.0_dp, cos_h = 1.0_dp, sinh_m = 0.0_dp, cosh_m = 1.0_dp
    !> exp(-m)
    real(dp) :: radius = 1.0_dp
    !> Shares of sinh(m)**2 and sin(h)**2 in their sum, |tau**2 - 1|.
    real(dp) :: outer = 0.0_dp, inner = 1.0_dp
  end type confocal_point

contains

  !> The coordinates of a point at the depth z whose distances from the ends, along the surface, are `left` and `right`,
  !> all in half widths; `left` - `right` is 2.
  pure function locate(left, right, z) result(point)
    real(dp), intent(in) :: left, right, z
    type(confocal_point) :: point
    real(dp) :: from_left, from_right, total, difference

    from_left = hypot(left, z)
    from_right = hypot(right, z)
    total = from_left*from_right
    difference = left*right + z**2
    ! sinh(m)**2 + sin(h)**2 and sinh(m)**2 - sin(h)**2 are these two, and sinh(m) sin(h) = z.
    if (difference >= 0.0_dp) then
      point%sinh_m = sqrt(0.5_dp*(total + difference))
      if (point%sinh_m > 0.0_dp) point%sin_h = min(1.0_dp, z/point%sinh_m)
    else
      point%sin_h = min(1.0_dp, sqrt(0.5_dp*(total - difference)))
      point%sinh_m = z/point%sin_h
    end if
    point%cosh_m = 0.5_dp*(from_left + from_right)
    point%cos_h = max(-1.0_dp, min(1.0_dp, 0.5_dp*(left + right)/point%cosh_m))
    point%radius = 1.0_dp/(point%cosh_m + point%sinh_m)
    if (.not. total > 0.0_dp) return
    point%outer = point%sinh_m*(point%sinh_m/total)
    point%inner = point%sin_h*(point%sin_h/total)
  end function locate

  !> Stresses xx, zz, xz under the coefficients `c`.
  !>
  !> Each term is accurate relative to itself.
  pure function smooth_stresses(c, point) result(stress)
    real(dp), intent(in) :: c(:)
    type(confocal_point), intent(in) :: point
    real(dp) :: stress(3)
    real(dp) :: factor, power, sums(3), square, steepness
    ! T_n; U_(n-1), U_n and the derivative of U_(n-1), with those before and after.
    real(dp) :: first, first_next, second, second_next, slope, slope_next, swap
    integer :: n

    square = point%sin_h**2*point%outer
    steepness = point%inner*point%sinh_m*point%cosh_m
    sums = 0.0_dp
    power = 1.0_dp
    first = point%cos_h
    second = 1.0_dp
    second_next = 2.0_dp*point%cos_h
    slope = 0.0_dp
    slope_next = 2.0_dp
    do n = 1, size(c)
      power = power*point%radius
      first_next = point%cos_h*first - point%sin_h**2*second
      factor = c(n)*power
      ! Far below the contact only the first term counts, and U_0 + T_2 would cancel.
      swap = 2.0_dp*point%cos_h**2
      if (n > 1) swap = second + real(n, dp)*first_next
      sums(1) = sums(1) + factor*(point%outer*swap &
                                  + point%inner*second*(1.0_dp - real(n, dp)*point%sinh_m*point%radius))
      sums(2) = sums(2) + factor*(square*point%cos_h*slope &
                                  + second*(point%inner + square + real(n, dp)*steepness))
      sums(3) = sums(3) + factor*real(n, dp)*(point%sinh_m*second_next + point%radius*first)
      first = first_next
      swap = 2.0_dp*point%cos_h*slope_next + 2.0_dp*second_next - slope
      slope = slope_next
      slope_next = swap
      swap = 2.0_dp*point%cos_h*second_next - second
      second = second_next
      second_next = swap
    end do
    stress(:2) = -point%sin_h*sums(:2)
    stress(3) = -(point%sinh_m*point%inner)*sums(3)
  end function smooth_stresses

  !> The integrals of ln(r/D), z**2/r**2, x z/r**2 and atan(x/z) over the pressure, in half widths; `log_datum` is
  !> that of D in half widths.
  pure function smooth_displacement_integrals(c, point, z, log_datum) result(integral)
    real(dp), intent(in) :: c(:), z, log_datum
    type(confocal_point), intent(in) :: point
    real(dp) :: integral(4)
    real(dp) :: powers(2, 0:2), sums(2), potential(2)
    integer :: n

    ! Real and imaginary part of omega**(n-1), omega**n and omega**(n+1).
    powers(:, 0) = [1.0_dp, 0.0_dp]
    powers(:, 1) = point%radius*[point%cos_h, -point%sin_h]
    sums = 0.0_dp
    potential = 0.0_dp
    do n = 1, size(c)
      powers(:, 2) = multiply(powers(:, 1), point%radius*[point%cos_h, -point%sin_h])
      sums = sums + c(n)*powers(:, 1)
      potential = potential + c(n)*powers(:, 2)/real(n + 1, dp)
      if (n > 1) potential = potential - c(n)*powers(:, 0)/real(n - 1, dp)
      powers(:, 0) = powers(:, 1)
      powers(:, 1) = powers(:, 2)
    end do
    integral(1) = 0.5_dp*PI*(potential(1) + c(1)*(asinh(point%sinh_m) - log(2.0_dp) - log_datum))
    integral(2) = -PI*z*sums(2)
    integral(3) = PI*z*sums(1)
    integral(4) = 0.5_dp*PI*(c(1)*atan2(point%cos_h, point%sin_h) - potential(2))
  end function smooth_displacement_integrals

  !> The product of two complex numbers, given by their parts.
  pure function multiply(a, b) result(product)
    real(dp), intent(in) :: a(2), b(2)
    real(dp) :: product(2)

    product = [a(1)*b(1) - a(2)*b(2), a(1)*b(2) + a(2)*b(1)]
  end function multiply

end module fuge_smooth_field
