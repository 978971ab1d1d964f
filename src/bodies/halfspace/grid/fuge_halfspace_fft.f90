!> The elastic half-space on a uniform grid of rectangles, by FFT: A of `fuge_halfspace_matrix`, or of a periodic
!> surface, in O(n log n) operations and O(n) memory.
module fuge_halfspace_fft
  use fuge_grid_operator_type, only: grid_operator
  use fuge_halfspace_grid, only: halfspace_grid, least_magnitude, periodic, slope_of_waves
  use fuge_kinds, only: dp, sp
  use fuge_operator_type, only: fuge_operator, operator_bounds
  use fuge_owned_object, only: object_owner
  use fuge_status, only: fuge_info
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
    !> Transforms and kernels.
    type(object_owner) :: products
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

  interface
    !> Set the operator of `nx` x `ny` cells of `spacing_x` x `spacing_y`, side by side: point i + nx*(j - 1) is the
    !> cell in column i, along x, and row j.
    !>
    !> `nx`, `ny` >= 1, any numbers; `spacing_x`, `spacing_y` length; `e_star` force per length squared. `element`
    !> FUGE_CENTRE or FUGE_MEAN (default). `boundary` FUGE_FREE (default): the matrix of `fuge_halfspace_matrix`;
    !> FUGE_PERIODIC: the periods are nx*spacing_x and ny*spacing_y, and displacements count from the mean of the
    !> surface, so that A is singular: equal forces on all cells displace nothing; FUGE_PERIODIC_X, FUGE_PERIODIC_Y: in
    !> one direction only. Then the mean along that direction is displaced as a half-plane, by a logarithm without a
    !> datum at infinity: displacements are zero, as those of `fuge_halfplane_operator`, at the distance of twice the
    !> length of the grid along the free direction, ny*spacing_y for FUGE_PERIODIC_X. `measured` (default .false.) lets
    !> FFTW time its algorithms and take the fastest. `body`: the surface of `fuge_layered_body`, if the body has
    !> layers; `e_star` is theirs then, and on a rigid base equal forces displace a periodic surface too. The arguments
    !> are ten, because the last four are optional and named by the caller. Errors, which leave the operator as it was:
    !> FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH, FUGE_ERR_MODULUS, FUGE_ERR_ELEMENT, FUGE_ERR_OPTION,
    !> FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY; FUGE_ERR_UNSUPPORTED in a library without FFTW.
    module subroutine set(self, nx, ny, spacing_x, spacing_y, e_star, info, element, boundary, measured, body)
      class(fuge_halfspace_operator), intent(inout) :: self
      integer, intent(in) :: nx, ny
      real(dp), intent(in) :: spacing_x, spacing_y, e_star
      type(fuge_info), intent(out) :: info
      integer, intent(in), optional :: element, boundary
      logical, intent(in), optional :: measured
      type(wave_mixture), intent(in), optional :: body
    end subroutine set

    !> Assignment. If memory for the copy cannot be allocated, the copy is not set.
    module subroutine copy(self, source)
      class(fuge_halfspace_operator), intent(inout) :: self
      class(fuge_halfspace_operator), intent(in) :: source
    end subroutine copy

    !> u = (A - datum) f, with errors of about 1e-16 of its largest value.
    !>
    !> `force` (nx*ny), force; `displacement` (nx*ny), length. Safe in several threads at once. `status`: 0,
    !> FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE or FUGE_ERR_MEMORY.
    module subroutine apply(self, force, displacement, status)
      class(fuge_halfspace_operator), intent(in) :: self
      real(dp), intent(in) :: force(:)
      real(dp), intent(out) :: displacement(:)
      integer, intent(out) :: status
    end subroutine apply

    !> The inverse on a periodic surface, exact except for the constant. A free surface is taken
    !> for periodic, which changes little, because the coefficients of the inverse fall off
    !> with the third power of the distance, and takes a quarter of the time of a product.
    !>
    !> `displacement` (nx*ny), length; `force` (nx*ny), force; `status` as for `apply`.
    module subroutine precondition(self, displacement, force, status)
      class(fuge_halfspace_operator), intent(in) :: self
      real(dp), intent(in) :: displacement(:)
      real(dp), intent(out) :: force(:)
      integer, intent(out) :: status
    end subroutine precondition

    !> The inverse on a periodic surface on a bed of the `compliance`, length per force; otherwise as `precondition`.
    module subroutine precondition_on_bed(self, compliance, displacement, force, status)
      class(fuge_halfspace_operator), intent(in) :: self
      real(dp), intent(in) :: compliance, displacement(:)
      real(dp), intent(out) :: force(:)
      integer, intent(out) :: status
    end subroutine precondition_on_bed

    !> True after `set`, unless the numbers of the spectra are out of the range of single precision, or the cells of a
    !> circle are odd in number.
    module function has_single(self) result(single)
      class(fuge_halfspace_operator), intent(in) :: self
      logical :: single
    end function has_single

    !> `apply` in single precision.
    module subroutine apply_single(self, input, result, status)
      class(fuge_halfspace_operator), intent(in) :: self
      real(sp), intent(in) :: input(:)
      real(sp), intent(out) :: result(:)
      integer, intent(out) :: status
    end subroutine apply_single

    !> `precondition` in single precision.
    module subroutine precondition_single(self, input, result, status)
      class(fuge_halfspace_operator), intent(in) :: self
      real(sp), intent(in) :: input(:)
      real(sp), intent(out) :: result(:)
      integer, intent(out) :: status
    end subroutine precondition_single

    !> Cells 2**levels times as wide in both directions, with the same element and boundary. In a periodic direction the
    !> period is the same, which may make them a little narrower. A direction of one cell keeps it. Unallocated for
    !> fewer than 32 wider cells, and without memory.
    module subroutine coarsen(self, levels, coarse)
      class(fuge_halfspace_operator), intent(in) :: self
      integer, intent(in) :: levels
      class(fuge_operator), allocatable, intent(out) :: coarse
    end subroutine coarsen

    !> The window of `fuge_operator`: the same coefficients on fewer cells. A window of a periodic surface knows the
    !> forces of all periods.
    module subroutine window(self, first, last, part)
      class(fuge_halfspace_operator), intent(in) :: self
      integer, intent(in) :: first(2), last(2)
      class(fuge_operator), allocatable, intent(out) :: part
    end subroutine window

    !> Bounds of the eigenvalues of the circulant matrix that holds A, for coefficients off by at most eight units of
    !> roundoff. Nothing is certain of layered bodies, of surfaces that are periodic in one direction, of windows of
    !> periodic ones, and of free grids of more than 4096 x 4096 cells. `status`: 0, FUGE_ERR_CALL_ORDER or
    !> FUGE_ERR_MEMORY.
    module subroutine surface_bounds(self, bounds, status)
      class(fuge_halfspace_operator), intent(in) :: self
      type(operator_bounds), intent(out) :: bounds
      integer, intent(out) :: status
    end subroutine surface_bounds
  end interface

contains

  !> Number of cells nx*ny; 0 before `set`.
  pure function points(self) result(n)
    class(fuge_halfspace_operator), intent(in) :: self
    integer :: n

    n = product(self%surface%cells)
  end function points

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

  !> True in each direction that is not periodic and has more than one cell.
  function free_rim(self) result(free)
    class(fuge_halfspace_operator), intent(in) :: self
    logical :: free(2)

    free = self%surface%cells > 1 .and. .not. periodic(self%surface)
  end function free_rim

end module fuge_halfspace_fft
