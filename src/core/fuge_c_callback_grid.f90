!> C bindings, section "operators": what the caller may tell of a callback operator, so that it needs as few products
!> as the operators of grids: its cells, coarser grids, a similar body, and of its coefficients what the products do not
!> show.
module fuge_c_callback_grid
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t
  use fuge_c_callback, only: callback_operator, find_callback
  use fuge_c_operator, only: find_operator, operator_handle
  use fuge_c_types, only: report_to_c, require_count
  use fuge_grid_operator_type, only: grid_operator
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_ERR_CALL_ORDER, FUGE_ERR_NOT_FINITE, FUGE_ERR_OPTION, &
    FUGE_ERR_SIZE, FUGE_ERR_UNSUPPORTED
  implicit none
  private

contains

  function c_set_grid(operator, nx, ny, message, length) bind(c, name='fuge_operator_set_grid') result(status)
    type(c_ptr), intent(in), value :: operator, message
    integer(c_int), intent(in), value :: nx, ny
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(callback_operator), pointer :: callback
    type(fuge_info) :: info

    call find_callback(operator, 'a grid', callback, info)
    call require_count(nx, 1, 'nx', 'cells in a row', info)
    call require_count(ny, 1, 'ny', 'rows', info)
    if (.not. info%failed()) call check_cells([int(nx), int(ny)], callback, info)
    if (.not. info%failed()) then
      if (any(callback%cells /= [nx, ny])) nullify (callback%coarser, callback%auxiliary)
      callback%cells = int([nx, ny])
    end if
    status = report_to_c(info, message, length)
  end function c_set_grid

  !> Refuse cells that are not as many as the points: FUGE_ERR_SIZE.
  pure subroutine check_cells(cells, callback, info)
    integer, intent(in) :: cells(2)
    type(callback_operator), intent(in) :: callback
    type(fuge_info), intent(inout) :: info

    ! No overflow: a product that is right is at most n.
    if (cells(1) <= callback%n/cells(2)) then
      if (cells(1)*cells(2) == callback%n) return
    end if
    call report(info, FUGE_ERR_SIZE, 'nx = '//text(cells(1))//' times ny = '//text(cells(2))//' is not the number of ' &
                //'points of op, '//text(callback%n))
  end subroutine check_cells

  function c_set_coarser(operator, coarse, message, length) bind(c, name='fuge_operator_set_coarser') result(status)
    type(c_ptr), intent(in), value :: operator, coarse, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(callback_operator), pointer :: callback
    type(operator_handle), pointer :: handle
    type(fuge_info) :: info

    call find_callback(operator, 'a coarser one', callback, info)
    call find_operator(coarse, 'coarse', handle, info)
    if (.not. info%failed()) call check_coarser(callback%cells, handle%operator%grid(), info)
    if (.not. info%failed()) callback%coarser => handle
    status = report_to_c(info, message, length)
  end function c_set_coarser

  !> Refuse a grid of `coarse` cells for one of `cells`: FUGE_ERR_CALL_ORDER if that is not known, FUGE_ERR_SIZE.
  !> What is accepted has fewer points, so that operators never refer to each other in a circle.
  pure subroutine check_coarser(cells, coarse, info)
    integer, intent(in) :: cells(2), coarse(2)
    type(fuge_info), intent(inout) :: info
    integer :: fitting(2)

    if (any(cells < 1)) then
      call report(info, FUGE_ERR_CALL_ORDER, 'the cells of op are not known: call fuge_operator_set_grid before')
      return
    end if
    fitting = (cells - 1)/2 + 1
    if (all(cells == 1)) then
      call report(info, FUGE_ERR_SIZE, 'op has one cell: there is no coarser grid')
    else if (any(coarse < 1)) then
      call report(info, FUGE_ERR_SIZE, 'the cells of coarse are not known: it has to be an operator of a grid, or ' &
                  //'one of fuge_operator_callback after fuge_operator_set_grid')
    else if (any(coarse /= fitting)) then
      call report(info, FUGE_ERR_SIZE, 'coarse has '//grid_text(coarse)//' cells: cells twice as wide as the ' &
                  //grid_text(cells)//' of op are '//grid_text(fitting))
    end if
  end subroutine check_coarser

  pure function grid_text(cells)
    integer, intent(in) :: cells(2)
    character(len=len(text(cells(1))//' x '//text(cells(2)))) :: grid_text

    grid_text = text(cells(1))//' x '//text(cells(2))
  end function grid_text

  function c_set_auxiliary(operator, auxiliary, message, length) bind(c, name='fuge_operator_set_auxiliary') &
    result(status)
    type(c_ptr), intent(in), value :: operator, auxiliary, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(callback_operator), pointer :: callback
    type(operator_handle), pointer :: handle
    type(fuge_info) :: info

    call find_callback(operator, 'an auxiliary one', callback, info)
    call find_operator(auxiliary, 'auxiliary', handle, info)
    if (.not. info%failed()) call check_auxiliary(callback, handle, info)
    if (.not. info%failed()) then
      callback%cells = handle%operator%grid()
      callback%auxiliary => handle
    end if
    status = report_to_c(info, message, length)
  end function c_set_auxiliary

  !> Refuse what cannot stand for `callback`: FUGE_ERR_UNSUPPORTED unless it is an operator of a grid, FUGE_ERR_SIZE.
  subroutine check_auxiliary(callback, handle, info)
    type(callback_operator), intent(in) :: callback
    type(operator_handle), intent(in) :: handle
    type(fuge_info), intent(inout) :: info
    integer :: cells(2)
    logical :: known

    cells = handle%operator%grid()
    select type (auxiliary => handle%operator)
    class is (grid_operator)
      known = .not. auxiliary%is_shared()
    class default
      known = .false.
    end select
    if (.not. known) then
      call report(info, FUGE_ERR_UNSUPPORTED, 'auxiliary has to be an operator of fuge_operator_halfplane or ' &
                  //'fuge_operator_halfspace')
      return
    end if
    if (product(cells) /= callback%n) then
      call report(info, FUGE_ERR_SIZE, 'auxiliary has '//text(product(cells))//' points, op has '//text(callback%n))
    else if (any(callback%cells > 0 .and. callback%cells /= cells)) then
      call report(info, FUGE_ERR_SIZE, 'auxiliary has '//grid_text(cells)//' cells, op has ' &
                  //grid_text(callback%cells))
    end if
  end subroutine check_auxiliary

  function c_set_coefficients(operator, datum, mean, message, length) &
    bind(c, name='fuge_operator_set_coefficients') result(status)
    type(c_ptr), intent(in), value :: operator, message
    real(c_double), intent(in), value :: datum, mean
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(callback_operator), pointer :: callback
    type(fuge_info) :: info

    call find_callback(operator, 'a datum', callback, info)
    call require_finite(datum, 'datum', info)
    call require_finite(mean, 'mean', info)
    if (.not. info%failed() .and. mean < 0.0_c_double) then
      call report(info, FUGE_ERR_OPTION, 'mean = '//text(real(mean, dp))//': the mean of magnitudes is not negative')
    end if
    if (.not. info%failed()) then
      callback%left_out = datum
      callback%mean_term = mean
    end if
    status = report_to_c(info, message, length)
  end function c_set_coefficients

  !> Refuse NaN and infinity (FUGE_ERR_NOT_FINITE), unless an error is known already.
  pure subroutine require_finite(value, name, info)
    real(c_double), intent(in) :: value
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info

    if (info%failed() .or. ieee_is_finite(value)) return
    call report(info, FUGE_ERR_NOT_FINITE, name//' = '//text(real(value, dp))//' is not a finite number')
  end subroutine require_finite

end module fuge_c_callback_grid
