!> Graded bodies: layers in place of a modulus that varies over the depth.
module fuge_graded_layers_type
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
  use fuge_constants, only: LARGEST_EXPONENT_OF_4
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_layer_stack, only: bond_layers, layer_stack
  use fuge_layered_body_type, only: check_layers, LARGEST_RATIO
  use fuge_number_text, only: index_text, text
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_ITERATION_LIMIT, FUGE_ERR_MODULUS, &
    FUGE_ERR_NOT_FINITE, FUGE_ERR_OPTION, FUGE_ERR_OVERFLOW, FUGE_ERR_SIZE, FUGE_ERR_WIDTH
  implicit none
  private

  !> Relative error of the surface's displacement, and the number of layers, unless the caller says otherwise.
  real(dp), parameter :: DEFAULT_TOLERANCE = 1.0e-4_dp
  integer, parameter :: DEFAULT_MAX_LAYERS = 2000
  !> The range of the tolerance: below is rounding, above the estimate would be a guess.
  real(dp), parameter :: LEAST_TOLERANCE = 1.0e-10_dp, LARGEST_TOLERANCE = 0.1_dp
  !> Layers of the first division, before each is halved; the next one has at most this many times as many.
  integer, parameter :: FIRST_COUNT = 8, MOST_GROWTH = 8
  !> The next division aims at this fraction of the tolerance.
  real(dp), parameter :: AIM = 0.8_dp
  !> Halved layers have a quarter of the error: a third of the difference.
  real(dp), parameter :: ERROR_OF_DIFFERENCE = 1.0_dp/3.0_dp
  !> Waves are compared from this one, q times the depth and the ratio of moduli, to this one, q times the first
  !> thickness; the ratio of one to the next.
  real(dp), parameter :: LONGEST_WAVE = 0.03_dp, SHORTEST_WAVE = 30.0_dp, RATIO_OF_WAVES = 1.4_dp
  !> A change of Poisson's ratio counts as this relative change of the modulus.
  real(dp), parameter :: WEIGHT_OF_POISSON = 2.0_dp
  !> Steps of bisection for the depth of an interface.
  integer, parameter :: BISECTIONS = 60

  !> The layers of a graded body, for the `set` of fuge_layered_body, bonded.
  type, public :: fuge_graded_layers
    !> Thicknesses from the surface down, (layers), length.
    real(dp), allocatable :: thickness(:)
    !> Young's moduli, force per length squared, and Poisson's ratios, (layers + 1), the last ones below the layers.
    real(dp), allocatable :: young(:), poisson(:)
    !> Estimate of the largest relative error of the displacement of the surface by a wave of pressure, of any length.
    real(dp) :: error = 0.0_dp
  contains
    procedure :: divide
  end type fuge_graded_layers

  !> Values at depths, linear between them; equal depths are a jump.
  type :: depth_profile
    real(dp), allocatable :: depth(:), young(:), poisson(:)
    !> How much of the change belongs to each interval, (size(depth) - 1), sum 1; 0 where it is constant.
    real(dp), allocatable :: change(:)
  end type depth_profile

contains

  !> Divide a profile over the depth into layers.
  !>
  !> `depth` (n >= 1), length, from 0 at the surface down; two equal ones are a jump. `young`, force per length
  !> squared, and `poisson`, 0 .. 0.5, (n), at these depths and linear between them; below the last one lies a
  !> half-space of the last values. The last of `young` may be infinite, a rigid base, after a jump.
  !>
  !> Each layer has the values at its middle. Layers are thin near the surface and where the modulus changes fast, so
  !> that their error is of the second order for waves of any length; where nothing changes there is one layer. Their
  !> number grows until the error is at most `tolerance`, relative, 1e-10 .. 0.1, default 1e-4. The error is estimated
  !> by a third of the largest difference from half as many layers. `max_layers`: the most layers, default 2000.
  !>
  !> Errors, the layers untouched: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH for depths, FUGE_ERR_MODULUS,
  !> both also for ratios that the `set` refuses, FUGE_ERR_OPTION for the tolerance, FUGE_ERR_ITERATION_LIMIT if that
  !> takes more layers, FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY.
  subroutine divide(self, depth, young, poisson, info, tolerance, max_layers)
    class(fuge_graded_layers), intent(inout) :: self
    real(dp), intent(in) :: depth(:), young(:), poisson(:)
    type(fuge_info), intent(out) :: info
    real(dp), intent(in), optional :: tolerance
    integer, intent(in), optional :: max_layers
    type(depth_profile) :: profile
    type(fuge_graded_layers) :: found
    real(dp) :: wanted
    integer :: most

    wanted = DEFAULT_TOLERANCE
    if (present(tolerance)) wanted = tolerance
    most = DEFAULT_MAX_LAYERS
    ! There is one modulus more.
    if (present(max_layers)) most = min(max_layers, huge(most) - 1)
    call check_profile(depth, young, poisson, info)
    if (info%failed()) return
    if (ieee_is_nan(wanted)) then
      call report(info, FUGE_ERR_NOT_FINITE, 'tolerance is not a number')
    else if (wanted < LEAST_TOLERANCE .or. wanted > LARGEST_TOLERANCE) then
      call report(info, FUGE_ERR_OPTION, 'tolerance = '//text(wanted)//' is not in '//text(LEAST_TOLERANCE)//' .. ' &
                  //text(LARGEST_TOLERANCE))
    end if
    if (info%failed()) return
    call measure_changes(depth, young, poisson, profile, info)
    if (.not. info%failed()) call refine(profile, wanted, most, found, info)
    if (.not. info%failed()) call check_layers(found%thickness, found%young, found%poisson, info)
    if (info%failed()) return
    call move_alloc(found%thickness, self%thickness)
    call move_alloc(found%young, self%young)
    call move_alloc(found%poisson, self%poisson)
    self%error = found%error
  end subroutine divide

  !> Refuse what is no profile.
  subroutine check_profile(depth, young, poisson, info)
    real(dp), intent(in) :: depth(:), young(:), poisson(:)
    type(fuge_info), intent(inout) :: info
    integer :: k

    if (size(depth) < 1 .or. size(young) /= size(depth) .or. size(poisson) /= size(depth)) then
      call report(info, FUGE_ERR_SIZE, 'depth has '//text(size(depth))//', young '//text(size(young)) &
                  //' and poisson '//text(size(poisson))//' values: all need the same number, at least one')
      return
    end if
    call check_finite(depth, 'depth', info)
    if (.not. info%failed()) call check_finite(poisson, 'poisson', info)
    if (info%failed()) return
    if (abs(depth(1)) > 0.0_dp) call report(info, FUGE_ERR_WIDTH, 'depth('//index_text(1)//') = '//text(depth(1)) &
                                            //' is not 0, the surface')
    do k = 1, size(depth)
      if (info%failed()) return
      call check_point(k, depth, young, poisson, info)
    end do
    if (.not. info%failed()) call check_range(depth, young, info)
  end subroutine check_profile

  !> Refuse numbers so large or small that their ratios would overflow.
  subroutine check_range(depth, young, info)
    real(dp), intent(in) :: depth(:), young(:)
    type(fuge_info), intent(inout) :: info
    real(dp) :: step
    integer :: k

    do k = 1, size(depth)
      step = depth(k) - depth(max(k - 1, 1))
      if (step > 0.0_dp .and. abs(exponent(step)) > LARGEST_EXPONENT_OF_4) then
        call report(info, FUGE_ERR_OVERFLOW, 'depth('//index_text(k)//') = '//text(depth(k)) &
                    //' is out of range: choose another unit of length')
      else if (ieee_is_finite(young(k)) .and. abs(exponent(young(k))) > LARGEST_EXPONENT_OF_4) then
        call report(info, FUGE_ERR_OVERFLOW, 'young('//index_text(k)//') = '//text(young(k)) &
                    //' is out of range: choose other units')
      end if
      if (info%failed()) return
    end do
    if (maxval(young, mask=ieee_is_finite(young)) > LARGEST_RATIO*minval(young)) then
      call report(info, FUGE_ERR_MODULUS, 'young: the ratio of the stiffest to the softest value is at most ' &
                  //text(LARGEST_RATIO)//'; an infinite last one is a rigid base')
    end if
  end subroutine check_range

  !> Refuse point `k` of a profile.
  subroutine check_point(k, depth, young, poisson, info)
    integer, intent(in) :: k
    real(dp), intent(in) :: depth(:), young(:), poisson(:)
    type(fuge_info), intent(inout) :: info
    logical :: jump

    jump = .false.
    if (k > 1) then
      jump = .not. depth(k) > depth(k - 1)
      if (depth(k) < depth(k - 1)) then
        call report(info, FUGE_ERR_WIDTH, 'depth('//index_text(k)//') = '//text(depth(k))//' is less than the one ' &
                    //'before: depths go down from the surface')
      else if (jump .and. .not. depth(k) > depth(max(k - 2, 1))) then
        call report(info, FUGE_ERR_WIDTH, 'depth('//index_text(k)//') = '//text(depth(k))//' is there too often: ' &
                    //'two equal depths are a jump, below the surface')
      end if
    end if
    if (info%failed()) return
    if (ieee_is_nan(young(k))) then
      call report(info, FUGE_ERR_NOT_FINITE, 'young('//index_text(k)//') is not a number')
    else if (.not. young(k) > 0.0_dp) then
      call report(info, FUGE_ERR_MODULUS, 'young('//index_text(k)//') = '//text(young(k))//' is not positive')
    else if (.not. ieee_is_finite(young(k)) .and. .not. (jump .and. k == size(depth))) then
      call report(info, FUGE_ERR_MODULUS, 'young('//index_text(k)//') is infinite: only the last one may be, of a ' &
                  //'rigid base, at the same depth as the one before')
    else if (poisson(k) < 0.0_dp .or. poisson(k) > 0.5_dp) then
      call report(info, FUGE_ERR_MODULUS, 'poisson('//index_text(k)//') = '//text(poisson(k))//' is not in 0 .. 0.5')
    end if
  end subroutine check_point

  !> The profile, with the share of each interval in the change. FUGE_ERR_MEMORY.
  subroutine measure_changes(depth, young, poisson, profile, info)
    real(dp), intent(in) :: depth(:), young(:), poisson(:)
    type(depth_profile), intent(out) :: profile
    type(fuge_info), intent(inout) :: info
    integer :: k, n, stat

    n = size(depth)
    allocate (profile%depth(n), profile%young(n), profile%poisson(n), profile%change(n - 1), stat=stat)
    call require_memory(stat, 'a profile of', n, 'depths', info)
    if (stat /= 0) return
    profile%depth = depth
    profile%young = young
    profile%poisson = poisson
    profile%change = 0.0_dp
    do k = 1, n - 1
      if (depth(k + 1) > depth(k)) profile%change(k) = change_down_to(profile, k, depth(k + 1))
    end do
    if (any(profile%change > 0.0_dp)) profile%change = profile%change/sum(profile%change)
  end subroutine measure_changes

  !> The integral from the top of interval `k` to the depth `z` of the best number of layers per length.
  !>
  !> Where the modulus changes by the part g of itself per length, layers of the thickness h at the depth z make a
  !> relative error of g h**2/z for the waves that end there, and of (g h)**2. Both are the same everywhere if the
  !> number 1/h is as sqrt(g/z) + g, whose integral is known for linear moduli.
  pure function change_down_to(profile, k, z) result(change)
    type(depth_profile), intent(in) :: profile
    integer, intent(in) :: k
    real(dp), intent(in) :: z
    real(dp) :: change
    real(dp) :: modulus, slope, slope_of_poisson, top

    top = profile%depth(k)
    slope = (profile%young(k + 1) - profile%young(k))/(profile%depth(k + 1) - top)
    modulus = value_at(profile%young, profile%depth, k, z)
    change = abs(log(modulus/profile%young(k)))
    if (slope > 0.0_dp) then
      change = change + 2.0_dp*log((sqrt(slope*z) + sqrt(modulus))/(sqrt(slope*top) + sqrt(profile%young(k))))
    else
      change = change + 2.0_dp*(atan2(sqrt(-slope*z), sqrt(modulus)) - atan2(sqrt(-slope*top), sqrt(profile%young(k))))
    end if
    slope_of_poisson = WEIGHT_OF_POISSON*abs(profile%poisson(k + 1) - profile%poisson(k))/(profile%depth(k + 1) - top)
    change = change + 2.0_dp*sqrt(slope_of_poisson)*(sqrt(z) - sqrt(top)) + slope_of_poisson*(z - top)
  end function change_down_to

  !> The value at the depth `z` in interval `k`.
  pure function value_at(values, depth, k, z) result(found)
    real(dp), intent(in) :: values(:), depth(:), z
    integer, intent(in) :: k
    real(dp) :: found
    real(dp) :: part

    part = (z - depth(k))/(depth(k + 1) - depth(k))
    found = (1.0_dp - part)*values(k) + part*values(k + 1)
  end function value_at

  !> More and more layers, until their error is at most `tolerance`.
  subroutine refine(profile, tolerance, max_layers, layers, info)
    type(depth_profile), intent(in) :: profile
    real(dp), intent(in) :: tolerance
    integer, intent(in) :: max_layers
    type(fuge_graded_layers), intent(out) :: layers
    type(fuge_info), intent(inout) :: info
    type(fuge_graded_layers) :: half
    real(dp) :: difference, growth
    integer :: count, layers_needed

    count = FIRST_COUNT
    do
      if (number_of_layers(profile, count) > max_layers) count = largest_count(profile, max_layers)
      if (count < 1) then
        call report(info, FUGE_ERR_ITERATION_LIMIT, 'max_layers = '//text(max_layers)//' are too few: this profile ' &
                    //'has at least '//text(nint(min(real(huge(1), dp), number_of_layers(profile, 1)))))
        return
      end if
      call make_layers(profile, count, 1, half, info)
      if (.not. info%failed()) call make_layers(profile, count, 2, layers, info)
      if (info%failed()) return
      call find_largest_difference(half, layers, difference, info)
      if (info%failed()) return
      layers%error = ERROR_OF_DIFFERENCE*difference
      if (layers%error <= tolerance) return
      if (number_of_layers(profile, count + 1) > max_layers) exit
      growth = min(real(MOST_GROWTH, dp), sqrt(layers%error/(AIM*tolerance)))
      count = max(count + 1, ceiling(min(real(max_layers, dp), count*growth)))
    end do
    layers_needed = nint(min(1.0e9_dp, size(layers%thickness)*sqrt(layers%error/(AIM*tolerance))))
    call report(info, FUGE_ERR_ITERATION_LIMIT, 'max_layers = '//text(max_layers)//' are too few for tolerance = ' &
                //text(tolerance)//': '//text(size(layers%thickness))//' layers have the error '//text(layers%error) &
                //', about '//text(layers_needed)//' are needed')
  end subroutine refine

  !> Layers of the interval `k` if there are about `count` where the profile changes: none in a jump, one where it is
  !> constant.
  elemental function layers_in(profile, k, count) result(layers)
    type(depth_profile), intent(in) :: profile
    integer, intent(in) :: k, count
    integer :: layers

    layers = 0
    if (profile%depth(k + 1) > profile%depth(k)) layers = max(1, nint(count*profile%change(k)))
  end function layers_in

  !> All layers if there are about `count` where the profile changes, each of them in halves: they may be more than an
  !> integer holds.
  pure function number_of_layers(profile, count) result(layers)
    type(depth_profile), intent(in) :: profile
    integer, intent(in) :: count
    real(dp) :: layers
    integer :: k

    layers = 0.0_dp
    do k = 1, size(profile%change)
      layers = layers + merge(2.0_dp, 1.0_dp, profile%change(k) > 0.0_dp)*real(layers_in(profile, k, count), dp)
    end do
  end function number_of_layers

  !> The largest count that has no more than `max_layers`, in halves; 0 if there is none. By bisection: more have not
  !> fewer.
  pure function largest_count(profile, max_layers) result(count)
    type(depth_profile), intent(in) :: profile
    integer, intent(in) :: max_layers
    integer :: count
    integer :: middle, too_many

    count = 0
    too_many = max(max_layers, 0)/2 + 2
    do while (too_many - count > 1)
      middle = count + (too_many - count)/2
      if (number_of_layers(profile, middle) <= max_layers) then
        count = middle
      else
        too_many = middle
      end if
    end do
  end function largest_count

  !> Layers of about `count` times `parts` where the profile changes.
  subroutine make_layers(profile, count, parts, layers, info)
    type(depth_profile), intent(in) :: profile
    integer, intent(in) :: count, parts
    type(fuge_graded_layers), intent(out) :: layers
    type(fuge_info), intent(inout) :: info
    real(dp) :: above, below, middle
    integer :: here, i, k, last, stat, total

    total = 0
    do k = 1, size(profile%change)
      total = total + layers_in(profile, k, count)*merge(parts, 1, profile%change(k) > 0.0_dp)
    end do
    allocate (layers%thickness(total), layers%young(total + 1), layers%poisson(total + 1), stat=stat)
    call require_memory(stat, 'a graded body of', total, 'layers', info)
    if (info%failed()) return
    last = 0
    do k = 1, size(profile%change)
      here = layers_in(profile, k, count)*merge(parts, 1, profile%change(k) > 0.0_dp)
      below = profile%depth(k)
      do i = 1, here
        above = below
        below = interface_depth(profile, k, real(i, dp)/real(here, dp))
        middle = 0.5_dp*(above + below)
        last = last + 1
        layers%thickness(last) = below - above
        layers%young(last) = value_at(profile%young, profile%depth, k, middle)
        layers%poisson(last) = value_at(profile%poisson, profile%depth, k, middle)
      end do
    end do
    layers%young(total + 1) = profile%young(size(profile%young))
    layers%poisson(total + 1) = profile%poisson(size(profile%poisson))
  end subroutine make_layers

  !> The depth above which this `part` of the change of interval `k` lies.
  pure function interface_depth(profile, k, part) result(z)
    type(depth_profile), intent(in) :: profile
    integer, intent(in) :: k
    real(dp), intent(in) :: part
    real(dp) :: z
    real(dp) :: above, below, wanted
    integer :: step

    below = profile%depth(k + 1)
    z = below
    if (part >= 1.0_dp) return
    above = profile%depth(k)
    wanted = part*change_down_to(profile, k, below)
    do step = 1, BISECTIONS
      z = 0.5_dp*(above + below)
      if (change_down_to(profile, k, z) < wanted) then
        above = z
      else
        below = z
      end if
    end do
  end function interface_depth

  !> The largest relative `difference` of the displacements of the surface of two stacks by waves of pressure.
  !> FUGE_ERR_MEMORY.
  subroutine find_largest_difference(one, other, difference, info)
    type(fuge_graded_layers), intent(in) :: one, other
    real(dp), intent(out) :: difference
    type(fuge_info), intent(inout) :: info
    type(layer_stack) :: stack_of_one, stack_of_other
    real(dp) :: contrast, q, shortest
    integer :: stat

    difference = 0.0_dp
    if (size(one%thickness) == size(other%thickness)) return
    call bond_layers(one%thickness, one%young, one%poisson, stack_of_one, stat)
    if (stat == 0) call bond_layers(other%thickness, other%young, other%poisson, stack_of_other, stat)
    call require_memory(stat, 'a graded body of', size(other%thickness), 'layers', info)
    if (stat /= 0) return
    contrast = maxval(other%young, mask=ieee_is_finite(other%young))/minval(other%young)
    q = LONGEST_WAVE/(contrast*sum(other%thickness))
    shortest = SHORTEST_WAVE/other%thickness(1)
    do while (q < shortest*RATIO_OF_WAVES)
      difference = max(difference, abs(stack_of_one%wave_factor(q)*top_compliance(one) &
                                       /(stack_of_other%wave_factor(q)*top_compliance(other)) - 1.0_dp))
      q = q*RATIO_OF_WAVES
    end do
  end subroutine find_largest_difference

  !> (1 - nu**2)/E of the first layer.
  pure function top_compliance(layers) result(compliance)
    type(fuge_graded_layers), intent(in) :: layers
    real(dp) :: compliance

    compliance = (1.0_dp - layers%poisson(1)**2)/layers%young(1)
  end function top_compliance

end module fuge_graded_layers_type
