!> The paper's example with two nodes: Tabelle 1, tableau by tableau.
!>
!> fuge records the basis after each pivot; the tableaus are computed from these bases here.
program two_nodes
  use example_verdict, only: verdict
  use fuge, only: dp => fuge_dp, fuge_dense_operator, fuge_history, fuge_info, fuge_options, fuge_problem, &
    fuge_solution, fuge_solver
  implicit none

  real(dp), parameter :: ALPHA(2, 2) = reshape([0.2_dp, 0.1_dp, 0.1_dp, 0.2_dp], [2, 2])
  real(dp), parameter :: GAP(2) = [0.0_dp, 1.0_dp], LOAD = 2.0_dp
  !> Basis columns of each row as printed, a column here for each step.
  integer, parameter :: PRINTED_BASIS(3, 0:3) = reshape([6, 7, 8, 6, 7, 1, 6, 4, 1, 5, 4, 1], [3, 4])

  call run()

contains

  subroutine run()
    real(dp), target :: influence(2, 2)
    type(fuge_dense_operator) :: operator
    type(fuge_problem) :: problem
    type(fuge_solution) :: solution
    type(fuge_solver) :: solver
    type(fuge_info) :: info
    type(verdict) :: paper
    integer :: step

    influence = ALPHA
    allocate (problem%gap, source=GAP)
    problem%resultant = [LOAD]
    call operator%set(influence, info)
    if (.not. info%failed()) call solver%solve(operator, problem, solution, info, fuge_options(keep_history=.true.))
    if (info%status /= 0) error stop 'the two-node problem was not solved'

    call show_tableaus(solver%history, paper)
    print '(/,a)', 'Basis after each pivot, as at the foot of Tabelle 1:'
    do step = 0, solver%history%recorded() - 1
      print '(a)', solver%history%line(step)
    end do
    print '(/,a,2f8.3)', 'F   = ', solution%force
    print '(a,2f8.3)', 'c   = ', solution%gap
    print '(a,f8.3)', 'v_0 = ', solution%motion
    print '(a,es8.1)', 'residual ', info%residual
    call paper%give('bases of the paper''s Tabelle 1')
  end subroutine run

  !> The tableau of each step, by Gauss-Jordan elimination from the one before.
  subroutine show_tableaus(history, paper)
    type(fuge_history), intent(in) :: history
    type(verdict), intent(inout) :: paper
    real(dp) :: tableau(3, 6)
    integer :: basis(3), step, row

    if (history%recorded() /= size(PRINTED_BASIS, 2)) error stop 'Tabelle 1 has another number of steps'
    tableau(:2, :2) = -ALPHA
    tableau(:2, 3:4) = reshape([1.0_dp, 0.0_dp, 0.0_dp, 1.0_dp], [2, 2])
    tableau(:2, 5) = 1.0_dp
    tableau(:2, 6) = GAP
    tableau(3, :) = [1.0_dp, 1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, LOAD]
    basis = PRINTED_BASIS(:, 0)
    do step = 0, history%recorded() - 1
      call paper%hold(all(history%basis(step) == PRINTED_BASIS(:, step)), 'a basis')
      row = changed_row(basis, PRINTED_BASIS(:, step))
      basis = PRINTED_BASIS(:, step)
      if (row > 0) call pivot(tableau, row, basis(row))
      call show(tableau, basis, step)
    end do
  end subroutine show_tableaus

  !> The row in which two bases differ; zero if they are the same.
  pure function changed_row(before, after) result(row)
    integer, intent(in) :: before(:), after(:)
    integer :: row

    row = maxval(merge([1, 2, 3], 0, before /= after))
  end function changed_row

  pure subroutine pivot(tableau, row, column)
    real(dp), intent(inout) :: tableau(:, :)
    integer, intent(in) :: row, column
    integer :: k

    tableau(row, :) = tableau(row, :)/tableau(row, column)
    do k = 1, size(tableau, 1)
      if (k /= row) tableau(k, :) = tableau(k, :) - tableau(k, column)*tableau(row, :)
    end do
  end subroutine pivot

  !> The rows, and below them the objective: minus the sum of the rows whose basis variable is artificial.
  subroutine show(tableau, basis, step)
    real(dp), intent(in) :: tableau(:, :)
    integer, intent(in) :: basis(:), step
    integer :: row

    print '(/,a,i0,a,3(1x,i0))', 'step ', step, ', basis', basis
    print '(6a8)', 'F_1', 'F_2', 'c_1', 'c_2', 'v_0', 'RS'
    do row = 1, size(tableau, 1)
      print '(6f8.2)', tableau(row, :)
    end do
    print '(6f8.2)', 0.0_dp - matmul(merge(1.0_dp, 0.0_dp, basis > 5), tableau)
  end subroutine show

end program two_nodes
