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
  use fuge_cell_elements, only: FUGE_CENTRE
  use fuge_constants, only: PI
  use fuge_gaussian_cells, only: NEGLIGIBLE
  use fuge_gaussian_products, only: fill_distances, fill_waves, multiply
  use fuge_graded_series, only: graded_series
  use fuge_grid_plan, only: grid_plan
  use fuge_halfplane_influence, only: mean_log
  use fuge_halfspace_grid, only: halfspace_grid
  use fuge_kinds, only: dp
  use fuge_mixture_line, only: tabulate_distances
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: fill_free_columns, fill_free_rows, fill_periodic_columns, fill_periodic_eigenvalues, fill_periodic_kernel, &
    fill_strip_kernel

  !> Step of the trapezoidal rule in log t; its relative error is 3 exp(-pi**2/(2 STEP)).
  real(dp), parameter :: STEP = 0.12_dp
  !> Below this t/h only neighbours of a cell, if any, belong to its sum.
  real(dp), parameter :: SHORT = 0.04_dp
contains

  !> `eigenvalue` (0:ny/2, 0:nx/2), displacement per force of a cell: of the wave of k periods along y and m along x at
  !> (k, m). 0 at (0, 0), unless the base is rigid: displacements count from the mean of the surface.
  !>
  !> `grid` has spacing, modulus, element and body; `cells` [nx, ny]. `stat` as in an allocate statement.
  subroutine fill_periodic_eigenvalues(grid, cells, eigenvalue, stat)
    type(halfspace_grid), intent(in) :: grid
    integer, intent(in) :: cells(2)
    real(dp), intent(inout), contiguous :: eigenvalue(0:, 0:)
    integer, intent(out) :: stat

    call fill_periodic_kernel(grid, cells, [.true., .true.], eigenvalue, stat)
  end subroutine fill_periodic_eigenvalues

  !> The influence of a cell on a surface that is periodic in both directions, `surface` (2) cells each.
  !>
  !> `kernel` (0:my, 0:mx), displacement per force: for the waves of 0, 1, .. periods in a direction that is
  !> `wanted_waves`, then m is half of its cells, and otherwise at the distances 0, 1, .. cells. Displacements count
  !> from the mean of the surface, unless the base is rigid. `grid` as for the eigenvalues. `stat` as in an allocate
  !> statement.
  subroutine fill_periodic_kernel(grid, surface, wanted_waves, kernel, stat)
    type(halfspace_grid), intent(in) :: grid
    integer, intent(in) :: surface(2)
    logical, intent(in) :: wanted_waves(2)
    real(dp), intent(inout), contiguous :: kernel(0:, 0:)
    integer, intent(out) :: stat

    call fill_periodic_columns(grid, surface, wanted_waves, 0, kernel, stat)
  end subroutine fill_periodic_kernel

  !> As fill_periodic_kernel, the columns of `kernel` from number `begin` on.
  subroutine fill_periodic_columns(grid, surface, wanted_waves, begin, kernel, stat)
    type(halfspace_grid), intent(in) :: grid
    integer, intent(in) :: surface(2), begin
    logical, intent(in) :: wanted_waves(2)
    real(dp), intent(inout), contiguous :: kernel(0:, begin:)
    integer, intent(out) :: stat
    real(dp), allocatable :: node(:), weight(:), along_x(:, :), along_y(:, :)
    real(dp), dimension(0:1) :: mean_x, mean_y
    real(dp) :: least
    integer :: i, j

    least = minval(grid%spacing)
    call find_rule(grid, maxval(grid%spacing*surface), 0, node, weight, stat)
    if (stat /= 0) return
    allocate (along_x(0:max(ubound(kernel, 2), 0), size(node)), along_y(0:ubound(kernel, 1), size(node)), stat=stat)
    if (stat == 0) call fill_circle(surface(1), wanted_waves(1), node*(least/grid%spacing(1)), grid%element, .true., &
                                    along_x, stat)
    if (stat == 0) call fill_circle(surface(2), wanted_waves(2), node*(least/grid%spacing(2)), grid%element, .true., &
                                    along_y, stat)
    if (stat /= 0 .or. size(kernel, 2) < 1) return
    if (begin == 0) then
      call multiply(along_y, weight, along_x, kernel)
    else
      along_x = along_x(begin:, :)
      call multiply(along_y, weight, along_x, kernel)
    end if
    if (grid%body%has_rigid_base()) return
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

  !> Nodes, in units of the shorter spacing, and weights, length per force, of the integral for the body of `grid`, up
  !> to the period, or the distances in `free` directions, of the length `longest`.
  subroutine find_rule(grid, longest, free, node, weight, stat)
    type(halfspace_grid), intent(in) :: grid
    real(dp), intent(in) :: longest
    integer, intent(in) :: free
    real(dp), allocatable, intent(out) :: node(:), weight(:)
    integer, intent(out) :: stat
    real(dp) :: cell

    cell = minval(grid%spacing)
    if (grid%body%is_set()) then
      call grid%body%make_rule(cell, longest, free, node, weight, stat)
    else
      call new_rule(longest/cell, node, weight, stat)
    end if
    if (stat /= 0) return
    weight = weight*(4.0_dp/sqrt(PI))*(cell/grid%spacing(1)/grid%spacing(2)/grid%e_star)
  end subroutine find_rule

  !> Influence coefficients of a free surface: `table` (0:nx - 1, begin:), of cells i and j cells apart along x and y,
  !> displacement per force, the rows from number `begin` on of a table of `rows`. Only for a body that is no
  !> half-space.
  subroutine fill_free_rows(grid, begin, rows, table, stat)
    type(halfspace_grid), intent(in) :: grid
    integer, intent(in) :: begin, rows
    real(dp), intent(inout), contiguous :: table(0:, begin:)
    integer, intent(out) :: stat
    type(halfspace_grid) :: turned

    turned = grid
    turned%spacing = grid%spacing(2:1:-1)
    call fill_free_columns(turned, begin, rows, table, stat)
  end subroutine fill_free_rows

  !> As fill_free_rows with x and y exchanged: `table` (0:ny - 1, begin:), the columns from number `begin` on of a table
  !> of `columns`.
  subroutine fill_free_columns(grid, begin, columns, table, stat)
    type(halfspace_grid), intent(in) :: grid
    integer, intent(in) :: begin, columns
    real(dp), intent(inout), contiguous :: table(0:, begin:)
    integer, intent(out) :: stat
    real(dp), allocatable :: node(:), weight(:), along_x(:, :), along_y(:, :)
    real(dp) :: least

    least = minval(grid%spacing)
    call find_rule(grid, hypot(size(table, 1)*grid%spacing(2), columns*grid%spacing(1)), 2, node, weight, stat)
    if (stat /= 0) return
    allocate (along_x(0:ubound(table, 2), size(node)), along_y(0:ubound(table, 1), size(node)), stat=stat)
    if (stat /= 0) return
    call fill_distances(node*(least/grid%spacing(1)), averages(grid%element), along_x)
    call fill_distances(node*(least/grid%spacing(2)), averages(grid%element), along_y)
    if (begin > 0) along_x = along_x(begin:, :)
    call multiply(along_y, weight, along_x, table)
  end subroutine fill_free_columns

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
  !> the displacement is to be 0 at the distance grid%reach along the free direction.
  !> `grid` as for the eigenvalues, with its reach.
  subroutine fill_strip_kernel(grid, direction, surface, wanted_waves, kernel, datum, stat)
    type(halfspace_grid), intent(in) :: grid
    integer, intent(in) :: direction, surface
    logical, intent(in) :: wanted_waves
    real(dp), intent(inout), contiguous :: kernel(0:, 0:)
    real(dp), intent(out) :: datum
    integer, intent(out) :: stat
    real(dp), allocatable :: node(:), weight(:), round(:, :), along(:, :), logarithm(:)
    real(dp) :: factor, far, least, mean, constants(0:1)
    integer :: across, j, m

    datum = 0.0_dp
    across = 3 - direction
    least = minval(grid%spacing)
    m = ubound(kernel, 1)
    call find_rule(grid, grid%spacing(direction)*surface, 0, node, weight, stat)
    if (stat /= 0) return
    allocate (round(0:ubound(kernel, 2), size(node)), along(0:m, size(node)), logarithm(0:m), stat=stat)
    if (stat == 0) call fill_circle(surface, wanted_waves, node*(least/grid%spacing(direction)), grid%element, &
                                    .false., round, stat)
    if (stat == 0) call fill_line(grid, grid%spacing(across), logarithm, far, stat)
    if (stat /= 0) return
    call fill_distances(node*(least/grid%spacing(across)), averages(grid%element), along)
    call multiply(along, weight, round, kernel)
    mean = logarithm(0)
    if (m > 0) mean = (logarithm(0) + logarithm(m) + 2.0_dp*sum(logarithm(1:m - 1)))/real(2*m, dp)
    factor = -2.0_dp/(PI*grid%e_star*grid%spacing(direction))
    constants = constant(surface, wanted_waves)
    do j = 0, ubound(kernel, 2)
      kernel(:, j) = kernel(:, j) + (factor*constants(min(j, 1)))*(logarithm - mean)
    end do
    datum = factor/real(surface, dp)*(mean - far*log(grid%reach/grid%spacing(across)))
  end subroutine fill_strip_kernel

  !> The influence at distances of 0, 1, .. cells of the width `spacing` of forces that are constant in the other
  !> direction, in units of -2/(pi e_star): on a half-space the `logarithm` of the distance, otherwise `far` times it if
  !> that is long.
  subroutine fill_line(grid, spacing, logarithm, far, stat)
    type(halfspace_grid), intent(in) :: grid
    real(dp), intent(in) :: spacing
    real(dp), intent(out), contiguous :: logarithm(0:)
    real(dp), intent(out) :: far
    integer, intent(out) :: stat
    type(graded_series) :: series
    integer :: k, m

    stat = 0
    m = ubound(logarithm, 1)
    if (grid%body%is_set()) then
      far = grid%body%limit
      call tabulate_distances(grid%body, spacing, averages(grid%element), m, series, stat)
      if (stat == 0) logarithm = -0.5_dp*PI*[(series%value_at(k), k=0, m)]
    else
      far = 1.0_dp
      do k = 0, m
        logarithm(k) = mean_log(real(k, dp), merge(0.0_dp, 1.0_dp, grid%element == FUGE_CENTRE), 1.0_dp)
      end do
    end if
  end subroutine fill_line

  !> The sums of a periodic direction of `n` cells at the values `t` of t/h: `sums` (0:m, size(t)), of the waves 0 .. m,
  !> m <= n/2, or of the distances 0 .. m; with or without the wave 0, the `constant`.
  subroutine fill_circle(n, waves, t, element, constant, sums, stat)
    integer, intent(in) :: n, element
    logical, intent(in) :: waves, constant
    real(dp), intent(in), contiguous :: t(:)
    real(dp), intent(inout), contiguous :: sums(0:, :)
    integer, intent(out) :: stat
    real(dp), allocatable :: mu(:), round(:, :)
    type(grid_plan) :: plan
    type(fuge_info) :: info
    integer :: i, j, k

    allocate (mu(0:n/2), round(0:n/2, size(t)), stat=stat)
    if (stat /= 0) return
    mu = [(real(i, dp)/real(n, dp), i=0, n/2)]
    call fill_waves(mu, t, averages(element), round)
    if (.not. constant) round(0, :) = 0.0_dp
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

  !> How many times a displacement is averaged over a cell, that of the load included.
  elemental function averages(element) result(power)
    integer, intent(in) :: element
    integer :: power

    power = merge(1, 2, element == FUGE_CENTRE)
  end function averages

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

end module fuge_halfspace_waves
