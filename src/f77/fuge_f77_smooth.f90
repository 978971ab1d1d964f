!> A profile that is an external subroutine of FORTRAN 77, and the gaps and pressures of a smooth punch in plain arrays,
!> for FUGESP.
module fuge_f77_smooth
  use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_smooth_profile_type, only: fuge_smooth_profile, sample_profile
  use fuge_status, only: fuge_info, report, FUGE_ERR_CALLBACK, FUGE_ERR_MEMORY, FUGE_ERR_SIZE, FUGE_ERR_WIDTH
  implicit none
  private

  public :: check_places, initial_gaps, profile_values

  abstract interface
    !> PROFIL of FUGESP: gaps and slopes at `n` places; `ierr` is not 0 where there are none.
    subroutine profile_values(n, x, gap, slope, ierr)
      import :: dp
      integer, intent(in) :: n
      real(dp), intent(in) :: x(n)
      real(dp), intent(inout) :: gap(n), slope(n)
      integer, intent(inout) :: ierr
    end subroutine profile_values
  end interface

  !> A profile that is a subroutine of the caller.
  type, extends(fuge_smooth_profile), public :: external_profile
    procedure(profile_values), pointer, nopass :: profile => null()
  contains
    procedure :: evaluate
  end type external_profile

contains

  !> The subroutine gets a copy of the places, and arrays of NaN, so that a value that it forgets is seen.
  subroutine evaluate(self, x, gap, slope, status)
    class(external_profile), intent(in) :: self
    real(dp), intent(in) :: x(:)
    real(dp), intent(out) :: gap(:), slope(:)
    integer, intent(out) :: status
    real(dp), allocatable :: values(:, :)
    integer :: stat

    allocate (values(size(x), 3), stat=stat)
    if (stat /= 0) then
      gap = 0.0_dp
      slope = 0.0_dp
      status = FUGE_ERR_MEMORY
      return
    end if
    values = ieee_value(0.0_dp, ieee_quiet_nan)
    values(:, 1) = x
    status = 0
    call self%profile(size(x), values(:, 1), values(:, 2), values(:, 3), status)
    gap = values(:, 2)
    slope = values(:, 3)
    if (status < 0) status = FUGE_ERR_CALLBACK
  end subroutine evaluate

  !> Refuse a negative number of places (FUGE_ERR_SIZE), and places that are not finite (FUGE_ERR_NOT_FINITE) or have no
  !> profile (FUGE_ERR_WIDTH), unless an error is known already.
  pure subroutine check_places(count, x, profile, info)
    integer, intent(in) :: count
    real(dp), intent(in) :: x(:)
    class(fuge_smooth_profile), intent(in) :: profile
    type(fuge_info), intent(inout) :: info
    integer :: k

    if (info%failed()) return
    if (count < 0) then
      call report(info, FUGE_ERR_SIZE, 'NX = '//text(count)//' is negative: it is the number of places')
      return
    end if
    call check_finite(x, 'X', info)
    do k = 1, size(x)
      if (info%failed()) return
      if (x(k) < profile%lower .or. x(k) > profile%upper) call report(info, FUGE_ERR_WIDTH, 'X('//index_text(k) &
        //') = '//text(x(k))//' is not between XMIN = '//text(profile%lower)//' and XMAX = '//text(profile%upper))
    end do
  end subroutine check_places

  !> The initial gaps (size(x)) at places that `check_places` has passed, unless an error is known already. Errors as
  !> `sample_profile`, and FUGE_ERR_MEMORY.
  subroutine initial_gaps(profile, x, gap, info)
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: x(:)
    real(dp), allocatable, intent(out) :: gap(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: slope(:)
    integer :: stat

    if (info%failed()) return
    allocate (gap(size(x)), slope(size(x)), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the initial gaps')
    else if (size(x) > 0) then
      call sample_profile(profile, x, gap, slope, info)
    end if
  end subroutine initial_gaps

end module fuge_f77_smooth
