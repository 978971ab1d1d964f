!> Errors of the gaps between smooth bodies that are given by meshes: an ellipse in a curve 0.001 outside, whose meshes
!> do not match, and a press fit of cylinders in space by sheared and uneven faces.
!>
!> Prints n, nodes around the ellipse, | the largest error of the gap: linear edges as they are | smooth | quadratic
!> edges as they are | smooth; the same for how far a rotation of both bodies by 1 about the middle of the ellipse opens
!> a contact point, which is the moment of its forces over the force; then kind of faces | error of the mean gap | of
!> the worst one, over the interference.
program smooth_gaps
  use fuge, only: dp => fuge_dp, fuge_contact_pairs, fuge_find_pairs, fuge_info, fuge_pair_options, fuge_surface_mesh
  implicit none

  real(dp), parameter :: PI = acos(-1.0_dp)
  !> Distance of the outer curve from the ellipse of semi-axes 1.5 and 1; radius and interference of the press fit.
  real(dp), parameter :: GAP = 1.0e-3_dp, RADIUS = 20.0_dp, INTERFERENCE = 0.0025_dp

  call print_ellipse(.false.)
  call print_ellipse(.true.)
  call print_cylinders()

contains

  subroutine print_ellipse(turned)
    logical, intent(in) :: turned
    real(dp) :: error(4)
    integer :: k, n

    print '(a)', trim(merge('opened by a rotation', 'error of the gap    ', turned))
    print '(a)', 'n | linear, as they are | linear, smooth | quadratic, as they are | quadratic, smooth'
    n = 16
    do while (n <= 512)
      do k = 1, 4
        associate (order => (k + 1)/2)
          error(k) = gap_error(ellipse(n/order, order, .true., 0.0_dp, 0.0_dp), &
                               ellipse(3*n/(2*order), order, .false., GAP, 0.03_dp), modulo(k, 2) == 0, &
                               turned)
        end associate
      end do
      print '(i0,4('' | '',es8.2))', n, error
      n = 2*n
    end do
  end subroutine print_ellipse

  !> The largest error of the gap, or opening by a rotation.
  function gap_error(contact, opposite, smooth, turned) result(error)
    type(fuge_surface_mesh), intent(in) :: contact, opposite
    logical, intent(in) :: smooth, turned
    real(dp) :: error, opening
    integer :: before, i, k
    type(fuge_pair_options) :: options
    type(fuge_contact_pairs) :: pairs
    type(fuge_info) :: info

    options%smooth = smooth
    ! Coarse circles are circles too.
    options%crease = 60.0_dp
    call fuge_find_pairs(contact, opposite, options, pairs, info)
    if (info%failed()) error stop 'the surfaces were not paired'
    error = maxval(abs(pairs%gap - GAP))
    if (.not. turned) return
    error = 0.0_dp
    before = 10*size(opposite%node)
    do i = 1, pairs%points()
      opening = 0.0_dp
      do k = 1, size(pairs%dof, 1)
        if (pairs%dof(k, i) > before) then
          opening = opening + pairs%normal(k, i)*turned_by(opposite%node, pairs%dof(k, i) - before)
        else if (pairs%dof(k, i) > 0) then
          opening = opening + pairs%normal(k, i)*turned_by(contact%node, pairs%dof(k, i))
        end if
      end do
      error = max(error, abs(opening))
    end do
  end function gap_error

  !> The displacement of a degree of freedom in a rotation about the origin.
  pure function turned_by(node, dof) result(way)
    real(dp), intent(in) :: node(:, :)
    integer, intent(in) :: dof
    real(dp) :: way

    way = node(1, (dof + 1)/2)
    if (modulo(dof, 2) == 1) way = -node(2, (dof + 1)/2)
  end function turned_by

  !> Edges of order 1 or 2 around an ellipse, or around the curve `outwards` of it, unevenly spaced.
  function ellipse(edges, order, outside, outwards, shift) result(surface)
    integer, intent(in) :: edges, order
    logical, intent(in) :: outside
    real(dp), intent(in) :: outwards, shift
    type(fuge_surface_mesh) :: surface
    real(dp) :: normal(2), t
    integer :: k, nodes

    nodes = edges*order
    allocate (surface%node(2, nodes), surface%face(order + 1, edges), surface%dof(2, nodes))
    do k = 1, nodes
      t = 2.0_dp*PI*real(k - 1, dp)/real(nodes, dp) + shift
      t = t + 0.2_dp*sin(2.0_dp*t)
      normal = [cos(t)/1.5_dp, sin(t)]
      surface%node(:, k) = [1.5_dp*cos(t), sin(t)] + outwards/norm2(normal)*normal
    end do
    do k = 1, edges
      surface%face(:2, k) = [(k - 1)*order, modulo(k*order, nodes)] + 1
      if (.not. outside) surface%face(:2, k) = surface%face([2, 1], k)
      if (order == 2) surface%face(3, k) = 2*k
    end do
    surface%dof = reshape([(k, k=1, 2*nodes)], [2, nodes])
    if (.not. outside) surface%dof = surface%dof + 2*nodes*10
  end function ellipse

  subroutine print_cylinders()
    type(fuge_pair_options) :: options
    type(fuge_contact_pairs) :: pairs
    type(fuge_info) :: info
    integer :: corners, k
    real(dp) :: error(2)

    print '(/,a)', 'press fit, 24 and 36 faces around, sheared, sizes 1:3 | mean | worst'
    do k = 1, 2
      corners = merge(4, 3, k == 1)
      pairs = fuge_contact_pairs()
      call fuge_find_pairs(cylinder(24, 3, corners, .true.), cylinder(36, 4, corners, .false.), options, pairs, info)
      if (info%failed()) error stop 'the surfaces were not paired'
      error = [sum(pairs%gap*pairs%area)/sum(pairs%area), pairs%gap(maxloc(abs(pairs%gap + INTERFERENCE), 1))]
      print '(a,2('' | '',es9.2))', merge('quadrangles', 'triangles  ', k == 1), 1.0_dp + error/INTERFERENCE
    end do
  end subroutine print_cylinders

  !> A cylinder of linear faces, 20 long; sheared to one side from outside, to the other from inside.
  function cylinder(around, layers, corners, outside) result(surface)
    integer, intent(in) :: around, layers, corners
    logical, intent(in) :: outside
    type(fuge_surface_mesh) :: surface
    integer :: corner(4), f, i, j, k
    real(dp) :: angle, z, r

    allocate (surface%node(3, around*(layers + 1)), surface%face(corners, (5 - corners)*around*layers))
    f = 0
    r = merge(RADIUS + INTERFERENCE, RADIUS, outside)
    do j = 0, layers
      do i = 0, around - 1
        z = uneven(real(j, dp)/real(layers, dp))
        angle = 2.0_dp*PI*uneven(real(i, dp)/real(around, dp)) + merge(0.5_dp, -0.3_dp, outside)*z
        surface%node(:, 1 + i + around*j) = [r*cos(angle), r*sin(angle), 20.0_dp*z]
        if (j == layers) cycle
        corner = 1 + around*j + [i, modulo(i + 1, around), around + modulo(i + 1, around), around + i]
        surface%face(:, f + 1) = corner(:corners)
        if (corners == 3) surface%face(:, f + 2) = corner([1, 3, 4])
        f = f + 5 - corners
      end do
    end do
    if (.not. outside) surface%face = surface%face(corners:1:-1, :)
    allocate (surface%dof(3, size(surface%node, 2)))
    surface%dof = reshape([(k, k=1, size(surface%node))], shape(surface%node)) + merge(0, 10000, outside)
  end function cylinder

  pure function uneven(s)
    real(dp), intent(in) :: s
    real(dp) :: uneven

    uneven = s + 0.5_dp*sin(2.0_dp*PI*s)/(2.0_dp*PI)
  end function uneven

end program smooth_gaps
