!> What a rank needs for products of a surface that ranks share: as one of several, or as the only one that has rows.
module fuge_slab_products
  use fuge_grid_convolution, only: grid_kernel
  use fuge_grid_plan, only: grid_plan
  use fuge_halfspace_grid, only: circle_of, cyclic, halfspace_grid
  use fuge_halfspace_spectra, only: bytes_needed, compute_spectra
  use fuge_kinds, only: dp
  use fuge_memory, only: check_memory
  use fuge_number_text, only: text
  use fuge_rank_communicator, only: free_communicator, members_here, rank_communicator, split_communicator
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
  end type shared_products

  !> The only one.
  type :: whole_products
    type(grid_plan) :: plan
    type(grid_kernel) :: influence, inverse
  end type whole_products

  !> It must not be copied.
  type, public :: slab_products
    private
    !> The ranks that have rows.
    type(rank_communicator) :: holders
    !> Of these one is associated, on ranks that have rows.
    type(shared_products), pointer :: shared => null()
    type(whole_products), pointer :: whole => null()
  contains
    procedure :: multiply
    procedure :: precondition
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
  end subroutine prepare_products

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
      call self%shared%plan%free()
      deallocate (self%shared)
    end if
    if (associated(self%whole)) deallocate (self%whole)
    call free_communicator(self%holders)
  end subroutine free

end module fuge_slab_products
