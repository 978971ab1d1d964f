!> The transforms and kernels of `fuge_halfspace_operator`, and all that works with them.
submodule(fuge_halfspace_fft) fuge_halfspace_products
  use fuge_cell_elements, only: FUGE_FREE
  use fuge_grid_convolution, only: find_bounds
  use fuge_grid_plan, only: grid_plan
  use fuge_halfspace_grid, only: check_grid, circle_of, coarsened, complete, computes_later, count_coarser, cyclic, &
    is_large
  use fuge_halfspace_kernels, only: bytes_in_slices, kernel_store, multiply_in_slices
  use fuge_halfspace_spectra, only: bytes_needed
  use fuge_kept_rows, only: drop_rows
  use fuge_memory, only: check_memory
  use fuge_number_text, only: text
  use fuge_owned_object, only: owned_object
  use fuge_single_grid_plan, only: single_plan => grid_plan
  use fuge_spectrum_bounds, only: spectrum_bounds, transform_rounding, WAVE_ERROR
  use fuge_status, only: report, FUGE_DONE, FUGE_ERR_CALL_ORDER, FUGE_ERR_MEMORY
  implicit none

  type, extends(owned_object) :: halfspace_products
    !> Transforms of rows and columns, of a free surface with some more cells to lengths that are fast.
    type(grid_plan) :: plan
    !> The same in single precision.
    type(single_plan) :: single
    !> On most surfaces they are computed when they are first needed.
    type(kernel_store) :: store
  end type halfspace_products

contains

  !> Those of an operator; not associated before it is set.
  function products_of(operator) result(products)
    class(fuge_halfspace_operator), intent(in) :: operator
    type(halfspace_products), pointer :: products

    nullify (products)
    if (.not. associated(operator%products%object)) return
    select type (object => operator%products%object)
    type is (halfspace_products)
      products => object
    end select
  end function products_of

  !> Room for those of `operator`. `status` as in an allocate statement.
  subroutine make_products(operator, products, status)
    class(fuge_halfspace_operator), intent(inout) :: operator
    type(halfspace_products), pointer, intent(out) :: products
    integer, intent(out) :: status
    class(owned_object), pointer :: object

    allocate (products, stat=status)
    if (status /= 0) return
    object => products
    call operator%products%take(object)
  end subroutine make_products

  module procedure set
    type(fuge_halfspace_operator) :: new

    new%surface%cells = [nx, ny]
    new%surface%spacing = [spacing_x, spacing_y]
    new%surface%e_star = e_star
    if (present(element)) new%surface%element = element
    if (present(boundary)) new%surface%boundary = boundary
    if (present(measured)) new%measured = measured
    if (present(body)) new%surface%body = body
    call check_grid(new%surface, info)
    if (info%failed()) return
    call complete(new%surface)
    call prepare(new, info)
    if (info%failed()) return
    call copy_numbers(self, new)
    call self%products%move_from(new%products)
    call self%take_coarser(new)
  end procedure set

  !> Plan and compute what belongs to the cells of `operator`. Errors: FUGE_ERR_MEMORY.
  subroutine prepare(operator, info)
    type(fuge_halfspace_operator), intent(inout) :: operator
    type(fuge_info), intent(inout) :: info
    type(halfspace_products), pointer :: products
    type(fuge_info) :: single_info
    logical :: suited
    integer :: status

    call make_products(operator, products, status)
    if (status /= 0) call report_no_memory(operator, info)
    if (.not. info%failed()) call plan_transforms(operator, products%plan, info)
    if (info%failed()) return
    ! Lines of an odd number of cells would not be aligned. Where memory is short there are no such products.
    suited = all(mod(products%plan%length, 2) == 0)
    if (suited) call products%single%set(operator%surface%cells, products%plan%length, single_info, operator%measured)
    call products%store%create(status)
    if (status == 0 .and. .not. computes_later(operator%surface)) then
      call products%store%compute_all(operator%surface, products%plan, suited .and. .not. single_info%failed(), &
                                      operator%datum_value, status)
    end if
    if (status /= 0) call report_no_memory(operator, info)
    if (.not. info%failed()) call operator%make_room(count_coarser(operator%surface))
  end subroutine prepare

  !> Plan the transforms. Error: FUGE_ERR_MEMORY.
  subroutine plan_transforms(operator, plan, info)
    type(fuge_halfspace_operator), intent(in) :: operator
    type(grid_plan), intent(inout) :: plan
    type(fuge_info), intent(inout) :: info
    real(dp) :: bytes
    integer :: length(2)

    call circle_of(operator%surface, length, info)
    if (info%failed()) return
    bytes = bytes_needed(operator%surface, length)
    ! Every solve has forces and displacements of all cells besides.
    if (is_large(operator%surface)) bytes = bytes_in_slices(operator%surface, length(2)) &
                                            + 16.0_dp*product(real(operator%surface%cells, dp))
    call check_memory(bytes, 'nx = '//text(operator%surface%cells(1))//', ny = ' &
                      //text(operator%surface%cells(2))//':', info)
    if (info%failed()) return
    call plan%set(operator%surface%cells, length, info, operator%measured)
    if (info%status == FUGE_ERR_MEMORY) call report_no_memory(operator, info)
  end subroutine plan_transforms

  subroutine report_no_memory(operator, info)
    type(fuge_halfspace_operator), intent(in) :: operator
    type(fuge_info), intent(inout) :: info

    call report(info, FUGE_ERR_MEMORY, 'no memory for nx = '//text(operator%surface%cells(1))//', ny = ' &
                //text(operator%surface%cells(2))//': use a coarser grid')
  end subroutine report_no_memory

  pure subroutine copy_numbers(self, source)
    class(fuge_halfspace_operator), intent(inout) :: self
    class(fuge_halfspace_operator), intent(in) :: source

    self%surface = source%surface
    self%datum_value = source%datum_value
    self%measured = source%measured
  end subroutine copy_numbers

  module procedure copy
    ! The source may be a bitwise copy of self that shares them.
    if (.not. self%products%has_lent_to(source%products)) call copy_products(self, products_of(source))
    call copy_numbers(self, source)
    call self%drop_coarser()
    if (associated(self%products%object)) then
      call self%make_room(count_coarser(self%surface))
    else
      self%surface%cells = 0
    end if
  end procedure copy

  !> There are none where memory is short.
  subroutine copy_products(self, source)
    class(fuge_halfspace_operator), intent(inout) :: self
    type(halfspace_products), pointer, intent(in) :: source
    type(halfspace_products), pointer :: products
    integer :: status

    call self%products%clear()
    if (.not. associated(source)) return
    call make_products(self, products, status)
    if (status /= 0) return
    call products%store%copy_from(source%store, status)
    if (status == 0) call products%plan%copy_from(source%plan)
    if (products%plan%cells(1) > 0) then
      call products%single%copy_from(source%single)
    else
      call self%products%clear()
    end if
  end subroutine copy_products

  module procedure apply
    type(halfspace_products), pointer :: products

    products => products_of(self)
    call self%check_sizes(size(force), size(displacement), status)
    if (status /= FUGE_DONE) return
    ! In slices even if there is a kernel, so that the bits of a product do not depend on what was solved before.
    if (is_large(self%surface)) then
      ! Products in single precision need their rows, but not now.
      if (associated(products%single%kept)) call drop_rows(products%single%kept)
      call multiply_in_slices(self%surface, products%plan, size(force), force, displacement, status)
      return
    end if
    call require_kernels(self, products, status)
    if (status /= FUGE_DONE) return
    call products%store%kernels%influence%convolve(products%plan, size(force), force, displacement, status)
  end procedure apply

  module procedure precondition
    type(halfspace_products), pointer :: products

    products => products_of(self)
    call self%check_sizes(size(displacement), size(force), status)
    if (status == FUGE_DONE) call require_kernels(self, products, status)
    if (status /= FUGE_DONE) return
    call products%store%kernels%inverse%convolve(products%plan, size(force), displacement, force, status)
  end procedure precondition

  !> The kernels in double precision, unless they came with the grid. `status`: 0 or FUGE_ERR_MEMORY.
  subroutine require_kernels(operator, products, status)
    class(fuge_halfspace_operator), intent(in) :: operator
    type(halfspace_products), intent(in) :: products
    integer, intent(out) :: status

    status = FUGE_DONE
    if (.not. computes_later(operator%surface)) return
    call products%store%require_double(operator%surface, products%plan, status)
    if (status /= 0) status = FUGE_ERR_MEMORY
  end subroutine require_kernels

  module procedure precondition_on_bed
    type(halfspace_products), pointer :: products

    products => products_of(self)
    call self%check_sizes(size(displacement), size(force), status)
    if (status == FUGE_DONE) call require_kernels(self, products, status)
    if (status /= FUGE_DONE) return
    call products%store%kernels%inverse%convolve(products%plan, size(force), displacement, force, status, compliance)
  end procedure precondition_on_bed

  module procedure has_single
    type(halfspace_products), pointer :: products
    integer :: status

    products => products_of(self)
    single = associated(products)
    if (single) single = products%single%cells(1) > 0
    if (.not. single) return
    if (computes_later(self%surface)) then
      ! The certificate needs those in double precision, on a large grid none.
      if (.not. is_large(self%surface)) call require_kernels(self, products, status)
      call products%store%require_single(self%surface, products%plan, single)
    else
      single = products%store%kernels%has_single()
    end if
  end procedure has_single

  module procedure apply_single
    type(halfspace_products), pointer :: products

    products => products_of(self)
    call self%check_sizes(size(input), size(result), status)
    if (status /= FUGE_DONE) return
    call products%store%kernels%single_influence%convolve(products%single, size(input), input, result, status)
  end procedure apply_single

  module procedure precondition_single
    type(halfspace_products), pointer :: products

    products => products_of(self)
    call self%check_sizes(size(input), size(result), status)
    if (status /= FUGE_DONE) return
    call products%store%kernels%single_inverse%convolve(products%single, size(input), input, result, status)
  end procedure precondition_single

  module procedure coarsen
    type(fuge_halfspace_operator), allocatable :: wider
    type(fuge_info) :: info
    integer :: stat

    if (levels < 1 .or. levels > count_coarser(self%surface)) return
    allocate (wider, stat=stat)
    if (stat /= 0) return
    call copy_numbers(wider, self)
    wider%surface = coarsened(self%surface, levels)
    wider%measured = .false.
    call prepare(wider, info)
    if (.not. info%failed()) call move_alloc(wider, coarse)
  end procedure coarsen

  module procedure window
    type(fuge_halfspace_operator), allocatable :: smaller
    type(fuge_info) :: info
    integer :: stat

    if (any(first < 1) .or. any(last < first) .or. any(last > self%surface%cells)) return
    allocate (smaller, stat=stat)
    if (stat /= 0) return
    call copy_numbers(smaller, self)
    smaller%measured = .false.
    smaller%surface%cells = last - first + 1
    call prepare(smaller, info)
    if (.not. info%failed()) call move_alloc(smaller, part)
  end procedure window

  module procedure surface_bounds
    type(halfspace_products), pointer :: products
    type(spectrum_bounds) :: waves
    real(dp) :: error, transform, transforms(2)

    products => products_of(self)
    status = merge(FUGE_DONE, FUGE_ERR_CALL_ORDER, self%points() > 0)
    if (status /= FUGE_DONE .or. self%surface%body%is_set() .or. is_large(self%surface)) return
    if (.not. (self%surface%boundary == FUGE_FREE .or. all(cyclic(self%surface)))) return
    call require_kernels(self, products, status)
    if (status /= FUGE_DONE) return
    associate (kernel => products%store%kernels%influence)
      call find_bounds(kernel, products%plan, waves)
      transforms = [transform_rounding(products%plan%length(1)*merge(2, 1, kernel%padded(1))), &
                    transform_rounding(products%plan%length(2)*merge(2, 1, kernel%padded(2)))]
    end associate
    if (.not. all(transforms < 1.0_dp)) return
    transform = sum(transforms)
    bounds%most = max(waves%most, abs(waves%constant))
    error = WAVE_ERROR*bounds%most
    ! All coefficients of a free surface are positive, so that their sum is the largest eigenvalue.
    if (self%surface%boundary == FUGE_FREE) error = 8.0_dp*epsilon(1.0_dp)*bounds%most + transform*waves%norm()
    bounds%least_balanced = waves%least - error
    bounds%least = min(waves%least, waves%constant) - error
    bounds%most = bounds%most + error
    bounds%rounding = (2.0_dp*transform + 8.0_dp*epsilon(1.0_dp))*bounds%most + error
  end procedure surface_bounds

end submodule fuge_halfspace_products
