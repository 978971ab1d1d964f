!> The exact course of a contact as its load changes, without load steps: as the load of the plain problem grows
!> from zero, or from one general problem to another.
module fuge_contact_path
  use fuge_kinds, only: dp
  use fuge_operator_type, only: fuge_operator
  use fuge_path_type, only: fuge_path
  use fuge_problem_type, only: fuge_problem
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: fuge_load_path, fuge_follow_path

  interface
    !> Follow the contact of the plain problem from zero load up to `load`; the parameter of the path is the load.
    !>
    !> `operator` a fuge_dense_operator with n points, `gap` (n) length, `load` >= 0 force; out: `path`, untouched on an
    !> error; info%iterations counts its events, info%residual is its certificate: the largest violation at the ends of
    !> its pieces, see `fuge_residual`; above 1e-10 it is a warning, FUGE_WARN_RESIDUAL. Without load all points are
    !> open; those that touch first have entries at zero load. Errors: as for a solve, and FUGE_ERR_ITERATION_LIMIT
    !> after more events than 50 for each point.
    module subroutine fuge_load_path(operator, gap, load, path, info)
      class(fuge_operator), intent(in) :: operator
      real(dp), intent(in) :: gap(:), load
      type(fuge_path), intent(inout) :: path
      type(fuge_info), intent(out) :: info
    end subroutine fuge_load_path

    !> Follow the contact from a general problem to another with other resultants and prescribed motions, w(t) = w +
    !> t*(finish - w) for t from 0 to 1: every t < 1 at which a point comes to a stop or leaves it, or its force comes
    !> to a limit or leaves it. Compliances and springs on motions are those of `problem`.
    !>
    !> `operator` a fuge_dense_operator with n points; `problem` the start, in equilibrium; `finish` (m) the resultants
    !> at the end, where prescribed the motions; out: `path`, untouched on an error; `info` as for `fuge_load_path`. A
    !> motion that nothing resists at the start starts at first touch if the load change closes the gap. Errors: as for
    !> a solve; FUGE_ERR_NO_EQUILIBRIUM also where equilibrium ends on the way, as where the limits carry no more: the
    !> message gives the parameter, and a path to a smaller one is possible; FUGE_ERR_ITERATION_LIMIT after more events
    !> than 50 for each point.
    module subroutine fuge_follow_path(operator, problem, finish, path, info)
      class(fuge_operator), intent(in) :: operator
      type(fuge_problem), intent(in) :: problem
      real(dp), intent(in) :: finish(:)
      type(fuge_path), intent(inout) :: path
      type(fuge_info), intent(out) :: info
    end subroutine fuge_follow_path
  end interface

end module fuge_contact_path
