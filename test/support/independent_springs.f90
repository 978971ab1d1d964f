!> An operator for which contact problems have closed forms: the force of a point displaces that point alone.
module independent_springs
  use fuge, only: dp => fuge_dp, fuge_operator, FUGE_DONE
  implicit none
  private

  !> A is the diagonal matrix of the compliances plus `uniform` everywhere, which is taken out as the datum.
  type, extends(fuge_operator), public :: spring_operator
    !> (n), length per force.
    real(dp), allocatable :: compliance(:)
    real(dp) :: uniform = 0.0_dp
    !> Is the inverse of the diagonal matrix offered as a preconditioner?
    logical :: preconditioned = .false.
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
    status = FUGE_DONE
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
    status = FUGE_DONE
  end subroutine precondition

end module independent_springs
