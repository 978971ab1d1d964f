!> Can the contact forces carry the resultant at all?
!>
!> Forces f with R^T f = w, not negative at one-sided points, are the point of a cone:
!> found by non-negative least squares (C. L. Lawson, R. J. Hanson, Solving Least Squares
!> Problems, 1974, chapter 23), with at most as many points as there are motions. Where
!> there is none, what remains of w proves it (Farkas): a motion along which no point
!> closes, but the resultant does work.
module fuge_equilibrium
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgelsy
  implicit none
  private

  public :: find_equilibrium

  !> What remains of the resultant below this part of it is rounding.
  real(dp), parameter :: ROUNDING = 1.0e-11_dp
  !> A point that closes by less than this part of what the motions move it does not.
  real(dp), parameter :: PROOF = 1.0e-10_dp
  !> Two points whose columns agree to this in all motions are one.
  real(dp), parameter :: DEPENDENT = 1.0e-13_dp

contains

  !> Forces in equilibrium with the resultant, at few points.
  !>
  !> `modes` (n, m) with columns of about the same size, `resultant` (m), `pushes` (n)
  !> points whose force may be positive, `pulls` (n) negative. Out: `force` (n);
  !> `remainder` (m), zero if there are such forces, otherwise the motion above.
  subroutine find_equilibrium(modes, resultant, pushes, pulls, force, remainder)
    real(dp), intent(in) :: modes(:, :), resultant(:)
    logical, intent(in) :: pushes(:), pulls(:)
    real(dp), intent(out) :: force(:), remainder(:)
    real(dp) :: wanted(size(force)), work(size(force))
    integer :: state(size(force)), newest, iteration

    force = 0.0_dp
    state = 0
    remainder = resultant
    do iteration = 1, 20*(size(modes, 2) + 1) + size(force)
      if (is_met(modes, resultant, force, remainder)) exit
      work = matmul(modes, remainder)
      where (.not. pulls) work = max(work, 0.0_dp)
      where (.not. pushes) work = min(work, 0.0_dp)
      where (state /= 0) work = 0.0_dp
      newest = maxloc(abs(work), dim=1)
      if (abs(work(newest)) <= ROUNDING*maxval(abs(remainder))*sum(abs(modes(newest, :)))) then
        if (proves(modes, resultant, pushes, pulls, remainder)) return
        exit
      end if
      state(newest) = merge(1, -1, work(newest) > 0.0_dp)
      call settle(modes, resultant, state, force, wanted)
      remainder = resultant - matmul(force, modes)
    end do
    ! Met, or not decided: then the certificate has the last word.
    remainder = 0.0_dp
  end subroutine find_equilibrium

  !> Is nothing left of each resultant but rounding of it and of the terms that make it?
  pure function is_met(modes, resultant, force, remainder) result(met)
    real(dp), intent(in) :: modes(:, :), resultant(:), force(:), remainder(:)
    logical :: met
    integer :: j

    met = .true.
    do j = 1, size(resultant)
      met = met .and. abs(remainder(j)) <= max(ROUNDING*max(abs(resultant(j)), sum(abs(modes(:, j)*force))), &
                                               64.0_dp*epsilon(1.0_dp)*maxval(abs(resultant)))
    end do
  end function is_met

  !> Does no point close along the motion, while the resultants do work?
  pure function proves(modes, resultant, pushes, pulls, motion)
    real(dp), intent(in) :: modes(:, :), resultant(:), motion(:)
    logical, intent(in) :: pushes(:), pulls(:)
    logical :: proves
    real(dp) :: closing, noise
    integer :: k

    ! The motion is a difference of resultants and carries their rounding.
    noise = max(PROOF*maxval(abs(motion)), 64.0_dp*epsilon(noise)*maxval(abs(resultant)))
    proves = dot_product(motion, resultant) > 0.0_dp
    do k = 1, size(modes, 1)
      closing = dot_product(modes(k, :), motion)
      if (abs(closing) <= noise*sum(abs(modes(k, :)))) cycle
      if (pushes(k) .and. closing > 0.0_dp) proves = .false.
      if (pulls(k) .and. closing < 0.0_dp) proves = .false.
    end do
  end function proves

  !> Forces of least squares at the points in use, of which those leave that would change
  !> their sign, the first one first.
  subroutine settle(modes, resultant, state, force, wanted)
    real(dp), intent(in) :: modes(:, :), resultant(:)
    integer, intent(inout) :: state(:)
    real(dp), intent(inout) :: force(:)
    real(dp), intent(out) :: wanted(:)
    real(dp) :: way
    integer :: blocking

    do
      call solve_on(modes, resultant, state, wanted)
      call find_blocking(force, wanted, state, way, blocking)
      if (blocking == 0) exit
      force = force + way*(wanted - force)
      ! One leaves in each turn, so that this ends.
      state(blocking) = 0
      force(blocking) = 0.0_dp
    end do
    force = wanted
  end subroutine settle

  !> Least squares forces at the points in use.
  subroutine solve_on(modes, resultant, state, force)
    real(dp), intent(in) :: modes(:, :), resultant(:)
    integer, intent(in) :: state(:)
    real(dp), intent(out) :: force(:)
    real(dp) :: matrix(size(modes, 2), count(state /= 0)), right(max(size(modes, 2), count(state /= 0)))
    real(dp) :: work(64*(size(modes, 2) + count(state /= 0)) + 64)
    integer :: points(count(state /= 0)), order(count(state /= 0)), k, p, m, rank, info

    m = size(modes, 2)
    points = pack([(k, k=1, size(state))], state /= 0)
    p = size(points)
    matrix = transpose(modes(points, :))
    right = 0.0_dp
    right(:m) = resultant
    order = 0
    call dgelsy(m, p, 1, matrix, m, right, size(right), order, DEPENDENT, rank, work, size(work), info)
    force = 0.0_dp
    force(points) = right(:p)
  end subroutine solve_on

  !> The part of the way to the wanted forces until the first changes its sign, and which;
  !> 0 if none does.
  pure subroutine find_blocking(force, wanted, state, way, blocking)
    real(dp), intent(in) :: force(:), wanted(:)
    integer, intent(in) :: state(:)
    real(dp), intent(out) :: way
    integer, intent(out) :: blocking
    real(dp) :: part
    integer :: k

    way = 1.0_dp
    blocking = 0
    do k = 1, size(force)
      if (state(k) == 0 .or. wanted(k)*state(k) > 0.0_dp) cycle
      part = 0.0_dp
      if (abs(force(k) - wanted(k)) > 0.0_dp) part = min(max(force(k)/(force(k) - wanted(k)), 0.0_dp), 1.0_dp)
      if (blocking > 0 .and. part >= way) cycle
      way = part
      blocking = k
    end do
  end subroutine find_blocking

end module fuge_equilibrium
