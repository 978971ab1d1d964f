! A program that runs no test must not pass.
program zero_tests
  implicit none

  call main()

contains

  subroutine main()
    use funit, only: fuge_compat_summary
    logical :: passed

    call fuge_compat_summary(passed)
    if (.not. passed) stop 1
  end subroutine main

end program zero_tests
