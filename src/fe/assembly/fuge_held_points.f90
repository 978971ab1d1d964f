!> Contact points that cannot move, because supports hold what both surfaces have there.
module fuge_held_points
  use fuge_body_type, only: fuge_body
  use fuge_contact_pairs_type, only: fuge_contact_pairs
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_GAP, FUGE_ERR_MESH
  implicit none
  private

  public :: leave_out_held

  !> Factors of free degrees of freedom below this fraction of the largest one are rounding, as where nodes of both
  !> meshes coincide.
  real(dp), parameter :: NO_FACTOR = 1.0e-10_dp

contains

  !> Leave out the contact points that cannot move: their gap is what positions and supports make it.
  !>
  !> `degrees`: of all bodies; of `body` the supports are used. `extent`: greatest coordinate of the surfaces, which
  !> measures rounding.
  !> Errors: FUGE_ERR_GAP if such a point violates a stop, FUGE_ERR_MESH if no point is left, FUGE_ERR_MEMORY.
  pure subroutine leave_out_held(body, degrees, extent, pairs, info)
    type(fuge_body), intent(in) :: body
    integer, intent(in) :: degrees
    real(dp), intent(in) :: extent
    type(fuge_contact_pairs), intent(inout) :: pairs
    type(fuge_info), intent(inout) :: info
    logical, allocatable :: fixed(:), held(:)
    real(dp), allocatable :: displacement(:)
    integer :: i, stat

    allocate (fixed(degrees), displacement(degrees), held(pairs%points()), stat=stat)
    call require_memory(stat, '', degrees, 'degrees of freedom', info)
    if (stat /= 0) return
    fixed = .false.
    displacement = 0.0_dp
    if (allocated(body%fixed)) fixed(body%fixed) = .true.
    if (allocated(body%displacement)) displacement(body%fixed) = body%displacement
    do i = 1, size(held)
      held(i) = is_held(pairs%dof(:, i), pairs%normal(:, i), fixed)
      if (held(i)) call check_gap(pairs, i, displacement, extent, info)
      if (info%failed()) return
    end do
    if (all(held)) then
      call report(info, FUGE_ERR_MESH, 'supports hold both surfaces at each of the '//text(size(held)) &
                  //' contact points: free degrees of freedom, or leave the pair out')
    else if (any(held)) then
      call pairs%keep(.not. held, stat)
      call require_memory(stat, 'the contact points', info)
    end if
  end subroutine leave_out_held

  !> Does a point move with no free degree of freedom?
  pure function is_held(dof, normal, fixed) result(held)
    integer, intent(in) :: dof(:)
    real(dp), intent(in) :: normal(:)
    logical, intent(in) :: fixed(:)
    logical :: held
    real(dp) :: largest
    integer :: k

    held = .true.
    largest = maxval(abs(normal))
    do k = 1, size(dof)
      if (dof(k) < 1) cycle
      if (.not. fixed(dof(k))) held = held .and. .not. abs(normal(k)) > NO_FACTOR*largest
    end do
  end function is_held

  !> Refuse a held point whose gap violates one of its stops.
  pure subroutine check_gap(pairs, i, displacement, extent, info)
    type(fuge_contact_pairs), intent(in) :: pairs
    integer, intent(in) :: i
    real(dp), intent(in) :: displacement(:), extent
    type(fuge_info), intent(inout) :: info
    real(dp) :: gap
    integer :: k

    gap = pairs%gap(i)
    do k = 1, size(pairs%dof, 1)
      if (pairs%dof(k, i) > 0) gap = gap + pairs%normal(k, i)*displacement(pairs%dof(k, i))
    end do
    if (gap >= -NO_FACTOR*extent .and. gap <= pairs%gap_upper(i) + NO_FACTOR*extent) return
    call report(info, FUGE_ERR_GAP, 'node '//index_text(pairs%node(i))//' of the contact surface of pair ' &
                //index_text(pairs%pair(i))//' and what lies across from it are held by supports with a gap of ' &
                //text(gap)//', beyond a stop: free or move one of them, or leave the faces there out')
  end subroutine check_gap

end module fuge_held_points
