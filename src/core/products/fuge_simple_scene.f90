!> The scene of a problem with one translation, free or prescribed, and one-sided contact at all points, and its
!> solution in the units of the problem.
module fuge_simple_scene
  use fuge_constants, only: LARGEST_EXPONENT
  use fuge_contact_iterate, only: contact_iterate
  use fuge_contact_scene, only: contact_scene
  use fuge_deformed_gaps, only: deformed_gap
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_operator_type, only: fuge_operator
  use fuge_point_chunks, only: chunked_pass
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_scene_scaling, only: scene_scaling
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_OVERFLOW
  implicit none
  private

  public :: assemble_simple, find_simple_motion, set_simple_scene

  !> Forces up to this many units in the last place of the largest force are rounding.
  real(dp), parameter :: ROUNDINGS = 4.0_dp

  !> Finds the least and the largest gap less `datum`, then divides the gaps less `datum` by `load`.
  type, extends(chunked_pass) :: gap_pass
    real(dp), pointer, contiguous :: gap(:) => null(), reduced(:) => null()
    real(dp) :: datum = 0.0_dp, load = 1.0_dp
  contains
    procedure :: do_chunk => do_gaps
  end type gap_pass

  !> Finds the largest force; then with a `load` their sum, where forces up to `least` are none; with `displacement` it
  !> gives forces and gaps in place of the scaled forces and the displacements.
  type, extends(chunked_pass) :: solution_pass
    real(dp), pointer, contiguous :: force(:) => null(), reduced_gap(:) => null(), displacement(:) => null()
    logical, pointer, contiguous :: contact(:) => null()
    real(dp) :: least = 0.0_dp, load = 0.0_dp, motion = 0.0_dp
  contains
    procedure :: do_chunk => do_solution
  end type solution_pass

contains

  !> The scene of a problem; its rows are set. Errors: FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY.
  subroutine set_simple_scene(problem, scene, scaling, info)
    type(fuge_problem), intent(in), target :: problem
    type(contact_scene), intent(inout), target :: scene
    type(scene_scaling), intent(out) :: scaling
    type(fuge_info), intent(inout) :: info
    type(gap_pass) :: pass
    real(dp) :: extremes(2)
    integer :: stat

    scene%prescribed = .not. problem%is_plain()
    if (scene%prescribed) pass%datum = problem%motion(1)
    ! The caller's array may begin with another number than 1.
    pass%gap(1:size(problem%gap)) => problem%gap
    call pass%run(size(problem%gap), 2)
    extremes = [pass%largest(1), pass%largest(2)]
    call scene%rows%raise(extremes)
    if (scene%prescribed) then
      scaling%gap_datum = pass%datum
    else
      scaling%gap_datum = -extremes(1)
      scaling%load = problem%resultant(1)
    end if
    call check_range(scene%prescribed, extremes, scaling%load, info)
    if (.not. info%failed()) then
      allocate (scene%gap(size(problem%gap)), stat=stat)
      call require_memory(stat, 'the gaps of', size(problem%gap), 'points', info)
      if (stat == 0) then
        pass%datum = scaling%gap_datum
        pass%load = scaling%load
        pass%reduced => scene%gap
        call pass%run(size(problem%gap), 0)
      end if
    end if
    call scene%rows%agree(info)
  end subroutine set_simple_scene

  subroutine do_gaps(self, k, first, last)
    class(gap_pass), intent(inout) :: self
    integer, intent(in) :: k, first, last

    if (associated(self%reduced)) then
      self%reduced(first:last) = (self%gap(first:last) - self%datum)/self%load
    else
      self%found(:, k) = [-minval(self%gap(first:last) - self%datum), maxval(self%gap(first:last) - self%datum)]
    end if
  end subroutine do_gaps

  !> Refuse gaps so large that their squares overflow, after division by the load if there is one. `extremes`: minus the
  !> least gap and the largest one, less the motion if that is `prescribed`. Error: FUGE_ERR_OVERFLOW.
  subroutine check_range(prescribed, extremes, load, info)
    logical, intent(in) :: prescribed
    real(dp), intent(in) :: extremes(2), load
    type(fuge_info), intent(inout) :: info
    integer :: excess

    if (prescribed) then
      excess = exponent(maxval(abs(extremes)))
    else
      excess = exponent(sum(extremes)) - exponent(load)
    end if
    if (2*excess <= LARGEST_EXPONENT) return
    if (prescribed) then
      call report(info, FUGE_ERR_OVERFLOW, 'the gaps differ by 2**'//text(excess)//' from the prescribed approach: ' &
                  //'choose units in which lengths are nearer to 1')
    else
      call report(info, FUGE_ERR_OVERFLOW, 'the gaps are 2**'//text(excess)//' times the load: choose units in which ' &
                  //'they are nearer to it')
    end if
  end subroutine check_range

  !> The motion in the units of the problem, `solution`%motion; forces of `iterate` that are rounding become zero.
  !> Error: FUGE_ERR_MEMORY.
  subroutine find_simple_motion(operator, scene, scaling, iterate, solution, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in) :: scene
    type(scene_scaling), intent(in) :: scaling
    type(contact_iterate), intent(inout), target :: iterate
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info
    type(solution_pass) :: pass
    real(dp), allocatable :: motion(:)
    integer :: n, stat

    n = size(scene%gap)
    allocate (motion(1), stat=stat)
    call require_memory(stat, 'the motion of', n, 'points', info)
    call scene%rows%agree(info)
    if (stat /= 0 .or. info%failed()) return
    pass%force => iterate%force
    call pass%run(n, 1)
    pass%least = ROUNDINGS*epsilon(1.0_dp)*scene%rows%largest(pass%largest(1))
    pass%load = scaling%load
    call pass%run(n, 1)
    motion = scaling%gap_datum
    if (.not. scene%prescribed) then
      motion = (scaling%load*iterate%motion + operator%datum()*scene%rows%total(pass%total(1))) + scaling%gap_datum
    end if
    call move_alloc(motion, solution%motion)
  end subroutine find_simple_motion

  !> Forces and gaps in the units of the problem, in the arrays of `iterate`, which has no forces and displacements
  !> afterwards.
  subroutine assemble_simple(scene, scaling, iterate, solution)
    type(contact_scene), intent(in), target :: scene
    type(scene_scaling), intent(in) :: scaling
    type(contact_iterate), intent(inout), target :: iterate
    type(fuge_solution), intent(inout) :: solution
    type(solution_pass) :: pass

    pass%force => iterate%force
    pass%reduced_gap => scene%gap
    pass%displacement => iterate%displacement
    pass%contact => iterate%contact
    pass%load = scaling%load
    pass%motion = iterate%motion
    call pass%run(size(scene%gap), 0)
    call move_alloc(iterate%force, solution%force)
    call move_alloc(iterate%displacement, solution%gap)
  end subroutine assemble_simple

  subroutine do_solution(self, k, first, last)
    class(solution_pass), intent(inout) :: self
    integer, intent(in) :: k, first, last

    if (associated(self%displacement)) then
      self%force(first:last) = self%load*self%force(first:last)
      self%displacement(first:last) = self%load*max(deformed_gap(self%reduced_gap(first:last), &
                                                                 self%displacement(first:last), self%motion), 0.0_dp)
      where (self%contact(first:last)) self%displacement(first:last) = 0.0_dp
    else if (self%load > 0.0_dp) then
      where (self%force(first:last) <= self%least) self%force(first:last) = 0.0_dp
      self%found(1, k) = sum(self%load*self%force(first:last))
    else
      self%found(1, k) = maxval(self%force(first:last))
    end if
  end subroutine do_solution

end module fuge_simple_scene
