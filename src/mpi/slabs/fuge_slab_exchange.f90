!> Exchange of a matrix whose rows the ranks share for one whose columns they share, and back.
!>
!> An element has several numbers. Each row is written in pieces, one for each rank that has some of its columns, and a
!> message carries the pieces of some rows to where their columns are read, row after row. So nothing is transposed or
!> copied in memory, what a rank keeps does not move at all, and messages travel while further rows are computed.
module fuge_slab_exchange
  use, intrinsic :: iso_c_binding, only: c_intptr_t
  use fuge_kinds, only: wp => dp
  use fuge_rank_communicator, only: rank_communicator
  use mpi_f08, only: MPI_Irecv, MPI_Isend, MPI_Request, MPI_Testall, MPI_Waitall, MPI_STATUSES_IGNORE, &
    NUMBER => MPI_DOUBLE_PRECISION
  implicit none
  private

  include 'fuge_slab_exchange.inc'

end module fuge_slab_exchange
