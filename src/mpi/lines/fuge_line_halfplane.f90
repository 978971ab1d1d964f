!> The elastic half-plane on a line of equal cells that the ranks of an MPI communicator share.
module fuge_line_halfplane
  use, intrinsic :: iso_c_binding, only: c_loc, c_null_ptr, c_ptr
  use fuge_convolution, only: convolution_kernel
  use fuge_halfplane_line, only: check_line, circle_of, coarsened, count_coarser, halfplane_line, least_magnitude
  use fuge_halfplane_spectra, only: compute_line_spectra
  use fuge_kinds, only: dp
  use fuge_line_cells, only: active_ranks, first_cells
  use fuge_line_plan, only: line_plan
  use fuge_line_kernel, only: compute_kernels, line_kernel
  use fuge_line_transform, only: line_transform
  use fuge_memory, only: check_memory
  use fuge_operator_type, only: fuge_operator
  use fuge_rank_communicator, only: free_communicator, members_here, rank_communicator, split_communicator
  use fuge_point_space, only: point_space
  use fuge_shared_body, only: share_body
  use fuge_shared_operator, only: owns, shared_operator
  use fuge_status, only: fuge_info, require_memory, FUGE_DONE
  use fuge_wave_mixture, only: wave_mixture
  use mpi_f08, only: MPI_Comm
  implicit none
  private

  !> Bytes that two buffers, the factors of the transform and two spectra take for each cell of the circle.
  real(dp), parameter :: LINE_BYTES = 64.0_dp

  !> What several ranks need for products.
  type :: shared_products
    type(line_transform) :: transform
    type(line_kernel) :: influence, inverse
  end type shared_products

  !> What one rank needs for products, if it has all cells.
  type :: whole_products
    type(line_plan) :: plan
    type(convolution_kernel) :: influence, inverse
  end type whole_products

  !> Equal cells side by side on a half-plane, which ranks share: call `set` on all ranks of a communicator, then solve
  !> on all of them; `own_rows` says which cells the gaps and the forces of a rank are those of.
  !>
  !> All ranks call the same procedures in the same order, with the same arguments but for arrays of points. Before
  !> MPI_Finalize let it go out of scope, or `free` it.
  type, extends(shared_operator), public :: fuge_mpi_halfplane_operator
    private
    !> No cells before `set`.
    type(halfplane_line) :: line
    !> The first and the last cell of this rank.
    integer :: owned_cells(2) = [1, 0]
    !> Subtracted from all coefficients; length per force.
    real(dp) :: datum_value = 0.0_dp
    !> The ranks that have cells.
    type(rank_communicator) :: holders
    !> Of these one is associated, on ranks that have cells.
    type(shared_products), pointer :: shared => null()
    type(whole_products), pointer :: whole => null()
    !> Address of the variable that owns them.
    type(c_ptr) :: owner = c_null_ptr
  contains
    procedure :: set
    procedure :: own_rows
    procedure :: free
    procedure :: points
    procedure :: apply
    procedure :: datum
    procedure :: magnitude => line_magnitude
    procedure :: precondition
    procedure :: has_preconditioner_on_bed
    procedure :: precondition_on_bed
    procedure :: grid
    procedure :: coarsen
    procedure :: first_rows
    procedure, private :: copy
    generic :: assignment(=) => copy
    final :: finish
  end type fuge_mpi_halfplane_operator

contains

  !> Set the operator of `n` cells of width `spacing`, side by side, as that of `fuge_halfplane_operator`, on all ranks
  !> of `comm`.
  !>
  !> `comm` is duplicated. `n`, `spacing`, `e_star`, `element`, `boundary`, `measured`, `body` as for
  !> `fuge_halfplane_operator`, the same on all ranks. A rank has cells one after the other; where there are few the
  !> last ranks have none. Of a periodic surface a rank has as many cells, or a multiple, as a divisor of n leaves, the
  !> one next to the square root of n: a prime number of cells is not shared. The arguments are ten, because the last
  !> four are optional and named by the caller.
  !> Errors, on all ranks, which leave the operator as it was: those of `fuge_halfplane_operator`, FUGE_ERR_OPTION if
  !> the arguments differ, FUGE_ERR_CALL_ORDER, on this rank, if MPI is not running.
  subroutine set(self, n, spacing, e_star, comm, info, element, boundary, measured, body)
    class(fuge_mpi_halfplane_operator), intent(inout) :: self
    integer, intent(in) :: n
    real(dp), intent(in) :: spacing, e_star
    type(MPI_Comm), intent(in) :: comm
    type(fuge_info), intent(out) :: info
    integer, intent(in), optional :: element, boundary
    logical, intent(in), optional :: measured
    type(wave_mixture), intent(in), optional :: body
    type(fuge_mpi_halfplane_operator) :: new

    call new%join(comm, info)
    if (info%failed()) return
    new%line%cells = n
    new%line%spacing = spacing
    new%line%e_star = e_star
    if (present(element)) new%line%element = element
    if (present(boundary)) new%line%boundary = boundary
    if (present(measured)) new%measured = measured
    if (present(body)) new%line%body = body
    call check_line(new%line, info)
    call new%check_same([real(n, dp), spacing, e_star, &
                         real([new%line%element, new%line%boundary, merge(1, 0, new%measured)], dp)], &
                        'n, spacing, e_star', info)
    if (.not. info%failed()) call share_body(new%group, new%line%body, info)
    if (.not. info%failed()) call prepare(new, info)
    if (.not. info%failed()) call move_contents(self, new)
  end subroutine set

  !> Plan and compute what belongs to the cells of `operator`. Errors, on all ranks: FUGE_ERR_MEMORY.
  subroutine prepare(operator, info)
    type(fuge_mpi_halfplane_operator), intent(inout), target :: operator
    type(fuge_info), intent(inout) :: info
    integer :: active, first(0:operator%group%members()), here, length, me, stat
    real(dp) :: datum(1)

    operator%owner = c_loc(operator%measured)
    call circle_of(operator%line, length, info)
    if (info%failed()) return
    me = operator%group%number()
    first = first_cells(operator%line%cells, length, operator%group%members())
    if (first(me + 1) > first(me)) operator%owned_cells = [first(me), first(me + 1) - 1]
    active = active_ranks(operator%line%cells, length, operator%group%members())
    here = members_here(operator%group, active)
    if (me < active) call check_memory(LINE_BYTES*real(length, dp)*real(here, dp)/real(active, dp), &
                                       'the part of the ranks on this machine', info)
    stat = 0
    if (active > 1 .and. me < active) allocate (operator%shared, stat=stat)
    if (active == 1 .and. me < active) allocate (operator%whole, stat=stat)
    call require_memory(stat, 'an operator', info)
    call operator%group%agree(info)
    if (info%failed()) return
    if (active > 1) call split_communicator(operator%group, active, operator%holders)
    if (associated(operator%shared)) then
      call prepare_shared(operator, length, operator%shared, info)
    else if (associated(operator%whole)) then
      call prepare_whole(operator, length, operator%whole, info)
    end if
    call operator%group%agree(info)
    if (info%failed()) return
    ! The first rank has cells in any case.
    datum = merge(operator%datum_value, 0.0_dp, me == 0)
    call operator%group%add(datum)
    operator%datum_value = datum(1)
    call operator%make_room(count_coarser(operator%line%cells))
  end subroutine prepare

  !> What one of several ranks needs. Errors, on all ranks that have cells: FUGE_ERR_MEMORY.
  subroutine prepare_shared(operator, length, shared, info)
    type(fuge_mpi_halfplane_operator), intent(inout) :: operator
    integer, intent(in) :: length
    type(shared_products), intent(inout) :: shared
    type(fuge_info), intent(inout) :: info

    call shared%transform%set(operator%holders, operator%line%cells, length, operator%group%members(), &
                              operator%measured, info)
    call operator%holders%agree(info)
    if (.not. info%failed()) call compute_kernels(operator%line, operator%holders, shared%transform, &
                                                  shared%influence, shared%inverse, operator%datum_value, info)
  end subroutine prepare_shared

  !> What the only rank that has cells needs. Errors: FUGE_ERR_MEMORY.
  subroutine prepare_whole(operator, length, whole, info)
    type(fuge_mpi_halfplane_operator), intent(inout) :: operator
    integer, intent(in) :: length
    type(whole_products), intent(inout) :: whole
    type(fuge_info), intent(inout) :: info

    call whole%plan%set(length, info, measured=operator%measured)
    if (.not. info%failed()) call compute_line_spectra(operator%line, whole%plan, whole%influence, whole%inverse, &
                                                       operator%datum_value, info)
  end subroutine prepare_whole

  !> Move the contents of `new` to `self`.
  subroutine move_contents(self, new)
    class(fuge_mpi_halfplane_operator), intent(inout), target :: self
    type(fuge_mpi_halfplane_operator), intent(inout) :: new

    call self%free()
    call self%take_group(new)
    self%measured = new%measured
    self%line = new%line
    self%owned_cells = new%owned_cells
    self%datum_value = new%datum_value
    self%holders = new%holders
    self%shared => new%shared
    self%whole => new%whole
    call self%take_coarser(new)
    self%owner = c_loc(self%measured)
    new%owner = c_null_ptr
    call new%free()
  end subroutine move_contents

  !> Free what the operator owns; all ranks call it, before MPI_Finalize.
  subroutine free(self)
    class(fuge_mpi_halfplane_operator), intent(inout), target :: self

    call self%drop_coarser()
    if (owns(self%owner, c_loc(self%measured))) then
      if (associated(self%shared)) then
        call self%shared%transform%free()
        deallocate (self%shared)
      end if
      if (associated(self%whole)) deallocate (self%whole)
      call free_communicator(self%holders)
    end if
    self%holders = rank_communicator()
    nullify (self%shared, self%whole)
    self%owner = c_null_ptr
    self%line%cells = 0
    self%owned_cells = [1, 0]
    call self%leave()
  end subroutine free

  impure elemental subroutine finish(self)
    type(fuge_mpi_halfplane_operator), intent(inout) :: self

    call self%free()
  end subroutine finish

  !> Assignment computes everything anew, because each variable frees its own. All ranks assign together; without memory
  !> the copy is not set.
  subroutine copy(self, source)
    class(fuge_mpi_halfplane_operator), intent(inout) :: self
    class(fuge_mpi_halfplane_operator), intent(in) :: source
    type(fuge_mpi_halfplane_operator) :: new
    type(fuge_info) :: info

    if (source%line%cells > 0) then
      call new%set(source%line%cells, source%line%spacing, source%line%e_star, source%comm(), info, &
                   element=source%line%element, boundary=source%line%boundary, measured=source%measured, &
                   body=source%line%body)
    end if
    call move_contents(self, new)
  end subroutine copy

  !> The first and the last cell of this rank, from 1; [1, 0] where it has none, and before `set`.
  pure function own_rows(self) result(rows)
    class(fuge_mpi_halfplane_operator), intent(in) :: self
    integer :: rows(2)

    rows = self%owned_cells
  end function own_rows

  !> Number of cells of this rank; 0 before `set`, and where it has none.
  pure function points(self) result(n)
    class(fuge_mpi_halfplane_operator), intent(in) :: self
    integer :: n

    n = self%owned_cells(2) - self%owned_cells(1) + 1
  end function points

  !> u = (A - datum) f, as that of `fuge_halfplane_operator`; `force` and `displacement` (points of this rank). All
  !> ranks call it. `status`, the same on all ranks: 0, FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE; FUGE_ERR_MEMORY on one rank.
  subroutine apply(self, force, displacement, status)
    class(fuge_mpi_halfplane_operator), intent(in) :: self
    real(dp), intent(in) :: force(:)
    real(dp), intent(out) :: displacement(:)
    integer, intent(out) :: status

    call self%check_sizes(size(force), size(displacement), status)
    if (status /= FUGE_DONE) return
    if (associated(self%shared)) then
      call self%shared%influence%convolve(self%shared%transform, force, displacement)
    else if (associated(self%whole)) then
      call self%whole%influence%convolve(self%whole%plan, force, displacement, status)
    end if
  end subroutine apply

  !> What is subtracted from all coefficients, length per force; 0 for a periodic surface.
  function datum(self)
    class(fuge_mpi_halfplane_operator), intent(in) :: self
    real(dp) :: datum

    datum = self%datum_value
  end function datum

  !> As that of `fuge_halfplane_operator`.
  subroutine line_magnitude(self, force, displacement, magnitude)
    class(fuge_mpi_halfplane_operator), intent(in) :: self
    real(dp), intent(in) :: force(:), displacement(:)
    real(dp), intent(out) :: magnitude(:)
    type(point_space) :: space

    space = self%ranks()
    magnitude = max(space%largest(maxval(abs(displacement))), &
                    least_magnitude(self%line, space%total(sum(abs(force)))))
  end subroutine line_magnitude

  !> As that of `fuge_halfplane_operator`. All ranks call it; `status` as for `apply`.
  subroutine precondition(self, displacement, force, status)
    class(fuge_mpi_halfplane_operator), intent(in) :: self
    real(dp), intent(in) :: displacement(:)
    real(dp), intent(out) :: force(:)
    integer, intent(out) :: status

    call self%check_sizes(size(displacement), size(force), status)
    if (status /= FUGE_DONE) return
    if (associated(self%shared)) then
      call self%shared%inverse%convolve(self%shared%transform, displacement, force)
    else if (associated(self%whole)) then
      call self%whole%inverse%convolve(self%whole%plan, displacement, force, status)
    end if
  end subroutine precondition

  !> True after `set`.
  function has_preconditioner_on_bed(self) result(preconditioned)
    class(fuge_mpi_halfplane_operator), intent(in) :: self
    logical :: preconditioned

    preconditioned = self%has_preconditioner()
  end function has_preconditioner_on_bed

  !> As that of `fuge_halfplane_operator`, with the same `compliance` on all ranks. All ranks call it; `status` as for
  !> `apply`.
  subroutine precondition_on_bed(self, compliance, displacement, force, status)
    class(fuge_mpi_halfplane_operator), intent(in) :: self
    real(dp), intent(in) :: compliance, displacement(:)
    real(dp), intent(out) :: force(:)
    integer, intent(out) :: status

    call self%check_sizes(size(displacement), size(force), status)
    if (status /= FUGE_DONE) return
    if (associated(self%shared)) then
      call self%shared%inverse%convolve(self%shared%transform, displacement, force, compliance)
    else if (associated(self%whole)) then
      call self%whole%inverse%convolve(self%whole%plan, displacement, force, status, compliance)
    end if
  end subroutine precondition_on_bed

  !> [1, n]: rows of one cell, because ranks share rows.
  function grid(self) result(cells)
    class(fuge_mpi_halfplane_operator), intent(in) :: self
    integer :: cells(2)

    cells = [min(self%line%cells, 1), self%line%cells]
  end function grid

  !> As that of `fuge_halfplane_operator`, with cells on the same ranks or on fewer. All ranks call it.
  subroutine coarsen(self, levels, coarse)
    class(fuge_mpi_halfplane_operator), intent(in) :: self
    integer, intent(in) :: levels
    class(fuge_operator), allocatable, intent(out) :: coarse
    type(fuge_mpi_halfplane_operator), allocatable :: wider
    type(halfplane_line) :: line
    integer :: stat

    line = coarsened(self%line, levels)
    if (line%cells < 1) return
    allocate (wider, stat=stat)
    if (.not. self%agreed(stat)) return
    if (set_wider(self, line, wider)) call move_alloc(wider, coarse)
  end subroutine coarsen

  !> Set `wider`, of the cells `line`, for the ranks of `self`; the result is false without memory.
  function set_wider(self, line, wider) result(done)
    class(fuge_mpi_halfplane_operator), intent(in) :: self
    type(halfplane_line), intent(in) :: line
    type(fuge_mpi_halfplane_operator), intent(inout) :: wider
    logical :: done
    type(fuge_info) :: info

    wider%line = line
    wider%group => self%group
    call prepare(wider, info)
    done = .not. info%failed()
  end function set_wider

  !> As for `fuge_operator`.
  subroutine first_rows(self, levels, first)
    class(fuge_mpi_halfplane_operator), intent(in) :: self
    integer, intent(in) :: levels
    integer, allocatable, intent(out) :: first(:)
    type(halfplane_line) :: line
    type(fuge_info) :: info
    integer :: length, stat

    if (.not. associated(self%group)) return
    line = self%line
    if (levels > 0) line%cells = (self%line%cells - 1)/2**levels + 1
    call circle_of(line, length, info)
    if (info%failed()) return
    allocate (first(0:self%group%members()), stat=stat)
    if (stat == 0) first = first_cells(line%cells, length, self%group%members())
  end subroutine first_rows

end module fuge_line_halfplane
