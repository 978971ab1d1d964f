!> A bolted flange in three dimensions: two flanges and a bolt with meshes that do not match.
!>
!>     flange [elements along each part, 1, 2, .. [folder for its tables]]
!>
!> Half a pitch of a joint with eight bolts M20, metal on metal. The bolt is a body of its own, with a head and a nut,
!> and touches only there. It is tightened by its shank, which is shorter than both flanges by 0.12 mm: head and nut
!> overlap the flanges by half of that each, negative gaps, which contact removes. A pair of forces in place of the bolt
!> would not do, because the force of a bolt changes when the joint is loaded. Then comes an internal pressure, on the
!> bore and on the lid at the end of the tube; it does not enter the joint where that opens.
!>
!> Forces are those for one bolt. The force of the bolt after tightening is compared with the usual formulas for bolted
!> joints, VDI 2230 part 1 (2003), chapter 5.1: the shank and 0.9 diameters in head and nut as a rod, both flanges as
!> a double cone. Under load the joint opens from the bore outwards, and the rim becomes a lever: the bolt carries more
!> than the thrust.
!> Tables: flange.csv, flange_map.dat, flange_outside.dat, flange_cut.dat; flange.vtu has the deformed bodies for
!> ParaView (Warp By Vector).
program flange
  use example_output, only: create_file
  use example_verdict, only: verdict
  use example_stiffness, only: IS_SPARSE
  use flange_body, only: turn_vectors
  use flange_mesh, only: flange_cells, flange_sizes
  use flange_model, only: build, displacements, flange_joint, flange_state, press, JOINT, UPPER, YOUNG
  use flange_picture, only: write_map, write_outside
  use fuge, only: dp => fuge_dp, fuge_info, fuge_join_meshes, fuge_make_mesh, fuge_mesh, fuge_mesh_field, &
    fuge_write_mesh
  implicit none

  real(dp), parameter :: PI = acos(-1.0_dp)
  !> How much shorter the shank is than both flanges, mm.
  real(dp), parameter :: SHORTENING = 0.12_dp
  !> N/mm2.
  real(dp), parameter :: PRESSURES(17) = 6.0_dp*[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16]
  !> That of the picture and of the comparison of meshes.
  real(dp), parameter :: SHOWN = 30.0_dp

  call run()

contains

  subroutine run()
    type(flange_sizes) :: sizes
    type(flange_joint), target :: model
    type(verdict) :: known

    call compare_meshes(sizes, model)
    call load(sizes, model, known)
    call known%give('equilibrium, and formulas for bolted joints')
  end subroutine run

  !> Elements along each part; 1 where they are few.
  integer function finest_count() result(count)
    character(len=32) :: argument
    integer :: status

    count = merge(2, 1, IS_SPARSE)
    call get_command_argument(1, argument)
    if (argument == '') return
    read (argument, *, iostat=status) count
    if (status /= 0 .or. count < 1) error stop 'the number of elements is 1, 2, ..'
  end function finest_count

  !> Meshes of the three bodies; those of the two flanges differ along all edges of the joint.
  pure function cells_of(order, fine) result(cells)
    integer, intent(in) :: order, fine
    type(flange_cells) :: cells(3)

    cells(1) = flange_cells(order=order, beside=fine, above=2*fine, around=2*fine, between=fine, wall=2*fine, &
                            inside=fine, outside=fine, height=2*fine, tube=3*fine)
    cells(2) = flange_cells(order=order, beside=fine, above=3*fine, around=fine + 1, between=fine + 1, wall=fine, &
                            inside=fine + 1, outside=fine, height=fine + 1, tube=2*fine)
    cells(3) = flange_cells(order=order, beside=fine, above=2*fine, around=fine, height=2*fine)
  end function cells_of

  !> The forces of the bolt on meshes that become finer; `model` is the finest one.
  subroutine compare_meshes(sizes, model)
    type(flange_sizes), intent(in) :: sizes
    type(flange_joint), intent(inout), target :: model
    type(flange_state) :: state
    real(dp), allocatable :: force(:, :)
    integer :: fine, finest, k, order

    finest = finest_count()
    allocate (force(2, 2*finest))
    print '(a)', 'Force of the bolt [kN]'
    print '(a,f4.0,a)', ' elements  degrees  points  tightened  at', SHOWN, ' N/mm2'
    k = 0
    do order = 1, 2
      do fine = 1, finest
        k = k + 1
        call build(cells_of(order, fine), sizes, SHORTENING, model)
        call press(model, 0.0_dp, state)
        force(1, k) = state%head
        call press(model, SHOWN, state)
        force(2, k) = state%head
        print '(a,i1,i11,i8,2f12.2)', merge(' hexa 8  ', ' hexa 20 ', order == 1)//'x', fine, &
          size(model%unit_load), model%joined%pairs%points(), 1.0e-3_dp*force(:, k)
      end do
    end do
    ! The last mesh is the reference of the others.
    associate (error => abs(force/spread(force(:, k), 2, k) - 1.0_dp))
      if (any(error(:, k - 1) > merge(0.03_dp, 0.1_dp, finest > 1)) .or. any(error(:, k - 1) > error(:, 1))) &
        error stop 'the forces do not converge'
    end associate
  end subroutine compare_meshes

  !> Tighten, compare, and raise the pressure.
  subroutine load(sizes, model, known)
    type(flange_sizes), intent(in) :: sizes
    type(flange_joint), intent(inout), target :: model
    type(verdict), intent(inout) :: known
    type(flange_state) :: state(size(PRESSURES))
    real(dp) :: inner(2), last_gap, last_inner(2)
    integer :: file, k

    call create_file('flange.csv', 2, file)
    write (file, '(a)') 'pressure [N/mm2],thrust [kN],bolt [kN],joint [kN],touching [%],gap at the bore [mm],' &
      //'touches beside the bolt from [mm],between two bolts from [mm]'
    print '(/,a)', 'Forces for one bolt; radius from which on the joint touches, beside the bolt and between two bolts'
    print '(a10,a12,2a9,a10,a22,a20)', 'p [N/mm2]', 'thrust [kN]', 'bolt', 'joint', 'touching', &
      'gap at the bore [mm]', 'touches from [mm]'
    last_gap = 0.0_dp
    last_inner = 0.0_dp
    do k = 1, size(PRESSURES)
      call press(model, PRESSURES(k), state(k))
      call check_forces(sizes, state(k), known)
      inner = [inner_radius(model, state(k), 0.0_dp), inner_radius(model, state(k), PI/real(sizes%bolts, dp))]
      print '(f10.0,f12.2,2f9.2,f8.1,a,f22.4,f12.1,f8.1)', PRESSURES(k), 1.0e-3_dp*state(k)%thrust, &
        1.0e-3_dp*state(k)%head, 1.0e-3_dp*state(k)%joint, 100.0_dp*state(k)%touching, ' %', &
        bore_gap(model, state(k)), inner
      write (file, '(f6.1,7('','',es14.6))') PRESSURES(k), 1.0e-3_dp*state(k)%thrust, 1.0e-3_dp*state(k)%head, &
        1.0e-3_dp*state(k)%joint, 100.0_dp*state(k)%touching, bore_gap(model, state(k)), inner
      if (any(inner < last_inner - 1.0e-9_dp*sizes%rim) .or. bore_gap(model, state(k)) < last_gap) &
        error stop 'the joint does not open from the bore outwards'
      last_gap = bore_gap(model, state(k))
      last_inner = inner
    end do
    close (file)
    call compare_with_formula(sizes, state(1), known)
    call write_map(model, state(1), state(findloc(PRESSURES >= SHOWN, .true., 1)))
    call write_outside(model, state(findloc(PRESSURES >= SHOWN, .true., 1)))
    call write_bodies(model, state(findloc(PRESSURES >= SHOWN, .true., 1)))
  end subroutine load

  !> Equilibrium of the bolt and of the upper flange, and what a lever can do at most: the rim as its fulcrum, the
  !> thrust in the middle of the wall.
  subroutine check_forces(sizes, state, known)
    type(flange_sizes), intent(in) :: sizes
    type(flange_state), intent(in) :: state
    type(verdict), intent(inout) :: known

    call known%hold(abs(state%head - state%nut) <= 1.0e-10_dp*state%head, 'the equilibrium of the bolt')
    call known%hold(abs(state%head - state%joint - state%thrust) <= 1.0e-10_dp*state%head, &
                    'the equilibrium of the upper flange')
    if (state%thrust*(sizes%rim - 0.5_dp*(sizes%bore + sizes%tube))/(sizes%rim - sizes%bolt_circle) < state%head &
        .and. state%touching < 0.1_dp) error stop 'the bolt carries more than the rim as a fulcrum explains'
  end subroutine check_forces

  !> The force of the bolt by the compliances of bolt and flanges.
  subroutine compare_with_formula(sizes, state, known)
    type(flange_sizes), intent(in) :: sizes
    type(flange_state), intent(in) :: state
    type(verdict), intent(inout) :: known
    real(dp) :: cone, bolt_compliance, flange_compliance, force, grip, head, hole, width

    grip = 2.0_dp*sizes%height
    head = 2.0_dp*sizes%head
    hole = 2.0_dp*sizes%hole
    bolt_compliance = (grip + 1.8_dp*sizes%bolt)/(YOUNG*PI*sizes%bolt**2)
    ! The width that the cones may take: the rim is the nearest end of the flange.
    width = 2.0_dp*(sizes%rim - sizes%bolt_circle)
    cone = 0.362_dp + 0.032_dp*log(0.5_dp*grip/head) + 0.153_dp*log(width/head)
    flange_compliance = 2.0_dp*log((head + hole)*(head + grip*cone - hole)/((head - hole)*(head + grip*cone + hole))) &
                        /(YOUNG*PI*hole*cone)
    force = SHORTENING/(bolt_compliance + flange_compliance)
    print '(/,a,f6.2,a,f6.2,a)', 'Tightened: ', 1.0e-3_dp*state%head, ' kN, by the formulas for bolted joints ', &
      1.0e-3_dp*force, ' kN'
    call known%compare(state%head/force - 1.0_dp, 0.1_dp, 'the force of the tightened bolt')
  end subroutine compare_with_formula

  !> The mean of the gaps at the bore, beside the bolt and between two of them.
  pure function bore_gap(model, state) result(gap)
    type(flange_joint), intent(in) :: model
    type(flange_state), intent(in) :: state
    real(dp) :: gap

    associate (pairs => model%joined%pairs)
      associate (at_bore => pairs%pair == JOINT .and. &
                 norm2(model%mesh(UPPER)%node(:2, joint_nodes(model)), 1) < model%sizes%bore*(1.0_dp + 1.0e-9_dp))
        gap = sum(state%solution%gap, mask=at_bore)/real(count(at_bore), dp)
      end associate
    end associate
  end function bore_gap

  !> Nodes of the upper flange; for points of other pairs the first node, which stands for none.
  pure function joint_nodes(model) result(node)
    type(flange_joint), intent(in) :: model
    integer :: node(model%joined%pairs%points())

    node = merge(model%joined%pairs%node, 1, model%joined%pairs%pair == JOINT)
  end function joint_nodes

  !> The smallest radius of the points that touch in the plane of this angle.
  pure function inner_radius(model, state, angle) result(radius)
    type(flange_joint), intent(in) :: model
    type(flange_state), intent(in) :: state
    real(dp), intent(in) :: angle
    real(dp) :: radius
    real(dp) :: across
    integer :: i

    radius = huge(radius)
    associate (pairs => model%joined%pairs)
      do i = 1, pairs%points()
        if (pairs%pair(i) /= JOINT .or. .not. state%solution%force(i) > 0.0_dp) cycle
        associate (x => model%mesh(UPPER)%node(:2, pairs%node(i)))
          across = x(2)*cos(angle) - x(1)*sin(angle)
          if (abs(across) < 1.0e-9_dp*model%sizes%bore) radius = min(radius, norm2(x))
        end associate
      end do
    end associate
  end function inner_radius

  !> The bodies with their displacements, for ParaView.
  subroutine write_bodies(model, state)
    type(flange_joint), intent(inout), target :: model
    type(flange_state), intent(in) :: state
    type(fuge_mesh) :: body(3), all
    type(fuge_mesh_field) :: displacement
    type(fuge_info) :: info
    character(len=1024) :: folder
    integer :: k

    do k = 1, 3
      call fuge_make_mesh(model%mesh(k)%node, model%mesh(k)%element, &
                          [merge('C3D20', 'C3D8 ', size(model%mesh(k)%element, 1) == 20)], body(k), info)
      if (info%failed()) error stop 'no mesh for the picture'
    end do
    call fuge_join_meshes(body, all, info)
    if (info%failed()) error stop 'no mesh for the picture'
    displacement%name = 'displacement'
    displacement%value = displacements(model, state)
    call get_command_argument(2, folder)
    if (folder == '') folder = '.'
    call fuge_write_mesh(trim(folder)//'/flange.vtu', all, [displacement], info)
    if (info%failed()) error stop 'the bodies were not written'
  end subroutine write_bodies

end program flange
