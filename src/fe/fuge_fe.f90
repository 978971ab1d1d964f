!> The public interface of the component fe: bodies of finite elements.
module fuge_fe
  use fuge_bodies_solution, only: fuge_bodies_contact, fuge_solve_bodies
  use fuge_body_joining, only: fuge_join_bodies, fuge_joined_bodies
  use fuge_body_type, only: fuge_body
  use fuge_condensation, only: fuge_condense, fuge_condensed
  use fuge_contact_pairs_search, only: fuge_find_pairs
  use fuge_contact_pairs_type, only: fuge_contact_pairs, fuge_pair_options, FUGE_MORTAR, FUGE_NODE_TO_FACE, &
    FUGE_NORMALS_AVERAGED, FUGE_NORMALS_GIVEN, FUGE_NORMALS_OPPOSITE
  use fuge_elastic_body_type, only: fuge_elastic_body, fuge_surface_pair
  use fuge_links_type, only: fuge_link_law, fuge_links, fuge_member, FUGE_COMPRESSION_ONLY, FUGE_TENSION_ONLY
  use fuge_mechanism_words, only: fuge_describe_mechanism
  use fuge_member_stiffness, only: fuge_remove_member
  use fuge_nodal_modes, only: fuge_rigid_modes
  use fuge_stiffness_band, only: fuge_band_stiffness
  use fuge_stiffness_dense, only: fuge_dense_stiffness
  use fuge_stiffness_type, only: fuge_stiffness
  use fuge_structure_mechanism, only: fuge_find_mechanism
  use fuge_surface_mesh_type, only: fuge_surface_mesh
  use fuge_unbalanced_motion, only: fuge_find_unbalanced_motion
  implicit none
  public

end module fuge_fe
