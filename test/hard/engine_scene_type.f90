!> A contact problem that two engines solve: its matrix, and for the iteration perhaps an operator of the same body.
module engine_scene_type
  use fuge_kinds, only: dp
  use fuge_operator_type, only: fuge_operator
  use fuge_problem_type, only: fuge_problem
  implicit none
  private

  type, public :: engine_scene
    integer :: number = 0
    !> The body, the modes, the stops and the load in words.
    character(len=28) :: body = '', motions = '', stops = '', load = ''
    real(dp), allocatable :: alpha(:, :)
    !> May some forces store no energy?
    logical :: singular = .false.
    !> The operator of the iteration; unallocated: the matrix.
    class(fuge_operator), allocatable :: operator
    !> Positions of the points, (n), of size about 1.
    real(dp), allocatable :: x(:), y(:)
    !> 1 or 2, the body of each point, (n).
    integer, allocatable :: part(:)
    type(fuge_problem) :: problem
  end type engine_scene

end module engine_scene_type
