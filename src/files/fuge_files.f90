!> The public interface of the component files: results on grids and meshes for ParaView.
module fuge_files
  use fuge_mesh_making, only: fuge_join_meshes, fuge_make_mesh
  use fuge_mesh_type, only: fuge_mesh, fuge_mesh_field
  use fuge_mesh_writer, only: fuge_write_mesh
  use fuge_result_files, only: fuge_write_results, fuge_write_volume
  implicit none
  public

end module fuge_files
