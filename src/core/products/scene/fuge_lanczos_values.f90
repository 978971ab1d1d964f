!> The extreme eigenvalue of a system, from the conjugate gradients that solve it.
!>
!> Their coefficients are the factors L D L^T of the matrix of Lanczos: its eigenvalues approach those of the
!> preconditioned system (G. H. Golub, C. F. Van Loan, Matrix Computations, 4th edition, 2013, section 11.3).
module fuge_lanczos_values
  use fuge_growing_arrays, only: make_room
  use fuge_kinds, only: dp
  use fuge_lapack, only: dpttrs
  implicit none
  private

  !> This many inverse iterations find the smallest value well enough for an estimate.
  integer, parameter :: INVERSE_ITERATIONS = 6
  !> A pivot below this fraction of the largest one may be rounding.
  real(dp), parameter :: SUSPECT = 1.0e-8_dp

  !> The coefficients of one run, step by step.
  type, public :: lanczos_values
    private
    integer :: steps = 0
    !> D, and the elements of L below its unit diagonal.
    real(dp), allocatable :: pivots(:), below(:)
    !> The largest element of D.
    real(dp) :: largest = 0.0_dp
  contains
    procedure :: restart
    procedure :: add
    procedure :: is_suspect
    procedure :: smallest
  end type lanczos_values

contains

  !> Forget the steps of the last run.
  pure subroutine restart(self)
    class(lanczos_values), intent(inout) :: self

    self%steps = 0
    self%largest = 0.0_dp
  end subroutine restart

  !> Is `pivot`, one over a step length, so small that the next step may be rounding? Values of a good preconditioner
  !> are about 1, and without one `contact_preconditioner` divides by a typical compliance.
  elemental function is_suspect(self, pivot)
    class(lanczos_values), intent(in) :: self
    real(dp), intent(in) :: pivot
    logical :: is_suspect

    is_suspect = .not. pivot > SUSPECT*max(self%largest, 1.0_dp)
  end function is_suspect

  !> The next step: its length, and the energy of its residual over that of the step before. Without memory it is left
  !> out.
  pure subroutine add(self, step_length, ratio)
    class(lanczos_values), intent(inout) :: self
    real(dp), intent(in) :: step_length, ratio
    integer :: stat

    stat = 0
    call make_room(self%pivots, self%steps, stat)
    call make_room(self%below, self%steps, stat)
    if (stat /= 0) return
    self%steps = self%steps + 1
    self%pivots(self%steps) = 1.0_dp/step_length
    self%largest = max(self%largest, self%pivots(self%steps))
    ! The element below the pivot of the step before.
    if (self%steps > 1) self%below(self%steps - 1) = sqrt(ratio)
  end subroutine add

  !> An estimate of the smallest eigenvalue, from above; 0 without steps, or where it cannot be found.
  function smallest(self) result(value)
    class(lanczos_values), intent(in) :: self
    real(dp) :: value
    real(dp), allocatable :: vector(:, :)
    real(dp) :: growth
    integer :: k, n, stat

    value = 0.0_dp
    n = self%steps
    if (n < 1) return
    allocate (vector(n, 1), stat=stat)
    if (stat /= 0) return
    ! Off the diagonal the matrix is positive, so that the signs of the vector that is sought alternate: to equal signs
    ! it may be orthogonal.
    vector(:, 1) = [(merge(1.0_dp, -1.0_dp, modulo(k, 2) == 1), k=1, n)]/sqrt(real(n, dp))
    growth = 0.0_dp
    do k = 1, INVERSE_ITERATIONS
      call dpttrs(n, 1, self%pivots, self%below, vector, n, stat)
      growth = norm2(vector)
      if (.not. (growth > 0.0_dp .and. growth <= huge(growth))) return
      vector = vector/growth
    end do
    value = 1.0_dp/growth
  end function smallest

end module fuge_lanczos_values
