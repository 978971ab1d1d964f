!> A rough metal surface pressed on a flat: real area of contact with and without a limit of the pressure, its hardness.
!>
!>     hardness [cells [folder for its tables]]
!>
!> The self-affine surface of the example `surface`, of `cells` x `cells`, a power of two, 256 unless given, periodic in
!> both directions. A cell that has reached the hardness H carries H times its area and gives way: the limit of its
!> force. Lengths count in periods, pressures in E* g with the root mean square g of the gradient, areas in A_0.
!>
!> Known: the contact has at least the area p/H at the mean pressure p, and just this area where it is plastic
!> everywhere; at most p/H of A_0 is at its limit. A hardness above the largest pressure changes nothing, to the
!> tolerance. A load beyond H A_0 is refused. Areas for all hardnesses follow from the theory of B. N. J. Persson
!> (Phys. Rev. Lett. 87, 2001): the distribution of the pressure spreads with magnification, and is absorbed at 0, where
!> the surfaces part, and at H, where they yield. Without a limit, the area is between Persson's and that of Bush,
!> Gibson and Thomas, as in `surface`.
!> On few cells, the iteration on the grid is compared with the active set, which has the matrix.
!> For the picture it writes hardness_load.csv and hardness_cut.csv.
program hardness
  use example_output, only: create_file
  use example_verdict, only: verdict
  use fuge, only: dp => fuge_dp, fuge_dense_operator, fuge_halfspace_operator, fuge_info, fuge_options, fuge_problem, &
    fuge_solution, fuge_solver, FUGE_ERR_NO_EQUILIBRIUM, FUGE_LIMITED_LOWER, FUGE_MEAN, FUGE_PERIODIC
  use hardness_theory, only: areas, persson_areas
  use surface_heights, only: perimeter, rms_gradient, self_affine_surface
  implicit none

  real(dp), parameter :: PI = acos(-1.0_dp)
  !> Mean pressures.
  real(dp), parameter :: LOADS(9) = &
    [0.01_dp, 0.02_dp, 0.04_dp, 0.08_dp, 0.15_dp, 0.24_dp, 0.4_dp, 0.7_dp, 1.2_dp]
  !> The last one is no limit.
  real(dp), parameter :: HARDNESSES(4) = [0.25_dp, 0.5_dp, 1.0_dp, huge(1.0_dp)]
  !> The load of the cut, and where the limits are loosened and tightened.
  real(dp), parameter :: SHOWN = 0.08_dp
  !> A tolerance that is finer than the digits of any picture.
  type(fuge_options), parameter :: OPTIONS = fuge_options(tolerance=1.0e-8_dp)
  !> Persson's areas are too small in light contact, and the grid counts whole cells; fraction of A_0.
  real(dp), parameter :: ALLOWED = 0.1_dp

  !> A surface on its half-space; `unit` is E* g times the area of a cell, the force of a cell at the pressure 1.
  type :: rough_contact
    integer :: cells = 0
    real(dp) :: unit = 0.0_dp
    type(fuge_halfspace_operator) :: operator
    real(dp), allocatable :: gap(:)
  end type rough_contact

  call run()

contains

  subroutine run()
    type(rough_contact) :: contact
    type(verdict) :: known
    integer :: cells

    call read_cells(cells)
    call make(cells, contact)
    call all_loads(contact, known)
    call loosen_and_tighten(contact, known)
    call write_cuts(contact)
    call compare_with_matrix(known)
    call known%give('bounds, Persson, active set')
  end subroutine run

  subroutine read_cells(cells)
    integer, intent(out) :: cells
    character(len=32) :: argument
    integer :: status

    cells = 256
    if (command_argument_count() < 1) return
    call get_command_argument(1, argument)
    read (argument, *, iostat=status) cells
    if (status /= 0) error stop 'usage: hardness [cells [folder]]'
    if (cells < 64 .or. popcnt(cells) /= 1) error stop 'cells has to be a power of two, 64 or more'
  end subroutine read_cells

  subroutine make(cells, contact)
    integer, intent(in) :: cells
    type(rough_contact), intent(out) :: contact
    real(dp), allocatable :: height(:, :)
    type(fuge_info) :: info
    real(dp) :: spacing

    contact%cells = cells
    allocate (height(cells, cells))
    call self_affine_surface(cells, height)
    spacing = 1.0_dp/real(cells, dp)
    contact%unit = rms_gradient(height, spacing)*spacing**2
    contact%gap = reshape(maxval(height) - height, [size(height)])
    call contact%operator%set(cells, cells, spacing, spacing, 1.0_dp, info, element=FUGE_MEAN, boundary=FUGE_PERIODIC)
    if (info%failed()) error stop 'no half-space'
  end subroutine make

  !> The problem of a mean pressure and a hardness; without a limit if that is huge.
  subroutine pose(contact, pressure, limit, problem)
    type(rough_contact), intent(in) :: contact
    real(dp), intent(in) :: pressure, limit
    type(fuge_problem), intent(out) :: problem
    integer :: n

    n = size(contact%gap)
    problem%gap = contact%gap
    problem%resultant = [pressure*contact%unit*real(n, dp)]
    if (limit < huge(limit)) problem%limit = spread(limit*contact%unit, 1, n)
  end subroutine pose

  subroutine all_loads(contact, known)
    type(rough_contact), intent(in) :: contact
    type(verdict), intent(inout) :: known
    type(fuge_problem) :: problem
    type(fuge_solver) :: solver
    type(fuge_solution) :: solution
    type(fuge_info) :: info
    real(dp) :: elastic(size(LOADS)), pressure
    integer :: file, j, k

    call create_file('hardness_load.csv', 2, file)
    write (file, '(a)') 'hardness,pressure,contact,at the limit,Persson,Persson at the limit,largest pressure,products'
    print '(a)', 'hardness  pressure  contact  Persson  at the limit  Persson  largest pressure  products  residual'
    do j = size(HARDNESSES), 1, -1
      do k = 1, size(LOADS)
        pressure = LOADS(k)
        ! The last load of each hardness is nearly the greatest that it can carry.
        if (pressure >= HARDNESSES(j)) pressure = 0.99_dp*HARDNESSES(j)
        call pose(contact, pressure, HARDNESSES(j), problem)
        call solver%solve(contact%operator, problem, solution, info, OPTIONS)
        if (info%status /= 0) call give_up(info)
        call write_load(file, contact, pressure, HARDNESSES(j), solution, info)
        if (j == size(HARDNESSES)) elastic(k) = share(solution%force > 0.0_dp)
        call compare(contact, pressure, HARDNESSES(j), elastic(k), solution, known)
        if (pressure < LOADS(k)) exit
      end do
    end do
    close (file)
  end subroutine all_loads

  pure function share(is_so)
    logical, intent(in) :: is_so(:)
    real(dp) :: share

    share = real(count(is_so), dp)/real(size(is_so), dp)
  end function share

  subroutine write_load(file, contact, pressure, limit, solution, info)
    integer, intent(in) :: file
    type(rough_contact), intent(in) :: contact
    real(dp), intent(in) :: pressure, limit
    type(fuge_solution), intent(in) :: solution
    type(fuge_info), intent(in) :: info
    type(areas) :: theory
    character(len=8) :: name
    real(dp) :: found(3)

    theory = persson_areas(pressure, limit)
    found = [share(solution%force > 0.0_dp), share(solution%state == FUGE_LIMITED_LOWER), &
             maxval(solution%force)/contact%unit]
    name = '    none'
    if (limit < huge(limit)) write (name, '(f8.2)') limit
    print '(a,f10.4,2f9.4,f14.4,f9.4,f18.4,i10,es10.1)', name, pressure, found(1), theory%contact, found(2), &
      theory%limited, found(3), info%products, info%residual
    write (file, '(es14.6,6('','',es14.6),'','',i0)') merge(limit, 0.0_dp, limit < huge(limit)), pressure, found(1:2), &
      theory%contact, theory%limited, found(3), info%products
  end subroutine write_load

  !> `elastic`: the area of contact at this load without a limit.
  subroutine compare(contact, pressure, limit, elastic, solution, known)
    type(rough_contact), intent(in) :: contact
    real(dp), intent(in) :: pressure, limit, elastic
    type(fuge_solution), intent(in) :: solution
    type(verdict), intent(inout) :: known
    type(areas) :: theory
    real(dp) :: limited, total, touching

    touching = share(solution%force > 0.0_dp)
    theory = persson_areas(pressure, limit)
    ! Line by line: one sum of so many forces would lose digits itself.
    total = sum(sum(reshape(solution%force, [contact%cells, contact%cells]), 1))
    call known%compare(total/(contact%unit*pressure*size(solution%force)) - 1.0_dp, 1.0e-11_dp, 'equilibrium')
    call known%hold(abs(touching - theory%contact) <= ALLOWED, 'Persson''s area of contact')
    if (limit >= huge(limit)) then
      call compare_elastic(contact, pressure, solution, known)
      return
    end if
    limited = share(solution%state == FUGE_LIMITED_LOWER)
    call known%hold(abs(limited - theory%limited) <= ALLOWED, 'Persson''s area at the limit')
    call known%hold(limited <= pressure/limit, 'cells at the limit carry no more than the load')
    call known%hold(maxval(solution%force) <= limit*contact%unit, 'the hardness is not exceeded')
    call known%hold(touching >= max(pressure/limit, elastic), 'the area is at least load/hardness and the elastic one')
    call known%hold(all(solution%gap >= 0.0_dp .or. solution%state == FUGE_LIMITED_LOWER), &
                    'only limited cells give way')
    if (pressure > 0.98_dp*limit) call known%hold(limited > 0.95_dp, 'nearly the greatest load: nearly all cells yield')
  end subroutine compare

  !> Without a limit, the area less what whole cells at the edges add is between the theories, as in `surface`.
  subroutine compare_elastic(contact, pressure, solution, known)
    type(rough_contact), intent(in) :: contact
    real(dp), intent(in) :: pressure
    type(fuge_solution), intent(in) :: solution
    type(verdict), intent(inout) :: known
    type(areas) :: theory
    real(dp) :: area
    integer :: edge

    theory = persson_areas(pressure, huge(1.0_dp))
    edge = perimeter(reshape(solution%force > 0.0_dp, [contact%cells, contact%cells]))
    area = share(solution%force > 0.0_dp) - (PI - 1.0_dp + log(2.0_dp))/24.0_dp*real(edge, dp)/size(solution%force)
    call known%hold(area >= 0.95_dp*theory%contact .and. area <= sqrt(2.0_dp*PI)*pressure, 'the area without a limit')
  end subroutine compare_elastic

  !> A hardness above the largest pressure, and one that does not carry the load.
  subroutine loosen_and_tighten(contact, known)
    type(rough_contact), intent(in) :: contact
    type(verdict), intent(inout) :: known
    type(fuge_problem) :: problem
    type(fuge_solver) :: solver, other_solver
    type(fuge_solution) :: elastic, solution
    type(fuge_info) :: info
    real(dp) :: largest

    call pose(contact, SHOWN, huge(1.0_dp), problem)
    call solver%solve(contact%operator, problem, elastic, info, OPTIONS)
    if (info%status /= 0) call give_up(info)
    largest = maxval(elastic%force)
    call pose(contact, SHOWN, 1.01_dp*largest/contact%unit, problem)
    call other_solver%solve(contact%operator, problem, solution, info, OPTIONS)
    if (info%status /= 0) call give_up(info)
    call known%compare(maxval(abs(solution%force - elastic%force))/largest, 1.0e-7_dp, 'a limit that is not reached')
    print '(/,a,es8.1)', 'Hardness above the largest pressure: forces change by', &
      maxval(abs(solution%force - elastic%force))/largest

    call pose(contact, SHOWN, 0.999_dp*SHOWN, problem)
    call other_solver%solve(contact%operator, problem, solution, info, OPTIONS)
    call known%hold(info%status == FUGE_ERR_NO_EQUILIBRIUM, 'a load beyond all limits is refused')
    print '(2a)', 'Hardness below the mean pressure: ', trim(info%message)
  end subroutine loosen_and_tighten

  !> Pressures along the row of cells with the largest elastic one, for each hardness.
  subroutine write_cuts(contact)
    type(rough_contact), intent(in) :: contact
    type(fuge_problem) :: problem
    type(fuge_solver) :: solver
    type(fuge_solution) :: solution
    type(fuge_info) :: info
    real(dp) :: pressure(contact%cells, contact%cells, size(HARDNESSES))
    integer :: file, i, j, at(2)

    do j = 1, size(HARDNESSES)
      call pose(contact, SHOWN, HARDNESSES(j), problem)
      call solver%solve(contact%operator, problem, solution, info, OPTIONS)
      if (info%status /= 0) call give_up(info)
      pressure(:, :, j) = reshape(solution%force/contact%unit, [contact%cells, contact%cells])
    end do
    at = maxloc(pressure(:, :, size(HARDNESSES)))
    call create_file('hardness_cut.csv', 2, file)
    write (file, '(a)') 'x from the largest pressure,hardness 0.25,0.5,1,none'
    do i = 1, contact%cells
      write (file, '(es14.6,*('','',es14.6))') real(i - at(1), dp)/real(contact%cells, dp), pressure(i, at(2), :)
    end do
    close (file)
  end subroutine write_cuts

  !> On few cells the active set, which has the matrix, finds the same forces.
  subroutine compare_with_matrix(known)
    type(verdict), intent(inout) :: known
    integer, parameter :: FEW = 32
    real(dp), allocatable, target :: alpha(:, :)
    real(dp), allocatable :: unit_force(:)
    type(rough_contact) :: contact
    type(fuge_dense_operator) :: matrix
    type(fuge_problem) :: problem
    type(fuge_solver) :: solver, other_solver
    type(fuge_solution) :: solution, other
    type(fuge_info) :: info
    integer :: k, status

    call make(FEW, contact)
    allocate (alpha(FEW**2, FEW**2), unit_force(FEW**2))
    do k = 1, FEW**2
      unit_force = 0.0_dp
      unit_force(k) = 1.0_dp
      call contact%operator%apply(unit_force, alpha(:, k), status)
      if (status /= 0) error stop 'no influence matrix'
    end do
    alpha = 0.5_dp*(alpha + transpose(alpha))
    call matrix%set(alpha, info)
    if (info%failed()) call give_up(info)
    call pose(contact, SHOWN, 0.5_dp, problem)
    call solver%solve(contact%operator, problem, solution, info, OPTIONS)
    if (info%status /= 0) call give_up(info)
    call other_solver%solve(matrix, problem, other, info, OPTIONS)
    if (info%status /= 0) call give_up(info)
    call known%compare(maxval(abs(solution%force - other%force))/maxval(other%force), 1.0e-6_dp, 'the active set')
    call known%hold(all(solution%state == other%state), 'the states by the active set')
    print '(a,i0,a,i0,a,es8.1)', 'By the active set on ', FEW, ' x ', FEW, ' cells: forces differ by', &
      maxval(abs(solution%force - other%force))/maxval(other%force)
  end subroutine compare_with_matrix

  subroutine give_up(info)
    type(fuge_info), intent(in) :: info

    print '(a)', trim(info%message)
    error stop 'the surface was not solved'
  end subroutine give_up

end program hardness
