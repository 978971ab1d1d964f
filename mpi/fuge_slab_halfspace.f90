!> The elastic half-space on a uniform grid of rectangles whose rows the ranks of an MPI communicator share.
module fuge_slab_halfspace
  use, intrinsic :: iso_c_binding, only: c_associated, c_loc, c_null_ptr, c_ptr
  use fuge_grid_convolution, only: grid_kernel
  use fuge_grid_plan, only: fast_length, grid_plan
  use fuge_grid_store, only: grid_store
  use fuge_halfplane_fft, only: FUGE_FREE, FUGE_PERIODIC
  use fuge_halfspace_grid, only: check_grid, coarsened, complete, count_coarser, cyclic, halfspace_grid, periodic, &
    term_length, MEAN_TERM, MOST_CELLS
  use fuge_halfspace_spectra, only: bytes_needed, compute_spectra
  use fuge_input_checks, only: is_finite_everywhere
  use fuge_kinds, only: dp
  use fuge_memory, only: check_memory
  use fuge_number_text, only: text
  use fuge_operator_type, only: fuge_operator
  use fuge_rank_communicator, only: check_mpi, free_communicator, new_communicator, rank_communicator, &
    split_communicator
  use fuge_ranks, only: shared_ranks
  use fuge_slab_convolution, only: slab_kernel
  use fuge_slab_plan, only: slab_plan
  use fuge_slab_rows, only: active_ranks, rows_of_ranks => first_rows
  use fuge_slab_spectra, only: compute_slab_spectra
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_CALL_ORDER, FUGE_ERR_MEMORY, FUGE_ERR_OPTION, &
    FUGE_ERR_SIZE, FUGE_ERR_UNSUPPORTED
  use mpi_f08, only: MPI_Comm
  implicit none
  private

  !> What several ranks need for products.
  type :: slab_parts
    type(slab_plan) :: plan
    type(slab_kernel) :: influence, inverse
  end type slab_parts

  !> What one rank needs for products, if it has all rows.
  type :: whole_parts
    type(grid_plan) :: plan
    type(grid_kernel) :: influence, inverse
  end type whole_parts

  !> Equal rectangles in a grid on a half-space, whose rows ranks share: call `set` on all ranks of a communicator, then
  !> solve on all of them; `own_rows` says which rows the gaps and the forces of a rank are those of.
  !>
  !> All ranks call the same procedures in the same order, with the same arguments but for arrays of points. Before
  !> MPI_Finalize let it go out of scope, or `free` it.
  type, extends(fuge_operator), public :: fuge_mpi_halfspace_operator
    private
    !> No cells before `set`.
    type(halfspace_grid) :: surface
    logical :: measured = .false.
    !> All ranks; coarser grids refer to those of the finest one.
    type(rank_communicator), pointer :: group => null()
    !> Those that have rows.
    type(rank_communicator) :: part
    !> Of these one is associated, on ranks that have rows.
    type(slab_parts), pointer :: slabs => null()
    type(whole_parts), pointer :: whole => null()
    type(grid_store) :: coarser
    !> Addresses of the variables that own the group, and the rest.
    type(c_ptr) :: group_owner = c_null_ptr, owner = c_null_ptr
  contains
    procedure :: set
    procedure :: own_rows
    procedure :: comm
    procedure :: free
    procedure :: points
    procedure :: apply
    procedure :: apply_with_magnitude
    procedure :: magnitude => slab_magnitude
    procedure :: has_preconditioner
    procedure :: precondition
    procedure :: grid
    procedure :: coarsen
    procedure :: kept_coarser
    procedure :: free_rim
    procedure :: window
    procedure :: ranks
    procedure :: first_rows
    procedure, private :: copy
    generic :: assignment(=) => copy
    final :: finish
  end type fuge_mpi_halfspace_operator

contains

  !> Set the operator of `nx` x `ny` cells, as that of `fuge_halfspace_operator`, on all ranks of `comm`: point
  !> i + nx*(j - 1) of a rank is the cell in column i of its row j.
  !>
  !> `comm` is duplicated. `nx`, `ny`, `spacing_x`, `spacing_y`, `e_star`, `element`, `measured` as for
  !> `fuge_halfspace_operator`, the same on all ranks; `boundary` FUGE_FREE (default) or FUGE_PERIODIC. A rank has pairs
  !> of rows, one after the other; where there are few cells the last ranks have none.
  !> The arguments are more than eight, because the last three are optional and named by the caller.
  !> Errors, on all ranks, which leave the operator as it was: those of `fuge_halfspace_operator`, FUGE_ERR_OPTION if
  !> the arguments differ, FUGE_ERR_UNSUPPORTED for another boundary, FUGE_ERR_CALL_ORDER, on this rank, if MPI is not
  !> running.
  subroutine set(self, nx, ny, spacing_x, spacing_y, e_star, comm, info, element, boundary, measured)
    class(fuge_mpi_halfspace_operator), intent(inout) :: self
    integer, intent(in) :: nx, ny
    real(dp), intent(in) :: spacing_x, spacing_y, e_star
    type(MPI_Comm), intent(in) :: comm
    type(fuge_info), intent(out) :: info
    integer, intent(in), optional :: element, boundary
    logical, intent(in), optional :: measured
    type(fuge_mpi_halfspace_operator) :: new
    integer :: stat

    call check_mpi(info)
    if (info%failed()) return
    allocate (new%group, stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for a communicator')
      return
    end if
    call own_group(new)
    call new_communicator(comm, new%group)
    new%surface%cells = [nx, ny]
    new%surface%spacing = [spacing_x, spacing_y]
    new%surface%e_star = e_star
    if (present(element)) new%surface%element = element
    if (present(boundary)) new%surface%boundary = boundary
    if (present(measured)) new%measured = measured
    call check_arguments(new, info)
    if (.not. info%failed()) then
      call complete(new%surface)
      call prepare(new, info)
    end if
    if (.not. info%failed()) call move_contents(self, new)
  end subroutine set

  !> Refuse what makes no grid, other boundaries, and arguments that differ between the ranks.
  subroutine check_arguments(operator, info)
    type(fuge_mpi_halfspace_operator), intent(in) :: operator
    type(fuge_info), intent(inout) :: info
    real(dp) :: mine(8), extremes(16)

    call check_grid(operator%surface, info)
    if (.not. info%failed() .and. all(operator%surface%boundary /= [FUGE_FREE, FUGE_PERIODIC])) then
      call report(info, FUGE_ERR_UNSUPPORTED, 'boundary = '//text(operator%surface%boundary) &
                  //': ranks share surfaces that are FUGE_FREE or FUGE_PERIODIC only')
    end if
    call operator%group%agree(info)
    if (info%failed()) return
    mine = [real(operator%surface%cells, dp), operator%surface%spacing, operator%surface%e_star, &
            real([operator%surface%element, operator%surface%boundary, merge(1, 0, operator%measured)], dp)]
    extremes = [mine, -mine]
    call operator%group%raise(extremes)
    if (any(abs(extremes(:8) + extremes(9:)) > 0.0_dp)) then
      call report(info, FUGE_ERR_OPTION, 'the grid differs between the ranks: pass the same nx, ny, spacings, e_star ' &
                  //'and options on all of them')
    end if
  end subroutine check_arguments

  !> Plan and compute what belongs to the cells of `operator`. Errors, on all ranks: FUGE_ERR_MEMORY.
  subroutine prepare(operator, info)
    type(fuge_mpi_halfspace_operator), intent(inout), target :: operator
    type(fuge_info), intent(inout) :: info
    integer :: active, length(2), stat

    operator%owner = c_loc(operator%measured)
    active = active_ranks(operator%surface%cells, operator%group%members())
    length = operator%surface%cells
    where (.not. cyclic(operator%surface) .and. length > 1) length = [fast_length(length(1)), fast_length(length(2))]
    if (any(length < 1) .or. any(length > MOST_CELLS)) then
      call report(info, FUGE_ERR_MEMORY, 'nx = '//text(operator%surface%cells(1))//', ny = ' &
                  //text(operator%surface%cells(2))//': a direction has at most '//text(MOST_CELLS)//' cells')
      return
    end if
    stat = 0
    if (operator%group%number() < active) then
      call check_memory(bytes_needed(operator%surface, length)/real(active, dp), 'the part of a rank', info)
      if (active > 1) then
        allocate (operator%slabs, stat=stat)
      else
        allocate (operator%whole, stat=stat)
      end if
      if (stat /= 0) call report(info, FUGE_ERR_MEMORY, 'no memory for an operator')
    end if
    call operator%group%agree(info)
    if (info%failed()) return
    if (active > 1) call split_communicator(operator%group, active, operator%part)
    if (associated(operator%slabs)) then
      call prepare_slabs(operator, length, operator%slabs, info)
    else if (associated(operator%whole)) then
      call prepare_whole(operator, length, operator%whole, info)
    end if
    call operator%group%agree(info)
    if (.not. info%failed()) call operator%coarser%create(count_coarser(operator%surface))
  end subroutine prepare

  !> What one of several ranks needs. Errors, on all ranks that have rows: FUGE_ERR_MEMORY, FUGE_ERR_OPTION.
  subroutine prepare_slabs(operator, length, slabs, info)
    type(fuge_mpi_halfspace_operator), intent(in) :: operator
    integer, intent(in) :: length(2)
    type(slab_parts), intent(inout) :: slabs
    type(fuge_info), intent(inout) :: info
    logical :: padded(2)

    padded = .not. cyclic(operator%surface) .and. operator%surface%cells > 1
    call slabs%plan%set(operator%part, operator%surface%cells, length, padded, operator%group%members(), &
                        operator%measured, info)
    call operator%part%agree(info)
    if (.not. info%failed()) call compute_slab_spectra(operator%surface, slabs%plan, padded, slabs%influence, &
                                                       slabs%inverse, info)
  end subroutine prepare_slabs

  !> What the only rank that has rows needs.
  subroutine prepare_whole(operator, length, whole, info)
    type(fuge_mpi_halfspace_operator), intent(in) :: operator
    integer, intent(in) :: length(2)
    type(whole_parts), intent(inout) :: whole
    type(fuge_info), intent(inout) :: info
    real(dp) :: datum
    integer :: status

    datum = 0.0_dp
    call whole%plan%set(operator%surface%cells, length, info, operator%measured)
    if (info%failed()) return
    call compute_spectra(operator%surface, whole%plan, whole%influence, whole%inverse, datum, status)
    if (status /= 0) call report(info, FUGE_ERR_MEMORY, 'no memory for nx = '//text(operator%surface%cells(1)) &
                                 //', ny = '//text(operator%surface%cells(2))//': use a coarser grid')
  end subroutine prepare_whole

  !> Move the contents of `new` to `self`.
  subroutine move_contents(self, new)
    class(fuge_mpi_halfspace_operator), intent(inout), target :: self
    type(fuge_mpi_halfspace_operator), intent(inout) :: new

    call self%free()
    self%surface = new%surface
    self%measured = new%measured
    self%group => new%group
    self%part = new%part
    self%slabs => new%slabs
    self%whole => new%whole
    call self%coarser%move_from(new%coarser)
    call own_group(self)
    self%owner = c_loc(self%measured)
    new%owner = c_null_ptr
    new%group_owner = c_null_ptr
    call new%free()
  end subroutine move_contents

  !> Become the owner of the group. The address is only compared, never dereferenced.
  subroutine own_group(self)
    class(fuge_mpi_halfspace_operator), intent(inout), target :: self

    self%group_owner = c_loc(self%surface%boundary)
  end subroutine own_group

  !> Free what the operator owns; all ranks call it, before MPI_Finalize.
  subroutine free(self)
    class(fuge_mpi_halfspace_operator), intent(inout), target :: self

    call self%coarser%clear()
    if (owns(self%owner, c_loc(self%measured))) then
      if (associated(self%slabs)) then
        call self%slabs%influence%free()
        call self%slabs%inverse%free()
        call self%slabs%plan%free()
        deallocate (self%slabs)
      end if
      if (associated(self%whole)) deallocate (self%whole)
      call free_communicator(self%part)
    end if
    if (owns(self%group_owner, c_loc(self%surface%boundary))) then
      call free_communicator(self%group)
      deallocate (self%group)
    end if
    self%part = rank_communicator()
    nullify (self%slabs, self%whole, self%group)
    self%owner = c_null_ptr
    self%group_owner = c_null_ptr
    self%surface%cells = 0
  end subroutine free

  !> Is the variable at the address `here` the owner?
  pure function owns(owner, here)
    type(c_ptr), intent(in) :: owner, here
    logical :: owns

    owns = c_associated(owner)
    if (owns) owns = c_associated(owner, here)
  end function owns

  impure elemental subroutine finish(self)
    type(fuge_mpi_halfspace_operator), intent(inout) :: self

    call self%free()
  end subroutine finish

  !> Assignment: compute everything anew, because each variable frees its own. All ranks assign together; without memory
  !> the copy is not set.
  subroutine copy(self, source)
    class(fuge_mpi_halfspace_operator), intent(inout) :: self
    class(fuge_mpi_halfspace_operator), intent(in) :: source
    type(fuge_mpi_halfspace_operator) :: new
    type(fuge_info) :: info

    if (all(source%surface%cells > 0)) then
      call new%set(source%surface%cells(1), source%surface%cells(2), source%surface%spacing(1), &
                   source%surface%spacing(2), source%surface%e_star, source%group%comm(), info, &
                   element=source%surface%element, boundary=source%surface%boundary, measured=source%measured)
    end if
    call move_contents(self, new)
  end subroutine copy

  !> The first and the last row of this rank, from 1; [1, 0] where it has none, and before `set`.
  pure function own_rows(self) result(rows)
    class(fuge_mpi_halfspace_operator), intent(in) :: self
    integer :: rows(2)

    rows = [1, 0]
    if (any(self%surface%cells < 1)) return
    associate (first => rows_of_ranks(self%surface%cells, self%group%members()), me => self%group%number() + 1)
      if (first(me + 1) > first(me)) rows = [first(me), first(me + 1) - 1]
    end associate
  end function own_rows

  !> The communicator of the operator, a duplicate of that of `set`; only after `set`.
  function comm(self)
    class(fuge_mpi_halfspace_operator), intent(in) :: self
    type(MPI_Comm) :: comm

    comm = self%group%comm()
  end function comm

  !> Number of points of this rank; 0 before `set`, and where it has no rows.
  pure function points(self) result(n)
    class(fuge_mpi_halfspace_operator), intent(in) :: self
    integer :: n
    integer :: rows(2)

    rows = self%own_rows()
    n = self%surface%cells(1)*(rows(2) - rows(1) + 1)
  end function points

  !> u = A f, as that of `fuge_halfspace_operator`; `force` and `displacement` (points of this rank). All ranks call it.
  !> `status`, the same on all ranks: 0, FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE; FUGE_ERR_MEMORY on one rank.
  subroutine apply(self, force, displacement, status)
    class(fuge_mpi_halfspace_operator), intent(in) :: self
    real(dp), intent(in) :: force(:)
    real(dp), intent(out) :: displacement(:)
    integer, intent(out) :: status

    call check_sizes(self, size(force), size(displacement), status)
    if (status /= FUGE_DONE) return
    if (associated(self%slabs)) then
      call self%slabs%influence%convolve(self%slabs%plan, force, displacement)
    else if (associated(self%whole)) then
      call self%whole%influence%convolve(self%whole%plan, size(force), force, displacement, 1, status)
    end if
  end subroutine apply

  !> Arrays of the right size on all ranks?
  subroutine check_sizes(self, first, second, status)
    class(fuge_mpi_halfspace_operator), intent(in) :: self
    integer, intent(in) :: first, second
    integer, intent(out) :: status
    type(shared_ranks) :: ranks

    status = FUGE_ERR_CALL_ORDER
    if (any(self%surface%cells < 1)) return
    ranks = self%ranks()
    status = FUGE_DONE
    if (.not. ranks%everywhere(first == self%points() .and. second == self%points())) status = FUGE_ERR_SIZE
  end subroutine check_sizes

  !> As for `fuge_operator`. All ranks decide together whether the product is finite.
  subroutine apply_with_magnitude(self, force, displacement, magnitude, status)
    class(fuge_mpi_halfspace_operator), intent(in) :: self
    real(dp), intent(in) :: force(:)
    real(dp), intent(out) :: displacement(:), magnitude(:)
    integer, intent(out) :: status
    type(shared_ranks) :: ranks

    magnitude = 0.0_dp
    ranks = self%ranks()
    call self%apply(force, displacement, status)
    if (.not. ranks%everywhere(status == FUGE_DONE)) return
    if (ranks%everywhere(is_finite_everywhere(displacement))) call self%magnitude(force, displacement, magnitude)
  end subroutine apply_with_magnitude

  !> As that of `fuge_halfspace_operator`.
  subroutine slab_magnitude(self, force, displacement, magnitude)
    class(fuge_mpi_halfspace_operator), intent(in) :: self
    real(dp), intent(in) :: force(:), displacement(:)
    real(dp), intent(out) :: magnitude(:)
    type(shared_ranks) :: ranks
    real(dp) :: largest

    ranks = self%ranks()
    largest = ranks%largest(maxval(abs(displacement)))
    if (self%surface%boundary /= FUGE_FREE) then
      largest = max(largest, MEAN_TERM*ranks%total(sum(abs(force)))/(self%surface%e_star*term_length(self%surface)))
    end if
    magnitude = largest
  end subroutine slab_magnitude

  !> True after `set`.
  function has_preconditioner(self) result(preconditioned)
    class(fuge_mpi_halfspace_operator), intent(in) :: self
    logical :: preconditioned

    preconditioned = all(self%surface%cells > 0)
  end function has_preconditioner

  !> As that of `fuge_halfspace_operator`. All ranks call it; `status` as for `apply`.
  subroutine precondition(self, displacement, force, status)
    class(fuge_mpi_halfspace_operator), intent(in) :: self
    real(dp), intent(in) :: displacement(:)
    real(dp), intent(out) :: force(:)
    integer, intent(out) :: status

    call check_sizes(self, size(displacement), size(force), status)
    if (status /= FUGE_DONE) return
    if (associated(self%slabs)) then
      call self%slabs%inverse%convolve(self%slabs%plan, displacement, force)
    else if (associated(self%whole)) then
      call self%whole%inverse%convolve(self%whole%plan, size(force), displacement, force, 1, status)
    end if
  end subroutine precondition

  !> [nx, ny] of the whole grid.
  function grid(self) result(cells)
    class(fuge_mpi_halfspace_operator), intent(in) :: self
    integer :: cells(2)

    cells = self%surface%cells
  end function grid

  !> As that of `fuge_halfspace_operator`, with rows on the same ranks or on fewer. All ranks call it.
  subroutine coarsen(self, levels, coarse)
    class(fuge_mpi_halfspace_operator), intent(in) :: self
    integer, intent(in) :: levels
    class(fuge_operator), allocatable, intent(out) :: coarse
    type(fuge_mpi_halfspace_operator), allocatable :: wider
    integer :: stat

    if (levels < 1 .or. levels > count_coarser(self%surface)) return
    allocate (wider, stat=stat)
    if (.not. agreed(self, stat)) return
    if (set_smaller(self, coarsened(self%surface, levels), wider)) call move_alloc(wider, coarse)
  end subroutine coarsen

  !> Did an allocation succeed on all ranks?
  function agreed(self, stat)
    class(fuge_mpi_halfspace_operator), intent(in) :: self
    integer, intent(in) :: stat
    logical :: agreed
    type(shared_ranks) :: ranks

    ranks = self%ranks()
    agreed = ranks%everywhere(stat == 0)
  end function agreed

  !> Set `smaller`, of the grid `surface`, for the ranks of `self`; the result is false without memory.
  function set_smaller(self, surface, smaller) result(done)
    class(fuge_mpi_halfspace_operator), intent(in) :: self
    type(halfspace_grid), intent(in) :: surface
    type(fuge_mpi_halfspace_operator), intent(inout) :: smaller
    logical :: done
    type(fuge_info) :: info

    smaller%surface = surface
    smaller%group => self%group
    call prepare(smaller, info)
    done = .not. info%failed()
  end function set_smaller

  !> As that of `fuge_halfspace_operator`.
  function free_rim(self) result(free)
    class(fuge_mpi_halfspace_operator), intent(in) :: self
    logical :: free(2)

    free = self%surface%cells > 1 .and. .not. periodic(self%surface)
  end function free_rim

  !> As that of `fuge_halfspace_operator`. All ranks call it, and share the rows of the window anew.
  subroutine window(self, first, last, part)
    class(fuge_mpi_halfspace_operator), intent(in) :: self
    integer, intent(in) :: first(2), last(2)
    class(fuge_operator), allocatable, intent(out) :: part
    type(fuge_mpi_halfspace_operator), allocatable :: smaller
    type(halfspace_grid) :: surface
    integer :: stat

    if (any(first < 1) .or. any(last < first) .or. any(last > self%surface%cells)) return
    surface = self%surface
    surface%cells = last - first + 1
    allocate (smaller, stat=stat)
    if (.not. agreed(self, stat)) return
    if (set_smaller(self, surface, smaller)) call move_alloc(smaller, part)
  end subroutine window

  !> As `coarsen`, but the wider cells are kept for the next solve. All ranks call it.
  subroutine kept_coarser(self, levels, coarse)
    class(fuge_mpi_halfspace_operator), intent(in) :: self
    integer, intent(in) :: levels
    class(fuge_operator), pointer, intent(out) :: coarse
    type(fuge_mpi_halfspace_operator), pointer :: wider
    integer :: k, stat

    nullify (coarse)
    k = self%coarser%place(levels)
    if (.not. agreed(self, merge(0, 1, k > 0))) return
    if (.not. associated(self%coarser%grid(k)%operator)) then
      allocate (wider, stat=stat)
      if (.not. agreed(self, stat)) then
        if (stat == 0) deallocate (wider)
        return
      end if
      if (.not. set_smaller(self, coarsened(self%surface, levels), wider)) then
        deallocate (wider)
        return
      end if
      call wider%coarser%refer_to(self%coarser, k)
      self%coarser%grid(k)%operator => wider
    end if
    coarse => self%coarser%grid(k)%operator
  end subroutine kept_coarser

  !> The ranks of the communicator; where it has one, that is alone.
  function ranks(self)
    class(fuge_mpi_halfspace_operator), intent(in) :: self
    type(shared_ranks) :: ranks

    if (.not. associated(self%group)) return
    if (self%group%members() > 1) ranks%group => self%group
  end function ranks

  !> As for `fuge_operator`.
  subroutine first_rows(self, levels, first)
    class(fuge_mpi_halfspace_operator), intent(in) :: self
    integer, intent(in) :: levels
    integer, allocatable, intent(out) :: first(:)
    integer :: stat

    if (.not. associated(self%group)) return
    allocate (first(0:self%group%members()), stat=stat)
    if (stat == 0) first = rows_of_ranks((self%surface%cells - 1)/2**levels + 1, self%group%members())
  end subroutine first_rows

end module fuge_slab_halfspace
