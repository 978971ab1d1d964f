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

  public :: fit_at_depth, uniform_stress, yield_below

  !> Step of the rule in log t.
  real(dp), parameter, public :: STEP = 0.09_dp
  !> The numbers of Z, N, tt/p, X/q, U/q, (N - tt/p)/q**2 and -V/q**2, and the powers m of q for each.
  integer, parameter, public :: OF_ZZ = 1, OF_NN = 2, OF_TT = 3, OF_SLOPE = 4, OF_DOWN = 5, OF_DIFFERENCE = 6, &
    OF_ALONG = 7, FUNCTIONS = 7
  integer, parameter, public :: POWERS(FUNCTIONS) = [0, 0, 0, 1, 1, 2, 2]
  !> The first and the last of the functions with m = 0, 1, 2.
  integer, parameter :: FIRST_OF(0:2) = [1, 4, 6], LAST_OF(0:2) = [3, 5, 7]
  !> The first t is this fraction of the depth from which waves come; from that many times its inverse on, q counts not.
  real(dp), parameter :: FIRST = 1.0_dp/14.0_dp, SHORTEST_WAVE = 40.0_dp
  !> Waves are long from this many times the depth, or the thickness of all layers times the ratio of moduli, on. The
  !> longest one has this q times the longest t.
  real(dp), parameter :: LONG = 1.0e3_dp, LONGEST_WAVE = 0.03_dp
  !> q of a wave that is as good as infinitely long, times the length of the layers.
  real(dp), parameter :: LONGEST = 1.0e-7_dp
  !> Waves for each weight, and unknowns that stand for all longer t.
  integer, parameter :: WAVES = 3, BEYOND = 3
  !> Singular values below this fraction of the largest one are rounding.
  real(dp), parameter :: RANK_TOLERANCE = 1.0e-15_dp
  !> exp(-x**2) is less than rounding.
  real(dp), parameter :: NEGLIGIBLE = 6.3_dp

  type, public :: depth_mixture
    !> The weights are those of k = first, first + 1, .. (weights, functions).
    integer :: first = 0
    real(dp), allocatable :: weight(:, :)
    !> Those of longer t are beyond(1) + beyond(2)*r**a + beyond(3)*r**(a + 2), r = t_last/t, with a = 2 if m is 1,
    !> otherwise 1; (BEYOND, functions).
    real(dp) :: beyond(BEYOND, FUNCTIONS) = 0.0_dp
  contains
    procedure :: weight_of
    procedure :: value_at
  end type depth_mixture

contains

  !> The weight number `k` of `function`.
  elemental function weight_of(self, function, k) result(weight)
    class(depth_mixture), intent(in) :: self
    integer, intent(in) :: function, k
    real(dp) :: weight
    real(dp) :: ratio
    integer :: a, count

    count = size(self%weight, 1)
    weight = 0.0_dp
    if (k < self%first) return
    if (k < self%first + count) then
      weight = self%weight(k - self%first + 1, function)
    else
      ratio = exp(-STEP*real(k - self%first - count + 1, dp))
      a = 1 + mod(POWERS(function), 2)
      weight = self%beyond(1, function) + self%beyond(2, function)*ratio**a + self%beyond(3, function)*ratio**(a + 2)
    end if
  end function weight_of

  !> Fit `mixture` to the body of `cut` at the `depth` >= 0, length; t and 1/q in the same unit. Error: FUGE_ERR_MEMORY.
  subroutine fit_at_depth(cut, depth, mixture, info)
    type(layer_cut), intent(in) :: cut
    real(dp), intent(in) :: depth
    type(depth_mixture), intent(out) :: mixture
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: values(:, :), weights(:, :), q(:)
    real(dp) :: last, ratio, shortest
    integer :: count, k, m, rows, stat

    ! In the top layer the shortest way is that by the first interface.
    shortest = merge(2.0_dp*cut%thickness_of_top - depth, depth, cut%layer == 1)
    last = LONG*max(depth, length_of_layers(cut))
    mixture%first = floor(log(FIRST*shortest)/STEP)
    count = ceiling(log(last)/STEP) - mixture%first + 1
    rows = WAVES*count
    allocate (mixture%weight(count, FUNCTIONS), q(rows), values(FUNCTIONS, rows), &
              weights(count + BEYOND, FUNCTIONS), stat=stat)
    call require_memory(stat, 'stresses in layers, with', count, 'weights', info)
    if (stat /= 0) return
    q(1) = LONGEST_WAVE/last
    ratio = (SHORTEST_WAVE/shortest/q(1))**(1.0_dp/real(rows - 1, dp))
    do k = 2, size(q)
      q(k) = q(1)*ratio**(k - 1)
    end do
    do k = 1, size(q)
      values(:, k) = functions_of(cut, depth, q(k))
    end do
    weights(count + 1, :) = 0.0_dp
    weights(count + 1, OF_DOWN) = STEP*2.0_dp/sqrt(PI)*longest_wave_down(cut)
    do m = 0, 2
      if (stat == 0) call fit_powers(mixture%first, m, q, values(FIRST_OF(m):LAST_OF(m), :), &
                                     weights(:, FIRST_OF(m):LAST_OF(m)), stat)
    end do
    call require_memory(stat, 'stresses in layers, with', count, 'weights', info)
    if (stat /= 0) return
    mixture%weight = weights(:count, :)
    mixture%beyond = weights(count + 1:, :)
  end subroutine fit_at_depth

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

  !> Weights of the functions with the power `m`, by least squares. `values` (functions, waves). With m = 1 the limits
  !> of the weights are known: they are in `weights` already.
  subroutine fit_powers(first, m, q, values, weights, stat)
    integer, intent(in) :: first, m
    real(dp), intent(in) :: q(:), values(:, :)
    real(dp), intent(inout) :: weights(:, :)
    integer, intent(out) :: stat
    real(dp), allocatable :: matrix(:, :), right(:, :), work(:)
    real(dp) :: limit(size(weights, 2)), ratio, size_of_work(1), x
    integer, allocatable :: pivot(:)
    integer :: a, count, k, next, rank, rows

    count = size(weights, 1) - BEYOND
    rows = size(q)
    allocate (matrix(rows, count + BEYOND), right(rows, size(weights, 2)), pivot(count + BEYOND), stat=stat)
    if (stat /= 0) return
    pivot = 0
    matrix = 0.0_dp
    right = transpose(values)
    a = 1 + mod(m, 2)
    limit = weights(count + 1, :)
    do k = 1, count
      matrix(:, k) = term(m, q*exp(STEP*real(first + k - 1, dp)))
    end do
    do k = 1, rows
      next = 1
      do
        x = q(k)*exp(STEP*real(first + count + next - 1, dp))
        if (x > NEGLIGIBLE) exit
        ratio = exp(-STEP*real(next, dp))
        ! Without a power of q there is no limit: the sum would be infinite.
        if (m == 2) matrix(k, count + 1) = matrix(k, count + 1) + term(m, x)
        right(k, :) = right(k, :) - limit*term(m, x)
        matrix(k, count + 2) = matrix(k, count + 2) + ratio**a*term(m, x)
        matrix(k, count + 3) = matrix(k, count + 3) + ratio**(a + 2)*term(m, x)
        next = next + 1
      end do
    end do
    call dgelsy(rows, count + BEYOND, size(right, 2), matrix, rows, right, rows, pivot, RANK_TOLERANCE, rank, &
                size_of_work, -1, stat)
    if (stat == 0) allocate (work(max(1, int(size_of_work(1)))), stat=stat)
    if (stat /= 0) return
    call dgelsy(rows, count + BEYOND, size(right, 2), matrix, rows, right, rows, pivot, RANK_TOLERANCE, rank, work, &
                size(work), stat)
    weights = right(:count + BEYOND, :)
    if (m == 1) weights(count + 1, :) = limit
  end subroutine fit_powers

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
  !> half-space below, and the same strain along it in all layers. On a rigid base those of the longest waves, which do
  !> not strain layers along the surface, unless they slide and have no stress there. In plane strain xx and zz.
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
  pure function yield_below(cut) result(yield)
    type(layer_cut), intent(in) :: cut
    real(dp) :: yield
    real(dp) :: response(6)

    yield = 0.0_dp
    if (.not. cut%stack%is_rigid()) return
    response = cut%response(LONGEST/length_of_layers(cut))
    yield = response(DOWN)*length_of_layers(cut)/LONGEST
  end function yield_below

end module fuge_depth_mixture
