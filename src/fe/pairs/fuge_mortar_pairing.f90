!> Pairs by the dual mortar method: the contact condition of a node is the gap weighted with its dual shape function.
!>
!> With psi_A the dual functions of the contact surface (`fuge_dual_basis`), N'_B shape functions with
!> positive integrals and N_C those of the opposite surface, the gap of node A is the integral of psi_A times the gap,
!> divided by that of psi_A, which is the area of the node. A force f_A is then the pressure f_A psi_A / area_A, and as
!> the psi_A have the sum 1, a uniform pressure is among them: the method passes the patch test (A. Popp, M. Gitterle,
!> M. Gee, W. Wall: A dual mortar approach for 3D finite deformation contact, International Journal for Numerical
!> Methods in Engineering 83, 2010; with quadratic faces A. Popp, B. Wohlmuth, M. Gee, W. Wall, SIAM Journal on
!> Scientific Computing 34, 2012).
module fuge_mortar_pairing
  use fuge_dual_basis, only: dual_coefficients
  use fuge_face_geometry, only: face_nodes, face_normal, find_across, frame_across, unit
  use fuge_face_moments, only: add_moments, face_moments, nowhere_negative, unmixed
  use fuge_face_segments, only: clip_convex, convex_polygon, face_pieces, polygon_area, MOST_PIECES
  use fuge_face_shapes, only: middle_place, MOST_NODES
  use fuge_kinds, only: dp
  use fuge_opposite_faces, only: face_radius, opposite_faces, FACING
  use fuge_pair_draft_type, only: pair_draft
  use fuge_surface_mesh_type, only: fuge_surface_mesh, get_face
  use fuge_weight_rows, only: add_weight
  implicit none
  private

  public :: pair_faces

  !> A face counts as without an opposite if less than this fraction of it has one.
  real(dp), parameter :: SMALLEST_PART = 1.0e-6_dp
  !> Twice the largest coefficient of the dual functions of a whole face of each kind. Parts that need larger ones are
  !> weighted with functions that are nowhere negative instead: these pass the patch test as well, but the gaps of such
  !> nodes depend on the displacements of their neighbours too.
  real(dp), parameter :: LARGEST(6) = [4.0_dp, 14.0_dp, 6.0_dp, 8.0_dp, 22.0_dp, 30.0_dp]
  !> Common parts that overlap by more than this fraction of the face lie in layers, of which the nearest one counts.
  real(dp), parameter :: OVERLAP = 1.0e-6_dp

  !> The common part of a face and an opposite one.
  type :: face_part
    integer :: face = 0
    real(dp) :: distance = 0.0_dp
    type(convex_polygon) :: shape
  end type face_part

contains

  !> Weigh the opposite surface at all nodes of `contact`. `stat` is not zero without memory.
  pure subroutine pair_faces(contact, opposite, faces, draft, stat)
    type(fuge_surface_mesh), intent(in) :: contact, opposite
    type(opposite_faces), intent(in) :: faces
    type(pair_draft), intent(inout) :: draft
    integer, intent(out) :: stat
    type(face_part), allocatable :: parts(:)
    integer, allocatable :: near(:)
    integer :: count, f

    allocate (near(64), parts(64), stat=stat)
    do f = 1, size(contact%face, 2)
      if (stat /= 0) return
      call find_parts(contact, opposite, faces, f, near, parts, count, draft%alike, stat)
      if (stat == 0 .and. count > 0) call weigh_face(contact, opposite, faces, f, parts(:count), draft, &
                                                        stat)
    end do
  end subroutine pair_faces

  !> The parts of face `f` that have an opposite, `parts(:count)`. The arguments are nine, because the work space of
  !> all faces is the caller's.
  pure subroutine find_parts(contact, opposite, faces, f, near, parts, count, alike, stat)
    type(fuge_surface_mesh), intent(in) :: contact, opposite
    type(opposite_faces), intent(in) :: faces
    integer, intent(in) :: f
    integer, allocatable, intent(inout) :: near(:)
    type(face_part), allocatable, intent(inout) :: parts(:)
    integer, intent(out) :: count
    integer, intent(inout) :: alike(2), stat
    type(face_nodes) :: face
    type(convex_polygon) :: own(MOST_PIECES)
    real(dp) :: direction(3), frame(3, 2), middle(3), whole, covered
    integer :: k, nears, pieces

    face = get_face(contact, f)
    middle = sum(face%x(:, :face%count), 2)/real(face%count, dp)
    direction = unit(face_normal(face, middle_place(face%kind)))
    frame = frame_across(direction)
    call face_pieces(face, frame, own, pieces)
    whole = 0.0_dp
    do k = 1, pieces
      whole = whole + polygon_area(own(k))
    end do
    count = 0
    call faces%tree%find(middle - faces%reach*direction, 2.0_dp*faces%reach*direction, face_radius(face, middle), &
                         near, nears, stat)
    if (stat /= 0) return
    call sort_upwards(near(:nears))
    do k = 1, nears
      if (dot_product(direction, faces%normal(:, near(k))) >= FACING .and. &
          (alike(1) /= 0 .or. dot_product(direction, faces%normal(:, near(k))) <= -FACING)) cycle
      call add_parts(get_face(opposite, near(k)), near(k), faces%reach, face, direction, frame, own(:pieces), parts, &
                     count, stat)
      if (stat /= 0) return
      if (dot_product(direction, faces%normal(:, near(k))) > 0.0_dp) then
        if (count > 0) then
          if (parts(count)%face == near(k)) alike = [f, near(k)]
        end if
        do while (count > 0)
          if (parts(count)%face /= near(k)) exit
          count = count - 1
        end do
      end if
    end do
    covered = 0.0_dp
    do k = 1, count
      covered = covered + polygon_area(parts(k)%shape)
    end do
    if (covered > (1.0_dp + OVERLAP)*whole) call keep_nearest(OVERLAP*whole, parts, count)
    if (covered < SMALLEST_PART*whole) count = 0
  end subroutine find_parts

  !> Add the common parts of one face and one opposite. The arguments are ten, because a common part is known from
  !> both faces and their frame.
  pure subroutine add_parts(other, number, reach, face, direction, frame, own, parts, count, stat)
    type(face_nodes), intent(in) :: other, face
    integer, intent(in) :: number
    real(dp), intent(in) :: reach, direction(3), frame(3, 2)
    type(convex_polygon), intent(in) :: own(:)
    type(face_part), allocatable, intent(inout) :: parts(:)
    integer, intent(inout) :: count, stat
    type(convex_polygon) :: others(MOST_PIECES), part
    real(dp) :: middle(3), place(2), here, there
    integer :: i, j, pieces
    logical :: found(2)

    call face_pieces(other, frame, others, pieces)
    do j = 1, pieces
      do i = 1, size(own)
        part = clip_convex(own(i), others(j))
        if (part%count < 2) cycle
        middle = matmul(frame, sum(part%corner(:, :part%count), 2)/real(part%count, dp))
        call find_across(face, middle, direction, place, here, found(1))
        call find_across(other, middle, direction, place, there, found(2))
        if (.not. all(found) .or. abs(there - here) > reach) cycle
        if (count >= size(parts)) call lengthen(parts, stat)
        if (stat /= 0) return
        count = count + 1
        parts(count) = face_part(number, abs(there - here), part)
      end do
    end do
  end subroutine add_parts

  !> Of parts that overlap by more than `allowed` keep the nearest.
  pure subroutine keep_nearest(allowed, parts, count)
    real(dp), intent(in) :: allowed
    type(face_part), intent(inout) :: parts(:)
    integer, intent(inout) :: count
    type(face_part) :: part
    integer :: i, k, kept
    logical :: free

    ! Few parts: ordered by insertion.
    do k = 2, count
      part = parts(k)
      i = k - 1
      do while (i > 0)
        if (parts(i)%distance <= part%distance) exit
        parts(i + 1) = parts(i)
        i = i - 1
      end do
      parts(i + 1) = part
    end do
    kept = 0
    do k = 1, count
      free = .true.
      do i = 1, kept
        free = free .and. polygon_area(clip_convex(parts(k)%shape, parts(i)%shape)) <= allowed
      end do
      if (.not. free) cycle
      kept = kept + 1
      parts(kept) = parts(k)
    end do
    count = kept
  end subroutine keep_nearest

  !> Integrate over the parts of a face and add to the weights of its nodes.
  pure subroutine weigh_face(contact, opposite, faces, f, parts, draft, stat)
    type(fuge_surface_mesh), intent(in) :: contact, opposite
    type(opposite_faces), intent(in) :: faces
    integer, intent(in) :: f
    type(face_part), intent(in) :: parts(:)
    type(pair_draft), intent(inout) :: draft
    integer, intent(inout) :: stat
    type(face_moments), allocatable :: moments(:)
    type(face_nodes) :: face
    real(dp) :: direction(3), frame(3, 2), mass(MOST_NODES, MOST_NODES), area(MOST_NODES), &
      coefficient(MOST_NODES, MOST_NODES), own(MOST_NODES, MOST_NODES), positive(MOST_NODES, MOST_NODES)
    logical :: dual, curved
    integer :: k

    allocate (moments(size(parts)), stat=stat)
    if (stat /= 0) return
    face = get_face(contact, f, faces%own_bend)
    face%revolution = faces%revolution
    curved = face%bent .or. any_bent(opposite, parts%face, faces%bend)
    direction = unit(face_normal(face, middle_place(face%kind)))
    frame = frame_across(direction)
    mass = 0.0_dp
    area = 0.0_dp
    do k = 1, size(parts)
      call add_moments(face, get_face(opposite, parts(k)%face, faces%bend), direction, frame, curved, parts(k)%shape, &
          moments(k))
      mass = mass + moments(k)%mass
      area = area + moments(k)%area
    end do
    associate (n => face%count)
      call dual_coefficients(mass(:n, :n), area(:n), LARGEST(face%kind), coefficient(:n, :n), dual)
      positive = nowhere_negative(face%kind, n)
      own = unmixed(face%kind, n)
      if (dual) then
        own(:n, :n) = spread(area(:n), 2, n)*own(:n, :n)
      else
        coefficient = positive
        own(:n, :n) = matmul(matmul(positive(:n, :n), mass(:n, :n)), own(:n, :n))
        area(:n) = matmul(positive(:n, :n), area(:n))
      end if
      draft%weight(contact%face(:n, f)) = draft%weight(contact%face(:n, f)) + area(:n)
      if (.not. (curved .and. faces%turning)) call add_own(contact%face(:n, f), own(:n, :n), draft, stat)
      do k = 1, size(parts)
        call add_part(contact%face(:n, f), face%normal(:, :n), opposite, parts(k)%face, coefficient(:n, :n), &
                      positive(:n, :n), curved, faces%turning, moments(k), draft, stat)
      end do
    end associate
  end subroutine weigh_face

  !> Is any of these faces bent?
  pure function any_bent(surface, numbers, normals) result(bent)
    type(fuge_surface_mesh), intent(in) :: surface
    integer, intent(in) :: numbers(:)
    real(dp), intent(in) :: normals(:, :, :)
    type(face_nodes) :: face
    logical :: bent
    integer :: k

    bent = .false.
    if (size(normals, 3) == 0) return
    do k = 1, size(numbers)
      face = get_face(surface, numbers(k), normals)
      bent = bent .or. face%bent
    end do
  end function any_bent

  !> Add the weights of the displacements of a face's own nodes: `own` has a row for each contact point.
  pure subroutine add_own(nodes, own, draft, stat)
    integer, intent(in) :: nodes(:)
    real(dp), intent(in) :: own(:, :)
    type(pair_draft), intent(inout) :: draft
    integer, intent(inout) :: stat
    real(dp), parameter :: NONE(3) = 0.0_dp
    integer :: a, b

    do a = 1, size(nodes)
      do b = 1, size(nodes)
        if (abs(own(a, b)) > 0.0_dp) call add_weight(draft%own, nodes(a), nodes(b), own(a, b), NONE, stat)
      end do
    end do
  end subroutine add_own

  !> Add the weights of one opposite face to those of the nodes of a face. `along` are the normals of the curved surface
  !> at these nodes. Between `curved` surfaces the gap is along the normal at each place if the normals are `turning`,
  !> else along one direction for each node. The arguments are eleven, because weights depend on the nodes, on the
  !> faces and on three choices of the method.
  pure subroutine add_part(nodes, along, opposite, f, coefficient, positive, curved, turning, moments, draft, stat)
    integer, intent(in) :: nodes(:), f
    real(dp), intent(in) :: along(:, :)
    type(fuge_surface_mesh), intent(in) :: opposite
    real(dp), intent(in) :: coefficient(:, :), positive(:, :)
    logical, intent(in) :: curved, turning
    type(face_moments), intent(in) :: moments
    type(pair_draft), intent(inout) :: draft
    integer, intent(inout) :: stat
    real(dp) :: weight(size(nodes), MOST_NODES), way(3, size(nodes)), normal(3, size(nodes)), place(2, size(nodes)), &
      share(size(nodes)), axes(3, MOST_NODES, size(nodes))
    integer :: a, c

    weight = matmul(coefficient, moments%cross(:size(nodes), :))
    way = matmul(moments%way(:, :size(nodes)), transpose(coefficient))
    if (curved) way = spread(matmul(coefficient, moments%gap(:size(nodes))), 1, 3)*along
    axes = 0.0_dp
    if (curved .and. turning) then
      weight = 0.0_dp
      way = 0.0_dp
      draft%gap(nodes) = draft%gap(nodes) + matmul(coefficient, moments%gap(:size(nodes)))
      axes = combined(coefficient, moments%own_axes)
      do a = 1, size(nodes)
        do c = 1, size(nodes)
          call add_weight(draft%own, nodes(a), nodes(c), 0.0_dp, axes(:, c, a), stat)
        end do
      end do
      axes = combined(coefficient, moments%axes)
    end if
    normal = matmul(moments%normal(:, :size(nodes)), transpose(positive))
    place = matmul(moments%place(:, :size(nodes)), transpose(positive))
    share = matmul(positive, moments%area(:size(nodes)))
    do a = 1, size(nodes)
      associate (i => nodes(a))
        draft%way(:, i) = draft%way(:, i) + way(:, a)
        draft%normal(:, i) = draft%normal(:, i) + normal(:, a)
        do c = 1, size(opposite%face, 1)
          if (opposite%face(c, f) == 0) exit
          call add_weight(draft%other, i, opposite%face(c, f), weight(a, c), axes(:, c, a), stat)
          if (stat /= 0) return
        end do
        if (draft%face(i) == f) then
          draft%share(i) = draft%share(i) + share(a)
          draft%place(:, i) = draft%place(:, i) + place(:, a)
        else if (share(a) > draft%share(i)) then
          draft%face(i) = f
          draft%share(i) = share(a)
          draft%place(:, i) = place(:, a)
        end if
      end associate
    end do
  end subroutine add_part

  !> Integrals with dual functions from those with shape functions.
  pure function combined(coefficient, integrals) result(axes)
    real(dp), intent(in) :: coefficient(:, :), integrals(3, MOST_NODES, MOST_NODES)
    real(dp) :: axes(3, MOST_NODES, size(coefficient, 1))
    integer :: a, b

    axes = 0.0_dp
    do a = 1, size(axes, 3)
      do b = 1, size(coefficient, 2)
        axes(:, :, a) = axes(:, :, a) + coefficient(a, b)*integrals(:, :, b)
      end do
    end do
  end function combined

  !> Order numbers, so that no sum depends on the shape of the tree: by insertion over ever smaller distances (D. L.
  !> Shell: A high-speed sorting procedure, Communications of the ACM 2, 1959), since a large face has many.
  pure subroutine sort_upwards(list)
    integer, intent(inout) :: list(:)
    integer :: i, k, distance, moved

    distance = 1
    do while (distance < size(list)/3)
      distance = 3*distance + 1
    end do
    do while (distance > 0)
      do k = 1 + distance, size(list)
        moved = list(k)
        i = k - distance
        do while (i > 0)
          if (list(i) <= moved) exit
          list(i + distance) = list(i)
          i = i - distance
        end do
        list(i + distance) = moved
      end do
      distance = distance/3
    end do
  end subroutine sort_upwards

  !> Twice the length, with the contents.
  pure subroutine lengthen(parts, stat)
    type(face_part), allocatable, intent(inout) :: parts(:)
    integer, intent(inout) :: stat
    type(face_part), allocatable :: longer(:)

    allocate (longer(2*size(parts)), stat=stat)
    if (stat /= 0) return
    longer(:size(parts)) = parts
    call move_alloc(longer, parts)
  end subroutine lengthen

end module fuge_mortar_pairing
