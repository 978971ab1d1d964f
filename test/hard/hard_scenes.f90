!> The hard cases: contact problems, most of them built from their answer.
!>
!> The forces F, the gaps c and the approach v_0 are chosen first; then gap = c - alpha F + v_0. In the
!> scenes marked `exact` all of these are whole numbers and no sum of them reaches 2**53, so that nothing
!> rounds: F is the exact answer of the data as stored, however ill-conditioned alpha is.
module hard_scenes
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_cell_elements, only: FUGE_MEAN
  use fuge_halfplane_influence, only: fuge_halfplane_matrix
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, FUGE_ERR_NOT_DEFINITE, FUGE_WARN_NOT_UNIQUE, FUGE_WARN_RESIDUAL
  use general_reference, only: draw, integers
  use hard_scene_type, only: hard_scene, from_answer, from_data, set_answer
  use influence_matrices, only: cell_middles, coupled_springs, halfplane, integer_bed, overlapping_halfplane, &
    ring_of_springs, string, tridiagonal
  implicit none
  private

  public :: numbered_scene, hard_scene, from_data, bowl, steel, fathi, fathi_with_stop, rough, surface, surface_load

  integer, parameter, public :: SCENES = 61, SURFACES = 7

  !> Relative error of forces, divided by the condition number, after refinement with residuals in
  !> extended precision (64 bits: 5e-20).
  real(dp), parameter :: REFINED = 1.0e-19_dp

  real(dp), parameter :: THREE(3, 3) = reshape([3.0_dp, 1.0_dp, 0.0_dp, 1.0_dp, 3.0_dp, 1.0_dp, &
                                                0.0_dp, 1.0_dp, 3.0_dp], [3, 3])

contains

  !> Scene 1 .. SCENES.
  pure function numbered_scene(number) result(scene)
    integer, intent(in) :: number
    type(hard_scene) :: scene
    integer, parameter :: BITS(6) = [14, 20, 27, 33, 40, 47], DECIMALS(6) = [4, 6, 8, 10, 12, 14]

    select case (number)
    case (1:9)
      scene = touching(number)
    case (10:18)
      scene = singular(number - 9)
    case (19:24)
      scene = walsh(BITS(number - 18))
    case (25:30)
      scene = orthogonal(DECIMALS(number - 24))
    case (31:32)
      scene = hilbert(8 + 2*(number - 31))
    case (33:40)
      scene = scaled(number - 32)
    case (41:46)
      scene = loaded(number - 40)
    case (47:49)
      scene = in_units(number - 46)
    case (50:54)
      scene = many_pivots(number - 49)
    case default
      scene = on_halfplane(number - 54)
    end select
  end function numbered_scene

  !> Ties, and points that touch without a force.
  pure function touching(number) result(scene)
    integer, intent(in) :: number
    type(hard_scene) :: scene
    real(dp) :: ones(64), force(50), opening(60), third(60)
    integer :: k

    ones = 1.0_dp
    select case (number)
    case (1)
      scene = from_answer('flat punch, ring of springs', 'every ratio test is a tie', ring_of_springs(64), &
                          3.0_dp*ones, 0.0_dp*ones, 195.0_dp)
    case (2)
      scene = from_data('flat punch, half-plane', 'every ratio test is a tie', &
                        halfplane(cell_middles(65, 0.1_dp), 0.1_dp), spread(0.0_dp, 1, 65), 100.0_dp)
      scene%tolerance = 1.0e-11_dp
    case (3)
      scene = from_answer('flat, tridiag(-1, 2, -1)', 'coefficients of both signs, condition 2e4', tridiagonal(200), &
                          [(0.5_dp*real(k*(201 - k), dp), k=1, 200)], spread(0.0_dp, 1, 200), 1.0_dp)
    case (4)
      scene = from_data('thirds', 'alpha singular, definite for zero sum only', THREE, [0.0_dp, 0.0_dp, 0.0_dp], &
                        10.0_dp)
      scene%alpha = -1.0_dp/9.0_dp
      do k = 1, 3
        scene%alpha(k, k) = 2.0_dp/9.0_dp
      end do
      call set_answer(scene, spread(10.0_dp/3.0_dp, 1, 3), spread(0.0_dp, 1, 3), 0.0_dp)
    case (5)
      force = [(merge(1.0_dp, 0.0_dp, k == 20), k=1, 50)]
      scene = from_answer('zero gap among gaps', 'one point carries all', string(real([(k, k=1, 50)], dp), 64.0_dp), &
                          force, [(merge(0.0_dp, 60.0_dp - real(abs(k - 20), dp), k == 20), k=1, 50)], 64.0_dp)
    case (6)
      third = [(real(merge(1 + mod(k, 7), 0, mod(k, 3) == 0), dp), k=1, 60)]
      opening = [(real(merge(1 + mod(k, 50), 0, mod(k, 3) == 1), dp), k=1, 60)]
      scene = from_answer('a third weakly active', '20 points with F = 0 and c = 0', integer_bed(60, 11_int64), &
                          third, opening, 500.0_dp)
    case (7)
      scene = from_answer('two points, one weakly active', 'rounding decides its state, diagonal 1536 and 24', &
                          reshape([1536.0_dp, -160.0_dp, -160.0_dp, 24.0_dp], [2, 2]), [9.0_dp, 0.0_dp], &
                          [0.0_dp, 0.0_dp], 77.0_dp)
    case (8)
      scene = from_answer('approach 0, one weakly active', 'no length but rounding at point 2', &
                          reshape([1.0_dp, 0.0_dp, -1.0_dp, 0.0_dp, 2.0_dp, 0.0_dp, -1.0_dp, 0.0_dp, 1.0_dp], [3, 3]), &
                          [1.0_dp, 0.0_dp, 1.0_dp], [0.0_dp, 0.0_dp, 0.0_dp], 0.0_dp)
    case default
      scene = from_answer('all weakly active', '59 points with F = 0 and c = 0', integer_bed(60, 12_int64), &
                          [(merge(5.0_dp, 0.0_dp, k == 31), k=1, 60)], spread(0.0_dp, 1, 60), 500.0_dp)
    end select
  end function touching

  !> Repeated points, points close together, and other matrices of low rank.
  pure function singular(number) result(scene)
    integer, intent(in) :: number
    type(hard_scene) :: scene
    integer, parameter :: AGAIN(4) = [1, 2, 3, 2]
    real(dp), parameter :: NONE(4) = 0.0_dp
    real(dp) :: twins(40, 40), place(40)
    integer :: k

    select case (number)
    case (1)
      scene = from_answer('a point repeated', 'two equal rows and gaps', 3.0_dp*THREE(AGAIN, AGAIN), &
                          [4.0_dp, 2.0_dp, 4.0_dp, 0.0_dp], NONE, 42.0_dp)
      call only_gaps_are_unique(scene)
    case (2)
      scene = from_answer('a point repeated, less near', 'two equal rows, the twin stays open', &
                          3.0_dp*THREE(AGAIN, AGAIN), [4.0_dp, 2.0_dp, 4.0_dp, 0.0_dp], &
                          [0.0_dp, 0.0_dp, 0.0_dp, 1.0_dp], 42.0_dp)
      scene%tableau = FUGE_ERR_NOT_DEFINITE
    case (3)
      twins(:20, :20) = integer_bed(20, 13_int64)
      twins = twins([(1 + mod(k, 20), k=1, 40)], [(1 + mod(k, 20), k=1, 40)])
      scene = from_answer('every point twice', '20 pairs of equal rows and gaps', twins, &
                          [(real(merge(1 + mod(k, 5), 0, mod(k, 20) < 12), dp), k=1, 40)], &
                          [(real(merge(0, 7, mod(k, 20) < 12), dp), k=1, 40)], 100.0_dp)
      call only_gaps_are_unique(scene)
    case (4)
      ! Pairs at a spacing of 2**20, so that all numbers are whole.
      place = [(1048576.0_dp*0.5_dp*real(k + mod(k, 2), dp) + real(mod(k + 1, 2), dp), k=1, 40)]
      scene = from_answer('pairs 1e-6 apart, string', 'condition 1e9', string(place, 33554432.0_dp), &
                          [(real(merge(1 + mod(k, 3), 0, mod(k, 5) > 0), dp), k=1, 40)], &
                          [(merge(0.0_dp, 1000.0_dp, mod(k, 5) > 0), k=1, 40)], 1.0e9_dp)
      scene%tolerance = 1.0e-11_dp
    case (5)
      place = [(0.5_dp*real(k + mod(k, 2), dp) + 1.0e-6_dp*real(mod(k + 1, 2), dp), k=1, 40)]
      scene = from_data('pairs 1e-6 apart, half-plane', 'overlapping cells, condition 1e13', &
                        overlapping_halfplane(place, 1.0_dp), 1.0e-2_dp*(place - 9.7_dp)**2, 3.0_dp)
      scene%hedged = .true.
      scene%tolerance = 1.0e-3_dp
      scene%most_pivots = 4
    case (6)
      scene = low_rank('rank 12 of 30', 'singular, but not on the contact', 5.0_dp)
      scene%tableau = FUGE_ERR_NOT_DEFINITE
    case (7)
      scene = low_rank('rank 12 of 30, all touch', 'singular, 18 points with F = 0 and c = 0', 0.0_dp)
      call only_gaps_are_unique(scene)
      ! Without the 18 points the contact set is regular: FUGE_DONE is right as well.
      scene%hedged = .true.
    case (8)
      scene = from_answer('rigid', 'alpha = 0', 0.0_dp*THREE, [7.0_dp, 0.0_dp, 0.0_dp], [0.0_dp, 1.0_dp, 2.0_dp], &
                          0.0_dp)
      scene%tableau = FUGE_ERR_NOT_DEFINITE
      scene%iterative = FUGE_WARN_RESIDUAL
    case default
      scene = from_answer('rigid but for a datum', 'alpha = 1 everywhere, equal gaps', 0.0_dp*THREE + 1.0_dp, &
                          [7.0_dp, 0.0_dp, 0.0_dp], [0.0_dp, 0.0_dp, 0.0_dp], 7.0_dp)
      call only_gaps_are_unique(scene)
    end select
  end function singular

  !> The forces are not unique: no engine is compared with them, and each has to report it.
  pure subroutine only_gaps_are_unique(scene)
    type(hard_scene), intent(inout) :: scene

    deallocate (scene%force)
    scene%tableau = FUGE_ERR_NOT_DEFINITE
    scene%active_set = FUGE_WARN_NOT_UNIQUE
  end subroutine only_gaps_are_unique

  !> alpha = B B^T, where B is the unit matrix above 18 rows of -1, 0, 1; the first 12 points carry the load.
  pure function low_rank(name, why, opening) result(scene)
    character(len=*), intent(in) :: name, why
    real(dp), intent(in) :: opening
    type(hard_scene) :: scene
    integer, parameter :: N = 30, RANK = 12
    real(dp) :: b(N, RANK)
    integer(int64) :: seed
    integer :: k

    seed = 14_int64
    do k = 1, RANK
      call integers(seed, -1, 1, b(:, k))
      b(:RANK, k) = 0.0_dp
      b(k, k) = 1.0_dp
    end do
    scene = from_answer(name, why, matmul(b, transpose(b)), [(real(merge(1 + mod(k, 4), 0, k <= RANK), dp), k=1, N)], &
                        [(merge(0.0_dp, opening, k <= RANK), k=1, N)], 10.0_dp)
  end function low_rank

  !> alpha = Q D Q^T with Walsh functions in Q, D from 2**bits to 1 and half of it 1: on any 12 of the 16 points
  !> the condition number is about 2**bits, and no number rounds.
  pure function walsh(bits) result(scene)
    integer, intent(in) :: bits
    type(hard_scene) :: scene
    integer, parameter :: N = 16
    real(dp) :: q(N, N), d(N)
    integer :: i, j, k

    do j = 1, N
      d(j) = scale(1.0_dp, bits - (min(j, 8) - 1)*bits/7)
      q(:, j) = [(merge(1.0_dp, -1.0_dp, poppar(iand(i - 1, j - 1)) == 0), i=1, N)]
    end do
    scene = from_answer('Walsh functions, 2**'//text(bits), 'condition 1e'//text(nint(0.30103*real(bits))), &
                        matmul(q*spread(d, 1, N), transpose(q)), &
                        [(real(merge(0, 1 + mod(k, 2), mod(k, 4) == 3), dp), k=1, N)], &
                        [(merge(scale(real(k, dp), bits - 6), 0.0_dp, mod(k, 4) == 3), k=1, N)], scale(1.0_dp, bits))
    scene%tolerance = max(scene%tolerance, REFINED*scale(1.0_dp, bits))
  end function walsh

  !> alpha = Q D Q^T with three random reflections in Q. Rounding of alpha changes the answer by up to the condition
  !> number times the unit roundoff.
  pure function orthogonal(decimals) result(scene)
    integer, intent(in) :: decimals
    type(hard_scene) :: scene
    integer, parameter :: N = 40
    real(dp) :: alpha(N, N), v(N), force(N), opening(N)
    integer(int64) :: seed
    integer :: k

    seed = 15_int64 + int(decimals, int64)
    alpha = 0.0_dp
    do k = 1, N
      alpha(k, k) = 10.0_dp**(-real(decimals*(k - 1), dp)/real(N - 1, dp))
    end do
    do k = 1, 3
      call draw(seed, v)
      v = (v - 0.5_dp)/sqrt(sum((v - 0.5_dp)**2))
      alpha = alpha - 2.0_dp*spread(v, 2, N)*spread(matmul(v, alpha), 1, N)
      alpha = alpha - 2.0_dp*spread(matmul(alpha, v), 2, N)*spread(v, 1, N)
    end do
    alpha = 0.5_dp*(alpha + transpose(alpha))
    call integers(seed, 1, 9, force)
    call integers(seed, 1, 9, opening)
    where (mod([(k, k=1, N)], 3) == 0)
      force = 0.0_dp
    else where
      opening = 0.0_dp
    end where
    scene = from_answer('Q D Q^T', 'condition 1e'//text(decimals), alpha, force, opening, 1.0_dp)
    scene%exact = .false.
    scene%tolerance = min(1.0_dp, 10.0_dp**(decimals - 15))
    scene%hedged = decimals > 12
    if (decimals > 6) scene%iterative = FUGE_WARN_RESIDUAL
  end function orthogonal

  !> The Hilbert matrix times the least common multiple of its denominators, in whole numbers.
  pure function hilbert(n) result(scene)
    integer, intent(in) :: n
    type(hard_scene) :: scene
    real(dp) :: alpha(n, n), multiple
    integer :: i, j, k

    multiple = merge(360360.0_dp, 232792560.0_dp, n <= 8)
    do j = 1, n
      alpha(:, j) = [(multiple/real(i + j - 1, dp), i=1, n)]
    end do
    scene = from_answer('Hilbert matrix', merge('condition 1e10', 'condition 1e13', n <= 8), alpha, &
                        [(real(merge(0, 1 + mod(k, 3), mod(k, 4) == 3), dp), k=1, n)], &
                        [(merge(multiple, 0.0_dp, mod(k, 4) == 3), k=1, n)], multiple)
    scene%tolerance = REFINED*merge(1.0e10_dp, 1.0e13_dp, n <= 8)
  end function hilbert

  !> Rows of very different size, and datums far from the range of the numbers.
  pure function scaled(number) result(scene)
    integer, intent(in) :: number
    type(hard_scene) :: scene
    real(dp), parameter :: GAPS(3) = [0.0_dp, 0.125_dp, 0.125_dp], FAR = 2.0_dp**20
    real(dp) :: forces(3), difference, motion, alpha(3, 3)
    integer :: k

    select case (number)
    case (1)
      scene = bad_rows()
    case (2)
      alpha = 0.0_dp
      alpha(1, 1) = 1.0_dp
      alpha(2, 2) = 1.0e-11_dp
      alpha(3, 3) = 1.0e-11_dp
      scene = from_data('diag(1, 1e-11, 1e-11)', 'gaps that differ by 4e-12', alpha, &
                        [0.0_dp, 0.5_dp, 0.5_dp + 4.0e-12_dp], 1.5_dp)
      difference = (scene%gap(3) - scene%gap(2))/1.0e-11_dp
      forces(2) = (1.0_dp + difference)/(2.0_dp + 1.0e-11_dp)
      forces = [1.5_dp - forces(2) - (forces(2) - difference), forces(2), forces(2) - difference]
      call set_answer(scene, forces, 0.0_dp*GAPS, forces(1))
    case (3)
      alpha = 0.5_dp
      alpha(1, 1) = 2.0_dp**37 + 0.75_dp
      alpha(2, 2) = 1.25_dp
      alpha(3, 3) = 1.25_dp
      scene = from_data('one soft, deep point', 'a coefficient and a gap of 2**37', alpha, &
                        [-2.0_dp**35, 0.375_dp, 0.875_dp], 1.0_dp)
      forces(1) = 0.25_dp
      do k = 1, 3
        forces(2) = 0.5_dp*(1.0_dp - forces(1) + 2.0_dp/3.0_dp)
        motion = 0.375_dp + 0.75_dp*forces(2)
        forces(1) = 0.25_dp + (motion - 0.0625_dp)/(2.0_dp**37 + 0.25_dp)
      end do
      call set_answer(scene, [forces(1), forces(2), forces(2) - 2.0_dp/3.0_dp], 0.0_dp*GAPS, motion + 0.5_dp)
    case (4)
      scene = far_off('gaps + 1e3 of their range', 'datum of the gaps', 8, 0.0_dp, 1000.0_dp)
    case (5)
      scene = far_off('alpha + 1e6 of its range', 'datum of alpha', 8, FAR, 0.0_dp)
    case (6)
      scene = far_off('both, condition 1e6', 'datums over an ill-conditioned alpha', 20, -FAR, -1000.0_dp)
    case (7)
      scene = from_data('three points, gaps + 1e12', 'datum of the gaps', THREE, GAPS + 1.0e12_dp, 1.0_dp)
      call set_answer(scene, [52.0_dp, 21.0_dp, 47.0_dp]/120.0_dp, 0.0_dp*GAPS, 1.475_dp + 1.0e12_dp)
    case default
      scene = from_data('three points, alpha + 1e12', 'datum of alpha', THREE + 1.0e12_dp, GAPS, 1.0_dp)
      call set_answer(scene, [52.0_dp, 21.0_dp, 47.0_dp]/120.0_dp, 0.0_dp*GAPS, 1.475_dp + 1.0e12_dp)
    end select
  end function scaled

  !> S A S with a diagonal S from 1 to 2**15: the diagonal ranges over 9 decimal powers.
  pure function bad_rows() result(scene)
    type(hard_scene) :: scene
    integer, parameter :: N = 48
    real(dp) :: s(N)
    integer :: k

    s = [(scale(1.0_dp, mod(7*k, 16)), k=1, N)]
    scene = from_answer('badly scaled rows', 'diagonal from 1 to 2**30', &
                        spread(s, 1, N)*integer_bed(N, 16_int64)*spread(s, 2, N), &
                        [(real(merge(1 + mod(k, 4), 0, mod(k, 3) > 0), dp), k=1, N)]*32768.0_dp/s, &
                        [(real(merge(0, 1 + mod(k, 9), mod(k, 3) > 0), dp), k=1, N)]*32768.0_dp*s, 1.0_dp)
    scene%iterative = FUGE_WARN_RESIDUAL
  end function bad_rows

  !> Walsh functions with datums added to alpha and to the gaps, given as multiples of their range.
  pure function far_off(name, why, bits, on_alpha, on_gap) result(scene)
    character(len=*), intent(in) :: name, why
    integer, intent(in) :: bits
    real(dp), intent(in) :: on_alpha, on_gap
    type(hard_scene) :: scene, near
    real(dp) :: alpha_datum, gap_datum

    near = walsh(bits)
    alpha_datum = anint(on_alpha*(maxval(near%alpha) - minval(near%alpha)))
    gap_datum = anint(on_gap*(maxval(near%gap) - minval(near%gap)))
    scene = from_answer(name, why, near%alpha + alpha_datum, near%force, near%opening, &
                        near%approach + alpha_datum*near%load + gap_datum)
  end function far_off

  !> Loads far from the one that closes about half of the points.
  pure function loaded(number) result(scene)
    integer, intent(in) :: number
    type(hard_scene) :: scene
    integer :: decimals

    if (number == 6) then
      scene = from_data('two springs, load 1e-12', 'gaps of 1 and 0', &
                        reshape([1.0_dp, 0.0_dp, 0.0_dp, 1.0_dp], [2, 2]), [1.0_dp, 0.0_dp], 1.0e-12_dp)
      call set_answer(scene, [0.0_dp, 1.0e-12_dp], [1.0_dp - 1.0e-12_dp, 0.0_dp], 1.0e-12_dp)
    else
      decimals = 6*(number - 3)
      scene = bowl(30)
      scene%load = 10.0_dp**decimals
      scene%name = 'bowl, load 1e'//text(decimals)
      scene%why = 'load far from the natural one'
    end if
  end function loaded

  !> Other units, and the smallest size.
  pure function in_units(number) result(scene)
    integer, intent(in) :: number
    type(hard_scene) :: scene

    select case (number)
    case (1)
      scene = steel('steel in mm and N', 1.0e-3_dp)
    case (2)
      scene = steel('steel in m and N', 1.0_dp)
    case default
      scene = from_answer('one point', 'no choice', THREE(:1, :1), [2.0_dp], [0.0_dp], -44.0_dp)
    end select
  end function in_units

  !> Scenes for which pivoting methods take many steps.
  pure function many_pivots(number) result(scene)
    integer, intent(in) :: number
    type(hard_scene) :: scene
    integer :: k

    select case (number)
    case (1)
      scene = fathi(30, [(k, k=1, 30)])
    case (2)
      scene = fathi(30, [(k, k=30, 1, -1)])
      scene%name = 'Fathi, backwards'
    case (3)
      scene = fathi_with_stop(30)
    case (4)
      scene = rough(200, 0.02_dp)
    case default
      scene = rough(800, 0.01_dp)
      scene%large = .true.
    end select
  end function many_pivots

  !> Surfaces on a half-plane that are hard for methods made for smooth contacts.
  pure function on_halfplane(number) result(scene)
    integer, intent(in) :: number
    type(hard_scene) :: scene
    integer, parameter :: N = 160
    character(len=32), parameter :: NAMES(SURFACES) = [character(len=32) :: 'crests 4 cells apart', &
      'one open cell', 'two punches', 'white noise', 'steps', 'plateau', 'spike']
    character(len=40), parameter :: WHY(SURFACES) = [character(len=40) :: 'as many contact segments as crests', &
      'full contact but for a pit', 'far apart, one hardly loaded', 'no scale but that of the cells', &
      'singular edges', 'equal gaps', 'a cell that stands far out']

    scene = from_data(trim(NAMES(number)), trim(WHY(number)), &
                      halfplane(cell_middles(N, 1.0_dp/real(N, dp)), 1.0_dp/real(N, dp)), surface(number, N), &
                      surface_load(number))
    scene%tolerance = 1.0e-10_dp
    scene%most_sets = 30
    scene%most_pivots = 4
  end function on_halfplane

  !> The gaps of a surface over n cells of width 1/n.
  pure function surface(number, n) result(gap)
    integer, intent(in) :: number, n
    real(dp) :: gap(n)
    real(dp) :: x(n)
    integer(int64) :: seed

    x = cell_middles(n, 1.0_dp/real(n, dp))
    gap = 0.0_dp
    select case (number)
    case (1)
      gap = real(merge(0, 1, mod(nint(x*real(n, dp) + 0.5_dp*real(n, dp) + 0.5_dp), 4) < 2), dp)/real(n, dp)
    case (2)
      gap(n/3) = 1.0_dp
    case (3)
      gap = min((x + 0.4_dp)**2, (x - 0.4_dp)**2 + 0.0052_dp)
    case (4)
      seed = 18_int64
      call draw(seed, gap)
      gap = 0.01_dp*gap
    case (5)
      gap = 0.003_dp*real(mod(floor(10.0_dp*(x + 0.5_dp)), 4), dp)
    case (6)
      gap = max(0.0_dp, abs(x) - 0.2_dp)
    case default
      gap = x**2
      gap(n/3) = -0.2_dp
    end select
  end function surface

  !> The load that goes with a surface, for the plane modulus 1.
  pure function surface_load(number) result(load)
    integer, intent(in) :: number
    real(dp) :: load
    real(dp), parameter :: LOADS(SURFACES) = [0.02_dp, 1.0_dp, 0.002_dp, 0.005_dp, 0.005_dp, 0.1_dp, 0.2_dp]

    load = LOADS(number)
  end function surface_load

  !> Y. Fathi, Mathematical Programming 17 (1979): principal pivoting takes 2**n steps
  !> for w = U^T U z - 1, where U has 1 on the diagonal and 2 above it; z is the first unit vector.
  !> Here v_0 = 1 is part of the solution. `order` numbers the points.
  pure function fathi(n, order) result(scene)
    integer, intent(in) :: n, order(:)
    type(hard_scene) :: scene
    real(dp) :: alpha(n, n), force(n), opening(n)
    integer :: i, j

    do j = 1, n
      do i = 1, n
        alpha(i, j) = real(4*min(i, j) - merge(3, 2, i == j), dp)
      end do
    end do
    force = 0.0_dp
    force(1) = 1.0_dp
    opening = alpha(:, 1) - 1.0_dp
    scene = from_answer('Fathi', 'exponential for principal pivoting', alpha(order, order), force(order), &
                        opening(order), 1.0_dp)
  end function fathi

  !> Fathi's problem and one more point, which is stiff and carries most of the load: it fixes v_0, so that the
  !> others have Fathi's problem with a given approach.
  pure function fathi_with_stop(n) result(scene)
    integer, intent(in) :: n
    type(hard_scene) :: scene, free
    real(dp) :: alpha(n + 1, n + 1)
    integer :: k

    free = fathi(n, [(k, k=1, n)])
    alpha = 0.0_dp
    alpha(:n, :n) = scale(free%alpha, 20)
    alpha(n + 1, n + 1) = 1.0_dp
    scene = from_answer('Fathi beside a stop', 'the stop fixes v_0', alpha, [free%force, 1000.0_dp], &
                        [scale(free%opening, 20), 0.0_dp], scale(1.0_dp, 20))
  end function fathi_with_stop

  !> A self-affine profile (Hurst exponent 0.8) on a half-plane.
  pure function rough(n, load) result(scene)
    integer, intent(in) :: n
    real(dp), intent(in) :: load
    type(hard_scene) :: scene
    real(dp), parameter :: TWO_PI = 6.28318530717958648_dp
    real(dp) :: x(n), height(n), phase(n/4)
    integer(int64) :: seed
    integer :: k

    seed = 17_int64
    call draw(seed, phase)
    x = cell_middles(n, 1.0_dp/real(n, dp))
    height = 0.0_dp
    do k = 1, size(phase)
      height = height + 0.01_dp*real(k, dp)**(-1.3_dp)*cos(TWO_PI*(real(k, dp)*x + phase(k)))
    end do
    scene = from_data('rough profile', 'isolated contacts', halfplane(x, 1.0_dp/real(n, dp)), -height, load)
    scene%tolerance = 1.0e-10_dp
    scene%most_sets = 30
  end function rough

  !> A parabolic punch on a bed of springs that displace each other.
  pure function bowl(n) result(scene)
    integer, intent(in) :: n
    type(hard_scene) :: scene
    integer :: j

    scene = from_data('bowl', '', coupled_springs(n), &
                      [(0.02_dp*(real(j, dp) - 0.47_dp*real(n, dp))**2, j=1, n)], 1.0_dp)
  end function bowl

  !> A cylinder on a steel half-plane, 1e7 N per m; `metre` is the unit of length in m.
  pure function steel(name, metre) result(scene)
    character(len=*), intent(in) :: name
    real(dp), intent(in) :: metre
    type(hard_scene) :: scene
    integer, parameter :: N = 41
    real(dp), parameter :: CELL = 1.0e-5_dp, MODULUS = 2.2e11_dp, LOAD = 1.0e7_dp
    real(dp) :: alpha(N, N)
    type(fuge_info) :: info
    integer :: k

    call fuge_halfplane_matrix(cell_middles(N, CELL/metre), spread(CELL/metre, 1, N), MODULUS*metre**2, FUGE_MEAN, &
                               alpha, &
                               info)
    scene = from_data(name, 'alpha of 1e-12 or 1e-6 per unit', alpha, &
                      [(1.0e-6_dp/metre*(0.4_dp*real(k - 20, dp))**2, k=1, N)], LOAD*metre)
  end function steel

end module hard_scenes
