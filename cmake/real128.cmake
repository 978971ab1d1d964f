# FUGE_REAL128_WORKS: does the compiler compute with real128?
include(CheckFortranSourceRuns)
check_fortran_source_runs("
  program quadruple
    use, intrinsic :: iso_fortran_env, only: real128
    implicit none
    real(real128) :: x
    character(len=8) :: two = '2.0'
    read (two, *) x
    x = sqrt(x)**2 - 2.0_real128*log(exp(1.0_real128))
    if (.not. abs(x) < 1.0e-30_real128) error stop 1
  end program quadruple" FUGE_REAL128_WORKS SRC_EXT f90)
