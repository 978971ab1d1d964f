!> Is alpha positive definite on the forces with zero sum? Then the answer is unique
!> (paper, section 4).
module fuge_definiteness
  use fuge_kinds, only: dp
  use fuge_lapack, only: dpotrf
  use fuge_status, only: FUGE_DONE, FUGE_ERR_MEMORY
  implicit none
  private

  public :: check_definite

contains

  !> `deficient` is 0, or a point that breaks it together with others.
  !>
  !> With the force at point r as minus the sum of the others the form is that of
  !> alpha_ij - alpha_ir - alpha_rj + alpha_rr, i, j /= r: its Cholesky factor exists
  !> or not, whatever the datum of alpha. A pivot that may be rounding counts as zero.
  !> r is the stiffest point, which keeps the coefficients of the others.
  !> `alpha` at least n rows, n columns. Error: FUGE_ERR_MEMORY.
  subroutine check_definite(alpha, deficient, status)
    real(dp), intent(in) :: alpha(:, :)
    integer, intent(out) :: deficient, status
    real(dp), allocatable :: form(:, :), energy(:)
    integer, allocatable :: others(:)
    integer :: n, r, j, last, stat, info

    n = size(alpha, 2)
    deficient = 0
    allocate (form(n - 1, n - 1), energy(n - 1), others(n - 1), stat=stat)
    status = merge(FUGE_DONE, FUGE_ERR_MEMORY, stat == 0)
    if (stat /= 0 .or. n == 1) return
    r = minloc([(alpha(j, j), j=1, n)], dim=1)
    others = pack([(j, j=1, n)], [(j /= r, j=1, n)])
    do j = 1, n - 1
      form(:, j) = (alpha(others, others(j)) - alpha(r, others(j))) - (alpha(others, r) - alpha(r, r))
      energy(j) = form(j, j)
    end do
    call dpotrf('L', n - 1, form, n - 1, info)
    last = n - 1
    if (info > 0) then
      deficient = others(info)
      last = info - 1
    end if
    do j = 1, last
      if (form(j, j)**2 > real(n, dp)*epsilon(energy)*energy(j)) cycle
      deficient = others(j)
      exit
    end do
  end subroutine check_definite

end module fuge_definiteness
