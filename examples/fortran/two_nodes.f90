!> The paper's example with two nodes: Tabelle 1, tableau by tableau.
program two_nodes
  use fuge, only: dp => fuge_dp, fuge_dense_operator, fuge_info, fuge_options, fuge_problem, fuge_solution, &
    fuge_solver, &
    FUGE_PAPER_RULE
  use fuge_paper_tableau, only: paper_tableau
  implicit none

  !> Basis columns of each row as printed, a column here for each step.
  integer, parameter :: PRINTED_BASIS(3, 0:3) = reshape([6, 7, 8, 6, 7, 1, 6, 4, 1, 5, 4, 1], [3, 4])

  call show_tableaus()
  call solve()

contains

  subroutine show_tableaus()
    type(paper_tableau) :: tableau
    integer :: step, column, row, status

    call tableau%start(influence(), [0.0_dp, 1.0_dp], 2.0_dp, status)
    do step = 0, 3
      call show(tableau, step)
      if (any(tableau%basis /= PRINTED_BASIS(:, step))) error stop 'the basis differs from Tabelle 1'
      if (tableau%finished()) exit
      call tableau%choose(FUGE_PAPER_RULE, column, row)
      call tableau%pivot(column, row)
    end do
  end subroutine show_tableaus

  subroutine show(tableau, step)
    type(paper_tableau), intent(in) :: tableau
    integer, intent(in) :: step
    integer :: row, column

    print '(/,a,i0,a,3(1x,i0))', 'step ', step, ', basis', tableau%basis
    print '(6a8)', 'F_1', 'F_2', 'c_1', 'c_2', 'v_0', 'RS'
    do row = 1, 4
      print '(6f8.2)', (tableau%entry_at(row, column), column=1, 6)
    end do
  end subroutine show

  subroutine solve()
    real(dp), target :: alpha(2, 2)
    type(fuge_dense_operator) :: operator
    type(fuge_problem) :: problem
    type(fuge_solution) :: solution
    type(fuge_solver) :: solver
    type(fuge_info) :: info
    integer :: step

    alpha = influence()
    problem%gap = [0.0_dp, 1.0_dp]
    problem%resultant = [2.0_dp]
    call operator%set(alpha, info)
    if (.not. info%failed()) call solver%solve(operator, problem, solution, info, fuge_options(keep_history=.true.))
    if (info%status /= 0) error stop 'the two-node problem was not solved'

    print '(/,a)', 'Basis after each pivot, as at the foot of Tabelle 1:'
    do step = 0, solver%history%recorded() - 1
      print '(a)', solver%history%line(step)
    end do
    print '(/,a,2f8.3)', 'F   = ', solution%force
    print '(a,2f8.3)', 'c   = ', solution%gap
    print '(a,f8.3)', 'v_0 = ', solution%motion
    print '(a,es8.1)', 'residual ', info%residual
  end subroutine solve

  pure function influence() result(alpha)
    real(dp) :: alpha(2, 2)

    alpha = reshape([0.2_dp, 0.1_dp, 0.1_dp, 0.2_dp], [2, 2])
  end function influence

end program two_nodes
