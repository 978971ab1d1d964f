!> Bodies of random scenes: matrices of many kinds, and operators by FFT.
module random_bodies
  use, intrinsic :: iso_fortran_env, only: int64
  use engine_scene_type, only: engine_scene
  use fuge_cell_elements, only: FUGE_CENTRE, FUGE_MEAN, FUGE_FREE, FUGE_PERIODIC
  use fuge_halfplane_fft, only: fuge_halfplane_operator
  use fuge_halfplane_influence, only: fuge_halfplane_matrix
  use fuge_halfspace_fft, only: fuge_halfspace_operator
  use fuge_halfspace_grid, only: FUGE_PERIODIC_X, FUGE_PERIODIC_Y
  use fuge_halfspace_influence, only: fuge_halfspace_matrix
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info
  use general_reference, only: draw, integers
  use influence_matrices, only: matrix_of, products_only
  use random_draws, only: chance, decimal, one_of, uniform
  implicit none
  private

  public :: draw_body

  !> Largest number of points of a matrix, of cells in a direction of a grid on a half-space and on a half-plane: enough
  !> for coarser grids.
  integer, parameter :: MOST_POINTS = 80, MOST_CELLS = 24, MOST_IN_A_ROW = 500

contains

  !> Matrix, operator, positions and parts, in units of any size.
  subroutine draw_body(seed, scene)
    integer(int64), intent(inout) :: seed
    type(engine_scene), intent(inout) :: scene
    real(dp) :: softness

    softness = 1.0_dp
    if (chance(seed, 0.5_dp)) softness = decimal(seed, -12.0_dp, 12.0_dp)
    select case (one_of(seed, 13))
    case (1, 2)
      call draw_conditioned(seed, scene)
    case (3)
      call draw_halfplane(seed, scene)
    case (4)
      call draw_halfspace(seed, scene)
    case (5)
      call draw_exponential(seed, scene)
    case (6)
      call draw_two_bodies(seed, scene)
    case (7)
      call draw_duplicates(seed, scene)
    case (8)
      call draw_low_rank(seed, scene)
    case (9)
      call draw_chain(seed, scene)
    case (10)
      call draw_whole_numbers(seed, scene)
    case (11)
      call draw_halfplane_grid(seed, softness, scene)
    case default
      call draw_halfspace_grid(seed, softness, scene)
    end select
    if (allocated(scene%operator)) return
    scene%alpha = softness*scene%alpha
    call perhaps_products_only(seed, scene)
  end subroutine draw_body

  !> Few points in most cases, up to MOST_POINTS in some.
  function draw_size(seed) result(n)
    integer(int64), intent(inout) :: seed
    integer :: n

    n = nint(decimal(seed, 0.0_dp, log10(real(MOST_POINTS, dp))))
    if (chance(seed, 0.3_dp)) n = one_of(seed, MOST_POINTS)
  end function draw_size

  !> Positions without a meaning for the matrix, two parts of about half of the points each.
  subroutine draw_positions(seed, n, scene)
    integer(int64), intent(inout) :: seed
    integer, intent(in) :: n
    type(engine_scene), intent(inout) :: scene
    integer :: k

    allocate (scene%x(n), scene%y(n), scene%part(n))
    call draw(seed, scene%x)
    call draw(seed, scene%y)
    scene%x = scene%x - 0.5_dp
    scene%y = scene%y - 0.5_dp
    scene%part = [(merge(1, 2, 2*k <= n + 1), k=1, n)]
  end subroutine draw_positions

  !> Half of the matrices become products alone, some of them with a constant taken out.
  subroutine perhaps_products_only(seed, scene)
    integer(int64), intent(inout) :: seed
    type(engine_scene), intent(inout) :: scene

    if (chance(seed, 0.5_dp)) return
    allocate (products_only :: scene%operator)
    select type (operator => scene%operator)
    type is (products_only)
      if (chance(seed, 0.3_dp)) operator%constant = uniform(seed, 0.0_dp, 1.0_dp)*minval(scene%alpha)
      allocate (operator%matrix, source=scene%alpha - operator%constant)
    end select
    scene%body = trim(scene%body)//', products'
  end subroutine perhaps_products_only

  !> Q D Q^T with three reflections Q and a condition from 1e1 to 1e8.
  subroutine draw_conditioned(seed, scene)
    integer(int64), intent(inout) :: seed
    type(engine_scene), intent(inout) :: scene
    real(dp), allocatable :: v(:)
    real(dp) :: bits
    integer :: k, n

    n = draw_size(seed)
    call draw_positions(seed, n, scene)
    bits = uniform(seed, 1.0_dp, 8.0_dp)
    allocate (scene%alpha(n, n), v(n))
    scene%alpha = 0.0_dp
    do k = 1, n
      scene%alpha(k, k) = 10.0_dp**(-bits*real(k - 1, dp)/real(max(n - 1, 1), dp))
    end do
    do k = 1, 3
      call draw(seed, v)
      v = v - 0.5_dp
      call reflect(v/norm2(v), scene%alpha)
    end do
    scene%alpha = 0.5_dp*(scene%alpha + transpose(scene%alpha))
    write (scene%body, '(a,f3.1)') 'condition 1e', bits
  end subroutine draw_conditioned

  !> H A H with the reflection H = 1 - 2 v v^T.
  subroutine reflect(v, alpha)
    real(dp), intent(in) :: v(:)
    real(dp), intent(inout) :: alpha(:, :)
    real(dp) :: w(size(v))
    integer :: k

    w = 2.0_dp*(matmul(alpha, v) - dot_product(v, matmul(alpha, v))*v)
    do k = 1, size(v)
      alpha(:, k) = alpha(:, k) - w*v(k) - v*w(k)
    end do
  end subroutine reflect

  !> Cells on a half-plane, equal or not, side by side or apart.
  subroutine draw_halfplane(seed, scene)
    integer(int64), intent(inout) :: seed
    type(engine_scene), intent(inout) :: scene
    type(fuge_info) :: info
    real(dp), allocatable :: width(:)
    real(dp) :: place
    integer :: k, n

    n = draw_size(seed)
    call draw_positions(seed, n, scene)
    allocate (scene%alpha(n, n), width(n))
    width = 1.0_dp/real(n, dp)
    if (chance(seed, 0.5_dp)) then
      call draw(seed, width)
      width = (0.1_dp + width)/real(n, dp)
    end if
    place = -0.5_dp
    do k = 1, n
      scene%x(k) = place + 0.5_dp*width(k)
      place = place + width(k)
    end do
    scene%y = 4.0_dp*scene%x**2 - 0.3_dp
    scene%alpha = 0.0_dp
    call fuge_halfplane_matrix(scene%x, width, 1.0_dp, FUGE_MEAN, scene%alpha, info)
    scene%body = 'half-plane'
  end subroutine draw_halfplane

  !> Cells of a grid on a half-space, of which some are left out.
  subroutine draw_halfspace(seed, scene)
    integer(int64), intent(inout) :: seed
    type(engine_scene), intent(inout) :: scene
    type(fuge_info) :: info
    logical, allocatable :: kept(:)
    real(dp), allocatable :: random(:), x(:), y(:)
    integer :: cells(2), n

    cells(1) = one_of(seed, 9)
    cells(2) = one_of(seed, 8)
    call grid_positions(cells, [1.0_dp, 1.0_dp]/real(maxval(cells), dp), x, y)
    allocate (random(size(x)))
    call draw(seed, random)
    allocate (kept, source=random < 0.8_dp)
    kept(1) = .true.
    n = count(kept)
    call draw_positions(seed, n, scene)
    scene%x = pack(x, kept)
    scene%y = pack(y, kept)
    allocate (scene%alpha(n, n))
    scene%alpha = 0.0_dp
    call fuge_halfspace_matrix(scene%x, scene%y, spread(1.0_dp/real(maxval(cells), dp), 1, n), &
                               spread(1.0_dp/real(maxval(cells), dp), 1, n), 1.0_dp, FUGE_MEAN, scene%alpha, info)
    scene%body = 'half-space'
  end subroutine draw_halfspace

  !> The middles of cells around the origin.
  pure subroutine grid_positions(cells, spacing, x, y)
    integer, intent(in) :: cells(2)
    real(dp), intent(in) :: spacing(2)
    real(dp), allocatable, intent(out) :: x(:), y(:)
    integer :: i, j

    allocate (x(product(cells)), y(product(cells)))
    x = [((spacing(1)*(real(i, dp) - 0.5_dp*real(cells(1) + 1, dp)), i=1, cells(1)), j=1, cells(2))]
    y = [((spacing(2)*(real(j, dp) - 0.5_dp*real(cells(2) + 1, dp)), i=1, cells(1)), j=1, cells(2))]
  end subroutine grid_positions

  !> alpha falls exponentially with the distance; a short range is almost a bed of springs.
  subroutine draw_exponential(seed, scene)
    integer(int64), intent(inout) :: seed
    type(engine_scene), intent(inout) :: scene
    real(dp) :: fall
    integer :: j, n

    n = draw_size(seed)
    call draw_positions(seed, n, scene)
    fall = decimal(seed, -1.0_dp, 2.0_dp)
    allocate (scene%alpha(n, n))
    do j = 1, n
      scene%alpha(:, j) = exp(-fall*sqrt((scene%x - scene%x(j))**2 + (scene%y - scene%y(j))**2))
    end do
    scene%body = 'exponential'
  end subroutine draw_exponential

  !> Two bodies, the second one up to 1e6 times as soft as the first.
  subroutine draw_two_bodies(seed, scene)
    integer(int64), intent(inout) :: seed
    type(engine_scene), intent(inout) :: scene
    real(dp) :: softness
    integer :: i, n

    call draw_exponential(seed, scene)
    n = size(scene%x)
    softness = decimal(seed, 0.0_dp, 6.0_dp)
    do i = 1, n
      where (scene%part /= scene%part(i)) scene%alpha(:, i) = 0.0_dp
      if (scene%part(i) == 2) scene%alpha(:, i) = softness*scene%alpha(:, i)
    end do
    scene%body = 'two bodies'
  end subroutine draw_two_bodies

  !> Some points twice or more often: alpha is singular.
  subroutine draw_duplicates(seed, scene)
    integer(int64), intent(inout) :: seed
    type(engine_scene), intent(inout) :: scene
    integer, allocatable :: origin(:)
    integer :: k, n

    call draw_exponential(seed, scene)
    n = size(scene%x)
    allocate (origin(n))
    do k = 1, n
      origin(k) = k
      if (chance(seed, 0.3_dp)) origin(k) = origin(one_of(seed, k))
    end do
    scene%alpha = scene%alpha(origin, origin)
    scene%x = scene%x(origin)
    scene%y = scene%y(origin)
    scene%body = 'duplicates'
    scene%singular = .true.
  end subroutine draw_duplicates

  !> B B^T of a random rank.
  subroutine draw_low_rank(seed, scene)
    integer(int64), intent(inout) :: seed
    type(engine_scene), intent(inout) :: scene
    real(dp), allocatable :: b(:, :)
    integer :: k, n, rank

    n = draw_size(seed)
    call draw_positions(seed, n, scene)
    rank = one_of(seed, n)
    allocate (b(n, rank), scene%alpha(n, n))
    do k = 1, rank
      call draw(seed, b(:, k))
    end do
    b = b - 0.3_dp
    scene%alpha = matmul(b, transpose(b))
    scene%alpha = 0.5_dp*(scene%alpha + transpose(scene%alpha))/real(n, dp)
    scene%body = 'low rank'
    scene%singular = .true.
  end subroutine draw_low_rank

  !> Springs in a row that are fixed nowhere, whole numbers: equal forces displace nothing.
  subroutine draw_chain(seed, scene)
    integer(int64), intent(inout) :: seed
    type(engine_scene), intent(inout) :: scene
    real(dp) :: spring(1)
    integer :: k, n

    n = draw_size(seed)
    call draw_positions(seed, n, scene)
    allocate (scene%alpha(n, n))
    scene%alpha = 0.0_dp
    scene%x = [(real(k, dp)/real(n, dp) - 0.5_dp, k=1, n)]
    do k = 1, n - 1
      call integers(seed, 1, 9, spring)
      scene%alpha(k, k) = scene%alpha(k, k) + spring(1)
      scene%alpha(k + 1, k + 1) = scene%alpha(k + 1, k + 1) + spring(1)
      scene%alpha(k, k + 1) = -spring(1)
      scene%alpha(k + 1, k) = -spring(1)
    end do
    scene%body = 'free chain'
    scene%singular = .true.
  end subroutine draw_chain

  !> B B^T + n I in whole numbers: ties.
  subroutine draw_whole_numbers(seed, scene)
    integer(int64), intent(inout) :: seed
    type(engine_scene), intent(inout) :: scene
    real(dp), allocatable :: b(:, :)
    integer :: k, n

    n = min(draw_size(seed), 30)
    call draw_positions(seed, n, scene)
    call integers(seed, -4, 4, scene%x)
    call integers(seed, -4, 4, scene%y)
    allocate (b(n, n), scene%alpha(n, n))
    do k = 1, n
      call integers(seed, -2, 2, b(:, k))
    end do
    scene%alpha = matmul(b, transpose(b))
    do k = 1, n
      scene%alpha(k, k) = scene%alpha(k, k) + real(n, dp)
    end do
    scene%body = 'whole numbers'
  end subroutine draw_whole_numbers

  !> A half-plane by FFT.
  subroutine draw_halfplane_grid(seed, softness, scene)
    integer(int64), intent(inout) :: seed
    real(dp), intent(in) :: softness
    type(engine_scene), intent(inout) :: scene
    type(fuge_info) :: info
    integer :: boundary, element, n

    n = draw_size(seed)
    if (chance(seed, 0.2_dp)) n = MOST_POINTS + one_of(seed, MOST_IN_A_ROW - MOST_POINTS)
    boundary = merge(FUGE_FREE, FUGE_PERIODIC, chance(seed, 0.5_dp))
    element = merge(FUGE_CENTRE, FUGE_MEAN, chance(seed, 0.3_dp))
    call draw_positions(seed, n, scene)
    call grid_positions([n, 1], [1.0_dp/real(n, dp), 1.0_dp], scene%x, scene%y)
    scene%y = 4.0_dp*scene%x**2 - 0.3_dp
    allocate (fuge_halfplane_operator :: scene%operator)
    select type (operator => scene%operator)
    type is (fuge_halfplane_operator)
      call operator%set(n, 1.0_dp/real(n, dp), 1.0_dp/softness, info, element, boundary)
    end select
    scene%alpha = matrix_of(scene%operator)
    scene%singular = boundary == FUGE_PERIODIC
    scene%body = merge('half-plane FFT, free    ', 'half-plane FFT, periodic', boundary == FUGE_FREE)
  end subroutine draw_halfplane_grid

  !> A half-space by FFT.
  subroutine draw_halfspace_grid(seed, softness, scene)
    integer(int64), intent(inout) :: seed
    real(dp), intent(in) :: softness
    type(engine_scene), intent(inout) :: scene
    integer, parameter :: BOUNDARIES(4) = [FUGE_FREE, FUGE_PERIODIC, FUGE_PERIODIC_X, FUGE_PERIODIC_Y]
    character(len=24), parameter :: NAMES(4) = [character(len=24) :: 'half-space FFT, free', &
      'half-space FFT, periodic', 'half-space FFT, along x', 'half-space FFT, along y']
    type(fuge_info) :: info
    real(dp) :: spacing(2)
    integer :: cells(2), kind, most

    kind = one_of(seed, 4)
    most = merge(MOST_CELLS, 9, chance(seed, 0.03_dp))
    cells(1) = one_of(seed, most)
    cells(2) = one_of(seed, most)
    spacing = 1.0_dp/real(maxval(cells), dp)
    if (chance(seed, 0.3_dp)) spacing(2) = spacing(2)*uniform(seed, 0.3_dp, 3.0_dp)
    call draw_positions(seed, product(cells), scene)
    call grid_positions(cells, spacing, scene%x, scene%y)
    if (cells(2) == 1) scene%y = 4.0_dp*scene%x**2 - 0.3_dp
    allocate (fuge_halfspace_operator :: scene%operator)
    select type (operator => scene%operator)
    type is (fuge_halfspace_operator)
      call operator%set(cells(1), cells(2), spacing(1), spacing(2), 1.0_dp/softness, info, FUGE_MEAN, &
                        BOUNDARIES(kind))
    end select
    scene%alpha = matrix_of(scene%operator)
    scene%singular = BOUNDARIES(kind) == FUGE_PERIODIC
    scene%body = NAMES(kind)
  end subroutine draw_halfspace_grid

end module random_bodies
