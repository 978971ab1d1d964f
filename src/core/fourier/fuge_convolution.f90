!> Products with symmetric circulant and Toeplitz matrices by Fourier transforms.
!>
!> A cyclic convolution of N values multiplies their transform by the spectrum of an even kernel, which is real. N even
!> values are transformed as N/2 complex numbers, whose transforms are multiplied by the factors of fuge_pair_factors.
!>
!> A convolution on a circle of 2N cells is half the sum of two on N: a cyclic one with the even numbers of the
!> spectrum, of the sums of values half a circle apart, and one with the odd ones, of their differences, where whatever
!> goes once round the circle changes its sign. The second needs the numbers 1, 5, 9, .. only, the transform of the N/2
!> complex numbers (x_j - i x_(j+N/2)) exp(-i pi j/N). Two transforms of N values take less time than one of 2N, and two
!> threads share them. That is done where values are followed by as many zeros, and on long circles.
module fuge_convolution
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_loc, c_ptr
  use fuge_constants, only: PI
  use fuge_fft, only: fft_plan, release_buffer
  use fuge_kinds, only: dp
  use fuge_line_plan, only: is_folded, line_plan
  use fuge_pair_factors, only: pair_factors, soften
  use fuge_spectrum_bounds, only: spectrum_bounds
  use fuge_status, only: FUGE_DONE, FUGE_ERR_CALL_ORDER, FUGE_ERR_MEMORY, FUGE_ERR_SIZE
  use fuge_threads, only: run_in_parts, work_in_parts
  use fuge_unit_roots, only: fill_roots
  implicit none
  private

  public :: transform_even, transform_padded

  !> The spectrum of an even kernel, prepared for `convolve`.
  type, public :: convolution_kernel
    !> Number of values N of the plan; 0 before it is set.
    integer :: length = 0
    !> Its circle is done as two of N/2.
    logical, private :: folded = .false.
    !> For even N the factors of the numbers k and N/2-k (fuge_pair_factors), (3, 0:N/4); for odd N the spectrum,
    !> (1, 0:N/2). If it is folded, those of N/2.
    real(dp), allocatable, private :: factors(:, :)
    !> On a circle of 2N cells: the numbers 1, 5, .. of the spectrum, and exp(-i pi j/N), real and imaginary parts,
    !> (2, N/2). If it is folded, those on N cells.
    real(dp), allocatable, private :: odd_factors(:), twist(:, :)
    !> Of the spectrum, which the factors do not show.
    type(spectrum_bounds) :: bounds
  contains
    procedure :: set_cyclic
    procedure :: set_padded
    procedure :: copy_from
    procedure :: move_from
    procedure :: convolve
    final :: release
  end type convolution_kernel

  !> The transforms of both circles of a product; two threads share them.
  type, extends(work_in_parts) :: circle_pair
    type(convolution_kernel), pointer :: kernel => null()
    type(fft_plan), pointer :: plan => null()
    real(dp), pointer, contiguous :: x(:) => null()
    real(c_double), pointer, contiguous :: even(:) => null(), odd(:) => null()
  contains
    procedure :: do_part => convolve_circle
  end type circle_pair

contains

  !> Set the spectrum of a cyclic convolution of `length` values.
  !>
  !> `spectrum` (0:length/2), divided by the length. `status`: 0, FUGE_ERR_SIZE, FUGE_ERR_MEMORY.
  pure subroutine set_cyclic(self, length, spectrum, status)
    class(convolution_kernel), intent(inout) :: self
    integer, intent(in) :: length
    real(dp), intent(in) :: spectrum(0:)
    integer, intent(out) :: status
    real(dp), allocatable :: odd(:)
    integer :: k

    call clear(self)
    status = FUGE_ERR_SIZE
    if (length < 1 .or. size(spectrum) /= length/2 + 1) return
    self%folded = is_folded(length)
    if (self%folded) then
      allocate (odd(length/4), stat=status)
      if (status /= 0) status = FUGE_ERR_MEMORY
      if (status /= FUGE_DONE) return
      do k = 1, size(odd)
        odd(k) = spectrum(min(4*k - 3, length - (4*k - 3)))
      end do
      call set_factors(self, length/2, spectrum(0::2), status)
      if (status == FUGE_DONE) call set_odd_factors(self, odd, status)
    else
      call set_factors(self, length, spectrum, status)
    end if
    if (status /= FUGE_DONE) return
    self%length = length
    self%bounds = spectrum_bounds(constant=spectrum(0), together=abs(spectrum(0)))
    call self%bounds%add_waves(spectrum(1:), 2)
    call self%bounds%scale_by(real(length, dp))
  end subroutine set_cyclic

  !> Set the spectrum of a convolution on a circle of 2*length cells, `length` even.
  !>
  !> `even` (0:length/2) the numbers 0, 2, .. of the spectrum, `odd` (length/2) the numbers 1, 5, 9, ..;
  !> both divided by 2*length. `status`: 0, FUGE_ERR_SIZE, FUGE_ERR_MEMORY.
  pure subroutine set_padded(self, length, even, odd, status)
    class(convolution_kernel), intent(inout) :: self
    integer, intent(in) :: length
    real(dp), intent(in) :: even(:), odd(:)
    integer, intent(out) :: status

    call clear(self)
    status = FUGE_ERR_SIZE
    if (length < 1 .or. mod(length, 2) /= 0 .or. size(even) /= length/2 + 1 .or. size(odd) /= length/2) return
    call set_factors(self, length, even, status)
    if (status == FUGE_DONE) call set_odd_factors(self, odd, status)
    if (status /= FUGE_DONE) return
    self%length = length
    self%bounds = spectrum_bounds(constant=even(1), together=abs(even(1)))
    call self%bounds%add_waves(even(2:), 2)
    call self%bounds%add_waves(odd, 2)
    call self%bounds%scale_by(2.0_dp*real(length, dp))
  end subroutine set_padded

  !> The factors of a circle of `length` values. `status`: 0 or FUGE_ERR_MEMORY.
  pure subroutine set_factors(self, length, spectrum, status)
    class(convolution_kernel), intent(inout) :: self
    integer, intent(in) :: length
    real(dp), intent(in) :: spectrum(0:)
    integer, intent(out) :: status
    real(dp), allocatable :: roots(:, :)
    integer :: k

    if (mod(length, 2) == 0) then
      allocate (self%factors(3, 0:length/4), roots(2, 0:length/4), stat=status)
    else
      allocate (self%factors(1, 0:length/2), stat=status)
    end if
    if (status /= 0) then
      status = FUGE_ERR_MEMORY
    else if (mod(length, 2) == 0) then
      call fill_roots(length, roots)
      do k = 0, length/4
        self%factors(:, k) = pair_factors(spectrum(k), spectrum(length/2 - k), roots(:, k))
      end do
    else
      self%factors(1, :) = spectrum
    end if
  end subroutine set_factors

  !> Those of the circle round which values change their sign, and its twist. `status`: 0 or FUGE_ERR_MEMORY.
  pure subroutine set_odd_factors(self, odd, status)
    class(convolution_kernel), intent(inout) :: self
    real(dp), intent(in) :: odd(:)
    integer, intent(out) :: status

    allocate (self%odd_factors(size(odd)), self%twist(2, size(odd)), stat=status)
    if (status /= 0) then
      status = FUGE_ERR_MEMORY
    else
      self%odd_factors = 2.0_dp*odd
      call fill_roots(4*size(odd), self%twist)
    end if
  end subroutine set_odd_factors

  !> Deallocate all arrays.
  pure subroutine clear(self)
    class(convolution_kernel), intent(inout) :: self

    self%length = 0
    self%folded = .false.
    if (allocated(self%factors)) deallocate (self%factors)
    if (allocated(self%odd_factors)) deallocate (self%odd_factors)
    if (allocated(self%twist)) deallocate (self%twist)
  end subroutine clear

  !> gfortran 12 does not free these arrays where a user's type holds an operator that holds the kernel.
  elemental subroutine release(self)
    type(convolution_kernel), intent(inout) :: self

    call clear(self)
  end subroutine release

  !> Copy a kernel; arrays of the right size are kept. `status` is not 0 without memory, and the copy is
  !> not set then.
  pure subroutine copy_from(self, source, status)
    class(convolution_kernel), intent(inout) :: self
    class(convolution_kernel), intent(in) :: source
    integer, intent(out) :: status

    status = 0
    self%length = 0
    if (.not. same_shapes(self, source)) then
      call clear(self)
      if (allocated(source%factors)) then
        allocate (self%factors(size(source%factors, 1), 0:ubound(source%factors, 2)), stat=status)
      end if
      if (allocated(source%odd_factors) .and. status == 0) then
        allocate (self%odd_factors(size(source%odd_factors)), self%twist(2, size(source%twist, 2)), stat=status)
      end if
      if (status /= 0) return
    end if
    if (allocated(source%factors)) self%factors(:, :) = source%factors
    if (allocated(source%odd_factors)) then
      self%odd_factors(:) = source%odd_factors
      self%twist(:, :) = source%twist
    end if
    self%bounds = source%bounds
    self%folded = source%folded
    self%length = source%length
  end subroutine copy_from

  !> Do both kernels have arrays of the same shapes?
  pure function same_shapes(self, source) result(same)
    class(convolution_kernel), intent(in) :: self, source
    logical :: same

    same = (allocated(self%factors) .eqv. allocated(source%factors)) &
           .and. (allocated(self%odd_factors) .eqv. allocated(source%odd_factors))
    if (same .and. allocated(source%factors)) same = all(shape(self%factors) == shape(source%factors))
    if (same .and. allocated(source%odd_factors)) same = size(self%odd_factors) == size(source%odd_factors)
  end function same_shapes

  !> Move the kernel from `source`, which is not set afterwards.
  pure subroutine move_from(self, source)
    class(convolution_kernel), intent(inout) :: self, source

    call clear(self)
    self%length = source%length
    self%folded = source%folded
    self%bounds = source%bounds
    if (allocated(source%factors)) call move_alloc(source%factors, self%factors)
    if (allocated(source%odd_factors)) call move_alloc(source%odd_factors, self%odd_factors)
    if (allocated(source%twist)) call move_alloc(source%twist, self%twist)
    source%length = 0
  end subroutine move_from

  !> The spectrum of an even kernel, divided by the length of `plan`.
  !>
  !> `kernel` (0:length/2): on entry the values at these distances, on return their spectrum. `status`: 0,
  !> FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE, FUGE_ERR_MEMORY.
  subroutine transform_even(plan, kernel, status)
    type(line_plan), intent(in) :: plan
    real(dp), intent(inout) :: kernel(0:)
    integer, intent(out) :: status
    real(c_double), pointer, contiguous :: work(:)
    type(c_ptr) :: buffer
    real(dp) :: theta
    integer :: half, k, other

    half = plan%length/2
    status = merge(FUGE_ERR_SIZE, FUGE_ERR_CALL_ORDER, plan%length > 0)
    if (plan%length < 1 .or. size(kernel) /= half + 1) return
    call plan%whole%allocate_buffer(buffer, work, status)
    if (status /= FUGE_DONE) return
    work(:half + 1) = kernel
    do k = half + 1, plan%length - 1
      work(k + 1) = kernel(plan%length - k)
    end do
    call plan%whole%transform(buffer)
    do k = 0, half
      if (mod(plan%length, 2) == 1) then
        kernel(k) = work(2*k + 1)
        cycle
      end if
      ! The number k of the even positions and that of the odd ones, of which only the real part is not zero.
      other = modulo(half - k, half)
      theta = 2.0_dp*PI*(real(k, dp)/real(plan%length, dp))
      associate (a => work(2*modulo(k, half) + 1), b => work(2*modulo(k, half) + 2), c => work(2*other + 1), &
                 d => work(2*other + 2))
        kernel(k) = 0.5_dp*((a + c) + (cos(theta)*(b + d) - sin(theta)*(a - c)))
      end associate
    end do
    kernel = kernel/real(plan%length, dp)
    call release_buffer(buffer)
  end subroutine transform_even

  !> The spectrum of an even kernel on a circle of 2N cells, divided by 2N, as `set_padded` takes it; N is
  !> the length of `plan`, even.
  !>
  !> `kernel` (0:N): the values at these distances, undefined on return; `even` (0:N/2), `odd` (N/2). `status`
  !> as for `transform_even`.
  subroutine transform_padded(plan, kernel, even, odd, status)
    type(line_plan), intent(in) :: plan
    real(dp), intent(inout) :: kernel(0:)
    real(dp), intent(out) :: even(0:), odd(:)
    integer, intent(out) :: status
    real(c_double), pointer, contiguous :: work(:)
    real(dp), allocatable :: twist(:, :)
    type(c_ptr) :: buffer
    integer :: j, n

    n = plan%length
    status = FUGE_ERR_SIZE
    if (size(kernel) /= n + 1 .or. size(even) /= n/2 + 1 .or. size(odd) /= n/2 .or. mod(n, 2) == 1) return
    do j = 0, n/2
      even(j) = kernel(j) + kernel(n - j)
    end do
    call transform_even(plan, even, status)
    if (status /= FUGE_DONE) return
    even = 0.5_dp*even
    allocate (twist(2, n/2), stat=status)
    if (status == 0) then
      call plan%whole%allocate_buffer(buffer, work, status)
    else
      status = FUGE_ERR_MEMORY
    end if
    if (status /= FUGE_DONE) return
    call fill_roots(2*n, twist)
    do j = 0, n/2
      ! Odd about N/2: kernel(j) becomes the value at j, kernel(n - j) that at n - j.
      kernel(j) = kernel(j) - kernel(n - j)
    end do
    do j = n/2 + 1, n - 1
      kernel(j) = -kernel(n - j)
    end do
    call twist_values(twist, kernel(:n - 1), work)
    call plan%whole%transform(buffer)
    do j = 1, n/2
      odd(j) = work(2*j - 1)/(2.0_dp*real(n, dp))
    end do
    call release_buffer(buffer)
  end subroutine transform_padded

  !> y = the first values of the convolution of x with the kernel.
  !>
  !> `plan` of the kernel's length N; `x` and `y` (at most N), x continued by zeros. With `softening` >= 0 each number s
  !> of the spectrum of a cyclic convolution becomes s/(1 + softening s): to the inverse of the kernel is added
  !> `softening`. Several threads may use kernel and plan at once. `status`: 0, or with y unchanged
  !> FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE, FUGE_ERR_MEMORY.
  subroutine convolve(self, plan, x, y, status, softening)
    class(convolution_kernel), intent(in) :: self
    type(line_plan), intent(in) :: plan
    real(dp), intent(in) :: x(:)
    real(dp), intent(inout) :: y(:)
    integer, intent(out) :: status
    real(dp), intent(in), optional :: softening
    type(convolution_kernel) :: softer
    real(dp) :: added

    status = merge(FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE, self%length == 0 .or. plan%length == 0)
    if (self%length /= plan%length .or. self%length == 0 .or. max(size(x), size(y)) > self%length) return
    if (present(softening) .and. allocated(self%odd_factors) .and. .not. self%folded) return
    added = 0.0_dp
    if (present(softening)) added = softening*real(self%length, dp)
    if (added > 0.0_dp) then
      call softer%copy_from(self, status)
      if (status /= 0) status = FUGE_ERR_MEMORY
      if (status /= FUGE_DONE) return
      call soften_all(added, softer)
      call convolve_values(softer, plan, size(x), x, size(y), y, status)
    else
      call convolve_values(self, plan, size(x), x, size(y), y, status)
    end if
  end subroutine convolve

  !> Soften all numbers of the spectrum.
  pure subroutine soften_all(added, kernel)
    real(dp), intent(in) :: added
    type(convolution_kernel), intent(inout) :: kernel

    if (size(kernel%factors, 1) == 3) then
      call soften(added, kernel%factors)
    else
      kernel%factors = kernel%factors/(1.0_dp + added*kernel%factors)
    end if
    ! These are twice the numbers.
    if (kernel%folded) kernel%odd_factors = kernel%odd_factors/(1.0_dp + 0.5_dp*added*kernel%odd_factors)
  end subroutine soften_all

  !> As `convolve`, checked. The arrays have an explicit shape, because gfortran copies arrays to pass them as
  !> contiguous ones.
  subroutine convolve_values(self, plan, values, x, results, y, status)
    type(convolution_kernel), intent(in) :: self
    type(line_plan), intent(in) :: plan
    integer, intent(in) :: values, results
    real(dp), intent(in) :: x(values)
    real(dp), intent(inout) :: y(results)
    integer, intent(out) :: status

    if (self%folded) then
      call convolve_circles(self, plan%half, values, x, results, y, status)
    else if (allocated(self%odd_factors)) then
      call convolve_circles(self, plan%whole, values, x, results, y, status)
    else
      call convolve_whole(self, plan%whole, x, y, status)
    end if
  end subroutine convolve_values

  !> The product on one circle.
  subroutine convolve_whole(self, plan, x, y, status)
    type(convolution_kernel), intent(in) :: self
    type(fft_plan), intent(in) :: plan
    real(dp), intent(in), contiguous :: x(:)
    real(dp), intent(inout), contiguous :: y(:)
    integer, intent(out) :: status
    real(c_double), pointer, contiguous :: work(:)
    type(c_ptr) :: buffer

    call plan%allocate_buffer(buffer, work, status)
    if (status /= FUGE_DONE) return
    work(:size(x)) = x
    work(size(x) + 1:) = 0.0_c_double
    call plan%transform(buffer)
    if (plan%is_packed()) then
      call multiply_packed(self%factors, work)
    else
      call multiply_numbers(self%factors(1, :), work)
    end if
    call plan%transform_back(buffer)
    if (plan%is_packed()) then
      call copy_exchanged(work, y)
    else
      y = work(:size(y))
    end if
    call release_buffer(buffer)
  end subroutine convolve_whole

  !> The product on two circles, each of the length of `plan`; x and y have at most twice as many values.
  subroutine convolve_circles(self, plan, values, x, results, y, status)
    type(convolution_kernel), intent(in), target :: self
    type(fft_plan), intent(in), target :: plan
    integer, intent(in) :: values, results
    real(dp), intent(in), target :: x(values)
    real(dp), intent(inout) :: y(results)
    integer, intent(out) :: status
    type(circle_pair) :: pair
    type(c_ptr) :: even, odd
    integer :: first

    call plan%allocate_buffer(even, pair%even, status)
    if (status /= FUGE_DONE) return
    call plan%allocate_buffer(odd, pair%odd, status)
    if (status == FUGE_DONE) then
      ! By addresses, because no pointer may be associated with arguments that are read only.
      call c_f_pointer(c_loc(self), pair%kernel)
      call c_f_pointer(c_loc(plan), pair%plan)
      call c_f_pointer(c_loc(x), pair%x, shape(x))
      if (is_folded(self%length)) then
        call run_in_parts(2, pair)
      else
        ! Waking another thread would take as long.
        call pair%do_part(0, 2)
        call pair%do_part(1, 2)
      end if
      first = min(plan%length, results)
      call copy_exchanged(pair%even, y(:first))
      call copy_exchanged(pair%even, y(first + 1:))
      call add_untwisted(self%twist, 1.0_dp, pair%odd, y(:first))
      call add_untwisted(self%twist, -1.0_dp, pair%odd, y(first + 1:))
      call release_buffer(odd)
    end if
    call release_buffer(even)
  end subroutine convolve_circles

  !> The product on the circle of sums (`part` 0) or of differences; `parts` is 2.
  subroutine convolve_circle(self, part, parts)
    class(circle_pair), intent(inout) :: self
    integer, intent(in) :: part, parts

    if (part < parts - 1) then
      call fold_values(self%x, self%even)
      call self%plan%transform(c_loc(self%even))
      call multiply_packed(self%kernel%factors, self%even)
      call self%plan%transform_back(c_loc(self%even))
    else
      call twist_values(self%kernel%twist, self%x, self%odd)
      call self%plan%transform(c_loc(self%odd))
      call multiply_exchanging(self%kernel%odd_factors, self%odd)
      call self%plan%transform_back(c_loc(self%odd))
    end if
  end subroutine convolve_circle

  !> Multiply the transform of pairs of values, `z` (real and imaginary parts), by the spectrum, and exchange
  !> the parts, as transform_back takes them.
  pure subroutine multiply_packed(factors, z)
    real(dp), intent(in), contiguous :: factors(:, 0:)
    real(dp), intent(inout), contiguous :: z(0:)
    real(dp) :: a, b, one(2), other(2)
    integer :: half, i, j, k

    half = (size(z) - 2)/2
    a = z(0)
    b = z(1)
    z(0) = factors(1, 0)*b + factors(3, 0)*a
    z(1) = factors(1, 0)*a + factors(3, 0)*b
    do k = 1, (half - 1)/2
      i = 2*k
      j = 2*(half - k)
      one = z(i:i + 1)
      other = z(j:j + 1)
      z(i:i + 1) = factors(1, k)*one(2:1:-1) + factors(3, k)*other
      z(j:j + 1) = factors(2, k)*other(2:1:-1) + factors(3, k)*one
    end do
    if (mod(half, 2) == 0 .and. half > 0) then
      one = z(half:half + 1)
      z(half:half + 1) = factors(1, half/2)*one(2:1:-1)
    end if
  end subroutine multiply_packed

  !> Copy pairs of values whose two are exchanged.
  pure subroutine copy_exchanged(pairs, values)
    real(dp), intent(in), contiguous :: pairs(:)
    real(dp), intent(inout), contiguous :: values(:)
    integer :: k

    do k = 1, size(values) - 1, 2
      values(k) = pairs(k + 1)
      values(k + 1) = pairs(k)
    end do
    if (mod(size(values), 2) == 1) values(size(values)) = pairs(size(values) + 1)
  end subroutine copy_exchanged

  !> Multiply complex numbers, `z` (real and imaginary parts), by real ones, and exchange their parts.
  pure subroutine multiply_exchanging(factors, z)
    real(dp), intent(in), contiguous :: factors(:)
    real(dp), intent(inout), contiguous :: z(:)
    real(dp) :: real_part
    integer :: k

    do k = 1, size(factors)
      real_part = z(2*k - 1)
      z(2*k - 1) = factors(k)*z(2*k)
      z(2*k) = factors(k)*real_part
    end do
  end subroutine multiply_exchanging

  !> Multiply complex numbers, `z` (real and imaginary parts), by real ones.
  pure subroutine multiply_numbers(factors, z)
    real(dp), intent(in), contiguous :: factors(:)
    real(dp), intent(inout), contiguous :: z(:)
    integer :: k

    do k = 1, size(factors)
      z(2*k - 1) = factors(k)*z(2*k - 1)
      z(2*k) = factors(k)*z(2*k)
    end do
  end subroutine multiply_numbers

  !> The sums of the values of x half a circle apart, x continued by zeros; `z` (N + 2) for N of them.
  pure subroutine fold_values(x, z)
    real(dp), intent(in), contiguous :: x(:)
    real(dp), intent(inout), contiguous :: z(:)
    integer :: first

    first = min(size(x), size(z) - 2)
    z(:first) = x(:first)
    z(first + 1:) = 0.0_dp
    z(:size(x) - first) = z(:size(x) - first) + x(first + 1:)
  end subroutine fold_values

  !> z_j = (d_j - i d_(j+N/2)) exp(-i pi j/N) for the differences d_j = x_j - x_(j+N), x continued by zeros; `twist`
  !> (2, N/2).
  pure subroutine twist_values(twist, x, z)
    real(dp), intent(in), contiguous :: twist(:, :), x(:)
    real(dp), intent(inout), contiguous :: z(:)
    integer :: first

    first = min(size(x), 2*size(twist, 2))
    z = 0.0_dp
    call add_twisted(twist, 1.0_dp, x(:first), z)
    call add_twisted(twist, -1.0_dp, x(first + 1:), z)
  end subroutine twist_values

  !> Add `factor` times x, at most N values, to what is twisted.
  pure subroutine add_twisted(twist, factor, x, z)
    real(dp), intent(in), contiguous :: twist(:, :), x(:)
    real(dp), intent(in) :: factor
    real(dp), intent(inout), contiguous :: z(:)
    integer :: half, j

    half = size(twist, 2)
    do j = 1, min(size(x), half)
      z(2*j - 1) = z(2*j - 1) + factor*twist(1, j)*x(j)
      z(2*j) = z(2*j) + factor*twist(2, j)*x(j)
    end do
    do j = 1, size(x) - half
      z(2*j - 1) = z(2*j - 1) + factor*twist(2, j)*x(j + half)
      z(2*j) = z(2*j) - factor*twist(1, j)*x(j + half)
    end do
  end subroutine add_twisted

  !> Add `factor` times what z, its parts exchanged, stands for to y, at most N values: z_j exp(i pi j/N) =
  !> y_j - i y_(j+N/2); `twist` (2, N/2).
  pure subroutine add_untwisted(twist, factor, z, y)
    real(dp), intent(in), contiguous :: twist(:, :), z(:)
    real(dp), intent(in) :: factor
    real(dp), intent(inout), contiguous :: y(:)
    integer :: half, j

    half = size(twist, 2)
    do j = 1, min(size(y), half)
      y(j) = y(j) + factor*(twist(1, j)*z(2*j) + twist(2, j)*z(2*j - 1))
    end do
    do j = 1, size(y) - half
      y(j + half) = y(j + half) + factor*(twist(2, j)*z(2*j) - twist(1, j)*z(2*j - 1))
    end do
  end subroutine add_untwisted

end module fuge_convolution
