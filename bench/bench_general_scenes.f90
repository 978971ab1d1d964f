!> The general scenes on the areas of the benchmark: two tilts, a hardness that 30 % of the load would reach, half of
!> the points excluded, play, a spring on the motion; each beside the plain scene, one translation under a load.
module bench_general_scenes
  use bench_surfaces, only: bench_surface
  use fuge, only: dp => fuge_dp, fuge_problem
  implicit none
  private

  public :: problem_of

  character(len=10), parameter, public :: SURFACES(2) = ['sphere    ', 'heavy_area']
  character(len=24), parameter, public :: SCENES(6) = [character(len=24) :: 'plain', 'two tilts', 'hardness, 30 %', &
    'half the points excluded', 'play', 'spring on the motion']
  integer, parameter, public :: PLAIN = 1
  integer, parameter :: TILTS = 2, HARDNESS = 3, EXCLUDED = 4, PLAY = 5, SPRING = 6
  !> The mean pressure over the hardness.
  real(dp), parameter :: SATURATION = 0.3_dp
  !> Squares of a chessboard along a side, those of one colour excluded.
  integer, parameter :: SQUARES = 32
  !> The load stands beside the middle by this fraction of the side.
  real(dp), parameter :: ARM = 0.02_dp
  !> The play over the largest gap: some points are at the upper stop then.
  real(dp), parameter :: PLAY_SHARE = 0.6_dp, PLAY_SHARE_OF_ROUGH = 0.1_dp
  !> The spring takes as much as the contact at this fraction of the largest gap.
  real(dp), parameter :: SPRING_SHARE = 0.5_dp

contains

  !> Scene number `scene` of a surface.
  function problem_of(surface, scene) result(problem)
    type(bench_surface), intent(in) :: surface
    integer, intent(in) :: scene
    type(fuge_problem) :: problem
    real(dp) :: largest
    integer :: i, n

    problem = surface%contact()
    n = surface%n
    largest = maxval(surface%gap)
    select case (scene)
    case (TILTS)
      allocate (problem%modes(n*n, 3))
      problem%modes(:, 1) = 1.0_dp
      problem%modes(:, 2) = [((real(2*modulo(i - 1, n) - n + 1, dp)/real(2*n, dp))*surface%side, i=1, n*n)]
      problem%modes(:, 3) = [((real(2*((i - 1)/n) - n + 1, dp)/real(2*n, dp))*surface%side, i=1, n*n)]
      problem%resultant = surface%load*[1.0_dp, ARM*surface%side, 0.5_dp*ARM*surface%side]
    case (HARDNESS)
      allocate (problem%limit(n*n), source=limit_of(surface))
    case (EXCLUDED)
      allocate (problem%excluded(n*n))
      problem%excluded = [(modulo((modulo(i - 1, n)*SQUARES)/n + (((i - 1)/n)*SQUARES)/n, 2) == 1, i=1, n*n)]
    case (PLAY)
      allocate (problem%gap_upper(n*n), &
                source=largest*merge(PLAY_SHARE, PLAY_SHARE_OF_ROUGH, surface%contact_radius > 0.0_dp))
    case (SPRING)
      problem%motion_stiffness = [surface%load/(SPRING_SHARE*largest)]
      problem%resultant = 2.0_dp*problem%resultant
    end select
  end function problem_of

  !> The largest force of a cell: its share of the load where all cells carry it, over the saturation. On the sphere all
  !> cells of the contact carry it, and 1.2 times the mean is the limit, because Hertz's pressure is at most 1.5 times
  !> it.
  pure function limit_of(surface) result(limit)
    type(bench_surface), intent(in) :: surface
    real(dp) :: limit
    real(dp) :: area

    area = SATURATION*surface%side**2
    if (surface%contact_radius > 0.0_dp) area = acos(-1.0_dp)*surface%contact_radius**2/1.2_dp
    limit = surface%load*surface%cell()**2/area
  end function limit_of

end module bench_general_scenes
