!> Two square cells of a half-space so soft that a force on a cell displaces it by a fifth, with an installed fuge.
program consumer
  use fuge, only: dp => fuge_dp, fuge_info, fuge_problem, fuge_solution, fuge_solver, FUGE_CENTRE
  use fuge_mpi, only: fuge_mpi_halfspace_operator
  use mpi_f08, only: MPI_Finalize, MPI_Init, MPI_COMM_WORLD
  implicit none

  call MPI_Init()
  call run()
  call MPI_Finalize()

contains

  subroutine run()
    type(fuge_mpi_halfspace_operator) :: a
    type(fuge_problem) :: problem
    type(fuge_solution) :: solution
    type(fuge_solver) :: solver
    type(fuge_info) :: info
    real(dp) :: displacement(2), e_star
    integer :: status

    e_star = 5.0_dp*4.0_dp*log(1.0_dp + sqrt(2.0_dp))/acos(-1.0_dp)
    call a%set(2, 1, 1.0_dp, 1.0_dp, e_star, MPI_COMM_WORLD, info, element=FUGE_CENTRE)
    if (info%failed()) call stop_with(info)
    call a%apply([2.0_dp, 0.0_dp], displacement, status)
    problem%gap = [0.0_dp, 1.2_dp - displacement(2)]
    problem%resultant = [2.0_dp]
    call solver%solve(a, problem, solution, info)
    if (info%failed()) call stop_with(info)
    print '(a,2f6.3,a,2f6.3,a,f6.3)', 'force', solution%force, ' gap', solution%gap, ' approach', solution%motion
  end subroutine run

  subroutine stop_with(info)
    type(fuge_info), intent(in) :: info

    print '(a)', trim(info%message)
    error stop 1
  end subroutine stop_with

end program consumer
