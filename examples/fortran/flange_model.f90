!> The model of the example `flange`: meshes, stiffness, supports and contact surfaces of two flanges and a bolt, and
!> its answer to an internal pressure.
module flange_model
  use elastic_elements, only: mesh_stiffness, SOLID
  use example_stiffness, only: bodies_stiffness
  use flange_body, only: add_pressure, turn_stiffness, turn_vectors
  use flange_mesh, only: faces_inside, faces_level, flange_cells, flange_sizes, make_bolt, make_flange, solid_mesh, &
    turn_over
  use fuge, only: dp => fuge_dp, fuge_condense, fuge_condensed, fuge_dense_operator, fuge_elastic_body, fuge_info, &
    fuge_join_bodies, fuge_joined_bodies, fuge_problem, fuge_solution, fuge_solver, fuge_surface_mesh, &
    fuge_surface_pair
  implicit none
  private

  public :: build, displacements, press

  real(dp), parameter :: PI = acos(-1.0_dp)
  !> Steel, N/mm2.
  real(dp), parameter, public :: YOUNG = 2.1e5_dp, POISSON = 0.3_dp
  !> The bodies.
  integer, parameter, public :: UPPER = 1, LOWER = 2, BOLT = 3
  !> The pairs of surfaces: the joint, under the head, under the nut.
  integer, parameter, public :: JOINT = 1, HEAD = 2, NUT = 3

  !> A model with meshes of one fineness, condensed to its contact points.
  type, public :: flange_joint
    type(flange_sizes) :: sizes
    type(solid_mesh) :: mesh(3)
    type(fuge_joined_bodies) :: joined
    type(fuge_condensed) :: condensed
    type(bodies_stiffness) :: stiffness
    !> Faces of the upper flange in the joint.
    integer, allocatable :: joint_face(:, :)
    !> Forces of an internal pressure of 1, as the degrees of freedom are.
    real(dp), allocatable :: unit_load(:)
    !> The force by which this pressure pulls the upper flange upwards, in this model of half a pitch.
    real(dp) :: unit_thrust = 0.0_dp
  end type flange_joint

  !> The joint under an internal pressure.
  type, public :: flange_state
    real(dp) :: pressure = 0.0_dp
    !> Forces for one bolt: of its head, its nut, the joint, and the thrust.
    real(dp) :: head = 0.0_dp, nut = 0.0_dp, joint = 0.0_dp, thrust = 0.0_dp
    !> Share of the joint's area that touches.
    real(dp) :: touching = 0.0_dp
    type(fuge_solution) :: solution
  end type flange_state

contains

  !> Mesh, join and condense the bodies. The shank is shorter than both flanges by `shortening`, as if the nut had been
  !> turned on by that much.
  subroutine build(cells, sizes, shortening, model)
    type(flange_cells), intent(in) :: cells(3)
    type(flange_sizes), intent(in) :: sizes
    real(dp), intent(in) :: shortening
    type(flange_joint), intent(inout) :: model
    type(fuge_elastic_body) :: body(3)
    type(fuge_surface_pair) :: pair(3)
    type(fuge_info) :: info
    real(dp) :: length
    integer :: k

    length = 2.0_dp*sizes%height - shortening
    model%sizes = sizes
    call make_flange(sizes, cells(UPPER), model%mesh(UPPER))
    call make_flange(sizes, cells(LOWER), model%mesh(LOWER))
    call turn_over(model%mesh(LOWER))
    call make_bolt(sizes, cells(BOLT), length, model%mesh(BOLT))
    do k = 1, 3
      call set_body(model%mesh(k), k, sizes, body(k))
    end do
    pair%contact_body = [UPPER, BOLT, BOLT]
    pair%opposite_body = [LOWER, UPPER, LOWER]
    call set_surface(model%mesh(UPPER), 0.0_dp, .false., pair(JOINT)%contact)
    call set_surface(model%mesh(LOWER), 0.0_dp, .true., pair(JOINT)%opposite)
    call set_surface(model%mesh(BOLT), 0.5_dp*length, .false., pair(HEAD)%contact)
    call set_surface(model%mesh(UPPER), sizes%height, .true., pair(HEAD)%opposite)
    call set_surface(model%mesh(BOLT), -0.5_dp*length, .true., pair(NUT)%contact)
    call set_surface(model%mesh(LOWER), -sizes%height, .false., pair(NUT)%opposite)
    model%joint_face = pair(JOINT)%contact%face
    call fuge_join_bodies(body, pair, model%joined, info)
    call stop_if_failed(info)
    call model%stiffness%set_columns(model%joined%column, model%joined%row, model%joined%value, info)
    call stop_if_failed(info)
    call fuge_condense(model%stiffness, model%joined%body, model%condensed, info)
    call stop_if_failed(info)
    call set_unit_load(model)
  end subroutine build

  !> Stiffness and supports of body `number`: both planes of symmetry, and the end of the lower tube.
  subroutine set_body(mesh, number, sizes, body)
    type(solid_mesh), intent(in) :: mesh
    integer, intent(in) :: number
    type(flange_sizes), intent(in) :: sizes
    type(fuge_elastic_body), intent(out) :: body
    logical, dimension(size(mesh%node, 2)) :: held, middle, turned
    integer :: i

    middle = abs(mesh%node(2, :)) < 1.0e-9_dp*sizes%bore
    turned = on_oblique_plane(mesh, sizes)
    held = .false.
    if (number == LOWER) held = mesh%node(3, :) < minval(mesh%node(3, :)) + 1.0e-9_dp*sizes%bore
    call mesh_stiffness(mesh%node, mesh%element, SOLID, YOUNG, POISSON, body%column, body%row, body%value)
    call turn_stiffness(turned, PI/real(sizes%bolts, dp), body%column, body%row, body%value)
    body%fixed = [pack([(3*i - 1, i=1, size(held))], middle .or. turned), pack([(3*i, i=1, size(held))], held)]
  end subroutine set_body

  !> Is a node in the plane between two bolts?
  pure function on_oblique_plane(mesh, sizes) result(oblique)
    type(solid_mesh), intent(in) :: mesh
    type(flange_sizes), intent(in) :: sizes
    logical :: oblique(size(mesh%node, 2))
    real(dp) :: angle

    angle = PI/real(sizes%bolts, dp)
    oblique = abs(cos(angle)*mesh%node(2, :) - sin(angle)*mesh%node(1, :)) < 1.0e-9_dp*sizes%bore
  end function on_oblique_plane

  !> The faces at a height, with the degrees of freedom of the body. Those in the oblique plane are turned about z, and
  !> do not matter to faces across z.
  pure subroutine set_surface(mesh, z, upwards, surface)
    type(solid_mesh), intent(in) :: mesh
    real(dp), intent(in) :: z
    logical, intent(in) :: upwards
    type(fuge_surface_mesh), intent(out) :: surface
    integer :: k

    surface%node = mesh%node
    surface%face = faces_level(mesh, z, upwards)
    allocate (surface%dof, source=reshape([(k, k=1, size(mesh%node))], shape(mesh%node)))
  end subroutine set_surface

  !> Pressure on the bore, and on the lid at the end of the tube, whose thrust the wall of the tube carries. The lower
  !> tube is held at its end.
  subroutine set_unit_load(model)
    type(flange_joint), intent(inout) :: model
    real(dp), allocatable :: force(:, :)
    integer :: k

    if (allocated(model%unit_load)) deallocate (model%unit_load)
    allocate (model%unit_load(model%joined%first(4)))
    model%unit_load = 0.0_dp
    do k = UPPER, LOWER
      allocate (force(3, size(model%mesh(k)%node, 2)))
      force = 0.0_dp
      call add_pressure(model%mesh(k)%node, faces_inside(model%mesh(k), model%sizes%bore), 1.0_dp, force)
      associate (s => model%sizes)
        if (k == UPPER) call add_pressure(model%mesh(k)%node, faces_level(model%mesh(k), s%height + s%tube_height, &
                                                                          .true.), &
                                          -s%bore**2/(s%tube**2 - s%bore**2), force)
      end associate
      if (k == UPPER) model%unit_thrust = sum(force(3, :))
      call turn_vectors(on_oblique_plane(model%mesh(k), model%sizes), PI/real(model%sizes%bolts, dp), force)
      model%unit_load(model%joined%first(k) + 1:model%joined%first(k + 1)) = reshape(force, [size(force)])
      deallocate (force)
    end do
  end subroutine set_unit_load

  !> Put the joint under an internal pressure.
  subroutine press(model, pressure, state)
    type(flange_joint), intent(inout), target :: model
    real(dp), intent(in) :: pressure
    type(flange_state), intent(out) :: state
    type(fuge_dense_operator) :: alpha
    type(fuge_problem) :: problem
    type(fuge_solver) :: solver
    type(fuge_info) :: info

    call model%condensed%set_load(pressure*model%unit_load, info)
    call stop_if_failed(info)
    call model%joined%pose(model%condensed, problem, info)
    call stop_if_failed(info)
    call alpha%set(model%condensed%alpha, info)
    call stop_if_failed(info)
    call solver%solve(alpha, problem, state%solution, info)
    call stop_if_failed(info)
    state%pressure = pressure
    associate (pairs => model%joined%pairs, force => state%solution%force)
      state%head = 2.0_dp*sum(force, mask=pairs%pair == HEAD)
      state%nut = 2.0_dp*sum(force, mask=pairs%pair == NUT)
      state%joint = 2.0_dp*sum(force, mask=pairs%pair == JOINT)
      state%touching = sum(pairs%area, mask=pairs%pair == JOINT .and. force > 0.0_dp) &
                       /sum(pairs%area, mask=pairs%pair == JOINT)
    end associate
    state%thrust = 2.0_dp*pressure*model%unit_thrust
  end subroutine press

  !> Displacements of all nodes along x, y and z, (3, nodes of all bodies) under a pressure.
  function displacements(model, state) result(u)
    type(flange_joint), intent(inout), target :: model
    type(flange_state), intent(in) :: state
    real(dp), allocatable :: u(:, :)
    real(dp), allocatable :: all(:)
    type(flange_state) :: same
    type(fuge_info) :: info
    integer :: first, k

    call press(model, state%pressure, same)
    allocate (all(size(model%unit_load)))
    call model%condensed%recover(same%solution, all, info)
    call stop_if_failed(info)
    u = reshape(all, [3, size(all)/3])
    do k = UPPER, LOWER
      first = model%joined%first(k)/3
      call turn_vectors(on_oblique_plane(model%mesh(k), model%sizes), -PI/real(model%sizes%bolts, dp), &
                        u(:, first + 1:first + size(model%mesh(k)%node, 2)))
    end do
  end function displacements

  subroutine stop_if_failed(info)
    type(fuge_info), intent(in) :: info

    if (info%status == 0) return
    print '(a)', trim(info%message)
    error stop 'the joint was not solved'
  end subroutine stop_if_failed

end module flange_model
