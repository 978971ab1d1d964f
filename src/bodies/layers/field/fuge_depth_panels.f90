!> Mixtures of Gaussians at many depths of a body of layers: fitted at a few depths of each panel, and interpolated.
!>
!> The top layer is one panel; a deeper layer is divided so that the lower end of a panel is at most twice as deep as
!> its upper one. There what a wave gives is an analytic function of the depth, with singularities at the surface and
!> its images; Chebyshev's interpolation through NODES depths converges like 6**-NODES (L. N. Trefethen, Approximation
!> Theory and Approximation Practice, 2013, chapters 5 and 8). The weights are linear in what waves give, so they are
!> what is interpolated.
module fuge_depth_panels
  use fuge_constants, only: PI
  use fuge_depth_mixture, only: depth_mixture, fit_at_depths, FUNCTIONS
  use fuge_kinds, only: dp
  use fuge_layer_interior, only: find_cut, is_upper_half, layer_cut
  use fuge_layer_stack, only: layer_stack
  use fuge_layered_body_type, only: copy_layers, fuge_layered_body
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  !> Depths of a panel at which mixtures are fitted, at most.
  integer, parameter :: NODES = 18
  !> Between depths that are closer than this fraction of them linear interpolation is exact, and more nodes would be
  !> the same numbers.
  real(dp), parameter :: CLOSE = 1.0e-9_dp

  type :: depth_panel
    !> The layer; the panel begins at 2**octave times the depth of the layer's top.
    integer :: layer = 0, octave = 0
    !> Up to NODES different depths in `node`; with more of them `many` is true, and only the least and the greatest are
    !> kept until the fit.
    integer :: number = 0
    logical :: many = .false.
    real(dp) :: least = 0.0_dp, greatest = 0.0_dp, node(NODES) = 0.0_dp
    type(depth_mixture) :: mixture(NODES)
  end type depth_panel

  type, public :: depth_panels
    private
    type(layer_stack) :: stack
    type(depth_panel), allocatable :: panel(:)
    integer :: count = 0
  contains
    procedure :: fit
    procedure :: first_length
    procedure :: make_room
    procedure :: mixture_at
  end type depth_panels

contains

  !> Fit mixtures for each `depth` (m), length, each in its `layer` (m) of the `body`. FUGE_ERR_MEMORY.
  subroutine fit(self, body, layer, depth, info)
    class(depth_panels), intent(out) :: self
    type(fuge_layered_body), intent(in) :: body
    integer, intent(in) :: layer(:)
    real(dp), intent(in) :: depth(:)
    type(fuge_info), intent(inout) :: info
    integer :: k

    if (info%failed()) return
    call copy_layers(body, self%stack, info)
    do k = 1, size(depth)
      call add_depth(self, layer(k), depth(k), info)
    end do
    do k = 1, self%count
      call fit_panel(self%stack, self%panel(k), info)
    end do
  end subroutine fit

  !> Add a depth to its panel, which may be a new one.
  subroutine add_depth(panels, layer, depth, info)
    class(depth_panels), intent(inout) :: panels
    integer, intent(in) :: layer
    real(dp), intent(in) :: depth
    type(fuge_info), intent(inout) :: info
    integer :: k

    if (info%failed()) return
    k = number_of_panel(panels, layer, depth)
    if (k > panels%count) call add_panel(panels, layer, octave_of(panels%stack, layer, depth), info)
    if (info%failed()) return
    associate (panel => panels%panel(k))
      if (panel%number == 0) then
        panel%least = depth
        panel%greatest = depth
      end if
      panel%least = min(panel%least, depth)
      panel%greatest = max(panel%greatest, depth)
      if (panel%many) return
      if (any(is_same(panel%node(:panel%number), depth))) return
      panel%many = panel%number == NODES
      if (panel%many) return
      panel%number = panel%number + 1
      panel%node(panel%number) = depth
    end associate
  end subroutine add_depth

  elemental function is_same(a, b)
    real(dp), intent(in) :: a, b
    logical :: is_same

    is_same = .not. abs(a - b) > 0.0_dp
  end function is_same

  !> The largest k >= 0 for which 2**k times the depth of the layer's top is not above `depth`; 0 in the top layer.
  pure function octave_of(stack, layer, depth) result(octave)
    type(layer_stack), intent(in) :: stack
    integer, intent(in) :: layer
    real(dp), intent(in) :: depth
    integer :: octave
    real(dp) :: top

    octave = 0
    top = sum(stack%thickness(:layer - 1))
    if (top > 0.0_dp .and. depth > top) octave = int((log(depth) - log(top))/log(2.0_dp))
  end function octave_of

  !> The panel of a depth, or the next number if there is none yet.
  pure function number_of_panel(panels, layer, depth) result(k)
    class(depth_panels), intent(in) :: panels
    integer, intent(in) :: layer
    real(dp), intent(in) :: depth
    integer :: k
    integer :: octave

    octave = octave_of(panels%stack, layer, depth)
    do k = 1, panels%count
      if (panels%panel(k)%layer == layer .and. panels%panel(k)%octave == octave) return
    end do
  end function number_of_panel

  subroutine add_panel(panels, layer, octave, info)
    class(depth_panels), intent(inout) :: panels
    integer, intent(in) :: layer, octave
    type(fuge_info), intent(inout) :: info
    type(depth_panel), allocatable :: longer(:)
    integer :: room, stat

    room = 0
    if (allocated(panels%panel)) room = size(panels%panel)
    if (panels%count == room) then
      allocate (longer(2*room + 2), stat=stat)
      call require_memory(stat, 'results at the depths of', 2*room + 2, 'panels', info)
      if (stat /= 0) return
      if (room > 0) longer(:room) = panels%panel
      call move_alloc(longer, panels%panel)
    end if
    panels%count = panels%count + 1
    panels%panel(panels%count)%layer = layer
    panels%panel(panels%count)%octave = octave
  end subroutine add_panel

  subroutine fit_panel(stack, panel, info)
    type(layer_stack), intent(in) :: stack
    type(depth_panel), intent(inout) :: panel
    type(fuge_info), intent(inout) :: info
    type(layer_cut) :: cut(NODES)
    integer :: k, stat

    if (info%failed()) return
    if (panel%many .and. panel%greatest - panel%least < CLOSE*scale_of(stack, panel)) then
      panel%number = 2
      panel%node(:2) = [panel%least, panel%greatest]
    else if (panel%many) then
      do k = 1, NODES
        panel%node(k) = panel%least + (panel%greatest - panel%least) &
                        *sin(0.5_dp*PI*real(k - 1, dp)/real(NODES - 1, dp))**2
      end do
    end if
    do k = 1, panel%number
      call find_cut(stack, panel%node(k), is_upper_half(stack, panel%layer, panel%node(k)), cut(k), stat)
      call require_memory(stat, 'the layers at', panel%number, 'depths', info)
      if (stat /= 0) return
    end do
    call fit_at_depths(cut(:panel%number), panel%node(:panel%number), panel%mixture(:panel%number), info)
  end subroutine fit_panel

  !> A length over which what waves give varies in the panel.
  pure function scale_of(stack, panel) result(length)
    type(layer_stack), intent(in) :: stack
    type(depth_panel), intent(in) :: panel
    real(dp) :: length

    length = panel%greatest
    if (panel%layer == 1) length = stack%thickness(1)
  end function scale_of

  !> The number of the shortest length of all mixtures.
  pure function first_length(self) result(first)
    class(depth_panels), intent(in) :: self
    integer :: first
    integer :: k

    first = huge(first)
    do k = 1, self%count
      first = min(first, self%panel(k)%mixture(1)%first)
    end do
  end function first_length

  !> Room for the mixture at any of the depths. FUGE_ERR_MEMORY.
  pure subroutine make_room(self, mixture, info)
    class(depth_panels), intent(in) :: self
    type(depth_mixture), intent(inout) :: mixture
    type(fuge_info), intent(inout) :: info
    integer :: count, k, stat

    if (info%failed()) return
    count = 0
    do k = 1, self%count
      count = max(count, self%panel(k)%mixture(1)%count)
    end do
    if (allocated(mixture%weight)) deallocate (mixture%weight)
    allocate (mixture%weight(count, FUNCTIONS), stat=stat)
    call require_memory(stat, 'stresses in layers, with', count, 'weights', info)
  end subroutine make_room

  !> The mixture at a `depth` of a `layer`, one of those that were fitted, in which there is room for it.
  pure subroutine mixture_at(self, layer, depth, mixture)
    class(depth_panels), intent(in) :: self
    integer, intent(in) :: layer
    real(dp), intent(in) :: depth
    type(depth_mixture), intent(inout) :: mixture
    real(dp) :: share(NODES)
    integer :: k

    associate (panel => self%panel(number_of_panel(self, layer, depth)))
      call find_shares(panel, depth, share(:panel%number))
      mixture%first = panel%mixture(1)%first
      mixture%count = panel%mixture(1)%count
      mixture%weight(:mixture%count, :) = 0.0_dp
      mixture%beyond = 0.0_dp
      do k = 1, panel%number
        if (is_same(share(k), 0.0_dp)) cycle
        mixture%weight(:mixture%count, :) = mixture%weight(:mixture%count, :) + share(k)*panel%mixture(k)%weight
        mixture%beyond = mixture%beyond + share(k)*panel%mixture(k)%beyond
      end do
    end associate
  end subroutine mixture_at

  !> The shares of the nodes in the value at a depth (J.-P. Berrut, L. N. Trefethen, Barycentric Lagrange interpolation,
  !> SIAM Review 46, 2004).
  pure subroutine find_shares(panel, depth, share)
    type(depth_panel), intent(in) :: panel
    real(dp), intent(in) :: depth
    real(dp), intent(out) :: share(:)
    integer :: k

    if (any(is_same(panel%node(:panel%number), depth))) then
      share = merge(1.0_dp, 0.0_dp, is_same(panel%node(:panel%number), depth))
      return
    end if
    if (size(share) == 2) then
      share = [panel%node(2) - depth, depth - panel%node(1)]/(panel%node(2) - panel%node(1))
      return
    end if
    do k = 1, size(share)
      share(k) = merge(1.0_dp, -1.0_dp, mod(k, 2) == 0)/(depth - panel%node(k))
      if (k == 1 .or. k == size(share)) share(k) = 0.5_dp*share(k)
    end do
    share = share/sum(share)
  end subroutine find_shares

end module fuge_depth_panels
