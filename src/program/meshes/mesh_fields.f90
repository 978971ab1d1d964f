!> Displacements of bodies with meshes: a table, or a file for ParaView.
module mesh_fields
  use fuge_core, only: dp => fuge_dp, fuge_info, fuge_solution
  use fuge_fe, only: fuge_joined_bodies
  use fuge_files, only: fuge_join_meshes, fuge_mesh, fuge_mesh_field, fuge_write_mesh
  use mesh_body, only: model_body
  use mesh_names, only: upper_case
  use mesh_pairs, only: mesh_node, model_pair
  use number_words, only: number_text
  use text_table, only: table
  implicit none
  private

  public :: check_fields, write_fields

  !> A file that takes all and keeps nothing; other systems have none.
  character(len=*), parameter :: NOWHERE = '/dev/null'

contains

  !> A .vtu file, or else a table of all degrees of freedom. A warning in `info` stays.
  subroutine write_fields(path, bodies, pairs, joined, solution, displacement, info)
    character(len=*), intent(in) :: path
    type(model_body), intent(in) :: bodies(:)
    type(model_pair), intent(in) :: pairs(:)
    type(fuge_joined_bodies), intent(in) :: joined
    type(fuge_solution), intent(in) :: solution
    real(dp), intent(in) :: displacement(:)
    type(fuge_info), intent(inout) :: info
    type(fuge_info) :: writing
    type(fuge_mesh) :: mesh
    type(fuge_mesh_field) :: fields(4)

    if (.not. is_mesh_file(path)) then
      call write_displacements(path, bodies, joined, displacement, info)
      return
    end if
    call fill_fields(bodies, pairs, joined, solution, displacement, fields)
    call join(bodies, mesh, writing)
    if (.not. writing%failed()) call fuge_write_mesh(path, mesh, fields, writing)
    if (writing%failed()) info = writing
  end subroutine write_fields

  !> Refuse, before all is computed, meshes that `write_fields` could not write.
  subroutine check_fields(path, bodies, info)
    character(len=*), intent(in) :: path
    type(model_body), intent(in) :: bodies(:)
    type(fuge_info), intent(inout) :: info
    type(fuge_mesh) :: mesh
    type(fuge_mesh_field) :: fields(0)
    logical :: exists

    inquire (file=NOWHERE, exist=exists)
    if (.not. (is_mesh_file(path) .and. exists)) return
    call join(bodies, mesh, info)
    if (.not. info%failed()) call fuge_write_mesh(NOWHERE, mesh, fields, info)
    if (info%failed()) info%message = '--field '//path//': '//info%message
  end subroutine check_fields

  !> Is it the name of a file for ParaView?
  pure function is_mesh_file(path)
    character(len=*), intent(in) :: path
    logical :: is_mesh_file
    integer :: point

    point = index(path, '.', back=.true.)
    is_mesh_file = point > 0
    if (is_mesh_file) is_mesh_file = upper_case(path(point:)) == '.VTU'
  end function is_mesh_file

  !> The meshes of all bodies as one.
  subroutine join(bodies, mesh, info)
    type(model_body), intent(in) :: bodies(:)
    type(fuge_mesh), intent(inout) :: mesh
    type(fuge_info), intent(out) :: info
    type(fuge_mesh), allocatable :: meshes(:)
    integer :: k

    allocate (meshes(size(bodies)))
    do k = 1, size(bodies)
      meshes(k) = bodies(k)%mesh
    end do
    call fuge_join_meshes(meshes, mesh, info)
  end subroutine join

  !> Displacements, pressures and forces of the contact points, and the number of the body, at the nodes of all bodies.
  subroutine fill_fields(bodies, pairs, joined, solution, displacement, fields)
    type(model_body), intent(in) :: bodies(:)
    type(model_pair), intent(in) :: pairs(:)
    type(fuge_joined_bodies), intent(in) :: joined
    type(fuge_solution), intent(in) :: solution
    real(dp), intent(in) :: displacement(:)
    type(fuge_mesh_field), intent(inout) :: fields(4)
    integer :: first(size(bodies) + 1)
    integer :: axis, i, k, node, row

    first(1) = 0
    do k = 1, size(bodies)
      first(k + 1) = first(k) + size(bodies(k)%mesh%node)
    end do
    fields%name = [character(len=13) :: 'displacement', 'pressure', 'contact_force', 'body']
    do k = 1, size(fields)
      allocate (fields(k)%value(merge(1, 3, k == 2 .or. k == 4), first(size(first))), source=0.0_dp)
    end do
    do k = 1, size(bodies)
      fields(4)%value(1, first(k) + 1:first(k + 1)) = real(k, dp)
      if (bodies(k)%elastic == 0) cycle
      do node = 1, size(bodies(k)%mesh%node)
        do axis = 1, 3
          row = bodies(k)%row(axis, node)
          if (row > 0) fields(1)%value(axis, first(k) + node) = displacement(joined%first(bodies(k)%elastic) + row)
        end do
      end do
    end do
    do i = 1, joined%pairs%points()
      k = pairs(joined%pairs%pair(i))%body(1)
      node = first(k) + mesh_node(bodies(k), joined%pairs%node(i))
      fields(3)%value(:, node) = fields(3)%value(:, node) &
        + solution%force(i)*pairs(joined%pairs%pair(i))%action(joined%pairs, i)
      if (pairs(joined%pairs%pair(i))%options%tied) cycle
      fields(2)%value(1, node) = fields(2)%value(1, node) + solution%force(i)/joined%pairs%area(i)
    end do
  end subroutine fill_fields

  !> A line for each degree of freedom.
  subroutine write_displacements(path, bodies, joined, displacement, info)
    character(len=*), intent(in) :: path
    type(model_body), intent(in) :: bodies(:)
    type(fuge_joined_bodies), intent(in) :: joined
    real(dp), intent(in) :: displacement(:)
    type(fuge_info), intent(inout) :: info
    type(table) :: csv
    character(len=26) :: value
    integer :: j, k

    call csv%create(path, info)
    if (info%failed()) return
    call csv%put('body,node,direction,displacement')
    do k = 1, size(bodies)
      do j = 1, bodies(k)%degrees()
        write (value, '(es24.16e3)') displacement(joined%first(bodies(k)%elastic) + j)
        call csv%put(bodies(k)%name//','//number_text(bodies(k)%node_of_row(j))//',' &
                     //number_text(bodies(k)%direction_of_row(j))//','//value)
      end do
    end do
    call csv%finish(info)
  end subroutine write_displacements

end module mesh_fields
