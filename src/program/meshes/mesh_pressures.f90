!> Pressures on surfaces of meshes as loads at their nodes.
module mesh_pressures
  use command_line, only: refuse, setting
  use face_pressures, only: add_face_forces
  use fuge_core, only: dp => fuge_dp, fuge_info
  use fuge_files, only: fuge_mesh_faces
  use mesh_body, only: model_body
  use mesh_names, only: find_surface
  use number_words, only: read_real
  implicit none
  private

  public :: take_pressure

contains

  !> SURFACE=P: the forces of a uniform pressure, which pushes into the body where P is positive. A force along a
  !> direction that the stiffness lacks goes into the support that has removed it.
  subroutine take_pressure(option, bodies, info)
    type(setting), intent(in) :: option
    type(model_body), intent(inout) :: bodies(:)
    type(fuge_info), intent(inout) :: info
    real(dp) :: pressure
    integer :: body, equals, surface
    logical :: valid

    equals = index(option%value, '=', back=.true.)
    valid = equals > 1
    if (valid) call read_real(option%value(equals + 1:), pressure, valid)
    if (.not. valid) then
      call refuse(option%source//': a surface and a pressure are needed, like hub.TOP=2.5', info)
      return
    end if
    call find_surface(option%value(:equals - 1), option%source, bodies, body, surface, info)
    if (info%failed()) return
    if (bodies(body)%elastic == 0) then
      call refuse(option%source//': body '//bodies(body)%name//' has no --stiffness: it is rigid and stands still', &
                  info)
    else
      call add_pressure(pressure, surface, bodies(body), option%source, info)
    end if
  end subroutine take_pressure

  subroutine add_pressure(pressure, surface, body, source, info)
    real(dp), intent(in) :: pressure
    integer, intent(in) :: surface
    type(model_body), intent(inout) :: body
    character(len=*), intent(in) :: source
    type(fuge_info), intent(inout) :: info
    integer, allocatable :: faces(:, :)
    real(dp) :: force(3, 8)
    integer :: axis, d, f, found, k, nodes, row

    associate (mesh => body%mesh)
      call fuge_mesh_faces(mesh, trim(mesh%surface(surface)%name), faces, info)
      if (info%failed()) return
      found = 0
      do f = 1, size(faces, 2)
        nodes = count(faces(:, f) > 0)
        associate (element_type => mesh%element_type(mesh%surface(surface)%element(f)), node => faces(:nodes, f))
          d = merge(3, 2, index(element_type, 'C3D') == 1)
          force = 0.0_dp
          call add_face_forces(mesh%position(:d, node), index(element_type, 'CAX') == 1, force(:d, :nodes))
          do k = 1, nodes
            do axis = 1, d
              row = body%row(axis, node(k))
              if (row == 0) cycle
              found = found + 1
              body%matrix%load(row) = body%matrix%load(row) + pressure*force(axis, k)
            end do
          end do
        end associate
      end do
    end associate
    if (found == 0) call refuse(source//': no node there has a row in the stiffness', info)
  end subroutine add_pressure

end module mesh_pressures
