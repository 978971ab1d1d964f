!> The pairs of surfaces of bodies that are joined: their degrees of freedom in the numbers of all bodies.
module fuge_body_surfaces
  use fuge_contact_pairs_search, only: fuge_find_pairs
  use fuge_contact_pairs_type, only: fuge_contact_pairs
  use fuge_elastic_body_type, only: check_pair_numbers, fuge_surface_pair, put_before
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text
  use fuge_status, only: composed_message, fuge_info, report, require_memory, FUGE_DONE
  use fuge_surface_mesh_type, only: fuge_surface_mesh
  implicit none
  private

  public :: greatest_extent, pair_surfaces

contains

  !> Pair all surfaces, in the numbers of all bodies. The first warning stays in `info`.
  subroutine pair_surfaces(surface_pairs, first, pairs, info)
    type(fuge_surface_pair), intent(in) :: surface_pairs(:)
    integer, intent(in) :: first(:)
    type(fuge_contact_pairs), intent(inout) :: pairs
    type(fuge_info), intent(inout) :: info
    type(fuge_info) :: own_info
    type(fuge_surface_mesh) :: contact, opposite
    integer :: k, stat

    do k = 1, size(surface_pairs)
      own_info = fuge_info()
      call check_pair_numbers(surface_pairs(k), first(2:) - first(:size(first) - 1), own_info)
      if (.not. own_info%failed()) then
        call shift(surface_pairs(k)%contact, surface_pairs(k)%contact_body, first, contact, stat)
        if (stat == 0) call shift(surface_pairs(k)%opposite, surface_pairs(k)%opposite_body, first, opposite, stat)
        call require_memory(stat, 'copies of the surfaces', own_info)
        if (stat == 0) call fuge_find_pairs(contact, opposite, surface_pairs(k)%options, pairs, own_info)
      end if
      call put_before('pair '//index_text(k)//', contact '//trim(body_name(surface_pairs(k)%contact_body)) &
                      //', opposite '//trim(body_name(surface_pairs(k)%opposite_body))//': ', own_info)
      if (own_info%failed() .or. info%status == FUGE_DONE) &
        call report(info, own_info%status, composed_message(own_info))
      if (info%failed()) return
    end do
  end subroutine pair_surfaces

  !> A body as messages name it.
  pure function body_name(body) result(name)
    integer, intent(in) :: body
    character(len=20) :: name

    name = 'body '//index_text(body)
    if (body == 0) name = 'rigid'
  end function body_name

  !> A surface of `body` with its degrees of freedom behind those of the bodies before. `stat` as in an allocate
  !> statement.
  pure subroutine shift(surface, body, first, shifted, stat)
    type(fuge_surface_mesh), intent(in) :: surface
    integer, intent(in) :: body, first(:)
    type(fuge_surface_mesh), intent(out) :: shifted
    integer, intent(out) :: stat

    stat = 0
    if (allocated(surface%node)) allocate (shifted%node, source=surface%node, stat=stat)
    if (allocated(surface%face) .and. stat == 0) allocate (shifted%face, source=surface%face, stat=stat)
    if (body == 0 .or. stat /= 0) return
    allocate (shifted%dof, source=surface%dof, stat=stat)
    if (stat /= 0) return
    ! Negative numbers stay what they are, for the checks.
    where (shifted%dof > 0) shifted%dof = shifted%dof + first(body)
  end subroutine shift

  !> The greatest coordinate of the nodes of any of the surfaces, by whose rounding errors gaps are uncertain.
  pure function greatest_extent(surface_pairs) result(extent)
    type(fuge_surface_pair), intent(in) :: surface_pairs(:)
    real(dp) :: extent
    integer :: k

    extent = 0.0_dp
    do k = 1, size(surface_pairs)
      extent = max(extent, farthest(surface_pairs(k)%contact), farthest(surface_pairs(k)%opposite))
    end do
  end function greatest_extent

  !> The greatest coordinate of the nodes of the faces.
  pure function farthest(surface) result(distance)
    type(fuge_surface_mesh), intent(in) :: surface
    real(dp) :: distance
    integer :: f, k

    distance = 0.0_dp
    do f = 1, size(surface%face, 2)
      do k = 1, size(surface%face, 1)
        if (surface%face(k, f) == 0) exit
        distance = max(distance, maxval(abs(surface%node(:, surface%face(k, f)))))
      end do
    end do
  end function farthest

end module fuge_body_surfaces
