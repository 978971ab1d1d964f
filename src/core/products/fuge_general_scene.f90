!> Scenes with rigid modes of their own, play, ties or exclusions: from the canonical problem to the scene that the
!> iteration solves, and back to forces, gaps and motions in the caller's modes.
module fuge_general_scene
  use fuge_canonical_problem, only: canonical_problem
  use fuge_constants, only: LARGEST_EXPONENT
  use fuge_contact_iterate, only: contact_iterate
  use fuge_contact_scene, only: contact_scene, OUT_OF_REACH
  use fuge_contact_segments, only: contact_segments
  use fuge_contact_set, only: find_states
  use fuge_contact_solution, only: allocate_solution, contact_solution
  use fuge_contact_states, only: FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP
  use fuge_deformed_gaps, only: deformed_gap
  use fuge_feasible_forces, only: clip_forces
  use fuge_kinds, only: dp
  use fuge_mode_projection, only: mode_projection
  use fuge_number_text, only: text
  use fuge_operator_type, only: fuge_operator
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_scene_scaling, only: scene_scaling
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_OVERFLOW
  use fuge_unresisted_motions, only: report_unresisted_motion
  implicit none
  private

  public :: assemble_general, set_general_scene

  !> Forces up to this many units in the last place of the largest one are rounding.
  real(dp), parameter :: ROUNDINGS = 4.0_dp

contains

  !> The scene of a general problem, whose rows are set. `canonical` belongs to it, without its matrix. Errors:
  !> FUGE_ERR_MEMORY, FUGE_ERR_OVERFLOW.
  subroutine set_general_scene(problem, canonical, scene, scaling, info)
    type(fuge_problem), intent(in) :: problem
    type(canonical_problem), intent(in) :: canonical
    type(contact_scene), intent(inout) :: scene
    type(scene_scaling), intent(out) :: scaling
    type(fuge_info), intent(inout) :: info
    real(dp) :: least

    if (canonical%largest_load() > 0.0_dp) scaling%load = canonical%largest_load()
    if (canonical%has_translation) then
      least = canonical%space%least(minval(canonical%gap, mask=.not. canonical%excluded))
      ! Not where all points are excluded.
      if (least < huge(least)) scaling%gap_datum = least
    end if
    scene%prescribed = .not. is_loaded_translation(problem, canonical)
    scene%absorbs_datum = canonical%has_translation
    call check_range(canonical, scaling, info)
    if (info%failed()) return
    call allocate_scene(canonical, scene, info)
    if (info%failed()) return
    scene%gap = (canonical%gap - scaling%gap_datum)/scaling%load
    if (allocated(scene%play)) scene%play = scaled_bound(canonical%upper, scaling%load)
    if (scene%has_limits()) then
      scene%limit = scaled_bound(canonical%limit, scaling%load)
      scene%limit_upper = scaled_bound(canonical%limit_upper, scaling%load)
    end if
    if (allocated(scene%excluded)) then
      scene%excluded = canonical%excluded
      where (canonical%excluded) scene%gap = OUT_OF_REACH
    end if
    if (allocated(scene%modes)) then
      scene%modes = canonical%modes
      if (allocated(scene%excluded)) call clear_rows(canonical%excluded, scene%modes)
      scene%load = canonical%load/scaling%load
      scene%balance = canonical%feasible_force/scaling%load
    end if
  end subroutine set_general_scene

  !> A limit or a play in units of the scene, huge where there is none or where sums over 2**40 cells may overflow.
  elemental function scaled_bound(bound, load) result(scaled)
    real(dp), intent(in) :: bound, load
    real(dp) :: scaled

    scaled = huge(scaled)
    if (bound < min(load, 1.0_dp)*(huge(scaled)/2.0_dp**40)) scaled = bound/load
  end function scaled_bound

  !> Allocate what the scene has. Error: FUGE_ERR_MEMORY.
  subroutine allocate_scene(canonical, scene, info)
    type(canonical_problem), intent(in) :: canonical
    type(contact_scene), intent(inout) :: scene
    type(fuge_info), intent(inout) :: info
    integer :: m, n, stat
    logical :: excludes, has_play

    n = size(canonical%gap)
    m = size(canonical%load)
    excludes = canonical%space%anywhere(any(canonical%excluded))
    has_play = canonical%space%anywhere(any(canonical%upper < huge(1.0_dp))) .or. canonical%has_limits()
    allocate (scene%gap(n), stat=stat)
    if (stat == 0 .and. excludes) allocate (scene%excluded(n), stat=stat)
    if (stat == 0 .and. has_play) allocate (scene%play(n), stat=stat)
    if (stat == 0 .and. canonical%has_limits()) allocate (scene%limit(n), scene%limit_upper(n), stat=stat)
    if (stat == 0 .and. scene%prescribed .and. m > 0) then
      allocate (scene%modes(n, m), scene%load(m), scene%balance(n), stat=stat)
    end if
    call require_memory(stat, 'the gaps and modes of', n, 'points', info)
    call canonical%space%agree(info)
  end subroutine allocate_scene

  !> No motion displaces the points marked in `excluded` (n).
  pure subroutine clear_rows(excluded, modes)
    logical, intent(in) :: excluded(:)
    real(dp), intent(inout) :: modes(:, :)
    integer :: j

    do j = 1, size(modes, 2)
      where (excluded) modes(:, j) = 0.0_dp
    end do
  end subroutine clear_rows

  !> Is there one free translation with a load, and no upper stop? Its forces push, and have the load for their sum.
  function is_loaded_translation(problem, canonical) result(loaded)
    type(fuge_problem), intent(in) :: problem
    type(canonical_problem), intent(in) :: canonical
    logical :: loaded

    loaded = size(canonical%load) == 1 .and. .not. allocated(problem%modes)
    if (loaded) loaded = .not. canonical%space%anywhere(any(canonical%upper < huge(1.0_dp)))
    if (loaded) loaded = canonical%load(1) > 0.0_dp
  end function is_loaded_translation

  !> Refuse gaps so large that their squares overflow, after division by the load if there is one (FUGE_ERR_OVERFLOW).
  subroutine check_range(canonical, scaling, info)
    type(canonical_problem), intent(in) :: canonical
    type(scene_scaling), intent(in) :: scaling
    type(fuge_info), intent(inout) :: info
    real(dp) :: largest
    integer :: excess

    largest = canonical%space%largest(maxval(abs(canonical%gap - scaling%gap_datum), mask=.not. canonical%excluded))
    ! All points are excluded.
    if (largest < 0.0_dp) return
    excess = exponent(largest) - exponent(scaling%load)
    if (2*excess <= LARGEST_EXPONENT) return
    if (canonical%largest_load() > 0.0_dp) then
      call report(info, FUGE_ERR_OVERFLOW, 'the gaps are 2**'//text(excess) &
                  //' times the resultants: choose units in which they are nearer to each other')
    else
      call report(info, FUGE_ERR_OVERFLOW, 'the gaps less the prescribed motions reach 2**'//text(excess) &
                  //': choose units in which lengths are nearer to 1')
    end if
  end subroutine check_range

  !> Forces, gaps and motions in the units of the problem and in its modes, with a warning where the contact does not
  !> resist a motion. Error: FUGE_ERR_MEMORY.
  subroutine assemble_general(operator, problem, canonical, scene, scaling, iterate, solution, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(canonical_problem), intent(in) :: canonical
    type(contact_scene), intent(in) :: scene
    type(scene_scaling), intent(in) :: scaling
    type(contact_iterate), intent(inout) :: iterate
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info
    type(contact_solution) :: reduced
    real(dp), allocatable :: motion(:)
    integer :: stat

    call allocate_solution(size(scene%gap), size(canonical%load), reduced, info)
    if (.not. info%failed()) then
      allocate (motion(problem%mode_count()), stat=stat)
      call require_memory(stat, 'the motions', info)
    end if
    call canonical%space%agree(info)
    if (info%failed()) return
    call find_states(iterate%contact_set, reduced%state)
    if (scene%has_limits()) then
      call clip_forces(scene, iterate%contact_set)
    else
      call drop_rounding(scene, reduced%state, iterate%gradients%softness, iterate%force, info)
    end if
    if (info%failed()) return
    reduced%force = scaling%load*iterate%force
    call set_gaps(scene, scaling, canonical%upper, iterate, reduced)
    if (scene%has_limits()) call set_limited(scene, scaling, canonical, iterate, reduced)
    if (allocated(scene%modes)) then
      reduced%motion = scaling%load*iterate%rigid_motion
    else
      reduced%motion = scaling%load*iterate%motion
    end if
    if (canonical%has_translation) then
      reduced%motion(1) = (reduced%motion(1) + operator%datum()*canonical%space%total(sum(reduced%force))) &
                        + scaling%gap_datum
    end if
    call report_unresisted_motion(canonical, reduced, info)
    if (info%failed()) return
    call canonical%to_given_modes(problem%prescribed_motion(), reduced%motion, motion)
    if (allocated(scene%excluded)) call set_excluded_gaps(operator, problem, canonical, scene, scaling, motion, &
                                                         iterate%displacement, reduced, info)
    if (info%failed()) return
    call move_alloc(reduced%force, solution%force)
    call move_alloc(reduced%gap, solution%gap)
    call move_alloc(motion, solution%motion)
  end subroutine assemble_general

  !> Forces that are rounding, or that pull at their stop by rounding, become zero. The other forces make up for what a
  !> resultant loses by that: beside a body under a large load, another one may have none. Error: FUGE_ERR_MEMORY.
  subroutine drop_rounding(scene, state, softness, force, info)
    type(contact_scene), intent(in) :: scene
    integer, intent(in) :: state(:)
    real(dp), intent(in) :: softness
    real(dp), intent(inout), contiguous :: force(:)
    type(fuge_info), intent(inout) :: info
    type(contact_segments) :: segments
    type(mode_projection) :: projection
    real(dp), allocatable :: dropped(:)
    logical :: possible, pulls
    integer :: stat

    call clear_rounding(scene, state, softness, force, pulls)
    if (.not. (pulls .and. allocated(scene%modes))) return
    allocate (dropped, source=force, stat=stat)
    call require_memory(stat, 'the forces of', size(state), 'points', info)
    segments%space = scene%rows%point_space
    call segments%space%agree(info)
    if (stat /= 0 .or. info%failed()) return
    call segments%find(abs(dropped) > 0.0_dp, info)
    if (.not. info%failed()) call projection%set(scene%modes, segments, info)
    if (info%failed()) return
    call projection%correct_resultants(scene%modes, scene%load, segments, force, possible)
    if (possible) then
      call clear_rounding(scene, state, softness, force, pulls)
    else
      force = dropped
    end if
  end subroutine drop_rounding

  !> Set forces to zero that are rounding, or that pull at their stop; `pulls` tells whether any of these did.
  subroutine clear_rounding(scene, state, softness, force, pulls)
    type(contact_scene), intent(in) :: scene
    integer, intent(in) :: state(:)
    real(dp), intent(in) :: softness
    real(dp), intent(inout) :: force(:)
    logical, intent(out) :: pulls
    real(dp) :: least
    integer :: k

    pulls = .false.
    least = max(ROUNDINGS*epsilon(least)*scene%rows%largest(maxval(abs(force))), scene%rounding_force(softness))
    do k = 1, size(state)
      if (abs(force(k)) <= least) force(k) = 0.0_dp
      if (force(k)*real(state(k), dp) < 0.0_dp .and. .not. scene%is_tied(k)) then
        force(k) = 0.0_dp
        pulls = .true.
      end if
    end do
    pulls = scene%rows%anywhere(pulls)
  end subroutine clear_rounding

  !> Gaps between the stops, in the units of the problem, as is the play `upper` (n); 0 at points that are excluded.
  pure subroutine set_gaps(scene, scaling, upper, iterate, reduced)
    type(contact_scene), intent(in) :: scene
    type(scene_scaling), intent(in) :: scaling
    real(dp), intent(in) :: upper(:)
    type(contact_iterate), intent(in) :: iterate
    type(contact_solution), intent(inout) :: reduced
    integer :: k

    do k = 1, size(scene%gap)
      reduced%gap(k) = 0.0_dp
      if (scene%gap(k) >= OUT_OF_REACH) cycle
      reduced%gap(k) = scaling%load*max(deformed_gap(scene%gap(k), iterate%displacement(k), iterate%motion), 0.0_dp)
      if (reduced%state(k) == FUGE_AT_LOWER_STOP) reduced%gap(k) = 0.0_dp
      reduced%gap(k) = min(reduced%gap(k), upper(k))
      if (reduced%state(k) == FUGE_AT_UPPER_STOP) reduced%gap(k) = upper(k)
    end do
  end subroutine set_gaps

  !> Forces at their limits, and gaps where forces have limits: beyond its stop at a point that gives way, and without
  !> bound at a stop that has no force.
  pure subroutine set_limited(scene, scaling, canonical, iterate, reduced)
    type(contact_scene), intent(in) :: scene
    type(scene_scaling), intent(in) :: scaling
    type(canonical_problem), intent(in) :: canonical
    type(contact_iterate), intent(in) :: iterate
    type(contact_solution), intent(inout) :: reduced
    real(dp) :: gap
    integer :: k

    do k = 1, size(scene%gap)
      if (scene%gap(k) >= OUT_OF_REACH) cycle
      gap = scaling%load*deformed_gap(scene%gap(k), iterate%displacement(k), iterate%motion)
      select case (iterate%limited(k))
      case (1)
        reduced%force(k) = canonical%limit(k)
        reduced%gap(k) = min(gap, 0.0_dp)
      case (-1)
        reduced%force(k) = -canonical%limit_upper(k)
        reduced%gap(k) = max(gap, canonical%upper(k))
      case default
        if (.not. (iterate%contact(k) .or. canonical%pushes(k))) reduced%gap(k) = min(gap, canonical%upper(k))
      end select
    end do
  end subroutine set_limited

  !> c = g + A f - R q at the points that are excluded; `motion` q (m) in the modes R of the problem, `displacement` (n)
  !> in units of the scene. Error: FUGE_ERR_MEMORY. The arguments are nine, because excluded points need the problem
  !> both as given and as a scene.
  subroutine set_excluded_gaps(operator, problem, canonical, scene, scaling, motion, displacement, reduced, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(canonical_problem), intent(in) :: canonical
    type(contact_scene), intent(in) :: scene
    type(scene_scaling), intent(in) :: scaling
    real(dp), intent(in) :: motion(:), displacement(:)
    type(contact_solution), intent(inout) :: reduced
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: scaled(:)
    real(dp) :: shift
    integer :: stat

    allocate (scaled(size(displacement)), stat=stat)
    call require_memory(stat, 'the gaps of the excluded points', info)
    call canonical%space%agree(info)
    if (info%failed()) return
    shift = 0.0_dp
    if (scene%absorbs_datum .or. .not. scene%prescribed) then
      shift = operator%datum()*canonical%space%total(sum(reduced%force))
    end if
    ! No rigid motion has been taken out of these displacements: the modes of the scene are zero there.
    scaled = 0.0_dp
    where (scene%excluded) scaled = scaling%load*displacement + shift
    call canonical%set_excluded_gaps_from(scaled, problem%gap, motion, reduced%gap)
  end subroutine set_excluded_gaps

end module fuge_general_scene
