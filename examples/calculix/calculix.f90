!> CalculiX and fuge on one finite element model: a block with a cylindrical top (R = 250 mm)
!> pressed against a rigid plate, in plane strain.
!>
!>     calculix [ccx]
!>
!> has to run in a folder with model.inp, stiffness.inp and contact.inp, to which it and CalculiX write all
!> their files; `ccx` is the command that starts CalculiX. CalculiX assembles the stiffness, fuge condenses
!> it to the influence matrix of the nodes on top and solves the contact, without increments or penalty.
!> CalculiX's own contact of the same nodes (node to surface, linear penalty) approaches that solution as
!> its penalty stiffness grows. The exact answer is that of Hertz for the half-plane,
!> a = sqrt(4 P R/(pi E*)) for the load P per thickness. See doc/calculix.md.
!> The table calculix.csv is for the picture.
program calculix
  use calculix_elastic, only: condense_block, elastic_block, give_up, influence_by_unit_loads
  use calculix_files, only: wall_clock
  use calculix_mesh, only: block_mesh, make_block, write_mesh, RADIUS, THICKNESS
  use calculix_penalty, only: penalty_answer, solve_by_penalty
  use example_verdict, only: verdict
  use fuge, only: dp => fuge_dp, fuge_dense_operator, fuge_info, fuge_problem, fuge_solution, fuge_solve_dense, &
    fuge_solver
  implicit none

  !> N, mm, as in model.inp and contact.inp: half of the load, on the half modelled.
  real(dp), parameter :: YOUNG = 2.1e5_dp, POISSON = 0.3_dp, LOAD = 5.0_dp
  !> About 15 elements on the half-width, and a block of 20 half-widths; mm.
  real(dp), parameter :: SPACING = 0.025_dp, GROWTH = 1.2_dp, SIDE = 7.5_dp
  !> Penalty stiffnesses over Young's modulus, 1/mm. CalculiX advises 5 to 50.
  real(dp), parameter :: PENALTY(4) = [5.0_dp, 50.0_dp, 500.0_dp, 5.0e3_dp]
  !> Relative tolerance for numbers printed with seven digits.
  real(dp), parameter :: SEVEN_DIGITS = 6.0e-7_dp
  real(dp), parameter :: PI = acos(-1.0_dp)
  real(dp), parameter :: E_STAR = YOUNG/(1.0_dp - POISSON**2)
  real(dp), parameter :: HERTZ_WIDTH = sqrt(8.0_dp*LOAD/THICKNESS*RADIUS/(PI*E_STAR))
  real(dp), parameter :: HERTZ_PRESSURE = 4.0_dp*LOAD/THICKNESS/(PI*HERTZ_WIDTH)

  call run()

contains

  subroutine run()
    character(len=:), allocatable :: command
    type(block_mesh) :: mesh
    type(elastic_block), target :: block
    type(fuge_solution) :: solution
    type(verdict) :: known
    real(dp) :: solving

    command = argument()
    mesh = make_block(SIDE, SPACING, GROWTH)
    call solve_by_fuge(command, mesh, block, solution, solving)
    print '(a)', 'Stiffness by CalculiX, contact by fuge'
    print '(i8,a,i0,a,i0,a)', size(block%node), ' degrees of freedom, ', size(solution%force), ' points, ', &
      count(solution%force > 0.0_dp), ' touch'
    print '(f9.4,a)', block%assembling, ' s  ccx -i stiffness', block%reading, ' s  reading stiffness.sti and .dof', &
      block%condensing, ' s  fuge_condense: the influence matrix', solving, ' s  contact', &
      block%assembling + block%reading + block%condensing + solving, ' s  together'
    call compare_influence(command, mesh, block, known)
    call compare_penalties(command, mesh, block, solution, known)
    call compare_blocks(command, known)
    call write_mesh(mesh, 'mesh.inp')
    call known%give('as CalculiX with springs, and Hertz')
  end subroutine run

  !> The command given as argument, or ccx.
  function argument() result(command)
    character(len=:), allocatable :: command
    character(len=1024) :: given

    command = 'ccx'
    if (command_argument_count() < 1) return
    call get_command_argument(1, given)
    command = trim(given)
  end function argument

  subroutine solve_by_fuge(command, mesh, block, solution, seconds)
    character(len=*), intent(in) :: command
    type(block_mesh), intent(in) :: mesh
    type(elastic_block), intent(out), target :: block
    type(fuge_solution), intent(out) :: solution
    real(dp), intent(out) :: seconds
    type(fuge_dense_operator) :: operator
    type(fuge_problem) :: problem
    type(fuge_solver) :: solver
    type(fuge_info) :: info

    call write_mesh(mesh, 'mesh.inp')
    call condense_block(command, mesh%contact_nodes(), block)
    seconds = wall_clock()
    call block%condensed%pose(-mesh%top(), problem, info)
    if (.not. info%failed()) call operator%set(block%condensed%alpha, info)
    if (info%failed()) call give_up(info)
    problem%resultant = [LOAD]
    call solver%solve(operator, problem, solution, info)
    if (info%status /= 0) call give_up(info)
    seconds = wall_clock() - seconds
  end subroutine solve_by_fuge

  subroutine compare_influence(command, mesh, block, known)
    character(len=*), intent(in) :: command
    type(block_mesh), intent(in) :: mesh
    type(elastic_block), intent(in) :: block
    type(verdict), intent(inout) :: known
    real(dp), allocatable :: printed(:, :)
    real(dp) :: seconds, asymmetry, difference
    integer :: k

    associate (alpha => block%condensed%alpha)
      allocate (printed(size(alpha, 1), mesh%lines))
      call influence_by_unit_loads(command, mesh%contact_nodes(), mesh%node([(k, k=1, mesh%lines)], 1, 1), &
                                   printed, seconds)
      asymmetry = maxval(abs(printed(1::2, :)/transpose(printed(1::2, :)) - 1.0_dp))
      difference = maxval(abs(printed/alpha(:, 1::2) - 1.0_dp))
    end associate
    print '(f9.4,a)', seconds, ' s  ccx -i unit: every other column by a unit load'
    print '(a,es8.1,a,es8.1)', '           largest relative difference', difference, ', asymmetry of these', asymmetry
    if (asymmetry > 2.0_dp*SEVEN_DIGITS) error stop 'the influence matrix is not symmetric'
    call known%compare(difference, SEVEN_DIGITS, 'the influence matrix of CalculiX')
  end subroutine compare_influence

  subroutine compare_penalties(command, mesh, block, solution, known)
    character(len=*), intent(in) :: command
    type(block_mesh), intent(in) :: mesh
    type(elastic_block), intent(in) :: block
    type(fuge_solution), intent(in) :: solution
    type(verdict), intent(inout) :: known
    type(penalty_answer) :: answer(size(PENALTY))
    real(dp) :: difference(size(PENALTY))
    integer :: k

    print '(/,a)', 'CalculiX''s own contact with a penalty K: differences from fuge'
    print '(a)', '     K/E    time incre- itera- nodes in  penetration  approach   displace-  forces     forces, fuge'
    print '(a)', '  [1/mm]     [s]  ments  tions  contact    /approach             ments                 with 1/K too'
    do k = 1, size(PENALTY)
      call solve_by_penalty(command, PENALTY(k)*YOUNG, mesh%contact_nodes(), mesh%place(), answer(k))
      difference(k) = maxval(abs(answer(k)%force - solution%force))/maxval(solution%force)
      call show_penalty(answer(k), block, mesh, solution, difference(k), known)
    end do
    call check_penalties(answer(size(PENALTY)), solution, difference)
    call write_contact(mesh, solution, answer)
  end subroutine compare_penalties

  !> A line of the table.
  subroutine show_penalty(answer, block, mesh, solution, difference, known)
    type(penalty_answer), intent(in) :: answer
    type(elastic_block), intent(in) :: block
    type(block_mesh), intent(in) :: mesh
    type(fuge_solution), intent(in) :: solution
    real(dp), intent(in) :: difference
    type(verdict), intent(inout) :: known
    real(dp) :: springs

    springs = spring_difference(answer, block, mesh)
    print '(f8.0,f8.2,2i7,i9,es13.1,es10.1,es12.1,es8.1,es17.1)', answer%stiffness/YOUNG, answer%seconds, &
      answer%increments, answer%iterations, count(answer%gap < 0.0_dp), maxval(-answer%gap)/solution%motion(1), &
      answer%approach/solution%motion(1) - 1.0_dp, field_difference(answer, block, solution), difference, springs
    call known%compare(sum(answer%force)/LOAD - 1.0_dp, 1.0e-5_dp, 'the sum of the forces of CalculiX')
    call known%compare(springs, 1.0e-5_dp, 'the forces with the springs of CalculiX')
  end subroutine show_penalty

  !> A penalty is a spring on each node, which adds to the diagonal of the influence matrix:
  !> with it fuge gives what CalculiX gives, at any penalty.
  function spring_difference(answer, block, mesh) result(difference)
    type(penalty_answer), intent(in) :: answer
    type(elastic_block), intent(in) :: block
    type(block_mesh), intent(in) :: mesh
    real(dp) :: difference
    real(dp), allocatable, target :: alpha(:, :)
    real(dp), dimension(size(answer%force)) :: force, gap
    real(dp) :: approach
    type(fuge_info) :: info
    integer :: k

    allocate (alpha, source=block%condensed%alpha)
    do k = 1, size(force)
      alpha(k, k) = alpha(k, k) + 1.0_dp/(answer%stiffness*answer%area(k))
    end do
    call fuge_solve_dense(alpha, -mesh%top(), LOAD, force, gap, approach, info)
    if (info%status /= 0) call give_up(info)
    difference = maxval(abs(answer%force - force))/maxval(force)
  end function spring_difference

  !> Displacements of all nodes of the block.
  function field_difference(answer, block, solution) result(difference)
    type(penalty_answer), intent(in) :: answer
    type(elastic_block), intent(in) :: block
    type(fuge_solution), intent(in) :: solution
    real(dp) :: difference
    real(dp) :: u(size(block%node))
    integer :: place(maxval(answer%node))
    type(fuge_info) :: info
    integer :: k

    call block%condensed%recover(solution, u, info)
    if (info%status /= 0) call give_up(info)
    place(answer%node) = [(k, k=1, size(answer%node))]
    difference = 0.0_dp
    do k = 1, size(u)
      difference = max(difference, abs(u(k) - answer%displacement(block%direction(k), place(block%node(k)))))
    end do
    difference = difference/maxval(abs(u))
  end function field_difference

  !> The difference falls like 1/K, and in the end the same nodes touch.
  subroutine check_penalties(stiffest, solution, difference)
    type(penalty_answer), intent(in) :: stiffest
    type(fuge_solution), intent(in) :: solution
    real(dp), intent(in) :: difference(:)
    integer :: k

    if (any((stiffest%gap < 0.0_dp) .neqv. (solution%force > 0.0_dp))) error stop 'other nodes touch in CalculiX'
    do k = 2, size(difference)
      if (difference(k) > difference(k - 1)) error stop 'the penalty does not lead to the answer of fuge'
    end do
    if (abs(difference(k - 2)/difference(k - 1) - 10.0_dp) > 1.0_dp) error stop 'its error does not fall like 1/K'
  end subroutine check_penalties

  !> For the picture: x in mm, pressures in N/mm2 and gaps in mm, of the nodes in front.
  subroutine write_contact(mesh, solution, answer)
    type(block_mesh), intent(in) :: mesh
    type(fuge_solution), intent(in) :: solution
    type(penalty_answer), intent(in) :: answer(:)
    real(dp) :: place(2, size(solution%force)), area(size(solution%force))
    integer :: file, i, k

    place = mesh%place()
    area = mesh%areas()
    open (newunit=file, file='calculix.csv', status='replace', action='write')
    write (file, '(a,*(:,",K/E ",f0.0,",gap"))') 'x,fuge,gap', PENALTY
    do i = 1, size(area), 2
      write (file, '(*(es14.6,:,","))') place(1, i), solution%force(i)/area(i), solution%gap(i), &
        (answer(k)%force(i)/area(i), answer(k)%gap(i), k=1, size(answer))
    end do
    close (file)
  end subroutine write_contact

  !> Errors of the half-width and the largest pressure by the block and by the elements.
  subroutine compare_blocks(command, known)
    character(len=*), intent(in) :: command
    type(verdict), intent(inout) :: known
    real(dp), parameter :: SIZES(5) = [3.75_dp, 7.5_dp, 15.0_dp, 30.0_dp, 30.0_dp]
    real(dp), parameter :: FINER(5) = [1.0_dp, 1.0_dp, 1.0_dp, 1.0_dp, 0.5_dp]
    type(block_mesh) :: mesh
    type(elastic_block), target :: block
    type(fuge_solution) :: solution
    real(dp) :: width, pressure, seconds
    integer :: k

    print '(/,a,f7.4,a,f7.2,a)', 'Against Hertz: a =', HERTZ_WIDTH, ' mm, p_0 =', HERTZ_PRESSURE, ' N/mm2'
    print '(a)', '   block  element  half-width     error    pressure     error             all, with'
    print '(a)', '     [a]      [a]        [mm]               [N/mm2]            unknowns     ccx [s]'
    do k = 1, size(SIZES)
      mesh = make_block(SIZES(k), SPACING*FINER(k), GROWTH**FINER(k))
      seconds = wall_clock()
      call solve_by_fuge(command, mesh, block, solution, pressure)
      seconds = wall_clock() - seconds
      call fit_ellipse(mesh, solution, width, pressure)
      print '(f8.1,f9.4,2(f12.4,f8.2,a),i10,f12.2)', SIZES(k)/HERTZ_WIDTH, SPACING*FINER(k)/HERTZ_WIDTH, &
        width, 100.0_dp*(width/HERTZ_WIDTH - 1.0_dp), ' %', &
        pressure, 100.0_dp*(pressure/HERTZ_PRESSURE - 1.0_dp), ' %', size(block%node), seconds
    end do
    call known%compare(width/HERTZ_WIDTH - 1.0_dp, 2.0e-3_dp, 'the half-width of Hertz')
    call known%compare(pressure/HERTZ_PRESSURE - 1.0_dp, 2.0e-3_dp, 'the pressure of Hertz')
  end subroutine compare_blocks

  !> The half ellipse p**2 = p_0**2 (1 - x**2/a**2) nearest to the nodal pressures, without
  !> the two outermost nodes in contact.
  pure subroutine fit_ellipse(mesh, solution, width, pressure)
    type(block_mesh), intent(in) :: mesh
    type(fuge_solution), intent(in) :: solution
    real(dp), intent(out) :: width, pressure
    real(dp), dimension(size(solution%force)) :: x2, p2
    real(dp) :: slope
    logical :: inside(size(solution%force))
    integer :: n

    p2 = (solution%force/mesh%areas())**2
    x2 = -2.0_dp*RADIUS*mesh%top()
    inside = solution%force > 0.0_dp
    n = count(inside) - 4
    inside(n + 1:) = .false.
    slope = sum((x2 - sum(x2, inside)/n)*p2, inside)/sum((x2 - sum(x2, inside)/n)**2, inside)
    pressure = sqrt(sum(p2 - slope*x2, inside)/n)
    width = pressure/sqrt(-slope)
  end subroutine fit_ellipse

end program calculix
