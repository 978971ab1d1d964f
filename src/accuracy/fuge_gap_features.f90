!> Kinks and jumps of a gap function along a line, where cells have to end.
module fuge_gap_features
  use fuge_gap_function_type, only: fuge_gap_function, sample_gap
  use fuge_kinds, only: dp
  use fuge_marked_runs, only: next_run
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: find_features, gap_feature, FIRST_SAMPLES

  !> More than so many are taken for roughness, for which equal cells are better.
  integer, parameter :: MOST_FEATURES = 16
  !> Intervals of the first look, and how many side by side that are not smooth belong to one feature.
  integer, parameter :: INTERVALS = 256, LONGEST_RUN = 3
  !> Samples of the first look, from one end to the other.
  integer, parameter :: FIRST_SAMPLES = 2*INTERVALS + 1
  !> Where a cubic through four samples misses the middle by more than this share of what a straight line misses, the
  !> gap is not smooth there: for a smooth one the share falls with the square of the distance of the samples.
  real(dp), parameter :: NOT_SMOOTH = 0.05_dp
  !> What is less than this part of all differences of the gap is rounding.
  real(dp), parameter :: ROUNDING = 1.0e-9_dp
  !> A place is known well enough at this part of the interval.
  real(dp), parameter :: RESOLUTION = 1.0e-14_dp
  !> Largest distance, as part of the interval, of the three samples that tell a kink from a jump and from a bend, and
  !> how much less the second and the third are.
  real(dp), parameter :: TEST_DISTANCE = 1.0e-4_dp, TEST_STEP = 16.0_dp

  !> A place where the gap function is not smooth.
  type :: gap_feature
    real(dp) :: place = 0.0_dp
    !> Does the gap jump? Otherwise it has a kink.
    logical :: jumps = .false.
  end type gap_feature

contains

  !> The features between `left` and `right`, ascending, unless the gap `is_rough`: not smooth in more than
  !> MOST_FEATURES places. A feature that changes the gap at none of the first samples, whose heights are `height`, may
  !> be overlooked. Errors: those of `sample_gap`.
  subroutine find_features(gap, left, right, features, is_rough, height, info)
    class(fuge_gap_function), intent(in) :: gap
    real(dp), intent(in) :: left, right
    type(gap_feature), allocatable, intent(out) :: features(:)
    logical, intent(out) :: is_rough
    real(dp), intent(out) :: height(0:FIRST_SAMPLES - 1)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: x(:)
    real(dp) :: range
    logical :: suspect(INTERVALS)
    integer :: first, last, k

    allocate (features(0))
    is_rough = .false.
    allocate (x(0:2*INTERVALS))
    do k = 0, 2*INTERVALS
      x(k) = left + (right - left)*(real(k, dp)/real(2*INTERVALS, dp))
    end do
    x(2*INTERVALS) = right
    call sample_gap(gap, x, 0.0_dp*x, height, info)
    if (info%failed()) return
    range = maxval(height) - minval(height)
    suspect = misses_of_cubics(height, range)
    is_rough = count(suspect .and. .not. [.false., suspect(:INTERVALS - 1)]) > MOST_FEATURES
    if (is_rough) return
    call next_run(suspect, 1, first, last)
    do while (first <= INTERVALS)
      last = min(last, first + LONGEST_RUN - 1)
      call add_features(gap, [x(2*max(first - 2, 0)), x(2*min(last + 1, INTERVALS))], [left, right], range, features, &
                        info)
      if (info%failed()) return
      call next_run(suspect, last + 1, first, last)
    end do
    is_rough = size(features) > MOST_FEATURES
  end subroutine find_features

  !> In which intervals, (INTERVALS), does the cubic through the nearest four ends miss the `height` in the middle by
  !> too much? `height` has ends and middles in turn.
  pure function misses_of_cubics(height, range) result(misses)
    real(dp), intent(in) :: height(0:), range
    logical :: misses(INTERVALS)
    real(dp) :: ends(0:INTERVALS), middle(INTERVALS), straight(INTERVALS), cubic
    integer :: k

    ends = height(0::2)
    middle = height(1::2)
    straight = abs(0.5_dp*(ends(:INTERVALS - 1) + ends(1:)) - middle)
    misses = .false.
    do k = 2, INTERVALS - 1
      cubic = abs((9.0_dp*(ends(k - 1) + ends(k)) - ends(k - 2) - ends(k + 1))/16.0_dp - middle(k))
      misses(k) = cubic > NOT_SMOOTH*maxval(straight(max(1, k - 2):min(INTERVALS, k + 2))) .and. cubic > ROUNDING*range
    end do
  end function misses_of_cubics

  !> Add the feature in `bracket`, and those on both sides of it: a tooth has two jumps. Errors: those of the gap
  !> function.
  subroutine add_features(gap, bracket, ends, range, features, info)
    class(fuge_gap_function), intent(in) :: gap
    real(dp), intent(in) :: bracket(2), ends(2), range
    type(gap_feature), allocatable, intent(inout) :: features(:)
    type(fuge_info), intent(inout) :: info
    type(gap_feature) :: feature
    real(dp) :: sides(2, 3), apart
    logical :: found
    integer :: k

    apart = 2.0_dp*TEST_DISTANCE*(ends(2) - ends(1))
    sides(:, 1) = bracket
    do k = 1, 3
      if (.not. sides(2, k) - sides(1, k) > apart) cycle
      call locate(gap, sides(:, k), ends, range, feature, found, info)
      if (info%failed()) return
      if (k == 1) then
        if (.not. found) return
        sides(:, 2) = [bracket(1), feature%place - apart]
        sides(:, 3) = [feature%place + apart, bracket(2)]
      end if
      if (found) found = .not. any(abs(features%place - feature%place) <= apart)
      if (found) features = [pack(features, features%place < feature%place), feature, &
                             pack(features, features%place > feature%place)]
    end do
  end subroutine add_features

  !> Narrow `bracket` down to where the second difference of the gap is largest, and see what is there.
  subroutine locate(gap, bracket, ends, range, feature, found, info)
    class(fuge_gap_function), intent(in) :: gap
    real(dp), intent(in) :: bracket(2), ends(2), range
    type(gap_feature), intent(out) :: feature
    logical, intent(out) :: found
    type(fuge_info), intent(inout) :: info
    integer, parameter :: STEPS = 8
    real(dp) :: x(0:STEPS), height(0:STEPS), bend(STEPS - 1), a, b
    integer :: j, k

    found = .false.
    a = bracket(1)
    b = bracket(2)
    do while (b - a > RESOLUTION*(ends(2) - ends(1)) .and. b - a > 32.0_dp*spacing(max(abs(a), abs(b))))
      x = [(a + (b - a)*(real(j, dp)/real(STEPS, dp)), j=0, STEPS)]
      call sample_gap(gap, x, 0.0_dp*x, height, info)
      if (info%failed()) return
      bend = abs(height(:STEPS - 2) - 2.0_dp*height(1:STEPS - 1) + height(2:))
      if (.not. maxval(bend) > 4.0_dp*epsilon(1.0_dp)*maxval(abs(height))) exit
      k = maxloc(bend, dim=1)
      a = x(k - 1)
      b = x(k + 1)
    end do
    feature%place = 0.5_dp*(a + b)
    call judge(gap, ends, range, feature, found, info)
  end subroutine locate

  !> How second differences at the place shrink with the distance: not for a jump, in proportion for a kink, with the
  !> square where it is smooth.
  subroutine judge(gap, ends, range, feature, found, info)
    class(fuge_gap_function), intent(in) :: gap
    real(dp), intent(in) :: ends(2), range
    type(gap_feature), intent(inout) :: feature
    logical, intent(out) :: found
    type(fuge_info), intent(inout) :: info
    real(dp) :: x(3, 3), height(9), bend(3), distance
    integer :: k

    found = .false.
    distance = TEST_DISTANCE*(ends(2) - ends(1))
    if (feature%place - distance < ends(1) .or. feature%place + distance > ends(2)) return
    do k = 1, 3
      x(:, k) = feature%place + distance*[-1.0_dp, 0.0_dp, 1.0_dp]
      distance = distance/TEST_STEP
    end do
    call sample_gap(gap, reshape(x, [9]), spread(0.0_dp, 1, 9), height, info)
    if (info%failed()) return
    bend = abs(height(1::3) - 2.0_dp*height(2::3) + height(3::3))
    feature%jumps = bend(1) < 4.0_dp*bend(3) .and. bend(3) > ROUNDING*range
    found = feature%jumps .or. (bend(1) < 8.0_dp*TEST_STEP**2*bend(3) &
                                .and. bend(3) > max(1.0e-4_dp*ROUNDING*range, &
                                                    64.0_dp*epsilon(1.0_dp)*maxval(abs(height))))
  end subroutine judge

end module fuge_gap_features
