!> The exchanges of fuge_slab_exchange in single precision: half the bytes.
module fuge_single_slab_exchange
  use, intrinsic :: iso_c_binding, only: c_intptr_t
  use fuge_kinds, only: wp => sp
  use fuge_rank_communicator, only: rank_communicator
  use mpi_f08, only: MPI_Irecv, MPI_Isend, MPI_Request, MPI_Testall, MPI_Waitall, MPI_STATUSES_IGNORE, &
    NUMBER => MPI_REAL
  implicit none
  private

  include 'fuge_slab_exchange.inc'

end module fuge_single_slab_exchange
