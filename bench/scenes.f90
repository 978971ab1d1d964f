!> Products and times of general scenes, each over those of the scene that is one translation under a load: tilts,
!> prescribed motions, excluded points, play and ties, on the half-plane and the half-space by FFT.
!>
!>     scenes [sizes]     n cells of the half-plane; n x n of the half-space where the size is written nxn
!>
!> Prints a table with a column for each size: products + preconditionings and the time, in microseconds or over that of
!> the scene compared with, then the largest residual. Scenes alternate, and the least time of each counts, because
!> other programs may run. Each solve is from scratch, with operators that are set up beforehand.
program scenes
  use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_value
  use fuge, only: dp => fuge_dp, fuge_halfplane_operator, fuge_halfspace_operator, fuge_info, fuge_operator, &
    fuge_problem, fuge_solution, fuge_solver, FUGE_MEAN
  implicit none

  !> Faces reach from -1 to 1 in each direction; forces and lengths in units of E*.
  real(dp), parameter :: LOAD = 0.1_dp
  !> Least time to spend on each size.
  real(dp), parameter :: ENOUGH = 6.0_dp

  type :: scene
    character(len=60) :: name = ''
    !> The scene with which this one is compared.
    integer :: reference = 0
    type(fuge_problem) :: problem
    !> The derivative of the solution in the first motion counts, not the solve.
    logical :: derivative = .false.
    integer :: products = 0, preconditionings = 0
    real(dp) :: seconds = huge(1.0_dp), residual = 0.0_dp
  end type scene

  character(len=20) :: argument
  !> The lines of the table.
  character(len=400), allocatable :: lines(:)
  real(dp) :: largest_residual
  integer :: k

  if (command_argument_count() == 0) error stop 'name sizes, such as 4096 or 256x256'
  largest_residual = 0.0_dp
  do k = 1, command_argument_count()
    call get_command_argument(k, argument)
    call measure(trim(argument))
  end do
  print '(a)', (trim(lines(k))//' |', k=1, size(lines))
  print '(a,es8.1)', 'Largest residual:', largest_residual

contains

  subroutine measure(size_text)
    character(len=*), intent(in) :: size_text
    type(fuge_halfplane_operator) :: line
    type(fuge_halfspace_operator) :: area
    type(scene), allocatable :: all(:)
    type(fuge_info) :: info
    real(dp), allocatable :: x(:), y(:)
    integer :: cross, j, n

    cross = scan(size_text, 'x')
    read (size_text(cross + 1:), *) n
    if (cross == 0) then
      x = centres(n)
      allocate (y(n))
      y = 0.0_dp
      call line%set(n, 2.0_dp/real(n, dp), 1.0_dp, info, element=FUGE_MEAN)
      if (info%failed()) error stop 'no operator'
      call make_scenes(x, y, .false., all)
      call run(line, all)
    else
      x = [(centres(n), j=1, n)]
      y = reshape(transpose(reshape(x, [n, n])), [n*n])
      call area%set(n, n, 2.0_dp/real(n, dp), 2.0_dp/real(n, dp), 1.0_dp, info, element=FUGE_MEAN)
      if (info%failed()) error stop 'no operator'
      call make_scenes(x, y, .true., all)
      call run(area, all)
    end if
    call append_column(size_text, all)
  end subroutine measure

  !> Centres of n cells of one width from -1 to 1.
  pure function centres(n) result(x)
    integer, intent(in) :: n
    real(dp) :: x(n)
    integer :: j

    x = [((2.0_dp*real(j, dp) - real(n + 1, dp))/real(n, dp), j=1, n)]
  end function centres

  !> The scenes for points at x, y (n each).
  subroutine make_scenes(x, y, is_area, all)
    real(dp), intent(in) :: x(:), y(:)
    logical, intent(in) :: is_area
    type(scene), allocatable, intent(out) :: all(:)
    real(dp) :: bow(size(x)), flat(size(x)), lift

    flat = 0.0_dp
    ! The contact reaches to 0.4, on an area to 0.5.
    bow = merge(LOAD/(0.5_dp**3*4.0_dp/3.0_dp), 4.0_dp*LOAD/(acos(-1.0_dp)*0.4_dp**2), is_area)*0.5_dp*(x**2 + y**2)
    lift = merge(0.3_dp, 0.72_dp, is_area)
    allocate (all(0))
    call add(all, 'flat punch, upright', 1, flat)
    call add(all, 'flat, may tilt, force in the middle', 1, flat)
    call tilt(x, y, is_area, 0.0_dp, all(size(all))%problem)
    call add(all, 'flat, tilts, touches everywhere', 1, flat)
    call tilt(x, y, is_area, 0.1_dp, all(size(all))%problem)
    call add(all, 'flat, tilts, lifts off', 1, flat)
    call tilt(x, y, is_area, lift, all(size(all))%problem)
    call add(all, 'round punch, upright', 5, bow)
    call add(all, 'round, its approach prescribed', 5, bow)
    deallocate (all(size(all))%problem%resultant)
    all(size(all))%problem%prescribed = [.true.]
    all(size(all))%problem%motion = [merge(0.15_dp, 0.2_dp, is_area)]
    call add(all, 'round, tilts', 5, bow)
    call tilt(x, y, is_area, 0.25_dp, all(size(all))%problem)
    call add(all, 'round, tilts: derivative in the load', 5, bow)
    call tilt(x, y, is_area, 0.25_dp, all(size(all))%problem)
    all(size(all))%derivative = .true.
    call add(all, 'round, approach and tilts prescribed', 5, bow)
    call tilt(x, y, is_area, 0.0_dp, all(size(all))%problem)
    call prescribe(all(size(all))%problem, merge(0.15_dp, 0.2_dp, is_area), 0.05_dp)
    call add(all, 'round, a hole in the middle', 5, bow)
    allocate (all(size(all))%problem%excluded(size(x)))
    all(size(all))%problem%excluded = x**2 + y**2 < 0.1_dp**2
    call add(all, 'round, a hole beside the middle, tilts', 5, bow)
    call tilt(x, y, is_area, 0.1_dp, all(size(all))%problem)
    allocate (all(size(all))%problem%excluded(size(x)))
    all(size(all))%problem%excluded = (x - 0.1_dp)**2 + y**2 < 0.1_dp**2
    call add(all, 'round, a tenth of the points tied, tilts', 5, bow)
    call tilt(x, y, is_area, 0.1_dp, all(size(all))%problem)
    allocate (all(size(all))%problem%gap_upper(size(x)))
    all(size(all))%problem%gap_upper = ieee_value(1.0_dp, ieee_positive_inf)
    where (x < -0.8_dp) all(size(all))%problem%gap_upper = 0.0_dp
    call add(all, 'body with play, under a moment', 5, bow)
    call tilt(x, y, is_area, 0.0_dp, all(size(all))%problem)
    all(size(all))%problem%gap = 0.01_dp - 0.02_dp*x**2
    all(size(all))%problem%resultant = 0.0_dp
    all(size(all))%problem%resultant(2) = 0.5_dp*LOAD
    allocate (all(size(all))%problem%gap_upper(size(x)))
    all(size(all))%problem%gap_upper = 0.02_dp
  end subroutine make_scenes

  subroutine add(all, name, reference, gap)
    type(scene), allocatable, intent(inout) :: all(:)
    character(len=*), intent(in) :: name
    integer, intent(in) :: reference
    real(dp), intent(in) :: gap(:)
    type(scene), allocatable :: more(:)

    allocate (more(size(all) + 1))
    more(:size(all)) = all
    more(size(more))%name = name
    more(size(more))%reference = reference
    more(size(more))%problem%gap = gap
    more(size(more))%problem%resultant = [LOAD]
    call move_alloc(more, all)
  end subroutine add

  !> The body may sink and tilt, on an area about both axes, under the load at the distance `arm` from the middle.
  subroutine tilt(x, y, is_area, arm, problem)
    real(dp), intent(in) :: x(:), y(:), arm
    logical, intent(in) :: is_area
    type(fuge_problem), intent(inout) :: problem

    allocate (problem%modes(size(x), merge(3, 2, is_area)))
    problem%modes(:, 1) = 1.0_dp
    problem%modes(:, 2) = x
    problem%resultant = [LOAD, LOAD*arm]
    if (.not. is_area) return
    problem%modes(:, 3) = y
    problem%resultant = [LOAD, LOAD*arm, 0.5_dp*LOAD*arm]
  end subroutine tilt

  !> All motions are prescribed.
  subroutine prescribe(problem, approach, rotation)
    type(fuge_problem), intent(inout) :: problem
    real(dp), intent(in) :: approach, rotation
    integer :: m

    m = size(problem%resultant)
    allocate (problem%prescribed(m))
    problem%prescribed = .true.
    problem%motion = [approach, spread(rotation, 1, m - 1)]
    problem%resultant = 0.0_dp*problem%resultant
  end subroutine prescribe

  subroutine run(operator, all)
    class(fuge_operator), intent(in) :: operator
    type(scene), intent(inout) :: all(:)
    real(dp) :: start, now
    integer :: j, round

    call cpu_time(start)
    do round = 1, 40
      do j = 1, size(all)
        call solve(operator, all(j))
      end do
      call cpu_time(now)
      if (round > 2 .and. now - start > ENOUGH) exit
    end do
  end subroutine run

  subroutine solve(operator, what)
    class(fuge_operator), intent(in) :: operator
    type(scene), intent(inout) :: what
    type(fuge_solver) :: solver
    type(fuge_solution) :: solution, change
    type(fuge_info) :: info
    real(dp) :: unit(what%problem%mode_count())
    real(dp) :: begin, now

    call cpu_time(begin)
    call solver%solve(operator, what%problem, solution, info)
    call cpu_time(now)
    if (info%status /= 0) then
      print '(2a)', trim(what%name)//': ', trim(info%message)
      error stop 'a scene was not solved'
    end if
    what%residual = info%residual
    what%products = info%products
    what%preconditionings = info%preconditionings
    if (what%derivative) then
      unit = 0.0_dp
      unit(1) = 1.0_dp
      call cpu_time(begin)
      call solver%derivative(operator, 0.0_dp*what%problem%gap, unit, change, info)
      call cpu_time(now)
      if (info%failed()) error stop 'no derivative'
      ! Its products are added to those of the solve.
      what%products = info%products - what%products
      what%preconditionings = info%preconditionings - what%preconditionings
    end if
    what%seconds = min(what%seconds, now - begin)
  end subroutine solve

  !> Append a column to the table.
  subroutine append_column(size_text, all)
    character(len=*), intent(in) :: size_text
    type(scene), intent(in) :: all(:)
    character(len=40) :: cell
    character(len=8) :: ratio
    integer :: j

    if (.not. allocated(lines)) then
      allocate (lines(size(all) + 2))
      lines(:2) = ['| scene', '| ---  ']
      lines(3:) = '| '//all%name
    end if
    lines(1) = trim(lines(1))//' | '//size_text
    lines(2) = trim(lines(2))//' | ---:'
    do j = 1, size(all)
      associate (this => all(j), first => all(all(j)%reference))
        if (this%reference == j) then
          write (cell, '(i0,a,i0,a,i0,a)') this%products, ' + ', this%preconditionings, ', ', &
            nint(1.0e6_dp*this%seconds), ' us'
        else
          write (ratio, '(f8.2)') this%seconds/first%seconds
          write (cell, '(i0,a,i0,a)') this%products, ' + ', this%preconditionings, ', '//trim(adjustl(ratio))
        end if
        lines(j + 2) = trim(lines(j + 2))//' | '//trim(cell)
        largest_residual = max(largest_residual, this%residual)
      end associate
    end do
  end subroutine append_column

end program scenes
