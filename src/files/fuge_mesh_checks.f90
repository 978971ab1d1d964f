!> Checks of a mesh that may be filled by hand.
module fuge_mesh_checks
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_mesh_type, only: fuge_mesh
  use fuge_number_text, only: index_text, text
  use fuge_status, only: composed_message, fuge_info, report, FUGE_ERR_NOT_FINITE, FUGE_ERR_SIZE
  implicit none
  private

  public :: check_mesh, element_name

contains

  !> Refuse arrays that make no mesh (FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE).
  pure subroutine check_mesh(mesh, info)
    type(fuge_mesh), intent(in) :: mesh
    type(fuge_info), intent(inout) :: info

    if (.not. (allocated(mesh%position) .and. allocated(mesh%element_type) .and. allocated(mesh%first) &
               .and. allocated(mesh%connection))) then
      call report(info, FUGE_ERR_SIZE, 'the mesh is empty: position, element_type, first and connection are needed')
    else if (size(mesh%position, 1) /= 3) then
      call report(info, FUGE_ERR_SIZE, 'position of the mesh has '//text(size(mesh%position, 1))//' rows: each node ' &
                  //'needs 3 coordinates, in a plane the third is 0')
    else if (size(mesh%position, 2) < 1) then
      call report(info, FUGE_ERR_SIZE, 'the mesh has no nodes')
    else if (size(mesh%first) /= size(mesh%element_type) + 1) then
      call report(info, FUGE_ERR_SIZE, 'first of the mesh has '//text(size(mesh%first))//' elements, element_type ' &
                  //text(size(mesh%element_type))//': first needs one more')
    end if
    if (.not. info%failed()) call check_positions(mesh%position, info)
    if (.not. info%failed()) call check_connection(mesh, info)
  end subroutine check_mesh

  !> Refuse NaN and infinity in positions (FUGE_ERR_NOT_FINITE).
  pure subroutine check_positions(position, info)
    real(dp), intent(in) :: position(:, :)
    type(fuge_info), intent(inout) :: info
    type(fuge_info) :: found
    integer :: k

    do k = 1, size(position, 2)
      call check_finite(position(:, k), 'position', found)
      if (.not. found%failed()) cycle
      call report(info, FUGE_ERR_NOT_FINITE, 'node '//index_text(k)//': '//composed_message(found))
      return
    end do
  end subroutine check_positions

  !> Refuse elements whose nodes do not exist (FUGE_ERR_SIZE).
  pure subroutine check_connection(mesh, info)
    type(fuge_mesh), intent(in) :: mesh
    type(fuge_info), intent(inout) :: info
    integer :: e, k

    if (mesh%first(1) /= 1 .or. mesh%first(size(mesh%first)) /= size(mesh%connection) + 1) then
      call report(info, FUGE_ERR_SIZE, 'first of the mesh goes from '//text(mesh%first(1))//' to ' &
                  //text(mesh%first(size(mesh%first)))//': it has to go from 1 to ' &
                  //text(size(mesh%connection) + 1)//', one more than the size of connection')
      return
    end if
    do e = 1, size(mesh%element_type)
      if (mesh%first(e + 1) < mesh%first(e) .or. mesh%first(e + 1) > size(mesh%connection) + 1) then
        call report(info, FUGE_ERR_SIZE, trim(element_name(mesh, e))//' begins at '//text(mesh%first(e)) &
                    //' of connection, the next one at '//text(mesh%first(e + 1)))
        return
      end if
      do k = mesh%first(e), mesh%first(e + 1) - 1
        if (mesh%connection(k) >= 1 .and. mesh%connection(k) <= size(mesh%position, 2)) cycle
        call report(info, FUGE_ERR_SIZE, trim(element_name(mesh, e))//' names node '//index_text(mesh%connection(k)) &
                    //': there are '//text(size(mesh%position, 2)))
        return
      end do
    end do
  end subroutine check_connection

  !> An element for a message: its number in the file, or, without one, its index.
  pure function element_name(mesh, e) result(name)
    type(fuge_mesh), intent(in) :: mesh
    integer, intent(in) :: e
    character(len=40) :: name

    name = 'element '//index_text(e)
    if (allocated(mesh%element)) then
      if (e > size(mesh%element)) return
      if (mesh%element(e) > 0) name = 'element '//text(mesh%element(e))
    end if
  end function element_name

end module fuge_mesh_checks
