!> A round and smooth body in one disc of contact: by a series, without a grid.
module fuge_round_series
  use fuge_cell_elements, only: FUGE_FREE
  use fuge_constants, only: PI
  use fuge_gap_function_type, only: fuge_gap_function, sample_gap, sample_grid
  use fuge_kinds, only: dp
  use fuge_line_series, only: sample_series
  use fuge_pressing_type, only: fuge_pressing
  use fuge_resolved_contact_type, only: fuge_resolved_contact, FUGE_BY_SERIES
  use fuge_round_contact_type, only: fuge_round_contact
  use fuge_round_punch, only: fuge_solve_round_punch
  use fuge_smooth_profile_type, only: fuge_sampled_profile
  use fuge_status, only: fuge_info, FUGE_DONE
  implicit none
  private

  public :: give_round_series, solve_by_round_series

  !> Places at which the gap is looked at first, in each direction; odd, so that the middle is one of them.
  integer, parameter :: LOOKS = 65
  !> Steps of the search for the axis, each with differences over this part of the one before.
  integer, parameter :: AXIS_STEPS = 4
  real(dp), parameter :: SMALLER = 0.1_dp
  !> Where the profile is taken: along no line of symmetry that a body on a rectangle may have.
  real(dp), parameter :: DIRECTION(2) = [cos(1.3_dp), sin(1.3_dp)]
  !> A gap is round if it differs, round the axis, by no more than this part of the wanted error of how far it rises.
  real(dp), parameter :: PART_OF_ACCURACY = 1.0e-3_dp
  !> Longest series of the profile that is tried.
  integer, parameter :: LONGEST = 64
  !> No relative error is less.
  real(dp), parameter :: LEAST_ERROR = 1.0e-13_dp
  !> What of the gap is rounding of the series.
  real(dp), parameter :: SAME = 1.0e-11_dp
  !> A profile with more slope on its axis than this part of its mean one has a tip.
  real(dp), parameter :: NO_TIP = 1.0e-6_dp
  !> Cells of the result along the shorter side, and how many of them are in contact at least, if they are not too many.
  integer, parameter :: FEWEST_CELLS = 64, MOST_CELLS = 512, IN_CONTACT = 32
  !> Pressures are taken from a table over the square of the radius, and a cell at the rim of the contact has so many
  !> samples in each direction, another one two.
  integer, parameter :: TABLE = 1024, RIM_SAMPLES = 8

contains

  !> Try a series; `found` unless the gap is not round and smooth, or the contact not one disc inside the rectangle.
  !> `axis` (2), length. Errors: those of the gap function.
  subroutine solve_by_round_series(gap, lower, upper, pressing, axis, series, found, info)
    class(fuge_gap_function), intent(in) :: gap
    real(dp), intent(in) :: lower(2), upper(2)
    type(fuge_pressing), intent(in) :: pressing
    real(dp), intent(out) :: axis(2)
    type(fuge_round_contact), intent(inout) :: series
    logical, intent(out) :: found
    type(fuge_info), intent(inout) :: info
    type(fuge_sampled_profile) :: profile
    type(fuge_info) :: attempt
    real(dp) :: reach, lowest_outside
    real(dp) :: x(LOOKS), y(LOOKS)
    real(dp), allocatable :: height(:)
    integer :: j, place

    found = .false.
    axis = 0.0_dp
    if (pressing%boundary /= FUGE_FREE .or. allocated(pressing%layers)) return
    x = [(lower(1) + (upper(1) - lower(1))*(real(j, dp)/real(LOOKS - 1, dp)), j=0, LOOKS - 1)]
    y = [(lower(2) + (upper(2) - lower(2))*(real(j, dp)/real(LOOKS - 1, dp)), j=0, LOOKS - 1)]
    allocate (height(LOOKS**2))
    call sample_grid(gap, x, y, height, info)
    if (info%failed()) return
    place = minloc(height, dim=1) - 1
    axis = [x(modulo(place, LOOKS) + 1), y(place/LOOKS + 1)]
    call find_axis(gap, lower, upper, axis, info)
    if (info%failed()) return
    reach = min(minval(axis - lower), minval(upper - axis))
    if (.not. reach > 0.0_dp) return
    call sample_series(gap, axis, DIRECTION, [0.0_dp, reach], LONGEST, profile, found, info)
    if (info%failed() .or. .not. found) return
    found = .not. has_tip(profile)
    if (found) call look_everywhere(radii(x, y, axis), height, profile, pressing%accuracy, found, lowest_outside)
    if (.not. found) return
    if (allocated(pressing%load)) then
      call fuge_solve_round_punch(profile, pressing%e_star, series, attempt, load=pressing%load)
    else
      call fuge_solve_round_punch(profile, pressing%e_star, series, attempt, approach=pressing%approach)
    end if
    found = attempt%status == FUGE_DONE .and. series%radius > 0.0_dp
    if (found) found = series%pressure_error <= pressing%accuracy
    ! Forces only open the gap where they do not act.
    found = found .and. lowest_outside > series%approach
  end subroutine solve_by_round_series

  !> The axis: the lowest of some places, as it comes in, moved to where parabolas through neighbours have their lowest
  !> points.
  subroutine find_axis(gap, lower, upper, axis, info)
    class(fuge_gap_function), intent(in) :: gap
    real(dp), intent(in) :: lower(2), upper(2)
    real(dp), intent(inout) :: axis(2)
    type(fuge_info), intent(inout) :: info
    real(dp) :: step(2), near(5), bend
    integer :: direction, k

    step = (upper - lower)/real(LOOKS - 1, dp)
    do k = 1, AXIS_STEPS
      axis = min(max(axis, lower + step), upper - step)
      call sample_gap(gap, axis(1) + step(1)*[0.0_dp, -1.0_dp, 1.0_dp, 0.0_dp, 0.0_dp], &
                      axis(2) + step(2)*[0.0_dp, 0.0_dp, 0.0_dp, -1.0_dp, 1.0_dp], near, info)
      if (info%failed()) return
      do direction = 1, 2
        bend = near(2*direction) - 2.0_dp*near(1) + near(2*direction + 1)
        if (bend > 0.0_dp) axis(direction) = axis(direction) + step(direction)*max(-1.0_dp, min(1.0_dp, &
                                             0.5_dp*(near(2*direction) - near(2*direction + 1))/bend))
      end do
      step = SMALLER*step
    end do
  end subroutine find_axis

  !> Distances of the places of a grid from the axis, (nx*ny), x running first.
  pure function radii(x, y, axis)
    real(dp), intent(in) :: x(:), y(:), axis(2)
    real(dp) :: radii(size(x)*size(y))
    integer :: i, j

    radii = [((hypot(x(i) - axis(1), y(j) - axis(2)), i=1, size(x)), j=1, size(y))]
  end function radii

  !> Has the profile a tip on the axis, where its slope is not zero?
  function has_tip(profile)
    type(fuge_sampled_profile), intent(in) :: profile
    logical :: has_tip
    real(dp) :: height(2), slope(2)
    integer :: status

    call profile%evaluate([0.0_dp, profile%upper], height, slope, status)
    has_tip = status /= FUGE_DONE .or. abs(slope(1))*profile%upper > NO_TIP*(height(2) - height(1))
  end function has_tip

  !> Is the gap `height` (n) at the distances `r` (n) from the axis that of the profile, `is_same`, wherever this
  !> reaches? `lowest` is that of the gaps farther from the axis, huge if there are none.
  subroutine look_everywhere(r, height, profile, accuracy, is_same, lowest)
    real(dp), intent(in) :: r(:), height(:), accuracy
    type(fuge_sampled_profile), intent(in) :: profile
    logical, intent(out) :: is_same
    real(dp), intent(out) :: lowest
    real(dp), allocatable :: series(:), slope(:)
    integer :: status

    allocate (series(size(r)), slope(size(r)))
    call profile%evaluate(min(r, profile%upper), series, slope, status)
    is_same = status == FUGE_DONE
    if (is_same) is_same = all(abs(height - series) <= PART_OF_ACCURACY*accuracy*(series - minval(series)) &
                                                       + SAME*maxval(abs(series)) .or. r > profile%upper)
    lowest = minval(height, mask=r > profile%upper)
  end subroutine look_everywhere

  !> Give the contact of a series as one on equal cells, whose forces are integrals of the pressure, with the error of
  !> these integrals. Errors: those of the gap function.
  subroutine give_round_series(gap, lower, upper, axis, series, contact, info)
    class(fuge_gap_function), intent(in) :: gap
    real(dp), intent(in) :: lower(2), upper(2), axis(2)
    type(fuge_round_contact), intent(in) :: series
    type(fuge_resolved_contact), intent(inout) :: contact
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: height(:)
    real(dp) :: width(2), found
    integer :: cells(2), n, j

    n = FEWEST_CELLS
    do while (n < MOST_CELLS .and. real(n, dp)*(2.0_dp*series%radius) < real(IN_CONTACT, dp)*minval(upper - lower))
      n = 2*n
    end do
    cells = max(1, nint(real(n, dp)*((upper - lower)/minval(upper - lower))))
    width = (upper - lower)/real(cells, dp)
    allocate (contact%x(cells(1)), contact%y(cells(2)))
    contact%x = [(lower(1) + width(1)*(real(j, dp) - 0.5_dp), j=1, cells(1))]
    contact%y = [(lower(2) + width(2)*(real(j, dp) - 0.5_dp), j=1, cells(2))]
    allocate (contact%width_x(cells(1)), source=width(1))
    allocate (contact%width_y(cells(2)), source=width(2))
    allocate (contact%edges(2, 0), contact%force(product(cells)), contact%gap(product(cells)))
    call integrate_pressure(series, axis, contact)
    found = sum(contact%force)
    contact%force = contact%force*(series%load/found)

    allocate (height(product(cells)))
    call sample_grid(gap, contact%x, contact%y, height, info)
    if (info%failed()) return
    contact%gap = series%gaps_at(radii(contact%x, contact%y, axis), height)
    contact%method = FUGE_BY_SERIES
    contact%choice = 'a series: the bodies are round and smooth, in one disc of contact'
    contact%load = series%load
    contact%approach = series%approach
    contact%size = PI*series%radius**2
    contact%pressure_error = max(series%pressure_error, abs(found/series%load - 1.0_dp))
    contact%approach_error = max(LEAST_ERROR, series%pressure_error, series%radius_error)*abs(series%approach)
    contact%largest_error = max(LEAST_ERROR, series%pressure_error)*contact%largest
    contact%size_error = 2.0_dp*max(LEAST_ERROR, series%radius_error)*contact%size
  end subroutine give_round_series

  !> Forces of the cells: sums of pressures, of more places in cells that the rim of the contact crosses; and the
  !> largest pressure.
  subroutine integrate_pressure(series, axis, contact)
    type(fuge_round_contact), intent(in) :: series
    real(dp), intent(in) :: axis(2)
    type(fuge_resolved_contact), intent(inout) :: contact
    real(dp), allocatable :: smooth_part(:), squares(:)
    real(dp) :: diagonal, distance
    integer :: i, j, k

    ! The pressure over the root of 1 - (r/radius)^2 is smooth over the square of the radius.
    allocate (smooth_part(0:TABLE), squares(0:TABLE - 1))
    squares = [(real(k, dp)/real(TABLE, dp), k=0, TABLE - 1)]
    smooth_part(:TABLE - 1) = series%pressures_at(series%radius*sqrt(squares))
    contact%largest = maxval(smooth_part(:TABLE - 1))
    smooth_part(:TABLE - 1) = smooth_part(:TABLE - 1)/sqrt(1.0_dp - squares)
    smooth_part(TABLE) = 2.0_dp*smooth_part(TABLE - 1) - smooth_part(TABLE - 2)
    associate (width => [contact%width_x(1), contact%width_y(1)])
      diagonal = 0.5_dp*hypot(width(1), width(2))
      k = 0
      do j = 1, size(contact%y)
        do i = 1, size(contact%x)
          k = k + 1
          distance = hypot(contact%x(i) - axis(1), contact%y(j) - axis(2))
          contact%force(k) = 0.0_dp
          if (distance < series%radius + diagonal) &
            contact%force(k) = product(width)*mean_pressure(([contact%x(i), contact%y(j)] - axis)/series%radius, &
                                                            width/series%radius, smooth_part, &
                                                            merge(2, RIM_SAMPLES, &
                                                                  distance < series%radius - 2.0_dp*diagonal))
        end do
      end do
    end associate
  end subroutine integrate_pressure

  !> The mean pressure of a cell by samples in a square; its centre is at `place` (2) from the axis, and its sides are
  !> `width` (2), in radii. `smooth_part` as in `integrate_pressure`.
  pure function mean_pressure(place, width, smooth_part, samples) result(mean)
    real(dp), intent(in) :: place(2), width(2), smooth_part(0:)
    integer, intent(in) :: samples
    real(dp) :: mean
    real(dp) :: square, x, y, share
    integer :: i, j, below

    mean = 0.0_dp
    do j = 1, samples
      y = place(2) + width(2)*((real(j, dp) - 0.5_dp)/real(samples, dp) - 0.5_dp)
      do i = 1, samples
        x = place(1) + width(1)*((real(i, dp) - 0.5_dp)/real(samples, dp) - 0.5_dp)
        square = x**2 + y**2
        if (square >= 1.0_dp) cycle
        below = int(square*real(TABLE, dp))
        share = square*real(TABLE, dp) - real(below, dp)
        mean = mean + sqrt(1.0_dp - square)*(smooth_part(below)*(1.0_dp - share) + smooth_part(below + 1)*share)
      end do
    end do
    mean = mean/real(samples**2, dp)
  end function mean_pressure

end module fuge_round_series
