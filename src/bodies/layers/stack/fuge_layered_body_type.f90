!> Coated and layered bodies: what the operators of lines and areas have to know of them.
module fuge_layered_body_type
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
  use fuge_constants, only: LARGEST_EXPONENT_OF_4
  use fuge_kinds, only: dp
  use fuge_layer_stack, only: copy_stack, layer_stack
  use fuge_mixture_fit, only: fit_mixture, wave_symbol
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_CALL_ORDER, FUGE_ERR_MODULUS, &
    FUGE_ERR_NOT_FINITE, FUGE_ERR_OVERFLOW, FUGE_ERR_SIZE, FUGE_ERR_WIDTH
  use fuge_wave_mixture, only: wave_mixture
  implicit none
  private

  public :: check_layers, copy_layers

  !> The largest ratio of two thicknesses or moduli.
  real(dp), parameter, public :: LARGEST_RATIO = 1.0e8_dp
  !> The least share of a layer in the thickness of all: depths in it are told apart.
  real(dp), parameter :: LEAST_SHARE = 1.0e-11_dp
  !> Long waves are those of the substrate to rounding, or on a rigid base negligible, from this many times the length
  !> on at which the layers and the substrate displace the surface equally.
  real(dp), parameter :: LONG = 1.0e3_dp, LONG_ON_RIGID = 30.0_dp
  !> On a rigid base that length grows with this power of the ratio of moduli: a stiff film bends as a plate.
  real(dp), parameter :: POWER_ON_RIGID = 0.34_dp

  !> Two bodies in contact, of which one or both have layers.
  type, extends(wave_symbol), public :: fuge_layered_body
    private
    type(layer_stack) :: first, second
    !> Shares of the two bodies, and of a half-space without layers, in the displacement by short waves; sum 1.
    real(dp) :: share(2) = 0.0_dp
    !> 1/e_star = (1 - nu^2)/E of the two top layers, added up.
    real(dp) :: modulus = 0.0_dp
    type(wave_mixture) :: mixture
  contains
    procedure :: set
    procedure :: e_star
    procedure :: surface
    procedure :: wave_factor
    procedure :: factor_of_wave
    procedure :: find_compliances
    procedure :: layers
    procedure :: has_layers
    procedure :: interfaces
    procedure :: poisson => poisson_of_top
    procedure :: young => young_of_top
    procedure :: least_young
    procedure :: is_set
  end type fuge_layered_body

contains

  !> Describe a body of layers, and the other one.
  !>
  !> `thickness` (layers >= 0), length, from the surface down. `young` force per length squared, and `poisson`, from 0
  !> to 0.5, both (layers + 1): the last ones are those of the half-space below the layers; its modulus may be infinite,
  !> a rigid base. `bonded` (layers, default .true.): is the bottom of each layer bonded? Otherwise it slides without
  !> friction, and never comes off. `e_star_other`: E/(1 - nu**2) of the other body, a half-space; infinite, the
  !> default, if it is rigid. `other`: the other body if it has layers; it comes with no third one. If both are passed,
  !> `other` counts. Errors, which leave the description as it was: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH,
  !> FUGE_ERR_MODULUS, FUGE_ERR_OVERFLOW, FUGE_ERR_CALL_ORDER for `other` that is not set, FUGE_ERR_MEMORY.
  subroutine set(self, thickness, young, poisson, info, bonded, e_star_other, other)
    class(fuge_layered_body), intent(inout) :: self
    real(dp), intent(in) :: thickness(:), young(:), poisson(:)
    type(fuge_info), intent(out) :: info
    logical, intent(in), optional :: bonded(:)
    real(dp), intent(in), optional :: e_star_other
    class(fuge_layered_body), intent(in), optional :: other
    type(fuge_layered_body) :: new
    type(wave_mixture) :: mixture
    real(dp) :: compliance(2)
    integer :: stat

    if (present(bonded)) then
      if (size(bonded) /= size(thickness)) then
        call report(info, FUGE_ERR_SIZE, 'bonded has '//text(size(bonded))//' numbers for '//text(size(thickness)) &
                    //' layers')
        return
      end if
    end if
    call check_layers(thickness, young, poisson, info)
    if (info%failed()) return
    call join_layers(thickness, young, poisson, bonded, new%first, stat)
    call require_memory(stat, '', size(thickness), 'layers', info)
    if (stat /= 0) return
    compliance = [(1.0_dp - poisson(1)**2)/young(1), 0.0_dp]
    if (present(other)) then
      if (.not. other%is_set()) call report(info, FUGE_ERR_CALL_ORDER, 'other: no layers are set')
      if (info%failed()) return
      call copy_stack(other%first, new%second, stat)
      call require_memory(stat, 'the layers of the other body', info)
      if (stat /= 0) return
      compliance(2) = other%share(1)/other%modulus
    else if (present(e_star_other)) then
      if (ieee_is_nan(e_star_other) .or. .not. e_star_other > 0.0_dp) then
        call report(info, FUGE_ERR_MODULUS, 'e_star_other = '//text(e_star_other) &
                    //' is not positive: it is E/(1 - nu^2) of the other body, infinite if it is rigid')
      else if (is_out_of_range(e_star_other)) then
        call report(info, FUGE_ERR_OVERFLOW, 'e_star_other = '//text(e_star_other) &
                    //' is out of range: choose other units')
      end if
      if (info%failed()) return
      compliance(2) = 1.0_dp/e_star_other
    end if
    new%modulus = 1.0_dp/sum(compliance)
    new%share = compliance*new%modulus
    call fit(new, mixture, info)
    if (info%failed()) return
    call move_stack(new%first, self%first)
    call move_stack(new%second, self%second)
    self%share = new%share
    self%modulus = new%modulus
    ! Without a copy of the weights, for which there may be no memory.
    self%mixture%unit = mixture%unit
    self%mixture%limit = mixture%limit
    self%mixture%tail = mixture%tail
    call move_alloc(mixture%weight, self%mixture%weight)
  end subroutine set

  !> Is it so large or small that products would overflow? Not if it is infinite.
  pure function is_out_of_range(value)
    real(dp), intent(in) :: value
    logical :: is_out_of_range

    is_out_of_range = .false.
    if (ieee_is_finite(value)) is_out_of_range = abs(exponent(value)) > LARGEST_EXPONENT_OF_4
  end function is_out_of_range

  !> Refuse what makes no layers.
  subroutine check_layers(thickness, young, poisson, info)
    real(dp), intent(in) :: thickness(:), young(:), poisson(:)
    type(fuge_info), intent(inout) :: info
    integer :: k

    if (size(young) /= size(thickness) + 1 .or. size(poisson) /= size(young)) then
      call report(info, FUGE_ERR_SIZE, 'young has '//text(size(young))//' and poisson '//text(size(poisson)) &
                  //' numbers for '//text(size(thickness))//' layers: both need one more, for the half-space below')
      return
    end if
    do k = 1, size(young)
      if (k <= size(thickness)) then
        if (.not. ieee_is_finite(thickness(k))) then
          call report(info, FUGE_ERR_NOT_FINITE, 'thickness '//text(k)//' = '//text(thickness(k)) &
                      //' is not a finite number')
        else if (.not. thickness(k) > 0.0_dp) then
          call report(info, FUGE_ERR_WIDTH, 'thickness '//text(k)//' = '//text(thickness(k))//' is not positive')
        else if (is_out_of_range(thickness(k))) then
          call report(info, FUGE_ERR_OVERFLOW, 'thickness '//text(k)//' = '//text(thickness(k)) &
                      //' is out of range: choose another unit of length')
        end if
      end if
      if (.not. info%failed()) call check_material(k, k == size(young) .and. k > 1, young(k), poisson(k), info)
      if (info%failed()) return
    end do
    if (size(thickness) < 1) return
    if (maxval(thickness) > LARGEST_RATIO*minval(thickness)) then
      call report(info, FUGE_ERR_WIDTH, 'thickness: the ratio of the thickest to the thinnest layer is at most ' &
                  //text(LARGEST_RATIO))
    else if (minval(thickness) < LEAST_SHARE*sum(thickness)) then
      call report(info, FUGE_ERR_WIDTH, 'thickness: the thinnest layer has at least '//text(LEAST_SHARE) &
                  //' of the thickness of all')
    else if (maxval(young, mask=ieee_is_finite(young)) > LARGEST_RATIO*minval(young)) then
      call report(info, FUGE_ERR_MODULUS, 'young: the ratio of the stiffest to the softest layer is at most ' &
                  //text(LARGEST_RATIO)//'; an infinite last one is a rigid base')
    end if
  end subroutine check_layers

  !> Refuse moduli of material `k`, which may be `rigid`.
  subroutine check_material(k, rigid, young, poisson, info)
    integer, intent(in) :: k
    logical, intent(in) :: rigid
    real(dp), intent(in) :: young, poisson
    type(fuge_info), intent(inout) :: info

    if (ieee_is_nan(young) .or. ieee_is_nan(poisson)) then
      call report(info, FUGE_ERR_NOT_FINITE, 'young or poisson '//text(k)//' is not a number')
    else if (.not. young > 0.0_dp .or. .not. (rigid .or. ieee_is_finite(young))) then
      call report(info, FUGE_ERR_MODULUS, 'young '//text(k)//' = '//text(young)//' is not a positive number' &
                  //': the last one only, of a rigid base, may be infinite')
    else if (is_out_of_range(young)) then
      call report(info, FUGE_ERR_OVERFLOW, 'young '//text(k)//' = '//text(young) &
                  //' is out of range: choose other units')
    else if (poisson < 0.0_dp .or. poisson > 0.5_dp) then
      call report(info, FUGE_ERR_MODULUS, 'poisson '//text(k)//' = '//text(poisson)//' is not in 0 .. 0.5')
    end if
  end subroutine check_material

  !> The stack of these layers, all bonded unless `bonded` says otherwise. What is bonded to a layer of the same
  !> material is one with it. `stat` as in an allocate statement.
  subroutine join_layers(thickness, young, poisson, bonded, stack, stat)
    real(dp), intent(in) :: thickness(:), young(:), poisson(:)
    logical, intent(in), optional :: bonded(:)
    type(layer_stack), intent(out) :: stack
    integer, intent(out) :: stat
    integer :: count, k, layers

    layers = size(thickness)
    count = 0
    do k = 1, layers
      if (.not. is_one_with_next(k)) count = count + 1
    end do
    call stack%make_room(count, stat)
    if (stat /= 0) return
    count = 1
    call begin_layer(1)
    do k = 1, layers
      if (count <= size(stack%thickness)) then
        stack%thickness(count) = stack%thickness(count) + thickness(k)
        stack%bonded(count) = is_bonded(k)
      end if
      if (is_one_with_next(k)) cycle
      count = count + 1
      call begin_layer(k + 1)
    end do

  contains

    !> Number `count` of the stack begins with the material `k`.
    subroutine begin_layer(k)
      integer, intent(in) :: k

      if (count <= size(stack%thickness)) stack%thickness(count) = 0.0_dp
      stack%poisson(count) = poisson(k)
      stack%shear(count) = young(k)/young(1)*(1.0_dp + poisson(1))/(1.0_dp + poisson(k))
    end subroutine begin_layer

    pure function is_bonded(k)
      integer, intent(in) :: k
      logical :: is_bonded

      is_bonded = .true.
      if (present(bonded)) is_bonded = bonded(k)
    end function is_bonded

    !> Is layer `k` one with what is below it?
    pure function is_one_with_next(k)
      integer, intent(in) :: k
      logical :: is_one_with_next

      is_one_with_next = is_bonded(k) .and. is_same(k, k + 1)
    end function is_one_with_next

    !> Are two materials the same?
    pure function is_same(i, j)
      integer, intent(in) :: i, j
      logical :: is_same

      is_same = .not. (abs(young(i) - young(j)) > 0.0_dp .or. abs(poisson(i) - poisson(j)) > 0.0_dp)
    end function is_same

  end subroutine join_layers

  !> Without a copy, for which there may be no memory.
  pure subroutine move_stack(from, to)
    type(layer_stack), intent(inout) :: from, to

    call move_alloc(from%thickness, to%thickness)
    call move_alloc(from%bonded, to%bonded)
    call move_alloc(from%poisson, to%poisson)
    call move_alloc(from%shear, to%shear)
  end subroutine move_stack

  !> Fit the mixture to both bodies; no mixture if neither has layers. Error: FUGE_ERR_MEMORY.
  subroutine fit(layers, mixture, info)
    type(fuge_layered_body), intent(in) :: layers
    type(wave_mixture), intent(inout) :: mixture
    type(fuge_info), intent(inout) :: info
    real(dp) :: limit, longest, shortest

    shortest = huge(shortest)
    longest = 0.0_dp
    limit = 0.0_dp
    call include_stack(layers%first, layers%share(1))
    call include_stack(layers%second, layers%share(2))
    if (longest > 0.0_dp) call fit_mixture(layers, shortest, longest, limit, mixture, info)

  contains

    subroutine include_stack(stack, share)
      type(layer_stack), intent(in) :: stack
      real(dp), intent(in) :: share

      limit = limit + share*stack%factor_of_longest()
      if (.not. stack%has_layers()) return
      shortest = min(shortest, stack%thickness(1))
      longest = max(longest, long_length(stack))
    end subroutine include_stack

  end subroutine fit

  !> The length from which on waves are long.
  pure function long_length(stack) result(length)
    type(layer_stack), intent(in) :: stack
    real(dp) :: length
    real(dp) :: contrast

    contrast = maxval(stack%shear, mask=ieee_is_finite(stack%shear))/minval(stack%shear)
    if (stack%is_rigid()) then
      length = LONG_ON_RIGID*contrast**POWER_ON_RIGID
    else
      length = LONG*contrast
    end if
    length = length*sum(stack%thickness)
  end function long_length

  !> Has it been set?
  elemental function is_set(self)
    class(fuge_layered_body), intent(in) :: self
    logical :: is_set

    is_set = self%modulus > 0.0_dp
  end function is_set

  !> Of the surface, for the e_star of operators, force per length squared: 1/e_star is the sum of (1 - nu**2)/E of the
  !> two top layers. 0 before `set`.
  elemental function e_star(self)
    class(fuge_layered_body), intent(in) :: self
    real(dp) :: e_star

    e_star = self%modulus
  end function e_star

  !> What makes the surface another one than that of a half-space, for the `body` of operators.
  function surface(self)
    class(fuge_layered_body), intent(in) :: self
    type(wave_mixture) :: surface

    surface = self%mixture
  end function surface

  !> The layers of the body that was described, without the other one.
  function layers(self) result(stack)
    class(fuge_layered_body), intent(in) :: self
    type(layer_stack) :: stack

    stack = self%first
  end function layers

  !> As `layers`, checked. FUGE_ERR_MEMORY.
  subroutine copy_layers(body, stack, info)
    type(fuge_layered_body), intent(in) :: body
    type(layer_stack), intent(out) :: stack
    type(fuge_info), intent(inout) :: info
    integer :: stat

    call copy_stack(body%first, stack, stat)
    call require_memory(stat, 'a body of', body%interfaces(), 'layers', info)
  end subroutine copy_layers

  !> Is it more than a half-space?
  elemental function has_layers(self)
    class(fuge_layered_body), intent(in) :: self
    logical :: has_layers

    has_layers = self%first%has_layers()
  end function has_layers

  !> The number of interfaces of the body that was described: layers that are bonded to the same material are one with
  !> it.
  elemental function interfaces(self) result(count)
    class(fuge_layered_body), intent(in) :: self
    integer :: count

    count = 0
    if (self%has_layers()) count = size(self%first%thickness)
  end function interfaces

  !> Poisson's ratio of the top layer, of a body that is set.
  pure function poisson_of_top(self) result(poisson)
    class(fuge_layered_body), intent(in) :: self
    real(dp) :: poisson

    poisson = self%first%poisson(1)
  end function poisson_of_top

  !> Young's modulus of the top layer, of a body that is set.
  pure function young_of_top(self) result(young)
    class(fuge_layered_body), intent(in) :: self
    real(dp) :: young

    young = self%modulus/self%share(1)*(1.0_dp - self%poisson()**2)
  end function young_of_top

  !> The least Young's modulus of the layers and of what is below them, of a body that is set.
  pure function least_young(self) result(young)
    class(fuge_layered_body), intent(in) :: self
    real(dp) :: young

    young = self%young()
    if (self%has_layers()) young = young*minval(self%first%shear*(1.0_dp + self%first%poisson)) &
                                   /(1.0_dp + self%poisson())
  end function least_young

  !> T of a wave `q` > 0, 1/length: pressure displaces the surface by 2 T/(e_star q) times itself.
  elemental function factor_of_wave(self, q) result(factor)
    class(fuge_layered_body), intent(in) :: self
    real(dp), intent(in) :: q
    real(dp) :: factor

    factor = self%share(1)*self%first%wave_factor(q)
    if (self%share(2) > 0.0_dp) factor = factor + self%share(2)*self%second%wave_factor(q)
  end function factor_of_wave

  !> `compliance`: 2 T/(e_star q), displacement per pressure, length over force per length squared, of the waves `q` >
  !> 0, 1/length. Errors, `compliance` untouched: FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE,
  !> FUGE_ERR_WIDTH for one that is not positive.
  subroutine find_compliances(self, q, compliance, info)
    class(fuge_layered_body), intent(in) :: self
    real(dp), intent(in) :: q(:)
    real(dp), intent(inout) :: compliance(:)
    type(fuge_info), intent(out) :: info
    integer :: k

    if (.not. self%is_set()) then
      call report(info, FUGE_ERR_CALL_ORDER, 'no layers are set')
    else if (size(q) /= size(compliance)) then
      call report(info, FUGE_ERR_SIZE, 'q has '//text(size(q))//' numbers and compliance '//text(size(compliance)))
    end if
    do k = 1, size(q)
      if (info%failed()) return
      if (.not. ieee_is_finite(q(k))) then
        call report(info, FUGE_ERR_NOT_FINITE, 'q '//text(k)//' = '//text(q(k))//' is not a finite number')
      else if (.not. q(k) > 0.0_dp) then
        call report(info, FUGE_ERR_WIDTH, 'q '//text(k)//' = '//text(q(k))//' is not positive')
      end if
    end do
    if (info%failed()) return
    do k = 1, size(q)
      compliance(k) = 2.0_dp*self%factor_of_wave(q(k))/(self%modulus*q(k))
    end do
  end subroutine find_compliances

  !> `factor_of_wave` of one wave.
  pure function wave_factor(self, q) result(factor)
    class(fuge_layered_body), intent(in) :: self
    real(dp), intent(in) :: q
    real(dp) :: factor

    factor = self%factor_of_wave(q)
  end function wave_factor

end module fuge_layered_body_type
