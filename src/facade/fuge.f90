!> The whole public interface of fuge, frictionless elastic contact.
module fuge
  use fuge_bodies_solution, only: fuge_bodies_contact, fuge_solve_bodies
  use fuge_body_joining, only: fuge_join_bodies, fuge_joined_bodies
  use fuge_body_type, only: fuge_body
  use fuge_cell_grading, only: fuge_graded_cells, FUGE_END_CORNER, FUGE_END_EDGE, FUGE_END_PLAIN
  use fuge_certificate, only: fuge_residual, fuge_violation
  use fuge_condensation, only: fuge_condense, fuge_condensed
  use fuge_contact_pairs_search, only: fuge_find_pairs
  use fuge_contact_pairs_type, only: fuge_contact_pairs, fuge_pair_options, FUGE_MORTAR, FUGE_NODE_TO_FACE, &
    FUGE_NORMALS_AVERAGED, FUGE_NORMALS_GIVEN, FUGE_NORMALS_OPPOSITE
  use fuge_contact_path, only: fuge_follow_path, fuge_load_path
  use fuge_contact_states, only: FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, FUGE_OPEN
  use fuge_edge_refinement, only: fuge_contact_edges, fuge_interval, FUGE_EDGE_REFINED, FUGE_EDGE_FEW_CELLS, &
    FUGE_EDGE_SINGULAR, FUGE_EDGE_GRID_END
  use fuge_elastic_body_type, only: fuge_elastic_body, fuge_surface_pair
  use fuge_elastic_moduli, only: fuge_plane_modulus, fuge_combined_modulus, fuge_displacement_shares, &
    FUGE_PLANE_STRAIN, FUGE_PLANE_STRESS
  use fuge_field_files, only: fuge_write_fields, fuge_write_volume
  use fuge_halfplane_depths, only: fuge_halfplane_displacement_grid, fuge_halfplane_stress_grid
  use fuge_halfplane_fft, only: fuge_halfplane_operator
  use fuge_halfplane_influence, only: fuge_halfplane_matrix, FUGE_CENTRE, FUGE_MEAN, FUGE_HAT
  use fuge_halfplane_interior, only: fuge_halfplane_displacement, fuge_halfplane_stress
  use fuge_halfplane_line, only: FUGE_FREE, FUGE_PERIODIC
  use fuge_halfplane_peak_search, only: fuge_halfplane_peak, fuge_smooth_peak
  use fuge_halfspace_depths, only: fuge_halfspace_displacement_grid, fuge_halfspace_stress_grid
  use fuge_halfspace_fft, only: fuge_halfspace_operator
  use fuge_halfspace_grid, only: FUGE_PERIODIC_X, FUGE_PERIODIC_Y
  use fuge_halfspace_influence, only: fuge_halfspace_matrix
  use fuge_halfspace_interior, only: fuge_halfspace_displacement, fuge_halfspace_stress
  use fuge_halfspace_peak_search, only: fuge_halfspace_peak
  use fuge_hertz_theory, only: fuge_hertz_contact, fuge_hertz_ellipse
  use fuge_history_type, only: fuge_history
  use fuge_kinds, only: fuge_dp
  use fuge_matrix_market_reader, only: fuge_read_matrix, fuge_read_sparse
  use fuge_matrix_market_writer, only: fuge_write_matrix, fuge_write_sparse
  use fuge_matrix_operator, only: fuge_dense_operator
  use fuge_mesh_files, only: fuge_read_mesh
  use fuge_mesh_making, only: fuge_join_meshes, fuge_make_mesh
  use fuge_mesh_rows, only: fuge_mesh_contact_surface, fuge_mesh_degrees
  use fuge_mesh_sets, only: fuge_mesh_element_set, fuge_mesh_faces, fuge_mesh_node_set
  use fuge_mesh_type, only: fuge_mesh, fuge_mesh_field, fuge_mesh_set, fuge_mesh_surface
  use fuge_mesh_writer, only: fuge_write_mesh
  use fuge_monitor_type, only: fuge_monitor
  use fuge_nodal_modes, only: fuge_rigid_modes
  use fuge_operator_type, only: fuge_operator
  use fuge_options_type, only: fuge_options, FUGE_AUTO, FUGE_TABLEAU, FUGE_ACTIVE_SET, FUGE_ITERATIVE, &
    FUGE_PAPER_RULE, FUGE_MOST_NEGATIVE, FUGE_GREATEST_DECREASE
  use fuge_path_type, only: fuge_path
  use fuge_power_profile_type, only: fuge_power_profile
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_profile_files, only: fuge_read_profile
  use fuge_profile_sampling, only: fuge_level_profile, fuge_sample_profile, FUGE_LEVEL_LINE, FUGE_LEVEL_MEAN
  use fuge_ring_influence, only: fuge_ring_displacement, fuge_ring_matrix
  use fuge_ring_interior, only: fuge_ring_interior_displacement, fuge_ring_stress
  use fuge_round_contact_type, only: fuge_round_contact
  use fuge_round_interior, only: fuge_round_displacement, fuge_round_stress
  use fuge_round_peak_search, only: fuge_ring_peak, fuge_round_peak
  use fuge_round_punch, only: fuge_solve_round_punch
  use fuge_smooth_contact_type, only: fuge_smooth_contact
  use fuge_smooth_interior, only: fuge_smooth_displacement, fuge_smooth_stress
  use fuge_smooth_profile_type, only: fuge_smooth_profile, fuge_polynomial_profile, fuge_sampled_profile
  use fuge_smooth_punch, only: fuge_solve_smooth_punch
  use fuge_solver_type, only: fuge_solver, fuge_solve_dense
  use fuge_status, only: fuge_info, fuge_status_text, FUGE_MESSAGE_LENGTH, &
    FUGE_DONE, FUGE_WARN_RESIDUAL, FUGE_WARN_NOT_UNIQUE, FUGE_WARN_ILL_CONDITIONED, FUGE_WARN_PAIRS, &
    FUGE_WARN_NO_CONTACT, FUGE_ERR_SIZE, FUGE_ERR_POINTER, FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH, FUGE_ERR_MODULUS, &
    FUGE_ERR_ELEMENT, FUGE_ERR_GRID, FUGE_ERR_NOT_SYMMETRIC, &
    FUGE_ERR_NOT_DEFINITE, FUGE_ERR_NO_EQUILIBRIUM, FUGE_ERR_ITERATION_LIMIT, FUGE_ERR_MEMORY, FUGE_ERR_CALL_ORDER, &
    FUGE_ERR_OPTION, FUGE_ERR_UNSUPPORTED, FUGE_ERR_OVERFLOW, FUGE_ERR_CALLBACK, FUGE_ERR_CANCELLED, FUGE_ERR_FILE, &
    FUGE_ERR_GAP, FUGE_ERR_MODES, FUGE_ERR_DOF, FUGE_ERR_MESH
  use fuge_stiffness_band, only: fuge_band_stiffness
  use fuge_stiffness_dense, only: fuge_dense_stiffness
  use fuge_stiffness_files, only: fuge_read_stiffness
  use fuge_stiffness_formats, only: FUGE_STIFFNESS_ANY, FUGE_STIFFNESS_MATRIX_MARKET, FUGE_STIFFNESS_CALCULIX, &
    FUGE_STIFFNESS_ABAQUS, FUGE_STIFFNESS_DMIG, FUGE_STIFFNESS_OP4
  use fuge_stiffness_type, only: fuge_stiffness
  use fuge_stress_measures, only: fuge_halfplane_tensor, fuge_round_tensor, fuge_principal_stresses, fuge_von_mises, &
    fuge_tresca, fuge_mean_stress
  use fuge_stress_peak_type, only: fuge_stress_peak, FUGE_MEASURE_TRESCA, FUGE_MEASURE_VON_MISES, FUGE_PEAK_INSIDE, &
    FUGE_PEAK_SINGULAR, FUGE_PEAK_SURFACE
  use fuge_surface_files, only: fuge_read_surface, fuge_write_surface
  use fuge_surface_filling, only: fuge_fill_surface
  use fuge_surface_levelling, only: fuge_level_surface, FUGE_LEVEL_PLANE
  use fuge_surface_mesh_type, only: fuge_surface_mesh
  use fuge_surface_type, only: fuge_surface, FUGE_FILE_ANY, FUGE_FILE_GRID, FUGE_FILE_POINTS, FUGE_FILE_SDF
  use fuge_version_number, only: FUGE_VERSION
  implicit none
  public

end module fuge
