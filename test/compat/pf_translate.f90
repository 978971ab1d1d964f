! Usage: pf_translate in.pf out.F90 exported_names.txt; a refused file ends it with status 1.
program pf_translate
  implicit none

  call main()

contains

  subroutine main()
    use, intrinsic :: iso_fortran_env, only: error_unit
    use pf_translation, only: translate
    character(len=4096) :: path, out_path, names_path
    character(len=:), allocatable :: error
    integer :: status, out_status, names_status

    call get_command_argument(1, path, status=status)
    call get_command_argument(2, out_path, status=out_status)
    call get_command_argument(3, names_path, status=names_status)
    if (command_argument_count() /= 3 .or. any([status, out_status, names_status] /= 0)) then
      error = 'usage: pf_translate in.pf out.F90 exported_names.txt'
    else
      call translate(trim(path), trim(out_path), trim(names_path), error)
    end if
    if (.not. allocated(error)) return
    write (error_unit, '(a)') error
    stop 1
  end subroutine main

end program pf_translate
