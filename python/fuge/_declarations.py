"""The C functions: `name: result parameters`, in the codes of fuge._library; a test compares them with the headers."""

DECLARATIONS = """
fuge_halfspace_matrix: int int doubles doubles doubles doubles double int int int doubles int buffer size_t
fuge_operator_halfspace: int int int double double double int int fuge_operator* buffer size_t
fuge_ring_matrix: int int doubles double int doubles int buffer size_t
fuge_ring_displacement: int int doubles doubles double int doubles doubles buffer size_t
fuge_hertz_ellipse: int double double double double doubles doubles doubles doubles buffer size_t
fuge_status_text: text int
fuge_version: text
fuge_default_options: void fuge_options
fuge_solve_dense: int int doubles int doubles double doubles doubles doubles buffer size_t
fuge_plane_modulus: int double double int doubles buffer size_t
fuge_combined_modulus: int double double doubles buffer size_t
fuge_displacement_shares: int double double doubles doubles buffer size_t
fuge_halfplane_matrix: int int doubles doubles double int int doubles int buffer size_t
fuge_graded_cells: int double double int int int int int doubles doubles buffer size_t
fuge_contact_edges: int int doubles doubles doubles int int int doubles doubles doubles doubles ints ints ints buffer
  size_t
fuge_operator_dense: int int doubles int fuge_operator* buffer size_t
fuge_operator_callback: int int fuge_apply user fuge_operator* buffer size_t
fuge_operator_set_preconditioner: int fuge_operator fuge_apply buffer size_t
fuge_operator_set_diagonal: int fuge_operator doubles buffer size_t
fuge_operator_set_grid: int fuge_operator int int buffer size_t
fuge_operator_set_coarser: int fuge_operator fuge_operator buffer size_t
fuge_operator_set_auxiliary: int fuge_operator fuge_operator buffer size_t
fuge_operator_set_coefficients: int fuge_operator double double buffer size_t
fuge_operator_halfplane: int int double double int int fuge_operator* buffer size_t
fuge_operator_set_threads: int fuge_operator int buffer size_t
fuge_operator_apply: int fuge_operator int doubles doubles buffer size_t
fuge_operator_free: void fuge_operator*
fuge_solver_new: int fuge_operator fuge_options fuge_solver* buffer size_t
fuge_solver_free: void fuge_solver*
fuge_set_progress: int fuge_solver fuge_progress user
fuge_solve: int fuge_solver
fuge_reset: int fuge_solver
fuge_set_gap: int fuge_solver doubles doubles
fuge_set_excluded: int fuge_solver ints
fuge_set_load: int fuge_solver double
fuge_set_approach: int fuge_solver double
fuge_set_modes: int fuge_solver int doubles doubles
fuge_set_motion: int fuge_solver int double
fuge_set_resultant: int fuge_solver int double
fuge_get_mode_count: int fuge_solver ints
fuge_load_path: int fuge_operator doubles double int doubles doubles doubles ints ints ints ints buffer size_t
fuge_follow_path: int fuge_solver doubles int doubles doubles doubles ints ints ints ints
fuge_get_force: int fuge_solver doubles
fuge_get_gap: int fuge_solver doubles
fuge_get_motion: int fuge_solver doubles
fuge_get_resultant: int fuge_solver doubles
fuge_get_derivative: int fuge_solver doubles double doubles doubles doubles
fuge_get_derivatives: int fuge_solver doubles doubles doubles doubles doubles
fuge_get_info: int fuge_solver fuge_info
fuge_get_history: int fuge_solver int int ints doubles ints
fuge_solver_message: int fuge_solver buffer size_t
fuge_body_dense: int int doubles int fuge_body* buffer size_t
fuge_body_band: int int int doubles int int fuge_body* buffer size_t
fuge_body_sparse: int int ints ints doubles fuge_body* buffer size_t
fuge_body_free: void fuge_body*
fuge_body_fix: int fuge_body int ints doubles
fuge_body_set_load: int fuge_body doubles
fuge_body_set_rigid_modes: int fuge_body int doubles
fuge_body_find_rigid_modes: int fuge_body
fuge_rigid_modes: int int int doubles doubles buffer size_t
fuge_body_set_contact: int fuge_body int int ints doubles
fuge_body_condense: int fuge_body
fuge_body_get_influence: int fuge_body doubles int
fuge_body_get_displacement: int fuge_body doubles
fuge_body_get_mode_count: int fuge_body ints
fuge_body_get_modes: int fuge_body doubles doubles
fuge_body_recover: int fuge_body doubles doubles doubles
fuge_body_message: int fuge_body buffer size_t
fuge_pairs_create: int fuge_pairs* buffer size_t
fuge_pairs_free: void fuge_pairs*
fuge_pairs_set_contact: int fuge_pairs int int doubles int int ints ints
fuge_pairs_set_opposite: int fuge_pairs int int doubles int int ints ints
fuge_pairs_set_geometry: int fuge_pairs double int
fuge_pairs_find: int fuge_pairs int int doubles double double int int
fuge_pairs_get_sizes: int fuge_pairs ints ints ints
fuge_pairs_get_contact: int fuge_pairs ints doubles
fuge_pairs_get_gaps: int fuge_pairs doubles doubles doubles
fuge_pairs_get_points: int fuge_pairs ints ints ints doubles doubles
fuge_pairs_get_unpaired: int fuge_pairs ints ints
fuge_pairs_message: int fuge_pairs buffer size_t
fuge_bodies_create: int fuge_bodies* buffer size_t
fuge_bodies_free: void fuge_bodies*
fuge_bodies_add: int fuge_bodies int ints ints doubles ints
fuge_bodies_fix: int fuge_bodies int int ints doubles
fuge_bodies_set_load: int fuge_bodies int doubles
fuge_bodies_set_rigid_modes: int fuge_bodies int int doubles
fuge_bodies_set_contact: int fuge_bodies int int int doubles int int ints ints
fuge_bodies_set_opposite: int fuge_bodies int int int doubles int int ints ints
fuge_bodies_set_geometry: int fuge_bodies double int
fuge_bodies_add_pair: int fuge_bodies int int doubles double double int int
fuge_bodies_solve: int fuge_bodies fuge_options
fuge_bodies_solve_sparse: int fuge_bodies fuge_options
fuge_bodies_get_sizes: int fuge_bodies ints ints ints
fuge_bodies_get_forces: int fuge_bodies doubles doubles doubles
fuge_bodies_get_points: int fuge_bodies ints ints ints doubles doubles
fuge_bodies_get_areas: int fuge_bodies doubles doubles
fuge_bodies_get_unpaired: int fuge_bodies ints ints
fuge_bodies_get_displacement: int fuge_bodies int doubles
fuge_bodies_get_info: int fuge_bodies fuge_info
fuge_bodies_message: int fuge_bodies buffer size_t
fuge_bodies_join: int fuge_bodies
fuge_bodies_get_joined_sizes: int fuge_bodies ints ints ints ints
fuge_bodies_get_matrix: int fuge_bodies ints ints doubles ints
fuge_bodies_get_contact: int fuge_bodies ints doubles doubles doubles doubles
fuge_read_profile: int text int doubles doubles ints buffer size_t
fuge_sample_profile: int int doubles doubles int doubles doubles buffer size_t
fuge_level_profile: int int doubles doubles int buffer size_t
fuge_read_surface: int text int int int doubles ints ints doubles doubles ints buffer size_t
fuge_write_surface: int text int int doubles doubles buffer size_t
fuge_fill_surface: int int int doubles ints buffer size_t
fuge_level_surface: int int int doubles int buffer size_t
fuge_write_fields: int text int int doubles doubles int texts arrays buffer size_t
fuge_write_volume: int text int int doubles doubles int doubles int texts arrays buffer size_t
fuge_read_matrix: int text int int doubles ints ints buffer size_t
fuge_read_sparse: int text int int ints ints doubles ints ints ints buffer size_t
fuge_write_matrix: int text int int doubles int int buffer size_t
fuge_write_sparse: int text int int ints ints doubles int buffer size_t
fuge_read_stiffness: int text int text text int int ints ints doubles ints ints ints ints buffer size_t
fuge_read_mesh: int text fuge_mesh* buffer size_t
fuge_mesh_create: int int int doubles int int ints int texts fuge_mesh* buffer size_t
fuge_mesh_join: int int fuge_mesh* fuge_mesh* buffer size_t
fuge_write_mesh: int text fuge_mesh int texts ints ints arrays buffer size_t
fuge_mesh_free: void fuge_mesh*
fuge_mesh_get_sizes: int fuge_mesh ints ints ints
fuge_mesh_get_nodes: int fuge_mesh ints doubles
fuge_mesh_get_elements: int fuge_mesh ints ints ints
fuge_mesh_get_type: int fuge_mesh int buffer size_t
fuge_mesh_get_set_counts: int fuge_mesh ints ints ints
fuge_mesh_get_node_set_name: int fuge_mesh int buffer size_t
fuge_mesh_get_element_set_name: int fuge_mesh int buffer size_t
fuge_mesh_get_surface_name: int fuge_mesh int buffer size_t
fuge_mesh_get_node_set: int fuge_mesh text int ints ints buffer size_t
fuge_mesh_get_element_set: int fuge_mesh text int ints ints buffer size_t
fuge_mesh_get_faces: int fuge_mesh text int ints ints buffer size_t
fuge_mesh_get_surface_dof: int fuge_mesh text int int ints ints ints buffer size_t
fuge_mesh_get_set_dof: int fuge_mesh text int int ints ints int ints ints buffer size_t
fuge_solve_smooth_punch: int fuge_smooth_profile user double double double double doubles fuge_smooth* buffer size_t
fuge_smooth_free: void fuge_smooth*
fuge_smooth_get_report: int fuge_smooth fuge_smooth_report buffer size_t
fuge_smooth_get_pressure: int fuge_smooth int doubles doubles buffer size_t
fuge_smooth_get_gap: int fuge_smooth int doubles doubles doubles buffer size_t
fuge_smooth_get_coefficients: int fuge_smooth int doubles buffer size_t
fuge_solve_round_punch: int fuge_smooth_profile user double double doubles doubles doubles fuge_round* buffer size_t
fuge_solve_round_powers: int int doubles doubles doubles double double doubles doubles doubles fuge_round* buffer
  size_t
fuge_round_free: void fuge_round*
fuge_round_get_report: int fuge_round fuge_round_report buffer size_t
fuge_round_get_pressure: int fuge_round int doubles doubles buffer size_t
fuge_round_get_gap: int fuge_round int doubles doubles doubles buffer size_t
fuge_halfplane_stress: int int doubles doubles doubles int int int doubles doubles doubles buffer size_t
fuge_halfplane_displacement: int int doubles doubles doubles int double double int int int doubles doubles doubles
  buffer size_t
fuge_smooth_stress: int fuge_smooth int doubles doubles doubles buffer size_t
fuge_smooth_displacement: int fuge_smooth double double int int doubles doubles doubles buffer size_t
fuge_halfspace_stress: int int doubles doubles doubles doubles doubles double int int int doubles doubles doubles
  doubles buffer size_t
fuge_halfspace_displacement: int int doubles doubles doubles doubles doubles double double int int int doubles doubles
  doubles doubles buffer size_t
fuge_halfplane_stress_grid: int int double doubles int int int doubles doubles buffer size_t
fuge_halfplane_displacement_grid: int int double doubles int int double double int int doubles doubles buffer size_t
fuge_halfspace_stress_grid: int int int double double doubles int double int doubles doubles buffer size_t
fuge_halfspace_displacement_grid: int int int double double doubles int double double int doubles doubles buffer
  size_t
fuge_ring_stress: int int doubles doubles double int doubles doubles doubles buffer size_t
fuge_ring_interior_displacement: int int doubles doubles double double int doubles doubles doubles buffer size_t
fuge_round_stress: int fuge_round double int doubles doubles doubles buffer size_t
fuge_round_displacement: int fuge_round double double int doubles doubles doubles buffer size_t
fuge_halfplane_tensor: int int doubles int double doubles buffer size_t
fuge_round_tensor: int int doubles doubles buffer size_t
fuge_principal_stresses: int int doubles doubles buffer size_t
fuge_von_mises: int int doubles doubles buffer size_t
fuge_tresca: int int doubles doubles buffer size_t
fuge_mean_stress: int int doubles doubles buffer size_t
fuge_halfplane_peak: int int doubles doubles doubles int int double int int fuge_stress_peak buffer size_t
fuge_smooth_peak: int fuge_smooth int double int fuge_stress_peak buffer size_t
fuge_halfspace_peak: int int doubles doubles doubles doubles doubles double int int int fuge_stress_peak buffer size_t
fuge_ring_peak: int int doubles doubles double int fuge_stress_peak buffer size_t
fuge_round_peak: int fuge_round double int fuge_stress_peak buffer size_t
"""
