!> The elastic half-space on a uniform grid of rectangles whose rows the ranks of an MPI communicator share.
module fuge_slab_halfspace
  use, intrinsic :: iso_c_binding, only: c_loc, c_null_ptr, c_ptr
  use fuge_cell_elements, only: FUGE_FREE, FUGE_PERIODIC
  use fuge_halfspace_grid, only: check_grid, coarsened, complete, count_coarser, halfspace_grid, least_magnitude, &
    periodic, slope_of_waves
  use fuge_kinds, only: dp, sp
  use fuge_number_text, only: text
  use fuge_operator_type, only: fuge_operator
  use fuge_point_space, only: point_space
  use fuge_shared_body, only: share_body
  use fuge_shared_operator, only: owns, shared_operator
  use fuge_slab_products, only: prepare_products, slab_products
  use fuge_slab_rows, only: rows_of_ranks => first_rows
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_MEMORY, FUGE_ERR_UNSUPPORTED
  use fuge_wave_mixture, only: wave_mixture
  use mpi_f08, only: MPI_Comm
  implicit none
  private

  !> Equal rectangles in a grid on a half-space, whose rows ranks share: call `set` on all ranks of a communicator, then
  !> solve on all of them; `own_rows` says which rows the gaps and the forces of a rank are those of.
  !>
  !> All ranks call the same procedures in the same order, with the same arguments but for arrays of points. Before
  !> MPI_Finalize let it go out of scope, or `free` it.
  type, extends(shared_operator), public :: fuge_mpi_halfspace_operator
    private
    !> No cells before `set`.
    type(halfspace_grid) :: surface
    !> What products need.
    type(slab_products), pointer :: products => null()
    !> Address of the variable that owns the products.
    type(c_ptr) :: owner = c_null_ptr
  contains
    procedure :: set
    procedure :: own_rows
    procedure :: free
    procedure :: points
    procedure :: apply
    procedure :: magnitude => slab_magnitude
    procedure :: common_magnitude
    procedure :: precondition
    procedure :: has_preconditioner_on_bed
    procedure :: precondition_on_bed
    procedure :: has_single
    procedure :: apply_single
    procedure :: precondition_single
    procedure :: wave_slope
    procedure :: grid
    procedure :: coarsen
    procedure :: free_rim
    procedure :: window
    procedure :: first_rows
    procedure, private :: copy
    generic :: assignment(=) => copy
    final :: finish
  end type fuge_mpi_halfspace_operator

contains

  !> Set the operator of `nx` x `ny` cells, as that of `fuge_halfspace_operator`, on all ranks of `comm`: point
  !> i + nx*(j - 1) of a rank is the cell in column i of its row j.
  !>
  !> `comm` is duplicated. `nx`, `ny`, `spacing_x`, `spacing_y`, `e_star`, `element`, `measured`, `body` as for
  !> `fuge_halfspace_operator`, the same on all ranks; `boundary` FUGE_FREE (default) or FUGE_PERIODIC. A rank has pairs
  !> of rows, one after the other; where there are few cells the last ranks have none.
  !> The arguments are eleven, because the last four are optional and named by the caller.
  !> Errors, on all ranks, which leave the operator as it was: those of `fuge_halfspace_operator`, FUGE_ERR_OPTION if
  !> the arguments differ, FUGE_ERR_UNSUPPORTED for another boundary, FUGE_ERR_CALL_ORDER, on this rank, if MPI is not
  !> running.
  subroutine set(self, nx, ny, spacing_x, spacing_y, e_star, comm, info, element, boundary, measured, body)
    class(fuge_mpi_halfspace_operator), intent(inout) :: self
    integer, intent(in) :: nx, ny
    real(dp), intent(in) :: spacing_x, spacing_y, e_star
    type(MPI_Comm), intent(in) :: comm
    type(fuge_info), intent(out) :: info
    integer, intent(in), optional :: element, boundary
    logical, intent(in), optional :: measured
    type(wave_mixture), intent(in), optional :: body
    type(fuge_mpi_halfspace_operator) :: new

    call new%join(comm, info)
    if (info%failed()) return
    new%surface%cells = [nx, ny]
    new%surface%spacing = [spacing_x, spacing_y]
    new%surface%e_star = e_star
    if (present(element)) new%surface%element = element
    if (present(boundary)) new%surface%boundary = boundary
    if (present(measured)) new%measured = measured
    if (present(body)) new%surface%body = body
    call check_grid(new%surface, info)
    if (.not. info%failed() .and. all(new%surface%boundary /= [FUGE_FREE, FUGE_PERIODIC])) then
      call report(info, FUGE_ERR_UNSUPPORTED, 'boundary = '//text(new%surface%boundary) &
                  //': ranks share surfaces that are FUGE_FREE or FUGE_PERIODIC only')
    end if
    call new%check_same([real(new%surface%cells, dp), new%surface%spacing, new%surface%e_star, &
                         real([new%surface%element, new%surface%boundary, merge(1, 0, new%measured)], dp)], &
                        'nx, ny, spacings, e_star', info)
    if (.not. info%failed()) call share_body(new%group, new%surface%body, info)
    if (.not. info%failed()) then
      call complete(new%surface)
      call prepare(new, info)
    end if
    if (.not. info%failed()) call move_contents(self, new)
  end subroutine set

  !> Plan and compute what belongs to the cells of `operator`. Errors, on all ranks: FUGE_ERR_MEMORY.
  subroutine prepare(operator, info)
    type(fuge_mpi_halfspace_operator), intent(inout), target :: operator
    type(fuge_info), intent(inout) :: info
    integer :: stat

    allocate (operator%products, stat=stat)
    if (operator%agreed(stat)) then
      operator%owner = c_loc(operator%measured)
      call prepare_products(operator%products, operator%surface, operator%group, operator%measured, info)
    else
      if (stat == 0) deallocate (operator%products)
      call report(info, FUGE_ERR_MEMORY, 'no memory for an operator')
    end if
    if (.not. info%failed()) call operator%make_room(count_coarser(operator%surface))
  end subroutine prepare

  !> Move the contents of `new` to `self`.
  subroutine move_contents(self, new)
    class(fuge_mpi_halfspace_operator), intent(inout), target :: self
    type(fuge_mpi_halfspace_operator), intent(inout) :: new

    call self%free()
    self%surface = new%surface
    self%measured = new%measured
    call self%take_group(new)
    self%products => new%products
    call self%take_coarser(new)
    self%owner = c_loc(self%measured)
    new%owner = c_null_ptr
    nullify (new%products)
    call new%free()
  end subroutine move_contents

  !> Free what the operator owns; all ranks call it, before MPI_Finalize.
  subroutine free(self)
    class(fuge_mpi_halfspace_operator), intent(inout), target :: self

    call self%drop_coarser()
    if (owns(self%owner, c_loc(self%measured))) then
      call self%products%free()
      deallocate (self%products)
    end if
    nullify (self%products)
    self%owner = c_null_ptr
    self%surface%cells = 0
    call self%leave()
  end subroutine free

  impure elemental subroutine finish(self)
    type(fuge_mpi_halfspace_operator), intent(inout) :: self

    call self%free()
  end subroutine finish

  !> Assignment computes everything anew, because each variable frees its own. All ranks assign together; without memory
  !> the copy is not set.
  subroutine copy(self, source)
    class(fuge_mpi_halfspace_operator), intent(inout) :: self
    class(fuge_mpi_halfspace_operator), intent(in) :: source
    type(fuge_mpi_halfspace_operator) :: new
    type(fuge_info) :: info

    if (all(source%surface%cells > 0)) then
      call new%set(source%surface%cells(1), source%surface%cells(2), source%surface%spacing(1), &
                   source%surface%spacing(2), source%surface%e_star, source%comm(), info, &
                   element=source%surface%element, boundary=source%surface%boundary, measured=source%measured, &
                   body=source%surface%body)
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

    call self%check_sizes(size(force), size(displacement), status)
    if (status == FUGE_DONE) call self%products%multiply(force, displacement, status)
  end subroutine apply

  !> As that of `fuge_halfspace_operator`.
  subroutine slab_magnitude(self, force, displacement, magnitude)
    class(fuge_mpi_halfspace_operator), intent(in) :: self
    real(dp), intent(in) :: force(:), displacement(:)
    real(dp), intent(out) :: magnitude(:)
    type(point_space) :: space

    space = self%ranks()
    magnitude = max(space%largest(maxval(abs(displacement))), &
                    least_magnitude(self%surface, space%total(sum(abs(force)))))
  end subroutine slab_magnitude

  !> As `magnitude`, of the largest displacement and the forces of all ranks.
  function common_magnitude(self, largest, total) result(magnitude)
    class(fuge_mpi_halfspace_operator), intent(in) :: self
    real(dp), intent(in) :: largest, total
    real(dp) :: magnitude

    magnitude = max(largest, least_magnitude(self%surface, total))
  end function common_magnitude

  !> As that of `fuge_halfspace_operator`. All ranks call it; `status` as for `apply`.
  subroutine precondition(self, displacement, force, status)
    class(fuge_mpi_halfspace_operator), intent(in) :: self
    real(dp), intent(in) :: displacement(:)
    real(dp), intent(out) :: force(:)
    integer, intent(out) :: status

    call self%check_sizes(size(displacement), size(force), status)
    if (status == FUGE_DONE) call self%products%precondition(displacement, force, status)
  end subroutine precondition

  !> True after `set`.
  function has_preconditioner_on_bed(self) result(preconditioned)
    class(fuge_mpi_halfspace_operator), intent(in) :: self
    logical :: preconditioned

    preconditioned = self%has_preconditioner()
  end function has_preconditioner_on_bed

  !> As that of `fuge_halfspace_operator`, with the same `compliance` on all ranks. All ranks call it; `status` as for
  !> `apply`.
  subroutine precondition_on_bed(self, compliance, displacement, force, status)
    class(fuge_mpi_halfspace_operator), intent(in) :: self
    real(dp), intent(in) :: compliance, displacement(:)
    real(dp), intent(out) :: force(:)
    integer, intent(out) :: status

    call self%check_sizes(size(displacement), size(force), status)
    if (status == FUGE_DONE) call self%products%precondition_on_bed(compliance, displacement, force, status)
  end subroutine precondition_on_bed

  !> As that of `fuge_halfspace_operator`: true after `set`, unless the numbers of the spectra are out of the range of
  !> single precision, or memory is short.
  function has_single(self) result(single)
    class(fuge_mpi_halfspace_operator), intent(in) :: self
    logical :: single

    single = associated(self%products)
    if (single) single = self%products%has_single
  end function has_single

  !> `apply` in single precision. All ranks call it; `status` as for `apply`.
  subroutine apply_single(self, input, result, status)
    class(fuge_mpi_halfspace_operator), intent(in) :: self
    real(sp), intent(in) :: input(:)
    real(sp), intent(out) :: result(:)
    integer, intent(out) :: status

    call self%check_sizes(size(input), size(result), status)
    if (status == FUGE_DONE) call self%products%multiply_single(input, result, status)
  end subroutine apply_single

  !> `precondition` in single precision. All ranks call it; `status` as for `apply`.
  subroutine precondition_single(self, input, result, status)
    class(fuge_mpi_halfspace_operator), intent(in) :: self
    real(sp), intent(in) :: input(:)
    real(sp), intent(out) :: result(:)
    integer, intent(out) :: status

    call self%check_sizes(size(input), size(result), status)
    if (status == FUGE_DONE) call self%products%precondition_single(input, result, status)
  end subroutine precondition_single

  !> As that of `fuge_halfspace_operator`.
  function wave_slope(self, levels) result(slope)
    class(fuge_mpi_halfspace_operator), intent(in) :: self
    integer, intent(in) :: levels
    real(dp) :: slope

    slope = slope_of_waves(self%surface, levels)
  end function wave_slope

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
    if (.not. self%agreed(stat)) return
    if (set_smaller(self, coarsened(self%surface, levels), wider)) call move_alloc(wider, coarse)
  end subroutine coarsen

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
    if (.not. self%agreed(stat)) return
    if (set_smaller(self, surface, smaller)) call move_alloc(smaller, part)
  end subroutine window

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
