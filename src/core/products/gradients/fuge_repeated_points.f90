!> Contact points that are the same point twice: their forces are one of many possible.
!>
!> Conjugate gradients cannot see the difference of two such forces, because no residual has a component along it. But
!> the two points have equal displacements under any forces, so that one product with random ones shows them.
module fuge_repeated_points
  use fuge_contact_displacement, only: compute_displacement
  use fuge_contact_iterate, only: contact_iterate
  use fuge_contact_scene, only: contact_scene, OUT_OF_REACH
  use fuge_deformed_gaps, only: deformed_gap
  use fuge_heap_sort, only: heap_sort
  use fuge_kinds, only: dp
  use fuge_operator_type, only: fuge_operator
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: find_repeated_points

  !> Numbers that differ by at most this many units in the last place of the largest one count as equal.
  real(dp), parameter :: ROUNDINGS = 64.0_dp

contains

  !> Two points that touch and are the same one twice, and of which one carries a force, or zeros.
  !>
  !> The cells of a grid are never the same. No product unless two points have the same gap and the same rows of the
  !> modes; one for those, and one more to confirm a pair. Errors: FUGE_ERR_MEMORY, those of the operator.
  subroutine find_repeated_points(operator, scene, iterate, pair, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(in) :: iterate
    integer, intent(out) :: pair(2)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: force(:), displacement(:), data(:)
    integer, allocatable :: order(:)
    logical, allocatable :: touches(:)
    real(dp) :: softness
    integer :: k, stat

    pair = 0
    if (all(operator%grid() > 0)) return
    allocate (touches, source=touching_points(scene, iterate), stat=stat)
    call require_memory(stat, 'a search for repeated ones among', size(scene%gap), 'points', info)
    if (info%failed()) return
    if (count(touches) < 2) return
    allocate (order, source=pack([(k, k=1, size(touches))], touches), stat=stat)
    if (stat == 0) allocate (data, source=data_at(scene, iterate), stat=stat)
    if (stat == 0) allocate (force(size(data)), displacement(size(data)), stat=stat)
    call require_memory(stat, 'a search for repeated ones among', size(scene%gap), 'points', info)
    if (info%failed()) return
    call heap_sort(data, order)
    if (equal_neighbour(data, data, order, touches) < 1) return
    call set_random(touches, force)
    call compute_displacement(operator, .false., force, displacement, info)
    if (info%failed()) return
    softness = maxval(abs(displacement))
    call heap_sort(displacement, order)
    k = equal_neighbour(displacement, data, order, abs(iterate%force) > 0.0_dp .or. scene%tied_points())
    if (k < 1) return
    force = 0.0_dp
    force(order(k)) = 1.0_dp
    force(order(k - 1)) = -1.0_dp
    call compute_displacement(operator, .false., force, displacement, info)
    if (info%failed()) return
    if (maxval(abs(displacement)) <= ROUNDINGS*epsilon(softness)*softness) pair = [minval(order(k - 1:k)), &
                                                                                   maxval(order(k - 1:k))]
  end subroutine find_repeated_points

  !> The contact set, and the open points that are within rounding of their lower stop, (n).
  pure function touching_points(scene, iterate) result(touches)
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(in) :: iterate
    logical :: touches(size(scene%gap))
    real(dp) :: length

    length = max(maxval(abs(scene%gap), mask=scene%gap < OUT_OF_REACH), maxval(abs(iterate%displacement)))
    touches = iterate%contact .or. (scene%gap < OUT_OF_REACH .and. deformed_gap(scene%gap, iterate%displacement, &
                                                                 iterate%motion) <= ROUNDINGS*epsilon(length)*length)
  end function touching_points

  !> One number for the stop and the rows of the modes at each point, (n), equal for points where all these are equal,
  !> and hardly ever for others.
  pure function data_at(scene, iterate) result(number)
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(in) :: iterate
    real(dp) :: number(size(iterate%contact))
    real(dp) :: largest
    integer :: j

    number = 0.0_dp
    where (scene%gap < OUT_OF_REACH) number = scene%gap
    if (allocated(iterate%at_upper)) then
      where (iterate%contact .and. iterate%at_upper) number = number - scene%play
    end if
    largest = maxval(abs(number))
    if (largest > 0.0_dp) number = number/largest
    if (.not. allocated(scene%modes)) return
    do j = 1, size(scene%modes, 2)
      number = number + sqrt(real(j + 1, dp))*scene%modes(:, j)
    end do
  end function data_at

  !> The first position in `order` whose point and the one before it have equal `values` and `data`, both (n), and of
  !> which at least one is `marked`, (n); 0 if there is none.
  pure function equal_neighbour(values, data, order, marked) result(position)
    real(dp), intent(in) :: values(:), data(:)
    integer, intent(in) :: order(:)
    logical, intent(in) :: marked(:)
    integer :: position
    real(dp) :: rounding, rounding_of_data
    integer :: k

    rounding = ROUNDINGS*epsilon(rounding)*maxval(abs(values))
    rounding_of_data = ROUNDINGS*epsilon(rounding)*maxval(abs(data))
    do position = 2, size(order)
      k = position - 1
      if (abs(values(order(position)) - values(order(k))) > rounding) cycle
      if (abs(data(order(position)) - data(order(k))) > rounding_of_data) cycle
      if (marked(order(position)) .or. marked(order(k))) return
    end do
    position = 0
  end function equal_neighbour

  !> Forces between 1/2 and 1 on the contact set, the same in each solve.
  pure subroutine set_random(contact, force)
    logical, intent(in) :: contact(:)
    real(dp), intent(out) :: force(:)
    integer :: k, number

    number = 1
    do k = 1, size(force)
      ! A linear congruential generator.
      number = modulo(number*1366 + 150889, 714025)
      force(k) = merge(0.5_dp + 0.5_dp*real(number, dp)/714025.0_dp, 0.0_dp, contact(k))
    end do
  end subroutine set_random

end module fuge_repeated_points
