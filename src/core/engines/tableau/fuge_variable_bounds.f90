!> Bounds of the tableau's variables: which are free of sign, which have an upper bound, and the order in which ties
!> are broken.
module fuge_variable_bounds
  use fuge_column_numbers, only: gap_column, is_gap, stored_columns
  use fuge_kinds, only: dp
  use fuge_status, only: FUGE_DONE, FUGE_ERR_MEMORY
  implicit none
  private

  type, public :: variable_bounds
    !> Number of points and of free modes.
    integer :: n = 0, m = 0
    !> Play of each point, (n), in the tableau's unit; huge where one-sided.
    real(dp), allocatable :: upper(:)
    !> Variables of either sign, which may enter in both senses and never leave, (3n+2m).
    logical, allocatable :: free(:)
    !> Variables fixed at zero, which never enter, (3n+2m).
    logical, allocatable :: fixed(:)
    !> Columns of the first basis in equilibrium, with the sign in which the tableau has them: gaps instead of
    !> their artificials, then forces, (n+m). The paper's problem needs only the gaps, (n).
    integer, allocatable :: first(:)
    real(dp), allocatable :: sign(:)
  contains
    procedure :: set
    procedure :: upper_bound
  end type variable_bounds

contains

  !> The bounds of the paper's problem: nothing is negative, nothing has an upper bound. `ties` is the number of
  !> columns that break ties. `status`: FUGE_DONE or FUGE_ERR_MEMORY.
  pure subroutine set(self, n, m, ties, status)
    class(variable_bounds), intent(inout) :: self
    integer, intent(in) :: n, m, ties
    integer, intent(out) :: status
    integer :: k, stat

    if (allocated(self%upper)) deallocate (self%upper, self%free, self%fixed, self%first, self%sign)
    self%n = n
    self%m = m
    allocate (self%upper(n), self%free(stored_columns(n, m) + n + m), self%fixed(stored_columns(n, m) + n + m), &
              self%first(ties), self%sign(ties), stat=stat)
    status = merge(FUGE_DONE, FUGE_ERR_MEMORY, stat == 0)
    if (stat /= 0) return
    self%upper = huge(1.0_dp)
    self%free = .false.
    self%fixed = .false.
    self%first = 0
    self%first(:n) = gap_column(n, [(k, k=1, n)])
    self%sign = 1.0_dp
  end subroutine set

  !> The largest value of the variable in `column`; huge if it has no upper bound.
  elemental function upper_bound(self, column) result(largest)
    class(variable_bounds), intent(in) :: self
    integer, intent(in) :: column
    real(dp) :: largest

    largest = huge(largest)
    if (is_gap(self%n, column)) largest = self%upper(column - self%n)
  end function upper_bound

end module fuge_variable_bounds
