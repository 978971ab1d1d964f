!> On which side of its faces a body lies, as its stiffness matrix knows.
!>
!> The nodes that are coupled with all nodes of a face are those of the element behind it. If the surface has their
!> positions, and they all lie on the side to which the face looks, the face is the wrong way round. A surface alone
!> does not know: two that both look into their bodies face each other too.
module fuge_face_sides
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_elastic_body_type, only: fuge_surface_pair
  use fuge_face_geometry, only: face_nodes, face_normal, face_position, unit
  use fuge_face_shapes, only: middle_place
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text
  use fuge_status, only: fuge_info, report, FUGE_ERR_MEMORY, FUGE_ERR_MESH
  use fuge_surface_mesh_type, only: face_size, fuge_surface_mesh, get_face
  use fuge_symmetric_columns, only: symmetric_columns
  implicit none
  private

  public :: check_face_sides

  !> A node lies on one side of a face if its distance from it is above this fraction of the extent of the face.
  real(dp), parameter :: BESIDE = 1.0e-3_dp

  !> Most nodes of one element. A face that is coupled with more of them belongs to a condensed matrix, which
  !> couples all with all.
  integer, parameter :: MOST_NODES = 27
  !> The mark MOST_MARKS*f + k stands for a coupling with the first k nodes of face f, which are fewer than MOST_MARKS.
  integer, parameter :: MOST_MARKS = 16

  !> What is coupled with each degree of freedom of the faces: neighbour(first(i)) .. neighbour(first(i + 1) - 1).
  type :: couplings
    integer, allocatable :: first(:), neighbour(:)
    !> The node of each degree of freedom, 0 for one that is not known.
    integer, allocatable :: node(:)
  end type couplings

contains

  !> Refuse surfaces that look into their bodies, as far as matrices and positions tell: FUGE_ERR_MESH. `surface_pairs`
  !> checked, with the degrees of freedom of their own bodies; FUGE_ERR_MEMORY.
  pure subroutine check_face_sides(surface_pairs, matrices, info)
    type(fuge_surface_pair), intent(in) :: surface_pairs(:)
    type(symmetric_columns), intent(in) :: matrices(:)
    type(fuge_info), intent(inout) :: info
    integer :: k

    do k = 1, size(surface_pairs)
      associate (pair => surface_pairs(k))
        if (pair%contact_body > 0) call check_surface_side(pair%contact, matrices(pair%contact_body), 'pair ' &
          //index_text(k)//': contact surface of body '//index_text(pair%contact_body), info)
        if (info%failed()) return
        if (pair%opposite_body > 0) call check_surface_side(pair%opposite, matrices(pair%opposite_body), 'pair ' &
          //index_text(k)//': opposite surface of body '//index_text(pair%opposite_body), info)
        if (info%failed()) return
      end associate
    end do
  end subroutine check_face_sides

  !> One surface; `name` is what messages call it.
  pure subroutine check_surface_side(surface, matrix, name, info)
    type(fuge_surface_mesh), intent(in) :: surface
    type(symmetric_columns), intent(in) :: matrix
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info
    type(couplings) :: coupled
    logical, allocatable :: known(:)
    integer, allocatable :: mark(:)
    integer :: f, node, stat

    call find_known(surface, known, stat)
    if (stat == 0) then
      ! Both triangles have to be counted in default integers.
      if (.not. any(known) .or. real(matrix%upper%column(matrix%degrees() + 1)) > 0.5*real(huge(f))) return
      call find_couplings(surface, known, matrix, coupled, stat)
    end if
    if (stat == 0) allocate (mark(size(coupled%node)), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory to see on which side of its faces the body lies')
      return
    end if
    mark = 0
    do f = 1, size(surface%face, 2)
      call find_outside(surface, f, coupled, mark, node)
      if (node == 0) cycle
      call report(info, FUGE_ERR_MESH, name//': face '//index_text(f)//' looks into the body: node '//index_text(node) &
                  //', which the stiffness matrix couples with all of its nodes, lies on the side to which it looks; ' &
                  //'reverse the order of the nodes of all faces of the surface')
      return
    end do
  end subroutine check_surface_side

  !> The nodes that no face names but that have a degree of freedom and a position. None if these positions are all the
  !> same: then they have never been set.
  pure subroutine find_known(surface, known, stat)
    type(fuge_surface_mesh), intent(in) :: surface
    logical, allocatable, intent(out) :: known(:)
    integer, intent(out) :: stat
    integer :: f, i, one

    allocate (known(size(surface%node, 2)), stat=stat)
    if (stat /= 0) return
    do i = 1, size(known)
      known(i) = any(surface%dof(:, i) > 0) .and. all(ieee_is_finite(surface%node(:, i)))
    end do
    do f = 1, size(surface%face, 2)
      known(surface%face(:face_size(surface, f), f)) = .false.
    end do
    one = findloc(known, .true., dim=1)
    if (count(known) < 2) return
    do i = one + 1, size(known)
      if (known(i) .and. any(abs(surface%node(:, i) - surface%node(:, one)) > 0.0_dp)) return
    end do
    known = .false.
  end subroutine find_known

  !> What the matrix couples with the nodes of the faces. Its upper triangle is read twice, to count and to store.
  pure subroutine find_couplings(surface, known, matrix, coupled, stat)
    type(fuge_surface_mesh), intent(in) :: surface
    logical, intent(in) :: known(:)
    type(symmetric_columns), intent(in) :: matrix
    type(couplings), intent(out) :: coupled
    integer, intent(out) :: stat
    logical, allocatable :: of_face(:)
    integer, allocatable :: next(:)
    integer :: j, n

    n = matrix%degrees()
    allocate (coupled%first(n + 1), coupled%node(n), of_face(n), next(n), stat=stat)
    if (stat /= 0) return
    call name_degrees(surface, known, coupled%node, of_face)
    allocate (coupled%neighbour(0))
    next = 0
    call visit_couplings(matrix, of_face, next, coupled%neighbour)
    coupled%first(1) = 1
    do j = 1, n
      coupled%first(j + 1) = coupled%first(j) + next(j)
    end do
    deallocate (coupled%neighbour)
    allocate (coupled%neighbour(coupled%first(n + 1) - 1), stat=stat)
    if (stat /= 0) return
    next = coupled%first(:n) - 1
    call visit_couplings(matrix, of_face, next, coupled%neighbour)
  end subroutine find_couplings

  !> The node of each degree of freedom, 0 if unknown, and whether a face names it.
  pure subroutine name_degrees(surface, known, node, of_face)
    type(fuge_surface_mesh), intent(in) :: surface
    logical, intent(in) :: known(:)
    integer, intent(out) :: node(:)
    logical, intent(out) :: of_face(:)
    integer :: f, i, k

    node = 0
    of_face = .false.
    do i = 1, size(known)
      if (.not. known(i)) cycle
      do k = 1, size(surface%dof, 1)
        if (surface%dof(k, i) > 0) node(surface%dof(k, i)) = i
      end do
    end do
    do f = 1, size(surface%face, 2)
      do i = 1, face_size(surface, f)
        do k = 1, size(surface%dof, 1)
          associate (degree => surface%dof(k, surface%face(i, f)))
            if (degree == 0) cycle
            node(degree) = surface%face(i, f)
            of_face(degree) = .true.
          end associate
        end do
      end do
    end do
  end subroutine name_degrees

  !> Count what is coupled with each degree of freedom of a face, and store it behind `next` if there is room.
  pure subroutine visit_couplings(matrix, of_face, next, neighbour)
    type(symmetric_columns), intent(in) :: matrix
    logical, intent(in) :: of_face(:)
    integer, intent(inout) :: next(:), neighbour(:)
    integer :: both(2), j, p, side

    do j = 1, size(next)
      do p = matrix%upper%column(j), matrix%upper%column(j + 1) - 1
        both = [j, matrix%upper%row(p)]
        if (both(1) == both(2) .or. .not. abs(matrix%upper%value(p)) > 0.0_dp) cycle
        do side = 1, 2
          if (.not. of_face(both(side))) cycle
          next(both(side)) = next(both(side)) + 1
          if (size(neighbour) > 0) neighbour(next(both(side))) = both(3 - side)
        end do
      end do
    end do
  end subroutine visit_couplings

  !> A node of the element behind face `f` if all of them lie on the side to which it looks, else 0; 0 also where the
  !> face is coupled with more than one element, or with the whole body, as in a condensed matrix. `mark` is work space,
  !> an element for each degree of freedom; its numbers grow from face to face.
  pure subroutine find_outside(surface, f, coupled, mark, node)
    type(fuge_surface_mesh), intent(in) :: surface
    integer, intent(in) :: f
    type(couplings), intent(in) :: coupled
    integer, intent(inout) :: mark(:)
    integer, intent(out) :: node
    type(face_nodes) :: face
    real(dp) :: distance, extent, middle(3), normal(3), x(3)
    integer :: shared, count, last, p

    node = 0
    shared = 0
    count = face_size(surface, f)
    call mark_common(surface, f, coupled, mark, last)
    if (last == 0) return
    face = get_face(surface, f)
    normal = unit(face_normal(face, middle_place(face%kind)))
    middle = face_position(face, middle_place(face%kind))
    extent = maxval(maxval(face%x(:, :count), 2) - minval(face%x(:, :count), 2))
    do p = coupled%first(last), coupled%first(last + 1) - 1
      associate (other => coupled%neighbour(p))
        if (mark(other) < MOST_MARKS*f + count) cycle
        if (any(surface%face(:count, f) == coupled%node(other))) cycle
        shared = shared + 1
        distance = 0.0_dp
        if (coupled%node(other) > 0) then
          x = 0.0_dp
          x(:size(surface%node, 1)) = surface%node(:, coupled%node(other))
          distance = dot_product(normal, x - middle)
        end if
        if (.not. distance > BESIDE*extent) then
          node = 0
          return
        end if
        node = coupled%node(other)
      end associate
    end do
    if (shared > MOST_NODES*size(surface%dof, 1) .or. &
        shared == size(coupled%node) - count*size(surface%dof, 1)) node = 0
  end subroutine find_outside

  !> Mark the degrees of freedom that are coupled with all nodes of a face. `last`: a degree of freedom of its last
  !> node, 0 if one of the nodes has none.
  pure subroutine mark_common(surface, f, coupled, mark, last)
    type(fuge_surface_mesh), intent(in) :: surface
    integer, intent(in) :: f
    type(couplings), intent(in) :: coupled
    integer, intent(inout) :: mark(:)
    integer, intent(out) :: last
    integer :: k, p

    last = 0
    do k = 1, face_size(surface, f)
      last = maxval(surface%dof(:, surface%face(k, f)))
      if (last == 0) return
      do p = coupled%first(last), coupled%first(last + 1) - 1
        associate (reached => mark(coupled%neighbour(p)))
          if (reached == MOST_MARKS*f + k - 1 .or. k == 1) reached = MOST_MARKS*f + k
        end associate
      end do
    end do
  end subroutine mark_common

end module fuge_face_sides
