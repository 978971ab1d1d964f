! The ranks of MPI_COMM_WORLD find the solution of one process without products in single precision: the same contact
! set, forces and counts, on areas nearly.
program same_answer
  use fuge_cell_elements, only: FUGE_FREE, FUGE_PERIODIC
  use fuge_halfspace_fft, only: fuge_halfspace_operator
  use fuge_kinds, only: dp
  use fuge_mpi, only: fuge_mpi_halfspace_operator
  use fuge_problem_type, only: fuge_problem
  use fuge_status, only: fuge_info, FUGE_DONE
  use lone_rank, only: lone_surface
  use mpi_f08
  use rank_checks, only: begin_checks, check_solves, end_checks, expect, gather, my_rank
  implicit none

  call begin_checks()
  call run()
  call end_checks()

contains

  subroutine run()
    ! Sizes that 2, 3 and 4 divide and do not divide, grids with fewer rows than ranks, one row, one column, one cell.
    call compare('free', 200, 192, FUGE_FREE, 1.0_dp, 0.02_dp, 1)
    call compare('free, uneven', 211, 177, FUGE_FREE, 1.0_dp, 0.02_dp, 3)
    call compare('free, small contact', 300, 310, FUGE_FREE, 1.0_dp, 0.00002_dp, 3)
    call compare('free, three rows', 9000, 3, FUGE_FREE, 1.0_dp, 0.00001_dp, 1)
    call compare('free, small', 70, 45, FUGE_FREE, 1.0_dp, 0.01_dp, 1)
    call compare('one row', 200, 1, FUGE_FREE, 1.0_dp, 0.01_dp, 1)
    call compare('one column', 1, 200, FUGE_FREE, 1.0_dp, 0.01_dp, 1)
    call compare('one cell', 1, 1, FUGE_FREE, 1.0_dp, 0.01_dp, 1)
    call compare('periodic', 200, 180, FUGE_PERIODIC, 0.0_dp, 0.0005_dp, 1)
    call compare('periodic, uneven', 135, 301, FUGE_PERIODIC, 0.0_dp, 0.0005_dp, 3)
    call compare('periodic, small contact', 300, 300, FUGE_PERIODIC, 4.0_dp, 0.00001_dp, 1)
    call compare('no load', 256, 200, FUGE_FREE, 1.0_dp, 0.0_dp, 1)
    ! So many that rows travel in several messages.
    call compare_products('free, products', 640, 2001, FUGE_FREE)
    call compare_products('periodic, products', 640, 2001, FUGE_PERIODIC)
  end subroutine run

  ! Products and preconditionings are those of one process.
  subroutine compare_products(name, nx, ny, boundary)
    character(len=*), intent(in) :: name
    integer, intent(in) :: nx, ny, boundary
    type(fuge_mpi_halfspace_operator) :: shared
    type(fuge_halfspace_operator) :: whole
    type(fuge_info) :: info
    real(dp), allocatable :: x(:), y(:), z(:), expected(:), found(:)
    integer :: k, rows(2), status

    call shared%set(nx, ny, 1.0_dp, 1.5_dp, 1.0_dp, MPI_COMM_WORLD, info, boundary=boundary)
    call whole%set(nx, ny, 1.0_dp, 1.5_dp, 1.0_dp, info, boundary=boundary)
    call expect(info%status == FUGE_DONE, name//': '//trim(info%message))
    if (info%failed()) return
    rows = shared%own_rows()
    allocate (x(shared%points()), y(shared%points()), z(nx*ny), expected(nx*ny))
    call fill_gap(nx, ny, rows(1), rows(2), 1.0_dp, x)
    call fill_gap(nx, ny, 1, ny, 1.0_dp, z)
    call expect(shared%has_preconditioner_on_bed(), name//': beds')
    do k = 1, 3
      if (k == 1) call shared%apply(x, y, status)
      if (k == 2) call shared%precondition(x, y, status)
      if (k == 3) call shared%precondition_on_bed(3.0_dp, x, y, status)
      call expect(status == FUGE_DONE, name//': status')
      if (k == 1) call whole%apply(z, expected, status)
      if (k == 2) call whole%precondition(z, expected, status)
      if (k == 3) call whole%precondition_on_bed(3.0_dp, z, expected, status)
      call gather(y, found)
      if (my_rank() > 0) cycle
      call expect(maxval(abs(found - expected)) <= 4.0_dp*epsilon(1.0_dp)*maxval(abs(expected)), name)
      write (*, '(a24,i6,es10.2)') name, k, maxval(abs(found - expected))/maxval(abs(expected))
    end do
  end subroutine compare_products

  ! The gaps of the rows first .. last of a wavy sphere, or of waves, on a grid whose longer side is 1.
  pure subroutine fill_gap(nx, ny, first, last, curvature, gap)
    integer, intent(in) :: nx, ny, first, last
    real(dp), intent(in) :: curvature
    real(dp), intent(out) :: gap(nx, first:last)
    real(dp) :: x, y
    integer :: i, j

    do j = first, last
      do i = 1, nx
        x = (real(i, dp) - 0.5_dp*real(nx, dp))/real(max(nx, ny), dp)
        y = (real(j, dp) - 0.4_dp*real(ny, dp))/real(max(nx, ny), dp)
        gap(i, j) = 0.5_dp*curvature*(x**2 + y**2) + 0.002_dp*sin(44.0_dp*x)*cos(31.0_dp*y)
      end do
    end do
  end subroutine fill_gap

  ! A load, more of it from the first solution, and a prescribed approach: the first `solves` of them.
  subroutine compare(name, nx, ny, boundary, curvature, load, solves)
    character(len=*), intent(in) :: name
    integer, intent(in) :: nx, ny, boundary, solves
    real(dp), intent(in) :: curvature, load
    type(fuge_mpi_halfspace_operator) :: shared
    type(lone_surface) :: whole
    type(fuge_problem) :: problem, whole_problem
    type(fuge_info) :: info
    integer :: rows(2)

    call shared%set(nx, ny, 1.0_dp/max(nx, ny), 1.0_dp/max(nx, ny), 1.0_dp, MPI_COMM_WORLD, info, boundary=boundary)
    call expect(info%status == FUGE_DONE, name//': '//trim(info%message))
    if (info%failed()) return
    rows = shared%own_rows()
    allocate (problem%gap(shared%points()))
    call fill_gap(nx, ny, rows(1), rows(2), curvature, problem%gap)
    problem%resultant = [load]
    if (my_rank() == 0) then
      call whole%surface%set(nx, ny, 1.0_dp/max(nx, ny), 1.0_dp/max(nx, ny), 1.0_dp, info, boundary=boundary)
      allocate (whole_problem%gap(nx*ny))
      call fill_gap(nx, ny, 1, ny, curvature, whole_problem%gap)
      whole_problem%resultant = [load]
    end if
    ! Ranks add up in single precision what extends a contact set of an area.
    call check_solves(name, merge(1.0e-9_dp, 1.0e-12_dp, min(nx, ny) > 1), merge(3, 0, min(nx, ny) > 1), solves, &
                      shared, whole, problem, whole_problem)
  end subroutine compare

end program same_answer
