!> Edges of contact at which the pressure does not fall like a square root, from the forces of the cells next to them:
!> where it is cut off by a limit a few cells from the edge, and where it presses on a bed.
!>
!> Forces are those of the cells from the edge inwards, all positive; positions count in cells, outwards from the outer
!> edge of the first cell. See doc/theory.md, "Edges of the contact".
module fuge_edge_estimates
  use fuge_kinds, only: dp
  implicit none
  private

  public :: limited_edge, bed_edge

  !> On a bed, the edge is the zero of the polynomial through BED_CELLS forces.
  integer, parameter, public :: BED_CELLS = 4

  !> Estimate of the error of the edge on a bed, in cells, over the second and the third difference of the forces in
  !> units of the first. From the tests.
  real(dp), parameter :: BY_SECOND = 0.1_dp, BY_THIRD = 2.0_dp

contains

  !> Where the contact ends, if the pressure falls from its limit to zero within the cells of `fraction`, their forces
  !> over the limit; no cell if the limit is reached up to the edge.
  !>
  !> Where few cells carry less than the limit, the pressure between its two ends, at -b and b, is that of Dugdale's
  !> strip (Journal of the Mechanics and Physics of Solids 8, 1960, 100-104), limit*arccos(x/b)/pi. Its decrease has the
  !> variance b**2/2 about the middle. Forces of cells leave the mean of the decrease as it is, and add a sixth of a
  !> cell to the variance.
  pure function limited_edge(fraction) result(outward)
    real(dp), intent(in) :: fraction(:)
    real(dp) :: outward
    real(dp), parameter :: BY_CELLS = 1.0_dp/6.0_dp
    real(dp) :: middle, variance
    integer :: j, n

    n = size(fraction)
    middle = sum(fraction)
    variance = sum([(real(2*(n - j) + 1, dp), j=1, n)]*fraction) - middle**2
    outward = middle - real(n, dp) + sqrt(2.0_dp*max(variance - BY_CELLS, 0.0_dp))
  end function limited_edge

  !> Where the contact on a bed ends, between `least` and `most` (which lies beyond the first cell's centre), and the
  !> `error` of that, in cells; `force`: those of the first BED_CELLS cells. `error` is huge if no edge lies there.
  !>
  !> The pressure is as smooth as the gap that the bed takes up, up to the edge: it falls to zero linearly.
  pure subroutine bed_edge(force, least, most, outward, error)
    real(dp), intent(in) :: force(BED_CELLS), least, most
    real(dp), intent(out) :: outward, error
    real(dp) :: difference(3)

    difference = [force(2) - force(1), force(3) - 2.0_dp*force(2) + force(1), &
                  force(4) - 3.0_dp*force(3) + 3.0_dp*force(2) - force(1)]
    outward = zero_beyond(force, most)
    error = huge(error)
    if (difference(1) <= 0.0_dp .or. outward < least .or. outward >= most) return
    error = (BY_SECOND*abs(difference(2)) + BY_THIRD*abs(difference(3)))/difference(1)
  end subroutine bed_edge

  !> Where the polynomial through the forces has a zero outwards of the first cell's centre; `most` if it has no other
  !> sign there.
  pure function zero_beyond(force, most) result(outward)
    real(dp), intent(in) :: force(:), most
    real(dp) :: outward
    real(dp) :: inner, outer

    inner = -0.5_dp
    outer = most
    outward = most
    if (extrapolated(force, most) > 0.0_dp) return
    do
      outward = inner + 0.5_dp*(outer - inner)
      if (outward <= inner .or. outward >= outer) exit
      if (extrapolated(force, outward) > 0.0_dp) then
        inner = outward
      else
        outer = outward
      end if
    end do
  end function zero_beyond

  !> The value of the polynomial through the forces at a position, by Lagrange's formula.
  pure function extrapolated(force, outward) result(value)
    real(dp), intent(in) :: force(:), outward
    real(dp) :: value
    real(dp) :: term
    integer :: i, j

    value = 0.0_dp
    do j = 1, size(force)
      term = force(j)
      do i = 1, size(force)
        if (i /= j) term = term*(real(i, dp) - 0.5_dp + outward)/real(i - j, dp)
      end do
      value = value + term
    end do
  end function extrapolated

end module fuge_edge_estimates
