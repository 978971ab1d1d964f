!> Equal cells side by side on an elastic half-plane: their numbers, what these may be, coarser cells, and the numbers
!> that spectra of their influence coefficients are made of.
module fuge_halfplane_line
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_cell_elements, only: FUGE_FREE, FUGE_PERIODIC
  use fuge_cell_elements, only: check_element, FUGE_CENTRE, FUGE_MEAN
  use fuge_constants, only: PI, LARGEST_EXPONENT_OF_2
  use fuge_elastic_moduli, only: check_e_star
  use fuge_halfplane_influence, only: mean_log
  use fuge_hurwitz_zeta, only: hurwitz_zeta
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_ERR_MEMORY, FUGE_ERR_NOT_FINITE, FUGE_ERR_OPTION, FUGE_ERR_OVERFLOW, &
    FUGE_ERR_SIZE, FUGE_ERR_WIDTH
  use fuge_wave_mixture, only: wave_mixture
  implicit none
  private

  public :: check_line, circle_of, coarsened, count_coarser, inverse_eigenvalue, least_magnitude, log_of_distance

  !> Mean over the period of 2/pi |ln(2 sin(pi x))|: 4 Cl_2(pi/3)/pi^2.
  real(dp), parameter :: MEAN_TERM = 0.41132_dp
  !> From here on the factors of a length count for more than a few cells more.
  integer, parameter :: MANY_CELLS = 65536
  !> A grid of fewer cells is not made by `coarsen`.
  integer, parameter :: FEWEST_CELLS = 32

  type, public :: halfplane_line
    !> Number of cells n; 0 before it is set.
    integer :: cells = 0
    integer :: element = FUGE_MEAN
    integer :: boundary = FUGE_FREE
    real(dp) :: spacing = 0.0_dp
    !> Of the surface: short waves displace it by 2/(e_star q), others too on a half-plane.
    real(dp) :: e_star = 0.0_dp
    !> The body, if it is no half-plane.
    type(wave_mixture) :: body
  end type halfplane_line

contains

  !> Refuse what makes no line of cells: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH, FUGE_ERR_MODULUS,
  !> FUGE_ERR_ELEMENT, FUGE_ERR_OVERFLOW, FUGE_ERR_OPTION.
  pure subroutine check_line(line, info)
    type(halfplane_line), intent(in) :: line
    type(fuge_info), intent(inout) :: info

    if (line%cells < 1) then
      call report(info, FUGE_ERR_SIZE, 'n = '//text(line%cells)//': at least one cell is needed')
    else if (.not. ieee_is_finite(line%spacing)) then
      call report(info, FUGE_ERR_NOT_FINITE, 'spacing = '//text(line%spacing)//' is not a finite number')
    else if (.not. line%spacing > 0.0_dp) then
      call report(info, FUGE_ERR_WIDTH, 'spacing = '//text(line%spacing) &
                  //' is not positive: it is the width of a cell')
    end if
    if (.not. info%failed()) call check_e_star(line%e_star, info)
    if (.not. info%failed()) call check_element(line%element, info)
    if (info%failed()) return
    if (abs(exponent(line%e_star)) > LARGEST_EXPONENT_OF_2) then
      call report(info, FUGE_ERR_OVERFLOW, 'e_star = '//text(line%e_star)//' is out of range: choose other units')
    else if (abs(exponent(line%spacing)) > LARGEST_EXPONENT_OF_2) then
      call report(info, FUGE_ERR_OVERFLOW, 'spacing = '//text(line%spacing) &
                  //' is out of range: choose another unit of length')
    else if (all(line%boundary /= [FUGE_FREE, FUGE_PERIODIC])) then
      call report(info, FUGE_ERR_OPTION, 'boundary = '//text(line%boundary) &
                  //' is unknown: use FUGE_FREE or FUGE_PERIODIC')
    end if
  end subroutine check_line

  !> `length`: the cells of the circle that a transform of the line has; of a free surface twice as many hold its
  !> products. Error: FUGE_ERR_MEMORY if they are too many.
  pure subroutine circle_of(line, length, info)
    use fuge_fft, only: fast_length, good_length
    type(halfplane_line), intent(in) :: line
    integer, intent(out) :: length
    type(fuge_info), intent(inout) :: info

    length = line%cells
    if (line%boundary == FUGE_FREE) length = merge(fast_length(line%cells), good_length(line%cells), &
                                                   line%cells > MANY_CELLS)
    if (length < 1 .or. (line%boundary == FUGE_FREE .and. length > (huge(length) - 1)/2)) then
      call report(info, FUGE_ERR_MEMORY, 'n = '//text(line%cells)//' needs a circle of ' &
                  //text(2.0_dp*real(line%cells, dp))//' cells in ' &
                  //text(32.0_dp*real(line%cells, dp))//' bytes, but it takes at most '//text(huge(length)) &
                  //' cells: use half as many')
    end if
  end subroutine circle_of

  !> The line whose cells are 2**levels times as wide, of the same period if it is periodic, which may make them a
  !> little narrower. No cells if they were fewer than 32.
  pure function coarsened(line, levels) result(coarse)
    type(halfplane_line), intent(in) :: line
    integer, intent(in) :: levels
    type(halfplane_line) :: coarse

    coarse = line
    coarse%cells = 0
    if (levels < 1 .or. levels > count_coarser(line%cells)) return
    coarse%cells = (line%cells - 1)/2**levels + 1
    coarse%spacing = line%spacing*2.0_dp**levels
    if (line%boundary == FUGE_PERIODIC) then
      coarse%spacing = line%spacing*(real(line%cells, dp)/real(coarse%cells, dp))
    end if
  end function coarsened

  !> How many times `cells` cells can be made twice as wide.
  pure function count_coarser(cells) result(count)
    integer, intent(in) :: cells
    integer :: count

    count = 0
    do while ((cells - 1)/2**(count + 1) + 1 >= FEWEST_CELLS)
      count = count + 1
    end do
  end function count_coarser

  !> The least size of the terms of a displacement by forces the sum of whose magnitudes is `total`: on a periodic
  !> surface equal forces displace nothing, but their terms do.
  pure function least_magnitude(line, total) result(magnitude)
    type(halfplane_line), intent(in) :: line
    real(dp), intent(in) :: total
    real(dp) :: magnitude

    magnitude = 0.0_dp
    if (line%boundary == FUGE_PERIODIC) magnitude = MEAN_TERM*total/line%e_star
  end function least_magnitude

  !> The eigenvalue of the preconditioner for the wave of `periods` periods on the circle of `length` cells, divided by
  !> that length: the inverse of A of a periodic surface.
  !>
  !> For the constant any positive number is valid; that of the longest wave has the right size.
  elemental function inverse_eigenvalue(line, length, periods) result(eigenvalue)
    type(halfplane_line), intent(in) :: line
    integer, intent(in) :: length, periods
    real(dp) :: eigenvalue
    real(dp) :: weight

    weight = 1.0_dp/real(length, dp)
    if (periods > 0) then
      eigenvalue = weight*line%e_star/periodic_eigenvalue(weight*real(periods, dp), line%element)
    else
      eigenvalue = weight*line%e_star/periodic_eigenvalue(1.0_dp/real(max(length, 2), dp), line%element)
    end if
  end function inverse_eigenvalue

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

  !> ln of the distance, in cells, between two cells `apart` cells from each other, in the mean over the cells as the
  !> element has it.
  elemental function log_of_distance(line, apart) result(logarithm)
    type(halfplane_line), intent(in) :: line
    integer, intent(in) :: apart
    real(dp) :: logarithm

    logarithm = mean_log(real(apart, dp), merge(0.0_dp, 1.0_dp, line%element == FUGE_CENTRE), 1.0_dp)
  end function log_of_distance

end module fuge_halfplane_line
