!> The paper's Table 1 with an installed core.
program consumer
  use fuge_core, only: dp => fuge_dp, fuge_info, fuge_solve_dense
  implicit none

  call run()

contains

  subroutine run()
    real(dp) :: alpha(2, 2), force(2), gap(2), approach
    type(fuge_info) :: info

    alpha = reshape([0.2_dp, 0.1_dp, 0.1_dp, 0.2_dp], [2, 2])
    call fuge_solve_dense(alpha, [0.0_dp, 1.0_dp], 2.0_dp, force, gap, approach, info)
    if (info%status /= 0) error stop 'Table 1 was not solved'
    print '(a,2f6.3,a,2f6.3,a,f6.3)', 'force', force, ' gap', gap, ' approach', approach
  end subroutine run

end program consumer
