!> Which rigid motions of a body its contact points feel.
module fuge_contact_modes
  use fuge_body_type, only: fuge_body
  use fuge_contact_normals, only: moved, softness
  use fuge_kinds, only: dp
  use fuge_pivoted_qr, only: combine_independent, factorise_pivoted, numerical_rank
  use fuge_status, only: fuge_info, report, FUGE_ERR_NO_EQUILIBRIUM
  use fuge_number_text, only: text
  implicit none
  private

  public :: split_motions, modes_of_points, work_of_load, check_sliding

  !> Motions of the contact points below this fraction of the body's are none, and so are
  !> loads that drive them.
  real(dp), parameter :: STILL = 1.0e-8_dp
  !> Relative error of motions that are exact but for rounding.
  real(dp), parameter, public :: ROUNDED = 1.0e3_dp*epsilon(1.0_dp)

contains

  !> Which motions the contact points feel, one independent of the other; of the rest
  !> `sliding` is made, those parts that move no contact point. Pivoted QR factors of the
  !> motions of the contact points, scaled: R P = Q (R_1 R_2).
  !>
  !> `motions` (degrees, m) move the body, `modes` (n, m) its contact points; `scale` of
  !> the degrees of freedom and `soft` of the points make both free of units.
  !> `error` is the relative one of the motions; `sliding` (degrees, m - count(felt)).
  !> `stat` is not zero without memory.
  subroutine split_motions(motions, modes, scale, soft, error, felt, sliding, stat)
    real(dp), intent(in) :: motions(:, :), modes(:, :), scale(:), soft(:), error
    logical, intent(out) :: felt(:)
    real(dp), allocatable, intent(out) :: sliding(:, :)
    integer, intent(out) :: stat
    real(dp), allocatable :: r(:, :), mix(:, :)
    real(dp) :: unit(size(felt)), tau(size(felt))
    integer :: order(size(felt)), i, k, m, n, rank

    m = size(felt)
    n = size(modes, 1)
    felt = .true.
    allocate (r(n, m), stat=stat)
    if (stat == 0 .and. m < 1) allocate (sliding(size(scale), 0), stat=stat)
    if (stat /= 0 .or. m < 1) return
    do k = 1, m
      unit(k) = maxval(abs(motions(:, k))*scale)
      r(:, k) = modes(:, k)/(unit(k)*soft)
    end do
    call factorise_pivoted(r, tau, order, stat)
    if (stat /= 0) return
    rank = numerical_rank(r, 0.0_dp, max(STILL, error))
    felt(order(rank + 1:)) = .false.
    allocate (mix(rank, m - rank), sliding(size(scale), m - rank), stat=stat)
    if (stat /= 0) return
    ! z_k - z_1 R_1^-1 R_2 for each motion k beyond the rank.
    call combine_independent(r, rank, mix)
    do k = 1, m - rank
      sliding(:, k) = motions(:, order(rank + k))/unit(order(rank + k))
      do i = 1, rank
        sliding(:, k) = sliding(:, k) - motions(:, order(i))*(mix(i, k)/unit(order(i)))
      end do
    end do
  end subroutine split_motions

  !> R = -N^T Z, `modes` (n, m). A point that a motion does not move gets a true zero, not
  !> the rounding of one: along that a solver would go far. `stat` is not zero without memory.
  subroutine modes_of_points(body, motions, scale, error, modes, stat)
    type(fuge_body), intent(in) :: body
    real(dp), intent(in) :: motions(:, :), scale(:), error
    real(dp), allocatable, intent(out) :: modes(:, :)
    integer, intent(out) :: stat
    real(dp) :: soft(size(body%dof, 2)), largest
    integer :: i, j

    allocate (modes(size(body%dof, 2), size(motions, 2)), stat=stat)
    if (stat /= 0) return
    soft = softness(body, scale)
    do j = 1, size(motions, 2)
      largest = maxval(abs(motions(:, j))*scale)
      do i = 1, size(soft)
        modes(i, j) = -moved(body%dof(:, i), body%normal(:, i), motions(:, j))
        if (abs(modes(i, j)) <= error*largest*soft(i)) modes(i, j) = 0.0_dp
      end do
    end do
  end subroutine modes_of_points

  !> w = Z^T p, (m); zero where only error is left of parts that cancel, because contact
  !> could not hold that if it points the wrong way.
  pure function work_of_load(motions, load, scale, error) result(work)
    real(dp), intent(in) :: motions(:, :), load(:), scale(:), error
    real(dp) :: work(size(motions, 2))
    integer :: j

    do j = 1, size(work)
      work(j) = dot_product(motions(:, j), load)
      if (abs(work(j)) <= error_of_work(motions(:, j), load, scale, error)) work(j) = 0.0_dp
    end do
  end function work_of_load

  !> The work of all forces in an error of the motion relative to its largest way. The sum
  !> of the products alone would not do: across the motion it is error itself.
  pure function error_of_work(motion, load, scale, error) result(work)
    real(dp), intent(in) :: motion(:), load(:), scale(:), error
    real(dp) :: work, forces
    integer :: i

    forces = 0.0_dp
    do i = 1, size(load)
      if (scale(i) > 0.0_dp) forces = forces + abs(load(i))/scale(i)
    end do
    work = error*maxval(abs(motion)*scale)*forces
  end function error_of_work

  !> Refuse a load that drives one of the motions `sliding`, which no contact can hold
  !> (FUGE_ERR_NO_EQUILIBRIUM).
  pure subroutine check_sliding(sliding, load, scale, error, info)
    real(dp), intent(in), allocatable :: sliding(:, :)
    real(dp), intent(in) :: load(:), scale(:), error
    type(fuge_info), intent(inout) :: info
    integer :: j, k

    if (.not. allocated(sliding)) return
    do k = 1, size(sliding, 2)
      if (abs(dot_product(sliding(:, k), load)) <= STILL*sum(abs(sliding(:, k)*load)) &
          + error_of_work(sliding(:, k), load, scale, error)) cycle
      j = maxloc(abs(sliding(:, k))*scale, 1)
      call report(info, FUGE_ERR_NO_EQUILIBRIUM, 'the load drives a rigid motion that moves no contact point and ' &
                  //'most of all degree of freedom '//text(j)//': no contact force can hold it; fix one, or ' &
                  //'balance the load')
      return
    end do
  end subroutine check_sliding

end module fuge_contact_modes
