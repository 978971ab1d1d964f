!> The status of an engine in words.
module fuge_engine_messages
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_options_type, only: ITERATIONS_PER_ROW
  use fuge_status, only: fuge_info, fuge_status_text, report, FUGE_DONE, FUGE_ERR_NOT_DEFINITE, &
    FUGE_ERR_ITERATION_LIMIT, FUGE_ERR_NO_EQUILIBRIUM
  implicit none
  private

  public :: explain_status, idle_forces, report_closed_gap, report_uncorrected

  !> Forces that store no energy can be added to those of the contact.
  character(len=*), parameter, public :: SINGULAR_ON_CONTACT = 'alpha is singular on the contact: gaps and approach ' &
    //'are unique, the forces are not; those given are near the least squares'
  character(len=*), parameter, public :: SINGULAR_AND_UNRESISTED = 'the contact does not resist all motions, and ' &
    //'alpha is singular on it: neither these motions, nor the gaps that they move, nor the forces are unique'
  character(len=*), parameter, public :: SINGULAR_WHERE_TOUCHING = 'alpha is singular on the points that touch: gaps ' &
    //'and approach are unique, the forces are not; those given are one of many possible'
  !> Equal forces displace a periodic surface nowhere in the mean, nor points whose coefficients have zero sums.
  character(len=*), parameter :: IDLE = 'equal forces displace nothing', IDLE_ON_GRID = IDLE//' (a periodic surface)'

contains

  !> Words for equal forces that displace nothing: on a grid of `cells`, none for other points, that is a periodic
  !> surface.
  pure function idle_forces(cells) result(words)
    integer, intent(in) :: cells(2)
    character(len=merge(len(IDLE_ON_GRID), len(IDLE), all(cells > 0))) :: words

    words = IDLE_ON_GRID
  end function idle_forces

  !> Report the `status` of an engine in words. `limit`: the iterations allowed; `contacts`: points in the contact set.
  pure subroutine explain_status(status, limit, contacts, info)
    integer, intent(in) :: status, limit, contacts
    type(fuge_info), intent(inout) :: info

    select case (status)
    case (FUGE_DONE)
      return
    case (FUGE_ERR_ITERATION_LIMIT)
      call report(info, status, text(limit)//' iterations were not enough: raise max_iterations (0 allows ' &
                  //text(ITERATIONS_PER_ROW)//' for each row)')
    case (FUGE_ERR_NOT_DEFINITE)
      call report(info, status, 'alpha is singular on the contact set of '//text(contacts) &
                  //' points: remove points that move together')
    case default
      call report(info, status, fuge_status_text(status))
    end select
  end subroutine explain_status

  !> Report that the set which the tableau found in `pivots` pivots was still wrong after `limit` more sets.
  pure subroutine report_uncorrected(pivots, limit, info)
    integer, intent(in) :: pivots, limit
    type(fuge_info), intent(inout) :: info

    call report(info, FUGE_ERR_ITERATION_LIMIT, 'the tableau ended after '//text(pivots)//' pivots, but '//text(limit) &
                //' more contact sets did not correct what rounding had made of its set: the problem may be too ' &
                //'badly conditioned for double precision')
  end subroutine report_uncorrected

  !> Report that no forces hold the prescribed motions: the mean gap is negative, -`closed`, and equal forces, which
  !> alone could raise it, displace nothing. `cells` as for `idle_forces`.
  pure subroutine report_closed_gap(closed, cells, info)
    real(dp), intent(in) :: closed
    integer, intent(in) :: cells(2)
    type(fuge_info), intent(inout) :: info

    call report(info, FUGE_ERR_NO_EQUILIBRIUM, idle_forces(cells)//', so no forces hold the prescribed ' &
                //'motions, at which the mean gap is closed by '//text(closed)//': prescribe less, or resultants')
  end subroutine report_closed_gap

end module fuge_engine_messages
