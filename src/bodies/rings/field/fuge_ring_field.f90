!> The field of a force that is spread as uniform pressure over a ring.
!>
!> It is that of circles (`fuge_circle_field`), integrated over the width of the ring on panels that shrink towards the
!> point: all terms of one-signed integrals have one sign, so that no digit is lost close to the surface or far away.
module fuge_ring_field
  use fuge_axial_field, only: INTEGRALS, surface_field
  use fuge_circle_field, only: circle_field, circle_rules, new_circle_rules
  use fuge_constants, only: PI
  use fuge_graded_panels, only: new_panel_rules, next_panel, panel_rules
  use fuge_kinds, only: dp
  use fuge_ring_kernel, only: new_ring_kernel, ring_kernel, ring_value
  implicit none
  private

  public :: new_ring_rules, ring_field

  !> Quadrature rules.
  type, public :: ring_rules
    private
    type(panel_rules) :: panels
    type(circle_rules) :: circles
    type(ring_kernel) :: surface
  end type ring_rules

  !> Depths below 2**LEAST_DEPTH of the largest length count as that: their field is that of the surface, but beside an
  !> edge.
  integer, parameter :: LEAST_DEPTH = -200

contains

  pure function new_ring_rules() result(rules)
    type(ring_rules) :: rules

    rules%panels = new_panel_rules()
    rules%circles = new_circle_rules()
    rules%surface = new_ring_kernel()
  end function new_ring_rules

  !> The integrals of `fuge_axial_field` for a unit force on the ring from `inner` to `outer`, at `r`, `z` >= 0.
  !>
  !> The largest of the lengths is between 1/2 and 1. At z = 0 they are the limits from inside; at an edge of the ring
  !> those of the sides in the mean.
  pure function ring_field(rules, inner, outer, r, z) result(field)
    type(ring_rules), intent(in) :: rules
    real(dp), intent(in) :: inner, outer, r, z
    real(dp) :: field(INTEGRALS)
    real(dp) :: depth

    if (.not. z > 0.0_dp) then
      field = field_at_surface(rules, inner, outer, r)
      return
    end if
    depth = max(z, scale(1.0_dp, LEAST_DEPTH))
    field = 0.0_dp
    if (r < outer) call add_circles(rules, max(inner, r), 1.0_dp, outer, r, depth, field)
    if (r > inner) call add_circles(rules, min(outer, r), -1.0_dp, inner, r, depth, field)
    field = field/(0.5_dp*(inner + outer)*(outer - inner))
  end function ring_field

  !> Add the circles from radius `first`, the closest to the point, to radius `last`, times the radius.
  !> `direction` 1 or -1: outwards or inwards.
  pure subroutine add_circles(rules, first, direction, last, r, z, field)
    type(ring_rules), intent(in) :: rules
    real(dp), intent(in) :: first, direction, last, r, z
    real(dp), intent(inout) :: field(INTEGRALS)
    real(dp) :: left, right, length, distance, place
    integer :: k, nodes

    length = abs(last - first)
    distance = abs(first - r)
    left = 0.0_dp
    do while (left < length)
      call next_panel(rules%panels, left, length, distance, z, right, nodes)
      do k = 1, nodes
        place = left + (right - left)*rules%panels%node(k, nodes)
        associate (s => first + direction*place)
          field = field + (right - left)*rules%panels%weight(k, nodes)*s &
                  *circle_field(rules%circles, s, r, z, direction*(distance + place))
        end associate
      end do
      left = right
    end do
  end subroutine add_circles

  !> The limits at the surface.
  pure function field_at_surface(rules, inner, outer, r) result(field)
    type(ring_rules), intent(in) :: rules
    real(dp), intent(in) :: inner, outer, r
    real(dp) :: field(INTEGRALS)
    real(dp) :: pressure, spread

    pressure = 1.0_dp/(PI*(outer - inner)*(outer + inner))
    if (r >= outer) then
      spread = 1.0_dp/r**2
    else if (r > inner) then
      spread = PI*pressure
      if (inner > 0.0_dp) spread = spread*((r - inner)/r)*((r + inner)/r)
    else
      spread = 0.0_dp
      if (.not. inner > 0.0_dp) spread = PI*pressure
    end if
    if (r > outer .or. r < inner) then
      pressure = 0.0_dp
    else if (.not. (r < outer .and. (r > inner .or. .not. inner > 0.0_dp))) then
      pressure = 0.5_dp*pressure
    end if
    field = surface_field(pressure, spread, ring_value(rules%surface, r, [inner, outer]))
  end function field_at_surface

end module fuge_ring_field
