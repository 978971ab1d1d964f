!> The public interface of the component accuracy: contact to a wanted error, on grids that are chosen for it.
module fuge_accuracy
  use fuge_area_accuracy, only: fuge_solve_area
  use fuge_gap_function_type, only: fuge_gap_function
  use fuge_line_accuracy, only: fuge_solve_line
  use fuge_pressing_type, only: fuge_pressing
  use fuge_resolved_contact_type, only: fuge_level, fuge_resolved_contact, FUGE_BY_EQUAL_CELLS, &
    FUGE_BY_GRADED_CELLS, FUGE_BY_SERIES
  implicit none
  public

end module fuge_accuracy
