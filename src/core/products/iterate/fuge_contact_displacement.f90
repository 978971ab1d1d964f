!> Displacements by forces on all points, where the operator's datum may count.
module fuge_contact_displacement
  use fuge_kinds, only: dp
  use fuge_operator_products, only: multiply
  use fuge_operator_type, only: fuge_operator
  use fuge_point_chunks, only: chunk_count, chunked_pass
  use fuge_point_space, only: point_space
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: compute_displacement

  !> Finds the sum of the forces, then adds `shift` to the displacements.
  type, extends(chunked_pass) :: datum_pass
    real(dp), pointer, contiguous :: force(:) => null(), displacement(:) => null()
    real(dp) :: shift = 0.0_dp
  contains
    procedure :: do_chunk => do_datum
  end type datum_pass

contains

  !> Displacements by `force`, both (n), and by the operator's datum if `with_datum`. Errors: those of the operator.
  subroutine compute_displacement(operator, with_datum, force, displacement, info)
    class(fuge_operator), intent(in) :: operator
    logical, intent(in) :: with_datum
    real(dp), intent(in), contiguous :: force(:)
    real(dp), intent(inout), contiguous :: displacement(:)
    type(fuge_info), intent(inout) :: info
    type(point_space) :: space

    call multiply(operator, force, displacement, info)
    if (.not. with_datum .or. info%failed()) return
    space = operator%ranks()
    if (chunk_count(size(force)) == 1) then
      displacement = displacement + operator%datum()*space%total(sum(force))
    else
      call add_datum(operator%datum(), space, force, displacement)
    end if
  end subroutine compute_displacement

  !> Add to the displacements of several chunks those by the `datum`.
  subroutine add_datum(datum, space, force, displacement)
    real(dp), intent(in) :: datum
    type(point_space), intent(in) :: space
    real(dp), intent(in), contiguous, target :: force(:)
    real(dp), intent(inout), contiguous, target :: displacement(:)
    type(datum_pass) :: pass

    pass%force => force
    call pass%run(size(force), 1)
    pass%shift = datum*space%total(pass%total(1))
    pass%displacement => displacement
    call pass%run(size(force), 1)
  end subroutine add_datum

  subroutine do_datum(self, k, first, last)
    class(datum_pass), intent(inout) :: self
    integer, intent(in) :: k, first, last

    if (associated(self%displacement)) then
      self%displacement(first:last) = self%displacement(first:last) + self%shift
    else
      self%found(1, k) = sum(self%force(first:last))
    end if
  end subroutine do_datum

end module fuge_contact_displacement
