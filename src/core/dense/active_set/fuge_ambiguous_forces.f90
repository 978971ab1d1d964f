!> Forces that store no energy and may be added to those of a solution: the forces are not unique then.
!>
!> Where alpha is singular on the points that touch, some forces there displace nothing against the rest and have no
!> resultants. They may be added if no point pulls: a point that touches without force takes more of one sign only.
module fuge_ambiguous_forces
  use fuge_canonical_problem, only: canonical_problem
  use fuge_contact_solution, only: contact_solution
  use fuge_contact_states, only: FUGE_AT_LOWER_STOP
  use fuge_equilibrium, only: find_equilibrium
  use fuge_kinds, only: dp
  use fuge_pivoted_qr, only: orthogonal_complement
  use fuge_status, only: fuge_info, require_memory
  use fuge_unresisted_motions, only: find_unresisted_basis, mark_loaded
  implicit none
  private

  public :: find_ambiguous_forces, mark_touching

  !> A gap may be rounded by this many units in the last place of the largest displacement or motion.
  real(dp), parameter :: ROUNDINGS = 4.0_dp
  !> Displacements below this fraction of their terms count as zero.
  real(dp), parameter :: NO_DISPLACEMENT = 1.0e-12_dp
  !> Forces below this fraction of the others count as zero.
  real(dp), parameter :: NO_FORCE = 1.0e-10_dp
  !> Where there are more independent combinations than this, one of them is taken to be allowed.
  integer, parameter :: MOST_COMBINATIONS = 32

contains

  !> The points in contact, and open ones whose gap at a stop is no more than rounding: `touching` (n). `beyond` tells
  !> whether there are such open ones. `canonical` with its matrix.
  pure subroutine mark_touching(canonical, solution, touching, beyond)
    type(canonical_problem), intent(in) :: canonical
    type(contact_solution), intent(in) :: solution
    logical, intent(out) :: touching(:), beyond
    real(dp) :: displacement, rounding, slack
    integer :: first, k

    touching = abs(solution%state) == FUGE_AT_LOWER_STOP
    beyond = .false.
    displacement = max(canonical%survey%most - canonical%datum, canonical%datum - canonical%survey%least) &
                   *sum(abs(solution%force))
    ! Gaps are counted from a point that the translation moves too.
    first = merge(2, 1, canonical%has_translation)
    rounding = ROUNDINGS*epsilon(rounding)*(displacement + sum(abs(solution%motion(first:))))
    do k = 1, size(touching)
      if (touching(k) .or. canonical%excluded(k)) cycle
      slack = canonical%slack(k, solution%state(k), solution%gap(k))
      touching(k) = slack <= rounding
      beyond = beyond .or. touching(k)
    end do
  end subroutine mark_touching

  !> Are there forces at the `touching` points (n) that may be added to those of the solution? `ambiguous` tells.
  !>
  !> `canonical` with its matrix. Error: FUGE_ERR_MEMORY.
  subroutine find_ambiguous_forces(canonical, solution, touching, ambiguous, info)
    type(canonical_problem), intent(in) :: canonical
    type(contact_solution), intent(in) :: solution
    logical, intent(in) :: touching(:)
    logical, intent(out) :: ambiguous
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: basis(:, :), equations(:, :), scale(:), unresisted(:, :)
    logical, allocatable :: loaded(:)
    integer :: points(count(touching)), k, status

    ambiguous = .false.
    points = pack([(k, k=1, size(touching))], touching)
    call find_unresisted_basis(canonical%modes, touching, unresisted)
    associate (m => size(canonical%load))
      allocate (equations(size(points) + m, size(points) + m + size(unresisted, 2)), scale(size(touching)), &
                loaded(size(touching)), stat=status)
    end associate
    if (status == 0) then
      call mark_loaded(canonical, solution, scale, loaded)
      call set_equations(canonical, points, unresisted, equations)
      call orthogonal_complement(equations, NO_DISPLACEMENT, basis, status)
    end if
    call require_memory(status, 'the test whether forces are unique', info)
    if (status /= 0) return
    ambiguous = any_may_be_added(canonical, solution, points, loaded, basis(:size(points), :))
  end subroutine find_ambiguous_forces

  !> The equations of forces at the `points`, and of motions, that are in balance with each other, as columns: no
  !> displacement, no resultants, no component in the `unresisted` motions. Displacements at a point are divided by the
  !> root of the largest coefficient there, and forces multiplied by it, which keeps signs.
  pure subroutine set_equations(canonical, points, unresisted, equations)
    type(canonical_problem), intent(in) :: canonical
    integer, intent(in) :: points(:)
    real(dp), intent(in) :: unresisted(:, :)
    real(dp), intent(out) :: equations(:, :)
    real(dp) :: scale(size(points)), least
    integer :: j, m, t

    t = size(points)
    m = size(canonical%load)
    equations = 0.0_dp
    do j = 1, t
      equations(:t, j) = canonical%alpha(points, points(j)) - canonical%datum
      scale(j) = maxval(abs(equations(:t, j)))
    end do
    least = minval(scale, mask=scale > 0.0_dp)
    where (scale > 0.0_dp)
      scale = sqrt(least/scale)
    else where
      scale = 1.0_dp
    end where
    if (.not. any(abs(equations) > 0.0_dp)) least = 1.0_dp
    do j = 1, t
      equations(:t, j) = (equations(:t, j)/least)*scale*scale(j)
    end do
    do j = 1, m
      equations(:t, t + j) = -scale*canonical%modes(points, j)
      equations(t + j, :t) = equations(:t, t + j)
    end do
    equations(t + 1:, t + m + 1:) = unresisted
  end subroutine set_equations

  !> May a combination of the forces in the `basis`, one row for each of the `points`, be added, although forces at
  !> points that are not `loaded` (n) may only push at their stops?
  function any_may_be_added(canonical, solution, points, loaded, basis) result(may)
    type(canonical_problem), intent(in) :: canonical
    type(contact_solution), intent(in) :: solution
    integer, intent(in) :: points(:)
    logical, intent(in) :: loaded(:)
    real(dp), intent(in) :: basis(:, :)
    logical :: may
    real(dp), dimension(size(basis, 2)) :: combination, direction
    real(dp), dimension(size(points)) :: least, most, work
    logical, dimension(size(points)) :: idle, pulls
    integer :: j, sense

    idle = .not. loaded(points) .and. maxval(abs(basis), dim=2) > NO_FORCE
    ! At no more points than combinations, these give any forces. Of very many combinations one is taken to be allowed,
    ! because the search would take longer than the solve.
    may = size(basis, 2) > 0
    if (count(idle) <= size(basis, 2) .or. size(basis, 2) > MOST_COMBINATIONS) return
    ! A combination that takes forces of the wrong sign closes a point, as a motion would. A force at its limit can only
    ! become smaller.
    pulls = idle .and. merge(solution%state(points) < 0, solution%gap(points) < 0.5_dp*canonical%upper(points), &
                             abs(solution%state(points)) > 1)
    least = merge(-huge(least), 0.0_dp, pulls)
    most = merge(huge(most), 0.0_dp, idle .and. .not. pulls)
    do j = 1, size(direction)
      do sense = -1, 1, 2
        direction = 0.0_dp
        direction(j) = real(sense, dp)
        call find_equilibrium(basis, direction, least, most, work, combination)
        may = any(abs(combination) > 0.0_dp)
        if (may) return
      end do
    end do
  end function any_may_be_added

end module fuge_ambiguous_forces
