!> The influence matrix of the paper's Table 1 by condensation of its inverse, with an installed fuge.
program consumer
  use fuge, only: dp => fuge_dp, fuge_body, fuge_condense, fuge_condensed, fuge_info, fuge_solve_dense
  use fuge_sparse, only: fuge_sparse_stiffness
  implicit none

  call run()

contains

  subroutine run()
    type(fuge_sparse_stiffness) :: k
    type(fuge_body) :: body
    type(fuge_condensed) :: condensed
    type(fuge_info) :: info
    real(dp) :: force(2), gap(2), approach

    ! The lower triangle.
    call k%set([1, 3, 4], [1, 2, 2], [20.0_dp, -10.0_dp, 20.0_dp]/3.0_dp, info)
    if (info%failed()) call stop_with(info)
    allocate (body%dof(1, 2), body%normal(1, 2))
    body%dof(1, :) = [1, 2]
    body%normal = 1.0_dp
    call fuge_condense(k, body, condensed, info)
    if (info%failed()) call stop_with(info)
    call fuge_solve_dense(condensed%alpha, [0.0_dp, 1.0_dp], 2.0_dp, force, gap, approach, info)
    if (info%status /= 0) call stop_with(info)
    print '(a,2f6.3,a,2f6.3,a,f6.3)', 'force', force, ' gap', gap, ' approach', approach
  end subroutine run

  subroutine stop_with(info)
    type(fuge_info), intent(in) :: info

    print '(a)', trim(info%message)
    error stop 1
  end subroutine stop_with

end program consumer
