!> What is proved of a solution.
module fuge_proof_type
  use fuge_kinds, only: dp
  use fuge_problem_type, only: fuge_solution
  implicit none
  private

  !> Bounds that are theorems about the data as they are stored, rounding included: the exact solution of the problem is
  !> within them. Infinity where nothing is proved.
  type, public :: fuge_proof
    !> |force - exact force|, (n), force.
    real(dp), allocatable :: force_bound(:)
    !> |gap - exact gap|, (n), length.
    real(dp), allocatable :: gap_bound(:)
    !> |motion - exact motion|, (m), length for a translation; 0 for a prescribed one.
    real(dp), allocatable :: motion_bound(:)
    !> Is it proved that the point has the state that the solution says, and is not on the border to another one? (n)
    logical, allocatable :: state_proved(:)
  contains
    procedure :: is_bounded
    procedure :: largest_force
  end type fuge_proof

contains

  !> Is everything bounded?
  pure function is_bounded(self)
    class(fuge_proof), intent(in) :: self
    logical :: is_bounded

    is_bounded = allocated(self%force_bound) .and. allocated(self%gap_bound) .and. allocated(self%motion_bound)
    if (is_bounded) is_bounded = all(self%force_bound <= huge(1.0_dp)) .and. all(self%gap_bound <= huge(1.0_dp)) &
                                 .and. all(self%motion_bound <= huge(1.0_dp))
  end function is_bounded

  !> The least and the most that the largest exact force can be, (2), force: over the area of a cell, the largest
  !> pressure. `solution` is the one that was proved.
  pure function largest_force(self, solution) result(range)
    class(fuge_proof), intent(in) :: self
    type(fuge_solution), intent(in) :: solution
    real(dp) :: range(2)

    range = 0.0_dp
    if (size(solution%force) < 1) return
    range = [maxval(solution%force - self%force_bound), maxval(solution%force + self%force_bound)]
    ! The sums are rounded: one unit in the last place more is not below the exact bound.
    range = [nearest(range(1), -1.0_dp), nearest(range(2), 1.0_dp)]
  end function largest_force

end module fuge_proof_type
