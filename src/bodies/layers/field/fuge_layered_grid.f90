!> A grid of cells that press on a body of layers: its stresses as tensors, in plane strain below a line of cells.
module fuge_layered_grid
  use fuge_elastic_moduli, only: FUGE_PLANE_STRAIN
  use fuge_kinds, only: dp
  use fuge_layer_interior, only: layer_at
  use fuge_layer_stack, only: layer_stack
  use fuge_layered_body_type, only: copy_layers, fuge_layered_body
  use fuge_layered_halfplane_depths, only: fuge_layered_halfplane_stress_grid
  use fuge_layered_halfspace_depths, only: fuge_layered_halfspace_stress_grid
  use fuge_status, only: fuge_info, require_memory
  use fuge_stress_measures, only: fuge_halfplane_tensor
  implicit none
  private

  type, public :: layered_grid
    !> The layers of the body.
    type(layer_stack) :: stack
    !> A line of cells along x, or an area?
    logical :: is_line = .false.
    integer :: cells(2) = 1, boundary = 0, element = 0
    real(dp) :: spacing(2) = 0.0_dp
    !> (cells(1)*cells(2)).
    real(dp), allocatable :: force(:)
  contains
    procedure :: press
    procedure :: tensors
  end type layered_grid

contains

  !> Let the forces act on a body that is set. FUGE_ERR_MEMORY.
  subroutine press(self, body, force, info)
    class(layered_grid), intent(inout) :: self
    type(fuge_layered_body), intent(in) :: body
    real(dp), intent(in) :: force(:)
    type(fuge_info), intent(inout) :: info
    integer :: stat

    if (info%failed()) return
    if (allocated(self%force)) deallocate (self%force)
    allocate (self%force(size(force)), stat=stat)
    call require_memory(stat, 'the forces of', size(force), 'cells', info)
    if (stat /= 0) return
    self%force = force
    call copy_layers(body, self%stack, info)
  end subroutine press

  !> `tensor` (6, cells, m), in the `body` of the forces: xx, yy, zz, yz, xz, xy below the centres of cells at each
  !> `depth` (m), at an interface above it or `below` (m). Errors, `tensor` untouched: those of
  !> `fuge_layered_halfspace_stress_grid` and `fuge_layered_halfplane_stress_grid`.
  subroutine tensors(self, body, depth, below, tensor, info)
    class(layered_grid), intent(in) :: self
    type(fuge_layered_body), intent(in) :: body
    real(dp), intent(in) :: depth(:)
    logical, intent(in) :: below(:)
    real(dp), intent(inout) :: tensor(:, :, :)
    type(fuge_info), intent(out) :: info
    real(dp), allocatable :: stress(:, :, :)
    integer :: k, stat

    if (.not. self%is_line) then
      call fuge_layered_halfspace_stress_grid(body, self%cells(1), self%cells(2), self%spacing(1), &
                                              self%spacing(2), self%force, self%boundary, depth, tensor, info, below)
      return
    end if
    allocate (stress(3, size(self%force), size(depth)), stat=stat)
    call require_memory(stat, 'stresses at', size(self%force), 'cells', info)
    if (stat /= 0) return
    call fuge_layered_halfplane_stress_grid(body, self%spacing(1), self%force, self%element, self%boundary, &
                                            depth, stress, info, below)
    if (info%failed()) return
    do k = 1, size(depth)
      call fuge_halfplane_tensor(stress(:, :, k), FUGE_PLANE_STRAIN, &
                                 self%stack%poisson(layer_at(self%stack, depth(k), below(k))), tensor(:, :, k), info)
    end do
  end subroutine tensors

end module fuge_layered_grid
