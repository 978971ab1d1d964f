!> Passes over the points of an iterate, or of parts of one, in chunks.
module fuge_iterate_pass
  use fuge_conjugate_gradients, only: conjugate_gradients
  use fuge_contact_iterate, only: contact_iterate
  use fuge_contact_scene, only: contact_scene
  use fuge_contact_segments, only: contact_segments
  use fuge_contact_set, only: contact_set
  use fuge_kinds, only: dp
  use fuge_point_chunks, only: chunk_count, chunked_pass
  implicit none
  private

  !> A pass, of which one chunk takes no more than its loop. Associate what the operation uses.
  type, extends(chunked_pass), public :: iterate_pass
    type(contact_scene), pointer :: scene => null()
    type(contact_iterate), pointer :: iterate => null()
    type(contact_set), pointer :: set => null()
    type(contact_segments), pointer :: segments => null()
    type(conjugate_gradients), pointer :: gradients => null()
    !> A number that the operation needs.
    real(dp) :: value = 0.0_dp
    procedure(chunk_operation), pointer, nopass :: operation => null()
  contains
    procedure :: go
    procedure :: do_chunk
  end type iterate_pass

  abstract interface
    !> Chunk `k`, the points `first` .. `last`; what it finds is added to `found`, which is zero before, or raises it.
    subroutine chunk_operation(pass, k, first, last, found)
      import :: dp, iterate_pass
      class(iterate_pass), intent(inout) :: pass
      integer, intent(in) :: k, first, last
      real(dp), intent(inout) :: found(:)
    end subroutine chunk_operation
  end interface

contains

  !> Do `operation` on all chunks of `n` points. `found`: `sums` sums over the chunks, then maxima.
  subroutine go(self, operation, n, sums, found)
    class(iterate_pass), intent(inout) :: self
    procedure(chunk_operation) :: operation
    integer, intent(in) :: n, sums
    real(dp), intent(out) :: found(:)
    integer :: i

    if (chunk_count(n) == 1) then
      found = 0.0_dp
      call operation(self, 1, 1, n, found)
      return
    end if
    self%operation => operation
    call self%run(n, size(found))
    do i = 1, size(found)
      if (i <= sums) then
        found(i) = self%total(i)
      else
        found(i) = self%largest(i)
      end if
    end do
  end subroutine go

  subroutine do_chunk(self, k, first, last)
    class(iterate_pass), intent(inout) :: self
    integer, intent(in) :: k, first, last

    call self%operation(self, k, first, last, self%found(:, k))
  end subroutine do_chunk

end module fuge_iterate_pass
