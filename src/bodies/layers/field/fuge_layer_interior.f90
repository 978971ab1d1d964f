!> Waves inside a body of elastic layers: the stresses and displacements at a depth.
!>
!> A wave of the pressure p cos(q n) on the surface gives
!>
!>     zz = Z p cos(q n),   nz = -X p sin(q n),   nn = N p cos(q n),   u_z = U p/(2 G q) cos(q n),
!>     u_n = V p/(2 G q) sin(q n),
!>
!> G the shear modulus of the top layer, and across the wave tt = nu (nn + zz). Tractions go down from the surface
!> through the matrices of the layers above the depth, which have no number that grows, and displacements come up from
!> the compliance of what is below (fuge_layer_matrices).
module fuge_layer_interior
  use fuge_kinds, only: dp
  use fuge_layer_matrices, only: carried_down, joined, layer_matrices, slid_down
  use fuge_layer_stack, only: copy_stack, layer_number, layer_stack
  implicit none
  private

  public :: cut_at, find_cut, is_upper_half, layer_at

  !> Depths that differ by less are the same: the caller may have added the thicknesses up in another order, and no
  !> layer is as thin.
  real(dp), parameter :: ROUNDING = 1.0e-12_dp

  !> The numbers Z, X, N, tt/p, V and U of a wave.
  integer, parameter, public :: ZZ = 1, NZ = 2, NN = 3, TT = 4, ALONG = 5, DOWN = 6

  !> A body at a depth.
  type, public :: layer_cut
    !> The layers, of which one may end at the depth that it goes through, and how many are above it.
    type(layer_stack) :: stack
    integer :: above = 0
    !> The layer at the depth, of those of the body, and the thickness of its top layer.
    integer :: layer = 1
    real(dp) :: thickness_of_top = 0.0_dp
    !> Shear modulus over that of the top layer, and Poisson's ratio at the depth; is the lower side of an interface
    !> meant?
    real(dp) :: shear = 1.0_dp, poisson = 0.0_dp
    logical :: below = .false.
  contains
    procedure :: response
  end type layer_cut

contains

  !> The layer of `stack` at the `depth` >= 0, the substrate being the last one: at an interface, to rounding, the layer
  !> above it, or `below`.
  pure function layer_at(stack, depth, below) result(layer)
    type(layer_stack), intent(in) :: stack
    real(dp), intent(in) :: depth
    logical, intent(in) :: below
    integer :: layer
    real(dp) :: bottom

    bottom = 0.0_dp
    do layer = 1, size(stack%thickness)
      bottom = bottom + stack%thickness(layer)
      if (is_at(depth, bottom) .and. .not. below .or. depth < bottom .and. .not. is_at(depth, bottom)) return
    end do
  end function layer_at

  !> Does the `depth`, one of the `layer`, lie in its upper half? At an interface that tells the side.
  pure function is_upper_half(stack, layer, depth)
    type(layer_stack), intent(in) :: stack
    integer, intent(in) :: layer
    real(dp), intent(in) :: depth
    logical :: is_upper_half

    is_upper_half = .true.
    if (layer <= size(stack%thickness)) is_upper_half = depth < sum(stack%thickness(:layer - 1)) &
                                                        + 0.5_dp*stack%thickness(layer)
  end function is_upper_half

  !> As `find_cut`, for a stack of few layers.
  pure function cut_at(stack, depth, below) result(cut)
    type(layer_stack), intent(in) :: stack
    real(dp), intent(in) :: depth
    logical, intent(in) :: below
    type(layer_cut) :: cut
    integer :: stat

    call find_cut(stack, depth, below, cut, stat)
  end function cut_at

  !> The body `stack` at the `depth` >= 0: at an interface, to rounding, in the layer above it, or `below`. `stat` as in
  !> an allocate statement; other than 0, the cut is of no use.
  pure subroutine find_cut(stack, depth, below, cut, stat)
    type(layer_stack), intent(in) :: stack
    real(dp), intent(in) :: depth
    logical, intent(in) :: below
    type(layer_cut), intent(out) :: cut
    integer, intent(out) :: stat
    real(dp) :: bottom, top
    integer :: k, layers

    layers = size(stack%thickness)
    k = layer_at(stack, depth, below)
    top = sum(stack%thickness(:k - 1))
    bottom = sum(stack%thickness(:min(k, layers)))
    cut%layer = k
    if (layers > 0) cut%thickness_of_top = stack%thickness(1)
    cut%shear = stack%shear(k)
    cut%poisson = stack%poisson(k)
    cut%above = k
    if (is_at(depth, top)) then
      cut%above = k - 1
      cut%below = k > 1
      call copy_stack(stack, cut%stack, stat)
    else if (k <= layers .and. is_at(depth, bottom)) then
      call copy_stack(stack, cut%stack, stat)
    else
      call split_layer(stack, k, cut%stack, stat)
      if (stat /= 0) return
      cut%stack%thickness(k) = depth - top
      if (k <= layers) cut%stack%thickness(k + 1) = bottom - depth
    end if
  end subroutine find_cut

  !> `split`: the layers of `stack`, of which that of the `number`, or the half-space below, becomes two that are
  !> bonded. The thickness of the upper one is not defined if it is part of the half-space. `stat` as in an allocate
  !> statement.
  pure subroutine split_layer(stack, number, split, stat)
    type(layer_stack), intent(in) :: stack
    integer, intent(in) :: number
    type(layer_stack), intent(inout) :: split
    integer, intent(out) :: stat
    integer :: from, k, layers

    layers = size(stack%thickness)
    call split%make_room(layers + 1, stat)
    if (stat /= 0) return
    do k = 1, layers + 2
      from = k
      if (k > number) from = k - 1
      split%shear(k) = stack%shear(from)
      split%poisson(k) = stack%poisson(from)
      if (k > layers + 1 .or. from > layers) cycle
      split%thickness(k) = stack%thickness(from)
      split%bonded(k) = stack%bonded(from)
    end do
    split%bonded(number) = .true.
  end subroutine split_layer

  !> Is the `depth` that of an `interface`, which is a sum of thicknesses?
  pure function is_at(depth, interface)
    real(dp), intent(in) :: depth, interface
    logical :: is_at

    is_at = abs(depth - interface) <= ROUNDING*interface
  end function is_at

  !> Z, X, N, tt/p, V and U for a wave `q` > 0.
  pure function response(self, q)
    class(layer_cut), intent(in) :: self
    real(dp), intent(in) :: q
    real(dp) :: response(6)
    real(dp) :: displacement(2), traction(2)

    call find_state(self, q, displacement, traction)
    response(ZZ) = -traction(2)
    response(NZ) = traction(1)
    response(NN) = (self%poisson*response(ZZ) + self%shear*displacement(1))/(1.0_dp - self%poisson)
    response(TT) = self%poisson*(response(NN) + response(ZZ))
    response(ALONG) = displacement(1)
    response(DOWN) = displacement(2)
  end function response

  !> Displacement and traction at the cut under unit traction on the surface, in units of the top layer's shear modulus.
  pure subroutine find_state(cut, q, displacement, traction)
    type(layer_cut), intent(in) :: cut
    real(dp), intent(in) :: q
    real(dp), intent(out) :: displacement(2), traction(2)
    type(layer_matrices) :: bonded
    real(dp) :: compliance(3)
    integer :: first, k

    traction = [0.0_dp, 1.0_dp]
    k = 0
    do while (k < cut%above)
      ! Layers that are bonded to each other are one.
      first = k + 1
      k = first
      bonded = layer_number(cut%stack, k, q)
      do while (k < cut%above)
        if (.not. cut%stack%bonded(k)) exit
        k = k + 1
        bonded = joined(bonded, layer_number(cut%stack, k, q))
      end do
      compliance = cut%stack%compliance_below(k, q)
      if (cut%stack%bonded(k)) then
        call carried_down(bonded, compliance, displacement, traction)
      else
        call slid_down(bonded, compliance(3), displacement, traction)
      end if
    end do
    if (cut%above > 0 .and. .not. cut%below) return
    ! The displacement of a surface, or of the lower side of an interface.
    compliance = cut%stack%compliance_below(cut%above, q)
    displacement = [compliance(1)*traction(1) + compliance(2)*traction(2), &
                    compliance(2)*traction(1) + compliance(3)*traction(2)]
  end subroutine find_state

end module fuge_layer_interior
