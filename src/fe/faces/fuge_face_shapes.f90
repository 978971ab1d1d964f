!> Shape functions of the faces of linear and quadratic finite elements.
!>
!> Corners come first, then the nodes at the middle of the sides: the one between corners 1 and 2, between 2 and 3, and
!> so on. The place in an edge is xi in [-1, 1]; in a triangle (xi, eta) with xi, eta >= 0 and xi + eta <= 1, where
!> corner 1 is (0, 0), corner 2 (1, 0) and corner 3 (0, 1); in a quadrangle (xi, eta) in [-1, 1]^2, where corner 1 is
!> (-1, -1) and corner 2 (1, -1).
module fuge_face_shapes
  use fuge_kinds, only: dp
  implicit none
  private

  public :: corner_count, face_kind, kind_nodes, lies_inside, middle_place, middle_share, node_place, &
    shape_slopes, shape_values, side_ends

  integer, parameter, public :: NO_FACE = 0, EDGE_2 = 1, EDGE_3 = 2, TRIANGLE_3 = 3, QUADRANGLE_4 = 4, TRIANGLE_6 = 5, &
    QUADRANGLE_8 = 6
  !> Most nodes of a face.
  integer, parameter, public :: MOST_NODES = 8

  integer, parameter :: NODES(NO_FACE:QUADRANGLE_8) = [0, 2, 3, 3, 4, 6, 8]
  integer, parameter :: CORNERS(NO_FACE:QUADRANGLE_8) = [0, 2, 2, 3, 4, 3, 4]
  !> Places of the corners of a quadrangle.
  real(dp), parameter :: XI(4) = [-1.0_dp, 1.0_dp, 1.0_dp, -1.0_dp], ETA(4) = [-1.0_dp, -1.0_dp, 1.0_dp, 1.0_dp]

contains

  !> The kind of a face of `count` nodes, or NO_FACE.
  pure function face_kind(dimensions, count) result(kind)
    integer, intent(in) :: dimensions, count
    integer :: kind

    kind = NO_FACE
    if (dimensions == 2) then
      if (count == 2) kind = EDGE_2
      if (count == 3) kind = EDGE_3
    else
      if (count == 3) kind = TRIANGLE_3
      if (count == 4) kind = QUADRANGLE_4
      if (count == 6) kind = TRIANGLE_6
      if (count == 8) kind = QUADRANGLE_8
    end if
  end function face_kind

  pure function kind_nodes(kind) result(count)
    integer, intent(in) :: kind
    integer :: count

    count = NODES(kind)
  end function kind_nodes

  pure function corner_count(kind) result(count)
    integer, intent(in) :: kind
    integer :: count

    count = CORNERS(kind)
  end function corner_count

  !> The corners between which node `k`, beyond the corners, lies.
  pure function side_ends(kind, k) result(ends)
    integer, intent(in) :: kind, k
    integer :: ends(2)

    ends(1) = k - CORNERS(kind)
    ends(2) = modulo(ends(1), CORNERS(kind)) + 1
  end function side_ends

  !> The share of a middle node's shape function that goes to each of the two corners beside it, to make shape functions
  !> with positive integrals: N_corner + share (N_middle + N_middle'), and (1 - 2 share) N_middle.
  !>
  !> With 1/4 those of edges and triangles are Bernstein's polynomials, which are nowhere negative; of a quadrangle of 8
  !> nodes only the integrals over the whole face are positive. (B. Wohlmuth, A. Popp, M. Gee, W. Wall: An abstract
  !> framework for a priori estimates for contact problems in 3D with quadratic finite elements, Computational Mechanics
  !> 49, 2012, have 1/5.)
  pure function middle_share(kind) result(share)
    integer, intent(in) :: kind
    real(dp) :: share

    select case (kind)
    case (EDGE_3, TRIANGLE_6, QUADRANGLE_8)
      share = 0.25_dp
    case default
      share = 0.0_dp
    end select
  end function middle_share

  !> The middle of a face.
  pure function middle_place(kind) result(place)
    integer, intent(in) :: kind
    real(dp) :: place(2)

    place = 0.0_dp
    if (CORNERS(kind) == 3) place = 1.0_dp/3.0_dp
  end function middle_place

  !> The place of node `k` of a face.
  pure function node_place(kind, k) result(place)
    integer, intent(in) :: kind, k
    real(dp) :: place(2)
    integer :: ends(2)

    if (k > CORNERS(kind)) then
      if (kind == EDGE_3) then
        place = 0.0_dp
        return
      end if
      ends = side_ends(kind, k)
      place = 0.5_dp*corner_place(kind, ends(1)) + 0.5_dp*corner_place(kind, ends(2))
    else
      place = corner_place(kind, k)
    end if
  end function node_place

  pure function corner_place(kind, k) result(place)
    integer, intent(in) :: kind, k
    real(dp) :: place(2)

    select case (CORNERS(kind))
    case (2)
      place = [XI(k), 0.0_dp]
    case (3)
      place = [merge(1.0_dp, 0.0_dp, k == 2), merge(1.0_dp, 0.0_dp, k == 3)]
    case default
      place = [XI(k), ETA(k)]
    end select
  end function corner_place

  !> Does a place lie in the face, or beside it by at most `tolerance`?
  pure function lies_inside(kind, place, tolerance) result(inside)
    integer, intent(in) :: kind
    real(dp), intent(in) :: place(2), tolerance
    logical :: inside

    select case (kind)
    case (EDGE_2, EDGE_3)
      inside = abs(place(1)) <= 1.0_dp + tolerance
    case (TRIANGLE_3, TRIANGLE_6)
      inside = min(place(1), place(2), 1.0_dp - place(1) - place(2)) >= -tolerance
    case default
      inside = max(abs(place(1)), abs(place(2))) <= 1.0_dp + tolerance
    end select
  end function lies_inside

  !> Shape functions at a place; those of nodes that the face does not have are zero.
  pure function shape_values(kind, place) result(values)
    integer, intent(in) :: kind
    real(dp), intent(in) :: place(2)
    real(dp) :: values(MOST_NODES)

    values = 0.0_dp
    associate (s => place(1), t => place(2))
      select case (kind)
      case (EDGE_2)
        values(:2) = [0.5_dp*(1.0_dp - s), 0.5_dp*(1.0_dp + s)]
      case (EDGE_3)
        values(:3) = [0.5_dp*s*(s - 1.0_dp), 0.5_dp*s*(s + 1.0_dp), (1.0_dp - s)*(1.0_dp + s)]
      case (TRIANGLE_3)
        values(:3) = [1.0_dp - s - t, s, t]
      case (QUADRANGLE_4)
        values(:4) = 0.25_dp*(1.0_dp + XI*s)*(1.0_dp + ETA*t)
      case (TRIANGLE_6)
        associate (r => 1.0_dp - s - t)
          values(:6) = [r*(2.0_dp*r - 1.0_dp), s*(2.0_dp*s - 1.0_dp), t*(2.0_dp*t - 1.0_dp), &
                        4.0_dp*r*s, 4.0_dp*s*t, 4.0_dp*t*r]
        end associate
      case (QUADRANGLE_8)
        values(:4) = 0.25_dp*(1.0_dp + XI*s)*(1.0_dp + ETA*t)*(XI*s + ETA*t - 1.0_dp)
        values(5:) = 0.5_dp*[(1.0_dp - s**2)*(1.0_dp - t), (1.0_dp + s)*(1.0_dp - t**2), &
                             (1.0_dp - s**2)*(1.0_dp + t), (1.0_dp - s)*(1.0_dp - t**2)]
      end select
    end associate
  end function shape_values

  !> Derivatives of the shape functions with respect to the place.
  pure function shape_slopes(kind, place) result(slopes)
    integer, intent(in) :: kind
    real(dp), intent(in) :: place(2)
    real(dp) :: slopes(MOST_NODES, 2)

    slopes = 0.0_dp
    associate (s => place(1), t => place(2))
      select case (kind)
      case (EDGE_2)
        slopes(:2, 1) = [-0.5_dp, 0.5_dp]
      case (EDGE_3)
        slopes(:3, 1) = [s - 0.5_dp, s + 0.5_dp, -2.0_dp*s]
      case (TRIANGLE_3)
        slopes(:3, 1) = [-1.0_dp, 1.0_dp, 0.0_dp]
        slopes(:3, 2) = [-1.0_dp, 0.0_dp, 1.0_dp]
      case (QUADRANGLE_4)
        slopes(:4, 1) = 0.25_dp*XI*(1.0_dp + ETA*t)
        slopes(:4, 2) = 0.25_dp*ETA*(1.0_dp + XI*s)
      case (TRIANGLE_6)
        associate (r => 1.0_dp - s - t)
          slopes(:6, 1) = [1.0_dp - 4.0_dp*r, 4.0_dp*s - 1.0_dp, 0.0_dp, 4.0_dp*(r - s), 4.0_dp*t, -4.0_dp*t]
          slopes(:6, 2) = [1.0_dp - 4.0_dp*r, 0.0_dp, 4.0_dp*t - 1.0_dp, -4.0_dp*s, 4.0_dp*s, 4.0_dp*(r - t)]
        end associate
      case (QUADRANGLE_8)
        slopes(:4, 1) = 0.25_dp*XI*(1.0_dp + ETA*t)*(2.0_dp*XI*s + ETA*t)
        slopes(:4, 2) = 0.25_dp*ETA*(1.0_dp + XI*s)*(2.0_dp*ETA*t + XI*s)
        slopes(5:, 1) = [-s*(1.0_dp - t), 0.5_dp*(1.0_dp - t**2), -s*(1.0_dp + t), -0.5_dp*(1.0_dp - t**2)]
        slopes(5:, 2) = [-0.5_dp*(1.0_dp - s**2), -t*(1.0_dp + s), 0.5_dp*(1.0_dp - s**2), -t*(1.0_dp - s)]
      end select
    end associate
  end function shape_slopes

end module fuge_face_shapes
