! Layered bodies: the ranks find what one process finds, on lines and areas.
program layers
  use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_value
  use fuge_cell_elements, only: FUGE_CENTRE, FUGE_MEAN, FUGE_FREE, FUGE_PERIODIC
  use fuge_halfplane_fft, only: fuge_halfplane_operator
  use fuge_halfspace_fft, only: fuge_halfspace_operator
  use fuge_halfspace_grid, only: FUGE_PERIODIC_X
  use fuge_kinds, only: dp
  use fuge_layered_body_type, only: fuge_layered_body
  use fuge_mpi, only: fuge_mpi_halfplane_operator, fuge_mpi_halfspace_operator
  use fuge_operator_type, only: fuge_operator
  use fuge_problem_type, only: fuge_problem
  use fuge_status, only: fuge_info, FUGE_DONE, FUGE_ERR_MODULUS, FUGE_ERR_OPTION, FUGE_ERR_UNSUPPORTED
  use mpi_f08
  use rank_checks, only: begin_checks, check_solves, end_checks, expect, gather, my_rank
  implicit none

  ! Bodies: a soft layer on a stiff half-space, a film ten times as stiff as what is below, a layer on a rigid base, and
  ! two layers that slide.
  integer, parameter :: SOFT = 1, FILM = 2, RIGID = 3, SLIDING = 4
  character(len=*), parameter :: NAMES(4) = ['a soft layer', 'a film      ', 'a rigid base', 'sliding     ']

  call begin_checks()
  call run()
  call end_checks()

contains

  subroutine run()
    integer :: kind

    do kind = SOFT, SLIDING
      call line_products(70000, FUGE_FREE, FUGE_MEAN, kind)
      call line_products(50021, FUGE_FREE, FUGE_CENTRE, kind)
      call line_products(61440, FUGE_PERIODIC, FUGE_MEAN, kind)
      call line_products(2*25013, FUGE_PERIODIC, FUGE_CENTRE, kind)
      call area_products(261, 263, FUGE_FREE, FUGE_MEAN, kind)
      call area_products(205, 190, FUGE_FREE, FUGE_CENTRE, kind)
      call area_products(261, 263, FUGE_PERIODIC, FUGE_CENTRE, kind)
      call area_products(205, 190, FUGE_PERIODIC, FUGE_MEAN, kind)
    end do
    do kind = SOFT, RIGID
      call solve_line(70000, FUGE_FREE, FUGE_MEAN, kind, 0.01_dp)
      call solve_line(40000, FUGE_FREE, FUGE_CENTRE, kind, 0.003_dp)
      call solve_line(61440, FUGE_PERIODIC, FUGE_MEAN, kind, 0.001_dp)
      call solve_area(261, 263, FUGE_FREE, FUGE_MEAN, kind, 0.02_dp)
      call solve_area(205, 190, FUGE_FREE, FUGE_CENTRE, kind, 0.0002_dp)
      call solve_area(261, 263, FUGE_PERIODIC, FUGE_MEAN, kind, 0.0005_dp)
      call solve_area(205, 190, FUGE_PERIODIC, FUGE_CENTRE, kind, 0.0005_dp)
    end do
    call refuse()
  end subroutine run

  function body_of(kind) result(body)
    integer, intent(in) :: kind
    type(fuge_layered_body) :: body
    type(fuge_info) :: info

    select case (kind)
    case (SOFT)
      call body%set([0.05_dp], [1.0_dp, 20.0_dp], [0.45_dp, 0.3_dp], info)
    case (FILM)
      call body%set([0.02_dp], [10.0_dp, 1.0_dp], [0.2_dp, 0.3_dp], info)
    case (RIGID)
      call body%set([0.1_dp], [1.0_dp, ieee_value(1.0_dp, ieee_positive_inf)], [0.3_dp, 0.3_dp], info)
    case default
      call body%set([0.01_dp, 0.03_dp], [1.0_dp, 5.0_dp, 2.0_dp], [0.3_dp, 0.0_dp, 0.4_dp], info, &
                    bonded=[.false., .true.], e_star_other=3.0_dp)
    end select
    call expect(info%status == FUGE_DONE, 'layers: '//trim(info%message))
  end function body_of

  pure function label(what, kind, boundary, element) result(name)
    character(len=*), intent(in) :: what
    integer, intent(in) :: kind, boundary, element
    character(len=34) :: name

    name = what//': '//trim(NAMES(kind))//trim(merge(', periodic', '          ', boundary == FUGE_PERIODIC)) &
           //trim(merge(', centre', '        ', element == FUGE_CENTRE))
  end function label

  subroutine line_products(n, boundary, element, kind)
    integer, intent(in) :: n, boundary, element, kind
    type(fuge_mpi_halfplane_operator) :: shared, copy
    type(fuge_halfplane_operator) :: whole
    type(fuge_layered_body) :: body
    type(fuge_info) :: info
    integer :: cells(2)

    body = body_of(kind)
    call shared%set(n, 1.0_dp/n, body%e_star(), MPI_COMM_WORLD, info, element, boundary, body=body%surface())
    call expect(info%status == FUGE_DONE, trim(info%message))
    copy = shared
    cells = shared%own_rows()
    if (my_rank() == 0) then
      call whole%set(n, 1.0_dp/n, body%e_star(), info, element, boundary, body=body%surface())
      call expect(abs(shared%datum() - whole%datum()) <= 1.0e-12_dp*abs(whole%datum()), 'the datum')
    end if
    ! Transforms of lines round otherwise on several ranks than on one.
    call compare_products(label('line', kind, boundary, element), 1.0e-14_dp, cells(1), shared, copy, whole)
  end subroutine line_products

  subroutine area_products(nx, ny, boundary, element, kind)
    integer, intent(in) :: nx, ny, boundary, element, kind
    type(fuge_mpi_halfspace_operator) :: shared, copy
    type(fuge_halfspace_operator) :: whole
    type(fuge_layered_body) :: body
    type(fuge_info) :: info
    integer :: k, rows(2)

    body = body_of(kind)
    call shared%set(nx, ny, 1.0_dp/nx, 1.5_dp/nx, body%e_star(), MPI_COMM_WORLD, info, element, boundary, &
                    body=body%surface())
    call expect(info%status == FUGE_DONE, trim(info%message))
    copy = shared
    rows = shared%own_rows()
    if (my_rank() == 0) then
      call whole%set(nx, ny, 1.0_dp/nx, 1.5_dp/nx, body%e_star(), info, element, boundary, body=body%surface())
      do k = 0, 3
        call expect(.not. abs(shared%wave_slope(k) - whole%wave_slope(k)) > 0.0_dp, 'the slope of waves')
      end do
    end if
    call compare_products(label('area', kind, boundary, element), 1.0e-15_dp, nx*(rows(1) - 1) + 1, shared, copy, whole)
  end subroutine area_products

  ! Products and preconditionings of forces that are not smooth, those of the points from `first` on, to `accuracy`; a
  ! copy has the same to the last digit.
  subroutine compare_products(name, accuracy, first, shared, copy, whole)
    character(len=*), intent(in) :: name
    real(dp), intent(in) :: accuracy
    integer, intent(in) :: first
    class(fuge_operator), intent(in) :: shared, copy, whole
    real(dp), allocatable :: force(:), all_force(:), displacement(:), of_copy(:), found(:), expected(:), magnitude(:)
    integer :: k, status

    allocate (force(shared%points()), displacement(shared%points()), of_copy(shared%points()))
    force = [(real(modulo(k*7919, 1009), dp)/1009.0_dp - 0.3_dp, k=first, first + shared%points() - 1)]
    call gather(force, all_force)
    allocate (expected(whole%points()), magnitude(whole%points()))
    call copy%apply(force, of_copy, status)
    do k = 1, 3
      if (k == 1) then
        call shared%apply(force, displacement, status)
        call expect(.not. any(abs(displacement - of_copy) > 0.0_dp), name//': a copy')
        if (my_rank() == 0) call whole%apply(all_force, expected, status)
      else if (k == 2) then
        call shared%precondition(force, displacement, status)
        if (my_rank() == 0) call whole%precondition(all_force, expected, status)
      else
        call shared%precondition_on_bed(3.0_dp, force, displacement, status)
        if (my_rank() == 0) call whole%precondition_on_bed(3.0_dp, all_force, expected, status)
      end if
      call expect(status == FUGE_DONE, name//': a product')
      call gather(displacement, found)
      if (my_rank() > 0) cycle
      magnitude = maxval(abs(expected))
      if (k == 1) call whole%magnitude(all_force, expected, magnitude)
      call expect(all(abs(found - expected) <= accuracy*magnitude), name//': the error of a product')
      write (*, '(a,i3,es10.2)') name, k, maxval(abs(found - expected)/magnitude)
    end do
  end subroutine compare_products

  ! A load, more of it, and a prescribed approach, on a wavy cylinder.
  subroutine solve_line(n, boundary, element, kind, load)
    integer, intent(in) :: n, boundary, element, kind
    real(dp), intent(in) :: load
    type(fuge_mpi_halfplane_operator) :: shared
    type(fuge_halfplane_operator) :: whole
    type(fuge_layered_body) :: body
    type(fuge_problem) :: problem, whole_problem
    type(fuge_info) :: info
    integer :: cells(2)

    body = body_of(kind)
    call shared%set(n, 1.0_dp/n, body%e_star(), MPI_COMM_WORLD, info, element, boundary, body=body%surface())
    cells = shared%own_rows()
    call fill(n, 1, cells(1), shared%points(), load, problem)
    if (my_rank() == 0) then
      call whole%set(n, 1.0_dp/n, body%e_star(), info, element, boundary, body=body%surface())
      call fill(n, 1, 1, n, load, whole_problem)
    end if
    ! On a film forces agree less well, but better than to the error that both estimate.
    call check_solves(label('line', kind, boundary, element), merge(5.0e-9_dp, 1.0e-15_dp*n, kind == FILM), 3, 3, &
                      shared, whole, problem, whole_problem)
  end subroutine solve_line

  ! The same on a wavy ball.
  subroutine solve_area(nx, ny, boundary, element, kind, load)
    integer, intent(in) :: nx, ny, boundary, element, kind
    real(dp), intent(in) :: load
    type(fuge_mpi_halfspace_operator) :: shared
    type(fuge_halfspace_operator) :: whole
    type(fuge_layered_body) :: body
    type(fuge_problem) :: problem, whole_problem
    type(fuge_info) :: info
    integer :: rows(2)

    body = body_of(kind)
    call shared%set(nx, ny, 1.0_dp/nx, 1.0_dp/nx, body%e_star(), MPI_COMM_WORLD, info, element, boundary, &
                    body=body%surface())
    rows = shared%own_rows()
    call fill(nx, ny, nx*(rows(1) - 1) + 1, shared%points(), load, problem)
    if (my_rank() == 0) then
      call whole%set(nx, ny, 1.0_dp/nx, 1.0_dp/nx, body%e_star(), info, element, boundary, body=body%surface())
      call fill(nx, ny, 1, nx*ny, load, whole_problem)
    end if
    call check_solves(label('area', kind, boundary, element), merge(1.0e-8_dp, 1.0e-9_dp, kind == FILM), 3, 3, shared, &
                      whole, problem, whole_problem)
  end subroutine solve_area

  ! Points first .. of a surface of nx columns: the gaps of a wavy paraboloid, and a load.
  pure subroutine fill(nx, ny, first, count, load, problem)
    integer, intent(in) :: nx, ny, first, count
    real(dp), intent(in) :: load
    type(fuge_problem), intent(out) :: problem
    real(dp) :: x, y
    integer :: k

    allocate (problem%gap(count))
    do k = 1, count
      x = (real(modulo(first + k - 2, nx), dp) + 0.5_dp)/nx - 0.5_dp
      y = 0.0_dp
      if (ny > 1) y = (real((first + k - 2)/nx, dp) + 0.5_dp)/ny - 0.45_dp
      problem%gap(k) = 0.5_dp*(x**2 + y**2) + 0.0005_dp*sin(44.0_dp*x + 0.4_dp)*cos(31.0_dp*y)
    end do
    problem%resultant = [load]
  end subroutine fill

  ! Bodies that differ between the ranks, in the lengths or in the moduli of layers, and a boundary that ranks do not
  ! share.
  subroutine refuse()
    character(len=*), parameter :: DIFFERS = 'the body differs between the ranks'
    type(fuge_mpi_halfplane_operator) :: line
    type(fuge_mpi_halfspace_operator) :: area
    type(fuge_layered_body) :: body, none
    type(fuge_info) :: info
    integer :: ranks

    body = body_of(SOFT)
    call area%set(200, 190, 1.0_dp, 1.0_dp, body%e_star(), MPI_COMM_WORLD, info, boundary=FUGE_PERIODIC_X, &
                  body=body%surface())
    call expect_refused(info, FUGE_ERR_UNSUPPORTED, 'boundary = ')
    call area%set(200, 190, 1.0_dp, 1.0_dp, none%e_star(), MPI_COMM_WORLD, info, body=none%surface())
    call expect_refused(info, FUGE_ERR_MODULUS, 'e_star = 0')
    call MPI_Comm_size(MPI_COMM_WORLD, ranks)
    if (ranks < 2) return
    call body%set([0.1_dp, 0.2_dp], [1.0_dp, merge(3.0_dp, 2.0_dp, my_rank() == 1), 9.0_dp], &
                  [0.3_dp, 0.3_dp, 0.3_dp], info)
    call line%set(1000, 1.0_dp, body%e_star(), MPI_COMM_WORLD, info, body=body%surface())
    call expect_refused(info, FUGE_ERR_OPTION, DIFFERS)
    call area%set(200, 190, 1.0_dp, 1.0_dp, body%e_star(), MPI_COMM_WORLD, info, body=body%surface())
    call expect_refused(info, FUGE_ERR_OPTION, DIFFERS)
    call body%set([merge(0.2_dp, 0.1_dp, my_rank() == 0)], [1.0_dp, 9.0_dp], [0.3_dp, 0.3_dp], info)
    call line%set(1000, 1.0_dp, 1.0_dp, MPI_COMM_WORLD, info, body=body%surface())
    call expect_refused(info, FUGE_ERR_OPTION, DIFFERS)
    body = body_of(SOFT)
    if (my_rank() == 1) then
      call area%set(200, 190, 1.0_dp, 1.0_dp, body%e_star(), MPI_COMM_WORLD, info)
    else
      call area%set(200, 190, 1.0_dp, 1.0_dp, body%e_star(), MPI_COMM_WORLD, info, body=body%surface())
    end if
    call expect_refused(info, FUGE_ERR_OPTION, DIFFERS)
  end subroutine refuse

  subroutine expect_refused(info, status, message)
    type(fuge_info), intent(in) :: info
    integer, intent(in) :: status
    character(len=*), intent(in) :: message

    call expect(info%status == status .and. index(info%message, message) == 1, message//' / '//trim(info%message))
  end subroutine expect_refused

end program layers
