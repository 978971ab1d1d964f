!> A periodic surface whose displacement of each wave of forces is that of a sine, 2/(E* |q|), as other codes have it:
!> an operator of the benchmark's own, whose solution is the reference for theirs.
module bench_wave_operator
  use bench_surfaces, only: bench_surface
  use bench_transforms, only: grid_transform
  use fuge, only: dp => fuge_dp, fuge_operator
  implicit none
  private

  real(dp), parameter :: PI = acos(-1.0_dp)

  !> `prepare` it; it is in use by one solve at a time.
  type, extends(fuge_operator), public :: wave_operator
    private
    integer :: n = 0
    type(grid_transform), pointer :: transform => null()
    !> Of A; zero for the mean.
    real(dp), allocatable :: eigenvalue(:, :)
  contains
    procedure :: prepare
    procedure :: free
    procedure :: points
    procedure :: apply
    procedure :: has_preconditioner
    procedure :: precondition
  end type wave_operator

contains

  subroutine prepare(self, surface)
    class(wave_operator), intent(inout) :: self
    type(bench_surface), intent(in) :: surface
    integer :: k, m, n

    call self%free()
    n = surface%n
    self%n = n
    allocate (self%transform)
    call self%transform%create(n, n)
    allocate (self%eigenvalue(n/2 + 1, n), source=0.0_dp)
    do m = 0, n - 1
      do k = 0, n/2
        if (k + m == 0) cycle
        self%eigenvalue(1 + k, 1 + m) = 1.0_dp/(PI*surface%side*hypot(real(k, dp), real(min(m, n - m), dp)))
      end do
    end do
  end subroutine prepare

  subroutine free(self)
    class(wave_operator), intent(inout) :: self

    if (associated(self%transform)) then
      call self%transform%free()
      deallocate (self%transform)
    end if
    if (allocated(self%eigenvalue)) deallocate (self%eigenvalue)
    self%n = 0
  end subroutine free

  pure function points(self) result(n)
    class(wave_operator), intent(in) :: self
    integer :: n

    n = self%n**2
  end function points

  subroutine apply(self, force, displacement, status)
    class(wave_operator), intent(in) :: self
    real(dp), intent(in) :: force(:)
    real(dp), intent(out) :: displacement(:)
    integer, intent(out) :: status

    call take_waves(self, force)
    self%transform%waves = self%eigenvalue*self%transform%waves
    call give_values(self, displacement)
    status = 0
  end subroutine apply

  function has_preconditioner(self) result(preconditioned)
    class(wave_operator), intent(in) :: self
    logical :: preconditioned

    preconditioned = self%n > 0
  end function has_preconditioner

  !> The inverse of each wave; of the mean that of the longest wave.
  subroutine precondition(self, displacement, force, status)
    class(wave_operator), intent(in) :: self
    real(dp), intent(in) :: displacement(:)
    real(dp), intent(out) :: force(:)
    integer, intent(out) :: status
    real(dp) :: scale

    call take_waves(self, displacement)
    scale = 1.0_dp/real(self%n, dp)**4
    where (self%eigenvalue > 0.0_dp)
      self%transform%waves = scale/self%eigenvalue*self%transform%waves
    elsewhere
      self%transform%waves = scale/maxval(self%eigenvalue)*self%transform%waves
    end where
    call give_values(self, force)
    status = 0
  end subroutine precondition

  subroutine take_waves(self, values)
    class(wave_operator), intent(in) :: self
    real(dp), intent(in) :: values(:)

    self%transform%values(:self%n, :) = reshape(values, [self%n, self%n])
    call self%transform%forward()
  end subroutine take_waves

  subroutine give_values(self, values)
    class(wave_operator), intent(in) :: self
    real(dp), intent(out) :: values(:)

    call self%transform%backward()
    values = reshape(self%transform%values(:self%n, :), [self%n**2])
  end subroutine give_values

end module bench_wave_operator
