!> A ball, or a surface from a file, pressed on an elastic half-space that the ranks of an MPI program share.
!>
!>     mpirun -n 4 surface_mpi [cells [heights.npy [pressures.npy]]]
!>
!> `cells` x `cells` on a square of the side 1, 512 unless given. Without a file the surface is a ball of radius 1,
!> whose contact has the radius 0.3 by Hertz; with heights.npy, which numpy.save wrote as an array (cells, cells), the
!> heights count upwards in units of the side, and the load is the same. No rank holds the whole surface: each makes, or
!> reads, its own rows, and writes them to pressures.npy, in units of E*.
program surface_mpi
  use fuge, only: dp => fuge_dp, fuge_info, fuge_options, fuge_problem, fuge_solution, fuge_solver
  use fuge_mpi, only: fuge_mpi_halfspace_operator, fuge_mpi_read_rows, fuge_mpi_write_rows
  use mpi_f08, only: MPI_Abort, MPI_Allreduce, MPI_Comm_rank, MPI_Comm_size, MPI_Finalize, MPI_Init, &
    MPI_COMM_WORLD, MPI_DOUBLE_PRECISION, MPI_IN_PLACE, MPI_MAX, MPI_SUM
  implicit none

  !> Hertz: the contact radius; with R = 1 and E* = 1 the load is 4 a**3/3 and the approach a**2.
  real(dp), parameter :: RADIUS = 0.3_dp
  integer :: rank, ranks

  call MPI_Init()
  call MPI_Comm_rank(MPI_COMM_WORLD, rank)
  call MPI_Comm_size(MPI_COMM_WORLD, ranks)
  call run()
  call MPI_Finalize()

contains

  subroutine run()
    type(fuge_mpi_halfspace_operator) :: operator
    type(fuge_problem) :: problem
    type(fuge_solution) :: solution
    type(fuge_solver) :: solver
    type(fuge_info) :: file_info, info
    real(dp) :: sums(2), largest, spacing
    integer :: cells

    cells = 512
    call operator_of(word(1), cells, operator, info)
    if (info%failed()) call give_up(info)
    spacing = 1.0_dp/real(cells, dp)
    call find_gap(operator, cells, problem%gap)
    problem%resultant = [4.0_dp*RADIUS**3/3.0_dp]
    call solver%solve(operator, problem, solution, info, fuge_options(tolerance=1.0e-8_dp))
    if (info%failed()) call give_up(info)

    sums = [sum(solution%force), real(count(solution%force > 0.0_dp), dp)*spacing**2]
    call MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE_PRECISION, MPI_SUM, MPI_COMM_WORLD)
    largest = max(0.0_dp, maxval(solution%force))/spacing**2
    call MPI_Allreduce(MPI_IN_PLACE, largest, 1, MPI_DOUBLE_PRECISION, MPI_MAX, MPI_COMM_WORLD)
    if (word(3) /= '') call fuge_mpi_write_rows(trim(word(3)), operator, solution%force/spacing**2, &
                                                   file_info)
    if (file_info%failed()) call give_up(file_info)
    if (rank > 0) return
    print '(i0,a,i0,a,i0,a)', cells, ' x ', cells, ' cells on ', ranks, ' rank(s)'
    print '(a,f9.6,a,f9.6,a,f9.6,a,f9.6)', 'load     ', sums(1), '  approach', solution%motion(1), '  area', sums(2), &
      '  largest pressure', largest
    if (word(2) == '') print '(a,f9.6,a,f9.6,a,f9.6,a,f9.6)', 'of Hertz:', 4*RADIUS**3/3, '  approach', RADIUS**2, &
      '  area', acos(-1.0_dp)*RADIUS**2, '  largest pressure', 2*RADIUS/acos(-1.0_dp)
    print '(i0,a,i0,a,es9.2)', info%products, ' products, ', info%preconditionings, ' preconditionings, residual', &
      info%residual
  end subroutine run

  !> The operator of `cells` x `cells`, as many as `field` says if it is not blank.
  subroutine operator_of(field, cells, operator, info)
    character(len=*), intent(in) :: field
    integer, intent(inout) :: cells
    type(fuge_mpi_halfspace_operator), intent(inout) :: operator
    type(fuge_info), intent(out) :: info

    if (field /= '') read (field, *) cells
    call operator%set(cells, cells, 1.0_dp/cells, 1.0_dp/cells, 1.0_dp, MPI_COMM_WORLD, info)
  end subroutine operator_of

  !> The gaps of the rows of this rank.
  subroutine find_gap(operator, cells, gap)
    type(fuge_mpi_halfspace_operator), intent(in) :: operator
    integer, intent(in) :: cells
    real(dp), allocatable, intent(inout) :: gap(:)
    type(fuge_info) :: info
    integer :: i, j, rows(2)

    if (word(2) /= '') then
      call fuge_mpi_read_rows(trim(word(2)), operator, gap, info)
      if (info%failed()) call give_up(info)
      ! The surface faces upwards: where it is high, the gap to the flat body above is small.
      gap = -gap
      return
    end if
    rows = operator%own_rows()
    allocate (gap(operator%points()))
    do j = rows(1), rows(2)
      do i = 1, cells
        gap(i + cells*(j - rows(1))) = 0.5_dp*(((i - 0.5_dp)/cells - 0.5_dp)**2 + ((j - 0.5_dp)/cells - 0.5_dp)**2)
      end do
    end do
  end subroutine find_gap

  !> Argument number `k`, or blank.
  function word(k)
    integer, intent(in) :: k
    character(len=256) :: word

    call get_command_argument(k, word)
  end function word

  !> All ranks come here together, because errors are those of all of them.
  subroutine give_up(info)
    type(fuge_info), intent(in) :: info

    if (rank == 0) print '(a)', trim(info%message)
    call MPI_Abort(MPI_COMM_WORLD, 1)
  end subroutine give_up

end program surface_mpi
