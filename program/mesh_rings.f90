!> Areas on the surface of a body of revolution, whose mesh is its section: a length in the plane becomes a ring.
module mesh_rings
  use fuge, only: dp => fuge_dp, fuge_surface_mesh
  implicit none
  private

  public :: find_circumferences

  real(dp), parameter :: PI = acos(-1.0_dp)
  !> Gauss's rule of three points on [-1, 1].
  real(dp), parameter :: POINTS(3) = sqrt(0.6_dp)*[-1.0_dp, 0.0_dp, 1.0_dp]
  real(dp), parameter :: WEIGHTS(3) = [5.0_dp, 8.0_dp, 5.0_dp]/9.0_dp

contains

  !> The mean circumference of the part of a surface that belongs to each of its nodes, 2 pi times the mean of the
  !> radius x; 0 for a node that no face has. Edges have two or three nodes.
  !>
  !> The weights are those of the areas of contact points: of three nodes the shape functions of the ends with a quarter
  !> of that of the middle node, nowhere negative. By the shape function alone a node on the axis would have no area.
  pure subroutine find_circumferences(surface, circumference)
    type(fuge_surface_mesh), intent(in) :: surface
    real(dp), allocatable, intent(out) :: circumference(:)
    real(dp), allocatable :: length(:)
    real(dp) :: around, share, shape(3), slope(3)
    integer :: f, k, nodes, q

    allocate (circumference(size(surface%node, 2)), source=0.0_dp)
    allocate (length(size(surface%node, 2)), source=0.0_dp)
    do f = 1, size(surface%face, 2)
      nodes = count(surface%face(:, f) > 0)
      do q = 1, size(POINTS)
        call find_shapes(nodes, POINTS(q), shape, slope)
        associate (node => surface%face(:nodes, f))
          share = WEIGHTS(q)*norm2(matmul(surface%node(:, node), slope(:nodes)))
          around = 2.0_dp*PI*dot_product(surface%node(1, node), shape(:nodes))
          shape = [shape(:2) + 0.25_dp*shape(3), 0.5_dp*shape(3)]
          do k = 1, nodes
            length(node(k)) = length(node(k)) + share*shape(k)
            circumference(node(k)) = circumference(node(k)) + share*shape(k)*around
          end do
        end associate
      end do
    end do
    where (length > 0.0_dp) circumference = circumference/length
  end subroutine find_circumferences

  !> Shape functions of an edge, and their derivatives, at `xi` in [-1, 1]; the third node is in the middle.
  pure subroutine find_shapes(nodes, xi, shape, slope)
    integer, intent(in) :: nodes
    real(dp), intent(in) :: xi
    real(dp), intent(out) :: shape(3), slope(3)

    shape = 0.5_dp*[1.0_dp - xi, 1.0_dp + xi, 0.0_dp]
    slope = [-0.5_dp, 0.5_dp, 0.0_dp]
    if (nodes < 3) return
    shape = [0.5_dp*xi*(xi - 1.0_dp), 0.5_dp*xi*(xi + 1.0_dp), (1.0_dp - xi)*(1.0_dp + xi)]
    slope = [xi - 0.5_dp, xi + 0.5_dp, -2.0_dp*xi]
  end subroutine find_shapes

end module mesh_rings
