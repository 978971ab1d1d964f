!> The elastic half-space on a uniform grid of rectangles, by FFT: A of `fuge_halfspace_matrix`, or of a periodic
!> surface, in O(n log n) operations and O(n) memory.
module fuge_halfspace_fft
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_constants, only: LARGEST_EXPONENT_OF_4
  use fuge_fft, only: good_length
  use fuge_grid_convolution, only: grid_kernel, grid_plan
  use fuge_grid_store, only: grid_store
  use fuge_halfplane_fft, only: FUGE_FREE, FUGE_PERIODIC
  use fuge_halfplane_influence, only: FUGE_MEAN
  use fuge_halfspace_table, only: fill_halfspace_table
  use fuge_halfspace_waves, only: fill_periodic_eigenvalues
  use fuge_kinds, only: dp
  use fuge_locks, only: lock, unlock, LOCK_GRIDS
  use fuge_number_text, only: text
  use fuge_operator_type, only: fuge_operator
  use fuge_rectangle_checks, only: check_area_element, check_area_modulus
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_CALL_ORDER, FUGE_ERR_MEMORY, FUGE_ERR_NOT_FINITE, &
    FUGE_ERR_OPTION, FUGE_ERR_OVERFLOW, FUGE_ERR_SIZE, FUGE_ERR_WIDTH
  implicit none
  private

  !> `boundary`: the cells repeat periodically along x, and beyond them along y the surface is free.
  integer, parameter, public :: FUGE_PERIODIC_X = 2
  !> `boundary`: the cells repeat periodically along y, and beyond them along x the surface is free.
  integer, parameter, public :: FUGE_PERIODIC_Y = 3

  !> On a periodic surface of the shorter period L, the terms of a displacement by the forces f are about this times
  !> the sum of |f|/(e_star L).
  real(dp), parameter :: MEAN_TERM = 0.4_dp
  !> A grid of fewer cells is not made by `coarsen`.
  integer, parameter :: FEWEST_CELLS = 32
  !> Cells of one direction, at most: a row of the circle has a default integer of numbers.
  integer, parameter :: MOST_CELLS = 2**28
  !> The longer spacing over the shorter one, at most.
  real(dp), parameter :: LARGEST_RATIO = 1.0e5_dp

  !> Equal rectangles in a grid on a half-space: call `set`, then solve. It keeps the coarser grids of its
  !> solves, which takes a third of the memory again.
  !>
  !> Copy it by assignment, never by allocate(source=), because it owns plans of FFTW.
  type, extends(fuge_operator), public :: fuge_halfspace_operator
    private
    !> nx and ny; 0 before `set`.
    integer :: cells(2) = 0
    integer :: element = FUGE_MEAN
    integer :: boundary = FUGE_FREE
    real(dp) :: spacing(2) = 0.0_dp
    real(dp) :: e_star = 0.0_dp
    integer :: threads = 1
    logical :: measured = .false.
    !> Transforms of rows and columns, of a free surface with some more cells to lengths that are fast.
    type(grid_plan) :: plan
    !> The eigenvalues of the circulant matrix that holds A, and those of the preconditioner's, the inverse
    !> of a periodic surface.
    type(grid_kernel) :: influence, inverse
    type(grid_store) :: coarser
  contains
    procedure :: set
    procedure :: set_threads
    procedure :: points
    procedure :: apply
    procedure :: magnitude => halfspace_magnitude
    procedure :: has_preconditioner
    procedure :: precondition
    procedure :: grid
    procedure :: coarsen
    procedure :: kept_coarser
    procedure, private :: copy
    generic :: assignment(=) => copy
  end type fuge_halfspace_operator

contains

  !> Set the operator of `nx` x `ny` cells of `spacing_x` x `spacing_y`, side by side: point i + nx*(j - 1) is the
  !> cell in column i, along x, and row j.
  !>
  !> `nx`, `ny` >= 1, any numbers; `spacing_x`, `spacing_y` length; `e_star` force per length squared. `element`
  !> FUGE_CENTRE or FUGE_MEAN (default). `boundary` FUGE_FREE (default): the matrix of `fuge_halfspace_matrix`;
  !> FUGE_PERIODIC: the periods are nx*spacing_x and ny*spacing_y, and displacements count from the mean of the
  !> surface, so that A is singular: equal forces on all cells displace nothing. `threads` (default 1) share each
  !> product; `measured` (default .false.) lets FFTW time its algorithms and take the fastest.
  !> The arguments are ten, because the last four are optional and named by the caller.
  !> Errors, which leave the operator as it was: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH,
  !> FUGE_ERR_MODULUS, FUGE_ERR_ELEMENT, FUGE_ERR_OPTION, FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY.
  subroutine set(self, nx, ny, spacing_x, spacing_y, e_star, info, element, boundary, threads, measured)
    class(fuge_halfspace_operator), intent(inout) :: self
    integer, intent(in) :: nx, ny
    real(dp), intent(in) :: spacing_x, spacing_y, e_star
    type(fuge_info), intent(out) :: info
    integer, intent(in), optional :: element, boundary, threads
    logical, intent(in), optional :: measured
    type(fuge_halfspace_operator) :: new

    new%cells = [nx, ny]
    new%spacing = [spacing_x, spacing_y]
    new%e_star = e_star
    if (present(element)) new%element = element
    if (present(boundary)) new%boundary = boundary
    if (present(threads)) new%threads = threads
    if (present(measured)) new%measured = measured
    call check_cells(new, info)
    if (.not. info%failed()) call check_options(new, info)
    if (.not. info%failed()) call plan_transforms(new, info)
    if (.not. info%failed()) call compute_spectra(new, info)
    if (info%failed()) return
    call new%coarser%create(count_coarser(new))
    call move_contents(self, new)
  end subroutine set

  !> Let `threads` >= 1 threads share each product from now on. Not during a solve. Errors, which leave the operator
  !> as it was: FUGE_ERR_CALL_ORDER before `set`, FUGE_ERR_OPTION.
  subroutine set_threads(self, threads, info)
    class(fuge_halfspace_operator), intent(inout) :: self
    integer, intent(in) :: threads
    type(fuge_info), intent(out) :: info

    if (any(self%cells < 1)) then
      call report(info, FUGE_ERR_CALL_ORDER, 'the operator has no cells: set it before its threads')
    else
      call check_threads(threads, info)
    end if
    if (info%failed()) return
    self%threads = threads
    call self%coarser%create(count_coarser(self))
  end subroutine set_threads

  pure subroutine check_threads(threads, info)
    integer, intent(in) :: threads
    type(fuge_info), intent(inout) :: info

    if (threads < 1) call report(info, FUGE_ERR_OPTION, 'threads = '//text(threads)//': use 1 or more')
  end subroutine check_threads

  !> Refuse numbers and sizes of cells that make no grid.
  pure subroutine check_cells(operator, info)
    type(fuge_halfspace_operator), intent(in) :: operator
    type(fuge_info), intent(inout) :: info
    character, parameter :: AXIS(2) = ['x', 'y']
    real(dp) :: points
    integer :: k

    do k = 1, 2
      if (info%failed()) return
      if (operator%cells(k) < 1) then
        call report(info, FUGE_ERR_SIZE, 'n'//AXIS(k)//' = '//text(operator%cells(k))//': at least one cell is needed')
      else if (.not. ieee_is_finite(operator%spacing(k))) then
        call report(info, FUGE_ERR_NOT_FINITE, 'spacing_'//AXIS(k)//' = '//text(operator%spacing(k)) &
                    //' is not a finite number')
      else if (.not. operator%spacing(k) > 0.0_dp) then
        call report(info, FUGE_ERR_WIDTH, 'spacing_'//AXIS(k)//' = '//text(operator%spacing(k)) &
                    //' is not positive: it is the width of a cell along '//AXIS(k))
      else if (abs(exponent(operator%spacing(k))) > LARGEST_EXPONENT_OF_4) then
        call report(info, FUGE_ERR_OVERFLOW, 'spacing_'//AXIS(k)//' = '//text(operator%spacing(k)) &
                    //' is out of range: choose another unit of length')
      end if
    end do
    if (info%failed()) return
    points = real(operator%cells(1), dp)*real(operator%cells(2), dp)
    if (points > real(huge(1), dp)) then
      call report(info, FUGE_ERR_SIZE, 'nx = '//text(operator%cells(1))//' times ny = '//text(operator%cells(2)) &
                  //' is '//text(points)//' points, more than the largest integer, '//text(huge(1)) &
                  //': use a coarser grid')
    else if (maxval(operator%spacing) > LARGEST_RATIO*minval(operator%spacing)) then
      call report(info, FUGE_ERR_WIDTH, 'spacing_x = '//text(operator%spacing(1))//' and spacing_y = ' &
                  //text(operator%spacing(2))//': the ratio of the two is at most '//text(LARGEST_RATIO))
    end if
  end subroutine check_cells

  pure subroutine check_options(operator, info)
    type(fuge_halfspace_operator), intent(in) :: operator
    type(fuge_info), intent(inout) :: info

    call check_area_modulus(operator%e_star, info)
    if (.not. info%failed()) call check_area_element(operator%element, info)
    if (.not. info%failed()) call check_threads(operator%threads, info)
    if (info%failed()) return
    if (all(operator%boundary /= [FUGE_FREE, FUGE_PERIODIC])) then
      call report(info, FUGE_ERR_OPTION, 'boundary = '//text(operator%boundary) &
                  //' is unknown: use FUGE_FREE or FUGE_PERIODIC')
    end if
  end subroutine check_options

  !> Do the cells repeat in each direction?
  pure function periodic(operator)
    class(fuge_halfspace_operator), intent(in) :: operator
    logical :: periodic(2)

    periodic = operator%boundary == FUGE_PERIODIC .or. operator%boundary == [FUGE_PERIODIC_X, FUGE_PERIODIC_Y]
  end function periodic

  !> Plan the transforms. Errors: FUGE_ERR_MEMORY, FUGE_ERR_OPTION.
  subroutine plan_transforms(operator, info)
    type(fuge_halfspace_operator), intent(inout) :: operator
    type(fuge_info), intent(inout) :: info
    integer :: length(2)

    length = operator%cells
    where (.not. periodic(operator) .and. length > 1) length = [good_length(length(1)), good_length(length(2))]
    if (any(length < 1) .or. any(length > MOST_CELLS)) then
      call report(info, FUGE_ERR_MEMORY, 'nx = '//text(operator%cells(1))//', ny = '//text(operator%cells(2)) &
                  //': a direction has at most '//text(MOST_CELLS)//' cells')
      return
    end if
    call operator%plan%set(operator%cells, length, info, operator%measured)
    if (info%status == FUGE_ERR_MEMORY) call report_no_memory(operator, info)
  end subroutine plan_transforms

  subroutine report_no_memory(operator, info)
    type(fuge_halfspace_operator), intent(in) :: operator
    type(fuge_info), intent(inout) :: info

    call report(info, FUGE_ERR_MEMORY, 'no memory for nx = '//text(operator%cells(1))//', ny = ' &
                //text(operator%cells(2))//': use a coarser grid')
  end subroutine report_no_memory

  !> The eigenvalues of A and of the preconditioner. Error: FUGE_ERR_MEMORY.
  subroutine compute_spectra(operator, info)
    type(fuge_halfspace_operator), intent(inout) :: operator
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: eigenvalue(:, :), inverse(:, :)
    integer :: length(2), status

    length = operator%plan%length
    allocate (eigenvalue(0:length(2)/2, 0:length(1)/2), inverse(0:length(2)/2, 0:length(1)/2), stat=status)
    if (status == 0) call fill_periodic_eigenvalues(length, operator%spacing, operator%e_star, operator%element, &
                                                    eigenvalue, status)
    if (status == 0) then
      call invert(eigenvalue, inverse, operator%e_star*sqrt(product(operator%spacing)))
      call operator%inverse%set(operator%plan, [.false., .false.], inverse, status)
      if (all(periodic(operator))) then
        call operator%influence%set(operator%plan, [.false., .false.], eigenvalue, status)
      else
        deallocate (eigenvalue)
        call compute_free_spectrum(operator, status)
      end if
    end if
    if (status /= 0) call report_no_memory(operator, info)
  end subroutine compute_spectra

  !> The inverse of all eigenvalues but that of the constant, for which any positive number is valid; that of the
  !> longest wave has the right size. If there is no other wave, it is `alone`.
  pure subroutine invert(eigenvalue, inverse, alone)
    real(dp), intent(in) :: eigenvalue(0:, 0:), alone
    real(dp), intent(out) :: inverse(0:, 0:)
    real(dp) :: longest
    integer :: k

    longest = maxval(eigenvalue(0:min(1, ubound(eigenvalue, 1)), 0:min(1, ubound(eigenvalue, 2))))
    do k = 0, ubound(eigenvalue, 2)
      inverse(merge(1, 0, k == 0):, k) = 1.0_dp/eigenvalue(merge(1, 0, k == 0):, k)
    end do
    inverse(0, 0) = alone
    if (longest > 0.0_dp) inverse(0, 0) = 1.0_dp/longest
  end subroutine invert

  !> The eigenvalues for a free surface, on circles so long that no two cells are closer the other way round.
  subroutine compute_free_spectrum(operator, status)
    type(fuge_halfspace_operator), intent(inout) :: operator
    integer, intent(out) :: status
    real(dp), allocatable :: table(:, :), spectrum(:, :)
    logical :: padded(2)
    integer :: extent(2)

    padded = operator%cells > 1
    extent = merge(operator%plan%length, 0, padded)
    allocate (table(0:extent(1), 0:extent(2)), stat=status)
    if (status == 0) call fill_halfspace_table(operator%spacing, operator%e_star, operator%element, table, status)
    if (status == 0) call operator%plan%transform_even(1, padded(1), table, status)
    if (status == 0) allocate (spectrum(0:extent(2), 0:extent(1)), stat=status)
    if (status /= 0) return
    call transpose_blocks(table, spectrum)
    deallocate (table)
    call operator%plan%transform_even(2, padded(2), spectrum, status)
    if (status == 0) call operator%influence%set(operator%plan, padded, spectrum, status)
  end subroutine compute_free_spectrum

  !> transpose() of a block after the other, each of which stays in cache.
  pure subroutine transpose_blocks(a, b)
    real(dp), intent(in), contiguous :: a(:, :)
    real(dp), intent(inout), contiguous :: b(:, :)
    integer, parameter :: BLOCK = 16
    integer :: i, j, k

    do j = 1, size(a, 2), BLOCK
      do i = 1, size(a, 1), BLOCK
        do k = i, min(i + BLOCK - 1, size(a, 1))
          b(j:min(j + BLOCK - 1, size(a, 2)), k) = a(k, j:min(j + BLOCK - 1, size(a, 2)))
        end do
      end do
    end do
  end subroutine transpose_blocks

  !> Move the contents of `new` to `self`.
  subroutine move_contents(self, new)
    class(fuge_halfspace_operator), intent(inout) :: self
    type(fuge_halfspace_operator), intent(inout) :: new

    call copy_numbers(self, new)
    call self%influence%move_from(new%influence)
    call self%inverse%move_from(new%inverse)
    call self%plan%move_from(new%plan)
    call self%coarser%move_from(new%coarser)
  end subroutine move_contents

  pure subroutine copy_numbers(self, source)
    class(fuge_halfspace_operator), intent(inout) :: self
    class(fuge_halfspace_operator), intent(in) :: source

    self%cells = source%cells
    self%element = source%element
    self%boundary = source%boundary
    self%spacing = source%spacing
    self%e_star = source%e_star
    self%threads = source%threads
    self%measured = source%measured
  end subroutine copy_numbers

  !> Assignment. If memory for the copy cannot be allocated, the copy is not set.
  subroutine copy(self, source)
    class(fuge_halfspace_operator), intent(inout) :: self
    class(fuge_halfspace_operator), intent(in) :: source
    integer :: cells(2), stat

    cells = source%cells
    self%cells = 0
    ! Arrays of the right size are kept, because the source may be a bitwise copy of self that shares them.
    call self%influence%copy_from(source%influence, stat)
    if (stat == 0) call self%inverse%copy_from(source%inverse, stat)
    call self%plan%copy_from(source%plan)
    call copy_numbers(self, source)
    call self%coarser%clear()
    self%cells = 0
    if (stat /= 0 .or. self%plan%cells(1) < 1) return
    self%cells = cells
    call self%coarser%create(count_coarser(self))
  end subroutine copy

  !> Number of cells nx*ny; 0 before `set`.
  pure function points(self) result(n)
    class(fuge_halfspace_operator), intent(in) :: self
    integer :: n

    n = product(self%cells)
  end function points

  !> u = A f, with errors of about 1e-16 of its largest value.
  !>
  !> `force` (nx*ny), force; `displacement` (nx*ny), length. Safe in several threads at once. `status`: 0,
  !> FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE or FUGE_ERR_MEMORY.
  subroutine apply(self, force, displacement, status)
    class(fuge_halfspace_operator), intent(in) :: self
    real(dp), intent(in) :: force(:)
    real(dp), intent(out) :: displacement(:)
    integer, intent(out) :: status

    call check_sizes(self, size(force), size(displacement), status)
    if (status == FUGE_DONE) call self%influence%convolve(self%plan, force, displacement, status)
  end subroutine apply

  pure subroutine check_sizes(self, first, second, status)
    class(fuge_halfspace_operator), intent(in) :: self
    integer, intent(in) :: first, second
    integer, intent(out) :: status

    status = FUGE_DONE
    if (any(self%cells < 1)) then
      status = FUGE_ERR_CALL_ORDER
    else if (first /= self%points() .or. second /= self%points()) then
      status = FUGE_ERR_SIZE
    end if
  end subroutine check_sizes

  !> `magnitude` (nx*ny), length: the largest displacement; on a periodic surface, where equal forces
  !> displace nothing, at least the terms of their displacement.
  subroutine halfspace_magnitude(self, force, displacement, magnitude)
    class(fuge_halfspace_operator), intent(in) :: self
    real(dp), intent(in) :: force(:), displacement(:)
    real(dp), intent(out) :: magnitude(:)
    real(dp) :: period

    magnitude = maxval(abs(displacement))
    if (self%boundary == FUGE_FREE) return
    period = minval(self%spacing*self%cells)
    magnitude = max(magnitude, MEAN_TERM*sum(abs(force))/(self%e_star*period))
  end subroutine halfspace_magnitude

  !> True after `set`.
  function has_preconditioner(self) result(preconditioned)
    class(fuge_halfspace_operator), intent(in) :: self
    logical :: preconditioned

    preconditioned = all(self%cells > 0)
  end function has_preconditioner

  !> The inverse on a periodic surface, exact except for the constant. A free surface is taken
  !> for periodic, which changes little, because the coefficients of the inverse fall off
  !> with the third power of the distance, and takes a quarter of the time of a product.
  !>
  !> `displacement` (nx*ny), length; `force` (nx*ny), force; `status` as for `apply`.
  subroutine precondition(self, displacement, force, status)
    class(fuge_halfspace_operator), intent(in) :: self
    real(dp), intent(in) :: displacement(:)
    real(dp), intent(out) :: force(:)
    integer, intent(out) :: status

    call check_sizes(self, size(displacement), size(force), status)
    if (status == FUGE_DONE) call self%inverse%convolve(self%plan, displacement, force, status)
  end subroutine precondition

  !> [nx, ny].
  function grid(self) result(cells)
    class(fuge_halfspace_operator), intent(in) :: self
    integer :: cells(2)

    cells = self%cells
  end function grid

  !> Cells 2**levels times as wide in both directions, with the same element and boundary. In a periodic direction the
  !> period is the same, which may make them a little narrower. A direction of one cell keeps it. Unallocated for fewer
  !> than 32 wider cells, and without memory.
  subroutine coarsen(self, levels, coarse)
    class(fuge_halfspace_operator), intent(in) :: self
    integer, intent(in) :: levels
    class(fuge_operator), allocatable, intent(out) :: coarse
    type(fuge_halfspace_operator), allocatable :: wider
    type(fuge_info) :: info
    integer :: stat

    allocate (wider, stat=stat)
    if (stat /= 0) return
    call set_wider(self, levels, wider, info)
    if (.not. info%failed()) call move_alloc(wider, coarse)
  end subroutine coarsen

  !> Set `wider` as `coarsen` says, or report a failure.
  subroutine set_wider(self, levels, wider, info)
    class(fuge_halfspace_operator), intent(in) :: self
    integer, intent(in) :: levels
    type(fuge_halfspace_operator), intent(inout) :: wider
    type(fuge_info), intent(out) :: info
    real(dp) :: spacing(2)
    integer :: cells(2), k

    info%status = FUGE_ERR_SIZE
    if (levels < 1 .or. levels > count_coarser(self)) return
    cells = self%cells
    spacing = self%spacing
    do k = 1, levels
      where (cells > 1) spacing = 2.0_dp*spacing
      cells = (cells - 1)/2 + 1
    end do
    where (periodic(self)) spacing = self%spacing*(real(self%cells, dp)/real(cells, dp))
    call wider%set(cells(1), cells(2), spacing(1), spacing(2), self%e_star, info, self%element, self%boundary, &
                   self%threads)
  end subroutine set_wider

  !> How many times the grid can be coarsened.
  pure function count_coarser(self) result(count)
    class(fuge_halfspace_operator), intent(in) :: self
    integer :: count, cells(2)

    count = -1
    cells = self%cells
    do while (real(cells(1), dp)*real(cells(2), dp) >= FEWEST_CELLS)
      cells = (cells - 1)/2 + 1
      count = count + 1
    end do
    count = max(count, 0)
  end function count_coarser

  !> As `coarsen`, but the wider cells are kept with those of the finest grid, for the next solve and for
  !> solves in other threads.
  subroutine kept_coarser(self, levels, coarse)
    class(fuge_halfspace_operator), intent(in) :: self
    integer, intent(in) :: levels
    class(fuge_operator), pointer, intent(out) :: coarse
    integer :: k

    nullify (coarse)
    k = self%coarser%place(levels)
    if (k < 1) return
    call lock(LOCK_GRIDS)
    if (.not. associated(self%coarser%grid(k)%operator)) call keep_coarser(self, levels, k)
    coarse => self%coarser%grid(k)%operator
    call unlock(LOCK_GRIDS)
  end subroutine kept_coarser

  !> Make element k of the kept grids, unless memory is short.
  subroutine keep_coarser(self, levels, k)
    class(fuge_halfspace_operator), intent(in) :: self
    integer, intent(in) :: levels, k
    type(fuge_halfspace_operator), pointer :: wider
    type(fuge_info) :: info
    integer :: stat

    allocate (wider, stat=stat)
    if (stat /= 0) return
    call set_wider(self, levels, wider, info)
    if (info%failed()) then
      deallocate (wider)
      return
    end if
    call wider%coarser%refer_to(self%coarser, k)
    self%coarser%grid(k)%operator => wider
  end subroutine keep_coarser

end module fuge_halfspace_fft
