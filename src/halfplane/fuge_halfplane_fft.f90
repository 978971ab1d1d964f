!> The elastic half-plane on a uniform grid, by FFT: A of `fuge_halfplane_matrix`,
!> or of a periodic surface, in O(n log n) operations and O(n) memory.
!>
!> Force k acts on the cell k of width h = `spacing`; only differences of positions
!> count. A depends on h through the datum of the logarithm alone, and that scales
!> with h: the coefficients are pure numbers over e_star.
module fuge_halfplane_fft
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_constants, only: PI, LARGEST_EXPONENT_OF_2
  use fuge_fft, only: fft_plan, good_length
  use fuge_halfplane_influence, only: mean_log, FUGE_CENTRE, FUGE_MEAN, FUGE_HAT
  use fuge_kinds, only: dp
  use fuge_operator_type, only: fuge_operator
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_SIZE, FUGE_ERR_WIDTH, FUGE_ERR_MODULUS, &
    FUGE_ERR_ELEMENT, FUGE_ERR_NOT_FINITE, FUGE_ERR_MEMORY, FUGE_ERR_OPTION, FUGE_ERR_OVERFLOW, FUGE_ERR_CALL_ORDER
  use fuge_number_text, only: text
  use fuge_hurwitz_zeta, only: hurwitz_zeta
  implicit none
  private

  public :: periodic_eigenvalue

  !> `boundary`: beyond the cells the surface is free.
  integer, parameter, public :: FUGE_FREE = 0
  !> `boundary`: beyond the cells the same comes again and again.
  integer, parameter, public :: FUGE_PERIODIC = 1

  !> Mean over the period of 2/pi |ln(2 sin(pi x))|: 4 Cl_2(pi/3)/pi^2.
  real(dp), parameter :: MEAN_TERM = 0.41132_dp
  !> Fewer points have no coarser grid: they are solved at once.
  integer, parameter :: FEWEST_CELLS = 32

  !> Cells of one width side by side on a half-plane: `set` them, then solve.
  !>
  !> Copy it by assignment, never by allocate(source=): it owns plans of FFTW.
  type, extends(fuge_operator), public :: fuge_halfplane_operator
    private
    !> Number of cells n; 0 while not set.
    integer :: count = 0
    integer :: element = FUGE_MEAN
    integer :: boundary = FUGE_FREE
    real(dp) :: spacing = 0.0_dp
    real(dp) :: e_star = 0.0_dp
    !> Taken out of all coefficients.
    real(dp) :: constant = 0.0_dp
    !> Eigenvalues of the circle that holds the cells, over its length.
    real(dp), allocatable :: spectrum(:)
    type(fft_plan) :: plan
    !> Inverse eigenvalues of the preconditioner's circle, over its length, and the transform of
    !> a preconditioner on a circle of its own, which is not set for a periodic surface.
    real(dp), allocatable :: inverse(:)
    type(fft_plan) :: preconditioner_plan
  contains
    procedure :: set
    procedure :: points
    procedure :: apply
    procedure :: datum
    procedure :: magnitude
    procedure :: has_preconditioner
    procedure :: precondition
    procedure :: in_row
    procedure :: coarsen
    procedure, private :: copy
    generic :: assignment(=) => copy
  end type fuge_halfplane_operator

contains

  !> The operator of `n` cells of width `spacing`, side by side.
  !>
  !> `n` >= 1; `spacing` length; `e_star` = E/(1 - nu^2) in plane strain, force per
  !> length squared. `element` FUGE_CENTRE, FUGE_MEAN (default) or FUGE_HAT, the last
  !> two being one on a uniform grid. `boundary` FUGE_FREE (default): the matrix of
  !> `fuge_halfplane_matrix`; FUGE_PERIODIC: the period is n*spacing, and displacements
  !> count from the mean of the surface, so that A is singular: a force equal on all
  !> cells moves nothing. `threads` (default 1) for each transform; `measured`
  !> (default .false.): let FFTW try what is fastest.
  !> Errors, the operator as it was: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH,
  !> FUGE_ERR_MODULUS, FUGE_ERR_ELEMENT, FUGE_ERR_OPTION, FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY.
  subroutine set(self, n, spacing, e_star, info, element, boundary, threads, measured)
    class(fuge_halfplane_operator), intent(inout) :: self
    integer, intent(in) :: n
    real(dp), intent(in) :: spacing, e_star
    type(fuge_info), intent(out) :: info
    integer, intent(in), optional :: element, boundary, threads
    logical, intent(in), optional :: measured
    type(fuge_halfplane_operator) :: fresh

    fresh%count = n
    fresh%spacing = spacing
    fresh%e_star = e_star
    if (present(element)) fresh%element = element
    if (present(boundary)) fresh%boundary = boundary
    call check_grid(fresh, info)
    if (.not. info%failed()) call make_room(fresh, info, threads, measured)
    if (.not. info%failed()) call make_spectra(fresh, info)
    if (.not. info%failed()) call take(self, fresh)
  end subroutine set

  pure subroutine check_grid(operator, info)
    type(fuge_halfplane_operator), intent(in) :: operator
    type(fuge_info), intent(inout) :: info

    if (operator%count < 1) then
      call report(info, FUGE_ERR_SIZE, 'n = '//text(operator%count)//': at least one cell is needed')
    else if (.not. ieee_is_finite(operator%spacing)) then
      call report(info, FUGE_ERR_NOT_FINITE, 'spacing = '//text(operator%spacing)//' is not a finite number')
    else if (.not. ieee_is_finite(operator%e_star)) then
      call report(info, FUGE_ERR_NOT_FINITE, 'e_star = '//text(operator%e_star)//' is not a finite number')
    else if (.not. operator%spacing > 0.0_dp) then
      call report(info, FUGE_ERR_WIDTH, 'spacing = '//text(operator%spacing) &
                  //' is not positive: it is the width of a cell')
    else if (.not. operator%e_star > 0.0_dp) then
      call report(info, FUGE_ERR_MODULUS, 'e_star = '//text(operator%e_star) &
                  //' is not positive: it is E/(1 - nu^2) in plane strain')
    else if (abs(exponent(operator%e_star)) > LARGEST_EXPONENT_OF_2) then
      call report(info, FUGE_ERR_OVERFLOW, 'e_star = '//text(operator%e_star)//' is out of range: choose other units')
    else if (abs(exponent(operator%spacing)) > LARGEST_EXPONENT_OF_2) then
      call report(info, FUGE_ERR_OVERFLOW, 'spacing = '//text(operator%spacing) &
                  //' is out of range: choose another unit of length')
    else if (all(operator%element /= [FUGE_CENTRE, FUGE_MEAN, FUGE_HAT])) then
      call report(info, FUGE_ERR_ELEMENT, 'element = '//text(operator%element) &
                  //' is unknown: use FUGE_CENTRE, FUGE_MEAN or FUGE_HAT')
    else if (all(operator%boundary /= [FUGE_FREE, FUGE_PERIODIC])) then
      call report(info, FUGE_ERR_OPTION, 'boundary = '//text(operator%boundary) &
                  //' is unknown: use FUGE_FREE or FUGE_PERIODIC')
    end if
  end subroutine check_grid

  !> The transform, and memory for both spectra.
  subroutine make_room(operator, info, threads, measured)
    type(fuge_halfplane_operator), intent(inout) :: operator
    type(fuge_info), intent(inout) :: info
    integer, intent(in), optional :: threads
    logical, intent(in), optional :: measured
    integer :: length, stat

    length = circle(operator)
    if (length < 1) then
      call report(info, FUGE_ERR_MEMORY, 'n = '//text(operator%count)//' needs a transform of ' &
                  //text(2.0_dp*real(operator%count, dp))//' values in ' &
                  //text(32.0_dp*real(operator%count, dp))//' bytes, but FFTW takes at most '//text(huge(length)) &
                  //' values: take half as many cells')
      return
    end if
    call operator%plan%set(length, info, threads, measured)
    if (operator%boundary == FUGE_FREE .and. .not. info%failed()) then
      call operator%preconditioner_plan%set(good_length(operator%count), info, threads, measured)
      length = operator%preconditioner_plan%length
    end if
    if (info%failed()) then
      if (info%status == FUGE_ERR_MEMORY) info%message = 'n = '//text(operator%count)//': '//trim(info%message)
      return
    end if
    allocate (operator%spectrum(0:operator%plan%length/2), operator%inverse(0:length/2), stat=stat)
    if (stat /= 0) call report(info, FUGE_ERR_MEMORY, 'out of memory: n = '//text(operator%count)//' needs ' &
                               //text(16.0_dp*real(length/2 + 1, dp))//' bytes')
  end subroutine make_room

  !> Cells around the circle: n of a periodic surface. A free one is cut out of a circle
  !> so long that no distance between two cells is shorter the other way round; 0 if
  !> that is too long.
  pure function circle(operator) result(length)
    type(fuge_halfplane_operator), intent(in) :: operator
    integer :: length

    length = 0
    if (operator%boundary == FUGE_PERIODIC) then
      length = operator%count
    else if (operator%count - 1 <= (huge(length) - 1)/2) then
      length = good_length(2*(operator%count - 1) + 1)
    end if
  end function circle

  subroutine make_spectra(operator, info)
    type(fuge_halfplane_operator), intent(inout) :: operator
    type(fuge_info), intent(inout) :: info
    real(dp) :: weight
    integer :: k, length, status

    length = 2*(size(operator%inverse) - 1)
    if (operator%boundary == FUGE_PERIODIC) length = operator%count
    weight = 1.0_dp/real(length, dp)
    do k = 1, length/2
      operator%inverse(k) = weight*operator%e_star/periodic_eigenvalue(weight*real(k, dp), operator%element)
    end do
    ! Any positive number would do: the longest wave's is of the right size.
    operator%inverse(0) = weight*operator%e_star/periodic_eigenvalue(1.0_dp/real(max(length, 2), dp), operator%element)
    if (operator%boundary == FUGE_PERIODIC) then
      operator%spectrum = weight**2/operator%inverse
      operator%spectrum(0) = 0.0_dp
    else
      call embed(operator, status)
      if (status /= FUGE_DONE) call report(info, status, 'out of memory: n = '//text(operator%count)//' needs ' &
                                           //text(32.0_dp*real(operator%count, dp))//' bytes')
    end if
  end subroutine make_spectra

  !> Eigenvalue of A on a periodic surface, times e_star.
  !>
  !> `fraction` = m/n, 0 < fraction <= 1/2, for the wave of m periods in n cells. The sum
  !> over all waves that look alike on the cells, with q the number of a wave,
  !> 2/(e_star |q|) the displacement by a pressure wave (K. L. Johnson, Contact
  !> Mechanics, 1985, equation 13.6 for one wave) and sinc(q h/2), or its square
  !> for FUGE_MEAN and FUGE_HAT, the part of it in the elements. The reflection
  !> formulas of zeta leave one sum, of images on one side.
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

  !> Spectrum of the free surface: ln of the distance the shorter way round the circle.
  !>
  !> The datum is the mean over the circle. Without it the wave of length zero, which
  !> is as large as all the coefficients together, would be the largest by far and its
  !> rounding errors with it.
  subroutine embed(operator, status)
    type(fuge_halfplane_operator), intent(inout) :: operator
    integer, intent(out) :: status
    real(dp) :: factor, mean, seen
    integer :: half, k, length

    length = operator%plan%length
    half = length/2
    seen = merge(0.0_dp, 1.0_dp, operator%element == FUGE_CENTRE)
    do k = 0, half
      operator%spectrum(k) = mean_log(real(k, dp), seen, 1.0_dp)
    end do
    mean = (operator%spectrum(0) + operator%spectrum(half) + 2.0_dp*sum(operator%spectrum(1:half - 1)))/real(length, dp)
    factor = -2.0_dp/(PI*operator%e_star)
    do k = 0, half
      operator%spectrum(k) = factor*(operator%spectrum(k) - mean)
    end do
    ! In units of h, as the rest: the matrix' D is 2 n.
    operator%constant = factor*(mean - log(2.0_dp*real(operator%count, dp)))
    call operator%plan%transform_even(operator%spectrum, status)
    operator%spectrum(0) = 0.0_dp
  end subroutine embed

  !> All that `fresh` has.
  subroutine take(self, fresh)
    class(fuge_halfplane_operator), intent(inout) :: self
    type(fuge_halfplane_operator), intent(inout) :: fresh

    self%count = fresh%count
    self%element = fresh%element
    self%boundary = fresh%boundary
    self%spacing = fresh%spacing
    self%e_star = fresh%e_star
    self%constant = fresh%constant
    call move_alloc(fresh%spectrum, self%spectrum)
    call move_alloc(fresh%inverse, self%inverse)
    call self%plan%move_from(fresh%plan)
    call self%preconditioner_plan%move_from(fresh%preconditioner_plan)
  end subroutine take

  !> Without memory for it the copy is not set.
  subroutine copy(self, source)
    class(fuge_halfplane_operator), intent(inout) :: self
    class(fuge_halfplane_operator), intent(in) :: source
    integer :: stat

    stat = 0
    self%count = 0
    ! Arrays of the right size stay: the source may be a copy of self that shares them.
    if (self%plan%length /= source%plan%length &
        .or. self%preconditioner_plan%length /= source%preconditioner_plan%length) then
      if (allocated(self%spectrum)) deallocate (self%spectrum, self%inverse)
      if (source%count > 0) allocate (self%spectrum(0:ubound(source%spectrum, 1)), &
                                      self%inverse(0:ubound(source%inverse, 1)), stat=stat)
    end if
    self%plan = source%plan
    self%preconditioner_plan = source%preconditioner_plan
    if (stat /= 0) call self%plan%free()
    if (self%plan%length < 1 .or. self%preconditioner_plan%length /= source%preconditioner_plan%length) return
    self%spectrum = source%spectrum
    self%inverse = source%inverse
    self%element = source%element
    self%boundary = source%boundary
    self%spacing = source%spacing
    self%e_star = source%e_star
    self%constant = source%constant
    self%count = source%count
  end subroutine copy

  !> Number of cells n; 0 before `set`.
  pure function points(self) result(n)
    class(fuge_halfplane_operator), intent(in) :: self
    integer :: n

    n = self%count
  end function points

  !> The product, exact to some 1e-16 of its largest value.
  !>
  !> `force` (n), `displacement` (n). Safe in several threads at once. `status`: 0, or
  !> FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE, FUGE_ERR_MEMORY.
  subroutine apply(self, force, displacement, status)
    class(fuge_halfplane_operator), intent(in) :: self
    real(dp), intent(in) :: force(:)
    real(dp), intent(out) :: displacement(:)
    integer, intent(out) :: status

    call check_sizes(self, size(force), size(displacement), status)
    if (status == FUGE_DONE) call self%plan%convolve(self%spectrum, force, displacement, status)
  end subroutine apply

  pure subroutine check_sizes(self, first, second, status)
    class(fuge_halfplane_operator), intent(in) :: self
    integer, intent(in) :: first, second
    integer, intent(out) :: status

    status = FUGE_DONE
    if (self%count < 1) then
      status = FUGE_ERR_CALL_ORDER
    else if (first /= self%count .or. second /= self%count) then
      status = FUGE_ERR_SIZE
    end if
  end subroutine check_sizes

  !> 0 for a periodic surface, where displacements count from their mean.
  function datum(self)
    class(fuge_halfplane_operator), intent(in) :: self
    real(dp) :: datum

    datum = self%constant
  end function datum

  !> The largest displacement; on a periodic surface, where even forces displace nothing,
  !> at least what the terms of even forces add up to.
  subroutine magnitude(self, force, displacement, length)
    class(fuge_halfplane_operator), intent(in) :: self
    real(dp), intent(in) :: force(:), displacement(:)
    real(dp), intent(out) :: length(:)

    length = maxval(abs(displacement))
    if (self%boundary == FUGE_PERIODIC) length = max(length, MEAN_TERM*sum(abs(force))/self%e_star)
  end subroutine magnitude

  !> True once it is set: `precondition` is there.
  function has_preconditioner(self) result(preconditioned)
    class(fuge_halfplane_operator), intent(in) :: self
    logical :: preconditioned

    preconditioned = self%count > 0
  end function has_preconditioner

  !> The inverse on a periodic surface, exactly but for the wave of length zero. A free
  !> one is taken for periodic: it makes little difference to an inverse, which falls off
  !> with the square of the distance, and needs half the time of a product.
  !>
  !> `length` (n), `force` (n); `status` as for `apply`.
  subroutine precondition(self, length, force, status)
    class(fuge_halfplane_operator), intent(in) :: self
    real(dp), intent(in) :: length(:)
    real(dp), intent(out) :: force(:)
    integer, intent(out) :: status

    call check_sizes(self, size(length), size(force), status)
    if (status /= FUGE_DONE) return
    if (self%preconditioner_plan%length > 0) then
      call self%preconditioner_plan%convolve(self%inverse, length, force, status)
    else
      call self%plan%convolve(self%inverse, length, force, status)
    end if
  end subroutine precondition

  !> True once it is set: the cells are side by side in the order of their numbers.
  function in_row(self)
    class(fuge_halfplane_operator), intent(in) :: self
    logical :: in_row

    in_row = self%count > 0
  end function in_row

  !> Wider cells, with the same element and boundary; on a periodic surface of the same
  !> period, which may make them a little narrower than 2**doublings cells. None of
  !> fewer than 32 cells, or without memory.
  subroutine coarsen(self, doublings, coarse)
    class(fuge_halfplane_operator), intent(in) :: self
    integer, intent(in) :: doublings
    class(fuge_operator), allocatable, intent(out) :: coarse
    type(fuge_halfplane_operator), allocatable :: wider
    type(fuge_info) :: info
    real(dp) :: width
    integer :: cells, stat

    if (doublings < 1 .or. doublings > digits(self%count)) return
    cells = (self%count - 1)/2**doublings + 1
    if (cells < FEWEST_CELLS) return
    width = self%spacing*2.0_dp**doublings
    if (self%boundary == FUGE_PERIODIC) width = self%spacing*(real(self%count, dp)/real(cells, dp))
    allocate (wider, stat=stat)
    if (stat /= 0) return
    call wider%set(cells, width, self%e_star, info, self%element, self%boundary)
    if (.not. info%failed()) call move_alloc(wider, coarse)
  end subroutine coarsen

end module fuge_halfplane_fft
