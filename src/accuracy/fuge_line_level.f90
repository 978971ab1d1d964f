!> One grid on the way to a line contact of a wanted error: its gaps, its solution, the error that comes from the ends
!> of the contacts, and what it may have missed.
module fuge_line_level
  use fuge_cell_elements, only: FUGE_MEAN
  use fuge_gap_function_type, only: fuge_gap_function, sample_gap
  use fuge_halfplane_fft, only: fuge_halfplane_operator
  use fuge_halfplane_influence, only: fuge_halfplane_matrix
  use fuge_kinds, only: dp
  use fuge_line_mesh, only: line_mesh
  use fuge_marked_runs, only: next_run
  use fuge_matrix_operator, only: fuge_dense_operator
  use fuge_operator_type, only: fuge_operator
  use fuge_options_type, only: fuge_options
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_pressing_type, only: fuge_pressing, pose_problem
  use fuge_resolved_contact_type, only: FUGE_BY_EQUAL_CELLS, FUGE_BY_GRADED_CELLS
  use fuge_solver_type, only: fuge_solver
  use fuge_status, only: fuge_info, report, require_memory, FUGE_DONE
  implicit none
  private

  public :: error_of_ends, is_resolved, line_level, means_of_samples, missed_contacts, solve_equal_cells, &
    solve_graded_cells

  !> A grid and the contact on it.
  type :: line_level
    type(line_mesh) :: mesh
    !> Mean initial gaps of the cells, length.
    real(dp), allocatable :: gap(:)
    type(fuge_solution) :: solution
    integer :: method = 0
  end type line_level

  !> Cells of a contact that is resolved; and the error that comes from the ends of one that is not, as part of its
  !> load.
  integer, parameter :: FEWEST_IN_CONTACT = 4
  real(dp), parameter :: PART_OF_FEW = 0.04_dp
  !> Samples of an open cell that look for contacts which its mean gap hides.
  integer, parameter :: LOOKS = 8
  !> A gap is negative if it is so by this part of how far the bodies overlap without deformation.
  real(dp), parameter :: NEGATIVE = 3.0e-3_dp
  !> Gaps of no more than so many steps to the next cell may be closed within the cell.
  real(dp), parameter :: NEAR = 2.0_dp

contains

  !> Solve on any cells, by their influence matrix. `level%mesh` is given. Errors: those of the gap function, of
  !> `fuge_halfplane_matrix` and of the solver, FUGE_ERR_MEMORY.
  subroutine solve_graded_cells(gap, pressing, level, info)
    class(fuge_gap_function), intent(in) :: gap
    type(fuge_pressing), intent(in) :: pressing
    type(line_level), intent(inout) :: level
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable, target :: alpha(:, :)
    type(fuge_dense_operator) :: operator
    integer :: n, stat

    n = size(level%mesh%x)
    level%method = FUGE_BY_GRADED_CELLS
    allocate (alpha(n, n), stat=stat)
    call require_memory(stat, 'the influence matrix of', n, 'cells', info)
    if (stat /= 0) return
    call average_gaps(gap, level, info)
    if (.not. info%failed()) call fuge_halfplane_matrix(level%mesh%x, level%mesh%width, pressing%e_star, FUGE_MEAN, &
                                                        alpha, info)
    if (.not. info%failed()) call operator%set(alpha, info)
    if (.not. info%failed()) call solve_level(operator, pressing, level, info)
  end subroutine solve_graded_cells

  !> Solve on the equal cells `level%mesh`, by FFT, with the mean gaps `level%gap` if they are there. Errors: those of
  !> the gap function, of the operator and of the solver.
  subroutine solve_equal_cells(gap, pressing, level, info)
    class(fuge_gap_function), intent(in) :: gap
    type(fuge_pressing), intent(in) :: pressing
    type(line_level), intent(inout) :: level
    type(fuge_info), intent(inout) :: info
    type(fuge_halfplane_operator) :: operator

    level%method = FUGE_BY_EQUAL_CELLS
    if (.not. allocated(level%gap)) call average_gaps(gap, level, info)
    if (info%failed()) return
    if (allocated(pressing%layers)) then
      call operator%set(size(level%mesh%x), level%mesh%width(1), pressing%layers%e_star(), info, FUGE_MEAN, &
                        pressing%boundary, body=pressing%layers%surface())
    else
      call operator%set(size(level%mesh%x), level%mesh%width(1), pressing%e_star, info, FUGE_MEAN, pressing%boundary)
    end if
    if (.not. info%failed()) call solve_level(operator, pressing, level, info)
  end subroutine solve_equal_cells

  !> The mean gaps of cells, by the rule of Gauss with two places.
  subroutine average_gaps(gap, level, info)
    class(fuge_gap_function), intent(in) :: gap
    type(line_level), intent(inout) :: level
    type(fuge_info), intent(inout) :: info
    real(dp), parameter :: PLACE = 0.5_dp/sqrt(3.0_dp)
    real(dp), allocatable :: x(:), height(:)
    integer :: n, stat

    n = size(level%mesh%x)
    allocate (x(2*n), height(2*n), stat=stat)
    call require_memory(stat, 'the gaps of', n, 'cells', info)
    if (stat /= 0) return
    x(:n) = level%mesh%x - PLACE*level%mesh%width
    x(n + 1:) = level%mesh%x + PLACE*level%mesh%width
    call sample_gap(gap, x, spread(0.0_dp, 1, 2*n), height, info)
    if (info%failed()) return
    level%gap = 0.5_dp*(height(:n) + height(n + 1:))
  end subroutine average_gaps

  !> The mean gaps of `cells` equal cells, (cells), from a whole number of samples a cell, the last one shared with the
  !> next cell: by the rule of Simpson.
  pure function means_of_samples(height, cells) result(mean)
    real(dp), intent(in) :: height(0:)
    integer, intent(in) :: cells
    real(dp) :: mean(cells)
    integer :: each, first, k

    each = (size(height) - 1)/cells
    do k = 1, cells
      first = each*(k - 1)
      mean(k) = (height(first) + height(first + each) + 4.0_dp*sum(height(first + 1:first + each - 1:2)) &
                 + 2.0_dp*sum(height(first + 2:first + each - 2:2)))/real(3*each, dp)
    end do
  end function means_of_samples

  !> Pose the problem on the cells, and solve it.
  subroutine solve_level(operator, pressing, level, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_pressing), intent(in) :: pressing
    type(line_level), intent(inout) :: level
    type(fuge_info), intent(inout) :: info
    type(fuge_problem) :: problem
    type(fuge_solver) :: solver
    type(fuge_options) :: options

    call pose_problem(pressing, level%gap, problem, options)
    if (allocated(pressing%moment)) then
      allocate (problem%modes(size(level%gap), 2), source=1.0_dp)
      problem%modes(:, 2) = level%mesh%x
      problem%resultant = [pressing%load, pressing%moment]
    end if
    call solver%solve(operator, problem, level%solution, info, options)
    ! What the solver remarks on the rim is part of the result.
    if (info%status == FUGE_DONE) call report(info, FUGE_DONE, '')
  end subroutine solve_level

  !> Do contacts of several cells carry most of the load? In one or two cells forces are those of the cells, and no
  !> finer grid would differ from them.
  pure function is_resolved(level)
    type(line_level), intent(in) :: level
    logical :: is_resolved
    real(dp) :: in_few
    logical :: touches(size(level%solution%force))
    integer :: first, last

    in_few = 0.0_dp
    associate (force => level%solution%force)
      touches = force > 0.0_dp
      call next_run(touches, 1, first, last)
      do while (first <= size(force))
        if (last - first < FEWEST_IN_CONTACT - 1) in_few = in_few + sum(force(first:last))
        call next_run(touches, last + 1, first, last)
      end do
      is_resolved = in_few <= 0.5_dp*sum(force)
    end associate
  end function is_resolved

  !> The error of the pressure that comes from the ends of all contacts on equal cells, as share of the load; 0 without
  !> a load. `is_periodic`: a contact goes on at the other end of the interval.
  pure function error_of_ends(force, is_periodic) result(error)
    real(dp), intent(in) :: force(:)
    logical, intent(in) :: is_periodic
    real(dp) :: error
    logical :: touches(size(force)), goes_on
    integer :: first, last

    error = 0.0_dp
    touches = force > 0.0_dp
    goes_on = is_periodic .and. touches(1) .and. touches(size(force))
    call next_run(touches, 1, first, last)
    do while (first <= size(force))
      if (last - first < FEWEST_IN_CONTACT - 1) then
        error = error + PART_OF_FEW*sum(force(first:last))
      else
        if (first > 1 .or. .not. goes_on) error = error + error_of_end(force(first:first + 2), first == 1)
        if (last < size(force) .or. .not. goes_on) &
          error = error + error_of_end(force(last:last - 2:-1), last == size(force))
      end if
      call next_run(touches, last + 1, first, last)
    end do
    if (error > 0.0_dp) error = error/sum(force)
  end function error_of_ends

  !> The force that is in the wrong place near an end of a contact whose last three cells carry `force` (3), from the
  !> end on.
  !>
  !> The pressure rises there like a root, and where in a cell it begins decides the error. The ratio of the first force
  !> to the second one tells that; the part of the three forces over that ratio was measured on cylinders. At the end of
  !> a body it is a corner; elsewhere pressures that do not rise so over three cells are not resolved.
  pure function error_of_end(force, is_rim) result(error)
    real(dp), intent(in) :: force(3)
    logical, intent(in) :: is_rim
    real(dp) :: error
    real(dp), parameter :: LEAST = 0.0105_dp, TO_ZERO = 0.054_dp, BEST_RATIO = 0.575_dp, SLOPE = 0.17_dp
    real(dp), parameter :: OF_CORNER = 0.042_dp, NOT_RESOLVED = 0.15_dp
    real(dp) :: ratio

    ratio = force(1)/force(2)
    if (ratio < BEST_RATIO) then
      error = LEAST + TO_ZERO*(1.0_dp - ratio/BEST_RATIO)**2
    else
      error = min(OF_CORNER, LEAST + SLOPE*(ratio - BEST_RATIO))
    end if
    if (.not. is_rim .and. (force(2) > force(3) .or. (ratio > BEST_RATIO .and. .not. error < OF_CORNER))) &
      error = NOT_RESOLVED
    error = error*sum(force)
  end function error_of_end

  !> Places in open cells, (2, k), where the gap under load is negative between the samples that the solve knows: the
  !> displacements are taken from the centres of the cells, the gaps from the function. Unless it is to look
  !> `everywhere`, cells are left out whose gap is far larger than it differs from those beside. Errors: those of the
  !> function.
  subroutine missed_contacts(gap, level, everywhere, missed, info)
    class(fuge_gap_function), intent(in) :: gap
    type(line_level), intent(in) :: level
    logical, intent(in) :: everywhere
    real(dp), allocatable, intent(inout) :: missed(:, :)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: x(:), height(:)
    integer, allocatable :: open(:)
    real(dp) :: moved(size(level%gap)), step, least
    integer :: j, k, lowest, before

    missed = reshape([real(dp) ::], [2, 0])
    allocate (open, source=pack([(k, k=1, size(level%gap))], .not. level%solution%force > 0.0_dp &
                                .and. (everywhere .or. nearly_closed(level%solution%gap))))
    if (size(open) < 1) return
    ! Gap under load less initial gap: displacement less motion.
    moved = level%solution%gap - level%gap
    least = -NEGATIVE*max(0.0_dp, maxval(-moved) - minval(level%gap))
    allocate (x(LOOKS*size(open)), height(LOOKS*size(open)))
    do k = 1, size(open)
      do j = 1, LOOKS
        x(LOOKS*(k - 1) + j) = level%mesh%x(open(k)) + level%mesh%width(open(k)) &
                               *((real(j, dp) - 0.5_dp)/real(LOOKS, dp) - 0.5_dp)
      end do
    end do
    call sample_gap(gap, x, spread(0.0_dp, 1, size(x)), height, info)
    if (info%failed()) return
    do k = 1, size(open)
      before = LOOKS*(k - 1)
      do j = before + 1, before + LOOKS
        height(j) = height(j) + between_centres(level%mesh, moved, open(k), x(j))
      end do
      lowest = before + minloc(height(before + 1:before + LOOKS), dim=1)
      if (height(lowest) >= least) cycle
      step = level%mesh%width(open(k))/real(2*LOOKS, dp)
      missed = reshape([missed, x(lowest) - step, x(lowest) + step], [2, size(missed, 2) + 1])
    end do
  end subroutine missed_contacts

  !> Which gaps, (n), are not much larger than the step to one beside?
  pure function nearly_closed(gap) result(nearly)
    real(dp), intent(in) :: gap(:)
    logical :: nearly(size(gap))
    real(dp) :: step(0:size(gap))
    integer :: n

    n = size(gap)
    step(0) = 0.0_dp
    step(n) = 0.0_dp
    step(1:n - 1) = abs(gap(2:) - gap(:n - 1))
    nearly = gap <= NEAR*max(step(:n - 1), step(1:))
  end function nearly_closed

  !> `values` (n) of the centres of cells, at `x` in cell `k`, by a straight line to the next centre.
  pure function between_centres(mesh, values, k, x) result(value)
    type(line_mesh), intent(in) :: mesh
    real(dp), intent(in) :: values(:), x
    integer, intent(in) :: k
    real(dp) :: value
    integer :: other

    other = k + merge(1, -1, x > mesh%x(k))
    value = values(k)
    if (other < 1 .or. other > size(values)) return
    value = value + (values(other) - value)*((x - mesh%x(k))/(mesh%x(other) - mesh%x(k)))
  end function between_centres

end module fuge_line_level
