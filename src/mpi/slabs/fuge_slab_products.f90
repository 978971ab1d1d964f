!> What a rank needs for products of a surface that ranks share: as one of several, or as the only one that has rows.
module fuge_slab_products
  use fuge_grid_convolution, only: grid_kernel
  use fuge_grid_plan, only: grid_plan
  use fuge_halfspace_grid, only: circle_of, cyclic, halfspace_grid
  use fuge_halfspace_spectra, only: bytes_needed, compute_spectra
  use fuge_kinds, only: dp, sp
  use fuge_memory, only: check_memory
  use fuge_number_text, only: text
  use fuge_rank_communicator, only: free_communicator, members_here, rank_communicator, split_communicator
  use fuge_single_grid_convolution, only: round_grid_kernel => round_kernel, single_grid_kernel => grid_kernel
  use fuge_single_grid_plan, only: single_grid_plan => grid_plan
  use fuge_single_slab_convolution, only: round_kernel, single_kernel => slab_kernel
  use fuge_single_slab_plan, only: single_plan => slab_plan
  use fuge_slab_convolution, only: slab_kernel
  use fuge_slab_plan, only: slab_plan
  use fuge_slab_rows, only: active_ranks
  use fuge_slab_spectra, only: compute_slab_spectra
  use fuge_status, only: fuge_info, report, require_memory, FUGE_DONE, FUGE_ERR_MEMORY
  implicit none
  private

  public :: prepare_products

  !> One of several ranks.
  type :: shared_products
    type(slab_plan) :: plan
    type(slab_kernel) :: influence, inverse
    !> The same in single precision, in the memory of the other plan.
    type(single_plan) :: single
    type(single_kernel) :: single_influence, single_inverse
  end type shared_products

  !> The only one.
  type :: whole_products
    type(grid_plan) :: plan
    type(grid_kernel) :: influence, inverse
    !> The same in single precision.
    type(single_grid_plan) :: single
    type(single_grid_kernel) :: single_influence, single_inverse
  end type whole_products

  !> It must not be copied.
  type, public :: slab_products
    private
    !> The ranks that have rows.
    type(rank_communicator) :: holders
    !> Of these one is associated, on ranks that have rows.
    type(shared_products), pointer :: shared => null()
    type(whole_products), pointer :: whole => null()
    !> All ranks have what products in single precision need.
    logical, public :: has_single = .false.
  contains
    procedure :: multiply
    procedure :: multiply_single
    procedure :: precondition
    procedure :: precondition_single
    procedure :: precondition_on_bed
    procedure :: free
  end type slab_products

contains

  !> Plan and compute what belongs to the cells of `surface`. All ranks of `group` call it. Errors, on all of them:
  !> FUGE_ERR_MEMORY.
  subroutine prepare_products(products, surface, group, measured, info)
    type(slab_products), intent(inout) :: products
    type(halfspace_grid), intent(in) :: surface
    type(rank_communicator), intent(in) :: group
    logical, intent(in) :: measured
    type(fuge_info), intent(inout) :: info
    integer :: active, here, length(2), stat

    active = active_ranks(surface%cells, group%members())
    here = members_here(group, active)
    call circle_of(surface, length, info)
    if (info%failed()) return
    stat = 0
    if (group%number() < active) then
      call check_memory(bytes_needed(surface, length)*real(here, dp)/real(active, dp), &
                        'the part of the ranks on this machine', info)
      if (active > 1) then
        allocate (products%shared, stat=stat)
      else
        allocate (products%whole, stat=stat)
      end if
      call require_memory(stat, 'an operator', info)
    end if
    call group%agree(info)
    if (info%failed()) return
    if (active > 1) call split_communicator(group, active, products%holders)
    if (associated(products%shared)) then
      call prepare_shared(surface, length, products%holders, group%members(), measured, products%shared, info)
    else if (associated(products%whole)) then
      call prepare_whole(surface, length, measured, products%whole, info)
    end if
    call group%agree(info)
    if (info%failed() .or. any(surface%cells < 2)) return
    call prepare_single(surface, length, group, measured, products)
  end subroutine prepare_products

  !> What products in single precision need. Where memory is short, or the numbers are out of range, on any rank, there
  !> are none.
  subroutine prepare_single(surface, length, group, measured, products)
    type(halfspace_grid), intent(in) :: surface
    integer, intent(in) :: length(2)
    type(rank_communicator), intent(in) :: group
    logical, intent(in) :: measured
    type(slab_products), intent(inout) :: products
    type(fuge_info) :: info
    real(dp) :: failed(1)
    integer :: status

    status = FUGE_DONE
    if (associated(products%shared)) then
      associate (shared => products%shared)
        call shared%single%set(products%holders, surface%cells, length, &
                               .not. cyclic(surface) .and. surface%cells > 1, group%members(), measured, info, &
                               shared%plan%memory(:2))
        call products%holders%agree(info)
        status = info%status
        if (status == FUGE_DONE) call round_kernel(shared%inverse, shared%single, shared%single_inverse, status)
        if (status == FUGE_DONE) call round_kernel(shared%influence, shared%single, shared%single_influence, status)
      end associate
    else if (associated(products%whole)) then
      associate (whole => products%whole)
        ! Lines of an odd number of cells would not be aligned.
        status = merge(FUGE_DONE, 1, all(mod(length, 2) == 0))
        if (status == FUGE_DONE) call whole%single%set(surface%cells, length, info, measured)
        if (info%failed()) status = info%status
        if (status == FUGE_DONE) call round_grid_kernel(whole%inverse, whole%single_inverse, status)
        if (status == FUGE_DONE) call round_grid_kernel(whole%influence, whole%single_influence, status)
      end associate
    end if
    failed = merge(0.0_dp, 1.0_dp, status == FUGE_DONE)
    call group%raise(failed)
    products%has_single = .not. failed(1) > 0.0_dp
    if (associated(products%shared) .and. .not. products%has_single) call free_single(products%shared)
  end subroutine prepare_single

  !> Free what products in single precision need.
  subroutine free_single(shared)
    type(shared_products), intent(inout) :: shared

    call shared%single_influence%free()
    call shared%single_inverse%free()
    call shared%single%free()
  end subroutine free_single

  !> What one of several ranks needs, of the `ranks` on which the rows are laid out, `holders` have any. Errors, on
  !> all these: FUGE_ERR_MEMORY.
  subroutine prepare_shared(surface, length, holders, ranks, measured, shared, info)
    type(halfspace_grid), intent(in) :: surface
    integer, intent(in) :: length(2), ranks
    type(rank_communicator), intent(in) :: holders
    logical, intent(in) :: measured
    type(shared_products), intent(inout) :: shared
    type(fuge_info), intent(inout) :: info
    logical :: padded(2)

    padded = .not. cyclic(surface) .and. surface%cells > 1
    call shared%plan%set(holders, surface%cells, length, padded, ranks, measured, info)
    call holders%agree(info)
    if (.not. info%failed()) call compute_slab_spectra(surface, shared%plan, padded, shared%influence, shared%inverse, &
                                                       info)
  end subroutine prepare_shared

  !> What the only rank that has rows needs. Errors: FUGE_ERR_MEMORY.
  subroutine prepare_whole(surface, length, measured, whole, info)
    type(halfspace_grid), intent(in) :: surface
    integer, intent(in) :: length(2)
    logical, intent(in) :: measured
    type(whole_products), intent(inout) :: whole
    type(fuge_info), intent(inout) :: info
    real(dp) :: datum
    integer :: status

    datum = 0.0_dp
    call whole%plan%set(surface%cells, length, info, measured)
    if (info%failed()) return
    call compute_spectra(surface, whole%plan, whole%influence, whole%inverse, datum, status)
    if (status /= 0) call report(info, FUGE_ERR_MEMORY, 'no memory for nx = '//text(surface%cells(1))//', ny = ' &
                                 //text(surface%cells(2))//': use a coarser grid')
  end subroutine prepare_whole

  !> u = A f, both of the points of this rank. `status`: 0 or FUGE_ERR_MEMORY.
  subroutine multiply(self, force, displacement, status)
    class(slab_products), intent(in) :: self
    real(dp), intent(in) :: force(:)
    real(dp), intent(inout) :: displacement(:)
    integer, intent(out) :: status

    status = FUGE_DONE
    if (associated(self%shared)) then
      call self%shared%influence%convolve(self%shared%plan, force, displacement)
    else if (associated(self%whole)) then
      call self%whole%influence%convolve(self%whole%plan, size(force), force, displacement, status)
    end if
  end subroutine multiply

  !> As `multiply`, in single precision; only where `has_single`.
  subroutine multiply_single(self, force, displacement, status)
    class(slab_products), intent(in) :: self
    real(sp), intent(in) :: force(:)
    real(sp), intent(inout) :: displacement(:)
    integer, intent(out) :: status

    status = FUGE_DONE
    if (associated(self%shared)) then
      call self%shared%single_influence%convolve(self%shared%single, force, displacement)
    else if (associated(self%whole)) then
      call self%whole%single_influence%convolve(self%whole%single, size(force), force, displacement, status)
    end if
  end subroutine multiply_single

  !> The preconditioner, both of the points of this rank. `status` as for `multiply`.
  subroutine precondition(self, displacement, force, status)
    class(slab_products), intent(in) :: self
    real(dp), intent(in) :: displacement(:)
    real(dp), intent(inout) :: force(:)
    integer, intent(out) :: status

    status = FUGE_DONE
    if (associated(self%shared)) then
      call self%shared%inverse%convolve(self%shared%plan, displacement, force)
    else if (associated(self%whole)) then
      call self%whole%inverse%convolve(self%whole%plan, size(force), displacement, force, status)
    end if
  end subroutine precondition

  !> As `precondition`, in single precision; only where `has_single`.
  subroutine precondition_single(self, displacement, force, status)
    class(slab_products), intent(in) :: self
    real(sp), intent(in) :: displacement(:)
    real(sp), intent(inout) :: force(:)
    integer, intent(out) :: status

    status = FUGE_DONE
    if (associated(self%shared)) then
      call self%shared%single_inverse%convolve(self%shared%single, displacement, force)
    else if (associated(self%whole)) then
      call self%whole%single_inverse%convolve(self%whole%single, size(force), displacement, force, status)
    end if
  end subroutine precondition_single

  !> As `precondition`, on a bed of the `compliance`, length per force.
  subroutine precondition_on_bed(self, compliance, displacement, force, status)
    class(slab_products), intent(in) :: self
    real(dp), intent(in) :: compliance, displacement(:)
    real(dp), intent(inout) :: force(:)
    integer, intent(out) :: status

    status = FUGE_DONE
    if (associated(self%shared)) then
      call self%shared%inverse%convolve(self%shared%plan, displacement, force, compliance)
    else if (associated(self%whole)) then
      call self%whole%inverse%convolve(self%whole%plan, size(force), displacement, force, status, compliance)
    end if
  end subroutine precondition_on_bed

  !> Free what they own; all ranks call it.
  subroutine free(self)
    class(slab_products), intent(inout) :: self

    if (associated(self%shared)) then
      call self%shared%influence%free()
      call self%shared%inverse%free()
      call free_single(self%shared)
      call self%shared%plan%free()
      deallocate (self%shared)
    end if
    if (associated(self%whole)) deallocate (self%whole)
    call free_communicator(self%holders)
  end subroutine free

end module fuge_slab_products
