!> The eigenvalues of the influence operator of a periodic grid of rectangles on the elastic half-space.
!>
!> A wave q of pressure displaces the surface by 2/(e_star |q|) times itself (K. L. Johnson, Contact Mechanics, 1985,
!> equation 13.6 and section 13.2). The eigenvalue of a wave of forces on the cells is the sum of this over all waves that coincide with it
!> on the cells, times sinc(q_x h_x/2) sinc(q_y h_y/2), the transfer function of the element, or its square for
!> FUGE_MEAN. The sum over two directions converges slowly. With
!>
!>     1/|q| = 2/sqrt(pi) times the integral of exp(-t**2 |q|**2) over t > 0
!>
!> it becomes an integral of products of two sums, each over one direction. Those are theta functions, whose terms fall
!> off like a Gaussian, over waves or, for small t, over cells. The trapezoidal rule in log t converges exponentially:
!> some 80 values of t give all eigenvalues to rounding, as a product of two matrices.
module fuge_halfspace_waves
  use fuge_constants, only: PI
  use fuge_halfplane_influence, only: FUGE_CENTRE
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgemm
  implicit none
  private

  public :: fill_periodic_eigenvalues

  !> Step of the trapezoidal rule in log t; its relative error is 3 exp(-pi**2/(2 STEP)).
  real(dp), parameter :: STEP = 0.12_dp
  !> Below this t/h only neighbours of a cell, if any, belong to its sum.
  real(dp), parameter :: SHORT = 0.04_dp
  !> Up to this t/h the sum over cells is taken, above it the one over waves.
  real(dp), parameter :: SWITCH = 0.4_dp
  !> Cells on each side, and waves, that count.
  integer, parameter :: NEIGHBOURS = 5, ALIASES = 3
  !> exp(-x**2) and erfc(x) are less than rounding.
  real(dp), parameter :: NEGLIGIBLE = 6.3_dp

contains

  !> `eigenvalue` (0:ny/2, 0:nx/2), displacement per force of a cell: of the wave of k periods along y and m along x at
  !> (k, m). 0 at (0, 0): displacements count from the mean of the surface.
  !>
  !> `cells` [nx, ny], `spacing` (2) length, `e_star` force per length squared. `stat` as in an allocate statement.
  subroutine fill_periodic_eigenvalues(cells, spacing, e_star, element, eigenvalue, stat)
    integer, intent(in) :: cells(2), element
    real(dp), intent(in) :: spacing(2), e_star
    real(dp), intent(inout), contiguous :: eigenvalue(0:, 0:)
    integer, intent(out) :: stat
    real(dp), allocatable :: node(:), weight(:), along_x(:, :), along_y(:, :)
    integer :: k, m, n, power

    call new_rule(maxval(spacing*cells)/minval(spacing), node, weight, stat)
    if (stat /= 0) return
    m = cells(1)/2 + 1
    n = cells(2)/2 + 1
    allocate (along_x(m, size(node)), along_y(n, size(node)), stat=stat)
    if (stat /= 0) return
    power = merge(1, 2, element == FUGE_CENTRE)
    weight = weight*(4.0_dp/sqrt(PI))*(minval(spacing)/spacing(1)/spacing(2)/e_star)
    do k = 1, size(node)
      call fill_sums(cells(1), node(k)*(minval(spacing)/spacing(1)), power, along_x(:, k))
      call fill_sums(cells(2), node(k)*(minval(spacing)/spacing(2)), power, along_y(:, k))
      along_y(:, k) = weight(k)*along_y(:, k)
    end do
    call dgemm('N', 'T', n, m, size(node), 1.0_dp, along_y, n, along_x, m, 0.0_dp, eigenvalue, size(eigenvalue, 1))
    eigenvalue(0, 0) = 0.0_dp
  end subroutine fill_periodic_eigenvalues

  !> Values of t in units of the smaller spacing, and weights of an integral over t: the trapezoidal rule in
  !> log t, up to where the longest wave of length `period` is negligible. Where t is so small for both spacings
  !> that both sums are linear in t, two nodes stand for the rest of the rule.
  pure subroutine new_rule(period, node, weight, stat)
    real(dp), intent(in) :: period
    real(dp), allocatable, intent(out) :: node(:), weight(:)
    integer, intent(out) :: stat
    real(dp) :: moment(0:3), b, c, root, last
    integer :: count, k

    last = NEGLIGIBLE*period/(2.0_dp*PI)
    count = 2 + max(1, ceiling(log(last/SHORT)/STEP))
    allocate (node(count), weight(count), stat=stat)
    if (stat /= 0) return
    do k = 3, count
      node(k) = SHORT*exp(STEP*real(k - 2, dp))
      weight(k) = STEP*node(k)
    end do
    ! The sums over SHORT exp(-STEP k), k = 0, 1, .., of the powers of t, in units of SHORT.
    do k = 0, 3
      moment(k) = STEP/(1.0_dp - exp(-STEP*real(k + 1, dp)))
    end do
    b = (moment(1)*moment(2) - moment(0)*moment(3))/(moment(0)*moment(2) - moment(1)**2)
    c = -(moment(2) + b*moment(1))/moment(0)
    root = sqrt(0.25_dp*b**2 - c)
    node(1:2) = [-0.5_dp*b - root, -0.5_dp*b + root]
    weight(1) = (moment(1) - moment(0)*node(2))/(node(1) - node(2))
    weight(2) = moment(0) - weight(1)
    node(1:2) = SHORT*node(1:2)
    weight(1:2) = SHORT*weight(1:2)
  end subroutine new_rule

  !> The sum for the waves of 0, 1, .. n/2 periods in n cells, at t/h = `t`.
  pure subroutine fill_sums(n, t, power, sums)
    integer, intent(in) :: n, power
    real(dp), intent(in) :: t
    real(dp), intent(out) :: sums(0:)
    real(dp) :: part(0:NEIGHBOURS)
    integer :: k

    if (t < SWITCH) then
      call fill_parts(t, power, part)
      do k = 0, ubound(sums, 1)
        sums(k) = sum_over_cells(part, real(k, dp)/real(n, dp))
      end do
    else
      do k = 0, ubound(sums, 1)
        sums(k) = sum_over_waves(t, power, real(k, dp)/real(n, dp))
      end do
    end if
  end subroutine fill_sums

  !> The part of a Gaussian of variance 2 t**2 about a cell of width 1, averaged over the cell if `power` is 2,
  !> that lies in the cells at the distances 0, 1, ..
  pure subroutine fill_parts(t, power, part)
    real(dp), intent(in) :: t
    integer, intent(in) :: power
    real(dp), intent(out) :: part(0:)
    integer :: j

    do j = 0, ubound(part, 1)
      if (power == 1) then
        part(j) = 0.5_dp*(erfc((j - 0.5_dp)/(2.0_dp*t)) - erfc((j + 0.5_dp)/(2.0_dp*t)))
      else
        part(j) = 0.5_dp*(antiderivative(j - 1.0_dp, t) - 2.0_dp*antiderivative(real(j, dp), t) &
                          + antiderivative(j + 1.0_dp, t))
      end if
    end do
    ! Of the cell itself what the others leave, because of rounding.
    part(0) = 1.0_dp - 2.0_dp*sum(part(1:))
  end subroutine fill_parts

  !> The integral of -erfc(s/(2 t)) over s up to x, from infinity.
  pure function antiderivative(x, t) result(value)
    real(dp), intent(in) :: x, t
    real(dp) :: value, ratio

    ratio = x/(2.0_dp*t)
    value = -x*erfc(ratio)
    if (abs(ratio) < 2.0_dp*NEGLIGIBLE) value = value + 2.0_dp*t/sqrt(PI)*exp(-ratio**2)
  end function antiderivative

  !> `part`(0) + 2 sum of `part`(j) cos(2 pi mu j).
  pure function sum_over_cells(part, mu) result(total)
    real(dp), intent(in) :: part(0:), mu
    real(dp) :: total, before, now, next, twice
    integer :: j

    twice = 2.0_dp*cos(2.0_dp*PI*mu)
    before = 1.0_dp
    now = 0.5_dp*twice
    total = part(0)
    do j = 1, ubound(part, 1)
      total = total + 2.0_dp*part(j)*now
      next = twice*now - before
      before = now
      now = next
    end do
  end function sum_over_cells

  !> The sum over a of sinc(pi (mu + a))**`power` exp(-(2 pi t (mu + a))**2), 0 <= `mu` <= 1/2.
  pure function sum_over_waves(t, power, mu) result(total)
    real(dp), intent(in) :: t, mu
    integer, intent(in) :: power
    real(dp) :: total, sinc, exponent
    integer :: a

    total = 0.0_dp
    do a = -ALIASES, ALIASES - 1
      exponent = (2.0_dp*PI*t*(mu + a))**2
      if (exponent > 2.0_dp*NEGLIGIBLE**2) cycle
      sinc = 1.0_dp
      if (mu > 0.0_dp) then
        sinc = sin(PI*mu)/(PI*(mu + a))
        if (power == 1 .and. mod(a, 2) /= 0) sinc = -sinc
      else if (a /= 0) then
        cycle
      end if
      total = total + sinc**power*exp(-exponent)
    end do
  end function sum_over_waves

end module fuge_halfspace_waves
