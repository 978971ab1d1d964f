!> Real fast Fourier transforms in two dimensions, which the benchmark plans itself: its surfaces, its judge and its
!> bounds do not depend on the code that it measures.
module bench_transforms
  use, intrinsic :: iso_c_binding, only: c_f_pointer, c_int, c_null_ptr, c_ptr, c_size_t
  use fuge, only: dp => fuge_dp
  implicit none
  private

  public :: forget_wisdom

  !> FFTW_ESTIMATE.
  integer(c_int), parameter :: ESTIMATE = 64

  !> Transforms in place of nx x ny real numbers, in the first nx of each column; the waves are nx/2 + 1 by ny.
  type, public :: grid_transform
    real(dp), pointer, contiguous :: values(:, :) => null()
    complex(dp), pointer, contiguous :: waves(:, :) => null()
    type(c_ptr), private :: forward_plan = c_null_ptr, backward_plan = c_null_ptr, memory = c_null_ptr
  contains
    procedure :: create
    procedure :: forward
    procedure :: backward
    procedure :: free
  end type grid_transform

  interface
    function fftw_malloc(bytes) bind(c, name='fftw_malloc') result(memory)
      import :: c_ptr, c_size_t
      integer(c_size_t), intent(in), value :: bytes
      type(c_ptr) :: memory
    end function fftw_malloc

    subroutine fftw_free(memory) bind(c, name='fftw_free')
      import :: c_ptr
      type(c_ptr), intent(in), value :: memory
    end subroutine fftw_free

    function plan_r2c(rows, columns, in, out, flags) bind(c, name='fftw_plan_dft_r2c_2d') result(plan)
      import :: c_int, c_ptr
      integer(c_int), intent(in), value :: rows, columns, flags
      type(c_ptr), intent(in), value :: in, out
      type(c_ptr) :: plan
    end function plan_r2c

    function plan_c2r(rows, columns, in, out, flags) bind(c, name='fftw_plan_dft_c2r_2d') result(plan)
      import :: c_int, c_ptr
      integer(c_int), intent(in), value :: rows, columns, flags
      type(c_ptr), intent(in), value :: in, out
      type(c_ptr) :: plan
    end function plan_c2r

    subroutine fftw_execute(plan) bind(c, name='fftw_execute')
      import :: c_ptr
      type(c_ptr), intent(in), value :: plan
    end subroutine fftw_execute

    subroutine fftw_destroy_plan(plan) bind(c, name='fftw_destroy_plan')
      import :: c_ptr
      type(c_ptr), intent(in), value :: plan
    end subroutine fftw_destroy_plan

    subroutine forget_wisdom() bind(c, name='fftw_forget_wisdom')
    end subroutine forget_wisdom
  end interface

contains

  subroutine create(self, nx, ny)
    class(grid_transform), intent(inout) :: self
    integer, intent(in) :: nx, ny

    call self%free()
    self%memory = fftw_malloc(16_c_size_t*int(nx/2 + 1, c_size_t)*int(ny, c_size_t))
    call c_f_pointer(self%memory, self%values, [2*(nx/2 + 1), ny])
    call c_f_pointer(self%memory, self%waves, [nx/2 + 1, ny])
    self%forward_plan = plan_r2c(int(ny, c_int), int(nx, c_int), self%memory, self%memory, ESTIMATE)
    self%backward_plan = plan_c2r(int(ny, c_int), int(nx, c_int), self%memory, self%memory, ESTIMATE)
    self%values = 0.0_dp
  end subroutine create

  !> `values` to `waves`.
  subroutine forward(self)
    class(grid_transform), intent(inout) :: self

    call fftw_execute(self%forward_plan)
  end subroutine forward

  !> `waves` to `values`, nx*ny times as large as before `forward`.
  subroutine backward(self)
    class(grid_transform), intent(inout) :: self

    call fftw_execute(self%backward_plan)
  end subroutine backward

  subroutine free(self)
    class(grid_transform), intent(inout) :: self

    if (.not. associated(self%values)) return
    call fftw_destroy_plan(self%forward_plan)
    call fftw_destroy_plan(self%backward_plan)
    call fftw_free(self%memory)
    nullify (self%values, self%waves)
  end subroutine free

end module bench_transforms
