!> The public interface of the component halfplane: cells on a half-plane, edges of contact, the field below.
module fuge_halfplane
  use fuge_cell_grading, only: fuge_graded_cells, FUGE_END_CORNER, FUGE_END_EDGE, FUGE_END_PLAIN
  use fuge_edge_refinement, only: fuge_contact_edges, fuge_interval, FUGE_EDGE_REFINED, FUGE_EDGE_FEW_CELLS, &
    FUGE_EDGE_SINGULAR, FUGE_EDGE_GRID_END, FUGE_EDGE_LIMITED
  use fuge_field_of_halfplane, only: fuge_halfplane_field
  use fuge_halfplane_fft, only: fuge_halfplane_operator
  use fuge_halfplane_influence, only: fuge_halfplane_matrix
  implicit none
  public

end module fuge_halfplane
