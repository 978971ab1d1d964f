!> Which rigid motions of a body its contact points feel.
module fuge_felt_motions
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgeqp3
  implicit none
  private

  public :: split_motions

contains

  !> Which motions the contact points feel, one independent of the other; of the rest
  !> `sliding` is made, those parts that move no contact point. Pivoted QR factors of the
  !> motions of the contact points, scaled: R P = Q (R_1 R_2).
  !>
  !> `motions` (degrees, m) move the body, `modes` (n, m) its contact points; `scale` of the
  !> degrees of freedom and `softness` of the points make both free of units.
  !> A motion of the points below `still` of the body's is none.
  !> `sliding` (degrees, m - count(felt)). `stat` is not zero without memory.
  subroutine split_motions(motions, modes, scale, softness, still, felt, sliding, stat)
    real(dp), intent(in) :: motions(:, :), modes(:, :), scale(:), softness(:), still
    logical, intent(out) :: felt(:)
    real(dp), allocatable, intent(out) :: sliding(:, :)
    integer, intent(out) :: stat
    real(dp), allocatable :: r(:, :), work(:)
    real(dp) :: unit(size(felt)), tau(size(felt)), mix(size(felt), size(felt))
    integer :: order(size(felt)), i, k, m, n, rank

    m = size(felt)
    n = size(modes, 1)
    felt = .true.
    allocate (r(n, m), work(64*(m + 1)), stat=stat)
    if (stat == 0 .and. m < 1) allocate (sliding(size(scale), 0), stat=stat)
    if (stat /= 0 .or. m < 1) return
    do k = 1, m
      unit(k) = maxval(abs(motions(:, k))*scale)
      r(:, k) = modes(:, k)/(unit(k)*softness)
    end do
    order = 0
    call dgeqp3(n, m, r, n, order, tau, work, size(work), stat)
    rank = 0
    do k = 1, min(m, n)
      if (abs(r(k, k)) > still) rank = k
    end do
    felt(order(rank + 1:)) = .false.
    ! z_k - z_1 R_1^-1 R_2 for each motion k beyond the rank.
    mix = 0.0_dp
    do k = rank + 1, m
      mix(:rank, k) = r(:rank, k)
      do i = rank, 1, -1
        mix(i, k) = mix(i, k)/r(i, i)
        mix(:i - 1, k) = mix(:i - 1, k) - r(:i - 1, i)*mix(i, k)
      end do
    end do
    allocate (sliding(size(scale), m - rank), stat=stat)
    if (stat /= 0) return
    do k = rank + 1, m
      sliding(:, k - rank) = motions(:, order(k))/unit(order(k))
      do i = 1, rank
        sliding(:, k - rank) = sliding(:, k - rank) - motions(:, order(i))*(mix(i, k)/unit(order(i)))
      end do
    end do
  end subroutine split_motions

end module fuge_felt_motions
