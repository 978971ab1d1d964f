!> Influence matrices of an elastic half-plane, analytically.
!>
!> A line load P per unit depth sinks the surface at distance r by
!> -(2 P/(pi E*)) ln(r/D) (Flamant; K. L. Johnson, Contact Mechanics, 1985,
!> section 2.2 and equation 2.19), E* = E/(1-nu^2) in plane strain. D is arbitrary: it
!> shifts the half-plane as a whole. Here D is twice the length that the cells cover, so that
!> every coefficient is positive and the matrix positive definite; forces and gaps do not
!> depend on D.
!>
!> The coefficients of all elements are values of one function, the mean of ln|d + s - t| over
!> s in a cell of one width and t in a cell of another:
!>
!> - FUGE_CENTRE: displacement at a point by a uniform strip, widths 0 and w;
!> - FUGE_MEAN: mean displacement of a cell by a uniform strip, widths w_i and w_j;
!> - FUGE_HAT: displacement at a point by a hat of half-base w, widths w and w, because the hat
!>   is the convolution of two uniform strips.
module fuge_halfplane_influence
  use fuge_cell_elements, only: check_element, datum_length, FUGE_CENTRE, FUGE_MEAN
  use fuge_cell_overlaps, only: check_overlaps
  use fuge_constants, only: PI, LARGEST_EXPONENT_OF_2
  use fuge_elastic_moduli, only: check_e_star
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_status, only: fuge_info, report, FUGE_ERR_SIZE, FUGE_ERR_WIDTH, FUGE_ERR_ELEMENT, FUGE_ERR_GRID, &
    FUGE_ERR_OVERFLOW
  implicit none
  private

  public :: fuge_halfplane_matrix, check_halfplane, mean_log

  !> Widths with a smaller relative difference count as equal.
  real(dp), parameter :: WIDTH_TOLERANCE = 1.0e-10_dp

contains

  !> The influence matrix of cells on the surface of a half-plane.
  !>
  !> `x` (n) centres and `width` (n) widths of the cells, length, in any order; cells may not
  !> overlap; `e_star` force per length squared; `element` as above; out: `alpha` (n, n), displacement into the
  !> body per force of a cell per unit depth. `symmetric` (default .false.) folds
  !> a problem symmetric about x = 0: pass only the cells with x >= 0; each force is
  !> then the sum over a cell and its mirror image (a cell at 0 is its own image).
  !> Errors, alpha untouched: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH, also for cells
  !> that overlap by more than 1e-4 of the narrower one, FUGE_ERR_MODULUS, FUGE_ERR_ELEMENT,
  !> FUGE_ERR_GRID, FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY.
  pure subroutine fuge_halfplane_matrix(x, width, e_star, element, alpha, info, symmetric)
    real(dp), intent(in) :: x(:), width(:), e_star
    integer, intent(in) :: element
    real(dp), intent(inout) :: alpha(:, :)
    type(fuge_info), intent(out) :: info
    logical, intent(in), optional :: symmetric
    logical :: equal, folded
    real(dp) :: factor, datum, mean
    real(dp), allocatable :: table(:)
    integer :: i, j, n, stat

    n = size(x)
    folded = .false.
    if (present(symmetric)) folded = symmetric
    call check_halfplane(x, width, e_star, element, folded, info)
    if (.not. info%failed()) call check_overlaps(x, width, folded, info)
    if (info%failed()) return
    if (size(alpha, 1) < n .or. size(alpha, 2) /= n) then
      call report(info, FUGE_ERR_SIZE, 'alpha is '//text(size(alpha, 1))//' by '//text(size(alpha, 2)) &
                  //': it needs '//text(n)//' columns and at least as many rows')
      return
    end if

    factor = -2.0_dp/(PI*e_star)
    datum = log(datum_length(x, width, folded))
    equal = is_uniform(x, width)
    if (equal) then
      allocate (table(n), stat=stat)
      equal = stat == 0
    end if
    if (equal) then
      do i = 1, n
        table(i) = cell_mean((i - 1)*(x(n) - x(1))/max(n - 1, 1), width(1), width(1), element)
      end do
    end if
    do j = 1, n
      do i = j, n
        if (equal) then
          mean = table(i - j + 1)
        else
          mean = cell_mean(x(i) - x(j), width(i), width(j), element)
        end if
        if (folded) mean = 0.5_dp*(mean + cell_mean(x(i) + x(j), width(i), width(j), element))
        alpha(i, j) = factor*(mean - datum)
        alpha(j, i) = alpha(i, j)
      end do
    end do
  end subroutine fuge_halfplane_matrix

  !> Are all cells equal and equally spaced, up to rounding? Then alpha has only n different coefficients.
  pure function is_uniform(x, width) result(uniform)
    real(dp), intent(in) :: x(:), width(:)
    logical :: uniform
    real(dp) :: rounding
    integer :: i, n

    n = size(x)
    rounding = 4.0_dp*epsilon(rounding)
    uniform = all(abs(width - width(1)) <= rounding*width(1))
    do i = 2, n - 1
      if (.not. uniform) exit
      uniform = abs((x(i) - x(1)) - (i - 1)*(x(n) - x(1))/(n - 1)) <= rounding*max(abs(x(1)), abs(x(n)))
    end do
  end function is_uniform

  !> The mean of ln for `element`, from a cell of width `loaded` to one of width `observed`.
  pure function cell_mean(distance, observed, loaded, element) result(mean)
    real(dp), intent(in) :: distance, observed, loaded
    integer, intent(in) :: element
    real(dp) :: mean

    select case (element)
    case (FUGE_CENTRE)
      mean = mean_log(distance, 0.0_dp, loaded)
    case (FUGE_MEAN)
      mean = mean_log(distance, observed, loaded)
    case default
      mean = mean_log(distance, loaded, loaded)
    end select
  end function cell_mean

  !> Mean of ln|distance + s - t| over |s| <= a/2 and |t| <= b/2, accurate to rounding.
  !>
  !> `a` >= 0 and `b` >= 0 are lengths, not both zero; `distance` any length.
  elemental function mean_log(distance, a, b) result(mean)
    real(dp), intent(in) :: distance, a, b
    real(dp) :: mean
    real(dp) :: d, narrow, wide

    d = abs(distance)
    wide = max(a, b)
    narrow = min(a, b)
    if (d > wide + narrow) then
      mean = log(d) + far_field(0.5_dp*(wide + narrow)/d, 0.5_dp*(wide - narrow)/d)
    else
      ! In units of the wider cell, so that all lengths are of order 1.
      mean = log(wide) + strip_mean(d/wide + 0.5_dp, narrow/wide) - strip_mean(d/wide - 0.5_dp, narrow/wide)
    end if
  end function mean_log

  !> mean_log - ln(d) from the even moments of s - t; p and q are half the sum and half the
  !> difference of the widths over d, p < 1/2.
  !>
  !> The moment of order 2k is 2 S_k/((2k+1)(2k+2)) with S_k the sum of all p^2i q^2j,
  !> i + j = k. All terms are positive: there is no cancellation.
  elemental function far_field(p, q) result(correction)
    real(dp), intent(in) :: p, q
    real(dp) :: correction
    real(dp) :: moment_sum, power, term
    integer :: k

    correction = 0.0_dp
    moment_sum = 1.0_dp
    power = 1.0_dp
    do k = 1, 40
      power = power*q**2
      moment_sum = moment_sum*p**2 + power
      term = moment_sum/real(k*(2*k + 1)*(2*k + 2), dp)
      correction = correction - term
      if (term <= 0.1_dp*epsilon(correction)*abs(correction)) exit
    end do
  end function far_field

  !> Mean of J(x) = x ln|x| - x, the integral of ln|x|, over a width w about c.
  elemental function strip_mean(c, w) result(mean)
    real(dp), intent(in) :: c, w
    real(dp) :: mean
    real(dp) :: ratio, power, term
    integer :: k

    if (abs(c) < w) then
      mean = (double_integral(c + 0.5_dp*w) - double_integral(c - 0.5_dp*w))/w
      return
    end if
    ! Taylor series in w/(2c), because a difference quotient loses digits for a narrow w.
    mean = 0.0_dp
    if (abs(c) <= 0.0_dp) return
    ratio = (0.5_dp*w/c)**2
    power = 1.0_dp
    do k = 1, 40
      power = power*ratio
      term = power/real((2*k + 1)*(2*k)*(2*k - 1), dp)
      mean = mean + term
      if (term <= 0.1_dp*epsilon(mean)*mean) exit
    end do
    mean = c*(mean + log(abs(c)) - 1.0_dp)
  end function strip_mean

  !> The integral of x ln|x| - x from 0.
  elemental function double_integral(x) result(integral)
    real(dp), intent(in) :: x
    real(dp) :: integral

    integral = 0.0_dp
    if (abs(x) > 0.0_dp) integral = x**2*(0.5_dp*log(abs(x)) - 0.75_dp)
  end function double_integral

  !> Refuse cells, a modulus or an element for which there is no influence matrix.
  !>
  !> Arguments and errors as for `fuge_halfplane_matrix`.
  pure subroutine check_halfplane(x, width, e_star, element, symmetric, info)
    real(dp), intent(in) :: x(:), width(:), e_star
    integer, intent(in) :: element
    logical, intent(in) :: symmetric
    type(fuge_info), intent(inout) :: info

    if (size(x) < 1 .or. size(width) /= size(x)) then
      call report(info, FUGE_ERR_SIZE, 'x has '//text(size(x))//' and width '//text(size(width)) &
                  //' value(s): both need n >= 1')
      return
    end if
    call check_finite(x, 'x', info)
    if (.not. info%failed()) call check_finite(width, 'width', info)
    if (.not. info%failed()) call check_element(element, info)
    if (.not. info%failed()) call check_e_star(e_star, info)
    if (info%failed()) return
    if (abs(exponent(e_star)) > LARGEST_EXPONENT_OF_2) then
      call report(info, FUGE_ERR_OVERFLOW, 'e_star = '//text(e_star)//' is out of range: choose other units')
    else
      call check_cells(x, width, element, symmetric, info)
    end if
  end subroutine check_halfplane

  !> Refuse widths and centres out of range, and unequal widths where the element needs equal ones.
  pure subroutine check_cells(x, width, element, symmetric, info)
    real(dp), intent(in) :: x(:), width(:)
    integer, intent(in) :: element
    logical, intent(in) :: symmetric
    type(fuge_info), intent(inout) :: info
    integer :: k

    do k = 1, size(x)
      if (.not. width(k) > 0.0_dp) then
        call report(info, FUGE_ERR_WIDTH, 'width('//index_text(k)//') = '//text(width(k))//' is not positive')
      else if (symmetric .and. x(k) < 0.0_dp) then
        call report(info, FUGE_ERR_WIDTH, 'x('//index_text(k)//') = '//text(x(k)) &
                    //' is negative: a symmetric model takes the cells with x >= 0 only')
      else if (element /= FUGE_MEAN .and. abs(width(k) - width(1)) > WIDTH_TOLERANCE*width(1)) then
        call report(info, FUGE_ERR_GRID, 'width('//index_text(k)//') = '//text(width(k))//' differs from width(' &
                    //index_text(1)//') by ' &
                    //text(width(k) - width(1))//': on unequal cells only FUGE_MEAN is symmetric, use it')
      else if (exponent(x(k)) > LARGEST_EXPONENT_OF_2 .or. abs(exponent(width(k))) > LARGEST_EXPONENT_OF_2) then
        call report(info, FUGE_ERR_OVERFLOW, 'cell '//index_text(k)//' at x = '//text(x(k))//' of width ' &
                    //text(width(k))//' is out of range: choose another unit of length')
      end if
      if (info%failed()) return
    end do
  end subroutine check_cells

end module fuge_halfplane_influence
