!> Random contact problems whose data and whose answer are whole numbers times powers of two, so that the answer is
!> exact for the data as stored: gaps and resultants are computed from it in integers.
!>
!> alpha = L D L^T with whole numbers in the triangle L, that of a condition number up to 1e18, on scales of points that
!> are powers of two. All kinds of problems: up to two motions, some prescribed, some on springs; play, ties,
!> exclusions, compliances and limits; points on the border of two states.
module whole_number_problems
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_kinds, only: dp
  use fuge_lapack, only: dsyev
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use special_numbers, only: infinity
  use random_draws, only: chance, one_of, seed_of, uniform
  implicit none
  private

  public :: draw_whole_problem

  integer, parameter :: MOST_POINTS = 8
  !> Whole numbers up to this one are exact as reals.
  integer(int64), parameter :: LARGEST = 2_int64**53

  type, public :: whole_problem
    real(dp), allocatable :: alpha(:, :)
    type(fuge_problem) :: problem
    type(fuge_solution) :: answer
    !> The condition number of L D L^T, 1e17 if it is not below that.
    real(dp) :: condition = 1.0_dp
    !> Is any point on the border of two states?
    logical :: is_tied = .false.
    !> Do points that are not hold all motions, so that the answer is the only one?
    logical :: is_held = .true.
  end type whole_problem

  !> The numbers, before they are scaled.
  type :: whole_numbers
    integer :: n = 0, m = 0
    integer(int64) :: alpha(MOST_POINTS, MOST_POINTS) = 0
    integer(int64), dimension(MOST_POINTS) :: force = 0, opening = 0, play = -1, compliance = 0, limit = -1, &
                                              limit_upper = -1, gap = 0
    integer(int64) :: modes(MOST_POINTS, 2) = 0
    integer(int64), dimension(2) :: motion = 0, stiffness = 0, resultant = 0
    logical :: excluded(MOST_POINTS) = .false., prescribed(2) = .false., strict(MOST_POINTS) = .false.
    logical :: is_tied = .false.
    real(dp) :: condition = 1.0_dp
  end type whole_numbers

contains

  !> Problem `number`; with `ties` some points are on the border of two states.
  subroutine draw_whole_problem(number, ties, whole)
    integer, intent(in) :: number
    logical, intent(in) :: ties
    type(whole_problem), intent(out) :: whole
    type(whole_numbers) :: numbers
    integer(int64) :: seed
    logical :: fits

    seed = seed_of(number)
    fits = .false.
    do while (.not. fits)
      numbers = whole_numbers()
      numbers%n = one_of(seed, MOST_POINTS)
      numbers%m = min(one_of(seed, 3) - 1, numbers%n)
      call draw_matrix(seed, numbers)
      numbers%condition = condition_of(numbers)
      call draw_motions(seed, numbers)
      call draw_states(seed, ties, numbers)
      call complete(numbers, fits)
    end do
    call scale_numbers(seed, numbers, whole)
  end subroutine draw_whole_problem

  !> The condition number of alpha.
  function condition_of(numbers) result(condition)
    type(whole_numbers), intent(in) :: numbers
    real(dp) :: condition
    real(dp) :: matrix(numbers%n, numbers%n), values(numbers%n), work(8*MOST_POINTS)
    integer :: info

    matrix = real(numbers%alpha(:numbers%n, :numbers%n), dp)
    call dsyev('N', 'L', numbers%n, matrix, numbers%n, values, work, size(work), info)
    condition = 1.0e17_dp
    if (info == 0 .and. values(1) > 1.0e-17_dp*values(numbers%n)) condition = values(numbers%n)/values(1)
  end function condition_of

  !> alpha = L D L^T, less a datum where a translation is free and not on a spring: it is so by half.
  subroutine draw_matrix(seed, numbers)
    integer(int64), intent(inout) :: seed
    type(whole_numbers), intent(inout) :: numbers
    integer(int64) :: lower(MOST_POINTS, MOST_POINTS), diagonal(MOST_POINTS), most
    integer :: i, j, k

    most = 4_int64**(one_of(seed, 5) - 1) - 1
    lower = 0
    diagonal = 1
    do j = 1, numbers%n
      lower(j, j) = 1
      diagonal(j) = one_of(seed, 4)
      do i = j + 1, numbers%n
        lower(i, j) = nint(uniform(seed, -real(most, dp), real(most, dp)), int64)
      end do
    end do
    do i = 1, numbers%n
      do j = 1, numbers%n
        do k = 1, min(i, j)
          numbers%alpha(i, j) = numbers%alpha(i, j) + lower(i, k)*diagonal(k)*lower(j, k)
        end do
      end do
    end do
  end subroutine draw_matrix

  subroutine draw_motions(seed, numbers)
    integer(int64), intent(inout) :: seed
    type(whole_numbers), intent(inout) :: numbers
    integer :: j, k

    do j = 1, numbers%m
      numbers%prescribed(j) = chance(seed, 0.2_dp)
      numbers%motion(j) = one_of(seed, 400) - 200
      if (chance(seed, 0.2_dp)) numbers%stiffness(j) = one_of(seed, 9)
      do k = 1, numbers%n
        numbers%modes(k, j) = 1
        if (j == 2) numbers%modes(k, j) = 2*k - numbers%n
      end do
    end do
    if (numbers%m < 1) return
    if (numbers%prescribed(1) .or. numbers%stiffness(1) > 0) return
    if (chance(seed, 0.5_dp)) numbers%alpha = numbers%alpha - one_of(seed, 100)
  end subroutine draw_motions

  !> The law and the state of each point.
  subroutine draw_states(seed, ties, numbers)
    integer(int64), intent(inout) :: seed
    logical, intent(in) :: ties
    type(whole_numbers), intent(inout) :: numbers
    logical :: general
    integer :: k

    general = chance(seed, 0.5_dp)
    do k = 1, numbers%n
      if (general) call draw_law(seed, k, numbers)
      call draw_state(seed, k, numbers)
      if (.not. ties) cycle
      if (chance(seed, 0.4_dp)) call put_on_border(seed, k, numbers)
    end do
  end subroutine draw_states

  subroutine draw_law(seed, k, numbers)
    integer(int64), intent(inout) :: seed
    integer, intent(in) :: k
    type(whole_numbers), intent(inout) :: numbers

    if (chance(seed, 0.4_dp)) numbers%play(k) = one_of(seed, 50) - 1
    if (chance(seed, 0.1_dp)) numbers%play(k) = 0
    if (chance(seed, 0.3_dp)) numbers%compliance(k) = one_of(seed, 1000)
    if (chance(seed, 0.3_dp)) numbers%limit(k) = one_of(seed, 60) - 1
    if (chance(seed, 0.3_dp)) numbers%limit_upper(k) = one_of(seed, 60) - 1
    numbers%excluded(k) = chance(seed, 0.05_dp)
  end subroutine draw_law

  !> A force, and how far the point is open from its lower stop.
  subroutine draw_state(seed, k, numbers)
    integer(int64), intent(inout) :: seed
    integer, intent(in) :: k
    type(whole_numbers), intent(inout) :: numbers
    integer(int64) :: least, most

    most = 1000
    if (numbers%limit(k) >= 0) most = numbers%limit(k)
    least = 0
    if (numbers%play(k) >= 0) least = -1000
    if (numbers%play(k) >= 0 .and. numbers%limit_upper(k) >= 0) least = -numbers%limit_upper(k)
    if (numbers%excluded(k)) then
      numbers%opening(k) = one_of(seed, 400) - 200
    else if (chance(seed, 0.6_dp)) then
      numbers%force(k) = one_of(seed, 999)
      if (least < 0) then
        if (chance(seed, 0.5_dp)) numbers%force(k) = -numbers%force(k)
      end if
      if (numbers%force(k) < 0) numbers%opening(k) = numbers%play(k)
      numbers%strict(k) = numbers%force(k) > least .and. numbers%force(k) < most
      if (numbers%strict(k)) return
      ! The force has reached its limit, and the gap goes on beyond the stop.
      numbers%force(k) = min(max(numbers%force(k), least), most)
      numbers%opening(k) = numbers%opening(k) - sign(one_of(seed, 50), merge(1, -1, numbers%opening(k) == 0))
      if (numbers%play(k) == 0) numbers%opening(k) = -sign(one_of(seed, 50), merge(1, -1, numbers%force(k) == most))
    else if (numbers%play(k) < 0) then
      numbers%opening(k) = one_of(seed, 200)
    else if (numbers%play(k) > 1) then
      numbers%opening(k) = one_of(seed, int(numbers%play(k)) - 1)
    else
      call put_on_border(seed, k, numbers)
    end if
  end subroutine draw_state

  !> No force at the lower stop, or at one that has a limit by chance this limit. That is the border of two states,
  !> unless the point is tied and its force is free.
  subroutine put_on_border(seed, k, numbers)
    integer(int64), intent(inout) :: seed
    integer, intent(in) :: k
    type(whole_numbers), intent(inout) :: numbers
    logical :: at_limit

    numbers%force(k) = 0
    numbers%opening(k) = 0
    at_limit = chance(seed, 0.5_dp)
    numbers%strict(k) = numbers%play(k) == 0 .and. numbers%limit(k) /= 0 .and. numbers%limit_upper(k) /= 0 &
                        .and. .not. numbers%excluded(k)
    if (at_limit .and. numbers%limit(k) > 0 .and. .not. numbers%excluded(k)) then
      numbers%force(k) = numbers%limit(k)
      numbers%strict(k) = .false.
    else if (at_limit .and. numbers%play(k) >= 0 .and. numbers%limit_upper(k) > 0 .and. .not. numbers%excluded(k)) then
      numbers%force(k) = -numbers%limit_upper(k)
      numbers%opening(k) = numbers%play(k)
      numbers%strict(k) = .false.
    end if
    numbers%is_tied = numbers%is_tied .or. .not. (numbers%strict(k) .or. numbers%excluded(k))
  end subroutine put_on_border

  !> Gaps and resultants from the answer. `fits`: all numbers are exact as reals.
  pure subroutine complete(numbers, fits)
    type(whole_numbers), intent(inout) :: numbers
    logical, intent(out) :: fits
    integer(int64) :: displacement, terms
    integer :: j, k

    fits = maxval(abs(numbers%alpha)) < LARGEST/2**20
    if (.not. fits) return
    do k = 1, numbers%n
      displacement = sum(numbers%alpha(k, :)*numbers%force) + numbers%compliance(k)*numbers%force(k) &
                     - sum(numbers%modes(k, :)*numbers%motion)
      terms = sum(abs(numbers%alpha(k, :)*numbers%force))
      fits = fits .and. terms < LARGEST
      numbers%gap(k) = numbers%opening(k) - displacement
    end do
    do j = 1, numbers%m
      numbers%resultant(j) = sum(numbers%modes(:, j)*numbers%force)
      if (.not. numbers%prescribed(j)) numbers%resultant(j) = numbers%resultant(j) &
                                                              + numbers%stiffness(j)*numbers%motion(j)
    end do
  end subroutine complete

  !> The problem on scales of points, motions and everything that are powers of two.
  subroutine scale_numbers(seed, numbers, whole)
    integer(int64), intent(inout) :: seed
    type(whole_numbers), intent(in) :: numbers
    type(whole_problem), intent(inout) :: whole
    integer :: points(numbers%n), motions(numbers%m)
    integer :: force_unit, length_unit

    points = 0
    motions = 0
    force_unit = 0
    length_unit = 0
    if (chance(seed, 0.3_dp)) then
      force_unit = one_of(seed, 160) - 80
      length_unit = one_of(seed, 160) - 80
    end if
    call fill_scales(seed, points, motions)
    call fill_problem(numbers, points, motions, [force_unit, length_unit], whole)
    whole%condition = numbers%condition
    whole%is_tied = numbers%is_tied
    whole%is_held = holds(numbers)
  end subroutine scale_numbers

  !> By chance each point has a scale of its own, and each motion.
  subroutine fill_scales(seed, points, motions)
    integer(int64), intent(inout) :: seed
    integer, intent(inout) :: points(:), motions(:)
    integer :: k

    if (chance(seed, 0.7_dp)) return
    do k = 1, size(points)
      points(k) = one_of(seed, 21) - 11
    end do
    do k = 1, size(motions)
      motions(k) = one_of(seed, 41) - 21
    end do
  end subroutine fill_scales

  !> Point k with scale s_k: alpha_ij 2**(s_i + s_j), forces 2**(-s_k), lengths 2**s_k.
  subroutine fill_problem(numbers, points, motions, units, whole)
    type(whole_numbers), intent(in) :: numbers
    integer, intent(in) :: points(:), motions(:), units(2)
    type(whole_problem), intent(inout) :: whole
    integer :: force(size(points)), j, length(size(points)), m, n

    n = numbers%n
    m = numbers%m
    force = units(1) - points
    length = units(2) + points
    allocate (whole%alpha(n, n), whole%problem%modes(n, m))
    do j = 1, n
      whole%alpha(:, j) = scale(real(numbers%alpha(:n, j), dp), length - force(j))
    end do
    do j = 1, m
      whole%problem%modes(:, j) = scale(real(numbers%modes(:n, j), dp), points + motions(j))
    end do
    associate (p => whole%problem, a => whole%answer)
      p%gap = scale(real(numbers%gap(:n), dp), length)
      p%resultant = scale(real(numbers%resultant(:m), dp), motions + units(1))
      p%motion = scale(real(numbers%motion(:m), dp), units(2) - motions)
      p%prescribed = numbers%prescribed(:m)
      p%excluded = numbers%excluded(:n)
      p%gap_upper = scaled_or_infinite(numbers%play(:n), length)
      p%limit = scaled_or_infinite(numbers%limit(:n), force)
      p%limit_upper = scaled_or_infinite(numbers%limit_upper(:n), force)
      p%compliance = scale(real(numbers%compliance(:n), dp), length - force)
      p%motion_stiffness = scale(real(numbers%stiffness(:m), dp), 2*motions + units(1) - units(2))
      a%force = scale(real(numbers%force(:n), dp), force)
      a%gap = scale(real(numbers%opening(:n), dp), length)
      a%motion = p%motion
    end associate
  end subroutine fill_problem

  !> A negative number stands for infinity.
  elemental function scaled_or_infinite(number, power) result(value)
    integer(int64), intent(in) :: number
    integer, intent(in) :: power
    real(dp) :: value

    value = infinity()
    if (number >= 0) value = scale(real(number, dp), power)
  end function scaled_or_infinite

  !> Do points with a force inside of its range hold all free motions that are not on springs?
  pure function holds(numbers)
    type(whole_numbers), intent(in) :: numbers
    logical :: holds
    logical :: free(2)

    free = .not. numbers%prescribed .and. numbers%stiffness == 0
    free(numbers%m + 1:) = .false.
    holds = count(numbers%strict(:numbers%n)) >= count(free)
    if (count(free) == 1 .and. free(2)) holds = any(numbers%strict .and. numbers%modes(:, 2) /= 0)
  end function holds

end module whole_number_problems
