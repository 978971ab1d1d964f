!> Threads for work that can be done in parts.
module fuge_threads
  use, intrinsic :: iso_c_binding, only: c_funloc, c_funptr, c_int, c_ptr, c_size_t
  implicit none
  private

  public :: begin_children_with, run_in_threads, run_jobs

  abstract interface
    !> Do part 0 .. `parts` - 1 of what `data` describes.
    subroutine task_in_parts(part, parts, data) bind(c)
      import :: c_int, c_ptr
      integer(c_int), intent(in), value :: part, parts
      type(c_ptr), intent(in), value :: data
    end subroutine task_in_parts
  end interface

  interface
    !> Do all parts at once, each in a thread of its own, and wait for them; one part in the thread that calls. A part
    !> whose thread cannot be started is done by that thread as well.
    subroutine start_threads(parts, task, data) bind(c, name='fuge_run_in_threads')
      import :: c_int, c_ptr, c_funptr
      integer(c_int), intent(in), value :: parts
      type(c_funptr), intent(in), value :: task
      type(c_ptr), intent(in), value :: data
    end subroutine start_threads

    !> Do `count` jobs at once, each in a thread of its own, as FFTW calls it: `work` with the address of each job, of
    !> `bytes` from `first` on.
    subroutine run_jobs(work, first, bytes, count, unused) bind(c, name='fuge_run_jobs')
      import :: c_int, c_ptr, c_funptr, c_size_t
      type(c_funptr), intent(in), value :: work
      type(c_ptr), intent(in), value :: first, unused
      integer(c_size_t), intent(in), value :: bytes
      integer(c_int), intent(in), value :: count
    end subroutine run_jobs

    !> Let every child that this process forks begin with `action`, a procedure of C without arguments: that of the
    !> first call, later ones change nothing. Calls must not overlap.
    subroutine begin_children_with(action) bind(c, name='fuge_begin_children_with')
      import :: c_funptr
      type(c_funptr), intent(in), value :: action
    end subroutine begin_children_with
  end interface

contains

  !> Do `parts` >= 1 parts of `task` at once, each in a thread of its own, and wait for them.
  subroutine run_in_threads(parts, task, data)
    integer, intent(in) :: parts
    procedure(task_in_parts) :: task
    type(c_ptr), intent(in) :: data

    call start_threads(int(parts, c_int), c_funloc(task), data)
  end subroutine run_in_threads

end module fuge_threads
