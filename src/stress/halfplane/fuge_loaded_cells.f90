!> The cells that carry a force, in a unit of length of the order of the narrowest one.
module fuge_loaded_cells
  use fuge_halfplane_influence, only: FUGE_HAT
  use fuge_hat_field, only: add_hat_displacements, add_hats, hat_rules
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_status, only: fuge_info, report, FUGE_ERR_MEMORY, FUGE_ERR_OVERFLOW
  use fuge_strip_field, only: add_strip_displacements, add_strips
  implicit none
  private

  !> No distance is larger than 2**FARTHEST narrowest widths, 1.8e75.
  integer, parameter :: FARTHEST = 250

  !> Strips or hats, in the caller's order.
  type, public :: loaded_cells
    !> Lengths here are the caller's times 2**power.
    integer :: power = 0
    logical :: hats = .false.
    !> Centres, widths of strips or half bases of hats, and pressures, of hats at the peak.
    real(dp), allocatable :: centre(:), width(:), pressure(:)
    type(hat_rules) :: rules
  contains
    procedure :: set
    procedure :: add_stresses
    procedure :: add_displacements
    procedure :: check_range
  end type loaded_cells

contains

  !> Take the cells with a force. FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY.
  pure subroutine set(self, x, width, force, element, info)
    class(loaded_cells), intent(inout) :: self
    real(dp), intent(in) :: x(:), width(:), force(:)
    integer, intent(in) :: element
    type(fuge_info), intent(inout) :: info
    integer :: k, n, number, stat

    number = count(abs(force) > 0.0_dp)
    allocate (self%centre(number), self%width(number), self%pressure(number), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for '//text(number)//' cells with a force')
      return
    end if
    if (number == 0) return
    self%power = -exponent(minval(width, abs(force) > 0.0_dp))
    self%hats = element == FUGE_HAT
    if (self%hats) call self%rules%prepare()
    n = 0
    do k = 1, size(x)
      if (.not. abs(force(k)) > 0.0_dp) cycle
      call self%check_range(x(k), 'x', k, info)
      call self%check_range(width(k), 'width', k, info)
      n = n + 1
      self%centre(n) = scale(x(k), self%power)
      self%width(n) = scale(width(k), self%power)
      self%pressure(n) = force(k)/self%width(n)
    end do
  end subroutine set

  !> Refuse a length that is too large beside the narrowest width (FUGE_ERR_OVERFLOW).
  pure subroutine check_range(self, length, name, k, info)
    class(loaded_cells), intent(in) :: self
    real(dp), intent(in) :: length
    character(len=*), intent(in) :: name
    integer, intent(in) :: k
    type(fuge_info), intent(inout) :: info

    ! The exponent of 0 is 0.
    if (info%failed() .or. exponent(length) + self%power <= FARTHEST .or. .not. abs(length) > 0.0_dp) return
    call report(info, FUGE_ERR_OVERFLOW, name//'('//index_text(k)//') = '//text(length) &
                //' is more than 1e75 times the narrowest width: leave it out')
  end subroutine check_range

  !> Add -pi times the stresses xx, zz and xz at a point to `total`; lengths and areas in the unit of the cells.
  pure subroutine add_stresses(self, px, pz, total)
    class(loaded_cells), intent(in) :: self
    real(dp), intent(in) :: px, pz
    real(dp), intent(inout) :: total(3)

    if (self%hats) then
      call add_hats(self%rules, self%centre, self%width, self%pressure, px, pz, total)
    else
      call add_strips(self%centre, self%width, self%pressure, px, pz, total)
    end if
  end subroutine add_stresses

  !> Add the integrals of ln(r), z**2/r**2, x z/r**2 and atan(x/z) over the pressure to `total`.
  pure subroutine add_displacements(self, px, pz, total)
    class(loaded_cells), intent(in) :: self
    real(dp), intent(in) :: px, pz
    real(dp), intent(inout) :: total(4)

    if (self%hats) then
      call add_hat_displacements(self%centre, self%width, self%pressure, px, pz, total)
    else
      call add_strip_displacements(self%centre, self%width, self%pressure, px, pz, total)
    end if
  end subroutine add_displacements

end module fuge_loaded_cells
