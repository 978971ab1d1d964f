!> Contact segments: runs of consecutive points in contact, as long as they can be within a chunk, and sums over them.
!>
!> Loops over the segments visit no open point and have no branch inside. Where ranks share the points, each has the
!> segments of its own, and sums and maxima are those over the segments of all ranks.
module fuge_contact_segments
  use fuge_kinds, only: dp
  use fuge_point_chunks, only: chunk_count, chunked_pass
  use fuge_point_space, only: point_space
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: center_over, dot_and_sum_over, dot_over, max_abs_over, subtract_and_dot_over, sum_over

  !> Number of partial sums: several are faster, and more exact, than one.
  integer, parameter :: LANES = 8

  !> The segments of one contact set.
  type, public :: contact_segments
    !> First and last point of each segment, ascending. A chunk ends the segments in it, the next one goes on.
    integer, allocatable :: first(:), last(:)
    !> Number of segments before each chunk, and of all.
    integer, allocatable :: before(:)
    !> Number of points in all segments, of all ranks.
    integer :: points = 0
    !> The ranks that share the points.
    type(point_space) :: space = point_space()
  contains
    procedure :: find
  end type contact_segments

  !> Finds the segments, chunk by chunk.
  type, extends(chunked_pass) :: segment_pass
    logical, pointer, contiguous :: contact(:) => null()
    integer, pointer, contiguous :: first(:) => null(), last(:) => null(), before(:) => null()
  contains
    procedure :: do_chunk => find_in_chunk
  end type segment_pass

contains

  !> Find the segments of the contact set `contact` (n). Error: FUGE_ERR_MEMORY.
  subroutine find(self, contact, info)
    class(contact_segments), intent(inout), target :: self
    logical, intent(in), contiguous, target :: contact(:)
    type(fuge_info), intent(inout) :: info
    type(segment_pass), target :: pass
    integer :: chunks, k, stat

    chunks = chunk_count(size(contact))
    if (allocated(self%first)) deallocate (self%first, self%last)
    if (allocated(self%before)) deallocate (self%before)
    allocate (self%before(chunks + 1), stat=stat)
    if (stat == 0) then
      pass%contact => contact
      call pass%run(size(contact), 2)
      self%before(1) = 0
      do k = 1, chunks
        self%before(k + 1) = self%before(k) + nint(pass%found(1, k))
      end do
      allocate (self%first(self%before(chunks + 1)), self%last(self%before(chunks + 1)), stat=stat)
    end if
    call require_memory(stat, 'the segments of the contact set', info)
    call self%space%agree(info)
    if (stat /= 0 .or. info%failed()) return
    self%points = self%space%total_count(nint(pass%total(2)))
    pass%first => self%first
    pass%last => self%last
    pass%before => self%before
    call pass%run(size(contact), 2)
  end subroutine find

  !> Count the segments and the points in contact of a chunk, or note the segments once there is room for them.
  subroutine find_in_chunk(self, k, first, last)
    class(segment_pass), intent(inout) :: self
    integer, intent(in) :: k, first, last
    integer :: i, number, points

    if (associated(self%before)) then
      call note_segments(first, self%contact(first:last), self%first(self%before(k) + 1:self%before(k + 1)), &
                         self%last(self%before(k) + 1:self%before(k + 1)))
      return
    end if
    number = 0
    points = 0
    do i = first, last
      if (.not. self%contact(i)) cycle
      points = points + 1
      if (i == first) then
        number = number + 1
      else if (.not. self%contact(i - 1)) then
        number = number + 1
      end if
    end do
    self%found(:, k) = real([number, points], dp)
  end subroutine find_in_chunk

  !> The first and last points of the segments of `contact`, whose first point has the number `begin`.
  pure subroutine note_segments(begin, contact, first, last)
    integer, intent(in) :: begin
    logical, intent(in), contiguous :: contact(:)
    integer, intent(inout), contiguous :: first(:), last(:)
    integer :: k, number
    logical :: inside

    number = 0
    inside = .false.
    do k = 1, size(contact)
      if (contact(k) .eqv. inside) cycle
      inside = contact(k)
      if (inside) then
        number = number + 1
        first(number) = begin + k - 1
      else
        last(number) = begin + k - 2
      end if
    end do
    if (inside) last(number) = begin + size(contact) - 1
  end subroutine note_segments

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
