!> Random contact problems for two engines: any modes, stops and loads on any body of random_bodies. The number of a
!> scene says all of it.
module random_scenes
  use, intrinsic :: iso_fortran_env, only: int64
  use engine_scene_type, only: engine_scene
  use fuge_kinds, only: dp
  use fuge_problem_type, only: fuge_problem
  use general_reference, only: draw, integers, is_prescribed, modes_of
  use special_numbers, only: infinity
  use random_bodies, only: draw_body
  use random_draws, only: chance, decimal, one_of, seed_of, uniform
  implicit none
  private

  public :: draw_scene

contains

  !> Scene `number` >= 1.
  subroutine draw_scene(number, scene)
    integer, intent(in) :: number
    type(engine_scene), intent(out) :: scene
    integer(int64) :: seed
    real(dp), allocatable :: force(:)
    real(dp) :: length

    scene%number = number
    seed = seed_of(number)
    call draw_body(seed, scene)
    allocate (scene%problem%gap(size(scene%x)))
    scene%problem%gap = 0.0_dp
    call draw_motions(seed, scene)
    call draw_stops(seed, scene)
    call draw_forces(seed, scene, force)
    call draw_resultant(seed, scene, force)
    length = displacement_by(scene%alpha, force)
    if (chance(seed, 0.7_dp)) length = length*decimal(seed, -4.0_dp, 3.0_dp)
    call draw_gaps(seed, length, scene)
    call scale_stops(seed, length, scene%problem)
    call draw_prescribed(seed, length, scene)
  end subroutine draw_scene

  !> The largest terms of displacements by these forces; without forces by a force of 1, without those 1.
  pure function displacement_by(alpha, force) result(length)
    real(dp), intent(in) :: alpha(:, :), force(:)
    real(dp) :: length
    real(dp) :: terms(size(force))
    integer :: k

    terms = 0.0_dp
    do k = 1, size(force)
      terms = terms + abs(alpha(:, k)*force(k))
    end do
    length = maxval(terms)
    if (.not. length > 0.0_dp) length = maxval(abs(alpha))
    if (.not. length > 0.0_dp) length = 1.0_dp
  end function displacement_by

  !> Modes, none to four.
  subroutine draw_motions(seed, scene)
    integer(int64), intent(inout) :: seed
    type(engine_scene), intent(inout) :: scene
    integer :: kind

    kind = one_of(seed, 12)
    select case (kind)
    case (1, 2)
      scene%motions = 'default'
    case (3)
      allocate (scene%problem%modes(size(scene%x), 0))
      scene%motions = 'no motion'
    case (4:7)
      call set_rigid(seed, kind - 3, scene)
    case (8, 9)
      call set_parts(seed, kind == 9, scene)
    case default
      call set_random(seed, kind == 10, scene)
    end select
    if (allocated(scene%problem%modes)) call change_units(seed, scene)
  end subroutine draw_motions

  !> `m` of translation, two tilts and a bend.
  subroutine set_rigid(seed, m, scene)
    integer(int64), intent(inout) :: seed
    integer, intent(in) :: m
    type(engine_scene), intent(inout) :: scene
    real(dp) :: away

    away = 0.0_dp
    if (chance(seed, 0.2_dp)) away = decimal(seed, 0.0_dp, 6.0_dp)
    allocate (scene%problem%modes(size(scene%x), m))
    scene%problem%modes(:, 1) = 1.0_dp
    if (m > 1) scene%problem%modes(:, 2) = scene%x - away
    if (m > 2) scene%problem%modes(:, 3) = scene%y
    if (m > 3) scene%problem%modes(:, 4) = scene%x*scene%y
    scene%motions = 'rigid'
    if (away > 0.0_dp) scene%motions = 'rigid, far away'
  end subroutine set_rigid

  !> Each part has a translation, and a tilt where `tilted`.
  subroutine set_parts(seed, tilted, scene)
    integer(int64), intent(inout) :: seed
    logical, intent(in) :: tilted
    type(engine_scene), intent(inout) :: scene
    integer :: m

    m = merge(4, 2, tilted)
    if (all(scene%part == 1)) m = m/2
    allocate (scene%problem%modes(size(scene%x), m))
    scene%problem%modes = 0.0_dp
    where (scene%part == 1) scene%problem%modes(:, 1) = 1.0_dp
    if (m > 1) then
      where (scene%part == 2) scene%problem%modes(:, 2) = 1.0_dp
    end if
    if (m > 3) then
      where (scene%part == 1) scene%problem%modes(:, 3) = scene%x
      where (scene%part == 2) scene%problem%modes(:, 4) = scene%y
    end if
    scene%motions = 'two parts'
    ! Modes that move a few points only.
    if (chance(seed, 0.2_dp)) scene%problem%modes(one_of(seed, size(scene%x)), :) = 0.0_dp
  end subroutine set_parts

  !> One to four modes of random numbers, none negative where they `push`; no more than points in most cases.
  subroutine set_random(seed, push, scene)
    integer(int64), intent(inout) :: seed
    logical, intent(in) :: push
    type(engine_scene), intent(inout) :: scene
    integer :: j, m

    m = one_of(seed, 4)
    if (.not. chance(seed, 0.05_dp)) m = min(m, size(scene%x))
    allocate (scene%problem%modes(size(scene%x), m))
    do j = 1, m
      call draw(seed, scene%problem%modes(:, j))
    end do
    if (.not. push) scene%problem%modes = scene%problem%modes - 0.5_dp
    scene%motions = merge('random, positive', 'random          ', push)
  end subroutine set_random

  !> Modes in units that are up to 1e8 apart.
  subroutine change_units(seed, scene)
    integer(int64), intent(inout) :: seed
    type(engine_scene), intent(inout) :: scene
    integer :: j

    if (chance(seed, 0.6_dp)) return
    do j = 1, size(scene%problem%modes, 2)
      scene%problem%modes(:, j) = decimal(seed, -4.0_dp, 4.0_dp)*scene%problem%modes(:, j)
    end do
    scene%motions = trim(scene%motions)//', units'
  end subroutine change_units

  !> Excluded points, and which points have an upper stop: play of 0 or 1, scaled later.
  subroutine draw_stops(seed, scene)
    integer(int64), intent(inout) :: seed
    type(engine_scene), intent(inout) :: scene
    integer :: k, kind

    kind = one_of(seed, 20)
    select case (kind)
    case (1:7)
      call draw_play(seed, scene)
    case (8, 9)
      call draw_excluded(seed, scene)
    case (10, 11)
      call draw_play(seed, scene)
      call draw_excluded(seed, scene)
    case (12)
      allocate (scene%problem%gap_upper(size(scene%x)))
      scene%problem%gap_upper = 0.0_dp
      scene%stops = 'all tied'
    case (13)
      allocate (scene%problem%excluded(size(scene%x)))
      scene%problem%excluded = .true.
      do k = 1, one_of(seed, 6) - 1
        scene%problem%excluded(one_of(seed, size(scene%x))) = .false.
      end do
      scene%stops = 'nearly all excluded'
    case default
      scene%stops = 'one-sided'
    end select
  end subroutine draw_stops

  !> Play of random size, of no size, or infinite.
  subroutine draw_play(seed, scene)
    integer(int64), intent(inout) :: seed
    type(engine_scene), intent(inout) :: scene
    real(dp), allocatable :: choice(:)
    real(dp) :: one_sided, tied

    allocate (choice(size(scene%x)), scene%problem%gap_upper(size(scene%x)))
    one_sided = uniform(seed, 0.0_dp, 0.9_dp)
    tied = uniform(seed, 0.0_dp, 0.3_dp)
    call draw(seed, choice)
    call draw(seed, scene%problem%gap_upper)
    where (choice < one_sided) scene%problem%gap_upper = infinity()
    where (choice > 1.0_dp - tied) scene%problem%gap_upper = 0.0_dp
    scene%stops = 'play'
  end subroutine draw_play

  subroutine draw_excluded(seed, scene)
    integer(int64), intent(inout) :: seed
    type(engine_scene), intent(inout) :: scene
    real(dp), allocatable :: choice(:)
    real(dp) :: share

    allocate (choice(size(scene%x)), scene%problem%excluded(size(scene%x)))
    share = uniform(seed, 0.0_dp, 0.7_dp)
    call draw(seed, choice)
    scene%problem%excluded = choice < share
    scene%stops = trim(scene%stops)//' excluded'
  end subroutine draw_excluded

  !> Admissible forces at some points, in any unit.
  subroutine draw_forces(seed, scene, force)
    integer(int64), intent(inout) :: seed
    type(engine_scene), intent(in) :: scene
    real(dp), allocatable, intent(out) :: force(:)
    real(dp), allocatable :: choice(:)
    real(dp) :: share
    integer :: kept

    allocate (force(size(scene%x)), choice(size(scene%x)))
    share = uniform(seed, 0.05_dp, 1.0_dp)
    kept = one_of(seed, size(force))
    call draw(seed, force)
    if (chance(seed, 0.2_dp)) force = anint(1.0_dp + 3.0_dp*force)
    call draw(seed, choice)
    choice(kept) = 0.0_dp
    where (choice > share) force = 0.0_dp
    if (allocated(scene%problem%gap_upper)) then
      call draw(seed, choice)
      where (choice > 0.5_dp .and. scene%problem%gap_upper < infinity()) force = -force
    end if
    if (allocated(scene%problem%excluded)) then
      where (scene%problem%excluded) force = 0.0_dp
    end if
    if (chance(seed, 0.5_dp)) force = force*decimal(seed, -12.0_dp, 12.0_dp)
  end subroutine draw_forces

  !> Resultants of the forces; at the edge of what the points can carry, beyond it, none, or any.
  subroutine draw_resultant(seed, scene, force)
    integer(int64), intent(inout) :: seed
    type(engine_scene), intent(inout) :: scene
    real(dp), intent(inout) :: force(:)
    real(dp), allocatable :: modes(:, :)
    real(dp) :: size_of_w
    integer :: j, kind, m

    allocate (modes, source=modes_of(scene%problem))
    m = size(modes, 2)
    kind = one_of(seed, 20)
    scene%load = 'inside'
    if (kind <= 3) call move_forces_to_edge(seed, scene, modes, force)
    allocate (scene%problem%resultant, source=matmul(force, modes))
    select case (kind)
    case (2, 3)
      ! To either side of the edge, by rounding or more.
      size_of_w = decimal(seed, -16.0_dp, -3.0_dp)
      do j = 1, m
        scene%problem%resultant(j) = scene%problem%resultant(j)*(1.0_dp + size_of_w*uniform(seed, -1.0_dp, 1.0_dp))
      end do
      scene%load = 'near the edge'
    case (4)
      do j = 1, m
        scene%problem%resultant(j) = uniform(seed, -1.0_dp, 1.0_dp)*sum(abs(modes(:, j)*force))
      end do
      scene%load = 'any'
    case (5)
      scene%problem%resultant = -scene%problem%resultant
      scene%load = 'opposite'
    case (6)
      scene%problem%resultant = 0.0_dp
      scene%load = 'none'
    case (7)
      if (m > 0) scene%problem%resultant(one_of(seed, m)) = 0.0_dp
      scene%load = 'one of none'
    end select
  end subroutine draw_resultant

  !> Keep forces only where a random motion, raised until it opens or just touches all points, touches.
  subroutine move_forces_to_edge(seed, scene, modes, force)
    integer(int64), intent(inout) :: seed
    type(engine_scene), intent(inout) :: scene
    real(dp), intent(in) :: modes(:, :)
    real(dp), intent(inout) :: force(:)
    real(dp) :: closing(size(force))
    integer :: chosen, j
    logical :: along_axis

    if (size(modes, 2) < 1) return
    ! Along an axis several points may touch.
    along_axis = chance(seed, 0.7_dp)
    if (along_axis .and. size(modes, 2) > 1) then
      closing = modes(:, 2)*sign(1.0_dp, uniform(seed, -1.0_dp, 1.0_dp))
    else
      closing = 0.0_dp
      do j = 1, size(modes, 2)
        closing = closing + uniform(seed, -1.0_dp, 1.0_dp)*modes(:, j)
      end do
    end if
    chosen = maxloc(closing, dim=1)
    if (.not. maxval(abs(force)) > 0.0_dp) force = 1.0_dp
    force(chosen) = maxval(abs(force))
    where (closing < closing(chosen)) force = 0.0_dp
    scene%load = 'at the edge'
  end subroutine move_forces_to_edge

  !> Gaps of several shapes, the size of `length`, and a datum.
  subroutine draw_gaps(seed, length, scene)
    integer(int64), intent(inout) :: seed
    real(dp), intent(in) :: length
    type(engine_scene), intent(inout) :: scene
    real(dp), allocatable :: gap(:)
    real(dp) :: waves

    allocate (gap(size(scene%x)))
    waves = uniform(seed, 5.0_dp, 60.0_dp)
    call draw(seed, gap)
    select case (one_of(seed, 8))
    case (1)
      gap = 0.0_dp
    case (2)
      gap = scene%x**2 + scene%y**2
    case (3)
      gap = cos(waves*scene%x)*cos(0.7_dp*waves*scene%y)
    case (4)
      gap = abs(scene%x) + 0.3_dp*abs(scene%y)
    case (5)
      call integers(seed, -2, 2, gap)
    case (6)
      gap = scene%x**2 + 0.1_dp*gap
    case (7)
      gap = merge(1.0_dp, 0.0_dp, gap > 0.5_dp)
    end select
    if (chance(seed, 0.4_dp)) gap = gap + uniform(seed, -1.0_dp, 1.0_dp)
    if (chance(seed, 0.05_dp)) gap = gap + decimal(seed, 0.0_dp, 6.0_dp)
    scene%problem%gap = length*gap
  end subroutine draw_gaps

  !> Play of up to the size of the gaps, much less or more.
  subroutine scale_stops(seed, length, problem)
    integer(int64), intent(inout) :: seed
    real(dp), intent(in) :: length
    type(fuge_problem), intent(inout) :: problem
    real(dp) :: size_of_play

    if (.not. allocated(problem%gap_upper)) return
    size_of_play = length
    if (chance(seed, 0.5_dp)) size_of_play = length*decimal(seed, -6.0_dp, 2.0_dp)
    where (problem%gap_upper < infinity()) problem%gap_upper = size_of_play*problem%gap_upper
  end subroutine scale_stops

  !> Prescribe some motions, or all.
  subroutine draw_prescribed(seed, length, scene)
    integer(int64), intent(inout) :: seed
    real(dp), intent(in) :: length
    type(engine_scene), intent(inout) :: scene
    real(dp), allocatable :: modes(:, :)
    real(dp) :: arm, share
    integer :: j, m

    if (.not. chance(seed, 0.3_dp)) return
    allocate (modes, source=modes_of(scene%problem))
    m = size(modes, 2)
    allocate (scene%problem%prescribed(m), scene%problem%motion(m))
    share = merge(1.0_dp, 0.5_dp, chance(seed, 0.3_dp))
    do j = 1, m
      scene%problem%prescribed(j) = chance(seed, share)
      arm = maxval(abs(modes(:, j)))
      if (.not. arm > 1.0e-12_dp) arm = 1.0_dp
      scene%problem%motion(j) = length*uniform(seed, -1.0_dp, 2.0_dp)/arm
    end do
    if (m < 1) return
    if (any([(is_prescribed(scene%problem, j), j=1, m)])) scene%load = trim(scene%load)//', prescribed'
  end subroutine draw_prescribed

end module random_scenes
