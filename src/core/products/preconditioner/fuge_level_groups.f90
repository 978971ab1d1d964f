!> Groups of cells of one level that are one cell of the next, on a line that ranks may share: sums and means over them.
module fuge_level_groups
  use fuge_kinds, only: dp
  use fuge_point_chunks, only: chunk_count, chunked_pass
  use fuge_shared_rows, only: shared_rows
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: add_to_groups, compute_group_means, subtract_from_groups, sum_over_groups, GROUP

  !> Cells of one level in a cell of the next.
  integer, parameter :: GROUP = 16

  !> What a pass over the groups does.
  integer, parameter :: ADD = 1, MEANS_OF = 2, SUBTRACT = 3

  !> Passes over cells in several chunks, each of whole groups; `coarse` has the values of the groups, `fine` those of
  !> the cells, `weight` their weights, or 1 for those to subtract from.
  type, extends(chunked_pass) :: group_pass
    integer :: operation = 0
    real(dp), pointer, contiguous :: coarse(:) => null(), fine(:) => null(), weight(:) => null(), &
      coarse_weight(:) => null()
    real(dp) :: factor = 0.0_dp
  contains
    procedure :: do_chunk => do_groups
  end type group_pass

contains

  subroutine do_groups(self, k, first, last)
    class(group_pass), intent(inout) :: self
    integer, intent(in) :: k, first, last
    integer :: from, to

    if (k < 1) return
    from = (first - 1)/GROUP + 1
    to = (last - 1)/GROUP + 1
    select case (self%operation)
    case (ADD)
      call add_groups(self%factor, self%coarse(from:to), self%fine(first:last))
    case (MEANS_OF)
      call mean_groups(self%weight(first:last), self%fine(first:last), self%coarse_weight(from:to), &
                       self%coarse(from:to))
    case (SUBTRACT)
      call subtract_groups(self%coarse(from:to), self%weight(first:last), self%fine(first:last))
    end select
  end subroutine do_groups

  !> Add `factor` times the values of groups to their cells.
  pure subroutine add_groups(factor, coarse, fine)
    real(dp), intent(in) :: factor
    real(dp), intent(in), contiguous :: coarse(:)
    real(dp), intent(inout), contiguous :: fine(:)
    integer :: i, k

    do k = 1, size(coarse)
      if (.not. abs(coarse(k)) > 0.0_dp) cycle
      do i = (k - 1)*GROUP + 1, min(k*GROUP, size(fine))
        fine(i) = fine(i) + factor*coarse(k)
      end do
    end do
  end subroutine add_groups

  !> Subtract the values of groups from those of their cells whose `indicator` is 1.
  pure subroutine subtract_groups(coarse, indicator, fine)
    real(dp), intent(in), contiguous :: coarse(:), indicator(:)
    real(dp), intent(inout), contiguous :: fine(:)
    integer :: i, k

    do k = 1, size(coarse)
      if (.not. abs(coarse(k)) > 0.0_dp) cycle
      do i = (k - 1)*GROUP + 1, min(k*GROUP, size(fine))
        fine(i) = fine(i) - coarse(k)*indicator(i)
      end do
    end do
  end subroutine subtract_groups

  !> The weighted `means` of the groups; 0 for a group of weight 0.
  pure subroutine mean_groups(weight, fine, coarse_weight, means)
    real(dp), intent(in), contiguous :: weight(:), fine(:), coarse_weight(:)
    real(dp), intent(inout), contiguous :: means(:)
    integer :: begin, finish, k

    do k = 1, size(means)
      means(k) = 0.0_dp
      if (.not. coarse_weight(k) > 0.0_dp) cycle
      begin = (k - 1)*GROUP + 1
      finish = min(k*GROUP, size(fine))
      means(k) = sum(weight(begin:finish)*fine(begin:finish))/coarse_weight(k)
    end do
  end subroutine mean_groups

  !> Add to, or with `weight` subtract from, the cells of several chunks.
  subroutine share_groups(factor, coarse, fine, weight)
    real(dp), intent(in) :: factor
    real(dp), intent(in), contiguous, target :: coarse(:)
    real(dp), intent(inout), contiguous, target :: fine(:)
    real(dp), intent(in), contiguous, target, optional :: weight(:)
    type(group_pass) :: pass

    pass%operation = ADD
    pass%factor = factor
    pass%coarse => coarse
    pass%fine => fine
    if (present(weight)) then
      pass%operation = SUBTRACT
      pass%weight => weight
    end if
    call pass%run(size(fine), 0)
  end subroutine share_groups

  !> As `mean_groups`, on several chunks.
  subroutine share_means(weight, fine, coarse_weight, means)
    real(dp), intent(in), contiguous, target :: weight(:), fine(:), coarse_weight(:)
    real(dp), intent(inout), contiguous, target :: means(:)
    type(group_pass) :: pass

    pass%operation = MEANS_OF
    pass%weight => weight
    pass%fine => fine
    pass%coarse_weight => coarse_weight
    pass%coarse => means
    call pass%run(size(fine), 0)
  end subroutine share_means

  !> Does this process have all cells that it needs for its groups? On a grid of a single row one rank has them all.
  pure function is_local(rows)
    type(shared_rows), intent(in) :: rows
    logical :: is_local

    is_local = rows%is_alone()
    if (.not. is_local) is_local = rows%cells(2) == 1
  end function is_local

  !> The groups of the rows `fine` of each rank, `first` to `last`, (0:ranks - 1).
  pure subroutine find_groups(fine, first, last)
    type(shared_rows), intent(in) :: fine
    integer, intent(out) :: first(0:), last(0:)
    integer :: r

    do r = 0, size(first) - 1
      first(r) = (fine%first(r) - 1)/GROUP + 1
      last(r) = (fine%first(r + 1) - 2)/GROUP + 1
      if (fine%first(r + 1) == fine%first(r)) last(r) = first(r) - 1
    end do
  end subroutine find_groups

  !> The sum of `values`, of the rows `fine`, over each group, a cell of the rows `coarse`. Error: FUGE_ERR_MEMORY.
  subroutine sum_over_groups(fine, coarse, values, sums, info)
    type(shared_rows), intent(in) :: fine, coarse
    real(dp), intent(in), contiguous :: values(:)
    real(dp), intent(inout), contiguous :: sums(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: collected(:), part(:)
    integer, dimension(0:fine%members() - 1) :: first, last
    integer :: begin, k, me, stat

    if (is_local(fine)) then
      do k = 1, size(sums)
        sums(k) = sum(values((k - 1)*GROUP + 1:min(k*GROUP, size(values))))
      end do
      return
    end if
    call find_groups(fine, first, last)
    me = fine%number()
    allocate (part(last(me) - first(me) + 1), stat=stat)
    ! The ranks agree on errors where they collect.
    call require_memory(stat, 'groups of', size(values), 'cells', info)
    if (stat /= 0) then
      allocate (part(0))
    else
      part = 0.0_dp
      begin = fine%first(me) - GROUP*(first(me) - 1) - 1
      do k = 1, size(values)
        associate (group_sum => part((begin + k - 1)/GROUP + 1))
          group_sum = group_sum + values(k)
        end associate
      end do
    end if
    call coarse%collect(1, part, first, last, collected, info)
    if (.not. info%failed()) sums = collected
  end subroutine sum_over_groups

  !> Weighted mean of `fine_values` over each group of cells; 0 for a group of weight 0. Error: FUGE_ERR_MEMORY.
  subroutine compute_group_means(fine, coarse, weight, fine_values, coarse_weight, means, info)
    type(shared_rows), intent(in) :: fine, coarse
    real(dp), intent(in), contiguous :: weight(:), fine_values(:), coarse_weight(:)
    real(dp), intent(inout), contiguous :: means(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: weighted(:)
    integer :: stat

    if (.not. is_local(fine)) then
      allocate (weighted(size(fine_values)), stat=stat)
      call require_memory(stat, 'the means of', size(fine_values), 'cells', info)
      if (stat /= 0) then
        allocate (weighted(0))
      else
        weighted = weight*fine_values
      end if
      call sum_over_groups(fine, coarse, weighted, means, info)
      if (info%failed()) return
      where (coarse_weight > 0.0_dp)
        means = means/coarse_weight
      else where
        means = 0.0_dp
      end where
      return
    end if
    if (chunk_count(size(fine_values)) == 1) then
      call mean_groups(weight, fine_values, coarse_weight, means)
    else
      call share_means(weight, fine_values, coarse_weight, means)
    end if
  end subroutine compute_group_means

  !> Subtract each group's value from those of its cells whose `indicator` is 1. Error: FUGE_ERR_MEMORY.
  subroutine subtract_from_groups(fine, coarse, coarse_values, indicator, fine_values, info)
    type(shared_rows), intent(in) :: fine, coarse
    real(dp), intent(in), contiguous :: coarse_values(:), indicator(:)
    real(dp), intent(inout), contiguous :: fine_values(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: part(:)
    integer :: before, i

    if (is_local(fine)) then
      if (chunk_count(size(fine_values)) == 1) then
        call subtract_groups(coarse_values, indicator, fine_values)
      else
        call share_groups(1.0_dp, coarse_values, fine_values, indicator)
      end if
      return
    end if
    call fetch_groups(fine, coarse, coarse_values, part, before, info)
    if (info%failed()) return
    do i = 1, size(fine_values)
      fine_values(i) = fine_values(i) - part((before + i - 1)/GROUP + 1)*indicator(i)
    end do
  end subroutine subtract_from_groups

  !> Add `factor` times each group's value to all its cells. Meant for forces, which are undefined
  !> off the contact anyway. Error: FUGE_ERR_MEMORY.
  subroutine add_to_groups(fine, coarse, factor, coarse_values, fine_values, info)
    type(shared_rows), intent(in) :: fine, coarse
    real(dp), intent(in) :: factor
    real(dp), intent(in), contiguous :: coarse_values(:)
    real(dp), intent(inout), contiguous :: fine_values(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: part(:)
    integer :: before, i

    if (is_local(fine)) then
      if (chunk_count(size(fine_values)) == 1) then
        call add_groups(factor, coarse_values, fine_values)
      else
        call share_groups(factor, coarse_values, fine_values)
      end if
      return
    end if
    call fetch_groups(fine, coarse, coarse_values, part, before, info)
    if (info%failed()) return
    do i = 1, size(fine_values)
      fine_values(i) = fine_values(i) + factor*part((before + i - 1)/GROUP + 1)
    end do
  end subroutine add_to_groups

  !> `part`: the values of the groups of this rank's cells, the first of which is behind `before` cells of its group.
  subroutine fetch_groups(fine, coarse, values, part, before, info)
    type(shared_rows), intent(in) :: fine, coarse
    real(dp), intent(in), contiguous :: values(:)
    real(dp), allocatable, intent(out) :: part(:)
    integer, intent(out) :: before
    type(fuge_info), intent(inout) :: info
    integer, dimension(0:fine%members() - 1) :: first, last
    integer :: me

    call find_groups(fine, first, last)
    me = fine%number()
    before = fine%first(me) - GROUP*(first(me) - 1) - 1
    call coarse%fetch(1, values, first, last, part, info)
  end subroutine fetch_groups

end module fuge_level_groups
