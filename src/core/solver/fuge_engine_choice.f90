!> Which engine solves?
module fuge_engine_choice
  use fuge_matrix_operator, only: fuge_dense_operator
  use fuge_operator_type, only: fuge_operator
  use fuge_options_type, only: fuge_options, FUGE_AUTO, FUGE_ITERATIVE
  implicit none
  private

  public :: takes_products

contains

  !> Which engine? FUGE_AUTO is the active set for a matrix, or the tableau if the history is asked for, which it alone
  !> keeps; for any other operator the iteration, which takes products.
  pure function takes_products(operator, options)
    class(fuge_operator), intent(in) :: operator
    type(fuge_options), intent(in) :: options
    logical :: takes_products

    takes_products = options%method == FUGE_ITERATIVE
    select type (operator)
    class is (fuge_dense_operator)
      continue
    class default
      if (options%method == FUGE_AUTO) takes_products = .true.
    end select
  end function takes_products

end module fuge_engine_choice
