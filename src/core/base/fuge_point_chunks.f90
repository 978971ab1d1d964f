!> Passes over points in chunks, which threads share: the same chunks, and sums in the same order, for any number of
!> threads.
module fuge_point_chunks
  use fuge_input_checks, only: is_finite_everywhere
  use fuge_kinds, only: dp
  use fuge_threads, only: run_in_parts, threads_here, work_in_parts
  implicit none
  private

  public :: chunk_count, is_finite_in_chunks

  !> Points of a chunk: 64 kB of numbers, which waking a thread is worth.
  integer, parameter, public :: CHUNK = 8192

  !> A pass. Extend it by the arrays that it reads and changes.
  type, abstract, extends(work_in_parts), public :: chunked_pass
    !> Number of points.
    integer :: points = 0
    !> What each chunk has found, (:, chunks); allocated before the pass, zero.
    real(dp), allocatable :: found(:, :)
  contains
    procedure(do_one_chunk), deferred :: do_chunk
    procedure :: do_part
    procedure :: run
    procedure :: total
    procedure :: largest
    procedure :: take
  end type chunked_pass

  !> A pass over values. Found: 1 if one of a chunk is not finite.
  type, extends(chunked_pass) :: finite_pass
    real(dp), pointer, contiguous :: values(:) => null()
  contains
    procedure :: do_chunk => check_chunk
  end type finite_pass

  abstract interface
    !> Do chunk number `k`, the points `first` .. `last`.
    subroutine do_one_chunk(self, k, first, last)
      import :: chunked_pass
      class(chunked_pass), intent(inout) :: self
      integer, intent(in) :: k, first, last
    end subroutine do_one_chunk
  end interface

contains

  !> How many chunks `n` points have: one at least.
  pure function chunk_count(n)
    integer, intent(in) :: n
    integer :: chunk_count

    chunk_count = max((n - 1)/CHUNK + 1, 1)
  end function chunk_count

  !> Do all chunks of `points` points. Each finds `results` numbers.
  subroutine run(self, points, results)
    class(chunked_pass), intent(inout) :: self
    integer, intent(in) :: points, results
    integer :: chunks

    self%points = points
    chunks = chunk_count(points)
    if (allocated(self%found)) then
      if (size(self%found, 1) /= results .or. size(self%found, 2) /= chunks) deallocate (self%found)
    end if
    if (.not. allocated(self%found)) allocate (self%found(results, chunks))
    self%found = 0.0_dp
    if (chunks == 1) then
      call self%do_chunk(1, 1, points)
    else
      call run_in_parts(min(chunks, threads_here()), self)
    end if
  end subroutine run

  !> Every so manieth chunk, so that all threads have points everywhere.
  subroutine do_part(self, part, parts)
    class(chunked_pass), intent(inout) :: self
    integer, intent(in) :: part, parts
    integer :: k

    do k = part + 1, size(self%found, 2), parts
      call self%do_chunk(k, CHUNK*(k - 1) + 1, CHUNK*(k - 1) + min(CHUNK, self%points - CHUNK*(k - 1)))
    end do
  end subroutine do_part

  !> The sum of what the chunks have found under `number`.
  pure function total(self, number)
    class(chunked_pass), intent(in) :: self
    integer, intent(in) :: number
    real(dp) :: total
    integer :: k

    total = 0.0_dp
    do k = 1, size(self%found, 2)
      total = total + self%found(number, k)
    end do
  end function total

  !> The largest of it.
  pure function largest(self, number)
    class(chunked_pass), intent(in) :: self
    integer, intent(in) :: number
    real(dp) :: largest

    largest = maxval(self%found(number, :))
  end function largest

  !> The sums of the first numbers that the chunks have found, and the largest of those from number `second` on.
  pure subroutine take(self, second, sums, largest)
    class(chunked_pass), intent(in) :: self
    integer, intent(in) :: second
    real(dp), intent(out), contiguous :: sums(:), largest(:)
    integer :: j, k

    do j = 1, size(sums)
      sums(j) = self%found(j, 1)
    end do
    do j = 1, size(largest)
      largest(j) = self%found(second + j - 1, 1)
    end do
    do k = 2, size(self%found, 2)
      do j = 1, size(sums)
        sums(j) = sums(j) + self%found(j, k)
      end do
      do j = 1, size(largest)
        largest(j) = max(largest(j), self%found(second + j - 1, k))
      end do
    end do
  end subroutine take

  !> As `is_finite_everywhere`, in threads where many values are worth them.
  function is_finite_in_chunks(values) result(finite)
    real(dp), intent(in), contiguous :: values(:)
    logical :: finite

    if (size(values) > CHUNK) then
      finite = all_chunks_are_finite(values)
    else
      finite = is_finite_everywhere(values)
    end if
  end function is_finite_in_chunks

  function all_chunks_are_finite(values) result(finite)
    real(dp), intent(in), contiguous, target :: values(:)
    logical :: finite
    type(finite_pass) :: pass

    pass%values => values
    call pass%run(size(values), 1)
    finite = .not. pass%largest(1) > 0.0_dp
  end function all_chunks_are_finite

  !> Chunk `k`, the values `first` .. `last`.
  subroutine check_chunk(self, k, first, last)
    class(finite_pass), intent(inout) :: self
    integer, intent(in) :: k, first, last

    if (.not. is_finite_everywhere(self%values(first:last))) self%found(1, k) = 1.0_dp
  end subroutine check_chunk

end module fuge_point_chunks
