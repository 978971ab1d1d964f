!> The check that the ranks which share the points of a problem have the same loads, motions and options.
!>
!> Ranks that solve different problems would wait for each other without end.
module fuge_shared_problem
  use fuge_data_scales, only: is_prescribed
  use fuge_kinds, only: dp
  use fuge_options_type, only: fuge_options
  use fuge_problem_type, only: fuge_problem
  use fuge_point_space, only: point_space
  use fuge_status, only: fuge_info, report, FUGE_ERR_OPTION
  implicit none
  private

  public :: check_shared_problem, differ

contains

  !> Refuse loads, motions, kinds of problems and options that differ between the ranks that share the points
  !> (FUGE_ERR_OPTION).
  subroutine check_shared_problem(problem, options, space, info)
    type(fuge_problem), intent(in) :: problem
    type(fuge_options), intent(in) :: options
    type(point_space), intent(in) :: space
    type(fuge_info), intent(inout) :: info
    real(dp) :: kind_of(10)

    kind_of = real([problem%mode_count(), merge(1, 0, allocated(problem%modes)), &
                    merge(1, 0, allocated(problem%gap_upper)), merge(1, 0, allocated(problem%excluded)), &
                    merge(1, 0, allocated(problem%prescribed)), merge(1, 0, problem%is_plain()), &
                    merge(1, 0, allocated(problem%compliance)), merge(1, 0, allocated(problem%limit)), &
                    merge(1, 0, allocated(problem%limit_upper)), merge(1, 0, allocated(problem%motion_stiffness))], dp)
    if (differ(kind_of, space)) then
      call report(info, FUGE_ERR_OPTION, 'modes, gap_upper, excluded, prescribed or the laws of points are not ' &
                  //'allocated alike on all ranks: allocate them on all or on none, also where a rank has no points')
    else if (differ(values_by_mode(problem), space)) then
      call report(info, FUGE_ERR_OPTION, 'a load, a prescribed motion or the stiffness of one differs between the ' &
                  //'ranks')
    else if (differ([real([options%method, options%max_iterations, merge(1, 0, options%keep_history)], dp), &
                     options%tolerance], space)) then
      call report(info, FUGE_ERR_OPTION, 'method, max_iterations, keep_history or tolerance of the options differs ' &
                  //'between the ranks')
    end if
  end subroutine check_shared_problem

  !> Do the `values`, as many on each, differ between the ranks?
  function differ(values, space)
    real(dp), intent(in) :: values(:)
    type(point_space), intent(in) :: space
    logical :: differ
    real(dp) :: extremes(2*size(values))

    extremes = [values, -values]
    call space%raise(extremes)
    differ = any(abs(extremes(:size(values)) + extremes(size(values) + 1:)) > 0.0_dp)
  end function differ

  !> Of each mode 1 and the motion where that is prescribed, else 0 and the resultant, and the stiffness of its spring,
  !> (3 m).
  pure function values_by_mode(problem)
    type(fuge_problem), intent(in) :: problem
    real(dp) :: values_by_mode(3*problem%mode_count())
    integer :: j

    values_by_mode = 0.0_dp
    do j = 1, problem%mode_count()
      if (is_prescribed(problem, j)) then
        values_by_mode(3*j - 2:3*j - 1) = [1.0_dp, problem%motion(j)]
      else
        values_by_mode(3*j - 1) = problem%resultant(j)
      end if
      if (allocated(problem%motion_stiffness)) values_by_mode(3*j) = problem%motion_stiffness(j)
    end do
  end function values_by_mode

end module fuge_shared_problem
