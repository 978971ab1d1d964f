!> The modes of a problem: displacements by motions, and resultants of forces.
module fuge_problem_modes
  use fuge_kinds, only: dp
  use fuge_point_space, only: point_space
  use fuge_problem_type, only: fuge_problem
  implicit none
  private

  public :: add_rigid_displacement, free_translation, prescribed_motions, resultant_terms, resultants_of

contains

  !> Which motions are prescribed, (m)?
  pure function prescribed_motions(problem) result(prescribed)
    type(fuge_problem), intent(in) :: problem
    logical :: prescribed(problem%mode_count())

    prescribed = .false.
    if (allocated(problem%prescribed)) prescribed = problem%prescribed
  end function prescribed_motions

  !> The motions, (m), that move all points by 1 in a translation that is free and not on a spring: it takes up what is
  !> the same for the gaps of all points. Zero without such a mode.
  function free_translation(problem, space) result(motion)
    type(fuge_problem), intent(in) :: problem
    type(point_space), intent(in) :: space
    real(dp) :: motion(problem%mode_count())
    real(dp) :: least, most
    logical :: held(problem%mode_count())
    integer :: j

    held = problem%motions_on_springs() .or. prescribed_motions(problem)
    motion = 0.0_dp
    do j = 1, size(motion)
      if (held(j)) cycle
      least = 1.0_dp
      most = 1.0_dp
      if (allocated(problem%modes)) then
        associate (mode => problem%modes(:, lbound(problem%modes, 2) + j - 1))
          least = space%least(minval(mode))
          most = space%largest(maxval(mode))
        end associate
      end if
      if (most - least > 0.0_dp .or. .not. abs(most) > 0.0_dp) cycle
      motion(j) = 1.0_dp/most
      return
    end do
  end function free_translation

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

  !> The size of the terms of `resultants_of`, (m).
  function resultant_terms(problem, force, space) result(terms)
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: force(:)
    type(point_space), intent(in) :: space
    real(dp) :: terms(problem%mode_count())
    integer :: j

    terms = sum(abs(force))
    if (allocated(problem%modes)) then
      do j = 1, size(terms)
        terms(j) = sum(abs(force*problem%modes(:, lbound(problem%modes, 2) + j - 1)))
      end do
    end if
    call space%add(terms)
  end function resultant_terms

end module fuge_problem_modes
