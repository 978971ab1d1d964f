!> Hertz's line contact by two meshes that do not match: an elastic cylinder on an elastic block.
!>
!>     cylinder_block [elements along 1.5 mm of the finest mesh: 12, 24, 48, .. [folder for its tables]]
!>
!> A cylinder of steel is pressed on a block of aluminium by a prescribed approach, in plane strain, half of it
!> modelled. Where they touch, the block has two elements for three of the cylinder. Meshes of half the size each show
!> the order of convergence of the force, the half-width and the pressures: for linear and for quadratic elements, and a
!> quadratic cylinder on a linear block; with the coarser and with the finer surface as the contact surface, whose nodes
!> are the contact points; for the mortar method and for nodes against faces; and for a block as fine as the cylinder.
!>
!> Linear elements which do not match have kinks at different places. If the nodes of the finer surface are the contact
!> points, the pressures there make up for that from node to node, and are of first order. Those of the coarser surface
!> do not notice.
!>
!> Errors of the elements are those against a finer mesh of the same bodies. What is left against Hertz is the error of
!> the theory, for which both bodies are half-planes; it is shown for these bodies and for smaller ones.
!>
!> Each error is a root mean square over many approaches, which put the edge of the contact anywhere in an element. The
!> half-width is found from the forces, a**2 = 4 sum(f x**2)/sum(f): exact for Hertz's pressure, and of second order for
!> the forces of nodes. The last node with a force would be off by up to an element.
!> Tables: cylinder_block_errors.csv, cylinder_block_pressure.csv, cylinder_block_mesh.dat.
program cylinder_block
  use cylinder_block_mesh, only: make_block, make_cylinder, plane_mesh
  use elastic_elements, only: mesh_stiffness, PLANE_STRAIN
  use example_output, only: create_file
  use example_verdict, only: verdict
  use example_stiffness, only: bodies_stiffness, IS_SPARSE
  use fuge, only: dp => fuge_dp, fuge_condense, fuge_condensed, fuge_dense_operator, fuge_elastic_body, fuge_info, &
    fuge_join_bodies, fuge_joined_bodies, fuge_problem, fuge_solution, fuge_solver, fuge_surface_mesh, &
    fuge_surface_pair, FUGE_MORTAR, FUGE_NODE_TO_FACE, FUGE_NORMALS_OPPOSITE
  implicit none

  real(dp), parameter :: PI = acos(-1.0_dp)
  !> N, mm. The zone of equal elements is wider than the contact on each side of the middle, 0.75 to 1 mm.
  real(dp), parameter :: RADIUS = 40.0_dp, ZONE = 1.5_dp
  real(dp), parameter :: YOUNG(2) = [2.1e5_dp, 7.0e4_dp], POISSON(2) = [0.3_dp, 0.33_dp]
  real(dp), parameter :: E_STAR = 1.0_dp/sum((1.0_dp - POISSON**2)/YOUNG)
  real(dp), parameter :: LEAST_APPROACH = 0.033_dp, GREATEST_APPROACH = 0.056_dp
  integer, parameter :: APPROACHES = 24
  integer, parameter :: CYLINDER = 1, BLOCK = 2
  !> Elements of the cylinder along the zone, on the coarsest mesh.
  integer, parameter :: COARSEST = 6

  !> A choice of meshes and of the method.
  type :: variant
    character(len=80) :: name = ''
    integer :: order = 1, method = FUGE_MORTAR
    !> The body of the contact surface: CYLINDER, which has the finer one, or BLOCK.
    integer :: contact = CYLINDER
    !> Elements of the block for six of the cylinder.
    integer :: of_block = 4
    !> Order of the block's elements if it differs.
    integer :: block_order = 0
    !> Least orders of convergence: force, half-width, peak pressure, all pressures.
    real(dp) :: least_order(4) = 0.0_dp
  end type variant

  !> A contact; per unit depth and of both halves.
  type :: contact_measures
    real(dp) :: force = 0.0_dp, half_width = 0.0_dp, peak = 0.0_dp
    !> Places, pressures and areas of the contact points.
    real(dp), allocatable :: x(:), pressure(:), area(:)
  end type contact_measures

  !> The choice of quadratic elements, and the number of those that are in the picture.
  integer, parameter :: QUADRATIC = 4, PICTURED = 5
  type(variant), parameter :: CHOICES(7) = [ &
    variant('Linear elements, contact points on the coarser surface', contact=BLOCK, &
            least_order=[1.8_dp, 1.8_dp, 1.2_dp, 0.9_dp]), &
    variant('Linear elements, contact points on the finer surface', &
            least_order=[1.8_dp, 1.3_dp, 0.9_dp, 0.7_dp]), &
    variant('Linear elements, equally fine surfaces', of_block=6, &
            least_order=[1.8_dp, 1.7_dp, 1.0_dp, 0.8_dp]), &
    variant('Quadratic elements, contact points on the finer surface', order=2, &
            least_order=[1.8_dp, 1.8_dp, 2.0_dp, 1.0_dp]), &
    variant('Linear elements, nodes of the finer surface against faces', method=FUGE_NODE_TO_FACE, &
            least_order=[1.8_dp, 1.3_dp, 0.2_dp, 0.5_dp]), &
    variant('Quadratic on linear elements, contact points on the linear, coarser surface', order=2, contact=BLOCK, &
            block_order=1, least_order=[1.8_dp, 1.8_dp, 1.0_dp, 0.9_dp]), &
    variant('Quadratic on linear elements, contact points on the quadratic, finer surface', order=2, &
            block_order=1, least_order=[1.8_dp, 1.1_dp, 0.8_dp, 0.7_dp])]

  call run()

contains

  subroutine run()
    type(contact_measures) :: reference(APPROACHES)
    type(verdict) :: known
    integer :: file, finest, v

    finest = finest_cells()
    call solve(CHOICES(QUADRATIC), finest, RADIUS, reference)
    print '(a,f4.0,a,2(f6.3,a))', 'A cylinder of steel, R = ', RADIUS, ' mm, on a block of aluminium, approach ', &
      LEAST_APPROACH, ' to ', GREATEST_APPROACH, ' mm'
    print '(a,i0,a)', 'Relative errors, root mean square of ', APPROACHES, ' approaches, and their orders'
    print '(a,i0,a)', 'against quadratic elements with a/h = ', nint(inverse_size(finest)), ' on average'
    call create_file('cylinder_block_errors.csv', 2, file)
    write (file, '(a)') 'choice,a/h,force,half-width,peak pressure,all pressures'
    do v = 1, size(CHOICES)
      call converge(v, merge(finest/2, finest, CHOICES(v)%order == 2), reference, known, file)
    end do
    close (file)
    call compare_with_hertz(finest/2, reference, known)
    call write_pressures(finest)
    call write_meshes()
    call known%give('orders of convergence, and Hertz')
  end subroutine run

  !> The argument: a power of two times COARSEST.
  integer function finest_cells() result(cells)
    character(len=32) :: argument
    integer :: status

    cells = merge(48, 12, IS_SPARSE)
    call get_command_argument(1, argument)
    if (argument /= '') then
      read (argument, *, iostat=status) cells
      if (status /= 0 .or. modulo(cells, 2*COARSEST) /= 0) error stop 'the number of elements is 12, 24, 48, ..'
    end if
  end function finest_cells

  !> a/h for a half-width in the middle of all, 0.88 mm.
  pure function inverse_size(cells) result(a_over_h)
    integer, intent(in) :: cells
    real(dp) :: a_over_h

    a_over_h = 0.88_dp*real(cells, dp)/ZONE
  end function inverse_size

  !> The table of one choice, with meshes from the coarsest to the finest.
  subroutine converge(v, finest, reference, known, file)
    integer, intent(in) :: v, finest, file
    type(contact_measures), intent(in) :: reference(:)
    type(verdict), intent(inout) :: known
    type(contact_measures) :: found(APPROACHES)
    real(dp) :: error(4), first(4), last(4)
    integer :: cells, k

    print '(/,a)', trim(CHOICES(v)%name)
    print '(a6,a11,a5,3(a15,a1))', 'a/h', 'force', '', 'half-width', '', 'peak pressure', '', 'all pressures', ''
    cells = COARSEST
    first = 0.0_dp
    last = 0.0_dp
    do while (cells <= finest)
      call solve(CHOICES(v), cells, RADIUS, found)
      error = [error_of(found%force, reference%force), error_of(found%half_width, reference%half_width), &
               error_of(found%peak, reference%peak), &
               sqrt(sum([(pressure_error(found(k), reference(k)), k=1, APPROACHES)])/real(APPROACHES, dp))]
      write (file, '(i0,5('','',es12.4))') v, inverse_size(cells), error
      if (cells == COARSEST) then
        first = error
        print '(f6.1,4(es11.2,5x))', inverse_size(cells), error
      else
        print '(f6.1,4(es11.2,f5.2))', inverse_size(cells), (error(k), log(last(k)/error(k))/log(2.0_dp), k=1, 4)
      end if
      last = error
      cells = 2*cells
    end do
    ! Two meshes show no order yet.
    if (cells/2 < 4*COARSEST .and. CHOICES(v)%order == 1 .or. cells/2 == COARSEST) return
    associate (orders => log(first/last)/log(real(cells/2/COARSEST, dp)))
      print '(a,4(f11.2,5x))', ' order', orders
      do k = 1, size(orders)
        call known%hold(orders(k) >= CHOICES(v)%least_order(k), 'an order of convergence')
      end do
    end associate
  end subroutine converge

  !> Root mean square of relative errors.
  pure function error_of(found, exact) result(error)
    real(dp), intent(in) :: found(:), exact(:)
    real(dp) :: error

    error = norm2(found/exact - 1.0_dp)/sqrt(real(size(found), dp))
  end function error_of

  !> Mean square of the errors of all pressures, relative to that of the half ellipse which the reference has.
  pure function pressure_error(found, reference) result(error)
    type(contact_measures), intent(in) :: found, reference
    real(dp) :: error
    real(dp) :: ellipse(size(found%x))

    ellipse = reference%peak*sqrt(max(0.0_dp, 1.0_dp - (found%x/reference%half_width)**2))
    error = sum(found%area*(found%pressure - ellipse)**2)/sum(found%area*ellipse**2)
  end function pressure_error

  !> Solve the contact for all approaches. The block is as wide on each side, and as high, as the cylinder.
  subroutine solve(choice, cells, r, found)
    type(variant), intent(in) :: choice
    integer, intent(in) :: cells
    real(dp), intent(in) :: r
    type(contact_measures), intent(out) :: found(:)
    type(plane_mesh) :: mesh(2)
    type(fuge_elastic_body) :: body(2)
    type(fuge_surface_pair) :: pair(1)
    type(fuge_joined_bodies) :: joined
    type(bodies_stiffness) :: stiffness
    type(fuge_condensed), target :: condensed
    type(fuge_info) :: info
    integer :: block_order, k

    block_order = merge(choice%block_order, choice%order, choice%block_order > 0)
    call make_cylinder(r, ZONE, cells, choice%order, mesh(1))
    call make_block(r, 1.1_dp*ZONE, choice%of_block*cells/COARSEST, block_order, mesh(2))
    do k = 1, 2
      call set_body(mesh(k), k, body(k))
    end do
    pair(1)%contact_body = choice%contact
    pair(1)%opposite_body = 3 - choice%contact
    call set_surface(mesh(choice%contact), pair(1)%contact)
    call set_surface(mesh(3 - choice%contact), pair(1)%opposite)
    pair(1)%options%method = choice%method
    ! The normals of the block, whichever surface has the contact points: otherwise the gaps differ by (a/R)**2.
    if (choice%contact == CYLINDER) pair(1)%options%normals = FUGE_NORMALS_OPPOSITE
    call fuge_join_bodies(body, pair, joined, info)
    call stop_if_failed(info)
    call stiffness%set_columns(joined%column, joined%row, joined%value, info)
    call stop_if_failed(info)
    call fuge_condense(stiffness, joined%body, condensed, info)
    call stop_if_failed(info)
    do k = 1, size(found)
      found(k)%x = mesh(choice%contact)%node(1, joined%pairs%node)
      call press(joined, condensed, approach_of(k)*(RADIUS/r), found(k))
    end do
  end subroutine solve

  !> Approach number k; on a mesh the edge of the contact is then anywhere in its elements.
  elemental function approach_of(k) result(approach)
    integer, intent(in) :: k
    real(dp) :: approach

    approach = LEAST_APPROACH + (GREATEST_APPROACH - LEAST_APPROACH)*real(k - 1, dp)/real(APPROACHES - 1, dp)
  end function approach_of

  !> Body 1 comes down by 1 with its far side, body 2 is held there.
  subroutine set_body(mesh, number, body)
    type(plane_mesh), intent(in) :: mesh
    integer, intent(in) :: number
    type(fuge_elastic_body), intent(out) :: body
    integer :: k

    call mesh_stiffness(mesh%node, mesh%element, PLANE_STRAIN, YOUNG(number), POISSON(number), body%column, body%row, &
                        body%value)
    body%fixed = [2*mesh%axis - 1, 2*mesh%far]
    allocate (body%displacement(size(body%fixed)))
    body%displacement = [(0.0_dp, k=1, size(mesh%axis)), (merge(-1.0_dp, 0.0_dp, number == 1), k=1, size(mesh%far))]
  end subroutine set_body

  pure subroutine set_surface(mesh, surface)
    type(plane_mesh), intent(in) :: mesh
    type(fuge_surface_mesh), intent(out) :: surface
    integer :: k

    surface%node = mesh%node
    surface%face = mesh%edge
    allocate (surface%dof, source=reshape([(k, k=1, size(mesh%node))], shape(mesh%node)))
  end subroutine set_surface

  !> Solve for one approach. The displacements by that of the far side, b, have been found for 1 mm and are in
  !> proportion to it.
  subroutine press(joined, condensed, approach, found)
    type(fuge_joined_bodies), intent(in) :: joined
    type(fuge_condensed), intent(in), target :: condensed
    real(dp), intent(in) :: approach
    type(contact_measures), intent(inout) :: found
    type(fuge_problem) :: problem
    type(fuge_solution) :: solution
    type(fuge_solver) :: solver
    type(fuge_dense_operator) :: alpha
    type(fuge_info) :: info

    call joined%pose(condensed, problem, info)
    call stop_if_failed(info)
    problem%gap = joined%pairs%gap + approach*condensed%displacement
    call alpha%set(condensed%alpha, info)
    call stop_if_failed(info)
    call solver%solve(alpha, problem, solution, info)
    call stop_if_failed(info)
    if (.not. solution%force(size(solution%force)) <= 0.0_dp) error stop 'the contact is wider than the equal elements'
    found%area = joined%pairs%area
    found%pressure = solution%force/joined%pairs%area
    found%force = 2.0_dp*sum(solution%force)
    found%half_width = sqrt(4.0_dp*dot_product(solution%force, found%x**2)/sum(solution%force))
    found%peak = found%pressure(minloc(found%x, 1))
  end subroutine press

  !> What is left against Hertz, for which both bodies are half-planes: of the bodies that the tables are about, and of
  !> others, a quarter of their size.
  subroutine compare_with_hertz(cells, reference, known)
    integer, intent(in) :: cells
    type(contact_measures), intent(in) :: reference(:)
    type(verdict), intent(inout) :: known
    type(contact_measures) :: found(APPROACHES)

    call solve(CHOICES(QUADRATIC), cells, 0.25_dp*RADIUS, found)
    print '(/,a)', 'Quadratic elements against Hertz'
    print '(a6,a7,a11,a18)', 'R [mm]', 'a/h', 'half-width', 'peak pressure'
    print '(f6.0,f7.1,2(es11.2,5x))', 0.25_dp*RADIUS, inverse_size(cells), hertz_error(0.25_dp*RADIUS, found)
    print '(f6.0,f7.1,2(es11.2,5x))', RADIUS, inverse_size(2*cells), hertz_error(RADIUS, reference)
    call known%compare(hertz_error(RADIUS, reference), 4.0e-3_dp, 'the half-width or the largest pressure of Hertz')
  end subroutine compare_with_hertz

  !> Errors of half-width and peak pressure under the forces found.
  pure function hertz_error(r, found) result(error)
    real(dp), intent(in) :: r
    type(contact_measures), intent(in) :: found(:)
    real(dp) :: error(2)

    error = [error_of(found%half_width, sqrt(4.0_dp*found%force*r/(PI*E_STAR))), &
             error_of(found%peak, sqrt(found%force*E_STAR/(PI*r)))]
  end function hertz_error

  !> Pressures under the greatest approach: on a coarse mesh by the first choices, and on the finest one.
  subroutine write_pressures(finest)
    integer, intent(in) :: finest
    integer :: file, v

    call create_file('cylinder_block_pressure.csv', 2, file)
    do v = 1, PICTURED
      call write_one(CHOICES(v), 2*COARSEST, file)
    end do
    call write_one(CHOICES(1), finest, file)
    close (file)
  end subroutine write_pressures

  !> Places, pressures, and Hertz's half-width and pressure for the same force.
  subroutine write_one(choice, cells, file)
    type(variant), intent(in) :: choice
    integer, intent(in) :: cells, file
    type(contact_measures) :: found(APPROACHES)
    integer :: i

    call solve(choice, cells, RADIUS, found)
    associate (last => found(APPROACHES))
      do i = 1, size(last%x)
        write (file, '(3(es14.6,'',''),es14.6)') last%x(i), last%pressure(i), &
          sqrt(4.0_dp*last%force*RADIUS/(PI*E_STAR)), sqrt(last%force*E_STAR/(PI*RADIUS))
      end do
    end associate
    write (file, '(/)')
  end subroutine write_one

  !> The elements of the coarsest meshes, for a picture.
  subroutine write_meshes()
    type(plane_mesh) :: mesh(2)
    integer :: e, file, k

    call make_cylinder(RADIUS, ZONE, COARSEST, 1, mesh(1))
    call make_block(RADIUS, 1.1_dp*ZONE, 4, 1, mesh(2))
    call create_file('cylinder_block_mesh.dat', 2, file)
    do k = 1, 2
      do e = 1, size(mesh(k)%element, 2)
        write (file, '(2es14.6)') mesh(k)%node(:, mesh(k)%element([1, 2, 3, 4, 1], e))
        write (file, '()')
      end do
      write (file, '()')
    end do
    close (file)
  end subroutine write_meshes

  subroutine stop_if_failed(info)
    type(fuge_info), intent(in) :: info

    if (info%status == 0) return
    print '(a)', trim(info%message)
    error stop 'the contact was not solved'
  end subroutine stop_if_failed

end program cylinder_block
