!> Uniform pressures on rectangles of a half-space, in a unit of length and a unit of force of their own.
module fuge_area_loads
  use fuge_compensated_sums, only: difference_rounding
  use fuge_heap_sort, only: reorder
  use fuge_kinds, only: dp
  use fuge_rectangle_field, only: rectangle_part
  implicit none
  private

  public :: load_part, new_area_loads, reorder_loads

  !> Points are at an edge if they are not further from it than this many rounding units of their coordinates.
  real(dp), parameter :: AT_EDGE = 2.0_dp*epsilon(1.0_dp)

  !> The rectangles that carry forces; those of a symmetric model with all their images.
  type, public :: area_loads
    integer :: count = 0
    !> Lengths are multiples of 2**unit, forces of 2**force_unit: no power of them overflows.
    integer :: unit = 0, force_unit = 0
    !> Centres, half widths and forces, (count).
    real(dp), allocatable :: x(:), y(:), half_x(:), half_y(:), force(:)
  end type area_loads

contains

  !> The loads of a model; `symmetric` (2): about x = 0, about y = 0. The data are checked. `stat` as in an allocate
  !> statement.
  pure subroutine new_area_loads(x, y, width_x, width_y, force, symmetric, loads, stat)
    real(dp), intent(in) :: x(:), y(:), width_x(:), width_y(:), force(:)
    logical, intent(in) :: symmetric(2)
    type(area_loads), intent(out) :: loads
    integer, intent(out) :: stat
    real(dp) :: reach
    integer :: images(2), number, i, j, k

    number = 0
    reach = 0.0_dp
    do k = 1, size(x)
      if (.not. abs(force(k)) > 0.0_dp) cycle
      number = number + product(images_of(x(k), y(k), symmetric))
      reach = max(reach, abs(x(k)) + width_x(k), abs(y(k)) + width_y(k))
    end do
    allocate (loads%x(number), loads%y(number), loads%half_x(number), loads%half_y(number), loads%force(number), &
              stat=stat)
    if (stat /= 0) return
    loads%unit = exponent(reach)
    loads%force_unit = exponent(maxval(abs(force)))
    do k = 1, size(x)
      if (.not. abs(force(k)) > 0.0_dp) cycle
      images = images_of(x(k), y(k), symmetric)
      do j = 1, images(2)
        do i = 1, images(1)
          loads%count = loads%count + 1
          loads%x(loads%count) = scale(merge(x(k), -x(k), i == 1), -loads%unit)
          loads%y(loads%count) = scale(merge(y(k), -y(k), j == 1), -loads%unit)
          loads%half_x(loads%count) = scale(width_x(k), -loads%unit - 1)
          loads%half_y(loads%count) = scale(width_y(k), -loads%unit - 1)
          loads%force(loads%count) = scale(force(k), -loads%force_unit)/real(product(images), dp)
        end do
      end do
    end do
  end subroutine new_area_loads

  !> The number of images along x and y, the rectangle itself included: one at the axis.
  pure function images_of(x, y, symmetric) result(images)
    real(dp), intent(in) :: x, y
    logical, intent(in) :: symmetric(2)
    integer :: images(2)

    images = merge(2, 1, symmetric .and. [abs(x) > 0.0_dp, abs(y) > 0.0_dp])
  end function images_of

  !> Put load `order`(k) at place k. `stat` as in an allocate statement; the loads stay as they are unless it is 0.
  pure subroutine reorder_loads(order, loads, stat)
    integer, intent(in) :: order(:)
    type(area_loads), intent(inout) :: loads
    integer, intent(out) :: stat
    real(dp), allocatable :: work(:)

    allocate (work(size(order)), stat=stat)
    if (stat /= 0) return
    call reorder(order, loads%x, work)
    call reorder(order, loads%y, work)
    call reorder(order, loads%half_x, work)
    call reorder(order, loads%half_y, work)
    call reorder(order, loads%force, work)
  end subroutine reorder_loads

  !> Load `k` as it is seen from the point (`x`, `y`), in the unit of the loads.
  pure function load_part(loads, k, x, y) result(part)
    type(area_loads), intent(in) :: loads
    integer, intent(in) :: k
    real(dp), intent(in) :: x, y
    type(rectangle_part) :: part

    part%x = edge_distances(x, loads%x(k), loads%half_x(k))
    part%y = edge_distances(y, loads%y(k), loads%half_y(k))
    part%half = [loads%half_x(k), loads%half_y(k)]
  end function load_part

  !> A coordinate minus those of the upper and the lower edge, rounded once; zero at an edge.
  pure function edge_distances(x, centre, half) result(distance)
    real(dp), intent(in) :: x, centre, half
    real(dp) :: distance(2), difference, rounding

    difference = x - centre
    rounding = difference_rounding(x, centre, difference)
    distance = [(difference - half) + rounding, (difference + half) + rounding]
    where (abs(distance) <= AT_EDGE*max(abs(x), abs(centre) + half)) distance = 0.0_dp
  end function edge_distances

end module fuge_area_loads
