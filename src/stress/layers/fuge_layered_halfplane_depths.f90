!> Stresses in a body of layers, in plane strain, at depths below the centres of a grid of cells, by FFT; as
!> fuge_layered_halfspace_depths.
module fuge_layered_halfplane_depths
  use fuge_depth_mixture, only: depth_mixture, fit_at_depth, uniform_stress, OF_NN, OF_SLOPE, OF_ZZ
  use fuge_grid_waves, only: grid_waves
  use fuge_halfplane_depths, only: fuge_halfplane_stress_grid
  use fuge_halfplane_fft, only: FUGE_PERIODIC
  use fuge_halfplane_grid_checks, only: check_halfplane_grid
  use fuge_halfplane_influence, only: FUGE_HAT
  use fuge_kinds, only: dp
  use fuge_layer_checks, only: cut_body
  use fuge_layer_interior, only: layer_cut
  use fuge_layered_body_type, only: fuge_layered_body
  use fuge_mixture_sums, only: mixture_sums, PLACES_OF, WAVES_OF
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_ELEMENT
  implicit none
  private

  public :: fuge_layered_halfplane_stress_grid

  !> Functions of the components xx, zz, xz; the last one is odd.
  integer, parameter :: FUNCTION_OF(3) = [OF_NN, OF_ZZ, OF_SLOPE]
  logical, parameter :: IS_ODD(3) = [.false., .false., .true.]

  !> Data of all depths.
  type :: grid_work
    logical :: periodic = .false.
    type(grid_waves) :: waves
    type(mixture_sums) :: sums
    type(layer_cut), allocatable :: cut(:)
    type(depth_mixture), allocatable :: mixture(:)
    !> Factors of waves; what a half-plane gives, (3, n, 1).
    real(dp), allocatable :: factor(:, :), plain(:, :, :)
  end type grid_work

contains

  !> Stresses in a body of layers in plane strain, below the centres of equal cells side by side, in O(n log n)
  !> operations for each depth.
  !>
  !> `body` is set; they are those in the body that it was set with, not in the other one. `spacing`, `force`,
  !> `boundary`, `depth` and `stress` as for `fuge_halfplane_stress_grid`; `element` FUGE_CENTRE or FUGE_MEAN: strips of
  !> pressure. A depth at an interface is above it, or below where `below` (m, default .false.) says so: xx differs.
  !> Errors are about 1e-11 of the largest stress at that depth. With FUGE_PERIODIC the mean pressure gives the
  !> half-space below the layers no stress along x, and the layers the same strain along x as it has, on a rigid base
  !> none.
  !>
  !> Nine arguments: those of the cells and of the body. Errors, stress untouched: as for `fuge_halfplane_stress_grid`,
  !> FUGE_ERR_ELEMENT also for FUGE_HAT, FUGE_ERR_CALL_ORDER for a body that is not set, FUGE_ERR_GRID for a depth in a
  !> rigid base. Source: doc/theory_layers.md.
  subroutine fuge_layered_halfplane_stress_grid(body, spacing, force, element, boundary, depth, stress, info, below)
    type(fuge_layered_body), intent(in) :: body
    real(dp), intent(in) :: spacing, force(:), depth(:)
    integer, intent(in) :: element, boundary
    real(dp), intent(inout) :: stress(:, :, :)
    type(fuge_info), intent(out) :: info
    logical, intent(in), optional :: below(:)
    type(grid_work) :: work
    integer :: k

    call check_halfplane_grid(spacing, force, element, boundary, depth, shape(stress), 'stress', 3, info)
    call cut_body(body, depth, work%cut, info, below)
    if (info%failed()) return
    if (.not. body%has_layers()) then
      call fuge_halfplane_stress_grid(spacing, force, element, boundary, depth, stress, info)
      return
    end if
    if (element == FUGE_HAT) call report(info, FUGE_ERR_ELEMENT, 'element FUGE_HAT: in layers the pressure is constant ' &
                                         //'on each cell: use FUGE_MEAN, whose influence is the same')
    work%periodic = boundary == FUGE_PERIODIC
    call start(work, spacing, force, depth, info)
    do k = 1, size(depth)
      if (info%failed()) exit
      if (work%cut(k)%layer == 1) then
        call fuge_halfplane_stress_grid(spacing, force, element, boundary, depth(k:k), work%plain, info)
        if (info%failed()) exit
      else
        work%plain = 0.0_dp
      end if
      call find_stress(work, work%mixture(k), stress(:, :, k))
      stress(:, :, k) = stress(:, :, k)/spacing + work%plain(:, :, 1)
      if (work%periodic) call add_mean(work%cut(k), sum(force)/(spacing*size(force)), stress(:, :, k))
    end do
    call work%waves%free()
  end subroutine fuge_layered_halfplane_stress_grid

  !> Fit the mixtures, compute the sums and transform the forces. FUGE_ERR_MEMORY, FUGE_ERR_UNSUPPORTED.
  subroutine start(work, spacing, force, depth, info)
    type(grid_work), intent(inout) :: work
    real(dp), intent(in) :: spacing, force(:), depth(:)
    type(fuge_info), intent(inout) :: info
    integer :: k, n, stat

    if (info%failed() .or. size(depth) < 1) return
    n = size(force)
    allocate (work%mixture(size(depth)), work%plain(3, n, 1), work%factor(0:n/2, 0:0), stat=stat)
    call require_memory(stat, 'stresses at', n, 'cells', info)
    do k = 1, size(depth)
      if (.not. info%failed()) call fit_at_depth(work%cut(k), depth(k), work%mixture(k), info)
    end do
    if (info%failed()) return
    call work%sums%prepare([n, 1], [spacing, spacing], [merge(WAVES_OF, PLACES_OF, work%periodic), WAVES_OF], &
                           minval(work%mixture%first), stat)
    call require_memory(stat, 'stresses at', n, 'cells', info)
    if (.not. info%failed()) call work%waves%set([n, 1], [work%periodic, .true.], .not. work%periodic, info)
    if (.not. info%failed()) call work%waves%transform(force)
  end subroutine start

  !> `stress` (3, n) of the mixture, times the width of a cell.
  subroutine find_stress(work, mixture, stress)
    type(grid_work), intent(inout) :: work
    type(depth_mixture), intent(in) :: mixture
    real(dp), intent(inout) :: stress(:, :)
    integer :: c

    if (.not. work%periodic) call work%waves%clear_kernels()
    do c = 1, 3
      if (work%periodic) then
        work%factor(:, 0) = work%sums%in_plane(mixture, FUNCTION_OF(c), IS_ODD(c), 1)
        work%factor(0, 0) = 0.0_dp
        call work%waves%multiply([IS_ODD(c), .false.], work%factor, stress(c, :))
      else
        ! An even kernel and an odd one are transformed together.
        if (c == 2) call work%waves%clear_kernels()
        stress(c, :) = work%sums%in_plane(mixture, FUNCTION_OF(c), IS_ODD(c), 1)
        call work%waves%add_kernel([IS_ODD(c), .false.], stress(c, :))
        if (c == 2) cycle
        call work%waves%transform_kernels()
        if (c == 3) call work%waves%convolve([.false., .false.], stress(2, :))
        call work%waves%convolve([IS_ODD(c), .false.], stress(c, :))
      end if
    end do
  end subroutine find_stress

  !> What the mean pressure adds on a periodic surface; zz of a half-plane is there already.
  subroutine add_mean(cut, pressure, stress)
    type(layer_cut), intent(in) :: cut
    real(dp), intent(in) :: pressure
    real(dp), intent(inout) :: stress(:, :)
    real(dp) :: uniform(2)

    uniform = pressure*uniform_stress(cut, .true.)
    if (cut%layer == 1) uniform(2) = 0.0_dp
    stress(1, :) = stress(1, :) + uniform(1)
    stress(2, :) = stress(2, :) + uniform(2)
  end subroutine add_mean

end module fuge_layered_halfplane_depths
