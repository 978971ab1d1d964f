!> Solves random contacts to a wanted error, and compares with fine grids that know nothing of how these were found.
module accuracy_judge
  use fuge_area_accuracy, only: fuge_solve_area
  use fuge_cell_elements, only: FUGE_MEAN
  use fuge_gap_function_type, only: fuge_gap_function
  use fuge_halfplane_fft, only: fuge_halfplane_operator
  use fuge_halfspace_fft, only: fuge_halfspace_operator
  use fuge_kinds, only: dp
  use fuge_level_history, only: line_difference
  use fuge_line_accuracy, only: fuge_solve_line
  use fuge_line_mesh, only: borders, line_mesh
  use fuge_operator_type, only: fuge_operator
  use fuge_options_type, only: fuge_options
  use fuge_pressing_type, only: fuge_pressing
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_resolved_contact_type, only: fuge_resolved_contact, FUGE_BY_GRADED_CELLS
  use fuge_solver_type, only: fuge_solver
  use fuge_status, only: fuge_info
  use gap_functions, only: gap_sum, misplaced_share
  use random_gaps, only: draw_area, draw_line, may_jump
  implicit none
  private

  public :: approach_falls_short, falls_short, judge_area, judge_line

  !> No reference is exact enough to tell.
  real(dp), parameter :: UNKNOWN = huge(1.0_dp)

  !> Estimates and true errors.
  type, public :: accuracy_verdict
    character(len=16) :: family = ''
    type(fuge_info) :: info
    type(fuge_pressing) :: pressing
    type(fuge_resolved_contact) :: contact
    real(dp) :: error = UNKNOWN, approach_error = UNKNOWN
    !> Seconds of the solve and of the reference.
    real(dp) :: seconds(2) = 0.0_dp
  end type accuracy_verdict

  !> Errors that are no more than those of the references: as share of the load, and relative to load/E*.
  real(dp), parameter :: HARMLESS = 3.0e-5_dp, HARMLESS_APPROACH = 1.0e-6_dp
  !> Cells of references, the finer ones where an estimate seems to be too small.
  integer, parameter :: FINE = 2**13, FINEST = 2**16
  !> The answers have no more than these, or are too fine for the references.
  integer, parameter :: MOST_CELLS = 2**12
  !> How much more exact a reference by graded cells is.
  real(dp), parameter :: MORE_EXACT = 6.0_dp
  !> Most cells of these: on more, equal cells would take their place.
  integer, parameter :: MOST_GRADED = 1900

contains

  !> Is the estimate of the error of the pressure less than `part` of it?
  pure function falls_short(verdict, part) result(short)
    type(accuracy_verdict), intent(in) :: verdict
    real(dp), intent(in) :: part
    logical :: short

    short = verdict%contact%pressure_error < part*verdict%error .and. verdict%error > HARMLESS &
            .and. verdict%error < UNKNOWN
  end function falls_short

  !> The same of the approach.
  pure function approach_falls_short(verdict, part) result(short)
    type(accuracy_verdict), intent(in) :: verdict
    real(dp), intent(in) :: part
    logical :: short

    short = verdict%contact%approach_error < part*verdict%approach_error &
            .and. verdict%approach_error > HARMLESS_APPROACH*verdict%contact%load/verdict%pressing%e_star &
            .and. verdict%error < UNKNOWN
  end function approach_falls_short

  !> Profile `number`.
  subroutine judge_line(number, verdict)
    integer, intent(in) :: number
    type(accuracy_verdict), intent(out) :: verdict
    type(gap_sum) :: gap
    real(dp) :: start, middle, finish
    type(fuge_solution) :: coarser

    call draw_line(number, verdict%family, gap, verdict%pressing)
    verdict%pressing%most_cells = MOST_CELLS
    call cpu_time(start)
    call fuge_solve_line(gap, -1.0_dp, 1.0_dp, verdict%pressing, verdict%contact, verdict%info)
    call cpu_time(middle)
    if (verdict%info%failed()) return
    if (may_jump(verdict%family)) then
      call compare_with_solve(gap, verdict)
    else
      call compare_with_cells(gap, FINE, verdict, coarser)
      if (falls_short(verdict, 1.0_dp) .or. approach_falls_short(verdict, 1.0_dp)) &
        call compare_with_cells(gap, FINEST, verdict, coarser)
      ! Where the pressure is nearly that at a corner, even these cells are too wide: graded ones have to agree.
      if (falls_short(verdict, 1.0_dp) .or. approach_falls_short(verdict, 1.0_dp)) call compare_with_solve(gap, verdict)
    end if
    call cpu_time(finish)
    verdict%seconds = [middle - start, finish - middle]
  end subroutine judge_line

  subroutine compare_with_solve(gap, verdict)
    type(gap_sum), intent(in) :: gap
    type(accuracy_verdict), intent(inout) :: verdict
    type(fuge_pressing) :: pressing
    type(fuge_resolved_contact) :: fine
    type(fuge_info) :: info

    pressing = verdict%pressing
    pressing%accuracy = verdict%contact%pressure_error/MORE_EXACT
    pressing%most_cells = MOST_GRADED
    call fuge_solve_line(gap, -1.0_dp, 1.0_dp, pressing, fine, info)
    if (info%failed() .or. fine%method /= FUGE_BY_GRADED_CELLS &
        .or. fine%pressure_error > 0.5_dp*verdict%contact%pressure_error) return
    associate (contact => verdict%contact)
      ! Straight lines between borders of graded cells would have errors like those of the answer.
      verdict%error = min(verdict%error, line_difference( &
        borders(line_mesh(contact%x, contact%width_x)), contact%force, borders(line_mesh(fine%x, fine%width_x)), &
        fine%force)/fine%load)
      verdict%approach_error = min(verdict%approach_error, abs(contact%approach - fine%approach))
    end associate
  end subroutine compare_with_solve

  !> Compare with `n` equal cells. `coarser` is the last such reference, if there was one, from which the errors of this
  !> one are estimated: they fall at least like those of corners. Out: this one.
  subroutine compare_with_cells(gap, n, verdict, coarser)
    type(gap_sum), intent(in) :: gap
    integer, intent(in) :: n
    type(accuracy_verdict), intent(inout) :: verdict
    type(fuge_solution), intent(inout) :: coarser
    type(fuge_halfplane_operator) :: operator
    type(fuge_problem) :: problem
    type(fuge_solution) :: solution
    type(fuge_info) :: info
    real(dp) :: x(n), width(n), height(n), total(n)
    integer :: k, status

    width = 2.0_dp/real(n, dp)
    x = [(-1.0_dp + width(k)*(real(k, dp) - 0.5_dp), k=1, n)]
    total = 0.0_dp
    do k = -1, 1, 2
      call gap%evaluate(x + real(k, dp)*width/sqrt(12.0_dp), 0.0_dp*x, height, status)
      total = total + 0.5_dp*height
    end do
    call operator%set(n, width(1), verdict%pressing%e_star, info, FUGE_MEAN, verdict%pressing%boundary)
    allocate (problem%gap, source=total)
    if (allocated(verdict%pressing%moment)) then
      allocate (problem%modes(n, 2), source=1.0_dp)
      problem%modes(:, 2) = x
      allocate (problem%resultant, source=[verdict%pressing%load, verdict%pressing%moment])
    else if (allocated(verdict%pressing%load)) then
      allocate (problem%resultant, source=[verdict%pressing%load])
    else
      allocate (problem%prescribed(1), source=.true.)
      allocate (problem%motion(1), source=verdict%pressing%approach)
    end if
    call solve_finely(operator, problem, solution, info)
    if (info%failed()) return
    call compare(verdict, x, width, solution%force, solution%motion(1))
    if (allocated(coarser%force)) call leave_out_own_errors(solution, coarser, verdict)
    coarser = solution
  end subroutine compare_with_cells

  !> Subtract from the errors those that a `fine` reference may have itself, after a `coarser` one. At a corner that of
  !> the pressure falls with the root of the width, and that of the approach in proportion to it.
  pure subroutine leave_out_own_errors(fine, coarser, verdict)
    type(fuge_solution), intent(in) :: fine, coarser
    type(accuracy_verdict), intent(inout) :: verdict
    integer :: each
    real(dp) :: difference

    each = size(fine%force)/size(coarser%force)
    difference = 0.5_dp*sum(abs(sum(reshape(fine%force, [each, size(coarser%force)]), dim=1) - coarser%force)) &
                 /sum(coarser%force)
    verdict%error = max(0.0_dp, verdict%error - difference/(sqrt(real(each, dp)) - 1.0_dp))
    verdict%approach_error = max(0.0_dp, verdict%approach_error - abs(fine%motion(1) - coarser%motion(1)) &
                                         /real(each - 1, dp))
  end subroutine leave_out_own_errors

  subroutine solve_finely(operator, problem, solution, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(out) :: solution
    type(fuge_info), intent(out) :: info
    type(fuge_solver) :: solver
    type(fuge_options) :: options

    options%tolerance = 1.0e-6_dp
    call solver%solve(operator, problem, solution, info, options)
  end subroutine solve_finely

  !> True errors from a fine solution, counted on cells of the answer that are put together where they are narrower than
  !> those of the fine solution; of several the smallest ones.
  pure subroutine compare(verdict, x, width, force, approach)
    type(accuracy_verdict), intent(inout) :: verdict
    real(dp), intent(in) :: x(:), width(:), force(:), approach
    real(dp) :: fine(size(x) + 1), upto(size(x) + 1), error
    real(dp), allocatable :: middle(:), span(:), total(:)
    integer :: k

    fine(1) = x(1) - 0.5_dp*width(1)
    upto(1) = 0.0_dp
    do k = 1, size(x)
      fine(k + 1) = x(k) + 0.5_dp*width(k)
      upto(k + 1) = upto(k) + force(k)
    end do
    call put_together(verdict%contact, width(1), middle, span, total)
    error = misplaced_share(middle, span, total, fine, upto)
    verdict%error = min(verdict%error, error)
    verdict%approach_error = min(verdict%approach_error, abs(verdict%contact%approach - approach))
  end subroutine compare

  !> Cells of a line that are put together to be at least of the width `least`: centres, widths and forces.
  pure subroutine put_together(contact, least, x, width, force)
    type(fuge_resolved_contact), intent(in) :: contact
    real(dp), intent(in) :: least
    real(dp), allocatable, intent(out) :: x(:), width(:), force(:)
    real(dp) :: left, right, total
    integer :: k

    allocate (x(0), width(0), force(0))
    left = contact%x(1) - 0.5_dp*contact%width_x(1)
    total = 0.0_dp
    do k = 1, size(contact%x)
      total = total + contact%force(k)
      right = contact%x(k) + 0.5_dp*contact%width_x(k)
      if (right - left < least .and. k < size(contact%x)) cycle
      x = [x, 0.5_dp*(left + right)]
      width = [width, right - left]
      force = [force, total]
      left = right
      total = 0.0_dp
    end do
  end subroutine put_together

  !> Surface `number` on at most n/2 x n/2 cells, against `n` x `n`.
  subroutine judge_area(number, n, verdict)
    integer, intent(in) :: number, n
    type(accuracy_verdict), intent(out) :: verdict
    type(gap_sum) :: gap
    type(fuge_halfspace_operator) :: operator
    type(fuge_problem) :: problem
    type(fuge_solution) :: solution
    type(fuge_info) :: info
    real(dp) :: start, middle, finish, width

    call draw_area(number, verdict%family, gap, verdict%pressing)
    verdict%pressing%most_cells = (n/2)**2
    call cpu_time(start)
    call fuge_solve_area(gap, [-1.0_dp, -1.0_dp], [1.0_dp, 1.0_dp], verdict%pressing, verdict%contact, verdict%info)
    call cpu_time(middle)
    if (verdict%info%failed()) return
    width = 2.0_dp/real(n, dp)
    call operator%set(n, n, width, width, verdict%pressing%e_star, info, FUGE_MEAN, verdict%pressing%boundary)
    allocate (problem%gap, source=heights_of(gap, n))
    allocate (problem%resultant, source=[verdict%pressing%load])
    call solve_finely(operator, problem, solution, info)
    call cpu_time(finish)
    verdict%seconds = [middle - start, finish - middle]
    if (info%failed()) return
    associate (contact => verdict%contact)
      verdict%error = 0.5_dp*sum(abs(on_cells(solution%force, n, size(contact%x), size(contact%y)) - contact%force)) &
                      /verdict%pressing%load
      verdict%approach_error = abs(contact%approach - solution%motion(1))
    end associate
  end subroutine judge_area

  function heights_of(gap, n) result(height)
    class(fuge_gap_function), intent(in) :: gap
    integer, intent(in) :: n
    real(dp) :: height(n*n)
    real(dp) :: x(n), y(n), row(n)
    integer :: i, j, k, status
    real(dp), parameter :: PLACE(2) = [-0.5_dp, 0.5_dp]/sqrt(3.0_dp)

    height = 0.0_dp
    do j = 1, n
      do k = 1, 4
        x = [((2.0_dp*real(i, dp) - 1.0_dp + PLACE(1 + modulo(k, 2)))/real(n, dp) - 1.0_dp, i=1, n)]
        y = (2.0_dp*real(j, dp) - 1.0_dp + PLACE(merge(1, 2, k < 3)))/real(n, dp) - 1.0_dp
        call gap%evaluate(x, y, row, status)
        height(n*(j - 1) + 1:n*j) = height(n*(j - 1) + 1:n*j) + 0.25_dp*row
      end do
    end do
  end function heights_of

  !> Forces (n*n) as those on `nx` x `ny` wider cells, from sums up to their corners.
  pure function on_cells(force, n, nx, ny) result(wider)
    real(dp), intent(in) :: force(:)
    integer, intent(in) :: n, nx, ny
    real(dp) :: wider(nx*ny)
    real(dp) :: upto(0:n, 0:n), corner(0:nx, 0:ny), u, v
    integer :: i, j, k, l

    upto(:, 0) = 0.0_dp
    do j = 1, n
      upto(0, j) = 0.0_dp
      do i = 1, n
        upto(i, j) = upto(i - 1, j) + (upto(i, j - 1) - upto(i - 1, j - 1)) + force(n*(j - 1) + i)
      end do
    end do
    do j = 0, ny
      v = real(n, dp)*real(j, dp)/real(ny, dp)
      l = min(int(v), n - 1)
      v = v - real(l, dp)
      do i = 0, nx
        u = real(n, dp)*real(i, dp)/real(nx, dp)
        k = min(int(u), n - 1)
        u = u - real(k, dp)
        corner(i, j) = (1.0_dp - v)*((1.0_dp - u)*upto(k, l) + u*upto(k + 1, l)) &
                       + v*((1.0_dp - u)*upto(k, l + 1) + u*upto(k + 1, l + 1))
      end do
    end do
    wider = reshape(corner(1:, 1:) - corner(:nx - 1, 1:) - corner(1:, :ny - 1) + corner(:nx - 1, :ny - 1), [nx*ny])
  end function on_cells

end module accuracy_judge
