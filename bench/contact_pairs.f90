!> Time to pair two surfaces of about n faces each, by both methods, and of the search alone.
!>
!> contact_pairs [n]; n = 100000 by default. Prints surfaces | faces | tree | search | node to face | mortar | mortar
!> without `smooth` | points, processor times in seconds, the least of three. `search` is the search for the faces near
!> each face.
program contact_pairs
  use fuge, only: dp => fuge_dp, fuge_contact_pairs, fuge_find_pairs, fuge_info, fuge_pair_options, fuge_surface_mesh, &
    FUGE_MORTAR, FUGE_NODE_TO_FACE
  use fuge_face_tree, only: build_tree, face_tree
  implicit none

  integer, parameter :: REPETITIONS = 3
  character(len=12) :: argument
  integer :: m, n

  n = 100000
  call get_command_argument(1, argument)
  if (argument /= '') read (argument, *) n
  m = nint(sqrt(real(n, dp)))
  print '(a)', 'surfaces | faces | tree | search | node to face | mortar | not smooth | points'
  call measure('plane, quadrangles', flat(m, .true., 0.0_dp, .false.), flat(m + 1, .false., 0.0_dp, .false.))
  call measure('plane, triangles', flat(nint(m/sqrt(2.0_dp)), .true., 0.0_dp, .true.), &
               flat(nint(m/sqrt(2.0_dp)) + 1, .false., 0.0_dp, .true.))
  call measure('half a shaft in a hub', flat(m, .true., 1.0_dp, .false.), flat(m + 1, .false., 1.001_dp, .false.))

contains

  !> m x m faces of the unit square, or of half a cylinder of this radius, from outside or from inside.
  function flat(m, outside, radius, triangles) result(surface)
    integer, intent(in) :: m
    logical, intent(in) :: outside, triangles
    real(dp), intent(in) :: radius
    type(fuge_surface_mesh) :: surface
    real(dp), parameter :: PI = acos(-1.0_dp)
    integer :: corner(4), f, i, j, k

    allocate (surface%node(3, (m + 1)**2), surface%dof(3, (m + 1)**2), &
              surface%face(merge(3, 4, triangles), merge(2, 1, triangles)*m**2))
    surface%dof = reshape([(k, k=1, 3*(m + 1)**2)], [3, (m + 1)**2])
    if (.not. outside) surface%dof = surface%dof + 1000000
    do j = 0, m
      do i = 0, m
        associate (x => surface%node(:, 1 + i + (m + 1)*j), s => real(i, dp)/m, t => real(j, dp)/m)
          x = [s, t, 0.0_dp]
          if (radius > 0.0_dp) x = [radius*sin(PI*(s - 0.5_dp)), t, radius*cos(PI*(s - 0.5_dp))]
        end associate
      end do
    end do
    f = 0
    do j = 0, m - 1
      do i = 0, m - 1
        k = 1 + i + (m + 1)*j
        corner = [k, k + 1, k + m + 2, k + m + 1]
        if (.not. outside) corner = corner(4:1:-1)
        f = f + 1
        surface%face(:, f) = corner(:size(surface%face, 1))
        if (.not. triangles) cycle
        f = f + 1
        surface%face(:, f) = corner([1, 3, 4])
      end do
    end do
  end function flat

  subroutine measure(name, contact, opposite)
    character(len=*), intent(in) :: name
    type(fuge_surface_mesh), intent(in) :: contact, opposite
    type(fuge_contact_pairs) :: pairs
    real(dp) :: time(5), least(5)
    integer :: k

    least = huge(least)
    do k = 1, REPETITIONS
      call time_search(contact, opposite, time(1), time(2))
      call time_pairs(contact, opposite, FUGE_NODE_TO_FACE, .true., pairs, time(3))
      call time_pairs(contact, opposite, FUGE_MORTAR, .true., pairs, time(4))
      call time_pairs(contact, opposite, FUGE_MORTAR, .false., pairs, time(5))
      least = min(least, time)
    end do
    print '(2a, i0, 5(a, f0.3), a, i0)', name, ' | ', size(contact%face, 2), ' | ', least(1), ' | ', least(2), ' | ', &
      least(3), ' | ', least(4), ' | ', least(5), ' | ', pairs%points()
  end subroutine measure

  subroutine time_search(contact, opposite, build, search)
    type(fuge_surface_mesh), intent(in) :: contact, opposite
    real(dp), intent(out) :: build, search
    type(face_tree) :: tree
    real(dp), allocatable :: box(:, :), other(:, :)
    real(dp) :: start, finish, middle(3)
    integer, allocatable :: found(:)
    integer :: count, f, stat, total

    call find_boxes(contact, box)
    call find_boxes(opposite, other)
    allocate (found(64))
    call cpu_time(start)
    call build_tree(other, tree, stat)
    call cpu_time(finish)
    build = finish - start
    total = 0
    do f = 1, size(box, 2)
      middle = 0.5_dp*(box(:3, f) + box(4:, f))
      call tree%find(middle - [0.0_dp, 0.0_dp, 1.0_dp], [0.0_dp, 0.0_dp, 2.0_dp], &
                     0.5_dp*norm2(box(4:, f) - box(:3, f)), found, count, stat)
      total = total + count
    end do
    call cpu_time(start)
    search = start - finish
    if (total < size(box, 2)) error stop 'faces were not found'
  end subroutine time_search

  subroutine find_boxes(surface, box)
    type(fuge_surface_mesh), intent(in) :: surface
    real(dp), allocatable, intent(out) :: box(:, :)
    integer :: f

    allocate (box(6, size(surface%face, 2)))
    do f = 1, size(box, 2)
      box(:3, f) = minval(surface%node(:, surface%face(:, f)), 2)
      box(4:, f) = maxval(surface%node(:, surface%face(:, f)), 2)
    end do
  end subroutine find_boxes

  subroutine time_pairs(contact, opposite, method, smooth, pairs, time)
    type(fuge_surface_mesh), intent(in) :: contact, opposite
    integer, intent(in) :: method
    logical, intent(in) :: smooth
    type(fuge_contact_pairs), intent(out) :: pairs
    real(dp), intent(out) :: time
    type(fuge_pair_options) :: options
    type(fuge_info) :: info
    real(dp) :: start

    options%method = method
    options%smooth = smooth
    call cpu_time(start)
    call fuge_find_pairs(contact, opposite, options, pairs, info)
    call cpu_time(time)
    time = time - start
    if (info%failed()) error stop 'the surfaces were not paired'
  end subroutine time_pairs

end program contact_pairs
