!> The products of `fuge_dense_operator`, in rows that threads share.
submodule(fuge_matrix_operator) fuge_matrix_products
  use fuge_threads, only: run_in_parts, share, threads_here, work_in_parts
  implicit none

  !> Threads share a product with more coefficients than this, in groups of ROWS rows.
  real(dp), parameter :: SHARED = 2.0_dp**17
  integer, parameter :: ROWS = 16

  !> A product, of which each part has some rows; `magnitude` is associated if it is wanted too.
  type, extends(work_in_parts) :: product_in_rows
    real(dp), pointer, contiguous :: alpha(:, :) => null()
    real(dp), pointer :: force(:) => null(), displacement(:) => null(), magnitude(:) => null()
    real(dp) :: datum = 0.0_dp
  contains
    procedure :: do_part => multiply_part
  end type product_in_rows

contains

  module procedure apply
    call multiply(self, force, displacement)
    status = FUGE_DONE
    ! Coefficients are finite, so forces are too large for them.
    if (.not. all(ieee_is_finite(displacement)) .and. all(ieee_is_finite(force))) status = FUGE_ERR_OVERFLOW
  end procedure apply

  !> The displacements by forces, and their magnitudes; threads share the rows if there are many.
  subroutine multiply(self, force, displacement, magnitude)
    class(fuge_dense_operator), intent(in) :: self
    real(dp), intent(in), target :: force(:)
    real(dp), intent(inout), target :: displacement(:)
    real(dp), intent(inout), target, optional :: magnitude(:)
    type(product_in_rows) :: work
    integer :: parts

    work%alpha => self%alpha
    work%datum = self%datum()
    work%force => force
    work%displacement => displacement
    if (present(magnitude)) work%magnitude => magnitude
    parts = 1
    if (real(size(force), dp)*real(size(force), dp) > SHARED) then
      if (real(size(force), dp)*real(count(abs(force) > 0.0_dp), dp) > SHARED) parts = threads_here()
    end if
    call run_in_parts(parts, work)
  end subroutine multiply

  !> The rows of one part.
  subroutine multiply_part(self, part, parts)
    class(product_in_rows), intent(inout) :: self
    integer, intent(in) :: part, parts
    integer :: first, last, n

    n = size(self%force)
    call share((n + ROWS - 1)/ROWS, part, parts, first, last)
    first = ROWS*first + 1
    last = min(ROWS*(last + 1), n)
    if (first > last) return
    if (associated(self%magnitude)) then
      call add_rows_and_terms(self%alpha, self%datum, self%force, first, last, self%displacement(first:last), &
                              self%magnitude(first:last))
    else
      call add_rows(self%alpha, self%datum, self%force, first, last, self%displacement(first:last))
    end if
  end subroutine multiply_part

  !> The `displacement` at the points `first` to `last`.
  pure subroutine add_rows(alpha, datum, force, first, last, displacement)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum, force(:)
    integer, intent(in) :: first, last
    real(dp), intent(out) :: displacement(:)
    integer :: columns(4), j, waiting

    displacement = 0.0_dp
    waiting = 0
    do j = 1, size(force)
      if (.not. abs(force(j)) > 0.0_dp) cycle
      waiting = waiting + 1
      columns(waiting) = j
      if (waiting < 4) cycle
      call add_four(alpha(first:last, columns(1)), alpha(first:last, columns(2)), alpha(first:last, columns(3)), &
                    alpha(first:last, columns(4)), datum, force(columns), displacement)
      waiting = 0
    end do
    do j = 1, waiting
      displacement = displacement + (alpha(first:last, columns(j)) - datum)*force(columns(j))
    end do
  end subroutine add_rows

  !> As `add_rows`, with the magnitudes, two columns at a time.
  pure subroutine add_rows_and_terms(alpha, datum, force, first, last, displacement, magnitude)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum, force(:)
    integer, intent(in) :: first, last
    real(dp), intent(out) :: displacement(:), magnitude(:)
    integer :: j, waiting

    displacement = 0.0_dp
    magnitude = 0.0_dp
    waiting = 0
    do j = 1, size(force)
      if (.not. abs(force(j)) > 0.0_dp) cycle
      if (waiting > 0) then
        call add_two(alpha(first:last, waiting), alpha(first:last, j), datum, force(waiting), force(j), displacement, &
                     magnitude)
        waiting = 0
      else
        waiting = j
      end if
    end do
    if (waiting > 0) then
      displacement = displacement + (alpha(first:last, waiting) - datum)*force(waiting)
      magnitude = magnitude + abs((alpha(first:last, waiting) - datum)*force(waiting))
    end if
  end subroutine add_rows_and_terms

  !> Add the terms of four columns to displacements.
  pure subroutine add_four(a, b, c, d, datum, force, displacement)
    real(dp), intent(in), contiguous :: a(:), b(:), c(:), d(:)
    real(dp), intent(in) :: datum, force(4)
    real(dp), intent(inout) :: displacement(:)
    integer :: i

    do i = 1, size(a)
      displacement(i) = displacement(i) + (((a(i) - datum)*force(1) + (b(i) - datum)*force(2)) &
                                           + ((c(i) - datum)*force(3) + (d(i) - datum)*force(4)))
    end do
  end subroutine add_four

  module procedure dense_apply_with_magnitude
    call multiply(self, force, displacement, magnitude)
    status = FUGE_DONE
  end procedure dense_apply_with_magnitude

  !> Add the terms of two columns to displacements and magnitudes.
  pure subroutine add_two(a, b, datum, force_a, force_b, displacement, magnitude)
    real(dp), intent(in), contiguous :: a(:), b(:)
    real(dp), intent(in) :: datum, force_a, force_b
    real(dp), intent(inout) :: displacement(:), magnitude(:)
    real(dp) :: term_a, term_b
    integer :: i

    do i = 1, size(a)
      term_a = (a(i) - datum)*force_a
      term_b = (b(i) - datum)*force_b
      displacement(i) = displacement(i) + (term_a + term_b)
      magnitude(i) = magnitude(i) + (abs(term_a) + abs(term_b))
    end do
  end subroutine add_two

end submodule fuge_matrix_products
