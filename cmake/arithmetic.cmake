# Refuses compiler options that change the value of floating-point expressions: with them the sums of two doubles of
# the half-space lose their second half, and infinity and NaN pass the checks. Needs nothing but the variables, so
# that a test runs it as a script.
cmake_minimum_required(VERSION 3.20)
set(unsafe -Ofast -ffast-math -funsafe-math-optimizations -fassociative-math -ffinite-math-only
  -fp-model=fast -fp-model=fast=1 -fp-model=fast=2)

set(flags "${CMAKE_Fortran_FLAGS}")
foreach(configuration IN ITEMS ${CMAKE_BUILD_TYPE} ${CMAKE_CONFIGURATION_TYPES})
  string(TOUPPER "${configuration}" configuration)
  string(APPEND flags " ${CMAKE_Fortran_FLAGS_${configuration}}")
endforeach()
separate_arguments(flags UNIX_COMMAND "${flags}")
foreach(flag IN LISTS flags)
  if(flag IN_LIST unsafe)
    message(FATAL_ERROR "fuge: the Fortran option ${flag} lets the compiler change the value of floating-point "
      "expressions: the coefficients of the half-space would lose digits, and infinity and NaN would pass the checks. "
      "Remove it from CMAKE_Fortran_FLAGS, FFLAGS or the flags of the build type; -O3 and -march=native are safe.")
  endif()
endforeach()
