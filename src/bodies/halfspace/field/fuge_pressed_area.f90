!> The area on which a half-space is pressed: the rectangles that carry a uniform pressure, in a unit of length and a
!> unit of force of their own.
module fuge_pressed_area
  use fuge_cell_elements, only: FUGE_MEAN
  use fuge_compensated_sums, only: difference_rounding
  use fuge_constants, only: LARGEST_EXPONENT, LARGEST_EXPONENT_OF_4
  use fuge_heap_sort, only: reorder
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_rectangle_checks, only: check_places
  use fuge_rectangle_field, only: rectangle_part
  use fuge_status, only: fuge_info, report, FUGE_ERR_OVERFLOW
  use fuge_stress_checks, only: check_forces
  implicit none
  private

  public :: check_area

  !> A point is at an edge if its distance from it is at most this many rounding units of their coordinates.
  real(dp), parameter :: AT_EDGE = 2.0_dp*epsilon(1.0_dp)
  !> A point at a distance of 2**FAR_EXPONENT units of length sees the area as one force.
  integer, parameter :: FAR_EXPONENT = 60

  !> The rectangles with a force; those of a symmetric model with all their images, which follow each other and share
  !> the force equally.
  type, public :: pressed_area
    integer :: count = 0
    !> Lengths are multiples of 2**unit, forces of 2**force_unit: no power of them overflows.
    integer :: unit = 0, force_unit = 0
    !> About x = 0, about y = 0.
    logical :: symmetric(2) = .false.
    !> Centres, half widths and forces, (count).
    real(dp), allocatable :: x(:), y(:), half_x(:), half_y(:), force(:)
  contains
    procedure :: set
    procedure :: move_to
    procedure :: reorder => reorder_rectangles
    procedure :: box_around
    procedure :: is_far_from
    procedure :: seen_from
  end type pressed_area

contains

  !> Refuse rectangles and forces that are no load: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH,
  !> FUGE_ERR_OVERFLOW.
  pure subroutine check_area(x, y, width_x, width_y, force, symmetric, info)
    real(dp), intent(in) :: x(:), y(:), width_x(:), width_y(:), force(:)
    logical, intent(in) :: symmetric(2)
    type(fuge_info), intent(inout) :: info
    integer :: k, reach

    call check_places(x, y, width_x, width_y, FUGE_MEAN, symmetric, info)
    if (info%failed()) return
    call check_forces(force, size(x), 'rectangles', info)
    if (info%failed()) return
    reach = exponent(max(maxval(abs(x)), maxval(abs(y)), maxval(width_x), maxval(width_y)))
    do k = 1, size(x)
      if (min(exponent(width_x(k)), exponent(width_y(k))) < reach - LARGEST_EXPONENT_OF_4) then
        call report(info, FUGE_ERR_OVERFLOW, 'rectangle '//index_text(k)//' of widths '//text(width_x(k))//' and ' &
                    //text(width_y(k))//' is too small beside the others')
      else if (exponent(force(k)) - exponent(width_x(k)) - exponent(width_y(k)) > LARGEST_EXPONENT) then
        call report(info, FUGE_ERR_OVERFLOW, 'the pressure of rectangle '//index_text(k)//' under force(' &
                    //index_text(k)//') = '//text(force(k))//' is out of range: choose another unit of force')
      end if
      if (info%failed()) return
    end do
  end subroutine check_area

  !> Take, for the first time, the rectangles with a force, of those that `check_area` accepts; `symmetric` (2): about x
  !> = 0, about y = 0. `stat` as in an allocate statement.
  pure subroutine set(self, x, y, width_x, width_y, force, symmetric, stat)
    class(pressed_area), intent(inout) :: self
    real(dp), intent(in) :: x(:), y(:), width_x(:), width_y(:), force(:)
    logical, intent(in) :: symmetric(2)
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
    allocate (self%x(number), self%y(number), self%half_x(number), self%half_y(number), self%force(number), stat=stat)
    if (stat /= 0) return
    self%symmetric = symmetric
    self%unit = exponent(reach)
    self%force_unit = exponent(maxval(abs(force)))
    do k = 1, size(x)
      if (.not. abs(force(k)) > 0.0_dp) cycle
      images = images_of(x(k), y(k), symmetric)
      do j = 1, images(2)
        do i = 1, images(1)
          self%count = self%count + 1
          self%x(self%count) = scale(merge(x(k), -x(k), i == 1), -self%unit)
          self%y(self%count) = scale(merge(y(k), -y(k), j == 1), -self%unit)
          self%half_x(self%count) = scale(width_x(k), -self%unit - 1)
          self%half_y(self%count) = scale(width_y(k), -self%unit - 1)
          self%force(self%count) = scale(force(k), -self%force_unit)/real(product(images), dp)
        end do
      end do
    end do
  end subroutine set

  !> The number of images along x and y, the rectangle itself included: one at the axis.
  pure function images_of(x, y, symmetric) result(images)
    real(dp), intent(in) :: x, y
    logical, intent(in) :: symmetric(2)
    integer :: images(2)

    images = merge(2, 1, symmetric .and. [abs(x) > 0.0_dp, abs(y) > 0.0_dp])
  end function images_of

  !> Leave the rectangles to another area, without a copy.
  pure subroutine move_to(self, area)
    class(pressed_area), intent(inout) :: self
    type(pressed_area), intent(out) :: area

    area%count = self%count
    area%unit = self%unit
    area%force_unit = self%force_unit
    area%symmetric = self%symmetric
    call move_alloc(self%x, area%x)
    call move_alloc(self%y, area%y)
    call move_alloc(self%half_x, area%half_x)
    call move_alloc(self%half_y, area%half_y)
    call move_alloc(self%force, area%force)
    self%count = 0
  end subroutine move_to

  !> Let rectangle `order`(k) be number k. `stat` as in an allocate statement; unless it is 0 nothing changes.
  pure subroutine reorder_rectangles(self, order, stat)
    class(pressed_area), intent(inout) :: self
    integer, intent(in) :: order(:)
    integer, intent(out) :: stat
    real(dp), allocatable :: work(:)

    allocate (work(size(order)), stat=stat)
    if (stat /= 0) return
    call reorder(order, self%x, work)
    call reorder(order, self%y, work)
    call reorder(order, self%half_x, work)
    call reorder(order, self%half_y, work)
    call reorder(order, self%force, work)
  end subroutine reorder_rectangles

  !> The rectangle around rectangles `first` to `last`: centre and half widths, in the unit of the area.
  pure function box_around(self, first, last) result(box)
    class(pressed_area), intent(in) :: self
    integer, intent(in) :: first, last
    real(dp) :: box(4), low(2), high(2)

    low = [minval(self%x(first:last) - self%half_x(first:last)), minval(self%y(first:last) - self%half_y(first:last))]
    high = [maxval(self%x(first:last) + self%half_x(first:last)), maxval(self%y(first:last) + self%half_y(first:last))]
    box = [0.5_dp*(low + high), 0.5_dp*(high - low)]
  end function box_around

  !> Is a point, in the caller's units, so far that the area is one force?
  pure function is_far_from(self, x, y, z) result(far)
    class(pressed_area), intent(in) :: self
    real(dp), intent(in) :: x, y, z
    logical :: far
    real(dp) :: distance

    distance = max(abs(x), abs(y), z)
    ! The exponent of zero would be that of 1/2.
    far = distance > 0.0_dp .and. exponent(distance) > self%unit + FAR_EXPONENT
  end function is_far_from

  !> Rectangle `k` as it is seen from the point (`x`, `y`), in the unit of the area.
  pure function seen_from(self, k, x, y) result(part)
    class(pressed_area), intent(in) :: self
    integer, intent(in) :: k
    real(dp), intent(in) :: x, y
    type(rectangle_part) :: part

    part%x = edge_distances(x, self%x(k), self%half_x(k))
    part%y = edge_distances(y, self%y(k), self%half_y(k))
    part%half = [self%half_x(k), self%half_y(k)]
  end function seen_from

  !> A coordinate minus those of the upper and the lower edge, rounded once; zero at an edge.
  pure function edge_distances(x, centre, half) result(distance)
    real(dp), intent(in) :: x, centre, half
    real(dp) :: distance(2), difference, rounding

    difference = x - centre
    rounding = difference_rounding(x, centre, difference)
    distance = [(difference - half) + rounding, (difference + half) + rounding]
    where (abs(distance) <= AT_EDGE*max(abs(x), abs(centre) + half)) distance = 0.0_dp
  end function edge_distances

end module fuge_pressed_area
