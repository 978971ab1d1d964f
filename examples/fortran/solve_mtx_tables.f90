!> Tables of the example `solve_mtx`: CSV with comments after #.
module solve_mtx_tables
  use, intrinsic :: iso_fortran_env, only: int64, output_unit
  use fuge, only: dp => fuge_dp, fuge_info, fuge_problem, fuge_solution, fuge_status_text, FUGE_ERR_FILE
  implicit none
  private

  public :: write_contact, write_field

  !> A file, or standard output. After the first error nothing more is written, and `finish` reports it.
  type :: table
    integer :: unit = output_unit
    integer :: failure = 0
    integer(int64) :: bytes = 0_int64
    character(len=:), allocatable :: path
    character(len=256) :: reason = ''
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

  !> Replace the file at `path`; standard output if that is empty. Error: FUGE_ERR_FILE.
  subroutine create(self, path, info)
    class(table), intent(out) :: self
    character(len=*), intent(in) :: path
    type(fuge_info), intent(inout) :: info

    self%path = path
    if (len_trim(path) == 0) return
    ! A stream, because flang's run-time library aborts on a full disk when it closes a formatted file.
    open (newunit=self%unit, file=path, status='replace', action='write', access='stream', form='unformatted', &
          iostat=self%failure, iomsg=self%reason)
    if (self%failure /= 0) call refuse(self, 'opened', info)
  end subroutine create

  subroutine put(self, line)
    class(table), intent(inout) :: self
    character(len=*), intent(in) :: line

    if (self%failure /= 0) return
    if (self%unit == output_unit) then
      write (self%unit, '(a)') trim(adjustl(line))
    else
      write (self%unit, iostat=self%failure, iomsg=self%reason) trim(adjustl(line))//new_line('a')
    end if
    self%bytes = self%bytes + len_trim(adjustl(line)) + 1
  end subroutine put

  !> Close the file. Error: FUGE_ERR_FILE if it is not complete.
  subroutine finish(self, info)
    class(table), intent(inout) :: self
    type(fuge_info), intent(inout) :: info

    if (self%unit == output_unit) return
    if (self%failure == 0) close (self%unit, iostat=self%failure, iomsg=self%reason)
    if (self%failure == 0) call compare_size(self)
    if (self%failure /= 0) call refuse(self, 'written', info)
  end subroutine finish

  !> On a full disk a run-time library may report nothing: then the file is too short.
  subroutine compare_size(self)
    class(table), intent(inout) :: self
    integer(int64) :: bytes

    open (newunit=self%unit, file=self%path, status='old', action='read', iostat=self%failure, iomsg=self%reason)
    if (self%failure /= 0) return
    inquire (unit=self%unit, size=bytes)
    close (self%unit)
    if (bytes >= self%bytes) return
    self%failure = 1
    self%reason = 'it is shorter than it should be, the disk may be full'
  end subroutine compare_size

  subroutine refuse(self, verb, info)
    class(table), intent(in) :: self
    character(len=*), intent(in) :: verb
    type(fuge_info), intent(inout) :: info

    info%status = FUGE_ERR_FILE
    info%message = '"'//self%path//'" cannot be '//verb//': '//trim(self%reason)
  end subroutine refuse

end module solve_mtx_tables
