!> The response of a periodic half-plane to a wave of forces on equal cells, at a depth below the centres of the cells.
!>
!> A wave exp(iqx) of pressure at the surface gives at the depth z, with s = |q|, stresses and displacements of the form
!> (a + b s z) exp(-s z)/s**power times itself, those that are odd in x also times the imaginary unit and the sign of q
!> (K. L. Johnson, Contact Mechanics, 1985, sections 2.1 and 13.2). On cells of width h the waves q + 2 pi k/h are the
!> same, so that their contributions add up, each with the transfer function of the element: sinc(q h/2), with
!> alternating signs, for uniform pressure on a cell, and its square for a hat.
!>
!> The wave itself is taken directly. The sum of the others is a smooth function of q h in [0, pi], with no singularity
!> before 2 pi, so that a Chebyshev series of degree 32 gives it to rounding (error 5.8**(-32)). Its values at the nodes
!> are sums of an alternating series (H. Cohen, F. Rodriguez Villegas, D. Zagier, Experiment. Math. 9, 2000, algorithm
!> 1); the series of the hat is first made alternating as by A. van Wijngaarden.
module fuge_halfplane_wave_factors
  use fuge_chebyshev, only: chebyshev_coefficients, chebyshev_points, chebyshev_sum
  use fuge_constants, only: PI
  use fuge_kinds, only: dp
  implicit none
  private

  public :: fill_wave_factors

  !> (`constant` + `linear` s z) exp(-s z)/s**`power`, all lengths in units of the cell.
  type, public :: wave_response
    real(dp) :: constant = 0.0_dp, linear = 0.0_dp
    integer :: power = 0
    !> Odd in x.
    logical :: odd = .false.
  end type wave_response

  integer, parameter :: DEGREE = 32
  !> Terms of the alternating series, whose error is 5.8**(-TERMS).
  integer, parameter :: TERMS = 24
  !> From this depth on, in cells, the waves that coincide with it on the cells are left out: they are below
  !> exp(-pi DEEP).
  real(dp), parameter :: DEEP = 12.0_dp
  !> Waves whose sums are computed together.
  integer, parameter :: BLOCK = 128

contains

  !> `factor` (0:n/2): factor(k) multiplies the wave of k periods in `n` cells; it is 0 for the wave 0.
  !>
  !> `hat`: the element is a hat. `depth` >= 0 in units of a cell.
  pure subroutine fill_wave_factors(response, n, hat, depth, factor)
    type(wave_response), intent(in) :: response
    integer, intent(in) :: n
    logical, intent(in) :: hat
    real(dp), intent(in) :: depth
    real(dp), intent(inout), contiguous :: factor(0:)
    real(dp) :: sine, theta
    integer :: k

    factor(0) = 0.0_dp
    do k = 1, n/2
      theta = 2.0_dp*PI*(real(k, dp)/real(n, dp))
      sine = sin(0.5_dp*theta)/(0.5_dp*theta)
      if (hat) sine = sine**2
      factor(k) = sine*value_of(response, theta, depth)
    end do
    if (depth < DEEP) call add_others(response, n, hat, depth, factor)
  end subroutine fill_wave_factors

  !> Add the responses to the other waves, which coincide with these on the cells.
  pure subroutine add_others(response, n, hat, depth, factor)
    type(wave_response), intent(in) :: response
    integer, intent(in) :: n
    logical, intent(in) :: hat
    real(dp), intent(in) :: depth
    real(dp), intent(inout), contiguous :: factor(0:)
    real(dp) :: series(0:DEGREE), fraction(BLOCK), others(BLOCK)
    integer :: count, first, k

    series = chebyshev_coefficients(sums_at_nodes(response, hat, depth))
    do first = 1, n/2, BLOCK
      count = min(BLOCK, n/2 - first + 1)
      do k = 1, count
        fraction(k) = real(first + k - 1, dp)/real(n, dp)
      end do
      others(:count) = chebyshev_sum(series, 4.0_dp*fraction(:count) - 1.0_dp)
      do k = 1, count
        others(k) = others(k)*(2.0_dp*sin(PI*fraction(k)))**merge(2, 1, hat)
        factor(first + k - 1) = factor(first + k - 1) + others(k)
      end do
    end do
  end subroutine add_others

  !> The sums at the nodes q h = pi (1 + t)/2, but for the power of 2 sin(q h/2) that they have in common.
  pure function sums_at_nodes(response, hat, depth) result(sums)
    type(wave_response), intent(in) :: response
    logical, intent(in) :: hat
    real(dp), intent(in) :: depth
    real(dp) :: sums(0:DEGREE)
    type(wave_response) :: shared
    real(dp) :: below, theta(0:DEGREE)
    integer :: j

    shared = response
    shared%power = response%power + merge(2, 1, hat)
    ! The sine of the strip changes its sign with q, as an odd response does.
    below = merge(-1.0_dp, 1.0_dp, response%odd .eqv. hat)
    theta = 0.5_dp*PI*(1.0_dp + chebyshev_points(DEGREE))
    do j = 0, DEGREE
      sums(j) = series_sum(shared, theta(j), hat, depth) + below*series_sum(shared, -theta(j), hat, depth)
    end do
  end function sums_at_nodes

  !> The sum of the response to 2 pi k + `shift` over k = 1, 2, ..; with alternating signs, the first one negative,
  !> unless all signs are `equal`.
  pure function series_sum(response, shift, equal, depth) result(total)
    type(wave_response), intent(in) :: response
    real(dp), intent(in) :: shift, depth
    logical, intent(in) :: equal
    real(dp) :: total
    real(dp) :: b, c, d, term
    integer :: k

    d = (3.0_dp + sqrt(8.0_dp))**TERMS
    d = 0.5_dp*(d + 1.0_dp/d)
    b = -1.0_dp
    c = -d
    total = 0.0_dp
    do k = 0, TERMS - 1
      if (equal) then
        term = doubled_sum(response, shift, k + 1, depth)
      else
        term = -value_of(response, 2.0_dp*PI*real(k + 1, dp) + shift, depth)
      end if
      c = b - c
      total = total + c*term
      b = b*(real(k + TERMS, dp)*real(k - TERMS, dp)/((real(k, dp) + 0.5_dp)*real(k + 1, dp)))
    end do
    total = total/d
  end function series_sum

  !> The sum of 2**j times term 2**j `k` over j = 0, 1, ..: the alternating series of these sums has the sum of the
  !> terms.
  pure function doubled_sum(response, shift, k, depth) result(total)
    type(wave_response), intent(in) :: response
    real(dp), intent(in) :: shift, depth
    integer, intent(in) :: k
    real(dp) :: total
    real(dp) :: power, s, term, weight
    integer :: j

    total = 0.0_dp
    power = 1.0_dp
    ! Terms fall off like 2**(-j), at a small depth later but with a small factor: 80 are enough in any case.
    do j = 0, 80
      s = 2.0_dp*PI*power*real(k, dp) + shift
      weight = power*exp(-min(s*depth, 700.0_dp))/s**response%power
      term = weight*(abs(response%constant) + abs(response%linear)*s*depth)
      total = total + weight*(response%constant + response%linear*s*depth)
      if (term <= 1.0e-19_dp) exit
      power = 2.0_dp*power
    end do
  end function doubled_sum

  elemental function value_of(response, s, depth) result(value)
    type(wave_response), intent(in) :: response
    real(dp), intent(in) :: s, depth
    real(dp) :: value

    value = 0.0_dp
    if (s*depth < 700.0_dp) value = exp(-s*depth)/s**response%power*(response%constant + response%linear*s*depth)
  end function value_of

end module fuge_halfplane_wave_factors
