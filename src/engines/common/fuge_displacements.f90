!> Displacements of the points by rigid motions and by contact forces.
!>
!> Elastic displacements are those of alpha less `datum`, the coefficient nearest to zero: a constant in all of alpha
!> that changes the translation only and, taken out first, costs no digits. Columns of points without force are not
!> read; the others are read four at a time, because the displacements would otherwise be loaded and stored for each.
module fuge_displacements
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgemv
  implicit none
  private

  public :: add_elastic_displacement, add_open_displacement, add_rough_product, displacement_terms, rigid_displacement

  !> Runs of points in contact, or open, that are shorter than this on average are not worth a loop each.
  integer, parameter :: SHORT_RUN = 16
  !> Runs of columns from this length on are left to BLAS, where rounding does not matter.
  integer, parameter :: LONG_RUN = 8

contains

  !> R q at each point, (n).
  pure function rigid_displacement(modes, motion) result(displacement)
    real(dp), intent(in), contiguous :: modes(:, :)
    real(dp), intent(in) :: motion(:)
    real(dp) :: displacement(size(modes, 1))
    integer :: j

    displacement = 0.0_dp
    do j = 1, size(motion)
      displacement = displacement + modes(:, j)*motion(j)
    end do
  end function rigid_displacement

  !> u := u + (alpha - datum) f, with the columns of the contact only.
  !>
  !> Not by BLAS: taking the datum out of each coefficient keeps the digits of the product.
  pure subroutine add_elastic_displacement(alpha, datum, contact, force, u)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum, force(:)
    logical, intent(in) :: contact(:)
    real(dp), intent(inout), contiguous :: u(:)

    call add_in_rows(alpha, datum, contact, force, 1, size(u), u)
  end subroutine add_elastic_displacement

  !> As `add_elastic_displacement`, but needed at open points only; what is added to u at points in contact is left
  !> undefined. Where the open points lie side by side, their rows alone are read.
  pure subroutine add_open_displacement(alpha, datum, contact, force, u)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum, force(:)
    logical, intent(in) :: contact(:)
    real(dp), intent(inout), contiguous :: u(:)
    integer :: first, last, n

    n = size(u)
    if (count(contact(2:) .neqv. contact(:n - 1))*SHORT_RUN > n) then
      call add_in_rows(alpha, datum, contact, force, 1, n, u)
      return
    end if
    last = 0
    do
      first = last + 1
      do while (first <= n)
        if (.not. contact(first)) exit
        first = first + 1
      end do
      if (first > n) exit
      last = first
      do while (last < n)
        if (contact(last + 1)) exit
        last = last + 1
      end do
      call add_in_rows(alpha, datum, contact, force, first, last, u)
    end do
  end subroutine add_open_displacement

  !> The rows `first` to `last` of `add_elastic_displacement`.
  pure subroutine add_in_rows(alpha, datum, contact, force, first, last, u)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum, force(:)
    logical, intent(in) :: contact(:)
    integer, intent(in) :: first, last
    real(dp), intent(inout), contiguous :: u(:)
    integer :: columns(4), j, waiting

    waiting = 0
    do j = 1, size(contact)
      if (.not. contact(j)) cycle
      if (.not. abs(force(j)) > 0.0_dp) cycle
      waiting = waiting + 1
      columns(waiting) = j
      if (waiting < 4) cycle
      call add_four(alpha(first:last, columns(1)), alpha(first:last, columns(2)), alpha(first:last, columns(3)), &
                    alpha(first:last, columns(4)), datum, force(columns), u(first:last))
      waiting = 0
    end do
    do j = 1, waiting
      call add_one(alpha(first:last, columns(j)), datum, force(columns(j)), u(first:last))
    end do
  end subroutine add_in_rows

  pure subroutine add_four(a, b, c, d, datum, force, u)
    real(dp), intent(in), contiguous :: a(:), b(:), c(:), d(:)
    real(dp), intent(in) :: datum, force(4)
    real(dp), intent(inout), contiguous :: u(:)
    integer :: i

    do i = 1, size(u)
      u(i) = u(i) + (((a(i) - datum)*force(1) + (b(i) - datum)*force(2)) &
                     + ((c(i) - datum)*force(3) + (d(i) - datum)*force(4)))
    end do
  end subroutine add_four

  pure subroutine add_one(a, datum, force, u)
    real(dp), intent(in), contiguous :: a(:)
    real(dp), intent(in) :: datum, force
    real(dp), intent(inout), contiguous :: u(:)
    integer :: i

    do i = 1, size(u)
      u(i) = u(i) + (a(i) - datum)*force
    end do
  end subroutine add_one

  !> sum_j |alpha_jk - datum| |f_j| over the contact, at point k: the size of the terms of its displacement, which may
  !> cancel.
  pure function displacement_terms(alpha, datum, contact, force, k) result(terms)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum, force(:)
    logical, intent(in) :: contact(:)
    integer, intent(in) :: k
    real(dp) :: terms
    integer :: j

    terms = 0.0_dp
    do j = 1, size(contact)
      if (contact(j)) terms = terms + abs((alpha(j, k) - datum)*force(j))
    end do
  end function displacement_terms

  !> u := u + factor alpha f, (n), for a guess: with the digits that BLAS leaves. Columns without force are not read.
  subroutine add_rough_product(alpha, factor, force, u)
    real(dp), intent(in), contiguous :: alpha(:, :), force(:)
    real(dp), intent(in) :: factor
    real(dp), intent(inout), contiguous :: u(:)
    real(dp) :: four(4)
    integer :: columns(4), first, last, n, waiting, j

    n = size(u)
    waiting = 0
    last = 0
    do
      first = last + 1
      do while (first <= n)
        if (abs(force(first)) > 0.0_dp) exit
        first = first + 1
      end do
      if (first > n) exit
      last = first
      do while (last < n)
        if (.not. abs(force(last + 1)) > 0.0_dp) exit
        last = last + 1
      end do
      if (last - first + 1 >= LONG_RUN) then
        call dgemv('N', n, last - first + 1, factor, alpha(:, first:last), size(alpha, 1), force(first:last), 1, &
                   1.0_dp, u, 1)
        cycle
      end if
      do j = first, last
        waiting = waiting + 1
        columns(waiting) = j
        if (waiting < 4) cycle
        four = factor*force(columns)
        call add_four(alpha(:n, columns(1)), alpha(:n, columns(2)), alpha(:n, columns(3)), alpha(:n, columns(4)), &
                      0.0_dp, four, u)
        waiting = 0
      end do
    end do
    do j = 1, waiting
      call add_one(alpha(:n, columns(j)), 0.0_dp, factor*force(columns(j)), u)
    end do
  end subroutine add_rough_product

end module fuge_displacements
