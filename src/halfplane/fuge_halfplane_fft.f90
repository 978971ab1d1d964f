!> The elastic half-plane on a uniform grid, by FFT: A of `fuge_halfplane_matrix`, or of a
!> periodic surface, in O(n log n) operations and O(n) memory.
!>
!> Force k acts on cell k of width h = `spacing`; only differences of positions matter. A
!> depends on h only through the datum of the logarithm, which scales with h: the
!> coefficients are pure numbers over e_star.
module fuge_halfplane_fft
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_constants, only: PI, LARGEST_EXPONENT_OF_2
  use fuge_convolution, only: convolution_kernel, transform_padded
  use fuge_elastic_moduli, only: check_e_star
  use fuge_fft, only: fft_plan, good_length
  use fuge_grid_store, only: grid_store
  use fuge_halfplane_influence, only: check_element, mean_log, FUGE_CENTRE, FUGE_MEAN
  use fuge_hurwitz_zeta, only: hurwitz_zeta
  use fuge_kinds, only: dp
  use fuge_locks, only: lock, unlock, LOCK_GRIDS
  use fuge_number_text, only: text
  use fuge_operator_type, only: fuge_operator
  use fuge_status, only: composed_message, fuge_info, report, FUGE_DONE, FUGE_ERR_CALL_ORDER, FUGE_ERR_MEMORY, &
    FUGE_ERR_NOT_FINITE, FUGE_ERR_OPTION, FUGE_ERR_OVERFLOW, FUGE_ERR_SIZE, FUGE_ERR_WIDTH
  implicit none
  private

  !> `boundary`: beyond the cells the surface is free.
  integer, parameter, public :: FUGE_FREE = 0
  !> `boundary`: the cells repeat periodically.
  integer, parameter, public :: FUGE_PERIODIC = 1

  !> Mean over the period of 2/pi |ln(2 sin(pi x))|: 4 Cl_2(pi/3)/pi^2.
  real(dp), parameter :: MEAN_TERM = 0.41132_dp
  !> A grid of fewer cells is not made by `coarsen`.
  integer, parameter :: FEWEST_CELLS = 32
  !> A coarser grid of fewer cells is transformed by one thread: starting more would take longer.
  integer, parameter :: FEWEST_FOR_THREADS = 32768

  !> Equal cells side by side on a half-plane: call `set`, then solve. It keeps the coarser grids of its
  !> solves, which takes as much memory again.
  !>
  !> Copy it by assignment, never by allocate(source=), because it owns plans of FFTW.
  type, extends(fuge_operator), public :: fuge_halfplane_operator
    private
    !> Number of cells n; 0 before `set`.
    integer :: cells = 0
    integer :: element = FUGE_MEAN
    integer :: boundary = FUGE_FREE
    real(dp) :: spacing = 0.0_dp
    real(dp) :: e_star = 0.0_dp
    !> Subtracted from all coefficients; length per force.
    real(dp) :: datum_value = 0.0_dp
    !> Transforms of the cells, of a free surface with some more to a length that is fast.
    type(fft_plan) :: plan
    !> The eigenvalues of the circulant matrix that holds A, and those of the preconditioner's, the inverse
    !> of a periodic surface.
    type(convolution_kernel) :: influence, inverse
    type(grid_store) :: coarser
  contains
    procedure :: set
    procedure :: set_threads
    procedure :: points
    procedure :: apply
    procedure :: datum
    procedure :: magnitude => halfplane_magnitude
    procedure :: has_preconditioner
    procedure :: precondition
    procedure :: grid
    procedure :: coarsen
    procedure :: kept_coarser
    procedure, private :: copy
    generic :: assignment(=) => copy
  end type fuge_halfplane_operator

contains

  !> Set the operator of `n` cells of width `spacing`, side by side.
  !>
  !> `n` >= 1; `spacing` length; `e_star` = E/(1 - nu^2) in plane strain, force per
  !> length squared. `element` FUGE_CENTRE, FUGE_MEAN (default) or FUGE_HAT; the last
  !> two are the same on a uniform grid. `boundary` FUGE_FREE (default): the matrix of
  !> `fuge_halfplane_matrix`; FUGE_PERIODIC: the period is n*spacing, and displacements
  !> count from the mean of the surface, so that A is singular: equal forces on all
  !> cells displace nothing. `threads` (default 1) is the number for each transform;
  !> `measured` (default .false.) lets FFTW time its algorithms and take the fastest. The
  !> arguments are nine, because the last four are optional and named by the caller.
  !> Errors, which leave the operator as it was: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH,
  !> FUGE_ERR_MODULUS, FUGE_ERR_ELEMENT, FUGE_ERR_OPTION, FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY; FUGE_ERR_UNSUPPORTED in a
  !> library without FFTW.
  subroutine set(self, n, spacing, e_star, info, element, boundary, threads, measured)
    class(fuge_halfplane_operator), intent(inout) :: self
    integer, intent(in) :: n
    real(dp), intent(in) :: spacing, e_star
    type(fuge_info), intent(out) :: info
    integer, intent(in), optional :: element, boundary, threads
    logical, intent(in), optional :: measured
    type(fuge_halfplane_operator) :: new

    new%cells = n
    new%spacing = spacing
    new%e_star = e_star
    if (present(element)) new%element = element
    if (present(boundary)) new%boundary = boundary
    call check_grid(new, info)
    if (.not. info%failed()) call plan_transforms(new, info, threads, measured)
    if (.not. info%failed()) call compute_spectra(new, info)
    if (.not. info%failed()) call new%coarser%create(count_coarser(n))
    if (.not. info%failed()) call move_contents(self, new)
  end subroutine set

  !> Let `threads` >= 1 threads share each transform from now on; the products change by rounding only. Not
  !> during a solve. Errors, which leave the operator as it was: FUGE_ERR_CALL_ORDER before `set`,
  !> FUGE_ERR_OPTION, FUGE_ERR_MEMORY.
  subroutine set_threads(self, threads, info)
    class(fuge_halfplane_operator), intent(inout) :: self
    integer, intent(in) :: threads
    type(fuge_info), intent(out) :: info

    if (self%cells < 1) then
      call report(info, FUGE_ERR_CALL_ORDER, 'the operator has no cells: set it before its threads')
      return
    end if
    call self%plan%set(self%plan%length, info, threads, self%plan%measured)
    if (info%failed()) return
    call self%coarser%create(count_coarser(self%cells))
  end subroutine set_threads

  pure subroutine check_grid(operator, info)
    type(fuge_halfplane_operator), intent(in) :: operator
    type(fuge_info), intent(inout) :: info

    if (operator%cells < 1) then
      call report(info, FUGE_ERR_SIZE, 'n = '//text(operator%cells)//': at least one cell is needed')
    else if (.not. ieee_is_finite(operator%spacing)) then
      call report(info, FUGE_ERR_NOT_FINITE, 'spacing = '//text(operator%spacing)//' is not a finite number')
    else if (.not. operator%spacing > 0.0_dp) then
      call report(info, FUGE_ERR_WIDTH, 'spacing = '//text(operator%spacing) &
                  //' is not positive: it is the width of a cell')
    end if
    if (.not. info%failed()) call check_e_star(operator%e_star, info)
    if (.not. info%failed()) call check_element(operator%element, info)
    if (info%failed()) return
    if (abs(exponent(operator%e_star)) > LARGEST_EXPONENT_OF_2) then
      call report(info, FUGE_ERR_OVERFLOW, 'e_star = '//text(operator%e_star)//' is out of range: choose other units')
    else if (abs(exponent(operator%spacing)) > LARGEST_EXPONENT_OF_2) then
      call report(info, FUGE_ERR_OVERFLOW, 'spacing = '//text(operator%spacing) &
                  //' is out of range: choose another unit of length')
    else if (all(operator%boundary /= [FUGE_FREE, FUGE_PERIODIC])) then
      call report(info, FUGE_ERR_OPTION, 'boundary = '//text(operator%boundary) &
                  //' is unknown: use FUGE_FREE or FUGE_PERIODIC')
    end if
  end subroutine check_grid

  !> Plan the transforms. Errors: FUGE_ERR_MEMORY, FUGE_ERR_OPTION.
  subroutine plan_transforms(operator, info, threads, measured)
    type(fuge_halfplane_operator), intent(inout) :: operator
    type(fuge_info), intent(inout) :: info
    integer, intent(in), optional :: threads
    logical, intent(in), optional :: measured
    integer :: length

    length = operator%cells
    if (operator%boundary == FUGE_FREE) length = good_length(length)
    if (length < 1 .or. (operator%boundary == FUGE_FREE .and. length > (huge(length) - 1)/2)) then
      call report(info, FUGE_ERR_MEMORY, 'n = '//text(operator%cells)//' needs a circle of ' &
                  //text(2.0_dp*real(operator%cells, dp))//' cells in ' &
                  //text(32.0_dp*real(operator%cells, dp))//' bytes, but it takes at most '//text(huge(length)) &
                  //' cells: use half as many')
      return
    end if
    call operator%plan%set(length, info, threads, measured)
    if (info%status == FUGE_ERR_MEMORY) call report(info, FUGE_ERR_MEMORY, 'n = '//text(operator%cells)//': ' &
                                                    //composed_message(info))
  end subroutine plan_transforms

  !> The eigenvalues of A and of the preconditioner. Error: FUGE_ERR_MEMORY.
  subroutine compute_spectra(operator, info)
    type(fuge_halfplane_operator), intent(inout) :: operator
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: inverse_spectrum(:)
    real(dp) :: weight
    integer :: k, length, status

    length = operator%plan%length
    allocate (inverse_spectrum(0:length/2), stat=status)
    if (status == 0) then
      weight = 1.0_dp/real(length, dp)
      do k = 1, length/2
        inverse_spectrum(k) = weight*operator%e_star/periodic_eigenvalue(weight*real(k, dp), operator%element)
      end do
      ! Any positive number is valid; that of the longest wave has the right size.
      inverse_spectrum(0) = weight*operator%e_star &
                            /periodic_eigenvalue(1.0_dp/real(max(length, 2), dp), operator%element)
      call operator%inverse%set_cyclic(length, inverse_spectrum, status)
    end if
    if (status == FUGE_DONE .and. operator%boundary == FUGE_PERIODIC) then
      inverse_spectrum = weight**2/inverse_spectrum
      inverse_spectrum(0) = 0.0_dp
      call operator%influence%set_cyclic(length, inverse_spectrum, status)
    else if (status == FUGE_DONE) then
      deallocate (inverse_spectrum)
      call compute_free_spectrum(operator, status)
    end if
    if (status /= FUGE_DONE) call report(info, FUGE_ERR_MEMORY, 'out of memory: n = '//text(operator%cells)//' needs ' &
                                         //text(48.0_dp*real(operator%cells, dp))//' bytes')
  end subroutine compute_spectra

  !> Eigenvalue of A on a periodic surface, times e_star.
  !>
  !> `fraction` = m/n, 0 < fraction <= 1/2, for the wave of m periods in n cells. The eigenvalue
  !> is a sum over all waves that coincide on the cells (aliases): of wave number q, 2/(e_star |q|)
  !> is the displacement by a wave of pressure (K. L. Johnson, Contact Mechanics, 1985,
  !> equation 13.6), and sinc(q h/2), or its square for FUGE_MEAN and FUGE_HAT, the
  !> transfer function of the element. The reflection formulas of zeta leave one sum, over
  !> the aliases of one sign.
  elemental function periodic_eigenvalue(fraction, element) result(eigenvalue)
    real(dp), intent(in) :: fraction
    integer, intent(in) :: element
    real(dp) :: eigenvalue
    real(dp) :: sine

    sine = sin(PI*fraction)
    if (element == FUGE_CENTRE) then
      eigenvalue = 0.5_dp*sine/PI**2 &
                   *(hurwitz_zeta(2, 0.5_dp - 0.5_dp*fraction) - hurwitz_zeta(2, 1.0_dp - 0.5_dp*fraction))
    else
      eigenvalue = 2.0_dp*sine**2/PI**3*hurwitz_zeta(3, 1.0_dp - fraction)
    end if
    eigenvalue = eigenvalue + cos(PI*fraction)/sine
  end function periodic_eigenvalue

  !> The eigenvalues for a free surface, on a circle so long that the distance of any two cells is not
  !> shorter the other way round: ln of the distance the shorter way.
  !>
  !> The datum is the mean over the circle. Without it the eigenvalue of the constant, the sum of
  !> all coefficients, would be the largest by far, and so would its rounding error.
  subroutine compute_free_spectrum(operator, status)
    type(fuge_halfplane_operator), intent(inout) :: operator
    integer, intent(out) :: status
    real(dp), allocatable :: coefficient(:), even(:), odd(:)
    real(dp) :: factor, mean, observed
    integer :: half, k

    half = operator%plan%length
    allocate (coefficient(0:half), even(0:half/2), odd(half/2), stat=status)
    if (status /= 0) return
    observed = merge(0.0_dp, 1.0_dp, operator%element == FUGE_CENTRE)
    do k = 0, half
      coefficient(k) = mean_log(real(k, dp), observed, 1.0_dp)
    end do
    mean = (coefficient(0) + coefficient(half) + 2.0_dp*sum(coefficient(1:half - 1)))/real(2*half, dp)
    factor = -2.0_dp/(PI*operator%e_star)
    coefficient = factor*(coefficient - mean)
    ! In units of h, as the coefficients: the D of the matrix is 2 n.
    operator%datum_value = factor*(mean - log(2.0_dp*real(operator%cells, dp)))
    call transform_padded(operator%plan, coefficient, even, odd, status)
    if (status /= FUGE_DONE) return
    even(0) = 0.0_dp
    call operator%influence%set_padded(half, even, odd, status)
  end subroutine compute_free_spectrum

  !> Move the contents of `new` to `self`.
  subroutine move_contents(self, new)
    class(fuge_halfplane_operator), intent(inout) :: self
    type(fuge_halfplane_operator), intent(inout) :: new

    self%cells = new%cells
    self%element = new%element
    self%boundary = new%boundary
    self%spacing = new%spacing
    self%e_star = new%e_star
    self%datum_value = new%datum_value
    call self%influence%move_from(new%influence)
    call self%inverse%move_from(new%inverse)
    call self%plan%move_from(new%plan)
    call self%coarser%move_from(new%coarser)
  end subroutine move_contents

  !> Assignment. If memory for the copy cannot be allocated, the copy is not set.
  subroutine copy(self, source)
    class(fuge_halfplane_operator), intent(inout) :: self
    class(fuge_halfplane_operator), intent(in) :: source
    integer :: cells, stat

    cells = source%cells
    self%cells = 0
    ! Arrays of the right size are kept, because the source may be a bitwise copy of self that shares them.
    call self%influence%copy_from(source%influence, stat)
    if (stat == 0) call self%inverse%copy_from(source%inverse, stat)
    self%plan = source%plan
    self%element = source%element
    self%boundary = source%boundary
    self%spacing = source%spacing
    self%e_star = source%e_star
    self%datum_value = source%datum_value
    call self%coarser%clear()
    if (stat /= 0 .or. self%plan%length < 1) return
    self%cells = cells
    call self%coarser%create(count_coarser(cells))
  end subroutine copy

  !> Number of cells n; 0 before `set`.
  pure function points(self) result(n)
    class(fuge_halfplane_operator), intent(in) :: self
    integer :: n

    n = self%cells
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

    call check_sizes(self, size(force), size(displacement), status)
    if (status == FUGE_DONE) call self%influence%convolve(self%plan, force, displacement, status)
  end subroutine apply

  pure subroutine check_sizes(self, first, second, status)
    class(fuge_halfplane_operator), intent(in) :: self
    integer, intent(in) :: first, second
    integer, intent(out) :: status

    status = FUGE_DONE
    if (self%cells < 1) then
      status = FUGE_ERR_CALL_ORDER
    else if (first /= self%cells .or. second /= self%cells) then
      status = FUGE_ERR_SIZE
    end if
  end subroutine check_sizes

  !> What is subtracted from all coefficients, length per force; 0 for a periodic surface.
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

    magnitude = maxval(abs(displacement))
    if (self%boundary == FUGE_PERIODIC) magnitude = max(magnitude, MEAN_TERM*sum(abs(force))/self%e_star)
  end subroutine halfplane_magnitude

  !> True after `set`.
  function has_preconditioner(self) result(preconditioned)
    class(fuge_halfplane_operator), intent(in) :: self
    logical :: preconditioned

    preconditioned = self%cells > 0
  end function has_preconditioner

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

    call check_sizes(self, size(displacement), size(force), status)
    if (status == FUGE_DONE) call self%inverse%convolve(self%plan, displacement, force, status)
  end subroutine precondition

  !> [n, 1] after `set`: the cells are side by side in the order of their numbers.
  function grid(self) result(cells)
    class(fuge_halfplane_operator), intent(in) :: self
    integer :: cells(2)

    cells = [self%cells, min(self%cells, 1)]
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
    real(dp) :: width
    integer :: coarse_cells, stat, threads

    if (levels < 1 .or. levels > digits(self%cells)) return
    coarse_cells = (self%cells - 1)/2**levels + 1
    if (coarse_cells < FEWEST_CELLS) return
    width = self%spacing*2.0_dp**levels
    if (self%boundary == FUGE_PERIODIC) width = self%spacing*(real(self%cells, dp)/real(coarse_cells, dp))
    allocate (wider, stat=stat)
    if (stat /= 0) return
    threads = merge(self%plan%threads, 1, coarse_cells >= FEWEST_FOR_THREADS)
    call wider%set(coarse_cells, width, self%e_star, info, self%element, self%boundary, threads)
    if (.not. info%failed()) call move_alloc(wider, coarse)
  end subroutine coarsen

  !> As `coarsen`, but the wider cells are kept with those of the finest grid, for the next solve and for
  !> solves in other threads.
  subroutine kept_coarser(self, levels, coarse)
    class(fuge_halfplane_operator), intent(in) :: self
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

  !> Make element k of the kept grids, unless it has too few cells or memory is short.
  subroutine keep_coarser(self, levels, k)
    class(fuge_halfplane_operator), intent(in) :: self
    integer, intent(in) :: levels, k
    class(fuge_operator), allocatable :: coarse
    type(fuge_halfplane_operator), pointer :: kept
    integer :: stat

    call self%coarsen(levels, coarse)
    if (.not. allocated(coarse)) return
    allocate (kept, stat=stat)
    if (stat /= 0) return
    select type (coarse)
    type is (fuge_halfplane_operator)
      call move_contents(kept, coarse)
    end select
    call kept%coarser%refer_to(self%coarser, k)
    self%coarser%grid(k)%operator => kept
  end subroutine keep_coarser

  !> How many times `cells` cells can be made twice as wide.
  pure function count_coarser(cells) result(count)
    integer, intent(in) :: cells
    integer :: count

    count = 0
    do while ((cells - 1)/2**(count + 1) + 1 >= FEWEST_CELLS)
      count = count + 1
    end do
  end function count_coarser

end module fuge_halfplane_fft
