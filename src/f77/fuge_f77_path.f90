!> For FUGELP: the load path of a matrix that is not copied, and its events in plain arrays.
module fuge_f77_path
  use fuge_contact_path, only: fuge_load_path
  use fuge_kinds, only: dp
  use fuge_matrix_operator, only: fuge_dense_operator
  use fuge_path_type, only: fuge_path
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: copy_events, follow_load

contains

  !> Follow the plain problem with the gaps `gap` (n) from zero load to `load`. `alpha` is (n, n) or (lda, n). Errors
  !> as `set` of `fuge_dense_operator` and `fuge_load_path`.
  subroutine follow_load(alpha, gap, load, path, info)
    real(dp), intent(in), target :: alpha(:, :)
    real(dp), intent(in) :: gap(:), load
    type(fuge_path), intent(inout) :: path
    type(fuge_info), intent(out) :: info
    type(fuge_dense_operator) :: operator

    call operator%set(alpha, info)
    if (.not. info%failed()) call fuge_load_path(operator, gap, load, path, info)
  end subroutine follow_load

  !> Copy as many entries of a path as the arrays have room for: `motion` and `rate` (m, room), the others (room).
  pure subroutine copy_events(path, parameters, motion, rate, point, state, contacts)
    type(fuge_path), intent(in) :: path
    real(dp), intent(inout) :: parameters(:), motion(:, :), rate(:, :)
    integer, intent(inout) :: point(:), state(:), contacts(:)
    integer :: last

    last = min(path%entries, size(parameters))
    parameters(:last) = path%parameter(:last)
    motion(:, :last) = path%motion(:, :last)
    rate(:, :last) = path%rate(:, :last)
    point(:last) = path%point(:last)
    state(:last) = path%state(:last)
    contacts(:last) = path%contacts(:last)
  end subroutine copy_events

end module fuge_f77_path
