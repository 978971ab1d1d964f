!> Tables of the example `solve_mtx`: CSV with comments after #.
module solve_mtx_tables
  use fuge, only: dp => fuge_dp, fuge_info, fuge_problem, fuge_solution, fuge_status_text
  use fuge_text_writer, only: text_output
  implicit none
  private

  public :: write_contact, write_field

  !> A file, or standard output.
  type :: table
    logical :: on_screen = .false.
    type(text_output) :: file
  contains
    procedure :: create
    procedure :: put
    procedure :: finish
  end type table

contains

  !> Forces and gaps; on standard output if `path` is empty.
  subroutine write_contact(path, problem, solution, info)
    character(len=*), intent(in) :: path
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(fuge_info), intent(inout) :: info
    type(table) :: csv
    character(len=320) :: line
    integer :: k

    call csv%create(path, info)
    if (info%failed()) return
    write (line, '(a,i0,2a)') '# status: ', info%status, ', ', fuge_status_text(info%status)
    call csv%put(line)
    if (info%status /= 0) call csv%put('# message: '//info%message)
    write (line, '(a,es9.2e3)') '# residual: ', info%residual
    call csv%put(line)
    write (line, '(a,i0)') '# contacts: ', info%contacts
    call csv%put(line)
    do k = 1, size(solution%motion)
      write (line, '(a,i0,2(a,es24.16e3))') '# motion ', k, ': ', solution%motion(k), ', resultant: ', &
        resultant(problem, solution%force, k)
      call csv%put(line)
    end do
    call csv%put('point,force,gap')
    do k = 1, size(solution%force)
      write (line, '(i0,2('','',es24.16e3))') k, solution%force(k), solution%gap(k)
      call csv%put(line)
    end do
    call csv%finish(info)
  end subroutine write_contact

  !> (R^T f)_k
  pure function resultant(problem, force, k)
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: force(:)
    integer, intent(in) :: k
    real(dp) :: resultant

    if (allocated(problem%modes)) then
      resultant = dot_product(problem%modes(:, k), force)
    else
      resultant = sum(force)
    end if
  end function resultant

  !> Displacements of the whole body.
  subroutine write_field(path, field, info)
    character(len=*), intent(in) :: path
    real(dp), intent(in) :: field(:)
    type(fuge_info), intent(inout) :: info
    type(table) :: csv
    character(len=40) :: line
    integer :: k

    call csv%create(path, info)
    if (info%failed()) return
    call csv%put('degree of freedom,displacement')
    do k = 1, size(field)
      write (line, '(i0,'','',es24.16e3)') k, field(k)
      call csv%put(line)
    end do
    call csv%finish(info)
  end subroutine write_field

  subroutine create(self, path, info)
    class(table), intent(inout) :: self
    character(len=*), intent(in) :: path
    type(fuge_info), intent(inout) :: info

    self%on_screen = len_trim(path) == 0
    if (.not. self%on_screen) call self%file%create(path, info)
  end subroutine create

  subroutine put(self, line)
    class(table), intent(inout) :: self
    character(len=*), intent(in) :: line

    if (self%on_screen) then
      print '(a)', trim(line)
    else
      call self%file%put(line)
    end if
  end subroutine put

  subroutine finish(self, info)
    class(table), intent(inout) :: self
    type(fuge_info), intent(inout) :: info

    if (.not. self%on_screen) call self%file%finish(info)
  end subroutine finish

end module solve_mtx_tables
