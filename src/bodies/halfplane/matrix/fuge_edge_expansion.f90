!> The pressure near an edge of contact on a half-plane, from the forces of the cells next to it.
!>
!> Let the cells from an edge inwards be j = 0, 1, .. For a smooth gap their forces f_j satisfy, apart
!> from the influence of the far edge, a Toeplitz system on the half-line. Its symbol has a
!> Wiener-Hopf factorisation (M. G. Krein, Amer. Math. Soc. Transl. 22, 1962), and the
!> convolution of f with the coefficients of one factor is a polynomial in j. Four cells give
!> the coefficients of the polynomial, and these the pressure at a distance s from the
!> *effective edge*, where s = (j + `ORIGIN`) h. See doc/theory.md, "Edges of the contact".
!>
!> Three more cells tell how far the forces depart from a polynomial: whatever its degree, its differences fall off
!> with their order for a smooth gap and exact forces, and those that errors of the forces leave do not.
module fuge_edge_expansion
  use fuge_cell_elements, only: FUGE_CENTRE, FUGE_HAT
  use fuge_constants, only: PI
  use fuge_kinds, only: dp
  implicit none
  private

  public :: effective_edge, pressure_expansion, shift_error

  !> The expansion is computed from CELLS cells, its error from up to JUDGED cells.
  integer, parameter, public :: CELLS = 4, JUDGED = 7

  !> First coefficients of the Wiener-Hopf factor, for FUGE_CENTRE and for the other two
  !> elements, which have the same matrix; and the distance of the centre of cell 0 from the
  !> effective edge, in cells. Computed from the symbols by quadrature, which
  !> test_edge_expansion repeats; public for that test.
  real(dp), parameter, public :: FACTOR(JUDGED, 2) = reshape([ &
    1.0_dp, 0.5740070068596145_dp, 0.4143161456561956_dp, 0.3418239079354555_dp, 0.2977660404782948_dp, &
    0.2673225715310548_dp, 0.2446578452653248_dp, &
    1.0_dp, 0.6514640003861043_dp, 0.4519323409169976_dp, 0.3701790118360726_dp, 0.3214493546395725_dp, &
    0.2880708261418182_dp, 0.2633451363961516_dp], [JUDGED, 2])
  real(dp), parameter, public :: ORIGIN(2) = [0.32534677144_dp, 0.38494788139_dp]

  !> Shift of an edge, in cells, by errors of the forces, over the highest differences that these leave (which in turn
  !> count in units of a2, about the first difference); and by the finite width, over the third one. From the tests.
  real(dp), parameter :: BY_FORCES = 30.0_dp, BY_WIDTH = 0.25_dp

  !> Where the largest force of the contact is 1, an L below this is rounding.
  real(dp), parameter, public :: SMALLEST_L = sqrt(epsilon(1.0_dp))

  !> Coefficients D, K, L and M of the pressure near an effective edge, with h = 1.
  type, public :: edge_expansion
    real(dp) :: d = 0.0_dp, k = 0.0_dp, l = 0.0_dp, m = 0.0_dp
  end type edge_expansion

contains

  !> From the edge of the last cell outwards to the effective edge, in cells.
  pure function effective_edge(element) result(outward)
    integer, intent(in) :: element
    real(dp) :: outward

    outward = ORIGIN(element_column(element)) - 0.5_dp
  end function effective_edge

  !> Estimate of the error of an edge, in cells, from the forces of its first CELLS + 1 .. JUDGED cells, relative to the
  !> largest of the contact; `edge` their expansion. 1 if L is not positive, or rounding: no edge of a smooth contact.
  !>
  !> An error of the forces which falls off like 1/(j + 1) from the edge, as conjugate gradients leave it, has
  !> differences of nearly the same size in all orders; extrapolated to j = -1, as K is, they add up.
  pure function shift_error(force, element, edge) result(error)
    real(dp), intent(in) :: force(:)
    integer, intent(in) :: element
    type(edge_expansion), intent(in) :: edge
    real(dp) :: error
    real(dp) :: difference(size(force))
    integer :: n

    error = 1.0_dp
    if (edge%l <= SMALLEST_L) return
    n = size(force)
    difference = forward_differences(series_product(force, FACTOR(:n, element_column(element))))
    error = (BY_FORCES*maxval(abs(difference(n - 1:))) + BY_WIDTH*abs(difference(4)))/(0.5_dp*sqrt(PI)*edge%l)
  end function shift_error

  !> The column of `FACTOR` for an element.
  pure function element_column(element)
    integer, intent(in) :: element
    integer :: element_column

    element_column = 2
    if (element == FUGE_CENTRE) element_column = 1
  end function element_column

  !> The pressure near an edge, from the forces of the first cells there.
  !>
  !> With z = exp(-zeta) the factor behaves like zeta^(-1/2) (1 + factor_bend zeta^2/2), and a_k is the
  !> coefficient of zeta^-k in the generating function of the polynomial, sum_k b_k (1 - z)^-k;
  !> `ORIGIN` accounts for exp(zeta/2). zeta^(1/2 - k) stands for s^(k - 3/2)/Gamma(k - 1/2). The
  !> force of a cell is p - curvature p''.
  pure function pressure_expansion(force, element) result(edge)
    real(dp), intent(in) :: force(CELLS)
    integer, intent(in) :: element
    type(edge_expansion) :: edge
    real(dp) :: b(CELLS), a(0:3), factor_bend, curvature

    b = newton_coefficients(series_product(force, FACTOR(:CELLS, element_column(element))))
    a(0) = (b(2) + b(3))/24.0_dp
    a(1) = b(1) + b(2)/2.0_dp + 3.0_dp*b(3)/8.0_dp + 5.0_dp*b(4)/16.0_dp
    a(2) = b(2) + b(3) + 23.0_dp*b(4)/24.0_dp
    a(3) = b(3) + 1.5_dp*b(4)

    factor_bend = 1.0_dp/12.0_dp
    if (element == FUGE_CENTRE) factor_bend = 1.0_dp/24.0_dp
    curvature = 1.0_dp/24.0_dp
    if (element == FUGE_HAT) curvature = 1.0_dp/12.0_dp
    a(0:1) = a(0:1) + (curvature - 0.5_dp*factor_bend)*a(2:3)

    edge%d = -a(0)/(2.0_dp*sqrt(PI))
    edge%k = a(1)/sqrt(PI)
    edge%l = 2.0_dp*a(2)/sqrt(PI)
    edge%m = 4.0_dp*a(3)/(3.0_dp*sqrt(PI))
  end function pressure_expansion

  !> Product of two power series, to the order of `f`.
  pure function series_product(f, g) result(product)
    real(dp), intent(in) :: f(:), g(:)
    real(dp) :: product(size(f))
    integer :: j

    do j = 1, size(f)
      product(j) = dot_product(f(:j), g(j:1:-1))
    end do
  end function series_product

  !> Coefficients b_k of q(j) = sum_k b_k binomial(j + k - 1, k - 1), from q(0), q(1), ..:
  !> Newton's backward differences of the polynomial at j = -1.
  pure function newton_coefficients(q) result(b)
    real(dp), intent(in) :: q(:)
    real(dp) :: b(size(q))
    integer :: j, k

    b = forward_differences(q)
    ! E^-1 once for the value at -1, and once more for each order of backward difference.
    do k = 1, size(q)
      do j = size(q) - 1, k, -1
        b(j) = b(j) - b(j + 1)
      end do
    end do
  end function newton_coefficients

  !> The differences of orders 0, 1, .. of q(0), q(1), .. at 0.
  pure function forward_differences(q) result(d)
    real(dp), intent(in) :: q(:)
    real(dp) :: d(size(q))
    integer :: j, k

    d = q
    do k = 2, size(q)
      do j = size(q), k, -1
        d(j) = d(j) - d(j - 1)
      end do
    end do
  end function forward_differences

end module fuge_edge_expansion
