# The wheel of script/wheel solves where there is nothing but Python, numpy and scipy, and a plain wheel does not.
# cmake -D PYTHON=python -D SOURCE_DIR=.. -D SCRATCH=.. -D FORTRAN=.. -D FFTW=ON|OFF -D SPARSE=1|0 -P wheel_bare.cmake
# PYTHON is that of build/tools. No network is needed.
cmake_minimum_required(VERSION 3.20)

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command} ended with ${status}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE "${SCRATCH}")
file(MAKE_DIRECTORY "${SCRATCH}")
# Built for debugging because that takes a third of the time.
run("${SOURCE_DIR}/script/wheel" "${SCRATCH}" --config-settings=cmake.build-type=Debug
  "--config-settings=build-dir=${SCRATCH}/build" "--config-settings=cmake.define.CMAKE_Fortran_COMPILER=${FORTRAN}"
  "--config-settings=cmake.define.FUGE_WITH_FFTW=${FFTW}" "--config-settings=cmake.define.FUGE_SPARSE=${SPARSE}")
file(GLOB wheels "${SCRATCH}/*.whl")
if(NOT wheels MATCHES "^[^;]*/fuge-[0-9.]+-py3-none-manylinux_[0-9_a-z]+[.]whl$")
  message(FATAL_ERROR "not one wheel for all versions of Python 3: ${wheels}")
endif()
run("${PYTHON}" -m zipfile -e "${wheels}" "${SCRATCH}/content")
file(GLOB info "${SCRATCH}/content/*.dist-info")
foreach(name IN ITEMS LICENSE LIBRARIES libgfortran5.txt GPL-3)
  if(NOT EXISTS "${info}/licenses/${name}")
    message(SEND_ERROR "the wheel has no licence ${name}")
  endif()
endforeach()
file(READ "${info}/METADATA" metadata)
set(licences "LGPL-2.1-or-later AND GPL-3.0-or-later WITH GCC-exception-3.1")
if(FFTW OR SPARSE)
  string(PREPEND licences "GPL-2.0-or-later AND ")
endif()
if(NOT metadata MATCHES "\nLicense-Expression: BSD-3-Clause AND ${licences}\n")
  message(SEND_ERROR "the licences of the wheel are not ${licences}, beside that of fuge")
endif()

set(bare "${PYTHON}" "${CMAKE_CURRENT_LIST_DIR}/bare.py" "${CMAKE_CURRENT_LIST_DIR}/bare_program.py" "${SCRATCH}/root")
run(${bare} "${wheels}")
set(sparse without)
if(SPARSE)
  set(sparse with)
endif()
if(NOT output MATCHES "fuge [0-9.]+ ${sparse} sparse matrices\n$")
  message(FATAL_ERROR "${output}")
endif()

# Without its copies of libraries the same wheel has to fail there.
file(GLOB libraries "${SCRATCH}/content/*.libs")
file(REMOVE_RECURSE ${libraries})
execute_process(COMMAND ${bare} "${SCRATCH}/content" RESULT_VARIABLE status OUTPUT_QUIET ERROR_VARIABLE output)
if(NOT output MATCHES "cannot open shared object file")
  message(FATAL_ERROR "without its libraries the wheel ended with ${status}:\n${output}")
endif()
file(REMOVE_RECURSE "${SCRATCH}/root" "${SCRATCH}/content" "${SCRATCH}/build")
