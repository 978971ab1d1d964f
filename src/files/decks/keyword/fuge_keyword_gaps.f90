!> Gap elements of Abaqus and CalculiX: GAPUNI, GAPCYL and GAPSPHER, and the data line of their *GAP.
module fuge_keyword_gaps
  use fuge_deck_type, only: fuge_deck_link, new_link
  use fuge_entry_numbers, only: read_value
  use fuge_kinds, only: dp
  use fuge_link_direction, only: direction_between, COINCIDENT
  use fuge_number_text, only: text
  use fuge_text_columns, only: begin_columns, next_column
  implicit none
  private

  public :: is_gap, make_gap_link, read_gap_line

  !> Types of gap elements that are read.
  character(len=8), parameter :: GAP_TYPES(3) = [character(len=8) :: 'GAPUNI', 'GAPCYL', 'GAPSPHER']
  !> Columns of the data line.
  integer, parameter :: COLUMNS = 7

  !> The data of *GAP.
  type, public :: gap_line
    !> Clearance; of GAPCYL and GAPSPHER the largest distance of the nodes, or less the smallest one.
    real(dp) :: clearance = 0.0_dp
    !> Direction, or axis of GAPCYL; zero: not given.
    real(dp) :: direction(3) = 0.0_dp
    !> Stiffness of the closed gap; 0: rigid.
    real(dp) :: stiffness = 0.0_dp
  end type gap_line

contains

  !> Is it a type of gap elements?
  pure function is_gap(element_type)
    character(len=*), intent(in) :: element_type
    logical :: is_gap

    is_gap = any(element_type == GAP_TYPES)
  end function is_gap

  !> Clearance, three direction cosines, then, for CalculiX, a blank column and the stiffness; in Abaqus the area,
  !> which only makes a pressure of the force. The last column, CalculiX's tension at infinity, rounds the corner of its
  !> force law.
  pure subroutine read_gap_line(line, data, reason)
    character(len=*), intent(in) :: line
    type(gap_line), intent(out) :: data
    character(len=:), allocatable, intent(out) :: reason
    real(dp) :: value(COLUMNS)
    integer :: first, i, k, last, separator

    k = begin_columns(line)
    value = 0.0_dp
    do i = 1, COLUMNS
      call next_column(line, k, first, last, separator)
      if (last >= first) call read_value(line(first:last), value(i), reason)
      if (allocated(reason)) return
    end do
    if (k <= len(line)) then
      reason = 'more than '//text(COLUMNS)//' columns of *GAP'
    else if (value(6) < 0.0_dp) then
      reason = 'the stiffness is negative'
    end if
    data%clearance = value(1)
    data%direction = value(2:4)
    data%stiffness = value(6)
  end subroutine read_gap_line

  !> The link of an element between two nodes at `position` (3, 2); that of GAPCYL and GAPSPHER for small displacements.
  pure subroutine make_gap_link(element_type, element, node, position, data, link, reason)
    character(len=*), intent(in) :: element_type
    integer, intent(in) :: element, node(2)
    real(dp), intent(in) :: position(3, 2)
    type(gap_line), intent(in) :: data
    type(fuge_deck_link), intent(out) :: link
    character(len=:), allocatable, intent(inout) :: reason
    real(dp) :: axis(3), direction(3), distance(3), gap

    gap = data%clearance
    direction = data%direction
    axis = 0.0_dp
    if (any(abs(direction) > 0.0_dp)) direction = direction/maxval(abs(direction))
    if (any(abs(direction) > 0.0_dp)) direction = direction/norm2(direction)
    if (element_type == 'GAPUNI') then
      if (.not. any(abs(direction) > 0.0_dp)) then
        call direction_between(position(:, 1), position(:, 2), direction, reason)
        if (allocated(reason)) reason = reason//': give its direction cosines'
      end if
    else
      if (element_type == 'GAPCYL') axis = direction
      if (element_type == 'GAPCYL' .and. .not. any(abs(axis) > 0.0_dp)) then
        reason = 'the direction cosines of its axis are missing'
        return
      end if
      distance = position(:, 2) - position(:, 1)
      distance = distance - dot_product(distance, axis)*axis
      ! What the projection leaves may be rounding of the positions.
      if (norm2(distance) > COINCIDENT*maxval(abs(position))) then
        direction = distance/norm2(distance)
      else
        reason = 'its nodes coincide, or are on one line along its axis, so that it has no direction at first: use ' &
          //'GAPUNI'
      end if
      if (data%clearance >= 0.0_dp) then
        direction = -direction
        gap = data%clearance - norm2(distance)
      else
        gap = norm2(distance) + data%clearance
      end if
    end if
    link = new_link(trim(element_type)//' '//text(element), node(1), node(2), direction, gap)
    if (data%stiffness > 0.0_dp) link%compliance = 1.0_dp/data%stiffness
  end subroutine make_gap_link

end module fuge_keyword_gaps
