!> Random gaps with what presses the bodies together, by number, for solves to a wanted error.
module random_gaps
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_cell_elements, only: FUGE_PERIODIC
  use fuge_kinds, only: dp
  use fuge_pressing_type, only: fuge_pressing
  use gap_functions, only: gap_sum, gap_term, term, ALONG_X, ALONG_Y, BEYOND, COSINE, POWER, RADIAL, STEP
  use random_draws, only: chance, decimal, one_of, seed_of, uniform
  implicit none
  private

  public :: draw_area, draw_line, may_jump

  !> Families of profiles and of surfaces.
  character(len=*), parameter, public :: LINES(*) = [character(len=16) :: 'power', 'ripples', 'wedge', &
    'rounded flat', 'jumps', 'blunt wedge', 'rough', 'rough cylinder', 'piecewise linear'], &
    AREAS(*) = [character(len=16) :: 'paraboloid', 'cone', 'disc', 'rounded disc', 'waves', 'rough', 'roller', 'power']

contains

  !> Can the pressure be infinite at places that equal cells do not meet?
  pure function may_jump(family)
    character(len=*), intent(in) :: family
    logical :: may_jump

    may_jump = family == 'jumps'
  end function may_jump

  !> A profile on -1 .. 1.
  subroutine draw_line(number, family, gap, pressing)
    integer, intent(in) :: number
    character(len=*), intent(out) :: family
    type(gap_sum), intent(out) :: gap
    type(fuge_pressing), intent(out) :: pressing
    integer(int64) :: seed
    real(dp) :: place, load, position(1001), height(1001)
    integer :: k, status

    seed = seed_of(number)
    family = LINES(1 + modulo(number - 1, size(LINES)))
    gap%lower = [-1.0_dp, 0.0_dp]
    gap%upper = [1.0_dp, 0.0_dp]
    allocate (gap%terms(0))
    place = uniform(seed, -0.5_dp, 0.5_dp)
    load = decimal(seed, -2.5_dp, -0.3_dp)
    pressing%e_star = 1.0_dp
    pressing%accuracy = decimal(seed, -3.2_dp, -1.3_dp)
    select case (family)
    case ('power')
      call add(gap, term(POWER, decimal(seed, -0.5_dp, 0.5_dp), uniform(seed, 1.2_dp, 6.0_dp), place))
    case ('ripples')
      call add(gap, term(POWER, decimal(seed, -1.0_dp, 0.3_dp), 2.0_dp, place))
      do k = 1, one_of(seed, 3)
        call add(gap, term(COSINE, decimal(seed, -3.5_dp, -1.5_dp), uniform(seed, 0.03_dp, 0.5_dp), &
                           uniform(seed, -1.0_dp, 1.0_dp)))
      end do
    case ('wedge')
      call add(gap, term(POWER, decimal(seed, -1.0_dp, 0.3_dp), 1.0_dp, place))
      if (chance(seed, 0.5_dp)) call add(gap, term(POWER, decimal(seed, -1.0_dp, 0.0_dp), 2.0_dp, place))
    case ('rounded flat')
      call add(gap, term(BEYOND, decimal(seed, -0.5_dp, 2.0_dp), uniform(seed, 0.05_dp, 0.45_dp), place))
    case ('jumps')
      call add(gap, term(STEP, 10.0_dp, uniform(seed, 0.05_dp, 0.45_dp), place))
      if (chance(seed, 0.5_dp)) call add(gap, term(POWER, decimal(seed, -2.0_dp, 0.0_dp), 2.0_dp, &
                                                   uniform(seed, -0.5_dp, 0.5_dp)))
      if (chance(seed, 0.3_dp)) call add(gap, term(STEP, -10.0_dp, uniform(seed, 0.5_dp, 0.9_dp), place))
    case ('blunt wedge')
      call give_nodes(gap, [-1.0_dp, place - uniform(seed, 0.02_dp, 0.4_dp), place, 1.0_dp], spread(0.0_dp, 1, 4))
      gap%nodes(3) = place + uniform(seed, 0.02_dp, 0.4_dp)
      gap%values([1, 4]) = [decimal(seed, -1.0_dp, 0.3_dp), decimal(seed, -1.0_dp, 0.3_dp)]
    case ('piecewise linear')
      k = 4 + one_of(seed, 7)
      call draw_nodes(seed, k, gap)
    case default
      call draw_waves(seed, gap)
      if (family == 'rough cylinder') call add(gap, term(POWER, decimal(seed, -1.0_dp, 0.3_dp), 2.0_dp, place))
    end select
    position = [(-1.0_dp + 0.002_dp*real(k, dp), k=0, 1000)]
    call gap%evaluate(position, 0.0_dp*position, height, status)
    if (chance(seed, 0.3_dp) .and. any(family == ['ripples         ', 'rough           ', 'piecewise linear'])) then
      pressing%boundary = FUGE_PERIODIC
      if (family == 'ripples') gap%terms(1) = term(COSINE, -0.2_dp, 2.0_dp, place)
      if (family == 'piecewise linear') gap%values(size(gap%values)) = gap%values(1)
    else if (chance(seed, 0.15_dp)) then
      pressing%moment = load*(place + uniform(seed, -0.1_dp, 0.1_dp))
    else if (chance(seed, 0.2_dp)) then
      pressing%approach = minval(height) + 1.5_dp*load
      return
    end if
    pressing%load = load
  end subroutine draw_line

  !> A surface on -1 .. 1 and -1 .. 1.
  subroutine draw_area(number, family, gap, pressing)
    integer, intent(in) :: number
    character(len=*), intent(out) :: family
    type(gap_sum), intent(out) :: gap
    type(fuge_pressing), intent(out) :: pressing
    integer(int64) :: seed
    real(dp) :: x, y, load, size_of, angle
    integer :: k

    seed = seed_of(100000 + number)
    family = AREAS(1 + modulo(number - 1, size(AREAS)))
    gap%lower = -1.0_dp
    gap%upper = 1.0_dp
    allocate (gap%terms(0))
    x = uniform(seed, -0.3_dp, 0.3_dp)
    y = uniform(seed, -0.3_dp, 0.3_dp)
    load = decimal(seed, -2.5_dp, -0.7_dp)
    pressing%e_star = 1.0_dp
    pressing%accuracy = decimal(seed, -1.5_dp, -0.7_dp)
    size_of = uniform(seed, 0.15_dp, 0.6_dp)
    select case (family)
    case ('paraboloid')
      call add(gap, term(POWER, decimal(seed, -1.0_dp, 0.5_dp), 2.0_dp, x, y, ALONG_X))
      call add(gap, term(POWER, decimal(seed, -1.0_dp, 0.5_dp), 2.0_dp, x, y, ALONG_Y))
    case ('cone')
      call add(gap, term(POWER, decimal(seed, -1.0_dp, 0.3_dp), 1.0_dp, x, y, RADIAL))
    case ('disc')
      call add(gap, term(STEP, 10.0_dp, size_of, x, y, RADIAL))
      if (chance(seed, 0.3_dp)) call add(gap, term(POWER, 0.1_dp, 2.0_dp, 0.0_dp, 0.0_dp, RADIAL))
    case ('rounded disc')
      call add(gap, term(BEYOND, decimal(seed, -0.5_dp, 1.0_dp), size_of, x, y, RADIAL))
    case ('waves')
      call add(gap, term(COSINE, decimal(seed, -2.0_dp, -0.5_dp), 2.0_dp/real(one_of(seed, 4), dp), x, y, ALONG_X))
      call add(gap, term(COSINE, decimal(seed, -2.0_dp, -0.5_dp), 2.0_dp/real(one_of(seed, 4), dp), x, y, ALONG_Y))
      if (chance(seed, 0.5_dp)) pressing%boundary = FUGE_PERIODIC
    case ('rough')
      call add(gap, term(POWER, 0.3_dp, 2.0_dp, x, y, RADIAL))
      do k = 1, 20
        angle = uniform(seed, 0.0_dp, 6.2831853_dp)
        call add(gap, term(COSINE, 0.01_dp*real(k, dp)**(-1.2_dp), 0.8_dp/real(k, dp), 50.0_dp*cos(angle), &
                           50.0_dp*sin(angle), RADIAL))
      end do
    case ('roller')
      call add(gap, term(POWER, decimal(seed, -0.5_dp, 0.5_dp), 2.0_dp, x, y, ALONG_X))
      call add(gap, term(STEP, 10.0_dp, size_of, x, y, ALONG_Y))
    case default
      call add(gap, term(POWER, decimal(seed, -0.5_dp, 0.5_dp), uniform(seed, 1.5_dp, 5.0_dp), x, y, RADIAL))
    end select
    pressing%load = load
  end subroutine draw_area

  subroutine add(gap, next)
    type(gap_sum), intent(inout) :: gap
    type(gap_term), intent(in) :: next

    gap%terms = [gap%terms, next]
  end subroutine add

  subroutine give_nodes(gap, nodes, values)
    type(gap_sum), intent(inout) :: gap
    real(dp), intent(in) :: nodes(:), values(:)

    allocate (gap%nodes, source=nodes)
    allocate (gap%values, source=values)
  end subroutine give_nodes

  !> `k` nodes from -1 to 1 that are not too close, with random values.
  subroutine draw_nodes(seed, k, gap)
    integer(int64), intent(inout) :: seed
    integer, intent(in) :: k
    type(gap_sum), intent(inout) :: gap
    real(dp) :: nodes(k), values(k)
    integer :: j

    do j = 1, k
      nodes(j) = -1.0_dp + 2.0_dp*real(j - 1, dp)/real(k - 1, dp)
      if (j > 1 .and. j < k) nodes(j) = nodes(j) + uniform(seed, -0.8_dp, 0.8_dp)/real(k - 1, dp)
      values(j) = uniform(seed, 0.0_dp, 0.2_dp)
    end do
    call give_nodes(gap, nodes, values)
  end subroutine draw_nodes

  !> A self-affine profile without waves shorter than the 8th to the 60th part of a unit.
  subroutine draw_waves(seed, gap)
    integer(int64), intent(inout) :: seed
    type(gap_sum), intent(inout) :: gap
    complex(dp) :: waves(60)
    real(dp) :: exponent_of, height, phase
    integer :: k, shortest

    exponent_of = uniform(seed, 0.9_dp, 1.5_dp)
    height = decimal(seed, -2.7_dp, -1.0_dp)
    shortest = 7 + one_of(seed, 53)
    waves = 0.0_dp
    do k = 1, shortest
      phase = uniform(seed, 0.0_dp, 6.2831853_dp)
      waves(k) = height*real(k, dp)**(-exponent_of)*cmplx(cos(phase), sin(phase), dp)
    end do
    allocate (gap%waves, source=waves(:shortest))
  end subroutine draw_waves

end module random_gaps
