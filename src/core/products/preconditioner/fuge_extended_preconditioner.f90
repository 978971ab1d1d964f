!> The operator's preconditioner on a contact set of an area: residuals are extended to open points before it, and what
!> it gives there is collected on the set (fuge_set_extension), in single precision, because neither has to be exact.
module fuge_extended_preconditioner
  use fuge_kinds, only: dp, sp
  use fuge_operator_products, only: precondition
  use fuge_operator_type, only: fuge_operator
  use fuge_point_chunks, only: chunked_pass
  use fuge_point_space, only: point_space
  use fuge_set_extension, only: set_extension, wave_slopes
  use fuge_shared_rows, only: rows_of, shared_rows
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  !> Set it for a contact set, then apply it any number of times.
  type, public :: extended_preconditioner
    type(set_extension), private :: extension
    !> Extended residuals; values in single precision; (n).
    real(dp), allocatable, private :: residual(:)
    real(sp), allocatable, private :: values(:)
  contains
    procedure :: set
    procedure :: apply
  end type extended_preconditioner

  !> Passes over the points, whose `cover` is 1 on the set and 0 off it.
  type, extends(chunked_pass) :: extension_pass
    real(dp), pointer, contiguous :: source(:) => null(), target(:) => null()
    real(sp), pointer, contiguous :: cover(:) => null(), values(:) => null()
    !> The unit of `values`.
    real(dp) :: unit = 1.0_dp
    procedure(chunk_operation), pointer, nopass :: operation => null()
  contains
    procedure :: do_chunk
    procedure :: go
  end type extension_pass

  abstract interface
    !> Chunk `k`, the points `first` .. `last`.
    subroutine chunk_operation(pass, k, first, last)
      import :: extension_pass
      class(extension_pass), intent(inout) :: pass
      integer, intent(in) :: k, first, last
    end subroutine chunk_operation
  end interface

contains

  !> Prepare for the set `contact` (n) of the cells of an area. Error: FUGE_ERR_MEMORY.
  subroutine set(self, operator, contact, info)
    class(extended_preconditioner), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    logical, intent(in), contiguous :: contact(:)
    type(fuge_info), intent(inout) :: info
    type(shared_rows) :: rows
    integer :: stat

    stat = 0
    if (.not. allocated(self%residual)) allocate (self%residual(size(contact)), self%values(size(contact)), stat=stat)
    call require_memory(stat, 'the preconditioner of', size(contact), 'points', info)
    call rows_of(operator, 0, rows, info)
    if (.not. info%failed()) call self%extension%set(rows, operator%grid(), contact, info, &
                                                       wave_slopes(operator))
  end subroutine set

  !> Forces on the contact set whose displacements are close to `residual`, (n), length, zero off the set; `force` (n),
  !> force, zero off the set. Errors: those of the operator.
  subroutine apply(self, operator, residual, force, info)
    class(extended_preconditioner), intent(inout), target :: self
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in), contiguous, target :: residual(:)
    real(dp), intent(inout), contiguous, target :: force(:)
    type(fuge_info), intent(inout) :: info
    type(extension_pass) :: pass
    type(point_space) :: space

    space = operator%ranks()
    call self%extension%point_to_cover(pass%cover)
    pass%values => self%values
    pass%source => residual
    pass%target => self%residual
    call pass%go(find_largest, 1)
    pass%unit = unit_of(space%largest(pass%largest(1)))
    call pass%go(round_values, 0)
    call self%extension%extend(self%values)
    call pass%go(extend_residual, 0)
    call precondition(operator, self%residual, force, info)
    if (info%failed()) return
    pass%source => force
    pass%target => force
    call pass%go(find_largest, 1)
    pass%unit = unit_of(space%largest(pass%largest(1)))
    call pass%go(round_open_values, 0)
    call self%extension%collect(self%values)
    call pass%go(add_collected, 0)
  end subroutine apply

  !> A power of two near `largest`, so that small numbers keep their digits in single precision.
  elemental function unit_of(largest) result(unit)
    real(dp), intent(in) :: largest
    real(dp) :: unit

    unit = scale(1.0_dp, exponent(max(largest, tiny(unit))) - 1)
  end function unit_of

  !> Do `operation` on all chunks; it finds `results` numbers in each.
  subroutine go(self, operation, results)
    class(extension_pass), intent(inout) :: self
    procedure(chunk_operation) :: operation
    integer, intent(in) :: results

    self%operation => operation
    call self%run(size(self%source), results)
  end subroutine go

  subroutine do_chunk(self, k, first, last)
    class(extension_pass), intent(inout) :: self
    integer, intent(in) :: k, first, last

    if (last >= first) call self%operation(self, k, first, last)
  end subroutine do_chunk

  !> Found: the largest magnitude.
  subroutine find_largest(pass, k, first, last)
    class(extension_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last

    pass%found(1, k) = maxval(abs(pass%source(first:last)))
  end subroutine find_largest

  subroutine round_values(pass, k, first, last)
    class(extension_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last

    if (k > 0) pass%values(first:last) = real(pass%source(first:last)/pass%unit, sp)
  end subroutine round_values

  !> The residuals of the set, and those that open points are given.
  subroutine extend_residual(pass, k, first, last)
    class(extension_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last

    if (k > 0) pass%target(first:last) = pass%source(first:last) &
      + pass%unit*real((1.0_sp - pass%cover(first:last))*pass%values(first:last), dp)
  end subroutine extend_residual

  !> Forces of open points, nothing on the set.
  subroutine round_open_values(pass, k, first, last)
    class(extension_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last

    if (k > 0) pass%values(first:last) = (1.0_sp - pass%cover(first:last)) &
                                         *real(pass%source(first:last)/pass%unit, sp)
  end subroutine round_open_values

  !> Forces of the set and what was collected there, none at open points.
  subroutine add_collected(pass, k, first, last)
    class(extension_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last

    if (k > 0) pass%target(first:last) = real(pass%cover(first:last), dp) &
      *(pass%target(first:last) + pass%unit*real(pass%values(first:last), dp))
  end subroutine add_collected

end module fuge_extended_preconditioner
