# A project of its own finds the copy in PREFIX with find_package.
# ctest sets PREFIX, KIND, FOLDER, the compilers, SCRATCH, CONFIG, GENERATOR and MAKE_PROGRAM.
cmake_minimum_required(VERSION 3.20)
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")

set(what "${FOLDER} by find_package, ${KIND}")
file(REMOVE_RECURSE "${SCRATCH}")
run("${what}: configure" "${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}/${FOLDER}" -B "${SCRATCH}"
  -G "${GENERATOR}" "-DCMAKE_MAKE_PROGRAM=${MAKE_PROGRAM}" "-DCMAKE_PREFIX_PATH=${PREFIX}" -DKIND=${KIND}
  -DCMAKE_BUILD_TYPE=${CONFIG} "-DCMAKE_RUNTIME_OUTPUT_DIRECTORY=${SCRATCH}/$<0:>"
  -DCMAKE_C_COMPILER=${C_COMPILER}
  -DCMAKE_CXX_COMPILER=${CXX_COMPILER} -DCMAKE_Fortran_COMPILER=${Fortran_COMPILER})
run("${what}: build" "${CMAKE_COMMAND}" --build "${SCRATCH}" --config "${CONFIG}")
foreach(program IN ITEMS consumer consumer_c)
  if(program STREQUAL "consumer" OR EXISTS "${SCRATCH}/${program}")
    expect_answer("${what}" "${SCRATCH}/${program}")
  endif()
endforeach()
if(EXISTS "${SCRATCH}/types")
  run("${what}: all types" "${SCRATCH}/types")
  message(STATUS "${what}: ${output}")
endif()
