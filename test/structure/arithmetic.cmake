# cmake/arithmetic.cmake refuses flags that spoil the arithmetic, and no others: cmake -D ROOT=.. -P arithmetic.cmake
cmake_minimum_required(VERSION 3.20)

# Runs it with the variables of a build, `...`; what it says is in `output`.
macro(check)
  execute_process(COMMAND "${CMAKE_COMMAND}" ${ARGN} -P "${ROOT}/cmake/arithmetic.cmake"
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
endmacro()

function(expect_refused flag)
  check(${ARGN})
  string(REGEX REPLACE "[ \n]+" " " output "${output}")
  if(status EQUAL 0 OR NOT output MATCHES "the Fortran option ${flag} lets")
    message(SEND_ERROR "not refused: ${flag} in ${ARGN}\n${output}")
  endif()
endfunction()

function(expect_accepted)
  check(${ARGN})
  if(NOT status EQUAL 0)
    message(SEND_ERROR "refused: ${ARGN}\n${output}")
  endif()
endfunction()

expect_refused(-ffast-math "-DCMAKE_Fortran_FLAGS=-O3 -ffast-math")
expect_refused(-Ofast -DCMAKE_BUILD_TYPE=Release "-DCMAKE_Fortran_FLAGS_RELEASE=-Ofast -march=native")
expect_refused(-Ofast -DCMAKE_CONFIGURATION_TYPES=Release -DCMAKE_Fortran_FLAGS_RELEASE=-Ofast)
expect_refused(-fp-model=fast "-DCMAKE_Fortran_FLAGS=-O2 -fp-model=fast")
expect_accepted()
expect_accepted("-DCMAKE_Fortran_FLAGS=-O3 -march=native -fno-fast-math -ffp-contract=fast")
expect_accepted(-DCMAKE_BUILD_TYPE=Debug -DCMAKE_Fortran_FLAGS_DEBUG=-g -DCMAKE_Fortran_FLAGS_RELEASE=-Ofast)
