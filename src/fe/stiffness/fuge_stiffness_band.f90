!> A stiffness matrix in LAPACK's symmetric band storage. The stiffness refers to the caller's array, or has a copy of
!> compressed columns; the factorisation alone fills a band.
module fuge_stiffness_band
  use, intrinsic :: iso_c_binding, only: c_loc, c_f_pointer
  use fuge_kinds, only: dp
  use fuge_lapack, only: dpbtrf, dpbtrs
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_SIZE, FUGE_ERR_POINTER, FUGE_ERR_MEMORY
  use fuge_stiffness_check, only: check_entries
  use fuge_stiffness_type, only: fuge_stiffness, stiffness_factor
  use fuge_symmetric_columns, only: symmetric_columns
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
    !> A copy of compressed columns, if `band` is not associated.
    type(symmetric_columns) :: entries
  contains
    procedure, public :: set
    procedure, public :: set_columns
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
    call self%entries%clear()
  end subroutine set

  !> Copy a stiffness matrix in compressed columns, of which the entry farthest from the diagonal sets the width;
  !> arguments as in `fuge_stiffness_type`.
  subroutine set_columns(self, column, row, value, info)
    class(fuge_band_stiffness), intent(inout) :: self
    integer, intent(in) :: column(:), row(:)
    real(dp), intent(in) :: value(:)
    type(fuge_info), intent(out) :: info
    integer :: j

    call self%entries%set(column, row, value, info)
    if (info%failed()) return
    nullify (self%band)
    self%upper = .true.
    self%width = 0
    associate (upper => self%entries%upper)
      do j = 1, self%degrees()
        ! Rows ascend.
        if (upper%column(j + 1) > upper%column(j)) self%width = max(self%width, j - upper%row(upper%column(j)))
      end do
    end associate
  end subroutine set_columns

  !> Number of degrees of freedom; 0 before `set`.
  pure function degrees(self)
    class(fuge_band_stiffness), intent(in) :: self
    integer :: degrees

    degrees = self%entries%degrees()
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

    if (associated(self%band)) then
      terms = self%band(1 + self%offset(1), :)
    else
      call self%entries%diagonal(terms)
    end if
  end subroutine diagonal

  !> `u` (degrees); `product` = K u and `magnitude` = |K| |u|, (degrees), force.
  pure subroutine multiply(self, u, product, magnitude)
    class(fuge_band_stiffness), intent(in) :: self
    real(dp), intent(in) :: u(:)
    real(dp), intent(out) :: product(:), magnitude(:)
    real(dp) :: term
    integer :: i, j

    if (.not. associated(self%band)) then
      call self%entries%multiply(u, product, magnitude)
      return
    end if
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
    if (associated(self%band)) then
      call copy_constrained(self, constrained, shift, own%band)
    else
      call fill_constrained(self%entries, self%width, constrained, shift, own%band)
    end if
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

  !> As `copy_constrained`, from compressed columns into the upper band of this width.
  pure subroutine fill_constrained(matrix, width, constrained, shift, band)
    type(symmetric_columns), intent(in) :: matrix
    integer, intent(in) :: width
    logical, intent(in) :: constrained(:)
    real(dp), intent(in) :: shift
    real(dp), intent(out) :: band(:, :)
    integer :: i, j, p

    band = 0.0_dp
    do j = 1, size(constrained)
      do p = matrix%upper%column(j), matrix%upper%column(j + 1) - 1
        i = matrix%upper%row(p)
        if (.not. (constrained(i) .or. constrained(j))) band(width + 1 + i - j, j) = matrix%upper%value(p)
      end do
      if (constrained(j)) band(width + 1, j) = 1.0_dp
      if (.not. constrained(j)) band(width + 1, j) = band(width + 1, j)*(1.0_dp + shift)
    end do
  end subroutine fill_constrained

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
