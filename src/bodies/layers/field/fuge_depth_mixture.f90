!> Stresses and displacements at a depth of a body of layers as mixtures of Gaussians of the pressure on its surface.
!>
!> What a wave q of pressure gives there, times a power m of q, is the sum over k of w_k (t_k q)**m exp(-(t_k q)**2), of
!> the lengths t_k = exp(STEP k). In the top layer it is what a half-space of its material does not give, and decays at
!> least like exp(-q h), h the thickness of the layer, however close to the surface; below, all of it decays with the
!> depth. The weights are fitted by least squares. Beyond the last one they are a limit and two powers of 1/t, those of
!> a body that is a half-space for long waves.
module fuge_depth_mixture
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_constants, only: PI
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgelsy
  use fuge_layer_interior, only: layer_cut, ALONG, DOWN, NN, NZ, TT, ZZ
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: fit_at_depths, uniform_stress, mean_displacement

  !> Step of the rule in log t.
  real(dp), parameter, public :: STEP = 0.09_dp
  !> The numbers of Z, N, tt/p, X/q, U/q, (N - tt/p)/q**2 and -V/q**2, and the powers m of q for each.
  integer, parameter, public :: OF_ZZ = 1, OF_NN = 2, OF_TT = 3, OF_SLOPE = 4, OF_DOWN = 5, OF_DIFFERENCE = 6, &
    OF_ALONG = 7, FUNCTIONS = 7
  integer, parameter, public :: POWERS(FUNCTIONS) = [0, 0, 0, 1, 1, 2, 2]
  !> The first and the last of the functions with m = 0, 1, 2.
  integer, parameter :: FIRST_OF(0:2) = [1, 4, 6], LAST_OF(0:2) = [3, 5, 7]
  !> The shortest t is this fraction of the least distance from the depth to the surface, or in the top layer to the
  !> image of the surface in the first interface. Waves of q above SHORTEST_WAVE over that distance are negligible.
  real(dp), parameter :: FIRST_LENGTH = 1.0_dp/14.0_dp, SHORTEST_WAVE = 40.0_dp
  !> The longest t is LONG times the depth, or times the thickness of all layers times the ratio of their moduli,
  !> whichever is greater. The longest wave has LONGEST_WAVE over it as q.
  real(dp), parameter :: LONG = 1.0e3_dp, LONGEST_WAVE = 0.03_dp
  !> Waves of this q times `length_of_layers` count as infinitely long.
  real(dp), parameter :: LONGEST = 1.0e-7_dp
  !> Waves for each weight, and unknowns that stand for all longer t.
  integer, parameter :: WAVES = 3, BEYOND = 3
  !> Singular values below this fraction of the largest one are rounding.
  real(dp), parameter :: RANK_TOLERANCE = 1.0e-15_dp
  !> exp(-x**2) is less than rounding.
  real(dp), parameter, public :: NEGLIGIBLE = 6.3_dp
  !> Euler's constant.
  real(dp), parameter :: EULER = 0.57721566490153286_dp

  type, public :: depth_mixture
    !> The weights are those of k = first, first + 1, .., so many as `count`; there may be room for more (weights,
    !> functions).
    integer :: first = 0, count = 0
    real(dp), allocatable :: weight(:, :)
    !> Those of longer t are beyond(1) + beyond(2)*r**a + beyond(3)*r**(a + 2), r = t_last/t, with a = 2 if m is 1,
    !> otherwise 1; (BEYOND, functions).
    real(dp) :: beyond(BEYOND, FUNCTIONS) = 0.0_dp
  contains
    procedure :: weight_of
    procedure :: sum_from
    procedure :: datum_beyond
    procedure :: value_at
  end type depth_mixture

contains

  !> The weight number `k` of `function`.
  elemental function weight_of(self, function, k) result(weight)
    class(depth_mixture), intent(in) :: self
    integer, intent(in) :: function, k
    real(dp) :: weight
    real(dp) :: ratio
    integer :: a

    weight = 0.0_dp
    if (k < self%first) return
    if (k < self%first + self%count) then
      weight = self%weight(k - self%first + 1, function)
    else
      ratio = exp(-STEP*real(k - self%first - self%count + 1, dp))
      a = 1 + mod(POWERS(function), 2)
      weight = self%beyond(1, function) + self%beyond(2, function)*ratio**a + self%beyond(3, function)*ratio**(a + 2)
    end if
  end function weight_of

  !> The sum over all lengths t from number `k` on of the weights of `function`, less `limit`, times t**power; the unit
  !> of t is exp(log_of_unit). The power is below 0, or 0 where the weights tend to the limit.
  pure function sum_from(self, function, k, power, limit, log_of_unit) result(total)
    class(depth_mixture), intent(in) :: self
    integer, intent(in) :: function, k, power
    real(dp), intent(in) :: limit, log_of_unit
    real(dp) :: total
    real(dp) :: coefficient(BEYOND)
    integer :: decay(BEYOND), j, last, next

    last = self%first + self%count - 1
    total = 0.0_dp
    do j = k, last
      total = total + (self%weight_of(function, j) - limit)*exp(real(power, dp)*(STEP*real(j, dp) - log_of_unit))
    end do
    coefficient = self%beyond(:, function) - [limit, 0.0_dp, 0.0_dp]
    decay = [0, 1, 3] + [0, 1, 1]*mod(POWERS(function), 2) - power
    next = max(k, last + 1)
    do j = 1, BEYOND
      ! A geometric series of length number `next` and all longer ones.
      if (decay(j) > 0) total = total + coefficient(j)/(1.0_dp - exp(-STEP*real(decay(j), dp))) &
        *exp(STEP*real(power*last - decay(j)*(next - last), dp) - real(power, dp)*log_of_unit)
    end do
  end function sum_from

  !> What the limit of the weights of the lengths after number `last` adds to the displacement along z in plane strain,
  !> over a load of 1/(2 sqrt(pi)), so that far away it would be zero at the distance `reach`.
  pure function datum_beyond(self, last, reach) result(datum)
    class(depth_mixture), intent(in) :: self
    integer, intent(in) :: last
    real(dp), intent(in) :: reach
    real(dp) :: datum

    datum = -self%beyond(1, OF_DOWN)/STEP*(log(2.0_dp) + STEP*real(last, dp) - log(reach) + 0.5_dp*STEP - 0.5_dp*EULER)
  end function datum_beyond

  !> Fit `mixture` (m) to the body of `cut` (m) at each `depth` (m) >= 0, length, all of them in one layer; t and 1/q in
  !> the same unit. They share their lengths, and the matrix of the fit. Error: FUGE_ERR_MEMORY.
  subroutine fit_at_depths(cut, depth, mixture, info)
    type(layer_cut), intent(in) :: cut(:)
    real(dp), intent(in) :: depth(:)
    type(depth_mixture), intent(inout) :: mixture(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: values(:, :, :), weights(:, :, :), q(:)
    real(dp) :: last, shortest
    integer :: count, first, j, m, number, stat

    if (info%failed() .or. size(depth) < 1) return
    shortest = minval(depth)
    ! In the top layer the shortest way is that by the first interface.
    if (cut(1)%layer == 1) shortest = 2.0_dp*cut(1)%thickness_of_top - maxval(depth)
    last = LONG*max(maxval(depth), length_of_layers(cut(1)))
    first = floor(log(FIRST_LENGTH*shortest)/STEP)
    count = ceiling(log(last)/STEP) - first + 1
    number = size(depth)
    allocate (q(WAVES*count), values(WAVES*count, number, FUNCTIONS), weights(count + BEYOND, number, FUNCTIONS), &
              stat=stat)
    call require_memory(stat, 'stresses in layers, with', count, 'weights', info)
    if (stat /= 0) return
    call choose_waves(LONGEST_WAVE/last, SHORTEST_WAVE/shortest, q)
    weights(count + 1, :, :) = 0.0_dp
    do j = 1, number
      call find_values(cut(j), depth(j), q, values(:, j, :))
      weights(count + 1, j, OF_DOWN) = STEP*2.0_dp/sqrt(PI)*longest_wave_down(cut(j))
    end do
    do m = 0, 2
      associate (from => FIRST_OF(m), to => LAST_OF(m))
        call fit_powers(first, m, q, count + BEYOND, number*(to - from + 1), values(:, :, from:to), &
                        weights(:, :, from:to), stat)
      end associate
      call require_memory(stat, 'stresses in layers, with', count, 'weights', info)
      if (stat /= 0) return
    end do
    do j = 1, number
      call set_weights(mixture(j), first, weights(:, j, :), stat)
      call require_memory(stat, 'stresses in layers, with', count, 'weights', info)
      if (stat /= 0) return
    end do
  end subroutine fit_at_depths

  !> Waves from `longest` to `shortest`, 1/length, at equal ratios.
  pure subroutine choose_waves(longest, shortest, q)
    real(dp), intent(in) :: longest, shortest
    real(dp), intent(out) :: q(:)
    real(dp) :: ratio
    integer :: k

    ratio = (shortest/longest)**(1.0_dp/real(size(q) - 1, dp))
    do k = 1, size(q)
      q(k) = longest*ratio**(k - 1)
    end do
  end subroutine choose_waves

  !> `values` (waves, functions).
  pure subroutine find_values(cut, depth, q, values)
    type(layer_cut), intent(in) :: cut
    real(dp), intent(in) :: depth, q(:)
    real(dp), intent(out) :: values(:, :)
    integer :: k

    do k = 1, size(q)
      values(k, :) = functions_of(cut, depth, q(k))
    end do
  end subroutine find_values

  !> Take the `weights` (weights + BEYOND, functions).
  pure subroutine set_weights(mixture, first, weights, stat)
    type(depth_mixture), intent(inout) :: mixture
    integer, intent(in) :: first
    real(dp), intent(in) :: weights(:, :)
    integer, intent(out) :: stat
    integer :: count

    count = size(weights, 1) - BEYOND
    if (allocated(mixture%weight)) deallocate (mixture%weight)
    allocate (mixture%weight(count, FUNCTIONS), stat=stat)
    if (stat /= 0) return
    mixture%first = first
    mixture%count = count
    mixture%weight = weights(:count, :)
    mixture%beyond = weights(count + 1:, :)
  end subroutine set_weights

  !> The thickness of all layers times the ratio of their moduli.
  pure function length_of_layers(cut) result(length)
    type(layer_cut), intent(in) :: cut
    real(dp) :: length

    associate (shear => cut%stack%shear)
      length = sum(cut%stack%thickness)*maxval(shear, mask=ieee_is_finite(shear))/minval(shear)
    end associate
  end function length_of_layers

  !> U of the longest waves, in the top layer less that of a half-space.
  pure function longest_wave_down(cut) result(down)
    type(layer_cut), intent(in) :: cut
    real(dp) :: down

    associate (n => size(cut%stack%shear))
      down = 2.0_dp*(1.0_dp - cut%stack%poisson(n))/cut%stack%shear(n)
    end associate
    if (cut%layer == 1) down = down - 2.0_dp*(1.0_dp - cut%poisson)
  end function longest_wave_down

  !> The functions of a wave `q` at the `depth`, times q**m. In the top layer less those of a half-space.
  pure function functions_of(cut, depth, q) result(values)
    type(layer_cut), intent(in) :: cut
    real(dp), intent(in) :: depth, q
    real(dp) :: values(FUNCTIONS)
    real(dp) :: decay, response(6), x

    response = cut%response(q)
    if (cut%layer == 1) then
      x = q*depth
      decay = exp(-x)
      response(ZZ) = response(ZZ) + (1.0_dp + x)*decay
      response(NZ) = response(NZ) - x*decay
      response(NN) = response(NN) + (1.0_dp - x)*decay
      response(TT) = response(TT) + 2.0_dp*cut%poisson*decay
      response(ALONG) = response(ALONG) + (1.0_dp - 2.0_dp*cut%poisson - x)*decay
      response(DOWN) = response(DOWN) - (2.0_dp*(1.0_dp - cut%poisson) + x)*decay
    end if
    values = [response(ZZ), response(NN), response(TT), response(NZ), response(DOWN), response(NN) - response(TT), &
              -response(ALONG)]
  end function functions_of

  !> Weights of functions with the power `m`, by least squares, for `sets` of values. `values` (waves, sets) are used
  !> up. With m = 1 the limits of the weights are known: they are in `weights` (unknowns, sets) already. `stat` as in an
  !> allocate statement.
  subroutine fit_powers(first, m, q, unknowns, sets, values, weights, stat)
    integer, intent(in) :: first, m, unknowns, sets
    real(dp), intent(in) :: q(:)
    real(dp), intent(inout) :: values(size(q), sets), weights(unknowns, sets)
    integer, intent(out) :: stat
    real(dp), allocatable :: matrix(:, :), equal(:), work(:)
    real(dp) :: size_of_work(1)
    integer, allocatable :: pivot(:)
    integer :: count, fault, k, rank, rows

    rows = size(q)
    count = unknowns - BEYOND
    allocate (matrix(rows, unknowns), equal(rows), pivot(unknowns), stat=stat)
    if (stat /= 0) return
    pivot = 0
    do k = 1, count
      matrix(:, k) = term(m, q*exp(STEP*real(first + k - 1, dp)))
    end do
    do k = 1, rows
      call sum_longer(m, q(k), first + count - 1, equal(k), matrix(k, count + 1:))
    end do
    if (m == 1) then
      do k = 1, sets
        values(:, k) = values(:, k) - weights(count + 1, k)*equal
      end do
    end if
    ! Its only faults are those of arguments.
    call dgelsy(rows, unknowns, sets, matrix, rows, values, rows, pivot, RANK_TOLERANCE, rank, size_of_work, -1, fault)
    allocate (work(max(1, int(size_of_work(1)))), stat=stat)
    if (stat /= 0) return
    call dgelsy(rows, unknowns, sets, matrix, rows, values, rows, pivot, RANK_TOLERANCE, rank, work, size(work), fault)
    if (m /= 1) weights(count + 1, :) = values(count + 1, :)
    weights(:count, :) = values(:count, :)
    weights(count + 2:, :) = values(count + 2:unknowns, :)
  end subroutine fit_powers

  !> What the t longer than exp(STEP `last`) give in a wave `q` with weights of 1, in `equal`, and the coefficients of
  !> the three unknowns that stand for their weights.
  pure subroutine sum_longer(m, q, last, equal, coefficient)
    integer, intent(in) :: m, last
    real(dp), intent(in) :: q
    real(dp), intent(out) :: equal, coefficient(BEYOND)
    real(dp) :: ratio, x
    integer :: a, next

    a = 1 + mod(m, 2)
    equal = 0.0_dp
    coefficient = 0.0_dp
    next = 1
    do
      x = q*exp(STEP*real(last + next, dp))
      if (x > NEGLIGIBLE) exit
      ratio = exp(-STEP*real(next, dp))
      equal = equal + term(m, x)
      coefficient(2:) = coefficient(2:) + [ratio**a, ratio**(a + 2)]*term(m, x)
      next = next + 1
    end do
    ! Without a power of q there is no limit: the sum would be infinite.
    if (m == 2) coefficient(1) = equal
  end subroutine sum_longer

  !> x**m exp(-x**2).
  elemental function term(m, x)
    integer, intent(in) :: m
    real(dp), intent(in) :: x
    real(dp) :: term

    term = 0.0_dp
    if (x < NEGLIGIBLE) term = x**m*exp(-x**2)
  end function term

  !> `function` of a wave `q`, times q**m: in the top layer what a half-space of its material does not give.
  pure function value_at(self, function, q) result(value)
    class(depth_mixture), intent(in) :: self
    integer, intent(in) :: function
    real(dp), intent(in) :: q
    real(dp) :: value
    real(dp) :: x
    integer :: k

    value = 0.0_dp
    k = self%first
    x = q*exp(STEP*real(k, dp))
    do while (x < NEGLIGIBLE)
      value = value + self%weight_of(function, k)*term(POWERS(function), x)
      k = k + 1
      x = q*exp(STEP*real(k, dp))
    end do
  end function value_at

  !> xx = yy and zz at the cut under equal pressure everywhere, over the pressure: no stress along the surface in the
  !> half-space below, and the same strain along it in all layers. On a rigid base those of the longest waves in one
  !> direction: no strain along the surface, or no resultant force along it if the layers slide. In plane strain xx and
  !> zz.
  pure function uniform_stress(cut, plane_strain) result(stress)
    type(layer_cut), intent(in) :: cut
    logical, intent(in) :: plane_strain
    real(dp) :: stress(2)
    real(dp) :: response(6), strain
    integer :: n

    n = size(cut%stack%shear)
    if (cut%stack%is_rigid()) then
      response = cut%response(LONGEST/length_of_layers(cut))
      stress = [response(NN), -1.0_dp]
      return
    end if
    ! Twice the shear modulus of the top layer times the strain.
    strain = cut%stack%poisson(n)/cut%stack%shear(n)
    if (.not. plane_strain) strain = strain*(1.0_dp + cut%poisson)/(1.0_dp + cut%stack%poisson(n))
    stress = [(cut%shear*strain - cut%poisson)/(1.0_dp - cut%poisson), -1.0_dp]
  end function uniform_stress

  !> How far equal pressure everywhere moves the cut down, over the pressure over twice the shear modulus of the top
  !> layer: on a rigid base as far as the longest waves; otherwise displacements count from the mean.
  pure function mean_displacement(cut) result(displacement)
    type(layer_cut), intent(in) :: cut
    real(dp) :: displacement
    real(dp) :: response(6)

    displacement = 0.0_dp
    if (.not. cut%stack%is_rigid()) return
    response = cut%response(LONGEST/length_of_layers(cut))
    displacement = response(DOWN)*length_of_layers(cut)/LONGEST
  end function mean_displacement

end module fuge_depth_mixture
