!> Memory: is there enough of it, before anything is allocated?
module fuge_memory
  use, intrinsic :: iso_c_binding, only: c_double
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_ERR_MEMORY
  implicit none
  private

  public :: check_memory, physical_memory

  integer, parameter :: int64 = selected_int_kind(18)

  interface
    !> Bytes of memory of this machine; 0 if they are unknown.
    function physical_memory() result(bytes) bind(c, name='fuge_physical_memory')
      import :: c_double
      real(c_double) :: bytes
    end function physical_memory
  end interface

contains

  !> Refuse what needs more `bytes` than this machine has, or than can be allocated now (FUGE_ERR_MEMORY). The message
  !> begins with `what`.
  !>
  !> Many systems promise memory that they do not have and end the program when it is used. So the size of the memory
  !> counts first.
  subroutine check_memory(bytes, what, info)
    real(dp), intent(in) :: bytes
    character(len=*), intent(in) :: what
    type(fuge_info), intent(inout) :: info
    character, allocatable :: trial(:)
    real(dp) :: memory
    integer :: stat

    memory = physical_memory()
    if (memory > 0.0_dp .and. bytes > memory) then
      call report(info, FUGE_ERR_MEMORY, what//' needs '//text(bytes)//' bytes, and this machine has ' &
                  //text(memory)//': use a coarser grid')
      return
    end if
    ! One byte only is touched, so that it costs no time.
    stat = 1
    if (bytes < real(huge(0_int64), dp)) allocate (trial(int(bytes, int64) + 1), stat=stat)
    if (stat == 0) trial(1) = ' '
    if (stat /= 0) call report(info, FUGE_ERR_MEMORY, what//' needs '//text(bytes) &
                               //' bytes, which cannot be allocated: use a coarser grid')
  end subroutine check_memory

end module fuge_memory
