# fuge as a subproject: of projects in C, C++ and Fortran, by add_subdirectory and FetchContent, with FFTW and without.
# The projects share one folder and so one build of the library; what differs without FFTW is built again, and what
# is as in the build in BUILT is taken from there.
# ctest sets SOURCE_DIR, WITH_FFTW, the compilers, SCRATCH, GENERATOR, MAKE_PROGRAM and BUILT.
cmake_minimum_required(VERSION 3.20)
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")

# expect_subproject(language by fftw): the programs of a project of that kind run.
function(expect_subproject language by fftw)
  set(what "${language} by ${by}, FUGE_WITH_FFTW=${fftw}")
  run("${what}: configure" "${CMAKE_COMMAND}" -E env --unset=CFLAGS --unset=CXXFLAGS --unset=FFLAGS
    "${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}/subproject" -B "${SCRATCH}" -G "${GENERATOR}"
    "-DCMAKE_MAKE_PROGRAM=${MAKE_PROGRAM}" "-DCMAKE_RUNTIME_OUTPUT_DIRECTORY=${SCRATCH}/$<0:>"
    -DCMAKE_C_COMPILER=${C_COMPILER} -DCMAKE_CXX_COMPILER=${CXX_COMPILER} -DCMAKE_Fortran_COMPILER=${Fortran_COMPILER}
    ${taking} "-DFUGE=${SOURCE_DIR}" -DLANGUAGE=${language} -DBY=${by} -DFUGE_WITH_FFTW=${fftw} -DFUGE_MPI=OFF
    -DCMAKE_INSTALL_PREFIX=${SCRATCH}/prefix)
  foreach(program IN ITEMS consumer consumer_c transform)
    file(REMOVE "${SCRATCH}/${program}")
  endforeach()
  run("${what}: build" ${compiling} "${CMAKE_COMMAND}" --build "${SCRATCH}" --parallel 2)
  foreach(program IN ITEMS consumer consumer_c)
    if(program STREQUAL "consumer" OR EXISTS "${SCRATCH}/${program}")
      expect_answer("${what}" "${SCRATCH}/${program}")
    endif()
  endforeach()
  if(EXISTS "${SCRATCH}/transform")
    run("${what}: transform" "${SCRATCH}/transform")
    string(STRIP "${output}" output)
    message(STATUS "${what}: ${output}")
  endif()
endfunction()

# What fuge must leave to the project around it.
function(expect_no_traces)
  file(STRINGS "${SCRATCH}/CMakeCache.txt" forced REGEX "^(BUILD_SHARED_LIBS|BUILD_TESTING|CMAKE_BUILD_TYPE):[A-Z]+=.+")
  if(forced)
    message(SEND_ERROR "fuge sets options of the project around it: ${forced}")
  endif()
  run("tests" "${CMAKE_CTEST_COMMAND}" --test-dir "${SCRATCH}" -N)
  if(NOT output MATCHES "Total Tests: 0")
    message(SEND_ERROR "fuge adds tests to the project around it: ${output}")
  endif()
  run("install" "${CMAKE_COMMAND}" --install "${SCRATCH}")
  if(EXISTS "${SCRATCH}/prefix")
    message(SEND_ERROR "fuge installs itself with the project around it")
  endif()
endfunction()

file(REMOVE_RECURSE "${SCRATCH}")
set(taking)
if(BUILT)
  prepare_compiling()
  # The project's flags: fuge adds its own.
  string(REGEX REPLACE " -std=.*" "" flags "${flags}")
  set(taking "-DCMAKE_Fortran_FLAGS=${flags}"
    "-DCMAKE_Fortran_COMPILER_LAUNCHER=${CMAKE_CURRENT_LIST_DIR}/take_built.sh")
endif()
if(WITH_FFTW)
  expect_subproject(C add_subdirectory ON)
  expect_subproject(CXX FetchContent ON)
endif()
expect_subproject(C FetchContent OFF)
expect_no_traces()
expect_subproject(CXX add_subdirectory OFF)
expect_subproject(Fortran add_subdirectory OFF)
