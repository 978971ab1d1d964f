!> The elastic half-plane on a uniform grid, by FFT: A of `fuge_halfplane_matrix`, or of a
!> periodic surface, in O(n log n) operations and O(n) memory.
!>
!> Force k acts on cell k of width h = `spacing`; only differences of positions matter. A
!> depends on h only through the datum of the logarithm, which scales with h: the
!> coefficients are pure numbers over e_star.
module fuge_halfplane_fft
  use fuge_grid_operator_type, only: grid_operator
  use fuge_halfplane_line, only: coarsened, count_coarser, halfplane_line
  use fuge_kinds, only: dp
  use fuge_operator_type, only: fuge_operator, operator_bounds
  use fuge_owned_object, only: object_owner
  use fuge_status, only: fuge_info
  use fuge_wave_mixture, only: wave_mixture
  implicit none
  private

  !> Equal cells side by side on a half-plane: call `set`, then solve. It keeps the coarser grids of its
  !> solves, which takes as much memory again.
  !>
  !> Copy it by assignment, never by allocate(source=), because it owns plans of FFTW.
  type, extends(grid_operator), public :: fuge_halfplane_operator
    private
    !> No cells before `set`.
    type(halfplane_line) :: line
    !> Subtracted from all coefficients; length per force.
    real(dp) :: datum_value = 0.0_dp
    !> Transforms and kernels.
    type(object_owner) :: products
  contains
    procedure :: set
    procedure :: points
    procedure :: apply
    procedure :: datum
    procedure :: magnitude => halfplane_magnitude
    procedure :: precondition
    procedure :: has_preconditioner_on_bed
    procedure :: precondition_on_bed
    procedure :: grid
    procedure :: coarsen
    procedure :: bounds => line_bounds
    procedure, private :: copy
    generic :: assignment(=) => copy
  end type fuge_halfplane_operator

  interface
    !> Set the operator of `n` cells of width `spacing`, side by side.
    !>
    !> `n` >= 1; `spacing` length; `e_star` = E/(1 - nu^2) in plane strain, force per length squared. `element`
    !> FUGE_CENTRE, FUGE_MEAN (default) or FUGE_HAT; the last two are the same on a uniform grid. `boundary` FUGE_FREE
    !> (default): the matrix of `fuge_halfplane_matrix`; FUGE_PERIODIC: the period is n*spacing, and displacements count
    !> from the mean of the surface, so that A is singular: equal forces on all cells displace nothing, unless the body
    !> lies on a rigid base. `measured` (default .false.) lets FFTW time its algorithms and take the fastest. `body`:
    !> the surface of `fuge_layered_body`, if the body has layers; `e_star` is theirs then. The arguments are nine,
    !> because the last four are optional and named by the caller. Errors, which leave the operator as it was:
    !> FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH, FUGE_ERR_MODULUS, FUGE_ERR_ELEMENT, FUGE_ERR_OPTION,
    !> FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY; FUGE_ERR_UNSUPPORTED in a library without FFTW.
    module subroutine set(self, n, spacing, e_star, info, element, boundary, measured, body)
      class(fuge_halfplane_operator), intent(inout) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: spacing, e_star
      type(fuge_info), intent(out) :: info
      integer, intent(in), optional :: element, boundary
      logical, intent(in), optional :: measured
      type(wave_mixture), intent(in), optional :: body
    end subroutine set

    !> Assignment. If memory for the copy cannot be allocated, the copy is not set.
    module subroutine copy(self, source)
      class(fuge_halfplane_operator), intent(inout) :: self
      class(fuge_halfplane_operator), intent(in) :: source
    end subroutine copy

    !> u = (A - datum) f, with errors of about 1e-16 of its largest value.
    !>
    !> `force` (n), force; `displacement` (n), length. Safe in several threads at once. `status`: 0,
    !> FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE or FUGE_ERR_MEMORY.
    module subroutine apply(self, force, displacement, status)
      class(fuge_halfplane_operator), intent(in) :: self
      real(dp), intent(in) :: force(:)
      real(dp), intent(out) :: displacement(:)
      integer, intent(out) :: status
    end subroutine apply

    !> `magnitude` (n), length: the largest displacement; on a periodic surface, where equal forces
    !> displace nothing, at least the terms of their displacement.
    module subroutine halfplane_magnitude(self, force, displacement, magnitude)
      class(fuge_halfplane_operator), intent(in) :: self
      real(dp), intent(in) :: force(:), displacement(:)
      real(dp), intent(out) :: magnitude(:)
    end subroutine halfplane_magnitude

    !> The inverse on a periodic surface, exact except for the constant. A free surface is taken
    !> for periodic, which changes little, because the coefficients of the inverse fall off
    !> with the square of the distance, and takes half the time of a product.
    !>
    !> `displacement` (n), length; `force` (n), force; `status` as for `apply`.
    module subroutine precondition(self, displacement, force, status)
      class(fuge_halfplane_operator), intent(in) :: self
      real(dp), intent(in) :: displacement(:)
      real(dp), intent(out) :: force(:)
      integer, intent(out) :: status
    end subroutine precondition

    !> The inverse on a periodic surface on a bed of the `compliance`, length per force; otherwise as `precondition`.
    module subroutine precondition_on_bed(self, compliance, displacement, force, status)
      class(fuge_halfplane_operator), intent(in) :: self
      real(dp), intent(in) :: compliance, displacement(:)
      real(dp), intent(out) :: force(:)
      integer, intent(out) :: status
    end subroutine precondition_on_bed

    !> Bounds of the eigenvalues of the circulant matrix that holds A, for coefficients off by at most eight units of
    !> roundoff of their terms. Nothing is certain of layered bodies. `status`: 0 or FUGE_ERR_CALL_ORDER.
    module subroutine line_bounds(self, bounds, status)
      class(fuge_halfplane_operator), intent(in) :: self
      type(operator_bounds), intent(out) :: bounds
      integer, intent(out) :: status
    end subroutine line_bounds
  end interface

contains

  !> Number of cells n; 0 before `set`.
  pure function points(self) result(n)
    class(fuge_halfplane_operator), intent(in) :: self
    integer :: n

    n = self%line%cells
  end function points

  !> The constant that is subtracted from all coefficients, length per force; 0 for a periodic surface.
  function datum(self)
    class(fuge_halfplane_operator), intent(in) :: self
    real(dp) :: datum

    datum = self%datum_value
  end function datum

  !> True after `set`.
  function has_preconditioner_on_bed(self) result(preconditioned)
    class(fuge_halfplane_operator), intent(in) :: self
    logical :: preconditioned

    preconditioned = self%has_preconditioner()
  end function has_preconditioner_on_bed

  !> [n, 1] after `set`: the cells are side by side in the order of their numbers.
  function grid(self) result(cells)
    class(fuge_halfplane_operator), intent(in) :: self
    integer :: cells(2)

    cells = [self%line%cells, min(self%line%cells, 1)]
  end function grid

  !> Wider cells, with the same element and boundary, and on a periodic surface the same period,
  !> which may make them a little narrower than 2**levels cells. Unallocated for fewer than
  !> 32 wider cells, and without memory.
  subroutine coarsen(self, levels, coarse)
    class(fuge_halfplane_operator), intent(in) :: self
    integer, intent(in) :: levels
    class(fuge_operator), allocatable, intent(out) :: coarse
    type(fuge_halfplane_operator), allocatable :: wider
    type(fuge_info) :: info
    type(halfplane_line) :: line
    integer :: stat

    line = coarsened(self%line, levels)
    if (line%cells < 1) return
    allocate (wider, stat=stat)
    if (stat /= 0) return
    call wider%set(line%cells, line%spacing, line%e_star, info, line%element, line%boundary, body=line%body)
    if (.not. info%failed()) call move_alloc(wider, coarse)
  end subroutine coarsen

end module fuge_halfplane_fft
