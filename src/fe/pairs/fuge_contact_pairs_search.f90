!> Contact between two surfaces of finite elements whose nodes do not face each other.
module fuge_contact_pairs_search
  use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_value
  use fuge_contact_pairs_type, only: check_pair_options, fuge_contact_pairs, fuge_pair_options, &
    FUGE_MORTAR, FUGE_NORMALS_AVERAGED, FUGE_NORMALS_GIVEN, FUGE_NORMALS_OPPOSITE
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_DOF, FUGE_ERR_MEMORY, FUGE_ERR_MESH, FUGE_ERR_SIZE
  use fuge_surface_mesh_type, only: fuge_surface_mesh
  implicit none
  private

  public :: fuge_find_pairs

  character(len=*), parameter :: CONTACT_NAME = 'contact surface', OPPOSITE_NAME = 'opposite surface'
  !> A node counts as without an opposite if less than this fraction of its area has one.
  real(dp), parameter :: SMALLEST_PART = 1.0e-6_dp
  !> Weights below this count as zero.
  real(dp), parameter :: NO_WEIGHT = 1.0e-15_dp

contains

  !> Find the contact points of a pair of surfaces, and add them to `pairs`.
  !>
  !> The nodes of `contact` become contact points, and pressures are those on it: with linear faces let it be the
  !> coarser surface, whose pressures are smooth, with quadratic faces the finer one. The degrees of freedom of both
  !> surfaces are numbered in one stiffness matrix, that of both bodies. Sliding is small: pairs are those of the
  !> positions given. A later call adds another pair of surfaces.
  !>
  !> Then `dof` and `normal` of fuge_body are those of `pairs`; `fuge_condense`, `pose(pairs%gap, problem, ..)`,
  !> problem%gap_upper = pairs%gap_upper, solve; pressure = force/area.
  !> O(n log n) for n faces. Nodes that have no opposite are listed in `unpaired_node`.
  !> Warning: FUGE_WARN_PAIRS, a node is a contact point of two pairs; where it moves alike in both, it is listed once,
  !> in the first one, with the area of both. Errors, `pairs` unchanged, name the face or the node: FUGE_ERR_SIZE,
  !> FUGE_ERR_ELEMENT, FUGE_ERR_NOT_FINITE, FUGE_ERR_OVERFLOW, FUGE_ERR_DOF, FUGE_ERR_GAP, FUGE_ERR_OPTION,
  !> FUGE_ERR_MEMORY; FUGE_ERR_MESH for a face that is folded over, has no area or looks the wrong way, for a given
  !> normal that does, for a body of revolution that reaches beyond its axis, and for surfaces that do not face each
  !> other. Two surfaces that both look into their bodies face each other too, which only `fuge_join_bodies` sees.
  subroutine fuge_find_pairs(contact, opposite, options, pairs, info)
    use fuge_near_origin, only: move_surface, way_to_origin
    type(fuge_surface_mesh), intent(in) :: contact, opposite
    type(fuge_pair_options), intent(in) :: options
    type(fuge_contact_pairs), intent(inout) :: pairs
    type(fuge_info), intent(out) :: info
    type(fuge_surface_mesh) :: near_contact, near_opposite
    real(dp), allocatable :: way(:)
    integer :: stat

    call check_pair(contact, opposite, options, pairs, info)
    if (info%failed()) return
    ! Two or three numbers. Assigned to an array that is not allocated, gfortran compares its bounds before they are
    ! set.
    allocate (way(size(contact%node, 1)))
    way(:) = way_to_origin(contact, opposite)
    if (options%revolution) way(1) = 0.0_dp
    if (.not. any(abs(way) > 0.0_dp)) then
      call find_near_pairs(contact, opposite, options, pairs, info)
      return
    end if
    call move_surface(contact, way, near_contact, stat)
    if (stat == 0) call move_surface(opposite, way, near_opposite, stat)
    call require_memory(stat, 'copies of the surfaces', info)
    if (stat == 0) call find_near_pairs(near_contact, near_opposite, options, pairs, info)
  end subroutine fuge_find_pairs

  !> The same for surfaces near the origin, checked.
  subroutine find_near_pairs(contact, opposite, options, pairs, info)
    use fuge_common_points, only: add_found
    use fuge_opposite_faces, only: opposite_faces
    use fuge_pair_draft_type, only: pair_draft, start_draft
    type(fuge_surface_mesh), intent(in) :: contact, opposite
    type(fuge_pair_options), intent(in) :: options
    type(fuge_contact_pairs), intent(inout) :: pairs
    type(fuge_info), intent(inout) :: info
    type(fuge_contact_pairs) :: found
    type(pair_draft) :: draft
    type(opposite_faces) :: faces
    real(dp), allocatable :: normal(:, :)
    integer :: stat

    allocate (normal(3, size(contact%node, 2)), stat=stat)
    if (stat == 0) call start_draft(draft, size(contact%node, 2), stat)
    if (stat == 0) call set_bends(contact, opposite, options, faces, stat)
    if (stat == 0) call set_normals(contact, options, faces, normal, stat, info)
    if (info%failed()) return
    if (stat == 0) call find_draft(contact, opposite, options, normal, faces, draft, stat)
    if (stat == 0) call refuse_none(contact, draft, info)
    if (info%failed()) return
    if (stat == 0) then
      found%pairs = pairs%pairs + 1
      call collect(contact, opposite, options, normal, draft, found, stat)
    end if
    if (stat == 0) call add_found(found, faces%reach, pairs, stat, info)
    if (stat /= 0) call report(info, FUGE_ERR_MEMORY, 'no memory to find contact pairs')
  end subroutine find_near_pairs

  !> Refuse surfaces and options that do not fit.
  subroutine check_pair(contact, opposite, options, pairs, info)
    use fuge_surface_checks, only: check_radii, check_surface
    type(fuge_surface_mesh), intent(in) :: contact, opposite
    type(fuge_pair_options), intent(in) :: options
    type(fuge_contact_pairs), intent(in) :: pairs
    type(fuge_info), intent(inout) :: info

    call check_surface(contact, CONTACT_NAME, info)
    if (.not. info%failed()) call check_surface(opposite, OPPOSITE_NAME, info)
    if (.not. info%failed()) call check_pair_options(options, contact, info)
    if (info%failed()) return
    if (size(contact%node, 1) /= size(opposite%node, 1)) then
      call report(info, FUGE_ERR_SIZE, 'the contact surface has '//text(size(contact%node, 1))//' dimensions, the ' &
                  //'opposite one '//text(size(opposite%node, 1))//': they need the same')
    else if (pairs%pairs > 0) then
      if (size(pairs%direction, 1) /= size(contact%node, 1)) call report(info, FUGE_ERR_SIZE, 'these surfaces have ' &
        //text(size(contact%node, 1))//' dimensions, the pairs before '//text(size(pairs%direction, 1)))
    end if
    if (options%revolution .and. .not. info%failed()) call check_radii(contact, CONTACT_NAME, info)
    if (options%revolution .and. .not. info%failed()) call check_radii(opposite, OPPOSITE_NAME, info)
    if (info%failed()) return
    if (.not. (moves(contact) .or. moves(opposite))) call report(info, FUGE_ERR_DOF, 'neither surface has degrees of ' &
      //'freedom: set dof of at least one of them')
  end subroutine check_pair

  !> Has a surface any degree of freedom?
  pure function moves(surface)
    type(fuge_surface_mesh), intent(in) :: surface
    logical :: moves

    moves = .false.
    if (allocated(surface%dof)) moves = any(surface%dof > 0)
  end function moves

  !> The unit normals along which opposites are sought.
  pure subroutine set_normals(contact, options, faces, normal, stat, info)
    use fuge_nodal_normals, only: average_normals, take_normals
    use fuge_curved_normals, only: mean_of_faces
    use fuge_opposite_faces, only: opposite_faces
    type(fuge_surface_mesh), intent(in) :: contact
    type(fuge_pair_options), intent(in) :: options
    type(opposite_faces), intent(in) :: faces
    real(dp), intent(out) :: normal(:, :)
    integer, intent(out) :: stat
    type(fuge_info), intent(inout) :: info

    if (options%normals == FUGE_NORMALS_GIVEN) then
      call take_normals(contact, CONTACT_NAME, options%normal, normal, stat, info)
    else
      call average_normals(contact, CONTACT_NAME, normal, stat, info)
      if (stat == 0 .and. size(faces%own_bend, 3) > 0) call mean_of_faces(contact, faces%own_bend, normal, stat)
    end if
  end subroutine set_normals

  !> Find what lies across from each node, by the method chosen.
  pure subroutine find_draft(contact, opposite, options, normal, faces, draft, stat)
    use fuge_nodal_areas, only: find_nodal_areas
    use fuge_mortar_pairing, only: pair_faces
    use fuge_node_to_face, only: pair_nodes
    use fuge_opposite_faces, only: opposite_faces, prepare_opposite
    use fuge_pair_draft_type, only: pair_draft
    type(fuge_surface_mesh), intent(in) :: contact, opposite
    type(fuge_pair_options), intent(in) :: options
    real(dp), intent(in) :: normal(:, :)
    type(opposite_faces), intent(inout) :: faces
    type(pair_draft), intent(inout) :: draft
    integer, intent(out) :: stat
    real(dp), allocatable :: whole(:)

    allocate (whole(size(contact%node, 2)), stat=stat)
    if (stat == 0) call prepare_opposite(contact, opposite, options%reach, faces, stat)
    if (stat /= 0) return
    faces%turning = options%normals == FUGE_NORMALS_AVERAGED
    faces%revolution = options%revolution
    call find_nodal_areas(contact, faces%own_bend, faces%revolution, whole)
    if (options%method == FUGE_MORTAR) then
      call pair_faces(contact, opposite, faces, draft, stat)
      where (draft%weight < SMALLEST_PART*whole) draft%weight = 0.0_dp
      draft%area = draft%weight
    else
      draft%area = whole
      call pair_nodes(contact, opposite, faces, normal, options%normals == FUGE_NORMALS_OPPOSITE, draft, stat)
    end if
  end subroutine find_draft

  !> The normals of the curved surfaces that the meshes stand for; none if faces are taken as they are.
  pure subroutine set_bends(contact, opposite, options, faces, stat)
    use fuge_curved_normals, only: find_curved_normals
    use fuge_opposite_faces, only: opposite_faces
    type(fuge_surface_mesh), intent(in) :: contact, opposite
    type(fuge_pair_options), intent(in) :: options
    type(opposite_faces), intent(inout) :: faces
    integer, intent(out) :: stat
    logical :: curved

    curved = options%smooth .and. .not. options%tied
    allocate (faces%own_bend(3, size(contact%face, 1), merge(size(contact%face, 2), 0, curved)), &
              faces%bend(3, size(opposite%face, 1), merge(size(opposite%face, 2), 0, curved)), stat=stat)
    if (stat == 0 .and. curved) call find_curved_normals(contact, options%crease, faces%own_bend, stat)
    if (stat == 0 .and. curved) call find_curved_normals(opposite, options%crease, faces%bend, stat)
  end subroutine set_bends

  !> Refuse surfaces none of whose points are opposite to each other.
  pure subroutine refuse_none(contact, draft, info)
    use fuge_pair_draft_type, only: pair_draft
    type(fuge_surface_mesh), intent(in) :: contact
    type(pair_draft), intent(in) :: draft
    type(fuge_info), intent(inout) :: info

    if (any(draft%weight > 0.0_dp)) return
    if (draft%alike(1) > 0) then
      call report(info, FUGE_ERR_MESH, 'face '//index_text(draft%alike(1))//' of the contact surface and face ' &
                  //index_text(draft%alike(2))//' across from it have normals to the same side: reverse the order ' &
                  //'of the nodes of one of the surfaces, so that both look outwards')
    else
      call report(info, FUGE_ERR_MESH, 'the surfaces do not face each other: no face of the opposite surface lies ' &
                  //'across from face '//index_text(1)//' or any other of the '//text(size(contact%face, 2))//' of ' &
                  //'the contact surface; check positions, units and reach')
    end if
  end subroutine refuse_none

  !> Make contact points of the nodes that have an opposite.
  pure subroutine collect(contact, opposite, options, normal, draft, found, stat)
    use fuge_face_geometry, only: unit
    use fuge_weight_rows, only: row_length
    use fuge_pair_draft_type, only: pair_draft
    type(fuge_surface_mesh), intent(in) :: contact, opposite
    type(fuge_pair_options), intent(in) :: options
    real(dp), intent(in) :: normal(:, :)
    type(pair_draft), intent(in) :: draft
    type(fuge_contact_pairs), intent(inout) :: found
    integer, intent(out) :: stat
    integer, allocatable :: owned(:), place(:)
    real(dp) :: direction(3)
    integer :: axis, dimensions, i, n, per_node, width

    dimensions = size(contact%node, 1)
    per_node = merge(dimensions, 1, options%tied)
    width = 0
    do i = 1, size(draft%weight)
      if (draft%weight(i) > 0.0_dp) width = max(width, dimensions*(row_length(draft%own, &
          i) + row_length(draft%other, i)))
    end do
    call make_room(found, width, per_node*count(draft%weight > 0.0_dp), dimensions, stat)
    if (stat == 0) allocate (owned(found%points()), place(largest_dof(contact, opposite)), stat=stat)
    if (stat /= 0) return
    place = 0
    n = 0
    do i = 1, size(draft%weight)
      if (.not. draft%weight(i) > 0.0_dp) cycle
      do axis = 1, per_node
        n = n + 1
        direction = normal(:, i)
        if (options%normals == FUGE_NORMALS_OPPOSITE) direction = -unit(draft%normal(:, i))
        if (options%tied) direction = merge(1.0_dp, 0.0_dp, [1, 2, 3] == axis)
        call fill_point(options, draft, i, direction, n, found)
        owned(n) = owned_dof(contact, i)
        call fill_row(contact, opposite, draft, i, direction(:dimensions), place, found%dof(:, n), found%normal(:, n), &
                      found%direction(:, n))
      end do
    end do
    call list_unpaired(contact, draft, found, stat)
    if (stat /= 0) return
    call found%set_owned(owned)
    call trim_width(found)
  end subroutine collect

  pure subroutine make_room(found, width, n, dimensions, stat)
    type(fuge_contact_pairs), intent(inout) :: found
    integer, intent(in) :: width, n, dimensions
    integer, intent(out) :: stat

    allocate (found%dof(width, n), found%normal(width, n), found%gap(n), found%gap_upper(n), found%area(n), &
              found%pair(n), found%node(n), found%direction(dimensions, n), found%face(n), &
              found%place(dimensions - 1, n), stat=stat)
  end subroutine make_room

  !> Everything about contact point `n`, of node `i`, except its row and direction.
  pure subroutine fill_point(options, draft, i, direction, n, found)
    use fuge_pair_draft_type, only: pair_draft
    type(fuge_pair_options), intent(in) :: options
    type(pair_draft), intent(in) :: draft
    integer, intent(in) :: i, n
    real(dp), intent(in) :: direction(3)
    type(fuge_contact_pairs), intent(inout) :: found

    found%pair(n) = found%pairs
    found%node(n) = i
    found%area(n) = draft%area(i)
    found%face(n) = draft%face(i)
    found%place(:, n) = draft%place(:size(found%place, 1), i)/draft%share(i)
    found%gap(n) = 0.0_dp
    found%gap_upper(n) = 0.0_dp
    if (options%tied) return
    found%gap(n) = (dot_product(direction, draft%way(:, i)) + draft%gap(i))/draft%weight(i)
    found%gap_upper(n) = options%play
    if (options%play >= huge(1.0_dp)) found%gap_upper(n) = ieee_value(1.0_dp, ieee_positive_inf)
  end subroutine fill_point

  !> How the gap of node `i` along `direction` depends on the degrees of freedom. `place`, zeros, is left as it was.
  !> `resultant`: how it depends on a translation of the opposite surface, `direction` but for curved bodies. The
  !> arguments are nine, because a row is filled from both surfaces into arrays of the caller.
  pure subroutine fill_row(contact, opposite, draft, i, direction, place, dof, normal, resultant)
    use fuge_weight_rows, only: copy_row, row_length
    use fuge_pair_draft_type, only: pair_draft
    type(fuge_surface_mesh), intent(in) :: contact, opposite
    type(pair_draft), intent(in) :: draft
    integer, intent(in) :: i
    real(dp), intent(in) :: direction(:)
    integer, intent(inout) :: place(:)
    integer, intent(out) :: dof(:)
    real(dp), intent(out) :: normal(:), resultant(:)
    integer :: nodes(size(dof)), used
    real(dp) :: axes(3, size(dof)), weight(size(dof))

    dof = 0
    normal = 0.0_dp
    used = 0
    call copy_row(draft%own, i, nodes, weight, axes)
    call add_terms(contact, nodes(:row_length(draft%own, i)), -weight/draft%weight(i), -axes/draft%weight(i), &
                   direction, place, used, dof, normal)
    call copy_row(draft%other, i, nodes, weight, axes)
    call add_terms(opposite, nodes(:row_length(draft%other, i)), weight/draft%weight(i), axes/draft%weight(i), &
                   direction, place, used, dof, normal)
    resultant = direction
    associate (n => row_length(draft%other, i), d => size(direction))
      if (any(abs(axes(:, :n)) > 0.0_dp)) &
        resultant = (direction*sum(weight(:n)) + sum(axes(:d, :n), 2))/draft%weight(i)
    end associate
    place(dof(:used)) = 0
  end subroutine fill_row

  !> Add the terms of the nodes of one surface, with weights along `direction` and along each axis; a degree of freedom
  !> that both bodies share comes once. The arguments are nine, because the row and its places are arrays of the
  !> caller.
  pure subroutine add_terms(surface, nodes, weight, axes, direction, place, used, dof, normal)
    type(fuge_surface_mesh), intent(in) :: surface
    integer, intent(in) :: nodes(:)
    real(dp), intent(in) :: weight(:), axes(:, :), direction(:)
    integer, intent(inout) :: place(:), used, dof(:)
    real(dp), intent(inout) :: normal(:)
    integer :: axis, k

    if (.not. allocated(surface%dof)) return
    do k = 1, size(nodes)
      do axis = 1, size(direction)
        associate (degree => surface%dof(axis, nodes(k)), factor => weight(k)*direction(axis) + axes(axis, k))
          if (degree == 0 .or. abs(factor) <= NO_WEIGHT) cycle
          if (place(degree) == 0) then
            used = used + 1
            place(degree) = used
            dof(used) = degree
          end if
          normal(place(degree)) = normal(place(degree)) + factor
        end associate
      end do
    end do
  end subroutine add_terms

  !> List the nodes of faces that have no opposite. `stat` as in an allocate statement.
  pure subroutine list_unpaired(contact, draft, found, stat)
    use fuge_pair_draft_type, only: pair_draft
    type(fuge_surface_mesh), intent(in) :: contact
    type(pair_draft), intent(in) :: draft
    type(fuge_contact_pairs), intent(inout) :: found
    integer, intent(out) :: stat
    logical, allocatable :: used(:)
    integer :: f, i, k, number

    allocate (used(size(draft%weight)), stat=stat)
    if (stat /= 0) return
    used = .false.
    do f = 1, size(contact%face, 2)
      do k = 1, size(contact%face, 1)
        if (contact%face(k, f) > 0) used(contact%face(k, f)) = .true.
      end do
    end do
    used = used .and. .not. draft%weight > 0.0_dp
    allocate (found%unpaired_node(count(used)), found%unpaired_pair(count(used)), stat=stat)
    if (stat /= 0) return
    number = 0
    do i = 1, size(used)
      if (.not. used(i)) cycle
      number = number + 1
      found%unpaired_node(number) = i
    end do
    found%unpaired_pair = found%pairs
  end subroutine list_unpaired

  !> Leave out rows of `dof` and `normal` that no contact point uses.
  pure subroutine trim_width(found)
    type(fuge_contact_pairs), intent(inout) :: found
    integer, allocatable :: dof(:, :)
    real(dp), allocatable :: factor(:, :)
    integer :: stat, width

    width = size(found%dof, 1)
    do while (width > 1)
      if (any(found%dof(width, :) > 0)) exit
      width = width - 1
    end do
    if (width == size(found%dof, 1)) return
    allocate (dof(width, size(found%dof, 2)), factor(width, size(found%dof, 2)), stat=stat)
    ! Without memory the rows keep their unused places.
    if (stat /= 0) return
    dof = found%dof(:width, :)
    factor = found%normal(:width, :)
    call move_alloc(dof, found%dof)
    call move_alloc(factor, found%normal)
  end subroutine trim_width

  pure function largest_dof(contact, opposite) result(largest)
    type(fuge_surface_mesh), intent(in) :: contact, opposite
    integer :: largest

    largest = 0
    if (allocated(contact%dof)) largest = maxval(contact%dof)
    if (allocated(opposite%dof)) largest = max(largest, maxval(opposite%dof))
  end function largest_dof

  !> A degree of freedom of a node; 0 if it has none.
  pure function owned_dof(surface, i) result(dof)
    type(fuge_surface_mesh), intent(in) :: surface
    integer, intent(in) :: i
    integer :: dof

    dof = 0
    if (allocated(surface%dof)) dof = maxval(surface%dof(:, i))
  end function owned_dof

end module fuge_contact_pairs_search
