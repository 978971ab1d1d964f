!> A square raft below a wind turbine, on soil that does not pull, in 500 load cases.
!>
!>     raft [plates along a side [folder for its tables]]
!>
!> The raft is a sheet of plate elements whose nodes stand on one-way springs, the soil of their share of the area. The
!> tower presses a ring in its middle with its weight and with the moment of the wind: 25 moments from 20 directions.
!> One stiffness matrix is condensed once, the cases are solved together, and the envelopes tell where the soil is
!> pressed most and where the raft lifts off. Forces in kN, lengths in m.
!>
!> Known: force and moment of the soil in every case, and for a raft that hardly bends the pressure below its edge when
!> the wind blows along a side: 6 e/l more than the mean until the eccentricity e is l/6, and from then on that of a
!> triangle on the length 3 (l/2 - e). For the picture it writes raft_pressure.csv and raft_edge.csv.
program raft
  use example_output, only: create_file
  use example_stiffness, only: bodies_stiffness
  use example_verdict, only: verdict
  use fuge, only: dp => fuge_dp, fuge_body, fuge_case_solutions, fuge_condense, fuge_condensed, fuge_dense_operator, &
    fuge_envelope, fuge_find_envelope, fuge_info, fuge_link_law, fuge_links, fuge_load_cases, &
    fuge_problem, fuge_solve_cases, fuge_solver
  use raft_plates, only: node_number, raft_stiffness
  implicit none

  real(dp), parameter :: PI = acos(-1.0_dp)
  !> A concrete raft of 18 m by 18 m, 1.5 m thick, on dense sand.
  real(dp), parameter :: SIDE = 18.0_dp, POISSON = 0.2_dp, SOIL = 3.0e4_dp
  real(dp), parameter :: RIGIDITY = 3.3e7_dp*1.5_dp**3/(12.0_dp*(1.0_dp - POISSON**2))
  !> How much stiffer the raft is that hardly bends.
  real(dp), parameter :: STIFFER = 1.0e4_dp
  !> Weight of raft and earth, evenly spread, and of the tower, on a ring of these radii.
  real(dp), parameter :: SPREAD_WEIGHT = 1.0e4_dp, TOWER_WEIGHT = 4.0e3_dp, WEIGHT = SPREAD_WEIGHT + TOWER_WEIGHT
  real(dp), parameter :: INNER = 1.9_dp, OUTER = 2.9_dp
  integer, parameter :: MOMENTS = 25, DIRECTIONS = 20, CASES = MOMENTS*DIRECTIONS
  !> Eccentricity of the largest moment, a fraction of the side.
  real(dp), parameter :: LARGEST = 0.375_dp
  !> The case that is drawn, and its direction.
  integer, parameter :: SHOWN_MOMENT = 20, SHOWN_DIRECTION = 3
  !> Errors of sums, and of forces that are the same but for a turn.
  real(dp), parameter :: ROUNDING = 1.0e-9_dp, TURN_ERROR = 1.0e-7_dp
  !> Error by springs at the nodes in place of the soil below plates, times the square of their number.
  real(dp), parameter :: LUMPED = 8.0_dp

  !> A raft in all cases.
  type :: solved_raft
    !> Nodes, (2, nodes), and the area that each one stands for, (nodes).
    real(dp), allocatable :: place(:, :), area(:)
    !> Displacements, (degrees, cases).
    real(dp), allocatable :: u(:, :)
    type(fuge_case_solutions) :: solutions
  end type solved_raft

  call run()

contains

  subroutine run()
    type(verdict) :: known
    type(solved_raft) :: elastic, stiff
    integer :: plates

    plates = plates_wanted()
    call solve_raft(plates, RIGIDITY, elastic)
    call check_equilibrium(elastic, known)
    call check_turns(plates, elastic, known)
    call print_envelope(elastic)
    call solve_raft(plates, STIFFER*RIGIDITY, stiff)
    call check_equilibrium(stiff, known)
    call compare_edges(plates, elastic, stiff, known)
    call write_pressures(elastic)
    call known%give('against statics, turned winds and a rigid raft')
  end subroutine run

  function plates_wanted() result(plates)
    integer :: plates
    character(len=16) :: word

    plates = 40
    call get_command_argument(1, word)
    if (word /= '') read (word, *) plates
  end function plates_wanted

  !> From the stiffness matrix to forces and displacements in all cases.
  subroutine solve_raft(plates, stiffness_of_bending, model)
    integer, intent(in) :: plates
    real(dp), intent(in) :: stiffness_of_bending
    type(solved_raft), intent(out) :: model
    integer, allocatable :: column(:), row(:)
    real(dp), allocatable :: value(:), loads(:, :)
    type(bodies_stiffness) :: stiffness
    type(fuge_links) :: links
    type(fuge_body) :: body
    type(fuge_condensed), target :: condensed
    type(fuge_problem) :: problem
    type(fuge_load_cases) :: load_cases
    type(fuge_dense_operator) :: operator
    type(fuge_solver) :: solver
    type(fuge_info) :: info

    call place_nodes(plates, model)
    call raft_stiffness(plates, SIDE/real(plates, dp), stiffness_of_bending, POISSON, column, row, value)
    call stiffness%set_columns(column, row, value, info)
    call require(info)
    call add_soil(model, links)
    call make_loads(model, loads)
    ! The soil alone holds the raft.
    body%floats = .true.
    call links%attach(body, info)
    call require(info)
    call fuge_condense(stiffness, body, condensed, info)
    call require(info)
    call links%pose_cases(condensed, loads, problem, load_cases, info)
    call require(info)
    call operator%set(condensed%alpha, info)
    call require(info)
    call fuge_solve_cases(solver, operator, problem, load_cases, model%solutions, info)
    call require(info)
    allocate (model%u(size(loads, 1), CASES), source=0.0_dp)
    call condensed%recover_cases(loads, model%solutions, model%u, info)
    call require(info)
  end subroutine solve_raft

  !> Nodes around the middle, line by line along x.
  subroutine place_nodes(plates, model)
    integer, intent(in) :: plates
    type(solved_raft), intent(inout) :: model
    real(dp) :: width
    integer :: i, j

    width = SIDE/real(plates, dp)
    allocate (model%place(2, (plates + 1)**2), model%area((plates + 1)**2))
    do j = 1, plates + 1
      do i = 1, plates + 1
        model%place(:, node_number(i, j, plates)) = width*real([i - 1, j - 1], dp) - 0.5_dp*SIDE
        model%area(node_number(i, j, plates)) = width**2*merge(0.5_dp, 1.0_dp, i == 1 .or. i > plates) &
                                                *merge(0.5_dp, 1.0_dp, j == 1 .or. j > plates)
      end do
    end do
  end subroutine place_nodes

  !> A spring below each node that pushes it up. Deflections are positive upwards.
  subroutine add_soil(model, links)
    type(solved_raft), intent(in) :: model
    type(fuge_links), intent(inout) :: links
    type(fuge_link_law) :: law
    type(fuge_info) :: info
    integer :: k

    do k = 1, size(model%area)
      law%compliance = 1.0_dp/(SOIL*model%area(k))
      call links%add_support([3*k - 2], [1.0_dp], info, law)
      call require(info)
    end do
  end subroutine add_soil

  !> Weights and wind, the moments of one direction after the other.
  subroutine make_loads(model, loads)
    type(solved_raft), intent(in) :: model
    real(dp), allocatable, intent(out) :: loads(:, :)
    logical :: tower(size(model%area))
    real(dp) :: arm(size(model%area))
    integer :: c, d, m

    tower = norm2(model%place, 1) >= INNER .and. norm2(model%place, 1) <= OUTER
    allocate (loads(3*size(model%area), CASES), source=0.0_dp)
    do d = 1, DIRECTIONS
      arm = matmul(direction(d), model%place)
      do m = 1, MOMENTS
        c = m + (d - 1)*MOMENTS
        loads(1::3, c) = -SPREAD_WEIGHT*model%area/SIDE**2
        where (tower) loads(1::3, c) = loads(1::3, c) - TOWER_WEIGHT/real(count(tower), dp) &
          - WEIGHT*eccentricity(m)*arm/sum(arm**2, mask=tower)
      end do
    end do
  end subroutine make_loads

  !> The wind blows along this unit vector.
  pure function direction(d) result(along)
    integer, intent(in) :: d
    real(dp) :: along(2)

    along = [cos(2.0_dp*PI*real(d - 1, dp)/DIRECTIONS), sin(2.0_dp*PI*real(d - 1, dp)/DIRECTIONS)]
  end function direction

  !> Moment over weight.
  pure function eccentricity(m) result(e)
    integer, intent(in) :: m
    real(dp) :: e

    e = LARGEST*SIDE*real(m, dp)/MOMENTS
  end function eccentricity

  !> Weight and moment of all cases.
  subroutine check_equilibrium(model, known)
    type(solved_raft), intent(in) :: model
    type(verdict), intent(inout) :: known
    integer :: c, d, m

    do d = 1, DIRECTIONS
      do m = 1, MOMENTS
        c = m + (d - 1)*MOMENTS
        call known%compare(sum(model%solutions%force(:, c))/WEIGHT - 1.0_dp, ROUNDING, 'the weight of a case')
        call known%compare(norm2(matmul(model%place, model%solutions%force(:, c))/(WEIGHT*SIDE) &
                                 - eccentricity(m)/SIDE*direction(d)), ROUNDING, 'the moment of a case')
      end do
    end do
  end subroutine check_equilibrium

  !> The square is its own image when it is turned by 90 degrees, and so are the forces.
  subroutine check_turns(plates, model, known)
    integer, intent(in) :: plates
    type(solved_raft), intent(in) :: model
    type(verdict), intent(inout) :: known
    integer :: c, d, i, j, turned(size(model%area))

    do j = 1, plates + 1
      do i = 1, plates + 1
        turned(node_number(i, j, plates)) = node_number(plates + 2 - j, i, plates)
      end do
    end do
    do d = 1, 3*DIRECTIONS/4
      c = d*MOMENTS
      associate (force => model%solutions%force)
        call known%compare(maxval(abs(force(turned, c + CASES/4) - force(:, c)))/maxval(force(:, c)), TURN_ERROR, &
                           'forces of a turned wind')
      end associate
    end do
  end subroutine check_turns

  !> Largest pressure of the soil and largest gap, where and when.
  subroutine print_envelope(model)
    type(solved_raft), intent(in) :: model
    type(fuge_envelope) :: pressure, lift, deflection
    type(fuge_info) :: info
    integer :: at

    call fuge_find_envelope(model%solutions%force/spread(model%area, 2, CASES), pressure, info)
    call require(info)
    call fuge_find_envelope(model%u(1::3, :), deflection, info)
    call require(info)
    call fuge_find_envelope(model%solutions%gap, lift, info)
    call require(info)
    print '(i0,a)', CASES, ' load cases of the raft'
    at = maxloc(pressure%largest, dim=1)
    print '(a,f8.1,a,2f7.2,a,i0)', 'largest pressure of the soil', pressure%largest(at), ' kN/m2 at', &
      model%place(:, at), ' m in case ', pressure%largest_case(at)
    at = minloc(deflection%smallest, dim=1)
    print '(a,f8.2,a,2f7.2,a,i0)', 'largest settlement          ', -1.0e3_dp*deflection%smallest(at), ' mm    at', &
      model%place(:, at), ' m in case ', deflection%smallest_case(at)
    at = maxloc(lift%largest, dim=1)
    print '(a,f8.2,a,2f7.2,a,i0)', 'largest gap below it        ', 1.0e3_dp*lift%largest(at), ' mm    at', &
      model%place(:, at), ' m in case ', lift%largest_case(at)
    print '(a,f6.1,a)', 'never pressed: ', 100.0_dp*sum(model%area, mask=.not. pressure%largest > 0.0_dp)/SIDE**2, &
      ' % of the raft'
  end subroutine print_envelope

  !> Pressures below the middle of the edge, in the mean over it, with wind along x.
  subroutine compare_edges(plates, elastic, stiff, known)
    integer, intent(in) :: plates
    type(solved_raft), intent(in) :: elastic, stiff
    type(verdict), intent(inout) :: known
    real(dp) :: exact
    integer :: edge(plates + 1), file, j, m

    edge = [(node_number(plates + 1, j, plates), j=1, plates + 1)]
    call create_file('raft_edge.csv', 2, file)
    write (file, '(a)') 'eccentricity/side,rigid,nearly rigid,elastic'
    print '(/,a)', 'wind along x: eccentricity/side, mean pressure of the edge over that of the raft'
    print '(a)', '          rigid  nearly rigid  elastic'
    do m = 1, MOMENTS
      exact = rigid_edge(eccentricity(m)/SIDE)
      call known%compare(edge_pressure(stiff, edge, m)/exact - 1.0_dp, LUMPED/real(plates, dp)**2, &
                         'the edge of a rigid raft')
      write (file, '(3(f9.5,'',''),f9.5)') eccentricity(m)/SIDE, exact, edge_pressure(stiff, edge, m), &
        edge_pressure(elastic, edge, m)
      if (mod(m, 5) == 0) print '(f6.3,f9.4,f14.4,f9.4)', eccentricity(m)/SIDE, exact, &
        edge_pressure(stiff, edge, m), edge_pressure(elastic, edge, m)
    end do
    close (file)
  end subroutine compare_edges

  !> Pressure of the nodes on the edge, over the mean of the raft.
  pure function edge_pressure(model, edge, c) result(pressure)
    type(solved_raft), intent(in) :: model
    integer, intent(in) :: edge(:), c
    real(dp) :: pressure

    pressure = sum(model%solutions%force(edge, c))/sum(model%area(edge))*SIDE**2/WEIGHT
  end function edge_pressure

  !> The same of a rigid raft, at this eccentricity over its side.
  pure function rigid_edge(e) result(pressure)
    real(dp), intent(in) :: e
    real(dp) :: pressure

    if (e < 1.0_dp/6.0_dp) then
      pressure = 1.0_dp + 6.0_dp*e
    else
      pressure = 2.0_dp/(3.0_dp*(0.5_dp - e))
    end if
  end function rigid_edge

  !> The pressures of a case, kN/m2, node by node.
  subroutine write_pressures(model)
    type(solved_raft), intent(in) :: model
    integer :: file, k

    call create_file('raft_pressure.csv', 2, file)
    write (file, '(a)') 'x,y,pressure,gap in mm'
    associate (c => SHOWN_MOMENT + (SHOWN_DIRECTION - 1)*MOMENTS)
      do k = 1, size(model%area)
        write (file, '(3(f10.4,'',''),f10.4)') model%place(:, k), model%solutions%force(k, c)/model%area(k), &
          1.0e3_dp*model%solutions%gap(k, c)
      end do
    end associate
    close (file)
  end subroutine write_pressures

  subroutine require(info)
    type(fuge_info), intent(in) :: info

    if (info%status == 0) return
    print '(a)', trim(info%message)
    error stop 'the raft was not solved'
  end subroutine require

end program raft
