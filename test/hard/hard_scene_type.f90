!> A hard case as data: a contact problem with one translation and one-sided points, and what is known of its answer.
module hard_scene_type
  use fuge_kinds, only: dp
  use fuge_status, only: FUGE_DONE
  implicit none
  private

  public :: from_answer, from_data, set_answer

  type, public :: hard_scene
    character(len=40) :: name = ''
    character(len=72) :: why = ''
    real(dp), allocatable :: alpha(:, :), gap(:)
    real(dp) :: load = 1.0_dp
    !> The answer where it is known; without `force` where only gaps are unique.
    real(dp), allocatable :: force(:), opening(:)
    real(dp) :: approach = 0.0_dp
    !> Are all numbers of problem and answer whole, and does no sum of them round?
    logical :: exact = .false.
    !> Largest error of forces relative to the load, of gaps relative to the lengths.
    real(dp) :: tolerance = 1.0e-12_dp
    !> The status that each engine must return.
    integer :: tableau = FUGE_DONE
    integer :: active_set = FUGE_DONE
    integer :: iterative = FUGE_DONE
    !> At the limit of double precision: a warning or FUGE_ERR_NOT_DEFINITE is accepted too.
    logical :: hedged = .false.
    !> Largest number of pivots for each row of the tableau, of contact sets tried.
    integer :: most_pivots = 3
    integer :: most_sets = 20
    !> Does a tableau of this size take too long for a test?
    logical :: large = .false.
  end type hard_scene

contains

  !> The problem that has this answer; all numbers are whole.
  pure function from_answer(name, why, alpha, force, opening, approach) result(scene)
    character(len=*), intent(in) :: name, why
    real(dp), intent(in) :: alpha(:, :), force(:), opening(:), approach
    type(hard_scene) :: scene

    scene = from_data(name, why, alpha, opening - matmul(alpha, force) + approach, sum(force))
    call set_answer(scene, force, opening, approach)
    scene%exact = .true.
  end function from_answer

  !> A problem whose answer is not known, or set by the caller.
  pure function from_data(name, why, alpha, gap, load) result(scene)
    character(len=*), intent(in) :: name, why
    real(dp), intent(in) :: alpha(:, :), gap(:), load
    type(hard_scene) :: scene

    scene%name = name
    scene%why = why
    ! Not by assignment, for which gfortran reads the bounds of arrays that are not allocated yet.
    allocate (scene%alpha, source=alpha)
    allocate (scene%gap, source=gap)
    scene%load = load
  end function from_data

  !> Add the known answer.
  pure subroutine set_answer(scene, force, opening, approach)
    type(hard_scene), intent(inout) :: scene
    real(dp), intent(in) :: force(:), opening(:), approach

    allocate (scene%force, source=force)
    allocate (scene%opening, source=opening)
    scene%approach = approach
  end subroutine set_answer

end module hard_scene_type
