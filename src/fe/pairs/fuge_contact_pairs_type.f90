!> What pairs of contact surfaces are found by, and what is found.
module fuge_contact_pairs_type
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_status, only: fuge_info, report, FUGE_ERR_GAP, FUGE_ERR_NOT_FINITE, FUGE_ERR_OPTION, FUGE_ERR_SIZE
  use fuge_surface_mesh_type, only: fuge_surface_mesh
  implicit none
  private

  public :: append_pairs, check_pair_options, move_pairs

  !> Weighted gaps of the dual mortar method. Uniform pressures are exact to 1e-12; middle nodes that are moved
  !> along a surface, so that sides are curved in it, leave errors of 1e-4 to 5e-3.
  integer, parameter, public :: FUGE_MORTAR = 0
  !> Each node against the face across from it. It fails the patch test.
  integer, parameter, public :: FUGE_NODE_TO_FACE = 1
  !> Normals averaged at the nodes of the contact surface.
  integer, parameter, public :: FUGE_NORMALS_AVERAGED = 0
  !> Normals of the opposite faces.
  integer, parameter, public :: FUGE_NORMALS_OPPOSITE = 1
  !> Normals given at the nodes of the contact surface.
  integer, parameter, public :: FUGE_NORMALS_GIVEN = 2

  !> How a pair of surfaces is treated. Set components by name, since later versions may add some.
  type, public :: fuge_pair_options
    !> FUGE_MORTAR, or FUGE_NODE_TO_FACE, which fails the patch test: on meshes that do not match it does not reproduce
    !> a uniform pressure.
    integer :: method = FUGE_MORTAR
    !> FUGE_NORMALS_AVERAGED, FUGE_NORMALS_OPPOSITE or FUGE_NORMALS_GIVEN.
    integer :: normals = FUGE_NORMALS_AVERAGED
    !> For FUGE_NORMALS_GIVEN: outwards from the contact surface at each of its nodes, of any length,
    !> (dimensions, nodes).
    real(dp), allocatable :: normal(:, :)
    !> Largest distance of opposite points from each other, outside or inside the body, length. Not above 0: the extent
    !> of the surfaces.
    real(dp) :: reach = 0.0_dp
    !> Play between the lower and the upper stop, length: 0 for points that stay in contact but slide, huge or infinite
    !> for one-sided contact.
    real(dp) :: play = huge(1.0_dp)
    !> Glue the surfaces where they are: along each axis, with a gap and a play of zero.
    logical :: tied = .false.
    !> Normals, gaps and areas are those of the smooth bodies that the meshes stand for, which on circles, spheres and
    !> cylinders are exact; faces that meet at more than `crease` keep their edge, flat faces stay flat. False: those
    !> of the faces as they are, whose chords on a round body are wrong by L**2/(8 R), often more than the gap itself.
    logical :: smooth = .true.
    !> Angle between the normals of neighbouring faces, in degrees from 0 to 90, beyond which the body has an edge
    !> there: greater than 360 over the number of elements round a full circle, less than the angle of any chamfer.
    real(dp) :: crease = 25.0_dp
    !> In the plane: the surfaces are those of bodies of revolution, with the radius along the first axis, so that areas
    !> are those of rings, and forces those of whole rings.
    logical :: revolution = .false.
  end type fuge_pair_options

  !> Contact points, in the form in which `fuge_body` and `fuge_problem` take them; n contact points.
  type, public :: fuge_contact_pairs
    !> Degrees of freedom of both bodies, (width, n), 0 where unused: `dof` of fuge_body.
    integer, allocatable :: dof(:, :)
    !> Their factors: `normal` of fuge_body.
    real(dp), allocatable :: normal(:, :)
    !> Initial gaps, (n), length; negative where one body is inside the other; 0 where tied.
    real(dp), allocatable :: gap(:)
    !> `gap_upper` of fuge_problem: the play, (n); infinity for one-sided contact.
    real(dp), allocatable :: gap_upper(:)
    !> Area of each contact point, (n), in the plane length, of bodies of revolution that of the ring: pressure =
    !> force/area.
    real(dp), allocatable :: area(:)
    !> The pair, numbered as they were added, and the node of its contact surface, (n).
    integer, allocatable :: pair(:), node(:)
    !> Directions of the gaps, from the contact surface towards the opposite one, (dimensions, n): unit vectors, but
    !> between smooth bodies the mean of those of the places that belong to the point. The force on the opposite body is
    !> force*direction, that on the contact body the opposite.
    real(dp), allocatable :: direction(:, :)
    !> The opposite face, (n); with FUGE_MORTAR that with the largest share of the gap.
    integer, allocatable :: face(:)
    !> Place in it, (dimensions - 1, n): xi in [-1, 1] on an edge, (xi, eta) in [-1, 1]**2 on a quadrangle; on a
    !> triangle (xi, eta) from corner 1, where corners 2 and 3 are (1, 0) and (0, 1). With FUGE_MORTAR the middle of
    !> what lies across in that face.
    real(dp), allocatable :: place(:, :)
    !> Pair and node of the nodes that have no opposite, and so are no contact points.
    integer, allocatable :: unpaired_pair(:), unpaired_node(:)
    !> Pairs of surfaces so far.
    integer :: pairs = 0
    !> A degree of freedom of the node of each contact point, 0 for a rigid one, (n).
    integer, allocatable, private :: owned(:)
  contains
    procedure :: points
    procedure :: set_owned
    procedure :: first_repeated
    procedure :: largest_dof
    procedure :: same_node
    procedure :: keep
  end type fuge_contact_pairs

contains

  !> Number of contact points.
  pure function points(self) result(n)
    class(fuge_contact_pairs), intent(in) :: self
    integer :: n

    n = 0
    if (allocated(self%gap)) n = size(self%gap)
  end function points

  !> Keep a degree of freedom of the node of each contact point, by which nodes in two pairs are found; `owned` (n)
  !> is moved.
  pure subroutine set_owned(self, owned)
    class(fuge_contact_pairs), intent(inout) :: self
    integer, allocatable, intent(inout) :: owned(:)

    call move_alloc(owned, self%owned)
  end subroutine set_owned

  !> The first contact point whose node belongs to a contact point of another pair too, and that one; or zeros.
  !> `before` is work space, one element for each degree of freedom.
  pure subroutine first_repeated(self, before, both)
    class(fuge_contact_pairs), intent(in) :: self
    integer, intent(out) :: before(:), both(2)
    integer :: i

    before = 0
    do i = 1, self%points()
      if (self%owned(i) == 0) cycle
      both = [before(self%owned(i)), i]
      if (both(1) == 0) then
        before(self%owned(i)) = i
      else if (self%pair(both(1)) /= self%pair(i)) then
        return
      end if
    end do
    both = 0
  end subroutine first_repeated

  !> The largest degree of freedom of the contact points and of their nodes; 0 if there are none.
  pure function largest_dof(self) result(largest)
    class(fuge_contact_pairs), intent(in) :: self
    integer :: largest

    largest = 0
    if (self%points() > 0) largest = max(0, maxval(self%dof), maxval(self%owned))
  end function largest_dof

  !> Are contact point `i` and point `j` of other pairs of the same node? Of rigid ones this is not known.
  pure function same_node(self, i, other, j) result(same)
    class(fuge_contact_pairs), intent(in) :: self
    integer, intent(in) :: i, j
    type(fuge_contact_pairs), intent(in) :: other
    logical :: same

    same = self%owned(i) == other%owned(j)
  end function same_node

  !> Move contact points without a copy.
  pure subroutine move_pairs(source, destination)
    type(fuge_contact_pairs), intent(inout) :: source, destination

    call move_alloc(source%dof, destination%dof)
    call move_alloc(source%normal, destination%normal)
    call move_alloc(source%gap, destination%gap)
    call move_alloc(source%gap_upper, destination%gap_upper)
    call move_alloc(source%area, destination%area)
    call move_alloc(source%pair, destination%pair)
    call move_alloc(source%node, destination%node)
    call move_alloc(source%direction, destination%direction)
    call move_alloc(source%face, destination%face)
    call move_alloc(source%place, destination%place)
    call move_alloc(source%unpaired_pair, destination%unpaired_pair)
    call move_alloc(source%unpaired_node, destination%unpaired_node)
    call move_alloc(source%owned, destination%owned)
    destination%pairs = source%pairs
    source%pairs = 0
  end subroutine move_pairs

  !> Keep the contact points that are `kept` (points), in their order. `stat` is not zero, and nothing has changed,
  !> without memory.
  pure subroutine keep(self, kept, stat)
    class(fuge_contact_pairs), intent(inout) :: self
    logical, intent(in) :: kept(:)
    integer, intent(out) :: stat
    type(fuge_contact_pairs) :: all
    integer, allocatable :: places(:)
    integer :: i, n

    n = count(kept)
    allocate (places(n), all%dof(size(self%dof, 1), n), all%normal(size(self%dof, 1), n), &
              all%direction(size(self%direction, 1), n), all%place(size(self%place, 1), n), all%gap(n), &
              all%gap_upper(n), all%area(n), all%pair(n), all%node(n), all%face(n), all%owned(n), stat=stat)
    if (stat /= 0) return
    places = pack([(i, i=1, size(kept))], kept)
    all%dof = self%dof(:, places)
    all%normal = self%normal(:, places)
    all%direction = self%direction(:, places)
    all%place = self%place(:, places)
    all%gap = self%gap(places)
    all%gap_upper = self%gap_upper(places)
    all%area = self%area(places)
    all%pair = self%pair(places)
    all%node = self%node(places)
    all%face = self%face(places)
    all%owned = self%owned(places)
    call move_alloc(all%dof, self%dof)
    call move_alloc(all%normal, self%normal)
    call move_alloc(all%direction, self%direction)
    call move_alloc(all%place, self%place)
    call move_alloc(all%gap, self%gap)
    call move_alloc(all%gap_upper, self%gap_upper)
    call move_alloc(all%area, self%area)
    call move_alloc(all%pair, self%pair)
    call move_alloc(all%node, self%node)
    call move_alloc(all%face, self%face)
    call move_alloc(all%owned, self%owned)
  end subroutine keep

  !> Refuse options that make no sense for this contact surface.
  pure subroutine check_pair_options(options, contact, info)
    type(fuge_pair_options), intent(in) :: options
    type(fuge_surface_mesh), intent(in) :: contact
    type(fuge_info), intent(inout) :: info

    if (options%method /= FUGE_MORTAR .and. options%method /= FUGE_NODE_TO_FACE) then
      call report(info, FUGE_ERR_OPTION, 'method = '//text(options%method)//' is not FUGE_MORTAR or FUGE_NODE_TO_FACE')
    else if (options%normals < FUGE_NORMALS_AVERAGED .or. options%normals > FUGE_NORMALS_GIVEN) then
      call report(info, FUGE_ERR_OPTION, 'normals = '//text(options%normals)//' is not FUGE_NORMALS_AVERAGED, ' &
                  //'FUGE_NORMALS_OPPOSITE or FUGE_NORMALS_GIVEN')
    else if (ieee_is_nan(options%reach) .or. ieee_is_nan(options%play) .or. ieee_is_nan(options%crease)) then
      ! Before they are compared, which might trap.
      call report(info, FUGE_ERR_NOT_FINITE, 'reach = '//text(options%reach)//', play = '//text(options%play) &
                  //', crease = '//text(options%crease)//': they need to be numbers')
    else if (options%reach > huge(1.0_dp)) then
      call report(info, FUGE_ERR_NOT_FINITE, 'reach is infinite: 0 stands for as far as the surfaces extend')
    else if (.not. (options%crease >= 0.0_dp .and. options%crease <= 90.0_dp)) then
      call report(info, FUGE_ERR_OPTION, 'crease = '//text(options%crease)//' is no angle between 0 and 90 degrees')
    else if (options%revolution .and. size(contact%node, 1) /= 2) then
      call report(info, FUGE_ERR_OPTION, 'revolution is for surfaces in the plane, sections of bodies of revolution; ' &
                  //'these are in space')
    else if (options%play < 0.0_dp) then
      call report(info, FUGE_ERR_GAP, 'play = '//text(options%play)//' is negative: the upper stop would lie below ' &
                  //'the lower one')
    else if (options%normals == FUGE_NORMALS_GIVEN) then
      call check_normals(options, contact, info)
    end if
  end subroutine check_pair_options

  !> Refuse given normals of another size than the nodes, not finite or without direction.
  pure subroutine check_normals(options, contact, info)
    type(fuge_pair_options), intent(in) :: options
    type(fuge_surface_mesh), intent(in) :: contact
    type(fuge_info), intent(inout) :: info
    integer :: f, i, k
    real(dp) :: largest

    if (.not. allocated(options%normal)) then
      call report(info, FUGE_ERR_SIZE, 'FUGE_NORMALS_GIVEN needs normal, one for each node of the contact surface')
    else if (any(shape(options%normal) /= shape(contact%node))) then
      call report(info, FUGE_ERR_SIZE, 'normal is '//text(size(options%normal, 1))//' by ' &
                  //text(size(options%normal, 2))//', node of the contact surface '//text(size(contact%node, 1)) &
                  //' by '//text(size(contact%node, 2))//': they need the same shape')
    end if
    if (info%failed()) return
    do f = 1, size(contact%face, 2)
      do k = 1, size(contact%face, 1)
        i = contact%face(k, f)
        if (i == 0) exit
        if (any(ieee_is_nan(options%normal(:, i)))) then
          call report(info, FUGE_ERR_NOT_FINITE, 'the normal of node '//index_text(i)//' is not a number')
          return
        end if
        largest = maxval(abs(options%normal(:, i)))
        if (largest > 0.0_dp .and. largest <= huge(largest)) cycle
        call report(info, FUGE_ERR_NOT_FINITE, 'the normal of node '//index_text(i)//' is zero or infinite: it ' &
                    //'needs a direction')
        return
      end do
    end do
  end subroutine check_normals

  !> Append the contact points of one pair, which are moved or copied. `stat` is not zero, and `pairs` as before,
  !> without memory.
  pure subroutine append_pairs(pairs, more, stat)
    type(fuge_contact_pairs), intent(inout) :: pairs
    type(fuge_contact_pairs), intent(inout) :: more
    integer, intent(out) :: stat
    type(fuge_contact_pairs) :: all
    integer :: n, unpaired

    stat = 0
    if (pairs%pairs == 0) then
      call move_pairs(more, pairs)
      return
    end if
    n = pairs%points() + more%points()
    unpaired = size(pairs%unpaired_node) + size(more%unpaired_node)
    associate (width => max(size(pairs%dof, 1), size(more%dof, 1)), dimensions => size(more%direction, 1))
      allocate (all%dof(width, n), all%normal(width, n), all%direction(dimensions, n), all%place(dimensions - 1, n), &
                all%gap(n), all%gap_upper(n), all%area(n), all%pair(n), all%node(n), all%face(n), all%owned(n), &
                all%unpaired_pair(unpaired), all%unpaired_node(unpaired), stat=stat)
    end associate
    if (stat /= 0) return
    all%dof = 0
    all%normal = 0.0_dp
    call copy_points(pairs, 0, 0, all)
    call copy_points(more, pairs%points(), size(pairs%unpaired_node), all)
    all%pairs = more%pairs
    call move_pairs(all, pairs)
  end subroutine append_pairs

  !> Copy contact points, and nodes that have no opposite, behind the first `points` and `unpaired` ones of `all`, which
  !> has room.
  pure subroutine copy_points(pairs, points, unpaired, all)
    type(fuge_contact_pairs), intent(in) :: pairs
    integer, intent(in) :: points, unpaired
    type(fuge_contact_pairs), intent(inout) :: all

    associate (width => size(pairs%dof, 1), first => points + 1, last => points + pairs%points())
      all%dof(:width, first:last) = pairs%dof
      all%normal(:width, first:last) = pairs%normal
      all%direction(:, first:last) = pairs%direction
      all%place(:, first:last) = pairs%place
      all%gap(first:last) = pairs%gap
      all%gap_upper(first:last) = pairs%gap_upper
      all%area(first:last) = pairs%area
      all%pair(first:last) = pairs%pair
      all%node(first:last) = pairs%node
      all%face(first:last) = pairs%face
      all%owned(first:last) = pairs%owned
    end associate
    associate (first => unpaired + 1, last => unpaired + size(pairs%unpaired_node))
      all%unpaired_pair(first:last) = pairs%unpaired_pair
      all%unpaired_node(first:last) = pairs%unpaired_node
    end associate
  end subroutine copy_points

end module fuge_contact_pairs_type
