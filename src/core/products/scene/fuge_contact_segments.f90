!> Contact segments: runs of consecutive points in contact, as long as they can be within a chunk, and sums over them.
!>
!> Loops over the segments visit no open point and have no branch inside. Several chunks are shared by threads; a
!> single one takes no more than its loop. Where ranks share the points, each has the segments of its own, and sums and
!> maxima are those over the segments of all ranks.
module fuge_contact_segments
  use fuge_kinds, only: dp
  use fuge_point_chunks, only: chunk_count, chunked_pass
  use fuge_point_space, only: point_space
  use fuge_run_sums, only: add_scaled_on_runs, center_on_runs, dot_and_sum_on_runs, dot_on_runs, max_abs_on_runs, &
    subtract_and_dot_on_runs, sum_on_runs
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: add_scaled_over, center_over, dot_and_sum_over, dot_over, max_abs_over, subtract_and_dot_over, sum_over

  !> What a pass over the segments does.
  integer, parameter :: ADD_SCALED = 1, CENTER = 2, DOT = 3, DOT_AND_SUM = 4, MAX_ABS = 5, SUBTRACT_AND_DOT = 6, &
    TO_SUM = 7

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
    procedure :: are_in_one_chunk
  end type contact_segments

  !> Finds the segments, chunk by chunk.
  type, extends(chunked_pass) :: segment_pass
    logical, pointer, contiguous :: contact(:) => null()
    integer, pointer, contiguous :: first(:) => null(), last(:) => null(), before(:) => null()
  contains
    procedure :: do_chunk => find_in_chunk
  end type segment_pass

  !> Passes over the segments of several chunks. Found: two numbers, those of the operation.
  type, extends(chunked_pass) :: operation_pass
    integer :: operation = 0
    type(contact_segments), pointer :: segments => null()
    real(dp) :: factor = 0.0_dp
    !> `x` and `z` are read, `y` is changed.
    real(dp), pointer, contiguous :: x(:) => null(), y(:) => null(), z(:) => null()
  contains
    procedure :: do_chunk => do_operation
  end type operation_pass

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

    if (associated(self%before)) then
      call note_segments(first, self%contact(first:last), self%first(self%before(k) + 1:self%before(k + 1)), &
                         self%last(self%before(k) + 1:self%before(k + 1)))
      return
    end if
    if (last >= first) call count_segments(self%contact(first:last), self%found(:, k))
  end subroutine find_in_chunk

  !> The number of segments of `contact` and that of its points; without branches, so that the compiler can do several
  !> points at once.
  pure subroutine count_segments(contact, found)
    logical, intent(in), contiguous :: contact(:)
    real(dp), intent(inout), contiguous :: found(:)
    integer :: i, number, points

    points = merge(1, 0, contact(1))
    number = points
    do i = 2, size(contact)
      points = points + merge(1, 0, contact(i))
      number = number + merge(1, 0, contact(i) .and. .not. contact(i - 1))
    end do
    found = real([number, points], dp)
  end subroutine count_segments

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

  !> Are all points in one chunk?
  pure function are_in_one_chunk(self)
    class(contact_segments), intent(in) :: self
    logical :: are_in_one_chunk

    are_in_one_chunk = size(self%before) <= 2
  end function are_in_one_chunk

  !> Sum of `x` (n) over the segments.
  function sum_over(segments, x) result(total)
    type(contact_segments), intent(in) :: segments
    real(dp), intent(in), contiguous :: x(:)
    real(dp) :: total
    real(dp) :: sums(2)

    if (segments%are_in_one_chunk()) then
      total = sum_on_runs(size(segments%first), segments%first, segments%last, size(x), x)
    else
      call share_operation(TO_SUM, segments, 0.0_dp, sums, x=x)
      total = sums(1)
    end if
    total = segments%space%total(total)
  end function sum_over

  !> Inner product of `x` and `y`, both (n), over the segments.
  function dot_over(segments, x, y) result(inner)
    type(contact_segments), intent(in) :: segments
    real(dp), intent(in), contiguous :: x(:), y(:)
    real(dp) :: inner
    real(dp) :: sums(2)

    if (segments%are_in_one_chunk()) then
      inner = dot_on_runs(size(segments%first), segments%first, segments%last, size(x), x, y)
    else
      call share_operation(DOT, segments, 0.0_dp, sums, x=x, z=y)
      inner = sums(1)
    end if
    inner = segments%space%total(inner)
  end function dot_over

  !> `inner` = the inner product of `x` and `y` over the segments, `total` = the sum of `y`; both (n).
  subroutine dot_and_sum_over(segments, x, y, inner, total)
    type(contact_segments), intent(in) :: segments
    real(dp), intent(in), contiguous :: x(:), y(:)
    real(dp), intent(out) :: inner, total
    real(dp) :: sums(2)

    if (segments%are_in_one_chunk()) then
      call dot_and_sum_on_runs(size(segments%first), segments%first, segments%last, size(x), x, y, sums)
    else
      call share_operation(DOT_AND_SUM, segments, 0.0_dp, sums, x=x, z=y)
    end if
    if (.not. segments%space%is_alone()) call segments%space%add(sums)
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
    real(dp) :: sums(2)

    if (segments%are_in_one_chunk()) then
      call subtract_and_dot_on_runs(size(segments%first), segments%first, segments%last, size(y), factor, x, y, z, &
                                    inner)
    else
      call share_operation(SUBTRACT_AND_DOT, segments, factor, sums, x, y, z)
      inner = sums(1)
    end if
    inner = segments%space%total(inner)
  end subroutine subtract_and_dot_over

  !> Subtract `mean` from `x` (n) over the segments; `largest` is the largest |x| then, 0 if there is none.
  subroutine center_over(segments, mean, x, largest)
    type(contact_segments), intent(in) :: segments
    real(dp), intent(in) :: mean
    real(dp), intent(inout), contiguous :: x(:)
    real(dp), intent(out) :: largest
    real(dp) :: maxima(2)

    if (segments%are_in_one_chunk()) then
      call center_on_runs(size(segments%first), segments%first, segments%last, size(x), mean, x, largest)
    else
      call share_operation(CENTER, segments, mean, maxima, y=x)
      largest = maxima(1)
    end if
    largest = segments%space%largest(largest)
  end subroutine center_over

  !> Largest |x| over the segments, 0 if there is none; `x` (n).
  function max_abs_over(segments, x) result(largest)
    type(contact_segments), intent(in) :: segments
    real(dp), intent(in), contiguous :: x(:)
    real(dp) :: largest
    real(dp) :: maxima(2)

    if (segments%are_in_one_chunk()) then
      largest = max_abs_on_runs(size(segments%first), segments%first, segments%last, size(x), x)
    else
      call share_operation(MAX_ABS, segments, 0.0_dp, maxima, x=x)
      largest = maxima(1)
    end if
    largest = segments%space%largest(largest)
  end function max_abs_over

  !> y = x + factor*y over the segments, both (n).
  subroutine add_scaled_over(segments, factor, x, y)
    type(contact_segments), intent(in) :: segments
    real(dp), intent(in) :: factor
    real(dp), intent(in), contiguous :: x(:)
    real(dp), intent(inout), contiguous :: y(:)
    real(dp) :: none(2)

    if (segments%are_in_one_chunk()) then
      call add_scaled_on_runs(size(segments%first), segments%first, segments%last, size(x), factor, x, y)
    else
      call share_operation(ADD_SCALED, segments, factor, none, x=x, y=y)
    end if
  end subroutine add_scaled_over

  !> Do an operation on several chunks. Found: the sums over the chunks, or the maxima.
  subroutine share_operation(operation, segments, factor, found, x, y, z)
    integer, intent(in) :: operation
    type(contact_segments), intent(in), target :: segments
    real(dp), intent(in) :: factor
    real(dp), intent(out) :: found(2)
    real(dp), intent(in), contiguous, target, optional :: x(:), z(:)
    real(dp), intent(inout), contiguous, target, optional :: y(:)
    type(operation_pass) :: pass
    integer :: i, n

    n = 0
    pass%operation = operation
    pass%segments => segments
    pass%factor = factor
    if (present(x)) then
      pass%x => x
      n = size(x)
    end if
    if (present(y)) then
      pass%y => y
      n = size(y)
    end if
    if (present(z)) pass%z => z
    call pass%run(n, 2)
    if (operation == CENTER .or. operation == MAX_ABS) then
      found = [(pass%largest(i), i=1, 2)]
    else
      found = [(pass%total(i), i=1, 2)]
    end if
  end subroutine share_operation

  subroutine do_operation(self, k, first, last)
    class(operation_pass), intent(inout) :: self
    integer, intent(in) :: k, first, last
    integer :: n, runs

    if (last < first) return
    associate (a => self%segments%before(k) + 1, b => self%segments%before(k + 1))
      runs = b - a + 1
      n = self%points
      associate (begin => self%segments%first(a:b), finish => self%segments%last(a:b), found => self%found(:, k))
        select case (self%operation)
        case (TO_SUM)
          found(1) = sum_on_runs(runs, begin, finish, n, self%x)
        case (DOT)
          found(1) = dot_on_runs(runs, begin, finish, n, self%x, self%z)
        case (DOT_AND_SUM)
          call dot_and_sum_on_runs(runs, begin, finish, n, self%x, self%z, found)
        case (SUBTRACT_AND_DOT)
          call subtract_and_dot_on_runs(runs, begin, finish, n, self%factor, self%x, self%y, self%z, found(1))
        case (CENTER)
          call center_on_runs(runs, begin, finish, n, self%factor, self%y, found(1))
        case (MAX_ABS)
          found(1) = max_abs_on_runs(runs, begin, finish, n, self%x)
        case (ADD_SCALED)
          call add_scaled_on_runs(runs, begin, finish, n, self%factor, self%x, self%y)
        end select
      end associate
    end associate
  end subroutine do_operation

end module fuge_contact_segments
