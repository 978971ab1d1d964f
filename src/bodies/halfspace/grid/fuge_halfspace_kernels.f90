!> The kernels of a grid on the half-space, computed when they are first needed: by the threads of a solve, and so that
!> one which needs few of them, on a window of a large grid, has none of the size of the grid.
module fuge_halfspace_kernels
  use, intrinsic :: iso_c_binding, only: c_associated, c_loc, c_null_ptr, c_ptr
  use fuge_grid_convolution, only: grid_kernel
  use fuge_grid_plan, only: grid_plan
  use fuge_halfspace_grid, only: halfspace_grid
  use fuge_kinds, only: dp
  use fuge_locks, only: lock, unlock, LOCK_KERNELS
  use fuge_single_grid_convolution, only: round_kernel, single_kernel => grid_kernel
  use fuge_status, only: fuge_info, FUGE_DONE
  implicit none
  private

  public :: bytes_in_slices, multiply_in_slices

  !> Slices of a product without a kernel, and how many of their kernels are computed together: 5 bytes for each cell.
  integer, parameter :: SLICES = 16, TOGETHER = 8

  !> The eigenvalues of the circulant matrix that holds A, and those of the preconditioner's, the inverse of a periodic
  !> surface; the same in single precision, where the numbers allow it.
  type, public :: halfspace_kernels
    type(grid_kernel) :: influence, inverse
    type(single_kernel) :: single_influence, single_inverse
    !> Those in single precision are computed, or cannot be.
    logical :: rounded = .false.
  contains
    procedure :: has_double
    procedure :: has_single
  end type halfspace_kernels

  !> The kernels that an operator owns; a bitwise copy of it does not.
  type, public :: kernel_store
    type(halfspace_kernels), pointer :: kernels => null()
    !> Address of the variable that owns the kernels.
    type(c_ptr), private :: owner = c_null_ptr
  contains
    procedure :: create
    procedure :: clear
    procedure :: move_from
    procedure :: copy_from
    procedure :: compute_all
    procedure :: require_double
    procedure :: require_single
    final :: finish
  end type kernel_store

contains

  !> Room for kernels. `status` as in an allocate statement.
  subroutine create(self, status)
    class(kernel_store), intent(inout), target :: self
    integer, intent(out) :: status

    call self%clear()
    allocate (self%kernels, stat=status)
    if (status == 0) self%owner = c_loc(self%owner)
  end subroutine create

  !> Free the kernels if this variable owns them.
  subroutine clear(self)
    class(kernel_store), intent(inout), target :: self

    if (owns_kernels(self)) deallocate (self%kernels)
    nullify (self%kernels)
    self%owner = c_null_ptr
  end subroutine clear

  function owns_kernels(store) result(owns)
    class(kernel_store), intent(in), target :: store
    logical :: owns

    owns = .false.
    if (c_associated(store%owner)) owns = c_associated(store%owner, c_loc(store%owner))
  end function owns_kernels

  !> Move the kernels from `source`, which has none afterwards.
  subroutine move_from(self, source)
    class(kernel_store), intent(inout), target :: self, source

    call self%clear()
    if (.not. owns_kernels(source)) return
    self%kernels => source%kernels
    self%owner = c_loc(self%owner)
    nullify (source%kernels)
    source%owner = c_null_ptr
  end subroutine move_from

  !> Copy the kernels. `status` is not 0 without memory, and there are none then.
  subroutine copy_from(self, source, status)
    class(kernel_store), intent(inout), target :: self
    class(kernel_store), intent(in) :: source
    integer, intent(out) :: status

    status = 0
    ! The source may be a bitwise copy of self that shares them.
    if (associated(self%kernels, source%kernels) .and. owns_kernels(self)) return
    call self%clear()
    if (.not. associated(source%kernels)) return
    call self%create(status)
    if (status /= 0) return
    ! Another thread may just be computing those of the source.
    call lock(LOCK_KERNELS)
    call self%kernels%influence%copy_from(source%kernels%influence, status)
    if (status == 0) call self%kernels%inverse%copy_from(source%kernels%inverse, status)
    if (status == 0) call self%kernels%single_influence%copy_from(source%kernels%single_influence, status)
    if (status == 0) call self%kernels%single_inverse%copy_from(source%kernels%single_inverse, status)
    self%kernels%rounded = source%kernels%rounded
    call unlock(LOCK_KERNELS)
    if (status /= 0) call self%clear()
  end subroutine copy_from

  impure elemental subroutine finish(self)
    type(kernel_store), intent(inout) :: self

    call self%clear()
  end subroutine finish

  !> Compute the kernels in double precision unless they are there, on the circles of `plan`. Several threads may ask at
  !> once. `status`: 0, else memory is short.
  subroutine require_double(self, grid, plan, status)
    class(kernel_store), intent(in) :: self
    type(halfspace_grid), intent(in) :: grid
    type(grid_plan), intent(in) :: plan
    integer, intent(out) :: status

    status = 0
    call lock(LOCK_KERNELS)
    if (.not. self%kernels%has_double()) call compute_later(self%kernels, grid, plan, status)
    call unlock(LOCK_KERNELS)
  end subroutine require_double

  !> Compute the kernels in single precision unless that was done, or their numbers were out of range: from those in
  !> double precision, which are not kept if they are not there. Several threads may ask at once. Where memory is too
  !> short for these, there are none this time: `has`, are there any?
  subroutine require_single(self, grid, plan, has)
    class(kernel_store), intent(in) :: self
    type(halfspace_grid), intent(in) :: grid
    type(grid_plan), intent(in) :: plan
    logical, intent(out) :: has
    type(halfspace_kernels) :: double
    integer :: status

    call lock(LOCK_KERNELS)
    associate (kernels => self%kernels)
      if (.not. kernels%rounded) then
        status = 0
        if (kernels%has_double()) then
          call round_both(kernels%influence, kernels%inverse, kernels%single_influence, kernels%single_inverse)
        else
          call compute_later(double, grid, plan, status)
          if (status == 0) call round_both(double%influence, double%inverse, kernels%single_influence, &
                                           kernels%single_inverse)
        end if
        kernels%rounded = status == 0
      end if
      has = kernels%has_single()
    end associate
    call unlock(LOCK_KERNELS)
  end subroutine require_single

  !> Are there kernels in double precision? The caller holds the lock where other threads may compute them.
  function has_double(self) result(has)
    class(halfspace_kernels), intent(in) :: self
    logical :: has

    has = self%influence%is_set() .and. self%inverse%is_set()
  end function has_double

  !> As has_double.
  function has_single(self) result(has)
    class(halfspace_kernels), intent(in) :: self
    logical :: has

    has = self%single_influence%is_set() .and. self%single_inverse%is_set()
  end function has_single

  !> Compute the kernels in double precision of an operator that did without so far, if the machine has the memory.
  subroutine compute_later(kernels, grid, plan, status)
    use fuge_halfspace_spectra, only: bytes_needed
    use fuge_memory, only: check_memory
    type(halfspace_kernels), intent(inout) :: kernels
    type(halfspace_grid), intent(in) :: grid
    type(grid_plan), intent(in) :: plan
    integer, intent(out) :: status
    type(fuge_info) :: info
    real(dp) :: no_datum

    no_datum = 0.0_dp
    call check_memory(bytes_needed(grid, plan%length), 'kernels', info)
    status = info%status
    if (status == FUGE_DONE) call compute_double(kernels, grid, plan, no_datum, status)
  end subroutine compute_later

  !> Compute all kernels, those in single precision if that is `suited` to them. No other thread may know the store yet.
  !> `datum` is what is subtracted from all coefficients. `status`: 0, else memory is short.
  subroutine compute_all(self, grid, plan, suited, datum, status)
    class(kernel_store), intent(in) :: self
    type(halfspace_grid), intent(in) :: grid
    type(grid_plan), intent(in) :: plan
    logical, intent(in) :: suited
    real(dp), intent(inout) :: datum
    integer, intent(out) :: status

    call compute_double(self%kernels, grid, plan, datum, status)
    self%kernels%rounded = .true.
    if (status == 0 .and. suited) call round_both(self%kernels%influence, self%kernels%inverse, &
                                                  self%kernels%single_influence, self%kernels%single_inverse)
  end subroutine compute_all

  subroutine compute_double(kernels, grid, plan, datum, status)
    use fuge_halfspace_spectra, only: compute_spectra
    type(halfspace_kernels), intent(inout) :: kernels
    type(halfspace_grid), intent(in) :: grid
    type(grid_plan), intent(in) :: plan
    real(dp), intent(inout) :: datum
    integer, intent(out) :: status
    type(grid_kernel) :: influence, inverse

    call compute_spectra(grid, plan, influence, inverse, datum, status)
    if (status /= 0) return
    call kernels%influence%move_from(influence)
    call kernels%inverse%move_from(inverse)
  end subroutine compute_double

  !> Round the kernels. Where memory is short, or the numbers are out of range, there are none in single precision.
  subroutine round_both(influence, inverse, single_influence, single_inverse)
    type(grid_kernel), intent(in) :: influence, inverse
    type(single_kernel), intent(inout) :: single_influence, single_inverse
    integer :: status

    call round_kernel(inverse, single_inverse, status)
    if (status == 0) call round_kernel(influence, single_influence, status)
  end subroutine round_both

  !> u = A f on a free surface without a kernel, on the `n` cells of `grid` and `plan`; `status` as for
  !> convolve_in_slices.
  subroutine multiply_in_slices(grid, plan, n, force, displacement, status)
    use fuge_halfspace_spectra, only: grid_values
    use fuge_sliced_convolution, only: convolve_in_slices
    type(halfspace_grid), intent(in) :: grid
    type(grid_plan), intent(in) :: plan
    integer, intent(in) :: n
    real(dp), intent(in) :: force(n)
    real(dp), intent(inout) :: displacement(n)
    integer, intent(out) :: status

    call convolve_in_slices(plan, grid_values(grid), SLICES, TOGETHER, n, force, displacement, status)
  end subroutine multiply_in_slices

  !> What a product in slices needs, on a circle of 2 `rows` rows.
  pure function bytes_in_slices(grid, rows) result(bytes)
    type(halfspace_grid), intent(in) :: grid
    integer, intent(in) :: rows
    real(dp) :: bytes

    bytes = (8.0_dp*TOGETHER*(rows + 1) + 16.0_dp*grid%cells(2))*grid%cells(1)/SLICES
  end function bytes_in_slices

end module fuge_halfspace_kernels
