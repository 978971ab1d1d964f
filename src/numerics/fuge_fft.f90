!> Products with a real, even spectrum by FFTW: the only place that names it.
!>
!> FFTW's planner is one for the whole process. Its own lock, which the first plan
!> switches on, covers neither its start nor its number of threads: a lock of ours does.
!> A host program that plans transforms itself, in another thread at the same time, calls
!> fftw_make_planner_thread_safe before it starts threads.
module fuge_fft
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_int, c_loc, c_null_ptr, c_ptr, c_size_t, c_associated
  use fuge_kinds, only: dp
  use fuge_locks, only: lock, unlock, LOCK_PLANNER
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_CALL_ORDER, FUGE_ERR_MEMORY, FUGE_ERR_OPTION, &
    FUGE_ERR_SIZE
  use fuge_number_text, only: text
  implicit none
  private

  public :: good_length

  integer(c_int), parameter :: FFTW_MEASURE = 0
  integer(c_int), parameter :: FFTW_ESTIMATE = 64
  integer, parameter :: int64 = selected_int_kind(18)

  !> Transforms of one length, forward and back.
  !>
  !> The assignment makes plans of its own. A copy bit by bit, as allocate(source=)
  !> makes, must not be used: it does not own the plans and cannot know how long they live.
  type, public :: fft_plan
    !> Number of values; 0 while not set.
    integer :: length = 0
    !> Threads of one transform.
    integer :: threads = 1
    !> The plan was chosen by trying.
    logical :: measured = .false.
    type(c_ptr), private :: forward = c_null_ptr
    type(c_ptr), private :: backward = c_null_ptr
    !> Address of the owner.
    type(c_ptr), private :: home = c_null_ptr
  contains
    procedure :: set
    procedure :: free
    procedure :: take
    procedure :: transform_even
    procedure :: convolve
    procedure, private :: owner
    procedure, private :: settle
    procedure, private :: copy
    generic :: assignment(=) => copy
    final :: finish
  end type fft_plan

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

    subroutine fftw_make_planner_thread_safe() bind(c, name='fftw_make_planner_thread_safe')
    end subroutine fftw_make_planner_thread_safe

    !> 0 if there are no threads.
    function fftw_init_threads() bind(c, name='fftw_init_threads') result(done)
      import :: c_int
      integer(c_int) :: done
    end function fftw_init_threads

    subroutine fftw_plan_with_nthreads(threads) bind(c, name='fftw_plan_with_nthreads')
      import :: c_int
      integer(c_int), intent(in), value :: threads
    end subroutine fftw_plan_with_nthreads

    function fftw_planner_nthreads() bind(c, name='fftw_planner_nthreads') result(threads)
      import :: c_int
      integer(c_int) :: threads
    end function fftw_planner_nthreads

    function fftw_plan_r2c(n, in, out, flags) bind(c, name='fftw_plan_dft_r2c_1d') result(plan)
      import :: c_int, c_ptr
      integer(c_int), intent(in), value :: n, flags
      type(c_ptr), intent(in), value :: in, out
      type(c_ptr) :: plan
    end function fftw_plan_r2c

    function fftw_plan_c2r(n, in, out, flags) bind(c, name='fftw_plan_dft_c2r_1d') result(plan)
      import :: c_int, c_ptr
      integer(c_int), intent(in), value :: n, flags
      type(c_ptr), intent(in), value :: in, out
      type(c_ptr) :: plan
    end function fftw_plan_c2r

    subroutine fftw_execute_r2c(plan, in, out) bind(c, name='fftw_execute_dft_r2c')
      import :: c_ptr
      type(c_ptr), intent(in), value :: plan, in, out
    end subroutine fftw_execute_r2c

    subroutine fftw_execute_c2r(plan, in, out) bind(c, name='fftw_execute_dft_c2r')
      import :: c_ptr
      type(c_ptr), intent(in), value :: plan, in, out
    end subroutine fftw_execute_c2r

    subroutine fftw_destroy_plan(plan) bind(c, name='fftw_destroy_plan')
      import :: c_ptr
      type(c_ptr), intent(in), value :: plan
    end subroutine fftw_destroy_plan
  end interface

contains

  !> Least even 2^a 3^b 5^c 7^d >= n: a length that FFTW transforms fast; 0 if it
  !> would not be a default integer.
  pure function good_length(n) result(length)
    integer, intent(in) :: n
    integer :: length
    integer(int64) :: best, fives, sevens, threes, twos

    best = huge(best)
    sevens = 2
    do while (sevens < 14_int64*max(n, 1))
      fives = sevens
      do while (fives < 10_int64*max(n, 1))
        threes = fives
        do while (threes < 6_int64*max(n, 1))
          twos = threes
          do while (twos < n)
            twos = 2*twos
          end do
          best = min(best, twos)
          threes = 3*threes
        end do
        fives = 5*fives
      end do
      sevens = 7*sevens
    end do
    length = 0
    if (best <= huge(length)) length = int(best)
  end function good_length

  !> Plan transforms of `length` >= 1 values.
  !>
  !> `threads` (default 1) share each transform; `measured` (default .false.) tries
  !> which way is fastest, which takes seconds for long ones.
  !> Errors, the plan as it was: FUGE_ERR_SIZE, FUGE_ERR_OPTION, FUGE_ERR_MEMORY.
  subroutine set(self, length, info, threads, measured)
    class(fft_plan), intent(inout) :: self
    integer, intent(in) :: length
    type(fuge_info), intent(inout) :: info
    integer, intent(in), optional :: threads
    logical, intent(in), optional :: measured
    type(fft_plan) :: fresh

    fresh%length = length
    if (present(threads)) fresh%threads = threads
    if (present(measured)) fresh%measured = measured
    if (length < 1) then
      call report(info, FUGE_ERR_SIZE, 'length = '//text(length)//': a transform needs at least one value')
    else if (fresh%threads < 1) then
      call report(info, FUGE_ERR_OPTION, 'threads = '//text(fresh%threads)//': use 1 or more')
    else
      call make_plans(fresh, info)
    end if
    if (.not. info%failed()) call self%take(fresh)
  end subroutine set

  subroutine make_plans(plan, info)
    type(fft_plan), intent(inout) :: plan
    type(fuge_info), intent(inout) :: info
    logical :: ready

    call lock(LOCK_PLANNER)
    ready = fftw_init_threads() /= 0
    if (ready) call make_both(plan)
    call unlock(LOCK_PLANNER)
    if (.not. ready) then
      call report(info, FUGE_ERR_OPTION, 'threads = '//text(plan%threads)//': FFTW cannot start threads at all')
    else if (c_associated(plan%forward) .and. c_associated(plan%backward)) then
      call plan%settle()
    else
      call destroy(plan%forward, plan%backward)
      call report(info, FUGE_ERR_MEMORY, 'out of memory: a transform of '//text(plan%length)//' values needs ' &
                  //text(3.0_dp*real(buffer_bytes(plan%length), dp))//' bytes')
    end if
  end subroutine make_plans

  !> Within the lock.
  subroutine make_both(plan)
    type(fft_plan), intent(inout) :: plan
    type(c_ptr) :: buffer
    integer(c_int) :: before, flags

    call fftw_make_planner_thread_safe()
    ! The host program may have a number of its own.
    before = fftw_planner_nthreads()
    if (before /= plan%threads) call fftw_plan_with_nthreads(int(plan%threads, c_int))
    ! FFTW aborts where its own tables find no memory: first see whether there is
    ! twice as much again. Nothing is written, so that it costs no time.
    buffer = fftw_malloc(3*buffer_bytes(plan%length))
    if (c_associated(buffer)) then
      flags = merge(FFTW_MEASURE, FFTW_ESTIMATE, plan%measured)
      plan%forward = fftw_plan_r2c(int(plan%length, c_int), buffer, buffer, flags)
      plan%backward = fftw_plan_c2r(int(plan%length, c_int), buffer, buffer, flags)
      call fftw_free(buffer)
    end if
    if (before /= plan%threads) call fftw_plan_with_nthreads(before)
  end subroutine make_both

  !> Of the values, or in their place the complex numbers 0 .. length/2.
  pure function buffer_bytes(length) result(bytes)
    integer, intent(in) :: length
    integer(c_size_t) :: bytes

    bytes = 16_c_size_t*(length/2 + 1)
  end function buffer_bytes

  !> As if never set. Idle on a plan that is not set.
  subroutine free(self)
    class(fft_plan), intent(inout) :: self

    if (self%owner()) call destroy(self%forward, self%backward)
    self%forward = c_null_ptr
    self%backward = c_null_ptr
    self%home = c_null_ptr
    self%length = 0
  end subroutine free

  subroutine destroy(forward, backward)
    type(c_ptr), intent(in) :: forward, backward

    if (c_associated(forward)) call fftw_destroy_plan(forward)
    if (c_associated(backward)) call fftw_destroy_plan(backward)
  end subroutine destroy

  !> Are the plans its own?
  function owner(self) result(own)
    class(fft_plan), intent(in), target :: self
    logical :: own

    own = c_associated(self%home)
    if (own) own = c_associated(self%home, c_loc(self%length))
  end function owner

  impure elemental subroutine finish(self)
    type(fft_plan), intent(inout) :: self

    call self%free()
  end subroutine finish

  !> Own the plans. Only the address counts, nothing is read through it.
  subroutine settle(self)
    class(fft_plan), intent(inout), target :: self

    self%home = c_loc(self%length)
  end subroutine settle

  !> Take the plans of `source`, which is then not set.
  subroutine take(self, source)
    class(fft_plan), intent(inout) :: self
    class(fft_plan), intent(inout) :: source

    call self%free()
    self%threads = source%threads
    self%measured = source%measured
    if (.not. source%owner()) return
    self%length = source%length
    self%forward = source%forward
    self%backward = source%backward
    call self%settle()
    source%home = c_null_ptr
    call source%free()
  end subroutine take

  !> Plans of its own, because each side destroys what it has. Without memory for
  !> them the copy is not set. Not elemental: gfortran would copy bit by bit.
  subroutine copy(self, source)
    class(fft_plan), intent(inout) :: self
    class(fft_plan), intent(in) :: source
    type(fft_plan) :: fresh
    type(fuge_info) :: info

    if (source%length > 0) call fresh%set(source%length, info, source%threads, source%measured)
    call self%take(fresh)
  end subroutine copy

  !> The spectrum of an even kernel, over the length, so that `convolve` needs no scaling.
  !>
  !> `kernel` (length/2 + 1): in, values at the distances 0 .. length/2; out, their
  !> spectrum. `status`: 0, FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE, FUGE_ERR_MEMORY.
  subroutine transform_even(self, kernel, status)
    class(fft_plan), intent(in) :: self
    real(dp), intent(inout) :: kernel(0:)
    integer, intent(out) :: status
    real(c_double), pointer, contiguous :: work(:)
    type(c_ptr) :: buffer
    integer :: k, half

    half = self%length/2
    call take_buffer(self, size(kernel) == half + 1, buffer, work, status)
    if (status /= FUGE_DONE) return
    work(:half + 1) = kernel
    do k = half + 1, self%length - 1
      work(k + 1) = kernel(self%length - k)
    end do
    call fftw_execute_r2c(self%forward, buffer, buffer)
    do k = 0, half
      kernel(k) = work(2*k + 1)/real(self%length, dp)
    end do
    call fftw_free(buffer)
  end subroutine transform_even

  !> y = inverse transform of spectrum times the transform of x.
  !>
  !> `spectrum` (length/2 + 1), as `transform_even` makes it; `x` of at most the
  !> length, as if zeros followed; `y` the first values of the product, at most the
  !> length. A plan may be used by several threads at once.
  !> `status`: 0, or with y as it was FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE, FUGE_ERR_MEMORY.
  subroutine convolve(self, spectrum, x, y, status)
    class(fft_plan), intent(in) :: self
    real(dp), intent(in) :: spectrum(:), x(:)
    real(dp), intent(inout) :: y(:)
    integer, intent(out) :: status
    real(c_double), pointer, contiguous :: work(:)
    type(c_ptr) :: buffer
    integer :: k

    call take_buffer(self, size(spectrum) == self%length/2 + 1 .and. max(size(x), size(y)) <= self%length, &
                     buffer, work, status)
    if (status /= FUGE_DONE) return
    work(:size(x)) = x
    work(size(x) + 1:) = 0.0_c_double
    call fftw_execute_r2c(self%forward, buffer, buffer)
    do k = 1, size(spectrum)
      work(2*k - 1) = work(2*k - 1)*spectrum(k)
      work(2*k) = work(2*k)*spectrum(k)
    end do
    call fftw_execute_c2r(self%backward, buffer, buffer)
    y = work(:size(y))
    call fftw_free(buffer)
  end subroutine convolve

  !> Memory for one transform, to be given back with fftw_free if the status is 0.
  subroutine take_buffer(self, sizes_match, buffer, work, status)
    class(fft_plan), intent(in) :: self
    logical, intent(in) :: sizes_match
    type(c_ptr), intent(out) :: buffer
    real(c_double), pointer, contiguous, intent(out) :: work(:)
    integer, intent(out) :: status

    nullify (work)
    buffer = c_null_ptr
    if (.not. self%owner()) then
      status = FUGE_ERR_CALL_ORDER
    else if (.not. sizes_match) then
      status = FUGE_ERR_SIZE
    else
      buffer = fftw_malloc(buffer_bytes(self%length))
      status = merge(FUGE_DONE, FUGE_ERR_MEMORY, c_associated(buffer))
      if (status == FUGE_DONE) call c_f_pointer(buffer, work, [2*(int(self%length/2, c_size_t) + 1)])
    end if
  end subroutine take_buffer

end module fuge_fft
