!> Hertzian contact of two bodies with an elliptic area of contact, in closed form.
!>
!> The gap of the undeformed bodies is x**2/(2 R_x) + y**2/(2 R_y), R_x and R_y being the principal relative radii of
!> curvature. The pressure is p_0 sqrt(1 - x**2/a**2 - y**2/b**2). With the displacement under it as an
!> integral (H. Hertz 1881; K. L. Johnson, Contact Mechanics, 1985, equations 4.26 to 4.32) in Carlson's symmetric
!> form,
!>
!>     1/R_x = F/(pi E*) R_D(0, b**2, a**2),   1/R_y = F/(pi E*) R_D(0, a**2, b**2),
!>     approach = 3 F/(2 pi E*) R_F(0, a**2, b**2),   p_0 = 3 F/(2 pi a b).
!>
!> The quotient of the first two determines b/a.
module fuge_hertz_theory
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_carlson, only: carlson_rd, carlson_rf
  use fuge_constants, only: PI, LARGEST_EXPONENT_OF_4
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_ERR_MODULUS, FUGE_ERR_NO_EQUILIBRIUM, FUGE_ERR_OVERFLOW, &
    FUGE_ERR_WIDTH
  implicit none
  private

  public :: fuge_hertz_ellipse

  !> Newton's steps for the ratio of the semi-axes; four are enough for any ratio.
  integer, parameter :: MOST_STEPS = 40

  !> The area of contact, an ellipse about x = 0, y = 0.
  type, public :: fuge_hertz_contact
    !> Semi-axes along x and along y; length.
    real(dp) :: semi_axis_x = 0.0_dp, semi_axis_y = 0.0_dp
    !> How far the bodies approach each other, absolute; length.
    real(dp) :: approach = 0.0_dp
    !> p_0, the pressure in the middle; force per length squared.
    real(dp) :: peak_pressure = 0.0_dp
  contains
    procedure :: pressure
  end type fuge_hertz_contact

contains

  !> Semi-axes, approach and pressure of two bodies with quadratic surfaces.
  !>
  !> `radius_x`, `radius_y` > 0: principal relative radii of curvature, 1/R = 1/R_1 + 1/R_2 of the two
  !> bodies, along x and y, length; equal for a sphere. `e_star` force per length squared, `load` >= 0 force.
  !> Errors, `contact` untouched: FUGE_ERR_NOT_FINITE; FUGE_ERR_WIDTH for a radius that is not positive, because
  !> then the contact is no ellipse; FUGE_ERR_MODULUS; FUGE_ERR_NO_EQUILIBRIUM for a negative load; FUGE_ERR_OVERFLOW
  !> for a radius or e_star beyond 1e77 or below 1e-77, or a load below the smallest normal number.
  pure subroutine fuge_hertz_ellipse(radius_x, radius_y, e_star, load, contact, info)
    real(dp), intent(in) :: radius_x, radius_y, e_star, load
    type(fuge_hertz_contact), intent(inout) :: contact
    type(fuge_info), intent(out) :: info
    real(dp) :: long, short, square

    call check_radius(radius_x, 'radius_x', info)
    if (.not. info%failed()) call check_radius(radius_y, 'radius_y', info)
    if (.not. info%failed()) call check_finite(e_star, 'e_star', info)
    if (.not. info%failed()) call check_load(load, info)
    if (info%failed()) return
    if (.not. e_star > 0.0_dp) then
      call report(info, FUGE_ERR_MODULUS, 'e_star = '//text(e_star)//' is not positive')
      return
    end if
    call check_range(e_star, 'e_star', info)
    if (info%failed()) return
    if (.not. load > 0.0_dp) then
      contact = fuge_hertz_contact()
      return
    end if

    square = squared_axis_ratio(max(radius_x, radius_y)/min(radius_x, radius_y))
    long = longer_axis(load, max(radius_x, radius_y), e_star, carlson_rd(0.0_dp, square, 1.0_dp)/PI)
    short = long*sqrt(square)
    contact%semi_axis_x = merge(long, short, radius_x >= radius_y)
    contact%semi_axis_y = merge(short, long, radius_x >= radius_y)
    contact%approach = 1.5_dp*(load/long)*carlson_rf(0.0_dp, square, 1.0_dp)/PI/e_star
    contact%peak_pressure = 1.5_dp*(load/long)/PI/short
  end subroutine fuge_hertz_ellipse

  !> The pressure at a place; force per length squared. `x`, `y` from the middle of the contact, length; 0 outside it.
  elemental function pressure(self, x, y) result(p)
    class(fuge_hertz_contact), intent(in) :: self
    real(dp), intent(in) :: x, y
    real(dp) :: p
    real(dp) :: r

    p = 0.0_dp
    if (.not. min(self%semi_axis_x, self%semi_axis_y) > 0.0_dp) return
    if (abs(x) > self%semi_axis_x .or. abs(y) > self%semi_axis_y) return
    r = hypot(x/self%semi_axis_x, y/self%semi_axis_y)
    if (r < 1.0_dp) p = self%peak_pressure*sqrt((1.0_dp - r)*(1.0_dp + r))
  end function pressure

  !> (b/a)**2, b <= a, for the ratio >= 1 of the two radii.
  !>
  !> Newton's method for the logarithm of q = (b/a)**2: d ln(ratio)/d ln(q) lies between -1 and -3/4, the values for a
  !> long ellipse and a circle, which also encloses q.
  pure function squared_axis_ratio(ratio) result(q)
    real(dp), intent(in) :: ratio
    real(dp) :: q
    real(dp) :: across, along, defect, slope, lower, upper
    integer :: step

    upper = 1.0_dp/ratio
    lower = upper*exp(-log(ratio)/3.0_dp)
    q = upper*exp(-log(ratio)/6.0_dp)
    do step = 1, MOST_STEPS
      across = carlson_rd(0.0_dp, 1.0_dp, q)
      along = carlson_rd(0.0_dp, q, 1.0_dp)
      defect = log(ratio*(along/across))
      if (abs(defect) <= epsilon(q)) exit
      slope = -0.75_dp
      ! The quotient of two differences; near the circle they have no digits, and the slope is that of the circle.
      if (q < 0.999_dp) slope = -1.5_dp + 0.5_dp*((across - along)/(1.0_dp - q))*(1.0_dp/across + q/along)
      if (defect > 0.0_dp) upper = q
      if (defect < 0.0_dp) lower = q
      q = min(max(q*exp(defect/slope), lower), upper)
      if (abs(defect) <= 1.0e-9_dp) exit
    end do
  end function squared_axis_ratio

  !> The cube root of factor load radius/e_star. The exponents are taken apart, because the product may leave the range
  !> of double precision where its root does not.
  elemental function longer_axis(load, radius, e_star, factor) result(long)
    real(dp), intent(in) :: load, radius, e_star, factor
    real(dp) :: long
    integer :: power, third

    power = exponent(load) + exponent(radius) - exponent(e_star)
    third = (power - modulo(power, 3))/3
    long = scale(fraction(load)*fraction(radius)/fraction(e_star)*factor, modulo(power, 3))
    long = scale(cube_root(long), third)
  end function longer_axis

  !> The cube root, with one step of Newton's method because the power rounds its exponent.
  elemental function cube_root(x) result(root)
    real(dp), intent(in) :: x
    real(dp) :: root

    root = x**(1.0_dp/3.0_dp)
    root = root - (root - (x/root)/root)/3.0_dp
  end function cube_root

  pure subroutine check_radius(radius, name, info)
    real(dp), intent(in) :: radius
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info

    if (ieee_is_finite(radius)) then
      if (radius > 0.0_dp) then
        call check_range(radius, name, info)
      else
        call report(info, FUGE_ERR_WIDTH, name//' = '//text(radius)//' is not positive: a Hertzian contact has both' &
                    //' relative radii 1/(1/R_1 + 1/R_2) > 0')
      end if
    else
      call check_finite(radius, name, info)
    end if
  end subroutine check_radius

  pure subroutine check_load(load, info)
    real(dp), intent(in) :: load
    type(fuge_info), intent(inout) :: info

    call check_finite(load, 'load', info)
    if (info%failed()) return
    if (load < 0.0_dp) call report(info, FUGE_ERR_NO_EQUILIBRIUM, 'load = '//text(load) &
      //' is negative: contact forces only push')
    if (load > 0.0_dp .and. load < tiny(load)) then
      call report(info, FUGE_ERR_OVERFLOW, 'load = '//text(load)//' is below '//text(tiny(load)) &
                  //', where double precision loses its digits: choose a smaller unit of force')
    end if
  end subroutine check_load

  pure subroutine check_range(value, name, info)
    real(dp), intent(in) :: value
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info

    if (abs(exponent(value)) > LARGEST_EXPONENT_OF_4) call report(info, FUGE_ERR_OVERFLOW, name//' = '//text(value) &
      //' is out of range: choose other units')
  end subroutine check_range

end module fuge_hertz_theory
