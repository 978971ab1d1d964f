!> A smooth profile in one contact: by a series, without a grid.
module fuge_line_series
  use fuge_cell_elements, only: FUGE_FREE
  use fuge_chebyshev, only: chebyshev_coefficients
  use fuge_gap_function_type, only: fuge_gap_function, sample_gap
  use fuge_kinds, only: dp
  use fuge_line_mesh, only: borders, equal_cells, line_mesh
  use fuge_number_text, only: text
  use fuge_pressing_type, only: fuge_pressing
  use fuge_resolved_contact_type, only: fuge_resolved_contact, FUGE_BY_SERIES
  use fuge_smooth_contact_type, only: fuge_smooth_contact
  use fuge_smooth_profile_type, only: fuge_sampled_profile
  use fuge_smooth_punch, only: fuge_solve_smooth_punch
  use fuge_status, only: fuge_info, FUGE_DONE
  implicit none
  private

  public :: give_series, sample_series, series_suits, solve_by_series

  !> Chebyshev series of the gap are tried up to this length, and taken for exact when the last quarter of their
  !> coefficients is below this part of the largest one.
  integer, parameter :: FIRST_LENGTH = 16, LONGEST = 256
  real(dp), parameter :: ROUNDING = 1.0e-13_dp
  !> Places between the samples where the series is compared with the gap, and how much of the gap may differ.
  integer, parameter :: LOOKS = 509
  real(dp), parameter :: SAME = 1.0e-11_dp
  !> No relative error is less.
  real(dp), parameter :: LEAST_ERROR = 1.0e-13_dp
  !> Numbers of cells of the result, and how many of them are in contact at least, if they are not too many.
  integer, parameter :: FEWEST_CELLS = 128, MOST_CELLS = 8192, IN_CONTACT = 64

contains

  !> Is the scene one that a series can solve: a half-plane without layers under a load?
  pure function series_suits(pressing) result(suits)
    type(fuge_pressing), intent(in) :: pressing
    logical :: suits

    suits = pressing%boundary == FUGE_FREE .and. .not. allocated(pressing%layers) .and. allocated(pressing%load)
    if (suits) suits = pressing%load > 0.0_dp
  end function series_suits

  !> Try the series; `found` unless the gap is not smooth, or the contact is not one interval inside. Errors: those of
  !> the gap function.
  subroutine solve_by_series(gap, left, right, pressing, series, found, info)
    class(fuge_gap_function), intent(in) :: gap
    real(dp), intent(in) :: left, right
    type(fuge_pressing), intent(in) :: pressing
    type(fuge_smooth_contact), intent(inout) :: series
    logical, intent(out) :: found
    type(fuge_info), intent(inout) :: info
    type(fuge_sampled_profile) :: profile
    type(fuge_info) :: attempt
    logical :: is_smooth

    found = .false.
    call sample_series(gap, [0.0_dp, 0.0_dp], [1.0_dp, 0.0_dp], [left, right], LONGEST, profile, is_smooth, info)
    if (info%failed() .or. .not. is_smooth) return
    if (allocated(pressing%moment)) then
      call fuge_solve_smooth_punch(profile, pressing%e_star, pressing%load, series, attempt, pressing%moment)
    else
      call fuge_solve_smooth_punch(profile, pressing%e_star, pressing%load, series, attempt)
    end if
    found = attempt%status == FUGE_DONE
    if (found) found = series%pressure_error <= pressing%accuracy
  end subroutine solve_by_series

  !> The gap as a Chebyshev series along a straight line, if it is smooth there: more and more samples, up to `longest`,
  !> until the last coefficients are rounding and places between the samples agree. The line starts at `origin` (2),
  !> length, in `direction` (2), of length 1; the series is one of the distance, between `ends` (2). Errors: those of
  !> the gap function.
  subroutine sample_series(gap, origin, direction, ends, longest, profile, is_smooth, info)
    class(fuge_gap_function), intent(in) :: gap
    real(dp), intent(in) :: origin(2), direction(2), ends(2)
    integer, intent(in) :: longest
    type(fuge_sampled_profile), intent(inout) :: profile
    logical, intent(out) :: is_smooth
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: places(:), height(:), coefficients(:)
    integer :: n

    is_smooth = .false.
    n = FIRST_LENGTH
    do while (n <= longest)
      if (allocated(places)) deallocate (places, height, coefficients)
      allocate (places(n + 1), height(n + 1), coefficients(n + 1))
      places = profile%points(ends(1), ends(2), n)
      call sample_gap(gap, origin(1) + direction(1)*places, origin(2) + direction(2)*places, height, info)
      if (info%failed()) return
      coefficients = chebyshev_coefficients(height)
      is_smooth = maxval(abs(coefficients(3*n/4 + 1:))) <= ROUNDING*maxval(abs(coefficients))
      if (is_smooth) then
        call profile%set(ends(1), ends(2), height, info)
        if (.not. info%failed()) call look_between(gap, origin, direction, profile, is_smooth, info)
        if (info%failed() .or. is_smooth) return
      end if
      n = 2*n
    end do
  end subroutine sample_series

  !> Is the gap that of the series between its samples too? Errors: those of the gap function.
  subroutine look_between(gap, origin, direction, profile, is_same, info)
    class(fuge_gap_function), intent(in) :: gap
    real(dp), intent(in) :: origin(2), direction(2)
    type(fuge_sampled_profile), intent(in) :: profile
    logical, intent(out) :: is_same
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: places(:), height(:), series(:), slope(:)
    integer :: k, status

    is_same = .false.
    allocate (places(LOOKS), height(LOOKS), series(LOOKS), slope(LOOKS))
    do k = 1, LOOKS
      places(k) = profile%lower + (profile%upper - profile%lower)*((real(k, dp) - 0.5_dp)/real(LOOKS, dp))
    end do
    call sample_gap(gap, origin(1) + direction(1)*places, origin(2) + direction(2)*places, height, info)
    if (info%failed()) return
    call profile%evaluate(places, series, slope, status)
    is_same = status == FUGE_DONE .and. maxval(abs(series - height)) <= SAME*maxval(abs(height))
  end subroutine look_between

  !> Give the contact of a series as one on equal cells, whose forces are integrals of the pressure. Errors: those of
  !> the gap function.
  subroutine give_series(gap, left, right, series, contact, info)
    class(fuge_gap_function), intent(in) :: gap
    real(dp), intent(in) :: left, right
    type(fuge_smooth_contact), intent(in) :: series
    type(fuge_resolved_contact), intent(inout) :: contact
    type(fuge_info), intent(inout) :: info
    type(line_mesh) :: mesh
    real(dp), allocatable :: height(:)
    integer :: n

    n = FEWEST_CELLS
    do while (n < MOST_CELLS .and. real(n, dp)*(2.0_dp*series%half_width) < real(IN_CONTACT, dp)*(right - left))
      n = 2*n
    end do
    mesh = equal_cells(left, right, n)
    allocate (height(n))
    call sample_gap(gap, mesh%x, spread(0.0_dp, 1, n), height, info)
    if (info%failed()) return
    contact%method = FUGE_BY_SERIES
    contact%choice = 'a series of '//text(size(series%coefficients))//' term(s): the profile is smooth, in one contact'
    contact%series = series
    contact%x = mesh%x
    contact%width_x = mesh%width
    contact%force = cell_forces(series, borders(mesh))
    contact%gap = series%gaps_at(mesh%x, height)
    contact%load = series%force
    contact%approach = series%approach
    contact%tilt = series%tilt
    contact%edges = reshape(series%ends, [2, 1])
    contact%size = 2.0_dp*series%half_width
    contact%largest = largest_pressure(series)
    contact%pressure_error = series%pressure_error
    contact%largest_error = max(LEAST_ERROR, series%pressure_error)*contact%largest
    contact%edge_error = max(LEAST_ERROR, series%end_error)*series%half_width
    contact%size_error = 2.0_dp*contact%edge_error
    ! Half the square of the half width over the radius of the profile is of the order of the displacements.
    contact%approach_error = max(LEAST_ERROR, series%pressure_error, series%end_error) &
                             *max(series%force/series%e_star, abs(series%approach))
  end subroutine give_series

  !> Integrals of the pressure between the `border`s (n + 1), (n). With t = cos(theta) the pressure is
  !> sum_k c_k sin((k + 1) theta), and dt is -sin(theta) dtheta.
  pure function cell_forces(series, border) result(force)
    type(fuge_smooth_contact), intent(in) :: series
    real(dp), intent(in) :: border(:)
    real(dp) :: force(size(border) - 1)
    real(dp) :: angle, from_right(size(border))
    integer :: j, k

    do j = 1, size(border)
      angle = acos(max(-1.0_dp, min(1.0_dp, ((border(j) - series%anchor) - series%offset)/series%half_width)))
      from_right(j) = series%coefficients(1)*(0.5_dp*angle - 0.25_dp*sin(2.0_dp*angle))
      if (.not. angle > 0.0_dp) cycle
      do k = 2, size(series%coefficients)
        from_right(j) = from_right(j) + 0.5_dp*series%coefficients(k) &
                        *(sin(real(k - 1, dp)*angle)/real(k - 1, dp) - sin(real(k + 1, dp)*angle)/real(k + 1, dp))
      end do
    end do
    force = series%half_width*(from_right(:size(force)) - from_right(2:))
  end function cell_forces

  !> The largest pressure, from samples that are as close as the series needs.
  pure function largest_pressure(series) result(largest)
    type(fuge_smooth_contact), intent(in) :: series
    real(dp) :: largest
    integer, parameter :: SAMPLES_OF_TERM = 32
    integer :: k, n

    n = SAMPLES_OF_TERM*(size(series%coefficients) + 1)
    largest = maxval(series%pressures_at([(series%anchor + (series%offset + series%half_width &
                                           *cos(acos(-1.0_dp)*(real(k, dp)/real(n, dp)))), k=0, n)]))
  end function largest_pressure

end module fuge_line_series
