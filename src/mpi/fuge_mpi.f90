!> Surfaces over MPI: the public interface of the component, a library of its own.
!>
!> The ranks of a communicator share the rows of a grid, or the cells of a line; a `fuge_solver` on each of them solves
!> as one process does.
module fuge_mpi
  use fuge_line_halfplane, only: fuge_mpi_halfplane_operator
  use fuge_slab_files, only: fuge_mpi_read_rows, fuge_mpi_write_rows
  use fuge_slab_halfspace, only: fuge_mpi_halfspace_operator
  implicit none
  public
end module fuge_mpi
