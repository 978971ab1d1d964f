!> A hard case as data: a contact problem, built from its answer or given.
module hard_scene_type
  use fuge, only: dp => fuge_dp, FUGE_DONE
  implicit none
  private

  public :: built, given, answer

  !> A problem, and what is known of its answer.
  type, public :: hard_scene
    character(len=40) :: name = ''
    character(len=72) :: why = ''
    real(dp), allocatable :: alpha(:, :), gap(:)
    real(dp) :: load = 1.0_dp
    !> The answer where it is known; without `force` where only gaps are unique.
    real(dp), allocatable :: force(:), opening(:)
    real(dp) :: approach = 0.0_dp
    !> Are all numbers whole, and none rounds?
    logical :: exact = .false.
    !> Largest error of forces as a part of the load, of gaps as a part of the lengths.
    real(dp) :: tolerance = 1.0e-12_dp
    !> What the engines have to say.
    integer :: tableau = FUGE_DONE
    integer :: active_set = FUGE_DONE
    integer :: iterative = FUGE_DONE
    !> At the limit of double precision: a warning, or FUGE_ERR_NOT_DEFINITE, will do too.
    logical :: hedged = .false.
    !> Most pivots for each row of the tableau, most contact sets tried.
    integer :: most_pivots = 3
    integer :: most_sets = 20
    !> Too large for a tableau in a test.
    logical :: large = .false.
  end type hard_scene

contains

  !> The scene with this answer, all numbers whole.
  pure function built(name, why, alpha, force, opening, approach) result(scene)
    character(len=*), intent(in) :: name, why
    real(dp), intent(in) :: alpha(:, :), force(:), opening(:), approach
    type(hard_scene) :: scene

    scene = given(name, why, alpha, opening - matmul(alpha, force) + approach, sum(force))
    call answer(scene, force, opening, approach)
    scene%exact = .true.
  end function built

  !> A scene whose answer is not known, or set by the caller.
  pure function given(name, why, alpha, gap, load) result(scene)
    character(len=*), intent(in) :: name, why
    real(dp), intent(in) :: alpha(:, :), gap(:), load
    type(hard_scene) :: scene

    scene%name = name
    scene%why = why
    ! Not by assignment: gfortran then reads the bounds that are not there yet.
    allocate (scene%alpha, source=alpha)
    allocate (scene%gap, source=gap)
    scene%load = load
  end function given

  !> Add the answer that a scene is known to have.
  pure subroutine answer(scene, force, opening, approach)
    type(hard_scene), intent(inout) :: scene
    real(dp), intent(in) :: force(:), opening(:), approach

    allocate (scene%force, source=force)
    allocate (scene%opening, source=opening)
    scene%approach = approach
  end subroutine answer

end module hard_scene_type
