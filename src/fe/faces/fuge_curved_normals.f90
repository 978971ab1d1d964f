!> Normals of the curved surface that a mesh stands for, at the nodes of each face.
!>
!> Each face has normals of its own: at an edge of the body, where faces meet at more than a crease angle, they differ
!> from those of its neighbour, so that the edge stays sharp.
module fuge_curved_normals
  use fuge_corner_normals, only: corner_normal, half_edge_normal, middle_edge_normal, reflected, side_tangent
  use fuge_face_geometry, only: cross, face_nodes, face_normal, frame_across, unit
  use fuge_face_shapes, only: corner_count, node_place, side_ends, EDGE_3
  use fuge_kinds, only: dp
  use fuge_surface_mesh_type, only: face_size, fuge_surface_mesh, get_face
  implicit none
  private

  public :: find_curved_normals, mean_of_faces

  !> Rounding error of the cosine of an angle between faces.
  real(dp), parameter :: ROUNDING = 16.0_dp*epsilon(1.0_dp)
  !> A side leads away from the border of the surface if at least this fraction of its length is across the border.
  real(dp), parameter :: AWAY = 0.3_dp
  !> Length of the sum of two unit vectors along the border, away from each other, above which it has no corner there:
  !> an angle of 120 degrees.
  real(dp), parameter :: ALONG = 1.73_dp
  !> Steps of the Gauss-Newton iteration for a normal at the border.
  integer, parameter :: STEPS = 8
  !> An eigenvalue below this fraction of the other one determines no direction.
  real(dp), parameter :: SMALL = 0.1_dp
  !> A sum of unit normals shorter than this has no direction.
  real(dp), parameter :: NO_DIRECTION = 1.0e-8_dp

  !> Stages in which normals at the border are found: from inside, along the border, at its corners.
  integer, parameter :: INSIDE = 1, BORDER = 2, AT_CORNERS = 3
  !> Most sides from which a normal at the border is found.
  integer, parameter :: MOST_SIDES = 32

  !> The faces around each node: those of node i, and its place in them, are entries begin(i) to begin(i + 1) - 1.
  type :: node_faces
    integer, allocatable :: begin(:), face(:), corner(:)
  end type node_faces

  !> For each corner of each face, (3, most nodes of a face, faces).
  type :: corner_data
    !> The normal of the face there, weighted, and the unit normal of the curved surface.
    real(dp), allocatable :: own(:, :, :), normal(:, :, :)
    !> The two sides at the border of the surface, pointing away from each other: sum of their unit vectors, and of
    !> their tangents (`side_tangent`); zero inside.
    real(dp), allocatable :: border(:, :, :), tangents(:, :, :)
    !> Least cosine of the angle between the normals of faces that continue each other smoothly.
    real(dp) :: least_cosine = 1.0_dp
  end type corner_data

contains

  !> Unit normals, (3, most nodes of a face, faces). `crease`: angle in degrees beyond which faces meet at an edge of
  !> the body. `stat` is not zero without memory.
  pure subroutine find_curved_normals(surface, crease, normal, stat)
    type(fuge_surface_mesh), intent(in) :: surface
    real(dp), intent(in) :: crease
    real(dp), intent(out) :: normal(:, :, :)
    integer, intent(out) :: stat
    type(node_faces) :: around
    type(corner_data) :: data
    integer :: f, k, stage

    data%least_cosine = cos(crease*(acos(-1.0_dp)/180.0_dp)) - ROUNDING
    call list_faces(surface, around, stat)
    associate (most => size(normal, 2), faces => size(normal, 3))
      if (stat == 0) allocate (data%own(3, most, faces), data%normal(3, most, faces), data%border(3, most, faces), &
                               data%tangents(3, most, faces), stat=stat)
    end associate
    if (stat /= 0) return
    call find_own(surface, data)
    do f = 1, size(surface%face, 2)
      do k = 1, corners_of(surface, f)
        call average_corner(surface, around, f, k, data)
      end do
    end do
    normal = data%normal
    do stage = INSIDE, AT_CORNERS
      call continue_borders(surface, around, data, stage, normal)
      data%normal = normal
    end do
    do f = 1, size(surface%face, 2)
      call add_middle_normals(get_face(surface, f), normal(:, :, f))
    end do
  end subroutine find_curved_normals

  !> The mean of the normals of the faces at each node, (3, nodes), of unit length; left alone where there is none.
  pure subroutine mean_of_faces(surface, face_normals, normal, stat)
    type(fuge_surface_mesh), intent(in) :: surface
    real(dp), intent(in) :: face_normals(:, :, :)
    real(dp), intent(inout) :: normal(:, :)
    integer, intent(out) :: stat
    real(dp), allocatable :: total(:, :)
    integer :: f, i, k

    allocate (total(3, size(normal, 2)), stat=stat)
    if (stat /= 0) return
    total = 0.0_dp
    do f = 1, size(surface%face, 2)
      do k = 1, face_size(surface, f)
        i = surface%face(k, f)
        total(:, i) = total(:, i) + face_normals(:, k, f)
      end do
    end do
    do i = 1, size(normal, 2)
      if (norm2(total(:, i)) > NO_DIRECTION) normal(:, i) = unit(total(:, i))
    end do
  end subroutine mean_of_faces

  pure function corners_of(surface, f) result(count)
    type(fuge_surface_mesh), intent(in) :: surface
    integer, intent(in) :: f
    integer :: count
    type(face_nodes) :: face

    face = get_face(surface, f)
    count = corner_count(face%kind)
  end function corners_of

  !> List the faces around each node.
  pure subroutine list_faces(surface, around, stat)
    type(fuge_surface_mesh), intent(in) :: surface
    type(node_faces), intent(out) :: around
    integer, intent(out) :: stat
    integer :: f, i, k

    allocate (around%begin(size(surface%node, 2) + 1), stat=stat)
    if (stat /= 0) return
    around%begin = 0
    do f = 1, size(surface%face, 2)
      do k = 1, corners_of(surface, f)
        associate (count => around%begin(surface%face(k, f)))
          count = count + 1
        end associate
      end do
    end do
    ! The end of each list, from which it is filled downwards.
    around%begin(1) = around%begin(1) + 1
    do i = 2, size(around%begin)
      around%begin(i) = around%begin(i) + around%begin(i - 1)
    end do
    allocate (around%face(around%begin(size(around%begin)) - 1), &
              around%corner(around%begin(size(around%begin)) - 1), stat=stat)
    if (stat /= 0) return
    do f = size(surface%face, 2), 1, -1
      do k = corners_of(surface, f), 1, -1
        associate (begin => around%begin(surface%face(k, f)))
          begin = begin - 1
          around%face(begin) = f
          around%corner(begin) = k
        end associate
      end do
    end do
  end subroutine list_faces

  !> The normal of each face at its corners.
  pure subroutine find_own(surface, data)
    type(fuge_surface_mesh), intent(in) :: surface
    type(corner_data), intent(inout) :: data
    type(face_nodes) :: face
    integer :: f, k

    data%own = 0.0_dp
    data%normal = 0.0_dp
    data%border = 0.0_dp
    data%tangents = 0.0_dp
    do f = 1, size(surface%face, 2)
      face = get_face(surface, f)
      do k = 1, corner_count(face%kind)
        data%own(:, k, f) = corner_normal(face, k)
      end do
    end do
  end subroutine find_own

  !> The normal at corner `k` of face `f`: the mean of the faces around that continue it smoothly.
  pure subroutine average_corner(surface, around, f, k, data)
    type(fuge_surface_mesh), intent(in) :: surface
    type(node_faces), intent(in) :: around
    integer, intent(in) :: f, k
    type(corner_data), intent(inout) :: data
    type(face_nodes) :: face
    real(dp) :: halves(3), normal(3), sides(3, 2)
    integer :: p, quadratic

    normal = 0.0_dp
    halves = 0.0_dp
    quadratic = 0
    do p = around%begin(surface%face(k, f)), around%begin(surface%face(k, f) + 1) - 1
      associate (g => around%face(p), here => around%corner(p))
        if (dot_product(unit(data%own(:, k, f)), unit(data%own(:, here, g))) < data%least_cosine) cycle
        normal = normal + data%own(:, here, g)
        face = get_face(surface, g)
        if (face%kind == EDGE_3) then
          halves = halves + half_edge_normal(face, here)
          quadratic = quadratic + 1
        end if
        call face_sides(face, here, sides)
        ! Of two faces side by side the common side cancels.
        data%border(:, k, f) = data%border(:, k, f) + unit(sides(:, 1)) - unit(sides(:, 2))
        data%tangents(:, k, f) = data%tangents(:, k, f) + sides(:, 1) - sides(:, 2)
      end associate
    end do
    if (.not. norm2(normal) > 0.0_dp) normal = middle_normal(get_face(surface, f))
    data%normal(:, k, f) = unit(normal)
    ! Between two quadratic edges the errors of the circles of each of them and of that through the nodes beside the
    ! corner have opposite signs, and the former are twice as large.
    if (quadratic == 2) data%normal(:, k, f) = unit(unit(normal) + 2.0_dp*unit(halves))
  end subroutine average_corner

  !> Tangents of the sides from corner `k` to the next one and to the one before, divided by their lengths. In the plane
  !> the second one is, and so is the difference of the two, across the plane where there is an edge on one side only.
  pure subroutine face_sides(face, k, sides)
    type(face_nodes), intent(in) :: face
    integer, intent(in) :: k
    real(dp), intent(out) :: sides(3, 2)
    integer :: count

    count = corner_count(face%kind)
    if (face%kind <= EDGE_3) then
      ! As of a strip of quadrangles that is infinitely long in the third direction on both sides.
      sides(:, 1) = [0.0_dp, 0.0_dp, real(2*k - 3, dp)]
      sides(:, 2) = -sides(:, 1)
    else
      sides(:, 1) = side_tangent(face, k, modulo(k, count) + 1)
      sides(:, 2) = side_tangent(face, k, modulo(k - 2, count) + 1)
    end if
  end subroutine face_sides

  !> The sum of the unit normals at all nodes of a face, for a corner of 180 degrees, which has no normal of its own.
  pure function middle_normal(face) result(normal)
    type(face_nodes), intent(in) :: face
    real(dp) :: normal(3)
    integer :: k

    normal = 0.0_dp
    do k = 1, face%count
      normal = normal + unit(face_normal(face, node_place(face%kind, k)))
    end do
  end function middle_normal

  !> At the border of a surface of linear faces the mean of the faces is that of one side only. There the normal follows
  !> from others: sides that lead to nodes where it is known are arcs of circles. So the normal lies in a plane of
  !> symmetry at which the mesh ends. First from nodes inside; then, where no side leads to one, from nodes of the
  !> border; last at corners of the border.
  pure subroutine continue_borders(surface, around, data, stage, normal)
    type(fuge_surface_mesh), intent(in) :: surface
    type(node_faces), intent(in) :: around
    type(corner_data), intent(in) :: data
    integer, intent(in) :: stage
    real(dp), intent(inout) :: normal(:, :, :)
    real(dp) :: sides(3, MOST_SIDES), others(3, MOST_SIDES)
    integer :: count, f, k

    do f = 1, size(surface%face, 2)
      if (face_size(surface, f) > corners_of(surface, f)) cycle
      do k = 1, corners_of(surface, f)
        if (norm2(data%border(:, k, f)) < AWAY) cycle
        if (norm2(data%border(:, k, f)) > ALONG .eqv. stage == AT_CORNERS) cycle
        call find_sides(surface, around, data, f, k, INSIDE, sides, others, count)
        if (count > 0 .and. stage == BORDER) cycle
        if (stage > INSIDE) call find_sides(surface, around, data, f, k, stage, sides, others, count)
        if (count > 0) call continue_border(data%tangents(:, k, f), sides(:, :count), others(:, :count), stage, &
                                            normal(:, k, f))
      end do
    end do
  end subroutine continue_borders

  !> Sides, unit vectors, that lead from corner `k` of face `f` to where the normal is known, and that normal. The
  !> arguments are nine, because both known normals and their sides are results.
  pure subroutine find_sides(surface, around, data, f, k, stage, sides, others, count)
    type(fuge_surface_mesh), intent(in) :: surface
    type(node_faces), intent(in) :: around
    type(corner_data), intent(in) :: data
    integer, intent(in) :: f, k, stage
    real(dp), intent(out) :: sides(3, MOST_SIDES), others(3, MOST_SIDES)
    integer, intent(out) :: count
    type(face_nodes) :: face
    real(dp) :: side(3)
    integer :: corners, end, p, turn

    count = 0
    sides = 0.0_dp
    others = 0.0_dp
    do p = around%begin(surface%face(k, f)), around%begin(surface%face(k, f) + 1) - 1
      associate (here => around%corner(p), g => around%face(p))
        if (dot_product(unit(data%own(:, k, f)), unit(data%own(:, here, g))) < data%least_cosine) cycle
        face = get_face(surface, g)
        corners = corner_count(face%kind)
        do turn = 1, corners - 1, max(corners - 2, 1)
          end = modulo(here + turn - 1, corners) + 1
          side = unit(face%x(:, end) - face%x(:, here))
          if (count == MOST_SIDES .or. .not. is_known(data%normal(:, k, f), data%border(:, k, f), &
                                                      data%border(:, end, g), side, stage)) cycle
          count = count + 1
          sides(:, count) = side
          others(:, count) = data%normal(:, end, g)
        end do
      end associate
    end do
  end subroutine find_sides

  !> Does a side lead away from the border, to where the normal along it is known? `here` and `there` are along the
  !> border at both ends, zero inside.
  pure function is_known(normal, here, there, side, stage) result(known)
    real(dp), intent(in) :: normal(3), here(3), there(3), side(3)
    integer, intent(in) :: stage
    logical :: known

    select case (stage)
    case (INSIDE)
      known = norm2(there) < AWAY
    case (BORDER)
      known = abs(dot_product(unit(cross(normal, there)), side)) <= 0.5_dp
    case default
      known = norm2(there) < AWAY .or. norm2(there) > ALONG
    end select
    known = known .and. abs(dot_product(unit(cross(normal, here)), side)) >= AWAY
  end function is_known

  !> The normal at the border by the Gauss-Newton method. Where on a straight border the sides do not determine it, it
  !> changes across the sum of the tangents, which on a sphere is where the mean errs.
  pure subroutine continue_border(tangents, sides, others, stage, normal)
    real(dp), intent(in) :: tangents(3), sides(:, :), others(:, :)
    integer, intent(in) :: stage
    real(dp), intent(inout) :: normal(3)
    real(dp) :: across_border(3), change(3), matrix(3, 3), rest(3)
    integer :: k, step
    logical :: both

    matrix = matmul(sides, transpose(sides))
    do step = 1, STEPS
      rest = 0.0_dp
      do k = 1, size(sides, 2)
        rest = rest - sides(:, k)*dot_product(sides(:, k), normal + others(:, k))
      end do
      call least_change(matrix, rest, normal, change, both)
      across_border = unit(cross(normal, tangents))
      if (stage /= AT_CORNERS .and. .not. both) change = across_border*dot_product(across_border, rest) &
        /dot_product(across_border, matmul(matrix, across_border))
      normal = unit(normal + change)
      if (norm2(change) <= epsilon(1.0_dp)) exit
    end do
  end subroutine continue_border

  !> The shortest vector x across `normal` with matrix x = rest there, or nearest to it, for a matrix that has no
  !> negative eigenvalue. `both` is false, and x is in one direction only, where this has just one eigenvalue that is
  !> not small.
  pure subroutine least_change(matrix, rest, normal, x, both)
    real(dp), intent(in) :: matrix(3, 3), rest(3), normal(3)
    real(dp), intent(out) :: x(3)
    logical, intent(out) :: both
    real(dp) :: frame(3, 2), flat(2, 2), half, mean, radius, direction(3)

    x = 0.0_dp
    both = .false.
    frame = frame_across(normal)
    flat = matmul(transpose(frame), matmul(matrix, frame))
    mean = 0.5_dp*(flat(1, 1) + flat(2, 2))
    radius = hypot(0.5_dp*(flat(1, 1) - flat(2, 2)), flat(1, 2))
    if (.not. mean > 0.0_dp) return
    ! The direction of the larger eigenvalue, and the one across it.
    half = 0.5_dp*atan2(flat(1, 2), 0.5_dp*(flat(1, 1) - flat(2, 2)))
    direction = matmul(frame, [cos(half), sin(half)])
    x = direction*dot_product(direction, rest)/(mean + radius)
    both = mean - radius >= SMALL*(mean + radius)
    if (.not. both) return
    direction = matmul(frame, [-sin(half), cos(half)])
    x = x + direction*dot_product(direction, rest)/(mean - radius)
  end subroutine least_change

  !> The normals at the middle nodes: each half of a side is an arc of a circle.
  pure subroutine add_middle_normals(face, normal)
    type(face_nodes), intent(in) :: face
    real(dp), intent(inout) :: normal(:, :)
    integer :: ends(2), k

    do k = corner_count(face%kind) + 1, face%count
      ends = side_ends(face%kind, k)
      normal(:, k) = unit(reflected(normal(:, ends(1)), face%x(:, k) - face%x(:, ends(1))) &
                          + reflected(normal(:, ends(2)), face%x(:, k) - face%x(:, ends(2))))
    end do
    ! That of the circle errs by as much, to the other side.
    if (face%kind == EDGE_3) normal(:, 3) = unit(normal(:, 3) + unit(middle_edge_normal(face)))
  end subroutine add_middle_normals

end module fuge_curved_normals
