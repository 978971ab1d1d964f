!> A stiffness matrix in LAPACK's symmetric band storage. The stiffness refers to the caller's
!> array; only the factorisation makes a copy.
module fuge_stiffness_band
  use, intrinsic :: iso_c_binding, only: c_loc, c_f_pointer
  use fuge_kinds, only: dp
  use fuge_lapack, only: dpbtrf, dpbtrs
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_SIZE, FUGE_ERR_POINTER, FUGE_ERR_MEMORY
  use fuge_stiffness_check, only: check_entries
  use fuge_stiffness_type, only: fuge_stiffness, stiffness_factor
  implicit none
  private

  !> A stiffness matrix in LAPACK's symmetric band storage: `set` it, then condense.
  type, extends(fuge_stiffness), public :: fuge_band_stiffness
    private
    !> Columns of the caller's band; rows beyond width + 1 are padding.
    real(dp), pointer, contiguous :: band(:, :) => null()
    !> Number of diagonals above or below the main one.
    integer :: width = 0
    !> The upper triangle is stored; otherwise the lower one.
    logical :: upper = .true.
  contains
    procedure, public :: set
    procedure, public :: degrees
    procedure, public :: diagonal
    procedure, public :: multiply
    procedure, public :: cholesky
    procedure :: first_row
    procedure :: last_row
    procedure :: offset
  end type fuge_band_stiffness

  type, extends(stiffness_factor) :: band_factor
    real(dp), allocatable :: band(:, :)
    character(len=1) :: triangle = 'U'
  contains
    procedure :: solve
  end type band_factor

contains

  !> Use `band` as the stiffness matrix.
  !>
  !> `band` is (width + 1, degrees), or (lda, degrees) with `width` present: LAPACK's band
  !> storage of the upper triangle, K(i,j) in band(width + 1 + i - j, j), or of the lower
  !> one, K(i,j) in band(1 + i - j, j); force per displacement. The array is not copied: declare
  !> it `target` and keep it unchanged as long as the stiffness is used.
  !> Errors, the stiffness unchanged: FUGE_ERR_SIZE, FUGE_ERR_POINTER, FUGE_ERR_NOT_FINITE,
  !> FUGE_ERR_OVERFLOW.
  subroutine set(self, band, upper, info, width)
    class(fuge_band_stiffness), intent(inout) :: self
    real(dp), intent(in), target :: band(:, :)
    logical, intent(in) :: upper
    type(fuge_info), intent(out) :: info
    integer, intent(in), optional :: width
    type(fuge_band_stiffness) :: checked
    integer :: i, j

    checked%width = size(band, 1) - 1
    if (present(width)) checked%width = width
    checked%upper = upper
    if (size(band, 2) < 1 .or. checked%width < 0 .or. checked%width > size(band, 1) - 1) then
      call report(info, FUGE_ERR_SIZE, 'the band has '//text(size(band, 1))//' rows and '//text(size(band, 2)) &
                  //' columns: for width '//text(checked%width)//' it needs a column for each degree of freedom and ' &
                  //'width + 1 rows')
    else if (.not. is_contiguous(band)) then
      call report(info, FUGE_ERR_POINTER, 'the band is a section with gaps between its columns: pass the whole array ' &
                  //'and the width')
    end if
    if (info%failed()) return
    ! Through an address, because only `set` knows that the band is contiguous.
    call c_f_pointer(c_loc(band(1, 1)), checked%band, shape(band))
    do j = 1, size(band, 2)
      i = checked%first_row(j)
      call check_entries(checked%band(i + checked%offset(j):checked%last_row(j) + checked%offset(j), j), i, j, info)
      if (info%failed()) return
    end do
    self%band => checked%band
    self%width = checked%width
    self%upper = upper
  end subroutine set

  !> Number of degrees of freedom; 0 before `set`.
  pure function degrees(self)
    class(fuge_band_stiffness), intent(in) :: self
    integer :: degrees

    degrees = 0
    if (associated(self%band)) degrees = size(self%band, 2)
  end function degrees

  !> First row of the matrix that is stored in column j.
  pure function first_row(self, j) result(i)
    class(fuge_band_stiffness), intent(in) :: self
    integer, intent(in) :: j
    integer :: i

    i = j
    if (self%upper) i = max(1, j - self%width)
  end function first_row

  !> Last row of the matrix that is stored in column j.
  pure function last_row(self, j) result(i)
    class(fuge_band_stiffness), intent(in) :: self
    integer, intent(in) :: j
    integer :: i

    i = j
    if (.not. self%upper) i = min(self%degrees(), j + self%width)
  end function last_row

  !> Row i of column j of the matrix is row i + offset(j) of the band.
  pure function offset(self, j)
    class(fuge_band_stiffness), intent(in) :: self
    integer, intent(in) :: j
    integer :: offset

    offset = 1 - j
    if (self%upper) offset = self%width + 1 - j
  end function offset

  !> The diagonal of K: `terms` (degrees), force per displacement.
  pure subroutine diagonal(self, terms)
    class(fuge_band_stiffness), intent(in) :: self
    real(dp), intent(out) :: terms(:)

    terms = self%band(1 + self%offset(1), :)
  end subroutine diagonal

  !> `u` (degrees); `product` = K u and `magnitude` = |K| |u|, (degrees), force.
  pure subroutine multiply(self, u, product, magnitude)
    class(fuge_band_stiffness), intent(in) :: self
    real(dp), intent(in) :: u(:)
    real(dp), intent(out) :: product(:), magnitude(:)
    real(dp) :: term
    integer :: i, j

    product = 0.0_dp
    magnitude = 0.0_dp
    do j = 1, self%degrees()
      do i = self%first_row(j), self%last_row(j)
        term = self%band(i + self%offset(j), j)
        product(i) = product(i) + term*u(j)
        magnitude(i) = magnitude(i) + abs(term*u(j))
        if (i == j) cycle
        product(j) = product(j) + term*u(i)
        magnitude(j) = magnitude(j) + abs(term*u(i))
      end do
    end do
  end subroutine multiply

  !> Cholesky factor of the constrained matrix; arguments as in `fuge_stiffness_type`.
  subroutine cholesky(self, constrained, shift, factor, pivots, failed, status)
    class(fuge_band_stiffness), intent(in) :: self
    logical, intent(in) :: constrained(:)
    real(dp), intent(in) :: shift
    class(stiffness_factor), allocatable, intent(out) :: factor
    real(dp), intent(out) :: pivots(:)
    integer, intent(out) :: failed, status
    type(band_factor), allocatable :: own
    integer :: n, stat

    n = self%degrees()
    pivots = 0.0_dp
    failed = 0
    status = FUGE_ERR_MEMORY
    allocate (own, stat=stat)
    if (stat == 0) allocate (own%band(self%width + 1, n), stat=stat)
    if (stat /= 0) return
    status = FUGE_DONE
    own%triangle = merge('U', 'L', self%upper)
    call copy_constrained(self, constrained, shift, own%band)
    call dpbtrf(own%triangle, n, self%width, own%band, self%width + 1, failed)
    if (failed /= 0) return
    pivots = own%band(1 + self%offset(1), :)**2
    call move_alloc(own, factor)
  end subroutine cholesky

  !> The band with the constrained rows and columns replaced by those of the identity, the rest
  !> of the diagonal multiplied by 1 + `shift`.
  pure subroutine copy_constrained(self, constrained, shift, band)
    type(fuge_band_stiffness), intent(in) :: self
    logical, intent(in) :: constrained(:)
    real(dp), intent(in) :: shift
    real(dp), intent(out) :: band(:, :)
    integer :: i, j, row

    band = 0.0_dp
    do j = 1, size(constrained)
      row = j + self%offset(j)
      if (constrained(j)) then
        band(row, j) = 1.0_dp
        cycle
      end if
      do i = self%first_row(j), self%last_row(j)
        if (.not. constrained(i)) band(i + self%offset(j), j) = self%band(i + self%offset(j), j)
      end do
      band(row, j) = band(row, j)*(1.0_dp + shift)
    end do
  end subroutine copy_constrained

  !> Replace loads by displacements; arguments as in `fuge_stiffness_type`.
  subroutine solve(self, block, status)
    class(band_factor), intent(in) :: self
    real(dp), intent(inout), contiguous :: block(:, :)
    integer, intent(out) :: status
    integer :: lapack_info

    call dpbtrs(self%triangle, size(block, 1), size(self%band, 1) - 1, size(block, 2), self%band, size(self%band, 1), &
                block, size(block, 1), lapack_info)
    status = FUGE_DONE
  end subroutine solve

end module fuge_stiffness_band
