!> Profiles, heights z over positions x, from a file or from arrays.
!>
!> Heights are positive upwards. The initial gap of two profiles that face each other,
!> sampled at the same points, is upper - lower; its datum is free, it moves v_0 only.
module fuge_profile_files
  use fuge_constants, only: LARGEST_EXPONENT
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_profile_lines, only: read_point, LINE_EMPTY, LINE_POINT, LINE_WORDS
  use fuge_status, only: fuge_info, report, FUGE_ERR_SIZE, FUGE_ERR_WIDTH, FUGE_ERR_OPTION, FUGE_ERR_OVERFLOW, &
    FUGE_ERR_MEMORY
  use fuge_number_text, only: text
  use fuge_text_reader, only: text_file
  implicit none
  private

  public :: fuge_read_profile, fuge_sample_profile, fuge_level_profile

  !> What is taken off a profile (`form`): the mean height.
  integer, parameter, public :: FUGE_LEVEL_MEAN = 0
  !> What is taken off a profile (`form`): the least-squares line.
  integer, parameter, public :: FUGE_LEVEL_LINE = 1

  !> A point this part of the profile's length beyond its end is taken as the end.
  real(dp), parameter :: END_TOLERANCE = 1.0e-12_dp

contains

  !> Read a profile: text, on each line x and z.
  !>
  !> Columns are separated by blanks, tabs, a comma or a semicolon; numbers have a decimal
  !> point and may have an exponent after e or d. Blank lines, and what follows # or ! at
  !> the begin of a line or after the numbers, are skipped, and so is one line of words
  !> before the numbers. `x` and `z` (any number of points >= 2) are allocated afresh, in
  !> the unit of the file, x strictly increasing.
  !> Errors, `x` and `z` untouched: FUGE_ERR_FILE with file, line and reason,
  !> FUGE_ERR_MEMORY.
  subroutine fuge_read_profile(path, x, z, info)
    character(len=*), intent(in) :: path
    real(dp), allocatable, intent(inout) :: x(:), z(:)
    type(fuge_info), intent(out) :: info
    type(text_file) :: file
    real(dp), allocatable :: read_x(:), read_z(:)
    integer :: points, status

    call file%load(path, info)
    if (info%failed()) return
    ! Room for as many points as there are lines.
    points = file%count_lines()
    allocate (read_x(points), read_z(points), stat=status)
    if (status == 0) then
      call read_points(file, read_x, read_z, points, info)
      if (info%failed()) return
      deallocate (file%content)
      call hand_over(read_x, points, x, read_z, z, status)
    end if
    if (status /= 0) call report(info, FUGE_ERR_MEMORY, file%name//': no memory for '//text(points)//' points')
  end subroutine fuge_read_profile

  !> Both or none.
  subroutine hand_over(read_x, points, x, read_z, z, status)
    real(dp), intent(in) :: read_x(:), read_z(:)
    integer, intent(in) :: points
    real(dp), allocatable, intent(inout) :: x(:), z(:)
    integer, intent(out) :: status
    real(dp), allocatable :: new_x(:), new_z(:)

    allocate (new_x(points), new_z(points), stat=status)
    if (status /= 0) return
    new_x = read_x(:points)
    new_z = read_z(:points)
    call move_alloc(new_x, x)
    call move_alloc(new_z, z)
  end subroutine hand_over

  !> All lines; at the end `points` of them are in `x` and `z`.
  pure subroutine read_points(file, x, z, points, info)
    type(text_file), intent(inout) :: file
    real(dp), intent(inout) :: x(:), z(:)
    integer, intent(out) :: points
    type(fuge_info), intent(inout) :: info
    logical :: found, header

    points = 0
    header = .false.
    do
      call file%advance(found)
      if (.not. found) exit
      call read_line(file, x, z, points, header, info)
      if (info%failed()) return
    end do
    if (points < 2) call file%refuse('the file ends after '//text(points)//' point(s), a profile needs 2 or more', info)
  end subroutine read_points

  pure subroutine read_line(file, x, z, points, header, info)
    type(text_file), intent(in) :: file
    real(dp), intent(inout) :: x(:), z(:)
    integer, intent(inout) :: points
    logical, intent(inout) :: header
    type(fuge_info), intent(inout) :: info
    character(len=:), allocatable :: reason
    real(dp) :: next_x, next_z
    integer :: kind

    call read_point(file%content(file%first:file%last), kind, next_x, next_z, reason)
    if (kind == LINE_EMPTY) return
    if (kind == LINE_WORDS .and. points == 0 .and. .not. header) then
      header = .true.
      return
    end if
    if (kind == LINE_POINT .and. points > 0) then
      if (.not. next_x > x(points)) then
        kind = LINE_WORDS
        reason = 'x = '//text(next_x)//' does not exceed x = '//text(x(points)) &
                 //' of the point before: x has to increase, sort the points and merge repeated ones'
      end if
    end if
    if (kind == LINE_POINT) then
      points = points + 1
      x(points) = next_x
      z(points) = next_z
    else
      call file%refuse(reason, info)
    end if
  end subroutine read_line

  !> Heights of a profile at other points, by linear interpolation.
  !>
  !> `x` (n), strictly increasing, and `z` (n), n >= 2: the profile; `centre` (k), any
  !> order: where it is wanted, within x(1) .. x(n) (1e-12 of the length beyond count as the
  !> end); out: `height` (k). All are lengths.
  !> Errors, `height` untouched: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_OVERFLOW,
  !> FUGE_ERR_WIDTH (x does not increase, or a centre is outside).
  pure subroutine fuge_sample_profile(x, z, centre, height, info)
    real(dp), intent(in) :: x(:), z(:), centre(:)
    real(dp), intent(inout) :: height(:)
    type(fuge_info), intent(out) :: info
    integer :: k, left

    call check_profile(x, z, info)
    if (.not. info%failed()) call check_centres(x, centre, size(height), info)
    if (info%failed()) return
    left = 1
    do k = 1, size(centre)
      left = interval_of(x, centre(k), left)
      height(k) = between(x(left:left + 1), z(left:left + 1), centre(k))
    end do
  end subroutine fuge_sample_profile

  !> The interval that holds `point`: `guess`, the next one, or by bisection.
  pure function interval_of(x, point, guess) result(left)
    real(dp), intent(in) :: x(:), point
    integer, intent(in) :: guess
    integer :: left
    integer :: right, middle

    do left = guess, min(guess + 1, size(x) - 1)
      if (x(left) <= point .and. point <= x(left + 1)) return
    end do
    left = 1
    right = size(x)
    do while (right - left > 1)
      middle = left + (right - left)/2
      if (x(middle) <= point) then
        left = middle
      else
        right = middle
      end if
    end do
  end function interval_of

  !> Weights of sum 1 and nothing beyond the ends: exact at both of them.
  pure function between(x, z, point) result(height)
    real(dp), intent(in) :: x(2), z(2), point
    real(dp) :: height
    real(dp) :: part

    part = max(0.0_dp, min(1.0_dp, (point - x(1))/(x(2) - x(1))))
    height = (1.0_dp - part)*z(1) + part*z(2)
  end function between

  !> Take the mean height or the least-squares line off a profile, as usual for roughness.
  !>
  !> `x` (n), strictly increasing, n >= 2; `z` (n) is changed in place; `form` is
  !> FUGE_LEVEL_MEAN or FUGE_LEVEL_LINE. Points count by the length they stand for, half of
  !> the intervals beside them, so that neither mean nor line depends on where a profile is
  !> sampled densely.
  !> Errors, `z` untouched: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_OVERFLOW,
  !> FUGE_ERR_WIDTH (x does not increase), FUGE_ERR_OPTION for `form`.
  pure subroutine fuge_level_profile(x, z, form, info)
    real(dp), intent(in) :: x(:)
    real(dp), intent(inout) :: z(:)
    integer, intent(in) :: form
    type(fuge_info), intent(out) :: info

    call check_profile(x, z, info)
    if (info%failed()) return
    if (form /= FUGE_LEVEL_MEAN .and. form /= FUGE_LEVEL_LINE) then
      call report(info, FUGE_ERR_OPTION, 'form = '//text(form)//' is unknown: use FUGE_LEVEL_MEAN or FUGE_LEVEL_LINE')
      return
    end if
    z = z - mean_height(x, z)
    if (form == FUGE_LEVEL_LINE) call take_slope_off(x, z)
  end subroutine fuge_level_profile

  !> Part of the whole length that each point stands for.
  pure function weights(x) result(weight)
    real(dp), intent(in) :: x(:)
    real(dp) :: weight(size(x))
    integer :: n

    n = size(x)
    weight = 0.0_dp
    weight(:n - 1) = 0.5_dp*((x(2:) - x(:n - 1))/(x(n) - x(1)))
    weight(2:) = weight(2:) + 0.5_dp*((x(2:) - x(:n - 1))/(x(n) - x(1)))
  end function weights

  pure function mean_height(x, z) result(mean)
    real(dp), intent(in) :: x(:), z(:)
    real(dp) :: mean

    ! From the first height, so that an offset costs no digits.
    mean = z(1) + dot_product(weights(x), z - z(1))
  end function mean_height

  !> For heights with mean zero.
  pure subroutine take_slope_off(x, z)
    real(dp), intent(in) :: x(:)
    real(dp), intent(inout) :: z(:)
    real(dp) :: place(size(x)), weight(size(x))

    ! Without a unit, so that no square overflows.
    place = (x - x(1))/(x(size(x)) - x(1))
    weight = weights(x)
    place = place - dot_product(weight, place)
    z = z - place*(dot_product(weight, place*z)/dot_product(weight, place**2))
  end subroutine take_slope_off

  pure subroutine check_profile(x, z, info)
    real(dp), intent(in) :: x(:), z(:)
    type(fuge_info), intent(inout) :: info
    integer :: k

    if (size(x) < 2 .or. size(z) /= size(x)) then
      call report(info, FUGE_ERR_SIZE, 'x has '//text(size(x))//' and z '//text(size(z)) &
                  //' value(s): both need n >= 2')
      return
    end if
    call check_finite(x, 'x', info)
    if (.not. info%failed()) call check_finite(z, 'z', info)
    if (info%failed()) return
    do k = 1, size(x)
      if (max(exponent(x(k)), exponent(z(k))) <= LARGEST_EXPONENT) cycle
      call report(info, FUGE_ERR_OVERFLOW, 'point '//text(k)//' at x = '//text(x(k))//', z = '//text(z(k)) &
                  //' is out of range: choose another unit of length')
      return
    end do
    do k = 2, size(x)
      if (x(k) > x(k - 1)) cycle
      call report(info, FUGE_ERR_WIDTH, 'x('//text(k)//') = '//text(x(k))//' does not exceed x('//text(k - 1)//') = ' &
                  //text(x(k - 1))//': x has to increase, sort the points and merge repeated ones')
      return
    end do
  end subroutine check_profile

  pure subroutine check_centres(x, centre, heights, info)
    real(dp), intent(in) :: x(:), centre(:)
    integer, intent(in) :: heights
    type(fuge_info), intent(inout) :: info
    real(dp) :: first, last
    integer :: k

    if (heights /= size(centre)) then
      call report(info, FUGE_ERR_SIZE, 'centre has '//text(size(centre))//' and height '//text(heights) &
                  //' value(s): they need the same number')
      return
    end if
    call check_finite(centre, 'centre', info)
    if (info%failed()) return
    first = x(1)
    last = x(size(x))
    do k = 1, size(centre)
      if (max(first - centre(k), centre(k) - last) <= END_TOLERANCE*(last - first)) cycle
      call report(info, FUGE_ERR_WIDTH, 'centre('//text(k)//') = '//text(centre(k))//' is outside the profile, ' &
                  //text(first)//' .. '//text(last)//': nothing is extrapolated, measure or cut accordingly')
      return
    end do
  end subroutine check_centres

end module fuge_profile_files
