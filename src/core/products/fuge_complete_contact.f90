!> Complete contact with a prescribed motion: are its forces determined?
!>
!> On a periodic surface displacements count from their mean, so that equal forces displace nothing.
!> In complete contact only the differences of the forces then follow from the gaps.
module fuge_complete_contact
  use fuge_contact_displacement, only: compute_displacement
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_operator_type, only: fuge_operator
  use fuge_point_space, only: point_space
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_NOT_DEFINITE
  implicit none
  private

  public :: equal_forces_displace_nothing

  !> Displacements below this fraction of what they are compared with are rounding.
  real(dp), parameter :: ROUNDING = 1.0e-12_dp

contains

  !> Do equal forces on all points displace nothing in the mean, the operator's datum included?
  !>
  !> Two products: their displacements are compared with their magnitude, and, because an operator may
  !> not know that, with those of the same resultant on the first point. Errors, with the result
  !> .false.: FUGE_ERR_MEMORY, those of the operator, FUGE_ERR_NOT_DEFINITE if the displacements are
  !> negative.
  function equal_forces_displace_nothing(operator, info) result(nothing)
    class(fuge_operator), intent(in) :: operator
    type(fuge_info), intent(inout) :: info
    logical :: nothing
    real(dp), allocatable :: force(:), displacement(:), magnitude(:)
    type(point_space) :: space
    real(dp) :: first(1), mean, measure
    integer :: n, points, stat

    nothing = .false.
    n = operator%points()
    allocate (force(n), displacement(n), magnitude(n), stat=stat)
    call require_memory(stat, 'equal forces on', n, 'points', info)
    space = operator%ranks()
    call space%agree(info)
    if (stat /= 0 .or. info%failed()) return
    points = space%total_count(n)
    force = 1.0_dp/real(max(points, 1), dp)
    call compute_displacement(operator, .true., force, displacement, info)
    if (info%failed()) return
    mean = space%total(sum(displacement))/real(points, dp)
    call operator%magnitude(force, displacement, magnitude)
    measure = space%total(sum(magnitude))/real(points, dp)
    force = 0.0_dp
    ! The first point of the first rank that has any.
    first = [real(space%number(), dp)]
    call space%take_from_least(merge(first(1), huge(first), n > 0), first)
    if (n > 0 .and. .not. real(space%number(), dp) > first(1)) force(1) = 1.0_dp
    call compute_displacement(operator, .true., force, displacement, info)
    if (info%failed()) return
    measure = max(measure, space%largest(maxval(abs(displacement))))
    nothing = abs(mean) <= ROUNDING*measure
    if (mean < 0.0_dp .and. .not. nothing) call report(info, FUGE_ERR_NOT_DEFINITE, 'equal forces with the sum 1 ' &
      //'store the negative energy '//text(0.5_dp*mean)//': the operator is not positive definite')
  end function equal_forces_displace_nothing

end module fuge_complete_contact
