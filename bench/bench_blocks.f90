!> Bodies of square or cubic elements for the benchmark: their stiffness matrices, supports and contact points.
module bench_blocks
  use fuge, only: dp => fuge_dp, fuge_body
  implicit none
  private

  public :: make_mesh, hold, float

  real(dp), parameter :: POISSON = 0.3_dp

  !> A body or two of square or cubic elements, its supports for the bound, and its contact.
  type, public :: mesh
    integer :: dimensions = 2, bodies = 1
    !> Elements in each direction; contact is on the first side of the last one.
    integer :: elements(3) = 1
    integer, allocatable :: column(:), row(:)
    real(dp), allocatable :: value(:)
    type(fuge_body) :: body
    integer, allocatable :: pinned(:)
  end type mesh

contains

  !> Fix the last side of the last direction; of two bodies, which touch with their first sides, each its own.
  subroutine hold(block)
    type(mesh), intent(inout) :: block
    integer :: all, i, k

    all = size(block%column) - 1
    associate (side => all/block%bodies/(block%elements(block%dimensions) + 1))
      block%body%fixed = [((k*all/block%bodies - side + i, i=1, side), k=1, block%bodies)]
    end associate
    block%pinned = [integer ::]
    block%body%load = [(1.0e-3_dp*modulo(i, 7), i=1, all)]
  end subroutine hold

  !> No supports: the rigid modes are to be found, and the load is balanced in the directions that contact does not
  !> resist.
  subroutine float(block)
    type(mesh), intent(inout) :: block
    integer :: all, d, nodes, side

    d = block%dimensions
    all = size(block%column) - 1
    nodes = all/d
    side = nodes/(block%elements(d) + 1)
    block%body%floats = .true.
    if (d == 2) block%pinned = [1, 2, 2*side]
    if (d == 3) block%pinned = [1, 2, 3, 3*(block%elements(1) + 1) - 1, 3*(block%elements(1) + 1), 3*side]
    allocate (block%body%load(all))
    block%body%load = 0.0_dp
    block%body%load(all - d*side + d::d) = -1.0e-3_dp
  end subroutine float

  !> A mesh of `counts` elements, twice for two bodies, with its contact points: the nodes of the first side.
  subroutine make_mesh(counts, bodies, block)
    integer, intent(in) :: counts(3), bodies
    type(mesh), intent(out) :: block
    real(dp), allocatable :: element(:, :)
    integer, allocatable :: entry_row(:), entry_column(:), dof(:)
    real(dp), allocatable :: entry(:)
    integer :: d, e, i, j, last, nodes, side

    d = merge(3, 2, counts(3) > 0)
    block%dimensions = d
    block%bodies = bodies
    block%elements = counts
    allocate (element, source=element_stiffness(d))
    nodes = product(counts(:d) + 1)
    side = nodes/(counts(d) + 1)
    associate (terms => size(dof_of_element(1, counts, d, 0)))
      allocate (entry_row(bodies*product(counts(:d))*terms*(terms + 1)/2))
    end associate
    allocate (entry_column(size(entry_row)), entry(size(entry_row)))
    last = 0
    do e = 1, bodies*product(counts(:d))
      dof = dof_of_element(1 + modulo(e - 1, product(counts(:d))), counts, d, (e - 1)/product(counts(:d))*nodes)
      do j = 1, size(dof)
        do i = 1, size(dof)
          if (dof(i) > dof(j)) cycle
          last = last + 1
          entry_row(last) = dof(i)
          entry_column(last) = dof(j)
          entry(last) = element(i, j)
        end do
      end do
    end do
    call to_columns(bodies*nodes*d, entry_row, entry_column, entry, block)
    allocate (block%body%dof(bodies, side), block%body%normal(bodies, side))
    do i = 1, side
      block%body%dof(:, i) = [(d*(e*nodes + i), e=0, bodies - 1)]
      block%body%normal(:, i) = [((-1.0_dp)**e, e=0, bodies - 1)]
    end do
  end subroutine make_mesh

  !> The degrees of freedom of element `e`, the corners in the order of `element_stiffness`.
  pure function dof_of_element(e, counts, d, before) result(dof)
    integer, intent(in) :: e, counts(3), d, before
    integer :: dof(d*2**d), place(3), node, c, k

    place = [modulo(e - 1, counts(1)), modulo((e - 1)/counts(1), counts(2)), (e - 1)/(counts(1)*counts(2))]
    do c = 0, 2**d - 1
      node = 0
      do k = d, 1, -1
        node = node*(counts(k) + 1) + place(k) + ibits(c, k - 1, 1)
      end do
      dof(d*c + 1:d*c + d) = [(d*(before + node) + k, k=1, d)]
    end do
  end function dof_of_element

  !> Compressed columns; entries may repeat.
  subroutine to_columns(n, entry_row, entry_column, entry, block)
    integer, intent(in) :: n, entry_row(:), entry_column(:)
    real(dp), intent(in) :: entry(:)
    type(mesh), intent(inout) :: block
    integer :: e, j

    allocate (block%column(n + 1), block%row(size(entry)), block%value(size(entry)))
    block%column = 0
    do e = 1, size(entry)
      block%column(entry_column(e)) = block%column(entry_column(e)) + 1
    end do
    ! The end of each column, then, backwards, its beginning.
    do j = 2, n
      block%column(j) = block%column(j) + block%column(j - 1)
    end do
    block%column = block%column + 1
    block%column(n + 1) = size(entry) + 1
    do e = size(entry), 1, -1
      j = entry_column(e)
      block%column(j) = block%column(j) - 1
      block%row(block%column(j)) = entry_row(e)
      block%value(block%column(j)) = entry(e)
    end do
  end subroutine to_columns

  !> Stiffness of the bilinear square in plane strain or the trilinear cube, of unit side and unit shear modulus, by two
  !> Gauss points in each direction.
  function element_stiffness(d) result(element)
    integer, intent(in) :: d
    real(dp) :: element(d*2**d, d*2**d), slope(d, 2**d), point(d), lambda
    integer :: a, b, c, i, j, k

    lambda = 2*POISSON/(1 - 2*POISSON)
    element = 0.0_dp
    do c = 0, 2**d - 1
      point = [(0.5_dp + (2*ibits(c, k - 1, 1) - 1)/sqrt(12.0_dp), k=1, d)]
      do a = 0, 2**d - 1
        do k = 1, d
          slope(k, a + 1) = (2*ibits(a, k - 1, 1) - 1) &
                            *product([(merge(point(j), 1 - point(j), ibits(a, j - 1, 1) == 1), j=1, k - 1)]) &
                            *product([(merge(point(j), 1 - point(j), ibits(a, j - 1, 1) == 1), j=k + 1, d)])
        end do
      end do
      do a = 1, 2**d
        do b = 1, 2**d
          do i = 1, d
            do j = 1, d
              associate (term => element(d*(a - 1) + i, d*(b - 1) + j))
                term = term + (lambda*slope(i, a)*slope(j, b) + slope(j, a)*slope(i, b) &
                               + merge(dot_product(slope(:, a), slope(:, b)), 0.0_dp, i == j))/2**d
              end associate
            end do
          end do
        end do
      end do
    end do
  end function element_stiffness

end module bench_blocks
