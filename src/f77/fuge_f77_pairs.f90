!> Surfaces and contact pairs from and to plain arrays, for FUGECP and FUGECX.
module fuge_f77_pairs
  use fuge_contact_pairs_search, only: fuge_find_pairs
  use fuge_contact_pairs_type, only: fuge_contact_pairs, fuge_pair_options
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_ERR_MEMORY, FUGE_ERR_OPTION, FUGE_ERR_SIZE
  use fuge_surface_mesh_type, only: fuge_surface_mesh
  implicit none
  private

  public :: find_contact_points

  !> Kinds of contact: NKIND of FUGECP.
  integer, parameter :: ONE_SIDED = 1, WITH_PLAY = 2, TIED = 3

contains

  !> FUGECX, whose arguments these are, and FUGECP with the angle and the bodies of its own.
  subroutine find_contact_points(ndim, nn, x, np, nf, iface, id, nno, xo, npo, nfo, ifaceo, ido, method, norm, nsmth, &
                                 nkind, d, reach, crease, revolution, maxn, nw, n, nwmin, idof, dn, gap, nstop, play, &
                                 area, node, nopp, info)
    integer, intent(in) :: ndim, nn, np, nf, nno, npo, nfo, method, norm, nsmth, nkind, maxn, nw
    integer, intent(in) :: iface(np, nf), id(ndim, nn), ifaceo(npo, nfo), ido(ndim, nno)
    real(dp), intent(in) :: x(ndim, nn), xo(ndim, nno), d, reach, crease
    logical, intent(in) :: revolution
    integer, intent(inout) :: n, nwmin, idof(nw, maxn), nstop(maxn), node(maxn), nopp(maxn)
    real(dp), intent(inout) :: dn(nw, maxn), gap(maxn), play(maxn), area(maxn)
    type(fuge_info), intent(out) :: info
    type(fuge_surface_mesh) :: contact, opposite
    type(fuge_pair_options) :: options
    type(fuge_contact_pairs) :: pairs

    call check_surface_sizes(ndim, nn, np, nf, '', info)
    call check_surface_sizes(ndim, nno, npo, nfo, 'O', info)
    call set_pair_options(method, norm, nsmth, nkind, d, reach, options, info)
    options%crease = crease
    options%revolution = revolution
    call set_surface(x, iface, id, contact, info)
    call set_surface(xo, ifaceo, ido, opposite, info)
    if (.not. info%failed()) call fuge_find_pairs(contact, opposite, options, pairs, info)
    ! Without room the caller asks for the sizes only.
    if (maxn /= 0) call check_pair_room(pairs, maxn, nw, info)
    if (info%failed()) return
    n = pairs%points()
    nwmin = size(pairs%dof, 1)
    if (maxn /= 0) call copy_pairs(pairs, idof, dn, gap, nstop, play, area, node, nopp)
  end subroutine find_contact_points

  !> Refuse sizes of a surface that no arrays have (FUGE_ERR_SIZE); `name` is '' or 'O', the end of their names.
  pure subroutine check_surface_sizes(ndim, nodes, most, faces, name, info)
    integer, intent(in) :: ndim, nodes, most, faces
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info

    if (info%failed()) return
    if (ndim < 2 .or. ndim > 3) then
      call report(info, FUGE_ERR_SIZE, 'NDIM = '//text(ndim)//': surfaces are in the plane, 2, or in space, 3')
    else if (nodes < 1 .or. most < 1 .or. faces < 1) then
      call report(info, FUGE_ERR_SIZE, 'NN'//name//' = '//text(nodes)//', NP'//name//' = '//text(most)//', NF'//name &
                  //' = '//text(faces)//': a surface needs nodes, and faces with nodes')
    end if
  end subroutine check_surface_sizes

  !> Copy a surface, unless an error is known already. Error: FUGE_ERR_MEMORY.
  pure subroutine set_surface(position, face, dof, surface, info)
    real(dp), intent(in) :: position(:, :)
    integer, intent(in) :: face(:, :), dof(:, :)
    type(fuge_surface_mesh), intent(inout) :: surface
    type(fuge_info), intent(inout) :: info
    integer :: stat

    if (info%failed()) return
    allocate (surface%node(size(position, 1), size(position, 2)), surface%face(size(face, 1), size(face, 2)), &
              surface%dof(size(dof, 1), size(dof, 2)), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for a copy of the surfaces')
      return
    end if
    surface%node = position
    surface%face = face
    surface%dof = dof
  end subroutine set_surface

  !> Options from numbers, unless an error is known already. `fuge_find_pairs` refuses other methods and normals; here
  !> are refused normals that are given, and kinds of contact that do not exist (FUGE_ERR_OPTION).
  pure subroutine set_pair_options(method, normals, smooth, kind, play, reach, options, info)
    integer, intent(in) :: method, normals, smooth, kind
    real(dp), intent(in) :: play, reach
    type(fuge_pair_options), intent(inout) :: options
    type(fuge_info), intent(inout) :: info

    if (info%failed()) return
    if (normals < 0 .or. normals > 1) then
      call report(info, FUGE_ERR_OPTION, 'NORM = '//text(normals)//' is not 0, averaged at the nodes, or 1, of the ' &
                  //'opposite faces')
    else if (kind < ONE_SIDED .or. kind > TIED) then
      call report(info, FUGE_ERR_OPTION, 'NKIND = '//text(kind)//' is not 1, one-sided, 2, with play, or 3, tied')
    end if
    options%method = method
    options%normals = normals
    options%smooth = smooth /= 0
    options%tied = kind == TIED
    if (kind == WITH_PLAY) options%play = play
    options%reach = reach
  end subroutine set_pair_options

  !> Refuse arrays that are too small for the contact points (FUGE_ERR_SIZE), unless an error is known already.
  pure subroutine check_pair_room(pairs, columns, rows, info)
    type(fuge_contact_pairs), intent(in) :: pairs
    integer, intent(in) :: columns, rows
    type(fuge_info), intent(inout) :: info

    if (info%failed()) return
    if (rows < size(pairs%dof, 1)) then
      call report(info, FUGE_ERR_SIZE, 'NW = '//text(rows)//': a contact point has up to '//text(size(pairs%dof, 1)) &
                  //' degrees of freedom, so pass arrays with NW = '//text(size(pairs%dof, 1))//' or more')
    else if (columns < pairs%points()) then
      call report(info, FUGE_ERR_SIZE, 'MAXN = '//text(columns)//': there are '//text(pairs%points()) &
                  //' contact points, so pass arrays with room for them')
    end if
  end subroutine check_pair_room

  !> Copy the contact points to the first columns and elements of the caller's arrays, which have room for them.
  pure subroutine copy_pairs(pairs, dof, normal, gap, stops, play, area, node, face)
    type(fuge_contact_pairs), intent(in) :: pairs
    integer, intent(inout) :: dof(:, :), stops(:), node(:), face(:)
    real(dp), intent(inout) :: normal(:, :), gap(:), play(:), area(:)
    integer :: n

    n = pairs%points()
    call copy_points(pairs, dof, normal)
    call copy_stops(pairs, stops, play)
    gap(:n) = pairs%gap
    area(:n) = pairs%area
    node(:n) = pairs%node
    face(:n) = pairs%face
  end subroutine copy_pairs

  !> Copy degrees of freedom and factors to the first columns of `dof` and `normal`, 0 in rows beyond.
  pure subroutine copy_points(pairs, dof, normal)
    type(fuge_contact_pairs), intent(in) :: pairs
    integer, intent(inout) :: dof(:, :)
    real(dp), intent(inout) :: normal(:, :)
    integer :: n, width

    n = pairs%points()
    width = size(pairs%dof, 1)
    dof(:, :n) = 0
    normal(:, :n) = 0.0_dp
    dof(:width, :n) = pairs%dof
    normal(:width, :n) = pairs%normal
  end subroutine copy_points

  !> Stops and plays of the contact points as FUGEGV takes them; the play of a point with one stop is 0.
  pure subroutine copy_stops(pairs, stops, play)
    type(fuge_contact_pairs), intent(in) :: pairs
    integer, intent(inout) :: stops(:)
    real(dp), intent(inout) :: play(:)
    integer :: i

    do i = 1, pairs%points()
      stops(i) = merge(2, 1, pairs%gap_upper(i) <= huge(1.0_dp))
      play(i) = 0.0_dp
      if (stops(i) == 2) play(i) = pairs%gap_upper(i)
    end do
  end subroutine copy_stops

end module fuge_f77_pairs
