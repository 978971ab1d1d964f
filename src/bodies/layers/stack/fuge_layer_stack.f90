!> The waves of a body of elastic layers: its compliance relative to that of a half-space of its top layer.
module fuge_layer_stack
  use fuge_kinds, only: dp
  use fuge_layer_matrices, only: half_space_compliance, joined, layer_matrices, layer_of, rest_on, slide_on
  use fuge_mixture_fit, only: wave_symbol
  implicit none
  private

  public :: bond_layers, copy_stack, layer_number

  !> Layers on a half-space or a rigid base, from the surface down.
  type, extends(wave_symbol), public :: layer_stack
    !> Thicknesses, (layers), length.
    real(dp), allocatable :: thickness(:)
    !> Shear moduli over that of the top layer, the last one of the substrate, infinite if it is rigid; Poisson's
    !> ratios; (layers + 1).
    real(dp), allocatable :: shear(:), poisson(:)
    !> Is the bottom of each layer bonded? Otherwise it slides without friction. (layers)
    logical, allocatable :: bonded(:)
  contains
    procedure :: make_room
    procedure :: wave_factor
    procedure :: compliance_below
    procedure :: factor_of_longest
    procedure :: has_layers
    procedure :: is_rigid
  end type layer_stack

contains

  !> Room for a number of layers, in a stack that has none yet. `stat` as in an allocate statement.
  pure subroutine make_room(self, layers, stat)
    class(layer_stack), intent(inout) :: self
    integer, intent(in) :: layers
    integer, intent(out) :: stat

    allocate (self%thickness(layers), self%bonded(layers), self%poisson(layers + 1), self%shear(layers + 1), stat=stat)
  end subroutine make_room

  !> The stack of bonded layers: `thickness` (layers), Young's moduli and Poisson's ratios (layers + 1), as checked by
  !> the caller. `stat` as in an allocate statement.
  pure subroutine bond_layers(thickness, young, poisson, stack, stat)
    real(dp), intent(in) :: thickness(:), young(:), poisson(:)
    type(layer_stack), intent(out) :: stack
    integer, intent(out) :: stat

    call stack%make_room(size(thickness), stat)
    if (stat /= 0) return
    stack%thickness = thickness
    stack%bonded = .true.
    stack%poisson = poisson
    stack%shear = young/young(1)*(1.0_dp + poisson(1))/(1.0_dp + poisson)
  end subroutine bond_layers

  !> `copy`: the layers of `stack`, which may not be set. `stat` as in an allocate statement.
  pure subroutine copy_stack(stack, copy, stat)
    type(layer_stack), intent(in) :: stack
    type(layer_stack), intent(inout) :: copy
    integer, intent(out) :: stat

    stat = 0
    if (.not. allocated(stack%thickness)) return
    call copy%make_room(size(stack%thickness), stat)
    if (stat /= 0) return
    copy%thickness = stack%thickness
    copy%bonded = stack%bonded
    copy%poisson = stack%poisson
    copy%shear = stack%shear
  end subroutine copy_stack

  !> Is it more than a half-space?
  elemental function has_layers(self) result(has)
    class(layer_stack), intent(in) :: self
    logical :: has

    has = .false.
    if (allocated(self%thickness)) has = size(self%thickness) > 0
  end function has_layers

  !> Is the base rigid?
  pure function is_rigid(self) result(rigid)
    class(layer_stack), intent(in) :: self
    logical :: rigid

    rigid = self%shear(size(self%shear)) > huge(1.0_dp)
  end function is_rigid

  !> T of waves far longer than all layers: the ratio of the plane-strain moduli of top layer and substrate, 0 on a
  !> rigid base.
  pure function factor_of_longest(self) result(factor)
    class(layer_stack), intent(in) :: self
    real(dp) :: factor

    factor = 1.0_dp
    if (.not. self%has_layers()) return
    associate (n => size(self%shear))
      factor = (1.0_dp - self%poisson(n))/self%shear(n)/(1.0_dp - self%poisson(1))
    end associate
  end function factor_of_longest

  !> T: a wave `q` > 0 of pressure, 1/length, displaces the surface by 2 T/(E q) times itself, E the plane-strain
  !> modulus of the top layer. Near 1 for short waves; for long ones the ratio of the moduli of top layer and substrate.
  pure function wave_factor(self, q) result(factor)
    class(layer_stack), intent(in) :: self
    real(dp), intent(in) :: q
    real(dp) :: factor
    real(dp) :: compliance(3)

    factor = 1.0_dp
    if (.not. self%has_layers()) return
    compliance = self%compliance_below(0, q)
    factor = compliance(3)/(2.0_dp*(1.0_dp - self%poisson(1)))
  end function wave_factor

  !> The compliance of what is below the first `above` layers to waves `q`, [xx, xz, zz], for tractions over
  !> 2 q times the shear modulus of the top layer.
  pure function compliance_below(self, above, q) result(compliance)
    class(layer_stack), intent(in) :: self
    integer, intent(in) :: above
    real(dp), intent(in) :: q
    real(dp) :: compliance(3)
    type(layer_matrices) :: bonded
    integer :: k, layers

    layers = size(self%thickness)
    compliance = 0.0_dp
    if (.not. self%is_rigid()) compliance = half_space_compliance(self%poisson(layers + 1))/self%shear(layers + 1)
    ! Layers that are bonded to each other are one before they lie on what they may slide on.
    k = layers
    do while (k > above)
      layers = k
      bonded = layer_number(self, k, q)
      do while (k > above + 1)
        if (.not. self%bonded(k - 1)) exit
        k = k - 1
        bonded = joined(layer_number(self, k, q), bonded)
      end do
      if (self%bonded(layers)) then
        compliance = rest_on(bonded, compliance)
      else
        compliance = slide_on(bonded, compliance(3))
      end if
      k = k - 1
    end do
  end function compliance_below

  !> Layer `k` for waves `q`, of the shear modulus of the top layer.
  pure function layer_number(stack, k, q) result(layer)
    class(layer_stack), intent(in) :: stack
    integer, intent(in) :: k
    real(dp), intent(in) :: q
    type(layer_matrices) :: layer

    layer = layer_of(q*stack%thickness(k), stack%poisson(k))
    layer%compliance = layer%compliance/stack%shear(k)
    layer%stiffness = layer%stiffness*stack%shear(k)
  end function layer_number

end module fuge_layer_stack
