! A half-plane whose cells the ranks of MPI_COMM_WORLD share has the products and the solutions of that of one process.
program lines
  use fuge_cell_elements, only: FUGE_CENTRE, FUGE_MEAN, FUGE_FREE, FUGE_PERIODIC
  use fuge_halfplane_fft, only: fuge_halfplane_operator
  use fuge_kinds, only: dp
  use fuge_mpi, only: fuge_mpi_halfplane_operator
  use fuge_problem_type, only: fuge_problem
  use fuge_status, only: fuge_info, FUGE_DONE
  use mpi_f08
  use rank_checks, only: begin_checks, check_solves, end_checks, expect, gather, my_rank
  implicit none

  ! The forces of n cells in contact change by about n times as much as the gaps do, and these are rounded.
  real(dp), parameter :: ROUNDING = 1.0e-15_dp

  call begin_checks()
  call run()
  call end_checks()

contains

  subroutine run()
    ! Numbers that the ranks divide and do not divide, fewer than a rank has, one, primes.
    call compare_products(65536, FUGE_FREE, FUGE_MEAN)
    call compare_products(50021, FUGE_FREE, FUGE_CENTRE)
    call compare_products(51480, FUGE_PERIODIC, FUGE_MEAN)
    call compare_products(2*25013, FUGE_PERIODIC, FUGE_MEAN)
    call compare_products(50021, FUGE_PERIODIC, FUGE_CENTRE)
    call compare_products(7, FUGE_FREE, FUGE_MEAN)
    call compare('free', 65536, FUGE_FREE, 1.0_dp, 0.01_dp, 3, 400.0_dp)
    call compare('free, uneven', 50021, FUGE_FREE, 1.0_dp, 0.003_dp, 3, 90.0_dp)
    call compare('free, smooth', 70000, FUGE_FREE, 1.0_dp, 0.1_dp, 1, 0.0_dp)
    call compare('free, few cells', 1000, FUGE_FREE, 1.0_dp, 0.01_dp, 1, 90.0_dp)
    call compare('three cells', 3, FUGE_FREE, 1.0_dp, 0.01_dp, 1, 90.0_dp)
    call compare('one cell', 1, FUGE_FREE, 1.0_dp, 0.01_dp, 1, 90.0_dp)
    call compare('periodic', 61440, FUGE_PERIODIC, 0.0_dp, 0.001_dp, 3, 40.0_dp)
    call compare('periodic, a prime number', 50021, FUGE_PERIODIC, 0.0_dp, 0.0005_dp, 1, 90.0_dp)
    call compare('periodic, one contact', 2**16, FUGE_PERIODIC, 1.0_dp, 0.001_dp, 1, 0.0_dp)
    call compare('no load', 65536, FUGE_FREE, 1.0_dp, 0.0_dp, 1, 90.0_dp)
  end subroutine run

  ! The gaps of the cells first .. last of a wavy cylinder, or of waves, on a line of length 1.
  pure subroutine fill_gap(n, first, curvature, waves, gap)
    integer, intent(in) :: n, first
    real(dp), intent(in) :: curvature, waves
    real(dp), intent(out) :: gap(:)
    real(dp) :: x
    integer :: k

    do k = 1, size(gap)
      x = (real(first + k - 1, dp) - 0.45_dp*real(n, dp))/real(n, dp)
      gap(k) = 0.5_dp*curvature*x**2 + 0.0003_dp*sin(waves*x)*cos(0.731_dp*waves*x + 0.3_dp)*exp(0.2_dp*x)
    end do
  end subroutine fill_gap

  ! Products and preconditionings of forces that are not smooth, to rounding of their terms.
  subroutine compare_products(n, boundary, element)
    integer, intent(in) :: n, boundary, element
    type(fuge_mpi_halfplane_operator) :: shared
    type(fuge_halfplane_operator) :: whole
    type(fuge_info) :: info
    real(dp), allocatable :: force(:), all_force(:), displacement(:), found(:), expected(:), magnitude(:)
    integer :: k, rows(2), status

    call shared%set(n, 1.0_dp, 1.0_dp, MPI_COMM_WORLD, info, element=element, boundary=boundary)
    call expect(info%status == FUGE_DONE, trim(info%message))
    rows = shared%own_rows()
    allocate (force(shared%points()), displacement(shared%points()))
    force = [(real(modulo(k*7919, 1009), dp)/1009.0_dp - 0.3_dp, k=rows(1), rows(2))]
    call gather(force, all_force)
    if (my_rank() == 0) call whole%set(n, 1.0_dp, 1.0_dp, info, element=element, boundary=boundary)
    allocate (expected(whole%points()), magnitude(whole%points()))
    call expect(shared%has_preconditioner_on_bed(), 'beds')
    do k = 1, 3
      if (k == 1) then
        call shared%apply(force, displacement, status)
        if (my_rank() == 0) call whole%apply(all_force, expected, status)
      else if (k == 2) then
        call shared%precondition(force, displacement, status)
        if (my_rank() == 0) call whole%precondition(all_force, expected, status)
      else
        call shared%precondition_on_bed(3.0_dp, force, displacement, status)
        if (my_rank() == 0) call whole%precondition_on_bed(3.0_dp, all_force, expected, status)
      end if
      call expect(status == FUGE_DONE, 'a product')
      call gather(displacement, found)
      if (my_rank() > 0) cycle
      magnitude = maxval(abs(expected))
      if (k == 1) call whole%magnitude(all_force, expected, magnitude)
      call expect(all(abs(found - expected) <= 4.0e-15_dp*magnitude), 'the error of a product')
      write (*, '(a,i0,a,i0,es10.2)') 'product ', n, ', ', boundary, maxval(abs(found - expected)/magnitude)
    end do
    if (my_rank() == 0) call expect(abs(shared%datum() - whole%datum()) <= 1.0e-12_dp*abs(whole%datum()), 'the datum')
  end subroutine compare_products

  ! A load, more of it from the first solution, and a prescribed approach: the first `solves` of them.
  subroutine compare(name, n, boundary, curvature, load, solves, waves)
    character(len=*), intent(in) :: name
    integer, intent(in) :: n, boundary, solves
    real(dp), intent(in) :: curvature, load, waves
    type(fuge_mpi_halfplane_operator) :: shared
    type(fuge_halfplane_operator) :: whole
    type(fuge_problem) :: problem, whole_problem
    type(fuge_info) :: info
    integer :: rows(2)

    call shared%set(n, 1.0_dp/n, 1.0_dp, MPI_COMM_WORLD, info, boundary=boundary)
    call expect(info%status == FUGE_DONE, name//': '//trim(info%message))
    if (info%failed()) return
    rows = shared%own_rows()
    allocate (problem%gap(shared%points()))
    call fill_gap(n, rows(1), curvature, waves, problem%gap)
    problem%resultant = [load]
    if (my_rank() == 0) then
      call whole%set(n, 1.0_dp/n, 1.0_dp, info, boundary=boundary)
      allocate (whole_problem%gap(n))
      call fill_gap(n, 1, curvature, waves, whole_problem%gap)
      whole_problem%resultant = [load]
    end if
    ! Transforms of lines round otherwise on several ranks than on one.
    call check_solves(name, max(1.0e-12_dp, ROUNDING*n), 3, solves, shared, whole, problem, whole_problem)
  end subroutine compare

end program lines
