!> The mean of 1/r over rectangles close to each other, in closed form.
!>
!> F(x, y) = x arsinh(y/|x|) + y arsinh(x/|y|) has the mixed derivative F_xy = 1/r (A. E. H. Love, Phil.
!> Trans. R. Soc. A 228, 1929; K. L. Johnson, Contact Mechanics, 1985, section 3.4), and
!> G(x, y) = (x**2 y arsinh(y/|x|) + x y**2 arsinh(x/|y|))/2 - r**3/6 has G_xxyy = 1/r. Means are
!> differences of F over the corners of one rectangle, and of G over all pairs of corners. These
!> differences cancel by the ratio of the lengths to the widths, up to the third
!> power. So they are formed with 32 digits.
module fuge_rectangle_potential
  use fuge_double_double, only: double_double, exact_product, exact_sum, log, operator(+), operator(-), operator(*), &
    operator(/), sqrt
  use fuge_kinds, only: dp
  implicit none
  private

  public :: near_mean, near_table

  !> Places in one direction at which F or G is taken, and their weights in the difference.
  type :: difference_rule
    type(double_double) :: place(4)
    real(dp) :: weight(4) = 0.0_dp
    integer :: count = 0
  end type difference_rule

contains

  !> factor times the mean of 1/r over two rectangles, rounded once.
  !>
  !> `x`, `y` offset of their centres; `observed` (2) and `loaded` (2) their widths along x and y,
  !> length; `observed` = 0 is a point. `factor` any number.
  pure function near_mean(x, y, observed, loaded, factor) result(mean)
    type(double_double), intent(in) :: x, y, factor
    real(dp), intent(in) :: observed(2), loaded(2)
    real(dp) :: mean
    type(difference_rule) :: along_x, along_y
    type(double_double) :: total, term, area
    real(dp) :: seen(2), pressed(2)
    logical :: point
    integer :: unit, i, j

    ! A unit of length for which no power overflows.
    unit = exponent(max(abs(x%high), abs(y%high), maxval(observed), maxval(loaded)))
    seen = scale(observed, -unit)
    pressed = scale(loaded, -unit)
    point = all(observed <= 0.0_dp)
    along_x = new_rule(scaled(x, -unit), seen(1), pressed(1))
    along_y = new_rule(scaled(y, -unit), seen(2), pressed(2))
    total = double_double(0.0_dp, 0.0_dp)
    do j = 1, along_y%count
      do i = 1, along_x%count
        if (point) then
          term = centre_form(along_x%place(i), along_y%place(j))
        else
          term = mean_form(along_x%place(i), along_y%place(j))
        end if
        total = total + term*(along_x%weight(i)*along_y%weight(j))
      end do
    end do
    area = double_double(pressed(1), 0.0_dp)*pressed(2)
    if (.not. point) area = area*(2.0_dp*seen(1))*seen(2)
    total = factor*total/area
    mean = scale(total%high, -unit)
  end function near_mean

  !> `table(i, j)`: factor times the mean of 1/r over equal rectangles of the widths `spacing` (2), side by side, that
  !> are i and j rectangles apart along x and y; or, for a `point`, over one of them from the centre of the other.
  !>
  !> As `near_mean`, but each value of F or G is used for all rectangles whose corners it belongs to. `stat` as in
  !> an allocate statement.
  pure subroutine near_table(spacing, point, factor, table, stat)
    real(dp), intent(in) :: spacing(2)
    logical, intent(in) :: point
    type(double_double), intent(in) :: factor
    real(dp), intent(inout) :: table(0:, 0:)
    integer, intent(out) :: stat
    type(double_double), allocatable :: form(:, :)
    type(double_double) :: total, area
    integer :: unit, i, j

    allocate (form(0:size(table, 1), 0:size(table, 2)), stat=stat)
    if (stat /= 0) return
    unit = exponent(maxval(spacing))
    call fill_forms(scale(spacing, -unit), point, form)
    area = double_double(scale(spacing(1), -unit), 0.0_dp)*scale(spacing(2), -unit)
    if (.not. point) area = area*area*2.0_dp
    do j = 0, ubound(table, 2)
      do i = 0, ubound(table, 1)
        if (point) then
          total = first_difference(form, i, j)
        else
          total = second_difference(form, i, j)
        end if
        total = factor*total/area
        table(i, j) = scale(total%high, -unit)
      end do
    end do
  end subroutine near_table

  !> F at the corners (i + 1/2, j + 1/2) times `spacing`, or 2 G at (i, j) times `spacing`.
  pure subroutine fill_forms(spacing, point, form)
    real(dp), intent(in) :: spacing(2)
    logical, intent(in) :: point
    type(double_double), intent(out) :: form(0:, 0:)
    real(dp) :: shift
    integer :: i, j

    shift = merge(0.5_dp, 0.0_dp, point)
    do j = 0, ubound(form, 2)
      do i = 0, ubound(form, 1)
        if (point) then
          form(i, j) = centre_form(exact_product(i + shift, spacing(1)), exact_product(j + shift, spacing(2)))
        else
          form(i, j) = mean_form(exact_product(i + shift, spacing(1)), exact_product(j + shift, spacing(2)))
        end if
      end do
    end do
  end subroutine fill_forms

  !> The difference of F, which is odd, over the corners of cell (i, j).
  pure function first_difference(form, i, j) result(total)
    type(double_double), intent(in) :: form(0:, 0:)
    integer, intent(in) :: i, j
    type(double_double) :: total
    real(dp) :: along_x, along_y

    along_x = merge(1.0_dp, -1.0_dp, i == 0)
    along_y = merge(1.0_dp, -1.0_dp, j == 0)
    total = form(i, j) + form(max(i, 1) - 1, j)*along_x
    total = total + form(i, max(j, 1) - 1)*along_y + form(max(i, 1) - 1, max(j, 1) - 1)*(along_x*along_y)
  end function first_difference

  !> The second difference of 2 G, which is even, along x and along y about the point (i, j).
  pure function second_difference(form, i, j) result(total)
    type(double_double), intent(in) :: form(0:, 0:)
    integer, intent(in) :: i, j
    type(double_double) :: total
    integer :: k

    total = row(j)*(-2.0_dp)
    do k = -1, 1, 2
      total = total + row(abs(j + k))
    end do

  contains

    pure function row(m) result(difference)
      integer, intent(in) :: m
      type(double_double) :: difference

      difference = form(i + 1, m) + form(abs(i - 1), m) + form(i, m)*(-2.0_dp)
    end function row

  end function second_difference

  elemental function scaled(x, power) result(y)
    type(double_double), intent(in) :: x
    integer, intent(in) :: power
    type(double_double) :: y

    y = double_double(scale(x%high, power), scale(x%low, power))
  end function scaled

  !> The first difference over a width `b`, or the second one over widths `a` and `b`, about `d`.
  pure function new_rule(d, a, b) result(rule)
    type(double_double), intent(in) :: d
    real(dp), intent(in) :: a, b
    type(difference_rule) :: rule
    type(double_double) :: half_sum, half_difference

    if (.not. a > 0.0_dp) then
      call add_place(rule, d + double_double(0.5_dp*b, 0.0_dp), 1.0_dp)
      call add_place(rule, d + double_double(-0.5_dp*b, 0.0_dp), -1.0_dp)
      return
    end if
    half_sum = exact_sum(0.5_dp*a, 0.5_dp*b)
    half_difference = exact_sum(0.5_dp*a, -0.5_dp*b)
    call add_place(rule, d + half_sum, 1.0_dp)
    call add_place(rule, d + half_sum*(-1.0_dp), 1.0_dp)
    if (abs(half_difference%high) > 0.0_dp) then
      call add_place(rule, d + half_difference, -1.0_dp)
      call add_place(rule, d + half_difference*(-1.0_dp), -1.0_dp)
    else
      call add_place(rule, d, -2.0_dp)
    end if
  end function new_rule

  pure subroutine add_place(rule, place, weight)
    type(difference_rule), intent(inout) :: rule
    type(double_double), intent(in) :: place
    real(dp), intent(in) :: weight

    rule%count = rule%count + 1
    rule%place(rule%count) = place
    rule%weight(rule%count) = weight
  end subroutine add_place

  !> F, odd in x and in y.
  pure function centre_form(x, y) result(f)
    type(double_double), intent(in) :: x, y
    type(double_double) :: f, a, b, r

    a = magnitude(x)
    b = magnitude(y)
    r = sqrt(a*a + b*b)
    f = (a*arsinh(b, a, r) + b*arsinh(a, b, r))*(sign(1.0_dp, x%high)*sign(1.0_dp, y%high))
  end function centre_form

  !> 2 G, even in x and in y.
  pure function mean_form(x, y) result(g)
    type(double_double), intent(in) :: x, y
    type(double_double) :: g, a, b, r, square

    a = magnitude(x)
    b = magnitude(y)
    square = a*a + b*b
    r = sqrt(square)
    g = a*b*(a*arsinh(b, a, r) + b*arsinh(a, b, r)) - square*r/double_double(3.0_dp, 0.0_dp)
  end function mean_form

  pure function magnitude(x) result(y)
    type(double_double), intent(in) :: x
    type(double_double) :: y

    y = x*sign(1.0_dp, x%high)
  end function magnitude

  !> arsinh(y/x) of x, y >= 0 with r**2 = x**2 + y**2; 0 for x = 0, where it is multiplied by x.
  pure function arsinh(y, x, r) result(value)
    type(double_double), intent(in) :: y, x, r
    type(double_double) :: value

    value = double_double(0.0_dp, 0.0_dp)
    if (x%high > 0.0_dp) value = log((y + r)/x)
  end function arsinh

end module fuge_rectangle_potential
