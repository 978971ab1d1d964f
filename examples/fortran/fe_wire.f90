!> The smallest finite element program: a wire under tension, held at both ends, pressed down
!> by a parabola. doc/tutorial_fe.md explains its middle part.
!>
!> Linear elements of the length h under the tension T, y upwards. Beneath the parabola
!> x**2/(2 R) the wire takes its curvature 1/R, outside it is straight: under the load F
!> the half-width is a = F R/(2 T), the nodes inside carry T h/R, and the parabola comes down by
!> a L/R - a**2/(2 R). Linear elements are exact at the nodes.
program fe_wire
  use example_verdict, only: verdict
  use fuge, only: dp => fuge_dp, fuge_band_stiffness, fuge_body, fuge_condense, fuge_condensed, fuge_dense_operator, &
    fuge_info, &
    fuge_problem, fuge_solution, fuge_solver
  implicit none

  integer, parameter :: ELEMENTS = 40, NODES = ELEMENTS + 1
  real(dp), parameter :: LENGTH = 1000.0_dp, TENSION = 500.0_dp, RADIUS = 2000.0_dp   ! mm, N; LENGTH is 2 L
  real(dp), parameter :: H = LENGTH/real(ELEMENTS, dp), LOAD = 105.0_dp               ! mm, N

  call run()

contains

  subroutine run()
    real(dp), target :: stiffness(2, NODES)
    real(dp) :: x(NODES), u(NODES)
    type(verdict) :: known
    integer :: k

    x = [(H*real(k - 1, dp) - 0.5_dp*LENGTH, k=1, NODES)]
    stiffness(1, :) = 2.0_dp*TENSION/H
    stiffness(1, [1, NODES]) = TENSION/H
    stiffness(2, :) = -TENSION/H
    call press(stiffness, [(k, k=2, NODES - 1)], x(2:NODES - 1)**2/(2.0_dp*RADIUS), u, known)
    call report(x, u)
    call known%give('against the exact edge, approach and force')
  end subroutine run

  !> Press the parabola on the nodes `touching`, whose initial gaps are `gap`; u are all displacements.
  subroutine press(stiffness, touching, gap, u, known)
    real(dp), intent(in), target :: stiffness(:, :)
    integer, intent(in) :: touching(:)
    real(dp), intent(in) :: gap(:)
    real(dp), intent(out) :: u(:)
    type(verdict), intent(inout) :: known
    type(fuge_band_stiffness) :: k
    type(fuge_body) :: body
    type(fuge_condensed), target :: condensed
    type(fuge_dense_operator) :: alpha
    type(fuge_problem) :: problem
    type(fuge_solver) :: solver
    type(fuge_solution) :: solution
    type(fuge_info) :: info
    integer :: i, n

    n = size(touching)
    call k%set(stiffness, .false., info)                          ! lower triangle, as LAPACK stores it
    body%fixed = [1, NODES]
    body%dof = reshape(touching, [1, n])
    body%normal = reshape([(-1.0_dp, i=1, n)], [1, n])            ! y upwards, pressed from above
    if (.not. info%failed()) call fuge_condense(k, body, condensed, info)
    if (.not. info%failed()) call condensed%pose(gap, problem, info)
    problem%resultant = [LOAD]
    if (.not. info%failed()) call alpha%set(condensed%alpha, info)
    if (.not. info%failed()) call solver%solve(alpha, problem, solution, info)
    if (.not. info%failed()) call condensed%recover(solution, u, info)
    if (info%failed()) print '(a)', trim(info%message)
    if (info%failed()) error stop 'the wire was not solved'
    call check(solution, gap, u(touching), known)
  end subroutine press

  !> Check the gaps against all displacements, and forces and approach against the exact solution.
  subroutine check(solution, gap, u, known)
    type(fuge_solution), intent(in) :: solution
    real(dp), intent(in) :: gap(:), u(:)
    type(verdict), intent(inout) :: known
    real(dp) :: half_width, reached, approach, inside, apart

    half_width = LOAD*RADIUS/(2.0_dp*TENSION)
    approach = 0.5_dp*half_width*(LENGTH - half_width)/RADIUS
    inside = TENSION*H/RADIUS
    reached = sqrt(2.0_dp*RADIUS*maxval(gap, mask=solution%force > 0.0_dp))
    print '(3(a,f6.1),a)', 'The contact ends between the nodes at', reached, ' and', reached + H, ' mm, exactly at', &
      half_width, ' mm'
    print '(a25,a12)', 'fuge', 'exact'
    print '(a,2f12.6,a)', 'approach     ', solution%motion(1), approach, ' mm'
    print '(a,2f12.6,a)', 'largest force', maxval(solution%force), inside, ' N'
    apart = maxval(abs(gap - u - solution%motion(1) - solution%gap))
    if (apart > 1.0e-10_dp*approach) error stop 'the displacements do not fit'
    call known%hold(abs(reached - half_width) <= H, 'the end of the contact')
    call known%compare(solution%motion(1)/approach - 1.0_dp, H**2/(RADIUS*approach), 'the approach')
    call known%compare(maxval(solution%force)/inside - 1.0_dp, 1.0e-9_dp, 'the force')
  end subroutine check

  subroutine report(x, u)
    real(dp), intent(in) :: x(:), u(:)
    integer :: k

    print '(/,a)', '     x [mm]     u [mm]'
    print '(f11.1,f11.4)', (x(k), u(k), k=1, size(x), 5)
  end subroutine report

end program fe_wire
