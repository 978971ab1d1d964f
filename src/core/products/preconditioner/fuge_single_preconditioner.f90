!> The operator's preconditioner on a contact set, in single precision, projected to forces whose sum is zero.
module fuge_single_preconditioner
  use fuge_contact_iterate, only: contact_iterate
  use fuge_contact_scene, only: contact_scene
  use fuge_kinds, only: dp, sp
  use fuge_operator_products, only: precondition_single
  use fuge_operator_type, only: fuge_operator
  use fuge_set_extension, only: set_extension, wave_slopes
  use fuge_single_passes, only: center_residuals, mark_contact, point_pass, sum_energy, sum_uniform, sum_with_uniform
  use fuge_single_state, only: single_state
  use fuge_status, only: fuge_info
  implicit none
  private

  !> state%uniform is kept while at most this fraction of the set has changed since it was computed, and while the set
  !> is at most that fraction of the points: residuals have to be centred then, in two more passes over the set.
  real(dp), parameter :: CLOSE = 0.05_dp, SMALL = 0.3_dp

  type, public :: single_preconditioner
    !> Points that have changed since state%uniform was computed, at most; negative: it never was.
    integer, private :: changed = -1
    !> Nothing has changed since the last `set`.
    logical, private :: current = .false.
    !> Gives residuals to open points too, and forces of these to the set.
    type(set_extension), private :: extension
    !> The sum of `uniform` over the present set.
    real(dp), private :: total = 1.0_dp
  contains
    procedure :: set
    procedure :: note_changes
    procedure :: apply
  end type single_preconditioner

contains

  !> `points` have joined or left the contact.
  elemental subroutine note_changes(self, points)
    class(single_preconditioner), intent(inout) :: self
    integer, intent(in) :: points

    if (self%changed >= 0) self%changed = self%changed + points
    self%current = self%current .and. points == 0
  end subroutine note_changes

  !> Prepare for the contact set of `iterate`. Errors: those of the operator.
  subroutine set(self, operator, scene, state, iterate, info)
    class(single_preconditioner), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in), target :: scene
    type(single_state), intent(inout), target :: state
    type(contact_iterate), intent(in), target :: iterate
    type(fuge_info), intent(inout) :: info

    if (self%current) return
    call self%extension%set(scene%rows, operator%grid(), iterate%contact, info, wave_slopes(operator))
    if (info%failed()) return
    if (.not. iterate%prescribed) then
      call set_uniform(self, operator, scene, state, iterate, info)
    else
      if (self%changed < 0) state%uniform = 0.0_sp
      self%changed = 0
    end if
    self%current = .not. info%failed()
  end subroutine set

  !> Compute state%uniform, unless that of a set which is close to this one serves. Errors: those of the operator.
  subroutine set_uniform(self, operator, scene, state, iterate, info)
    class(single_preconditioner), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in), target :: scene
    type(single_state), intent(inout), target :: state
    type(contact_iterate), intent(in), target :: iterate
    type(fuge_info), intent(inout) :: info
    type(point_pass) :: pass
    real(dp) :: points

    points = real(iterate%segments%points, dp)
    if (self%changed > 0 .and. real(self%changed, dp) <= CLOSE*points &
        .and. points <= SMALL*real(size(scene%gap), dp)) then
      call find_total(self, scene, state, iterate)
      if (self%total > 0.0_dp) return
    end if
    call state%point_to(scene, iterate, pass)
    call pass%go(mark_contact, 0)
    call self%extension%extend(state%direction, info)
    call precondition_single(operator, state%direction, state%uniform, info)
    if (info%failed()) return
    call self%extension%collect(state%uniform, info)
    self%changed = 0
    call find_total(self, scene, state, iterate)
  end subroutine set_uniform

  subroutine find_total(self, scene, state, iterate)
    class(single_preconditioner), intent(inout) :: self
    type(contact_scene), intent(in), target :: scene
    type(single_state), intent(in), target :: state
    type(contact_iterate), intent(in), target :: iterate
    type(point_pass) :: pass

    call state%point_to(scene, iterate, pass)
    call pass%go(sum_uniform, 1)
    self%total = pass%total(1)
  end subroutine find_total

  !> state%work less `factor` times state%uniform: forces on the contact whose displacements are close to the residuals
  !> and whose sum is zero; where the motion is prescribed the forces are state%work. `energy`: their inner product with
  !> the residuals. With the same projection before and after it the preconditioner is symmetric, whatever set `uniform`
  !> was computed for (doc/theory.md). Errors: those of the operator.
  subroutine apply(self, operator, scene, state, iterate, factor, energy, info)
    class(single_preconditioner), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in), target :: scene
    type(single_state), intent(inout), target :: state
    type(contact_iterate), intent(in), target :: iterate
    real(dp), intent(out) :: factor, energy
    type(fuge_info), intent(inout) :: info
    type(point_pass) :: pass

    factor = 0.0_dp
    energy = 0.0_dp
    call state%point_to(scene, iterate, pass)
    if (self%changed > 0) then
      call pass%go(sum_with_uniform, 1)
      pass%shift = pass%total(1)/self%total
      call pass%go(center_residuals, 0)
    end if
    call self%extension%extend(state%residual, info)
    call precondition_single(operator, state%residual, state%work, info)
    if (info%failed()) return
    call self%extension%collect(state%work, info)
    call pass%go(sum_energy, 2)
    energy = pass%total(1)
    if (iterate%prescribed) return
    factor = pass%total(2)/self%total
    ! The inner product of `uniform` and the residuals is the sum of `work`, or zero if they are centred.
    if (self%changed == 0) energy = energy - factor*pass%total(2)
  end subroutine apply

end module fuge_single_preconditioner
