!> Equilibrium where ranks share the points: fuge_equilibrium at few points, to which each rank offers those of its own
!> that the remainder of the resultants closes most.
module fuge_shared_equilibrium
  use fuge_equilibrium, only: find_equilibrium, find_newest, is_in_equilibrium, is_negligible, proves_no_equilibrium
  use fuge_kinds, only: dp
  use fuge_point_space, only: point_space
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: find_shared_equilibrium, move_to_edge

  !> A load may miss the edge of what the contact can carry by this many units in its last place.
  real(dp), parameter :: ROUNDINGS = 16.0_dp
  !> A force below this fraction of the largest may be due to such rounding.
  real(dp), parameter :: NO_FORCE = 1.0e-10_dp
  !> At most OFFERS_PER_MODE points are offered for each mode, and MORE_OFFERS in addition.
  integer, parameter :: OFFERS_PER_MODE = 20, MORE_OFFERS = 200

  !> The points that have been offered, with their rows of the modes, (m, :), on all ranks.
  type :: offered_points
    integer :: count = 0
    real(dp), allocatable :: rows(:, :), force(:)
    logical, allocatable :: pushes(:), pulls(:)
    !> The number of the point where it is this rank's, else 0.
    integer, allocatable :: own(:)
  end type offered_points

contains

  !> As find_equilibrium, with the arguments of the points of this rank; all ranks of `space` call it.
  subroutine find_shared_equilibrium(space, modes, resultant, pushes, pulls, force, remainder, rounding)
    type(point_space), intent(in) :: space
    real(dp), intent(in) :: modes(:, :), resultant(:), rounding(:)
    logical, intent(in) :: pushes(:), pulls(:)
    real(dp), intent(out) :: force(:)
    real(dp), intent(out), contiguous :: remainder(:)
    type(offered_points) :: offered
    real(dp), dimension(size(resultant)) :: rest, terms
    integer :: iteration, k, most
    logical :: balanced, found, has_all

    has_all = space%total_count(size(force)) == size(force)
    remainder = 0.0_dp
    if (has_all .or. space%is_alone()) then
      call find_equilibrium(modes, resultant, pushes, pulls, force, remainder, rounding)
    end if
    if (space%anywhere(has_all)) then
      ! One rank has all points, as of coarse grids.
      call space%take_from_least(merge(0.0_dp, 1.0_dp, has_all), remainder)
      return
    end if
    force = 0.0_dp
    remainder = resultant
    most = OFFERS_PER_MODE*(size(resultant) + 1) + MORE_OFFERS
    allocate (offered%rows(size(resultant), most), offered%force(most), offered%pushes(most), offered%pulls(most), &
              offered%own(most))
    do iteration = 1, most
      call judge_balance(offered, resultant, rounding, remainder, terms, balanced)
      if (balanced) exit
      rest = rounding + epsilon(rest)*terms
      call offer(space, modes, remainder, rest, pushes, pulls, offered, found)
      if (.not. found) then
        if (is_negligible(remainder, resultant, terms)) exit
        if (space%everywhere(proves_no_equilibrium(modes, rest, pushes, pulls, remainder))) return
        exit
      end if
      call solve_offered(resultant, rounding, offered, remainder)
    end do
    do k = 1, offered%count
      if (offered%own(k) > 0) force(offered%own(k)) = offered%force(k)
    end do
    ! Equilibrium holds, or is not decided; the certificate of the solve then decides.
    remainder = 0.0_dp
  end subroutine find_shared_equilibrium

  !> Are the forces at the offered points in equilibrium? `terms` (m) sum their sizes in each resultant.
  subroutine judge_balance(offered, resultant, rounding, remainder, terms, balanced)
    type(offered_points), intent(in) :: offered
    real(dp), intent(in) :: resultant(:), rounding(:), remainder(:)
    real(dp), intent(out) :: terms(:)
    logical, intent(out) :: balanced
    integer :: k

    terms = 0.0_dp
    do k = 1, offered%count
      terms = terms + abs(offered%rows(:, k)*offered%force(k))
    end do
    balanced = is_in_equilibrium(transpose(offered%rows(:, :offered%count)), resultant, rounding, &
                                 offered%force(:offered%count), remainder)
  end subroutine judge_balance

  !> Offer the point of all ranks that closes most along the remainder, unless it has been offered; `found` if there is
  !> one.
  subroutine offer(space, modes, remainder, rest, pushes, pulls, offered, found)
    type(point_space), intent(in) :: space
    real(dp), intent(in) :: modes(:, :), remainder(:), rest(:)
    logical, intent(in) :: pushes(:), pulls(:)
    type(offered_points), intent(inout) :: offered
    logical, intent(out) :: found
    real(dp) :: chosen(size(remainder) + 3), key, work
    integer :: newest

    call find_newest(modes, remainder, rest, pushes, pulls, offered%own(:offered%count), newest, work)
    key = huge(key)
    chosen = 0.0_dp
    if (newest > 0) then
      key = -abs(work)
      chosen = [modes(newest, :), merge(1.0_dp, 0.0_dp, pushes(newest)), merge(1.0_dp, 0.0_dp, pulls(newest)), &
                real(space%number(), dp)]
    end if
    found = space%anywhere(key < huge(key))
    call space%take_from_least(key, chosen)
    if (.not. found) return
    associate (n => offered%count, m => size(remainder))
      n = n + 1
      offered%rows(:, n) = chosen(:m)
      offered%pushes(n) = chosen(m + 1) > 0.0_dp
      offered%pulls(n) = chosen(m + 2) > 0.0_dp
      offered%own(n) = merge(newest, 0, abs(chosen(m + 3) - real(space%number(), dp)) <= 0.0_dp)
      offered%force(n) = 0.0_dp
    end associate
  end subroutine offer

  !> Forces at the offered points that come nearest to the resultants, and what these lack.
  subroutine solve_offered(resultant, rounding, offered, remainder)
    real(dp), intent(in) :: resultant(:), rounding(:)
    type(offered_points), intent(inout) :: offered
    real(dp), intent(out) :: remainder(:)
    integer :: k

    associate (n => offered%count)
      call find_equilibrium(transpose(offered%rows(:, :n)), resultant, offered%pushes(:n), offered%pulls(:n), &
                            offered%force(:n), remainder, rounding)
      remainder = resultant
      do k = 1, n
        remainder = remainder - offered%force(k)*offered%rows(:, k)
      end do
    end associate
  end subroutine solve_offered

  !> Fewer points than modes carry a load at the edge of what the contact can carry. Rounding may take it beyond the
  !> edge, where motions without resistance would grow: the load is then moved to the edge.
  !>
  !> `modes` (n, p) those in `columns` (p) with the `noise` (p) of their loads; `force` (n) carries them. Error:
  !> FUGE_ERR_MEMORY.
  subroutine move_to_edge(space, modes, noise, load, columns, force, info)
    type(point_space), intent(in) :: space
    real(dp), intent(in) :: modes(:, :), noise(:)
    integer, intent(in) :: columns(:)
    real(dp), intent(inout) :: load(:), force(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: nearest(:), weighted(:, :)
    logical, allocatable :: pushes(:), pulls(:)
    real(dp) :: carried(size(noise)), weight(size(noise)), rest(size(noise)), least
    integer :: j, stat

    least = NO_FORCE*space%largest(maxval(abs(force)))
    if (space%total_count(count(abs(force) > least)) >= size(columns) .or. .not. all(noise > 0.0_dp)) return
    associate (n => size(force))
      allocate (nearest(n), weighted(n, size(noise)), pushes(n), pulls(n), stat=stat)
    end associate
    call require_memory(stat, 'the load of', size(force), 'points', info)
    call space%agree(info)
    if (stat /= 0 .or. info%failed()) return
    ! Loads with little rounding are met best.
    weight = minval(noise)/noise
    do j = 1, size(noise)
      weighted(:, j) = modes(:, j)*weight(j)
    end do
    pushes = force > least
    pulls = force < -least
    call find_shared_equilibrium(space, weighted, load(columns)*weight, pushes, pulls, nearest, rest, noise*weight)
    carried = matmul(nearest, modes)
    call space%add(carried)
    if (.not. all(abs(load(columns) - carried) <= ROUNDINGS*noise)) return
    load(columns) = carried
    force = nearest
  end subroutine move_to_edge

end module fuge_shared_equilibrium
