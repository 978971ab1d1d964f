!> Runs of neighbours that are marked.
module fuge_marked_runs
  implicit none
  private

  public :: next_run

contains

  !> The next run of marked elements, `first` to `last`, from `start` on; `first` is beyond the last element if there is
  !> no such run.
  pure subroutine next_run(marked, start, first, last)
    logical, intent(in) :: marked(:)
    integer, intent(in) :: start
    integer, intent(out) :: first, last

    do first = start, size(marked)
      if (marked(first)) exit
    end do
    do last = first, size(marked) - 1
      if (.not. marked(last + 1)) return
    end do
    last = size(marked)
  end subroutine next_run

end module fuge_marked_runs
