!> Hard cases of general problems: nearly dependent modes, far-away points of reference, little play, loads at the edge
!> of equilibrium.
!>
!> As in hard_scenes, the answer F, c, q is chosen first, in whole numbers of which no sum reaches 2**53; then
!> gap = c - alpha F + R q and w = R^T F.
module hard_general
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_options_type, only: fuge_options, FUGE_ACTIVE_SET
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_status, only: fuge_info, FUGE_DONE, FUGE_ERR_NO_EQUILIBRIUM, FUGE_WARN_ILL_CONDITIONED, &
    FUGE_WARN_NOT_UNIQUE
  use general_reference, only: integers, solve_general
  use special_numbers, only: infinity
  use influence_matrices, only: integer_bed
  implicit none
  private

  public :: numbered_general, solve_general_scene, general_force_error, general_gap_error

  integer, parameter, public :: GENERAL_SCENES = 25
  integer, parameter :: N = 16

  type, public :: general_scene
    character(len=44) :: name = ''
    character(len=64) :: why = ''
    real(dp), allocatable :: alpha(:, :)
    type(fuge_problem) :: problem
    !> The answer; no `opening` where the motions are not unique.
    real(dp), allocatable :: force(:), opening(:)
    !> Largest error of forces relative to the largest force, of gaps relative to the lengths.
    real(dp) :: tolerance = 1.0e-12_dp
    integer :: status = FUGE_DONE
    !> At the limit of double precision: an answer with a small residual is accepted too.
    logical :: hedged = .false.
  end type general_scene

contains

  !> Scene 1 .. GENERAL_SCENES.
  pure function numbered_general(number) result(scene)
    integer, intent(in) :: number
    type(general_scene) :: scene
    integer, parameter :: BITS(3) = [10, 20, 30]

    select case (number)
    case (1:3)
      scene = nearly_parallel(BITS(number))
    case (4:6)
      scene = far_away(BITS(number - 3))
    case (7:8)
      scene = odd_units(merge(100, -100, number == 7))
    case (9:11)
      scene = many_modes(N - 11 + number)
    case (12:17)
      scene = with_play(number - 11)
    case (18:24)
      scene = at_the_edge(number - 17)
    case default
      scene = far_away(30, motion=15)
      scene%why = '2**30 widths, and the motion is 2**15 times larger'
      scene%status = FUGE_WARN_ILL_CONDITIONED
      ! The rounding of R q alone changes the forces by nearly a hundredth.
      scene%tolerance = 5.0e-2_dp
    end select
  end function numbered_general

  !> The problem that has this answer.
  pure function from_answer(name, why, modes, force, opening, motion) result(scene)
    character(len=*), intent(in) :: name, why
    real(dp), intent(in) :: modes(:, :), force(:), opening(:), motion(:)
    type(general_scene) :: scene

    scene%name = name
    scene%why = why
    allocate (scene%alpha, source=integer_bed(size(force), 61_int64))
    allocate (scene%force, source=force)
    allocate (scene%opening, source=opening)
    allocate (scene%problem%modes, source=modes)
    allocate (scene%problem%gap, source=opening - matmul(scene%alpha, force) + matmul(modes, motion))
    allocate (scene%problem%resultant, source=matmul(force, modes))
  end function from_answer

  !> Coordinates of the points, -8 .. 7.
  pure function abscissa() result(x)
    real(dp) :: x(N)
    integer :: k

    x = [(real(k - 1 - N/2, dp), k=1, N)]
  end function abscissa

  !> Forces and gaps of an answer in which two of three points touch.
  pure subroutine two_of_three(force, opening)
    real(dp), intent(out) :: force(N), opening(N)
    integer :: k

    force = [(real(merge(1 + mod(k, 4), 0, mod(k, 3) > 0), dp), k=1, N)]
    opening = [(real(merge(0, 1 + mod(k, 9), mod(k, 3) > 0), dp), k=1, N)]
  end subroutine two_of_three

  !> Two modes that are linearly independent in their last bits only.
  pure function nearly_parallel(bits) result(scene)
    integer, intent(in) :: bits
    type(general_scene) :: scene
    real(dp) :: modes(N, 3), force(N), opening(N)

    call two_of_three(force, opening)
    modes(:, 1) = 1.0_dp
    modes(:, 2) = abscissa()
    modes(:, 3) = scale(abscissa(), bits) + abscissa()**2
    scene = from_answer('almost parallel modes', 'two of three agree to 2**-'//text(bits), modes, force, opening, &
                        [3.0_dp, 1.0_dp, 2.0_dp])
    scene%tolerance = max(scene%tolerance, scale(4.0e-15_dp, bits))
  end function nearly_parallel

  !> A tilt about a point far from the contact; the motion is 2**`motion` times larger than without it.
  pure function far_away(bits, motion) result(scene)
    integer, intent(in) :: bits
    integer, intent(in), optional :: motion
    type(general_scene) :: scene
    real(dp) :: modes(N, 2), force(N), opening(N), q(2)

    call two_of_three(force, opening)
    modes(:, 1) = 1.0_dp
    modes(:, 2) = abscissa() - scale(real(N, dp), bits)
    q = [5.0_dp, 3.0_dp]
    if (present(motion)) q = scale(q, motion)
    scene = from_answer('tilt about a far-away point', 'its distance is 2**'//text(bits)//' widths', modes, force, &
                        opening, q)
    scene%tolerance = max(scene%tolerance, scale(4.0e-15_dp, bits))
  end function far_away

  !> A tilt in a very large or very small unit.
  pure function odd_units(bits) result(scene)
    integer, intent(in) :: bits
    type(general_scene) :: scene
    real(dp) :: modes(N, 2), force(N), opening(N)

    call two_of_three(force, opening)
    modes(:, 1) = 1.0_dp
    modes(:, 2) = scale(abscissa(), bits)
    scene = from_answer('unit of the tilt', '2**'//text(bits)//' of that of the translation', modes, force, opening, &
                        [5.0_dp, scale(3.0_dp, -bits)])
  end function odd_units

  !> As many modes as points, or nearly so.
  pure function many_modes(m) result(scene)
    integer, intent(in) :: m
    type(general_scene) :: scene
    real(dp) :: modes(N, m), force(N), opening(N)
    integer(int64) :: seed
    integer :: j

    seed = 62_int64
    do j = 1, m
      call integers(seed, -3, 3, modes(:, j))
      modes(j, j) = modes(j, j) + 20.0_dp
    end do
    ! All points carry: fewer could not resist the modes.
    force = [(real(1 + mod(j, 4), dp), j=1, N)]
    opening = 0.0_dp
    scene = from_answer('many motions', text(m)//' motions of '//text(N)//' points', modes, force, opening, &
                        [(real(j, dp), j=1, m)])
  end function many_modes

  !> Two-sided points.
  pure function with_play(number) result(scene)
    integer, intent(in) :: number
    type(general_scene) :: scene
    real(dp) :: modes(N, 2), force(N), opening(N), upper(N)
    integer :: k

    modes(:, 1) = 1.0_dp
    modes(:, 2) = abscissa()
    force = [(real(merge(0, (-1)**k*(1 + mod(k, 4)), mod(k, 3) == 0), dp), k=1, N)]
    select case (number)
    case (1)
      upper = 0.0_dp
      opening = 0.0_dp
      scene = from_answer('no play', 'all points tied', modes, force, opening, [7.0_dp, -2.0_dp])
    case (2)
      call stops_of(force, spread(2.0_dp, 1, N), upper, opening)
      scene = from_answer('play of 1e-12 of the gaps', 'both stops are one but for rounding', modes, force, opening, &
                          [scale(1.0_dp, 41), 0.0_dp])
    case (3)
      call stops_of(force, spread(2.0_dp, 1, N), upper, opening)
      scene = from_answer('play of 1e-12, tilted', 'the motion is 1e12 of the play', modes, force, opening, &
                          [scale(3.0_dp, 40), scale(1.0_dp, 38)])
      ! The tilt moves points by 2**40, in double precision.
      scene%tolerance = 1.0e-4_dp
    case (4)
      call stops_of(force, [(real(2*k, dp), k=1, N)], upper, opening)
      scene = from_answer('all points two-sided', 'some at either stop, some between', modes, force, opening, &
                          [9.0_dp, 4.0_dp])
    case (5)
      force = -abs(force)
      call stops_of(force, [(real(2*k, dp), k=1, N)], upper, opening)
      scene = from_answer('pulled off', 'contact at the upper stops only', modes, force, opening, [-9.0_dp, 4.0_dp])
    case default
      ! The resultants cancel.
      force = 0.0_dp
      force([1, 4, 5, 8]) = [1.0_dp, -1.0_dp, -1.0_dp, 1.0_dp]
      call stops_of(force, spread(4.0_dp, 1, N), upper, opening)
      scene = from_answer('two-sided without a load', 'forces that balance each other', modes, force, opening, &
                          [1.0_dp, 2.0_dp])
    end select
    allocate (scene%problem%gap_upper, source=upper)
  end function with_play

  !> Points under compression are at the lower stop, under tension at the upper one, without a force in the middle.
  pure subroutine stops_of(force, play, upper, opening)
    real(dp), intent(in) :: force(:), play(:)
    real(dp), intent(out) :: upper(:), opening(:)

    upper = play
    opening = merge(0.0_dp, play, force > 0.0_dp)
    where (abs(force) <= 0.0_dp) opening = 0.5_dp*play
  end subroutine stops_of

  !> Loads that just lift off all points but the last ones, or have no equilibrium.
  pure function at_the_edge(number) result(scene)
    integer, intent(in) :: number
    type(general_scene) :: scene
    real(dp), parameter :: LAST = real(N/2 - 1, dp)
    real(dp) :: modes(N, 2), force(N), opening(N)
    integer :: k

    modes(:, 1) = 1.0_dp
    modes(:, 2) = abscissa()
    force = 0.0_dp
    opening = [(real(N - k, dp), k=1, N)]
    opening(N - 1) = 0.0_dp
    force(N) = 1048576.0_dp
    select case (number)
    case (1)
      force(N - 1:) = [1.0_dp, scale(1.0_dp, 40) - 1.0_dp]
      scene = from_answer('about to tip', 'load within 1e-12 of the last point', modes, force, opening, &
                          [4.0_dp, 1.0_dp])
      scene%tolerance = 1.0e-11_dp
    case (2)
      opening(N - 1) = 1.0_dp
      scene = from_answer('on the edge', 'load exactly at the last point', modes, force, opening, [4.0_dp, 1.0_dp])
      call without_motions(scene)
    case (3)
      scene = from_answer('on the edge, weakly', 'and the next one touches without force', modes, force, opening, &
                          [4.0_dp, 1.0_dp])
      call without_motions(scene)
    case (4)
      scene = from_answer('over the edge', 'load 1e-12 beyond the last point', modes, force, opening, [4.0_dp, 1.0_dp])
      scene%problem%resultant(2) = scene%problem%resultant(1)*LAST*(1.0_dp + 1.0e-12_dp)
      call without_answer(scene)
      scene%hedged = .true.
    case (5)
      scene = from_answer('well over the edge', 'load 1e-9 beyond the last point', modes, force, opening, &
                          [4.0_dp, 1.0_dp])
      scene%problem%resultant(2) = scene%problem%resultant(1)*LAST*(1.0_dp + 1.0e-9_dp)
      call without_answer(scene)
    case (6)
      scene = from_answer('no resultant', 'no point resists the modes', modes, 0.0_dp*force, opening + 1.0_dp, &
                          [4.0_dp, 1.0_dp])
      call without_motions(scene)
    case default
      scene = from_answer('small moment held', 'a stop at the first point holds a load over the edge', modes, force, &
                          opening, [4.0_dp, 1.0_dp])
      call hold_first_point(scene, modes)
    end select
  end function at_the_edge

  !> The motions of this scene are not unique, only its forces.
  pure subroutine without_motions(scene)
    type(general_scene), intent(inout) :: scene

    deallocate (scene%opening)
    scene%status = FUGE_WARN_NOT_UNIQUE
  end subroutine without_motions

  !> This scene has no equilibrium.
  pure subroutine without_answer(scene)
    type(general_scene), intent(inout) :: scene

    deallocate (scene%force, scene%opening)
    scene%status = FUGE_ERR_NO_EQUILIBRIUM
  end subroutine without_answer

  !> The first point carries a tension of 1 at its upper stop: the load is 1e-6 beyond the last point.
  pure subroutine hold_first_point(scene, modes)
    type(general_scene), intent(inout) :: scene
    real(dp), intent(in) :: modes(:, :)

    scene%problem%gap_upper = [scene%opening(1), spread(infinity(), 1, N - 1)]
    scene%force(1) = -1.0_dp
    scene%problem%gap = scene%opening - matmul(scene%alpha, scene%force) + matmul(modes, [4.0_dp, 1.0_dp])
    scene%problem%resultant = matmul(scene%force, modes)
  end subroutine hold_first_point

  !> Solve by the active set.
  subroutine solve_general_scene(scene, solution, info)
    type(general_scene), intent(in) :: scene
    type(fuge_solution), intent(out) :: solution
    type(fuge_info), intent(out) :: info

    call solve_general(scene%alpha, scene%problem, solution, info, fuge_options(FUGE_ACTIVE_SET))
  end subroutine solve_general_scene

  !> Largest error of a force, relative to the largest force.
  pure function general_force_error(scene, solution) result(error)
    type(general_scene), intent(in) :: scene
    type(fuge_solution), intent(in) :: solution
    real(dp) :: error

    error = maxval(abs(solution%force - scene%force))/max(maxval(abs(scene%force)), tiny(error))
  end function general_force_error

  !> Largest error of a gap, relative to the lengths.
  pure function general_gap_error(scene, solution) result(error)
    type(general_scene), intent(in) :: scene
    type(fuge_solution), intent(in) :: solution
    real(dp) :: error, lengths(N)
    integer :: j

    lengths = maxval(abs(scene%problem%gap))
    do j = 1, N
      lengths = lengths + abs(scene%alpha(:, j)*scene%force(j))
    end do
    error = maxval(abs(solution%gap - scene%opening))/maxval(lengths)
  end function general_gap_error

end module hard_general
