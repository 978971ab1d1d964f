!> Two blocks of different meshes under a uniform pressure, as bodies with their own stiffness matrices: what they are
!> given, and how far their stresses are from uniform.
module pressed_blocks
  use expectations, only: relative_difference
  use fuge_elastic_body_type, only: fuge_elastic_body, fuge_surface_pair
  use fuge_kinds, only: dp
  use fuge_surface_mesh_type, only: fuge_surface_mesh
  use mesh_blocks, only: block_stiffness, block_stress, elastic_block, face_nodes_of, make_block, stress_forces
  implicit none
  private

  public :: linear_field, make_pressed, rotation, scene_stress_error, stress_error, surface_dof, take_block, &
    uniaxial, unturned

  real(dp), parameter, public :: PRESSURE = 0.37_dp
  !> The blocks are 1.3 by 1.1 wide and 0.5 and 0.4 high.
  real(dp), parameter, public :: WIDE(2) = [1.3_dp, 1.1_dp]

  !> Two blocks, and what `fuge_join_bodies` takes: the lower one is body 1, held at its bottom as it would move; the
  !> upper one, body 2, floats under the pressure on its top. The surface of the upper one is the contact surface.
  type, public :: pressed
    type(elastic_block) :: block(2)
    type(fuge_elastic_body) :: body(2)
    type(fuge_surface_pair) :: pair(1)
    !> The uniform stress, in the order of mesh_blocks.
    real(dp), allocatable :: stress(:)
  end type pressed

contains

  !> `length` and `force`: units, in which all numbers are given; `pressure` of the scene: PRESSURE*force/length**2.
  subroutine make_pressed(lower_kind, lower_count, upper_kind, upper_count, skew, turn, length, force, scene)
    integer, intent(in) :: lower_kind, lower_count(:), upper_kind, upper_count(:)
    real(dp), intent(in) :: skew, turn(:, :), length, force
    type(pressed), intent(out) :: scene
    real(dp), allocatable :: forces(:)
    integer :: d, k

    d = size(turn, 1)
    call make_block(lower_kind, [lower_count, 1], length*[0.0_dp*WIDE(:d - 1), -0.5_dp], &
                    length*[WIDE(:d - 1), 0.0_dp], skew, turn, 0, scene%block(1))
    call make_block(upper_kind, [upper_count, 1], length*[0.0_dp*WIDE(:d - 1), 0.0_dp], length*[WIDE(:d - 1), 0.4_dp], &
                    skew, turn, 0, scene%block(2))
    scene%block%young = [1.0_dp, 2.5_dp]*unit_of_stress(d, length, force)
    scene%block%poisson = [0.3_dp, 0.2_dp]
    scene%stress = uniaxial(turn, PRESSURE*unit_of_stress(d, length, force))
    do k = 1, 2
      call take_block(scene%block(k), scene%body(k))
    end do
    scene%body(1)%fixed = surface_dof(scene%block(1)%bottom)
    scene%body(1)%displacement = linear_field(scene%block(1), scene%stress, scene%body(1)%fixed)
    call stress_forces(scene%block(2), scene%stress, forces)
    allocate (scene%body(2)%load(size(forces)))
    scene%body(2)%load = 0.0_dp
    associate (loaded => surface_dof(scene%block(2)%top))
      scene%body(2)%load(loaded) = forces(loaded)
    end associate
    scene%pair(1)%contact_body = 2
    scene%pair(1)%opposite_body = 1
    scene%pair(1)%contact = scene%block(2)%bottom
    scene%pair(1)%opposite = scene%block(1)%top
  end subroutine make_pressed

  !> Force per area; per length in the plane, where forces are per depth.
  pure function unit_of_stress(dimensions, length, force) result(stress)
    integer, intent(in) :: dimensions
    real(dp), intent(in) :: length, force
    real(dp) :: stress

    stress = force/length**(dimensions - 1)
  end function unit_of_stress

  !> The stiffness of a block as compressed columns with both triangles.
  subroutine take_block(block, body)
    type(elastic_block), intent(in) :: block
    type(fuge_elastic_body), intent(inout) :: body
    real(dp), allocatable :: stiffness(:, :)
    integer :: i, j, n

    n = size(block%x)
    allocate (stiffness(n, n))
    stiffness = 0.0_dp
    call block_stiffness(block, 0, stiffness)
    allocate (body%column(n + 1))
    body%column(1) = 1
    do j = 1, n
      body%column(j + 1) = body%column(j) + count(abs(stiffness(:, j)) > 0.0_dp)
    end do
    body%row = pack(spread([(i, i=1, n)], 2, n), abs(stiffness) > 0.0_dp)
    body%value = pack(stiffness, abs(stiffness) > 0.0_dp)
  end subroutine take_block

  !> The stress -p n n of the turned last axis n, in the order of mesh_blocks.
  function uniaxial(turn, pressure) result(stress)
    real(dp), intent(in) :: turn(:, :), pressure
    real(dp), allocatable :: stress(:)

    associate (n => turn(:, size(turn, 1)))
      if (size(n) == 2) then
        stress = -pressure*[n(1)**2, n(2)**2, n(1)*n(2)]
      else
        stress = -pressure*[n(1)**2, n(2)**2, n(3)**2, n(2)*n(3), n(1)*n(3), n(1)*n(2)]
      end if
    end associate
  end function uniaxial

  !> Displacements of some degrees of freedom under a uniform stress.
  function linear_field(block, stress, dof) result(u)
    type(elastic_block), intent(in) :: block
    real(dp), intent(in) :: stress(:)
    integer, intent(in) :: dof(:)
    real(dp) :: u(size(dof))
    real(dp), allocatable :: gradient(:, :), field(:, :)
    real(dp) :: trace
    integer :: d, k

    d = size(block%x, 1)
    allocate (gradient(d, d))
    if (d == 2) then
      gradient = reshape([stress(1), stress(3), stress(3), stress(2)], [2, 2])
      trace = (1 + block%poisson)*(stress(1) + stress(2))
    else
      gradient = reshape([stress(1), stress(6), stress(5), stress(6), stress(2), stress(4), stress(5), stress(4), &
                          stress(3)], [3, 3])
      trace = sum(stress(:3))
    end if
    gradient = (1 + block%poisson)/block%young*gradient
    do k = 1, d
      gradient(k, k) = gradient(k, k) - block%poisson/block%young*trace
    end do
    field = matmul(gradient, block%x)
    do k = 1, size(dof)
      u(k) = field(modulo(dof(k) - 1, d) + 1, (dof(k) - 1)/d + 1)
    end do
  end function linear_field

  !> Degrees of freedom of the nodes of a surface.
  function surface_dof(surface) result(dof)
    type(fuge_surface_mesh), intent(in) :: surface
    integer, allocatable :: dof(:)
    integer, allocatable :: nodes(:)

    allocate (nodes, source=face_nodes_of(surface))
    dof = reshape(surface%dof(:, nodes), [size(surface%dof, 1)*size(nodes)])
  end function surface_dof

  !> The larger error of the stresses in both blocks; `u` has the displacements of the lower one first.
  function scene_stress_error(scene, u) result(error)
    type(pressed), intent(in) :: scene
    real(dp), intent(in) :: u(:)
    real(dp) :: error
    integer :: first

    first = size(scene%block(1)%x)
    error = max(stress_error(scene%block(1), u(:first), scene%stress), &
                stress_error(scene%block(2), u(first + 1:), scene%stress))
  end function scene_stress_error

  !> Largest difference of the stresses from the uniform one, relative to its largest component.
  function stress_error(block, u, stress) result(error)
    type(elastic_block), intent(in) :: block
    real(dp), intent(in) :: u(:), stress(:)
    real(dp) :: error
    real(dp), allocatable :: found(:, :)
    integer :: k

    call block_stress(block, u, found)
    error = 0.0_dp
    do k = 1, size(found, 2)
      error = max(error, relative_difference(found(:, k), stress))
    end do
  end function stress_error

  function unturned(dimensions) result(turn)
    integer, intent(in) :: dimensions
    real(dp) :: turn(dimensions, dimensions)
    integer :: k

    turn = 0.0_dp
    do k = 1, dimensions
      turn(k, k) = 1.0_dp
    end do
  end function unturned

  function rotation(dimensions) result(turn)
    integer, intent(in) :: dimensions
    real(dp) :: turn(dimensions, dimensions), about(3, 3)
    real(dp), parameter :: A = 0.7_dp, B = -1.1_dp

    about = reshape([cos(A), sin(A), 0.0_dp, -sin(A), cos(A), 0.0_dp, 0.0_dp, 0.0_dp, 1.0_dp], [3, 3])
    if (dimensions == 3) about = matmul(about, reshape([1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, cos(B), sin(B), &
                                                        0.0_dp, -sin(B), cos(B)], [3, 3]))
    turn = about(:dimensions, :dimensions)
  end function rotation

end module pressed_blocks
