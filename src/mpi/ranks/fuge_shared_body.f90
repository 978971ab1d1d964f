!> The body below a surface that ranks share.
module fuge_shared_body
  use fuge_kinds, only: dp
  use fuge_rank_communicator, only: rank_communicator
  use fuge_status, only: fuge_info, report, FUGE_ERR_OPTION
  use fuge_wave_mixture, only: wave_mixture, STEP
  implicit none
  private

  public :: share_body

  !> Fits of the same layers differ by less than this, relative to T, also on machines that round otherwise.
  real(dp), parameter :: SAME = 1.0e-6_dp
  !> A smaller T is fitted to this times `SAME` only.
  real(dp), parameter :: FLOOR_OF_T = 1.0e-4_dp

contains

  !> Give all ranks of `group` the `body` of the first one, so that their parts of the spectra fit together to the last
  !> digit. All ranks call it. Error, on all of them: FUGE_ERR_OPTION if bodies differ.
  subroutine share_body(group, body, info)
    type(rank_communicator), intent(in) :: group
    type(wave_mixture), intent(inout) :: body
    type(fuge_info), intent(inout) :: info
    type(wave_mixture) :: first
    real(dp) :: extremes(6)
    integer :: count

    count = 0
    if (body%is_set()) count = size(body%weight)
    extremes(:3) = [body%unit, body%limit, real(count, dp)]
    extremes(4:) = -extremes(:3)
    call group%raise(extremes)
    if (any(abs(extremes(:3) + extremes(4:)) > 0.0_dp)) then
      call refuse(info)
    else if (count > 0) then
      first = body
      call take_first(group, first%weight, first%tail)
      ! One rank decides for all.
      extremes(1) = merge(1.0_dp, 0.0_dp, differ(body, first))
      call group%raise(extremes(:1))
      if (extremes(1) > 0.0_dp) call refuse(info)
      if (.not. info%failed()) body = first
    end if
  end subroutine share_body

  !> The `weight` and the `tail` of the first rank.
  subroutine take_first(group, weight, tail)
    type(rank_communicator), intent(in) :: group
    real(dp), intent(inout), contiguous :: weight(:)
    real(dp), intent(inout) :: tail
    real(dp) :: last(1)

    last = tail
    if (group%number() > 0) then
      weight = 0.0_dp
      last = 0.0_dp
    end if
    call group%add(weight)
    call group%add(last)
    tail = last(1)
  end subroutine take_first

  !> Does T differ at waves of the lengths of any weights?
  pure function differ(body, other)
    type(wave_mixture), intent(in) :: body, other
    logical :: differ
    real(dp) :: expected, q
    integer :: k

    differ = .false.
    do k = 0, size(body%weight) - 1
      q = exp(-STEP*real(k, dp))/body%unit
      expected = other%wave_factor(q)
      differ = differ .or. abs(body%wave_factor(q) - expected) > SAME*max(abs(expected), FLOOR_OF_T)
    end do
  end function differ

  subroutine refuse(info)
    type(fuge_info), intent(inout) :: info

    call report(info, FUGE_ERR_OPTION, 'the body differs between the ranks: pass the same layers on all of them')
  end subroutine refuse

end module fuge_shared_body
