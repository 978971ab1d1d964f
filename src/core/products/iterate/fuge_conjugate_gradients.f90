!> What conjugate gradients on a contact set work with, and what they find of its compliance.
module fuge_conjugate_gradients
  use fuge_kinds, only: dp
  use fuge_lanczos_values, only: lanczos_values
  use fuge_point_space, only: point_space
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  !> The contact set can be judged once the errors of the forces are below this fraction of the
  !> largest tension, or those of the gaps below this fraction of the deepest penetration.
  real(dp), parameter, public :: DECISIVE = 0.2_dp
  !> The preconditioned residual is measured where the residual is within this factor of the tolerance.
  real(dp), parameter, public :: NEARLY = 100.0_dp

  !> Vectors and numbers of conjugate gradients; scaled as forces and gaps of the scene are. There are no vectors before
  !> `prepare`: a search in single precision has its own, and a plain scene needs no others. Between runs the direction
  !> and `work` serve whoever makes forces feasible.
  type, public :: conjugate_gradients
    !> Gap plus displacement less motion, and the search direction (force), (n); both are zero off
    !> the contact set.
    real(dp), allocatable :: residual(:), direction(:)
    !> In turn the preconditioned residual and the displacement by `direction`, (n).
    real(dp), allocatable :: work(:)
    !> Forces at the start of the last run, (n); allocated once a run was prepared in which forces may grow without
    !> bound.
    real(dp), allocatable :: start(:)
    !> With modes: the largest residual norm since the last projection of the residual.
    real(dp) :: unprojected = 0.0_dp
    !> The residual has been reduced to the tolerance.
    logical :: converged = .false.
    !> Forces of the set that store no energy grow without bound, so that there is no solution.
    logical :: unbounded = .false.
    !> The coefficients of the last run that made steps.
    type(lanczos_values) :: lanczos = lanczos_values()
    !> The largest preconditioned residual over the largest residual, of one that is nearly small enough; force per
    !> length; 0 before any step.
    real(dp) :: amplification = 0.0_dp
    !> The least compliance of this contact set that has been found, length per force: the smallest value of `lanczos`
    !> over `amplification`; 0 before any step.
    real(dp) :: least_compliance = 0.0_dp
    !> The largest displacement by forces of size 1, as far as it has been needed; 0 before; length per force.
    real(dp) :: softness = 0.0_dp
  contains
    procedure :: prepare
    procedure :: note_least_compliance
  end type conjugate_gradients

contains

  !> Allocate those of the vectors for `n` points here that are not there yet, `start` where forces `may_grow` without
  !> bound. All ranks of `space` call it alike. Error, on any of them: FUGE_ERR_MEMORY.
  subroutine prepare(self, n, may_grow, space, info)
    class(conjugate_gradients), intent(inout) :: self
    integer, intent(in) :: n
    logical, intent(in) :: may_grow
    type(point_space), intent(in) :: space
    type(fuge_info), intent(inout) :: info
    integer :: stat

    if (allocated(self%work) .and. (allocated(self%start) .or. .not. may_grow)) return
    stat = 0
    if (.not. allocated(self%residual)) allocate (self%residual(n), stat=stat)
    if (stat == 0 .and. .not. allocated(self%direction)) allocate (self%direction(n), stat=stat)
    if (stat == 0 .and. .not. allocated(self%start) .and. may_grow) allocate (self%start(n), stat=stat)
    if (stat == 0 .and. .not. allocated(self%work)) allocate (self%work(n), stat=stat)
    call require_memory(stat, 'the work space of', n, 'points', info)
    call space%agree(info)
  end subroutine prepare

  !> Keep the least compliance that the last run has found on this set.
  subroutine note_least_compliance(self)
    class(conjugate_gradients), intent(inout) :: self
    real(dp) :: value

    value = self%lanczos%smallest()
    if (.not. (value > 0.0_dp .and. self%amplification > 0.0_dp)) return
    value = value/self%amplification
    if (self%least_compliance > 0.0_dp) value = min(value, self%least_compliance)
    self%least_compliance = value
  end subroutine note_least_compliance

end module fuge_conjugate_gradients
