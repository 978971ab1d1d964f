!> One-way links of a structure: supports that lift off, gaps between nodes, members in tension or in compression only.
!>
!> A link is a contact point of a body of finite elements: its force f >= 0 acts on one node along a direction, and on
!> the other one, if that is not the ground, against it; its gap opens by what the first node moves along the direction
!> more than the second. A strut pushes its ends apart, a cable pulls them together.
module fuge_links_type
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan, ieee_positive_inf, ieee_value
  use fuge_body_type, only: fuge_body
  use fuge_condensation, only: fuge_condensed
  use fuge_constants, only: LARGEST_EXPONENT, NAME_LENGTH
  use fuge_kinds, only: dp
  use fuge_load_cases_type, only: fuge_load_cases
  use fuge_number_text, only: index_text, text
  use fuge_problem_type, only: fuge_problem
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_CALL_ORDER, FUGE_ERR_DOF, FUGE_ERR_GAP, &
    FUGE_ERR_LAW, FUGE_ERR_NOT_FINITE, FUGE_ERR_OVERFLOW, FUGE_ERR_SIZE
  implicit none
  private

  public :: infinite_if_none

  !> Kind of a member: a cable.
  integer, parameter, public :: FUGE_TENSION_ONLY = 1
  !> Kind of a member: a strut.
  integer, parameter, public :: FUGE_COMPRESSION_ONLY = -1

  !> Degrees of freedom of a node that a direction may have, most.
  integer, parameter :: MOST_AXES = 6
  !> The first of them are translations, the others rotations.
  integer, parameter :: TRANSLATIONS = 3

  !> The law of a link, as that of a contact point in `fuge_problem`. As it is declared it is hard: no gap, no
  !> compliance, no second stop, no limits.
  type, public :: fuge_link_law
    !> Gap without load, length; negative: an interference.
    real(dp) :: gap = 0.0_dp
    !> Distance of a second stop from the first, length; huge(1.0_dp) or infinity: none.
    real(dp) :: play = huge(1.0_dp)
    !> Compliance of the link, length per force; 0: rigid.
    real(dp) :: compliance = 0.0_dp
    !> Limit of the force at the first stop; huge(1.0_dp) or infinity: none.
    real(dp) :: limit = huge(1.0_dp)
    !> Limit of the force at the second stop; huge(1.0_dp) or infinity: none.
    real(dp) :: limit_upper = huge(1.0_dp)
  end type fuge_link_law

  !> A straight member without bending, in tension or in compression only.
  type, public :: fuge_member
    !> FUGE_TENSION_ONLY or FUGE_COMPRESSION_ONLY.
    integer :: kind = FUGE_TENSION_ONLY
    !> Area of the section, > 0.
    real(dp) :: area = 0.0_dp
    !> Young's modulus, > 0.
    real(dp) :: modulus = 0.0_dp
    !> A cable is longer than the distance of its ends by so much, a strut shorter; length. Negative: it is prestressed.
    real(dp) :: slack = 0.0_dp
    !> Force at which it yields; 0: never.
    real(dp) :: yield = 0.0_dp
  end type fuge_member

  type :: link_row
    integer :: dof(2*MOST_AXES) = 0
    real(dp) :: normal(2*MOST_AXES) = 0.0_dp
    type(fuge_link_law) :: law = fuge_link_law()
    character(len=NAME_LENGTH) :: name = ''
  end type link_row

  !> Links in the order in which they were added: link k is contact point k.
  type, public :: fuge_links
    private
    type(link_row), allocatable :: rows(:)
    integer :: used = 0
  contains
    procedure :: count => link_count
    procedure :: name => link_name
    procedure :: add_support
    procedure :: add_gap
    procedure :: add_member
    procedure :: attach
    procedure :: pose
    procedure :: pose_cases
    procedure :: gaps
    procedure :: openings
    procedure :: last_degree
  end type fuge_links

contains

  !> A play or a limit as `fuge_problem` takes it: infinity where there is none.
  elemental function infinite_if_none(value) result(bound)
    real(dp), intent(in) :: value
    real(dp) :: bound

    bound = value
    if (value >= huge(1.0_dp)) bound = ieee_value(1.0_dp, ieee_positive_inf)
  end function infinite_if_none

  !> Number of links.
  pure function link_count(self) result(n)
    class(fuge_links), intent(in) :: self
    integer :: n

    n = self%used
  end function link_count

  !> Name of link k: the name given when it was added, else 'link ' and its number.
  pure function link_name(self, k) result(name)
    class(fuge_links), intent(in) :: self
    integer, intent(in) :: k
    character(len=NAME_LENGTH) :: name

    name = self%rows(k)%name
    if (name == '') name = 'link '//text(k)
  end function link_name

  !> Add a support of a node: it pushes the node along `direction`, and its gap opens when the node moves along it.
  !>
  !> `dof` degrees of freedom of the node, at most 6, 0 for a component that does not move; `direction`, a component for
  !> each, not all of them zero: the first three are translations, which are scaled to length 1 together, the others
  !> rotations, whose components are lever arms, length, by which they open the gap. So that of a plane frame is a
  !> fourth component or a later one. `law`, hard by default; `name` for messages. Errors, nothing added: FUGE_ERR_SIZE,
  !> FUGE_ERR_DOF where no degree of freedom moves along the direction, FUGE_ERR_NOT_FINITE, FUGE_ERR_GAP, FUGE_ERR_LAW,
  !> FUGE_ERR_MEMORY.
  subroutine add_support(self, dof, direction, info, law, name)
    class(fuge_links), intent(inout) :: self
    integer, intent(in) :: dof(:)
    real(dp), intent(in) :: direction(:)
    type(fuge_info), intent(out) :: info
    type(fuge_link_law), intent(in), optional :: law
    character(len=*), intent(in), optional :: name
    type(link_row) :: row

    call make_row(self%used + 1, dof, [integer ::], direction, row, info, law, name)
    if (.not. info%failed()) call add_row(self, row, info)
  end subroutine add_support

  !> Add a gap between two nodes: it closes when node a approaches node b along `direction`, which points from a to b;
  !> its force pushes them apart.
  !>
  !> `dof_a`, `dof_b` degrees of freedom of the nodes, as many of each; other arguments and errors as for `add_support`.
  subroutine add_gap(self, dof_a, dof_b, direction, info, law, name)
    class(fuge_links), intent(inout) :: self
    integer, intent(in) :: dof_a(:), dof_b(:)
    real(dp), intent(in) :: direction(:)
    type(fuge_info), intent(out) :: info
    type(fuge_link_law), intent(in), optional :: law
    character(len=*), intent(in), optional :: name
    type(link_row) :: row

    call make_row(self%used + 1, dof_b, dof_a, direction, row, info, law, name)
    if (.not. info%failed()) call add_row(self, row, info)
  end subroutine add_gap

  !> Add a straight member between two nodes that carries tension only, or compression only. Its force is positive
  !> where it carries.
  !>
  !> `dof_a`, `dof_b` displacements of its ends along the axes, 0 where an end does not move; `position_a`,
  !> `position_b` of as many components, length. The stiffness matrix must not have the member too
  !> (`fuge_remove_member`). Errors as for `add_support`; FUGE_ERR_LAW also for a member without length, and for an area
  !> or a modulus that is not positive; FUGE_ERR_OVERFLOW.
  subroutine add_member(self, dof_a, dof_b, position_a, position_b, member, info, name)
    class(fuge_links), intent(inout) :: self
    integer, intent(in) :: dof_a(:), dof_b(:)
    real(dp), intent(in) :: position_a(:), position_b(:)
    type(fuge_member), intent(in) :: member
    type(fuge_info), intent(out) :: info
    character(len=*), intent(in), optional :: name
    type(fuge_link_law) :: law
    type(link_row) :: row

    call check_member(self%used + 1, position_a, position_b, member, info, name)
    if (info%failed()) return
    law%gap = member%slack
    law%compliance = compliance_of(member, norm2(position_b - position_a))
    if (member%yield > 0.0_dp) law%limit = member%yield
    if (member%kind == FUGE_TENSION_ONLY) then
      ! Tension pulls the first end towards the second.
      call make_row(self%used + 1, dof_a, dof_b, position_b - position_a, row, info, law, name)
    else
      call make_row(self%used + 1, dof_b, dof_a, position_b - position_a, row, info, law, name)
    end if
    if (.not. info%failed()) call add_row(self, row, info)
  end subroutine add_member

  !> Make the links the contact points of `body`, before `fuge_condense`; those that its supports hold at both ends move
  !> with these alone (`held_points`). Errors, `body` unchanged: FUGE_ERR_CALL_ORDER without links, FUGE_ERR_MEMORY.
  subroutine attach(self, body, info)
    class(fuge_links), intent(in) :: self
    type(fuge_body), intent(inout) :: body
    type(fuge_info), intent(out) :: info
    integer, allocatable :: dof(:, :)
    real(dp), allocatable :: normal(:, :)
    integer :: k, width, stat

    if (self%used < 1) then
      call report(info, FUGE_ERR_CALL_ORDER, 'there are no links: add supports, gaps or members first')
      return
    end if
    width = 1
    do k = 1, self%used
      width = max(width, count(self%rows(k)%dof > 0))
    end do
    allocate (dof(width, self%used), normal(width, self%used), stat=stat)
    call require_memory(stat, 'the degrees of freedom of', self%used, 'links', info)
    if (stat /= 0) return
    dof = 0
    normal = 0.0_dp
    do k = 1, self%used
      associate (row => self%rows(k))
        dof(:count(row%dof > 0), k) = pack(row%dof, row%dof > 0)
        normal(:count(row%dof > 0), k) = pack(row%normal, row%dof > 0)
      end associate
    end do
    call move_alloc(dof, body%dof)
    call move_alloc(normal, body%normal)
    body%held_points = .true.
  end subroutine attach

  !> Pose the contact problem of the links of a condensed body: gaps, laws and the rigid modes that its supports leave;
  !> the ground stands still. `problem` is replaced. A link whose ends are held by supports of the body that stand still
  !> can never act: it is named in the message, with the status FUGE_DONE. Errors: those of `pose` of fuge_condensed.
  subroutine pose(self, condensed, problem, info)
    class(fuge_links), intent(in) :: self
    type(fuge_condensed), intent(in) :: condensed
    type(fuge_problem), intent(inout) :: problem
    type(fuge_info), intent(out) :: info
    type(fuge_problem) :: posed

    call start_problem(self, posed, info)
    if (.not. info%failed()) call condensed%pose(gaps(self), posed, info)
    if (info%failed()) return
    problem = posed
    call name_idle(self, condensed%held_points() .and. .not. abs(condensed%displacement) > 0.0_dp, info)
  end subroutine pose

  !> As `pose`, of many load cases: external `loads`, (degrees, cases), and perhaps displacements of the supports,
  !> (fixed, cases). The message names links that can act in none of them. Errors: those of `pose_cases` of
  !> fuge_condensed.
  subroutine pose_cases(self, condensed, loads, problem, cases, info, displacement)
    class(fuge_links), intent(in) :: self
    type(fuge_condensed), intent(in) :: condensed
    real(dp), intent(in) :: loads(:, :)
    type(fuge_problem), intent(inout) :: problem
    type(fuge_load_cases), intent(inout) :: cases
    type(fuge_info), intent(out) :: info
    real(dp), intent(in), optional :: displacement(:, :)
    type(fuge_problem) :: posed
    logical :: idle(self%used)
    integer :: k

    call start_problem(self, posed, info)
    if (info%failed()) return
    if (present(displacement)) then
      call condensed%pose_cases(gaps(self), loads, posed, cases, info, displacement)
    else
      call condensed%pose_cases(gaps(self), loads, posed, cases, info)
    end if
    if (info%failed()) return
    problem = posed
    idle = condensed%held_points()
    do k = 1, self%used
      idle(k) = idle(k) .and. .not. any(abs(cases%gap(k, :) - self%rows(k)%law%gap) > 0.0_dp)
    end do
    call name_idle(self, idle, info)
  end subroutine pose_cases

  !> Name the links that are `idle` (n), if there are any, in the message of `info`, whose status stays as it is.
  pure subroutine name_idle(self, idle, info)
    type(fuge_links), intent(in) :: self
    logical, intent(in) :: idle(:)
    type(fuge_info), intent(inout) :: info
    character(len=NAME_LENGTH) :: name

    if (.not. any(idle)) return
    name = link_name(self, findloc(idle, .true., dim=1))
    if (count(idle) == 1) then
      call report(info, info%status, trim(name)//' can never act: supports of the body hold its ends, whatever the ' &
                  //'loads are. Free these degrees of freedom, or leave it out')
    else
      call report(info, info%status, trim(name)//' and '//text(count(idle) - 1)//' other link(s) can never act: ' &
                  //'supports of the body hold their ends, whatever the loads are. Free these degrees of freedom, or ' &
                  //'leave them out')
    end if
  end subroutine name_idle

  !> Largest degree of freedom of any link; 0 without links.
  pure function last_degree(self)
    class(fuge_links), intent(in) :: self
    integer :: last_degree
    integer :: k

    last_degree = 0
    do k = 1, self%used
      last_degree = max(last_degree, maxval(self%rows(k)%dof))
    end do
  end function last_degree

  !> By how much displacements `u` of the body, at least `last_degree()`, open each link, (n), length.
  pure function openings(self, u) result(opening)
    class(fuge_links), intent(in) :: self
    real(dp), intent(in) :: u(:)
    real(dp) :: opening(self%used)
    integer :: j, k

    opening = 0.0_dp
    do k = 1, self%used
      do j = 1, size(self%rows(k)%dof)
        if (self%rows(k)%dof(j) > 0) opening(k) = opening(k) + self%rows(k)%normal(j)*u(self%rows(k)%dof(j))
      end do
    end do
  end function openings

  !> Gap of each link without load, (n), length; those of members are their slack.
  pure function gaps(self)
    class(fuge_links), intent(in) :: self
    real(dp) :: gaps(self%used)

    gaps = self%rows(:self%used)%law%gap
  end function gaps

  !> Laws of the points, and no motion: the ground stands still. Error: FUGE_ERR_MEMORY.
  pure subroutine start_problem(self, problem, info)
    type(fuge_links), intent(in) :: self
    type(fuge_problem), intent(out) :: problem
    type(fuge_info), intent(out) :: info
    integer :: stat

    allocate (problem%modes(self%used, 0), problem%resultant(0), stat=stat)
    call require_memory(stat, 'the laws of the links', info)
    if (stat /= 0) return
    associate (law => self%rows(:self%used)%law)
      if (any(law%play < huge(1.0_dp))) problem%gap_upper = infinite_if_none(law%play)
      if (any(law%compliance > 0.0_dp)) problem%compliance = law%compliance
      if (any(law%limit < huge(1.0_dp))) problem%limit = infinite_if_none(law%limit)
      if (any(law%limit_upper < huge(1.0_dp) .and. law%play < huge(1.0_dp))) &
        problem%limit_upper = infinite_if_none(law%limit_upper)
    end associate
  end subroutine start_problem

  !> The row of a link, number `k`, whose force acts on `dof_a` along the direction, on `dof_b`, if there is one,
  !> against it. Eight arguments, of which the last two are those of the caller.
  subroutine make_row(k, dof_a, dof_b, direction, row, info, law, name)
    integer, intent(in) :: k, dof_a(:), dof_b(:)
    real(dp), intent(in) :: direction(:)
    type(link_row), intent(out) :: row
    type(fuge_info), intent(out) :: info
    type(fuge_link_law), intent(in), optional :: law
    character(len=*), intent(in), optional :: name
    real(dp) :: unit(size(direction))
    character(len=NAME_LENGTH) :: own

    if (present(law)) row%law = law
    if (present(name)) row%name = name
    own = called(k, row%name)
    if (size(dof_a) < 1 .or. size(dof_a) > MOST_AXES .or. all(size(dof_b) /= [0, size(dof_a)]) &
        .or. size(direction) /= size(dof_a)) then
      call report(info, FUGE_ERR_SIZE, trim(own)//' has '//text(size(dof_a))//' and '//text(size(dof_b)) &
                  //' degrees of freedom and a direction of '//text(size(direction))//' components: each node needs ' &
                  //'one for each component, at most '//text(MOST_AXES))
    else if (.not. all(ieee_is_finite(direction))) then
      call report(info, FUGE_ERR_NOT_FINITE, 'the direction of '//trim(own)//' is not finite')
    else if (.not. any(abs(direction) > 0.0_dp)) then
      call report(info, FUGE_ERR_DOF, 'the direction of '//trim(own)//' is zero: give that of its force')
    else
      call check_law(row%law, trim(own), info)
    end if
    if (info%failed()) return
    unit = direction
    associate (translation => unit(:min(TRANSLATIONS, size(unit))))
      if (any(abs(translation) > 0.0_dp)) then
        translation = translation/maxval(abs(translation))
        translation = translation/norm2(translation)
      end if
    end associate
    call place(dof_a, unit, row%dof(:MOST_AXES), row%normal(:MOST_AXES))
    call place(dof_b, -unit, row%dof(MOST_AXES + 1:), row%normal(MOST_AXES + 1:))
    if (any(dof_a < 0) .or. any(dof_b < 0)) then
      call report(info, FUGE_ERR_DOF, trim(own)//' has a negative degree of freedom: '//index_text(0) &
                  //' is one that does not move')
    else if (.not. any(row%dof > 0)) then
      call report(info, FUGE_ERR_DOF, trim(own)//' moves along no degree of freedom: its ends do not move ' &
                  //'along its direction')
    end if
  end subroutine make_row

  !> Degrees of freedom that move along the direction.
  pure subroutine place(dof, unit, places, normal)
    integer, intent(in) :: dof(:)
    real(dp), intent(in) :: unit(:)
    integer, intent(inout) :: places(:)
    real(dp), intent(inout) :: normal(:)
    integer :: j

    do j = 1, size(dof)
      if (.not. abs(unit(j)) > 0.0_dp) cycle
      places(j) = dof(j)
      normal(j) = unit(j)
    end do
  end subroutine place

  !> Refuse a law without sense: FUGE_ERR_NOT_FINITE, FUGE_ERR_GAP, FUGE_ERR_LAW.
  subroutine check_law(law, name, info)
    type(fuge_link_law), intent(in) :: law
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info

    if (.not. (ieee_is_finite(law%gap) .and. ieee_is_finite(law%compliance)) .or. ieee_is_nan(law%play) &
        .or. ieee_is_nan(law%limit) .or. ieee_is_nan(law%limit_upper)) then
      call report(info, FUGE_ERR_NOT_FINITE, 'the gap, the play, the compliance or a limit of '//name//' is no number')
    else if (.not. law%play >= 0.0_dp) then
      call report(info, FUGE_ERR_GAP, 'the play of '//name//' is '//text(law%play)//': its second stop lies below ' &
                  //'the first one; take infinity for none')
    else if (.not. (law%compliance >= 0.0_dp .and. law%limit >= 0.0_dp .and. law%limit_upper >= 0.0_dp)) then
      call report(info, FUGE_ERR_LAW, 'the compliance or a limit of '//name//' is negative')
    end if
  end subroutine check_law

  !> Refuse a member without length, area or modulus (FUGE_ERR_LAW), and numbers that are none.
  subroutine check_member(k, position_a, position_b, member, info, name)
    integer, intent(in) :: k
    real(dp), intent(in) :: position_a(:), position_b(:)
    type(fuge_member), intent(in) :: member
    type(fuge_info), intent(out) :: info
    character(len=*), intent(in), optional :: name
    character(len=NAME_LENGTH) :: own

    own = ''
    if (present(name)) own = name
    own = called(k, own)
    if (size(position_a) /= size(position_b)) then
      call report(info, FUGE_ERR_SIZE, 'the ends of '//trim(own)//' have '//text(size(position_a))//' and ' &
                  //text(size(position_b))//' coordinates')
    else if (.not. (all(ieee_is_finite(position_a)) .and. all(ieee_is_finite(position_b)) &
                    .and. all(ieee_is_finite([member%area, member%modulus, member%slack, member%yield])))) then
      call report(info, FUGE_ERR_NOT_FINITE, 'a position, the section or the slack of '//trim(own) &
                  //' is not finite')
    else if (.not. any(abs(position_b - position_a) > 0.0_dp)) then
      call report(info, FUGE_ERR_LAW, trim(own)//' has no length: its ends are at the same place; take add_gap ' &
                  //'with a direction')
    else if (.not. (member%area > 0.0_dp .and. member%modulus > 0.0_dp .and. member%yield >= 0.0_dp)) then
      call report(info, FUGE_ERR_LAW, trim(own)//' has the area '//text(member%area)//', the modulus ' &
                  //text(member%modulus)//' and the yield force '//text(member%yield)//': the first two have to be ' &
                  //'positive, the third one must not be negative')
    else if (all(member%kind /= [FUGE_TENSION_ONLY, FUGE_COMPRESSION_ONLY])) then
      call report(info, FUGE_ERR_LAW, trim(own)//' is of kind '//text(member%kind)//': take FUGE_TENSION_ONLY ' &
                  //'or FUGE_COMPRESSION_ONLY')
    else if (abs(exponent(norm2(position_b - position_a)) - exponent(member%area) - exponent(member%modulus)) &
             > LARGEST_EXPONENT) then
      call report(info, FUGE_ERR_OVERFLOW, 'the compliance of '//trim(own)//' is out of range: choose other units')
    end if
  end subroutine check_member

  !> Length over area and modulus, whose product need not be in the range of numbers.
  pure function compliance_of(member, length) result(compliance)
    type(fuge_member), intent(in) :: member
    real(dp), intent(in) :: length
    real(dp) :: compliance

    compliance = scale(fraction(length)/fraction(member%area)/fraction(member%modulus), &
                       exponent(length) - exponent(member%area) - exponent(member%modulus))
  end function compliance_of

  !> What messages call link `k`.
  pure function called(k, name) result(words)
    integer, intent(in) :: k
    character(len=*), intent(in) :: name
    character(len=NAME_LENGTH) :: words

    words = name
    if (name == '') words = 'link '//text(k)
  end function called

  !> Add a row at the end; the room doubles. Error: FUGE_ERR_MEMORY.
  subroutine add_row(self, row, info)
    class(fuge_links), intent(inout) :: self
    type(link_row), intent(in) :: row
    type(fuge_info), intent(inout) :: info
    type(link_row), allocatable :: larger(:)
    integer :: room, stat

    room = 0
    if (allocated(self%rows)) room = size(self%rows)
    if (self%used == room) then
      allocate (larger(max(16, 2*self%used)), stat=stat)
      call require_memory(stat, '', 2*self%used, 'links', info)
      if (stat /= 0) return
      if (room > 0) larger(:self%used) = self%rows
      call move_alloc(larger, self%rows)
    end if
    self%used = self%used + 1
    self%rows(self%used) = row
  end subroutine add_row

end module fuge_links_type
