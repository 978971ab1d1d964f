!> Cells of a line that are narrow where the pressure is not smooth: at the ends of the contact, at kinks of the gap and
!> at corners.
module fuge_line_mesh
  use fuge_cell_grading, only: fuge_graded_cells, FUGE_END_CORNER, FUGE_END_EDGE, FUGE_END_PLAIN
  use fuge_gap_features, only: gap_feature
  use fuge_kinds, only: dp
  use fuge_marked_runs, only: next_run
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: borders, contact_intervals, equal_cells, extend_over_kinks, graded_mesh, joined_intervals, line_mesh

  !> Cells that lie side by side and cover the interval: centres and widths, (n), length.
  type :: line_mesh
    real(dp), allocatable :: x(:), width(:)
  end type line_mesh

  !> A part of the interval between two places where cells end: kinds of its ends, and its part of the cells.
  type :: mesh_part
    real(dp) :: ends(2) = 0.0_dp
    integer :: kinds(2) = FUGE_END_PLAIN
    real(dp) :: weight = 0.0_dp
  end type mesh_part

  !> Parts of the cells of an open part, and of the zone of an open part beside a contact, relative to a part in
  !> contact.
  real(dp), parameter :: OPEN_WEIGHT = 0.2_dp, ZONE_WEIGHT = 0.2_dp
  !> Length of that zone, relative to that of the contact, and at most to that of the open part.
  real(dp), parameter :: ZONE_LENGTH = 0.15_dp, LARGEST_ZONE = 0.4_dp
  !> The same beside a part that has a corner or a kink at its other end, because how far a contact reaches beyond a
  !> kink is not known even roughly at first.
  real(dp), parameter :: ZONE_BESIDE_CORNER = 1.0_dp
  !> Fewest cells of a part.
  integer, parameter :: FEWEST_CELLS = 4
  !> Ends of the contact nearer than this to a feature, relative to the length of the contact, or of the interval, are
  !> taken to be there.
  real(dp), parameter :: SAME_PLACE = 1.0e-6_dp, SAME_PLACE_OF_ALL = 1.0e-12_dp
  !> How far beyond a kink a contact that seems to end there is expected, in widths of the first cell.
  real(dp), parameter :: BEYOND_KINK = 0.5_dp

contains

  !> `n` equal cells from `left` to `right`.
  pure function equal_cells(left, right, n) result(mesh)
    real(dp), intent(in) :: left, right
    integer, intent(in) :: n
    type(line_mesh) :: mesh
    integer :: k

    allocate (mesh%x(n), mesh%width(n))
    mesh%width = (right - left)/real(n, dp)
    mesh%x = [(left + (right - left)*((real(k, dp) - 0.5_dp)/real(n, dp)), k=1, n)]
  end function equal_cells

  !> Ends of the cells, (n + 1).
  pure function borders(mesh) result(border)
    type(line_mesh), intent(in) :: mesh
    real(dp) :: border(size(mesh%x) + 1)
    integer :: n

    n = size(mesh%x)
    border(1) = mesh%x(1) - 0.5_dp*mesh%width(1)
    border(2:n) = 0.5_dp*((mesh%x(:n - 1) + 0.5_dp*mesh%width(:n - 1)) + (mesh%x(2:) - 0.5_dp*mesh%width(2:)))
    border(n + 1) = mesh%x(n) + 0.5_dp*mesh%width(n)
  end function borders

  !> The intervals of contact, (2, k), from the forces of the cells. An end is where the square of the pressure, which
  !> is linear there, would be zero, but no farther from the border of the last cell than its width, and inside.
  pure function contact_intervals(mesh, force) result(intervals)
    type(line_mesh), intent(in) :: mesh
    real(dp), intent(in) :: force(:)
    real(dp), allocatable :: intervals(:, :)
    logical :: touches(0:size(force))
    integer :: first, last, k

    touches(0) = .false.
    touches(1:) = force > 0.0_dp
    allocate (intervals(2, count(touches(1:) .and. .not. touches(:size(force) - 1))))
    last = 0
    do k = 1, size(intervals, 2)
      call next_run(touches(1:), last + 1, first, last)
      intervals(:, k) = [end_of_contact(mesh, force, first, last, 1), end_of_contact(mesh, force, last, first, -1)]
    end do
  end function contact_intervals

  !> The end of the contact at cell `k`, whose other end is cell `other`; `inwards` 1 at the left end, -1 at the right.
  pure function end_of_contact(mesh, force, k, other, inwards) result(place)
    type(line_mesh), intent(in) :: mesh
    real(dp), intent(in) :: force(:)
    integer, intent(in) :: k, other, inwards
    real(dp) :: place
    real(dp) :: square(2), zero

    place = mesh%x(k) - 0.5_dp*real(inwards, dp)*mesh%width(k)
    if (k == 1 .or. k == size(force) .or. abs(other - k) < 3) return
    associate (inner => mesh%x(k + 2*inwards), outer => mesh%x(k + inwards))
      square = (force([k + inwards, k + 2*inwards])/mesh%width([k + inwards, k + 2*inwards]))**2
      if (.not. square(2) > square(1)) return
      zero = outer - square(1)*((inner - outer)/(square(2) - square(1)))
    end associate
    place = min(max(zero, place - mesh%width(k)), place + mesh%width(k))
    place = min(max(place, mesh%x(1)), mesh%x(size(mesh%x)))
  end function end_of_contact

  !> Extend `intervals` (2, k) that end at a kink a little beyond it: there the pressure of a contact that ended would
  !> have a singularity, under which the surfaces beside it would overlap, in less than a cell.
  pure subroutine extend_over_kinks(mesh, features, intervals)
    type(line_mesh), intent(in) :: mesh
    type(gap_feature), intent(in) :: features(:)
    real(dp), intent(inout) :: intervals(:, :)
    real(dp) :: length
    integer :: cell, j, k, side

    do k = 1, size(intervals, 2)
      length = intervals(2, k) - intervals(1, k)
      do j = 1, 2
        if (.not. any(abs(features%place - intervals(j, k)) <= SAME_PLACE*length .and. .not. features%jumps)) cycle
        side = 2*j - 3
        cell = minloc(abs(mesh%x - 0.5_dp*real(side, dp)*mesh%width - intervals(j, k)), dim=1)
        intervals(j, k) = intervals(j, k) + BEYOND_KINK*real(side, dp)*mesh%width(cell)
      end do
    end do
  end subroutine extend_over_kinks

  !> Both lists of intervals as one, ascending, those that overlap joined.
  pure function joined_intervals(a, b) result(joined)
    real(dp), intent(in) :: a(:, :), b(:, :)
    real(dp), allocatable :: joined(:, :)
    real(dp) :: all(2, size(a, 2) + size(b, 2)), next(2)
    integer :: before, behind, k, n

    all = reshape([a, b], shape(all))
    allocate (joined(2, 0))
    do k = 1, size(all, 2)
      next = all(:, k)
      n = size(joined, 2)
      before = count(joined(2, :) < next(1))
      behind = count(joined(1, :) > next(2))
      if (before + behind < n) next = [min(next(1), joined(1, before + 1)), max(next(2), joined(2, n - behind))]
      joined = reshape([joined(:, :before), next, joined(:, n - behind + 1:)], [2, before + 1 + behind])
    end do
  end function joined_intervals

  !> About `cells` cells between `left` and `right`, graded towards the ends of the `contacts` (2, k) and towards the
  !> features. Errors: those of `fuge_graded_cells`, where parts are too short for their cells.
  pure subroutine graded_mesh(left, right, features, contacts, cells, mesh, info)
    real(dp), intent(in) :: left, right, contacts(:, :)
    type(gap_feature), intent(in) :: features(:)
    integer, intent(in) :: cells
    type(line_mesh), intent(out) :: mesh
    type(fuge_info), intent(inout) :: info
    type(mesh_part), allocatable :: parts(:)
    integer, allocatable :: share(:)
    integer :: first, k

    allocate (parts, source=with_zones(parts_of_line(left, right, features, contacts), contacts))
    allocate (share, source=max(FEWEST_CELLS, nint(real(cells, dp)*parts%weight/sum(parts%weight))))
    allocate (mesh%x(sum(share)), mesh%width(sum(share)))
    first = 1
    do k = 1, size(parts)
      associate (last => first + share(k) - 1)
        call fuge_graded_cells(parts(k)%ends(1), parts(k)%ends(2), parts(k)%kinds, [0, 0], mesh%x(first:last), &
                               mesh%width(first:last), info)
      end associate
      if (info%failed()) return
      first = first + share(k)
    end do
  end subroutine graded_mesh

  !> The parts of the interval between its ends, the features and the ends of the contacts, with the kinds of their
  !> ends.
  pure function parts_of_line(left, right, features, contacts) result(parts)
    real(dp), intent(in) :: left, right, contacts(:, :)
    type(gap_feature), intent(in) :: features(:)
    type(mesh_part), allocatable :: parts(:)
    real(dp), allocatable :: place(:)
    !> At such a place a body ends, or its surface jumps: a corner if there is contact beside it, else nothing.
    logical, allocatable :: is_end(:)
    !> A kink: nearly a corner for the pressure beside it if the contact ends soon after it.
    logical, allocatable :: is_kink(:)
    integer :: j, k

    allocate (place, source=[left, features%place, right])
    allocate (is_end, source=[.true., features%jumps, .true.])
    allocate (is_kink, source=[.false., .not. features%jumps, .false.])
    do k = 1, size(contacts, 2)
      do j = 1, 2
        if (any(abs(place - contacts(j, k)) <= max(SAME_PLACE*(contacts(2, k) - contacts(1, k)), &
                                                   SAME_PLACE_OF_ALL*(right - left)))) cycle
        associate (below => count(place < contacts(j, k)))
          is_end = [is_end(:below), .false., is_end(below + 1:)]
          is_kink = [is_kink(:below), .false., is_kink(below + 1:)]
          place = [place(:below), contacts(j, k), place(below + 1:)]
        end associate
      end do
    end do
    allocate (parts(size(place) - 1))
    do k = 1, size(parts)
      parts(k)%ends = place(k:k + 1)
      parts(k)%weight = OPEN_WEIGHT
      if (is_in_contact(parts(k), contacts)) then
        parts(k)%weight = 1.0_dp
        parts(k)%kinds = merge(FUGE_END_CORNER, FUGE_END_EDGE, is_end(k:k + 1) .or. is_kink(k:k + 1))
      else
        parts(k)%kinds = merge(FUGE_END_PLAIN, FUGE_END_EDGE, is_end(k:k + 1))
      end if
    end do
  end function parts_of_line

  pure function is_in_contact(part, contacts) result(touches)
    type(mesh_part), intent(in) :: part
    real(dp), intent(in) :: contacts(:, :)
    logical :: touches

    associate (middle => 0.5_dp*sum(part%ends))
      touches = any(contacts(1, :) < middle .and. middle < contacts(2, :))
    end associate
  end function is_in_contact

  !> The same parts with zones of narrow cells in the open ones beside contacts, so that a contact may turn out to be
  !> wider.
  pure function with_zones(parts, contacts) result(zoned)
    type(mesh_part), intent(in) :: parts(:)
    real(dp), intent(in) :: contacts(:, :)
    type(mesh_part), allocatable :: zoned(:)
    type(mesh_part) :: rest
    !> Lengths of the zones beside the parts in contact; 0 for those that are open.
    real(dp) :: zone(0:size(parts) + 1), length
    integer :: k

    zone = 0.0_dp
    do k = 1, size(parts)
      if (.not. is_in_contact(parts(k), contacts)) cycle
      zone(k) = ZONE_LENGTH*(parts(k)%ends(2) - parts(k)%ends(1))
      if (any(parts(k)%kinds == FUGE_END_CORNER)) zone(k) = zone(k)*(ZONE_BESIDE_CORNER/ZONE_LENGTH)
    end do
    allocate (zoned(0))
    do k = 1, size(parts)
      rest = parts(k)
      length = LARGEST_ZONE*(rest%ends(2) - rest%ends(1))
      if (.not. zone(k) > 0.0_dp .and. zone(k - 1) > 0.0_dp .and. rest%kinds(1) == FUGE_END_EDGE) then
        rest%ends(1) = rest%ends(1) + min(zone(k - 1), length)
        zoned = [zoned, mesh_part([parts(k)%ends(1), rest%ends(1)], [FUGE_END_EDGE, FUGE_END_PLAIN], ZONE_WEIGHT)]
      end if
      if (.not. zone(k) > 0.0_dp .and. zone(k + 1) > 0.0_dp .and. rest%kinds(2) == FUGE_END_EDGE) then
        rest%ends(2) = rest%ends(2) - min(zone(k + 1), length)
        zoned = [zoned, rest, mesh_part([rest%ends(2), parts(k)%ends(2)], [FUGE_END_PLAIN, FUGE_END_EDGE], ZONE_WEIGHT)]
      else
        zoned = [zoned, rest]
      end if
    end do
  end function with_zones

end module fuge_line_mesh
