!> An operator for which contact problems have closed forms: the force of a point displaces that point alone.
module independent_springs
  use fuge_contact_displacement, only: compute_displacement
  use fuge_contact_iterate, only: contact_iterate, start_iterate
  use fuge_contact_scene, only: contact_scene, OUT_OF_REACH
  use fuge_kinds, only: dp
  use fuge_operator_type, only: fuge_operator
  use fuge_status, only: fuge_info, FUGE_DONE
  implicit none
  private

  public :: set_iterate, set_tilting_scene

  !> A is the diagonal matrix of the compliances plus `uniform` everywhere, which is taken out as the datum.
  type, extends(fuge_operator), public :: spring_operator
    !> (n), length per force.
    real(dp), allocatable :: compliance(:)
    real(dp) :: uniform = 0.0_dp
    !> Is the inverse of the diagonal matrix offered as a preconditioner?
    logical :: preconditioned = .false.
    !> What products and preconditionings return.
    integer :: status = FUGE_DONE
  contains
    procedure :: points
    procedure :: apply
    procedure :: datum
    procedure :: has_preconditioner
    procedure :: precondition
  end type spring_operator

contains

  pure function points(self) result(n)
    class(spring_operator), intent(in) :: self
    integer :: n

    n = size(self%compliance)
  end function points

  subroutine apply(self, force, displacement, status)
    class(spring_operator), intent(in) :: self
    real(dp), intent(in) :: force(:)
    real(dp), intent(out) :: displacement(:)
    integer, intent(out) :: status

    displacement = self%compliance*force
    status = self%status
  end subroutine apply

  function datum(self)
    class(spring_operator), intent(in) :: self
    real(dp) :: datum

    datum = self%uniform
  end function datum

  function has_preconditioner(self) result(preconditioned)
    class(spring_operator), intent(in) :: self
    logical :: preconditioned

    preconditioned = self%preconditioned
  end function has_preconditioner

  subroutine precondition(self, displacement, force, status)
    class(spring_operator), intent(in) :: self
    real(dp), intent(in) :: displacement(:)
    real(dp), intent(out) :: force(:)
    integer, intent(out) :: status

    force = displacement/self%compliance
    status = self%status
  end subroutine precondition

  !> Three points at x = -1, 0, 1 that may move up and down and tilt, the resultants 3 and 2, and a fourth one at x = 9
  !> that is excluded.
  subroutine set_tilting_scene(scene)
    type(contact_scene), intent(out) :: scene

    allocate (scene%gap(4), scene%excluded(4), scene%modes(4, 2), scene%load(2), scene%balance(4))
    scene%gap = [0.0_dp, 1.0_dp, 2.0_dp, OUT_OF_REACH]
    scene%prescribed = .true.
    scene%absorbs_datum = .true.
    scene%excluded = [.false., .false., .false., .true.]
    scene%modes = reshape([1.0_dp, 1.0_dp, 1.0_dp, 0.0_dp, -1.0_dp, 0.0_dp, 1.0_dp, 0.0_dp], [4, 2])
    scene%load = [3.0_dp, 2.0_dp]
    scene%balance = [0.5_dp, 0.0_dp, 2.5_dp, 0.0_dp]
  end subroutine set_tilting_scene

  !> Start from `force` with the contact set `contact`, and the displacements by one product.
  subroutine set_iterate(a, prescribed, force, contact, iterate)
    type(spring_operator), intent(in) :: a
    logical, intent(in) :: prescribed, contact(:)
    real(dp), intent(in) :: force(:)
    type(contact_iterate), intent(inout) :: iterate
    real(dp), allocatable :: start(:)
    type(fuge_info) :: info

    allocate (start, source=force)
    call start_iterate(iterate, contact_scene(gap=0.0_dp*force, prescribed=prescribed), start, info)
    if (info%failed()) error stop 'fuge: an iterate on springs cannot be started'
    iterate%contact = contact
    call compute_displacement(a, prescribed, iterate%force, iterate%displacement, info)
    if (info%failed() .or. info%products /= 1) error stop 'fuge: displacements of springs take one product'
  end subroutine set_iterate

end module independent_springs
