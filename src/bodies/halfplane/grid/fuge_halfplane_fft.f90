!> The elastic half-plane on a uniform grid, by FFT: A of `fuge_halfplane_matrix`, or of a
!> periodic surface, in O(n log n) operations and O(n) memory.
!>
!> Force k acts on cell k of width h = `spacing`; only differences of positions matter. A
!> depends on h only through the datum of the logarithm, which scales with h: the
!> coefficients are pure numbers over e_star.
module fuge_halfplane_fft
  use fuge_cell_elements, only: FUGE_FREE, FUGE_PERIODIC
  use fuge_constants, only: PI
  use fuge_convolution, only: convolution_kernel
  use fuge_grid_operator_type, only: grid_operator
  use fuge_halfplane_line, only: check_line, circle_of, coarsened, count_coarser, halfplane_line, least_magnitude
  use fuge_kinds, only: dp
  use fuge_line_plan, only: line_plan
  use fuge_number_text, only: text
  use fuge_operator_type, only: fuge_operator, operator_bounds
  use fuge_point_chunks, only: chunk_count, chunked_pass
  use fuge_spectrum_bounds, only: transform_rounding, WAVE_ERROR
  use fuge_status, only: composed_message, fuge_info, report, FUGE_DONE, FUGE_ERR_CALL_ORDER, FUGE_ERR_MEMORY
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
    !> Transforms of the cells, of a free surface with some more to a length that is fast.
    type(line_plan) :: plan
    !> The eigenvalues of the circulant matrix that holds A, and those of the preconditioner's, the inverse
    !> of a periodic surface.
    type(convolution_kernel) :: influence, inverse
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

  !> Finds the largest magnitude of `values` and the sum of those of `force`, or without `force` sets all values to
  !> `least`. The pointers are not contiguous, because contiguous arguments would be copies of those of the operator.
  type, extends(chunked_pass) :: magnitude_pass
    real(dp), pointer :: force(:) => null(), values(:) => null()
    real(dp) :: least = 0.0_dp
  contains
    procedure :: do_chunk => measure_chunk
  end type magnitude_pass

contains

  !> Set the operator of `n` cells of width `spacing`, side by side.
  !>
  !> `n` >= 1; `spacing` length; `e_star` = E/(1 - nu^2) in plane strain, force per length squared. `element`
  !> FUGE_CENTRE, FUGE_MEAN (default) or FUGE_HAT; the last two are the same on a uniform grid. `boundary` FUGE_FREE
  !> (default): the matrix of `fuge_halfplane_matrix`; FUGE_PERIODIC: the period is n*spacing, and displacements count
  !> from the mean of the surface, so that A is singular: equal forces on all cells displace nothing, unless the body
  !> lies on a rigid base. `measured` (default .false.) lets FFTW time its algorithms and take the fastest. `body`: the
  !> surface of `fuge_layered_body`, if the body has layers; `e_star` is theirs then. The arguments are nine, because
  !> the last four are optional and named by the caller. Errors, which leave the operator as it was: FUGE_ERR_SIZE,
  !> FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH, FUGE_ERR_MODULUS, FUGE_ERR_ELEMENT, FUGE_ERR_OPTION, FUGE_ERR_OVERFLOW,
  !> FUGE_ERR_MEMORY; FUGE_ERR_UNSUPPORTED in a library without FFTW.
  subroutine set(self, n, spacing, e_star, info, element, boundary, measured, body)
    use fuge_halfplane_spectra, only: compute_line_spectra
    class(fuge_halfplane_operator), intent(inout) :: self
    integer, intent(in) :: n
    real(dp), intent(in) :: spacing, e_star
    type(fuge_info), intent(out) :: info
    integer, intent(in), optional :: element, boundary
    logical, intent(in), optional :: measured
    type(wave_mixture), intent(in), optional :: body
    type(fuge_halfplane_operator) :: new

    new%line%cells = n
    new%line%spacing = spacing
    new%line%e_star = e_star
    if (present(element)) new%line%element = element
    if (present(boundary)) new%line%boundary = boundary
    if (present(body)) new%line%body = body
    call check_line(new%line, info)
    if (.not. info%failed()) call plan_transforms(new, info, measured)
    if (.not. info%failed()) call compute_line_spectra(new%line, new%plan, new%influence, new%inverse, &
                                                       new%datum_value, info)
    if (.not. info%failed()) call new%make_room(count_coarser(n))
    if (.not. info%failed()) call move_contents(self, new)
  end subroutine set

  !> Plan the transforms. Errors: FUGE_ERR_MEMORY.
  subroutine plan_transforms(operator, info, measured)
    type(fuge_halfplane_operator), intent(inout) :: operator
    type(fuge_info), intent(inout) :: info
    logical, intent(in), optional :: measured
    integer :: length

    call circle_of(operator%line, length, info)
    if (info%failed()) return
    call operator%plan%set(length, info, measured=measured)
    if (info%status == FUGE_ERR_MEMORY) call report(info, FUGE_ERR_MEMORY, 'n = '//text(operator%line%cells)//': ' &
                                                    //composed_message(info))
  end subroutine plan_transforms

  !> Move the contents of `new` to `self`.
  subroutine move_contents(self, new)
    class(fuge_halfplane_operator), intent(inout) :: self
    type(fuge_halfplane_operator), intent(inout) :: new

    self%line = new%line
    self%datum_value = new%datum_value
    call self%influence%move_from(new%influence)
    call self%inverse%move_from(new%inverse)
    call self%plan%move_from(new%plan)
    call self%take_coarser(new)
  end subroutine move_contents

  !> Assignment. If memory for the copy cannot be allocated, the copy is not set.
  subroutine copy(self, source)
    class(fuge_halfplane_operator), intent(inout) :: self
    class(fuge_halfplane_operator), intent(in) :: source
    integer :: cells, stat

    cells = source%line%cells
    self%line%cells = 0
    ! Arrays of the right size are kept, because the source may be a bitwise copy of self that shares them.
    call self%influence%copy_from(source%influence, stat)
    if (stat == 0) call self%inverse%copy_from(source%inverse, stat)
    call self%plan%copy_from(source%plan)
    self%line = source%line
    self%datum_value = source%datum_value
    call self%drop_coarser()
    self%line%cells = 0
    if (stat /= 0 .or. self%plan%length < 1) return
    self%line%cells = cells
    call self%make_room(count_coarser(cells))
  end subroutine copy

  !> Number of cells n; 0 before `set`.
  pure function points(self) result(n)
    class(fuge_halfplane_operator), intent(in) :: self
    integer :: n

    n = self%line%cells
  end function points

  !> u = (A - datum) f, with errors of about 1e-16 of its largest value.
  !>
  !> `force` (n), force; `displacement` (n), length. Safe in several threads at once. `status`: 0,
  !> FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE or FUGE_ERR_MEMORY.
  subroutine apply(self, force, displacement, status)
    class(fuge_halfplane_operator), intent(in) :: self
    real(dp), intent(in) :: force(:)
    real(dp), intent(out) :: displacement(:)
    integer, intent(out) :: status

    call self%check_sizes(size(force), size(displacement), status)
    if (status == FUGE_DONE) call self%influence%convolve(self%plan, force, displacement, status)
  end subroutine apply

  !> The constant that is subtracted from all coefficients, length per force; 0 for a periodic surface.
  function datum(self)
    class(fuge_halfplane_operator), intent(in) :: self
    real(dp) :: datum

    datum = self%datum_value
  end function datum

  !> `magnitude` (n), length: the largest displacement; on a periodic surface, where equal forces
  !> displace nothing, at least the terms of their displacement.
  subroutine halfplane_magnitude(self, force, displacement, magnitude)
    class(fuge_halfplane_operator), intent(in) :: self
    real(dp), intent(in) :: force(:), displacement(:)
    real(dp), intent(out) :: magnitude(:)

    if (chunk_count(size(force)) == 1) then
      magnitude = max(maxval(abs(displacement)), least_magnitude(self%line, sum(abs(force))))
    else
      call measure_in_chunks(self%line, force, displacement, magnitude)
    end if
  end subroutine halfplane_magnitude

  subroutine measure_in_chunks(line, force, displacement, magnitude)
    type(halfplane_line), intent(in) :: line
    real(dp), intent(in), target :: force(:), displacement(:)
    real(dp), intent(out), target :: magnitude(:)
    type(magnitude_pass) :: pass

    pass%force => force
    pass%values => displacement
    call pass%run(size(force), 2)
    pass%least = max(pass%largest(1), least_magnitude(line, pass%total(2)))
    pass%force => null()
    pass%values => magnitude
    call pass%run(size(magnitude), 0)
  end subroutine measure_in_chunks

  subroutine measure_chunk(self, k, first, last)
    class(magnitude_pass), intent(inout) :: self
    integer, intent(in) :: k, first, last

    if (associated(self%force)) then
      self%found(:, k) = [maxval(abs(self%values(first:last))), sum(abs(self%force(first:last)))]
    else
      self%values(first:last) = self%least
    end if
  end subroutine measure_chunk

  !> The inverse on a periodic surface, exact except for the constant. A free surface is taken
  !> for periodic, which changes little, because the coefficients of the inverse fall off
  !> with the square of the distance, and takes half the time of a product.
  !>
  !> `displacement` (n), length; `force` (n), force; `status` as for `apply`.
  subroutine precondition(self, displacement, force, status)
    class(fuge_halfplane_operator), intent(in) :: self
    real(dp), intent(in) :: displacement(:)
    real(dp), intent(out) :: force(:)
    integer, intent(out) :: status

    call self%check_sizes(size(displacement), size(force), status)
    if (status == FUGE_DONE) call self%inverse%convolve(self%plan, displacement, force, status)
  end subroutine precondition

  !> True after `set`.
  function has_preconditioner_on_bed(self) result(preconditioned)
    class(fuge_halfplane_operator), intent(in) :: self
    logical :: preconditioned

    preconditioned = self%has_preconditioner()
  end function has_preconditioner_on_bed

  !> The inverse on a periodic surface on a bed of the `compliance`, length per force; otherwise as `precondition`.
  subroutine precondition_on_bed(self, compliance, displacement, force, status)
    class(fuge_halfplane_operator), intent(in) :: self
    real(dp), intent(in) :: compliance, displacement(:)
    real(dp), intent(out) :: force(:)
    integer, intent(out) :: status

    call self%check_sizes(size(displacement), size(force), status)
    if (status == FUGE_DONE) call self%inverse%convolve(self%plan, displacement, force, status, compliance)
  end subroutine precondition_on_bed

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

  !> Bounds of the eigenvalues of the circulant matrix that holds A, for coefficients off by at most eight units of
  !> roundoff of their terms. Nothing is certain of layered bodies. `status`: 0 or FUGE_ERR_CALL_ORDER.
  subroutine line_bounds(self, bounds, status)
    class(fuge_halfplane_operator), intent(in) :: self
    type(operator_bounds), intent(out) :: bounds
    integer, intent(out) :: status
    real(dp) :: circle, error, largest, transform

    status = merge(FUGE_DONE, FUGE_ERR_CALL_ORDER, self%points() > 0)
    if (status /= FUGE_DONE .or. self%line%body%is_set()) return
    if (self%line%boundary == FUGE_PERIODIC) then
      transform = transform_rounding(self%plan%length)
      error = WAVE_ERROR*self%influence%bounds%most
    else
      transform = transform_rounding(2*self%plan%length)
      circle = 2.0_dp*real(self%plan%length, dp)
      largest = 2.0_dp/(PI*self%line%e_star)*(log(circle) + 3.0_dp)
      error = 16.0_dp*epsilon(1.0_dp)*(largest + abs(self%datum_value))
      bounds%datum_rounding = error
      error = circle*error + transform*self%influence%bounds%norm()
    end if
    if (.not. transform < 1.0_dp) return
    associate (waves => self%influence%bounds)
      bounds%least_balanced = waves%least - error
      if (self%line%boundary == FUGE_FREE) bounds%least = min(bounds%least_balanced, &
                                                              waves%constant - error + circle*(self%datum_value &
                                                                                               - bounds%datum_rounding))
      bounds%most = max(waves%most, abs(waves%constant)) + error
      bounds%rounding = (2.0_dp*transform + 8.0_dp*epsilon(1.0_dp))*bounds%most + error
    end associate
  end subroutine line_bounds

end module fuge_halfplane_fft
