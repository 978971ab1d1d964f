!> Residual and errors of forces, the same for all solvers. They are computed from the forces alone, and
!> share with the certificate only the product with the operator.
module bench_judge
  use bench_problems, only: bench_problem
  use bench_records, only: bench_row
  use fuge, only: dp => fuge_dp, fuge_contact_edges, fuge_info, fuge_interval, fuge_operator, FUGE_EDGE_GRID_END, &
    FUGE_EDGE_REFINED, FUGE_FREE, FUGE_HAT, FUGE_MEAN
  implicit none
  private

  public :: judge, approach_error, edge_interval

  real(dp), parameter :: PI = acos(-1.0_dp)
  !> Points count as in contact above this fraction of the largest force: some solvers leave small forces elsewhere.
  real(dp), parameter :: IN_CONTACT = 1.0e-9_dp

contains

  !> Fill residual, errors and number of points in contact. `reference` (n): forces of the
  !> same problem, solved to rounding; size 0 if there are none.
  subroutine judge(problem, operator, force, reference, row)
    type(bench_problem), intent(in) :: problem
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: force(:), reference(:)
    type(bench_row), intent(inout) :: row
    real(dp) :: motion(2)

    row%unknowns = count(force > IN_CONTACT*maxval(force))
    call find_residual(problem, operator, force, row%residual, motion)
    row%error_solver = -1.0_dp
    if (size(reference) == size(force)) row%error_solver = sum(abs(force - reference))/problem%load
    call find_errors(problem, force, motion, row)
  end subroutine judge

  !> The worst of negative gap, negative force, complementarity and equilibrium, each as a fraction of
  !> the range of displacements (but at least load/E*), of the largest force, of the load; `motion`: the motions that
  !> minimise the mean square of the gaps, weighted by the forces.
  subroutine find_residual(problem, operator, force, residual, motion)
    type(bench_problem), intent(in) :: problem
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: force(:)
    real(dp), intent(out) :: residual, motion(2)
    real(dp), allocatable :: open_gap(:)
    real(dp) :: length, missing
    integer :: status

    allocate (open_gap(size(force)), source=0.0_dp)
    call operator%apply(force, open_gap, status)
    if (status /= 0) error stop 'no product'
    length = max(maxval(open_gap) - minval(open_gap), 1.0e-3_dp*(maxval(problem%gap) - minval(problem%gap)))
    ! Under a flat face all displacements are equal.
    if (problem%e_star > 0.0_dp) length = max(length, problem%load/problem%e_star)
    open_gap = open_gap + problem%gap
    motion = motions_of(problem, max(force, 0.0_dp), open_gap)
    missing = abs(sum(force) - problem%load)/problem%load
    if (allocated(problem%modes)) then
      open_gap = open_gap - matmul(problem%modes, motion)
      missing = max(missing, abs(dot_product(problem%modes(:, 2), force) - problem%resultant(2)) &
                    /(problem%load*maxval(abs(problem%modes(:, 2)))))
    else
      open_gap = open_gap - motion(1)
    end if
    ! `apply` does not include the datum.
    motion(1) = motion(1) + operator%datum()*sum(force)
    residual = max(-minval(open_gap)/length, -minval(force)/maxval(force), &
                   sum(abs(force*open_gap))/(problem%load*length), missing, 0.0_dp)
  end subroutine find_residual

  !> The translation and tilt of least squares of the gaps, `weight` >= 0.
  pure function motions_of(problem, weight, gap) result(motion)
    type(bench_problem), intent(in) :: problem
    real(dp), intent(in) :: weight(:), gap(:)
    real(dp) :: motion(2)
    real(dp) :: total, middle, mean
    real(dp), allocatable :: arm(:)

    total = sum(weight)
    mean = sum(weight*gap)/total
    motion = [mean, 0.0_dp]
    if (.not. allocated(problem%modes)) return
    middle = sum(weight*problem%modes(:, 2))/total
    arm = problem%modes(:, 2) - middle
    motion(2) = sum(weight*arm*(gap - mean))/sum(weight*arm**2)
    motion(1) = mean - middle*motion(2)
  end function motions_of

  !> Errors against the closed form; negative where there is none.
  subroutine find_errors(problem, force, motion, row)
    type(bench_problem), intent(in) :: problem
    real(dp), intent(in) :: force(:), motion(2)
    type(bench_row), intent(inout) :: row
    real(dp) :: exact(size(force))

    row%error_half_width = -1.0_dp
    row%error_pressure = -1.0_dp
    row%error_force = -1.0_dp
    row%error_approach = -1.0_dp
    if (.not. allocated(problem%form)) return
    exact = problem%exact_forces()
    row%error_pressure = sum(abs(force - exact))/problem%load
    row%error_force = maxval(abs(force - exact))/maxval(exact)
    row%error_half_width = half_width_error(problem, force)
    row%error_approach = approach_error(problem, motion(1) + problem%middle*motion(2))
  end subroutine find_errors

  !> Error of the approach in the middle of the contact, as a fraction of 2 F/(pi E*).
  pure function approach_error(problem, approach) result(error)
    type(bench_problem), intent(in) :: problem
    real(dp), intent(in) :: approach
    real(dp) :: error

    error = approach - problem%form%approach(datum(problem))
    ! Half of the datum that makes a periodic matrix definite.
    if (problem%boundary /= FUGE_FREE .and. allocated(problem%alpha)) then
      error = error - 0.5_dp*problem%alpha(1, 1)*problem%load
    end if
    error = abs(error)*0.5_dp*PI*problem%e_star/problem%load
  end function approach_error

  !> The datum of `fuge_halfplane_matrix`; on a periodic surface displacements count from the mean.
  pure function datum(problem) result(length)
    type(bench_problem), intent(in) :: problem
    real(dp) :: length

    length = 1.0_dp
    if (problem%boundary == FUGE_FREE) length = 2.0_dp*sum(problem%width)
  end function datum

  !> Error of the half width: on equal cells by the edges that the library finds, otherwise by the end of the
  !> last cell in contact. Negative where the edge is a corner, or if the contact is not one interval.
  function half_width_error(problem, force) result(error)
    type(bench_problem), intent(in) :: problem
    real(dp), intent(in) :: force(:)
    real(dp) :: error, half_width
    type(fuge_interval) :: contact
    logical :: found

    error = -1.0_dp
    if (problem%singular()) return
    if (problem%uniform) then
      call edge_interval(problem, force, contact, found)
      if (.not. found) return
      half_width = 0.5_dp*(contact%right - contact%left)
    else
      half_width = 0.5_dp*(maxval(problem%x + 0.5_dp*problem%width, mask=force > IN_CONTACT*maxval(force)) &
                           - minval(problem%x - 0.5_dp*problem%width, mask=force > IN_CONTACT*maxval(force)))
    end if
    error = abs(half_width/problem%form%a - 1.0_dp)
  end function half_width_error

  !> The contact on equal cells as one interval.
  subroutine edge_interval(problem, force, contact, found)
    type(bench_problem), intent(in) :: problem
    real(dp), intent(in) :: force(:)
    type(fuge_interval), intent(out) :: contact
    logical, intent(out) :: found
    type(fuge_interval), allocatable :: intervals(:)
    type(fuge_info) :: info
    integer :: element

    element = problem%element
    ! A plane face has the same mean gap and gap at the centre.
    if (element == FUGE_MEAN .and. allocated(problem%modes)) element = FUGE_HAT
    call fuge_contact_edges(problem%x, problem%width, merge(force, 0.0_dp, force > IN_CONTACT*maxval(force)), &
                            element, intervals, info)
    found = .not. info%failed()
    if (found) found = size(intervals) == 1
    if (.not. found) return
    contact = intervals(1)
    found = all([contact%left_kind, contact%right_kind] == FUGE_EDGE_REFINED &
                .or. [contact%left_kind, contact%right_kind] == FUGE_EDGE_GRID_END)
  end subroutine edge_interval

end module bench_judge
