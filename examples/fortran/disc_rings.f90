!> Influence numbers of the rubber disc: Fischer, Hoyer, Melosh, section 5, Bild 4.
!>
!> The disc is meshed with eight-node axisymmetric solid elements, six along the
!> radius and one through the thickness, 3 x 3 Gauss points. The 13 nodes of the
!> lower face, corners and midsides, are the paper's 13 rings. The paper does not
!> describe its elements; these give its printed numbers (see doc/errata.md).
!> Element: O. C. Zienkiewicz, The Finite Element Method, 3rd edition, 1977.
!>
!> Units N and mm; displacements and contact forces are positive upward.
module disc_rings
  use fuge, only: dp => fuge_dp
  implicit none
  private

  public :: disc_influence, ring_radius

  integer, parameter, public :: RINGS = 13
  integer, parameter :: ELEMENTS = (RINGS - 1)/2
  !> Lower face, upper face, midsides of the element edges between them.
  integer, parameter :: NODES = 2*RINGS + ELEMENTS + 1
  !> u_r and u_z of node i are 2i-1 and 2i.
  integer, parameter :: FREEDOMS = 2*NODES

  real(dp), parameter :: RADIUS = 120.0_dp, THICKNESS = 5.0_dp
  !> The printed 2e3 N/mm2 is a misprint: the paper's results need 2e2.
  real(dp), parameter :: YOUNG = 200.0_dp, POISSON = 0.49_dp
  !> p on the upper face, downward; q acts upward on ring 6, R = 50 mm.
  real(dp), parameter :: PRESSURE = 0.01_dp
  integer, parameter :: LINE_RING = 6

  real(dp), parameter :: PI = acos(-1.0_dp)
  !> Three-point Gauss rule on (-1, 1).
  real(dp), parameter :: GAUSS_X(3) = sqrt(0.6_dp)*[-1.0_dp, 0.0_dp, 1.0_dp]
  real(dp), parameter :: GAUSS_W(3) = [5.0_dp, 8.0_dp, 5.0_dp]/9.0_dp
  !> Natural coordinates of an element's nodes: corners counter-clockwise, then midsides.
  integer, parameter :: NODE_S(8) = [-1, 1, 1, -1, 0, 1, 0, -1]
  integer, parameter :: NODE_T(8) = [-1, -1, 1, 1, -1, 0, 1, 0]

  interface
    !> LAPACK: solve A X = B, A symmetric positive definite.
    subroutine dposv(uplo, n, nrhs, a, lda, b, ldb, info)
      import :: dp
      character(len=1), intent(in) :: uplo
      integer, intent(in) :: n, nrhs, lda, ldb
      real(dp), intent(inout) :: a(lda, *), b(ldb, *)
      integer, intent(out) :: info
    end subroutine dposv
  end interface

contains

  !> alpha(k,i): rise of ring k per newton of total force on ring i; b(k): rise of
  !> ring k under p and q (equation 7); load: F_0 = p pi r**2 - q 2 pi R (equation 11).
  !>
  !> `q` line load, N/mm. Ring 13 is held and so the datum of alpha and b; its
  !> support carries nothing once the contact forces balance p and q.
  subroutine disc_influence(q, alpha, b, load)
    real(dp), intent(in) :: q
    real(dp), intent(out) :: alpha(RINGS, RINGS), b(RINGS), load
    real(dp) :: stiffness(FREEDOMS, FREEDOMS), forces(FREEDOMS, RINGS + 1)
    integer :: k, info

    call assemble(stiffness)
    forces = 0.0_dp
    do k = 1, RINGS
      forces(vertical(lower(k)), k) = 1.0_dp
    end do
    forces(:, RINGS + 1) = external_forces(q)
    load = -sum(forces(:, RINGS + 1))
    call hold_supports(stiffness, forces)
    call dposv('L', FREEDOMS, RINGS + 1, stiffness, FREEDOMS, forces, FREEDOMS, info)
    if (info /= 0) error stop 'the stiffness matrix of the disc is not positive definite'
    do k = 1, RINGS
      alpha(k, :) = forces(vertical(lower(k)), :RINGS)
      b(k) = forces(vertical(lower(k)), RINGS + 1)
    end do
    ! The halves differ by rounding only.
    alpha = 0.5_dp*(alpha + transpose(alpha))
  end subroutine disc_influence

  elemental function ring_radius(k) result(r)
    integer, intent(in) :: k
    real(dp) :: r

    r = RADIUS*real(k - 1, dp)/real(RINGS - 1, dp)
  end function ring_radius

  !> Node of the lower face on ring k.
  elemental function lower(k) result(node)
    integer, intent(in) :: k
    integer :: node

    node = k
  end function lower

  !> Node of the upper face on ring k.
  elemental function upper(k) result(node)
    integer, intent(in) :: k
    integer :: node

    node = RINGS + k
  end function upper

  !> Node at half thickness on edge e, 1 (the axis) to ELEMENTS+1 (the rim).
  elemental function halfway(e) result(node)
    integer, intent(in) :: e
    integer :: node

    node = 2*RINGS + e
  end function halfway

  elemental function vertical(node) result(freedom)
    integer, intent(in) :: node
    integer :: freedom

    freedom = 2*node
  end function vertical

  !> Stiffness of the free disc.
  pure subroutine assemble(stiffness)
    real(dp), intent(out) :: stiffness(:, :)
    integer :: e, i, k, nodes_of(8), map(16)

    stiffness = 0.0_dp
    do e = 1, ELEMENTS
      k = 2*e - 1
      nodes_of = [lower(k), lower(k + 2), upper(k + 2), upper(k), &
                  lower(k + 1), halfway(e + 1), upper(k + 1), halfway(e)]
      map = [(2*nodes_of(i) - 1, 2*nodes_of(i), i=1, 8)]
      stiffness(map, map) = stiffness(map, map) + element_stiffness(ring_radius(k), ring_radius(k + 2))
    end do
  end subroutine assemble

  !> Integral of B^T C B 2 pi r over inner <= r <= outer and the thickness.
  pure function element_stiffness(inner, outer) result(stiffness)
    real(dp), intent(in) :: inner, outer
    real(dp) :: stiffness(16, 16)
    real(dp) :: strain(4, 16), shape(8), d_s(8), d_t(8), r, half_r, half_z
    integer :: i, j

    half_r = 0.5_dp*(outer - inner)
    half_z = 0.5_dp*THICKNESS
    stiffness = 0.0_dp
    do i = 1, 3
      do j = 1, 3
        call serendipity(GAUSS_X(i), GAUSS_X(j), shape, d_s, d_t)
        r = inner + half_r*(1.0_dp + GAUSS_X(i))
        strain = strain_matrix(shape/r, d_s/half_r, d_t/half_z)
        stiffness = stiffness + (2.0_dp*PI*r*half_r*half_z*GAUSS_W(i)*GAUSS_W(j)) &
          *matmul(transpose(strain), matmul(elasticity(), strain))
      end do
    end do
  end function element_stiffness

  !> Strains e_r, e_z, e_theta, gamma_rz per nodal displacement.
  pure function strain_matrix(shape_over_r, d_r, d_z) result(strain)
    real(dp), intent(in) :: shape_over_r(8), d_r(8), d_z(8)
    real(dp) :: strain(4, 16)

    strain = 0.0_dp
    strain(1, 1::2) = d_r
    strain(2, 2::2) = d_z
    strain(3, 1::2) = shape_over_r
    strain(4, 1::2) = d_z
    strain(4, 2::2) = d_r
  end function strain_matrix

  !> Isotropic elasticity for e_r, e_z, e_theta, gamma_rz.
  pure function elasticity() result(c)
    real(dp) :: c(4, 4)
    real(dp) :: lame, shear
    integer :: i

    shear = YOUNG/(2.0_dp*(1.0_dp + POISSON))
    lame = 2.0_dp*shear*POISSON/(1.0_dp - 2.0_dp*POISSON)
    c = 0.0_dp
    c(:3, :3) = lame
    do i = 1, 3
      c(i, i) = c(i, i) + 2.0_dp*shear
    end do
    c(4, 4) = shear
  end function elasticity

  !> Shape functions of the eight-node serendipity element and their derivatives.
  pure subroutine serendipity(s, t, shape, d_s, d_t)
    real(dp), intent(in) :: s, t
    real(dp), intent(out) :: shape(8), d_s(8), d_t(8)
    real(dp) :: a, b
    integer :: i

    do i = 1, 8
      a = real(NODE_S(i), dp)
      b = real(NODE_T(i), dp)
      if (NODE_S(i) == 0) then
        shape(i) = 0.5_dp*(1.0_dp - s**2)*(1.0_dp + t*b)
        d_s(i) = -s*(1.0_dp + t*b)
        d_t(i) = 0.5_dp*b*(1.0_dp - s**2)
      else if (NODE_T(i) == 0) then
        shape(i) = 0.5_dp*(1.0_dp - t**2)*(1.0_dp + s*a)
        d_s(i) = 0.5_dp*a*(1.0_dp - t**2)
        d_t(i) = -t*(1.0_dp + s*a)
      else
        shape(i) = 0.25_dp*(1.0_dp + s*a)*(1.0_dp + t*b)*(s*a + t*b - 1.0_dp)
        d_s(i) = 0.25_dp*a*(1.0_dp + t*b)*(2.0_dp*s*a + t*b)
        d_t(i) = 0.25_dp*b*(1.0_dp + s*a)*(s*a + 2.0_dp*t*b)
      end if
    end do
  end subroutine serendipity

  !> Nodal forces of p (consistent, downward) and q (upward) on the upper face.
  pure function external_forces(q) result(forces)
    real(dp), intent(in) :: q
    real(dp) :: forces(FREEDOMS)
    real(dp) :: shape(8), d_s(8), d_t(8), half, r
    integer :: e, i, top(3)

    forces = 0.0_dp
    do e = 1, ELEMENTS
      top = vertical(upper([2*e - 1, 2*e, 2*e + 1]))
      half = 0.5_dp*(ring_radius(2*e + 1) - ring_radius(2*e - 1))
      do i = 1, 3
        call serendipity(GAUSS_X(i), 1.0_dp, shape, d_s, d_t)
        r = ring_radius(2*e) + half*GAUSS_X(i)
        forces(top) = forces(top) - PRESSURE*2.0_dp*PI*r*half*GAUSS_W(i)*shape([4, 7, 3])
      end do
    end do
    i = vertical(upper(LINE_RING))
    forces(i) = forces(i) + q*2.0_dp*PI*ring_radius(LINE_RING)
  end function external_forces

  !> u_r = 0 on the axis and u_z = 0 at the lower node of ring 13: unit rows.
  pure subroutine hold_supports(stiffness, forces)
    real(dp), intent(inout) :: stiffness(:, :), forces(:, :)
    integer :: held(4), i

    held = [vertical([lower(1), upper(1), halfway(1)]) - 1, vertical(lower(RINGS))]
    stiffness(held, :) = 0.0_dp
    stiffness(:, held) = 0.0_dp
    forces(held, :) = 0.0_dp
    do i = 1, size(held)
      stiffness(held(i), held(i)) = 1.0_dp
    end do
  end subroutine hold_supports

end module disc_rings
