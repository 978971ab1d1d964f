!> Means over two rings about one axis of what layers add at the distance between a point of one and a point of the
!> other one.
module fuge_ring_overlap
  use fuge_constants, only: PI
  use fuge_gauss_legendre, only: gauss_rules
  use fuge_kinds, only: dp
  use fuge_layer_kernel, only: layer_kernel
  use fuge_smooth_panels, only: divide, nodes_needed, MOST_NODES, PANELS
  implicit none
  private

  type, public :: ring_overlap
    private
    real(dp) :: node(MOST_NODES, MOST_NODES), weight(MOST_NODES, MOST_NODES)
  contains
    procedure :: start
    procedure :: mean_of
  end type ring_overlap

contains

  !> Compute the rules of Gauss and Legendre.
  subroutine start(self)
    class(ring_overlap), intent(inout) :: self

    call gauss_rules(self%node, self%weight)
  end subroutine start

  !> The mean of `kernel` over the rings from `one(1)` to `one(2)` and from `other(1)` to `other(2)`.
  !>
  !> The mean over two circles of the radii r and s is smooth over their difference, but near 0, and over their sum, so
  !> that these are the variables.
  pure function mean_of(self, kernel, one, other) result(mean)
    class(ring_overlap), intent(in) :: self
    type(layer_kernel), intent(in) :: kernel
    real(dp), intent(in) :: one(2), other(2)
    real(dp) :: mean
    real(dp) :: bound(4), difference, ends(2, PANELS), length
    integer :: count, j, k, nodes, piece

    ! Between these differences r - s the sums have the same bounds.
    bound = [one(1) - other(2), min(one(1) - other(1), one(2) - other(2)), max(one(1) - other(1), one(2) - other(2)), &
             one(2) - other(1)]
    mean = 0.0_dp
    do piece = 1, 3
      if (.not. bound(piece + 1) > bound(piece)) cycle
      call divide(bound(piece), bound(piece + 1), [0.0_dp], kernel%scale, ends, count)
      do j = 1, count
        nodes = nodes_needed(ends(:, j), [0.0_dp], kernel%scale)
        length = ends(2, j) - ends(1, j)
        do k = 1, nodes
          difference = ends(1, j) + length*self%node(k, nodes)
          mean = mean + length*self%weight(k, nodes)*integral_over_sum(self, kernel, difference, one, other)
        end do
      end do
    end do
    mean = mean/(0.25_dp*(one(2)**2 - one(1)**2)*(other(2)**2 - other(1)**2))
  end function mean_of

  !> The integral of r s times the mean over the circles of the radii r in `one` and s in `other` whose `difference` is
  !> given, over (r + s)/2.
  pure function integral_over_sum(self, kernel, difference, one, other) result(integral)
    type(ring_overlap), intent(in) :: self
    type(layer_kernel), intent(in) :: kernel
    real(dp), intent(in) :: difference, one(2), other(2)
    real(dp) :: integral
    real(dp) :: ends(2, PANELS), length, middle, r, s, smooth
    integer :: count, j, k, nodes

    smooth = max(kernel%scale, abs(difference))
    call divide(max(one(1) - 0.5_dp*difference, other(1) + 0.5_dp*difference), &
                min(one(2) - 0.5_dp*difference, other(2) + 0.5_dp*difference), [0.0_dp], smooth, ends, count)
    integral = 0.0_dp
    do j = 1, count
      nodes = nodes_needed(ends(:, j), [0.0_dp], smooth)
      length = ends(2, j) - ends(1, j)
      do k = 1, nodes
        middle = ends(1, j) + length*self%node(k, nodes)
        r = max(middle + 0.5_dp*difference, 0.0_dp)
        s = max(middle - 0.5_dp*difference, 0.0_dp)
        integral = integral + length*self%weight(k, nodes)*r*s*mean_over_circle(self, kernel, r, s)
      end do
    end do
  end function integral_over_sum

  !> The mean over a circle of the radius `s` of what is added at the distance from a point at the radius `r`.
  pure function mean_over_circle(self, kernel, r, s) result(mean)
    type(ring_overlap), intent(in) :: self
    type(layer_kernel), intent(in) :: kernel
    real(dp), intent(in) :: r, s
    real(dp) :: mean
    real(dp) :: angle, ends(2, PANELS), length, smooth
    integer :: count, j, k, nodes

    mean = kernel%value_at(abs(r - s))
    if (.not. r*s > 0.0_dp) return
    smooth = max(kernel%scale, abs(r - s))/sqrt(r*s)
    call divide(0.0_dp, PI, [0.0_dp], smooth, ends, count)
    mean = 0.0_dp
    do j = 1, count
      nodes = nodes_needed(ends(:, j), [0.0_dp], smooth)
      length = ends(2, j) - ends(1, j)
      do k = 1, nodes
        angle = ends(1, j) + length*self%node(k, nodes)
        mean = mean + length*self%weight(k, nodes)*kernel%value_at(hypot(r - s, 2.0_dp*sqrt(r*s)*sin(0.5_dp*angle)))
      end do
    end do
    mean = mean/PI
  end function mean_over_circle

end module fuge_ring_overlap
