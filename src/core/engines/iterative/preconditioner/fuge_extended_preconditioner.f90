!> The operator's preconditioner on a contact set of an area, in single precision: residuals are extended to open points
!> before it, and what it gives there is collected on the set (fuge_set_extension).
!>
!> Conjugate gradients in double precision take it for exact: its errors are 1e-7 of its largest force.
module fuge_extended_preconditioner
  use fuge_kinds, only: dp, sp
  use fuge_operator_products, only: precondition_single
  use fuge_operator_type, only: fuge_operator
  use fuge_point_chunks, only: chunked_pass
  use fuge_set_extension, only: set_extension
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: has_extension

  !> Set it for a contact set, then apply it any number of times.
  type, public :: extended_preconditioner
    type(set_extension), private :: extension
    !> Residuals and forces, (n).
    real(sp), allocatable, private :: residual(:), force(:)
  contains
    procedure :: set
    procedure :: apply
  end type extended_preconditioner

  !> Finds the largest magnitude of `exact`, rounds `factor` times it to `rounded`, or the other way round.
  type, extends(chunked_pass) :: rounding_pass
    real(dp), pointer, contiguous :: exact(:) => null()
    real(sp), pointer, contiguous :: rounded(:) => null()
    real(dp) :: factor = 1.0_dp
    logical :: backwards = .false.
  contains
    procedure :: do_chunk => round_chunk
  end type rounding_pass

contains

  !> Has the operator the cells of an area, and a preconditioner in single precision?
  function has_extension(operator) result(has)
    class(fuge_operator), intent(in) :: operator
    logical :: has

    has = operator%has_single()
    if (has) has = all(operator%grid() > 1)
  end function has_extension

  !> Prepare for the set `contact` (n). Error: FUGE_ERR_MEMORY.
  subroutine set(self, operator, contact, info)
    class(extended_preconditioner), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    logical, intent(in), contiguous :: contact(:)
    type(fuge_info), intent(inout) :: info
    integer :: stat

    stat = 0
    if (.not. allocated(self%residual)) allocate (self%residual(size(contact)), self%force(size(contact)), stat=stat)
    call require_memory(stat, 'the preconditioner of', size(contact), 'points', info)
    if (stat == 0) call self%extension%set(operator%grid(), contact, info)
  end subroutine set

  !> Forces on the contact set whose displacements are close to `residual`, (n), length, zero off the set; `force` (n),
  !> force, zero off the set. Errors: those of the operator.
  subroutine apply(self, operator, residual, force, info)
    class(extended_preconditioner), intent(inout), target :: self
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in), contiguous, target :: residual(:)
    real(dp), intent(inout), contiguous, target :: force(:)
    type(fuge_info), intent(inout) :: info
    type(rounding_pass) :: pass
    real(dp) :: unit

    pass%exact => residual
    call pass%run(size(residual), 1)
    ! A power of two, so that small residuals keep their digits.
    unit = scale(1.0_dp, exponent(max(pass%largest(1), tiny(unit))))
    pass%factor = 1.0_dp/unit
    pass%rounded => self%residual
    call pass%run(size(residual), 0)
    call self%extension%extend(self%residual)
    call precondition_single(operator, self%residual, self%force, info)
    if (info%failed()) return
    call self%extension%collect(self%force)
    pass%exact => force
    pass%rounded => self%force
    pass%factor = unit
    pass%backwards = .true.
    call pass%run(size(force), 0)
  end subroutine apply

  subroutine round_chunk(self, k, first, last)
    class(rounding_pass), intent(inout) :: self
    integer, intent(in) :: k, first, last

    if (.not. associated(self%rounded)) then
      if (last >= first) self%found(1, k) = maxval(abs(self%exact(first:last)))
    else if (self%backwards) then
      self%exact(first:last) = self%factor*real(self%rounded(first:last), dp)
    else
      self%rounded(first:last) = real(self%factor*self%exact(first:last), sp)
    end if
  end subroutine round_chunk

end module fuge_extended_preconditioner
