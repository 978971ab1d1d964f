!> The public interface of the component files: files of profiles, surfaces, matrices, meshes, decks
!> and results.
module fuge_files
  use fuge_deck_files, only: fuge_read_deck
  use fuge_deck_rows, only: fuge_deck_links, fuge_deck_loads, fuge_deck_supports
  use fuge_deck_tables, only: fuge_read_cases, fuge_read_links, fuge_read_supports
  use fuge_deck_type, only: fuge_deck, fuge_deck_case, fuge_deck_link, fuge_deck_value
  use fuge_result_files, only: fuge_write_results, fuge_write_volume
  use fuge_matrix_market_reader, only: fuge_read_matrix, fuge_read_sparse
  use fuge_matrix_market_writer, only: fuge_write_matrix, fuge_write_sparse
  use fuge_mesh_files, only: fuge_read_mesh
  use fuge_mesh_making, only: fuge_join_meshes, fuge_make_mesh
  use fuge_mesh_rows, only: fuge_mesh_contact_surface, fuge_mesh_degrees
  use fuge_mesh_sets, only: fuge_mesh_element_set, fuge_mesh_faces, fuge_mesh_node_set
  use fuge_mesh_type, only: fuge_mesh, fuge_mesh_field, fuge_mesh_set, fuge_mesh_surface
  use fuge_mesh_writer, only: fuge_write_mesh
  use fuge_profile_files, only: fuge_read_profile
  use fuge_profile_sampling, only: fuge_level_profile, fuge_sample_profile, FUGE_LEVEL_LINE, FUGE_LEVEL_MEAN
  use fuge_stiffness_files, only: fuge_read_stiffness
  use fuge_stiffness_formats, only: FUGE_STIFFNESS_ANY, FUGE_STIFFNESS_MATRIX_MARKET, FUGE_STIFFNESS_CALCULIX, &
    FUGE_STIFFNESS_ABAQUS, FUGE_STIFFNESS_DMIG, FUGE_STIFFNESS_OP4
  use fuge_surface_files, only: fuge_read_surface, fuge_write_surface
  use fuge_surface_filling, only: fuge_fill_surface
  use fuge_surface_levelling, only: fuge_level_surface, FUGE_LEVEL_PLANE
  use fuge_surface_type, only: fuge_surface, FUGE_FILE_ANY, FUGE_FILE_GRID, FUGE_FILE_POINTS, FUGE_FILE_SDF
  implicit none
  public

end module fuge_files
