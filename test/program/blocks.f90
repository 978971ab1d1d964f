!> Two blocks whose meshes do not match: writes their files for the program, and holds its tables against the library.
!>
!>     blocks write FOLDER 2|3
!>     blocks check TABLE 2|3 CASE
!>
!> The upper block stands on the lower one. CASE patch: a uniform pressure on top, which the contact passes on exactly.
!> The others are the same as by fuge_solve_bodies: a force on one corner, the left side held, and a clearance
!> (corner); the same with node to face, with normals of the opposite faces or given ones, with a play, or tied.
program blocks
  use block_files, only: write_block, write_formats, write_loads
  use block_models, only: block, make_block, CLEARANCE, TOP_PRESSURE, WIDTH
  use fuge_bodies_solution, only: fuge_bodies_contact, fuge_solve_bodies
  use fuge_contact_pairs_type, only: fuge_pair_options, FUGE_NODE_TO_FACE, FUGE_NORMALS_GIVEN, FUGE_NORMALS_OPPOSITE
  use fuge_elastic_body_type, only: fuge_elastic_body, fuge_surface_pair
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info
  use fuge_stiffness_dense, only: fuge_dense_stiffness
  implicit none

  real(dp), parameter :: TOLERANCE = 1.0e-12_dp, PI = acos(-1.0_dp)
  character(len=256) :: words(4)
  integer :: dimensions, k

  do k = 1, 4
    call get_command_argument(k, words(k))
  end do
  read (words(3), *) dimensions
  if (words(1) == 'write') then
    call write_files(trim(words(2)))
  else
    call check(trim(words(2)), trim(words(4)))
  end if

contains

  subroutine write_files(folder)
    character(len=*), intent(in) :: folder
    type(block) :: lower, upper

    call make_block('lower', dimensions, lower)
    call make_block('upper', dimensions, upper)
    call write_block(folder//'/lower', lower, merge('CPS4', 'C3D8', dimensions == 2))
    call write_block(folder//'/upper', upper, merge('CPS4', 'C3D8', dimensions == 2))
    if (dimensions == 2) then
      call write_block(folder//'/ring', upper, 'CAX4')
      call write_formats(folder//'/lower', lower)
      call write_formats(folder//'/upper', upper)
    end if
    call write_loads(folder//'/loads.csv', upper)
  end subroutine write_files

  subroutine check(path, scene)
    character(len=*), intent(in) :: path, scene
    type(block) :: upper
    type(fuge_bodies_contact) :: contact
    real(dp) :: area, force, gap, pressure, total, off(3)
    character(len=512) :: line
    character(len=16) :: body
    real(dp) :: values(6)
    integer :: file, i, node, pair, rows, status

    call make_block('upper', dimensions, upper)
    call solve(scene, contact)
    open (newunit=file, file=path, status='old', action='read')
    rows = 0
    total = 0.0_dp
    off = 0.0_dp
    do
      read (file, '(a)', iostat=status) line
      if (status /= 0) exit
      if (line(1:1) == '#' .or. line(1:4) == 'pair') cycle
      read (line, *) pair, body, node, values, area, force, pressure, gap
      rows = rows + 1
      i = findloc(upper%number(contact%pairs%node) == node .and. matmul(values(4:3 + dimensions), &
                  contact%pairs%direction) > 1.0_dp - TOLERANCE, .true., dim=1)
      if (i == 0 .or. pair /= 1) error stop 'another point'
      if (all(body /= [character(len=5) :: 'upper', 'ring', 'both'])) error stop 'another body'
      if (norm2(values(:dimensions) - upper%position(:, contact%pairs%node(i))) > TOLERANCE) error stop 'another place'
      if (scene == 'ring') then
        call check_ring(values(1), area)
        total = total + area
      end if
      off = max(off, abs([force - contact%force(i), gap - contact%gap(i), pressure - TOP_PRESSURE]))
    end do
    close (file)
    print '(a,i0,3(a,es9.2))', 'points ', rows, ', off: forces', off(1), ', gaps', off(2), ', pressures', off(3)
    if (rows /= size(contact%force) .or. rows == 0) error stop 'not as many points'
    if (off(1) > TOLERANCE*maxval(abs(contact%force))) error stop 'other forces'
    if (off(2) > TOLERANCE*(maxval(abs(contact%displacement)) + CLEARANCE)) error stop 'other gaps'
    if (scene == 'ring' .and. abs(total - PI*WIDTH**2) > TOLERANCE*total) error stop 'another area'
    if (scene == 'patch' .and. off(3) > TOLERANCE*TOP_PRESSURE) error stop 'the pressure is not uniform'
    if (scene == 'corner' .and. (all(contact%touching) .or. .not. any(contact%touching))) error stop 'all points alike'
  end subroutine check

  !> The area of a ring inside, 2 pi times its radius times the length of an element.
  subroutine check_ring(radius, area)
    real(dp), intent(in) :: radius, area

    if (radius < 0.1_dp .or. radius > WIDTH - 0.1_dp) return
    if (abs(area - 2.0_dp*PI*radius*WIDTH/4) > TOLERANCE*area) error stop 'another ring'
  end subroutine check_ring

  !> The same by the library; it has no clearance, so the upper block is lifted.
  subroutine solve(scene, contact)
    character(len=*), intent(in) :: scene
    type(fuge_bodies_contact), intent(inout) :: contact
    type(fuge_dense_stiffness) :: stiffness
    type(fuge_elastic_body) :: bodies(2)
    type(fuge_surface_pair) :: pair(1)
    type(block) :: lower, upper
    type(fuge_info) :: info

    call make_block('lower', dimensions, lower)
    call make_block('upper', dimensions, upper)
    call lower%body([lower%bottom, lower%left, lower%front], size(lower%bottom), bodies(1))
    if (scene == 'patch') then
      call upper%body([upper%left, upper%front], 0, bodies(2))
      bodies(2)%load = upper%pressure_load()
    else
      call upper%body([upper%left, upper%left, upper%front], size(upper%left), bodies(2))
      bodies(2)%load = upper%corner_load()
    end if
    pair(1)%contact_body = 2
    pair(1)%opposite_body = 1
    call upper%surface(upper%below, pair(1)%contact)
    call lower%surface(lower%above, pair(1)%opposite)
    if (all(scene /= [character(len=5) :: 'patch', 'tied', 'given'])) &
      pair(1)%contact%node(dimensions, :) = pair(1)%contact%node(dimensions, :) + CLEARANCE
    call choose_options(scene, size(upper%position, 2), pair(1)%options)
    call fuge_solve_bodies(stiffness, bodies, pair, contact, info)
    if (info%status /= 0) then
      print '(a)', trim(info%message)
      error stop 'not solved'
    end if
  end subroutine solve

  subroutine choose_options(scene, nodes, options)
    character(len=*), intent(in) :: scene
    integer, intent(in) :: nodes
    type(fuge_pair_options), intent(inout) :: options

    select case (scene)
    case ('node_to_face')
      options%method = FUGE_NODE_TO_FACE
    case ('opposite')
      options%normals = FUGE_NORMALS_OPPOSITE
    case ('given')
      options%normals = FUGE_NORMALS_GIVEN
      allocate (options%normal(dimensions, nodes), source=0.0_dp)
      options%normal(1, :) = 0.25_dp
      options%normal(dimensions, :) = -1.0_dp
    case ('play')
      options%play = 0.2_dp
    case ('ring')
      options%revolution = .true.
    case ('tied')
      options%tied = .true.
    case ('faceted')
      options%smooth = .false.
    end select
  end subroutine choose_options

end program blocks
