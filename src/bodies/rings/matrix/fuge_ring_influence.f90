!> Influence of rings about one axis on the surface of an elastic half-space: round bodies as a line of unknowns.
!>
!> A force f, spread as uniform pressure on a ring, displaces the surface at a point by f/(pi E*) times the mean of 1/r
!> over the ring (J. Boussinesq 1885; K. L. Johnson, Contact Mechanics, 1985, section 3.2), and another ring in the mean
!> by the mean over both. The latter is symmetric in the two rings, so that the dense engines can use it, with
!> the resultant of each ring as its force.
module fuge_ring_influence
  use fuge_cell_elements, only: FUGE_CENTRE, FUGE_MEAN
  use fuge_constants, only: LARGEST_EXPONENT_OF_2, PI
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_rectangle_checks, only: check_area_modulus
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_ELEMENT, FUGE_ERR_GRID, FUGE_ERR_OVERFLOW, &
    FUGE_ERR_SIZE, FUGE_ERR_WIDTH
  implicit none
  private

  public :: check_rings, fuge_ring_matrix, fuge_ring_displacement

  !> Rings that are thinner in relation to their radius lose digits in the closed form.
  real(dp), parameter :: SMALLEST_RATIO = 1.0e-7_dp
  !> Binary orders between the greatest radius and the smallest one that is not 0.
  integer, parameter :: MOST_ORDERS = 200

contains

  !> The influence matrix of rings side by side about one axis.
  !>
  !> `radius` (n + 1), increasing and not negative, length: ring k lies between radius(k) and radius(k + 1), any widths;
  !> the first one is a disc if radius(1) = 0. `e_star` force per length squared; `element` FUGE_MEAN: uniform pressure
  !> on each ring, mean displacement of each ring. Out: `alpha` (n, n), displacement into the body per force of a
  !> ring, which is its resultant: pressure times pi (radius(k + 1)**2 - radius(k)**2). The load of a problem with these
  !> forces is the whole load, and its gaps are means over the rings, weighted by area. alpha is symmetric.
  !> Relative error of a coefficient: at most 1e-15.
  !> Errors, alpha untouched: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH for radii that do not increase, a
  !> negative one, or a ring thinner than 1e-7 of its radius, FUGE_ERR_MODULUS, FUGE_ERR_ELEMENT, FUGE_ERR_GRID for
  !> FUGE_CENTRE, whose matrix would not be symmetric, FUGE_ERR_OVERFLOW.
  pure subroutine fuge_ring_matrix(radius, e_star, element, alpha, info)
    use fuge_ring_kernel, only: ring_kernel, ring_mean
    real(dp), intent(in) :: radius(:), e_star
    integer, intent(in) :: element
    real(dp), intent(inout) :: alpha(:, :)
    type(fuge_info), intent(out) :: info
    type(ring_kernel), allocatable :: kernel
    integer :: i, j, n

    n = size(radius) - 1
    call check_element(element, info)
    if (.not. info%failed()) call check_area_modulus(e_star, info)
    if (.not. info%failed()) call check_rings(radius, info)
    if (info%failed()) return
    if (size(alpha, 1) < n .or. size(alpha, 2) /= n) then
      call report(info, FUGE_ERR_SIZE, 'alpha is '//text(size(alpha, 1))//' by '//text(size(alpha, 2)) &
                  //': it needs '//text(n)//' columns and at least as many rows, one less than there are radii')
      return
    end if
    call start_kernel(kernel, info)
    if (info%failed()) return
    do j = 1, n
      do i = j, n
        alpha(i, j) = ring_mean(kernel, radius(j:j + 1), radius(i:i + 1))/PI/e_star
        alpha(j, i) = alpha(i, j)
      end do
    end do
  end subroutine fuge_ring_matrix

  !> The displacement of the surface by forces on rings, anywhere.
  !>
  !> `radius` (n + 1) and `e_star` as in `fuge_ring_matrix`; `force` (n) the resultants of uniform pressures; `place`
  !> distances >= 0 from the axis, length. Out: `displacement` (size(place)) into the body, length; on a ring it varies.
  !> Errors, displacement untouched: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH, also for a negative place,
  !> FUGE_ERR_MODULUS, FUGE_ERR_OVERFLOW.
  pure subroutine fuge_ring_displacement(radius, force, e_star, place, displacement, info)
    use fuge_ring_kernel, only: ring_kernel, ring_value
    real(dp), intent(in) :: radius(:), force(:), e_star, place(:)
    real(dp), intent(inout) :: displacement(:)
    type(fuge_info), intent(out) :: info
    type(ring_kernel), allocatable :: kernel
    real(dp) :: total
    integer :: j, k

    call check_area_modulus(e_star, info)
    if (.not. info%failed()) call check_rings(radius, info)
    if (.not. info%failed()) call check_finite(force, 'force', info)
    if (.not. info%failed()) call check_places(radius, place, info)
    if (info%failed()) return
    if (size(force) /= size(radius) - 1 .or. size(displacement) /= size(place)) then
      call report(info, FUGE_ERR_SIZE, 'force has '//text(size(force))//' value(s) for '//text(size(radius) - 1) &
                  //' ring(s), displacement '//text(size(displacement))//' for '//text(size(place))//' place(s)')
      return
    end if
    call start_kernel(kernel, info)
    if (info%failed()) return
    do k = 1, size(place)
      total = 0.0_dp
      do j = 1, size(force)
        total = total + force(j)*(ring_value(kernel, place(k), radius(j:j + 1))/PI/e_star)
      end do
      displacement(k) = total
    end do
  end subroutine fuge_ring_displacement

  pure subroutine start_kernel(kernel, info)
    use fuge_ring_kernel, only: new_ring_kernel, ring_kernel
    type(ring_kernel), allocatable, intent(out) :: kernel
    type(fuge_info), intent(inout) :: info
    integer :: stat

    allocate (kernel, stat=stat)
    call require_memory(stat, 'the quadrature rules', info)
    if (stat == 0) kernel = new_ring_kernel()
  end subroutine start_kernel

  !> Refuse an element that rings do not have.
  pure subroutine check_element(element, info)
    integer, intent(in) :: element
    type(fuge_info), intent(inout) :: info

    if (element == FUGE_CENTRE) then
      call report(info, FUGE_ERR_GRID, 'on rings only FUGE_MEAN gives a symmetric matrix, use it;' &
                  //' fuge_ring_displacement has displacements at points')
    else if (element /= FUGE_MEAN) then
      call report(info, FUGE_ERR_ELEMENT, 'element = '//text(element)//' is not one of rings: use FUGE_MEAN')
    end if
  end subroutine check_element

  !> Refuse radii that are not those of rings side by side.
  pure subroutine check_rings(radius, info)
    real(dp), intent(in) :: radius(:)
    type(fuge_info), intent(inout) :: info
    integer :: k

    if (size(radius) < 2) then
      call report(info, FUGE_ERR_SIZE, 'radius has '//text(size(radius))//' value(s): n rings have n + 1 radii, n >= 1')
      return
    end if
    call check_finite(radius, 'radius', info)
    if (info%failed()) return
    if (radius(1) < 0.0_dp) then
      call report(info, FUGE_ERR_WIDTH, 'radius('//index_text(1)//') = '//text(radius(1))//' is negative')
      return
    end if
    do k = 1, size(radius) - 1
      if (.not. radius(k + 1) > radius(k)) then
        call report(info, FUGE_ERR_WIDTH, 'radius('//index_text(k + 1)//') = '//text(radius(k + 1)) &
                    //' is not greater than radius('//index_text(k)//') = '//text(radius(k)) &
                    //': pass the radii between the rings from the axis outwards')
        return
      else if (radius(k + 1) - radius(k) < SMALLEST_RATIO*radius(k + 1)) then
        call report(info, FUGE_ERR_WIDTH, 'the ring from radius('//index_text(k)//') = '//text(radius(k))//' has a' &
                    //' width of '//text(radius(k + 1) - radius(k))//', below '//text(SMALLEST_RATIO)//' of its radius')
        return
      end if
    end do
    call check_orders(radius, info)
  end subroutine check_rings

  !> Refuse radii whose powers leave the range of double precision (FUGE_ERR_OVERFLOW).
  pure subroutine check_orders(radius, info)
    real(dp), intent(in) :: radius(:)
    type(fuge_info), intent(inout) :: info
    real(dp) :: least, most

    least = merge(radius(1), radius(2), radius(1) > 0.0_dp)
    most = radius(size(radius))
    if (max(abs(exponent(least)), abs(exponent(most))) > LARGEST_EXPONENT_OF_2 &
        .or. exponent(most) - exponent(least) > MOST_ORDERS) &
      call report(info, FUGE_ERR_OVERFLOW, 'radii from '//text(least)//' to '//text(most) &
                  //' are out of range: choose another unit of length, or fewer orders of magnitude')
  end subroutine check_orders

  !> Refuse places that are no distances from the axis, or too close to it or too far out for double precision.
  pure subroutine check_places(radius, place, info)
    real(dp), intent(in) :: radius(:), place(:)
    type(fuge_info), intent(inout) :: info
    integer :: k

    call check_finite(place, 'place', info)
    if (info%failed()) return
    do k = 1, size(place)
      if (place(k) < 0.0_dp) then
        call report(info, FUGE_ERR_WIDTH, 'place('//index_text(k)//') = '//text(place(k)) &
                    //' is negative: it is a distance from the axis')
        return
      else if (exponent(place(k)) > exponent(radius(size(radius))) + MOST_ORDERS &
               .or. exponent(place(k)) > LARGEST_EXPONENT_OF_2) then
        call report(info, FUGE_ERR_OVERFLOW, 'place('//index_text(k)//') = '//text(place(k)) &
                    //' is out of range: far outside of the rings the displacement is that of one force')
        return
      end if
    end do
  end subroutine check_places

end module fuge_ring_influence
