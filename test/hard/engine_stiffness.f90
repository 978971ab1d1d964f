!> How stiff the body of a scene is where forces act, and how well its contact resists rigid motions: what two answers
!> can be equal to.
module engine_stiffness
  use engine_scene_type, only: engine_scene
  use fuge_kinds, only: dp
  use fuge_problem_type, only: fuge_problem
  use general_reference, only: is_excluded, is_prescribed, modes_of, play_of
  implicit none
  private

  public :: find_stiffness, leverage_of

  interface
    subroutine dsyev(jobz, uplo, n, a, lda, w, work, lwork, info)
      import :: dp
      character, intent(in) :: jobz, uplo
      integer, intent(in) :: n, lda, lwork
      real(dp), intent(inout) :: a(lda, *)
      real(dp), intent(out) :: w(*), work(*)
      integer, intent(out) :: info
    end subroutine dsyev
  end interface

contains

  !> The least and the largest energy, `extremes`, of forces of size 1 that have no resultant, at the points marked; the
  !> resultant is taken out of the forces `phi` (n). Without such forces both are 1 and `phi` is zero.
  subroutine find_stiffness(scene, carries, phi, extremes)
    type(engine_scene), intent(in) :: scene
    logical, intent(in) :: carries(:)
    real(dp), intent(inout) :: phi(:)
    real(dp), intent(out) :: extremes(2)
    real(dp) :: block(count(carries), count(carries)), energy(count(carries)), work(4*count(carries) + 4), scale
    real(dp), allocatable :: basis(:, :), rows(:, :)
    integer, allocatable :: points(:)
    integer :: info, k, n, rank

    extremes = 1.0_dp
    n = count(carries)
    if (n < 1) return
    allocate (points, source=pack([(k, k=1, size(carries))], carries))
    block = scene%alpha(points, points)
    allocate (rows, source=free_modes(scene%problem))
    call orthonormal_columns(rows(points, :), basis, rank)
    phi(points) = phi(points) - matmul(basis(:, :rank), matmul(phi(points), basis(:, :rank)))
    if (rank >= n) phi = 0.0_dp
    scale = maxval(abs(block))
    if (rank >= n .or. .not. scale > 0.0_dp) return
    block = block/scale
    call project_out(basis(:, :rank), block)
    call dsyev('N', 'U', n, block, n, energy, work, size(work), info)
    ! The projection leaves `rank` eigenvalues that are rounding around a number above all others, see project_out.
    extremes = scale*[energy(1), energy(n - rank)]
  end subroutine find_stiffness

  !> (1 - B B^T) block (1 - B B^T) + large B B^T for orthonormal columns B.
  pure subroutine project_out(basis, block)
    real(dp), intent(in) :: basis(:, :)
    real(dp), intent(inout) :: block(:, :)
    real(dp) :: large
    integer :: j

    large = 2.0_dp*real(size(block, 1), dp)
    block = block - matmul(basis, matmul(transpose(basis), block))
    block = block - matmul(matmul(block, basis), transpose(basis))
    do j = 1, size(basis, 2)
      block = block + large*spread(basis(:, j), 2, size(block, 1))*spread(basis(:, j), 1, size(block, 1))
    end do
  end subroutine project_out

  !> An orthonormal basis of the columns, `rank` of them, by Gram-Schmidt, twice.
  pure subroutine orthonormal_columns(columns, basis, rank)
    real(dp), intent(in) :: columns(:, :)
    real(dp), allocatable, intent(out) :: basis(:, :)
    integer, intent(out) :: rank
    real(dp) :: v(size(columns, 1)), before
    integer :: j, pass

    allocate (basis(size(columns, 1), size(columns, 2)))
    basis = 0.0_dp
    rank = 0
    do j = 1, size(columns, 2)
      v = columns(:, j)
      if (.not. maxval(abs(v)) > 0.0_dp) cycle
      v = v/norm2(v)
      before = 1.0_dp
      do pass = 1, 2
        v = v - matmul(basis(:, :rank), matmul(transpose(basis(:, :rank)), v))
        if (pass == 1) before = norm2(v)
        if (.not. norm2(v) > 0.0_dp) exit
        v = v/norm2(v)
      end do
      if (before < 1.0e-11_dp) cycle
      rank = rank + 1
      basis(:, rank) = v
    end do
  end subroutine orthonormal_columns

  !> The columns of R whose motion is free.
  function free_modes(problem) result(modes)
    type(fuge_problem), intent(in) :: problem
    real(dp), allocatable :: modes(:, :)
    real(dp) :: all_modes(problem%points(), problem%mode_count())
    integer :: j

    all_modes = modes_of(problem)
    modes = all_modes(:, pack([(j, j=1, size(all_modes, 2))], &
                              [(.not. is_prescribed(problem, j), j=1, size(all_modes, 2))]))
  end function free_modes

  !> How much the motions of the points marked move any point at most: sum_k |R R_c^+|, large if they do not resist.
  function leverage_of(problem, carries) result(leverage)
    type(fuge_problem), intent(in) :: problem
    logical, intent(in) :: carries(:)
    real(dp) :: leverage
    real(dp), allocatable :: basis(:, :), rows(:, :), modes(:, :), gram(:, :)
    real(dp) :: work(64), energy(8)
    integer :: info, k, m, rank
    logical :: holds(size(carries))

    leverage = 0.0_dp
    allocate (modes, source=free_modes(problem))
    holds = carries
    do k = 1, size(holds)
      if (.not. play_of(problem, k) > 0.0_dp .and. .not. is_excluded(problem, k)) holds(k) = .true.
    end do
    if (size(modes, 2) < 1) return
    call orthonormal_columns(modes, basis, rank)
    m = rank
    allocate (rows, source=basis(pack([(k, k=1, size(holds))], holds), :m))
    allocate (gram, source=matmul(transpose(rows), rows))
    call dsyev('N', 'U', m, gram, m, energy, work, size(work), info)
    leverage = sqrt(real(size(rows, 1), dp))/sqrt(max(energy(1), tiny(1.0_dp)))
  end function leverage_of

end module engine_stiffness
