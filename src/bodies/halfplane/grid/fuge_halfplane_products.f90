!> The transforms and kernels of `fuge_halfplane_operator`, and all that works with them.
submodule(fuge_halfplane_fft) fuge_halfplane_products
  use fuge_cell_elements, only: FUGE_FREE, FUGE_PERIODIC
  use fuge_constants, only: PI
  use fuge_convolution, only: convolution_kernel
  use fuge_halfplane_line, only: check_line, circle_of, least_magnitude
  use fuge_halfplane_spectra, only: compute_line_spectra
  use fuge_line_plan, only: line_plan
  use fuge_number_text, only: text
  use fuge_owned_object, only: owned_object
  use fuge_point_chunks, only: chunk_count, chunked_pass
  use fuge_spectrum_bounds, only: transform_rounding, WAVE_ERROR
  use fuge_status, only: composed_message, report, require_memory, FUGE_DONE, FUGE_ERR_CALL_ORDER, FUGE_ERR_MEMORY
  implicit none

  type, extends(owned_object) :: halfplane_products
    !> Transforms of the cells, of a free surface with some more to a length that is fast.
    type(line_plan) :: plan
    !> The eigenvalues of the circulant matrix that holds A, and those of the preconditioner's, the inverse
    !> of a periodic surface.
    type(convolution_kernel) :: influence, inverse
  end type halfplane_products

  !> Finds the largest magnitude of `values` and the sum of those of `force`, or without `force` sets all values to
  !> `least`. The pointers are not contiguous, because contiguous arguments would be copies of those of the operator.
  type, extends(chunked_pass) :: magnitude_pass
    real(dp), pointer :: force(:) => null(), values(:) => null()
    real(dp) :: least = 0.0_dp
  contains
    procedure :: do_chunk => measure_chunk
  end type magnitude_pass

contains

  !> Those of an operator; not associated before it is set.
  function products_of(operator) result(products)
    class(fuge_halfplane_operator), intent(in) :: operator
    type(halfplane_products), pointer :: products

    nullify (products)
    if (.not. associated(operator%products%object)) return
    select type (object => operator%products%object)
    type is (halfplane_products)
      products => object
    end select
  end function products_of

  !> Room for those of `operator`. `status` as in an allocate statement.
  subroutine make_products(operator, products, status)
    class(fuge_halfplane_operator), intent(inout) :: operator
    type(halfplane_products), pointer, intent(out) :: products
    integer, intent(out) :: status
    class(owned_object), pointer :: object

    allocate (products, stat=status)
    if (status /= 0) return
    object => products
    call operator%products%take(object)
  end subroutine make_products

  module procedure set
    type(fuge_halfplane_operator) :: new
    type(halfplane_products), pointer :: products

    new%line%cells = n
    new%line%spacing = spacing
    new%line%e_star = e_star
    if (present(element)) new%line%element = element
    if (present(boundary)) new%line%boundary = boundary
    if (present(body)) new%line%body = body
    call check_line(new%line, info)
    if (.not. info%failed()) call plan_transforms(new, products, info, measured)
    if (.not. info%failed()) call compute_line_spectra(new%line, products%plan, products%influence, products%inverse, &
                                                       new%datum_value, info)
    if (info%failed()) return
    call new%make_room(count_coarser(n))
    self%line = new%line
    self%datum_value = new%datum_value
    call self%products%move_from(new%products)
    call self%take_coarser(new)
  end procedure set

  !> Plan the transforms. Errors: FUGE_ERR_MEMORY.
  subroutine plan_transforms(operator, products, info, measured)
    type(fuge_halfplane_operator), intent(inout) :: operator
    type(halfplane_products), pointer, intent(out) :: products
    type(fuge_info), intent(inout) :: info
    logical, intent(in), optional :: measured
    integer :: length, status

    call circle_of(operator%line, length, info)
    if (info%failed()) return
    call make_products(operator, products, status)
    call require_memory(status, 'the transforms', info)
    if (.not. info%failed()) call products%plan%set(length, info, measured=measured)
    if (info%status == FUGE_ERR_MEMORY) call report(info, FUGE_ERR_MEMORY, 'n = '//text(operator%line%cells)//': ' &
                                                    //composed_message(info))
  end subroutine plan_transforms

  module procedure copy
    ! The source may be a bitwise copy of self that shares them.
    if (.not. self%products%has_lent_to(source%products)) call copy_products(self, products_of(source))
    self%line = source%line
    self%datum_value = source%datum_value
    call self%drop_coarser()
    if (associated(self%products%object)) then
      call self%make_room(count_coarser(self%line%cells))
    else
      self%line%cells = 0
    end if
  end procedure copy

  !> There are none where memory is short.
  subroutine copy_products(self, source)
    class(fuge_halfplane_operator), intent(inout) :: self
    type(halfplane_products), pointer, intent(in) :: source
    type(halfplane_products), pointer :: products
    integer :: status

    call self%products%clear()
    if (.not. associated(source)) return
    call make_products(self, products, status)
    if (status /= 0) return
    call products%influence%copy_from(source%influence, status)
    if (status == 0) call products%inverse%copy_from(source%inverse, status)
    if (status == 0) call products%plan%copy_from(source%plan)
    if (products%plan%length < 1) call self%products%clear()
  end subroutine copy_products

  module procedure apply
    type(halfplane_products), pointer :: products

    products => products_of(self)
    call self%check_sizes(size(force), size(displacement), status)
    if (status == FUGE_DONE) call products%influence%convolve(products%plan, force, displacement, status)
  end procedure apply

  module procedure halfplane_magnitude
    if (chunk_count(size(force)) == 1) then
      magnitude = max(maxval(abs(displacement)), least_magnitude(self%line, sum(abs(force))))
    else
      call measure_in_chunks(self%line, force, displacement, magnitude)
    end if
  end procedure halfplane_magnitude

  subroutine measure_in_chunks(line, force, displacement, magnitude)
    type(halfplane_line), intent(in) :: line
    real(dp), intent(in), target :: force(:), displacement(:)
    real(dp), intent(out), target :: magnitude(:)
    type(magnitude_pass) :: pass

    pass%force => force
    pass%values => displacement
    call pass%run(size(force), 2)
    pass%least = max(pass%largest(1), least_magnitude(line, pass%total(2)))
    pass%force => null()
    pass%values => magnitude
    call pass%run(size(magnitude), 0)
  end subroutine measure_in_chunks

  subroutine measure_chunk(self, k, first, last)
    class(magnitude_pass), intent(inout) :: self
    integer, intent(in) :: k, first, last

    if (associated(self%force)) then
      self%found(:, k) = [maxval(abs(self%values(first:last))), sum(abs(self%force(first:last)))]
    else
      self%values(first:last) = self%least
    end if
  end subroutine measure_chunk

  module procedure precondition
    type(halfplane_products), pointer :: products

    products => products_of(self)
    call self%check_sizes(size(displacement), size(force), status)
    if (status == FUGE_DONE) call products%inverse%convolve(products%plan, displacement, force, status)
  end procedure precondition

  module procedure precondition_on_bed
    type(halfplane_products), pointer :: products

    products => products_of(self)
    call self%check_sizes(size(displacement), size(force), status)
    if (status == FUGE_DONE) call products%inverse%convolve(products%plan, displacement, force, status, compliance)
  end procedure precondition_on_bed

  module procedure line_bounds
    real(dp) :: circle, error, largest, transform
    type(halfplane_products), pointer :: products

    products => products_of(self)
    status = merge(FUGE_DONE, FUGE_ERR_CALL_ORDER, self%points() > 0)
    if (status /= FUGE_DONE .or. self%line%body%is_set()) return
    if (self%line%boundary == FUGE_PERIODIC) then
      transform = transform_rounding(products%plan%length)
      error = WAVE_ERROR*products%influence%bounds%most
    else
      transform = transform_rounding(2*products%plan%length)
      circle = 2.0_dp*real(products%plan%length, dp)
      largest = 2.0_dp/(PI*self%line%e_star)*(log(circle) + 3.0_dp)
      error = 16.0_dp*epsilon(1.0_dp)*(largest + abs(self%datum_value))
      bounds%datum_rounding = error
      error = circle*error + transform*products%influence%bounds%norm()
    end if
    if (.not. transform < 1.0_dp) return
    associate (waves => products%influence%bounds)
      bounds%least_balanced = waves%least - error
      if (self%line%boundary == FUGE_FREE) bounds%least = min(bounds%least_balanced, &
                                                              waves%constant - error + circle*(self%datum_value &
                                                                                               - bounds%datum_rounding))
      bounds%most = max(waves%most, abs(waves%constant)) + error
      bounds%rounding = (2.0_dp*transform + 8.0_dp*epsilon(1.0_dp))*bounds%most + error
    end associate
  end procedure line_bounds

end submodule fuge_halfplane_products
