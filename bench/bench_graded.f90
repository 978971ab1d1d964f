!> The known contacts on cells that become narrower towards edges and corners, made without knowing where the contact
!> ends.
module bench_graded
  use bench_judge, only: edge_interval
  use bench_problems, only: bench_problem, add_matrix, make_known, make_known_on, uniform_edges, REACH
  use bench_runs, only: solve_once
  use fuge, only: dp => fuge_dp, fuge_graded_cells, fuge_info, fuge_interval, FUGE_END_CORNER, FUGE_END_EDGE, FUGE_MEAN
  implicit none
  private

  public :: make_graded

  !> Cells beyond an end of the contact: where it is known well, and the share of those inside where it is not.
  integer, parameter :: FEW = 3
  real(dp), parameter :: SHARE_BEYOND = 0.12_dp

contains

  !> All steps of the set-up: coarse solution, its edges, grid and matrix. If one edge is a corner, equal cells
  !> give the other edge less accurately: the steps are repeated if the contact on that grid ends elsewhere.
  subroutine make_graded(name, n, problem)
    character(len=*), intent(in) :: name
    integer, intent(in) :: n
    type(bench_problem), intent(out), target :: problem
    integer, parameter :: FEWEST = 32, ROUNDS = 4
    real(dp) :: ends(2), found(2)
    logical :: known
    integer :: round

    known = name /= 'lifted'
    ends = [-REACH, REACH]
    call make_known(name, FUGE_MEAN, uniform_edges(max(FEWEST, n/2)), problem)
    if (.not. problem%singular()) ends = coarse_ends(problem)
    do round = 1, ROUNDS
      call make_between(name, ends, n, merge(FEW, ceiling(SHARE_BEYOND*real(n, dp)), known), problem)
      call add_matrix(problem)
      if (known) exit
      found = graded_ends(problem)
      if (all(abs(found - ends) <= 2.0_dp*minval(problem%width))) exit
      ends = found
    end do
  end subroutine make_graded

  function coarse_ends(coarse) result(ends)
    type(bench_problem), intent(inout), target :: coarse
    real(dp) :: ends(2)
    type(fuge_interval) :: contact
    real(dp) :: force(coarse%points())
    logical :: found

    call add_matrix(coarse)
    call solve_once(coarse, force)
    call edge_interval(coarse, force, contact, found)
    if (.not. found) error stop 'no edges of a coarse contact'
    ends = [contact%left, contact%right]
  end function coarse_ends

  function graded_ends(problem) result(ends)
    type(bench_problem), intent(in), target :: problem
    real(dp) :: ends(2)
    real(dp) :: force(problem%points())

    call solve_once(problem, force)
    ends = [minval(problem%x - 0.5_dp*problem%width, mask=force > 0.0_dp), &
            maxval(problem%x + 0.5_dp*problem%width, mask=force > 0.0_dp)]
  end function graded_ends

  !> `n` cells between `ends`, of which those inside the face are edges with some cells `beyond`, the others corners.
  subroutine make_between(name, ends, n, beyond, problem)
    character(len=*), intent(in) :: name
    real(dp), intent(in) :: ends(2)
    integer, intent(in) :: n, beyond
    type(bench_problem), intent(out) :: problem
    real(dp), allocatable :: x(:), width(:)
    type(fuge_info) :: info
    logical :: open(2)

    open = abs(ends) < REACH
    allocate (x(n + beyond*count(open)), width(n + beyond*count(open)))
    x = 0.0_dp
    width = 0.0_dp
    call fuge_graded_cells(ends(1), ends(2), merge(FUGE_END_EDGE, FUGE_END_CORNER, open), merge(beyond, 0, open), x, &
                           width, info)
    if (info%failed()) error stop 'no graded cells'
    call make_known_on(name, FUGE_MEAN, x, width, problem)
    problem%uniform = .false.
  end subroutine make_between

end module bench_graded
