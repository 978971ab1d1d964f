!> What a solve to a wanted error is given beside the gap: how the bodies deform, what presses them, and how exact the
!> answer has to be.
module fuge_pressing_type
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
  use fuge_cell_elements, only: FUGE_FREE, FUGE_PERIODIC
  use fuge_elastic_moduli, only: check_e_star
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_layered_body_type, only: fuge_layered_body
  use fuge_number_text, only: text
  use fuge_options_type, only: fuge_options
  use fuge_problem_type, only: fuge_problem
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_CALL_ORDER, FUGE_ERR_NO_EQUILIBRIUM, FUGE_ERR_OPTION, &
    FUGE_ERR_UNSUPPORTED, FUGE_ERR_WIDTH, FUGE_WARN_ACCURACY
  implicit none
  private

  public :: check_extent, check_pressing, pose_problem, warn_of_accuracy

  !> How the bodies deform, what presses them, and how exact the answer has to be. Set the components by name.
  type, public :: fuge_pressing
    !> Combined modulus e_star as in `fuge_halfplane_matrix`, that of the layers if there are some; force per length
    !> squared.
    real(dp) :: e_star = 0.0_dp
    !> One of them: the load, force, on a line per unit depth; or the approach, length, whose datum on a line is that of
    !> `fuge_halfplane_matrix` for cells that cover the interval.
    real(dp), allocatable :: load, approach
    !> On a line with a load: its moment about x = 0, force times length per unit depth, under which the bodies tilt.
    !> Not allocated: they only approach each other.
    real(dp), allocatable :: moment
    !> FUGE_FREE or FUGE_PERIODIC with the interval, or both sides of the rectangle, as period.
    integer :: boundary = FUGE_FREE
    !> The layers, if the bodies have some.
    type(fuge_layered_body), allocatable :: layers
    !> Wanted error of the pressure: the share of the load that may be in the wrong place; between 0 and 1, no unit.
    real(dp) :: accuracy = 1.0e-3_dp
    !> Most cells of a grid; 0 for 2**20 on a line, 2**22 on an area.
    integer :: most_cells = 0
    !> No finer grid is begun that would be expected to end later than so many seconds after the call.
    real(dp) :: most_seconds = huge(1.0_dp)
    !> Threads as in `fuge_options`.
    integer :: threads = 1
  contains
    procedure :: cells_allowed
    procedure :: is_unloaded
  end type fuge_pressing

  !> Largest and smallest tolerance of a solve, and between them its part of the wanted error.
  real(dp), parameter :: LOOSEST = 1.0e-6_dp, TIGHTEST = 1.0e-12_dp, PART_OF_ACCURACY = 1.0e-3_dp

contains

  !> Most cells of a grid: `most_cells`, or the `default` if that is 0.
  pure function cells_allowed(self, default) result(most)
    class(fuge_pressing), intent(in) :: self
    integer, intent(in) :: default
    integer :: most

    most = merge(self%most_cells, default, self%most_cells > 0)
  end function cells_allowed

  !> Is the load zero? Then the bodies touch at the lowest place of the gap, between samples too.
  pure function is_unloaded(self)
    class(fuge_pressing), intent(in) :: self
    logical :: is_unloaded

    is_unloaded = .false.
    if (allocated(self%load)) is_unloaded = .not. self%load > 0.0_dp
  end function is_unloaded

  !> Refuse a scene that makes no sense, or that cannot be solved to an error.
  subroutine check_pressing(pressing, info)
    type(fuge_pressing), intent(in) :: pressing
    type(fuge_info), intent(inout) :: info

    if (.not. allocated(pressing%layers)) then
      call check_e_star(pressing%e_star, info)
    else if (.not. pressing%layers%is_set()) then
      call report(info, FUGE_ERR_CALL_ORDER, 'layers: no layers are set')
    end if
    if (info%failed()) return
    if (allocated(pressing%load) .eqv. allocated(pressing%approach)) then
      call report(info, FUGE_ERR_OPTION, 'give one of load and approach')
    else if (all(pressing%boundary /= [FUGE_FREE, FUGE_PERIODIC])) then
      call report(info, FUGE_ERR_OPTION, 'boundary = '//text(pressing%boundary) &
                  //' is unknown here: use FUGE_FREE or FUGE_PERIODIC')
    else if (allocated(pressing%moment) .and. (allocated(pressing%approach) .or. pressing%boundary /= FUGE_FREE)) then
      call report(info, FUGE_ERR_UNSUPPORTED, 'a moment is for a free surface under a load: without it the bodies ' &
                  //'only approach each other')
    end if
    if (.not. info%failed()) call check_motion(pressing, info)
    if (.not. info%failed()) call check_limits(pressing, info)
  end subroutine check_pressing

  subroutine check_motion(pressing, info)
    type(fuge_pressing), intent(in) :: pressing
    type(fuge_info), intent(inout) :: info

    if (allocated(pressing%load)) then
      call check_finite(pressing%load, 'load', info)
      if (info%failed()) return
      if (pressing%load < 0.0_dp) call report(info, FUGE_ERR_NO_EQUILIBRIUM, 'load = '//text(pressing%load) &
                                              //' is negative: contact can only push')
    else
      call check_finite(pressing%approach, 'approach', info)
    end if
    if (allocated(pressing%moment) .and. .not. info%failed()) call check_finite(pressing%moment, 'moment', info)
  end subroutine check_motion

  subroutine check_limits(pressing, info)
    type(fuge_pressing), intent(in) :: pressing
    type(fuge_info), intent(inout) :: info
    logical :: is_between

    is_between = .not. ieee_is_nan(pressing%accuracy)
    if (is_between) is_between = pressing%accuracy > 0.0_dp .and. pressing%accuracy < 1.0_dp
    if (.not. is_between) then
      call report(info, FUGE_ERR_OPTION, 'accuracy = '//text(pressing%accuracy)//' is not between 0 and 1: it is the ' &
                  //'share of the load that may be in the wrong place, 1e-3 by default')
    else if (pressing%most_cells < 0) then
      call report(info, FUGE_ERR_OPTION, 'most_cells = '//text(pressing%most_cells)//' is negative: 0 is the default')
    else if (.not. is_time(pressing%most_seconds)) then
      call report(info, FUGE_ERR_OPTION, 'most_seconds = '//text(pressing%most_seconds)//' is not a time: by default ' &
                  //'there is no limit')
    else if (pressing%threads < 0) then
      call report(info, FUGE_ERR_OPTION, 'threads = '//text(pressing%threads) &
                  //' is negative: use 0 for all cores, 1 for one thread, or more')
    end if
  end subroutine check_limits

  !> Is it neither negative nor NaN?
  pure function is_time(seconds)
    real(dp), intent(in) :: seconds
    logical :: is_time

    is_time = .not. ieee_is_nan(seconds)
    if (is_time) is_time = seconds >= 0.0_dp
  end function is_time

  !> Refuse ends of which the `lower` one is not below the `upper` one; `names` are those of the arguments.
  subroutine check_extent(lower, upper, names, info)
    real(dp), intent(in) :: lower, upper
    character(len=*), intent(in) :: names(2)
    type(fuge_info), intent(inout) :: info

    call check_finite(lower, trim(names(1)), info)
    if (.not. info%failed()) call check_finite(upper, trim(names(2)), info)
    if (info%failed()) return
    if (.not. lower < upper) call report(info, FUGE_ERR_WIDTH, trim(names(1))//' = '//text(lower)//' is not below ' &
                                         //trim(names(2))//' = '//text(upper))
  end subroutine check_extent

  !> Warn if the `error` reached is above the wanted one because of the `obstacle`; a warning that is there already
  !> gives way only to that.
  subroutine warn_of_accuracy(error, accuracy, obstacle, info)
    real(dp), intent(in) :: error, accuracy
    character(len=:), allocatable, intent(in) :: obstacle
    type(fuge_info), intent(inout) :: info

    if (error <= accuracy .or. info%status > FUGE_DONE) return
    call report(info, FUGE_WARN_ACCURACY, 'the estimated error of the pressure is '//text(error)//' instead of ' &
                //text(accuracy)//': '//obstacle)
  end subroutine warn_of_accuracy

  !> Pose the problem of points with the initial gaps `gap`, length, that only approach each other, and choose how
  !> exactly it has to be solved.
  pure subroutine pose_problem(pressing, gap, problem, options)
    type(fuge_pressing), intent(in) :: pressing
    real(dp), intent(in) :: gap(:)
    type(fuge_problem), intent(inout) :: problem
    type(fuge_options), intent(inout) :: options

    allocate (problem%gap, source=gap)
    if (allocated(pressing%approach)) then
      allocate (problem%prescribed(1), source=.true.)
      allocate (problem%motion(1), source=pressing%approach)
    else
      allocate (problem%resultant(1), source=pressing%load)
    end if
    options%tolerance = max(TIGHTEST, min(LOOSEST, PART_OF_ACCURACY*pressing%accuracy))
    options%threads = pressing%threads
  end subroutine pose_problem

end module fuge_pressing_type
