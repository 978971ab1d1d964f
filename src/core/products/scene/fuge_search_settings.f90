!> What the search for the contact set of one grid has to reach, and what it may spend.
module fuge_search_settings
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_options_type, only: ITERATIONS_PER_ROW
  use fuge_status, only: fuge_info, report, FUGE_ERR_ITERATION_LIMIT
  implicit none
  private

  !> Relative residual required on a coarser grid, which only provides a starting point.
  real(dp), parameter :: COARSE_TOLERANCE = 1.0e-4_dp
  !> The search aims below the tolerance by this factor, because the certificate adds the errors
  !> at two points.
  real(dp), parameter, public :: SAFETY = 0.4_dp
  !> On a coarser grid a set is good enough if at most this fraction of its points is wrong.
  real(dp), parameter, public :: WRONG_ON_COARSE = 0.01_dp
  !> Block exchanges in a row without a new minimum of wrong points, before single exchanges begin; edges are
  !> extrapolated in the first half of them only.
  integer, parameter, public :: MAX_STALLS = 10

  !> The requirements on the search on one grid.
  type, public :: search_settings
    !> Relative residual to reach.
    real(dp) :: tolerance = COARSE_TOLERANCE
    !> Contact sets allowed, on all grids together.
    integer :: limit = 0
    !> Accept the first set with few wrong points, accurate or not: on a coarser grid its forces
    !> only start the next one.
    logical :: coarse_grid = .true.
    !> The iterate has its contact set, feasible forces and their displacements already.
    logical :: prepared = .false.
  contains
    procedure :: check_limit
  end type search_settings

contains

  !> Refuse another contact set beyond the limit (FUGE_ERR_ITERATION_LIMIT).
  pure subroutine check_limit(self, info)
    class(search_settings), intent(in) :: self
    type(fuge_info), intent(inout) :: info

    if (info%iterations < self%limit) return
    call report(info, FUGE_ERR_ITERATION_LIMIT, text(self%limit)//' contact sets were not enough: raise ' &
                //'max_iterations (0 allows '//text(ITERATIONS_PER_ROW)//' for each point)')
  end subroutine check_limit

end module fuge_search_settings
