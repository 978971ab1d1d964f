!> The elastic half-space on a uniform grid of rectangles, by FFT: A of `fuge_halfspace_matrix`, or of a periodic
!> surface, in O(n log n) operations and O(n) memory.
module fuge_halfspace_fft
  use fuge_cell_elements, only: FUGE_FREE
  use fuge_grid_operator_type, only: grid_operator
  use fuge_grid_plan, only: grid_plan
  use fuge_halfspace_grid, only: check_grid, circle_of, coarsened, complete, computes_later, count_coarser, &
    cyclic, halfspace_grid, is_large, least_magnitude, periodic, slope_of_waves
  use fuge_halfspace_kernels, only: bytes_in_slices, kernel_store, multiply_in_slices
  use fuge_kept_rows, only: drop_rows
  use fuge_kinds, only: dp, sp
  use fuge_memory, only: check_memory
  use fuge_number_text, only: text
  use fuge_operator_type, only: fuge_operator, operator_bounds
  use fuge_single_grid_plan, only: single_plan => grid_plan
  use fuge_spectrum_bounds, only: spectrum_bounds, transform_rounding, WAVE_ERROR
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_CALL_ORDER, FUGE_ERR_MEMORY
  use fuge_wave_mixture, only: wave_mixture
  implicit none
  private

  !> Equal rectangles in a grid on a half-space: call `set`, then solve. It keeps the coarser grids of its
  !> solves, which takes a third of the memory again. Coefficients are computed when a solve first needs them, on a
  !> surface that is periodic in one direction only by `set`, and on a free grid of more than 4096 x 4096 cells for each
  !> product in double precision.
  !>
  !> Copy it by assignment, never by allocate(source=), because it owns plans of FFTW.
  type, extends(grid_operator), public :: fuge_halfspace_operator
    private
    !> No cells before `set`.
    type(halfspace_grid) :: surface
    !> Subtracted from all coefficients; length per force.
    real(dp) :: datum_value = 0.0_dp
    logical :: measured = .false.
    !> Transforms of rows and columns, of a free surface with some more cells to lengths that are fast.
    type(grid_plan) :: plan
    !> The same in single precision.
    type(single_plan) :: single
    !> On most surfaces they are computed when they are first needed.
    type(kernel_store) :: store
  contains
    procedure :: set
    procedure :: points
    procedure :: apply
    procedure :: datum
    procedure :: magnitude => halfspace_magnitude
    procedure :: precondition
    procedure :: has_single
    procedure :: apply_single
    procedure :: precondition_single
    procedure :: common_magnitude
    procedure :: has_preconditioner_on_bed
    procedure :: precondition_on_bed
    procedure :: wave_slope
    procedure :: grid
    procedure :: coarsen
    procedure :: free_rim
    procedure :: window
    procedure :: bounds => surface_bounds
    procedure, private :: copy
    generic :: assignment(=) => copy
  end type fuge_halfspace_operator

contains

  !> Set the operator of `nx` x `ny` cells of `spacing_x` x `spacing_y`, side by side: point i + nx*(j - 1) is the
  !> cell in column i, along x, and row j.
  !>
  !> `nx`, `ny` >= 1, any numbers; `spacing_x`, `spacing_y` length; `e_star` force per length squared. `element`
  !> FUGE_CENTRE or FUGE_MEAN (default). `boundary` FUGE_FREE (default): the matrix of `fuge_halfspace_matrix`;
  !> FUGE_PERIODIC: the periods are nx*spacing_x and ny*spacing_y, and displacements count from the mean of the surface,
  !> so that A is singular: equal forces on all cells displace nothing; FUGE_PERIODIC_X, FUGE_PERIODIC_Y: in one
  !> direction only. Then the mean along that direction is displaced as a half-plane, by a logarithm without a datum at
  !> infinity: displacements are zero, as those of `fuge_halfplane_operator`, at the distance of twice the length of the
  !> grid along the free direction, ny*spacing_y for FUGE_PERIODIC_X. `measured` (default .false.) lets FFTW time its
  !> algorithms and take the fastest. `body`: the surface of `fuge_layered_body`, if the body has layers; `e_star` is
  !> theirs then, and on a rigid base equal forces displace a periodic surface too. The arguments are ten, because the
  !> last four are optional and named by the caller. Errors, which leave the operator as it was: FUGE_ERR_SIZE,
  !> FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH, FUGE_ERR_MODULUS, FUGE_ERR_ELEMENT, FUGE_ERR_OPTION, FUGE_ERR_OVERFLOW,
  !> FUGE_ERR_MEMORY; FUGE_ERR_UNSUPPORTED in a library without FFTW.
  subroutine set(self, nx, ny, spacing_x, spacing_y, e_star, info, element, boundary, measured, body)
    class(fuge_halfspace_operator), intent(inout) :: self
    integer, intent(in) :: nx, ny
    real(dp), intent(in) :: spacing_x, spacing_y, e_star
    type(fuge_info), intent(out) :: info
    integer, intent(in), optional :: element, boundary
    logical, intent(in), optional :: measured
    type(wave_mixture), intent(in), optional :: body
    type(fuge_halfspace_operator) :: new

    new%surface%cells = [nx, ny]
    new%surface%spacing = [spacing_x, spacing_y]
    new%surface%e_star = e_star
    if (present(element)) new%surface%element = element
    if (present(boundary)) new%surface%boundary = boundary
    if (present(measured)) new%measured = measured
    if (present(body)) new%surface%body = body
    call check_grid(new%surface, info)
    if (info%failed()) return
    call complete(new%surface)
    call prepare(new, info)
    if (.not. info%failed()) call move_contents(self, new)
  end subroutine set

  !> Plan and compute what belongs to the cells of `operator`. Errors: FUGE_ERR_MEMORY.
  subroutine prepare(operator, info)
    type(fuge_halfspace_operator), intent(inout) :: operator
    type(fuge_info), intent(inout) :: info
    type(fuge_info) :: single_info
    logical :: suited
    integer :: status

    call plan_transforms(operator, info)
    if (info%failed()) return
    ! Lines of an odd number of cells would not be aligned. Where memory is short there are no such products.
    suited = all(mod(operator%plan%length, 2) == 0)
    if (suited) call operator%single%set(operator%surface%cells, operator%plan%length, single_info, operator%measured)
    call operator%store%create(status)
    if (status == 0 .and. .not. computes_later(operator%surface)) then
      call operator%store%compute_all(operator%surface, operator%plan, suited .and. .not. single_info%failed(), &
                                      operator%datum_value, status)
    end if
    if (status /= 0) call report_no_memory(operator, info)
    if (.not. info%failed()) call operator%make_room(count_coarser(operator%surface))
  end subroutine prepare

  !> Plan the transforms. Error: FUGE_ERR_MEMORY.
  subroutine plan_transforms(operator, info)
    use fuge_halfspace_spectra, only: bytes_needed
    type(fuge_halfspace_operator), intent(inout) :: operator
    type(fuge_info), intent(inout) :: info
    real(dp) :: bytes
    integer :: length(2)

    call circle_of(operator%surface, length, info)
    if (info%failed()) return
    bytes = bytes_needed(operator%surface, length)
    ! Every solve has forces and displacements of all cells besides.
    if (is_large(operator%surface)) bytes = bytes_in_slices(operator%surface, length(2)) &
                                            + 16.0_dp*product(real(operator%surface%cells, dp))
    call check_memory(bytes, 'nx = '//text(operator%surface%cells(1))//', ny = ' &
                      //text(operator%surface%cells(2))//':', info)
    if (info%failed()) return
    call operator%plan%set(operator%surface%cells, length, info, operator%measured)
    if (info%status == FUGE_ERR_MEMORY) call report_no_memory(operator, info)
  end subroutine plan_transforms

  subroutine report_no_memory(operator, info)
    type(fuge_halfspace_operator), intent(in) :: operator
    type(fuge_info), intent(inout) :: info

    call report(info, FUGE_ERR_MEMORY, 'no memory for nx = '//text(operator%surface%cells(1))//', ny = ' &
                //text(operator%surface%cells(2))//': use a coarser grid')
  end subroutine report_no_memory

  !> Move the contents of `new` to `self`.
  subroutine move_contents(self, new)
    class(fuge_halfspace_operator), intent(inout) :: self
    type(fuge_halfspace_operator), intent(inout) :: new

    call copy_numbers(self, new)
    call self%store%move_from(new%store)
    call self%plan%move_from(new%plan)
    call self%single%move_from(new%single)
    call self%take_coarser(new)
  end subroutine move_contents

  pure subroutine copy_numbers(self, source)
    class(fuge_halfspace_operator), intent(inout) :: self
    class(fuge_halfspace_operator), intent(in) :: source

    self%surface = source%surface
    self%datum_value = source%datum_value
    self%measured = source%measured
  end subroutine copy_numbers

  !> Assignment. If memory for the copy cannot be allocated, the copy is not set.
  subroutine copy(self, source)
    class(fuge_halfspace_operator), intent(inout) :: self
    class(fuge_halfspace_operator), intent(in) :: source
    integer :: cells(2), stat

    cells = source%surface%cells
    self%surface%cells = 0
    call self%store%copy_from(source%store, stat)
    call self%plan%copy_from(source%plan)
    call copy_numbers(self, source)
    call self%drop_coarser()
    self%surface%cells = 0
    if (stat /= 0 .or. self%plan%cells(1) < 1) return
    self%surface%cells = cells
    call self%single%copy_from(source%single)
    call self%make_room(count_coarser(self%surface))
  end subroutine copy

  !> Number of cells nx*ny; 0 before `set`.
  pure function points(self) result(n)
    class(fuge_halfspace_operator), intent(in) :: self
    integer :: n

    n = product(self%surface%cells)
  end function points

  !> u = (A - datum) f, with errors of about 1e-16 of its largest value.
  !>
  !> `force` (nx*ny), force; `displacement` (nx*ny), length. Safe in several threads at once. `status`: 0,
  !> FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE or FUGE_ERR_MEMORY.
  subroutine apply(self, force, displacement, status)
    class(fuge_halfspace_operator), intent(in) :: self
    real(dp), intent(in) :: force(:)
    real(dp), intent(out) :: displacement(:)
    integer, intent(out) :: status

    call self%check_sizes(size(force), size(displacement), status)
    if (status /= FUGE_DONE) return
    ! In slices even if there is a kernel, so that the bits of a product do not depend on what was solved before.
    if (is_large(self%surface)) then
      ! Products in single precision need their rows, but not now.
      if (associated(self%single%kept)) call drop_rows(self%single%kept)
      call multiply_in_slices(self%surface, self%plan, size(force), force, displacement, status)
      return
    end if
    call require_kernels(self, status)
    if (status == FUGE_DONE) call self%store%kernels%influence%convolve(self%plan, size(force), force, displacement, &
                                                                        status)
  end subroutine apply

  !> The number subtracted from all coefficients, length per force; 0 unless one direction only is periodic.
  function datum(self)
    class(fuge_halfspace_operator), intent(in) :: self
    real(dp) :: datum

    datum = self%datum_value
  end function datum

  !> `magnitude` (nx*ny), length: the largest displacement; on a periodic surface, where equal forces
  !> displace nothing, at least the terms of their displacement.
  subroutine halfspace_magnitude(self, force, displacement, magnitude)
    class(fuge_halfspace_operator), intent(in) :: self
    real(dp), intent(in) :: force(:), displacement(:)
    real(dp), intent(out) :: magnitude(:)

    magnitude = self%common_magnitude(maxval(abs(displacement)), sum(abs(force)))
  end subroutine halfspace_magnitude

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

    call self%check_sizes(size(displacement), size(force), status)
    if (status == FUGE_DONE) call require_kernels(self, status)
    if (status /= FUGE_DONE) return
    call self%store%kernels%inverse%convolve(self%plan, size(force), displacement, force, status)
  end subroutine precondition

  !> The kernels in double precision, unless they came with the grid. `status`: 0 or FUGE_ERR_MEMORY.
  subroutine require_kernels(operator, status)
    type(fuge_halfspace_operator), intent(in) :: operator
    integer, intent(out) :: status

    status = FUGE_DONE
    if (.not. computes_later(operator%surface)) return
    call operator%store%require_double(operator%surface, operator%plan, status)
    if (status /= 0) status = FUGE_ERR_MEMORY
  end subroutine require_kernels

  !> True after `set`.
  function has_preconditioner_on_bed(self) result(preconditioned)
    class(fuge_halfspace_operator), intent(in) :: self
    logical :: preconditioned

    preconditioned = self%has_preconditioner()
  end function has_preconditioner_on_bed

  !> That of waves of eight cells.
  function wave_slope(self, levels) result(slope)
    class(fuge_halfspace_operator), intent(in) :: self
    integer, intent(in) :: levels
    real(dp) :: slope

    slope = slope_of_waves(self%surface, levels)
  end function wave_slope

  !> The inverse on a periodic surface on a bed of the `compliance`, length per force; otherwise as `precondition`.
  subroutine precondition_on_bed(self, compliance, displacement, force, status)
    class(fuge_halfspace_operator), intent(in) :: self
    real(dp), intent(in) :: compliance, displacement(:)
    real(dp), intent(out) :: force(:)
    integer, intent(out) :: status

    call self%check_sizes(size(displacement), size(force), status)
    if (status == FUGE_DONE) call require_kernels(self, status)
    if (status /= FUGE_DONE) return
    call self%store%kernels%inverse%convolve(self%plan, size(displacement), displacement, force, status, compliance)
  end subroutine precondition_on_bed

  !> True after `set`, unless the numbers of the spectra are out of the range of single precision, or the cells of a
  !> circle are odd in number.
  function has_single(self) result(single)
    class(fuge_halfspace_operator), intent(in) :: self
    logical :: single
    integer :: status

    single = self%points() > 0 .and. associated(self%store%kernels) .and. self%single%cells(1) > 0
    if (.not. single) return
    if (computes_later(self%surface)) then
      ! The certificate needs those in double precision, on a large grid none.
      if (.not. is_large(self%surface)) call require_kernels(self, status)
      call self%store%require_single(self%surface, self%plan, single)
    else
      single = self%store%kernels%has_single()
    end if
  end function has_single

  !> `apply` in single precision.
  subroutine apply_single(self, input, result, status)
    class(fuge_halfspace_operator), intent(in) :: self
    real(sp), intent(in) :: input(:)
    real(sp), intent(out) :: result(:)
    integer, intent(out) :: status

    call self%check_sizes(size(input), size(result), status)
    if (status /= FUGE_DONE) return
    call self%store%kernels%single_influence%convolve(self%single, size(input), input, result, status)
  end subroutine apply_single

  !> `precondition` in single precision.
  subroutine precondition_single(self, input, result, status)
    class(fuge_halfspace_operator), intent(in) :: self
    real(sp), intent(in) :: input(:)
    real(sp), intent(out) :: result(:)
    integer, intent(out) :: status

    call self%check_sizes(size(input), size(result), status)
    if (status /= FUGE_DONE) return
    call self%store%kernels%single_inverse%convolve(self%single, size(input), input, result, status)
  end subroutine precondition_single

  !> As `magnitude`.
  function common_magnitude(self, largest, total) result(magnitude)
    class(fuge_halfspace_operator), intent(in) :: self
    real(dp), intent(in) :: largest, total
    real(dp) :: magnitude

    magnitude = max(largest, least_magnitude(self%surface, total))
  end function common_magnitude

  !> [nx, ny].
  function grid(self) result(cells)
    class(fuge_halfspace_operator), intent(in) :: self
    integer :: cells(2)

    cells = self%surface%cells
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

    if (levels < 1 .or. levels > count_coarser(self%surface)) return
    allocate (wider, stat=stat)
    if (stat /= 0) return
    call copy_numbers(wider, self)
    wider%surface = coarsened(self%surface, levels)
    wider%measured = .false.
    call prepare(wider, info)
    if (.not. info%failed()) call move_alloc(wider, coarse)
  end subroutine coarsen

  !> True in each direction that is not periodic and has more than one cell.
  function free_rim(self) result(free)
    class(fuge_halfspace_operator), intent(in) :: self
    logical :: free(2)

    free = self%surface%cells > 1 .and. .not. periodic(self%surface)
  end function free_rim

  !> The window of `fuge_operator`: the same coefficients on fewer cells. A window of a periodic surface knows the
  !> forces of all periods.
  subroutine window(self, first, last, part)
    class(fuge_halfspace_operator), intent(in) :: self
    integer, intent(in) :: first(2), last(2)
    class(fuge_operator), allocatable, intent(out) :: part
    type(fuge_halfspace_operator), allocatable :: smaller
    type(fuge_info) :: info
    integer :: stat

    if (any(first < 1) .or. any(last < first) .or. any(last > self%surface%cells)) return
    allocate (smaller, stat=stat)
    if (stat /= 0) return
    call copy_numbers(smaller, self)
    smaller%measured = .false.
    smaller%surface%cells = last - first + 1
    call prepare(smaller, info)
    if (.not. info%failed()) call move_alloc(smaller, part)
  end subroutine window

  !> Bounds of the eigenvalues of the circulant matrix that holds A, for coefficients off by at most eight units of
  !> roundoff. Nothing is certain of layered bodies, of surfaces that are periodic in one direction, of windows of
  !> periodic ones, and of free grids of more than 4096 x 4096 cells. `status`: 0, FUGE_ERR_CALL_ORDER or
  !> FUGE_ERR_MEMORY.
  subroutine surface_bounds(self, bounds, status)
    use fuge_grid_convolution, only: find_bounds
    class(fuge_halfspace_operator), intent(in) :: self
    type(operator_bounds), intent(out) :: bounds
    integer, intent(out) :: status
    type(spectrum_bounds) :: waves
    real(dp) :: error, transform, transforms(2)

    status = merge(FUGE_DONE, FUGE_ERR_CALL_ORDER, self%points() > 0)
    if (status /= FUGE_DONE .or. self%surface%body%is_set() .or. is_large(self%surface)) return
    if (.not. (self%surface%boundary == FUGE_FREE .or. all(cyclic(self%surface)))) return
    call require_kernels(self, status)
    if (status /= FUGE_DONE) return
    associate (kernel => self%store%kernels%influence)
      call find_bounds(kernel, self%plan, waves)
      transforms = [transform_rounding(self%plan%length(1)*merge(2, 1, kernel%padded(1))), &
                    transform_rounding(self%plan%length(2)*merge(2, 1, kernel%padded(2)))]
    end associate
    if (.not. all(transforms < 1.0_dp)) return
    transform = sum(transforms)
    bounds%most = max(waves%most, abs(waves%constant))
    error = WAVE_ERROR*bounds%most
    ! All coefficients of a free surface are positive, so that their sum is the largest eigenvalue.
    if (self%surface%boundary == FUGE_FREE) error = 8.0_dp*epsilon(1.0_dp)*bounds%most + transform*waves%norm()
    bounds%least_balanced = waves%least - error
    bounds%least = min(waves%least, waves%constant) - error
    bounds%most = bounds%most + error
    bounds%rounding = (2.0_dp*transform + 8.0_dp*epsilon(1.0_dp))*bounds%most + error
  end subroutine surface_bounds

end module fuge_halfspace_fft
