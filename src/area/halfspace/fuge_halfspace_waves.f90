!> Influence coefficients and eigenvalues of grids of rectangles on an elastic half-space that is periodic in at least
!> one direction.
!>
!> A wave q of pressure displaces the surface by 2/(e_star |q|) times itself (K. L. Johnson, Contact Mechanics, 1985,
!> equation 13.6 and section 13.2). The eigenvalue of a wave of forces on the cells is the sum of this over all waves
!> that coincide with it on the cells, times sinc(q_x h_x/2) sinc(q_y h_y/2), the transfer function of the element, or
!> its square for FUGE_MEAN. The sum over two directions converges slowly. With
!>
!>     1/|q| = 2/sqrt(pi) times the integral of exp(-t**2 |q|**2) over t > 0
!>
!> it becomes an integral of products of two sums, each over one direction. Those are theta functions, whose terms fall
!> off like a Gaussian, over waves or, for small t, over cells. The trapezoidal rule in log t converges exponentially:
!> some 80 values of t give all eigenvalues to rounding, as a product of two matrices. A direction in which cells
!> instead of waves are wanted, because the surface does not repeat or the grid is only a window of it, takes the
!> Fourier transform of its sums.
module fuge_halfspace_waves
  use fuge_constants, only: PI
  use fuge_grid_plan, only: grid_plan
  use fuge_halfplane_influence, only: mean_log, FUGE_CENTRE
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgemm
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: fill_periodic_columns, fill_periodic_eigenvalues, fill_periodic_kernel, fill_strip_kernel

  !> Step of the trapezoidal rule in log t; its relative error is 3 exp(-pi**2/(2 STEP)).
  real(dp), parameter :: STEP = 0.12_dp
  !> Below this t/h only neighbours of a cell, if any, belong to its sum.
  real(dp), parameter :: SHORT = 0.04_dp
  !> Up to this t/h the sum over cells is taken, above it the one over waves.
  real(dp), parameter :: SWITCH = 0.4_dp
  !> From this t/h on, the Gauss rule integrates a Gaussian over a cell to rounding.
  real(dp), parameter :: RESOLVED = 2.0_dp
  !> Cells on each side, and waves, that count.
  integer, parameter :: NEIGHBOURS = 5, ALIASES = 3
  !> exp(-x**2) and erfc(x) are less than rounding.
  real(dp), parameter :: NEGLIGIBLE = 6.3_dp
  !> Rule of Gauss and Legendre from 0 to 1.
  real(dp), parameter :: GAUSS_NODE(6) = 0.5_dp + 0.5_dp*[ &
    -0.93246951420315203_dp, -0.66120938646626451_dp, -0.23861918608319691_dp, &
    0.23861918608319691_dp, 0.66120938646626451_dp, 0.93246951420315203_dp]
  real(dp), parameter :: GAUSS_WEIGHT(6) = 0.5_dp*[ &
    0.17132449237917035_dp, 0.36076157304813861_dp, 0.46791393457269105_dp, &
    0.46791393457269105_dp, 0.36076157304813861_dp, 0.17132449237917035_dp]

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

    call fill_periodic_kernel(cells, [.true., .true.], spacing, e_star, element, eigenvalue, stat)
  end subroutine fill_periodic_eigenvalues

  !> The influence of a cell on a surface that is periodic in both directions, `surface` (2) cells each.
  !>
  !> `kernel` (0:my, 0:mx), displacement per force: for the waves of 0, 1, .. periods in a direction that is
  !> `wanted_waves`, then m is half of its cells, and otherwise at the distances 0, 1, .. cells. Displacements count
  !> from the mean of the surface. `spacing` (2) length, `e_star` force per length squared. `stat` as in an allocate
  !> statement.
  subroutine fill_periodic_kernel(surface, wanted_waves, spacing, e_star, element, kernel, stat)
    integer, intent(in) :: surface(2), element
    logical, intent(in) :: wanted_waves(2)
    real(dp), intent(in) :: spacing(2), e_star
    real(dp), intent(inout), contiguous :: kernel(0:, 0:)
    integer, intent(out) :: stat

    call fill_periodic_columns(surface, wanted_waves, spacing, e_star, element, 0, kernel, stat)
  end subroutine fill_periodic_kernel

  !> As fill_periodic_kernel, the columns of `kernel` from number `begin` on.
  subroutine fill_periodic_columns(surface, wanted_waves, spacing, e_star, element, begin, kernel, stat)
    integer, intent(in) :: surface(2), element, begin
    logical, intent(in) :: wanted_waves(2)
    real(dp), intent(in) :: spacing(2), e_star
    real(dp), intent(inout), contiguous :: kernel(0:, begin:)
    integer, intent(out) :: stat
    real(dp), allocatable :: node(:), weight(:), along_x(:, :), along_y(:, :)
    real(dp), dimension(0:1) :: mean_x, mean_y
    integer :: i, j

    call new_rule(maxval(spacing*surface)/minval(spacing), node, weight, stat)
    if (stat /= 0) return
    weight = weight*(4.0_dp/sqrt(PI))*(minval(spacing)/spacing(1)/spacing(2)/e_star)
    allocate (along_x(0:max(ubound(kernel, 2), 0), size(node)), along_y(0:ubound(kernel, 1), size(node)), stat=stat)
    if (stat == 0) call fill_circle(surface(1), wanted_waves(1), node*(minval(spacing)/spacing(1)), &
                                    element, .true., along_x, stat)
    if (stat == 0) call fill_circle(surface(2), wanted_waves(2), node*(minval(spacing)/spacing(2)), &
                                    element, .true., along_y, stat)
    if (stat /= 0 .or. size(kernel, 2) < 1) return
    if (begin == 0) then
      call multiply(along_y, weight, along_x, kernel)
    else
      along_x = along_x(begin:, :)
      call multiply(along_y, weight, along_x, kernel)
    end if
    ! Without the constant, which is the first wave, or at all distances.
    mean_x = constant(surface(1), wanted_waves(1))*sum(weight)
    mean_y = constant(surface(2), wanted_waves(2))
    do j = begin, ubound(kernel, 2)
      do i = 0, ubound(kernel, 1)
        kernel(i, j) = kernel(i, j) - mean_y(min(i, 1))*mean_x(min(j, 1))
      end do
    end do
    if (all(wanted_waves) .and. begin == 0) kernel(0, 0) = 0.0_dp
  end subroutine fill_periodic_columns

  !> The constant on a circle of `n` cells: the first wave and the others, or at distance 0 and farther.
  pure function constant(n, waves) result(values)
    integer, intent(in) :: n
    logical, intent(in) :: waves
    real(dp) :: values(0:1)

    values = 1.0_dp/real(n, dp)
    if (waves) values = [1.0_dp, 0.0_dp]
  end function constant

  !> The influence of a cell on a surface that is periodic along `direction`, 1 for x or 2 for y, with the period of
  !> `surface` cells, and free along the other one.
  !>
  !> `kernel` (0:m, 0:n): along the first dimension the free direction, at the distances 0, 1, ..; along the second one
  !> waves or distances as for `fill_periodic_kernel`. The wave of constant forces is the half-plane's logarithm; its
  !> datum is the mean over a circle of 2 m cells. `datum`, length per force of a cell: what then remains to be added if
  !> the displacement is to be 0 at the distance `reach` along the free direction, length.
  !> Ten arguments: those of `fill_periodic_kernel`, and the datum.
  subroutine fill_strip_kernel(direction, surface, wanted_waves, reach, spacing, e_star, element, kernel, datum, stat)
    integer, intent(in) :: direction, surface, element
    logical, intent(in) :: wanted_waves
    real(dp), intent(in) :: reach, spacing(2), e_star
    real(dp), intent(inout), contiguous :: kernel(0:, 0:)
    real(dp), intent(out) :: datum
    integer, intent(out) :: stat
    real(dp), allocatable :: node(:), weight(:), round(:, :), along(:, :), logarithm(:)
    real(dp) :: least, factor, mean, constants(0:1)
    integer :: j, k, m

    datum = 0.0_dp
    least = minval(spacing)
    m = ubound(kernel, 1)
    call new_rule(spacing(direction)*surface/least, node, weight, stat)
    if (stat /= 0) return
    weight = weight*(4.0_dp/sqrt(PI))*(least/spacing(1)/spacing(2)/e_star)
    allocate (round(0:ubound(kernel, 2), size(node)), along(0:m, size(node)), logarithm(0:m), stat=stat)
    if (stat == 0) call fill_circle(surface, wanted_waves, node*(least/spacing(direction)), element, .false., round, &
                                    stat)
    if (stat /= 0) return
    do k = 1, size(node)
      call fill_places(node(k)*(least/spacing(3 - direction)), element, along(:, k))
    end do
    call multiply(along, weight, round, kernel)
    do k = 0, m
      logarithm(k) = mean_log(real(k, dp), merge(0.0_dp, 1.0_dp, element == FUGE_CENTRE), 1.0_dp)
    end do
    mean = logarithm(0)
    if (m > 0) mean = (logarithm(0) + logarithm(m) + 2.0_dp*sum(logarithm(1:m - 1)))/real(2*m, dp)
    factor = -2.0_dp/(PI*e_star*spacing(direction))
    constants = constant(surface, wanted_waves)
    do j = 0, ubound(kernel, 2)
      kernel(:, j) = kernel(:, j) + (factor*constants(min(j, 1)))*(logarithm - mean)
    end do
    datum = factor/real(surface, dp)*(mean - log(reach/spacing(3 - direction)))
  end subroutine fill_strip_kernel

  !> `kernel` = `along_y` diag(`weight`) transpose(`along_x`); `along_y` is undefined on return.
  subroutine multiply(along_y, weight, along_x, kernel)
    real(dp), intent(inout), contiguous :: along_y(:, :)
    real(dp), intent(in), contiguous :: weight(:), along_x(:, :)
    real(dp), intent(inout), contiguous :: kernel(:, :)
    integer :: k

    do k = 1, size(weight)
      along_y(:, k) = weight(k)*along_y(:, k)
    end do
    call dgemm('N', 'T', size(along_y, 1), size(along_x, 1), size(weight), 1.0_dp, along_y, size(along_y, 1), along_x, &
               size(along_x, 1), 0.0_dp, kernel, size(kernel, 1))
  end subroutine multiply

  !> The sums of a periodic direction of `n` cells at the values `t` of t/h: `sums` (0:m, size(t)), of the waves 0 .. m,
  !> m <= n/2, or of the distances 0 .. m; with or without the wave 0, the `constant`.
  subroutine fill_circle(n, waves, t, element, constant, sums, stat)
    integer, intent(in) :: n, element
    logical, intent(in) :: waves, constant
    real(dp), intent(in), contiguous :: t(:)
    real(dp), intent(inout), contiguous :: sums(0:, :)
    integer, intent(out) :: stat
    real(dp), allocatable :: round(:, :)
    type(grid_plan) :: plan
    type(fuge_info) :: info
    integer :: i, j, k

    allocate (round(0:n/2, size(t)), stat=stat)
    if (stat /= 0) return
    do k = 1, size(t)
      call fill_sums(n, t(k), merge(1, 2, element == FUGE_CENTRE), round(:, k))
      if (.not. constant) round(0, k) = 0.0_dp
    end do
    if (waves) then
      sums = round(:ubound(sums, 1), :)
      return
    end if
    call plan%set([n, 1], [n, 1], info, .false.)
    stat = info%status
    if (stat == 0) call plan%transform_even(1, .false., round, stat)
    if (stat /= 0) return
    do k = 1, size(t)
      do i = 0, ubound(sums, 1)
        j = mod(i, n)
        sums(i, k) = round(min(j, n - j), k)/real(n, dp)
      end do
    end do
  end subroutine fill_circle

  !> The share of a Gaussian of variance 2 t**2 about a cell of width 1, averaged over the cell unless the `element` is
  !> FUGE_CENTRE, that lies in the cells at the distances 0, 1, ..
  pure subroutine fill_places(t, element, share)
    real(dp), intent(in) :: t
    integer, intent(in) :: element
    real(dp), intent(out) :: share(0:)
    integer :: count, j

    count = int(min(real(ubound(share, 1), dp), 2.0_dp + 2.0_dp*NEGLIGIBLE*t))
    share(count + 1:) = 0.0_dp
    if (t < RESOLVED) then
      call fill_shares(t, merge(1, 2, element == FUGE_CENTRE), share(:count))
      return
    end if
    do j = 0, count
      if (element == FUGE_CENTRE) then
        share(j) = sum(GAUSS_WEIGHT*(gaussian(j + 0.5_dp*GAUSS_NODE, t) + gaussian(j - 0.5_dp*GAUSS_NODE, t)))*0.5_dp
      else
        share(j) = sum(GAUSS_WEIGHT*(1.0_dp - GAUSS_NODE)*(gaussian(j + GAUSS_NODE, t) + gaussian(j - GAUSS_NODE, t)))
      end if
    end do
  end subroutine fill_places

  elemental function gaussian(x, t) result(density)
    real(dp), intent(in) :: x, t
    real(dp) :: density

    density = exp(-(x/(2.0_dp*t))**2)/(2.0_dp*sqrt(PI)*t)
  end function gaussian

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
    real(dp) :: share(0:NEIGHBOURS)
    integer :: k

    if (t < SWITCH) then
      call fill_shares(t, power, share)
      do k = 0, ubound(sums, 1)
        sums(k) = sum_over_cells(share, real(k, dp)/real(n, dp))
      end do
    else
      do k = 0, ubound(sums, 1)
        sums(k) = sum_over_waves(t, power, real(k, dp)/real(n, dp))
      end do
    end if
  end subroutine fill_sums

  !> The share of a Gaussian of variance 2 t**2 about a cell of width 1, averaged over the cell if `power` is 2,
  !> that lies in the cells at the distances 0, 1, ..
  pure subroutine fill_shares(t, power, share)
    real(dp), intent(in) :: t
    integer, intent(in) :: power
    real(dp), intent(out) :: share(0:)
    integer :: j

    do j = 0, ubound(share, 1)
      if (power == 1) then
        share(j) = 0.5_dp*(erfc((j - 0.5_dp)/(2.0_dp*t)) - erfc((j + 0.5_dp)/(2.0_dp*t)))
      else
        share(j) = 0.5_dp*(antiderivative(j - 1.0_dp, t) - 2.0_dp*antiderivative(real(j, dp), t) &
                          + antiderivative(j + 1.0_dp, t))
      end if
    end do
  end subroutine fill_shares

  !> The integral of -erfc(s/(2 t)) over s up to x, from infinity.
  pure function antiderivative(x, t) result(value)
    real(dp), intent(in) :: x, t
    real(dp) :: value, ratio

    ratio = x/(2.0_dp*t)
    value = -x*erfc(ratio)
    if (abs(ratio) < 2.0_dp*NEGLIGIBLE) value = value + 2.0_dp*t/sqrt(PI)*exp(-ratio**2)
  end function antiderivative

  !> `share`(0) + 2 sum of `share`(j) cos(2 pi mu j).
  pure function sum_over_cells(share, mu) result(total)
    real(dp), intent(in) :: share(0:), mu
    real(dp) :: total, before, now, next, twice
    integer :: j

    twice = 2.0_dp*cos(2.0_dp*PI*mu)
    before = 1.0_dp
    now = 0.5_dp*twice
    total = share(0)
    do j = 1, ubound(share, 1)
      total = total + 2.0_dp*share(j)*now
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
