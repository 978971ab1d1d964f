!> Fourier transforms of real values by FFTW; the only module that calls FFTW.
!>
!> An even number of values is transformed as half as many complex numbers, in place: value 2j + 1 is the
!> imaginary part that belongs to value 2j, and the caller separates the two (fuge_convolution). FFTW plans
!> that in a small fraction of the time that it takes for real values. Grids (fuge_grid_convolution) are made of
!> short lines, each transformed from one buffer to another, which is faster where both stay in cache. Where a grid is
!> transformed as a whole (fuge_grid_waves), its values are not packed.
!>
!> The whole process shares one planner of FFTW, under a lock of this module: a process that is forked waits for it. The
!> first plan also switches on FFTW's own lock, for a host program that plans transforms in another thread at the same
!> time; it must call fftw_make_planner_thread_safe before it starts threads. Each transform is done by one thread.
module fuge_fft
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_float, c_int, c_loc, c_null_ptr, &
    c_ptr, c_size_t
  use fuge_fftw, only: fftw_destroy_plan, fftw_execute_c2c, fftw_execute_c2r, fftw_execute_r2c, fftw_free, &
    fftw_malloc, fftw_plan_c2c, fftw_plan_c2r, fftw_plan_grid_c2r, fftw_plan_grid_r2c, fftw_plan_r2c, &
    fftwf_destroy_plan, fftwf_execute_c2c, fftwf_plan_c2c, FFTW_ESTIMATE, FFTW_FORWARD, &
    FFTW_MEASURE, FFTW_NO_BUFFERING, HAS_FFTW
  use fuge_fftw_planner, only: fftw_make_planner_thread_safe, fftwf_make_planner_thread_safe
  use fuge_kinds, only: dp
  use fuge_locks, only: lock, unlock, LOCK_PLANNER
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_CALL_ORDER, FUGE_ERR_MEMORY, FUGE_ERR_SIZE, &
    FUGE_ERR_UNSUPPORTED
  implicit none
  private

  public :: allocate_values, fast_length, good_length, release_buffer

  !> Complex numbers from which on a transform is long.
  integer, parameter :: LONG = 4096
  integer, parameter :: int64 = selected_int_kind(18)

  !> Forward and backward transforms of one length.
  !>
  !> Assignment creates new plans. A bitwise copy, as by allocate(source=), must not be used: it
  !> does not own the plans and cannot know when they are destroyed.
  type, public :: fft_plan
    !> Number of values; 0 before `set`.
    integer :: length = 0
    !> FFTW has chosen the plans by measurement.
    logical :: measured = .false.
    !> Transforms of packed values from one buffer to another, by `transform_to`, instead of in place.
    logical :: separate = .false.
    !> In single precision; only with `separate`.
    logical :: single = .false.
    !> Lines of `length` values that are transformed together, in both directions; 0: one line, packed where possible.
    integer :: lines = 0
    type(c_ptr), private :: forward = c_null_ptr
    !> For values that are not packed.
    type(c_ptr), private :: backward = c_null_ptr
    !> Address of the variable that owns the plans.
    type(c_ptr), private :: owner = c_null_ptr
  contains
    procedure :: set
    procedure :: free
    procedure :: move_from
    procedure :: is_packed
    procedure :: allocate_buffer
    procedure :: transform
    procedure :: transform_back
    procedure :: transform_to
    procedure :: owns_plans
    procedure, private :: own_plans
    procedure, private :: copy
    generic :: assignment(=) => copy
    final :: finish
  end type fft_plan

  !> Lines of real numbers for transforms.
  interface allocate_values
    module procedure :: allocate_double, allocate_single
  end interface allocate_values

contains

  !> Least even 2^a 3^b 5^c 7^d >= n, a length that FFTW transforms fast; 0 if it exceeds the
  !> largest default integer.
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

  !> A length >= n that FFTW transforms in the least time without measuring; 0 if it exceeds the largest default
  !> integer.
  !>
  !> Its estimate costs, for each prime factor 3, 5 or 7 about 1.5, 1.1 and 1.4 times as much as powers of two of the
  !> same length.
  pure function fast_length(n) result(length)
    integer, intent(in) :: n
    integer :: length
    integer, parameter :: FACTORS(7) = [1, 3, 5, 7, 9, 15, 25]
    real(dp), parameter :: WEIGHTS(7) = [1.0_dp, 1.5_dp, 1.1_dp, 1.4_dp, 2.3_dp, 1.5_dp, 1.4_dp]
    real(dp) :: candidate, best
    integer :: k

    length = 0
    best = huge(best)
    do k = 1, size(FACTORS)
      candidate = real(FACTORS(k), dp)
      do while (candidate < real(n, dp))
        candidate = 2.0_dp*candidate
      end do
      if (candidate > real(huge(n), dp) .or. candidate*WEIGHTS(k) >= best) cycle
      best = candidate*WEIGHTS(k)
      length = int(candidate)
    end do
  end function fast_length

  !> Plan transforms of `length` >= 1 values.
  !>
  !> With `measured` (default .false.) FFTW measures which algorithm is fastest, which takes seconds for long
  !> transforms. `separate` (default .false.) plans for `transform_to`; then `length` must be even. With `lines` >= 1
  !> the values are a grid of as many lines, transformed in both directions; then `separate` is not allowed. `single`
  !> (default .false.) needs `separate`. Errors, the plan unchanged: FUGE_ERR_SIZE, FUGE_ERR_MEMORY;
  !> FUGE_ERR_UNSUPPORTED in a library that was built without FFTW.
  subroutine set(self, length, info, measured, separate, lines, single)
    class(fft_plan), intent(inout) :: self
    integer, intent(in) :: length
    type(fuge_info), intent(inout) :: info
    logical, intent(in), optional :: measured, separate, single
    integer, intent(in), optional :: lines
    type(fft_plan) :: new_plan

    new_plan%length = length
    if (present(measured)) new_plan%measured = measured
    if (present(separate)) new_plan%separate = separate
    if (present(lines)) new_plan%lines = lines
    if (present(single)) new_plan%single = single
    if (length < 1) then
      call report(info, FUGE_ERR_SIZE, 'length = '//text(length)//': a transform needs at least one value')
    else if (new_plan%separate .and. mod(length, 2) /= 0) then
      call report(info, FUGE_ERR_SIZE, 'length = '//text(length)//': pairs of values need an even length')
    else if (new_plan%lines < 0 .or. (new_plan%lines > 0 .and. new_plan%separate)) then
      call report(info, FUGE_ERR_SIZE, 'lines = '//text(new_plan%lines)//': use 1 or more, in place')
    else if (.not. HAS_FFTW) then
      call report(info, FUGE_ERR_UNSUPPORTED, 'this library was built without FFTW (FUGE_WITH_FFTW=OFF), which ' &
                  //'operators by FFT and stresses on grids need: build it with FFTW, or use a matrix, or stresses ' &
                  //'at points')
    else
      call make_plans(new_plan, info)
    end if
    if (.not. info%failed()) call self%move_from(new_plan)
  end subroutine set

  !> Create the plans of checked options. Error: FUGE_ERR_MEMORY.
  subroutine make_plans(plan, info)
    type(fft_plan), intent(inout) :: plan
    type(fuge_info), intent(inout) :: info

    call lock(LOCK_PLANNER)
    call plan_both_directions(plan)
    call unlock(LOCK_PLANNER)
    if (c_associated(plan%forward) .and. (c_associated(plan%backward) .or. plan%is_packed())) then
      call plan%own_plans()
    else
      call destroy(plan%single, plan%forward, plan%backward)
      call report(info, FUGE_ERR_MEMORY, 'no memory: a transform of '//text(plan%length)//' values needs ' &
                  //text(3.0_dp*real(buffer_bytes(plan), dp))//' bytes')
    end if
  end subroutine make_plans

  !> Create both plans while the planner is locked; a plan is null without memory.
  subroutine plan_both_directions(plan)
    type(fft_plan), intent(inout) :: plan
    type(c_ptr) :: buffer, other
    integer(c_int) :: flags

    call fftw_make_planner_thread_safe()
    call fftwf_make_planner_thread_safe()
    ! FFTW aborts when there is no memory for its own tables, so test first that twice as much again
    ! can be allocated. It is never touched and costs no time.
    buffer = fftw_malloc(3*buffer_bytes(plan))
    if (c_associated(buffer)) then
      flags = merge(FFTW_MEASURE, FFTW_ESTIMATE, plan%measured)
      if (plan%separate) then
        other = fftw_malloc(buffer_bytes(plan))
        if (c_associated(other)) then
          if (plan%single) then
            plan%forward = fftwf_plan_c2c(int(plan%length/2, c_int), buffer, other, FFTW_FORWARD, flags)
          else
            plan%forward = fftw_plan_c2c(int(plan%length/2, c_int), buffer, other, FFTW_FORWARD, flags)
          end if
          call fftw_free(other)
        end if
      else if (plan%lines > 0) then
        plan%forward = fftw_plan_grid_r2c(int(plan%lines, c_int), int(plan%length, c_int), buffer, buffer, flags)
        plan%backward = fftw_plan_grid_c2r(int(plan%lines, c_int), int(plan%length, c_int), buffer, buffer, flags)
      else if (plan%is_packed()) then
        if (plan%length/2 >= LONG .and. .not. plan%measured) flags = flags + FFTW_NO_BUFFERING
        plan%forward = fftw_plan_c2c(int(plan%length/2, c_int), buffer, buffer, FFTW_FORWARD, flags)
      else
        plan%forward = fftw_plan_r2c(int(plan%length, c_int), buffer, buffer, flags)
        plan%backward = fftw_plan_c2r(int(plan%length, c_int), buffer, buffer, flags)
      end if
      call fftw_free(buffer)
    end if
  end subroutine plan_both_directions

  !> Are the values, an even number, transformed as half as many complex numbers?
  pure function is_packed(self) result(packed)
    class(fft_plan), intent(in) :: self
    logical :: packed

    packed = mod(self%length, 2) == 0 .and. self%lines == 0
  end function is_packed

  !> Bytes of a buffer for the values, which the complex numbers 0 .. length/2 of each line may overwrite.
  pure function buffer_bytes(plan) result(bytes)
    class(fft_plan), intent(in) :: plan
    integer(c_size_t) :: bytes

    bytes = 16_c_size_t*(plan%length/2 + 1)*max(plan%lines, 1)
  end function buffer_bytes

  !> Destroy the plans; without effect before `set`.
  subroutine free(self)
    class(fft_plan), intent(inout) :: self

    if (self%owns_plans()) call destroy(self%single, self%forward, self%backward)
    self%forward = c_null_ptr
    self%backward = c_null_ptr
    self%owner = c_null_ptr
    self%length = 0
  end subroutine free

  !> Destroy plans that exist, under the lock of the planner: FFTW's own would stay locked in a child forked meanwhile.
  subroutine destroy(single, forward, backward)
    logical, intent(in) :: single
    type(c_ptr), intent(in) :: forward, backward

    call lock(LOCK_PLANNER)
    if (single .and. c_associated(forward)) then
      call fftwf_destroy_plan(forward)
    else if (c_associated(forward)) then
      call fftw_destroy_plan(forward)
    end if
    if (c_associated(backward)) call fftw_destroy_plan(backward)
    call unlock(LOCK_PLANNER)
  end subroutine destroy

  !> Does this variable own the plans? A bitwise copy does not.
  function owns_plans(self) result(own)
    class(fft_plan), intent(in), target :: self
    logical :: own

    own = c_associated(self%owner)
    if (own) own = c_associated(self%owner, c_loc(self%length))
  end function owns_plans

  !> Destroy the plans at the end of their life.
  impure elemental subroutine finish(self)
    type(fft_plan), intent(inout) :: self

    call self%free()
  end subroutine finish

  !> Become the owner of the plans. The address is only compared, never dereferenced.
  subroutine own_plans(self)
    class(fft_plan), intent(inout), target :: self

    self%owner = c_loc(self%length)
  end subroutine own_plans

  !> Move the plans from `source`, which has none afterwards.
  subroutine move_from(self, source)
    class(fft_plan), intent(inout) :: self
    class(fft_plan), intent(inout) :: source

    call self%free()
    self%measured = source%measured
    self%separate = source%separate
    self%lines = source%lines
    self%single = source%single
    if (.not. source%owns_plans()) return
    self%length = source%length
    self%forward = source%forward
    self%backward = source%backward
    call self%own_plans()
    source%owner = c_null_ptr
    call source%free()
  end subroutine move_from

  !> Assignment: create new plans, because each variable destroys its own. Without memory the
  !> copy has no plans. Not elemental, because gfortran would then copy bitwise.
  subroutine copy(self, source)
    class(fft_plan), intent(inout) :: self
    class(fft_plan), intent(in) :: source
    type(fft_plan) :: new_plan
    type(fuge_info) :: info

    if (source%length > 0) call new_plan%set(source%length, info, source%measured, source%separate, source%lines, &
                                             source%single)
    call self%move_from(new_plan)
  end subroutine copy

  !> Transform the values in `buffer`, in place. Packed values are pairs of real and imaginary parts, before
  !> and after; otherwise the complex numbers 0 .. length/2 replace them, of each line, for which there is room behind
  !> the values of the line. Several threads may use a plan at once.
  subroutine transform(self, buffer)
    class(fft_plan), intent(in) :: self
    type(c_ptr), intent(in) :: buffer

    if (self%is_packed()) then
      call fftw_execute_c2c(self%forward, buffer, buffer)
    else
      call fftw_execute_r2c(self%forward, buffer, buffer)
    end if
  end subroutine transform

  !> The inverse of `transform` but for a factor: length/2 for packed values, else the number of values. Packed values
  !> have real and imaginary parts exchanged, before and after: then the same plan serves.
  subroutine transform_back(self, buffer)
    class(fft_plan), intent(in) :: self
    type(c_ptr), intent(in) :: buffer

    if (self%is_packed()) then
      call fftw_execute_c2c(self%forward, buffer, buffer)
    else
      call fftw_execute_c2r(self%backward, buffer, buffer)
    end if
  end subroutine transform_back

  !> Transform the packed values `from`, which stay as they are, to `to`, by a plan that is `separate`. The inverse is
  !> that of `transform_back`: the same plan, parts exchanged. Several threads may use a plan at once.
  subroutine transform_to(self, from, to)
    class(fft_plan), intent(in) :: self
    type(c_ptr), intent(in) :: from, to

    if (self%single) then
      call fftwf_execute_c2c(self%forward, from, to)
    else
      call fftw_execute_c2c(self%forward, from, to)
    end if
  end subroutine transform_to

  !> Allocate a buffer for one transform, to be released with `release_buffer` if `status` is 0.
  !>
  !> `values`: its contents, 2 (length/2 + 1) real numbers for each line. `status`: 0, FUGE_ERR_CALL_ORDER or
  !> FUGE_ERR_MEMORY.
  subroutine allocate_buffer(self, buffer, values, status)
    class(fft_plan), intent(in) :: self
    type(c_ptr), intent(out) :: buffer
    real(c_double), pointer, contiguous, intent(out) :: values(:)
    integer, intent(out) :: status

    nullify (values)
    buffer = c_null_ptr
    if (.not. self%owns_plans()) then
      status = FUGE_ERR_CALL_ORDER
    else
      buffer = fftw_malloc(buffer_bytes(self))
      status = merge(FUGE_DONE, FUGE_ERR_MEMORY, c_associated(buffer))
      if (status == FUGE_DONE) call c_f_pointer(buffer, values, &
                                                [2*(int(self%length/2, c_size_t) + 1)*max(self%lines, 1)])
    end if
  end subroutine allocate_buffer

  !> Allocate `columns` lines of `rows` real numbers, aligned for FFTW if `rows` is even; to be released with
  !> `release_buffer` if `status` is 0, not FUGE_ERR_MEMORY.
  subroutine allocate_double(rows, columns, buffer, values, status)
    integer, intent(in) :: rows, columns
    type(c_ptr), intent(out) :: buffer
    real(c_double), pointer, contiguous, intent(out) :: values(:, :)
    integer, intent(out) :: status

    nullify (values)
    buffer = fftw_malloc(8_c_size_t*int(rows, c_size_t)*int(columns, c_size_t))
    status = merge(FUGE_DONE, FUGE_ERR_MEMORY, c_associated(buffer))
    if (status == FUGE_DONE) call c_f_pointer(buffer, values, [rows, columns])
  end subroutine allocate_double

  !> The same in single precision, aligned if `rows` is a multiple of four.
  subroutine allocate_single(rows, columns, buffer, values, status)
    integer, intent(in) :: rows, columns
    type(c_ptr), intent(out) :: buffer
    real(c_float), pointer, contiguous, intent(out) :: values(:, :)
    integer, intent(out) :: status

    nullify (values)
    buffer = fftw_malloc(4_c_size_t*int(rows, c_size_t)*int(columns, c_size_t))
    status = merge(FUGE_DONE, FUGE_ERR_MEMORY, c_associated(buffer))
    if (status == FUGE_DONE) call c_f_pointer(buffer, values, [rows, columns])
  end subroutine allocate_single

  subroutine release_buffer(buffer)
    type(c_ptr), intent(in) :: buffer

    call fftw_free(buffer)
  end subroutine release_buffer

end module fuge_fft
