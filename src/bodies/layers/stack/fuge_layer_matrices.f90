!> What an elastic layer does to waves of displacement and traction, without a number that grows or cancels.
!>
!> In plane strain, at the depth z, a wave q has the displacements u = [u_x, u_z] and the tractions
!> s = -[sigma_xz, sigma_zz]/(2 G q), of which those along x are a quarter of a wave ahead. For one layer
!>
!>     u(top) = F u(bottom) + G s(top),   s(bottom) = F^T s(top) - H u(bottom)
!>
!> G is the compliance of the layer on a rigid base, H the stiffness against a displacement of its bottom under a free
!> top. Both are positive definite, so that layers are joined by sums of such matrices (`joined`, `rest_on`): whatever
!> their thickness and however much softer one is than the other, nothing cancels. A thick layer has F = 0.
!>
!> The equations of equilibrium make (u, s) the solution of y' = A y with (A^2 - 1)^2 = 0, so that exp(-A q h), whose
!> blocks give F, G and H, is a polynomial of the third degree in A; doc/theory_layers.md has it.
module fuge_layer_matrices
  use fuge_kinds, only: dp
  implicit none
  private

  public :: carried_down, half_space_compliance, joined, layer_of, rest_on, slid_down, slide_on

  !> Below this thickness in wavelengths over 2 pi, differences of nearly equal functions are summed as series.
  real(dp), parameter :: THIN = 0.5_dp
  !> Terms of these series: the rest is less than rounding.
  integer, parameter :: TERMS = 12
  !> From this thickness on, F is less than the least number.
  real(dp), parameter :: THICK = 800.0_dp

  !> F, and the symmetric G and H as [xx, xz, zz].
  type, public :: layer_matrices
    real(dp) :: transmission(2, 2) = 0.0_dp, compliance(3) = 0.0_dp, stiffness(3) = 0.0_dp
  end type layer_matrices

contains

  !> The compliance of a half-space of Poisson's ratio `poisson`, s of its own shear modulus: [xx, xz, zz].
  pure function half_space_compliance(poisson) result(compliance)
    real(dp), intent(in) :: poisson
    real(dp) :: compliance(3)

    compliance = [2.0_dp*(1.0_dp - poisson), -(1.0_dp - 2.0_dp*poisson), 2.0_dp*(1.0_dp - poisson)]
  end function half_space_compliance

  !> The matrices of a layer `t` = q h thick.
  pure function layer_of(t, poisson) result(layer)
    real(dp), intent(in) :: t, poisson
    type(layer_matrices) :: layer
    real(dp) :: c, decay, det, e, f, g, linear, p, r, s, sc, sc_less_t, thickness

    ! All products of hyperbolic functions are multiplied by exp(-2 t), single ones by exp(-t).
    thickness = min(t, THICK)
    decay = exp(-thickness)
    c = 0.5_dp*(1.0_dp + decay**2)
    if (thickness < THIN) then
      s = sinh(thickness)*decay
      sc_less_t = 0.5_dp*odd_series(2.0_dp*thickness)*decay**2
      r = cosine_series(thickness)*decay
    else
      s = 0.5_dp*(1.0_dp - decay**2)
      sc_less_t = s*c - thickness*decay**2
      r = thickness*c - s
    end if
    sc = s*c
    linear = thickness*decay**2
    e = 1.0_dp/(1.0_dp - poisson)
    r = 0.5_dp*e*r
    p = 0.5_dp*e*thickness*s
    det = (2.0_dp*(1.0_dp - poisson)*decay)**2 + (3.0_dp - 4.0_dp*poisson)*s**2 + (thickness*decay)**2
    f = 2.0_dp*(1.0_dp - poisson)/det
    layer%compliance(1) = f*((3.0_dp - 4.0_dp*poisson)*sc + linear)
    layer%compliance(2) = ((thickness*decay)**2 - (3.0_dp - 4.0_dp*poisson)*(1.0_dp - 2.0_dp*poisson)*s**2)/det
    layer%compliance(3) = f*(2.0_dp*(1.0_dp - 2.0_dp*poisson)*sc + sc_less_t)
    layer%stiffness(1) = f*(sc + linear)
    layer%stiffness(2) = -((thickness*decay)**2 + (1.0_dp - 2.0_dp*poisson)*s**2)/det
    layer%stiffness(3) = f*sc_less_t
    g = (2.0_dp*(1.0_dp - poisson))**2*decay/det
    layer%transmission(1, :) = g*[c - p, -(s + r)]
    layer%transmission(2, :) = g*[(e - 1.0_dp)*s + r, c + p]
  end function layer_of

  !> sinh t - t.
  pure function odd_series(t) result(total)
    real(dp), intent(in) :: t
    real(dp) :: total, term
    integer :: k

    total = 0.0_dp
    term = t
    do k = 1, TERMS
      term = term*t**2/real(2*k*(2*k + 1), dp)
      total = total + term
    end do
  end function odd_series

  !> t cosh t - sinh t.
  pure function cosine_series(t) result(total)
    real(dp), intent(in) :: t
    real(dp) :: total, term
    integer :: k

    total = 0.0_dp
    term = t
    do k = 1, TERMS
      term = term*t**2/real(2*k*(2*k + 1), dp)
      total = total + real(2*k, dp)*term
    end do
  end function cosine_series

  !> Two layers that are bonded as one.
  pure function joined(upper, lower) result(both)
    type(layer_matrices), intent(in) :: upper, lower
    type(layer_matrices) :: both
    real(dp) :: inverse(2, 2)

    ! (1 + G H)^-1, of the compliance of the lower layer and the stiffness of the upper one.
    associate (g => lower%compliance, h => upper%stiffness)
      inverse(1, 1) = 1.0_dp + g(2)*h(2) + g(3)*h(3)
      inverse(2, 2) = 1.0_dp + g(1)*h(1) + g(2)*h(2)
      inverse(1, 2) = -(g(1)*h(2) + g(2)*h(3))
      inverse(2, 1) = -(g(2)*h(1) + g(3)*h(2))
      inverse = inverse/joint_determinant(g, h)
    end associate
    both%transmission = product_of(upper%transmission, product_of(inverse, lower%transmission))
    both%compliance = upper%compliance + transmitted(upper%transmission, in_series(lower%compliance, upper%stiffness))
    both%stiffness = lower%stiffness &
                     + transmitted(transpose(lower%transmission), in_series(upper%stiffness, lower%compliance))
  end function joined

  !> The compliance at the top of a layer bonded to a body of the compliance `below`, all of the layer's shear modulus:
  !> G + F (1 + C H)^-1 C F^T.
  pure function rest_on(layer, below) result(compliance)
    type(layer_matrices), intent(in) :: layer
    real(dp), intent(in) :: below(3)
    real(dp) :: compliance(3)

    compliance = layer%compliance + transmitted(layer%transmission, in_series(below, layer%stiffness))
  end function rest_on

  !> (1 + A B)^-1 A of two symmetric matrices, of which neither has to have an inverse: (A^-1 + B)^-1.
  pure function in_series(a, b) result(series)
    real(dp), intent(in) :: a(3), b(3)
    real(dp) :: series(3)

    series = (a + (a(1)*a(3) - a(2)**2)*[b(3), -b(2), b(1)])/joint_determinant(a, b)
  end function in_series

  !> The determinant of 1 + A B.
  pure function joint_determinant(a, b) result(determinant)
    real(dp), intent(in) :: a(3), b(3)
    real(dp) :: determinant

    determinant = 1.0_dp + (a(1)*b(1) + 2.0_dp*a(2)*b(2) + a(3)*b(3)) + (a(1)*a(3) - a(2)**2)*(b(1)*b(3) - b(2)**2)
  end function joint_determinant

  !> As `rest_on`, where the layer slides on the body without friction; `below` is its compliance under pressure, zz.
  pure function slide_on(layer, below) result(compliance)
    type(layer_matrices), intent(in) :: layer
    real(dp), intent(in) :: below
    real(dp) :: compliance(3)
    real(dp) :: det, free(3)

    ! (H + diag(0, 1/below))^-1.
    associate (h => layer%stiffness)
      det = h(1) + below*(h(1)*h(3) - h(2)**2)
      free = [1.0_dp + below*h(3), -below*h(2), below*h(1)]/det
    end associate
    compliance = layer%compliance + transmitted(layer%transmission, free)
  end function slide_on

  !> From the `traction` at the top of a layer, [x, z], to that and the `displacement` at its bottom, bonded to a body
  !> of the compliance `below`.
  pure subroutine carried_down(layer, below, displacement, traction)
    type(layer_matrices), intent(in) :: layer
    real(dp), intent(in) :: below(3)
    real(dp), intent(out) :: displacement(2)
    real(dp), intent(inout) :: traction(2)
    real(dp) :: f(2)

    f = transposed_times(layer%transmission, traction)
    ! (1 + H C)^-1 f.
    associate (c => below, h => layer%stiffness)
      traction(1) = (1.0_dp + h(2)*c(2) + h(3)*c(3))*f(1) - (h(1)*c(2) + h(2)*c(3))*f(2)
      traction(2) = (1.0_dp + h(1)*c(1) + h(2)*c(2))*f(2) - (h(2)*c(1) + h(3)*c(2))*f(1)
      traction = traction/joint_determinant(h, c)
      displacement = [c(1)*traction(1) + c(2)*traction(2), c(2)*traction(1) + c(3)*traction(2)]
    end associate
  end subroutine carried_down

  !> As `carried_down`, where the layer slides on a body of the compliance `below` under pressure: the displacement of
  !> the layer.
  pure subroutine slid_down(layer, below, displacement, traction)
    type(layer_matrices), intent(in) :: layer
    real(dp), intent(in) :: below
    real(dp), intent(out) :: displacement(2)
    real(dp), intent(inout) :: traction(2)
    real(dp) :: f(2)

    f = transposed_times(layer%transmission, traction)
    associate (h => layer%stiffness)
      traction = [0.0_dp, (h(1)*f(2) - h(2)*f(1))/(h(1) + below*(h(1)*h(3) - h(2)**2))]
      displacement(2) = below*traction(2)
      displacement(1) = (f(1) - h(2)*displacement(2))/h(1)
    end associate
  end subroutine slid_down

  !> A B: the compiler's `matmul` takes memory that nobody checks, and time for that.
  pure function product_of(a, b) result(product)
    real(dp), intent(in) :: a(2, 2), b(2, 2)
    real(dp) :: product(2, 2)
    integer :: k

    do k = 1, 2
      product(:, k) = a(:, 1)*b(1, k) + a(:, 2)*b(2, k)
    end do
  end function product_of

  !> A^T x.
  pure function transposed_times(a, x) result(product)
    real(dp), intent(in) :: a(2, 2), x(2)
    real(dp) :: product(2)

    product = a(1, :)*x(1) + a(2, :)*x(2)
  end function transposed_times

  !> F M F^T, of a symmetric M.
  pure function transmitted(f, m) result(product)
    real(dp), intent(in) :: f(2, 2), m(3)
    real(dp) :: product(3)
    real(dp) :: x(2), z(2)

    x = f(1, :)
    z = f(2, :)
    product = [quadratic(x, m, x), quadratic(x, m, z), quadratic(z, m, z)]
  end function transmitted

  !> a^T M b, of a symmetric M.
  pure function quadratic(a, m, b) result(value)
    real(dp), intent(in) :: a(2), m(3), b(2)
    real(dp) :: value

    value = a(1)*(m(1)*b(1) + m(2)*b(2)) + a(2)*(m(2)*b(1) + m(3)*b(2))
  end function quadratic

end module fuge_layer_matrices
