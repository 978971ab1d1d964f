!> The last word on every solution: the report from the certificate.
module fuge_certified_solution
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_certificate, only: find_violation, fuge_violation
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_operator_type, only: fuge_operator
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_point_chunks, only: chunked_pass, CHUNK
  use fuge_point_space, only: point_space
  use fuge_rim_contact, only: remark_contact_at_rim
  use fuge_settled_motions, only: softly_held
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_OVERFLOW, FUGE_WARN_RESIDUAL, FUGE_WARN_ILL_CONDITIONED
  implicit none
  private

  public :: certify

  !> Above this estimate of the relative error of the forces, and above this multiple of the tolerance, a solution comes
  !> with a warning: a loose tolerance allows errors of the forces.
  real(dp), parameter :: MOST_FORCE_ERROR = 1.0e-3_dp, MOST_OF_TOLERANCE = 1.0e3_dp

  !> A pass over the forces. Found: the number of those that are not zero.
  type, extends(chunked_pass) :: contact_count
    real(dp), pointer, contiguous :: force(:) => null()
  contains
    procedure :: do_chunk => count_chunk
  end type contact_count

contains

  !> Fill the report from the certificate. A residual above the tolerance is a warning, as are forces that may be far
  !> off by the estimate that the engine has left in info%force_error; contact at the rim of a grid is only a message.
  subroutine certify(operator, problem, solution, tolerance, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    real(dp), intent(in) :: tolerance
    type(fuge_info), intent(inout) :: info
    type(fuge_violation) :: violation
    type(point_space) :: space
    integer :: motion

    call find_violation(operator, problem, solution, violation, info, enough=tolerance)
    if (info%failed()) return
    space = operator%ranks()
    info%contacts = space%total_count(count_contacts(solution%force))
    info%residual = violation%worst()
    ! Where a value is no number the residual is huge, and the values of a good one need not be looked at.
    if (info%residual >= huge(info%residual)) call require_range(solution, space, info)
    if (info%failed()) return
    if (violation%unresolved > tolerance) then
      call report(info, FUGE_WARN_RESIDUAL, 'the forces reach ' &
                  //text(space%largest(maxval(abs(solution%force))))//' and dwarf the ' &
                  //'data: lengths are off by '//text(violation%unresolved)//' of the gaps; look for missing ' &
                  //'rigid motions, or for gaps that no forces can close or open')
    else if (info%residual > tolerance) then
      call report(info, FUGE_WARN_RESIDUAL, 'residual '//text(info%residual)//' is above the tolerance ' &
                  //text(tolerance)//': the operator may be too badly conditioned for double precision')
      motion = softly_held(problem, solution, space)
      if (motion > 0) call report(info, FUGE_WARN_RESIDUAL, 'residual '//text(info%residual)//' is above the ' &
        //'tolerance '//text(tolerance)//': the spring of motion '//index_text(motion)//' is too soft beside the ' &
        //'points, whose gaps lose their digits; choose a stiffer spring or none, or FUGE_ITERATIVE for a matrix')
    else if (info%status == FUGE_DONE &
             .and. info%force_error > max(MOST_FORCE_ERROR, MOST_OF_TOLERANCE*tolerance)) then
      call report(info, FUGE_WARN_ILL_CONDITIONED, 'the forces may be wrong by '//text(info%force_error)//' of the ' &
                  //'largest one although the equations hold to '//text(info%residual)//': merge points that nearly ' &
                  //'coincide, count tilts from a nearer point, or lower the tolerance of an iteration')
    else if (info%status == FUGE_DONE) then
      call remark_contact_at_rim(operator, solution%force, info)
    end if
  end subroutine certify

  !> Refuse a solution in which a force, a gap or a motion has left the range of double precision (FUGE_ERR_OVERFLOW).
  subroutine require_range(solution, space, info)
    type(fuge_solution), intent(in) :: solution
    type(point_space), intent(in) :: space
    type(fuge_info), intent(inout) :: info

    if (space%everywhere(all(ieee_is_finite(solution%force)) .and. all(ieee_is_finite(solution%gap)) &
                         .and. all(ieee_is_finite(solution%motion)))) return
    call report(info, FUGE_ERR_OVERFLOW, 'forces, gaps or motions leave the range of double precision: choose units ' &
                //'in which forces, lengths and their ratios are nearer to 1')
  end subroutine require_range

  !> How many of the forces (n) are not zero.
  function count_contacts(force) result(contacts)
    real(dp), intent(in), contiguous, target :: force(:)
    integer :: contacts
    type(contact_count) :: pass

    if (size(force) <= CHUNK) then
      contacts = count(abs(force) > 0.0_dp)
      return
    end if
    pass%force => force
    call pass%run(size(force), 1)
    contacts = nint(pass%total(1))
  end function count_contacts

  !> Chunk `k`, the points `first` .. `last`.
  subroutine count_chunk(self, k, first, last)
    class(contact_count), intent(inout) :: self
    integer, intent(in) :: k, first, last

    self%found(1, k) = real(count(abs(self%force(first:last)) > 0.0_dp), dp)
  end subroutine count_chunk

end module fuge_certified_solution
