!> What the variables of the tableau may do: their signs, their upper limits, and the
!> order in which ties are decided.
module fuge_variable_bounds
  use fuge_kinds, only: dp
  use fuge_column_numbers, only: gap_column, is_gap, stored_columns
  use fuge_status, only: FUGE_DONE, FUGE_ERR_MEMORY
  implicit none
  private

  type, public :: variable_limits
    !> Points and free motions.
    integer :: n = 0, m = 0
    !> Largest gap at each point, (n), in the tableau's unit; huge where one-sided.
    real(dp), allocatable :: upper(:)
    !> Variables of either sign, which may enter both ways and never leave, (3n+2m).
    logical, allocatable :: free(:)
    !> Variables that stay at zero, and so never enter, (3n+2m).
    logical, allocatable :: fixed(:)
    !> Columns of the first basis after the equilibrium, with the sign in which the tableau
    !> shows them: gaps in the place of their artificials, then forces, (n+m). The paper's
    !> problem needs only the gaps, (n).
    integer, allocatable :: first(:)
    real(dp), allocatable :: sign(:)
  contains
    procedure :: set
    procedure :: room
  end type variable_limits

contains

  !> Those of the paper: nothing negative, nothing limited. `ties` is how many columns
  !> decide ties. Error: FUGE_ERR_MEMORY.
  pure subroutine set(self, n, m, ties, status)
    class(variable_limits), intent(inout) :: self
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

  !> The largest value of the variable in `column`; huge if there is none.
  elemental function room(self, column) result(largest)
    class(variable_limits), intent(in) :: self
    integer, intent(in) :: column
    real(dp) :: largest

    largest = huge(largest)
    if (is_gap(self%n, column)) largest = self%upper(column - self%n)
  end function room

end module fuge_variable_bounds
