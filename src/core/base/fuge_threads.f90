!> Threads for work that can be done in parts.
!>
!> A thread that has begun a team shares such work with its members until it ends the team; without one, in a part of
!> other work, and in a process that has been forked meanwhile, it does all parts itself. How many threads there are is
!> no data of any procedure, because no result may depend on it: parts that are added up are the same for any number.
module fuge_threads
  use, intrinsic :: iso_c_binding, only: c_f_pointer, c_funloc, c_funptr, c_int, c_loc, c_null_ptr, c_ptr
  implicit none
  private

  public :: run_in_parts, run_in_threads, share, threads_here, usable_threads

  !> More threads than this do not start, however many are asked for: each takes memory of the process.
  integer, parameter :: MOST_THREADS = 1024

  !> Work in parts, with the data that it needs.
  type, abstract, public :: work_in_parts
  contains
    procedure(do_part), deferred :: do_part
  end type work_in_parts

  !> The threads that share the work of the thread that begins the team. Not to be copied.
  type, public :: thread_team
    private
    type(c_ptr) :: team = c_null_ptr
  contains
    procedure :: begin
    procedure :: end => end_team
  end type thread_team

  !> Passes a polymorphic variable through C.
  type :: work_holder
    class(work_in_parts), pointer :: work => null()
  end type work_holder

  abstract interface
    !> Do part 0 .. `parts` - 1. Parts are done at once, so that none may change what another one reads.
    subroutine do_part(self, part, parts)
      import :: work_in_parts
      class(work_in_parts), intent(inout) :: self
      integer, intent(in) :: part, parts
    end subroutine do_part

    !> Do part 0 .. `parts` - 1 of what `data` describes.
    subroutine task_in_parts(part, parts, data) bind(c)
      import :: c_int, c_ptr
      integer(c_int), intent(in), value :: part, parts
      type(c_ptr), intent(in), value :: data
    end subroutine task_in_parts
  end interface

  interface
    function begin_team(threads) bind(c, name='fuge_begin_team') result(team)
      import :: c_int, c_ptr
      integer(c_int), intent(in), value :: threads
      type(c_ptr) :: team
    end function begin_team

    subroutine finish_team(team) bind(c, name='fuge_end_team')
      import :: c_ptr
      type(c_ptr), intent(in), value :: team
    end subroutine finish_team

    function count_threads() bind(c, name='fuge_threads_here') result(threads)
      import :: c_int
      integer(c_int) :: threads
    end function count_threads

    function count_cores() bind(c, name='fuge_usable_threads') result(threads)
      import :: c_int
      integer(c_int) :: threads
    end function count_cores

    subroutine share_parts(parts, task, data) bind(c, name='fuge_run_in_threads')
      import :: c_int, c_ptr, c_funptr
      integer(c_int), intent(in), value :: parts
      type(c_funptr), intent(in), value :: task
      type(c_ptr), intent(in), value :: data
    end subroutine share_parts
  end interface

contains

  !> Let up to `threads` >= 1 threads, and no more than MOST_THREADS, share the work of this one. End the team in the
  !> same thread, those begun later first.
  subroutine begin(self, threads)
    class(thread_team), intent(inout) :: self
    integer, intent(in) :: threads

    if (threads > 1) self%team = begin_team(int(min(threads, MOST_THREADS), c_int))
  end subroutine begin

  !> End the team; without effect unless it was begun.
  subroutine end_team(self)
    class(thread_team), intent(inout) :: self

    call finish_team(self%team)
    self%team = c_null_ptr
  end subroutine end_team

  !> How many threads share the work of this one.
  function threads_here() result(threads)
    integer :: threads

    threads = int(count_threads())
  end function threads_here

  !> How many cores this process may use.
  function usable_threads() result(threads)
    integer :: threads

    threads = int(count_cores())
  end function usable_threads

  !> Do `parts` >= 1 parts of `task`, and wait for them.
  subroutine run_in_threads(parts, task, data)
    integer, intent(in) :: parts
    procedure(task_in_parts) :: task
    type(c_ptr), intent(in) :: data

    call share_parts(int(parts, c_int), c_funloc(task), data)
  end subroutine run_in_threads

  !> Do `parts` >= 1 parts of `work`, and wait for them.
  subroutine run_in_parts(parts, work)
    integer, intent(in) :: parts
    class(work_in_parts), intent(inout), target :: work
    type(work_holder), target :: holder
    integer :: part, threads

    threads = threads_here()
    if (min(parts, threads) == 1) then
      do part = 0, parts - 1
        call work%do_part(part, parts)
      end do
      return
    end if
    holder%work => work
    call share_parts(int(parts, c_int), c_funloc(do_held), c_loc(holder))
  end subroutine run_in_parts

  !> One part of the work that `data` holds.
  subroutine do_held(part, parts, data) bind(c, name='')
    integer(c_int), intent(in), value :: part, parts
    type(c_ptr), intent(in), value :: data
    type(work_holder), pointer :: holder

    call c_f_pointer(data, holder)
    call holder%work%do_part(int(part), int(parts))
  end subroutine do_held

  !> The numbers `first` .. `last` out of 0 .. n - 1 of part 0, 1, .. of `parts`.
  pure subroutine share(n, part, parts, first, last)
    integer, intent(in) :: n, part, parts
    integer, intent(out) :: first, last

    first = part*(n/parts) + min(part, mod(n, parts))
    last = first + n/parts - 1
    if (part < mod(n, parts)) last = last + 1
  end subroutine share

end module fuge_threads
