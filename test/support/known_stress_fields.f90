!> Fields of stress in closed form, for the search for the largest one.
module known_stress_fields
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info
  use fuge_stress_field, only: stress_field
  implicit none
  private

  public :: hertz_line, hertz_sphere

  !> Cylinders side by side on a half-plane in plane strain, each with its middle, half width and largest pressure.
  type, extends(stress_field), public :: cylinders
    real(dp) :: poisson = 0.3_dp
    real(dp), allocatable :: middle(:), half_width(:), pressure(:)
    !> Places asked for so far, if they are counted.
    integer, pointer :: places => null()
  contains
    procedure :: find_stress => cylinder_stresses
  end type cylinders

  !> Spheres side by side on a half-space, far apart: each place is under the nearest one only.
  type, extends(stress_field), public :: spheres
    real(dp) :: poisson = 0.3_dp
    real(dp), allocatable :: middle(:, :), radius(:), pressure(:)
  contains
    procedure :: find_stress => sphere_stresses
  end type spheres

  !> Principal stresses along the axes that are two hills: their Tresca stress is the higher one of both.
  type, extends(stress_field), public :: two_hills
    real(dp) :: top(2) = 1.0_dp, place(2, 2) = 0.0_dp, curvature(2) = 1.0_dp
  contains
    procedure :: find_stress => hill_stresses
  end type two_hills

contains

  subroutine cylinder_stresses(self, place, below, values, info)
    class(cylinders), intent(in) :: self
    real(dp), intent(in) :: place(:, :)
    logical, intent(in) :: below(:)
    real(dp), intent(inout) :: values(:, :)
    type(fuge_info), intent(out) :: info
    real(dp) :: plane(3)
    integer :: j, k

    do k = 1, size(below)
      plane = 0.0_dp
      do j = 1, size(self%middle)
        plane = plane + self%pressure(j)*hertz_line((place(1, k) - self%middle(j))/self%half_width(j), &
                                                     place(3, k)/self%half_width(j))
      end do
      values(:, k) = [plane(1), self%poisson*(plane(1) + plane(2)), plane(2), 0.0_dp, plane(3), 0.0_dp]
    end do
    if (associated(self%places)) self%places = self%places + size(below)
  end subroutine cylinder_stresses

  !> xx, zz, xz under a cylinder over its largest pressure; x and z over its half width (E. McEwen 1949; K. L. Johnson,
  !> Contact Mechanics, 1985, equation 4.49).
  pure function hertz_line(x, z) result(stress)
    real(dp), intent(in) :: x, z
    real(dp) :: stress(3)
    real(dp) :: root, part, m, n

    part = 1.0_dp - x**2 + z**2
    root = hypot(part, 2.0_dp*x*z)
    stress = 0.0_dp
    if (.not. root > 0.0_dp) return
    ! Without a difference: m n = x z.
    if (part >= 0.0_dp) then
      m = sqrt(0.5_dp*(root + part))
      n = x*z/m
    else
      n = sign(sqrt(0.5_dp*(root - part)), x)
      m = x*z/n
    end if
    stress(1) = -(m*(1.0_dp + (z**2 + n**2)/(m**2 + n**2)) - 2.0_dp*z)
    stress(2) = -m*(1.0_dp - (z**2 + n**2)/(m**2 + n**2))
    stress(3) = -n*(m**2 - z**2)/(m**2 + n**2)
  end function hertz_line

  subroutine sphere_stresses(self, place, below, values, info)
    class(spheres), intent(in) :: self
    real(dp), intent(in) :: place(:, :)
    logical, intent(in) :: below(:)
    real(dp), intent(inout) :: values(:, :)
    type(fuge_info), intent(out) :: info
    real(dp) :: about(4), distance(size(self%radius)), r, c, s
    integer :: j, k

    do k = 1, size(below)
      distance = hypot(place(1, k) - self%middle(1, :), place(2, k) - self%middle(2, :))
      j = minloc(distance, dim=1)
      r = distance(j)
      c = 1.0_dp
      s = 0.0_dp
      if (r > 0.0_dp) then
        c = (place(1, k) - self%middle(1, j))/r
        s = (place(2, k) - self%middle(2, j))/r
      end if
      about = self%pressure(j)*hertz_sphere(r/self%radius(j), place(3, k)/self%radius(j), self%poisson)
      values(:, k) = [about(1)*c**2 + about(2)*s**2, about(1)*s**2 + about(2)*c**2, about(3), about(4)*s, &
                      about(4)*c, (about(1) - about(2))*s*c]
    end do
  end subroutine sphere_stresses

  !> rr, tt, zz, rz under a sphere over its largest pressure; r and z over the radius of the contact (M. T. Huber 1904).
  !> With r**2/(1 + u) + z**2/u = 1 nothing cancels at the axis or at the surface.
  pure function hertz_sphere(r, z, poisson) result(stress)
    real(dp), intent(in) :: r, z, poisson
    real(dp) :: stress(4)
    real(dp) :: part, u, t, ring, angle

    part = r**2 + z**2 - 1.0_dp
    u = 0.5_dp*(abs(part) + hypot(part, 2.0_dp*z))
    if (part < 0.0_dp) u = z**2/u
    t = sqrt(max(0.0_dp, 1.0_dp - r**2/(1.0_dp + u)))
    ! The same without a difference.
    if (u > 0.0_dp) t = z/sqrt(u)
    ring = (1.0_dp - 2.0_dp*poisson)/3.0_dp*(1.0_dp + t + t**2)/((1.0_dp + t)*(1.0_dp + u))
    angle = (1.0_dp + poisson)*sqrt(u)*atan2(1.0_dp, sqrt(u))
    stress(3) = -t**3/max(tiny(1.0_dp), u + t**2)
    stress(1) = ring - stress(3) + t*(u*(1.0_dp - poisson)/(1.0_dp + u) + angle - 2.0_dp)
    stress(2) = -ring - t*(2.0_dp*poisson + u*(1.0_dp - poisson)/(1.0_dp + u) - angle)
    stress(4) = -r*t**2/max(tiny(1.0_dp), u + t**2)*sqrt(u)/(1.0_dp + u)
  end function hertz_sphere

  subroutine hill_stresses(self, place, below, values, info)
    class(two_hills), intent(in) :: self
    real(dp), intent(in) :: place(:, :)
    logical, intent(in) :: below(:)
    real(dp), intent(inout) :: values(:, :)
    type(fuge_info), intent(out) :: info
    integer :: j

    values = 0.0_dp
    if (size(below) == 0) return
    do j = 1, 2
      values(j, :) = self%top(j)/(1.0_dp + self%curvature(j)*((place(1, :) - self%place(1, j))**2 &
                                                              + (place(3, :) - self%place(2, j))**2))
    end do
  end subroutine hill_stresses

end module known_stress_fields
