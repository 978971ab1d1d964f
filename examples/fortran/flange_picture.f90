!> The tables from which the pictures of the example `flange` are drawn.
module flange_picture
  use example_output, only: create_file
  use flange_mesh, only: faces_outside
  use flange_model, only: displacements, flange_joint, flange_state, BOLT, JOINT, UPPER
  use fuge, only: dp => fuge_dp
  implicit none
  private

  public :: write_map, write_outside

  !> The program's argument that names the folder for the tables.
  integer, parameter :: FOLDER_ARGUMENT = 2

contains

  !> Pressures on the joint, tightened and under load, on three by three points of each face.
  subroutine write_map(model, tightened, loaded)
    type(flange_joint), intent(in) :: model
    type(flange_state), intent(in) :: tightened, loaded
    real(dp) :: at_node(4, size(model%mesh(UPPER)%node, 2))
    integer :: f, file, i, node

    at_node(:2, :) = model%mesh(UPPER)%node(:2, :)
    at_node(3:, :) = 0.0_dp
    associate (pairs => model%joined%pairs)
      do i = 1, pairs%points()
        if (pairs%pair(i) /= JOINT) cycle
        node = pairs%node(i)
        at_node(3:, node) = [tightened%solution%force(i), loaded%solution%force(i)]/pairs%area(i)
      end do
    end associate
    call create_file('flange_map.dat', FOLDER_ARGUMENT, file)
    do f = 1, size(model%joint_face, 2)
      call write_face(file, at_node, model%joint_face(:, f))
    end do
    close (file)
  end subroutine write_map

  !> The outside of the three bodies under load: x, y, z and their displacements on three by three points of each face.
  !> The faces that remain outside if the half pitch is completed to a ring, and in a file of their own those in the
  !> plane y = 0, through the bolt.
  subroutine write_outside(model, state)
    type(flange_joint), intent(inout), target :: model
    type(flange_state), intent(in) :: state
    real(dp), allocatable :: u(:, :)
    integer :: body, file, part

    allocate (u, source=displacements(model, state))
    do part = 1, 2
      if (part == 1) call create_file('flange_outside.dat', FOLDER_ARGUMENT, file)
      if (part == 2) call create_file('flange_cut.dat', FOLDER_ARGUMENT, file)
      do body = 1, 3
        call write_body(file, model, body, u, part == 2)
      end do
      close (file)
    end do
  end subroutine write_outside

  subroutine write_body(file, model, body, u, in_plane)
    integer, intent(in) :: file, body
    type(flange_joint), intent(in) :: model
    real(dp), intent(in) :: u(:, :)
    logical, intent(in) :: in_plane
    integer, allocatable :: face(:, :)
    real(dp), allocatable :: at_node(:, :)
    real(dp) :: normal(2), small
    logical :: cut, oblique
    integer :: f, first, n

    first = model%joined%first(body)/3
    n = size(model%mesh(body)%node, 2)
    allocate (at_node(6, n))
    at_node(:3, :) = model%mesh(body)%node
    at_node(4:, :) = u(:, first + 1:first + n)
    if (body == BOLT) call fit_shank(model, at_node)
    ! Across the plane in the middle between two bolts.
    normal = [-sin(acos(-1.0_dp)/model%sizes%bolts), cos(acos(-1.0_dp)/model%sizes%bolts)]
    small = 1.0e-9_dp*model%sizes%bore
    face = faces_outside(model%mesh(body))
    do f = 1, size(face, 2)
      associate (corner => at_node(:2, face(:4, f)))
        cut = all(abs(corner(2, :)) < small)
        oblique = all(abs(matmul(normal, corner)) < small)
      end associate
      if ((cut .eqv. in_plane) .and. .not. oblique) call write_face(file, at_node, face(:, f))
    end do
  end subroutine write_body

  !> Displacements of the bolt from where it fits the flanges, not from where its shorter shank overlaps them: enlarged,
  !> the overlap would be a gap.
  pure subroutine fit_shank(model, at_node)
    type(flange_joint), intent(in) :: model
    real(dp), intent(inout) :: at_node(:, :)
    real(dp) :: half, shift(size(at_node, 2))

    half = maxval(at_node(3, :)) - model%sizes%head_height
    shift = (model%sizes%height - half)*max(-1.0_dp, min(1.0_dp, at_node(3, :)/half))
    at_node(3, :) = at_node(3, :) + shift
    at_node(6, :) = at_node(6, :) - shift
  end subroutine fit_shank

  !> A face of 4 or 8 nodes as 3 x 3 points, a line for each, with the values at its nodes.
  subroutine write_face(file, at_node, face)
    integer, intent(in) :: file
    real(dp), intent(in) :: at_node(:, :)
    integer, intent(in) :: face(:)
    real(dp) :: value(size(at_node, 1), 9)
    integer :: k

    value(:, [1, 3, 9, 7]) = at_node(:, face(:4))
    if (size(face) == 8) then
      value(:, [2, 6, 8, 4]) = at_node(:, face(5:))
    else
      value(:, [2, 6, 8, 4]) = 0.5_dp*(value(:, [1, 3, 9, 7]) + value(:, [3, 9, 7, 1]))
    end if
    value(:, 5) = 0.25_dp*sum(value(:, [2, 6, 8, 4]), 2)
    do k = 1, 9
      write (file, '(*(es14.6))') value(:, k)
      if (modulo(k, 3) == 0) write (file, '()')
    end do
    write (file, '()')
  end subroutine write_face

end module flange_picture
