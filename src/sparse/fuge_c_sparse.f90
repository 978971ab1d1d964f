!> C bindings, sections "condensation" and "elastic bodies", of the sparse component.
module fuge_c_sparse
  use, intrinsic :: iso_c_binding, only: c_int, c_ptr, c_size_t
  use fuge_c_body, only: columns_body
  use fuge_c_elastic_bodies, only: solve_bodies
  use fuge_sparse, only: fuge_sparse_stiffness
  implicit none
  private

contains

  function c_body_sparse(degrees, column, row, value, destination, message, length) &
    bind(c, name='fuge_body_sparse') result(status)
    integer(c_int), intent(in), value :: degrees
    type(c_ptr), intent(in), value :: column, row, value, destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_sparse_stiffness) :: sparse

    status = columns_body(degrees, column, row, value, sparse, destination, message, length)
  end function c_body_sparse

  function c_bodies_solve_sparse(bodies, options, pairs) bind(c, name='fuge_bodies_solve_sparse') result(status)
    type(c_ptr), intent(in), value :: bodies, options, pairs
    integer(c_int) :: status
    type(fuge_sparse_stiffness) :: sparse

    status = solve_bodies(bodies, options, pairs, sparse)
  end function c_bodies_solve_sparse

end module fuge_c_sparse
