!> Contact segments: maximal runs of consecutive points in contact, and sums over them.
!>
!> Loops over the segments visit no open point and have no branch inside. Where ranks share the points, each has the
!> segments of its own, and sums and maxima are those over the segments of all ranks.
module fuge_contact_segments
  use fuge_kinds, only: dp
  use fuge_point_space, only: point_space
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: center_over, dot_and_sum_over, dot_over, max_abs_over, subtract_and_dot_over, sum_over

  !> Number of partial sums: several are faster, and more exact, than one.
  integer, parameter :: LANES = 8

  !> The segments of one contact set.
  type, public :: contact_segments
    !> First and last point of each segment, ascending.
    integer, allocatable :: first(:), last(:)
    !> Number of points in all segments, of all ranks.
    integer :: points = 0
    !> The ranks that share the points.
    type(point_space) :: space = point_space()
  contains
    procedure :: find
  end type contact_segments

contains

  !> Find the segments of the contact set `contact` (n). Error: FUGE_ERR_MEMORY.
  subroutine find(self, contact, info)
    class(contact_segments), intent(inout) :: self
    logical, intent(in) :: contact(:)
    type(fuge_info), intent(inout) :: info
    integer :: k, n, number, stat
    logical :: inside

    n = size(contact)
    number = count(contact(2:n) .and. .not. contact(1:n - 1))
    if (n > 0) then
      if (contact(1)) number = number + 1
    end if
    if (allocated(self%first)) deallocate (self%first, self%last)
    allocate (self%first(number), self%last(number), stat=stat)
    call require_memory(stat, 'the segments of the contact set', info)
    call self%space%agree(info)
    if (stat /= 0 .or. info%failed()) return
    number = 0
    inside = .false.
    do k = 1, n
      if (contact(k) .eqv. inside) cycle
      inside = contact(k)
      if (inside) then
        number = number + 1
        self%first(number) = k
      else
        self%last(number) = k - 1
      end if
    end do
    if (inside) self%last(number) = n
    self%points = self%space%total_count(sum(self%last - self%first + 1))
  end subroutine find

  !> Sum of `x` (n) over the segments.
  function sum_over(segments, x) result(total)
    type(contact_segments), intent(in) :: segments
    real(dp), intent(in), contiguous :: x(:)
    real(dp) :: total
    real(dp) :: partial(LANES)
    integer :: i, k

    total = 0.0_dp
    partial = 0.0_dp
    do i = 1, size(segments%first)
      do k = segments%first(i), segments%last(i) - LANES + 1, LANES
        partial = partial + x(k:k + LANES - 1)
      end do
      do k = segments%last(i) - modulo(segments%last(i) - segments%first(i) + 1, LANES) + 1, segments%last(i)
        total = total + x(k)
      end do
    end do
    total = segments%space%total(total + sum(partial))
  end function sum_over

  !> Inner product of `x` and `y`, both (n), over the segments.
  function dot_over(segments, x, y) result(inner)
    type(contact_segments), intent(in) :: segments
    real(dp), intent(in), contiguous :: x(:), y(:)
    real(dp) :: inner
    real(dp) :: partial(LANES)
    integer :: i, k

    inner = 0.0_dp
    partial = 0.0_dp
    do i = 1, size(segments%first)
      do k = segments%first(i), segments%last(i) - LANES + 1, LANES
        partial = partial + x(k:k + LANES - 1)*y(k:k + LANES - 1)
      end do
      do k = segments%last(i) - modulo(segments%last(i) - segments%first(i) + 1, LANES) + 1, segments%last(i)
        inner = inner + x(k)*y(k)
      end do
    end do
    inner = segments%space%total(inner + sum(partial))
  end function dot_over

  !> `inner` = the inner product of `x` and `y` over the segments, `total` = the sum of `y`; both (n).
  subroutine dot_and_sum_over(segments, x, y, inner, total)
    type(contact_segments), intent(in) :: segments
    real(dp), intent(in), contiguous :: x(:), y(:)
    real(dp), intent(out) :: inner, total
    real(dp) :: products(LANES), values(LANES), sums(2)
    integer :: i, k

    inner = 0.0_dp
    total = 0.0_dp
    products = 0.0_dp
    values = 0.0_dp
    do i = 1, size(segments%first)
      do k = segments%first(i), segments%last(i) - LANES + 1, LANES
        products = products + x(k:k + LANES - 1)*y(k:k + LANES - 1)
        values = values + y(k:k + LANES - 1)
      end do
      do k = segments%last(i) - modulo(segments%last(i) - segments%first(i) + 1, LANES) + 1, segments%last(i)
        inner = inner + x(k)*y(k)
        total = total + y(k)
      end do
    end do
    inner = inner + sum(products)
    total = total + sum(values)
    if (segments%space%is_alone()) return
    sums = [inner, total]
    call segments%space%add(sums)
    inner = sums(1)
    total = sums(2)
  end subroutine dot_and_sum_over

  !> Subtract `factor` times `x` from `y` over the segments; `inner` = the inner product of the new `y` and `z`; all
  !> (n).
  subroutine subtract_and_dot_over(segments, factor, x, y, z, inner)
    type(contact_segments), intent(in) :: segments
    real(dp), intent(in) :: factor
    real(dp), intent(in), contiguous :: x(:), z(:)
    real(dp), intent(inout), contiguous :: y(:)
    real(dp), intent(out) :: inner
    real(dp) :: partial(LANES), values(LANES)
    integer :: i, k

    inner = 0.0_dp
    partial = 0.0_dp
    do i = 1, size(segments%first)
      do k = segments%first(i), segments%last(i) - LANES + 1, LANES
        values = y(k:k + LANES - 1) - factor*x(k:k + LANES - 1)
        y(k:k + LANES - 1) = values
        partial = partial + values*z(k:k + LANES - 1)
      end do
      do k = segments%last(i) - modulo(segments%last(i) - segments%first(i) + 1, LANES) + 1, segments%last(i)
        y(k) = y(k) - factor*x(k)
        inner = inner + y(k)*z(k)
      end do
    end do
    inner = segments%space%total(inner + sum(partial))
  end subroutine subtract_and_dot_over

  !> Subtract `mean` from `x` (n) over the segments; `largest` is the largest |x| then, 0 if there is none.
  subroutine center_over(segments, mean, x, largest)
    type(contact_segments), intent(in) :: segments
    real(dp), intent(in) :: mean
    real(dp), intent(inout), contiguous :: x(:)
    real(dp), intent(out) :: largest
    real(dp) :: partial(LANES), values(LANES)
    integer :: i, k

    largest = 0.0_dp
    partial = 0.0_dp
    do i = 1, size(segments%first)
      do k = segments%first(i), segments%last(i) - LANES + 1, LANES
        values = x(k:k + LANES - 1) - mean
        x(k:k + LANES - 1) = values
        values = abs(values)
        partial = merge(values, partial, values > partial)
      end do
      do k = segments%last(i) - modulo(segments%last(i) - segments%first(i) + 1, LANES) + 1, segments%last(i)
        x(k) = x(k) - mean
        largest = max(largest, abs(x(k)))
      end do
    end do
    largest = segments%space%largest(max(largest, maxval(partial)))
  end subroutine center_over

  !> Largest |x| over the segments, 0 if there is none; `x` (n).
  function max_abs_over(segments, x) result(largest)
    type(contact_segments), intent(in) :: segments
    real(dp), intent(in), contiguous :: x(:)
    real(dp) :: largest
    integer :: i, k

    largest = 0.0_dp
    do i = 1, size(segments%first)
      do k = segments%first(i), segments%last(i)
        largest = max(largest, abs(x(k)))
      end do
    end do
    largest = segments%space%largest(largest)
  end function max_abs_over

end module fuge_contact_segments
