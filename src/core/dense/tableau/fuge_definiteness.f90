!> Whether alpha is positive definite on the forces without resultant, so that the solution is unique (paper, section 4,
!> for one mode: forces with zero sum).
module fuge_definiteness
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgesv, dpotrf
  use fuge_status, only: FUGE_DONE, FUGE_ERR_MEMORY
  implicit none
  private

  public :: check_definite

  !> A reference point is independent enough if at least this fraction of its row of the modes remains after projection
  !> onto those of the others.
  real(dp), parameter :: INDEPENDENT = 0.3_dp

contains

  !> `deficient` is 0, or a point that breaks definiteness together with others.
  !>
  !> The forces at m reference points r follow from those at the others o: f_r = -T^T f_o, T = R_o R_r^-1. The
  !> quadratic form in f_o is A_oo - T A_ro - (A_or - T A_rr) T^T, which has a Cholesky factor or not whatever the
  !> datum of alpha. A pivot that may be rounding counts as zero. The references are the stiffest points that are
  !> independent, which keeps the coefficients of the others. `alpha` at least n rows, n columns; `datum` a constant
  !> to take out of it; `modes` (n, m) of full rank on the points not `excluded` (n). `status`: FUGE_DONE or
  !> FUGE_ERR_MEMORY.
  subroutine check_definite(alpha, datum, modes, excluded, deficient, status)
    real(dp), intent(in) :: alpha(:, :), datum, modes(:, :)
    logical, intent(in) :: excluded(:)
    integer, intent(out) :: deficient, status
    real(dp), allocatable :: form(:, :), energy(:), transfer(:, :)
    logical :: other(size(excluded))
    integer, allocatable :: others(:), references(:)
    integer :: n, m, j, k, last, stat, info

    m = size(modes, 2)
    n = count(.not. excluded) - m
    deficient = 0
    status = FUGE_DONE
    if (n < 1) return
    allocate (form(n, n), energy(n), transfer(m, n), stat=stat)
    status = merge(FUGE_DONE, FUGE_ERR_MEMORY, stat == 0)
    if (stat /= 0) return
    call choose_references(alpha, modes, excluded, references)
    other = .not. excluded
    other(references) = .false.
    others = pack([(j, j=1, size(other))], other)
    call find_transfer(modes, references, others, transfer)
    do j = 1, n
      form(:, j) = alpha(others, others(j)) - datum
      do k = 1, m
        form(:, j) = form(:, j) - transfer(k, :)*(alpha(references(k), others(j)) - datum)
      end do
    end do
    call eliminate_references(alpha, datum, references, others, transfer, form)
    energy = [(form(j, j), j=1, n)]
    call dpotrf('L', n, form, n, info)
    last = n
    if (info > 0) then
      deficient = others(info)
      last = info - 1
    end if
    do j = 1, last
      if (form(j, j)**2 > real(n + m, dp)*epsilon(energy)*energy(j)) cycle
      deficient = others(j)
      exit
    end do
  end subroutine check_definite

  !> Subtract (A_or - T A_rr) T^T from the form.
  pure subroutine eliminate_references(alpha, datum, references, others, transfer, form)
    real(dp), intent(in) :: alpha(:, :), datum, transfer(:, :)
    integer, intent(in) :: references(:), others(:)
    real(dp), intent(inout) :: form(:, :)
    real(dp) :: column(size(others))
    integer :: j, k, l

    do k = 1, size(references)
      column = alpha(others, references(k)) - datum
      do l = 1, size(references)
        column = column - transfer(l, :)*(alpha(references(l), references(k)) - datum)
      end do
      do j = 1, size(others)
        form(:, j) = form(:, j) - column*transfer(k, j)
      end do
    end do
  end subroutine eliminate_references

  !> The stiffest points whose rows of the modes are far from dependent.
  pure subroutine choose_references(alpha, modes, excluded, references)
    real(dp), intent(in) :: alpha(:, :), modes(:, :)
    logical, intent(in) :: excluded(:)
    integer, allocatable, intent(out) :: references(:)
    real(dp) :: rest(size(modes, 1), size(modes, 2)), length(size(modes, 1)), own(size(modes, 1)), unit(size(modes, 2))
    integer :: j, k

    own = [(alpha(j, j), j=1, size(own))]
    rest = modes
    allocate (references(size(modes, 2)))
    do k = 1, size(references)
      length = merge(-1.0_dp, norm2(rest, dim=2), excluded)
      references(k) = minloc(own, dim=1, mask=length >= INDEPENDENT*maxval(length))
      unit = rest(references(k), :)/length(references(k))
      do j = 1, size(own)
        rest(j, :) = rest(j, :) - dot_product(rest(j, :), unit)*unit
      end do
    end do
  end subroutine choose_references

  !> T^T = R_r^-T R_o^T, (m, n).
  subroutine find_transfer(modes, references, others, transfer)
    real(dp), intent(in) :: modes(:, :)
    integer, intent(in) :: references(:), others(:)
    real(dp), intent(out), contiguous :: transfer(:, :)
    real(dp) :: matrix(size(references), size(references))
    integer :: pivots(size(references)), info

    if (size(references) < 1) return
    matrix = transpose(modes(references, :))
    transfer = transpose(modes(others, :))
    call dgesv(size(references), size(others), matrix, size(references), pivots, transfer, size(references), info)
  end subroutine find_transfer

end module fuge_definiteness
