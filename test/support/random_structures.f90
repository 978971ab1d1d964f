!> Random structures with one-way members and supports: trusses with cables, grillages on supports that lift off, pipes
!> in guides with play, rafts on a bed that does not pull. The number of a structure says all of it. Many are even:
!> members are alike, gaps equal and loads symmetric, so that rows are at the corner of their law.
module random_structures
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_kinds, only: dp
  use general_reference, only: draw
  use special_numbers, only: infinity
  use one_way_structures, only: add_member, add_row, begin_rows, one_way_structure
  use raft_plates, only: plate_stiffness
  use random_draws, only: chance, decimal, one_of, seed_of, uniform
  use structure_members, only: bar, bar_direction, frame_beam, grillage_beam
  implicit none
  private

  public :: draw_grillage, draw_pipe, draw_raft, draw_structure, draw_truss

  real(dp), parameter :: PI = acos(-1.0_dp)

contains

  !> Structure `number` >= 1 of any kind.
  subroutine draw_structure(number, structure)
    integer, intent(in) :: number
    type(one_way_structure), intent(out) :: structure
    integer(int64) :: seed

    ! Not the draws of the structure itself.
    seed = seed_of(number + 1000000)
    select case (mod(number, 4))
    case (1)
      call draw_truss(number, 2*(7 + int(23.9_dp*uniform(seed, 0.0_dp, 1.0_dp)**2)), structure)
    case (2)
      call draw_grillage(number, structure)
    case (3)
      call draw_pipe(number, structure)
    case default
      call draw_raft(number, structure)
    end select
    if (chance(seed, 0.1_dp)) structure%compliance = 1.0e-6_dp*structure%compliance
    if (chance(seed, 0.3_dp)) call change_units(seed, structure)
  end subroutine draw_structure

  !> Other units of force and of length, rotations included.
  subroutine change_units(seed, structure)
    integer(int64), intent(inout) :: seed
    type(one_way_structure), intent(inout) :: structure
    real(dp) :: force, length

    force = decimal(seed, -9.0_dp, 9.0_dp)
    length = decimal(seed, -9.0_dp, 9.0_dp)
    structure%stiffness = structure%stiffness*(force/length)
    structure%compliance = structure%compliance*(length/force)
    structure%load = structure%load*force
    structure%limit = structure%limit*force
    structure%limit_upper = structure%limit_upper*force
    structure%gap = structure%gap*length
    structure%play = structure%play*length
  end subroutine change_units

  !> A value between `low` and `high`, its middle where the structure is even.
  function varied(seed, even, low, high) result(value)
    integer(int64), intent(inout) :: seed
    logical, intent(in) :: even
    real(dp), intent(in) :: low, high
    real(dp) :: value

    value = uniform(seed, low, high)
    if (even) value = 0.5_dp*(low + high)
  end function varied

  !> A truss with an even number of `cables` (at least 4): storeys braced by crossing cables, or a stiff truss that
  !> cables stay.
  subroutine draw_truss(number, cables, structure)
    integer, intent(in) :: number, cables
    type(one_way_structure), intent(out) :: structure
    integer(int64) :: seed
    logical :: even

    seed = seed_of(number)
    even = chance(seed, 0.3_dp)
    if (chance(seed, 0.5_dp)) then
      call draw_braced(seed, even, cables/2, structure)
    else
      call draw_stayed(seed, even, cables, structure)
    end if
    structure%number = number
    structure%kind = 'truss'
    call draw_slack(seed, even, structure)
  end subroutine draw_truss

  !> Storeys of posts and beams, with a pair of crossing cables in each of the `bays`. Some have soft diagonals too;
  !> without them the storeys sway.
  subroutine draw_braced(seed, even, bays, structure)
    integer(int64), intent(inout) :: seed
    logical, intent(in) :: even
    integer, intent(in) :: bays
    type(one_way_structure), intent(inout) :: structure
    real(dp), allocatable :: place(:, :)
    real(dp) :: softness
    integer :: columns, i, j, k, storeys
    logical :: sways

    columns = 1 + int(sqrt(real(bays, dp)))
    do while (mod(bays, columns) /= 0)
      columns = columns - 1
    end do
    storeys = bays/columns
    if (chance(seed, 0.5_dp)) call swap(columns, storeys)
    sways = chance(seed, 0.3_dp)
    softness = decimal(seed, -3.0_dp, 0.0_dp)
    allocate (place(2, (columns + 1)*(storeys + 1)))
    do k = 1, size(place, 2)
      place(1, k) = real(mod(k - 1, columns + 1), dp) + varied(seed, even, -0.2_dp, 0.2_dp)
      place(2, k) = real((k - 1)/(columns + 1), dp) + varied(seed, even, -0.2_dp, 0.2_dp)
    end do
    call begin_rows(2*(columns + 1)*storeys, structure)
    structure%floats = sways
    do j = 1, storeys
      do i = 1, columns + 1
        k = i + j*(columns + 1)
        call add_bar(k, k - columns - 1, varied(seed, even, 0.5_dp, 2.0_dp))
        if (i > columns) cycle
        call add_bar(k, k + 1, varied(seed, even, 0.5_dp, 2.0_dp))
        call add_cable(k, k - columns, varied(seed, even, 0.1_dp, 1.0_dp))
        call add_cable(k + 1, k - columns - 1, varied(seed, even, 0.1_dp, 1.0_dp))
        if (.not. sways) call add_bar(k, k - columns, softness*varied(seed, even, 0.1_dp, 1.0_dp))
      end do
    end do
    call load_nodes(seed, even, structure)

  contains

    subroutine add_bar(a, b, axial)
      integer, intent(in) :: a, b
      real(dp), intent(in) :: axial

      call add_member(dof_of(a, b), bar(place(:, a), place(:, b), axial), structure)
    end subroutine add_bar

    subroutine add_cable(a, b, axial)
      integer, intent(in) :: a, b
      real(dp), intent(in) :: axial

      ! Longer means more open with the normals of a support, less with those of a cable.
      call add_row(dof_of(a, b), -bar_direction(place(:, a), place(:, b)), 0.0_dp, &
                   norm2(place(:, a) - place(:, b))/axial, structure)
    end subroutine add_cable

    !> The lowest nodes are held.
    pure function dof_of(a, b) result(dof)
      integer, intent(in) :: a, b
      integer :: dof(4)

      dof = max(0, 2*([a, a, b, b] - columns - 1) - [1, 0, 1, 0])
    end function dof_of

  end subroutine draw_braced

  pure subroutine swap(a, b)
    integer, intent(inout) :: a, b
    integer :: other

    other = a
    a = b
    b = other
  end subroutine swap

  !> A triangulated cantilever or a girder on two supports, with cables between any two of its nodes, or to anchors.
  subroutine draw_stayed(seed, even, cables, structure)
    integer(int64), intent(inout) :: seed
    logical, intent(in) :: even
    integer, intent(in) :: cables
    type(one_way_structure), intent(inout) :: structure
    real(dp), allocatable :: place(:, :)
    real(dp) :: from(2), axial
    integer :: bays, k, n, node, other
    integer, allocatable :: dof(:), stayed(:)
    logical :: cantilever

    bays = 3 + cables/4
    n = 2*(bays + 1)
    cantilever = chance(seed, 0.5_dp)
    allocate (place(2, n), dof(2*n), stayed(cables))
    stayed = 0
    do k = 1, n
      place(:, k) = [real((k - 1)/2, dp), real(mod(k - 1, 2), dp)]
      if (.not. even) place(:, k) = place(:, k) + 0.2_dp*[varied(seed, even, -1.0_dp, 1.0_dp), 0.0_dp]
    end do
    dof = [(k, k=1, 2*n)]
    if (cantilever) then
      dof = max(0, dof - 4)
    else
      ! A fixed bearing at the left end below, a sliding one at the right end.
      dof = max(0, dof - 2)
      dof(2*n - 2:) = [0, dof(2*n - 2), dof(2*n - 1)]
    end if
    call begin_rows(maxval(dof), structure)
    do k = 1, n - 1
      call connect(k, k + 1, varied(seed, even, 0.5_dp, 2.0_dp))
      if (k < n - 1) call connect(k, k + 2, varied(seed, even, 0.5_dp, 2.0_dp))
    end do
    do k = 1, cables
      axial = decimal(seed, -1.5_dp, 1.0_dp)
      if (even) axial = 0.5_dp
      do
        node = one_of(seed, n)
        other = one_of(seed, n)
        if (node == other) cycle
        if (maxval([dof(2*node - 1:2*node), dof(2*other - 1:2*other)]) < 1) cycle
        ! Cables at the sliding bearing would all pull in one direction.
        if (.not. cantilever .and. (node == n - 1 .or. other == n - 1)) cycle
        if (.not. any(stayed(:k - 1) == min(node, other) + n*max(node, other))) exit
      end do
      if (chance(seed, 0.5_dp)) then
        stayed(k) = min(node, other) + n*max(node, other)
        call stay(node, place(:, other), dof(2*other - 1:2*other), axial)
      else
        if (maxval(dof(2*node - 1:2*node)) < 1) node = 3
        from = [uniform(seed, -1.0_dp, real(bays + 1, dp)), 3.0_dp]
        if (chance(seed, 0.5_dp)) from(2) = -3.0_dp
        call stay(node, from, [0, 0], axial)
      end if
    end do
    call load_nodes(seed, even, structure)

  contains

    subroutine connect(a, b, stiffness)
      integer, intent(in) :: a, b
      real(dp), intent(in) :: stiffness

      call add_member([dof(2*a - 1:2*a), dof(2*b - 1:2*b)], bar(place(:, a), place(:, b), stiffness), structure)
    end subroutine connect

    subroutine stay(a, there, there_dof, stiffness)
      integer, intent(in) :: a, there_dof(2)
      real(dp), intent(in) :: there(2), stiffness

      call add_row([dof(2*a - 1:2*a), there_dof], -bar_direction(place(:, a), there), 0.0_dp, &
                   norm2(place(:, a) - there)/stiffness, structure)
    end subroutine stay

  end subroutine draw_stayed

  !> Loads of either sign on all degrees of freedom, on some of them, or on one.
  subroutine load_nodes(seed, even, structure)
    integer(int64), intent(inout) :: seed
    logical, intent(in) :: even
    type(one_way_structure), intent(inout) :: structure
    integer :: k

    if (even) then
      structure%load(1::2) = real(one_of(seed, 3) - 2, dp)
      structure%load(2::2) = real(one_of(seed, 3) - 2, dp)
      if (chance(seed, 0.3_dp)) structure%load = 0.0_dp
      k = one_of(seed, size(structure%load))
      structure%load(k) = structure%load(k) + 1.0_dp
      return
    end if
    call draw(seed, structure%load)
    structure%load = 2.0_dp*structure%load - 1.0_dp
    if (chance(seed, 0.3_dp)) then
      where (abs(structure%load) < 0.7_dp) structure%load = 0.0_dp
    end if
  end subroutine load_nodes

  !> Slack cables, cables under tension and cables that yield.
  subroutine draw_slack(seed, even, structure)
    integer(int64), intent(inout) :: seed
    logical, intent(in) :: even
    type(one_way_structure), intent(inout) :: structure
    real(dp) :: drawn(structure%rows()), size_of

    size_of = decimal(seed, -2.0_dp, 1.0_dp)
    if (chance(seed, 0.6_dp)) then
      call draw(seed, drawn)
      if (chance(seed, 0.5_dp)) drawn = drawn - 0.5_dp
      structure%gap = size_of*drawn
      if (even) structure%gap = size_of*merge(1.0_dp, 0.0_dp, drawn > 0.5_dp)
    end if
    ! Not where nothing else holds a mechanism.
    if (structure%floats) return
    if (.not. chance(seed, 0.1_dp)) return
    call draw(seed, drawn)
    structure%limit = merge(1.0_dp, 3.0_dp*drawn, even)
    call draw(seed, drawn)
    where (drawn < 0.5_dp) structure%limit = infinity()
  end subroutine draw_slack

  !> Beams that cross on supports which lift off; some have supports that pull, or nothing else.
  subroutine draw_grillage(number, structure)
    integer, intent(in) :: number
    type(one_way_structure), intent(out) :: structure
    integer(int64) :: seed
    real(dp) :: bending_stiffness, torsion, spacing(2), soft
    real(dp), allocatable :: drawn(:), hold(:)
    integer :: k, nx, ny
    logical :: even, rigid

    seed = seed_of(number)
    even = chance(seed, 0.4_dp)
    nx = 1 + one_of(seed, 4)
    ny = 1 + one_of(seed, 4)
    call begin_rows(3*nx*ny, structure)
    structure%number = number
    structure%kind = 'grillage'
    structure%floats = chance(seed, 0.4_dp)
    spacing(1) = varied(seed, even, 1.0_dp, 2.0_dp)
    spacing(2) = varied(seed, even, 1.0_dp, 2.0_dp)
    bending_stiffness = decimal(seed, -1.0_dp, 2.0_dp)
    torsion = bending_stiffness*decimal(seed, -2.0_dp, 0.0_dp)
    do k = 1, nx*ny
      if (mod(k, nx) /= 0) &
        call add_member(along_x(k, k + 1), grillage_beam(spacing(1), bending_stiffness, torsion), structure)
      if (k <= nx*(ny - 1)) &
        call add_member(along_y(k, k + nx), grillage_beam(spacing(2), bending_stiffness, torsion), structure)
    end do
    allocate (drawn(nx*ny), hold(nx*ny))
    if (.not. structure%floats) call hold_nodes(seed, even, structure)
    rigid = chance(seed, 0.3_dp)
    soft = decimal(seed, -2.0_dp, 1.0_dp)
    call draw(seed, drawn)
    call draw(seed, hold)
    do k = 1, nx*ny
      ! The corners of a loose grillage carry whatever presses down.
      if (drawn(k) < 0.6_dp .or. structure%floats .and. is_corner(k)) then
        call add_row([3*k - 2], [1.0_dp], 0.0_dp, merge(0.0_dp, soft*merge(1.0_dp, hold(k), even), rigid), structure)
      else if (drawn(k) > 0.9_dp) then
        call add_row([3*k - 2], [-1.0_dp], 0.1_dp*soft, soft, structure)
      end if
    end do
    if (structure%rows() < 1) call add_row([1], [1.0_dp], 0.0_dp, soft, structure)
    call load_deck(seed, even, structure)
    call settle_supports(seed, even, 0.3_dp*spacing(1)**3/bending_stiffness, structure)

  contains

    pure function along_x(a, b) result(dof)
      integer, intent(in) :: a, b
      integer :: dof(6)

      dof = [3*a - 2, 3*a - 1, 3*a, 3*b - 2, 3*b - 1, 3*b]
    end function along_x

    pure function along_y(a, b) result(dof)
      integer, intent(in) :: a, b
      integer :: dof(6)

      dof = [3*a - 2, 3*a, 3*a - 1, 3*b - 2, 3*b, 3*b - 1]
    end function along_y

    pure logical function is_corner(node)
      integer, intent(in) :: node

      is_corner = any(node == [1, nx, nx*(ny - 1) + 1, nx*ny])
    end function is_corner

  end subroutine draw_grillage

  !> Springs of either sign at three nodes or more, which are not in a row.
  subroutine hold_nodes(seed, even, structure)
    integer(int64), intent(inout) :: seed
    logical, intent(in) :: even
    type(one_way_structure), intent(inout) :: structure
    integer :: k, nodes
    real(dp) :: stiffness

    nodes = structure%degrees()/3
    do k = 1, 3
      stiffness = varied(seed, even, 0.2_dp, 5.0_dp)
      call add_member([3*one_of(seed, nodes) - 2], reshape([stiffness], [1, 1]), structure)
    end do
    ! Whichever nodes these are, one of them is clamped.
    k = one_of(seed, nodes)
    call add_member([3*k - 2, 3*k - 1, 3*k], reshape([1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, &
                                                      1.0_dp], [3, 3]), structure)
  end subroutine hold_nodes

  !> Weight and single loads on decks with the degrees of freedom w, w_x, w_y; some lift where the deck is held, and
  !> rarely where it is not.
  subroutine load_deck(seed, even, structure)
    integer(int64), intent(inout) :: seed
    logical, intent(in) :: even
    type(one_way_structure), intent(inout) :: structure
    real(dp) :: weight
    integer :: j, k, nodes
    logical :: lifts

    nodes = structure%degrees()/3
    weight = varied(seed, even, 0.0_dp, 1.0_dp)
    if (chance(seed, 0.4_dp)) weight = 0.0_dp
    ! A single load at the edge of a loose deck leaves no unique motion, and rounding decides whether it is carried.
    if (structure%floats) weight = weight + 0.05_dp
    structure%load(1::3) = -weight
    lifts = chance(seed, 0.03_dp)
    lifts = lifts .or. .not. structure%floats
    do j = 1, one_of(seed, 4)
      k = 3*one_of(seed, nodes) - 2
      structure%load(k) = structure%load(k) - real(nodes, dp)*varied(seed, even, 0.0_dp, 1.0_dp)
      if (lifts) structure%load(k) = structure%load(k) + real(nodes, dp)*varied(seed, even, 0.0_dp, 1.0_dp)
    end do
  end subroutine load_deck

  !> Supports that are not level.
  subroutine settle_supports(seed, even, size_of, structure)
    integer(int64), intent(inout) :: seed
    logical, intent(in) :: even
    real(dp), intent(in) :: size_of
    type(one_way_structure), intent(inout) :: structure
    real(dp) :: drawn(structure%rows())

    call draw(seed, drawn)
    if (chance(seed, 0.4_dp)) structure%gap = structure%gap + size_of*merge(real(nint(drawn), dp), drawn, even)
  end subroutine settle_supports

  !> A pipe of several straight legs between anchors, heated and loaded, in guides and line stops with play.
  subroutine draw_pipe(number, structure)
    integer, intent(in) :: number
    type(one_way_structure), intent(out) :: structure
    integer(int64) :: seed
    integer :: each, k, legs, n
    real(dp) :: axial, bending_stiffness, heading, strain, clearance, turn, force(3)
    real(dp), allocatable :: place(:, :), guide(:, :)
    logical :: even, far_end, near_end

    seed = seed_of(number)
    even = chance(seed, 0.4_dp)
    legs = one_of(seed, 4)
    each = 2 + one_of(seed, 4)
    n = legs*each + 1
    near_end = .not. chance(seed, 0.1_dp)
    far_end = chance(seed, 0.7_dp)
    axial = 1.0_dp
    bending_stiffness = decimal(seed, -3.0_dp, -1.0_dp)
    strain = uniform(seed, -0.1_dp, 0.3_dp)
    if (chance(seed, 0.3_dp)) strain = 0.0_dp
    clearance = decimal(seed, -3.0_dp, 0.0_dp)
    heading = 0.0_dp
    allocate (place(2, n), guide(2, n))
    place(:, 1) = 0.0_dp
    do k = 2, n
      if (k > 2 .and. mod(k - 2, each) == 0) then
        turn = 0.5_dp*PI*varied(seed, even, 0.6_dp, 1.4_dp)
        if (chance(seed, 0.5_dp)) turn = -turn
        heading = heading + turn
      end if
      place(:, k) = place(:, k - 1) + [cos(heading), sin(heading)]*varied(seed, even, 0.7_dp, 1.3_dp)
    end do
    call begin_rows(3*n - merge(3, 0, near_end) - merge(3, 0, far_end), structure)
    structure%number = number
    structure%kind = 'pipe'
    structure%floats = .not. (near_end .or. far_end)
    do k = 2, n
      associate (from => place(:, k - 1), to => place(:, k), dof => [node_dof(k - 1), node_dof(k)])
        call add_member(dof, frame_beam(from, to, axial, bending_stiffness), structure)
        ! Heat pushes the ends apart.
        call push(dof([1, 2, 4, 5]), axial*strain*bar_direction(from, to))
        guide(:, k) = (to - from)/norm2(to - from)
      end associate
    end do
    guide(:, 1) = guide(:, 2)
    do k = 1, n
      if (k == 1 .and. near_end .or. k == n .and. far_end) cycle
      call draw_guides(k)
      if (chance(seed, 0.5_dp)) cycle
      force(1) = varied(seed, even, -0.05_dp, 0.05_dp)
      force(2) = varied(seed, even, -0.1_dp, 0.02_dp)
      force(3) = 0.0_dp
      call push(node_dof(k), force)
    end do
    if (structure%rows() < 1) call add_guide(merge(2, n, n > 2), guide(:, 2), 0.0_dp)

  contains

    !> A guide across the pipe and a stop along it, at most one of each.
    subroutine draw_guides(node)
      integer, intent(in) :: node
      real(dp) :: across(2), compliance
      logical :: guided, stiff, stopped

      across = [-guide(2, node), guide(1, node)]
      compliance = decimal(seed, -3.0_dp, 0.0_dp)
      stiff = chance(seed, 0.4_dp)
      if (stiff .and. .not. structure%floats) compliance = 0.0_dp
      guided = chance(seed, 0.7_dp)
      if (guided .or. structure%floats) call add_guide(node, across, compliance)
      stopped = chance(seed, 0.2_dp)
      if (stopped .or. node == 1) call add_guide(node, guide(:, node), compliance)
    end subroutine draw_guides

    subroutine add_guide(node, direction, compliance)
      integer, intent(in) :: node
      real(dp), intent(in) :: direction(2), compliance
      integer :: dof(3), row
      logical :: one_sided, yields

      dof = node_dof(node)
      call add_row(dof(:2), direction, 0.0_dp, compliance, structure)
      row = structure%rows()
      one_sided = chance(seed, 0.2_dp)
      if (one_sided .and. .not. structure%floats) return
      structure%play(row) = clearance*varied(seed, even, 0.0_dp, 1.0_dp)
      if (chance(seed, 0.1_dp)) structure%play(row) = 0.0_dp
      structure%gap(row) = structure%play(row)*varied(seed, even, 0.0_dp, 1.0_dp)
      yields = chance(seed, 0.1_dp)
      if (structure%floats .or. .not. yields) return
      structure%limit(row) = varied(seed, even, 0.0_dp, 0.1_dp)
      structure%limit_upper(row) = varied(seed, even, 0.0_dp, 0.1_dp)
    end subroutine add_guide

    pure function node_dof(node) result(dof)
      integer, intent(in) :: node
      integer :: dof(3)

      dof = 3*node - [2, 1, 0] - merge(3, 0, near_end)
      if (node == n .and. far_end .or. node == 1 .and. near_end) dof = 0
    end function node_dof

    subroutine push(dof, force)
      integer, intent(in) :: dof(:)
      real(dp), intent(in) :: force(:)
      integer :: j

      do j = 1, size(dof)
        if (dof(j) > 0) structure%load(dof(j)) = structure%load(dof(j)) + force(j)
      end do
    end subroutine push

  end subroutine draw_pipe

  !> A plate on soil that does not pull, under columns; some soils are of limited strength, some have holes, and some
  !> rafts are on piles besides.
  subroutine draw_raft(number, structure)
    integer, intent(in) :: number
    type(one_way_structure), intent(out) :: structure
    integer(int64) :: seed
    integer :: i, j, k, nx, ny
    real(dp) :: element(12, 12), stiffness, rigidity, area
    logical :: even

    seed = seed_of(number)
    even = chance(seed, 0.4_dp)
    nx = 1 + one_of(seed, 4)
    ny = 1 + one_of(seed, 4)
    call begin_rows(3*(nx + 1)*(ny + 1), structure)
    structure%number = number
    structure%kind = 'raft'
    structure%floats = .not. chance(seed, 0.2_dp)
    rigidity = decimal(seed, -2.0_dp, 1.0_dp)
    stiffness = decimal(seed, -1.0_dp, 1.0_dp)
    element = plate_stiffness(1.0_dp, varied(seed, even, 0.7_dp, 1.3_dp), rigidity, 0.2_dp)
    do j = 1, ny
      do i = 1, nx
        k = i + (j - 1)*(nx + 1)
        call add_member([node(k), node(k + 1), node(k + nx + 1), node(k + nx + 2)], element, structure)
      end do
    end do
    if (.not. structure%floats) call hold_nodes(seed, even, structure)
    do j = 1, ny + 1
      do i = 1, nx + 1
        area = merge(0.5_dp, 1.0_dp, i == 1 .or. i > nx)*merge(0.5_dp, 1.0_dp, j == 1 .or. j > ny)
        call add_row([3*(i + (j - 1)*(nx + 1)) - 2], [1.0_dp], 0.0_dp, &
                     1.0_dp/(stiffness*area*varied(seed, even, 0.5_dp, 2.0_dp)), structure)
      end do
    end do
    call load_deck(seed, even, structure)
    call settle_supports(seed, even, 0.3_dp/stiffness, structure)
    if (.not. chance(seed, 0.2_dp)) return
    ! Not all of the strength is used: 1.2 to 4 times the load.
    structure%limit = max(uniform(seed, 1.2_dp, 4.0_dp)*sum(abs(structure%load(1::3))), 1.0_dp) &
                      /(structure%compliance*sum(1.0_dp/structure%compliance))

  contains

    pure function node(number_of_node) result(dof)
      integer, intent(in) :: number_of_node
      integer :: dof(3)

      dof = 3*number_of_node - [2, 1, 0]
    end function node

  end subroutine draw_raft

end module random_structures
