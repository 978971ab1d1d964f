!> The modes of a problem: displacements by motions, and resultants of forces.
module fuge_problem_modes
  use fuge_kinds, only: dp
  use fuge_point_space, only: point_space
  use fuge_problem_type, only: fuge_problem
  implicit none
  private

  public :: add_rigid_displacement, has_free_datum, prescribed_motions, resultants_of

contains

  !> Which motions are prescribed, (m)?
  pure function prescribed_motions(problem) result(prescribed)
    type(fuge_problem), intent(in) :: problem
    logical :: prescribed(problem%mode_count())

    prescribed = .false.
    if (allocated(problem%prescribed)) prescribed = problem%prescribed
  end function prescribed_motions

  !> Is there one translation, free and not on a spring? It takes up what is the same for the gaps of all points.
  pure function has_free_datum(problem)
    type(fuge_problem), intent(in) :: problem
    logical :: has_free_datum

    has_free_datum = .not. (allocated(problem%modes) .or. any(prescribed_motions(problem)) &
                            .or. problem%spring_count() > 0)
  end function has_free_datum

  !> displacement := displacement + R motion, (n), length.
  pure subroutine add_rigid_displacement(problem, motion, displacement)
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: motion(:)
    real(dp), intent(inout) :: displacement(:)
    integer :: j

    if (allocated(problem%modes)) then
      do j = 1, size(motion)
        displacement = displacement + problem%modes(:, lbound(problem%modes, 2) + j - 1)*motion(j)
      end do
    else
      displacement = displacement + motion(1)
    end if
  end subroutine add_rigid_displacement

  !> R^T force, (m), over the points of all ranks.
  function resultants_of(problem, force, space) result(resultant)
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: force(:)
    type(point_space), intent(in) :: space
    real(dp) :: resultant(problem%mode_count())

    if (allocated(problem%modes)) then
      resultant = matmul(force, problem%modes)
    else
      resultant = sum(force)
    end if
    call space%add(resultant)
  end function resultants_of

end module fuge_problem_modes
